module test_cross_check
    !! Where three runs of one method agree and are wrong: none of their digits is stated.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertGreaterThan, &
                     assertLessThan, assertLessThanOrEqual, assertTrue
    use lagrangia_command_line, only: word_t
    use lagrangia_cross_check, only: new_other_method
    use lagrangia_dop853, only: dop853_t
    use lagrangia_errors, only: error_t
    use lagrangia_final_values, only: final_value_t, final_values_line
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp
    use lagrangia_outcome, only: from_closed_form, from_half_step, outcome_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scorecard, only: scorecard_legend
    use lagrangia_system, only: system_t
    use lagrangia_tolerance_floor, only: sensible_tolerance
    use scene_runs, only: plan_and_run, read_and_plan
    use stated_text, only: read_concise
    implicit none (type, external)
    private
    public :: cross_check_suite

contains

    function cross_check_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("cross_check")
        call suite%addTest(TestMethod("three_hundred_bounces", three_hundred_bounces))
        call suite%addTest(TestMethod("lingering_at_a_saddle", lingering_at_a_saddle))
        call suite%addTest(TestMethod("steps_too_small_to_move", steps_too_small_to_move))
        call suite%addTest(TestMethod("a_late_clock", a_late_clock))
        call suite%addTest(TestMethod("thin_walls", thin_walls))
        call suite%addTest(TestMethod("small_motions_far_from_0", small_motions_far_from_0))
        call suite%addTest(TestMethod("a_jump_of_the_potential", a_jump_of_the_potential))
        call suite%addTest(TestMethod("the_time_of_a_slow_event", the_time_of_a_slow_event))
        call suite%addTest(TestMethod("no_tolerance_below_the_noise", no_tolerance_below_the_noise))
        call suite%addTest(TestMethod("the_tolerance_that_is_named", the_tolerance_that_is_named))
        call suite%addTest(TestMethod("the_fastest_coordinate_counts", &
                                      the_fastest_coordinate_counts))
        call suite%addTest(TestMethod("an_estimate_has_the_rounding_in_it", &
                                      an_estimate_has_the_rounding_in_it))
        call suite%addTest(TestMethod("an_error_is_of_coordinates", an_error_is_of_coordinates))
        call suite%addTest(TestMethod("the_other_method_is_another", the_other_method_is_another))
    end function cross_check_suite

    subroutine perform(text, outcome, plain)
        !! The scene in `text`, from beginning to end, with its error, if it is not to be `plain`.
        character(*), intent(in) :: text
        type(outcome_t), intent(out) :: outcome
        logical, intent(in), optional :: plain
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error

        allocate (outcome%state(0))
        call read_and_plan("&scene error_estimate = .true., columns = 't', "//text, "a.nml", &
                         [word_t ::], scene, system, error)
        call assertFalse(allocated(error), "it is read: "//text)
        if (present(plain)) scene%error_estimate = .not. plain
        if (.not. allocated(error)) call plan_and_run(scene, system, outcome, error)
        call assertFalse(allocated(error), "it runs: "//text)
    end subroutine perform

    subroutine check_claim(stated, truth)
        !! What is printed has the truth in it.
        type(final_value_t), intent(in) :: stated
        real(dp), intent(in) :: truth
        real(dp) :: centre, bracket

        if (.not. stated%resolved()) return
        call read_concise(stated%text(), centre, bracket)
        call assertLessThanOrEqual(abs(centre - truth), bracket, message=stated%text())
    end subroutine check_claim

    subroutine three_hundred_bounces()
        !! Flights of 1 s without loss, and a quarter of one; and flights of any time.
        type(outcome_t) :: outcome

        call perform("system = 'bouncing_ball', method = 'gauss16', tolerance = 1e-3, q = 0.0, "// &
                     "v = 1.7, duration = 1000.25 / &bouncing_ball g = 3.4, restitution = 1.0 /", &
                     outcome)
        call check_claim(outcome%state(1), 0.31875_dp)
        call check_claim(outcome%state(2), 0.85_dp)
        call assertLessThanOrEqual(maxval(outcome%state%error), 1e-8_dp, message="digits are left")
        ! the truth by .ci/quad
        call perform("system = 'bouncing_ball', method = 'gauss16', samples = 5, "// &
                     "tolerance = 1.0461699594469903e-13, t0 = 0.17332695013532717, "// &
                     "q = 1.3982519788659422, v = 1.0212718378851529, "// &
                     "duration = 311.0354842622459 / &bouncing_ball restitution = 1.0, "// &
                     "g = 1.708639195984527 /", outcome)
        call check_claim(outcome%state(1), 1.66296741722470880_dp)
        call check_claim(outcome%state(2), 0.372007821602300207_dp)
        call perform("system = 'bouncing_ball', t0 = 2.5146692146149787, "// &
                     "duration = 11.629592102413325, method = 'gauss16', samples = 10, "// &
                     "tolerance = 2.4071492327272268e-8, q = 0.11719041555989085, "// &
                     "v = -1.101450508507644 / &bouncing_ball m = 2.9276588150894547, "// &
                     "g = 3.6905089876104653, restitution = 1.0 /", outcome)
        call check_claim(outcome%state(2), -7.72905698161148291e-1_dp)
        call perform("system = 'bouncing_ball', t0 = -0.43681458311007115, "// &
                     "duration = 77.92952763058256, method = 'gauss16', samples = 8, "// &
                     "tolerance = 1.4518517110012462e-14, q = 1.1720895674881011, "// &
                     "v = 2.064487781871337 / &bouncing_ball m = 3.4819116782778465, "// &
                     "g = 3.849798671831283, restitution = 0.9927712321664176 /", outcome)
        call check_claim(outcome%state(2), -2.45030292537334670_dp)
    end subroutine three_hundred_bounces

    subroutine lingering_at_a_saddle()
        !! From the double next to pi the pendulum falls within 38 s, and rounding says to which
        !! side. With the speed that leads to the top and not beyond theta is 2 arctan(sinh(t)).
        character(*), parameter :: system = " / &pendulum l = 1.0, g = 1.0 /"
        character(8), parameter :: methods(3) = [character(8) :: "rk4", "gauss16", "midpoint"]
        character(2), parameter :: ends(4) = ["10", "30", "38", "60"]
        real(dp), parameter :: t(4) = [10.0_dp, 30.0_dp, 38.0_dp, 60.0_dp]
        real(dp), parameter :: pi = acos(-1.0_dp), below = 1.2246467991473532e-16_dp
        type(outcome_t) :: outcome
        integer :: i, k

        do i = 1, size(methods)
            call perform("system = 'pendulum', dt = 0.01, method = '"//trim(methods(i))// &
                         "', q = 3.141592653589793, duration = 38.0"//system, outcome)
            call assertFalse(any(outcome%state%resolved()), final_values_line(outcome%state))
            do k = 1, 2  ! the double is 1.2e-16 below pi, which grows by cosh(t)
                call perform("system = 'pendulum', dt = 0.01, method = '"//trim(methods(i))// &
                             "', q = 3.141592653589793, duration = "//ends(k)//system, outcome)
                call check_claim(outcome%state(1), pi - below*cosh(t(k)))
                call check_claim(outcome%state(2), -below*sinh(t(k)))
            end do
            do k = 1, size(ends)
                call perform("system = 'pendulum', dt = 0.01, method = '"//trim(methods(i))// &
                             "', q = 0.0, v = 2.0, duration = "//ends(k)//system, outcome)
                call check_claim(outcome%state(1), 2.0_dp*atan(sinh(t(k))))
                call check_claim(outcome%state(2), 2.0_dp/cosh(t(k)))
            end do
        end do
    end subroutine lingering_at_a_saddle

    subroutine steps_too_small_to_move()
        !! Without gravity the angle grows by 5e-3 rad in 1 s; each step of 1e-4 s adds less than
        !! half of the last digit of 1e10 rad, and is lost.
        character(16), parameter :: methods(3) = [character(16) :: "rk4", "velocity_verlet", &
                                                  "gauss16"]
        type(outcome_t) :: outcome
        integer :: i

        do i = 1, size(methods)
            call perform("system = 'pendulum', method = '"//trim(methods(i))//"', q = 1e10, "// &
                         "v = 0.005, dt = 1e-4, duration = 1.0, every = 1000 "// &
                         "/ &pendulum g = 0.0 /", outcome)
            call check_claim(outcome%state(1), 1e10_dp + 0.005_dp)
            call check_claim(outcome%state(2), 0.005_dp)
        end do
    end subroutine steps_too_small_to_move

    subroutine a_late_clock()
        !! At t0 = 2**30 s steps end where the clock can: that is 2**-23 s off at the most, in which
        !! the velocity 1 moves the mass by as much. The oscillator's truth is a sine.
        character(8), parameter :: methods(2) = [character(8) :: "dop853", "gauss16"]
        type(outcome_t) :: outcome
        integer :: i

        do i = 1, size(methods)
            call perform("system = 'oscillator', method = '"//trim(methods(i))// &
                         "', tolerance = 1e-12, t0 = 1073741824.0, q = 0.0, v = 1.0, "// &
                         "samples = 3, duration = 1.1 / &oscillator m = 1.0, k = 1.0 /", outcome)
            call check_claim(outcome%state(1), sin(1.1_dp))
            call check_claim(outcome%state(2), cos(1.1_dp))
            call assertLessThanOrEqual(maxval(outcome%state%error), 2.0_dp**(-21), &
                                       message="digits are left")
        end do
        ! the truth by .ci/quad
        call perform("system = 'driven_pendulum', t0 = 56689647.25105157, "// &
                     "duration = 0.965591241589557, method = 'gauss16', samples = 10, "// &
                     "tolerance = 1.5682375972118345e-4, q = -1.140290624527396, "// &
                     "v = 1.0312634380679873 / &driven_pendulum m = 1.63314013138094, "// &
                     "l = 3.8040808500741057, g = 1.267976968208317, "// &
                     "amplitude = -0.9466074867856724, drive_frequency = 0.26915778977291555 /", &
                     outcome)
        call check_claim(outcome%state(1), -4.15880072792298750e-2_dp)
    end subroutine a_late_clock

    subroutine small_motions_far_from_0()
        !! A pendulum that swings by \(3\cdot10^{-7}\) about \(2\pi\) for 12 s. What is not known
        !! of its speed is a share of the swing, not of \(2\pi\).
        type(outcome_t) :: outcome
        real(dp), parameter :: turn = 2*acos(-1.0_dp), q = 6.283185_dp

        call perform("system = 'pendulum', method = 'gauss16', tolerance = 1e-12, v = 0.0, "// &
                     "q = 6.283185, duration = 12 / &pendulum l = 1.0, g = 1.0 /", outcome)
        call check_claim(outcome%state(1), turn + (q - turn)*cos(12.0_dp))
        call check_claim(outcome%state(2), (turn - q)*sin(12.0_dp))
        call assertLessThan(outcome%state(1)%error, 1e-10_dp, message="ten digits of the angle")
    end subroutine small_motions_far_from_0

    subroutine thin_walls()
        !! Three runs by steps of `dt` go through a wall that is thinner than these. The other
        !! method takes too long for its least tolerance there, but a larger one shows it. The
        !! truths by a program for quadruple precision.
        type(outcome_t) :: outcome

        call fly("method='midpoint', dt=0.04683825712897181, every=10, t0=0.0, "// &
                 "duration=4.683825712897181, q=-0.665290822223365, "// &
                 "v=1.1912365131686262 / &wall k=2.1515563376144367, "// &
                 "c=3.4189866896483863, w=1.5331585170051832e-05 /", outcome)
        call check_claim(outcome%state(1), 1.92370534378386871_dp)
        call check_claim(outcome%state(2), -1.19123651316862623_dp)
        call fly("method='gauss16', dt=0.0630500219450674, every=100, t0=0.0, "// &
                 "duration=6.30500219450674, q=-0.8414250528170298, "// &
                 "v=2.078562630819623 / &wall k=1.2737874430963456, "// &
                 "c=4.763013816707627, w=1.4296489442301077e-05 /", outcome)
        call check_claim(outcome%state(1), 12.2639053310792229_dp)
        call fly("method='gauss16', tolerance=1.19e-06, samples=10, "// &
                 "t0=737.1132609808698, duration=5.240407297748967, "// &
                 "q=-0.5676824657977552, v=1.0868784147027635 / &wall k=0.3160324404212109, "// &
                 "c=5.606184982205924, w=0.0002628477226321737 /", outcome)
        call check_claim(outcome%state(1), 5.12800311037643477_dp)
    contains
        subroutine fly(numbers, outcome)
            !! Towards the wall at x = c.
            character(*), intent(in) :: numbers  !! of the scene, and of the wall
            type(outcome_t), intent(out) :: outcome
            integer :: i

            i = index(numbers, " / ")
            call perform("system = 'wall', "//numbers(:i)//"/ &lagrangian coordinates = 'x', "// &
                         "parameters = 'k', 'c', 'w', T = 'x_dot^2/2', "// &
                         "V = 'k exp(-((x - c)/w)^2)'"//numbers(i:), outcome)
        end subroutine fly
    end subroutine thin_walls

    subroutine a_jump_of_the_potential()
        !! No method feels it: that the energy is another behind it says that no digit is right. A
        !! jump of a millionth of the energy is within what that bears, and so is one not reached.
        type(outcome_t) :: outcome
        character(*), parameter :: jump = "system = 'jump', method = 'rk4', dt = 0.1, q = 0.0, "// &
            "v = 2.0, duration = 3.0 / &lagrangian coordinates = 'x' T = 'x_dot^2/2' V = '"

        call perform(jump//"0.75 sgn(x - 4)' /", outcome)
        call assertFalse(any(outcome%state%resolved()), "up")
        call perform(jump//"-0.75 sgn(x - 4)' /", outcome)
        call assertFalse(any(outcome%state%resolved()), "down")
        call perform(jump//"1e-6 sgn(x - 4)' /", outcome)
        call assertTrue(all(outcome%state%resolved()), "a small one")
        call perform(jump//"0.75 sgn(x - 7)' /", outcome)
        call assertTrue(all(outcome%state%resolved()), "behind the end")
    end subroutine a_jump_of_the_potential

    subroutine the_time_of_a_slow_event()
        !! From 2**20 rad at 2**-10 rad/s one turns by 2**-10 rad in 1 s: the last digit of the
        !! angle, 2**-32 rad, takes 2**-22 s.
        type(outcome_t) :: outcome

        call perform("system = 'pendulum', method = 'gauss16', tolerance = 1e-10, "// &
                     "q = 1048576.0, v = 0.0009765625, duration = 3.0, "// &
                     "event = 'theta = 1048576.0009765625 stop' / &pendulum g = 0.0 /", outcome)
        call assertEqual(3, size(outcome%state))
        call assertEqual("t", trim(outcome%state(1)%name))
        call check_claim(outcome%state(1), 1.0_dp)
        call assertGreaterThan(outcome%state(1)%error, 2.0_dp**(-22), message="no less")
        call assertLessThanOrEqual(outcome%state(1)%error, 2.0_dp**(-18), message="not too warily")
    end subroutine the_time_of_a_slow_event

    subroutine no_tolerance_below_the_noise()
        !! At 1.4e8 rad the last digit, 3e-8 rad, shakes the accelerations: steps of dop853 would
        !! shrink with the tolerance. The one that is named can be had, by the finer runs too, and
        !! so can a late time of the driven pendulum.
        character(*), parameter :: starts(2) = [character(80) :: &
            "system = 'rotating_hoop', q = -1.4e8, v = 0.3 / &rotating_hoop /", &
            "system = 'driven_pendulum', q = 1.0, v = 0.3, t0 = 1e9 / &driven_pendulum /"]
        character(*), parameter :: method = &
            "method = 'dop853', duration = 3.0, samples = 10, tolerance = "
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        integer :: i, place

        do i = 1, size(starts)
            call read_and_plan("&scene columns = 't', "//method//"4e-11, "//starts(i), "a.nml", &
                             [word_t ::], scene, system, error)
            call assertTrue(allocated(error), "it is refused")
            if (.not. allocated(error)) return
            place = index(error%message, " one is ")
            call assertGreaterThan(place, 0, message=error%message)
            call perform(method//error%message(place + 8:len_trim(error%message))//", "// &
                         starts(i), outcome)
            call assertLessThan(int(outcome%steps), 1000, message="not for ever")
            call assertTrue(outcome%state(1)%resolved(), "digits are left")
        end do
        call perform("system = 'rotating_hoop', q = -1.4e8, v = 0.3, method = 'gauss16', "// &
                     "tolerance = 4e-11, duration = 3.0, samples = 10 / &rotating_hoop /", outcome)
        call assertLessThan(int(outcome%steps), 100, message="gauss16 sees the noise")
        call perform("system = 'oscillator', q = 1e8, v = 0.0, method = 'dop853', "// &
                     "tolerance = 1e-14, duration = 3.0, samples = 10 / &oscillator /", outcome)
        call assertLessThan(int(outcome%steps), 1000, message="relative to what is large")
    end subroutine no_tolerance_below_the_noise

    subroutine the_tolerance_that_is_named()
        !! For a pendulum at \(\theta = 10^8\), whose last digit shakes the acceleration by
        !! \(\epsilon\theta D\), \(D = g/l\,|\cos\theta|\), and the velocity by that over
        !! \(\sqrt D\): what a step bears of it, and up to 1.1 times that, half a second digit. No
        !! more than 0.1, and not less than the method can.
        type(pendulum_t) :: pendulum
        type(dop853_t) :: method
        type(error_t), allocatable :: error
        real(dp), parameter :: theta = 1e8_dp
        real(dp) :: least, noise, slope

        call pendulum%configure([1.0_dp, 50.0_dp, 9.81_dp, 0.0_dp], error)
        call assertFalse(allocated(error), "a pendulum")
        slope = 9.81_dp/50.0_dp*abs(cos(theta))
        noise = epsilon(noise)*theta*sqrt(slope)/method%noise_margin
        call assertLessThan(9.81_dp/50.0_dp/sqrt(slope), 1.0_dp, message="below 1 rad/s")
        least = sensible_tolerance(method, pendulum, 0.0_dp, 1.0_dp, [theta], [0.3_dp])
        call assertGreaterThan(least, noise)
        call assertLessThan(least, 1.1_dp*1.05_dp*noise)
        call assertEqual(noise, sensible_tolerance(method, pendulum, 0.0_dp, 1.0_dp, &
                         [theta], [110.0_dp])*110.0_dp/1.1_dp, 0.05_dp*noise, "beside v")
        call assertEqual(method%least_tolerance, sensible_tolerance(method, pendulum, 0.0_dp, &
                         1.0_dp, [1.0_dp], [0.3_dp]), 0.0_dp, "at least")
        method%noise_margin = 1e-9_dp
        call assertEqual(0.1_dp, sensible_tolerance(method, pendulum, 0.0_dp, 1.0_dp, [theta], &
                         [0.3_dp]), 0.0_dp, "at most")
    end subroutine the_tolerance_that_is_named

    subroutine the_fastest_coordinate_counts()
        !! Of two pendulums: noise is judged beside the larger velocity, whichever coordinate has
        !! it, or beside the larger acceleration, by a constant force on one or the other.
        class(system_t), allocatable :: system
        type(dop853_t) :: method
        type(error_t), allocatable :: error
        type(scene_t) :: scene
        real(dp), parameter :: q(2) = [1e8_dp, 1e8_dp]
        character(16), parameter :: forces(3) = [character(16) :: "0.0, g = 100.0", &
                                                 "100.0, g = 0.0", "100.0, g = 100.0"]
        real(dp) :: floors(3)
        integer :: i

        call make("0.0, g = 0.0")
        if (allocated(error)) return
        floors(1) = sensible_tolerance(method, system, 0.0_dp, 1.0_dp, q, [0.3_dp, 110.0_dp])
        floors(2) = sensible_tolerance(method, system, 0.0_dp, 1.0_dp, q, [110.0_dp, 0.3_dp])
        floors(3) = sensible_tolerance(method, system, 0.0_dp, 1.0_dp, q, [110.0_dp, 110.0_dp])
        call assertGreaterThan(floors(3), method%least_tolerance)
        call assertEqual(floors(3), floors(1), 0.0_dp, "the second one")
        call assertEqual(floors(3), floors(2), 0.0_dp, "the first one")
        do i = 1, 3
            call make(forces(i))
            if (allocated(error)) return
            floors(i) = sensible_tolerance(method, system, 0.0_dp, 1.0_dp, q, [0.3_dp, 0.3_dp])
        end do
        call assertGreaterThan(floors(3), method%least_tolerance)
        call assertEqual(floors(3), floors(1), 0.0_dp, "pushed, the second one")
        call assertEqual(floors(3), floors(2), 0.0_dp, "pushed, the first one")
    contains
        subroutine make(f)
            character(*), intent(in) :: f

            call read_and_plan("&scene system = 'two', dt = 1, duration = 1, q = 0.1, 0.2 / "// &
                               "&lagrangian coordinates = 'a', 'b', parameters = 'k', 'f', "// &
                               "'g', L = '(a_dot^2 + b_dot^2)/2 + k cos(a) + k cos(b) + f a "// &
                               "+ g b' / &two k = 0.2, f = "//f//" /", "s.nml", [word_t ::], &
                               scene, system, error)
            call assertFalse(allocated(error), "two pendulums: f = "//f)
        end subroutine make
    end subroutine the_fastest_coordinate_counts

    subroutine an_estimate_has_the_rounding_in_it()
        !! A hoop at rest is a pendulum, whose motion is known; its own error is an estimate. So
        !! many steps of so high an order that nothing but rounding is left. Half the truth at
        !! least, but for the closed form's own rounding, \(\epsilon\) t times the speed, less than
        !! 3.2 rad/s; and no more than ten of it.
        character(*), parameter :: methods(4) = [character(40) :: &
            "method = 'gauss16', dt = 0.002", "method = 'rk4', dt = 0.0004", &
            "method = 'gauss16', tolerance = 1e-13", "method = 'dop853', tolerance = 1e-13"]
        character(*), parameter :: start = ", q = 1.0, v = 0.0, duration = 40.0, every = 1000"
        real(dp), parameter :: own = epsilon(own)*40.0_dp*3.2_dp
        type(outcome_t) :: hoop, pendulum
        integer :: i

        do i = 1, size(methods)
            call perform_error("system = 'rotating_hoop'", " / &rotating_hoop omega = 0.0 /", hoop)
            call perform_error("system = 'pendulum'", " / &pendulum /", pendulum)
            call assertEqual(from_half_step, hoop%error_from)
            call assertEqual(from_closed_form, pendulum%error_from)
            call assertGreaterThan(hoop%error(), 0.5_dp*pendulum%error() - own, &
                                   message=methods(i))
            call assertLessThan(hoop%error(), 10.0_dp*(pendulum%error() + own), &
                                message=methods(i))
        end do
    contains
        subroutine perform_error(system, parameters, outcome)
            !! With the column that is compared.
            character(*), intent(in) :: system, parameters
            type(outcome_t), intent(out) :: outcome
            character(:), allocatable :: text

            text = start
            if (index(methods(i), "tolerance") > 0) text = start(:index(start, ", every") - 1)
            call perform(system//", expect_error = 1.0, "//trim(methods(i))//text//parameters, &
                         outcome, plain=.true.)
        end subroutine perform_error
    end subroutine an_estimate_has_the_rounding_in_it

    subroutine an_error_is_of_coordinates()
        !! Of the oscillator at 1000 rad/s, whose velocity errs 1000 times as much as x: the legend
        !! says that the error is that of x, and so it is.
        type(outcome_t) :: outcome
        real(dp) :: x, v

        call assertTrue(index(scorecard_legend, "of a coordinate in the rows, not of a velocity") &
                        > 0, scorecard_legend)
        call assertTrue(index(scorecard_legend, "and against another method") > 0, scorecard_legend)
        call perform("system = 'oscillator', method = 'rk4', dt = 1e-4, every = 100, "// &
                     "duration = 0.01, q = 1.0, v = 0.0, expect_error = 1.0 "// &
                     "/ &oscillator m = 1.0, k = 1e6 /", outcome, plain=.true.)
        x = abs(outcome%q(1) - cos(10.0_dp))
        v = abs(outcome%v(1) + 1000.0_dp*sin(10.0_dp))/(1000.0_dp*abs(sin(10.0_dp)))
        call assertEqual(x, outcome%error(), 1e-12_dp, "of x")
        call assertGreaterThan(abs(v - x), 0.1_dp*x, message="which is not that of the velocity")
    end subroutine an_error_is_of_coordinates

    subroutine the_other_method_is_another()
        !! `dop853` for all but a run by it.
        character(8), parameter :: methods(3) = [character(8) :: "dop853", "gauss16", "rk4"]
        class(dense_integrator_t), allocatable :: other
        type(pendulum_t) :: pendulum
        type(error_t), allocatable :: error
        type(scene_t) :: scene
        integer :: i

        call pendulum%configure([1.0_dp, 1.0_dp, 9.81_dp, 0.0_dp], error)
        call assertFalse(allocated(error), "a pendulum")
        scene%duration = 1.0_dp
        scene%q = [1.0_dp]
        scene%v = [0.0_dp]
        do i = 1, size(methods)
            scene%method = methods(i)
            call new_other_method(scene, pendulum, other)
            select type (other)
            type is (dop853_t)
                call assertTrue(i > 1, "dop853 beside "//methods(i))
            class default
                call assertTrue(i == 1, "another beside "//methods(i))
            end select
        end do
    end subroutine the_other_method_is_another
end module test_cross_check
