module test_rheonomic
    !! Moving constraints: bead on a rotating wire, on a rotating hoop, pendulum on a shaken pivot.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertLessThan, assertLessThanOrEqual, assertTrue
    use lagrangia_description, only: description_t
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_driven_pendulum_reference, only: driven_pendulum_reference_t, &
                                                   new_driven_pendulum_reference
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_rk4, only: new_rk4, rk4_t
    use lagrangia_rotating_hoop, only: rotating_hoop_t
    use lagrangia_rotating_hoop_reference, only: new_rotating_hoop_reference, &
                                                 rotating_hoop_reference_t
    use lagrangia_rotating_wire, only: rotating_wire_t
    use lagrangia_rotating_wire_reference, only: new_rotating_wire_reference, &
                                                 rotating_wire_reference_t
    use lagrangia_system, only: system_t
    use motion, only: flow_derivative, point_accelerations
    use random_states, only: draw_parameters, draw_state, restart_random, uniform
    use reference_checks, only: check_reference, check_state
    use rk4_checks, only: check_against_rk4
    implicit none (type, external)
    private
    public :: rheonomic_suite

    real(dp), parameter :: pi = acos(-1.0_dp)
    real(dp), parameter :: rounding = 500.0_dp*epsilon(1.0_dp)  !! as in `system_checks`
    real(dp), parameter :: differencing = 1e-10_dp              !! as in `system_checks`

