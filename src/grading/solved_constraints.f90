module lagrangia_solved_constraints
    !! A constraint that brings in a place which the system does not name: of `x + y + pi R = l`,
    !! the length of a string, y. A parameter that is written with another one, `I = M R^2/2`.
    use lagrangia_canonical_form, only: simplified
    use lagrangia_declared_constants, only: with_constants
    use lagrangia_derivative, only: derivative
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, kind_symbol, operator(-), operator(/), whole
    use lagrangia_formula_parser, only: parse_equation
    use lagrangia_formula_text, only: formula_text
    use lagrangia_kinds, only: dp
    use lagrangia_names, only: name_length
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_sample_names, only: role_coordinate, role_parameter, role_velocity, samples_t
    use lagrangia_sampled_formula, only: evaluate_nodes
    use lagrangia_substitution, only: substituted
    use lagrangia_symbols, only: symbols_t
    use lagrangia_unknown_names, only: hidden, unknown_names
    implicit none (type, external)
    private
    public :: solve_constraint

contains

    subroutine solve_constraint(text, samples, name, formula)
        !! The one unknown name, which stands with the factor 1 or -1 beside coordinates and
        !! parameters, or once in what a parameter is, and what it is.
        character(*), intent(in) :: text                    !! a statement with one `=`
        type(samples_t), intent(in) :: samples              !! know the other names
        character(:), allocatable, intent(out) :: name      !! empty: there is none of this kind
        character(:), allocatable, intent(out) :: formula   !! that it stands for
        type(symbols_t) :: symbols
        type(expression_t) :: left, right, slope, rest, zero(1)
        type(error_t), allocatable :: error
        character(name_length), allocatable :: new(:)
        real(dp), allocatable :: values(:, :), nodes(:, :)
        logical :: moves, of_place
        integer :: i, place

        name = ""
        formula = ""
        symbols = with_constants(samples)
        call unknown_names(text, symbols, new)
        if (size(new) /= 1) return
        call symbols%add(trim(new(1)), error)
        if (allocated(error)) return
        call parse_equation(text, symbols, left, right, error)
        if (allocated(error)) return
        rest = left - right
        place = symbols%find(trim(new(1)))
        moves = .false.
        of_place = .false.
        do i = 1, size(samples%role)
            if (.not. rest%depends_on(i)) cycle
            of_place = of_place .or. any(samples%place == i)  ! r = r_eq + s
            if (any(samples%place == i)) cycle
            if (samples%role(i) > role_parameter) return
            if (samples%role(i) >= role_velocity .and. samples%role(i) < role_parameter) return
            moves = moves .or. samples%role(i) == role_coordinate
        end do
        if (of_place .and. .not. moves) return
        slope = derivative(rest, place)
        if (slope%depends_on(place)) return
        if (.not. moves) then
            if (is_parameter(left)) call solve_for_it()
            return
        end if
        if (any([(slope%depends_on(i), i=1, place)])) return
        allocate (values(1, place), nodes(1, slope%count))
        values = 0.0_dp
        call evaluate_nodes(slope, values, nodes)
        if (is_nonzero(abs(nodes(1, slope%count)) - 1.0_dp)) return
        zero(1) = whole(0)
        rest = substituted(rest, [place], zero)
        if (nodes(1, slope%count) > 0.0_dp) rest = zero(1) - rest
        name = trim(new(1))
        formula = formula_text(simplified(rest, symbols), symbols)
    contains
        pure logical function is_parameter(side)
            !! Alone, and of the system?
            type(expression_t), intent(in) :: side

            is_parameter = side%count == 1
            if (is_parameter) is_parameter = side%nodes(1)%kind == kind_symbol
            if (is_parameter) is_parameter = side%nodes(1)%which < place
            if (is_parameter) is_parameter = &
                index(samples%symbols%names(side%nodes(1)%which), hidden) == 0
        end function is_parameter

        subroutine solve_for_it()
            zero(1) = whole(0)
            rest = substituted(rest, [place], zero)
            rest = -rest/slope
            name = trim(new(1))
            formula = formula_text(simplified(rest, symbols), symbols)
        end subroutine solve_for_it
    end subroutine solve_constraint
end module lagrangia_solved_constraints
