module test_sweep_points
    !! Points of a stroboscope and of a section, one energy for all starts, attractors.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_attractor, only: attractors_t
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_files, only: read_whole_file
    use lagrangia_kept, only: wrapped
    use lagrangia_kinds, only: dp, i8
    use lagrangia_sweep, only: fits_lanes, sweep_t
    use lagrangia_sweep_files, only: write_sweep
    use lagrangia_sweep_lanes, only: compute_lanes
    use lagrangia_sweep_trajectory, only: compute_one
    use lagrangia_text, only: to_text
    use sweep_numbers, only: compute_numbers, make => make_sweep, sweep_numbers_t
    use test_scratch, only: new_folder
    implicit none (type, external)
    private
    public :: sweep_points_suite

    real(dp), parameter :: pi = acos(-1.0_dp)
    character(*), parameter :: line = new_line("a")
    character(*), parameter :: oscillator = "&scene system='oscillator', method='gauss16', "// &
        "tolerance=1e-11, duration=50, samples=7, q=1 / "
    character(*), parameter :: double = "&scene system='double_pendulum', method='gauss16', "// &
        "tolerance=1e-10, duration=40, samples=7, q=0, 0, v=3, 0 / "
    character(*), parameter :: two_wells = "&scene system='wells', method='gauss16', "// &
        "tolerance=1e-9, duration=200, samples=7, q=1 / &lagrangian coordinates='x', "// &
        "parameters='b', 'f', L='x_dot^2/2 + x^2/2 - x^4/4 + f x cos(t)', Q_x='-b x_dot' / "

