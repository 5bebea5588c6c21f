module liars
    !! Systems whose equations are right and who say something else of themselves that is not.
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: cos, hyperdual_t, operator(*), operator(**), operator(+), &
                                   operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_rolling_disk, only: rolling_disk_t
    use lagrangia_system, only: lanes, system_t
    implicit none (type, external)
    private
    public :: new_liar, liars_known

    integer, parameter :: liars_known = 18

    type, extends(cart_pendulum_t) :: liar_t
        !! The cart-pendulum, with one lie.
        integer :: lie = 0
    contains
        procedure :: describe => describe_liar
        procedure :: configure => configure_liar
        procedure :: lagrangian => lagrangian_liar
        procedure :: energy => energy_liar
        procedure :: quantity => quantity_liar
        procedure :: positions => positions_liar
        procedure :: newton => newton_liar
        procedure :: momenta => momenta_liar
        procedure :: forces => forces_liar
        procedure :: velocities => velocities_liar
        procedure :: accelerations_lanes => lanes_liar
    end type liar_t

    type, extends(rolling_disk_t) :: slipping_t
        !! Its rolling condition is not the one that its accelerations keep.
    contains
        procedure :: constraint_rows => rows_of_another
    end type slipping_t

contains

    subroutine new_liar(k, system, expected, unharmed)
        !! Liar `k`, the claim that must fail and one that must not.
        integer, intent(in) :: k
        class(system_t), allocatable, intent(out) :: system
        character(:), allocatable, intent(out) :: expected, unharmed

        unharmed = "accelerations as from L"
        if (k < liars_known) allocate (system, source=liar_t(lie=k))
        select case (k)
        case (1); expected = "velocity_forces says what is true"
        case (2); expected = "time_dependent says what is true"
        case (3); expected = "the cyclic coordinate is cyclic"
        case (4); expected = "energy is v dL/dv - L"
        case (5); expected = "p_x is conserved"
        case (6); expected = "tension is conserved"
        case (7); expected = "Gauss's tension"
        case (8); expected = "positions keep the constraints"
        case (9); expected = "Gauss's least constraint"
        case (10); expected = "momenta are dL/dv"
        case (11); expected = "forces are dL/dq"
        case (12); expected = "velocities from momenta"
        case (13); expected = "accelerations in lanes"
        case (14)
            expected = "accelerations as from L"  ! for once it is L that is wrong
            unharmed = "Gauss's least constraint"
        case (15)
            expected = "points carry the inertia"
            unharmed = "Gauss's least constraint"
        case (16)
            expected = "mass matrix is positive definite"
            unharmed = "Gauss's least constraint"
        case (17); expected = "Gauss's least constraint"
        case default
            allocate (slipping_t :: system)
            expected = "accelerations keep the constraints"
            unharmed = "Gauss's least constraint"
        end select
    end subroutine new_liar

    pure subroutine describe_liar(self, d)
        !! 6: a tension that is said to stay.
        class(liar_t), intent(in) :: self
        type(description_t), intent(out) :: d

        call self%cart_pendulum_t%describe(d)
        if (self%lie == 6) d%quantities(3)%conserved = .true.
    end subroutine describe_liar

    pure subroutine configure_liar(self, values, error)
        !! 1, 2, 3: flags.
        class(liar_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        call self%cart_pendulum_t%configure(values, error)
        if (self%lie == 1) self%velocity_forces = .false.
        if (self%lie == 2) self%time_dependent = .true.
        if (self%lie == 3) self%cyclic = 2
    end subroutine configure_liar

    pure function lagrangian_liar(self, t, q, v) result(l)
        !! 14: without the cross term, as on the page. 15, 16: with more or less inertia.
        class(liar_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = self%cart_pendulum_t%lagrangian(t, q, v)
        if (self%lie == 14) l = l - self%m2*self%l*v(1)*v(2)*cos(q(2))
        if (self%lie == 15) l = l + 0.5_dp*v(1)**2
        if (self%lie == 16) l = l - 2.0_dp*(self%m1 + self%m2)*v(1)**2
    end function lagrangian_liar

    pure function energy_liar(self, t, q, v) result(e)
        !! 4: the potential with the wrong sign.
        class(liar_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = self%cart_pendulum_t%energy(t, q, v)
        if (self%lie == 4) e = e + 2.0_dp*self%m2*self%g*self%l*cos(q(2))
    end function energy_liar

    pure function quantity_liar(self, i, t, q, v) result(value)
        !! 5: a momentum of the cart alone. 7: the tension of a rod on a fixed pivot.
        class(liar_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value

        value = self%cart_pendulum_t%quantity(i, t, q, v)
        if (self%lie == 5 .and. i == 1) value = (self%m1 + self%m2)*v(1)
        if (self%lie == 7 .and. i == 3) value = self%m2*(self%l*v(2)**2 + self%g*cos(q(2)))
    end function quantity_liar

    pure subroutine positions_liar(self, t, q, r)
        !! 8: a rod longer than it says.
        class(liar_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)

        call self%cart_pendulum_t%positions(t, q, r)
        if (self%lie == 8) r(2, 2) = 1.1_dp*r(2, 2)
    end subroutine positions_liar

    pure subroutine newton_liar(self, t, x, u, force, constraint_residual)
        !! 9: a bob without weight. 17: a constraint that binds nothing.
        class(liar_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)
        real(dp), intent(out) :: force(:)
        type(hyperdual_t), intent(out) :: constraint_residual(:)

        call self%cart_pendulum_t%newton(t, x, u, force, constraint_residual)
        if (self%lie == 9) force(5) = 0.0_dp
        if (self%lie == 17) constraint_residual = hyperdual_t()
    end subroutine newton_liar

    pure subroutine momenta_liar(self, t, q, v, p)
        !! 10: \(p_x\) of the cart alone.
        class(liar_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: p(self%ndof)

        call self%cart_pendulum_t%momenta(t, q, v, p)
        if (self%lie == 10) p(1) = (self%m1 + self%m2)*v(1)
    end subroutine momenta_liar

    pure subroutine forces_liar(self, t, q, v, f)
        !! 11: without the term of the velocities.
        class(liar_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: f(self%ndof)

        call self%cart_pendulum_t%forces(t, q, v, f)
        if (self%lie == 11) call self%cart_pendulum_t%forces(t, q, 0.0_dp*v, f)
    end subroutine forces_liar

    pure subroutine velocities_liar(self, t, q, p, v)
        !! 12: one of them too large by a tenth.
        class(liar_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), p(self%ndof)
        real(dp), intent(out) :: v(self%ndof)

        call self%cart_pendulum_t%velocities(t, q, p, v)
        if (self%lie == 12) v(2) = 1.1_dp*v(2)
    end subroutine velocities_liar

    pure subroutine lanes_liar(self, t, q, v, a)
        !! 13: the last lane is another's.
        class(liar_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)

        call self%cart_pendulum_t%accelerations_lanes(t, q, v, a)
        if (self%lie == 13) a(lanes, 1) = 1.01_dp*a(lanes, 1)
    end subroutine lanes_liar

    pure subroutine rows_of_another(self, t, q, rows, drift)
        !! A disk of another radius.
        class(slipping_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: rows(:, :), drift(:)

        call self%rolling_disk_t%constraint_rows(t, q, rows, drift)
        rows(:, 3) = 1.1_dp*rows(:, 3)
    end subroutine rows_of_another
end module liars
