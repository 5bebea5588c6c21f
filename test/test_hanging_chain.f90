module test_hanging_chain
    !! One bob is the pendulum, two the double pendulum, many the chain of Bessel's function.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertLessThan, assertRelativelyEqual, assertTrue
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_eigen, only: normal_modes, residual_ratio
    use lagrangia_errors, only: error_t
    use lagrangia_hanging_chain, only: hanging_chain_t
    use lagrangia_kinds, only: dp
    use lagrangia_laguerre, only: laguerre_zeros
    use lagrangia_linearised, only: linearised_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_small_oscillations, only: find_modes, is_oscillation, is_unstable, modes_t
    use lagrangia_system, only: system_t
    use random_states, only: draw_state, restart_random
    implicit none (type, external)
    private
    public :: hanging_chain_suite

    real(dp), parameter :: g = 9.81_dp, pi = acos(-1.0_dp)

contains

    function hanging_chain_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("hanging_chain")
        call suite%addTest(TestMethod("one_bob_is_the_pendulum", one_bob_is_the_pendulum, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("two_are_the_double_pendulum", two_are_the_double_pendulum, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("zeros_of_laguerre", zeros_of_laguerre))
        call suite%addTest(TestMethod("frequencies_are_laguerres", frequencies_are_laguerres))
        call suite%addTest(TestMethod("many_bobs_go_to_bessel", many_bobs_go_to_bessel))
        call suite%addTest(TestMethod("divide_and_conquer_agrees", divide_and_conquer_agrees))
        call suite%addTest(TestMethod("chain_standing_on_its_head", chain_standing_on_its_head))
        call suite%addTest(TestMethod("half_a_bob_is_refused", half_a_bob_is_refused))
    end function hanging_chain_suite

    subroutine new_chain(chain, n)
        !! n bobs, parameters unlike 1.
        type(hanging_chain_t), intent(out) :: chain
        integer, intent(in) :: n
        type(error_t), allocatable :: error

        call chain%configure([real(n, dp), 0.7_dp, 2.6_dp, g], error)
        call assertFalse(allocated(error), "a chain")
    end subroutine new_chain

    subroutine same_motion(chain, other)
        !! Accelerations and energies at random states agree to rounding.
        class(system_t), intent(in) :: chain, other
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t, a(chain%ndof), b(chain%ndof)
        integer :: i

        call restart_random()
        do i = 1, 50
            call draw_state(other, t, q, v)
            call chain%accelerations(t, q, v, a)
            call other%accelerations(t, q, v, b)
            ! a(2) is a difference of terms of size g and v^2
            call assertEqual(b, a, 1e-13_dp*(maxval(abs(b)) + 30.0_dp))
            call assertRelativelyEqual(other%energy(t, q, v), chain%energy(t, q, v), 1e-13_dp)
            if (anyExceptions()) return
        end do
    end subroutine same_motion

    subroutine one_bob_is_the_pendulum()
        !! At any angle.
        type(hanging_chain_t) :: chain
        type(pendulum_t) :: pendulum
        type(error_t), allocatable :: error

        call new_chain(chain, 1)
        call pendulum%configure([0.7_dp, 2.6_dp, g], error)
        call same_motion(chain, pendulum)
        call assertTrue(chain%velocity_forces .eqv. pendulum%velocity_forces, "structure")
    end subroutine one_bob_is_the_pendulum

    subroutine two_are_the_double_pendulum()
        !! At any angles, and in its modes.
        type(hanging_chain_t) :: chain
        type(double_pendulum_t) :: double
        type(linearised_t) :: ours, theirs
        type(error_t), allocatable :: error

        call new_chain(chain, 2)
        call double%configure([0.7_dp, 0.7_dp, 1.3_dp, 1.3_dp, g], error)
        call same_motion(chain, double)
        call chain%linearise([0.0_dp, 0.0_dp], ours)
        call double%linearise([0.0_dp, 0.0_dp], theirs)
        call assertEqual(theirs%mass, ours%mass, 1e-15_dp)
        call assertEqual(theirs%stiffness, ours%stiffness, 1e-14_dp)
        call assertEqual(1.0_dp, ours%omega2/theirs%omega2, 1e-15_dp*4)
    end subroutine two_are_the_double_pendulum

    subroutine zeros_of_laguerre()
        !! Against 40-digit values (mpmath); of a thousand the smallest is hardest.
        real(dp) :: x(1000)

        call assertEqual([1.0_dp], laguerre_zeros(1), 4*epsilon(1.0_dp))
        x(:5) = laguerre_zeros(5)
        call assertEqual(1.0_dp, x(:5)/[0.2635603197181409102031_dp, 1.413403059106516792218_dp, &
                                        3.596425771040722081223_dp, 7.085810005858837556922_dp, &
                                        12.64080084427578265943_dp], 4*epsilon(1.0_dp))
        x(:20) = laguerre_zeros(20)
        call assertEqual(1.0_dp, x(1:20:19)/[0.07053988969198875336669_dp, &
                                             66.52441652561575381864_dp], 8*epsilon(1.0_dp))
        x = laguerre_zeros(1000)
        call assertEqual(1.0_dp, x([1, 2, 7])/[0.001445074067541512181235_dp, &
                                               0.007614013093376567908775_dp, &
                                               0.1124282166828468490263_dp], 1e-13_dp)
        call assertTrue(all(x(2:) > x(:999)), "ascending")
        ! the sum of the zeros of L_n is n^2
        call assertRelativelyEqual(1e6_dp, sum(x), 1e-13_dp)
    end subroutine zeros_of_laguerre

    subroutine frequencies_are_laguerres()
        !! LAPACK on the factors keeps every frequency: a few ulp a rotation, n of them a column.
        type(hanging_chain_t) :: chain
        type(modes_t) :: modes
        type(error_t), allocatable :: error
        integer, parameter :: sizes(5) = [1, 3, 10, 60, 200]
        real(dp) :: rest(200)
        integer :: i

        rest = 0.0_dp
        do i = 1, size(sizes)
            call new_chain(chain, sizes(i))
            call find_modes(chain, rest(:sizes(i)), .true., modes, error)
            call assertFalse(allocated(error), "modes")
            if (anyExceptions()) return
            call assertTrue(all(modes%label == is_oscillation), "labels")
            call assertEqual(1.0_dp, modes%omega2/(sizes(i)*g/2.6_dp*laguerre_zeros(sizes(i))), &
                             4*(3 + sizes(i))*epsilon(1.0_dp))
        end do
    end subroutine frequencies_are_laguerres

    subroutine many_bobs_go_to_bessel()
        !! \(\omega_k \to \tfrac12 j_{0,k}\sqrt{g/L}\). The zeros of \(L_n\) are
        !! \(j^2/(4n + 2)\,(1 + O(n^{-2}))\), so \(\omega_k^2\) is short of the limit by the
        !! fraction 1/(2n).
        real(dp), parameter :: j0(2) = [2.404825557695772768622_dp, 5.520078110286310649597_dp]
        type(hanging_chain_t) :: chain
        type(linearised_t) :: page
        integer :: n

        n = 250
        do
            call new_chain(chain, n)
            call chain%linearise(spread(0.0_dp, 1, n), page)
            call assertEqual(1.0_dp, 2*n*(1.0_dp - page%omega2(:2)/(0.25_dp*j0**2*g/2.6_dp)), &
                             6.0_dp/n)
            if (n == 1000) exit
            n = 2*n
        end do
    end subroutine many_bobs_go_to_bessel

    subroutine divide_and_conquer_agrees()
        !! K and M alone, through dsygvd: to rounding of the fastest mode, times what the condition
        !! of M leaves (LAPACK Users' Guide, sec. 4.7, bounds it by cond(M) = 4 n^2 or so).
        type(hanging_chain_t) :: chain
        type(linearised_t) :: page
        real(dp), allocatable :: omega2(:), u(:, :)
        type(error_t), allocatable :: error
        integer, parameter :: n = 120

        call new_chain(chain, n)
        call chain%linearise(spread(0.0_dp, 1, n), page)
        call normal_modes(page%stiffness, page%mass, omega2, u, error)
        call assertFalse(allocated(error), "no error: divide and conquer agrees")
        if (anyExceptions()) return
        call assertEqual(page%omega2, omega2, 10*n*epsilon(1.0_dp)*page%omega2(n))
        call assertLessThan(residual_ratio(page%stiffness, page%mass, omega2, u), 300.0_dp)
    end subroutine divide_and_conquer_agrees

    subroutine chain_standing_on_its_head()
        !! Every mode unstable, with the growth rates of the hanging chain's frequencies; and with
        !! one rod turned over, as many unstable modes (Sylvester's law of inertia).
        type(hanging_chain_t) :: chain
        type(modes_t) :: modes
        type(error_t), allocatable :: error

        call new_chain(chain, 4)
        call find_modes(chain, [pi, pi, pi, pi], .true., modes, error)
        call assertFalse(allocated(error), "upright")
        if (anyExceptions()) return
        call assertTrue(all(modes%label == is_unstable), "all(modes%label == is_unstable)")
        call assertEqual(-4*g/2.6_dp*laguerre_zeros(4), modes%omega2(4:1:-1), 1e-12_dp)
        call find_modes(chain, [0.0_dp, pi, 0.0_dp, 0.0_dp], .true., modes, error)
        call assertEqual(1, count(modes%label == is_unstable))
        call assertLessThan(modes%difference, 1e-14_dp, message="page and L")
    end subroutine chain_standing_on_its_head

    subroutine half_a_bob_is_refused()
        !! By message.
        type(hanging_chain_t) :: chain
        type(error_t), allocatable :: error

        call chain%configure([2.5_dp, 0.7_dp, 2.6_dp, g], error)
        call assertTrue(allocated(error), "2.5 bobs")
        if (anyExceptions()) return
        call assertEqual("hanging_chain: n = 2.5 is not allowed: a whole number from 1 to 1000", &
                         error%message)
    end subroutine half_a_bob_is_refused
end module test_hanging_chain
