module lagrangia_wedge
    !! A block that slides without friction down a wedge, which slides on a horizontal plane.
    !!
    !! Source: Hamilton's Principle, case II. The notes end with \(mg\sin\alpha =
    !! M(\ddot q_1 + \ddot q_2\cos\alpha)\), where it must be the mass of the block, \(m\): with
    !! \(M\) the acceleration is off by \(m/M\) and contradicts the \(\ddot q_1\) they state.
    use lagrangia_description, only: between, conserved, coordinate, description_t, figure_length, &
                                     formula_length, letter_t, mass_point, nonnegative, positive, &
                                     quantity
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t, operator(*), operator(**), operator(+), operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_linearised, only: linearised_t
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: check_parameters, lanes, system_t
    implicit none (type, external)
    private
    public :: wedge_t

    real(dp), parameter :: right_angle = acos(0.0_dp)  !! rad

    type, extends(system_t) :: wedge_t
        !! The coordinates are \(q_1\), m, of the block down the incline; \(q_2\), m, of the wedge.
        real(dp) :: m_block = 1.0_dp             !! kg
        real(dp) :: m_wedge = 2.0_dp             !! kg
        real(dp) :: alpha = right_angle/3.0_dp   !! of the incline to the horizontal, rad
        real(dp) :: g = 9.81_dp                  !! m s^-2
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: lagrangian
        procedure :: energy
        procedure :: linearise
        procedure :: quantity => momentum_or_force
        procedure :: positions
        procedure :: newton
        procedure :: closed_form
    end type wedge_t

    interface
        module subroutine closed_form(self, t0, q0, v0, reference)
            !! See `system_t`; in `wedge_reference`.
            implicit none (type, external)
            class(wedge_t), intent(in) :: self
            real(dp), intent(in) :: t0, q0(:), v0(:)
            class(reference_t), allocatable, intent(out) :: reference
        end subroutine closed_form
    end interface

