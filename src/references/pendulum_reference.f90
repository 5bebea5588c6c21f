submodule (lagrangia_pendulum) lagrangia_pendulum_reference
    !! The pendulum's motion in closed form, at any energy and from any initial state.
    !!
    !! With \(S = \sin\tfrac\theta2\), \(C = \cos\tfrac\theta2\), \(W = \dot\theta/2\omega\),
    !! \(\omega^2 = g/\ell\), the energy is \(k^2 = S^2 + W^2\). From the bottom
    !! \(S = k\,\mathrm{sn}, C = \mathrm{dn}, W = k\,\mathrm{cn}\) of \((\omega t, k)\); the
    !! addition theorems carry this to any initial state, and there \(k\) itself drops out:
    !! $$ S = \frac{W_0 C_0\,\mathrm{sn} + S_0\,\mathrm{cn\,dn}}{N},\quad
    !!    C = \frac{C_0\,\mathrm{dn} - S_0 W_0\,\mathrm{sn\,cn}}{N},\quad
    !!    W = \frac{W_0\,\mathrm{cn} - S_0 C_0\,\mathrm{sn\,dn}}{N} $$
    !! with \(N = 1 - S_0^2\,\mathrm{sn}^2 = \mathrm{cn}^2 + C_0^2\,\mathrm{sn}^2\), for
    !! libration (\(k < 1\)), separatrix and rotation alike. The complementary modulus comes from
    !! \(1 - k^2 = (C_0 - W_0)(C_0 + W_0)\), without loss of digits near the separatrix.
    !!
    !! Source: DLMF 22.8 (addition theorems), 22.17 (modulus above 1), 22.19(i) (pendulum).
    use lagrangia_elliptic, only: elliptic_k, jacobi
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    use lagrangia_standing, only: half_turns, near, standing_t, start_standing
    implicit none (type, external)

    real(dp), parameter :: pi = acos(-1.0_dp)

    type, extends(reference_t) :: pendulum_reference_t
        real(dp) :: t0 = 0.0_dp, theta0 = 0.0_dp, v0 = 0.0_dp
        real(dp) :: omega = 0.0_dp                     !! \(\sqrt{g/\ell}\), rad/s
        real(dp) :: s = 0.0_dp, c = 1.0_dp, w = 0.0_dp !! \(S_0, C_0, W_0\)
        real(dp) :: kc = 1.0_dp                        !! complement of \(k\), or of \(1/k\)
        real(dp) :: k = 0.0_dp                         !! only where the pendulum rotates, else 0
    contains
        procedure :: state_at
    end type pendulum_reference_t

contains

    module subroutine closed_form(self, t0, q0, v0, reference)
        !! See `system_t` and `set_motion`. With friction only of rest at the bottom or at the top.
        class(pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t0, q0(:), v0(:)
        class(reference_t), allocatable, intent(out) :: reference
        type(pendulum_reference_t) :: motion
        type(standing_t) :: rest
        logical :: found

        if (self%nonconservative) then
            found = self%g <= 0.0_dp .or. near(q0(1), half_turns(q0(1)))
            call start_standing(rest, "at rest", q0)
            if (found .and. abs(v0(1)) <= 0.0_dp) allocate (reference, source=rest)
            return
        end if
        call set_motion(motion, self, t0, q0, v0, found)
        if (found) allocate (reference, source=motion)
    end subroutine closed_form

    pure subroutine set_motion(self, system, t0, q0, v0, found)
        !! Covers every initial state; without gravity the rotation is uniform.
        type(pendulum_reference_t), intent(out) :: self
        class(pendulum_t), intent(in) :: system
        real(dp), intent(in) :: t0, q0(:), v0(:)
        logical, intent(out) :: found
        real(dp) :: k2, kc2

        found = .true.
        self%ndof = 1
        self%t0 = t0
        self%theta0 = q0(1)
        self%v0 = v0(1)
        self%omega = sqrt(system%g/system%l)
        if (self%omega <= 0.0_dp) then
            self%title = "uniform rotation"
            if (abs(v0(1)) > 0.0_dp) self%period = 2.0_dp*pi/abs(v0(1))
            return
        end if
        self%small_period = 2.0_dp*pi/self%omega
        self%s = sin(0.5_dp*q0(1))
        self%c = cos(0.5_dp*q0(1))
        self%w = 0.5_dp*v0(1)/self%omega
        k2 = self%s**2 + self%w**2
        kc2 = (self%c - self%w)*(self%c + self%w)
        if (kc2 > 0.0_dp) then
            self%title = "libration: Jacobi's elliptic functions"
            self%kc = min(1.0_dp, sqrt(kc2))
            if (k2 > 0.0_dp) self%period = 4.0_dp*elliptic_k(self%kc)/self%omega
        else if (kc2 < 0.0_dp) then
            self%title = "rotation: Jacobi's elliptic functions of modulus 1/k"
            self%k = hypot(self%s, self%w)
            self%kc = min(1.0_dp, sqrt(-kc2)/self%k)
            self%period = 2.0_dp*elliptic_k(self%kc)/(self%k*self%omega)
        else
            self%title = "separatrix: hyperbolic functions"
            self%kc = 0.0_dp
        end if
    end subroutine set_motion

    pure subroutine state_at(self, t, q, v)
        !! The angle goes on growing where the pendulum rotates: half of it has turned by less than
        !! \(\pi\) from its mean \(\pi u/2K\), which tells the turn.
        class(pendulum_reference_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(self%ndof), v(self%ndof)
        real(dp) :: u, sn, cn, dn, swapped, half, norm, s, c, w, mean

        if (self%omega <= 0.0_dp) then
            q(1) = self%theta0 + self%v0*(t - self%t0)
            v(1) = self%v0
            return
        end if
        u = self%omega*(t - self%t0)
        if (self%k > 0.0_dp) then
            u = self%k*u
            call jacobi(u, self%kc, sn, cn, dn)
            sn = sn/self%k
            swapped = cn
            cn = dn
            dn = swapped
        else
            call jacobi(u, self%kc, sn, cn, dn)
        end if
        norm = cn**2 + (self%c*sn)**2
        s = (self%w*self%c*sn + self%s*cn*dn)/norm
        c = (self%c*dn - self%s*self%w*sn*cn)/norm
        w = (self%w*cn - self%s*self%c*sn*dn)/norm
        half = atan2(s*self%c - c*self%s, c*self%c + s*self%s)
        if (self%k > 0.0_dp) then
            mean = sign(0.5_dp*pi*u/elliptic_k(self%kc), u*self%w)
            half = half + 2.0_dp*pi*anint((mean - half)/(2.0_dp*pi))
        end if
        q(1) = self%theta0 + 2.0_dp*half
        v(1) = 2.0_dp*self%omega*w
    end subroutine state_at
end submodule lagrangia_pendulum_reference
