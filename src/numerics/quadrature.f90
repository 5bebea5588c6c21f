module lagrangia_quadrature
    !! Integrals over one period of smooth periodic functions.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: integrand_t, integrate_period

    type, abstract :: integrand_t
        !! A function of one variable; what else it depends on are components of its extension.
    contains
        procedure(value_i), deferred :: value
    end type integrand_t

    abstract interface
        pure function value_i(self, x) result(y)
            import :: dp, integrand_t
            implicit none (type, external)
            class(integrand_t), intent(in) :: self
            real(dp), intent(in) :: x
            real(dp) :: y
        end function value_i
    end interface

    integer, parameter :: first_points = 24     !! a multiple of 3: few harmonics are mistaken
    integer, parameter :: most_points = 24*2**16
    real(dp), parameter :: agreement = 1e-13_dp  !! of successive sums, relative to \(\int|f|\)

contains

    pure subroutine integrate_period(f, start, period, integral, error)
        !! \(\int_{start}^{start+period} f(x)\,dx\) by the trapezoid rule, doubled until it settles.
        !!
        !! The rule converges geometrically for an analytic \(f\): once two sums agree to 1e-13, the
        !! second is right to rounding. A jump or a kink is not settled by 1.6 million points and is
        !! refused. Harmonics that are multiples of 48 periods are not seen by the first two sums.
        !!
        !! Source: Trefethen & Weideman, SIAM Review 56, 385 (2014), theorem 3.2.
        class(integrand_t), intent(in) :: f
        real(dp), intent(in) :: start, period
        real(dp), intent(out) :: integral
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: mean, weight, finer, finer_weight
        integer :: points

        integral = 0.0_dp
        points = first_points
        call sample_mean(f, start, period, points, 0.0_dp, mean, weight)
        do while (points < most_points)
            call sample_mean(f, start, period, points, 0.5_dp, finer, finer_weight)
            finer = 0.5_dp*(mean + finer)
            weight = 0.5_dp*(weight + finer_weight)
            points = 2*points
            if (.not. ieee_is_finite(weight*period)) then
                call fail(error, "quadrature: the integrand is not finite", status_numbers)
                return
            end if
            if (abs(finer - mean) <= agreement*weight) then
                integral = period*finer
                return
            end if
            mean = finer
        end do
        call fail(error, "quadrature: no convergence; the integrand must be smooth and periodic", &
                  status_numbers)
    end subroutine integrate_period

    pure subroutine sample_mean(f, start, period, points, shift, mean, weight)
        !! Means of \(f\) and \(|f|\) over equidistant points, moved by `shift` of their distance.
        class(integrand_t), intent(in) :: f
        real(dp), intent(in) :: start, period, shift
        integer, intent(in) :: points
        real(dp), intent(out) :: mean, weight
        real(dp) :: y
        integer :: i

        mean = 0.0_dp
        weight = 0.0_dp
        do i = 0, points - 1
            y = f%value(start + period*((i + shift)/points))
            mean = mean + y
            weight = weight + abs(y)
        end do
        mean = mean/points
        weight = weight/points
    end subroutine sample_mean
end module lagrangia_quadrature
