submodule (lagrangia_cart_pendulum) lagrangia_cart_pendulum_reference
    !! The cart-pendulum's motion by one quadrature, exact to rounding.
    !!
    !! The momentum \(p_x\) gives the cart; the energy leaves
    !! \(\tfrac14 N^2\dot\theta^2 + \omega^2\sin^2\tfrac\theta2 = \mathrm{const}\), where
    !! \(N^2 = (m_1 + m_2\sin^2\theta)/(m_1 + m_2)\) and \(\omega^2 = g/\ell\). Libration,
    !! \(\sin\tfrac\theta2 = k\sin\varphi\), and rotation, \(\theta = 2\varphi\), both become
    !! $$ \frac{dt}{d\varphi} = \frac{N}{\sqrt D},\quad
    !!    D = \omega^2(\cos^2\varphi + k'^2\sin^2\varphi)\ \text{or}
    !!    \ \omega^2\cos^2\varphi + \mathrm{const}, $$
    !! smooth, even and of period \(\pi\): its Fourier series, by the trapezoid rule, converges
    !! geometrically. Integrated term by term it is the time \(t(\varphi)\), which grows with
    !! \(\varphi\) and is inverted by Newton's method inside a bracket.
    !!
    !! Derived here from \(L\); the rule: Trefethen & Weideman, SIAM Review 56, 385 (2014).
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    implicit none (type, external)

    real(dp), parameter :: pi = acos(-1.0_dp)
    integer, parameter :: most_points = 8192  !! of the trapezoid rule, for a period of `pi`

    type, extends(reference_t) :: cart_pendulum_reference_t
        type(cart_pendulum_t) :: system
        real(dp) :: t0 = 0.0_dp, q0(2) = 0.0_dp
        real(dp) :: drift = 0.0_dp       !! velocity of the centre of mass, m/s
        logical :: still = .false.       !! the angle does not change
        logical :: rotates = .false.
        real(dp) :: direction = 1.0_dp   !! of a rotation, \(\pm1\)
        real(dp) :: turns = 0.0_dp       !! angle about which a libration swings, rad
        real(dp) :: omega = 0.0_dp       !! rad/s
        real(dp) :: k = 0.0_dp           !! of a libration, sine of half the amplitude
        real(dp) :: rest = 0.0_dp        !! \(k'^2\) of a libration, the constant of a rotation
        real(dp) :: phase = 0.0_dp       !! \(\varphi\) at the start
        real(dp) :: clock = 0.0_dp       !! \(t(\varphi)\) at the start, s
        real(dp) :: mean = 0.0_dp        !! mean of \(dt/d\varphi\), s
        real(dp), allocatable :: wave(:) !! \(t = \mathrm{mean}\,\varphi + \sum w_n\sin2n\varphi\)
    contains
        procedure :: state_at
    end type cart_pendulum_reference_t

contains

    module subroutine closed_form(self, t0, q0, v0, reference)
        !! See `system_t` and `set_motion`.
        class(cart_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t0, q0(:), v0(:)
        class(reference_t), allocatable, intent(out) :: reference
        type(cart_pendulum_reference_t) :: motion
        logical :: found

        call set_motion(motion, self, t0, q0, v0, found)
        if (found) allocate (reference, source=motion)
    end subroutine closed_form

    pure subroutine set_motion(self, system, t0, q0, v0, found)
        !! Covers every initial state, but for those so near the separatrix (closer than 0.01 rad
        !! to the top where the angle turns back), or with so light a cart (`m1` below 1e-4 `m2`),
        !! that the series gets too long. The period is that of the angle.
        type(cart_pendulum_reference_t), intent(out) :: self
        class(cart_pendulum_t), intent(in) :: system
        real(dp), intent(in) :: t0, q0(:), v0(:)
        logical, intent(out) :: found
        real(dp) :: s, c, w

        self%title = "quadrature dt = N dphi/sqrt(D) as a Fourier series, inverted"
        self%ndof = 2
        self%system = system
        self%t0 = t0
        self%q0 = q0
        self%omega = sqrt(system%g/system%l)
        if (system%g > 0.0_dp) self%small_period = &
            2.0_dp*pi*sqrt(system%m1*system%l/((system%m1 + system%m2)*system%g))
        self%drift = v0(1) + share(system)*system%l*v0(2)*cos(q0(2))
        s = sin(0.5_dp*q0(2))
        c = cos(0.5_dp*q0(2))
        w = 0.5_dp*v0(2)*inertia(system, s, c)
        found = .true.
        self%still = abs(w) <= 0.0_dp .and. self%omega*abs(s) <= 0.0_dp
        if (self%still) return

        self%rest = (w - self%omega*abs(c))*(w + self%omega*abs(c))
        self%rotates = self%rest >= 0.0_dp
        if (self%rotates) then
            self%direction = sign(1.0_dp, w)
            self%phase = 0.5_dp*q0(2)
        else
            w = w/self%omega
            self%rest = (abs(c) - w)*(abs(c) + w)
            self%k = hypot(s, w)
            s = sign(s, s*c)
            self%turns = 2.0_dp*pi*anint((0.5_dp*q0(2) - atan2(s, abs(c)))/pi)
            self%phase = atan2(s, w)
        end if
        call expand(self, found)
        if (.not. found) return
        self%clock = clock_at(self, self%phase)
        self%period = merge(pi, 2.0_dp*pi, self%rotates)*self%mean
    end subroutine set_motion

    pure function share(system)
        !! \(\mu = m_2/(m_1+m_2)\).
        type(cart_pendulum_t), intent(in) :: system
        real(dp) :: share

        share = system%m2/(system%m1 + system%m2)
    end function share

    pure function inertia(system, s, c) result(n)
        !! \(N\) from the sine and the cosine of half the angle.
        type(cart_pendulum_t), intent(in) :: system
        real(dp), intent(in) :: s, c
        real(dp) :: n

        n = sqrt((system%m1 + system%m2*(2.0_dp*s*c)**2)/(system%m1 + system%m2))
    end function inertia

    pure subroutine half_angle(self, phase, s, c, rate)
        !! Sine and cosine of half the angle, and \(d\varphi/dt\), from the phase.
        class(cart_pendulum_reference_t), intent(in) :: self
        real(dp), intent(in) :: phase
        real(dp), intent(out) :: s, c, rate

        if (self%rotates) then
            s = sin(phase)
            c = cos(phase)
            rate = sqrt((self%omega*c)**2 + self%rest)/inertia(self%system, s, c)
        else
            s = self%k*sin(phase)
            c = sqrt(cos(phase)**2 + self%rest*sin(phase)**2)
            rate = self%omega*c/inertia(self%system, s, c)
        end if
    end subroutine half_angle

    pure subroutine expand(self, found)
        !! The Fourier series of \(dt/d\varphi\), with twice the points until its tail is rounding.
        class(cart_pendulum_reference_t), intent(inout) :: self
        logical, intent(out) :: found
        real(dp), allocatable :: f(:), a(:), cosine(:)
        real(dp) :: s, c, rate
        integer :: n, j, k

        found = .true.
        n = 16
        do while (n <= most_points)
            allocate (f(0:n - 1), cosine(0:n - 1), a(0:n/2 - 1))
            do j = 0, n - 1
                call half_angle(self, pi*j/n, s, c, rate)
                f(j) = 1.0_dp/rate
                cosine(j) = cos(2.0_dp*pi*j/n)
            end do
            do k = 0, n/2 - 1
                a(k) = 0.0_dp
                do j = 0, n - 1
                    a(k) = a(k) + f(j)*cosine(mod(j*k, n))
                end do
            end do
            a = a/n
            if (maxval(abs(a(3*n/8:))) <= 2.0_dp*epsilon(1.0_dp)*a(0)) then
                self%mean = a(0)
                self%wave = [(a(k)/k, k = 1, 3*n/8)]
                return
            end if
            deallocate (f, cosine, a)
            n = 2*n
        end do
        found = .false.
    end subroutine expand

    pure function clock_at(self, phase) result(t)
        !! The time at which the phase is reached, s; the sum by Clenshaw's recurrence.
        class(cart_pendulum_reference_t), intent(in) :: self
        real(dp), intent(in) :: phase
        real(dp) :: t, twice, b0, b1, b2
        integer :: n

        twice = 2.0_dp*cos(2.0_dp*phase)
        b1 = 0.0_dp
        b2 = 0.0_dp
        do n = size(self%wave), 1, -1
            b0 = self%wave(n) + twice*b1 - b2
            b2 = b1
            b1 = b0
        end do
        t = self%mean*phase + b1*sin(2.0_dp*phase)
    end function clock_at

    pure subroutine phase_at(self, t, phase, half_turns)
        !! The phase at a time, between 0 and \(\pi\), and how often \(\pi\) goes on top of it.
        class(cart_pendulum_reference_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: phase, half_turns
        real(dp) :: reading, error, low, high, next, s, c, rate
        integer :: i

        reading = self%clock + self%direction*(t - self%t0)
        half_turns = anint(reading/(pi*self%mean) - 0.5_dp)
        reading = reading - half_turns*(pi*self%mean)
        low = 0.0_dp
        high = pi
        phase = reading/self%mean
        do i = 1, 100
            error = clock_at(self, phase) - reading
            if (error > 0.0_dp) then
                high = phase
            else
                low = phase
            end if
            call half_angle(self, phase, s, c, rate)
            next = phase - error*rate
            if (next < low .or. next > high) next = 0.5_dp*(low + high)
            if (abs(next - phase) <= 4.0_dp*epsilon(1.0_dp)*pi*max(1.0_dp, self%mean*rate)) exit
            phase = next
        end do
        phase = next
    end subroutine phase_at

    pure subroutine state_at(self, t, q, v)
        !! The angle from its phase, the cart from the centre of mass. After many turns the angle
        !! is rounded more coarsely than `s` and `c`: the cart goes by these.
        class(cart_pendulum_reference_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(self%ndof), v(self%ndof)
        real(dp) :: phase, half_turns, s, c, rate, arm

        arm = share(self%system)*self%system%l
        if (self%still) then
            q(2) = self%q0(2)
            v(2) = 0.0_dp
            s = sin(0.5_dp*q(2))
            c = cos(0.5_dp*q(2))
        else
            call phase_at(self, t, phase, half_turns)
            call half_angle(self, phase, s, c, rate)
            if (self%rotates) then
                q(2) = 2.0_dp*(phase + half_turns*pi)
                v(2) = 2.0_dp*self%direction*rate
            else
                s = merge(s, -s, mod(abs(half_turns), 2.0_dp) < 0.5_dp)
                v(2) = 2.0_dp*self%k*cos(phase)*self%omega/inertia(self%system, s, c)
                v(2) = merge(v(2), -v(2), mod(abs(half_turns), 2.0_dp) < 0.5_dp)
                q(2) = self%turns + 2.0_dp*atan2(s, c)
            end if
        end if
        q(1) = self%q0(1) + self%drift*(t - self%t0) - arm*(2.0_dp*s*c - sin(self%q0(2)))
        v(1) = self%drift - arm*v(2)*(1.0_dp - 2.0_dp*s**2)
    end subroutine state_at
end submodule lagrangia_cart_pendulum_reference
