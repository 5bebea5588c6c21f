module lagrangia_formula_latex
    !! Formulas in LaTeX, for slides: `\frac{m}{2} \ell^{2} \dot{\theta}_{1}^{2} + m g \cos\theta`.
    use lagrangia_expression, only: expression_t, f_abs, f_atan, f_exp, f_log, f_sgn, &
                                    f_sqrt, function_names, kind_difference, kind_function, &
                                    kind_negation, kind_number, kind_power, kind_product, &
                                    kind_quotient, kind_sum, kind_symbol
    use lagrangia_formula_text, only: number_in_formula, rank_factor, rank_of, rank_power, &
                                      rank_product, rank_sum
    use lagrangia_latex_source, only: greek
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: latex, latex_name

contains

    pure function latex(expression, symbols) result(text)
        !! The formula for math mode, nothing reordered.
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
    end function latex

    pure subroutine write_node(expression, symbols, i, texts)
        !! The text of node `i` from those of its operands.
        type(expression_t), intent(in) :: expression
        type(symbols_t), intent(in) :: symbols
        integer, intent(in) :: i
        type(word_t), intent(inout) :: texts(:)
        character(:), allocatable :: left, right, text

        associate (node => expression%nodes(i))
            select case (node%kind)
            case (kind_number)
                text = number_in_latex(number_in_formula(node%number))
            case (kind_symbol)
                text = latex_name(trim(symbols%names(node%which)))
            case (kind_sum)
                text = operand(node%left, rank_sum)//" + "//operand(node%right, rank_product)
            case (kind_difference)
                text = operand(node%left, rank_sum)//" - "//operand(node%right, rank_product)
            case (kind_negation)
                text = "-"//operand(node%left, rank_product)
            case (kind_product)
                left = operand(node%left, rank_product)
                right = operand(node%right, rank_power)
                text = left//" "//right
                if (scan(right, "0123456789") == 1 .or. ends_bare(expression, node%left) .and. &
                    .not. is_applied(expression, node%right)) text = left//" \cdot "//right
            case (kind_quotient)
                text = "\frac{"//texts(node%left)%text//"}{"//texts(node%right)%text//"}"
            case (kind_power)
                associate (base => expression%nodes(node%left))
                    if (is_applied(expression, node%left) .and. &
                        expression%nodes(node%right)%kind == kind_number) then
                        text = applied(base%which, base%left, "^{"//texts(node%right)%text//"}")
                    else if (base%kind == kind_quotient .or. base%kind == kind_function) then
                        text = bracketed(texts(node%left)%text)//"^{"//texts(node%right)%text//"}"
                    else
                        text = operand(node%left, rank_factor)//"^{"//texts(node%right)%text//"}"
                    end if
                end associate
            case default
                text = applied(node%which, node%left, "")
            end select
        end associate
        texts(i)%text = text
    contains
        pure function operand(k, least) result(shown)
            !! The text of an operand, in brackets if it binds less tightly than `least`.
            integer, intent(in) :: k, least
            character(:), allocatable :: shown

            shown = texts(k)%text
            if (expression%nodes(k)%kind == kind_quotient) return  ! a fraction needs none
            if (rank_of(expression%nodes(k)) < least) shown = bracketed(shown)
        end function operand

        pure function applied(which, argument, power) result(shown)
            !! A function, its power behind the name where that is the custom.
            integer, intent(in) :: which, argument
            character(*), intent(in) :: power
            character(:), allocatable :: shown

            select case (which)
            case (f_abs)
                shown = "\left|"//texts(argument)%text//"\right|"
            case (f_exp)
                shown = "\mathrm{e}^{"//texts(argument)%text//"}"
            case (f_sqrt)
                shown = "\sqrt{"//texts(argument)%text//"}"
            case default
                shown = "\"//trim(function_names(which))
                if (which == f_log) shown = "\ln"
                if (which == f_atan) shown = "\arctan"
                if (which == f_sgn) shown = "\operatorname{sgn}"
                if (expression%nodes(argument)%kind == kind_symbol .and. which /= f_sgn) then
                    shown = shown//power//" "//texts(argument)%text
                else
                    shown = shown//power//bracketed(texts(argument)%text)
                end if
            end select
        end function applied
    end subroutine write_node

    pure function bracketed(text) result(shown)
        !! In brackets of its height.
        character(*), intent(in) :: text
        character(:), allocatable :: shown

        shown = "\left("//text//"\right)"
    end function bracketed

    pure function is_applied(expression, k) result(yes)
        !! A function that stands before its argument, perhaps to a power?
        type(expression_t), intent(in) :: expression
        integer, intent(in) :: k
        logical :: yes

        associate (node => expression%nodes(k))
            yes = node%kind == kind_function .and. &
                  all(node%which /= [f_abs, f_exp, f_sqrt])
            if (node%kind /= kind_power) return
            associate (base => expression%nodes(node%left))
                yes = base%kind == kind_function .and. all(base%which /= [f_abs, f_exp, f_sqrt])
            end associate
        end associate
    end function is_applied

    pure function ends_bare(expression, k) result(yes)
        !! Is the last factor a function of a symbol, without brackets?
        type(expression_t), intent(in) :: expression
        integer, intent(in) :: k
        logical :: yes
        integer :: last

        last = k
        if (expression%nodes(last)%kind == kind_product) last = expression%nodes(last)%right
        yes = is_applied(expression, last)
    end function ends_bare

    pure function number_in_latex(plain) result(text)
        !! `\frac{1}{2}`, `1.5 \cdot 10^{-3}`, `\pi`.
        character(*), intent(in) :: plain
        character(:), allocatable :: text
        integer :: k

        text = plain
        k = scan(plain, "/")
        if (k > 0) text = "\frac{"//plain(:k - 1)//"}{"//plain(k + 1:)//"}"
        if (k > 0 .and. plain(1:1) == "-") then
            text = "-\frac{"//plain(2:k - 1)//"}{"//plain(k + 1:)//"}"
        end if
        k = scan(plain, "e")
        if (k > 0) text = plain(:k - 1)//" \cdot 10^{"//plain(k + 1:)//"}"
        k = index(plain, "pi")
        if (k > 0) text = plain(:k - 1)//"\pi"
    end function number_in_latex

    pure function latex_name(name) result(text)
        !! A name with its dots and its index: `\dot{\theta}_{1}`, `m_{2}`, `\ell`.
        character(*), intent(in) :: name  !! of a symbol, without blanks
        character(:), allocatable :: text
        character(:), allocatable :: base, index_text
        integer :: dots, k, length

        dots = 0
        length = len(name)
        if (length > 5) then
            if (name(length - 4:) == "_ddot") dots = 2
        end if
        if (dots == 0 .and. length > 4) then
            if (name(length - 3:) == "_dot") dots = 1
        end if
        if (dots > 0) length = length - 3 - dots
        k = scan(name(:length), "_0123456789")
        if (k <= 1) k = length + 1
        base = letter(name(:k - 1))
        if (dots == 1) base = "\dot{"//base//"}"
        if (dots == 2) base = "\ddot{"//base//"}"
        text = base
        if (k > length) return
        index_text = name(k:length)
        if (index_text(1:1) == "_") index_text = index_text(2:)
        if (len(index_text) == 0) return
        text = base//"_{"
        do
            k = index(index_text//"_", "_")
            text = text//letter(index_text(:k - 1))
            if (k > len(index_text)) exit
            text = text//","
            index_text = index_text(k + 1:)
        end do
        text = text//"}"
    end function latex_name

    pure function letter(name) result(text)
        !! A Greek letter, a plain one, or an upright word.
        character(*), intent(in) :: name
        character(:), allocatable :: text

        text = name
        if (name == "l") then
            text = "\ell"
        else if (any(greek == name)) then
            text = "\"//name
        else if (len(name) > 1 .and. scan(name, "0123456789") == 0) then
            text = "\mathrm{"//name//"}"
        end if
    end function letter
end module lagrangia_formula_latex
