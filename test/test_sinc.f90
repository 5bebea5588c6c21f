module test_sinc
    !! Quotients whose denominator may vanish, against quadruple precision.
    use, intrinsic :: iso_fortran_env, only: real128
    use funit, only: TestMethod, TestSuite, assertEqual, assertLessThanOrEqual
    use lagrangia_kinds, only: dp
    use lagrangia_sinc, only: sinc, sinc_lag, sinhc
    implicit none (type, external)
    private
    public :: sinc_suite

contains

    function sinc_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("sinc")
        call suite%addTest(TestMethod("values_at_zero", values_at_zero))
        call suite%addTest(TestMethod("values_to_rounding", values_to_rounding))
    end function sinc_suite

    subroutine values_at_zero()
        !! The limits.
        call assertEqual(1.0_dp, sinc(0.0_dp))
        call assertEqual(1.0_dp, sinhc(0.0_dp))
        call assertEqual(0.0_dp, sinc_lag(0.0_dp))
    end subroutine values_at_zero

    subroutine values_to_rounding()
        !! From 1e-8 to 30 and its negatives, on both sides of 1 where the series ends. Near a
        !! zero of the sine the error is that of the sine's own argument: hence absolute.
        integer, parameter :: qp = real128
        real(qp) :: z
        real(dp) :: x
        integer :: k

        do k = -400, 400
            x = sign(1e-8_dp*10.0_dp**(abs(k)*9.48_dp/400.0_dp), real(k, dp))
            z = x
            call assertEqual(real(sin(z)/z, dp), sinc(x), 2.0_dp*epsilon(x))
            call close(sinh(z)/z, sinhc(x))
            if (abs(x) > 1e-4_dp) call close((z - sin(z))/z**2, sinc_lag(x))
            if (abs(x) < 1e-2_dp) call close(z/6*(1 - z**2/20*(1 - z**2/42*(1 - z**2/72))), &
                                             sinc_lag(x))
        end do
    contains
        subroutine close(exact, value)
            real(qp), intent(in) :: exact
            real(dp), intent(in) :: value

            call assertLessThanOrEqual(real(abs((value - exact)/exact), dp), 8.0_dp*epsilon(x))
        end subroutine close
    end subroutine values_to_rounding
end module test_sinc
