submodule (lagrangia_rotating_hoop) lagrangia_rotating_hoop_reference
    !! The bead on the rotating hoop, at rest in an equilibrium.
    use lagrangia_kinds, only: dp
    use lagrangia_standing, only: half_turns, near, standing_t, start_standing
    implicit none (type, external)

contains

    module subroutine closed_form(self, t0, q0, v0, reference)
        !! Covers rest at the bottom, at the top and, where \(\omega^2R > g\), tilted at
        !! \(\cos\theta_* = g/(\omega^2R)\).
        class(rotating_hoop_t), intent(in) :: self
        real(dp), intent(in) :: t0, q0(:), v0(:)
        class(reference_t), allocatable, intent(out) :: reference
        type(standing_t) :: motion
        logical :: found
        real(dp) :: bottom

        found = self%cyclic == 1 .or. near(q0(1), half_turns(q0(1)))
        if (.not. found .and. self%omega**2*self%r > self%g) then
            bottom = 2.0_dp*half_turns(0.5_dp*q0(1))
            found = near(abs(q0(1) - bottom), tilt(self))
        end if
        found = found .and. abs(v0(1)) <= 0.0_dp
        call start_standing(motion, "at rest in an equilibrium: bottom, top or cos(theta) = "// &
                            "g/(omega^2 r)", q0)
        if (found) allocate (reference, source=motion)
    end subroutine closed_form

    pure function tilt(system) result(theta)
        !! \(\theta_*\), from \(\sin^2(\theta_*/2) = (\omega^2R - g)/(2\omega^2R)\): the arc
        !! cosine would lose half its digits where \(\omega^2R\) is little more than \(g\).
        class(rotating_hoop_t), intent(in) :: system
        real(dp) :: theta

        associate (lift => system%omega**2*system%r)
            theta = 2.0_dp*asin(sqrt(0.5_dp*(lift - system%g)/lift))
        end associate
    end function tilt
end submodule lagrangia_rotating_hoop_reference
