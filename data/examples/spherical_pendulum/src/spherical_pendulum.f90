module spherical_pendulum
    !! A pendulum that swings in all directions. The first step: only its Lagrangian.
    use lagrangia, only: coordinate, cos, description_t, dp, hyperdual_t, lagrangian_system_t, &
                         nonnegative, operator(*), operator(**), operator(+), positive, sin
    implicit none (type, external)
    private
    public :: spherical_pendulum_t

    type, extends(lagrangian_system_t) :: spherical_pendulum_t
        !! Coordinates: \(\theta\) from the downward vertical, \(\varphi\) around it, rad.
    contains
        procedure :: outline
        procedure :: lagrangian
    end type spherical_pendulum_t

contains

    pure subroutine outline(self, d)
        !! Name, coordinates, parameters with their defaults.
        class(spherical_pendulum_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "spherical_pendulum"
        d%title = "a pendulum that swings in all directions"
        d%coordinates = [coordinate("theta", "rad", "angle from the downward vertical"), &
                         coordinate("phi", "rad", "angle around the vertical")]
        d%parameters = [positive("m", "kg", "mass of the bob", 1.0_dp), &
                        positive("l", "m", "length of the rod", 1.0_dp), &
                        nonnegative("g", "m/s^2", "gravity", 9.81_dp)]
    end subroutine outline

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L = \tfrac12 m\ell^2(\dot\theta^2 + \dot\varphi^2\sin^2\theta) + mg\ell\cos\theta $$
        class(spherical_pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        associate (m => self%p(1), r => self%p(2), g => self%p(3))
            l = 0.5_dp*m*r**2*(v(1)**2 + sin(q(1))**2*v(2)**2) + m*g*r*cos(q(1))
        end associate
    end function lagrangian
end module spherical_pendulum
