module test_run_plan
    !! A scene is read, planned and run, each once; a plan's refusal names file, line and key.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_kinds, only: dp
    use lagrangia_observer, only: observer_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_reference, only: reference_t
    use lagrangia_run_plan, only: new_run_plan, run_plan_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_scene_run, only: run_scene
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: run_plan_suite

    type, extends(pendulum_t) :: counting_pendulum_t
        !! Knows how often it was planned: every plan asks for the closed form.
    contains
        procedure :: closed_form
    end type counting_pendulum_t

    integer :: plans = 0
    character(*), parameter :: nl = new_line("a")
    character(*), parameter :: swing = "&scene system='pendulum' duration=5 q=1 dt=1e-2"//nl

contains

    function run_plan_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("run_plan")
        call suite%addTest(TestMethod("a_scene_is_planned_once", a_scene_is_planned_once))
        call suite%addTest(TestMethod("a_plan_runs_once", a_plan_runs_once))
        call suite%addTest(TestMethod("a_plans_refusal_has_its_place", &
                                      a_plans_refusal_has_its_place))
        call suite%addTest(TestMethod("without_a_file_there_is_no_place", &
                                      without_a_file_there_is_no_place))
    end function run_plan_suite

    subroutine closed_form(self, t0, q0, v0, reference)
        !! The pendulum's, counted.
        class(counting_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t0, q0(:), v0(:)
        class(reference_t), allocatable, intent(out) :: reference

        plans = plans + 1
        call self%pendulum_t%closed_form(t0, q0, v0, reference)
    end subroutine closed_form

    subroutine new_counting_plan(plan)
        !! Of a scene that has all that a plan looks at.
        type(run_plan_t), intent(out) :: plan
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        type(counting_pendulum_t) :: counting

        call parse_scene(swing//"method='auto' columns='t','theta','error' period_of='theta' "// &
                         "error_estimate=t event='theta = 0.5' modes=t expect_period=1e-3 /", &
                         "s.nml", [word_t ::], scene, system, error)
        call assertFalse(allocated(error), "it is read")
        if (allocated(error)) return
        call counting%configure(scene%parameters, error)
        plans = 0
        call new_run_plan(plan, scene, counting, error)
        call assertFalse(allocated(error), "it is planned")
    end subroutine new_counting_plan

    subroutine a_scene_is_planned_once()
        !! Also with two finer runs beside it, and the run itself plans nothing.
        type(run_plan_t) :: plan
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        class(observer_t), pointer :: nobody

        nobody => null()
        call new_counting_plan(plan)
        if (anyExceptions()) return
        call assertEqual(1, plans, "the plan")
        call run_scene(plan, "", "text", nobody, outcome, error)
        call assertFalse(allocated(error), "it runs")
        call assertTrue(allocated(outcome%state), "with its finer runs")
        call assertEqual(1, plans, "and the run")
    end subroutine a_scene_is_planned_once

    subroutine a_plan_runs_once()
        !! It is used up: the rows of a second run would stand behind those of the first.
        type(run_plan_t) :: plan
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        class(observer_t), pointer :: nobody

        nobody => null()
        call new_counting_plan(plan)
        if (anyExceptions()) return
        call run_scene(plan, "", "text", nobody, outcome, error)
        call assertEqual("holds", outcome%verdict())
        call run_scene(plan, "", "text", nobody, outcome, error)
        call assertTrue(allocated(error), "it is refused")
        if (.not. allocated(error)) return
        call assertEqual("this plan has been run: make another one", error%message)
        call assertEqual("failed", outcome%verdict())
    end subroutine a_plan_runs_once

    subroutine a_plans_refusal_has_its_place()
        !! All that the reader lets pass.
        call check("columns='t','thet' /", "s.nml:2:13: &scene: columns = 'thet': unknown column")
        call check("plot='t:omega' /", "s.nml:2:6: &scene: plot = 't:omega': 'omega' is none of")
        call check("event='theta sideways' /", "s.nml:2:7: &scene: event = 'theta sideways': ")
        call check("event='theta' event_columns='t','y' /", &
                   "s.nml:2:33: &scene: event_columns = 'y': unknown column 'y'")
        call check("expect_small_period=1 /", "s.nml:2:21: &scene: expect_small_period = 1: needs")
        call check("method='boris' /", "s.nml:2:8: &scene: method = 'boris': boris is for charges")
        call check("t0=1e16 /", "s.nml:1:44: &scene: dt = 1e-2: is too small to move the time")
    contains
        subroutine check(rest, message)
            character(*), intent(in) :: rest, message
            type(run_plan_t) :: plan
            type(scene_t) :: scene
            class(system_t), allocatable :: system
            type(error_t), allocatable :: error

            call parse_scene(swing//rest, "s.nml", [word_t ::], scene, system, error)
            call assertFalse(allocated(error), "it is read: "//rest)
            if (allocated(error)) return
            call new_run_plan(plan, scene, system, error)
            call assertTrue(allocated(error), "it is refused: "//rest)
            if (.not. allocated(error)) return
            call assertEqual(message, error%message(:min(len(message), len(error%message))))
            call assertEqual(status_usage, error%status)
        end subroutine check
    end subroutine a_plans_refusal_has_its_place

    subroutine without_a_file_there_is_no_place()
        !! A scene that a program made is refused by the key alone.
        type(run_plan_t) :: plan
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        call parse_scene(swing//"/", "s.nml", [word_t ::], scene, system, error)
        call assertFalse(allocated(error), "it is read")
        if (allocated(error)) return
        deallocate (scene%file)
        scene%dt = -1.0_dp
        call new_run_plan(plan, scene, system, error)
        call assertTrue(allocated(error), "it is refused")
        if (.not. allocated(error)) return
        call assertEqual("must be positive and finite, not -1.0", error%message)
        call assertEqual("dt", error%key)
    end subroutine without_a_file_there_is_no_place
end module test_run_plan
