module test_course_motions
    !! The course's curves, tops and turning frames, shipped as formulas in scenes, against their
    !! closed forms, each with what must not hold.
    !!
    !! A step errs by some \(10^{-13}\), some hundred steps by \(10^{-10}\) of what is of size one.
    use course_runs, only: follow, is_conserved, modes_of, open_scene, value_of
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertLessThan, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_recorder, only: recorder_t
    use lagrangia_scene, only: scene_t
    use lagrangia_small_oscillations, only: modes_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: course_motions_suite

    real(dp), parameter :: pi = acos(-1.0_dp), near = 1e-10_dp, g = 9.81_dp
    character(*), parameter :: as_shipped = ""

contains

    function course_motions_suite() result(suite)
        type(TestSuite) :: suite

        suite = TestSuite("course_motions")
        call suite%addTest(TestMethod("a cycloid is a tautochrone, a circle is none", tautochrone))
        call suite%addTest(TestMethod("a bead on a parabola", parabola))
        call suite%addTest(TestMethod("a conical pendulum", conical))
        call suite%addTest(TestMethod("the ellipse of a spherical pendulum turns", apsides))
        call suite%addTest(TestMethod("a top between its two circles", nutation))
        call suite%addTest(TestMethod("steady precession", steady_precession))
        call suite%addTest(TestMethod("a straight line in a turning frame", turning_frame))
        call suite%addTest(TestMethod("Foucault's pendulum", foucault))
        call suite%addTest(TestMethod("a skate on sloping ice", skate))
        call suite%addTest(TestMethod("a rod is a constraint", rod))
        call suite%addTest(TestMethod("a wire that turns does work", turning_wire))
    end function course_motions_suite

    function period_of(system, event, q0, duration) result(period)
        !! Between the first two of these events, from rest.
        class(system_t), intent(in) :: system
        character(*), intent(in) :: event
        real(dp), intent(in) :: q0(:), duration
        real(dp) :: period
        type(recorder_t) :: found
        real(dp), allocatable :: q(:, :), v(:, :)

        period = 0.0_dp
        call follow(system, [0.0_dp, duration], q0, 0.0_dp*q0, q, v, [event], found)
        call assertTrue(found%events > 1, event//" happens twice")
        if (found%events > 1) period = found%event_t(2) - found%event_t(1)
    end function period_of

    subroutine tautochrone()
        !! \(T = 4\pi\sqrt{R/g}\) of all three beads, and along the curve a cosine of the time. On
        !! the circle that touches the cycloid at the bottom, of radius 4 R, T grows with the
        !! amplitude. At the highest start \(1 + \cos u\) is 0.06, and errors count as many times
        !! more.
        real(dp), parameter :: omega = sqrt(g), t = 2*pi/omega, start(3) = [0.5_dp, 1.4_dp, 2.8_dp]
        character(*), parameter :: events(3) = ["u1_dot = 0 falling", "u2_dot = 0 falling", &
                                                "u3_dot = 0 falling"]
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(modes_t) :: modes
        real(dp), allocatable :: q(:, :), v(:, :)
        integer :: i

        call open_scene("beads_on_a_cycloid", as_shipped, scene, system)
        if (anyExceptions()) return
        call assertEqual(start, scene%q, 0.0_dp)
        call assertEqual(4*pi*sqrt(0.25_dp/g), t, 4*epsilon(t))
        call modes_of(system, modes)
        call assertEqual([g, g, g], modes%omega2, 1e2_dp*epsilon(g)*g, "g/(4 R)")
        call follow(system, [0.0_dp, 0.3_dp, 2.9_dp], start, 0.0_dp*start, q, v)
        call assertEqual(sin(start/2)*cos(omega*0.3_dp), sin(q(:, 2)/2), 20*near, "along the curve")
        call assertEqual(sin(start/2)*cos(omega*2.9_dp), sin(q(:, 3)/2), 20*near, "along the curve")
        do i = 1, 3
            call assertEqual(t, period_of(system, events(i), start, 4.1_dp*t), 20*near, "period")
        end do
        call open_scene("beads_on_a_cycloid", &
                        "lagrangian%T='8 m R^2 (u1_dot^2 + u2_dot^2 + u3_dot^2)';"// &
                        "lagrangian%V='-4 m g R (cos(u1) + cos(u2) + cos(u3))';"// &
                        "lagrangian%quantities='s=u1';", scene, system)
        if (anyExceptions()) return
        call modes_of(system, modes)
        call assertEqual([g, g, g], modes%omega2, 1e2_dp*epsilon(g)*g, "small swings are alike")
        call assertGreaterThan(period_of(system, events(1), start, 4.1_dp*t), 1.01_dp*t)
        call assertGreaterThan(period_of(system, events(2), start, 4.1_dp*t), 1.1_dp*t)
    end subroutine tautochrone

    subroutine parabola()
        !! From rest at A: \(T = \frac4{\sqrt{gc}}\int_0^{\pi/2}\sqrt{1 + c^2A^2\sin^2\varphi}\,
        !! d\varphi\), by the trapezoidal rule, which converges geometrically.
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(modes_t) :: modes

        call open_scene("beads_on_a_parabola", "beads_on_a_parabola%c=1.3;", scene, system)
        if (anyExceptions()) return
        call modes_of(system, modes)
        call assertEqual([1.3_dp*g, 1.3_dp*g], modes%omega2, 1e2_dp*epsilon(g)*g)
        call assertEqual(closed(0.3_dp), period_of(system, "x1_dot = 0 falling", scene%q, 9.0_dp), &
                         10*near)
        call assertEqual(closed(1.2_dp), period_of(system, "x2_dot = 0 falling", scene%q, 9.0_dp), &
                         10*near)
        call assertGreaterThan(closed(1.2_dp), 1.2_dp*closed(0.3_dp))
        call assertEqual(2*pi/sqrt(1.3_dp*g), closed(1e-9_dp), 1e-14_dp, "small ones")
    contains
        pure function closed(a) result(period)
            real(dp), intent(in) :: a
            real(dp) :: period
            integer, parameter :: n = 64
            integer :: i

            period = 2*pi/n*sum([(sqrt(1.0_dp + (1.3_dp*a*sin(2*pi*i/n))**2), i=1, &
                                  n)])/sqrt(1.3_dp*g)
        end function closed
    end subroutine parabola

    subroutine conical()
        !! At \(\varrho\) below the pivot by h the bob goes round with \(\omega^2 = g/h\), and the
        !! rod holds \(mg\ell/h\). At another speed it does not stay on the circle.
        real(dp), parameter :: rho = 0.6_dp, h = 0.8_dp, omega = sqrt(g/h), times(2) = [0.0_dp, &
            4.7_dp]
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(modes_t) :: modes
        real(dp), allocatable :: q(:, :), v(:, :)

        call open_scene("spherical_pendulum", as_shipped, scene, system)
        if (anyExceptions()) return
        call modes_of(system, modes)
        call assertEqual([g, g], modes%omega2, 1e2_dp*epsilon(g)*g, "g/l twice")
        call assertTrue(is_conserved(system, "L_z"), "L_z")
        call assertFalse(is_conserved(system, "rho"), "rho")
        call follow(system, times, [rho, 0.0_dp], [0.0_dp, omega*rho], q, v)
        call assertEqual(rho*[cos(omega*4.7_dp), sin(omega*4.7_dp)], q(:, 2), 10*near)
        call assertEqual(g/h, value_of(system, "tension", 4.7_dp, q(:, 2), v(:, 2)), 1e2_dp*near)
        call follow(system, times, [rho, 0.0_dp], [0.0_dp, 0.9_dp*omega*rho], q, v)
        call assertGreaterThan(abs(norm2(q(:, 2)) - rho), 1e-3_dp)
    end subroutine conical

    subroutine apsides()
        !! From one outermost point to the next the bob goes \(\pi +
        !! \frac{3\pi}8\frac{ab}{\ell^2}\), right to a part \((a^2 + b^2)/\ell^2\) of the last term.
        !! In a paraboloid of flat inertia, the plane oscillator, it is \(\pi\).
        real(dp), parameter :: a = 0.1_dp, b = 0.05_dp, turn = 3*pi/8*a*b
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(recorder_t) :: found

        call open_scene("spherical_pendulum", as_shipped, scene, system)
        if (anyExceptions()) return
        call assertEqual(pi + turn, advance(), (a**2 + b**2)*turn)
        call open_scene("spherical_pendulum", "lagrangian%T='m/2 (x_dot^2 + y_dot^2)';"// &
                        "lagrangian%V='m g/(2 l) (x^2 + y^2)';", scene, system)
        if (anyExceptions()) return
        call assertEqual(pi, advance(), 10*near)
    contains
        function advance() result(angle)
            !! From the first to the second outermost point; they lie across.
            real(dp) :: angle
            real(dp), allocatable :: q(:, :), v(:, :)
            real(dp) :: one(2), two(2)

            angle = 0.0_dp
            call follow(system, [0.0_dp, 3.0_dp], [a, 0.0_dp], [0.0_dp, b*sqrt(g)], q, v, &
                        ["D = 0 falling"], found)
            call assertTrue(found%events > 1, "outermost points")
            if (found%events < 2) return
            one = found%event_q(:, 1)
            two = found%event_q(:, 2)
            angle = modulo(atan2(one(1)*two(2) - one(2)*two(1), dot_product(one, two)), 2*pi)
        end function advance
    end subroutine apsides

    subroutine nutation()
        !! Let go at rest at \(u_0 = \cos\theta_0\), with \(\beta = p_\psi^2/(2I_1mgs)\), the axis
        !! falls to \(u = \tfrac12(\beta - \sqrt{\beta^2 - 4\beta u_0 + 4})\) and comes back to a
        !! cusp, where \(\dot\varphi = 0\). Without weight it stays.
        real(dp), parameter :: p_psi = 4e-5_dp*150.0_dp, &
            beta = p_psi**2/(2*1.2e-4_dp*0.1_dp*g*0.03_dp)
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(recorder_t) :: found
        real(dp), allocatable :: q(:, :), v(:, :)
        real(dp) :: u

        call open_scene("symmetric_top", as_shipped, scene, system)
        if (anyExceptions()) return
        call assertTrue(is_conserved(system, "p_phi") .and. is_conserved(system, "p_psi") .and. &
                        is_conserved(system, "omega_3"), "two momenta, and the spin")
        call assertFalse(is_conserved(system, "p_theta"), "and no more")
        call follow(system, [0.0_dp, 0.2_dp], scene%q, scene%v, q, v, &
                    ["theta_dot = 0"], found)
        call assertGreaterThan(found%events, 1)
        if (anyExceptions()) return
        u = 0.5_dp*(beta - sqrt(beta**2 - 2*beta + 4.0_dp))
        call assertEqual(acos(u), found%event_q(1, 1), near, "the lower circle")
        call assertEqual(scene%q(1), found%event_q(1, 2), near, "the upper one")
        call assertEqual(0.0_dp, found%event_v(2, 2), 1e3_dp*near, "a cusp")
        call open_scene("symmetric_top", "symmetric_top%g=0;", scene, system)
        if (anyExceptions()) return
        call follow(system, [0.0_dp, 0.2_dp], scene%q, scene%v, q, v)
        call assertEqual(scene%q(:2), q(:2, 2), near, "no weight, no precession")
    end subroutine nutation

    subroutine steady_precession()
        !! \(I_1\cos\theta\,\dot\varphi^2 - I_3\omega_3\dot\varphi + mgs = 0\): at either root the
        !! axis keeps its angle and goes round steadily. With a tenth less spin it does not.
        real(dp), parameter :: i1 = 1.2e-4_dp, l3 = 4e-5_dp*150.0_dp, weight = 0.1_dp*g*0.03_dp, &
                               theta = 0.8_dp, t = 0.5_dp
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        real(dp), allocatable :: q(:, :), v(:, :)
        real(dp) :: rate
        integer :: i

        call open_scene("symmetric_top", as_shipped, scene, system)
        if (anyExceptions()) return
        do i = -1, 1, 2
            rate = (l3 + i*sqrt(l3**2 - 4*i1*cos(theta)*weight))/(2*i1*cos(theta))
            call follow(system, [0.0_dp, t], [theta, 0.0_dp, 0.0_dp], &
                        [0.0_dp, rate, 150.0_dp - rate*cos(theta)], q, v)
            call assertEqual([theta, rate*t], q(:2, 2), 1e2_dp*near)
            call follow(system, [0.0_dp, t], [theta, 0.0_dp, 0.0_dp], &
                        [0.0_dp, rate, 135.0_dp - rate*cos(theta)], q, v)
            call assertGreaterThan(abs(q(1, 2) - theta), 1e-4_dp)
        end do
    end subroutine steady_precession

    subroutine turning_frame()
        !! \(x + iy = (Z_0 + Vt)e^{-i\omega t}\). Without the Coriolis force, with the centrifugal
        !! one alone, V is not conserved.
        real(dp), parameter :: omega = 0.5_dp, t = 2.2_dp
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        real(dp), allocatable :: q(:, :), v(:, :)
        complex(dp) :: z

        call open_scene("rotating_frame", as_shipped, scene, system)
        if (anyExceptions()) return
        call assertTrue(is_conserved(system, "V_X") .and. is_conserved(system, "V_Y") .and. &
                        is_conserved(system, "X_0"), "from outside it is free")
        call follow(system, [0.0_dp, t], scene%q, scene%v, q, v)
        z = (cmplx(-1.0_dp, 0.0_dp, dp) + cmplx(1.0_dp, -omega, dp)*t)*exp(cmplx(0.0_dp, -omega*t, &
            dp))
        call assertEqual([real(z), aimag(z)], q(:, 2), near)
        call assertLessThan(q(2, 2), -0.5_dp)
        call open_scene("rotating_frame", &
                        "lagrangian%T='m/2 (x_dot^2 + y_dot^2 + omega^2 (x^2 + y^2))';", &
                        scene, system)
        if (anyExceptions()) return
        call assertFalse(is_conserved(system, "V_X") .or. is_conserved(system, "X_0"), &
                         "no Coriolis force")
        call follow(system, [0.0_dp, t], scene%q, scene%v, q, v)
        call assertEqual(0.0_dp, q(2, 2), near, "it goes straight to the other rim")
    end subroutine turning_frame

    subroutine skate()
        !! Nonholonomic: \(x = 2R\sin^2\omega t\), \(y = R(2\omega t - \sin 2\omega t)\),
        !! \(R = s/(4\omega^2)\), a cycloid sideways; the blade pushes with
        !! \(\lambda = -2ms\sin\omega t\). That does not turn slides down by \(st^2/2\).
        real(dp), parameter :: omega = 1.4_dp, r = 2.0_dp/(4*omega**2), t = 7.3_dp
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        real(dp), allocatable :: q(:, :), v(:, :)

        call open_scene("skate", as_shipped, scene, system)
        if (anyExceptions()) return
        call assertTrue(is_conserved(system, "spin") .and. is_conserved(system, "across"), "kept")
        call assertEqual([0.0_dp, 0.0_dp, omega], scene%v, 0.0_dp, "the velocity of the start")
        call follow(system, [0.0_dp, t], scene%q, scene%v, q, v)
        call assertEqual([2*r*sin(omega*t)**2, r*(2*omega*t - sin(2*omega*t)), omega*t], q(:, 2), &
                         10*near)
        call assertEqual(-4.0_dp*sin(omega*t), value_of(system, "lambda1", t, q(:, 2), v(:, 2)), &
                         1e2_dp*near)
        call follow(system, [0.0_dp, t], scene%q, 0.0_dp*scene%v, q, v)
        call assertEqual([t**2, 0.0_dp, 0.0_dp], q(:, 2), 1e3_dp*near, "without turning")
    end subroutine skate

    subroutine rod()
        !! Holonomic, from rest at \(\cos\theta_0 = 0.6\): \(-2\lambda\ell =
        !! mg(3\cos\theta - 2\cos\theta_0)\) along the motion, which is that of the angle.
        !! \(mg\cos\theta\), without what turns it, is another number.
        real(dp), parameter :: times(3) = [0.0_dp, 0.5_dp, 3.1_dp]
        class(system_t), allocatable :: system, angle
        type(scene_t) :: scene
        real(dp), allocatable :: q(:, :), v(:, :), theta(:, :), theta_dot(:, :)
        real(dp) :: pull
        integer :: i

        call open_scene("pendulum_in_x_and_y", as_shipped, scene, system)
        if (anyExceptions()) return
        call follow(system, times, scene%q, scene%v, q, v)
        call open_scene("pendulum", "pendulum%l=1;pendulum%m=1;pendulum%g=9.81;", scene, angle)
        if (anyExceptions()) return
        call follow(angle, times, [acos(0.6_dp)], [0.0_dp], theta, theta_dot)
        do i = 1, 3
            call assertEqual([sin(theta(1, i)), -cos(theta(1, i))], q(:, i), 10*near, &
                             "the same motion")
            pull = g*(3*cos(theta(1, i)) - 1.2_dp)
            call assertEqual(pull, -2*value_of(system, "lambda1", times(i), q(:, i), v(:, i)), &
                             1e3_dp*near, "the multiplier")
            call assertEqual(pull, value_of(system, "pull", times(i), q(:, i), v(:, i)), &
                             1e3_dp*near)
        end do
        call assertGreaterThan(abs(g*cos(theta(1, 2)) - pull_at(2)), 0.1_dp)
    contains
        function pull_at(k) result(value)
            integer, intent(in) :: k
            real(dp) :: value

            value = value_of(system, "pull", times(k), q(:, k), v(:, k))
        end function pull_at
    end subroutine rod

    subroutine turning_wire()
        !! From rest on the wire \(r = r_0\cosh wt\); the wire pushes with \(2mw\dot r\), and what
        !! it has done is \(m w^2 r_0^2\sinh^2 wt\), which is also the energy that was gained.
        real(dp), parameter :: times(3) = [0.0_dp, 0.7_dp, 1.5_dp], w = 1.2_dp, m = 0.5_dp, &
                               r0 = 0.6_dp
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        real(dp), allocatable :: q(:, :), v(:, :)
        real(dp) :: gained
        integer :: i

        call open_scene("turning_wire", as_shipped, scene, system)
        if (anyExceptions()) return
        call assertFalse(system%conserves_energy(), "the wire does work")
        call follow(system, times, scene%q, scene%v, q, v)
        do i = 1, 3
            associate (t => times(i))
                call assertEqual(r0*cosh(w*t)*[cos(w*t), sin(w*t)], q(:, i), 10*near, "along it")
                call assertEqual(2*m*w**2*r0*sinh(w*t), value_of(system, "lambda1", t, q(:, i), &
                                                                 v(:, i)), 10*near, "the push")
                gained = system%energy(t, q(:, i), v(:, i)) - m/2*(w*r0)**2
                call assertEqual(m*(w*r0*sinh(w*t))**2, gained, 10*near, "its work")
            end associate
        end do
        call open_scene("turning_wire", "turning_wire%w=0;", scene, system)
        if (anyExceptions()) return
        call follow(system, times, scene%q, scene%v, q, v)
        call assertEqual(scene%q, q(:, 3), 0.0_dp, "a wire that stands")
    end subroutine turning_wire

    subroutine foucault()
        !! Let go at rest on the ground, seen by who does not turn: \(x = a\cos\Omega t\), \(y =
        !! a\frac W\Omega\sin\Omega t\), \(\Omega^2 = g/\ell + W^2\), \(W = 2\pi\sin(\lambda)/
        !! \mathrm{day}\). Where it stands after a day is turned by \(-2\pi\sin\lambda\) against
        !! that: not at all on the equator, and not by \(2\pi\).
        real(dp), parameter :: lambda = 48.85_dp*pi/180, day = 60.0_dp, w = 2*pi/day*sin(lambda)
        real(dp), parameter :: rate = sqrt(g/2.0_dp + w**2), a = 0.3_dp
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        real(dp), allocatable :: q(:, :), v(:, :)
        complex(dp) :: z

        call open_scene("foucault", as_shipped, scene, system)
        if (anyExceptions()) return
        call assertTrue(is_conserved(system, "L_z"), "canonical angular momentum")
        call assertFalse(is_conserved(system, "x_still"), "a place")
        call follow(system, [0.0_dp, day], scene%q, scene%v, q, v)
        z = a*cmplx(cos(rate*day), w/rate*sin(rate*day), dp)
        call assertEqual([real(z), aimag(z)], [value_of(system, "x_still", day, q(:, 2), v(:, 2)), &
                         value_of(system, "y_still", day, q(:, 2), v(:, 2))], near, &
                             "who does not turn")
        z = z*exp(cmplx(0.0_dp, -2*pi*sin(lambda), dp))
        call assertEqual([real(z), aimag(z)], q(:, 2), near, "on the ground")
        call assertGreaterThan(abs(q(2, 2) - a*w/rate*sin(rate*day)), 0.05_dp)
        call open_scene("foucault", "foucault%latitude=0;", scene, system)
        if (anyExceptions()) return
        call follow(system, [0.0_dp, day], scene%q, scene%v, q, v)
        call assertEqual([a*cos(sqrt(g/2)*day), 0.0_dp], q(:, 2), near, "on the equator")
    end subroutine foucault
end module test_course_motions
