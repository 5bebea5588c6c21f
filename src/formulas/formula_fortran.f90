module lagrangia_formula_fortran
    !! Formulas as Fortran: the text of an expression whose value is that of the formula, operation
    !! by operation.
    use lagrangia_exact_number, only: number_t
    use lagrangia_expression, only: expression_t, f_cos, f_sin, function_names, kind_difference, &
                                    kind_function, kind_negation, kind_number, kind_power, &
                                    kind_product, kind_quotient, kind_sum, kind_symbol, node_t
    use lagrangia_formula_text, only: rank_factor, rank_of, rank_power, rank_product, rank_sign, &
                                      rank_sum
    use lagrangia_kinds, only: dp
    use lagrangia_text, only: to_text, word_t
    implicit none (type, external)
    private
    public :: fortran_text

contains

    pure subroutine fortran_text(expression, names, text, angles)
        !! The formula on one line, `m*r**2*theta_dot`, with brackets where they are needed and
        !! nothing reordered.
        type(expression_t), intent(in) :: expression            !! of the symbols
        type(word_t), intent(in) :: names(:)                    !! of the symbols, in Fortran
        character(:), allocatable, intent(out) :: text          !! of real numbers, `dp`
        type(word_t), allocatable, intent(inout), optional :: angles(:)
        !! arguments of sine and cosine so far: of the third they are then called `sine3` and
        !! `cosine3`; new ones come behind them
        type(word_t), allocatable :: texts(:)
        integer :: i

        text = "0.0_dp"
        if (expression%count == 0) return
        allocate (texts(expression%count))
        do i = 1, expression%count
            associate (node => expression%nodes(i))
                if (node%kind == kind_function .and. present(angles) .and. &
                    any(node%which == [f_cos, f_sin])) then
                    call name_angle(node%which, texts(node%left)%text, angles, texts(i)%text)
                else
                    call write_node(expression, names, i, texts)
                end if
            end associate
        end do
        text = texts(expression%count)%text
    end subroutine fortran_text

    pure subroutine name_angle(which, angle, angles, text)
        !! The sine or cosine of an angle by its number.
        integer, intent(in) :: which
        character(*), intent(in) :: angle
        type(word_t), allocatable, intent(inout) :: angles(:)
        character(:), allocatable, intent(out) :: text
        type(word_t), allocatable :: more(:)
        integer :: i, k

        do k = 1, size(angles)
            if (angles(k)%text == angle) exit
        end do
        if (k > size(angles)) then
            allocate (more(k))
            do i = 1, k - 1
                more(i)%text = angles(i)%text
            end do
            more(k)%text = angle
            call move_alloc(more, angles)
        end if
        text = trim(merge("sine  ", "cosine", which == f_sin))//to_text(k)
    end subroutine name_angle

    pure subroutine write_node(expression, names, i, texts)
        !! The text of node `i` from those of its operands.
        type(expression_t), intent(in) :: expression
        type(word_t), intent(in) :: names(:)
        integer, intent(in) :: i
        type(word_t), intent(inout) :: texts(:)
        character(:), allocatable :: text

        associate (node => expression%nodes(i))
            select case (node%kind)
            case (kind_number)
                text = fortran_number(node%number)
            case (kind_symbol)
                text = names(node%which)%text
            case (kind_sum)
                text = bracketed(node%left, rank_sum)//" + "//bracketed(node%right, rank_product)
            case (kind_difference)
                text = bracketed(node%left, rank_sum)//" - "//bracketed(node%right, rank_product)
            case (kind_negation)
                text = "-"//bracketed(node%left, rank_product)
            case (kind_product)
                text = bracketed(node%left, rank_product)//"*"//bracketed(node%right, rank_power)
            case (kind_quotient)
                text = bracketed(node%left, rank_product)//"/"//bracketed(node%right, rank_power)
            case (kind_power)
                text = bracketed(node%left, rank_factor)//"**"//exponent_text(node%right)
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
            if (rank_in_fortran(expression%nodes(k)) < least) text = "("//text//")"
        end function bracketed

        pure function exponent_text(k) result(text)
            !! A whole number is one in Fortran, too, so that a base may be negative.
            integer, intent(in) :: k
            character(:), allocatable :: text

            integer :: number

            number = k
            if (expression%nodes(k)%kind == kind_negation) number = expression%nodes(k)%left
            text = bracketed(k, rank_factor)
            associate (node => expression%nodes(number))
                if (node%kind /= kind_number) return
                if (.not. node%number%is_whole()) return
                text = to_text(node%number%numerator)
                if (number /= k) text = "-"//text
                if (scan(text, "-") == 1) text = "("//text//")"
            end associate
        end function exponent_text
    end subroutine write_node

    pure function rank_in_fortran(node) result(rank)
        !! How tightly the text of a node binds.
        type(node_t), intent(in) :: node
        integer :: rank

        rank = rank_of(node)
        if (node%kind /= kind_number) return
        rank = rank_factor
        if (index(fortran_number(node%number), "/") > 0) rank = rank_product
        if (node%number%value < 0.0_dp) rank = rank_sign
    end function rank_in_fortran

    pure function fortran_number(number) result(text)
        !! `3.0_dp`, `1.0_dp/3.0_dp`, `9.81_dp`: what a compiler reads to the same double.
        type(number_t), intent(in) :: number  !! finite
        character(:), allocatable :: text

        text = to_text(number%value)//"_dp"
        if (.not. number%is_exact() .or. number%is_whole()) return
        if (len(text) < 12) return  ! a short decimal fraction
        text = to_text(real(number%numerator, dp))//"_dp/"// &
               to_text(real(number%denominator, dp))//"_dp"
    end function fortran_number
end module lagrangia_formula_fortran
