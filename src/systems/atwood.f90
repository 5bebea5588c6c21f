module lagrangia_atwood
    !! Atwood's machine: two masses on a string over a pulley, whose support may accelerate.
    !!
    !! Source: Hamilton's Principle, case I. The notes write \((m_1+m_2)\,d\dot x^2/dt^2\) for
    !! \((m_1+m_2)\,\ddot x\). The pulley's inertia \(I\) and the support's upward acceleration
    !! \(a_s\), both zero in the notes, are added: \(a_s\) makes the constraint rheonomic.
    use lagrangia_description, only: conserved, coordinate, description_t, figure_length, &
                                     formula_length, letter_t, mass_point, nonnegative, positive, &
                                     quantity, real_number
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t, operator(*), operator(**), operator(+), operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_linearised, only: linearised_t
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: check_parameters, lanes, system_t
    implicit none (type, external)
    private
    public :: atwood_t

    type, extends(system_t) :: atwood_t
        !! The coordinate is \(x\), m, of \(m_1\) down from the pulley; zero where both are level.
        real(dp) :: m1 = 3.0_dp                    !! kg
        real(dp) :: m2 = 2.0_dp                    !! kg
        real(dp) :: g = 9.81_dp                    !! m s^-2
        real(dp) :: pulley_inertia = 0.0_dp        !! kg m^2
        real(dp) :: radius = 0.1_dp                !! of the pulley, m
        real(dp) :: support_acceleration = 0.0_dp  !! upwards, m s^-2
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: lagrangian
        procedure :: energy
        procedure :: linearise
        procedure :: quantity => energy_or_force
        procedure :: positions
        procedure :: newton
        procedure :: angles
        procedure :: closed_form
    end type atwood_t

    interface
        module subroutine closed_form(self, t0, q0, v0, reference)
            !! See `system_t`; in `atwood_reference`.
            implicit none (type, external)
            class(atwood_t), intent(in) :: self
            real(dp), intent(in) :: t0, q0(:), v0(:)
            class(reference_t), allocatable, intent(out) :: reference
        end subroutine closed_form
    end interface

