module test_sweep_lanes
    !! Trajectories by tolerance in lanes: each is what it is alone, whatever its neighbours are.
    !!
    !! Two ways of computing one trajectory differ by rounding. It changes the error estimate of a
    !! step, a tolerance \(\tau\) at most, by \(\epsilon/\tau\) of itself, so the step by
    !! as much, and the local errors, which are below \(\tau\), by \(\epsilon\): sums of a
    !! thousand roundings of numbers below 10, which ten periods of motion that is not chaotic
    !! let grow a hundredfold, \(10^6\epsilon < 3\cdot10^{-10}\).
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_sweep, only: fits_lanes, new_sweep, sweep_t
    use lagrangia_sweep_lanes, only: compute_lanes
    use lagrangia_sweep_trajectory, only: compute_one
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use sweep_numbers, only: compute_numbers, sweep_numbers_t
    implicit none (type, external)
    private
    public :: sweep_lanes_suite

    real(dp), parameter :: rounding = 1e6_dp*epsilon(1.0_dp)
    character(*), parameter :: double = "&scene system = 'double_pendulum', method = 'dop853', "// &
        "tolerance = 1e-9, duration = 10, samples = 10, q = 0.5, 0.2, v = 0.1, 0 / "// &
        "&double_pendulum m2 = 0.7 /"
    character(*), parameter :: driven = "&scene system = 'driven_pendulum', method = 'dop853', "// &
        "tolerance = 1e-9, duration = 6, samples = 10, q = 0.3 / &driven_pendulum "// &
        "amplitude = 0.1, drive_frequency = 9, b = 0.5 / &sweep strobe = '2 pi/drive_frequency'"
    character(*), parameter :: runaway = "&scene system = 'runaway', method = 'dop853', "// &
        "tolerance = 1e-9, duration = 2, samples = 10, q = 0.3 / &lagrangian "// &
        "coordinates = 'x', L = 'x_dot^2/2 + x^4/4' /"

