submodule (lagrangia_rolling_disk) lagrangia_rolling_disk_reference
    !! The rolling disk in closed form: a circle on the level, a sideways drift on an incline.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    use lagrangia_sinc, only: sinc, sinc_lag
    implicit none (type, external)

    type, extends(reference_t) :: rolling_disk_reference_t
        real(dp) :: r = 0.0_dp, kappa = 0.0_dp  !! radius, m; roll acceleration, rad/s^2
        real(dp) :: t0 = 0.0_dp, q0(4) = 0.0_dp, v0(4) = 0.0_dp
    contains
        procedure :: state_at
    end type rolling_disk_reference_t

contains

    module subroutine closed_form(self, t0, q0, v0, reference)
        !! Covers every initial state that rolls.
        class(rolling_disk_t), intent(in) :: self
        real(dp), intent(in) :: t0, q0(:), v0(:)
        class(reference_t), allocatable, intent(out) :: reference
        type(rolling_disk_reference_t) :: motion
        type(error_t), allocatable :: slips

        motion%title = "circle of radius r phi_dot/theta_dot; on an incline, drift r kappa/(2 "// &
                     "theta_dot) (Lagrange-d'Alembert)"
        motion%ndof = 4
        motion%r = self%r
        motion%kappa = self%roll_acceleration()
        motion%t0 = t0
        motion%q0 = q0
        call self%complete_velocities(t0, q0, v0, motion%v0, slips)
        if (.not. allocated(slips)) allocate (reference, source=motion)
    end subroutine closed_form

    pure subroutine state_at(self, t, q, v)
        !! With \(\tau = t - t_0\), \(\vartheta = \theta_0 + \omega\tau/2\) and
        !! \(s = \mathrm{sinc}(\omega\tau/2)\),
        !! $$ \dot\varphi = \Omega + \kappa\tau s\sin\vartheta,\quad
        !!    x = x_0 + R\tau s\sin\vartheta\,(\Omega + \tfrac12\kappa\tau s\sin\vartheta),\quad
        !!    y = y_0 - R\Omega\tau s\cos\vartheta - R\kappa\tau^2[\tfrac14 s^2\sin 2\vartheta
        !!        - \tfrac12 d], $$
        !! \(d = (\omega\tau - \sin\omega\tau)/(\omega\tau)^2\): the textbook form, whose
        !! quotients by \(\omega\) are differences of sines and cosines, made products. It holds
        !! for \(\omega \to 0\), the straight line, and for \(\kappa = 0\), the level.
        class(rolling_disk_reference_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(self%ndof), v(self%ndof)
        real(dp) :: tau, z, mid, ts, lag

        associate (r => self%r, kappa => self%kappa, q0 => self%q0, theta0 => self%q0(4), &
                   roll => self%v0(3), omega => self%v0(4))
            tau = t - self%t0
            z = omega*tau
            mid = theta0 + 0.5_dp*z
            ts = tau*sinc(0.5_dp*z)
            lag = tau**2*sinc_lag(z)
            q(1) = q0(1) + r*ts*sin(mid)*(roll + 0.5_dp*kappa*ts*sin(mid))
            q(2) = q0(2) - r*roll*ts*cos(mid) &
                   - r*kappa*(0.25_dp*ts**2*sin(2.0_dp*mid) - 0.5_dp*lag)
            q(3) = q0(3) + roll*tau + kappa*(0.5_dp*ts**2*sin(theta0) + lag*cos(theta0))
            q(4) = theta0 + z
            v(3) = roll + kappa*ts*sin(mid)
            v(4) = omega
            v(1) = r*v(3)*sin(q(4))
            v(2) = -r*v(3)*cos(q(4))
        end associate
    end subroutine state_at
end submodule lagrangia_rolling_disk_reference
