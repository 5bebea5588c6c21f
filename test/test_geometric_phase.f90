module test_geometric_phase
    !! The page on geometric phase: its numbers by hand, controls that are zero, the picture.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_report, only: report_t
    use page_rows, only: check_row, new_page
    implicit none (type, external)
    private
    public :: geometric_phase_suite

    real(dp), parameter :: pi = acos(-1.0_dp)
    character(*), parameter :: legs = "disk: roll by d"

contains

    function geometric_phase_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("geometric_phase")
        call suite%addTest(TestMethod("loops_by_hand", loops_by_hand))
        call suite%addTest(TestMethod("planes_of_swing", planes_of_swing))
        call suite%addTest(TestMethod("the_picture", the_picture))
    end function geometric_phase_suite

    subroutine loops_by_hand()
        !! 0.977 and 0.998 of the small loop's formula at 0.1 and 0.01.
        type(report_t) :: page
        real(dp) :: exact, area

        call new_page("geometric-phase", page)
        exact = (sin(0.5_dp) - sin(0.4_dp))/(0.1_dp*cos(0.4_dp))
        call assertEqual(0.977_dp, exact, 5e-4_dp, "0.1")
        call check_row(page, legs, "d = 0.1:", exact, exact, 1e-4_dp)
        exact = (sin(0.41_dp) - sin(0.4_dp))/(0.01_dp*cos(0.4_dp))
        call assertEqual(0.998_dp, exact, 5e-4_dp, "0.01")
        call check_row(page, legs, "d = 0.01:", exact, exact, 1e-7_dp)
        call check_row(page, legs, "is it back", -0.03_dp*(sin(0.5_dp) - sin(0.4_dp)), 0.0_dp, &
                       1e-15_dp)
        ! J1(0.8) from its series
        area = 0.6_dp*pi*0.8_dp*(0.4_dp - 0.4_dp**3/2.0_dp + 0.4_dp**5/12.0_dp &
                                 - 0.4_dp**7/144.0_dp + 0.4_dp**9/2880.0_dp &
                                 - 0.4_dp**11/86400.0_dp + 0.4_dp**13/3628800.0_dp)
        call check_row(page, "disk: theta and phi", "delta x", area*cos(0.4_dp), area*cos(0.4_dp), &
                       1e-12_dp)
        call check_row(page, "disk: theta and phi", "is it R cos", area*cos(0.4_dp), &
                       0.3_dp*pi*0.64_dp*cos(0.4_dp), 1e-12_dp)
    end subroutine loops_by_hand

    subroutine planes_of_swing()
        !! Half a turn at 30 degrees; nothing at the equator; a whole one at the pole.
        type(report_t) :: page

        call new_page("geometric-phase", page)
        call check_row(page, "Foucault", "latitude 90", -2.0_dp*pi, -2.0_dp*pi, 1e-11_dp)
        call check_row(page, "Foucault", "latitude 30", -pi, -pi, 1e-11_dp)
        call check_row(page, "Foucault", "latitude 0", 0.0_dp, 0.0_dp, 1e-11_dp)
        call check_row(page, "Foucault", "30: is it", -pi, -2.0_dp*pi, 1e-11_dp)
    end subroutine planes_of_swing

    subroutine the_picture()
        !! Three loops, three times the displacement; the angles come back.
        type(report_t) :: page

        call new_page("geometric-phase", page)
        if (anyExceptions()) return
        associate (values => page%picture%values, last => size(page%picture%values, 2))
            call assertEqual(values(4:, 1), values(4:, last), 1e-12_dp, "angles are back")
            call assertEqual(3.0_dp*(values(2:3, 201) - values(2:3, 1)), values(2:3, last), &
                             1e-12_dp, "three times")
            call assertTrue(norm2(values(2:3, last)) > 1.0_dp, "a metre")
        end associate
        call assertTrue(index(page%picture%title, "does not come back") > 0, "title")
    end subroutine the_picture
end module test_geometric_phase
