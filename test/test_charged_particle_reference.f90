module test_charged_particle_reference
    !! The closed form of the charged particle: any fields, trap or none.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertLessThanOrEqual, assertTrue
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    use random_states, only: draw_parameters, draw_state, restart_random, uniform
    use reference_checks, only: check_reference, check_state
    use rk4_checks, only: check_against_rk4
    implicit none (type, external)
    private
    public :: charged_particle_reference_suite

    real(dp), parameter :: pi = acos(-1.0_dp)
    real(dp), parameter :: nil(3) = 0.0_dp

contains

    function charged_particle_reference_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("charged_particle_reference")
        call suite%addTest(TestMethod("reference_gives_the_e_cross_b_trochoid", &
                                      reference_gives_the_e_cross_b_trochoid))
        call suite%addTest(TestMethod("reference_is_the_textbook_form", &
                                      reference_is_the_textbook_form, setUp=restart_random))
        call suite%addTest(TestMethod("reference_obeys_the_equations", &
                                      reference_obeys_the_equations, setUp=restart_random))
        call suite%addTest(TestMethod("reference_turns_with_the_fields", &
                                      reference_turns_with_the_fields, setUp=restart_random))
        call suite%addTest(TestMethod("drift_is_e_cross_b", drift_is_e_cross_b))
        call suite%addTest(TestMethod("trap_splits_the_frequency", trap_splits_the_frequency, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("period_closes_the_orbit", period_closes_the_orbit, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("weak_fields_lose_no_digits", weak_fields_lose_no_digits))
        call suite%addTest(TestMethod("many_turns_lose_no_digits", many_turns_lose_no_digits, &
                                      setUp=restart_random))
    end function charged_particle_reference_suite

    subroutine build(particle, m, charge, electric, magnetic, trap)
        !! A particle of these parameters.
        type(charged_particle_t), intent(out) :: particle
        real(dp), intent(in) :: m, charge, electric(3), magnetic(3), trap
        type(error_t), allocatable :: error

        call particle%configure([m, charge, electric, magnetic, trap], error)
        call assertFalse(allocated(error), "parameters of the particle")
    end subroutine build

    subroutine reference_gives_the_e_cross_b_trochoid()
        !! Oracle of 22-digit arithmetic: m = e = B = 1, E = (.2, .1), v0 = (1, 0).
        type(charged_particle_t) :: particle
        class(reference_t), allocatable :: reference
        real(dp) :: q(3), v(3)

        call build(particle, 1.0_dp, 1.0_dp, [0.2_dp, 0.1_dp, 0.0_dp], [0.0_dp, 0.0_dp, 1.0_dp], &
                   0.0_dp)
        call particle%closed_form(3.0_dp, nil, [1.0_dp, 0.0_dp, 0.0_dp], reference)
        call assertTrue(allocated(reference), "found")
        call reference%state_at(4.0_dp, q, v)
        call assertEqual([0.949263425153478913_dp, -0.445433727757094953_dp, 0.0_dp], q, 1e-15_dp)
        call reference%state_at(13.0_dp, q, v)
        call assertEqual([0.878195306014857658_dp, -3.76396859834668117_dp, 0.0_dp], q, 8e-15_dp)
    end subroutine reference_gives_the_e_cross_b_trochoid

    subroutine reference_is_the_textbook_form()
        !! B along z, charge of either sign: drift, trochoid, and free fall along B.
        type(charged_particle_t) :: particle
        class(reference_t), allocatable :: reference
        real(dp) :: m, charge, e(3), b, r0(3), v0(3), t, wc, c(2), drift(2), q(3), v(3)
        integer :: i

        do i = 1, 40
            m = uniform(0.5_dp, 3.0_dp)
            charge = sign(uniform(0.5_dp, 3.0_dp), uniform(-1.0_dp, 1.0_dp))
            b = sign(uniform(0.5_dp, 3.0_dp), uniform(-1.0_dp, 1.0_dp))
            e = [uniform(-2.0_dp, 2.0_dp), uniform(-2.0_dp, 2.0_dp), uniform(-2.0_dp, 2.0_dp)]
            r0 = [uniform(-2.0_dp, 2.0_dp), uniform(-2.0_dp, 2.0_dp), uniform(-2.0_dp, 2.0_dp)]
            v0 = [uniform(-2.0_dp, 2.0_dp), uniform(-2.0_dp, 2.0_dp), uniform(-2.0_dp, 2.0_dp)]
            t = uniform(-4.0_dp, 4.0_dp)
            call build(particle, m, charge, e, [0.0_dp, 0.0_dp, b], 0.0_dp)
            call particle%closed_form(0.0_dp, r0, v0, reference)
            call reference%state_at(t, q, v)
            wc = charge*b/m
            drift = [e(2)/b, -e(1)/b]
            c = v0(1:2) - drift
            call assertEqual(r0(1) + drift(1)*t + (c(1)*sin(wc*t) + c(2)*(1 - cos(wc*t)))/wc, &
                             q(1), 1e-12_dp, "x")
            call assertEqual(r0(2) + drift(2)*t + (c(2)*sin(wc*t) - c(1)*(1 - cos(wc*t)))/wc, &
                             q(2), 1e-12_dp, "y")
            call assertEqual(r0(3) + v0(3)*t + charge*e(3)/(2*m)*t**2, q(3), 1e-12_dp, "z")
        end do
    end subroutine reference_is_the_textbook_form

    subroutine reference_obeys_the_equations()
        !! Fields of any direction, or none, with a trap and without.
        type(charged_particle_t) :: particle
        class(reference_t), allocatable :: reference
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t
        integer :: i

        do i = 1, 60
            call draw_parameters(particle, edges=mod(i, 2) == 0)
            call draw_state(particle, t, q, v)
            call particle%closed_form(t, q, v, reference)
            call assertTrue(allocated(reference), "found")
            call check_reference(reference, particle, t, q, v, "charge")
            if (anyExceptions()) return
        end do
    end subroutine reference_obeys_the_equations

    subroutine reference_turns_with_the_fields()
        !! Fields, start and state may be turned together: any direction is as good as z.
        type(charged_particle_t) :: particle, turned
        class(reference_t), allocatable :: reference, turned_reference
        real(dp), allocatable :: q0(:), v0(:)
        real(dp) :: rotation(3, 3), q(3), v(3), t0
        integer :: i

        do i = 1, 30
            call build(particle, 1.3_dp, uniform(-2.0_dp, 2.0_dp), &
                       [uniform(-1.0_dp, 1.0_dp), uniform(-1.0_dp, 1.0_dp), 0.3_dp], &
                       [0.0_dp, 0.0_dp, uniform(-3.0_dp, 3.0_dp)], 0.7_dp*mod(i, 2))
            call draw_state(particle, t0, q0, v0)
            call particle%closed_form(t0, q0, v0, reference)
            call draw_rotation(rotation)
            call build(turned, 1.3_dp, particle%charge, matmul(rotation, particle%electric), &
                       matmul(rotation, particle%magnetic), particle%trap)
            call turned%closed_form(t0, matmul(rotation, q0), &
                                    matmul(rotation, v0), turned_reference)
            call reference%state_at(t0 + 5.0_dp, q, v)
            call check_state(turned_reference, t0 + 5.0_dp, matmul(rotation, q), &
                             matmul(rotation, v), 1e-13_dp, "turned")
        end do
    end subroutine reference_turns_with_the_fields

    subroutine draw_rotation(rotation)
        !! A rotation by the quaternion of four random numbers.
        real(dp), intent(out) :: rotation(3, 3)
        real(dp) :: p(0:3)

        p = [uniform(0.1_dp, 1.0_dp), uniform(-1.0_dp, 1.0_dp), uniform(-1.0_dp, 1.0_dp), &
             uniform(-1.0_dp, 1.0_dp)]
        p = p/norm2(p)
        rotation(:, 1) = [1 - 2*(p(2)**2 + p(3)**2), 2*(p(1)*p(2) + p(0)*p(3)), &
                          2*(p(1)*p(3) - p(0)*p(2))]
        rotation(:, 2) = [2*(p(1)*p(2) - p(0)*p(3)), 1 - 2*(p(1)**2 + p(3)**2), &
                          2*(p(2)*p(3) + p(0)*p(1))]
        rotation(:, 3) = [2*(p(1)*p(3) + p(0)*p(2)), 2*(p(2)*p(3) - p(0)*p(1)), &
                          1 - 2*(p(1)**2 + p(2)**2)]
    end subroutine draw_rotation

    subroutine drift_is_e_cross_b()
        !! After whole turns: (E x B)/B^2 across B, which charge and mass do not enter.
        type(charged_particle_t) :: particle
        class(reference_t), allocatable :: reference
        real(dp), parameter :: e(3) = [0.3_dp, -0.2_dp, 0.5_dp], b(3) = [1.0_dp, 2.0_dp, 2.0_dp]
        real(dp), parameter :: e_cross_b(3) = [-1.4_dp, -0.1_dp, 0.8_dp]
        real(dp) :: t, q(3), v(3)
        integer :: i

        do i = -1, 1, 2
            call build(particle, 0.7_dp, 0.3_dp*i, e, b, 0.0_dp)
            call particle%closed_form(0.0_dp, nil, [1.0_dp, -0.5_dp, 0.0_dp], reference)
            t = 8.0_dp*pi*0.7_dp/(0.3_dp*3.0_dp)
            call reference%state_at(t, q, v)
            associate (across => q - dot_product(q, b)*b/9.0_dp)
                call assertEqual(e_cross_b/9.0_dp*t, across, 1e-13_dp)
            end associate
        end do
    end subroutine drift_is_e_cross_b

    subroutine trap_splits_the_frequency()
        !! k = m = 1, omega_c = 0.5: circles at 1.2807..., with the turn of the charge, and at
        !! 0.7807..., against it (22-digit arithmetic).
        type(charged_particle_t) :: particle
        class(reference_t), allocatable :: reference
        real(dp), parameter :: rate(2) = [-1.28077640640441514_dp, 0.780776406404415137_dp]
        real(dp) :: t
        integer :: i, k

        call build(particle, 1.0_dp, 1.0_dp, nil, [0.0_dp, 0.0_dp, 0.5_dp], 1.0_dp)
        do i = 1, 2
            call particle%closed_form(0.0_dp, [1.0_dp, 0.0_dp, 0.0_dp], &
                                      [0.0_dp, rate(i), 0.0_dp], reference)
            do k = 1, 10
                t = 0.9_dp*k
                call check_state(reference, t, [cos(rate(i)*t), sin(rate(i)*t), 0.0_dp], &
                                 rate(i)*[-sin(rate(i)*t), cos(rate(i)*t), 0.0_dp], 1e-14_dp, &
                                 "circle")
            end do
        end do
    end subroutine trap_splits_the_frequency

    subroutine period_closes_the_orbit()
        !! Cyclotron 2 pi m/(|e| B), trap 2 pi sqrt(m/k); none with drift or fall, nor in a trap
        !! with B, whose frequencies are incommensurate in general.
        type(charged_particle_t) :: particle
        class(reference_t), allocatable :: reference
        real(dp), parameter :: b(3) = [0.0_dp, 0.0_dp, 2.0_dp], v0(3) = [1.0_dp, 0.5_dp, 0.0_dp]

        call build(particle, 0.7_dp, -0.3_dp, nil, b, 0.0_dp)
        call particle%closed_form(0.0_dp, nil, v0, reference)
        call assertEqual(2.0_dp*pi*0.7_dp/0.6_dp, reference%period, 4e-15_dp)
        call check_state(reference, reference%period, nil, v0, 1e-14_dp, "cyclotron")
        call particle%closed_form(0.0_dp, nil, v0 + b, reference)
        call assertEqual(0.0_dp, reference%period)
        call build(particle, 0.7_dp, -0.3_dp, v0, b, 0.0_dp)
        call particle%closed_form(0.0_dp, nil, v0, reference)
        call assertEqual(0.0_dp, reference%period)
        call build(particle, 0.7_dp, -0.3_dp, v0, nil, 2.8_dp)
        call particle%closed_form(0.0_dp, b, v0, reference)
        call assertEqual(pi, reference%period, 1e-15_dp)
        call check_state(reference, reference%period, b, v0, 1e-14_dp, "trap")
        call build(particle, 0.7_dp, -0.3_dp, v0, b, 2.8_dp)
        call particle%closed_form(0.0_dp, b, v0, reference)
        call assertEqual(0.0_dp, reference%period)
    end subroutine period_closes_the_orbit

    subroutine weak_fields_lose_no_digits()
        !! B, the trap, or both from 1 down to 1e-300, against rk4 and against none of them: the
        !! state's derivative with respect to them is below 100 here.
        type(charged_particle_t) :: particle
        class(reference_t), allocatable :: reference
        real(dp), parameter :: b(3) = [0.2_dp, -1.0_dp, 0.5_dp], e(3) = [0.3_dp, 0.2_dp, -0.5_dp]
        real(dp), parameter :: r0(3) = [1.0_dp, 2.0_dp, -0.5_dp], v0(3) = [0.4_dp, 0.3_dp, -1.1_dp]
        real(dp) :: weak, q(3), v(3), plain(3), t
        integer :: k, which

        t = 3.0_dp
        call build(particle, 1.3_dp, -0.7_dp, e, nil, 0.0_dp)
        call particle%closed_form(0.0_dp, r0, v0, reference)
        call reference%state_at(t, plain, v)
        call assertEqual(r0 + v0*t - 0.7_dp/1.3_dp*e*t**2/2, plain, 1e-14_dp, "no fields")
        do which = 1, 3
            do k = 0, 13
                weak = 10.0_dp**(-k)
                if (k == 13) weak = 1e-300_dp
                call build(particle, 1.3_dp, -0.7_dp, e, &
                           merge(weak*b, nil, spread(mod(which, 2) == 1, 1, 3)), &
                           merge(weak, 0.0_dp, which >= 2))
                call particle%closed_form(0.0_dp, r0, v0, reference)
                call check_against_rk4(reference, particle, r0, v0, t, "weak fields")
                call reference%state_at(t, q, v)
                call assertLessThanOrEqual(maxval(abs(q - plain)), 100.0_dp*weak + 1e-14_dp, &
                                           message="weak fields")
            end do
        end do
    end subroutine weak_fields_lose_no_digits

    subroutine many_turns_lose_no_digits()
        !! After 1000 turns the errors are those of the angle, 6000 epsilon; also of the slow
        !! circle in a weak trap, although 160 million cyclotron turns go by meanwhile.
        type(charged_particle_t) :: particle
        class(reference_t), allocatable :: reference
        real(dp), parameter :: r0(3) = [1.0_dp, 2.0_dp, -0.5_dp], v0(3) = [0.4_dp, 0.3_dp, -1.1_dp]
        real(dp) :: slow

        call build(particle, 1.0_dp, 1.0_dp, [0.2_dp, 0.1_dp, 0.0_dp], [0.0_dp, 0.0_dp, 1.0_dp], &
                   0.0_dp)
        call particle%closed_form(0.0_dp, r0, v0, reference)
        associate (t => 2000.0_dp*pi)
            call check_state(reference, t, r0 + [0.1_dp, -0.2_dp, -1.1_dp]*t, v0, 4e-12_dp, "turns")
        end associate
        call build(particle, 1.0_dp, 1.0_dp, nil, [0.0_dp, 0.0_dp, 1.0_dp], 1e-6_dp)
        slow = 2e-6_dp/(1.0_dp + sqrt(1.0_dp + 4e-6_dp))
        call particle%closed_form(0.0_dp, [1.0_dp, 0.0_dp, 0.0_dp], &
                                  [0.0_dp, slow, 0.0_dp], reference)
        associate (angle => slow*1e9_dp)
            call check_state(reference, 1e9_dp, [cos(angle), sin(angle), 0.0_dp], &
                             slow*[-sin(angle), cos(angle), 0.0_dp], 2e-12_dp, "slow circle")
        end associate
    end subroutine many_turns_lose_no_digits
end module test_charged_particle_reference
