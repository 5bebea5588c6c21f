module test_ledger_text
    !! Every cell of a line stands under its head: all end so many columns behind it.
    use funit, only: assertEqual, assertTrue, TestMethod, TestSuite
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: claim_t
    use lagrangia_ledger_text, only: measured_line, residual_head, residual_line, statement_head, &
                                     statement_line
    implicit none (type, external)
    private
    public :: ledger_text_suite

contains

    function ledger_text_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("ledger_text")
        call suite%addTest(TestMethod("statements_stand_under_their_head", &
                                      statements_stand_under_their_head))
        call suite%addTest(TestMethod("residuals_stand_under_their_head", &
                                      residuals_stand_under_their_head))
        call suite%addTest(TestMethod("measured_values_stand_in_a_column", &
                                      measured_values_stand_in_a_column))
    end function ledger_text_suite

    subroutine under(head, title, line, cell, behind)
        !! The cell ends so many columns behind the title.
        character(*), intent(in) :: head, title, line, cell
        integer, intent(in) :: behind
        integer :: at

        at = index(head, title) + len(title) - len(cell) + behind
        call assertTrue(at > 1, title)
        call assertTrue(line(at:at + len(cell) - 1) == cell, title//" in '"//line//"'")
    end subroutine under

    subroutine statements_stand_under_their_head()
        !! A whole number, a decimal one, a large one; a name as long as there is room.
        type(claim_t) :: row
        character(:), allocatable :: line

        row%name = "left and right"
        row%left = -3.0_dp
        row%right = 0.5_dp
        row%value = 3.5_dp
        row%most = 1e-9_dp
        row%holds = .false.
        call under(statement_head(), "left", statement_line(row), "-3", 5)
        call under(statement_head(), "right", statement_line(row), "0.500000000", 5)
        call under(statement_head(), "differ", statement_line(row), "3.5E+00", 5)
        call under(statement_head(), "bound", statement_line(row), "1.0E-09", 5)
        line = statement_line(row)
        call assertTrue(line(len(line) - 14:) == "1.0E-09 FAILS !", line)
        row%name = repeat("n", len(row%name))
        row%left = 1.25e8_dp
        row%right = -1234.5_dp
        row%value = 0.0_dp
        call under(statement_head(), "left", statement_line(row), "1.2500000E+08", 5)
        call under(statement_head(), "right", statement_line(row), "-1234.500000000", 5)
        call under(statement_head(), "differ", statement_line(row), " 0", 5)
    end subroutine statements_stand_under_their_head

    subroutine residuals_stand_under_their_head()
        !! Three numbers of two digits, and how many states.
        type(claim_t) :: row
        character(:), allocatable :: line

        row%name = "a claim"
        row%value = 1.5e-16_dp
        row%noise = 2e-15_dp
        row%most = 3e-14_dp
        row%states = 1200
        call under(residual_head("wedge"), "worst", residual_line(row), "1.5E-16", 0)
        call under(residual_head("wedge"), "noise", residual_line(row), "2.0E-15", 0)
        call under(residual_head("wedge"), "bound", residual_line(row), "3.0E-14", 0)
        call under(residual_head("wedge"), "states", residual_line(row), "1200", 0)
        line = residual_head("wedge")
        call assertTrue(line(:7) == "wedge  ", line)
    end subroutine residuals_stand_under_their_head

    subroutine measured_values_stand_in_a_column()
        !! Two cases of different length: their values end in one column, their bounds begin in one.
        type(claim_t) :: short_case, long_case
        character(:), allocatable :: line

        short_case%name = "rk4"
        short_case%measured = "drift"
        short_case%value = 2.0_dp
        short_case%most = 3.0_dp
        short_case%judged = .true.
        long_case = short_case
        long_case%name = "stormer_verlet"
        long_case%value = -1.25e-7_dp
        call assertEqual(index(measured_line(long_case, [14, 5]), "<="), &
                         index(measured_line(short_case, [14, 5]), "<="))
        call assertTrue(index(measured_line(short_case, [14, 5]), "<=") > 30, "beside the value")
        line = measured_line(short_case, [14, 5])
        call assertTrue(line(:25) == "  rk4             drift  ", line)
    end subroutine measured_values_stand_in_a_column
end module test_ledger_text
