module test_walls
    !! `gauss16` by tolerance where a motion changes its character from one step to the next.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertLessThan
    use lagrangia_errors, only: error_t
    use lagrangia_gauss_adaptive, only: gauss_adaptive_t, new_gauss16_adaptive
    use lagrangia_kinds, only: dp, i8
    use lagrangia_pendulum, only: pendulum_t
    use random_states, only: restart_random, uniform
    use steep_wall, only: steep_wall_t
    implicit none (type, external)
    private
    public :: walls_suite

contains

    function walls_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("walls")
        call suite%addTest(TestMethod("a_wall_stops_no_run", a_wall_stops_no_run, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("a_kink_is_not_stepped_over", a_kink_is_not_stepped_over, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("noise_is_no_kink", noise_is_no_kink))
        call suite%addTest(TestMethod("no_step_ends_in_a_wall_unseen", &
                                      no_step_ends_in_a_wall_unseen, setUp=restart_random))
    end function walls_suite

    subroutine a_wall_stops_no_run()
        !! A first try that is far too long makes numbers without bounds: they are forgotten.
        call check_walls(6, 1e-4_dp, 1.0_dp, dense=.false.)
    end subroutine a_wall_stops_no_run

    subroutine no_step_ends_in_a_wall_unseen()
        !! Nor begins there. What the nodes of a step do see may not be smooth, and tolerances are
        !! missed there; but the energy is kept to a part in ten thousand.
        call check_walls(2, 1e-9_dp, 1e-4_dp, dense=.false.)
        call check_walls(3, 1e-9_dp, 1e-4_dp, dense=.false.)
        call check_walls(5, 1e-9_dp, 1e-4_dp, dense=.false.)
    end subroutine no_step_ends_in_a_wall_unseen

    subroutine a_kink_is_not_stepped_over()
        !! Where steps are looked into, a spring that sets in, or its derivative, keeps the
        !! tolerance as smooth forces do: within a hundred over some ten passages, each of at most
        !! ten. By what the nodes alone tell it was a hundred thousand.
        integer :: power

        do power = 1, 3
            call check_walls(power, 1e-6_dp, 1e-4_dp, dense=.true.)
            call check_walls(power, 1e-9_dp, 1e-7_dp, dense=.true.)
        end do
    end subroutine a_kink_is_not_stepped_over

    subroutine noise_is_no_kink()
        !! At a million radians the rounding of the angle is felt as a force of 1e-9, many
        !! tolerances of 1e-12: no shorter step would help, and none is taken.
        type(pendulum_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error
        integer(i8) :: accepted(2)
        integer :: i

        call system%configure([1.0_dp, 1.0_dp, 9.81_dp], error)
        do i = 1, 2
            call new_gauss16_adaptive(method)
            method%tolerance = 1e-12_dp
            method%dense = i == 1
            call method%prepare(system, error)
            call method%start(system, 0.0_dp, [1e6_dp], [3.0_dp], 10.0_dp)
            do while (method%t_new < 10.0_dp)
                call method%step(system, error)
                call assertFalse(allocated(error), "a step is small enough")
                if (anyExceptions()) return
            end do
            accepted(i) = method%accepted
        end do
        call assertEqual(accepted(2), accepted(1), "steps")
    end subroutine noise_is_no_kink

    subroutine check_walls(power, tolerance, most, dense)
        !! From many starts, deep in the wall and far from it.
        integer, intent(in) :: power
        real(dp), intent(in) :: tolerance, most  !! relative change of energy
        logical, intent(in) :: dense
        type(steep_wall_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), before, worst
        integer :: i

        call restart_random()
        call system%configure([real(power, dp)], error)
        worst = 0.0_dp
        do i = 1, 200
            q = 10.0_dp**uniform(-1.0_dp, 1.0_dp)
            v = uniform(-3.0_dp, 3.0_dp)
            before = system%energy(0.0_dp, q, v)
            call new_gauss16_adaptive(method)
            method%tolerance = tolerance
            method%dense = dense
            call method%prepare(system, error)
            call method%start(system, 0.0_dp, q, v, 10.0_dp)
            do while (method%t_new < 10.0_dp)
                call method%step(system, error)
                call assertFalse(allocated(error), "a step is small enough")
                if (anyExceptions()) return
            end do
            call method%state_at(10.0_dp, q, v)
            worst = max(worst, abs(system%energy(10.0_dp, q, v)/before - 1.0_dp))
        end do
        call assertLessThan(worst, most, message="energy")
    end subroutine check_walls
end module test_walls
