module lagrangia_page_layout
    !! Sums of products as formulas in the order of the lecture: `(m1 + m2)/2 x_dot^2 + m2 g l
    !! cos(theta)`. Terms of the same motion share a bracket of parameters; masses come first, then
    !! gravity, other parameters, coordinates, velocities, accelerations and functions.
    use lagrangia_algebra, only: algebra_t, atom_number_pi, atom_root, atom_sum, atom_symbol
    use lagrangia_exact_number, only: number_t, operator(-), operator(*), operator(/), ratio
    use lagrangia_expression, only: apply, constant, expression_t, kind_product, operator(-), &
                                    operator(*), operator(**), operator(+), operator(/), symbol, &
                                    whole
    use lagrangia_kinds, only: dp, i8
    use lagrangia_parameter_sums, only: leading, one_polynomial, role_gravity, role_mass, &
                                        role_parameter, split, turn_leading
    use lagrangia_polynomial, only: most_atoms, polynomial_t
    implicit none (type, external)
    private
    public :: lay_out, lay_out_factors, lay_out_fraction
    public :: role_acceleration, role_coordinate, role_frequency, role_gravity, role_mass, &
              role_multiplier, role_parameter, role_time, role_velocity

    integer, parameter :: role_time = 4, role_coordinate = 5, role_velocity = 6, &
                          role_acceleration = 7
    integer, parameter :: role_number = 0       !! pi
    integer, parameter :: role_function = 8     !! of anything
    integer, parameter :: role_multiplier = 9   !! of a constraint
    integer, parameter :: role_frequency = 10   !! omega
    integer, parameter :: last_role = role_frequency

