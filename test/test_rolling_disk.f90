module test_rolling_disk
    !! The rolling disk: its constraint, its friction, what it conserves.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertLessThanOrEqual, assertTrue
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian, euler_lagrange_t, expand_lagrangian
    use lagrangia_rolling_disk, only: rolling_disk_t
    use lagrangia_system, only: default_values
    use motion, only: flow_derivative
    use random_states, only: draw_parameters, draw_state, restart_random, uniform
    implicit none (type, external)
    private
    public :: rolling_disk_suite

    real(dp), parameter :: pi = acos(-1.0_dp)
    real(dp), parameter :: rounding = 500.0_dp*epsilon(1.0_dp)  !! as in `system_checks`
    real(dp), parameter :: differencing = 1e-10_dp              !! as in `system_checks`

contains

    function rolling_disk_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("rolling_disk")
        call suite%addTest(TestMethod("moments_of_inertia_have_defaults", &
                                      moments_of_inertia_have_defaults))
        call suite%addTest(TestMethod("two_velocities_are_completed", &
                                      two_velocities_are_completed, setUp=restart_random))
        call suite%addTest(TestMethod("velocities_that_slip_are_refused", &
                                      velocities_that_slip_are_refused))
        call suite%addTest(TestMethod("constraint_is_not_integrable", constraint_is_not_integrable))
        call suite%addTest(TestMethod("friction_is_the_multiplier", friction_is_the_multiplier, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("level_friction_is_the_centripetal_force", &
                                      level_friction_is_the_centripetal_force))
        call suite%addTest(TestMethod("level_conserves_p_phi_not_p_x", &
                                      level_conserves_p_phi_not_p_x, setUp=restart_random))
        call suite%addTest(TestMethod("incline_does_not_conserve_p_phi", &
                                      incline_does_not_conserve_p_phi, setUp=restart_random))
        call suite%addTest(TestMethod("p_phi_is_of_the_rolling_disk", &
                                      p_phi_is_of_the_rolling_disk))
        call suite%addTest(TestMethod("p_theta_is_the_momentum", p_theta_is_the_momentum, &
                                      setUp=restart_random))
    end function rolling_disk_suite

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

    subroutine moments_of_inertia_have_defaults()
        !! Those of a uniform disk where not given; what is given is kept, also zero.
        type(rolling_disk_t) :: disk
        type(description_t) :: d
        real(dp) :: nan

        nan = ieee_value(nan, ieee_quiet_nan)
        call disk%describe(d)
        call assertEqual("m r^2/2", trim(d%parameters(3)%computed))
        call assertEqual("m r^2/4", trim(d%parameters(4)%computed))
        call build(disk, 1.7_dp, 0.6_dp, nan, nan, 9.81_dp, 0.0_dp)
        call disk%describe(d)
        call assertEqual([1.7_dp, 0.6_dp, 0.306_dp, 0.153_dp, 9.81_dp, 0.0_dp], &
                         default_values(d), 1e-15_dp)
        call build(disk, 1.7_dp, 0.6_dp, 0.0_dp, nan, 9.81_dp, 0.0_dp)
        call assertEqual(0.0_dp, disk%i_roll)
        call assertEqual(0.153_dp, disk%i_yaw, 1e-16_dp)
        call build(disk, 1.7_dp, 0.6_dp, nan, 0.4_dp, 9.81_dp, 0.0_dp)
        call assertEqual(0.306_dp, disk%i_roll, 1e-16_dp)
        call assertEqual(0.4_dp, disk%i_yaw)
    end subroutine moments_of_inertia_have_defaults

    subroutine two_velocities_are_completed()
        !! phi_dot and theta_dot, in this order; and all four of them are accepted back.
        type(rolling_disk_t) :: disk
        type(error_t), allocatable :: error
        real(dp) :: q(4), v(4), again(4)
        integer :: i

        call build_uniform(disk, 1.7_dp, 0.6_dp, 0.2_dp)
        call disk%complete_velocities(0.0_dp, [0.0_dp, 0.0_dp, 0.0_dp, pi/6.0_dp], &
                                      [2.0_dp, 3.0_dp], v, error)
        call assertFalse(allocated(error), "no error: two velocities are completed")
        call assertEqual([0.6_dp, -0.6_dp*sqrt(3.0_dp), 2.0_dp, 3.0_dp], v, 1e-15_dp)
        call restart_random()
        do i = 1, 200
            q = [uniform(-9.0_dp, 9.0_dp), uniform(-9.0_dp, 9.0_dp), uniform(-1e3_dp, 1e3_dp), &
                 uniform(-1e3_dp, 1e3_dp)]
            call disk%complete_velocities(0.0_dp, q, [uniform(-5.0_dp, 5.0_dp), 1.1_dp], v, error)
            call disk%complete_velocities(0.0_dp, q, v, again, error)
            call assertFalse(allocated(error), "velocities that roll are accepted")
            call assertEqual(v, again, message="and kept")
            if (anyExceptions()) return
        end do
        call disk%complete_velocities(0.0_dp, q, [0.0_dp, 0.0_dp, 0.0_dp, 2.0_dp], v, error)
        call assertFalse(allocated(error), "it may turn on the spot")
    end subroutine two_velocities_are_completed

    subroutine velocities_that_slip_are_refused()
        !! The message names the residual; a wrong count is refused.
        type(rolling_disk_t) :: disk
        type(error_t), allocatable :: error
        real(dp) :: q(4), v(4)

        call build_uniform(disk, 1.7_dp, 0.5_dp, 0.0_dp)
        q = 0.0_dp
        call disk%complete_velocities(0.0_dp, q, [0.25_dp, -1.0_dp, 2.0_dp, 3.0_dp], v, error)
        call refused("v does not roll: x_dot - r sin(theta) phi_dot = 0.25, not 0;")
        call disk%complete_velocities(0.0_dp, q, [0.0_dp, -0.75_dp, 2.0_dp, 3.0_dp], v, error)
        call refused("v does not roll: y_dot + r cos(theta) phi_dot = 0.25, not 0;")
        call disk%complete_velocities(0.0_dp, q, [1e-7_dp, -1.0_dp, 2.0_dp, 3.0_dp], v, error)
        call refused("x_dot - r sin(theta) phi_dot = 1")
        call disk%complete_velocities(0.0_dp, q, [ieee_value(1.0_dp, ieee_quiet_nan), -1.0_dp, &
                                                  2.0_dp, 3.0_dp], v, error)
        call refused("v does not roll: x_dot")
        call disk%complete_velocities(0.0_dp, q, [1.0_dp, 2.0_dp, 3.0_dp], v, error)
        call refused("v takes 2 values (phi_dot, theta_dot) or all 4, not 3")
    contains
        subroutine refused(text)
            character(*), intent(in) :: text

            call assertTrue(allocated(error), "refused: "//text)
            if (.not. allocated(error)) return
            call assertGreaterThan(index(error%message, text), 0, message=error%message)
        end subroutine refused
    end subroutine velocities_that_slip_are_refused

    subroutine constraint_is_not_integrable()
        !! As the notes have it, dA_phi/dtheta = -R cos(theta) for the x-row; and by Frobenius
        !! a^da = R cos(theta) dx^dphi^dtheta, which does not vanish.
        type(rolling_disk_t) :: disk
        type(hyperdual_t) :: q(4), rows(2, 4), drift(2)
        real(dp) :: da(4, 4), values(2, 4), theta
        integer :: i

        call build_uniform(disk, 1.7_dp, 0.6_dp, 0.0_dp)
        theta = 0.7_dp
        do i = 1, 4
            q = hyperdual([0.3_dp, -0.2_dp, 1.9_dp, theta])
            q(i)%d1 = 1.0_dp
            call disk%constraint_rows(hyperdual(0.0_dp), q, rows, drift)
            da(i, :) = rows(1, :)%d1
        end do
        values = rows%re
        call assertEqual([1.0_dp, 0.0_dp, -0.6_dp*sin(theta), 0.0_dp], [values(1, :)], 1e-15_dp)
        call assertEqual([0.0_dp, 1.0_dp, 0.6_dp*cos(theta), 0.0_dp], [values(2, :)], 1e-15_dp)
        call assertEqual(-0.6_dp*cos(theta), da(4, 3), 1e-15_dp)
        associate (a => rows(1, :)%re)
            call assertEqual(0.6_dp*cos(theta), a(1)*(da(3, 4) - da(4, 3)) &
                             + a(3)*(da(4, 1) - da(1, 4)) + a(4)*(da(1, 3) - da(3, 1)), 1e-15_dp)
        end associate
    end subroutine constraint_is_not_integrable

    subroutine friction_is_the_multiplier()
        !! The quantities friction_x, friction_y are the multipliers of Lagrange-d'Alembert.
        type(rolling_disk_t) :: disk
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t, a(4), lambda(2), friction(2)
        integer :: i

        do i = 1, 40
            call draw_parameters(disk, edges=mod(i, 2) == 0)
            call draw_state(disk, t, q, v)
            call accelerations_from_lagrangian(disk, t, q, v, a, lambda, error)
            call assertFalse(allocated(error), "multipliers")
            friction = [disk%quantity(8, t, q, v), disk%quantity(9, t, q, v)]
            call assertLessThanOrEqual( &
                maxval(abs(friction - lambda)), rounding*(disk%m*(maxval(abs(a)) + disk%g)), &
                message="friction is the multiplier")
        end do
    end subroutine friction_is_the_multiplier

    subroutine level_friction_is_the_centripetal_force()
        !! m R phi_dot theta_dot (cos(theta), sin(theta)): towards the centre, m v^2/rho.
        type(rolling_disk_t) :: disk
        type(error_t), allocatable :: error
        real(dp) :: q(4), v(4)

        call build_uniform(disk, 1.7_dp, 0.6_dp, 0.0_dp)
        q = [0.3_dp, -0.2_dp, 1.9_dp, 0.7_dp]
        call disk%complete_velocities(0.0_dp, q, [2.3_dp, 1.1_dp], v, error)
        associate (force => 1.7_dp*0.6_dp*2.3_dp*1.1_dp)
            call assertEqual(force*cos(0.7_dp), disk%quantity(8, 0.0_dp, q, v), 1e-14_dp)
            call assertEqual(force*sin(0.7_dp), disk%quantity(9, 0.0_dp, q, v), 1e-14_dp)
            call assertEqual(1.7_dp*(v(1)**2 + v(2)**2)/(0.6_dp*2.3_dp/1.1_dp), force, 1e-14_dp)
        end associate
    end subroutine level_friction_is_the_centripetal_force

    subroutine level_conserves_p_phi_not_p_x()
        !! Every quantity that is declared conserved is, on the level; p_phi is declared; x and
        !! y do not occur in L, and yet their momenta change.
        type(rolling_disk_t) :: disk
        type(description_t) :: d
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t, rate, scale
        integer :: i, k

        do i = 1, 20
            call build(disk, uniform(0.5_dp, 3.0_dp), uniform(0.2_dp, 2.0_dp), &
                       uniform(0.0_dp, 2.0_dp), uniform(0.1_dp, 2.0_dp), &
                       uniform(0.0_dp, 9.0_dp), 0.0_dp)
            call draw_state(disk, t, q, v)
            call disk%describe(d)
            call assertTrue(d%quantities(2)%name == "p_phi" .and. d%quantities(2)%conserved, &
                            "d%quantities(2)%name == 'p_phi' .and. d%quantities(2)%conserved")
            do k = 1, size(d%quantities)
                if (.not. d%quantities(k)%conserved) cycle
                call flow_derivative(disk, k, t, q, v, rate, scale)
                call assertLessThanOrEqual(abs(rate), differencing*scale, &
                                           message=trim(d%quantities(k)%name))
            end do
            call assertEqual("p_x", trim(d%quantities(10)%name))
            call assertFalse(any(d%quantities(10:11)%conserved), "p_x, p_y")
            call flow_derivative(disk, 10, t, q, v, rate, scale)
            call assertEqual(disk%quantity(8, t, q, v), rate, differencing*scale, "p_x_dot")
            call flow_derivative(disk, 11, t, q, v, rate, scale)
            call assertEqual(disk%quantity(9, t, q, v), rate, differencing*scale, "p_y_dot")
        end do
    end subroutine level_conserves_p_phi_not_p_x

    subroutine incline_does_not_conserve_p_phi()
        !! The declared names follow the incline; p_phi changes at m g' R sin(theta).
        type(rolling_disk_t) :: disk
        type(description_t) :: d
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t, rate, scale

        call build_uniform(disk, 1.7_dp, 0.6_dp, -0.3_dp)
        call disk%describe(d)
        call assertFalse(d%quantities(2)%conserved, "p_phi on an incline")
        call assertTrue(d%quantities(3)%conserved, "roll_yaw on an incline")
        call draw_state(disk, t, q, v)
        call flow_derivative(disk, 2, t, q, v, rate, scale)
        call assertEqual(1.7_dp*9.81_dp*sin(-0.3_dp)*0.6_dp*sin(q(4)), rate, differencing*scale)
    end subroutine incline_does_not_conserve_p_phi

    subroutine p_phi_is_of_the_rolling_disk()
        !! \(\partial T/\partial\dot\varphi\) with \(\dot x = r\dot\varphi\sin\theta\),
        !! \(\dot y = -r\dot\varphi\cos\theta\) put into T; that of L is \(I\dot\varphi\). Both
        !! are said, on the level and on an incline. On the level T is L.
        type(rolling_disk_t) :: disk
        type(description_t) :: d
        real(dp), parameter :: q(4) = [0.2_dp, -0.3_dp, 0.5_dp, 0.8_dp]
        real(dp), parameter :: rates(2) = [1.7_dp, -0.4_dp]
        type(hyperdual_t) :: rolling(4), l
        real(dp) :: p(4), v(4)
        integer :: i

        do i = 1, 2
            call build(disk, 1.3_dp, 0.3_dp, 0.07_dp, 0.04_dp, 9.81_dp, 0.2_dp*(i - 1))
            call disk%describe(d)
            call assertEqual("p_phi", trim(d%quantities(2)%name))
            call assertTrue(any(d%notes == "p_phi is dT/dphi_dot with the rolling put into T; "// &
                                "dL/dphi_dot is i_roll phi_dot."), "said")
            rolling = hyperdual([0.3_dp*rates(1)*sin(q(4)), -0.3_dp*rates(1)*cos(q(4)), rates])
            v = rolling%re
            call disk%momenta(0.0_dp, q, v, p)
            call assertEqual(0.07_dp*rates(1), p(3), 1e-15_dp, "dL/dphi_dot")
            rolling(:3)%d1 = [0.3_dp*sin(q(4)), -0.3_dp*cos(q(4)), 1.0_dp]
            l = disk%lagrangian(hyperdual(0.0_dp), hyperdual(q), rolling)
            call assertEqual(l%d1, disk%quantity(2, 0.0_dp, q, v), 1e-15_dp, "dT/dphi_dot")
        end do
    end subroutine p_phi_is_of_the_rolling_disk

    subroutine p_theta_is_the_momentum()
        !! p_theta = dL/dtheta_dot. p_phi is dL/dphi_dot once the disk rolls: with the momenta
        !! p_x, p_y that rolling adds, along (r sin(theta), -r cos(theta)).
        type(rolling_disk_t) :: disk
        type(euler_lagrange_t) :: terms
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t

        call draw_parameters(disk, edges=.false.)
        call draw_state(disk, t, q, v)
        call expand_lagrangian(disk, t, q, v, terms)
        associate (p => terms%dl_dv, r => disk%r)
            call assertEqual(p(4), disk%quantity(1, t, q, v), rounding*abs(p(4)), "p_theta")
            call assertEqual(p(3) + r*(sin(q(4))*p(1) - cos(q(4))*p(2)), &
                             disk%quantity(2, t, q, v), rounding*sum(abs(p)), "p_phi")
            call assertEqual(p(1:2), [disk%quantity(10, t, q, v), disk%quantity(11, t, q, v)], &
                             rounding*sum(abs(p)), "p_x, p_y")
        end associate
    end subroutine p_theta_is_the_momentum
end module test_rolling_disk
