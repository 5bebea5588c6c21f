module lagrangia_test_potentials
    !! A charge in potentials that are made up: \(\varphi(x, t)\) and \(A(x, t)\) of no symmetry.
    use lagrangia_description, only: coordinate, description_t, positive, real_number
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: cos, dot_product, exp, hyperdual, hyperdual_t, operator(*), &
                                   operator(**), operator(+), operator(-), sin
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: check_parameters, system_t
    implicit none (type, external)
    private
    public :: test_charge_t

    type, extends(system_t) :: test_charge_t
        !! Coordinates: x, y, z, m.
        real(dp) :: m = 1.0_dp
        real(dp) :: charge = 1.0_dp
        logical :: curl_free = .false.  !! \(A = \nabla\chi\), so that \(B = 0\)
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: lagrangian
        procedure :: energy
        procedure :: positions
        procedure :: potentials
        procedure :: potential
        procedure :: fields
    end type test_charge_t

contains

    pure subroutine describe(self, d)
        !! See `system_t`.
        class(test_charge_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "test_charge"
        d%title = "a charge in potentials without symmetry"
        d%coordinates = [coordinate("x", "m", "position"), coordinate("y", "m", "position"), &
                         coordinate("z", "m", "position")]
        d%parameters = [positive("m", "kg", "mass", self%m), &
                        real_number("charge", "C", "charge", self%charge)]
        allocate (d%quantities(0), d%notes(0))
        d%dimensions = 3
        d%energy_scale = self%m
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! Parameters: m, charge.
        class(test_charge_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call check_parameters(self, values, error)
        if (allocated(error)) return
        self%ndof = 3
        self%time_dependent = .true.
        self%m = values(1)
        self%charge = values(2)
    end subroutine configure

    pure subroutine potentials(self, t, q, phi, a)
        !! \(\varphi = xy\,e^{-t} + z^2\sin x\), \(A = (yzt,\; x^2\cos t + z,\; \sin(xy) + tz)\);
        !! or \(A = \nabla\chi\) of \(\chi = x^2y\cos t + yzt\).
        class(test_charge_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(3)  !! s; m
        type(hyperdual_t), intent(out) :: phi, a(3)  !! \(\varphi\), V; \(A\), V s/m

        phi = q(1)*q(2)*exp((-1.0_dp)*t) + q(3)**2*sin(q(1))
        if (self%curl_free) then
            a(1) = 2.0_dp*q(1)*q(2)*cos(t)
            a(2) = q(1)**2*cos(t) + q(3)*t
            a(3) = q(2)*t
        else
            a(1) = q(2)*q(3)*t
            a(2) = q(1)**2*cos(t) + q(3)
            a(3) = sin(q(1)*q(2)) + t*q(3)
        end if
    end subroutine potentials

    pure function potential(self, t, q, v) result(u)
        !! $$ U = e\varphi - e\,A\cdot v $$
        class(test_charge_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(3), v(3)  !! s; m; m/s
        type(hyperdual_t) :: u, phi, a(3)

        call self%potentials(t, q, phi, a)
        u = self%charge*(phi - dot_product(a, v))
    end function potential

    pure subroutine fields(self, t, q, slope, induced, magnetic)
        !! \(-\nabla\varphi\), \(-\partial A/\partial t\), E their sum; \(B = \nabla\times A\).
        class(test_charge_t), intent(in) :: self
        real(dp), intent(in) :: t, q(3)  !! s; m
        real(dp), intent(out) :: slope(3), induced(3), magnetic(3)
        !! \(-\nabla\varphi\), \(-\partial A/\partial t\), V/m; \(B\), T
        type(hyperdual_t) :: phi, a(3), qq(3)
        real(dp) :: da(3, 3)  !! \(\partial A_i/\partial x_j\)
        integer :: j

        do j = 1, 3
            qq = hyperdual(q)
            qq(j)%d1 = 1.0_dp
            call self%potentials(hyperdual(t), qq, phi, a)
            slope(j) = -phi%d1
            da(:, j) = a%d1
        end do
        qq = hyperdual(q)
        call self%potentials(hyperdual_t(t, 1.0_dp, 0.0_dp, 0.0_dp), qq, phi, a)
        induced = -a%d1
        magnetic = [da(3, 2) - da(2, 3), da(1, 3) - da(3, 1), da(2, 1) - da(1, 2)]
    end subroutine fields

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ m\dot v = e\,(E + v\times B) $$
        class(test_charge_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        real(dp) :: slope(3), induced(3), b(3)

        call self%fields(t, q, slope, induced, b)
        a = self%charge/self%m*(slope + induced + [v(2)*b(3) - v(3)*b(2), &
                                                   v(3)*b(1) - v(1)*b(3), v(1)*b(2) - v(2)*b(1)])
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L = \tfrac12mv^2 - U $$
        class(test_charge_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*self%m*dot_product(v, v) - self%potential(t, q, v)
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! $$ \tfrac12mv^2 + e\varphi $$
        class(test_charge_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e
        type(hyperdual_t) :: phi, a(3)

        call self%potentials(hyperdual(t), hyperdual(q), phi, a)
        e = 0.5_dp*self%m*dot_product(v, v) + self%charge*phi%re
    end function energy

    pure subroutine positions(self, t, q, r)
        !! The coordinates are Cartesian.
        class(test_charge_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        r(:, 1) = q
    end subroutine positions
end module lagrangia_test_potentials
