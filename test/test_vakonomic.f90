module test_vakonomic
    !! The disk with its constraint inside L: its equations against Lagrange's with multipliers, the
    !! page's numbers by hand, its control, its picture.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_report, only: report_t
    use lagrangia_vakonomic_disk, only: new_vakonomic_disk, vakonomic_disk_t
    use page_rows, only: check_row, new_page
    implicit none (type, external)
    private
    public :: vakonomic_suite

contains

    function vakonomic_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("vakonomic")
        call suite%addTest(TestMethod("equations_with_multipliers", equations_with_multipliers))
        call suite%addTest(TestMethod("numbers_by_hand", numbers_by_hand))
        call suite%addTest(TestMethod("the_picture", the_picture))
    end function vakonomic_suite

    subroutine equations_with_multipliers()
        !! All four Lagrange equations of \(L + \mu_1(\dot x - R\dot\varphi\sin\theta)
        !! + \mu_2(\dot y + R\dot\varphi\cos\theta)\), with the rates of
        !! \(\mu_1 = P - m\dot x\) and \(\mu_2 = Q - m\dot y\).
        real(dp), parameter :: m = 1.3_dp, r = 0.3_dp, i3 = 0.06_dp, i1 = 0.03_dp, pull = 0.9_dp, &
                               t = 0.8_dp, th = 0.7_dp, roll = 4.0_dp, steer = 1.1_dp, &
                               s = sin(th), c = cos(th)
        type(vakonomic_disk_t) :: disk
        real(dp) :: a(4), q(4), v(4), mu(2), rate(2), left(4)

        disk = new_vakonomic_disk(m, r, i3, i1, pull, 0.4_dp, -0.5_dp)
        q = [0.0_dp, 0.0_dp, 0.0_dp, th]
        v = [r*s*roll, -r*c*roll, roll, steer]
        call disk%accelerations(t, q, v, a)
        mu = [m*0.4_dp + m*pull*t - m*v(1), -m*0.5_dp - m*v(2)]
        rate = [m*pull - m*a(1), -m*a(2)]
        left(1) = m*a(1) + rate(1) - m*pull
        left(2) = m*a(2) + rate(2)
        left(3) = i3*a(3) - rate(1)*r*s - mu(1)*r*c*steer + rate(2)*r*c - mu(2)*r*s*steer
        left(4) = i1*a(4) + mu(1)*r*roll*c + mu(2)*r*roll*s
        call assertEqual([0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], left, 1e-14_dp, "Lagrange's equations")
        ! it goes on rolling: the constraint's rate
        call assertEqual([r*(a(3)*s + roll*steer*c), -r*(a(3)*c - roll*steer*s)], a(:2), 1e-14_dp, &
                         "x_ddot, y_ddot")
    end subroutine equations_with_multipliers

    subroutine numbers_by_hand()
        !! kappa = 2 g sin(0.1)/(3 R); three turns of 1.1 rad/s.
        real(dp), parameter :: pi = acos(-1.0_dp), kappa = 2.0_dp*9.81_dp*sin(0.1_dp)/0.9_dp, &
                               time = 6.0_dp*pi/1.1_dp
        type(report_t) :: page

        call new_page("vakonomic", page)
        call check_row(page, "D'Alembert", "y = R kappa", 0.3_dp*kappa/2.2_dp*time, &
                       0.3_dp*kappa/2.2_dp*time, 1e-11_dp)
        call check_row(page, "D'Alembert", "x: it comes back", 0.0_dp, 0.0_dp, 1e-11_dp)
        call check_row(page, "steering locked", "phi", 12.0_dp + 4.5_dp*kappa*sin(0.7_dp), &
                       12.0_dp + 4.5_dp*kappa*sin(0.7_dp), 1e-11_dp)
        call check_row(page, "the constraint inside L", "its energy", 0.5_dp*16.0_dp*1.5_dp*1.3_dp &
                       *0.09_dp + 0.5_dp*0.25_dp*1.3_dp*0.09_dp*1.21_dp, 0.5_dp*16.0_dp*1.5_dp &
                       *1.3_dp*0.09_dp + 0.5_dp*0.25_dp*1.3_dp*0.09_dp*1.21_dp, 1e-9_dp)
    end subroutine numbers_by_hand

    subroutine the_picture()
        !! The one goes to and fro in x, the other down, by metres.
        type(report_t) :: page

        call new_page("vakonomic", page)
        if (anyExceptions()) return
        associate (values => page%picture%values)
            call assertEqual(501, size(values, 2), "samples")
            call assertTrue(maxval(values(2, :)) - minval(values(2, :)) < &
                            0.3_dp*maxval(values(3, :)), "bounded; downhill")
            call assertTrue(maxval(abs(values(5, :))) < maxval(values(4, :)), "sideways; hardly")
        end associate
        call assertTrue(index(page%picture%title, "drifts sideways (y)") > 0, "title")
    end subroutine the_picture
end module test_vakonomic
