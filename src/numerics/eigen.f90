module lagrangia_eigen
    !! Eigenproblems of small oscillations, with every check that LAPACK leaves to its callers.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_jacobi, only: refine_modes
    use lagrangia_kinds, only: dp
    use lagrangia_lapack_eigen, only: dgeev, dgejsv, dsygv, dsygvd
    use lagrangia_number_class, only: all_finite, is_zero
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: eigenpairs, norm1, normal_modes, modes_from_factors, out_of_range, residual_ratio

    integer, parameter :: small = 32  !! up to here dsygv is the faster one
    real(dp), parameter :: graded = 1.0_dp/16.0_dp
    !! the smallest over the largest, below which LAPACK's rounding of the largest is refined

    interface normal_modes
        !! `lagrangia_normal_modes` has another form of it.
        module procedure matrix_modes
    end interface normal_modes

contains

    pure subroutine eigenpairs(matrix, what, values, vectors, error)
        !! Solve \(Ax = \mu x\) of a matrix without symmetry, in LAPACK's order: of two that are
        !! conjugate the one with \(\mathrm{Im}\,\mu > 0\) first. It errs by \(\epsilon\) times the
        !! largest \(|\mu|\).
        !!
        !! Source: LAPACK Users' Guide, 3rd ed., sec. 2.3.4.2; `dgeev`.
        real(dp), intent(in) :: matrix(:, :)              !! \(A\), finite, (n, n)
        character(*), intent(in) :: what                  !! is not found if that fails
        complex(dp), intent(out) :: values(:)             !! (n)
        complex(dp), intent(out) :: vectors(:, :)         !! (n, n), column j of `values(j)`
        type(error_t), allocatable, intent(out) :: error  !! status 4: no convergence
        real(dp), dimension(size(values), size(values)) :: a, z
        real(dp), dimension(size(values)) :: re, im
        real(dp) :: none(1, 1), work(20*size(values) + 100)
        integer :: j, n, info

        n = size(values)
        values = 0.0_dp
        vectors = 0.0_dp
        a = matrix
        call dgeev("N", "V", n, a, n, re, im, none, 1, z, n, work, size(work), info)
        if (info /= 0) then
            call fail(error, "LAPACK found no "//what//" (info = "//to_text(info)//")", &
                      status_library)
            return
        end if
        values = cmplx(re, im, dp)
        do j = 1, n
            vectors(:, j) = z(:, j)
            if (im(j) > 0.0_dp) vectors(:, j) = cmplx(z(:, j), z(:, j + 1), dp)
            if (im(j) < 0.0_dp) vectors(:, j) = cmplx(z(:, j - 1), -z(:, j), dp)
        end do
    end subroutine eigenpairs

    pure subroutine matrix_modes(stiffness, inertia, omega2, modes, error)
        !! Solve \(K u = \omega^2 M u\) with \(u^\top M u = 1\), \(\omega^2\) ascending; of each
        !! mode the component that is largest in magnitude is positive. Small \(\omega^2\) keep
        !! the digits that the elements of \(K\) and \(M\) leave them: see `lagrangia_jacobi`.
        !!
        !! Source: Landau & Lifshitz, *Mechanics*, 3rd ed., sec. 23; LAPACK `dsygv`, `dsygvd`.
        real(dp), intent(in) :: stiffness(:, :)            !! \(K\), symmetric, (n, n)
        real(dp), intent(in) :: inertia(:, :)              !! \(M\), positive definite, (n, n)
        real(dp), allocatable, intent(out) :: omega2(:)    !! squared frequencies, (n), s^-2
        real(dp), allocatable, intent(out) :: modes(:, :)  !! column j belongs to `omega2(j)`
        type(error_t), allocatable, intent(out) :: error   !! what is wrong with K or M
        real(dp), allocatable :: factor(:, :), work(:)
        integer, allocatable :: iwork(:)
        real(dp) :: size_wanted(1)
        integer :: n, i, info, integers_wanted(1)

        call check_matrix(stiffness, "K", error)
        if (allocated(error)) return
        call check_matrix(inertia, "M", error)
        if (allocated(error)) return
        n = size(stiffness, 1)
        if (size(inertia, 1) /= n) then
            call fail(error, "K has "//to_text(n)//" rows, M has "//to_text(size(inertia, 1)))
            return
        end if
        allocate (omega2(n), modes(n, n), factor(n, n))
        modes = stiffness
        factor = inertia
        if (n <= small) then
            allocate (work(max(1, 34*n)))
            call dsygv(1, "V", "L", n, modes, n, factor, n, omega2, work, size(work), info)
        else
            call dsygvd(1, "V", "L", n, modes, n, factor, n, omega2, size_wanted, -1, &
                        integers_wanted, -1, info)
            allocate (work(int(size_wanted(1))), iwork(integers_wanted(1)))
            call dsygvd(1, "V", "L", n, modes, n, factor, n, omega2, work, size(work), iwork, &
                        size(iwork), info)
        end if
        if (info > n) then
            call fail(error, "M is not positive definite: its leading minor of order "// &
                      to_text(info - n)//" is not", status_library)
        else if (info /= 0) then
            call fail(error, "LAPACK found no eigenvalues (info = "//to_text(info)//")", &
                      status_library)
        end if
        if (.not. (allocated(error) .or. all_finite(omega2))) call out_of_range(error)
        do i = 1, n
            if (allocated(error)) exit
            if (factor(i, i)**2 <= 4*n*epsilon(1.0_dp)*inertia(i, i)) call fail(error, &
                "M is singular to working precision: its leading minor of order "//to_text(i)// &
                " vanishes", status_library)
        end do
        if (allocated(error)) then
            deallocate (omega2, modes)
            return
        end if
        if (minval(abs(omega2)) < graded*maxval(abs(omega2))) then
            if (n <= small) modes = unit_masses(inertia)
            call refine_modes(stiffness, inertia, omega2, modes)
            call sort(omega2, modes)
        end if
        call orient(modes)
    end subroutine matrix_modes

    pure function unit_masses(inertia) result(modes)
        !! One coordinate a column, \(u^\top M u = 1\).
        real(dp), intent(in) :: inertia(:, :)
        real(dp) :: modes(size(inertia, 1), size(inertia, 1))
        integer :: i

        modes = 0.0_dp
        do i = 1, size(inertia, 1)
            modes(i, i) = 1.0_dp/sqrt(inertia(i, i))
        end do
    end function unit_masses

    pure subroutine sort(omega2, modes)
        !! Ascending, by insertion: they hardly are out of order.
        real(dp), intent(inout) :: omega2(:), modes(:, :)
        real(dp) :: one, column(size(modes, 1))
        integer :: i, k

        do i = 2, size(omega2)
            one = omega2(i)
            column = modes(:, i)
            do k = i - 1, 1, -1
                if (omega2(k) <= one) exit
                omega2(k + 1) = omega2(k)
                modes(:, k + 1) = modes(:, k)
            end do
            omega2(k + 1) = one
            modes(:, k + 1) = column
        end do
    end subroutine sort

    pure subroutine check_matrix(a, name, error)
        !! Square, not empty, finite, symmetric to rounding: that of an element, or of the sums of
        !! products of size \(\sqrt{a_{ii}a_{jj}}\) that it may come from.
        real(dp), intent(in) :: a(:, :)
        character(*), intent(in) :: name
        type(error_t), allocatable, intent(out) :: error
        integer :: i, j

        if (size(a, 1) /= size(a, 2) .or. size(a) == 0) then
            call fail(error, name//" is "//to_text(size(a, 1))//" by "//to_text(size(a, 2))// &
                      ": a square matrix is needed")
            return
        end if
        do j = 1, size(a, 2)
            do i = 1, j
                if (is_zero(a(i, j) - a(j, i))) cycle  ! finite, too
                if (.not. (ieee_is_finite(a(i, j)) .and. ieee_is_finite(a(j, i)))) then
                    call fail(error, name//"("//to_text(i)//", "//to_text(j)//") is not finite")
                else if (abs(a(i, j) - a(j, i)) > 8.0_dp*epsilon(a)*max( &
                         abs(a(i, j)), abs(a(j, i)), sqrt(abs(a(i, i)))*sqrt(abs(a(j, j))))) then
                    call fail(error, name//" is not symmetric: "//name//"("//to_text(i)//", "// &
                              to_text(j)//") = "//to_text(a(i, j))//", "//name//"("//to_text(j)// &
                              ", "//to_text(i)//") = "//to_text(a(j, i)))
                end if
                if (allocated(error)) return
            end do
        end do
    end subroutine check_matrix

    pure subroutine orient(modes)
        !! Signs vary with the BLAS: let the largest component be positive (the first of equals).
        real(dp), intent(inout) :: modes(:, :)
        real(dp) :: enough
        integer :: j, k

        do j = 1, size(modes, 2)
            enough = (1.0_dp - 1e-8_dp)*maxval(abs(modes(:, j)))
            do k = 1, size(modes, 1)
                if (abs(modes(k, j)) < enough) cycle
                if (modes(k, j) < 0.0_dp) modes(:, j) = -modes(:, j)
                exit
            end do
        end do
    end subroutine orient

    pure subroutine modes_from_factors(root, inverse, omega2, modes, error)
        !! The same for \(K = S^\top S\), \(M = (WW^\top)^{-1}\): the frequencies are the singular
        !! values of \(SW\), each to a few ulp however the masses and lengths are graded, where
        !! `dsygv` loses the small ones. Rows that `S` lacks are zero modes, exactly.
        !!
        !! Source: Drmač & Veselić, SIAM J. Matrix Anal. Appl. 29 (2008) 1322; LAPACK `dgejsv`.
        real(dp), intent(in) :: root(:, :)     !! \(S\), (rank, n), rank <= n
        real(dp), intent(in) :: inverse(:, :)  !! \(W\), (n, n): \(W^\top M W = 1\)
        real(dp), allocatable, intent(out) :: omega2(:), modes(:, :)
        !! squares, ascending, (n); \(U\), a column each
        type(error_t), allocatable, intent(out) :: error  !! status 4: not finite, no convergence
        real(dp), allocatable :: product(:, :), sigma(:), u(:, :), v(:, :), work(:)
        integer, allocatable :: iwork(:)
        real(dp) :: scale
        integer :: n, rank, info, j

        n = size(inverse, 1)
        rank = size(root, 1)
        allocate (product(n, rank), sigma(rank), u(n, n), v(rank, rank), iwork(n + 3*n))
        allocate (work(max(7, 6*n + 2*n*n + 2*n + n)))
        product = transpose(matmul(root, inverse))
        if (.not. all_finite(product)) then
            call fail(error, "the factors of K and M are not finite", status_library)
            return
        end if
        call dgejsv("F", "F", "V", "N", "N", "N", n, rank, product, n, sigma, u, n, v, rank, work, &
                    size(work), iwork, info)
        if (info /= 0) then
            call fail(error, "LAPACK found no singular values (info = "//to_text(info)//")", &
                      status_library)
            return
        end if
        scale = work(1)/work(2)
        allocate (omega2(n), modes(n, n))
        omega2 = 0.0_dp
        do j = 1, rank
            omega2(n + 1 - j) = (scale*sigma(j))**2
            modes(:, n + 1 - j) = matmul(inverse, u(:, j))
        end do
        do j = rank + 1, n
            modes(:, n + 1 - j) = matmul(inverse, u(:, j))
        end do
        if (.not. (all_finite(omega2) .and. all_finite(modes))) then
            call out_of_range(error)
            return
        end if
        call orient(modes)
    end subroutine modes_from_factors

    pure subroutine out_of_range(error)
        !! Where products of what is given overflow.
        type(error_t), allocatable, intent(out) :: error  !! status 4

        call fail(error, "M or K, or omega^2, is beyond the range of doubles: other units are "// &
                  "needed", status_library)
    end subroutine out_of_range

    pure function residual_ratio(stiffness, inertia, omega2, modes) result(ratio)
        !! LAPACK's own measure \(\|KZ - MZ\Lambda\|/(\|K\|\,\|Z\|\,n\,\epsilon)\) in the 1-norm:
        !! below 30 or so where all is well; NaN for matrices that do not fit each other.
        real(dp), intent(in) :: stiffness(:, :), inertia(:, :), omega2(:), modes(:, :)
        !! \(K\), \(M\), \(\omega^2\), \(U\)
        real(dp) :: ratio, scale
        real(dp), dimension(size(modes, 1), size(modes, 2)) :: residual

        ratio = ieee_value(ratio, ieee_quiet_nan)
        if (any([shape(stiffness), shape(inertia), shape(modes)] /= size(omega2))) return
        residual = matmul(stiffness, modes) - &
                   matmul(inertia, modes)*spread(omega2, 1, size(modes, 1))
        scale = norm1(stiffness)*norm1(modes)*size(omega2)*epsilon(scale)
        ratio = 0.0_dp
        if (scale > 0.0_dp) ratio = norm1(residual)/scale
    end function residual_ratio

    pure function norm1(a) result(norm)
        !! The largest sum of magnitudes in a column.
        real(dp), intent(in) :: a(:, :)  !! at least one column
        real(dp) :: norm                 !! in the unit of `a`

        norm = maxval(sum(abs(a), 1))
    end function norm1
end module lagrangia_eigen
