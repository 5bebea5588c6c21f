module lagrangia_rotating_hoop
    !! A bead on a vertical hoop that is turned about its vertical diameter at a constant rate.
    !!
    !! Source: Hamilton's Principle, where the notes define the concept only: a constraint that
    !! contains the time is rheonomic. Beyond \(\omega^2 = g/R\) the bottom is unstable and the
    !! bead finds two tilted equilibria, \(\cos\theta_* = g/(\omega^2R)\).
    use lagrangia_description, only: coordinate, description_t, figure_length, formula_length, &
                                     frequency_t, mass_point, nonnegative, positive, quantity, &
                                     real_number
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
    public :: rotating_hoop_t

    type, extends(system_t) :: rotating_hoop_t
        !! The coordinate is \(\theta\), rad, from the downward vertical.
        real(dp) :: m = 1.0_dp      !! kg
        real(dp) :: r = 1.0_dp      !! m
        real(dp) :: omega = 5.0_dp  !! rad s^-1
        real(dp) :: g = 9.81_dp     !! m s^-2
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: lagrangian
        procedure :: energy
        procedure :: linearise
        procedure :: quantity => energy_or_torque
        procedure :: positions
        procedure :: newton
        procedure :: closed_form
    end type rotating_hoop_t

    interface
        module subroutine closed_form(self, t0, q0, v0, reference)
            !! See `system_t`; in `rotating_hoop_reference`.
            implicit none (type, external)
            class(rotating_hoop_t), intent(in) :: self
            real(dp), intent(in) :: t0, q0(:), v0(:)
            class(reference_t), allocatable, intent(out) :: reference
        end subroutine closed_form
    end interface

