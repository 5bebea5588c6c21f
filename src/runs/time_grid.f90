module lagrangia_time_grid
    !! The times of a run: steps of equal length with samples among them, or samples alone.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_errors, only: error_t, fail
    use lagrangia_kinds, only: dp, i8
    use lagrangia_stepwise, only: whole_steps
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: time_grid_t
    public :: new_given_times, new_sample_times, new_time_grid

    type :: time_grid_t
        !! Whole steps, and perhaps a shorter one that lands on the end; or, where a method chooses
        !! its steps, only samples.
        real(dp) :: t0 = 0.0_dp       !! s
        real(dp) :: dt = 0.0_dp       !! s; 0: there are only samples
        real(dp) :: duration = 0.0_dp !! s
        integer(i8) :: steps = 0      !! whole ones
        real(dp) :: rest = 0.0_dp     !! length of the last, shortened step, s; 0: there is none
        integer(i8) :: every = 1      !! steps between samples
        integer(i8) :: samples = 0    !! so many at equal times; 0: as the steps have it
        real(dp), allocatable, private :: at(:)  !! or at these times, s, (samples + 1)
    contains
        procedure :: last_sample
        procedure :: sample_time
        procedure :: step_count
    end type time_grid_t

contains

    pure subroutine new_time_grid(grid, t0, dt, duration, every, error)
        !! Count the steps; fails where they cannot be counted or do not move the time, and on a
        !! number that makes no sense.
        type(time_grid_t), intent(out) :: grid            !! of steps
        real(dp), intent(in) :: t0                        !! finite, s
        real(dp), intent(in) :: dt                        !! length of a step, finite, above 0, s
        real(dp), intent(in) :: duration                  !! finite, not negative, s
        integer(i8), intent(in) :: every                  !! steps between samples, at least 1
        type(error_t), allocatable, intent(out) :: error  !! blames `t0`, `dt`, ...
        real(dp) :: count

        call check_times(t0, duration, error)
        if (allocated(error)) return
        if (.not. (ieee_is_finite(dt) .and. dt > 0.0_dp)) then
            call fail(error, "must be positive and finite, not "//to_text(dt), key="dt")
        else if (every < 1) then
            call fail(error, "must be at least 1, not "//to_text(every), key="every")
        end if
        if (allocated(error)) return
        count = duration/dt
        if (count > 1e15_dp) then
            call fail(error, "duration/dt = "//to_text(count)//" steps are too many to count", &
                      key="dt")
            return
        end if
        if (abs(t0) + duration + dt <= abs(t0) + duration) then
            call fail(error, "is too small to move the time near t = "//to_text(t0 + duration), &
                      key="dt")
            return
        end if
        grid%t0 = t0
        grid%dt = dt
        grid%duration = duration
        grid%every = every
        call whole_steps(duration, dt, grid%steps, grid%rest)
    end subroutine new_time_grid

    pure subroutine new_sample_times(grid, t0, duration, samples, error)
        !! So many samples after that of the start; fails where they cannot be told apart.
        type(time_grid_t), intent(out) :: grid            !! of samples
        real(dp), intent(in) :: t0                        !! finite, s
        real(dp), intent(in) :: duration                  !! finite, not negative, s
        integer(i8), intent(in) :: samples                !! at least 1
        type(error_t), allocatable, intent(out) :: error  !! blames `t0`, `duration`, `samples`

        call check_times(t0, duration, error)
        if (allocated(error)) return
        if (samples < 1) then
            call fail(error, "must be at least 1, not "//to_text(samples), key="samples")
            return
        end if
        if (duration/samples < 4.0_dp*spacing(abs(t0) + duration)) then
            call fail(error, "so many samples cannot be told apart near t = "// &
                      to_text(t0 + duration)//" s", key="samples")
            return
        end if
        grid%t0 = t0
        grid%duration = duration
        grid%samples = samples
    end subroutine new_sample_times

    pure subroutine new_given_times(grid, times, error)
        !! Samples at given times, the first of which is the start.
        type(time_grid_t), intent(out) :: grid            !! of samples
        real(dp), intent(in) :: times(:)                  !! two at least, rising, s
        type(error_t), allocatable, intent(out) :: error  !! blames `t`, `t0`, `duration`, `samples`
        integer :: n

        n = size(times)
        if (n < 2) then
            call fail(error, "t needs two times at least", key="t")
        else if (.not. all(times(2:) > times(:n - 1))) then
            call fail(error, "each time must be later than the one before", key="t")
        else
            call new_sample_times(grid, times(1), times(n) - times(1), int(n - 1, i8), error)
        end if
        if (.not. allocated(error)) grid%at = times
    end subroutine new_given_times

    pure subroutine check_times(t0, duration, error)
        !! Both finite, as is the end; time does not run backwards.
        real(dp), intent(in) :: t0, duration
        type(error_t), allocatable, intent(out) :: error

        if (.not. ieee_is_finite(t0)) then
            call fail(error, "must be finite, not "//to_text(t0), key="t0")
        else if (.not. (ieee_is_finite(duration) .and. duration >= 0.0_dp)) then
            call fail(error, "must be finite and not negative, not "//to_text(duration), &
                      key="duration")
        end if
    end subroutine check_times

    pure function last_sample(self) result(count)
        !! Number of the last sample; that of the start is 0.
        class(time_grid_t), intent(in) :: self
        integer(i8) :: count

        count = self%samples
        if (count > 0) return
        count = self%steps/self%every
        if (mod(self%steps, self%every) /= 0 .or. self%rest > 0.0_dp) count = count + 1
    end function last_sample

    pure function sample_time(self, k) result(t)
        !! Time of sample `k`, s; the last is exactly the end.
        class(time_grid_t), intent(in) :: self
        integer(i8), intent(in) :: k  !! from 0 to `last_sample()`
        real(dp) :: t

        if (k == self%last_sample()) then
            t = self%t0 + self%duration
        else if (allocated(self%at)) then
            t = self%at(k + 1)
        else if (self%samples > 0) then
            t = self%t0 + self%duration*(real(k, dp)/real(self%samples, dp))
        else
            t = self%t0 + k*self%every*self%dt
        end if
    end function sample_time

    pure function step_count(self) result(steps)
        !! Of all steps, the shortened one too; 0 where there are only samples.
        class(time_grid_t), intent(in) :: self
        integer(i8) :: steps

        steps = self%steps + merge(1, 0, self%rest > 0.0_dp)
    end function step_count
end module lagrangia_time_grid
