module lagrangia_formula_reader
    !! How far the reading of a formula has come, and what it says where it cannot go on.
    use lagrangia_errors, only: error_t, fail
    use lagrangia_exact_number, only: number_of, number_t, ratio
    use lagrangia_expression, only: expression_t, function_names
    use lagrangia_formula_tokens, only: comma_advice, cut, is_end, is_name, is_number, is_sign, &
                                        prime_advice, tokens_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_names, only: name_length, nearest_name
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: join, quoted, to_text
    implicit none (type, external)
    private
    public :: reader_t
    public :: largest, most_indices
    public :: begins_factor, check_size, go_deeper, is_time_in_brackets, is_unit, next_is, refuse, &
              refuse_missing, refuse_unexpected, refuse_unknown, skip_sign, start, typed_number

    integer, parameter :: deepest = 200          !! brackets within brackets
    real(dp), parameter :: largest = 100000.0_dp !! parts, with definitions written out
    integer, parameter :: most_indices = 4       !! sums within each other
    character(*), parameter :: units(*) = [character(3) :: "m", "cm", "mm", "km", "g", "kg", "s", &
                                           "ms", "N", "Nm", "J", "W", "Hz", "rad", "deg"]

    type :: reader_t
        !! How far the reading has come.
        type(tokens_t) :: tokens
        type(expression_t) :: expression
        integer, allocatable :: root_of(:)  !! of each definition that was used, else 0
        integer :: at = 1                   !! the next token
        integer :: depth = 0                !! brackets that are open
        integer :: bars = 0                 !! `|` that are open inside the last bracket
        integer :: indices = 0              !! of the sums that are open
        character(name_length) :: index_names(most_indices) = ""
        integer :: index_values(most_indices) = 0
    end type reader_t

