module test_dalembert
    !! The page from D'Alembert to Lagrange: its numbers by hand, its control, its picture.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_report, only: report_t
    use page_rows, only: check_row, new_page
    implicit none (type, external)
    private
    public :: dalembert_suite

    real(dp), parameter :: rounding = 1e-13_dp  !! of a few dozen operations on numbers up to 20
    real(dp), parameter :: m1 = 1.3_dp, m2 = 0.7_dp, l = 0.9_dp, g = 9.81_dp

contains

    function dalembert_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("dalembert")
        call suite%addTest(TestMethod("each_term_by_hand", each_term_by_hand))
        call suite%addTest(TestMethod("what_is_left_out", what_is_left_out))
        call suite%addTest(TestMethod("the_picture", the_picture))
    end function dalembert_suite

    subroutine each_term_by_hand()
        !! \(x_2 = x + l\sin\theta\), \(y_2 = -l\cos\theta\) at theta = 1.1, theta_dot = -1.3,
        !! x_dot = 0.8, x_ddot = 2.1, theta_ddot = -0.6, differentiated on paper.
        real(dp), parameter :: s = sin(1.1_dp), c = cos(1.1_dp), u = 0.8_dp, w = -1.3_dp
        type(report_t) :: page
        real(dp) :: x_dot, y_dot, x_ddot, y_ddot, newton

        call new_page("dalembert", page)
        x_dot = u + l*c*w
        y_dot = l*s*w
        x_ddot = 2.1_dp - l*c*0.6_dp - l*s*w**2
        y_ddot = -l*s*0.6_dp + l*c*w**2
        newton = m2*(x_ddot*l*c + y_ddot*l*s)
        call check_row(page, "cart-pendulum: the", "dx2/dth = dx2_dot/dth_dot", l*c, l*c, rounding)
        call check_row(page, "cart-pendulum: the", "dx2/dth = l cos(th)", l*c, l*c, rounding)
        call check_row(page, "cart-pendulum: the", "d/dt dx2/dth", -l*s*w, -l*s*w, 1e-11_dp)
        call check_row(page, "cart-pendulum, theta", "m x_dot dx/dth", &
                       m2*l*(x_dot*c + y_dot*s), &
                 m2*l*(l*w + u*c), rounding)
        call check_row(page, "cart-pendulum, theta", "m x_dot d/dt", &
                       m2*l*w*(y_dot*c - x_dot*s), &
                 -m2*l*u*w*s, rounding)
        call check_row(page, "cart-pendulum, theta", "m x_ddot dx/dth", newton, newton, &
                       rounding)
        call check_row(page, "cart-pendulum, x", "m x_ddot dx/dx", m1*2.1_dp + m2*x_ddot, &
                 m1*2.1_dp + m2*x_ddot, rounding)
        call check_row(page, "bead", "m x_ddot", -0.6_dp*(1.7_dp + 1.5_dp**2*0.5_dp), &
                 -0.6_dp*(1.7_dp + 1.5_dp**2*0.5_dp), rounding)
    end subroutine each_term_by_hand

    subroutine what_is_left_out()
        !! Without \(\partial T/\partial\theta\) what is missing is that term, and no other:
        !! \(d/dt\,\partial T/\partial\dot\theta = m_2l(l\ddot\theta + \ddot x\cos\theta
        !! - \dot x\dot\theta\sin\theta)\).
        real(dp), parameter :: s = sin(1.1_dp), c = cos(1.1_dp), u = 0.8_dp, w = -1.3_dp
        type(report_t) :: page
        real(dp) :: newton

        call new_page("dalembert", page)
        newton = m2*l*(-0.6_dp*l + 2.1_dp*c)
        call check_row(page, "cart-pendulum, theta", "is it d/dt", newton, newton - m2*l*u*w*s, &
                       rounding)
        call check_row(page, "cart-pendulum, theta", "it lacks", m2*l*u*w*s, m2*l*u*w*s, rounding)
        call check_row(page, "bead", "is it m r_ddot", -0.6_dp*(1.7_dp + 1.5_dp**2*0.5_dp), &
                       -0.6_dp*1.7_dp, rounding)
    end subroutine what_is_left_out

    subroutine the_picture()
        !! Along the motion the masses' torque is gravity's, \(-m_2gl\sin\theta\), which the gap
        !! does not reach; three curves above, two below, which lie on each other.
        type(report_t) :: page
        integer :: k

        call new_page("dalembert", page)
        if (anyExceptions()) return
        associate (values => page%picture%values)
            call assertEqual(301, size(values, 2), "samples")
            call assertEqual([0.0_dp, -m2*g*l*sin(2.0_dp)], values([1, 2], 1), rounding, "start")
            do k = 1, size(values, 2)
                call assertEqual(values(2, k), values(3, k), rounding, "with dT/dtheta")
                call assertEqual(values(6, k), values(5, k), rounding, "the gap")
                call assertEqual(values(2, k) - values(5, k), values(4, k), rounding, "without")
            end do
            call assertTrue(maxval(abs(values(5, :))) > 3.0_dp, "a gap that is seen")
        end associate
        call assertTrue(index(page%picture%title, "without dT/dtheta the two sides of "// &
                              "Lagrange's equation part") > 0, "title")
    end subroutine the_picture
end module test_dalembert
