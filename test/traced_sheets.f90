module traced_sheets
    !! Sheets of several statements, with the verdict that each deserves.
    use funit, only: assertEqual, assertFalse
    use lagrangia_errors, only: error_t
    use lagrangia_grading, only: grade, grade_t
    use lagrangia_homework, only: homework_t, parse_homework
    use lagrangia_judgement, only: is_consequence, is_right, is_unreadable, is_wrong
    use lagrangia_scene_reader, only: read_named_system
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: traced

    character, parameter :: line_feed = new_line("a")

contains

    subroutine traced(system, expected, statements, remarks)
        !! `r`, `w`, `f`, `u`, or `0` for any: a letter for each statement.
        character(*), intent(in) :: system, expected, statements
        character(*), intent(in), optional :: remarks  !! `3 the sign; 5 ...`: what these begin with
        class(system_t), allocatable :: about
        type(homework_t) :: homework
        type(grade_t) :: result
        type(error_t), allocatable :: error
        type(word_t), allocatable :: settings(:)
        character(:), allocatable :: text
        integer :: i, first, last

        text = statements
        do i = 1, len(text)
            if (text(i:i) == ";") text(i:i) = line_feed
        end do
        call parse_homework("system: "//system//line_feed//text, "sheet", homework, error)
        call assertFalse(allocated(error), statements)
        if (allocated(error)) return
        allocate (settings(size(homework%settings)))
        do i = 1, size(settings)
            settings(i)%text = system//"%"//homework%settings(i)%text
        end do
        call read_named_system(system, settings, about, error)
        call assertFalse(allocated(error), system)
        call grade(homework, about, result, error)
        call assertFalse(allocated(error), "no error")
        call assertEqual(len(expected), size(result%of), statements)
        do i = 1, min(len(expected), size(result%of))
            text = homework%statements(i)%text//": "//result%of(i)%remark
            select case (expected(i:i))
            case ("r"); call assertEqual(is_right, result%of(i)%verdict, text)
            case ("w"); call assertEqual(is_wrong, result%of(i)%verdict, text)
            case ("f"); call assertEqual(is_consequence, result%of(i)%verdict, text)
            case ("u"); call assertEqual(is_unreadable, result%of(i)%verdict, text)
            case default; cycle
            end select
        end do
        if (.not. present(remarks)) return
        first = 1
        do while (first <= len(remarks))
            last = index(remarks(first:)//";", ";") + first - 2
            text = trim(adjustl(remarks(first:last)))//" "
            read (text(:index(text, " ")), *) i
            text = trim(text(index(text, " ") + 1:))
            call assertEqual(1, index(result%of(i)%remark, text), text//": "//result%of(i)%remark)
            first = last + 2
        end do
    end subroutine traced
end module traced_sheets
