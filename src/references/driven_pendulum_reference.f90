submodule (lagrangia_driven_pendulum) lagrangia_driven_pendulum_reference
    !! The driven pendulum, hanging or standing at rest: the drive does not turn it.
    use lagrangia_kinds, only: dp
    use lagrangia_standing, only: half_turns, near, standing_t, start_standing
    implicit none (type, external)

contains

    module subroutine closed_form(self, t0, q0, v0, reference)
        !! Covers rest at the bottom and at the top, whatever the drive.
        class(driven_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t0, q0(:), v0(:)
        class(reference_t), allocatable, intent(out) :: reference
        type(standing_t) :: motion
        logical :: found

        found = .not. (self%driven() .or. self%g > 0.0_dp) .or. near(q0(1), half_turns(q0(1)))
        found = found .and. abs(v0(1)) <= 0.0_dp
        call start_standing(motion, "at rest at the bottom or at the top", q0)
        if (found) allocate (reference, source=motion)
    end subroutine closed_form
end submodule lagrangia_driven_pendulum_reference
