module test_gnuplot
    !! Panels as a scene wants them, and scripts in which no text of the user's is a command.
    use drawn_columns, only: names, occurrences, one_curve, script, units
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_characters, only: printable
    use lagrangia_errors, only: error_t
    use lagrangia_gnuplot, only: new_panels, panel_t
    use lagrangia_gnuplot_script, only: gnuplot_string
    use lagrangia_kinds, only: dp
    use lagrangia_plot_colour, only: colour_panels, colours
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: gnuplot_suite

    character(*), parameter :: theta = char(206)//char(184), dot = char(204)//char(135)

contains

    function gnuplot_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("gnuplot")
        call suite%addTest(TestMethod("panels_are_read", panels_are_read))
        call suite%addTest(TestMethod("panels_gather_by_unit", panels_gather_by_unit))
        call suite%addTest(TestMethod("wrong_panels_are_refused", wrong_panels_are_refused))
        call suite%addTest(TestMethod("a_text_is_no_command", a_text_is_no_command))
        call suite%addTest(TestMethod("marks_are_letters", marks_are_letters))
        call suite%addTest(TestMethod("columns_are_drawn_with_units", columns_are_drawn_with_units))
        call suite%addTest(TestMethod("lines_end_where_they_end", lines_end_where_they_end))
        call suite%addTest(TestMethod("a_quantity_has_one_colour", a_quantity_has_one_colour))
        call suite%addTest(TestMethod("a_panel_has_different_colours", &
                                      a_panel_has_different_colours))
    end function gnuplot_suite

    subroutine panels_are_read()
        !! `'y'` over the first column, `'x:y'`, several curves with `+`.
        type(panel_t), allocatable :: panels(:)
        type(error_t), allocatable :: error

        call new_panels([character(20) :: "theta", "x:y", "t:x+y+x_dot"], names, units, panels, &
                        error)
        call assertFalse(allocated(error), "good panels")
        call assertEqual(3, size(panels))
        call assertEqual([1, 2, 1], [panels%x])
        call assertEqual([1, 1, 3], [panels%curves])
        call assertEqual(3, panels(1)%y(1))
        call assertEqual(5, panels(2)%y(1))
        call assertEqual([2, 5, 4], panels(3)%y(:3))
    end subroutine panels_are_read

    subroutine panels_gather_by_unit()
        !! Without specs: one panel a unit, drifts and errors apart from other pure numbers.
        type(panel_t), allocatable :: panels(:)
        type(error_t), allocatable :: error
        character(*), parameter :: more(*) = [character(12) :: names, "ratio"]
        character(*), parameter :: more_units(*) = [character(4) :: units, "1"]

        call new_panels([character(1) ::], more, more_units, panels, error)
        call assertEqual([1, 1, 1, 1, 1], [panels%x])
        call assertEqual([2, 1, 1, 2, 1], [panels%curves])
        call assertEqual([2, 5], panels(1)%y(:2))
        call assertEqual(3, panels(2)%y(1))
        call assertEqual(4, panels(3)%y(1))
        call assertEqual([6, 7], panels(4)%y(:2))
        call assertEqual(8, panels(5)%y(1))
        call new_panels([character(1) ::], ["t", spread("x", 1, 9)], ["s", spread("m", 1, 9)], &
                        panels, error)
        call assertEqual([8, 1], [panels%curves], message="no more than eight curves in one")
    end subroutine panels_gather_by_unit

    subroutine a_quantity_has_one_colour()
        !! In all panels of a picture, also where another one stands before it; in a panel the
        !! curves differ. The scripts have these colours.
        character(:), allocatable :: text

        text = script("", [character(12) :: "x+y", "theta", "x_dot+y+x", "theta+y"])
        call assertTrue(drawn(text, 2, 1) .and. drawn(text, 5, 2), "as they come: "//text)
        call assertTrue(drawn(text, 3, 1), "alone, and beside y: "//text)
        call assertTrue(drawn(text, 4, 3), "neither that of x nor that of y: "//text)
        call assertEqual(3, occurrences(text, "lc rgb '"//colours(2)//"'"), "y, three times")
        call assertEqual(4, occurrences(text, "lc rgb '"//colours(1)//"'"), "x and theta, twice")
        text = script("", [character(12) :: "x:y", "x+y"])
        call assertTrue(index(text, "using 2:5 with lines lw 2 lc rgb '"//colours(1)) > 0, &
                        "a path: "//text)
        call assertTrue(drawn(text, 2, 1) .and. drawn(text, 5, 2), "x and y in time: "//text)
    end subroutine a_quantity_has_one_colour

    pure function drawn(text, column, colour) result(yes)
        !! A curve of this column and colour.
        character(*), intent(in) :: text
        integer, intent(in) :: column, colour
        logical :: yes

        yes = index(text, "using 1:"//to_text(column)//" with lines lw 2 lc rgb '"// &
                    colours(colour)//"'") > 0
    end function drawn

    subroutine lines_end_where_they_end()
        !! Blanks behind a line are nothing.
        call assertEqual(0, index(script("a title", ["x", "y"]), " "//new_line("a")))
    end subroutine lines_end_where_they_end

    subroutine a_panel_has_different_colours()
        !! A drift has the colour of what drifts; more quantities than colours begin again.
        character(*), parameter :: all_names(*) = [character(12) :: "t", "E", "A_x", "A_y", &
            "E_drift", "A_x_drift", "_drift", "a", "b", "c", "d", "e", "f"]
        type(panel_t) :: panels(4)
        integer :: i

        panels(1)%curves = 2
        panels(1)%y(:2) = [3, 4]
        panels(2)%curves = 2
        panels(2)%y(:2) = [5, 6]
        panels(3)%curves = 2
        panels(3)%y(:2) = [7, 2]
        panels(4)%curves = 8
        panels(4)%y = [8, 9, 10, 11, 12, 13, 7, 3]
        call colour_panels(panels, all_names)
        call assertEqual([1, 2], panels(1)%colour(:2))
        call assertEqual([2, 1], panels(2)%colour(:2), message="E is no A_x")
        call assertEqual([3, 2], panels(3)%colour(:2), message="E as its drift")
        call assertEqual([2, 4, 5, 6, 7, 8, 3, 1], panels(4)%colour)
        do i = 1, size(panels)
            panels(i)%colour = 0
        end do
        panels(:)%curves = [8, 5, 5, 0]
        panels(1)%y = [2, 3, 4, 8, 9, 10, 11, 12]
        panels(2)%y(:5) = [2, 3, 4, 8, 13]
        panels(3)%y(:5) = [13, 9, 10, 11, 12]
        call colour_panels(panels, all_names)
        call assertEqual([1, 2, 3, 4, 5, 6, 7, 8], panels(1)%colour)
        call assertEqual([1, 2, 3, 4, 5], panels(2)%colour(:5), message="none is left for f")
        call assertEqual([5, 5, 6, 7, 8], panels(3)%colour(:5))
    end subroutine a_panel_has_different_colours

    subroutine wrong_panels_are_refused()
        !! With the nearest column; the place in the list is told.
        call refused([character(24) :: "theta", "tetha"], 2, &
                     "'tetha' is none of this scene's columns; did you mean 'theta'?")
        call refused([character(24) :: "z:theta"], 1, "'z' is none of this scene's columns; "// &
                     "there are ")
        call refused([character(24) :: "x+"], 1, "'' is none of this scene's columns")
        call refused([character(24) :: "x::y"], 1, "':y' is none of this scene's columns")
        call refused([character(24) :: "x+x+x+x+x+x+x+x+x"], 1, "more than 8 curves in one panel")
        call refused([character(24) :: "x, y"], 1, "'x, y' is none of this scene's columns")
    end subroutine wrong_panels_are_refused

    subroutine refused(specs, element, message)
        !! Assert that `specs` are refused, because of one, in a message that begins so.
        character(*), intent(in) :: specs(:), message
        integer, intent(in) :: element
        type(panel_t), allocatable :: panels(:)
        type(error_t), allocatable :: error

        call new_panels(specs, names, units, panels, error)
        call assertTrue(allocated(error), "refused: "//message)
        if (.not. allocated(error)) return
        call assertEqual(1, index(error%message, message), error%message)
        call assertEqual("plot", error%key)
        call assertEqual(element, error%element)
    end subroutine refused

    subroutine a_text_is_no_command()
        !! Outside of strings nothing of a text is left, whatever it contains and wherever it comes
        !! from; inside, what was written can be read back.
        character(*), parameter :: texts(*) = [character(64) :: &
            "plain MARK", "it's MARK", "' ; MARK ; '", "'Small' MARK", "''MARK", "MARK'", &
            """MARK"" \MARK\", """; MARK ; """, "`MARK`", "$(MARK) @MARK # MARK", "\'MARK", &
            "\""; MARK #", "{/"//"*9 MARK}_^ &~%", "MARK\", "<MARK", "|MARK", "-MARK", &
            "50 %s MARK", "\140MARK\140", "MA"//char(195)//char(164)//"MARK", &
            "a"//char(9)//"MARK", "a"//char(10)//"MARK", &
            "a"//char(13)//"MARK"//char(27)//"[31m", char(255)//"MARK"]
        real(dp), parameter :: two(2) = [0.0_dp, 1.0_dp]
        character(:), allocatable :: text, shown
        integer :: i, k

        do i = 1, size(texts)
            shown = printable(trim(texts(i)))
            call assertEqual(shown, read_back(gnuplot_string(trim(texts(i)))), texts(i))
            do k = 1, 4
                select case (k)
                case (1)
                    text = one_curve("it.dat", trim(texts(i)), ["t", "x"], ["s", "m"], two)
                case (2)
                    text = one_curve("it.dat", "", [character(64) :: "t", texts(i)], ["s", "m"], &
                                     two)
                case (3)
                    text = one_curve("it.dat", "", ["t", "x"], [character(64) :: "s", texts(i)], &
                                     two)
                case default
                    text = one_curve(trim(texts(i))//".dat", "", ["t", "x"], ["s", "m"], two)
                end select
                call assertTrue(index(text, "MARK") > 0, "the text is there: "//texts(i))
                text = outside(text)
                call assertEqual(0, index(text, "MARK"), "a command: "//texts(i))
                call assertEqual(0, scan(text, "`@"//char(9)//char(13)), "what acts: "//texts(i))
            end do
        end do
    end subroutine a_text_is_no_command

    subroutine marks_are_letters()
        !! Terminals read enhanced text, in which _ ^ { } & @ ~ and % are signs: what a user wrote
        !! is kept out of it, string by string.
        character(:), allocatable :: text

        text = one_curve("it.dat", "a_b^{2}", [character(9) :: "t", "a{b}"], ["s", "m"], &
                         [0.0_dp, 1.0_dp])
        call assertTrue(index(text, "label 1 ""a_b^{2}"" noenhanced at") > 0, text)
        call assertTrue(index(text, "set ylabel ""a{b} (m)"" noenhanced") > 0, text)
        text = one_curve("it.dat", "", ["t", "x"], [character(9) :: "s", "m&^{2}"], &
                         [0.0_dp, 1.0_dp])
        call assertTrue(index(text, "set ylabel ""x (m&^{2})"" noenhanced") > 0, text)
    end subroutine marks_are_letters

    pure function outside(text) result(rest)
        !! `text` without comments and without its strings, a backslash and what stands behind it
        !! being part of them where the quotes are double. A string ends at the end of its line.
        character(*), intent(in) :: text
        character(:), allocatable :: rest
        character(1) :: quote
        integer :: i

        rest = ""
        quote = " "
        i = 0
        do while (i < len(text))
            i = i + 1
            if (text(i:i) == new_line("a")) quote = " "
            if (quote == """" .and. text(i:i) == "\") then
                i = i + 1
            else if (quote == "#") then
                cycle
            else if (text(i:i) == quote) then
                quote = " "
            else if (quote == " " .and. scan(text(i:i), "'""#") == 1) then
                quote = text(i:i)
            else if (quote == " ") then
                rest = rest//text(i:i)
            end if
        end do
    end function outside

    pure function read_back(string) result(text)
        !! What gnuplot makes of a string between double quotes: `\ooo` is a byte, `\c` else `c`.
        character(*), intent(in) :: string
        character(:), allocatable :: text
        integer :: code, i

        text = ""
        if (string(1:1) /= """" .or. string(len(string):) /= """") return
        i = 2
        do while (i < len(string))
            if (string(i:i) == "\") then
                i = i + 1
                if (scan(string(i:i), "01234567") == 1) then
                    read (string(i:i + 2), "(o3)") code
                    text = text//char(code)
                    i = i + 3
                    cycle
                end if
            else if (scan(string(i:i), """`@") == 1) then
                text = text//"UNESCAPED"
            end if
            text = text//string(i:i)
            i = i + 1
        end do
    end function read_back

    subroutine columns_are_drawn_with_units()
        !! By their numbers, from the file beside the script, with labels for axes and curves.
        character(:), allocatable :: text

        text = script("a title", [character(12) :: "theta", "x:y+x_dot"])
        call assertTrue(index(text, "data = folder.""it.dat""") > 0, text)
        call assertTrue(index(text, "picture = folder.""it""") > 0, text)
        call assertTrue(index(text, "set label 1 ""a title"" noenhanced at screen 0.5") > 0, text)
        call assertTrue(index(text, "set xlabel ""t (s)""") > 0, text)
        call assertTrue(index(text, "set ylabel """//theta//" (rad)"""//new_line("a")// &
                              "unset key") > 0, text)
        call assertTrue(index(text, "plot data using 1:3 with lines") > 0, text)
        call assertTrue(index(text, "set xlabel ""x (m)""") > 0, text)
        call assertTrue(index(text, "data using 2:5 with lines lw 2 lc rgb '#0072b2' title "// &
                              """y (m)""") > 0, text)
        call assertTrue(index(text, "data using 2:4 with lines lw 2 lc rgb '#d55e00' title ""x"// &
                              dot//" (m/s)""") > 0, text)
        call assertTrue(index(text, "set ylabel ""y (m), x"//dot//" (m/s)""") > 0, text)
        text = script("", [character(12) :: "x+y"])
        call assertTrue(index(text, "set ylabel ""x, y (m)""") > 0, "one unit")
        call assertTrue(index(text, "title ""x"", ") > 0, "the unit is on the axis: "//text)
        text = script("", [character(12) :: "x+y+theta"])
        call assertTrue(index(text, "set ylabel ""x (m), y (m), "//theta//" (rad)""") > 0, text)
        text = script("", [character(16) :: "x+y+theta+x_dot"])
        call assertTrue(index(text, "set ylabel """""//new_line("a")) > 0, "too many: "//text)
    end subroutine columns_are_drawn_with_units
end module test_gnuplot
