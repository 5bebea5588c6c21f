module test_events
    !! Events on the dense output, against closed forms.
    use event_runs, only: find
    use funit, only: anyExceptions, assertEqual, assertFalse, assertLessThan, assertTrue, &
                     TestMethod, TestSuite
    use lagrangia_dense_run, only: run_dense
    use lagrangia_errors, only: error_t
    use lagrangia_events, only: column_event_t, contact_event_t, event_box_t, &
                                new_column_event, new_contact_event
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_box_t
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_recorder, only: recorder_t
    use lagrangia_reference, only: reference_t
    use lagrangia_rk4, only: new_rk4, rk4_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_stepwise, only: new_stepwise, stepwise_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    use lagrangia_time_grid, only: new_time_grid, time_grid_t
    implicit none (type, external)
    private
    public :: events_suite

    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    function events_suite() result(suite)
        type(TestSuite) :: suite

        suite = TestSuite("events")
        call suite%addTest(TestMethod("turning points give the period", turning_points))
        call suite%addTest(TestMethod("a direction is kept to", directions))
        call suite%addTest(TestMethod("several events in a step come in order", several))
        call suite%addTest(TestMethod("a level that is passed for a moment is two events", grazes))
        call suite%addTest(TestMethod("a zero at the start is no event", zero_at_start))
        call suite%addTest(TestMethod("a zero just where signs are looked at counts once", &
                                      zero_at_place))
        call suite%addTest(TestMethod("a picture says what its dots are", said_in_a_picture))
        call suite%addTest(TestMethod("no change of sign is no error", no_change))
        call suite%addTest(TestMethod("a terminal event ends the run", terminal))
        call suite%addTest(TestMethod("a string goes slack where it should", slack))
        call suite%addTest(TestMethod("a particle leaves a sphere at cos = 2/3", sphere))
        call suite%addTest(TestMethod("what events are called", what_events_are_called))
    end function events_suite

    subroutine oscillate(texts, x, v0, duration, tolerance, record, ended)
        !! x = cos(t), or sin(t), ...
        character(*), intent(in) :: texts(:)
        real(dp), intent(in) :: x, v0, duration, tolerance
        type(recorder_t), intent(inout) :: record
        real(dp), intent(out) :: ended
        type(oscillator_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)

        call system%configure([1.0_dp, 1.0_dp], error)
        q = x
        v = v0
        call find(system, texts, q, v, duration, tolerance, record, ended)
    end subroutine oscillate

    subroutine turning_points()
        !! Every half period. The run's error grows linearly to some 1e-12 at this tolerance.
        type(pendulum_t) :: system
        class(reference_t), allocatable :: reference
        type(recorder_t) :: record
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), ended
        integer :: i

        call system%configure([0.7_dp, 1.3_dp, 9.81_dp], error)
        q = 2.0_dp
        v = 0.0_dp
        call system%closed_form(0.0_dp, q, v, reference)
        call find(system, ["theta_dot"], q, v, 30.0_dp, 1e-14_dp, record, ended)
        call assertEqual(int(30.0_dp/(0.5_dp*reference%period)), record%events, message="number")
        if (anyExceptions()) return
        do i = 1, record%events
            call assertEqual(0.5_dp*reference%period*i, record%event_t(i), 1e-11_dp, "time")
            call assertEqual(2.0_dp*(-1)**i, record%event_q(1, i), 1e-11_dp, "angle")
        end do
        call assertEqual(reference%period, record%event_t(3) - record%event_t(1), 1e-12_dp, &
                         "period")
    end subroutine turning_points

    subroutine directions()
        !! x = sin(t) passes 1/2 rising at pi/6, falling at 5 pi/6.
        type(recorder_t) :: record
        real(dp) :: ended
        integer :: i

        call oscillate(["x = 0.5 rising"], 0.0_dp, 1.0_dp, 20.0_dp, 1e-13_dp, record, ended)
        call assertEqual(4, record%events, message="rising")
        call assertEqual([(pi/6 + 2*pi*i, i=0, 3)], record%event_t(:4), 1e-11_dp, "rising")
        record%events = 0
        call oscillate(["x=0.5   falling"], 0.0_dp, 1.0_dp, 20.0_dp, 1e-13_dp, record, ended)
        call assertEqual(3, record%events, message="falling")
        call assertEqual([(5*pi/6 + 2*pi*i, i=0, 2)], record%event_t(:3), 1e-11_dp, "falling")
        record%events = 0
        call oscillate(["x = 5e-1"], 0.0_dp, 1.0_dp, 20.0_dp, 1e-13_dp, record, ended)
        call assertEqual(7, record%events, message="any")
        record%events = 0
        call oscillate([character(30) :: "x = sqrt(3) / 2 rising", "x = 1-3/2 falling", &
                        "x=cos(pi/4) falling stop"], 0.0_dp, 1.0_dp, 20.0_dp, 1e-13_dp, record, &
                       ended)
        call assertEqual([pi/3, 3*pi/4], record%event_t(:record%events), 1e-11_dp, "formulas")
        call assertEqual(3*pi/4, ended, 1e-11_dp, "stop behind a formula")
    end subroutine directions

    subroutine several()
        !! Steps at this tolerance take more than an eighth of a turn: four events lie in some.
        type(recorder_t) :: record
        real(dp) :: ended
        character(20), parameter :: texts(4) = [character(20) :: "x = 0.20 falling", &
            "x = 0.25 falling", "x = 0.2", "x_dot = -0.97"]
        real(dp), parameter :: times(4) = [acos(0.20_dp), acos(0.25_dp), acos(0.20_dp), &
                                           asin(0.97_dp)]

        call oscillate(texts, 1.0_dp, 0.0_dp, 1.6_dp, 1e-6_dp, record, ended)
        call assertEqual(4, record%events, message="number")
        if (anyExceptions()) return
        call assertEqual([2, 4, 1, 3], reorder(record%event(:4)), message="order")
        call assertTrue(all(record%event_t(2:4) >= record%event_t(:3)), "times do not fall")
        call assertEqual(times(record%event(:4)), record%event_t(:4), 1e-5_dp, "times")
        call assertLessThan(maxval(abs(record%event_q(1, 3:4) - 0.2_dp)), 1e-14_dp, &
                            message="x = 0.2")
        call assertEqual(0.25_dp, record%event_q(1, 1), 1e-15_dp, "x = 0.25")
        call assertEqual(-0.97_dp, record%event_v(1, 2), 1e-15_dp, "x_dot = -0.97")
    contains
        pure function reorder(which) result(sorted)
            !! Of the two that come together, the first in the list first.
            integer, intent(in) :: which(4)
            integer :: sorted(4)

            sorted = which
            sorted(3:4) = [minval(which(3:4)), maxval(which(3:4))]
        end function reorder
    end subroutine several

    subroutine grazes()
        !! x = sin(t) is above a level a little less than 1 for a small part of a step; at 1 it
        !! only touches.
        type(recorder_t) :: record
        real(dp), parameter :: depths(3) = [1e-3_dp, 1e-5_dp, 1e-7_dp]
        real(dp) :: ended, top
        character(24) :: level
        integer :: i, k

        do k = 1, size(depths)
            write (level, "(ss, a, f12.10)") "x = ", 1.0_dp - depths(k)
            top = acos(1.0_dp - depths(k))
            record%events = 0
            call oscillate([level], 0.0_dp, 1.0_dp, 20.0_dp, 1e-13_dp, record, ended)
            call assertEqual(6, record%events, message="both ways: "//level)
            if (anyExceptions()) return
            call assertEqual([(0.5_dp*pi + 2*pi*i - top, 0.5_dp*pi + 2*pi*i + top, &
                               i=0, 2)], record%event_t(:6), 1e-11_dp/top, "times")
            record%events = 0
            call oscillate([trim(level)//" rising"], 0.0_dp, 1.0_dp, 20.0_dp, 1e-13_dp, record, &
                           ended)
            call assertEqual(3, record%events, message="rising")
            call assertEqual(0.5_dp*pi - top, record%event_t(1), 1e-11_dp/top, "the first")
            record%events = 0
            call oscillate([trim(level)//" falling stop"], 0.0_dp, 1.0_dp, 20.0_dp, 1e-13_dp, &
                           record, ended)
            call assertEqual(1, record%events, message="falling, which ends it")
            call assertEqual(0.5_dp*pi + top, ended, 1e-11_dp/top, "the end")
        end do
        record%events = 0
        call oscillate(["x = 1"], 0.0_dp, 1.0_dp, 20.0_dp, 1e-13_dp, record, ended)
        call assertEqual(0, record%events, message="it touches")
    end subroutine grazes

    subroutine zero_at_start()
        type(recorder_t) :: record
        real(dp) :: ended

        call oscillate(["x = 0"], 0.0_dp, 1.0_dp, 7.0_dp, 1e-13_dp, record, ended)
        call assertEqual(2, record%events, message="number")
        call assertEqual([pi, 2*pi], record%event_t(:2), 1e-12_dp, "times")
        record%events = 0
        call oscillate(["x_dot"], 1.0_dp, 0.0_dp, 7.0_dp, 1e-13_dp, record, ended)
        call assertEqual([pi, 2*pi], record%event_t(:2), 1e-12_dp, "turning points")
    end subroutine zero_at_start

    subroutine zero_at_place()
        !! Without gravity, with steps of 1: theta = t - 1/2 is zero at the fourth of the eight
        !! places in a step, theta = t - 1 where two steps meet.
        type(pendulum_t) :: system
        type(rk4_t) :: rk4
        type(stepwise_t) :: method
        type(recorder_t), target :: record
        type(column_event_t) :: event
        type(event_box_t) :: events(2)
        type(observer_box_t) :: observers(1)
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), ended

        call system%configure([1.0_dp, 1.0_dp, 0.0_dp], error)
        call new_column_event(event, "theta = 0.5", system, error)
        allocate (events(1)%item, source=event)
        call new_column_event(event, "theta = 1", system, error)
        allocate (events(2)%item, source=event)
        observers(1)%item => record
        call new_rk4(rk4)
        call new_stepwise(method, rk4, 1.0_dp)
        call new_time_grid(plan, 0.0_dp, 1.0_dp, 3.0_dp, 1_i8, error)
        q = 0.0_dp
        v = 1.0_dp
        call run_dense(system, method, plan, events, observers, q, v, ended, error)
        call assertEqual(2, record%events, message="number")
        call assertEqual([0.5_dp, 1.0_dp], record%event_t(:2), epsilon(1.0_dp), "times")
    end subroutine zero_at_place

    subroutine said_in_a_picture()
        !! The level is 0 where none is said; `stop` is nothing to see.
        call said("theta = 0.5 rising", "where theta = 0.5, rising")
        call said("theta stop falling", "where theta = 0, falling")
        call said("theta=-1", "where theta = -1")
    end subroutine said_in_a_picture

    subroutine said(text, expected)
        !! Assert what an event says of itself.
        character(*), intent(in) :: text, expected
        type(pendulum_t) :: system
        type(column_event_t) :: event
        type(error_t), allocatable :: error

        call system%configure([1.0_dp, 1.0_dp, 0.0_dp], error)
        call new_column_event(event, text, system, error)
        call assertTrue(.not. allocated(error), text)
        call assertEqual(expected, trim(event%place))
    end subroutine said

    subroutine no_change()
        type(recorder_t) :: record
        real(dp) :: ended

        call oscillate(["x = 1.001"], 0.0_dp, 1.0_dp, 20.0_dp, 1e-10_dp, record, ended)
        call assertEqual(0, record%events, message="none")
        call assertEqual(20.0_dp, ended, message="the run goes to its end")
    end subroutine no_change

    subroutine terminal()
        type(recorder_t) :: record
        real(dp) :: ended

        call oscillate(["x = -0.5 stop"], 1.0_dp, 0.0_dp, 20.0_dp, 1e-13_dp, record, ended)
        call assertEqual(1, record%events, message="one")
        call assertEqual(2*pi/3, ended, 1e-12_dp, "end")
        call assertEqual(3, record%samples, message="0, 2, and the event")
        call assertEqual(ended, record%t(3), message="the last sample")
        call assertEqual(-0.5_dp, record%q(1, 3), 1e-15_dp, "its state")
    end subroutine terminal

    subroutine slack()
        !! Thrown at the bottom with 2 g l < v**2 < 5 g l, it slackens at
        !! cos(theta) = (2 - v**2/(g l))/3.
        type(pendulum_t) :: system
        type(recorder_t) :: record
        type(error_t), allocatable :: error
        real(dp), parameter :: l = 1.3_dp, g = 9.81_dp
        real(dp), parameter :: ratios(5) = [2.001_dp, 2.7_dp, 3.5_dp, 4.2_dp, 4.99_dp]
        real(dp) :: q(1), v(1), ended
        integer :: i

        call system%configure([0.7_dp, l, g], error)
        do i = 1, 5
            q = 0.0_dp
            v = sqrt(ratios(i)*g/l)
            record%events = 0
            record%samples = 0
            call find(system, ["tension falling stop"], q, v, 9.0_dp, 1e-14_dp, record, ended)
            call assertEqual(1, record%events, message="one")
            call assertEqual((2.0_dp - ratios(i))/3.0_dp, cos(q(1)), 1e-13_dp, "cos(theta)")
            call assertEqual(0.0_dp, system%quantity(2, ended, q, v), 1e-13_dp, "no tension")
        end do
        record%events = 0
        q = 0.0_dp
        v = sqrt(5.01_dp*g/l)
        call find(system, ["tension falling stop"], q, v, 9.0_dp, 1e-14_dp, record, ended)
        call assertEqual(0, record%events, message="a full circle keeps it taut")
    end subroutine slack

    subroutine sphere()
        !! Released at the angle a from the top, at rest: cos = 2/3 cos(a). The way down multiplies
        !! errors by about 1/a.
        type(pendulum_t) :: system
        type(recorder_t) :: record
        type(error_t), allocatable :: error
        real(dp), parameter :: angles(3) = [1e-4_dp, 0.01_dp, 0.7_dp]
        real(dp) :: q(1), v(1), ended
        integer :: i

        call system%configure([0.7_dp, 1.3_dp, 9.81_dp], error)
        do i = 1, 3
            q = pi - angles(i)
            v = 0.0_dp
            call find(system, ["tension rising stop"], q, v, 20.0_dp, 1e-14_dp, record, ended)
            call assertEqual(2.0_dp/3.0_dp*cos(angles(i)), -cos(q(1)), &
                             1e-14_dp/angles(i) + 1e-13_dp, "where it leaves")
        end do
    end subroutine sphere

    subroutine what_events_are_called()
        !! Of the second contact of a system; of a quantity with words and of one without.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(scene_t) :: scene
        type(word_t) :: none(0)
        type(contact_event_t) :: contact
        type(column_event_t) :: event

        call new_contact_event(contact, 1)
        call assertEqual("at each impact", trim(contact%place))
        call new_contact_event(contact, 2)
        call assertEqual("impact 2", trim(contact%label))
        call assertEqual("at each impact 2", trim(contact%place))
        call parse_scene("&scene system = 'o', dt = 1, duration = 1, q = 0.6, -0.8 / "// &
                         "&lagrangian coordinates = 'x', 'y', parameters = 'm', "// &
                         "T = 'm/2 (x_dot^2 + y_dot^2)', quantities = 'r = sqrt(x^2 + y^2)', "// &
                         "'s [m] half of it = r/2' / &o m = 1 /", "text", none, scene, system, &
                         error)
        call assertFalse(allocated(error), "two quantities")
        if (allocated(error)) return
        call new_column_event(event, "r = 0.5", system, error)
        call assertEqual("where r = 0.5", trim(event%place))
        call new_column_event(event, "s = 0.5 rising", system, error)
        call assertEqual("where s = 0.5, rising; s: half of it", trim(event%place))
    end subroutine what_events_are_called
end module test_events
