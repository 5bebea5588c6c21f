module test_concise
    !! Numbers with their uncertainty in brackets.
    use funit, only: TestMethod, TestSuite, assertEqual, assertLessThanOrEqual
    use lagrangia_concise, only: concise
    use lagrangia_kinds, only: dp
    use random_states, only: restart_random, uniform
    use stated_text, only: read_concise
    implicit none (type, external)
    private
    public :: concise_suite

contains

    function concise_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("concise")
        call suite%addTest(TestMethod("the_error_counts_in_last_digits", &
                                      the_error_counts_in_last_digits))
        call suite%addTest(TestMethod("the_error_is_rounded_up", the_error_is_rounded_up))
        call suite%addTest(TestMethod("very_large_and_small_ones_have_a_power", &
                                      very_large_and_small_ones_have_a_power))
        call suite%addTest(TestMethod("text_lies_within_its_error", text_lies_within_its_error, &
                                      setUp=restart_random))
    end function concise_suite

    subroutine the_error_counts_in_last_digits()
        !! As in the GUM, with one digit, which also has room for what is rounded off: 0.48312 is
        !! 0.4e-5 off already.
        call assertEqual("0.48312(3)", concise(0.483124_dp, 2e-5_dp))
        call assertEqual("-0.48313(3)", concise(-0.483126_dp, 2e-5_dp))
        call assertEqual("100.02(4)", concise(100.0214_dp, 0.035_dp))
        call assertEqual("12(4)", concise(12.3_dp, 3.0_dp))
        call assertEqual("0.00(2)", concise(-0.001_dp, 0.01_dp))
        call assertEqual("9.81", concise(9.81_dp, 0.0_dp))
        call assertEqual("0.0", concise(-0.0_dp, 0.0_dp), "zero has no sign")
    end subroutine the_error_counts_in_last_digits

    subroutine the_error_is_rounded_up()
        !! Never down; nine and a bit is one of the next digit.
        call assertEqual("0.5(3)", concise(0.512_dp, 0.2001_dp))
        call assertEqual("0.5(2)", concise(0.512_dp, 0.0901_dp))
        call assertEqual("1(2)", concise(0.512_dp, 0.9001_dp))
        call assertEqual("0.500(4)", concise(0.5_dp, 0.00390625_dp))
    end subroutine the_error_is_rounded_up

    subroutine very_large_and_small_ones_have_a_power()
        !! Of ten, behind; the digits before it are those of the number, if the error leaves any.
        call assertEqual("1.235(3)e4", concise(12346.0_dp, 20.0_dp))
        call assertEqual("6.6261(3)e-34", concise(6.62607e-34_dp, 2e-38_dp))
        call assertEqual("1.000(2)e-7", concise(9.9999e-8_dp, 1e-10_dp))
        call assertEqual("1.0(2)e2", concise(96.58_dp, 8.9_dp), "96.58 is 100 in tens")
        call assertEqual("-1.0(2)e-10", concise(-9.91e-11_dp, 1.1e-11_dp), "in its first digit")
        call assertEqual("-1.00(2)e-10", concise(-9.96e-11_dp, 1.1e-12_dp), "in its second")
        call assertEqual("-9.9(2)e-11", concise(-9.92e-11_dp, 1.1e-12_dp), "not in its second")
        call assertEqual("0(3)e-9", concise(4e-10_dp, 2e-9_dp))
        call assertEqual("-1(4)e-9", concise(-9e-10_dp, 3e-9_dp))
        call assertEqual("0(4)e5", concise(0.0_dp, 4e5_dp))
        call assertEqual("1.797693135(1)e308", concise(huge(1.0_dp), 1e299_dp))
    end subroutine very_large_and_small_ones_have_a_power

    subroutine text_lies_within_its_error()
        !! Of any value and error: what is printed, give or take the bracket, has in it all that
        !! is within the error of the value; and the bracket is no more than 20/8.5 errors, as
        !! where 8.51 and a rounding of 0.5 become 1, and of 5 then 2, of the next digit.
        real(dp) :: value, error, centre, bracket
        character(:), allocatable :: text
        integer :: k

        do k = 1, 500
            value = uniform(-1.0_dp, 1.0_dp)*10.0_dp**uniform(-12.0_dp, 12.0_dp)
            error = abs(value)*10.0_dp**uniform(-14.0_dp, 1.0_dp)
            text = concise(value, error)
            call read_concise(text, centre, bracket)
            call assertLessThanOrEqual(error + abs(centre - value), &
                bracket + 4.0_dp*epsilon(value)*abs(value), message=text)
            call assertLessThanOrEqual(bracket, &
                20.0_dp/8.5_dp*error*(1.0_dp + 4.0_dp*epsilon(value)), &
                                       message=text)
            call assertLessThanOrEqual(abs(centre - value), 0.5_dp*bracket &
                                       + 4.0_dp*epsilon(value)*abs(value), message=text)
        end do
        do k = 1, 500  ! a first digit of nine may become ten
            value = (10.0_dp - uniform(0.0_dp, 0.9_dp))*10.0_dp**(k/10 - 25)
            error = value*10.0_dp**uniform(-3.0_dp, 0.5_dp)
            text = concise(value, error)
            call read_concise(text, centre, bracket)
            call assertLessThanOrEqual(error + abs(centre - value), &
                bracket*(1.0_dp + 4.0_dp*epsilon(value)), message=text)
        end do
    end subroutine text_lies_within_its_error
end module test_concise
