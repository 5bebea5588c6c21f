module singular_systems
    !! Own systems that have no equations of motion: for tests of what is said about them.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia, only: coordinate, description_t, dp, hyperdual_t, lagrangian_system_t, &
                         operator(*), operator(**), operator(+), operator(-)
    implicit none (type, external)
    private
    public :: blind_t, fading_t, light_rod_t, light_t, skew_t, steep_t

    type, abstract, extends(lagrangian_system_t) :: two_t
        !! Coordinates x and y, no parameters.
    contains
        procedure :: outline
    end type two_t

    type, extends(two_t) :: light_t
        !! y has no mass: \(L = \dot x^2/2 - x^2/2 - y^2/2\).
    contains
        procedure :: lagrangian => light_lagrangian
    end type light_t

    type, extends(light_t) :: light_rod_t
        !! The same, and y follows x: \(\dot x/2 - \dot y/4 = 0\).
    contains
        procedure :: constraint_rows => rod_rows
    end type light_rod_t

    type, extends(two_t) :: skew_t
        !! A mass of -1: \(L = \dot x\dot y - xy\).
    contains
        procedure :: lagrangian => skew_lagrangian
    end type skew_t

    type, extends(two_t) :: fading_t
        !! y loses its mass at x = 1: \(L = (\dot x^2 + (1 - x)\,\dot y^2)/2 - y\).
    contains
        procedure :: lagrangian => fading_lagrangian
    end type fading_t

    type, extends(two_t) :: blind_t
        !! L is NaN; the accelerations are 0, by hand.
    contains
        procedure :: lagrangian => blind_lagrangian
        procedure :: accelerations => no_accelerations
    end type blind_t

    type, extends(two_t) :: steep_t
        !! The force on x overflows long before L: \(L = (\dot x^2 + \dot y^2)/2 - 10^{400}x^2\).
    contains
        procedure :: lagrangian => steep_lagrangian
    end type steep_t

contains

    pure subroutine outline(self, d)
        class(two_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "two"
        d%title = "two coordinates"
        d%coordinates = [coordinate("x", "m", "one"), coordinate("y", "m", "another")]
    end subroutine outline

    pure function light_lagrangian(self, t, q, v) result(l)
        class(light_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*v(1)**2 - 0.5_dp*q(1)**2 - 0.5_dp*q(2)**2
    end function light_lagrangian

    pure subroutine rod_rows(self, t, q, rows, drift)
        class(light_rod_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: rows(:, :), drift(:)

        rows(1, :)%re = [0.5_dp, -0.25_dp]
    end subroutine rod_rows

    pure function skew_lagrangian(self, t, q, v) result(l)
        class(skew_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = v(1)*v(2) - q(1)*q(2)
    end function skew_lagrangian

    pure function fading_lagrangian(self, t, q, v) result(l)
        class(fading_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*(v(1)**2 + (1.0_dp - q(1))*v(2)**2) - q(2)
    end function fading_lagrangian

    pure function steep_lagrangian(self, t, q, v) result(l)
        class(steep_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*(v(1)**2 + v(2)**2) - (1e200_dp*q(1))**2
    end function steep_lagrangian

    pure function blind_lagrangian(self, t, q, v) result(l)
        class(blind_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = ieee_value(1.0_dp, ieee_quiet_nan)*q(1)
    end function blind_lagrangian

    pure subroutine no_accelerations(self, t, q, v, a)
        class(blind_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a = 0.0_dp
    end subroutine no_accelerations
end module singular_systems
