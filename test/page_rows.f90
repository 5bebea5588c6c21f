module page_rows
    !! The rows of the pages of `lagrangia principle`, found by how they begin.
    use funit, only: anyExceptions, assertEqual, assertFalse
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_principles, only: principle_report
    use lagrangia_report, only: report_t
    implicit none (type, external)
    private
    public :: check_row, new_page

contains

    subroutine new_page(name, page)
        !! Compute it.
        character(*), intent(in) :: name
        type(report_t), intent(out) :: page
        type(error_t), allocatable :: error

        call principle_report(name, page, error)
        call assertFalse(allocated(error), name)
    end subroutine new_page

    subroutine check_row(page, group, name, left, right, within)
        !! Both numbers of the one row that begins so, in the section that begins so.
        type(report_t), intent(in) :: page
        character(*), intent(in) :: group, name
        real(dp), intent(in) :: left, right  !! computed by another way
        real(dp), intent(in) :: within       !! what rounding may do
        integer :: i, found

        if (anyExceptions()) return
        found = 0
        do i = 1, size(page%rows)
            if (index(page%rows(i)%name, name) /= 1) cycle
            if (index(page%rows(i)%group, group) /= 1) cycle
            found = found + 1
            call assertEqual(left, page%rows(i)%left, within, name//", left")
            call assertEqual(right, page%rows(i)%right, within, name//", right")
        end do
        call assertEqual(1, found, group//": "//name)
    end subroutine check_row
end module page_rows
