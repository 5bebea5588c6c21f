module test_pendulum
    !! The pendulum and its closed form, against mpmath and against its own limits.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertRelativelyEqual, &
                     assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_reference, only: reference_t
    use lagrangia_text, only: to_text
    use motion, only: newton_lagrangian, point_accelerations
    use random_states, only: draw_parameters, draw_state, restart_random
    use reference_checks, only: check_reference, check_state
    implicit none (type, external)
    private
    public :: pendulum_suite

    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    function pendulum_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("pendulum")
        call suite%addTest(TestMethod("lagrangian_and_tension_of_a_bob", &
                                      lagrangian_and_tension_of_a_bob, setUp=restart_random))
        call suite%addTest(TestMethod("periods_from_rest", periods_from_rest))
        call suite%addTest(TestMethod("states_from_rest", states_from_rest))
        call suite%addTest(TestMethod("states_from_anywhere", states_from_anywhere, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("separatrix", separatrix, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("energies_close_to_the_separatrix", &
                                      energies_close_to_the_separatrix, setUp=restart_random))
        call suite%addTest(TestMethod("many_turns", many_turns))
        call suite%addTest(TestMethod("with_friction_only_rest_is_known", &
                                      with_friction_only_rest_is_known, setUp=restart_random))
        call suite%addTest(TestMethod("equilibrium_and_no_gravity", equilibrium_and_no_gravity, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("reference_solves_it", reference_solves_it, &
                                      setUp=restart_random))
    end function pendulum_suite

    subroutine start(g, l, theta, v, reference)
        !! The closed form from `(theta, v)` at t = 0. The mass does not matter.
        real(dp), intent(in) :: g, l, theta, v
        class(reference_t), allocatable, intent(out) :: reference
        type(pendulum_t) :: system
        type(error_t), allocatable :: error

        call system%configure([1.3_dp, l, g], error)
        call system%closed_form(0.0_dp, [theta], [v], reference)
        call assertTrue(allocated(reference), "found")
    end subroutine start

    subroutine lagrangian_and_tension_of_a_bob()
        !! L is T - V, and weight and tension move the bob.
        type(pendulum_t) :: system
        type(error_t), allocatable :: error
        type(hyperdual_t) :: l
        real(dp), allocatable :: q(:), v(:), r(:, :), a(:, :)
        real(dp) :: t, pull(3)
        integer :: i

        do i = 1, 20
            call draw_parameters(system, edges=.false.)
            call system%configure([system%m, system%l, system%g], error)  ! without friction
            call draw_state(system, t, q, v)
            l = system%lagrangian(hyperdual(t), hyperdual(q), hyperdual(v))
            call assertEqual(newton_lagrangian(system, t, q, v, system%g), l%re, 1e-12_dp*20.0_dp)
            call point_accelerations(system, t, q, v, r, a)
            pull = system%m*(a(:, 1) + [0.0_dp, system%g, 0.0_dp])
            call assertEqual(-r(:, 1)/system%l*system%quantity(2, t, q, v), pull, &
                             1e-12_dp*20.0_dp, "tension")
        end do
    end subroutine lagrangian_and_tension_of_a_bob

    subroutine periods_from_rest()
        !! g/l = 1: numbers of 22 digits.
        real(dp), parameter :: theta(5) = [0.5_dp, pi/2.0_dp, 2.0_dp, 3.0_dp, pi*179.0_dp/180.0_dp]
        real(dp), parameter :: period(5) = [ &
            6.3827896976777410464_dp, 7.4162987092054876737_dp, 8.3497529269184947344_dp, &
            16.155539372393374764_dp, 24.511115298106880441_dp]
        class(reference_t), allocatable :: reference
        integer :: i

        do i = 1, size(theta)
            call start(0.7_dp, 0.7_dp, theta(i), 0.0_dp, reference)
            call assertRelativelyEqual(period(i), reference%period, 3e-15_dp, "period")
            call assertRelativelyEqual(2.0_dp*pi, reference%small_period, 1e-15_dp, "small period")
        end do
    end subroutine periods_from_rest

    subroutine states_from_rest()
        !! g/l = 1, theta0 = 2.
        class(reference_t), allocatable :: reference
        real(dp) :: q(1), v(1)

        call start(0.7_dp, 0.7_dp, 2.0_dp, 0.0_dp, reference)
        call reference%state_at(1.0_dp, q, v)
        call assertEqual(1.532727506038253442_dp, q(1), 2e-15_dp, "t = 1")
        call reference%state_at(5.0_dp, q, v)
        call assertEqual(-1.6841244365668093504_dp, q(1), 4e-15_dp, "t = 5")
        call reference%state_at(10.0_dp, q, v)
        call assertEqual(0.71314818060137936921_dp, q(1), 1e-14_dp, "t = 10")
    end subroutine states_from_rest

    subroutine states_from_anywhere()
        !! l = 0.7: theta0, v0, t; theta, theta_dot, period with 20 digits by mpmath, from
        !! u0 = F(phi0, k), sn(u0 + omega t) and, in rotation, am; its Taylor integration of the
        !! equation of motion agrees to 24 digits.
        real(dp), parameter :: row(6, 8) = reshape([ &
            3.1_dp, 0.0_dp, 7.25_dp, &
            -1.5137451847257494699_dp, -5.4408203086826192064_dp, 5.6201023783043491434_dp, &
            0.0_dp, -5.5_dp, 3.5_dp, &
            1.6427361567385145267_dp, 0.45474904393450006066_dp, 2.0185972322801119093_dp, &
            -0.4_dp, 2.25_dp, -4.75_dp, &
            0.65892675795891580737_dp, 1.1862801147868061867_dp, 1.7372243310229587819_dp, &
            7.5_dp, -3.0_dp, 6.5_dp, &
            4.9563313977473995579_dp, -2.4604986054269964486_dp, 1.9696799223967841119_dp, &
            1.25_dp, 9.5_dp, 5.0_dp, &
            45.32169544369673352_dp, 9.3722993809857151956_dp, 0.71293232117233111821_dp, &
            -2.0_dp, -8.0_dp, -3.25_dp, &
            25.795676764680350462_dp, -9.8871539444896867645_dp, 0.74245587396307215304_dp, &
            1e-5_dp, 2e-5_dp, 9.0_dp, &
            -2.415531052005163159e-6_dp, -0.000041468761177366988219_dp, &
            1.6783958023259791067_dp, &
            3.140625_dp, 0.0_dp, 6.0_dp, &
            -3.1013341717459159302_dp, 0.15065655859207516202_dp, 9.6379534017219681549_dp], &
            [6, 8])
        class(reference_t), allocatable :: reference
        real(dp) :: size_of_state
        integer :: i

        do i = 1, size(row, 2)
            call start(9.81_dp, 0.7_dp, row(1, i), row(2, i), reference)
            size_of_state = max(abs(row(1, i)), abs(row(4, i)), abs(row(5, i)), abs(row(2, i)))
            call check_state(reference, row(3, i), row(4:4, i), row(5:5, i), &
                             2e-14_dp*size_of_state, "mpmath")
            call assertRelativelyEqual(row(6, i), reference%period, 2e-15_dp, "period")
        end do
    end subroutine states_from_anywhere

    subroutine separatrix()
        !! From the bottom with just the speed that reaches the top, in infinite time.
        class(reference_t), allocatable :: reference
        real(dp) :: t
        integer :: i

        call start(4.0_dp, 1.0_dp, 0.0_dp, 4.0_dp, reference)
        call assertEqual(0.0_dp, reference%period, message="no period")
        do i = -8, 8
            t = 0.37_dp*i
            call check_state(reference, t, [4.0_dp*atan(exp(2.0_dp*t)) - pi], &
                             [4.0_dp/cosh(2.0_dp*t)], 4e-15_dp, "separatrix")
        end do
        call check_state(reference, 1000.0_dp, [pi], [0.0_dp], 4e-15_dp, "at the top")
    end subroutine separatrix

    subroutine energies_close_to_the_separatrix()
        !! One bit above and below: the period is 4K, or 2K, with K = ln(4/k') to rounding.
        class(reference_t), allocatable :: reference
        real(dp), parameter :: bit = epsilon(1.0_dp)

        call start(1.0_dp, 1.0_dp, 0.0_dp, 2.0_dp*(1.0_dp - bit), reference)
        call assertRelativelyEqual(4.0_dp*log(4.0_dp/sqrt(2.0_dp*bit)), reference%period, 1e-14_dp)
        call check_state(reference, 5.0_dp, [4.0_dp*atan(exp(5.0_dp)) - pi], &
                         [2.0_dp/cosh(5.0_dp)], 1e-12_dp, "below")
        call start(1.0_dp, 1.0_dp, 0.0_dp, 2.0_dp*(1.0_dp + bit), reference)
        call assertRelativelyEqual(2.0_dp*log(4.0_dp/sqrt(2.0_dp*bit)), reference%period, 1e-14_dp)
        call check_state(reference, 5.0_dp, [4.0_dp*atan(exp(5.0_dp)) - pi], &
                         [2.0_dp/cosh(5.0_dp)], 1e-12_dp, "above")
    end subroutine energies_close_to_the_separatrix

    subroutine many_turns()
        !! Each period a turn more, forwards and backwards, from any angle; also where nearly the
        !! whole turn is made at once.
        class(reference_t), allocatable :: reference
        real(dp), parameter :: theta(4) = [-3.0_dp, 0.4_dp, 2.9_dp, 9.0_dp]
        real(dp), parameter :: speed(4) = [0.4_dp, -5.0_dp, 0.5_dp, -2.3_dp]
        real(dp) :: q(1), v(1), turn
        integer :: i, n

        do i = 1, 4
            call start(1.0_dp, 1.0_dp, theta(i), speed(i), reference)
            turn = sign(2.0_dp*pi, speed(i))
            do n = -30, 30
                call reference%state_at(n*reference%period, q, v)
                call assertEqual(theta(i) + n*turn, q(1), 1e-12_dp, "turns")
                call assertEqual(speed(i), v(1), 1e-12_dp, "speed")
                if (anyExceptions()) return
            end do
        end do
    end subroutine many_turns

    subroutine equilibrium_and_no_gravity()
        !! At the bottom it stays; without gravity it turns uniformly.
        class(reference_t), allocatable :: reference

        call start(9.81_dp, 0.7_dp, 0.0_dp, 0.0_dp, reference)
        call check_state(reference, 3.0_dp, [0.0_dp], [0.0_dp], 0.0_dp, "bottom")
        call assertEqual(0.0_dp, reference%period)
        call start(0.0_dp, 0.7_dp, 1.5_dp, -2.0_dp, reference)
        call check_state(reference, 3.0_dp, [-4.5_dp], [-2.0_dp], 0.0_dp, "no gravity")
        call assertRelativelyEqual(pi, reference%period, 1e-15_dp)
    end subroutine equilibrium_and_no_gravity

    subroutine with_friction_only_rest_is_known()
        !! At the bottom and at the top, without gravity anywhere; not elsewhere, nor in motion.
        type(pendulum_t) :: system
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        real(dp), parameter :: g(7) = [9.81_dp, 9.81_dp, 9.81_dp, 9.81_dp, 0.0_dp, 0.0_dp, 0.0_dp]
        real(dp), parameter :: q(7) = [0.0_dp, pi, 0.7_dp, 0.0_dp, 0.7_dp, 0.0_dp, 0.7_dp]
        real(dp), parameter :: v(7) = [0.0_dp, 0.0_dp, 0.0_dp, 0.5_dp, 0.0_dp, 0.0_dp, 0.5_dp]
        logical, parameter :: known(7) = [.true., .true., .false., .false., .true., .true., .false.]
        integer :: i

        do i = 1, size(g)
            call system%configure([0.5_dp, 0.8_dp, g(i), 0.1_dp], error)
            call system%closed_form(0.3_dp, q(i:i), v(i:i), reference)
            call assertEqual(known(i), allocated(reference), message="case "//to_text(i))
            if (.not. allocated(reference)) cycle
            call check_state(reference, 3.0_dp, q(i:i), [0.0_dp], 0.0_dp, "rest")
        end do
    end subroutine with_friction_only_rest_is_known

    subroutine reference_solves_it()
        !! From random states.
        type(pendulum_t) :: system
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t
        integer :: i

        do i = 1, 20
            call draw_parameters(system, edges=.false.)
            call system%configure([system%m, system%l, system%g], error)
            call draw_state(system, t, q, v)
            call system%closed_form(t, q, v, reference)
            call check_reference(reference, system, t, q, v, "pendulum")
            if (anyExceptions()) return
        end do
    end subroutine reference_solves_it
end module test_pendulum
