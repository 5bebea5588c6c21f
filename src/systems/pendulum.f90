module lagrangia_pendulum
    !! A bob on a rigid rod: the example of the notes for the uniqueness of the Lagrangian.
    !!
    !! The notes give \(L = \tfrac12 m\ell^2\dot\theta^2 + mg\ell\cos\theta - \mathrm{const}\),
    !! where the constant is free; here it is zero, so \(E = -mg\ell\) at rest at the bottom.
    !!
    !! Friction in the pivot is a generalised force beside L: \(Q = -b\dot\theta\), from
    !! Rayleigh's function \(R = \tfrac b2\dot\theta^2\).
    use lagrangia_description, only: add_zeros, conserved, coordinate, description_t, &
                                     figure_length, formula_length, frequency_t, mass_point, &
                                     nonnegative, positive, quantity
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: cos, dot_product, hyperdual_t, operator(*), operator(**), &
                                   operator(+), operator(-), sin
    use lagrangia_kinds, only: dp
    use lagrangia_linearised, only: linearised_t
    use lagrangia_reference, only: reference_t
    use lagrangia_sine_cosine, only: sine_cosine
    use lagrangia_system, only: check_parameters, lanes, system_t
    implicit none (type, external)
    private
    public :: pendulum_t

    type, extends(system_t) :: pendulum_t
        !! The coordinate is \(\theta\), rad, from the downward vertical.
        real(dp) :: m = 1.0_dp   !! bob, kg
        real(dp) :: l = 1.0_dp   !! rod, m
        real(dp) :: g = 9.81_dp  !! m s^-2
        real(dp) :: b = 0.0_dp   !! kg m^2/s
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: lagrangian
        procedure :: generalised_forces
        procedure :: energy
        procedure :: linearise
        procedure :: momenta
        procedure :: velocities
        procedure :: forces
        procedure :: quantity => momentum_or_tension
        procedure :: positions
        procedure :: newton
        procedure :: closed_form
    end type pendulum_t

    interface
        module subroutine closed_form(self, t0, q0, v0, reference)
            !! See `system_t`; in `pendulum_reference`.
            implicit none (type, external)
            class(pendulum_t), intent(in) :: self
            real(dp), intent(in) :: t0, q0(:), v0(:)
            class(reference_t), allocatable, intent(out) :: reference
        end subroutine closed_form
    end interface

