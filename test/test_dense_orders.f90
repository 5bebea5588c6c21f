module test_dense_orders
    !! Orders of dense output where two coordinates drive each other: inside one step of the
    !! double pendulum, beside `gauss16` in steps whose error is rounding.
    use funit, only: assertEqual, assertGreaterThan, assertLessThan, assertTrue, TestMethod, &
                     TestSuite
    use lagrangia_dop853, only: dop853_t, new_dop853
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_gauss, only: gauss_t, new_gauss16
    use lagrangia_gauss_dense, only: gauss_dense_t
    use lagrangia_gauss_tables, only: legendre, nodes, stages, weights
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_stepwise, only: new_stepwise, stepwise_t
    use polynomial_motion, only: new_polynomial_motion, polynomial_motion_t
    implicit none (type, external)
    private
    public :: dense_orders_suite

    integer, parameter :: motions = 6, places = 9

contains

    function dense_orders_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("dense_orders")
        call suite%addTest(TestMethod("dop853_has_order_7_inside", dop853_has_order_7_inside))
        call suite%addTest(TestMethod("gauss16_has_order_16_inside", gauss16_has_order_16_inside))
        call suite%addTest(TestMethod("a_quintic_is_exact_between_fixed_steps", &
                                      a_quintic_is_exact_between_fixed_steps))
        call suite%addTest(TestMethod("powers_up_to_7_are_exact_in_dop853", &
                                      powers_up_to_7_are_exact_in_dop853))
        call suite%addTest(TestMethod("powers_up_to_17_are_exact_in_gauss16", &
                                      powers_up_to_17_are_exact_in_gauss16))
    end function dense_orders_suite

    subroutine new_motion(i, system, q, v)
        !! Motion `i`, in one phase or another.
        integer, intent(in) :: i
        type(double_pendulum_t), intent(out) :: system
        real(dp), intent(out) :: q(2), v(2)
        type(error_t), allocatable :: error

        call system%configure([1.3_dp, 0.7_dp, 1.9_dp, 1.4_dp, 9.81_dp], error)
        q = 0.5_dp*[cos(0.8_dp*i), sin(1.1_dp*i)]
        v = 1.5_dp*[sin(0.8_dp*i), cos(1.1_dp*i)]
    end subroutine new_motion

    subroutine exact(system, t, q, v)
        !! From 0 to `t`.
        type(double_pendulum_t), intent(in) :: system
        real(dp), intent(in) :: t
        real(dp), intent(inout) :: q(2), v(2)
        type(gauss_t) :: method
        type(error_t), allocatable :: error

        call new_gauss16(method)
        call method%prepare(system, error)
        call method%advance(system, 0.0_dp, t/8, 0_i8, 8_i8, q, v)
    end subroutine exact

    subroutine dop853_has_order_7_inside()
        !! Its error goes with the eighth power of the step, in coordinates and velocities.
        type(double_pendulum_t) :: system
        type(dop853_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: errors(2, 2), h, q(2), v(2), q_true(2), v_true(2), q0(2), v0(2)
        integer :: i, j, k

        errors = 0.0_dp
        do k = 1, 2
            h = 0.12_dp/k
            do i = 1, motions
                call new_motion(i, system, q0, v0)
                call new_dop853(method)
                method%tolerance = 100.0_dp
                call method%prepare(system, error)
                call method%start(system, 0.0_dp, q0, v0, h)
                call method%step(system, error)
                call assertEqual(h, method%t_new, message="one step")
                do j = 1, places
                    q_true = q0
                    v_true = v0
                    call exact(system, 0.1_dp*j*h, q_true, v_true)
                    call method%state_at(0.1_dp*j*h, q, v)
                    errors(:, k) = errors(:, k) + [norm2(q - q_true), norm2(v - v_true)]
                end do
            end do
        end do
        call assertEqual([8.0_dp, 8.0_dp], log(errors(:, 1)/errors(:, 2))/log(2.0_dp), 0.3_dp, &
                         "order of q and v")
    end subroutine dop853_has_order_7_inside

    subroutine gauss16_has_order_16_inside()
        !! The error at the end, of the step's length to the power of 17, is spread over the step:
        !! as much in the coordinates, and their error over the length in the velocities. The next
        !! terms take 0.4; rounding is 1e-4 of the errors of the shorter step.
        type(double_pendulum_t) :: system
        real(dp) :: errors(2, 2), h, q(2), v(2), q_true(2), v_true(2), q0(2), v0(2)
        type(gauss_dense_t) :: inside
        integer :: i, j, k

        errors = 0.0_dp
        do k = 1, 2
            h = merge(0.9_dp, 0.6_dp, k == 1)
            do i = 1, motions
                call new_motion(i, system, q0, v0)
                q0 = 0.05_dp*q0
                v0 = 0.05_dp*v0
                call one_gauss_step(system, h, q0, v0, inside)
                do j = 1, places
                    q_true = q0
                    v_true = v0
                    call exact(system, 0.1_dp*j*h, q_true, v_true)
                    call inside%at(0.1_dp*j*h, q, v)
                    errors(:, k) = errors(:, k) + [norm2(q - q_true), norm2(v - v_true)]
                end do
            end do
        end do
        call assertEqual([17.0_dp, 16.0_dp], log(errors(:, 1)/errors(:, 2))/log(1.5_dp), 0.5_dp, &
                         "order of q and v")
    end subroutine gauss16_has_order_16_inside

    subroutine one_gauss_step(system, h, q0, v0, inside)
        !! One step of `gauss16`, and its dense output, which begins with the Legendre
        !! coefficients of the accelerations: here from those of the exact motion at the nodes.
        type(double_pendulum_t), intent(in) :: system
        real(dp), intent(in) :: h, q0(2), v0(2)
        type(gauss_dense_t), intent(out) :: inside
        real(dp), parameter :: weight(2) = 1e33_dp  !! so that rounding alone is left
        type(gauss_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2), a(2), p(stages, stages), modes(stages, 2)
        integer :: i, k
        logical :: good

        p = legendre(nodes)
        modes = 0.0_dp
        do i = 1, stages
            q = q0
            v = v0
            call exact(system, nodes(i)*h, q, v)
            call system%accelerations(nodes(i)*h, q, v, a)
            do k = 1, stages
                modes(k, :) = modes(k, :) + (2*k - 1)*weights(i)*p(i, k)*a
            end do
        end do
        q = q0
        v = v0
        call new_gauss16(method)
        call method%prepare(system, error)
        call method%advance(system, 0.0_dp, h, 0_i8, 1_i8, q, v)
        call inside%prepare(2)
        call inside%keep(0.0_dp, q0, v0)
        call inside%fit(system, h, q, v, modes, weight, good)
        call assertTrue(good, "dense output")
    end subroutine one_gauss_step

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
            call inside%fit(system, t1, y_new(:1), y_new(2:), modes, weight, good)
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
end module test_dense_orders
