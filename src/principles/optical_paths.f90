module lagrangia_optical_paths
    !! Optical paths from one point to another by way of a mirror or a surface, as functions of
    !! where the ray touches it.
    !!
    !! And light in a medium whose index depends on the height, as a mechanical system: with
    !! \(d\sigma = ds/n\) a ray obeys \(r'' = \tfrac12\nabla n^2\), as a particle with potential
    !! \(-n^2/2\) and energy zero, \(|r'| = n\). The "time" of this system is \(\sigma\), m.
    !!
    !! Source: Evans & Rosenquist, Am. J. Phys. 54, 876 (1986).
    use lagrangia_description, only: coordinate, description_t, mass_point, nonnegative, &
                                     positive, real_number
    use lagrangia_errors, only: error_t
    use lagrangia_gsl, only: brent_root
    use lagrangia_hyperdual, only: cos, hyperdual_t, operator(*), operator(**), operator(+), &
                                   operator(-), sin, sqrt
    use lagrangia_kinds, only: dp
    use lagrangia_roots, only: scalar_function_t
    use lagrangia_system, only: check_parameters, system_t
    implicit none (type, external)
    private
    public :: optical_path_t, flat_mirror_t, concave_mirror_t, elliptic_mirror_t, surface_t
    public :: quartic_t, second_derivative, stationary_point
    public :: graded_medium_t

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

    type, extends(system_t) :: graded_medium_t
        !! Coordinates: \(x\) along the layers, \(y\) across, m.
        real(dp) :: n0 = 1.0_dp     !! index at \(y = 0\)
        real(dp) :: kappa = 0.0_dp  !! 1/m: \(n^2 = n_0^2 + 2\kappa y - n_0^2\alpha^2y^2\)
        real(dp) :: alpha = 0.0_dp  !! 1/m
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: lagrangian
        procedure :: energy
        procedure :: index_squared
    end type graded_medium_t

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
        real(dp), intent(in) :: x  !! where the ray touches
        real(dp) :: y
        type(hyperdual_t) :: path

        path = self%length(hyperdual_t(re=x))
        y = path%re
    end function at

    pure function second_derivative(self, x) result(y)
        !! Positive where the path is shortest, negative where it is longest.
        class(optical_path_t), intent(in) :: self  !! the path
        real(dp), intent(in) :: x  !! where the ray touches
        real(dp) :: y
        type(hyperdual_t) :: path

        path = self%length(hyperdual_t(x, 1.0_dp, 1.0_dp, 0.0_dp))
        y = path%d12
    end function second_derivative

    subroutine stationary_point(self, lower, upper, u, error)
        !! Where the derivative vanishes between `lower` and `upper`, by Brent's method.
        class(optical_path_t), intent(in) :: self  !! the path
        real(dp), intent(in) :: lower, upper  !! the derivative changes its sign between them
        real(dp), intent(out) :: u  !! where the ray touches
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
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

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(graded_medium_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "graded_medium"
        d%title = "light in a medium whose index depends on the height"
        d%coordinates = [coordinate("x", "m", "along the layers"), &
                         coordinate("y", "m", "across the layers")]
        d%parameters = [positive("n0", "1", "index at y = 0", self%n0), &
                        real_number("kappa", "1/m", "half the slope of n^2 at y = 0", self%kappa), &
                        nonnegative("alpha", "1/m", "over how many m n falls, inverse", self%alpha)]
        allocate (d%quantities(0), d%notes(0))
        d%points = [mass_point("ray", 1.0_dp)]
        d%energy_scale = self%n0**2
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! Parameters: n0, kappa, alpha.
        class(graded_medium_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call check_parameters(self, values, error)
        if (allocated(error)) return
        self%ndof = 2
        self%velocity_forces = .false.
        self%cyclic = 1
        self%n0 = values(1)
        self%kappa = values(2)
        self%alpha = values(3)
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ x'' = 0,\qquad y'' = \kappa - n_0^2\alpha^2y $$
        class(graded_medium_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a(1) = 0.0_dp
        a(2) = self%kappa - (self%n0*self%alpha)**2*q(2)
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L = \tfrac12(x'^2 + y'^2) + \tfrac12n^2(y) $$
        class(graded_medium_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*(v(1)**2 + v(2)**2 + self%n0**2 + 2.0_dp*self%kappa*q(2) &
                    - (self%n0*self%alpha*q(2))**2)
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! $$ \tfrac12(x'^2 + y'^2 - n^2) $$ Zero on a ray.
        class(graded_medium_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = 0.5_dp*(v(1)**2 + v(2)**2 - self%index_squared(q(2)))
    end function energy

    elemental function index_squared(self, y) result(n2)
        !! \(n^2 = n_0^2 + 2\kappa y - n_0^2\alpha^2y^2\).
        class(graded_medium_t), intent(in) :: self
        real(dp), intent(in) :: y  !! height, m
        real(dp) :: n2

        n2 = self%n0**2 + 2.0_dp*self%kappa*y - (self%n0*self%alpha*y)**2
    end function index_squared
end module lagrangia_optical_paths
