module lagrangia_double_pendulum
    !! Two bobs on two rigid rods, the second hanging from the first, in a plane.
    !!
    !! The notes write both constraints as \(f_i = x_i^2 + y_i^2 = \ell_i^2\); this is true for
    !! the first rod only. The second is \((x_2-x_1)^2 + (y_2-y_1)^2 = \ell_2^2\).
    use lagrangia_description, only: conserved, coordinate, description_t, figure_length, &
                                     formula_length, frequency_t, letter_t, mass_point, &
                                     nonnegative, positive, quantity
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: cos, dot_product, hyperdual_t, operator(*), operator(**), &
                                   operator(+), operator(-), sin
    use lagrangia_kinds, only: dp
    use lagrangia_linearised, only: linearised_t
    use lagrangia_sine_cosine, only: sine_cosine, two_sines_cosines
    use lagrangia_system, only: check_parameters, lanes, system_t
    implicit none (type, external)
    private
    public :: double_pendulum_t

    type, extends(system_t) :: double_pendulum_t
        !! The coordinates are \(\theta_1, \theta_2\), rad, both from the downward vertical.
        real(dp) :: m1 = 1.0_dp  !! upper bob, kg
        real(dp) :: m2 = 1.0_dp  !! lower bob, kg
        real(dp) :: l1 = 1.0_dp  !! upper rod, m
        real(dp) :: l2 = 1.0_dp  !! lower rod, m
        real(dp) :: g = 9.81_dp  !! m s^-2
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: lagrangian
        procedure :: energy
        procedure :: linearise
        procedure :: momenta
        procedure :: velocities
        procedure :: forces
        procedure :: quantity => momentum_or_tension
        procedure :: positions
        procedure :: newton
    end type double_pendulum_t

