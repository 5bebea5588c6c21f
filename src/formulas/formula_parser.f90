module lagrangia_formula_parser
    !! Reads a formula as the course writes it: `m2 l x_dot theta_dot cos(theta) + (m1 + m2)/2 x^2`.
    !!
    !! Factors side by side are a product, of the same rank as `*` and `/`, from left to right:
    !! `1/2 m v^2` is (1/2) m v^2. `^` binds tighter than these and than a sign. `f(x)` is a
    !! function for the names in `function_names`, else a product; `sin^2(x)` is sin(x)^2, `|x|` is
    !! abs(x). What has two readings, `a^b^c` or `a*-b`, is refused.
    use lagrangia_errors, only: error_t
    use lagrangia_exact_number, only: number_of, ratio
    use lagrangia_expression, only: expression_t, f_abs, function_names, is_function_name, &
                                    kind_difference, kind_function, kind_negation, kind_power, &
                                    kind_product, kind_quotient, kind_sum
    use lagrangia_formula_reader, only: begins_factor, check_size, go_deeper, is_unit, next_is, &
                                        reader_t, refuse, refuse_missing, refuse_unexpected, &
                                        refuse_unknown, skip_sign, start, typed_number
    use lagrangia_formula_tokens, only: is_end, is_name, is_number, is_sign, token_t
    use lagrangia_indexed_names, only: begins_sum, is_of_chain, put_indices, refuse_index
    use lagrangia_kinds, only: dp, i8
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: quoted, to_text
    implicit none (type, external)
    private
    public :: parse_equation, parse_formula
    ! gfortran 12 hides others from submodules:
    public :: add_named, read_bracket, read_factor, read_power, read_sum

    real(dp), parameter :: pi = acos(-1.0_dp)
    integer, parameter :: arc_cosine_of = -1, arc_sine_of = -2  !! functions that are written out

    interface
        pure recursive module subroutine read_indexed_sum(reader, symbols, node, error)
            !! `sum(i, 1, 4, m/2 x_i_dot^2)`: the formula is read once for each number.
            implicit none (type, external)
            type(reader_t), intent(inout) :: reader
            type(symbols_t), intent(in) :: symbols
            integer, intent(out) :: node
            type(error_t), allocatable, intent(out) :: error
        end subroutine read_indexed_sum

        pure recursive module subroutine read_function(reader, symbols, which, node, error)
            !! `sin(x)`, or `sin^2(x)` with a whole number.
            implicit none (type, external)
            type(reader_t), intent(inout) :: reader
            type(symbols_t), intent(in) :: symbols
            integer, intent(in) :: which
            integer, intent(out) :: node
            type(error_t), allocatable, intent(out) :: error
        end subroutine read_function

        pure recursive module subroutine read_rate(reader, symbols, node, error)
            !! `d/dt (m r^2 theta_dot)`, `dE/dt`, `d^2 x/dt^2`, `dL/dx_dot`, `d/dtheta V`; no node
            !! where none of these stands here.
            implicit none (type, external)
            type(reader_t), intent(inout) :: reader
            type(symbols_t), intent(in) :: symbols
            integer, intent(out) :: node
            type(error_t), allocatable, intent(out) :: error
        end subroutine read_rate

        pure recursive module subroutine read_behind(reader, symbols, name, node, error)
            !! Primes behind a name, or on what it depends: `theta''`, `V'(theta)`, `L(x, x_dot)`.
            implicit none (type, external)
            type(reader_t), intent(inout) :: reader
            type(symbols_t), intent(in) :: symbols
            character(*), intent(in) :: name
            integer, intent(inout) :: node
            type(error_t), allocatable, intent(out) :: error
        end subroutine read_behind

        pure recursive module subroutine read_exponential(reader, symbols, node, error)
            !! `e^(-gamma t)`, `e^-2`.
            implicit none (type, external)
            type(reader_t), intent(inout) :: reader
            type(symbols_t), intent(in) :: symbols
            integer, intent(out) :: node
            type(error_t), allocatable, intent(out) :: error
        end subroutine read_exponential
    end interface

