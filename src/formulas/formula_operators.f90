submodule (lagrangia_formula_parser) lagrangia_formula_operators
    !! What a formula does with what is in brackets: functions, sums over an index, derivatives.
    use lagrangia_derivative, only: time_derivative
    use lagrangia_formula_reader, only: largest
    use lagrangia_indexed_names, only: open_sum, skip_body
    implicit none (type, external)

contains

    pure recursive module subroutine read_function(reader, symbols, which, node, error)
        !! `sin(x)`, or `sin^2(x)` with a whole number.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        integer, intent(in) :: which
        integer, intent(out) :: node
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: name
        type(token_t) :: token
        integer :: argument, exponent

        node = 0
        name = trim(function_names(which))
        reader%at = reader%at + 1
        token = token_t()
        if (next_is(reader, "^")) then
            reader%at = reader%at + 1
            token = reader%tokens%token(reader%at)
            if (token%kind /= is_number .or. abs(token%value - anint(token%value)) > 0.0_dp) then
                call refuse(reader, "'"//name//"^' takes a whole number, "//name//"^2(x); "// &
                            "write 1/"//name//"(x) or "//name//"(x)^n for others", error)
                return
            end if
            reader%at = reader%at + 1
        end if
        if (.not. next_is(reader, "(")) then
            if (reader%tokens%token(reader%at)%kind == is_name .or. &
                reader%tokens%token(reader%at)%kind == is_number) then
                call refuse(reader, "'"//name//"' needs brackets; write "// &
                            quoted(name//"("//reader%tokens%word(reader%at)//")"), error)
            else
                call refuse(reader, "'"//name//"' lacks its argument; write '"//name//"(x)'", error)
            end if
            return
        end if
        call read_bracket(reader, symbols, argument, error)
        if (allocated(error)) return
        call reader%expression%add_operation(kind_function, argument, 0, node, which)
        if (token%kind /= is_number) return
        argument = node
        call reader%expression%add_number(number_of(token%value), exponent)
        call reader%expression%add_operation(kind_power, argument, exponent, node)
    end subroutine read_function

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

    pure recursive module subroutine read_rate(reader, symbols, node, error)
        !! `d/dt (m r^2 theta_dot)`, `dE/dt`, `d^2 x/dt^2`, `dL/dx_dot`; no node where none of
        !! these stands here.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        integer, intent(out) :: node
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: name, below
        integer :: first

        node = 0
        if (.not. allocated(symbols%rates)) return
        name = reader%tokens%word(reader%at)
        first = reader%at
        below = ""
        if (words(first + 1, 1) == "/") below = words(first + 2, 1)
        if (symbols%find(name) > 0 .or. symbols%find_definition(name) > 0) then
            if (name /= "d" .or. below /= "dt" .or. symbols%find("dt") > 0) return
        end if
        if (name == "d" .and. below == "dt") then
            reader%at = first + 3
            call read_factor(reader, symbols, node, error)
            if (allocated(error)) return
            if (begins_factor(reader) .or. next_is(reader, "*") .or. next_is(reader, "/") .or. &
                next_is(reader, "^")) then
                reader%at = first
                call refuse(reader, "of what is it the derivative? Write d/dt(m x_dot)", error)
            end if
        else if (name == "d" .and. words(first + 1, 1) == "(") then
            reader%at = first + 1
            call read_bracket(reader, symbols, node, error)
            if (allocated(error)) return
            if (words(reader%at, 2) /= "/dt") call refuse(reader, "behind d(...) stands '/dt'", &
                                                          error)
            reader%at = reader%at + 2
        else if (name == "d" .and. words(first + 1, 2) == "^2" .and. &
                 words(first + 4, 4) == "/dt^2") then
            call add_named(reader, symbols, words(first + 3, 1), first + 8, node)
            if (node > 0) call differentiate(reader, symbols, first, node, error)
        else if (name(1:1) == "d" .and. len(name) > 1 .and. below == "dt") then
            call add_named(reader, symbols, name(2:), first + 3, node)
        else if (name(1:1) == "d" .and. scan(below, "d") == 1) then
            call add_named(reader, symbols, name//"_"//below, first + 3, node)
            return
        end if
        if (allocated(error) .or. node == 0) return
        call differentiate(reader, symbols, first, node, error)
    contains
        pure function words(from, number) result(text)
            !! Some tokens without blanks.
            integer, intent(in) :: from, number
            character(:), allocatable :: text
            integer :: i

            text = ""
            do i = from, min(from + number, size(reader%tokens%token)) - 1
                text = text//reader%tokens%word(i)
            end do
        end function words
    end subroutine read_rate

    pure subroutine differentiate(reader, symbols, first, node, error)
        !! By the time, what was read from token `first` on.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        integer, intent(in) :: first
        integer, intent(inout) :: node
        type(error_t), allocatable, intent(out) :: error
        type(expression_t) :: operand, rate
        integer :: i

        operand = reader%expression%pruned(node)
        do i = 1, size(symbols%rates)
            if (symbols%rates(i) >= 0 .or. .not. operand%depends_on(i)) cycle
            reader%at = first
            call refuse(reader, "d/dt of '"//trim(symbols%names(i))//"' is not known here; "// &
                        "write the formula for it", error)
            return
        end do
        rate = time_derivative(operand, symbols%rates, 1)
        call reader%expression%append(rate, node)
        if (reader%expression%count <= largest) return
        reader%at = first
        call refuse(reader, "the derivative has more than "//to_text(nint(largest))// &
                    " parts; shorten it", error)
    end subroutine differentiate
end submodule lagrangia_formula_operators
