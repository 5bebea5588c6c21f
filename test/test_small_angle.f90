module test_small_angle
    !! The page on the dropped term: its closed forms by hand, its controls, its picture.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_report, only: report_t
    use page_rows, only: check_row, new_page
    implicit none (type, external)
    private
    public :: small_angle_suite

    real(dp), parameter :: pi = acos(-1.0_dp), m1 = 1.0_dp, m2 = 0.5_dp, l = 0.8_dp, g = 9.81_dp
    real(dp), parameter :: smallest = 0.8_dp/128.0_dp  !! rad, the last rung

contains

    function small_angle_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("small_angle")
        call suite%addTest(TestMethod("powers_and_their_factors", powers_and_their_factors))
        call suite%addTest(TestMethod("the_swing_takes_longer", the_swing_takes_longer))
        call suite%addTest(TestMethod("the_wrong_sign_grows", the_wrong_sign_grows))
        call suite%addTest(TestMethod("the_picture", the_picture))
    end function small_angle_suite

    subroutine powers_and_their_factors()
        !! The largest theta_ddot is that of the start, \(\sin A\,(m_1+m_2)g/(l(m_1+m_2\sin^2 A))\);
        !! the largest theta_dot^2 is that of the bottom, from the energy:
        !! \(2g(1-\cos A)(m_1+m_2)/(m_1l)\).
        type(report_t) :: page
        real(dp) :: first(2), second(2), a(2), w2

        call new_page("small-angle", page)
        w2 = (m1 + m2)*g/(m1*l)
        a = [2.0_dp*smallest, smallest]
        first = sin(a)*(m1 + m2)*g/(l*(m1 + m2*sin(a)**2))
        second = 4.0_dp*sin(0.5_dp*a)**2*w2
        call check_row(page, "cart-pendulum from rest", "theta_ddot: power", &
                       log(first(1)/first(2))/log(2.0_dp), 1.0_dp, 1e-12_dp)
        call check_row(page, "cart-pendulum from rest", "largest theta_ddot/", &
                       first(2)/(a(2)*w2), 1.0_dp, 1e-12_dp)
        ! the bottom is not a sample of the first swing but to rounding: see swing_from
        call check_row(page, "cart-pendulum from rest", "theta_dot^2: power", &
                       log(second(1)/second(2))/log(2.0_dp), 2.0_dp, 1e-11_dp)
        call check_row(page, "cart-pendulum from rest", "largest theta_dot^2/", &
                       second(2)/(a(2)**2*w2), 1.0_dp, 1e-12_dp)
        call check_row(page, "cart-pendulum from rest", "largest theta_dot^2 theta/(A", &
                       2.0_dp/(3.0_dp*sqrt(3.0_dp)), 2.0_dp/(3.0_dp*sqrt(3.0_dp)), a(2)**2)
        call check_row(page, "cart-pendulum from rest", "is theta_dot^2 theta of first", &
                       3.0_dp, 1.0_dp, a(1)**2)
    end subroutine powers_and_their_factors

    subroutine the_swing_takes_longer()
        !! \(T/T_0 - 1 = c_2A^2 + c_4A^4\), \(c_4 = (11-158\mu+3\mu^2)/(3072(1-\mu)^2)\): its
        !! first omitted term is below \(A^6\); the period of 1.6 s is known to 1e-15 of it, which
        !! over \(A^2\) is 3e-11.
        real(dp), parameter :: mu = m2/(m1 + m2), c2 = (m1 + 4.0_dp*m2)/(16.0_dp*m1), &
                               c4 = (11.0_dp - 158.0_dp*mu + 3.0_dp*mu**2) &
                               /(3072.0_dp*(1.0_dp - mu)**2)
        type(report_t) :: page
        real(dp) :: t

        call new_page("small-angle", page)
        call check_row(page, "what is lost", "(T/T0 - 1)/A^2", c2 + c4*smallest**2, c2, 1e-9_dp)
        call check_row(page, "what is lost", "is it 1/16", c2 + c4*smallest**2, 0.0625_dp, 1e-9_dp)
        t = 2.0_dp*pi*sqrt(m1*l/((m1 + m2)*g))*(1.0_dp + c2*smallest**2 + c4*smallest**4)
        call check_row(page, "what is lost", "T from the motion", t, t, 1e-12_dp)
    end subroutine the_swing_takes_longer

    subroutine the_wrong_sign_grows()
        !! By cosh, from A = 0.001 rad, within a second: 30 times.
        type(report_t) :: page
        real(dp) :: w

        call new_page("small-angle", page)
        w = sqrt((m1 + m2)*g/(m1*l))
        call check_row(page, "the notes' sign", "with - g: is A", 1e-3_dp, 1e-3_dp*cosh(w), &
                       1e-5_dp)
        call check_row(page, "the notes' sign", "with + g: A", 1e-3_dp, 1e-3_dp, 1e-15_dp)
    end subroutine the_wrong_sign_grows

    subroutine the_picture()
        !! Straight lines of slope 1, 2 and 3 on doubly logarithmic paper, and the period's of 2.
        type(report_t) :: page
        integer :: k
        real(dp) :: slopes(4)

        call new_page("small-angle", page)
        if (anyExceptions()) return
        associate (values => page%picture%values)
            call assertEqual(8, size(values, 2), "rungs")
            do k = 2, size(values, 2)
                slopes = (values(2:5, k) - values(2:5, k - 1))/(values(1, k) - values(1, k - 1))
                call assertEqual([1.0_dp, 2.0_dp, 3.0_dp, 2.0_dp], slopes, &
                                 2.0_dp*100.0_dp**values(1, k - 1), "slopes")
            end do
        end associate
        call assertTrue(index(page%picture%title, "falls with the third power") > 0, "title")
    end subroutine the_picture
end module test_small_angle
