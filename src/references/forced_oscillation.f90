module lagrangia_forced_oscillation
    !! The closed form of \(m\ddot x + b\dot x + kx = F_0\cos Wt\) from any start, with any damping
    !! and at any frequency of the drive.
    !!
    !! With \(\gamma = b/2m\), \(\omega_0^2 = k/m\) and the eigenvalues
    !! \(\lambda_\pm = -\gamma\pm\sqrt{\gamma^2 - \omega_0^2}\) the free motion is that of
    !! \(s(u) = (e^{\lambda_+u} - e^{\lambda_-u})/(\lambda_+ - \lambda_-)\), which a push makes. The
    !! drive adds \(\tfrac{F_0}m\int_0^u s(u - u')\cos W(t_0 + u')\,du' = \tfrac{F_0}m\,
    !! \mathrm{Re}\,e^{iWt_0}u^2\,e^{[\lambda_+u,\,\lambda_-u,\,iWu]}\), a divided difference:
    !! transient and steady state in one, so that nothing cancels at resonance, nor near critical
    !! damping. There the distance \(4mk - b^2\) is taken in quadruple precision.
    use lagrangia_exponential_differences, only: first_difference, second_difference
    use lagrangia_kinds, only: dp, qp
    use lagrangia_reference, only: reference_t
    use lagrangia_sinc, only: sinc
    implicit none (type, external)
    private
    public :: forced_oscillation_t, start_forced

    real(dp), parameter :: pi = acos(-1.0_dp)
    complex(dp), parameter :: i = (0.0_dp, 1.0_dp)

    type, extends(reference_t) :: forced_oscillation_t
        private
        real(dp) :: gamma = 0.0_dp   !! \(b/2m\), 1/s
        real(dp) :: square = 0.0_dp  !! \(\omega_0^2 = k/m\), s^-2
        real(dp) :: excess = 0.0_dp  !! \(\omega_0^2 - \gamma^2\), s^-2: positive if it oscillates
        real(dp) :: force = 0.0_dp   !! \(F_0/m\), m s^-2
        real(dp) :: w = 0.0_dp       !! rad/s, of the drive
        real(dp) :: t0 = 0.0_dp, x0 = 0.0_dp, v0 = 0.0_dp
    contains
        procedure :: state_at
    end type forced_oscillation_t

contains

    pure subroutine start_forced(self, m, k, b, force, w, t0, x0, v0)
        !! Begin at a state.
        type(forced_oscillation_t), intent(out) :: self  !! the motion
        real(dp), intent(in) :: m, k, b      !! kg; N/m; N s/m
        real(dp), intent(in) :: force, w     !! \(F_0\), N; \(W\), rad/s
        real(dp), intent(in) :: t0, x0, v0   !! s; m; m/s

        self%ndof = 1
        self%gamma = 0.5_dp*b/m
        self%square = k/m
        self%excess = real((4.0_qp*real(m, qp)*k - real(b, qp)**2)/(2.0_qp*m)**2, dp)
        self%force = force/m
        self%w = w
        self%t0 = t0
        self%x0 = x0
        self%v0 = v0
        if (abs(force) > 0.0_dp) then
            self%title = "transient and steady state of m x_ddot + b x_dot + k x = F0 cos(W t)"
        else if (self%excess > 0.0_dp) then
            self%title = "exp(-gamma t) (x0 cos(omega t) + (v0 + gamma x0)/omega sin(omega t))"// &
                         ", gamma = b/(2 m), omega^2 = k/m - gamma^2"
            self%period = 2.0_dp*pi/sqrt(self%excess)
            self%small_period = self%period
        else
            self%title = "x0 exp(-gamma_1 t) + (v0 + gamma_1 x0)/omega exp(-gamma t) "// &
                         "sinh(omega t), gamma = b/(2 m), omega^2 = gamma^2 - k/m, "// &
                         "gamma_1 = k/(m (gamma + omega))"
            if (self%excess >= 0.0_dp) self%title = &
                "exp(-gamma t) (x0 + (v0 + gamma x0) t), gamma = b/(2 m)"
        end if
    end subroutine start_forced

    pure subroutine state_at(self, t, q, v)
        !! Overdamped by the slow and the fast rate, \(\lambda_\pm = -\gamma_\mp\),
        !! \(\gamma_- = \omega_0^2/\gamma_+\):
        !! \(x = x_0(e^{-\gamma_-u} + \gamma_-s) + v_0s\) and
        !! \(\dot x = v_0(e^{-\gamma_+u} - \gamma_-s) - \omega_0^2x_0s\).
        class(forced_oscillation_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(self%ndof), v(self%ndof)
        complex(dp) :: plus, minus, drive, response
        real(dp) :: u, omega, decay, fast, slow, s, c

        u = t - self%t0
        if (self%excess > 0.0_dp) then
            omega = sqrt(self%excess)
            plus = cmplx(-self%gamma*u, omega*u, dp)
            minus = conjg(plus)
            decay = exp(-self%gamma*u)
            s = decay*u*sinc(omega*u)
            c = decay*cos(omega*u)
            q(1) = self%x0*c + (self%v0 + self%gamma*self%x0)*s
            v(1) = self%v0*c - (self%gamma*self%v0 + self%square*self%x0)*s
        else
            fast = self%gamma + sqrt(-self%excess)
            slow = 0.0_dp
            if (fast > 0.0_dp) slow = self%square/fast
            plus = -slow*u
            minus = -fast*u
            s = u*real(first_difference(plus, minus))
            q(1) = self%x0*(exp(-slow*u) + slow*s) + self%v0*s
            v(1) = self%v0*(exp(-fast*u) - slow*s) - self%square*self%x0*s
        end if
        if (.not. abs(self%force) > 0.0_dp) return
        drive = i*self%w
        response = u**2*second_difference(plus, minus, drive*u)
        q(1) = q(1) + self%force*real(exp(drive*self%t0)*response)
        v(1) = v(1) + self%force*real(exp(drive*self%t0)*(s + drive*response))
    end subroutine state_at
end module lagrangia_forced_oscillation
