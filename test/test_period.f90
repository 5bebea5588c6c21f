module test_period
    !! The period read off sampled motions whose period is known.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertLessThan
    use lagrangia_dense_run, only: run_dense
    use lagrangia_errors, only: error_t
    use lagrangia_events, only: event_box_t
    use lagrangia_gauss_adaptive, only: gauss_adaptive_t, new_gauss16_adaptive
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_box_t
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_period, only: period_t
    use lagrangia_reference, only: reference_t
    use lagrangia_rk4, only: new_rk4, rk4_t
    use lagrangia_run, only: run
    use lagrangia_system, only: system_t
    use lagrangia_time_grid, only: new_sample_times, new_time_grid, time_grid_t
    implicit none (type, external)
    private
    public :: period_suite

contains

    function period_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("period")
        call suite%addTest(TestMethod("turning_points_are_of_order_five", &
                                      turning_points_are_of_order_five))
        call suite%addTest(TestMethod("the_mean_of_many_periods", the_mean_of_many_periods))
        call suite%addTest(TestMethod("the_coordinate_that_is_asked_for", &
                                      the_coordinate_that_is_asked_for))
        call suite%addTest(TestMethod("one_turn_is_no_period", one_turn_is_no_period))
        call suite%addTest(TestMethod("rows_have_no_part_in_it", rows_have_no_part_in_it))
        call suite%addTest(TestMethod("coarse_samples_give_none", coarse_samples_give_none))
        call suite%addTest(TestMethod("a_whole_period_between_two_samples", &
                                      a_whole_period_between_two_samples))
    end function period_suite

    subroutine sample(system, reference, first, h, count, period)
        !! Show `count` samples of a closed form, `h` apart.
        class(system_t), intent(in) :: system
        class(reference_t), intent(in) :: reference
        real(dp), intent(in) :: first, h
        integer, intent(in) :: count
        type(period_t), intent(inout) :: period
        real(dp) :: q(system%ndof), v(system%ndof)
        integer :: k

        do k = 0, count - 1
            call reference%state_at(first + k*h, q, v)
            call period%follow(system, first + k*h, q, v)
        end do
    end subroutine sample

    subroutine turning_points_are_of_order_five()
        !! A pendulum released from 2 rad turns at half its period. Samples that halve their
        !! distance, with the turning point at the same fraction s between two, divide the error
        !! of its time by 32: the quintic's is s^3 (1 - s)^3 h^6/720, its derivative's of order 5.
        real(dp), parameter :: fraction = 0.3_dp
        type(pendulum_t) :: system
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        type(period_t) :: period
        real(dp) :: h, errors(2)
        integer :: i

        call system%configure([0.7_dp, 1.3_dp, 9.81_dp], error)
        call system%closed_form(0.0_dp, [2.0_dp], [0.0_dp], reference)
        h = reference%period/16
        do i = 1, 2
            period = period_t()
            call sample(system, reference, 0.5_dp*reference%period - (2 + fraction)*h, h, 6, period)
            call assertEqual(1, period%turns, "turns")
            errors(i) = abs(period%first - 0.5_dp*reference%period)
            h = 0.5_dp*h
        end do
        call assertLessThan(errors(1), 1e-3_dp*reference%period, message="16 samples a period")
        call assertEqual(5.0_dp, log(errors(1)/errors(2))/log(2.0_dp), 0.2_dp, "order")
    end subroutine turning_points_are_of_order_five

    subroutine the_mean_of_many_periods()
        !! From 10 turning points; 200 samples a period leave (pi/100)**6/700 of each.
        type(pendulum_t) :: system
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        type(period_t) :: period

        call system%configure([0.7_dp, 1.3_dp, 9.81_dp], error)
        call system%closed_form(0.0_dp, [2.0_dp], [0.0_dp], reference)
        call sample(system, reference, 0.0_dp, reference%period/199.7_dp, 2000, period)
        call assertEqual(10, period%turns, "turns")
        call assertEqual(1.0_dp, period%period()/reference%period, 1e-10_dp, "mean period")
    end subroutine the_mean_of_many_periods

    subroutine the_coordinate_that_is_asked_for()
        !! An oscillator's, with the closed form's own period, 2 pi sqrt(m/k).
        type(oscillator_t) :: system
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        type(period_t) :: period

        call system%configure([2.0_dp, 8.0_dp], error)
        call system%closed_form(0.0_dp, [0.5_dp], [-0.3_dp], reference)
        call sample(system, reference, -1.0_dp, 0.01_dp, 1500, period)
        call assertEqual(acos(-1.0_dp), period%period(), 1e-11_dp, "pi")
    end subroutine the_coordinate_that_is_asked_for

    subroutine one_turn_is_no_period()
        !! Nor is a start at rest at the lowest point a turn.
        type(oscillator_t) :: system
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        type(period_t) :: period

        call system%configure([1.0_dp, 1.0_dp], error)
        call system%closed_form(0.0_dp, [-1.0_dp], [0.0_dp], reference)
        call sample(system, reference, 0.0_dp, 0.1_dp, 10, period)
        call assertEqual(0, period%turns, "turns")
        call sample(system, reference, 1.0_dp, 0.1_dp, 60, period)
        call assertEqual(1, period%turns, "turns")
        call assertEqual(0.0_dp, period%period(), message="no period yet")
        call sample(system, reference, 7.0_dp, 0.1_dp, 60, period)
        call assertEqual(2.0_dp*acos(-1.0_dp), period%period(), 1e-9_dp, "now there is one")
    end subroutine one_turn_is_no_period

    subroutine rows_have_no_part_in_it()
        !! To the last bit, whatever `every` and `samples`: of steps, and of dense output, which
        !! has the period of the closed form to its tolerance.
        integer(i8), parameter :: rows(3) = [1_i8, 7_i8, 1500_i8]
        type(pendulum_t) :: system
        type(rk4_t) :: rk4
        type(gauss_adaptive_t) :: gauss16
        type(time_grid_t) :: plan
        type(period_t), target :: periods(size(rows), 2)
        type(observer_box_t) :: observers(1)
        type(event_box_t) :: events(0)
        type(error_t), allocatable :: error
        class(reference_t), allocatable :: reference
        real(dp) :: q(1), v(1), ended
        integer :: i, k

        call system%configure([0.7_dp, 1.3_dp, 9.81_dp], error)
        call system%closed_form(0.0_dp, [2.0_dp], [0.0_dp], reference)
        call new_rk4(rk4)
        call new_gauss16_adaptive(gauss16)
        do k = 1, 2
            do i = 1, size(rows)
                observers(1)%item => periods(i, k)
                q = 2.0_dp
                v = 0.0_dp
                if (k == 1) then
                    call new_time_grid(plan, 0.0_dp, 0.01_dp, 15.003_dp, rows(i), error)
                    call run(system, rk4, plan, observers, q, v, error)
                else
                    call new_sample_times(plan, 0.0_dp, 15.003_dp, rows(i), error)
                    call run_dense(system, gauss16, plan, events, observers, q, v, ended, error)
                end if
                call assertFalse(allocated(error), "it runs")
                call assertEqual(periods(1, k)%period(), periods(i, k)%period(), message="period")
            end do
        end do
        call assertEqual(1.0_dp, periods(1, 1)%period()/reference%period, 1e-6_dp, "rk4")
        call assertEqual(1.0_dp, periods(1, 2)%period()/reference%period, 1e-9_dp, "gauss16")
    end subroutine rows_have_no_part_in_it

    subroutine coarse_samples_give_none()
        !! 1.7 samples a period see turns, but not the motion's.
        type(oscillator_t) :: system
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        type(period_t) :: period

        call system%configure([1.0_dp, 1.0_dp], error)
        call system%closed_form(0.0_dp, [1.0_dp], [0.0_dp], reference)
        call sample(system, reference, 0.0_dp, 3.7_dp, 100, period)
        call assertEqual(40, period%turns, "there seem to be turns")
        call assertFalse(period%resolved, "too coarse")
        call assertEqual(0.0_dp, period%period(), message="no period")
    end subroutine coarse_samples_give_none

    subroutine a_whole_period_between_two_samples()
        !! From shortly before a lower turning point to shortly behind the next one: the velocity
        !! has changed by less than the accelerations say; from the middle, one way, to that, the
        !! other way, by more.
        real(dp), parameter :: period_of_one = 2.0_dp*acos(-1.0_dp)
        type(oscillator_t) :: system
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        type(period_t) :: less, more

        call system%configure([1.0_dp, 1.0_dp], error)
        call system%closed_form(0.0_dp, [-1.0_dp], [0.0_dp], reference)
        call sample(system, reference, -0.1_dp, period_of_one + 0.2_dp, 2, less)
        call assertEqual(1, less%turns, "there seems to be a turn")
        call assertFalse(less%resolved, "too coarse")
        call sample(system, reference, -0.25_dp*period_of_one, 0.5_dp*period_of_one, 2, more)
        call assertEqual(1, more%turns, "there is a turn")
        call assertFalse(more%resolved, "too coarse as well")
    end subroutine a_whole_period_between_two_samples
end module test_period
