module lagrangia_standing
    !! The closed form of a system that stands in an equilibrium.
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    implicit none (type, external)
    private
    public :: standing_t, start_standing, near, half_turns

    real(dp), parameter :: pi = acos(-1.0_dp)

    type, extends(reference_t) :: standing_t
        private
        real(dp), allocatable :: q0(:)
    contains
        procedure :: state_at
    end type standing_t

contains

    pure subroutine start_standing(self, title, q0)
        !! Stand at `q0`.
        type(standing_t), intent(out) :: self  !! as the system stands
        character(*), intent(in) :: title      !! of the closed form
        real(dp), intent(in) :: q0(:)          !! (ndof)

        self%title = title
        self%ndof = size(q0)
        self%q0 = q0
    end subroutine start_standing

    pure function near(angle, equilibrium)
        !! Equal to rounding. At an unstable equilibrium what is rounded away grows: the
        !! motion leaves it after some \(36/\lambda\), \(\lambda\) the growth rate.
        real(dp), intent(in) :: angle, equilibrium  !! rad
        logical :: near

        near = abs(angle - equilibrium) <= 4.0_dp*epsilon(1.0_dp)*max(1.0_dp, abs(angle))
    end function near

    pure function half_turns(angle) result(nearest)
        !! The multiple of \(\pi\) that is nearest to `angle`: bottom or top.
        real(dp), intent(in) :: angle  !! rad
        real(dp) :: nearest

        nearest = pi*anint(angle/pi)
    end function half_turns

    pure subroutine state_at(self, t, q, v)
        !! At rest, always.
        class(standing_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(self%ndof), v(self%ndof)

        q = self%q0
        v = 0.0_dp
    end subroutine state_at
end module lagrangia_standing
