module lagrangia_dop853_stages
    !! The stages of one step of `dop853`. Its tables are full of zeros: the sums below have no
    !! others than their non-zero terms.
    !!
    !! Source: Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, 2nd ed.,
    !! secs. II.5, II.6 and II.10.
    use lagrangia_dop853_coefficients, only: a, b, c, d, e3, e5
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: slope, stages, extra_stages, scaled_error

contains

    pure subroutine slope(system, n, t, y, f)
        !! The slope `f` of the state `y = (q, v)`.
        class(system_t), intent(in) :: system
        integer, intent(in) :: n
        real(dp), intent(in) :: t, y(2*n)
        real(dp), intent(out) :: f(2*n)

        f(:n) = y(n + 1:)
        call system%accelerations(t, y(:n), y(n + 1:), f(n + 1:))
    end subroutine slope

    pure subroutine stages(system, n, t, h, y0, k, y)
        !! Slopes 2 to 12 of the step from `y0`, whose slope is the first, and its end `y`.
        class(system_t), intent(in) :: system
        integer, intent(in) :: n
        real(dp), intent(in) :: t, h, y0(2*n)
        real(dp), intent(inout) :: k(2*n, 16)
        real(dp), intent(out) :: y(2*n)

        y = y0 + h*(a(1, 2)*k(:, 1))
        call slope(system, n, t + c(2)*h, y, k(:, 2))
        y = y0 + h*(a(1, 3)*k(:, 1) + a(2, 3)*k(:, 2))
        call slope(system, n, t + c(3)*h, y, k(:, 3))
        y = y0 + h*(a(1, 4)*k(:, 1) + a(3, 4)*k(:, 3))
        call slope(system, n, t + c(4)*h, y, k(:, 4))
        y = y0 + h*(a(1, 5)*k(:, 1) + a(3, 5)*k(:, 3) + a(4, 5)*k(:, 4))
        call slope(system, n, t + c(5)*h, y, k(:, 5))
        y = y0 + h*(a(1, 6)*k(:, 1) + a(4, 6)*k(:, 4) + a(5, 6)*k(:, 5))
        call slope(system, n, t + c(6)*h, y, k(:, 6))
        y = y0 + h*(a(1, 7)*k(:, 1) + a(4, 7)*k(:, 4) + a(5, 7)*k(:, 5) + a(6, 7)*k(:, 6))
        call slope(system, n, t + c(7)*h, y, k(:, 7))
        y = y0 + h*(a(1, 8)*k(:, 1) + a(4, 8)*k(:, 4) + a(5, 8)*k(:, 5) + a(6, 8)*k(:, 6) &
                    + a(7, 8)*k(:, 7))
        call slope(system, n, t + c(8)*h, y, k(:, 8))
        y = y0 + h*(a(1, 9)*k(:, 1) + a(4, 9)*k(:, 4) + a(5, 9)*k(:, 5) + a(6, 9)*k(:, 6) &
                    + a(7, 9)*k(:, 7) + a(8, 9)*k(:, 8))
        call slope(system, n, t + c(9)*h, y, k(:, 9))
        y = y0 + h*(a(1, 10)*k(:, 1) + a(4, 10)*k(:, 4) + a(5, 10)*k(:, 5) + a(6, 10)*k(:, 6) &
                    + a(7, 10)*k(:, 7) + a(8, 10)*k(:, 8) + a(9, 10)*k(:, 9))
        call slope(system, n, t + c(10)*h, y, k(:, 10))
        y = y0 + h*(a(1, 11)*k(:, 1) + a(4, 11)*k(:, 4) + a(5, 11)*k(:, 5) + a(6, 11)*k(:, 6) &
                    + a(7, 11)*k(:, 7) + a(8, 11)*k(:, 8) + a(9, 11)*k(:, 9) &
                    + a(10, 11)*k(:, 10))
        call slope(system, n, t + c(11)*h, y, k(:, 11))
        y = y0 + h*(a(1, 12)*k(:, 1) + a(4, 12)*k(:, 4) + a(5, 12)*k(:, 5) + a(6, 12)*k(:, 6) &
                    + a(7, 12)*k(:, 7) + a(8, 12)*k(:, 8) + a(9, 12)*k(:, 9) &
                    + a(10, 12)*k(:, 10) + a(11, 12)*k(:, 11))
        call slope(system, n, t + c(12)*h, y, k(:, 12))
        y = y0 + h*(b(1)*k(:, 1) + b(6)*k(:, 6) + b(7)*k(:, 7) + b(8)*k(:, 8) + b(9)*k(:, 9) &
                    + b(10)*k(:, 10) + b(11)*k(:, 11) + b(12)*k(:, 12))
    end subroutine stages

    pure subroutine extra_stages(system, n, t, h, y0, y1, k, dense, y)
        !! Slopes 13 to 16; rows of `dense`: difference over the step, three corrections up to
        !! the cubic Hermite polynomial, and four beyond.
        class(system_t), intent(in) :: system
        integer, intent(in) :: n
        real(dp), intent(in) :: t, h, y0(2*n), y1(2*n)
        real(dp), intent(inout) :: k(2*n, 16)
        real(dp), intent(out) :: dense(7, 2*n)
        real(dp), intent(out) :: y(2*n)  !! room for a stage's state
        integer :: j

        call slope(system, n, t + h, y1, k(:, 13))
        y = y0 + h*(a(1, 14)*k(:, 1) + a(7, 14)*k(:, 7) + a(8, 14)*k(:, 8) + a(9, 14)*k(:, 9) &
                    + a(10, 14)*k(:, 10) + a(11, 14)*k(:, 11) + a(12, 14)*k(:, 12) &
                    + a(13, 14)*k(:, 13))
        call slope(system, n, t + c(14)*h, y, k(:, 14))
        y = y0 + h*(a(1, 15)*k(:, 1) + a(6, 15)*k(:, 6) + a(7, 15)*k(:, 7) + a(8, 15)*k(:, 8) &
                    + a(11, 15)*k(:, 11) + a(12, 15)*k(:, 12) + a(13, 15)*k(:, 13) &
                    + a(14, 15)*k(:, 14))
        call slope(system, n, t + c(15)*h, y, k(:, 15))
        y = y0 + h*(a(1, 16)*k(:, 1) + a(6, 16)*k(:, 6) + a(7, 16)*k(:, 7) + a(8, 16)*k(:, 8) &
                    + a(9, 16)*k(:, 9) + a(13, 16)*k(:, 13) + a(14, 16)*k(:, 14) &
                    + a(15, 16)*k(:, 15))
        call slope(system, n, t + c(16)*h, y, k(:, 16))
        dense(1, :) = y1 - y0
        dense(2, :) = h*k(:, 1) - dense(1, :)
        dense(3, :) = dense(1, :) - h*k(:, 13) - dense(2, :)
        do j = 4, 7
            dense(j, :) = h*(d(1, j)*k(:, 1) + d(6, j)*k(:, 6) + d(7, j)*k(:, 7) &
                             + d(8, j)*k(:, 8) + d(9, j)*k(:, 9) + d(10, j)*k(:, 10) &
                             + d(11, j)*k(:, 11) + d(12, j)*k(:, 12) + d(13, j)*k(:, 13) &
                             + d(14, j)*k(:, 14) + d(15, j)*k(:, 15) + d(16, j)*k(:, 16))
        end do
    end subroutine extra_stages
    pure function scaled_error(h, tolerance, k, y0, y) result(scaled)
        !! The estimated error of a step in units of the tolerance, \(O(h^8)\): the error of an
        !! embedded solution of order 5, squared, over mostly that of one of order 3. A root mean
        !! square over the components, absolute below 1 and relative above; huge if it is NaN.
        real(dp), intent(in) :: h, tolerance, k(:, :), y0(:), y(:)
        real(dp) :: scaled, fifth, third, weight, k5, k3
        integer :: i

        fifth = 0.0_dp
        third = 0.0_dp
        do i = 1, size(y)
            k5 = e5(1)*k(i, 1) + e5(6)*k(i, 6) + e5(7)*k(i, 7) + e5(8)*k(i, 8) &
                 + e5(9)*k(i, 9) + e5(10)*k(i, 10) + e5(11)*k(i, 11) + e5(12)*k(i, 12)
            k3 = e3(1)*k(i, 1) + e3(6)*k(i, 6) + e3(7)*k(i, 7) + e3(8)*k(i, 8) &
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
