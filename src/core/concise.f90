module lagrangia_concise
    !! Numbers with their uncertainty in the concise form: `0.48312(2)` is 0.48312 give or take
    !! 0.00002. Source: JCGM 100:2008 (the GUM), sec. 7.2.2.
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero, is_zero
    use lagrangia_number_text, only: fixed
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: concise

    integer, parameter :: wide = 64

contains

    pure function concise(value, error) result(text)
        !! The digits of `value` that an error of `error` leaves: the error, and what the rounding
        !! of `value` to these digits adds, is rounded up to one digit, which stands in brackets
        !! and counts in units of the last digit before it. All digits where the error is 0. Both
        !! are finite.
        real(dp), intent(in) :: value, error
        !! a finite number, and how far it may be off, not negative
        character(:), allocatable :: text
        character(1) :: digit
        real(dp) :: doubt
        integer :: place, top, k

        text = to_text(value + 0.0_dp)  ! zero has no sign
        if (error <= 0.0_dp) return
        call round_up(error, digit, place)
        do k = 1, 3  ! a coarser digit may round the value more, twice at most
            doubt = error + abs(value - rounded(value, place))
            if (doubt <= (iachar(digit) - iachar("0"))*10.0_dp**place) exit
            if (doubt > huge(doubt)) exit  ! rounded up, the largest number is none
            call round_up(doubt, digit, place)
        end do
        top = place
        if (is_nonzero(value)) top = max(place, power_of(value, 6))
        if (place <= 0 .and. top >= -4 .and. top <= 6) then
            text = plain(value, -place)//"("//digit//")"
        else
            text = scientific(value, place, "("//digit//")")
        end if
    end function concise

    pure subroutine round_up(error, digit, place)
        !! The least `digit` times ten to `place` that is not less than `error`.
        real(dp), intent(in) :: error
        character(1), intent(out) :: digit
        integer, intent(out) :: place
        character(wide) :: buffer

        write (buffer, "(ss, es64.14e4)") error
        buffer = adjustl(buffer)
        digit = buffer(1:1)
        place = power_of(error, 14)
        if (verify(buffer(3:index(buffer, "E") - 1), "0") > 0) digit = achar(iachar(digit) + 1)
        if (digit <= "9") return
        digit = "1"
        place = place + 1
    end subroutine round_up

    pure function rounded(number, place)
        !! To a multiple of ten to `place`, as it is printed.
        real(dp), intent(in) :: number
        integer, intent(in) :: place
        real(dp) :: rounded
        character(wide) :: buffer, layout
        integer :: top

        rounded = number
        if (is_zero(number)) return
        top = power_of(number, 16)
        if (top < place) then
            rounded = nint(number/10.0_dp**place)*10.0_dp**place
            return
        end if
        write (layout, "(ss, a, i0, a)") "(ss, es64.", top - place, "e4)"
        write (buffer, layout) number
        read (buffer, *) rounded
    end function rounded

    pure function power_of(number, digits) result(power)
        !! Of ten, in `number` rounded to so many digits behind the first.
        real(dp), intent(in) :: number
        integer, intent(in) :: digits
        integer :: power
        character(wide) :: buffer, layout

        write (layout, "(ss, a, i0, a)") "(ss, es64.", digits, "e4)"
        write (buffer, layout) number
        read (buffer(index(buffer, "E") + 1:), *) power
    end function power_of

    pure function plain(value, digits) result(text)
        !! `fixed`, without a point at the end and without the sign of zero.
        real(dp), intent(in) :: value
        integer, intent(in) :: digits
        character(:), allocatable :: text

        text = fixed(value, digits)
        if (digits == 0) text = text(:len(text) - 1)
        if (verify(text, "-0.") == 0 .and. text(1:1) == "-") text = text(2:)
    end function plain

    pure function scientific(value, place, behind) result(text)
        !! `value` rounded to ten to `place`, with `behind` after its last digit and a power of ten.
        real(dp), intent(in) :: value
        integer, intent(in) :: place
        character(*), intent(in) :: behind
        character(:), allocatable :: text
        character(wide) :: buffer, layout
        integer :: top, digits

        top = place - 1
        if (is_nonzero(value)) top = power_of(value, 16)
        if (top < place) then
            text = to_text(nint(value/10.0_dp**place))//behind//"e"//to_text(place)
            return
        end if
        digits = top - place
        write (layout, "(ss, a, i0, a)") "(ss, es64.", digits, "e4)"
        write (buffer, layout) value
        text = trim(adjustl(buffer(:index(buffer, "E") - 1)))
        if (power_of(value, digits) > top) then  ! 9.96 became 10.0, and stands there as 1.0
            top = top + 1
            text = text//"0"
        else if (digits == 0) then
            text = text(:len(text) - 1)
        end if
        text = text//behind//"e"//to_text(top)
    end function scientific
end module lagrangia_concise
