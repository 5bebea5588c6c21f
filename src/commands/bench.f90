module lagrangia_bench
    !! `lagrangia bench [PART...]`: what the methods cost, beside GSL's, in one run.
    use lagrangia_bench_files, only: check_bench_files, write_bench_files
    use lagrangia_bench_options, only: bench_options_t, parts, read_options
    use lagrangia_bench_problems, only: bench_problem_t, read_problems
    use lagrangia_command_line, only: command_line_t, word_t
    use lagrangia_console, only: console_failed, flush_console, line_width, put_line
    use lagrangia_contestant, only: contestant_box_t
    use lagrangia_contestants, only: new_contestants
    use lagrangia_energy_bench, only: measure_energy
    use lagrangia_errors, only: error_t, fail
    use lagrangia_growth_bench, only: measure_growth, measure_output
    use lagrangia_machine, only: processor
    use lagrangia_modes_bench, only: measure_modes
    use lagrangia_observer, only: observer_t
    use lagrangia_output_options, only: draw_picture
    use lagrangia_printed_table, only: printed_table_t
    use lagrangia_progress, only: progress_t
    use lagrangia_sampled_bench, only: measure_samples
    use lagrangia_step_cost, only: measure_steps
    use lagrangia_sweep_bench, only: measure_sweeps
    use lagrangia_version, only: build_text, is_optimised
    use lagrangia_work_precision, only: curve_t, measure_curves, points_table, times_table
    implicit none (type, external)
    private
    public :: bench_command, check_build

    type :: output_t
        !! Where tables go: each is shown as soon as it is there.
        logical :: json = .false., quiet = .false., first = .true.
    contains
        procedure :: show
        procedure :: say
    end type output_t

contains

    subroutine bench_command(line, error)
        !! Measure the parts that are asked for, and print each table as soon as it is there.
        type(command_line_t), intent(in) :: line  !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(bench_options_t) :: options
        type(printed_table_t) :: table
        type(output_t) :: output
        type(progress_t), target :: progress
        class(observer_t), pointer :: watcher
        integer :: i

        call check_build(is_optimised(), error)
        if (allocated(error)) return
        call read_options(line, options, error)
        if (allocated(error)) return
        if (any(options%parts == "precision")) call check_bench_files(options%folder, &
                                                                           options%systems, error)
        if (allocated(error)) return
        watcher => progress
        output%json = line%has("json")
        output%quiet = line%has("quiet")
        if (output%json) call put_line("[")
        call output%say("build: "//build_text())
        call output%say("processor: "//processor())
        do i = 1, size(parts)
            if (.not. any(options%parts == parts(i))) cycle
            call flush_console()
            if (console_failed()) return  ! nobody would see the rest
            call progress%restart("bench "//trim(parts(i)), line%has("quiet"))
            select case (parts(i))
            case ("precision")
                call bench_precision()
            case ("samples")
                call bench_samples()
            case ("steps")
                call bench_steps()
            case ("energy")
                call measure_energy(options%methods, options%plan, watcher, table, error)
                if (allocated(error)) exit
                call output%show(table, progress)
            case ("growth")
                call measure_growth(options%folder, options%plan, watcher, table, error)
                if (allocated(error)) exit
                call output%show(table, progress)
            case ("sweep")
                call measure_sweeps(options%plan, watcher, table, error)
                if (allocated(error)) exit
                call output%show(table, progress)
            case ("modes")
                call measure_modes(options%plan, watcher, table, error)
                if (allocated(error)) exit
                call output%show(table, progress)
            case default
                call measure_output(options%folder, options%plan, watcher, table, error)
                if (allocated(error)) exit
                call output%show(table, progress)
            end select
            if (allocated(error)) exit
        end do
        call progress%clear()
        if (allocated(error)) return
        if (output%json) call put_line("]")
    contains
        subroutine bench_precision()
            type(bench_problem_t), allocatable, target :: problems(:)
            type(contestant_box_t), allocatable :: contestants(:)
            type(curve_t), allocatable :: curves(:)
            character(:), allocatable :: path

            call read_problems(options%problems, problems, error)
            if (allocated(error)) return
            call new_contestants(options%methods, contestants)
            call measure_curves(problems, contestants, options%tolerances, options%plan, watcher, &
                                curves, error)
            if (allocated(error)) return
            if (size(curves) == 0) call fail(error, "none of these methods solves any of these "// &
                                             "problems")
            if (allocated(error)) return
            call points_table(curves, table)
            call output%show(table, progress)
            call times_table(curves, table)
            call output%show(table, progress)
            call write_bench_files(options%folder, problems, curves, path, error)
            if (allocated(error)) return
            call output%say("data file and gnuplot script: "//path)
            if (line%has("plot")) call draw_picture(path, options%picture, &
                                                    line%has("quiet"), error)
        end subroutine bench_precision

        subroutine bench_samples()
            type(bench_problem_t), allocatable, target :: problems(:)
            type(contestant_box_t), allocatable :: contestants(:)

            call read_problems(options%problems, problems, error)
            if (allocated(error)) return
            call new_contestants(options%methods, contestants)
            call measure_samples(problems, contestants, options%plan, watcher, table, error)
            if (allocated(error)) return
            call output%show(table, progress)
        end subroutine bench_samples

        subroutine bench_steps()
            type(contestant_box_t), allocatable :: contestants(:)

            call new_contestants(options%methods, contestants)
            call measure_steps(options%systems, contestants, options%plan, watcher, table, error)
            if (allocated(error)) return
            call output%show(table, progress)
        end subroutine bench_steps
    end subroutine bench_command

    pure subroutine check_build(optimised, error)
        !! A benchmark of a debug build would mislead.
        logical, intent(in) :: optimised  !! whether the compiler was told to
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails

        if (.not. optimised) call fail(error, "bench: this build is not optimised, and its "// &
            "times would mislead; 'fpm run --profile release -- bench' builds one that is")
    end subroutine check_build

    subroutine show(self, table, progress)
        !! One table, as lines or as objects of the one array.
        class(output_t), intent(inout) :: self
        type(printed_table_t), intent(in) :: table
        type(progress_t), intent(inout) :: progress
        type(word_t), allocatable :: lines(:)
        integer :: i

        call progress%clear()
        if (self%json) then
            do i = 1, table%rows
                call put_line(trim(merge(" ", ",", self%first))//table%object(i))
                self%first = .false.
            end do
        else if (.not. (self%quiet .or. table%silent)) then
            call put_line("")
            call put_line(trim(table%title))
            call table%lines(line_width() - 2, lines)
            do i = 1, size(lines)
                call put_line(repeat(" ", merge(2, 0, lines(i)%text /= ""))//lines(i)%text)
            end do
        end if
        call flush_console()
    end subroutine show

    subroutine say(self, text)
        !! A line for people.
        class(output_t), intent(in) :: self
        character(*), intent(in) :: text

        if (.not. (self%json .or. self%quiet)) call put_line(text)
    end subroutine say
end module lagrangia_bench
