module lagrangia_rotating_wire_reference
    !! The bead on the rotating wire in closed form.
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    use lagrangia_rotating_wire, only: rotating_wire_t
    use lagrangia_sinc, only: sinhc
    implicit none (type, external)
    private
    public :: rotating_wire_reference_t, new_rotating_wire_reference

    type, extends(reference_t) :: rotating_wire_reference_t
        private
        real(dp) :: omega = 0.0_dp  !! rad/s
        real(dp) :: t0 = 0.0_dp, r0 = 0.0_dp, v0 = 0.0_dp
    contains
        procedure :: state_at
    end type rotating_wire_reference_t

contains

    pure subroutine new_rotating_wire_reference(self, system, t0, q0, v0, found)
        !! Covers every initial state; without rotation the motion is uniform.
        type(rotating_wire_reference_t), intent(out) :: self
        type(rotating_wire_t), intent(in) :: system
        real(dp), intent(in) :: t0, q0(:), v0(:)
        logical, intent(out) :: found

        found = .true.
        self%title = "r0 cosh(omega t) + v0/omega sinh(omega t)"
        self%ndof = 1
        self%omega = system%omega
        self%t0 = t0
        self%r0 = q0(1)
        self%v0 = v0(1)
    end subroutine new_rotating_wire_reference

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
end module lagrangia_rotating_wire_reference