contains

    pure recursive subroutine lay_out(algebra, roles, p, e)
        !! The formula that is equal to `p`.
        type(algebra_t), intent(in) :: algebra     !! of the atoms
        integer, intent(in) :: roles(:)            !! of each name, `role_mass` to `role_frequency`
        type(polynomial_t), intent(in) :: p        !! any
        type(expression_t), intent(out) :: e       !! of the names
        type(polynomial_t) :: group
        logical :: fixed(most_atoms), positive(p%terms), used(p%terms)
        integer :: best, i, motion(most_atoms)

        e = whole(0)
        if (p%terms == 0) return
        call find_fixed(algebra, roles, fixed)
        used = .false.
        positive = p%coefficient(:p%terms)%value > 0.0_dp
        do while (.not. all(used))
            best = 0
            do i = 1, p%terms
                if (used(i)) cycle
                if (any(positive) .and. .not. any(used) .and. .not. positive(i)) cycle
                if (best > 0) then
                    if (key(algebra, roles, fixed, p%power(:, i)) >= &
                        key(algebra, roles, fixed, p%power(:, best))) cycle
                end if
                best = i
            end do
            motion = merge(0, p%power(:, best), fixed)
            group = polynomial_t()
            do i = 1, p%terms
                if (used(i)) cycle
                if (any(merge(0, p%power(:, i), fixed) /= motion)) cycle
                used(i) = .true.
                call group%add_term(p%coefficient(i), merge(p%power(:, i), 0, fixed))
            end do
            call add_group(algebra, roles, fixed, group, motion, e)
        end do
    end subroutine lay_out

    pure subroutine lay_out_factors(algebra, roles, p, e)
        !! A product of what all terms share, of a sum of masses, and of a sum of other names, where
        !! it is one; as it is, if not.
        type(algebra_t), intent(in) :: algebra     !! of the atoms
        integer, intent(in) :: roles(:)            !! of each name
        type(polynomial_t), intent(in) :: p        !! any
        type(expression_t), intent(out) :: e       !! of the names
        type(polynomial_t) :: factors(2), rest
        type(expression_t) :: bracket
        type(number_t) :: coefficient
        logical :: fixed(most_atoms), product
        integer :: powers(most_atoms)

        e = whole(0)
        if (p%terms == 0) return
        call p%common(coefficient, powers)
        rest = p%shifted(ratio(1_i8, 1_i8)/coefficient, -powers)
        call split(roles, rest, factors, product)
        if (.not. product) then
            call lay_out_fraction(algebra, roles, p, one_polynomial(), e)
            return
        end if
        call find_fixed(algebra, roles, fixed)
        call add_product(algebra, roles, fixed, coefficient, powers, factors(2), e)
        call lay_out(algebra, roles, factors(1), bracket)
        call multiply(e, bracket)
    end subroutine lay_out_factors

    pure recursive subroutine lay_out_fraction(algebra, roles, numerator, denominator, e)
        !! Their quotient, with common factors in front of brackets.
        type(algebra_t), intent(in) :: algebra     !! of the atoms
        integer, intent(in) :: roles(:)            !! of each name
        type(polynomial_t), intent(in) :: numerator, denominator  !! the latter not zero
        type(expression_t), intent(out) :: e       !! of the names
        type(polynomial_t) :: above, below
        type(expression_t) :: bracket
        type(number_t) :: above_number, below_number
        logical :: fixed(most_atoms)
        integer :: above_powers(most_atoms), below_powers(most_atoms)

        e = whole(0)
        if (numerator%terms == 0) return
        call find_fixed(algebra, roles, fixed)
        call numerator%common(above_number, above_powers)
        call denominator%common(below_number, below_powers)
        above = numerator%shifted(ratio(1_i8, 1_i8)/above_number, -above_powers)
        below = denominator%shifted(ratio(1_i8, 1_i8)/below_number, -below_powers)
        above_number = above_number/below_number
        if (2*count(above%coefficient(:above%terms)%value < 0.0_dp) > above%terms) then
            above = above%shifted(ratio(-1_i8, 1_i8), 0*above_powers)
            above_number = -above_number
        end if
        if (all(above%power(:, :above%terms) == 0 .or. spread(fixed, 2, above%terms))) then
            call turn_leading(roles, above_number, above)
        end if
        if (below%terms > 1) then
            call lay_out(algebra, roles, below, bracket)
            call add_product(algebra, roles, fixed, above_number, above_powers - below_powers, &
                             above, e, bracket)
        else
            call add_product(algebra, roles, fixed, above_number, above_powers - below_powers, &
                             above, e)
        end if
    end subroutine lay_out_fraction

    pure subroutine find_fixed(algebra, roles, fixed)
        !! The atoms of parameters only.
        type(algebra_t), intent(in) :: algebra
        integer, intent(in) :: roles(:)
        logical, intent(out) :: fixed(most_atoms)
        integer :: i
        integer, allocatable :: moving(:)

        allocate (moving, source=pack([(i, i=1, size(roles))], roles > role_parameter))
        fixed = .true.
        do i = 1, algebra%count
            fixed(i) = .not. algebra%uses(i, moving)
        end do
    end subroutine find_fixed

    pure function key(algebra, roles, fixed, powers) result(order)
        !! Smaller comes first: accelerations, squares of velocities, velocities, the rest, and of
        !! each what has fewer functions in it.
        type(algebra_t), intent(in) :: algebra
        integer, intent(in) :: roles(:), powers(:)
        logical, intent(in) :: fixed(:)
        integer :: order
        integer :: functions, i, velocities

        order = 300
        functions = 0
        velocities = 0
        do i = 1, algebra%count
            if (powers(i) == 0 .or. fixed(i)) cycle
            if (algebra%atoms(i)%kind /= atom_symbol) then
                functions = functions + 1
            else if (roles(i) == role_multiplier) then
                order = 400
            else if (roles(i) == role_frequency) then
                order = 200 - powers(i)
            else if (roles(i) == role_acceleration) then
                order = 0
            else if (roles(i) == role_velocity) then
                velocities = velocities + powers(i)
            end if
        end do
        if (order == 300 .and. velocities > 0) order = max(100, 300 - 100*velocities)
        order = order + functions
    end function key

    pure recursive subroutine add_group(algebra, roles, fixed, group, motion, e)
        !! A polynomial of parameters times what moves.
        type(algebra_t), intent(in) :: algebra
        integer, intent(in) :: roles(:), motion(:)
        logical, intent(in) :: fixed(:)
        type(polynomial_t), intent(in) :: group
        type(expression_t), intent(inout) :: e
        type(polynomial_t) :: factors(2), rest
        type(number_t) :: coefficient
        logical :: product
        integer :: powers(most_atoms)

        call group%common(coefficient, powers)
        rest = group%shifted(ratio(1_i8, 1_i8)/coefficient, -powers)
        call turn_leading(roles, coefficient, rest)
        call split(roles, rest, factors, product)
        if (all(motion == 0) .and. all(powers == 0) .and. rest%terms > 1 .and. &
            coefficient%is_whole() .and. abs(coefficient%numerator) == 1_i8 .and. &
            .not. product) then
            call add_terms(algebra, roles, fixed, group, e)
        else
            call add_product(algebra, roles, fixed, coefficient, powers + motion, rest, e)
        end if
    end subroutine add_group

    pure recursive subroutine add_terms(algebra, roles, fixed, p, e)
        !! One after the other, without brackets.
        type(algebra_t), intent(in) :: algebra
        integer, intent(in) :: roles(:)
        logical, intent(in) :: fixed(:)
        type(polynomial_t), intent(in) :: p
        type(expression_t), intent(inout) :: e
        type(polynomial_t) :: one
        integer :: first, i

        one = one_polynomial()
        first = leading(roles, p)
        call add_product(algebra, roles, fixed, p%coefficient(first), p%power(:, first), one, e)
        do i = 1, p%terms
            if (i == first) cycle
            call add_product(algebra, roles, fixed, p%coefficient(i), p%power(:, i), one, e)
        end do
    end subroutine add_terms

    pure recursive subroutine add_product(algebra, roles, fixed, coefficient, powers, factor, e, &
                                          below)
        !! Add a number times powers times `factor`, over `below`.
        type(algebra_t), intent(in) :: algebra
        integer, intent(in) :: roles(:), powers(:)
        logical, intent(in) :: fixed(:)
        type(number_t), intent(in) :: coefficient
        type(polynomial_t), intent(in) :: factor
        type(expression_t), intent(inout) :: e
        type(expression_t), intent(in), optional :: below
        type(expression_t) :: bracket, bottom, first, number, product, second
        type(number_t) :: size_of
        type(polynomial_t) :: factors(2)
        logical :: bracket_first, constant_bracket, is_product, plain(most_atoms)
        integer :: denominator, i

        size_of = coefficient
        if (coefficient%value < 0.0_dp) size_of = -coefficient
        constant_bracket = .false.
        if (factor%terms > 1) then
            constant_bracket = all(factor%power(:, :factor%terms) == 0 .or. &
                                   spread(fixed, 2, factor%terms))
            if (constant_bracket) then
                call split(roles, factor, factors, is_product)
                if (is_product) call add_terms(algebra, roles, fixed, factors(2), bracket)
                if (is_product) call add_terms(algebra, roles, fixed, factors(1), second)
                if (.not. is_product) call add_terms(algebra, roles, fixed, factor, bracket)
                if (is_product) bracket = bracket*second
                second = expression_t()
            else
                call lay_out(algebra, roles, factor, bracket)
            end if
        end if
        bracket_first = factor%terms > 1 .and. constant_bracket
        ! Numerators: parameters, then what moves.
        if (bracket_first) first = bracket
        plain = fixed .and. [(role_of(algebra, roles, i) /= role_function, i=1, most_atoms)]
        call multiply_atoms(algebra, roles, powers, plain, first)
        call multiply_atoms(algebra, roles, powers, .not. plain, second)
        if (factor%terms > 1 .and. .not. bracket_first) call multiply(second, bracket)
        call multiply_atoms(algebra, roles, -powers, plain .or. .true., bottom)
        if (present(below)) call multiply(bottom, below)
        denominator = 1
        if (size_of%is_exact()) then
            if (size_of%numerator /= 1_i8 .or. &
                (first%count == 0 .and. second%count == 0 .and. bottom%count == 0)) then
                number = whole_number(size_of%numerator)
            end if
            if (size_of%denominator /= 1_i8) denominator = int(size_of%denominator)
        else
            number = constant(size_of%value)
        end if
        if (bottom%count == 0) then
            if (denominator > 1 .and. number%count == 0 .and. first%count > 0) then
                call divide_first(algebra, roles, powers, plain, bracket_first, bracket, &
                                  denominator, first)
            else if (denominator > 1) then
                if (number%count == 0) number = whole(1)
                number = number/whole(denominator)
            end if
            call multiply(number, first)
            call multiply(number, second)
            product = number
        else
            if (denominator > 1) then
                product = whole(denominator)
                call multiply(product, bottom)
                bottom = product
            end if
            call multiply(number, first)
            if (number%count == 0 .or. present(below)) then
                call multiply(number, second)
                if (number%count == 0) number = whole(1)
                product = number/bottom
            else
                product = number/bottom
                call multiply(product, second)
            end if
        end if
        if (e%is_zero()) then
            e = product
            if (coefficient%value < 0.0_dp) e = -e
        else if (coefficient%value < 0.0_dp) then
            e = e - product
        else
            e = e + product
        end if
    end subroutine add_product

    pure function whole_number(n) result(e)
        !! As an expression.
        integer(i8), intent(in) :: n
        type(expression_t) :: e

        e = constant(real(n, dp))
    end function whole_number

    pure recursive subroutine multiply_atoms(algebra, roles, powers, wanted, e)
        !! Times the positive powers of wanted atoms, in the order of their roles.
        type(algebra_t), intent(in) :: algebra
        integer, intent(in) :: roles(:), powers(:)
        logical, intent(in) :: wanted(:)
        type(expression_t), intent(inout) :: e
        type(expression_t) :: one
        integer :: i, role

        do role = role_number, last_role
            do i = 1, algebra%count
                if (powers(i) <= 0 .or. .not. wanted(i)) cycle
                if (role_of(algebra, roles, i) /= role) cycle
                call atom_expression(algebra, roles, i, one)
                if (powers(i) > 1) one = one**powers(i)
                call multiply(e, one)
            end do
        end do
    end subroutine multiply_atoms

    pure recursive subroutine divide_first(algebra, roles, powers, fixed, bracketed, bracket, &
                                           denominator, e)
        !! The first factor over a number: `m2/2 l^2`.
        type(algebra_t), intent(in) :: algebra
        integer, intent(in) :: roles(:), powers(:), denominator
        logical, intent(in) :: fixed(:), bracketed
        type(expression_t), intent(in) :: bracket
        type(expression_t), intent(inout) :: e
        type(expression_t) :: one
        integer :: i, others(size(powers)), role

        others = powers
        if (bracketed) then
            one = bracket
        else
            search: do role = role_number, last_role
                do i = 1, algebra%count
                    if (powers(i) <= 0 .or. .not. fixed(i)) cycle
                    if (role_of(algebra, roles, i) /= role) cycle
                    call atom_expression(algebra, roles, i, one)
                    if (powers(i) > 1) one = one**powers(i)
                    others(i) = 0
                    exit search
                end do
            end do search
        end if
        e = one/whole(denominator)
        call multiply_atoms(algebra, roles, others, fixed, e)
    end subroutine divide_first

    pure function role_of(algebra, roles, atom) result(role)
        !! Where it stands in a product.
        type(algebra_t), intent(in) :: algebra
        integer, intent(in) :: roles(:), atom
        integer :: role

        role = role_function
        if (atom > algebra%count) return
        if (algebra%atoms(atom)%kind == atom_symbol) role = roles(atom)
        if (algebra%atoms(atom)%kind == atom_number_pi) role = role_number
    end function role_of

    pure recursive subroutine atom_expression(algebra, roles, atom, e)
        !! The name, or the function with its argument laid out.
        type(algebra_t), intent(in) :: algebra
        integer, intent(in) :: roles(:), atom
        type(expression_t), intent(out) :: e
        type(expression_t) :: argument

        if (algebra%atoms(atom)%kind == atom_symbol) then
            e = symbol(atom)
            return
        else if (algebra%atoms(atom)%kind == atom_number_pi) then
            e = constant(acos(-1.0_dp))
            return
        end if
        call lay_out(algebra, roles, algebra%atoms(atom)%argument, argument)
        select case (algebra%atoms(atom)%kind)
        case (atom_sum)
            e = argument
        case (atom_root)
            e = argument**number_expression(algebra%atoms(atom)%exponent)
        case default
            e = apply(algebra%atoms(atom)%which, argument)
        end select
    end subroutine atom_expression

    pure function number_expression(number) result(e)
        !! A number as an expression.
        type(number_t), intent(in) :: number
        type(expression_t) :: e

        e = constant(abs(number%value))
        if (number%is_exact()) e = whole_number(abs(number%numerator)) &
                                   /whole_number(number%denominator)
        if (number%value < 0.0_dp) e = -e
    end function number_expression

    pure recursive subroutine multiply(e, factor)
        !! Times `factor`, where there is one, factor by factor.
        type(expression_t), intent(inout) :: e
        type(expression_t), intent(in) :: factor

        if (factor%count == 0) return
        associate (root => factor%nodes(factor%count))
            if (e%count == 0) then
                e = factor
            else if (root%kind == kind_product) then
                call multiply(e, factor%pruned(root%left))
                call multiply(e, factor%pruned(root%right))
            else
                e = e*factor
            end if
        end associate
    end subroutine multiply
end module lagrangia_page_layout
