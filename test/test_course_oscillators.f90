module test_course_oscillators
    !! The course's oscillators, shipped as formulas in scenes, against their closed forms, each
    !! with what must not hold.
    !!
    !! A step errs by some \(10^{-13}\), which oscillations add up linearly: \(10^{-10}\) is left
    !! for the hundreds of steps of a run, times the size of what moves.
    use course_runs, only: follow, is_conserved, modes_of, open_scene, value_of
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertLessThan, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_recorder, only: recorder_t
    use lagrangia_scene, only: scene_t
    use lagrangia_small_oscillations, only: modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: course_oscillators_suite

    real(dp), parameter :: pi = acos(-1.0_dp), near = 1e-10_dp
    character(*), parameter :: as_shipped = ""

contains

    function course_oscillators_suite() result(suite)
        type(TestSuite) :: suite

        suite = TestSuite("course_oscillators")
        call suite%addTest(TestMethod("two coupled oscillators beat", beats))
        call suite%addTest(TestMethod("beads on a string with fixed ends", string))
        call suite%addTest(TestMethod("a spring gives its energy to the pendulum", exchange))
        call suite%addTest(TestMethod("Duffing's period", duffing_period))
        call suite%addTest(TestMethod("Duffing's chaos", duffing_chaos))
    end function course_oscillators_suite

    subroutine beats()
        !! \(x_{1,2} = \tfrac A2(\cos\omega_1t \pm \cos\omega_2t)\): after \(\pi/(\omega_2 -
        !! \omega_1)\) the energy is in the right mass. Each mode keeps its own, as long as both
        !! masses and both outer springs are alike.
        real(dp), parameter :: k = 10.0_dp, k_c = 1.0_dp, omega(2) = sqrt([k, k + 2*k_c])
        real(dp), parameter :: over = pi/(omega(2) - omega(1))
        real(dp), parameter :: times(4) = [0.0_dp, 3.3_dp, over, 60.0_dp]
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(modes_t) :: modes
        real(dp), allocatable :: q(:, :), v(:, :)
        real(dp) :: c(2)
        integer :: i

        call open_scene("coupled_oscillators", as_shipped, scene, system)
        if (anyExceptions()) return
        call modes_of(system, modes)
        call assertEqual(omega**2, modes%omega2, 1e2_dp*epsilon(k)*k, "omega^2")
        call follow(system, times, scene%q, scene%v, q, v)
        do i = 1, 4
            c = cos(omega*times(i))
            call assertEqual(0.15_dp*[c(1) + c(2), c(1) - c(2)], q(:, i), near, "motion")
        end do
        call assertLessThan(value_of(system, "E_left", 0.0_dp, q(:, 3), v(:, 3)) &
                            /value_of(system, "E_right", 0.0_dp, q(:, 3), v(:, 3)), 0.01_dp)
        call assertTrue(is_conserved(system, "H_1") .and. is_conserved(system, "H_2"), "modes")
        call assertFalse(is_conserved(system, "E_left") .or. is_conserved(system, "E_right"), &
                         "masses")
        call open_scene("coupled_oscillators", &
                        "lagrangian%V='1.2 k/2 x1^2 + k/2 x2^2 + k_c/2 (x2 - x1)^2';", scene, &
                            system)
        if (anyExceptions()) return
        call assertFalse(is_conserved(system, "H_1") .or. is_conserved(system, "H_2"), &
                         "with unequal springs these are no modes")
        call follow(system, times, scene%q, scene%v, q, v)
        call assertGreaterThan(value_of(system, "E_left", 0.0_dp, q(:, 3), v(:, 3)) &
                               /value_of(system, "E_right", 0.0_dp, q(:, 3), v(:, 3)), 0.5_dp)
    end subroutine beats

    subroutine string()
        !! \(\omega_j = 2\sqrt{F/(md)}\sin(j\pi/12)\), shapes \(\sin(ij\pi/6)\), and from them the
        !! motion from any start. With the right end free \(\omega_j\) has \((2j - 1)\pi/22\).
        real(dp), parameter :: rate = sqrt(0.5_dp/(0.01_dp*0.2_dp)), t = 7.7_dp
        real(dp), parameter :: free_end = 1e-11_dp
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(modes_t) :: modes
        real(dp), allocatable :: q(:, :), v(:, :)
        real(dp) :: expected(5), omega(5), shape(5)
        integer :: i, j

        call open_scene("beads_on_a_string", as_shipped, scene, system)
        if (anyExceptions()) return
        omega = [(2*rate*sin(j*pi/12), j=1, 5)]
        call modes_of(system, modes)
        call assertEqual(omega**2, modes%omega2, 1e2_dp*epsilon(rate)*omega(5)**2, "omega^2")
        call follow(system, [0.0_dp, t], scene%q, scene%v, q, v)
        expected = 0.0_dp
        do j = 1, 5
            shape = [(sin(i*j*pi/6), i=1, 5)]
            expected = expected + shape*dot_product(shape, scene%q)/3*cos(omega(j)*t)
        end do
        call assertEqual(expected, q(:, 2), near)
        do j = 1, 5
            shape = [(sin(i*j*pi/6), i=1, 5)]
            call assertEqual(dot_product(shape, scene%q)/3*cos(omega(j)*t), &
                             value_of(system, "A_"//to_text(j), t, q(:, 2), v(:, 2)), near)
        end do
        call open_scene("beads_on_a_string", "lagrangian%V='F/(2 d) (y_1^2 + "// &
                        "sum(i, 1, 4, (y_(i + 1) - y_i)^2))';", scene, system)
        if (anyExceptions()) return
        call modes_of(system, modes)
        call assertEqual([((2*rate*sin((2*j - 1)*pi/22))**2, j=1, 5)], modes%omega2, &
                         free_end*omega(5)**2, "with a free end")
        call assertGreaterThan(abs(modes%omega2(1)/omega(1)**2 - 1.0_dp), 0.5_dp)
    end subroutine string

    subroutine exchange()
        !! At \(k/m = 4g/\ell\) the equation of a small angle beside \(s = a\cos 2\omega t\),
        !! \(\ddot\theta + \omega^2\theta = \omega^2\theta s/\ell - 2\dot s\dot\theta/\ell\), has a
        !! solution that grows as \(e^{\kappa t}\), \(\kappa = \tfrac34\omega a/\ell\), right to
        !! \(O(a/\ell)\) of it; its phase is \(\pi/4\). With another spring nothing grows. In the
        !! scene the pendulum gets nine tenths of the energy.
        real(dp), parameter :: omega = sqrt(9.81_dp), a = 0.01_dp, small = 1e-7_dp
        real(dp), parameter :: kappa = 0.75_dp*omega*a, t = 32*pi/omega
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(modes_t) :: modes
        real(dp) :: growth

        call open_scene("spring_resonance", as_shipped, scene, system)
        if (anyExceptions()) return
        call modes_of(system, modes)
        call assertEqual([omega**2, 4*omega**2], modes%omega2, 1e3_dp*epsilon(a)*omega**2)
        growth = grown()
        call assertEqual(kappa*t, growth, 2*a*kappa*t, "growth")
        call assertGreaterThan(most(), 0.9_dp, message="the energy goes over")
        call open_scene("spring_resonance", "spring_pendulum%k=60;", scene, system)
        if (anyExceptions()) return
        growth = grown()
        call assertLessThan(abs(growth), 0.1_dp*kappa*t, message="no growth")
        call assertLessThan(most(), 0.1_dp, message="the energy stays")
    contains
        function grown() result(log_ratio)
            !! Of the amplitude of a small angle in t, at times when the spring is where it began.
            real(dp) :: log_ratio
            real(dp), allocatable :: q(:, :), v(:, :)
            real(dp) :: q0(2), v0(2)

            q0 = [scene%q(1) - 0.1_dp + a, small*cos(pi/4)]
            if (scene%parameters(2) > 50.0_dp) q0(1) = 0.75_dp + 9.81_dp/60.0_dp + a
            v0 = [0.0_dp, -small*omega*sin(pi/4)]
            call follow(system, [0.0_dp, t], q0, v0, q, v)
            log_ratio = 0.5_dp*log(swing(q(:, 2), v(:, 2))/swing(q0, v0))
        end function grown

        function swing(q, v) result(energy)
            real(dp), intent(in) :: q(:), v(:)
            real(dp) :: energy

            energy = value_of(system, "E_swing", 0.0_dp, q, v)
        end function swing

        function most() result(part)
            !! The largest part of the energy that the pendulum has in a minute.
            real(dp) :: part
            real(dp), allocatable :: q(:, :), v(:, :)
            integer :: i

            call follow(system, [(0.1_dp*i, i=0, 600)], scene%q, scene%v, q, v)
            part = 0.0_dp
            do i = 1, 601
                part = max(part, swing(q(:, i), v(:, i)))
            end do
            part = part/(swing(q(:, 1), v(:, 1)) + value_of(system, "E_spring", 0.0_dp, q(:, 1), &
                v(:, 1)))
        end function most
    end subroutine exchange

    subroutine duffing_period()
        !! Without drive and damping, from rest at A with a stiffness a > 0:
        !! \(T = 4K(k)/\Omega = 2\pi/(\Omega\,\mathrm{agm}(1, \sqrt{1 - k^2}))\),
        !! \(\Omega^2 = (a + cA^2)/m\), \(k^2 = cA^2/(2(a + cA^2))\). Without c it is the same for
        !! every A. In one of two wells the small oscillations have \(-2a/m\).
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(modes_t) :: modes
        real(dp), parameter :: a = 2.0_dp, c = 3.0_dp, m = 1.5_dp
        real(dp), parameter :: far = 1.7_dp, other = 0.4_dp

        call open_scene("duffing", "duffing%b=0;duffing%f=0;", scene, system)
        if (anyExceptions()) return
        call modes_of(system, modes)
        call assertEqual([1.0_dp], modes%at, 4*epsilon(a), "in a well")
        call assertEqual([2.0_dp], modes%omega2, 1e2_dp*epsilon(a), "omega^2")
        call open_scene("duffing", &
                        "duffing%b=0;duffing%f=0;duffing%a=2;duffing%c=3;duffing%m=1.5;"// &
                        "lagrangian%equilibrium='0';", scene, system)
        if (anyExceptions()) return
        call assertEqual(closed(far), measured(far), 10*near)
        call assertEqual(closed(other), measured(other), 10*near)
        call assertGreaterThan(closed(other) - closed(far), 1.0_dp)
        call open_scene("duffing", &
                        "duffing%b=0;duffing%f=0;duffing%a=2;duffing%c=0;duffing%m=1.5;"// &
                        "lagrangian%equilibrium='0';", scene, system)
        if (anyExceptions()) return
        call assertEqual(2*pi*sqrt(m/a), measured(far), 10*near, "of a linear spring")
        call assertEqual(2*pi*sqrt(m/a), measured(other), 10*near, "of a linear spring")
    contains
        pure function closed(amplitude) result(period)
            real(dp), intent(in) :: amplitude
            real(dp) :: period
            real(dp) :: x, y, next
            integer :: i

            x = 1.0_dp
            y = sqrt(1.0_dp - c*amplitude**2/(2*(a + c*amplitude**2)))
            do i = 1, 8  ! the arithmetic-geometric mean: digits double
                next = 0.5_dp*(x + y)
                y = sqrt(x*y)
                x = next
            end do
            period = 2*pi/(sqrt((a + c*amplitude**2)/m)*x)
        end function closed

        function measured(amplitude) result(period)
            real(dp), intent(in) :: amplitude
            real(dp) :: period
            type(recorder_t) :: found
            real(dp), allocatable :: q(:, :), v(:, :)

            period = 0.0_dp
            call follow(system, [0.0_dp, 20.0_dp], [amplitude], [0.0_dp], q, v, &
                        ["x_dot = 0 falling"], found)
            call assertTrue(found%events > 1, "it comes back twice")
            if (found%events > 1) period = found%event_t(2) - found%event_t(1)
        end function measured
    end subroutine duffing_period

    subroutine duffing_chaos()
        !! Two starts \(10^{-8}\) apart are a thousand times as far apart after 20 periods of the
        !! drive. With a weak drive they come together, for the damping shrinks every volume of
        !! phase space as \(e^{-bt/m}\) and nothing pulls it out.
        real(dp), parameter :: t = 40*pi, apart = 1e-8_dp
        class(system_t), allocatable :: system
        type(scene_t) :: scene

        call open_scene("duffing", as_shipped, scene, system)
        if (anyExceptions()) return
        call assertGreaterThan(distance(), 1e3_dp*apart)
        call open_scene("duffing", "duffing%f=0.1;", scene, system)
        if (anyExceptions()) return
        call assertLessThan(distance(), 1e-3_dp*apart)
    contains
        function distance() result(d)
            real(dp) :: d
            real(dp), allocatable :: q(:, :), v(:, :), other_q(:, :), other_v(:, :)

            call follow(system, [0.0_dp, t], [1.0_dp], [0.0_dp], q, v)
            call follow(system, [0.0_dp, t], [1.0_dp + apart], [0.0_dp], other_q, other_v)
            d = norm2([q(:, 2) - other_q(:, 2), v(:, 2) - other_v(:, 2)])
        end function distance
    end subroutine duffing_chaos
end module test_course_oscillators
