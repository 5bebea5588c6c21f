module lagrangia_driven_pendulum_reference
    !! The driven pendulum, hanging or standing at rest: the drive does not turn it.
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_kinds, only: dp
    use lagrangia_standing, only: half_turns, near, standing_t, start_standing
    implicit none (type, external)
    private
    public :: driven_pendulum_reference_t, new_driven_pendulum_reference

    type, extends(standing_t) :: driven_pendulum_reference_t
    end type driven_pendulum_reference_t

contains

    pure subroutine new_driven_pendulum_reference(self, system, t0, q0, v0, found)
        !! Covers rest at the bottom and at the top, whatever the drive.
        type(driven_pendulum_reference_t), intent(out) :: self
        type(driven_pendulum_t), intent(in) :: system
        real(dp), intent(in) :: t0, q0(:), v0(:)
        logical, intent(out) :: found

        found = system%cyclic == 1 .or. near(q0(1), half_turns(q0(1)))
        found = found .and. abs(v0(1)) <= 0.0_dp
        call start_standing(self, "at rest at the bottom or at the top", q0)
    end subroutine new_driven_pendulum_reference
end module lagrangia_driven_pendulum_reference
