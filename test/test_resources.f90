module test_resources
    !! What a command lacks is said before it is missed.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t, status_library
    use lagrangia_kinds, only: dp
    use lagrangia_resources, only: check_memory, check_stack
    use test_scratch, only: exit_status, limit_stack
    implicit none (type, external)
    private
    public :: resources_suite

contains

    function resources_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("resources")
        call suite%addTest(TestMethod("memory", memory))
        call suite%addTest(TestMethod("stack", stack))
    end function resources_suite

    subroutine memory()
        !! A megabyte can be had, 1e18 bytes cannot, nor more than can be counted.
        type(error_t), allocatable :: error

        call check_memory(1e6_dp, "a test", error)
        call assertFalse(allocated(error), message="a megabyte")
        call check_memory(1e18_dp, "a test", error)
        call assertTrue(allocated(error), message="1e18 bytes")
        if (.not. allocated(error)) return
        call assertEqual("not enough memory: a test needs 1000000000000 MB more", error%message)
        call assertEqual(status_library, error%status)
        call check_memory(1e300_dp, "a test", error)
        call assertTrue(allocated(error), message="1e300 bytes")
    end subroutine memory

    subroutine stack()
        !! 16 kB there are, else no test would run; where 64 may be, 65 are refused.
        type(error_t), allocatable :: error

        call check_stack(16, error)
        call assertFalse(allocated(error), message="16 kB")
        call assertEqual(0, exit_status(enough_stack), "as much as there may be")
        call assertEqual(status_library, exit_status(little_stack), "1 kB more")
    end subroutine stack

    function enough_stack() result(status)
        !! See `stack_status`.
        integer :: status

        status = stack_status(64)
    end function enough_stack

    function little_stack() result(status)
        !! See `stack_status`.
        integer :: status

        status = stack_status(65)
    end function little_stack

    function stack_status(needed) result(status)
        !! The status of the error where 64 kB may be: 0 if there is none, 99 if it has other words.
        integer, intent(in) :: needed  !! kB
        integer :: status
        type(error_t), allocatable :: error

        call limit_stack(64)
        call check_stack(needed, error)
        status = 0
        if (.not. allocated(error)) return
        status = error%status
        if (error%message /= "the stack may hold 64 kB only, and 65 are needed: 'ulimit -s "// &
            "8192' gives more") status = 99
    end function stack_status
end module test_resources
