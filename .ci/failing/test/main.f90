module failing_tests
    !! Tests that fail in every way a runner has to show.
    use, intrinsic :: iso_fortran_env, only: output_unit, real64
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFail, &
                     assertGreaterThan, assertTrue
    implicit none (type, external)
    private
    public :: announce, load_tests

contains

    function load_tests() result(suite)
        !! All suites.
        type(TestSuite) :: suite

        suite = TestSuite("all")
        call suite%addTest(failing_suite())
    end function load_tests

    function failing_suite() result(suite)
        !! Enough tests to fill more than one line with marks.
        type(TestSuite) :: suite
        integer :: i

        suite = TestSuite("failing  ")
        do i = 1, 76
            call suite%addTest(TestMethod("passes", passes))
        end do
        call suite%addTest(TestMethod("fails_once  ", fails_once))
        call suite%addTest(TestMethod("fails_twice", fails_twice))
        call suite%addTest(TestMethod("fails_without_words", fails_without_words))
        call suite%addTest(TestMethod("fails_and_returns", fails_and_returns))
        call suite%addTest(TestMethod("passes", passes))
        call suite%addTest(inner_suite())
    end function failing_suite

    function inner_suite() result(suite)
        !! A suite within a suite.
        type(TestSuite) :: suite

        suite = TestSuite("inner")
        call suite%addTest(TestMethod("fails_once", fails_once))
        call suite%addTest(TestMethod("passes", passes))
    end function inner_suite

    subroutine announce()
        !! Show when the extra work is done.
        write (output_unit, "(a)") "the runner did the extra work"
    end subroutine announce

    subroutine passes()
        call assertTrue(.true., "never said")
    end subroutine passes

    subroutine fails_once()
        call assertEqual([1, 2], [1, 3], "a message")
    end subroutine fails_once

    subroutine fails_twice()
        call assertEqual("expected", "found")
        call assertGreaterThan(1.0_real64, 2.0_real64, 0.5_real64, message="second  ")
    end subroutine fails_twice

    subroutine fails_without_words()
        call assertTrue(.false.)
    end subroutine fails_without_words

    subroutine fails_and_returns()
        call assertFail("the first failure"//new_line("a")//"on two lines  ")
        if (anyExceptions()) return
        call assertFail("never reached")
    end subroutine fails_and_returns
end module failing_tests

program main
    !! Run the tests that fail: 83 run, 5 fail, status 2.
    use failing_tests, only: announce, load_tests
    use funit, only: finalize, initialize, run
    implicit none (type, external)
    logical :: ok

    call initialize(announce)
    ok = run(load_tests)
    call finalize(announce, ok)
end program main
