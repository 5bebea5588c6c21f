module test_forced_oscillation
    !! The damped and driven oscillator in closed form, against mpmath: under, at and above critical
    !! damping, at and off resonance, with transients; and divided differences of the exponential.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_damped_rates, only: damped_rates
    use lagrangia_errors, only: error_t
    use lagrangia_exponential_differences, only: first_difference, second_difference
    use lagrangia_kinds, only: dp, qp
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_reference, only: reference_t
    use lagrangia_small_oscillations, only: find_modes, modes_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: forced_oscillation_suite

contains

    function forced_oscillation_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("forced_oscillation")
        call suite%addTest(TestMethod("as_by_mpmath", as_by_mpmath))
        call suite%addTest(TestMethod("periods_are_those_of_the_damped", &
                                      periods_are_those_of_the_damped))
        call suite%addTest(TestMethod("flags_follow_from_parameters", flags_follow_from_parameters))
        call suite%addTest(TestMethod("differences_meet", differences_meet))
        call suite%addTest(TestMethod("modes_decay", modes_decay))
    end function forced_oscillation_suite

    subroutine as_by_mpmath()
        !! m, k, b, F0, W, t0, x0, v0, t; x, x_dot, with 22 digits by mpmath at 140, from the
        !! doubles that are given here: x_p + c_+ exp(lambda_+ u) + c_- exp(lambda_- u), with
        !! F0/m Re exp(iWt)/(k/m - W^2 + 2 i gamma W) for x_p and the c of the start; where a
        !! denominator vanishes, omega or W moved by 1e-40.
        !!
        !! Rounded products and exponents: 4 epsilon; and the exponents' own rounding, an epsilon
        !! of \(|\lambda_+u| + Wu\), of the state's size.
        integer, parameter :: cases = 20
        real(dp), parameter :: table(11, cases) = reshape([ &
            1.3_dp, 7.1_dp, 0.4_dp, 0.0_dp, 0.0_dp, 0.2_dp, 0.7_dp, -0.3_dp, 9.7_dp, &
            -0.1571000670526671127237_dp, 0.1292755136549022555325_dp, &
            1.3_dp, 0.9_dp, 5.0_dp, 0.0_dp, 0.0_dp, -0.5_dp, 0.7_dp, 2.1_dp, 6.3_dp, &
            0.3708946136398494717457_dp, -0.07021733058691854124131_dp, &
            1.0_dp, 0.001_dp, 50.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, -0.5_dp, 300.0_dp, &
            0.9840781717071159034273_dp, -0.00001968157130677399024178_dp, &
            1.0_dp, 4.0_dp, 4.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, -1.5_dp, 2.5_dp, &
            0.01516038074794230096743_dp, -0.02695178799634186838654_dp, &
            1.0_dp, 4.0_dp, 4.000000000000004_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, -1.5_dp, 2.5_dp, &
            0.01516038074794251915229_dp, -0.02695178799634209903911_dp, &
            1.0_dp, 4.0_dp, 3.9999999999999996_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, -1.5_dp, &
            2.5_dp, &
            0.01516038074794227914894_dp, -0.02695178799634184532129_dp, &
            0.7_dp, 4.1_dp, 3.3882148691609_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, -1.5_dp, 12.5_dp, &
            9.093590626929372629129e-13_dp, -2.133858779032187482799e-12_dp, &
            2.0_dp, 8.0_dp, 0.0_dp, 1.5_dp, 2.0_dp, 0.3_dp, 0.0_dp, 0.0_dp, 40.0_dp, &
            -7.358135753461626650773_dp, -1.760685094739011708566_dp, &
            2.0_dp, 8.0_dp, 0.0_dp, 1.5_dp, 2.000000001_dp, 0.3_dp, 0.1_dp, 0.4_dp, 40.0_dp, &
            -7.574958070710929186538_dp, -1.870011630198656860972_dp, &
            2.0_dp, 8.0_dp, 1e-6_dp, 1.5_dp, 2.0_dp, 0.3_dp, 0.0_dp, 0.0_dp, 40.0_dp, &
            -7.358099485632416299573_dp, -1.760674855537636528874_dp, &
            1.3_dp, 7.1_dp, 0.4_dp, 2.2_dp, 1.9_dp, 0.2_dp, 0.7_dp, -0.3_dp, 9.7_dp, &
            0.694134451869976820813_dp, 1.12395462333704930326_dp, &
            1.3_dp, 0.9_dp, 5.0_dp, -2.2_dp, 0.6_dp, -0.5_dp, 0.7_dp, 2.1_dp, 6.3_dp, &
            0.8833101977508915776353_dp, 0.2387257798967395222292_dp, &
            1.0_dp, 4.0_dp, 4.0_dp, 1.1_dp, 2.0_dp, 0.0_dp, 1.0_dp, -1.5_dp, 2.5_dp, &
            -0.1213240455801105081545_dp, 0.0584670547050393750451_dp, &
            1.0_dp, 4.0_dp, 4.0_dp, 1.1_dp, 2e-5_dp, 0.0_dp, 1.0_dp, -1.5_dp, 12.5_dp, &
            0.2749999927001388493547_dp, -1.268471974710948259333e-9_dp, &
            1.3_dp, 0.0_dp, 0.0_dp, 2.2_dp, 1.9_dp, 0.2_dp, 0.7_dp, -0.3_dp, 9.7_dp, &
            -5.281341036334595257494_dp, -0.9932007603746963465161_dp, &
            1.3_dp, 0.0_dp, 0.4_dp, 2.2_dp, 1.9_dp, 0.2_dp, 0.7_dp, -0.3_dp, 9.7_dp, &
            -1.664547132637691246086_dp, -0.2656477964861759612358_dp, &
            1.3_dp, 7.1_dp, 0.4_dp, 2.2_dp, 0.0_dp, 0.2_dp, 0.7_dp, -0.3_dp, 9.7_dp, &
            0.2244319080735747297267_dp, 0.1021120037534816419859_dp, &
            1.3_dp, 7.1_dp, 0.4_dp, 2.2_dp, 300.0_dp, 0.2_dp, 0.7_dp, -0.3_dp, 9.7_dp, &
            -0.1571355057917718468961_dp, 0.1332537671244530459443_dp, &
            1.3_dp, 7.1_dp, 0.4_dp, 2.2_dp, 1.9_dp, 0.2_dp, 0.7_dp, -0.3_dp, -3.1_dp, &
            0.966908695532359028043_dp, -0.8602826346892373699139_dp, &
            1.0_dp, 1.0_dp, 0.1_dp, 1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 200.0_dp, &
            -8.732533531934146892669_dp, 4.871738629719238963066_dp &
            ], [11, cases])
        type(oscillator_t) :: system
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), rate, angle, size_of, gamma
        complex(dp) :: root
        integer :: i

        do i = 1, cases
            associate (p => table(:5, i), t0 => table(6, i), x0 => table(7, i), v0 => table(8, i), &
                       t => table(9, i), x => table(10, i), x_dot => table(11, i))
                call system%configure(p, error)
                call assertFalse(allocated(error), "parameters")
                call system%closed_form(t0, [x0], [v0], reference)
                call reference%state_at(t, q, v)
                gamma = 0.5_dp*p(3)/p(1)
                root = sqrt(cmplx(gamma**2 - p(2)/p(1), 0.0_dp, dp))
                rate = aimag(root)
                if (abs(p(4)) > 0.0_dp) rate = rate + p(5)
                angle = rate*abs(t - t0)
                if (abs(gamma + root) > 0.0_dp) angle = angle &
                    + abs(p(2)/p(1)/(gamma + root))*abs(t - t0)
                size_of = abs(x)
                if (rate > 0.0_dp) size_of = size_of + abs(x_dot)/rate
                call assertEqual(x, q(1), epsilon(x)*(4.0_dp*abs(x) + angle*size_of), &
                                 "x of row "//to_text(i))
                call assertEqual(x_dot, v(1), epsilon(x)*(4.0_dp*abs(x_dot) &
                                 + angle*(abs(x_dot) + rate*size_of)), "x_dot of row "//to_text(i))
            end associate
        end do
    end subroutine as_by_mpmath

    subroutine periods_are_those_of_the_damped()
        !! m = 1, k = 25, b = 6: gamma = 3, omega = 4. Neither overdamped nor driven there is one.
        type(oscillator_t) :: system
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error

        call system%configure([1.0_dp, 25.0_dp, 6.0_dp], error)
        call system%closed_form(0.0_dp, [1.0_dp], [0.0_dp], reference)
        call assertEqual(0.5_dp*acos(-1.0_dp), reference%period, 1e-15_dp, "underdamped")
        call assertEqual(reference%period, reference%small_period, 0.0_dp, "small")
        call system%configure([1.0_dp, 25.0_dp, 10.0_dp], error)
        call system%closed_form(0.0_dp, [1.0_dp], [0.0_dp], reference)
        call assertEqual(0.0_dp, reference%period, 0.0_dp, "critical")
        call system%configure([1.0_dp, 25.0_dp, 6.0_dp, 1.0_dp, 1.0_dp], error)
        call system%closed_form(0.0_dp, [1.0_dp], [0.0_dp], reference)
        call assertEqual(0.0_dp, reference%period, 0.0_dp, "driven")
    end subroutine periods_are_those_of_the_damped

    subroutine flags_follow_from_parameters()
        !! Velocities with b, time with a drive that turns, forces with either; with none of them
        !! the first parameters are enough.
        call expect([2.0_dp, 8.0_dp], .false., .false., .false., 0)
        call expect([2.0_dp, 0.0_dp], .false., .false., .false., 1)
        call expect([2.0_dp, 0.0_dp, 0.1_dp], .true., .true., .false., 0)
        call expect([2.0_dp, 0.0_dp, 0.0_dp, -0.1_dp], .true., .false., .false., 0)
        call expect([2.0_dp, 8.0_dp, 0.0_dp, 0.1_dp, 3.0_dp], .true., .false., .true., 0)
        call expect([2.0_dp, 8.0_dp, 0.0_dp, 0.0_dp, 3.0_dp], .false., .false., .false., 0)
    contains
        subroutine expect(p, forces, velocities, time, cyclic)
            real(dp), intent(in) :: p(:)
            logical, intent(in) :: forces, velocities, time
            integer, intent(in) :: cyclic
            type(oscillator_t) :: system
            type(error_t), allocatable :: error

            call system%configure(p, error)
            call assertFalse(allocated(error), "parameters")
            call assertTrue(system%nonconservative .eqv. forces, "nonconservative")
            call assertTrue(system%velocity_forces .eqv. velocities, "velocity_forces")
            call assertTrue(system%time_dependent .eqv. time, "time_dependent")
            call assertEqual(cyclic, system%cyclic, "cyclic")
            call system%configure([p(1), p(2), -1e-9_dp], error)
            call assertTrue(allocated(error), "negative damping")
            call system%configure([p(1)], error)
            call assertTrue(allocated(error), "no k")
        end subroutine expect
    end subroutine flags_follow_from_parameters

    subroutine modes_decay()
        !! m = 1: k = 25, b = 6 decays at 3 and turns at 4; k = 4, b = 5 decays at 1 and at 4; a
        !! constant force of 2 N stretches k = 8 by 0.25 m. At critical damping, b = 2 sqrt(k m) but
        !! for rounding, nothing oscillates, and both decay at b/(2 m).
        type(oscillator_t) :: system
        type(modes_t) :: modes
        complex(dp), allocatable :: lambda(:)
        type(error_t), allocatable :: error
        real(dp) :: k
        integer :: i

        call system%configure([1.0_dp, 25.0_dp, 6.0_dp], error)
        call find_modes(system, [0.0_dp], .false., modes, error)
        call assertFalse(allocated(error), "modes")
        call assertEqual(25.0_dp, modes%omega2(1), 1e-13_dp, "undamped")
        call damped_rates(system, modes, lambda, error)
        call assertEqual(1, size(lambda), "of a pair one")
        call assertEqual([-3.0_dp, 4.0_dp], [real(lambda(1)), aimag(lambda(1))], 1e-14_dp, "under")
        call system%configure([1.0_dp, 4.0_dp, 5.0_dp], error)
        call find_modes(system, [0.0_dp], .false., modes, error)
        call damped_rates(system, modes, lambda, error)
        call assertEqual([-1.0_dp, -4.0_dp], real(lambda), 1e-14_dp, "over")
        call assertEqual([0.0_dp, 0.0_dp], aimag(lambda), 0.0_dp, "no oscillation")
        do i = 1, 100
            k = 0.37_dp*i
            call system%configure([1.1_dp, k, 2.0_dp*sqrt(1.1_dp*k)], error)
            call find_modes(system, [0.0_dp], .false., modes, error)
            call damped_rates(system, modes, lambda, error)
            call assertEqual(-sqrt(k/1.1_dp)*[1, 1], real(lambda), 1e-14_dp*k, "critical")
            call assertEqual([0.0_dp, 0.0_dp], aimag(lambda), 0.0_dp, "no oscillation")
        end do
        call system%configure([1.0_dp, 8.0_dp, 0.0_dp, 2.0_dp], error)
        call find_modes(system, [0.0_dp], .false., modes, error)
        call assertEqual([0.25_dp], modes%at, 1e-14_dp, "stretched")
    end subroutine modes_decay

    subroutine differences_meet()
        !! \(e^{[a, b]}\) and \(e^{[a, b, c]}\) of points at distances from 0 to 30, against the
        !! quotients in quadruple precision, where of the points nothing is rounded.
        complex(dp), parameter :: a = (-0.3_dp, 0.7_dp)
        real(dp), parameter :: distance(7) = [1e-7_dp, 1e-3_dp, 0.2_dp, 0.6_dp, 0.97_dp, 3.0_dp, &
                                              30.0_dp]
        complex(dp) :: b, c
        complex(qp) :: x, y, z, first, second
        real(dp) :: size_of
        integer :: i, k

        call assertEqual(0.0_dp, abs(first_difference(a, a) - exp(a)), epsilon(1.0_dp), "a, a")
        call assertEqual(0.0_dp, abs(second_difference(a, a, a) - 0.5_dp*exp(a)), &
                         epsilon(1.0_dp), "a, a, a")
        do i = 1, size(distance)
            do k = 0, 3
                b = a + distance(i)*exp(cmplx(0.0_dp, 0.5_dp + 0.8_dp*k, dp))
                if (real(b) > 0.0_dp) b = cmplx(-real(b), aimag(b), dp)
                c = cmplx(0.3_dp*real(a) + 0.7_dp*real(b), aimag(a) - 0.4_dp*distance(i), dp)
                x = a
                y = b
                z = c
                first = (exp(x) - exp(y))/(x - y)
                second = (first - (exp(y) - exp(z))/(y - z))/(x - z)
                size_of = epsilon(1.0_dp)*(4.0_dp + abs(a) + abs(b) + abs(c))
                call assertEqual(0.0_dp, real(abs(first_difference(a, b) - first), dp), &
                                 size_of*real(abs(first), dp), "two, "//to_text(distance(i)))
                call assertEqual(0.0_dp, real(abs(second_difference(a, b, c) - second), dp), &
                                 4.0_dp*size_of*real(abs(second), dp), &
                                 "three, "//to_text(distance(i)))
            end do
        end do
    end subroutine differences_meet
end module test_forced_oscillation
