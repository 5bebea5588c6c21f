module test_number_text
    !! The fast text of a number is libgfortran's, digit for digit.
    use, intrinsic :: ieee_arithmetic, only: ieee_negative_inf, ieee_positive_inf, &
        ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_kinds, only: dp, i8
    use lagrangia_number_text, only: field_width, number_text, write_csv_row, write_number, &
        write_row
    use lagrangia_powers_of_ten, only: coarse, coarse_exponent, fine, fine_exponent, limb, step
    implicit none (type, external)
    private
    public :: number_text_suite

    integer, parameter :: base = 30    !! bits in a limb of the long integers used here
    integer, parameter :: limbs = 60   !! enough for 10**336 and for 2**1260

contains

    function number_text_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("number_text")
        call suite%addTest(TestMethod("every_exponent_is_right", every_exponent_is_right))
        call suite%addTest(TestMethod("neighbours_of_powers_of_ten_are_right", &
                                      neighbours_of_powers_of_ten_are_right))
        call suite%addTest(TestMethod("ties_are_rounded_to_even", ties_are_rounded_to_even))
        call suite%addTest(TestMethod("the_hardest_cases_are_right", the_hardest_cases_are_right))
        call suite%addTest(TestMethod("the_odd_ones_are_right", the_odd_ones_are_right))
        call suite%addTest(TestMethod("the_powers_of_ten_are_exact", the_powers_of_ten_are_exact))
        call suite%addTest(TestMethod("a_row_is_what_write_gives", a_row_is_what_write_gives))
        call suite%addTest(TestMethod("a_csv_row_has_commas", a_csv_row_has_commas))
        call suite%addTest(TestMethod("number_text_has_no_blanks", number_text_has_no_blanks))
    end function number_text_suite

    subroutine compare(x)
        !! Assert that `x` and `-x` are written as libgfortran does.
        real(dp), intent(in) :: x
        character(field_width) :: fast, slow
        integer :: sign

        do sign = -1, 1, 2
            call write_number(sign*x, fast)
            write (slow, "(es24.16e3)") sign*x
            if (fast /= slow) call assertEqual(slow, fast)
        end do
    end subroutine compare

    subroutine every_exponent_is_right()
        !! Forty significands for every exponent of a double, denormals included.
        integer(i8) :: bits, state
        integer :: exponent, k

        state = 88172645463325252_i8
        do exponent = 0, 2046
            do k = 1, 40
                state = ieor(state, shiftl(state, 13))  ! Marsaglia's xorshift
                state = ieor(state, shiftr(state, 7))
                state = ieor(state, shiftl(state, 17))
                bits = ibits(state, 0, 52)
                if (k < 20) bits = ibits(state, 0, 2*k)  ! and small denormals
                if (k == 21) bits = 0
                if (k == 22) bits = shiftl(1_i8, 52) - 1
                call mvbits(int(exponent, i8), 0, 11, bits, 52)
                call compare(transfer(bits, 1.0_dp))
                if (anyExceptions()) return
            end do
        end do
    end subroutine every_exponent_is_right

    subroutine neighbours_of_powers_of_ten_are_right()
        !! Where the number of digits before the point changes.
        character(10) :: text
        real(dp) :: x
        integer :: k, n

        do k = -323, 307
            do n = 1, 9, 4
                write (text, "(i0, a, i0)") n, "e", k
                read (text, *) x
                call compare(x)
                call compare(nearest(x, 1.0_dp))
                call compare(nearest(x, -1.0_dp))
                if (anyExceptions()) return
            end do
        end do
    end subroutine neighbours_of_powers_of_ten_are_right

    subroutine ties_are_rounded_to_even()
        !! Doubles with 18 digits of which the last is 5: odd/2**k with 10**17 < odd*5**k < 10**18.
        integer(i8) :: odd
        integer :: k, n
        character(field_width) :: text

        do k = 1, 24
            odd = int(1e17_dp/5.0_dp**k, i8) + 1
            if (odd > 2_i8**53 .or. odd < 1) cycle
            odd = ior(odd, 1_i8)
            do n = 1, 20
                call compare(real(odd, dp)/2.0_dp**k)
                odd = odd + 2
            end do
        end do
        call write_number(real(131073_i8, dp)/2.0_dp**17, text)  ! 1.00000762939453125 exactly
        call assertEqual(" 1.0000076293945312E+000", text)
        call write_number(real(131075_i8, dp)/2.0_dp**17, text)  ! 1.00002288818359375 exactly
        call assertEqual(" 1.0000228881835938E+000", text)
    end subroutine ties_are_rounded_to_even

    subroutine the_hardest_cases_are_right()
        !! Doubles within \(10^{-13}\) to \(10^{-20}\) of a tie in their last digit, of both signs;
        !! found with continued fractions, their digits with rational arithmetic.
        call expect(1.3076622631878654e65_dp, "1.3076622631878654E+065")
        call expect(1.3588129002659584e-245_dp, "1.3588129002659584E-245")
        call expect(1.234550136632744e-99_dp, "1.2345501366327440E-099")
        call expect(2.711176770832212e161_dp, "2.7111767708322121E+161")
        call expect(5.0911336906666915e-290_dp, "5.0911336906666915E-290")
        call expect(7.423765488072328e253_dp, "7.4237654880723281E+253")
        call expect(6.797991057173537e-163_dp, "6.7979910571735370E-163")
        call expect(2.0599514754271497e74_dp, "2.0599514754271497E+074")
        call expect(2.6297292086709224e117_dp, "2.6297292086709224E+117")
        call expect(9.418039246583203e223_dp, "9.4180392465832031E+223")
        call expect(1.2775472324406212e-209_dp, "1.2775472324406212E-209")
        call expect(3.607229612784954e237_dp, "3.6072296127849539E+237")
    end subroutine the_hardest_cases_are_right

    subroutine expect(x, text)
        !! Assert that `x` and libgfortran's idea of it are `text`.
        real(dp), intent(in) :: x
        character(*), intent(in) :: text

        call assertEqual(text, number_text(x))
        call compare(x)
    end subroutine expect

    subroutine the_odd_ones_are_right()
        !! Zeros, the ends of the range, integers, and what is not a number.
        integer :: k

        call compare(0.0_dp)
        call compare(huge(1.0_dp))
        call compare(tiny(1.0_dp))
        call compare(nearest(tiny(1.0_dp), -1.0_dp))
        call compare(nearest(0.0_dp, 1.0_dp))
        call compare(9.9999999999999999e22_dp)
        do k = 0, 3000
            call compare(real(k, dp))
            call compare(k*1e-3_dp)
        end do
        call compare(ieee_value(1.0_dp, ieee_positive_inf))
        call compare(ieee_value(1.0_dp, ieee_negative_inf))
        call compare(ieee_value(1.0_dp, ieee_quiet_nan))
    end subroutine the_odd_ones_are_right

    subroutine the_powers_of_ten_are_exact()
        !! Long integers decide: T 2**e <= 10**n < (T + 1) 2**e, for every entry T of the table.
        integer(i8) :: number(limbs), power(limbs)
        integer :: j, e, k, side

        call assertEqual(step, size(fine))
        do k = 0, step - 1
            call assertTrue(fine(k) == shiftl(10_i8**k, -fine_exponent(k)))
            call assertEqual(0, leadz(fine(k)) - (64 - limb))
        end do
        do j = lbound(coarse, 2), ubound(coarse, 2)
            e = coarse_exponent(j)
            do side = 0, 1
                call set(number, coarse(:, j))
                call multiply(number, 1_i8, int(side, i8))
                power = 0
                power(1) = 1
                do k = 1, step*abs(j)
                    if (j > 0) call multiply(power, 10_i8, 0_i8)
                    if (j < 0) call multiply(number, 10_i8, 0_i8)
                end do
                do k = 1, abs(e)
                    if (e > 0) call multiply(number, 2_i8, 0_i8)
                    if (e < 0) call multiply(power, 2_i8, 0_i8)
                end do
                call assertTrue(at_most(number, power) .eqv. side == 0, number_text(real(j, dp)))
            end do
            if (anyExceptions()) return
        end do
    end subroutine the_powers_of_ten_are_exact

    pure subroutine set(number, halves)
        !! A long integer from its high and low half.
        integer(i8), intent(out) :: number(limbs)
        integer(i8), intent(in) :: halves(2)
        integer :: half, bit

        number = 0
        do half = 1, 2
            do bit = limb - 1, 0, -1
                call multiply(number, 2_i8, ibits(halves(half), bit, 1))
            end do
        end do
    end subroutine set

    pure subroutine multiply(number, factor, summand)
        !! Multiply a long integer by a small one, and add one.
        integer(i8), intent(inout) :: number(limbs)
        integer(i8), intent(in) :: factor, summand
        integer(i8) :: carry
        integer :: k

        carry = summand
        do k = 1, limbs
            carry = carry + number(k)*factor
            number(k) = ibits(carry, 0, base)
            carry = shiftr(carry, base)
        end do
    end subroutine multiply

    pure function at_most(left, right) result(yes)
        !! Whether the long integer `left` is less than or equal to `right`.
        integer(i8), intent(in) :: left(limbs), right(limbs)
        logical :: yes
        integer :: k

        do k = limbs, 1, -1
            yes = left(k) < right(k)
            if (left(k) /= right(k)) return
        end do
        yes = .true.
    end function at_most

    subroutine a_row_is_what_write_gives()
        !! With a blank between two fields, even if both are full.
        real(dp), parameter :: values(4) = [1e-3_dp, -1.0_dp/3.0_dp, -2e300_dp, -0.0_dp]
        character(4*(field_width + 1)) :: row, expected
        integer :: length

        call write_row(values, row, length)
        write (expected, "(es24.16e3, 3(1x, es24.16e3), a)") values, new_line("a")
        call assertEqual(len(expected), length)
        call assertEqual(expected, row)
        call write_row(values(2:2), row, length)
        call assertEqual("-3.3333333333333331E-001"//new_line("a"), row(:length))
    end subroutine a_row_is_what_write_gives

    subroutine a_csv_row_has_commas()
        !! And no blanks.
        character(3*(field_width + 1)) :: row
        integer :: length

        call write_csv_row([1e-3_dp, -1.0_dp/3.0_dp, 2e300_dp], row, length)
        call assertEqual("1.0000000000000000E-003,-3.3333333333333331E-001," &
                         //"2.0000000000000001E+300"//new_line("a"), row(:length))
        call write_csv_row([-1e-3_dp, -1e-100_dp, -2e300_dp], row, length)
        call assertEqual(len(row), length)
    end subroutine a_csv_row_has_commas

    subroutine number_text_has_no_blanks()
        !! 17 digits, positive or negative.
        call assertEqual("5.0000000000000000E-001", number_text(0.5_dp))
        call assertEqual("-1.0000000000000001E-001", number_text(-0.1_dp))
    end subroutine number_text_has_no_blanks
end module test_number_text
