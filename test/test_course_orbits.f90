module test_course_orbits
    !! The course's orbits, shipped as formulas in scenes, against their closed forms, each with
    !! what must not hold.
    !!
    !! A step errs by some \(10^{-13}\) of what is larger than one. In one round of some 30 steps
    !! the perihelion multiplies that by no more than \((1 + e)^2/(1 - e)^2\), 16 for \(e = 0.6\),
    !! and an error of the energy grows to one of the phase with the time: \(10^{-9}\) is left for
    !! up to ten rounds.
    use course_runs, only: follow, is_conserved, open_scene, value_of
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertTrue
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_recorder, only: recorder_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: read_scene
    use lagrangia_solve, only: solve
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: course_orbits_suite

    real(dp), parameter :: pi = acos(-1.0_dp), near = 1e-9_dp
    character(*), parameter :: as_shipped = ""

contains

    function course_orbits_suite() result(suite)
        type(TestSuite) :: suite

        suite = TestSuite("course_orbits")
        call suite%addTest(TestMethod("the ellipse at each time", ellipse))
        call suite%addTest(TestMethod("Kepler's third law", third_law))
        call suite%addTest(TestMethod("the Laplace vector stays", laplace_vector))
        call suite%addTest(TestMethod("with 1/r^3 the perihelion moves on", perihelion))
        call suite%addTest(TestMethod("two bodies about their centre of mass", two_bodies))
        call suite%addTest(TestMethod("a comet passes close to the sun", comet))
    end function course_orbits_suite

    subroutine start_at_perihelion(name, overrides, a, e, system, q, v)
        !! \(m = 2\), \(k = 3\): \(r = a(1 - e)\), \(m r^2\dot\varphi = \sqrt{m k a(1 - e^2)}\).
        character(*), intent(in) :: name, overrides
        real(dp), intent(in) :: a, e
        class(system_t), allocatable, intent(out) :: system
        real(dp), intent(out) :: q(2), v(2)
        type(scene_t) :: scene

        call open_scene(name, overrides//"kepler%m=2;kepler%k=3;", scene, system)
        q = [a*(1.0_dp - e), 0.0_dp]
        v = [0.0_dp, sqrt(1.5_dp*a*(1.0_dp - e**2))/q(1)**2]
    end subroutine start_at_perihelion

    pure function eccentric_anomaly(mean, e) result(u)
        !! \(u - e\sin u = M\), by Newton's method from \(\pi\), where it converges for all e < 1.
        real(dp), intent(in) :: mean, e
        real(dp) :: u, rest
        integer :: i

        rest = modulo(mean, 2*pi)
        u = pi
        do i = 1, 60
            u = u - (u - e*sin(u) - rest)/(1.0_dp - e*cos(u))
        end do
        u = u + (mean - rest)
    end function eccentric_anomaly

    subroutine ellipse()
        !! \(r = a(1 - e\cos u)\), \(x = a(\cos u - e)\), \(y = a\sqrt{1 - e^2}\sin u\).
        real(dp), parameter :: a = 1.3_dp, e = 0.6_dp, times(5) = [0.0_dp, 0.4_dp, 2.9_dp, &
                                                                   8.0_dp, 30.0_dp]
        class(system_t), allocatable :: system
        real(dp), allocatable :: q(:, :), v(:, :)
        real(dp) :: q0(2), v0(2), u
        integer :: i

        call start_at_perihelion("kepler", as_shipped, a, e, system, q0, v0)
        if (anyExceptions()) return
        call follow(system, times, q0, v0, q, v)
        do i = 1, size(times)
            u = eccentric_anomaly(times(i)*sqrt(1.5_dp/a**3), e)
            call assertEqual(a*(1.0_dp - e*cos(u)), q(1, i), near, "r")
            call assertEqual([a*(cos(u) - e), a*sqrt(1.0_dp - e**2)*sin(u)], &
                             q(1, i)*[cos(q(2, i)), sin(q(2, i))], near, "place")
        end do
    end subroutine ellipse

    subroutine third_law()
        !! \(T = 2\pi\sqrt{m a^3/k}\), whatever the eccentricity. With a force \(h/r^3\) more, T
        !! from r to r is another.
        real(dp), parameter :: a(4) = [1.0_dp, 1.0_dp, 2.0_dp, 0.5_dp], &
                               e(4) = [0.1_dp, 0.7_dp, 0.4_dp, 0.4_dp]
        integer :: i

        do i = 1, 4
            call assertEqual(2*pi*sqrt(a(i)**3/1.5_dp), round("kepler", as_shipped, a(i), e(i)), &
                             near*a(i)**1.5_dp)
        end do
        call assertGreaterThan(abs(round("kepler_precession", "kepler%h=0.3;", 1.0_dp, 0.1_dp) &
                                   - 2*pi*sqrt(1.0_dp/1.5_dp)), 0.1_dp)
    contains
        function round(name, overrides, a, e) result(period)
            !! The time from perihelion to perihelion.
            character(*), intent(in) :: name, overrides
            real(dp), intent(in) :: a, e
            real(dp) :: period
            class(system_t), allocatable :: system
            type(recorder_t) :: found
            real(dp), allocatable :: q(:, :), v(:, :)
            real(dp) :: q0(2), v0(2)

            period = 0.0_dp
            call start_at_perihelion(name, overrides, a, e, system, q0, v0)
            if (anyExceptions()) return
            call follow(system, [0.0_dp, 30.0_dp], q0, v0, q, v, ["r_dot = 0 rising"], found)
            call assertTrue(found%events > 1, "it comes round twice")
            if (found%events > 1) period = found%event_t(2) - found%event_t(1)
        end function round
    end subroutine third_law

    subroutine laplace_vector()
        !! \(A = m k e\) along x, and the program knows it; with \(h \ne 0\) it says that A changes,
        !! and A does.
        real(dp), parameter :: times(3) = [0.0_dp, 1.0_dp, 20.0_dp]
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(word_t) :: words(1)
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:, :), v(:, :)
        real(dp) :: q0(2), v0(2)
        integer :: i

        call start_at_perihelion("kepler", as_shipped, 1.0_dp, 0.6_dp, system, q0, v0)
        if (anyExceptions()) return
        call assertTrue(is_conserved(system, "A_x") .and. is_conserved(system, "A_y"), &
                        "the vector is found to be conserved")
        call follow(system, times, q0, v0, q, v)
        do i = 1, 3
            call assertEqual([3.6_dp, 0.0_dp], [value_of(system, "A_x", 0.0_dp, q(:, i), v(:, i)), &
                             value_of(system, "A_y", 0.0_dp, q(:, i), v(:, i))], near, "A")
        end do
        call start_at_perihelion("kepler_precession", "kepler%h=1e-6;", 1.0_dp, 0.6_dp, system, &
                                 q0, v0)
        if (anyExceptions()) return
        call assertFalse(is_conserved(system, "A_x") .or. is_conserved(system, "A_y"), &
                         "with 1/r^3 it is not")
        call follow(system, times, q0, v0, q, v)
        call assertGreaterThan(abs(value_of(system, "A_y", 0.0_dp, q(:, 3), v(:, 3))), 1e-6_dp, &
                               message="it turns")
        words(1)%text = "kepler%h=-0.1"
        call read_scene("data/scenes/kepler.nml", words, scene, system, error)
        call assertFalse(allocated(error), "the scene runs with another h")
        if (allocated(error)) return
        call assertTrue(any(scene%columns == "A_x"), "with the vector")
        call assertFalse(any(scene%columns == "A_x_drift"), "which has no drift")
    end subroutine laplace_vector

    subroutine perihelion()
        !! At perihelion n the angle is \(2\pi n/\gamma\), \(\gamma^2 = 1 + m h/p_\varphi^2\): in
        !! the scene 0.9, and 1.1 for a force away from the sun.
        real(dp), parameter :: gamma(2) = [0.9_dp, 1.1_dp]
        character(*), parameter :: set(2) = [ &
            "kepler%h=-0.1539             ", "kepler%h=0.086016;scene%v=0,4"]
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(recorder_t) :: found
        real(dp), allocatable :: q(:, :), v(:, :)
        integer :: i, k

        do k = 1, 2
            call open_scene("kepler_precession", trim(set(k))//";", scene, system)
            if (anyExceptions()) return
            call follow(system, [0.0_dp, 60.0_dp], scene%q, scene%v, q, v, ["r_dot = 0 rising"], &
                        found)
            call assertGreaterThan(found%events, 4)
            if (anyExceptions()) return
            call assertEqual([(2*pi*i/gamma(k), i=1, 4)], found%event_q(2, :4), 4*near)
            call assertEqual(scene%q(1), found%event_q(1, 4), near)
        end do
        call open_scene("kepler_precession", as_shipped, scene, system)
        call assertEqual(-0.1539_dp, scene%parameters(3), 0.0_dp, &
                         "the scene has the first of these")
        call open_scene("kepler", as_shipped, scene, system)
        call follow(system, [0.0_dp, 30.0_dp], scene%q, scene%v, q, v, ["r_dot = 0 rising"], found)
        call assertEqual([(2*pi*i, i=1, 4)], found%event_q(2, :4), 4*near, "without it stays")
    end subroutine perihelion

    subroutine two_bodies()
        !! The relative motion is that of one body in the field of both masses, with the reduced
        !! mass, while the centre of mass goes straight on. With the sun alone, as if the planet had
        !! no mass, the time of a round is another.
        real(dp), parameter :: times(3) = [0.0_dp, 5.0_dp, 17.0_dp]
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        real(dp), allocatable :: q(:, :), v(:, :)
        real(dp) :: a, e, u
        integer :: i

        call open_scene("two_bodies", as_shipped, scene, system)
        if (anyExceptions()) return
        call assertTrue(is_conserved(system, "P_x") .and. is_conserved(system, "P_y") .and. &
                        is_conserved(system, "L_z") .and. is_conserved(system, "X_0") .and. &
                        is_conserved(system, "A_x") .and. is_conserved(system, "A_y"), &
                            "all are found")
        call assertFalse(is_conserved(system, "p_x1") .or. is_conserved(system, "x"), &
                         "not of one alone")
        a = 1.0_dp/(2.0_dp/2.0_dp - 0.8_dp**2/4.0_dp)  ! from the energy, at 2 m with 0.8 m/s
        e = 2.0_dp/a - 1.0_dp
        call follow(system, times, scene%q, scene%v, q, v)
        do i = 1, 3
            u = eccentric_anomaly(pi + times(i)*sqrt(4.0_dp/a**3), e)
            call assertEqual([a*(cos(u) - e), a*sqrt(1.0_dp - e**2)*sin(u)], q(3:4, i) - q(1:2, &
                i), &
                             near, "relative")
            call assertEqual([0.1_dp*times(i), 0.0_dp], 0.75_dp*q(1:2, i) + 0.25_dp*q(3:4, i), &
                             near, &
                             "centre of mass")
        end do
        u = eccentric_anomaly(pi + times(2)*sqrt(3.0_dp/a**3), e)
        call assertGreaterThan(abs(a*(cos(u) - e) - (q(3, 2) - q(1, 2))), 0.1_dp)
        call open_scene("two_bodies", "lagrangian%Q_x1='0.01 m1';", scene, system)
        if (anyExceptions()) return
        call assertFalse(is_conserved(system, "P_x") .or. is_conserved(system, "L_z") .or. &
                         is_conserved(system, "X_0"), "a force from outside")
    end subroutine two_bodies

    subroutine comet()
        !! Eccentricity 0.98, from the aphelion: behind the sun the error of a step counts
        !! \((1 + e)^2/(1 - e)^2\) times, \(10^4\), in each of some 30 steps. Steps of one
        !! length, as many a round as would do elsewhere, lose the energy there.
        real(dp), parameter :: e = 0.98_dp, a = 2.0_dp/(1.0_dp + e)
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:, :), v(:, :)
        real(dp) :: u

        call open_scene("kepler_comet", as_shipped, scene, system)
        if (anyExceptions()) return
        call assertEqual(e, value_of(system, "A_x", 0.0_dp, scene%q, scene%v), near)
        call follow(system, [0.0_dp, 4.0_dp], scene%q, scene%v, q, v)
        u = eccentric_anomaly(4.0_dp/sqrt(a**3) + pi, e)
        call assertEqual([a*(cos(u) - e), a*sqrt(1.0_dp - e**2)*sin(u)], &
                         q(1, 2)*[cos(q(2, 2)), sin(q(2, 2))], 3e-8_dp, "place")
        call solve(system, "rk4", [0.0_dp, 4.0_dp], scene%q, scene%v, q, v, error, dt=4e-3_dp)
        call assertGreaterThan(abs(system%energy(4.0_dp, q(:, 2), v(:, 2))*2*a + 1.0_dp), 0.1_dp)
    end subroutine comet
end module test_course_orbits
