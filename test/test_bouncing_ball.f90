module test_bouncing_ball
    !! The ball against its closed form: bounces, the Zeno point, rest.
    use funit, only: anyExceptions, assertEqual, assertFalse, assertGreaterThan, &
                     assertGreaterThanOrEqual, assertLessThan, assertTrue, TestMethod, TestSuite
    use lagrangia_bouncing_ball, only: bouncing_ball_t
    use lagrangia_dense_run, only: run_dense
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t
    use lagrangia_events, only: contact_event_t, event_box_t, new_contact_event
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: method_names, new_adaptive, new_integrator
    use lagrangia_observer, only: observer_box_t
    use lagrangia_recorder, only: recorder_t
    use lagrangia_reference, only: reference_t
    use lagrangia_run, only: run
    use lagrangia_stepwise, only: new_stepwise, stepwise_t
    use lagrangia_time_grid, only: new_sample_times, new_time_grid, time_grid_t
    implicit none (type, external)
    private
    public :: bouncing_ball_suite

    real(dp), parameter :: mass = 0.7_dp, gravity = 9.81_dp
    character(*), parameter :: adaptive(2) = ["gauss16", "dop853 "]

contains

    function bouncing_ball_suite() result(suite)
        type(TestSuite) :: suite

        suite = TestSuite("bouncing_ball")
        call suite%addTest(TestMethod("the closed form has known bounce times", known_times))
        call suite%addTest(TestMethod("bounces come when the closed form says", bounce_times))
        call suite%addTest(TestMethod("after infinitely many bounces the ball rests", zeno))
        call suite%addTest(TestMethod("without loss it bounces for ever", elastic))
        call suite%addTest(TestMethod("without restitution it stays at once", plastic))
        call suite%addTest(TestMethod("thrown down at the floor it bounces at once", down_at_once))
        call suite%addTest(TestMethod("at rest on the floor it stays", at_rest))
        call suite%addTest(TestMethod("without gravity it flies on", no_gravity))
        call suite%addTest(TestMethod("methods of fixed step bounce too", fixed_step))
        call suite%addTest(TestMethod("a run without impacts is refused", plain_run))
    end function bouncing_ball_suite

    subroutine bounce(method, restitution, q0, v0, duration, record, q, v, dt)
        !! Run the ball by steps of `dt`, or of the method's own choice.
        character(*), intent(in) :: method
        real(dp), intent(in) :: restitution, q0, v0, duration
        type(recorder_t), target, intent(inout) :: record
        real(dp), intent(out) :: q(1), v(1)
        real(dp), intent(in), optional :: dt  !! s
        type(bouncing_ball_t) :: system
        type(event_box_t) :: events(1)
        type(observer_box_t) :: observers(1)
        type(contact_event_t) :: contact
        class(dense_integrator_t), allocatable :: adaptive
        type(stepwise_t) :: stepwise
        class(integrator_t), allocatable :: fixed
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error
        real(dp) :: ended

        call system%configure([mass, gravity, restitution], error)
        call new_contact_event(contact, 1)
        allocate (events(1)%item, source=contact)
        observers(1)%item => record
        q = q0
        v = v0
        if (present(dt)) then
            call new_integrator(method, fixed, error)
            call new_stepwise(stepwise, fixed, dt)
            call new_time_grid(plan, 0.0_dp, dt, duration, 1_i8, error)
            call run_dense(system, stepwise, plan, events, observers, q, v, ended, error)
        else
            call new_adaptive(method, adaptive)
            call new_sample_times(plan, 0.0_dp, duration, 1000_i8, error)
            call run_dense(system, adaptive, plan, events, observers, q, v, ended, error)
        end if
        if (allocated(error)) call assertEqual("", error%message, message="error")
        call assertEqual(duration, ended, message="the end is reached")
        call assertEqual(duration, record%t(record%samples), message="the last sample is the end")
        call assertGreaterThanOrEqual(minval(record%q(1, :record%samples)), 0.0_dp, &
                                      message="never below the floor")
    end subroutine bounce

    subroutine closed_form(restitution, q0, v0, reference, g)
        real(dp), intent(in) :: restitution, q0, v0
        class(reference_t), allocatable, intent(out) :: reference
        real(dp), intent(in), optional :: g  !! else that of the tests
        type(bouncing_ball_t) :: system
        type(error_t), allocatable :: error

        call system%configure([mass, gravity, restitution], error)
        if (present(g)) call system%configure([mass, g, restitution], error)
        call system%closed_form(0.0_dp, [q0], [v0], reference)
        call assertTrue(allocated(reference), "closed form")
    end subroutine closed_form

    elemental function impact_time(restitution, q0, v0, n) result(t)
        !! Of impact `n`, flight by flight: \(2v/g\) each.
        real(dp), intent(in) :: restitution, q0, v0
        integer, intent(in) :: n
        real(dp) :: t, speed
        integer :: i

        speed = sqrt(v0**2 + 2.0_dp*gravity*q0)
        t = (v0 + speed)/gravity
        do i = 2, n
            speed = restitution*speed
            t = t + 2.0_dp*speed/gravity
        end do
    end function impact_time

    elemental function rest_time(restitution, v0) result(t)
        !! The end of all flights, from the floor: \(2v_0/[g(1 - e)]\).
        real(dp), intent(in) :: restitution, v0
        real(dp) :: t

        t = 2.0_dp*v0/(gravity*(1.0_dp - restitution))
    end function rest_time

    subroutine no_gravity()
        !! g = 0: down from 1 m with 2 m/s, at the floor after 0.5 s, up with 0.6 of it for ever.
        class(reference_t), allocatable :: reference
        real(dp) :: q(1), v(1)

        call closed_form(0.6_dp, 1.0_dp, -2.0_dp, reference, g=0.0_dp)
        call reference%state_at(0.25_dp, q, v)
        call assertEqual([0.5_dp, -2.0_dp], [q, v], 4.0_dp*epsilon(1.0_dp), "before the impact")
        call reference%state_at(2.5_dp, q, v)
        call assertEqual([2.4_dp, 1.2_dp], [q, v], 8.0_dp*epsilon(1.0_dp), "after it")
        call reference%state_at(1e6_dp, q, v)
        call assertEqual(1.2_dp, v(1), 8.0_dp*epsilon(1.0_dp), "it never rests")
        call closed_form(0.6_dp, 1.0_dp, 2.0_dp, reference, g=0.0_dp)
        call reference%state_at(3.0_dp, q, v)
        call assertEqual([7.0_dp, 2.0_dp], [q, v], 16.0_dp*epsilon(1.0_dp), "upwards, no impact")
    end subroutine no_gravity

    subroutine known_times()
        !! To 25 digits from the geometric series (restitution 0.8, 3 m/s).
        !! Times are good to 1e-15, so the height there to 3e-15.
        real(dp), parameter :: times(3) = [0.611620795107033639_dp, 1.10091743119266055_dp, &
                                           1.49235474006116208_dp]
        real(dp), parameter :: rest = 3.0581039755351682_dp
        class(reference_t), allocatable :: reference
        real(dp) :: q(1), v(1)
        integer :: i

        call closed_form(0.8_dp, 0.0_dp, 3.0_dp, reference)
        do i = 1, 3
            call reference%state_at(times(i), q, v)
            call assertEqual(0.0_dp, q(1), 3e-15_dp, "bounce")
            call reference%state_at(times(i) - 1e-9_dp, q, v)
            call assertEqual(-3.0_dp*0.8_dp**(i - 1), v(1), 2e-8_dp, "down")
            call reference%state_at(times(i) + 1e-9_dp, q, v)
            call assertEqual(3.0_dp*0.8_dp**i, v(1), 2e-8_dp, "up")
        end do
        call reference%state_at(rest - 2e-15_dp, q, v)
        call assertGreaterThan(abs(v(1)), 0.0_dp, message="not yet at rest")
        call reference%state_at(rest + 2e-15_dp, q, v)
        call assertEqual([0.0_dp, 0.0_dp], [q, v], message="rest")
        call assertEqual(times, impact_time(0.8_dp, 0.0_dp, 3.0_dp, [1, 2, 3]), 1e-15_dp, "bounces")
        call assertEqual(rest, rest_time(0.8_dp, 3.0_dp), 2e-15_dp, "end of bounces")
        call reference%state_at(1.10091743119266055_dp + 0.1_dp, q, v)
        call assertEqual(0.64_dp*3.0_dp - 0.981_dp, v(1), 1e-14_dp, "v in the third flight")
        call assertEqual(0.1_dp*0.64_dp*3.0_dp - 0.04905_dp, q(1), 1e-15_dp, "y in it")
        call reference%state_at(3.06_dp, q, v)
        call assertEqual([0.0_dp, 0.0_dp], [q, v], message="rest")
    end subroutine known_times

    subroutine check_times(method, restitution, q0, v0, duration)
        !! Times to 1e-13, speeds to 1e-13 of themselves, states between to 1e-13.
        character(*), intent(in) :: method
        real(dp), intent(in) :: restitution, q0, v0, duration
        class(reference_t), allocatable :: reference
        type(recorder_t) :: record
        real(dp) :: q(1), v(1), speed
        integer :: n, i

        call closed_form(restitution, q0, v0, reference)
        call bounce(method, restitution, q0, v0, duration, record, q, v)
        n = record%events
        call assertTrue(impact_time(restitution, q0, v0, n) < duration, "no bounce too many")
        call assertTrue(impact_time(restitution, q0, v0, n + 1) > duration, "no bounce too few")
        if (anyExceptions()) return
        call assertEqual(impact_time(restitution, q0, v0, [(i, i=1, n)]), record%event_t(:n), &
                         1e-13_dp, "times")
        speed = sqrt(v0**2 + 2*gravity*q0)
        do i = 1, n
            call assertEqual(1.0_dp, record%event_v(1, i)/(speed*restitution**i), 1e-13_dp, &
                             "E is multiplied by restitution**2")
            call assertEqual(0.0_dp, record%event_q(1, i), message="on the floor")
        end do
        do i = 1, record%samples
            call reference%state_at(record%t(i), q, v)
            call assertEqual(q(1), record%q(1, i), 1e-13_dp, "y")
        end do
    end subroutine check_times

    subroutine bounce_times()
        integer :: i

        do i = 1, size(adaptive)
            call check_times(adaptive(i), 0.8_dp, 0.0_dp, 3.0_dp, 2.6_dp)
            call check_times(adaptive(i), 0.5_dp, 1.3_dp, 0.0_dp, 1.3_dp)
            call check_times(adaptive(i), 0.93_dp, 0.4_dp, -2.0_dp, 4.5_dp)
            call check_times(adaptive(i), 0.9_dp, 1.0_dp, 1.5_dp, 5.0_dp)
        end do
    end subroutine bounce_times

    subroutine zeno()
        !! The time of the last bounce is the sum of all flights, each of them rounded to the
        !! spacing of times, 4e-16: 1e-13 is some 150 bounces' worth of it. What flies for less
        !! than one spacing rests at once: that is spacing/(1 - e) too early.
        real(dp), parameter :: restitutions(3) = [0.3_dp, 0.8_dp, 0.97_dp]
        type(recorder_t), allocatable :: record
        type(bouncing_ball_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), rest
        integer :: i, k, m

        do m = 0, 5
            i = 1 + m/2
            rest = rest_time(restitutions(i), 3.0_dp)
            allocate (record)
            call bounce(adaptive(1 + mod(m, 2)), restitutions(i), 0.0_dp, 3.0_dp, 4.0_dp*rest, &
                        record, q, v)
            call assertEqual([0.0_dp, 0.0_dp], [q, v], message="it rests")
            k = record%events
            call assertGreaterThan(k, 20, message="many bounces")
            call assertEqual(rest, record%event_t(k), 1e-13_dp*max(1.0_dp, 0.02_dp*k), &
                             "the Zeno point")
            call assertEqual(0.0_dp, record%event_v(1, k), message="the last bounce")
            k = record%samples
            call assertEqual(0.0_dp, maxval(pack(record%q(1, :k), record%t(:k) > rest + 1e-9_dp)), &
                             message="flat")
            deallocate (record)
        end do
        call system%configure([mass, gravity, 0.5_dp], error)
        call assertEqual(mass*gravity, system%quantity(1, 0.0_dp, [0.0_dp], [0.0_dp]), &
                         message="held by m g")
        call assertEqual(0.0_dp, system%quantity(1, 0.0_dp, [0.1_dp], [0.0_dp]), message="free")
        call assertEqual(0.0_dp, system%quantity(1, 0.0_dp, [0.0_dp], [0.1_dp]), message="leaving")
    end subroutine zeno

    subroutine elastic()
        !! A hundred bounces later: every 2 v0/g. A step may fall 2 s past the floor, 20 m: the
        !! rounding of its dense output, 500 epsilon times some metres, moves a bounce by 1e-14 s.
        type(recorder_t) :: record
        real(dp) :: q(1), v(1)
        integer :: i

        call bounce("gauss16", 1.0_dp, 0.0_dp, 2.0_dp, 41.0_dp, record, q, v)
        call assertEqual(100, record%events, message="bounces")
        if (anyExceptions()) return
        call assertEqual([(4.0_dp/gravity*i, i=1, 100)], record%event_t(:100), 1e-12_dp, "times")
        call assertEqual(2.0_dp, record%event_v(1, 100), 1e-13_dp, "speed")
    end subroutine elastic

    subroutine plastic()
        type(recorder_t) :: record
        real(dp) :: q(1), v(1)

        call bounce("gauss16", 0.0_dp, 1.0_dp, 0.0_dp, 2.0_dp, record, q, v)
        call assertEqual(1, record%events, message="one impact")
        call assertEqual(sqrt(2.0_dp/gravity), record%event_t(1), 1e-15_dp, "its time")
        call assertEqual([0.0_dp, 0.0_dp], [q, v], message="it stays")
    end subroutine plastic

    subroutine down_at_once()
        type(recorder_t) :: record
        real(dp) :: q(1), v(1)

        call bounce("gauss16", 0.5_dp, 0.0_dp, -2.0_dp, 0.1_dp, record, q, v)
        call assertEqual(1, record%events, message="one impact")
        call assertEqual(0.0_dp, record%event_t(1), message="at the start")
        call assertEqual(1.0_dp, record%event_v(1, 1), 1e-15_dp, "its speed")
        call assertEqual(1.0_dp - 0.1_dp*gravity, v(1), 1e-15_dp, "v")
    end subroutine down_at_once

    subroutine at_rest()
        type(recorder_t) :: record
        real(dp) :: q(1), v(1)

        call bounce("gauss16", 0.5_dp, 0.0_dp, 0.0_dp, 10.0_dp, record, q, v)
        call assertEqual(0, record%events, message="no impact")
        call assertEqual([0.0_dp, 0.0_dp], [q, v], message="still there")
    end subroutine at_rest

    subroutine fixed_step()
        !! A parabola is exact for all methods: bounces and Zeno point as well as by tolerance.
        character(name_length), allocatable :: methods(:)
        class(reference_t), allocatable :: reference
        type(recorder_t), allocatable :: record
        real(dp) :: q(1), v(1)
        integer :: i, k

        allocate (methods, source=method_names())
        call closed_form(0.7_dp, 0.9_dp, 0.3_dp, reference)
        do k = 1, size(methods)
            if (methods(k) == "boris") cycle  ! for a charge
            allocate (record)
            call bounce(trim(methods(k)), 0.7_dp, 0.9_dp, 0.3_dp, 3.0_dp, record, q, v, 0.01_dp)
            call assertEqual(impact_time(0.7_dp, 0.9_dp, 0.3_dp, [(i, i=1, 20)]), &
                             record%event_t(:20), 1e-13_dp, trim(methods(k))//": times")
            call assertEqual([0.0_dp, 0.0_dp], [q, v], message="it rests")
            call assertLessThan(abs(record%event_t(record%events) &
                                    - impact_time(0.7_dp, 0.9_dp, 0.3_dp, 200)), 1e-13_dp, &
                                message="Zeno point")
            deallocate (record)
        end do
    end subroutine fixed_step

    subroutine plain_run()
        type(bouncing_ball_t) :: system
        class(integrator_t), allocatable :: method
        type(observer_box_t) :: nobody(0)
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)

        call system%configure([mass, gravity, 0.5_dp], error)
        call new_integrator("rk4", method, error)
        call new_time_grid(plan, 0.0_dp, 0.01_dp, 1.0_dp, 1_i8, error)
        call assertFalse(allocated(error), "plan")
        q = 1.0_dp
        v = 0.0_dp
        call run(system, method, plan, nobody, q, v, error)
        call assertTrue(allocated(error), "refused")
        if (anyExceptions()) return
        call assertEqual("unilateral constraints need a run that looks for impacts: run_dense", &
                         error%message, message="message")
    end subroutine plain_run
end module test_bouncing_ball
