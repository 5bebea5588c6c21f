module test_run
    !! Who sees which sample of a run, and what a run that fails leaves behind.
    use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertLessThan, assertTrue
    use lagrangia_atwood, only: atwood_t
    use lagrangia_catalogue, only: new_system
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_errors, only: error_t, status_numbers
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: method_names, new_integrator, nth_integrator
    use lagrangia_observer, only: observer_box_t
    use lagrangia_run, only: run
    use lagrangia_system, only: system_t
    use lagrangia_time_grid, only: new_sample_times, new_time_grid, time_grid_t
    use run_doubles, only: exploding_t, watcher_t
    implicit none (type, external)
    private
    public :: run_suite

contains

    function run_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("run")
        call suite%addTest(TestMethod("samples_come_at_t0_plus_k_dt", samples_come_at_t0_plus_k_dt))
        call suite%addTest(TestMethod("the_end_is_exactly_the_end", the_end_is_exactly_the_end))
        call suite%addTest(TestMethod("the_shortened_step_lands_on_the_end", &
                                      the_shortened_step_lands_on_the_end))
        call suite%addTest(TestMethod("every_step_is_followed", every_step_is_followed))
        call suite%addTest(TestMethod("samples_change_no_byte", samples_change_no_byte))
        call suite%addTest(TestMethod("evaluations_are_counted", evaluations_are_counted))
        call suite%addTest(TestMethod("an_explosion_keeps_what_was_good", &
                                      an_explosion_keeps_what_was_good))
        call suite%addTest(TestMethod("a_start_that_is_not_finite_fails", &
                                      a_start_that_is_not_finite_fails))
        call suite%addTest(TestMethod("an_observer_may_stop_the_run", an_observer_may_stop_the_run))
        call suite%addTest(TestMethod("a_method_that_refuses_does_not_run", &
                                      a_method_that_refuses_does_not_run))
        call suite%addTest(TestMethod("a_grid_of_samples_is_refused", a_grid_of_samples_is_refused))
    end function run_suite

    subroutine perform(system, name, plan, watcher, q, v, error, evaluations)
        !! Run with the method called `name`, watched.
        class(system_t), intent(in) :: system
        character(*), intent(in) :: name
        type(time_grid_t), intent(in) :: plan
        type(watcher_t), target, intent(inout) :: watcher
        real(dp), intent(inout) :: q(:), v(:)
        type(error_t), allocatable, intent(out) :: error
        integer(i8), intent(out), optional :: evaluations
        class(integrator_t), allocatable :: method
        type(observer_box_t) :: box(1)

        call new_integrator(name, method, error)
        box(1)%item => watcher
        call run(system, method, plan, box, q, v, error)
        if (present(evaluations)) evaluations = method%evaluations
    end subroutine perform

    subroutine samples_come_at_t0_plus_k_dt()
        !! Every seventh of 100 steps, the start and the end; the state is that of the time.
        type(atwood_t) :: system
        type(time_grid_t) :: plan
        type(watcher_t) :: watcher
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)
        integer :: k

        call system%configure([3.0_dp, 2.0_dp, 9.81_dp, 0.0_dp, 1.0_dp, 0.0_dp], error)
        call new_time_grid(plan, 0.7_dp, 0.01_dp, 1.0_dp, 7_i8, error)
        q = 0.5_dp
        v = 0.25_dp
        call perform(system, "rk4", plan, watcher, q, v, error)
        call assertFalse(allocated(error), "it runs")
        ! an ulp of 1.7: where there is a fused multiply-add the product is not rounded
        call assertEqual([(0.7_dp + 7*k*0.01_dp, k=0, 14), 1.7_dp], watcher%times, &
                         epsilon(1.0_dp), "times")
        ! a = g/5; rk4 is exact, each step rounds once or twice
        call assertEqual(0.5_dp + 0.25_dp*(watcher%times - 0.7_dp) &
                         + 0.5_dp*1.962_dp*(watcher%times - 0.7_dp)**2, watcher%q(1, :), &
                         200*epsilon(1.0_dp), "states")
        call assertEqual(watcher%q(1, 16), q(1), message="the final state was shown")
        call assertEqual(100_i8, watcher%done, message="ticks go on to the end")
    end subroutine samples_come_at_t0_plus_k_dt

    subroutine the_end_is_exactly_the_end()
        !! 3*0.1 is not 0.3; and a stride longer than the run shows start and end.
        type(atwood_t) :: system
        type(time_grid_t) :: plan
        type(watcher_t) :: watcher
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)

        call system%configure([3.0_dp, 2.0_dp, 9.81_dp, 0.0_dp, 1.0_dp, 0.0_dp], error)
        call new_time_grid(plan, 0.0_dp, 0.1_dp, 0.3_dp, huge(1_i8), error)
        q = 0.0_dp
        v = 0.0_dp
        call perform(system, "verlet", plan, watcher, q, v, error)
        call assertEqual([0.0_dp, 0.3_dp], watcher%times)
    end subroutine the_end_is_exactly_the_end

    subroutine the_shortened_step_lands_on_the_end()
        !! The state is that of the end, not of the grid; it is no sample of the stride's.
        type(atwood_t) :: system
        type(time_grid_t) :: plan
        type(watcher_t) :: watcher
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)
        integer(i8) :: evaluations

        call system%configure([3.0_dp, 2.0_dp, 9.81_dp, 0.0_dp, 1.0_dp, 0.0_dp], error)
        call new_time_grid(plan, 0.1_dp, 0.3_dp, 1.0_dp, 2_i8, error)
        q = 0.0_dp
        v = 1.0_dp
        call perform(system, "rk4", plan, watcher, q, v, error, evaluations)
        call assertEqual([0.1_dp, 0.1_dp + 2*0.3_dp, 1.1_dp], watcher%times)
        call assertEqual(1.0_dp + 0.5_dp*1.962_dp, q(1), 20*epsilon(1.0_dp), "the end")
        call assertEqual(16_i8, evaluations)
    end subroutine the_shortened_step_lands_on_the_end

    subroutine every_step_is_followed()
        !! To the last, also a shortened one, by who wants to; by nobody else.
        type(atwood_t) :: system
        type(time_grid_t) :: plan
        type(watcher_t) :: watcher
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), duration
        integer :: i, k, n

        call system%configure([3.0_dp, 2.0_dp, 9.81_dp, 0.0_dp, 1.0_dp, 0.0_dp], error)
        do i = 1, 3
            duration = 0.1_dp*merge(6.0_dp, 6.5_dp, i == 1)
            call new_time_grid(plan, 0.7_dp, 0.1_dp, duration, 4_i8, error)
            q = 0.0_dp
            v = 1.0_dp
            watcher = watcher_t(every_step=i < 3)
            call perform(system, "rk4", plan, watcher, q, v, error)
            call assertEqual(3, watcher%samples, "samples")
            call assertEqual(i < 3, allocated(watcher%followed), message="followed")
            if (i == 3) cycle
            n = merge(6, 7, i == 1)
            call assertEqual(n, size(watcher%followed), "steps")
            call assertEqual([(0.7_dp + 0.1_dp*k, k=1, n - 1), 0.7_dp + duration], &
                             watcher%followed, epsilon(1.0_dp), "when they end")
        end do
    end subroutine every_step_is_followed

    subroutine samples_change_no_byte()
        !! Whatever the stride, for every method, where the time enters, with a shortened step.
        integer(i8), parameter :: strides(5) = [1_i8, 7_i8, 1024_i8, 1500_i8, huge(1_i8)]
        type(driven_pendulum_t) :: system
        class(integrator_t), allocatable :: method
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), q_first(1), v_first(1)
        integer :: i, k

        call system%configure([1.3_dp, 0.7_dp, 9.81_dp, 0.1_dp, 20.0_dp], error)
        i = 0
        do
            i = i + 1
            call nth_integrator(i, method)
            if (.not. allocated(method)) exit
            do k = 1, size(strides)
                call new_time_grid(plan, 0.3_dp, 1e-3_dp, 1.5003_dp, strides(k), error)
                q = 2.9_dp
                v = 0.1_dp
                call run(system, method, plan, [observer_box_t ::], q, v, error)
                if (allocated(error)) exit
                if (k == 1) then
                    q_first = q
                    v_first = v
                end if
                call assertEqual(q_first, q, message=trim(method%name)//": q")
                call assertEqual(v_first, v, message=trim(method%name)//": v")
            end do
            if (anyExceptions()) return
        end do
        call assertEqual(size(method_names()), i - 1, "methods tried")
    end subroutine samples_change_no_byte

    subroutine evaluations_are_counted()
        !! Four a step and one a step, however the run is cut, and none for looking.
        type(driven_pendulum_t) :: system
        type(time_grid_t) :: plan
        type(watcher_t) :: watcher
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)
        integer(i8) :: evaluations

        call system%configure([1.3_dp, 0.7_dp, 9.81_dp, 0.1_dp, 20.0_dp], error)
        call new_time_grid(plan, 0.0_dp, 0.01_dp, 25.0_dp, 3_i8, error)
        q = 1.0_dp
        v = 0.0_dp
        call perform(system, "rk4", plan, watcher, q, v, error, evaluations)
        call assertEqual(10000_i8, evaluations)
        call perform(system, "verlet", plan, watcher, q, v, error, evaluations)
        call assertEqual(2500_i8, evaluations)
    end subroutine evaluations_are_counted

    subroutine an_explosion_keeps_what_was_good()
        !! \(\ddot x = \dot x^2\) from 1: infinite at t = 1. Status 3, the time, the last sample.
        type(exploding_t) :: system
        type(time_grid_t) :: plan
        type(watcher_t) :: watcher
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)
        integer :: last

        system%ndof = 1
        call new_time_grid(plan, 0.0_dp, 0.01_dp, 5.0_dp, 10_i8, error)
        q = 0.0_dp
        v = 1.0_dp
        call perform(system, "rk4", plan, watcher, q, v, error)
        call assertTrue(allocated(error), "it fails")
        if (.not. allocated(error)) return
        call assertEqual(status_numbers, error%status)
        call assertEqual(1, index(error%message, "the state is not finite at t = 1."), &
                         error%message)
        last = watcher%samples
        call assertGreaterThan(watcher%times(last), 0.9_dp, message="good up to the explosion")
        call assertLessThan(watcher%times(last), 1.3_dp, message="and not beyond")
        call assertEqual([0.0_dp], q, message="q as it was")
        call assertEqual([1.0_dp], v, message="v as it was")
    end subroutine an_explosion_keeps_what_was_good

    subroutine a_start_that_is_not_finite_fails()
        !! Before anybody sees it, and the state stays what it was.
        type(exploding_t) :: system
        type(time_grid_t) :: plan
        type(watcher_t) :: watcher
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)

        system%ndof = 1
        call new_time_grid(plan, 2.0_dp, 0.01_dp, 5.0_dp, 10_i8, error)
        q = 3.0_dp
        v = ieee_value(1.0_dp, ieee_positive_inf)
        call perform(system, "rk4", plan, watcher, q, v, error)
        call assertTrue(allocated(error), "it fails")
        if (.not. allocated(error)) return
        call assertEqual(status_numbers, error%status)
        call assertEqual(1, index(error%message, "the state is not finite at t = 2.0 s"), &
                         error%message)
        call assertEqual(0, watcher%samples, "samples shown")
        call assertEqual(3.0_dp, q(1), message="q is not touched")
    end subroutine a_start_that_is_not_finite_fails

    subroutine an_observer_may_stop_the_run()
        !! At its third sample; nothing is computed after it.
        type(driven_pendulum_t) :: system
        type(time_grid_t) :: plan
        type(watcher_t) :: watcher
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)
        integer(i8) :: evaluations

        call system%configure([1.3_dp, 0.7_dp, 9.81_dp, 0.1_dp, 20.0_dp], error)
        call new_time_grid(plan, 0.0_dp, 0.01_dp, 1.005_dp, 10_i8, error)
        q = 1.0_dp
        v = 0.0_dp
        watcher%patience = 3
        call perform(system, "rk4", plan, watcher, q, v, error, evaluations)
        call assertTrue(allocated(error), "it stops")
        if (.not. allocated(error)) return
        call assertEqual("seen enough", error%message)
        call assertEqual(3, watcher%samples, "samples shown")
        call assertEqual(80_i8, evaluations)
    end subroutine an_observer_may_stop_the_run

    subroutine a_method_that_refuses_does_not_run()
        !! Nobody sees a sample.
        type(double_pendulum_t) :: system
        type(time_grid_t) :: plan
        type(watcher_t) :: watcher
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2)

        call system%configure([1.0_dp, 2.0_dp, 1.5_dp, 0.5_dp, 9.81_dp], error)
        call new_time_grid(plan, 0.0_dp, 0.01_dp, 1.0_dp, 10_i8, error)
        q = 1.0_dp
        v = 0.0_dp
        call perform(system, "verlet", plan, watcher, q, v, error)
        call assertTrue(allocated(error), "refused")
        call assertEqual(0, watcher%samples, "samples shown")
        call assertEqual(1.0_dp, q, message="q is not touched")
    end subroutine a_method_that_refuses_does_not_run

    subroutine a_grid_of_samples_is_refused()
        !! A run by steps wants steps.
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: method
        type(observer_box_t) :: nobody(0)
        type(time_grid_t) :: grid
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)

        call new_system("pendulum", system, error)
        call new_integrator("rk4", method, error)
        call new_sample_times(grid, 0.0_dp, 1.0_dp, 4_i8, error)
        call assertFalse(allocated(error), "a grid of samples")
        grid%every = 1
        q = 0.1_dp
        v = 0.0_dp
        call run(system, method, grid, nobody, q, v, error)
        call assertTrue(allocated(error), "refused")
        if (allocated(error)) call assertEqual("the time grid is not one of new_time_grid", &
                                               error%message)
    end subroutine a_grid_of_samples_is_refused
end module test_run
