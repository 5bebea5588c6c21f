module test_same_motion_page
    !! Other Lagrangians of the same motion: the page's numbers by hand, its controls, its picture.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_report, only: report_t
    use page_rows, only: check_row, new_page
    implicit none (type, external)
    private
    public :: same_motion_page_suite

    real(dp), parameter :: rounding = 1e-13_dp  !! of numbers up to 10
    character(*), parameter :: plane = "oscillator in the plane", damped = "damped oscillator"

contains

    function same_motion_page_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("same_motion_page")
        call suite%addTest(TestMethod("in_the_plane", in_the_plane))
        call suite%addTest(TestMethod("with_friction", with_friction))
        call suite%addTest(TestMethod("the_picture", the_picture))
    end function same_motion_page_suite

    subroutine in_the_plane()
        !! x = 0.7, y = -0.4, x_dot = -0.9, y_dot = 1.6, omega = 2; off the motion x_ddot = 0.3,
        !! y_ddot = 1.1.
        type(report_t) :: page

        call new_page("same-motion", page)
        call check_row(page, plane, "x_ddot", -2.8_dp, -2.8_dp, rounding)
        call check_row(page, plane, "y_ddot", 1.6_dp, 1.6_dp, rounding)
        call check_row(page, plane, "is p_x'", 1.6_dp, -0.9_dp, rounding)
        call check_row(page, plane, "h' =", -1.44_dp - 1.12_dp, -1.44_dp - 1.12_dp, rounding)
        call check_row(page, plane, "is h' the energy", -2.56_dp, 0.5_dp*(0.81_dp + 2.56_dp &
                       + 4.0_dp*0.65_dp), rounding)
        call check_row(page, plane, "x p_x'", 1.12_dp - 0.36_dp, 1.12_dp - 0.36_dp, rounding)
        call check_row(page, plane, "off the motion", -0.5_dp, -0.5_dp, rounding)
        call check_row(page, plane, "is L' - L", -0.5_dp - 3.1_dp, 0.0_dp, rounding)
    end subroutine in_the_plane

    subroutine with_friction()
        !! m = 0.5, k = 2, gamma = 0.6, t = 1.3, x = 0.7, x_dot = -0.9; off the motion x_ddot = 0.3.
        real(dp), parameter :: grown = exp(0.78_dp)
        type(report_t) :: page

        call new_page("same-motion", page)
        call check_row(page, damped, "x_ddot", 0.54_dp - 2.8_dp, 0.54_dp - 2.8_dp, rounding)
        call check_row(page, damped, "is p'", -0.45_dp*grown, -0.45_dp, rounding)
        call check_row(page, damped, "h' + gamma", 1.0_dp, 1.0_dp, rounding)
        call check_row(page, damped, "off: exp", grown*1.28_dp, grown*1.28_dp, rounding)
        call check_row(page, damped, "is it that", grown*1.28_dp, 0.15_dp - 0.27_dp + 1.4_dp, &
                       rounding)
        call check_row(page, "L and 2 L", "is 2 L - L", 1.55_dp, 0.0_dp, rounding)
    end subroutine with_friction

    subroutine the_picture()
        !! An energy that goes from 1 J to nothing, and a number that stays at 1 J.
        type(report_t) :: page

        call new_page("same-motion", page)
        if (anyExceptions()) return
        associate (values => page%picture%values)
            call assertEqual(301, size(values, 2), "samples")
            call assertEqual(1.0_dp, maxval(values(4, :)), rounding, "stays")
            call assertEqual(1.0_dp, minval(values(4, :)), rounding, "stays")
            call assertTrue(values(3, 301) < 0.05_dp, "goes")
        end associate
    end subroutine the_picture
end module test_same_motion_page
