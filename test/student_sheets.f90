module student_sheets
    !! Sheets as students wrote them, in `test/student_sheets.txt`: behind `==` stands the system,
    !! then the verdict that each line deserves, `r`, `w`, `f`, `d` or `u`, and the line; `i` is a
    !! remark or a setting.
    use funit, only: assertFalse
    use lagrangia_errors, only: error_t
    use lagrangia_files, only: read_whole_file
    use lagrangia_grading, only: grade_t
    use lagrangia_homework, only: homework_t, parse_homework
    use lagrangia_judgement, only: is_consequence, is_definition, is_right, is_unreadable, is_wrong
    use lagrangia_set_lines, only: grade_with_settings
    use lagrangia_system, only: system_t
    use tried_responses, only: group_t, response_t
    implicit none (type, external)
    private
    public :: grade_student_sheets

    character, parameter :: line_feed = new_line("a")
    character(*), parameter :: file = "test/student_sheets.txt"

contains

    subroutine grade_student_sheets(group)
        !! All statements of all sheets.
        type(group_t), intent(out) :: group
        type(error_t), allocatable :: error
        character(:), allocatable :: line, marks, sheet, system, text
        integer :: first, last

        allocate (group%of(0))
        call read_whole_file(file, text, error)
        call assertFalse(allocated(error), file)
        if (allocated(error)) return
        sheet = ""
        marks = ""
        system = ""
        first = 1
        do while (first <= len(text))
            last = first + index(text(first:)//line_feed, line_feed) - 2
            line = text(first:last)
            first = last + 2
            if (index(line, "== ") == 1) then
                if (system /= "") call grade_sheet(system, marks, sheet, group)
                system = trim(line(4:))
                sheet = "system: "//system//line_feed
                marks = "i"
            else if (len(line) > 2) then
                sheet = sheet//line(3:)//line_feed
                marks = marks//line(1:1)
            end if
        end do
        call grade_sheet(system, marks, sheet, group)
    end subroutine grade_student_sheets

    subroutine grade_sheet(name, marks, text, group)
        !! One of them.
        character(*), intent(in) :: name, marks, text
        type(group_t), intent(inout) :: group
        class(system_t), allocatable :: system
        type(homework_t) :: homework
        type(grade_t) :: result
        type(error_t), allocatable :: error
        type(response_t), allocatable :: longer(:)
        integer :: i, n

        call parse_homework(text, "sheet", homework, error)
        call assertFalse(allocated(error), text)
        if (allocated(error)) return
        call grade_with_settings(homework, system, result, error)
        call assertFalse(allocated(error), text)
        if (allocated(error)) return
        n = size(group%of)
        allocate (longer(n + size(result%of)))
        do i = 1, n
            call move_alloc(group%of(i)%system, longer(i)%system)
            call move_alloc(group%of(i)%statement, longer(i)%statement)
            call move_alloc(group%of(i)%remark, longer(i)%remark)
            longer(i)%expected = group%of(i)%expected
            longer(i)%verdict = group%of(i)%verdict
        end do
        do i = 1, size(result%of)
            longer(n + i)%system = name
            longer(n + i)%statement = homework%statements(i)%text
            longer(n + i)%remark = result%of(i)%remark
            longer(n + i)%verdict = result%of(i)%verdict
            longer(n + i)%expected = verdict_of(marks(homework%statements(i)%line: &
                                                      homework%statements(i)%line))
        end do
        call move_alloc(longer, group%of)
    end subroutine grade_sheet

    pure integer function verdict_of(mark)
        !! What a letter means.
        character, intent(in) :: mark

        select case (mark)
        case ("r"); verdict_of = is_right
        case ("w"); verdict_of = is_wrong
        case ("f"); verdict_of = is_consequence
        case ("d"); verdict_of = is_definition
        case ("u"); verdict_of = is_unreadable
        case default; verdict_of = 0
        end select
    end function verdict_of
end module student_sheets
