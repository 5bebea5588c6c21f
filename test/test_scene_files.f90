module test_scene_files
    !! Every shipped scene runs within its own tolerances and comes back from its own echo; wrong
    !! scenes are refused in these words.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: system_names
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t, status_numbers
    use lagrangia_json, only: json_number, json_string
    use lagrangia_kinds, only: dp
    use lagrangia_observer, only: observer_t
    use lagrangia_outcome, only: from_half_step, outcome_t
    use lagrangia_play, only: play
    use lagrangia_scene, only: scene_line_length, scene_lines, scene_t
    use lagrangia_scene_reader, only: parse_scene, read_scene
    use lagrangia_shipped, only: shipped_scenes
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: scene_files_suite

    character(*), parameter :: good = "&scene system='pendulum' dt=1e-2 duration=1 q=1 /"

contains

    function scene_files_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("scene_files")
        call suite%addTest(TestMethod("every_scene_holds", every_scene_holds))
        call suite%addTest(TestMethod("every_echo_is_the_scene", every_echo_is_the_scene))
        call suite%addTest(TestMethod("wrong_scenes_are_refused", wrong_scenes_are_refused))
        call suite%addTest(TestMethod("overrides_override", overrides_override))
        call suite%addTest(TestMethod("json_has_no_nan", json_has_no_nan))
        call suite%addTest(TestMethod("an_estimate_says_so", an_estimate_says_so))
        call suite%addTest(TestMethod("what_is_not_asked_is_not_computed", &
                                      what_is_not_asked_is_not_computed))
        call suite%addTest(TestMethod("a_blow_up_keeps_what_was_good", &
                                      a_blow_up_keeps_what_was_good))
    end function scene_files_suite

    subroutine every_scene_holds()
        !! And every system of the catalogue has one.
        type(word_t), allocatable :: paths(:)
        type(error_t), allocatable :: error
        class(system_t), allocatable :: system
        class(observer_t), pointer :: nobody
        type(outcome_t) :: outcome
        type(scene_t) :: scene
        character(name_length), allocatable :: names(:)
        integer :: i

        nobody => null()
        allocate (names, source=system_names())
        call shipped_scenes(paths, error)
        call assertFalse(allocated(error), message="data/scenes")
        if (allocated(error)) return
        do i = 1, size(paths)
            call read_scene(paths(i)%text, [word_t ::], scene, system, error)
            call assertFalse(allocated(error), message=paths(i)%text)
            if (allocated(error)) return
            where (names == scene%system) names = ""
            call play(scene, system, "", "text", nobody, outcome, error)
            call assertEqual("holds", outcome%verdict(), paths(i)%text)
        end do
        call assertTrue(all(names == ""), message="a system has no scene")
    end subroutine every_scene_holds

    subroutine every_echo_is_the_scene()
        !! All defaults filled in, pasted back: the same numbers, bit for bit.
        type(word_t), allocatable :: paths(:)
        type(error_t), allocatable :: error
        class(system_t), allocatable :: system
        type(scene_t) :: scene, again
        type(word_t) :: later(1)
        type(description_t) :: d
        character(scene_line_length), allocatable :: lines(:)
        character(:), allocatable :: text
        integer :: i, k

        later(1)%text = "scene%t0=0.3"  ! a default does not show whether it is echoed
        call shipped_scenes(paths, error)
        do i = 1, size(paths)
            call read_scene(paths(i)%text, later, scene, system, error)
            call system%describe(d)
            allocate (lines, source=scene_lines(scene, d))
            text = ""
            do k = 1, size(lines)
                text = text//trim(lines(k))//new_line("a")
            end do
            call parse_scene(text, paths(i)%text, [word_t ::], again, system, error)
            call assertFalse(allocated(error), message=paths(i)%text)
            if (allocated(error)) return
            call assertEqual([scene%t0, scene%dt, scene%duration, scene%q, scene%v, &
                              scene%parameters], &
                             [again%t0, again%dt, again%duration, again%q, again%v, &
                              again%parameters], 0.0_dp, paths(i)%text)
            call assertTrue(scene%every == again%every .and. all(scene%columns == again%columns))
            call assertEqual(trim(scene%title), trim(again%title))
            deallocate (lines)
        end do
    end subroutine every_echo_is_the_scene

    subroutine wrong_scenes_are_refused()
        !! With file, line, column, key, value and remedy.
        call refuse("&scene /", "s.nml:1:1: &scene: system is missing; write system = value")
        call refuse("&scene system='pendulm' /", "s.nml:1:15: &scene: system = 'pendulm': "// &
                    "unknown system 'pendulm'; did you mean 'pendulum'?")
        call refuse("&scene system='pendulum' /", "s.nml:1:1: &scene: dt is missing; write "// &
                    "dt = value")
        call refuse("&scene system='pendulum' dt=0 duration=1 q=1 /", "s.nml:1:29: &scene: "// &
                    "dt = 0: a number greater than 0 is needed, in s")
        call refuse("&scene system='pendulum' dt=2 duration=1 q=1 /", "s.nml:1:29: &scene: "// &
                    "dt = 2: is longer than the whole run, duration = 1.0")
        call refuse("&scene system='pendulum' dt=1e-2 duration=1 q=1,2 /", "s.nml:1:47: "// &
                    "&scene: "// &
                    "q = 1: 2 values, but 1 is needed: theta")
        call refuse(good//"&pendulum lenght=2 /", "s.nml:1:60: &pendulum: unknown key "// &
                    "'lenght'; "// &
                    "allowed: m, l, g")
        call refuse(good//"&pendulum l=-2 /", "s.nml:1:62: &pendulum: l = -2: greater than 0.0 "// &
                    "is needed")
        call refuse(good//"&pendulm l=2 /", "s.nml:1:50: unknown group 'pendulm'; did you mean "// &
                    "'pendulum'?")
        call refuse("&scene system='pendulum' dt=1e-2 duration=1 q=1 colums='t' /", &
                    "s.nml:1:49: &scene: unknown key 'colums'; did you mean 'columns'?")
        call refuse("&scene system='pendulum' dt=1e-2 duration=1 q=1 columns='t','thet' /", &
                    "s.nml:1:61: &scene: columns = 'thet': unknown column 'thet'; did you mean "// &
                    "'theta'?")
        call refuse("&scene system='pendulum' dt=1e-2 duration=1 q=1 samples=7 /", &
                    "s.nml:1:57: &scene: samples = 7: does not divide the 100 steps; every = "// &
                    "14 "// &
                    "gives about as many")
        call refuse("&scene system='pendulum' dt=1e-2 duration=1 q=1 output='../a' /", &
                    "s.nml:1:56: &scene: output = '../a': a file name below the output "// &
                    "folder is "// &
                    "needed: letters, digits, . _ - / and blanks, not absolute, without '..', "// &
                    "not ending in .gp")
        call refuse("&scene system='pendulum' dt=1e-2 duration=1 q=1 expect_period=1 /", &
                    "s.nml:1:63: &scene: expect_period = 1: needs period_of = 'a coordinate'")
        call refuse("&scene system='driven_pendulum' dt=1e-2 duration=1 q=1 "// &
                    "columns='energy_drift' /", "s.nml:1:64: &scene: columns = 'energy_drift': "// &
                    "column 'energy_drift': the energy of this driven_pendulum is not "// &
                    "conserved, for L contains the time")
        call refuse("&scene system='double_pendulum' method='verlet' dt=1e-2 duration=1 q=1,2 /", &
                    "s.nml:1:40: &scene: method = 'verlet': verlet is for forces that depend "// &
                    "on "// &
                    "positions only")
        call refuse("&scene system='rolling_disk' dt=1e-2 duration=1 q=4*0 v=1,2,3,4 /", &
                    "s.nml:1:57: &scene: v = 1")
    end subroutine wrong_scenes_are_refused

    subroutine refuse(text, message)
        !! Assert that the scene `text` is refused by a message that begins with `message`.
        character(*), intent(in) :: text, message
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(scene_t) :: scene

        call parse_scene(text, "s.nml", [word_t ::], scene, system, error)
        call assertTrue(allocated(error), message="accepted: "//text)
        if (.not. allocated(error)) return
        call assertEqual(message, error%message(:min(len(message), len(error%message))))
        call assertEqual(2, error%status)
    end subroutine refuse

    subroutine json_has_no_nan()
        !! Numbers with 17 digits, strings escaped, `null` for what is not a number.
        call assertEqual("1.0000000000000001E-001", json_number(0.1_dp))
        call assertEqual("null", json_number(ieee_value(1.0_dp, ieee_quiet_nan)))
        call assertEqual('"a\"b\\c\u0009."', json_string('a"b\c'//achar(9)//"."))
    end subroutine json_has_no_nan

    subroutine overrides_override()
        !! `--set` changes the scene's and the system's values.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(scene_t) :: scene
        type(word_t) :: words(2)

        words(1)%text = "scene%dt=0.02"
        words(2)%text = "pendulum%l=2.5"
        call parse_scene(good, "s.nml", words, scene, system, error)
        call assertFalse(allocated(error))
        if (allocated(error)) return
        call assertEqual(0.02_dp, scene%dt, 0.0_dp)
        call assertEqual(2.5_dp, scene%parameters(2), 0.0_dp)
    end subroutine overrides_override

    subroutine perform(text, outcome, error)
        !! Run the scene `text` without files.
        character(*), intent(in) :: text
        type(outcome_t), intent(out) :: outcome
        type(error_t), allocatable, intent(out) :: error
        class(system_t), allocatable :: system
        class(observer_t), pointer :: nobody
        type(scene_t) :: scene

        nobody => null()
        call parse_scene(text, "s.nml", [word_t ::], scene, system, error)
        call assertFalse(allocated(error), message=text)
        if (allocated(error)) return
        call play(scene, system, "", "text", nobody, outcome, error)
    end subroutine perform

    subroutine an_estimate_says_so()
        !! The double pendulum has no closed form: the run at half the step stands in for it.
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call perform("&scene system='double_pendulum' dt=1e-2 duration=1 q=1,2 expect_error=1 /", &
                     outcome, error)
        call assertEqual(from_half_step, outcome%error_from)
        call assertTrue(outcome%error() > 1e-9_dp .and. outcome%error() < 1e-4_dp)
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
                     "q=1 /", outcome, error)
        call assertTrue(allocated(error))
        if (.not. allocated(error)) return
        call assertEqual(status_numbers, error%status)
        call assertTrue(index(error%message, "not finite at t = ") > 0, message=error%message)
        call assertTrue(outcome%t > 0.0_dp .and. outcome%t < 10000.0_dp)
        call assertTrue(abs(outcome%q(1)) < huge(1.0_dp))
        call assertEqual("failed", outcome%verdict())
    end subroutine a_blow_up_keeps_what_was_good
end module test_scene_files
