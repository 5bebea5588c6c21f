module lagrangia_formula_tokens
    !! A formula cut into numbers, names and signs, each with its column.
    use lagrangia_errors, only: error_t, fail
    use lagrangia_formula_characters, only: plain_formula
    use lagrangia_kinds, only: dp
    use lagrangia_number_reader, only: read_number
    use lagrangia_text, only: quoted, to_text
    implicit none (type, external)
    private
    public :: cut, token_t, tokens_t
    public :: comma_advice, prime_advice
    public :: is_end, is_name, is_number, is_sign

    integer, parameter :: is_end = 0, is_number = 1, is_name = 2, is_sign = 3
    character(*), parameter :: digits = "0123456789"
    character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
    character(*), parameter :: inside = letters//"_"//digits
    character(*), parameter :: comma_advice = &
        "',' has no meaning here; decimals have a point: 0.5"
    integer, parameter :: longest = 10000

    type :: token_t
        integer :: kind = is_end
        integer :: first = 1            !! of its letters in the plain text
        integer :: last = 0
        integer :: column = 0           !! in what was typed, in characters from 1
        real(dp) :: value = 0.0_dp      !! of a number
        logical :: glued = .false.      !! nothing between it and the token before
    end type token_t

    type :: tokens_t
        character(:), allocatable :: text           !! plain
        type(token_t), allocatable :: token(:)      !! the last one is the end
    contains
        procedure :: word
    end type tokens_t

