module test_lapack
    !! Linear systems are solved or refused.
    !!
    !! Right-hand sides are built from the solution in integers, so both are exact. Gaussian
    !! elimination loses a few times n epsilon times the condition of the balanced matrix, below 100
    !! in all that are solved here: 1e3 epsilon.
    use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertRelativelyEqual, assertTrue
    use lagrangia_errors, only: error_t, status_library
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use test_saddle_point, only: saddle_point_suite
    implicit none (type, external)
    private
    public :: lapack_suite

    real(dp), parameter :: loss = 1e3_dp*epsilon(1.0_dp)

contains

    function lapack_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("lapack")
        call suite%addTest(TestMethod("solves_an_unsymmetric_system", solves_an_unsymmetric_system))
        call suite%addTest(TestMethod("solves_a_saddle_point", solves_a_saddle_point))
        call suite%addTest(TestMethod("masses_may_differ_by_1e48", masses_may_differ_by_1e48))
        call suite%addTest(TestMethod("nothing_to_solve", nothing_to_solve))
        call suite%addTest(TestMethod("refuses_a_singular_matrix", refuses_a_singular_matrix))
        call suite%addTest(TestMethod("refuses_what_rounding_made_regular", &
                                      refuses_what_rounding_made_regular))
        call suite%addTest(TestMethod("refuses_what_is_not_finite", refuses_what_is_not_finite))
        call suite%addTest(TestMethod("refuses_shapes_that_differ", refuses_shapes_that_differ))
        call suite%addTest(TestMethod("refuses_an_overflow", refuses_an_overflow))
        call suite%addTest(saddle_point_suite())
    end function lapack_suite

    subroutine solves_an_unsymmetric_system()
        !! The transpose would give something else; a zero pivot asks for an exchange.
        real(dp) :: matrix(3, 3), kept(3, 3), rhs(3), x(3)
        type(error_t), allocatable :: error

        matrix = reshape([0.0_dp, 2.0_dp, -4.0_dp, 3.0_dp, 1.0_dp, 2.0_dp, 5.0_dp, -7.0_dp, &
                          6.0_dp], [3, 3])
        kept = matrix
        rhs = [-9.0_dp, 57.0_dp, -38.0_dp]
        call solve_linear(matrix, rhs, x, error)
        call assertFalse(allocated(error), "no error: solves an unsymmetric system")
        call assertEqual([4.0_dp, 7.0_dp, -6.0_dp], x, tolerance=7.0_dp*loss)
        call assertEqual(kept, matrix)
        call assertEqual([-9.0_dp, 57.0_dp, -38.0_dp], rhs)
    end subroutine solves_an_unsymmetric_system

    subroutine solves_a_saddle_point()
        !! Gauss's principle for Atwood's machine: \(a_1 = -a_2 = (m_1 - m_2) g/(m_1 + m_2)\).
        real(dp), parameter :: m1 = 3.0_dp, m2 = 2.0_dp, g = 9.81_dp
        real(dp) :: x(3)
        type(error_t), allocatable :: error

        call solve_linear(reshape([m1, 0.0_dp, 1.0_dp, 0.0_dp, m2, 1.0_dp, 1.0_dp, 1.0_dp, &
                                   0.0_dp], [3, 3]), [m1*g, m2*g, 0.0_dp], x, error)
        call assertFalse(allocated(error), "no error: solves a saddle point")
        call assertEqual([1.962_dp, -1.962_dp, 23.544_dp], x, tolerance=24.0_dp*loss)
    end subroutine solves_a_saddle_point

    subroutine masses_may_differ_by_1e48()
        !! \(D A D\) with powers of two in \(D\): unbalanced it would look singular.
        real(dp), parameter :: d = 2.0_dp**40
        real(dp) :: x(2)
        type(error_t), allocatable :: error

        call solve_linear(reshape([2.0_dp*d**2, 1.0_dp, 1.0_dp, 3.0_dp/d**2], [2, 2]), &
                          [3.0_dp*d, -16.0_dp/d], x, error)
        call assertFalse(allocated(error), "no error: masses may differ by 1e48")
        call assertRelativelyEqual(5.0_dp/d, x(1), loss)
        call assertRelativelyEqual(-7.0_dp*d, x(2), loss)
    end subroutine masses_may_differ_by_1e48

    subroutine nothing_to_solve()
        !! No unknowns, no error.
        real(dp) :: matrix(0, 0), none(0)
        real(dp) :: x(0)
        type(error_t), allocatable :: error

        none = 0.0_dp
        matrix = 0.0_dp
        call solve_linear(matrix, none, x, error)
        call assertFalse(allocated(error), "no error: nothing to solve")
    end subroutine nothing_to_solve

    subroutine refuses_a_singular_matrix()
        !! A zero pivot, and a zero row.
        call refused([1.0_dp, 2.0_dp, 2.0_dp, 4.0_dp], [1.0_dp, 1.0_dp], &
                     "linear system: the matrix is singular")
        call refused([1.0_dp, 0.0_dp, 2.0_dp, 0.0_dp], [1.0_dp, 1.0_dp], &
                     "linear system: the matrix is singular")
    end subroutine refuses_a_singular_matrix

    subroutine refuses_what_rounding_made_regular()
        !! A third of seven tenths is not three tenths: the second pivot is rounding, not zero.
        call refused([0.1_dp, 0.7_dp, 0.3_dp, 2.1_dp], [1.0_dp, 1.0_dp], &
                     "linear system: the matrix is singular")
    end subroutine refuses_what_rounding_made_regular

    subroutine refuses_what_is_not_finite()
        !! NaN in the matrix would come back with LAPACK's blessing.
        real(dp) :: bad

        bad = ieee_value(1.0_dp, ieee_quiet_nan)
        call refused([1.0_dp, bad, 2.0_dp, 5.0_dp], [1.0_dp, 1.0_dp], &
                     "linear system: not every coefficient is finite")
        bad = ieee_value(1.0_dp, ieee_positive_inf)
        call refused([1.0_dp, 0.0_dp, 2.0_dp, 5.0_dp], [1.0_dp, bad], &
                     "linear system: not every coefficient is finite")
    end subroutine refuses_what_is_not_finite

    subroutine refuses_shapes_that_differ()
        !! Rows, columns and unknowns.
        real(dp) :: x(2), longer(3)
        type(error_t), allocatable :: error

        call solve_linear(reshape([1.0_dp, 2.0_dp], [1, 2]), [1.0_dp, 1.0_dp], x, error)
        call assertTrue(allocated(error), message="rows")
        call solve_linear(reshape([1.0_dp, 2.0_dp], [2, 1]), [1.0_dp, 1.0_dp], x, error)
        call assertTrue(allocated(error), message="columns")
        call solve_linear(reshape([1.0_dp, 2.0_dp, 3.0_dp, 1.0_dp], [2, 2]), [1.0_dp, 1.0_dp], &
                          longer, error)
        call assertTrue(allocated(error), message="unknowns")
        if (anyExceptions()) return
        call assertEqual("linear system: shapes do not match", error%message)
        call assertEqual(status_library, error%status)
    end subroutine refuses_shapes_that_differ

    subroutine refuses_an_overflow()
        !! A regular matrix, a solution of 1e600.
        call refused([1e-300_dp, 0.0_dp, 0.0_dp, 1.0_dp], [1e300_dp, 1.0_dp], &
                     "linear system: the solution overflows")
    end subroutine refuses_an_overflow

    subroutine refused(entries, rhs, message)
        !! The 2 x 2 system fails with `message` and gives zeros.
        real(dp), intent(in) :: entries(4), rhs(2)
        character(*), intent(in) :: message
        real(dp) :: x(2)
        type(error_t), allocatable :: error

        x = -1.0_dp
        call solve_linear(reshape(entries, [2, 2]), rhs, x, error)
        call assertTrue(allocated(error), message=message)
        if (anyExceptions()) return
        call assertEqual(message, error%message)
        call assertEqual(status_library, error%status)
        call assertEqual([0.0_dp, 0.0_dp], x)
    end subroutine refused
end module test_lapack
