module lagrangia_saddle_point
    !! Lagrange's equations with multipliers, \(Kz = r\),
    !! $$ K = \begin{pmatrix} M & -A^\top\\ A & 0\end{pmatrix},\qquad
    !!    z = \begin{pmatrix} x\\ \lambda\end{pmatrix}, $$
    !! in units of the unknowns that fit: masses of electrons, and radii in metres beside
    !! inertias in kg m^2, are else lost in rounding.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use lagrangia_number_class, only: all_finite
    implicit none (type, external)
    private
    public :: scale_saddle_point, solve_saddle_point

contains

    pure subroutine solve_saddle_point(matrix, rhs, z, error)
        !! Solve \(SKS\,y = Sr\), \(z = Sy\).
        real(dp), intent(in) :: matrix(:, :)  !! \(K\), (n, n), \(|K|\) is symmetric
        real(dp), intent(in) :: rhs(:)        !! \(r\), (n)
        real(dp), intent(out) :: z(:)         !! (n); zero after an error
        type(error_t), allocatable, intent(out) :: error  !! as of `solve_linear`
        real(dp) :: scaled(size(matrix, 1), size(matrix, 2)), s(size(matrix, 1))

        call scale_saddle_point(matrix, scaled, s)
        call solve_linear(scaled, rhs*s, z, error)
        if (.not. allocated(error)) z = z*s
    end subroutine solve_saddle_point

    pure subroutine scale_saddle_point(matrix, scaled, s)
        !! \(SKS\), with \(S\) diagonal, of powers of 2.
        real(dp), intent(in) :: matrix(:, :)   !! \(K\), (n, n), \(|K|\) is symmetric
        real(dp), intent(out) :: scaled(:, :)  !! (n, n)
        real(dp), intent(out) :: s(:)          !! diagonal of \(S\), (n)
        integer :: j

        s = units_of(matrix)
        do j = 1, size(s)
            scaled(:, j) = (matrix(:, j)*s(j))*s
        end do
    end subroutine scale_saddle_point

    pure function units_of(matrix) result(s)
        !! Of the permutations, that with the largest product of \(|K_{i\pi(i)}|\) has coefficients
        !! of about 1 in \(SKS\), and no coefficient is larger. All 1 where there is none.
        !!
        !! Source: I. S. Duff & J. Koster, SIAM J. Matrix Anal. Appl. 22, 973 (2001), sec. 4;
        !! I. S. Duff & S. Pralet, ibid. 27, 313 (2005), of symmetric matrices.
        real(dp), intent(in) :: matrix(:, :)
        real(dp) :: s(size(matrix, 1))
        real(dp), parameter :: no_way = 1e6_dp  !! more than any product of doubles
        real(dp) :: cost(size(matrix, 1), size(matrix, 2)), of_row(size(s)), of_column(size(s))
        real(dp) :: total

        s = 1.0_dp
        if (.not. all_finite(matrix)) return
        cost = no_way
        where (abs(matrix) > 0.0_dp) cost = -log(abs(matrix))/log(2.0_dp)
        call assign(cost, of_row, of_column, total)
        if (total >= 0.5_dp*no_way) return
        s = 2.0_dp**nint(0.5_dp*(of_row + of_column))
    end function units_of

    pure subroutine assign(cost, of_row, of_column, total)
        !! The dual of the assignment of rows to columns that costs least:
        !! \(u_i + v_j \le c_{ij}\), with equality on it. Rows are added one by one, each along a
        !! shortest path over the columns that others have.
        !!
        !! Source: H. W. Kuhn, Naval Res. Logist. Quart. 2, 83 (1955); J. Munkres, J. SIAM 5, 32
        !! (1957).
        real(dp), intent(in) :: cost(:, :)             !! \(c\), (n, n)
        real(dp), intent(out) :: of_row(:), of_column(:)  !! \(u\), \(v\), (n)
        real(dp), intent(out) :: total                 !! what it costs, \(\sum u + \sum v\)
        real(dp) :: least(size(of_row)), step, price(0:size(of_row))
        integer :: row_of(0:size(of_row)), before(size(of_row)), column, next, i, j
        logical :: used(0:size(of_row))

        of_row = 0.0_dp
        price = 0.0_dp
        row_of = 0
        do i = 1, size(of_row)
            row_of(0) = i
            column = 0
            least = huge(least)
            used = .false.
            do while (row_of(column) /= 0)
                used(column) = .true.
                do j = 1, size(least)
                    if (used(j)) cycle
                    step = cost(row_of(column), j) - of_row(row_of(column)) - price(j)
                    if (step < least(j)) then
                        least(j) = step
                        before(j) = column
                    end if
                end do
                next = minloc(least, 1, .not. used(1:))
                step = least(next)
                do j = 0, size(least)
                    if (.not. used(j)) cycle
                    of_row(row_of(j)) = of_row(row_of(j)) + step
                    price(j) = price(j) - step
                end do
                where (.not. used(1:)) least = least - step
                column = next
            end do
            do while (column /= 0)
                row_of(column) = row_of(before(column))
                column = before(column)
            end do
        end do
        of_column = price(1:)
        total = sum(of_row) + sum(of_column)
    end subroutine assign
end module lagrangia_saddle_point
