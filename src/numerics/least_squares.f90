module lagrangia_least_squares
    !! Small least-squares problems, and a test of definiteness. LAPACK.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_kinds, only: dp, this_part_needs_real64
    implicit none (type, external)
    private
    public :: least_squares, smallest_pivot

    interface
        pure subroutine dgels(trans, m, n, nrhs, a, lda, b, ldb, work, lwork, info)
            import :: dp
            implicit none (type, external)
            character, intent(in) :: trans
            integer, intent(in) :: m, n, nrhs, lda, ldb, lwork
            real(dp), intent(inout) :: a(lda, n), b(ldb, nrhs)
            real(dp), intent(out) :: work(lwork)
            integer, intent(out) :: info
        end subroutine dgels

        pure subroutine dpotrf(uplo, n, a, lda, info)
            import :: dp
            implicit none (type, external)
            character, intent(in) :: uplo
            integer, intent(in) :: n, lda
            real(dp), intent(inout) :: a(lda, n)
            integer, intent(out) :: info
        end subroutine dpotrf
    end interface

contains

    pure subroutine least_squares(a, c, x, error)
        !! The `x` that makes \(\lVert Ax - c\rVert\) least; \(A\) of full rank, (m, n), m >= n.
        !!
        !! Source: LAPACK Users' Guide, 3rd ed., sec. 2.3.2; `dgels`.
        real(dp), intent(in) :: a(:, :), c(:)
        real(dp), intent(out) :: x(:)                     !! (n); zero after an error
        type(error_t), allocatable, intent(out) :: error  !! shapes, NaN, rank
        real(dp) :: a_work(size(a, 1), size(a, 2)), c_work(size(c), 1), work(64*(size(a) + 1))
        integer :: info

        x = 0.0_dp
        if (size(a, 1) /= size(c) .or. size(a, 2) /= size(x) .or. size(x) > size(c)) then
            call fail(error, "least squares: shapes do not match", status_library)
            return
        end if
        if (.not. (all(ieee_is_finite(a)) .and. all(ieee_is_finite(c)))) then
            call fail(error, "least squares: not every coefficient is finite", status_library)
            return
        end if
        if (size(x) == 0) return
        a_work = a
        c_work(:, 1) = c
        call dgels("N", size(c), size(x), 1, a_work, size(c), c_work, size(c), work, size(work), &
                   info)
        if (info /= 0 .or. .not. all(ieee_is_finite(c_work))) then
            call fail(error, "least squares: the columns depend on each other", status_library)
        else
            x = c_work(:size(x), 1)
        end if
    end subroutine least_squares

    pure function smallest_pivot(matrix) result(pivot)
        !! Of the Cholesky factorisation of a symmetric matrix scaled to a diagonal of ones: 1 if
        !! it is diagonal, at most 0 if it is not positive definite; also if it is not finite.
        !!
        !! Source: LAPACK Users' Guide, 3rd ed., sec. 2.4.1; `dpotrf`.
        real(dp), intent(in) :: matrix(:, :)
        real(dp) :: pivot
        real(dp), dimension(size(matrix, 1), size(matrix, 1)) :: a
        integer :: i, j, n, info

        n = size(matrix, 1)
        pivot = 0.0_dp
        do i = 1, n
            if (.not. (matrix(i, i) > 0.0_dp .and. all(ieee_is_finite(matrix(:, i))))) return
        end do
        do j = 1, n
            do i = 1, n
                a(i, j) = matrix(i, j)/sqrt(matrix(i, i))/sqrt(matrix(j, j))
            end do
        end do
        call dpotrf("L", n, a, max(1, n), info)
        if (info /= 0) return
        pivot = 1.0_dp
        do i = 1, n
            pivot = min(pivot, a(i, i)**2)
        end do
    end function smallest_pivot
end module lagrangia_least_squares
