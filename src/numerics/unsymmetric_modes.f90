module lagrangia_unsymmetric_modes
    !! \(K a = \omega^2 M a\) where forces beside L leave K without symmetry.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use lagrangia_lapack_eigen, only: dgeev
    use lagrangia_number_class, only: is_zero
    implicit none (type, external)
    private
    public :: unsymmetric_modes

contains

    subroutine unsymmetric_modes(stiffness, mass, omega2, shapes, known)
        !! The modes, the smallest \(\omega^2\) first.
        real(dp), intent(in) :: stiffness(:, :), mass(:, :)  !! K and M, (n, n), finite
        real(dp), intent(out) :: omega2(:)                   !! n; 0 where they are not known
        real(dp), intent(out) :: shapes(:, :)                !! a column each, (n, n)
        logical, intent(out) :: known                        !! all are real, and M is regular
        real(dp), dimension(size(omega2), size(omega2)) :: a, right
        real(dp) :: im(size(omega2)), left(1, 1), of(size(omega2)), work(20*size(omega2) + 100)
        type(error_t), allocatable :: error
        integer :: info, j, least, n

        n = size(omega2)
        omega2 = 0.0_dp
        shapes = 0.0_dp
        do j = 1, n
            call solve_linear(mass, stiffness(:, j), a(:, j), error)
            known = .not. allocated(error)
            if (.not. known) return
        end do
        call dgeev("N", "V", n, a, n, of, im, left, 1, right, n, work, size(work), info)
        known = info == 0 .and. all(is_zero(im))
        if (.not. known) return
        do j = 1, n
            least = minloc(of, 1)
            omega2(j) = of(least)
            shapes(:, j) = right(:, least)
            of(least) = huge(of)
        end do
    end subroutine unsymmetric_modes
end module lagrangia_unsymmetric_modes