contains

    function sweep_points_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("sweep_points")
        call suite%addTest(TestMethod("a_stroboscope_follows_the_parameter", &
                                      a_stroboscope_follows_the_parameter))
        call suite%addTest(TestMethod("points_begin_after_a_time_and_end", &
                                      points_begin_after_a_time_and_end))
        call suite%addTest(TestMethod("fixed_steps_meet_the_stroboscope", &
                                      fixed_steps_meet_the_stroboscope))
        call suite%addTest(TestMethod("a_section_is_a_period_apart", a_section_is_a_period_apart))
        call suite%addTest(TestMethod("contacts_are_no_points", contacts_are_no_points))
        call suite%addTest(TestMethod("all_starts_have_one_energy", all_starts_have_one_energy))
        call suite%addTest(TestMethod("angles_are_wrapped", angles_are_wrapped))
        call suite%addTest(TestMethod("attractors_have_places", attractors_have_places))
        call suite%addTest(TestMethod("attractors_are_the_two_wells", &
                                      attractors_are_the_two_wells))
        call suite%addTest(TestMethod("what_has_settled_has_an_attractor", &
                                      what_has_settled_has_an_attractor))
        call suite%addTest(TestMethod("lanes_keep_the_same_points", lanes_keep_the_same_points))
        call suite%addTest(TestMethod("bad_points_are_refused", bad_points_are_refused))
        call suite%addTest(TestMethod("a_row_is_a_point", a_row_is_a_point))
    end function sweep_points_suite

    subroutine compute(text, over, keep, result, error, sweep)
        !! What a sweep gives, by three processes.
        character(*), intent(in) :: text, over(:), keep(:)
        type(sweep_numbers_t), intent(out) :: result
        type(error_t), allocatable, intent(out) :: error
        type(sweep_t), intent(out) :: sweep

        call make(text, over, keep, sweep, error)
        if (allocated(error)) return
        call compute_numbers(sweep, 3, result, error)
    end subroutine compute

    subroutine a_stroboscope_follows_the_parameter()
        !! Lit once a period of the free oscillation, 2 pi sqrt(m/k), an oscillator stands still,
        !! whatever its mass is.
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        integer :: i, k

        call compute(oscillator//"&oscillator k=1.3 / &sweep strobe='2 pi sqrt(m/k)', points=4 /", &
                     ["m=0.5:4:5"], [character(5) :: "x", "x_dot", "t"], result, error, sweep)
        call assertFalse(allocated(error), "it can be computed")
        call assertEqual(12, size(result%values, 1), "three numbers of each of four points")
        do i = 1, 5
            do k = 0, 3
                associate (point => result%values(3*k + 1:3*k + 3, i))
                    call assertEqual([1.0_dp, 0.0_dp], point(:2), 1e-9_dp, "it stands still")
                    call assertEqual(2*pi*k*sqrt(sweep%axes(1)%value(int(i, i8))/1.3_dp), &
                                     point(3), 1e-13_dp*(k + 1), "at whole periods")
                end associate
            end do
        end do
    end subroutine a_stroboscope_follows_the_parameter

    subroutine points_begin_after_a_time_and_end()
        !! With the first at `after` or later, and no more than are there.
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error

        call compute(oscillator//"&sweep strobe='3', points=6, after=20 /", ["x=1:2:2"], ["t"], &
                     result, error, sweep)
        call assertFalse(allocated(error), "it can be computed")
        call assertEqual([21.0_dp, 24.0_dp, 27.0_dp, 30.0_dp, 33.0_dp, 36.0_dp], &
                         result%values(:, 2), 1e-13_dp, "six of them")
        call compute(oscillator//"&sweep strobe='3', points=6, after=39 /", ["x=1:2:2"], ["t"], &
                     result, error, sweep)
        call assertEqual([39.0_dp, 42.0_dp, 45.0_dp, 48.0_dp], result%values(:4, 2), 1e-13_dp, &
                         "as many as there are")
        call assertTrue(all(ieee_is_nan(result%values(5:, 2))), "and no more")
        call compute(oscillator//"&sweep strobe='3', points=1, after=20 /", ["x=1:2:2"], ["t"], &
                     result, error, sweep)
        call assertFalse(allocated(error), "one is enough")
        if (allocated(error)) return
        call assertEqual(21.0_dp, result%values(1, 2), 1e-13_dp, "the first")
    end subroutine points_begin_after_a_time_and_end

    subroutine fixed_steps_meet_the_stroboscope()
        !! Steps of 0.1 s do not divide 0.77 s, steps of 0.77/8 s do.
        type(sweep_numbers_t) :: fixed, adaptive
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        character(*), parameter :: group = "&sweep strobe='0.77', points=9, after=5 /"

        call compute("&scene system='oscillator', method='rk4', dt=0.1, duration=50, q=1 / "// &
                     group, ["x=1:2:2"], ["x", "t"], fixed, error, sweep)
        call assertFalse(allocated(error), "fixed steps")
        call compute(oscillator//group, ["x=1:2:2"], ["x", "t"], adaptive, error, sweep)
        call assertEqual(adaptive%values(2::2, 1), fixed%values(2::2, 1), 1e-13_dp, "the times")
        call assertEqual(0.77_dp*7, fixed%values(2, 1), 1e-13_dp, &
                         "the first is the seventh")
        call assertEqual(adaptive%values(::2, 1), fixed%values(::2, 1), 12*0.1_dp**4/120, &
                         "the states, but for the error of rk4, t h^4/120")
    end subroutine fixed_steps_meet_the_stroboscope

    subroutine a_section_is_a_period_apart()
        !! Through the lowest place from one side: the times are those of the closed form.
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        real(dp) :: exact
        integer :: k

        call compute("&scene system='pendulum', method='gauss16', tolerance=1e-11, "// &
                     "duration=1e4, samples=7, q=1 / &sweep section='theta = 0 rising', "// &
                     "points=5, after=10 /", ["theta=1.5:2:2"], &
                     [character(9) :: "t", "theta", "theta_dot"], result, error, sweep)
        call assertFalse(allocated(error), "it can be computed")
        ! 4 sqrt(l/g) K(sin(theta0/2)) for theta0 = 2, K(sin 1) by Abramowitz & Stegun 17.6
        exact = 4/sqrt(9.81_dp)*agm_quarter(cos(1.0_dp))
        do k = 0, 4
            associate (point => result%values(3*k + 1:3*k + 3, 2))
                call assertEqual(0.0_dp, point(2), 1e-9_dp, "at the lowest place")
                call assertEqual(2*sqrt(9.81_dp)*sin(1.0_dp), point(3), 1e-8_dp, "upwards")
                call assertEqual(0.0_dp, modulo(point(1)/exact - 0.75_dp + 0.5_dp, 1.0_dp) - &
                                 0.5_dp, 1e-8_dp, "after three quarters of a period and some")
                call assertTrue(point(1) >= 10 .and. point(1) < 10 + (k + 1)*exact, &
                                "after 10 s: "//to_text(point(1)))
            end associate
        end do
    contains
        pure function agm_quarter(k_dash) result(k)
            !! The complete elliptic integral K by the arithmetic-geometric mean of 1 and k'.
            real(dp), intent(in) :: k_dash
            real(dp) :: a, b, c, k
            integer :: i

            a = 1.0_dp
            b = k_dash
            do i = 1, 8
                c = 0.5_dp*(a + b)
                b = sqrt(a*b)
                a = c
            end do
            k = pi/(2*a)
        end function agm_quarter
    end subroutine a_section_is_a_period_apart

    subroutine contacts_are_no_points()
        !! Of a ball at the top of its bounces: \(h\), \(e^2h\), \(e^4h\), never the floor.
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        real(dp) :: height

        call compute("&scene system='bouncing_ball', method='gauss16', tolerance=1e-11, "// &
                     "duration=9, samples=7, q=0.5, v=3 / &bouncing_ball restitution=0.8 / "// &
                     "&sweep section='y_dot = 0 falling', points=3 /", ["y=0.5:1:2"], ["y"], &
                     result, error, sweep)
        call assertFalse(allocated(error), "it can be computed")
        height = 1.0_dp + 9.0_dp/(2*9.81_dp)
        call assertEqual(height*[1.0_dp, 0.64_dp, 0.64_dp**2], result%values(:, 2), 1e-12_dp, &
                         "from 1 m, upwards with 3 m/s")
    end subroutine contacts_are_no_points

    subroutine all_starts_have_one_energy()
        !! That of the scene's own, by the velocity that is left free; who cannot have it fails.
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        real(dp), parameter :: energy = 0.5_dp*2*9 - 3*9.81_dp
        integer :: i

        call compute(double//"&sweep section='theta1 = 0 rising', points=3, "// &
                     "energy_by='theta1_dot' /", ["theta2_dot=-4:8:4"], &
                     [character(10) :: "energy", "theta1_dot"], result, error, sweep)
        call assertFalse(allocated(error), "it can be computed")
        call assertEqual(1, result%failures, "v2^2 must not be above 36 for v1 to be real")
        call assertTrue(index(result%reason, "theta1_dot") > 0, result%reason)
        do i = 1, 3
            call assertEqual([energy, energy, energy], result%values(::2, i), 1e-8_dp, "the energy")
            call assertTrue(all(result%values(2::2, i) > 0.0_dp), "rising")
        end do
        call assertTrue(all(ieee_is_nan(result%values(:, 4))), "no points of the one that fails")
        call make("&scene system='own', method='rk4', dt=1e-3, duration=1e-3, q=1, 1, "// &
                  "v=1, 2 / &lagrangian coordinates='x', 'y', T='(x_dot^2 + y_dot^2)/2', "// &
                  "V='(x^2 + y^2)/2 - 1e17' / &sweep energy_by='y_dot' /", ["x=0:1:3"], &
                  ["energy"], sweep, error)
        call assertTrue(allocated(error), "one whose rounding is more than all else tells nothing")
        call compute("&scene system='own', method='rk4', dt=1e-6, duration=1e-6, q=0.3, 0.2, "// &
                     "v=0.5, 0.6 / &lagrangian coordinates='x', 'y', L='-sqrt(1 - x_dot^2 - "// &
                     "y_dot^2) - (x^2 + y^2)/10' / &sweep energy_by='y_dot' /", ["x=0:1:3"], &
                     ["energy"], result, error, sweep)
        call assertEqual(0, result%failures, "velocities below that of light")
        call assertEqual(spread(1.0_dp/sqrt(0.39_dp) + 0.013_dp, 1, 3), result%values(1, :), &
                         1e-13_dp, "of no parabola")
    end subroutine all_starts_have_one_energy

    subroutine angles_are_wrapped()
        !! To one turn, with sine and cosine as they were; of a motion that goes round.
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error

        call assertEqual([0.5_dp, -0.5_dp, pi - 1, 1 - pi], &
                         wrapped([0.5_dp, -0.5_dp, 7*pi - 1, 1 - 7*pi]), 1e-14_dp, "wrapped")
        call compute("&scene system='pendulum', method='gauss16', tolerance=1e-9, duration=20, "// &
                     "samples=7, q=0, v=8 / &sweep strobe='0.7', points=20 /", ["v=7:8:2"], &
                     [character(13) :: "theta", "wrapped theta"], result, error, sweep)
        call assertTrue(maxval(result%values(1::2, 2)) > 6*pi, "it goes round")
        call assertEqual(sin(result%values(1::2, 2)), sin(result%values(2::2, 2)), 1e-12_dp, "sine")
        call assertEqual(cos(result%values(1::2, 2)), cos(result%values(2::2, 2)), 1e-12_dp, &
                         "cosine")
        call assertTrue(maxval(abs(result%values(2::2, 2))) <= pi, "within one turn")
    end subroutine angles_are_wrapped

    subroutine attractors_are_the_two_wells()
        !! x = 1 and x = -1, numbered as they come; from the top neither.
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        real(dp) :: expected(101)

        call compute(two_wells//"&wells b=0.3, f=0 / &sweep strobe='1' /", ["x=-2:2:101"], &
                     [character(9) :: "attractor", "x"], result, error, sweep)
        call assertFalse(allocated(error), "it can be computed")
        expected = merge(result%values(1, 1), 3 - result%values(1, 1), &
                         result%values(2, :)*result%values(2, 1) > 0.0_dp)
        expected(51) = 3.0_dp
        call assertEqual(1.0_dp, result%values(1, 1), 0.0_dp, "the first met is number 1")
        call assertEqual(1.0_dp, abs(result%values(2, 1)), 1e-6_dp, "at the bottom of a well")
        call assertEqual(expected, result%values(1, :), 0.0_dp, "by the sign of the end")
        call assertTrue(count(abs(expected - 1) < 0.1_dp) > 30 .and. &
                        count(abs(expected - 2) < 0.1_dp) > 30, "there are many of either")
    end subroutine attractors_are_the_two_wells

    subroutine attractors_have_places()
        !! Angles from -pi to pi, means of several points, and how many motions come to each.
        type(attractors_t) :: attractors
        type(description_t) :: d
        real(dp), parameter :: down(7) = [1.0_dp, 1.0_dp, 2.0_dp, -1e-9_dp, 0.0_dp, 0.0_dp, &
                                          -1.23456_dp]
        real(dp), parameter :: up(7) = [1.0_dp, -1.0_dp, 2.0_dp, -1e-9_dp, 0.0_dp, 0.0_dp, 0.5_dp]
        integer :: i

        allocate (d%coordinates(2))
        d%coordinates%name = ["phi", "x  "]
        d%coordinates%unit = ["rad", "m  "]
        call assertEqual(1.0_dp, attractors%number_of(down), 0.0_dp)
        do i = 1, 9
            call assertEqual(2.0_dp, attractors%number_of(up), 0.0_dp)
            call assertEqual(real(i + 2, dp), attractors%number_of([3.0_dp, up(2:6), i*1.0_dp]), &
                             0.0_dp)
        end do
        call assertEqual(0.0_dp, attractors%number_of(0*up), 0.0_dp)
        call assertEqual("at phi = 0.0, x = 2.0, phi_dot = 0.0, x_dot = -1.235", &
                         attractors%place_of(1, d))
        call assertEqual("at phi = 3.142, x = 2.0, phi_dot = 0.0, x_dot = 0.5", &
                         attractors%place_of(2, d))
        call assertEqual("of 3 points, on average at phi = 3.142, x = 2.0, phi_dot = 0.0, "// &
                         "x_dot = 9.0", attractors%place_of(11, d))
        call assertEqual([1, 1, 9, 1, 1], int(attractors%met(:4)))
    end subroutine attractors_have_places

    subroutine what_has_settled_has_an_attractor()
        !! Driven, lit twice a period: the two points are one attractor. Undamped or chaotic: none.
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        character(*), parameter :: scene = "&scene system='oscillator', method='gauss16', "// &
            "tolerance=1e-10, duration=200, samples=7, q=1 / &oscillator drive_force=1, "

        call compute(scene//"drive_frequency=1.7, b=0.3 / &sweep strobe='pi/drive_frequency' /", &
                     ["x=1:2:5"], ["attractor"], result, error, sweep)
        call assertFalse(allocated(error), "damped and driven")
        call assertEqual([1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp], result%values(1, :), 0.0_dp, &
                         "one attractor of two points")
        call assertEqual(2.0_dp, result%values(2, 1), 0.0_dp, "which repeat after two")
        call compute(scene//"drive_frequency=1.7, b=0 / &sweep strobe='pi/drive_frequency' /", &
                     ["x=1:2:5"], ["attractor"], result, error, sweep)
        call assertEqual(0.0_dp, maxval(abs(result%values(1, :))), 0.0_dp, "undamped")
        call compute(two_wells//"&wells b=0.25, f=0.4 / &sweep strobe='2 pi' /", ["x=0:1:5"], &
                     ["attractor"], result, error, sweep)
        call assertEqual(0.0_dp, maxval(abs(result%values(1, :))), 0.0_dp, "chaos")
    end subroutine what_has_settled_has_an_attractor

    subroutine lanes_keep_the_same_points()
        !! As trajectories alone: points, wrapped angles, attractors; where the start differs only.
        character(*), parameter :: text = "&scene system='driven_pendulum', method='rk4', "// &
            "dt=0.01, t0=0.3, duration=30, q=1 / &driven_pendulum b=1, drive_frequency=7 / "// &
            "&sweep strobe='2 pi/drive_frequency', points=5, after="
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        character(13), parameter :: points(3) = [character(13) :: "wrapped theta", "theta_dot", "t"]
        character(13), parameter :: ends(3) = [character(13) :: "attractor", "theta", &
                                               "wrapped theta"]
        integer :: i

        do i = 1, 3
            if (i == 1) call make(text//"0 /", ["theta=-3:9:19"], points, sweep, error)
            if (i == 2) call make(text//"25 /", ["theta=-3:9:19"], points, sweep, error)
            if (i == 3) call make(text//"0 /", ["theta=-3:9:19"], ends, sweep, error)
            call assertFalse(allocated(error), "the sweep "//to_text(i))
            call assertTrue(fits_lanes(sweep), "it can be computed in lanes: "//to_text(i))
            call compare_lanes(sweep, i)
        end do
        call make(double//"&sweep section='theta1 = 0' /", ["theta2=0:1:3"], ["theta2"], sweep, &
                  error)
        call assertFalse(fits_lanes(sweep), "not a section")
    end subroutine lanes_keep_the_same_points

    subroutine compare_lanes(sweep, which)
        !! All numbers, alone and in lanes.
        type(sweep_t), intent(in) :: sweep
        integer, intent(in) :: which
        real(dp) :: alone(sweep%width()), together(sweep%width(), 19)
        type(error_t), allocatable :: error
        integer(i8) :: failures, first, i

        call compute_lanes(sweep, 1_i8, 19_i8, together, failures, first)
        call assertEqual(0, int(failures), "none fails")
        do i = 1, 19
            call compute_one(sweep, i, alone, error)
            call assertFalse(allocated(error), "one by one")
            call assertFalse(any(ieee_is_nan(alone)), "all points are there")
            call assertEqual(alone, together(:, i), 1e-9_dp, to_text(which)//", trajectory "// &
                             to_text(i))
        end do
        call assertTrue(maxval(abs(together)) > 0.0_dp, "and they are not all 0")
    end subroutine compare_lanes

    subroutine bad_points_are_refused()
        !! With the key to blame.
        character(*), parameter :: bad(4, 15) = reshape([character(70) :: &
            "strobe='1', section='x = 0'", "x", "section", "either", &
            "", "attractor", "keep", "strobe =", &
            "strobe='1/ '", "x", "strobe", "", &
            "strobe='2 pi/nu'", "x", "strobe", "nu", &
            "strobe='0'", "x", "strobe", "above 0", &
            "strobe='-m'", "x", "strobe", "above 0", &
            "strobe='1e-9'", "x", "strobe", "too short", &
            "strobe='51'", "x", "strobe", "no point", &
            "strobe='1'", "period", "keep", "columns are kept", &
            "section='x = 0'", "max x", "keep", "columns are kept", &
            "strobe='1'", "wrapped x", "keep", "only an angle", &
            "strobe='1'", "flip x", "keep", "only an angle", &
            "energy_by='y_dot'", "x", "energy_by", "did you mean 'x_dot'", &
            "energy_by='x'", "x", "energy_by", "x_dot", &
            "energy_by='x_dot'", "t", "", ""], [4, 15])
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, size(bad, 2)
            call compute(oscillator//"&sweep "//trim(bad(1, i))//" /", ["x=0.5:1:3"], [bad(2, i)], &
                         result, error, sweep)
            if (bad(3, i) == "") then
                call assertFalse(allocated(error), "good: "//bad(1, i))
                cycle
            end if
            call assertTrue(allocated(error), "refused: "//trim(bad(1, i))//", "//bad(2, i))
            if (.not. allocated(error)) cycle
            call assertTrue(index(error%message, trim(bad(4, i))) > 0, &
                            trim(bad(1, i))//": "//error%message)
            if (allocated(error%key)) call assertEqual(trim(bad(3, i)), error%key, error%message)
        end do
        call make(oscillator//"&sweep energy_by='x_dot' /", ["x_dot=0:1:3"], ["x"], sweep, error)
        call assertTrue(allocated(error), "an axis cannot be chosen by the energy")
        call make(oscillator//"&sweep energy_by='x_dot' /", ["v=0:1:3"], ["x"], sweep, error)
        call assertTrue(allocated(error), "by no name")
        call make(oscillator//"&sweep points=0 /", ["x=0:1:3"], ["x"], sweep, error)
        call assertTrue(allocated(error), "no points")
        call make(oscillator//"&sweep section='x 0' /", ["x=0:1:3"], ["x"], sweep, error)
        if (.not. allocated(error)) call compute(oscillator//"&sweep section='x 0' /", &
                                                 ["x=0:1:3"], ["x"], result, error, sweep)
        call assertTrue(allocated(error), "no event")
    end subroutine bad_points_are_refused

    subroutine a_row_is_a_point()
        !! In the file, those that are there; the picture is a diagram or a section.
        type(sweep_numbers_t) :: result
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        character(:), allocatable :: path, text
        integer :: i

        path = new_folder("sweep_points")//"/points.dat"
        call compute(oscillator//"&sweep strobe='3', points=6, after=39 /", ["x=1:2:2"], ["t"], &
                     result, error, sweep)
        call write_sweep(sweep, result%of, path, "text", ["a line"], error)
        call assertFalse(allocated(error), "written")
        call read_whole_file(path, text, error)
        call assertTrue(index(text, "failed: 0, points: 8 ") > 0, "the counts")
        text = text(index(text, "# x[m] t[s]"):)
        call assertEqual(9, count([(text(i:i) == line, i=1, len(text))]), "eight rows")
        call read_whole_file(path(:len(path) - 3)//"gp", text, error)
        call assertTrue(index(text, "using 1:2 with points") > 0, "a diagram")
        call compute(oscillator//"&sweep strobe='3', points=6 /", ["x=1:2:2"], &
                     [character(5) :: "x", "x_dot"], result, error, sweep)
        call write_sweep(sweep, result%of, path, "text", ["a line"], error)
        call read_whole_file(path(:len(path) - 3)//"gp", text, error)
        call assertTrue(index(text, "using 2:3:1 with points") > 0, "a section")
        call compute(oscillator//"&oscillator b=1 / &sweep strobe='3' /", ["x=1:2:2", "v=0:1:2"], &
                     ["attractor"], result, error, sweep)
        call write_sweep(sweep, result%of, path, "text", ["a line"], error)
        call read_whole_file(path(:len(path) - 3)//"gp", text, error)
        call assertTrue(index(text, "set palette maxcolors 2 defined (1 '#fde725', 2 "// &
                              "'#fde725')") > 0, "one colour")
        call assertTrue(index(text, 'unset cbtics; set label "1 at x = 0.0, ') > 0, "what it is")
        call assertTrue(index(text, " = 0.0"" at graph 1.13,0.5 center rotate by 90") > 0, "where")
    end subroutine a_row_is_a_point
end module test_sweep_points
