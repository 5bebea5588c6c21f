module test_bench_files
    !! The files of `lagrangia bench --output` say which problem, method and setting a number
    !! stands for, and the picture shows every curve once.
    use funit, only: anyExceptions, assertEqual, assertFalse, assertTrue, TestMethod, TestSuite
    use lagrangia_bench_files, only: write_bench_files
    use lagrangia_bench_problems, only: bench_problem_t, problem_names, read_problems
    use lagrangia_contestant, only: set_by_nothing, set_by_step, set_by_tolerance, &
                                    source_closed_form, source_gsl, source_ours
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_text, only: to_text
    use lagrangia_work_precision, only: curve_t
    use test_scratch, only: contents, new_folder, remove_file
    implicit none (type, external)
    private
    public :: bench_files_suite

    character(1), parameter :: newline = new_line("a")

contains

    function bench_files_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("bench_files")
        call suite%addTest(TestMethod("numbers_are_explained", numbers_are_explained))
        call suite%addTest(TestMethod("panels_lie_side_by_side", panels_lie_side_by_side))
        call suite%addTest(TestMethod("names_keep_apart", names_keep_apart))
        call suite%addTest(TestMethod("methods_are_told_apart", methods_are_told_apart))
        call suite%addTest(TestMethod("errors_are_of_the_worst", errors_are_of_the_worst))
    end function bench_files_suite

    pure function curve(problem, method, source, set_by, points) result(made)
        !! A curve of so many points: errors 1e-1, 1e-2, ..., times 1 us, 2 us, ...
        integer, intent(in) :: problem, source, set_by, points
        character(*), intent(in) :: method
        type(curve_t) :: made
        integer :: k

        made%problem_index = problem
        made%method = method
        made%source = source
        made%set_by = set_by
        made%count = points
        do k = 1, points
            made%points(k)%setting = 0.5_dp**k
            made%points(k)%error = 0.1_dp**k
            made%points(k)%seconds = 1e-6_dp*k
            made%points(k)%evaluations = 100*k
        end do
    end function curve

    subroutine numbers_are_explained()
        !! Every line of the header, every block, and every curve of the picture, in this order.
        type(bench_problem_t), allocatable :: problems(:)
        type(curve_t) :: curves(6)
        type(error_t), allocatable :: error
        character(:), allocatable :: folder, path, text, script
        integer :: i

        call read_problems(problem_names(:2), problems, error)
        curves = [curve(1, "rk4", source_ours, set_by_step, 2), &
                  curve(1, "gauss16", source_ours, set_by_step, 1), &
                  curve(1, "gauss16", source_ours, set_by_tolerance, 3), &
                  curve(1, "closed_form", source_closed_form, set_by_nothing, 1), &
                  curve(2, "rk4", source_ours, set_by_step, 1), &
                  curve(2, "gsl_rk8pd", source_gsl, set_by_tolerance, 2)]
        folder = new_folder("bench_files")
        call write_bench_files(folder, problems, curves, path, error)
        call assertFalse(allocated(error), "written")
        if (anyExceptions()) return
        call assertEqual(folder//"/bench.dat", path)
        text = contents(path)
        script = contents(folder//"/bench.gp")
        call follow(text, "# lagrangia ")
        call follow(text, ": run time against error at the end"//newline//"# build: ")
        call follow(text, newline//"# processor: ")
        call follow(text, newline//"# problem 1: oscillator, "//trim(problems(1)%title)//newline// &
                    "# problem 2: P1, "//trim(problems(2)%title)//newline// &
                    "# method 1: rk4, dt"//newline//"# method 2: gauss16, dt"//newline// &
                    "# method 3: gauss16, tolerance"//newline//"# method 4: closed_form"// &
                    newline//"# method 5: gsl_rk8pd"//newline// &
                    "# set_by 1: none, 2: dt, 3: tolerance"//newline//"# rows: 10 ")
        call follow(text, newline//"# problem[1] method[1] set_by[1] setting[1] error[1] "// &
                    "time[us] evaluations[1]"//newline)
        do i = 1, size(curves)
            call judge_block(text, curves(i), i)
        end do
        call assertEqual("", text, "after the last block")
        call follow(script, "set title ""oscillator: "//trim(problems(1)%title)//", T = "// &
                    to_text(problems(1)%duration)//" s""")
        call follow(script, "set xrange [1.0:10.0]")
        call follow(script, "set x2range [")
        do i = 1, 4
            call follow(script, "index "//to_text(i - 1)//" ")
            if (i == 4) call follow(script, " axes x2y1 ")
            call follow(script, "ls "//to_text(i)//" notitle")
        end do
        call follow(script, "set title ""P1: "//trim(problems(2)%title))
        call follow(script, "index 4 ")
        call follow(script, "ls 1 notitle")
        call follow(script, "index 5 ")
        call follow(script, "ls 5 notitle")
        call follow(script, "NaN with linespoints ls 1 title ""rk4, dt"", NaN with linespoints "// &
                    "ls 2 title ""gauss16, dt"", NaN with linespoints ls 3 title ""gauss16, "// &
                    "tolerance"", NaN with linespoints ls 4 title ""closed_form"", NaN with "// &
                    "linespoints ls 5 title ""gsl_rk8pd"""//newline)
        call assertTrue(remove_file(path), "it was there: "//path)
        call assertTrue(remove_file(folder//"/bench.gp"), "the script was there")
        call assertTrue(remove_file(folder), "nothing else is left")
    end subroutine numbers_are_explained

    function picture_of(problems, curves) result(script)
        !! The script of the benchmark's picture.
        type(bench_problem_t), intent(in) :: problems(:)
        type(curve_t), intent(in) :: curves(:)
        character(:), allocatable :: script, folder, path
        type(error_t), allocatable :: error

        folder = new_folder("bench_picture")
        call write_bench_files(folder, problems, curves, path, error)
        call assertFalse(allocated(error), "written")
        script = contents(folder//"/bench.gp")
        call assertTrue(remove_file(path), "table")
        call assertTrue(remove_file(folder//"/bench.gp"), "script")
        call assertTrue(remove_file(folder), "nothing else is left")
    end function picture_of

    subroutine panels_lie_side_by_side()
        !! Pixels: 40 for the title, rows of 420, legend below; a panel alone is as wide as two,
        !! has 640, and with a few curves names beside them in the place of the legend.
        !! Times in whole decades, the closed form's on the axis above.
        type(bench_problem_t), allocatable :: problems(:)
        type(error_t), allocatable :: error
        character(:), allocatable :: script
        integer :: i

        call read_problems(problem_names(:3), problems, error)
        script = picture_of(problems, [curve(1, "rk4", source_ours, set_by_step, 2), &
                                       curve(1, "closed_form", source_closed_form, &
                                             set_by_nothing, 1), &
                                       curve(3, "gauss16", source_ours, set_by_tolerance, 12)])
        call follow(script, "size 1300,922 ")
        call follow(script, "size 100,60 ")
        do i = 1, 3
            associate (left => 645*modulo(i - 1, 2), upper => 882 - 420*((i - 1)/2))
                call follow(script, margins(left + 100, left + 620, upper - 344, upper - 46, 922))
            end associate
            call follow(script, newline//"set xlabel 'time of a run ('.mu.'s"// &
                        trim(merge("; of closed_form: above", "                       ", &
                                   i == 1))// &
                        ")' noenhanced")
            if (i == 1) call follow(script, newline//"set xrange [1.0:10.0]; set yrange "// &
                                    "[1e-16:2]; unset x2tics; unset label"//newline// &
                                    "set x2range [1.0:1.0]; set x2tics"//newline)
            if (i == 2) call follow(script, newline//"set xrange [*:*]; set yrange")
            if (i == 3) call follow(script, newline//"set xrange [1.0:100.0]; set yrange")
        end do
        call follow(script, margins(10, 1290, 4, 42, 922))
        call follow(script, "unset multiplot"//newline)
        call assertEqual("", script, "behind the picture")
        script = picture_of(problems(:1), [curve(1, "rk4", source_ours, set_by_step, 2)])
        call follow(script, "size 1300,680 ")
        call follow(script, margins(100, 1265, 76, 594, 680))
        call follow(script, newline//"set xrange [1.0:100.0]; set yrange ")
        call follow(script, "set label ""rk4, dt"" noenhanced at first 2.0")  ! us: its end
        call follow(script, " left offset 0.8,0 textcolor ls 1"//newline)
        call assertEqual(0, index(script, "set key"), script)
        script = picture_of(problems(:1), [(curve(1, "m"//to_text(i), source_ours, set_by_step, &
                                                  2), i=1, 6)])
        do i = 1, 6
            call follow(script, "set label ""m"//to_text(i)//", dt"" noenhanced at first ")
        end do
        call assertEqual(0, index(script, newline//"set label"), "each once: "//script)
        script = picture_of(problems(:1), [(curve(1, "m"//to_text(i), source_ours, set_by_step, &
                                                  2), i=1, 7)])
        call assertEqual(0, index(script, newline//"set label"), "too many: "//script)
        call follow(script, "set key")
    end subroutine panels_lie_side_by_side

    subroutine names_keep_apart()
        !! A name is 0.3 decades above the end of its curve, and 0.7 above every name below it that
        !! is less than 1.2 decades aside; an error of 0 is drawn as 1.2e-16.
        character(*), parameter :: names(4) = [character(11) :: "a, dt", "b, dt", "far, dt", &
                                               "closed_form"]
        real(dp), parameter :: x(4) = [2.0_dp, 2.0_dp, 100.0_dp, 1.0_dp]
        real(dp), parameter :: y(4) = [-1.7_dp, -1.0_dp, log10(1.2e-16_dp) + 0.3_dp, -0.3_dp]
        type(bench_problem_t), allocatable :: problems(:)
        type(curve_t) :: curves(5)
        type(error_t), allocatable :: error
        character(:), allocatable :: script, axis
        real(dp) :: at(2)
        integer :: i, status

        call read_problems(problem_names(:1), problems, error)
        curves = [curve(1, "a", source_ours, set_by_step, 2), &
                  curve(1, "b", source_ours, set_by_step, 2), &
                  curve(1, "far", source_ours, set_by_step, 1), &
                  curve(1, "closed_form", source_closed_form, set_by_nothing, 1), &
                  curve(1, "none", source_ours, set_by_step, 0)]
        curves(3)%points(1)%seconds = 1e-4_dp
        curves(3)%points(1)%error = 0.0_dp
        script = picture_of(problems, curves(:4))
        do i = 1, 4
            axis = trim(merge("second", "first ", i == 4))
            associate (k => index(script, "set label """//trim(names(i))//""" noenhanced at "// &
                                  axis//" "))
                call assertTrue(k > 0, "named: "//trim(names(i)))
                if (k == 0) return
                axis = script(k + 27 + len_trim(names(i)) + len(axis):)
            end associate
            call assertEqual(1, index(axis(index(axis, ", first "):), ", first "))
            read (axis(:index(axis, ",") - 1), *, iostat=status) at(1)
            call assertEqual(0, status, axis)
            axis = axis(index(axis, ", first ") + 8:)
            read (axis(:index(axis, " left") - 1), *, iostat=status) at(2)
            call assertEqual(0, status, axis)
            call assertEqual([x(i), y(i)], [at(1), log10(at(2))], 1e-12_dp, trim(names(i)))
        end do
        script = picture_of(problems, curves)
        call assertEqual(0, index(script, "set label ""none"), "no point, no name")
    end subroutine names_keep_apart

    function margins(left, right, bottom, upper, height) result(line)
        !! Of a panel, pixels, in a picture 1300 wide and so high.
        integer, intent(in) :: left, right, bottom, upper, height
        character(:), allocatable :: line
        character(120) :: text

        write (text, "(4(a, f6.4))") "set lmargin at screen ", left/1300.0_dp, &
            "; set rmargin at screen ", right/1300.0_dp, "; set bmargin at screen ", &
            real(bottom, dp)/height, "; set tmargin at screen ", real(upper, dp)/height
        line = trim(text)//newline
    end function margins

    subroutine methods_are_told_apart()
        !! Ours by 16 colours and 15 marks, no two alike; GSL's dashed and the closed form whole,
        !! both black; of each as many lines in the legend as it takes.
        type(bench_problem_t), allocatable :: problems(:)
        type(error_t), allocatable :: error
        type(curve_t), allocatable :: curves(:)
        character(:), allocatable :: script, line
        character(24) :: looks(19)
        integer :: i, at

        call read_problems(problem_names(:1), problems, error)
        allocate (curves(19))
        do i = 1, 17
            curves(i) = curve(1, "m"//to_text(i), source_ours, set_by_step, 1)
        end do
        curves(18) = curve(1, "gsl_rk4", source_gsl, set_by_tolerance, 1)
        curves(19) = curve(1, "closed_form", source_closed_form, set_by_nothing, 1)
        script = picture_of(problems, curves)
        call follow(script, "size 1300,826 ")  ! 40 + 640 + 5*26 + 16
        do i = 1, 19
            line = "set style line "//to_text(i)//" lw 2 ps 1.1 pt "// &
                   to_text(modulo(i - 1, 15) + 1)//" lc rgb '"
            call follow(script, line)
            at = index(script, newline)
            looks(i) = to_text(modulo(i - 1, 15) + 1)//script(:at - 1)
            if (i > 17) call assertEqual("#000000' dt "//merge("2", "1", i == 18), script(:at - 1))
            if (i <= 17) call assertEqual("' dt 1", script(8:at - 1), "whole: "//script(:at - 1))
            call assertFalse(any(looks(:i - 1) == looks(i)), "as another: "//looks(i))
        end do
    end subroutine methods_are_told_apart

    subroutine follow(text, part)
        !! `part` comes in `text`, which is then what is behind it.
        character(:), allocatable, intent(inout) :: text
        character(*), intent(in) :: part
        integer :: at

        at = index(text, part)
        call assertTrue(at > 0, "not there: "//part)
        if (at > 0) text = text(at + len(part):)
    end subroutine follow

    subroutine judge_block(text, expected, i)
        !! The rows of curve `i`, and two blank lines unless it is the last.
        character(:), allocatable, intent(inout) :: text
        type(curve_t), intent(in) :: expected
        integer, intent(in) :: i
        integer, parameter :: method(6) = [1, 2, 3, 4, 1, 5]
        real(dp) :: row(7)
        integer :: k, status

        do k = 1, expected%count
            read (text(:index(text, newline)), *, iostat=status) row
            call assertEqual(0, status, "a row of 7 numbers")
            if (status /= 0) return
            call assertEqual([real(dp) :: expected%problem_index, method(i), expected%set_by, &
                              expected%points(k)%setting, expected%points(k)%error, k, 100*k], &
                             row, 1e-15_dp*k, "row "//to_text(k)//" of curve "//to_text(i))
            text = text(index(text, newline) + 1:)
        end do
        if (i == 6) return
        call assertEqual(newline//newline, text(:2), "two blank lines")
        text = text(3:)
    end subroutine judge_block

    subroutine errors_are_of_the_worst()
        !! Whichever coordinate or velocity is off, to either side, all others being right.
        type(bench_problem_t), allocatable :: problems(:)
        type(error_t), allocatable :: error
        real(dp), allocatable :: state(:)
        integer :: i, k, n, way

        call read_problems(problem_names, problems, error)
        do i = 1, size(problems)
            associate (p => problems(i))
                n = size(p%q_end)
                do k = 1, 2*n
                    do way = -1, 1, 2
                        state = [p%q_end, p%v_end]
                        state(k) = state(k) + 0.125_dp*way
                        call assertEqual(0.125_dp, p%error_of(state(:n), state(n + 1:)), &
                                         2.0_dp*spacing(maxval(abs(state))), p%name)
                    end do
                end do
            end associate
        end do
    end subroutine errors_are_of_the_worst
end module test_bench_files
