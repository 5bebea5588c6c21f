module test_dense_powers
    !! What dense output reproduces: powers of the time, to rounding, up to the degree that it has
    !! room for, and no further.
    use funit, only: assertEqual, assertGreaterThan, assertLessThan, TestMethod, TestSuite
    use lagrangia_dop853, only: dop853_t, new_dop853
    use lagrangia_errors, only: error_t
    use lagrangia_gauss, only: gauss_t, new_gauss16
    use lagrangia_gauss_dense, only: gauss_dense_t
    use lagrangia_gauss_tables, only: stages
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp
    use lagrangia_stepwise, only: new_stepwise, stepwise_t
    use polynomial_motion, only: new_polynomial_motion, polynomial_motion_t
    implicit none (type, external)
    private
    public :: dense_powers_suite

    integer, parameter :: places = 9

contains

    function dense_powers_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("dense_powers")
        call suite%addTest(TestMethod("a_quintic_is_exact_between_fixed_steps", &
                                      a_quintic_is_exact_between_fixed_steps))
        call suite%addTest(TestMethod("powers_up_to_7_are_exact_in_dop853", &
                                      powers_up_to_7_are_exact_in_dop853))
        call suite%addTest(TestMethod("powers_up_to_17_are_exact_in_gauss16", &
                                      powers_up_to_17_are_exact_in_gauss16))
        call suite%addTest(TestMethod("what_the_ends_err_is_spread", what_the_ends_err_is_spread))
    end function dense_powers_suite

    subroutine a_quintic_is_exact_between_fixed_steps()
        !! To rounding, as the steps are; a sextic is not.
        type(polynomial_motion_t) :: system
        type(gauss_t) :: exact_steps
        type(stepwise_t) :: method
        real(dp) :: miss
        integer :: n

        call new_gauss16(exact_steps)
        call new_stepwise(method, exact_steps, 0.5_dp)
        do n = 2, 6
            call new_polynomial_motion(system, n)
            call follow(method, system, 0.75_dp, miss)
            if (n <= 5) call assertLessThan(miss, 1e-14_dp, message="up to 5")
        end do
        call assertGreaterThan(miss, 1e-3_dp, message="not 6")
    end subroutine a_quintic_is_exact_between_fixed_steps

    subroutine powers_up_to_7_are_exact_in_dop853()
        !! To the rounding of weights that reach 500; the eighth is not.
        type(polynomial_motion_t) :: system
        type(dop853_t) :: method
        real(dp) :: miss
        integer :: n

        call new_dop853(method)
        method%tolerance = 1e6_dp
        do n = 2, 8
            call new_polynomial_motion(system, n)
            call follow(method, system, 0.75_dp, miss)
            if (n <= 7) call assertLessThan(miss, 1e-13_dp, message="up to 7")
        end do
        call assertGreaterThan(miss, 1e-7_dp, message="not 8")
    end subroutine powers_up_to_7_are_exact_in_dop853

    subroutine follow(method, system, t_end, miss)
        !! From 0.25 s in steps of the method's own: the largest error between their ends.
        class(dense_integrator_t), intent(inout) :: method
        type(polynomial_motion_t), intent(in) :: system
        real(dp), intent(in) :: t_end
        real(dp), intent(out) :: miss
        real(dp), parameter :: t0 = 0.25_dp
        type(error_t), allocatable :: error
        real(dp) :: y(2), q(1), v(1), t
        integer :: i

        miss = 0.0_dp
        y = system%state(t0)
        call method%prepare(system, error)
        call method%start(system, t0, y(:1), y(2:), t_end)
        do while (method%t_new < t_end)
            call method%step(system, error)
            do i = 1, places
                t = method%t_old + 0.1_dp*i*(method%t_new - method%t_old)
                call method%state_at(t, q, v)
                miss = max(miss, maxval(abs([q, v] - system%state(t))))
            end do
        end do
    end subroutine follow

    subroutine powers_up_to_17_are_exact_in_gauss16()
        !! Sixteen accelerations along a step, integrated twice; to rounding if the ends are.
        type(polynomial_motion_t) :: system
        type(gauss_dense_t) :: inside
        real(dp), parameter :: weight(1) = 1.0_dp, t0 = -0.3_dp, t1 = 1.0_dp
        real(dp) :: y(2), y_new(2), q(1), v(1), modes(stages, 1), t, miss
        integer :: i, n
        logical :: good

        modes = 0.0_dp
        call inside%prepare(1)
        do n = 2, 18
            call new_polynomial_motion(system, n)
            y = system%state(t0)
            y_new = system%state(t1)
            call inside%keep(t0, y(:1), y(2:))
            call inside%fit(system, t1, y_new(:1), y_new(2:), modes, [0.0_dp], [0.0_dp], weight, &
                            good)
            miss = 0.0_dp
            do i = 1, places
                t = t0 + 0.1_dp*i*(t1 - t0)
                call inside%at(t, q, v)
                y = system%state(t)
                miss = max(miss, abs(q(1) - y(1)), abs(v(1) - y(2)))
            end do
            if (n <= 17) call assertLessThan(miss, 1e-13_dp, message="up to 17")
        end do
        call assertGreaterThan(miss, 1e-10_dp, message="not 18")
    end subroutine powers_up_to_17_are_exact_in_gauss16

    subroutine what_the_ends_err_is_spread()
        !! Of a uniform motion the end is wrong, in the coordinate and in the velocity: the cubic
        !! that has both ends goes through the step.
        type(polynomial_motion_t) :: system
        type(gauss_dense_t) :: inside
        real(dp), parameter :: weight(1) = 1.0_dp, h = 0.7_dp, off(2) = [0.3_dp, -0.9_dp]
        real(dp) :: q(1), v(1), modes(stages, 1), t, s, c(2)
        integer :: i
        logical :: good

        call new_polynomial_motion(system, 1)
        modes = 0.0_dp
        c = [3.0_dp*off(1) - h*off(2), h*off(2) - 2.0_dp*off(1)]
        call inside%prepare(1)
        call inside%keep(0.2_dp, [0.2_dp], [1.0_dp])
        call inside%fit(system, 0.2_dp + h, [0.2_dp + h + off(1)], [1.0_dp + off(2)], modes, &
                        [0.0_dp], [0.0_dp], weight, good)
        do i = 1, places
            s = 0.1_dp*i
            t = 0.2_dp + s*h
            call inside%at(t, q, v)
            call assertEqual(t + s**2*(c(1) + s*c(2)), q(1), 1e-15_dp, "coordinate")
            call assertEqual(1.0_dp + s*(2.0_dp*c(1) + s*3.0_dp*c(2))/h, v(1), 1e-14_dp, "velocity")
        end do
    end subroutine what_the_ends_err_is_spread
end module test_dense_powers
