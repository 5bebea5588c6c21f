module lagrangia_gauss_kernels
    !! The arithmetic of Gauss-Legendre collocation on eight lanes: products with the tables, and
    !! sums. See `lagrangia_gauss_stages`.
    !!
    !! Here a loop over the lanes says what an array statement would say better: the directive
    !! keeps gfortran 12 from unrolling it before it vectorises, which costs a factor of 3.
    use lagrangia_gauss_tables, only: butcher, mu, nodes, nystrom, stages
    use lagrangia_kinds, only: dp
    use lagrangia_summation, only: add
    use lagrangia_system, only: lanes
    implicit none (type, external)
    private
    public :: apply, distance, end_state, exact_states, free_states, magnitude, &
              quick_states

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

        x = 0.0_dp
        do d = 1, n
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

        x = 0.0_dp
        do d = 1, n
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
        real(dp), intent(inout) :: q(n), q_low(n)  !! coordinates: their sum
        real(dp), intent(inout) :: v(n), v_low(n)  !! velocities: their sum
        real(dp) :: v_stage(lanes)
        integer :: d

        do d = 1, n
            call integrate(v(d), v_low(d), hb, f(:, d), v_stage)
            call add(v(d), v_low(d), total(hb*f(:, d)))
            call add(q(d), q_low(d), total(hb*v_stage))
        end do
    end subroutine end_state

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

    pure function total(x) result(s)
        !! Sum over the lanes.
        real(dp), intent(in) :: x(lanes)
        real(dp) :: s, half(4)

        half = x(1:4) + x(5:8)
        s = (half(1) + half(3)) + (half(2) + half(4))
    end function total
end module lagrangia_gauss_kernels
