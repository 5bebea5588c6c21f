module test_harness_fixtures
    !! Set-ups and tear-downs run when they must; places may be given; `assertNotEqual` and
    !! `assertIsNaN` fail when they must, in pFUnit's words.
    use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_quiet_nan, ieee_value
    use funit, only: SourceLocation, TestMethod, TestSuite, anyExceptions, assertEqual, &
                     assertExceptionRaised, assertFail, assertIsFinite, assertIsNaN, &
                     assertNotEqual, assertRelativelyEqual, assertSameShape, assertTrue
    use lagrangia_kinds, only: dp, i8
    implicit none (type, external)
    private
    public :: harness_fixtures_suite

    character(*), parameter :: nl = new_line("a")
    integer :: events(3) = 0   !! when a set-up, a test and a tear-down ran
    integer :: latest = 0

contains

    function harness_fixtures_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("harness_fixtures")
        call suite%addTest(TestMethod("set_up_runs_before", set_up_runs_before, setUp=set_up, &
                                      tearDown=tear_down))
        call suite%addTest(TestMethod("tear_down_has_run", tear_down_has_run))
        call suite%addTest(TestMethod("a_place_may_be_given", a_place_may_be_given))
        call suite%addTest(TestMethod("equal_values_fail", equal_values_fail))
    end function harness_fixtures_suite

    subroutine a_place_may_be_given()
        !! It changes no verdict and no words; the runner prints it.
        type(SourceLocation) :: here

        here = SourceLocation("test/test_harness.f90", 1)
        call assertTrue(.true., "true", location=here)
        call assertTrue(.false., "false", here)
        call assertExceptionRaised("false", location=here)
        call assertEqual(1.0_dp, 2.0_dp, 1.0_dp, "reals", location=here)
        call assertEqual(1, 1, message="integers", location=here)
        call assertEqual("a", "a", location=here)
        call assertNotEqual(1, 2, location=here)
        call assertRelativelyEqual(1.0_dp, 1.0_dp, 0.0_dp, location=here)
        call assertIsFinite(1.0_dp, location=here)
        call assertSameShape([1], [1], location=here)
        call assertFail("failed", here)
        call assertExceptionRaised("failed")
    end subroutine a_place_may_be_given

    subroutine set_up()
        !! The first of the three.
        latest = latest + 1
        events(1) = latest
    end subroutine set_up

    subroutine set_up_runs_before()
        !! And the tear-down has not run yet.
        latest = latest + 1
        events(2) = latest
        call assertEqual([1, 2, 0], events)
    end subroutine set_up_runs_before

    subroutine tear_down()
        !! The last.
        latest = latest + 1
        events(3) = latest
    end subroutine tear_down

    subroutine tear_down_has_run()
        !! Once, after the test before this one; alone, no test was before this one.
        call assertTrue(all(events == [1, 2, 3]) .or. all(events == 0), "set-up, test, tear-down")
    end subroutine tear_down_has_run

    subroutine equal_values_fail()
        !! `assertNotEqual` grants what `assertEqual` refuses, NaN aside: nobody grants that.
        real(dp) :: infinity, nan

        infinity = ieee_value(1.0_dp, ieee_positive_inf)
        nan = ieee_value(1.0_dp, ieee_quiet_nan)
        call assertNotEqual(1, 2)
        call assertNotEqual(1_i8, 2_i8)
        call assertNotEqual(1.0_dp, 2.0_dp)
        call assertNotEqual(1.0_dp, 2.0_dp, 0.75_dp)
        call assertNotEqual(-infinity, infinity)
        call assertIsNaN(nan)
        call assertNotEqual(3, 3)
        call assertExceptionRaised("AssertNotEqual failure:"//nl//"    Same value: <3>")
        call assertNotEqual(3_i8, 3_i8, message="a count")
        call assertExceptionRaised("a count"//nl//"AssertNotEqual failure:"//nl// &
                                   "    Same value: <3>")
        call assertNotEqual(1.0_dp, 1.5_dp, 0.5_dp, "half")
        call assertExceptionRaised( &
            "half"//nl//"AssertNotEqual failure:"//nl// &
            "    Same value: <1.5000000000000000>"//nl// &
            "    Difference: <0.50000000000000000> (less than or equal to tolerance of "// &
            "0.50000000000000000)")
        call assertNotEqual(infinity, infinity)
        call assertExceptionRaised( &
            "AssertNotEqual failure:"//nl//"    Same value: <Inf>"//nl// &
            "    Difference: <0.0000000000000000> (less than or equal to tolerance of "// &
            "0.0000000000000000)")
        call assertNotEqual(1.0_dp, nan)
        call assertTrue(anyExceptions(), "NaN is refused")
        call assertExceptionRaised()
        call assertIsNaN(1.0_dp, "a number")
        call assertExceptionRaised("a number")
    end subroutine equal_values_fail
end module test_harness_fixtures
