module lagrangia_number_reader
    !! The one strict grammar of a number that a user writes, in a scene or on the command line, its
    !! correctly rounded value (Fortran's `read` takes 1-3 for 1e-3), and what to write in the place
    !! of `pi/4`, `45 deg` or `10^-3`, which are not read but told.
    use, intrinsic :: ieee_arithmetic, only: ieee_get_flag, ieee_get_halting_mode, &
                                             ieee_is_finite, ieee_overflow, ieee_set_flag, &
                                             ieee_set_halting_mode, ieee_underflow
    use, intrinsic :: iso_c_binding, only: c_char, c_double, c_null_char, c_null_ptr, c_ptr
    use lagrangia_characters, only: plainly, unlike
    use lagrangia_kinds, only: dp, i8
    use lagrangia_number_class, only: is_zero
    use lagrangia_text, only: lower, to_text
    implicit none (type, external)
    private
    public :: after, character_at, misread, read_number, starts_number, to_integer
    public :: digits, letters

    character(*), parameter :: digits = "0123456789"
    character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
    character(*), parameter :: blanks = " "//achar(9)
    real(dp), parameter :: pi = acos(-1.0_dp)

    interface
        pure function strtod(text, end) bind(c, name="strtod") result(number)
            !! C's reading of a double, correctly rounded by glibc.
            import :: c_char, c_double, c_ptr
            implicit none (type, external)
            ! allow(assumed-size): a C string
            character(kind=c_char), intent(in) :: text(*)
            type(c_ptr), value :: end
            real(c_double) :: number
        end function strtod
    end interface

contains

    pure function starts_number(text) result(yes)
        !! Does `text` begin like a number: a digit, a sign, or a point and a digit?
        character(*), intent(in) :: text  !! what follows, of any length
        logical :: yes

        yes = scan(character_at(text, 1), digits//"+-") == 1 .or. &
              (character_at(text, 1) == "." .and. scan(character_at(text, 2), digits) == 1)
    end function starts_number

    pure subroutine read_number(token, number, problem)
        !! The value of `token`; otherwise `problem` says what is wrong with it.
        character(*), intent(in) :: token                     !! without blanks
        real(dp), intent(out) :: number                       !! the nearest double
        character(:), allocatable, intent(out) :: problem     !! empty where there is none
        integer :: mantissa

        number = 0.0_dp
        call check_grammar(token, mantissa, problem)
        if (len(problem) > 0) return
        number = value_of(token)
        if (.not. ieee_is_finite(number)) then
            problem = "is too large for a double (at most 1.79769e308)"
        else if (is_zero(number) .and. scan(token(:mantissa), digits(2:)) > 0) then
            problem = "is too small for a double (at least 4.94066e-324, or 0)"
        end if
    end subroutine read_number

    pure subroutine to_integer(token, number, problem)
        !! The exact whole number that a valid number token means (`1e6` is one), or the
        !! `problem` with it. Decimal arithmetic: no double in between loses a digit.
        character(*), intent(in) :: token                     !! without blanks
        integer(i8), intent(out) :: number                    !! its value
        character(:), allocatable, intent(out) :: problem     !! empty where there is none
        real(dp), parameter :: most = 1.0e8_dp                !! of an exponent that is told apart
        integer :: first, i, last, mantissa, point, power
        integer(i8) :: digit

        number = 0_i8
        call check_grammar(token, mantissa, problem)
        if (len(problem) > 0) return
        first = scan(token(:mantissa), digits(2:))
        last = scan(token(:mantissa), digits(2:), back=.true.)
        if (first == 0) return
        point = index(token(:mantissa)//".", ".")
        power = int(max(-most, min(most, value_of(token(mantissa + 2:))))) + point - last
        if (last < point) power = power - 1
        if (power < 0) then
            problem = "is not a whole number"
            return
        end if
        do i = first, last + min(power, 20)
            if (i == point .and. i < last) cycle
            digit = 0_i8
            if (i <= last) digit = index(digits, token(i:i)) - 1
            if (number < (-huge(number) - 1_i8 + digit)/10_i8) then
                problem = "is too large for a 64-bit integer"
                return
            end if
            number = 10_i8*number - digit  ! negative: -2**63 has no opposite
        end do
        if (token(1:1) == "-") return
        if (number == -huge(number) - 1_i8) then
            problem = "is too large for a 64-bit integer"
        else
            number = -number
        end if
    end subroutine to_integer

    pure subroutine check_grammar(token, mantissa, problem)
        !! Find the end of the mantissa in `[sign] digits [. digits] [(e|d) [sign] digits]`, or say
        !! in `problem` why `token` is no such thing.
        character(*), intent(in) :: token
        integer, intent(out) :: mantissa
        character(:), allocatable, intent(out) :: problem
        character(*), parameter :: generic = &
            "is not a number; write it like 0.01, -2 or 1e-3, without a unit (a text needs quotes)"
        integer :: at, first

        mantissa = behind_mantissa(token, 1) - 1
        at = mantissa + 1
        problem = ""
        if (scan(token(:mantissa), digits) == 0) then
            problem = generic
            if (any(lower(token(at:min(at + 2, len(token)))) == ["inf", "nan"])) then
                problem = "is not finite; a finite number is needed"
            end if
            return
        else if (at > len(token)) then
            return
        end if
        select case (token(at:at))
        case ("e", "E", "d", "D")
            first = behind_sign(token, at + 1)
            if (after(token, first, digits) <= len(token)) then
                problem = generic
            else if (first > len(token)) then
                problem = "has an exponent without digits; write it like 1e-3"
            end if
        case ("+", "-")
            problem = "lacks the letter of its exponent (1.5e-3, not 1.5-3); sums are not computed"
        case (".")
            problem = "has two points; write one, and nothing between thousands"
        case ("_")
            problem = "has a kind suffix; write the number alone"
            if (verify(token(at + 1:), digits) == 0) problem = "holds '_'; write the digits alone"
        case default
            problem = generic
            if (index(lower(token(behind_sign(token, 1):)), "0x") == 1) then
                problem = "is not a decimal number; hexadecimal is not read here"
            end if
        end select
    end subroutine check_grammar

    pure function value_of(token) result(number)
        !! `strtod` with `e` for `d`, which leaves no trace of an overflow or underflow behind, and
        !! does not trap.
        character(*), intent(in) :: token
        real(dp) :: number
        character(len(token) + 1) :: c_text
        integer :: letter
        logical :: halts(2), raised(2)

        c_text = token//c_null_char
        letter = scan(token, "dD")
        if (letter > 0) c_text(letter:letter) = "e"
        call ieee_get_halting_mode([ieee_overflow, ieee_underflow], halts)
        call ieee_get_flag([ieee_overflow, ieee_underflow], raised)
        call ieee_set_halting_mode([ieee_overflow, ieee_underflow], .false.)
        number = real(strtod(c_text, c_null_ptr), dp)
        call ieee_set_flag([ieee_overflow, ieee_underflow], raised)
        call ieee_set_halting_mode([ieee_overflow, ieee_underflow], halts)
    end function value_of

    pure subroutine misread(text, phrase, problem, in_degrees)
        !! Says what a `phrase` at the start of `text` means and what to write, if it is a number in
        !! a spelling that is not read: factors (numbers, `pi`) with `*`, `/`, `^` or `**` between
        !! them, in degrees or radians, or with characters that only look plain.
        character(*), intent(in) :: text                      !! in UTF-8, of any length
        character(:), allocatable, intent(out) :: phrase      !! in plain characters
        character(:), allocatable, intent(out) :: problem     !! empty: a number, `3*0.5`, or none
        logical, intent(out), optional :: in_degrees          !! that is the problem
        character(:), allocatable :: odd, plain
        logical :: degrees
        real(dp) :: value
        integer :: last

        problem = ""
        plain = plainly(text)
        call evaluate(plain, value, degrees, last)
        if (present(in_degrees)) in_degrees = degrees .and. last > 0
        phrase = plain(:last)
        if (last == 0) return
        odd = ""
        if (phrase /= text(:min(last, len(text)))) odd = unlike(text)
        if (degrees) then
            problem = "no degrees are read; an angle is in radians"
        else if (odd /= "") then
            problem = odd
        else if (is_read(phrase)) then
            return
        else
            problem = "a number is needed, nothing is computed"
        end if
        if (ieee_is_finite(value)) problem = problem//trim(merge(",      ", "; write", degrees))// &
                                             " "//to_text(value)
    end subroutine misread

    pure function is_read(word) result(yes)
        !! A number, or a repeat count and a number.
        character(*), intent(in) :: word
        logical :: yes
        character(:), allocatable :: problem
        real(dp) :: number
        integer :: star

        star = index(word, "*")
        if (verify(word(:star - 1), digits) > 0) star = 0
        call read_number(word(star + 1:), number, problem)
        yes = len(problem) == 0
    end function is_read

    pure subroutine evaluate(text, value, degrees, last)
        !! The product at the start of `text`, up to a blank, a comma or the end of a group; `last`
        !! is 0 where there is none.
        character(*), intent(in) :: text
        real(dp), intent(out) :: value
        logical, intent(out) :: degrees  !! converted to radians
        integer, intent(out) :: last
        real(dp) :: factor
        character(1) :: operator
        integer :: at, behind, next

        degrees = .false.
        last = 0
        call take_power(text, 1, value, at)
        if (at == 0) return
        do
            next = after(text, at, blanks)
            operator = character_at(text, next)
            if (scan(operator, "*/") == 0) exit
            call take_power(text, after(text, next + 1, blanks), factor, behind)
            if (behind == 0) exit
            at = behind
            if (operator == "*") value = value*factor
            if (operator == "/") value = value/factor
        end do
        behind = after(text, next, letters)
        select case (lower(text(next:behind - 1)))
        case ("deg", "degs", "degree", "degrees")
            degrees = .true.
            value = value*pi/180.0_dp
            at = behind
        case ("rad", "rads", "radian", "radians")
            at = behind
        case default  ! no unit, or one that is not known
        end select
        if (scan(character_at(text, at), blanks//",/!") == 1) last = at - 1
    end subroutine evaluate

    pure subroutine take_power(text, start, value, behind)
        !! A factor, perhaps with `^` or `**` and its exponent, as `take_factor`.
        character(*), intent(in) :: text
        integer, intent(in) :: start
        real(dp), intent(out) :: value
        integer, intent(out) :: behind
        real(dp) :: exponent
        integer :: next

        call take_factor(text, start, value, behind)
        if (behind == 0) return
        next = after(text, behind, blanks)
        if (character_at(text, next) == "^") then
            next = next + 1
        else if (character_at(text, next)//character_at(text, next + 1) == "**") then
            next = next + 2
        else
            return
        end if
        call take_factor(text, after(text, next, blanks), exponent, next)
        if (next == 0) return
        value = sign(abs(value)**exponent, value)
        behind = next
    end subroutine take_power

    pure subroutine take_factor(text, start, value, behind)
        !! The number, or `pi`, or both, at `start`, and the position behind it; 0 where there is
        !! none.
        character(*), intent(in) :: text
        integer, intent(in) :: start
        real(dp), intent(out) :: value
        integer, intent(out) :: behind
        character(:), allocatable :: problem
        integer :: at, first, next

        value = 1.0_dp
        if (character_at(text, start) == "-") value = -1.0_dp
        next = behind_sign(text, start)
        at = behind_mantissa(text, start)
        if (.not. is_pi(text, next)) then
            if (scan(character_at(text, at), "eEdD") == 1) then
                first = behind_sign(text, at + 1)
                if (after(text, first, digits) > first) at = after(text, first, digits)
            end if
            behind = 0
            call read_number(text(start:at - 1), value, problem)
            if (len(problem) > 0) return
            behind = at
            next = after(text, at, blanks)
            if (.not. is_pi(text, next)) return
        end if
        value = value*pi
        behind = next + 2
    end subroutine take_factor

    pure function is_pi(text, position) result(yes)
        !! Is the word at `position` pi?
        character(*), intent(in) :: text
        integer, intent(in) :: position
        logical :: yes

        yes = lower(text(position:after(text, position, letters) - 1)) == "pi"
    end function is_pi

    pure function behind_mantissa(text, start) result(position)
        !! Behind `[sign] digits [. digits]`, any of which may be missing.
        character(*), intent(in) :: text
        integer, intent(in) :: start
        integer :: position

        position = after(text, behind_sign(text, start), digits)
        if (character_at(text, position) == ".") position = after(text, position + 1, digits)
    end function behind_mantissa

    pure function behind_sign(text, start) result(position)
        !! Behind the sign at `start`, if there is one.
        character(*), intent(in) :: text
        integer, intent(in) :: start
        integer :: position

        position = start
        if (scan(character_at(text, start), "+-") == 1) position = start + 1
    end function behind_sign

    pure function after(text, start, set) result(position)
        !! The first position from `start` on whose byte is not in `set`.
        character(*), intent(in) :: text  !! of any length
        integer, intent(in) :: start      !! from 1; behind the end, it is the result
        character(*), intent(in) :: set   !! the bytes to step over
        integer :: position

        position = verify(text(start:), set)
        if (position == 0) then
            position = max(start, len(text) + 1)
        else
            position = start + position - 1
        end if
    end function after

    pure function character_at(text, position) result(byte)
        !! The byte at `position`, a blank behind the end.
        character(*), intent(in) :: text  !! of any length
        integer, intent(in) :: position   !! from 1
        character(1) :: byte

        byte = " "
        if (position <= len(text)) byte = text(position:position)
    end function character_at
end module lagrangia_number_reader
