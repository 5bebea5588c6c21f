module test_solve
    !! The library's one call: the motion at given times, by every way of stepping.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia, only: dp, error_t, new_system, recorder_t, solve, system_t
    implicit none (type, external)
    private
    public :: solve_suite

    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    function solve_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("solve")
        call suite%addTest(TestMethod("every_way_gives_the_circle", every_way_gives_the_circle))
        call suite%addTest(TestMethod("two_coordinates_keep_apart", two_coordinates_keep_apart))
        call suite%addTest(TestMethod("events_are_found", events_are_found))
        call suite%addTest(TestMethod("a_ball_bounces", a_ball_bounces))
        call suite%addTest(TestMethod("constraints_hold_at_the_start", &
                                      constraints_hold_at_the_start))
        call suite%addTest(TestMethod("refusals", refusals))
        call suite%addTest(TestMethod("no_events_are_none", no_events_are_none))
    end function solve_suite

    subroutine oscillator(system)
        !! m = k = 1, so that x = sin(t) from x = 0, x_dot = 1.
        class(system_t), allocatable, intent(out) :: system
        type(error_t), allocatable :: error

        call new_system("oscillator", system, error)
        call system%configure([1.0_dp, 1.0_dp], error)
    end subroutine oscillator

    subroutine every_way_gives_the_circle()
        !! Fixed steps, steps by tolerance, the closed form; times at unequal distances, one of them
        !! 10^-3 of the step behind another. The bounds: the error of a method of order p is at most
        !! dt^p t/10 here, gauss16 and dop853 stay within a hundred tolerances.
        real(dp), parameter :: t(6) = [0.5_dp, 0.50001_dp, 0.7_dp, 2.0_dp, 5.5_dp, 6.0_dp]
        class(system_t), allocatable :: system

        call oscillator(system)
        call within("rk4", 1e-7_dp, dt=0.01_dp)
        call within("verlet", 1e-4_dp, dt=0.01_dp)
        call within("gauss16", 1e-13_dp, dt=0.1_dp)
        call within("dop853", 1e-8_dp, tolerance=1e-10_dp)
        call within("gauss16", 1e-10_dp, tolerance=1e-12_dp)
        call within("gauss16", 1e-8_dp)
        call within("auto", 1e-14_dp)
        call within("auto", 1e-14_dp, dt=0.1_dp)
    contains
        subroutine within(method, bound, dt, tolerance)
            character(*), intent(in) :: method
            real(dp), intent(in) :: bound
            real(dp), intent(in), optional :: dt, tolerance
            real(dp), allocatable :: q(:, :), v(:, :)
            type(error_t), allocatable :: error

            call solve(system, method, t, [sin(t(1))], [cos(t(1))], q, v, error, dt, tolerance)
            if (allocated(error)) call assertEqual("", error%message, method)
            if (anyExceptions()) return
            call assertEqual([1, 6], shape(q), method)
            call assertEqual([1, 6], shape(v), method)
            call assertEqual(sin(t), q(1, :), bound, method//": x")
            call assertEqual(cos(t), v(1, :), bound, method//": x_dot")
        end subroutine within
    end subroutine every_way_gives_the_circle

    subroutine two_coordinates_keep_apart()
        !! Hundred samples, more than the recorder has room for at first: cart and bob against their
        !! conserved momentum (m1 + m2) x_dot + m2 l theta_dot cos(theta) = 0.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:, :), v(:, :)
        real(dp) :: t(100)
        integer :: i

        call new_system("cart_pendulum", system, error)
        call system%configure([2.0_dp, 1.0_dp, 1.0_dp, 9.81_dp], error)
        t = [(0.1_dp*i, i=0, 99)]
        call solve(system, "gauss16", t, [0.0_dp, 1.0_dp], [0.0_dp, 0.0_dp], q, v, error, &
                   tolerance=1e-13_dp)
        call assertFalse(allocated(error), "no error")
        call assertEqual(100, size(q, 2))
        call assertTrue(maxval(abs(3.0_dp*v(1, :) + v(2, :)*cos(q(2, :)))) < 1e-11_dp, "p_x")
        call assertTrue(maxval(abs(v(1, :))) > 0.5_dp, "the cart moves")
    end subroutine two_coordinates_keep_apart

    subroutine events_are_found()
        !! x = sin(t) rises through 1/2 at pi/6 + 2 pi n, with both kinds of steps; an event that
        !! stops ends the samples.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(recorder_t) :: found
        real(dp), allocatable :: q(:, :), v(:, :)
        real(dp), parameter :: t(3) = [0.0_dp, 1.0_dp, 7.0_dp]

        call oscillator(system)
        call solve(system, "gauss16", t, [0.0_dp], [1.0_dp], q, v, error, tolerance=1e-12_dp, &
                   events=["x = 0.5 rising"], found=found)
        call assertFalse(allocated(error), "by tolerance")
        call assertEqual(2, found%events, "number")
        call assertEqual([pi/6, pi/6 + 2*pi], found%event_t(:2), 1e-11_dp, "times")
        call assertEqual([0.5_dp, 0.5_dp], found%event_q(1, :2), 1e-14_dp, "x")
        call solve(system, "verlet", t, [0.0_dp], [1.0_dp], q, v, error, dt=0.001_dp, &
                   events=["x = 0.5 rising"], found=found)
        call assertFalse(allocated(error), "by equal steps")
        call assertEqual([pi/6, pi/6 + 2*pi], found%event_t(:2), 1e-6_dp, "times")
        call assertEqual(sin(t), q(1, :), 1e-6_dp, "samples")
        call solve(system, "dop853", t, [0.0_dp], [1.0_dp], q, v, error, &
                   events=["x falling stop"], found=found)
        call assertEqual([1, 3], shape(q), "two samples, and the event")
        call assertEqual(0.0_dp, q(1, 3), 1e-14_dp, "it stopped there")
    end subroutine events_are_found

    subroutine a_ball_bounces()
        !! Dropped from 1/2 m it is back on its height after every 2 sqrt(2 h/g), by steps of
        !! dt as by tolerance.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(recorder_t) :: found
        real(dp), allocatable :: q(:, :), v(:, :)
        character(7), parameter :: methods(3) = ["rk4    ", "gauss16", "verlet "]
        real(dp) :: period
        integer :: i

        call new_system("bouncing_ball", system, error)
        call system%configure([1.0_dp, 9.81_dp, 1.0_dp], error)
        period = 2.0_dp*sqrt(1.0_dp/9.81_dp)
        call solve(system, "gauss16", [0.0_dp, period, 2.0_dp*period], [0.5_dp], [0.0_dp], q, v, &
                   error, found=found)
        call assertFalse(allocated(error), "no error")
        call assertEqual(spread(0.5_dp, 1, 3), q(1, :), 1e-12_dp, "height")
        call assertEqual(2, found%events, "bounces")
        do i = 1, size(methods)
            call solve(system, trim(methods(i)), [0.0_dp, period, 2.0_dp*period], [0.5_dp], &
                       [0.0_dp], q, v, error, dt=0.01_dp, found=found)
            if (allocated(error)) call assertEqual("", error%message, methods(i))
            if (anyExceptions()) return
            call assertEqual(spread(0.5_dp, 1, 3), q(1, :), 1e-12_dp, methods(i)//": height")
            call assertEqual(2, found%events, methods(i)//": bounces")
        end do
    end subroutine a_ball_bounces

    subroutine constraints_hold_at_the_start()
        !! A disk that rolls straight ahead, its velocities completed; one that slips is refused.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:, :), v(:, :)
        real(dp), parameter :: q0(4) = [0.0_dp, 0.0_dp, 0.0_dp, 0.7_dp]
        real(dp) :: state(4, 2)

        call new_system("rolling_disk", system, error)
        call system%configure([1.0_dp, 0.3_dp, 0.045_dp, 0.0225_dp, 9.81_dp, 0.0_dp], error)
        call solve(system, "rk4", [0.0_dp, 1.0_dp], q0, [2.0_dp, 0.0_dp], q, v, error, dt=0.01_dp)
        call assertFalse(allocated(error), message="phi_dot and theta_dot are enough")
        if (allocated(error)) return
        call assertEqual(0.6_dp*[sin(0.7_dp), -cos(0.7_dp)], q(:2, 2), 1e-13_dp, "it rolls")
        state = reshape([q(:, 2), v(:, 2)], [4, 2])
        call solve(system, "rk4", [1.0_dp, 2.0_dp], state(:, 1), state(:, 2), q, v, error, &
                   dt=0.01_dp)
        call assertFalse(allocated(error), message="the end is a start")
        call solve(system, "rk4", [0.0_dp, 1.0_dp], q0, [1.0_dp, 0.0_dp, 2.0_dp, 0.0_dp], q, v, &
                   error, dt=0.01_dp)
        call assertTrue(allocated(error), message="it slips")
        if (allocated(error)) call assertEqual(1, index(error%message, "v does not roll"), &
                                               message=error%message)
        call solve(system, "rk4", [0.0_dp, 1.0_dp], q0, [1.0_dp], q, v, error, dt=0.01_dp)
        call assertTrue(allocated(error), message="one velocity of four")
    end subroutine constraints_hold_at_the_start

    subroutine refusals()
        !! Each names what is wrong.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:, :), v(:, :)
        real(dp), parameter :: q0 = 0.0_dp, zero(1) = q0, t(2) = [0.0_dp, 1.0_dp]

        call oscillator(system)
        call solve(system, "rk4", [0.0_dp], zero, zero, q, v, error, dt=0.1_dp)
        call refused("t needs two times at least")
        call solve(system, "rk4", [0.0_dp, 0.0_dp], zero, zero, q, v, error, dt=0.1_dp)
        call refused("each time must be later than the one before")
        call solve(system, "gauss16", [0.0_dp, ieee_value(q0, ieee_quiet_nan), 2.0_dp], zero, &
                   zero, q, v, error)
        call refused("each time must be later than the one before")
        call solve(system, "rk4", t, zero, zero, q, v, error)
        call refused("the method 'rk4' needs dt")
        call solve(system, "rk4", t, zero, zero, q, v, error, tolerance=1e-9_dp)
        call refused("the method 'rk4' needs dt")
        call solve(system, "gauss16", t, zero, zero, q, v, error, 0.1_dp, 1e-9_dp)
        call refused("give dt or tolerance, not both")
        call solve(system, "rk4", t, zero, zero, q, v, error, dt=-0.1_dp)
        call refused("must be positive and finite, not -0.1")
        call solve(system, "gauss16", t, zero, zero, q, v, error, tolerance=0.0_dp)
        call refused("must be positive, not 0.0")
        call solve(system, "rk5", t, zero, zero, q, v, error, dt=0.1_dp)
        call refused("unknown method 'rk5'; did you mean 'rk4'?")
        call solve(system, "rk4", t, [0.0_dp, 0.0_dp], zero, q, v, error, dt=0.1_dp)
        call refused("q has 2 values; the system has 1 coordinate")
        call solve(system, "gauss16", t, zero, zero, q, v, error, events=["y rising"])
        call assertTrue(allocated(error), "no column y")
    contains
        subroutine refused(message)
            character(*), intent(in) :: message

            call assertTrue(allocated(error), message)
            if (.not. allocated(error)) return
            call assertEqual(message, error%message)
            call assertFalse(allocated(q), "nothing is given")
        end subroutine refused
    end subroutine refusals

    subroutine no_events_are_none()
        !! An empty list of events is as good as none.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:, :), v(:, :)

        call oscillator(system)
        call solve(system, "gauss16", [0.0_dp, 1.0_dp], [0.0_dp], [1.0_dp], q, v, error, &
                   events=[character(9) ::])
        call assertFalse(allocated(error), "accepted")
        if (.not. allocated(error)) call assertEqual(sin(1.0_dp), q(1, 2), 1e-8_dp, "x")
    end subroutine no_events_are_none
end module test_solve
