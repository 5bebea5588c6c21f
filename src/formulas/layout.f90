module lagrangia_layout
    !! Sums as the lecture writes them: `(m1 + m2)/2 x_dot^2 + m2 l x_dot theta_dot cos(theta)`.
    !!
    !! Terms that differ in parameters only are collected in brackets. A denominator of parameters
    !! follows the parameters, `g/l sin(theta)`, any other stands at the end.
    use lagrangia_atoms, only: table_t
    use lagrangia_exact_number, only: number_of, number_t, operator(-), &
                                      operator(/), ratio
    use lagrangia_expression, only: expression_t, kind_difference, kind_function, kind_negation, &
                                    kind_power, kind_product, kind_quotient, kind_sum
    use lagrangia_formula_text, only: number_in_formula
    use lagrangia_kinds, only: dp, i8
    use lagrangia_monomials, only: atom_function, atom_number_pi, atom_sum, atom_symbol, &
                                   inverse, is_coefficient, multiply, &
                                   same_state_part, sum_t, term_t
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_sums, only: add_term, common_factor
    implicit none (type, external)
    private
    public :: write_sum

    real(dp), parameter :: pi = acos(-1.0_dp)

    type :: written_t
        !! What is written, and where each atom already stands.
        type(expression_t) :: e
        integer, allocatable :: node_of(:)
    end type written_t

