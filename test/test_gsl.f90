module test_gsl
    !! Brent's root finder behind our door: right, or refused. GSL's Jacobi functions beside ours.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use, intrinsic :: iso_c_binding, only: c_double, c_int
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_elliptic, only: jacobi
    use lagrangia_errors, only: error_t, status_library, status_numbers
    use lagrangia_gsl, only: brent_root
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

    type, extends(scalar_function_t) :: hole_t
        !! \(x - 0.3\), but no number between 0.1 and 0.9.
    contains
        procedure :: value => value_beside_the_hole
    end type hole_t

    interface
        function gsl_sf_elljac_e(u, m, sn, cn, dn) bind(c) result(status)
            import :: c_double, c_int
            implicit none (type, external)
            real(c_double), value :: u, m
            real(c_double), intent(out) :: sn, cn, dn
            integer(c_int) :: status
        end function gsl_sf_elljac_e
    end interface

contains

    function gsl_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("gsl")
        call suite%addTest(TestMethod("agrees_where_it_can", agrees_where_it_can))
        call suite%addTest(TestMethod("finds_roots", finds_roots))
        call suite%addTest(TestMethod("refuses_what_has_no_root", refuses_what_has_no_root))
        call suite%addTest(TestMethod("a_function_with_a_hole", a_function_with_a_hole))
    end function gsl_suite

    subroutine agrees_where_it_can()
        !! GSL sees \(1 - k^2\) only: the tolerance is that rounding, \(\epsilon/k'^2\), times `u`.
        real(dp), parameter :: k(3) = [0.3_dp, 0.6_dp, 0.995_dp], u = 1.9_dp
        real(dp) :: ours(3), gsl(3), kc
        integer(c_int) :: status
        integer :: i

        do i = 1, size(k)
            kc = sqrt((1.0_dp - k(i))*(1.0_dp + k(i)))
            call jacobi(u, kc, ours(1), ours(2), ours(3))
            status = gsl_sf_elljac_e(u, k(i)**2, gsl(1), gsl(2), gsl(3))
            call assertEqual(0, status, "GSL's status")
            call assertEqual(ours, gsl, tolerance=4.0_dp*eps*u/kc**2)
        end do
    end subroutine agrees_where_it_can

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

    subroutine a_function_with_a_hole()
        !! GSL asks for a value where there is none, and says so.
        type(hole_t) :: hole
        type(error_t), allocatable :: error
        real(dp) :: root

        call brent_root(hole, 0.0_dp, 1.0_dp, root, error)
        call assertTrue(allocated(error), "refused")
        if (.not. allocated(error)) return
        call assertEqual("root: GSL says: problem with user-supplied function", error%message)
        call assertEqual(status_library, error%status)
    end subroutine a_function_with_a_hole

    function power_value(self, x) result(y)
        class(power_t), intent(inout) :: self
        real(dp), intent(in) :: x
        real(dp) :: y

        y = x**self%n - self%c
    end function power_value

    function value_beside_the_hole(self, x) result(y)
        class(hole_t), intent(inout) :: self
        real(dp), intent(in) :: x
        real(dp) :: y

        y = x - 0.3_dp
        if (x > 0.1_dp .and. x < 0.9_dp) y = ieee_value(y, ieee_quiet_nan)
    end function value_beside_the_hole
end module test_gsl
