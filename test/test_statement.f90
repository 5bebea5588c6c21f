module test_statement
    !! What a scene prints of its error, and when it cannot be had.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertGreaterThan, &
                     assertLessThan, assertTrue
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_final_values, only: final_value_t, final_values_line
    use lagrangia_kinds, only: dp
    use lagrangia_outcome, only: outcome_json, outcome_t
    use lagrangia_scene, only: scene_line_length, scene_lines, scene_t
    use lagrangia_system, only: system_t
    use scene_runs, only: plan_and_run, read_and_plan
    implicit none (type, external)
    private
    public :: statement_suite

contains

    function statement_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("statement")
        call suite%addTest(TestMethod("chaos_leaves_no_digit", chaos_leaves_no_digit))
        call suite%addTest(TestMethod("a_short_force_is_not_stepped_over", &
                                      a_short_force_is_not_stepped_over))
        call suite%addTest(TestMethod("at_a_saddle_errors_are_as_large", &
                                      at_a_saddle_errors_are_as_large))
        call suite%addTest(TestMethod("the_time_of_an_event_has_an_error", &
                                      the_time_of_an_event_has_an_error))
        call suite%addTest(TestMethod("a_finer_step_that_cannot_be_is_refused", &
                                      a_finer_step_that_cannot_be_is_refused))
        call suite%addTest(TestMethod("the_state_is_text_and_json", the_state_is_text_and_json))
        call suite%addTest(TestMethod("the_key_is_read_and_echoed", the_key_is_read_and_echoed))
    end function statement_suite

    subroutine perform(text, overrides, outcome, error)
        !! The scene in `text`, from beginning to end.
        character(*), intent(in) :: text
        type(word_t), intent(in) :: overrides(:)
        type(outcome_t), intent(out) :: outcome
        type(error_t), allocatable, intent(out) :: error
        class(system_t), allocatable :: system
        type(scene_t) :: scene

        call read_and_plan(text, "a.nml", overrides, scene, system, error)
        if (allocated(error)) return
        call plan_and_run(scene, system, outcome, error)
    end subroutine perform

    pure function one(text) result(words)
        !! One override; gfortran 12 loses the memory of an array constructor's.
        character(*), intent(in) :: text
        type(word_t) :: words(1)

        words(1)%text = text
    end function one

    subroutine chaos_leaves_no_digit()
        !! After 60 s of a double pendulum, rounding alone has grown to the size of the motion,
        !! by either method; after 3 s there are digits.
        character(*), parameter :: swing = "&scene system = 'double_pendulum', q = 2.0, 1.0, "// &
            "dt = 0.02, duration = 60, error_estimate = .true. /"
        character(*), parameter :: adaptive = "&scene system = 'double_pendulum', "// &
            "q = 2.0, 1.0, method = 'dop853', tolerance = 1e-11, duration = 60, "// &
            "error_estimate = .true. /"
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call perform(swing, one("scene%duration=3"), outcome, error)
        call assertTrue(all(outcome%state%resolved()), "3 s")
        call perform(swing, [word_t ::], outcome, error)
        call assertFalse(any(outcome%state%resolved()), final_values_line(outcome%state))
        call perform(adaptive, [word_t ::], outcome, error)
        call assertFalse(any(outcome%state%resolved()), final_values_line(outcome%state))
    end subroutine chaos_leaves_no_digit

    subroutine a_short_force_is_not_stepped_over()
        !! A hill that stops the mass at 5 m, a blow after 5 s: both last a thousandth of the time,
        !! and no step of an adaptive method sees them.
        character(*), parameter :: hill = "&scene system = 'own', tolerance = 1e-10, "// &
            "duration = 10.0, q = 0.0, v = 1.0, error_estimate = .true. / "// &
            "&lagrangian coordinates = 'x', T = '1/2 x_dot^2', "// &
            "V = '10 exp(-((x - 5)/1e-3)^2)' /"
        character(*), parameter :: blow = "&scene system = 'own', tolerance = 1e-10, "// &
            "duration = 10.0, q = 0.0, v = 0.3, error_estimate = .true. / "// &
            "&lagrangian coordinates = 'x', T = '1/2 x_dot^2', "// &
            "Q_x = '1e3 exp(-((t - 5)/1e-3)^2)' /"
        character(8), parameter :: methods(2) = [character(8) :: "dop853", "gauss16"]
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, size(methods)
            call perform(hill, one("scene%method="//trim(methods(i))), outcome, error)
            call assertFalse(allocated(error), "it runs")
            if (allocated(error)) return
            call assertGreaterThan(outcome%state(2)%error, &
                                   abs(outcome%state(2)%value + 1.0_dp), message="it turns back")
            call perform(blow, one("scene%method="//trim(methods(i))), outcome, error)
            call assertGreaterThan(outcome%state(1)%error, abs(outcome%state(1)%value - 3.0_dp &
                                   - 5.0_dp*sqrt(acos(-1.0_dp))), message="it is hit")
        end do
    end subroutine a_short_force_is_not_stepped_over

    subroutine at_a_saddle_errors_are_as_large()
        !! A rod that comes to the top after half the time and waits there: the truth, by Jacobi's
        !! sn with 50 digits, is beyond what the runs differ by.
        character(*), parameter :: text = "&scene system = 'own', method = 'gauss16', "// &
            "duration = 12.538500094441034, dt = 0.011930066693093277, q = 0.0, -1.0, "// &
            "v = 7.979367572283047, 0.0, error_estimate = .true. / "// &
            "&lagrangian coordinates = 'x', 'y', parameters = 'g', "// &
            "T = '1/2 (x_dot^2 + y_dot^2)', V = 'g y', constraint = 'x^2 + y^2 = 1' / "// &
            "&own g = 15.91757671340056 /"
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call perform(text, [word_t ::], outcome, error)
        call assertFalse(allocated(error), "it runs")
        if (allocated(error)) return
        call assertGreaterThan(outcome%state(1)%error, &
                               abs(outcome%state(1)%value + 0.001890921517_dp), message="x")
        call assertGreaterThan(outcome%state(3)%error, &
                               abs(outcome%state(3)%value - 0.0075442_dp), message="x_dot")
    end subroutine at_a_saddle_errors_are_as_large

    subroutine the_time_of_an_event_has_an_error()
        !! An oscillator passes zero at a quarter of its period; its phase is wrong by the method's
        !! error, or by that of the curve between the steps.
        character(*), parameter :: text = "&scene system = 'oscillator', q = 1.0, dt = 0.1, "// &
            "duration = 10.0, event = 'x = 0 stop', error_estimate = .true. / "// &
            "&oscillator m = 1.0, k = 4.0 /"
        real(dp), parameter :: truth = 0.25_dp*acos(-1.0_dp)
        character(8), parameter :: methods(2) = [character(8) :: "rk4", "gauss16"]
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, size(methods)
            call perform(text, one("scene%method="//trim(methods(i))), outcome, error)
            call assertFalse(allocated(error), "it runs")
            if (allocated(error)) return
            call assertEqual(3, size(outcome%state))
            call assertEqual("t", trim(outcome%state(1)%name))
            associate (s => outcome%state(1))
                call assertLessThan(abs(s%value - truth), s%error, message="rightly claimed")
                if (i == 1) call assertLessThan(s%error, 5.0_dp*abs(s%value - truth), &
                                                message="not too warily")
            end associate
        end do
    end subroutine the_time_of_an_event_has_an_error

    subroutine a_finer_step_that_cannot_be_is_refused()
        !! A quarter of the step would not move the time: said before anything is computed.
        character(*), parameter :: text = "&scene system = 'oscillator', q = 1.0, t0 = 1e9, "// &
            "dt = 2e-7, duration = 1e-5, error_estimate = .true. / &oscillator /"
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        class(system_t), allocatable :: system
        type(scene_t) :: scene

        call perform(text, one("scene%error_estimate=.false."), outcome, error)
        call assertFalse(allocated(error), "the step itself is long enough")
        call read_and_plan(text, "a.nml", [word_t ::], scene, system, error)
        call assertTrue(allocated(error), "a quarter of it is not")
        if (.not. allocated(error)) return
        call assertEqual(2, error%status)
        call assertGreaterThan(index(error%message, "the run that estimates the error: is too "// &
                                     "small to move the time"), 0, message=error%message)
    end subroutine a_finer_step_that_cannot_be_is_refused

    subroutine the_state_is_text_and_json()
        !! Units where there are some; no digit where none is left, `null` in JSON.
        type(outcome_t) :: outcome
        character(:), allocatable :: json

        allocate (outcome%state(3), outcome%drifts(0), outcome%others(0))
        outcome%state = [final_value_t("theta", "rad", 0.5_dp, 0.25_dp, 2.75_dp), &
                         final_value_t("x", "m", 0.5_dp, 0.25_dp, 2.5_dp), &
                         final_value_t("n", "1", 2.0_dp, 0.0_dp, 2.0_dp)]
        call assertEqual("theta = 0.5(3) rad, x = no digit left, n = 2.0", &
                         final_values_line(outcome%state))
        outcome%scene = "a"
        outcome%system = "b"
        outcome%method = "c"
        outcome%file = ""
        outcome%q = [0.5_dp]
        outcome%v = [0.5_dp]
        json = outcome_json(outcome)
        call assertGreaterThan(index(json, '"state": {"theta": {"value": '// &
            '5.0000000000000000E-001, "error": 2.5000000000000000E-001, "text": "0.5(3)"}, '// &
            '"x": {"value": 5.0000000000000000E-001, "error": 2.5000000000000000E-001, '// &
            '"text": null}, "n": {'), 0, message=json)
        deallocate (outcome%state)
        json = outcome_json(outcome)
        call assertGreaterThan(index(json, '"state": null, '), 0, message=json)
    end subroutine the_state_is_text_and_json

    subroutine the_key_is_read_and_echoed()
        !! Without it there is no statement, and no line in the header.
        character(*), parameter :: text = "&scene system = 'oscillator', q = 1.0, dt = 0.1, "// &
            "duration = 1.0, error_estimate = .true. / &oscillator /"
        type(outcome_t) :: outcome
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        character(scene_line_length), allocatable :: lines(:)

        call read_and_plan(text, "a.nml", [word_t ::], scene, system, error)
        call assertFalse(allocated(error), "it is read")
        if (allocated(error)) return
        call system%describe(d)
        allocate (lines, source=scene_lines(scene, d))
        call assertTrue(any(lines == "  error_estimate = .true."), "it is echoed")
        call perform(text, one("scene%error_estimate=.false."), outcome, error)
        call assertFalse(allocated(outcome%state), "no statement")
        call perform(text, [word_t ::], outcome, error)
        call assertTrue(allocated(outcome%state), "a statement")
    end subroutine the_key_is_read_and_echoed
end module test_statement
