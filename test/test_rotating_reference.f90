module test_rotating_reference
    !! Closed forms of the rotating wire and hoop.
    use, intrinsic :: iso_fortran_env, only: real128
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertLessThanOrEqual, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    use lagrangia_rotating_hoop, only: rotating_hoop_t
    use lagrangia_rotating_wire, only: rotating_wire_t
    use lagrangia_system, only: system_t
    use random_states, only: draw_parameters, draw_state, restart_random
    use reference_checks, only: check_reference, check_state
    use rk4_checks, only: check_against_rk4
    implicit none (type, external)
    private
    public :: rotating_reference_suite

    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    function rotating_reference_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("rotating_reference")
        call suite%addTest(TestMethod("wire_reference_gives_the_oracle", &
                                      wire_reference_gives_the_oracle))
        call suite%addTest(TestMethod("wire_reference_obeys_the_equations", &
                                      wire_reference_obeys_the_equations, setUp=restart_random))
        call suite%addTest(TestMethod("wire_reference_keeps_its_digits", &
                                      wire_reference_keeps_its_digits))
        call suite%addTest(TestMethod("hoop_has_tilted_equilibria", hoop_has_tilted_equilibria))
        call suite%addTest(TestMethod("hoop_stands_in_equilibria_only", &
                                      hoop_stands_in_equilibria_only, setUp=restart_random))
    end function rotating_reference_suite

    subroutine set(system, values)
        !! Configure.
        class(system_t), intent(inout) :: system
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable :: error

        call system%configure(values, error)
        call assertFalse(allocated(error), "parameters")
    end subroutine set

    subroutine wire_reference_gives_the_oracle()
        !! 22-digit arithmetic: r0 = 0.5, omega = 1.5, t = 2. The sense of turning is no matter.
        type(rotating_wire_t) :: wire
        class(reference_t), allocatable :: reference
        real(dp) :: q(1), v(1)
        integer :: i

        do i = -1, 1, 2
            call set(wire, [1.3_dp, 1.5_dp*i])
            call wire%closed_form(7.0_dp, [0.5_dp], [0.0_dp], reference)
            call assertTrue(allocated(reference), "found")
            call reference%state_at(9.0_dp, q, v)
            call assertEqual(5.03383099788888292_dp, q(1), 4e-15_dp)
        end do
    end subroutine wire_reference_gives_the_oracle

    subroutine wire_reference_obeys_the_equations()
        !! At any rate of turning.
        type(rotating_wire_t) :: wire
        class(reference_t), allocatable :: reference
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t
        integer :: i

        do i = 1, 20
            call draw_parameters(wire, edges=mod(i, 2) == 0)
            call draw_state(wire, t, q, v)
            call wire%closed_form(t, q, v, reference)
            call check_reference(reference, wire, t, q, v, "wire")
            if (anyExceptions()) return
        end do
    end subroutine wire_reference_obeys_the_equations

    subroutine wire_reference_keeps_its_digits()
        !! Slow turning goes over into uniform motion. A bead that creeps towards the axis,
        !! r0 exp(-omega t), does so to the last digit, forwards and, flying away, backwards.
        type(rotating_wire_t) :: wire
        class(reference_t), allocatable :: reference
        real(dp) :: q(1), v(1), omega
        integer :: k

        do k = 1, 14
            omega = merge(0.0_dp, 10.0_dp**(-k), k == 14)
            call set(wire, [1.3_dp, omega])
            call wire%closed_form(0.0_dp, [0.4_dp], [0.7_dp], reference)
            call check_against_rk4(reference, wire, [0.4_dp], [0.7_dp], 2.0_dp, "slow")
            call reference%state_at(2.0_dp, q, v)
            call assertLessThanOrEqual(abs(q(1) - 1.8_dp), 4.0_dp*omega**2 + 4e-16_dp, &
                                       message="slow")
        end do
        call set(wire, [1.3_dp, 1.5_dp])
        do k = -1, 1, 2
            call wire%closed_form(0.0_dp, [0.5_dp], [-0.75_dp*k], reference)
            call reference%state_at(k*20.0_dp, q, v)
            associate (exact => 0.5_dp*exp(-30.0_dp))
                call assertEqual(exact, q(1), 1e-15_dp*exact, "creeping")
                call assertEqual(-1.5_dp*k*exact, v(1), 2e-15_dp*exact, "creeping")
            end associate
        end do
    end subroutine wire_reference_keeps_its_digits

    function stiffness(system, theta) result(omega2)
        !! -d theta_ddot/d theta, by central differences of order 4: good to 1e-10.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: theta
        real(dp) :: omega2
        real(dp), parameter :: h = 1e-3_dp
        real(dp) :: a(1, 4)
        real(dp), parameter :: place(4) = [-2.0_dp, -1.0_dp, 1.0_dp, 2.0_dp]
        integer :: k

        do k = 1, 4
            call system%accelerations(0.0_dp, [theta + place(k)*h], [0.0_dp], a(:, k))
        end do
        omega2 = -(a(1, 1) - 8.0_dp*a(1, 2) + 8.0_dp*a(1, 3) - a(1, 4))/(12.0_dp*h)
    end function stiffness

    subroutine hoop_has_tilted_equilibria()
        !! omega = 5, R = 1: theta = 1.1675..., Omega^2 = 21.150556 (22-digit arithmetic); with
        !! R = 0.8 the formulas omega^2 - g^2/(omega R)^2, g/R - omega^2.
        type(rotating_hoop_t) :: hoop
        real(dp), parameter :: tilt = 1.16755690380504296_dp
        real(dp) :: a(1)

        call set(hoop, [1.3_dp, 1.0_dp, 5.0_dp, 9.81_dp])
        call hoop%accelerations(0.0_dp, [tilt], [0.0_dp], a)
        call assertEqual(0.0_dp, a(1), 1e-14_dp)
        call assertEqual(21.150556_dp, stiffness(hoop, tilt), 1e-9_dp, "tilted")
        call set(hoop, [1.3_dp, 0.8_dp, 5.0_dp, 9.81_dp])
        call assertEqual(25.0_dp - (9.81_dp/4.0_dp)**2, &
                         stiffness(hoop, acos(9.81_dp/(25.0_dp*0.8_dp))), 1e-9_dp, "tilted")
        call assertEqual(9.81_dp/0.8_dp - 25.0_dp, stiffness(hoop, 0.0_dp), 1e-9_dp, "bottom")
        call assertEqual(-9.81_dp/0.8_dp - 25.0_dp, stiffness(hoop, pi), 1e-9_dp, "top")
    end subroutine hoop_has_tilted_equilibria

    subroutine hoop_stands_in_equilibria_only()
        !! Bottom, top, both tilts, on any turn; nowhere else, and not in motion.
        type(rotating_hoop_t) :: hoop
        real(dp) :: tilt
        integer :: i

        call set(hoop, [1.3_dp, 0.8_dp, 5.0_dp, 9.81_dp])
        tilt = acos(9.81_dp/20.0_dp)
        call stands([0.0_dp, pi, -pi, 2.0_dp*pi, tilt, -tilt, 2.0_dp*pi - tilt, tilt - 4.0_dp*pi], &
                    .true.)
        call stands([0.1_dp, 1e-9_dp, tilt + 1e-9_dp, pi - tilt, 0.5_dp*pi], .false.)
        call set(hoop, [1.3_dp, 0.8_dp, 3.0_dp, 9.81_dp])
        call stands([0.0_dp, pi], .true.)
        call stands([acos(3.0_dp**2*0.8_dp/9.81_dp), tilt], .false.)
        ! omega^2 R little more than g, against quadruple precision
        do i = 10, 40, 6
            call set(hoop, [1.3_dp, 0.7_dp, 3.1_dp, 3.1_dp**2*0.7_dp*(1.0_dp - 2.0_dp**(-i))])
            tilt = real(acos(real(hoop%g, real128)/real(3.1_dp**2*0.7_dp, real128)), dp)
            call stands([tilt, -tilt], .true.)
            call stands([tilt + 1e-14_dp], .false.)
        end do
        call set(hoop, [1.3_dp, 0.8_dp, 0.0_dp, 0.0_dp])
        call stands([0.3_dp], .true.)
    contains
        subroutine stands(angles, expected)
            real(dp), intent(in) :: angles(:)
            logical, intent(in) :: expected
            class(reference_t), allocatable :: reference
            integer :: i

            do i = 1, size(angles)
                call hoop%closed_form(1.0_dp, angles(i:i), [0.0_dp], reference)
                call assertTrue(allocated(reference) .eqv. expected, "equilibrium?")
                if (.not. allocated(reference)) cycle
                call check_state(reference, 9.0_dp, angles(i:i), [0.0_dp], 0.0_dp, "stands")
                call check_reference(reference, hoop, 1.0_dp, angles(i:i), [0.0_dp], "stands")
                call hoop%closed_form(1.0_dp, angles(i:i), [1e-9_dp], reference)
                call assertFalse(allocated(reference), "it moves")
            end do
        end subroutine stands
    end subroutine hoop_stands_in_equilibria_only
end module test_rotating_reference
