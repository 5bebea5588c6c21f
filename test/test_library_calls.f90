module test_library_calls
    !! Calls in the wrong order, empty boxes, arrays of another size: NaN, or an error where
    !! there is a place for one.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_positive_inf, ieee_quiet_nan, &
                                             ieee_value
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia, only: accelerations_from_lagrangian, default_values, dense_integrator_t, &
                         description_t, dp, energy_from_lagrangian, error_t, euler_lagrange_t, &
                         expand_lagrangian, i8, integrator_t, new_integrator, new_system, &
                         observer_box_t, recorder_t, system_t
    use lagrangia_dense_run, only: drive, run_dense
    use lagrangia_errors, only: status_usage
    use lagrangia_events, only: event_box_t
    use lagrangia_methods, only: nth_adaptive
    use lagrangia_run, only: run
    use lagrangia_stepwise, only: new_stepwise, stepwise_t
    use lagrangia_time_grid, only: new_sample_times, new_time_grid, time_grid_t
    use singular_systems, only: blind_t
    use test_library_arguments, only: refused
    implicit none (type, external)
    private
    public :: library_calls_suite

contains

    function library_calls_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("library_calls")
        call suite%addTest(TestMethod("lagrangians_of_another_size", lagrangians_of_another_size))
        call suite%addTest(TestMethod("empty_boxes", empty_boxes))
        call suite%addTest(TestMethod("dense_runs_of_nonsense", dense_runs_of_nonsense))
        call suite%addTest(TestMethod("steps_of_nonsense", steps_of_nonsense))
        call suite%addTest(TestMethod("a_description_without_parameters", &
                                      a_description_without_parameters))
    end function library_calls_suite

    subroutine lagrangians_of_another_size()
        !! States too short and too long, a system that nobody configured: NaN, and an error where
        !! there is a place for one. A state that fits gives numbers.
        class(system_t), allocatable :: system
        type(blind_t) :: own
        type(error_t), allocatable :: error
        type(euler_lagrange_t) :: terms
        real(dp) :: q(3), v(3), a(3), none(0), one(1)
        integer :: n

        q = 0.5_dp
        v = 0.25_dp
        call accelerations_from_lagrangian(own, 0.0_dp, none, none, a(:0), q(:0), error)
        call refused(error, "the system has no coordinates: configure it first", status_usage)
        call assertTrue(ieee_is_nan(energy_from_lagrangian(own, 0.0_dp, none, none)), &
                        message="energy of nothing")
        call new_system("cart_pendulum", system, error)
        call system%configure([2.0_dp, 1.0_dp, 1.0_dp, 9.81_dp], error)
        do n = 1, 3
            call expand_lagrangian(system, 0.0_dp, q(:n), v(:2), terms)
            call assertTrue(ieee_is_nan(terms%l) .neqv. n == 2, message="L")
            call assertTrue(all(ieee_is_nan([terms%dl_dt, terms%dl_dq, terms%dl_dv, terms%mass, &
                                             terms%force]) .neqv. n == 2), message="derivatives")
            call assertTrue(ieee_is_nan(energy_from_lagrangian(system, 0.0_dp, q(:2), v(:n))) &
                            .neqv. n == 2, message="energy")
            call accelerations_from_lagrangian(system, 0.0_dp, q(:2), v(:2), a(:n), none, error)
            call assertTrue(allocated(error) .neqv. n == 2, message="accelerations")
        end do
        call refused(error, "there are 2 accelerations and 0 multipliers, not 3 and 0", &
                     status_usage)
        call accelerations_from_lagrangian(system, 0.0_dp, q(:2), v(:2), a(:2), one, error)
        call refused(error, "there are 2 accelerations and 0 multipliers, not 2 and 1", &
                     status_usage)
        call accelerations_from_lagrangian(system, 0.0_dp, q, v(:2), a(:2), none, error)
        call refused(error, "q has 3 values; the system has 2 coordinates", status_usage)
        call accelerations_from_lagrangian(system, 0.0_dp, q(:2), v(:1), a(:2), none, error)
        call refused(error, "v has 1 value; the system has 2 velocities", status_usage)
    end subroutine lagrangians_of_another_size

    subroutine empty_boxes()
        !! An observer's box that points to nobody.
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: integrator
        class(dense_integrator_t), allocatable :: dense
        type(recorder_t), target :: somebody
        type(observer_box_t) :: boxes(2)
        type(event_box_t) :: events(1)
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), ended

        call new_system("oscillator", system, error)
        call system%configure([1.0_dp, 1.0_dp], error)
        call new_integrator("rk4", integrator, error)
        call new_time_grid(plan, 0.0_dp, 0.1_dp, 1.0_dp, 1_i8, error)
        boxes(1)%item => somebody
        q = 1.0_dp
        v = 0.0_dp
        call run(system, integrator, plan, boxes, q, v, error)
        call refused(error, "observer 2 is an empty box: let its item point to one", status_usage)
        call nth_adaptive(1, dense)
        call run_dense(system, dense, plan, events(:0), boxes, q, v, ended, error)
        call refused(error, "observer 2 is an empty box: let its item point to one", status_usage)
        call run_dense(system, dense, plan, events, boxes(:1), q, v, ended, error)
        call refused(error, "event 1 is an empty box: allocate its item", status_usage)
        call run_dense(system, dense, plan, events(:0), boxes(:1), q, v, ended, error)
        call assertFalse(allocated(error), message="nothing is empty")
    end subroutine empty_boxes

    subroutine dense_runs_of_nonsense()
        !! A plan whose parts were set by hand; samples that the method has no state for.
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: integrator
        class(dense_integrator_t), allocatable :: dense
        type(observer_box_t) :: nobody(0)
        type(event_box_t) :: events(0)
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), both(2), ended

        call new_system("oscillator", system, error)
        call system%configure([1.0_dp, 1.0_dp], error)
        q = 1.0_dp
        v = 0.0_dp
        both = 0.0_dp
        plan%every = 0
        plan%steps = 10
        plan%dt = 0.1_dp
        call nth_adaptive(1, dense)
        call run_dense(system, dense, plan, events, nobody, q, v, ended, error)
        call refused(error, "the time grid is not one of new_time_grid", status_usage)
        call run_dense(system, dense, plan, events, nobody, q, both, ended, error)
        call refused(error, "v has 2 values; the system has 1 velocity", status_usage)
        call new_sample_times(plan, 0.0_dp, 1.0_dp, 10_i8, error)
        call new_integrator("rk4", integrator, error)
        call drive(system, integrator, plan, events, nobody, q, v, ended, error)
        call refused(error, "rk4 has no dense output, which samples at equal times and events "// &
                     "need: new_stepwise gives it one", status_usage)
    end subroutine dense_runs_of_nonsense

    subroutine steps_of_nonsense()
        !! A dense method whose step is no length.
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: integrator
        type(stepwise_t) :: steps
        type(error_t), allocatable :: error

        call new_system("oscillator", system, error)
        call system%configure([1.0_dp, 1.0_dp], error)
        call new_integrator("rk4", integrator, error)
        call new_stepwise(steps, integrator, 0.0_dp)
        call steps%prepare(system, error)
        call refused(error, "must be positive and finite, not 0.0", status_usage)
        call new_stepwise(steps, integrator, -0.1_dp)
        call steps%prepare(system, error)
        call refused(error, "must be positive and finite, not -0.1", status_usage)
        call new_stepwise(steps, integrator, ieee_value(1.0_dp, ieee_quiet_nan))
        call steps%prepare(system, error)
        call refused(error, "must be positive and finite, not nan", status_usage)
        call new_stepwise(steps, integrator, ieee_value(1.0_dp, ieee_positive_inf))
        call steps%prepare(system, error)
        call refused(error, "must be positive and finite, not inf", status_usage)
        call new_stepwise(steps, integrator, 0.1_dp)
        call steps%prepare(system, error)
        call assertFalse(allocated(error), message="a step")
    end subroutine steps_of_nonsense

    subroutine a_description_without_parameters()
        !! That nobody filled in.
        type(description_t) :: nothing

        call assertEqual(0, size(default_values(nothing)), "no values")
    end subroutine a_description_without_parameters
end module test_library_calls
