module lagrangia_bench_files
    !! Run time against error as a data file and a picture.
    use lagrangia_bench_problems, only: bench_problem_t
    use lagrangia_contestant, only: set_by_names, source_closed_form, source_gsl
    use lagrangia_data_files, only: data_path, script_path
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t
    use lagrangia_gnuplot_script, only: begin_script, gnuplot_string, lines_t
    use lagrangia_kinds, only: dp
    use lagrangia_machine, only: processor
    use lagrangia_output_file, only: commit_both, output_file_t, refuse_unwritable
    use lagrangia_places, only: places_t
    use lagrangia_scene_claims, only: claim_table
    use lagrangia_scene_reader, only: names_scene
    use lagrangia_shipped, only: find_scene
    use lagrangia_text, only: to_text, word_t
    use lagrangia_text_table, only: text_table_t
    use lagrangia_version, only: build_text, version
    use lagrangia_work_precision, only: curve_t
    implicit none (type, external)
    private
    public :: check_bench_files, write_bench_files

    character(*), parameter :: file_name = "bench.dat"
    integer, parameter :: header_length = 400
    character(*), parameter :: blank_lines = new_line("a")//new_line("a")
    integer, parameter :: width = 1300, top = 40  !! pixels of the picture
    integer, parameter :: most_labels = 6  !! curves that have their names beside them
    character(7), parameter :: colours(16) = ["#1f77b4", "#ff7f0e", "#d62728", "#2ca02c", &
        "#9467bd", "#17becf", "#8c564b", "#e377c2", "#bcbd22", "#7f7f7f", "#393b79", "#ff9896", &
        "#6b8e23", "#00a087", "#b8860b", "#8b008b"]

