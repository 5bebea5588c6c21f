module lagrangia_jacobi
    !! Jacobi's rotations for \(K u = \omega^2 M u\): they keep the small \(\omega^2\) of graded
    !! matrices, of which LAPACK's `dsygv` loses what is below the rounding of the largest.
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_regular_pencil, only: nullity
    implicit none (type, external)
    private
    public :: refine_modes, zero_modes

    integer, parameter :: most_passes = 4, most_sweeps = 20

contains

    pure subroutine refine_modes(stiffness, inertia, omega2, modes)
        !! Turn modes that are nearly those of \(K\) and \(M\) until \(U^\top KU\) and
        !! \(U^\top MU\) are diagonal to the rounding of their own terms. Then \(\omega^2\), their
        !! quotient, has an error of some \(n\epsilon\,|u|^\top|K||u|\): small ones have their
        !! digits, if only \(K\) has them in its elements. The order of modes stays; \(M\) must be
        !! positive definite.
        !!
        !! Source: Falk & Langemeyer, Elektronische Datenverarbeitung 7 (1960) 30; Demmel &
        !! Veselić, SIAM J. Matrix Anal. Appl. 13 (1992) 1204.
        real(dp), intent(in) :: stiffness(:, :)   !! \(K\), symmetric, (n, n)
        real(dp), intent(in) :: inertia(:, :)     !! \(M\), positive definite, (n, n)
        real(dp), intent(inout) :: omega2(:)      !! squared frequencies, (n), s^-2
        real(dp), intent(inout) :: modes(:, :)    !! \(U\), a column each, \(u^\top M u = 1\)
        real(dp), dimension(size(omega2), size(omega2)) :: k, m, k_noise, m_noise
        logical :: turned, any_turned
        integer :: pass, sweep, i

        do pass = 1, most_passes
            call project(stiffness, modes, k, k_noise)
            call project(inertia, modes, m, m_noise)
            any_turned = .false.
            do sweep = 1, most_sweeps
                call turn_all(k, m, size(omega2)*epsilon(k)*k_noise, &
                              size(omega2)*epsilon(m)*m_noise, modes, turned)
                if (.not. turned) exit
                any_turned = .true.
            end do
            do i = 1, size(omega2)
                modes(:, i) = modes(:, i)/sqrt(m(i, i))
                omega2(i) = k(i, i)/m(i, i)
            end do
            if (.not. any_turned) exit
        end do
    end subroutine refine_modes

    pure subroutine project(a, u, product, noise)
        !! \(U^\top A U\), and the sum of the magnitudes of its terms.
        real(dp), intent(in) :: a(:, :), u(:, :)
        real(dp), intent(out) :: product(:, :), noise(:, :)

        product = matmul(transpose(u), matmul(a, u))
        noise = matmul(transpose(abs(u)), matmul(abs(a), abs(u)))
    end subroutine project

    pure subroutine turn_all(k, m, k_rounding, m_rounding, u, turned)
        !! Turn each pair of modes that is not apart yet.
        real(dp), intent(inout) :: k(:, :), m(:, :), u(:, :)
        real(dp), intent(in) :: k_rounding(:, :), m_rounding(:, :)
        logical, intent(out) :: turned
        integer :: p, q

        turned = .false.
        do q = 2, size(k, 2)
            do p = 1, q - 1
                if (abs(k(p, q)) <= k_rounding(p, q) .and. abs(m(p, q)) <= m_rounding(p, q)) cycle
                call turn(k, m, u, p, q)
                turned = .true.
            end do
        end do
    end subroutine turn_all

    pure subroutine turn(k, m, u, p, q)
        !! Make \(k_{pq} = m_{pq} = 0\) by \(u_p - \beta u_q\), \(u_q + \alpha u_p\).
        real(dp), intent(inout) :: k(:, :), m(:, :), u(:, :)
        integer, intent(in) :: p, q
        real(dp) :: big, kp, kq, kpq, of_p, of_q, half, x, alpha, beta

        big = max(abs(k(p, p)), abs(k(q, q)), abs(k(p, q)), tiny(big))
        kp = k(p, p)/big
        kq = k(q, q)/big
        kpq = k(p, q)/big
        of_p = kp*m(p, q) - m(p, p)*kpq
        of_q = kq*m(p, q) - m(q, q)*kpq
        half = 0.5_dp*(kp*m(q, q) - kq*m(p, p))
        x = half + sign(sqrt(max(0.0_dp, half**2 + of_p*of_q)), half)
        alpha = 0.0_dp
        beta = m(p, q)/m(q, q)
        if (is_nonzero(x)) then
            alpha = of_q/x
            beta = of_p/x
        end if
        call combine(alpha, beta, k(:, p), k(:, q))
        call combine(alpha, beta, k(p, :), k(q, :))
        call combine(alpha, beta, m(:, p), m(:, q))
        call combine(alpha, beta, m(p, :), m(q, :))
        call combine(alpha, beta, u(:, p), u(:, q))
    end subroutine turn

    pure subroutine combine(alpha, beta, x, y)
        !! \(x - \beta y\) and \(y + \alpha x\).
        real(dp), intent(in) :: alpha, beta
        real(dp), intent(inout) :: x(:), y(:)
        real(dp) :: old(size(x))

        old = x
        x = x - beta*y
        y = y + alpha*old
    end subroutine combine

    pure function zero_modes(stiffness, modes) result(zero)
        !! Whether \(u^\top Ku\) of each mode is below the rounding of its own terms,
        !! \(4n\epsilon\,|u|^\top|K||u|\). Beside larger ones it may be what rounding leaves of u
        !! where u has nothing: then as many are zero modes as K has null vectors.
        real(dp), intent(in) :: stiffness(:, :)   !! \(K\), (n, n)
        real(dp), intent(in) :: modes(:, :)       !! a column each, (n, n)
        logical :: zero(size(modes, 2))
        real(dp) :: ku(size(modes, 1), size(modes, 2)), all(size(modes, 1), size(modes, 2))
        real(dp) :: form(size(modes, 2)), rounding
        logical :: small(size(modes, 2))
        integer :: j, left

        ku = matmul(stiffness, modes)
        all = matmul(abs(stiffness), abs(modes))
        form = abs(sum(modes*ku, 1))
        rounding = 4*size(modes, 1)*epsilon(rounding)
        zero = form <= rounding*sum(abs(modes)*all, 1)
        small = .not. zero .and. form <= rounding*maxval(form)
        if (.not. any(small)) return
        left = nullity(stiffness) - count(zero)
        do while (left > 0 .and. any(small))
            j = minloc(form, 1, small)
            zero(j) = .true.
            small(j) = .false.
            left = left - 1
        end do
    end function zero_modes
end module lagrangia_jacobi
