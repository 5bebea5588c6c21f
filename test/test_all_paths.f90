module test_all_paths
    !! All paths between two events: none is missed, indices alternate, descent, the picture.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_report, only: report_t
    use page_rows, only: check_row, new_page
    implicit none (type, external)
    private
    public :: all_paths_suite

contains

    function all_paths_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("all_paths")
        call suite%addTest(TestMethod("none_is_missed", none_is_missed))
        call suite%addTest(TestMethod("oscillators_by_hand", oscillators_by_hand))
        call suite%addTest(TestMethod("the_picture", the_picture))
    end function all_paths_suite

    subroutine none_is_missed()
        !! Starts of RK4, 1001 of them over all that do not go over the top, pass through 1 rad at
        !! the end as often as there are paths.
        real(dp), parameter :: w0 = sqrt(9.81_dp/0.8_dp)
        type(report_t) :: page
        real(dp) :: before, now
        integer :: crossings, i

        call new_page("all-paths", page)
        crossings = 0
        before = at_end(-2.0_dp*w0*0.99999_dp) - 1.0_dp
        do i = 1, 1000
            now = at_end(2.0_dp*w0*0.99999_dp*(2.0_dp*i/1000 - 1.0_dp)) - 1.0_dp
            if (now*before < 0.0_dp) crossings = crossings + 1
            before = now
        end do
        call assertEqual(5, crossings, "paths by RK4")
        call check_row(page, "pendulum", "is there one path", real(crossings, dp), 1.0_dp, 0.0_dp)
    contains
        pure function at_end(rate) result(theta)
            real(dp), intent(in) :: rate
            real(dp) :: theta
            integer, parameter :: steps = 900
            real(dp) :: v, h, k(4), s(4)
            integer :: j

            theta = 0.0_dp
            v = rate
            h = 9.0_dp/w0/steps
            do j = 1, steps
                k(1) = -w0**2*sin(theta)
                s(1) = v
                s(2) = v + 0.5_dp*h*k(1)
                k(2) = -w0**2*sin(theta + 0.5_dp*h*s(1))
                s(3) = v + 0.5_dp*h*k(2)
                k(3) = -w0**2*sin(theta + 0.5_dp*h*s(2))
                s(4) = v + h*k(3)
                k(4) = -w0**2*sin(theta + h*s(3))
                theta = theta + h/6.0_dp*(s(1) + 2.0_dp*s(2) + 2.0_dp*s(3) + s(4))
                v = v + h/6.0_dp*(k(1) + 2.0_dp*k(2) + 2.0_dp*k(3) + k(4))
            end do
        end function at_end
    end subroutine none_is_missed

    subroutine oscillators_by_hand()
        !! S = m w ((xa^2 + xb^2) cos wT - 2 xa xb)/(2 sin wT) with m = 0.5, w = 2; beyond the
        !! conjugate point descent leaves S far below.
        type(report_t) :: page
        real(dp) :: s
        integer :: at

        call new_page("all-paths", page)
        s = 0.5_dp*(1.25_dp*cos(2.0_dp) - 1.0_dp)/sin(2.0_dp)
        call check_row(page, "oscillator", "omega T = 2: S", s, s, 1e-12_dp)
        call check_row(page, "oscillator", "omega T = 2: descent", s, s, 1e-3_dp)
        s = 0.5_dp*(1.25_dp*cos(4.0_dp) - 1.0_dp)/sin(4.0_dp)
        call check_row(page, "oscillator", "omega T = 4: S", s, s, 1e-12_dp)
        at = findloc(index(page%rows%name, "omega T = 4: does") == 1, .true., 1)
        call assertTrue(at > 0, "the control")
        if (at == 0) return
        call assertTrue(page%rows(at)%left < -1e3_dp, "it runs away, downwards")
    end subroutine oscillators_by_hand

    subroutine the_picture()
        !! All begin at 0 and end at 1 rad.
        type(report_t) :: page

        call new_page("all-paths", page)
        if (anyExceptions()) return
        associate (values => page%picture%values, last => size(page%picture%values, 2))
            call assertEqual(11, size(values, 1), "time, five paths, and a variation of each")
            call assertEqual(0.0_dp, maxval(abs(values(2:, 1))), 1e-15_dp, "start")
            call assertEqual(0.0_dp, maxval(abs(values(2:6, last) - 1.0_dp)), 1e-15_dp, "end")
            call assertEqual(0.0_dp, maxval(abs(values(7:, last))), 1e-15_dp, "eta ends at 0")
            call assertTrue(all(maxval(abs(values(7:, :)), dim=2) > 0.0_dp), "eta is not 0")
        end associate
        call assertTrue(index(page%picture%title, "Paths of a pendulum from 0 to 1 rad") == 1, &
                        "title")
    end subroutine the_picture
end module test_all_paths
