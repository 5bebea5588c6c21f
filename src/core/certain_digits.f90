module lagrangia_certain_digits
    !! Numbers for the eye: twelve digits, or as many as rounding has left.
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_zero
    use lagrangia_number_text, only: fixed, scientific
    implicit none (type, external)
    private
    public :: certain, certain_scientific, number, share_of
    public :: share_of_last

    real(dp), parameter :: share_of_last = 5e-12_dp
    !! half of the last digit that `number` may print, of the smallest number of that many digits

contains

    pure function certain(value, share) result(text)
        !! As many of its digits as there are.
        real(dp), intent(in) :: value  !! any finite one
        real(dp), intent(in) :: share  !! of it that rounding may have changed
        character(:), allocatable :: text
        integer :: decimals

        text = trim(number(value))
        if (is_zero(value)) return
        decimals = digits_of(share) - 1 - floor(log10(abs(value)))
        if (is_handy(value) .and. decimals >= 0 .and. share < 0.5_dp) then
            text = fixed(value, min(decimals, 11))
        else if (share > share_of_last) then
            text = certain_scientific(value, share, 12)
        end if
    end function certain

    pure function certain_scientific(value, share, digits) result(text)
        !! `1.2E-09`, or `rounding` where it is nothing else.
        real(dp), intent(in) :: value   !! any finite one
        real(dp), intent(in) :: share   !! of it that rounding may have changed
        integer, intent(in) :: digits   !! significant ones at most, 1 to 17
        character(:), allocatable :: text

        text = "rounding"
        if (is_zero(value)) then
            text = scientific(value, digits)
        else if (share < 0.5_dp) then
            text = scientific(value, min(digits, digits_of(share)))
        end if
    end function certain_scientific

    pure function share_of(value, delta) result(share)
        !! Of a number that may be off by \(\delta\); of 0 more than all.
        real(dp), intent(in) :: value  !! any finite one
        real(dp), intent(in) :: delta  !! not negative
        real(dp) :: share

        share = delta/max(abs(value), tiny(value))
    end function share_of

    pure function digits_of(share) result(digits)
        !! That are left, 1 to 17.
        real(dp), intent(in) :: share
        integer :: digits

        digits = max(1, floor(-log10(max(share, 1e-17_dp))))
    end function digits_of

    pure function is_handy(value) result(yes)
        !! Whether it needs no exponent.
        real(dp), intent(in) :: value
        logical :: yes

        yes = abs(value) >= 1e-3_dp .and. abs(value) < 1e5_dp
    end function is_handy

    pure function number(value) result(text)
        !! Twelve digits, left-justified in 18.
        real(dp), intent(in) :: value  !! any finite one
        character(18) :: text

        text = "0"
        if (is_zero(value)) return
        if (is_handy(value)) then
            write (text, "(ss, f18.11)") value
        else
            write (text, "(ss, es18.10e3)") value  ! as wide as the longest
        end if
        text = adjustl(text)
    end function number
end module lagrangia_certain_digits
