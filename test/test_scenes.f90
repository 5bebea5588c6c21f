module test_scenes
    !! Wrong scenes are refused before anything is computed, with place, key, value and remedy.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_kinds, only: dp
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: system_t
    use scene_runs, only: read_and_plan
    implicit none (type, external)
    private
    public :: scenes_suite

    character(*), parameter :: start = "&scene system='pendulum' "
    character(*), parameter :: head = start//"dt=1e-2 duration=1 q=1 "
    integer, parameter :: column = len(head) + 1  !! of what follows

contains

    function scenes_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("scenes")
        call suite%addTest(TestMethod("demanded_keys_are_named", demanded_keys_are_named))
        call suite%addTest(TestMethod("unknown_names_come_with_the_nearest", &
                                      unknown_names_come_with_the_nearest))
        call suite%addTest(TestMethod("wrong_times_are_refused", wrong_times_are_refused))
        call suite%addTest(TestMethod("wrong_samples_are_refused", wrong_samples_are_refused))
        call suite%addTest(TestMethod("wrong_states_are_refused", wrong_states_are_refused))
        call suite%addTest(TestMethod("wrong_parameters_are_refused", wrong_parameters_are_refused))
        call suite%addTest(TestMethod("wrong_outputs_are_refused", wrong_outputs_are_refused))
        call suite%addTest(TestMethod("impossible_expectations_are_refused", &
                                      impossible_expectations_are_refused))
        call suite%addTest(TestMethod("what_does_not_go_together_is_refused", &
                                      what_does_not_go_together_is_refused))
        call suite%addTest(TestMethod("overrides_are_checked_like_the_file", &
                                      overrides_are_checked_like_the_file))
        call suite%addTest(TestMethod("overrides_override", overrides_override))
        call suite%addTest(TestMethod("defaults_are_filled_in", defaults_are_filled_in))
        call suite%addTest(TestMethod("capitals_can_be_expected", capitals_can_be_expected))
    end function scenes_suite

    subroutine refused(text, message, override)
        !! Assert that a scene is refused by a message that begins so.
        character(*), intent(in) :: text, message
        character(*), intent(in), optional :: override
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(scene_t) :: scene
        type(word_t), allocatable :: words(:)

        allocate (words(merge(1, 0, present(override))))
        if (present(override)) words(1)%text = override
        call read_and_plan(text, "s.nml", words, scene, system, error)
        call assertTrue(allocated(error), "accepted: "//text)
        if (.not. allocated(error)) return
        call assertEqual(message, error%message(:min(len(message), len(error%message))))
        call assertEqual(status_usage, error%status)
        call assertEqual(0, scan(error%message, achar(10)//achar(13)), "one line")
    end subroutine refused

    subroutine after(rest, offset, problem)
        !! The same for what follows `head` in the scene's group; the blame is `offset` bytes on.
        character(*), intent(in) :: rest, problem
        integer, intent(in) :: offset
        character(8) :: place

        write (place, "(i0)") column + offset
        call refused(head//rest//" /", "s.nml:1:"//trim(place)//": &scene: "//problem)
    end subroutine after

    subroutine demanded_keys_are_named()
        !! System, step, duration and coordinates have no default.
        call refused("&scene /", "s.nml:1:1: &scene: system is missing; write system = value")
        call refused(start//"/", "s.nml:1:1: &scene: dt is missing; write dt = "// &
                     "value, or method = 'auto', which chooses its steps")
        call refused(start//"dt=1 /", "s.nml:1:1: &scene: duration is missing")
        call refused(start//"dt=1 duration=2 /", "s.nml:1:1: &scene: q is missing")
        call refused("&pendulum l=1 /", "s.nml: group &scene is missing; it must give system")
        call refused("", "s.nml: holds no group; a group is written: &name key")
    end subroutine demanded_keys_are_named

    subroutine unknown_names_come_with_the_nearest()
        !! Systems, methods, columns, keys, groups, coordinates; or with what there is.
        call refused("&scene system='pendulm' /", "s.nml:1:15: &scene: system = 'pendulm': "// &
                     "unknown system 'pendulm'; did you mean 'pendulum'?")
        call refused("&scene system='xyz' /", "s.nml:1:15: &scene: system = 'xyz': unknown "// &
                     "system 'xyz'; there are oscillator, pendulum, ")
        call after("method='rk5'", 7, "method = 'rk5': unknown method 'rk5'; did you mean 'rk4'?")
        call after("method='verlte'", 7, "method = 'verlte': unknown method 'verlte'; did you "// &
                   "mean 'verlet'?")
        call after("columns='t','thet'", 12, "columns = 'thet': unknown column 'thet'; did you "// &
                   "mean 'theta'?")
        call after("colums='t'", 0, "unknown key 'colums'; did you mean 'columns'?")
        call after("period_of='thet'", 10, "period_of = 'thet': a coordinate is needed: theta")
        call after("plot='t:thet'", 5, "plot = 't:thet': 'thet' is none of this scene's "// &
                   "columns; did you mean 'theta'?")
        call refused(head//"/ &pendulm l=2 /", "s.nml:1:51: unknown group 'pendulm'; did you "// &
                     "mean 'pendulum'?")
        call refused(head//"/ &pendulum lenght=2 /", "s.nml:1:61: &pendulum: unknown key "// &
                     "'lenght'; did you mean 'l'?")
    end subroutine unknown_names_come_with_the_nearest

    subroutine wrong_times_are_refused()
        !! Steps and durations that are not positive, not finite, too long, too many.
        call refused(start//"dt=0 duration=1 q=1 /", "s.nml:1:29: &scene: "// &
                     "dt = 0: a number greater than 0 is needed, in s")
        call refused(start//"dt=-1e-2 duration=1 q=1 /", "s.nml:1:29: &scene: "// &
                     "dt = -1e-2: a number greater than 0 is needed, in s")
        call refused(start//"dt=1 duration=0 q=1 /", "s.nml:1:40: &scene: "// &
                     "duration = 0: a number greater than 0 is needed, in s")
        call refused(start//"dt=nan duration=1 q=1 /", "s.nml:1:29: &scene: dt")
        call refused(start//"dt=1e400 duration=1 q=1 /", "s.nml:1:29: &scene: dt")
        call refused(start//"dt=2 duration=1 q=1 /", "s.nml:1:29: &scene: "// &
                     "dt = 2: is longer than the whole run, duration = 1.0")
        call refused(start//"dt=1e-30 duration=1 q=1 /", "s.nml:1:29: &scene: "// &
                     "dt = 1e-30: duration/dt = 9.999999999999999e29 steps are too many to count")
        call refused(start//"dt=1e-10 duration=1 q=1 t0=1e9 /", &
                     "s.nml:1:29: &scene: dt = 1e-10: is too small to move the time near t = "// &
                     "1000000001.0")
    end subroutine wrong_times_are_refused

    subroutine wrong_samples_are_refused()
        !! Either every or samples, whole and positive; samples divide the steps.
        call after("samples=7", 8, "samples = 7: does not divide the 100 steps; every = 14 "// &
                   "gives about as many")
        call after("samples=200", 8, "samples = 200: does not divide the 100 steps; every = 1 ")
        call after("samples=10 every=10", 8, "samples = 10: give either every or samples")
        call after("samples=0", 8, "samples = 0: at least 1 is needed")
        call after("every=0", 6, "every = 0: at least 1 is needed")
        call after("every=-3", 6, "every = -3: at least 1 is needed")
        call after("every=2.5", 6, "every = 2.5: is not a whole number")
    end subroutine wrong_samples_are_refused

    subroutine wrong_states_are_refused()
        !! As many coordinates and velocities as the system has; a disk must roll.
        call refused(start//"dt=1e-2 duration=1 q=1,2 /", "s.nml:1:49: &scene: "// &
                     "q = 2: 2 values, but 1 is needed: theta; a decimal point, no comma: 1.2")
        call refused("&scene system='double_pendulum' dt=1e-2 duration=1 q=1 /", "s.nml:1:54: "// &
                     "&scene: q = 1: 1 value, but 2 are needed: theta1, theta2")
        call refused("&scene system='hanging_chain' dt=1e-2 duration=1 q=1 / "// &
                     "&hanging_chain n=12 /", "s.nml:1:52: &scene: q = 1: 1 value, but "// &
                     "12 are needed: theta1, theta2, ..., theta12")
        call after("v=1,2", 2, "v = 1: v takes 1 value, not 2; a decimal point, no comma: 1.2")
        call refused("&scene system='rolling_disk' dt=1e-2 duration=1 q=4*0 v=1,2,3,4 /", &
                     "s.nml:1:57: &scene: v = 1: v does not roll")
    end subroutine wrong_states_are_refused

    subroutine wrong_parameters_are_refused()
        !! Outside their domains, of the wrong number or kind, given twice; by line and column.
        call refused(head//"/"//achar(10)//"&pendulum"//achar(10)//" l=-2 /", &
                     "s.nml:3:4: &pendulum: l = -2: greater than 0.0 is needed")
        call refused(head//"/ &pendulum g=-1 /", "s.nml:1:63: &pendulum: g = -1: at least 0.0")
        call refused(head//"/ &pendulum l=1,2 /", "s.nml:1:61: &pendulum: l")
        call refused(head//"/ &pendulum l='long' /", "s.nml:1:63: &pendulum: l = 'long': a number")
        call refused(head//"/ &pendulum l=1 l=2 /", "s.nml:1:65: &pendulum: l is given twice")
        call refused("&scene system='wedge' dt=1 duration=1 q=2*0 / &wedge alpha=2 /", &
                     "s.nml:1:60: &wedge: alpha = 2: from 0.0 to pi/2 is needed")
    end subroutine wrong_parameters_are_refused

    subroutine wrong_outputs_are_refused()
        !! Whatever could leave the output folder or surprise who reads the name.
        character(*), parameter :: names(*) = [character(12) :: "/etc/passwd", "../a", "a/../b", &
            "a/..", "..", "a;b", "a''", "a$(b)", "a`b`", "a|b", "-a", "a/", "a//b", "a.gp", "", &
            " ", "a*", "a\b", "~a", "a""", "a:b", "#a", &
            "c.nml", "d.html", "a/x.png", "a.b.svg", "x.pdf", "a.partial", ".gp"]
        integer :: i

        do i = 1, size(names)
            call after("output='"//trim(names(i))//"'", 7, "output = '"//trim(names(i))//"': a "// &
                       "file name below the output folder is needed: letters, digits, . _ - / "// &
                       "and blanks, not absolute, without '..', not ending in .gp, .html, "// &
                       ".nml, .pdf, .png, .svg or .partial")
        end do
    end subroutine wrong_outputs_are_refused

    subroutine impossible_expectations_are_refused()
        !! Of what is not measured, not known, not conserved; of less than nothing.
        call after("expect_period=1", 14, "expect_period = 1: needs period_of = 'a coordinate'")
        call after("expect_small_period=1", 20, "expect_small_period = 1: needs period_of = ")
        call after("expect_error=-1", 13, "expect_error = -1: a tolerance is at least 0")
        call after("expect_thet=1", 0, "unknown key 'expect_thet'; did you mean 'expect_theta'?")
        call refused("&scene system='double_pendulum' dt=1e-2 duration=1 q=1,2 "// &
                     "period_of='theta1' expect_period=1 /", "s.nml:1:91: &scene: "// &
                     "expect_period = 1: no such period of this motion is known")
        call refused("&scene system='double_pendulum' dt=1e-2 duration=1 q=1,2 "// &
                     "columns='t','error' /", "s.nml:1:70: &scene: columns = 'error': "// &
                     "column 'error': double_pendulum has no closed form from this start; with "// &
                     "expect_error it is estimated")
        call refused("&scene system='driven_pendulum' dt=1e-2 duration=1 q=1 "// &
                     "columns='energy_drift' /", "s.nml:1:64: &scene: columns = "// &
                     "'energy_drift': column 'energy_drift': the energy of this "// &
                     "driven_pendulum is not conserved, for L contains the time; there is "// &
                     "'energy_balance_drift'")
        call refused("&scene system='driven_pendulum' dt=1e-2 duration=1 q=1 "// &
                     "expect_energy_drift=1 /", "s.nml:1:76: &scene: expect_energy_drift = 1: "// &
                     "the energy of this driven_pendulum is not conserved, for L contains the time")
    end subroutine impossible_expectations_are_refused

    subroutine what_does_not_go_together_is_refused()
        !! A method and a system, sums that cannot be compensated, a column twice.
        call refused("&scene system='double_pendulum' method='verlet' dt=1e-2 duration=1 "// &
                     "q=1,2 /", &
                     "s.nml:1:40: &scene: method = 'verlet': verlet is for forces that depend "// &
                     "on positions only, and here they depend on velocities; these methods "// &
                     "work: rk4, ")
        call after("columns='theta','theta'", 16, &
                   "columns = 'theta': the column is there already")
        call after("compensated=.true. method='midpoint'", 12, "compensated = .true.: midpoint "// &
                   "has no compensated sums; these have: rk4, verlet, ")
    end subroutine what_does_not_go_together_is_refused

    subroutine overrides_are_checked_like_the_file()
        !! And it is the override that is to blame.
        call refused(head//"/", "--set scene%dtt=1: &scene: unknown key 'dtt'; did you mean "// &
                     "'dt'?", "scene%dtt=1")
        call refused(head//"/", "--set pendulum%g=-1: &pendulum: g = -1: at least 0.0 is needed", &
                     "pendulum%g=-1")
        call refused(head//"/", "--set wedge%alpha=1: unknown group 'wedge'; allowed: scene, "// &
                     "pendulum", "wedge%alpha=1")
        call refused(head//"/", "--set dt=1: expected GROUP%KEY=VALUE", "dt=1")
        call refused(head//"/", "--set scene%method=rk5: &scene: method = rk5: unknown method", &
                     "scene%method=rk5")
    end subroutine overrides_are_checked_like_the_file

    subroutine read(text, words, scene)
        !! A scene that must be good.
        character(*), intent(in) :: text
        type(word_t), intent(in) :: words(:)
        type(scene_t), intent(out) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        call read_and_plan(text, "s.nml", words, scene, system, error)
        call assertFalse(allocated(error), "a good scene")
        if (allocated(error)) call assertEqual("", error%message)
    end subroutine read

    subroutine overrides_override()
        !! Keys that the file gives and keys that it does not; texts without quotes; whole lists.
        type(scene_t) :: scene
        type(word_t) :: words(6)

        words(1)%text = "scene%dt=0.02"
        words(2)%text = "pendulum%l=2.5"
        words(3)%text = "scene%dt=0.02"
        words(4)%text = "scene%method=verlet"
        words(5)%text = "scene%columns='t','theta_dot'"
        words(6)%text = "SCENE%V = -0.25"
        call read(head//"columns='t' / &pendulum l=7 m=3 /", words, scene)
        call assertEqual([3.0_dp, 2.5_dp, 9.81_dp, 0.0_dp], scene%parameters)
        call assertEqual(0.02_dp, scene%dt)
        call assertEqual("verlet", scene%method)
        call assertEqual(["t        ", "theta_dot"], scene%columns)
        call assertEqual([1.0_dp, -0.25_dp], [scene%q, scene%v])
    end subroutine overrides_override

    subroutine defaults_are_filled_in()
        !! Rest, the system's parameters, rk4, about 1000 rows, the file's own name.
        type(scene_t) :: scene

        call read("&scene system='cart_pendulum' dt=1e-4 duration=1 q=1,2 /", [word_t ::], scene)
        call assertEqual([0.0_dp, 0.0_dp], scene%v)
        call assertEqual(4, size(scene%parameters))
        call assertEqual(9.81_dp, scene%parameters(4), message="gravity")
        call assertEqual("rk4", scene%method)
        call assertEqual(10, int(scene%every))
        call assertEqual("s", scene%output)
        call assertEqual([character(12) :: "t", "x", "theta", "energy_drift"], scene%columns)
        call assertEqual(0, size(scene%expectations))
        call read("&scene system='driven_pendulum' dt=1e-2 duration=1 q=1 /", [word_t ::], scene)
        call assertEqual([character(20) :: "t", "theta", "energy_balance_drift"], scene%columns)
        call assertEqual(1, int(scene%every))
        call read("&scene system='pendulum' dt=1e-2 duration=1 samples=5 q=1 /", [word_t ::], scene)
        call assertEqual(20, int(scene%every))
    end subroutine defaults_are_filled_in

    subroutine capitals_can_be_expected()
        !! Keys are the same in capitals and small letters; columns keep their capitals.
        type(scene_t) :: scene

        call read(head//"expect_L_z_drift=1e-9 / &pendulum g=0 /", [word_t ::], scene)
        call assertEqual(1, size(scene%expectations))
        if (size(scene%expectations) /= 1) return
        call assertEqual("L_z_drift", scene%expectations(1)%name)
        call assertEqual(1e-9_dp, scene%expectations(1)%limit)
    end subroutine capitals_can_be_expected
end module test_scenes