contains

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(wedge_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "wedge"
        d%title = "a block sliding down a wedge that slides on a plane"
        d%coordinates = [coordinate("q1", "m", "position of the block, down the incline"), &
                         coordinate("q2", "m", "position of the wedge, horizontal")]
        d%parameters = [positive("m_block", "kg", "mass of the block, m", self%m_block), &
                        positive("m_wedge", "kg", "mass of the wedge, M", self%m_wedge), &
                        between("alpha", "rad", "angle of the incline", self%alpha, &
                                0.0_dp, right_angle), &
                        nonnegative("g", "m/s^2", "gravity", self%g)]
        d%letters = [letter_t("m", "m_block"), letter_t("M", "m_wedge")]
        d%quantities = [ &
            conserved("p_q2", "kg m/s", "horizontal momentum, q2 is cyclic", 0.0_dp, &
                      "M q2_dot + m (q2_dot + q1_dot cos(alpha))"), &
            conserved("x_com", "m", "start of the centre of mass", 0.0_dp, &
                      "q2 + m/(M + m) q1 cos(alpha) - p_q2 t/(M + m)"), &
            quantity("p_q1", "kg m/s", "momentum along the incline", &
                     "m (q1_dot + q2_dot cos(alpha))"), &
            quantity("normal_force", "N", "of the wedge on the block", &
                     "m M g cos(alpha)/(M + m sin(alpha)^2)")]
        if (level(self)) d%quantities(3) = &
            conserved("p_q1", "kg m/s", "momentum along the incline, q1 is cyclic if "// &
                      "g sin(alpha) = 0", 0.0_dp, "m (q1_dot + q2_dot cos(alpha))")
        d%points = [mass_point("block", self%m_block, "m", "q2 + q1 cos(alpha)", &
                               "- q1 sin(alpha)"), &
                    mass_point("wedge", self%m_wedge, "M", "q2")]
        d%reactions = [ &
            quantity("plane_force", "N", "of the plane on the wedge, upwards", "y_wedge"), &
            quantity("normal_force", "N", "of the wedge on the block", &
                     "(x_block - x_wedge) sin(alpha) + (y_block - y_wedge) cos(alpha)")]
        d%kinetic_energy = "M/2 q2_dot^2 + m/2 (q1_dot^2 + q2_dot^2 "// &
                           "+ 2 q1_dot q2_dot cos(alpha))"
        d%potential_energy = "- m g q1 sin(alpha)"
        d%lagrangian = "(M + m)/2 q2_dot^2 + m/2 (q1_dot^2 + 2 q1_dot q2_dot cos(alpha)) "// &
                       "+ m g q1 sin(alpha)"
        d%energy = "(M + m)/2 q2_dot^2 + m/2 (q1_dot^2 + 2 q1_dot q2_dot cos(alpha)) "// &
                   "- m g q1 sin(alpha)"
        d%equations = [character(formula_length) :: &
            "m (q1_ddot + q2_ddot cos(alpha)) = m g sin(alpha)", &
            "(M + m) q2_ddot + m q1_ddot cos(alpha) = 0"]
        d%accelerations = [character(formula_length) :: &
            "q1_ddot = (M + m) g sin(alpha)/(M + m sin(alpha)^2)", &
            "q2_ddot = - m g sin(alpha) cos(alpha)/(M + m sin(alpha)^2)"]
        d%motion = [character(formula_length) :: &
            "q1 = q1_0 + q1_dot_0 t + (M + m) g sin(alpha)/(2 (M + m sin(alpha)^2)) t^2", &
            "q2 = q2_0 + q2_dot_0 t - m g sin(alpha) cos(alpha)/(2 (M + m sin(alpha)^2)) t^2"]
        d%constraint = "holonomic, scleronomic"
        d%constraint_equations = [character(len(d%title)) :: &
            "(x_block - x_wedge) sin(alpha) + y_block cos(alpha) = 0", "y_wedge = 0"]
        d%notes = [character(len(d%title)) :: &
            "The parameters are called m_block and m_wedge, as keys do not tell m from M.", &
            "The notes end with m g sin(alpha) = M (q1_ddot + q2_ddot cos(alpha)): a slip, the "// &
            "mass is m.", &
            "The accelerations are constant: K = 0, no oscillation.", &
            "M -> infinity: q1_ddot -> g sin(alpha); alpha = pi/2: free fall beside a wedge "// &
            "that stays."]
        d%figure = [character(figure_length) :: "let a = q1_min - size/6", &
            "let b = q1_max + size/6", &
            "ground (0, - b sin(alpha)) (1, - b sin(alpha))", &
            "polygon (q2 + a cos(alpha), - a sin(alpha)) (q2 + b cos(alpha), - b sin(alpha)) "// &
            "(q2 + a cos(alpha), - b sin(alpha))", &
            "box (x_block + size/20 sin(alpha), y_block + size/20 cos(alpha)) "// &
            "(size/7, size/10, - alpha)"]
        d%source = "Hamilton's Principle: case II, a block sliding on a wedge"
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! In this order: m_block, m_wedge, alpha, g.
        class(wedge_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call check_parameters(self, values, error)
        if (allocated(error)) return
        self%ndof = 2
        self%velocity_forces = .false.
        self%cyclic = 2
        self%m_block = values(1)
        self%m_wedge = values(2)
        self%alpha = values(3)
        self%g = values(4)
    end subroutine configure

    pure function level(self)
        !! Gravity has no part along the incline.
        class(wedge_t), intent(in) :: self
        logical :: level

        level = min(self%g, self%alpha) <= 0.0_dp
    end function level

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ \ddot q_1 = \frac{(M+m)\,g\sin\alpha}{M + m\sin^2\alpha},\quad
        !!    \ddot q_2 = -\frac{m g\sin\alpha\cos\alpha}{M + m\sin^2\alpha} $$
        !! where the denominator is at least \(M > 0\).
        class(wedge_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        real(dp) :: s, c, d

        associate (m => self%m_block, big => self%m_wedge, g => self%g)
            s = sin(self%alpha)
            c = cos(self%alpha)
            d = big + m*s**2
            a(1) = (big + m)*g*s/d
            a(2) = -m*g*s*c/d
        end associate
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L = \tfrac12(M+m)\dot q_2^2
        !!      + \tfrac12 m(\dot q_1^2 + 2\dot q_1\dot q_2\cos\alpha) + m g q_1\sin\alpha $$
        class(wedge_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        associate (m => self%m_block, big => self%m_wedge, g => self%g)
            l = 0.5_dp*(big + m)*v(2)**2 &
                + 0.5_dp*m*(v(1)**2 + 2.0_dp*cos(self%alpha)*v(1)*v(2)) &
                + m*g*sin(self%alpha)*q(1)
        end associate
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! $$ E = \tfrac12(M+m)\dot q_2^2
        !!      + \tfrac12 m(\dot q_1^2 + 2\dot q_1\dot q_2\cos\alpha) - m g q_1\sin\alpha $$
        class(wedge_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        associate (m => self%m_block, big => self%m_wedge, g => self%g)
            e = 0.5_dp*(big + m)*v(2)**2 &
                + 0.5_dp*m*(v(1)**2 + 2.0_dp*v(1)*v(2)*cos(self%alpha)) &
                - m*g*q(1)*sin(self%alpha)
        end associate
    end function energy

    pure function momentum_or_force(self, i, t, q, v) result(value)
        !! (1) horizontal momentum. (2) the centre of mass at \(t = 0\). (3) momentum along
        !! the incline. (4) the force between wedge and block, from \(M\ddot q_2 = -N\sin\alpha\).
        class(wedge_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value, p, c

        associate (m => self%m_block, big => self%m_wedge, g => self%g)
            c = cos(self%alpha)
            p = big*v(2) + m*(v(2) + v(1)*c)
            select case (i)
            case (1)
                value = p
            case (2)
                value = q(2) + m/(big + m)*q(1)*c - p*t/(big + m)
            case (3)
                value = m*(v(1) + v(2)*c)
            case default
                value = m*big*g*c/(big + m*sin(self%alpha)**2)
            end select
        end associate
    end function momentum_or_force

    pure subroutine positions(self, t, q, r)
        !! Block \((q_2 + q_1\cos\alpha, -q_1\sin\alpha)\), wedge \((q_2, 0)\).
        class(wedge_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        r = hyperdual_t()
        r(1, 1) = q(2) + cos(self%alpha)*q(1)
        r(2, 1) = -sin(self%alpha)*q(1)
        r(1, 2) = q(2)
    end subroutine positions

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! `accelerations`, in all lanes at once.
        class(wedge_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)
        real(dp) :: s, c, d

        associate (m => self%m_block, big => self%m_wedge, g => self%g)
            s = sin(self%alpha)
            c = cos(self%alpha)
            d = big + m*s**2
            a(:, 1) = (big + m)*g*s/d
            a(:, 2) = -m*g*s*c/d
        end associate
    end subroutine accelerations_lanes

    pure subroutine newton(self, t, x, u, force, constraint_residual)
        !! Gravity on both; the plane under the wedge; the incline under the block.
        class(wedge_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)

        force = 0.0_dp
        force(2) = -self%m_block*self%g
        force(5) = -self%m_wedge*self%g
        constraint_residual(1) = x(5)
        constraint_residual(2) = sin(self%alpha)*(x(1) - x(4)) + cos(self%alpha)*(x(2) - x(5))
    end subroutine newton

    pure subroutine linearise(self, q, analytic)
        !! \(M = (m, m\cos\alpha; m\cos\alpha, M + m)\), \(K = 0\): with \(\alpha = 0\) or without
        !! gravity it stays anywhere.
        class(wedge_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof)
        type(linearised_t), intent(out) :: analytic
        real(dp) :: mixed

        mixed = self%m_block*cos(self%alpha)
        analytic%mass = reshape([self%m_block, mixed, mixed, self%m_wedge + self%m_block], [2, 2])
        analytic%stiffness = reshape([0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], [2, 2])
        analytic%omega2 = [0.0_dp, 0.0_dp]
    end subroutine linearise
end module lagrangia_wedge
