module lagrangia_dop853_stages
    !! The stages of one step of `dop853`. Its tables are full of zeros: the sums below have no
    !! others than their non-zero terms.
    !!
    !! Slope 1 is that at the step's start, the others are kept as their differences from it:
    !! `k(:, 2:16)`. Weights that reach 500 then only multiply what is small, and the sums of
    !! their rows need not be exact. `k(:, 17)` is the slope at the step's end.
    !!
    !! The sums are loops that are not vectorised: over a few components that costs a third of the
    !! time more than it saves.
    !!
    !! Source: Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, 2nd ed.,
    !! secs. II.5, II.6 and II.10.
    use lagrangia_dop853_coefficients, only: a, b, c, d, e3, e5
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: slope, stages, extra_stages, inside_step, scaled_error

    real(dp), parameter :: by_stage(4, 16) = transpose(d)

contains

    pure subroutine slope(system, n, t, y, f)
        !! The slope of a state.
        class(system_t), intent(in) :: system  !! gives the accelerations
        integer, intent(in) :: n               !! degrees of freedom
        real(dp), intent(in) :: t              !! s
        real(dp), intent(in) :: y(2*n)         !! `(q, v)`
        real(dp), intent(out) :: f(2*n)        !! its time derivative

        f(:n) = y(n + 1:)
        call system%accelerations(t, y(:n), y(n + 1:), f(n + 1:))
    end subroutine slope

    pure subroutine change(system, n, t, y, f1, f)
        !! The slope of the state `y` less the slope `f1`.
        class(system_t), intent(in) :: system
        integer, intent(in) :: n
        real(dp), intent(in) :: t, y(2*n), f1(2*n)
        real(dp), intent(out) :: f(2*n)

        call system%accelerations(t, y(:n), y(n + 1:), f(n + 1:))
        f(:n) = y(n + 1:) - f1(:n)
        f(n + 1:) = f(n + 1:) - f1(n + 1:)
    end subroutine change

    pure subroutine stages(system, n, t, h, y0, k, y)
        !! Slopes 2 to 12 of a step, and its end.
        class(system_t), intent(in) :: system  !! gives the accelerations
        integer, intent(in) :: n               !! degrees of freedom
        real(dp), intent(in) :: t, h           !! start and length of the step, s
        real(dp), intent(in) :: y0(2*n)        !! state at its start
        real(dp), intent(inout) :: k(2*n, 17)  !! slopes; the first is known
        real(dp), intent(out) :: y(2*n)        !! state at its end
        integer :: i

        !GCC$ novector
        do i = 1, 2*n
            y(i) = y0(i) + h*(c(2)*k(i, 1))
        end do
        call change(system, n, t + c(2)*h, y, k(:, 1), k(:, 2))
        !GCC$ novector
        do i = 1, 2*n
            y(i) = y0(i) + h*(c(3)*k(i, 1) + a(2, 3)*k(i, 2))
        end do
        call change(system, n, t + c(3)*h, y, k(:, 1), k(:, 3))
        !GCC$ novector
        do i = 1, 2*n
            y(i) = y0(i) + h*(c(4)*k(i, 1) + a(3, 4)*k(i, 3))
        end do
        call change(system, n, t + c(4)*h, y, k(:, 1), k(:, 4))
        !GCC$ novector
        do i = 1, 2*n
            y(i) = y0(i) + h*(c(5)*k(i, 1) + a(3, 5)*k(i, 3) + a(4, 5)*k(i, 4))
        end do
        call change(system, n, t + c(5)*h, y, k(:, 1), k(:, 5))
        !GCC$ novector
        do i = 1, 2*n
            y(i) = y0(i) + h*(c(6)*k(i, 1) + a(4, 6)*k(i, 4) + a(5, 6)*k(i, 5))
        end do
        call change(system, n, t + c(6)*h, y, k(:, 1), k(:, 6))
        !GCC$ novector
        do i = 1, 2*n
            y(i) = y0(i) + h*(c(7)*k(i, 1) + a(4, 7)*k(i, 4) + a(5, 7)*k(i, 5) + a(6, 7)*k(i, 6))
        end do
        call change(system, n, t + c(7)*h, y, k(:, 1), k(:, 7))
        !GCC$ novector
        do i = 1, 2*n
            y(i) = y0(i) + h*(c(8)*k(i, 1) + a(4, 8)*k(i, 4) + a(5, 8)*k(i, 5) + a(6, 8)*k(i, 6) &
                        + a(7, 8)*k(i, 7))
        end do
        call change(system, n, t + c(8)*h, y, k(:, 1), k(:, 8))
        !GCC$ novector
        do i = 1, 2*n
            y(i) = y0(i) + h*(c(9)*k(i, 1) + a(4, 9)*k(i, 4) + a(5, 9)*k(i, 5) + a(6, 9)*k(i, 6) &
                        + a(7, 9)*k(i, 7) + a(8, 9)*k(i, 8))
        end do
        call change(system, n, t + c(9)*h, y, k(:, 1), k(:, 9))
        !GCC$ novector
        do i = 1, 2*n
            y(i) = y0(i) + h*(c(10)*k(i, 1) + a(4, 10)*k(i, 4) + a(5, 10)*k(i, 5) &
                             + a(6, 10)*k(i, 6) &
                        + a(7, 10)*k(i, 7) + a(8, 10)*k(i, 8) + a(9, 10)*k(i, 9))
        end do
        call change(system, n, t + c(10)*h, y, k(:, 1), k(:, 10))
        !GCC$ novector
        do i = 1, 2*n
            y(i) = y0(i) + h*(c(11)*k(i, 1) + a(4, 11)*k(i, 4) + a(5, 11)*k(i, 5) &
                             + a(6, 11)*k(i, 6) &
                        + a(7, 11)*k(i, 7) + a(8, 11)*k(i, 8) + a(9, 11)*k(i, 9) &
                        + a(10, 11)*k(i, 10))
        end do
        call change(system, n, t + c(11)*h, y, k(:, 1), k(:, 11))
        !GCC$ novector
        do i = 1, 2*n
            y(i) = y0(i) + h*(c(12)*k(i, 1) + a(4, 12)*k(i, 4) + a(5, 12)*k(i, 5) &
                             + a(6, 12)*k(i, 6) &
                        + a(7, 12)*k(i, 7) + a(8, 12)*k(i, 8) + a(9, 12)*k(i, 9) &
                        + a(10, 12)*k(i, 10) + a(11, 12)*k(i, 11))
        end do
        call change(system, n, t + c(12)*h, y, k(:, 1), k(:, 12))
        !GCC$ novector
        do i = 1, 2*n
            y(i) = y0(i) + h*(k(i, 1) + b(6)*k(i, 6) + b(7)*k(i, 7) + b(8)*k(i, 8) + b(9)*k(i, 9) &
                        + b(10)*k(i, 10) + b(11)*k(i, 11) + b(12)*k(i, 12))
        end do
    end subroutine stages

    pure subroutine extra_stages(system, n, t, h, y0, y1, k, dense, y)
        !! Slopes 13 to 17; rows of `dense`: difference over the step, three corrections up to
        !! the cubic Hermite polynomial, and four beyond.
        class(system_t), intent(in) :: system  !! gives the accelerations
        integer, intent(in) :: n               !! degrees of freedom
        real(dp), intent(in) :: t, h            !! start and length of the step, s
        real(dp), intent(in) :: y0(2*n), y1(2*n)  !! states at its ends
        real(dp), intent(inout) :: k(2*n, 17)   !! slopes; 1 to 12 are known
        real(dp), intent(out) :: dense(7, 2*n)  !! coefficients for `state_at`
        real(dp), intent(out) :: y(2*n)         !! room for a stage's state
        real(dp) :: high(4)
        integer :: i, j

        call slope(system, n, t + h, y1, k(:, 17))
        k(:, 13) = k(:, 17) - k(:, 1)
        !GCC$ novector
        do i = 1, 2*n
            y(i) = y0(i) + h*(c(14)*k(i, 1) + a(7, 14)*k(i, 7) + a(8, 14)*k(i, 8) &
                             + a(9, 14)*k(i, 9) &
                        + a(10, 14)*k(i, 10) + a(11, 14)*k(i, 11) + a(12, 14)*k(i, 12) &
                        + a(13, 14)*k(i, 13))
        end do
        call change(system, n, t + c(14)*h, y, k(:, 1), k(:, 14))
        !GCC$ novector
        do i = 1, 2*n
            y(i) = y0(i) + h*(c(15)*k(i, 1) + a(6, 15)*k(i, 6) + a(7, 15)*k(i, 7) &
                             + a(8, 15)*k(i, 8) &
                        + a(11, 15)*k(i, 11) + a(12, 15)*k(i, 12) + a(13, 15)*k(i, 13) &
                        + a(14, 15)*k(i, 14))
        end do
        call change(system, n, t + c(15)*h, y, k(:, 1), k(:, 15))
        !GCC$ novector
        do i = 1, 2*n
            y(i) = y0(i) + h*(c(16)*k(i, 1) + a(6, 16)*k(i, 6) + a(7, 16)*k(i, 7) &
                             + a(8, 16)*k(i, 8) &
                        + a(9, 16)*k(i, 9) + a(13, 16)*k(i, 13) + a(14, 16)*k(i, 14) &
                        + a(15, 16)*k(i, 15))
        end do
        call change(system, n, t + c(16)*h, y, k(:, 1), k(:, 16))
        dense(1, :) = y1 - y0
        dense(2, :) = h*k(:, 1) - dense(1, :)
        dense(3, :) = dense(1, :) - h*k(:, 17) - dense(2, :)
        do i = 1, 2*n
            high = 0.0_dp
            do j = 6, 16
                high = high + by_stage(:, j)*k(i, j)
            end do
            dense(4:7, i) = h*high
        end do
    end subroutine extra_stages

    pure subroutine inside_step(s, y0, dense, y)
        !! The state at a share `s` of a step.
        real(dp), intent(in) :: s            !! from 0 to 1
        real(dp), intent(in) :: y0(:)        !! state at its start, `(2*n)`
        real(dp), intent(in) :: dense(:, :)  !! coefficients of `extra_stages`, `(7, 2*n)`
        real(dp), intent(out) :: y(:)        !! `(2*n)`
        real(dp) :: r
        integer :: i

        r = 1.0_dp - s
        do i = 1, size(y)
            associate (f => dense(:, i))
                y(i) = y0(i) + s*(f(1) + r*(f(2) + s*(f(3) + r*(f(4) + s*(f(5) &
                                                                    + r*(f(6) + s*f(7)))))))
            end associate
        end do
    end subroutine inside_step

    pure function scaled_error(h, tolerance, k, y0, y) result(scaled)
        !! The estimated error of a step in units of the tolerance, \(O(h^8)\): the error of an
        !! embedded solution of order 5, squared, over mostly that of one of order 3. A root mean
        !! square over the components, absolute below 1 and relative above; huge if it is NaN.
        real(dp), intent(in) :: h            !! step, s
        real(dp), intent(in) :: tolerance    !! absolute below 1, relative above
        real(dp), intent(in) :: k(:, :)      !! slopes, `(2*n, 17)`
        real(dp), intent(in) :: y0(:), y(:)  !! states at the ends of the step, `(2*n)`
        real(dp) :: scaled, fifth, third, weight, k5, k3
        integer :: i

        fifth = 0.0_dp
        third = 0.0_dp
        do i = 1, size(y)
            k5 = e5(6)*k(i, 6) + e5(7)*k(i, 7) + e5(8)*k(i, 8) &
                 + e5(9)*k(i, 9) + e5(10)*k(i, 10) + e5(11)*k(i, 11) + e5(12)*k(i, 12)
            k3 = e3(6)*k(i, 6) + e3(7)*k(i, 7) + e3(8)*k(i, 8) &
                 + e3(9)*k(i, 9) + e3(10)*k(i, 10) + e3(11)*k(i, 11) + e3(12)*k(i, 12)
            weight = max(1.0_dp, abs(y0(i)), abs(y(i)))
            fifth = fifth + (k5/weight)**2
            third = third + (k3/weight)**2
        end do
        scaled = 0.0_dp
        if (third > 0.0_dp) scaled = h/tolerance*fifth/sqrt(size(y)*(fifth + 0.01_dp*third))
        if (.not. third + sum(abs(y)) <= huge(scaled)) scaled = huge(scaled)
    end function scaled_error
end module lagrangia_dop853_stages