contains

    pure subroutine write_sum(table, s, e)
        !! The formula that a sum is.
        type(table_t), intent(in) :: table     !! of the atoms
        type(sum_t), intent(in) :: s           !! of them
        type(expression_t), intent(out) :: e   !! the same
        type(written_t) :: written
        integer :: root

        allocate (written%node_of(table%order%count), source=0)
        call put_sum(table, s, written, root)
        e = written%e%pruned(root)
    end subroutine write_sum

    pure recursive subroutine put_sum(table, s, written, root)
        !! Over the denominator that all terms share, if there is one with a sum in it.
        type(table_t), intent(in) :: table
        type(sum_t), intent(in) :: s
        type(written_t), intent(inout) :: written
        integer, intent(out) :: root
        type(sum_t) :: above
        type(term_t) :: denominator
        integer :: bottom, quotient, top
        logical :: fits, negative

        if (s%count > 1) then
            call shared_denominator(table, s, denominator)
            negative = all(s%terms(:s%count)%coefficient%value < 0.0_dp)
            if (negative) denominator%coefficient = -denominator%coefficient
            if (denominator%count > 0) then
                call multiplied(table, s, denominator, above, fits)
                if (fits) then
                    call put_groups(table, above, written, top)
                    negative = negative .neqv. written%e%nodes(top)%kind == kind_negation
                    if (written%e%nodes(top)%kind == kind_negation) top = written%e%nodes(top)%left
                    bottom = 0
                    call put_factors(table, denominator, written, bottom)
                    call written%e%add_operation(kind_quotient, top, bottom, root)
                    quotient = root
                    if (negative) call written%e%add_operation(kind_negation, quotient, 0, root)
                    return
                end if
            end if
        end if
        call put_groups(table, s, written, root)
    end subroutine put_sum

    pure subroutine shared_denominator(table, s, denominator)
        !! What all terms are divided by, with a sum among it; else nothing.
        type(table_t), intent(in) :: table
        type(sum_t), intent(in) :: s
        type(term_t), intent(out) :: denominator
        type(term_t) :: factor
        logical :: has_sum
        integer :: k

        factor = common_factor(table%order, s, .false.)
        has_sum = .false.
        do k = 1, factor%count
            has_sum = has_sum .or. (factor%power(k) < 0 .and. &
                                    table%order%atoms(factor%atom(k))%kind == atom_sum)
        end do
        denominator%coefficient = number_of(1.0_dp)
        if (.not. has_sum) return
        factor = common_factor(table%order, s, .true.)
        do k = 1, factor%count
            if (factor%power(k) < 0) call keep(factor, k, -1, denominator)
        end do
    end subroutine shared_denominator

    pure subroutine multiplied(table, s, factor, product, fits)
        !! Every term by the same factor.
        type(table_t), intent(in) :: table
        type(sum_t), intent(in) :: s
        type(term_t), intent(in) :: factor
        type(sum_t), intent(out) :: product
        logical, intent(out) :: fits
        type(term_t) :: term
        integer :: i

        fits = .true.
        do i = 1, s%count
            call multiply(table%order, s%terms(i), factor, term, fits)
            if (.not. fits) return
            call add_term(table%order, product, term)
        end do
    end subroutine multiplied

    pure recursive subroutine put_groups(table, s, written, root)
        !! Terms, those collected that differ in parameters only.
        type(table_t), intent(in) :: table
        type(sum_t), intent(in) :: s
        type(written_t), intent(inout) :: written
        integer, intent(out) :: root
        integer :: first, i, last

        root = 0
        if (s%count == 0) call written%e%add_number(number_t(), root)
        first = 1
        do while (first <= s%count)
            last = first
            do while (last < s%count)
                if (.not. same_state_part(table%order, s%terms(first), s%terms(last + 1))) exit
                last = last + 1
            end do
            if (is_worth_a_bracket(table, s, first, last)) then
                call put_bracket(table, s, first, last, written, root)
            else
                do i = first, last
                    call put_term(table, s%terms(i), 0, written, root)
                end do
            end if
            first = last + 1
        end do
    end subroutine put_groups

    pure function is_worth_a_bracket(table, s, first, last) result(yes)
        !! Several terms that have a factor in common?
        type(table_t), intent(in) :: table
        type(sum_t), intent(in) :: s
        integer, intent(in) :: first, last
        logical :: yes
        type(sum_t) :: group
        type(term_t) :: factor

        yes = .false.
        if (first == last) return
        call part(table, s, first, last, group)
        factor = common_factor(table%order, group, .false.)
        yes = factor%count > 0
    end function is_worth_a_bracket

    pure subroutine part(table, s, first, last, group)
        !! Some terms of a sum.
        type(table_t), intent(in) :: table
        type(sum_t), intent(in) :: s
        integer, intent(in) :: first, last
        type(sum_t), intent(out) :: group
        integer :: i

        do i = first, last
            call add_term(table%order, group, s%terms(i))
        end do
    end subroutine part

    pure recursive subroutine put_bracket(table, s, first, last, written, root)
        !! The common factor of some terms, times what is left of them.
        type(table_t), intent(in) :: table
        type(sum_t), intent(in) :: s
        integer, intent(in) :: first, last
        type(written_t), intent(inout) :: written
        integer, intent(inout) :: root
        type(sum_t) :: group, rest
        type(term_t) :: factor
        integer :: bracket, i
        logical :: fits

        call part(table, s, first, last, group)
        factor = common_factor(table%order, group, .true.)
        call over(table, group, factor, rest, fits)
        if (fits) fits = all(rest%terms(:rest%count)%count <= 1)
        if (.not. fits) then  ! (g/l + k/m) theta, but (m1 + m2) g/(m1 l)
            factor = common_factor(table%order, group, .false.)
            call over(table, group, factor, rest, fits)
        end if
        if (fits) then
            call put_sum(table, rest, written, bracket)
            call put_term(table, factor, bracket, written, root)
        else
            do i = 1, group%count
                call put_term(table, group%terms(i), 0, written, root)
            end do
        end if
    end subroutine put_bracket

    pure subroutine over(table, group, factor, rest, fits)
        !! Terms over a factor of all of them, of which decimals are no part.
        type(table_t), intent(in) :: table
        type(sum_t), intent(in) :: group
        type(term_t), intent(inout) :: factor
        type(sum_t), intent(out) :: rest
        logical, intent(out) :: fits
        type(term_t) :: opposite

        if (.not. is_plain(factor%coefficient)) then
            factor%coefficient = number_of(sign(1.0_dp, factor%coefficient%value))
        end if
        opposite = inverse(factor)
        opposite%coefficient = number_of(1.0_dp)/factor%coefficient
        call multiplied(table, group, opposite, rest, fits)
    end subroutine over

    pure function is_plain(number) result(yes)
        !! A whole number or a fraction, but no decimal?
        type(number_t), intent(in) :: number
        logical :: yes

        yes = number%is_whole() .or. scan(number_in_formula(number), "/") > 0
    end function is_plain

    pure recursive subroutine put_term(table, term, bracket, written, root)
        !! One more summand: a monomial, perhaps times a bracket that stands at node `bracket`.
        type(table_t), intent(in) :: table
        type(term_t), intent(in) :: term
        integer, intent(in) :: bracket
        type(written_t), intent(inout) :: written
        integer, intent(inout) :: root
        integer :: before, node
        logical :: negative

        negative = term%coefficient%value < 0.0_dp
        call put_product(table, term, bracket, written, node)
        before = root
        if (before > 0) then
            call written%e%add_operation(merge(kind_difference, kind_sum, negative), before, node, &
                                      root)
        else if (negative) then
            call written%e%add_operation(kind_negation, node, 0, root)
        else
            root = node
        end if
    end subroutine put_term

    pure recursive subroutine put_product(table, term, bracket, written, node)
        !! The modulus of the coefficient, the bracket, and all factors.
        type(table_t), intent(in) :: table
        type(term_t), intent(in) :: term
        integer, intent(in) :: bracket
        type(written_t), intent(inout) :: written
        integer, intent(out) :: node
        type(term_t) :: below, parameters, state
        type(number_t) :: c, over, under
        integer :: k
        logical :: at_the_end

        c = term%coefficient
        if (c%value < 0.0_dp) c = -c
        over = c
        under = number_of(1.0_dp)
        if (scan(number_in_formula(c), "/") > 0) then
            over = ratio(c%numerator, 1_i8)
            under = ratio(c%denominator, 1_i8)
        end if
        below%coefficient = under
        at_the_end = .false.
        do k = 1, term%count
            if (term%power(k) < 0) then
                call keep(term, k, -1, below)
                at_the_end = at_the_end .or. .not. is_coefficient(table%order, term%atom(k))
            else if (is_coefficient(table%order, term%atom(k))) then
                call keep(term, k, 1, parameters)
            else
                call keep(term, k, 1, state)
            end if
        end do
        at_the_end = at_the_end .or. (bracket == 0 .and. parameters%count == 0)
        node = 0
        if (at_the_end .and. below%count == 0 .and. under%value > 1.0_dp) then
            over = c  ! 1/2 x^2
            below%coefficient = number_of(1.0_dp)
        else if (below%count == 0 .and. under%value > 1.0_dp .and. over%value > 1.0_dp) then
            over = c  ! 3/2 m x^2
            below%coefficient = number_of(1.0_dp)
        end if
        if (is_nonzero(over%value - 1.0_dp)) call written%e%add_number(over, node)
        if (bracket > 0) call join(written, kind_product, bracket, node)
        if (below%count == 0 .and. below%coefficient%value > 1.0_dp) then
            call put_halved(table, parameters, below%coefficient, bracket > 0, written, node)
        else
            call put_factors(table, parameters, written, node)
        end if
        if (.not. at_the_end) call put_denominator(table, below, written, node)
        call put_factors(table, state, written, node)
        if (at_the_end) call put_denominator(table, below, written, node)
        if (node == 0) call written%e%add_number(over, node)
    end subroutine put_product

    pure subroutine keep(term, k, sign_of, list)
        !! Factor `k` of a term at the end of another one.
        type(term_t), intent(in) :: term
        integer, intent(in) :: k, sign_of
        type(term_t), intent(inout) :: list

        list%count = list%count + 1
        list%atom(list%count) = term%atom(k)
        list%power(list%count) = sign_of*term%power(k)
    end subroutine keep

    pure subroutine join(written, kind, new, node)
        !! A factor or a divisor behind what is there.
        type(written_t), intent(inout) :: written
        integer, intent(in) :: kind, new
        integer, intent(inout) :: node
        integer :: before

        if (node == 0 .and. kind == kind_product) then
            node = new
            return
        end if
        if (node == 0) call written%e%add_number(number_of(1.0_dp), node)
        before = node
        call written%e%add_operation(kind, before, new, node)
    end subroutine join

    pure recursive subroutine put_factors(table, term, written, node)
        !! Powers of atoms, all positive.
        type(table_t), intent(in) :: table
        type(term_t), intent(in) :: term
        type(written_t), intent(inout) :: written
        integer, intent(inout) :: node
        integer :: k, new

        do k = 1, term%count
            call put_power(table, term%atom(k), term%power(k), written, new)
            call join(written, kind_product, new, node)
        end do
    end subroutine put_factors

    pure recursive subroutine put_halved(table, term, divisor, has_bracket, written, node)
        !! `m/2 l^2`, `(m1 + m2)/2 l^2`: the divisor stands behind the first factor.
        type(table_t), intent(in) :: table
        type(term_t), intent(in) :: term
        type(number_t), intent(in) :: divisor
        logical, intent(in) :: has_bracket
        type(written_t), intent(inout) :: written
        integer, intent(inout) :: node
        type(term_t) :: rest
        integer :: k, new

        k = 1
        if (.not. has_bracket) then
            call put_power(table, term%atom(1), term%power(1), written, new)
            call join(written, kind_product, new, node)
            k = 2
        end if
        call written%e%add_number(divisor, new)
        call join(written, kind_quotient, new, node)
        do k = k, term%count
            call keep(term, k, 1, rest)
        end do
        call put_factors(table, rest, written, node)
    end subroutine put_halved

    pure recursive subroutine put_denominator(table, below, written, node)
        !! One bracket for all that a term is divided by.
        type(table_t), intent(in) :: table
        type(term_t), intent(in) :: below
        type(written_t), intent(inout) :: written
        integer, intent(inout) :: node
        integer :: bottom

        if (below%count == 0) return
        bottom = 0
        if (below%coefficient%value > 1.0_dp) call written%e%add_number(below%coefficient, bottom)
        call put_factors(table, below, written, bottom)
        call join(written, kind_quotient, bottom, node)
    end subroutine put_denominator

    pure recursive subroutine put_power(table, atom, power, written, node)
        !! An atom, perhaps to a power.
        type(table_t), intent(in) :: table
        integer, intent(in) :: atom, power
        type(written_t), intent(inout) :: written
        integer, intent(out) :: node
        integer :: base, exponent

        if (written%node_of(atom) == 0) call put_atom(table, atom, written)
        node = written%node_of(atom)
        if (power == 1) return
        base = node
        call written%e%add_number(number_of(real(power, dp)), exponent)
        call written%e%add_operation(kind_power, base, exponent, node)
    end subroutine put_power

    pure recursive subroutine put_atom(table, atom, written)
        !! A symbol, a function, a sum, a general power, or pi.
        type(table_t), intent(in) :: table
        integer, intent(in) :: atom
        type(written_t), intent(inout) :: written
        integer :: argument, exponent, node

        associate (a => table%order%atoms(atom))
            select case (a%kind)
            case (atom_number_pi)
                call written%e%add_number(number_of(pi), node)
            case (atom_symbol)
                call written%e%add_symbol(a%which, node)
            case (atom_sum)
                call put_sum(table, table%sums(a%argument), written, node)
            case (atom_function)
                call put_sum(table, table%sums(a%argument), written, argument)
                call written%e%add_operation(kind_function, argument, 0, node, a%which)
            case default
                call put_sum(table, table%sums(a%argument), written, argument)
                call put_sum(table, table%sums(a%exponent), written, exponent)
                call written%e%add_operation(kind_power, argument, exponent, node)
            end select
        end associate
        written%node_of(atom) = node
    end subroutine put_atom
end module lagrangia_layout
