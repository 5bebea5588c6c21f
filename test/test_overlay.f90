module test_overlay
    !! Several runs in one picture: what the runs of a comparison are, and what is drawn of them.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_gnuplot, only: new_series, panel_t, series_t
    use lagrangia_kinds, only: dp
    use lagrangia_overlay, only: common_panels, compare_methods, compare_starts, overrides_for, &
                                 run_name
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: system_t
    use lagrangia_value_range, only: range_of
    use scene_runs, only: read_and_plan
    implicit none (type, external)
    private
    public :: overlay_suite

    character(*), parameter :: fixed = "&scene system='pendulum' q=1 dt=0.01 duration=2 "// &
        "every=4 output='a.b/c.csv' expect_error=1e-9 columns='t','theta','error' plot='error' /"
    character(*), parameter :: adaptive = "&scene system='double_pendulum' q=1,1 "// &
        "tolerance=1e-9 samples=50 duration=2 method='dop853' "// &
        "expect_error=1e-6 expect_energy_drift=1e-6 /"
    character(*), parameter :: driven = "&scene system='driven_pendulum' q=3 dt=0.001 "// &
        "duration=1 / &driven_pendulum amplitude=0.1 drive_frequency=100 /"

contains

    function overlay_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("overlay")
        call suite%addTest(TestMethod("files_are_named_after_runs", files_are_named_after_runs))
        call suite%addTest(TestMethod("methods_are_compared_alike", methods_are_compared_alike))
        call suite%addTest(TestMethod("what_is_set_is_for_whom_it_fits", &
                                      what_is_set_is_for_whom_it_fits))
        call suite%addTest(TestMethod("starts_are_compared_alike", starts_are_compared_alike))
        call suite%addTest(TestMethod("common_columns_have_panels", common_columns_have_panels))
    end function overlay_suite

    subroutine files_are_named_after_runs()
        !! The ending goes, a point in a folder's name stays.
        call assertEqual("pendulum_rk4", run_name("pendulum", "rk4"))
        call assertEqual("a.b/c_rk4", run_name("a.b/c.csv", "rk4"))
        call assertEqual("a.b/c_rk4", run_name("a.b/c", "rk4"))
        call assertEqual("c_dt_0.2_rk4", run_name("c_dt_0.2", "rk4"))
    end subroutine files_are_named_after_runs

    subroutine compared(text, method, scene, error)
        !! The scene in `text` by that method.
        character(*), intent(in) :: text, method
        type(scene_t), intent(out) :: scene
        type(error_t), allocatable, intent(out) :: error
        class(system_t), allocatable :: system

        call read_and_plan(text, "s.nml", [word_t ::], scene, system, error)
        call assertFalse(allocated(error), "a good scene")
        if (.not. allocated(error)) call compare_methods(scene, system, method, error)
    end subroutine compared

    subroutine methods_are_compared_alike()
        !! Motion, a drift, the error where it can be known, unjudged; a step where a tolerance
        !! would be refused, and a tolerance where a step would.
        type(scene_t) :: scene
        type(error_t), allocatable :: error

        call compared(fixed, "verlet", scene, error)
        call assertFalse(allocated(error), "verlet")
        call assertEqual("verlet", trim(scene%method))
        call assertEqual("a.b/c_verlet", trim(scene%output))
        call assertEqual("t theta energy_drift error", joined(scene))
        call assertEqual(0.01_dp, scene%dt)
        call assertEqual(0, size(scene%plots))
        call assertFalse(any(scene%expectations%judged), "nothing is judged")
        call compared(fixed, "dop853", scene, error)
        call assertEqual(1e-10_dp, scene%tolerance)
        call assertEqual(50, int(scene%samples), message="every fourth of 200 steps")
        call compared(adaptive, "rk4", scene, error)
        call assertEqual(0.0_dp, scene%tolerance)
        call assertEqual(0.01_dp, scene%dt, tolerance=epsilon(1.0_dp))
        call assertEqual(4, int(scene%every), "a sample each 0.04 s")
        call assertEqual("t theta1 theta2 energy_drift error", joined(scene))
        call assertEqual(1, size(scene%expectations), "the error, beside a finer run")
        call compared(adaptive, "gauss16", scene, error)
        call assertEqual(1e-9_dp, scene%tolerance)
        call compared(driven, "rk4", scene, error)
        call assertEqual("t theta energy_balance_drift", joined(scene))
        call compared(fixed, "rk5", scene, error)
        call assertTrue(allocated(error), "no such method")
        if (allocated(error)) call assertEqual(1, index(error%message, "unknown method 'rk5'"), &
                                               error%message)
    end subroutine methods_are_compared_alike

    subroutine what_is_set_is_for_whom_it_fits()
        !! Steps for rk4, a tolerance for dop853, and of both the tolerance for gauss16, each with
        !! its own method; the rest for all, and for none what no method of them takes.
        call set("rk4", "rk4 dop853", "scene%dt=0.1", "scene%dt=0.1 scene%method=rk4")
        call set("rk4", "rk4 dop853", "scene%every=2", "scene%every=2 scene%method=rk4")
        call set("rk4", "rk4 dop853", "scene%tolerance=1e-9", "")
        call set("rk4", "rk4 verlet", "scene%tolerance=1e-9", "scene%tolerance=1e-9")
        call set("rk4", "rk4 dop853", "scene%tolerance=1e-9 scene%dt=0.1 scene%q=1", &
                 "scene%dt=0.1 scene%q=1 scene%method=rk4")
        call set("dop853", "rk4 dop853", "scene%dt=0.1", "")
        call set("dop853", "dop853", "scene%dt=0.1", "scene%dt=0.1")
        call set("dop853", "rk4 dop853", "scene%dt=0.1 scene%tolerance=1e-9", &
                 "scene%tolerance=1e-9 scene%method=dop853")
        call set("gauss16", "gauss16", "scene%dt=0.1 scene%tolerance=1e-9", &
                 "scene%tolerance=1e-9 scene%method=gauss16")
        call set("gauss16", "gauss16", "scene%dt=0.1", "scene%dt=0.1 scene%method=gauss16")
        call set("rk4", "rk4", "scene%method=verlet Scene%DT=0.1", "Scene%DT=0.1 scene%method=rk4")
        call set("rk4", "rk4", "scene%method=verlet scene%q=1", "scene%method=verlet scene%q=1")
    contains
        subroutine set(method, methods, given, expected)
            character(*), intent(in) :: method, methods, given, expected  !! words
            type(word_t), allocatable :: overrides(:), settings(:), names(:)
            character(:), allocatable :: text
            integer :: i

            call split(given, settings)
            call split(methods, names)
            call overrides_for(settings, names, method, overrides)
            text = ""
            do i = 1, size(overrides)
                text = text//" "//overrides(i)%text
            end do
            call assertEqual(expected, text(min(2, len(text) + 1):), method//": "//given)
        end subroutine set

        pure subroutine split(text, words)
            !! gfortran 12 frees no list of words that is a function's.
            character(*), intent(in) :: text
            type(word_t), allocatable, intent(out) :: words(:)
            integer :: first, i, last

            allocate (words(count([(text(i:i) == " ", i=1, len(text))]) + 1))
            first = 1
            do i = 1, size(words)
                last = first + index(text(first:)//" ", " ") - 2
                words(i)%text = text(first:last)
                first = last + 2
            end do
        end subroutine split
    end subroutine what_is_set_is_for_whom_it_fits

    subroutine starts_are_compared_alike()
        !! Coordinates and their velocities, for phase portraits.
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        call read_and_plan(adaptive, "s.nml", [word_t ::], scene, system, error)
        call compare_starts(scene, system, "0.1,0.2:3,4", "start_2")
        call assertEqual("t theta1 theta1_dot theta2 theta2_dot", joined(scene))
        call assertEqual("s_start_2", trim(scene%output))
        call assertEqual("double_pendulum from q = 0.1,0.2, v = 3,4", trim(scene%title))
        call assertEqual(0, size(scene%expectations))
    end subroutine starts_are_compared_alike

    pure function joined(scene) result(text)
        !! The scene's columns.
        type(scene_t), intent(in) :: scene
        character(:), allocatable :: text
        integer :: i

        text = trim(scene%columns(1))
        do i = 2, size(scene%columns)
            text = text//" "//trim(scene%columns(i))
        end do
    end function joined

    subroutine common_columns_have_panels()
        !! Those that another file has in the same unit, drifts and errors last; velocities over
        !! their coordinates; nothing in common is refused.
        type(series_t), allocatable :: series(:)
        type(panel_t), allocatable :: panels(:)
        type(error_t), allocatable :: error
        character(:), allocatable :: left_out
        integer :: i

        allocate (series(2))
        call make(series(1), [character(12) :: "t", "error", "x", "x_dot", "theta", "r"], &
                  [character(4) :: "s", "1", "m", "m/s", "rad", "m"])
        call make(series(2), [character(12) :: "t", "theta", "x", "error", "r", "x_dot"], &
                  [character(4) :: "s", "rad", "m", "1", "rad", "m/s"])
        call common_panels(series, panels, "time", left_out, error)
        call assertFalse(allocated(error), "four in common")
        call assertEqual([1, 1, 1, 1], [(panels(i)%x, i=1, size(panels))])
        call assertEqual([3, 4, 5, 2], [(panels(i)%y(1), i=1, size(panels))])
        call common_panels(series, panels, "starts", left_out, error)
        call assertEqual(1, size(panels))
        call assertEqual(3, panels(1)%x)
        call assertEqual(4, panels(1)%y(1))
        call assertEqual("", left_out)
        do i = 1, 2
            call make(series(i), [character(12) :: "t", "a", "b", "c", "d", "e", "f", "g", "h"], &
                      [character(4) :: "s", "m", "m", "m", "m", "m", "m", "m", "m"])
        end do
        call common_panels(series, panels, "time", left_out, error)
        call assertEqual("g, h", left_out)
        call make(series(2), [character(12) :: "t", "r"], [character(4) :: "s", "rad"])
        call common_panels(series, panels, "time", left_out, error)
        call assertTrue(allocated(error), "nothing in common")
        if (allocated(error)) call assertEqual("these runs have no column in common but the time", &
                                               error%message)
    end subroutine common_columns_have_panels

    subroutine make(series, names, units)
        !! A file with these columns.
        type(series_t), intent(out) :: series
        character(*), intent(in) :: names(:), units(:)

        call new_series(series, "f", "", names, units, &
                        spread(range_of([0.0_dp, 1.0_dp]), 1, size(names)))
    end subroutine make
end module test_overlay
