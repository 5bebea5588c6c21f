module test_progress
    !! How long something takes, in words.
    use funit, only: TestMethod, TestSuite, assertEqual
    use lagrangia_kinds, only: dp
    use lagrangia_progress, only: about
    implicit none (type, external)
    private
    public :: progress_suite

contains

    function progress_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("progress")
        call suite%addTest(TestMethod("durations_have_their_unit", durations_have_their_unit))
    end function progress_suite

    subroutine durations_have_their_unit()
        !! From two of a unit on it is used; nothing overflows.
        call assertEqual("0 s", about(0.0_dp))
        call assertEqual("119 s", about(119.0_dp))
        call assertEqual("2 min", about(120.0_dp))
        call assertEqual("119 min", about(7140.0_dp))
        call assertEqual("2 h", about(7200.0_dp))
        call assertEqual("3 days", about(2.6e5_dp))
        call assertEqual("32 years", about(1e9_dp))
        call assertEqual("1000000000 years", about(huge(1.0_dp)))
    end subroutine durations_have_their_unit
end module test_progress
