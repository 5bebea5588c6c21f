module test_gauss
    !! Gauss-Legendre collocation with a fixed step: its order, and what it preserves.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use, intrinsic :: iso_fortran_env, only: real128
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertGreaterThan, &
                     assertLessThan, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_gauss, only: gauss_t, new_gauss16
    use lagrangia_gauss_kernels, only: end_state, full_end_state
    use lagrangia_gauss_tables, only: nodes, stages, weights
    use lagrangia_kinds, only: dp, i8
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_reference, only: reference_t
    use lagrangia_rolling_disk, only: rolling_disk_t
    use lagrangia_system, only: system_t
    use plain_system, only: plain_system_t
    implicit none (type, external)
    private
    public :: gauss_suite

    integer, parameter :: qp = real128

contains

    function gauss_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("gauss")
        call suite%addTest(TestMethod("order_on_the_pendulum", order_on_the_pendulum))
        call suite%addTest(TestMethod("flow_preserves_area", flow_preserves_area))
        call suite%addTest(TestMethod("steps_can_be_undone", steps_can_be_undone))
        call suite%addTest(TestMethod("cuts_leave_no_trace", cuts_leave_no_trace))
        call suite%addTest(TestMethod("energy_walks_at_random", energy_walks_at_random))
        call suite%addTest(TestMethod("energy_has_no_bias", energy_has_no_bias))
        call suite%addTest(TestMethod("ends_have_twice_the_digits", ends_have_twice_the_digits))
        call suite%addTest(TestMethod("time_and_velocities_count", time_and_velocities_count))
        call suite%addTest(TestMethod("disk_rolls", disk_rolls))
        call suite%addTest(TestMethod("rest_and_constant_forces", rest_and_constant_forces))
        call suite%addTest(TestMethod("divergence_is_not_hidden", divergence_is_not_hidden))
    end function gauss_suite

    subroutine ends_have_twice_the_digits()
        !! The sums that lead to the end of a fixed step, against quadruple precision: state and
        !! low part lack some \(2^{-100}\) of the terms; sums in double precision lack \(2^{-53}\).
        !! Without accelerations the velocities that add up are those at the start.
        real(dp), parameter :: v0 = 6.3_dp, q0 = -2.9_dp, low = 1e-17_dp
        real(dp) :: hb(stages), f(stages, 1), q(1), q_low(1), v(1), v_low(1), lost(2, 2)
        integer :: i, k

        do k = 1, 20
            hb = (0.3_dp + 0.01_dp*k)*weights
            do i = 1, 2
                f(:, 1) = 9.81_dp*sin(1.0_dp*k*nodes)
                call go(i == 1)
                lost(1, i) = real(abs((real(v0, qp) - v(1) + sum(real(hb, qp)*f(:, 1))) &
                                      + low - v_low(1)), dp)
                f = 0.0_dp
                call go(i == 1)
                lost(2, i) = real(abs((real(q0, qp) - q(1) + sum(real(hb, qp)*v0)) &
                                      - low - q_low(1)), dp)
            end do
            call assertLessThan(maxval(lost(:, 1)), 64.0_dp*2.0_dp**(-100), message="twice")
            call assertLessThan(maxval(lost(:, 2)), 64.0_dp*epsilon(v0), message="plain")
        end do
        call assertGreaterThan(minval(lost(:, 2)), 0.0_dp, message="plain sums lose")
    contains
        subroutine go(fully)
            logical, intent(in) :: fully

            v = v0
            q = q0
            v_low = low
            q_low = -low
            if (fully) then
                call full_end_state(1, hb, f, q, q_low, v, v_low)
            else
                call end_state(1, hb, f, q, q_low, v, v_low)
            end if
        end subroutine go
    end subroutine ends_have_twice_the_digits

    subroutine order_on_the_pendulum()
        !! Against the closed form, from both sides. Amplitudes stay below 0.6 rad and steps below
        !! a quarter of a period, so that the error is its leading term; it stands above rounding
        !! by a factor of ten at the shortest step.
        real(dp) :: coarse, fine

        coarse = pendulum_error(14_i8)
        fine = pendulum_error(28_i8)
        call assertLessThan(coarse, 1e-7_dp, message="error")
        call assertEqual(16.0_dp, log(coarse/fine)/log(2.0_dp), 1.0_dp, "order")
    end subroutine order_on_the_pendulum

    function pendulum_error(steps) result(error)
        !! Sum of the errors at the end of ten motions, which evens out that each may vanish.
        integer(i8), intent(in) :: steps
        real(dp) :: error
        real(dp), parameter :: duration = 8.0_dp
        type(pendulum_t) :: system
        type(error_t), allocatable :: failure
        class(reference_t), allocatable :: reference
        real(dp) :: q(1), v(1), q_true(1), v_true(1)
        integer :: k

        call system%configure([1.3_dp, 0.7_dp, 9.81_dp], failure)
        error = 0.0_dp
        do k = 1, 10
            q = 0.2_dp + 0.04_dp*k
            v = 0.3_dp
            call system%closed_form(0.0_dp, q, v, reference)
            call reference%state_at(duration, q_true, v_true)
            call go(system, 0.0_dp, duration/steps, steps, q, v)
            error = error + max(abs(q(1) - q_true(1)), abs(v(1) - v_true(1)))
        end do
    end function pendulum_error

    subroutine go(system, t0, dt, steps, q, v)
        !! `steps` steps of a fresh integrator.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: steps
        real(dp), intent(inout) :: q(:), v(:)
        type(gauss_t) :: method
        type(error_t), allocatable :: error

        call new_gauss16(method)
        call method%prepare(system, error)
        call assertFalse(allocated(error), "prepare")
        call method%start(system, t0, q, v)
        call method%advance(system, t0, dt, 0_i8, steps, q, v)
    end subroutine go

    subroutine flow_preserves_area()
        !! The determinant of the flow's derivative is 1, with steps whose error is a thousand
        !! times larger than what is left of it. Differences of order 8 over 0.02: truncation
        !! below 1e-14, rounding of the states over the difference some 1e-13.
        real(dp), parameter :: w(4) = [4.0_dp/5.0_dp, -1.0_dp/5.0_dp, 4.0_dp/105.0_dp, &
                                       -1.0_dp/280.0_dp]
        real(dp), parameter :: step = 0.02_dp
        type(pendulum_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: j(2, 2), plus(2), minus(2), shift(2)
        integer :: i, k

        call system%configure([1.3_dp, 0.7_dp, 9.81_dp], error)
        j = 0.0_dp
        do i = 1, 2
            do k = 1, 4
                shift = 0.0_dp
                shift(i) = k*step
                plus = [1.0_dp, 0.3_dp] + shift
                minus = [1.0_dp, 0.3_dp] - shift
                call go(system, 0.0_dp, 0.5_dp, 2_i8, plus(1:1), plus(2:2))
                call go(system, 0.0_dp, 0.5_dp, 2_i8, minus(1:1), minus(2:2))
                j(:, i) = j(:, i) + w(k)/step*(plus - minus)
            end do
        end do
        call assertEqual(1.0_dp, j(1, 1)*j(2, 2) - j(1, 2)*j(2, 1), 5e-13_dp, "determinant")
        plus = [1.0_dp, 0.3_dp]
        minus = plus
        call go(system, 0.0_dp, 0.5_dp, 2_i8, plus(1:1), plus(2:2))
        call go(system, 0.0_dp, 0.02_dp, 50_i8, minus(1:1), minus(2:2))
        call assertGreaterThan(maxval(abs(plus - minus)), 5e-10_dp, message="error of the flow")
    end subroutine flow_preserves_area

    subroutine steps_can_be_undone()
        !! Forwards and backwards: rounding is left, also with velocities and time in the forces.
        type(plain_system_t) :: system
        real(dp), parameter :: start(4) = [0.8_dp, 1.9_dp, -0.4_dp, 1.1_dp]
        real(dp) :: q(2), v(2)

        system%ndof = 2
        q = start(1:2)
        v = start(3:4)
        call go(system, 0.3_dp, 0.7_dp, 40_i8, q, v)
        call assertGreaterThan(maxval(abs([q, v] - start)), 0.1_dp, message="it moved")
        call go(system, 0.3_dp + 40*0.7_dp, -0.7_dp, 40_i8, q, v)
        call assertEqual(start, [q, v], 1e-12_dp, "back again")
    end subroutine steps_can_be_undone

    subroutine cuts_leave_no_trace()
        !! The same bytes in one block and in many, and again after another run in between.
        type(pendulum_t) :: system
        type(gauss_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), whole(2), fresh_q(1), fresh_v(1)
        integer(i8) :: k

        call system%configure([1.3_dp, 0.7_dp, 9.81_dp], error)
        call new_gauss16(method)
        call method%prepare(system, error)
        q = 2.5_dp
        v = 0.3_dp
        call method%start(system, 0.1_dp, q, v)
        call method%advance(system, 0.1_dp, 0.07_dp, 0_i8, 200_i8, q, v)
        whole = [q, v]
        q = 2.5_dp
        v = 0.3_dp
        k = 0
        call method%start(system, 0.1_dp, q, v)
        do while (k < 200)
            call method%advance(system, 0.1_dp, 0.07_dp, k, min(1 + k/3, 200 - k), q, v)
            k = k + min(1 + k/3, 200 - k)
        end do
        call assertEqual(whole, [q, v], 0.0_dp, "in blocks")
        q = q + 1e-3_dp
        fresh_q = q
        fresh_v = v
        call method%start(system, 0.1_dp + 200*0.07_dp, q, v)
        call method%advance(system, 0.1_dp, 0.07_dp, 200_i8, 5_i8, q, v)
        call go(system, 0.1_dp + 200*0.07_dp, 0.07_dp, 5_i8, fresh_q, fresh_v)
        call assertEqual([fresh_q, fresh_v], [q, v], 1e-14_dp, "from another state")
    end subroutine cuts_leave_no_trace

    subroutine energy_walks_at_random()
        !! Pendulum from 1.7 to 2 rad, 20000 steps of 0.05 s. Rounding of the accelerations, 1e-15,
        !! enters with the weights 0.05 s*0.4; \(\sqrt{20000}\) of that makes 4e-15 of the energy.
        !! Without the low parts of the state it is ten times as much. With the start values from
        !! the last step four sweeps a step are enough.
        type(pendulum_t) :: system
        type(gauss_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), e, drift
        integer :: k

        call system%configure([1.0_dp, 1.0_dp, 9.81_dp], error)
        call new_gauss16(method)
        drift = 0.0_dp
        do k = 0, 3
            call method%prepare(system, error)
            q = 2.0_dp - 0.1_dp*k
            v = 0.0_dp
            e = system%energy(0.0_dp, q, v)
            call method%start(system, 0.0_dp, q, v)
            call method%advance(system, 0.0_dp, 0.05_dp, 0_i8, 20000_i8, q, v)
            drift = drift + abs(system%energy(0.0_dp, q, v)/e - 1.0_dp)
            call assertLessThan(method%evaluations, 8*90000_i8, message="evaluations")
        end do
        call assertLessThan(drift, 4e-14_dp, message="energy")
    end subroutine energy_walks_at_random

    subroutine energy_has_no_bias()
        !! The mean of 24 walks as above, of 10000 steps that are three times as long: 3e-15 each,
        !! and 6e-16 of all. Sweeps that are inexact up to the last but one make 2.6e-15, though
        !! each of these runs alone hides it.
        type(pendulum_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), e, drift
        integer :: k

        call system%configure([1.0_dp, 1.0_dp, 9.81_dp], error)
        drift = 0.0_dp
        do k = 1, 24
            q = 2.2_dp - 0.05_dp*k
            v = 0.0_dp
            e = system%energy(0.0_dp, q, v)
            call go(system, 0.0_dp, 0.14_dp, 10000_i8, q, v)
            drift = drift + (system%energy(0.0_dp, q, v) - e)/9.81_dp/24.0_dp
        end do
        call assertLessThan(abs(drift), 1.8e-15_dp, message="mean energy")
    end subroutine energy_has_no_bias

    subroutine time_and_velocities_count()
        !! A wrong time or velocity of a stage shows against steps of an eighth.
        type(plain_system_t) :: system
        real(dp) :: q(2), v(2), x(2), y(2)

        system%ndof = 2
        q = [0.8_dp, 1.9_dp]
        v = [-0.4_dp, 1.1_dp]
        x = q
        y = v
        call go(system, 0.3_dp, 0.4_dp, 10_i8, q, v)
        call go(system, 0.3_dp, 0.05_dp, 80_i8, x, y)
        call assertEqual([x, y], [q, v], 1e-13_dp, "steps of 0.4 and 0.05")
    end subroutine time_and_velocities_count

    subroutine disk_rolls()
        !! Non-holonomic: the forces of constraint are in the accelerations. Against the circle.
        type(rolling_disk_t) :: system
        type(error_t), allocatable :: error
        class(reference_t), allocatable :: reference
        real(dp) :: q(4), v(4), q_true(4), v_true(4)

        call system%configure([1.3_dp, 0.3_dp, 0.05_dp, 0.03_dp, 9.81_dp, 0.4_dp], error)
        q = [0.1_dp, -0.2_dp, 0.3_dp, 0.7_dp]
        call system%complete_velocities(0.0_dp, q, [4.0_dp, 1.1_dp], v, error)
        call system%closed_form(0.0_dp, q, v, reference)
        call reference%state_at(8.0_dp, q_true, v_true)
        call go(system, 0.0_dp, 0.2_dp, 40_i8, q, v)
        call assertEqual([q_true, v_true], [q, v], 1e-12_dp, "rolling on an incline")
    end subroutine disk_rolls

    subroutine rest_and_constant_forces()
        !! Nothing to iterate on, or only noise: upside down the sine of pi is 1e-16.
        type(pendulum_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)

        call system%configure([1.0_dp, 1.0_dp, 9.81_dp], error)
        q = 0.0_dp
        v = 0.0_dp
        call go(system, 0.0_dp, 0.1_dp, 10_i8, q, v)
        call assertEqual([0.0_dp, 0.0_dp], [q, v], 0.0_dp, "at rest")
        q = acos(-1.0_dp)
        call go(system, 0.0_dp, 0.1_dp, 10_i8, q, v)
        call assertEqual(acos(-1.0_dp), q(1), 1e-13_dp, "upside down")
        call system%configure([1.0_dp, 1.0_dp, 0.0_dp], error)
        q = 1.0_dp
        v = 3.0_dp
        call go(system, 0.0_dp, 2.0_dp, 10_i8, q, v)
        call assertEqual([61.0_dp, 3.0_dp], [q, v], 100.0_dp*epsilon(1.0_dp), "without forces")
    end subroutine rest_and_constant_forces

    subroutine divergence_is_not_hidden()
        !! \(\omega h = 1000\): sweeps grow without bound, and the state is not a number. The
        !! iteration converges for \(\omega h < 11.3\), one over the spectral radius of \(a\).
        type(oscillator_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)

        call system%configure([1.0_dp, 1e6_dp], error)
        q = 1.0_dp
        v = 0.0_dp
        call go(system, 0.0_dp, 1.0_dp, 3_i8, q, v)
        call assertTrue(ieee_is_nan(q(1)) .and. ieee_is_nan(v(1)), "far too long a step")
        q = 1.0_dp
        v = 0.0_dp
        call go(system, 0.0_dp, 0.01_dp, 100_i8, q, v)
        call assertFalse(ieee_is_nan(q(1)), "a long step")
        call assertLessThan(abs(system%energy(0.0_dp, q, v)/0.5e6_dp - 1.0_dp), 1e-11_dp, &
                            message="energy is a quadratic invariant")
    end subroutine divergence_is_not_hidden
end module test_gauss