contains

    function rheonomic_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("rheonomic")
        call suite%addTest(TestMethod("wire_holds_the_bead", wire_holds_the_bead))
        call suite%addTest(TestMethod("hoop_holds_the_bead", hoop_holds_the_bead))
        call suite%addTest(TestMethod("rod_holds_the_bob", rod_holds_the_bob))
        call suite%addTest(TestMethod("energy_is_fed_by_the_drive", energy_is_fed_by_the_drive))
        call suite%addTest(TestMethod("without_motion_energy_is_conserved", &
                                      without_motion_energy_is_conserved))
        call suite%addTest(TestMethod("wire_reference_gives_the_oracle", &
                                      wire_reference_gives_the_oracle))
        call suite%addTest(TestMethod("wire_reference_obeys_the_equations", &
                                      wire_reference_obeys_the_equations))
        call suite%addTest(TestMethod("wire_reference_keeps_its_digits", &
                                      wire_reference_keeps_its_digits))
        call suite%addTest(TestMethod("hoop_has_tilted_equilibria", hoop_has_tilted_equilibria))
        call suite%addTest(TestMethod("hoop_stands_in_equilibria_only", &
                                      hoop_stands_in_equilibria_only))
        call suite%addTest(TestMethod("driven_pendulum_stands_up_and_down", &
                                      driven_pendulum_stands_up_and_down))
        call suite%addTest(TestMethod("pivot_starts_high_and_moves_down", &
                                      pivot_starts_high_and_moves_down))
        call suite%addTest(TestMethod("resting_pivot_is_a_pendulum", resting_pivot_is_a_pendulum))
        call suite%addTest(TestMethod("fast_drive_keeps_it_upright", fast_drive_keeps_it_upright))
    end function rheonomic_suite

    subroutine set(system, values)
        !! Configure.
        class(system_t), intent(inout) :: system
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable :: error

        call system%configure(values, error)
        call assertFalse(allocated(error), "parameters")
    end subroutine set

    function kinetic(system, t, q, v, m) result(energy)
        !! Of one point, from its position: with the constraint's own motion.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:), m
        real(dp) :: energy
        type(hyperdual_t) :: path(size(q)), r(3, 1)

        path%re = q
        path%d1 = v
        call system%positions(hyperdual_t(re=t, d1=1.0_dp), path, r)
        energy = 0.5_dp*m*sum(r%d1**2)
    end function kinetic

    subroutine wire_holds_the_bead()
        !! Newton: the force is that of the wire alone, across it. T and L_z from positions.
        type(rotating_wire_t) :: wire
        real(dp), allocatable :: q(:), v(:), r(:, :), a(:, :)
        real(dp) :: t, along(3), across(3), scale
        integer :: i

        call restart_random()
        do i = 1, 20
            call draw_parameters(wire, edges=.false.)
            call draw_state(wire, t, q, v)
            call point_accelerations(wire, t, q, v, r, a)
            associate (m => wire%m, angle => wire%omega*t)
                along = [cos(angle), sin(angle), 0.0_dp]
                across = [-sin(angle), cos(angle), 0.0_dp]
                scale = rounding*m*(1.0_dp + wire%omega**2)*10.0_dp
                call assertEqual(q(1)*along, r(:, 1), rounding, "on the wire")
                call assertEqual(wire%quantity(4, t, q, v)*across, m*a(:, 1), scale, "force")
                call assertEqual(kinetic(wire, t, q, v, m), wire%quantity(2, t, q, v), scale, "T")
                call assertEqual(m*wire%omega*q(1)**2, wire%quantity(3, t, q, v), scale, "L_z")
            end associate
        end do
    end subroutine wire_holds_the_bead

    subroutine hoop_holds_the_bead()
        !! Newton, with gravity along -z: no force along the hoop, hoop_force to its centre,
        !! torque about its axis.
        type(rotating_hoop_t) :: hoop
        real(dp), allocatable :: q(:), v(:), r(:, :), a(:, :)
        real(dp) :: t, force(3), outward(3), along(3), scale
        integer :: i

        call restart_random()
        do i = 1, 20
            call draw_parameters(hoop, edges=.false.)
            call draw_state(hoop, t, q, v)
            call point_accelerations(hoop, t, q, v, r, a)
            associate (m => hoop%m, angle => hoop%omega*t, theta => q(1))
                force = m*(a(:, 1) + [0.0_dp, 0.0_dp, hoop%g])
                outward = [sin(theta)*cos(angle), sin(theta)*sin(angle), -cos(theta)]
                along = [cos(theta)*cos(angle), cos(theta)*sin(angle), sin(theta)]
                scale = rounding*m*(hoop%g + hoop%r*(v(1)**2 + hoop%omega**2 + 1.0_dp))*10.0_dp
                call assertEqual(hoop%r*outward, r(:, 1), rounding*hoop%r, "on the hoop")
                call assertEqual(0.0_dp, dot_product(force, along), scale, "smooth")
                call assertEqual(hoop%quantity(4, t, q, v), -dot_product(force, outward), scale, &
                                 "hoop_force")
                call assertEqual(hoop%quantity(3, t, q, v), r(1, 1)*force(2) - r(2, 1)*force(1), &
                                 scale*hoop%r, "torque")
                call assertEqual(kinetic(hoop, t, q, v, m) + m*hoop%g*r(3, 1), &
                                 hoop%quantity(1, t, q, v), scale*hoop%r, "T + V")
                call assertEqual(m*hoop%omega*(r(1, 1)**2 + r(2, 1)**2), &
                                 hoop%quantity(2, t, q, v), scale*hoop%r, "L_z")
            end associate
        end do
    end subroutine hoop_holds_the_bead

    subroutine rod_holds_the_bob()
        !! Newton, with gravity along -y: the force is the tension, along the rod.
        type(driven_pendulum_t) :: pendulum
        real(dp), allocatable :: q(:), v(:), r(:, :), a(:, :)
        real(dp) :: t, force(3), rod(3), pivot, scale
        integer :: i

        call restart_random()
        do i = 1, 20
            call draw_parameters(pendulum, edges=.false.)
            call draw_state(pendulum, t, q, v)
            call point_accelerations(pendulum, t, q, v, r, a)
            associate (m => pendulum%m, l => pendulum%l, w => pendulum%drive_frequency)
                pivot = pendulum%amplitude*cos(w*t)
                rod = [sin(q(1)), -cos(q(1)), 0.0_dp]
                force = m*(a(:, 1) + [0.0_dp, pendulum%g, 0.0_dp])
                scale = rounding*m*(1.0_dp + pendulum%g + l*v(1)**2 + 4.0_dp*(1.0_dp + w**2)) &
                        *(1.0_dp + l)
                call assertEqual([0.0_dp, pivot, 0.0_dp] + l*rod, r(:, 1), rounding*(1.0_dp + l))
                call assertEqual(-pendulum%quantity(4, t, q, v)*rod, force, scale, "tension")
                call assertEqual(kinetic(pendulum, t, q, v, m) + m*pendulum%g*r(2, 1), &
                                 pendulum%quantity(1, t, q, v), scale, "T + V")
                call assertEqual(pivot, pendulum%quantity(5, t, q, v), rounding, "pivot")
            end associate
        end do
    end subroutine rod_holds_the_bob

    subroutine energy_is_fed_by_the_drive()
        !! T + V is not conserved: its rate is the power of the drive. Wire and hoop: omega times
        !! the torque, which is the rate of L_z. Pivot: y_p_dot times the pull on the pivot.
        type(rotating_wire_t) :: wire
        type(rotating_hoop_t) :: hoop
        type(driven_pendulum_t) :: pendulum
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t, rate, scale, turn, turn_scale, lift

        call restart_random()
        call draw_parameters(wire, edges=.false.)
        call draw_state(wire, t, q, v)
        call flow_derivative(wire, 2, t, q, v, rate, scale)
        call flow_derivative(wire, 3, t, q, v, turn, turn_scale)
        call assertEqual(wire%quantity(4, t, q, v)*q(1), turn, differencing*turn_scale, "wire L_z")
        call assertEqual(wire%omega*turn, rate, differencing*scale, "wire")
        call assertGreaterThan(abs(rate), 1e-3_dp*scale, message="wire: T changes")
        call draw_parameters(hoop, edges=.false.)
        call draw_state(hoop, t, q, v)
        call flow_derivative(hoop, 1, t, q, v, rate, scale)
        call flow_derivative(hoop, 2, t, q, v, turn, turn_scale)
        call assertEqual(hoop%quantity(3, t, q, v), turn, differencing*turn_scale, "hoop L_z")
        call assertEqual(hoop%omega*turn, rate, differencing*scale, "hoop")
        call assertGreaterThan(abs(rate), 1e-3_dp*scale, message="hoop: T + V changes")
        call draw_parameters(pendulum, edges=.false.)
        call draw_state(pendulum, t, q, v)
        call flow_derivative(pendulum, 1, t, q, v, rate, scale)
        lift = pendulum%quantity(4, t, q, v)*cos(q(1))
        associate (w => pendulum%drive_frequency)
            call assertEqual(-pendulum%amplitude*w*sin(w*t)*lift, rate, differencing*scale, "pivot")
        end associate
        call assertGreaterThan(abs(rate), 1e-3_dp*scale, message="pivot: T + V changes")
    end subroutine energy_is_fed_by_the_drive

    subroutine without_motion_energy_is_conserved()
        !! Where nothing turns or shakes T + V is declared to be conserved, and only there.
        type(rotating_wire_t) :: wire
        type(rotating_hoop_t) :: hoop
        type(driven_pendulum_t) :: pendulum

        call set(wire, [1.3_dp, 0.6_dp])
        call declared(wire, 2, .false.)
        call set(wire, [1.3_dp, 0.0_dp])
        call declared(wire, 2, .true.)
        call set(hoop, [1.3_dp, 0.7_dp, 0.6_dp, 9.81_dp])
        call declared(hoop, 1, .false.)
        call set(hoop, [1.3_dp, 0.7_dp, 0.0_dp, 9.81_dp])
        call declared(hoop, 1, .true.)
        call set(pendulum, [1.3_dp, 0.7_dp, 9.81_dp, 0.2_dp, 3.0_dp])
        call declared(pendulum, 1, .false.)
        call declared(pendulum, 3, .false.)
        call assertTrue(pendulum%time_dependent)
        call set(pendulum, [1.3_dp, 0.7_dp, 9.81_dp, 0.0_dp, 3.0_dp])
        call declared(pendulum, 1, .true.)
        call declared(pendulum, 3, .true.)
        call assertFalse(pendulum%time_dependent)
        call set(pendulum, [1.3_dp, 0.7_dp, 9.81_dp, 0.2_dp, 0.0_dp])
        call declared(pendulum, 1, .true.)
        call declared(pendulum, 2, .false.)
        call set(pendulum, [1.3_dp, 0.7_dp, 0.0_dp, 0.2_dp, 0.0_dp])
        call declared(pendulum, 2, .true.)
    contains
        subroutine declared(system, k, conserved)
            class(system_t), intent(in) :: system
            integer, intent(in) :: k
            logical, intent(in) :: conserved
            type(description_t) :: d

            call system%describe(d)
            call assertTrue(d%quantities(k)%conserved .eqv. conserved, &
                            trim(d%name)//": "//trim(d%quantities(k)%name))
        end subroutine declared
    end subroutine without_motion_energy_is_conserved

    subroutine wire_reference_gives_the_oracle()
        !! 22-digit arithmetic: r0 = 0.5, omega = 1.5, t = 2. The sense of turning is no matter.
        type(rotating_wire_t) :: wire
        type(rotating_wire_reference_t) :: reference
        real(dp) :: q(1), v(1)
        logical :: found
        integer :: i

        do i = -1, 1, 2
            call set(wire, [1.3_dp, 1.5_dp*i])
            call new_rotating_wire_reference(reference, wire, 7.0_dp, [0.5_dp], [0.0_dp], found)
            call assertTrue(found)
            call reference%state_at(9.0_dp, q, v)
            call assertEqual(5.03383099788888292_dp, q(1), 4e-15_dp)
        end do
    end subroutine wire_reference_gives_the_oracle

    subroutine wire_reference_obeys_the_equations()
        !! At any rate of turning.
        type(rotating_wire_t) :: wire
        type(rotating_wire_reference_t) :: reference
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t
        logical :: found
        integer :: i

        call restart_random()
        do i = 1, 20
            call draw_parameters(wire, edges=mod(i, 2) == 0)
            call draw_state(wire, t, q, v)
            call new_rotating_wire_reference(reference, wire, t, q, v, found)
            call check_reference(reference, wire, t, q, v, "wire")
            if (anyExceptions()) return
        end do
    end subroutine wire_reference_obeys_the_equations

    subroutine wire_reference_keeps_its_digits()
        !! Slow turning goes over into uniform motion. A bead that creeps towards the axis,
        !! r0 exp(-omega t), does so to the last digit, forwards and, flying away, backwards.
        type(rotating_wire_t) :: wire
        type(rotating_wire_reference_t) :: reference
        real(dp) :: q(1), v(1), omega
        logical :: found
        integer :: k

        do k = 1, 14
            omega = merge(0.0_dp, 10.0_dp**(-k), k == 14)
            call set(wire, [1.3_dp, omega])
            call new_rotating_wire_reference(reference, wire, 0.0_dp, [0.4_dp], [0.7_dp], found)
            call check_against_rk4(reference, wire, [0.4_dp], [0.7_dp], 2.0_dp, "slow")
            call reference%state_at(2.0_dp, q, v)
            call assertLessThanOrEqual(abs(q(1) - 1.8_dp), 4.0_dp*omega**2 + 4e-16_dp, &
                                       message="slow")
        end do
        call set(wire, [1.3_dp, 1.5_dp])
        do k = -1, 1, 2
            call new_rotating_wire_reference(reference, wire, 0.0_dp, [0.5_dp], [-0.75_dp*k], found)
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

        call set(hoop, [1.3_dp, 0.8_dp, 5.0_dp, 9.81_dp])
        tilt = acos(9.81_dp/20.0_dp)
        call stands([0.0_dp, pi, -pi, 2.0_dp*pi, tilt, -tilt, 2.0_dp*pi - tilt, tilt - 4.0_dp*pi], &
                    .true.)
        call stands([0.1_dp, 1e-9_dp, tilt + 1e-9_dp, pi - tilt, 0.5_dp*pi], .false.)
        call set(hoop, [1.3_dp, 0.8_dp, 3.0_dp, 9.81_dp])
        call stands([0.0_dp, pi], .true.)
        call stands([acos(3.0_dp**2*0.8_dp/9.81_dp), tilt], .false.)
        ! omega^2 R is little more than g: the tilt is 2 asin(sqrt((1 - g/(omega^2 R))/2))
        call set(hoop, [1.3_dp, 1.0_dp, 2.0_dp, 4.0_dp*(1.0_dp - 2.0_dp**(-30))])
        call stands([2.0_dp*asin(2.0_dp**(-15.5_dp))], .true.)
        call stands([2.0_dp*asin(2.0_dp**(-15.5_dp)) + 1e-14_dp], .false.)
        call set(hoop, [1.3_dp, 0.8_dp, 0.0_dp, 0.0_dp])
        call stands([0.3_dp], .true.)
    contains
        subroutine stands(angles, expected)
            real(dp), intent(in) :: angles(:)
            logical, intent(in) :: expected
            type(rotating_hoop_reference_t) :: reference
            logical :: found
            integer :: i

            do i = 1, size(angles)
                call new_rotating_hoop_reference(reference, hoop, 1.0_dp, angles(i:i), [0.0_dp], &
                                                 found)
                call assertTrue(found .eqv. expected, "equilibrium?")
                if (.not. found) cycle
                call check_state(reference, 9.0_dp, angles(i:i), [0.0_dp], 0.0_dp, "stands")
                call check_reference(reference, hoop, 1.0_dp, angles(i:i), [0.0_dp], "stands")
                call new_rotating_hoop_reference(reference, hoop, 1.0_dp, angles(i:i), &
                                                 [1e-9_dp], found)
                call assertFalse(found, "it moves")
            end do
        end subroutine stands
    end subroutine hoop_stands_in_equilibria_only

    subroutine driven_pendulum_stands_up_and_down()
        !! Whatever the drive; nowhere else, and not in motion.
        type(driven_pendulum_t) :: pendulum
        type(driven_pendulum_reference_t) :: reference
        real(dp), parameter :: angles(4) = [0.0_dp, pi, -3.0_dp*pi, 0.5_dp*pi]
        logical :: found
        integer :: i

        call set(pendulum, [1.3_dp, 0.7_dp, 9.81_dp, 0.2_dp, 3.0_dp])
        do i = 1, 4
            call new_driven_pendulum_reference(reference, pendulum, 1.0_dp, angles(i:i), &
                                               [0.0_dp], found)
            call assertTrue(found .eqv. i < 4, "equilibrium?")
            if (.not. found) cycle
            call check_state(reference, -9.0_dp, angles(i:i), [0.0_dp], 0.0_dp, "stands")
            call check_reference(reference, pendulum, 1.0_dp, angles(i:i), [0.0_dp], "stands")
            call new_driven_pendulum_reference(reference, pendulum, 1.0_dp, angles(i:i), &
                                               [1e-9_dp], found)
            call assertFalse(found, "it moves")
        end do
    end subroutine driven_pendulum_stands_up_and_down

    subroutine pivot_starts_high_and_moves_down()
        !! The sign convention: at t = 0 the pivot is at +a and its acceleration -a W^2 takes
        !! gravity away from the bob; half a period later it adds.
        type(driven_pendulum_t) :: pendulum
        real(dp) :: a(1)

        call set(pendulum, [1.3_dp, 0.7_dp, 9.81_dp, 0.2_dp, 3.0_dp])
        call pendulum%accelerations(0.0_dp, [0.5_dp*pi], [0.0_dp], a)
        call assertEqual(-(9.81_dp - 1.8_dp)/0.7_dp, a(1), 1e-14_dp)
        call pendulum%accelerations(pi/3.0_dp, [0.5_dp*pi], [0.0_dp], a)
        call assertEqual(-(9.81_dp + 1.8_dp)/0.7_dp, a(1), 1e-14_dp)
        call assertEqual(0.2_dp, pendulum%quantity(5, 0.0_dp, [0.1_dp], [0.0_dp]))
        call assertLessThan(pendulum%quantity(5, 0.1_dp, [0.1_dp], [0.0_dp]), 0.2_dp)
    end subroutine pivot_starts_high_and_moves_down

    subroutine resting_pivot_is_a_pendulum()
        !! With no amplitude, or no frequency.
        type(driven_pendulum_t) :: driven
        type(pendulum_t) :: plain
        real(dp) :: a(1), b(1)
        integer :: i

        call set(plain, [1.3_dp, 0.7_dp, 9.81_dp])
        do i = 0, 1
            call set(driven, [1.3_dp, 0.7_dp, 9.81_dp, 0.2_dp*i, 3.0_dp*(1 - i)])
            call driven%accelerations(0.4_dp, [0.9_dp], [0.3_dp], a)
            call plain%accelerations(0.4_dp, [0.9_dp], [0.3_dp], b)
            call assertEqual(b(1), a(1), 4e-15_dp)
            call assertEqual(plain%energy(0.4_dp, [0.9_dp], [0.3_dp]) + 1.3_dp*9.81_dp*0.2_dp*i, &
                             driven%energy(0.4_dp, [0.9_dp], [0.3_dp]), 4e-15_dp)
        end do
    end subroutine resting_pivot_is_a_pendulum

    subroutine fast_drive_keeps_it_upright()
        !! Kapitza: upside down it stays for (a W)^2 > 2 g l, and falls below; his averaged energy
        !! is constant to some a/l, while T + V is not.
        real(dp) :: largest, slow, mechanical

        call swing(120.0_dp, largest, slow, mechanical)
        call assertLessThan(largest, 0.3_dp, message="stays upright")
        call assertLessThan(slow, 0.05_dp, message="averaged energy")
        call assertGreaterThan(mechanical, 1.0_dp, message="T + V")
        call swing(70.0_dp, largest, slow, mechanical)
        call assertGreaterThan(largest, 1.5_dp, message="falls")
    end subroutine fast_drive_keeps_it_upright

    subroutine swing(w, largest, slow, mechanical)
        !! 10 s from 0.2 rad off the top with a = 0.05, l = 1: the largest angle from the top,
        !! and the spread of both energies in units of m g l.
        real(dp), intent(in) :: w
        real(dp), intent(out) :: largest, slow, mechanical
        type(driven_pendulum_t) :: pendulum
        type(rk4_t) :: rk4
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), t, energies(2, 0:2500)
        integer :: k

        call set(pendulum, [1.3_dp, 1.0_dp, 9.81_dp, 0.05_dp, w])
        call new_rk4(rk4)
        call rk4%prepare(pendulum, error)
        q = pi - 0.2_dp
        v = 0.0_dp
        largest = 0.2_dp
        do k = 0, 2500
            t = k*4e-3_dp
            largest = max(largest, abs(q(1) - pi))
            energies(:, k) = [pendulum%quantity(3, t, q, v), pendulum%quantity(1, t, q, v)]
            call rk4%advance(pendulum, 0.0_dp, 1e-3_dp, int(4*k, i8), 4_i8, q, v)
        end do
        slow = (maxval(energies(1, :)) - minval(energies(1, :)))/(1.3_dp*9.81_dp)
        mechanical = (maxval(energies(2, :)) - minval(energies(2, :)))/(1.3_dp*9.81_dp)
    end subroutine swing
end module test_rheonomic