contains

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(pendulum_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "pendulum"
        d%title = "a bob on a rigid rod, at any amplitude"
        d%coordinates = [coordinate("theta", "rad", "angle of the rod from the downward vertical")]
        d%parameters = [positive("m", "kg", "mass of the bob", self%m), &
                        positive("l", "m", "length of the rod", self%l), &
                        nonnegative("g", "m/s^2", "gravity", self%g), &
                        nonnegative("b", "kg m^2/s", "damping, in the pivot", self%b)]
        d%energy_scale = self%m*self%g*self%l
        d%quantities = [ &
            quantity("L_z", "kg m^2/s", "angular momentum about the pivot", "m l^2 theta_dot"), &
            quantity("tension", "N", "force along the rod", "m (l theta_dot^2 + g cos(theta))")]
        if (self%cyclic == 1) d%quantities(1) = &
            conserved("L_z", "kg m^2/s", "angular momentum, theta is cyclic without gravity", &
                      0.0_dp, "m l^2 theta_dot")
        d%points = [mass_point("bob", self%m, "m", "l sin(theta)", "- l cos(theta)")]
        d%reactions = [quantity("tension", "N", "of the rod", &
                                "(l^2 - x_bob^2 - y_bob^2)/(2 l)")]
        d%kinetic_energy = "m/2 l^2 theta_dot^2"
        d%potential_energy = "- m g l cos(theta)"
        d%lagrangian = "m/2 l^2 theta_dot^2 + m g l cos(theta)"
        d%energy = "m/2 l^2 theta_dot^2 - m g l cos(theta)"
        d%equations = [character(formula_length) :: "l theta_ddot + g sin(theta) = 0"]
        d%frequencies = [frequency_t("omega^2 = g/l", "theta = 0"), &
                         frequency_t("omega^2 = - g/l", "theta = pi")]
        if (self%nonconservative) then
            d%generalised_forces = [character(formula_length) :: "Q_theta = - b theta_dot"]
            d%dissipation = "b/2 theta_dot^2"
            d%equations(1) = "l theta_ddot + b/(m l) theta_dot + g sin(theta) = 0"
            deallocate (d%frequencies)
        end if
        d%constraint = "holonomic, scleronomic"
        d%constraint_equations = [character(len(d%title)) :: "x_bob^2 + y_bob^2 = l^2"]
        d%notes = [character(len(d%title)) :: &
            "A constant, or a total time derivative, may be added to L: the equation stays.", &
            "Undamped: period 2 pi sqrt(l/g)/agm(1, cos(theta0/2)), agm the "// &
            "arithmetic-geometric mean.", &
            "A rod can push: where the tension is negative, a string would go slack."]
        d%figure = [character(figure_length) :: "pivot origin", "rod origin bob", "ball bob"]
        d%source = "Phys 601, 1 September 2011: uniqueness of the Lagrangian"
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! In this order: m, l, g, b; the last may be left out.
        class(pendulum_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error
        real(dp), allocatable :: p(:)

        call add_zeros(values, 4, 3, p)
        call check_parameters(self, p, error)
        if (allocated(error)) return
        self%ndof = 1
        self%m = p(1)
        self%l = p(2)
        self%g = p(3)
        self%b = p(4)
        self%velocity_forces = self%b > 0.0_dp
        self%nonconservative = self%velocity_forces
        self%cyclic = merge(0, 1, max(self%g, self%b) > 0.0_dp)
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ \ddot\theta = -\frac g\ell\sin\theta - \frac b{m\ell^2}\dot\theta $$
        class(pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a(1) = -self%g/self%l*sin(q(1))
        if (self%nonconservative) a(1) = a(1) - self%b/(self%m*self%l**2)*v(1)
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L = \tfrac12 m\ell^2\dot\theta^2 + m g\ell\cos\theta $$
        class(pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*self%m*self%l**2*v(1)**2 + self%m*self%g*self%l*cos(q(1))
    end function lagrangian

    pure subroutine generalised_forces(self, t, q, v, f)
        !! \(Q = -b\dot\theta\).
        class(pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t), intent(out) :: f(self%ndof)

        f(1) = -self%b*v(1)
    end subroutine generalised_forces

    pure subroutine momenta(self, t, q, v, p)
        !! \(p = m\ell^2\dot\theta\).
        class(pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: p(self%ndof)

        p(1) = self%m*self%l**2*v(1)
    end subroutine momenta

    pure subroutine velocities(self, t, q, p, v)
        !! \(\dot\theta = p/(m\ell^2)\).
        class(pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), p(self%ndof)
        real(dp), intent(out) :: v(self%ndof)

        v(1) = p(1)/(self%m*self%l**2)
    end subroutine velocities

    pure subroutine forces(self, t, q, v, f)
        !! \(f = -mg\ell\sin\theta\).
        class(pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: f(self%ndof)

        f(1) = -self%m*self%g*self%l*sin(q(1))
    end subroutine forces

    pure function energy(self, t, q, v) result(e)
        !! $$ E = \tfrac12 m\ell^2\dot\theta^2 - m g\ell\cos\theta $$
        class(pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = 0.5_dp*self%m*self%l**2*v(1)**2 - self%m*self%g*self%l*cos(q(1))
    end function energy

    pure function momentum_or_tension(self, i, t, q, v) result(value)
        !! (1) angular momentum. (2) the rod's tension.
        class(pendulum_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value

        select case (i)
        case (1)
            value = self%m*self%l**2*v(1)
        case default
            value = self%m*(self%l*v(1)**2 + self%g*cos(q(1)))
        end select
    end function momentum_or_tension

    pure subroutine positions(self, t, q, r)
        !! Bob \((\ell\sin\theta, -\ell\cos\theta)\).
        class(pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        r = hyperdual_t()
        r(1, 1) = self%l*sin(q(1))
        r(2, 1) = -self%l*cos(q(1))
    end subroutine positions

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! `accelerations`, in all lanes at once.
        class(pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)
        real(dp) :: s(lanes), c(lanes)

        call sine_cosine(q(:, 1), s, c)
        a(:, 1) = -self%g/self%l*s
        if (self%nonconservative) a(:, 1) = a(:, 1) - self%b/(self%m*self%l**2)*v(:, 1)
    end subroutine accelerations_lanes

    pure subroutine linearise(self, q, analytic)
        !! \(M = m\ell^2\), \(K = \pm mg\ell\): hanging, or upside down.
        class(pendulum_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof)
        type(linearised_t), intent(out) :: analytic
        real(dp) :: orientation

        associate (m => self%m, l => self%l, g => self%g)
            orientation = sign(1.0_dp, cos(q(1)))
            analytic%mass = reshape([m*l**2], [1, 1])
            analytic%stiffness = reshape([orientation*m*g*l], [1, 1])
            analytic%omega2 = [orientation*g/l]
            if (orientation < 0.0_dp) return
            analytic%root = reshape([sqrt(m*g*l)], [1, 1])
            analytic%inverse = reshape([1.0_dp/(sqrt(m)*l)], [1, 1])
        end associate
    end subroutine linearise

    pure subroutine newton(self, t, x, u, force, constraint_residual)
        !! Gravity; friction, whose torque \(-b\dot\theta\) is a force \(-b\dot\theta/\ell\)
        !! across the rod; the rod, \((\ell^2 - x^2 - y^2)/2\ell = 0\).
        class(pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)

        force = 0.0_dp
        force(2) = -self%m*self%g
        if (self%nonconservative) force(:2) = force(:2) - self%b/self%l**4 &
            *(x(1)%re*u(2)%re - x(2)%re*u(1)%re)*[-x(2)%re, x(1)%re]
        constraint_residual(1) = 0.5_dp/self%l*(self%l**2 - dot_product(x, x))
    end subroutine newton
end module lagrangia_pendulum
