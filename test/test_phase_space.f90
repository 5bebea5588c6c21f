module test_phase_space
    !! The page on phase space: areas, periods, exponents; its controls, its picture.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_report, only: report_t
    use page_rows, only: check_row, new_page
    implicit none (type, external)
    private
    public :: phase_space_suite

    real(dp), parameter :: pi = acos(-1.0_dp), m = 0.5_dp, l = 0.8_dp, g = 9.81_dp
    real(dp), parameter :: w0 = sqrt(g/l)

contains

    function phase_space_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("phase_space")
        call suite%addTest(TestMethod("numbers_by_hand", numbers_by_hand))
        call suite%addTest(TestMethod("what_bounds_an_exponent", what_bounds_an_exponent))
        call suite%addTest(TestMethod("the_picture", the_picture))
    end function phase_space_suite

    subroutine numbers_by_hand()
        !! gamma = b/(m l^2) = 0.3125/s; the period from 1.5 rad by its series,
        !! \(1 + \theta_0^2/16 + 11\theta_0^4/3072 + \ldots\), whose next term is 4e-4 there.
        real(dp), parameter :: area = pi*0.09_dp*m*l**2*w0
        type(report_t) :: page
        real(dp) :: t, force

        call new_page("phase-space", page)
        call check_row(page, "pendulum: the area of", "after 2 s", area, area, 1e-8_dp)
        call check_row(page, "pendulum: the area of", "with friction = that", &
                       area*exp(-0.625_dp), area*exp(-0.625_dp), 1e-8_dp)
        call check_row(page, "pendulum: the area of", "with friction: is", area*exp(-0.625_dp), &
                       area, 1e-8_dp)
        t = 2.0_dp*pi/w0*(1.0_dp + 0.25_dp/16.0_dp + 11.0_dp*0.0625_dp/3072.0_dp &
                          + 173.0_dp*0.015625_dp/737280.0_dp)
        call check_row(page, "pendulum: the area J", "from 0.5 rad", t, t, 1e-6_dp)
        force = -0.63_dp*sin(1.1_dp)*(g - 1.04_dp)  ! dL/dtheta has x_dot theta_dot = -1.04
        call check_row(page, "cart-pendulum", "-dH/dtheta at fixed p", force, force, 1e-9_dp)
        call check_row(page, "cart-pendulum", "is -dH/dtheta", force, -0.63_dp*g*sin(1.1_dp), &
                       1e-9_dp)
    end subroutine numbers_by_hand

    subroutine what_bounds_an_exponent()
        !! Neighbours that part as t leave ln(400/100)/(300 s); five times that bounds the regular
        !! motions, which stay below a half of it, and the control is that of the chaotic one.
        type(report_t) :: page
        real(dp), parameter :: bound = 5.0_dp*log(4.0_dp)/300.0_dp
        integer :: i, found

        call new_page("phase-space", page)
        found = 0
        do i = 1, size(page%rows)
            associate (row => page%rows(i))
                if (index(row%group, "how fast") /= 1 .or. index(row%name, "10 sigma") > 0) cycle
                found = found + 1
                call assertEqual(bound, row%most, 1e-15_dp, row%name)
                if (row%control) then
                    call assertTrue(row%left > 10.0_dp*bound, "chaos: "//row%name)
                else
                    call assertTrue(abs(row%left) < 0.5_dp*bound, row%name)
                end if
            end associate
        end do
        call assertEqual(3, found, "exponents")
    end subroutine what_bounds_an_exponent

    subroutine the_picture()
        !! One line; the energy of the point whose way is drawn stays; the rim returns to itself.
        type(report_t) :: page
        real(dp) :: energy

        call new_page("phase-space", page)
        if (anyExceptions()) return
        associate (values => page%picture%values)
            call assertEqual(784, size(values, 2), "samples")
            call assertEqual(values(:, 1), values(:, 121), 1e-12_dp, "a rim is closed")
            energy = 0.5_dp*values(2, 1)**2 - cos(values(1, 1))
            call assertEqual(energy, 0.5_dp*values(2, 170)**2 - cos(values(1, 170)), 1e-8_dp, "way")
            call assertEqual(energy, 0.5_dp*values(2, 784)**2 - cos(values(1, 784)), 1e-8_dp, "end")
        end associate
        call assertTrue(index(page%picture%title, "keeps its area") > 0, "title")
    end subroutine the_picture
end module test_phase_space
