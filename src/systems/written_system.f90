module lagrangia_written_system
    !! A system in formulas, as a scene's group `&lagrangian` has them: T and V, or L, and Q.
    !!
    !! The formulas are read once; where the parameters are set, they are compiled with these
    !! numbers in them, to programs of t, the coordinates and the velocities, in this order.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_description, only: description_t, quantity, quantity_t, unit_over
    use lagrangia_elimination, only: solve_positive
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_lagrangian_system, only: find_structure, lagrangian_system_t
    use lagrangia_magnitude, only: magnitude
    use lagrangia_written_dependence, only: find_dependence
    use lagrangia_written_description, only: collect_constants, state_formulas, state_places
    use lagrangia_written_equations, only: write_equations
    use lagrangia_written_expressions, only: written_expressions_t
    use lagrangia_written_formulas, only: written_formulas_t
    use lagrangia_written_motion, only: derive_motion, invert_momenta, leave_out_what_cancels, &
                                        solve_motion, written_motion_t
    use lagrangia_written_quantities, only: find_conserved
    implicit none (type, external)
    private
    public :: is_positive, new_written_system, of_momentum, written_system_t

    ! programs of a system
    integer, parameter :: of_l = 1         !! L
    integer, parameter :: of_motion = 2    !! of `solved`
    integer, parameter :: of_inverse = 3   !! of `inverse`, of t, q, p
    integer, parameter :: of_momentum = 4  !! p, then M column by column
    integer, parameter :: of_slope = 5     !! dL/dq
    integer, parameter :: of_energy = 6    !! v p - L
    integer, parameter :: of_force = 7     !! Q of each coordinate
    integer, parameter :: of_place = 8     !! x, y, z of each point, m
    integer, parameter :: of_constant = 9  !! masses of points and rotors, then the equilibrium
    integer, parameter :: of_quantity = 10   !! the scene's own quantities
    integer, parameter :: of_magnitude = 11  !! of the energy, momenta, own quantities
    integer, parameter :: of_angle = 12      !! of each rotor, rad

    integer, parameter :: room = 256  !! registers on the stack

    type, extends(lagrangian_system_t) :: written_system_t
        !! Made by `new_written_system`, with the parameters of the formulas.
        type(description_t) :: stated                !! all but what follows from the parameters
        type(written_expressions_t) :: expressions
        type(written_motion_t) :: motion             !! what follows from L and Q
        type(expression_t), allocatable :: solved(:) !! accelerations, pivots, diagonal of M
        type(expression_t), allocatable :: inverse(:)  !! velocities, pivots, diagonal of M
        logical :: is_quadratic = .false.            !! `inverse` holds
        type(formula_program_t), allocatable :: programs(:)  !! gfortran 12 would not free each
        logical, allocatable :: is_conserved(:)      !! of each quantity of the scene's own
    contains
        procedure :: outline
        procedure :: prepare
        procedure :: lagrangian
        procedure :: generalised_forces
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: momenta
        procedure :: velocities
        procedure :: forces => slopes
        procedure :: energy
        procedure :: find_structure => find_all_structure
        procedure :: quantity => momentum_or_own
        procedure :: natural_size
        procedure :: positions
        procedure :: angles
    end type written_system_t

