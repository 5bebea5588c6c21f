module test_quadrature
    !! The periodic trapezoid rule finds what is known otherwise, or refuses.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertRelativelyEqual, assertTrue
    use lagrangia_errors, only: error_t, status_numbers
    use lagrangia_kinds, only: dp
    use lagrangia_quadrature, only: integrand_t, integrate_period
    implicit none (type, external)
    private
    public :: quadrature_suite

    type, extends(integrand_t) :: bessel_t
        !! \(e^{a\cos 2\pi x/p}\): its mean is \(I_0(a)\).
        real(dp) :: a, period
    contains
        procedure :: value => bessel_value
    end type bessel_t

    type, extends(integrand_t) :: swing_t
        !! What a quarter swing of the cart-pendulum takes (physics.md, 3.1), with
        !! \(1 - k^2\sin^2 x\) as \(\cos^2 x + k'^2\sin^2 x\), which does not cancel.
        real(dp) :: mu, start, scale
    contains
        procedure :: value => swing_value
    end type swing_t

    type, extends(integrand_t) :: power_t
        !! \(\sin^n x\).
        integer :: n
    contains
        procedure :: value => power_value
    end type power_t

    type, extends(integrand_t) :: ramp_t
        !! \(a + x^{p}\): not periodic.
        real(dp) :: a, p
    contains
        procedure :: value => ramp_value
    end type ramp_t

    real(dp), parameter :: eps = epsilon(1.0_dp)
    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    function quadrature_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("quadrature")
        call suite%addTest(TestMethod("bessel_integral", bessel_integral))
        call suite%addTest(TestMethod("cart_pendulum_periods", cart_pendulum_periods))
        call suite%addTest(TestMethod("trigonometric_polynomials", trigonometric_polynomials))
        call suite%addTest(TestMethod("refuses_a_jump", refuses_a_jump))
        call suite%addTest(TestMethod("refuses_a_pole", refuses_a_pole))
    end function quadrature_suite

    subroutine bessel_integral()
        !! \(p I_0(a)\) from any start; I_0(2.5), I_0(40) from mpmath. Two dozen to a hundred terms
        !! of one sign: 16 epsilon, and for `exp(40)` the rounding of its argument, 40 more.
        real(dp) :: integral
        type(error_t), allocatable :: error

        call integrate_period(bessel_t(2.5_dp, 0.3_dp), 7.1_dp, 0.3_dp, integral, error)
        call assertFalse(allocated(error), "no error: bessel integral")
        call assertRelativelyEqual(0.3_dp*3.289839144050123_dp, integral, 64.0_dp*eps)
        call integrate_period(bessel_t(40.0_dp, 0.3_dp), -0.02_dp, 0.3_dp, integral, error)
        call assertFalse(allocated(error), "no error: bessel integral")
        call assertRelativelyEqual(0.3_dp*14894774793419900.0_dp, integral, 64.0_dp*eps)
    end subroutine bessel_integral

    subroutine cart_pendulum_periods()
        !! m1 = 1, m2 = 0.5, l = 1, g = 9.81: periods of 22-digit arithmetic, whatever the scale.
        !! A dozen roundings a term and, by 1500 terms of one sign, 40 more on the whole.
        real(dp), parameter :: start(4) = [0.5_dp, 1.0_dp, 3.0_dp, 3.1_dp]
        real(dp), parameter :: expected(4) = [1.7118591856112341_dp, 1.9074330624194058_dp, &
                                              4.540468197839615_dp, 5.8080530213800859_dp]
        real(dp) :: integral
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, size(start)
            call integrate_period(swing_t(1.0_dp/3.0_dp, start(i), 1e-20_dp), 0.0_dp, pi, &
                                  integral, error)
            call assertFalse(allocated(error), "no error: cart pendulum periods")
            call assertRelativelyEqual(expected(i), 2e20_dp*integral/sqrt(9.81_dp), 64.0_dp*eps)
        end do
    end subroutine cart_pendulum_periods

    subroutine trigonometric_polynomials()
        !! Odd powers vanish, which no relative tolerance could see; \(\sin^6\) gives \(5\pi/8\).
        real(dp) :: integral
        type(error_t), allocatable :: error

        call integrate_period(power_t(3), 0.4_dp, 2.0_dp*pi, integral, error)
        call assertFalse(allocated(error), "no error: trigonometric polynomials")
        call assertEqual(0.0_dp, integral, tolerance=16.0_dp*eps)
        call integrate_period(power_t(6), 0.4_dp, 2.0_dp*pi, integral, error)
        call assertFalse(allocated(error), "no error: trigonometric polynomials")
        call assertRelativelyEqual(5.0_dp*pi/8.0_dp, integral, 16.0_dp*eps)
    end subroutine trigonometric_polynomials

    subroutine refuses_a_jump()
        !! A ramp that falls back, by 2 per cent only, at the end of its period.
        real(dp) :: integral
        type(error_t), allocatable :: error

        call integrate_period(ramp_t(50.0_dp, 1.0_dp), 0.0_dp, 1.0_dp, integral, error)
        call assertTrue(allocated(error), "an error: refuses a jump")
        if (anyExceptions()) return
        call assertEqual("quadrature: no convergence; the integrand must be smooth and periodic", &
                         error%message)
        call assertEqual(status_numbers, error%status)
        call assertEqual(0.0_dp, integral)
    end subroutine refuses_a_jump

    subroutine refuses_a_pole()
        !! \(1/x\) at 0.
        real(dp) :: integral
        type(error_t), allocatable :: error

        call integrate_period(ramp_t(0.3_dp, -1.0_dp), 0.0_dp, 1.0_dp, integral, error)
        call assertTrue(allocated(error), "an error: refuses a pole")
        if (anyExceptions()) return
        call assertEqual("quadrature: the integrand is not finite", error%message)
        call assertEqual(status_numbers, error%status)
        call assertEqual(0.0_dp, integral)
    end subroutine refuses_a_pole

    pure function bessel_value(self, x) result(y)
        class(bessel_t), intent(in) :: self
        real(dp), intent(in) :: x
        real(dp) :: y

        y = exp(self%a*cos(2.0_dp*pi*x/self%period))
    end function bessel_value

    pure function swing_value(self, x) result(y)
        class(swing_t), intent(in) :: self
        real(dp), intent(in) :: x
        real(dp) :: y
        real(dp) :: k, kc

        k = sin(0.5_dp*self%start)
        kc = cos(0.5_dp*self%start)
        y = self%scale*sqrt((1.0_dp - self%mu*(1.0_dp - 2.0_dp*(k*sin(x))**2)**2) &
                            /(cos(x)**2 + (kc*sin(x))**2))
    end function swing_value

    pure function power_value(self, x) result(y)
        class(power_t), intent(in) :: self
        real(dp), intent(in) :: x
        real(dp) :: y

        y = sin(x)**self%n
    end function power_value

    pure function ramp_value(self, x) result(y)
        class(ramp_t), intent(in) :: self
        real(dp), intent(in) :: x
        real(dp) :: y

        y = self%a + x**self%p
    end function ramp_value
end module test_quadrature
