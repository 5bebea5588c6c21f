module test_which_forces
    !! Which forces have an L: the page's numbers by hand, its controls, its picture.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_report, only: report_t
    use lagrangia_which_forces, only: forced_t
    use page_rows, only: check_row, new_page
    implicit none (type, external)
    private
    public :: which_forces_suite

    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    function which_forces_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("which_forces")
        call suite%addTest(TestMethod("by_hand", by_hand))
        call suite%addTest(TestMethod("forces_are_those_named", forces_are_those_named))
        call suite%addTest(TestMethod("the_picture", the_picture))
    end function which_forces_suite

    subroutine by_hand()
        !! Three of the five have a potential; a curl of 2 c does 2 c pi of work around a circle.
        type(report_t) :: page

        call new_page("helmholtz", page)
        call check_row(page, "is there a U", "-grad", 1.0_dp, 1.0_dp, 0.0_dp)
        call check_row(page, "is there a U", "e v x B", 1.0_dp, 1.0_dp, 0.0_dp)
        call check_row(page, "is there a U", "-m gamma v", 0.0_dp, 1.0_dp, 0.0_dp)
        call check_row(page, "is there a U", "(-c y, c x)", 0.0_dp, 1.0_dp, 0.0_dp)
        call check_row(page, "is there a U", "c x^2 cos t", 1.0_dp, 1.0_dp, 0.0_dp)
        call check_row(page, "work", "a force with a curl", 1.6_dp*pi, 1.6_dp*pi, 1e-12_dp)
        call check_row(page, "work", "friction", -0.6_dp*pi, -0.6_dp*pi, 1e-12_dp)
        call check_row(page, "damped", "f = exp", 0.3_dp*exp(0.78_dp), 0.3_dp*exp(0.78_dp), &
                       1e-14_dp)
        call check_row(page, "damped", "f = 1", 0.3_dp, 0.0_dp, 1e-15_dp)
    end subroutine by_hand

    subroutine forces_are_those_named()
        !! Of 0.5 kg at \((0.7, -1.1)\) m with \((0.4, 0.9)\) m/s after 0.3 s: e B = 1.5 N s/m,
        !! gamma = 0.6/s, c = 0.8 N/m.
        real(dp), parameter :: x = 0.7_dp, y = -1.1_dp
        real(dp), parameter :: expected(2, 5) = reshape([ &
            -2.0_dp*x*y, sin(y) - x**2, 1.5_dp*0.9_dp, -1.5_dp*0.4_dp, -0.3_dp*0.4_dp, &
            -0.3_dp*0.9_dp, -0.8_dp*y, 0.8_dp*x, 0.8_dp*x**2*cos(0.3_dp), 0.0_dp], [2, 5])
        type(forced_t) :: mass
        type(hyperdual_t) :: f(2)
        real(dp) :: found(2)
        integer :: i

        mass%ndof = 2
        do i = 1, 5
            mass%force = i
            call mass%generalised_forces(hyperdual(0.3_dp), hyperdual([x, y]), &
                                         hyperdual([0.4_dp, 0.9_dp]), f)
            found = f%re
            call assertEqual(expected(:, i), found, 4.0_dp*epsilon(x), "force")
        end do
    end subroutine forces_are_those_named

    subroutine the_picture()
        !! The gradient's work is that of its potential, \(-x^2y - \cos y\), on the way as well.
        type(report_t) :: page
        integer :: i
        real(dp) :: x, y, s

        call new_page("helmholtz", page)
        if (anyExceptions()) return
        associate (values => page%picture%values)
            call assertEqual(101, size(values, 2), "samples")
            do i = 1, 101
                s = 2.0_dp*pi*values(1, i)
                x = 1.0_dp + cos(s)
                y = 1.0_dp + sin(s)
                ! by trapezoids of 1/200 of the way
                call assertEqual(4.0_dp + cos(1.0_dp) - x**2*y - cos(y), values(2, i), 2e-3_dp, &
                                 "gradient")
                call assertEqual(-0.3_dp*s, values(5, i), 1e-12_dp, "friction")
            end do
            call assertEqual(0.0_dp, maxval(abs(values(3, :))), 1e-14_dp, "magnetic")
        end associate
        call assertTrue(index(page%picture%title, "none of a gradient") > 0, "title")
    end subroutine the_picture
end module test_which_forces