contains

    subroutine new_written_system(formulas, expressions, system, error)
        !! A system from its formulas.
        type(written_formulas_t), intent(in) :: formulas        !! with values of the parameters
        type(written_expressions_t), intent(in) :: expressions  !! what the formulas mean
        type(written_system_t), intent(out) :: system           !! configured with these values
        type(error_t), allocatable, intent(out) :: error        !! a value that is not allowed
        type(expression_t), allocatable :: constants(:)
        integer :: i

        system%expressions = expressions
        allocate (system%programs(of_angle))
        associate (e => system%expressions, d => system%stated)
            d%name = formulas%name
            d%named_in_scene = .true.
            d%title = formulas%title
            d%coordinates = formulas%coordinates
            d%parameters = formulas%parameters
            call state_places(e, d)
            call state_formulas(formulas, e, d)
            call collect_constants(e, constants)
            call new_formula_program(system%programs(of_constant), constants, size(e%symbols%names))
            call leave_out_what_cancels(e%lagrangian, 1 + 2*size(d%coordinates), e%symbols)
            call derive_motion(e%lagrangian, e%forces, e%symbols, system%motion)
            call write_equations(system%motion, e%forces, e%symbols, d)
            call solve_motion(system%motion, system%solved)
            call invert_momenta(system%motion, e%symbols, system%inverse, system%is_quadratic)
        end associate
        call system%configure([(formulas%parameters(i)%value(1), i=1, &
                                size(formulas%parameters))], error)
    end subroutine new_written_system

    pure subroutine outline(self, d)
        !! What was stated, and what follows from the parameters: masses, an equilibrium, and which
        !! momenta are conserved.
        class(written_system_t), intent(in) :: self
        type(description_t), intent(out) :: d
        real(dp) :: values(size(self%expressions%symbols%names))
        real(dp) :: constants(self%programs(of_constant)%outputs)
        type(quantity_t) :: items(size(self%stated%coordinates) + size(self%stated%quantities))
        integer :: i, k, n

        d = self%stated
        n = size(d%coordinates)
        do i = 1, n
            associate (q => d%coordinates(i))
                items(i) = quantity("p_"//trim(q%name), unit_over(q%unit, "J s", "kg m/s", &
                                    "kg m^2/s"), "momentum dL/d"//trim(q%name)//"_dot")
                if (.not. allocated(self%cyclic_coordinates)) cycle
                if (.not. self%cyclic_coordinates(i)) cycle
                items(i)%conserved = .true.
                items(i)%meaning = trim(items(i)%meaning)//": "//trim(q%name)//" is cyclic"
            end associate
        end do
        items(n + 1:) = d%quantities
        if (allocated(self%is_conserved)) items(n + 1:)%conserved = self%is_conserved
        d%quantities = items
        values = 0.0_dp
        k = 1 + 2*n
        do i = 1, size(d%parameters)
            values(k + i) = self%value(i, d%parameters(i)%value(1))
        end do
        call self%programs(of_constant)%evaluate(values, constants)
        k = size(d%points)
        d%points%mass = constants(:k)
        d%rotors%mass = constants(k + 1:k + size(d%rotors))
        k = k + size(d%rotors)
        if (size(constants) > k) d%equilibrium = constants(k + 1:)
        if (.not. (allocated(d%typical_places) .and. allocated(self%p))) return
        values(:size(self%p)) = [(d%parameters(i)%value(1), i=1, size(self%p))]
        associate (p => abs(self%p), stated => abs(values(:size(self%p))))
            if (all(p <= 4.0_dp*stated .and. stated <= 4.0_dp*p)) return
        end associate
        deallocate (d%typical_places)  ! those of other parameters
        d%typical_time = 1.0_dp
    end subroutine outline

    pure subroutine prepare(self)
        !! Compile all formulas of the state, with numbers for the parameters.
        class(written_system_t), intent(inout) :: self
        type(expression_t) :: one(1), all(self%ndof + self%ndof**2)
        type(expression_t), allocatable :: sizes(:)
        logical :: fixed(size(self%expressions%symbols%names))
        real(dp) :: values(size(fixed))
        integer :: i, j, k, n

        k = 1 + 2*self%ndof
        n = self%ndof
        fixed = [(i > k, i=1, size(fixed))]
        values(:k) = 0.0_dp
        values(k + 1:) = self%p
        associate (e => self%expressions, motion => self%motion)
            one(1) = e%lagrangian
            call new_formula_program(self%programs(of_l), one, k, fixed, values)
            one(1) = motion%energy
            call new_formula_program(self%programs(of_energy), one, k, fixed, values)
            call new_formula_program(self%programs(of_motion), self%solved, k, fixed, values)
            if (self%is_quadratic) call new_formula_program( &
                self%programs(of_inverse), self%inverse, k, fixed, values)
            call new_formula_program(self%programs(of_slope), motion%slopes, k, fixed, values)
            call new_formula_program(self%programs(of_force), e%forces, k, fixed, values)
            call new_formula_program(self%programs(of_place), e%places, k, fixed, values)
            call new_formula_program(self%programs(of_angle), e%angles, k, fixed, values)
            do j = 1, n
                all(j) = motion%momenta(j)
                do i = 1, n
                    all(n*j + i) = motion%mass(i, j)
                end do
            end do
            call new_formula_program(self%programs(of_momentum), all, k, fixed, values)
            call new_formula_program(self%programs(of_quantity), e%quantities, k, fixed, values)
            allocate (sizes(1 + n + size(e%quantities)))
            sizes(1) = magnitude(motion%energy)
            do i = 1, n
                sizes(1 + i) = magnitude(motion%momenta(i))
            end do
            do i = 1, size(e%quantities)
                sizes(1 + n + i) = magnitude(e%quantities(i))
            end do
            call new_formula_program(self%programs(of_magnitude), sizes, k, fixed, values)
        end associate
    end subroutine prepare

    pure subroutine find_all_structure(self)
        !! That of any Lagrangian, and which quantities of the scene's own are conserved.
        class(written_system_t), intent(inout) :: self

        call find_structure(self)
        call find_dependence(self, self%expressions, self%motion)
        call find_conserved(self, self%programs(of_quantity), self%expressions%lagrangian, &
            self%expressions%forces, self%expressions%constraints, self%is_conserved)
    end subroutine find_all_structure

    pure function lagrangian(self, t, q, v) result(l)
        !! See `system_t`.
        class(written_system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l
        type(hyperdual_t) :: values(1 + 2*self%ndof), results(1)

        values(1) = t
        values(2:1 + self%ndof) = q
        values(2 + self%ndof:) = v
        call self%programs(of_l)%evaluate(values, results)
        l = results(1)
    end function lagrangian

    pure subroutine generalised_forces(self, t, q, v, f)
        !! See `system_t`.
        class(written_system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t), intent(out) :: f(self%ndof)
        type(hyperdual_t) :: values(1 + 2*self%ndof)

        values(1) = t
        values(2:1 + self%ndof) = q
        values(2 + self%ndof:) = v
        call self%programs(of_force)%evaluate(values, f)
    end subroutine generalised_forces

    pure subroutine accelerations(self, t, q, v, a)
        !! See `system_t`; NaN where a pivot is not positive. Where q and v are few they are given
        !! number by number: a loop, which becomes a call of memcpy, costs more than it does.
        class(written_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        real(dp) :: r(room)
        logical :: yes
        integer :: i, n

        n = self%ndof
        associate (program => self%programs(of_motion))
            if (program%registers > room) then
                call solve_by(program, n, t, q, v, a)
                return
            end if
            r(1) = t
            r(2) = q(1)
            if (n == 1) then
                r(3) = v(1)
            else if (n == 2) then
                r(3) = q(2)
                r(4) = v(1)
                r(5) = v(2)
            else
                r(2:1 + n) = q
                r(2 + n:1 + 2*n) = v
            end if
            call program%run(r)
            yes = .true.
            do i = 1, n
                a(i) = r(program%places(i))
                yes = yes .and. is_positive(r(program%places(n + i)), r(program%places(2*n + i)), n)
            end do
        end associate
        if (.not. yes) call set_to_nan(a)
    end subroutine accelerations

    pure subroutine solve_by(program, n, t, q, v, a)
        !! Accelerations, or velocities from momenta, by a program that gives pivots and diagonal,
        !! too; NaN where a pivot is not positive.
        type(formula_program_t), intent(in) :: program
        integer, intent(in) :: n
        real(dp), intent(in) :: t, q(n), v(n)
        real(dp), intent(out) :: a(n)
        real(dp) :: results(3*n)

        call program%evaluate([t, q, v], results)
        a = results(:n)
        if (.not. all(is_positive(results(n + 1:2*n), results(2*n + 1:), n))) call set_to_nan(a)
    end subroutine solve_by

    elemental function is_positive(pivot, diagonal, n) result(yes)
        !! It is not only rounding beside the mass matrix's diagonal.
        real(dp), intent(in) :: pivot     !! of its elimination
        real(dp), intent(in) :: diagonal  !! what it was before
        integer, intent(in) :: n          !! rows of the matrix
        logical :: yes

        yes = pivot > max(0.0_dp, 2*n*epsilon(pivot)*diagonal)
    end function is_positive

    pure subroutine set_to_nan(a)
        !! Apart from what is called often: gfortran saves and restores the processor's flags around
        !! a procedure that uses IEEE modules, which takes longer than the equations of motion.
        real(dp), intent(out) :: a(:)

        a = ieee_value(a, ieee_quiet_nan)
    end subroutine set_to_nan

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! `accelerations`, in all lanes at once.
        class(written_system_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)
        real(dp) :: values(lanes, 1 + 2*self%ndof), results(lanes, 3*self%ndof)
        integer :: i, n

        n = self%ndof
        values(:, 1) = t
        values(:, 2:1 + n) = q
        values(:, 2 + n:) = v
        call self%programs(of_motion)%evaluate(values, results)
        a = results(:, :n)
        do i = 1, lanes
            if (all(is_positive(results(i, n + 1:2*n), results(i, 2*n + 1:), n))) cycle
            call set_to_nan(a(i, :))
        end do
    end subroutine accelerations_lanes

    pure subroutine momenta(self, t, q, v, p)
        !! See `system_t`.
        class(written_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: p(self%ndof)
        real(dp) :: results(self%ndof + self%ndof**2)

        call self%programs(of_momentum)%evaluate([t, q, v], results)
        p = results(:self%ndof)
    end subroutine momenta

    pure subroutine velocities(self, t, q, p, v)
        !! See `system_t`; NaN where a pivot is not positive.
        class(written_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), p(self%ndof)
        real(dp), intent(out) :: v(self%ndof)

        if (self%is_quadratic) then
            call solve_by(self%programs(of_inverse), self%ndof, t, q, p, v)
        else
            call invert_by_newton(self, t, q, p, v)
        end if
    end subroutine velocities

    pure subroutine invert_by_newton(self, t, q, p, v)
        !! Newton's method for \(p(\dot q) = p\), at rest first, each step halved until the rest is
        !! smaller; NaN where M is not positive definite on the way.
        type(written_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(:), p(:)
        real(dp), intent(out) :: v(:)
        integer, parameter :: most = 100
        real(dp) :: results(size(p) + size(p)**2), mass(size(p), size(p)), step(size(p))
        real(dp) :: left(size(p)), size_left
        integer :: halvings, i, n

        n = size(p)
        v = 0.0_dp
        call self%programs(of_momentum)%evaluate([t, q, v], results)
        do i = 1, most
            left = p - results(:n)
            size_left = maxval(abs(left))
            step = left
            mass = reshape(results(n + 1:), [n, n])
            call solve_positive(mass, 0.0_dp*p, step)
            do halvings = 1, most
                call self%programs(of_momentum)%evaluate([t, q, v + step], results)
                if (maxval(abs(p - results(:n))) < size_left) exit
                if (maxval(abs(step)) <= epsilon(v)*maxval(abs(v))) return
                step = 0.5_dp*step
            end do
            v = v + step
        end do
        call set_to_nan(v)
    end subroutine invert_by_newton

    pure subroutine slopes(self, t, q, v, f)
        !! See `forces` of `system_t`.
        class(written_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: f(self%ndof)

        call self%programs(of_slope)%evaluate([t, q, v], f)
    end subroutine slopes

    pure function energy(self, t, q, v) result(e)
        !! See `system_t`.
        class(written_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e
        real(dp) :: results(1)

        call self%programs(of_energy)%evaluate([t, q, v], results)
        e = results(1)
    end function energy

    pure function momentum_or_own(self, i, t, q, v) result(value)
        !! \(p_i = \partial L/\partial\dot q_i\), then the quantities of the scene's own.
        class(written_system_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value
        real(dp) :: p(self%ndof), own(self%programs(of_quantity)%outputs)

        if (i <= self%ndof) then
            call self%momenta(t, q, v, p)
            value = p(i)
        else
            call self%programs(of_quantity)%evaluate([t, q, v], own)
            value = own(i - self%ndof)
        end if
    end function momentum_or_own

    pure function natural_size(self, i, t, q, v) result(value)
        !! See `system_t`.
        class(written_system_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value
        real(dp) :: sizes(self%programs(of_magnitude)%outputs)

        value = 0.0_dp
        if (i >= size(sizes)) return
        call self%programs(of_magnitude)%evaluate([t, q, v], sizes)
        value = sizes(1 + i)
    end function natural_size

    pure subroutine positions(self, t, q, r)
        !! See `system_t`.
        class(written_system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: r(:, :)
        type(hyperdual_t) :: values(1 + 2*self%ndof), results(3*size(r, 2))

        values(1) = t
        values(2:1 + self%ndof) = q
        call self%programs(of_place)%evaluate(values, results)
        r = reshape(results, [3, size(r, 2)])
    end subroutine positions

    pure subroutine angles(self, t, q, phi)
        !! See `system_t`.
        class(written_system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(:)
        type(hyperdual_t), intent(out) :: phi(:)

        call self%programs(of_angle)%evaluate([t, q, spread(hyperdual_t(), 1, size(q))], phi)
    end subroutine angles
end module lagrangia_written_system
