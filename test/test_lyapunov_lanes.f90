module test_lyapunov_lanes
    !! Lyapunov exponents with eight motions in lanes: those that are known, those of one motion at
    !! a time, and the same bytes whatever the neighbours are.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_lyapunov, only: displace
    use lagrangia_lyapunov_lanes, only: compute_exponents
    use lagrangia_sweep, only: fits_lanes, follows_displacements, sweep_t
    use lagrangia_sweep_trajectory, only: compute_one
    use lagrangia_text, only: to_text
    use sweep_numbers, only: compute_numbers, make => make_sweep, sweep_numbers_t
    implicit none (type, external)
    private
    public :: lyapunov_lanes_suite

    character(*), parameter :: both(2) = [character(14) :: "lyapunov", "lyapunov error"]
    character(*), parameter :: times = "method = 'dop853', tolerance = 1e-11, samples = 1, "
    character(*), parameter :: double = "&scene system = 'double_pendulum', "//times// &
        "duration = 20, q = 0.5, 0.2, v = 0.1, 0 / &double_pendulum m2 = 0.7 / &sweep after = 3 /"
    character(*), parameter :: forced = "&scene system = 'forced', "//times//"duration = 20, "// &
        "q = 0.5 / &lagrangian coordinates = 'theta [rad]', parameters = 'f', 'W', "// &
        "L = 'theta_dot^2/2 + cos(theta) + f theta cos(W t)', Q_theta = '-theta_dot/2' / "// &
        "&forced f = 0.5, W = 0.7 / &sweep after = 3 /"
    character(*), parameter :: runaway = "&scene system = 'runaway', "//times// &
        "duration = 2, q = 1 / &lagrangian coordinates = 'x', parameters = 'c', "// &
        "L = 'x_dot^2/2 + c x^4/4' / &runaway c = 1 /"

