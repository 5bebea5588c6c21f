module test_sweep
    !! Many trajectories of one scene: what is kept, lanes, processes, failures, files.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t, status_numbers
    use lagrangia_files, only: read_whole_file
    use lagrangia_kinds, only: dp, i8
    use lagrangia_sweep, only: fits_lanes, sweep_t
    use lagrangia_sweep_files, only: write_sweep
    use lagrangia_sweep_lanes, only: compute_lanes
    use lagrangia_sweep_trajectory, only: compute_one
    use lagrangia_text, only: to_text
    use sweep_numbers, only: compute_numbers, make => make_sweep, sweep_numbers_t
    use test_scratch, only: new_folder
    use test_sweep_axis, only: sweep_axis_suite
    implicit none (type, external)
    private
    public :: sweep_suite

    character(*), parameter :: line = new_line("a")
    character(*), parameter :: pendulum = "&scene system = 'pendulum', method = 'gauss16', "// &
        "tolerance = 1e-12, duration = 30, samples = 10, q = 1 / &pendulum l = 1 /"
    character(*), parameter :: double = "&scene system = 'double_pendulum', method = 'rk4', "// &
        "dt = 0.01, duration = 3.005, q = 0.5, 0.2, v = 0.1, 0 / &double_pendulum m2 = 0.7 /"

