module test_action
    !! The discrete action, its derivatives and its stationary paths.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertLessThan, assertRelativelyEqual, assertTrue
    use lagrangia_action_paths, only: extrapolated_action, extrapolated_change, &
                                      oscillator_action, oscillator_path, straight, pendulum_path, &
                                      pendulum_period
    use lagrangia_computed_path, only: compute_path
    use lagrangia_discrete_action, only: action_gradient, action_of, expand_action, find_path, &
                                         negative_curvatures
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_rk4, only: new_rk4, rk4_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: action_suite

    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    function action_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("action")
        call suite%addTest(TestMethod("closed_forms", closed_forms))
        call suite%addTest(TestMethod("oscillator_actions", oscillator_actions))
        call suite%addTest(TestMethod("derivatives_are_differences", derivatives_are_differences))
        call suite%addTest(TestMethod("verlet_is_stationary", verlet_is_stationary))
        call suite%addTest(TestMethod("paths_of_two_coordinates", paths_of_two_coordinates))
        call suite%addTest(TestMethod("signs_change_at_conjugate_points", &
                                      signs_change_at_conjugate_points))
        call suite%addTest(TestMethod("hopeless_paths_are_refused", hopeless_paths_are_refused))
        call suite%addTest(TestMethod("paths_start_at_the_start", paths_start_at_the_start))
    end function action_suite

    subroutine build(system, values)
        !! A system of these parameters.
        class(system_t), intent(inout) :: system
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable :: error

        call system%configure(values, error)
        call assertFalse(allocated(error), "parameters")
    end subroutine build

    subroutine closed_forms()
        !! 22-digit arithmetic: the action (m = k = 1, T = 2), the period and swing of 2 rad.
        call assertEqual(-0.835911056622486836_dp, &
                         oscillator_action(1.0_dp, 1.0_dp, 2.0_dp, 1.0_dp, 0.5_dp), 4e-16_dp)
        call assertRelativelyEqual(8.3497529269184947344_dp, pendulum_period(2.0_dp, 1.0_dp), &
                                   4e-15_dp)
        call assertEqual(-1.6841244365668093504_dp, pendulum_path(5.0_dp, 2.0_dp, 1.0_dp), 1e-14_dp)
        call assertEqual(1.532727506038253442_dp, pendulum_path(0.5_dp, 2.0_dp, 4.0_dp), 1e-14_dp)
        call assertEqual(0.7_dp, oscillator_path(0.0_dp, 1.9_dp, 1.3_dp, 0.7_dp, -0.4_dp), 1e-15_dp)
        call assertEqual(-0.4_dp, oscillator_path(1.9_dp, 1.9_dp, 1.3_dp, 0.7_dp, -0.4_dp), &
                         1e-15_dp)
    end subroutine closed_forms

    subroutine oscillator_actions()
        !! To 1e-14 after extrapolation, with numbers unlike 1, also beyond the conjugate point;
        !! the second variation has no other terms.
        type(oscillator_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: action, change

        call build(system, [1.0_dp, 1.0_dp])
        call extrapolated_action(system, 2.0_dp, 1.0_dp, 0.5_dp, action, error)
        call assertFalse(allocated(error), "no error: oscillator actions")
        call assertEqual(-0.835911056622486836_dp, action, 1e-14_dp)
        call build(system, [1.3_dp, 0.7_dp])
        call extrapolated_action(system, 1.7_dp, -0.6_dp, 1.1_dp, action, error)
        call assertEqual(oscillator_action(1.3_dp, 0.7_dp, 1.7_dp, -0.6_dp, 1.1_dp), action, &
                         1e-14_dp)
        call extrapolated_action(system, 5.3_dp, -0.6_dp, 1.1_dp, action, error)
        call assertEqual(oscillator_action(1.3_dp, 0.7_dp, 5.3_dp, -0.6_dp, 1.1_dp), action, &
                         1e-13_dp)
        call extrapolated_change(system, 1.7_dp, -0.6_dp, 1.1_dp, 0.2_dp, change, error)
        call assertEqual(0.25_dp*0.04_dp*(1.3_dp*pi**2/1.7_dp - 0.7_dp*1.7_dp), change, 1e-14_dp)
    end subroutine oscillator_actions

    subroutine derivatives_are_differences()
        !! Two coordinates and a path that is none: gradient and Hessian against fourth-order
        !! differences with a step of 1e-3 (truncation 1e-12 of derivatives that grow as 1/h).
        type(double_pendulum_t) :: system
        real(dp), parameter :: h = 0.1_dp, step = 1e-3_dp
        real(dp) :: path(2, 5), moved(2, 5), expected, row(6)
        real(dp), allocatable :: gradient(:), band(:, :), one(:), two(:), ignored(:, :)
        integer :: i, j

        call build(system, [1.3_dp, 0.7_dp, 0.9_dp, 1.7_dp, 9.81_dp])
        path = reshape([0.1_dp, 0.5_dp, 0.3_dp, 0.2_dp, -0.2_dp, 0.4_dp, 0.5_dp, -0.7_dp, 0.6_dp, &
                        0.1_dp], [2, 5])
        call expand_action(system, 0.3_dp, h, path, gradient, band)
        call assertEqual(6, size(gradient))
        do i = 1, 6
            expected = (8.0_dp*(at(i, step) - at(i, -step)) - at(i, 2.0_dp*step) &
                        + at(i, -2.0_dp*step))/(12.0_dp*step)
            call assertEqual(expected, gradient(i), 1e-8_dp)
            call move(i, 1e-4_dp)
            call expand_action(system, 0.3_dp, h, moved, one, ignored)
            moved = 2.0_dp*path - moved
            call expand_action(system, 0.3_dp, h, moved, two, ignored)
            row = (one - two)/2e-4_dp
            do j = 1, 6
                if (abs(i - j) <= 3) then
                    call assertEqual(row(j), band(4 + i - j, j), 1e-5_dp)
                else
                    call assertEqual(0.0_dp, row(j), 0.0_dp)
                end if
            end do
        end do
    contains
        subroutine move(number, change)
            integer, intent(in) :: number
            real(dp), intent(in) :: change
            integer :: axis, point

            axis = 2 - mod(number, 2)
            point = 2 + (number - axis)/2
            moved = path
            moved(axis, point) = moved(axis, point) + change
        end subroutine move

        function at(number, change) result(s)
            integer, intent(in) :: number
            real(dp), intent(in) :: change
            real(dp) :: s

            call move(number, change)
            s = action_of(system, 0.3_dp, h, moved)
        end function at
    end subroutine derivatives_are_differences

    subroutine verlet_is_stationary()
        !! The velocity form's points obey the discrete principle to rounding (16 roundings of
        !! \(m\ell^2\theta/h^2\)); those of the position form half a step on, where it kicks, and
        !! not at whole steps; with another step in L none do.
        type(pendulum_t) :: system
        type(error_t), allocatable :: error
        real(dp), parameter :: h = 0.05_dp
        real(dp) :: q(1, 200), v(1, 200), points(1, 200), rounding

        call build(system, [1.3_dp, 0.7_dp, 9.81_dp])
        call compute_path("verlet", system, 0.0_dp, h, [0.4_dp], [5.0_dp], q, v, error)
        call assertFalse(allocated(error), "no error: verlet is stationary")
        rounding = 16.0_dp*epsilon(h)*1.3_dp*0.49_dp*maxval(abs(q))/h**2
        call assertLessThan(action_gradient(system, 0.0_dp, h, q + 0.5_dp*h*v), rounding)
        call compute_path("velocity_verlet", system, 0.0_dp, h, [0.4_dp], [5.0_dp], points, v, &
                          error)
        call assertFalse(allocated(error), "no error: verlet is stationary")
        call assertLessThan(action_gradient(system, 0.0_dp, h, points), rounding)
        call assertGreaterThan(action_gradient(system, 0.0_dp, h, q), 1e9_dp*rounding)
        call assertGreaterThan(action_gradient(system, 0.0_dp, 1.001_dp*h, points), &
                               1e9_dp*rounding)
    end subroutine verlet_is_stationary

    subroutine paths_of_two_coordinates()
        !! The double pendulum between two points of a computed motion: that motion is found, from
        !! a straight line, with an error of order 2.
        type(double_pendulum_t) :: system
        type(error_t), allocatable :: error
        real(dp), parameter :: time = 0.4_dp
        real(dp) :: q(2, 801), v(2, 801), away(3)
        real(dp), allocatable :: path(:, :)
        integer :: i, n

        call build(system, [1.3_dp, 0.7_dp, 0.9_dp, 1.7_dp, 9.81_dp])
        call compute_path("rk4", system, 0.0_dp, time/800.0_dp, [1.2_dp, -0.7_dp], &
                          [0.5_dp, 1.5_dp], q, v, error)
        call assertFalse(allocated(error), "no error: paths of two coordinates")
        do i = 1, 3
            n = 25*2**(i - 1)
            allocate (path(2, n + 1))
            path(1:1, :) = straight(q(1, 1), q(1, 801), n)
            path(2:2, :) = straight(q(2, 1), q(2, 801), n)
            call find_path(system, 0.0_dp, time/n, path, error)
            call assertFalse(allocated(error), "no error: paths of two coordinates")
            if (anyExceptions()) return
            away(i) = maxval(abs(path - q(:, ::800/n)))
            deallocate (path)
        end do
        call assertLessThan(away(1), 1e-3_dp)
        call assertEqual(4.0_dp, away(1)/away(2), 0.1_dp)
        call assertEqual(4.0_dp, away(2)/away(3), 0.05_dp)
    end subroutine paths_of_two_coordinates

    subroutine signs_change_at_conjugate_points()
        !! One per cent before and after each of the first three; the chain's own conjugate points,
        !! \(\omega_dT = n\pi\) with \(\omega_d = (2/h)\arcsin(\omega h/2)\), are nearer than that.
        type(oscillator_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: time
        integer, parameter :: n = 200
        integer :: i, before, after

        call build(system, [1.3_dp, 0.7_dp])
        do i = 1, 3
            time = i*pi/sqrt(0.7_dp/1.3_dp)
            call negative_curvatures(system, 0.0_dp, 0.99_dp*time/n, straight(0.0_dp, 1.0_dp, n), &
                                     before, error)
            call assertFalse(allocated(error), "no error: signs change at conjugate points")
            call negative_curvatures(system, 0.0_dp, 1.01_dp*time/n, straight(0.0_dp, 1.0_dp, n), &
                                     after, error)
            call assertEqual(i - 1, before)
            call assertEqual(i, after)
        end do
    end subroutine signs_change_at_conjugate_points

    subroutine hopeless_paths_are_refused()
        !! Two points of an oscillator so coarse that their Hessian vanishes: a conjugate point; a
        !! guess far from any motion. The guess is as it was.
        type(oscillator_t) :: system
        type(pendulum_t) :: pendulum
        type(error_t), allocatable :: error
        real(dp), allocatable :: path(:, :), guess(:, :)
        integer :: i

        call build(pendulum, [1.0_dp, 1.0_dp, 9.81_dp])
        allocate (guess, source=straight(1.0_dp, 2.0_dp, 40))
        guess(1, 2:40) = [((-1)**i*(3.0_dp + i), i=2, 40)]
        path = guess
        call find_path(pendulum, 0.0_dp, 0.25_dp, path, error)
        call assertTrue(allocated(error), "hopeless")
        if (anyExceptions()) return
        call assertEqual("path between two points: Newton's method does not converge", &
                         error%message)
        call assertEqual(guess, path, message="a guess as it was")
        deallocate (path)
        call build(system, [1.0_dp, 2.0_dp])
        allocate (path, source=straight(1.0_dp, 2.0_dp, 2))
        call find_path(system, 0.0_dp, 1.0_dp, path, error)
        call assertTrue(allocated(error), "an error: hopeless paths are refused")
        if (anyExceptions()) return
        call assertEqual("path between two points: band system: the matrix is singular", &
                         error%message)
        call assertEqual(straight(1.0_dp, 2.0_dp, 2), path, message="a guess as it was")
    end subroutine hopeless_paths_are_refused

    subroutine paths_start_at_the_start()
        !! Sample 1 is the start, sample 2 one step on, also where the time matters; an unknown
        !! method is refused.
        type(oscillator_t) :: system
        type(error_t), allocatable :: error
        type(driven_pendulum_t) :: driven
        type(rk4_t) :: rk4
        real(dp) :: q(1, 3), v(1, 3), angle(1), rate(1)

        call build(system, [1.0_dp, 4.0_dp])
        call compute_path("rk4", system, 0.0_dp, 0.01_dp, [0.3_dp], [0.7_dp], q, v, error)
        call assertFalse(allocated(error), "no error: paths start at the start")
        call assertEqual([0.3_dp, 0.3_dp*cos(0.02_dp) + 0.35_dp*sin(0.02_dp), &
                          0.3_dp*cos(0.04_dp) + 0.35_dp*sin(0.04_dp)], q(1, :), 1e-9_dp)
        call driven%configure([0.5_dp, 0.8_dp, 9.81_dp, 0.1_dp, 5.0_dp], error)
        call assertFalse(allocated(error), "no error: paths start at the start")
        call compute_path("rk4", driven, 0.3_dp, 0.05_dp, [0.3_dp], [0.7_dp], q, v, error)
        call new_rk4(rk4)
        call rk4%prepare(driven, error)
        angle = 0.3_dp
        rate = 0.7_dp
        call rk4%start(driven, 0.3_dp, angle, rate)
        call rk4%advance(driven, 0.3_dp, 0.05_dp, 0_i8, 2_i8, angle, rate)
        call assertEqual([angle(1), rate(1)], [q(1, 3), v(1, 3)], 0.0_dp)
        call compute_path("rk5", system, 0.0_dp, 0.01_dp, [0.3_dp], [0.7_dp], q, v, error)
        call assertTrue(allocated(error), "an error: paths start at the start")
    end subroutine paths_start_at_the_start
end module test_action
