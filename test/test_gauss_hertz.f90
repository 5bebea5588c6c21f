module test_gauss_hertz
    !! Gauss' and Hertz' page: Z and curvatures by hand, controls, the picture.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_report, only: report_t
    use page_rows, only: check_row, new_page
    implicit none (type, external)
    private
    public :: gauss_hertz_suite

    real(dp), parameter :: rounding = 1e-11_dp

contains

    function gauss_hertz_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("gauss_hertz")
        call suite%addTest(TestMethod("neighbours_by_hand", neighbours_by_hand))
        call suite%addTest(TestMethod("curvature_by_hand", curvature_by_hand))
        call suite%addTest(TestMethod("the_picture", the_picture))
    end function gauss_hertz_suite

    subroutine neighbours_by_hand()
        !! \(M\) of the cart-pendulum at theta = 1.1.
        real(dp), parameter :: off = 0.7_dp*0.9_dp*cos(1.1_dp)
        type(report_t) :: page

        call new_page("gauss-hertz", page)
        call check_row(page, "Gauss", "delta = (0.1, 0)", 0.02_dp, 0.02_dp, rounding)
        call check_row(page, "Gauss", "delta = (0, 0.1)", 0.00567_dp, 0.00567_dp, rounding)
        call check_row(page, "Gauss", "delta = (1, -2)", 2.0_dp + 4.0_dp*0.567_dp - 4.0_dp*off, &
                       2.0_dp + 4.0_dp*0.567_dp - 4.0_dp*off, rounding)
    end subroutine neighbours_by_hand

    subroutine curvature_by_hand()
        !! Accelerations changed by \(\delta\) bend the path along the sphere by
        !! \(R|\dot\theta\sin\theta\,\delta_\varphi - \dot\varphi\sin\theta\,\delta_\theta|R/v^3\),
        !! across to \(1/R\).
        real(dp), parameter :: r = 0.8_dp, s = sin(1.0_dp), rates(2) = [0.9_dp, 2.3_dp], &
                               delta(2) = [0.4_dp, -0.7_dp], &
                               square = r**2*(rates(1)**2 + (s*rates(2))**2), &
                               sideways = r**2*abs(rates(1)*s*delta(2) - s*rates(2)*delta(1)) &
                               /square**1.5_dp
        type(report_t) :: page
        real(dp) :: more

        call new_page("gauss-hertz", page)
        call check_row(page, "Hertz", "another path", hypot(1.0_dp/r, sideways), 1.0_dp/r, rounding)
        more = 0.5_dp*r**2*(delta(1)**2 + (s*delta(2))**2)
        call check_row(page, "with weight", "Gauss: Z more", more, more, rounding)
    end subroutine curvature_by_hand

    subroutine the_picture()
        !! Parabolas with their lowest point in the middle; 1/R without weight, more with it.
        type(report_t) :: page
        integer :: k

        call new_page("gauss-hertz", page)
        if (anyExceptions()) return
        associate (values => page%picture%values)
            call assertEqual(301, size(values, 2), "samples")
            call assertEqual([151, 151], minloc(values(5:6, :), 2), "least in the middle")
            do k = 1, size(values, 2)
                call assertEqual(1.25_dp, values(2, k), rounding, "1/R")
            end do
            call assertTrue(all(values(3, :) >= 1.25_dp - rounding), "never less")
            call assertTrue(maxval(values(3, :)) > 1.3_dp, "more")
        end associate
    end subroutine the_picture
end module test_gauss_hertz
