module lagrangia_other_lagrangians
    !! Lagrangians that are not \(T - V\), and tell the motion of one that is: of the plane
    !! oscillator and of the damped one. Their mass matrix may be indefinite.
    use lagrangia_description, only: coordinate, description_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: exp, hyperdual_t, operator(*), operator(**), operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian, energy_from_lagrangian
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: bare_lagrangian_t, crossed_t, growing_t

    type, abstract, extends(system_t) :: bare_lagrangian_t
        !! An L, and what follows from it. `ndof` must be set.
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: energy
    end type bare_lagrangian_t

    type, extends(bare_lagrangian_t) :: crossed_t
        !! \(L' = \dot x\dot y - \omega^2xy\).
        real(dp) :: omega = 1.0_dp  !! rad/s
    contains
        procedure :: lagrangian => crossed
    end type crossed_t

    type, extends(bare_lagrangian_t) :: growing_t
        !! \(L' = e^{\gamma t}(m\dot x^2 - kx^2)/2\).
        real(dp) :: m = 1.0_dp      !! kg
        real(dp) :: k = 1.0_dp      !! N/m
        real(dp) :: gamma = 0.0_dp  !! 1/s
    contains
        procedure :: lagrangian => growing
    end type growing_t

contains

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(bare_lagrangian_t), intent(in) :: self
        type(description_t), intent(out) :: d
        character(1), parameter :: names(3) = ["x", "y", "z"]
        integer :: i

        d%name = "bare"
        d%title = "a Lagrangian"
        d%coordinates = [(coordinate(names(i), "m", "position"), i=1, self%ndof)]
        allocate (d%parameters(0), d%quantities(0), d%notes(0), d%points(0))
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! See `system_t`. There are no parameters.
        class(bare_lagrangian_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        if (size(values) == 0) self%time_dependent = self%time_dependent
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! See `system_t`.
        class(bare_lagrangian_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        type(error_t), allocatable :: error
        real(dp) :: none(0)

        call accelerations_from_lagrangian(self, t, q, v, a, none, error)
    end subroutine accelerations

    pure function energy(self, t, q, v) result(e)
        !! See `system_t`.
        class(bare_lagrangian_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = energy_from_lagrangian(self, t, q, v)
    end function energy

    pure function crossed(self, t, q, v) result(l)
        !! See `system_t`.
        class(crossed_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = v(1)*v(2) - self%omega**2*q(1)*q(2)
    end function crossed

    pure function growing(self, t, q, v) result(l)
        !! See `system_t`.
        class(growing_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*exp(self%gamma*t)*(self%m*v(1)**2 - self%k*q(1)**2)
    end function growing
end module lagrangia_other_lagrangians
