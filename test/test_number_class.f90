module test_number_class
    !! Zero and finite, of either sign, and of what is not a number.
    use, intrinsic :: ieee_arithmetic, only: ieee_negative_inf, ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: all_finite, is_nonzero, is_zero
    use lagrangia_vectors, only: farthest
    implicit none (type, external)
    private
    public :: number_class_suite

contains

    function number_class_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("number_class")
        call suite%addTest(TestMethod("zero_has_two_signs", zero_has_two_signs))
        call suite%addTest(TestMethod("lists_are_apart_to_either_side", &
                                      lists_are_apart_to_either_side))
        call suite%addTest(TestMethod("one_that_is_not_finite_is_enough", &
                                      one_that_is_not_finite_is_enough))
    end function number_class_suite

    subroutine zero_has_two_signs()
        !! Both functions are false of NaN.
        real(dp) :: x(6)

        x = [0.0_dp, -0.0_dp, tiny(x), -tiny(x), ieee_value(1.0_dp, ieee_negative_inf), &
             ieee_value(1.0_dp, ieee_quiet_nan)]
        call assertTrue(all(is_zero(x) .eqv. [.true., .true., .false., .false., .false., &
                                              .false.]), message="is it zero?")
        call assertTrue(all(is_nonzero(x) .eqv. [.false., .false., .true., .true., .true., &
                                                 .false.]), message="is it not?")
    end subroutine zero_has_two_signs

    subroutine lists_are_apart_to_either_side()
        !! The largest difference, whichever list is larger there.
        real(dp), parameter :: a(3) = [1.0_dp, 2.0_dp, -3.0_dp]

        call assertEqual(0.5_dp, farthest(a, a + [0.25_dp, 0.5_dp, 0.0_dp]), 0.0_dp, "above")
        call assertEqual(0.5_dp, farthest(a, a - [0.25_dp, 0.0_dp, 0.5_dp]), 0.0_dp, "below")
        call assertEqual(0.75_dp, farthest(a, a + [-0.75_dp, 0.5_dp, 0.0_dp]), 0.0_dp, "both")
    end subroutine lists_are_apart_to_either_side

    subroutine one_that_is_not_finite_is_enough()
        !! Of a list, a matrix and a list of matrices; of no numbers all are finite.
        real(dp) :: x(8), bad(2)
        integer :: i, k

        bad = [ieee_value(1.0_dp, ieee_negative_inf), ieee_value(1.0_dp, ieee_quiet_nan)]
        x = huge(x)
        call assertTrue(all_finite(x) .and. all_finite(reshape(x, [2, 4])) .and. &
                        all_finite(reshape(x, [2, 2, 2])), message="all are")
        call assertTrue(all_finite(x(:0)), message="there is none")
        do i = 1, size(x)
            do k = 1, size(bad)
                x = 1.0_dp
                x(i) = bad(k)
                call assertFalse(all_finite(x), message="list")
                call assertFalse(all_finite(reshape(x, [2, 4])), message="matrix")
                call assertFalse(all_finite(reshape(x, [2, 2, 2])), message="matrices")
            end do
        end do
    end subroutine one_that_is_not_finite_is_enough
end module test_number_class
