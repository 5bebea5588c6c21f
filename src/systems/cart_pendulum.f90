module lagrangia_cart_pendulum
    !! A pendulum that hangs from a cart which rolls freely along a horizontal line.
    !!
    !! Source: the lecture of 1 September 2011, cart-pendulum. The notes write
    !! \(-m_2 g\ell\sin\theta\) in the \(\theta\)-equation, against their own Lagrangian and
    !! their own frequency; the sign below is the one that follows from \(L\).
    use lagrangia_cart_swing, only: cart_swing_t
    use lagrangia_description, only: conserved, coordinate, description_t, figure_length, &
                                     formula_length, frequency_t, mass_point, nonnegative, &
                                     positive, quantity
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: cos, dot_product, hyperdual_t, operator(*), operator(**), &
                                   operator(+), operator(-), sin
    use lagrangia_kinds, only: dp
    use lagrangia_linearised, only: linearised_t
    use lagrangia_reference, only: reference_t
    use lagrangia_sine_cosine, only: sine_cosine
    use lagrangia_system, only: check_parameters, lanes, reduced_t, system_t
    implicit none (type, external)
    private
    public :: cart_pendulum_t

    type, extends(system_t) :: cart_pendulum_t
        !! The coordinates are \(x\), m, of the cart; \(\theta\), rad, from the downward vertical.
        real(dp) :: m1 = 1.0_dp  !! cart, kg
        real(dp) :: m2 = 1.0_dp  !! bob, kg
        real(dp) :: l = 1.0_dp   !! rod, m
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
        procedure :: quantity => momentum_or_force
        procedure :: positions
        procedure :: newton
        procedure :: reduce
        procedure :: closed_form
    end type cart_pendulum_t

    interface
        module subroutine closed_form(self, t0, q0, v0, reference)
            !! See `system_t`; in `cart_pendulum_reference`.
            implicit none (type, external)
            class(cart_pendulum_t), intent(in) :: self
            real(dp), intent(in) :: t0, q0(:), v0(:)
            class(reference_t), allocatable, intent(out) :: reference
        end subroutine closed_form
    end interface

