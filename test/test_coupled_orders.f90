module test_coupled_orders
    !! Orders where two coordinates drive each other: on the double pendulum and the cart-pendulum,
    !! whose accelerations depend on the velocities, and on Hénon & Heiles's, whose do not.
    !!
    !! No closed form is known. The truth is `gauss16` in steps whose error is rounding; `dop853`
    !! says the same. Errors are added up over some motions, which evens out that each may vanish.
    use coupled_problems, only: new_problem, problems, start
    use funit, only: assertEqual, TestMethod, TestSuite
    use lagrangia_dop853, only: dop853_t, new_dop853
    use lagrangia_errors, only: error_t
    use lagrangia_gauss, only: gauss_t, new_gauss16
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: nth_integrator
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: coupled_orders_suite

contains

    function coupled_orders_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("coupled_orders")
        call suite%addTest(TestMethod("two_methods_know_the_truth", two_methods_know_the_truth))
        call suite%addTest(TestMethod("every_method_has_its_order", every_method_has_its_order))
        call suite%addTest(TestMethod("dop853_has_order_8", dop853_has_order_8))
        call suite%addTest(TestMethod("gauss16_has_order_16", gauss16_has_order_16))
        call suite%addTest(TestMethod("gauss16_has_order_16_in_energy", &
                                      gauss16_has_order_16_in_energy))
    end function coupled_orders_suite

    subroutine go(method, system, duration, steps, y)
        !! Through `duration`.
        class(integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: duration
        integer, intent(in) :: steps
        real(dp), intent(inout) :: y(4)
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2)

        q = y(:2)
        v = y(3:)
        call method%prepare(system, error)
        call method%start(system, 0.0_dp, q, v)
        call method%advance(system, 0.0_dp, duration/steps, 0_i8, int(steps, i8), q, v)
        y = [q, v]
    end subroutine go

    function truth(system, duration, large, motions) result(ends)
        !! The states at the end, `ends(4, motions)`.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: duration, large
        integer, intent(in) :: motions
        real(dp) :: ends(4, motions)
        type(gauss_t) :: method
        real(dp) :: y(4)
        integer :: i

        call new_gauss16(method)
        do i = 1, motions
            y = start(i, large)
            call go(method, system, duration, nint(15.0_dp*duration), y)
            ends(:, i) = y
        end do
    end function truth

    function sum_errors(method, system, duration, large, ends, steps) result(errors)
        !! Over the motions, at the end, in so many steps and in twice as many.
        class(integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: duration, large, ends(:, :)
        integer, intent(in) :: steps
        real(dp) :: errors(2), y(4)
        integer :: i, k

        errors = 0.0_dp
        do i = 1, size(ends, 2)
            do k = 1, 2
                y = start(i, large)
                call go(method, system, duration, k*steps, y)
                errors(k) = errors(k) + norm2(y - ends(:, i))
            end do
        end do
    end function sum_errors

    pure function order_of(errors) result(order)
        !! From errors of steps that are half as long.
        real(dp), intent(in) :: errors(2)
        real(dp) :: order

        order = log(errors(1)/errors(2))/log(2.0_dp)
    end function order_of

    subroutine two_methods_know_the_truth()
        !! To the rounding of some hundred steps, which the motion carries on.
        type(gauss_t) :: method
        type(dop853_t) :: other
        class(system_t), allocatable :: system
        real(dp) :: y(4), y_other(4)
        integer :: k

        do k = 1, problems
            call new_problem(k, system)
            y = start(1, 0.5_dp)
            y_other = y
            call new_gauss16(method)
            call go(method, system, 2.0_dp, 30, y)
            call new_dop853(other)
            call go(other, system, 2.0_dp, 400, y_other)
            call assertEqual(y, y_other, 5e-14_dp, "gauss16 and dop853")
        end do
    end subroutine two_methods_know_the_truth

    subroutine every_method_has_its_order()
        !! All that a problem is for, up to order 8, and with compensated sums.
        class(integrator_t), allocatable :: method, variant
        class(system_t), allocatable :: system
        type(error_t), allocatable :: refusal
        real(dp) :: ends(4, 4)
        integer :: i, k, measured

        measured = 0
        do k = 1, problems
            call new_problem(k, system)
            ends = truth(system, 2.0_dp, 0.3_dp, 4)
            i = 0
            do
                i = i + 1
                call nth_integrator(i, method)
                if (.not. allocated(method)) exit
                if (method%order > 8) cycle
                call method%prepare(system, refusal)
                if (allocated(refusal)) cycle
                measured = measured + 1
                call check_order(method, system, ends)
                call method%compensated(variant)
                if (allocated(variant)) call check_order(variant, system, ends)
            end do
        end do
        call assertEqual(18, measured, "methods and problems")
    end subroutine every_method_has_its_order

    subroutine check_order(method, system, ends)
        !! From n steps and 2n, n so large that the leading term of the error rules, and no larger.
        class(integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: ends(:, :)
        real(dp) :: errors(2)
        integer :: steps

        steps = 8
        do
            steps = steps + steps/4
            errors = sum_errors(method, system, 2.0_dp, 0.3_dp, ends, steps)
            if (errors(1) < 10.0_dp**(-min(1 + method%order, 9)) .or. steps > 10000) exit
        end do
        call assertEqual(real(method%order, dp), order_of(errors), 0.1_dp, trim(method%name))
    end subroutine check_order

    subroutine dop853_has_order_8()
        !! In steps of one length, with errors from 1e-8 to 1e-12. Its leading term is so small
        !! that the next ones take 0.2 of an order, or add 0.1.
        type(dop853_t) :: method

        call new_dop853(method)
        call check_mean_order(method, 4.0_dp, [60, 25, 20], [0.3_dp, 0.3_dp, 0.3_dp])
    end subroutine dop853_has_order_8

    subroutine gauss16_has_order_16()
        !! Small motions and long steps: errors from 1e-7 to 1e-12, above rounding by a factor of
        !! five and more. There the next terms take 0.3 of an order.
        type(gauss_t) :: method

        call new_gauss16(method)
        call check_mean_order(method, 8.0_dp, [12, 8, 5], [0.1_dp, 0.1_dp, 0.3_dp])
    end subroutine gauss16_has_order_16

    subroutine gauss16_has_order_16_in_energy()
        !! Its largest change on the way, where only what is not linear changes it: from 1e-8 to
        !! 1e-13, which is five times rounding. There the next terms take 0.4 of an order.
        integer, parameter :: steps(problems) = [11, 8, 6], motions = 8
        real(dp), parameter :: large(problems) = [0.1_dp, 0.1_dp, 0.3_dp]
        type(gauss_t) :: method
        class(system_t), allocatable :: system
        real(dp) :: swings(2), orders(problems)
        integer :: i, j, k

        call new_gauss16(method)
        do k = 1, problems
            call new_problem(k, system)
            swings = 0.0_dp
            do i = 1, motions
                do j = 1, 2
                    swings(j) = swings(j) + swing(method, system, start(i, large(k)), j*steps(k))
                end do
            end do
            orders(k) = order_of(swings)
        end do
        call assertEqual(real(method%energy_order, dp), sum(orders)/problems, 0.5_dp, "order")
    end subroutine gauss16_has_order_16_in_energy

    function swing(method, system, y, steps)
        !! The largest change of the energy from the start, at the ends of all steps through 8 s.
        class(integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: y(4)
        integer, intent(in) :: steps
        real(dp) :: swing
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2), energy
        integer(i8) :: i

        q = y(:2)
        v = y(3:)
        energy = system%energy(0.0_dp, q, v)
        swing = 0.0_dp
        call method%prepare(system, error)
        call method%start(system, 0.0_dp, q, v)
        do i = 0, steps - 1
            call method%advance(system, 0.0_dp, 8.0_dp/steps, i, 1_i8, q, v)
            swing = max(swing, abs(system%energy(0.0_dp, q, v) - energy))
        end do
    end function swing

    subroutine check_mean_order(method, duration, steps, large)
        !! Over all problems, each with its own `steps` and size of the motion.
        class(integrator_t), intent(inout) :: method
        real(dp), intent(in) :: duration, large(problems)
        integer, intent(in) :: steps(problems)
        class(system_t), allocatable :: system
        real(dp) :: orders(problems)
        integer :: k

        do k = 1, problems
            call new_problem(k, system)
            orders(k) = order_of(sum_errors(method, system, duration, large(k), &
                                            truth(system, duration, large(k), 8), steps(k)))
        end do
        call assertEqual(real(method%order, dp), sum(orders)/problems, 0.3_dp, method%name)
    end subroutine check_mean_order
end module test_coupled_orders
