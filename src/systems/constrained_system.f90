module lagrangia_constrained_system
    !! A system in formulas with constraints beside L: each has a multiplier \(\lambda\),
    !! \(\frac{d}{dt}\frac{\partial L}{\partial\dot q} - \frac{\partial L}{\partial q}
    !! = Q + \lambda A\), and accelerations and multipliers follow from these equations and
    !! \(\frac{d}{dt}(A\,\dot q + b) = 0\) (index 1). What drifts from the constraint is a column.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_canonical_form, only: simplified
    use lagrangia_description, only: conserved, constraint_length, description_t, &
                                     formula_length, quantity, quantity_t
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_formula_text, only: formula_text
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_lagrange, only: accelerations_from_lagrangian
    use lagrangia_lagrangian_system, only: is_spare, near_states, trial_state
    use lagrangia_local_states, only: find_local_states
    use lagrangia_pfaffian, only: pfaffian_t
    use lagrangia_system, only: each_lane
    use lagrangia_text, only: to_text
    use lagrangia_written_constraints, only: constraint_drift, constraint_row, is_in_velocities, &
                                             velocity_constraint
    use lagrangia_written_expressions, only: written_expressions_t
    use lagrangia_written_formulas, only: written_formulas_t
    use lagrangia_written_system, only: new_written_system, of_momentum, written_system_t
    implicit none (type, external)
    private
    public :: constrained_system_t, new_constrained_system

    integer, parameter :: of_row = 1, of_value = 2, of_drift = 3   ! programs

    type, extends(written_system_t) :: constrained_system_t
        !! Made by `new_constrained_system`.
        type(formula_program_t), allocatable :: links(:)   !! rows, one after the other; values; b
        character(26) :: constraint_class = ""             !! `holonomic, scleronomic`
    contains
        procedure :: outline
        procedure :: prepare
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: quantity => link_quantity
        procedure :: constraint_rows
        procedure :: constraint_values
        procedure :: mass_matrix
    end type constrained_system_t

    type, extends(pfaffian_t) :: links_t
        !! The constraints of a system as one-forms \(A\,dq + b\,dt\).
        class(constrained_system_t), allocatable :: of
    contains
        procedure :: forms
    end type links_t

