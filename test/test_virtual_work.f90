module test_virtual_work
    !! D'Alembert's principle and generalized forces, for every system at random parameters.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertLessThanOrEqual
    use lagrangia_catalogue, only: nth_system, system_names
    use lagrangia_description, only: description_t
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian, energy_from_lagrangian
    use lagrangia_point_motion, only: conservative_forces, dalembert, expand_points, &
                                      point_motion_t
    use lagrangia_report, only: report_t
    use lagrangia_rotating_hoop, only: rotating_hoop_t
    use lagrangia_system, only: system_box_t, system_t
    use lagrangia_test_potentials, only: test_charge_t
    use lagrangia_virtual_work, only: virtual_work_principle
    use pushed_pendulum, only: pushed_pendulum_t
    use random_states, only: draw_parameters, draw_state, restart_random
    implicit none (type, external)
    private
    public :: virtual_work_suite

contains

    function virtual_work_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("virtual_work")
        call suite%addTest(TestMethod("every_system_obeys_dalembert", &
                                      every_system_obeys_dalembert, setUp=restart_random))
        call suite%addTest(TestMethod("wrong_forces_are_seen", wrong_forces_are_seen))
        call suite%addTest(TestMethod("one_wrong_state_is_enough", one_wrong_state_is_enough))
        call suite%addTest(TestMethod("points_move_as_differences_say", &
                                      points_move_as_differences_say, setUp=restart_random))
        call suite%addTest(TestMethod("test_charge_is_consistent", test_charge_is_consistent, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("fields_are_differences", fields_are_differences))
    end function virtual_work_suite

    subroutine every_system_obeys_dalembert()
        !! Relative to the largest term, a few hundred roundings where terms of a fast drive or of
        !! a turning frame cancel.
        class(system_t), allocatable :: system
        type(description_t) :: d
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t
        integer :: i, k

        i = 0
        do
            i = i + 1
            call nth_system(i, system)
            if (.not. allocated(system)) exit
            do k = 1, 20
                call draw_parameters(system, .false.)
                call draw_state(system, t, q, v)
                call system%describe(d)
                call assertLessThanOrEqual(dalembert(system, t, q, v), 1e-11_dp, &
                                           message="d'Alembert: "//trim(d%name))
                if (d%name == "charged_particle") cycle
                call assertLessThanOrEqual(conservative_forces(system, t, q, v), 1e-11_dp, &
                                           message="-dV/dq: "//trim(d%name))
            end do
        end do
        call assertEqual(size(system_names()), i - 1, "systems checked")
    end subroutine every_system_obeys_dalembert

    subroutine wrong_forces_are_seen()
        !! A push of 1 N m or 1 rad/s^2 either way on either coordinate, beside terms that together
        !! are below 100.
        type(pushed_pendulum_t) :: system
        type(error_t), allocatable :: error
        real(dp), parameter :: t = 0.0_dp, q(2) = [0.4_dp, -1.1_dp], v(2) = [0.7_dp, 1.9_dp]
        integer :: i, k

        call system%configure([1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp, 9.81_dp], error)
        do i = 1, 2
            do k = -1, 1
                system%which = i
                system%push = k
                if (k == 0) then
                    call assertLessThanOrEqual(dalembert(system, t, q, v), 1e-14_dp)
                    call assertLessThanOrEqual(conservative_forces(system, t, q, v), 1e-14_dp)
                else
                    call assertGreaterThan(dalembert(system, t, q, v), 0.01_dp)
                    call assertGreaterThan(conservative_forces(system, t, q, v), 0.01_dp)
                end if
            end do
        end do
    end subroutine wrong_forces_are_seen

    subroutine one_wrong_state_is_enough()
        !! The page names a system that is wrong at the first of all states alone, or at the last:
        !! d'Alembert's sum at 0, 1, ..., 99 ms of a motion, forces at 0.1, 0.2, ..., 2 s.
        real(dp), parameter :: when(2, 2) = reshape([0.0_dp, 0.099_dp, 0.1_dp, 2.0_dp], [2, 2])
        type(system_box_t) :: systems(1)
        type(pushed_pendulum_t) :: pushed
        type(report_t) :: report
        type(error_t), allocatable :: error
        logical :: holds(2)
        integer :: i, j, k, n

        call pushed%configure([1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp, 9.81_dp], error)
        pushed%push = 1.0_dp
        do i = 1, 2
            do k = 1, 2
                pushed%from = when(i, k) - 0.4e-3_dp
                pushed%to = when(i, k) + 0.4e-3_dp
                if (allocated(systems(1)%item)) deallocate (systems(1)%item)
                allocate (systems(1)%item, source=pushed)
                call virtual_work_principle(systems, report, error)
                call assertFalse(allocated(error), "no error")
                if (anyExceptions()) return
                n = 0
                do j = 1, size(report%rows)
                    if (report%rows(j)%name /= "double_pendulum") cycle
                    n = n + 1
                    holds(min(n, 2)) = report%rows(j)%holds
                end do
                call assertEqual(2, n, "rows of the system")
                call assertEqual([k == 2, k == 1], holds, message="motion, forces: wrong at "// &
                                 trim(merge("the start", "the end  ", i == 1)))
            end do
        end do
    end subroutine one_wrong_state_is_enough

    subroutine points_move_as_differences_say()
        !! Velocity, acceleration, drift and slopes of moving points by fourth-order differences in
        !! time (1e-12 of truncation, 1e-10 of rounding for a step of 1e-3).
        type(driven_pendulum_t) :: driven
        type(rotating_hoop_t) :: hoop
        type(error_t), allocatable :: error

        call driven%configure([0.5_dp, 0.8_dp, 9.81_dp, 0.1_dp, 5.0_dp], error)
        call assertFalse(allocated(error), "no error: points move as differences say")
        call try(driven)
        call hoop%configure([0.6_dp, 0.7_dp, 2.5_dp, 9.81_dp], error)
        call assertFalse(allocated(error), "no error: points move as differences say")
        call try(hoop)
    contains
        subroutine try(system)
            class(system_t), intent(in) :: system
            real(dp), parameter :: t = 0.7_dp, step = 1e-3_dp
            real(dp), parameter :: q(1) = 0.9_dp, v(1) = -1.3_dp, a(1) = 2.1_dp
            type(point_motion_t) :: motion, other
            real(dp) :: x(3, -2:2), moved(1), speed(1)
            integer :: k

            call expand_points(system, t, q, v, a, motion)
            do k = -2, 2
                moved = q + v*k*step + 0.5_dp*a*(k*step)**2
                x(:, k) = place(system, t + k*step, moved)
            end do
            call compare(8.0_dp*(x(:, 1) - x(:, -1)) - x(:, 2) + x(:, -2), motion%velocity, 1)
            call compare(16.0_dp*(x(:, 1) + x(:, -1)) - x(:, 2) - x(:, -2) - 30.0_dp*x(:, 0), &
                         motion%acceleration, 2)
            do k = -2, 2
                x(:, k) = place(system, t + k*step, q)
            end do
            call compare(8.0_dp*(x(:, 1) - x(:, -1)) - x(:, 2) + x(:, -2), motion%x_t, 1)
            do k = -2, 2
                moved = q + k*step
                x(:, k) = place(system, t, moved)
            end do
            call compare(8.0_dp*(x(:, 1) - x(:, -1)) - x(:, 2) + x(:, -2), motion%jacobian(:, 1), 1)
            do k = -2, 2
                moved = q + k*step
                speed = v
                call expand_points(system, t, moved, speed, a, other)
                x(:, k) = other%velocity
            end do
            call compare(8.0_dp*(x(:, 1) - x(:, -1)) - x(:, 2) + x(:, -2), motion%slope(:, 1), 1)
        end subroutine try

        subroutine compare(difference, derivative, order)
            real(dp), intent(in) :: difference(3), derivative(:)
            integer, intent(in) :: order

            call assertEqual(0.0_dp, maxval(abs(difference/(12.0_dp*1e-3_dp**order) &
                                                - derivative)), 1e-9_dp)
        end subroutine compare

        function place(system, t, q) result(x)
            class(system_t), intent(in) :: system
            real(dp), intent(in) :: t, q(1)
            real(dp) :: x(3)
            type(hyperdual_t) :: r(3, 1)

            call system%positions(hyperdual(t), hyperdual(q), r)
            x = r(:, 1)%re
        end function place
    end subroutine points_move_as_differences_say

    subroutine test_charge_is_consistent()
        !! Its accelerations, from fields, are those of its L; so is its energy.
        type(test_charge_t) :: charge
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t, a(3), expected(3), none(0)
        integer :: i

        do i = 1, 20
            call draw_parameters(charge, .false.)
            call draw_state(charge, t, q, v)
            call charge%accelerations(t, q, v, a)
            call accelerations_from_lagrangian(charge, t, q, v, expected, none, error)
            call assertFalse(allocated(error), "no error: test charge is consistent")
            call assertEqual(0.0_dp, maxval(abs(expected - a))/maxval(abs(a)), 1e-12_dp)
            call assertEqual(energy_from_lagrangian(charge, t, q, v), charge%energy(t, q, v), &
                             1e-10_dp)
        end do
    end subroutine test_charge_is_consistent

    subroutine fields_are_differences()
        !! E and B of the potentials as they are written, by hand: \(B = \nabla\times A\) of
        !! \((yzt,\; x^2\cos t + z,\; \sin xy + tz)\).
        type(test_charge_t) :: charge
        type(error_t), allocatable :: error
        real(dp), parameter :: t = 0.7_dp, x = 0.4_dp, y = 0.9_dp, z = -0.6_dp
        real(dp) :: slope(3), induced(3), b(3)

        call charge%configure([1.3_dp, -0.8_dp], error)
        call assertFalse(allocated(error), "no error: fields are differences")
        call charge%fields(t, [x, y, z], slope, induced, b)
        call assertEqual([-y*exp(-t) - z**2*cos(x), -x*exp(-t), -2.0_dp*z*sin(x)], slope, 1e-14_dp)
        call assertEqual([-y*z, x**2*sin(t), -z], induced, 1e-14_dp)
        call assertEqual([x*cos(x*y) - 1.0_dp, y*t - y*cos(x*y), 2.0_dp*x*cos(t) - z*t], b, &
                         1e-14_dp)
    end subroutine fields_are_differences
end module test_virtual_work
