module test_cart_pendulum
    !! The cart-pendulum and its quadrature.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertRelativelyEqual, assertTrue
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_reference, only: reference_t
    use motion, only: newton_lagrangian, point_accelerations
    use random_states, only: draw_parameters, draw_state, restart_random, uniform
    use reference_checks, only: check_reference, check_state
    implicit none (type, external)
    private
    public :: cart_pendulum_suite

    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    function cart_pendulum_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("cart_pendulum")
        call suite%addTest(TestMethod("lagrangian_is_that_of_two_masses", &
                                      lagrangian_is_that_of_two_masses, setUp=restart_random))
        call suite%addTest(TestMethod("tension_moves_both", tension_moves_both, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("small_oscillations", small_oscillations))
        call suite%addTest(TestMethod("periods_from_rest", periods_from_rest))
        call suite%addTest(TestMethod("period_is_the_integral", period_is_the_integral))
        call suite%addTest(TestMethod("state_from_rest", state_from_rest, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("bob_moves_on_an_ellipse", bob_moves_on_an_ellipse))
        call suite%addTest(TestMethod("heavy_cart_is_a_pendulum", heavy_cart_is_a_pendulum, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("reference_solves_it", reference_solves_it, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("what_the_reference_leaves_out", &
                                      what_the_reference_leaves_out, setUp=restart_random))
    end function cart_pendulum_suite

    subroutine start(values, q, v, reference)
        !! The closed form from `(q, v)` at t = 0, with the parameters m1, m2, l, g.
        real(dp), intent(in) :: values(4), q(2), v(2)
        class(reference_t), allocatable, intent(out) :: reference
        type(cart_pendulum_t) :: system
        type(error_t), allocatable :: error

        call system%configure(values, error)
        call system%closed_form(0.0_dp, q, v, reference)
        call assertTrue(allocated(reference), "closed form found")
    end subroutine start

    subroutine lagrangian_is_that_of_two_masses()
        !! L is T - V in Cartesian coordinates, with the cross term that the notes lose.
        type(cart_pendulum_t) :: system
        type(hyperdual_t) :: l
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t, expected
        integer :: i

        do i = 1, 20
            call draw_parameters(system, edges=.false.)
            call draw_state(system, t, q, v)
            l = system%lagrangian(hyperdual(t), hyperdual(q), hyperdual(v))
            expected = newton_lagrangian(system, t, q, v, system%g)
            call assertEqual(expected, l%re, 2e-13_dp*100.0_dp, "T - V")
        end do
    end subroutine lagrangian_is_that_of_two_masses

    subroutine tension_moves_both()
        !! Newton's law: weight and tension on the bob, the tension's reaction on the cart.
        type(cart_pendulum_t) :: system
        real(dp), allocatable :: q(:), v(:), r(:, :), a(:, :)
        real(dp) :: t, pull(3)
        integer :: i

        do i = 1, 20
            call draw_parameters(system, edges=.false.)
            call draw_state(system, t, q, v)
            call point_accelerations(system, t, q, v, r, a)
            pull = (r(:, 1) - r(:, 2))/system%l*system%quantity(3, t, q, v)
            call assertEqual(pull, system%m2*(a(:, 2) + [0.0_dp, system%g, 0.0_dp]), &
                             1e-13_dp*100.0_dp, "bob")
            call assertEqual(-pull(1), system%m1*a(1, 1), 1e-13_dp*100.0_dp, "cart")
        end do
    end subroutine tension_moves_both

    subroutine small_oscillations()
        !! omega^2 = (m1 + m2) g/(m1 l) = 14.715, and a zero mode.
        type(cart_pendulum_t) :: system
        type(error_t), allocatable :: error
        real(dp), dimension(2) :: a
        real(dp), parameter :: still(2) = 0.0_dp, small = 1e-8_dp

        call system%configure([1.0_dp, 0.5_dp, 1.0_dp, 9.81_dp], error)
        call system%accelerations(0.0_dp, [0.0_dp, small], still, a)
        call assertEqual(-14.715_dp, a(2)/small, 1e-13_dp, "omega^2")
        call system%accelerations(0.0_dp, [5.0_dp, 0.0_dp], still, a)
        call assertEqual([0.0_dp, 0.0_dp], a, 0.0_dp, "zero mode")
    end subroutine small_oscillations

    subroutine periods_from_rest()
        !! m1 = 1, m2 = 0.5, l = 1: numbers of 20 digits.
        real(dp), parameter :: theta(5) = [0.01_dp, 0.5_dp, 1.0_dp, 2.0_dp, 3.0_dp]
        real(dp), parameter :: period(5) = [ &
            1.6379772969159153746_dp, 1.7118591856112341094_dp, 1.9074330624194057881_dp, &
            2.5328177353089396884_dp, 4.540468197839614604_dp]
        class(reference_t), allocatable :: reference
        real(dp), parameter :: mu = 1.0_dp/3.0_dp
        real(dp) :: series
        integer :: i

        do i = 1, size(theta)
            call start([1.0_dp, 0.5_dp, 1.0_dp, 9.81_dp], [0.0_dp, theta(i)], [0.0_dp, 0.0_dp], &
                       reference)
            call assertRelativelyEqual(period(i), reference%period, 3e-15_dp, "period")
        end do
        call start([1.0_dp, 0.5_dp, 1.0_dp, 9.81_dp], [0.0_dp, 0.01_dp], [0.0_dp, 0.0_dp], &
                   reference)
        series = 1.0_dp + (1.0_dp + 3.0_dp*mu)/(16.0_dp*(1.0_dp - mu))*0.01_dp**2 &
                 + (11.0_dp - 158.0_dp*mu + 3.0_dp*mu**2)/(3072.0_dp*(1.0_dp - mu)**2)*0.01_dp**4
        call assertRelativelyEqual(2.0_dp*pi/3.83601355576332655_dp, reference%small_period, &
                                   1e-15_dp, "small period")
        call assertRelativelyEqual(series, reference%period/reference%small_period, 2e-14_dp, &
                                   "T/T0 in powers of the amplitude, but for its sixth: 1e-12")
    end subroutine periods_from_rest

    subroutine period_is_the_integral()
        !! \(T = 2\sqrt{\ell/g}\int_0^\pi\sqrt{1-\mu(1-2s^2)^2}/\sqrt{1-s^2}\,d\varphi\),
        !! \(s = k\sin\varphi\), by the trapezoid rule, whose error \(e^{-2nd}\) is far below
        !! rounding: the integrand has no pole nearer to the real axis than \(d = 0.07\).
        integer, parameter :: n = 1000
        real(dp), parameter :: mu = 1.7_dp/(0.6_dp + 1.7_dp)
        class(reference_t), allocatable :: reference
        real(dp) :: s(n), integral
        integer :: i, j

        do i = 1, 30
            s = sin(0.05_dp*i)*[(sin(pi*j/n), j=1, n)]
            integral = pi/n*sum(sqrt(1.0_dp - mu*(1.0_dp - 2.0_dp*s**2)**2)/sqrt(1.0_dp - s**2))
            call start([0.6_dp, 1.7_dp, 0.8_dp, 3.7_dp], [0.2_dp, 0.1_dp*i], [0.0_dp, 0.0_dp], &
                       reference)
            call assertRelativelyEqual(2.0_dp*sqrt(0.8_dp/3.7_dp)*integral, reference%period, &
                                       1e-14_dp, "period")
        end do
    end subroutine period_is_the_integral

    subroutine state_from_rest()
        !! m1 = 1, m2 = 0.5, l = 1, theta0 = 1, t = 2.
        class(reference_t), allocatable :: reference

        call start([1.0_dp, 0.5_dp, 1.0_dp, 9.81_dp], [0.0_dp, 1.0_dp], [0.0_dp, 0.0_dp], reference)
        call check_state(reference, 2.0_dp, [0.00727097400054403887_dp, 0.960813861543320187_dp], &
                         [0.161699126739110168_dp, -0.84680940129507143_dp], 8e-15_dp, "mpmath")
    end subroutine state_from_rest

    subroutine bob_moves_on_an_ellipse()
        !! With p_x = 0, semi-axes m1 l/(m1 + m2) and l about a fixed centre.
        type(cart_pendulum_t) :: system
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2), centre, x, y
        real(dp), parameter :: m1 = 0.6_dp, m2 = 1.7_dp, l = 0.8_dp
        integer :: i

        call system%configure([m1, m2, l, 9.81_dp], error)
        call system%closed_form(0.0_dp, [0.3_dp, 2.5_dp], [0.0_dp, 0.0_dp], reference)
        centre = 0.3_dp + m2/(m1 + m2)*l*sin(2.5_dp)
        do i = 1, 40
            call reference%state_at(0.31_dp*i, q, v)
            x = (q(1) + l*sin(q(2)) - centre)/(m1*l/(m1 + m2))
            y = cos(q(2))
            call assertEqual(1.0_dp, x**2 + y**2, 1e-14_dp, "ellipse")
        end do
    end subroutine bob_moves_on_an_ellipse

    subroutine heavy_cart_is_a_pendulum()
        !! m1 = 1e20: Fourier's series and Jacobi's functions meet, in libration and rotation.
        class(reference_t), allocatable :: cart
        class(reference_t), allocatable :: pendulum
        type(pendulum_t) :: system
        type(error_t), allocatable :: error
        real(dp), parameter :: theta(5) = [0.3_dp, -3.0_dp, 8.0_dp, 0.5_dp, -2.0_dp]
        real(dp), parameter :: speed(5) = [0.0_dp, 0.1_dp, -1.0_dp, 9.0_dp, -8.0_dp]
        real(dp) :: q(1), v(1), t
        integer :: i, j

        call system%configure([0.7_dp, 0.8_dp, 9.81_dp], error)
        do i = 1, size(theta)
            call system%closed_form(0.0_dp, theta(i:i), speed(i:i), pendulum)
            call start([1e20_dp, 0.7_dp, 0.8_dp, 9.81_dp], [0.2_dp, theta(i)], &
                       [0.0_dp, speed(i)], cart)
            call assertRelativelyEqual(pendulum%period, cart%period, 2e-14_dp, "period")
            do j = 1, 20
                t = uniform(-5.0_dp, 10.0_dp)
                call pendulum%state_at(t, q, v)
                call check_state(cart, t, [0.2_dp, q(1)], [0.0_dp, v(1)], &
                                 2e-15_dp*(100.0_dp + abs(q(1))), "heavy cart")
            end do
            if (anyExceptions()) return
        end do
    end subroutine heavy_cart_is_a_pendulum

    subroutine reference_solves_it()
        !! From random states, the whole moving along, in libration and rotation.
        type(cart_pendulum_t) :: system
        class(reference_t), allocatable :: reference
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t
        integer :: i

        do i = 1, 20
            call draw_parameters(system, edges=mod(i, 2) == 0)
            call draw_state(system, t, q, v)
            call system%closed_form(t, q, v, reference)
            call assertTrue(allocated(reference), "found")
            call check_reference(reference, system, t, q, v, "cart-pendulum")
            if (anyExceptions()) return
        end do
    end subroutine reference_solves_it

    subroutine what_the_reference_leaves_out()
        !! The immediate neighbourhood of the separatrix, and carts of nearly no mass.
        type(cart_pendulum_t) :: system
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error

        call system%configure([1.0_dp, 0.5_dp, 1.0_dp, 9.81_dp], error)
        call system%closed_form(0.0_dp, [0.0_dp, pi], [0.0_dp, 0.0_dp], reference)
        call assertFalse(allocated(reference), "at the top")
        call system%closed_form(0.0_dp, [0.0_dp, 3.13_dp], [0.0_dp, 0.0_dp], reference)
        call assertTrue(allocated(reference), "0.0116 rad from the top")
        call system%closed_form(0.0_dp, [0.3_dp, 0.0_dp], [0.5_dp, 0.0_dp], reference)
        call assertTrue(allocated(reference), "hanging still")
        call check_state(reference, 4.0_dp, [2.3_dp, 0.0_dp], [0.5_dp, 0.0_dp], 1e-15_dp, "still")
        call system%configure([1e-9_dp, 0.5_dp, 1.0_dp, 9.81_dp], error)
        call system%closed_form(0.0_dp, [0.0_dp, 1.0_dp], [0.0_dp, 0.0_dp], reference)
        call assertFalse(allocated(reference), "light cart")
    end subroutine what_the_reference_leaves_out
end module test_cart_pendulum
