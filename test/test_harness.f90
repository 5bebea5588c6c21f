module test_harness
    !! Assertions fail when they must, in pFUnit's words; else no other suite proves anything.
    use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertExceptionRaised, &
                     assertFail, assertFalse, assertIsFinite, assertRelativelyEqual, &
                     assertSameShape, assertTrue
    use lagrangia_kinds, only: dp, i8
    use test_harness_fixtures, only: harness_fixtures_suite
    use test_harness_order, only: harness_order_suite
    implicit none (type, external)
    private
    public :: harness_suite

    character(*), parameter :: nl = new_line("a")

contains

    function harness_suite() result(suite)
        !! The tests of this module, and of what surrounds a test.
        type(TestSuite) :: suite

        suite = TestSuite("harness")
        call suite%addTest(TestMethod("true_claims_pass", true_claims_pass))
        call suite%addTest(TestMethod("failures_are_seen_in_order", failures_are_seen_in_order))
        call suite%addTest(TestMethod("conditions_fail", conditions_fail))
        call suite%addTest(TestMethod("shapes_fail", shapes_fail))
        call suite%addTest(TestMethod("unequal_values_fail", unequal_values_fail))
        call suite%addTest(TestMethod("unequal_elements_fail", unequal_elements_fail))
        call suite%addTest(TestMethod("unequal_strings_fail", unequal_strings_fail))
        call suite%addTest(TestMethod("relative_differences_fail", relative_differences_fail))
        call suite%addTest(TestMethod("nan_fails", nan_fails))
        call suite%addTest(harness_fixtures_suite())
        call suite%addTest(harness_order_suite())
    end function harness_suite

    subroutine true_claims_pass()
        !! What holds leaves no failure behind, at the edge of the tolerance too.
        real(dp), parameter :: matrix(2, 2) = reshape([1.0_dp, 2.0_dp, 3.0_dp, 4.0_dp], [2, 2])
        real(dp), parameter :: none(0) = [real(dp) ::]
        real(dp) :: infinity

        infinity = ieee_value(1.0_dp, ieee_positive_inf)
        call assertTrue(.true.)
        call assertTrue([.true., .true.])
        call assertFalse(.false.)
        call assertFalse([.false., .false.])
        call assertIsFinite(huge(1.0_dp))
        call assertSameShape([2, 2], shape(matrix))
        call assertSameShape(shape(infinity), shape(matrix))
        call assertEqual(3, 3)
        call assertEqual(3, 3_i8)
        call assertEqual(2_i8**40, 2_i8**40)
        call assertEqual([1, 2], [1, 2])
        call assertEqual([1_i8, 2_i8], [1_i8, 2_i8])
        call assertEqual(.true., .true.)
        call assertEqual([.true., .false.], [.true., .false.])
        call assertEqual("pendulum", "  pendulum"//achar(9))
        call assertEqual("", "  ")
        call assertEqual(["a ", "bc"], ["a  ", "bc "])
        call assertEqual(0.3_dp, 0.3_dp)
        call assertEqual(1.0_dp, 1.5_dp, tolerance=0.5_dp)
        call assertEqual(infinity, infinity)
        call assertEqual(none, none)
        call assertEqual(2.0_dp, [2.0_dp, 2.25_dp], 0.25_dp)
        call assertEqual([1.0_dp, 2.0_dp], [1.0_dp, 2.0_dp])
        call assertEqual(matrix, matrix)
        call assertEqual(2.5_dp, matrix, 1.5_dp)
        call assertRelativelyEqual(-4.0_dp, -5.0_dp, 0.25_dp)
        call assertRelativelyEqual(4.0_dp, [3.0_dp, 5.0_dp], 0.25_dp)
        call assertRelativelyEqual([4.0_dp, 8.0_dp], [5.0_dp, 6.0_dp], tolerance=0.25_dp)
        call assertRelativelyEqual(matrix, matrix, 0.0_dp)
    end subroutine true_claims_pass

    subroutine failures_are_seen_in_order()
        !! A failure lets the test go on, and may be taken back by its words.
        integer :: i

        call assertFalse(anyExceptions())
        do i = 1, 9
            call assertFail("failure "//achar(iachar("0") + i))
        end do
        call assertTrue(anyExceptions())
        call assertExceptionRaised("failure 1")
        call assertExceptionRaised("failure 9")
        call assertExceptionRaised("failure 4")
        do i = 1, 3
            call assertTrue(anyExceptions())
            call assertExceptionRaised()
        end do
        call assertExceptionRaised("failure 5")
        call assertExceptionRaised("failure 3")
        call assertExceptionRaised("failure 2")
        call assertFalse(anyExceptions())
        call assertExceptionRaised("nothing")
        call assertTrue(anyExceptions())
        call assertExceptionRaised("Failed to throw exception: <nothing>")
        call assertFalse(anyExceptions())
        call assertExceptionRaised()
        call assertExceptionRaised("Failed to throw exception.")
    end subroutine failures_are_seen_in_order

    subroutine conditions_fail()
        !! Their message is all that is said.
        call assertTrue(.false.)
        call assertExceptionRaised("")
        call assertTrue(.false., "two plus two")
        call assertExceptionRaised("two plus two")
        call assertTrue([.true., .false.], message="one of two")
        call assertExceptionRaised("one of two")
        call assertFalse(.true.)
        call assertExceptionRaised("")
        call assertFalse([.false., .true.], "none of two")
        call assertExceptionRaised("none of two")
        call assertIsFinite(ieee_value(1.0_dp, ieee_positive_inf), "an infinity")
        call assertExceptionRaised("an infinity")
    end subroutine conditions_fail

    subroutine shapes_fail()
        !! Neither a rank nor an extent may differ, and arrays are not compared unless they conform.
        character(*), parameter :: longer = "Arrays not conformable failure:"//nl &
                                            //"    Expected shape: [3]"//nl &
                                            //"      Actual shape: [2]"
        character(*), parameter :: wider = "Arrays not conformable failure:"//nl &
                                           //"    Expected shape: [2,2]"//nl &
                                           //"      Actual shape: [2,1]"
        real(dp), parameter :: square(2, 2) = 1.0_dp

        call assertSameShape([2, 3], [3, 2])
        call assertExceptionRaised("nonconforming arrays - expected shape: [2,3] " &
                                   //"but found shape: [3,2]")
        call assertSameShape([2, 3], [2, 4], " ")
        call assertExceptionRaised("nonconforming arrays - expected shape: [2,3] " &
                                   //"but found shape: [2,4]")
        call assertSameShape([6], [2, 3], message="a matrix")
        call assertExceptionRaised("a matrix nonconforming arrays - expected shape: [6] " &
                                   //"but found shape: [2,3]")
        call assertEqual([1.0_dp, 2.0_dp, 3.0_dp], [1.0_dp, 2.0_dp])
        call assertExceptionRaised(longer)
        call assertEqual([1, 2, 3], [1, 2], "longer")
        call assertExceptionRaised("longer"//nl//longer)
        call assertEqual(["a", "b", "c"], ["a", "b"])
        call assertExceptionRaised(longer)
        call assertEqual([.true., .true., .true.], [.true., .true.])
        call assertExceptionRaised(longer)
        call assertRelativelyEqual([1.0_dp, 2.0_dp, 3.0_dp], [1.0_dp, 2.0_dp], 1.0_dp)
        call assertExceptionRaised(longer)
        call assertEqual(square, square(:, :1))
        call assertExceptionRaised(wider)
        call assertRelativelyEqual(square, square(:, :1), 1.0_dp)
        call assertExceptionRaised(wider)
    end subroutine shapes_fail

    subroutine unequal_values_fail()
        !! Expected first, then actual, then actual less expected.
        call assertEqual(3, 5)
        call assertExceptionRaised(unequal("3", "5", "<2>"))
        call assertEqual(3, 5_i8, "mixed kinds")
        call assertExceptionRaised("mixed kinds"//nl//unequal("3", "5", "<2>"))
        call assertEqual(2_i8**40, 0_i8)
        call assertExceptionRaised(unequal("1099511627776", "0", "<-1099511627776>"))
        call assertEqual(1.0_dp, 1.5_dp)
        call assertExceptionRaised(unequal("1.0000000000000000", "1.5000000000000000", &
                                           "<0.50000000000000000> (greater than tolerance of " &
                                           //"0.0000000000000000)"))
        call assertEqual(1.5_dp, 1.0_dp, 0.25_dp, "too far")
        call assertExceptionRaised("too far"//nl &
                                   //unequal("1.5000000000000000", "1.0000000000000000", &
                                             "<-0.50000000000000000> (greater than tolerance of " &
                                             //"0.25000000000000000)"))
        call assertEqual(.true., .false., message="a claim")
        call assertExceptionRaised("a claim"//nl//"AssertEquivalent failure:"//nl &
                                   //"    Expected: <T>"//nl//"    Actual:   <F>")
    end subroutine unequal_values_fail

    subroutine unequal_elements_fail()
        !! The first element that differs is named by its index.
        real(dp) :: matrix(2, 3)

        call assertEqual([1, 2, 3], [1, 4, 5])
        call assertExceptionRaised("Array"//unequal("2", "4", "<2>")//nl//"      at index: [2]")
        call assertEqual([1_i8, 2_i8], [3_i8, 2_i8])
        call assertExceptionRaised("Array"//unequal("1", "3", "<2>")//nl//"      at index: [1]")
        call assertEqual([.true., .true., .true.], [.true., .false., .false.])
        call assertExceptionRaised("ArrayAssertEquivalent failure:"//nl//"    Expected: <T>"//nl &
                                   //"    Actual:   <F>"//nl//"    at index: [2]>")
        call assertEqual(2.0_dp, [2.0_dp, 2.0_dp, 4.0_dp], 1.0_dp, "a constant")
        call assertExceptionRaised("a constant"//nl//"Array" &
                                   //unequal("2.0000000000000000", "4.0000000000000000", &
                                             "<2.0000000000000000> (greater than tolerance of " &
                                             //"1.0000000000000000)")//nl//"      at index: [3]")
        matrix = 2.0_dp
        matrix(2, 3) = 4.0_dp
        call assertEqual(2.0_dp + 0.0_dp*matrix, matrix, 1.0_dp)
        call assertExceptionRaised("Array" &
                                   //unequal("2.0000000000000000", "4.0000000000000000", &
                                             "<2.0000000000000000> (greater than tolerance of " &
                                             //"1.0000000000000000)")//nl//"      at index: [2,3]")
        matrix(1, 2) = 4.0_dp
        call assertEqual(2.0_dp, matrix, 1.0_dp)
        call assertExceptionRaised("Array" &
                                   //unequal("2.0000000000000000", "4.0000000000000000", &
                                             "<2.0000000000000000> (greater than tolerance of " &
                                             //"1.0000000000000000)")//nl//"      at index: [1,2]")
    end subroutine unequal_elements_fail

    subroutine unequal_strings_fail()
        !! Blanks within count; an arrow shows where the strings part.
        call assertEqual("pendulum", "pendulun")
        call assertExceptionRaised(unequal_strings("pendulum", "pendulun", "-------^"))
        call assertEqual("a", "b", "")
        call assertExceptionRaised(unequal_strings("a", "b", "^"))
        call assertEqual("a  b", "a b", "two blanks")
        call assertExceptionRaised("two blanks "//unequal_strings("a  b", "a b", "--^"))
        call assertEqual("", " x ")
        call assertExceptionRaised(unequal_strings("", " x", "^"))
        call assertEqual("ab", "abc")
        call assertExceptionRaised(unequal_strings("ab", "abc", "--^"))
        call assertEqual(["a", "b"], ["a", "c"])
        call assertExceptionRaised(unequal_strings("b", "c", "^"))
    end subroutine unequal_strings_fail

    subroutine relative_differences_fail()
        !! They are measured against what was expected, which may not be zero.
        real(dp), parameter :: matrix(2, 2) = reshape([1.0_dp, 2.0_dp, 4.0_dp, 8.0_dp], [2, 2])

        call assertRelativelyEqual(4.0_dp, 5.5_dp, 0.25_dp)
        call assertExceptionRaised(far("4.0000000000000000", "5.5000000000000000", &
                                       "0.37500000000000000", "0.25000000000000000"))
        call assertRelativelyEqual(4.0_dp, 2.5_dp, 0.25_dp)
        call assertExceptionRaised(far("4.0000000000000000", "2.5000000000000000", &
                                       "-0.37500000000000000", "0.25000000000000000"))
        call assertRelativelyEqual(-4.0_dp, [-4.0_dp, 4.0_dp, 8.0_dp], 0.25_dp, "a sign")
        call assertExceptionRaised("a sign"//nl//"Array" &
                                   //far("-4.0000000000000000", "4.0000000000000000", &
                                         "-2.0000000000000000", "0.25000000000000000") &
                                   //nl//"      at index: [2]")
        call assertRelativelyEqual(matrix, transpose(matrix), 0.25_dp)
        call assertExceptionRaised("Array"//far("2.0000000000000000", "4.0000000000000000", &
                                                "1.0000000000000000", "0.25000000000000000") &
                                   //nl//"      at index: [2,1]")
        call assertRelativelyEqual(0.0_dp, 0.0_dp, 0.25_dp)
        call assertExceptionRaised("Zero denominator detected in AssertRelativelyEqual. failure:")
        call assertRelativelyEqual([1.0_dp, 0.0_dp], [9.0_dp, 0.0_dp], 0.25_dp, "a zero")
        call assertExceptionRaised("a zero"//nl &
                                   //"Zero denominator detected in AssertRelativelyEqual. failure:")
    end subroutine relative_differences_fail

    subroutine nan_fails()
        !! Whatever is claimed of a NaN, on either side.
        real(dp) :: nan

        nan = ieee_value(1.0_dp, ieee_quiet_nan)
        call assertIsFinite(nan)
        call assertExceptionRaised()
        call assertEqual(nan, nan)
        call assertExceptionRaised()
        call assertEqual(1.0_dp, nan, huge(1.0_dp))
        call assertExceptionRaised()
        call assertEqual([1.0_dp, 2.0_dp], [1.0_dp, nan], 1.0_dp)
        call assertExceptionRaised()
        call assertEqual(1.0_dp, 2.0_dp, tolerance=nan)
        call assertExceptionRaised()
        call assertRelativelyEqual(1.0_dp, nan, 1.0_dp)
        call assertExceptionRaised()
        call assertRelativelyEqual(nan, nan, 1.0_dp)
        call assertExceptionRaised()
        call assertFalse(anyExceptions())
    end subroutine nan_fails

    function unequal(expected, actual, difference) result(message)
        !! What `assertEqual` says of numbers.
        character(*), intent(in) :: expected, actual, difference
        character(:), allocatable :: message

        message = "AssertEqual failure:"//nl//"      Expected: <"//expected//">"//nl &
                  //"        Actual: <"//actual//">"//nl//"    Difference: "//difference
    end function unequal

    function unequal_strings(expected, found, arrow) result(message)
        !! What `assertEqual` says of strings.
        character(*), intent(in) :: expected, found, arrow
        character(:), allocatable :: message

        message = "String assertion failed:"//nl//'    expected: <"'//expected//'">'//nl &
                  //'   but found: <"'//found//'">'//nl//"  first diff:   "//arrow
    end function unequal_strings

    function far(expected, actual, difference, tolerance) result(message)
        !! What `assertRelativelyEqual` says.
        character(*), intent(in) :: expected, actual, difference, tolerance
        character(:), allocatable :: message

        message = "AssertRelativelyEqual failure:"//nl &
                  //"           Expected: <"//expected//">"//nl &
                  //"             Actual: <"//actual//">"//nl &
                  //"    Rel. difference: <"//difference//"> (greater than tolerance of " &
                  //tolerance//")"
    end function far
end module test_harness
