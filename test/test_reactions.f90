module test_reactions
    !! The page on forces of constraint: each by hand, its controls, its picture.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_report, only: report_t
    use page_rows, only: check_row, new_page
    implicit none (type, external)
    private
    public :: reactions_suite

    real(dp), parameter :: m = 0.5_dp, l = 0.8_dp, g = 9.81_dp
    real(dp), parameter :: rounding = 1e-12_dp  !! of numbers up to 30

contains

    function reactions_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("reactions")
        call suite%addTest(TestMethod("forces_by_hand", forces_by_hand))
        call suite%addTest(TestMethod("what_is_not_so", what_is_not_so))
        call suite%addTest(TestMethod("the_picture", the_picture))
    end function reactions_suite

    subroutine forces_by_hand()
        !! Energy gives \(l\dot\theta^2 = 2g(\cos\theta-\cos\theta_0)\), and
        !! \(T = ml\dot\theta^2 + mg\cos\theta\).
        type(report_t) :: page
        real(dp) :: n

        call new_page("reactions", page)
        call check_row(page, "pendulum", "T at the start", m*g*cos(2.0_dp), m*g*cos(2.0_dp), &
                       rounding)
        call check_row(page, "pendulum", "largest T", m*g*(3.0_dp - 2.0_dp*cos(2.0_dp)), &
                       m*g*(3.0_dp - 2.0_dp*cos(2.0_dp)), 1e-2_dp)
        n = 0.7_dp*2.0_dp*g*cos(0.6_dp)/(2.0_dp + 0.7_dp*sin(0.6_dp)**2)
        call check_row(page, "block", "N = m M", n, n, rounding)
        call check_row(page, "block", "plane", 2.0_dp*g + n*cos(0.6_dp), &
                       2.0_dp*g + n*cos(0.6_dp), rounding)
        call check_row(page, "rolling disk", "along", 1.3_dp*0.3_dp*4.0_dp*1.1_dp, &
                       1.3_dp*0.3_dp*4.0_dp*1.1_dp, rounding)
        call check_row(page, "rolling disk", "across", 1.3_dp*g, 1.3_dp*g, rounding)
    end subroutine forces_by_hand

    subroutine what_is_not_so()
        !! At rest the rod of the cart-pendulum pulls with \(m_1m_2g\cos\theta/D\) as well. Of two
        !! statements of one constraint the second, \(f_2 = 2f_1\), has half the multiplier.
        real(dp), parameter :: s = sin(2.0_dp), c = cos(2.0_dp)
        type(report_t) :: page
        real(dp) :: rod, track

        call new_page("reactions", page)
        rod = m*g*c/(1.0_dp + m*s**2)
        track = g + rod*c
        call check_row(page, "cart-pendulum", "is N the weight", track, 1.5_dp*g, rounding)
        rod = m*(l*1.3_dp**2 + g*cos(1.1_dp))
        call check_row(page, "the rod's constraint", "is the multiplier", rod, 0.5_dp*rod, rounding)
        call check_row(page, "the rod's constraint", "force on the bob", -rod*sin(1.1_dp), &
                       -rod*sin(1.1_dp), rounding)
        call check_row(page, "block", "is N = m g", 0.7_dp*2.0_dp*g*cos(0.6_dp) &
                       /(2.0_dp + 0.7_dp*sin(0.6_dp)**2), 0.7_dp*g*cos(0.6_dp), rounding)
    end subroutine what_is_not_so

    subroutine the_picture()
        !! Two curves that lie on each other; negative at the start, where the rod pushes.
        type(report_t) :: page

        call new_page("reactions", page)
        if (anyExceptions()) return
        associate (values => page%picture%values)
            call assertEqual(301, size(values, 2), "samples")
            call assertEqual(values(2, :), values(3, :), 1e-10_dp, "3n equations, by hand")
            call assertTrue(values(2, 1) < 0.0_dp .and. maxval(values(2, :)) > 15.0_dp, "T")
            call assertTrue(page%picture%nested, "the first curve is seen below the second")
        end associate
        call assertTrue(index(page%picture%title, "the rod pulls hardest below") > 0, &
                        "title")
    end subroutine the_picture
end module test_reactions
