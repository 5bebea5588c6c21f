module lagrangia_namelist_words
    !! What a bare word of a namelist says, or what it was meant to say: `.true.`, and the number
    !! behind `pi/4`, `45 deg` or `10^-3`, which is not read but told.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_characters, only: plainly, unlike
    use lagrangia_kinds, only: dp
    use lagrangia_number_reader, only: read_number
    use lagrangia_text, only: lower, to_text
    implicit none (type, external)
    private
    public :: misread, stray, truth_of

    real(dp), parameter :: pi = acos(-1.0_dp)
    character(*), parameter :: digits = "0123456789"
    character(*), parameter :: stray = &
        "'=' stands behind a key, quotes around a text, '!' before a comment"
    character(*), parameter :: blanks = " "//achar(9)

contains

    pure function truth_of(word) result(truth)
        !! 1 for `.true.`, `.t.`, `true` or `t`, 0 for their opposites, whatever the case; else -1.
        character(*), intent(in) :: word
        integer :: truth

        select case (lower(word))
        case (".true.", ".t.", ".t", "true", "t")
            truth = 1
        case (".false.", ".f.", ".f", "false", "f")
            truth = 0
        case default
            truth = -1
        end select
    end function truth_of

    pure subroutine misread(text, phrase, problem)
        !! Says what a `phrase` at the start of `text` means and what to write, if it is a number in
        !! a spelling that is not read: factors (numbers, `pi`) with `*`, `/`, `^` or `**` between
        !! them, in degrees or radians, or with characters that only look plain. Otherwise empty:
        !! for a plain number and for `3*0.5`, which repeats.
        character(*), intent(in) :: text
        character(:), allocatable, intent(out) :: phrase, problem
        character(:), allocatable :: odd, plain
        logical :: degrees
        real(dp) :: value
        integer :: last

        problem = ""
        plain = plainly(text)
        call evaluate(plain, value, degrees, last)
        phrase = plain(:last)
        if (last == 0) return
        odd = ""
        if (phrase /= text(:min(last, len(text)))) odd = unlike(text)
        if (degrees) then
            problem = "angles are in radians"
        else if (odd /= "") then
            problem = odd
        else if (is_read(phrase)) then
            return
        else
            problem = "a number is needed, nothing is computed"
        end if
        if (ieee_is_finite(value)) problem = problem//"; write "//to_text(value)
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
        character(:), allocatable :: unit
        real(dp) :: factor
        character(1) :: operator
        integer :: at, behind, next

        degrees = .false.
        last = 0
        call take_power(text, 1, value, at)
        if (at == 0) return
        do
            next = at + skipped(text(at:))
            operator = character_at(text, next)
            if (scan(operator, "*/") == 0) exit
            next = next + 1
            call take_power(text, next + skipped(text(next:)), factor, behind)
            if (behind == 0) exit
            at = behind
            if (operator == "*") value = value*factor
            if (operator == "/") value = value/factor
        end do
        next = at + skipped(text(at:))
        unit = lower(text(next:letters_end(text, next)))
        select case (unit)
        case ("deg", "degs", "degree", "degrees")
            degrees = .true.
            value = value*pi/180.0_dp
            at = next + len(unit)
        case ("rad", "rads", "radian", "radians")
            at = next + len(unit)
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
        next = behind + skipped(text(behind:))
        if (character_at(text, next) == "^") then
            next = next + 1
        else if (character_at(text, next)//character_at(text, next + 1) == "**") then
            next = next + 2
        else
            return
        end if
        call take_factor(text, next + skipped(text(next:)), exponent, next)
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
        integer :: at, exponent, next

        value = 0.0_dp
        behind = 0
        at = start
        if (scan(character_at(text, at), "+-") == 1) at = at + 1
        if (lower(text(at:letters_end(text, at))) == "pi") then
            value = pi
            if (text(start:start) == "-") value = -pi
            behind = at + 2
            return
        end if
        at = after_digits(text, at)
        if (character_at(text, at) == ".") at = after_digits(text, at + 1)
        if (scan(character_at(text, at), "eEdD") == 1) then
            exponent = at + 1
            if (scan(character_at(text, exponent), "+-") == 1) exponent = exponent + 1
            if (after_digits(text, exponent) > exponent) at = after_digits(text, exponent)
        end if
        call read_number(text(start:at - 1), value, problem)
        if (len(problem) > 0) return
        behind = at
        next = at + skipped(text(at:))
        if (lower(text(next:letters_end(text, next))) /= "pi") return
        value = value*pi
        behind = next + 2
    end subroutine take_factor

    pure function skipped(text) result(length)
        !! How many blanks there are at the start.
        character(*), intent(in) :: text
        integer :: length

        length = verify(text//".", blanks) - 1
    end function skipped

    pure function letters_end(text, start) result(last)
        !! The last of the letters from `start` on; before it where there are none.
        character(*), intent(in) :: text
        integer, intent(in) :: start
        integer :: last

        last = start - 2 + verify(lower(text(start:))//".", "abcdefghijklmnopqrstuvwxyz")
    end function letters_end

    pure function after_digits(text, start) result(position)
        !! The first position from `start` on which is no digit.
        character(*), intent(in) :: text
        integer, intent(in) :: start
        integer :: position

        position = start - 1 + verify(text(start:)//".", digits)
    end function after_digits

    pure function character_at(text, position) result(letter)
        !! The byte at `position`, a blank behind the end.
        character(*), intent(in) :: text
        integer, intent(in) :: position
        character(1) :: letter

        letter = " "
        if (position <= len(text)) letter = text(position:position)
    end function character_at
end module lagrangia_namelist_words
