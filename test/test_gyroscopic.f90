module test_gyroscopic
    !! Small oscillations that velocities bend: fast and slow modes keep the same digits.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertLessThan, &
                     assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_gyroscopic, only: gyroscopic_modes
    use lagrangia_kinds, only: dp
    use random_states, only: restart_random, uniform
    implicit none (type, external)
    private
    public :: gyroscopic_suite

    integer, parameter :: quad = selected_real_kind(30)

contains

    function gyroscopic_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("gyroscopic")
        call suite%addTest(TestMethod("slow_mode_of_a_strong_field", slow_mode_of_a_strong_field))
        call suite%addTest(TestMethod("two_coordinates_have_a_closed_form", &
                                      two_coordinates_have_a_closed_form, setUp=restart_random))
        call suite%addTest(TestMethod("invariants_of_four_coordinates", &
                                      invariants_of_four_coordinates, setUp=restart_random))
        call suite%addTest(TestMethod("two_modes_of_one_shape", two_modes_of_one_shape, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("zero_modes_stay_zero", zero_modes_stay_zero))
        call suite%addTest(TestMethod("a_mode_between_two_far_ones", a_mode_between_two_far_ones))
        call suite%addTest(TestMethod("what_is_no_g_is_refused", what_is_no_g_is_refused))
    end function gyroscopic_suite

    subroutine a_mode_between_two_far_ones()
        !! A charge in an isotropic trap, \(\omega = 1\) along a field of any direction; across it
        !! about \(b\) and \(1/b\). With more than 12 digits between them it is refused, not
        !! stated with digits that are not there.
        real(dp), parameter :: n(3) = [3.0_dp, 2.0_dp, 10.0_dp]/sqrt(113.0_dp)
        real(dp) :: b, one(3, 3), g(3, 3)
        complex(dp), allocatable :: lambda(:), modes(:, :)
        type(error_t), allocatable :: error
        integer :: i

        one = 0.0_dp
        do i = 1, 3
            one(i, i) = 1.0_dp
        end do
        do i = 0, 60
            b = 10.0_dp**i
            g = b*reshape([0.0_dp, n(3), -n(2), -n(3), 0.0_dp, n(1), n(2), -n(1), 0.0_dp], [3, 3])
            call gyroscopic_modes(one, g, one, lambda, modes, error)
            call assertTrue(allocated(error) .eqv. i > 12, "refused")
            if (allocated(error)) then
                call assertEqual("more digits apart than doubles can tell", &
                                 error%message(index(error%message, "more digits"):), "why")
            else
                call assertEqual(1.0_dp, aimag(lambda(2)), 1e-12_dp, "along the field")
                call assertEqual(1.0_dp, aimag(lambda(1))*aimag(lambda(3)), 1e-12_dp, "across it")
            end if
        end do
    end subroutine a_mode_between_two_far_ones

    subroutine solve(stiffness, g, inertia, lambda, modes)
        !! Of diagonal K and M, and a G of which the upper half is given.
        real(dp), intent(in) :: stiffness(:), g(:, :), inertia(:)
        complex(dp), allocatable, intent(out) :: lambda(:)
        complex(dp), allocatable, intent(out), optional :: modes(:, :)
        real(dp), dimension(size(g, 1), size(g, 1)) :: k, m, both
        complex(dp), allocatable :: u(:, :)
        type(error_t), allocatable :: error
        integer :: i

        k = 0.0_dp
        m = 0.0_dp
        both = 0.0_dp
        do i = 1, size(stiffness)
            k(i, i) = stiffness(i)
            m(i, i) = inertia(i)
            both(i, i + 1:) = g(i, i + 1:)
            both(i + 1:, i) = -g(i, i + 1:)
        end do
        call gyroscopic_modes(k, both, m, lambda, u, error)
        call assertFalse(allocated(error), "modes")
        do i = 1, size(u, 2)
            call assertTrue(any(abs(aimag(u(:, i))) <= 0.0_dp .and. &
                                real(u(:, i)) >= (1.0_dp - 2e-8_dp)*maxval(abs(u(:, i)))), &
                            "one of the largest is real and positive")
            call assertEqual(1.0_dp, sum(inertia*abs(u(:, i))**2), 1e-13_dp, "u^+ M u = 1")
        end do
        if (present(modes)) call move_alloc(u, modes)
    end subroutine solve

    subroutine slow_mode_of_a_strong_field()
        !! Beside a fast mode of 7.3e6 rad/s a slow one of \(\sqrt{k_1k_2}\) over that.
        complex(dp), allocatable :: lambda(:), u(:, :)
        real(dp) :: g(2, 2), slope

        g = 7.3e6_dp
        call solve([1.1e-4_dp, 1e7_dp], g, [1.0_dp, 1.0_dp], lambda, u)
        call assertEqual(4.54332120434113789e-6_dp, aimag(lambda(1)), 1e-20_dp, "slow")
        call assertEqual(7300000.6849314738_dp, aimag(lambda(2)), 1e-8_dp, "fast")
        call assertEqual([0.0_dp, 0.0_dp], real(lambda), 0.0_dp, "steady")
        slope = 4.54332120434113789e-6_dp*7.3e6_dp/(1e7_dp - 4.54332120434113789e-6_dp**2)
        call assertEqual([0.0_dp, slope], [real(u(2, 1)/u(1, 1)), aimag(u(2, 1)/u(1, 1))], &
                         1e-14_dp*slope, "the slow mode's shape")
    end subroutine slow_mode_of_a_strong_field

    subroutine two_coordinates_have_a_closed_form()
        !! \((k_1/m_1 + \lambda^2)(k_2/m_2 + \lambda^2) + \lambda^2g^2/(m_1m_2) = 0\) in
        !! quadruple precision, over 16 decades, stable or not.
        integer, parameter :: trials = 3000
        complex(dp), allocatable :: lambda(:)
        real(quad) :: k1, k2, g2, p, root, large, small, discriminant
        real(dp) :: k(2), g(2, 2), m(2), worst
        integer :: i, quartets

        worst = 0.0_dp
        quartets = 0
        do i = 1, trials
            k = [10.0_dp**uniform(-8.0_dp, 8.0_dp), 10.0_dp**uniform(-8.0_dp, 8.0_dp)]
            m = [10.0_dp**uniform(-3.0_dp, 3.0_dp), 10.0_dp**uniform(-3.0_dp, 3.0_dp)]
            g = 10.0_dp**uniform(-8.0_dp, 8.0_dp)
            if (modulo(i, 3) == 0) k(1) = -k(1)
            if (modulo(i, 5) == 0) k(2) = -k(2)
            if (modulo(i, 15) == 0) then  ! near the field that holds two hills
                k(2) = k(1)*m(2)/m(1)*uniform(0.5_dp, 2.0_dp)
                g = sqrt(-k(1)*m(2))*uniform(0.0_dp, 3.0_dp)
            end if
            call solve(k, g, m, lambda)
            k1 = k(1)/real(m(1), quad)
            k2 = k(2)/real(m(2), quad)
            g2 = real(g(1, 2), quad)**2/m(1)/m(2)
            p = k1*k2
            discriminant = (k1 - k2)**2 + g2*(2.0_quad*(k1 + k2) + g2)
            if (discriminant < 0.0_quad) then  ! a quartet that spirals: |lambda|^4 = p
                quartets = quartets + 1
                worst = max(worst, real(maxval(abs(abs(lambda)**2/sqrt(p) - 1.0_quad)), dp))
                cycle
            end if
            root = 0.5_quad*(k1 + k2 + g2 + sign(sqrt(discriminant), k1 + k2 + g2))
            large = max(root, p/root)
            small = min(root, p/root)
            worst = max(worst, real(abs(-real(lambda(1)**2)/small - 1.0_quad), dp), &
                        real(abs(-real(lambda(2)**2)/large - 1.0_quad), dp))
        end do
        call assertLessThan(worst, 1e-13_dp, message="omega^2")
        call assertEqual(128, quartets, "of them spiral")
    end subroutine two_coordinates_have_a_closed_form

    subroutine invariants_of_four_coordinates()
        !! \(\prod\omega_j^2 = \det K\) and \(\sum\omega_j^2 = \mathrm{tr}\,K + \tfrac12\sum
        !! G_{ij}^2\) for M = 1. The first knows all digits of the slow modes: between fast and
        !! slow each keeps \(\epsilon\) times the ratio to its outermost, here at most 1e6.
        integer, parameter :: trials = 500
        complex(dp), allocatable :: lambda(:)
        real(quad) :: product_of_them, sum_of_them
        real(dp) :: k(4), g(4, 4), worst
        integer :: trial, i, j

        worst = 0.0_dp
        do trial = 1, trials
            do j = 1, 4
                k(j) = 10.0_dp**uniform(-6.0_dp, 6.0_dp)
                do i = 1, 4
                    g(i, j) = sign(10.0_dp**uniform(-6.0_dp, 6.0_dp), uniform(-1.0_dp, 1.0_dp))
                end do
            end do
            call solve(k, g, spread(1.0_dp, 1, 4), lambda)
            product_of_them = 1.0_quad
            sum_of_them = sum(real(k, quad))
            do j = 1, 4
                product_of_them = product_of_them*abs(real(lambda(j)**2, quad))/k(j)
                sum_of_them = sum_of_them + sum(real(g(:j - 1, j), quad)**2)
            end do
            worst = max(worst, real(abs(product_of_them - 1.0_quad), dp), &
                        real(abs(sum(abs(real(lambda**2, quad)))/sum_of_them - 1.0_quad), dp))
        end do
        call assertLessThan(worst, 1e-10_dp, message="invariants")
    end subroutine invariants_of_four_coordinates

    subroutine two_modes_of_one_shape()
        !! A free particle in a rotating frame, beside an oscillator: \(\omega = W\) twice, though
        !! rounding splits them by its root; two oscillators that are truly as near stay apart.
        complex(dp), allocatable :: lambda(:)
        real(dp) :: g(3, 3), m, w, third
        integer :: i

        do i = 1, 200
            m = 10.0_dp**uniform(-2.0_dp, 2.0_dp)
            w = 10.0_dp**uniform(-2.0_dp, 2.0_dp)
            third = w*10.0_dp**uniform(-3.0_dp, 3.0_dp)
            g = 0.0_dp
            g(1, 2) = -2.0_dp*m*w
            call solve([-m*w**2, -m*w**2, third**2], g, [m, m, 1.0_dp], lambda)
            call assertEqual(2, count(abs(abs(lambda) - w) <= 1e-14_dp*max(w, third)), &
                             "the rotation, twice")
            call assertEqual(1, count(abs(abs(lambda) - third) <= 1e-14_dp*max(w, third)), &
                             "the oscillator")
        end do
        g = 0.0_dp
        call solve([4.0_dp, 1.0_dp, (1.0_dp + 2e-8_dp)*4.0_dp], g, spread(1.0_dp, 1, 3), lambda)
        call assertEqual(2.0_dp*sqrt(1.0_dp + 2e-8_dp), aimag(lambda(3)), 1e-15_dp, "the faster")
        call assertEqual(2.0_dp, aimag(lambda(2)), 1e-15_dp, "the slower")
    end subroutine two_modes_of_one_shape

    subroutine zero_modes_stay_zero()
        !! A free charge in a field along z circles, or stays where it is, or moves along z.
        complex(dp), allocatable :: lambda(:)
        real(dp) :: g(3, 3)

        g = 0.0_dp
        g(1, 2) = 2.0_dp
        call solve([0.0_dp, 0.0_dp, 0.0_dp], g, [1.0_dp, 1.0_dp, 1.0_dp], lambda)
        call assertEqual([0.0_dp, 0.0_dp, 2.0_dp], abs(lambda), 4.0_dp*epsilon(g), "free")
        call solve([0.0_dp, 4.0_dp, 1.0_dp], g, [1.0_dp, 1.0_dp, 1.0_dp], lambda)
        call assertEqual([0.0_dp, 1.0_dp, sqrt(8.0_dp)], abs(lambda), 8.0_dp*epsilon(g), "a trough")
    end subroutine zero_modes_stay_zero

    subroutine what_is_no_g_is_refused()
        !! Of another size, not finite, not antisymmetric; one that is to rounding is solved.
        real(dp), parameter :: one(2, 2) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], [2, 2])
        real(dp), parameter :: zero(3, 2) = 0.0_dp
        real(dp) :: g(2, 2)

        call refused(zero, "G is 3 by 2, K and M have 2 rows")
        g = reshape([0.0_dp, 1.0_dp, -1.0_dp, 0.0_dp], [2, 2])
        call refused(g, "")
        g(1, 2) = -1.0_dp - 4.0_dp*epsilon(g)
        call refused(g, "")
        g(1, 2) = -1.0_dp - 16.0_dp*epsilon(g)
        call refused(g, "G is not antisymmetric")
        g(1, 2) = 1.0_dp
        call refused(g, "G is not antisymmetric")
        g(1, 2) = ieee_value(1.0_dp, ieee_quiet_nan)
        call refused(g, "G is not finite")
    contains
        subroutine refused(matrix, expected)
            real(dp), intent(in) :: matrix(:, :)
            character(*), intent(in) :: expected
            complex(dp), allocatable :: lambda(:), modes(:, :)
            type(error_t), allocatable :: error

            call gyroscopic_modes(one, matrix, one, lambda, modes, error)
            call assertTrue(allocated(error) .neqv. expected == "", expected)
            if (allocated(error)) call assertEqual(expected, error%message)
        end subroutine refused
    end subroutine what_is_no_g_is_refused
end module test_gyroscopic
