module lagrangia_driven_pendulum
    !! A pendulum whose pivot is shaken up and down: \(L\) contains the time.
    !!
    !! Source: the lecture of 1 September 2011 says of conservative forces that \(V\) must not
    !! depend on the time. That is sufficient, not necessary: Lagrange's equations hold for
    !! \(V(x, t)\) and for this moving constraint alike; what is lost is the energy,
    !! \(\dot h = -\partial L/\partial t\). The pendulum itself is not in the notes.
    !!
    !! Signs: \(y\) and \(y_p = a\cos\Omega t\) count upwards, \(\theta\) from the downward
    !! vertical; \(g + \ddot y_p\) is the gravity that the bob feels.
    use lagrangia_description, only: add_zeros, coordinate, description_t, figure_length, &
                                     formula_length, frequency_t, letter_t, mass_point, &
                                     nonnegative, positive, quantity, real_number
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: cos, hyperdual_t, operator(*), operator(**), operator(+), &
                                   operator(-), sin
    use lagrangia_kinds, only: dp
    use lagrangia_linearised, only: linearised_t
    use lagrangia_reference, only: reference_t
    use lagrangia_sine_cosine, only: sine_cosine
    use lagrangia_system, only: check_parameters, lanes, system_t
    implicit none (type, external)
    private
    public :: driven_pendulum_t

    type, extends(system_t) :: driven_pendulum_t
        !! The coordinate is \(\theta\), rad, from the downward vertical.
        real(dp) :: m = 1.0_dp                 !! kg
        real(dp) :: l = 1.0_dp                 !! m
        real(dp) :: g = 9.81_dp                !! m s^-2
        real(dp) :: amplitude = 0.1_dp         !! a of the pivot, m
        real(dp) :: drive_frequency = 50.0_dp  !! \(\Omega\), rad s^-1
        real(dp) :: b = 0.0_dp                 !! kg m^2/s
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: lagrangian
        procedure :: generalised_forces
        procedure :: energy
        procedure :: linearise
        procedure :: quantity => energy_or_force
        procedure :: positions
        procedure :: newton
        procedure :: driven
        procedure :: closed_form
    end type driven_pendulum_t

    interface
        module subroutine closed_form(self, t0, q0, v0, reference)
            !! See `system_t`; in `driven_pendulum_reference`.
            implicit none (type, external)
            class(driven_pendulum_t), intent(in) :: self
            real(dp), intent(in) :: t0, q0(:), v0(:)
            class(reference_t), allocatable, intent(out) :: reference
        end subroutine closed_form
    end interface

