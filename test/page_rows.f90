module page_rows
    !! The rows of the pages of `lagrangia principle`, found by how they begin.
    use funit, only: anyExceptions, assertEqual, assertFalse
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_principles, only: principle_names, principle_report
    use lagrangia_report, only: report_t
    implicit none (type, external)
    private
    public :: check_row, new_page, page_once

    type :: known_page_t
        !! A page that a test has asked for before.
        type(report_t), allocatable :: page
    end type known_page_t

contains

    subroutine page_once(name, page, error)
        !! `principle_report`, which computes each page the first time only: many tests read the
        !! same ones, and they are constants.
        character(*), intent(in) :: name
        type(report_t), intent(out) :: page
        type(error_t), allocatable, intent(out) :: error  !! as there
        type(known_page_t), allocatable, save :: known(:)
        integer :: i

        if (.not. allocated(known)) allocate (known(size(principle_names())))
        i = findloc(principle_names() == name, .true., 1)
        if (i == 0) then
            call principle_report(name, page, error)
            return
        end if
        if (.not. allocated(known(i)%page)) then
            allocate (known(i)%page)
            call principle_report(name, known(i)%page, error)
            if (allocated(error)) deallocate (known(i)%page)
            if (allocated(error)) return
        end if
        page = known(i)%page
    end subroutine page_once

    subroutine new_page(name, page)
        !! Compute it.
        character(*), intent(in) :: name
        type(report_t), intent(out) :: page
        type(error_t), allocatable :: error

        call page_once(name, page, error)
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
