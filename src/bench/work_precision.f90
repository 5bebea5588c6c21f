module lagrangia_work_precision
    !! Run time against error: each contestant over its steps or tolerances, on each problem.
    !!
    !! The curves become two tables: every point, and the time that an error takes.
    use lagrangia_bench_problems, only: bench_problem_t
    use lagrangia_contestant, only: contestant_box_t, contestant_t, set_by_names, set_by_nothing, &
                                    set_by_step, source_gsl
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_precision_curve, only: best, median, not_known, ratio, time_to_error
    use lagrangia_printed_table, only: printed_table_t, cell_t, count_cell, number_cell, word_cell
    use lagrangia_stopwatch, only: effort_t, repetitions, seconds_since, ticks_now
    implicit none (type, external)
    private
    public :: curve_t, best_time, look_around, measure_curves, points_table, times_table

    integer, parameter :: most_rungs = 48, most_rounds = 9
    real(dp), parameter :: longest_step = 2.0_dp        !! s: every problem turns in a few seconds
    real(dp), parameter :: loosest = 1e-2_dp, tightest = 1e-15_dp
    integer, parameter :: attempts = 3                  !! before a run is called too long
    real(dp), parameter :: no_digit = 1.0_dp            !! an error that is not worth a point
    real(dp), parameter :: microseconds = 1e6_dp
    real(dp), parameter :: wanted(4) = [1e-3_dp, 1e-6_dp, 1e-9_dp, 1e-12_dp]

    type :: point_t
        real(dp) :: setting = 0.0_dp                !! step, s, or tolerance
        real(dp) :: error = 0.0_dp
        real(dp) :: seconds = 0.0_dp                !! median of the rounds
        integer(i8) :: evaluations = 0
        real(dp) :: samples(most_rounds) = 0.0_dp
    end type point_t

    type :: curve_t
        !! One contestant on one problem, coarsest setting first.
        character(name_length) :: problem = "", method = ""
        integer :: source = 0, set_by = 0
        integer :: coordinates = 0                  !! that are integrated
        integer :: problem_index = 0, contestant_index = 0
        integer :: count = 0
        type(point_t) :: points(most_rungs)
    contains
        procedure :: time_to
        procedure :: least_error
    end type curve_t