contains

    pure function word(self, k) result(text)
        !! The letters of token `k`; empty for the end.
        class(tokens_t), intent(in) :: self
        integer, intent(in) :: k  !! from 1
        character(:), allocatable :: text

        text = self%text(self%token(k)%first:self%token(k)%last)
    end function word

    pure subroutine cut(text, tokens, error)
        !! Find the tokens of a formula.
        character(*), intent(in) :: text                  !! as typed, at most 10000 characters
        type(tokens_t), intent(out) :: tokens             !! of it
        type(error_t), allocatable, intent(out) :: error  !! what cannot be one, and its column
        integer, allocatable :: columns(:)
        type(token_t) :: new
        integer :: at, count

        if (len_trim(text) > longest) then
            call fail(error, "the formula has more than "//to_text(longest)// &
                      " characters; give parts of it names, D = theta1 - theta2")
            return
        end if
        call plain_formula(trim(text), tokens%text, columns, error)
        if (allocated(error)) return
        allocate (tokens%token(len(tokens%text) + 1))
        count = 0
        at = 1
        do
            new = token_t(glued=count > 0)
            do while (at <= len(tokens%text))
                if (tokens%text(at:at) /= " ") exit
                new%glued = .false.
                at = at + 1
            end do
            if (at > len(tokens%text)) exit
            new%first = at
            new%column = columns(at)
            call take(tokens%text, new, error)
            if (allocated(error)) return
            at = new%last + 1
            count = count + 1
            tokens%token(count) = new
        end do
        new%first = at
        new%last = at - 1
        new%column = 1
        if (len(tokens%text) > 0) new%column = columns(len(tokens%text)) + 1
        tokens%token(count + 1) = new
        tokens%token = tokens%token(:count + 1)
    end subroutine cut

    pure subroutine take(text, token, error)
        !! One token from its first letter on.
        character(*), intent(in) :: text
        type(token_t), intent(inout) :: token
        type(error_t), allocatable, intent(out) :: error
        character :: letter

        letter = text(token%first:token%first)
        if (scan(letter, letters) == 1 .or. ends_index(text(:token%first - 1), &
                                                       text(token%first:))) then
            token%kind = is_name
            token%last = token%first + verify(text(token%first:)//" ", inside) - 2
        else if (scan(letter, digits) == 1 .or. &
                 scan(text(token%first:)//" ", ".") == 1 .and. &
                 scan(text(token%first:)//" ", digits) == 2) then
            call take_number(text, token, error)
        else if (scan(letter, "+-*/^()|=,'") == 1) then
            token%kind = is_sign
            token%last = token%first
            if (index(text(token%first:), "**") == 1) token%last = token%first + 1
        else
            call fail(error, "column "//to_text(token%column)//": "//advice(text, token%first))
        end if
    end subroutine take

    pure function ends_index(before, from) result(yes)
        !! The end of `x_(i + 1)_dot`.
        character(*), intent(in) :: before, from
        logical :: yes

        yes = .false.
        if (len(before) == 0) return
        if (before(len(before):) /= ")" .or. scan(from, "_") /= 1) return
        yes = any(from(:verify(from//" ", inside) - 1) == [character(5) :: "_dot", "_ddot"])
    end function ends_index

    pure subroutine take_number(text, token, error)
        !! Digits with a point, and an exponent if digits follow its letter.
        character(*), intent(in) :: text
        type(token_t), intent(inout) :: token
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: problem
        integer :: at, behind

        at = token%first + verify(text(token%first:)//" ", digits//".") - 1
        if (scan(text(at:)//" ", "eE") == 1) then
            behind = at + 1
            if (scan(text(min(behind, len(text)):), "+-") == 1) behind = behind + 1
            if (scan(text(min(behind, len(text) + 1):)//" ", digits) == 1) then
                at = behind + verify(text(behind:)//" ", digits) - 1
            end if
        end if
        token%kind = is_number
        token%last = at - 1
        if (scan(text(at:)//" ", letters//"_") == 1 .and. &
            .not. is_order(text(:token%first - 1))) then
            call refuse_exponent(text, token, at, error)
            if (allocated(error)) return
            behind = at + verify(text(at:)//" ", inside) - 2
            call fail(error, "column "//to_text(token%column)//": a blank is missing in "// &
                      quoted(text(token%first:behind))//"; write "// &
                      quoted(text(token%first:at - 1)//" "//text(at:behind)))
            return
        end if
        call read_number(text(token%first:token%last), token%value, problem)
        if (problem == "") return
        if (index(problem, "is not a number") == 1) problem = "is not a number; write it like 0.01"
        call fail(error, "column "//to_text(token%column)//": "// &
                  quoted(text(token%first:token%last))//" "//problem)
    end subroutine take_number

    pure subroutine refuse_exponent(text, token, at, error)
        !! Refuse an exponent as Fortran has it, `1d-3`, which could be `1 d - 3` as well.
        character(*), intent(in) :: text
        type(token_t), intent(in) :: token  !! a number
        integer, intent(in) :: at           !! of the letter behind it
        type(error_t), allocatable, intent(out) :: error
        integer :: first, last

        if (scan(text(at:at), "dD") == 0) return
        first = at + 1
        if (scan(text(min(first, len(text)):), "+-") == 1) first = first + 1
        last = first + verify(text(min(first, len(text) + 1):)//" ", digits) - 2
        if (last < first) return
        call fail(error, "column "//to_text(token%column)//": the exponent of a number stands "// &
                  "behind an e; for "//quoted(text(token%first:last))//" write '"// &
                  text(token%first:at - 1)//"e"//text(at + 1:last)//"'")
    end subroutine refuse_exponent

    pure function is_order(before) result(yes)
        !! Is the number behind it that of `d^2theta/dt^2`?
        character(*), intent(in) :: before
        logical :: yes
        character(:), allocatable :: word
        integer :: last

        yes = .false.
        last = len_trim(before)
        if (last < 2) return
        if (before(last:last) /= "^") return
        last = len_trim(before(:last - 1))
        word = before(verify(before(:last), inside, back=.true.) + 1:last)
        yes = word == "d" .or. word == "partial"
    end function is_order

    pure function advice(before, at) result(text)
        !! What to write in the place of a sign that has no meaning.
        character(*), intent(in) :: before  !! the formula
        integer, intent(in) :: at           !! where the sign is
        character(:), allocatable :: text

        select case (before(at:at))
        case ("[", "]", "{", "}")
            text = quoted(before(at:at))//" is no bracket of a formula; write ( and )"
        case ("_")
            text = "a name begins with a letter; write it before the '_'"
        case (".")
            text = "a point stands alone; write * for a product, 0.5 for a decimal"
        case ("%")
            text = "'%' has no meaning in a formula; write 0.05 for five percent"
        case ("<", ">")
            text = quoted(before(at:at))//" is no equality; write one with '='"
        case (":")
            text = "':' has no meaning in a formula; write '/' for a quotient, '=' for ':='"
        case default
            text = quoted(before(at:at))//" has no meaning in a formula; delete it"
        end select
    end function advice

    pure function prime_advice(text, at) result(advice)
        !! What to write in the place of a prime that is not read.
        character(*), intent(in) :: text  !! the plain formula
        integer, intent(in) :: at         !! of the first prime
        character(:), allocatable :: advice

        advice = "a prime is no derivative; write "//dotted(text, at)
        if (at < 2) return
        if (scan(text(at - 1:at - 1), "LTVU") == 0) return
        if (at > 2) then
            if (scan(text(at - 2:at - 2), inside) == 1) return
        end if
        advice = "a prime does not say by what; write d"//text(at - 1:at - 1)//"/dx"
    end function prime_advice

    pure function dotted(text, at) result(name)
        !! `theta_ddot` for `theta''`.
        character(*), intent(in) :: text
        integer, intent(in) :: at         !! of the first prime
        character(:), allocatable :: name
        integer :: last, primes

        name = text(verify(text(:at - 1), inside, back=.true.) + 1:at - 1)
        primes = verify(text(at:)//" ", "'") - 1
        last = max(1, len(name) - 3)
        if (name == "" .or. primes > 2 .or. scan(text(at + primes:)//" ", inside) == 1 .or. &
            index(name, "_d") > 0 .and. (name(last:) /= "_dot" .or. primes > 1) .or. &
            scan(name, digits) == 1) then
            name = "x_dot, x_ddot"
        else if (name(last:) == "_dot") then
            name = name(:last)//"ddot"
        else
            name = name//trim(merge("_dot ", "_ddot", primes == 1))
        end if
    end function dotted
end module lagrangia_formula_tokens
