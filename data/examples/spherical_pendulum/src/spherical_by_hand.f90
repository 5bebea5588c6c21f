module spherical_by_hand
    !! The second step: equations of motion by hand, faster, and checked against the Lagrangian;
    !! what is conserved; where the bob is; and what Newton would say.
    use lagrangia, only: conserved, cos, description_t, dot_product, dp, formula_length, &
                         hyperdual_t, mass_point, operator(*), operator(-), quantity, sin
    use spherical_pendulum, only: spherical_pendulum_t
    implicit none (type, external)
    private
    public :: spherical_by_hand_t

    type, extends(spherical_pendulum_t) :: spherical_by_hand_t
    contains
        procedure :: outline
        procedure :: accelerations
        procedure :: quantity => momentum_or_tension
        procedure :: positions
        procedure :: newton
    end type spherical_by_hand_t

contains

    pure subroutine outline(self, d)
        !! More than the first step says.
        class(spherical_by_hand_t), intent(in) :: self
        type(description_t), intent(out) :: d

        call self%spherical_pendulum_t%outline(d)
        d%name = "spherical_by_hand"
        d%quantities = [ &
            conserved("L_z", "kg m^2/s", "phi is cyclic", 0.0_dp, &
                      "m l^2 sin(theta)^2 phi_dot"), &
            quantity("tension", "N", "force along the rod", &
                     "m (l theta_dot^2 + l (sin(theta) phi_dot)^2 + g cos(theta))")]
        d%dimensions = 3
        d%points = [mass_point("bob", self%value(1, 1.0_dp))]
        d%reactions = [quantity("tension", "N", "of the rod", &
                                "(l^2 - x_bob^2 - y_bob^2 - z_bob^2)/(2 l)")]
        d%lagrangian = "m/2 l^2 (theta_dot^2 + phi_dot^2 sin(theta)^2) + m g l cos(theta)"
        d%equations = [character(formula_length) :: &
            "theta_ddot = sin(theta) (cos(theta) phi_dot^2 - g/l)", &
            "phi_ddot = - 2 theta_dot phi_dot cos(theta)/sin(theta)"]
    end subroutine outline

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ \ddot\theta = \sin\theta\,(\cos\theta\,\dot\varphi^2 - g/\ell),\quad
        !!    \ddot\varphi = -2\dot\theta\dot\varphi\cot\theta $$
        class(spherical_by_hand_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        associate (l => self%p(2), g => self%p(3))
            a(1) = sin(q(1))*(cos(q(1))*v(2)**2 - g/l)
            a(2) = -2.0_dp*v(1)*v(2)*cos(q(1))/sin(q(1))
        end associate
    end subroutine accelerations

    pure function momentum_or_tension(self, i, t, q, v) result(value)
        !! 1: angular momentum about the vertical. 2: the rod's tension.
        class(spherical_by_hand_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value

        associate (m => self%p(1), l => self%p(2), g => self%p(3))
            if (i == 1) then
                value = m*l**2*sin(q(1))**2*v(2)
            else
                value = m*(l*v(1)**2 + l*(sin(q(1))*v(2))**2 + g*cos(q(1)))
            end if
        end associate
    end function momentum_or_tension

    pure subroutine positions(self, t, q, r)
        !! The bob, z up.
        class(spherical_by_hand_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        r(1, 1) = self%p(2)*sin(q(1))*cos(q(2))
        r(2, 1) = self%p(2)*sin(q(1))*sin(q(2))
        r(3, 1) = -self%p(2)*cos(q(1))
    end subroutine positions

    pure subroutine newton(self, t, x, u, force, constraint_residual)
        !! Gravity; the rod.
        class(spherical_by_hand_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)

        force = [0.0_dp, 0.0_dp, -self%p(1)*self%p(3)]
        constraint_residual(1) = 0.5_dp/self%p(2)*(self%p(2)**2 - dot_product(x, x))
    end subroutine newton
end module spherical_by_hand
