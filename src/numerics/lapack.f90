module lagrangia_lapack
    !! The one module that touches LAPACK: our errors on our side, the caller's arrays untouched.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_kinds, only: dp, this_part_needs_real64
    implicit none (type, external)
    private
    public :: solve_linear

    interface
        pure subroutine dgesvx(fact, trans, n, nrhs, a, lda, af, ldaf, ipiv, equed, r, c, b, &
                               ldb, x, ldx, rcond, ferr, berr, work, iwork, info)
            import :: dp
            implicit none (type, external)
            character, intent(in) :: fact, trans
            integer, intent(in) :: n, nrhs, lda, ldaf, ldb, ldx
            real(dp), intent(inout) :: a(lda, n), af(ldaf, n), r(n), c(n), b(ldb, nrhs)
            integer, intent(inout) :: ipiv(n)
            character, intent(inout) :: equed
            real(dp), intent(out) :: x(ldx, nrhs), rcond, ferr(nrhs), berr(nrhs), work(4*n)
            integer, intent(out) :: iwork(n), info
        end subroutine dgesvx
    end interface

contains

    pure subroutine solve_linear(matrix, rhs, x, error)
        !! Solve \(A x = b\) for a small dense \(A\).
        !!
        !! LAPACK's expert driver: unlike `dgesv` it balances rows and columns first, so masses of
        !! 1e-24 and 1e24 may meet in one matrix, and it refuses a matrix that only rounding keeps
        !! from being singular.
        !!
        !! Source: LAPACK Users' Guide, 3rd ed., sec. 2.3.1 and 4.4; `dgesvx`.
        real(dp), intent(in) :: matrix(:, :)              !! \(A\), (n, n)
        real(dp), intent(in) :: rhs(:)                    !! \(b\), (n)
        real(dp), intent(out) :: x(:)                     !! (n); zero after an error
        type(error_t), allocatable, intent(out) :: error  !! shapes, NaN, singular, overflow
        real(dp), dimension(size(rhs), size(rhs)) :: a, factors
        real(dp), dimension(size(rhs), 1) :: b, solution
        real(dp), dimension(size(rhs)) :: row_scale, column_scale
        real(dp) :: forward(1), backward(1), rcond, work(4*size(rhs))
        integer :: n, info, pivots(size(rhs)), iwork(size(rhs))
        character :: equed

        x = 0.0_dp
        n = size(rhs)
        if (size(x) /= n .or. any(shape(matrix) /= n)) then
            call fail(error, "linear system: shapes do not match", status_library)
            return
        end if
        if (.not. (all(ieee_is_finite(matrix)) .and. all(ieee_is_finite(rhs)))) then
            call fail(error, "linear system: not every coefficient is finite", status_library)
            return
        end if
        if (n == 0) return
        a = matrix
        b(:, 1) = rhs
        call dgesvx("e", "n", n, 1, a, n, factors, n, pivots, equed, row_scale, column_scale, b, &
                    n, solution, n, rcond, forward, backward, work, iwork, info)
        if (info < 0) then
            call fail(error, "linear system: LAPACK refused an argument of dgesvx", status_library)
        else if (info > 0) then
            call fail(error, "linear system: the matrix is singular", status_library)
        else if (.not. all(ieee_is_finite(solution))) then
            call fail(error, "linear system: the solution overflows", status_library)
        else
            x = solution(:, 1)
        end if
    end subroutine solve_linear
end module lagrangia_lapack
