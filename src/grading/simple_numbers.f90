module lagrangia_simple_numbers
    !! Numbers that a student may have forgotten, fractions of small numbers, perhaps with
    !! \(\pi\), and how they are written.
    use, intrinsic :: iso_fortran_env, only: int64
    use lagrangia_kinds, only: dp
    use lagrangia_number_text, only: rounded
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: is_simple, number_text, times

    real(dp), parameter :: equal = 1e-7_dp    !! relative difference of numbers that are one
    real(dp), parameter :: pi = acos(-1.0_dp)
    real(dp), parameter :: largest = 1e15_dp  !! of a fraction: beyond it all numbers are whole

contains

    pure function times(factor) result(text)
        !! `2 `, `-`, or nothing for 1.
        real(dp), intent(in) :: factor  !! before what it multiplies
        character(:), allocatable :: text

        text = number_text(factor)//" "
        if (abs(factor - 1.0_dp) < equal) text = ""
        if (abs(factor + 1.0_dp) < equal) text = "-"
    end function times

    pure function is_simple(value) result(yes)
        !! A fraction of small numbers, perhaps with \(\pi\): a number that a student may have
        !! forgotten. Any other is chance.
        real(dp), intent(in) :: value  !! any
        logical :: yes

        yes = is_fraction(value) .or. is_fraction(value/pi) .or. is_fraction(value*pi) .or. &
              is_fraction(value/pi**2)
    end function is_simple

    pure function is_fraction(value) result(yes)
        !! Up to 144, with a small denominator; not 0.
        real(dp), intent(in) :: value
        logical :: yes

        yes = abs(value) > equal .and. abs(value) <= 144.0_dp .and. denominator_of(value) > 0
    end function is_fraction

    pure function denominator_of(value) result(denominator)
        !! The least one up to 12 with which it is a fraction; 0: it is none.
        real(dp), intent(in) :: value
        integer :: denominator

        denominator = 0
        if (abs(value) > largest) return
        do denominator = 1, 12
            if (abs(value*denominator - anint(value*denominator)) <= &
                equal*denominator*min(1.0_dp, abs(value))) return
        end do
        denominator = 0
    end function denominator_of

    pure recursive function number_text(value) result(text)
        !! A fraction of small numbers, perhaps with \(\pi\), or three decimals or digits.
        real(dp), intent(in) :: value  !! finite
        character(:), allocatable :: text
        integer :: denominator

        denominator = denominator_of(value)
        if (denominator > 0) then
            text = to_text(nint(value*denominator, int64))
            if (denominator > 1) text = text//"/"//to_text(denominator)
        else if (is_fraction(value/pi)) then
            text = number_text(value/pi)//" pi"
        else if (is_fraction(value*pi)) then
            text = number_text(value*pi)//"/pi"
        else if (is_fraction(value/pi**2)) then
            text = number_text(value/pi**2)//" pi^2"
        else
            text = to_text(anint(1000.0_dp*value)/1000.0_dp)
            if (abs(value) < 0.1_dp) text = rounded(value, 3)
        end if
        if (index(text, "1 pi") == 1) text = text(3:)
        if (index(text, "-1 pi") == 1) text = "-"//text(4:)
    end function number_text
end module lagrangia_simple_numbers
