module lagrangia_part
    !! A part of longer work: how far it is counts as that share of the whole.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: part_t

    type, extends(observer_t) :: part_t
        class(observer_t), pointer :: whole => null()  !! is told; may be null
        real(dp) :: from = 0.0_dp, to = 1.0_dp         !! of the whole
    contains
        procedure :: observe
        procedure :: tick
    end type part_t

contains

    subroutine observe(self, system, t, q, v, error)
        !! The states don't matter.
        class(part_t), intent(inout) :: self
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! s; coordinates and velocities
        type(error_t), allocatable, intent(out) :: error  !! never allocated
    end subroutine observe

    subroutine tick(self, done, steps)
        !! As many of the whole: what was before this part, and its share.
        class(part_t), intent(inout) :: self
        integer(i8), intent(in) :: done, steps  !! of this part
        real(dp) :: share

        if (.not. associated(self%whole)) return
        share = real(done, dp)/real(max(steps, 1_i8), dp)
        call self%whole%tick_share(self%from + share*(self%to - self%from))
    end subroutine tick
end module lagrangia_part
