module test_own_system
    !! A system of which only L was written: the same motion as by hand, and it may join.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use description_checks, only: check_description, check_refusals
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertLessThan, assertTrue
    use lagrangia_audit, only: audit_system
    use lagrangia_description, only: description_t, quantity
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: ledger_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_small_oscillations, only: find_modes, likely_equilibrium, modes_t
    use lagrangia_system, only: default_values, system_t
    use own_systems, only: own_double_t, own_named_t, own_pendulum_t, own_pivot_t, own_skin_t, &
                           own_slope_t
    use random_states, only: draw_parameters, draw_state, restart_random
    use test_moduli, only: moduli_suite
    implicit none (type, external)
    private
    public :: own_system_suite

    type, extends(own_pendulum_t) :: sourced_t
        !! From a book, with an equilibrium of too many numbers.
    contains
        procedure :: outline => sourced_outline
    end type sourced_t

contains

    function own_system_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("own_system")
        call suite%addTest(TestMethod("pendulum_moves_as_by_hand", pendulum_moves_as_by_hand, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("double_pendulum_moves_as_by_hand", &
                                      double_pendulum_moves_as_by_hand, setUp=restart_random))
        call suite%addTest(TestMethod("structure_is_found", structure_is_found))
        call suite%addTest(TestMethod("structure_where_l_is_a_number", &
                                      structure_where_l_is_a_number))
        call suite%addTest(TestMethod("constraints_are_kept", constraints_are_kept))
        call suite%addTest(TestMethod("no_inertia_is_not_a_number", no_inertia_is_not_a_number))
        call suite%addTest(TestMethod("descriptions_are_complete", descriptions_are_complete))
        call suite%addTest(TestMethod("audits_hold", audits_hold))
        call suite%addTest(TestMethod("modes_are_found", modes_are_found))
        call suite%addTest(TestMethod("what_an_outline_says_is_kept", what_an_outline_says_is_kept))
        call suite%addTest(moduli_suite())
    end function own_system_suite

    subroutine pendulum_moves_as_by_hand()
        type(own_pendulum_t) :: own
        type(pendulum_t) :: hand

        call compare(own, hand)
    end subroutine pendulum_moves_as_by_hand

    subroutine double_pendulum_moves_as_by_hand()
        type(own_double_t) :: own
        type(double_pendulum_t) :: hand

        call compare(own, hand)
    end subroutine double_pendulum_moves_as_by_hand

    subroutine compare(own, hand)
        !! Accelerations, energy and flags at random parameters and states. Both solve the same
        !! equations; the tolerance is that of some hundred operations behind a mass matrix of
        !! condition up to some hundred.
        class(system_t), intent(inout) :: own, hand
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:), a(:), b(:), values(:)
        real(dp) :: t, scale
        integer :: i

        call restart_random()
        do i = 1, 40
            call draw_parameters(hand, edges=mod(i, 4) == 0)
            values = parameters_of(hand)
            values = values(:size(parameters_of(own)))  ! without the damping that `own` lacks
            call hand%configure(values, error)
            call own%configure(values, error)
            call assertFalse(allocated(error), "parameters")
            if (anyExceptions()) return
            call assertEqual(values, parameters_of(own))
            call assertEqual(hand%ndof, own%ndof)
            call assertTrue(hand%velocity_forces .eqv. own%velocity_forces, "velocity_forces")
            call assertTrue(hand%time_dependent .eqv. own%time_dependent, "time_dependent")
            call draw_state(hand, t, q, v)
            allocate (a(hand%ndof), b(hand%ndof))
            call hand%accelerations(t, q, v, a)
            call own%accelerations(t, q, v, b)
            scale = maxval(abs(a)) + maxval(abs(v))**2
            call assertLessThan(maxval(abs(a - b)), 1e3_dp*epsilon(scale)*scale, &
                                message="accelerations")
            scale = abs(hand%energy(t, q, v)) + 1.0_dp
            call own%momenta(t, q, v, b)
            scale = scale + abs(dot_product(b, v))
            ! up to a constant, which is that of rest at q
            call assertEqual(hand%energy(t, q, v) - hand%energy(t, q, 0.0_dp*v), &
                             own%energy(t, q, v) - own%energy(t, q, 0.0_dp*v), &
                             1e2_dp*epsilon(scale)*scale, "energy")
            deallocate (a, b)
        end do
    end subroutine compare

    function parameters_of(system) result(values)
        !! As the description has them.
        class(system_t), intent(in) :: system
        real(dp), allocatable :: values(:)
        type(description_t) :: d

        call system%describe(d)
        allocate (values, source=default_values(d))
    end function parameters_of

    subroutine structure_is_found()
        !! With the parameters of the moment: without gravity an angle is cyclic, and a pivot at
        !! rest leaves L without the time.
        type(own_pendulum_t) :: pendulum
        type(own_pivot_t) :: pivot
        type(own_double_t) :: double
        type(error_t), allocatable :: error

        call pendulum%configure([0.5_dp, 1.2_dp, 9.81_dp], error)
        call assertEqual(0, pendulum%cyclic)
        call assertFalse(pendulum%velocity_forces .or. pendulum%time_dependent, &
                         "not pendulum%velocity_forces .or. pendulum%time_dependent")
        call pendulum%configure([0.5_dp, 1.2_dp, 0.0_dp], error)
        call assertEqual(1, pendulum%cyclic)
        call pivot%configure([0.3_dp], error)
        call assertTrue(pivot%time_dependent, "moving pivot")
        call assertFalse(pivot%velocity_forces, "forces of a moving pivot")
        call pivot%configure([0.0_dp], error)
        call assertFalse(pivot%time_dependent, "pivot at rest")
        call double%configure([1.0_dp, 2.0_dp, 0.5_dp, 0.7_dp, 9.81_dp], error)
        call assertTrue(double%velocity_forces, "two rods")
        call assertEqual(0, double%cyclic)
    end subroutine structure_is_found

    subroutine structure_where_l_is_a_number()
        !! Even in a corner; where there is no such place, nothing may be relied on.
        type(own_skin_t) :: system
        type(error_t), allocatable :: error
        integer :: k

        do k = 1, 4
            system%kind = k
            call system%configure([real(dp) ::], error)
            call assertEqual(merge(0, 2, k > 2), system%cyclic)
            call assertTrue(system%velocity_forces .eqv. k == 3, "velocity_forces")
            call assertTrue(system%time_dependent .eqv. k == 3, "time_dependent")
        end do
    end subroutine structure_where_l_is_a_number

    subroutine constraints_are_kept()
        !! Down a slope c: \(\ddot x = -g c/(1 + c^2)\), \(\ddot y = c\,\ddot x\).
        type(own_slope_t) :: slope
        type(error_t), allocatable :: error
        real(dp) :: a(2), force(1), q(2), v(2)

        call slope%configure([0.75_dp], error)
        call slope%accelerations(0.0_dp, [0.3_dp, 0.2_dp], [4.0_dp, 3.0_dp], a)
        call assertEqual([-4.8_dp, -3.6_dp], a, 1e-14_dp)
        call slope%multipliers(0.0_dp, [0.3_dp, 0.2_dp], [4.0_dp, 3.0_dp], force)
        call assertEqual([2.0_dp*(10.0_dp - 3.6_dp)], force, 1e-14_dp, "m (y_ddot + g)")
        call slope%complete_velocities(0.0_dp, [0.3_dp, 0.2_dp], [4.0_dp], v, error)
        call assertEqual([4.0_dp, 3.0_dp], v, 1e-15_dp, "y_dot = c x_dot")
        call slope%complete_velocities(0.0_dp, [0.3_dp, 0.2_dp], [4.0_dp, 2.0_dp], v, error)
        call assertTrue(allocated(error), "velocities that leave it")
        if (allocated(error)) call assertEqual( &
            "v does not keep the constraints; give those of x_dot only", error%message)
        call slope%check_places(0.0_dp, [4.0_dp, 4.0_dp], error)
        call assertTrue(allocated(error), "a place beside it")
        q = [4.0_dp, 4.0_dp]
        v = [1.0_dp, 0.0_dp]
        call slope%keep_constraints(0.0_dp, q, v)
        call assertEqual([4.48_dp, 3.36_dp], q, 1e-14_dp, "the nearest place on the slope")
        call assertEqual([0.64_dp, 0.48_dp], v, 1e-15_dp, "and velocity")
        call assertEqual(0, slope%cyclic, "no coordinate is free")
        call assertFalse(slope%constraints_work, "a slope at rest")
    end subroutine constraints_are_kept

    subroutine no_inertia_is_not_a_number()
        !! A mass matrix that is singular gives no accelerations, not wrong ones.
        type(own_double_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: a(2)

        call system%configure([1.0_dp, 2.0_dp, 0.5_dp, 0.7_dp, 9.81_dp], error)
        system%p(4) = 0.0_dp
        call system%accelerations(0.0_dp, [0.3_dp, 0.2_dp], [4.0_dp, 3.0_dp], a)
        call assertTrue(all(ieee_is_nan(a)), "accelerations")
        call system%configure([1.0_dp, 2.0_dp, 0.5_dp, 0.0_dp, 9.81_dp], error)
        call assertTrue(allocated(error), "a length of 0")
        if (.not. allocated(error)) return
        call assertEqual("own_double: l2 = 0.0 is not allowed: greater than 0.0", error%message)
        call assertEqual(0.0_dp, system%p(4), message="and nothing changed")
    end subroutine no_inertia_is_not_a_number

    subroutine descriptions_are_complete()
        !! As those of the lectures' systems, whatever the outline leaves out.
        type(own_pendulum_t) :: pendulum
        type(own_double_t) :: double
        type(own_skin_t) :: skin
        type(description_t) :: d

        call check_description(pendulum)
        call check_refusals(pendulum)
        call check_description(double)
        call check_refusals(double)
        call check_description(skin)
        call pendulum%describe(d)
        call assertEqual(0.5_dp, d%points(1)%mass)
        pendulum%p = [0.7_dp, 1.0_dp, 1.0_dp]
        call pendulum%describe(d)
        call assertEqual(0.7_dp, d%points(1)%mass, message="with the parameters in it")
    end subroutine descriptions_are_complete

    subroutine audits_hold()
        !! Also where L is a number in a corner only; where it is none, that is said.
        type(own_skin_t) :: skin
        type(own_double_t) :: double
        type(own_slope_t) :: slope
        type(ledger_t) :: audit
        integer :: k

        call audit_system(double, audit)
        call audit_system(slope, audit)
        do k = 1, 2
            skin%kind = k
            call audit_system(skin, audit)
        end do
        do k = 1, size(audit%rows)
            associate (row => audit%rows(k))
                call assertTrue(row%holds, trim(row%group)//": "//trim(row%name)//" "// &
                                row%remark)
            end associate
        end do
        call assertEqual(36, size(audit%rows), message="claims")
        skin%kind = 3
        call audit_system(skin, audit)
        associate (row => audit%rows(size(audit%rows)))
            call assertEqual("L is no number at any state tried, such as t = ", row%remark(:47))
        end associate
    end subroutine audits_hold

    subroutine modes_are_found()
        !! \(\omega^2 = g/\ell\).
        type(own_pendulum_t) :: pendulum
        type(modes_t) :: modes
        type(error_t), allocatable :: error

        call pendulum%configure([0.5_dp, 1.2_dp, 9.81_dp], error)
        call find_modes(pendulum, [0.0_dp], .true., modes, error)
        call assertFalse(allocated(error), "no error: modes are found")
        if (allocated(error)) return
        call assertEqual(9.81_dp/1.2_dp, modes%omega2(1), 1e-14_dp)
    end subroutine modes_are_found

    subroutine what_an_outline_says_is_kept()
        !! Its source; but no equilibrium of another size. Of two quantities one has a formula, and
        !! the audit reads it.
        type(sourced_t) :: sourced
        type(own_named_t) :: named
        type(description_t) :: d
        type(error_t), allocatable :: error
        type(ledger_t) :: audit

        call sourced%configure([1.0_dp, 1.0_dp, 1.0_dp], error)
        call sourced%describe(d)
        call assertEqual("a book", trim(d%source))
        call assertEqual([0.0_dp], likely_equilibrium(sourced), tolerance=0.0_dp, &
                         message="two values for one coordinate")
        named%more = [quantity("one", "rad", "the angle", "theta"), &
                      quantity("two", "rad", "another")]
        call named%configure([1.0_dp, 1.0_dp, 1.0_dp], error)
        call audit_system(named, audit)
        call assertTrue(audit%row_of("one as printed") > 0, &
                        "a formula among the quantities is read")
    end subroutine what_an_outline_says_is_kept

    pure subroutine sourced_outline(self, d)
        !! The pendulum's, and more.
        class(sourced_t), intent(in) :: self
        type(description_t), intent(out) :: d

        call self%own_pendulum_t%outline(d)
        d%source = "a book"
        d%equilibrium = [1.0_dp, 2.0_dp]
    end subroutine sourced_outline
end module test_own_system
