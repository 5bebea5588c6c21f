module lagrangia_regular_pencil
    !! The eigenvalues 0 of \(\lambda Ex = Ax\) taken out, by ranks. Rounding makes
    !! \(\sqrt\epsilon\) of a double one, as of a motion that nothing holds or slows down, and more
    !! of others; which elements are rounding it leaves as it is.
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: all_finite, is_zero
    implicit none (type, external)
    private
    public :: equilibrate, leave_zeros_out, nullity

    real(dp), parameter :: rounding = 4.0_dp*epsilon(1.0_dp)  !! of an element

contains

    pure subroutine leave_zeros_out(e, a, error)
        !! The smaller pencil that has the other eigenvalues.
        !!
        !! With a basis N of the null space of A, and C the unit vectors that complete it,
        !! \(x = N\alpha + C\beta\) makes \(\lambda E(N\alpha + C\beta) = AC\beta\). Rows T with
        !! \(T^\top EN = 0\) leave \(\lambda\,T^\top EC\beta = T^\top AC\beta\), which has as many
        !! zeros less as N has columns; where zeros are multiple, \(T^\top AC\) is singular again.
        !!
        !! Source: V. N. Kublanovskaya, USSR Comput. Math. Math. Phys. 6, 1 (1966), for E = 1.
        real(dp), allocatable, intent(inout) :: e(:, :)   !! regular, (n, n); fewer rows after it
        real(dp), allocatable, intent(inout) :: a(:, :)   !! (n, n)
        type(error_t), allocatable, intent(out) :: error  !! status 4: NaN, a singular E
        real(dp), allocatable :: noise(:, :), kernel(:, :), rows(:, :)
        real(dp), allocatable :: row_scales(:), column_scales(:)
        logical, allocatable :: pivotal(:), row_pivotal(:)
        integer, allocatable :: rest(:)
        integer :: i, n

        if (.not. (all_finite(a) .and. all_finite(e))) then
            call fail(error, "eigenvalues: an element is not a finite number", status_library)
            return
        end if
        allocate (noise, source=rounding*abs(a))
        do while (size(a, 1) > 0)
            n = size(a, 1)
            call equilibrate(a, row_scales, column_scales)
            call put_scales(row_scales, column_scales, a)
            call put_scales(row_scales, column_scales, e)
            call put_scales(row_scales, column_scales, noise)
            call find_null(a, noise, kernel, pivotal)
            if (size(kernel, 2) == 0) return
            rest = pack([(i, i=1, n)], pivotal)
            call find_null(transpose(matmul(e, kernel)), &
                           rounding*transpose(matmul(abs(e), abs(kernel))), rows, row_pivotal)
            if (size(rows, 2) /= size(rest)) then
                call fail(error, "eigenvalues: the leading matrix is singular", status_library)
                return
            end if
            noise = matmul(transpose(abs(rows)), noise(:, rest) + n*rounding*abs(a(:, rest)))
            a = matmul(transpose(rows), a(:, rest))
            where (abs(a) <= noise) a = 0.0_dp
            e = matmul(transpose(rows), e(:, rest))
        end do
    end subroutine leave_zeros_out

    pure function nullity(matrix) result(dimension)
        !! Of the null space, to the rounding of the elements.
        real(dp), intent(in) :: matrix(:, :)  !! (m, n)
        integer :: dimension                  !! n less the rank
        real(dp) :: a(size(matrix, 1), size(matrix, 2))
        real(dp), allocatable :: rows(:), columns(:), kernel(:, :)
        logical, allocatable :: pivotal(:)

        a = matrix
        call equilibrate(a, rows, columns)
        call put_scales(rows, columns, a)
        call find_null(a, rounding*abs(a), kernel, pivotal)
        dimension = count(.not. pivotal)
    end function nullity

    pure subroutine find_null(matrix, noise, kernel, pivotal)
        !! By elimination with complete pivoting, which keeps the rounding of each element: what is
        !! no more than that is 0.
        real(dp), intent(in) :: matrix(:, :), noise(:, :)     !! (m, n)
        real(dp), allocatable, intent(out) :: kernel(:, :)    !! (n, n - rank)
        logical, allocatable, intent(out) :: pivotal(:)
        !! (n), of the columns; the other rows of `kernel` are unit vectors
        real(dp), dimension(size(matrix, 1), size(matrix, 2)) :: a, d
        logical :: left(size(matrix, 1))
        integer :: pivot_row(size(matrix, 2)), at(2), i, j, k, n
        real(dp) :: factor

        n = size(matrix, 2)
        a = matrix
        d = noise
        left = .true.
        allocate (pivotal(n), source=.false.)
        do k = 1, minval(shape(a))
            where (abs(a) <= d) a = 0.0_dp
            at = maxloc(abs(a), spread(left, 2, n) .and. .not. spread(pivotal, 1, size(a, 1)))
            if (at(1) == 0) exit
            if (is_zero(a(at(1), at(2)))) exit
            left(at(1)) = .false.
            pivotal(at(2)) = .true.
            pivot_row(at(2)) = at(1)
            associate (row => a(at(1), :), row_noise => d(at(1), :), pivot => a(at(1), at(2)))
                do i = 1, size(a, 1)
                    if (i == at(1) .or. is_zero(a(i, at(2)))) cycle
                    factor = a(i, at(2))/pivot
                    d(i, :) = d(i, :) + abs(factor)*row_noise + epsilon(factor)*abs(factor*row) + &
                              (d(i, at(2)) + abs(factor)*row_noise(at(2)))/abs(pivot)*abs(row)
                    a(i, :) = a(i, :) - factor*row
                    a(i, at(2)) = 0.0_dp
                    d(i, at(2)) = 0.0_dp
                end do
            end associate
        end do
        where (abs(a) <= d) a = 0.0_dp
        allocate (kernel(n, count(.not. pivotal)), source=0.0_dp)
        k = 0
        do j = 1, n
            if (pivotal(j)) cycle
            k = k + 1
            kernel(j, k) = 1.0_dp
            do i = 1, n
                if (pivotal(i)) kernel(i, k) = -a(pivot_row(i), j)/a(pivot_row(i), i)
            end do
        end do
    end subroutine find_null

    pure subroutine equilibrate(a, rows, columns)
        !! Powers of 2 that make the largest elements of all rows and columns of
        !! \(r_ia_{ij}c_j\) some 1.
        !!
        !! Source: D. Ruiz, RAL-TR-2001-034.
        real(dp), intent(in) :: a(:, :)                   !! (m, n)
        real(dp), allocatable, intent(out) :: rows(:)     !! \(r_i\), (m); 1 of a row of zeros
        real(dp), allocatable, intent(out) :: columns(:)  !! \(c_j\), (n); likewise
        integer, parameter :: most = 20
        real(dp) :: scaled(size(a, 1), size(a, 2))
        real(dp) :: row(size(a, 1)), column(size(a, 2))
        integer :: i

        allocate (rows(size(a, 1)), columns(size(a, 2)), source=1.0_dp)
        scaled = a
        do i = 1, most
            row = root(maxval(abs(scaled), 2))
            column = root(maxval(abs(scaled), 1))
            if (all(row >= 1.0_dp .and. row <= 1.0_dp) .and. &
                all(column >= 1.0_dp .and. column <= 1.0_dp)) exit
            rows = rows*row
            columns = columns*column
            call put_scales(row, column, scaled)
        end do
    end subroutine equilibrate

    elemental function root(largest) result(factor)
        !! About \(1/\sqrt{x}\), 1 of 0.
        real(dp), intent(in) :: largest
        real(dp) :: factor

        factor = 1.0_dp
        if (largest > 0.0_dp) factor = scale(1.0_dp, -(exponent(largest) - 1)/2)
    end function root

    pure subroutine put_scales(rows, columns, a)
        !! \(r_ia_{ij}c_j\).
        real(dp), intent(in) :: rows(:), columns(:)
        real(dp), intent(inout) :: a(:, :)
        integer :: j

        do j = 1, size(columns)
            a(:, j) = rows*a(:, j)*columns(j)
        end do
    end subroutine put_scales
end module lagrangia_regular_pencil
