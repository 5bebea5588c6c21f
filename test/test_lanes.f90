module test_lanes
    !! The accelerations of eight states at once are those of the eight states; where steps of eight
    !! trajectories at once may have taken an angle.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: new_system, nth_system, system_names
    use lagrangia_description, only: description_t
    use lagrangia_dop853_lanes, only: dop853_lanes_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: lanes, system_t
    use plain_system, only: plain_system_t
    use random_states, only: draw_parameters, draw_state, restart_random
    implicit none (type, external)
    private
    public :: lanes_suite

    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    function lanes_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("lanes")
        call suite%addTest(TestMethod("lanes_are_single_states", lanes_are_single_states, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("a_system_needs_no_kernel", a_system_needs_no_kernel))
        call suite%addTest(TestMethod("a_chain_too_long_for_the_stack", &
                                      a_chain_too_long_for_the_stack))
        call suite%addTest(TestMethod("an_angle_may_flip", an_angle_may_flip))
    end function lanes_suite

    subroutine lanes_are_single_states()
        !! For every system, at random parameters and states. Sine and cosine of lanes are good to
        !! 1 ulp, those of libm to half of one; behind them stand some ten operations and a
        !! difference of larger terms: up to 100 epsilon of the largest acceleration.
        real(dp), parameter :: rounding = 100.0_dp*epsilon(1.0_dp)
        class(system_t), allocatable :: system
        type(description_t) :: d
        real(dp), allocatable :: q(:, :), v(:, :), a(:, :), each(:, :), x(:), x_dot(:), x_ddot(:)
        real(dp) :: t(lanes)
        integer :: i, j, draw

        i = 0
        do
            i = i + 1
            call nth_system(i, system)
            if (.not. allocated(system)) exit
            call system%describe(d)
            do draw = 1, 40
                call draw_parameters(system, edges=mod(draw, 4) == 0)
                allocate (q(lanes, system%ndof), v(lanes, system%ndof))
                allocate (a(lanes, system%ndof), each(lanes, system%ndof), x_ddot(system%ndof))
                do j = 1, lanes
                    call draw_state(system, t(j), x, x_dot)
                    q(j, :) = x
                    v(j, :) = x_dot
                    call system%accelerations(t(j), x, x_dot, x_ddot)
                    each(j, :) = x_ddot
                end do
                call system%accelerations_lanes(t, q, v, a)
                do j = 1, lanes
                    call assertEqual(each(j, :), a(j, :), &
                                     rounding*max(1.0_dp, maxval(abs(each(j, :)))), &
                                     trim(d%name)//": lanes")
                end do
                deallocate (q, v, a, each, x_ddot)
                if (anyExceptions()) return
            end do
        end do
        call assertEqual(size(system_names()), i - 1, "systems checked")
    end subroutine lanes_are_single_states

    subroutine a_system_needs_no_kernel()
        !! The contract's own loop: the same operations, so equal to the last bit.
        type(plain_system_t) :: system
        real(dp) :: t(lanes), q(lanes, 2), v(lanes, 2), a(lanes, 2), each(2), x(2), x_dot(2)
        integer :: i

        do i = 1, lanes
            t(i) = 0.3_dp*i
            q(i, :) = [0.7_dp*i, -1.1_dp*i]
            v(i, :) = [0.2_dp - i, 0.4_dp*i]
        end do
        system%ndof = 2
        call system%accelerations_lanes(t, q, v, a)
        do i = 1, lanes
            x = q(i, :)
            x_dot = v(i, :)
            call system%accelerations(t(i), x, x_dot, each)
            call assertEqual(each, a(i, :), 0.0_dp, "lanes")
        end do
    end subroutine a_system_needs_no_kernel

    subroutine a_chain_too_long_for_the_stack()
        !! 32 bobs have their work arrays on the stack, 33 elsewhere.
        class(system_t), allocatable :: chain
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:, :), v(:, :), a(:, :), each(:), x(:), x_dot(:)
        real(dp) :: t(lanes)
        integer :: bobs, i, j

        call new_system("hanging_chain", chain, error)
        t = 0.0_dp
        do bobs = 32, 33
            call chain%configure([real(bobs, dp), 1.0_dp, 1.0_dp, 9.81_dp], error)
            allocate (q(lanes, bobs), v(lanes, bobs), a(lanes, bobs), each(bobs))
            do j = 1, lanes
                q(j, :) = [(sin(1.0_dp*i*j), i=1, bobs)]
                v(j, :) = [(cos(2.0_dp*i*j), i=1, bobs)]
            end do
            call chain%accelerations_lanes(t, q, v, a)
            do j = 1, lanes
                x = q(j, :)
                x_dot = v(j, :)
                call chain%accelerations(0.0_dp, x, x_dot, each)
                call assertEqual(each, a(j, :), tolerance=1e-12_dp*maxval(abs(each)), &
                                 message="lanes")
            end do
            deallocate (q, v, a, each)
        end do
    end subroutine a_chain_too_long_for_the_stack

    subroutine an_angle_may_flip()
        !! From either end of a step, as far as the larger velocity reaches, which is exactly pi or
        !! a last digit less; not in a lane that has not moved.
        real(dp), parameter :: under = nearest(pi, -1.0_dp), fast = 2.0_dp*(pi - 2.0_dp)
        real(dp), parameter :: old(lanes) = [0.0_dp, 0.0_dp, -pi, -under, 1.0_dp, 1.0_dp, 2.0_dp, &
                                             pi]
        real(dp), parameter :: new(lanes) = [pi, -under, 0.0_dp, 0.0_dp, 2.0_dp, -2.0_dp, 1.0_dp, &
                                             pi]
        real(dp), parameter :: v_old(lanes) = [0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, &
                                               -fast*(1.0_dp - 1e-9_dp), -1.1_dp*fast, fast]
        real(dp), parameter :: v_new(lanes) = [0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, &
                                               fast*(1.0_dp + 1e-9_dp), 0.0_dp, 1.0_dp, fast]
        logical, parameter :: may(lanes) = [.true., .false., .true., .false., .true., .false., &
                                            .true., .false.]
        type(dop853_lanes_t) :: method
        type(plain_system_t) :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        integer :: i

        call system%configure([real(dp) ::], error)
        scene%q = [0.1_dp, 0.1_dp]
        scene%v = [0.0_dp, 0.0_dp]
        scene%duration = 1.0_dp
        scene%tolerance = 1e-6_dp
        call method%prepare(system)
        do i = 1, lanes - 1
            call method%begin(system, i, scene)
        end do
        call method%step(system)
        call assertTrue(all(method%t(:lanes - 1) > 0.0_dp), "they have moved")
        method%t_old = 10.0_dp
        method%t = 10.5_dp
        method%y_old = 0.0_dp
        method%y = 0.0_dp
        do i = -1, 1, 2  ! to either side
            method%y_old(:, 2) = i*old
            method%y(:, 2) = i*new
            method%y_old(:, 4) = i*v_old
            method%y(:, 4) = i*v_new
            call assertEqual(may, method%may_flip(2), message="lanes")
            call assertFalse(any(method%may_flip(1)), "the other angle")
        end do
    end subroutine an_angle_may_flip
end module test_lanes
