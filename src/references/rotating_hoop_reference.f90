module lagrangia_rotating_hoop_reference
    !! The bead on the rotating hoop, at rest in an equilibrium.
    use lagrangia_kinds, only: dp
    use lagrangia_rotating_hoop, only: rotating_hoop_t
    use lagrangia_standing, only: half_turns, near, standing_t, start_standing
    implicit none (type, external)
    private
    public :: rotating_hoop_reference_t, new_rotating_hoop_reference

    type, extends(standing_t) :: rotating_hoop_reference_t
    end type rotating_hoop_reference_t

contains

    pure subroutine new_rotating_hoop_reference(self, system, t0, q0, v0, found)
        !! Covers rest at the bottom, at the top and, where \(\omega^2R > g\), tilted at
        !! \(\cos\theta_* = g/(\omega^2R)\).
        type(rotating_hoop_reference_t), intent(out) :: self
        type(rotating_hoop_t), intent(in) :: system
        real(dp), intent(in) :: t0, q0(:), v0(:)
        logical, intent(out) :: found
        real(dp) :: bottom

        found = system%cyclic == 1 .or. near(q0(1), half_turns(q0(1)))
        if (.not. found .and. system%omega**2*system%r > system%g) then
            bottom = 2.0_dp*half_turns(0.5_dp*q0(1))
            found = near(abs(q0(1) - bottom), tilt(system))
        end if
        found = found .and. abs(v0(1)) <= 0.0_dp
        call start_standing(self, "at rest in an equilibrium: bottom, top or cos(theta) = "// &
                            "g/(omega^2 r)", q0)
    end subroutine new_rotating_hoop_reference

    pure function tilt(system) result(theta)
        !! \(\theta_*\), from \(\sin^2(\theta_*/2) = (\omega^2R - g)/(2\omega^2R)\): the arc
        !! cosine would lose half its digits where \(\omega^2R\) is little more than \(g\).
        type(rotating_hoop_t), intent(in) :: system
        real(dp) :: theta

        associate (lift => system%omega**2*system%r)
            theta = 2.0_dp*asin(sqrt(0.5_dp*(lift - system%g)/lift))
        end associate
    end function tilt
end module lagrangia_rotating_hoop_reference
