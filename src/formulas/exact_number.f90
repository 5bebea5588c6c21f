module lagrangia_exact_number
    !! The numbers in a formula: fractions of whole numbers as long as these are below \(2^{53}\),
    !! and doubles beyond that, so that 1/3 + 1/6 is 1/2 and nothing overflows.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_kinds, only: dp, i8
    implicit none (type, external)
    private
    public :: number_t
    public :: common_measure, number_of, ratio, power
    public :: operator(+), operator(-), operator(*), operator(/), operator(==)

    type :: number_t
        !! A fraction in lowest terms, its denominator positive; or, with the denominator 0, a real.
        integer(i8) :: numerator = 0_i8
        integer(i8) :: denominator = 1_i8
        real(dp) :: value = 0.0_dp  !! correctly rounded
    contains
        procedure :: is_exact
        procedure :: is_whole
        procedure :: is_zero
    end type number_t

    interface operator(+)
        module procedure add
    end interface operator(+)

    interface operator(-)
        module procedure subtract, opposite
    end interface operator(-)

    interface operator(*)
        module procedure multiply
    end interface operator(*)

    interface operator(/)
        module procedure divide
    end interface operator(/)

    interface operator(==)
        module procedure equal
    end interface operator(==)

    integer(i8), parameter :: limit = 2_i8**53  !! doubles hold every whole number up to here
    integer(i8), parameter :: safe = 2_i8**62

contains

    elemental function is_exact(self) result(yes)
        !! Is it a fraction?
        class(number_t), intent(in) :: self
        logical :: yes

        yes = self%denominator /= 0_i8
    end function is_exact

    elemental function is_whole(self) result(yes)
        !! Is it a whole number?
        class(number_t), intent(in) :: self
        logical :: yes

        yes = self%denominator == 1_i8
    end function is_whole

    elemental function is_zero(self) result(yes)
        !! Is it 0, a fraction or a real?
        class(number_t), intent(in) :: self
        logical :: yes

        yes = abs(self%value) <= 0.0_dp
    end function is_zero

    elemental function ratio(numerator, denominator) result(number)
        !! \(p/q\) in lowest terms; a real if a term is not below \(2^{53}\).
        integer(i8), intent(in) :: numerator    !! \(p\), at most \(2^{62}\) in size
        integer(i8), intent(in) :: denominator  !! \(q\), the same, not 0
        type(number_t) :: number
        integer(i8) :: divisor

        divisor = sign(greatest_common_divisor(numerator, denominator), denominator)
        number%numerator = numerator/divisor
        number%denominator = denominator/divisor
        number%value = real(number%numerator, dp)/real(number%denominator, dp)
        if (max(abs(number%numerator), number%denominator) >= limit) number%denominator = 0_i8
    end function ratio

    elemental function number_of(value) result(number)
        !! A double: a whole number if it is one below \(2^{53}\), else a real.
        real(dp), intent(in) :: value  !! any finite number
        type(number_t) :: number

        number = number_t(0_i8, 0_i8, value)
        if (abs(value) >= real(limit, dp) .or. .not. ieee_is_finite(value)) return
        if (abs(value - aint(value)) > 0.0_dp) return
        number = number_t(int(value, i8), 1_i8, value)
    end function number_of

    elemental function add(a, b) result(c)
        type(number_t), intent(in) :: a, b
        type(number_t) :: c

        if (fits(a%numerator, b%denominator) .and. fits(b%numerator, a%denominator) &
            .and. fits(a%denominator, b%denominator) .and. a%is_exact() .and. b%is_exact()) then
            c = ratio(a%numerator*b%denominator + b%numerator*a%denominator, &
                         a%denominator*b%denominator)
        else
            c = number_of(a%value + b%value)
        end if
    end function add

    elemental function opposite(a) result(c)
        type(number_t), intent(in) :: a
        type(number_t) :: c

        c = number_t(-a%numerator, a%denominator, -a%value)
        if (a%numerator == 0_i8 .and. a%is_exact()) c = a  ! zero has no sign
    end function opposite

    elemental function subtract(a, b) result(c)
        type(number_t), intent(in) :: a, b
        type(number_t) :: c

        c = a + (-b)
    end function subtract

    elemental function multiply(a, b) result(c)
        type(number_t), intent(in) :: a, b
        type(number_t) :: c

        if (fits(a%numerator, b%numerator) .and. fits(a%denominator, b%denominator) &
            .and. a%is_exact() .and. b%is_exact()) then
            c = ratio(a%numerator*b%numerator, a%denominator*b%denominator)
        else
            c = number_of(a%value*b%value)
        end if
    end function multiply

    elemental function divide(a, b) result(c)
        !! By what is not 0.
        type(number_t), intent(in) :: a, b
        type(number_t) :: c

        if (fits(a%numerator, b%denominator) .and. fits(a%denominator, b%numerator) &
            .and. a%is_exact() .and. b%is_exact()) then
            c = ratio(a%numerator*b%denominator, a%denominator*b%numerator)
        else
            c = number_of(a%value/b%value)
        end if
    end function divide

    elemental function power(a, n) result(c)
        !! \(a^n\).
        type(number_t), intent(in) :: a  !! not 0 where \(n < 0\)
        integer, intent(in) :: n         !! at most 1000 in size
        type(number_t) :: c
        integer :: k

        c = ratio(1_i8, 1_i8)
        do k = 1, abs(n)
            c = c*a
        end do
        if (n < 0) c = ratio(1_i8, 1_i8)/c
        if (.not. c%is_exact()) c = number_of(a%value**n)
    end function power

    elemental function equal(a, b) result(yes)
        !! Fractions exactly, reals bit for bit.
        type(number_t), intent(in) :: a, b
        logical :: yes

        if (a%is_exact() .and. b%is_exact()) then
            yes = a%numerator == b%numerator .and. a%denominator == b%denominator
        else
            yes = (a%is_exact() .eqv. b%is_exact()) .and. abs(a%value - b%value) <= 0.0_dp
        end if
    end function equal

    pure function common_measure(numbers) result(measure)
        !! The largest fraction of which all are whole multiples; 1 where one of them is no
        !! fraction, or a denominator of over 10^9 would be needed.
        type(number_t), intent(in) :: numbers(:)  !! not 0
        type(number_t) :: measure                 !! positive
        integer(i8), parameter :: largest = 10_i8**9
        integer(i8) :: above, below
        integer :: i

        measure = ratio(1_i8, 1_i8)
        above = 0_i8
        below = 1_i8
        do i = 1, size(numbers)
            if (.not. numbers(i)%is_exact()) return
            if (max(below, numbers(i)%denominator) > largest) return
            above = greatest_common_divisor(above, numbers(i)%numerator)
            below = below/greatest_common_divisor(below, numbers(i)%denominator) &
                    *numbers(i)%denominator
        end do
        measure = ratio(above, below)
    end function common_measure

    elemental function fits(a, b) result(yes)
        !! Can \(ab\) be half of a sum in 64 bits?
        integer(i8), intent(in) :: a, b
        logical :: yes

        yes = abs(real(a, dp))*abs(real(b, dp)) < 0.499_dp*real(safe, dp)
    end function fits

    elemental function greatest_common_divisor(a, b) result(divisor)
        !! Euclid's; positive.
        integer(i8), intent(in) :: a, b
        integer(i8) :: divisor, other, rest

        divisor = abs(a)
        other = abs(b)
        do while (other /= 0_i8)
            rest = mod(divisor, other)
            divisor = other
            other = rest
        end do
    end function greatest_common_divisor
end module lagrangia_exact_number
