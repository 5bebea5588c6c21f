module test_gnuplot_scales
    !! Scales, ranges and curves in gnuplot scripts, read back.
    use drawn_columns, only: names, occurrences, one_curve, script, units
    use funit, only: TestMethod, TestSuite, assertEqual, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_gnuplot, only: gnuplot_script, new_panels, new_series, panel_t, series_t
    use lagrangia_gnuplot_axes, only: add_decades, add_spread, add_ticks
    use lagrangia_gnuplot_script, only: lines_t
    use lagrangia_kinds, only: dp
    use lagrangia_plot_panel, only: aspect
    use lagrangia_value_range, only: range_of
    use test_gnuplot_room, only: gnuplot_room_suite
    implicit none (type, external)
    private
    public :: gnuplot_scales_suite

contains

    function gnuplot_scales_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("gnuplot_scales")
        call suite%addTest(TestMethod("one_axis_of_time", one_axis_of_time))
        call suite%addTest(TestMethod("lengths_share_a_scale", lengths_share_a_scale))
        call suite%addTest(TestMethod("a_constant_has_a_range", a_constant_has_a_range))
        call suite%addTest(TestMethod("magnitudes_on_decades", magnitudes_on_decades))
        call suite%addTest(TestMethod("fast_oscillations_have_envelopes", &
                                      fast_oscillations_have_envelopes))
        call suite%addTest(TestMethod("several_files_in_one_picture", several_files_in_one_picture))
        call suite%addTest(TestMethod("only_what_is_seen_is_to_scale", &
                                      only_what_is_seen_is_to_scale))
        call suite%addTest(TestMethod("all_curves_have_one_size", all_curves_have_one_size))
        call suite%addTest(TestMethod("ticks_are_round", ticks_are_round))
        call suite%addTest(TestMethod("an_axis_has_two_numbers", an_axis_has_two_numbers))
        call suite%addTest(TestMethod("dense_paths_are_thin", dense_paths_are_thin))
        call suite%addTest(TestMethod("low_panels_have_few_ticks", low_panels_have_few_ticks))
        call suite%addTest(TestMethod("pictures_have_a_size", pictures_have_a_size))
        call suite%addTest(TestMethod("numbers_beside_an_axis_differ", &
                                      numbers_beside_an_axis_differ))
        call suite%addTest(TestMethod("rounding_is_no_range", rounding_is_no_range))
        call suite%addTest(gnuplot_room_suite())
    end function gnuplot_scales_suite

    function path_in_plane(width, height) result(text)
        !! The script of a path of that size, behind a panel over the time.
        real(dp), intent(in) :: width, height  !! m
        character(:), allocatable :: text
        type(panel_t), allocatable :: panels(:)
        type(series_t), allocatable :: series(:)
        type(error_t), allocatable :: error

        call new_panels(["x  ", "x:y"], ["t", "x", "y"], ["s", "m", "m"], panels, error)
        allocate (series(1))
        call new_series(series(1), "it.dat", "", ["t", "x", "y"], ["s", "m", "m"], &
                        [range_of([0.0_dp, 1.0_dp]), range_of([1.0_dp, 1.0_dp + width]), &
                         range_of([1.0_dp, 1.0_dp + height])])
        text = gnuplot_script("it.dat", series, "", "", panels)
    end function path_in_plane

    subroutine only_what_is_seen_is_to_scale()
        !! One side may be twelve times the other.
        call assertTrue(index(path_in_plane(11.9_dp, 1.0_dp), "ratio -1") > 0, "wide")
        call assertEqual(0, index(path_in_plane(12.1_dp, 1.0_dp), "ratio -1"), "too wide")
        call assertTrue(index(path_in_plane(1.0_dp, 11.9_dp), "ratio -1") > 0, "high")
        call assertEqual(0, index(path_in_plane(1.0_dp, 12.1_dp), "ratio -1"), "too high")
        call assertEqual(0, index(path_in_plane(0.0_dp, 1.0_dp), "ratio -1"), "a line")
        call assertEqual(0, index(path_in_plane(0.0_dp, 0.0_dp), "ratio -1"), "a point")
    end subroutine only_what_is_seen_is_to_scale

    subroutine all_curves_have_one_size()
        !! From the lowest of all to the highest of all: 6 m wide, 5 m high.
        type(panel_t), allocatable :: panels(:)
        type(series_t), allocatable :: series(:)
        type(error_t), allocatable :: error
        integer :: first, k

        call new_panels(["x:y"], ["t", "x", "y"], ["s", "m", "m"], panels, error)
        allocate (series(2))
        do first = 1, 2
            k = 3 - first
            call new_series(series(first), "a.dat", "a", ["t", "x", "y"], ["s", "m", "m"], &
                            [range_of([0.0_dp, 1.0_dp]), range_of([-1.0_dp, 3.0_dp]), &
                             range_of([0.0_dp, 3.0_dp])])
            call new_series(series(k), "b.dat", "b", ["t", "x", "y"], ["s", "m", "m"], &
                            [range_of([0.0_dp, 1.0_dp]), range_of([1.0_dp, 5.0_dp]), &
                             range_of([1.0_dp, 5.0_dp])])
            call assertEqual(5.0_dp/6.0_dp, aspect(series, panels(1)), epsilon(1.0_dp), &
                             "whichever is the first")
        end do
    end subroutine all_curves_have_one_size

    subroutine ticks_are_round()
        !! 1, 2 or 5 times a power of ten, three to seven of them, up to each of the ranges; of the
        !! wider side of a path that is drawn to scale; fewer below it, where there is no room.
        real(dp), parameter :: ranges(7) = [0.29_dp, 0.31_dp, 0.59_dp, 0.61_dp, 1.49_dp, 1.51_dp, &
                                            2.9_dp]
        character(4), parameter :: steps(7) = ["0.05", "0.1 ", "0.1 ", "0.2 ", "0.2 ", "0.5 ", &
                                               "0.5 "]
        character(:), allocatable :: text
        character(8) :: below
        integer :: first, i, k

        do i = 1, size(ranges)
            do k = 1, 2
                text = path_in_plane(ranges(i)/k, ranges(i)/(3 - k))
                call assertTrue(index(text, "; set ytics "//trim(steps(i))//new_line("a")) > 0, &
                                steps(i)//text)
                first = index(text, "ratio -1; set xtics ") + 20
                below = text(first:first + index(text(first:), ";") - 2)
                call assertTrue(number(below) >= number(steps(i)) .and. &
                                any(abs(number(below) - [0.05_dp, 0.1_dp, 0.2_dp, 0.5_dp]) &
                                    < 1e-9_dp), &
                                below)
            end do
        end do
    end subroutine ticks_are_round

    subroutine an_axis_has_two_numbers()
        !! Where the step of the wider side leaves one or none on the other, the next smaller one
        !! with two: here of the axis that is 130 pixels high.
        character(:), allocatable :: text
        real(dp) :: width, y(2)
        integer :: i, position
        character(8) :: step

        do i = 1, 40
            width = 1.13_dp**i
            text = path_in_plane(width, 0.1_dp*width)
            text = text(index(text, "set size ratio -1; "):)
            position = index(text, "; set ytics ") + len("; set ytics ")
            step = text(position:position - 1 + index(text(position:), new_line("a")) - 1)
            call read_range(text, "; set yrange [", y)
            call assertTrue(ticks(y, number(step)) >= 2, "two: "//text)
            call assertTrue(ticks(y, number(step)) <= 5, "no more than there is room for: "//text)
        end do
    end subroutine an_axis_has_two_numbers

    pure function ticks(range, step) result(count)
        !! Multiples of the step in a range.
        real(dp), intent(in) :: range(2), step
        integer :: count

        count = floor(range(2)/step) - ceiling(range(1)/step) + 1
    end function ticks

    pure function number(text) result(x)
        !! A number in a text.
        character(*), intent(in) :: text
        real(dp) :: x

        read (text, *) x
    end function number

    subroutine low_panels_have_few_ticks()
        !! From 200 pixels of three panels on; two have room for gnuplot's own.
        call assertEqual(3, occurrences(script("", ["x", "y", "x"]), "; set ytics autofreq"), &
                         "each begins anew")
        call assertTrue(index(script("", ["x", "y", "x"]), new_line("a")//"set ytics ") > 0, "low")
        call assertEqual(0, index(script("", ["x", "y"]), new_line("a")//"set ytics "), "high")
    end subroutine low_panels_have_few_ticks

    subroutine pictures_have_a_size()
        !! A panel over the time has 430 pixels alone, 260 of two, 200 of more; with 50 for the
        !! title, 76 below the lowest and 22 below each other one. Lines of text alike. What is as
        !! high as wide stands beside; all are 1000 wide, so that letters have one size on slides.
        call assertTrue(index(script("", ["x"]), "size 1000,556 ") > 0, "one")
        call assertTrue(index(script("", ["x"]), "size 100,30 ") > 0, "one, in letters")
        call assertTrue(index(script("", ["x", "y"]), "size 1000,668 ") > 0, "two")
        call assertTrue(index(script("", ["x", "y", "x"]), "size 1000,770 ") > 0, "three")
        call assertTrue(index(script("", ["x", "y", "x"]), "size 100,90 ") > 0, "three, in letters")
        call assertTrue(index(path_in_plane(1.0_dp, 1.0_dp), "size 1000,") > 0, "beside")
        call assertTrue(index(path_in_plane(1.0_dp, 1.0_dp), "rmargin at screen 0.4600") > 0, &
                        "the left half")
        call assertTrue(index(path_in_plane(3.0_dp, 1.0_dp), "size 1000,") > 0, "below")
    end subroutine pictures_have_a_size

    subroutine one_axis_of_time()
        !! Only the lowest of panels over the time has its numbers and its label, and that above
        !! one of another axis; the range is that of the run.
        character(:), allocatable :: text

        text = script("", [character(12) :: "x", "y", "theta"])
        call assertEqual(1, occurrences(text, "; set xlabel"), text)
        call assertEqual(2, occurrences(text, "set format x ''; unset xlabel"), text)
        call assertEqual(3, occurrences(text, "set xrange [0.0:9.0]"), text)
        call assertTrue(index(text, "; set xlabel") > index(text, "plot data using 1:5"), text)
        text = script("", [character(12) :: "x", "theta:x_dot", "y"])
        call assertEqual(3, occurrences(text, "; set xlabel"), text)
    end subroutine one_axis_of_time

    subroutine lengths_share_a_scale()
        !! A path in the plane is drawn to scale, its axes being as long as the panel wants; time
        !! series and other units are not.
        character(:), allocatable :: text
        real(dp) :: x(2), y(2), sides(4)

        text = script("", [character(4) :: "x:y", "x"])
        call assertTrue(index(text, "set size ratio -1; set xtics 1.0; set ytics 1.0") > 0, text)
        call read_range(text, "set xrange [", x)
        call read_range(text, "; set yrange [", y)
        call read_margins(text, sides)
        ! Five digits of each end of an axis, four of each margin.
        call assertEqual((x(2) - x(1))/(sides(2) - sides(1)), &
                         (y(2) - y(1))/(sides(4) - sides(3)), tolerance=0.02_dp)
        call assertTrue(x(1) < -2.0_dp .and. x(2) > 2.0_dp, "all of x: "//text)
        call assertTrue(y(1) < -1.0_dp .and. y(2) > 1.0_dp, "all of y: "//text)
        call assertEqual(0, index(script("", ["y"]), "ratio -1"), "over the time")
        call assertEqual(0, index(script("", [character(7) :: "x:theta"]), "ratio -1"), "an angle")
        call assertEqual(0, index(script("", [character(9) :: "theta:x"]), "ratio -1"), "over it")
        call assertEqual(0, index(script("", [character(9) :: "x:y+theta"]), "ratio -1"), "with it")
    end subroutine lengths_share_a_scale

    subroutine a_constant_has_a_range()
        !! gnuplot draws nothing between two equal numbers.
        character(:), allocatable :: text

        text = constant([4.0_dp, 4.0_dp])
        call assertTrue(index(text, "set yrange [3.6:4.4]") > 0, text)
        text = constant([0.0_dp, 0.0_dp])
        call assertTrue(index(text, "set yrange [-1.0:1.0]") > 0, text)
        text = constant([2.0_dp, 2.000001_dp])
        call assertTrue(index(text, "set yrange [1.7999999:2.2") > 0, "ticks alike: "//text)
        text = constant([0.0_dp, 1.0_dp])
        call assertEqual(0, index(text, "yrange"), "a curve that is not constant")
    contains
        function constant(values) result(text)
            real(dp), intent(in) :: values(2)
            character(:), allocatable :: text

            text = one_curve("it.dat", "", ["t", "x"], ["s", "m"], values)
        end function constant
    end subroutine a_constant_has_a_range

    subroutine magnitudes_on_decades()
        !! Drifts and errors: a logarithmic axis of whole decades; a zero and what is nearly zero is
        !! drawn below all others, where a tick says so.
        character(:), allocatable :: text
        character(*), parameter :: nearly = char(226)//char(137)//char(136)
        type(lines_t) :: lines
        integer :: edge, first

        text = script("", ["error"])
        call assertTrue(index(text, "set logscale y; set yrange [0.6e-13:1.01e-9]; set ytics ("// &
            """10^{-9}"" 1e-9, ""10^{-10}"" 1e-10, ""10^{-11}"" 1e-11, ""10^{-12}"" 1e-12)") > 0, &
                        text)
        call assertTrue(index(text, "using 1:(abs($6)) with") > 0, text)
        call assertTrue(index(text, "set ylabel ""error""") > 0, text)
        text = script("", [character(20) :: "energy_drift"])
        call assertTrue(index(text, "yrange [0.6e-11:1.01e-9]; set ytics (""0"" 1e-11, "// &
                              """10^{-9}"" 1e-9, ""10^{-10}"" 1e-10)") > 0, text)
        call assertTrue(index(text, "using 1:(abs($7) < 1e-10 ? 1e-11 : abs($7)) with") > 0, text)
        call assertTrue(index(text, "set ylabel ""|energy drift|""") > 0, text)
        text = script("", [character(20) :: "energy_drift+error"])
        call assertTrue(index(text, "set ylabel ""|relative drift|, error""") > 0, text)
        call assertTrue(index(text, "title ""energy""") > 0, text)
        call assertTrue(index(text, "using 1:(abs($6) < 1e-13 ? 1e-14 : abs($6)) with") > 0, text)
        text = script("", [character(20) :: "energy_drift+x"])
        call assertEqual(0, index(text, "set logscale y"), "beside a length")
        text = one_curve("it.dat", "", [character(5) :: "t", "error"], ["s", "1"], &
                         [-2e-22_dp, 3e-4_dp, -7e-2_dp])
        call assertTrue(index(text, "set yrange [0.6e-19:1.01e-1]; set ytics ("""//nearly// &
                              "0"" 1e-19, ""10^{-1}"" 1e-1, ""10^{-4}"" 1e-4, ") > 0, text)
        call assertTrue(index(text, "using 1:(abs($2) < 1e-18 ? 1e-19 : abs($2)) with") > 0, text)
        text = one_curve("it.dat", "", [character(5) :: "t", "error"], ["s", "1"], &
                         [0.0_dp, 0.0_dp])
        call assertTrue(index(text, "yrange [0.6e-19:1.01e-15]; set ytics (""0"" 1e-19, ") > 0, &
                        text)
        lines%text = ""
        call add_decades(lines, [range_of([3e-7_dp, 2e-5_dp]), range_of([2e-12_dp, 5e-9_dp]), &
                                 range_of([0.0_dp, 0.0_dp])], first, edge)
        call assertTrue(index(lines%text, "yrange [0.6e-13:1.01e-4]") > 0, "from the least of "// &
                        "all curves to the largest: "//lines%text)
    end subroutine magnitudes_on_decades

    subroutine fast_oscillations_have_envelopes()
        !! What would be a solid block is the band between its least and largest values.
        character(:), allocatable :: text
        real(dp) :: values(0:4000)
        integer :: i

        values = [(cos(3.0_dp*i), i=0, 4000)]
        text = one_curve("it.dat", "", ["t", "x"], ["s", "m"], values)
        call assertTrue(index(text, "array low1_1[200]; array high1_1[200]") > 0, text)
        call assertTrue(index(text, "start1_1 = 0.0; part1_1 = (4000.0 - start1_1)/200") > 0, text)
        call assertTrue(index(text, "stats data using (v = $2, i = int(($1 - start1_1)") > 0, text)
        call assertTrue(index(text, "plot low1_1 using (middle1_1($1)):(low1_1[int($1)]):"// &
                              "(high1_1[int($1)]) with filledcurves") > 0, text)
        call assertEqual(0, index(text, "plot data"), text)
        text = one_curve("it.dat", "", ["t", "x"], ["s", "m"], values(:400))
        call assertEqual(0, index(text, "array"), "few turns: "//text)
        call assertTrue(index(text, "plot data using 1:2") > 0, text)
        text = one_curve("it.dat", "", [character(5) :: "t", "error"], ["s", "1"], values)
        call assertTrue(index(text, "stats data using (v = (abs($2)), i") > 0, text)
    end subroutine fast_oscillations_have_envelopes

    subroutine dense_paths_are_thin()
        !! A path that turns round more than 400 times is no solid block either.
        real(dp) :: values(0:430)
        integer :: i

        values = [(cos(3.0_dp*i), i=0, 430)]
        call assertTrue(index(phase_portrait(values), "using 2:3 with lines lw 0.4 lc") > 0, "many")
        call assertTrue(index(phase_portrait(values(:400)), "using 2:3 with lines lw 2 lc") > 0, &
                        "few")
    end subroutine dense_paths_are_thin

    function phase_portrait(values) result(text)
        !! The script for `values` over themselves.
        real(dp), intent(in) :: values(:)
        character(:), allocatable :: text
        character(*), parameter :: names(3) = ["t", "x", "v"], units(3) = ["s  ", "m  ", "m/s"]
        type(panel_t), allocatable :: panels(:)
        type(series_t), allocatable :: series(:)
        type(error_t), allocatable :: error

        call new_panels(["x:v"], names, units, panels, error)
        allocate (series(1))
        call new_series(series(1), "it.dat", "", names, units, [range_of([0.0_dp, 1.0_dp]), &
                                                                range_of(values), range_of(values)])
        text = gnuplot_script("it.dat", series, "", "", panels)
    end function phase_portrait

    subroutine several_files_in_one_picture()
        !! A curve a file in each panel, those of the same name; one legend for all.
        type(panel_t), allocatable :: panels(:)
        type(series_t), allocatable :: series(:)
        type(error_t), allocatable :: error
        character(:), allocatable :: text
        integer :: i

        call new_panels([character(7) :: "x", "theta"], names, units, panels, error)
        allocate (series(3))
        do i = 1, 2
            call new_series(series(i), "f"//char(96 + i), "", names, units, &
                            spread(range_of([0.0_dp, 1.0_dp]), 1, size(names)), "it's "//char(64+i))
        end do
        call new_series(series(3), "c", "", ["x", "t"], ["m", "s"], &
                        spread(range_of([-1.0_dp, 8.0_dp]), 1, 2), "C")
        text = gnuplot_script("all.dat", series, "all", "", panels)
        call assertTrue(index(text, "data = folder.""fa""") > 0, text)
        call assertTrue(index(text, "data2 = folder.""fb""") > 0, text)
        call assertTrue(index(text, "data3 = folder.""c""") > 0, text)
        call assertTrue(index(text, "data using 1:2 with lines lw 2 lc rgb '#0072b2' title "// &
                              """it's A"" noenhanced") > 0, text)
        call assertTrue(index(text, "data2 using 1:2 with lines lw 2 lc rgb '#d55e00' title "// &
                              """it's B"" noenhanced") > 0, text)
        call assertTrue(index(text, "data3 using 2:1 with lines lw 2 lc rgb '#009e73' title "// &
                              """C"" noenhanced") > 0, text)
        call assertTrue(index(text, "data2 using 1:3 with lines lw 2 lc rgb '#d55e00' notitle") > &
                        0, text)
        call assertEqual(5, occurrences(text, " using "), "the third has no theta: "//text)
        call assertTrue(index(text, "set xrange [-1.0:8.0]") > 0, text)
    end subroutine several_files_in_one_picture

    subroutine read_range(text, before, range)
        !! The two numbers `[a:b]` behind the first `before`.
        character(*), intent(in) :: text, before
        real(dp), intent(out) :: range(2)
        integer :: first, middle

        first = index(text, before) + len(before)
        middle = first + index(text(first:), ":") - 1
        read (text(first:middle - 1), *) range(1)
        read (text(middle + 1:middle + index(text(middle:), "]") - 2), *) range(2)
    end subroutine read_range

    subroutine read_margins(text, sides)
        !! Left, right, bottom and top of the first panel, pixels.
        character(*), intent(in) :: text
        real(dp), intent(out) :: sides(4)
        character(1), parameter :: names(4) = ["l", "r", "b", "t"]
        real(dp) :: size(2)
        integer :: first, i

        do i = 1, 4
            first = index(text, "set "//names(i)//"margin at screen ") + 22
            read (text(first:first + 5), *) sides(i)
        end do
        first = index(text, "pngcairo enhanced size ") + 23
        read (text(first:first + index(text(first:), " ") - 2), *) size
        sides = sides*[size(1), size(1), size(2), size(2)]
    end subroutine read_margins

    subroutine numbers_beside_an_axis_differ()
        !! They have six digits, or as many as a step between them needs; few of those are drawn
        !! that take much room.
        character(*), parameter :: usual = "set format x '%.6g'; set xtics autofreq"

        call axis_has(0.0_dp, 3.0_dp, usual, .false.)
        call axis_has(1.0e6_dp, 1.0e9_dp, usual//"|set xtics 200000000.0", .true.)
        call axis_has(1.0e-9_dp, 2.0e-9_dp, usual//"|set xtics 2e-10", .true.)
        call axis_has(1.0_dp, 1.001_dp, usual, .false.)
        call axis_has(1.0_dp, 1.00004_dp, "set format x '%.7g'; set xtics autofreq|"// &
                      "set xtics 1e-5", .true.)
        call axis_has(123456789.0_dp, 123456799.0_dp, "set format x '%.10g'; set xtics "// &
                      "autofreq|set xtics 5.0", .true.)
        call axis_has(0.0_dp, 0.0_dp, usual, .false.)
        call axis_has(huge(1.0_dp), -huge(1.0_dp), usual, .false.)
    end subroutine numbers_beside_an_axis_differ

    subroutine axis_has(low, high, expected, much_room)
        !! Assert what an axis from `low` to `high` gets, `|` between two lines.
        real(dp), intent(in) :: low, high
        character(*), intent(in) :: expected
        logical, intent(in) :: much_room
        type(lines_t) :: lines
        logical :: long
        integer :: i

        lines%text = ""
        call add_ticks(lines, "x", low, high, long)
        do i = 1, len(lines%text)
            if (lines%text(i:i) == new_line("a")) lines%text(i:i) = "|"
        end do
        call assertEqual(expected//"|", lines%text)
        call assertTrue(long .eqv. much_room, expected)
    end subroutine axis_has

    subroutine rounding_is_no_range()
        !! What is constant but for rounding gets a tenth to either side; nothing, and all else,
        !! what gnuplot finds.
        call range_begins(1.0_dp, 2.0_dp, "set yrange [*:*]")
        call range_begins(huge(1.0_dp), -huge(1.0_dp), "set yrange [*:*]")
        call range_begins(10.0_dp, 10.0_dp*(1.0_dp + 2e-11_dp), "set yrange [*:*]")
        call range_begins(10.0_dp, 10.0_dp, "set yrange [9.0:11.0]; set format y '%g'; set ytics")
        call range_begins(0.0_dp, 0.0_dp, "set yrange [-1.0:1.0]; set format y '%g'; set ytics")
        call range_begins(-4.0_dp, -4.0_dp + 1e-15_dp, "set yrange [-4.4:-3.")
    end subroutine rounding_is_no_range

    subroutine range_begins(low, high, expected)
        !! Assert how the range from `low` to `high` begins.
        real(dp), intent(in) :: low, high
        character(*), intent(in) :: expected
        type(lines_t) :: lines

        lines%text = ""
        call add_spread(lines, "y", low, high)
        call assertEqual(1, index(lines%text, expected), lines%text)
    end subroutine range_begins
end module test_gnuplot_scales
