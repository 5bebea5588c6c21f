module test_lapack_band
    !! Band systems are solved or refused; negative eigenvalues are counted.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t, status_library
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: count_negative, least_squares, lowest_mode, solve_band
    use lagrangia_null_space, only: null_space
    use lagrangia_richardson, only: extrapolated
    implicit none (type, external)
    private
    public :: lapack_band_suite

    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    function lapack_band_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("lapack_band")
        call suite%addTest(TestMethod("solves_two_diagonals_each_side", &
                                      solves_two_diagonals_each_side))
        call suite%addTest(TestMethod("refuses_bad_bands", refuses_bad_bands))
        call suite%addTest(TestMethod("counts_negative_eigenvalues", counts_negative_eigenvalues))
        call suite%addTest(TestMethod("refuses_bad_tridiagonals", refuses_bad_tridiagonals))
        call suite%addTest(TestMethod("finds_the_lowest_mode", finds_the_lowest_mode))
        call suite%addTest(TestMethod("extrapolates_even_powers", extrapolates_even_powers))
        call suite%addTest(TestMethod("nothing_half_or_too_much_to_solve", &
                                      nothing_half_or_too_much_to_solve))
    end function lapack_band_suite

    subroutine solves_two_diagonals_each_side()
        !! Whole numbers, unsymmetric, so that a transposed band gives something else.
        real(dp) :: matrix(5, 5), band(5, 5), x(5), truth(5)
        type(error_t), allocatable :: error
        integer :: i, j

        matrix = 0.0_dp
        band = 0.0_dp
        do j = 1, 5
            do i = max(1, j - 2), min(5, j + 2)
                matrix(i, j) = 7.0_dp*merge(1, 0, i == j) + i - 3*j + i*j**2
                band(3 + i - j, j) = matrix(i, j)
            end do
        end do
        truth = [2.0_dp, -1.0_dp, 3.0_dp, 5.0_dp, -4.0_dp]
        call solve_band(band, matmul(matrix, truth), x, error)
        call assertFalse(allocated(error), "no error: solves two diagonals each side")
        call assertEqual(truth, x, 1e-12_dp)
    end subroutine solves_two_diagonals_each_side

    subroutine finds_the_lowest_mode()
        !! Of a chain of n equal springs and masses: \(2 - 2\cos\frac\pi{n+1}\) and half a sine;
        !! of one number, itself; refusals by their message.
        integer, parameter :: n = 9
        real(dp) :: value, vector(n), other(2), half_sine(n)
        type(error_t), allocatable :: error
        integer :: k

        call lowest_mode([(2.0_dp, k=1, n)], [(-1.0_dp, k=1, n - 1)], value, vector, error)
        call assertFalse(allocated(error), "chain")
        call assertEqual(2.0_dp - 2.0_dp*cos(pi/(n + 1)), value, 1e-14_dp)
        half_sine = [(sin(k*pi/(n + 1)), k=1, n)]
        half_sine = half_sine/norm2(half_sine)
        call assertEqual(half_sine, sign(1.0_dp, vector(1))*vector, 1e-13_dp)
        call lowest_mode([-3.0_dp], vector(:0), value, other(:1), error)
        call assertFalse(allocated(error), "one number")
        call assertEqual(-3.0_dp, value, 1e-15_dp)
        call lowest_mode([1.0_dp, 2.0_dp], vector(:0), value, other, error)
        call assertTrue(allocated(error), "shapes")
        if (allocated(error)) call assertEqual("tridiagonal matrix: shapes do not match", &
                                               error%message)
        call lowest_mode([1.0_dp, ieee_value(1.0_dp, ieee_quiet_nan)], [1.0_dp], value, other, &
                         error)
        call assertTrue(allocated(error), "NaN")
        if (allocated(error)) call assertEqual("tridiagonal matrix: not every element is finite", &
                                               error%message)
        call assertEqual(0.0_dp, maxval(abs(other)), 0.0_dp, "zero after an error")
    end subroutine finds_the_lowest_mode

    subroutine refuses_bad_bands()
        !! Each by its message.
        real(dp) :: x(2)
        type(error_t), allocatable :: error

        call solve_band(reshape([0.0_dp, 1.0_dp, 2.0_dp, 2.0_dp, 4.0_dp, 0.0_dp], [3, 2]), &
                        [1.0_dp, 1.0_dp], x, error)
        call expect("band system: the matrix is singular")
        call solve_band(reshape([0.0_dp, 1.0_dp, 2.0_dp, 2.0_dp], [2, 2]), [1.0_dp, 1.0_dp], x, &
                        error)
        call expect("band system: shapes do not match")
        call solve_band(reshape([1.0_dp, 2.0_dp], [1, 2]), &
                        [1.0_dp, ieee_value(1.0_dp, ieee_quiet_nan)], x, error)
        call expect("band system: not every coefficient is finite")
    contains
        subroutine expect(message)
            character(*), intent(in) :: message

            call assertTrue(allocated(error), message)
            if (anyExceptions()) return
            call assertEqual(message, error%message)
            call assertEqual(status_library, error%status)
            call assertEqual([0.0_dp, 0.0_dp], x)
        end subroutine expect
    end subroutine refuses_bad_bands

    subroutine counts_negative_eigenvalues()
        !! \(2 - 2\cos(n\pi/(N + 1)) - s\): the eigenvalues of the shifted second difference.
        integer, parameter :: n = 40
        real(dp) :: off(n - 1), diagonal(n), shift, first(1), none(0)
        type(error_t), allocatable :: error
        integer :: negative, k, j

        off = -1.0_dp
        do k = 0, n
            shift = 2.0_dp - 2.0_dp*cos((k + 0.5_dp)*pi/(n + 1))
            diagonal = 2.0_dp - shift
            call count_negative(diagonal, off, negative, error)
            call assertFalse(allocated(error), "no error: counts negative eigenvalues")
            call assertEqual(count([(j < k + 0.5_dp, j=1, n)]), negative)
        end do
        first = -1e-300_dp
        none = 0.0_dp
        call count_negative(first, none, negative, error)
        call assertEqual(1, negative)
        first = 0.0_dp
        call count_negative(first, none, negative, error)
        call assertEqual(0, negative)
        call count_negative(none, none, negative, error)
        call assertEqual(0, negative)
        call assertFalse(allocated(error), "no error: counts negative eigenvalues")
    end subroutine counts_negative_eigenvalues

    subroutine refuses_bad_tridiagonals()
        !! Each by its message.
        type(error_t), allocatable :: error
        integer :: negative

        call count_negative([1.0_dp, 2.0_dp], [1.0_dp, 1.0_dp], negative, error)
        call assertTrue(allocated(error), "an error: refuses bad tridiagonals")
        if (anyExceptions()) return
        call assertEqual("tridiagonal matrix: shapes do not match", error%message)
        call count_negative([1.0_dp, ieee_value(1.0_dp, ieee_quiet_nan)], [1.0_dp], negative, error)
        call assertTrue(allocated(error), "an error: refuses bad tridiagonals")
        if (anyExceptions()) return
        call assertEqual("tridiagonal matrix: not every element is finite", error%message)
    end subroutine refuses_bad_tridiagonals

    subroutine extrapolates_even_powers()
        !! \(3 - 2h^2 + 5h^4 - h^6\) at four steps is known at none; at three it is not.
        real(dp) :: values(4), h(4)

        h = [0.8_dp, 0.4_dp, 0.2_dp, 0.1_dp]
        values = 3.0_dp - 2.0_dp*h**2 + 5.0_dp*h**4 - h**6
        call assertEqual(3.0_dp, extrapolated(values), 1e-14_dp)
        call assertTrue(abs(extrapolated(values(:3)) - 3.0_dp) > 1e-6_dp, &
                        "abs(extrapolated(values(:3)) - 3.0) > 1e-6")
        call assertEqual(values(1), extrapolated(values(:1)), 0.0_dp)
    end subroutine extrapolates_even_powers

    subroutine nothing_half_or_too_much_to_solve()
        !! No equations at all are solved; NaN on one side, a column of zeros, a vector that is too
        !! long are refused.
        type(error_t), allocatable :: error
        real(dp), allocatable :: basis(:, :)
        real(dp) :: none(0), nothing(0), one(1), two(2), nan, value

        nan = ieee_value(1.0_dp, ieee_quiet_nan)
        call solve_band(reshape([real(dp) ::], [1, 0]), none, nothing, error)
        call assertFalse(allocated(error), "a band of no row")
        call least_squares(reshape([real(dp) ::], [0, 0]), none, nothing, error)
        call assertFalse(allocated(error), "no squares")
        call least_squares(reshape([1.0_dp, 2.0_dp, 0.0_dp, 1.0_dp, 0.0_dp, 3.0_dp], [3, 2]), &
                           [1.0_dp, nan, 2.0_dp], two, error)
        call expect("least squares: not every coefficient is finite")
        call least_squares(reshape([1.0_dp, nan, 0.0_dp, 1.0_dp, 0.0_dp, 3.0_dp], [3, 2]), &
                           [1.0_dp, 1.0_dp, 2.0_dp], two, error)
        call expect("least squares: not every coefficient is finite")
        call least_squares(reshape([1.0_dp, 2.0_dp, 3.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], [3, 2]), &
                           [1.0_dp, 1.0_dp, 2.0_dp], two, error)
        call expect("least squares: the columns depend on each other")
        call assertEqual([0.0_dp, 0.0_dp], two, tolerance=0.0_dp, message="nothing is found")
        call lowest_mode([2.0_dp], none, value, two, error)
        call expect("tridiagonal matrix: shapes do not match")
        call lowest_mode(none, none, value, nothing, error)
        call expect("tridiagonal matrix: shapes do not match")
        call lowest_mode([2.0_dp], none, value, one, error)
        call assertFalse(allocated(error), "one row is enough")
        call assertEqual(2.0_dp, value, tolerance=1e-15_dp, message="its value")
        call null_space(reshape([real(dp) ::], [2, 0]), basis, error)
        call expect("null space: a matrix needs as many rows as columns")
    contains
        subroutine expect(message)
            character(*), intent(in) :: message

            call assertTrue(allocated(error), "refused: "//message)
            if (allocated(error)) call assertEqual(message, error%message)
        end subroutine expect
    end subroutine nothing_half_or_too_much_to_solve
end module test_lapack_band
