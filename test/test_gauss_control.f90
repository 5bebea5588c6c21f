module test_gauss_control
    !! How `gauss16` judges a step and its iteration.
    use coupled_problems, only: new_problem, start
    use driven_wall, only: driven_wall_t
    use funit, only: TestMethod, TestSuite, assertEqual, assertGreaterThan, assertLessThan, &
                     assertTrue
    use lagrangia_dop853, only: dop853_t, new_dop853
    use lagrangia_errors, only: error_t
    use lagrangia_gauss, only: gauss_t, new_gauss16
    use lagrangia_gauss_adaptive, only: gauss_adaptive_t, new_gauss16_adaptive
    use lagrangia_gauss_control, only: longer, weigh
    use lagrangia_gauss_tables, only: legendre, nodes, stages, weights
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: system_t
    use run_doubles, only: exploding_t
    implicit none (type, external)
    private
    public :: gauss_control_suite

    real(dp), parameter :: rounding = 10.0_dp*epsilon(1.0_dp)

contains

    function gauss_control_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("gauss_control")
        call suite%addTest(TestMethod("accelerations_weigh_by_what_they_change", &
                                      accelerations_weigh_by_what_they_change))
        call suite%addTest(TestMethod("norms_are_those_of_legendre", norms_are_those_of_legendre))
        call suite%addTest(TestMethod("estimate_goes_with_the_16th_power", &
                                      estimate_goes_with_the_16th_power))
        call suite%addTest(TestMethod("estimate_meets_the_error", estimate_meets_the_error))
        call suite%addTest(TestMethod("forces_that_set_in_are_seen", forces_that_set_in_are_seen))
        call suite%addTest(TestMethod("a_step_over_a_hole_is_taken_back", &
                                      a_step_over_a_hole_is_taken_back))
        call suite%addTest(TestMethod("steps_of_a_few_ulp_still_shrink", &
                                      steps_of_a_few_ulp_still_shrink))
    end function gauss_control_suite

    subroutine accelerations_weigh_by_what_they_change()
        !! The velocity by `h`, the coordinate by `h**2`: the larger change, absolute up to 1 and
        !! relative above; in tolerances, squared.
        real(dp), parameter :: tolerance = 1e-3_dp

        call check(0.5_dp, 0.0_dp, 0.0_dp, 0.5_dp)
        call check(0.5_dp, 0.9_dp, -0.9_dp, 0.5_dp)
        call check(0.5_dp, 0.0_dp, -4.0_dp, 0.25_dp)
        call check(0.5_dp, 0.0_dp, 1.25_dp, 0.4_dp)
        call check(0.5_dp, -2.0_dp, 5.0_dp, 0.125_dp)
        call check(0.5_dp, 100.0_dp, 10.0_dp, 0.05_dp)
        call check(3.0_dp, 0.0_dp, 0.0_dp, 9.0_dp)
        call check(3.0_dp, 2.0_dp, 0.0_dp, 4.5_dp)
        call check(3.0_dp, 9.0_dp, -2.0_dp, 1.5_dp)
    contains
        subroutine check(h, q, v, change)
            real(dp), intent(in) :: h, q, v, change
            real(dp) :: weight(1)

            call weigh(1, h, tolerance, [q], [v], weight)
            call assertEqual(change, tolerance*sqrt(weight(1)), rounding, "change")
        end subroutine check
    end subroutine accelerations_weigh_by_what_they_change

    subroutine norms_are_those_of_legendre()
        !! Polynomials of one mean square, whatever their degree, count the same: among degrees 0
        !! to 3, and among 6 and 7; those of 4 and 5 count a thousandth. So do coordinates.
        real(dp) :: modes(stages, 2), base, weight(2)
        integer :: k, d

        weight = [3.0_dp, 7.0_dp]
        do k = 1, 8
            do d = 1, 2
                modes = 0.0_dp
                modes(1, 1) = merge(0.0_dp, 2.0_dp, k <= 4)
                modes(7, 1) = merge(0.0_dp, 0.1_dp*sqrt(13.0_dp), k >= 5)
                modes(k, d) = merge(2.0_dp, 0.1_dp, k <= 4)*sqrt((2*k - 1)*3.0_dp/weight(d))
                if (k == 5 .or. k == 6) modes(k, d) = modes(k, d)*sqrt(1000.0_dp)
                if (k == 1 .and. d == 1) base = longer(2, modes, weight)
                call assertEqual(base, longer(2, modes, weight), rounding*base, "ratio")
            end do
        end do
    end subroutine norms_are_those_of_legendre

    subroutine estimate_goes_with_the_16th_power()
        !! Of the step, where the coefficient of degree 6 goes with the sixth; and with one over
        !! the tolerance.
        real(dp) :: modes(stages, 1), weight(1), ratio, loose, shorter

        modes = 0.0_dp
        modes([1, 7], 1) = [2.0_dp, 1e-3_dp]
        weight = 1e12_dp
        ratio = longer(1, modes, weight)
        loose = longer(1, modes, weight*1e-4_dp)
        call assertEqual(ratio*100.0_dp**0.0625_dp, loose, rounding*loose, "100 tolerances")
        modes(7, 1) = modes(7, 1)/64.0_dp
        shorter = longer(1, modes, weight/4.0_dp)
        call assertEqual(2.0_dp*ratio, shorter, rounding*shorter, "half the step")
    end subroutine estimate_goes_with_the_16th_power

    subroutine estimate_meets_the_error()
        !! On the double pendulum and the cart-pendulum it is above the error in the mean, but not
        !! eight times, with a standard deviation of less than a factor 5.
        integer, parameter :: motions = 20
        real(dp), parameter :: h(2) = [0.7_dp, 0.9_dp]
        class(system_t), allocatable :: system
        real(dp) :: log_ratio(motions), mean
        integer :: i, k

        do k = 1, 2
            call new_problem(k, system)
            do i = 1, motions
                call compare(system, start(i, 0.2_dp), h(k), log_ratio(i))
            end do
            mean = sum(log_ratio)/motions
            call assertGreaterThan(mean, 0.0_dp, message="above")
            call assertLessThan(mean, log(8.0_dp), message="not far above")
            call assertLessThan(norm2(log_ratio - mean)/sqrt(real(motions, dp)), log(5.0_dp), &
                                message="deviation")
        end do
    end subroutine estimate_meets_the_error

    subroutine compare(system, y, h, log_ratio)
        !! The estimate over the error, both of one step.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: y(4), h
        real(dp), intent(out) :: log_ratio
        real(dp) :: p(stages, stages), modes(stages, 2), weight(2), a(2), now(4), end(4)
        integer :: i, j

        call legendre(nodes, p)
        modes = 0.0_dp
        do i = 1, stages
            call go(system, y, nodes(i)*h, 10, now)
            call system%accelerations(nodes(i)*h, now(:2), now(3:), a)
            do j = 1, stages
                modes(j, :) = modes(j, :) + (2*j - 1)*weights(i)*p(i, j)*a
            end do
        end do
        call weigh(2, h, 1.0_dp, y(:2), y(3:), weight)
        call go(system, y, h, 10, end)
        call go(system, y, h, 1, now)
        log_ratio = -16.0_dp*log(longer(2, modes, weight)) &
                    - log(maxval(abs(now - end)/max(1.0_dp, abs(y))))
    end subroutine compare

    subroutine go(system, y, duration, steps, y_end)
        !! With `gauss16`.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: y(4), duration
        integer, intent(in) :: steps
        real(dp), intent(out) :: y_end(4)
        type(gauss_t) :: method
        type(error_t), allocatable :: error

        call new_gauss16(method)
        call method%prepare(system, error)
        y_end = y
        call method%start(system, 0.0_dp, y_end(:2), y_end(3:))
        call method%advance(system, 0.0_dp, duration/steps, 0_i8, int(steps, i8), y_end(:2), &
                            y_end(3:))
    end subroutine go

    subroutine forces_that_set_in_are_seen()
        !! While forces depend on nothing but the time, one sweep is all, and the next changes
        !! nothing. At the wall this is no longer so: what was learnt must not be trusted too much.
        !! Beside `dop853`, within ten tolerances; believed to the end, a hundred thousand.
        type(driven_wall_t) :: system
        type(gauss_adaptive_t) :: method
        type(dop853_t) :: other
        type(error_t), allocatable :: error
        real(dp) :: state(2), state_true(2)
        integer :: k

        call system%configure([real(dp) ::], error)
        call new_dop853(other)
        call to_the_wall(other, system, 1e-13_dp, state_true)
        call assertGreaterThan(state_true(1), 1.0_dp, message="at the wall")
        call new_gauss16_adaptive(method)
        method%longest = 0.2_dp
        do k = 7, 10, 3
            call to_the_wall(method, system, 10.0_dp**(-k), state)
            call assertEqual(state_true, state, 10.0_dp**(1 - k), "10 tolerances")
        end do
    end subroutine forces_that_set_in_are_seen

    subroutine a_step_over_a_hole_is_taken_back()
        !! It is between the nodes of the first step, at the fourth of the places of dense output.
        !! Shorter steps miss it, and the motion goes on as if nothing had been; without dense
        !! output nothing is seen.
        type(driven_wall_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error
        real(dp), parameter :: first = 0.2_dp, tolerance = 1e-9_dp
        real(dp) :: whole(2), state(2)
        integer(i8) :: accepted

        call system%configure([real(dp) ::], error)
        call new_gauss16_adaptive(method)
        method%longest = first
        call to_the_wall(method, system, tolerance, whole)
        call assertEqual(0_i8, method%rejected, message="no hole")
        accepted = method%accepted
        system%hole = 0.5_dp*first*(1.0_dp + cos(7.0_dp*acos(-1.0_dp)/32.0_dp))
        call to_the_wall(method, system, tolerance, state)
        call assertEqual(1_i8, method%rejected, message="taken back")
        call assertEqual(accepted + 1, method%accepted, message="two steps for one")
        call assertEqual(whole, state, 10.0_dp*tolerance, "state")
        method%dense = .false.
        call to_the_wall(method, system, tolerance, state)
        call assertEqual(0_i8, method%rejected, message="not seen")
        call assertEqual(whole, state, 0.0_dp, "state")
    end subroutine a_step_over_a_hole_is_taken_back

    subroutine to_the_wall(method, system, tolerance, state)
        !! From 3 m before it, for 4 s.
        class(dense_integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: tolerance
        real(dp), intent(out) :: state(2)
        type(error_t), allocatable :: error

        method%tolerance = tolerance
        call method%prepare(system, error)
        call method%start(system, 0.0_dp, [-2.0_dp], [1.0_dp], 4.0_dp)
        do while (method%t_new < 4.0_dp)
            call method%step(system, error)
            if (allocated(error)) exit
        end do
        call method%state_at(4.0_dp, state(:1), state(2:))
    end subroutine to_the_wall

    subroutine steps_of_a_few_ulp_still_shrink()
        !! \(\ddot x = \dot x^2\) explodes; where it does rounding makes the last steps longer than
        !! they were chosen, and not taking them must end.
        type(exploding_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error
        integer :: k

        system%ndof = 1
        do k = 0, 39
            call new_gauss16_adaptive(method)
            method%tolerance = 10.0_dp**(-4 - mod(k, 8))
            call method%prepare(system, error)
            call method%start(system, 0.0_dp, [0.0_dp], [1.0_dp + 0.003_dp*k], 5.0_dp)
            do while (method%t_new < 5.0_dp)
                call method%step(system, error)
                if (allocated(error)) exit
            end do
            call assertTrue(allocated(error), "it says so")
            call assertEqual(1.0_dp/(1.0_dp + 0.003_dp*k), method%t_new, 1e-2_dp, "where")
        end do
    end subroutine steps_of_a_few_ulp_still_shrink
end module test_gauss_control
