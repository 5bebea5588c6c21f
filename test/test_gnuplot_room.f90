module test_gnuplot_room
    !! What stands in a picture has room: numbers, legends, curves that lie on each other or stand
    !! still.
    use drawn_columns, only: occurrences
    use funit, only: TestMethod, TestSuite, assertEqual, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_gnuplot, only: gnuplot_script, new_panels, new_series, panel_t, series_t
    use lagrangia_gnuplot_axes, only: add_across, frame_t, number_width
    use lagrangia_gnuplot_script, only: lines_t
    use lagrangia_kinds, only: dp
    use lagrangia_plot_panel, only: shape_legend
    use lagrangia_text, only: to_text
    use lagrangia_value_range, only: range_of, value_range_t
    implicit none (type, external)
    private
    public :: gnuplot_room_suite

contains

    function gnuplot_room_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("gnuplot_room")
        call suite%addTest(TestMethod("numbers_are_as_wide_as_written", &
                                      numbers_are_as_wide_as_written))
        call suite%addTest(TestMethod("numbers_do_not_touch", numbers_do_not_touch))
        call suite%addTest(TestMethod("legends_do_not_touch_titles", legends_do_not_touch_titles))
        call suite%addTest(TestMethod("only_what_coincides_is_wide", only_what_coincides_is_wide))
        call suite%addTest(TestMethod("an_envelope_needs_a_time", an_envelope_needs_a_time))
        call suite%addTest(TestMethod("narrow_panels_have_envelopes_sooner", &
                                      narrow_panels_have_envelopes_sooner))
        call suite%addTest(TestMethod("what_stands_still_is_a_point", what_stands_still_is_a_point))
        call suite%addTest(TestMethod("thin_lines_have_a_legend", thin_lines_have_a_legend))
        call suite%addTest(TestMethod("paths_of_several_files", paths_of_several_files))
    end function gnuplot_room_suite

    subroutine numbers_are_as_wide_as_written()
        !! As C writes them by %g.
        call expect(0.0_dp, 1.0_dp, "0")
        call expect(0.08_dp, 0.02_dp, "0.08")
        call expect(-1.5_dp, 0.5_dp, "-1.5")
        call expect(1000.0_dp, 100.0_dp, "1000")
        call expect(200000.0_dp, 1e5_dp, "200000")
        call expect(1.2e6_dp, 1e5_dp, "1.2e+06")
        call expect(-1.5e140_dp, 5e139_dp, "-1.5e+140")
        call expect(4.05e-10_dp, 1e-12_dp, "4.05e-10")
        call expect(1.5e-5_dp, 5e-6_dp, "1.5e-05")
        call expect(1000000004.0_dp, 2.0_dp, "1000000004")
    contains
        subroutine expect(value, step, written)
            real(dp), intent(in) :: value, step
            character(*), intent(in) :: written

            call assertEqual(len(written), number_width(value, step), message=written)
        end subroutine expect
    end subroutine numbers_are_as_wide_as_written

    subroutine numbers_do_not_touch()
        !! gnuplot's own where ten numbers have room; then as many as have it, told apart.
        call expect(0.0_dp, 1.0_dp, 825, 0.0_dp)
        call expect(-1.0_dp, 1.0_dp, 190, 1.0_dp)
        call expect(-1e15_dp, 1e15_dp, 300, 1e15_dp)
        call expect(1e9_dp, 1e9_dp + 10.0_dp, 825, 2.0_dp)
        call assertTrue(index(curve([1e9_dp, 1e9_dp + 10.0_dp], [0.0_dp, 1.0_dp]), &
                              "set format x '%.11g'") > 0, "told apart")
        call assertTrue(index(curve([0.0_dp, 10.0_dp], [0.0_dp, 1.0_dp]), "set format x '%g'") > &
                        0, "as usual")
        ! As much room is left of the axis as its numbers take.
        call assertTrue(index(curve([0.0_dp, 1.0_dp], [0.0_dp, 1.0_dp]), &
                              "set lmargin at screen 0.1350;") > 0, "as usual")
        call assertTrue(index(curve([0.0_dp, 1.0_dp], [4.0e-10_dp, 4.03e-10_dp]), &
                              "set lmargin at screen 0.1630;") > 0, "4.005e-10")
        call assertTrue(index(curve([0.0_dp, 1.0_dp], [1e5_dp, 1e5_dp + 4.0_dp]), &
                              "set lmargin at screen 0.1510;") > 0, "100000.5")
        call assertTrue(index(curve([0.0_dp, 1.0_dp], [1e5_dp, 1e5_dp + 7.0_dp]), &
                              "set lmargin at screen 0.1350;") > 0, "100001")
    contains
        subroutine expect(low, high, pixels, step)
            real(dp), intent(in) :: low, high, step  !! 0: gnuplot's own
            integer, intent(in) :: pixels
            type(lines_t) :: script
            character(:), allocatable :: tics

            script%text = ""
            call add_across(script, [range_of([low, high])], &
                            frame_t(left=0.0_dp, right=real(pixels, dp)))
            tics = "set xtics "//to_text(step)//new_line("a")
            if (step <= 0.0_dp) call assertEqual(0, index(script%text, "set xtics"), script%text)
            if (step > 0.0_dp) call assertTrue(index(script%text, tics) > 0, script%text//tics)
        end subroutine expect
    end subroutine numbers_do_not_touch

    function curve(x, y) result(text)
        !! The script of a panel of values over others.
        real(dp), intent(in) :: x(:), y(:)
        character(:), allocatable :: text
        type(panel_t), allocatable :: panels(:)
        type(series_t), allocatable :: series(:)
        type(error_t), allocatable :: error

        call new_panels(["x"], ["t", "x"], ["s", "m"], panels, error)
        allocate (series(1))
        call new_series(series(1), "it.dat", "", ["t", "x"], ["s", "m"], &
                        [range_of(x), range_of(y)])
        text = gnuplot_script("it.dat", series, "", "", panels)
    end function curve

    subroutine legends_do_not_touch_titles()
        !! gnuplot takes a letter for 12 pixels: of 32 letters and the line in front, one entry
        !! stands in 840 pixels, not two. Units count where entries have their own.
        type(series_t) :: series(3)
        type(panel_t) :: panel
        type(value_range_t) :: range
        integer :: columns, i, rows

        do i = 1, 3
            call new_series(series(i), "f", "", ["t", "x"], ["s  ", "rad"], [range, range], &
                            repeat("m", 32))
        end do
        panel%curves = 1
        panel%y(1) = 2
        call shape_legend(series, panel, 1, 840.0_dp, columns, rows)
        call assertEqual(1, columns, message="side by side")
        call assertEqual(3, rows, message="below each other")
        panel%curves = 2
        panel%y(:2) = 2
        call shape_legend(series(:1), panel, 1, 190.0_dp, columns, rows)
        call assertEqual(2, columns, message="one unit")
        panel%y(:2) = [1, 2]
        call shape_legend(series(:1), panel, 1, 190.0_dp, columns, rows)
        call assertEqual(1, columns, message="two units")
    end subroutine legends_do_not_touch_titles

    subroutine only_what_coincides_is_wide()
        !! Curves that begin, end and reach where the first does may lie on each other: the first is
        !! wider. Others are as thin as any curve.
        call assertTrue(index(two(1.001_dp), "lw 5 lc") > 0, "alike: "//two(1.001_dp))
        call assertEqual(0, index(two(1.5_dp), "lw 5 lc"), "elsewhere")
        call assertEqual(2, occurrences(two(1.5_dp), "with lines lw 2 lc"), "both thin")
    contains
        function two(factor) result(text)
            real(dp), intent(in) :: factor
            character(:), allocatable :: text
            type(panel_t), allocatable :: panels(:)
            type(series_t), allocatable :: series(:)
            type(error_t), allocatable :: error
            integer :: i

            call new_panels(["x"], ["t", "x"], ["s", "m"], panels, error)
            allocate (series(2))
            do i = 1, 2
                call new_series(series(i), "f"//to_text(i), "", ["t", "x"], ["s", "m"], &
                                [range_of([0.0_dp, 1.0_dp]), &
                                 range_of([-1.0_dp, merge(1.0_dp, factor, i == 1)])], to_text(i))
            end do
            text = gnuplot_script("it.dat", series, "", "", panels)
        end function two
    end subroutine only_what_coincides_is_wide

    subroutine an_envelope_needs_a_time()
        !! Over a first column that goes to and fro, as in a phase portrait, a curve stays a curve,
        !! and its axis goes beyond it.
        real(dp) :: values(0:1000)
        integer :: i

        values = [(cos(3.0_dp*i), i=0, 1000)]
        call assertTrue(index(curve([(real(i, dp), i=0, 1000)], values), "filledcurves") > 0, "t")
        call assertEqual(0, index(curve(values, values), "filledcurves"), "to and fro")
        call assertEqual(0, index(curve(values, values), "set xrange ["), "beyond it")
    end subroutine an_envelope_needs_a_time

    subroutine narrow_panels_have_envelopes_sooner()
        !! 300 turns are told apart in 825 pixels, not in 325, beside a path in the plane.
        character(:), allocatable :: text
        type(panel_t), allocatable :: panels(:)
        type(series_t), allocatable :: series(:)
        type(error_t), allocatable :: error
        integer :: i
        real(dp) :: values(0:300)

        values = [(cos(3.0_dp*i), i=0, 300)]
        call assertEqual(0, index(curve([(real(i, dp), i=0, 300)], values), "filledcurves"), "wide")
        call new_panels(["x  ", "x:y"], ["t", "x", "y"], ["s", "m", "m"], panels, error)
        allocate (series(1))
        call new_series(series(1), "it.dat", "", ["t", "x", "y"], ["s", "m", "m"], &
                        [range_of([0.0_dp, 1.0_dp]), range_of(values), range_of(values)])
        text = gnuplot_script("it.dat", series, "", "", panels)
        call assertTrue(index(text, "filledcurves") > 0, "narrow")
    end subroutine narrow_panels_have_envelopes_sooner

    subroutine what_stands_still_is_a_point()
        !! Of a first column that does not change: gnuplot has no range for it, and no line.
        character(:), allocatable :: text

        text = curve([2.0_dp, 2.0_dp], [1.0_dp, 1.0_dp])
        call assertTrue(index(text, "set xrange [1.8:2.2]") > 0, text)
        call assertTrue(index(text, "using 1:2 with points pt 7") > 0, text)
        call assertTrue(index(curve([0.0_dp, 0.0_dp], [1.0_dp, 2.0_dp]), "set xrange [-1.0:1.0]") &
                        > 0, "zero")
    end subroutine what_stands_still_is_a_point

    subroutine thin_lines_have_a_legend()
        !! Paths that are drawn thin are wide enough in the legend.
        character(:), allocatable :: text
        character(*), parameter :: names(3) = ["t", "x", "v"], units(3) = ["s  ", "m  ", "m/s"]
        type(panel_t), allocatable :: panels(:)
        type(series_t), allocatable :: series(:)
        type(error_t), allocatable :: error
        integer :: i
        real(dp) :: values(0:1000)

        values = [(cos(3.0_dp*i), i=0, 1000)]
        call new_panels(["x:v"], names, units, panels, error)
        allocate (series(2))
        do i = 1, 2
            call new_series(series(i), "f"//to_text(i), "", names, units, &
                            [range_of([0.0_dp, 1.0_dp]), range_of(values), range_of(values)], &
                            "start "//to_text(i))
        end do
        text = gnuplot_script("it.dat", series, "", "", panels)
        call assertEqual(2, occurrences(text, "with lines lw 0.4"), text)
        call assertEqual(2, occurrences(text, "NaN with lines lw 2 lc"), text)
        call assertEqual(2, occurrences(text, "title ""start "), text)
    end subroutine thin_lines_have_a_legend

    subroutine paths_of_several_files()
        !! The axes reach from the lowest to the highest of all, each curve is named by its file and
        !! its column, and a file without the column of the x axis has none.
        type(panel_t), allocatable :: panels(:)
        type(series_t), allocatable :: series(:)
        type(error_t), allocatable :: error
        character(:), allocatable :: text

        call new_panels(["x:y+z"], ["t", "x", "y", "z"], ["s", "m", "m", "m"], panels, error)
        allocate (series(3))
        call new_series(series(1), "a", "", ["t", "x", "y", "z"], ["s", "m", "m", "m"], &
                        [range_of([0.0_dp, 1.0_dp]), range_of([-2.0_dp, 6.0_dp]), &
                         range_of([0.0_dp, 3.0_dp]), range_of([1.0_dp, 2.0_dp])], "A")
        call new_series(series(2), "b", "", ["t", "x", "y", "z"], ["s", "m", "m", "m"], &
                        [range_of([0.0_dp, 1.0_dp]), range_of([2.0_dp, 30.0_dp]), &
                         range_of([1.0_dp, 6.0_dp]), range_of([-2.0_dp, 2.0_dp])], "B")
        call new_series(series(3), "c", "", ["t", "y"], ["s", "m"], &
                        [range_of([0.0_dp, 1.0_dp]), range_of([-90.0_dp, 90.0_dp])], "C")
        text = gnuplot_script("all.dat", series, "all", "", panels)
        call assertTrue(index(text, "# Draws a, b, c as they lie beside this script.") == 1, text)
        call assertTrue(index(text, "set xrange [-3.92:31.92]; set yrange [-3.0176:7.0176]") &
                        > 0, text)
        call assertTrue(index(text, "title ""A: y"" noenhanced") > 0, text)
        call assertTrue(index(text, "title ""B: z"" noenhanced") > 0, text)
        call assertEqual(0, index(text, "data3 using"), text)
    end subroutine paths_of_several_files
end module test_gnuplot_room
