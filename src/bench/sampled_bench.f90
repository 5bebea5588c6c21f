module lagrangia_sampled_bench
    !! What samples cost: a motion to its end alone, and with a thousand states on the way, as a
    !! scene asks for them. Ours come from the dense output; GSL has none and steps to each.
    use lagrangia_bench_problems, only: bench_problem_t
    use lagrangia_contestant, only: contestant_box_t, contestant_t, set_by_tolerance, source_gsl
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_precision_curve, only: best, median, not_known, ratio
    use lagrangia_printed_table, only: number_cell, printed_table_t, word_cell
    use lagrangia_stopwatch, only: effort_t, repetitions, seconds_since, ticks_now
    use lagrangia_work_precision, only: look_around
    implicit none (type, external)
    private
    public :: measure_samples

    real(dp), parameter :: tolerance = 1e-10_dp  !! what `solve` takes unless told
    integer, parameter :: samples = 1000
    real(dp), parameter :: microseconds = 1e6_dp

contains

    subroutine measure_samples(problems, contestants, plan, watcher, table, error)
        !! Microseconds without and with samples, of those that are set by a tolerance, and how many
        !! times the best of GSL's methods takes of the latter.
        type(bench_problem_t), target, intent(in) :: problems(:)  !! stay where they are
        type(contestant_box_t), intent(inout) :: contestants(:)   !! prepared as needed
        type(effort_t), intent(in) :: plan                        !! how much is measured
        class(observer_t), pointer, intent(in) :: watcher         !! may be null
        type(printed_table_t), intent(out) :: table               !! the result
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        real(dp) :: plain(size(contestants)), sampled(size(contestants)), reached(size(contestants))
        real(dp) :: gsl
        integer :: i, k

        call table%begin("samples", "a run at tolerance 1e-10, us: to the end alone, and with "// &
                         "1000 samples on the way; over_gsl: of the latter", &
                         [character(name_length) :: "problem", "method", "error", "us_end", &
                          "us_samples", "ratio", "over_gsl"])
        do i = 1, size(problems)
            gsl = not_known()
            do k = 1, size(contestants)
                call look_around(watcher, (i - 1)*size(contestants) + k, &
                                 size(problems)*size(contestants), error)
                if (allocated(error)) return
                plain(k) = not_known()
                if (contestants(k)%item%set_by /= set_by_tolerance) cycle
                call time_both(contestants(k)%item, problems(i), plan, plain(k), sampled(k), &
                               reached(k))
                if (contestants(k)%item%source == source_gsl) gsl = best([gsl, sampled(k)])
            end do
            do k = 1, size(contestants)
                if (.not. plain(k) > 0.0_dp) cycle
                call table%add([word_cell(problems(i)%name), word_cell(contestants(k)%item%name), &
                                number_cell(reached(k), 2), &
                                number_cell(plain(k)*microseconds, 3), &
                                number_cell(sampled(k)*microseconds, 3), &
                                number_cell(ratio(sampled(k), plain(k)), 2), &
                                number_cell(ratio(sampled(k), gsl), 2)])
            end do
        end do
    end subroutine measure_samples

    subroutine time_both(contestant, problem, plan, plain, sampled, reached)
        !! Medians of alternating rounds, and the error at the end; NaN where it is refused.
        class(contestant_t), intent(inout) :: contestant
        type(bench_problem_t), target, intent(in) :: problem
        type(effort_t), intent(in) :: plan
        real(dp), intent(out) :: plain, sampled, reached
        real(dp) :: took(plan%rounds, 2)
        integer :: k, round

        reached = not_known()
        do round = 1, plan%rounds
            do k = 1, 2
                contestant%samples = merge(0, samples, k == 1)
                call time_one(contestant, problem, plan, took(round, k), reached)
            end do
        end do
        contestant%samples = 0
        plain = median(took(:, 1))
        sampled = median(took(:, 2))
    end subroutine time_both

    subroutine time_one(contestant, problem, plan, seconds, reached)
        !! One measurement; NaN where the problem is refused.
        class(contestant_t), intent(inout) :: contestant
        type(bench_problem_t), target, intent(in) :: problem
        type(effort_t), intent(in) :: plan
        real(dp), intent(out) :: seconds, reached
        real(dp) :: q(problem%system%ndof), v(problem%system%ndof)
        type(error_t), allocatable :: error
        integer(i8) :: start
        integer :: count, i

        seconds = not_known()
        reached = not_known()
        call contestant%prepare(problem, tolerance, error)
        if (allocated(error)) return
        start = ticks_now()
        call contestant%solve(problem, q, v, error)
        if (allocated(error)) return
        reached = problem%error_of(q, v)
        count = repetitions(seconds_since(start), plan%shortest)
        start = ticks_now()
        do i = 1, count
            call contestant%solve(problem, q, v, error)
        end do
        seconds = seconds_since(start)/count
    end subroutine time_one
end module lagrangia_sampled_bench
