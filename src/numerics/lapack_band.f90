module lagrangia_lapack_band
    !! LAPACK for matrices that are a narrow band: chains in which only neighbours meet.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_kinds, only: dp, this_part_needs_real64
    implicit none (type, external)
    private
    public :: count_negative, lowest_mode, solve_band

    interface
        pure subroutine dgbsv(n, kl, ku, nrhs, ab, ldab, ipiv, b, ldb, info)
            import :: dp
            implicit none (type, external)
            integer, intent(in) :: n, kl, ku, nrhs, ldab, ldb
            real(dp), intent(inout) :: ab(ldab, n), b(ldb, nrhs)
            integer, intent(out) :: ipiv(n), info
        end subroutine dgbsv

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
        if (size(x) /= n .or. size(band, 2) /= n .or. size(band, 1) /= 2*width + 1) then
            call fail(error, "band system: shapes do not match", status_library)
            return
        end if
        if (.not. (all(ieee_is_finite(band)) .and. all(ieee_is_finite(rhs)))) then
            call fail(error, "band system: not every coefficient is finite", status_library)
            return
        end if
        if (n == 0) return
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
        real(dp), intent(in) :: diagonal(:)  !! (n)
        real(dp), intent(in) :: off(:)       !! (n - 1)
        integer, intent(out) :: negative
        type(error_t), allocatable, intent(out) :: error  !! shapes, NaN
        real(dp) :: lowest, d(size(diagonal)), e(size(diagonal))
        real(dp) :: values(size(diagonal)), work(4*size(diagonal))
        integer :: n, splits, info
        integer :: blocks(size(diagonal)), ends(size(diagonal)), iwork(3*size(diagonal))

        negative = 0
        n = size(diagonal)
        if (size(off) /= max(0, n - 1)) then
            call fail(error, "tridiagonal matrix: shapes do not match", status_library)
            return
        end if
        if (.not. (all(ieee_is_finite(diagonal)) .and. all(ieee_is_finite(off)))) then
            call fail(error, "tridiagonal matrix: not every element is finite", status_library)
            return
        end if
        if (n == 0) return
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
        real(dp), intent(in) :: diagonal(:)  !! (n), n > 0
        real(dp), intent(in) :: off(:)       !! (n - 1)
        real(dp), intent(out) :: value       !! zero after an error
        real(dp), intent(out) :: vector(:)   !! (n), of length 1; zero after an error
        type(error_t), allocatable, intent(out) :: error  !! shapes, NaN
        real(dp) :: d(size(diagonal)), e(size(diagonal)), w(size(diagonal)), z(size(diagonal), 1)
        real(dp) :: work(5*size(diagonal))
        integer :: n, found, info, iwork(5*size(diagonal)), failed(size(diagonal))

        value = 0.0_dp
        vector = 0.0_dp
        n = size(diagonal)
        if (n == 0 .or. size(off) /= n - 1 .or. size(vector) /= n) then
            call fail(error, "tridiagonal matrix: shapes do not match", status_library)
            return
        end if
        if (.not. (all(ieee_is_finite(diagonal)) .and. all(ieee_is_finite(off)))) then
            call fail(error, "tridiagonal matrix: not every element is finite", status_library)
            return
        end if
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
end module lagrangia_lapack_band