contains

    subroutine measure_curves(problems, contestants, tolerances, plan, watcher, curves, error)
        !! All contestants on all problems; those that refuse a problem have no curve there. Each
        !! round times every point once, so that what slows the machine for a while slows all.
        type(bench_problem_t), target, intent(in) :: problems(:)  !! stay where they are
        type(contestant_box_t), intent(inout) :: contestants(:)  !! prepared as needed
        real(dp), intent(in) :: tolerances(:)    !! empty: a ladder from loose to tight
        type(effort_t), intent(in) :: plan  !! how much is measured
        class(observer_t), pointer, intent(in) :: watcher  !! may be null
        type(curve_t), allocatable, intent(out) :: curves(:)  !! a problem's beside each other
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(curve_t), allocatable :: room(:)
        integer :: i, k, n, round, total

        allocate (room(size(problems)*size(contestants)))
        total = size(room)*(1 + plan%rounds)
        n = 0
        do i = 1, size(problems)
            do k = 1, size(contestants)
                call look_around(watcher, (i - 1)*size(contestants) + k, total, error)
                if (allocated(error)) return
                room(n + 1) = curve_t()
                room(n + 1)%problem_index = i
                room(n + 1)%contestant_index = k
                call climb(problems(i), contestants(k)%item, tolerances, plan, room(n + 1))
                if (room(n + 1)%count > 0) n = n + 1
            end do
        end do
        allocate (curves, source=room(:n))
        do round = 1, plan%rounds
            do i = 1, n
                call look_around(watcher, size(room) + (round - 1)*n + i, size(room) + &
                                 plan%rounds*n, error)
                if (allocated(error)) return
                call time_points(problems(curves(i)%problem_index), &
                                 contestants(curves(i)%contestant_index)%item, plan, round, &
                                 curves(i), error)
                if (allocated(error)) return
            end do
        end do
        do i = 1, n
            do k = 1, curves(i)%count
                curves(i)%points(k)%seconds = median(curves(i)%points(k)%samples(:plan%rounds))
            end do
        end do
    end subroutine measure_curves

    subroutine climb(problem, contestant, tolerances, plan, curve)
        !! Find the settings that are worth their time, from coarse to fine, and their errors:
        !! until a run takes too long, or rounding is all that is left.
        type(bench_problem_t), target, intent(in) :: problem
        class(contestant_t), intent(inout) :: contestant
        real(dp), intent(in) :: tolerances(:)
        type(effort_t), intent(in) :: plan
        type(curve_t), intent(inout) :: curve
        type(error_t), allocatable :: error
        real(dp) :: q(problem%system%ndof), v(problem%system%ndof), setting, least, took
        integer(i8) :: start
        integer :: attempt, idle, rung

        curve%problem = problem%name
        curve%method = contestant%name
        curve%source = contestant%source
        curve%set_by = contestant%set_by
        least = huge(least)
        idle = 0
        do rung = 1, most_rungs
            call choose_setting(contestant, tolerances, plan, rung, setting)
            if (setting <= 0.0_dp) exit
            if (contestant%set_by == set_by_step) setting = problem%duration/ &
                ceiling(problem%duration/setting*(1.0_dp - epsilon(setting)), i8)
            took = huge(took)
            do attempt = 1, attempts
                call contestant%prepare(problem, setting, error)
                if (allocated(error)) return
                start = ticks_now()
                call contestant%solve(problem, q, v, error)
                took = min(took, seconds_since(start))
                if (took <= plan%longest .or. took > 10.0_dp*plan%longest) exit
            end do
            if (took > plan%longest) exit
            if (allocated(error)) cycle
            associate (point => curve%points(curve%count + 1))
                point%setting = setting
                point%error = problem%error_of(q, v)
                point%evaluations = contestant%evaluations
                curve%coordinates = contestant%coordinates
                point%seconds = took
                if (point%error >= no_digit) cycle
                idle = idle + 1
                if (point%error < 0.5_dp*least) idle = 0
                least = min(least, point%error)
            end associate
            curve%count = curve%count + 1
            if (idle >= 3 .and. least < 1e-9_dp .and. size(tolerances) == 0) exit
        end do
    end subroutine climb

    pure subroutine choose_setting(contestant, tolerances, plan, rung, setting)
        !! A step a rung shorter lowers the error by the plan's decades; 0 where the ladder ends.
        class(contestant_t), intent(in) :: contestant
        real(dp), intent(in) :: tolerances(:)
        type(effort_t), intent(in) :: plan
        integer, intent(in) :: rung
        real(dp), intent(out) :: setting

        setting = 0.0_dp
        select case (contestant%set_by)
        case (set_by_nothing)
            if (rung == 1) setting = 1.0_dp
        case (set_by_step)
            setting = longest_step*10.0_dp**(-plan%decades*(rung - 1)/contestant%order)
        case default  ! a tolerance
            if (size(tolerances) > 0) then
                if (rung <= size(tolerances)) setting = tolerances(rung)
            else
                setting = loosest*10.0_dp**(-plan%decades*(rung - 1))
                if (setting < 0.9_dp*tightest) setting = 0.0_dp
            end if
        end select
    end subroutine choose_setting

    subroutine time_points(problem, contestant, plan, round, curve, error)
        !! One more sample of every point of a curve.
        type(bench_problem_t), target, intent(in) :: problem
        class(contestant_t), intent(inout) :: contestant
        type(effort_t), intent(in) :: plan
        integer, intent(in) :: round
        type(curve_t), intent(inout) :: curve
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: q(problem%system%ndof), v(problem%system%ndof)
        integer(i8) :: start
        integer :: i, k, count

        do k = 1, curve%count
            associate (point => curve%points(k))
                call contestant%prepare(problem, point%setting, error)
                if (allocated(error)) return
                count = repetitions(point%seconds, plan%shortest)
                start = ticks_now()
                do i = 1, count
                    call contestant%solve(problem, q, v, error)
                    if (allocated(error)) return
                end do
                point%samples(round) = seconds_since(start)/count
                point%seconds = minval(point%samples(:round))
            end associate
        end do
    end subroutine time_points

    subroutine look_around(watcher, done, total, error)
        !! Tell how far it is; stop where a signal came.
        class(observer_t), pointer, intent(in) :: watcher  !! told how far it is; may be null
        integer, intent(in) :: done, total  !! of the parts of the work
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails

        if (associated(watcher)) call watcher%tick(int(done, i8), int(total, i8))
        if (interrupt_status() /= 0) call fail(error, "interrupted", interrupt_status())
    end subroutine look_around

    pure function time_to(self, wanted) result(seconds)
        !! The time that the error `wanted` takes; NaN where it is not reached.
        class(curve_t), intent(in) :: self
        real(dp), intent(in) :: wanted  !! error
        real(dp) :: seconds
        real(dp), dimension(self%count) :: error, spent  ! of the points, one behind the other

        error = self%points(:self%count)%error
        spent = self%points(:self%count)%seconds
        seconds = time_to_error(error, spent, wanted)
    end function time_to

    pure function least_error(self) result(error)
        !! The lowest error at any setting, as it was.
        class(curve_t), intent(in) :: self
        real(dp) :: error

        error = minval(self%points(:self%count)%error)
    end function least_error

    pure subroutine points_table(curves, table)
        !! All that was measured: for programs.
        type(curve_t), intent(in) :: curves(:)  !! as they were measured
        type(printed_table_t), intent(out) :: table  !! the result
        integer :: i, k

        call table%begin("work_precision", "run time against error", &
                         [character(name_length) :: "problem", "method", "set_by", "setting", &
                          "error", "us", "evaluations"])
        table%silent = .true.
        do i = 1, size(curves)
            do k = 1, curves(i)%count
                associate (c => curves(i), p => curves(i)%points(k))
                    call table%add([word_cell(c%problem), word_cell(c%method), &
                                    word_cell(set_by_names(c%set_by)), number_cell(p%setting, 3), &
                                    number_cell(p%error, 3), &
                                    number_cell(microseconds*p%seconds, 4), &
                                    count_cell(p%evaluations)])
                end associate
            end do
        end do
    end subroutine points_table

    pure subroutine times_table(curves, table)
        !! Microseconds to an error, and how many times the best of GSL's methods takes of them.
        type(curve_t), intent(in) :: curves(:)  !! as they were measured
        type(printed_table_t), intent(out) :: table  !! the result
        type(cell_t) :: times(size(wanted)), ratios(size(wanted))
        real(dp) :: time
        integer :: i, k

        call table%begin("time_to_error", "time to an error, us; over_gsl: divided "// &
                         "by the best of GSL's methods there; coordinates: that are integrated", &
                         [character(name_length) :: &
                         "problem", "method", "set_by", "coordinates", "us_to_1e-3", "us_to_1e-6", &
                         "us_to_1e-9", "us_to_1e-12", "over_gsl_1e-3", "over_gsl_1e-6", &
                         "over_gsl_1e-9", "over_gsl_1e-12", "least_error"])
        do i = 1, size(curves)
            do k = 1, size(wanted)
                time = curves(i)%time_to(wanted(k))
                times(k) = number_cell(microseconds*time, 3)
                ratios(k) = number_cell(ratio(time, best_time(curves, curves(i)%problem, &
                                                              source_gsl, wanted(k))), 2)
            end do
            call table%add([word_cell(curves(i)%problem), word_cell(curves(i)%method), &
                            word_cell(set_by_names(curves(i)%set_by)), &
                            count_cell(int(curves(i)%coordinates, i8)), times, ratios, &
                            number_cell(curves(i)%least_error(), 2)])
        end do
    end subroutine times_table

    pure function best_time(curves, problem, source, error) result(seconds)
        !! The least time that one of `source` takes to `error` on `problem`.
        type(curve_t), intent(in) :: curves(:)  !! as they were measured
        character(*), intent(in) :: problem  !! its name
        integer, intent(in) :: source  !! `source_ours`, `source_gsl` or `source_closed_form`
        real(dp), intent(in) :: error  !! that must be reached
        real(dp) :: seconds
        integer :: i

        seconds = not_known()
        do i = 1, size(curves)
            if (curves(i)%problem /= problem .or. curves(i)%source /= source) cycle
            seconds = best([seconds, curves(i)%time_to(error)])
        end do
    end function best_time
end module lagrangia_work_precision