contains

    pure subroutine parse_formula(text, symbols, expression, error)
        !! The formula that `text` means.
        character(*), intent(in) :: text                  !! at most 10000 characters, UTF-8
        type(symbols_t), intent(in) :: symbols            !! the names that it may use
        type(expression_t), intent(out) :: expression     !! of these symbols
        type(error_t), allocatable, intent(out) :: error  !! column and remedy in one line
        type(reader_t) :: reader
        integer :: root

        call start(reader, text, symbols, error)
        if (allocated(error)) return
        call read_side(reader, symbols, root, error)
        if (allocated(error)) return
        if (reader%tokens%token(reader%at)%kind /= is_end) then
            call refuse(reader, "'=' makes an equation; one formula is needed here", error)
            return
        end if
        expression = reader%expression%pruned(root)
        call check_size(expression, error)
    end subroutine parse_formula

    pure subroutine parse_equation(text, symbols, left, right, error)
        !! Both sides of an equation, with one `=` between them.
        character(*), intent(in) :: text                  !! at most 10000 characters, UTF-8
        type(symbols_t), intent(in) :: symbols            !! the names that it may use
        type(expression_t), intent(out) :: left, right    !! of these symbols
        type(error_t), allocatable, intent(out) :: error  !! column and remedy in one line
        type(reader_t) :: reader
        integer :: first, second

        call start(reader, text, symbols, error)
        if (allocated(error)) return
        call read_side(reader, symbols, first, error)
        if (allocated(error)) return
        if (reader%tokens%token(reader%at)%kind == is_end) then
            call refuse(reader, "'=' and the other side are missing; write an equation, "// &
                        "left side = right side", error)
            return
        end if
        reader%at = reader%at + 1
        call read_side(reader, symbols, second, error)
        if (allocated(error)) return
        if (reader%tokens%token(reader%at)%kind /= is_end) then
            call refuse(reader, "a second '='; an equation has one", error)
            return
        end if
        left = reader%expression%pruned(first)
        right = reader%expression%pruned(second)
        call check_size(left, error)
        if (.not. allocated(error)) call check_size(right, error)
    end subroutine parse_equation

    pure subroutine read_side(reader, symbols, root, error)
        !! A sum up to the end or to `=`.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        integer, intent(out) :: root
        type(error_t), allocatable, intent(out) :: error

        call read_sum(reader, symbols, root, error)
        if (allocated(error)) return
        if (reader%tokens%token(reader%at)%kind == is_end .or. next_is(reader, "=")) return
        if (next_is(reader, ")")) then
            call refuse(reader, "')' closes no bracket; delete it or open one before", error)
        else
            call refuse_unexpected(reader, error)
        end if
    end subroutine read_side

    pure recursive subroutine read_sum(reader, symbols, node, error)
        !! Products with signs between them, perhaps one before the first.
        type(reader_t), intent(inout) :: reader           !! at its first token
        type(symbols_t), intent(in) :: symbols            !! the names that it may use
        integer, intent(out) :: node                      !! its place
        type(error_t), allocatable, intent(out) :: error  !! column and remedy
        integer :: kind, left, right
        logical :: negative

        negative = next_is(reader, "-")
        if (negative .or. next_is(reader, "+")) call skip_sign(reader, error)
        if (allocated(error)) return
        call read_product(reader, symbols, node, error)
        if (allocated(error)) return
        if (negative) then
            left = node
            call reader%expression%add_operation(kind_negation, left, 0, node)
        end if
        do while (next_is(reader, "+") .or. next_is(reader, "-"))
            kind = merge(kind_sum, kind_difference, next_is(reader, "+"))
            call skip_sign(reader, error)
            if (allocated(error)) return
            call read_product(reader, symbols, right, error)
            if (allocated(error)) return
            left = node
            call reader%expression%add_operation(kind, left, right, node)
        end do
    end subroutine read_sum

    pure recursive subroutine read_product(reader, symbols, node, error)
        !! Factors side by side, or with `*` or `/` between them.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        integer, intent(out) :: node
        type(error_t), allocatable, intent(out) :: error
        integer :: kind, left, right

        call read_power(reader, symbols, node, error)
        do while (.not. allocated(error))
            kind = kind_product
            if (next_is(reader, "*") .or. next_is(reader, "/")) then
                if (next_is(reader, "/")) kind = kind_quotient
                call skip_sign(reader, error)
            else if (next_is(reader, "^")) then
                call refuse(reader, "a second '^' has two meanings; write x^(2^3) or (x^2)^3", &
                            error)
            else if (reader%tokens%token(reader%at)%kind == is_number .and. is_unit(reader)) then
                call refuse(reader, "numbers have no units here; write the number alone", error)
            else if (reader%tokens%token(reader%at)%kind == is_number) then
                call refuse(reader, "the number "//quoted(reader%tokens%word(reader%at))// &
                            " follows a factor; write it before, or with * or ^", error)
            else if (.not. begins_factor(reader)) then
                return
            end if
            if (allocated(error)) return
            call read_power(reader, symbols, right, error)
            if (allocated(error)) return
            left = node
            call reader%expression%add_operation(kind, left, right, node)
        end do
    end subroutine read_product

    pure recursive subroutine read_power(reader, symbols, node, error)
        !! A factor, perhaps to a power.
        type(reader_t), intent(inout) :: reader           !! at its first token
        type(symbols_t), intent(in) :: symbols            !! the names that it may use
        integer, intent(out) :: node                      !! its place
        type(error_t), allocatable, intent(out) :: error  !! column and remedy
        integer :: exponent, left
        logical :: negative, one

        call read_factor(reader, symbols, node, error)
        if (allocated(error)) return
        if (.not. next_is(reader, "^")) return
        reader%at = reader%at + 1
        negative = next_is(reader, "-")
        if (negative .or. next_is(reader, "+")) reader%at = reader%at + 1
        if (reader%tokens%token(reader%at)%kind == is_end .or. &
            .not. (begins_factor(reader) .or. &
                   reader%tokens%token(reader%at)%kind == is_number)) then
            call refuse(reader, "'^' lacks its exponent; write x^2, x^-1, x^(a + b)", error)
        else if (is_function_name(reader%tokens%word(reader%at))) then
            call refuse(reader, "a function as an exponent needs brackets, x^("// &
                        reader%tokens%word(reader%at)//"(...))", error)
        end if
        if (allocated(error)) return
        one = reader%tokens%word(reader%at) == "1" .and. .not. negative
        call read_factor(reader, symbols, exponent, error)
        if (.not. allocated(error) .and. one .and. next_is(reader, "/")) call refuse(reader, &
            "'^1/' divides the power 1; write x^(1/2), or sqrt(x)", error)
        if (allocated(error)) return
        if (negative) then
            left = exponent
            call reader%expression%add_operation(kind_negation, left, 0, exponent)
        end if
        left = node
        call reader%expression%add_operation(kind_power, left, exponent, node)
    end subroutine read_power

    pure recursive subroutine read_factor(reader, symbols, node, error)
        !! A number, a name, a function, or a sum in brackets or between bars.
        type(reader_t), intent(inout) :: reader           !! at its first token
        type(symbols_t), intent(in) :: symbols            !! the names that it may use
        integer, intent(out) :: node                      !! its place
        type(error_t), allocatable, intent(out) :: error  !! column and remedy
        character(:), allocatable :: word
        type(token_t) :: token
        integer :: bars, left

        node = 0
        token = reader%tokens%token(reader%at)
        word = reader%tokens%word(reader%at)
        select case (token%kind)
        case (is_number)
            call reader%expression%add_number(typed_number(word, token%value), node)
            reader%at = reader%at + 1
        case (is_name)
            call read_name(reader, symbols, word, node, error)
        case (is_sign)
            if (word == "(") then
                call read_bracket(reader, symbols, node, error)
            else if (word == "|") then
                call go_deeper(reader, error)
                if (allocated(error)) return
                bars = reader%bars
                reader%bars = bars + 1
                reader%at = reader%at + 1
                call read_sum(reader, symbols, left, error)
                if (allocated(error)) return
                if (.not. next_is(reader, "|")) then
                    call refuse(reader, "'|' of column "//to_text(token%column)// &
                                " is not closed; write |x| or abs(x)", error)
                    return
                end if
                reader%at = reader%at + 1
                reader%bars = bars
                reader%depth = reader%depth - 1
                call reader%expression%add_operation(kind_function, left, 0, node, f_abs)
            else
                call refuse_missing(reader, error)
            end if
        case default
            call refuse_missing(reader, error)
        end select
    end subroutine read_factor

    pure recursive subroutine read_bracket(reader, symbols, node, error)
        !! A sum in brackets.
        type(reader_t), intent(inout) :: reader           !! at its first token
        type(symbols_t), intent(in) :: symbols            !! the names that it may use
        integer, intent(out) :: node                      !! its place
        type(error_t), allocatable, intent(out) :: error  !! column and remedy
        integer :: bars, column

        node = 0
        column = reader%tokens%token(reader%at)%column
        call go_deeper(reader, error)
        if (allocated(error)) return
        bars = reader%bars
        reader%bars = 0
        reader%at = reader%at + 1
        if (next_is(reader, ")")) then
            call refuse(reader, "the brackets are empty; write a formula into them", error)
            return
        end if
        call read_sum(reader, symbols, node, error)
        if (allocated(error)) return
        if (.not. next_is(reader, ")")) then
            if (reader%tokens%token(reader%at)%kind == is_end .or. next_is(reader, "=")) then
                call refuse(reader, "the bracket of column "//to_text(column)// &
                            " is not closed; write ')'", error)
            else
                call refuse_unexpected(reader, error)
            end if
            return
        end if
        reader%at = reader%at + 1
        reader%bars = bars
        reader%depth = reader%depth - 1
    end subroutine read_bracket

    pure recursive subroutine read_name(reader, symbols, name, node, error)
        !! A symbol, a definition, `pi`, or a function with its argument.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        character(*), intent(in) :: name
        integer, intent(out) :: node
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: indexed
        integer :: which

        node = 0
        which = place_of_function(name)
        if (which /= 0) then
            call read_function(reader, symbols, which, node, error)
            return
        end if
        if (begins_sum(reader) .and. symbols%find(name) == 0 .and. &
            symbols%find_definition(name) == 0) then
            call read_indexed_sum(reader, symbols, node, error)
            return
        end if
        which = findloc(reader%index_names(:reader%indices) == name, .true., 1)
        if (which > 0) then
            call reader%expression%add_number(ratio(int(reader%index_values(which), i8), 1_i8), &
                                              node)
            reader%at = reader%at + 1
            return
        end if
        call read_rate(reader, symbols, node, error)
        if (allocated(error) .or. node > 0) return
        if (symbols%spelling(name) /= name) then
            call add_named(reader, symbols, name, reader%at + 1, node)
            call read_behind(reader, symbols, symbols%spelling(name), node, error)
            return
        end if
        call put_indices(reader, name, indexed, error)
        if (allocated(error)) return
        if (indexed /= name) then
            call add_indexed(reader, symbols, name, indexed, node, error)
            return
        end if
        if (symbols%find(name) > 0) then
            call reader%expression%add_symbol(symbols%find(name), node)
        else if (symbols%find_definition(name) > 0) then
            which = symbols%find_definition(name)
            if (reader%root_of(which) == 0) then
                call reader%expression%append(symbols%definitions(which)%meaning, node)
                reader%root_of(which) = node
            end if
            node = reader%root_of(which)
        else if (name == "pi") then
            call reader%expression%add_number(number_of(pi), node)
        else if (name == "e" .and. reader%tokens%word(min(reader%at + 1, &
                                                          size(reader%tokens%token))) == "^") then
            call read_exponential(reader, symbols, node, error)
            return
        else if (is_of_chain(symbols, name)) then
            call refuse_index(reader, symbols, name, name, error)
            return
        else if (name(1:1) == "_") then
            call refuse(reader, "a bracket has no '"//name//"'; write that of each name in it", &
                        error)
            return
        else
            call refuse_unknown(reader, symbols, name, error)
            return
        end if
        reader%at = reader%at + 1
        call read_behind(reader, symbols, name, node, error)
    end subroutine read_name

    pure function place_of_function(name) result(which)
        !! Among all functions, or that of `acos` or `asin`; 0: there is none.
        character(*), intent(in) :: name
        integer :: which

        which = findloc(function_names == name, .true., 1)
        if (name == "acos" .or. name == "arccos") which = arc_cosine_of
        if (name == "asin" .or. name == "arcsin") which = arc_sine_of
    end function place_of_function

    pure subroutine add_indexed(reader, symbols, name, indexed, node, error)
        !! A name whose indices have numbers.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        character(*), intent(in) :: name, indexed
        integer, intent(out) :: node
        type(error_t), allocatable, intent(out) :: error

        node = 0
        call add_named(reader, symbols, indexed, reader%at + 1, node)
        if (node == 0) call refuse_index(reader, symbols, name, indexed, error)
    end subroutine add_indexed

    pure subroutine add_named(reader, symbols, name, behind, node)
        !! A symbol or a definition, if there is one.
        type(reader_t), intent(inout) :: reader    !! of a formula
        type(symbols_t), intent(in) :: symbols     !! names and definitions
        character(*), intent(in) :: name           !! as it is typed, without an index to replace
        integer, intent(in) :: behind              !! the token that is next then
        integer, intent(inout) :: node             !! the new one; unchanged where there is none
        character(:), allocatable :: known
        integer :: which

        known = symbols%spelling(name)
        which = symbols%find_definition(known)
        if (symbols%find(known) > 0) then
            call reader%expression%add_symbol(symbols%find(known), node)
        else if (which > 0) then
            call reader%expression%append(symbols%definitions(which)%meaning, node)
        else
            return
        end if
        reader%at = behind
    end subroutine add_named
end module lagrangia_formula_parser
