submodule (lagrangia_formula_parser) lagrangia_formula_operators
    !! What a formula does with what is in brackets: functions, sums over an index.
    use lagrangia_expression, only: f_exp
    use lagrangia_formula_reader, only: largest
    use lagrangia_indexed_names, only: open_sum, skip_body
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_solved_place, only: arc_cosine, arc_sine
    implicit none (type, external)

contains

    pure recursive module subroutine read_function(reader, symbols, which, node, error)
        !! `sin(x)`, `sin theta`, or `sin^2(x)` with a whole number; `acos` and `asin` are written
        !! out.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        integer, intent(in) :: which
        integer, intent(out) :: node
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: name
        type(token_t) :: token
        integer :: argument, exponent

        node = 0
        name = reader%tokens%word(reader%at)
        reader%at = reader%at + 1
        token = token_t()
        if (next_is(reader, "^")) then
            reader%at = reader%at + 1
            token = reader%tokens%token(reader%at)
            if (token%kind /= is_number .or. is_nonzero(token%value - anint(token%value))) then
                call refuse(reader, "'"//name//"^' takes a whole number, "//name//"^2(x); "// &
                            "write 1/"//name//"(x) or "//name//"(x)^n for others", error)
                return
            end if
            reader%at = reader%at + 1
        end if
        if (is_alone(reader) .or. opens_bar(reader)) then  ! log|x|
            call read_factor(reader, symbols, argument, error)
        else if (next_is(reader, "(")) then
            call read_bracket(reader, symbols, argument, error)
        else
            if (reader%tokens%token(reader%at)%kind == is_name .or. &
                reader%tokens%token(reader%at)%kind == is_number) then
                call refuse(reader, "'"//name//"' needs brackets; write "// &
                            quoted(name//"("//reader%tokens%word(reader%at)//")"), error)
            else
                call refuse(reader, "'"//name//"' lacks its argument; write '"//name//"(x)'", error)
            end if
            return
        end if
        if (allocated(error)) return
        select case (which)
        case (arc_cosine_of)
            call reader%expression%append(arc_cosine(reader%expression%pruned(argument)), node)
        case (arc_sine_of)
            call reader%expression%append(arc_sine(reader%expression%pruned(argument)), node)
        case default
            call reader%expression%add_operation(kind_function, argument, 0, node, which)
        end select
        if (token%kind /= is_number) return
        argument = node
        call reader%expression%add_number(number_of(token%value), exponent)
        call reader%expression%add_operation(kind_power, argument, exponent, node)
    end subroutine read_function

    pure function opens_bar(reader) result(yes)
        !! Does a bar begin the argument of a function? Within other bars only where something
        !! follows that it may begin, as in `|log|x||` and not in `|2 log|`.
        type(reader_t), intent(in) :: reader  !! behind the function's name
        logical :: yes
        type(reader_t) :: inside

        yes = next_is(reader, "|")
        if (.not. yes .or. reader%bars == 0) return
        inside = reader
        inside%at = reader%at + 1
        yes = begins_factor(inside) .or. inside%tokens%token(inside%at)%kind == is_number
    end function opens_bar

    pure function is_alone(reader) result(yes)
        !! Is the argument of a function without brackets one name or number, behind which no factor
        !! can follow but another function: `g sin theta`, `sin theta cos theta`, `sqrt 2`?
        type(reader_t), intent(in) :: reader  !! behind the function's name
        logical :: yes
        character(:), allocatable :: behind

        yes = .false.
        associate (token => reader%tokens%token(reader%at))
            if (token%kind /= is_name .and. token%kind /= is_number) return
            if (is_function_name(reader%tokens%word(reader%at))) return
            behind = reader%tokens%word(reader%at + 1)
            yes = behind == "" .or. is_function_name(behind)
            if (.not. yes) yes = scan(behind, "+-=)|,*") == 1 .and. behind /= "**"
            if (token%kind == is_number) yes = yes .or. behind == "/"
        end associate
    end function is_alone

    pure recursive module subroutine read_indexed_sum(reader, symbols, node, error)
        !! `sum(i, 1, 4, m/2 x_i_dot^2)`: the formula is read once for each number.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        integer, intent(out) :: node
        type(error_t), allocatable, intent(out) :: error
        integer :: bars, body, first, k, last, left, term

        node = 0
        bars = reader%bars
        call open_sum(reader, symbols, first, last, error)
        if (allocated(error)) return
        body = reader%at
        if (last < first) then
            call skip_body(reader, error)
            call reader%expression%add_number(ratio(0_i8, 1_i8), node)
        end if
        do k = first, last
            if (allocated(error)) return
            reader%at = body
            reader%index_values(reader%indices) = k
            call read_sum(reader, symbols, term, error)
            if (allocated(error)) return
            if (.not. next_is(reader, ")")) then
                call refuse(reader, "the bracket of a sum is not closed; write sum(i, 1, 4, "// &
                            "x_i^2)", error)
            else if (reader%expression%count > largest) then
                call refuse(reader, "the formula, with its sums written out, has more than "// &
                            to_text(nint(largest))//" parts; shorten it", error)
            end if
            left = node
            node = term
            if (k > first) call reader%expression%add_operation(kind_sum, left, term, node)
        end do
        if (allocated(error)) return
        reader%at = reader%at + 1
        reader%bars = bars
        reader%depth = reader%depth - 1
        reader%indices = reader%indices - 1
    end subroutine read_indexed_sum

    pure recursive module subroutine read_exponential(reader, symbols, node, error)
        !! `e^(-gamma t)`, `e^-2`.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        integer, intent(out) :: node
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: raised
        integer :: argument, exponent
        logical :: alone, negative

        node = 0
        reader%at = reader%at + 2
        negative = next_is(reader, "-")
        if (negative) reader%at = reader%at + 1
        alone = reader%tokens%token(reader%at)%kind == is_name .or. (negative .and. &
                                                                     .not. next_is(reader, "("))
        raised = reader%tokens%word(reader%at)
        if (negative) raised = "-"//raised
        call read_factor(reader, symbols, exponent, error)
        if (allocated(error)) return
        if (alone .and. (begins_factor(reader) .or. next_is(reader, "/"))) then
            call refuse(reader, "is this in the exponent? Write e^("//raised//" ...), or e^("// &
                        raised//") ...", error)
            return
        end if
        argument = exponent
        if (negative) call reader%expression%add_operation(kind_negation, exponent, 0, argument)
        call reader%expression%add_operation(kind_function, argument, 0, node, f_exp)
    end subroutine read_exponential
end submodule lagrangia_formula_operators
