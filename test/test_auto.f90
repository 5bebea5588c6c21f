module test_auto
    !! `method = 'auto'`: closed forms where there are any, steps where not, and it says which.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertLessThan, assertTrue
    use lagrangia_catalogue, only: nth_system
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp
    use lagrangia_methods, only: auto, new_adaptive, new_integrator, workhorse
    use lagrangia_outcome, only: from_closed_form, from_steps, outcome_json, outcome_t
    use lagrangia_reference, only: reference_t
    use lagrangia_scene, only: scene_line_length, scene_lines, scene_t
    use lagrangia_system, only: system_t
    use lagrangia_trajectory_plan, only: settle_method
    use scene_runs, only: plan_and_run, read_and_plan
    implicit none (type, external)
    private
    public :: auto_suite

    type, extends(reference_t) :: endless_t
        !! A closed form that overflows.
    contains
        procedure :: state_at
    end type endless_t

    character(*), parameter :: swing = "&scene system = 'pendulum', method = 'auto', "// &
        "duration = 3.0, q = 2.0, v = 0.5"
    character(*), parameter :: cart = "&scene system = 'cart_pendulum', method = 'auto', "// &
        "duration = 1.0, q = 0.5, "

contains

    function auto_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("auto")
        call suite%addTest(TestMethod("closed_forms_take_no_steps", closed_forms_take_no_steps))
        call suite%addTest(TestMethod("steps_that_would_not_end_are_not_taken", &
                                      steps_that_would_not_end_are_not_taken))
        call suite%addTest(TestMethod("a_closed_form_is_not_its_own_judge", &
                                      a_closed_form_is_not_its_own_judge))
        call suite%addTest(TestMethod("steps_where_no_closed_form_is", &
                                      steps_where_no_closed_form_is))
        call suite%addTest(TestMethod("a_closed_form_may_not_reach_the_end", &
                                      a_closed_form_may_not_reach_the_end))
        call suite%addTest(TestMethod("events_and_estimates_need_steps", &
                                      events_and_estimates_need_steps))
        call suite%addTest(TestMethod("periods_are_measured_all_the_same", &
                                      periods_are_measured_all_the_same))
        call suite%addTest(TestMethod("steps_suit_every_system", steps_suit_every_system))
        call suite%addTest(TestMethod("what_contradicts_auto_is_refused", &
                                      what_contradicts_auto_is_refused))
        call suite%addTest(TestMethod("the_echo_keeps_auto", the_echo_keeps_auto))
    end function auto_suite

    subroutine perform(text, outcome, error, scene, system)
        !! The scene in `text`, without files.
        character(*), intent(in) :: text
        type(outcome_t), intent(out) :: outcome
        type(error_t), allocatable, intent(out) :: error
        type(scene_t), intent(out), optional :: scene
        class(system_t), allocatable, intent(out), optional :: system
        class(system_t), allocatable :: a_system
        type(scene_t) :: a_scene

        call read_and_plan(text, "a.nml", [word_t ::], a_scene, a_system, error)
        if (allocated(error)) return
        call plan_and_run(a_scene, a_system, outcome, error)
        if (present(scene)) scene = a_scene
        if (present(system)) call move_alloc(a_system, system)
    end subroutine perform

    subroutine closed_forms_take_no_steps()
        !! However many samples are asked for, with a step, a shorter last one, a tolerance or
        !! neither; and the last state is the closed form's.
        call check_exact(swing//" /", 1001)
        call check_exact(swing//", samples = 7, tolerance = 1e-3 /", 8)
        call check_exact(swing//", dt = 0.5, every = 2 /", 4)
        call check_exact(swing//", dt = 0.7, every = 1, t0 = 5.0 /", 6)
        call check_exact(cart//"1.0, v = 0.2, 6.0 /", 1001)
        call check_exact("&scene system = 'wedge', method = 'auto', duration = 2, q = 0.1, 3.0 /", &
                         1001)
    end subroutine closed_forms_take_no_steps

    subroutine check_exact(text, rows)
        !! No steps, no evaluations, so many rows.
        character(*), intent(in) :: text
        integer, intent(in) :: rows
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        class(reference_t), allocatable :: closed_form
        real(dp), allocatable :: q(:), v(:)

        call perform(text, outcome, error, scene, system)
        call assertFalse(allocated(error), text)
        if (allocated(error)) return
        call assertEqual("exact", outcome%method)
        call assertEqual([0, 0, rows], int([outcome%steps, outcome%evaluations, outcome%rows]))
        call assertEqual("", outcome%remark)
        call system%closed_form(scene%t0, scene%q, scene%v, closed_form)
        allocate (q, v, mold=scene%q)
        call closed_form%state_at(scene%t0 + scene%duration, q, v)
        call assertEqual([q, v], [outcome%q, outcome%v], 1e-14_dp, text)
        call assertEqual("auto took exact: closed form: "//trim(closed_form%title), outcome%choice)
        call assertGreaterThan(index(outcome_json(outcome), '"choice": "auto took exact: '), 0, &
                               message="json")
    end subroutine check_exact

    subroutine steps_that_would_not_end_are_not_taken()
        !! A friction of 1e8 kg/s wants billions of steps: then the error is not known, and the
        !! closed form is there all the same. One that is expected does not hold.
        character(*), parameter :: stiff = "&scene system = 'oscillator', method = 'auto', "// &
            "duration = 30, dt = 0.02, q = 1, v = 0.5, columns = 't', 'x', 'error'"
        character(*), parameter :: values = " / &oscillator m = 1, k = 4, b = 1e8 /"
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call perform(stiff//values, outcome, error)
        call assertFalse(allocated(error), "it runs")
        if (anyExceptions()) return
        call assertEqual(1501, int(outcome%rows))
        call assertEqual("", outcome%error_source())
        call assertLessThan(outcome%error(), 0.0_dp, message="no error is known")
        call perform(stiff//", expect_error = 1"//values, outcome, error)
        call assertFalse(outcome%holds(), "nor does it hold")
    end subroutine steps_that_would_not_end_are_not_taken

    subroutine a_closed_form_is_not_its_own_judge()
        !! Steps are, and they differ from it by rounding: by something, and little. A method that
        !! was named is compared with the closed form.
        character(*), parameter :: more = ", columns = 't', 'error' /"
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call perform(swing//more, outcome, error)
        call assertEqual(from_steps, outcome%error_from)
        call assertGreaterThan(outcome%error(), 0.0_dp, message="something")
        call assertLessThan(outcome%error(), 1e-12_dp, message="little")
        call assertEqual(0, int(outcome%evaluations), message="of the run itself")
        call assertGreaterThan(index(outcome_json(outcome), '"error_from": "steps"'), 0, &
                               message="json")
        call perform(swing//", dt = 0.01, expect_error = 1e-12 /", outcome, error)
        call assertEqual(from_steps, outcome%error_from)
        call assertEqual("holds", outcome%verdict())
        call perform(swing//", event = 'theta = 0'"//more, outcome, error)
        call assertEqual(from_closed_form, outcome%error_from)
    end subroutine a_closed_form_is_not_its_own_judge

    subroutine steps_where_no_closed_form_is()
        !! Near the top of the cart-pendulum the series gives up; the double pendulum has none.
        call check_steps(cart//"3.14 /", "no closed form is known from this start")
        call check_steps(cart//"3.14, dt = 0.01 /", "no closed form is known from this start")
        call check_steps("&scene system = 'double_pendulum', method = 'auto', duration = 1, "// &
                         "q = 1, 2 /", "no closed form is known from this start")
    end subroutine steps_where_no_closed_form_is

    pure subroutine state_at(self, t, q, v)
        !! No number.
        class(endless_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(self%ndof), v(self%ndof)

        q = 1.0_dp
        v = ieee_value(v, ieee_quiet_nan)
    end subroutine state_at

    subroutine a_closed_form_may_not_reach_the_end()
        !! One that overflows, and one that knows the period only.
        class(system_t), allocatable :: system
        class(reference_t), allocatable :: closed_form
        type(error_t), allocatable :: error
        type(scene_t) :: scene, settled
        character(:), allocatable :: choice

        call read_and_plan(swing//" /", "a.nml", [word_t ::], scene, system, error)
        allocate (endless_t :: closed_form)
        closed_form%ndof = 1
        call settle_method(scene, system, closed_form, settled, choice)
        call assertEqual(workhorse, settled%method, "no numbers")
        call system%closed_form(0.0_dp, scene%q, scene%v, closed_form)
        closed_form%has_state = .false.
        call settle_method(scene, system, closed_form, settled, choice)
        call assertEqual(workhorse, settled%method, "no states")
        call assertEqual(1, index(choice, "auto took "//workhorse//": the closed form does not "// &
                                  "give every state; "), choice)
    end subroutine a_closed_form_may_not_reach_the_end

    subroutine events_and_estimates_need_steps()
        !! They lie between steps, or come from finer ones.
        call check_steps(swing//", event = 'theta = 0' /", "events are looked for between steps")
        call check_steps(swing//", error_estimate = .true. /", &
                         "an error is estimated by finer steps")
        call check_steps(swing//", dt = 0.01, error_estimate = .true. /", &
                         "an error is estimated by finer steps")
        call check_impacts("tolerance = 1e-10")
        call check_impacts("dt = 5e-3")
    end subroutine events_and_estimates_need_steps

    subroutine check_impacts(times)
        !! Through infinitely many bounces, after which the ball rests at 3.058 s.
        character(*), intent(in) :: times
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call perform("&scene system = 'bouncing_ball', method = 'auto', duration = 3.5, q = 0, "// &
                     "v = 3, expect_error = 1e-13, "//times//" / &bouncing_ball "// &
                     "restitution = 0.8 /", outcome, error)
        call assertEqual(workhorse, outcome%method)
        call assertEqual("holds", outcome%verdict())
        call assertEqual(1, index(outcome%choice, "auto took "//workhorse//": impacts are "// &
                                  "looked for between steps"), outcome%choice)
    end subroutine check_impacts

    subroutine check_steps(text, why)
        !! Steps of the workhorse, and the reason.
        character(*), intent(in) :: text, why
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call perform(text, outcome, error)
        call assertFalse(allocated(error), text)
        if (allocated(error)) return
        call assertEqual(workhorse, outcome%method)
        call assertGreaterThan(int(min(outcome%steps, outcome%evaluations)), 0, message=text)
        call assertEqual("auto took "//workhorse//": "//why//"; of the methods this one is "// &
                         "mostly the fastest to a given error", outcome%choice)
        call assertTrue((index(text, "error_estimate") > 0) .eqv. allocated(outcome%state), &
                        "an estimate where it is asked for: "//text)
    end subroutine check_steps

    subroutine periods_are_measured_all_the_same()
        !! On the samples, from crossing to crossing.
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call perform("&scene system = 'pendulum', method = 'auto', duration = 20, "// &
                     "samples = 2000, q = 2, period_of = 'theta', expect_period = 1e-9, "// &
                     "modes = .true. /", &
                     outcome, error)
        call assertEqual("exact", outcome%method)
        call assertEqual("holds", outcome%verdict())
        call assertGreaterThan(outcome%period, 0.0_dp, message="measured")
        call assertGreaterThan(outcome%omega, 0.0_dp, message="modes")
    end subroutine periods_are_measured_all_the_same

    subroutine steps_suit_every_system()
        !! Whatever there is in the catalogue, the workhorse takes it, both ways.
        class(integrator_t), allocatable :: fixed
        class(dense_integrator_t), allocatable :: adaptive
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        integer :: i

        i = 0
        do
            i = i + 1
            call nth_system(i, system)
            if (.not. allocated(system)) exit
            call system%describe(d)
            call new_integrator(workhorse, fixed, error)
            call fixed%prepare(system, error)
            call assertFalse(allocated(error), trim(d%name)//", dt")
            call new_adaptive(workhorse, adaptive)
            call adaptive%prepare(system, error)
            call assertFalse(allocated(error), trim(d%name)//", tolerance")
            if (anyExceptions()) return
        end do
    end subroutine steps_suit_every_system

    subroutine what_contradicts_auto_is_refused()
        !! `auto` is among the names that are near; `exact` is none that can be asked for.
        call check_refusal(swing//", compensated = .true., dt = 0.1 /", "compensated = .true.: "// &
                           "name the method that is to have such sums")
        call check_refusal(swing//", tolerance = 1e-6, dt = 0.1 /", "give either dt, ")
        call check_refusal(swing//", every = 3 /", "every = 3: counts steps of dt")
        call check_refusal("&scene system='pendulum' method='auot' q=1 /", "did you mean 'auto'?")
        call check_refusal("&scene system='pendulum' method='exact' q=1 /", &
                           "is what 'auto' takes")
        call check_refusal("&scene system='pendulum' method='?' q=1 /", ", auto")
    end subroutine what_contradicts_auto_is_refused

    subroutine check_refusal(text, message)
        !! Refused in words that contain these.
        character(*), intent(in) :: text, message
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call perform(text, outcome, error)
        call assertTrue(allocated(error), "refused: "//text)
        if (.not. allocated(error)) return
        call assertGreaterThan(index(error%message, message), 0, message=error%message)
    end subroutine check_refusal

    subroutine the_echo_keeps_auto()
        !! What the header has makes the same choice again.
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(description_t) :: d
        character(scene_line_length), allocatable :: lines(:)

        call perform(swing//" /", outcome, error, scene, system)
        call system%describe(d)
        allocate (lines, source=scene_lines(scene, d))
        call assertTrue(any(lines == "  method = '"//auto//"'"), "the echo")
    end subroutine the_echo_keeps_auto
end module test_auto
