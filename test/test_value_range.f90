module test_value_range
    !! What a picture must know of a column.
    use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, assertEqual
    use lagrangia_kinds, only: dp
    use lagrangia_value_range, only: range_of, value_range_t
    implicit none (type, external)
    private
    public :: value_range_suite

contains

    function value_range_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("value_range")
        call suite%addTest(TestMethod("values_are_seen", values_are_seen))
        call suite%addTest(TestMethod("nothing_was_seen", nothing_was_seen))
        call suite%addTest(TestMethod("gaps_are_no_values", gaps_are_no_values))
    end function value_range_suite

    subroutine values_are_seen()
        !! Ends, smallest magnitude, zeros; a plateau between rising and falling is one turn.
        type(value_range_t) :: range

        range = range_of([0.0_dp, 2.0_dp, 2.0_dp, -3.0_dp, 0.0_dp, -1e-9_dp, -1e-9_dp, -2e-9_dp])
        call assertEqual(-3.0_dp, range%low)
        call assertEqual(2.0_dp, range%high)
        call assertEqual(3.0_dp, range%largest())
        call assertEqual(1e-9_dp, range%least)
        call assertEqual(2, int(range%zeros))
        call assertEqual(8, int(range%count))
        call assertEqual(3, int(range%turns))
        range = range_of([1.0_dp, 2.0_dp, 3.0_dp])
        call assertEqual(0, int(range%turns))
        range = range_of([-5.0_dp])
        call assertEqual(-5.0_dp, range%high)
        call assertEqual(5.0_dp, range%largest())
    end subroutine values_are_seen

    subroutine nothing_was_seen()
        !! Then no magnitude is any.
        type(value_range_t) :: range

        call assertEqual(0.0_dp, range%largest())
        call assertEqual(0, int(range%count))
    end subroutine nothing_was_seen

    subroutine gaps_are_no_values()
        !! Neither ends nor turns; they are counted apart.
        type(value_range_t) :: range
        real(dp) :: nan, infinite

        nan = ieee_value(nan, ieee_quiet_nan)
        infinite = ieee_value(infinite, ieee_positive_inf)
        range = range_of([nan, 1.0_dp, infinite, 2.0_dp, nan, 3.0_dp, -infinite])
        call assertEqual(4, int(range%gaps), message="gaps")
        call assertEqual(3, int(range%count), message="values")
        call assertEqual(0, int(range%turns), message="turns")
        call assertEqual(1.0_dp, range%low, message="lowest")
        call assertEqual(3.0_dp, range%largest(), message="largest")
    end subroutine gaps_are_no_values
end module test_value_range
