module dragged_systems
    !! A system with an L of its own, generalised forces beside it, and slips in what it says.
    use lagrangia_description, only: coordinate, description_t, nonnegative, positive, real_number
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: cos, hyperdual_t, operator(*), operator(**), operator(+), &
                                   operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_lagrangian_system, only: lagrangian_system_t
    implicit none (type, external)
    private
    public :: dragged_cart_t, slipped_cart_t

    type, extends(lagrangian_system_t) :: dragged_cart_t
        !! A pendulum on a cart; drag `b` on the cart alone, a motor of the torque `c cos t`.
    contains
        procedure :: outline
        procedure :: lagrangian
        procedure :: generalised_forces
    end type dragged_cart_t

    type, extends(dragged_cart_t) :: slipped_cart_t
        !! The same with a slip.
        integer :: slip = 0
    contains
        procedure :: configure => configure_with_slip
        procedure :: accelerations => accelerations_with_slip
    end type slipped_cart_t

contains

    pure subroutine outline(self, d)
        class(dragged_cart_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "dragged_cart"
        d%title = "a pendulum on a cart with drag, and a motor in its hinge"
        d%coordinates = [coordinate("x", "m", "of the cart"), &
                         coordinate("theta", "rad", "of the rod")]
        d%parameters = [positive("m", "kg", "mass of each", 1.0_dp), &
                        nonnegative("b", "N s/m", "drag of the cart", 0.7_dp), &
                        real_number("c", "N m", "torque of the motor", 0.3_dp)]
    end subroutine outline

    pure function lagrangian(self, t, q, v) result(l)
        class(dragged_cart_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l
        real(dp) :: m

        m = self%value(1, 1.0_dp)
        l = m*(v(1)**2 + v(1)*v(2)*cos(q(2)) + 0.5_dp*v(2)**2 + 9.81_dp*cos(q(2)))
    end function lagrangian

    pure subroutine generalised_forces(self, t, q, v, f)
        class(dragged_cart_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t), intent(out) :: f(self%ndof)

        f(1) = -self%value(2, 0.7_dp)*v(1)
        f(2) = self%value(3, 0.3_dp)*cos(t)
    end subroutine generalised_forces

    pure subroutine configure_with_slip(self, values, error)
        !! 1, 2, 3: a flag. 4: a coordinate that feels the drag.
        class(slipped_cart_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call self%dragged_cart_t%configure(values, error)
        if (self%slip == 1) self%nonconservative = .false.
        if (self%slip == 2) self%velocity_forces = .false.
        if (self%slip == 3) self%time_dependent = .false.
        if (self%slip == 4) self%cyclic = 1
    end subroutine configure_with_slip

    pure subroutine accelerations_with_slip(self, t, q, v, a)
        !! 5: as if the drag on the cart were twice as large.
        class(slipped_cart_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        real(dp) :: m

        call self%dragged_cart_t%accelerations(t, q, v, a)
        m = self%value(1, 1.0_dp)
        if (self%slip /= 5) return
        a = a - self%value(2, 0.7_dp)*v(1)/(m*(2.0_dp - cos(q(2))**2))*[1.0_dp, -cos(q(2))]
    end subroutine accelerations_with_slip
end module dragged_systems
