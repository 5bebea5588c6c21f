module test_dop853_control
    !! How long the next step of `dop853` is, alone and in lanes.
    use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, assertEqual, assertLessThan
    use lagrangia_dop853_control, only: least_error, next_step, next_steps
    use lagrangia_kinds, only: dp, lanes
    implicit none (type, external)
    private
    public :: dop853_control_suite

    real(dp), parameter :: h = 0.7_dp

contains

    function dop853_control_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("dop853_control")
        call suite%addTest(TestMethod("lengths_are_the_books", lengths_are_the_books))
        call suite%addTest(TestMethod("what_is_no_common_number", what_is_no_common_number))
    end function dop853_control_suite

    subroutine lengths_are_the_books()
        !! A million errors from 1e-9 to 1e9 in tolerances, after as many others, against the
        !! book's formula by libm. A logarithm to base 2 is right to 3e-11 and multiplied by 0.117
        !! and \(\ln 2\), that of the error before by 0.04, a power to 1e-11: 1.4e-11 all in all.
        real(dp), parameter :: golden = 0.5_dp*(sqrt(5.0_dp) - 1.0_dp)  !! fills an interval evenly
        real(dp), dimension(lanes) :: before, last, next, scaled
        real(dp) :: worst
        integer :: i, j

        worst = 0.0_dp
        do i = 1, 1000000/lanes
            do j = 1, lanes
                scaled(j) = 1e-9_dp*1e18_dp**modulo((lanes*i + j)*golden, 1.0_dp)
                before(j) = 1e-4_dp**modulo((lanes*i + j)*golden**2, 1.0_dp)
            end do
            last = log(before)/log(2.0_dp)
            call next_steps([(h, j=1, lanes)], scaled, last, next)
            do j = 1, lanes
                worst = max(worst, abs(next(j)/of_the_book(scaled(j), before(j)) - 1.0_dp))
                if (scaled(j) <= 1.0_dp) before(j) = max(scaled(j), 1e-4_dp)
            end do
            worst = max(worst, maxval(abs(last - log(before)/log(2.0_dp))/3.0_dp))
        end do
        call assertLessThan(worst, 1.4e-11_dp, message="lengths, relative")
    end subroutine lengths_are_the_books

    pure function of_the_book(scaled, before) result(next)
        !! Hairer, Norsett & Wanner, sec. II.4.
        real(dp), intent(in) :: scaled, before
        real(dp) :: next

        next = h*min(6.0_dp, 0.9_dp*before**0.04_dp/scaled**(0.125_dp - 0.008_dp))
        if (scaled > 1.0_dp) next = h*0.9_dp/scaled**(0.125_dp - 0.008_dp)
        next = max(0.333_dp*h, next)
    end function of_the_book

    subroutine what_is_no_common_number()
        !! No error at all, subnormal ones, and what is no number: alone as in each lane.
        real(dp) :: lengths(lanes), scaled(lanes), last(lanes), next(lanes), one_last, one_next
        integer :: i, lane

        scaled = [0.0_dp, tiny(h)*epsilon(h), tiny(h), 1.0_dp, nearest(1.0_dp, 2.0_dp), huge(h), &
                  ieee_value(h, ieee_positive_inf), ieee_value(h, ieee_quiet_nan)]
        do i = 1, lanes
            lengths = h
            last = least_error
            call next_steps(lengths, scaled, last, next)
            call assertEqual([6.0_dp*h, 6.0_dp*h, 6.0_dp*h], pack(next, scaled < 0.5_dp), &
                             8*epsilon(h), "no error")
            call assertEqual(least_error, maxval(last, .not. scaled <= 1.0_dp), message="rejected")
            call assertEqual([h, h, h]/10.0_dp, pack(next, .not. scaled < huge(h)), &
                             message="no number")
            do lane = 1, lanes
                one_last = least_error
                call next_step(h, scaled(lane), one_last, one_next)
                call assertEqual(next(lane), one_next, message="alone")
                call assertEqual(last(lane), one_last, message="the error alone")
            end do
            scaled = cshift(scaled, 1)
        end do
    end subroutine what_is_no_common_number
end module test_dop853_control
