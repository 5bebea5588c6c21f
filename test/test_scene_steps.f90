module test_scene_steps
    !! Scenes that choose between steps of `dt` and a tolerance, and that look for events: what is
    !! taken, what is refused, and how it is echoed.
    use funit, only: anyExceptions, assertEqual, assertFalse, assertTrue, TestMethod, TestSuite
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_scene, only: scene_line_length, scene_lines, scene_t
    use lagrangia_system, only: system_t
    use scene_runs, only: read_and_plan
    implicit none (type, external)
    private
    public :: scene_steps_suite

    character(*), parameter :: pendulum = "system = 'pendulum', q = 1.0, duration = 2.0, "
    character(*), parameter :: adaptive = "method = 'dop853', "

contains

    function scene_steps_suite() result(suite)
        type(TestSuite) :: suite

        suite = TestSuite("scene_steps")
        call suite%addTest(TestMethod("a tolerance and samples have defaults", defaults))
        call suite%addTest(TestMethod("dt means fixed steps", fixed_steps))
        call suite%addTest(TestMethod("steps are refused that cannot be meant", refused_steps))
        call suite%addTest(TestMethod("events are refused that cannot be meant", refused_events))
        call suite%addTest(TestMethod("the effective scene makes the same scene", echo))
    end function scene_steps_suite

    subroutine parse(keys, scene, system, error)
        character(*), intent(in) :: keys
        type(scene_t), intent(out) :: scene
        class(system_t), allocatable, intent(out) :: system
        type(error_t), allocatable, intent(out) :: error

        call read_and_plan("&scene "//keys//" /", "x.nml", [word_t ::], scene, system, error)
    end subroutine parse

    subroutine refused(keys, message)
        !! Everything behind the place, `x.nml:1:...: &scene: `.
        character(*), intent(in) :: keys, message
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        call parse(keys, scene, system, error)
        call assertTrue(allocated(error), "refused: "//keys)
        if (.not. allocated(error)) return
        call assertEqual(message, error%message(index(error%message, "&scene: ") + 8:), &
                         message=keys)
    end subroutine refused

    subroutine defaults()
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        call parse(pendulum//adaptive, scene, system, error)
        call assertFalse(allocated(error), "taken")
        if (anyExceptions()) return
        call assertEqual(1e-10_dp, scene%tolerance, message="tolerance")
        call assertEqual(1000, int(scene%samples), message="samples")
        call parse(pendulum//adaptive//"tolerance = 1e-15, samples = 1", scene, system, error)
        call assertFalse(allocated(error), "the smallest tolerance, the fewest samples")
    end subroutine defaults

    subroutine fixed_steps()
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        call parse(pendulum//"method = 'gauss16', dt = 0.1", scene, system, error)
        call assertFalse(allocated(error), "taken")
        if (anyExceptions()) return
        call assertEqual(0.0_dp, scene%tolerance, message="no tolerance")
        call assertEqual(0.1_dp, scene%dt, message="dt")
    end subroutine fixed_steps

    subroutine refused_steps()
        call refused(pendulum//"method = 'rk4', tolerance = 1e-9", "tolerance = 1e-9: method "// &
                     "'rk4' takes steps of dt; methods that keep a tolerance: gauss16, dop853")
        call refused(pendulum//adaptive//"dt = 0.1", "dt = 0.1: method 'dop853' chooses its "// &
                     "steps: give tolerance and samples instead")
        call refused(pendulum//"method = 'gauss16', tolerance = 1e-9, dt = 0.1", &
                     "tolerance = 1e-9: give either dt, for steps of that length, or "// &
                     "tolerance, for steps that keep to it")
        call refused(pendulum//adaptive//"every = 7", "every = 7: counts steps of dt; with a "// &
                     "tolerance give samples")
        call refused(pendulum//adaptive//"tolerance = 1e-17", "tolerance = 1e-17: is below the "// &
                     "precision of numbers; the smallest sensible one is 1e-15")
        call refused(pendulum//adaptive//"tolerance = 0", "tolerance = 0: is below the "// &
                     "precision of numbers; the smallest sensible one is 1e-15")
        call refused(pendulum//adaptive//"tolerance = -1e-9", "tolerance = -1e-9: is below the "// &
                     "precision of numbers; the smallest sensible one is 1e-15")
        call refused(pendulum//adaptive//"tolerance = 0.2", "tolerance = 0.2: at most 0.1 is "// &
                     "sensible")
        call refused(pendulum//adaptive//"samples = 0", "samples = 0: at least 1 is needed")
        call refused(pendulum//adaptive//"samples = 9000000000000000", &
                     "samples = 9000000000000000: 9000000000000000 samples are too many; make "// &
                     "the run shorter or give fewer")
        call refused(pendulum//adaptive//"t0 = 1e9, samples = 1e9", &
                     "samples = 1e9: so many samples cannot be told apart near t = "// &
                     "1000000002.0 s")
        call refused(pendulum//adaptive//"compensated = .true.", "compensated = .true.: is for "// &
                     "steps of dt; a tolerance leaves more than rounding")
        call refused(pendulum//"method = 'dop85'", "method = 'dop85': unknown method 'dop85'; "// &
                     "did you mean 'dop853'?")
    end subroutine refused_steps

    subroutine refused_events()
        character(*), parameter :: scene = pendulum//adaptive
        character(*), parameter :: looks = &
            "event = 'theta = 0.5 rising' or event = 'theta_dot falling stop'"
        character(*), parameter :: behind = "behind '=' a number is needed, or a formula of "// &
            "numbers: "

        call refused(scene//"event = ' '", "event = ' ': an event needs a column, as in "//looks)
        call refused(scene//"event = 'tehta'", &
                     "event = 'tehta': unknown column 'tehta'; did you mean 'theta'?")
        call refused(scene//"event = 'theta', 'theta = '", &
                     "event = 'theta = ': a number is needed behind '=', as in "//looks)
        call refused(scene//"event = 'theta = up'", &
                     "event = 'theta = up': "//behind//"'up': column 1: unknown name 'up'; "// &
                     "there is only pi")
        call refused(scene//"event = 'theta = 1e999'", &
                     "event = 'theta = 1e999': "//behind//"'1e999': column 1: '1e999' is "// &
                     "too large for a double (at most 1.79769e308)")
        call refused(scene//"event = 'theta = 45 deg'", &
                     "event = 'theta = 45 deg': "//behind//"'45 deg': no degrees are read; an "// &
                     "angle is in radians, 0.7853981633974483")
        call refused(scene//"event = 'theta = 1/0 rising'", &
                     "event = 'theta = 1/0 rising': "//behind//"'1/0' is no number")
        call refused(scene//"event = 'theta = pi/2 risng'", "event = 'theta = pi/2 risng': "// &
                     "'risng' is none of rising, falling, stop; an event looks like "//looks)
        call refused(scene//"event = 'theta = 0 rising falling'", &
                     "event = 'theta = 0 rising falling': rising or falling, not both: without "// &
                     "these words an event is found both ways")
        call refused(scene//"event = 'theta upwards'", "event = 'theta upwards': 'upwards' is "// &
                     "none of rising, falling, stop; an event looks like "//looks)
        call refused(scene//"event = 'energy_drift'", &
                     "event = 'energy_drift': 'energy_drift' is no function of the state alone")
        call refused(scene//"event_columns = 't'", &
                     "event_columns = 't': there is no event to write down")
        call refused(scene//"event_plot = 't:theta'", &
                     "event_plot = 't:theta': there is no event to write down")
        call refused(scene//"event = 'theta', event_columns = 't', 'theta', 'error'", &
                     "event_columns = 'error': errors and drifts are columns of "// &
                     "the run, not of its events")
        call refused(scene//"event = 'theta', event_columns = 't', 'tetha'", &
                     "event_columns = 'tetha': unknown column 'tetha'; did you mean 'theta'?")
        call refused(scene//"event = 'theta', event_plot = 'theta:tension'", &
                     "event_plot = 'theta:tension': 'tension' is none of this scene's columns; "// &
                     "'event_columns' adds it")
        call refused(scene//"event = 'theta', event_plot = 'theta:tensoin'", &
                     "event_plot = 'theta:tensoin': 'tensoin' is none of this scene's columns; "// &
                     "did you mean 'tension', which 'event_columns' adds?")
        call refused(scene//"event = 'theta', event_plot = 'foo'", &
                     "event_plot = 'foo': 'foo' is none of this scene's columns; "// &
                     "there are t, theta; 'event_columns' adds others, 'lagrangia describe "// &
                     "pendulum' has all")
        call refused("system = 'bouncing_ball', duration = 1.0, q = -0.1, "//adaptive, &
                     "q = -0.1: violates the constraint, unilateral: y >= 0, lambda >= 0, "// &
                     "lambda y = 0")
    end subroutine refused_events

    subroutine echo()
        !! Parsed, echoed, parsed and echoed again.
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(description_t) :: d
        character(scene_line_length), allocatable :: first(:), second(:)
        character(:), allocatable :: text
        integer :: i

        call parse(pendulum//adaptive//"tolerance = 1e-12, samples = 20, event = 'theta_dot', "// &
                   "'theta = 0.1 rising', event_columns = 't', 'tension', event_plot = "// &
                   "'t:tension'", scene, system, error)
        call assertFalse(allocated(error), "taken")
        if (anyExceptions()) return
        call system%describe(d)
        first = scene_lines(scene, d)
        text = ""
        do i = 1, size(first)
            text = text//trim(first(i))//new_line("a")
        end do
        call assertTrue(index(text, "tolerance = 1e-12") > 0, "tolerance")
        call assertTrue(index(text, "event = 'theta_dot', 'theta = 0.1 rising'") > 0, "event")
        call read_and_plan(text, "x.nml", [word_t ::], scene, system, error)
        call assertFalse(allocated(error), "taken again")
        if (anyExceptions()) return
        second = scene_lines(scene, d)
        call assertEqual(size(first), size(second), message="lines")
        call assertTrue(all(first == second), "the same")
    end subroutine echo
end module test_scene_steps
