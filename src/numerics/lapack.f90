module lagrangia_lapack
    !! LAPACK's drivers with our errors, the caller's arrays untouched: linear systems, rank, least
    !! squares, and tridiagonal matrices. Its eigenvalues: `lagrangia_eigen`.
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_kinds, only: dp, this_part_needs_real64
    use lagrangia_number_class, only: all_finite
    implicit none (type, external)
    private
    public :: count_negative, least_squares, lowest_mode, matrix_rank, smallest_pivot, solve_band, &
              solve_linear

    real(dp), parameter :: noise = 1e-10_dp  !! singular values below this share of the largest

    interface
        pure subroutine dgbsv(n, kl, ku, nrhs, ab, ldab, ipiv, b, ldb, info)
            import :: dp
            implicit none (type, external)
            integer, intent(in) :: n, kl, ku, nrhs, ldab, ldb
            real(dp), intent(inout) :: ab(ldab, n), b(ldb, nrhs)
            integer, intent(out) :: ipiv(n), info
        end subroutine dgbsv

        pure subroutine dgels(trans, m, n, nrhs, a, lda, b, ldb, work, lwork, info)
            import :: dp
            implicit none (type, external)
            character, intent(in) :: trans
            integer, intent(in) :: m, n, nrhs, lda, ldb, lwork
            real(dp), intent(inout) :: a(lda, n), b(ldb, nrhs)
            real(dp), intent(out) :: work(lwork)
            integer, intent(out) :: info
        end subroutine dgels

        pure subroutine dgesvd(jobu, jobvt, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, info)
            import :: dp
            implicit none (type, external)
            character, intent(in) :: jobu, jobvt
            integer, intent(in) :: m, n, lda, ldu, ldvt, lwork
            real(dp), intent(inout) :: a(lda, n)
            real(dp), intent(out) :: s(min(m, n)), u(ldu, 1), vt(ldvt, 1), work(lwork)
            integer, intent(out) :: info
        end subroutine dgesvd

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

        pure subroutine dpotrf(uplo, n, a, lda, info)
            import :: dp
            implicit none (type, external)
            character, intent(in) :: uplo
            integer, intent(in) :: n, lda
            real(dp), intent(inout) :: a(lda, n)
            integer, intent(out) :: info
        end subroutine dpotrf

        pure subroutine dstebz(range, order, n, vl, vu, il, iu, abstol, d, e, m, nsplit, w, &
                               iblock, isplit, work, iwork, info)
            import :: dp
            implicit none (type, external)
            character, intent(in) :: range, order
            integer, intent(in) :: n, il, iu
            real(dp), intent(in) :: vl, vu, abstol, d(n), e(n)
            integer, intent(out) :: m, nsplit, iblock(n), isplit(n), iwork(3*n), info
            real(dp), intent(out) :: w(n), work(4*n)
        end subroutine dstebz

        pure subroutine dstevx(jobz, range, n, d, e, vl, vu, il, iu, abstol, m, w, z, ldz, work, &
                               iwork, ifail, info)
            import :: dp
            implicit none (type, external)
            character, intent(in) :: jobz, range
            integer, intent(in) :: n, il, iu, ldz
            real(dp), intent(in) :: vl, vu, abstol
            real(dp), intent(inout) :: d(n), e(n)
            integer, intent(out) :: m, iwork(5*n), ifail(n), info
            real(dp), intent(out) :: w(n), z(ldz, 1), work(5*n)
        end subroutine dstevx
    end interface