contains

    subroutine new_constrained_system(formulas, expressions, system, error)
        !! A system from its formulas, of which at least one is a constraint.
        type(written_formulas_t), intent(in) :: formulas           !! with values of the parameters
        type(written_expressions_t), intent(in) :: expressions     !! what the formulas mean
        type(constrained_system_t), intent(out) :: system          !! configured with these values
        type(error_t), allocatable, intent(out) :: error           !! a value that is not allowed
        integer :: i, n

        call new_written_system(formulas, expressions, system%written_system_t, error)
        if (allocated(error)) return
        n = size(formulas%coordinates)
        associate (links => expressions%constraints)
            system%constraints = size(links)
            system%is_projected = .true.
            system%holonomic = [(.not. is_in_velocities(links(i), n), i=1, size(links))]
        end associate
        allocate (system%links(of_drift))
        call state_constraints(expressions, size(system%holonomic), n, system%stated)
        call system%configure([(formulas%parameters(i)%value(1), i=1, &
                                size(formulas%parameters))], error)
    end subroutine new_constrained_system

    subroutine state_constraints(e, m, n, d)
        !! The equations of motion with multipliers; the constraints as they bind the velocities.
        type(written_expressions_t), intent(in) :: e
        integer, intent(in) :: m, n
        type(description_t), intent(inout) :: d
        character(:), allocatable :: text
        integer :: i, k

        if (allocated(d%accelerations)) deallocate (d%accelerations)
        if (allocated(d%frequencies)) deallocate (d%frequencies)
        allocate (d%constraint_equations(m), d%notes(m))
        do k = 1, m
            do i = 1, n
                text = formula_text(constraint_row(e%constraints(k), i, n, e%symbols), e%symbols)
                if (text == "0" .or. .not. allocated(d%equations)) cycle
                text = " ("//text//")"
                if (text == " (1)") text = ""
                text = "lambda"//to_text(k)//text
                text = with_term(trim(d%equations(i)), text)
                if (len(text) > formula_length) deallocate (d%equations)
                if (allocated(d%equations)) d%equations(i) = text
            end do
            text = formula_text(e%constraints(k), e%symbols)//" = 0"
            text = "constraint "//to_text(k)//": "//text//", multiplier lambda"//to_text(k)
            if (len(text) > constraint_length) text = "constraint "//to_text(k)// &
                " is too long to be printed, multiplier lambda"//to_text(k)
            d%notes(k) = text
            text = formula_text(simplified(velocity_constraint(e%constraints(k), n, e%symbols), &
                                           e%symbols), e%symbols)//" = 0"
            if (len(text) > constraint_length) deallocate (d%constraint_equations)
            if (allocated(d%constraint_equations)) d%constraint_equations(k) = text
        end do
    end subroutine state_constraints

    pure function with_term(equation, term) result(text)
        !! One more on the right side, which may have been zero.
        character(*), intent(in) :: equation, term
        character(:), allocatable :: text
        integer :: equals

        equals = index(equation, " = ")
        text = equation//" + "//term
        if (equation(equals:) == " = 0") text = equation(:equals)//"= "//term
    end function with_term

    pure subroutine outline(self, d)
        !! With the multipliers, and what is left of the holonomic constraints.
        class(constrained_system_t), intent(in) :: self
        type(description_t), intent(out) :: d
        type(quantity_t), allocatable :: items(:)
        integer :: k, m, n

        call self%written_system_t%outline(d)
        d%constraint = self%constraint_class
        m = self%constraints
        n = size(d%quantities)
        allocate (items(n + 2*m))
        items(:n) = d%quantities
        do k = 1, m
            ! as the constraint is written, which nobody has told the units of
            items(n + k) = quantity("lambda"//to_text(k), "?", "multiplier of constraint "// &
                                    to_text(k))
            items(n + m + k) = conserved("constraint"//to_text(k), "?", "zero, it is kept", 1.0_dp)
        end do
        call move_alloc(items, d%quantities)
    end subroutine outline

    pure subroutine prepare(self)
        !! Compile the rows as well, and find out what constraints they are.
        class(constrained_system_t), intent(inout) :: self
        type(expression_t), allocatable :: rows(:)
        logical :: fixed(size(self%expressions%symbols%names))
        real(dp) :: values(size(fixed))
        integer :: i, k, n

        call self%written_system_t%prepare()
        n = self%ndof
        fixed = .true.
        fixed(:1 + 2*n) = .false.
        values(:1 + 2*n) = 0.0_dp
        values(2 + 2*n:) = self%p
        allocate (rows(self%constraints*n))
        associate (e => self%expressions)
            do k = 1, self%constraints
                do i = 1, n
                    rows((k - 1)*n + i) = constraint_row(e%constraints(k), i, n, e%symbols)
                end do
            end do
            call new_formula_program(self%links(of_row), rows, 1 + 2*n, fixed, values)
            call new_formula_program(self%links(of_value), e%constraints, 1 + 2*n, fixed, values)
            deallocate (rows)
            allocate (rows(self%constraints))
            do k = 1, self%constraints
                rows(k) = constraint_drift(e%constraints(k), n, e%symbols)
            end do
            call new_formula_program(self%links(of_drift), rows, 1 + 2*n, fixed, values)
        end associate
        call classify(self)
    end subroutine prepare

    pure subroutine classify(self)
        !! Whether the constraints are holonomic, that is, whether there are \(f(t, q) = c\) that
        !! say the same, is a matter of \(A\,dq + b\,dt\) (Frobenius), not of how they are written;
        !! rheonomic are those whose f, or that themselves where there is no f, contain the time:
        !! at states of `trial_state`, and where one of their functions acts that is constant
        !! elsewhere. Where no state tells, it is as they are written.
        class(constrained_system_t), intent(inout) :: self
        type(links_t) :: links
        real(dp) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: a(self%constraints, 1 + self%ndof)
        real(dp), allocatable :: local(:, :)
        integer :: k, used
        logical :: integrable, moves, turns

        links%coordinates = self%ndof
        links%rows = self%constraints
        allocate (links%of, source=self)
        integrable = .true.
        moves = .false.
        turns = .false.
        used = 0
        call trial_state(1, t, q, v)
        call find_local_states(self%expressions%constraints, [t, q, v, self%p], 1 + self%ndof, &
                               local)
        do k = 1, near_states + size(local, 2)
            if (is_spare(k, used)) cycle
            call trial_state(min(k, near_states), t, q, v)
            if (k > near_states) then
                t = local(1, k - near_states)
                q = local(2:1 + self%ndof, k - near_states)
            end if
            call self%keep_constraints(t, q, v)
            call links%forms(hyperdual([q, t]), a)
            if (.not. all(ieee_is_finite(a%re))) cycle
            if (.not. ieee_is_finite(links%frobenius([q, t]))) cycle
            used = used + 1
            integrable = integrable .and. links%integrable([q, t])
            moves = moves .or. links%moves([q, t])
            turns = turns .or. links%turns([q, t])
        end do
        if (used == 0) then
            integrable = all(self%holonomic)
            moves = any([(self%expressions%constraints(k)%depends_on(1), k=1, self%constraints)])
            turns = moves
        end if
        if (.not. integrable) moves = turns
        self%constraint_class = trim(merge("holonomic   ", "nonholonomic", integrable))// &
                                merge(", rheonomic  ", ", scleronomic", moves)
    end subroutine classify

    pure subroutine forms(self, x, a)
        !! See `pfaffian_t`.
        class(links_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: x(self%coordinates + 1)
        type(hyperdual_t), intent(out) :: a(self%rows, self%coordinates + 1)

        associate (n => self%coordinates)
            call self%of%constraint_rows(x(n + 1), x(:n), a(:, :n), a(:, n + 1))
        end associate
    end subroutine forms

    pure subroutine accelerations(self, t, q, v, a)
        !! See `system_t`; NaN where nothing determines them.
        class(constrained_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        real(dp) :: multipliers(self%constraints)
        type(error_t), allocatable :: error

        call accelerations_from_lagrangian(self, t, q, v, a, multipliers, error)
        if (allocated(error)) a = ieee_value(a, ieee_quiet_nan)
    end subroutine accelerations

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! One lane after the other.
        class(constrained_system_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)

        call each_lane(self, t, q, v, a)
    end subroutine accelerations_lanes

    pure function link_quantity(self, i, t, q, v) result(value)
        !! Momenta, the scene's own, then multipliers, then what is left of each constraint.
        class(constrained_system_t), intent(in) :: self
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: value
        real(dp) :: numbers(self%constraints)
        integer :: k

        k = i - self%ndof - size(self%expressions%quantities)
        if (k <= 0) then
            value = self%written_system_t%quantity(i, t, q, v)
        else if (k <= self%constraints) then
            call self%multipliers(t, q, v, numbers)
            value = numbers(k)
        else
            call self%links(of_value)%evaluate([t, q, v], numbers)
            value = numbers(k - self%constraints)
        end if
    end function link_quantity

    pure subroutine constraint_rows(self, t, q, rows, drift)
        !! See `system_t`.
        class(constrained_system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: rows(:, :), drift(:)
        type(hyperdual_t) :: values(1 + 2*self%ndof), results(self%constraints*self%ndof)

        values = hyperdual_t()
        values(1) = t
        values(2:1 + self%ndof) = q
        call self%links(of_row)%evaluate(values, results)
        rows = transpose(reshape(results, [self%ndof, self%constraints]))
        call self%links(of_drift)%evaluate(values, drift)
    end subroutine constraint_rows

    pure subroutine constraint_values(self, t, q, values)
        !! See `bound_system_t`.
        class(constrained_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof)
        real(dp), intent(out) :: values(:)

        call self%links(of_value)%evaluate([t, q, 0.0_dp*q], values)
    end subroutine constraint_values

    pure subroutine mass_matrix(self, t, q, v, mass)
        !! See `bound_system_t`.
        class(constrained_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: mass(:, :)
        real(dp) :: results(self%ndof + self%ndof**2)

        call self%programs(of_momentum)%evaluate([t, q, v], results)
        mass = reshape(results(self%ndof + 1:), [self%ndof, self%ndof])
    end subroutine mass_matrix
end module lagrangia_constrained_system
