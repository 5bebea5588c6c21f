submodule (lagrangia_charged_particle) lagrangia_charged_particle_reference
    !! A charge in uniform fields, free or in an isotropic trap, in closed form.
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    use lagrangia_sinc, only: sinc
    implicit none (type, external)

    real(dp), parameter :: pi = acos(-1.0_dp)

    type, extends(reference_t) :: charged_particle_reference_t
        real(dp) :: axis(3) = 0.0_dp              !! along e B
        real(dp) :: alpha = 0.0_dp                !! half the cyclotron frequency, rad/s
        real(dp) :: omega0 = 0.0_dp               !! of the trap, rad/s
        real(dp) :: t0 = 0.0_dp, r0(3) = 0.0_dp
        real(dp) :: along(3) = 0.0_dp, across(3) = 0.0_dp    !! start velocity, to the axis
        real(dp) :: push_along(3) = 0.0_dp, push_across(3) = 0.0_dp
        !! acceleration by E and by the trap at the start
    contains
        procedure :: state_at
    end type charged_particle_reference_t

contains

    module subroutine closed_form(self, t0, q0, v0, reference)
        !! Covers every initial state and all fields, with a trap and without.
        class(charged_particle_t), intent(in) :: self
        real(dp), intent(in) :: t0, q0(:), v0(:)
        class(reference_t), allocatable, intent(out) :: reference
        type(charged_particle_reference_t) :: motion
        real(dp) :: push(3)

        motion%title = "drift, cyclotron turn and trap: rotation by omega_c/2 about B times "// &
                     "oscillation (Larmor)"
        motion%ndof = 3
        motion%axis = sign(1.0_dp, self%charge)*self%axis()
        motion%alpha = 0.5_dp*abs(self%charge)*length(self%magnetic)/self%m
        motion%omega0 = sqrt(self%trap/self%m)
        motion%t0 = t0
        motion%r0 = q0
        push = (self%charge*self%electric - self%trap*q0)/self%m
        motion%push_along = dot_product(motion%axis, push)*motion%axis
        motion%push_across = push - motion%push_along
        motion%along = dot_product(motion%axis, v0)*motion%axis
        motion%across = v0 - motion%along
        if (motion%omega0 > 0.0_dp) then
            if (motion%alpha <= 0.0_dp) motion%period = 2.0_dp*pi/motion%omega0
        else if (motion%alpha > 0.0_dp .and. length(motion%along) + length(push) <= 0.0_dp) then
            motion%period = pi/motion%alpha
        end if
        allocate (reference, source=motion)
    end subroutine closed_form

    pure subroutine state_at(self, t, q, v)
        !! About the start, \(r = r_0 + h(\tau)\,v_0 + H(\tau)\,a_0\), where \(a_0\) is the
        !! acceleration by E and the trap at \(r_0\), \(h\) is the response to a kick and
        !! \(H = \int_0^\tau h\) to a constant push. Across B, with \(i\) for a quarter turn,
        !! $$ h = e^{-i\alpha\tau}\,\tau\,\mathrm{sinc}\,\Omega\tau,\qquad
        !!    \Omega^2 = \omega_0^2 + \alpha^2,\ \alpha = \omega_c/2; $$
        !! along B the same with \(\alpha = 0\). Nothing is divided by \(\omega_c\) or
        !! \(\omega_0\).
        class(charged_particle_reference_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(self%ndof), v(self%ndof)
        complex(dp) :: kick, kick_rate, push
        real(dp) :: tau

        tau = t - self%t0
        call responses(self%omega0, 0.0_dp, tau, kick, kick_rate, push)
        q = self%r0 + kick%re*self%along + push%re*self%push_along
        v = kick_rate%re*self%along + kick%re*self%push_along
        call responses(self%omega0, self%alpha, tau, kick, kick_rate, push)
        q = q + turned(self%axis, kick, self%across) + turned(self%axis, push, self%push_across)
        v = v + turned(self%axis, kick_rate, self%across) &
            + turned(self%axis, kick, self%push_across)
    end subroutine state_at

    pure function turned(axis, factor, u) result(w)
        !! `factor` times a vector across `axis`: the imaginary unit is a quarter turn about it.
        real(dp), intent(in) :: axis(3), u(3)
        complex(dp), intent(in) :: factor
        real(dp) :: w(3)

        w = factor%re*u + factor%im*cross(axis, u)
    end function turned

    pure subroutine responses(omega0, alpha, t, kick, kick_rate, push)
        !! Solutions of \(\ddot\zeta + 2i\alpha\dot\zeta + \omega_0^2\zeta = f\) from rest: for
        !! a unit kick at 0, its derivative, and for the unit push \(f = 1\).
        !!
        !! The push's is \([F(\omega_-) - F(-\omega_+)]/(2i\Omega)\) with
        !! \(\omega_\pm = \Omega \pm \alpha\), \(F(\omega) = \int_0^t e^{i\omega s}ds\); where
        !! \(\omega_+|t| < 1\) that cancels, and the power series of the equation is summed.
        real(dp), intent(in) :: omega0, alpha, t
        complex(dp), intent(out) :: kick, kick_rate, push
        complex(dp), parameter :: i = (0.0_dp, 1.0_dp)
        complex(dp) :: turn, term, next, before
        real(dp) :: omega, fast, slow
        integer :: n

        omega = hypot(omega0, alpha)
        turn = exp(-i*alpha*t)
        kick = turn*t*sinc(omega*t)
        kick_rate = turn*(cos(omega*t) - i*alpha*t*sinc(omega*t))
        fast = omega + alpha
        if (fast*abs(t) < 1.0_dp) then
            before = 0.0_dp
            term = 0.5_dp*t**2
            push = 0.0_dp
            do n = 1, 24
                push = push + term
                next = -(2.0_dp*i*alpha*t*(n + 1)*term + (omega0*t)**2*before)/((n + 2)*(n + 1))
                before = term
                term = next
            end do
        else
            slow = omega0*(omega0/fast)
            push = (integral(slow, t) - integral(-fast, t))/(2.0_dp*i*omega)
        end if
    end subroutine responses

    pure function integral(omega, t) result(f)
        !! \(\int_0^t e^{i\omega s}ds\).
        real(dp), intent(in) :: omega, t
        complex(dp) :: f

        f = t*sinc(0.5_dp*omega*t)*exp(cmplx(0.0_dp, 0.5_dp*omega*t, dp))
    end function integral
end submodule lagrangia_charged_particle_reference
