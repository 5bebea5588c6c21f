module test_failure_contract
    !! What fails returns an error and leaves its caller's state as it was: every method and run.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertTrue
    use lagrangia_catalogue, only: new_system, nth_system
    use lagrangia_dense_run, only: run_dense
    use lagrangia_errors, only: error_t, status_numbers
    use lagrangia_events, only: event_box_t
    use lagrangia_integrator, only: dense_integrator_t, integrator_t, not_prepared, not_started
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: nth_adaptive, nth_integrator
    use lagrangia_observer, only: observer_box_t
    use lagrangia_reduced_motion, only: leave_cyclic
    use lagrangia_run, only: run
    use lagrangia_stepwise, only: new_stepwise, stepwise_t
    use lagrangia_system, only: system_t
    use lagrangia_time_grid, only: new_sample_times, new_time_grid, time_grid_t
    use run_doubles, only: exploding_t, watcher_t
    implicit none (type, external)
    private
    public :: failure_contract_suite

contains

    function failure_contract_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("failure_contract")
        call suite%addTest(TestMethod("a_refusal_changes_nothing", a_refusal_changes_nothing))
        call suite%addTest(TestMethod("steps_that_fail_leave_the_state", &
                                      steps_that_fail_leave_the_state))
        call suite%addTest(TestMethod("a_forgotten_prepare_is_told", a_forgotten_prepare_is_told))
        call suite%addTest(TestMethod("a_forgotten_start_is_told", a_forgotten_start_is_told))
        call suite%addTest(TestMethod("the_step_may_change", the_step_may_change))
        call suite%addTest(TestMethod("runs_that_fail_leave_the_state", &
                                      runs_that_fail_leave_the_state))
        call suite%addTest(TestMethod("dense_runs_that_fail_leave_the_state", &
                                      dense_runs_that_fail_leave_the_state))
        call suite%addTest(TestMethod("a_dense_step_that_fails_stands_still", &
                                      a_dense_step_that_fails_stands_still))
        call suite%addTest(TestMethod("an_observer_that_fails_leaves_the_state", &
                                      an_observer_that_fails_leaves_the_state))
    end function failure_contract_suite

    subroutine nth_method(i, method)
        !! Entry `i` of the methods of fixed step, each followed by its compensated variant if there
        !! is one; not allocated beyond the end.
        integer, intent(in) :: i
        class(integrator_t), allocatable, intent(out) :: method
        class(integrator_t), allocatable :: variant
        integer :: k, n

        k = 0
        do n = 1, i
            call nth_integrator(n, method)
            if (.not. allocated(method)) return
            k = k + 1
            if (k == i) return
            call method%compensated(variant)
            if (allocated(variant)) k = k + 1
            call move_alloc(variant, method)
            if (k == i) return
        end do
    end subroutine nth_method

    subroutine new_trap(method, system, q, v, q0, v0)
        !! A charge in a trap or, where the method does not take it, an oscillator; both of about
        !! 1 rad/s; the method is ready for it. The start comes twice.
        class(integrator_t), intent(inout) :: method
        class(system_t), allocatable, intent(out) :: system
        real(dp), allocatable, intent(out) :: q(:), v(:), q0(:), v0(:)
        type(error_t), allocatable :: error

        call new_system("charged_particle", system, error)
        call system%configure([1.1_dp, 0.7_dp, 0.2_dp, 0.1_dp, -0.3_dp, 0.6_dp, -0.7_dp, 1.4_dp, &
                               1.3_dp], error)
        call method%prepare(system, error)
        if (allocated(error)) then
            call new_system("oscillator", system, error)
            call system%configure([1.1_dp, 1.3_dp], error)
            call method%prepare(system, error)
        end if
        allocate (q(system%ndof), source=0.5_dp)
        allocate (v(system%ndof), source=-0.25_dp)
        allocate (q0, source=q)
        allocate (v0, source=v)
    end subroutine new_trap

    subroutine a_refusal_changes_nothing()
        !! A method that has refused a system goes on with its own as if nothing had been.
        class(integrator_t), allocatable :: method, other, trial
        class(system_t), allocatable :: system, odd
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:), q_other(:), v_other(:)
        integer :: i, k, refused

        refused = 0
        i = 0
        do
            i = i + 1
            call nth_method(i, method)
            if (.not. allocated(method)) exit
            call new_trap(method, system, q, v, q_other, v_other)
            call method%start(system, 0.3_dp, q, v)
            call method%advance(system, 0.3_dp, 0.1_dp, 0_i8, 3_i8, q, v)
            call nth_method(i, other)
            call other%prepare(system, error)
            call other%start(system, 0.3_dp, q_other, v_other)
            call other%advance(system, 0.3_dp, 0.1_dp, 0_i8, 3_i8, q_other, v_other)
            k = 0
            do
                k = k + 1
                call nth_system(k, odd)
                if (.not. allocated(odd)) exit
                call nth_method(i, trial)
                call trial%prepare(odd, error)
                if (.not. allocated(error)) cycle
                refused = refused + 1
                call method%prepare(odd, error)
            end do
            call method%advance(system, 0.3_dp, 0.1_dp, 3_i8, 3_i8, q, v)
            call other%advance(system, 0.3_dp, 0.1_dp, 3_i8, 3_i8, q_other, v_other)
            call assertEqual([q_other, v_other], [q, v], message=trim(method%name)//": the state")
            call assertEqual(other%evaluations, method%evaluations, message=method%name)
            if (anyExceptions()) return
        end do
        call assertEqual(104, refused, "refusals")
    end subroutine a_refusal_changes_nothing

    subroutine steps_that_fail_leave_the_state()
        !! Far too long ones: to the bit, with the time and the reason. The method is none the worse
        !! for it: shorter steps are those of one that has never failed.
        class(integrator_t), allocatable :: method, other
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:), q0(:), v0(:)
        integer :: i

        i = 0
        do
            i = i + 1
            call nth_method(i, method)
            if (.not. allocated(method)) exit
            call new_trap(method, system, q, v, q0, v0)
            call method%start(system, 0.0_dp, q, v)
            call method%try_advance(system, 0.0_dp, 1e3_dp, 0_i8, 200_i8, q, v, error)
            call assertTrue(allocated(error), trim(method%name)//" fails")
            if (.not. allocated(error)) return
            call assertEqual(status_numbers, error%status, method%name)
            call assertEqual(1, index(error%message, "the state is not finite at t = 200000.0 s"), &
                             error%message)
            call assertEqual([q0, v0], [q, v], message=trim(method%name)//": as it was")
            call method%try_advance(system, 0.0_dp, 0.1_dp, 0_i8, 5_i8, q, v, error)
            call assertFalse(allocated(error), trim(method%name)//" goes on")
            call assertEqual("", trim(method%failure_reason))
            call nth_method(i, other)
            call other%prepare(system, error)
            call other%start(system, 0.0_dp, q0, v0)
            call other%advance(system, 0.0_dp, 0.1_dp, 0_i8, 5_i8, q0, v0)
            call assertEqual([q0, v0], [q, v], message=trim(method%name)//": shorter steps")
            if (anyExceptions()) return
        end do
        call assertEqual(24, i - 1, "methods and variants")
    end subroutine steps_that_fail_leave_the_state

    subroutine a_forgotten_start_is_told()
        !! A method that cannot do without `start` says so; the others step as if it had been
        !! called, to rounding. After the refusal the method has started.
        class(integrator_t), allocatable :: method, other
        class(dense_integrator_t), allocatable :: adaptive
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:), q0(:), v0(:)
        integer :: i, told

        told = 0
        i = 0
        do
            i = i + 1
            call nth_method(i, method)
            if (.not. allocated(method)) exit
            call new_trap(method, system, q, v, q0, v0)
            call method%try_advance(system, 0.3_dp, 0.1_dp, 0_i8, 5_i8, q, v, error)
            if (allocated(error)) then
                told = told + 1
                call assertEqual("the state is not finite at t = 0.8 s: "//not_started, &
                                 error%message)
                call assertEqual([q0, v0], [q, v], message=trim(method%name)//": as it was")
                call method%try_advance(system, 0.3_dp, 0.1_dp, 0_i8, 5_i8, q, v, error)
                call assertFalse(allocated(error), trim(method%name)//": once is enough")
            end if
            call nth_method(i, other)
            call other%prepare(system, error)
            call other%start(system, 0.3_dp, q0, v0)
            call other%advance(system, 0.3_dp, 0.1_dp, 0_i8, 5_i8, q0, v0)
            call assertEqual([q0, v0], [q, v], 1e-14_dp, trim(method%name))
            if (anyExceptions()) return
        end do
        call assertEqual(2, told, "kick first, plain and compensated")
        call nth_adaptive(1, adaptive)
        call adaptive%prepare(system, error)
        call adaptive%try_advance(system, 0.3_dp, 0.1_dp, 0_i8, 5_i8, q, v, error)
        call assertEqual("the state is not finite at t = 0.8 s: "//not_started, error%message)
    end subroutine a_forgotten_start_is_told

    subroutine a_forgotten_prepare_is_told()
        !! By every method, also by one prepared for a system of another size: the state is NaN,
        !! `try_advance` fails, and dense methods have no step and no state.
        class(integrator_t), allocatable :: method
        class(dense_integrator_t), allocatable :: dense
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:), q0(:), v0(:)
        integer :: i

        do i = 1, 24
            call nth_method(i, method)
            call new_trap(method, system, q, v, q0, v0)
            call nth_method(i, method)
            call refuses_to_advance(method, system, q, v)
            if (anyExceptions()) return
        end do
        i = 0
        do
            i = i + 1
            call nth_dense(i, dense)
            if (.not. allocated(dense)) exit
            call refuses_to_advance(dense, system, q, v)
            call dense%step(system, error)
            call assertTrue(allocated(error), trim(dense%name)//" has no step")
            if (allocated(error)) call assertEqual(not_prepared, error%message)
            call dense%state_at(0.0_dp, q0, v0)
            call assertTrue(all(ieee_is_nan([q0, v0])), trim(dense%name)//" has no state")
            if (anyExceptions()) return
        end do
        call assertEqual(4, i, "dense methods, and one more")
        call new_system("cart_pendulum", system, error)
        call system%configure([2.0_dp, 1.0_dp, 1.0_dp, 9.81_dp], error)
        call nth_adaptive(1, dense)
        call move_alloc(dense, method)
        call leave_cyclic(method, system)
        call refuses_to_advance(method, system, [0.1_dp, 0.2_dp], [0.3_dp, 0.4_dp])
    end subroutine a_forgotten_prepare_is_told

    subroutine refuses_to_advance(method, system, q, v)
        !! Before `prepare`, and after one for a system of seven coordinates.
        class(integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: q(:), v(:)
        type(exploding_t) :: seven
        type(error_t), allocatable :: error
        real(dp) :: q_new(size(q)), v_new(size(v))
        integer :: k

        seven%ndof = 7
        seven%velocity_forces = .false.
        do k = 1, 2
            if (k == 2) call method%prepare(seven, error)
            q_new = q
            v_new = v
            call method%start(system, 0.0_dp, q, v, 1.0_dp)
            call method%advance(system, 0.0_dp, 0.1_dp, 0_i8, 5_i8, q_new, v_new)
            call assertTrue(all(ieee_is_nan([q_new, v_new])), trim(method%name)//": NaN")
            q_new = q
            v_new = v
            call method%try_advance(system, 0.0_dp, 0.1_dp, 0_i8, 5_i8, q_new, v_new, error)
            call assertTrue(allocated(error), trim(method%name)//" fails")
            if (allocated(error)) call assertEqual("the state is not finite at t = 0.5 s: "// &
                                                   not_prepared, error%message)
            call assertEqual([q, v], [q_new, v_new], message=trim(method%name)//": as it was")
        end do
    end subroutine refuses_to_advance

    subroutine the_step_may_change()
        !! Without a new start, also backwards: to the rounding of some dozen evaluations the state
        !! is that of a method that starts where each length begins.
        class(integrator_t), allocatable :: method, other
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp), parameter :: lengths(4) = [0.1_dp, 0.03_dp, -0.2_dp, 0.17_dp]
        real(dp), allocatable :: q(:), v(:), q0(:), v0(:)
        real(dp) :: t
        integer :: i, k

        i = 0
        do
            i = i + 1
            call nth_method(i, method)
            if (.not. allocated(method)) exit
            call new_trap(method, system, q, v, q0, v0)
            call nth_method(i, other)
            call other%prepare(system, error)
            t = 0.3_dp
            call method%start(system, t, q, v)
            do k = 1, size(lengths)
                call other%start(system, t, q0, v0)
                call method%advance(system, t, lengths(k), 0_i8, 3_i8, q, v)
                call other%advance(system, t, lengths(k), 0_i8, 3_i8, q0, v0)
                call assertEqual([q0, v0], [q, v], 2e-15_dp*k, trim(method%name))
                t = t + 3*lengths(k)
            end do
            if (anyExceptions()) return
        end do
    end subroutine the_step_may_change

    subroutine runs_that_fail_leave_the_state()
        !! Every method, at its first sample or later.
        class(integrator_t), allocatable :: method
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(time_grid_t) :: plan
        real(dp), allocatable :: q(:), v(:), q0(:), v0(:)
        integer :: i

        i = 0
        do
            i = i + 1
            call nth_method(i, method)
            if (.not. allocated(method)) exit
            call new_trap(method, system, q, v, q0, v0)
            call new_time_grid(plan, 0.0_dp, 1e3_dp, 2e5_dp, int(1 + 999*mod(i, 2), i8), error)
            call run(system, method, plan, [observer_box_t ::], q, v, error)
            call assertTrue(allocated(error), trim(method%name)//" fails")
            call assertEqual([q0, v0], [q, v], message=trim(method%name)//": as it was")
            if (anyExceptions()) return
        end do
    end subroutine runs_that_fail_leave_the_state

    subroutine nth_dense(i, method)
        !! The adaptive methods and, as the last, one of fixed step made dense.
        integer, intent(in) :: i
        class(dense_integrator_t), allocatable, intent(out) :: method
        class(integrator_t), allocatable :: plain
        type(stepwise_t) :: stepwise

        call nth_adaptive(i, method)
        if (allocated(method)) return
        call nth_adaptive(i - 1, method)
        if (.not. allocated(method)) return
        deallocate (method)
        call nth_integrator(1, plain)
        call new_stepwise(stepwise, plain, 0.01_dp)
        allocate (method, source=stepwise)
    end subroutine nth_dense

    subroutine dense_runs_that_fail_leave_the_state()
        !! \(\ddot x = \dot x^2\) from 1 is infinite at t = 1: samples up to there were good.
        class(dense_integrator_t), allocatable :: method
        type(exploding_t) :: system
        type(watcher_t), target :: watcher
        type(observer_box_t) :: box(1)
        type(event_box_t) :: events(0)
        type(error_t), allocatable :: error
        type(time_grid_t) :: plan
        real(dp) :: q(1), v(1), ended
        integer :: i

        system%ndof = 1
        i = 0
        do
            i = i + 1
            call nth_dense(i, method)
            if (.not. allocated(method)) exit
            call new_sample_times(plan, 0.0_dp, 5.0_dp, 100_i8, error)
            q = 0.0_dp
            v = 1.0_dp
            watcher = watcher_t()
            box(1)%item => watcher
            call run_dense(system, method, plan, events, box, q, v, ended, error)
            call assertTrue(allocated(error), trim(method%name)//" fails")
            call assertEqual([0.0_dp, 1.0_dp], [q, v], message=trim(method%name)//": as it was")
            call assertGreaterThan(ended, 0.9_dp, message="good up to here")
            call assertEqual(ended, watcher%times(watcher%samples), message="and seen")
        end do
        call assertEqual(3, i - 1, "methods")
    end subroutine dense_runs_that_fail_leave_the_state

    subroutine a_dense_step_that_fails_stands_still()
        !! Time, state and the count of steps; also if it is tried again.
        class(dense_integrator_t), allocatable :: method
        type(exploding_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), q_before(1), v_before(1), t
        integer(i8) :: accepted
        integer :: i, k

        system%ndof = 1
        i = 0
        do
            i = i + 1
            call nth_dense(i, method)
            if (.not. allocated(method)) exit
            call method%prepare(system, error)
            call method%start(system, 0.0_dp, [0.0_dp], [1.0_dp], 5.0_dp)
            do
                t = method%t_new
                accepted = method%accepted
                call method%state_at(t, q_before, v_before)
                call method%step(system, error)
                if (allocated(error) .or. method%t_new >= 5.0_dp) exit
            end do
            call assertTrue(allocated(error), trim(method%name)//" fails")
            do k = 1, 2
                call method%state_at(method%t_new, q, v)
                call assertEqual(t, method%t_new, message=trim(method%name)//": time")
                call assertEqual([q_before, v_before], [q, v], message=trim(method%name)//": state")
                call assertEqual(accepted, method%accepted, message=trim(method%name)//": count")
                call method%step(system, error)
                call assertTrue(allocated(error), trim(method%name)//" fails again")
            end do
        end do
    end subroutine a_dense_step_that_fails_stands_still

    subroutine an_observer_that_fails_leaves_the_state()
        !! In either loop.
        class(integrator_t), allocatable :: fixed
        class(dense_integrator_t), allocatable :: dense
        class(system_t), allocatable :: system
        type(watcher_t), target :: watcher
        type(observer_box_t) :: box(1)
        type(event_box_t) :: events(0)
        type(error_t), allocatable :: error
        type(time_grid_t) :: plan
        real(dp), allocatable :: q(:), v(:), q0(:), v0(:)
        real(dp) :: ended

        call nth_integrator(1, fixed)
        call nth_adaptive(1, dense)
        call new_trap(fixed, system, q, v, q0, v0)
        box(1)%item => watcher
        watcher%patience = 3
        call new_time_grid(plan, 0.0_dp, 0.01_dp, 1.0_dp, 10_i8, error)
        call run(system, fixed, plan, box, q, v, error)
        call assertEqual("seen enough", error%message)
        call assertEqual([q0, v0], [q, v], message="fixed: as it was")
        watcher = watcher_t(patience=3)
        call new_sample_times(plan, 0.0_dp, 1.0_dp, 10_i8, error)
        call run_dense(system, dense, plan, events, box, q, v, ended, error)
        call assertEqual([q0, v0], [q, v], message="dense: as it was")
    end subroutine an_observer_that_fails_leaves_the_state
end module test_failure_contract
