module test_errors
    !! Errors are values that say what went wrong.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_errors, only: error_t, fail, message_length, status_numbers, status_usage
    implicit none (type, external)
    private
    public :: errors_suite

contains

    function errors_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("errors")
        call suite%addTest(TestMethod("fail_sets_the_message", fail_sets_the_message))
        call suite%addTest(TestMethod("fail_sets_the_status", fail_sets_the_status))
        call suite%addTest(TestMethod("context_goes_before", context_goes_before))
    end function errors_suite

    subroutine fail_sets_the_message()
        !! The message is kept as it is given; without a status it is a usage error.
        type(error_t), allocatable :: error

        call fail(error, "no such system: pendulun")
        call assertTrue(allocated(error), "an error: fail sets the message")
        if (anyExceptions()) return
        call assertEqual("no such system: pendulun", error%message)
        call assertEqual(len("no such system: pendulun"), len(error%message))
        call assertEqual(status_usage, error%status)
    end subroutine fail_sets_the_message

    subroutine fail_sets_the_status()
        !! A later failure replaces an earlier one, status and all.
        type(error_t), allocatable :: error

        call fail(error, "energy is not a number", status_numbers)
        call assertEqual(status_numbers, error%status)
        call fail(error, "unknown key")
        call assertEqual("unknown key", error%message)
        call assertEqual(status_usage, error%status)
    end subroutine fail_sets_the_status

    subroutine context_goes_before()
        !! Contexts stack, the widest first, and leave the status alone; a long one is shortened.
        type(error_t), allocatable :: error

        call fail(error, "overflow", status_numbers)
        call error%add_context("&pendulum")
        call error%add_context("scenes/a.nml")
        call assertEqual("scenes/a.nml: &pendulum: overflow", error%message)
        call assertEqual(status_numbers, error%status)
        call error%add_context(repeat("long/", 100)//"a.nml")
        call assertEqual(message_length, len(error%message))
        call assertEqual("/a.nml: scenes/a.nml: &pendulum: overflow", error%message(249:))
    end subroutine context_goes_before
end module test_errors
