module biased_liars
    !! For every claim of the audit two systems that are wrong about it by the same amount at every
    !! state, one above the truth and one below: a judge that sees one side only lets one pass.
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_hyperdual, only: hyperdual_t, operator(*), operator(**), operator(+), operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_rolling_disk, only: rolling_disk_t
    use lagrangia_system, only: lanes, system_t
    implicit none (type, external)
    private
    public :: new_biased_liar, biased_claims

    integer, parameter :: biased_claims = 19
    real(dp), parameter :: amount = 1e-11_dp   !! of what is known to rounding
    real(dp), parameter :: slope = 1e-9_dp     !! of what is known from differences

    type, extends(cart_pendulum_t) :: biased_cart_t
        !! Lies about the claim of number `lie`.
        integer :: lie = 0
        real(dp) :: bias = 0.0_dp
    contains
        procedure :: configure => configure_biased
        procedure :: accelerations => accelerations_biased
        procedure :: accelerations_lanes => lanes_biased
        procedure :: lagrangian => lagrangian_biased
        procedure :: energy => energy_biased
        procedure :: quantity => quantity_biased
        procedure :: positions => positions_biased
        procedure :: newton => newton_biased
        procedure :: momenta => momenta_biased
        procedure :: forces => forces_biased
        procedure :: velocities => velocities_biased
    end type biased_cart_t

    type, extends(oscillator_t) :: biased_oscillator_t
        !! With friction or a drive its energy changes otherwise.
        real(dp) :: bias = 0.0_dp
    contains
        procedure :: energy => energy_drifts
    end type biased_oscillator_t

    type, extends(rolling_disk_t) :: biased_disk_t
        !! Its constraint, or the rate of it, is not zero.
        real(dp) :: value = 0.0_dp, rate = 0.0_dp
    contains
        procedure :: constraint_rows => rows_biased
    end type biased_disk_t

contains

    subroutine new_biased_liar(k, way, system, claim)
        !! Liar `k`, up (`way` = 1) or down (-1), and the claim that must fail.
        integer, intent(in) :: k, way
        class(system_t), allocatable, intent(out) :: system
        character(:), allocatable, intent(out) :: claim

        if (k < 17) allocate (system, source=biased_cart_t(lie=k, bias=way*merge(slope, amount, &
                                                                              any(k == [4, 5]))))
        select case (k)
        case (1); claim = "accelerations as from L"
        case (2); claim = "accelerations in lanes"
        case (3); claim = "energy is v dL/dv - L"
        case (4); claim = "energy changes by -dL/dt"
        case (5); claim = "p_x is conserved"
        case (6); claim = "momenta are dL/dv"
        case (7); claim = "forces are dL/dq"
        case (8); claim = "velocities from momenta"
        case (9); claim = "Gauss's tension"
        case (10); claim = "Gauss's least constraint"
        case (11); claim = "positions keep the constraints"
        case (12); claim = "points carry the inertia"
        case (13); claim = "the cyclic coordinate is cyclic"
        case (14); claim = "parameters are what was given"
        case (15)  ! below: indefinite; above: as many, but singular
            claim = "mass matrix is positive definite"
        case (16); claim = "parameters and states are taken"
        case (17)
            allocate (system, source=biased_disk_t(value=way*amount))
            claim = "velocities keep the constraints"
        case (18)
            allocate (system, source=biased_disk_t(rate=way*amount))
            claim = "accelerations keep the constraints"
        case default
            allocate (system, source=biased_oscillator_t(bias=way*slope))
            claim = "energy changes by Q v - dL/dt"
        end select
    end subroutine new_biased_liar

    pure subroutine configure_biased(self, values, error)
        class(biased_cart_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call self%cart_pendulum_t%configure(values, error)
        if (self%lie == 14) self%l = self%l*(1.0_dp + self%bias)
        if (self%lie == 16 .and. abs(values(4)) > 0.0_dp) call fail(error, "no gravity is wanted")
    end subroutine configure_biased

    pure subroutine accelerations_biased(self, t, q, v, a)
        class(biased_cart_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        call self%cart_pendulum_t%accelerations(t, q, v, a)
        if (self%lie == 1) a(2) = a(2) + self%bias
    end subroutine accelerations_biased

    pure subroutine lanes_biased(self, t, q, v, a)
        class(biased_cart_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)

        call self%cart_pendulum_t%accelerations_lanes(t, q, v, a)
        if (self%lie == 2) a(lanes, 2) = a(lanes, 2) + self%bias
    end subroutine lanes_biased

    pure function lagrangian_biased(self, t, q, v) result(l)
        class(biased_cart_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = self%cart_pendulum_t%lagrangian(t, q, v)
        if (self%lie == 12) l = l + self%bias*v(2)**2
        if (self%lie == 13) l = l + self%bias*q(1)
        if (self%lie /= 15) return
        if (self%bias < 0.0_dp) then
            l = l - 2.0_dp*(self%m1 + self%m2)*v(1)**2
        else
            l = 0.5_dp*self%m1*(v(1) + v(2))**2
        end if
    end function lagrangian_biased

    pure function energy_biased(self, t, q, v) result(e)
        class(biased_cart_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = self%cart_pendulum_t%energy(t, q, v)
        if (self%lie == 3) e = e + self%bias
        if (self%lie == 4) e = e + self%bias*t
    end function energy_biased

    pure function energy_drifts(self, t, q, v) result(e)
        class(biased_oscillator_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = self%oscillator_t%energy(t, q, v) + self%bias*t
    end function energy_drifts

    pure function quantity_biased(self, i, t, q, v) result(value)
        class(biased_cart_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value

        value = self%cart_pendulum_t%quantity(i, t, q, v)
        if (self%lie == 5 .and. i == 1) value = value + self%bias*t
        if (self%lie == 9 .and. i == 3) value = value + self%bias
    end function quantity_biased

    pure subroutine positions_biased(self, t, q, r)
        class(biased_cart_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        call self%cart_pendulum_t%positions(t, q, r)
        if (self%lie == 11) r(2, 2) = (1.0_dp + self%bias)*r(2, 2)
    end subroutine positions_biased

    pure subroutine newton_biased(self, t, x, u, force, constraint_residual)
        class(biased_cart_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)

        call self%cart_pendulum_t%newton(t, x, u, force, constraint_residual)
        if (self%lie == 10) force(1) = force(1) + self%bias
    end subroutine newton_biased

    pure subroutine momenta_biased(self, t, q, v, p)
        class(biased_cart_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: p(self%ndof)

        call self%cart_pendulum_t%momenta(t, q, v, p)
        if (self%lie == 6) p(1) = p(1) + self%bias
    end subroutine momenta_biased

    pure subroutine forces_biased(self, t, q, v, f)
        class(biased_cart_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: f(self%ndof)

        call self%cart_pendulum_t%forces(t, q, v, f)
        if (self%lie == 7) f(2) = f(2) + self%bias
    end subroutine forces_biased

    pure subroutine velocities_biased(self, t, q, p, v)
        class(biased_cart_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), p(self%ndof)
        real(dp), intent(out) :: v(self%ndof)

        call self%cart_pendulum_t%velocities(t, q, p, v)
        if (self%lie == 8) v(2) = v(2) + self%bias
    end subroutine velocities_biased

    pure subroutine rows_biased(self, t, q, rows, drift)
        class(biased_disk_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: rows(:, :), drift(:)

        call self%rolling_disk_t%constraint_rows(t, q, rows, drift)
        drift(1)%re = drift(1)%re + self%value
        drift(1)%d1 = drift(1)%d1 + self%rate
    end subroutine rows_biased
end module biased_liars