contains

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(cart_pendulum_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "cart_pendulum"
        d%title = "a pendulum hanging from a cart that rolls freely"
        d%coordinates = [coordinate("x", "m", "position of the cart"), &
                         coordinate("theta", "rad", "angle of the rod from the downward vertical")]
        d%parameters = [positive("m1", "kg", "mass of the cart", self%m1), &
                        positive("m2", "kg", "mass of the bob", self%m2), &
                        positive("l", "m", "length of the rod", self%l), &
                        nonnegative("g", "m/s^2", "gravity", self%g)]
        associate (m => self%m1 + self%m2)
            d%energy_scale = self%m2*self%g*self%l
            d%quantities = [ &
                conserved("p_x", "kg m/s", "momentum along x, which is cyclic", &
                          m*sqrt(self%g*self%l), "(m1 + m2) x_dot + m2 l theta_dot cos(theta)"), &
                conserved("x_com", "m", "start of the centre of mass", self%l, &
                          "x + m2/(m1 + m2) l sin(theta) - p_x t/(m1 + m2)"), &
                quantity("tension", "N", "force along the rod", &
                         "m1 m2 (l theta_dot^2 + g cos(theta))/(m1 + m2 sin(theta)^2)")]
        end associate
        d%points = [mass_point("cart", self%m1, "m1", "x"), &
                    mass_point("bob", self%m2, "m2", "x + l sin(theta)", "- l cos(theta)")]
        d%reactions = [ &
            quantity("track_force", "N", "of the track on the cart, upwards", "y_cart"), &
            quantity("tension", "N", "of the rod", "(l^2 - (x_bob - x_cart)^2 "// &
                     "- (y_bob - y_cart)^2)/(2 l)")]
        d%kinetic_energy = "(m1 + m2)/2 x_dot^2 + m2/2 l^2 theta_dot^2 "// &
                           "+ m2 l x_dot theta_dot cos(theta)"
        d%potential_energy = "- m2 g l cos(theta)"
        d%lagrangian = d%kinetic_energy//" + m2 g l cos(theta)"
        d%energy = d%kinetic_energy//" - m2 g l cos(theta)"
        d%equations = [character(formula_length) :: &
            "(m1 + m2) x_ddot + m2 l theta_ddot cos(theta) - m2 l theta_dot^2 sin(theta) = 0", &
            "l theta_ddot + x_ddot cos(theta) + g sin(theta) = 0"]
        d%accelerations = [character(formula_length) :: &
            "x_ddot = m2 sin(theta) (l theta_dot^2 + g cos(theta))/(m1 + m2 sin(theta)^2)", &
            "theta_ddot = - sin(theta) ((m1 + m2) g + m2 l theta_dot^2 cos(theta))"// &
            "/(l (m1 + m2 sin(theta)^2))"]
        d%frequencies = [frequency_t("omega^2 = (m1 + m2) g/(m1 l)", "theta = 0"), &
                         frequency_t("omega^2 = - (m1 + m2) g/(m1 l)", "theta = pi")]
        d%constraint = "holonomic, scleronomic"
        d%constraint_equations = [character(len(d%title)) :: &
            "(x_bob - x_cart)^2 + y_bob^2 = l^2", "y_cart = 0"]
        d%notes = [character(len(d%title)) :: &
            "The notes have - m2 g l sin(theta): a slip, see their own L and frequency.", &
            "With p_x = 0 the bob moves on an ellipse of semi-axes m1 l/(m1 + m2) and l."]
        d%figure = [character(figure_length) :: "ground (0, - 0.14 l) (1, - 0.14 l)", &
                    "trail bob", "cart cart (0.4 l, 0.16 l)", "rod cart bob", "ball bob"]
        d%source = "Phys 601, 1 September 2011: cart-pendulum"
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! In this order: m1, m2, l, g.
        class(cart_pendulum_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call check_parameters(self, values, error)
        if (allocated(error)) return
        self%ndof = 2
        self%cyclic = 1
        self%m1 = values(1)
        self%m2 = values(2)
        self%l = values(3)
        self%g = values(4)
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ \ddot x = \frac{m_2\sin\theta\,(\ell\dot\theta^2 + g\cos\theta)}{D},\quad
        !!    \ddot\theta = -\frac{\sin\theta\,[(m_1+m_2)g + m_2\ell\dot\theta^2\cos\theta]}{\ell D}
        !! $$ with \(D = m_1 + m_2\sin^2\theta \ge m_1 > 0\).
        class(cart_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        real(dp) :: s, c, d

        associate (m1 => self%m1, m2 => self%m2, l => self%l, g => self%g, theta_dot => v(2))
            s = sin(q(2))
            c = cos(q(2))
            d = m1 + m2*s**2
            a(1) = m2*s*(l*theta_dot**2 + g*c)/d
            a(2) = -s*((m1 + m2)*g + m2*l*theta_dot**2*c)/(l*d)
        end associate
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L = \tfrac12(m_1+m_2)\dot x^2 + \tfrac12 m_2\ell^2\dot\theta^2
        !!      + m_2\ell\dot x\dot\theta\cos\theta + m_2 g\ell\cos\theta $$
        class(cart_pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        associate (m1 => self%m1, m2 => self%m2, r => self%l, g => self%g)
            l = 0.5_dp*(m1 + m2)*v(1)**2 + 0.5_dp*m2*r**2*v(2)**2 &
                + m2*r*v(1)*v(2)*cos(q(2)) + m2*g*r*cos(q(2))
        end associate
    end function lagrangian

    pure subroutine momenta(self, t, q, v, p)
        !! $$ p_x = (m_1+m_2)\dot x + m_2\ell\dot\theta\cos\theta,\quad
        !!    p_\theta = m_2\ell^2\dot\theta + m_2\ell\dot x\cos\theta $$
        class(cart_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: p(self%ndof)
        real(dp) :: c

        associate (m1 => self%m1, m2 => self%m2, l => self%l)
            c = cos(q(2))
            p(1) = (m1 + m2)*v(1) + m2*l*v(2)*c
            p(2) = m2*l*(l*v(2) + v(1)*c)
        end associate
    end subroutine momenta

    pure subroutine velocities(self, t, q, p, v)
        !! \(M^{-1}p\), with \(\det M = m_2\ell^2\,(m_1 + m_2\sin^2\theta) > 0\).
        class(cart_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), p(self%ndof)
        real(dp), intent(out) :: v(self%ndof)
        real(dp) :: c, d

        associate (m1 => self%m1, m2 => self%m2, l => self%l)
            c = cos(q(2))
            d = m1 + m2*sin(q(2))**2
            v(1) = (p(1) - c*p(2)/l)/d
            v(2) = ((m1 + m2)/m2*p(2)/l - c*p(1))/(l*d)
        end associate
    end subroutine velocities

    pure subroutine forces(self, t, q, v, f)
        !! $$ f_x = 0,\quad f_\theta = -m_2\ell\,(\dot x\dot\theta + g)\sin\theta $$
        class(cart_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: f(self%ndof)

        f(1) = 0.0_dp
        f(2) = -self%m2*self%l*(v(1)*v(2) + self%g)*sin(q(2))
    end subroutine forces

    pure function energy(self, t, q, v) result(e)
        !! $$ E = \tfrac12(m_1+m_2)\dot x^2 + \tfrac12 m_2\ell^2\dot\theta^2
        !!      + m_2\ell\dot x\dot\theta\cos\theta - m_2 g\ell\cos\theta $$
        class(cart_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        associate (m1 => self%m1, m2 => self%m2, l => self%l, g => self%g)
            e = 0.5_dp*(m1 + m2)*v(1)**2 + 0.5_dp*m2*l**2*v(2)**2 &
                + m2*l*v(1)*v(2)*cos(q(2)) - m2*g*l*cos(q(2))
        end associate
    end function energy

    pure function momentum_or_force(self, i, t, q, v) result(value)
        !! (1) \(p_x\). (2) where the centre of mass was at \(t = 0\). (3) the rod's tension.
        class(cart_pendulum_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value, p

        associate (m1 => self%m1, m2 => self%m2, l => self%l, g => self%g)
            p = (m1 + m2)*v(1) + m2*l*v(2)*cos(q(2))
            select case (i)
            case (1)
                value = p
            case (2)
                value = q(1) + m2/(m1 + m2)*l*sin(q(2)) - p*t/(m1 + m2)
            case default
                value = m1*m2*(l*v(2)**2 + g*cos(q(2)))/(m1 + m2*sin(q(2))**2)
            end select
        end associate
    end function momentum_or_force

    pure subroutine positions(self, t, q, r)
        !! Cart \((x, 0)\), bob \((x + \ell\sin\theta, -\ell\cos\theta)\).
        class(cart_pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        r = hyperdual_t()
        r(1, 1) = q(1)
        r(1, 2) = q(1) + self%l*sin(q(2))
        r(2, 2) = -self%l*cos(q(2))
    end subroutine positions

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! `accelerations`, in all lanes at once.
        class(cart_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)
        real(dp) :: s(lanes), c(lanes), d(lanes)

        associate (m1 => self%m1, m2 => self%m2, l => self%l, g => self%g, &
                   theta_dot => v(:, 2))
            call sine_cosine(q(:, 2), s, c)
            d = s/(m1 + m2*s**2)
            a(:, 1) = m2*d*(l*theta_dot**2 + g*c)
            a(:, 2) = -d*((m1 + m2)/l*g + m2*theta_dot**2*c)
        end associate
    end subroutine accelerations_lanes

    pure subroutine linearise(self, q, analytic)
        !! At rest \(M = (m_1+m_2, m_2\ell; m_2\ell, m_2\ell^2)\), \(K = (0, 0; 0, m_2g\ell)\),
        !! \(\omega^2 = 0, (m_1+m_2)g/(m_1\ell)\). Upside down \(\theta\) and \(g\) change sign.
        class(cart_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof)
        type(linearised_t), intent(out) :: analytic
        real(dp) :: orientation, w2

        associate (m1 => self%m1, m2 => self%m2, l => self%l, g => self%g)
            orientation = sign(1.0_dp, cos(q(2)))
            analytic%mass = reshape([m1 + m2, orientation*m2*l, orientation*m2*l, m2*l**2], [2, 2])
            analytic%stiffness = reshape([0.0_dp, 0.0_dp, 0.0_dp, orientation*m2*g*l], [2, 2])
            w2 = orientation*(m1 + m2)*g/(m1*l)
            analytic%omega2 = [min(0.0_dp, w2), max(0.0_dp, w2)]
            if (orientation < 0.0_dp) return
            analytic%root = reshape([0.0_dp, sqrt(m2*g*l)], [1, 2])
            analytic%inverse = reshape([1.0_dp/sqrt(m1), -1.0_dp/(sqrt(m1)*l), &
                                    0.0_dp, 1.0_dp/(sqrt(m2)*l)], [2, 2])
        end associate
    end subroutine linearise

    pure subroutine newton(self, t, x, u, force, constraint_residual)
        !! Gravity on both; the track under the cart; the rod.
        class(cart_pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)
        type(hyperdual_t) :: rod(3)

        force = 0.0_dp
        force(2) = -self%m1*self%g
        force(5) = -self%m2*self%g
        rod = x(4:6) - x(1:3)
        constraint_residual(1) = x(2)
        constraint_residual(2) = 0.5_dp/self%l*(self%l**2 - dot_product(rod, rod))
    end subroutine newton

    subroutine reduce(self, reduced)
        !! Without \(x\).
        class(cart_pendulum_t), intent(in) :: self
        class(reduced_t), allocatable, intent(out) :: reduced
        type(cart_swing_t) :: swing
        type(error_t), allocatable :: error

        call swing%configure([self%m1, self%m2, self%l, self%g], error)
        allocate (reduced, source=swing)
    end subroutine reduce
end module lagrangia_cart_pendulum
