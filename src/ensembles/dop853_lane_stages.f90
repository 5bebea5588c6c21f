module lagrangia_dop853_lane_stages
    !! The stages of one step of `dop853` in lanes: the sums of `lagrangia_dop853_stages` in the
    !! same order, as one expression each, so that a sum stays in registers until it is complete.
    use lagrangia_dop853_coefficients, only: a, b, c, e3, e5
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: scaled_errors, slopes, stages

contains

    pure subroutine slopes(system, n, t, y, f)
        !! The slopes of eight states.
        class(system_t), intent(in) :: system      !! gives the accelerations
        integer, intent(in) :: n                   !! degrees of freedom
        real(dp), intent(in) :: t(lanes)           !! s
        real(dp), intent(in) :: y(lanes, n, 2)     !! states `(q, v)`
        real(dp), intent(out) :: f(lanes, n, 2)    !! their time derivatives

        f(:, :, 1) = y(:, :, 2)
        call system%accelerations_lanes(t, y(:, :, 1), y(:, :, 2), f(:, :, 2))
    end subroutine slopes

    pure subroutine change(system, n, t, y, f1, f)
        !! The slopes of eight states less `f1`.
        class(system_t), intent(in) :: system
        integer, intent(in) :: n
        real(dp), intent(in) :: t(lanes), y(lanes, n, 2), f1(lanes, n, 2)
        real(dp), intent(out) :: f(lanes, n, 2)
        integer :: i

        call system%accelerations_lanes(t, y(:, :, 1), y(:, :, 2), f(:, :, 2))
        do i = 1, n
            f(:, i, 1) = y(:, i, 2) - f1(:, i, 1)
            f(:, i, 2) = f(:, i, 2) - f1(:, i, 2)
        end do
    end subroutine change

    pure subroutine stages(system, n, t, h, y0, k, y)
        !! Slopes 2 to 12 of the attempts, less the first, and the states at their ends.
        class(system_t), intent(in) :: system           !! gives the accelerations
        integer, intent(in) :: n                        !! degrees of freedom
        real(dp), intent(in) :: t(lanes), h(lanes)      !! starts and lengths of the steps, s
        real(dp), intent(in) :: y0(lanes, 2*n)          !! states at their starts
        real(dp), intent(inout) :: k(lanes, 2*n, 13)    !! slopes; the first is known
        real(dp), intent(out) :: y(lanes, 2*n)          !! states at their ends
        integer :: i

        do i = 1, 2*n
            y(:, i) = y0(:, i) + h*(c(2)*k(:, i, 1))
        end do
        call change(system, n, t + c(2)*h, y, k(:, :, 1), k(:, :, 2))
        do i = 1, 2*n
            y(:, i) = y0(:, i) + h*(c(3)*k(:, i, 1) + a(2, 3)*k(:, i, 2))
        end do
        call change(system, n, t + c(3)*h, y, k(:, :, 1), k(:, :, 3))
        do i = 1, 2*n
            y(:, i) = y0(:, i) + h*(c(4)*k(:, i, 1) + a(3, 4)*k(:, i, 3))
        end do
        call change(system, n, t + c(4)*h, y, k(:, :, 1), k(:, :, 4))
        do i = 1, 2*n
            y(:, i) = y0(:, i) + h*(c(5)*k(:, i, 1) + a(3, 5)*k(:, i, 3) + a(4, 5)*k(:, i, 4))
        end do
        call change(system, n, t + c(5)*h, y, k(:, :, 1), k(:, :, 5))
        do i = 1, 2*n
            y(:, i) = y0(:, i) + h*(c(6)*k(:, i, 1) + a(4, 6)*k(:, i, 4) + a(5, 6)*k(:, i, 5))
        end do
        call change(system, n, t + c(6)*h, y, k(:, :, 1), k(:, :, 6))
        do i = 1, 2*n
            y(:, i) = y0(:, i) + h*(c(7)*k(:, i, 1) + a(4, 7)*k(:, i, 4) + a(5, 7)*k(:, i, 5) &
                                    + a(6, 7)*k(:, i, 6))
        end do
        call change(system, n, t + c(7)*h, y, k(:, :, 1), k(:, :, 7))
        do i = 1, 2*n
            y(:, i) = y0(:, i) + h*(c(8)*k(:, i, 1) + a(4, 8)*k(:, i, 4) + a(5, 8)*k(:, i, 5) &
                                    + a(6, 8)*k(:, i, 6) + a(7, 8)*k(:, i, 7))
        end do
        call change(system, n, t + c(8)*h, y, k(:, :, 1), k(:, :, 8))
        do i = 1, 2*n
            y(:, i) = y0(:, i) + h*(c(9)*k(:, i, 1) + a(4, 9)*k(:, i, 4) + a(5, 9)*k(:, i, 5) &
                                    + a(6, 9)*k(:, i, 6) + a(7, 9)*k(:, i, 7) &
                                    + a(8, 9)*k(:, i, 8))
        end do
        call change(system, n, t + c(9)*h, y, k(:, :, 1), k(:, :, 9))
        do i = 1, 2*n
            y(:, i) = y0(:, i) + h*(c(10)*k(:, i, 1) + a(4, 10)*k(:, i, 4) &
                                    + a(5, 10)*k(:, i, 5) + a(6, 10)*k(:, i, 6) &
                                    + a(7, 10)*k(:, i, 7) + a(8, 10)*k(:, i, 8) &
                                    + a(9, 10)*k(:, i, 9))
        end do
        call change(system, n, t + c(10)*h, y, k(:, :, 1), k(:, :, 10))
        do i = 1, 2*n
            y(:, i) = y0(:, i) + h*(c(11)*k(:, i, 1) + a(4, 11)*k(:, i, 4) &
                                    + a(5, 11)*k(:, i, 5) + a(6, 11)*k(:, i, 6) &
                                    + a(7, 11)*k(:, i, 7) + a(8, 11)*k(:, i, 8) &
                                    + a(9, 11)*k(:, i, 9) + a(10, 11)*k(:, i, 10))
        end do
        call change(system, n, t + c(11)*h, y, k(:, :, 1), k(:, :, 11))
        do i = 1, 2*n
            y(:, i) = y0(:, i) + h*(c(12)*k(:, i, 1) + a(4, 12)*k(:, i, 4) &
                                    + a(5, 12)*k(:, i, 5) + a(6, 12)*k(:, i, 6) &
                                    + a(7, 12)*k(:, i, 7) + a(8, 12)*k(:, i, 8) &
                                    + a(9, 12)*k(:, i, 9) + a(10, 12)*k(:, i, 10) &
                                    + a(11, 12)*k(:, i, 11))
        end do
        call change(system, n, t + c(12)*h, y, k(:, :, 1), k(:, :, 12))
        do i = 1, 2*n
            y(:, i) = y0(:, i) + h*(k(:, i, 1) + b(6)*k(:, i, 6) + b(7)*k(:, i, 7) &
                                    + b(8)*k(:, i, 8) + b(9)*k(:, i, 9) + b(10)*k(:, i, 10) &
                                    + b(11)*k(:, i, 11) + b(12)*k(:, i, 12))
        end do
    end subroutine stages

    pure subroutine scaled_errors(n, h, tolerance, k, y0, y, scaled)
        !! As `scaled_error` of `lagrangia_dop853_stages`, in every lane.
        integer, intent(in) :: n                               !! degrees of freedom
        real(dp), intent(in) :: h(lanes)                       !! lengths of the steps, s
        real(dp), intent(in) :: tolerance                      !! absolute below 1, relative above
        real(dp), intent(in) :: k(lanes, 2*n, 13)              !! slopes
        real(dp), intent(in) :: y0(lanes, 2*n), y(lanes, 2*n)  !! states at the ends of the steps
        real(dp), intent(out) :: scaled(lanes)                 !! in tolerances; huge where NaN
        real(dp), dimension(lanes) :: fifth, k3, k5, third, weight, whole
        integer :: i

        fifth = 0.0_dp
        third = 0.0_dp
        whole = 0.0_dp
        !GCC$ novector
        do i = 1, 2*n  ! the lanes are what is vectorised
            k5 = e5(6)*k(:, i, 6) + e5(7)*k(:, i, 7) + e5(8)*k(:, i, 8) + e5(9)*k(:, i, 9) &
                 + e5(10)*k(:, i, 10) + e5(11)*k(:, i, 11) + e5(12)*k(:, i, 12)
            k3 = e3(6)*k(:, i, 6) + e3(7)*k(:, i, 7) + e3(8)*k(:, i, 8) + e3(9)*k(:, i, 9) &
                 + e3(10)*k(:, i, 10) + e3(11)*k(:, i, 11) + e3(12)*k(:, i, 12)
            weight = max(1.0_dp, abs(y0(:, i)), abs(y(:, i)))
            fifth = fifth + (k5/weight)**2
            third = third + (k3/weight)**2
            whole = whole + abs(y(:, i))
        end do
        scaled = h/tolerance*fifth/sqrt(2*n*(fifth + 0.01_dp*third))
        where (.not. third > 0.0_dp) scaled = 0.0_dp
        where (.not. third + whole <= huge(scaled)) scaled = huge(scaled)
    end subroutine scaled_errors
end module lagrangia_dop853_lane_stages
