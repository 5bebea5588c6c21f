module lagrangia_differentials
    !! Quotients of differentials, `d theta/dt`, `dV/dtheta`, `d^2V/(dx dy)`, `d/dt`: what is
    !! differentiated, how often, and by what.
    use lagrangia_expression, only: is_function_name, kind_symbol
    use lagrangia_formula_reader, only: reader_t
    use lagrangia_formula_tokens, only: is_name
    use lagrangia_names, only: name_length
    use lagrangia_symbols, only: symbols_t
    implicit none (type, external)
    private
    public :: quotient_t
    public :: coordinates, find_quotient, is_known, name_of_slope, place_of, slope_name

    type :: quotient_t
        !! Of differentials, as tokens.
        integer :: order = 0                     !! 0: there is none
        character(:), allocatable :: operand     !! a name; empty: a bracket, or what follows
        integer :: bracket = 0                   !! token where that begins
        integer :: product = 0                   !! token where factors begin, up to the slash
        integer :: slash = 0                     !! of `d sin(theta)/dt`, its token
        character(name_length) :: by(2) = ""     !! `t`, `theta`, `theta_dot`
        integer :: behind = 0                    !! the token that is next then
    end type quotient_t

contains

    pure subroutine find_quotient(reader, symbols, quotient)
        !! The differentials from the next token on.
        type(reader_t), intent(in) :: reader            !! at its first token
        type(symbols_t), intent(in) :: symbols          !! of a sheet, with rates
        type(quotient_t), intent(out) :: quotient       !! order 0: none stands here
        character(:), allocatable :: name
        integer :: at, begun, number, order
        logical :: bare, closed

        quotient%operand = ""
        at = reader%at
        name = reader%tokens%word(at)
        if (name == "partial" .or. name == "del") name = "d"
        if (name(1:1) /= "d") return
        name = name(2:)
        at = at + 1
        order = 1
        if (name == "" .and. word(at) == "^" .and. word(at + 1) == "2") then
            order = 2
            at = at + 2
        else if (name /= "") then
            if (name(1:1) == "2") then
                order = 2
                name = name(2:)
            end if
        end if
        begun = at
        bare = name == "" .and. word(at) /= "/"
        if (name == "" .and. sort_at(at) == is_name) then
            name = word(at)
            at = at + 1
        else if (name == "" .and. word(at) == "(") then
            quotient%bracket = at
            at = behind_bracket(at)
        end if
        quotient%operand = name
        if (is_function_name(name)) then  ! d sin(theta)/dt
            at = begun
        else if (name /= "" .and. word(at) == "(") then
            at = behind_arguments(at)
        end if
        if (word(at) /= "/" .and. bare) then
            quotient%operand = ""
            quotient%bracket = 0
            quotient%product = begun
            at = slash_of_time(begun)
            quotient%slash = at
        end if
        if (word(at) /= "/") return
        at = at + 1
        closed = word(at) == "("
        if (closed) at = at + 1
        number = 0
        do while (number < order)
            call take_by(at, number, quotient%by)
            if (at == 0) return
        end do
        if (closed .and. word(at) /= ")") return
        if (closed) at = at + 1
        quotient%behind = at
        quotient%order = order
    contains
        pure function word(k) result(text)
            integer, intent(in) :: k
            character(:), allocatable :: text

            text = ""
            if (k <= size(reader%tokens%token)) text = reader%tokens%word(k)
            if (text == "**") text = "^"
        end function word

        pure function sort_at(k) result(of)
            integer, intent(in) :: k
            integer :: of

            of = reader%tokens%token(k)%kind
        end function sort_at

        pure function behind_bracket(k) result(next)
            !! The token behind the one that closes it.
            integer, intent(in) :: k
            integer :: next, depth

            depth = 0
            do next = k, size(reader%tokens%token)
                if (word(next) == "(") depth = depth + 1
                if (word(next) == ")") depth = depth - 1
                if (depth == 0) exit
            end do
            next = next + 1
        end function behind_bracket

        pure function behind_arguments(k) result(next)
            !! The token behind `(theta, t)`; the same one where there is no list of names.
            integer, intent(in) :: k
            integer :: next

            do next = k + 1, size(reader%tokens%token)
                if (sort_at(next) /= is_name .and. word(next) /= ",") exit
            end do
            next = merge(next + 1, k, word(next) == ")")
        end function behind_arguments

        pure function slash_of_time(k) result(next)
            !! The `/` of `/dt` behind factors; or where these end.
            integer, intent(in) :: k
            integer :: next, depth

            depth = 0
            do next = k, size(reader%tokens%token)
                if (word(next) == "(") depth = depth + 1
                if (word(next) == ")") depth = depth - 1
                if (depth < 0 .or. word(next) == "=") exit
                if (depth > 0) cycle
                if (scan(word(next), "+-") == 1 .and. word(next - 1) /= "^") exit
                if (word(next) /= "/") cycle
                if (word(next + 1) == "dt" .or. (word(next + 1) == "(" .and. &
                                                 word(next + 2) == "dt")) exit
                if (order == 2 .and. (word(next + 1) == "dt2" .or. word(next + 2) == "dt2")) exit
            end do
        end function slash_of_time

        pure subroutine take_by(k, count, all)
            !! `dt`, `d theta`, `dx^2`, `dt2`; 0: none of these.
            integer, intent(inout) :: k, count
            character(name_length), intent(inout) :: all(2)
            character(:), allocatable :: by

            by = word(k)
            if (by == "partial" .or. by == "del") by = "d"
            if (by == "" .or. sort_at(k) /= is_name) then
                k = 0
                return
            end if
            if (by(1:1) /= "d" .or. (by /= "d" .and. symbols%find(by) > 0)) then
                k = 0
                return
            end if
            k = k + 1
            by = by(2:)
            if (by == "" .and. sort_at(k) == is_name .and. .not. is_known(symbols, "d")) then
                by = word(k)
                k = k + 1
            else if (by == "" .and. word(k) == "(" .and. word(k + 2) == ")") then
                by = word(k + 1)
                k = k + 3
            end if
            if (symbols%primes .and. word(k) == "'") then  ! the velocity
                by = trim(symbols%spelling(by))//"_dot"
                k = k + 1
            end if
            if (order == 2 .and. count == 0 .and. len(by) > 1) then  ! dt2
                if (by(len(by):) == "2" .and. .not. can_divide(symbols, by)) then
                    by = by(:len(by) - 1)
                    count = 1
                end if
            end if
            if (order == 2 .and. word(k) == "^" .and. word(k + 1) == "2") then
                k = k + 2
                count = count + 1
            end if
            count = count + 1
            if (.not. can_divide(symbols, by) .or. count > order) then
                k = 0
                return
            end if
            all(count) = by
            if (all(1) == "") all(1) = by
        end subroutine take_by
    end subroutine find_quotient

    pure function is_known(symbols, name) result(yes)
        !! Is it a symbol or a definition?
        type(symbols_t), intent(in) :: symbols  !! of a sheet, with rates
        character(*), intent(in) :: name        !! as typed
        logical :: yes

        yes = symbols%find(name) > 0 .or. symbols%find_definition(name) > 0
    end function is_known

    pure function can_divide(symbols, by) result(yes)
        !! Is there a derivative by this name: the time, a coordinate, a velocity, a momentum?
        type(symbols_t), intent(in) :: symbols  !! of a sheet, with rates
        character(*), intent(in) :: by          !! behind its d
        logical :: yes

        yes = by == "t" .or. place_of(symbols, by) > 0 .or. index(by, "p_") == 1 .or. by == "p"
    end function can_divide

    pure function place_of(symbols, name) result(place)
        !! Of a coordinate or a velocity, by another spelling perhaps; 0: it is none.
        type(symbols_t), intent(in) :: symbols  !! of a sheet, with rates
        character(*), intent(in) :: name        !! as typed
        integer :: place
        character(:), allocatable :: known
        integer :: which

        known = symbols%spelling(name)
        place = symbols%find(known)
        which = symbols%find_definition(known)
        if (place == 0 .and. which > 0) then
            associate (meaning => symbols%definitions(which)%meaning)
                if (meaning%count == 1 .and. meaning%nodes(1)%kind == kind_symbol) then
                    place = meaning%nodes(1)%which
                end if
            end associate
        end if
        if (place < 2 .or. place > 1 + 2*coordinates(symbols)) place = 0
    end function place_of

    pure function coordinates(symbols) result(n)
        !! How many: the velocity of the first one stands behind the last one.
        type(symbols_t), intent(in) :: symbols  !! of a sheet, with rates
        integer :: n

        n = 0
        if (size(symbols%rates) > 1) n = max(0, symbols%rates(2) - 2)
    end function coordinates

    pure function slope_name(symbols, operand, by) result(name)
        !! `dV_dtheta`, if there is a name of this kind; else empty.
        type(symbols_t), intent(in) :: symbols  !! of a sheet, with rates
        character(*), intent(in) :: operand     !! `V`
        character(*), intent(in) :: by          !! `theta`
        character(:), allocatable :: name
        integer :: place

        name = symbols%spelling("d"//operand//"_d"//by)
        if (is_known(symbols, name)) return
        name = "d"//operand//"_d"//symbols%spelling(by)
        if (is_known(symbols, name)) return
        place = place_of(symbols, by)
        if (place > 0) name = "d"//operand//"_d"//trim(symbols%names(place))
        if (place == 0 .or. .not. is_known(symbols, name)) name = ""
    end function slope_name

    pure function name_of_slope(symbols, quotient) result(name)
        !! `dV_dtheta` of `dV/dtheta`, `ddV_eff_dr_dr` of `d^2V_eff/dr^2`; empty where none is.
        type(symbols_t), intent(in) :: symbols    !! of a sheet, with rates
        type(quotient_t), intent(in) :: quotient  !! of any order
        character(:), allocatable :: name
        integer :: i

        name = ""
        if (quotient%order == 0) return
        name = quotient%operand
        do i = 1, quotient%order
            if (quotient%by(i) == "t") name = ""
            if (name /= "") name = slope_name(symbols, name, trim(quotient%by(i)))
        end do
    end function name_of_slope
end module lagrangia_differentials
