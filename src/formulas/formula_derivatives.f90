submodule (lagrangia_formula_parser) lagrangia_formula_derivatives
    !! Derivatives as they are written by hand: `d/dt(m x_dot)`, `d theta/dt`, `dV/dtheta`,
    !! `d/dtheta V`, `d^2V/dtheta^2`, `theta''`, `V'(theta)`.
    use lagrangia_derivative, only: derivative, time_derivative
    use lagrangia_differentials, only: coordinates, find_quotient, is_known, name_of_slope, &
                                       place_of, quotient_t, slope_name
    use lagrangia_expression, only: kind_symbol, operator(*), operator(+), operator(/), symbol
    use lagrangia_formula_reader, only: is_time_in_brackets, largest
    use lagrangia_formula_text, only: typed_name
    use lagrangia_formula_tokens, only: prime_advice
    use lagrangia_substitution, only: substituted
    implicit none (type, external)

    character(*), parameter :: by_hand = "a derivative is written d/dt(m x_dot), dV/dx, "// &
        "d^2 x/dt^2 or x_ddot"

contains

    pure recursive module subroutine read_rate(reader, symbols, node, error)
        !! A derivative; no node where none stands here.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        integer, intent(out) :: node
        type(error_t), allocatable, intent(out) :: error
        type(quotient_t) :: quotient
        type(expression_t) :: nothing
        character(:), allocatable :: name
        integer :: first, i
        logical :: named

        node = 0
        if (.not. allocated(symbols%rates)) return
        name = reader%tokens%word(reader%at)
        first = reader%at
        if (name /= "d" .and. is_known(symbols, name)) return
        call find_quotient(reader, symbols, quotient)
        if (quotient%order == 0) then
            if (name == "d" .and. .not. is_known(symbols, name)) call refuse_unfinished(reader, &
                                                                                    symbols, error)
            return
        end if
        if (quotient%operand /= "") then
            call add_slope(reader, symbols, quotient, node)
            if (node > 0) return
            call add_named(reader, symbols, quotient%operand, quotient%behind, node)
            if (node == 0) then
                call refuse_unknown(reader, symbols, quotient%operand, error)
                return
            end if
        else if (quotient%bracket > 0) then
            reader%at = quotient%bracket
            call read_bracket(reader, symbols, node, error)
            if (allocated(error)) return
        else if (quotient%product > 0) then
            reader%at = quotient%product
            call read_factors(reader, symbols, quotient%slash, node, error)
            if (allocated(error)) return
        else
            reader%at = quotient%behind
            named = .false.
            if (reader%tokens%token(reader%at)%kind == is_name) then
                quotient%operand = reader%tokens%word(reader%at)
                quotient%behind = reader%at + 1
                named = name_of_slope(symbols, quotient) /= ""
            end if
            if (named) then
                call add_slope(reader, symbols, quotient, node)
                call skip_arguments(reader, symbols, symbols%find(quotient%operand), nothing)
            else if (.not. (next_is(reader, ")") .or. next_is(reader, "="))) then
                call read_factor(reader, symbols, node, error)
                if (allocated(error)) return
            end if
            if (node == 0 .or. begins_factor(reader) .or. next_is(reader, "*") .or. &
                next_is(reader, "/") .or. next_is(reader, "^")) then
                reader%at = first
                call refuse(reader, "of what is it the derivative? Write d/dt(m x_dot)", error)
            end if
            if (allocated(error) .or. named) return
            quotient%behind = reader%at
        end if
        ! by places before the time, of which these need not know
        do i = 1, quotient%order
            if (quotient%by(i) == "t") cycle
            call differentiate_by(reader, symbols, first, trim(quotient%by(i)), node, error)
            if (allocated(error)) return
        end do
        do i = 1, quotient%order
            if (quotient%by(i) /= "t") cycle
            call differentiate(reader, symbols, first, node, error)
            if (allocated(error)) return
        end do
        reader%at = quotient%behind
    end subroutine read_rate

    pure recursive subroutine read_factors(reader, symbols, behind, node, error)
        !! Those of `d m l^2 theta_dot/dt`, up to its last slash.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        integer, intent(in) :: behind    !! token of this slash
        integer, intent(out) :: node
        type(error_t), allocatable, intent(out) :: error
        integer :: kind, left, right

        call read_power(reader, symbols, node, error)
        do while (.not. allocated(error) .and. reader%at < behind)
            kind = merge(kind_quotient, kind_product, next_is(reader, "/"))
            if (next_is(reader, "/") .or. next_is(reader, "*")) call skip_sign(reader, error)
            if (allocated(error)) return
            call read_power(reader, symbols, right, error)
            if (allocated(error)) return
            left = node
            call reader%expression%add_operation(kind, left, right, node)
        end do
    end subroutine read_factors

    pure recursive subroutine refuse_unfinished(reader, symbols, error)
        !! `d`, and no derivative.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        type(error_t), allocatable, intent(out) :: error
        integer :: first, node

        first = reader%at
        reader%at = first + 1
        if (next_is(reader, "(")) then
            call read_bracket(reader, symbols, node, error)
            if (.not. allocated(error)) call refuse(reader, "behind d(...) stands '/dt'", error)
        else
            reader%at = first
            call refuse(reader, by_hand, error)
        end if
    end subroutine refuse_unfinished

    pure subroutine add_slope(reader, symbols, quotient, node)
        !! `dV/dtheta`, which has a name of its own; no node where it has none.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        type(quotient_t), intent(in) :: quotient
        integer, intent(inout) :: node
        character(:), allocatable :: name

        name = name_of_slope(symbols, quotient)
        if (name == "") return
        if (symbols%along_motion .and. quotient%operand == "T") return  ! the work-energy theorem
        call add_named(reader, symbols, name, quotient%behind, node)
    end subroutine add_slope

    pure subroutine differentiate_by(reader, symbols, first, by, node, error)
        !! By a coordinate or a velocity, what was read from token `first` on; energies in it have
        !! derivatives with names.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        integer, intent(in) :: first
        character(*), intent(in) :: by
        integer, intent(inout) :: node
        type(error_t), allocatable, intent(out) :: error
        type(expression_t) :: operand, slope, of_name
        character(:), allocatable :: name
        integer :: i, n, place, which
        logical :: alone

        operand = reader%expression%pruned(node)
        place = place_of(symbols, by)
        n = coordinates(symbols)
        if (place == 0) then
            reader%at = first
            call refuse(reader, "only L, T, V and H have derivatives by "//quoted(by), error)
            return
        end if
        if (symbols%along_motion .and. place < 2 + n .and. .not. has_slopes()) then
            call differentiate(reader, symbols, first, node, error)
            if (allocated(error)) return
            slope = reader%expression%pruned(node)/symbol(symbols%rates(place))
            call append(reader, first, slope, node, error)
            return
        end if
        slope = derivative(operand, place)
        alone = operand%count == 1
        do i = 2 + 2*n, size(symbols%rates)
            if (.not. operand%depends_on(i)) cycle
            if (i > 1 + 3*n .and. symbols%rates(i) == 0) cycle  ! a constant
            name = slope_name(symbols, trim(symbols%names(i)), by)
            if (name == "") then
                reader%at = first
                call refuse(reader, "the derivative of '"//typed_name(trim(symbols%names(i)))// &
                            "' by "// &
                            quoted(by)//" is not known here; write the formula for it", error)
                return
            end if
            which = symbols%find_definition(name)
            if (which > 0) then
                of_name = symbols%definitions(which)%meaning
            else
                of_name = symbol(symbols%find(name))
            end if
            if (alone) slope = of_name
            if (.not. alone) slope = slope + derivative(operand, i)*of_name
        end do
        call append(reader, first, slope, node, error)
    contains
        pure logical function has_slopes()
            !! Is there a derivative of L in it, or a momentum that is not the only one? They are
            !! differentiated as they are.
            integer :: k

            has_slopes = .false.
            do k = 2 + 2*n, size(symbols%rates)
                if (.not. operand%depends_on(k)) cycle
                has_slopes = has_slopes .or. index(symbols%names(k), "d") == 1 .or. &
                             (index(symbols%names(k), "p_") == 1 .and. n > 1)
            end do
        end function has_slopes
    end subroutine differentiate_by

    pure subroutine differentiate(reader, symbols, first, node, error)
        !! By the time, what was read from token `first` on.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        integer, intent(in) :: first
        integer, intent(inout) :: node
        type(error_t), allocatable, intent(out) :: error
        type(expression_t) :: operand
        integer :: i

        operand = reader%expression%pruned(node)
        do i = 1, size(symbols%rates)
            if (symbols%rates(i) >= 0 .or. .not. operand%depends_on(i)) cycle
            reader%at = first
            call refuse(reader, "d/dt of '"//typed_name(trim(symbols%names(i)))// &
                        "' is not known here; write the formula for it", error)
            return
        end do
        call append(reader, first, time_derivative(operand, symbols%rates, 1), node, error)
    end subroutine differentiate

    pure subroutine append(reader, first, rate, node, error)
        !! A derivative behind all that was read, unless it is too long.
        type(reader_t), intent(inout) :: reader
        integer, intent(in) :: first
        type(expression_t), intent(in) :: rate
        integer, intent(inout) :: node
        type(error_t), allocatable, intent(out) :: error

        call reader%expression%append(rate, node)
        if (reader%expression%count <= largest) return
        reader%at = first
        call refuse(reader, "the derivative has more than "//to_text(nint(largest))// &
                    " parts; shorten it", error)
    end subroutine append

    pure recursive module subroutine read_behind(reader, symbols, name, node, error)
        !! Primes behind a name, or on what it depends.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        character(*), intent(in) :: name         !! as the symbols have it
        integer, intent(inout) :: node           !! of it
        type(error_t), allocatable, intent(out) :: error
        type(expression_t) :: meaning
        integer :: which

        if (next_is(reader, "'")) then
            call read_primes(reader, symbols, name, node, error)
            return
        end if
        which = symbols%find_definition(name)
        if (which > 0) meaning = symbols%definitions(which)%meaning
        call skip_arguments(reader, symbols, symbols%find(name), meaning)
        if (is_value_at(reader, symbols, name)) then
            call refuse(reader, quoted(name//"(...)")//" would be a product; write the formula "// &
                        "with that place put in", error)
            return
        end if
        if (is_time_in_brackets(reader)) then
            call refuse(reader, quoted(name//"(t)")//" would be a product; write "// &
                        quoted(name)//", or "//quoted(name//" t")//" if one is meant", error)
        end if
    end subroutine read_behind

    pure function is_value_at(reader, symbols, name) result(yes)
        !! `V(0)`, `x_dot(0)`: energies, coordinates and velocities, and a number in brackets.
        type(reader_t), intent(in) :: reader         !! behind the name
        type(symbols_t), intent(in) :: symbols
        character(*), intent(in) :: name             !! as the symbols have it
        logical :: yes
        integer :: at

        yes = .false.
        if (.not. allocated(symbols%rates)) return
        if (.not. next_is(reader, "(") .or. .not. reader%tokens%token(reader%at)%glued) return
        at = symbols%find(name)
        yes = any(name == ["L", "T", "V", "U", "E", "H"]) .or. &
              (at > 1 .and. at < 2 + 2*coordinates(symbols))
        if (.not. yes) return
        yes = .false.
        do at = reader%at + 1, size(reader%tokens%token) - 1
            if (reader%tokens%word(at) == ")") then
                yes = at > reader%at + 1
                return
            end if
            if (reader%tokens%word(at) == "pi") cycle
            if (verify(reader%tokens%word(at), "0123456789./-+") > 0) return
        end do
    end function is_value_at

    pure recursive subroutine read_primes(reader, symbols, name, node, error)
        !! `theta''` is theta_ddot, and `theta'` is theta_dot on a sheet that has `theta''` too;
        !! `V'(theta)` is dV/dtheta where there is one coordinate.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        character(*), intent(in) :: name
        integer, intent(inout) :: node
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: advice
        integer :: first, i, primes
        logical :: energy

        first = reader%at
        primes = 0
        do while (next_is(reader, "'"))
            primes = primes + 1
            reader%at = reader%at + 1
        end do
        i = reader%at
        reader%at = first
        associate (tokens => reader%tokens)
            advice = prime_advice(tokens%text, tokens%token(first)%first)
        end associate
        energy = any(name == ["L", "T", "V", "U"]) .or. any(name == ["V_eff", "U_eff"])
        if (.not. allocated(symbols%rates)) then
            call refuse(reader, advice, error)
        else if (energy .and. coordinates(symbols) > 1) then
            call refuse(reader, "a prime does not say by what; write d"//name//"/d"// &
                        trim(symbols%names(2)), error)
        else if (energy .and. primes <= 2) then
            reader%at = i
            call take_slopes(reader, symbols, first - 1, primes, node, error)
        else if (primes == 2 .or. (primes == 1 .and. symbols%primes)) then
            reader%at = first
            do i = 1, primes
                call differentiate(reader, symbols, first, node, error)
                if (allocated(error)) return
            end do
            reader%at = first + primes
        else
            call refuse(reader, advice, error)
        end if
    end subroutine read_primes

    pure recursive subroutine take_slopes(reader, symbols, first, primes, node, error)
        !! By the one coordinate, and at the place that brackets name.
        type(reader_t), intent(inout) :: reader
        type(symbols_t), intent(in) :: symbols
        integer, intent(in) :: first    !! token of the name
        integer, intent(in) :: primes
        integer, intent(inout) :: node
        type(error_t), allocatable, intent(out) :: error
        type(expression_t) :: at(1)
        integer :: argument, behind, k

        behind = reader%at
        do k = 1, primes
            call differentiate_by(reader, symbols, first, trim(symbols%names(2)), node, error)
            if (allocated(error)) return
        end do
        reader%at = behind
        if (.not. next_is(reader, "(") .or. .not. reader%tokens%token(behind)%glued) return
        call read_bracket(reader, symbols, argument, error)
        if (allocated(error)) return
        at(1) = reader%expression%pruned(argument)
        call append(reader, first, substituted(reader%expression%pruned(node), [2], at), node, &
                    error)
    end subroutine take_slopes

    pure subroutine skip_arguments(reader, symbols, place, meaning)
        !! `V(theta)`, `L(x, x_dot, t)` and `x(t)` say on what something depends.
        type(reader_t), intent(inout) :: reader              !! behind the name
        type(symbols_t), intent(in) :: symbols
        integer, intent(in) :: place                         !! of the symbol; 0: a definition
        type(expression_t), intent(in) :: meaning            !! of the definition
        integer :: at, k, n, which, what
        logical :: moves, of_energies, of_time

        if (.not. allocated(symbols%rates)) return
        if (.not. next_is(reader, "(") .or. .not. reader%tokens%token(reader%at)%glued) return
        n = coordinates(symbols)
        what = place
        if (what == 0 .and. meaning%count == 1) then
            if (meaning%nodes(1)%kind == kind_symbol) what = meaning%nodes(1)%which
        end if
        if (what == 1) return
        of_time = what > 1 .and. what <= 1 + 3*n
        moves = .true.
        if (what > 1 + 3*n) moves = symbols%rates(what) /= 0
        of_energies = .false.  ! f = 2 V, which depends on what V depends on
        if (what == 0) then
            of_energies = any([(meaning%depends_on(k) .and. symbols%rates(k) /= 0, &
                                k=2 + 3*n, size(symbols%rates))])
            moves = of_energies .or. any([(meaning%depends_on(k), k=1, 1 + 3*n)])
        end if
        if (.not. moves) return
        at = reader%at + 1
        do
            which = symbols%find(symbols%spelling(reader%tokens%word(at)))
            if (which == 0) which = place_of(symbols, reader%tokens%word(at))
            if (which == 0) which = momentum(reader%tokens%word(at))
            if (which == 0) return
            if (of_time .and. which /= 1) return
            if (which > 1 + 3*n .and. momentum(reader%tokens%word(at)) == 0) return
            if (what == 0 .and. which > 1 .and. .not. (of_energies .or. &
                                                       meaning%depends_on(which))) return
            at = at + 1
            if (reader%tokens%word(at) == ")") exit
            if (reader%tokens%word(at) /= ",") return
            at = at + 1
        end do
        reader%at = at + 1
    contains
        pure function momentum(word) result(where)
            !! p of H(q, p).
            character(*), intent(in) :: word
            integer :: where

            where = 0
            if (index(word, "p_") == 1) where = symbols%find(word)
            if (word == "p" .and. n == 1) where = symbols%find("p_"//trim(symbols%names(2)))
        end function momentum
    end subroutine skip_arguments
end submodule lagrangia_formula_derivatives
