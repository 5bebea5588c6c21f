module spherical_xy
    !! The same pendulum in other coordinates, for small swings about the vertical, where the angle
    !! \(\varphi\) means nothing: again only a Lagrangian.
    use lagrangia, only: coordinate, description_t, dp, hyperdual_t, lagrangian_system_t, &
                         nonnegative, operator(*), operator(**), operator(+), operator(-), &
                         operator(/), positive, sqrt, sum
    implicit none (type, external)
    private
    public :: spherical_xy_t

    type, extends(lagrangian_system_t) :: spherical_xy_t
        !! Coordinates: x and y of the bob below the pivot, m.
    contains
        procedure :: outline
        procedure :: lagrangian
    end type spherical_xy_t

contains

    pure subroutine outline(self, d)
        !! Name, coordinates, parameters with their defaults.
        class(spherical_xy_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "spherical_xy"
        d%title = "the same pendulum in Cartesian coordinates, below the pivot"
        d%coordinates = [coordinate("x", "m", "of the bob"), coordinate("y", "m", "of the bob")]
        d%parameters = [positive("m", "kg", "mass of the bob", 1.0_dp), &
                        positive("l", "m", "length of the rod", 1.0_dp), &
                        nonnegative("g", "m/s^2", "gravity", 9.81_dp)]
    end subroutine outline

    pure function lagrangian(self, t, q, v) result(l)
        !! \(L = \tfrac m2(\dot x^2 + \dot y^2 + \dot z^2) + mgh\): the bob hangs
        !! \(h = \sqrt{\ell^2 - x^2 - y^2}\) below the pivot, \(\dot z = (x\dot x + y\dot y)/h\).
        class(spherical_xy_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l, h

        associate (m => self%p(1), r => self%p(2), g => self%p(3))
            h = sqrt(r**2 - sum(q**2))
            l = 0.5_dp*m*(sum(v**2) + (sum(q*v)/h)**2) + m*g*h
        end associate
    end function lagrangian
end module spherical_xy