contains

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(atwood_t), intent(in) :: self
        type(description_t), intent(out) :: d
        character(:), allocatable :: pulley, gravity, lift, up

        d%name = "atwood"
        d%title = "two masses on a string over a pulley"
        d%coordinates = [coordinate("x", "m", "position of m1 downwards, 0 where m2 is level")]
        d%parameters = [ &
            positive("m1", "kg", "mass that goes down with x", self%m1), &
            positive("m2", "kg", "mass that goes up with x", self%m2), &
            nonnegative("g", "m/s^2", "gravity", self%g), &
            nonnegative("pulley_inertia", "kg m^2", "moment of inertia of the pulley, I", &
                        self%pulley_inertia), &
            positive("radius", "m", "radius of the pulley, R", self%radius), &
            real_number("support_acceleration", "m/s^2", &
                        "upward acceleration of the support, a_s", &
                        self%support_acceleration)]
        pulley = ""
        if (self%pulley_inertia > 0.0_dp) pulley = " + I/R^2"
        gravity = "g"
        if (self%time_dependent) gravity = "(g + a_s)"
        associate (total => "(m1 + m2"//pulley//")")
            d%letters = [letter_t("I", "pulley_inertia"), letter_t("R", "radius"), &
                             letter_t("a_s", "support_acceleration")]
            d%quantities = [ &
                conserved("energy_support", "J", "energy in the support's frame", 0.0_dp, &
                          total//"/2 x_dot^2 - (m1 - m2) "//gravity//" x"), &
                quantity("p_x", "kg m/s", "momentum of x", total//" x_dot"), &
                quantity("total_energy", "J", "in the inertial frame, to which the support "// &
                         "does work", "T + V"), &
                quantity("tension1", "N", "string at m1", &
                         "m1 "//gravity//" (2 m2"//pulley//")/"//total), &
                quantity("tension2", "N", "string at m2", &
                         "m2 "//gravity//" (2 m1"//pulley//")/"//total)]
            if (pulley == "") d%quantities(4:5)%formula = "2 m1 m2 "//gravity//"/(m1 + m2)"
            if (.not. self%time_dependent) d%quantities(3) = &
                conserved("total_energy", "J", "in the inertial frame", 0.0_dp, "T + V")
            if (free(self)) d%quantities(2) = &
                conserved("p_x", "kg m/s", "momentum of x, cyclic if (m1 - m2) g = 0", 0.0_dp, &
                          total//" x_dot")
            d%kinetic_energy = "(m1 + m2"//pulley//")/2 x_dot^2"
            d%potential_energy = "- (m1 - m2) g x"
            d%lagrangian = total//"/2 x_dot^2 + (m1 - m2) g x"
            d%energy = total//"/2 x_dot^2 - (m1 - m2) g x"
            d%constraint = "holonomic, scleronomic"
            d%constraint_equations = [character(len(d%title)) :: "y_m1 + y_m2 = 0"]
            if (self%time_dependent) then
                d%quantities(2)%formula = total//" x_dot - (m1 - m2) a_s t"
                d%kinetic_energy = "m1/2 (a_s t - x_dot)^2 + m2/2 (a_s t + x_dot)^2"
                if (pulley /= "") d%kinetic_energy = d%kinetic_energy//" + I/2 (x_dot/R)^2"
                d%potential_energy = "m1 g (a_s/2 t^2 - x) + m2 g (a_s/2 t^2 + x)"
                d%lagrangian = total//"/2 x_dot^2 + (m1 - m2)(g x - a_s t x_dot) "// &
                               "+ (m1 + m2)/2 (a_s - g) a_s t^2"
                d%energy = total//"/2 x_dot^2 - (m1 - m2) g x - (m1 + m2)/2 (a_s - g) a_s t^2"
                d%constraint = "holonomic, rheonomic"
                d%constraint_equations = [character(len(d%title)) :: "y_m1 + y_m2 = a_s t^2"]
            end if
            d%equations = [character(formula_length) :: &
                total//" x_ddot = (m1 - m2) "//gravity]
            d%motion = [character(formula_length) :: &
                "x = x_0 + x_dot_0 t + (m1 - m2) "//gravity//"/(2 "//total//") t^2"]
        end associate
        lift = ""
        if (self%time_dependent) lift = "a_s/2 t^2"
        up = trim(merge("+", " ", self%time_dependent))
        d%points = [mass_point("m1", self%m1, "m1", "- R", lift//" - x"), &
                    mass_point("m2", self%m2, "m2", "R", lift//" "//up//" x")]
        d%rotors = [mass_point("pulley", self%pulley_inertia, merge("I", "0", pulley /= ""), "x/R")]
        d%reactions = [ &
            quantity("tension1", "N", "of the string at m1", "y_m1 - a_s/2 t^2 + R phi_pulley"), &
            quantity("tension2", "N", "of the string at m2", "y_m2 - a_s/2 t^2 - R phi_pulley")]
        d%notes = [character(len(d%title)) :: &
            "The notes' machine: a_s = 0, I = 0. The scan has (m1 + m2) d(x_dot^2)/dt^2: read "// &
            "(m1 + m2) x_ddot.", &
            "y_m1, y_m2: heights above where both are level at t = 0. The notes' x + y + pi R "// &
            "= l counts", &
            "both down from the axle, l the rope's length: its x and y are larger by constants.", &
            "A support that accelerates (a_s) makes it rheonomic: L contains t, the energy "// &
            "function is not T + V.", &
            "Effective gravity g + a_s: the L of a fixed support with g + a_s for g differs by "// &
            "dF/dt, F = (m1 - m2) a_s t x + f(t).", &
            "A string only pulls: for a_s < -g it goes slack, and this is no longer the machine.", &
            "A slow way to measure g: choose m1 close to m2."]
        call draw_machine(self, d, lift)
        d%source = "Hamilton's Principle: case I, Atwood's machine"
    end subroutine describe

    pure subroutine draw_machine(self, d, lift)
        !! With ropes at a distance D of the axle that can be seen, the weights' sides as the cube
        !! roots of their masses; s is how far the support has gone.
        class(atwood_t), intent(in) :: self
        type(description_t), intent(inout) :: d
        character(*), intent(in) :: lift  !! the formula of s; "": 0

        d%figure = [character(figure_length) :: "let D = R + size/12", &
            "let s = 0 "//trim(merge("+", " ", lift /= ""))//" "//lift, &
            "let b = (x_max - x_min + |x_max + x_min|)/2", "let h = s + b + 3 D", &
            "let w1 = 1.2 D (m1/(m1 + m2))^(1/3)", "let w2 = 1.2 D (m2/(m1 + m2))^(1/3)", &
            "rod (0, h) (0, h + 1.7 D)", "rope (- D, s - x) (- D, h)", "rope (D, s + x) (D, h)", &
            "wheel (0, h) (D cos(x/D), h + D sin(x/D)) (- D sin(x/D), h + D cos(x/D))", &
            "box (- D, s - x - w1/2) (w1, w1, 0)", "box (D, s + x - w2/2) (w2, w2, 0)"]
        if (self%time_dependent) then
            d%figure = [character(figure_length) :: d%figure, "frame (- 3 D, h + 1.7 D) "// &
                "(3 D, h + 1.7 D) (3 D, s - b - 3 D) (- 3 D, s - b - 3 D)", &
                "ground (0, - b - 3 D) (1, - b - 3 D)"]
        else
            d%figure = [character(figure_length) :: d%figure, &
                "ground (0, h + 1.7 D) (- 1, h + 1.7 D)"]
        end if
    end subroutine draw_machine

    pure subroutine configure(self, values, error)
        !! In this order: m1, m2, g, pulley_inertia, radius, support_acceleration.
        class(atwood_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call check_parameters(self, values, error)
        if (allocated(error)) return
        self%ndof = 1
        self%velocity_forces = .false.
        self%m1 = values(1)
        self%m2 = values(2)
        self%g = values(3)
        self%pulley_inertia = values(4)
        self%radius = values(5)
        self%support_acceleration = values(6)
        self%time_dependent = abs(self%support_acceleration) > 0.0_dp
        self%cyclic = merge(1, 0, free(self))
    end subroutine configure

    pure function free(self)
        !! Gravity does not move the machine: \(x\) is cyclic.
        class(atwood_t), intent(in) :: self
        logical :: free

        free = abs(self%m1 - self%m2)*self%g <= 0.0_dp
    end function free

    pure function inertia(self) result(m)
        !! \(m_1 + m_2 + I/R^2 > 0\), kg.
        class(atwood_t), intent(in) :: self
        real(dp) :: m

        m = self%m1 + self%m2 + self%pulley_inertia/self%radius**2
    end function inertia

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ \ddot x = \frac{m_1 - m_2}{m_1 + m_2 + I/R^2}\,(g + a_s) $$
        class(atwood_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a(1) = (self%m1 - self%m2)*(self%g + self%support_acceleration)/inertia(self)
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! In the inertial frame, where the pulley has risen \(\tfrac12 a_s t^2\) since \(t = 0\):
        !! $$ L = \tfrac12 m_1(a_s t - \dot x)^2 + \tfrac12 m_2(a_s t + \dot x)^2
        !!      + \tfrac12\frac{I}{R^2}\dot x^2 + m_1 g(x - \tfrac12 a_s t^2)
        !!      - m_2 g(x + \tfrac12 a_s t^2) $$
        class(atwood_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        associate (m1 => self%m1, m2 => self%m2, g => self%g, as => self%support_acceleration)
            l = 0.5_dp*m1*(as*t - v(1))**2 + 0.5_dp*m2*(as*t + v(1))**2 &
                + 0.5_dp*self%pulley_inertia/self%radius**2*v(1)**2 &
                + m1*g*(q(1) - 0.5_dp*as*t**2) - m2*g*(q(1) + 0.5_dp*as*t**2)
        end associate
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! $$ h = \tfrac12\Bigl(m_1+m_2+\frac{I}{R^2}\Bigr)\dot x^2 - (m_1-m_2)gx
        !!      - \tfrac12(m_1+m_2)(a_s t)^2 + \tfrac12(m_1+m_2)g a_s t^2 $$
        class(atwood_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        associate (m1 => self%m1, m2 => self%m2, g => self%g, as => self%support_acceleration)
            e = 0.5_dp*inertia(self)*v(1)**2 - (m1 - m2)*g*q(1) &
                + 0.5_dp*(m1 + m2)*(g - as)*as*t**2
        end associate
    end function energy

    pure function energy_or_force(self, i, t, q, v) result(value)
        !! (1) energy in the support's frame. (2) momentum of \(x\). (3) \(T + V\) in the inertial
        !! frame. (4, 5) tension of the string at \(m_1\) and at \(m_2\), equal if \(I = 0\).
        class(atwood_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value, rim

        associate (m1 => self%m1, m2 => self%m2, g => self%g, as => self%support_acceleration)
            rim = self%pulley_inertia/self%radius**2
            select case (i)
            case (1)
                value = 0.5_dp*inertia(self)*v(1)**2 - (m1 - m2)*(g + as)*q(1)
            case (2)
                value = inertia(self)*v(1) - (m1 - m2)*as*t
            case (3)
                value = 0.5_dp*m1*(as*t - v(1))**2 + 0.5_dp*m2*(as*t + v(1))**2 &
                        + 0.5_dp*rim*v(1)**2 - (m1 - m2)*g*q(1) + 0.5_dp*(m1 + m2)*g*as*t**2
            case (4)
                value = m1*(g + as)*(2.0_dp*m2 + rim)/inertia(self)
            case default
                value = m2*(g + as)*(2.0_dp*m1 + rim)/inertia(self)
            end select
        end associate
    end function energy_or_force

    pure subroutine positions(self, t, q, r)
        !! \(m_1\) at \((-R, \tfrac12 a_s t^2 - x)\), \(m_2\) at \((R, \tfrac12 a_s t^2 + x)\).
        class(atwood_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        r = hyperdual_t()
        r(1, 1)%re = -self%radius
        r(2, 1) = 0.5_dp*self%support_acceleration*t**2 - q(1)
        r(1, 2)%re = self%radius
        r(2, 2) = 0.5_dp*self%support_acceleration*t**2 + q(1)
    end subroutine positions

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! `accelerations`, in all lanes at once.
        class(atwood_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)

        a(:, 1) = (self%m1 - self%m2)*(self%g + self%support_acceleration)/inertia(self)
    end subroutine accelerations_lanes

    pure subroutine angles(self, t, q, phi)
        !! The pulley turns with the string, \(\varphi = x/R\).
        class(atwood_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(:)
        type(hyperdual_t), intent(out) :: phi(:)

        phi(1) = (1.0_dp/self%radius)*q(1)
    end subroutine angles

    pure subroutine newton(self, t, x, u, force, constraint_residual)
        !! Gravity on both masses; each string from the pulley with its axle at \(a_s t^2/2\).
        class(atwood_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)
        type(hyperdual_t) :: axle

        force = 0.0_dp
        force(2) = -self%m1*self%g
        force(5) = -self%m2*self%g
        axle = 0.5_dp*self%support_acceleration*t**2
        constraint_residual(1) = x(2) - axle + self%radius*x(7)
        constraint_residual(2) = x(5) - axle - self%radius*x(7)
    end subroutine newton

    pure subroutine linearise(self, q, analytic)
        !! \(M = m_1 + m_2 + I/R^2\), \(K = 0\): balanced, it stays anywhere.
        class(atwood_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof)
        type(linearised_t), intent(out) :: analytic

        analytic%mass = reshape([self%m1 + self%m2 + self%pulley_inertia/self%radius**2], [1, 1])
        analytic%stiffness = reshape([0.0_dp], [1, 1])
        analytic%omega2 = [0.0_dp]
    end subroutine linearise
end module lagrangia_atwood
