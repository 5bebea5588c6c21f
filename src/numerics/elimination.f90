module lagrangia_elimination
    !! Linear systems with a positive definite matrix, in any precision: the quadruple one has no
    !! LAPACK.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: solve_positive

contains

    pure subroutine solve_positive(matrix, least, x)
        !! Solve \(M x = b\) by Gauss's elimination without pivoting, which a positive definite
        !! \(M\) does not need; NaN where a pivot is at most `least`.
        real(dp), intent(inout) :: matrix(:, :)  !! \(M\), symmetric, (n, n); overwritten
        real(dp), intent(in) :: least(:)         !! the bound of each pivot, (n)
        real(dp), intent(inout) :: x(:)          !! \(b\), becomes \(x\), (n)
        real(dp) :: factor
        integer :: i, j, n

        n = size(x)
        do i = 1, n
            if (.not. matrix(i, i) > least(i)) then
                x = ieee_value(x, ieee_quiet_nan)
                return
            end if
            do j = i + 1, n
                factor = matrix(j, i)/matrix(i, i)
                x(j) = x(j) - factor*x(i)
                matrix(j, i:) = matrix(j, i:) - factor*matrix(i, i:)
            end do
        end do
        do i = n, 1, -1
            x(i) = (x(i) - dot_product(matrix(i, i + 1:), x(i + 1:)))/matrix(i, i)
        end do
    end subroutine solve_positive
end module lagrangia_elimination
