module lagrangia_lapack_eigen
    !! LAPACK's eigenvalue and singular value routines; the other half of `lagrangia_lapack`.
    use lagrangia_kinds, only: dp, this_part_needs_real64
    implicit none (type, external)
    private
    public :: dgeev, dgejsv, dsygv, dsygvd

    interface
        pure subroutine dsygv(itype, jobz, uplo, n, a, lda, b, ldb, w, work, lwork, info)
            !! \(Az = \lambda Bz\): `a` becomes the eigenvectors, `b` its Cholesky factor.
            import :: dp
            implicit none (type, external)
            integer, intent(in) :: itype, n, lda, ldb, lwork
            character(1), intent(in) :: jobz, uplo
            real(dp), intent(inout) :: a(lda, *), b(ldb, *)
            real(dp), intent(out) :: w(*), work(*)
            integer, intent(out) :: info
        end subroutine dsygv

        pure subroutine dsygvd(itype, jobz, uplo, n, a, lda, b, ldb, w, work, lwork, iwork, &
                               liwork, info)
            !! The same by divide and conquer: faster from some thirty rows on.
            import :: dp
            implicit none (type, external)
            integer, intent(in) :: itype, n, lda, ldb, lwork, liwork
            character(1), intent(in) :: jobz, uplo
            real(dp), intent(inout) :: a(lda, *), b(ldb, *)
            real(dp), intent(out) :: w(*), work(*)
            integer, intent(out) :: iwork(*), info
        end subroutine dsygvd

        pure subroutine dgejsv(joba, jobu, jobv, jobr, jobt, jobp, m, n, a, lda, sva, u, ldu, v, &
                               ldv, work, lwork, iwork, info)
            !! Singular values by one-sided Jacobi, high relative accuracy for scaled matrices.
            import :: dp
            implicit none (type, external)
            character(1), intent(in) :: joba, jobu, jobv, jobr, jobt, jobp
            integer, intent(in) :: m, n, lda, ldu, ldv, lwork
            real(dp), intent(inout) :: a(lda, *)
            real(dp), intent(out) :: sva(*), u(ldu, *), v(ldv, *), work(*)
            integer, intent(out) :: iwork(*), info
        end subroutine dgejsv

        pure subroutine dgeev(jobvl, jobvr, n, a, lda, wr, wi, vl, ldvl, vr, ldvr, work, lwork, &
                              info)
            !! \(Az = \lambda z\) for any real matrix, balanced; \(\lambda\) = wr + i wi.
            import :: dp
            implicit none (type, external)
            character(1), intent(in) :: jobvl, jobvr
            integer, intent(in) :: n, lda, ldvl, ldvr, lwork
            real(dp), intent(inout) :: a(lda, *)
            real(dp), intent(out) :: wr(*), wi(*), vl(ldvl, *), vr(ldvr, *), work(*)
            integer, intent(out) :: info
        end subroutine dgeev
    end interface
end module lagrangia_lapack_eigen
