module test_dense_run
    !! Samples between the steps of a method, and fixed steps made dense.
    use event_runs, only: find
    use funit, only: anyExceptions, assertEqual, assertFalse, assertGreaterThan, assertTrue, &
                     TestMethod, TestSuite
    use lagrangia_dense_run, only: run_dense
    use lagrangia_dop853, only: dop853_t, new_dop853
    use lagrangia_errors, only: error_t
    use lagrangia_events, only: column_event_t, event_box_t, new_column_event
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_box_t
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_recorder, only: recorder_t
    use lagrangia_reference, only: reference_t
    use lagrangia_rk4, only: new_rk4, rk4_t
    use lagrangia_run, only: run
    use lagrangia_stepwise, only: new_stepwise, stepwise_t
    use lagrangia_text, only: to_text
    use lagrangia_time_grid, only: new_sample_times, new_time_grid, time_grid_t
    use run_doubles, only: watcher_t
    implicit none (type, external)
    private
    public :: dense_run_suite

contains

    function dense_run_suite() result(suite)
        type(TestSuite) :: suite

        suite = TestSuite("dense_run")
        call suite%addTest(TestMethod("more samples cost no evaluations", samples_are_free))
        call suite%addTest(TestMethod("samples lie where the plan has them", sample_times))
        call suite%addTest(TestMethod("events leave fixed steps as they are", same_steps))
        call suite%addTest(TestMethod("as many steps are taken as the duration has", whole_steps))
        call suite%addTest(TestMethod("the motion is followed to every event and the end", &
                                      every_step_is_followed))
        call suite%addTest(TestMethod("a run that no computer ends is refused", endless_run))
        call suite%addTest(TestMethod("steps that have become ever shorter", shrunken_steps))
        call suite%addTest(TestMethod("between fixed steps the error is of order 6", &
                                      interpolation_order))
    end function dense_run_suite

    subroutine every_step_is_followed()
        !! RK4 with steps of 0.1 s over 0.65 s: their ends, the zero of the position at pi/10 s
        !! (omega = 5/s; a step's phase is 3e-4 off, so three steps' time 2e-4 s), and what is left
        !! of the last step. Where an event ends the run, nothing beyond it.
        real(dp), parameter :: zero = acos(-1.0_dp)/10.0_dp
        type(oscillator_t) :: system
        type(watcher_t), target :: watcher
        type(column_event_t) :: event
        type(rk4_t) :: rk4
        type(stepwise_t) :: method
        type(event_box_t) :: events(1)
        type(observer_box_t) :: observers(1)
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), ended
        integer :: i, k

        observers(1)%item => watcher
        call system%configure([1.0_dp, 25.0_dp], error)
        do i = 1, 2
            call new_column_event(event, trim(merge("x     ", "x stop", i == 1)), system, error)
            if (allocated(events(1)%item)) deallocate (events(1)%item)
            allocate (events(1)%item, source=event)
            watcher = watcher_t(every_step=.true.)
            q = 1.0_dp
            v = 0.0_dp
            call new_rk4(rk4)
            call new_stepwise(method, rk4, 0.1_dp)
            call new_sample_times(plan, 0.0_dp, 0.65_dp, 4_i8, error)
            call run_dense(system, method, plan, events, observers, q, v, ended, error)
            call assertTrue(.not. allocated(error), "no error")
            if (anyExceptions()) return
            if (i == 1) then
                call assertEqual([0.1_dp, 0.2_dp, 0.3_dp, zero, 0.4_dp, 0.5_dp, 0.6_dp, 0.65_dp], &
                                 watcher%followed, 1e-3_dp, "ends of steps, the event")
                call assertEqual([zero], watcher%met, 1e-3_dp, "the event")
                call assertEqual([1], watcher%events, "its number")
                call assertEqual(0.65_dp, watcher%followed(8), message="the end")
                call assertEqual([(0.65_dp*k/4, k=0, 4)], watcher%times, 1e-15_dp, "samples")
            else
                call assertEqual([0.1_dp, 0.2_dp, 0.3_dp, zero], watcher%followed, 1e-3_dp, &
                                 "as far as it goes")
                call assertEqual(watcher%met(1), watcher%followed(4), message="the event")
                call assertEqual(watcher%met(1), ended, message="the end")
            end if
        end do
    end subroutine every_step_is_followed

    subroutine samples_are_free()
        type(pendulum_t) :: system
        type(recorder_t), target :: record
        type(dop853_t) :: method
        type(event_box_t) :: events(0)
        type(observer_box_t) :: observers(1)
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), ended
        integer(i8) :: counts(3)
        integer :: i

        observers(1)%item => record
        call system%configure([0.7_dp, 1.3_dp, 9.81_dp], error)
        do i = 1, 3
            record%samples = 0
            q = 2.0_dp
            v = 0.0_dp
            call new_dop853(method)
            call new_sample_times(plan, 0.0_dp, 20.0_dp, 10_i8**i, error)
            call run_dense(system, method, plan, events, observers, q, v, ended, error)
            counts(i) = method%evaluations
        end do
        call assertTrue(all(counts == counts(1)), "equal")
        call assertGreaterThan(counts(1), 100_i8, message="counted")
    end subroutine samples_are_free

    subroutine sample_times()
        !! At t0 + k duration/samples, each to rounding; what they show is the motion there.
        type(oscillator_t) :: system
        type(recorder_t) :: record
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), ended
        integer :: k

        call system%configure([1.0_dp, 1.0_dp], error)
        q = 0.0_dp
        v = 1.0_dp
        call find(system, [character(1) ::], q, v, 7.3_dp, 1e-12_dp, record, ended, 97_i8)
        call assertEqual(98, record%samples, message="number")
        if (anyExceptions()) return
        call assertEqual([(7.3_dp*(k/97.0_dp), k=0, 97)], record%t(:98), 1e-15_dp, "times")
        call assertEqual(7.3_dp, record%t(98), message="the end")
        call assertEqual(sin(record%t(:98)), record%q(1, :98), 1e-10_dp, "x")
        call assertEqual(cos(record%t(:98)), record%v(1, :98), 1e-10_dp, "x_dot")
        call assertEqual(record%q(1, 98), q(1), message="the final state")
    end subroutine sample_times

    subroutine same_steps()
        !! `rk4` shows the same bytes with an event as without, also where the last step is short.
        type(pendulum_t) :: system
        type(recorder_t), target :: plain, dense
        type(rk4_t) :: rk4
        type(stepwise_t) :: stepwise
        type(column_event_t) :: event
        type(event_box_t) :: events(1)
        type(observer_box_t) :: observers(1)
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), ended

        call system%configure([0.7_dp, 1.3_dp, 9.81_dp], error)
        call new_rk4(rk4)
        call new_time_grid(plan, 0.2_dp, 0.03_dp, 4.0_dp, 5_i8, error)
        q = 2.0_dp
        v = 0.1_dp
        observers(1)%item => plain
        call run(system, rk4, plan, observers, q, v, error)
        call new_column_event(event, "theta_dot = 0", system, error)
        allocate (events(1)%item, source=event)
        q = 2.0_dp
        v = 0.1_dp
        observers(1)%item => dense
        call new_stepwise(stepwise, rk4, 0.03_dp)
        call run_dense(system, stepwise, plan, events, observers, q, v, ended, error)
        call assertEqual(28, plain%samples, message="samples")
        call assertEqual(28, dense%samples, message="samples with events")
        call assertEqual(3, dense%events, message="events")
        call assertEqual(plain%t(:28), dense%t(:28), message="t")
        call assertEqual(plain%q(1, :28), dense%q(1, :28), message="q")
        call assertEqual(plain%v(1, :28), dense%v(1, :28), message="v")
        call assertEqual(134_i8, stepwise%accepted, message="steps")
        call assertEqual(5*134_i8 + 1, stepwise%evaluations, message="evaluations")
    end subroutine same_steps

    subroutine whole_steps()
        !! `n` steps of `duration/n` are `n`, whichever way the quotient and the product round.
        type(pendulum_t) :: system
        type(rk4_t) :: rk4
        type(stepwise_t) :: method
        type(error_t), allocatable :: error
        real(dp), parameter :: duration = 0.7_dp
        integer :: n

        call system%configure([0.7_dp, 1.3_dp, 9.81_dp], error)
        call new_rk4(rk4)
        do n = 1, 100
            call new_stepwise(method, rk4, duration/n)
            call method%prepare(system, error)
            call method%start(system, 0.1_dp, [1.0_dp], [2.0_dp], 0.1_dp + duration)
            do while (method%t_new < method%t_end)
                call method%step(system, error)
            end do
            call assertEqual(n, int(method%accepted), message="steps")
            call assertEqual(0.1_dp + duration, method%t_new, message="the end")
        end do
    end subroutine whole_steps

    subroutine endless_run()
        !! A tenth of a period or so is a step: 100 s at omega = 10^17/s are 10^20 steps, which the
        !! first 10^4 show; at 10^12/s they are 10^14, and only a limit ends them.
        type(oscillator_t) :: system
        type(dop853_t) :: method
        type(event_box_t) :: events(0)
        type(observer_box_t) :: observers(0)
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error
        real(dp), parameter :: omegas(2) = [1e17_dp, 1e12_dp]
        real(dp) :: q(1), v(1), ended
        integer :: i

        do i = 1, 2
            call system%configure([1.0_dp, omegas(i)**2], error)
            q = 1.0_dp
            v = 0.0_dp
            call new_dop853(method)
            method%most_steps = 10001
            call new_sample_times(plan, 0.0_dp, 100.0_dp, 2_i8, error)
            call run_dense(system, method, plan, events, observers, q, v, ended, error)
            call assertTrue(allocated(error), "an error")
            if (anyExceptions()) return
            call assertEqual(3, error%status, message="status")
            if (i == 1) then
                call assertEqual(1, index(error%message, "10000 steps went from t = 0.0 s to "), &
                                 message=error%message)
                call assertTrue(index(error%message, ", more than 10^15 are needed to 100.0 s: "// &
                                      "shorten the duration") > 0, error%message)
            else
                call assertEqual(1, index(error%message, "more than 10001 steps, at t = "), &
                                 message=error%message)
            end if
        end do
    end subroutine endless_run

    subroutine shrunken_steps()
        !! 10^5 steps went 6 s, and each next 10^5 only 10^-5 s: 10^10 would come to the end.
        !! Neither steps that always were so short, nor some of them before the end, nor those of a
        !! steep place that is left behind are refused.
        call look(6.0_dp, 1e-5_dp, 10.0_dp, 9, "")
        call look(6.0_dp, 1e-5_dp, 6.001_dp, 0, "")
        call look(6.0_dp, 0.01_dp, 1e6_dp, 0, "")
        call look(1e-5_dp, 1e-5_dp, 10.0_dp, 0, "")
        call look(6.0_dp, 1e-5_dp, 10.0_dp, 0, "left behind")
    contains
        subroutine look(first, next, t_end, at, place)
            !! Looks after each 10^5 steps since the start, which is at 100 s.
            real(dp), intent(in) :: first  !! the time that the first of them take, s
            real(dp), intent(in) :: next   !! and the next, s
            real(dp), intent(in) :: t_end  !! since the start, s
            integer, intent(in) :: at      !! which look refuses; 0: none
            character(*), intent(in) :: place  !! the eighth take 1 s, if there is one
            type(dop853_t) :: method
            type(error_t), allocatable :: error
            real(dp), parameter :: t0 = 100.0_dp
            integer :: i

            call new_dop853(method)
            method%t_new = t0 + first
            do i = 1, 12
                call method%refuse_more(i*100000_i8, t0, t0 + t_end, error)
                call assertTrue(allocated(error) .eqv. i == at, "look "//to_text(i))
                if (allocated(error)) exit
                method%t_new = method%t_new + next
                if (place /= "" .and. i == 7) method%t_new = method%t_new + 1.0_dp
            end do
            if (allocated(error)) call assertTrue(index(error%message, &
                "steps have become 6.0E+05 times shorter at t = 106.00008") == 1, error%message)
        end subroutine look
    end subroutine shrunken_steps

    subroutine interpolation_order()
        !! Two steps of `dop853`, which is as good as exact here, and the quintic in the second.
        type(pendulum_t) :: system
        class(reference_t), allocatable :: reference
        type(dop853_t) :: exact
        type(stepwise_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), q_true(1), v_true(1), errors(2, 2), h, orders(2)
        integer :: i, k

        call system%configure([0.7_dp, 1.3_dp, 9.81_dp], error)
        call system%closed_form(0.0_dp, [1.0_dp], [0.5_dp], reference)
        call new_dop853(exact)
        errors = 0.0_dp
        do i = 1, 2
            h = 0.1_dp/i
            call new_stepwise(method, exact, h)
            call method%prepare(system, error)
            call method%start(system, 0.0_dp, [1.0_dp], [0.5_dp], 1.0_dp)
            call method%step(system, error)
            call method%step(system, error)
            do k = 1, 9
                call method%state_at((1 + 0.1_dp*k)*h, q, v)
                call reference%state_at((1 + 0.1_dp*k)*h, q_true, v_true)
                errors(1, i) = max(errors(1, i), abs(q(1) - q_true(1)))
                errors(2, i) = max(errors(2, i), abs(v(1) - v_true(1)))
            end do
        end do
        orders = log(errors(:, 1)/errors(:, 2))/log(2.0_dp)
        call assertEqual([6.0_dp, 5.0_dp], orders, 0.4_dp, "orders")
    end subroutine interpolation_order
end module test_dense_run
