module test_rheonomic
    !! Moving constraints, by Newton: forces of wire, hoop and rod, and the work that they do.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertGreaterThan, assertTrue
    use lagrangia_catalogue, only: new_system, system_names
    use lagrangia_description, only: default_values, description_t
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_rotating_hoop, only: rotating_hoop_t
    use lagrangia_rotating_wire, only: rotating_wire_t
    use lagrangia_system, only: system_t
    use motion, only: flow_derivative, point_accelerations
    use random_states, only: draw_parameters, draw_state, restart_random
    implicit none (type, external)
    private
    public :: rheonomic_suite

    real(dp), parameter :: rounding = 500.0_dp*epsilon(1.0_dp)  !! as in `system_checks`
    real(dp), parameter :: differencing = 1e-10_dp              !! as in `system_checks`

contains

    function rheonomic_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("rheonomic")
        call suite%addTest(TestMethod("wire_holds_the_bead", wire_holds_the_bead, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("hoop_holds_the_bead", hoop_holds_the_bead, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("rod_holds_the_bob", rod_holds_the_bob, setUp=restart_random))
        call suite%addTest(TestMethod("energy_is_fed_by_the_drive", energy_is_fed_by_the_drive, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("without_motion_energy_is_conserved", &
                                      without_motion_energy_is_conserved))
        call suite%addTest(TestMethod("only_what_moves_is_rheonomic", &
                                      only_what_moves_is_rheonomic, setUp=restart_random))
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

        do i = 1, 20
            call draw_parameters(pendulum, edges=.false.)
            call set(pendulum, [pendulum%m, pendulum%l, pendulum%g, pendulum%amplitude, &
                                pendulum%drive_frequency])  ! without friction
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
        call set(pendulum, [pendulum%m, pendulum%l, pendulum%g, pendulum%amplitude, &
                            pendulum%drive_frequency])
        call draw_state(pendulum, t, q, v)
        call flow_derivative(pendulum, 1, t, q, v, rate, scale)
        lift = pendulum%quantity(4, t, q, v)*cos(q(1))
        associate (w => pendulum%drive_frequency)
            call assertEqual(-pendulum%amplitude*w*sin(w*t)*lift, rate, differencing*scale, "pivot")
        end associate
        call assertGreaterThan(abs(rate), 1e-3_dp*scale, message="pivot: T + V changes")
    end subroutine energy_is_fed_by_the_drive

    subroutine only_what_moves_is_rheonomic()
        !! Every system with each of its parameters at zero, one at a time: its constraint is called
        !! rheonomic where a mass moves while the coordinates rest, scleronomic where none does.
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp), allocatable :: values(:)
        character(32), allocatable :: names(:)
        integer :: i, k

        allocate (names, source=system_names())
        do i = 1, size(names)
            call new_system(trim(names(i)), system, error)
            call system%describe(d)
            allocate (values, source=default_values(d))
            do k = 0, size(values)
                values = default_values(d)
                if (k > 0) values(k) = 0.0_dp
                call system%configure(values, error)
                if (.not. allocated(error)) call called_rightly(system)
            end do
            deallocate (values)
        end do
    end subroutine only_what_moves_is_rheonomic

    subroutine called_rightly(system)
        !! See `only_what_moves_is_rheonomic`.
        class(system_t), intent(in) :: system
        type(description_t) :: d
        type(hyperdual_t), allocatable :: path(:), r(:, :)
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t
        integer :: i
        logical :: moves

        call system%describe(d)
        if (index(d%constraint, "rheonomic") + index(d%constraint, "scleronomic") == 0) return
        moves = .false.
        do i = 1, 4
            call draw_state(system, t, q, v)
            if (allocated(path)) deallocate (path, r)
            allocate (path(size(q)), r(3, size(d%points)))
            path%re = q
            call system%positions(hyperdual_t(re=t, d1=1.0_dp), path, r)
            moves = moves .or. any(abs(r%d1) > 0.0_dp)
        end do
        call assertTrue(moves .eqv. index(d%constraint, "rheonomic") > 0, &
                        trim(d%name)//": "//trim(d%constraint))
    end subroutine called_rightly

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
        call assertTrue(pendulum%time_dependent, "pendulum%time_dependent")
        call set(pendulum, [1.3_dp, 0.7_dp, 9.81_dp, 0.0_dp, 3.0_dp])
        call declared(pendulum, 1, .true.)
        call declared(pendulum, 3, .true.)
        call assertFalse(pendulum%time_dependent, "not pendulum%time_dependent")
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
end module test_rheonomic
