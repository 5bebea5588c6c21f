module test_outcome
    !! Verdicts, and the JSON that programs read.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_positive_inf, ieee_quiet_nan, &
                                               ieee_value
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: new_system
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_json, only: json_list, json_number, json_string
    use lagrangia_kinds, only: dp, i8
    use lagrangia_ledger, only: claim_t
    use lagrangia_linearised, only: linearised_t
    use lagrangia_measures, only: take_measures, take_modes
    use lagrangia_outcome, only: from_closed_form, from_half_step, outcome_json, outcome_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_period, only: period_t
    use lagrangia_record, only: sample_record_t
    use lagrangia_reference, only: reference_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: outcome_suite

    type, extends(pendulum_t) :: slow_pendulum_t
        !! Half of omega in its closed form.
    contains
        procedure :: linearise
    end type slow_pendulum_t

contains

    function outcome_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("outcome")
        call suite%addTest(TestMethod("verdicts_say_what_did_not_hold", &
                                      verdicts_say_what_did_not_hold))
        call suite%addTest(TestMethod("limits_themselves_hold", limits_themselves_hold))
        call suite%addTest(TestMethod("nan_never_holds", nan_never_holds))
        call suite%addTest(TestMethod("a_failure_outweighs_everything", &
                                      a_failure_outweighs_everything))
        call suite%addTest(TestMethod("json_of_a_full_outcome", json_of_a_full_outcome))
        call suite%addTest(TestMethod("json_says_null_for_what_is_missing", &
                                      json_says_null_for_what_is_missing))
        call suite%addTest(TestMethod("json_strings_are_escaped", json_strings_are_escaped))
        call suite%addTest(TestMethod("json_has_what_stderr_says", json_has_what_stderr_says))
        call suite%addTest(TestMethod("json_numbers_have_17_digits", json_numbers_have_17_digits))
        call suite%addTest(TestMethod("periods_differ_either_way", periods_differ_either_way))
        call suite%addTest(TestMethod("modes_are_taken_where_there_are_any", &
                                      modes_are_taken_where_there_are_any))
    end function outcome_suite

    subroutine set_up(outcome)
        !! An outcome without measures.
        type(outcome_t), intent(out) :: outcome

        outcome%scene = "swing"
        outcome%system = "pendulum"
        outcome%method = "rk4"
        outcome%file = ""
        outcome%events = ""
        outcome%remark = ""
        outcome%choice = ""
        outcome%t = 2.5_dp
        outcome%q = [0.5_dp]
        outcome%v = [-0.25_dp]
        outcome%steps = 10_i8
        outcome%evaluations = 40_i8
        allocate (outcome%drifts(0), outcome%others(0))
    end subroutine set_up

    subroutine verdicts_say_what_did_not_hold()
        !! Each of them, with two digits; nothing judged is neither good nor bad.
        type(outcome_t) :: outcome

        call set_up(outcome)
        call assertEqual("not judged", outcome%verdict())
        call assertTrue(outcome%holds(), "nothing to hold")
        outcome%drifts = [measure("energy_drift", 3e-9_dp)]
        call assertEqual("not judged", outcome%verdict())
        outcome%others = [measure("error", 1e-9_dp, 1e-8_dp)]
        call assertEqual("holds", outcome%verdict())
        call assertTrue(outcome%holds(), "within its limit")
        outcome%drifts = [measure("energy_drift", 3e-9_dp, 1.5e-9_dp)]
        call assertEqual("NOT energy_drift 3.0E-09 > 1.5E-09", outcome%verdict())
        call assertFalse(outcome%holds(), "a drift beyond its limit")
        outcome%others(1)%most = 1e-10_dp
        call assertEqual("NOT energy_drift 3.0E-09 > 1.5E-09, NOT error 1.0E-09 > 1.0E-10", &
                         outcome%verdict())
        outcome%drifts(1)%most = 1.0_dp
        call assertEqual("NOT error 1.0E-09 > 1.0E-10", outcome%verdict())
        call assertFalse(outcome%holds(), "an error beyond its limit")
    end subroutine verdicts_say_what_did_not_hold

    subroutine limits_themselves_hold()
        !! A tolerance of 0 asks for exactly nothing, and can be met.
        type(outcome_t) :: outcome

        call set_up(outcome)
        outcome%others = [measure("error", 0.0_dp, 0.0_dp)]
        call assertEqual("holds", outcome%verdict())
        outcome%others(1)%value = tiny(1.0_dp)
        call assertFalse(outcome%holds(), "more than nothing")
    end subroutine limits_themselves_hold

    subroutine nan_never_holds()
        !! It is not within any limit.
        type(outcome_t) :: outcome

        call set_up(outcome)
        outcome%drifts = [measure("energy_drift", ieee_value(1.0_dp, ieee_quiet_nan), huge(1.0_dp))]
        call assertFalse(outcome%holds(), "NaN")
        call assertEqual(1, index(outcome%verdict(), "NOT energy_drift"), outcome%verdict())
    end subroutine nan_never_holds

    subroutine a_failure_outweighs_everything()
        !! Even if all that was seen is within its limits.
        type(outcome_t) :: outcome

        call set_up(outcome)
        outcome%others = [measure("error", 1e-9_dp, 1e-8_dp)]
        outcome%failure = "the state is not finite"
        call assertEqual("failed", outcome%verdict())
        call assertFalse(outcome%holds(), "failed")
    end subroutine a_failure_outweighs_everything

    subroutine json_of_a_full_outcome()
        !! Letter for letter; numbers that are sums of few powers of two.
        type(outcome_t) :: outcome
        character(:), allocatable :: json

        call set_up(outcome)
        outcome%drifts = [measure("energy_drift", 0.5_dp), measure("p_drift", 0.25_dp)]
        outcome%others = [measure("error", 0.125_dp, 1.0_dp), &
                          measure("period", 0.0625_dp), measure("small_period", 0.03125_dp)]
        outcome%error_from = from_closed_form
        outcome%period = 1.5_dp
        outcome%seconds = 2.0_dp
        outcome%file = "out/swing.dat"
        json = outcome_json(outcome)
        call starts(json, '{"scene": "swing", "system": "pendulum", "method": "rk4", "t": '// &
                    '2.5000000000000000E+000, "q": [5.0000000000000000E-001], '// &
                    '"v": [-2.5000000000000000E-001], "steps": 10, "evaluations": 40, ')
        call contains_once(json, '"energy_drift": 5.0000000000000000E-001, "drifts": {'// &
                           '"energy_drift": 5.0000000000000000E-001, '// &
                           '"p_drift": 2.5000000000000000E-001}')
        call contains_once(json, '"error": 1.2500000000000000E-001, "error_from": "exact"')
        call contains_once(json, '"period": 1.5000000000000000E+000, '// &
                           '"period_error": 6.2500000000000000E-002, '// &
                           '"small_period_error": 3.1250000000000000E-002, "omega": ')
        call contains_once(json, '"seconds": 2.0000000000000000E+000')
        call contains_once(json, '"verdict": "holds", "file": "out/swing.dat", "events": null}')
        outcome%error_from = from_half_step
        call contains_once(outcome_json(outcome), '"error_from": "estimate"')
    end subroutine json_of_a_full_outcome

    subroutine json_says_null_for_what_is_missing()
        !! Not 0, not a negative number; nor for what is not finite, which JSON does not know.
        type(outcome_t) :: outcome
        character(:), allocatable :: json

        call set_up(outcome)
        json = outcome_json(outcome)
        call contains_once(json, '"energy_drift": null, "drifts": {}, "error": null, '// &
                           '"error_from": null')
        call contains_once(json, '"period": null, "period_error": null, '// &
                           '"small_period_error": null, "omega": null')
        call contains_once(json, '"title": null, "changes": null, "exact_period": null, '// &
                           '"small_period": null, "omega_formula": null, "choice"')
        call contains_once(json, '"verdict": "not judged", "file": null, "events": null}')
        outcome%q = [ieee_value(1.0_dp, ieee_quiet_nan), ieee_value(1.0_dp, ieee_positive_inf)]
        outcome%drifts = [measure("energy_drift", ieee_value(1.0_dp, ieee_positive_inf))]
        json = outcome_json(outcome)
        call contains_once(json, '"q": [null, null]')
        call contains_once(json, '"energy_drift": null, "drifts": {"energy_drift": null}')
    end subroutine json_says_null_for_what_is_missing

    subroutine json_strings_are_escaped()
        !! Quotes, backslashes and control characters, in a scene's name too.
        type(outcome_t) :: outcome

        call assertEqual('"a\"b\\c"', json_string('a"b\c'))
        call assertEqual('"\u0001\u001f\u007f\u000a/"', json_string( &
                         achar(1)//achar(31)//achar(127)//achar(10)//"/"))
        call set_up(outcome)
        outcome%scene = 'a "swing"\'
        call starts(outcome_json(outcome), '{"scene": "a \"swing\"\\", ')
    end subroutine json_strings_are_escaped

    subroutine json_has_what_stderr_says()
        !! A warning, a remark, a failure.
        type(outcome_t) :: outcome
        character(:), allocatable :: json

        call set_up(outcome)
        json = outcome_json(outcome)
        call contains_once(json, '"choice": null, "warning": null, "remark": null, '// &
                           '"failure": null, "verdict": "not judged"')
        outcome%warning = "dt is too long"
        outcome%remark = " (the last one shortened)"
        outcome%failure = "not finite"
        json = outcome_json(outcome)
        call contains_once(json, '"warning": "dt is too long", "remark": '// &
                           '"(the last one shortened)", "failure": "not finite", '// &
                           '"verdict": "failed"')
    end subroutine json_has_what_stderr_says

    subroutine json_numbers_have_17_digits()
        !! So that a double survives; whole numbers of 64 bits as they are.
        real(dp) :: back
        character(:), allocatable :: text

        text = json_number(1.0_dp/3.0_dp)
        read (text, *) back
        call assertEqual(1.0_dp/3.0_dp, back, message=text)
        call assertEqual("-1.7976931348623157E+308", json_number(-huge(1.0_dp)))
        call assertEqual("2.2250738585072014E-308", json_number(tiny(1.0_dp)))
        call assertEqual("9223372036854775807", json_number(huge(1_i8)))
        call assertEqual("[]", json_list([real(dp) ::]))
    end subroutine json_numbers_have_17_digits

    subroutine periods_differ_either_way()
        !! Shorter and longer than it should be; where none was measured, by NaN.
        type(scene_t) :: scene
        type(outcome_t) :: outcome
        type(sample_record_t) :: record
        type(period_t) :: period
        class(reference_t), allocatable :: reference
        type(pendulum_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), t, exact
        integer :: k

        call system%configure([1.0_dp, 1.0_dp, 9.81_dp], error)
        call system%closed_form(0.0_dp, [1.0_dp], [0.0_dp], reference)
        exact = reference%period
        do k = 0, 640
            t = 5*exact*k/640
            call reference%state_at(t, q, v)
            call period%follow(system, t, q, v)
        end do
        allocate (scene%expectations(0))
        scene%period_of = "theta"
        reference%period = 2*exact
        reference%small_period = 1.5_dp*exact
        call set_up(outcome)
        call take_measures(scene, system, record, period, reference, outcome)
        ! Turning points of a quintic over 128 samples a period: (2 pi/128)^6/720 = 2e-11.
        call assertEqual(0.5_dp, outcome%others(1)%value, 1e-10_dp, "half of it")
        call assertEqual(1.0_dp/3.0_dp, outcome%others(2)%value, 1e-10_dp, "two thirds of it")
        reference%period = 2*exact/3
        reference%small_period = exact/2
        call set_up(outcome)
        call take_measures(scene, system, record, period, reference, outcome)
        call assertEqual(0.5_dp, outcome%others(1)%value, 1e-10_dp, "half as long again")
        call assertEqual(1.0_dp, outcome%others(2)%value, 1e-10_dp, "twice as long")
        call assertEqual(exact, outcome%period, 1e-10_dp*exact, "as measured")
        call assertEqual(2*exact/3, outcome%exact_period, 0.0_dp, "as it should be")
        call assertEqual(exact/2, outcome%small_period, 0.0_dp, "and of small swings")
        call set_up(outcome)
        call take_measures(scene, system, record, period_t(), reference, outcome)
        call assertTrue(ieee_is_nan(outcome%others(1)%value), "none was measured")
        call assertTrue(ieee_is_nan(outcome%others(2)%value), "nor of small swings")
    end subroutine periods_differ_either_way

    subroutine modes_are_taken_where_there_are_any()
        !! \(\omega = \sqrt{g/l}\) where the scene asks; nothing where it does not, where nothing
        !! oscillates, and where there is no equilibrium.
        type(scene_t) :: scene
        type(outcome_t) :: outcome
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        call new_system("pendulum", system, error)
        call set_up(outcome)
        call take_modes(scene, system, outcome)
        call assertEqual(0.0_dp, outcome%omega, 0.0_dp, "the scene does not ask")
        scene%modes = .true.
        call take_modes(scene, system, outcome)
        call assertEqual(sqrt(9.81_dp), outcome%omega, 4*epsilon(1.0_dp), "g = 9.81, l = 1")
        call assertEqual("omega^2 = g/l", outcome%omega_formula)
        call assertEqual(0.0_dp, outcome%omega_error, 4*epsilon(1.0_dp), "as derived by hand")
        call new_system("driven_pendulum", system, error)
        call set_up(outcome)
        call take_modes(scene, system, outcome)
        call assertEqual(0.0_dp, outcome%omega, 0.0_dp, "L contains the time")
        call assertFalse(allocated(outcome%omega_formula), "no formula")
        call assertTrue(outcome%omega_error < 0.0_dp, "nothing to compare")
        call new_system("charged_particle", system, error)
        call set_up(outcome)
        call take_modes(scene, system, outcome)
        call assertEqual(0.0_dp, outcome%omega, 0.0_dp, "a force at every place")
        call new_system("cart_pendulum", system, error)
        call set_up(outcome)
        call take_modes(scene, system, outcome)
        call assertEqual("omega^2 = (m1 + m2) g/(m1 l)", outcome%omega_formula, "not the cart's 0")
        call take_modes_of("(x_dot^2 + x^2)/2 + (y_dot^2 - y^2/4)/2", outcome)
        call assertEqual(0.5_dp, outcome%omega, 4*epsilon(1.0_dp), "x is unstable")
        call take_modes_of("(x_dot^2 - 4 x^2)/2 + (y_dot^2 - y^2/4)/2", outcome)
        call assertEqual(0.5_dp, outcome%omega, 4*epsilon(1.0_dp), "the slower one")
        call set_up(outcome)
        call take_modes(scene, slow_pendulum_t(ndof=1), outcome)
        call assertEqual(sqrt(9.81_dp), outcome%omega, 4*epsilon(1.0_dp), "of L")
        call assertEqual(0.5_dp, outcome%omega_error, 4*epsilon(1.0_dp), "half of it by hand")
    contains
        subroutine take_modes_of(lagrangian, outcome)
            character(*), intent(in) :: lagrangian
            type(outcome_t), intent(out) :: outcome
            type(word_t) :: none(0)

            call parse_scene("&scene system='two', method='rk4', dt=0.1, duration=1, q=0, 0 / "// &
                             "&lagrangian coordinates='x', 'y', L='"//lagrangian//"' /", "two", &
                             none, scene, system, error)
            call assertFalse(allocated(error), lagrangian)
            scene%modes = .true.
            call set_up(outcome)
            call take_modes(scene, system, outcome)
        end subroutine take_modes_of
    end subroutine modes_are_taken_where_there_are_any

    pure subroutine linearise(self, q, analytic)
        class(slow_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof)
        type(linearised_t), intent(out) :: analytic

        call self%pendulum_t%linearise(q, analytic)
        analytic%omega2 = 0.25_dp*analytic%omega2
    end subroutine linearise

    subroutine starts(text, expected)
        !! Assert that `text` begins with `expected`.
        character(*), intent(in) :: text, expected

        call assertEqual(expected, text(:min(len(text), len(expected))))
    end subroutine starts

    subroutine contains_once(text, expected)
        !! Assert that `expected` is in `text`, at one place.
        character(*), intent(in) :: text, expected

        call assertTrue(index(text, expected) > 0, expected//" is not in "//text)
        call assertEqual(index(text, expected), index(text, expected, back=.true.), expected)
    end subroutine contains_once

    pure function measure(name, value, most) result(claim)
        !! The worst of a column, judged where it has a limit.
        character(*), intent(in) :: name
        real(dp), intent(in) :: value
        real(dp), intent(in), optional :: most
        type(claim_t) :: claim

        claim%name = name
        claim%value = value
        claim%judged = present(most)
        if (present(most)) claim%most = most
    end function measure
end module test_outcome