contains

    subroutine check_bench_files(folder, names, error)
        !! Fails where the files could not be written now, or one of them is a scene that is read:
        !! before hours are spent on what they hold.
        character(*), intent(in) :: folder  !! where the files go
        type(word_t), intent(in) :: names(:)  !! of systems and scenes that are measured
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        character(:), allocatable :: path
        type(places_t) :: places
        integer :: i

        do i = 1, size(names)
            if (.not. names_scene(names(i)%text)) cycle
            call find_scene(names(i)%text, path, error)
            if (.not. allocated(error)) call places%add(path, "scene", "", error)
            if (allocated(error)) return
        end do
        path = data_path(folder, file_name, "text")
        call claim_table(path, "data", "", places, error)
        if (.not. allocated(error)) call refuse_unwritable(path, error)
        if (.not. allocated(error)) call refuse_unwritable(script_path(path), error)
    end subroutine check_bench_files

    subroutine write_bench_files(folder, problems, curves, path, error)
        !! `folder/bench.dat` and `folder/bench.gp`; a block of the data file, two blank lines
        !! apart from the next, is one method on one problem.
        character(*), intent(in) :: folder  !! where the files go
        type(bench_problem_t), intent(in) :: problems(:)  !! in the order of their numbers
        type(curve_t), intent(in) :: curves(:)  !! as they were measured
        character(:), allocatable, intent(out) :: path  !! of the data file
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        character(name_length), allocatable :: methods(:)
        type(output_file_t) :: script
        type(text_table_t) :: table
        character(name_length), parameter :: names(*) = [character(name_length) :: "problem", &
            "method", "set_by", "setting", "error", "time", "evaluations"]
        character(2), parameter :: units(*) = ["1 ", "1 ", "1 ", "1 ", "1 ", "us", "1 "]
        integer :: i, k

        call find_methods(curves, methods)
        path = data_path(folder, file_name, "text")
        call table%file%open(path, error)
        if (allocated(error)) return
        call table%begin(header(problems, methods), names, units, error)
        if (allocated(error)) return
        do i = 1, size(curves)
            if (i > 1) call table%file%write(blank_lines)
            do k = 1, curves(i)%count
                associate (p => curves(i)%points(k))
                    call table%row([real(curves(i)%problem_index, dp), &
                                    real(findloc(methods, label(curves(i)), 1), dp), &
                                    real(curves(i)%set_by, dp), p%setting, p%error, &
                                    1e6_dp*p%seconds, real(p%evaluations, dp)])
                end associate
            end do
        end do
        call table%finish("rows: "//to_text(sum(curves%count)), error)
        if (allocated(error)) return
        call script%open(script_path(path), error)
        if (allocated(error)) call table%file%abandon()
        if (allocated(error)) return
        call script%write(bench_script(problems, methods, curves))
        call commit_both(table%file, script, error)
    end subroutine write_bench_files

    function header(problems, methods) result(lines)
        !! What the numbers of problems, methods and settings stand for.
        type(bench_problem_t), intent(in) :: problems(:)
        character(*), intent(in) :: methods(:)
        character(header_length) :: lines(4 + size(problems) + size(methods))
        integer :: i, n

        lines(1) = "lagrangia "//version//": run time against error at the end"
        lines(2) = "build: "//build_text()
        lines(3) = "processor: "//processor()
        n = 3
        do i = 1, size(problems)
            lines(n + i) = "problem "//to_text(i)//": "//trim(problems(i)%name)//", "// &
                           problems(i)%title
        end do
        n = n + size(problems)
        do i = 1, size(methods)
            lines(n + i) = "method "//to_text(i)//": "//methods(i)
        end do
        lines(size(lines)) = "set_by 1: none"
        do i = 2, size(set_by_names)
            lines(size(lines)) = trim(lines(size(lines)))//", "//to_text(i)//": "//set_by_names(i)
        end do
    end function header

    pure subroutine find_methods(curves, methods)
        !! Each label once, in the order of appearance.
        type(curve_t), intent(in) :: curves(:)
        character(name_length), allocatable, intent(out) :: methods(:)
        character(name_length) :: found(size(curves))
        integer :: i, n

        n = 0
        do i = 1, size(curves)
            if (any(found(:n) == label(curves(i)))) cycle
            n = n + 1
            found(n) = label(curves(i))
        end do
        allocate (methods, source=found(:n))
    end subroutine find_methods

    pure function label(curve) result(text)
        !! In the picture; a method that comes by step and by tolerance has two.
        type(curve_t), intent(in) :: curve
        character(name_length) :: text

        text = curve%method
        if (curve%source == source_closed_form .or. curve%source == source_gsl) return
        text = trim(text)//", "//set_by_names(curve%set_by)
    end function label

    function bench_script(problems, methods, curves) result(text)
        !! A panel a problem, both axes logarithmic, one legend below all; of a few curves on one
        !! problem each has its name beside it, for slides.
        type(bench_problem_t), intent(in) :: problems(:)
        character(*), intent(in) :: methods(:)
        type(curve_t), intent(in) :: curves(:)
        character(:), allocatable :: text
        type(lines_t) :: script
        integer :: across, down, height, i, legend, panel
        logical :: at_line

        across = merge(1, 2, size(problems) == 1)
        down = (size(problems) + across - 1)/across
        at_line = size(problems) == 1 .and. size(curves) <= most_labels
        legend = 26*((size(methods) + 3)/4) + 16
        if (at_line) legend = 0
        panel = merge(640, 420, across == 1)
        height = top + panel*down + legend
        call begin_script(script, file_name, width, height, 30*down)
        call script%add("data = folder."//gnuplot_string(file_name))
        do i = 1, size(methods)
            call script%add(style(i, methods(i)))
        end do
        call script%add("set grid lc rgb '#cccccc' lw 0.6 lt 1")
        call script%add("set logscale xyx2; set format '10^{%L}'")
        call script%add("mu = """//char(194)//char(181)//"""")
        call script%add("set ylabel 'largest error of q and v' offset 1")
        call script%add("set multiplot title 'Run time against error at the end'")
        do i = 1, size(problems)
            call place(modulo(i - 1, across), (i - 1)/across)
            call draw(i)
        end do
        if (.not. at_line) call draw_legend()
        call script%add("unset multiplot")
        text = script%text
    contains
        subroutine place(column, row)
            integer, intent(in) :: column, row
            real(dp) :: left, upper

            left = 100.0_dp + real((width - 10)*column, dp)/across
            upper = real(height - top - panel*row, dp)
            call put_margins(left, left + real(width - 10, dp)/across - 125.0_dp, &
                             upper - panel + 76.0_dp, upper - 46.0_dp)
        end subroutine place

        subroutine put_margins(left, right, bottom, upper)
            real(dp), intent(in) :: left, right, bottom, upper  !! pixels
            character(200) :: line

            write (line, "(ss, 4(a, f6.4))") "set lmargin at screen ", left/width, &
                "; set rmargin at screen ", right/width, "; set bmargin at screen ", &
                bottom/height, "; set tmargin at screen ", upper/height
            call script%add(trim(line))
        end subroutine put_margins

        subroutine draw(which)
            integer, intent(in) :: which
            character(:), allocatable :: line
            logical :: closed
            integer :: k

            call script%add("set title "//gnuplot_string(trim(problems(which)%name)//": "// &
                            trim(problems(which)%title)//", T = "// &
                            to_text(problems(which)%duration)//" s")//" noenhanced offset 0,-0.7")
            closed = any(curves%problem_index == which .and. curves%source == source_closed_form)
            call script%add("set xlabel 'time of a run ('.mu.'s"// &
                            trim(merge("; of closed_form: above", "                       ", &
                                       closed))//")' noenhanced")
            call script%add("set xrange ["//time_range(curves, which, .false., at_line)// &
                            "]; set yrange [1e-16:2]; unset x2tics; unset label")
            if (at_line) call put_names(which)
            if (closed) then
                call script%add("set x2range ["//time_range(curves, which, .true., at_line)// &
                                "]; set x2tics")
            end if
            line = ""
            do k = 1, size(curves)
                if (curves(k)%problem_index /= which) cycle
                if (line /= "") line = line//", "
                line = line//"data index "//to_text(k - 1)//" using 6:($5 > 1.2e-16 ? $5 : "// &
                       "1.2e-16)"//trim(merge(" axes x2y1", "          ", &
                                              curves(k)%source == source_closed_form))// &
                       " with linespoints ls "// &
                       to_text(findloc(methods, label(curves(k)), 1))//" notitle"
            end do
            if (line /= "") call script%add("plot "//line)
        end subroutine draw

        subroutine put_names(which)
            !! Behind the last point of each curve, moved up where two would lie on each other.
            integer, intent(in) :: which
            real(dp), parameter :: apart = 0.7_dp, beside = 1.2_dp  !! decades
            real(dp) :: x(size(curves)), y(size(curves))
            logical :: placed(size(curves)), waits(size(curves))
            integer :: k, m, n

            waits = curves%problem_index == which .and. curves%count > 0
            do k = 1, size(curves)
                if (.not. waits(k)) cycle
                associate (p => curves(k)%points(curves(k)%count))
                    x(k) = log10(1e6_dp*p%seconds)
                    y(k) = log10(max(p%error, 1.2e-16_dp)) + 0.3_dp
                end associate
            end do
            placed = .false.
            do n = 1, count(waits)
                k = minloc(y, 1, waits .and. .not. placed)
                do m = 1, size(curves)
                    if (.not. placed(m) .or. abs(x(m) - x(k)) >= beside) cycle
                    y(k) = max(y(k), y(m) + apart)
                end do
                placed(k) = .true.
                call script%add("set label "//gnuplot_string(trim(label(curves(k))))// &
                                " noenhanced at "//trim(merge("second", "first ", &
                                curves(k)%source == source_closed_form))//" "// &
                                to_text(10.0_dp**x(k))//", first "//to_text(10.0_dp**y(k))// &
                                " left offset 0.8,0 textcolor ls "// &
                                to_text(findloc(methods, label(curves(k)), 1)))
            end do
        end subroutine put_names

        subroutine draw_legend()
            character(:), allocatable :: line
            integer :: k

            call put_margins(10.0_dp, width - 10.0_dp, 4.0_dp, real(legend, dp))
            call script%add("unset logscale; unset border; unset tics; unset grid; unset title")
            call script%add("unset xlabel; unset ylabel; set xrange [0:1]; set yrange [0:1]")
            call script%add("set key center center horizontal maxcols 4 noenhanced samplen 3")
            line = "plot "
            do k = 1, size(methods)
                if (k > 1) line = line//", "
                line = line//"NaN with linespoints ls "//to_text(k)//" title "// &
                       gnuplot_string(trim(methods(k)))
            end do
            call script%add(line)
        end subroutine draw_legend
    end function bench_script

    pure function time_range(curves, which, closed, named) result(range)
        !! Whole decades around the times of one problem, us: of its closed form, which has an axis
        !! of its own above the panel, or of all others.
        type(curve_t), intent(in) :: curves(:)
        integer, intent(in) :: which
        logical, intent(in) :: closed  !! of the closed form
        logical, intent(in) :: named   !! there are names beside the curves, which need a decade
        character(:), allocatable :: range
        real(dp) :: low, high
        integer :: k

        low = huge(low)
        high = 0.0_dp
        do k = 1, size(curves)
            if (curves(k)%problem_index /= which) cycle
            if (closed .neqv. curves(k)%source == source_closed_form) cycle
            associate (p => curves(k)%points(:curves(k)%count))
                low = min(low, minval(p%seconds))
                high = max(high, maxval(p%seconds))
            end associate
        end do
        range = "*:*"
        if (high <= 0.0_dp) return
        range = to_text(10.0_dp**floor(log10(1e6_dp*low)))//":"// &
                to_text(10.0_dp**(ceiling(log10(1e6_dp*high)) + merge(1, 0, named)))
    end function time_range

    pure function style(i, method) result(line)
        !! Ours in colours, GSL's dashed and grey, the closed form a star.
        integer, intent(in) :: i
        character(*), intent(in) :: method
        character(:), allocatable :: line
        integer :: k

        k = modulo(i - 1, size(colours)) + 1
        line = "set style line "//to_text(i)//" lw 2 ps 1.1 pt "//to_text(modulo(i - 1, 15) + 1)
        if (index(method, "gsl_") == 1) then
            line = line//" lc rgb '#000000' dt 2"
        else if (method == "closed_form") then
            line = line//" lc rgb '#000000' dt 1"
        else
            line = line//" lc rgb '"//colours(k)//"' dt 1"
        end if
    end function style
end module lagrangia_bench_files
