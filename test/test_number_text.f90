module test_number_text
    !! Rows of numbers: every double survives the trip to text and back. Cells: none overflows.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_certain_digits, only: certain, certain_scientific, number, share_of
    use lagrangia_kinds, only: dp, i8
    use lagrangia_number_text, only: field_width, fixed, scientific, write_csv_row, write_row
    implicit none (type, external)
    private
    public :: number_text_suite

contains

    function number_text_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("number_text")
        call suite%addTest(TestMethod("every_double_survives", every_double_survives))
        call suite%addTest(TestMethod("a_row_has_fixed_fields", a_row_has_fixed_fields))
        call suite%addTest(TestMethod("a_csv_row_has_commas", a_csv_row_has_commas))
        call suite%addTest(TestMethod("cells_never_overflow", cells_never_overflow))
        call suite%addTest(TestMethod("digits_that_rounding_has_left", &
                                      digits_that_rounding_has_left))
        call suite%addTest(TestMethod("twelve_digits_at_most", twelve_digits_at_most))
    end function number_text_suite

    subroutine every_double_survives()
        !! Four significands for every exponent of a double, denormals included, bit for bit.
        real(dp) :: x, back(2)
        character(2*(field_width + 1)) :: row
        integer(i8) :: state
        integer :: exponent, k, length

        state = 88172645463325252_i8
        do exponent = 0, 2046
            do k = 1, 4
                state = ieor(state, shiftl(state, 13))  ! Marsaglia's xorshift
                state = ieor(state, shiftr(state, 7))
                state = ieor(state, shiftl(state, 17))
                x = transfer(ior(ibits(state, 0, 52), shiftl(int(exponent, i8), 52)), x)
                call write_row([x, -x], row, length)
                read (row(:length - 1), *) back
                call assertEqual(transfer(x, state), transfer(back(1), state), row)
                call assertEqual(transfer(-x, state), transfer(back(2), state), row)
                if (anyExceptions()) return
            end do
        end do
    end subroutine every_double_survives

    subroutine a_row_has_fixed_fields()
        !! A blank between two fields, even if both are full; three-digit exponents stay readable.
        character(4*(field_width + 1)) :: row
        integer :: length

        call write_row([1e-3_dp, -1.0_dp/3.0_dp, -2e300_dp, -0.0_dp], row, length)
        call assertEqual(len(row), length)
        call assertEqual(" 1.0000000000000000E-003 -3.3333333333333331E-001 "// &
                         "-2.0000000000000001E+300 -0.0000000000000000E+000"//new_line("a"), row)
        call write_row([5e-324_dp], row(:field_width + 1), length)
        call assertEqual(" 4.9406564584124654E-324"//new_line("a"), row(:length))
    end subroutine a_row_has_fixed_fields

    subroutine digits_that_rounding_has_left()
        !! A share of 3e-k leaves k - 1 digits; one half of the number leaves none, and of 0 there
        !! is nothing to lose.
        call assertEqual("0.500000", certain(0.5_dp, 3e-7_dp), "behind the point")
        call assertEqual("-123.457", certain(-123.456789_dp, 3e-7_dp), "and before it")
        call assertEqual("123.", certain(123.456789_dp, 3e-4_dp), "only before it")
        call assertEqual("1.2E+02", certain(123.456789_dp, 3e-3_dp), "not all before it")
        call assertEqual("1.23E-04", certain(1.23456e-4_dp, 3e-4_dp), "a small one")
        call assertEqual("2.", certain(2.0_dp, 0.4_dp), "one digit")
        call assertEqual("7.E-01", certain_scientific(0.7_dp, 0.49_dp, 9), "one of a fraction")
        call assertEqual("rounding", certain(2.0_dp, 0.5_dp), "none")
        call assertEqual("rounding", certain_scientific(2.0_dp, 0.5_dp, 3), "none of three")
        call assertEqual("0", certain(0.0_dp, 1.0_dp), "zero")
        call assertEqual("0.000E+00", certain_scientific(0.0_dp, 1.0_dp, 4), "zero with digits")
        call assertEqual(0.25_dp, share_of(-4.0_dp, 1.0_dp), 0.0_dp, "a share")
        call assertEqual(0.5_dp, share_of(0.0_dp, 0.5_dp*tiny(1.0_dp)), 0.0_dp, "of nothing")
    end subroutine digits_that_rounding_has_left

    subroutine twelve_digits_at_most()
        !! Eleven behind a point, ten with an exponent, which numbers have below 1e-3 and from 1e5;
        !! with fewer than eleven sure ones no more than these.
        call assertEqual("-0.33333333333", certain(-1.0_dp/3.0_dp, 0.0_dp), "eleven")
        call assertEqual("0.00100000000", certain(1e-3_dp, 0.0_dp), "the least without exponent")
        call assertEqual("9.9900000000E-004", certain(9.99e-4_dp, 5e-12_dp), "smaller")
        call assertEqual("9.9900000000E-04", certain(9.99e-4_dp, 6e-12_dp), "of eleven digits")
        call assertEqual("1.0000000000E+005", certain(1e5_dp, 0.0_dp), "the first large one")
        call assertEqual("99999.50000000000", certain(99999.5_dp, 0.0_dp), "below it")
        call assertEqual("-1.0000000000E+005", number(-1e5_dp), "as wide as the longest")
        call assertEqual("0", trim(number(0.0_dp)), "zero")
        call assertEqual(1, len(certain(0.0_dp, 1.0_dp)), "no blanks behind zero")
        call assertEqual(17, len(certain(9.99e-4_dp, 0.0_dp)), "nor behind an exponent")
        call assertEqual("3.3333333333333331E-01", certain_scientific(1.0_dp/3.0_dp, 0.0_dp, 17), &
                         "all that a double has")
        call assertEqual("3.33E-01", certain_scientific(1.0_dp/3.0_dp, 0.0_dp, 3), "three")
    end subroutine twelve_digits_at_most

    subroutine cells_never_overflow()
        !! Every size of a double, either sign: the text is there, and reads back to what it shows.
        character(:), allocatable :: text
        real(dp) :: back, x
        integer :: exponent, shown

        do exponent = -323, 307
            x = merge(-9.96_dp, 1.25_dp, mod(exponent, 2) == 0)*10.0_dp**exponent
            text = scientific(x, 2)
            read (text, *) back
            call assertTrue(abs(back - x) <= 0.05_dp*abs(x) + 2.0_dp*spacing(x), text)
            read (text(index(text, "E") + 1:), *) shown
            call assertEqual(merge(3, 2, abs(shown) >= 100), len(text) - index(text, "E") - 1, text)
            text = fixed(x, 4)
            read (text, *) back
            call assertTrue(abs(back - x) <= 0.5e-4_dp + spacing(x), text)
        end do
        call assertEqual("1.2E-09", scientific(1.24e-9_dp, 2))
        call assertEqual("-1.2346E+100", scientific(-1.23456e100_dp, 5))
        call assertEqual("0.0", fixed(0.0_dp, 1))
        call assertEqual("-0.0120", fixed(-0.012_dp, 4))
        call assertEqual("0.0E+00", scientific(-0.0_dp, 2), "a zero has no sign")
        call assertEqual("0.00", fixed(-0.004_dp, 2), "nor what is rounded to one")
        call assertEqual("-0.01", fixed(-0.006_dp, 2))
    end subroutine cells_never_overflow

    subroutine a_csv_row_has_commas()
        !! And no blanks.
        character(3*(field_width + 1)) :: row
        integer :: length

        call write_csv_row([1e-3_dp, -1.0_dp/3.0_dp, 2e300_dp], row, length)
        call assertEqual("1.0000000000000000E-003,-3.3333333333333331E-001,"// &
                         "2.0000000000000001E+300"//new_line("a"), row(:length))
        call write_csv_row([-1e-3_dp, -1e-100_dp, -2e300_dp], row, length)
        call assertEqual(len(row), length)
    end subroutine a_csv_row_has_commas
end module test_number_text
