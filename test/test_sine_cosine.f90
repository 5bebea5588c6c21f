module test_sine_cosine
    !! Sine and cosine in lanes, against quadruple precision.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_positive_inf, ieee_quiet_nan, &
                                             ieee_value
    use, intrinsic :: iso_fortran_env, only: real128
    use funit, only: TestMethod, TestSuite, assertEqual, assertLessThan, assertTrue
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_sine_cosine, only: largest_angle, sine_cosine, sines_cosines, two_sines_cosines
    implicit none (type, external)
    private
    public :: sine_cosine_suite

    integer, parameter :: qp = real128

contains

    function sine_cosine_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("sine_cosine")
        call suite%addTest(TestMethod("below_one_unit", below_one_unit))
        call suite%addTest(TestMethod("next_to_multiples_of_half_pi", next_to_multiples_of_half_pi))
        call suite%addTest(TestMethod("beyond_its_range", beyond_its_range))
        call suite%addTest(TestMethod("two_are_as_in_lanes", two_are_as_in_lanes))
        call suite%addTest(TestMethod("any_number_is_as_in_lanes", any_number_is_as_in_lanes))
    end function sine_cosine_suite

    subroutine below_one_unit()
        !! In the first quadrants, some turns, and the whole range; 2^-1000 and 0 besides.
        real(dp), parameter :: ranges(4) = [0.7853981633974483_dp, 7.0_dp, 1e3_dp, largest_angle]
        real(dp), parameter :: golden = 0.5_dp*(sqrt(5.0_dp) - 1.0_dp)  !! fills an interval evenly
        real(dp) :: x(lanes), worst
        integer :: i, j, k

        worst = 0.0_dp
        do k = 1, size(ranges)
            do i = 1, 1500
                x = [(modulo((lanes*i + j)*golden, 1.0_dp), j=1, lanes)]
                call compare((2.0_dp*x - 1.0_dp)*ranges(k), worst)
            end do
        end do
        call compare([(2.0_dp**(-125*i), i=1, lanes)], worst)
        call compare([real(dp) :: 0, 1, 2, 3, 4, 5, -1, -2], worst)
        call assertLessThan(worst, 1.0_dp, message="units in the last place")
    end subroutine below_one_unit

    subroutine next_to_multiples_of_half_pi()
        !! All that the range has, where almost everything cancels: among them 29 pi/2, to which a
        !! double comes nearest.
        real(dp), parameter :: half_pi = 0.5_dp*acos(-1.0_dp)
        real(dp) :: worst
        integer :: i, n

        worst = 0.0_dp
        do n = 1, int(largest_angle/half_pi) - lanes, lanes
            call compare([((n + i)*half_pi, i=0, lanes - 1)], worst)
            call compare([(-nearest((n + i)*half_pi, 1.0_dp), i=0, lanes - 1)], worst)
        end do
        call assertLessThan(worst, 1.0_dp, message="units in the last place")
    end subroutine next_to_multiples_of_half_pi

    subroutine beyond_its_range()
        !! There libm answers, lane by lane; what is not finite is NaN. To the last bit but one:
        !! of constants the compiler may know the sine better than libm.
        real(dp) :: x(lanes), s(lanes), c(lanes)
        integer :: i

        do i = 1, lanes
            x = 0.5_dp
            x(i) = 1e22_dp
            call sine_cosine(x, s, c)
            call assertEqual([sin(x(i)), cos(x(i))], [s(i), c(i)], epsilon(x), "alone in its lane")
        end do
        x = [1e5_dp, -1e22_dp, huge(x), 0.5_dp, largest_angle*(1 + epsilon(x)), 0.0_dp, 0.0_dp, &
             -0.5_dp]
        x(6) = ieee_value(x(6), ieee_positive_inf)
        x(7) = ieee_value(x(7), ieee_quiet_nan)
        call sine_cosine(x, s, c)
        call assertEqual(sin(x(1:3)), s(1:3), epsilon(x))
        call assertEqual(cos(x(1:3)), c(1:3), epsilon(x))
        call assertEqual(sin(x(5)), s(5), epsilon(x))
        call assertTrue(all(ieee_is_nan(s(6:7))) .and. all(ieee_is_nan(c(6:7))), "NaN")
        call assertEqual(s(4), -s(8))
        call assertEqual(c(4), c(8))
        call assertEqual(real(sin(0.5_qp), dp), s(4), epsilon(x))
    end subroutine beyond_its_range

    subroutine two_are_as_in_lanes()
        !! Bit for bit, wherever they are, and if one of them is beyond the range, or none.
        real(dp) :: x(lanes), s(lanes), c(lanes), sine(2), cosine(2), nan
        integer :: i, k

        do k = 1, 400
            do i = 1, lanes
                x(i) = sin(real(lanes*k + i, dp))*10.0_dp**modulo(lanes*k + i, 7)
            end do
            call sine_cosine(x, s, c)
            do i = 1, lanes - 1
                call two_sines_cosines(x(i), x(i + 1), sine, cosine)
                call assertEqual(s(i:i + 1), sine, message="sines as in lanes")
                call assertEqual(c(i:i + 1), cosine, message="cosines as in lanes")
            end do
        end do
        nan = ieee_value(nan, ieee_quiet_nan)
        call two_sines_cosines(nan, 0.5_dp, sine, cosine)
        call assertTrue(ieee_is_nan(sine(1)) .and. ieee_is_nan(cosine(1)), "NaN of NaN")
        call assertEqual(real(sin(0.5_qp), dp), sine(2), epsilon(x), "not beside it")
    end subroutine two_are_as_in_lanes

    subroutine any_number_is_as_in_lanes()
        !! None, fewer than a vector has, as many, and more; nothing behind them is touched.
        integer, parameter :: most = 3*lanes
        real(dp) :: x(most), s(most), c(most), sine(most + 1), cosine(most + 1)
        integer :: i, n

        x = [(0.37_dp*i - 3.0_dp, i=1, most)]
        do i = 1, most, lanes
            call sine_cosine(x(i:i + lanes - 1), s(i:i + lanes - 1), c(i:i + lanes - 1))
        end do
        do n = 0, most
            sine = 2.0_dp
            cosine = 3.0_dp
            call sines_cosines(n, x(:n), sine(:n), cosine(:n))
            call assertEqual(s(:n), sine(:n), message="sines as in lanes")
            call assertEqual(c(:n), cosine(:n), message="cosines as in lanes")
            call assertTrue(all(sine(n + 1:) >= 2.0_dp) .and. all(cosine(n + 1:) >= 3.0_dp), &
                            "no more than so many")
        end do
    end subroutine any_number_is_as_in_lanes

    subroutine compare(x, worst)
        real(dp), intent(in) :: x(lanes)
        real(dp), intent(inout) :: worst  !! the largest error so far, units in the last place
        real(dp) :: s(lanes), c(lanes)
        integer :: i

        call sine_cosine(x, s, c)
        do i = 1, lanes
            call look(sin(real(x(i), qp)), s(i))
            call look(cos(real(x(i), qp)), c(i))
        end do
    contains
        subroutine look(exact, value)
            real(qp), intent(in) :: exact
            real(dp), intent(in) :: value
            real(dp) :: error

            if (abs(exact) <= 0.0_qp) then
                call assertEqual(0.0_dp, value)
                return
            end if
            error = real(abs(value - exact)/spacing(abs(real(exact, dp))), dp)
            if (.not. error <= worst) worst = error
        end subroutine look
    end subroutine compare
end module test_sine_cosine
