module test_errata
    !! The slips in the lecture notes: every one is listed, and its numbers are what it claims.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_errata_command, only: slip_report
    use lagrangia_errata_ledger, only: kind_scan, slip_t, slips_of_the_notes
    use lagrangia_errors, only: error_t
    use lagrangia_report, only: report_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: errata_suite

contains

    function errata_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("errata")
        call suite%addTest(TestMethod("all_are_listed", all_are_listed))
        call suite%addTest(TestMethod("numbers_come_out", numbers_come_out))
    end function errata_suite

    subroutine all_are_listed()
        !! E1 to E23, as the physics has them, complete.
        type(slip_t), allocatable :: slips(:)
        integer :: k

        allocate (slips, source=slips_of_the_notes())
        call assertEqual(23, size(slips))
        do k = 1, size(slips)
            call assertEqual("E"//to_text(k), trim(slips(k)%id))
            call assertTrue(slips(k)%place /= "" .and. slips(k)%subject /= "", slips(k)%id)
            call assertTrue(slips(k)%written /= "" .and. slips(k)%derived /= "", slips(k)%id)
        end do
    end subroutine all_are_listed

    subroutine numbers_come_out()
        !! What is derived holds, what is written fails; letters and dates have no numbers.
        type(slip_t), allocatable :: slips(:)
        type(report_t) :: report
        type(error_t), allocatable :: error
        integer :: k

        allocate (slips, source=slips_of_the_notes())
        do k = 1, size(slips)
            call slip_report(slips(k), report, error)
            call assertFalse(allocated(error), slips(k)%id)
            call assertEqual(0, report%misses(), slips(k)%id)
            call assertTrue((size(report%rows) == 0) .eqv. slips(k)%kind == kind_scan, slips(k)%id)
            if (any(slips(k)%id == ["E6 ", "E14"])) cycle
            call assertTrue(any(report%rows%control) .eqv. slips(k)%kind /= kind_scan, &
                            slips(k)%id//"as written it fails")
        end do
    end subroutine numbers_come_out
end module test_errata
