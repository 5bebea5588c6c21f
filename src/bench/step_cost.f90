module lagrangia_step_cost
    !! What one step costs, of every method on every system.
    use lagrangia_bench_problems, only: bench_problem_t
    use lagrangia_characters, only: printable
    use lagrangia_command_line, only: word_t
    use lagrangia_contestant, only: contestant_box_t, contestant_t, set_by_step
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_precision_curve, only: median, not_known
    use lagrangia_printed_table, only: cell_t, number_cell, printed_table_t, word_cell
    use lagrangia_scene_reader, only: read_named_system
    use lagrangia_stopwatch, only: effort_t, repetitions, seconds_since, ticks_now
    use lagrangia_work_precision, only: look_around
    implicit none (type, external)
    private
    public :: measure_steps

    real(dp), parameter :: dt = 1e-3_dp, duration = 1.0_dp  !! s: a thousand steps a call
    real(dp), parameter :: nanoseconds = 1e9_dp

contains

    subroutine measure_steps(systems, contestants, plan, watcher, table, error)
        !! Nanoseconds a step, and evaluations, of those that take fixed steps.
        type(word_t), intent(in) :: systems(:)  !! their names, of scenes also paths
        type(contestant_box_t), intent(inout) :: contestants(:)  !! prepared as needed
        type(effort_t), intent(in) :: plan  !! how much is measured
        class(observer_t), pointer, intent(in) :: watcher  !! told how far it is; may be null
        type(printed_table_t), intent(out) :: table  !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(bench_problem_t), target :: problem
        real(dp), allocatable :: cost(:, :)
        real(dp) :: evaluations(size(contestants)), samples(plan%rounds)
        type(cell_t) :: cells(2 + size(systems))
        integer :: i, k, round

        allocate (cost(size(systems), size(contestants)), source=not_known())
        evaluations = not_known()
        do i = 1, size(systems)
            call pose(systems(i)%text, problem, error)
            if (allocated(error)) return
            do k = 1, size(contestants)
                call look_around(watcher, (i - 1)*size(contestants) + k, size(cost), error)
                if (allocated(error)) return
                if (contestants(k)%item%set_by /= set_by_step) cycle
                do round = 1, plan%rounds
                    call time_steps(contestants(k)%item, problem, plan, samples(round))
                end do
                cost(i, k) = median(samples)*nanoseconds
                if (cost(i, k) >= 0.0_dp) evaluations(k) = &
                    contestants(k)%item%evaluations*dt/duration
            end do
        end do
        call begin_table(table, systems, longest(systems))
        do k = 1, size(contestants)
            if (.not. any(cost(:, k) >= 0.0_dp)) cycle
            cells(1) = word_cell(contestants(k)%item%name)
            cells(2) = number_cell(evaluations(k), 3)
            cells(3:) = number_cell(cost(:, k), 3)
            call table%add(cells)
        end do
    end subroutine measure_steps

    subroutine begin_table(table, systems, letters)
        !! A column for each system, however long its name is.
        type(printed_table_t), intent(inout) :: table
        type(word_t), intent(in) :: systems(:)
        integer, intent(in) :: letters  !! of the longest name
        character(letters) :: names(2 + size(systems))
        integer :: i

        names(1) = "method"
        names(2) = "evaluations"
        do i = 1, size(systems)
            names(2 + i) = printable(systems(i)%text)
        end do
        call table%begin("step_ns", "one step, ns (dt = 1e-3 s; -: the method "// &
                         "refuses the system)", names)
    end subroutine begin_table

    pure integer function longest(systems)
        !! Letters of a column's name.
        type(word_t), intent(in) :: systems(:)
        integer :: i

        longest = len("evaluations")
        do i = 1, size(systems)
            longest = max(longest, len(printable(systems(i)%text)))
        end do
    end function longest

    subroutine time_steps(contestant, problem, plan, seconds)
        !! One sample of the time of a step; NaN where the system is refused. `evaluations` of the
        !! contestant are those of one run afterwards.
        class(contestant_t), intent(inout) :: contestant
        type(bench_problem_t), target, intent(in) :: problem
        type(effort_t), intent(in) :: plan
        real(dp), intent(out) :: seconds
        real(dp) :: q(problem%system%ndof), v(problem%system%ndof)
        type(error_t), allocatable :: error
        integer(i8) :: start
        integer :: i, count

        seconds = not_known()
        call contestant%prepare(problem, dt, error)
        if (allocated(error)) return
        start = ticks_now()
        call contestant%solve(problem, q, v, error)
        if (allocated(error)) return
        count = repetitions(seconds_since(start), plan%shortest)
        start = ticks_now()
        do i = 1, count
            call contestant%solve(problem, q, v, error)
        end do
        seconds = seconds_since(start)/count*dt/duration
        call contestant%prepare(problem, dt, error)
        call contestant%solve(problem, q, v, error)
    end subroutine time_steps

    subroutine pose(name, problem, error)
        !! A motion of the system called `name`, with its default parameters, or of that of a scene,
        !! from some state.
        character(*), intent(in) :: name
        type(bench_problem_t), intent(out) :: problem
        type(error_t), allocatable, intent(out) :: error
        real(dp), allocatable :: given(:)
        integer :: i, n

        call read_named_system(name, [word_t ::], problem%system, error)
        if (allocated(error)) return
        problem%name = name
        problem%duration = duration
        n = problem%system%ndof
        allocate (problem%q(n), problem%v(n), given(n - problem%system%constraints))
        problem%q = [(0.2_dp + 0.1_dp*i, i=1, n)]
        given = [(0.3_dp + 0.1_dp*i, i=1, size(given))]
        call problem%system%complete_velocities(0.0_dp, problem%q, given, problem%v, error)
    end subroutine pose
end module lagrangia_step_cost
