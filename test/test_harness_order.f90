module test_harness_order
    !! Assertions of order fail when they must, in pFUnit's words.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, anyExceptions, assertExceptionRaised, assertFalse, &
                     assertGreaterThan, assertGreaterThanOrEqual, assertLessThan, &
                     assertLessThanOrEqual
    use lagrangia_kinds, only: dp, i8
    implicit none (type, external)
    private
    public :: harness_order_suite

    character(*), parameter :: nl = new_line("a")
    character(*), parameter :: one = "1.0000000000000000"
    character(*), parameter :: two = "2.0000000000000000"
    character(*), parameter :: three = "3.0000000000000000"

contains

    function harness_order_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("harness_order")
        call suite%addTest(TestMethod("right_order_passes", right_order_passes))
        call suite%addTest(TestMethod("wrong_order_fails", wrong_order_fails))
        call suite%addTest(TestMethod("equal_is_not_less", equal_is_not_less))
        call suite%addTest(TestMethod("shapes_fail", shapes_fail))
        call suite%addTest(TestMethod("nan_has_no_order", nan_has_no_order))
    end function harness_order_suite

    subroutine right_order_passes()
        !! What holds leaves no failure behind, at the edge of the tolerance too.
        call assertLessThan(1, 2)
        call assertLessThan(1.0_dp, 2.0_dp)
        call assertLessThan(2.25_dp, 2.0_dp, tolerance=0.5_dp)
        call assertLessThan([1.0_dp, 2.0_dp], [2.0_dp, 3.0_dp])
        call assertLessThan(0.0_dp, [1.0_dp, 2.0_dp])
        call assertLessThanOrEqual(2_i8, 2_i8)
        call assertLessThanOrEqual(2.5_dp, 2.0_dp, tolerance=0.5_dp)
        call assertGreaterThan(2, 1)
        call assertGreaterThan(2.0_dp, 1.0_dp)
        call assertGreaterThan(1.75_dp, 2.0_dp, 0.5_dp)
        call assertGreaterThanOrEqual(2, 2)
        call assertGreaterThanOrEqual([2.0_dp, 1.5_dp], [2.0_dp, 2.0_dp], 0.5_dp)
    end subroutine right_order_passes

    subroutine wrong_order_fails()
        !! Each relation says what it was not, of the first element it was not true of.
        real(dp), parameter :: mixed(3) = [1.0_dp, 3.0_dp, 4.0_dp]
        character(:), allocatable :: claim, words

        claim = "AssertLessThan"
        words = "not less than"
        call assertLessThan(2, 1)
        call assertExceptionRaised(unordered(claim, words, "2", "1"))
        call assertLessThan(2_i8, 1_i8, message="a count")
        call assertExceptionRaised("a count"//nl//unordered(claim, words, "2", "1"))
        call assertLessThan(2.0_dp, 1.0_dp, 0.5_dp, "a number")
        call assertExceptionRaised("a number"//nl//unordered(claim, words, two, one))
        call assertLessThan(mixed, [2.0_dp, 2.0_dp, 2.0_dp], message="list")
        call assertExceptionRaised("list"//nl//"Array"//unordered(claim, words, three, two, "[2]"))
        call assertLessThan(2.0_dp, 4.0_dp - mixed)
        call assertExceptionRaised("Array"//unordered(claim, words, two, one, "[2]"))

        claim = "AssertLessThanOrEqual"
        words = "not less than or equal to"
        call assertLessThanOrEqual(2, 1)
        call assertExceptionRaised(unordered(claim, words, "2", "1"))
        call assertLessThanOrEqual(2_i8, 1_i8, message="a count")
        call assertExceptionRaised("a count"//nl//unordered(claim, words, "2", "1"))
        call assertLessThanOrEqual(2.0_dp, 1.0_dp, 0.5_dp, "a number")
        call assertExceptionRaised("a number"//nl//unordered(claim, words, two, one))
        call assertLessThanOrEqual(mixed, [2.0_dp, 2.0_dp, 2.0_dp], message="list")
        call assertExceptionRaised("list"//nl//"Array"//unordered(claim, words, three, two, "[2]"))
        call assertLessThanOrEqual(2.0_dp, 4.0_dp - mixed)
        call assertExceptionRaised("Array"//unordered(claim, words, two, one, "[2]"))

        claim = "AssertGreaterThan"
        words = "not greater than"
        call assertGreaterThan(1, 2)
        call assertExceptionRaised(unordered(claim, words, "1", "2"))
        call assertGreaterThan(1_i8, 2_i8, message="a count")
        call assertExceptionRaised("a count"//nl//unordered(claim, words, "1", "2"))
        call assertGreaterThan(1.0_dp, 2.0_dp, 0.5_dp, "a number")
        call assertExceptionRaised("a number"//nl//unordered(claim, words, one, two))
        call assertGreaterThan([2.0_dp, 2.0_dp, 2.0_dp], mixed, message="list")
        call assertExceptionRaised("list"//nl//"Array"//unordered(claim, words, two, three, "[2]"))
        call assertGreaterThan(2.0_dp, mixed)
        call assertExceptionRaised("Array"//unordered(claim, words, two, three, "[2]"))

        claim = "AssertGreaterThanOrEqual"
        words = "not greater than or equal to"
        call assertGreaterThanOrEqual(1, 2)
        call assertExceptionRaised(unordered(claim, words, "1", "2"))
        call assertGreaterThanOrEqual(1_i8, 2_i8, message="a count")
        call assertExceptionRaised("a count"//nl//unordered(claim, words, "1", "2"))
        call assertGreaterThanOrEqual(1.0_dp, 2.0_dp, 0.5_dp, "a number")
        call assertExceptionRaised("a number"//nl//unordered(claim, words, one, two))
        call assertGreaterThanOrEqual([2.0_dp, 2.0_dp, 2.0_dp], mixed, message="list")
        call assertExceptionRaised("list"//nl//"Array"//unordered(claim, words, two, three, "[2]"))
        call assertGreaterThanOrEqual(2.0_dp, mixed)
        call assertExceptionRaised("Array"//unordered(claim, words, two, three, "[2]"))
    end subroutine wrong_order_fails

    subroutine equal_is_not_less()
        !! The strict relations fail on equal numbers.
        call assertLessThan(2, 2)
        call assertExceptionRaised()
        call assertLessThan(2.0_dp, 2.0_dp)
        call assertExceptionRaised()
        call assertGreaterThan(2_i8, 2_i8)
        call assertExceptionRaised()
        call assertGreaterThan(2.0_dp, 2.0_dp)
        call assertExceptionRaised()
        call assertFalse(anyExceptions())
    end subroutine equal_is_not_less

    subroutine nan_has_no_order()
        !! Whatever is claimed of a NaN, on either side.
        real(dp) :: nan

        nan = ieee_value(1.0_dp, ieee_quiet_nan)
        call assertLessThan(nan, 1.0_dp)
        call assertExceptionRaised()
        call assertLessThanOrEqual(1.0_dp, nan)
        call assertExceptionRaised()
        call assertGreaterThan(nan, 1.0_dp)
        call assertExceptionRaised()
        call assertGreaterThanOrEqual(1.0_dp, nan)
        call assertExceptionRaised()
        call assertFalse(anyExceptions())
    end subroutine nan_has_no_order

    subroutine shapes_fail()
        !! Arrays of different lengths have no order.
        character(*), parameter :: longer = "Arrays not conformable failure:"//nl &
                                            //"    Expected shape: [3]"//nl &
                                            //"      Actual shape: [2]"

        call assertLessThan([1.0_dp, 2.0_dp, 3.0_dp], [7.0_dp, 8.0_dp])
        call assertExceptionRaised(longer)
        call assertLessThanOrEqual([1.0_dp, 2.0_dp, 3.0_dp], [7.0_dp, 8.0_dp])
        call assertExceptionRaised(longer)
        call assertGreaterThan([8.0_dp, 9.0_dp, 3.0_dp], [7.0_dp, 8.0_dp])
        call assertExceptionRaised(longer)
        call assertGreaterThanOrEqual([8.0_dp, 9.0_dp, 3.0_dp], [7.0_dp, 8.0_dp])
        call assertExceptionRaised(longer)
    end subroutine shapes_fail

    function unordered(claim, words, lhs, rhs, at) result(message)
        !! What the assertions of order say.
        character(*), intent(in) :: claim, words, lhs, rhs
        character(*), intent(in), optional :: at
        character(:), allocatable :: message
        integer :: width

        width = len(words) + 4
        message = claim//" failure:"//nl//repeat(" ", width - 3)//"LHS: <"//lhs//">"//nl &
                  //"    "//words//": <"//rhs//">"
        if (present(at)) message = message//nl//repeat(" ", width - 8)//"at index: "//at
    end function unordered
end module test_harness_order
