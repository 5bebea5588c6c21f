module lagrangia_canonical_form
    !! Formulas as the lecture writes them: sums of monomials, terms collected, in the order of the
    !! page. What cannot be taken apart within bounds stays as it is: never wrong, perhaps long.
    !!
    !! Equal wherever both have a value: \(x/x\) is 1, \(\sqrt{x}^2\) is \(x\).
    use lagrangia_atoms, only: find_atom, new_table, single_factor, table_t
    use lagrangia_elementary, only: find_function
    use lagrangia_exact_number, only: number_of, number_t
    use lagrangia_expression, only: expression_t, f_sqrt, kind_difference, kind_negation, &
                                    kind_number, kind_power, kind_product, kind_quotient, &
                                    kind_sum, kind_symbol
    use lagrangia_kinds, only: dp, i8
    use lagrangia_layout, only: write_sum
    use lagrangia_monomials, only: atom_number_pi, atom_power, atom_symbol, sum_t
    use lagrangia_number_class, only: is_zero
    use lagrangia_reduction, only: reduce, whole_power
    use lagrangia_sums, only: constant_sum, is_constant, plus, scaled, times
    use lagrangia_symbols, only: symbols_t
    implicit none (type, external)
    private
    public :: simplified, split_terms

    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    pure function simplified(expression, symbols) result(e)
        !! The formula in the canonical form.
        type(expression_t), intent(in) :: expression  !! of the symbols
        type(symbols_t), intent(in) :: symbols        !! their names tell what they are
        type(expression_t) :: e
        type(table_t) :: table
        type(sum_t) :: s
        logical :: fits

        call new_table(table, symbols)
        call as_sum(table, expression, s, fits)
        if (fits) then
            call write_sum(table, s, e)
        else
            e = expression
        end if
    end function simplified

    pure subroutine as_sum(table, expression, s, fits)
        !! Node by node; what is no longer needed is given back.
        type(table_t), intent(inout) :: table
        type(expression_t), intent(in) :: expression
        type(sum_t), intent(out) :: s
        logical, intent(out) :: fits
        type(sum_t), allocatable :: inverse(:), value(:)
        logical :: divides(0:expression%count)
        integer :: i, k, last(0:expression%count), operand(2)

        fits = .true.
        allocate (value(0:expression%count), inverse(0:expression%count))
        call find_uses(expression, last, divides)
        do i = 1, expression%count
            call node_sum(table, expression, i, value, inverse, fits)
            if (fits .and. divides(i)) call invert(table, expression, i, value, inverse, fits)
            if (.not. fits) return
            operand = [expression%nodes(i)%left, expression%nodes(i)%right]
            do k = 1, 2
                if (last(operand(k)) /= i) cycle
                if (allocated(value(operand(k))%terms)) deallocate (value(operand(k))%terms)
                if (allocated(inverse(operand(k))%terms)) deallocate (inverse(operand(k))%terms)
            end do
        end do
        s = value(expression%count)
    end subroutine as_sum

    pure subroutine find_uses(expression, last, divides)
        !! The last node that needs each node, and which nodes are factors of a denominator.
        type(expression_t), intent(in) :: expression
        integer, intent(out) :: last(0:expression%count)
        logical, intent(out) :: divides(0:expression%count)
        integer :: i

        last = 0
        divides = .false.
        do i = 1, expression%count
            last(expression%nodes(i)%left) = i
            last(expression%nodes(i)%right) = i
        end do
        last(0) = 0
        do i = expression%count, 1, -1
            associate (node => expression%nodes(i))
                if (node%kind == kind_quotient) divides(node%right) = .true.
                if (node%kind == kind_product .and. divides(i)) then
                    divides(node%left) = .true.
                    divides(node%right) = .true.
                end if
            end associate
        end do
    end subroutine find_uses

    pure subroutine invert(table, expression, i, value, inverse, fits)
        !! One over node `i`, its factors apart: \(1/(a + b)^2\) is not multiplied out.
        type(table_t), intent(inout) :: table
        type(expression_t), intent(in) :: expression
        integer, intent(in) :: i
        type(sum_t), intent(in) :: value(0:)
        type(sum_t), intent(inout) :: inverse(0:)
        logical, intent(inout) :: fits
        type(sum_t) :: new
        type(number_t) :: n

        associate (node => expression%nodes(i))
            n = number_t()
            if (node%kind == kind_power) then
                if (is_constant(value(node%right)) .and. value(node%right)%count == 1) then
                    n = value(node%right)%terms(1)%coefficient
                end if
            end if
            if (node%kind == kind_product) then
                call times(table%order, inverse(node%left), inverse(node%right), new, fits)
            else if (n%is_whole() .and. .not. n%is_zero() .and. abs(n%value) < 1000.0_dp) then
                call whole_power(table, value(node%left), -int(n%numerator), new, fits)
            else
                call whole_power(table, value(i), -1, new, fits)
            end if
        end associate
        if (fits) call reduce(table, new, fits)
        inverse(i) = new
    end subroutine invert

    pure subroutine node_sum(table, expression, i, value, inverse, fits)
        !! The sum that node `i` is, from those of its operands.
        type(table_t), intent(inout) :: table
        type(expression_t), intent(in) :: expression
        integer, intent(in) :: i
        type(sum_t), intent(inout) :: value(0:)
        type(sum_t), intent(in) :: inverse(0:)
        logical, intent(inout) :: fits
        type(sum_t) :: new, none
        integer :: atom

        associate (node => expression%nodes(i), a => expression%nodes(i)%left, &
                   b => expression%nodes(i)%right)
            select case (node%kind)
            case (kind_number)
                if (is_zero(abs(node%number%value) - pi)) then
                    call find_atom(table, atom_number_pi, 0, none, none, atom)
                    new = scaled(single_factor(atom, 1), &
                                 number_of(sign(1.0_dp, node%number%value)))
                else
                    new = constant_sum(node%number)
                end if
            case (kind_symbol)
                call find_atom(table, atom_symbol, node%which, none, none, atom)
                new = single_factor(atom, 1)
            case (kind_sum)
                call plus(table%order, value(a), value(b), new, fits)
            case (kind_difference)
                call plus(table%order, value(a), scaled(value(b), number_of(-1.0_dp)), new, fits)
            case (kind_negation)
                new = scaled(value(a), number_of(-1.0_dp))
            case (kind_product)
                call times(table%order, value(a), value(b), new, fits)
            case (kind_quotient)
                call times(table%order, value(a), inverse(b), new, fits)
            case (kind_power)
                call general_power(table, value(a), value(b), new, fits)
            case default
                call find_function(table, node%which, value(a), new)
            end select
        end associate
        if (fits) call reduce(table, new, fits)
        value(i) = new
    end subroutine node_sum

    pure subroutine general_power(table, base, exponent, power, fits)
        !! Whole exponents are multiplied out, halves are roots, others stay.
        type(table_t), intent(inout) :: table
        type(sum_t), intent(in) :: base, exponent
        type(sum_t), intent(out) :: power
        logical, intent(inout) :: fits
        type(sum_t) :: root
        type(number_t) :: n
        integer :: atom

        if (is_constant(exponent)) then
            n = number_t()
            if (exponent%count == 1) n = exponent%terms(1)%coefficient
            if (n%is_whole() .and. abs(n%value) < 1000.0_dp) then
                call whole_power(table, base, int(n%numerator), power, fits)
                return
            else if (n%denominator == 2_i8 .and. abs(n%value) < 100.0_dp) then
                call find_function(table, f_sqrt, base, root)
                call whole_power(table, root, int(n%numerator), power, fits)
                return
            end if
        end if
        call find_atom(table, atom_power, 0, base, exponent, atom)
        power = single_factor(atom, 1)
    end subroutine general_power

    pure subroutine split_terms(expression, terms)
        !! The summands of a formula, with their signs: \(a - b\) gives \(a\) and \(-b\).
        type(expression_t), intent(in) :: expression             !! any
        type(expression_t), allocatable, intent(out) :: terms(:) !! one at least
        integer :: root(expression%count + 1), i, k, n, node
        logical :: negative(expression%count + 1), turned

        n = 0
        i = expression%count
        turned = .false.
        do while (i > 0)
            associate (at => expression%nodes(i))
                n = n + 1
                negative(n) = turned
                root(n) = i
                if (at%kind == kind_sum .or. at%kind == kind_difference) then
                    root(n) = at%right
                    negative(n) = turned .neqv. at%kind == kind_difference
                    i = at%left
                else if (at%kind == kind_negation) then
                    n = n - 1
                    turned = .not. turned
                    i = at%left
                else
                    exit
                end if
            end associate
        end do
        allocate (terms(max(1, n)))
        do i = 1, n
            k = n + 1 - i
            terms(i) = expression%pruned(root(k))
            if (negative(k)) then
                call terms(i)%add_operation(kind_negation, terms(i)%count, 0, node)
            end if
        end do
    end subroutine split_terms
end module lagrangia_canonical_form
