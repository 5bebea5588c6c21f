module test_progress
    !! How long something takes, in words.
    use funit, only: TestMethod, TestSuite, assertEqual
    use lagrangia_kinds, only: dp, i8
    use lagrangia_progress, only: about, pace, progress_line, stage
    implicit none (type, external)
    private
    public :: progress_suite

contains

    function progress_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("progress")
        call suite%addTest(TestMethod("durations_have_their_unit", durations_have_their_unit))
        call suite%addTest(TestMethod("lines_say_how_far_it_is", lines_say_how_far_it_is))
        call suite%addTest(TestMethod("parts_have_numbers", parts_have_numbers))
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

    subroutine lines_say_how_far_it_is()
        !! Of a run, and of a sweep, whose trajectories are counted; at either end no rest is left.
        call assertEqual("pendulum: 33 %, 4 s, 8 s left", &
                         progress_line("pendulum", "", 4.2_dp, 1_i8, 3_i8))
        call assertEqual("basins: 25 %, 10 s, 5.00E+02 trajectories/s, 30 s left", &
                         progress_line("basins", "trajectories", 10.0_dp, 5000_i8, 20000_i8))
        call assertEqual("basins: 99 %, 400 s, 2.50E+01 trajectories/s, 0 s left", &
                         progress_line("basins", "trajectories", 400.0_dp, 9999_i8, 10000_i8))
        call assertEqual("p: 0 %, 3 s", progress_line("p", "x", 3.9_dp, 0_i8, 7_i8))
        call assertEqual("p: 100 %, 3 s", progress_line("p", "x", 3.0_dp, 7_i8, 7_i8))
        call assertEqual("p: 0 %, 3 s", progress_line("p", "x", 3.0_dp, 0_i8, 0_i8))
        call assertEqual(", 2 h left", pace("", 7200.0_dp, 1_i8, 2_i8))
    end subroutine lines_say_how_far_it_is

    subroutine parts_have_numbers()
        !! Which part of how many; one alone has none.
        call assertEqual("check pendulum, 2 of 14", stage("check", "pendulum  ", 2, 14))
        call assertEqual("stress zeno", stage("stress", "zeno", 1, 1))
    end subroutine parts_have_numbers
end module test_progress
