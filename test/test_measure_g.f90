module test_measure_g
    !! The page on measuring g: errors by hand, the best masses, the picture.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_report, only: report_t
    use page_rows, only: check_row, new_page
    implicit none (type, external)
    private
    public :: measure_g_suite

    real(dp), parameter :: g = 9.81_dp

contains

    function measure_g_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("measure_g")
        call suite%addTest(TestMethod("errors_by_differences", errors_by_differences))
        call suite%addTest(TestMethod("masses_by_hand", masses_by_hand))
        call suite%addTest(TestMethod("the_picture", the_picture))
    end function measure_g_suite

    pure function g_of(x) result(value)
        !! From height, both masses, time.
        real(dp), intent(in) :: x(4)
        real(dp) :: value

        value = 2.0_dp*x(1)*(x(2) + x(3))/((x(2) - x(3))*x(4)**2)
    end function g_of

    subroutine errors_by_differences()
        !! \(\sigma_g\) from the slopes of g by what is measured, as differences over a hundredth of
        !! each error; a simulated scatter is within 2 %, and what is left out, of it.
        type(report_t) :: page
        real(dp), parameter :: errors(4) = [1e-3_dp, 1e-3_dp, 1e-3_dp, 0.1_dp]
        real(dp) :: x(4), sum_of_squares, sigma, right, up(4), down(4)
        character(5), parameter :: names(3) = ["20 g ", "40 g ", "100 g"]
        real(dp), parameter :: shares(3) = [0.01_dp, 0.02_dp, 0.05_dp]
        integer :: i, k, at

        call new_page("measure-g", page)
        do i = 1, 3
            x = [1.5_dp, 1.0_dp + shares(i), 1.0_dp - shares(i), sqrt(3.0_dp/(shares(i)*g))]
            sum_of_squares = 0.0_dp
            do k = 1, 4
                up = x
                up(k) = x(k) + 0.01_dp*errors(k)
                down = x
                down(k) = x(k) - 0.01_dp*errors(k)
                sum_of_squares = sum_of_squares + (50.0_dp*(g_of(up) - g_of(down)))**2
            end do
            sigma = sqrt(sum_of_squares)/g
            at = findloc(page%rows%name == "m1 - m2 = "//names(i), .true., 1)
            call assertTrue(at > 0, names(i))
            if (at == 0) return
            right = page%rows(at)%right
            call assertEqual(sigma, right, 1e-5_dp*sigma, names(i))
            call assertEqual(sigma, page%rows(at)%left, 0.05_dp*sigma, "simulated, "//names(i))
        end do
    end subroutine errors_by_differences

    subroutine masses_by_hand()
        !! The cube root of 2 h s_m^2/(M^2 g s_t^2) = 3e-6/0.3924.
        type(report_t) :: page
        real(dp) :: best

        call new_page("measure-g", page)
        best = exp(log(3e-6_dp/0.3924_dp)/3.0_dp)
        call check_row(page, "the best", "(m1 - m2)/M", best, best, 1e-5_dp)
        call check_row(page, "m1 = 1.1", "with that pulley", g/1.1_dp, g, 1e-10_dp)
        call check_row(page, "m1 = 1.1", "t = sqrt", sqrt(3.0_dp/0.981_dp), &
                       sqrt(3.0_dp/0.981_dp), 1e-12_dp)
        call check_row(page, "m1 = 1.1", "g = 2 h M", g, g, 1e-10_dp)
    end subroutine masses_by_hand

    subroutine the_picture()
        !! Lowest where the formula says; the watch's part rises, the scales' falls. The squares of
        !! both, and of the ruler's part, 1 mm in 1.5 m, add up; the watch is 0.1 s off twice.
        type(report_t) :: page
        integer :: n

        call new_page("measure-g", page)
        if (anyExceptions()) return
        associate (values => page%picture%values)
            n = size(values, 2)
            call assertEqual(0.0197_dp, values(1, minloc(values(2, :), 1)), 5e-4_dp, "lowest")
            call assertTrue(all(values(3, 2:) > values(3, :n - 1)), "the watch")
            call assertTrue(all(values(4, 2:) < values(4, :n - 1)), "the scales")
            call assertEqual(20.0_dp/sqrt(3.0_dp/(values(1, :)*g)), values(3, :), 1e-12_dp, &
                             "twice the watch's error over the time, %")
            call assertEqual(values(2, :)**2, values(3, :)**2 + values(4, :)**2 + &
                             (0.1_dp/1.5_dp)**2, 1e-10_dp, "squares add up")
        end associate
    end subroutine the_picture
end module test_measure_g
