module test_blas_threads
    !! One thread of BLAS, so that its results do not depend on the cores there are.
    use funit, only: TestMethod, TestSuite, assertEqual
    use lagrangia_blas_threads, only: blas_threads
    implicit none (type, external)
    private
    public :: blas_threads_suite

contains

    function blas_threads_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("blas_threads")
        call suite%addTest(TestMethod("there_is_one", there_is_one))
        call suite%addTest(TestMethod("none_was_started", none_was_started))
    end function blas_threads_suite

    subroutine there_is_one()
        !! Where a version of OpenBLAS has other names for its variables, since the runner began.
        call assertEqual(1, blas_threads())
    end subroutine there_is_one

    subroutine none_was_started()
        !! This process is one thread (Linux tells): fails where OpenBLAS counts more than one core
        !! and OPENBLAS_NUM_THREADS does not keep it from starting a thread on each.
        character(80) :: line
        integer :: unit, status

        open (newunit=unit, file="/proc/self/status", action="read", status="old", iostat=status)
        if (status /= 0) return
        do
            read (unit, "(a)", iostat=status) line
            if (status /= 0) exit
            if (line(:8) == "Threads:") call assertEqual("1", trim(adjustl(line(10:))))
        end do
        close (unit)
    end subroutine none_was_started
end module test_blas_threads
