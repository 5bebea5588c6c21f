module test_gauss_adaptive
    !! Gauss-Legendre collocation that chooses its steps.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertLessThan, assertLessThanOrEqual, assertTrue
    use lagrangia_errors, only: error_t, status_numbers
    use lagrangia_gauss_adaptive, only: gauss_adaptive_t, new_gauss16_adaptive
    use lagrangia_hanging_chain, only: hanging_chain_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: system_t
    use lagrangia_wedge, only: wedge_t
    use plain_system, only: plain_system_t
    implicit none (type, external)
    private
    public :: gauss_adaptive_suite

contains

    function gauss_adaptive_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("gauss_adaptive")
        call suite%addTest(TestMethod("error_follows_the_tolerance", error_follows_the_tolerance))
        call suite%addTest(TestMethod("never_past_the_end", never_past_the_end))
        call suite%addTest(TestMethod("stops_where_nothing_goes_on", stops_where_nothing_goes_on))
        call suite%addTest(TestMethod("stiff_forces_shorten_the_step", &
                                      stiff_forces_shorten_the_step))
        call suite%addTest(TestMethod("relative_above_one", relative_above_one))
        call suite%addTest(TestMethod("blocks_go_on", blocks_go_on))
        call suite%addTest(TestMethod("a_loose_tolerance_is_cheaper", a_loose_tolerance_is_cheaper))
        call suite%addTest(TestMethod("free_motion_in_one_go", free_motion_in_one_go))
        call suite%addTest(TestMethod("backwards_is_refused", backwards_is_refused))
        call suite%addTest(TestMethod("tolerances_are_checked", tolerances_are_checked))
    end function gauss_adaptive_suite

    subroutine ready(system, tolerance, method)
        !! Prepare `method`.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: tolerance
        type(gauss_adaptive_t), intent(out) :: method
        type(error_t), allocatable :: error

        call new_gauss16_adaptive(method)
        method%tolerance = tolerance
        call method%prepare(system, error)
        call assertFalse(allocated(error), "prepare")
    end subroutine ready

    subroutine error_follows_the_tolerance()
        !! Against the closed form, over six swings: local errors add up, and an early one shifts
        !! the time; a factor of 100 covers both. More accuracy costs more evaluations, but a
        !! thousand times more only some 1.7 times as many: 1000 to the power of 1/16 steps, and
        !! more sweeps.
        type(pendulum_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error
        class(reference_t), allocatable :: reference
        real(dp) :: q(1), v(1), q_true(1), v_true(1), tolerance, worst
        integer(i8) :: before
        integer :: k

        call system%configure([1.3_dp, 0.7_dp, 9.81_dp], error)
        call system%closed_form(0.0_dp, [2.5_dp], [0.3_dp], reference)
        call reference%state_at(10.0_dp, q_true, v_true)
        before = 0
        do k = 4, 13
            tolerance = 10.0_dp**(-k)
            call ready(system, tolerance, method)
            q = 2.5_dp
            v = 0.3_dp
            call method%start(system, 0.0_dp, q, v)
            call method%advance(system, 0.0_dp, 10.0_dp, 0_i8, 1_i8, q, v)
            worst = max(abs(q(1) - q_true(1)), abs(v(1) - v_true(1)))
            call assertLessThan(worst, 100.0_dp*tolerance, message="error")
            if (mod(k, 3) == 1) then
                call assertGreaterThan(method%evaluations, before, message="evaluations")
                if (k > 4) call assertLessThan(real(method%evaluations, dp), 2.0_dp*before, &
                                               message="evaluations for three digits more")
                before = method%evaluations
            end if
        end do
    end subroutine error_follows_the_tolerance

    subroutine never_past_the_end()
        !! Nothing is evaluated after the end, where this system has no accelerations.
        type(plain_system_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2)
        integer :: k

        system%ndof = 2
        do k = 1, 10
            system%last = 0.37_dp*k**2
            call ready(system, 1e-8_dp, method)
            call method%start(system, 0.0_dp, [0.8_dp, 1.9_dp], [-0.4_dp, 1.1_dp], system%last)
            do while (method%t_new < system%last)
                call method%step(system, error)
                call assertFalse(allocated(error), "step")
                if (anyExceptions()) return
                call assertLessThanOrEqual(method%t_new, system%last)
            end do
            call method%state_at(method%t_new, q, v)
            call assertEqual(system%last, method%t_new, 0.0_dp, "the last step ends at the end")
            call assertFalse(any(ieee_is_nan([q, v])), "nothing was evaluated later")
        end do
    end subroutine never_past_the_end

    subroutine stops_where_nothing_goes_on()
        !! No accelerations after t = 1: the step says so, and stands where it stood; `advance`
        !! gives a state that is not a number.
        type(plain_system_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2), before(4), t
        integer :: k

        system%ndof = 2
        system%last = 1.0_dp
        call ready(system, 1e-8_dp, method)
        call method%start(system, 0.0_dp, [0.8_dp, 1.9_dp], [-0.4_dp, 1.1_dp], 2.0_dp)
        do k = 1, 1000
            call method%state_at(method%t_new, q, v)
            before = [q, v]
            t = method%t_new
            call method%step(system, error)
            if (allocated(error)) exit
        end do
        call assertTrue(allocated(error), "it ends")
        if (.not. allocated(error)) return
        call assertEqual(status_numbers, error%status, "status")
        call assertEqual("no step is small enough at t = ", error%message(:31))
        call assertEqual(1.0_dp, t, 1e-9_dp, "the last good time")
        call assertEqual(t, method%t_new, 0.0_dp, "time stands")
        call method%state_at(t, q, v)
        call assertEqual(before, [q, v], 0.0_dp, "state stands")
        q = [0.8_dp, 1.9_dp]
        v = [-0.4_dp, 1.1_dp]
        call method%start(system, 0.0_dp, q, v)
        call method%advance(system, 0.0_dp, 2.0_dp, 0_i8, 1_i8, q, v)
        call assertTrue(any(ieee_is_nan([q, v])), "advance")
    end subroutine stops_where_nothing_goes_on

    subroutine stiff_forces_shorten_the_step()
        !! \(\omega\) = 1e4, released at rest where a first step of the whole run would diverge.
        type(oscillator_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)

        call system%configure([1.0_dp, 1e8_dp], error)
        call ready(system, 1e-9_dp, method)
        q = 1e-6_dp
        v = 0.0_dp
        call method%start(system, 0.0_dp, q, v)
        call method%advance(system, 0.0_dp, 0.02_dp, 0_i8, 1_i8, q, v)
        call assertGreaterThan(method%rejected, 0_i8, message="rejected steps")
        call assertEqual(1e-6_dp*cos(200.0_dp), q(1), 1e-9_dp, "coordinate")
        call assertEqual(-1e-2_dp*sin(200.0_dp), v(1), 1e-6_dp, "velocity")
    end subroutine stiff_forces_shorten_the_step

    subroutine relative_above_one()
        !! A coordinate of a million, with a velocity of that size, costs no more than one of 1.
        type(oscillator_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)
        integer(i8) :: evaluations

        call system%configure([1.0_dp, 1.0_dp], error)
        call ready(system, 1e-9_dp, method)
        q = 1.0_dp
        v = 0.0_dp
        call method%start(system, 0.0_dp, q, v)
        call method%advance(system, 0.0_dp, 30.0_dp, 0_i8, 1_i8, q, v)
        evaluations = method%evaluations
        call ready(system, 1e-9_dp, method)
        q = 1e6_dp
        v = 0.0_dp
        call method%start(system, 0.0_dp, q, v)
        call method%advance(system, 0.0_dp, 30.0_dp, 0_i8, 1_i8, q, v)
        call assertLessThan(real(method%evaluations, dp), 2.0_dp*evaluations, message="cost")
        call assertEqual(cos(30.0_dp), q(1)/1e6_dp, 1e-7_dp, "relative error")
    end subroutine relative_above_one

    subroutine blocks_go_on()
        !! A run in blocks ends where one in one go does, and a block that goes on from the last
        !! one does not begin with a careful first step.
        type(pendulum_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), whole(2)
        integer(i8) :: evaluations, k

        call system%configure([1.3_dp, 0.7_dp, 9.81_dp], error)
        call ready(system, 1e-10_dp, method)
        q = 2.5_dp
        v = 0.3_dp
        call method%start(system, 0.0_dp, q, v)
        call method%advance(system, 0.0_dp, 0.5_dp, 0_i8, 20_i8, q, v)
        whole = [q, v]
        evaluations = method%evaluations
        call ready(system, 1e-10_dp, method)
        q = 2.5_dp
        v = 0.3_dp
        call method%start(system, 0.0_dp, q, v)
        do k = 0, 19
            call method%advance(system, 0.0_dp, 0.5_dp, k, 1_i8, q, v)
        end do
        call assertEqual(whole, [q, v], 1e-8_dp, "in blocks")
        call assertLessThan(real(method%evaluations, dp), 1.6_dp*evaluations, message="cost")
    end subroutine blocks_go_on

    subroutine a_loose_tolerance_is_cheaper()
        !! Where the tolerance would allow long steps, the sweeps do not: a step grows no further
        !! than they converge well, or a chain to 1e-3 costs more than one to 1e-5.
        type(hanging_chain_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(10), v(10)
        integer(i8) :: evaluations(2)
        integer :: k

        call system%configure([10.0_dp, 0.3_dp, 2.0_dp, 9.81_dp], error)
        do k = 1, 2
            call ready(system, merge(1e-3_dp, 1e-5_dp, k == 1), method)
            q = 0.6_dp
            v = 0.0_dp
            call method%start(system, 0.0_dp, q, v)
            call method%advance(system, 0.0_dp, 10.0_dp, 0_i8, 1_i8, q, v)
            evaluations(k) = method%evaluations
        end do
        call assertLessThan(real(evaluations(1), dp), 0.85_dp*evaluations(2), message="cost")
    end subroutine a_loose_tolerance_is_cheaper

    subroutine free_motion_in_one_go()
        !! Constant accelerations: steps double until the end.
        type(wedge_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2), a(2)

        call system%configure([0.7_dp, 2.0_dp, 0.6_dp, 9.81_dp], error)
        call ready(system, 1e-12_dp, method)
        q = [0.3_dp, 0.1_dp]
        v = [1.0_dp, -0.5_dp]
        call system%accelerations(0.0_dp, q, v, a)
        call method%start(system, 0.0_dp, q, v)
        call method%advance(system, 0.0_dp, 100.0_dp, 0_i8, 1_i8, q, v)
        call assertLessThan(method%accepted, 16_i8, message="steps")
        call assertEqual(0_i8, method%rejected, message="rejected")
        call assertEqual([0.3_dp, 0.1_dp] + [100.0_dp, -50.0_dp] + 5000.0_dp*a, q, 1e-9_dp)
    end subroutine free_motion_in_one_go

    subroutine backwards_is_refused()
        !! Steps go forwards; a negative `dt` is not ignored.
        type(oscillator_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)

        call system%configure([1.0_dp, 1.0_dp], error)
        call ready(system, 1e-9_dp, method)
        q = 1.0_dp
        v = 0.0_dp
        call method%start(system, 0.0_dp, q, v)
        call method%advance(system, 0.0_dp, -1.0_dp, 0_i8, 1_i8, q, v)
        call assertTrue(ieee_is_nan(v(1)), "backwards")
    end subroutine backwards_is_refused

    subroutine tolerances_are_checked()
        !! By message; the smallest and a large one are allowed.
        call refused(0.0_dp)
        call refused(-1e-9_dp)
        call refused(9e-15_dp)
        call refused(1.0_dp)
        call accepted(1e-14_dp)
        call accepted(0.5_dp)
    end subroutine tolerances_are_checked

    subroutine refused(tolerance)
        !! This tolerance is not allowed.
        real(dp), intent(in) :: tolerance
        type(oscillator_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error

        call system%configure([1.0_dp, 1.0_dp], error)
        call new_gauss16_adaptive(method)
        method%tolerance = tolerance
        call method%prepare(system, error)
        call assertTrue(allocated(error), "refused")
        if (.not. allocated(error)) return
        call assertTrue(index(error%message, " is not allowed: gauss16 keeps 1") > 0, error%message)
        call assertEqual("tolerance", error%key)
    end subroutine refused

    subroutine accepted(tolerance)
        !! This one is.
        real(dp), intent(in) :: tolerance
        type(oscillator_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error

        call system%configure([1.0_dp, 1.0_dp], error)
        call ready(system, tolerance, method)
    end subroutine accepted
end module test_gauss_adaptive
