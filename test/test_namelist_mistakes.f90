module test_namelist_mistakes
    !! What students type, and the line that tells them what to write.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_kinds, only: dp
    use lagrangia_namelist, only: apply_override, get_real, get_reals, namelist_t, &
                                  parse_namelist, point_advice, refuse_unknown_keys
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: read_named_system
    use lagrangia_system, only: system_t
    use scene_runs, only: read_and_plan
    implicit none (type, external)
    private
    public :: namelist_mistakes_suite

    character(1), parameter :: lf = achar(10)
    character(*), parameter :: computed = ": a number is needed, nothing is computed"
    character(*), parameter :: stray = &
        "; '=' stands behind a key, quotes around a text, '!' before a comment"
    character(*), parameter :: point = "; a decimal point, no comma: "

contains

    function namelist_mistakes_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("namelist mistakes")
        call suite%addTest(TestMethod("misread_numbers", misread_numbers))
        call suite%addTest(TestMethod("decimal_commas", decimal_commas))
        call suite%addTest(TestMethod("strays", strays))
        call suite%addTest(TestMethod("slips_for_what_is_missing", slips_for_what_is_missing))
        call suite%addTest(TestMethod("keys_of_a_scene", keys_of_a_scene))
        call suite%addTest(TestMethod("values_of_a_scene", values_of_a_scene))
    end function namelist_mistakes_suite

    subroutine refused(text, expected, key)
        !! Parsing `text` fails with just this message, or reading a number at `key` of `&a`.
        character(*), intent(in) :: text, expected
        character(*), intent(in), optional :: key
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        real(dp) :: x

        call parse_namelist(text, "a.nml", tree, error)
        if (present(key) .and. .not. allocated(error)) call get_real(tree, "a", key, x, error)
        call failed(error, "a.nml:"//expected)
    end subroutine refused

    subroutine failed(error, expected)
        !! There is an error with just this message.
        type(error_t), allocatable, intent(in) :: error
        character(*), intent(in) :: expected

        call assertTrue(allocated(error), message="not refused: "//expected)
        if (.not. allocated(error)) return
        call assertEqual(expected, error%message)
        call assertEqual(status_usage, error%status)
    end subroutine failed

    subroutine no_scene(keys, expected, set)
        !! A pendulum's scene with these keys, or with this override, is refused in a message that
        !! ends so.
        character(*), intent(in) :: keys, expected
        character(*), intent(in), optional :: set
        type(word_t), allocatable :: overrides(:)
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        allocate (overrides(merge(1, 0, present(set))))
        if (present(set)) overrides(1)%text = set
        call read_and_plan("&scene system = 'pendulum' "//keys//" /", "a.nml", &
                         overrides, scene, system, error)
        call assertTrue(allocated(error), message="not refused: "//expected)
        if (.not. allocated(error)) return
        call assertEqual(expected, error%message(max(1, len(error%message) - len(expected) + 1):))
        call assertEqual(status_usage, error%status)
    end subroutine no_scene

    subroutine misread_numbers()
        !! What means a number is told what to write; a repeat count is none of it.
        character(*), parameter :: minus = char(226)//char(136)//char(146)
        character(*), parameter :: degree = char(194)//char(176), pi = char(207)//char(128)
        character(*), parameter :: radians = ": no degrees are read; an angle is in "// &
                                   "radians, 0.7853981633974483"
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        real(dp) :: x

        call refused("&a q=1, pi/4 /", &
                     "1:9: &a: q: 'pi/4'"//computed//"; write 0.7853981633974483")
        call refused("&a q="//pi//"/4, 1 /", &
                     "1:6: &a: q: 'pi/4': U+03C0 is no plain 'pi'; write 0.7853981633974483")
        call refused("&a q=-Pi, 1 /", "1:6: &a: q: '-Pi'"//computed//"; write -3.141592653589793")
        call refused("&a q=2*pi /", "1:6: &a: q: '2*pi'"//computed//"; write 6.283185307179586")
        call refused("&a q=3*0.5*2 /", "1:6: &a: q: '3*0.5*2'"//computed//"; write 3.0")
        call refused("&a q=1.5 * 2 /", "1:6: &a: q: '1.5 * 2'"//computed//"; write 3.0")
        call refused("&a q=10^-3 /", "1:6: &a: q: '10^-3'"//computed//"; write 0.001")
        call refused("&a q=3.0*10^2 /", "1:6: &a: q: '3.0*10^2'"//computed//"; write 300.0")
        call refused("&a q=-2^2/10 /", "1:6: &a: q: '-2^2/10'"//computed//"; write -0.4")
        call refused("&a q=2pi/4 /", "1:6: &a: q: '2pi/4'"//computed//"; write 1.5707963267948966")
        call refused("&a q=1 2 pi /", "1:8: &a: q: '2 pi'"//computed//"; write 6.283185307179586")
        call refused("&a q=57,3deg /", "1:9: &a: q: '3deg': a decimal point, no comma, is "// &
                     "needed before it; or a blank behind the comma")
        call refused("&a q=10**-3/", "1:6: &a: q: '10**-3'"//computed//"; write 0.001")
        call refused("&a q=45deg"//lf//"/", "1:6: &a: q: '45deg'"//radians)
        call refused("&a q=45"//degree//", 1/", "1:6: &a: q: '45deg'"//radians)
        call refused("&a q=45 Degrees! c"//lf//"/", "1:6: &a: q: '45 Degrees'"//radians)
        call refused("&a q=0.5rad /", "1:6: &a: q: '0.5rad'"//computed//"; write 0.5")
        call refused("&a q="//minus//"0.5 /", &
                     "1:6: &a: q: '-0.5': U+2212 is no plain '-'; write -0.5")
        call refused("&a q=1e"//minus//"3 /", &
                     "1:6: &a: q: '1e-3': U+2212 is no plain '-'; write 0.001")
        call refused("&a q=pie /", "1:6: &a: q = pie: a number is needed, such as 0.01", "q")
        call refused("&a q=2*3.0, 1/", "1:4: &a: q has 3 values; one is needed; 3*x means x, "// &
                     "x, x", "q")
        call parse_namelist("&a s = '5' /", "a.nml", tree, error)
        call get_real(tree, "a", "s", x, error)
        call failed(error, "a.nml:1:8: &a: s = '5': a number is needed, without quotes")
        call apply_override(tree, "a%x=pi/4", error)
        call get_real(tree, "a", "x", x, error)
        call failed(error, "--set a%x=pi/4: &a: x = pi/4"//computed//"; write 0.7853981633974483")
        call apply_override(tree, "a%q=2*pi", error)
        call failed(error, "--set a%q=2*pi: &a: q: '2*pi'"//computed//"; write 6.283185307179586")
    end subroutine misread_numbers

    subroutine decimal_commas()
        !! Values that came apart at them are put together.
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:)
        real(dp) :: x

        call parse_namelist("&a g = 9,81 q = -0,5,1,25e-1 n = 1,000 x = 1, 2 y = 1.5,2 "// &
                            " z = 1,2 T h(2) = 1 /", "a.nml", tree, error)
        call get_real(tree, "a", "g", x, error)
        call failed(error, "a.nml:1:4: &a: g has 2 values; one is needed"//point//"9.81")
        call get_reals(tree, "a", "q", 2, 2, q, error)
        call failed(error, "a.nml:1:13: &a: q has 4 values; 2 are needed"//point//"-0.5, 1.25e-1")
        call get_reals(tree, "a", "q", 3, 3, q, error)
        call failed(error, "a.nml:1:13: &a: q has 4 values; 3 are needed")
        call get_real(tree, "a", "n", x, error)
        call failed(error, "a.nml:1:30: &a: n has 2 values; one is needed"//point// &
                    "1.000 (or 1000)")
        call get_real(tree, "a", "x", x, error)
        call failed(error, "a.nml:1:40: &a: x has 2 values; one is needed")
        call get_real(tree, "a", "z", x, error)
        call failed(error, "a.nml:1:60: &a: z has 3 values; one is needed")
        call get_real(tree, "a", "y", x, error)
        call failed(error, "a.nml:1:49: &a: y has 2 values; one is needed")
        call assertEqual(point//"9.81", point_advice(tree, "a", "g", 1))
        call assertEqual("", point_advice(tree, "a", "h", 1), "no advice on a hole")
        call parse_namelist("&a b = 1.000,5 c = 1 000 d = -12 345 678,5 e = 1 00 f = 1 000,2 "// &
                            "k = 1.50,5 l = 0 500 /", "a.nml", tree, error)
        call assertEqual("; a decimal point, no comma, nothing between thousands: 1000.5", &
                         point_advice(tree, "a", "b", 1))
        call assertEqual("; nothing between thousands: 1000", point_advice(tree, "a", "c", 1))
        call assertEqual("; a decimal point, no comma, nothing between thousands: -12345678.5", &
                         point_advice(tree, "a", "d", 1))
        call assertEqual("", point_advice(tree, "a", "e", 1), "two digits are no group")
        call assertEqual("; a decimal point, no comma, nothing between thousands: 1000.2", &
                         point_advice(tree, "a", "f", 1))
        call assertEqual("", point_advice(tree, "a", "k", 1), "no group before the comma")
        call assertEqual("", point_advice(tree, "a", "l", 1), "0 500 is no number")
        call assertEqual("", point_advice(tree, "a", "absent", 1), "no advice on nothing")
    end subroutine decimal_commas

    subroutine strays()
        !! A unit, a key without `=`, a comment without `!`; a truth is none of them.
        type(namelist_t) :: tree
        type(error_t), allocatable :: error

        call refused("&a dt = 10 ms /", "1:12: &a: dt: unexpected 'ms' behind a number; units "// &
                     "are not written: all are SI, angles in radians")
        call refused("&a x = 1"//lf//"dt 2 /", "2:1: &a: unexpected 'dt'"//stray)
        call refused("&a x = 1"//lf//"every: 5 /", "2:1: &a: '=' stands behind a key, not ':'; "// &
                     "write every = ...")
        call refused("&a x = 1, every : 5 /", "1:11: &a: '=' stands behind a key, not ':'; "// &
                     "write every = ...")
        call refused("&a x = 1 # one"//lf//"/", "1:10: &a: x: unexpected '#'"//stray)
        call refused("&a s = 'b' modes /", "1:12: &a: s: unexpected 'modes'"//stray)
        call refused("&a s = 'b'"//lf//"dt := 1 /", "2:1: &a: '=' stands behind a key, "// &
                     "not ':'; write dt = ...")
        call refused("&a x = 1, &"//lf//" 2 /", "1:11: &a: a lone '&'; a list goes on in the "// &
                     "next line without it, and '/' ends a group")
        call refused("&a dt => 1 /", "1:8: &a: dt = >: "//stray(3:), "dt")
        call parse_namelist("&a flags = .true. F true"//lf//"t /", "a.nml", tree, error)
        call assertFalse(allocated(error), message="truths in a row")
    end subroutine strays

    subroutine slips_for_what_is_missing()
        !! Not the missing name is blamed, but what was written in its place.
        type(namelist_t) :: tree
        type(error_t), allocatable :: error
        real(dp) :: x

        call parse_namelist("&scenes"//lf//" tolernace = 1 gravity = 2 k = 3 /", "a.nml", tree, &
                            error)
        call get_real(tree, "scene", "tolerance", x, error, required=.true.)
        call failed(error, "a.nml:1:1: unknown group 'scenes'; did you mean 'scene'?")
        call get_real(tree, "scenes", "tolerance", x, error, required=.true.)
        call failed(error, "a.nml:2:2: &scenes: unknown key 'tolernace'; did you mean 'tolerance'?")
        call get_real(tree, "scenes", "m", x, error, required=.true.)
        call failed(error, "a.nml:1:1: &scenes: m is missing; write m = value")
        call refuse_unknown_keys(tree, "scenes", [character(9) :: "tolernace", "g", "k"], error, &
                                 early=.true.)
        call failed(error, "a.nml:2:16: &scenes: unknown key 'gravity'; did you mean 'g'?")
    end subroutine slips_for_what_is_missing

    subroutine keys_of_a_scene()
        !! The unknown key is blamed, not the one that is missing; coordinates are no keys.
        character(*), parameter :: rest = "duration = 1 q = 1 v = 0 "

        call no_scene("delta_t = 1e-2 "//rest, &
                      "a.nml:1:28: &scene: unknown key 'delta_t'; did you mean 'dt'?")
        call no_scene("dt = 1e-2 duration = 1 theta0 = 1 ", "a.nml:1:60: &scene: theta0 = 1: "// &
                      "the start is given by q = theta and by v, the velocities")
        call no_scene("dt = 1e-2 theta_dot = 0 "//rest, "a.nml:1:50: &scene: theta_dot = 0: "// &
                      "the start is given by q = theta and by v, the velocities")
        call no_scene("dt = 1e-2 "//rest, "--set scene%dtt=1: &scene: unknown key 'dtt'; did "// &
                      "you mean 'dt'?", "scene%dtt=1")
        call no_scene("dt = 1e-2 "//rest, "--set scene%q(2)=1: &scene: q = 1: 2 values, but 1 "// &
                      "is needed: theta", "scene%q(2)=1")
        call no_scene("dt = 1e-2 "//rest, "--set wedge%alpha=1: unknown group 'wedge'; "// &
                      "allowed: scene, pendulum, lagrangian, "// &
                      "sweep (in a.nml)", "wedge%alpha=1")
    end subroutine keys_of_a_scene

    subroutine values_of_a_scene()
        !! A list in one text, a method that is no choice, a file that is a folder, more samples
        !! than a disk holds, `modes` of another system than was named.
        character(*), parameter :: rest = "q = 1 dt = 1e-2 "
        class(system_t), allocatable :: system
        type(word_t) :: override(1)
        type(error_t), allocatable :: error

        call no_scene(rest//"duration = 1 columns = 't, theta'", "columns = 't, theta': is one "// &
                      "text; each column has its own quotes, as in 't', 'x'")
        call no_scene("method = 'exact'", "method = 'exact': is what 'auto' takes where there "// &
                      "is a closed form; write 'auto'")
        call no_scene(rest//"duration = 1 output = './.'", "without '..', not ending in .gp, "// &
                      ".html, .nml, .pdf, .png, .svg or .partial")
        call no_scene(rest//"duration = 1 output = ' x'", "without '..', not ending in .gp, "// &
                      ".html, .nml, .pdf, .png, .svg or .partial")
        call no_scene(rest//"duration = 1e10 every = 10", "every = 10: 100000000000 samples "// &
                      "are too many; make the run shorter, or every longer")
        override(1)%text = "scene%system=wedge"
        call read_named_system("pendulum", override, system, error)
        call failed(error, "--set scene%system=wedge: &scene: system = wedge: is not the "// &
                    "'pendulum' that was named")
    end subroutine values_of_a_scene
end module test_namelist_mistakes
