module crashing_tests
    !! Tests that do not come to their end, after a failure that must not be lost.
    use, intrinsic :: iso_c_binding, only: c_int
    use funit, only: TestMethod, TestSuite, assertTrue
    implicit none (type, external)
    private
    public :: load_tests

    interface
        function c_raise(number) bind(c, name="raise") result(status)
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: number
            integer(c_int) :: status
        end function c_raise
    end interface

contains

    function load_tests() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("crashing")
        call suite%addTest(TestMethod("passes", passes))
        call suite%addTest(TestMethod("is_killed", is_killed))
        call suite%addTest(TestMethod("stops", stops))
        call suite%addTest(TestMethod("breaks_a_bound", breaks_a_bound))
    end function load_tests

    subroutine passes()
        call assertTrue(.true., "never said")
    end subroutine passes

    subroutine is_killed()
        call assertTrue(.false., "before the kill")
        if (c_raise(11_c_int) /= 0) return
    end subroutine is_killed

    subroutine stops()
        call assertTrue(.false., "before the stop")
        stop 3
    end subroutine stops

    subroutine breaks_a_bound()
        integer :: list(3), i

        list = 0
        call assertTrue(.false., "before the bound")
        do i = 1, 4
            call assertTrue(list(i) == 0, "an element")
        end do
    end subroutine breaks_a_bound
end module crashing_tests

program main
    !! Run the tests that crash, one by `--filter`.
    use crashing_tests, only: load_tests
    use funit, only: finalize, initialize, run, stub
    implicit none (type, external)
    logical :: ok

    call initialize(stub)
    ok = run(load_tests)
    call finalize(stub, ok)
end program main
