module test_gauge
    !! \(L + dF/dt\): F and its rate belong together, and the examples are what they say.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertGreaterThan, assertTrue
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_errors, only: error_t
    use lagrangia_gauged_system, only: chi_t, family_t, gauge_t, gauged_system_t, &
                                       landau_charge_t, member_names, pendulum_with_q, &
                                       pendulum_with_q_q_dot
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian, energy_from_lagrangian, &
                                  euler_lagrange_t, expand_lagrangian
    use lagrangia_pendulum, only: pendulum_t
    use random_states, only: restart_random, uniform
    implicit none (type, external)
    private
    public :: gauge_suite

    real(dp), parameter :: rounding = 1e-13_dp  !! of some dozen operations on numbers up to 30

contains

    function gauge_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("gauge")
        call suite%addTest(TestMethod("rates_are_derivatives", rates_are_derivatives, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("energy_shifts", energy_shifts))
        call suite%addTest(TestMethod("chi_leads_to_landau", chi_leads_to_landau))
        call suite%addTest(TestMethod("forbidden_terms_in_numbers", forbidden_terms_in_numbers))
    end function gauge_suite

    subroutine rates_are_derivatives()
        !! dF/dt written by hand against F itself along a straight motion, and its slope too.
        integer :: i

        do i = 1, size(member_names)
            call try(family_t(i))
        end do
        call try(chi_t(1.7_dp))
    contains
        subroutine try(gauge)
            class(gauge_t), intent(in) :: gauge
            type(hyperdual_t) :: f, rate, qq(3), vv(3), tt
            real(dp) :: t, q(3), v(3)
            integer :: k, j

            do k = 1, 10
                t = uniform(-1.0_dp, 2.0_dp)
                do j = 1, 3
                    q(j) = uniform(-2.0_dp, 2.0_dp)
                    v(j) = uniform(-2.0_dp, 2.0_dp)
                end do
                ! first direction: along the motion; second: q1
                tt = hyperdual_t(t, 1.0_dp, 0.0_dp, 0.0_dp)
                qq = hyperdual(q)
                qq%d1 = v
                qq(1)%d2 = 1.0_dp
                vv = hyperdual(v)
                f = gauge%value(tt, qq)
                rate = gauge%rate(tt, qq, vv)
                call assertEqual(f%d1, rate%re, rounding)
                call assertEqual(f%d12, rate%d2, rounding)
                vv = hyperdual(v + 0.3_dp)
                rate = gauge%rate(tt, qq, vv)
                call assertGreaterThan(abs(rate%re - f%d1), 1e-6_dp)
            end do
        end subroutine try
    end subroutine rates_are_derivatives

    subroutine energy_shifts()
        !! The energy function of the gauged system is that of its L.
        type(pendulum_t) :: pendulum
        type(gauged_system_t) :: gauged
        type(error_t), allocatable :: error
        real(dp), parameter :: q(1) = 0.9_dp, v(1) = -1.3_dp
        integer :: i

        call pendulum%configure([0.5_dp, 0.8_dp, 9.81_dp], error)
        call assertFalse(allocated(error), "no error: energy shifts")
        do i = 1, size(member_names)
            call gauged%set(pendulum, family_t(i))
            call gauged%configure([0.7_dp, 0.8_dp, 9.81_dp, 0.1_dp], error)
            call assertFalse(allocated(error), "the pendulum inside takes the parameters")
            call assertTrue(gauged%time_dependent, "the gauge still has the time in it")
            call assertTrue(gauged%nonconservative, "the pendulum has drag now")
            call gauged%configure([0.5_dp, 0.8_dp, 9.81_dp], error)
            call assertFalse(gauged%nonconservative, "and none again")
            call assertEqual(energy_from_lagrangian(gauged, 0.7_dp, q, v), &
                             gauged%energy(0.7_dp, q, v), rounding)
        end do
        call assertGreaterThan(abs(gauged%energy(0.7_dp, q, v) - pendulum%energy(0.7_dp, q, v)), &
                               0.1_dp)
    end subroutine energy_shifts

    subroutine chi_leads_to_landau()
        !! L in the symmetric gauge, with chi on top, is L in Landau's, E and a trap included.
        type(charged_particle_t) :: charge
        type(landau_charge_t) :: landau
        type(gauged_system_t) :: gauged
        type(error_t), allocatable :: error
        type(hyperdual_t) :: one, other, q(3), v(3), t
        type(euler_lagrange_t) :: terms
        real(dp) :: place(3), speed(3), p(3), back(3)
        real(dp), parameter :: values(9) = [1.3_dp, -0.7_dp, 0.3_dp, 0.4_dp, -0.2_dp, 0.0_dp, &
                                            0.0_dp, 1.9_dp, 0.6_dp]

        call charge%configure(values, error)
        call assertFalse(allocated(error), "no error: chi leads to landau")
        call landau%configure(values, error)
        call assertFalse(allocated(error), "no error: chi leads to landau")
        call gauged%set(charge, chi_t(values(2)*values(8)))
        t = hyperdual(0.4_dp)
        q = hyperdual([0.4_dp, 0.9_dp, -0.2_dp])
        v = hyperdual([0.6_dp, -1.3_dp, 0.5_dp])
        one = gauged%lagrangian(t, q, v)
        other = landau%lagrangian(t, q, v)
        call assertEqual(other%re, one%re, rounding)
        place = q%re
        speed = v%re
        call expand_lagrangian(landau, 0.4_dp, place, speed, terms)
        call landau%momenta(0.4_dp, place, speed, p)
        call assertEqual(terms%dl_dv, p, rounding, "momenta of Landau's")
        call assertEqual([0.78_dp, -1.69_dp - 0.7_dp*1.9_dp*0.4_dp, 0.65_dp], p, rounding, &
                         "by hand")
        call landau%velocities(0.4_dp, place, p, back)
        call assertEqual(speed, back, rounding, "and back")
    end subroutine chi_leads_to_landau

    subroutine forbidden_terms_in_numbers()
        !! \(L + cq\) adds the torque c; \(L + dF/dt\) with \(F = m\ell^2q\dot q\) has the equation
        !! \(3\ddot q = -(g/\ell)(2\sin q + q\cos q)\).
        type(pendulum_with_q) :: with_q
        type(pendulum_with_q_q_dot) :: with_q_q_dot
        type(error_t), allocatable :: error
        real(dp), parameter :: q(1) = 0.9_dp, v(1) = -1.3_dp
        real(dp) :: a(1), none(0)

        call with_q%configure([0.5_dp, 0.8_dp, 9.81_dp], error)
        call assertFalse(allocated(error), "no error: forbidden terms in numbers")
        call accelerations_from_lagrangian(with_q, 0.0_dp, q, v, a, none, error)
        call assertEqual(-9.81_dp/0.8_dp*sin(0.9_dp) + 1.0_dp/0.32_dp, a(1), rounding)
        call with_q_q_dot%configure([0.5_dp, 0.8_dp, 9.81_dp], error)
        call assertFalse(allocated(error), "no error: forbidden terms in numbers")
        call accelerations_from_lagrangian(with_q_q_dot, 0.0_dp, q, v, a, none, error)
        call assertEqual(-9.81_dp/0.8_dp*(2.0_dp*sin(0.9_dp) + 0.9_dp*cos(0.9_dp))/3.0_dp, a(1), &
                         rounding)
    end subroutine forbidden_terms_in_numbers
end module test_gauge
