module test_charged_particle
    !! The charged particle: its force and what the fields let it conserve.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertGreaterThan, &
                     assertLessThanOrEqual, assertTrue
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: euler_lagrange_t, expand_lagrangian
    use motion, only: flow_derivative
    use random_states, only: draw_parameters, draw_state, restart_random
    implicit none (type, external)
    private
    public :: charged_particle_suite

    real(dp), parameter :: nil(3) = 0.0_dp
    real(dp), parameter :: differencing = 1e-10_dp  !! as in `system_checks`

contains

    function charged_particle_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("charged_particle")
        call suite%addTest(TestMethod("force_is_lorentz", force_is_lorentz))
        call suite%addTest(TestMethod("invariants_follow_the_fields", &
                                      invariants_follow_the_fields, setUp=restart_random))
        call suite%addTest(TestMethod("declared_invariants_hold", declared_invariants_hold))
        call suite%addTest(TestMethod("p_is_the_canonical_momentum", p_is_the_canonical_momentum, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("undeclared_quantities_change", &
                                      undeclared_quantities_change, setUp=restart_random))
        call suite%addTest(TestMethod("flags_follow_the_fields", flags_follow_the_fields))
        call suite%addTest(TestMethod("fields_are_drawn", fields_are_drawn))
    end function charged_particle_suite

    subroutine build(particle, m, charge, electric, magnetic, trap)
        !! A particle of these parameters.
        type(charged_particle_t), intent(out) :: particle
        real(dp), intent(in) :: m, charge, electric(3), magnetic(3), trap
        type(error_t), allocatable :: error

        call particle%configure([m, charge, electric, magnetic, trap], error)
        call assertFalse(allocated(error), "parameters of the particle")
    end subroutine build

    subroutine force_is_lorentz()
        !! In numbers: e = -2, v along x, B along y give a force along -z; E pushes against itself.
        type(charged_particle_t) :: particle
        real(dp) :: a(3)

        call build(particle, 4.0_dp, -2.0_dp, nil, [0.0_dp, 3.0_dp, 0.0_dp], 0.0_dp)
        call particle%accelerations(0.0_dp, nil, [5.0_dp, 0.0_dp, 0.0_dp], a)
        call assertEqual([0.0_dp, 0.0_dp, -7.5_dp], a, 1e-15_dp)
        call build(particle, 4.0_dp, -2.0_dp, [1.0_dp, 0.0_dp, 0.0_dp], nil, 8.0_dp)
        call particle%accelerations(0.0_dp, [0.0_dp, 3.0_dp, 0.0_dp], nil, a)
        call assertEqual([-0.5_dp, -6.0_dp, 0.0_dp], a, 1e-15_dp)
    end subroutine force_is_lorentz

    subroutine fields_are_drawn()
        !! Those that are not zero, also where all their components are negative.
        type(charged_particle_t) :: particle
        type(description_t) :: d
        real(dp), parameter :: down(3) = [0.0_dp, -1.0_dp, 0.0_dp]

        call build(particle, 1.0_dp, 1.0_dp, nil, nil, 1.0_dp)
        call particle%describe(d)
        call assertFalse(any(index(d%figure, "field") == 1), "none")
        call build(particle, 1.0_dp, 1.0_dp, down, nil, 1.0_dp)
        call particle%describe(d)
        call assertEqual(1, count(index(d%figure, "field E (electric_x") == 1), "E alone")
        call assertEqual(0, count(index(d%figure, "field B") == 1), "no B")
        call build(particle, 1.0_dp, 1.0_dp, nil, down, 1.0_dp)
        call particle%describe(d)
        call assertEqual(1, count(index(d%figure, "field B (magnetic_x") == 1), "B alone")
        call assertEqual(0, count(index(d%figure, "field E") == 1), "no E")
    end subroutine fields_are_drawn

    subroutine expect(electric, magnetic, trap, names, what)
        !! With charge -0.7, exactly `names` are declared to be conserved, and they are.
        real(dp), intent(in) :: electric(3), magnetic(3), trap
        character(*), intent(in) :: names, what
        type(charged_particle_t) :: particle
        type(description_t) :: d
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t, rate, scale
        integer :: i, k

        call build(particle, 1.3_dp, -0.7_dp, electric, magnetic, trap)
        call particle%describe(d)
        do k = 1, size(d%quantities)
            call assertTrue(d%quantities(k)%conserved .eqv. &
                            index(" "//names//" ", " "//trim(d%quantities(k)%name)//" ") > 0, &
                            what//": "//trim(d%quantities(k)%name))
            if (.not. d%quantities(k)%conserved) cycle
            call assertGreaterThan(d%quantities(k)%scale, 0.0_dp - tiny(1.0_dp), message="scale")
            do i = 1, 10
                call draw_state(particle, t, q, v)
                call flow_derivative(particle, k, t, q, v, rate, scale)
                call assertLessThanOrEqual(abs(rate), differencing*scale, &
                                           message=what//": "//trim(d%quantities(k)%name))
            end do
        end do
    end subroutine expect

    subroutine invariants_follow_the_fields()
        !! What is declared for each combination of fields and trap, by name; it is conserved.
        real(dp), parameter :: b(3) = [0.1_dp, -0.2_dp, 0.3_dp], e(3) = [0.5_dp, 0.4_dp, -0.3_dp]
        character(*), parameter :: pseudo = "pseudo_x pseudo_y pseudo_z energy_axis"

        call expect(e, b, 0.0_dp, pseudo, "E and B")
        call expect(3.0_dp*b, b, 0.0_dp, pseudo//" L_axis", "E along B")
        call expect(nil, b, 0.0_dp, pseudo//" L_axis speed", "B")
        call expect(e, nil, 0.0_dp, pseudo//" L_axis", "E")
        call expect(nil, nil, 0.0_dp, pseudo//" L_axis speed p_x p_y p_z", "free")
        call expect([0.5_dp, 0.4_dp, 0.0_dp], [0.0_dp, 0.0_dp, -2.0_dp], 0.0_dp, pseudo//" p_z", &
                    "B along z")
        call expect([0.0_dp, 0.4_dp, 0.2_dp], [1.5_dp, 0.0_dp, 0.0_dp], 0.0_dp, pseudo//" p_x", &
                    "B along x")
        call expect([0.5_dp, 0.0_dp, 0.2_dp], nil, 0.0_dp, pseudo//" L_axis p_y", "E across y")
        call expect(e, b, 0.6_dp, "L_axis energy_axis", "trap with E and B")
        call expect(nil, nil, 0.6_dp, "L_axis energy_axis", "trap")
    end subroutine invariants_follow_the_fields

    subroutine declared_invariants_hold()
        !! Numbers of the page: m v + e B x r - e E t, and n.(r x m v) + e |B| r_perp^2/2.
        type(charged_particle_t) :: particle
        real(dp), parameter :: q(3) = [1.0_dp, 2.0_dp, 3.0_dp], v(3) = [4.0_dp, -5.0_dp, 6.0_dp]
        integer :: i

        call build(particle, 2.0_dp, 3.0_dp, [0.0_dp, 0.0_dp, 0.5_dp], [0.0_dp, 0.0_dp, 7.0_dp], &
                   0.0_dp)
        call assertEqual([-34.0_dp, 11.0_dp, 6.0_dp], &
                         [(particle%quantity(i, 4.0_dp, q, v), i=1, 3)], 1e-14_dp)
        call assertEqual(2.0_dp*(1.0_dp*(-5.0_dp) - 2.0_dp*4.0_dp) + 0.5_dp*3.0_dp*7.0_dp*5.0_dp, &
                         particle%quantity(4, 4.0_dp, q, v), 1e-13_dp, "L_axis")
        call assertEqual(0.5_dp*2.0_dp*36.0_dp - 3.0_dp*0.5_dp*3.0_dp, &
                         particle%quantity(5, 4.0_dp, q, v), 1e-13_dp, "energy_axis")
        call assertEqual(sqrt(77.0_dp), particle%quantity(6, 4.0_dp, q, v), 1e-14_dp, "speed")
        call assertEqual([8.0_dp - 21.0_dp, -10.0_dp + 10.5_dp, 12.0_dp], &
                         [(particle%quantity(i, 4.0_dp, q, v), i=7, 9)], 1e-14_dp, "m v + e A")
    end subroutine declared_invariants_hold

    subroutine p_is_the_canonical_momentum()
        !! p_x, p_y, p_z are dL/dv.
        type(charged_particle_t) :: particle
        type(euler_lagrange_t) :: terms
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t
        integer :: i

        call draw_parameters(particle, edges=.false.)
        call draw_state(particle, t, q, v)
        call expand_lagrangian(particle, t, q, v, terms)
        call assertEqual(terms%dl_dv, [(particle%quantity(i, t, q, v), i=7, 9)], 1e-14_dp)
    end subroutine p_is_the_canonical_momentum

    subroutine undeclared_quantities_change()
        !! Negative control: what is not declared is not conserved, at a random state.
        type(charged_particle_t) :: particle
        type(description_t) :: d
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t, rate, scale
        integer :: i, k

        do i = 0, 1
            call build(particle, 1.3_dp, -0.7_dp, [0.5_dp, 0.4_dp, -0.3_dp], &
                       [0.1_dp, -0.2_dp, 0.3_dp], 0.6_dp*i)
            call draw_state(particle, t, q, v)
            call particle%describe(d)
            do k = 1, size(d%quantities)
                if (d%quantities(k)%conserved) cycle
                call flow_derivative(particle, k, t, q, v, rate, scale)
                call assertGreaterThan(abs(rate), 1e-3_dp*scale, &
                                       message=trim(d%quantities(k)%name)//" changes")
            end do
        end do
    end subroutine undeclared_quantities_change

    subroutine flags_follow_the_fields()
        !! Forces depend on velocities where e B is not zero.
        type(charged_particle_t) :: particle

        call build(particle, 1.3_dp, 0.7_dp, [0.5_dp, 0.4_dp, -0.3_dp], nil, 0.6_dp)
        call assertFalse(particle%velocity_forces, "no B")
        call build(particle, 1.3_dp, 0.0_dp, nil, [0.5_dp, 0.4_dp, -0.3_dp], 0.6_dp)
        call assertFalse(particle%velocity_forces, "no charge")
        call assertEqual(0, particle%cyclic)
        call build(particle, 1.3_dp, 0.7_dp, nil, [1e-200_dp, 0.0_dp, 0.0_dp], 0.0_dp)
        call assertTrue(particle%velocity_forces, "a weak B")
        call assertEqual(1, particle%cyclic)
        call build(particle, 1.3_dp, 0.7_dp, [0.1_dp, 0.0_dp, 0.0_dp], [2.0_dp, 0.0_dp, 0.0_dp], &
                   0.0_dp)
        call assertEqual(0, particle%cyclic)
    end subroutine flags_follow_the_fields
end module test_charged_particle
