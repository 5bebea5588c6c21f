module test_decimal
    !! Our own digits of a double are those of libgfortran, byte for byte.
    use, intrinsic :: ieee_arithmetic, only: ieee_negative_inf, ieee_positive_inf, ieee_quiet_nan, &
                                             ieee_value
    use, intrinsic :: iso_fortran_env, only: int64, real64
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual
    use lagrangia_decimal, only: decimal_width, write_decimal
    implicit none (type, external)
    private
    public :: decimal_suite

contains

    function decimal_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("decimal")
        call suite%addTest(TestMethod("every_exponent", every_exponent))
        call suite%addTest(TestMethod("powers_of_ten_and_their_neighbours", powers_of_ten))
        call suite%addTest(TestMethod("ties_and_short_decimals", ties_and_short_decimals))
        call suite%addTest(TestMethod("no_numbers_and_zeros", no_numbers_and_zeros))
    end function decimal_suite

    subroutine compare(x)
        !! This number, and its negative.
        real(real64), intent(in) :: x
        character(decimal_width) :: ours, theirs
        integer :: i

        do i = 0, 1
            call write_decimal((-1)**i*x, ours)
            write (theirs, "(ss, es24.16e3)") (-1)**i*x
            if (ours /= theirs) call assertEqual(theirs, ours)
        end do
    end subroutine compare

    pure subroutine draw(state)
        !! The next of Marsaglia's xorshift.
        integer(int64), intent(inout) :: state

        state = ieor(state, shiftl(state, 13))
        state = ieor(state, shiftr(state, 7))
        state = ieor(state, shiftl(state, 17))
    end subroutine draw

    subroutine every_exponent()
        !! Twenty significands each, and the ends of the binade; 0 is that of the subnormals.
        integer(int64) :: exponent, state
        integer :: k

        state = 88172645463325252_int64
        do exponent = 0, 2046
            do k = 1, 20
                call draw(state)
                call compare(transfer(ior(ibits(state, 0, 52), shiftl(exponent, 52)), 0.0_real64))
                if (exponent == 0) call compare(transfer(ibits(state, 0, 2*k), 0.0_real64))
            end do
            call compare(transfer(shiftl(exponent, 52), 0.0_real64))
            call compare(transfer(ior(shiftl(exponent, 52), 2_int64**52 - 1), 0.0_real64))
            if (anyExceptions()) return
        end do
    end subroutine every_exponent

    subroutine powers_of_ten()
        !! 1, 2, 5 and 9.9999... times every power of ten, with the doubles next to them.
        character(*), parameter :: front(4) = [character(20) :: "1", "2", "5", "9.9999999999999995"]
        character(32) :: text
        real(real64) :: x
        integer :: failure, i, k

        do k = -323, 308
            do i = 1, size(front)
                write (text, "(a, a, i0)") trim(front(i)), "e", k
                read (text, *, iostat=failure) x
                if (failure /= 0 .or. .not. abs(x) <= huge(x)) cycle
                call compare(x)
                call compare(nearest(x, 1.0_real64))
                call compare(nearest(x, -1.0_real64))
            end do
            if (anyExceptions()) return
        end do
    end subroutine powers_of_ten

    subroutine ties_and_short_decimals()
        !! Numbers half-way between two of 17 digits: odd multiples of 5 beyond 10^17, and odd
        !! numbers times a power of 1/2; whole numbers, and decimals as a student types them.
        integer(int64) :: state
        integer :: i

        state = 88172645463325252_int64
        do i = 1, 20000
            call draw(state)
            call compare(real(10_int64**17 + 5 + 10*ibits(state, 20, 44), real64))
            call compare(real(ior(ibits(state, 0, 53), 1_int64), real64)*0.5_real64**mod(i, 12))
            call compare(real(i, real64))
            call compare(real(i, real64)/1000.0_real64)
            if (anyExceptions()) return
        end do
    end subroutine ties_and_short_decimals

    subroutine no_numbers_and_zeros()
        !! What is no number is written as libgfortran does it; a zero keeps its sign.
        character(decimal_width) :: text

        call compare(0.0_real64)
        call write_decimal(-0.0_real64, text)
        call assertEqual("-0.0000000000000000E+000", text)
        call compare(ieee_value(0.0_real64, ieee_positive_inf))
        call compare(ieee_value(0.0_real64, ieee_negative_inf))
        call compare(ieee_value(0.0_real64, ieee_quiet_nan))
        call compare(huge(0.0_real64))
        call compare(tiny(0.0_real64))
    end subroutine no_numbers_and_zeros
end module test_decimal
