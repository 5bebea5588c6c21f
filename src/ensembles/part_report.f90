module lagrangia_part_report
    !! How far one trajectory of a block is, told to who began the sweep.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_system, only: system_t
    use lagrangia_workers, only: report_part
    implicit none (type, external)
    private
    public :: part_report_t

    integer, parameter :: seldom = 256  !! ticks, of which one looks at the clock

    type, extends(observer_t) :: part_report_t
        real(dp) :: from = 0.0_dp, to = 0.0_dp  !! the trajectory's share of the block
        integer, private :: ticks = 0
    contains
        procedure :: observe
        procedure :: tick
    end type part_report_t

contains

    subroutine observe(self, system, t, q, v, error)
        !! The states don't matter.
        class(part_report_t), intent(inout) :: self
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! s; coordinates and velocities
        type(error_t), allocatable, intent(out) :: error  !! never allocated
    end subroutine observe

    subroutine tick(self, done, steps)
        !! See `observer_t`. Where it has no share nothing is told.
        class(part_report_t), intent(inout) :: self
        integer(i8), intent(in) :: done, steps  !! of the trajectory

        self%ticks = mod(self%ticks + 1, seldom)
        if (self%ticks > 0 .or. .not. self%to > self%from) return
        call report_part(self%from + (self%to - self%from)*(real(done, dp)/real(steps, dp)))
    end subroutine tick
end module lagrangia_part_report
