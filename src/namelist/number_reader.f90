module lagrangia_number_reader
    !! The one strict grammar of a number that a user writes, in a scene or on the command line,
    !! and its correctly rounded value. (Fortran's `read` takes 1-3 for 1e-3.)
    use, intrinsic :: ieee_arithmetic, only: ieee_get_flag, ieee_get_halting_mode, &
                                             ieee_is_finite, ieee_overflow, ieee_set_flag, &
                                             ieee_set_halting_mode, ieee_underflow
    use, intrinsic :: iso_c_binding, only: c_char, c_double, c_null_char, c_null_ptr, c_ptr
    use lagrangia_kinds, only: dp, i8
    use lagrangia_text, only: lower
    implicit none (type, external)
    private
    public :: read_number, starts_number, to_integer

    character(*), parameter :: digits = "0123456789"

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

    type :: parts_t
        !! `[sign] digits [. digits] [exponent]` of a token, by position; empty parts end before
        !! they start.
        integer :: whole(2) = [1, 0]
        integer :: fraction(2) = [1, 0]
        integer :: exponent(2) = [1, 0]  !! with its sign, without its letter
    end type parts_t

contains

    pure function starts_number(text) result(yes)
        !! Does `text` begin like a number: a digit, a sign, or a point and a digit?
        character(*), intent(in) :: text
        logical :: yes

        yes = .false.
        if (len(text) == 0) return
        yes = scan(text(1:1), digits//"+-") > 0
        if (text(1:1) == "." .and. len(text) > 1) yes = scan(text(2:2), digits) > 0
    end function starts_number

    pure subroutine read_number(token, number, problem)
        !! The value of `token`; otherwise `problem` says what is wrong with it.
        character(*), intent(in) :: token
        real(dp), intent(out) :: number
        character(:), allocatable, intent(out) :: problem
        type(parts_t) :: parts

        number = 0.0_dp
        call split(token, parts, problem)
        if (len(problem) > 0) return
        number = quiet_strtod(with_letter_e(token))
        if (.not. ieee_is_finite(number)) then
            problem = "is too large for a double (at most 1.79769e308)"
        else if (abs(number) <= 0.0_dp .and. any_digit_but_zero(token, parts)) then
            problem = "is too small for a double (at least 4.94066e-324, or 0)"
        end if
    end subroutine read_number

    pure function quiet_strtod(c_text) result(number)
        !! `strtod` that leaves no trace of an overflow or underflow behind, and does not trap.
        character(*), intent(in) :: c_text
        real(dp) :: number
        logical :: halts(2), raised(2)

        call ieee_get_halting_mode([ieee_overflow, ieee_underflow], halts)
        call ieee_get_flag([ieee_overflow, ieee_underflow], raised)
        call ieee_set_halting_mode([ieee_overflow, ieee_underflow], .false.)
        number = real(strtod(c_text, c_null_ptr), dp)
        call ieee_set_flag([ieee_overflow, ieee_underflow], raised)
        call ieee_set_halting_mode([ieee_overflow, ieee_underflow], halts)
    end function quiet_strtod

    pure function with_letter_e(token) result(c_text)
        !! `token` as C reads it: `e` for `d`, and a final NUL.
        character(*), intent(in) :: token
        character(len(token) + 1) :: c_text
        integer :: letter

        c_text = token//c_null_char
        letter = scan(token, "dD")
        if (letter > 0) c_text(letter:letter) = "e"
    end function with_letter_e

    pure function any_digit_but_zero(token, parts) result(yes)
        !! Is the number not zero, whatever its exponent?
        character(*), intent(in) :: token
        type(parts_t), intent(in) :: parts
        logical :: yes

        yes = verify(token(parts%whole(1):parts%whole(2)), "0") > 0 .or. &
              verify(token(parts%fraction(1):parts%fraction(2)), "0") > 0
    end function any_digit_but_zero

    pure subroutine split(token, parts, problem)
        !! Find the parts of a number, or say in `problem` why `token` is none.
        character(*), intent(in) :: token
        type(parts_t), intent(out) :: parts
        character(:), allocatable, intent(out) :: problem
        character(*), parameter :: generic = &
            "is not a number; write it like 0.01, -2 or 1e-3, without a unit (a text needs quotes)"
        integer :: at

        at = 1
        if (at <= len(token)) at = at + merge(1, 0, scan(token(1:1), "+-") == 1)
        parts%whole = [at, after_digits(token, at) - 1]
        at = parts%whole(2) + 1
        parts%fraction = [at, at - 1]
        if (character_at(token, at) == ".") then
            parts%fraction = [at + 1, after_digits(token, at + 1) - 1]
            at = parts%fraction(2) + 1
        end if
        parts%exponent = [at, at - 1]
        problem = ""
        if (parts%whole(1) > parts%whole(2) .and. parts%fraction(1) > parts%fraction(2)) then
            problem = generic
            if (any(lower(token(at:min(at + 2, len(token)))) == ["inf", "nan"])) then
                problem = "is not finite; a finite number is needed"
            end if
        else if (at > len(token)) then
            return
        else if (scan(token(at:at), "eEdD") == 1) then
            at = at + 1
            parts%exponent(1) = at
            at = at + merge(1, 0, scan(character_at(token, at), "+-") == 1)
            parts%exponent(2) = after_digits(token, at) - 1
            if (after_digits(token, at) <= len(token)) then
                problem = generic
            else if (parts%exponent(2) < at) then
                problem = "has an exponent without digits; write it like 1e-3"
            end if
        else if (scan(token(at:at), "+-") == 1) then
            problem = "lacks the letter of its exponent (1.5e-3, not 1.5-3); sums are not computed"
        else if (token(at:at) == "_") then
            problem = "has a kind suffix; write the number alone"
            if (verify(token(at + 1:), digits) == 0) problem = "holds '_'; write the digits alone"
        else if (scan(token(at:at), "xX") == 1) then
            problem = "is not a decimal number; hexadecimal is not read here"
        else
            problem = generic
        end if
    end subroutine split

    pure function character_at(token, position) result(letter)
        !! The byte at `position`, a blank behind the end.
        character(*), intent(in) :: token
        integer, intent(in) :: position
        character(1) :: letter

        letter = " "
        if (position <= len(token)) letter = token(position:position)
    end function character_at

    pure function after_digits(token, start) result(position)
        !! The first position from `start` on which is no digit.
        character(*), intent(in) :: token
        integer, intent(in) :: start
        integer :: position

        position = verify(token(start:), digits)
        if (position == 0) then
            position = max(start, len(token) + 1)
        else
            position = start + position - 1
        end if
    end function after_digits

    pure subroutine to_integer(token, number, problem)
        !! The exact whole number that a valid number token means (`1e6` is one), or the
        !! `problem` with it. Decimal arithmetic: no double in between loses a digit.
        character(*), intent(in) :: token
        integer(i8), intent(out) :: number
        character(:), allocatable, intent(out) :: problem
        character(:), allocatable :: figures
        type(parts_t) :: parts
        integer :: first, i, last, power
        integer(i8) :: digit

        number = 0_i8
        call split(token, parts, problem)
        if (len(problem) > 0) return
        figures = token(parts%whole(1):parts%whole(2))// &
                  token(parts%fraction(1):parts%fraction(2))
        first = verify(figures, "0")
        if (first == 0) return
        last = verify(figures, "0", back=.true.)
        power = exponent_of(token(parts%exponent(1):parts%exponent(2))) + len(figures) - last &
                - (parts%fraction(2) - parts%fraction(1) + 1)
        if (power < 0) then
            problem = "is not a whole number"
            return
        end if
        do i = first, last + min(power, 20)
            digit = 0_i8
            if (i <= last) digit = index(digits, figures(i:i)) - 1
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

    pure function exponent_of(text) result(exponent)
        !! The whole number in `text` (0 when empty), held within 10**8.
        character(*), intent(in) :: text
        integer :: exponent
        integer :: i

        exponent = 0
        do i = 1, len(text)
            if (scan(text(i:i), digits) == 1) then
                exponent = min(100000000, 10*exponent + index(digits, text(i:i)) - 1)
            end if
        end do
        if (index(text, "-") > 0) exponent = -exponent
    end function exponent_of
end module lagrangia_number_reader
