module lagrangia_gyroscopic
    !! Small oscillations that velocities bend: \(M\ddot u + G\dot u + Ku = 0\), \(G^\top = -G\).
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_eigen, only: normal_modes
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_kinds, only: dp
    use lagrangia_lapack_eigen, only: dggev
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: gyroscopic_modes, gyroscopic_ratio, is_steady

    real(dp), parameter :: blur = 1e-7_dp  !! a double eigenvalue splits by the root of epsilon

contains

    pure subroutine gyroscopic_modes(stiffness, gyroscopic, inertia, lambda, modes, error)
        !! Solve \((\lambda^2 M + \lambda G + K)u = 0\), \(u^\dagger M u = 1\): n eigenvalues,
        !! one of each pair \(\pm\lambda\), \(-\mathrm{Re}\,\lambda^2\) ascending; of each mode the
        !! component that is largest in magnitude is real and positive.
        !!
        !! The first-order form is solved in units in which its blocks are of size one. Where
        !! \(\lambda = i\omega\), \(\omega\) is then the root of \(\omega^2 - (iu^\dagger Gu)\omega
        !! - u^\dagger Ku = 0\): stationary in \(u\), it has the square of \(u\)'s error, and a slow
        !! mode beside a fast one keeps its digits.
        !!
        !! Source: Tisseur & Meerbergen, SIAM Review 43 (2001) 235, sec. 3; LAPACK `dggev`.
        real(dp), intent(in) :: stiffness(:, :)    !! \(K\), symmetric, (n, n)
        real(dp), intent(in) :: gyroscopic(:, :)   !! \(G\), antisymmetric, (n, n)
        real(dp), intent(in) :: inertia(:, :)      !! \(M\), positive definite, (n, n)
        complex(dp), allocatable, intent(out) :: lambda(:)    !! (n), s^-1
        complex(dp), allocatable, intent(out) :: modes(:, :)  !! column j belongs to `lambda(j)`
        type(error_t), allocatable, intent(out) :: error      !! what is wrong with K, G or M
        real(dp), allocatable :: omega2(:), shapes(:, :)
        complex(dp), dimension(2*size(stiffness, 1)) :: all_lambda
        complex(dp), dimension(size(stiffness, 1), 2*size(stiffness, 1)) :: all_modes
        integer :: chosen(size(stiffness, 1))
        integer :: n, k

        call normal_modes(stiffness, inertia, omega2, shapes, error)
        if (allocated(error)) return
        call check_antisymmetric(gyroscopic, size(omega2), error)
        if (allocated(error)) return
        call solve_first_order(stiffness, gyroscopic, inertia, all_lambda, all_modes, error)
        if (allocated(error)) return
        n = size(omega2)
        call one_of_each_pair(all_lambda, chosen)
        lambda = all_lambda(chosen)
        modes = all_modes(:, chosen)
        do k = 1, n
            call normalise(inertia, modes(:, k))
            if (abs(real(lambda(k))) > blur*maxval(abs(lambda))) cycle
            lambda(k) = cmplx(0.0_dp, stationary(stiffness, gyroscopic, modes(:, k), &
                                                 aimag(lambda(k))), dp)
        end do
        call sort(lambda, modes)
    end subroutine gyroscopic_modes

    elemental function is_steady(lambda) result(yes)
        !! Whether the motion neither grows nor decays.
        complex(dp), intent(in) :: lambda
        logical :: yes

        yes = abs(real(lambda)) <= blur*abs(lambda)
    end function is_steady

    pure subroutine check_antisymmetric(g, n, error)
        !! n by n, finite, \(G^\top = -G\) to rounding.
        real(dp), intent(in) :: g(:, :)
        integer, intent(in) :: n
        type(error_t), allocatable, intent(out) :: error

        if (any(shape(g) /= n)) then
            call fail(error, "G is "//to_text(size(g, 1))//" by "//to_text(size(g, 2))// &
                      ", K and M have "//to_text(n)//" rows")
        else if (.not. all(ieee_is_finite(g))) then
            call fail(error, "G is not finite")
        else if (any(abs(g + transpose(g)) > 8.0_dp*epsilon(g)*maxval(abs(g)))) then
            call fail(error, "G is not antisymmetric")
        end if
    end subroutine check_antisymmetric

    pure subroutine solve_first_order(stiffness, gyroscopic, inertia, lambda, modes, error)
        !! All 2n eigenvalues of \((0, 1; -K, -G)\) against \((1, 0; 0, M)\).
        real(dp), intent(in) :: stiffness(:, :), gyroscopic(:, :), inertia(:, :)
        complex(dp), intent(out) :: lambda(:), modes(:, :)  !! (2 n), (n, 2 n)
        type(error_t), allocatable, intent(out) :: error
        real(dp), dimension(2*size(stiffness, 1), 2*size(stiffness, 1)) :: a, b, vectors
        real(dp), dimension(2*size(stiffness, 1)) :: re, im, beta
        real(dp) :: left(1, 1), work(40*size(stiffness, 1) + 100), mass, rate
        integer :: n, i, j, info

        lambda = 0.0_dp
        modes = 0.0_dp
        n = size(stiffness, 1)
        mass = maxval(abs(inertia))
        rate = max(sqrt(maxval(abs(stiffness))/mass), maxval(abs(gyroscopic))/mass)
        if (rate <= 0.0_dp) rate = 1.0_dp
        a = 0.0_dp
        b = 0.0_dp
        do i = 1, n
            a(i, n + i) = 1.0_dp
            b(i, i) = 1.0_dp
        end do
        a(n + 1:, :n) = -stiffness/mass/rate/rate
        a(n + 1:, n + 1:) = -gyroscopic/mass/rate
        b(n + 1:, n + 1:) = inertia/mass
        call dggev("N", "V", 2*n, a, 2*n, b, 2*n, re, im, beta, left, 1, vectors, 2*n, work, &
                   size(work), info)
        if (info /= 0 .or. any(abs(beta) <= 0.0_dp)) then
            call fail(error, "LAPACK found no frequencies (info = "//to_text(info)//"): M is "// &
                      "singular?", status_library)
            return
        end if
        lambda = rate*cmplx(re/beta, im/beta, dp)
        do j = 1, 2*n
            if (im(j) > 0.0_dp) then
                modes(:, j) = cmplx(vectors(:n, j), vectors(:n, j + 1), dp)
            else if (im(j) < 0.0_dp) then
                modes(:, j) = conjg(modes(:, j - 1))
            else
                modes(:, j) = cmplx(vectors(:n, j), 0.0_dp, dp)
            end if
        end do
    end subroutine solve_first_order

    pure subroutine one_of_each_pair(lambda, chosen)
        !! The spectrum is symmetric, \(\pm\lambda\): from the largest down, take the one with
        !! \(\mathrm{Im} > 0\) (or real and positive) and drop its partner.
        complex(dp), intent(in) :: lambda(:)
        integer, intent(out) :: chosen(:)
        logical :: left(size(lambda)), upper(size(lambda))
        integer :: k, j, partner

        left = .true.
        upper = aimag(lambda) > 0.0_dp .or. &
                (abs(aimag(lambda)) <= 0.0_dp .and. real(lambda) > 0.0_dp)
        do k = 1, size(chosen)
            j = maxloc(abs(lambda), 1, left .and. upper)
            if (j == 0) j = maxloc(abs(lambda), 1, left)
            left(j) = .false.
            partner = minloc(abs(lambda + lambda(j)), 1, left)
            left(partner) = .false.
            chosen(k) = j
        end do
    end subroutine one_of_each_pair

    pure subroutine normalise(inertia, u)
        !! \(u^\dagger M u = 1\), the first of the largest components real and positive.
        real(dp), intent(in) :: inertia(:, :)
        complex(dp), intent(inout) :: u(:)
        integer :: k

        u = u/maxval(abs(u))
        k = findloc(abs(u) >= 1.0_dp - 1e-8_dp, .true., 1)
        u = u*(conjg(u(k))/abs(u(k)))
        u(k) = cmplx(real(u(k)), 0.0_dp, dp)
        u = u/sqrt(bilinear(inertia, real(u), real(u)) + bilinear(inertia, aimag(u), aimag(u)))
    end subroutine normalise

    pure function stationary(stiffness, gyroscopic, u, near) result(omega)
        !! The root of \(\omega^2 - c\,\omega - k = 0\) next to `near`, without cancellation.
        real(dp), intent(in) :: stiffness(:, :), gyroscopic(:, :)
        complex(dp), intent(in) :: u(:)
        real(dp), intent(in) :: near
        real(dp) :: omega, c, k, large, other

        c = bilinear(gyroscopic, aimag(u), real(u)) - bilinear(gyroscopic, real(u), aimag(u))
        k = bilinear(stiffness, real(u), real(u)) + bilinear(stiffness, aimag(u), aimag(u))
        large = 0.5_dp*(c + sign(sqrt(max(0.0_dp, c**2 + 4.0_dp*k)), c))
        other = 0.0_dp
        if (abs(large) > 0.0_dp) other = -k/large
        omega = abs(merge(large, other, abs(large - near) <= abs(other - near)))
    end function stationary

    pure function bilinear(a, x, y) result(value)
        !! \(x^\top A y\).
        real(dp), intent(in) :: a(:, :), x(:), y(:)
        real(dp) :: value
        integer :: j

        value = 0.0_dp
        do j = 1, size(y)
            value = value + dot_product(x, a(:, j))*y(j)
        end do
    end function bilinear

    pure subroutine sort(lambda, modes)
        !! By \(-\mathrm{Re}\,\lambda^2\), ascending: the unstable ones first.
        complex(dp), intent(inout) :: lambda(:), modes(:, :)
        complex(dp) :: one, column(size(modes, 1))
        integer :: i, k

        do i = 1, size(lambda) - 1
            k = i - 1 + minloc(-real(lambda(i:)**2), 1)
            one = lambda(i)
            column = modes(:, i)
            lambda(i) = lambda(k)
            modes(:, i) = modes(:, k)
            lambda(k) = one
            modes(:, k) = column
        end do
    end subroutine sort

    pure function gyroscopic_ratio(stiffness, gyroscopic, inertia, lambda, modes) result(ratio)
        !! The largest \(\|(\lambda^2M + \lambda G + K)u\|\) over \((\rho^2\|M\| +
        !! \rho\|G\| + \|K\|)\,\|u\|\,n\,\epsilon\), \(\rho = \max|\lambda|\), in the 1-norm.
        real(dp), intent(in) :: stiffness(:, :), gyroscopic(:, :), inertia(:, :)
        complex(dp), intent(in) :: lambda(:), modes(:, :)
        real(dp) :: ratio, scale, rho
        complex(dp) :: residual(size(lambda))
        integer :: i, j

        ratio = 0.0_dp
        rho = maxval(abs(lambda))
        scale = (rho**2*norm1(inertia) + rho*norm1(gyroscopic) + norm1(stiffness))* &
                size(lambda)*epsilon(scale)
        if (scale <= 0.0_dp) return
        do j = 1, size(lambda)
            residual = 0.0_dp
            do i = 1, size(lambda)
                residual = residual + modes(i, j)*(lambda(j)**2*inertia(:, i) + &
                                                   lambda(j)*gyroscopic(:, i) + stiffness(:, i))
            end do
            ratio = max(ratio, sum(abs(residual))/(scale*sum(abs(modes(:, j)))))
        end do
    end function gyroscopic_ratio

    pure function norm1(a) result(norm)
        !! The largest sum of magnitudes in a column.
        real(dp), intent(in) :: a(:, :)
        real(dp) :: norm

        norm = maxval(sum(abs(a), 1))
    end function norm1
end module lagrangia_gyroscopic
