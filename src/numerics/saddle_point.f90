module lagrangia_saddle_point
    !! Lagrange's equations with multipliers,
    !! $$ \begin{pmatrix} M & -A^\top\\ A & 0\end{pmatrix}
    !!    \begin{pmatrix} x\\ \lambda\end{pmatrix} =
    !!    \begin{pmatrix} F\\ b\end{pmatrix}, $$
    !! in units that fit the masses: an electron's beside constraints of the size of 1 would else
    !! be lost in rounding.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use lagrangia_number_class, only: all_finite, is_zero
    implicit none (type, external)
    private
    public :: solve_saddle_point

contains

    pure subroutine solve_saddle_point(matrix, n, rhs, x, error, unit)
        !! Solve \(SKS\,y = Sr\), \(x = Sy\), with \(S\) diagonal, of powers of 2. The unit of all
        !! \(x_i\) is one, by the largest mass; where that leaves digits to be lost, each is tried
        !! by its own mass as well, and the better condition counts: a light bob on a heavy one
        !! needs the second, a light pulley between two masses the first.
        real(dp), intent(in) :: matrix(:, :)  !! \(K\), (n + k, n + k) with k constraints
        integer, intent(in) :: n              !! size of \(M\)
        real(dp), intent(in) :: rhs(:)        !! \(r\), (n + k)
        real(dp), intent(out) :: x(:)         !! \((x, \lambda)\), (n + k); zero after an error
        type(error_t), allocatable, intent(out) :: error  !! as of `solve_linear`
        real(dp), intent(out), optional :: unit(:)        !! diagonal of \(S\), (n + k)
        real(dp), parameter :: fair = 1e-3_dp
        real(dp), dimension(size(matrix, 1)) :: scale, other_scale, other_x
        type(error_t), allocatable :: other_error
        real(dp) :: mass(n), condition, other_condition
        integer :: i

        mass = 1.0_dp
        if (all_finite(matrix)) mass = [(abs(matrix(i, i)), i=1, n)]
        where (is_zero(mass)) mass = maxval(mass)
        scale = scale_of(matrix, spread(maxval(mass), 1, n))
        call solve_scaled(matrix, scale, rhs, x, error, condition)
        if (condition < fair .and. n > 1) then
            other_scale = scale_of(matrix, mass)
            call solve_scaled(matrix, other_scale, rhs, other_x, other_error, other_condition)
            if (other_condition > condition) then
                call move_alloc(other_error, error)
                scale = other_scale
                x = other_x
            end if
        end if
        if (present(unit)) unit = scale
    end subroutine solve_saddle_point

    pure subroutine solve_scaled(matrix, scale, rhs, x, error, condition)
        !! With one \(S\).
        real(dp), intent(in) :: matrix(:, :), scale(:), rhs(:)
        real(dp), intent(out) :: x(:)
        type(error_t), allocatable, intent(out) :: error
        real(dp), intent(out) :: condition  !! reciprocal, of \(SKS\)
        real(dp) :: scaled(size(matrix, 1), size(matrix, 2))
        integer :: j

        do j = 1, size(matrix, 2)
            scaled(:, j) = (matrix(:, j)*scale(j))*scale
        end do
        call solve_linear(scaled, rhs*scale, x, error, condition)
        if (.not. allocated(error)) x = x*scale
    end subroutine solve_scaled

    pure function scale_of(matrix, mass) result(scale)
        !! \(S\): \(m_i^{-1/2}\), and \(1/\max_j|A_{ij}|S_j\) of the constraints.
        real(dp), intent(in) :: matrix(:, :), mass(:)
        real(dp) :: scale(size(matrix, 1))
        integer :: i, n

        n = size(mass)
        scale(:n) = power_of_two(sqrt(mass))
        do i = n + 1, size(scale)
            scale(i) = power_of_two(maxval(abs(matrix(i, :n))*scale(:n)))
        end do
    end function scale_of

    elemental function power_of_two(x) result(factor)
        !! \(2^k\) with \(x\,2^k\) from 0.5 to 1; 1 of zero and of what is not finite.
        real(dp), intent(in) :: x  !! not negative
        real(dp) :: factor

        factor = 1.0_dp
        if (x > 0.0_dp .and. x <= huge(x)) factor = scale(factor, -exponent(x))
    end function power_of_two
end module lagrangia_saddle_point
