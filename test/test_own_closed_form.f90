module test_own_closed_form
    !! An own system brings its closed form: with it come `error`, `exact` and the choice of `auto`.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertLessThan, assertTrue
    use lagrangia_catalogue, only: new_system, register_system, system_names
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_kinds, only: dp
    use lagrangia_outcome, only: from_closed_form, from_steps, outcome_t
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: system_t
    use own_closed_forms, only: own_drag_t, own_plane_t, own_spring_t, undefined, wrong_motion, &
                                wrong_size, wrong_start
    use own_reductions, only: own_trough_t
    use scene_runs, only: perform
    implicit none (type, external)
    private
    public :: own_closed_form_suite

    character(*), parameter :: start = "&scene system = 'own_spring', q = 0.3, v = 0.1, "// &
        " dt = 1e-3, every = 100, columns = 't', 'x', 'error', "

contains

    function own_closed_form_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("own_closed_form")
        call suite%addTest(TestMethod("wrong_ones_are_refused", wrong_ones_are_refused))
        call suite%addTest(TestMethod("one_wrong_coordinate_is_enough", &
                                      one_wrong_coordinate_is_enough))
        call suite%addTest(TestMethod("none_is_needed", none_is_needed))
        call suite%addTest(TestMethod("it_is_the_measure_of_errors", it_is_the_measure_of_errors))
        call suite%addTest(TestMethod("auto_takes_it", auto_takes_it))
        call suite%addTest(TestMethod("its_period_is_expected", its_period_is_expected))
        call suite%addTest(TestMethod("a_reduced_system_is_used", a_reduced_system_is_used))
    end function own_closed_form_suite

    subroutine refused(system, beginning)
        !! It may not join, for a reason that begins so.
        class(system_t), intent(in) :: system
        character(*), intent(in) :: beginning
        type(error_t), allocatable :: error

        call register_system(system, error)
        call assertTrue(allocated(error), "refused: "//beginning)
        if (.not. allocated(error)) return
        call assertEqual(beginning, error%message(:min(len(beginning), len(error%message))))
        call assertEqual(status_usage, error%status)
    end subroutine refused

    subroutine wrong_ones_are_refused()
        !! A number of coordinates, a start, a frequency that is 1e-4 too high, also where all is
        !! small; and equations with a drag of 1e-3 that the inherited closed form knows nothing of.
        character(*), parameter :: disobeys = &
            "its closed form does not obey the equations of motion at "

        call refused(own_spring_t(kind=wrong_size), &
                     "system 'own_spring': its closed form has ndof = 2, and not 1")
        call refused(own_spring_t(kind=wrong_start), &
                     "system 'own_spring': its closed form has the motion from t = ")
        call refused(own_spring_t(kind=wrong_motion), &
                     "system 'own_spring': "//disobeys)
        call refused(own_spring_t(kind=wrong_motion, place=1e-4_dp), &
                     "system 'own_spring': "//disobeys)
        call refused(own_trough_t(slip=1e-3_dp), "system 'own_trough': its reduced system does "// &
                     "not obey the equations of motion at ")
        call refused(own_drag_t(), "system 'own_drag': "//disobeys)
        call assertFalse(any(system_names() == "own_spring"), "nobody joined")
    end subroutine wrong_ones_are_refused

    subroutine one_wrong_coordinate_is_enough()
        !! The other is right.
        integer :: k

        do k = 1, 2
            call refused(own_plane_t(wrong=k, kind=wrong_start), &
                         "system 'own_plane': its closed form has the motion from t = ")
            call refused(own_plane_t(wrong=k, kind=wrong_motion), &
                         "system 'own_plane': its closed form does not obey the equations of ")
        end do
        call assertFalse(any(system_names() == "own_plane"), "nobody joined")
    end subroutine one_wrong_coordinate_is_enough

    subroutine none_is_needed()
        !! A binding that leaves `reference` unallocated is like none.
        type(own_spring_t) :: spring
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error

        spring%kind = undefined
        call spring%configure([2.0_dp, 5.0_dp], error)
        call spring%closed_form(0.0_dp, [0.3_dp], [0.1_dp], reference)
        call assertFalse(allocated(reference), "none")
    end subroutine none_is_needed

    subroutine join_once()
        !! The spring is in the catalogue.
        type(error_t), allocatable :: error
        class(system_t), allocatable :: system

        call new_system("own_spring", system, error)
        if (.not. allocated(error)) return
        call register_system(own_spring_t(), error)
        call assertFalse(allocated(error), "it may join")
    end subroutine join_once

    subroutine run_by(more, outcome)
        !! The scene by `more`, which names the method and what else there is.
        character(*), intent(in) :: more
        type(outcome_t), intent(out) :: outcome
        type(error_t), allocatable :: error

        call join_once()
        call perform(start//more//" /", "", "text", outcome, error)
        call assertFalse(allocated(error), more)
    end subroutine run_by

    subroutine it_is_the_measure_of_errors()
        !! Of rk4: (omega dt)^5/120 a step, 2000 steps, so 4e-15*2000*0.3; and of a long step, seen.
        type(outcome_t) :: outcome

        call run_by("duration = 2.0, method = 'rk4'", outcome)
        if (anyExceptions()) return
        call assertEqual(from_closed_form, outcome%error_from)
        call assertLessThan(outcome%error(), 4e-12_dp, message="small")
        call run_by("duration = 2.0, method = 'verlet'", outcome)
        call assertGreaterThan(outcome%error(), 1e-9_dp, message="of verlet")
        call assertLessThan(outcome%error(), 1e-6_dp, message="of verlet")
    end subroutine it_is_the_measure_of_errors

    subroutine auto_takes_it()
        !! No steps; the last state is that of the closed form, the error that of steps.
        type(outcome_t) :: outcome
        real(dp) :: omega

        call run_by("duration = 2.0, method = 'auto'", outcome)
        if (anyExceptions()) return
        omega = sqrt(2.5_dp)
        call assertEqual("auto took exact: closed form: own turns", outcome%choice)
        call assertEqual("exact", outcome%method)
        call assertEqual([0, 0], int([outcome%steps, outcome%evaluations]))
        call assertEqual(from_steps, outcome%error_from)
        call assertLessThan(outcome%error(), 1e-13_dp, message="against steps")
        call assertEqual(0.3_dp*cos(2.0_dp*omega) + 0.1_dp/omega*sin(2.0_dp*omega), &
                         outcome%q(1), 4.0_dp*epsilon(1.0_dp), "where it ends")
    end subroutine auto_takes_it

    subroutine its_period_is_expected()
        !! The scene may claim it.
        type(outcome_t) :: outcome

        call run_by("duration = 20.0, method = 'rk4', period_of = 'x', expect_period = 1e-8", &
                    outcome)
    end subroutine its_period_is_expected

    subroutine a_reduced_system_is_used()
        !! By gauss16, which says so: \(y\) turns, and x + y goes on at 1.1 m/s.
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        real(dp) :: omega, y

        call register_system(own_trough_t(), error)
        call assertFalse(allocated(error), "it may join")
        call perform("&scene system = 'own_trough', method = 'gauss16', q = 0.2, 0.3, "// &
                     "v = 1.0, 0.1, dt = 0.05, duration = 2.0, columns = 't', 'x' /", "", "text", &
                     outcome, error)
        call assertFalse(allocated(error), "it runs")
        if (anyExceptions()) return
        omega = sqrt(2.5_dp)
        y = 0.3_dp*cos(2.0_dp*omega) + 0.1_dp/omega*sin(2.0_dp*omega)
        call assertEqual([0.5_dp + 2.0_dp*1.1_dp - y, y], outcome%q, 1e-14_dp, "where it ends")
        call assertEqual(" (the cyclic coordinate from its momentum)", outcome%remark)
    end subroutine a_reduced_system_is_used
end module test_own_closed_form
