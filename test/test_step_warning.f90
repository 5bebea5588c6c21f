module test_step_warning
    !! The warnings before a run that blows up, or comes to rest by dry friction.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_friction_warning, only: friction_warning
    use lagrangia_scene, only: scene_t
    use lagrangia_step_warning, only: step_warning
    use lagrangia_system, only: system_t
    use scene_runs, only: read_and_plan
    use test_friction_warning, only: friction_warning_suite
    implicit none (type, external)
    private
    public :: step_warning_suite

contains

    function step_warning_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("step_warning")
        call suite%addTest(TestMethod("long_steps_are_warned_of", long_steps_are_warned_of))
        call suite%addTest(TestMethod("a_long_chain_needs_no_modes", a_long_chain_needs_no_modes))
        call suite%addTest(TestMethod("nothing_is_said_without_a_limit", &
                                      nothing_is_said_without_a_limit))
        call suite%addTest(friction_warning_suite())
        call suite%addTest(TestMethod("dry_friction_is_named", dry_friction_is_named))
        call suite%addTest(TestMethod("what_does_not_jump_is_not", what_does_not_jump_is_not))
    end function step_warning_suite

    function warning_of(system_name, steps, parameters) result(text)
        !! Of a scene with these keys.
        character(*), intent(in) :: system_name, steps
        character(*), intent(in), optional :: parameters  !! of the system, else its defaults
        character(:), allocatable :: text
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        character(:), allocatable :: group

        group = ""
        if (present(parameters)) group = parameters
        call read_and_plan("&scene system = '"//system_name//"', duration = 10.0, "//steps//" /"// &
                         new_line("a")//"&"//system_name//" "//group//" /", "a.nml", &
                         [word_t ::], scene, system, error)
        call assertFalse(allocated(error), steps)
        text = "not read"
        if (.not. allocated(error)) text = step_warning(scene, system)
    end function warning_of

    subroutine long_steps_are_warned_of()
        !! Of the fastest mode, by the method's own limit: omega = sqrt(k/m) = 1 for the oscillator,
        !! sqrt(9.81 (2 + sqrt(2))) = 5.787 for the double pendulum.
        call assertEqual("dt = 2.01 s exceeds the step limit 2.0 s of verlet (2.0/omega_max, "// &
                         "omega_max = 1.0 rad/s): small oscillations would grow at every step", &
                         warning_of("oscillator", "method = 'verlet', dt = 2.01, q = 1.0"))
        call assertEqual("", warning_of("oscillator", "method = 'verlet', dt = 1.99, q = 1.0"))
        call assertEqual("", warning_of("oscillator", "method = 'rk4', dt = 2.82, q = 1.0"))
        call assertEqual("dt = 2.84 s", first_words( &
                         warning_of("oscillator", "method = 'rk4', dt = 2.84, q = 1.0")))
        call assertEqual("", warning_of("double_pendulum", "dt = 0.488, q = 0.5, 0.0"))
        call assertEqual("dt = 0.49 s", first_words( &
                         warning_of("double_pendulum", "dt = 0.49, q = 0.5, 0.0")))
        ! omega = sqrt(24.5/0.5) = 7: the limit is 2/7, neither 2 nor 14 nor 2/49
        call assertEqual("dt = 0.2858 s exceeds the step limit 0.2857 s of verlet "// &
                         "(2.0/omega_max, omega_max = 7.0 rad/s): small oscillations would "// &
                         "grow at every step", warning_of("oscillator", &
                         "method = 'verlet', dt = 0.2858, q = 1.0", "m = 0.5, k = 24.5"))
        call assertEqual("", warning_of("oscillator", "method = 'verlet', dt = 0.2856, q = 1.0", &
                                        "m = 0.5, k = 24.5"))
        ! slow: omega = sqrt(1.62/2) = 0.9, on the moon
        call assertEqual("", warning_of("pendulum", "method = 'verlet', dt = 2.22, q = 1.0", &
                                        "l = 2.0, g = 1.62"))
        call assertEqual("dt = 2.23 s exceeds the step limit 2.222 s of verlet (2.0/omega_max, "// &
                         "omega_max = 0.9 rad/s): small oscillations would grow at every step", &
                         warning_of("pendulum", "method = 'verlet', dt = 2.23, q = 1.0", &
                                    "l = 2.0, g = 1.62"))
    end subroutine long_steps_are_warned_of

    subroutine a_long_chain_needs_no_modes()
        !! The same warnings where a bound is looked at first. With n bobs on l = n the largest
        !! omega is that of g/l times the largest zero of Laguerre's polynomial: sqrt(9.81 142.28)
        !! = 37.36 for n = 40, and the bound is 39.5. Between them only the modes tell.
        character(*), parameter :: chain = "n = 40, l = 40.0", &
            start = "q = "//repeat("0.1, ", 39)//"0.1"

        call assertEqual("", warning_of("hanging_chain", "method = 'rk4', dt = 0.06, "//start, &
                                        chain))
        call assertEqual("", warning_of("hanging_chain", "method = 'rk4', dt = 0.0756, "//start, &
                                        chain))
        call assertEqual("dt = 0.0758 s", first_words( &
                         warning_of("hanging_chain", "method = 'rk4', dt = 0.0758, "//start, &
                                    chain)))
    end subroutine a_long_chain_needs_no_modes

    pure function first_words(text) result(words)
        !! Up to the unit.
        character(*), intent(in) :: text
        character(:), allocatable :: words

        words = text(:max(0, index(text, " exceeds") - 1))
    end function first_words

    subroutine nothing_is_said_without_a_limit()
        !! Methods that are stable or choose their steps, systems without an equilibrium.
        call assertEqual("", warning_of("oscillator", "method = 'gauss16', dt = 5.0, q = 1.0"))
        call assertEqual("", warning_of("oscillator", "method = 'dop853', tolerance = 1e-6, "// &
                                        "samples = 10, q = 1.0"))
        call assertEqual("", warning_of("atwood", "method = 'rk4', dt = 5.0, q = 1.0"))
    end subroutine nothing_is_said_without_a_limit

    function jump_of(forces) result(text)
        !! The function that the warning names, of x and y with these generalised forces.
        character(*), intent(in) :: forces  !! as a scene has them
        character(:), allocatable :: text
        character(*), parameter :: rest = " jumps where the motion turns: a body that it "// &
            "brings to rest is not held there, and steps become ever shorter; a smooth form is "// &
            "'tanh(x_dot/v0)', as in 'lagrangia show dry_friction'"
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        call read_and_plan("&scene system = 'two', q = 0.1, 0.1, duration = 1.0, dt = 0.1 / "// &
                           "&lagrangian coordinates = 'x', 'y' L = 'x_dot^2/2 + y_dot^2/2' "// &
                           forces//" / &two /", "a.nml", [word_t ::], scene, system, error)
        call assertFalse(allocated(error), forces)
        text = "not read"
        if (allocated(error)) return
        text = friction_warning(system)
        if (text == "") return
        call assertEqual(rest, text(index(text, " jumps"):), forces)
        text = text(:index(text, " jumps") - 1)
    end function jump_of

    subroutine dry_friction_is_named()
        !! The first jump in a velocity, with all that is in its brackets, of either coordinate.
        call assertEqual("'sgn(x_dot)'", jump_of("Q_x = '-2 sgn(x_dot)'"))
        call assertEqual("'sgn(y_dot)'", &
                         jump_of("Q_x = '-x_dot', Q_y = 'y - sgn(y_dot) - sgn(x_dot)'"))
        call assertEqual("'sgn(x_dot)'", jump_of("Q_x = 'sgn(x) - sgn(y) - sgn(x_dot) - x'"))
        call assertEqual("'sgn(2 (x_dot - sin(y)))'", jump_of("Q_x = '-sgn(2 (x_dot - sin(y))) x'"))
        call assertEqual("'sgn(x_dot)'", &
                         jump_of("Q_x = 'sgn(x)*y_dot - sgn(x_dot)', Q_y = '-sgn(y_dot)'"))
    end subroutine dry_friction_is_named

    subroutine what_does_not_jump_is_not()
        !! A smooth form, a jump at a place, and no force at all.
        call assertEqual("", jump_of("Q_x = '-tanh(x_dot/0.1)', Q_y = '-y_dot'"))
        call assertEqual("", jump_of("Q_x = '-sgn(x)*x_dot', Q_y = '-sgn(y - x)'"))
        call assertEqual("", jump_of(""))
    end subroutine what_does_not_jump_is_not
end module test_step_warning
