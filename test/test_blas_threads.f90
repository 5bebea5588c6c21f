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
    end function blas_threads_suite

    subroutine there_is_one()
        !! Since the start of the runner; fails without that where OpenBLAS has found more cores.
        call assertEqual(1, blas_threads())
    end subroutine there_is_one
end module test_blas_threads