contains

    function lyapunov_lanes_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("lyapunov_lanes")
        call suite%addTest(TestMethod("exponents_that_are_known", exponents_that_are_known))
        call suite%addTest(TestMethod("displacements_have_length_1", displacements_have_length_1))
        call suite%addTest(TestMethod("those_of_one_at_a_time", those_of_one_at_a_time))
        call suite%addTest(TestMethod("ueda", ueda))
        call suite%addTest(TestMethod("chaos_by_two_methods", chaos_by_two_methods))
        call suite%addTest(TestMethod("exponent_of_floquet", exponent_of_floquet))
        call suite%addTest(TestMethod("neighbours_change_no_byte", neighbours_change_no_byte))
        call suite%addTest(TestMethod("processes_change_no_byte", processes_change_no_byte))
        call suite%addTest(TestMethod("who_blows_up_is_alone", who_blows_up_is_alone))
        call suite%addTest(TestMethod("what_is_refused_alone", what_is_refused_alone))
        call suite%addTest(TestMethod("what_fits", what_fits))
    end function lyapunov_lanes_suite

    subroutine displacements_have_length_1()
        !! Whatever the state is, unless the measuring begins later: one in no plane of symmetry.
        real(dp), parameter :: first(4) = [1.0_dp/2, 1.0_dp/3, -1.0_dp/3, 1.0_dp/4]
        real(dp) :: q(4), v(4)
        integer :: sense

        do sense = -1, 1, 2
            call displace(sense*[3.0_dp, 5.0_dp], sense*[7.0_dp, 11.0_dp], .true., q, v)
            call assertEqual(sense*[3.0_dp, 5.0_dp, 7.0_dp, 11.0_dp], [q(:2), v(:2)], 0.0_dp, &
                             "the state")
            call assertEqual(first, [q(3:), v(3:)], 1e-15_dp, "it settles")
            call displace(sense*[3.0_dp, 5.0_dp], sense*[7.0_dp, 11.0_dp], .false., q, v)
            call assertEqual(sense*[3.0_dp, 5.0_dp, 7.0_dp, 11.0_dp], [q(:2), v(:2)], 0.0_dp, &
                             "the state")
            call assertEqual(first/norm2(first), [q(3:), v(3:)], 1e-15_dp, "of length 1")
        end do
    end subroutine displacements_have_length_1

    subroutine compute(sweep, values, failed)
        !! All trajectories, in lanes.
        type(sweep_t), intent(in) :: sweep
        real(dp), allocatable, intent(out) :: values(:, :)
        integer, intent(in) :: failed  !! so many are to fail
        integer(i8) :: failures, first

        allocate (values(sweep%width(), sweep%trajectories()))
        call assertTrue(fits_lanes(sweep), "in lanes")
        call assertTrue(follows_displacements(sweep), "with their displacements")
        call compute_exponents(sweep, 1_i8, sweep%trajectories(), values, failures, first)
        call assertEqual(failed, int(failures), "failures")
    end subroutine compute

    subroutine exponents_that_are_known()
        !! As in `test_sweep`: a pendulum upright at rest, \(\sqrt{g/l}\); a damped oscillator,
        !! \(-b/2m\); displacements that shrink to \(e^{-6000}\) and grow to \(e^{120000}\); and one
        !! that begins with the length 1 because there is no time to settle.
        type(sweep_t) :: sweep
        real(dp), allocatable :: values(:, :)
        real(dp) :: m(11)
        integer(i8) :: i

        call make("&scene system='pendulum', "//times//"duration=5, q=1 / &sweep after=3 /", &
                  ["theta=pi:pi:1"], both, sweep)
        call compute(sweep, values, 0)
        call assertEqual(sqrt(9.81_dp), values(1, 1), 1e-5_dp, "upright")
        call assertTrue(values(2, 1) < 1e-4_dp, "the same in all windows")
        call make("&scene system='oscillator', "//times//"duration=200, q=1 / &oscillator "// &
                  "b=0.3 /", ["m=1:2:11"], both, sweep)
        call compute(sweep, values, 0)
        call assertEqual([-0.15_dp, -0.1_dp, -0.075_dp], values(1, [1, 6, 11]), 5e-3_dp, "damped")
        m = sweep%axes(1)%value([(i, i=1_i8, 11_i8)])
        call assertTrue(all(abs(values(1, :) + 0.15_dp/m) < 4*values(2, :) + 1e-4_dp), &
                        "within four errors")
        call make("&scene system='oscillator', "//times//"duration=40000, q=1 / &oscillator "// &
                  "b=0.3 /", ["m=1:1:1"], both, sweep)
        call compute(sweep, values, 0)
        call assertEqual(-0.15_dp, values(1, 1), 1e-4_dp, "a displacement of e^-6000")
        call make("&scene system='top', "//times//"duration=12000, q=0 / &lagrangian "// &
                  "coordinates='x', L='x_dot^2/2 + 50 x^2' / &sweep after=100 /", ["x=0:0:1"], &
                  both, sweep)
        call compute(sweep, values, 0)
        call assertEqual(10.0_dp, values(1, 1), 1e-8_dp, "and of e^120000")
        call make("&scene system='top', "//times//"duration=2, q=0 / &lagrangian "// &
                  "coordinates='x', L='x_dot^2/2 + x^2/2' /", ["x=0:0:1"], both(:1), sweep)
        call compute(sweep, values, 0)  ! from (1/2, -1/3) = (1 + 5, 1 - 5)/12
        call assertEqual(0.25_dp*log((exp(4.0_dp) + 25*exp(-4.0_dp))/26), values(1, 1), &
                         1e-9_dp, "it begins with the length 1")
    end subroutine exponents_that_are_known

    subroutine those_of_one_at_a_time()
        !! Motions that are not chaotic, of compiled systems and of those in formulas, of one start
        !! and system and of many: both ways are right to some hundred tolerances.
        call compare(double, ["theta1=-0.7:0.8:11", "theta2=-0.5:1:3   "])
        call compare(double, ["theta2=-0.5:0.7:5", "g=1:10:3         "])
        call compare(forced, ["theta=-1:1:11"])
        call compare(forced, ["f=0.2:0.6:5", "W=0.5:1:3  "])
        call compare("&scene system = 'cart_pendulum', "//times//"duration = 20, q = 0, 1 /", &
                     ["theta=0.5:1:3"])  ! alone, too, its cyclic coordinate stays
        call compare("&scene system = 'hanging_chain', "//times//"duration = 5, q = 3*0.1 / "// &
                     "&sweep after = 1 /", ["g=9:10:3"])
        call compare("&scene system = 'double_pendulum', "//times//"duration = 20, q = 0.3, "// &
                     "0.2, v = 1, 0 / &sweep energy_by = 'theta1_dot' /", ["theta2=0:0.3:4"])
    end subroutine those_of_one_at_a_time

    subroutine compare(text, over)
        !! Exponents and errors.
        character(*), intent(in) :: text, over(:)
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        real(dp), allocatable :: together(:, :)
        real(dp) :: alone(2)
        integer(i8) :: i

        call make(text, over, both, sweep)
        call compute(sweep, together, 0)
        do i = 1, sweep%trajectories()
            call compute_one(sweep, i, alone, error)
            call assertFalse(allocated(error), "alone")
            call assertEqual(alone, together(:, i), 1e-7_dp, trim(over(1))//": "//to_text(i))
        end do
    end subroutine compare

    subroutine ueda()
        !! 0.1034 /s for b = 0.05, f = 7.5. Source: Sprott, Chaos and Time-Series Analysis (2003),
        !! appendix A. Each within four of its errors, which the scatter of all confirms.
        character(*), parameter :: text = "&scene system='ueda', method='dop853', samples=1, "// &
            "tolerance=1e-7, duration=4100, q=2.5 / &lagrangian coordinates='x', "// &
            "parameters='b', L='x_dot^2/2 - x^4/4 + 7.5 x cos(t)', Q_x='-b x_dot' / "// &
            "&ueda b=0.05 / &sweep after=100 /"
        type(sweep_t) :: sweep
        real(dp), allocatable :: values(:, :)
        real(dp) :: error

        call make(text, ["x=2:3:16"], both, sweep)
        call compute(sweep, values, 0)
        call assertTrue(all(abs(values(1, :) - 0.1034_dp) < 4*values(2, :)), "each")
        error = sqrt(sum(values(2, :)**2))/16
        call assertEqual(0.1034_dp, sum(values(1, :))/16, 4*error, "their mean")
        call assertTrue(error < 0.003_dp, "of some size")
    end subroutine ueda

    subroutine chaos_by_two_methods()
        !! Ueda's oscillator from the same starts, until a difference of 1e-8 has grown to 1e-6: by
        !! `gauss16` alone, which begins anew where a displacement is scaled, and by `dop853` with a
        !! finer tolerance. A mean over long motions could not tell them apart that well.
        character(*), parameter :: text = "duration=40, q=2.5 / &lagrangian coordinates='x', "// &
            "parameters='b', L='x_dot^2/2 - x^4/4 + 7.5 x cos(t)', Q_x='-b x_dot' / "// &
            "&ueda b=0.05 /"
        type(sweep_t) :: alone, in_lanes
        type(sweep_numbers_t) :: numbers
        type(error_t), allocatable :: error
        real(dp), allocatable :: values(:, :)

        call make("&scene system='ueda', samples=1, method='dop853', tolerance=1e-12, "//text, &
                  ["x=-2:2:16"], both, in_lanes)
        call compute(in_lanes, values, 0)
        call make("&scene system='ueda', samples=1, method='gauss16', tolerance=1e-9, "//text, &
                  ["x=-2:2:16"], both, alone)
        call assertFalse(fits_lanes(alone), "alone")
        call compute_numbers(alone, 1, numbers, error)
        call assertFalse(allocated(error), "by gauss16")
        call assertEqual(values, numbers%values, 1e-6_dp, "exponents and their errors")
        call assertTrue(maxval(values(1, :)) - minval(values(1, :)) > 0.1_dp, "of many motions")
    end subroutine chaos_by_two_methods

    subroutine exponent_of_floquet()
        !! A parametric resonance, \(\ddot x = -0.02\dot x - (1/4 + 0.3\cos t)x\): the growth in
        !! whole periods is that of Floquet's solution, whose multipliers are those of the matrix
        !! that `rk4` by hand gives in 16000 steps a period, to 1e-14. Each of 16 windows has 200
        !! periods, each of its parts 21 e-foldings: displacements are scaled on the way.
        character(*), parameter :: rest = "samples=1, duration=20231.856689118268, q=0 / "// &
            "&lagrangian coordinates='x', parameters='e', L='x_dot^2/2 - (1/4 + e cos(t)) x^2/2"// &
            "', Q_x='-0.02 x_dot' / &hill e=0.3 / &sweep after=125.66370614359172 /"
        real(dp), parameter :: exponent = 0.134255927722876_dp
        type(sweep_t) :: alone, in_lanes
        type(error_t), allocatable :: error
        real(dp), allocatable :: values(:, :)
        real(dp) :: numbers(2)

        call make("&scene system='hill', method='dop853', tolerance=1e-10, "//rest, &
                  ["e=0.3:0.3:1"], both, in_lanes)
        call compute(in_lanes, values, 0)
        call assertEqual([exponent, 0.0_dp], values(:, 1), 1e-10_dp, "by dop853, in lanes")
        call make("&scene system='hill', method='gauss16', tolerance=1e-10, "//rest, &
                  ["e=0.3:0.3:1"], both, alone)
        call assertFalse(fits_lanes(alone), "alone")
        call compute_one(alone, 1_i8, numbers, error)
        call assertFalse(allocated(error), "by gauss16")
        call assertEqual([exponent, 0.0_dp], numbers, 1e-11_dp, "by gauss16, alone")
    end subroutine exponent_of_floquet

    subroutine neighbours_change_no_byte()
        !! Each alone in a block of its own, and all together.
        call compare_neighbours(double, ["theta1=-3:3:15      ", "theta2_dot=-20:20:3 "])
        call compare_neighbours(double, ["m1=1:3:15      ", "theta2=-1:1:3  "])
        call compare_neighbours(forced, ["f=0.5:1.5:15", "W=0.5:1:3   "])
    end subroutine neighbours_change_no_byte

    subroutine compare_neighbours(text, over)
        !! Of a grid of 45 trajectories, some of them chaotic; those that are computed alone had
        !! seven different places among eight lanes.
        character(*), intent(in) :: text, over(:)
        type(sweep_t) :: sweep
        real(dp), allocatable :: together(:, :)
        real(dp) :: alone(2, 1)
        integer(i8) :: failures, first, i

        call make(text, over, both, sweep)
        call compute(sweep, together, 0)
        call assertFalse(any(ieee_is_nan(together)), "all are there")
        do i = 1, 45, 7
            call compute_exponents(sweep, i, i, alone, failures, first)
            call assertTrue(all(transfer(alone(:, 1), [0_i8]) == &
                                transfer(together(:, i), [0_i8])), "trajectory "//to_text(i))
        end do
    end subroutine compare_neighbours

    subroutine processes_change_no_byte()
        !! More blocks than processes; few trajectories make small blocks, so that all work.
        type(sweep_numbers_t) :: one, more
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        integer :: threads

        call make(double, ["theta1=0:2:50"], both, sweep)
        call compute_numbers(sweep, 1, one, error)
        call assertFalse(allocated(error), "by one process")
        call assertTrue(one%in_lanes, "in lanes")
        call assertEqual(7, int(one%of%store%blocks), "blocks")
        do threads = 2, 3
            call compute_numbers(sweep, threads, more, error)
            call assertFalse(allocated(error), "by processes: "//to_text(threads))
            call assertEqual(one%values(1, :), more%values(1, :), 0.0_dp, to_text(threads))
            call assertEqual(one%values(2, :), more%values(2, :), 0.0_dp, to_text(threads))
        end do
    end subroutine processes_change_no_byte

    subroutine who_blows_up_is_alone()
        !! \(\ddot x = x^3\) from rest at \(x_0\) is at infinity after \(1.85/x_0\): of nine
        !! starts up to 2 the outer three on both sides within 2 s. With \(c x^3\) from rest at 1
        !! after \(1.85/\sqrt c\).
        type(sweep_t) :: sweep
        real(dp), allocatable :: together(:, :)
        real(dp) :: alone(2, 1), c(11)
        integer(i8) :: failures, first, i

        call make(runaway, ["x=-2:2:9"], both, sweep)
        call compute(sweep, together, 6)
        do i = 1, 9
            call assertTrue(all(ieee_is_nan(together(:, i)) .eqv. abs(i - 5) > 1), &
                            "NaN: "//to_text(i))
            call compute_exponents(sweep, i, i, alone, failures, first)
            if (abs(i - 5) > 1) cycle
            call assertEqual(alone(1, 1), together(1, i), 0.0_dp, "trajectory "//to_text(i))
        end do
        call make(runaway, ["c=-16:4:11"], both, sweep)
        call compute(sweep, together, 2)
        c = sweep%axes(1)%value([(i, i=1_i8, 11_i8)])
        call assertTrue(all(ieee_is_nan(together(1, :)) .eqv. c > 1), "of c")
    end subroutine who_blows_up_is_alone

    subroutine what_is_refused_alone()
        !! No mass is negative, no velocity has any energy, no motion goes on where its mass is not
        !! positive, and of large angles rounding is more than the tolerance.
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        real(dp), allocatable :: together(:, :)
        real(dp) :: alone(2)
        integer(i8) :: i

        call make(double, ["m1=-1:1:11"], both, sweep)
        call compute(sweep, together, 6)
        call assertTrue(all(ieee_is_nan(together(1, :6))), "NaN")
        call assertFalse(any(ieee_is_nan(together(:, 7:))), "the others are there")
        call make("&scene system = 'double_pendulum', "//times//"duration = 2, q = 0.3, 0.2 / "// &
                  "&sweep energy_by = 'theta1_dot' /", ["theta2=0:3:4"], both, sweep)
        call compute(sweep, together, 3)
        call assertFalse(any(ieee_is_nan(together(:, 1))), "low enough")
        call make("&scene system = 'bent', "//times//"duration = 2, q = 1 / &lagrangian "// &
                  "coordinates = 'x', L = 'x x_dot^2/2 + x^2/2' /", ["x=-2:1:4"], both, sweep)
        call compute(sweep, together, 3)
        call assertFalse(any(ieee_is_nan(together(:, 4))), "a positive mass")
        call make(double, ["theta1=1:1e9:4:log"], both, sweep)
        call compute(sweep, together, 2)
        call assertTrue(all(ieee_is_nan(together(1, 3:))), "large")
        do i = 1, 4, 3
            call compute_one(sweep, i, alone, error)
            call assertTrue(ieee_is_nan(together(1, i)) .eqv. allocated(error), to_text(i))
        end do
    end subroutine what_is_refused_alone

    subroutine what_fits()
        !! And which method `auto` takes.
        character(*), parameter :: auto = "&scene system = 'double_pendulum', "// &
            "method = 'auto', tolerance = 1e-9, duration = 1, samples = 1, q = 0.5, 0.2 /"
        type(sweep_t) :: sweep

        call make(auto, ["theta1=1:3:11"], both, sweep)
        call assertEqual("dop853", trim(sweep%scene%method), "auto takes lanes")
        call assertTrue(follows_displacements(sweep), "auto")
        call make(auto, ["theta1=1:3:11"], [character(14) :: "lyapunov", "theta1"], sweep)
        call assertFalse(fits_lanes(sweep), "the end of the motion is another run's")
        call make("&scene system = 'rolling_disk', "//times//"duration = 1, q = 3*0, 0.7 /", &
                  ["phi=1:2:2"], &
                  both, sweep)
        call assertFalse(fits_lanes(sweep), "constraints: by differences, alone")
        call make("&scene system = 'double_pendulum', method = 'gauss16', tolerance = 1e-9, "// &
                  "duration = 1, samples = 1, q = 0.5, 0.2 /", ["theta1=1:3:11"], both, sweep)
        call assertFalse(fits_lanes(sweep), "another method")
        call make(double, ["theta1=1:3:11"], both, sweep)
        sweep%after = 20.0_dp
        call assertFalse(fits_lanes(sweep), "no time is left")
    end subroutine what_fits
end module test_lyapunov_lanes
