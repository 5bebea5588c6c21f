module test_dense_orders
    !! Orders of dense output where two coordinates drive each other: inside one step of the
    !! double pendulum, beside `gauss16` in steps whose error is rounding.
    use funit, only: assertEqual, assertLessThan, assertTrue, TestMethod, TestSuite
    use lagrangia_dop853, only: dop853_t, new_dop853
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_gauss, only: gauss_t, new_gauss16
    use lagrangia_gauss_adaptive, only: gauss_adaptive_t, new_gauss16_adaptive
    use lagrangia_gauss_dense, only: gauss_dense_t
    use lagrangia_gauss_tables, only: legendre, nodes, stages, weights
    use lagrangia_kinds, only: dp, i8
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
        call suite%addTest(TestMethod("dense_output_takes_few_sweeps", &
                                      dense_output_takes_few_sweeps))
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
        call method%start(system, 0.0_dp, q, v)
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
        real(dp) :: q(2), v(2), a(2), a0(2), p(stages, stages), modes(stages, 2)
        integer :: i, k
        logical :: good

        call legendre(nodes, p)
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
        call method%start(system, 0.0_dp, q, v)
        call method%advance(system, 0.0_dp, h, 0_i8, 1_i8, q, v)
        call system%accelerations(0.0_dp, q0, v0, a0)
        call system%accelerations(h, q, v, a)
        call inside%prepare(2)
        call inside%keep(0.0_dp, q0, v0)
        call inside%fit(system, h, q, v, modes, a0, a, weight, good)
        call assertTrue(good, "dense output")
    end subroutine one_gauss_step

    subroutine dense_output_takes_few_sweeps()
        !! Of 16 evaluations: mostly one, as the guess, the collocation polynomial bent into the
        !! accelerations at the ends, is close to begin with. Not bent it takes two.
        type(double_pendulum_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2)
        integer(i8) :: evaluations(2)
        integer :: i, k

        call new_gauss16_adaptive(method)
        do k = 4, 12, 4
            method%tolerance = 10.0_dp**(-k)
            do i = 1, 2
                method%dense = i == 2
                call new_motion(1, system, q, v)
                call method%prepare(system, error)
                call method%start(system, 0.0_dp, q, v, 5.0_dp)
                do while (method%t_new < 5.0_dp)
                    call method%step(system, error)
                end do
                evaluations(i) = method%evaluations
            end do
            call assertLessThan(evaluations(2) - evaluations(1), 24*method%accepted, &
                                message="1.5 sweeps a step")
        end do
    end subroutine dense_output_takes_few_sweeps
end module test_dense_orders
