module lagrangia_null_space
    !! The vectors that a matrix takes to zero, by LAPACK's singular value decomposition.
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: all_finite
    implicit none (type, external)
    private
    public :: least_vector, null_space

    real(dp), parameter :: noise = 1e-10_dp  !! singular values below this share of the largest

    interface
        pure subroutine dgesvd(jobu, jobvt, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, info)
            import :: dp
            implicit none (type, external)
            character, intent(in) :: jobu, jobvt
            integer, intent(in) :: m, n, lda, ldu, ldvt, lwork
            real(dp), intent(inout) :: a(lda, n)
            real(dp), intent(out) :: s(min(m, n)), u(ldu, 1), vt(ldvt, n), work(lwork)
            integer, intent(out) :: info
        end subroutine dgesvd
    end interface

contains

    pure subroutine null_space(matrix, basis, error)
        !! Orthonormal columns that span the null space: of singular values
        !! \(\sigma_i \le 10^{-10}\sigma_1\).
        !!
        !! Source: LAPACK Users' Guide, 3rd ed., sec. 2.3.4.3; `dgesvd`.
        real(dp), intent(in) :: matrix(:, :)              !! (m, n), m >= n
        real(dp), allocatable, intent(out) :: basis(:, :) !! (n, dimension of the null space)
        type(error_t), allocatable, intent(out) :: error  !! too few rows, NaN, no convergence
        real(dp), allocatable :: values(:), vectors(:, :)

        call decompose(matrix, values, vectors, error)
        if (allocated(error)) then
            allocate (basis(size(matrix, 2), 0))
        else
            basis = vectors(:, count(values > noise*values(1)) + 1:)
        end if
    end subroutine null_space

    pure subroutine least_vector(matrix, vector, error)
        !! The unit vector that the matrix shortens most.
        real(dp), intent(in) :: matrix(:, :)              !! (m, n), m >= n
        real(dp), intent(out) :: vector(:)                !! (n); zero after an error
        type(error_t), allocatable, intent(out) :: error  !! too few rows, NaN, no convergence
        real(dp), allocatable :: values(:), vectors(:, :)

        vector = 0.0_dp
        call decompose(matrix, values, vectors, error)
        if (.not. allocated(error)) vector = vectors(:, size(vector))
    end subroutine least_vector

    pure subroutine decompose(matrix, values, vectors, error)
        !! Singular values, descending, and the right singular vectors, a column each.
        real(dp), intent(in) :: matrix(:, :)
        real(dp), allocatable, intent(out) :: values(:), vectors(:, :)
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: a(size(matrix, 1), size(matrix, 2)), u(1, 1)
        real(dp) :: vt(size(matrix, 2), size(matrix, 2)), work(8*sum(shape(matrix)))
        integer :: info, m, n

        m = size(matrix, 1)
        n = size(matrix, 2)
        if (m < n .or. n == 0) then
            call fail(error, "null space: a matrix needs as many rows as columns", status_library)
        else if (.not. all_finite(matrix)) then
            call fail(error, "null space: an element is not a finite number", status_library)
        end if
        if (allocated(error)) return
        a = matrix
        allocate (values(n), vectors(n, n))
        call dgesvd("n", "a", m, n, a, m, values, u, 1, vt, n, work, size(work), info)
        if (info /= 0) call fail(error, "null space: LAPACK's dgesvd does not converge", &
                                 status_library)
        vectors = transpose(vt)
    end subroutine decompose
end module lagrangia_null_space