contains

    pure subroutine check(what, part, fits, finite, error)
        !! Refuse shapes that do not match, and NaN or infinity.
        character(*), intent(in) :: what, part  !! `linear system`, `coefficient`
        logical, intent(in) :: fits, finite
        type(error_t), allocatable, intent(out) :: error

        if (.not. fits) then
            call fail(error, what//": shapes do not match", status_library)
        else if (.not. finite) then
            call fail(error, what//": not every "//part//" is finite", status_library)
        end if
    end subroutine check

    pure subroutine solve_linear(matrix, rhs, x, error, log_determinant)
        !! Solve \(A x = b\) for a small dense \(A\).
        !!
        !! LAPACK's expert driver: unlike `dgesv` it balances rows and columns first, so masses of
        !! 1e-24 and 1e24 may meet in one matrix, and it refuses a matrix whose reciprocal
        !! condition number is below \(\epsilon\).
        !!
        !! Source: LAPACK Users' Guide, 3rd ed., sec. 2.3.1 and 4.4; `dgesvx`.
        real(dp), intent(in) :: matrix(:, :)              !! \(A\), (n, n)
        real(dp), intent(in) :: rhs(:)                    !! \(b\), (n)
        real(dp), intent(out) :: x(:)                     !! (n); zero after an error
        type(error_t), allocatable, intent(out) :: error  !! shapes, NaN, singular, overflow
        real(dp), intent(out), optional :: log_determinant
        !! \(\ln|\det A|\); 0 after an error
        real(dp), dimension(size(rhs), size(rhs)) :: a, factors
        real(dp), dimension(size(rhs), 1) :: b, solution
        real(dp), dimension(size(rhs)) :: row_scale, column_scale
        real(dp) :: forward(1), backward(1), rcond, work(4*size(rhs))
        integer :: i, n, info, pivots(size(rhs)), iwork(size(rhs))
        character :: equed

        x = 0.0_dp
        if (present(log_determinant)) log_determinant = 0.0_dp
        n = size(rhs)
        call check("linear system", "coefficient", size(x) == n .and. all(shape(matrix) == n), &
                   all_finite(matrix) .and. all_finite(rhs), error)
        if (allocated(error) .or. n == 0) return
        a = matrix
        b(:, 1) = rhs
        call dgesvx("e", "n", n, 1, a, n, factors, n, pivots, equed, row_scale, column_scale, b, &
                    n, solution, n, rcond, forward, backward, work, iwork, info)
        if (info < 0) then
            call fail(error, "linear system: LAPACK refused an argument of dgesvx", status_library)
        else if (info > 0) then
            call fail(error, "linear system: the matrix is singular", status_library)
        else if (.not. all_finite(solution)) then
            call fail(error, "linear system: the solution overflows", status_library)
        else
            x = solution(:, 1)
            if (.not. present(log_determinant)) return
            log_determinant = sum([(log(abs(factors(i, i))), i=1, n)])
            if (scan(equed, "rRbB") > 0) log_determinant = log_determinant - sum(log(row_scale))
            if (scan(equed, "cCbB") > 0) log_determinant = log_determinant - sum(log(column_scale))
        end if
    end subroutine solve_linear

    pure subroutine matrix_rank(matrix, rank, error)
        !! The number of singular values \(\sigma_i > 10^{-10}\sigma_1\).
        !!
        !! Source: LAPACK Users' Guide, 3rd ed., sec. 2.3.4.3; `dgesvd`.
        real(dp), intent(in) :: matrix(:, :)              !! (m, n), not changed
        integer, intent(out) :: rank                      !! 0 after an error
        type(error_t), allocatable, intent(out) :: error  !! NaN, no convergence
        real(dp) :: a(size(matrix, 1), size(matrix, 2)), values(minval(shape(matrix)))
        real(dp) :: work(8*sum(shape(matrix))), u(1, 1), vt(1, 1)
        integer :: m, n, info

        rank = 0
        m = size(matrix, 1)
        n = size(matrix, 2)
        call check("rank", "element", .true., all_finite(matrix), error)
        if (allocated(error) .or. min(m, n) == 0) return
        a = matrix
        call dgesvd("n", "n", m, n, a, m, values, u, 1, vt, 1, work, size(work), info)
        if (info /= 0) then
            call fail(error, "rank: LAPACK's dgesvd does not converge", status_library)
            return
        end if
        rank = count(values > noise*values(1))
    end subroutine matrix_rank

    pure subroutine least_squares(a, c, x, error)
        !! The `x` that makes \(\lVert Ax - c\rVert\) least; \(A\) of full rank, (m, n), m >= n.
        !!
        !! Source: LAPACK Users' Guide, 3rd ed., sec. 2.3.2; `dgels`.
        real(dp), intent(in) :: a(:, :), c(:)             !! \(A\), (m, n); \(c\), (m)
        real(dp), intent(out) :: x(:)                     !! (n); zero after an error
        type(error_t), allocatable, intent(out) :: error  !! shapes, NaN, rank
        real(dp) :: a_work(size(a, 1), size(a, 2)), c_work(size(c), 1), work(64*(size(a) + 1))
        integer :: info

        x = 0.0_dp
        call check("least squares", "coefficient", &
                   all(shape(a) == [size(c), size(x)]) .and. size(x) <= size(c), &
                   all_finite(a) .and. all_finite(c), error)
        if (allocated(error) .or. size(x) == 0) return
        a_work = a
        c_work(:, 1) = c
        call dgels("N", size(c), size(x), 1, a_work, size(c), c_work, size(c), work, size(work), &
                   info)
        if (info /= 0 .or. .not. all_finite(c_work)) then
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
        real(dp), intent(in) :: matrix(:, :)  !! symmetric, (n, n)
        real(dp) :: pivot
        real(dp), dimension(size(matrix, 1), size(matrix, 1)) :: a
        integer :: i, j, n, info

        n = size(matrix, 1)
        pivot = 0.0_dp
        do i = 1, n
            if (.not. (matrix(i, i) > 0.0_dp .and. all_finite(matrix(:, i)))) return
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

    pure subroutine solve_band(band, rhs, x, error)
        !! Solve \(A x = b\), \(A\) with as many diagonals above the main one as below.
        !!
        !! Source: LAPACK Users' Guide, 3rd ed., sec. 5.3.3; `dgbsv`.
        real(dp), intent(in) :: band(:, :)  !! \(A_{ij}\) in `band(w + 1 + i - j, j)`, (2w + 1, n)
        real(dp), intent(in) :: rhs(:)      !! \(b\), (n)
        real(dp), intent(out) :: x(:)       !! (n); zero after an error
        type(error_t), allocatable, intent(out) :: error  !! shapes, NaN, singular
        real(dp) :: a(size(band, 1) + size(band, 1)/2, size(band, 2)), b(size(rhs), 1)
        integer :: width, n, info, pivots(size(rhs))

        x = 0.0_dp
        n = size(rhs)
        width = size(band, 1)/2
        call check("band system", "coefficient", &
                   size(x) == n .and. all(shape(band) == [2*width + 1, n]), &
                   all_finite(band) .and. all_finite(rhs), error)
        if (allocated(error) .or. n == 0) return
        a(:width, :) = 0.0_dp
        a(width + 1:, :) = band
        b(:, 1) = rhs
        call dgbsv(n, width, width, 1, a, size(a, 1), pivots, b, n, info)
        if (info < 0) then
            call fail(error, "band system: LAPACK refused an argument of dgbsv", status_library)
        else if (info > 0) then
            call fail(error, "band system: the matrix is singular", status_library)
        else
            x = b(:, 1)
        end if
    end subroutine solve_band

    pure subroutine count_negative(diagonal, off, negative, error)
        !! The number of negative eigenvalues of a symmetric tridiagonal matrix.
        !!
        !! Source: LAPACK Users' Guide, 3rd ed., sec. 2.4.4; `dstebz` counts sign changes (Sturm).
        real(dp), intent(in) :: diagonal(:)               !! (n)
        real(dp), intent(in) :: off(:)                    !! (n - 1)
        integer, intent(out) :: negative                  !! how many
        type(error_t), allocatable, intent(out) :: error  !! shapes, NaN
        real(dp) :: lowest, d(size(diagonal)), e(size(diagonal))
        real(dp) :: values(size(diagonal)), work(4*size(diagonal))
        integer :: n, splits, info
        integer :: blocks(size(diagonal)), ends(size(diagonal)), iwork(3*size(diagonal))

        negative = 0
        n = size(diagonal)
        call check("tridiagonal matrix", "element", size(off) == max(0, n - 1), &
                   all_finite(diagonal) .and. all_finite(off), error)
        if (allocated(error) .or. n == 0) return
        lowest = -2.0_dp*(maxval(abs(diagonal)) + 2.0_dp*maxval([0.0_dp, abs(off)]))
        if (lowest >= 0.0_dp) return
        d = diagonal
        e(:n - 1) = off
        call dstebz("v", "e", n, lowest, -tiny(lowest), 1, n, 0.0_dp, d, e, negative, splits, &
                    values, blocks, ends, work, iwork, info)
        if (info /= 0) call fail(error, "tridiagonal matrix: LAPACK's dstebz failed", &
                                 status_library)
    end subroutine count_negative

    pure subroutine lowest_mode(diagonal, off, value, vector, error)
        !! The lowest eigenvalue of a symmetric tridiagonal matrix, and its eigenvector.
        !!
        !! Source: LAPACK Users' Guide, 3rd ed., sec. 2.4.4; `dstevx`.
        real(dp), intent(in) :: diagonal(:)               !! (n), n > 0
        real(dp), intent(in) :: off(:)                    !! (n - 1)
        real(dp), intent(out) :: value                    !! zero after an error
        real(dp), intent(out) :: vector(:)                !! (n), of length 1; zero after an error
        type(error_t), allocatable, intent(out) :: error  !! shapes, NaN
        real(dp) :: d(size(diagonal)), e(size(diagonal)), w(size(diagonal)), z(size(diagonal), 1)
        real(dp) :: work(5*size(diagonal))
        integer :: n, found, info, iwork(5*size(diagonal)), failed(size(diagonal))

        value = 0.0_dp
        vector = 0.0_dp
        n = size(diagonal)
        call check("tridiagonal matrix", "element", &
                   n > 0 .and. size(off) == n - 1 .and. size(vector) == n, &
                   all_finite(diagonal) .and. all_finite(off), error)
        if (allocated(error)) return
        d = diagonal
        e = 0.0_dp
        e(:n - 1) = off
        call dstevx("v", "i", n, d, e, 0.0_dp, 0.0_dp, 1, 1, 0.0_dp, found, w, z, n, work, iwork, &
                    failed, info)
        if (info /= 0) then
            call fail(error, "tridiagonal matrix: LAPACK's dstevx failed", status_library)
            return
        end if
        value = w(1)
        vector = z(:, 1)
    end subroutine lowest_mode
end module lagrangia_lapack
