module lagrangia_quadratic_eigen
    !! The exponents of small oscillations with damping, \(M\ddot u + D\dot u + Ku = 0\), the
    !! slowest as right as the fastest.
    use lagrangia_eigen, only: eigenpairs
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_gyroscopic, only: fast_modes
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use lagrangia_null_space, only: least_vector
    use lagrangia_number_class, only: is_nonzero, is_zero
    use lagrangia_regular_pencil, only: equilibrate, leave_zeros_out
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: quadratic_eigenvalues

contains

    pure subroutine quadratic_eigenvalues(mass, damping, stiffness, lambda, error, rounding, &
                                          distance, unsure)
        !! The \(\lambda\) of \((\lambda^2M + \lambda D + K)u = 0\), all 2n, with magnitudes that
        !! fall.
        !!
        !! Those that are 0 are counted by ranks and taken out of the first-order form. LAPACK's
        !! `dgeev` errs by \(\epsilon\) times the largest \(|\lambda|\): that form therefore gives
        !! the fast ones, and its inverse the slow ones. A step of Newton's method mends those
        !! between. Each is then the root of
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
        real(dp), allocatable, intent(out), optional :: rounding(:)
        !! (2n), how far the rounding of the elements may have moved \(\mathrm{Re}\,\lambda\) of an
        !! oscillation, 1/s
        real(dp), allocatable, intent(out), optional :: distance(:)
        !! (2n), how far it may have moved \(\mathrm{Im}\,\lambda\), or a real \(\lambda\), 1/s
        real(dp), intent(in), optional :: unsure(:, :)
        !! by how much more than its rounding \(K\) may be off, (n, n); else nothing
        real(dp), allocatable :: e(:, :), a(:, :)
        complex(dp), allocatable :: fast_ones(:), slow_ones(:)
        complex(dp) :: shape_of(size(mass, 1))
        type(error_t), allocatable :: singular
        real(dp) :: moved(2*size(mass, 1)), most(2*size(mass, 1)), noise
        real(dp) :: springs(size(mass, 1), size(mass, 1))
        integer :: fast, i, j, n
        logical :: none

        n = size(mass, 1)
        allocate (lambda(2*n), source=(0.0_dp, 0.0_dp))
        moved = 0.0_dp
        most = 0.0_dp
        springs = 4.0_dp*epsilon(noise)*abs(stiffness)
        if (present(unsure)) springs = springs + unsure
        allocate (e(2*n, 2*n), a(2*n, 2*n), source=0.0_dp)
        do i = 1, n
            e(i, i) = 1.0_dp
            a(i, n + i) = 1.0_dp
        end do
        e(n + 1:, n + 1:) = mass
        a(n + 1:, :n) = -stiffness
        a(n + 1:, n + 1:) = -damping
        call leave_zeros_out(e, a, error)
        if (.not. allocated(error)) call eigenvalues(e, a, fast_ones, error)
        if (allocated(error)) return
        fast = size(fast_ones)
        call eigenvalues(a, e, slow_ones, singular)
        if (.not. allocated(singular) .and. all(abs(slow_ones) > 0.0_dp)) then
            slow_ones = 1.0_dp/slow_ones(fast:1:-1)
            fast = fast_modes(abs(fast_ones))
            fast_ones(fast + 1:) = slow_ones(fast + 1:)
        end if
        do j = 1, size(fast_ones)
            call find_shape(fast_ones(j), mass, damping, stiffness, shape_of, error)
            if (allocated(error)) return
            noise = 1e-6_dp*abs(fast_ones(j))
            if (j <= fast) noise = noise + 16*size(lambda)*epsilon(noise)*abs(fast_ones(1))
            call improve(fast_ones(j), shape_of, noise, mass, damping, stiffness)
            call refine(fast_ones(j), noise, shape_of, mass, damping, stiffness, lambda(j), &
                        moved(j))
            none = is_rounding(lambda(j), abs(fast_ones(1)), shape_of, mass, damping, stiffness)
            if (none) lambda(j) = 0.0_dp
            if (present(distance)) call bound(lambda(j), shape_of, mass, damping, stiffness, &
                                              springs, most(j), error)
            if (allocated(error)) return
            ! of the second order
            if (moved(j) > 0.0_dp) most(j) = most(j) + moved(j)**2/abs(aimag(lambda(j)))
        end do
        if (present(distance)) allocate (distance, source=most)
        if (present(rounding)) allocate (rounding, source=moved)
        if (size(fast_ones) > 0) call check_product(e, a, lambda(:size(fast_ones)), error)
    end subroutine quadratic_eigenvalues

    pure subroutine check_product(e, a, lambda, error)
        !! Fails unless \(\prod_k|\lambda_k| = |\det A|/|\det E|\): an eigenvalue so far from both
        !! the largest and the smallest that rounding drowned it may have become anything, 0 too.
        !! Singular matrices have another product, of which nothing is said.
        real(dp), intent(in) :: e(:, :), a(:, :)  !! without the zeros
        complex(dp), intent(in) :: lambda(:)      !! of \(\lambda Ex = Ax\)
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: most = 1e-3_dp
        real(dp) :: x(size(lambda)), zero(size(lambda)), above, below

        zero = 0.0_dp
        call solve_linear(a, zero, x, error, above)
        if (.not. allocated(error)) call solve_linear(e, zero, x, error, below)
        if (allocated(error)) then
            deallocate (error)
        else if (.not. abs(sum(log(max(abs(lambda), tiny(most)))) - above + below) <= &
                 size(lambda)*most) then
            call fail(error, "with damping the rates, the fastest "//to_text(abs(lambda(1)))// &
                      " 1/s, are more digits apart than doubles can tell", status_library)
        end if
    end subroutine check_product

    pure subroutine eigenvalues(e, a, values, error)
        !! The \(\mu\) of \(\mu Ex = Ax\), with magnitudes that fall.
        real(dp), intent(in) :: e(:, :), a(:, :)
        complex(dp), allocatable, intent(out) :: values(:)
        type(error_t), allocatable, intent(out) :: error
        complex(dp) :: found(size(e, 1)), vectors(size(e, 1), size(e, 1))
        real(dp) :: quotient(size(e, 1), size(e, 1)), size_of(size(e, 1)), noise
        integer :: i, j

        allocate (values(size(e, 1)))
        if (size(values) == 0) return
        do j = 1, size(values)
            call solve_linear(e, a(:, j), quotient(:, j), error)
            if (allocated(error)) return
        end do
        call eigenpairs(quotient, "damped modes", found, vectors, error)
        if (allocated(error)) return
        size_of = abs(found)
        noise = 8*size(values)*epsilon(noise)*maxval(size_of)
        do i = 1, size(values)
            j = maxloc(size_of, 1)
            size_of(j) = -1.0_dp
            values(i) = found(j)
            if (abs(aimag(found(j))) <= noise) values(i) = real(found(j))
        end do
    end subroutine eigenvalues

    pure subroutine find_shape(lambda, mass, damping, stiffness, u, error)
        !! The u that \(\lambda^2M + \lambda D + K\) shortens most, rows and columns of one size:
        !! of the terms, since what cancels in a coordinate of its own is that coordinate's mode.
        complex(dp), intent(in) :: lambda
        real(dp), intent(in) :: mass(:, :), damping(:, :), stiffness(:, :)
        complex(dp), intent(out) :: u(:)
        type(error_t), allocatable, intent(out) :: error
        complex(dp) :: q(size(u), size(u))
        real(dp) :: a(2*size(u), 2*size(u)), x(2*size(u))
        real(dp), allocatable :: rows(:), columns(:)
        integer :: i, n

        n = size(u)
        q = lambda**2*mass + lambda*damping + stiffness
        call equilibrate(abs(lambda)**2*abs(mass) + abs(lambda)*abs(damping) + abs(stiffness), &
                         rows, columns)
        do i = 1, n
            q(:, i) = rows*q(:, i)*columns(i)
        end do
        a(:n, :n) = real(q)
        a(:n, n + 1:) = -aimag(q)
        a(n + 1:, :n) = aimag(q)
        a(n + 1:, n + 1:) = real(q)
        if (is_zero(aimag(lambda))) then
            x(n + 1:) = 0.0_dp
            call least_vector(a(:n, :n), x(:n), error)
        else
            call least_vector(a, x, error)
        end if
        u = cmplx(x(:n), x(n + 1:), dp)
        where (abs(u) <= 4*epsilon(1.0_dp)*maxval(abs(u))) u = 0.0_dp  ! rounding
        u = columns*u
    end subroutine find_shape

    pure subroutine improve(lambda, u, noise, mass, damping, stiffness)
        !! A step of Newton's method for \(Q(\lambda)u = 0\), \(Q = \lambda^2M + \lambda D + K\),
        !! with a change of u across u; none where two eigenvalues meet.
        complex(dp), intent(inout) :: lambda, u(:)
        real(dp), intent(in) :: noise  !! how far `lambda` may be off
        real(dp), intent(in) :: mass(:, :), damping(:, :), stiffness(:, :)
        complex(dp) :: q(size(u) + 1, size(u) + 1), r(size(u) + 1), change(size(u) + 1)
        real(dp), dimension(2*size(u) + 2, 2*size(u) + 2) :: a
        real(dp), parameter :: least = 16.0_dp*epsilon(least)**2
        real(dp) :: weight(size(u)), x(2*size(u) + 2)
        type(error_t), allocatable :: singular
        integer :: i, n

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
        if (.not. abs(change(n)) <= noise) return
        if (.not. norm2(abs(change(:n - 1))) <= 1e-3_dp*norm2(abs(u))) return
        u = u + change(:n - 1)
        weight = abs(u)*sqrt([(mass(i, i), i=1, n - 1)])
        where (weight <= least*maxval(weight)) u = 0.0_dp  ! rounding of rounding: not coupled
        if (is_zero(aimag(lambda))) change(n) = real(change(n))
        lambda = lambda + change(n)
    end subroutine improve

    pure subroutine bound(lambda, u, mass, damping, stiffness, springs, distance, error)
        !! With the left vector w a change of the elements moves \(\lambda\) by
        !! \(-w^\dagger(\lambda^2\delta M + \lambda\,\delta D + \delta K)u/
        !! (w^\dagger(2\lambda M + D)u)\): the sum of what each element, off by \(4\epsilon\) of
        !! itself, does to the imaginary part, or to what is real. Where two eigenvalues meet the
        !! root of the numerator over \(|w^\dagger Mu|\) is less.
        complex(dp), intent(in) :: lambda, u(:)
        real(dp), intent(in) :: mass(:, :), damping(:, :), stiffness(:, :)
        real(dp), intent(in) :: springs(:, :)  !! \(\delta K\)
        real(dp), intent(out) :: distance
        type(error_t), allocatable, intent(out) :: error
        real(dp), parameter :: rounding = 4.0_dp*epsilon(1.0_dp)
        complex(dp) :: w(size(u)), slope, part, turned
        real(dp) :: total, curve
        integer :: i, j

        distance = 0.0_dp
        call find_shape(conjg(lambda), transpose(mass), transpose(damping), transpose(stiffness), &
                        w, error)
        if (allocated(error)) return
        slope = dot_product(w, matmul(2.0_dp*lambda*mass + damping, u))
        if (abs(slope) <= 0.0_dp) slope = tiny(total)
        turned = merge((1.0_dp, 0.0_dp), (0.0_dp, -1.0_dp), is_zero(aimag(lambda)))
        total = 0.0_dp
        do j = 1, size(u)
            do i = 1, size(u)
                part = turned*conjg(w(i))*u(j)/slope
                distance = distance + abs(real(part))*springs(i, j) + rounding* &
                           (abs(real(lambda*part)*damping(i, j)) + &
                            abs(real(lambda**2*part)*mass(i, j)))
                total = total + abs(w(i))*abs(u(j))*(springs(i, j) + rounding* &
                        (abs(lambda*damping(i, j)) + abs(lambda**2*mass(i, j))))
            end do
        end do
        curve = abs(dot_product(w, matmul(mass, u)))
        distance = min(distance, sqrt(total/max(curve, tiny(curve))))
    end subroutine bound

    pure function is_rounding(lambda, largest, u, mass, damping, stiffness) result(yes)
        !! Is it what rounding leaves of a multiple 0, \(|\lambda| \le
        !! 16n\epsilon\,|\lambda|_\max\) and, with the left vector w,
        !! \(|\lambda w^\dagger(\lambda M + D)u| \le 4n\epsilon\,|w|^\top|K||u|\)?
        complex(dp), intent(in) :: lambda, u(:)
        real(dp), intent(in) :: largest  !! \(|\lambda|_\max\)
        real(dp), intent(in) :: mass(:, :), damping(:, :), stiffness(:, :)
        logical :: yes
        complex(dp) :: w(size(u))
        type(error_t), allocatable :: error
        real(dp) :: rounding

        rounding = 4*size(u)*epsilon(rounding)
        yes = abs(lambda) <= 4.0_dp*rounding*largest
        if (.not. yes) return
        call find_shape(conjg(lambda), transpose(mass), transpose(damping), transpose(stiffness), &
                        w, error)
        if (allocated(error)) return
        yes = abs(lambda*dot_product(w, matmul(lambda*mass + damping, u))) <= &
              rounding*dot_product(abs(w), matmul(abs(stiffness), abs(u)))
    end function is_rounding

    pure subroutine refine(lambda, noise, u, mass, damping, stiffness, better, moved)
        !! The root near `lambda` of the quadratic that its vector makes. A sum that is no more than
        !! its rounding is 0. Where \(2m\omega + g\) is the smaller part of the derivative
        !! \(2m\lambda + c + ig\), as it is 0 of what a turning force makes of a growth,
        !! that quotient is worse than `lambda`.
        complex(dp), intent(in) :: lambda, u(:)
        real(dp), intent(in) :: noise  !! how far `lambda` may be off
        real(dp), intent(in) :: mass(:, :), damping(:, :), stiffness(:, :)
        complex(dp), intent(out) :: better
        real(dp), intent(out) :: moved  !! how far rounding may have moved its real part
        real(dp) :: c, g, m, k, k_i, omega, roots(2), of_c(2), of_k(2), of_m(2)
        complex(dp) :: root

        omega = aimag(lambda)
        better = lambda
        moved = 0.0_dp
        call form_of(mass, u, m, k_i, of_m)
        call form_of(damping, u, c, g, of_c)
        call form_of(stiffness, u, k, k_i, of_k)
        if (is_nonzero(omega)) then
            if (abs(2.0_dp*m*omega + g) < abs(2.0_dp*m*real(lambda) + c)) return
            moved = (of_c(1)*abs(omega) + of_k(2))/abs(2.0_dp*m*omega + g)
            if (moved > 1e-13_dp*abs(omega)) then  ! more than of the vector, which counts squared
                root = sqrt(cmplx(c, g, dp)**2 - 4.0_dp*m*cmplx(k, k_i, dp))
                if (aimag(root)*omega < 0.0_dp) root = -root
                omega = aimag(root - cmplx(c, g, dp))/(2.0_dp*m)
            end if
            better = cmplx(-(c*omega + k_i)/(2.0_dp*m*omega + g), omega, dp)
        else
            roots(1) = c**2 - 4.0_dp*m*k
            if (roots(1) < 0.0_dp) return
            roots = -0.5_dp*(c + sign(sqrt(roots(1)), c))
            roots(1) = roots(1)/m
            if (is_nonzero(roots(2))) roots(2) = k/roots(2)
            better = roots(minloc(abs(roots - real(lambda)), 1))
        end if
        if (.not. abs(better - lambda) <= noise) better = lambda
    end subroutine refine

    pure subroutine form_of(a, u, re, im, rounding)
        !! \(u^\dagger Au\): the real part is the symmetric part's, the imaginary one the rest's.
        real(dp), intent(in) :: a(:, :)
        complex(dp), intent(in) :: u(:)
        real(dp), intent(out) :: re, im
        real(dp), intent(out) :: rounding(2)  !! of both
        real(dp) :: parts(3, size(u), size(u))
        integer :: i, j

        do j = 1, size(u)
            do i = 1, size(u)
                parts(1, i, j) = 0.5_dp*(a(i, j) + a(j, i))*real(conjg(u(i))*u(j))
                parts(2, i, j) = 0.5_dp*(a(i, j) - a(j, i))*aimag(conjg(u(i))*u(j))
                parts(3, i, j) = 0.5_dp*abs(a(i, j) - a(j, i))*abs(u(i))*abs(u(j))
            end do
        end do
        rounding = 4*size(u)*epsilon(re)*[sum(abs(parts(1, :, :))), sum(parts(3, :, :))]
        re = sum(parts(1, :, :))
        im = sum(parts(2, :, :))
        if (abs(re) <= rounding(1)) re = 0.0_dp
        if (abs(im) <= rounding(2)) im = 0.0_dp
    end subroutine form_of
end module lagrangia_quadratic_eigen
