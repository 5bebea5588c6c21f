module test_time_grid
    !! The grid of times of a run: whole steps counted in 64 bits, and a shortened last one.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_kinds, only: dp, i8
    use lagrangia_time_grid, only: new_given_times, new_sample_times, new_time_grid, time_grid_t
    implicit none (type, external)
    private
    public :: time_grid_suite

contains

    function time_grid_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("time_grid")
        call suite%addTest(TestMethod("steps_that_divide_are_counted", &
                                      steps_that_divide_are_counted))
        call suite%addTest(TestMethod("the_last_step_is_shortened", the_last_step_is_shortened))
        call suite%addTest(TestMethod("steps_beyond_counting_are_refused", &
                                      steps_beyond_counting_are_refused))
        call suite%addTest(TestMethod("steps_that_stand_still_are_refused", &
                                      steps_that_stand_still_are_refused))
        call suite%addTest(TestMethod("samples_lie_four_doubles_apart", &
                                      samples_lie_four_doubles_apart))
        call suite%addTest(TestMethod("given_times_rise", given_times_rise))
    end function time_grid_suite

    subroutine steps_that_divide_are_counted()
        !! Also where the quotient is not a whole number by rounding only, and beyond 2**31.
        call check_plan(0.0_dp, 0.01_dp, 20.0_dp, 2000_i8)
        call check_plan(-5.0_dp, 0.1_dp, 0.3_dp, 3_i8)
        call check_plan(0.0_dp, 1.0_dp/3.0_dp, 1.0_dp, 3_i8)
        call check_plan(0.0_dp, 1e-3_dp, 1e3_dp/7.0_dp*7.0_dp, 1000000_i8)
        call check_plan(0.0_dp, 0.5_dp**20, (2.0_dp**31 + 1.0_dp)*0.5_dp**20, 2147483649_i8)
        call check_plan(0.0_dp, 1e-9_dp, 1e3_dp, 1000000000000_i8)
    end subroutine steps_that_divide_are_counted

    subroutine check_plan(t0, dt, duration, steps)
        !! A plan of so many whole steps.
        real(dp), intent(in) :: t0, dt, duration
        integer(i8), intent(in) :: steps
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error

        call new_time_grid(plan, t0, dt, duration, 1_i8, error)
        call assertFalse(allocated(error), "a plan")
        call assertEqual(steps, plan%steps)
        call assertEqual(0.0_dp, plan%rest, message="no rest")
        call assertEqual([t0, dt, duration], [plan%t0, plan%dt, plan%duration])
    end subroutine check_plan

    subroutine the_last_step_is_shortened()
        !! Never stretched, however near the next whole step is.
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error
        real(dp), parameter :: durations(4) = [1.0_dp, 0.95_dp, 0.9_dp + 1e-9_dp, 1.2_dp - 1e-9_dp]
        integer :: i

        do i = 1, size(durations)
            call new_time_grid(plan, 0.0_dp, 0.3_dp, durations(i), 1_i8, error)
            call assertFalse(allocated(error), "a plan")
            call assertEqual(3_i8, plan%steps)
            call assertEqual(durations(i) - 0.9_dp, plan%rest, 4*epsilon(1.0_dp), "the rest")
        end do
    end subroutine the_last_step_is_shortened

    subroutine steps_beyond_counting_are_refused()
        !! 1e15 steps can be counted, and no more.
        call check_plan(0.0_dp, 1.0_dp, 1e15_dp, 1000000000000000_i8)
        call check_no_plan(0.0_dp, 1.0_dp, 1.001e15_dp, "duration/dt = 1001000000000000.0 "// &
                           "steps are too many to count")
        call check_no_plan(0.0_dp, 1e-300_dp, 1e300_dp, "duration/dt = inf steps are too many")
    end subroutine steps_beyond_counting_are_refused

    subroutine steps_that_stand_still_are_refused()
        !! Next to a large time a small step is none; before the beginning of time too.
        call check_no_plan(1e9_dp, 1e-8_dp, 1e-3_dp, &
                           "is too small to move the time near t = 1000")
        call check_no_plan(-1e9_dp, 1e-8_dp, 1e-3_dp, &
                           "is too small to move the time near t = -9999")
        call check_plan(1e9_dp, 0.25_dp, 1.0_dp, 4_i8)
    end subroutine steps_that_stand_still_are_refused

    subroutine samples_lie_four_doubles_apart()
        !! \(2^{50}\) of them in the first second do, one more do not; none is refused.
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error

        call new_sample_times(plan, 0.0_dp, 1.0_dp, 2_i8**50, error)
        call assertFalse(allocated(error), "four apart")
        call assertEqual(2_i8**50, plan%samples)
        call new_sample_times(plan, 0.0_dp, 1.0_dp, 2_i8**50 + 1_i8, error)
        call assertTrue(allocated(error), "less than four apart")
        if (.not. allocated(error)) return
        call assertEqual("so many samples cannot be told apart near t = 1.0 s", error%message)
        call new_sample_times(plan, 0.0_dp, 1.0_dp, 0_i8, error)
        call assertTrue(allocated(error), "no samples")
        if (.not. allocated(error)) return
        call assertEqual("must be at least 1, not 0", error%message)
    end subroutine samples_lie_four_doubles_apart

    subroutine given_times_rise()
        !! Each later than the one before, not the last only; the last sample is the last time.
        type(time_grid_t) :: grid
        type(error_t), allocatable :: error

        call new_given_times(grid, [0.0_dp, 2.0_dp, 1.0_dp, 3.0_dp], error)
        call assertTrue(allocated(error), "one step back")
        if (allocated(error)) call assertEqual("each time must be later than the one before", &
                                               error%message)
        call new_given_times(grid, [0.0_dp, 0.0_dp, 1.0_dp], error)
        call assertTrue(allocated(error), "twice the same")
        call new_given_times(grid, [0.0_dp, 1.0_dp, 3.0_dp], error)
        call assertFalse(allocated(error), "rising")
        call assertEqual(3.0_dp, grid%sample_time(2_i8), message="the last")
    end subroutine given_times_rise

    subroutine check_no_plan(t0, dt, duration, message)
        !! Refused in words that begin so, and `dt` is to blame.
        real(dp), intent(in) :: t0, dt, duration
        character(*), intent(in) :: message
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error

        call new_time_grid(plan, t0, dt, duration, 1_i8, error)
        call assertTrue(allocated(error), "refused: "//message)
        if (.not. allocated(error)) return
        call assertEqual(1, index(error%message, message), error%message)
        call assertEqual("dt", error%key)
        call assertEqual(status_usage, error%status)
    end subroutine check_no_plan
end module test_time_grid
