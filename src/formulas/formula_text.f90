module lagrangia_formula_text
    !! Formulas as text: in the program's own style, which the parser reads back to the same
    !! formula, and in LaTeX.
    use lagrangia_exact_number, only: number_t
    use lagrangia_expression, only: expression_t, function_names, kind_difference, kind_function, &
                                    kind_negation, kind_number, kind_power, kind_product, &
                                    kind_quotient, kind_sum, kind_symbol, node_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_number_class, only: is_zero
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: to_text, word_t
    implicit none (type, external)
    private
    public :: formula_text, typed_name
    public :: number_in_formula, rank_of, rank_factor, rank_power, rank_product, rank_sign, rank_sum

    integer, parameter :: rank_sum = 1      !! a + b
    integer, parameter :: rank_sign = 2     !! -a
    integer, parameter :: rank_product = 3  !! a b, a/b, the number 1/2
    integer, parameter :: rank_power = 4    !! a^b
    integer, parameter :: rank_factor = 5   !! a name, a whole number, f(a)

    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    pure function typed_name(name) result(text)
        !! `d/dt dL/dtheta_dot` for the symbol `d_dt_dL_dtheta_dot`, which formulas are read to.
        character(*), intent(in) :: name  !! of a symbol
        character(:), allocatable :: text

        text = name
        if (index(text, "d_dt_") == 1) then
            text = "d/dt "//typed_name_of_slope(text(6:))
        else
            text = typed_name_of_slope(text)
        end if
    end function typed_name

    pure function typed_name_of_slope(name) result(text)
        !! `dV/dx` for `dV_dx`.
        character(*), intent(in) :: name
        character(:), allocatable :: text
        integer :: at

        text = name
        at = index(name, "_d")
        if (name(1:1) /= "d" .or. at /= 3 .or. len(name) < 5) return
        if (scan(name(2:2), "LTVEH") == 1) text(at:at) = "/"
    end function typed_name_of_slope

    pure function formula_text(expression, symbols) result(text)
        !! The formula in one line, `m2 l x_dot theta_dot cos(theta)`, with brackets where they are
        !! needed and nothing reordered.
        type(expression_t), intent(in) :: expression  !! of the symbols
        type(symbols_t), intent(in) :: symbols        !! their names
        character(:), allocatable :: text
        type(word_t), allocatable :: texts(:)
        integer :: i

        text = "0"
        if (expression%count == 0) return
        allocate (texts(expression%count))
        do i = 1, expression%count
            call write_node(expression, symbols, i, texts)
        end do
        text = texts(expression%count)%text
    end function formula_text

    pure subroutine write_node(expression, symbols, i, texts)
        !! The text of node `i` from those of its operands.
        type(expression_t), intent(in) :: expression
        type(symbols_t), intent(in) :: symbols
        integer, intent(in) :: i
        type(word_t), intent(inout) :: texts(:)
        character(:), allocatable :: right, text

        associate (node => expression%nodes(i))
            select case (node%kind)
            case (kind_number)
                text = number_in_formula(node%number)
            case (kind_symbol)
                text = trim(symbols%names(node%which))
            case (kind_sum)
                text = bracketed(node%left, rank_sum)//" + "//bracketed(node%right, rank_product)
            case (kind_difference)
                text = bracketed(node%left, rank_sum)//" - "//bracketed(node%right, rank_product)
            case (kind_negation)
                text = "-"//bracketed(node%left, rank_product)
            case (kind_product)
                right = bracketed(node%right, rank_power)
                text = bracketed(node%left, rank_product)
                if (scan(right, "0123456789") == 1) then
                    text = text//"*"//right
                else
                    text = text//" "//right
                end if
            case (kind_quotient)
                text = bracketed(node%left, rank_product)//"/"//bracketed(node%right, rank_power)
            case (kind_power)
                text = bracketed(node%left, rank_factor)//"^"//raised(node%right)
            case default
                text = trim(function_names(node%which))//"("//texts(node%left)%text//")"
            end select
        end associate
        texts(i)%text = text
    contains
        pure function bracketed(k, least) result(text)
            !! The text of an operand, in brackets if it binds less tightly than `least`.
            integer, intent(in) :: k, least
            character(:), allocatable :: text

            text = texts(k)%text
            if (rank_of(expression%nodes(k)) < least) text = "("//text//")"
        end function bracketed

        pure function raised(k) result(text)
            !! A whole number with its sign, a name, or brackets.
            integer, intent(in) :: k
            character(:), allocatable :: text

            text = bracketed(k, rank_factor)
            associate (node => expression%nodes(k))
                if (node%kind == kind_function) text = "("//text//")"
                if (node%kind == kind_number .and. node%number%is_whole()) text = texts(k)%text
                if (text == "1") text = "(1)"  ! x^1/2 is refused
                if (node%kind /= kind_negation) return
            end associate
            associate (node => expression%nodes(expression%nodes(k)%left))
                if (node%kind == kind_function .or. rank_of(node) < rank_factor) return
                text = texts(k)%text
            end associate
        end function raised
    end subroutine write_node

    pure function rank_of(node) result(rank)
        !! How tightly the text of a node binds.
        type(node_t), intent(in) :: node  !! of any kind
        integer :: rank
        integer, parameter :: ranks(0:8) = [rank_factor, rank_factor, rank_sum, rank_sum, &
            rank_product, rank_product, rank_power, rank_sign, rank_factor]

        rank = ranks(node%kind)
        if (node%kind /= kind_number) return
        if (scan(number_in_formula(node%number), "/") > 0) rank = rank_product
        if (node%number%value < 0.0_dp) rank = rank_sign
    end function rank_of

    pure function number_in_formula(number) result(text)
        !! `3`, `1/2`, `9.81`, `1e-3`, `pi`: what is read back to the same double.
        type(number_t), intent(in) :: number  !! finite
        character(:), allocatable :: text
        integer(i8), parameter :: familiar = 12_i8  !! denominators of fractions written as such

        text = to_text(number%value)
        if (number%is_whole()) then
            text = to_text(number%numerator)
        else if (number%is_exact()) then
            if ((number%denominator > familiar .or. mod(number%denominator, 5_i8) == 0_i8) .and. &
                abs(number%value) < 1e5_dp .and. mod(10_i8**9, number%denominator) == 0_i8) return
            text = to_text(number%numerator)//"/"//to_text(number%denominator)
        else if (is_zero(number%value - pi)) then
            text = "pi"
        end if
    end function number_in_formula
end module lagrangia_formula_text
