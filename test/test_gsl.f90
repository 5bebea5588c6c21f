module test_gsl
    !! GSL's `elljac` and Brent's root finder behind our door: right, or refused.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_elliptic, only: jacobi
    use lagrangia_errors, only: error_t, status_library, status_numbers
    use lagrangia_gsl, only: brent_root, jacobi_sn_cn_dn
    use lagrangia_kinds, only: dp
    use lagrangia_roots, only: find_root, scalar_function_t
    implicit none (type, external)
    private
    public :: gsl_suite

    real(dp), parameter :: eps = epsilon(1.0_dp)

    type, extends(scalar_function_t) :: power_t
        !! \(x^n - c\).
        integer :: n
        real(dp) :: c
    contains
        procedure :: value => power_value
    end type power_t

contains

    function gsl_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("gsl")
        call suite%addTest(TestMethod("agrees_where_it_can", agrees_where_it_can))
        call suite%addTest(TestMethod("refuses_the_rest", refuses_the_rest))
        call suite%addTest(TestMethod("finds_roots", finds_roots))
        call suite%addTest(TestMethod("refuses_what_has_no_root", refuses_what_has_no_root))
    end function gsl_suite

    subroutine agrees_where_it_can()
        !! GSL sees \(1 - k^2\) only: the tolerance is that rounding, \(\epsilon/k'^2\), times `u`.
        real(dp), parameter :: k(3) = [0.3_dp, 0.6_dp, 0.995_dp], u = 1.9_dp
        real(dp) :: ours(3), gsl(3), kc
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, size(k)
            kc = sqrt((1.0_dp - k(i))*(1.0_dp + k(i)))
            call jacobi(u, kc, ours(1), ours(2), ours(3))
            call jacobi_sn_cn_dn(u, k(i), gsl(1), gsl(2), gsl(3), error)
            call assertFalse(allocated(error), "no error: agrees where it can")
            call assertEqual(ours, gsl, tolerance=4.0_dp*eps*u/kc**2)
        end do
    end subroutine agrees_where_it_can

    subroutine refuses_the_rest()
        !! Where `elljac` would be silently wrong we refuse; where GSL refuses, its words come.
        real(dp) :: bad, sn, cn, dn
        type(error_t), allocatable :: error

        sn = 7.0_dp
        cn = 7.0_dp
        dn = 7.0_dp
        call jacobi_sn_cn_dn(9.0_dp, 1.0_dp - 0.5_dp*eps, sn, cn, dn, error)
        call assertTrue(allocated(error), "an error: refuses the rest")
        call assertEqual([0.0_dp, 0.0_dp, 0.0_dp], [sn, cn, dn])
        if (allocated(error)) then
            call assertEqual("elljac: no digit is right this close to modulus 1", error%message)
            call assertEqual(status_library, error%status)
        end if
        call jacobi_sn_cn_dn(9.0_dp, 1.2_dp, sn, cn, dn, error)
        call assertTrue(allocated(error), "an error: refuses the rest")
        if (allocated(error)) then
            call assertEqual("elljac: GSL says: input domain error", error%message)
            call assertEqual(status_library, error%status)
        end if
        bad = ieee_value(1.0_dp, ieee_quiet_nan)
        call jacobi_sn_cn_dn(bad, 0.5_dp, sn, cn, dn, error)
        call assertTrue(allocated(error), "an error: refuses the rest")
        call jacobi_sn_cn_dn(0.5_dp, bad, sn, cn, dn, error)
        call assertTrue(allocated(error), "an error: refuses the rest")
        if (allocated(error)) then
            call assertEqual("elljac: argument and modulus must be finite", error%message)
            call assertEqual(status_numbers, error%status)
        end if
    end subroutine refuses_the_rest

    subroutine finds_roots()
        !! To two roundings, of tiny and of large numbers, falling and rising, and at an end; our
        !! own method finds the same.
        call try(power_t(3, 2.0_dp), 0.0_dp, 5.0_dp, 2.0_dp**(1.0_dp/3.0_dp))
        call try(power_t(2, 3e-20_dp), -1.0_dp, 0.0_dp, -sqrt(3e-20_dp))
        call try(power_t(1, 1e10_dp), 1e-5_dp, 1e12_dp, 1e10_dp)
        call try(power_t(1, 0.0_dp), 0.0_dp, 1.0_dp, 0.0_dp)
    contains
        subroutine try(f, lower, upper, truth)
            type(power_t), intent(in) :: f
            real(dp), intent(in) :: lower, upper, truth
            type(power_t) :: g
            real(dp) :: root, ours
            type(error_t), allocatable :: error

            g = f
            call brent_root(g, lower, upper, root, error)
            call assertFalse(allocated(error), "no error: try")
            call assertEqual(truth, root, tolerance=4.0_dp*eps*abs(truth))
            call find_root(g, lower, upper, ours, error)
            call assertFalse(allocated(error), "no error: try")
            call assertEqual(ours, root, tolerance=4.0_dp*eps*abs(truth))
        end subroutine try
    end subroutine finds_roots

    subroutine refuses_what_has_no_root()
        !! One sign, ends in the wrong order, no number at one end.
        call try(power_t(2, -1.0_dp), -1.0_dp, 1.0_dp, &
                 "root: the function has one sign at both ends")
        call try(power_t(2, 5.0_dp), -1.0_dp, 1.0_dp, &
                 "root: the function has one sign at both ends")
        call try(power_t(1, 0.5_dp), 1.0_dp, 0.0_dp, &
                 "root: two ends, in order, and finite values there are needed")
        call try(power_t(-1, 0.5_dp), 0.0_dp, 5.0_dp, &
                 "root: two ends, in order, and finite values there are needed")
    contains
        subroutine try(f, lower, upper, message)
            type(power_t), intent(in) :: f
            real(dp), intent(in) :: lower, upper
            character(*), intent(in) :: message
            type(power_t) :: g
            type(error_t), allocatable :: error
            real(dp) :: root

            g = f
            call brent_root(g, lower, upper, root, error)
            call assertTrue(allocated(error), message)
            if (.not. allocated(error)) return
            call assertEqual(message, error%message)
            call assertEqual(status_numbers, error%status)
            call assertEqual(0.0_dp, root)
        end subroutine try
    end subroutine refuses_what_has_no_root

    function power_value(self, x) result(y)
        class(power_t), intent(inout) :: self
        real(dp), intent(in) :: x
        real(dp) :: y

        y = x**self%n - self%c
    end function power_value
end module test_gsl
