module lagrangia_graded_medium
    !! Light in a medium whose index depends on the height, as a mechanical system.
    !!
    !! With \(d\sigma = ds/n\) a ray obeys \(r'' = \tfrac12\nabla n^2\): a particle with potential
    !! \(-n^2/2\) and energy zero, \(|r'| = n\). The "time" of this system is \(\sigma\), m.
    !!
    !! Source: Evans & Rosenquist, Am. J. Phys. 54, 876 (1986).
    use lagrangia_description, only: coordinate, description_t, nonnegative, number, point, positive
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t, operator(*), operator(**), operator(+), operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: check_parameters, system_t
    implicit none (type, external)
    private
    public :: graded_medium_t

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

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(graded_medium_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "graded_medium"
        d%title = "light in a medium whose index depends on the height"
        d%coordinates = [coordinate("x", "m", "along the layers"), &
                         coordinate("y", "m", "across the layers")]
        d%parameters = [positive("n0", "1", "index at y = 0", self%n0), &
                        number("kappa", "1/m", "n^2 = n0^2 + 2 kappa y", self%kappa), &
                        nonnegative("alpha", "1/m", "n^2 = n0^2 (1 - alpha^2 y^2)", self%alpha)]
        allocate (d%quantities(0), d%notes(0))
        d%points = [point("ray", 1.0_dp)]
        d%energy_scale = self%n0**2
        d%lagrangian = [character(len(d%title)) :: "(x_dot^2 + y_dot^2 + n^2)/2"]
        d%energy = "(x_dot^2 + y_dot^2 - n^2)/2"
        d%equations = [character(len(d%title)) :: "x_ddot = 0", &
                       "y_ddot = kappa - n0^2 alpha^2 y"]
        d%constraint = "none"
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
        real(dp), intent(in) :: y
        real(dp) :: n2

        n2 = self%n0**2 + 2.0_dp*self%kappa*y - (self%n0*self%alpha*y)**2
    end function index_squared
end module lagrangia_graded_medium
