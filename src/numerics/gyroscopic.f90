module lagrangia_gyroscopic
    !! Small oscillations with gyroscopic forces: \(M\ddot u + G\dot u + Ku = 0\), \(G^\top = -G\).
    use lagrangia_eigen, only: eigenpairs, norm1, normal_modes
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: all_finite, is_nonzero, is_zero
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: fast_modes, gyroscopic_modes, gyroscopic_ratio, is_steady

    real(dp), parameter :: blur = 1e-7_dp  !! a double eigenvalue splits by the root of epsilon

contains

    pure subroutine gyroscopic_modes(stiffness, gyroscopic, inertia, lambda, modes, error)
        !! Solve \((\lambda^2 M + \lambda G + K)u = 0\), \(u^\dagger M u = 1\): n eigenvalues,
        !! one of each pair \(\pm\lambda\), \(-\mathrm{Re}\,\lambda^2\) ascending; of each mode the
        !! component that is largest in magnitude is real and positive.
        !!
        !! In the normal modes without \(G\), scaled by their \(\rho_i = |\omega_i|\), the
        !! first-order form is a skew matrix where K is positive definite, and its inverse is
        !! known element by element: the fast modes are solved from the one, the slow ones from
        !! the other, each with an error of \(\epsilon\) times the ratio of its own frequency to
        !! the outermost. Where \(\lambda = i\omega\), \(\omega\) is then the root of \(\omega^2 -
        !! (iu^\dagger Gu)\omega - u^\dagger Ku = 0\), stationary in \(u\). A singular K has no
        !! inverse: beside its zero modes the slow ones have an error of \(\epsilon\) times the
        !! fastest. Two modes of one shape have the mean of their eigenvalues, see `join_twins`.
        !!
        !! Source: Tisseur & Meerbergen, SIAM Review 43 (2001) 235, sec. 3; LAPACK `dgeev`.
        real(dp), intent(in) :: stiffness(:, :)               !! \(K\), symmetric, (n, n)
        real(dp), intent(in) :: gyroscopic(:, :)              !! \(G\), antisymmetric, (n, n)
        real(dp), intent(in) :: inertia(:, :)                 !! \(M\), positive definite, (n, n)
        complex(dp), allocatable, intent(out) :: lambda(:)    !! (n), s^-1
        complex(dp), allocatable, intent(out) :: modes(:, :)  !! column j belongs to `lambda(j)`
        type(error_t), allocatable, intent(out) :: error
        !! what is wrong with K, G or M, or frequencies too far apart
        real(dp), allocatable :: omega2(:), shapes(:, :)
        complex(dp), dimension(size(stiffness, 1)) :: other
        complex(dp), dimension(size(stiffness, 1), size(stiffness, 1)) :: other_modes
        real(dp), dimension(size(stiffness, 1), size(stiffness, 1)) :: coupling
        logical :: joined(size(stiffness, 1))
        real(dp) :: scale
        integer :: n, k, fast

        call normal_modes(stiffness, inertia, omega2, shapes, error)
        if (allocated(error)) return
        n = size(omega2)
        call check_antisymmetric(gyroscopic, n, error)
        if (allocated(error)) return
        coupling = matmul(transpose(shapes), matmul(gyroscopic, shapes))
        coupling = 0.5_dp*(coupling - transpose(coupling))
        allocate (lambda(n), modes(n, n))
        fast = n
        call solve_first_order(omega2, coupling, .false., lambda, modes, error)
        if (.not. allocated(error) .and. all(is_nonzero(omega2))) then
            call solve_first_order(omega2, coupling, .true., other, other_modes, error)
            if (.not. allocated(error)) fast = fast_modes(abs(lambda))
            lambda(fast + 1:) = other(fast + 1:)
            modes(:, fast + 1:) = other_modes(:, fast + 1:)
            if (.not. allocated(error)) call check_spread(abs(lambda), fast, abs(omega2), error)
        end if
        if (allocated(error)) then
            deallocate (lambda, modes)
            return
        end if
        call join_twins(lambda, modes, joined)
        do k = 1, n
            scale = merge(abs(lambda(1)), abs(lambda(k))/abs(lambda(n))*abs(lambda(k)), k <= fast)
            if (abs(real(lambda(k))) <= blur*scale .and. .not. joined(k)) then
                call refine(omega2, coupling, modes(:, k), lambda(k))
            end if
            modes(:, k) = matmul(shapes, modes(:, k))
            call normalise(inertia, modes(:, k))
        end do
        call sort(lambda, modes)
    end subroutine gyroscopic_modes

    pure subroutine check_spread(size_of, fast, squares, error)
        !! Fails where a mode is so far from both the fastest and the slowest one that it is lost
        !! in the rounding of the matrix that it is solved from: what is found for it then may be
        !! anything, but \(\prod_k|\lambda_k|^2 = |\det K|/\det M\), whatever G is.
        real(dp), intent(in) :: size_of(:)  !! \(|\lambda|\), (n); descending if none is lost
        integer, intent(in) :: fast         !! how many are solved from the matrix itself
        real(dp), intent(in) :: squares(:)  !! \(|\omega^2|\) without G, none 0, (n)
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: most = 1e-3_dp  !! `refine` leaves about its square
        real(dp) :: lost, product
        integer :: k, n

        n = size(size_of)
        product = abs(sum(log(max(size_of, tiny(lost)))) - 0.5_dp*sum(log(squares)))
        do k = 1, n
            lost = merge(size_of(1)/size_of(k), size_of(k)/max(size_of(n), tiny(lost)), &
                         k <= fast)*epsilon(lost)
            if (.not. (lost > most .or. product > n*most)) cycle
            call fail(error, "with G the frequencies, the fastest "//to_text(size_of(1))// &
                      " rad/s, are more digits apart than doubles can tell", status_library)
            return
        end do
    end subroutine check_spread

    elemental function is_steady(lambda) result(yes)
        !! Whether the motion neither grows nor decays.
        complex(dp), intent(in) :: lambda  !! eigenvalue, s^-1
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
        else if (.not. all_finite(g)) then
            call fail(error, "G is not finite")
        else if (any(abs(g + transpose(g)) > 8.0_dp*epsilon(g)*maxval(abs(g)))) then
            call fail(error, "G is not antisymmetric")
        end if
    end subroutine check_antisymmetric

    pure subroutine solve_first_order(omega2, coupling, inverse, lambda, modes, error)
        !! Of \(\ddot q_i + \sum_j\Gamma_{ij}\dot q_j + \omega_i^2q_i = 0\) as \(p_i = \rho_iq_i\),
        !! \(r = \dot q\), one of each pair \(\pm\lambda\), the fastest first.
        real(dp), intent(in) :: omega2(:), coupling(:, :)  !! \(\omega_i^2\), \(\Gamma\)
        logical, intent(in) :: inverse  !! whether to solve for \(1/\lambda\); no \(\rho_i\) is 0
        complex(dp), intent(out) :: lambda(:), modes(:, :)  !! (n), \(q\) in columns, (n, n)
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: a(2*size(omega2), 2*size(omega2)), rho(size(omega2))
        complex(dp) :: all_lambda(2*size(omega2)), vectors(2*size(omega2), 2*size(omega2))
        integer :: chosen(size(omega2)), n, i, j, k

        lambda = 0.0_dp
        modes = 0.0_dp
        n = size(omega2)
        rho = sqrt(abs(omega2))
        where (rho <= 0.0_dp) rho = max(maxval(rho), maxval(abs(coupling)), tiny(rho))
        a = 0.0_dp
        do i = 1, n
            if (inverse) then
                a(n + i, i) = 1.0_dp/rho(i)
                a(i, n + i) = -sign(1.0_dp/rho(i), omega2(i))
                a(i, :n) = -sign(1.0_dp/rho(i), omega2(i))*coupling(i, :)/rho
            else
                a(i, n + i) = rho(i)
                a(n + i, i) = -omega2(i)/rho(i)
                a(n + i, n + 1:) = -coupling(i, :)
            end if
        end do
        call eigenpairs(a, "frequencies", all_lambda, vectors, error)
        if (allocated(error)) return
        if (inverse) all_lambda = 1.0_dp/all_lambda
        call one_of_each_pair(all_lambda, chosen)
        do k = 1, n
            j = chosen(k)
            lambda(k) = all_lambda(j)
            where (rho >= abs(lambda(k)))
                modes(:, k) = vectors(:n, j)/rho
            else where
                modes(:, k) = vectors(n + 1:, j)/lambda(k)
            end where
        end do
    end subroutine solve_first_order

    pure function fast_modes(size_of) result(fast)
        !! How many, \(k\), are solved from the matrix itself: the \(k\) that makes
        !! \(\max(\lambda_1/\lambda_k, \lambda_{k+1}/\lambda_n)\) least, if
        !! \(\lambda_k > 2\lambda_{k+1}\); \(n\) where none is better than \(k = n\).
        real(dp), intent(in) :: size_of(:)  !! \(|\lambda|\), descending, (n)
        integer :: fast                     !! 1 to n
        integer :: k, n
        real(dp) :: worst, least

        n = size(size_of)
        fast = n
        least = size_of(1)/max(size_of(n), tiny(1.0_dp))
        do k = 1, n - 1
            if (.not. size_of(k) > 2.0_dp*size_of(k + 1)) cycle
            worst = max(size_of(1)/size_of(k), size_of(k + 1)/max(size_of(n), tiny(1.0_dp)))
            if (worst >= least) cycle
            least = worst
            fast = k
        end do
    end function fast_modes

    pure subroutine one_of_each_pair(lambda, chosen)
        !! The spectrum is symmetric, \(\pm\lambda\): from the largest down, take the one with
        !! \(\mathrm{Im} > 0\) (or real and positive) and drop its partner.
        complex(dp), intent(in) :: lambda(:)
        integer, intent(out) :: chosen(:)
        logical :: left(size(lambda)), upper(size(lambda))
        integer :: k, j, partner

        left = .true.
        upper = aimag(lambda) > 0.0_dp .or. &
                (is_zero(aimag(lambda)) .and. real(lambda) > 0.0_dp)
        do k = 1, size(chosen)
            j = maxloc(abs(lambda), 1, left .and. upper)
            if (j == 0) j = maxloc(abs(lambda), 1, left)
            left(j) = .false.
            partner = minloc(abs(lambda + lambda(j)), 1, left)
            left(partner) = .false.
            chosen(k) = j
        end do
    end subroutine one_of_each_pair

    pure subroutine join_twins(lambda, modes, joined)
        !! A double eigenvalue with one shape only is split by the root of rounding,
        !! \(\lambda\pm\delta\) with \(|\delta|^2\sim\epsilon\,|\lambda|\max|\lambda|\); the mean
        !! has an error of \(\epsilon\) again. Two that are truly as near are not better known one
        !! by one.
        complex(dp), intent(inout) :: lambda(:)  !! of both the mean
        complex(dp), intent(in) :: modes(:, :)   !! a column each
        logical, intent(out) :: joined(:)        !! that this was done
        real(dp), parameter :: alike = 1e-6_dp
        real(dp) :: near
        integer :: j, k

        joined = .false.
        do j = 2, size(lambda)
            near = 16.0_dp*sqrt(epsilon(near)*abs(lambda(j))*maxval(abs(lambda)))
            do k = 1, j - 1
                if (abs(lambda(j) - lambda(k)) > near) cycle
                if (is_zero(abs(lambda(j))) .or. joined(k)) cycle
                associate (u => modes(:, k), w => modes(:, j))
                    if (abs(dot_product(u, w)) < (1.0_dp - alike)*norm2(abs(u))*norm2(abs(w))) cycle
                end associate
                lambda([j, k]) = 0.5_dp*(lambda(j) + lambda(k))
                joined([j, k]) = .true.
                exit
            end do
        end do
    end subroutine join_twins

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

    pure subroutine refine(omega2, coupling, q, lambda)
        !! \(\lambda = i\omega\), \(\omega\) the root next to it of \(\omega^2 - c\,\omega - k
        !! = 0\), without cancellation.
        real(dp), intent(in) :: omega2(:), coupling(:, :)
        complex(dp), intent(in) :: q(:)
        complex(dp), intent(inout) :: lambda
        real(dp) :: c, k, m, large, other

        m = sum(real(q)**2 + aimag(q)**2)
        c = 2.0_dp*bilinear(coupling, aimag(q), real(q))/m
        k = sum(omega2*(real(q)**2 + aimag(q)**2))/m
        large = 0.5_dp*(c + sign(sqrt(max(0.0_dp, c**2 + 4.0_dp*k)), c))
        other = 0.0_dp
        if (is_nonzero(large)) other = -k/large
        if (abs(other - aimag(lambda)) < abs(large - aimag(lambda))) large = other
        lambda = cmplx(0.0_dp, abs(large), dp)
    end subroutine refine

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
        !! \(K\), \(G\), \(M\), (n, n)
        complex(dp), intent(in) :: lambda(:), modes(:, :)  !! s^-1; a column each
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
end module lagrangia_gyroscopic
