module test_gnuplot
    !! Panels as a scene wants them, and scripts in which no text of the user's is a command.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_characters, only: printable
    use lagrangia_errors, only: error_t
    use lagrangia_gnuplot, only: gnuplot_script, new_panels, panel_t
    use lagrangia_gnuplot_script, only: gnuplot_string
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: gnuplot_suite

    character(*), parameter :: names(*) = [character(12) :: "t", "x", "theta", "x_dot", "y", &
                                           "error", "energy_drift"]
    character(*), parameter :: units(*) = [character(4) :: "s", "m", "rad", "m/s", "m", "1", "1"]
    real(dp), parameter :: low(*) = [0.0_dp, -2.0_dp, -1.0_dp, -3.0_dp, -1.0_dp, 0.0_dp, 0.0_dp]
    real(dp), parameter :: high(*) = [9.0_dp, 2.0_dp, 1.0_dp, 3.0_dp, 1.0_dp, 1e-9_dp, 1e-9_dp]

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
        call suite%addTest(TestMethod("lengths_share_a_scale", lengths_share_a_scale))
        call suite%addTest(TestMethod("ticks_are_round", ticks_are_round))
        call suite%addTest(TestMethod("pictures_have_a_size", pictures_have_a_size))
        call suite%addTest(TestMethod("a_constant_has_a_range", a_constant_has_a_range))
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

    subroutine wrong_panels_are_refused()
        !! With the nearest column; the place in the list is told.
        call refused([character(24) :: "theta", "tetha"], 2, &
                     "'tetha' is none of this scene's columns; did you mean 'theta'?")
        call refused([character(24) :: "z:theta"], 1, "'z' is none of this scene's columns")
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

    function script(title, specs) result(text)
        !! The script of the columns above.
        character(*), intent(in) :: title, specs(:)
        character(:), allocatable :: text
        type(panel_t), allocatable :: panels(:)
        type(error_t), allocatable :: error

        call new_panels(specs, names, units, panels, error)
        text = gnuplot_script("it.dat", "", title, names, units, low, high, panels)
    end function script

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
        character(:), allocatable :: text, shown
        type(panel_t), allocatable :: panels(:)
        type(error_t), allocatable :: error
        integer :: i, k

        do i = 1, size(texts)
            shown = printable(trim(texts(i)))
            call assertEqual(shown, read_back(gnuplot_string(trim(texts(i)))), texts(i))
            do k = 1, 4
                call new_panels(["x"], ["t", "x"], ["s", "m"], panels, error)
                select case (k)
                case (1)
                    text = gnuplot_script("it.dat", "", trim(texts(i)), ["t", "x"], ["s", "m"], &
                                          [0.0_dp, 0.0_dp], [1.0_dp, 1.0_dp], panels)
                case (2)
                    text = gnuplot_script("it.dat", "", "", [character(64) :: "t", texts(i)], &
                                          ["s", "m"], [0.0_dp, 0.0_dp], [1.0_dp, 1.0_dp], panels)
                case (3)
                    text = gnuplot_script("it.dat", "", "", ["t", "x"], [character(64) :: "s", &
                                          texts(i)], [0.0_dp, 0.0_dp], [1.0_dp, 1.0_dp], panels)
                case default
                    text = gnuplot_script(trim(texts(i))//".dat", "", "", ["t", "x"], ["s", "m"], &
                                          [0.0_dp, 0.0_dp], [1.0_dp, 1.0_dp], panels)
                end select
                call assertTrue(index(text, "MARK") > 0, "the text is there: "//texts(i))
                text = outside(text)
                call assertEqual(0, index(text, "MARK"), "a command: "//texts(i))
                call assertEqual(0, scan(text, "`@"//char(9)//char(13)), "what acts: "//texts(i))
            end do
        end do
    end subroutine a_text_is_no_command

    subroutine marks_are_letters()
        !! The signs of enhanced text, _ ^ { } & @ ~ and %, are what they are in every terminal.
        character(*), parameter :: kinds(*) = [character(8) :: "pngcairo", "png", "svg", "dumb"]
        character(:), allocatable :: text
        integer :: i

        text = script("a_b^{2}", ["x"])
        do i = 1, size(kinds)
            call assertTrue(index(text, "set terminal "//trim(kinds(i))//" noenhanced") > 0, &
                            kinds(i))
        end do
        call assertEqual(0, index(text, " enhanced"), text)
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
        call assertTrue(index(text, "layout 2,1 title ""a title"" noenhanced") > 0, text)
        call assertTrue(index(text, "set xlabel ""t [s]""") > 0, text)
        call assertTrue(index(text, "set ylabel ""theta [rad]""; unset key") > 0, text)
        call assertTrue(index(text, "plot data using 1:3 with lines") > 0, text)
        call assertTrue(index(text, "set xlabel ""x [m]""") > 0, text)
        call assertTrue(index(text, "plot data using 2:5 with lines lw 1.5 title ""y [m]"", "// &
                        "data using 2:4 with lines lw 1.5 title ""x_dot [m/s]""") > 0, text)
        call assertTrue(index(text, "set ylabel """"; set key") > 0, "units that differ")
        text = script("", [character(12) :: "x+y"])
        call assertTrue(index(text, "set ylabel ""[m]""; set key above right") > 0, "one unit")
        text = script("", [character(12) :: "x+y+theta"])
        call assertTrue(index(text, "set ylabel """"; set key") > 0, "only the last differs")
    end subroutine columns_are_drawn_with_units

    subroutine lengths_share_a_scale()
        !! A path in the plane is drawn to scale; time series and other units are not.
        call assertTrue(index(script("", ["x:y"]), "set size ratio -1; set xtics 1.0; "// &
                              "set ytics 1.0") > 0, "a path")
        call assertEqual(0, index(script("", ["y"]), "ratio -1"), "over the time")
        call assertEqual(0, index(script("", [character(7) :: "x:theta"]), "ratio -1"), "an angle")
        call assertTrue(to_scale(4.9_dp, 1.0_dp), "wide")
        call assertFalse(to_scale(5.1_dp, 1.0_dp), "too wide")
        call assertTrue(to_scale(1.0_dp, 4.9_dp), "high")
        call assertFalse(to_scale(1.0_dp, 5.1_dp), "too high")
    contains
        logical function to_scale(width, height)
            real(dp), intent(in) :: width, height
            type(panel_t), allocatable :: panels(:)
            type(error_t), allocatable :: error

            call new_panels(["x:y"], ["t", "x", "y"], ["s", "m", "m"], panels, error)
            to_scale = index(gnuplot_script("it.dat", "", "", ["t", "x", "y"], ["s", "m", "m"], &
                             [0.0_dp, 0.0_dp, 0.0_dp], [1.0_dp, width, height], panels), &
                             "ratio -1") > 0
        end function to_scale
    end subroutine lengths_share_a_scale

    subroutine ticks_are_round()
        !! 1, 2 or 5 times a power of ten, three to seven of them, up to each of the ranges; of the
        !! wider side of a path that is drawn to scale.
        real(dp), parameter :: ranges(7) = [0.29_dp, 0.31_dp, 0.59_dp, 0.61_dp, 1.49_dp, 1.51_dp, &
                                            2.9_dp]
        character(4), parameter :: steps(7) = ["0.05", "0.1 ", "0.1 ", "0.2 ", "0.2 ", "0.5 ", &
                                               "0.5 "]
        type(panel_t), allocatable :: panels(:)
        type(error_t), allocatable :: error
        character(:), allocatable :: text
        integer :: i, k

        do i = 1, size(ranges)
            do k = 1, 2
                call new_panels(["x:y"], ["t", "x", "y"], ["s", "m", "m"], panels, error)
                text = gnuplot_script("it.dat", "", "", ["t", "x", "y"], ["s", "m", "m"], &
                                      [0.0_dp, 1.0_dp, 1.0_dp], &
                                      1.0_dp + ranges(i)/[1, k, 3 - k], panels)
                call assertTrue(index(text, "set xtics "//trim(steps(i))//"; set ytics "// &
                                      trim(steps(i))//new_line("a")) > 0, steps(i)//text)
            end do
        end do
    end subroutine ticks_are_round

    subroutine pictures_have_a_size()
        !! 300 pixels a panel and 60 for the title, 560 for one panel alone; lines of text alike.
        call assertTrue(index(script("", ["x"]), "size 1000,560 ") > 0, "one")
        call assertTrue(index(script("", ["x"]), "size 100,30 ") > 0, "one, in letters")
        call assertTrue(index(script("", ["x", "y", "t"]), "size 1000,960 ") > 0, "three")
        call assertTrue(index(script("", ["x", "y", "t"]), "size 100,90 ") > 0, "three, in letters")
    end subroutine pictures_have_a_size

    subroutine a_constant_has_a_range()
        !! gnuplot draws nothing between two equal numbers.
        type(panel_t), allocatable :: panels(:)
        type(error_t), allocatable :: error
        character(:), allocatable :: text

        call new_panels(["x"], ["t", "x"], ["s", "m"], panels, error)
        text = gnuplot_script("it.dat", "", "", ["t", "x"], ["s", "m"], [0.0_dp, 4.0_dp], &
                              [1.0_dp, 4.0_dp], panels)
        call assertTrue(index(text, "set yrange [3.6:4.4]") > 0, text)
        text = gnuplot_script("it.dat", "", "", ["t", "x"], ["s", "m"], [0.0_dp, 0.0_dp], &
                              [1.0_dp, 0.0_dp], panels)
        call assertTrue(index(text, "set yrange [-1.0:1.0]") > 0, text)
        text = gnuplot_script("it.dat", "", "", ["t", "x"], ["s", "m"], [0.0_dp, 2.0_dp], &
                              [1.0_dp, 2.000001_dp], panels)
        call assertTrue(index(text, "set yrange [1.8:2.2") > 0, "ticks alike: "//text)
        text = gnuplot_script("it.dat", "", "", ["t", "x"], ["s", "m"], [0.0_dp, 0.0_dp], &
                              [1.0_dp, 1.0_dp], panels)
        call assertEqual(0, index(text, "yrange"), "a curve that is not constant")
    end subroutine a_constant_has_a_range
end module test_gnuplot
