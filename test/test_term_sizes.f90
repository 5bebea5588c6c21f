module test_term_sizes
    !! What rounding may do to a formula is not less than its terms, whatever their signs; and which
    !! term a difference is.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    use lagrangia_term_fit, only: best_term
    use lagrangia_term_sizes, only: motion_t, nearby_t, neighbours, new_nearby, size_of_solution, &
                                    solve_motion, term_size
    implicit none (type, external)
    private
    public :: term_sizes_suite

contains

    function term_sizes_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("term_sizes")
        call suite%addTest(TestMethod("terms_that_cancel_are_seen", terms_that_cancel_are_seen))
        call suite%addTest(TestMethod("solutions_spread_what_rows_have", &
                                      solutions_spread_what_rows_have))
        call suite%addTest(TestMethod("equations_are_as_large_as_their_terms", &
                                      equations_are_as_large_as_their_terms))
        call suite%addTest(TestMethod("sizes_have_no_sign", sizes_have_no_sign))
        call suite%addTest(TestMethod("the_nearest_term_is_found", the_nearest_term_is_found))
    end function term_sizes_suite

    subroutine terms_that_cancel_are_seen()
        !! Values at neighbours that are above and below by one step: what is known to a step of
        !! both signs is twice a step, over the step, beside the value itself.
        real(dp), parameter :: step = 16.0_dp*epsilon(1.0_dp)
        real(dp) :: values(0:neighbours)
        integer :: k

        values = [(merge(-1.0_dp, 1.0_dp, mod(k, 2) == 0)*step, k=0, neighbours)]
        values(0) = 0.0_dp
        call assertEqual(2.0_dp, term_size(values), 1e-15_dp, "of zero")
        values = -1.0_dp
        call assertEqual(1.0_dp, term_size(values), 1e-15_dp, "of a constant")
    end subroutine terms_that_cancel_are_seen

    subroutine the_nearest_term_is_found()
        !! Of the difference \((3, 4)\) four fifths are left beside \((1, 0)\), three beside
        !! \((0, 1)\), none beside \((-6, -8)\), whatever its unit. Of two terms that are equal the
        !! first one counts, of none that is not 0 none.
        real(dp), parameter :: difference(2) = [3.0_dp, 4.0_dp]
        real(dp), parameter :: terms(2, 4) = reshape([0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, &
                                                      1.0_dp, -6.0_dp, -8.0_dp], [2, 4])
        real(dp), parameter :: units(3) = [1e-9_dp, 1.0_dp, 1e9_dp]
        integer :: i

        do i = 1, size(units)
            call fits(units(i), [1, 2], 2, 3.0_dp, 0.8_dp)
            call fits(units(i), [1, 3, 1], 2, 4.0_dp, 0.6_dp)
            call fits(units(i), [2, 4, 1, 4], 2, -0.5_dp, 0.0_dp)
            call fits(units(i), [2, 3], 1, 3.0_dp, 0.8_dp)
            call fits(units(i), [3, 3, 2], 1, 4.0_dp, 0.6_dp)
            call fits(units(i), [1, 1], 0, 0.0_dp, 1.0_dp)
        end do
        call fits(0.0_dp, [2, 3], 0, 0.0_dp, 1.0_dp)
    contains
        subroutine fits(unit, columns, expected, factor, misfit)
            real(dp), intent(in) :: unit  !! of the difference
            integer, intent(in) :: columns(:), expected
            real(dp), intent(in) :: factor, misfit
            real(dp) :: share, left
            integer :: which

            call best_term(unit*difference, terms(:, columns), which, share, left)
            call assertEqual(expected, which, "which")
            call assertEqual(factor*merge(unit, 1.0_dp, unit > 0.0_dp), share, &
                             4.0_dp*epsilon(unit)*abs(factor)*max(unit, 1.0_dp), "its factor")
            call assertEqual(misfit, left, 4.0_dp*epsilon(unit), "what is left")
        end subroutine fits
    end subroutine the_nearest_term_is_found

    subroutine solutions_spread_what_rows_have()
        !! \(|K^{-1}|w\), by hand for a matrix of both signs; 1e4 epsilon of the largest are added.
        real(dp), parameter :: matrix(2, 2) = reshape([2.0_dp, -1.0_dp, -3.0_dp, 5.0_dp], [2, 2])
        real(dp), parameter :: rows(2) = [0.5_dp, 0.25_dp]
        type(error_t), allocatable :: error
        real(dp) :: found(2)

        call size_of_solution(matrix, rows, found, error)
        call assertFalse(allocated(error), "regular")
        ! the inverse is (5 3; 1 2)/7
        call assertEqual([3.25_dp, 1.0_dp]/7.0_dp, found, 1e4_dp*epsilon(1.0_dp), "|K^-1| w")
        call size_of_solution(0.0_dp*matrix, rows, found, error)
        call assertTrue(allocated(error), "singular")
    end subroutine solutions_spread_what_rows_have

    subroutine equations_are_as_large_as_their_terms()
        !! The cart at rest with its pendulum beyond the horizontal: \((m_1+m_2)\ddot x\) and
        !! \(m_2\ell\ddot\theta\cos\theta\) cancel, and are two terms of one size. Accelerations by
        !! hand: \(\ddot x = m_2 g\sin\theta\cos\theta/(m_1+m_2\sin^2\theta)\).
        real(dp), parameter :: m1 = 1.3_dp, m2 = 0.7_dp, l = 0.9_dp, g = 9.81_dp
        real(dp), parameter :: zero(2) = 0.0_dp
        type(cart_pendulum_t) :: system
        type(nearby_t) :: nearby
        type(motion_t) :: motion
        type(error_t), allocatable :: error
        real(dp) :: theta, x_ddot
        integer :: i

        call system%configure([m1, m2, l, g], error)
        do i = 1, 2
            theta = merge(3.0_dp, -3.0_dp, i == 1)
            call new_nearby(nearby, system, [m1, m2, l, g], 0.0_dp, [0.0_dp, theta], zero)
            call solve_motion(nearby, motion, error)
            call assertFalse(allocated(error), "solved")
            if (anyExceptions()) return
            x_ddot = m2*g*sin(theta)*cos(theta)/(m1 + m2*sin(theta)**2)
            call assertEqual(x_ddot, motion%accelerations(1), 1e-13_dp, "of the cart")
            call assertTrue(motion%equation_size(1) >= 2.0_dp*(m1 + m2)*abs(x_ddot), &
                            "two terms at least")
            call assertTrue(motion%equation_size(1) <= 8.0_dp*(m1 + m2)*abs(x_ddot), &
                            "what cancels is counted once more, not often")
            call assertTrue(all(motion%size >= abs(motion%accelerations)), "of accelerations")
        end do
    end subroutine equations_are_as_large_as_their_terms

    subroutine sizes_have_no_sign()
        !! The mirror image of a motion, \(q, v \to -q, -v\), has terms of the same sizes, to the
        !! last bit, and accelerations of the other sign.
        type(cart_pendulum_t) :: cart
        type(driven_pendulum_t) :: driven
        type(error_t), allocatable :: error
        real(dp), parameter :: masses(4) = [1.3_dp, 0.7_dp, 0.9_dp, 9.81_dp]
        real(dp), parameter :: pivot(5) = [1.3_dp, 0.7_dp, 9.81_dp, 0.1_dp, 20.0_dp]

        call cart%configure(masses, error)
        call driven%configure(pivot, error)
        call mirror(cart, masses, [0.2_dp, 0.8_dp], [-0.4_dp, 3.0_dp])
        call mirror(cart, masses, [0.2_dp, 2.8_dp], [0.4_dp, -1.0_dp])
        call mirror(driven, pivot, [0.8_dp], [3.0_dp])
    contains
        subroutine mirror(system, values, q, v)
            class(system_t), intent(in) :: system
            real(dp), intent(in) :: values(:), q(:), v(:)
            type(nearby_t) :: nearby
            type(motion_t) :: motion(2)
            integer :: i

            do i = 1, 2
                call new_nearby(nearby, system, values, 0.3_dp, (3 - 2*i)*q, (3 - 2*i)*v)
                call solve_motion(nearby, motion(i), error)
                call assertFalse(allocated(error), "solved")
                if (anyExceptions()) return
            end do
            call assertEqual(motion(1)%accelerations, -motion(2)%accelerations, 0.0_dp, "motion")
            call assertEqual(motion(1)%equation_size, motion(2)%equation_size, 0.0_dp, "equations")
            call assertEqual(motion(1)%size, motion(2)%size, 0.0_dp, "accelerations")
        end subroutine mirror
    end subroutine sizes_have_no_sign
end module test_term_sizes
