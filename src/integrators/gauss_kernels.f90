module lagrangia_gauss_kernels
    !! The arithmetic of Gauss-Legendre collocation on eight lanes: products with the tables, and
    !! sums. See `lagrangia_gauss_stages`.
    !!
    !! Here a loop over the lanes says what an array statement would say better: the directive
    !! keeps gfortran 12 from unrolling it before it vectorises, which costs a factor of 3.
    use lagrangia_gauss_tables, only: butcher, mu, nodes, nystrom, stages, weights
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: lanes
    implicit none (type, external)
    private
    public :: apply, distance, end_state, exact_states, expand_both, fly, fly_by_guess, &
              free_states, full_end_state, integrals, magnitude, quick_states, weighted_sum

contains

    pure subroutine exact_states(n, hb, q, q_low, v, v_low, f, f_old, q_stage, v_stage)
        !! Coordinates and velocities of the stages; `f` is kept in `f_old`.
        integer, intent(in) :: n                   !! degrees of freedom
        real(dp), intent(in) :: hb(lanes)          !! weights times step, s
        real(dp), intent(in) :: q(n), q_low(n)     !! coordinates at the start: their sum
        real(dp), intent(in) :: v(n), v_low(n)     !! velocities there: their sum
        real(dp), intent(in) :: f(lanes, n)        !! accelerations of the stages
        real(dp), intent(out) :: f_old(lanes, n)   !! the same
        real(dp), intent(out) :: q_stage(lanes, n), v_stage(lanes, n)  !! the stages
        integer :: d

        f_old = f
        do d = 1, n
            call integrate(v(d), v_low(d), hb, f(:, d), v_stage(:, d))
            call integrate(q(d), q_low(d), hb, v_stage(:, d), q_stage(:, d))
        end do
    end subroutine exact_states

    pure subroutine free_states(n, h, q, v, f_old, q_stage, v_stage)
        !! Where the stages are without accelerations.
        integer, intent(in) :: n                   !! degrees of freedom
        real(dp), intent(in) :: h                  !! step, s
        real(dp), intent(in) :: q(n), v(n)         !! state at its start
        real(dp), intent(out) :: f_old(lanes, n)   !! their accelerations: 0
        real(dp), intent(out) :: q_stage(lanes, n), v_stage(lanes, n)  !! the stages
        integer :: d, i

        do d = 1, n
            !GCC$ vector
            do i = 1, lanes
                f_old(i, d) = 0.0_dp
                q_stage(i, d) = q(d) + h*v(d)*nodes(i)
                v_stage(i, d) = v(d)
            end do
        end do
    end subroutine free_states

    pure subroutine quick_states(n, h, moving, f, f_old, q_stage, v_stage)
        !! What the change of `f` since `f_old` adds to them, by \(a\) and \(a^2\); to the
        !! velocities only if they matter (`moving`).
        integer, intent(in) :: n                   !! degrees of freedom
        real(dp), intent(in) :: h                  !! step, s
        logical, intent(in) :: moving              !! forces depend on velocities
        real(dp), intent(in) :: f(lanes, n)        !! accelerations of the stages
        real(dp), intent(inout) :: f_old(lanes, n) !! those that made the stages; then `f`
        real(dp), intent(inout) :: q_stage(lanes, n), v_stage(lanes, n)  !! the stages
        real(dp) :: x(lanes)
        integer :: d, i

        do d = 1, n
            !GCC$ vector
            do i = 1, lanes
                x(i) = f(i, d) - f_old(i, d)
                f_old(i, d) = f(i, d)
            end do
            !GCC$ vector
            do i = 1, lanes
                q_stage(i, d) = q_stage(i, d) &
                    + h**2*(((nystrom(i, 1)*x(1) + nystrom(i, 2)*x(2)) &
                             + (nystrom(i, 3)*x(3) + nystrom(i, 4)*x(4))) &
                            + ((nystrom(i, 5)*x(5) + nystrom(i, 6)*x(6)) &
                               + (nystrom(i, 7)*x(7) + nystrom(i, 8)*x(8))))
            end do
            if (.not. moving) cycle
            !GCC$ vector
            do i = 1, lanes
                v_stage(i, d) = v_stage(i, d) &
                    + h*(((butcher(i, 1)*x(1) + butcher(i, 2)*x(2)) &
                          + (butcher(i, 3)*x(3) + butcher(i, 4)*x(4))) &
                         + ((butcher(i, 5)*x(5) + butcher(i, 6)*x(6)) &
                            + (butcher(i, 7)*x(7) + butcher(i, 8)*x(8))))
            end do
        end do
    end subroutine quick_states

    pure subroutine integrate(start, low, hb, slope, y)
        !! \(y_i = y_0 + \sum_j\mu_{ij}\,h b_j\,y'_j\), where \(y_0\) is a sum of two numbers.
        real(dp), intent(in) :: start, low, hb(lanes), slope(lanes)
        real(dp), intent(out) :: y(lanes)
        real(dp) :: x(lanes)
        integer :: i

        !GCC$ vector
        do i = 1, lanes
            x(i) = hb(i)*slope(i)
        end do
        !GCC$ vector
        do i = 1, lanes
            y(i) = start + (low + (((mu(i, 1)*x(1) + mu(i, 2)*x(2)) &
                                    + (mu(i, 3)*x(3) + mu(i, 4)*x(4))) &
                                   + ((mu(i, 5)*x(5) + mu(i, 6)*x(6)) &
                                      + (mu(i, 7)*x(7) + mu(i, 8)*x(8)))))
        end do
    end subroutine integrate

    pure function distance(n, weight, f, f_old) result(change)
        !! Weighted mean square of what the last sweep changed.
        integer, intent(in) :: n                   !! degrees of freedom
        real(dp), intent(in) :: weight(n)          !! of the squares
        real(dp), intent(in) :: f(lanes, n)        !! accelerations of the stages
        real(dp), intent(in) :: f_old(lanes, n)    !! those before the sweep
        real(dp) :: change, x(lanes)
        integer :: d, i

        !GCC$ vector
        do i = 1, lanes
            x(i) = weight(1)*(f(i, 1) - f_old(i, 1))**2
        end do
        do d = 2, n
            !GCC$ vector
            do i = 1, lanes
                x(i) = x(i) + weight(d)*(f(i, d) - f_old(i, d))**2
            end do
        end do
        change = total(x)/stages
    end function distance

    pure function magnitude(n, weight, f) result(all)
        !! Weighted mean square of the accelerations.
        integer, intent(in) :: n                   !! degrees of freedom
        real(dp), intent(in) :: weight(n)          !! of the squares
        real(dp), intent(in) :: f(lanes, n)        !! accelerations of the stages
        real(dp) :: all, x(lanes)
        integer :: d, i

        !GCC$ vector
        do i = 1, lanes
            x(i) = weight(1)*f(i, 1)**2
        end do
        do d = 2, n
            !GCC$ vector
            do i = 1, lanes
                x(i) = x(i) + weight(d)*f(i, d)**2
            end do
        end do
        all = total(x)/stages
    end function magnitude

    pure subroutine end_state(n, hb, f, q, q_low, v, v_low)
        !! The state at the end of the step; what rounding takes from it goes into the low parts.
        integer, intent(in) :: n                   !! degrees of freedom
        real(dp), intent(in) :: hb(lanes)          !! weights times step, s
        real(dp), intent(in) :: f(lanes, n)        !! accelerations of the stages
        real(dp), intent(inout) :: q(n), q_low(n)  !! coordinates: their sum; first at the start
        real(dp), intent(inout) :: v(n), v_low(n)  !! velocities: their sum
        real(dp) :: v_stage(lanes)
        integer :: d

        do d = 1, n
            call integrate(v(d), v_low(d), hb, f(:, d), v_stage)
            call increase(v(d), v_low(d), total(hb*f(:, d)))
            call increase(q(d), q_low(d), total(hb*v_stage))
        end do
    end subroutine end_state

    pure subroutine full_end_state(n, hb, f, q, q_low, v, v_low)
        !! The same with twice the digits in the sums of the increments, too, where rounding takes a
        !! part in \(10^{16}\) of them, which fixed steps add up a million times.
        integer, intent(in) :: n                   !! degrees of freedom
        real(dp), intent(in) :: hb(lanes)          !! weights times step, s
        real(dp), intent(in) :: f(lanes, n)        !! accelerations of the stages
        real(dp), intent(inout) :: q(n), q_low(n)  !! coordinates: their sum; first at the start
        real(dp), intent(inout) :: v(n), v_low(n)  !! velocities: their sum
        real(dp) :: v_stage(lanes)
        integer :: d

        do d = 1, n
            call integrate(v(d), v_low(d), hb, f(:, d), v_stage)
            call add_products(hb, f(:, d), v(d), v_low(d))
            call add_products(hb, v_stage, q(d), q_low(d))
        end do
    end subroutine full_end_state

    pure subroutine add_products(a, b, x, low)
        !! Add \(\sum_i a_i b_i\) to `x + low` as if it were computed with twice the digits: the
        !! products and sums are those of two numbers each. Where these overflow the sum is plain.
        !!
        !! Source: T. Ogita, S. M. Rump and S. Oishi, "Accurate sum and dot product", SIAM J. Sci.
        !! Comput. 26 (2005) 1955, algorithms 3.1, 3.3 and 5.3, here in pairs.
        real(dp), intent(in) :: a(lanes), b(lanes)
        real(dp), intent(inout) :: x, low
        real(dp), parameter :: cut = 2.0_dp**27 + 1.0_dp
        real(dp) :: p(lanes), e(lanes), a_high, a_low, b_high, b_low, taken, rest
        integer :: i, half

        !GCC$ vector
        do i = 1, lanes
            p(i) = a(i)*b(i)
            a_high = cut*a(i) - (cut*a(i) - a(i))
            a_low = a(i) - a_high
            b_high = cut*b(i) - (cut*b(i) - b(i))
            b_low = b(i) - b_high
            e(i) = a_low*b_low - (((p(i) - a_high*b_high) - a_low*b_high) - a_high*b_low)
        end do
        rest = total(e)
        half = lanes/2
        do while (half > 0)
            do i = 1, half
                a_high = p(i) + p(i + half)
                taken = a_high - p(i)
                rest = rest + ((p(i) - (a_high - taken)) + (p(i + half) - taken))
                p(i) = a_high
            end do
            half = half/2
        end do
        if (.not. abs(rest) <= huge(rest)) rest = 0.0_dp
        a_high = x + p(1)
        taken = a_high - x
        low = low + (rest + ((x - (a_high - taken)) + (p(1) - taken)))
        x = a_high + low
        low = low - (x - a_high)
    end subroutine add_products

    pure subroutine increase(x, low, term)
        !! `add` of `lagrangia_summation`, where the compiler sees it: a call costs more.
        real(dp), intent(inout) :: x, low
        real(dp), intent(in) :: term
        real(dp) :: increment, total, taken

        increment = low + term
        total = x + increment
        taken = total - x
        low = (x - (total - taken)) + (increment - taken)
        x = total
    end subroutine increase

    pure subroutine apply(n, m, x, y)
        !! Multiply the matrix `m` by every column of `x`.
        integer, intent(in) :: n                   !! degrees of freedom
        real(dp), intent(in) :: m(lanes, lanes)    !! a table
        real(dp), intent(in) :: x(lanes, n)        !! of the stages
        real(dp), intent(out) :: y(lanes, n)       !! `matmul(m, x)`
        integer :: d, i

        do d = 1, n
            !GCC$ vector
            do i = 1, lanes
                y(i, d) = ((m(i, 1)*x(1, d) + m(i, 2)*x(2, d)) &
                           + (m(i, 3)*x(3, d) + m(i, 4)*x(4, d))) &
                          + ((m(i, 5)*x(5, d) + m(i, 6)*x(6, d)) &
                             + (m(i, 7)*x(7, d) + m(i, 8)*x(8, d)))
            end do
        end do
    end subroutine apply

    pure subroutine fly(n, h, x, q, v, m_q, m_v, a, q_lane, v_lane)
        !! States in a step by the series of its accelerations, of which the matrices make \(v\) and
        !! \(q\) for a step of 1 that begins at rest.
        integer, intent(in) :: n                   !! degrees of freedom
        real(dp), intent(in) :: h                  !! step, s
        real(dp), intent(in) :: x(lanes)           !! where in it
        real(dp), intent(in) :: q(n), v(n)         !! state at its start
        real(dp), intent(in) :: m_q(lanes, 2*lanes), m_v(lanes, 2*lanes)  !! tables
        real(dp), intent(in) :: a(2*lanes, n)      !! coefficients
        real(dp), intent(out) :: q_lane(lanes, n), v_lane(lanes, n)  !! coordinates, velocities
        real(dp) :: change
        integer :: d, i

        do d = 1, n
            !GCC$ vector
            do i = 1, lanes
                change = (((m_q(i, 1)*a(1, d) + m_q(i, 2)*a(2, d)) &
                           + (m_q(i, 3)*a(3, d) + m_q(i, 4)*a(4, d))) &
                          + ((m_q(i, 5)*a(5, d) + m_q(i, 6)*a(6, d)) &
                             + (m_q(i, 7)*a(7, d) + m_q(i, 8)*a(8, d)))) &
                         + (((m_q(i, 9)*a(9, d) + m_q(i, 10)*a(10, d)) &
                             + (m_q(i, 11)*a(11, d) + m_q(i, 12)*a(12, d))) &
                            + ((m_q(i, 13)*a(13, d) + m_q(i, 14)*a(14, d)) &
                               + (m_q(i, 15)*a(15, d) + m_q(i, 16)*a(16, d))))
                q_lane(i, d) = q(d) + h*(x(i)*v(d) + h*change)
            end do
            !GCC$ vector
            do i = 1, lanes
                change = (((m_v(i, 1)*a(1, d) + m_v(i, 2)*a(2, d)) &
                           + (m_v(i, 3)*a(3, d) + m_v(i, 4)*a(4, d))) &
                          + ((m_v(i, 5)*a(5, d) + m_v(i, 6)*a(6, d)) &
                             + (m_v(i, 7)*a(7, d) + m_v(i, 8)*a(8, d)))) &
                         + (((m_v(i, 9)*a(9, d) + m_v(i, 10)*a(10, d)) &
                             + (m_v(i, 11)*a(11, d) + m_v(i, 12)*a(12, d))) &
                            + ((m_v(i, 13)*a(13, d) + m_v(i, 14)*a(14, d)) &
                               + (m_v(i, 15)*a(15, d) + m_v(i, 16)*a(16, d))))
                v_lane(i, d) = v(d) + h*change
            end do
        end do
    end subroutine fly

    pure subroutine fly_by_guess(n, h, x, q, v, m_q, m_v, c, q_lane, v_lane)
        !! The same by the ten terms of a first guess.
        integer, intent(in) :: n                   !! degrees of freedom
        real(dp), intent(in) :: h                  !! step, s
        real(dp), intent(in) :: x(lanes)           !! where in it
        real(dp), intent(in) :: q(n), v(n)         !! state at its start
        real(dp), intent(in) :: m_q(lanes, lanes + 2), m_v(lanes, lanes + 2)  !! tables
        real(dp), intent(in) :: c(lanes + 2, n)    !! coefficients
        real(dp), intent(out) :: q_lane(lanes, n), v_lane(lanes, n)  !! coordinates, velocities
        real(dp) :: change
        integer :: d, i

        do d = 1, n
            !GCC$ vector
            do i = 1, lanes
                change = (((m_q(i, 1)*c(1, d) + m_q(i, 2)*c(2, d)) &
                           + (m_q(i, 3)*c(3, d) + m_q(i, 4)*c(4, d))) &
                          + ((m_q(i, 5)*c(5, d) + m_q(i, 6)*c(6, d)) &
                             + (m_q(i, 7)*c(7, d) + m_q(i, 8)*c(8, d)))) &
                         + (m_q(i, 9)*c(9, d) + m_q(i, 10)*c(10, d))
                q_lane(i, d) = q(d) + h*(x(i)*v(d) + h*change)
            end do
            !GCC$ vector
            do i = 1, lanes
                change = (((m_v(i, 1)*c(1, d) + m_v(i, 2)*c(2, d)) &
                           + (m_v(i, 3)*c(3, d) + m_v(i, 4)*c(4, d))) &
                          + ((m_v(i, 5)*c(5, d) + m_v(i, 6)*c(6, d)) &
                             + (m_v(i, 7)*c(7, d) + m_v(i, 8)*c(8, d)))) &
                         + (m_v(i, 9)*c(9, d) + m_v(i, 10)*c(10, d))
                v_lane(i, d) = v(d) + h*change
            end do
        end do
    end subroutine fly_by_guess

    pure subroutine expand_both(n, m, f1, f2, a)
        !! The series of what is known at two times eight points.
        integer, intent(in) :: n                          !! degrees of freedom
        real(dp), intent(in) :: m(lanes, 2*lanes, 2)      !! a table
        real(dp), intent(in) :: f1(lanes, n), f2(lanes, n)  !! at the points
        real(dp), intent(out) :: a(lanes, 2, n)           !! coefficients
        integer :: d, g, i

        do d = 1, n
            do g = 1, 2
                !GCC$ vector
                do i = 1, lanes
                    a(i, g, d) = (((m(i, 1, g)*f1(1, d) + m(i, 2, g)*f1(2, d)) &
                                   + (m(i, 3, g)*f1(3, d) + m(i, 4, g)*f1(4, d))) &
                                  + ((m(i, 5, g)*f1(5, d) + m(i, 6, g)*f1(6, d)) &
                                     + (m(i, 7, g)*f1(7, d) + m(i, 8, g)*f1(8, d)))) &
                                 + (((m(i, 9, g)*f2(1, d) + m(i, 10, g)*f2(2, d)) &
                                     + (m(i, 11, g)*f2(3, d) + m(i, 12, g)*f2(4, d))) &
                                    + ((m(i, 13, g)*f2(5, d) + m(i, 14, g)*f2(6, d)) &
                                       + (m(i, 15, g)*f2(7, d) + m(i, 16, g)*f2(8, d))))
                end do
            end do
        end do
    end subroutine expand_both

    pure function weighted_sum(w, a) result(s)
        !! \(\sum_k w_k a_k\) of a series.
        real(dp), intent(in) :: w(2*lanes), a(2*lanes)  !! weights, coefficients
        real(dp) :: s, x(lanes)
        integer :: i

        !GCC$ vector
        do i = 1, lanes
            x(i) = w(i)*a(i) + w(i + lanes)*a(i + lanes)
        end do
        s = total(x)
    end function weighted_sum

    pure subroutine integrals(c, x, once, twice)
        !! \(\sum_j b_j a_j\) and \(\sum_j b_j(1-c_j)a_j\) of a Chebyshev series
        !! \(a_j = \sum_k c_k T_k(x_j)\), summed by Clenshaw in all lanes: even and odd terms
        !! beside each other, as \(T_{2k}(x) = T_k(y)\) with \(y = 2x^2 - 1\), and
        !! \(T_{2k+1}(x)/x\) has the same recurrence in \(y\).
        real(dp), intent(in) :: c(0:2*lanes - 1)   !! coefficients
        real(dp), intent(in) :: x(lanes)           !! places, -1 to 1
        real(dp), intent(out) :: once, twice       !! integrals over the part that the places span
        real(dp), parameter :: inner(lanes) = weights*(1.0_dp - nodes)
        real(dp) :: y, even, even_1, even_2, odd, odd_1, odd_2, a, first(lanes), second(lanes)
        integer :: i, k

        !GCC$ vector
        do i = 1, lanes
            y = 2.0_dp*x(i)*x(i) - 1.0_dp
            even_1 = c(14)
            even_2 = 0.0_dp
            odd_1 = c(15)
            odd_2 = 0.0_dp
            do k = 12, 2, -2
                even = 2.0_dp*y*even_1 + (c(k) - even_2)
                even_2 = even_1
                even_1 = even
                odd = 2.0_dp*y*odd_1 + (c(k + 1) - odd_2)
                odd_2 = odd_1
                odd_1 = odd
            end do
            a = (y*even_1 + (c(0) - even_2)) + x(i)*((2.0_dp*y - 1.0_dp)*odd_1 + (c(1) - odd_2))
            first(i) = weights(i)*a
            second(i) = inner(i)*a
        end do
        once = total(first)
        twice = total(second)
    end subroutine integrals

    pure function total(x) result(s)
        !! Sum over the lanes.
        real(dp), intent(in) :: x(lanes)
        real(dp) :: s, half(4)

        half = x(1:4) + x(5:8)
        s = (half(1) + half(3)) + (half(2) + half(4))
    end function total
end module lagrangia_gauss_kernels
