module test_rolling_disk_reference
    !! The closed form of the rolling disk: circle, straight line, sideways drift.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertLessThanOrEqual, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    use lagrangia_rolling_disk, only: rolling_disk_t
    use random_states, only: draw_parameters, draw_state, restart_random, uniform
    use reference_checks, only: check_reference
    use rk4_checks, only: check_against_rk4
    implicit none (type, external)
    private
    public :: rolling_disk_reference_suite

    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    function rolling_disk_reference_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("rolling_disk_reference")
        call suite%addTest(TestMethod("orbit_is_the_centre_of_the_circle", &
                                      orbit_is_the_centre_of_the_circle))
        call suite%addTest(TestMethod("reference_gives_the_notes_circle", &
                                      reference_gives_the_notes_circle))
        call suite%addTest(TestMethod("reference_is_the_textbook_form", &
                                      reference_is_the_textbook_form, setUp=restart_random))
        call suite%addTest(TestMethod("reference_obeys_the_equations", &
                                      reference_obeys_the_equations, setUp=restart_random))
        call suite%addTest(TestMethod("incline_drifts_sideways", incline_drifts_sideways))
        call suite%addTest(TestMethod("slow_steering_loses_no_digits", &
                                      slow_steering_loses_no_digits))
        call suite%addTest(TestMethod("slipping_start_has_no_reference", &
                                      slipping_start_has_no_reference))
    end function rolling_disk_reference_suite

    subroutine build(disk, m, r, i_roll, i_yaw, g, incline)
        !! A disk of these parameters.
        type(rolling_disk_t), intent(out) :: disk
        real(dp), intent(in) :: m, r, i_roll, i_yaw, g, incline
        type(error_t), allocatable :: error

        call disk%configure([m, r, i_roll, i_yaw, g, incline], error)
        call assertFalse(allocated(error), "parameters of the disk")
    end subroutine build

    subroutine build_uniform(disk, m, r, incline)
        !! A uniform disk.
        type(rolling_disk_t), intent(out) :: disk
        real(dp), intent(in) :: m, r, incline
        real(dp) :: nan

        nan = ieee_value(nan, ieee_quiet_nan)
        call build(disk, m, r, nan, nan, 9.81_dp, incline)
    end subroutine build_uniform

    subroutine orbit_is_the_centre_of_the_circle()
        !! (orbit_x, orbit_y)/theta_dot^2 = (x0 + rho cos(theta0), y0 + rho sin(theta0)), and
        !! the disk stays at the distance rho = R phi_dot/theta_dot from there.
        type(rolling_disk_t) :: disk
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        real(dp) :: q(4), v(4), centre(2), rho
        integer :: i

        call build_uniform(disk, 1.7_dp, 0.3_dp, 0.0_dp)
        q = [0.4_dp, -0.5_dp, 0.0_dp, 0.7_dp]
        rho = 0.3_dp*4.0_dp/1.1_dp
        call disk%complete_velocities(0.0_dp, q, [4.0_dp, 1.1_dp], v, error)
        centre = [disk%quantity(4, 3.0_dp, q, v), disk%quantity(5, 3.0_dp, q, v)]/1.1_dp**2
        call assertEqual(q(1:2) + rho*[cos(0.7_dp), sin(0.7_dp)], centre, 1e-14_dp)
        call disk%closed_form(0.0_dp, q, v, reference)
        do i = 1, 10
            call reference%state_at(i*0.7_dp, q, v)
            call assertEqual(rho, norm2(q(1:2) - centre), 1e-14_dp)
        end do
    end subroutine orbit_is_the_centre_of_the_circle

    subroutine reference_gives_the_notes_circle()
        !! Oracle of 22-digit arithmetic: R = 0.3, Omega = 4, omega = 1.1, theta0 = 0.7, t = 2.
        type(rolling_disk_t) :: disk
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        real(dp) :: q(4), v(4)

        call build_uniform(disk, 1.7_dp, 0.3_dp, 0.0_dp)
        q = [0.0_dp, 0.0_dp, 0.0_dp, 0.7_dp]
        call disk%complete_velocities(5.0_dp, q, [4.0_dp, 1.1_dp], v, error)
        call disk%closed_form(5.0_dp, q, v, reference)
        call assertTrue(allocated(reference), "found")
        call reference%state_at(7.0_dp, q, v)
        call assertEqual([1.89360038447354067_dp, 0.441783663298591337_dp, 8.0_dp, 2.9_dp], q, &
                         4e-15_dp)
    end subroutine reference_gives_the_notes_circle

    subroutine reference_is_the_textbook_form()
        !! The form that divides by omega, on inclines, where omega is not small.
        type(rolling_disk_t) :: disk
        class(reference_t), allocatable :: reference
        real(dp), allocatable :: q0(:), v0(:)
        real(dp) :: t0, t, q(4), v(4), roll1, kappa, theta
        integer :: i

        do i = 1, 40
            call draw_parameters(disk, edges=.false.)
            call draw_state(disk, t0, q0, v0)
            v0(4) = sign(1.0_dp + abs(v0(4)), v0(4))
            call disk%closed_form(t0, q0, v0, reference)
            t = uniform(-5.0_dp, 5.0_dp)
            call reference%state_at(t0 + t, q, v)
            kappa = disk%m*disk%g*sin(disk%incline)*disk%r/(disk%i_roll + disk%m*disk%r**2)
            associate (r => disk%r, w => v0(4), theta0 => q0(4))
                theta = theta0 + w*t
                roll1 = v0(3) + kappa/w*cos(theta0)
                call assertEqual(q0(1) - r*roll1/w*(cos(theta) - cos(theta0)) + r*kappa/(4*w**2) &
                                 *(cos(2*theta) - cos(2*theta0)), q(1), 1e-13_dp, "x")
                call assertEqual(q0(2) - r*roll1/w*(sin(theta) - sin(theta0)) + r*kappa/w &
                                 *(t/2 + (sin(2*theta) - sin(2*theta0))/(4*w)), q(2), 1e-13_dp, "y")
                call assertEqual(q0(3) + roll1*t - kappa/w**2*(sin(theta) - sin(theta0)), q(3), &
                                 1e-13_dp, "phi")
                call assertEqual(v0(3) - kappa/w*(cos(theta) - cos(theta0)), v(3), 1e-13_dp, &
                                 "phi_dot")
                call assertEqual(0.5_dp*(disk%i_roll + disk%m*r**2) &
                                 *(v(3)**2 - v0(3)**2), &
                                 disk%m*disk%g*sin(disk%incline)*(q(1) - q0(1)), 1e-11_dp, "energy")
            end associate
        end do
    end subroutine reference_is_the_textbook_form

    subroutine reference_obeys_the_equations()
        !! Level, inclined, vertical; steering fast, slowly and not at all.
        type(rolling_disk_t) :: disk
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:)
        real(dp), parameter :: steering(4) = [2.3_dp, -0.4_dp, 1e-7_dp, 0.0_dp]
        real(dp) :: t
        integer :: i

        do i = 1, 40
            call draw_parameters(disk, edges=mod(i, 2) == 0)
            if (mod(i, 3) == 0) disk%incline = 0.0_dp
            call draw_state(disk, t, q, v)
            call disk%complete_velocities(t, q, [v(3), steering(1 + mod(i, 4))], v, error)
            call disk%closed_form(t, q, v, reference)
            call assertTrue(allocated(reference), "found")
            call check_reference(reference, disk, t, q, v, "disk")
            if (anyExceptions()) return
        end do
    end subroutine reference_obeys_the_equations

    subroutine incline_drifts_sideways()
        !! After n turns the disk is as high as it was, and n times pi R kappa/omega^2 aside.
        type(rolling_disk_t) :: disk
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        real(dp) :: q0(4), v0(4), q(4), v(4), drift, lowest
        integer :: n

        call build_uniform(disk, 1.7_dp, 0.3_dp, 0.4_dp)
        q0 = [0.2_dp, -0.6_dp, 0.1_dp, 0.7_dp]
        call disk%complete_velocities(0.0_dp, q0, [0.9_dp, 1.3_dp], v0, error)
        call disk%closed_form(0.0_dp, q0, v0, reference)
        associate (kappa => 9.81_dp*sin(0.4_dp)/(1.5_dp*0.3_dp))
            drift = pi*0.3_dp*kappa/1.3_dp**2
            lowest = 0.0_dp
            do n = 1, 50
                call reference%state_at(n*2.0_dp*pi/1.3_dp, q, v)
                call assertEqual(q0(1), q(1), n*1e-13_dp, "as high as before")
                call assertEqual(q0(2) + n*drift, q(2), n*1e-13_dp, "aside")
                call reference%state_at(n*0.37_dp, q, v)
                lowest = max(lowest, q(1))
            end do
            call assertLessThanOrEqual( &
                lowest - q0(1), 0.6_dp*(0.9_dp + kappa/1.3_dp*cos(0.7_dp))/1.3_dp &
                + 0.15_dp*kappa/1.3_dp**2, message="never runs downhill")
        end associate
    end subroutine incline_drifts_sideways

    subroutine slow_steering_loses_no_digits()
        !! omega from 1e-300 to 1e-3 against rk4, which knows no limit, and against omega = 0:
        !! the state's derivative with respect to omega is below 100 here.
        type(rolling_disk_t) :: disk
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        real(dp) :: q0(4), v0(4), q(4), v(4), straight(4), omega
        integer :: i, k

        q0 = [0.2_dp, -0.6_dp, 0.1_dp, 0.7_dp]
        do i = 0, 1
            call build_uniform(disk, 1.7_dp, 0.3_dp, 0.4_dp*i)
            call disk%complete_velocities(0.0_dp, q0, [0.9_dp, 0.0_dp], v0, error)
            call disk%closed_form(0.0_dp, q0, v0, reference)
            call reference%state_at(2.0_dp, straight, v)
            associate (path => 0.9_dp*2.0_dp + i*2.0_dp*9.81_dp*sin(0.4_dp)/0.45_dp*sin(0.7_dp))
                call assertEqual(q0 + path*[0.3_dp*sin(0.7_dp), -0.3_dp*cos(0.7_dp), 1.0_dp, &
                                            0.0_dp], straight, 1e-14_dp, "a straight line")
            end associate
            do k = 3, 13
                omega = 10.0_dp**(-k)
                if (k == 13) omega = 1e-300_dp
                call disk%complete_velocities(0.0_dp, q0, [0.9_dp, omega], v0, error)
                call disk%closed_form(0.0_dp, q0, v0, reference)
                call check_against_rk4(reference, disk, q0, v0, 2.0_dp, "omega -> 0")
                call reference%state_at(2.0_dp, q, v)
                call assertLessThanOrEqual(maxval(abs(q - straight)), 100.0_dp*omega + 1e-14_dp, &
                                           message="omega -> 0")
            end do
        end do
    end subroutine slow_steering_loses_no_digits

    subroutine slipping_start_has_no_reference()
        !! The closed form is that of rolling.
        type(rolling_disk_t) :: disk
        class(reference_t), allocatable :: reference

        call build_uniform(disk, 1.7_dp, 0.3_dp, 0.0_dp)
        call disk%closed_form(0.0_dp, [0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], &
                              [0.1_dp, -0.3_dp, 1.0_dp, 2.0_dp], reference)
        call assertFalse(allocated(reference), "not allocated(reference)")
    end subroutine slipping_start_has_no_reference
end module test_rolling_disk_reference
