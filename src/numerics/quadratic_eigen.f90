module lagrangia_quadratic_eigen
    !! The exponents of small oscillations with damping, \(M\ddot u + D\dot u + Ku = 0\), the
    !! slowest as right as the fastest.
    use lagrangia_eigen, only: eigenpairs
    use lagrangia_errors, only: error_t
    use lagrangia_gyroscopic, only: fast_modes
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use lagrangia_number_class, only: is_nonzero, is_zero
    implicit none (type, external)
    private
    public :: quadratic_eigenvalues

contains

    pure subroutine quadratic_eigenvalues(mass, damping, stiffness, lambda, error)
        !! The \(\lambda\) of \((\lambda^2M + \lambda D + K)u = 0\), all 2n, with magnitudes that
        !! fall.
        !!
        !! LAPACK's `dgeev` errs by \(\epsilon\) times the largest \(|\lambda|\). The first-order
        !! form of \(M\ddot u = -D\dot u - Ku\) therefore gives the fast ones, and where K is not
        !! singular that of \(1/\lambda\), \(Ku = -\dots\), the slow ones. A step of Newton's method
        !! mends those between. Each is then the root of
        !! \(\lambda^2\,u^\dagger Mu + \lambda\,u^\dagger Du + u^\dagger Ku = 0\) with its own
        !! vector, without the difference of two nearly equal numbers: of an oscillation
        !! \(\mathrm{Re}\,\lambda = -(c\,\omega + k_i)/(2m\omega + g)\), where \(m\), \(c + ig\) and
        !! \(k_r + ik_i\) are those three products. Two that nearly meet, at critical damping, are
        !! right to the root of \(\epsilon\).
        !!
        !! Source: Tisseur & Meerbergen, SIAM Review 43 (2001) 235, sec. 3.4 and 5.1.
        real(dp), intent(in) :: mass(:, :)                  !! \(M\), positive definite, (n, n)
        real(dp), intent(in) :: damping(:, :)               !! \(D\), (n, n)
        real(dp), intent(in) :: stiffness(:, :)             !! \(K\), (n, n)
        complex(dp), allocatable, intent(out) :: lambda(:)  !! (2n), 1/s
        type(error_t), allocatable, intent(out) :: error    !! status 4: LAPACK, a singular M
        complex(dp), dimension(2*size(mass, 1)) :: all_fast, all_slow
        complex(dp), dimension(size(mass, 1), 2*size(mass, 1)) :: shapes, slow_shapes
        type(error_t), allocatable :: singular
        real(dp) :: noise
        integer :: fast, j

        allocate (lambda(2*size(mass, 1)))
        call first_order(mass, damping, stiffness, all_fast, shapes, error)
        if (allocated(error)) return
        fast = size(lambda)
        call first_order(stiffness, damping, mass, all_slow, slow_shapes, singular)
        if (.not. allocated(singular)) then
            if (all(abs(all_slow) > 0.0_dp)) then
                all_slow = 1.0_dp/all_slow(size(lambda):1:-1)
                fast = fast_modes(abs(all_fast))
                all_fast(fast + 1:) = all_slow(fast + 1:)
                shapes(:, fast + 1:) = slow_shapes(:, size(lambda) - fast:1:-1)
            end if
        end if
        do j = 1, size(lambda)
            if (j <= fast) noise = 16*size(lambda)*epsilon(noise)*abs(all_fast(1))
            if (j > fast) noise = 1e-6_dp*abs(all_fast(j))
            call improve(all_fast(j), shapes(:, j), noise, mass, damping, stiffness)
            lambda(j) = refined(all_fast(j), noise, shapes(:, j), mass, damping, stiffness)
        end do
    end subroutine quadratic_eigenvalues

    pure subroutine first_order(leading, middle, last, values, vectors, error)
        !! The \(\mu\) of \((\mu^2A + \mu B + C)u = 0\), with magnitudes that fall, and their u.
        real(dp), intent(in) :: leading(:, :), middle(:, :), last(:, :)  !! A, B, C
        complex(dp), intent(out) :: values(:), vectors(:, :)             !! (2n), (n, 2n)
        type(error_t), allocatable, intent(out) :: error
        complex(dp) :: pairs(size(values)), z(size(values), size(values))
        real(dp) :: a(size(values), size(values)), size_of(size(values)), noise
        real(dp), dimension(size(leading, 1)) :: column
        integer :: i, j, n

        n = size(leading, 1)
        values = 0.0_dp
        vectors = 0.0_dp
        a = 0.0_dp
        do j = 1, n
            a(j, n + j) = 1.0_dp
            call solve_linear(leading, -last(:, j), column, error)
            if (allocated(error)) return
            a(n + 1:, j) = column
            call solve_linear(leading, -middle(:, j), column, error)
            if (allocated(error)) return
            a(n + 1:, n + j) = column
        end do
        call eigenpairs(a, "damped modes", pairs, z, error)
        if (allocated(error)) return
        size_of = hypot(real(pairs), aimag(pairs))
        noise = 16*n*epsilon(noise)*maxval(size_of)
        do i = 1, 2*n
            j = maxloc(size_of, 1)
            size_of(j) = -1.0_dp
            values(i) = pairs(j)
            if (abs(aimag(pairs(j))) <= noise) values(i) = real(pairs(j))
            vectors(:, i) = z(:n, j)
        end do
    end subroutine first_order

    pure subroutine improve(lambda, u, noise, mass, damping, stiffness)
        !! A step of Newton's method for \(Q(\lambda)u = 0\), \(Q = \lambda^2M + \lambda D + K\),
        !! with a change of u across u; none where two eigenvalues meet.
        complex(dp), intent(inout) :: lambda, u(:)
        real(dp), intent(in) :: noise  !! how far `lambda` may be off
        real(dp), intent(in) :: mass(:, :), damping(:, :), stiffness(:, :)
        complex(dp) :: q(size(u) + 1, size(u) + 1), r(size(u) + 1), change(size(u) + 1)
        real(dp), dimension(2*size(u) + 2, 2*size(u) + 2) :: a
        real(dp) :: x(2*size(u) + 2)
        type(error_t), allocatable :: singular
        integer :: n

        n = size(u) + 1
        q = 0.0_dp
        r = 0.0_dp
        q(:n - 1, :n - 1) = lambda**2*mass + lambda*damping + stiffness
        r(:n - 1) = -matmul(q(:n - 1, :n - 1), u)
        q(:n - 1, n) = matmul(2.0_dp*lambda*mass + damping, u)
        q(n, :n - 1) = conjg(u)
        a(:n, :n) = real(q)
        a(:n, n + 1:) = -aimag(q)
        a(n + 1:, :n) = aimag(q)
        a(n + 1:, n + 1:) = real(q)
        call solve_linear(a, [real(r), aimag(r)], x, singular)
        if (allocated(singular)) return
        change = cmplx(x(:n), x(n + 1:), dp)
        if (.not. abs(change(n)) <= noise + 1e-6_dp*abs(lambda)) return
        if (.not. norm2(abs(change(:n - 1))) <= 1e-3_dp*norm2(abs(u))) return
        u = u + change(:n - 1)
        if (is_zero(aimag(lambda))) change(n) = real(change(n))
        lambda = lambda + change(n)
    end subroutine improve

    pure function refined(lambda, noise, u, mass, damping, stiffness) result(better)
        !! The root near `lambda` of the quadratic that its vector makes. A sum that is no more than
        !! its rounding is 0.
        complex(dp), intent(in) :: lambda, u(:)
        real(dp), intent(in) :: noise  !! how far `lambda` may be off
        real(dp), intent(in) :: mass(:, :), damping(:, :), stiffness(:, :)
        complex(dp) :: better
        real(dp) :: c, g, m, k, k_i, omega, roots(2)

        omega = aimag(lambda)
        call form_of(mass, u, m, k_i)
        call form_of(damping, u, c, g)
        call form_of(stiffness, u, k, k_i)
        if (is_nonzero(omega)) then
            better = cmplx(-(c*omega + k_i)/(2.0_dp*m*omega + g), omega, dp)
        else
            better = lambda
            roots(1) = c**2 - 4.0_dp*m*k
            if (roots(1) < 0.0_dp) return
            if (max(abs(c), abs(k)) <= 0.0_dp) then  ! it moves freely: a double 0
                better = 0.0_dp
                return
            end if
            roots = -0.5_dp*(c + sign(sqrt(roots(1)), c))
            roots(1) = roots(1)/m
            if (is_nonzero(roots(2))) roots(2) = k/roots(2)
            better = roots(minloc(abs(roots - real(lambda)), 1))
        end if
        if (.not. abs(better - lambda) <= noise + 1e-6_dp*abs(lambda)) better = lambda
    end function refined

    pure subroutine form_of(a, u, re, im)
        !! \(u^\dagger Au\): the real part is the symmetric part's, the imaginary one the rest's.
        real(dp), intent(in) :: a(:, :)
        complex(dp), intent(in) :: u(:)
        real(dp), intent(out) :: re, im
        real(dp) :: parts(2, size(u), size(u)), size_of(2)
        integer :: i, j

        do j = 1, size(u)
            do i = 1, size(u)
                parts(1, i, j) = 0.5_dp*(a(i, j) + a(j, i))*real(conjg(u(i))*u(j))
                parts(2, i, j) = -0.5_dp*(a(i, j) - a(j, i))*aimag(conjg(u(i))*u(j))
            end do
        end do
        size_of = 4*size(u)*epsilon(size_of)*[sum(abs(parts(1, :, :))), sum(abs(parts(2, :, :)))]
        re = sum(parts(1, :, :))
        im = sum(parts(2, :, :))
        if (abs(re) <= size_of(1)) re = 0.0_dp
        if (abs(im) <= size_of(2)) im = 0.0_dp
    end subroutine form_of
end module lagrangia_quadratic_eigen
