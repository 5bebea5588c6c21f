module test_dop853
    !! `dop853` on the pendulum, whose motion is known in closed form.
    use funit, only: assertEqual, assertFalse, assertGreaterThan, assertLessThan, TestMethod, &
                     TestSuite
    use lagrangia_dop853, only: dop853_t, new_dop853
    use lagrangia_dop853_stages, only: scaled_error, slope, stages
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_reference, only: reference_t
    implicit none (type, external)
    private
    public :: dop853_suite

    real(dp), parameter :: q0(1) = [1.0_dp], v0(1) = [-0.7_dp]

contains

    function dop853_suite() result(suite)
        type(TestSuite) :: suite

        suite = TestSuite("dop853")
        call suite%addTest(TestMethod("fixed steps have order 8", fixed_steps_have_order_8))
        call suite%addTest(TestMethod("dense output has order 7", dense_output_has_order_7))
        call suite%addTest(TestMethod("the estimate falls as h^8", estimate_falls_as_h8))
        call suite%addTest(TestMethod("the error follows the tolerance", error_follows_tolerance))
        call suite%addTest(TestMethod("every evaluation is counted", evaluations_are_counted))
    end function dop853_suite

    subroutine set_up(system, reference, method)
        type(pendulum_t), intent(out) :: system
        class(reference_t), allocatable, intent(out) :: reference
        type(dop853_t), intent(out) :: method
        type(error_t), allocatable :: error

        call system%configure([0.7_dp, 1.3_dp, 9.81_dp], error)
        call system%closed_form(0.0_dp, q0, v0, reference)
        call new_dop853(method)
        call method%prepare(system, error)
        call assertFalse(allocated(error), "prepare")
    end subroutine set_up

    subroutine fixed_steps_have_order_8()
        !! Halving the step divides the error by 2**8. Between 7.7 and 8.3: the next term of the
        !! error is some tenth of the first at these steps; rounding is below 1e-4 of both.
        type(pendulum_t) :: system
        class(reference_t), allocatable :: reference
        type(dop853_t) :: method
        real(dp) :: q(1), v(1), q_true(1), v_true(1), errors(2)
        integer :: i

        call set_up(system, reference, method)
        call reference%state_at(4.0_dp, q_true, v_true)
        do i = 1, 2
            q = q0
            v = v0
            call method%start(system, 0.0_dp, q, v)
            call method%advance(system, 0.0_dp, 0.2_dp/i, 0_i8, 20_i8*i, q, v)
            errors(i) = hypot(q(1) - q_true(1), v(1) - v_true(1))
        end do
        call assertEqual(8.0_dp, log(errors(1)/errors(2))/log(2.0_dp), 0.3_dp, "order")
        call assertEqual(60*12_i8 + 2*2, method%evaluations, message="evaluations of steps, starts")
    end subroutine fixed_steps_have_order_8

    subroutine one_step(h, errors)
        !! The largest errors of the dense output over one step, of the solution at its end.
        real(dp), intent(in) :: h
        real(dp), intent(out) :: errors(2)
        type(pendulum_t) :: system
        class(reference_t), allocatable :: reference
        type(dop853_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), q_true(1), v_true(1), t
        integer :: i

        call set_up(system, reference, method)
        method%tolerance = 1e2_dp
        call method%start(system, 0.0_dp, q0, v0, h)
        errors = 0.0_dp
        do while (method%t_new < h)
            call method%step(system, error)
            do i = 1, 20
                t = method%t_old + i/20.0_dp*(method%t_new - method%t_old)
                call method%state_at(t, q, v)
                call reference%state_at(t, q_true, v_true)
                errors = [max(errors(1), hypot(q(1) - q_true(1), v(1) - v_true(1))), &
                          hypot(q(1) - q_true(1), v(1) - v_true(1))]
            end do
        end do
        call assertEqual(1_i8, method%accepted, message="one step")
    end subroutine one_step

    subroutine dense_output_has_order_7()
        !! Within a step its error falls as h**8, at the end as h**9 or faster.
        real(dp) :: long(2), short(2), orders(2)

        call one_step(0.14_dp, long)
        call one_step(0.07_dp, short)
        orders = log(long/short)/log(2.0_dp)
        call assertEqual(8.0_dp, orders(1), 0.5_dp, "within")
        call assertGreaterThan(orders(2), 8.5_dp, message="at the end")
    end subroutine dense_output_has_order_7

    subroutine estimate_falls_as_h8()
        !! h (h**5)**2/h**3.
        type(pendulum_t) :: system
        real(dp) :: y0(2), y(2), k(2, 17), estimates(2)
        type(error_t), allocatable :: error
        integer :: i

        call system%configure([0.7_dp, 1.3_dp, 9.81_dp], error)
        y0 = [q0, v0]
        call slope(system, 1, 0.0_dp, y0, k(:, 1))
        do i = 1, 2
            call stages(system, 1, 0.0_dp, 0.1_dp/i, y0, k, y)
            estimates(i) = scaled_error(0.1_dp/i, 1e-6_dp, k, y0, y)
        end do
        call assertEqual(8.0_dp, log(estimates(1)/estimates(2))/log(2.0_dp), 0.3_dp, "order")
    end subroutine estimate_falls_as_h8

    subroutine error_follows_tolerance()
        !! Of ten seconds' local errors the sum, which grows but linearly with time, stays within
        !! 100 tolerances and above a thousandth of one: shorter steps would be a waste. The
        !! number of steps grows as the eighth root.
        type(pendulum_t) :: system
        class(reference_t), allocatable :: reference
        type(dop853_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), q_true(1), v_true(1), miss
        integer(i8) :: steps(2)
        integer :: i

        steps = 0
        do i = 4, 12, 2
            call set_up(system, reference, method)
            method%tolerance = 10.0_dp**(-i)
            call method%start(system, 0.0_dp, q0, v0, 10.0_dp)
            do while (method%t_new < 10.0_dp)
                call method%step(system, error)
                if (allocated(error)) exit
            end do
            call method%state_at(10.0_dp, q, v)
            call reference%state_at(10.0_dp, q_true, v_true)
            miss = hypot(q(1) - q_true(1), v(1) - v_true(1))/method%tolerance
            call assertLessThan(miss, 100.0_dp, message="error")
            call assertGreaterThan(miss, 1e-3_dp, message="no waste")
            if (i == 4) steps(1) = method%accepted
            steps(2) = method%accepted
        end do
        call assertEqual(8.0_dp, 8*log(10.0_dp)/log(real(steps(2), dp)/steps(1)), 1.0_dp, &
                         "steps grow as the eighth root")
    end subroutine error_follows_tolerance

    subroutine evaluations_are_counted()
        !! Two to start, eleven an attempt, four for what an accepted step needs besides.
        type(pendulum_t) :: system
        class(reference_t), allocatable :: reference
        type(dop853_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)
        integer :: i

        call set_up(system, reference, method)
        call method%start(system, 0.0_dp, [0.1_dp], [9.0_dp], 30.0_dp)
        do while (method%t_new < 30.0_dp)
            call method%step(system, error)
            do i = 1, 10
                call method%state_at(method%t_old, q, v)
            end do
        end do
        call assertEqual(2 + 15*method%accepted + 11*method%rejected, method%evaluations, &
                         message="evaluations")
    end subroutine evaluations_are_counted
end module test_dop853
