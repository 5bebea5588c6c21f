module restless_oscillator
    !! An oscillator of which one half of Hamilton's equations has no solution that iteration finds.
    use lagrangia_kinds, only: dp
    use lagrangia_oscillator, only: oscillator_t
    implicit none (type, external)
    private
    public :: restless_oscillator_t

    type, extends(oscillator_t) :: restless_oscillator_t
        logical :: in_p = .false.  !! `forces` turn with the velocity; else velocities with place
    contains
        procedure :: forces
        procedure :: velocities
    end type restless_oscillator_t

contains

    pure subroutine forces(self, t, q, v, f)
        !! \(-2v\): half a step of 1 s changes the sign of \(p = mv\), m = 1 kg.
        class(restless_oscillator_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: f(self%ndof)

        if (self%in_p) then
            f = -2.0_dp*v
        else
            call self%oscillator_t%forces(t, q, v, f)
        end if
    end subroutine forces

    pure subroutine velocities(self, t, q, p, v)
        !! \(-2q\): half a step of 1 s changes the sign of q.
        class(restless_oscillator_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), p(self%ndof)
        real(dp), intent(out) :: v(self%ndof)

        if (self%in_p) then
            call self%oscillator_t%velocities(t, q, p, v)
        else
            v = -2.0_dp*q
        end if
    end subroutine velocities
end module restless_oscillator