contains

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(rotating_hoop_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "rotating_hoop"
        d%title = "a bead on a vertical hoop that turns at a constant rate"
        d%coordinates = [coordinate("theta", "rad", "angle of the bead from the lowest point")]
        d%parameters = [positive("m", "kg", "mass of the bead", self%m), &
                        positive("r", "m", "radius of the hoop", self%r), &
                        real_number("omega", "rad/s", "rate at which the hoop is turned", &
                                    self%omega), &
                        nonnegative("g", "m/s^2", "gravity", self%g)]
        d%energy_scale = self%m*self%r*(self%g + self%omega**2*self%r)
        d%quantities = [ &
            quantity("mechanical_energy", "J", "of the bead", "T + V"), &
            quantity("L_z", "kg m^2/s", "angular momentum about the vertical", &
                     "m r^2 omega sin(theta)^2"), &
            quantity("torque", "N m", "what keeps the hoop turning", &
                     "2 m r^2 omega theta_dot sin(theta) cos(theta)"), &
            quantity("hoop_force", "N", "towards the centre", &
                     "m (r theta_dot^2 + r omega^2 sin(theta)^2 + g cos(theta))")]
        if (abs(self%omega) <= 0.0_dp) then
            d%quantities(1)%conserved = .true.
            d%quantities(1)%scale = d%energy_scale
        end if
        d%points = [mass_point("bead", self%m, "m", "r sin(theta) cos(omega t)", &
                               "r sin(theta) sin(omega t)", "- r cos(theta)")]
        d%reactions = [ &
            quantity("side_force", "N", "across the hoop", &
                     "y_bead cos(omega t) - x_bead sin(omega t)"), &
            quantity("hoop_force", "N", "to its centre", &
                     "(r^2 - x_bead^2 - y_bead^2 - z_bead^2)/(2 r)")]
        d%dimensions = 3
        d%kinetic_energy = "m/2 r^2 (theta_dot^2 + omega^2 sin(theta)^2)"
        d%potential_energy = "- m g r cos(theta)"
        d%lagrangian = "m/2 r^2 (theta_dot^2 + omega^2 sin(theta)^2) + m g r cos(theta)"
        d%energy = "m/2 r^2 (theta_dot^2 - omega^2 sin(theta)^2) - m g r cos(theta)"
        d%equations = [character(formula_length) :: &
            "theta_ddot = sin(theta) (omega^2 cos(theta) - g/r)"]
        d%frequencies = [frequency_t("Omega^2 = g/r - omega^2", "theta = 0"), &
                         frequency_t("Omega^2 = - g/r - omega^2", "theta = pi")]
        if (self%omega**2*self%r > self%g) d%frequencies = [d%frequencies, &
            frequency_t("Omega^2 = omega^2 - g^2/(omega r)^2", "cos(theta) = g/(omega^2 r)")]
        d%constraint = "holonomic, rheonomic"
        if (abs(self%omega) <= 0.0_dp) d%constraint = "holonomic, scleronomic"
        d%constraint_equations = [character(len(d%title)) :: &
            "x_bead sin(omega t) - y_bead cos(omega t) = 0", &
            "x_bead^2 + y_bead^2 + z_bead^2 = r^2"]
        d%notes = [character(len(d%title)) :: &
            "The notes only define the concept: a constraint containing the time is rheonomic.", &
            "L has no t, so h = theta_dot dL/dtheta_dot - L is conserved; "// &
            "while it turns, T + V is not.", &
            "Power of the drive: d(T + V)/dt = omega torque, torque = dL_z/dt.", &
            "At the bottom it is stable while omega^2 < g/r, at the top never. Faster, it "// &
            "stands tilted."]
        d%figure = [character(figure_length) :: "axis (0, 0, - 1.3 r) (0, 0, 1.3 r)", &
                    "circle origin (r cos(omega t), r sin(omega t), 0) (0, 0, r)", "ball bead"]
        d%source = "Hamilton's Principle: rheonomic constraints (the notes define the concept only)"
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! In this order: m, r, omega, g.
        class(rotating_hoop_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call check_parameters(self, values, error)
        if (allocated(error)) return
        self%ndof = 1
        self%velocity_forces = .false.
        self%m = values(1)
        self%r = values(2)
        self%omega = values(3)
        self%g = values(4)
        self%cyclic = merge(0, 1, max(abs(self%omega), self%g) > 0.0_dp)
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ \ddot\theta = \sin\theta\,(\omega^2\cos\theta - g/R) $$
        class(rotating_hoop_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a(1) = sin(q(1))*(self%omega**2*cos(q(1)) - self%g/self%r)
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L = \tfrac12 mR^2(\dot\theta^2 + \omega^2\sin^2\theta) + mgR\cos\theta $$
        class(rotating_hoop_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        associate (m => self%m, r => self%r, omega => self%omega, g => self%g)
            l = 0.5_dp*m*r**2*(v(1)**2 + omega**2*sin(q(1))**2) + m*g*r*cos(q(1))
        end associate
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! $$ h = \tfrac12 mR^2(\dot\theta^2 - \omega^2\sin^2\theta) - mgR\cos\theta $$
        !! Not \(T + V\): the second term is kinetic.
        class(rotating_hoop_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        associate (m => self%m, r => self%r, omega => self%omega, g => self%g)
            e = 0.5_dp*m*r**2*(v(1)**2 - omega**2*sin(q(1))**2) - m*g*r*cos(q(1))
        end associate
    end function energy

    pure function energy_or_torque(self, i, t, q, v) result(value)
        !! (1) \(T + V\). (2) angular momentum. (3) torque of the drive. (4) force of the hoop in
        !! its own plane.
        class(rotating_hoop_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value, s, c

        s = sin(q(1))
        c = cos(q(1))
        associate (m => self%m, r => self%r, omega => self%omega, g => self%g, theta_dot => v(1))
            select case (i)
            case (1)
                value = 0.5_dp*m*r**2*(theta_dot**2 + omega**2*s**2) - m*g*r*c
            case (2)
                value = m*r**2*omega*s**2
            case (3)
                value = 2.0_dp*m*r**2*omega*theta_dot*s*c
            case default
                value = m*(r*theta_dot**2 + r*omega**2*s**2 + g*c)
            end select
        end associate
    end function energy_or_torque

    pure subroutine positions(self, t, q, r)
        !! The bead, \(R\,(\sin\theta\cos\omega t, \sin\theta\sin\omega t, -\cos\theta)\), z up.
        class(rotating_hoop_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        r(1, 1) = self%r*sin(q(1))*cos(self%omega*t)
        r(2, 1) = self%r*sin(q(1))*sin(self%omega*t)
        r(3, 1) = -self%r*cos(q(1))
    end subroutine positions

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! `accelerations`, in all lanes at once.
        class(rotating_hoop_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)
        real(dp) :: s(lanes), c(lanes)

        call sine_cosine(q(:, 1), s, c)
        a(:, 1) = s*(self%omega**2*c - self%g/self%r)
    end subroutine accelerations_lanes

    pure subroutine linearise(self, q, analytic)
        !! \(M = mr^2\); \(\Omega^2 = g/r - \omega^2\) at the bottom, \(-g/r - \omega^2\) at the
        !! top, \(\omega^2 - g^2/(\omega r)^2\) tilted: where \(\cos\theta = g/(\omega^2 r)\).
        class(rotating_hoop_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof)
        type(linearised_t), intent(out) :: analytic
        real(dp) :: w2

        associate (m => self%m, r => self%r, g => self%g, w => self%omega)
            if (abs(sin(q(1))) < 1e-6_dp) then
                w2 = sign(1.0_dp, cos(q(1)))*g/r - w**2
            else
                w2 = (w - g/(w*r))*(w + g/(w*r))
            end if
            analytic%mass = reshape([m*r**2], [1, 1])
            analytic%stiffness = reshape([m*r**2*w2], [1, 1])
            analytic%omega2 = [w2]
            if (w**2*r > g) analytic%elsewhere = [acos(g/(w**2*r))]
        end associate
    end subroutine linearise

    pure subroutine newton(self, t, x, u, force, constraint_residual)
        !! Gravity; the hoop's plane, which turns; the hoop.
        class(rotating_hoop_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)

        force = 0.0_dp
        force(3) = -self%m*self%g
        constraint_residual(1) = x(2)*cos(self%omega*t) - x(1)*sin(self%omega*t)
        constraint_residual(2) = 0.5_dp/self%r*(self%r**2 - dot_product(x, x))
    end subroutine newton
end module lagrangia_rotating_hoop
