module test_work
    !! The energy function less the work of what changes it is conserved.
    use funit, only: TestMethod, TestSuite, assertFalse, assertLessThan, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_observer, only: observer_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_run_plan, only: parse_run_plan, run_plan_t
    use lagrangia_scene_run, only: run_scene
    use lagrangia_text, only: word_t
    use stated_text, only: is_said
    implicit none (type, external)
    private
    public :: work_suite

    character, parameter :: line_feed = new_line("a")
    character(*), parameter :: damped = "&oscillator m = 1.0, k = 4.0, b = 0.4, "// &
        "drive_force = 1.0, drive_frequency = 1.5 /"
    character(*), parameter :: shaken = "&driven_pendulum m = 1.0, l = 1.0, amplitude = 0.1, "// &
        "drive_frequency = 8.0, b = 0.3 /"
    character(*), parameter :: own = "&lagrangian coordinates = 'r', 'theta', parameters = "// &
        "'m', 'k', 'l0', 'g', 'b', T = 'm/2 (r_dot^2 + r^2 theta_dot^2)', V = 'k/2 (r - l0)^2 "// &
        "- m g r cos(theta)', Q_r = '-b r_dot^3', Q_theta = '-b r^2 theta_dot^3 + cos(t)' /"// &
        line_feed//"&own m = 1.0, k = 40.0, l0 = 1.0, g = 9.81, b = 0.2 /"