contains

    pure subroutine start(reader, text, symbols, error)
        !! Before the first token.
        type(reader_t), intent(out) :: reader             !! of this text
        character(*), intent(in) :: text                  !! at most 10000 characters, UTF-8
        type(symbols_t), intent(in) :: symbols            !! the names that it may use
        type(error_t), allocatable, intent(out) :: error  !! something that is no token
        integer :: definitions

        call cut(text, reader%tokens, error)
        definitions = 0
        if (allocated(symbols%definitions)) definitions = size(symbols%definitions)
        allocate (reader%root_of(definitions), source=0)
    end subroutine start

    pure function next_is(reader, sign) result(yes)
        !! Is this sign next?
        type(reader_t), intent(in) :: reader  !! within a text
        character, intent(in) :: sign         !! `^` is also `**`
        logical :: yes

        yes = .false.
        associate (token => reader%tokens%token(reader%at))
            if (token%kind /= is_sign) return
            yes = reader%tokens%text(token%first:token%first) == sign
            if (token%last > token%first) yes = sign == "^"
        end associate
    end function next_is

    pure function begins_factor(reader) result(yes)
        !! Can a factor begin here? A bar closes those that are open.
        type(reader_t), intent(in) :: reader  !! within a text
        logical :: yes

        yes = reader%tokens%token(reader%at)%kind == is_name .or. next_is(reader, "(") .or. &
              (next_is(reader, "|") .and. reader%bars == 0)
    end function begins_factor

    pure function is_time_in_brackets(reader) result(yes)
        !! Does `(t)` follow without a blank?
        type(reader_t), intent(in) :: reader  !! behind a name
        logical :: yes

        yes = .false.
        if (reader%at + 2 > size(reader%tokens%token)) return
        if (.not. (next_is(reader, "(") .and. reader%tokens%token(reader%at)%glued)) return
        yes = reader%tokens%word(reader%at + 1) == "t" .and. &
              reader%tokens%word(reader%at + 2) == ")"
    end function is_time_in_brackets

    pure function typed_number(word, value) result(number)
        !! The fraction that a decimal with at most nine digits behind the point is, else a real.
        character(*), intent(in) :: word  !! a valid number without a sign
        real(dp), intent(in) :: value     !! its double
        type(number_t) :: number
        integer :: behind, i, mantissa, status
        integer(i8) :: digits
        logical :: point

        number = number_of(value)
        mantissa = scan(word, "eE") - 1
        behind = 0
        status = 0
        if (mantissa >= 0) then
            if (len(word) - mantissa > 5) return
            read (word(mantissa + 2:), *, iostat=status) behind
        else
            mantissa = len(word)
        end if
        if (status /= 0) return
        behind = -behind
        digits = 0_i8
        point = .false.
        do i = 1, mantissa
            if (word(i:i) == ".") then
                point = .true.
                cycle
            end if
            if (digits > 10_i8**14) return
            digits = 10_i8*digits + iachar(word(i:i)) - iachar("0")
            if (point) behind = behind + 1
        end do
        if (behind > 0 .and. behind <= 9) number = ratio(digits, 10_i8**behind)
    end function typed_number

    pure subroutine skip_sign(reader, error)
        !! The sign of an operation, which no other sign may follow.
        type(reader_t), intent(inout) :: reader           !! at what is wrong
        type(error_t), allocatable, intent(out) :: error  !! if it cannot be
        character(:), allocatable :: sign_before

        sign_before = reader%tokens%word(reader%at)
        reader%at = reader%at + 1
        if (next_is(reader, "+") .or. next_is(reader, "-")) then
            call refuse(reader, quoted(reader%tokens%word(reader%at))//" follows "// &
                        quoted(sign_before)//"; write brackets, a*(-b)", error)
        end if
    end subroutine skip_sign

    pure subroutine go_deeper(reader, error)
        !! One more bracket.
        type(reader_t), intent(inout) :: reader           !! at what is wrong
        type(error_t), allocatable, intent(out) :: error  !! if it cannot be

        reader%depth = reader%depth + 1
        if (reader%depth > deepest) then
            call refuse(reader, "more than "//to_text(deepest)//" brackets within each other; "// &
                        "give parts of the formula names, D = theta1 - theta2", error)
        end if
    end subroutine go_deeper

    pure subroutine check_size(expression, error)
        !! Refuse a formula whose definitions, written out, make it too long.
        type(expression_t), intent(in) :: expression      !! of shared nodes
        type(error_t), allocatable, intent(out) :: error  !! too long
        real(dp) :: parts(0:expression%count)
        integer :: i

        parts(0) = 0.0_dp
        do i = 1, expression%count
            associate (node => expression%nodes(i))
                parts(i) = min(2.0_dp*largest, 1.0_dp + parts(node%left) + parts(node%right))
            end associate
        end do
        if (parts(expression%count) > largest) then
            call fail(error, "the formula, with its definitions written out, has more than "// &
                      to_text(nint(largest))//" parts; shorten it")
        end if
    end subroutine check_size

    pure subroutine refuse(reader, problem, error)
        !! Say what is wrong at the next token.
        type(reader_t), intent(in) :: reader              !! at what is wrong
        character(*), intent(in) :: problem               !! and what to do about it
        type(error_t), allocatable, intent(out) :: error  !! with the column

        call fail(error, "column "//to_text(reader%tokens%token(reader%at)%column)//": "//problem)
    end subroutine refuse

    pure subroutine refuse_unexpected(reader, error)
        !! A token that cannot stand where it does.
        type(reader_t), intent(in) :: reader              !! at it
        type(error_t), allocatable, intent(out) :: error  !! always

        if (next_is(reader, ",")) then
            call refuse(reader, comma_advice, error)
        else if (next_is(reader, "'")) then
            call refuse(reader, prime_advice(reader%tokens%text, &
                                             reader%tokens%token(reader%at)%first), error)
        else
            call refuse(reader, quoted(reader%tokens%word(reader%at))//" is not expected", error)
        end if
    end subroutine refuse_unexpected

    pure subroutine refuse_missing(reader, error)
        !! There is no factor where one must be.
        type(reader_t), intent(in) :: reader              !! where it must be
        type(error_t), allocatable, intent(out) :: error  !! always
        character(:), allocatable :: before, word

        word = reader%tokens%word(reader%at)
        before = ""
        if (reader%at > 1) before = reader%tokens%word(reader%at - 1)
        if (word == "," .or. word == "'") then
            call refuse_unexpected(reader, error)
        else if (before == "" .and. word == "") then
            call refuse(reader, "the formula is empty; write one like m g l cos(theta)", error)
        else if (before == "=" .or. (before == "" .and. word == "=")) then
            call refuse(reader, "a side of the equation is empty; write 0 if it is zero", error)
        else if (word /= "" .and. (before == "(" .or. before == "" .or. before == "|")) then
            call refuse(reader, quoted(word)//" lacks what stands before it; write a*b", error)
        else if (word == "" .or. word == ")" .or. word == "=" .or. word == "|") then
            call refuse(reader, "behind "//quoted(before)//" something is missing; complete it "// &
                        "or delete the sign", error)
        else
            call refuse(reader, quoted(word)//" follows "//quoted(before)//"; delete one of them", &
                        error)
        end if
    end subroutine refuse_missing

    pure subroutine refuse_unknown(reader, symbols, name, error)
        !! There is no such name: say which one is near, or how it is written.
        type(reader_t), intent(in) :: reader              !! at the name
        type(symbols_t), intent(in) :: symbols            !! the names that there are
        character(*), intent(in) :: name                  !! that is none of them
        type(error_t), allocatable, intent(out) :: error  !! always
        character(name_length), allocatable :: names(:)
        character(:), allocatable :: behind, factors, nearest
        logical :: applied

        if (is_unit(reader)) then
            call refuse(reader, quoted(name)//" is a unit, and numbers have none here; write "// &
                        "the number alone, or the formula in letters", error)
            return
        end if
        behind = reader%tokens%word(min(reader%at + 1, size(reader%tokens%token)))
        applied = behind == "("
        call symbols%all_names(names)
        if (applied .or. (behind == "|" .and. reader%bars == 0)) then  ! ln|x|
            nearest = nearest_function(name)
            if (nearest /= "") then
                call refuse(reader, "unknown function "//quoted(name)//"; did you mean "// &
                            quoted(nearest)//"?", error)
                return
            end if
        end if
        factors = product_of(name, names)
        nearest = nearest_name(name, names)
        if (factors /= "" .and. nearest == "") then
            call refuse(reader, "unknown name "//quoted(name)//"; a product needs blanks: "// &
                        quoted(factors), error)
        else if (factors /= "") then
            call refuse(reader, "unknown name "//quoted(name)//"; did you mean "// &
                        quoted(nearest)//", or the product "//quoted(factors)//"?", error)
        else if (applied .and. nearest == "") then
            call refuse(reader, "unknown function "//quoted(name)//"; there are "// &
                        join(function_names, ", ")//", acos, asin", error)
        else if (nearest /= "") then
            call refuse(reader, "unknown name "//quoted(name)//"; did you mean "// &
                        quoted(nearest)//"?", error)
        else if (name == "sum") then
            call refuse(reader, "a sum is written sum(i, 1, 4, m/2 x_i_dot^2)", error)
        else if (size(names) == 1) then
            call refuse(reader, "unknown name "//quoted(name)//"; there is only "//trim(names(1)), &
                        error)
        else
            call refuse(reader, "unknown name "//quoted(name)//"; there are "// &
                        join(essential(names), ", "), error)
        end if
    end subroutine refuse_unknown

    pure function is_unit(reader) result(yes)
        !! Does the next token stand among units behind a number, up to the end: `1.96 m/s^2`?
        type(reader_t), intent(in) :: reader   !! at a name, or at the 1 of `1/s`
        logical :: yes
        integer :: at

        yes = .false.
        do at = reader%at, size(reader%tokens%token)
            if (reader%tokens%token(at)%kind == is_end .or. &
                any(reader%tokens%word(at) == ["=", ")"])) exit
            if (.not. is_of_units(at)) return
        end do
        if (.not. any([(any(units == reader%tokens%word(at)), &
                        at=reader%at, min(reader%at + 2, size(reader%tokens%token)))])) return
        do at = reader%at - 1, 1, -1
            if (.not. is_of_units(at)) return
            yes = reader%tokens%token(at)%kind == is_number
            if (at > 1 .and. yes) yes = .not. any(reader%tokens%word(at - 1) == ["^", "-"]) .or. &
                                        at == 2
            if (yes) return
        end do
    contains
        pure logical function is_of_units(place)
            integer, intent(in) :: place

            is_of_units = reader%tokens%token(place)%kind == is_number .or. &
                          any(reader%tokens%word(place) == ["/", "*", "^", "-"]) .or. &
                          any(units == reader%tokens%word(place))
        end function is_of_units
    end function is_unit

    pure function essential(names) result(few)
        !! Of many names those that are no derivatives of others.
        character(name_length), intent(in) :: names(:)
        character(name_length), allocatable :: few(:)
        logical :: derived(size(names))
        integer :: i

        do i = 1, size(names)
            derived(i) = index(names(i), "_dot") > 0 .or. index(names(i), "_ddot") > 0 .or. &
                         index(names(i), "dL_d") > 0 .or. index(names(i), "dT_d") == 1 .or. &
                         index(names(i), "dV_d") == 1 .or. index(names(i), "dE_d") == 1
        end do
        few = names
        if (size(names) > 12) few = pack(names, .not. derived)
    end function essential

    pure function nearest_function(name) result(nearest)
        !! What a function is called here; empty if no name is near.
        character(*), intent(in) :: name
        character(:), allocatable :: nearest

        select case (name)
        case ("ln")
            nearest = "log"
        case ("tg")
            nearest = "tan"
        case ("sen")
            nearest = "sin"
        case ("arctan", "arctg")
            nearest = "atan"
        case ("root")
            nearest = "sqrt"
        case ("cot", "ctg", "cotan")
            nearest = "1/tan"
        case ("sec")
            nearest = "1/cos"
        case ("csc", "cosec")
            nearest = "1/sin"
        case default
            nearest = ""
            if (len(name) > 2) nearest = nearest_name(name, function_names)
        end select
    end function nearest_function

    pure function product_of(name, names) result(factors)
        !! `m g l` for `mgl`: the names that it consists of, as few as can be, with blanks between
        !! them; empty where it does not.
        character(*), intent(in) :: name, names(:)
        character(:), allocatable :: factors
        integer :: best(0:len(name)), last(len(name)), i, k, length

        best = len(name) + 1
        best(0) = 0
        last = 0
        do i = 1, len(name)
            do k = 1, size(names)
                length = len_trim(names(k))
                if (length > i .or. length == 0) cycle
                if (name(i - length + 1:i) /= names(k)(:length)) cycle
                if (best(i - length) + 1 >= best(i)) cycle
                best(i) = best(i - length) + 1
                last(i) = length
            end do
        end do
        factors = ""
        if (best(len(name)) > len(name)) return
        i = len(name)
        do while (i > 0)
            factors = name(i - last(i) + 1:i)//" "//factors
            i = i - last(i)
        end do
        factors = trim(factors)
    end function product_of
end module lagrangia_formula_reader
