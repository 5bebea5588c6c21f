module lagrangia_lapack_rank
    !! How many rows, or columns, of a matrix are independent: singular values by LAPACK.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_kinds, only: dp, this_part_needs_real64
    implicit none (type, external)
    private
    public :: matrix_rank

    real(dp), parameter :: noise = 1e-10_dp  !! singular values below this share of the largest

    interface
        pure subroutine dgesvd(jobu, jobvt, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, info)
            import :: dp
            implicit none (type, external)
            character, intent(in) :: jobu, jobvt
            integer, intent(in) :: m, n, lda, ldu, ldvt, lwork
            real(dp), intent(inout) :: a(lda, n)
            real(dp), intent(out) :: s(min(m, n)), u(ldu, 1), vt(ldvt, 1), work(lwork)
            integer, intent(out) :: info
        end subroutine dgesvd
    end interface

contains

    pure subroutine matrix_rank(matrix, rank, error)
        !! The number of singular values above noise, 1e-10 of the largest.
        !!
        !! Source: LAPACK Users' Guide, 3rd ed., sec. 2.3.4.3; `dgesvd`.
        real(dp), intent(in) :: matrix(:, :)
        integer, intent(out) :: rank
        type(error_t), allocatable, intent(out) :: error  !! NaN, no convergence
        real(dp) :: a(size(matrix, 1), size(matrix, 2)), values(minval(shape(matrix)))
        real(dp) :: work(8*sum(shape(matrix))), u(1, 1), vt(1, 1)
        integer :: m, n, info

        rank = 0
        m = size(matrix, 1)
        n = size(matrix, 2)
        if (.not. all(ieee_is_finite(matrix))) then
            call fail(error, "rank: not every element is finite", status_library)
            return
        end if
        if (min(m, n) == 0) return
        a = matrix
        call dgesvd("n", "n", m, n, a, m, values, u, 1, vt, 1, work, size(work), info)
        if (info /= 0) then
            call fail(error, "rank: LAPACK's dgesvd does not converge", status_library)
            return
        end if
        rank = count(values > noise*values(1))
    end subroutine matrix_rank
end module lagrangia_lapack_rank
