module lagrangia_derivative
    !! Derivatives of formulas, exact and unsimplified: by a symbol, and by the time along a motion.
    use lagrangia_exact_number, only: number_of, number_t, operator(-), ratio
    use lagrangia_expression, only: expression_t, f_abs, f_atan, f_cos, f_cosh, f_exp, f_log, &
                                    f_sgn, f_sin, f_sinh, f_sqrt, f_tan, kind_difference, &
                                    kind_function, kind_negation, kind_number, kind_power, &
                                    kind_product, kind_quotient, kind_sum, kind_symbol
    use lagrangia_kinds, only: dp, i8
    implicit none (type, external)
    private
    public :: derivative, time_derivative

    integer, parameter :: nothing = 0, itself = -1  !! what a symbol becomes, or the symbol it does

contains

    pure function derivative(expression, which) result(d)
        !! The partial derivative by one symbol.
        type(expression_t), intent(in) :: expression  !! of any symbols
        integer, intent(in) :: which                  !! the place of the symbol
        type(expression_t) :: d
        integer :: becomes(which)

        becomes = nothing
        becomes(which) = itself
        d = along(expression, becomes)
    end function derivative

    pure function time_derivative(expression, rates, time) result(d)
        !! \(df/dt = \partial f/\partial t + \sum_i \dot s_i\,\partial f/\partial s_i\).
        type(expression_t), intent(in) :: expression  !! of the symbols \(s_i\)
        integer, intent(in) :: rates(:)               !! place of the symbol \(\dot s_i\), 0 if none
        integer, intent(in) :: time                   !! place of the time, 0 if it is no symbol
        type(expression_t) :: d
        integer :: becomes(size(rates))

        becomes = rates
        if (time > 0) becomes(time) = itself
        d = along(expression, becomes)
    end function time_derivative

    pure function along(expression, becomes) result(d)
        !! Node by node, each derivative from those of the operands; 0 stands for zero.
        type(expression_t), intent(in) :: expression
        integer, intent(in) :: becomes(:)
        type(expression_t) :: d, all
        integer :: of(0:expression%count), i, root

        all = expression
        of = 0
        do i = 1, expression%count
            associate (node => expression%nodes(i))
                if (node%kind == kind_symbol) then
                    if (node%which > size(becomes)) cycle
                    select case (becomes(node%which))
                    case (nothing)
                        continue
                    case (itself)
                        call whole(all, 1, of(i))
                    case default
                        call all%add_symbol(becomes(node%which), of(i))
                    end select
                else if (of(node%left) > 0 .or. of(node%right) > 0) then
                    if (node%kind == kind_function) then
                        call chain(all, i, of(node%left), of(i))
                    else if (is_power_of_modulus(expression, i)) then
                        call power_of_modulus(all, i, of(expression%nodes(node%left)%left), of(i))
                    else if (node%kind == kind_power) then
                        call power(all, i, of(node%left), of(node%right), of(i))
                    else
                        call combine(all, i, of(node%left), of(node%right), of(i))
                    end if
                end if
            end associate
        end do
        root = of(expression%count)
        if (root == 0) call whole(all, 0, root)
        d = all%pruned(root)
    end function along

    pure subroutine whole(all, value, node)
        !! A whole number.
        type(expression_t), intent(inout) :: all
        integer, intent(in) :: value
        integer, intent(out) :: node

        call all%add_number(ratio(int(value, i8), 1_i8), node)
    end subroutine whole

    pure subroutine product(all, a, b, node)
        !! Of two nodes; zero where one is zero, without a factor 1.
        type(expression_t), intent(inout) :: all
        integer, intent(in) :: a, b
        integer, intent(out) :: node

        if (a == 0 .or. b == 0) then
            node = 0
        else if (is_one(all, a)) then
            node = b
        else if (is_one(all, b)) then
            node = a
        else
            call all%add_operation(kind_product, a, b, node)
        end if
    end subroutine product

    pure function is_one(all, i) result(yes)
        !! Is the node the number 1?
        type(expression_t), intent(in) :: all
        integer, intent(in) :: i
        logical :: yes

        yes = .false.
        if (all%nodes(i)%kind /= kind_number) return
        yes = all%nodes(i)%number%is_whole() .and. all%nodes(i)%number%numerator == 1_i8
    end function is_one

    pure subroutine combine(all, i, left, right, node)
        !! Sums, differences, negations, products and quotients; `left` and `right` are the
        !! derivatives of the operands.
        type(expression_t), intent(inout) :: all
        integer, intent(in) :: i, left, right
        integer, intent(out) :: node
        integer :: a, b, first, second, square

        a = all%nodes(i)%left
        b = all%nodes(i)%right
        select case (all%nodes(i)%kind)
        case (kind_negation)
            call all%add_operation(kind_negation, left, 0, node)
        case (kind_sum, kind_difference)
            call join(all, all%nodes(i)%kind, left, right, node)
        case (kind_product)
            call product(all, left, b, first)
            call product(all, a, right, second)
            call join(all, kind_sum, first, second, node)
        case default
            if (right == 0) then
                call all%add_operation(kind_quotient, left, b, node)
                return
            end if
            call product(all, left, b, first)
            call product(all, a, right, second)
            call join(all, kind_difference, first, second, node)
            first = node
            call whole(all, 2, second)
            call all%add_operation(kind_power, b, second, square)
            call all%add_operation(kind_quotient, first, square, node)
        end select
    end subroutine combine

    pure subroutine join(all, kind, a, b, node)
        !! A sum or a difference, without zeros.
        type(expression_t), intent(inout) :: all
        integer, intent(in) :: kind, a, b
        integer, intent(out) :: node

        if (b == 0) then
            node = a
        else if (a > 0) then
            call all%add_operation(kind, a, b, node)
        else if (kind == kind_sum) then
            node = b
        else
            call all%add_operation(kind_negation, b, 0, node)
        end if
    end subroutine join

    pure subroutine power(all, i, left, right, node)
        !! \(a^b\): \(b a^{b-1} a' + a^b \ln(a)\, b'\).
        type(expression_t), intent(inout) :: all
        integer, intent(in) :: i, left, right
        integer, intent(out) :: node
        integer :: a, b, first, logarithm, second, third
        type(number_t) :: exponent

        a = all%nodes(i)%left
        b = all%nodes(i)%right
        first = 0
        if (left > 0) then
            if (all%nodes(b)%kind == kind_number) then
                exponent = all%nodes(b)%number - number_of(1.0_dp)
                call all%add_number(exponent, second)
            else
                call whole(all, 1, third)
                call all%add_operation(kind_difference, b, third, second)
            end if
            if (is_one(all, second)) then
                third = a
            else
                call all%add_operation(kind_power, a, second, third)
            end if
            call product(all, b, third, second)
            call product(all, second, left, first)
        end if
        second = 0
        if (right > 0) then
            call all%add_operation(kind_function, a, 0, logarithm, f_log)
            call product(all, i, logarithm, third)
            call product(all, third, right, second)
        end if
        call join(all, kind_sum, first, second, node)
    end subroutine power

    pure function is_power_of_modulus(all, i) result(yes)
        !! Is the node \(|u|^n\) with a number \(n \ge 2\)?
        type(expression_t), intent(in) :: all
        integer, intent(in) :: i
        logical :: yes

        yes = all%nodes(i)%kind == kind_power
        if (.not. yes) return
        associate (base => all%nodes(all%nodes(i)%left), exponent => all%nodes(all%nodes(i)%right))
            yes = base%kind == kind_function .and. base%which == f_abs .and. &
                  exponent%kind == kind_number
            if (yes) yes = exponent%number%value >= 2.0_dp
        end associate
    end function is_power_of_modulus

    pure subroutine power_of_modulus(all, i, inner, node)
        !! \((|u|^n)' = n |u|^{n-2} u u'\): smooth at \(u = 0\), where no sign is asked for.
        type(expression_t), intent(inout) :: all
        integer, intent(in) :: i, inner  !! the power; u', not 0
        integer, intent(out) :: node
        integer :: a, b, factor, less, power, slope
        type(number_t) :: exponent

        a = all%nodes(i)%left
        b = all%nodes(i)%right
        call product(all, b, all%nodes(a)%left, factor)
        exponent = all%nodes(b)%number - number_of(2.0_dp)
        slope = factor
        if (exponent%value > 0.0_dp) then
            call all%add_number(exponent, less)
            power = a
            if (.not. is_one(all, less)) call all%add_operation(kind_power, a, less, power)
            call product(all, power, factor, slope)
        end if
        call product(all, slope, inner, node)
    end subroutine power_of_modulus

    pure subroutine chain(all, i, inner, node)
        !! \(f(a)' = f'(a)\,a'\).
        type(expression_t), intent(inout) :: all
        integer, intent(in) :: i, inner
        integer, intent(out) :: node
        integer :: a, denominator, one, outer, square, two

        a = all%nodes(i)%left
        select case (all%nodes(i)%which)
        case (f_exp)
            call product(all, i, inner, node)
        case (f_sin)
            call all%add_operation(kind_function, a, 0, outer, f_cos)
            call product(all, outer, inner, node)
        case (f_cos)
            call all%add_operation(kind_function, a, 0, outer, f_sin)
            call product(all, outer, inner, one)
            call all%add_operation(kind_negation, one, 0, node)
        case (f_sinh)
            call all%add_operation(kind_function, a, 0, outer, f_cosh)
            call product(all, outer, inner, node)
        case (f_cosh)
            call all%add_operation(kind_function, a, 0, outer, f_sinh)
            call product(all, outer, inner, node)
        case (f_log)
            call all%add_operation(kind_quotient, inner, a, node)
        case (f_abs)
            call all%add_operation(kind_function, a, 0, outer, f_sgn)
            call product(all, outer, inner, node)
        case (f_sgn)
            node = 0  ! but at the jump
        case (f_sqrt)
            call whole(all, 2, two)
            call all%add_operation(kind_product, two, i, denominator)
            call all%add_operation(kind_quotient, inner, denominator, node)
        case (f_atan)
            call whole(all, 2, two)
            call all%add_operation(kind_power, a, two, square)
            call whole(all, 1, one)
            call all%add_operation(kind_sum, one, square, denominator)
            call all%add_operation(kind_quotient, inner, denominator, node)
        case (f_tan)
            call whole(all, 2, two)
            call all%add_operation(kind_power, i, two, square)
            call whole(all, 1, one)
            call all%add_operation(kind_sum, one, square, outer)
            call product(all, outer, inner, node)
        case default  ! tanh
            call all%add_operation(kind_function, a, 0, outer, f_cosh)
            call whole(all, 2, two)
            call all%add_operation(kind_power, outer, two, square)
            call all%add_operation(kind_quotient, inner, square, node)
        end select
    end subroutine chain
end module lagrangia_derivative