contains

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(double_pendulum_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "double_pendulum"
        d%title = "two rods and two bobs in a plane, chaotic at large amplitude"
        d%coordinates = [ &
            coordinate("theta1", "rad", "angle of the upper rod from the downward vertical"), &
            coordinate("theta2", "rad", "angle of the lower rod from the downward vertical")]
        d%parameters = [positive("m1", "kg", "mass of the upper bob", self%m1), &
                        positive("m2", "kg", "mass of the lower bob", self%m2), &
                        positive("l1", "m", "length of the upper rod", self%l1), &
                        positive("l2", "m", "length of the lower rod", self%l2), &
                        nonnegative("g", "m/s^2", "gravity", self%g)]
        d%energy_scale = self%g*((self%m1 + self%m2)*self%l1 + self%m2*self%l2)
        d%letters = [letter_t("D", "theta1 - theta2")]
        d%quantities = [ &
            quantity("L_z", "kg m^2/s", "angular momentum about the pivot", &
                     "p_theta1 + p_theta2"), &
            quantity("tension1", "N", "force along rod 1", &
                     "m1 (l1 theta1_dot^2 + g cos(theta1)) + tension2 cos(D)"), &
            quantity("tension2", "N", "force along rod 2", &
                     "m1 m2 (l1 theta1_dot^2 cos(D) + l2 theta2_dot^2 + g cos(theta1) cos(D))"// &
                     "/(m1 + m2 sin(D)^2)")]
        if (self%g <= 0.0_dp) d%quantities(1) = &
            conserved("L_z", "kg m^2/s", "angular momentum about the pivot, conserved without "// &
                      "gravity", 0.0_dp, "p_theta1 + p_theta2")
        d%points = [ &
            mass_point("bob1", self%m1, "m1", "l1 sin(theta1)", "- l1 cos(theta1)"), &
            mass_point("bob2", self%m2, "m2", "l1 sin(theta1) + l2 sin(theta2)", &
                       "- l1 cos(theta1) - l2 cos(theta2)")]
        d%reactions = [ &
            quantity("tension1", "N", "of the upper rod", "(l1^2 - x_bob1^2 - y_bob1^2)/(2 l1)"), &
            quantity("tension2", "N", "of the lower rod", &
                     "(l2^2 - (x_bob2 - x_bob1)^2 - (y_bob2 - y_bob1)^2)/(2 l2)")]
        d%kinetic_energy = "(m1 + m2)/2 l1^2 theta1_dot^2 + m2/2 l2^2 theta2_dot^2 "// &
                           "+ m2 l1 l2 theta1_dot theta2_dot cos(D)"
        d%potential_energy = "- (m1 + m2) g l1 cos(theta1) - m2 g l2 cos(theta2)"
        d%lagrangian = d%kinetic_energy// &
                       " + (m1 + m2) g l1 cos(theta1) + m2 g l2 cos(theta2)"
        d%energy = d%kinetic_energy//" - (m1 + m2) g l1 cos(theta1) - m2 g l2 cos(theta2)"
        d%equations = [character(formula_length) :: &
            "(m1 + m2) l1 theta1_ddot + m2 l2 theta2_ddot cos(D) + m2 l2 theta2_dot^2 sin(D) "// &
            "+ (m1 + m2) g sin(theta1) = 0", &
            "l2 theta2_ddot + l1 theta1_ddot cos(D) - l1 theta1_dot^2 sin(D) + g sin(theta2) = 0"]
        d%frequencies = [ &
            both("(m1 + m2)(l1 + l2)", "-", "l1 + l2", "theta1 = 0, theta2 = 0"), &
            both("(m1 + m2)(l2 - l1)", "+", "l1 - l2", "theta1 = 0, theta2 = pi"), &
            both("(m1 + m2)(l1 - l2)", "+", "l1 - l2", "theta1 = pi, theta2 = 0"), &
            both("- (m1 + m2)(l1 + l2)", "-", "l1 + l2", "theta1 = pi, theta2 = pi")]
        d%constraint = "holonomic, scleronomic"
        d%constraint_equations = [character(len(d%title)) :: &
            "x_bob1^2 + y_bob1^2 = l1^2", "(x_bob2 - x_bob1)^2 + (y_bob2 - y_bob1)^2 = l2^2"]
        d%notes = [character(len(d%title)) :: &
            "The notes have x2^2 + y2^2 = l2^2: a slip, the second rod starts at the first bob.", &
            "dx2 = l1 cos(theta1) dtheta1 + l2 cos(theta2) dtheta2, and the same for delta x2.", &
            "Masses and lengths all equal: omega^2 = (2 +- sqrt(2)) g/l."]
        d%figure = [character(figure_length) :: "trail bob2", "pivot origin", "rod origin bob1", &
                    "rod bob1 bob2", "ball bob1", "ball bob2"]
        d%source = "Phys 601, 1 September 2011: double planar pendulum"
    end subroutine describe

    pure function both(sum_of, sign_of, lengths, place) result(frequencies)
        !! The two roots of \(m_1\ell_1\ell_2\omega^4 - (m_1+m_2)g(\pm\ell_2\pm\ell_1)\omega^2
        !! \pm (m_1+m_2)g^2 = 0\), a minus where a rod stands on its head.
        character(*), intent(in) :: sum_of, sign_of, lengths, place
        type(frequency_t) :: frequencies(2)
        character(:), allocatable :: root

        root = " sqrt((m1 + m2)^2 ("//lengths//")^2 "//sign_of//" 4 m1 (m1 + m2) l1 l2))"
        frequencies%equilibrium = place
        frequencies(1)%equation = "omega^2 = g/(2 m1 l1 l2) ("//sum_of//" +"//root
        frequencies(2)%equation = "omega^2 = g/(2 m1 l1 l2) ("//sum_of//" -"//root
    end function both

    pure subroutine configure(self, values, error)
        !! In this order: m1, m2, l1, l2, g.
        class(double_pendulum_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call check_parameters(self, values, error)
        if (allocated(error)) return
        self%ndof = 2
        self%m1 = values(1)
        self%m2 = values(2)
        self%l1 = values(3)
        self%l2 = values(4)
        self%g = values(5)
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! With \(\Delta = \theta_1 - \theta_2\) and \(D = m_1 + m_2\sin^2\Delta \ge m_1 > 0\):
        !! $$ \ell_1 D\,\ddot\theta_1 = -m_1 g\sin\theta_1 - m_2\sin\Delta\,(
        !!    \ell_1\dot\theta_1^2\cos\Delta + \ell_2\dot\theta_2^2 + g\cos\theta_2) $$
        !! $$ \ell_2 D\,\ddot\theta_2 = \sin\Delta\,\big[(m_1+m_2)(\ell_1\dot\theta_1^2
        !!    + g\cos\theta_1) + m_2\ell_2\dot\theta_2^2\cos\Delta\big] $$
        !! In this form nothing of the light bob's weight is lost beside the heavy one's.
        class(double_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        real(dp) :: sine(2), cosine(2), d  ! of Delta and theta1

        call two_sines_cosines(q(1) - q(2), q(1), sine, cosine)
        associate (m1 => self%m1, m2 => self%m2, m => self%m1 + self%m2, &
                   l1 => self%l1, l2 => self%l2, g => self%g, &
                   s => sine(1), c => cosine(1), s1 => sine(2), c1 => cosine(2))
            d = m1 + m2*s**2
            ! cos(theta2) = c1*c + s1*s
            a(1) = (-m1*g*s1 - m2*s*(l1*v(1)**2*c + l2*v(2)**2 + g*(c1*c + s1*s)))/(l1*d)
            a(2) = s*(m*(l1*v(1)**2 + g*c1) + m2*l2*v(2)**2*c)/(l2*d)
        end associate
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L = \tfrac12(m_1+m_2)\ell_1^2\dot\theta_1^2 + \tfrac12 m_2\ell_2^2\dot\theta_2^2
        !!      + m_2\ell_1\ell_2\dot\theta_1\dot\theta_2\cos(\theta_1-\theta_2)
        !!      + (m_1+m_2)g\ell_1\cos\theta_1 + m_2 g\ell_2\cos\theta_2 $$
        class(double_pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        associate (m => self%m1 + self%m2, m2 => self%m2, l1 => self%l1, l2 => self%l2, &
                   g => self%g)
            l = 0.5_dp*m*l1**2*v(1)**2 + 0.5_dp*m2*l2**2*v(2)**2 &
                + m2*l1*l2*v(1)*v(2)*cos(q(1) - q(2)) &
                + m*g*l1*cos(q(1)) + m2*g*l2*cos(q(2))
        end associate
    end function lagrangian

    pure subroutine momenta(self, t, q, v, p)
        !! $$ p_1 = (m_1+m_2)\ell_1^2\dot\theta_1 + m_2\ell_1\ell_2\dot\theta_2\cos\Delta,\quad
        !!    p_2 = m_2\ell_2^2\dot\theta_2 + m_2\ell_1\ell_2\dot\theta_1\cos\Delta $$
        class(double_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: p(self%ndof)
        real(dp) :: c

        associate (m => self%m1 + self%m2, m2 => self%m2, l1 => self%l1, l2 => self%l2)
            c = cos(q(1) - q(2))
            p(1) = l1*(m*l1*v(1) + m2*l2*v(2)*c)
            p(2) = m2*l2*(l2*v(2) + l1*v(1)*c)
        end associate
    end subroutine momenta

    pure subroutine velocities(self, t, q, p, v)
        !! \(M^{-1}p\), with \(\det M = m_2\ell_1^2\ell_2^2\,(m_1 + m_2\sin^2\Delta) > 0\).
        class(double_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), p(self%ndof)
        real(dp), intent(out) :: v(self%ndof)
        real(dp) :: c, d, u1, u2

        associate (m1 => self%m1, m2 => self%m2, l1 => self%l1, l2 => self%l2)
            c = cos(q(1) - q(2))
            d = m1 + m2*sin(q(1) - q(2))**2
            u1 = p(1)/l1
            u2 = p(2)/l2
            v(1) = (u1 - c*u2)/(l1*d)
            v(2) = ((m1 + m2)/m2*u2 - c*u1)/(l2*d)
        end associate
    end subroutine velocities

    pure subroutine forces(self, t, q, v, f)
        !! $$ f_{1,2} = \mp m_2\ell_1\ell_2\dot\theta_1\dot\theta_2\sin\Delta
        !!    - (m_1+m_2)g\ell_1\sin\theta_1\ \text{or}\ m_2 g\ell_2\sin\theta_2 $$
        class(double_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: f(self%ndof)
        real(dp) :: turn

        associate (m => self%m1 + self%m2, m2 => self%m2, l1 => self%l1, l2 => self%l2, &
                   g => self%g)
            turn = m2*l1*l2*v(1)*v(2)*sin(q(1) - q(2))
            f(1) = -turn - m*g*l1*sin(q(1))
            f(2) = turn - m2*g*l2*sin(q(2))
        end associate
    end subroutine forces

    pure function energy(self, t, q, v) result(e)
        !! $$ E = \tfrac12(m_1+m_2)\ell_1^2\dot\theta_1^2 + \tfrac12 m_2\ell_2^2\dot\theta_2^2
        !!      + m_2\ell_1\ell_2\dot\theta_1\dot\theta_2\cos(\theta_1-\theta_2)
        !!      - (m_1+m_2)g\ell_1\cos\theta_1 - m_2 g\ell_2\cos\theta_2 $$
        class(double_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        associate (m => self%m1 + self%m2, m2 => self%m2, l1 => self%l1, l2 => self%l2, &
                   g => self%g)
            e = 0.5_dp*m*l1**2*v(1)**2 + 0.5_dp*m2*l2**2*v(2)**2 &
                + m2*l1*l2*v(1)*v(2)*cos(q(1) - q(2)) &
                - m*g*l1*cos(q(1)) - m2*g*l2*cos(q(2))
        end associate
    end function energy

    pure function momentum_or_tension(self, i, t, q, v) result(value)
        !! (1) angular momentum about the pivot. (2, 3) tension of the upper and the lower rod, from
        !! Newton's law for each bob along its rod and the accelerations above.
        class(double_pendulum_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value, c, lower

        associate (m1 => self%m1, m2 => self%m2, l1 => self%l1, l2 => self%l2, g => self%g)
            c = cos(q(1) - q(2))
            lower = m1*m2*(l1*v(1)**2*c + l2*v(2)**2 + g*cos(q(1))*c) &
                    /(m1 + m2*sin(q(1) - q(2))**2)
            select case (i)
            case (1)
                value = (m1 + m2)*l1**2*v(1) + m2*l2**2*v(2) + m2*l1*l2*(v(1) + v(2))*c
            case (2)
                value = m1*(l1*v(1)**2 + g*cos(q(1))) + lower*c
            case default
                value = lower
            end select
        end associate
    end function momentum_or_tension

    pure subroutine positions(self, t, q, r)
        !! Upper bob \((\ell_1\sin\theta_1, -\ell_1\cos\theta_1)\); the lower one hangs from it.
        class(double_pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        r = hyperdual_t()
        r(1, 1) = self%l1*sin(q(1))
        r(2, 1) = -self%l1*cos(q(1))
        r(1, 2) = r(1, 1) + self%l2*sin(q(2))
        r(2, 2) = r(2, 1) - self%l2*cos(q(2))
    end subroutine positions

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! `accelerations`, in all lanes at once.
        class(double_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)
        real(dp) :: s(lanes), c(lanes), s1(lanes), c1(lanes), d(lanes)

        associate (m1 => self%m1, m2 => self%m2, m => self%m1 + self%m2, &
                   l1 => self%l1, l2 => self%l2, g => self%g)
            call sine_cosine(q(:, 1) - q(:, 2), s, c)
            call sine_cosine(q(:, 1), s1, c1)
            d = 1.0_dp/(m1 + m2*s**2)
            a(:, 1) = (-m1*g*s1 - m2*s*(l1*v(:, 1)**2*c + l2*v(:, 2)**2 + g*(c1*c + s1*s))) &
                      *((1.0_dp/l1)*d)
            a(:, 2) = s*(m*(l1*v(:, 1)**2 + g*c1) + m2*l2*v(:, 2)**2*c)*((1.0_dp/l2)*d)
        end associate
    end subroutine accelerations_lanes

    pure subroutine linearise(self, q, analytic)
        !! \(M = ((m_1+m_2)\ell_1^2, m_2\ell_1\ell_2; m_2\ell_1\ell_2, m_2\ell_2^2)\) and
        !! \(K = \mathrm{diag}((m_1+m_2)g\ell_1, m_2g\ell_2)\), with signs where a rod stands on its
        !! head. With \(p = 1+m_2/m_1\) the sum of \(\omega^2\) is \(\pm pg/\ell_1 \pm pg/\ell_2\),
        !! the product \(\pm pg^2/(\ell_1\ell_2)\): the root that does not cancel gives the other.
        class(double_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof)
        type(linearised_t), intent(out) :: analytic
        real(dp) :: orientation(2), a, b, c, w2(2)

        associate (m1 => self%m1, m2 => self%m2, l1 => self%l1, l2 => self%l2, g => self%g)
            orientation = sign(1.0_dp, cos(q))
            c = m2*l1*l2*orientation(1)*orientation(2)
            analytic%mass = reshape([(m1 + m2)*l1**2, c, c, m2*l2**2], [2, 2])
            a = (m1 + m2)*g*l1*orientation(1)
            analytic%stiffness = reshape([a, 0.0_dp, 0.0_dp, m2*g*l2*orientation(2)], [2, 2])
            a = (1.0_dp + m2/m1)*g/l1
            b = g/l2
            c = (1.0_dp + m2/m1)*g/l2
            if (orientation(1)*orientation(2) > 0.0_dp) then
                ! (a + c)^2 - 4 a b = (a - c)^2 + 4 a (c - b), and c - b = (m2/m1) g/l2
                w2(2) = 0.5_dp*(a + c + hypot(a - c, 2.0_dp*sqrt(a)*sqrt((m2/m1)*b)))
            else
                w2(2) = 0.5_dp*(abs(a - c) + hypot(a - c, 2.0_dp*sqrt(a)*sqrt(b)))
            end if
            w2(1) = orientation(1)*orientation(2)*b*(a/max(w2(2), tiny(a)))
            analytic%omega2 = [minval(w2), maxval(w2)]
            if (orientation(1)*a + orientation(2)*c < 0.0_dp) then
                analytic%omega2 = [-maxval(w2), -minval(w2)]
            end if
            if (any(orientation < 0.0_dp)) return
            analytic%root = reshape([sqrt((m1 + m2)*g*l1), 0.0_dp, 0.0_dp, sqrt(m2*g*l2)], [2, 2])
            analytic%inverse = reshape([1.0_dp/(sqrt(m1)*l1), -1.0_dp/(sqrt(m1)*l2), &
                                    0.0_dp, 1.0_dp/(sqrt(m2)*l2)], [2, 2])
        end associate
    end subroutine linearise

    pure subroutine newton(self, t, x, u, force, constraint_residual)
        !! Gravity; the rods, \((\ell_1^2 - r_1^2)/2\ell_1 = 0\) and
        !! \((\ell_2^2 - (r_2-r_1)^2)/2\ell_2 = 0\).
        class(double_pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)
        type(hyperdual_t) :: rod(3)

        force = 0.0_dp
        force(2) = -self%m1*self%g
        force(5) = -self%m2*self%g
        rod = x(4:6) - x(1:3)
        constraint_residual(1) = 0.5_dp/self%l1*(self%l1**2 - dot_product(x(1:3), x(1:3)))
        constraint_residual(2) = 0.5_dp/self%l2*(self%l2**2 - dot_product(rod, rod))
    end subroutine newton
end module lagrangia_double_pendulum
