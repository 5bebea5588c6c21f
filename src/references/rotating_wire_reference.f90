submodule (lagrangia_rotating_wire) lagrangia_rotating_wire_reference
    !! The bead on the rotating wire in closed form.
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    use lagrangia_sinc, only: sinhc
    implicit none (type, external)

    type, extends(reference_t) :: rotating_wire_reference_t
        real(dp) :: omega = 0.0_dp  !! rad/s
        real(dp) :: t0 = 0.0_dp, r0 = 0.0_dp, v0 = 0.0_dp
    contains
        procedure :: state_at
    end type rotating_wire_reference_t

contains

    module subroutine closed_form(self, t0, q0, v0, reference)
        !! Covers every initial state; without rotation the motion is uniform.
        class(rotating_wire_t), intent(in) :: self
        real(dp), intent(in) :: t0, q0(:), v0(:)
        class(reference_t), allocatable, intent(out) :: reference
        type(rotating_wire_reference_t) :: motion

        motion%title = "r0 cosh(omega t) + v0/omega sinh(omega t)"
        motion%ndof = 1
        motion%omega = self%omega
        motion%t0 = t0
        motion%r0 = q0(1)
        motion%v0 = v0(1)
        allocate (reference, source=motion)
    end subroutine closed_form

    pure subroutine state_at(self, t, q, v)
        !! $$ r = r_0\cosh\omega t + \frac{v_0}\omega\sinh\omega t
        !!      = r_0e^{-\omega t} + (v_0 + \omega r_0)\frac{\sinh\omega t}\omega $$
        !! The second form does not cancel for a bead that creeps towards the axis,
        !! \(v_0 = -\omega r_0\). It is even in \(\omega\), whose sign is taken so that
        !! \(\omega t\ge 0\).
        class(rotating_wire_reference_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(self%ndof), v(self%ndof)
        real(dp) :: tau, w

        tau = t - self%t0
        w = sign(self%omega, tau)
        q(1) = self%r0*exp(-w*tau) + (self%v0 + w*self%r0)*tau*sinhc(w*tau)
        v(1) = -w*self%r0*exp(-w*tau) + (self%v0 + w*self%r0)*cosh(w*tau)
    end subroutine state_at
end submodule lagrangia_rotating_wire_reference
