module test_walls
    !! `gauss16` by tolerance where a motion changes its character from one step to the next.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertFalse, assertLessThan
    use lagrangia_errors, only: error_t
    use lagrangia_gauss_adaptive, only: gauss_adaptive_t, new_gauss16_adaptive
    use lagrangia_kinds, only: dp
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
        call suite%addTest(TestMethod("no_step_ends_in_a_wall_unseen", &
                                      no_step_ends_in_a_wall_unseen, setUp=restart_random))
    end function walls_suite

    subroutine a_wall_stops_no_run()
        !! A first try that is far too long makes numbers without bounds: they are forgotten.
        call check_walls(6, 1e-4_dp, 1.0_dp)
    end subroutine a_wall_stops_no_run

    subroutine no_step_ends_in_a_wall_unseen()
        !! Nor begins there. What the nodes of a step do see may not be smooth, and tolerances are
        !! missed there; but the energy is kept to a part in ten thousand.
        call check_walls(2, 1e-9_dp, 1e-4_dp)
        call check_walls(3, 1e-9_dp, 1e-4_dp)
        call check_walls(5, 1e-9_dp, 1e-4_dp)
    end subroutine no_step_ends_in_a_wall_unseen

    subroutine check_walls(power, tolerance, most)
        !! From many starts, deep in the wall and far from it.
        integer, intent(in) :: power
        real(dp), intent(in) :: tolerance, most  !! relative change of energy
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
            method%dense = .false.
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
