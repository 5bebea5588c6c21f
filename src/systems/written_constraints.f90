module lagrangia_written_constraints
    !! The constraints of a scene's group `&lagrangian`: holonomic, \(f(t, q) = 0\), or in the
    !! velocities, \(A(t, q)\,\dot q + b(t, q) = 0\).
    use lagrangia_canonical_form, only: simplified
    use lagrangia_derivative, only: derivative, time_derivative
    use lagrangia_errors, only: error_t, fail
    use lagrangia_expression, only: expression_t, operator(*), operator(+), &
                                    operator(-), symbol, whole
    use lagrangia_formula_parser, only: parse_equation, parse_formula
    use lagrangia_symbols, only: symbols_t
    use lagrangia_written_formulas, only: longest_formula
    use lagrangia_written_motion, only: written_motion_t
    implicit none (type, external)
    private
    public :: constraint_drift, constraint_row, is_in_velocities, read_constraints
    public :: velocity_constraint, with_multipliers

contains

    subroutine read_constraints(texts, n, symbols, constraints, error)
        !! `x^2 + y^2 = l^2`, or with velocities `x_dot = r sin(theta) phi_dot`; a formula without
        !! '=' is zero.
        character(longest_formula), intent(in) :: texts(:)             !! one each
        integer, intent(in) :: n                                       !! coordinates
        type(symbols_t), intent(in) :: symbols                         !! t, q, q_dot, parameters
        type(expression_t), allocatable, intent(out) :: constraints(:) !! left less right sides
        type(error_t), allocatable, intent(out) :: error
        !! blames `constraint` and the element; `column N: ` before a message about one place
        type(expression_t) :: left, right
        integer :: i

        allocate (constraints(size(texts)))
        do i = 1, size(texts)
            if (index(texts(i), "=") > 0) then
                call parse_equation(trim(texts(i)), symbols, left, right, error)
            else
                call parse_formula(trim(texts(i)), symbols, left, error)
                right = whole(0)
            end if
            if (.not. allocated(error)) then
                constraints(i) = left
                if (.not. right%is_zero()) constraints(i) = left - right
                call check(constraints(i), n, symbols, error)
            end if
            if (.not. allocated(error) .and. i == n) call fail(error, "as many constraints as "// &
                "coordinates leave nothing that moves")
            if (.not. allocated(error)) cycle
            error%key = "constraint"
            error%element = i
            return
        end do
    end subroutine read_constraints

    subroutine check(constraint, n, symbols, error)
        !! Refuse velocities in other ways than \(A\,\dot q + b\), and what binds nothing.
        type(expression_t), intent(in) :: constraint
        integer, intent(in) :: n
        type(symbols_t), intent(in) :: symbols
        type(error_t), allocatable, intent(out) :: error
        type(expression_t) :: row
        integer :: i, k

        if (.not. any([(constraint%depends_on(1 + i), i=1, 2*n)])) then
            call fail(error, "contains no coordinate and no velocity, and so binds nothing")
            return
        end if
        if (.not. is_in_velocities(constraint, n)) return
        do i = 1, n
            row = simplified(derivative(constraint, 1 + n + i), symbols)
            do k = 2 + n, 1 + 2*n
                if (.not. row%depends_on(k)) cycle
                call fail(error, "is not linear in "//trim(symbols%names(k))//"; a constraint "// &
                          "on velocities is a sum of terms with one velocity each")
                return
            end do
        end do
    end subroutine check

    pure function is_in_velocities(constraint, n) result(yes)
        !! Rather than in coordinates alone.
        type(expression_t), intent(in) :: constraint  !! of t, q, q_dot, parameters
        integer, intent(in) :: n                      !! coordinates
        logical :: yes
        integer :: i

        yes = any([(constraint%depends_on(1 + n + i), i=1, n)])
    end function is_in_velocities

    pure function constraint_row(constraint, i, n, symbols) result(row)
        !! \(A_i\): the derivative by the velocity, or, of a holonomic one, by the coordinate.
        type(expression_t), intent(in) :: constraint  !! of t, q, q_dot, parameters
        integer, intent(in) :: i, n                   !! which coordinate, of how many
        type(symbols_t), intent(in) :: symbols        !! their names
        type(expression_t) :: row

        row = simplified(derivative(constraint, merge(n, 0, is_in_velocities(constraint, n)) &
                                    + 1 + i), symbols)
    end function constraint_row

    pure function constraint_drift(constraint, n, symbols) result(drift)
        !! \(b\) of \(A\,\dot q + b = 0\): what has no velocity, or, of a holonomic constraint, the
        !! partial derivative by the time.
        type(expression_t), intent(in) :: constraint  !! of t, q, q_dot, parameters
        integer, intent(in) :: n                      !! coordinates
        type(symbols_t), intent(in) :: symbols        !! their names
        type(expression_t) :: drift
        integer :: i

        if (is_in_velocities(constraint, n)) then
            drift = constraint
            do i = 1, n
                drift = drift - constraint_row(constraint, i, n, symbols)*symbol(1 + n + i)
            end do
        else
            drift = derivative(constraint, 1)
        end if
        drift = simplified(drift, symbols)
    end function constraint_drift

    pure function velocity_constraint(constraint, n, symbols) result(left)
        !! \(A\dot q + b\), which is zero.
        type(expression_t), intent(in) :: constraint  !! of t, q, q_dot and parameters
        integer, intent(in) :: n                      !! coordinates
        type(symbols_t), intent(in) :: symbols        !! their names
        type(expression_t) :: left
        integer :: i

        left = constraint_drift(constraint, n, symbols)
        do i = 1, n
            left = left + constraint_row(constraint, i, n, symbols)*symbol(1 + n + i)
        end do
    end function velocity_constraint

    pure subroutine with_multipliers(motion, constraints, symbols, bound)
        !! One symmetric linear system for \(\ddot q\) and the multipliers,
        !! \(M\ddot q - A^\top\lambda = f\) and \(-A\,\ddot q = \dot A\,\dot q + \dot b\).
        type(written_motion_t), intent(in) :: motion      !! without the constraints, (n)
        type(expression_t), intent(in) :: constraints(:)  !! of t, q, q_dot, parameters, (m)
        type(symbols_t), intent(in) :: symbols            !! their names
        type(written_motion_t), intent(out) :: bound      !! `mass` and `right` only, of n + m
        type(expression_t) :: row
        integer :: i, j, k, n, rates(size(symbols%names))

        n = size(motion%right)
        rates = 0
        rates(2:1 + n) = [(1 + n + i, i=1, n)]
        allocate (bound%mass(n + size(constraints), n + size(constraints)), &
                  bound%right(n + size(constraints)))
        do i = 1, n
            do j = 1, n
                bound%mass(i, j) = motion%mass(i, j)
            end do
            bound%right(i) = motion%right(i)
        end do
        do k = 1, size(constraints)
            do i = 1, n
                row = constraint_row(constraints(k), i, n, symbols)
                bound%mass(i, n + k) = simplified(whole(0) - row, symbols)
                bound%mass(n + k, i) = bound%mass(i, n + k)
            end do
            bound%right(n + k) = simplified(time_derivative( &
                velocity_constraint(constraints(k), n, symbols), rates, 1), symbols)
            do i = 1, size(constraints)
                bound%mass(n + i, n + k) = whole(0)
            end do
        end do
    end subroutine with_multipliers
end module lagrangia_written_constraints
