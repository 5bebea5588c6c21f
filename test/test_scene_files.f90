module test_scene_files
    !! Every shipped scene runs within its own tolerances; what a run computes, and what it keeps
    !! where it fails.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: system_names
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t, status_file, status_numbers
    use lagrangia_kinds, only: dp
    use lagrangia_outcome, only: from_half_step, outcome_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: read_scene
    use lagrangia_shipped, only: shipped_scenes
    use lagrangia_system, only: system_t
    use scene_runs, only: plan_and_run, read_and_plan, run_with_files => perform
    implicit none (type, external)
    private
    public :: scene_files_suite

contains

    function scene_files_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("scene_files")
        call suite%addTest(TestMethod("every_scene_holds", every_scene_holds))
        call suite%addTest(TestMethod("an_estimate_says_so", an_estimate_says_so))
        call suite%addTest(TestMethod("what_is_not_asked_is_not_computed", &
                                      what_is_not_asked_is_not_computed))
        call suite%addTest(TestMethod("a_blow_up_keeps_what_was_good", &
                                      a_blow_up_keeps_what_was_good))
        call suite%addTest(TestMethod("a_column_that_overflows_ends_the_run", &
                                      a_column_that_overflows_ends_the_run))
        call suite%addTest(TestMethod("a_quantity_may_have_gaps", a_quantity_may_have_gaps))
        call suite%addTest(TestMethod("a_file_that_fails_is_a_failure", &
                                      a_file_that_fails_is_a_failure))
    end function scene_files_suite

    subroutine every_scene_holds()
        !! And every system of the catalogue has one.
        type(word_t), allocatable :: paths(:)
        type(error_t), allocatable :: error
        class(system_t), allocatable :: system
        type(outcome_t) :: outcome
        type(scene_t) :: scene
        character(name_length), allocatable :: names(:)
        integer :: i

        allocate (names, source=system_names())
        call shipped_scenes(paths)
        do i = 1, size(paths)
            call read_scene(paths(i)%text, [word_t ::], scene, system, error)
            call assertFalse(allocated(error), message=paths(i)%text)
            if (allocated(error)) return
            where (names == scene%system) names = ""
            call plan_and_run(scene, system, outcome, error)
            call assertEqual("holds", outcome%verdict(), paths(i)%text)
        end do
        call assertTrue(all(names == ""), message="a system has no scene")
    end subroutine every_scene_holds

    subroutine perform(text, outcome, error)
        !! Run the scene `text` without files.
        character(*), intent(in) :: text
        type(outcome_t), intent(out) :: outcome
        type(error_t), allocatable, intent(out) :: error
        class(system_t), allocatable :: system
        type(scene_t) :: scene

        call read_and_plan(text, "s.nml", [word_t ::], scene, system, error)
        call assertFalse(allocated(error), message=text)
        if (allocated(error)) return
        call plan_and_run(scene, system, outcome, error)
    end subroutine perform

    subroutine an_estimate_says_so()
        !! The double pendulum has no closed form: the run at half the step stands in for it.
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call perform("&scene system='double_pendulum' dt=1e-2 duration=1 q=1,2 expect_error=1 /", &
                     outcome, error)
        call assertEqual(from_half_step, outcome%error_from)
        call assertTrue(outcome%error() > 1e-9_dp .and. outcome%error() < 1e-4_dp, &
                        "outcome%error() > 1e-9 .and. outcome%error() < 1e-4")
    end subroutine an_estimate_says_so

    subroutine what_is_not_asked_is_not_computed()
        !! Four force evaluations a step, and an energy only where a column wants it.
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call perform("&scene system='pendulum' dt=1e-2 duration=1 every=10 q=1 columns='t' /", &
                     outcome, error)
        call assertEqual(400, int(outcome%evaluations))
        call assertEqual(0, int(outcome%energy_evaluations))
        call assertEqual(11, int(outcome%rows))
        call perform("&scene system='pendulum' dt=3e-2 duration=1 every=10 q=1 "// &
                     "columns='energy' /", &
                     outcome, error)
        call assertEqual(34, int(outcome%steps))
        call assertEqual(5, int(outcome%energy_evaluations))
        call assertTrue(index(outcome%remark, "shortened to 0.01") > 0, message=outcome%remark)
        call assertEqual(1.0_dp, outcome%t, 0.0_dp)
    end subroutine what_is_not_asked_is_not_computed

    subroutine a_blow_up_keeps_what_was_good()
        !! Verlet beyond its limit overflows: status 3, the last good state, the time.
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call perform("&scene system='oscillator' method='verlet' dt=10 duration=10000 every=1 "// &
                     "q=1 columns='t','x' /", outcome, error)
        call assertTrue(allocated(error), "an error: a blow up keeps what was good")
        if (.not. allocated(error)) return
        call assertEqual(status_numbers, error%status)
        call assertTrue(index(error%message, "not finite at t = ") > 0, message=error%message)
        call assertTrue(outcome%t > 0.0_dp .and. outcome%t < 10000.0_dp, &
                        "outcome%t > 0.0 .and. outcome%t < 10000.0")
        call assertTrue(abs(outcome%q(1)) < huge(1.0_dp), "abs(outcome%q(1)) < huge(1.0)")
        call assertEqual("failed", outcome%verdict())
    end subroutine a_blow_up_keeps_what_was_good

    subroutine a_column_that_overflows_ends_the_run()
        !! The energy does when the state is still finite: no such row is good, and no verdict on
        !! a column with NaN is. State and time are those where it was seen.
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call perform("&scene system='oscillator' method='verlet' dt=10 duration=10000 every=1 "// &
                     "q=1 columns='t','energy','energy_drift' expect_energy_drift=1e300 /", &
                     outcome, error)
        call assertTrue(allocated(error), "it fails")
        if (.not. allocated(error)) return
        call assertEqual(status_numbers, error%status)
        call assertEqual(1, index(error%message, "column 'energy' is not finite at t = "), &
                         error%message)
        call assertEqual("failed", outcome%verdict())
        call assertEqual(10*int(outcome%rows), nint(outcome%t), "rows before it")
        call assertTrue(abs(outcome%q(1)) > 1e150_dp .and. abs(outcome%q(1)) < huge(1.0_dp), &
                        "the state is finite")
        call assertTrue(outcome%drifts(1)%value < huge(1.0_dp), "the worst of the good rows")
    end subroutine a_column_that_overflows_ends_the_run

    subroutine a_quantity_may_have_gaps()
        !! The motion does without its number, which is NaN there; but no drift from it holds.
        character(*), parameter :: own = "&lagrangian coordinates='x' T='x_dot^2/2' V='x^2/2' "// &
            "quantities='u = 1/x', 'h = (x_dot^2 + x^2) sqrt(x)/sqrt(x)' /"
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call perform("&scene system='own' method='rk4' dt=1e-2 duration=1 q=0 v=1 "// &
                     "columns='t','u','h','h_drift' expect_h_drift=1 /"//own, outcome, error)
        call assertFalse(allocated(error), "it goes on")
        call assertEqual(101, int(outcome%rows), message="rows")
        call assertEqual(" (no finite number, and NaN: u in 1, h in 1, h_drift in 101 of 101 "// &
                         "rows)", outcome%remark, message="which, and how often")
        call assertEqual("NOT h_drift NaN > 1.0E+00", outcome%verdict(), message="from no number")
        call perform("&scene system='own' method='rk4' dt=1e-2 duration=1 q=1 v=0 "// &
                     "columns='t','u','h_drift' expect_h_drift=1e-6 /"//own, outcome, error)
        call assertEqual("", outcome%remark, message="x > 0")
        call assertEqual("holds", outcome%verdict(), message="x > 0")
    end subroutine a_quantity_may_have_gaps

    subroutine a_file_that_fails_is_a_failure()
        !! Not a scene that holds, and there is no file to name.
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call run_with_files("&scene system='pendulum' dt=1e-2 duration=1 q=1 expect_error=1 /", &
                            "/dev/null", "text", outcome, error)
        call assertTrue(allocated(error), "it fails")
        if (.not. allocated(error)) return
        call assertEqual(status_file, error%status)
        call assertEqual("failed", outcome%verdict())
        call assertEqual("", outcome%file)
        call assertEqual(error%message, outcome%failure)
    end subroutine a_file_that_fails_is_a_failure
end module test_scene_files