contains

    function sweep_lanes_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("sweep_lanes")
        call suite%addTest(TestMethod("a_lane_is_a_single_trajectory", &
                                      a_lane_is_a_single_trajectory))
        call suite%addTest(TestMethod("points_are_those_of_a_single_trajectory", &
                                      points_are_those_of_a_single_trajectory))
        call suite%addTest(TestMethod("neighbours_change_no_byte", neighbours_change_no_byte))
        call suite%addTest(TestMethod("who_blows_up_is_alone", who_blows_up_is_alone))
        call suite%addTest(TestMethod("what_is_refused_alone_is_refused_in_lanes", &
                                      what_is_refused_alone_is_refused_in_lanes))
        call suite%addTest(TestMethod("processes_change_no_byte", processes_change_no_byte))
        call suite%addTest(TestMethod("what_fits", what_fits))
    end function sweep_lanes_suite

    subroutine make(text, over, keep, sweep)
        !! The sweep of a scene in `text`.
        character(*), intent(in) :: text, over(:), keep(:)
        type(sweep_t), intent(out) :: sweep
        type(error_t), allocatable :: error
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(word_t) :: none(0)

        call parse_scene(text, "text", none, scene, system, error)
        if (allocated(error)) call assertEqual("", error%message, "the scene")
        if (allocated(error)) return
        call new_sweep(sweep, scene, system, over, keep, 1, scene%sweep%after, error)
        call assertFalse(allocated(error), "the sweep")
    end subroutine make

    subroutine compare(sweep, found)
        !! All trajectories in lanes and alone, a number within `rounding` of its size; `found` of
        !! the numbers are there.
        type(sweep_t), intent(in) :: sweep
        integer, intent(out) :: found
        type(error_t), allocatable :: error
        real(dp) :: alone(sweep%width()), together(sweep%width(), sweep%trajectories())
        integer(i8) :: failures, first, i
        integer :: k

        call assertTrue(fits_lanes(sweep), "it can be computed in lanes")
        call compute_lanes(sweep, 1_i8, sweep%trajectories(), together, failures, first)
        call assertEqual(0, int(failures), "none fails")
        found = 0
        do i = 1, sweep%trajectories()
            call compute_one(sweep, i, alone, error)
            call assertFalse(allocated(error), "one by one")
            do k = 1, size(alone)
                call assertTrue(ieee_is_nan(alone(k)) .eqv. ieee_is_nan(together(k, i)), &
                                "there in both: "//to_text(k)//" of "//to_text(i))
                if (ieee_is_nan(alone(k))) cycle
                found = found + 1
                call assertEqual(alone(k), together(k, i), rounding*max(1.0_dp, abs(alone(k))), &
                                 "number "//to_text(k)//" of trajectory "//to_text(i))
            end do
        end do
    end subroutine compare

    subroutine a_lane_is_a_single_trajectory()
        !! The end, and the time of the first flip, for a number of trajectories that fills no
        !! block. Of the flips those that come soon: the others are chaotic.
        type(sweep_t) :: sweep
        integer :: found

        call make(double, ["theta1=-0.7:0.8:11", "theta2=-0.5:1:3   "], &
                  ["theta1        ", "energy_drift  ", "x_bob2        ", "wrapped theta2"], sweep)
        call compare(sweep, found)
        call assertEqual(4*33, found, "all numbers")
        call make(double, ["theta1_dot=-9:9:17", "theta2=-3:3:2     "], ["flip theta2"], sweep)
        sweep%scene%duration = 1.0_dp
        call compare(sweep, found)
        call assertTrue(found > 5 .and. found < 34, "some go over the top: "//to_text(found))
        call make(double, ["theta1_dot=-9:9:17", "theta2=-3:3:2     "], &
                  ["flip theta2", "flip theta1"], sweep)
        sweep%scene%duration = 1.0_dp
        call compare(sweep, found)
        call assertTrue(found > 10 .and. found < 68, "both angles: "//to_text(found))
    end subroutine a_lane_is_a_single_trajectory

    subroutine points_are_those_of_a_single_trajectory()
        !! Between the ends of steps, from a time on, no more than are wanted; and attractors.
        type(sweep_t) :: sweep
        integer :: found

        call make(driven//", after = 2, points = 5 /", ["theta=-2:2:13"], &
                  ["theta    ", "theta_dot"], sweep)
        call compare(sweep, found)
        call assertEqual(13*10, found, "all points")
        call make(driven//" /", ["theta=-2:2:13"], ["attractor"], sweep)
        call compare(sweep, found)
        call assertTrue(found >= 13, "what tells the attractors")
    end subroutine points_are_those_of_a_single_trajectory

    subroutine neighbours_change_no_byte()
        !! Each alone in a block of its own, and all together.
        type(sweep_t) :: sweep
        real(dp) :: alone(3, 1), together(3, 45)
        integer(i8) :: failures, first, i

        call make(double, ["theta1=-3:3:15      ", "theta2_dot=-20:20:3 "], &
                  ["flip theta2", "theta1     ", "theta2_dot "], sweep)
        call compute_lanes(sweep, 1_i8, 45_i8, together, failures, first)
        do i = 1, 45
            call compute_lanes(sweep, i, i, alone, failures, first)
            call assertTrue(all(transfer(alone(:, 1), [0_i8]) == &
                                transfer(together(:, i), [0_i8])), "trajectory "//to_text(i))
        end do
    end subroutine neighbours_change_no_byte

    subroutine who_blows_up_is_alone()
        !! \(\ddot x = x^3\) from rest at \(x_0\) is at infinity after \(1.85/x_0\): of nine
        !! starts up to 2 the outer three on both sides within 2 s.
        type(sweep_t) :: sweep
        real(dp) :: alone(1, 1), together(1, 9)
        integer(i8) :: failures, first, i

        call make(runaway, ["x=-2:2:9"], ["x"], sweep)
        call assertTrue(fits_lanes(sweep), "in lanes")
        call compute_lanes(sweep, 1_i8, 9_i8, together, failures, first)
        call assertEqual(6, int(failures), "failures")
        call assertEqual(1, int(first), "the first of them")
        do i = 1, 9
            call assertTrue(ieee_is_nan(together(1, i)) .eqv. abs(i - 5) > 1, "NaN: "//to_text(i))
            call compute_lanes(sweep, i, i, alone, failures, first)
            if (abs(i - 5) > 1) cycle
            call assertEqual(alone(1, 1), together(1, i), 0.0_dp, "trajectory "//to_text(i))
        end do
    end subroutine who_blows_up_is_alone

    subroutine what_is_refused_alone_is_refused_in_lanes()
        !! Angles so large that rounding is more than the tolerance, and infinite ones.
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        real(dp) :: alone(1), together(1, 4)
        integer(i8) :: failures, first, i
        integer :: refused

        call make(double, ["theta1=1:1e9:4:log"], ["theta1"], sweep)
        call compute_lanes(sweep, 1_i8, 4_i8, together, failures, first)
        refused = 0
        do i = 1, 4
            call compute_one(sweep, i, alone, error)
            call assertTrue(ieee_is_nan(together(1, i)) .eqv. allocated(error), to_text(i))
            if (allocated(error)) refused = refused + 1
        end do
        call assertTrue(refused > 0 .and. refused < 4, "refused: "//to_text(refused))
        call assertEqual(refused, int(failures), "failures")
    end subroutine what_is_refused_alone_is_refused_in_lanes

    subroutine processes_change_no_byte()
        !! More blocks than processes.
        type(sweep_numbers_t) :: one, more
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        integer :: threads

        call make(double, ["theta1=0:1:300"], ["theta2"], sweep)
        call compute_numbers(sweep, 1, one, error)
        call assertFalse(allocated(error), "by one process")
        call assertTrue(one%in_lanes, "in lanes")
        do threads = 2, 3
            call compute_numbers(sweep, threads, more, error)
            call assertFalse(allocated(error), "by processes: "//to_text(threads))
            call assertEqual(one%values(1, :), more%values(1, :), 0.0_dp, to_text(threads))
        end do
    end subroutine processes_change_no_byte

    subroutine what_fits()
        !! And which method `auto` takes.
        character(*), parameter :: auto = "&scene system = 'double_pendulum', "// &
            "method = 'auto', tolerance = 1e-9, duration = 1, samples = 1, q = 0.5, 0.2 /"
        type(sweep_t) :: sweep

        call make(double, ["m1=1:3:11"], ["theta1"], sweep)
        call assertFalse(fits_lanes(sweep), "not with different systems")
        call make(double, ["theta1=1:3:11"], ["max theta1"], sweep)
        call assertFalse(fits_lanes(sweep), "not if all samples count")
        call make("&scene system = 'cart_pendulum', method = 'dop853', tolerance = 1e-9, "// &
                  "duration = 1, samples = 1, q = 0, 1 /", ["theta=1:2:2"], ["theta"], sweep)
        call assertFalse(fits_lanes(sweep), "alone it leaves the cyclic coordinate out")
        call make(auto, ["theta1=1:3:11"], ["theta1"], sweep)
        call assertEqual("dop853", trim(sweep%scene%method), "auto takes lanes")
        call make(auto, ["theta1=1:3:11"], ["max theta1"], sweep)
        call assertEqual("gauss16", trim(sweep%scene%method), "auto, where there are none")
    end subroutine what_fits
end module test_sweep_lanes
