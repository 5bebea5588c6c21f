module lagrangia_constrained_system
    !! A system in formulas with constraints beside L: each has a multiplier \(\lambda\),
    !! \(\frac{d}{dt}\frac{\partial L}{\partial\dot q} - \frac{\partial L}{\partial q}
    !! = Q + \lambda A\), and accelerations and multipliers follow from these equations and
    !! \(\frac{d}{dt}(A\,\dot q + b) = 0\) (index 1). What drifts from the constraint is a column.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_canonical_form, only: simplified
    use lagrangia_description, only: conserved, description_t, formula_length, name_length, &
                                     quantity, quantity_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_expression, only: expression_t, operator(*), operator(+), symbol, whole
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_formula_text, only: formula_text
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_lagrange, only: accelerations_from_lagrangian
    use lagrangia_lapack, only: matrix_rank, solve_linear
    use lagrangia_mass_matrix, only: list_of
    use lagrangia_system, only: each_lane
    use lagrangia_text, only: join, to_text
    use lagrangia_written_constraints, only: constraint_drift, constraint_row, is_in_velocities, &
                                             is_zero
    use lagrangia_written_expressions, only: written_expressions_t
    use lagrangia_written_formulas, only: written_formulas_t
    use lagrangia_written_quantities, only: find_conserved
    use lagrangia_written_system, only: new_written_system, of_momentum, of_quantity, &
                                        written_system_t
    implicit none (type, external)
    private
    public :: constrained_system_t, new_constrained_system

    integer, parameter :: of_row = 1, of_value = 2, of_drift = 3   ! programs
    real(dp), parameter :: slip = sqrt(epsilon(1.0_dp))
    !! what may be missing of a constraint at the start, relative: its square is rounding

    type, extends(written_system_t) :: constrained_system_t
        !! Made by `new_constrained_system`.
        type(formula_program_t), allocatable :: links(:)   !! rows, one after the other; values; b
        logical, allocatable :: holonomic(:)               !! of each constraint
    contains
        procedure :: outline
        procedure :: prepare
        procedure :: find_structure
        procedure :: accelerations
        procedure :: accelerations_lanes
        procedure :: quantity => link_quantity
        procedure :: constraint_rows
        procedure :: complete_velocities
        procedure :: check_places
        procedure :: residuals
        procedure :: keep_constraints
    end type constrained_system_t

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
        call state_constraints(expressions, system%holonomic, n, system%stated)
        call system%configure([(formulas%parameters(i)%value(1), i=1, &
                                size(formulas%parameters))], error)
    end subroutine new_constrained_system

    subroutine state_constraints(e, holonomic, n, d)
        !! The equations of motion with multipliers; the constraints as they bind the velocities.
        type(written_expressions_t), intent(in) :: e
        logical, intent(in) :: holonomic(:)
        integer, intent(in) :: n
        type(description_t), intent(inout) :: d
        type(expression_t) :: row, along
        character(:), allocatable :: text
        integer :: i, k

        if (allocated(d%accelerations)) deallocate (d%accelerations)
        if (allocated(d%frequencies)) deallocate (d%frequencies)
        d%constraint = trim(merge("holonomic   ", "nonholonomic", all(holonomic)))// &
                       merge(", rheonomic  ", ", scleronomic", &
                             any([(e%constraints(k)%depends_on(1), k=1, size(holonomic))]))
        allocate (d%constraint_equations(size(holonomic)), d%notes(size(holonomic)))
        do k = 1, size(holonomic)
            along = constraint_drift(e%constraints(k), n, e%symbols)
            do i = 1, n
                row = constraint_row(e%constraints(k), i, n, e%symbols)
                along = along + row*symbol(1 + n + i)
                text = formula_text(row, e%symbols)
                if (text == "0" .or. .not. allocated(d%equations)) cycle
                text = "lambda"//to_text(k)//" ("//text//")"
                text = with_term(trim(d%equations(i)), text)
                if (len(text) > formula_length) deallocate (d%equations)
                if (allocated(d%equations)) d%equations(i) = text
            end do
            d%notes(k) = "constraint "//to_text(k)//": "// &
                         formula_text(e%constraints(k), e%symbols)//" = 0, multiplier lambda"// &
                         to_text(k)
            d%constraint_equations(k) = formula_text(simplified(along, e%symbols), e%symbols)// &
                                        " = 0"
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
        m = self%constraints
        n = size(d%quantities)
        allocate (items(n + 2*m))
        items(:n) = d%quantities
        do k = 1, m
            items(n + k) = quantity("lambda"//to_text(k), "1", "multiplier of constraint "// &
                                    to_text(k))
            items(n + m + k) = conserved("constraint"//to_text(k), "1", "zero, it is kept", 1.0_dp)
        end do
        call move_alloc(items, d%quantities)
    end subroutine outline

    pure subroutine prepare(self)
        !! Compile the rows as well.
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
    end subroutine prepare

    pure subroutine find_structure(self)
        !! A momentum is conserved where L, Q and the constraints leave its coordinate alone;
        !! accelerations depend on velocities.
        class(constrained_system_t), intent(inout) :: self
        type(expression_t) :: row
        integer :: i, k

        call self%written_system_t%find_structure()
        self%velocity_forces = .true.
        self%constraints_work = .false.
        associate (e => self%expressions)
            do k = 1, self%constraints
                if (e%constraints(k)%depends_on(1)) self%time_dependent = .true.
                if (is_zero(constraint_drift(e%constraints(k), self%ndof, e%symbols))) cycle
                self%constraints_work = .true.
            end do
        end associate
        do i = 1, self%ndof
            do k = 1, self%constraints
                row = constraint_row(self%expressions%constraints(k), i, self%ndof, &
                                     self%expressions%symbols)
                if (formula_text(row, self%expressions%symbols) == "0" .and. &
                    .not. self%expressions%constraints(k)%depends_on(1 + i)) cycle
                self%cyclic_coordinates(i) = .false.
            end do
        end do
        self%cyclic = findloc(self%cyclic_coordinates, .true., 1)
        call find_conserved(self, self%programs(of_quantity), self%is_conserved)
    end subroutine find_structure

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
        real(dp) :: a(self%ndof), numbers(self%constraints)
        type(error_t), allocatable :: error
        integer :: k

        k = i - self%ndof - size(self%expressions%quantities)
        if (k <= 0) then
            value = self%written_system_t%quantity(i, t, q, v)
        else if (k <= self%constraints) then
            call accelerations_from_lagrangian(self, t, q, v, a, numbers, error)
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

    pure subroutine complete_velocities(self, t, q, given, v, error)
        !! All velocities, which must keep the constraints, or as many as are free: those of the
        !! coordinates but for the last ones that the others determine.
        class(constrained_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), given(:)
        real(dp), intent(out) :: v(self%ndof)
        type(error_t), allocatable, intent(out) :: error
        type(hyperdual_t) :: rows(self%constraints, self%ndof), drift(self%constraints), &
                             qq(self%ndof)
        real(dp) :: a(self%constraints, self%ndof), bound(self%constraints)
        logical :: free(self%ndof)
        integer :: i, m, n, rank
        integer, allocatable :: last(:)

        n = self%ndof
        m = self%constraints
        v = 0.0_dp
        qq%re = q
        call self%constraint_rows(hyperdual_t(re=t), qq, rows, drift)
        a = rows%re
        if (.not. (all(ieee_is_finite(a)) .and. all(ieee_is_finite(drift%re)))) then
            call fail(error, "a constraint has no finite derivatives where it starts")
            return
        end if
        allocate (last(0))
        free = .true.
        do i = n, 1, -1
            if (size(last) == m) exit
            call matrix_rank(a(:, [last, i]), rank, error)
            if (allocated(error)) return
            if (rank <= size(last)) cycle
            last = [last, i]
            free(i) = .false.
        end do
        if (size(last) < m) then
            call fail(error, "the constraints are not independent where it starts")
        else if (size(given) == n) then
            v = given
            if (any(.not. abs(matmul(a, v) + drift%re) &
                    <= slip*(matmul(abs(a), abs(v)) + abs(drift%re)))) call fail(error, &
                "v does not keep the constraints; give those of "//names_of(self, free)//" only")
        else if (size(given) == n - m) then
            v = unpack(given, free, v)
            call solve_linear(a(:, last), -matmul(a, v) - drift%re, bound, error)
            if (.not. allocated(error)) v(last) = bound
        else
            call fail(error, "v takes "//to_text(n - m)//" values ("//names_of(self, free)// &
                      ") or all "//to_text(n)//", not "//to_text(size(given)))
        end if
    end subroutine complete_velocities

    pure function names_of(self, free) result(text)
        !! `x_dot, y_dot`.
        class(constrained_system_t), intent(in) :: self
        logical, intent(in) :: free(:)
        character(:), allocatable :: text
        character(name_length) :: names(size(free))
        integer :: i

        do i = 1, size(free)
            names(i) = trim(self%stated%coordinates(i)%name)//"_dot"
        end do
        text = join(pack(names, free), ", ")
    end function names_of

    pure subroutine check_places(self, t, q, error)
        !! Refuse a start that is not on the holonomic constraints, and say which one is near.
        class(constrained_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(:)
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: values(self%constraints), sizes(self%constraints), near(size(q)), v(size(q))
        integer :: k

        call self%residuals(t, q, values, sizes)
        do k = 1, self%constraints
            if (abs(values(k)) <= slip*sizes(k)) cycle
            if (.not. ieee_is_finite(values(k))) then
                call fail(error, "constraint "//to_text(k)//" is no finite number there; start "// &
                          "elsewhere")
                return
            end if
            near = q
            v = 0.0_dp
            call self%keep_constraints(t, near, v)
            call fail(error, "constraint "//to_text(k)//" is not kept: it gives "// &
                      to_text(values(k))//", not 0; start elsewhere")
            call self%residuals(t, near, values, sizes)
            if (size(q) <= 4 .and. all(abs(values) <= slip*sizes)) error%message = &
                error%message//", such as q = "//list_of(near)
            return
        end do
    end subroutine check_places

    pure subroutine residuals(self, t, q, values, sizes)
        !! What the holonomic constraints give, and how large the changes of coordinates and time
        !! of this size make them; zeros for the others.
        class(constrained_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(:)                    !! time, s; coordinates, (ndof)
        real(dp), intent(out) :: values(:), sizes(:)       !! (constraints)
        type(hyperdual_t) :: rows(self%constraints, self%ndof), drift(self%constraints)
        type(hyperdual_t) :: qq(self%ndof)
        real(dp) :: a(self%constraints, self%ndof)

        qq%re = q
        call self%constraint_rows(hyperdual_t(re=t), qq, rows, drift)
        call self%links(of_value)%evaluate([t, q, 0.0_dp*q], values)
        a = abs(rows%re)
        sizes = matmul(a, abs(q)) + abs(drift%re*t)
        where (.not. self%holonomic)
            values = 0.0_dp
            sizes = 1.0_dp
        end where
    end subroutine residuals

    pure subroutine keep_constraints(self, t, q, v)
        !! Newton's method for the coordinates, then the velocities once: both are linear then.
        class(constrained_system_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(inout) :: q(self%ndof), v(self%ndof)
        integer, parameter :: most = 8
        real(dp), parameter :: rounding = 4*epsilon(1.0_dp)
        type(hyperdual_t) :: qq(self%ndof), drift(self%constraints)
        type(hyperdual_t) :: rows(self%constraints, self%ndof)
        real(dp), dimension(self%constraints) :: left, sizes
        real(dp) :: change(self%ndof), a(self%constraints, self%ndof)
        integer :: i
        logical :: found

        do i = 1, most
            call self%residuals(t, q, left, sizes)
            if (all(abs(left) <= rounding*sizes)) exit
            call find_change(self, t, q, v, left, change, found)
            if (.not. found) return
            q = q + change
        end do
        qq%re = q
        call self%constraint_rows(hyperdual_t(re=t), qq, rows, drift)
        a = rows%re
        left = matmul(a, v) + drift%re
        if (all(abs(left) <= rounding*(matmul(abs(a), abs(v)) + abs(drift%re)))) return
        call find_change(self, t, q, v, left, change, found)
        if (found) v = v + change
    end subroutine keep_constraints

    pure subroutine find_change(self, t, q, v, left, change, found)
        !! \(\delta\) of least \(\delta^\top M\delta\) with \(A\delta = -\) `left`:
        !! \(M\delta - A^\top\mu = 0\). Constraints that do not hold of places have no part in that
        !! of the coordinates: they are satisfied by `left` of 0.
        class(constrained_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(:), v(:), left(:)
        real(dp), intent(out) :: change(:)
        logical, intent(out) :: found                   !! it is finite
        type(hyperdual_t) :: qq(size(q)), rows(size(left), size(q)), drift(size(left))
        type(error_t), allocatable :: error
        real(dp), dimension(size(q) + size(left)) :: right, solution
        real(dp) :: results(size(q) + size(q)**2)
        real(dp) :: matrix(size(solution), size(solution))
        integer :: n

        n = size(q)
        qq%re = q
        call self%constraint_rows(hyperdual_t(re=t), qq, rows, drift)
        call self%programs(of_momentum)%evaluate([t, q, v], results)
        matrix = 0.0_dp
        matrix(:n, :n) = reshape(results(n + 1:), [n, n])
        matrix(n + 1:, :n) = rows%re
        matrix(:n, n + 1:) = -transpose(rows%re)
        right(:n) = 0.0_dp
        right(n + 1:) = -left
        call solve_linear(matrix, right, solution, error)
        found = .not. allocated(error)
        if (found) found = all(ieee_is_finite(solution))
        change = 0.0_dp
        if (found) change = solution(:n)
    end subroutine find_change
end module lagrangia_constrained_system