contains

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(driven_pendulum_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "driven_pendulum"
        d%title = "a pendulum whose pivot moves up and down"
        d%coordinates = [coordinate("theta", "rad", "angle of the rod from the downward vertical")]
        d%parameters = [ &
            positive("m", "kg", "mass of the bob", self%m), &
            positive("l", "m", "length of the rod", self%l), &
            nonnegative("g", "m/s^2", "gravity", self%g), &
            real_number("amplitude", "m", "a: the pivot is at y_p = a cos(W t), upwards", &
                   self%amplitude), &
            nonnegative("drive_frequency", "rad/s", "W, angular frequency of the pivot", &
                        self%drive_frequency), &
            nonnegative("b", "kg m^2/s", "damping, in the pivot", self%b)]
        d%energy_scale = self%m*(self%g*self%l + (self%amplitude*self%drive_frequency)**2)
        d%letters = [letter_t("a", "amplitude"), letter_t("W", "drive_frequency"), &
                         letter_t("y_p", "a cos(W t)")]
        d%quantities = [ &
            quantity("mechanical_energy", "J", "with the pivot's motion in T", "T + V"), &
            quantity("p_theta", "kg m^2/s", "free of the drive's fast part", &
                     "m l^2 theta_dot + m l y_p_dot sin(theta)"), &
            quantity("slow_energy", "J", "Kapitza's average", "p_theta^2/(2 m l^2) "// &
                     "- m g l cos(theta) + m/4 (a W sin(theta))^2"), &
            quantity("tension", "N", "force along the rod", &
                     "m (l theta_dot^2 + (g + y_p_ddot) cos(theta))"), &
            quantity("pivot", "m", "height of the pivot", "y_p")]
        if (self%conserves_energy()) then
            d%quantities(1)%conserved = .true.
            d%quantities(3)%conserved = .true.
            d%quantities(2)%conserved = self%g <= 0.0_dp
            d%quantities(1:3:2)%scale = d%energy_scale
        end if
        d%points = [mass_point("bob", self%m, "m", "l sin(theta)", "y_p - l cos(theta)")]
        d%reactions = [quantity("tension", "N", "of the rod", &
                                "(l^2 - x_bob^2 - (y_bob - y_p)^2)/(2 l)")]
        d%kinetic_energy = "m/2 (l^2 theta_dot^2 + 2 l theta_dot y_p_dot sin(theta) + y_p_dot^2)"
        d%potential_energy = "m g (y_p - l cos(theta))"
        d%lagrangian = d%kinetic_energy//" - m g (y_p - l cos(theta))"
        d%energy = "m/2 (l^2 theta_dot^2 - y_p_dot^2) + m g (y_p - l cos(theta))"
        d%equations = [character(formula_length) :: &
            "l theta_ddot + (g + y_p_ddot) sin(theta) = 0"]
        if (self%nonconservative) then
            d%generalised_forces = [character(formula_length) :: "Q_theta = - b theta_dot"]
            d%dissipation = "b/2 theta_dot^2"
            d%equations(1) = "l theta_ddot + b/(m l) theta_dot + (g + y_p_ddot) sin(theta) = 0"
        end if
        d%constraint = "holonomic, rheonomic"
        d%constraint_equations = [character(len(d%title)) :: "x_bob^2 + (y_bob - y_p)^2 = l^2"]
        if (.not. self%driven()) then
            d%frequencies = [frequency_t("omega^2 = g/l", "theta = 0"), &
                             frequency_t("omega^2 = - g/l", "theta = pi")]
            if (self%nonconservative) deallocate (d%frequencies)
            d%constraint = "holonomic, scleronomic"
            d%constraint_equations = [character(len(d%title)) :: "x_bob^2 + (y_bob - a)^2 = l^2"]
        end if
        d%notes = [character(len(d%title)) :: &
            "As the notes say: V = m g y has no t, V(theta, t) has, by way of y(theta, t).", &
            "Lagrange's equations hold; dh/dt = - dL/dt (partial), less b theta_dot^2.", &
            "Neither h nor T + V is conserved, unless the pivot rests and nothing damps.", &
            "y_p, the pivot's height, counts upwards; at t = 0 it is a.", &
            "A function of t alone may be left out of L (uniqueness): then h changes, not theta.", &
            "Upside down it is stable for a fast drive: (a W)^2 > 2 g l, a << l (Kapitza)."]
        d%figure = [character(figure_length) :: "axis (0, - a) (0, a)", "trail bob", &
                    "pivot (0, y_p)", "rod (0, y_p) bob", "ball bob"]
        d%source = "Hamilton's Principle: rheonomic constraints (the notes define the concept only)"
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! In this order: m, l, g, amplitude, drive_frequency, b; the last may be left out.
        class(driven_pendulum_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error
        real(dp), allocatable :: p(:)

        call add_zeros(values, 6, 5, p)
        call check_parameters(self, p, error)
        if (allocated(error)) return
        self%ndof = 1
        self%m = p(1)
        self%l = p(2)
        self%g = p(3)
        self%amplitude = p(4)
        self%drive_frequency = p(5)
        self%b = p(6)
        self%velocity_forces = self%b > 0.0_dp
        self%nonconservative = self%velocity_forces
        self%time_dependent = self%driven()
        self%cyclic = merge(0, 1, self%driven() .or. max(self%g, self%b) > 0.0_dp)
    end subroutine configure

    pure function driven(self)
        !! The pivot moves.
        class(driven_pendulum_t), intent(in) :: self
        logical :: driven

        driven = abs(self%amplitude)*self%drive_frequency > 0.0_dp
    end function driven

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ \ddot\theta = -\frac{g + \ddot y_p}{\ell}\sin\theta
        !!    - \frac b{m\ell^2}\dot\theta,\qquad \ddot y_p = -a\,\Omega^2\cos\Omega t $$
        class(driven_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        associate (w => self%drive_frequency)
            a(1) = -(self%g - self%amplitude*w**2*cos(w*t))/self%l*sin(q(1))
        end associate
        if (self%nonconservative) a(1) = a(1) - self%b/(self%m*self%l**2)*v(1)
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L = \tfrac12 m(\ell^2\dot\theta^2 + 2\ell\dot\theta\dot y_p\sin\theta + \dot y_p^2)
        !!      - mg(y_p - \ell\cos\theta) $$
        class(driven_pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l, y, y_dot

        associate (m => self%m, r => self%l, w => self%drive_frequency)
            y = self%amplitude*cos(w*t)
            y_dot = -self%amplitude*w*sin(w*t)
            l = 0.5_dp*m*(r**2*v(1)**2 + 2.0_dp*r*v(1)*y_dot*sin(q(1)) + y_dot**2) &
                - m*self%g*(y - r*cos(q(1)))
        end associate
    end function lagrangian

    pure subroutine generalised_forces(self, t, q, v, f)
        !! \(Q = -b\dot\theta\): friction in the pivot, \(R = \tfrac b2\dot\theta^2\).
        class(driven_pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t), intent(out) :: f(self%ndof)

        f(1) = -self%b*v(1)
    end subroutine generalised_forces

    pure function energy(self, t, q, v) result(e)
        !! $$ h = \tfrac12 m(\ell^2\dot\theta^2 - \dot y_p^2) + mg(y_p - \ell\cos\theta) $$
        class(driven_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        associate (m => self%m, l => self%l, a => self%amplitude, w => self%drive_frequency)
            e = 0.5_dp*m*(l**2*v(1)**2 - (a*w*sin(w*t))**2) &
                + m*self%g*(a*cos(w*t) - l*cos(q(1)))
        end associate
    end function energy

    pure function energy_or_force(self, i, t, q, v) result(value)
        !! (1) \(T + V\). (2) momentum of \(\theta\). (3) Kapitza's averaged energy. (4) tension.
        !! (5) height of the pivot.
        class(driven_pendulum_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value, y, y_dot, y_ddot, s, c, p

        s = sin(q(1))
        c = cos(q(1))
        associate (m => self%m, l => self%l, g => self%g, w => self%drive_frequency, &
                   theta_dot => v(1))
            y = self%amplitude*cos(w*t)
            y_dot = -self%amplitude*w*sin(w*t)
            y_ddot = -w**2*y
            p = m*l**2*theta_dot + m*l*y_dot*s
            select case (i)
            case (1)
                value = 0.5_dp*m*(l**2*theta_dot**2 + 2.0_dp*l*theta_dot*y_dot*s + y_dot**2) &
                        + m*g*(y - l*c)
            case (2)
                value = p
            case (3)
                value = 0.5_dp*p**2/(m*l**2) - m*g*l*c + 0.25_dp*m*(self%amplitude*w*s)**2
            case (4)
                value = m*(l*theta_dot**2 + (g + y_ddot)*c)
            case default
                value = y
            end select
        end associate
    end function energy_or_force

    pure subroutine positions(self, t, q, r)
        !! The bob, \((\ell\sin\theta, y_p - \ell\cos\theta)\).
        class(driven_pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        r = hyperdual_t()
        r(1, 1) = self%l*sin(q(1))
        r(2, 1) = self%amplitude*cos(self%drive_frequency*t) - self%l*cos(q(1))
    end subroutine positions

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! `accelerations`, in all lanes at once.
        class(driven_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)
        real(dp) :: s(lanes), c(lanes), other(lanes)

        associate (w => self%drive_frequency)
            call sine_cosine(q(:, 1), s, other)
            call sine_cosine(w*t, other, c)
            a(:, 1) = -(self%g - self%amplitude*w**2*c)/self%l*s
        end associate
        if (self%nonconservative) a(:, 1) = a(:, 1) - self%b/(self%m*self%l**2)*v(:, 1)
    end subroutine accelerations_lanes

    pure subroutine newton(self, t, x, u, force, constraint_residual)
        !! Gravity; friction, a force \(-b\dot\theta/\ell\) across the rod; the rod from the moving
        !! pivot, \((\ell^2 - x^2 - (y - y_p)^2)/2\ell = 0\).
        class(driven_pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)
        type(hyperdual_t) :: y
        real(dp) :: y_dot

        force = 0.0_dp
        force(2) = -self%m*self%g
        y = x(2) - self%amplitude*cos(self%drive_frequency*t)
        if (self%nonconservative) then
            associate (a => self%amplitude, w => self%drive_frequency)
                y_dot = u(2)%re + a*w*sin(w*t%re)
            end associate
            force(:2) = force(:2) - self%b/self%l**4*(x(1)%re*y_dot - y%re*u(1)%re) &
                        *[-y%re, x(1)%re]
        end if
        constraint_residual(1) = 0.5_dp/self%l*(self%l**2 - x(1)**2 - y**2)
    end subroutine newton

    pure subroutine linearise(self, q, analytic)
        !! The pivot at rest: \(M = m\ell^2\), \(K = \pm mg\ell\).
        class(driven_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof)
        type(linearised_t), intent(out) :: analytic
        real(dp) :: orientation

        orientation = sign(1.0_dp, cos(q(1)))
        analytic%mass = reshape([self%m*self%l**2], [1, 1])
        analytic%stiffness = reshape([orientation*self%m*self%g*self%l], [1, 1])
        analytic%omega2 = [orientation*self%g/self%l]
    end subroutine linearise
end module lagrangia_driven_pendulum
