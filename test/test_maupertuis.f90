module test_maupertuis
    !! Maupertuis' page: two throws by hand, the control, the picture.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_report, only: report_t
    use page_rows, only: check_row, new_page
    implicit none (type, external)
    private
    public :: maupertuis_suite

    real(dp), parameter :: pi = acos(-1.0_dp), m = 0.5_dp, g = 9.81_dp, v = 8.0_dp
    real(dp), parameter :: root = sqrt(v**4 - g*(16.0_dp*g + 2.0_dp*v**2))
    real(dp), parameter :: slopes(2) = (v**2 + [-root, root])/(4.0_dp*g)

contains

    function maupertuis_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("maupertuis")
        call suite%addTest(TestMethod("actions_of_both_throws", actions_of_both_throws))
        call suite%addTest(TestMethod("least_or_not", least_or_not))
        call suite%addTest(TestMethod("what_fixed_time_would_give", what_fixed_time_would_give))
        call suite%addTest(TestMethod("the_picture", the_picture))
    end function maupertuis_suite

    subroutine actions_of_both_throws()
        !! From the speeds at the ends, with \(s\) the slope: \(A = m\int v^2dt\),
        !! \(v^2 = v_x^2(1 + (s - gt/v_x)^2)\), so
        !! \(A = mv_x^3/g\,[F(s) - F(s - gT/v_x)]\), \(F(u) = u + u^3/3\).
        type(report_t) :: page
        real(dp) :: vx, a, last
        character(5), parameter :: names(2) = ["flat ", "steep"]
        integer :: i

        call new_page("maupertuis", page)
        do i = 1, 2
            vx = v/sqrt(1.0_dp + slopes(i)**2)
            last = slopes(i) - 4.0_dp*g/vx**2
            a = m*vx**3/g*(slopes(i) + slopes(i)**3/3.0_dp - last - last**3/3.0_dp)
            call check_row(page, "two throws", trim(names(i))//": A", a, a, 1e-12_dp)
            call check_row(page, "two throws", trim(names(i))//" throw: it hits", 1.0_dp, 1.0_dp, &
                           1e-14_dp)
        end do
    end subroutine actions_of_both_throws

    subroutine least_or_not()
        !! The second variation by another rule: Jacobi's. With \(\eta = \sin(\pi x/x_1)\) and
        !! \(f = m\sqrt{v^2 - 2gy}\sqrt{1 + y'^2}\),
        !! \(d^2A/da^2 = \int f_{yy}\eta^2 + 2f_{yy'}\eta\eta' + f_{y'y'}\eta'^2\).
        type(report_t) :: page
        real(dp) :: second(2)
        integer :: i

        do i = 1, 2
            second(i) = jacobi(slopes(i))
        end do
        call assertTrue(second(1) > 0.0_dp .and. second(2) < 0.0_dp, "a minimum, and none")
        call new_page("maupertuis", page)
        call check_row(page, "is A least", "flat throw", second(1), 0.0_dp, 1e-6_dp*second(1))
        call check_row(page, "is A least", "steep throw", second(2), 0.0_dp, 1e-6_dp*abs(second(2)))
    end subroutine least_or_not

    pure function jacobi(slope) result(total)
        !! Simpson's rule, 4000 intervals.
        real(dp), intent(in) :: slope
        real(dp) :: total
        integer, parameter :: n = 4000
        real(dp) :: x, y, p, w, root_p, f(3), eta, rate
        integer :: k

        total = 0.0_dp
        do k = 0, n
            x = 4.0_dp*k/n
            y = slope*x - 0.5_dp*g*x**2*(1.0_dp + slope**2)/v**2
            p = slope - g*x*(1.0_dp + slope**2)/v**2
            w = sqrt(v**2 - 2.0_dp*g*y)
            root_p = sqrt(1.0_dp + p**2)
            eta = sin(pi*x/4.0_dp)
            rate = pi/4.0_dp*cos(pi*x/4.0_dp)
            f = m*[-g**2/w**3*root_p, -g/w*p/root_p, w/root_p**3]
            total = total + merge(1.0_dp, merge(4.0_dp, 2.0_dp, modulo(k, 2) == 1), &
                                  k == 0 .or. k == n)*4.0_dp/n/3.0_dp &
                    *(f(1)*eta**2 + 2.0_dp*f(2)*eta*rate + f(3)*rate**2)
        end do
    end function jacobi

    subroutine what_fixed_time_would_give()
        !! \(2mg\int_0^T\sin(\pi t/T)dt = 4mgT/\pi\).
        type(report_t) :: page
        real(dp) :: t

        call new_page("maupertuis", page)
        t = 4.0_dp*sqrt(1.0_dp + slopes(1)**2)/v
        call check_row(page, "paths of one time", "d/da int p dq = 0?", 4.0_dp*m*g*t/pi, 0.0_dp, &
                       1e-12_dp)
        call check_row(page, "the envelope", "is it v^2/2g", 0.5_dp*(v**2/g - 16.0_dp*g/v**2), &
                       0.5_dp*v**2/g, 1e-6_dp)
    end subroutine what_fixed_time_would_give

    subroutine the_picture()
        !! Both throws end at the point; only the steep one touches the envelope on its way.
        type(report_t) :: page

        call new_page("maupertuis", page)
        if (anyExceptions()) return
        associate (values => page%picture%values)
            call assertEqual([4.0_dp, 1.0_dp, 1.0_dp], values(:3, size(values, 2)), 1e-14_dp, "end")
            call assertTrue(minval(values(4, :) - values(3, :)) < 1e-3_dp .and. &
                            minval(values(4, :) - values(2, :)) > 0.1_dp, "touches")
        end associate
    end subroutine the_picture
end module test_maupertuis
