module test_second_opinion
    !! Where three runs of one method agree and are wrong: none of their digits is stated.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertGreaterThan, &
                     assertLessThanOrEqual
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_observer, only: observer_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_play, only: play
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_statement, only: stated_t, statement_line
    use lagrangia_system, only: system_t
    use stated_text, only: read_concise
    implicit none (type, external)
    private
    public :: second_opinion_suite

contains

    function second_opinion_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("second_opinion")
        call suite%addTest(TestMethod("three_hundred_bounces", three_hundred_bounces))
        call suite%addTest(TestMethod("lingering_at_a_saddle", lingering_at_a_saddle))
        call suite%addTest(TestMethod("steps_too_small_to_move", steps_too_small_to_move))
        call suite%addTest(TestMethod("a_late_clock", a_late_clock))
        call suite%addTest(TestMethod("the_time_of_a_slow_event", the_time_of_a_slow_event))
    end function second_opinion_suite

    subroutine perform(text, outcome)
        !! The scene in `text`, from beginning to end, with its error.
        character(*), intent(in) :: text
        type(outcome_t), intent(out) :: outcome
        class(system_t), allocatable :: system
        class(observer_t), pointer :: nobody
        type(scene_t) :: scene
        type(error_t), allocatable :: error

        nobody => null()
        allocate (outcome%state(0))
        call parse_scene("&scene error_estimate = .true., columns = 't', "//text, "a.nml", &
                         [word_t ::], scene, system, error)
        call assertFalse(allocated(error), "it is read: "//text)
        if (.not. allocated(error)) call play(scene, system, "", "text", nobody, outcome, error)
        call assertFalse(allocated(error), "it runs: "//text)
    end subroutine perform

    subroutine check_claim(stated, truth)
        !! What is printed has the truth in it.
        type(stated_t), intent(in) :: stated
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
            call assertFalse(any(outcome%state%resolved()), statement_line(outcome%state))
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
    end subroutine a_late_clock

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
end module test_second_opinion
