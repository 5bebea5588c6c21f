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
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_sweep, only: fits_lanes, sweep_t
    use lagrangia_sweep_lanes, only: compute_lanes
    use lagrangia_sweep_trajectory, only: compute_one
    use lagrangia_text, only: to_text
    use sweep_numbers, only: compute_numbers, make => make_sweep, sweep_numbers_t
    use test_splitting_lanes, only: splitting_lanes_suite
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
        call suite%addTest(splitting_lanes_suite())
        call suite%addTest(TestMethod("there_and_back", there_and_back))
        call suite%addTest(TestMethod("a_lane_is_a_single_trajectory", &
                                      a_lane_is_a_single_trajectory))
        call suite%addTest(TestMethod("without_sines_no_bit_differs", without_sines_no_bit_differs))
        call suite%addTest(TestMethod("points_are_those_of_a_single_trajectory", &
                                      points_are_those_of_a_single_trajectory))
        call suite%addTest(TestMethod("each_lane_has_its_parameters", &
                                      each_lane_has_its_parameters))
        call suite%addTest(TestMethod("some_parameters_are_refused", some_parameters_are_refused))
        call suite%addTest(TestMethod("extremes_are_those_of_a_single_trajectory", &
                                      extremes_are_those_of_a_single_trajectory))
        call suite%addTest(TestMethod("one_energy", one_energy))
        call suite%addTest(TestMethod("neighbours_change_no_byte", neighbours_change_no_byte))
        call suite%addTest(TestMethod("who_blows_up_is_alone", who_blows_up_is_alone))
        call suite%addTest(TestMethod("blow_ups_are_those_of_single_trajectories", &
                                      blow_ups_are_those_of_single_trajectories))
        call suite%addTest(TestMethod("what_is_refused_alone_is_refused_in_lanes", &
                                      what_is_refused_alone_is_refused_in_lanes))
        call suite%addTest(TestMethod("processes_change_no_byte", processes_change_no_byte))
        call suite%addTest(TestMethod("what_fits", what_fits))
    end function sweep_lanes_suite

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

    subroutine without_sines_no_bit_differs()
        !! The sums of the stages and the lengths of the steps are the same to the last bit: eleven
        !! oscillators, at the same times with the same errors, and a motion that takes ever
        !! shorter steps.
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        real(dp) :: alone(1), together(1, 11)
        integer(i8) :: failures, first, i
        integer :: k

        do k = 1, 2
            if (k == 1) then
                call make("&scene system = 'oscillator', method = 'dop853', tolerance = 1e-9, "// &
                          "duration = 20, q = 1 /", ["x=0:1.5:11"], ["x"], sweep)
            else
                call make(runaway, ["x=0.2:0.9:11"], ["x"], sweep)
            end if
            call compute_lanes(sweep, 1_i8, 11_i8, together, failures, first)
            do i = 1, 11
                call compute_one(sweep, i, alone, error)
                call assertFalse(allocated(error), "one by one")
                call assertEqual(alone(1), together(1, i), message="trajectory "//to_text(i))
            end do
        end do
    end subroutine without_sines_no_bit_differs

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

    subroutine each_lane_has_its_parameters()
        !! Of systems in formulas and of compiled ones, with starts and times of their own too.
        character(*), parameter :: keep(3) = [character(12) :: "theta1", "energy_drift", "x_bob2"]
        type(sweep_t) :: sweep
        integer :: found

        call make(double, ["m1=0.5:3:11", "l2=0.5:1:3 "], keep, sweep)
        call compare(sweep, found)
        call assertEqual(3*33, found, "masses and lengths")
        call make(double, ["theta2=-0.5:0.7:11", "g=1:10:3          "], keep, sweep)
        call compare(sweep, found)
        call assertEqual(3*33, found, "a parameter and a start")
        call make(driven//", after = 2, points = 5 /", ["drive_frequency=5:20:13"], &
                  ["wrapped theta", "theta_dot    ", "t            "], sweep)
        call compare(sweep, found)
        call assertTrue(found > 13*12, "points every period of its own: "//to_text(found))
        call make(written("method = 'rk4', dt = 0.01"), ["f=0.5:1:13", "W=0.5:1:3 "], &
                  ["theta_dot", "max theta"], sweep)
        call compare(sweep, found)
        call assertEqual(2*39, found, "steps of a length of their own")
        call make(written("method = 'dop853', tolerance = 1e-9, samples = 9"), &
                  ["f=0.5:1:13", "W=0.5:1:3 "], ["theta_dot", "max theta"], sweep)
        call compare(sweep, found)
        call assertEqual(2*39, found, "by a tolerance")
    end subroutine each_lane_has_its_parameters

    pure function written(how) result(text)
        !! A scene of a system in formulas.
        character(*), intent(in) :: how  !! the method and its steps
        character(:), allocatable :: text

        text = "&scene system = 'forced', "//how//", duration = 8, q = 0.5 / &lagrangian "// &
               "coordinates = 'theta [rad]', parameters = 'f', 'W', "// &
               "L = 'theta_dot^2/2 + cos(theta) + f theta cos(W t)', "// &
               "Q_theta = '-theta_dot/2' / &forced f = 1, W = 0.7 /"
    end function written

    subroutine some_parameters_are_refused()
        !! No mass is negative; and where the pivot stands still in free fall the angle is cyclic:
        !! alone it is left out, so that this one is computed alone, to the same bytes.
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        real(dp) :: alone(1), together(1, 11)
        integer(i8) :: failures, first, i

        call make(double, ["m1=-1:1:11"], ["theta1"], sweep)
        call compute_lanes(sweep, 1_i8, 11_i8, together, failures, first)
        call assertEqual(6, int(failures), "not above 0")
        call assertEqual(1, int(first), "the first of them")
        call assertTrue(all(ieee_is_nan(together(1, :6))), "NaN")
        call assertFalse(any(ieee_is_nan(together(1, 7:))), "the others are there")
        call make("&scene system = 'driven_pendulum', method = 'dop853', tolerance = 1e-9, "// &
                  "duration = 6, samples = 1, q = 0.3, v = 1 / &driven_pendulum g = 0, "// &
                  "drive_frequency = 9 /", ["amplitude=0:0.1:11"], ["theta"], sweep)
        call assertTrue(fits_lanes(sweep), "but for one")
        call compute_lanes(sweep, 1_i8, 11_i8, together, failures, first)
        call assertEqual(0, int(failures), "none fails")
        do i = 1, 11
            call compute_one(sweep, i, alone, error)
            call assertEqual(alone(1), together(1, i), merge(0.0_dp, rounding, i == 1), to_text(i))
        end do
    end subroutine some_parameters_are_refused

    subroutine extremes_are_those_of_a_single_trajectory()
        !! Of samples between the steps, from a time on.
        character(*), parameter :: keep(4) = [character(10) :: "max theta1", "min theta1", &
                                              "theta2", "max t"]
        type(sweep_t) :: sweep
        integer :: found

        call make(double//"&sweep after = 3.5 /", ["theta1=-0.7:0.8:11", "theta2=-0.5:1:3   "], &
                  keep, sweep)
        call compare(sweep, found)
        call assertEqual(4*33, found, "by a tolerance")
        call make("&scene system = 'double_pendulum', method = 'rk4', dt = 0.01, every = 3, "// &
                  "duration = 5, q = 0.5, 0.2 / &sweep after = 1.05 /", ["theta1=-0.7:0.8:11"], &
                  keep, sweep)
        call compare(sweep, found)
        call assertEqual(4*11, found, "by steps")
    end subroutine extremes_are_those_of_a_single_trajectory

    subroutine one_energy()
        !! A velocity that is chosen by it; the starts that cannot have it fail.
        type(sweep_t) :: sweep
        real(dp) :: together(2, 9)
        integer(i8) :: failures, first
        integer :: found

        call make(double//"&sweep energy_by = 'theta1_dot' /", ["theta2=-0.2:0.2:9"], &
                  ["theta1_dot", "energy    "], sweep)
        call compare(sweep, found)
        call assertEqual(18, found, "all have it")
        call make(double//"&sweep energy_by = 'theta1_dot' /", ["theta2=0:3:9"], &
                  ["theta1_dot", "energy    "], sweep)
        call compute_lanes(sweep, 1_i8, 9_i8, together, failures, first)
        call assertTrue(failures > 0 .and. failures < 9, "some have not: "//to_text(failures))
        call assertEqual(int(failures), count(ieee_is_nan(together(2, :))), "NaN")
        call assertEqual(0.0_dp, maxval(abs(pack(together(2, :), .not. &
            ieee_is_nan(together(2, :))) - sweep%energy)), 1e-6_dp, "the scene's own")
    end subroutine one_energy

    subroutine there_and_back()
        !! Thrown up or down with \(v\) against 1 to the other side: beyond \(\pi\) from
        !! \(v - \sqrt{v^2 - 2\pi}\) on.
        type(sweep_t) :: sweep
        real(dp) :: together(1, 9), v
        integer(i8) :: failures, first, i
        integer :: way

        do way = 1, 2
            call make("&scene system = 'thrown', method = 'dop853', tolerance = 1e-9, "// &
                      "duration = 5, samples = 1, q = 0 / &lagrangian coordinates = 'u [rad]', "// &
                      "parameters = 'a', L = 'u_dot^2/2 + a u' / &thrown a = "// &
                      merge("-1", " 1", way == 1)//" /", &
                      [merge("u_dot=2.3:2.7:9  ", "u_dot=-2.3:-2.7:9", way == 1)], ["flip u"], &
                      sweep)
            call compute_lanes(sweep, 1_i8, 9_i8, together, failures, first)
            call assertEqual(5, count(ieee_is_nan(together)), "not beyond")
            do i = 6, 9
                v = 2.25_dp + 0.05_dp*i
                call assertEqual(v - sqrt(v**2 - 2*acos(-1.0_dp)), together(1, i), 1e-9_dp)
            end do
        end do
    end subroutine there_and_back

    subroutine neighbours_change_no_byte()
        !! Each alone in a block of its own, and all together.
        call compare_neighbours(["theta1=-3:3:15      ", "theta2_dot=-20:20:3 "])
        call compare_neighbours(["m1=1:3:15      ", "theta2=-1:1:3  "])
    end subroutine neighbours_change_no_byte

    subroutine compare_neighbours(over)
        !! Of a grid of 45 trajectories.
        character(*), intent(in) :: over(:)
        type(sweep_t) :: sweep
        real(dp) :: alone(3, 1), together(3, 45)
        integer(i8) :: failures, first, i

        call make(double, over, ["flip theta2", "theta1     ", "theta2_dot "], sweep)
        call assertTrue(fits_lanes(sweep), "in lanes")
        call compute_lanes(sweep, 1_i8, 45_i8, together, failures, first)
        do i = 1, 45
            call compute_lanes(sweep, i, i, alone, failures, first)
            call assertTrue(all(transfer(alone(:, 1), [0_i8]) == &
                                transfer(together(:, i), [0_i8])), "trajectory "//to_text(i))
        end do
    end subroutine compare_neighbours

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

    subroutine blow_ups_are_those_of_single_trajectories()
        !! For each method and all that is kept, also of systems of their own: the same trajectories
        !! fail, all their numbers are NaN, and the others are what they are alone.
        character(*), parameter :: by(2) = [character(54) :: &
            "method = 'dop853', tolerance = 1e-9, samples = 10", "method = 'rk4', dt = 0.01"]
        character(*), parameter :: over(2) = [character(9) :: "x=-2:2:9", "c=-16:4:9"]
        character(*), parameter :: keep(6) = [character(9) :: "x", "max x", "min x_dot", &
                                              "wrapped x", "flip x", "energy"]
        type(sweep_t) :: sweep
        character(:), allocatable :: text
        integer :: i, k

        do i = 1, size(by)
            do k = 1, size(over)
                text = "&scene system = 'runaway', "//trim(by(i))//", duration = 2, q = 1 / "// &
                       "&lagrangian coordinates = 'x [rad]', parameters = 'c', "// &
                       "L = 'x_dot^2/2 + c x^4/4' / &runaway c = 1 /"
                call make(text, over(k:k), keep, sweep)
                call compare_failures(sweep)
                call make(text//"&sweep strobe = '1/2', points = 4 /", over(k:k), keep(4:4), sweep)
                call compare_failures(sweep)
                call make(text//"&sweep strobe = '1/8' /", over(k:k), ["attractor"], sweep)
                call compare_failures(sweep)
            end do
        end do
    end subroutine blow_ups_are_those_of_single_trajectories

    subroutine compare_failures(sweep)
        !! Nine trajectories of which some fail, in lanes and alone.
        type(sweep_t), intent(in) :: sweep
        type(error_t), allocatable :: error
        real(dp) :: alone(sweep%width()), together(sweep%width(), 9)
        integer(i8) :: failures, first, i
        integer :: failed, k

        call assertTrue(fits_lanes(sweep), "in lanes")
        call compute_lanes(sweep, 1_i8, 9_i8, together, failures, first)
        failed = 0
        do i = 1, 9
            call compute_one(sweep, i, alone, error)
            if (allocated(error)) then
                failed = failed + 1
                if (failed == 1) call assertEqual(int(i), int(first), "the first that fails")
                call assertTrue(all(ieee_is_nan(together(:, i))), "NaN: "//to_text(i))
                cycle
            end if
            do k = 1, size(alone)
                call assertTrue(ieee_is_nan(alone(k)) .eqv. ieee_is_nan(together(k, i)), &
                                "there in both: "//to_text(k)//" of "//to_text(i))
                if (ieee_is_nan(alone(k))) cycle
                call assertEqual(alone(k), together(k, i), rounding*max(1.0_dp, abs(alone(k))), &
                                 "number "//to_text(k)//" of trajectory "//to_text(i))
            end do
        end do
        call assertTrue(failed > 0 .and. failed < 9, "some fail: "//to_text(failed))
        call assertEqual(failed, int(failures), "failures")
    end subroutine compare_failures

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

        call make("&scene system = 'double_pendulum', method = 'rk4', dt = 0.1, duration = 1, "// &
                  "q = 0.5, 0.2 /", ["m1=1:3:11"], ["theta1"], sweep)
        call assertFalse(fits_lanes(sweep), "steps of compiled systems are quicker alone")
        call make(double, ["theta1=1:3:11"], ["first theta1 = 0"], sweep)
        call assertFalse(fits_lanes(sweep), "not if all of a motion counts")
        call make("&scene system = 'hanging_chain', method = 'dop853', tolerance = 1e-9, "// &
                  "duration = 1, samples = 1, q = 3*0.1 /", ["g=9:10:3"], ["theta1"], sweep)
        call assertFalse(fits_lanes(sweep), "nor if they have three coordinates")
        call make("&scene system = 'cart_pendulum', method = 'dop853', tolerance = 1e-9, "// &
                  "duration = 1, samples = 1, q = 0, 1 /", ["theta=1:2:2"], ["theta"], sweep)
        call assertFalse(fits_lanes(sweep), "alone it leaves the cyclic coordinate out")
        call make(auto, ["theta1=1:3:11"], ["theta1"], sweep)
        call assertEqual("dop853", trim(sweep%scene%method), "auto takes lanes")
        call make(auto, ["theta1=1:3:11"], ["period"], sweep)
        call assertEqual("gauss16", trim(sweep%scene%method), "auto, where there are none")
    end subroutine what_fits
end module test_sweep_lanes
