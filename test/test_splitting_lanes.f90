module test_splitting_lanes
    !! Verlet steps and their compositions in lanes: each trajectory is what it is alone, to the
    !! last bit where there is no sine, whatever its neighbours are.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_sweep, only: fits_lanes, sweep_t
    use lagrangia_sweep_lanes, only: compute_lanes
    use lagrangia_sweep_trajectory, only: compute_one
    use lagrangia_text, only: to_text
    use sweep_numbers, only: compute_numbers, make => make_sweep, sweep_numbers_t
    implicit none (type, external)
    private
    public :: splitting_lanes_suite

    character(*), parameter :: methods(9) = [character(15) :: "verlet", "velocity_verlet", &
        "yoshida4", "suzuki4", "yoshida6", "kahan_li6", "yoshida8", "kahan_li8", "blanes_moan6"]

contains

    function splitting_lanes_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("splitting_lanes")
        call suite%addTest(TestMethod("without_sines_no_bit_differs", without_sines_no_bit_differs))
        call suite%addTest(TestMethod("an_angle_is_that_of_a_single_trajectory", &
                                      an_angle_is_that_of_a_single_trajectory))
        call suite%addTest(TestMethod("each_lane_ends_by_its_own_steps", &
                                      each_lane_ends_by_its_own_steps))
        call suite%addTest(TestMethod("who_blows_up_is_alone", who_blows_up_is_alone))
        call suite%addTest(TestMethod("friction_is_refused_as_alone", friction_is_refused_as_alone))
        call suite%addTest(TestMethod("processes_change_no_byte", processes_change_no_byte))
    end function splitting_lanes_suite

    pure function spring(method, duration) result(text)
        !! A scene of two coordinates on a spring that hardens, pushed ever more.
        character(*), intent(in) :: method  !! and its steps
        character(*), intent(in) :: duration
        character(:), allocatable :: text

        text = "&scene system = 'springs', method = '"//trim(method)//"', dt = 0.07, every = 4,"// &
               " duration = "//duration//", q = 1, 0.5 / &lagrangian coordinates = 'x', 'y', "// &
               "parameters = 'k', L = '(x_dot^2 + y_dot^2)/2 - k (x^2 + y^2)/2 - x^2 y^2/4 "// &
               "+ x t/10' / &springs k = 1 /"
    end function spring

    subroutine compare(sweep, rounding, found)
        !! All trajectories in lanes, alone in lanes, and by a single trajectory.
        type(sweep_t), intent(in) :: sweep
        real(dp), intent(in) :: rounding  !! by which a single one may differ
        integer, intent(out) :: found     !! numbers that are there
        type(error_t), allocatable :: error
        real(dp) :: alone(sweep%width()), together(sweep%width(), sweep%trajectories())
        real(dp) :: in_a_lane(sweep%width(), 1)
        integer(i8) :: failures, first, i
        integer :: k

        call assertTrue(fits_lanes(sweep), trim(sweep%scene%method)//": it can be in lanes")
        call compute_lanes(sweep, 1_i8, sweep%trajectories(), together, failures, first)
        call assertEqual(0, int(failures), "none fails")
        found = 0
        do i = 1, sweep%trajectories()
            call compute_one(sweep, i, alone, error)
            call assertFalse(allocated(error), "one by one")
            call compute_lanes(sweep, i, i, in_a_lane, failures, first)
            call assertTrue(all(transfer(in_a_lane(:, 1), [0_i8]) == &
                                transfer(together(:, i), [0_i8])), "neighbours of "//to_text(i))
            do k = 1, size(alone)
                call assertTrue(ieee_is_nan(alone(k)) .eqv. ieee_is_nan(together(k, i)), &
                                "there in both: "//to_text(k)//" of "//to_text(i))
                if (ieee_is_nan(alone(k))) cycle
                found = found + 1
                call assertEqual(alone(k), together(k, i), rounding*max(1.0_dp, abs(alone(k))), &
                                 trim(sweep%scene%method)//": number "//to_text(k)//" of "// &
                                 to_text(i))
            end do
        end do
    end subroutine compare

    subroutine without_sines_no_bit_differs()
        !! Of each method, with a last step that is shorter and without, with extremes and points.
        type(sweep_t) :: sweep
        integer :: found, i

        do i = 1, size(methods)
            call make(spring(methods(i), "7"), ["x=0.1:1.5:11"], &
                      [character(5) :: "x", "y", "y_dot", "max x"], sweep)
            call compare(sweep, 0.0_dp, found)
            call assertEqual(44, found, "all numbers")
            call make(spring(methods(i), "4.51"), ["y_dot=-1:1:5", "k=1:2:3     "], &
                      [character(5) :: "x", "y_dot", "max x"], sweep)
            call compare(sweep, 0.0_dp, found)
            call assertEqual(45, found, "a shorter last step, a parameter")
        end do
    end subroutine without_sines_no_bit_differs

    subroutine an_angle_is_that_of_a_single_trajectory()
        !! The sines are the same to the last bit, but scalar ones of a time are not ours. Some of
        !! these go over the top.
        type(sweep_t) :: sweep
        integer :: found, i

        do i = 1, size(methods)
            call make("&scene system = 'pendulum', method = '"//trim(methods(i))//"', dt=0.01,"// &
                      " duration = 3, q = 1 /", ["theta_dot=4:8:11"], &
                      [character(12) :: "theta", "energy_drift", "flip theta"], sweep)
            call compare(sweep, 1e-11_dp, found)
            call assertTrue(found > 22 .and. found < 33, "some go over: "//to_text(found))
        end do
    end subroutine an_angle_is_that_of_a_single_trajectory

    subroutine each_lane_ends_by_its_own_steps()
        !! Points every period of a drive that is an axis: each lane has steps of its own length.
        type(sweep_t) :: sweep
        integer :: found, i

        do i = 1, 2
            call make("&scene system = 'shaken', method = '"//trim(methods(i))//"', dt = 0.01, "// &
                      "duration = 6, q = 0.3 / &lagrangian coordinates = 'x', parameters = 'W',"// &
                      " L = 'x_dot^2/2 - x^2/2 - x^4/4 + x cos(W t)' / &shaken W = 2 / "// &
                      "&sweep strobe = '2 pi/W', points = 9 /", ["W=2:9:13"], &
                      [character(5) :: "x", "x_dot", "t"], sweep)
            call compare(sweep, 1e-11_dp, found)
            call assertTrue(found > 13*3, "points: "//to_text(found))
        end do
    end subroutine each_lane_ends_by_its_own_steps

    subroutine who_blows_up_is_alone()
        !! \(\ddot x = x^3\) from rest at \(x_0\) is at infinity after \(1.85/x_0\).
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        real(dp) :: alone(1), together(1, 9)
        integer(i8) :: failures, first, i
        integer :: k

        do k = 1, size(methods)
            call make("&scene system = 'runaway', method = '"//trim(methods(k))//"', dt = 0.01,"// &
                      " duration = 2.5, q = 0.3 / &lagrangian coordinates = 'x', "// &
                      "L = 'x_dot^2/2 + x^4/4' /", ["x=-2:2:9"], ["x"], sweep)
            call assertTrue(fits_lanes(sweep), "in lanes")
            call compute_lanes(sweep, 1_i8, 9_i8, together, failures, first)
            call assertTrue(failures >= 4 .and. failures < 8, "some fail: "//to_text(failures))
            call assertEqual(int(failures), count(ieee_is_nan(together)), "all of these are NaN")
            do i = 1, 9
                call compute_one(sweep, i, alone, error)
                call assertTrue(allocated(error) .eqv. ieee_is_nan(together(1, i)), &
                                trim(methods(k))//" fails alone: "//to_text(i))
                if (.not. allocated(error)) call assertEqual(alone(1), together(1, i), 0.0_dp)
            end do
        end do
    end subroutine who_blows_up_is_alone

    subroutine friction_is_refused_as_alone()
        !! Where a parameter makes forces depend on velocities, that trajectory fails.
        character(*), parameter :: free = "&scene system = 'slowed', method = 'verlet', "// &
            "dt = 0.01, duration = 2, q = 0.3 / &lagrangian coordinates = 'x', "// &
            "parameters = 'c', L = 'x_dot^2/2 - x^2/2', Q_x = '-c x_dot' / &slowed c = "
        type(sweep_t) :: sweep
        real(dp) :: together(1, 9)
        integer(i8) :: failures, first

        call make(free//"0 /", ["c=0:1:9"], ["x"], sweep)
        call assertTrue(fits_lanes(sweep), "the scene's own has none")
        call compute_lanes(sweep, 1_i8, 9_i8, together, failures, first)
        call assertEqual(8, int(failures), "with friction")
        call assertEqual(2, int(first), "the first of them")
        call assertFalse(ieee_is_nan(together(1, 1)), "without")
        call make(free//"1 /", ["x=1:2:9"], ["x"], sweep)
        call assertFalse(fits_lanes(sweep), "friction in the scene")
        call make("&scene system = 'pendulum', method = 'verlet', dt = 0.01, duration = 1, "// &
                  "compensated = .true., q = 1 /", ["theta=1:2:9"], ["theta"], sweep)
        call assertFalse(fits_lanes(sweep), "compensated sums are not in lanes")
    end subroutine friction_is_refused_as_alone

    subroutine processes_change_no_byte()
        !! One, two, three.
        type(sweep_t) :: sweep
        type(sweep_numbers_t) :: one, more
        type(error_t), allocatable :: error
        integer :: threads

        call make("&scene system = 'pendulum', method = 'yoshida6', dt = 0.05, duration = 9, "// &
                  "q = 1 /", ["theta=0:3:300"], ["theta"], sweep)
        call compute_numbers(sweep, 1, one, error)
        call assertFalse(allocated(error), "by one process")
        call assertTrue(one%in_lanes, "in lanes")
        do threads = 2, 3
            call compute_numbers(sweep, threads, more, error)
            call assertFalse(allocated(error), "by processes: "//to_text(threads))
            call assertEqual(one%values(1, :), more%values(1, :), 0.0_dp, to_text(threads))
        end do
    end subroutine processes_change_no_byte
end module test_splitting_lanes