contains

    function work_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("work")
        call suite%addTest(TestMethod("by_dense_output", by_dense_output))
        call suite%addTest(TestMethod("between_steps", between_steps))
        call suite%addTest(TestMethod("faster_than_the_steps", faster_than_the_steps))
        call suite%addTest(TestMethod("of_a_free_body", of_a_free_body))
        call suite%addTest(TestMethod("after_impacts", after_impacts))
        call suite%addTest(TestMethod("where_it_cannot_stand", where_it_cannot_stand))
    end function work_suite

    subroutine drifted(scene, group, drift, message)
        !! The largest `energy_balance_drift` of a run; or why it failed.
        character(*), intent(in) :: scene, group  !! keys of `&scene`, and the group of the system
        real(dp), intent(out) :: drift
        character(:), allocatable, intent(out) :: message
        type(run_plan_t), allocatable :: plan
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        class(observer_t), pointer :: nobody
        type(word_t) :: none(0)
        integer :: i

        nobody => null()
        drift = -1.0_dp
        message = ""
        allocate (plan)
        call parse_run_plan(plan, "&scene "//scene//" /"//line_feed//group//line_feed, "scene", &
                            none, error)
        if (.not. allocated(error)) call run_scene(plan, "", "text", nobody, outcome, error)
        if (allocated(error)) then
            message = error%message
            return
        end if
        do i = 1, size(outcome%drifts)
            if (outcome%drifts(i)%name == "energy_balance_drift") drift = outcome%drifts(i)%value
        end do
    end subroutine drifted

    subroutine by_dense_output()
        !! Steps by tolerance, samples between them: what is left is the error of the energy itself,
        !! some hundred tolerances, of some hundred steps.
        call within("system = 'oscillator', method = 'gauss16', tolerance = 1e-13, "// &
                    "duration = 20.0, samples = 333, q = 1.0, v = 0.5", damped)
        call within("system = 'driven_pendulum', method = 'dop853', tolerance = 1e-13, "// &
                    "duration = 10.0, samples = 77, q = 1.0, v = 0.5", shaken)
        call within("system = 'own', method = 'gauss16', tolerance = 1e-13, "// &
                    "duration = 10.0, samples = 55, q = 1.2, 0.7", own)
        call within("system = 'oscillator', method = 'auto', duration = 20.0, samples = 100, "// &
                    "q = 1.0, v = 0.5", damped)
    contains
        subroutine within(scene, group)
            character(*), intent(in) :: scene, group
            character(:), allocatable :: message
            real(dp) :: drift

            call drifted(scene, group, drift, message)
            call assertTrue(message == "", message)
            call assertTrue(drift >= 0.0_dp, "there is a drift: "//scene)
            call assertLessThan(drift, 1e-11_dp, message=scene)
        end subroutine within
    end subroutine by_dense_output

    subroutine between_steps()
        !! By rk4 the balance is as good as its energy: at half the step 16 times or better.
        character(:), allocatable :: message
        real(dp) :: coarse, fine

        call drifted("system = 'driven_pendulum', method = 'rk4', dt = 0.02, duration = 10.0, "// &
                     "every = 7, q = 1.0, v = 0.5", shaken, coarse, message)
        call assertTrue(message == "", message)
        call drifted("system = 'driven_pendulum', method = 'rk4', dt = 0.01, duration = 10.0, "// &
                     "every = 14, q = 1.0, v = 0.5", shaken, fine, message)
        call assertTrue(coarse > 1e-12_dp .and. coarse < 1e-4_dp, "the coarse one is to be seen")
        call assertLessThan(fine, coarse/14.0_dp, message="order 4")
    end subroutine between_steps

    subroutine faster_than_the_steps()
        !! A decay of which the rows show nothing: \(e^{-bt/m}\), sampled each 0.02 s. A closed form
        !! is followed through it however fast it is; where it takes too many steps of a method the
        !! run says so.
        character(:), allocatable :: message
        real(dp) :: drift

        call of_drag("'auto'", "1e2")
        call of_drag("'auto'", "1e4")
        call of_drag("'auto'", "1e6")
        call of_drag("'auto'", "1e8")
        call of_drag("'auto'", "1e10")
        call of_drag("'auto'", "1e14")
        call of_drag("'gauss16'", "1e2")
        call drifted("system = 'oscillator', method = 'rk4', dt = 0.02, duration = 1.0, "// &
                     "q = 1.0, v = 0.5, columns = 't', 'work', 'error'", &
                     "&oscillator m = 1.0, k = 4.0, b = 1e9 /", drift, message)
        call assertTrue(index(message, "not resolved between the steps") > 0, message)
        call assertTrue(index(message, "'auto' takes the closed form") > 0, message)
    contains
        subroutine of_drag(method, b)
            character(*), intent(in) :: method, b

            call drifted("system = 'oscillator', method = "//method//", dt = 0.02, "// &
                         "duration = 1.0, q = 1.0, v = 0.5, columns = 't', "// &
                         "'energy_balance_drift'", "&oscillator m = 1.0, k = 4.0, b = "//b// &
                         " /", drift, message)
            call assertTrue(message == "" .and. drift >= 0.0_dp, message)
            call assertLessThan(drift, 1e-11_dp, message=method//", b = "//b)
        end subroutine of_drag
    end subroutine faster_than_the_steps

    subroutine of_a_free_body()
        !! \(W = \frac m2v_0^2(e^{-2bt/m} - 1)\), and so \(E - W\) stays \(\frac m2v_0^2\).
        character(:), allocatable :: message
        real(dp) :: drift

        call drifted("system = 'oscillator', method = 'gauss16', dt = 0.01, duration = 5.0, "// &
                     "q = 0.0, v = 3.0", "&oscillator m = 2.0, k = 0.0, b = 0.7 /", drift, message)
        call assertTrue(message == "", message)
        call assertLessThan(drift, 100*epsilon(drift), message="500 steps, each a product")
    end subroutine of_a_free_body

    subroutine after_impacts()
        !! A string that goes slack: the sum goes on from the state after the impact.
        character(:), allocatable :: message
        real(dp) :: drift

        call drifted("system = 'oscillator', method = 'gauss16', tolerance = 1e-12, "// &
                     "duration = 10.0, samples = 50, q = 1.0, v = 0.5, event = 'x = 0.2', "// &
                     "event_columns = 't', 'energy'", damped, drift, message)
        call assertTrue(message == "", message)
        call assertLessThan(drift, 1e-10_dp, message="events between samples")
    end subroutine after_impacts

    subroutine where_it_cannot_stand()
        call refused("system = 'oscillator', dt = 0.01, duration = 1.0, q = 1.0, "// &
                     "columns = 't', 'work'", "&oscillator m = 1.0, k = 1.0 /", &
                     "is conserved; 'energy_drift' says how well")
        call refused("system = 'oscillator', dt = 0.01, duration = 1.0, q = 1.0, "// &
                     "event = 'work = 1.0', event_columns = 't'", damped, &
                     "is no function of one state; it can stand in columns only")
        call refused("system = 'oscillator', dt = 0.01, duration = 1.0, q = 1.0, "// &
                     "event = 'x = 0.2', event_columns = 't', 'work'", damped, &
                     "is no function of one state; it can stand in columns only")
    contains
        subroutine refused(scene, group, expected)
            character(*), intent(in) :: scene, group, expected
            character(:), allocatable :: message
            real(dp) :: drift

            call drifted(scene, group, drift, message)
            call assertFalse(message == "", "refused: "//scene)
            call assertTrue(is_said(message, expected), message)
        end subroutine refused
    end subroutine where_it_cannot_stand
end module test_work
