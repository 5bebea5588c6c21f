module lagrangia_cart_swing
    !! The cart-pendulum without \(x\), which is cyclic.
    !!
    !! \(p_x = (m_1+m_2)\dot x + m_2\ell\dot\theta\cos\theta\) is conserved, and is the derivative
    !! of \((m_1+m_2)x + m_2\ell\sin\theta\): so \(x\) follows from \(\theta\) without a quadrature.
    !! Routh's function \(R = L - p_x\dot x\) gives the motion of \(\theta\), on which \(p_x\) has
    !! no influence: its term there is a total derivative.
    use lagrangia_description, only: coordinate, description_t, nonnegative, point_t, positive, &
                                     quantity_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: cos, hyperdual_t, operator(*), operator(**), operator(+), &
                                   operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_sine_cosine, only: sine_cosine
    use lagrangia_system, only: check_parameters, lanes, reduced_t
    implicit none (type, external)
    private
    public :: cart_swing_t

    type, extends(reduced_t) :: cart_swing_t
        !! The coordinate is \(\theta\), rad, from the downward vertical.
        real(dp) :: m1 = 1.0_dp  !! cart, kg
        real(dp) :: m2 = 1.0_dp  !! bob, kg
        real(dp) :: l = 1.0_dp   !! rod, m
        real(dp) :: g = 9.81_dp  !! m s^-2
        real(dp) :: drift = 0.0_dp   !! velocity of the centre of mass along x, m/s
        real(dp) :: centre = 0.0_dp  !! where that was when x was left, m
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: lagrangian
        procedure :: energy
        procedure :: leave
        procedure :: complete
    end type cart_swing_t

contains

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(cart_swing_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "cart_swing"
        d%title = "the cart-pendulum without its cyclic coordinate"
        d%coordinates = [coordinate("theta", "rad", "angle of the rod from the downward vertical")]
        d%parameters = [positive("m1", "kg", "mass of the cart", self%m1), &
                        positive("m2", "kg", "mass of the bob", self%m2), &
                        positive("l", "m", "length of the rod", self%l), &
                        nonnegative("g", "m/s^2", "gravity", self%g)]
        d%energy_scale = self%m2*self%g*self%l
        d%quantities = [quantity_t ::]
        d%points = [point_t ::]
        d%reactions = [quantity_t ::]
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! In this order: m1, m2, l, g.
        class(cart_swing_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call check_parameters(self, values, error)
        if (allocated(error)) return
        self%ndof = 1
        self%m1 = values(1)
        self%m2 = values(2)
        self%l = values(3)
        self%g = values(4)
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ \ddot\theta = -\frac{\sin\theta\,[(m_1+m_2)g + m_2\ell\dot\theta^2\cos\theta]}
        !!                        {\ell\,(m_1 + m_2\sin^2\theta)} $$
        class(cart_swing_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        real(dp) :: s

        associate (m1 => self%m1, m2 => self%m2, l => self%l, g => self%g)
            s = sin(q(1))
            a(1) = -s*((m1 + m2)*g + m2*l*v(1)**2*cos(q(1)))/(l*(m1 + m2*s**2))
        end associate
    end subroutine accelerations

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! `accelerations`, in all lanes at once.
        class(cart_swing_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)
        real(dp) :: s(lanes), c(lanes)

        associate (m1 => self%m1, m2 => self%m2, l => self%l, g => self%g)
            call sine_cosine(q(:, 1), s, c)
            a(:, 1) = -s*((m1 + m2)/l*g + m2*v(:, 1)**2*c)/(m1 + m2*s**2)
        end associate
    end subroutine accelerations_lanes

    pure function lagrangian(self, t, q, v) result(l)
        !! Routh's function for \(p_x = 0\): $$ R = \tfrac12 m_2\ell^2\Big(1 -
        !! \frac{m_2\cos^2\theta}{m_1+m_2}\Big)\dot\theta^2 + m_2 g\ell\cos\theta $$
        class(cart_swing_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l, c

        associate (m1 => self%m1, m2 => self%m2, r => self%l, g => self%g)
            c = cos(q(1))
            l = 0.5_dp*m2*r**2*(1.0_dp - m2/(m1 + m2)*c**2)*v(1)**2 + m2*g*r*c
        end associate
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! $$ E = \tfrac12 m_2\ell^2\Big(1 - \frac{m_2\cos^2\theta}{m_1+m_2}\Big)\dot\theta^2
        !!      - m_2 g\ell\cos\theta $$
        class(cart_swing_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e, c

        associate (m1 => self%m1, m2 => self%m2, l => self%l, g => self%g)
            c = cos(q(1))
            e = 0.5_dp*m2*l**2*(1.0_dp - m2/(m1 + m2)*c**2)*v(1)**2 - m2*g*l*c
        end associate
    end function energy

    pure subroutine leave(self, q, v, q_left, v_left)
        !! See `reduced_t`: the motion of the centre of mass.
        class(cart_swing_t), intent(inout) :: self
        real(dp), intent(in) :: q(:), v(:)
        real(dp), intent(out) :: q_left(self%ndof), v_left(self%ndof)
        real(dp) :: arm

        arm = self%m2/(self%m1 + self%m2)*self%l
        self%drift = v(1) + arm*v(2)*cos(q(2))
        self%centre = q(1) + arm*sin(q(2))
        q_left(1) = q(2)
        v_left(1) = v(2)
    end subroutine leave

    pure subroutine complete(self, elapsed, q_left, v_left, q, v)
        !! See `reduced_t`.
        class(cart_swing_t), intent(in) :: self
        real(dp), intent(in) :: elapsed, q_left(self%ndof), v_left(self%ndof)
        real(dp), intent(out) :: q(:), v(:)
        real(dp) :: arm

        arm = self%m2/(self%m1 + self%m2)*self%l
        q(1) = self%centre + self%drift*elapsed - arm*sin(q_left(1))
        v(1) = self%drift - arm*v_left(1)*cos(q_left(1))
        q(2) = q_left(1)
        v(2) = v_left(1)
    end subroutine complete
end module lagrangia_cart_swing
