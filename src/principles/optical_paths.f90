module lagrangia_optical_paths
    use lagrangia_errors, only: error_t
    !! Optical paths from one point to another by way of a mirror or a surface, as functions of
    !! where the ray touches it.
    use lagrangia_gsl, only: brent_root
    use lagrangia_hyperdual, only: cos, hyperdual_t, operator(*), operator(**), operator(+), &
                                   operator(-), sin, sqrt
    use lagrangia_kinds, only: dp
    use lagrangia_roots, only: scalar_function_t
    implicit none (type, external)
    private
    public :: optical_path_t, flat_mirror_t, concave_mirror_t, elliptic_mirror_t, surface_t
    public :: quartic_t, second_derivative, stationary_point

    type, abstract, extends(scalar_function_t) :: optical_path_t
        !! Its `value` is the path's derivative, which vanishes where the light goes.
    contains
        procedure(length_i), deferred :: length
        procedure :: value => derivative
        procedure :: at
    end type optical_path_t

    abstract interface
        pure function length_i(self, u) result(path)
            !! \(\int n\,ds\), m.
            import :: optical_path_t, hyperdual_t
            implicit none (type, external)
            class(optical_path_t), intent(in) :: self
            type(hyperdual_t), intent(in) :: u  !! where the ray touches
            type(hyperdual_t) :: path
        end function length_i
    end interface

    type, extends(optical_path_t) :: flat_mirror_t
        !! Hero's: points at heights `a`, `b` over the mirror, `d` apart along it; `u` is \(x\).
        real(dp) :: a, b, d
    contains
        procedure :: length => by_flat_mirror
    end type flat_mirror_t

    type, extends(optical_path_t) :: concave_mirror_t
        !! A circle of radius `r`, both points on one diameter at \(\pm s\); `u` is the angle from
        !! the mirror's middle.
        real(dp) :: r, s
    contains
        procedure :: length => by_concave_mirror
    end type concave_mirror_t

    type, extends(optical_path_t) :: elliptic_mirror_t
        !! Semi-axes `a` > `b`, the points are its foci; `u` is the eccentric angle from the
        !! end of the small axis.
        real(dp) :: a, b
    contains
        procedure :: length => by_elliptic_mirror
    end type elliptic_mirror_t

    type, extends(optical_path_t) :: surface_t
        !! From height `a` in a medium of index `n1` to depth `b` in `n2`, `d` apart; `u` is \(x\).
        real(dp) :: a, b, d, n1, n2
    contains
        procedure :: length => through_surface
    end type surface_t

    type, extends(scalar_function_t) :: quartic_t
        !! Snell's law squared and without fractions: its root is the crossing point too.
        type(surface_t) :: surface
    contains
        procedure :: value => quartic
    end type quartic_t

contains

    function derivative(self, x) result(y)
        !! Exact, by hyper-dual numbers.
        class(optical_path_t), intent(inout) :: self
        real(dp), intent(in) :: x
        real(dp) :: y
        type(hyperdual_t) :: path

        path = self%length(hyperdual_t(x, 1.0_dp, 0.0_dp, 0.0_dp))
        y = path%d1
    end function derivative

    pure function at(self, x) result(y)
        !! The optical path itself, m.
        class(optical_path_t), intent(in) :: self
        real(dp), intent(in) :: x
        real(dp) :: y
        type(hyperdual_t) :: path

        path = self%length(hyperdual_t(re=x))
        y = path%re
    end function at

    pure function second_derivative(self, x) result(y)
        !! Positive where the path is shortest, negative where it is longest.
        class(optical_path_t), intent(in) :: self
        real(dp), intent(in) :: x
        real(dp) :: y
        type(hyperdual_t) :: path

        path = self%length(hyperdual_t(x, 1.0_dp, 1.0_dp, 0.0_dp))
        y = path%d12
    end function second_derivative

    subroutine stationary_point(self, lower, upper, u, error)
        !! Where the derivative vanishes between `lower` and `upper`, by Brent's method.
        class(optical_path_t), intent(in) :: self
        real(dp), intent(in) :: lower, upper
        real(dp), intent(out) :: u
        type(error_t), allocatable, intent(out) :: error
        class(optical_path_t), allocatable :: path

        allocate (path, source=self)
        call brent_root(path, lower, upper, u, error)
    end subroutine stationary_point

    pure function by_flat_mirror(self, u) result(path)
        !! \(\sqrt{a^2 + x^2} + \sqrt{b^2 + (d - x)^2}\).
        class(flat_mirror_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: u
        type(hyperdual_t) :: path

        path = sqrt(self%a**2 + u**2) + sqrt(self%b**2 + (self%d - u)**2)
    end function by_flat_mirror

    pure function by_concave_mirror(self, u) result(path)
        !! \(\sqrt{R^2 + s^2 + 2Rs\sin u} + \sqrt{R^2 + s^2 - 2Rs\sin u}\).
        class(concave_mirror_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: u
        type(hyperdual_t) :: path

        associate (c => self%r**2 + self%s**2, e => 2.0_dp*self%r*self%s)
            path = sqrt(c + e*sin(u)) + sqrt(c - e*sin(u))
        end associate
    end function by_concave_mirror

    pure function by_elliptic_mirror(self, u) result(path)
        !! Distances from \((a\sin u, b\cos u)\) to the foci \((\pm\sqrt{a^2 - b^2}, 0)\).
        class(elliptic_mirror_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: u
        type(hyperdual_t) :: path, x, y
        real(dp) :: focus

        focus = sqrt(self%a**2 - self%b**2)
        x = self%a*sin(u)
        y = self%b*cos(u)
        path = sqrt((x + focus)**2 + y**2) + sqrt((x - focus)**2 + y**2)
    end function by_elliptic_mirror

    pure function through_surface(self, u) result(path)
        !! \(n_1\sqrt{a^2 + x^2} + n_2\sqrt{b^2 + (d - x)^2}\).
        class(surface_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: u
        type(hyperdual_t) :: path

        path = self%n1*sqrt(self%a**2 + u**2) + self%n2*sqrt(self%b**2 + (self%d - u)**2)
    end function through_surface

    function quartic(self, x) result(y)
        !! \((n_1^2-n_2^2)(x^4 - 2dx^3) + [n_1^2(b^2+d^2) - n_2^2(a^2+d^2)]x^2 + 2a^2dn_2^2x
        !! - a^2d^2n_2^2\).
        class(quartic_t), intent(inout) :: self
        real(dp), intent(in) :: x
        real(dp) :: y

        associate (a => self%surface%a, b => self%surface%b, d => self%surface%d, &
                   p => self%surface%n1**2, q => self%surface%n2**2)
            y = (p - q)*(x - 2.0_dp*d)*x**3 + (p*(b**2 + d**2) - q*(a**2 + d**2))*x**2 &
                + a**2*d*q*(2.0_dp*x - d)
        end associate
    end function quartic
end module lagrangia_optical_paths