contains

    function sweep_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("sweep")
        call suite%addTest(sweep_axis_suite())
        call suite%addTest(TestMethod("bad_sweeps_are_refused", bad_sweeps_are_refused))
        call suite%addTest(TestMethod("periods_are_those_of_closed_form", &
                                      periods_are_those_of_closed_form))
        call suite%addTest(TestMethod("resonance_is_that_of_the_closed_form", &
                                      resonance_is_that_of_the_closed_form))
        call suite%addTest(TestMethod("lanes_are_single_trajectories", &
                                      lanes_are_single_trajectories))
        call suite%addTest(TestMethod("processes_change_no_byte", processes_change_no_byte))
        call suite%addTest(TestMethod("a_failure_is_nan_and_counted", &
                                      a_failure_is_nan_and_counted))
        call suite%addTest(TestMethod("least_and_largest_after_a_time", &
                                      least_and_largest_after_a_time))
        call suite%addTest(TestMethod("a_grid_is_written_line_by_line", &
                                      a_grid_is_written_line_by_line))
        call suite%addTest(TestMethod("lyapunov_exponents_that_are_known", &
                                      lyapunov_exponents_that_are_known))
        call suite%addTest(TestMethod("lyapunov_exponent_of_ueda", lyapunov_exponent_of_ueda))
        call suite%addTest(TestMethod("nothing_or_too_much_to_keep", nothing_or_too_much_to_keep))
    end function sweep_suite

    subroutine compute(text, over, keep, threads, result, error, sweep)
        !! What a sweep gives.
        character(*), intent(in) :: text, over(:), keep(:)
        integer, intent(in) :: threads
        type(sweep_numbers_t), intent(out) :: result
        type(error_t), allocatable, intent(out) :: error
        type(sweep_t), intent(out) :: sweep

        call make(text, over, keep, sweep, error)
        if (allocated(error)) return
        call compute_numbers(sweep, threads, result, error)
    end subroutine compute

    subroutine bad_sweeps_are_refused()
        !! What is kept, too, with the key to blame.
        character(*), parameter :: bad(3, 13) = reshape([character(40) :: &
            "q=0:1:3", "thta", "did you mean 'theta'?", &
            "q=0:1:3", "max thta", "did you mean 'theta'?", &
            "q=0:1:3", "period thta", "a coordinate is needed", &
            "q=0:1:3", "flip x", "a coordinate is needed", &
            "q=0:1:3", "error", "a sweep measures no error", &
            "q=0:1:3", "max error", "a sweep measures no error", &
            "q=0:1:3", "", "what is to be kept?", &
            "q=0:1:3", "max", "of what", &
            "q=0:1:3", "first", "of what", &
            "q=0:1:3", "first theta = theta", "a number is needed", &
            "q=0:1:3", "first theta = 1 up", "none of rising", &
            "q=0:1:", "theta", "a whole number of values", &
            "q=-inf:1:3", "theta", "inf"], [3, 13])
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, size(bad, 2)
            call make(pendulum, [bad(1, i)], [bad(2, i)], sweep, error)
            call assertTrue(allocated(error), "refused: "//trim(bad(1, i))//" "//bad(2, i))
            if (.not. allocated(error)) cycle
            call assertTrue(index(error%message, trim(bad(3, i))) > 0, &
                            trim(bad(1, i))//" "//trim(bad(2, i))//": "//error%message)
        end do
        call make(pendulum, ["q=0:1:3", "q=1:2:3"], ["theta"], sweep, error)
        call assertTrue(allocated(error), "both axes the same")
        call make(pendulum, ["q=0:1:3    ", "theta=1:2:3"], ["theta"], sweep, error)
        call assertTrue(allocated(error), "by two names")
        call make(pendulum, [character(8) ::], ["theta"], sweep, error)
        call assertTrue(allocated(error), "no axis")
        call make(pendulum, ["q=0:1:3"], ["theta", "theta"], sweep, error)
        call assertTrue(allocated(error), "kept twice")
        if (allocated(error)) then
            call assertEqual("keep", error%key, "the key to blame")
            call assertEqual(2, error%element, "which of its texts")
            call assertEqual("'theta' is kept already", error%message, "says what")
        end if
        call make("&scene system='damped' dt=0.1 duration=1 q=1 / &lagrangian coordinates='x' "// &
                  "parameters='b' L='x_dot^2/2' Q_x='-b x_dot' / &damped b=1 /", ["b=1:2:3"], &
                  ["x   ", "work"], sweep, error)
        call assertTrue(allocated(error), "the work is no function of one state")
        if (allocated(error)) call assertEqual(2, error%element, "the one that it is")
        call make(pendulum//" &sweep section = 'theta = theta' /", ["q=0:1:3"], ["theta"], sweep, &
                  error)
        call assertTrue(allocated(error), "a section is an event")
        if (allocated(error)) call assertEqual("section", error%key, "the key to blame")
        call make(pendulum//" &sweep after = 31 /", ["q=0:1:3"], ["max theta"], sweep, error)
        call assertTrue(allocated(error), "nothing after the end")
        if (allocated(error)) call assertEqual("after", error%key, "the key to blame")
    end subroutine bad_sweeps_are_refused

    subroutine nothing_or_too_much_to_keep()
        !! By a call, for the program refuses it before.
        type(error_t), allocatable :: error
        type(sweep_t) :: sweep
        character(0) :: nothing(0)

        call make(pendulum, ["theta = 0:1:3"], nothing, sweep, error)
        call assertTrue(allocated(error), "nothing is kept")
        if (anyExceptions()) return
        call assertEqual("keep", error%key)
        call assertEqual("nothing is kept of a trajectory", error%message)
        call make(pendulum, ["theta = 0:1:3"], ["first theta = 0."//repeat("0", 103)//"5"], &
                  sweep, error)
        call assertFalse(allocated(error), "120 characters at most")
        call make(pendulum, ["theta = 0:1:3"], ["first theta = 0."//repeat("0", 104)//"5"], &
                  sweep, error)
        call assertTrue(allocated(error), "121 characters")
        if (anyExceptions()) return
        call assertEqual("a text of at most 120 characters is needed", error%message)
    end subroutine nothing_or_too_much_to_keep

    subroutine periods_are_those_of_closed_form()
        !! T(amplitude) of the pendulum: measured, and by the elliptic integral.
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error

        call compute(pendulum, ["theta=0.1:3:15"], ["period      ", "exact period"], 1, result, &
                     error, sweep)
        call assertFalse(allocated(error), "all can be computed")
        call assertEqual(0.0_dp, maxval(abs(result%values(1, :)/result%values(2, :) - 1)), &
                         1e-10_dp, "measured and exact")
        call assertTrue(all(result%values(2, 2:) > result%values(2, :14)), "it grows")
        call assertEqual(2*acos(-1.0_dp)/sqrt(9.81_dp)*(1 + 0.01_dp/16), result%values(2, 1), &
                         1e-5_dp, "the first term of the series")
    end subroutine periods_are_those_of_closed_form

    subroutine resonance_is_that_of_the_closed_form()
        !! The settled amplitude \(F_0/\sqrt{m^2(\omega_0^2 - W^2)^2 + b^2W^2}\), between samples
        !! of which the largest may be missed by \((W\,dt)^2/8\).
        character(*), parameter :: text = "&scene system = 'oscillator', method = 'gauss16', "// &
            "tolerance = 1e-10, duration = 120, samples = 12000, q = 0 / "// &
            "&oscillator m = 2, k = 3, b = 0.5, drive_force = 0.7 / &sweep after = 90 /"
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        real(dp) :: amplitude(9), w(9)
        integer(i8) :: i

        call compute(text, ["drive_frequency=0.4:2:9"], [character(11) :: "max x", "exact max x", &
            "min x", "exact min x"], 1, result, error, sweep)
        call assertFalse(allocated(error), "all can be computed")
        call assertEqual(result%values(2, :), result%values(1, :), 1e-9_dp, "largest")
        call assertEqual(result%values(4, :), result%values(3, :), 1e-9_dp, "smallest")
        w = sweep%axes(1)%value([(i, i=1_i8, 9_i8)])
        amplitude = 0.7_dp/sqrt((3 - 2*w**2)**2 + (0.5_dp*w)**2)
        call assertEqual(0.0_dp, maxval(abs(result%values(1, :)/amplitude - 1)), 2e-4_dp, &
                         "but for samples and the rest of the transient, e^(-90/8)")
    end subroutine resonance_is_that_of_the_closed_form

    subroutine lanes_are_single_trajectories()
        !! All of both, for a number of trajectories and steps that fill no block.
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        real(dp) :: alone(4), together(4, 33)
        integer(i8) :: failures, first, i
        integer :: flips

        call make(double, ["theta1=-2:3:11", "theta2=-3:3:3 "], &
                  ["flip theta2 ", "theta1      ", "energy_drift", "x_bob2      "], sweep, error)
        call assertFalse(allocated(error), "the sweep")
        call assertTrue(fits_lanes(sweep), "it can be computed in lanes")
        call compute_lanes(sweep, 1_i8, 33_i8, together, failures, first)
        call assertEqual(0, int(failures), "none fails")
        flips = 0
        do i = 1, 33
            call compute_one(sweep, i, alone, error)
            call assertFalse(allocated(error), "one by one")
            call assertTrue(ieee_is_nan(alone(1)) .eqv. ieee_is_nan(together(1, i)), &
                            "flips in both: "//to_text(i))
            if (ieee_is_nan(alone(1))) then
                alone(1) = 0.0_dp
                together(1, i) = 0.0_dp
            else
                flips = flips + 1
            end if
            call assertEqual(alone, together(:, i), 1e-9_dp, "trajectory "//to_text(i))
        end do
        call assertTrue(flips > 5 .and. flips < 28, "some go over the top: "//to_text(flips))
        call make(double, ["m1=1:3:11"], ["theta1"], sweep, error)
        call assertFalse(fits_lanes(sweep), "not with different systems")
    end subroutine lanes_are_single_trajectories

    subroutine processes_change_no_byte()
        !! In lanes and alone, with more blocks than processes.
        type(sweep_numbers_t) :: one, three
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error

        call compute(double, ["theta1=0:1:300"], ["theta2"], 1, one, error, sweep)
        call compute(double, ["theta1=0:1:300"], ["theta2"], 3, three, error, sweep)
        call assertTrue(one%in_lanes, "in lanes")
        call assertEqual(one%values(1, :), three%values(1, :), 0.0_dp, "in lanes")
        call compute(double, ["m1=0.5:1:200"], ["theta2"], 1, one, error, sweep)
        call compute(double, ["m1=0.5:1:200"], ["theta2"], 3, three, error, sweep)
        call assertFalse(one%in_lanes, "alone")
        call assertEqual(one%values(1, :), three%values(1, :), 0.0_dp, "alone")
    end subroutine processes_change_no_byte

    subroutine a_failure_is_nan_and_counted()
        !! Rods of no length are refused, the others go on; where all fail that is an error.
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error

        call compute(pendulum, ["l=-1:2:4"], ["theta"], 2, result, error, sweep)
        call assertFalse(allocated(error), "two of four are good")
        call assertEqual(2, result%failures, "two fail")
        call assertTrue(all(ieee_is_nan(result%values(1, :2))), "they are NaN")
        call assertFalse(any(ieee_is_nan(result%values(1, 3:))), "the others are not")
        call assertTrue(index(result%reason, "l") > 0, result%reason)
        call compute(pendulum, ["l=-2:-1:4"], ["theta"], 2, result, error, sweep)
        call assertTrue(allocated(error), "all fail")
        call compute("&scene system='oscillator', dt=3, duration=3e3, q=1 / &oscillator k=1e4 /", &
                     ["q=1:2:9"], ["x"], 2, result, error, sweep)
        call assertTrue(allocated(error), "all diverge")
        if (allocated(error)) call assertEqual(status_numbers, error%status, error%message)
    end subroutine a_failure_is_nan_and_counted

    subroutine least_and_largest_after_a_time()
        !! A damped pendulum: the later, the smaller; and events from the start on.
        character(*), parameter :: text = "&scene system='pendulum', method='gauss16', "// &
            "tolerance=1e-10, duration=20, samples=2000, q=1 / &pendulum b=0.3 / &sweep after = "
        type(sweep_numbers_t) :: all, late
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error

        call compute(text//"0 /", ["q=0.5:1:2"], [character(20) :: "max theta", "min theta", &
                     "first theta = 0"], 1, all, error, sweep)
        call assertFalse(allocated(error), "from the start")
        call compute(text//"10 /", ["q=0.5:1:2"], [character(20) :: "max theta", "min theta", &
                     "first theta = 0"], 1, late, error, sweep)
        call assertFalse(allocated(error), "late")
        call assertEqual([0.5_dp, 1.0_dp], all%values(1, :), 0.0_dp, "largest at the start")
        call assertTrue(maxval(late%values(1, :)) < 0.3_dp, "it has become smaller")
        call assertTrue(minval(late%values(1, :)) > 0.0_dp, "but still swings")
        call assertTrue(maxval(late%values(2, :)) < 0.0_dp, "to both sides")
        call assertTrue(minval(all%values(2, :)) > -1.0_dp, "less far than at first")
        call assertEqual(all%values(3, :), late%values(3, :), 0.0_dp, "an event counts at once")
        call assertTrue(minval(all%values(3, :)) > 0.5_dp .and. maxval(all%values(3, :)) < 0.7_dp, &
                        "a quarter of a period and a little")
    end subroutine least_and_largest_after_a_time

    subroutine lyapunov_exponents_that_are_known()
        !! Upright at rest a pendulum falls as \(e^{t\sqrt{g/l}}\), within the 5 s in which the
        !! rounding of pi stays below 1e-8, once the part that decays is gone, \(e^{-6\sqrt{g/l}}\);
        !! a damped oscillator forgets as \(e^{-bt/2m}\); a pendulum far from the top does neither.
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        character(*), parameter :: both(2) = [character(14) :: "lyapunov", "lyapunov error"]
        character(*), parameter :: times = "method='gauss16', tolerance=1e-11, "

        call compute("&scene system='pendulum', "//times//"duration=5, q=1 / &sweep after=3 /", &
                     ["theta=pi:pi:1"], both, 1, result, error, sweep)
        call assertFalse(allocated(error), "upright")
        call assertEqual(sqrt(9.81_dp), result%values(1, 1), 1e-5_dp, "upright")
        call assertTrue(result%values(2, 1) < 1e-4_dp, "the same in all windows")
        call compute("&scene system='oscillator', "//times//"duration=200, q=1 / &oscillator "// &
                     "b=0.3 /", ["m=1:2:2"], both, 1, result, error, sweep)
        call assertFalse(allocated(error), "damped")
        call assertEqual([-0.15_dp, -0.075_dp], result%values(1, :), 5e-3_dp, "damped")
        call assertTrue(all(abs(result%values(1, :) - [-0.15_dp, -0.075_dp]) < &
                            4*result%values(2, :) + 1e-4_dp), "within four errors")
        call compute("&scene system='oscillator', "//times//"duration=40000, q=1 / &oscillator "// &
                     "b=0.3 /", ["m=1:1:1"], both, 1, result, error, sweep)
        call assertEqual(-0.15_dp, result%values(1, 1), 1e-4_dp, "a displacement of e^-6000")
        call compute("&scene system='top', "//times//"duration=12000, q=0 / &lagrangian "// &
                     "coordinates='x', L='x_dot^2/2 + 50 x^2' / &sweep after=100 /", ["x=0:0:1"], &
                     both, 1, result, error, sweep)
        call assertEqual(10.0_dp, result%values(1, 1), 1e-8_dp, "and of e^120000")
        call compute("&scene system='top', "//times//"duration=2, q=0 / &lagrangian "// &
                     "coordinates='x', L='x_dot^2/2 + x^2/2' /", ["x=0:0:1"], ["lyapunov"], 1, &
                     result, error, sweep)  ! from (1/2, -1/3) = (1 + 5, 1 - 5)/12 at once
        call assertEqual(0.25_dp*log((exp(4.0_dp) + 25*exp(-4.0_dp))/26), result%values(1, 1), &
                         1e-9_dp, "the displacement begins with the length 1")
        call compute("&scene system='pendulum', "//times//"duration=400, q=1 /", &
                     ["theta=0.5:2:2"], ["lyapunov"], 1, result, error, sweep)
        call assertEqual(0.0_dp, maxval(abs(result%values)), 0.03_dp, "ln(t)/t of a shear")
        call compute("&scene system='bouncing_ball', "//times//"duration=1, q=1 /", &
                     ["y=1:2:2"], ["lyapunov"], 1, result, error, sweep)
        call assertTrue(allocated(error), "across impacts there is none")
    end subroutine lyapunov_exponents_that_are_known

    subroutine lyapunov_exponent_of_ueda()
        !! 0.1034 /s for b = 0.05, f = 7.5. Source: Sprott, Chaos and Time-Series Analysis (2003),
        !! appendix A. Only so well as the window allows.
        character(*), parameter :: text = "&scene system='ueda', method='gauss16', "// &
            "tolerance=1e-7, duration=900, q=2.5 / &lagrangian coordinates='x', "// &
            "parameters='b', L='x_dot^2/2 - x^4/4 + 7.5 x cos(t)', Q_x='-b x_dot' / "// &
            "&ueda b=0.05 / &sweep after=100 /"
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error

        call compute(text, ["x=2:3:4"], [character(14) :: "lyapunov", "lyapunov error"], 2, &
                     result, error, sweep)
        call assertFalse(allocated(error), "four starts")
        call assertTrue(all(result%values(2, :) > 1e-4_dp .and. result%values(2, :) < 0.02_dp), &
                        "the stated errors")
        call assertTrue(all(abs(result%values(1, :) - 0.1034_dp) < 4*result%values(2, :)), &
                        "each within four errors of the book's")
        call assertEqual(0.1034_dp, sum(result%values(1, :))/4, 0.01_dp, "their mean")
    end subroutine lyapunov_exponent_of_ueda

    subroutine a_grid_is_written_line_by_line()
        !! Two axes, the second the faster; the script draws a map.
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        character(:), allocatable :: path, script, text
        integer :: at

        call compute(double, ["theta1=0:1:2", "m1=1:3:3    "], ["theta1_dot"], 1, result, error, &
                     sweep)
        path = new_folder("sweep")//"/grid.dat"
        call write_sweep(sweep, result%of, path, "text", ["a line"], error)
        call assertFalse(allocated(error), "written")
        call read_whole_file(path, text, error)
        at = index(text, "# theta1[rad] m1[kg] theta1_dot[rad/s]"//line)
        call assertTrue(at > 0, "the columns")
        call assertTrue(index(text, "# a line"//line) > 0, "the header")
        call assertTrue(index(text, "# trajectories: 6, failed: 0 ") > 0, "the counts")
        text = text(at:)
        call assertEqual(8, count([(text(at:at) == line, at=1, len(text))]), "lines of data")
        call assertEqual(1, count([(text(at:at + 1) == line//line, at=1, len(text) - 1)]), &
                         "one empty line")
        call read_whole_file(path(:len(path) - 3)//"gp", script, error)
        call assertTrue(index(script, "plot [0.0:1.0] [1.0:3.0] data using 1:2:3 with image"// &
                              line) > 0, script)
        call assertTrue(index(script, "set xlabel ""θ_{1} (rad)""") > 0, "the first axis")
    end subroutine a_grid_is_written_line_by_line
end module test_sweep
