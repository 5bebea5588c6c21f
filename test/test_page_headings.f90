module test_page_headings
    !! What the headings and names on the page of constraints say is what was computed below them.
    use formula, only: formula_value, names_t
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_errata_ledger, only: slip_t, slips_of_the_notes
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lecture_constraints, only: examples
    use lagrangia_report, only: report_t
    use page_rows, only: page_once
    implicit none (type, external)
    private
    public :: page_headings_suite

contains

    function page_headings_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("page_headings")
        call suite%addTest(TestMethod("constraints_have_their_names", constraints_have_their_names))
        call suite%addTest(TestMethod("mixed_partials_are_differences", &
                                      mixed_partials_are_differences))
        call suite%addTest(TestMethod("freedom_is_counted_as_printed", &
                                      freedom_is_counted_as_printed))
        call suite%addTest(TestMethod("the_slip_is_the_notes_own", the_slip_is_the_notes_own))
    end function page_headings_suite

    subroutine get_page(report)
        !! That of the constraints.
        type(report_t), intent(out) :: report
        type(error_t), allocatable :: error

        call page_once("constraints", report, error)
        call assertFalse(allocated(error), "constraints")
    end subroutine get_page

    subroutine constraints_have_their_names()
        !! Each differential equation that a row is about is one of the examples.
        type(report_t) :: report
        integer :: cut, found, i

        call get_page(report)
        if (anyExceptions()) return
        found = 0
        do i = 1, size(report%rows)
            associate (row => report%rows(i))
                if (index(row%group, "mixed partials") /= 1 .and. &
                    index(row%group, "Frobenius") /= 1 .and. &
                    index(row%group, "classes as computed") /= 1) cycle
                cut = index(row%name, " = 0")
                if (cut == 0) cycle
                found = found + 1
                call assertTrue(any(examples%name == row%name(:cut + 3)), row%name)
            end associate
        end do
        call assertEqual(6, found, "rows")
    end subroutine constraints_have_their_names

    subroutine mixed_partials_are_differences()
        !! Of \(y\,dx - x\,dy\) they are \(\partial A_x/\partial y = 1\) and
        !! \(\partial A_y/\partial x = -1\): the heading's formula of these is the row's number.
        type(report_t) :: report
        type(names_t) :: letters
        character(:), allocatable :: heading
        real(dp) :: value, size_of
        integer :: at
        logical :: ok

        call get_page(report)
        if (anyExceptions()) return
        at = findloc(report%rows%name == "y dx - x dy = 0: 2", .true., 1)
        call assertTrue(at > 0, "the row is there")
        if (at == 0) return
        heading = report%rows(at)%group
        heading = heading(index(heading, "|") + 1:index(heading, "|", back=.true.) - 1)
        call letters%set("dA_i/dq_j", 1.0_dp)
        call letters%set("dA_j/dq_i", -1.0_dp)
        call formula_value(heading, letters, value, size_of, ok)
        call assertTrue(ok, heading)
        call assertEqual(abs(value), report%rows(at)%left, 1e-15_dp, heading)
    end subroutine mixed_partials_are_differences

    subroutine freedom_is_counted_as_printed()
        !! `3n - k` for the two bobs on two rods, in the plane: four constraints.
        type(report_t) :: report
        type(names_t) :: letters
        character(:), allocatable :: heading
        real(dp) :: value, size_of
        integer :: at
        logical :: ok

        call get_page(report)
        if (anyExceptions()) return
        at = findloc(report%rows%name == "double pendulum: 6 - 4", .true., 1)
        call assertTrue(at > 0, "the row is there")
        if (at == 0) return
        heading = report%rows(at)%group
        heading = heading(index(heading, ", ") + 2:)
        call letters%set("n", 2.0_dp)
        call letters%set("k", 4.0_dp)
        call formula_value(heading(:index(heading, ",") - 1), letters, value, size_of, ok)
        call assertTrue(ok, heading)
        call assertEqual(value, report%rows(at)%left, 0.0_dp, heading)
    end subroutine freedom_is_counted_as_printed

    subroutine the_slip_is_the_notes_own()
        !! E7 for `i = 2`.
        type(slip_t), allocatable :: slips(:)
        type(report_t) :: report
        character(:), allocatable :: text
        integer :: at, i

        allocate (slips, source=slips_of_the_notes())
        at = findloc(slips%id == "E7 ", .true., 1)
        text = ""
        do i = 1, index(slips(at)%reads, " = c_i") - 1
            if (slips(at)%reads(i:i) == "_") cycle
            text = text//merge("2", slips(at)%reads(i:i), slips(at)%reads(i:i) == "i")
        end do
        call get_page(report)
        if (anyExceptions()) return
        call assertTrue(any(report%rows%name == "the notes' f2 = "//text//"  [m^2]"), text)
    end subroutine the_slip_is_the_notes_own
end module test_page_headings
