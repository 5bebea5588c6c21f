module test_library_arguments
    !! What a program may hand to the library by mistake: each is an error, none a crash.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_positive_inf, ieee_quiet_nan, &
                                             ieee_value
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia, only: dp, error_t, find_modes, i8, integrator_t, modes_t, new_integrator, &
                         new_system, normal_modes, normal_modes_t, observer_box_t, residual_ratio, &
                         system_t
    use lagrangia_audit, only: audit_system
    use lagrangia_audit_structure, only: audit_mass
    use lagrangia_errors, only: status_library, status_numbers, status_usage
    use lagrangia_lagrange, only: accelerations_from_lagrangian
    use lagrangia_ledger, only: ledger_t
    use lagrangia_run, only: run
    use lagrangia_time_grid, only: new_sample_times, new_time_grid, time_grid_t
    use singular_systems, only: blind_t, fading_t, light_rod_t, light_t, skew_t, steep_t
    implicit none (type, external)
    private
    public :: library_arguments_suite, refused

contains

    function library_arguments_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("library_arguments")
        call suite%addTest(TestMethod("plans_of_nonsense", plans_of_nonsense))
        call suite%addTest(TestMethod("sampled_plans_of_nonsense", sampled_plans_of_nonsense))
        call suite%addTest(TestMethod("states_of_another_size", states_of_another_size))
        call suite%addTest(TestMethod("systems_without_parameters", systems_without_parameters))
        call suite%addTest(TestMethod("matrices_of_nonsense", matrices_of_nonsense))
        call suite%addTest(TestMethod("singular_mass_matrices", singular_mass_matrices))
        call suite%addTest(TestMethod("a_lagrangian_of_nan", a_lagrangian_of_nan))
        call suite%addTest(TestMethod("a_mass_that_fades", a_mass_that_fades))
        call suite%addTest(TestMethod("the_audit_names_the_mass_matrix", &
                                      the_audit_names_the_mass_matrix))
        call suite%addTest(TestMethod("a_rolling_run_goes_on", a_rolling_run_goes_on))
    end function library_arguments_suite

    subroutine refused(error, message, status)
        !! An error in just these words.
        type(error_t), allocatable, intent(in) :: error
        character(*), intent(in) :: message
        integer, intent(in) :: status

        call assertTrue(allocated(error), message="not refused: "//message)
        if (.not. allocated(error)) return
        call assertEqual(message, error%message)
        call assertEqual(status, error%status, message=message)
    end subroutine refused

    subroutine plans_of_nonsense()
        !! NaN, infinite, zero and negative in each place.
        real(dp) :: nan, inf

        nan = ieee_value(nan, ieee_quiet_nan)
        inf = ieee_value(inf, ieee_positive_inf)
        call no_plan(nan, 0.1_dp, 1.0_dp, 1_i8, "t0", "must be finite, not nan")
        call no_plan(inf, 0.1_dp, 1.0_dp, 1_i8, "t0", "must be finite, not inf")
        call no_plan(0.0_dp, nan, 1.0_dp, 1_i8, "dt", "must be positive and finite, not nan")
        call no_plan(0.0_dp, inf, 1.0_dp, 1_i8, "dt", "must be positive and finite, not inf")
        call no_plan(0.0_dp, 0.0_dp, 1.0_dp, 1_i8, "dt", "must be positive and finite, not 0.0")
        call no_plan(0.0_dp, -0.1_dp, 1.0_dp, 1_i8, "dt", "must be positive and finite, not -0.1")
        call no_plan(0.0_dp, 0.1_dp, nan, 1_i8, "duration", &
                     "must be finite and not negative, not nan")
        call no_plan(0.0_dp, 0.1_dp, inf, 1_i8, "duration", &
                     "must be finite and not negative, not inf")
        call no_plan(0.0_dp, 0.1_dp, -1.0_dp, 1_i8, "duration", &
                     "must be finite and not negative, not -1.0")
        call no_plan(0.0_dp, 0.1_dp, 1.0_dp, 0_i8, "every", "must be at least 1, not 0")
        call no_plan(0.0_dp, 0.1_dp, 1.0_dp, -3_i8, "every", "must be at least 1, not -3")
    end subroutine plans_of_nonsense

    subroutine no_plan(t0, dt, duration, every, key, message)
        !! Refused, and `key` is to blame.
        real(dp), intent(in) :: t0, dt, duration
        integer(i8), intent(in) :: every
        character(*), intent(in) :: key, message
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error

        call new_time_grid(plan, t0, dt, duration, every, error)
        call refused(error, message, status_usage)
        if (allocated(error)) call assertEqual(key, error%key)
    end subroutine no_plan

    subroutine sampled_plans_of_nonsense()
        !! The same where the method chooses its steps.
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error

        call new_sample_times(plan, 0.0_dp, 1.0_dp, 0_i8, error)
        call refused(error, "must be at least 1, not 0", status_usage)
        call new_sample_times(plan, 0.0_dp, -1.0_dp, 10_i8, error)
        call refused(error, "must be finite and not negative, not -1.0", status_usage)
        call new_sample_times(plan, ieee_value(1.0_dp, ieee_quiet_nan), 1.0_dp, 10_i8, error)
        call refused(error, "must be finite, not nan", status_usage)
    end subroutine sampled_plans_of_nonsense

    subroutine try_run(system, q, v, error)
        !! A run of ten steps of rk4.
        class(system_t), intent(in) :: system
        real(dp), intent(inout) :: q(:), v(:)
        type(error_t), allocatable, intent(out) :: error
        class(integrator_t), allocatable :: integrator
        type(observer_box_t) :: nobody(0)
        type(time_grid_t) :: plan

        call new_integrator("rk4", integrator, error)
        if (.not. allocated(error)) call new_time_grid(plan, 0.0_dp, 1e-2_dp, 0.1_dp, 1_i8, error)
        if (.not. allocated(error)) call run(system, integrator, plan, nobody, q, v, error)
    end subroutine try_run

    subroutine states_of_another_size()
        !! Too short, too long, empty; a plan whose parts were set by hand.
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: integrator
        type(observer_box_t) :: nobody(0)
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error
        real(dp) :: q(3), v(3)

        call new_system("cart_pendulum", system, error)
        call system%configure([2.0_dp, 1.0_dp, 1.0_dp, 9.81_dp], error)
        call assertFalse(allocated(error), message="configured")
        q = 0.5_dp
        v = 0.0_dp
        call try_run(system, q(:1), v(:2), error)
        call refused(error, "q has 1 value; the system has 2 coordinates", status_usage)
        call try_run(system, q(:2), v, error)
        call refused(error, "v has 3 values; the system has 2 velocities", status_usage)
        call try_run(system, q(:0), v(:2), error)
        call refused(error, "q has 0 values; the system has 2 coordinates", status_usage)
        call try_run(system, q(:2), v(:2), error)
        call assertFalse(allocated(error), message="of the right size")
        call new_integrator("rk4", integrator, error)
        plan%every = 0
        plan%steps = 10
        plan%dt = 0.1_dp
        call run(system, integrator, plan, nobody, q(:2), v(:2), error)
        call refused(error, "the time grid is not one of new_time_grid", status_usage)
    end subroutine states_of_another_size

    subroutine systems_without_parameters()
        !! An object that nobody configured.
        type(blind_t) :: own
        type(modes_t) :: modes
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2)

        q = 0.5_dp
        v = 0.0_dp
        call try_run(own, q, v, error)
        call refused(error, "the system has no coordinates: configure it first", status_usage)
        call find_modes(own, q, .true., modes, error)
        call refused(error, "the system has no coordinates: configure it first", status_usage)
    end subroutine systems_without_parameters

    subroutine matrices_of_nonsense()
        !! Not square, empty, of two sizes, NaN, not symmetric, indefinite.
        type(normal_modes_t) :: modes
        type(error_t), allocatable :: error
        real(dp) :: one(2, 2), k(2, 2)

        one = reshape([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], [2, 2])
        call normal_modes(reshape([1.0_dp, 2.0_dp], [1, 2]), one, modes, error)
        call refused(error, "K is 1 by 2: a square matrix is needed", status_usage)
        call normal_modes(one(:0, :0), one(:0, :0), modes, error)
        call refused(error, "K is 0 by 0: a square matrix is needed", status_usage)
        call normal_modes(one, one(:1, :1), modes, error)
        call refused(error, "K has 2 rows, M has 1", status_usage)
        k = one
        k(2, 2) = ieee_value(1.0_dp, ieee_quiet_nan)
        call normal_modes(k, one, modes, error)
        call refused(error, "K(2, 2) is not finite", status_usage)
        call normal_modes(one, -one, modes, error)
        call refused(error, "M is not positive definite: its leading minor of order 1 is not", &
                     status_library)
        call assertFalse(allocated(modes%omega2), message="nothing of a failure is left")
        call normal_modes(2.0_dp*one, one, modes, error)
        call assertFalse(allocated(error), message="K and M that fit")
        call assertFalse(ieee_is_nan(residual_ratio(2.0_dp*one, one, modes%omega2, modes%shapes)), &
                         message="of K and M that fit")
        call assertTrue(ieee_is_nan(residual_ratio(one(:1, :), one, modes%omega2, modes%shapes)), &
                        message="K has another size")
        call assertTrue(ieee_is_nan(residual_ratio(one, one(:, :1), modes%omega2, modes%shapes)), &
                        message="M has another size")
        call assertTrue(ieee_is_nan(residual_ratio(one, one, modes%omega2(:1), modes%shapes)), &
                        message="there are too few omega^2")
        call assertTrue(ieee_is_nan(residual_ratio(one, one, modes%omega2, modes%shapes(:, :1))), &
                        message="there are too few modes")
    end subroutine matrices_of_nonsense

    subroutine singular_mass_matrices()
        !! Named by `run` and by `find_modes`, with the state and the eigenvalue.
        type(light_t) :: light
        type(skew_t) :: skew
        type(modes_t) :: modes
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2)

        q = [0.0_dp, 0.5_dp]
        v = [0.25_dp, 0.0_dp]
        call light%configure([real(dp) ::], error)
        call assertFalse(light%time_dependent, message="L does not contain the time")
        call try_run(light, q, v, error)
        call refused(error, "at t = 0.0, q = 0.0, 0.5, v = 0.25, 0.0: the mass matrix d2L/dv "// &
                     "dv is singular: it has the eigenvalue 0.0 beside 1.0", status_library)
        call find_modes(light, [0.0_dp, 0.0_dp], .true., modes, error)
        call refused(error, "at q = 0.0, 0.0, v = 0: the mass matrix d2L/dv dv is singular: it "// &
                     "has the eigenvalue 0.0 beside 1.0", status_library)
        call skew%configure([real(dp) ::], error)
        call try_run(skew, q, v, error)
        call refused(error, "at t = 0.0, q = 0.0, 0.5, v = 0.25, 0.0: the mass matrix d2L/dv "// &
                     "dv is not positive definite: it has the eigenvalue -1.0", status_library)
    end subroutine singular_mass_matrices

    subroutine a_lagrangian_of_nan()
        !! Refused by `run` although its accelerations, by hand, are numbers; so is one of whose
        !! derivatives one is infinite.
        type(blind_t) :: blind
        type(steep_t) :: steep
        type(modes_t) :: modes
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2)

        q = 0.0_dp
        v = 0.0_dp
        call blind%configure([real(dp) ::], error)
        call try_run(blind, q, v, error)
        call refused(error, "at t = 0.0, q = 0.0, 0.0, v = 0.0, 0.0: the Lagrangian is not a "// &
                     "finite number", status_numbers)
        call find_modes(blind, q, .true., modes, error)
        call assertTrue(allocated(error), message="modes of NaN")
        call steep%configure([real(dp) ::], error)
        call try_run(steep, q, v, error)
        call assertFalse(allocated(error), message="no force at 0")
        q(1) = 1e-60_dp
        call try_run(steep, q, v, error)
        call refused(error, "at t = 0.0, q = 1e-60, 0.0, v = 0.0, 0.0: a derivative of the "// &
                     "Lagrangian is not finite", status_numbers)
    end subroutine a_lagrangian_of_nan

    subroutine a_mass_that_fades()
        !! The mass matrix is singular where a run arrives: said, with the place, by steps and by
        !! a method that chooses them. Another run of the same system just ends.
        type(fading_t) :: fading
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2)

        call fading%configure([real(dp) ::], error)
        q = [0.0_dp, 0.0_dp]
        v = [1.0_dp, 0.0_dp]
        call try_run(fading, q, v, error)
        call assertFalse(allocated(error), message="x stays below 1")
        q = [0.97_dp, 0.0_dp]
        v = [1.0_dp, 0.0_dp]
        call try_run(fading, q, v, error)
        call assertTrue(allocated(error), message="x comes to 1")
        if (.not. allocated(error)) return
        call assertEqual(status_numbers, error%status, message=error%message)
        call assertTrue(index(error%message, "the state is not finite at t = ") == 1, &
                        message=error%message)
        call assertTrue(index(error%message, "the mass matrix d2L/dv dv is ") > 0 .and. &
                        index(error%message, ", q = ") > 0, message=error%message)
    end subroutine a_mass_that_fades

    subroutine the_audit_names_the_mass_matrix()
        !! `check` says of each what is wrong with it, and at which state.
        type(light_t) :: light
        type(light_rod_t) :: rod
        type(skew_t) :: skew
        type(blind_t) :: blind
        type(ledger_t) :: audit
        type(error_t), allocatable :: error
        real(dp) :: a(2), force(1)

        call audit_system(light, audit)
        call remarked(audit, "mass matrix is positive definite", &
                      ": the mass matrix d2L/dv dv is singular: it has the eigenvalue 0.0 "// &
                      "beside 1.0")
        call remarked(audit, "accelerations as from L", &
                      ": the mass matrix d2L/dv dv is singular: it has the eigenvalue 0.0 "// &
                      "beside 1.0")
        ! a constraint gives y the mass of x
        call rod%configure([real(dp) ::], error)
        rod%constraints = 1
        audit = ledger_t()
        call audit_mass(audit, rod, 0.0_dp, [0.25_dp, 0.5_dp], [0.5_dp, 1.0_dp])
        call assertTrue(audit%rows(1)%holds, message="a light end of a rod has a mass matrix")
        call accelerations_from_lagrangian(rod, 0.0_dp, [0.25_dp, 0.5_dp], [0.5_dp, 1.0_dp], a, &
                                           force, error)
        call assertEqual([-1.25_dp, -2.5_dp], a, 4*epsilon(a), message="and accelerations")
        audit = ledger_t()
        call audit_system(skew, audit)
        call remarked(audit, "mass matrix is positive definite", ": the mass matrix d2L/dv dv "// &
                      "is not positive definite: it has the eigenvalue -1.0")
        audit = ledger_t()
        call audit_system(blind, audit)
        call remarked(audit, "parameters and states are taken", "L is no number at any state tried")
    end subroutine the_audit_names_the_mass_matrix

    subroutine remarked(audit, claim, words)
        !! The claim does not hold, and these words are behind the state.
        type(ledger_t), intent(in) :: audit
        character(*), intent(in) :: claim, words
        integer :: row

        row = audit%row_of(claim)
        call assertTrue(row > 0, message=claim//" is judged")
        if (row == 0) return
        associate (finding => audit%rows(row))
            call assertFalse(finding%holds, message=claim)
            call assertTrue(index(finding%remark, "q = ") > 0 .and. &
                            index(finding%remark, words) > 0, message=finding%remark)
        end associate
    end subroutine remarked

    subroutine a_rolling_run_goes_on()
        !! The end of a run of rk4 down an incline is a start; a slip of 1e-6 is none.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp) :: q(4), v(4), again(4), slip

        call new_system("rolling_disk", system, error)
        call system%configure([1.0_dp, 0.5_dp, 0.125_dp, 0.0625_dp, 9.81_dp, 0.3_dp], error)
        call assertFalse(allocated(error), message="configured")
        q = [0.0_dp, 0.0_dp, 0.0_dp, 0.4_dp]
        call system%complete_velocities(0.0_dp, q, [2.0_dp, 1.5_dp], v, error)
        call try_run(system, q, v, error)
        call assertFalse(allocated(error), message="ran")
        slip = abs(v(1) - 0.5_dp*sin(q(4))*v(3))
        call assertTrue(slip > 16*epsilon(slip)*norm2(v), message="the method lets it slip")
        call system%complete_velocities(0.1_dp, q, v, again, error)
        call assertFalse(allocated(error), message="a run's end is a start")
        call assertEqual(v, again, message="kept as it is")
        v(1) = v(1) + 1e-6_dp
        call system%complete_velocities(0.1_dp, q, v, again, error)
        call assertTrue(allocated(error), message="this slips")
    end subroutine a_rolling_run_goes_on
end module test_library_arguments
