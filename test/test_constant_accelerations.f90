module test_constant_accelerations
    !! Atwood's machine and the block on the wedge: forces, limits, closed forms.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_atwood, only: atwood_t
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    use lagrangia_wedge, only: wedge_t
    use motion, only: newton_lagrangian, point_accelerations
    use random_states, only: draw_parameters, draw_state, restart_random
    use reference_checks, only: check_reference
    implicit none (type, external)
    private
    public :: constant_accelerations_suite

contains

    function constant_accelerations_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("constant_accelerations")
        call suite%addTest(TestMethod("atwood_numbers", atwood_numbers))
        call suite%addTest(TestMethod("atwood_lagrangian_is_inertial", &
                                      atwood_lagrangian_is_inertial, setUp=restart_random))
        call suite%addTest(TestMethod("atwood_tensions_move_masses_and_pulley", &
                                      atwood_tensions_move_masses_and_pulley, setUp=restart_random))
        call suite%addTest(TestMethod("atwood_limits", atwood_limits))
        call suite%addTest(TestMethod("atwood_reference_solves_it", atwood_reference_solves_it, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("wedge_numbers", wedge_numbers))
        call suite%addTest(TestMethod("wedge_lagrangian_is_that_of_two_masses", &
                                      wedge_lagrangian_is_that_of_two_masses, setUp=restart_random))
        call suite%addTest(TestMethod("wedge_normal_force_moves_both", &
                                      wedge_normal_force_moves_both, setUp=restart_random))
        call suite%addTest(TestMethod("wedge_limits", wedge_limits))
        call suite%addTest(TestMethod("wedge_angle_is_bounded", wedge_angle_is_bounded))
        call suite%addTest(TestMethod("wedge_reference_solves_it", wedge_reference_solves_it, &
                                      setUp=restart_random))
    end function constant_accelerations_suite

    subroutine atwood_numbers()
        !! m = (3, 2): a fifth of g, tension 12/5 g.
        type(atwood_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: a(1)
        integer :: i

        call system%configure([3.0_dp, 2.0_dp, 9.81_dp, 0.0_dp, 0.1_dp, 0.0_dp], error)
        call system%accelerations(0.0_dp, [0.3_dp], [0.7_dp], a)
        call assertEqual(1.962_dp, a(1), 1e-15_dp, "x_ddot")
        do i = 4, 5
            call assertEqual(23.544_dp, system%quantity(i, 0.0_dp, [0.3_dp], [0.7_dp]), 1e-14_dp, &
                             "tension")
        end do
    end subroutine atwood_numbers

    subroutine atwood_lagrangian_is_inertial()
        !! L is T - V of the two masses where the support really rises, and of the pulley's rim;
        !! and `total_energy` is T + V.
        type(atwood_t) :: system
        type(hyperdual_t) :: l
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t, rim, kinetic, potential
        integer :: i

        do i = 1, 20
            call draw_parameters(system, edges=.false.)
            call draw_state(system, t, q, v)
            l = system%lagrangian(hyperdual(t), hyperdual(q), hyperdual(v))
            rim = 0.5_dp*system%pulley_inertia*(v(1)/system%radius)**2
            kinetic = newton_lagrangian(system, t, q, v, 0.0_dp) + rim
            potential = kinetic - newton_lagrangian(system, t, q, v, system%g) - rim
            call assertEqual(kinetic - potential, l%re, 1e-12_dp*(kinetic + 100.0_dp), "T - V")
            call assertEqual(kinetic + potential, system%quantity(3, t, q, v), &
                             1e-12_dp*(kinetic + 100.0_dp), "T + V")
        end do
    end subroutine atwood_lagrangian_is_inertial

    subroutine atwood_tensions_move_masses_and_pulley()
        !! Newton's law for each mass in the inertial frame, and the torque on the pulley.
        type(atwood_t) :: system
        real(dp), allocatable :: q(:), v(:), r(:, :), a(:, :)
        real(dp) :: t, x_ddot(1), tension(2), tolerance
        integer :: i

        do i = 1, 20
            call draw_parameters(system, edges=.false.)
            call draw_state(system, t, q, v)
            call point_accelerations(system, t, q, v, r, a)
            call system%accelerations(t, q, v, x_ddot)
            tension = [system%quantity(4, t, q, v), system%quantity(5, t, q, v)]
            tolerance = 1e-12_dp*(system%m1 + system%m2)*(system%g + 2.0_dp)
            call assertEqual(system%m1*(a(2, 1) + system%g), tension(1), tolerance, "m1")
            call assertEqual(system%m2*(a(2, 2) + system%g), tension(2), tolerance, "m2")
            call assertEqual((tension(1) - tension(2))*system%radius**2, &
                             system%pulley_inertia*x_ddot(1), 10.0_dp*tolerance, "pulley")
            call assertEqual(r(1, 2) - r(1, 1), 2.0_dp*system%radius, 1e-15_dp, "across")
        end do
    end subroutine atwood_tensions_move_masses_and_pulley

    subroutine atwood_limits()
        !! A support in free fall leaves no weight; a support that accelerates is rheonomic, one
        !! that does not is scleronomic; equal masses make x cyclic.
        type(atwood_t) :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp) :: a(1)

        call system%configure([3.0_dp, 2.0_dp, 9.81_dp, 0.4_dp, 0.1_dp, -9.81_dp], error)
        call system%accelerations(0.0_dp, [0.3_dp], [0.7_dp], a)
        call assertEqual(0.0_dp, a(1), 0.0_dp, "free fall")
        call assertTrue(system%time_dependent, "system%time_dependent")
        call system%describe(d)
        call assertTrue(index(d%constraint, "rheonomic") > 0, d%constraint)
        call system%configure([3.0_dp, 3.0_dp, 9.81_dp, 0.4_dp, 0.1_dp, 0.0_dp], error)
        call assertFalse(system%time_dependent, "not system%time_dependent")
        call assertEqual(1, system%cyclic)
        call system%describe(d)
        call assertTrue(index(d%constraint, "scleronomic") > 0, d%constraint)
        call assertTrue(d%quantities(2)%conserved, "p_x of equal masses")
        call system%configure([3.0_dp, 2.0_dp, 9.81_dp, 0.0_dp, 0.1_dp, 0.0_dp], error)
        call system%describe(d)
        call assertFalse(d%quantities(2)%conserved, "p_x")
    end subroutine atwood_limits

    subroutine atwood_reference_solves_it()
        !! From random states, the support accelerating.
        type(atwood_t) :: system
        class(reference_t), allocatable :: reference
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t
        integer :: i

        do i = 1, 5
            call draw_parameters(system, edges=.false.)
            call draw_state(system, t, q, v)
            call system%closed_form(t, q, v, reference)
            call assertTrue(allocated(reference), "found")
            call check_reference(reference, system, t, q, v, "atwood")
            if (anyExceptions()) return
        end do
    end subroutine atwood_reference_solves_it

    subroutine wedge_numbers()
        !! M = 2, m = 0.7, alpha = 0.6.
        type(wedge_t) :: system
        type(error_t), allocatable :: error
        real(dp), parameter :: any(2) = [0.3_dp, 0.7_dp]
        real(dp) :: a(2)

        call system%configure([0.7_dp, 2.0_dp, 0.6_dp, 9.81_dp], error)
        call system%accelerations(0.0_dp, any, any, a)
        call assertEqual([6.7271747086393581_dp, -1.43945326382658903_dp], a, 4e-15_dp, "q_ddot")
        call assertEqual(5.09863615172823974_dp, system%quantity(4, 0.0_dp, any, any), 4e-15_dp, &
                         "normal force")
    end subroutine wedge_numbers

    subroutine wedge_lagrangian_is_that_of_two_masses()
        !! L is T - V in Cartesian coordinates.
        type(wedge_t) :: system
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
    end subroutine wedge_lagrangian_is_that_of_two_masses

    subroutine wedge_normal_force_moves_both()
        !! Newton's law: the normal force and weight on the block, its reaction on the wedge.
        type(wedge_t) :: system
        real(dp), allocatable :: q(:), v(:), r(:, :), a(:, :)
        real(dp) :: t, force(2)
        integer :: i

        do i = 1, 20
            call draw_parameters(system, edges=.false.)
            call draw_state(system, t, q, v)
            call point_accelerations(system, t, q, v, r, a)
            force = system%quantity(4, t, q, v)*[sin(system%alpha), cos(system%alpha)]
            call assertEqual(system%m_block*(a(:2, 1) + [0.0_dp, system%g]), force, 1e-13_dp*50, &
                             "block")
            call assertEqual(system%m_wedge*a(1, 2), -force(1), 1e-13_dp*50, "wedge")
        end do
    end subroutine wedge_normal_force_moves_both

    subroutine wedge_limits()
        !! A heavy wedge stays; beside a vertical one the block falls; a light one is thrown out.
        type(wedge_t) :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp), parameter :: rest(2) = 0.0_dp
        real(dp) :: a(2)

        call system%configure([0.7_dp, 1e20_dp, 0.6_dp, 9.81_dp], error)
        call system%accelerations(0.0_dp, rest, rest, a)
        call assertEqual([9.81_dp*sin(0.6_dp), 0.0_dp], a, 2e-15_dp, "heavy wedge")
        call system%configure([0.7_dp, 2.0_dp, acos(0.0_dp), 9.81_dp], error)
        call system%accelerations(0.0_dp, rest, rest, a)
        call assertEqual([9.81_dp, 0.0_dp], a, 2e-15_dp, "vertical")
        call system%configure([0.7_dp, 2.0_dp, 0.0_dp, 9.81_dp], error)
        call system%accelerations(0.0_dp, rest, rest, a)
        call assertEqual([0.0_dp, 0.0_dp], a, 0.0_dp, "level")
        call system%describe(d)
        call assertTrue(d%quantities(3)%conserved, "p_q1 on the level")
        call system%configure([0.7_dp, 1e-20_dp, 0.6_dp, 9.81_dp], error)
        call system%accelerations(0.0_dp, rest, rest, a)
        call assertEqual([9.81_dp/sin(0.6_dp), -9.81_dp/tan(0.6_dp)], a, 4e-15_dp, "light wedge")
    end subroutine wedge_limits

    subroutine wedge_angle_is_bounded()
        !! Neither below the plane nor beyond the vertical.
        type(wedge_t) :: system
        type(error_t), allocatable :: error

        call system%configure([0.7_dp, 2.0_dp, 1.6_dp, 9.81_dp], error)
        call assertTrue(allocated(error), "an error: wedge angle is bounded")
        if (.not. allocated(error)) return
        call assertEqual("wedge: alpha = 1.6 is not allowed: from 0.0 to pi/2", &
                         error%message)
    end subroutine wedge_angle_is_bounded

    subroutine wedge_reference_solves_it()
        !! From random states.
        type(wedge_t) :: system
        class(reference_t), allocatable :: reference
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t
        integer :: i

        do i = 1, 5
            call draw_parameters(system, edges=.false.)
            call draw_state(system, t, q, v)
            call system%closed_form(t, q, v, reference)
            call assertTrue(allocated(reference), "found")
            call check_reference(reference, system, t, q, v, "wedge")
            if (anyExceptions()) return
        end do
    end subroutine wedge_reference_solves_it
end module test_constant_accelerations
