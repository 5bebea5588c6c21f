module lagrangia_grade
    !! `lagrangia grade FILE...`: a student's statements, each right, or which term is wrong.
    use lagrangia_command_line, only: command_line_t
    use lagrangia_console, only: put_line
    use lagrangia_counted, only: counted
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail, status_not_held, status_usage
    use lagrangia_grading, only: grade_t
    use lagrangia_homework, only: homework_t, read_homework
    use lagrangia_json, only: json_array, json_element, json_item, json_object, json_pair
    use lagrangia_judgement, only: is_consequence, is_definition, is_right, is_unreadable, &
                                   is_wrong
    use lagrangia_printed_table, only: left
    use lagrangia_set_lines, only: grade_with_settings
    use lagrangia_system, only: system_t
    use lagrangia_text, only: short_source, shortened, to_text
    implicit none (type, external)
    private
    public :: grade_command

    character(12), parameter :: verdicts(5) = [character(12) :: "right", "definition", "wrong", &
                                               "unreadable", "follows"]

contains

    subroutine grade_command(line, error)
        !! Grade each file; the status is 1 if a statement is wrong, 2 if one cannot be read.
        type(command_line_t), intent(in) :: line          !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        class(system_t), allocatable :: system
        type(homework_t) :: homework
        type(grade_t) :: result
        character(:), allocatable :: json
        integer :: i, wrong, unreadable

        if (size(line%arguments) == 0) then
            call fail(error, "grade what? Give a file with a line 'system: NAME' and "// &
                "statements, one a line")
            return
        end if
        wrong = 0
        unreadable = 0
        json = ""
        do i = 1, size(line%arguments)
            call read_homework(line%arguments(i)%text, homework, error)
            if (.not. allocated(error)) call grade_with_settings(homework, system, result, error)
            if (allocated(error)) exit
            wrong = wrong + count(result%of%verdict == is_wrong)
            unreadable = unreadable + count(result%of%verdict == is_unreadable)
            if (line%has("json")) then
                json = json//json_element(sheet_json(homework, system, result))
            else if (.not. line%has("quiet")) then
                if (i > 1) call put_line("")
                call print_sheet(homework, system, result)
            end if
        end do
        if (line%has("json")) call put_line(json_array(json))
        if (allocated(error)) return
        if (unreadable > 0) then
            call fail(error, "not readable: "//counted(unreadable, "statement"), &
                      status_usage)
        else if (wrong > 0) then
            call fail(error, "wrong: "//counted(wrong, "statement"), status_not_held)
        end if
    end subroutine grade_command

    subroutine print_sheet(homework, system, result)
        !! For the eye.
        type(homework_t), intent(in) :: homework
        class(system_t), intent(in) :: system
        type(grade_t), intent(in) :: result
        character(:), allocatable :: counts
        integer :: i

        call put_line(trim(short_source(homework%source))//": "// &
                      counted(size(result%of), "statement")// &
                      " about "//homework%system)
        do i = 1, size(result%of)
            associate (statement => homework%statements(i), judgement => result%of(i))
                call put_line(left("line "//to_text(statement%line), 10)// &
                              left(verdicts(judgement%verdict), 12)//shortened(statement%text, 120))
                if (judgement%remark /= "") call put_line("          "//judgement%remark)
                if (judgement%example /= "") call put_line("          "//judgement%example)
            end associate
        end do
        counts = count_text(result)
        if (counts /= "") call put_line(counts)
        call put_first_mistake(homework, result)
        if (result%meaning /= "") call put_line(result%meaning)
        if (result%kept /= "") call put_line("not named, and therefore: "//result%kept)
        if (result%equations > 0) call put_line(determined_text(system, result))
    end subroutine print_sheet

    subroutine put_first_mistake(homework, result)
        !! Where a derivation leaves the truth, if others go on from there.
        type(homework_t), intent(in) :: homework
        type(grade_t), intent(in) :: result
        integer :: first

        if (.not. any(result%of%verdict == is_consequence)) return
        first = findloc(result%of%verdict, is_wrong, 1)
        if (first == 0) return
        call put_line("the first step that does not follow: line "// &
                      to_text(homework%statements(first)%line))
    end subroutine put_first_mistake

    function count_text(result) result(text)
        !! `3 right, 1 wrong`.
        type(grade_t), intent(in) :: result
        character(:), allocatable :: text
        integer :: number, k

        text = ""
        do k = 1, size(verdicts)
            number = count(result%of%verdict == k)
            if (number == 0 .or. k == is_definition) cycle
            if (text /= "") text = text//", "
            if (k == is_consequence) then
                text = text//to_text(number)//trim(" follow"//merge("s", " ", number == 1))// &
                       " from what is wrong"
            else
                text = text//to_text(number)//" "//trim(verdicts(k))
            end if
        end do
    end function count_text

    function determined_text(system, result) result(text)
        !! Which accelerations the right equations give.
        class(system_t), intent(in) :: system
        type(grade_t), intent(in) :: result
        character(:), allocatable :: text
        type(description_t) :: d
        integer :: i

        if (all(result%determined)) then
            text = "the right equations determine the motion"
            return
        end if
        call system%describe(d)
        text = "the right equations do not determine"
        do i = 1, size(result%determined)
            if (.not. result%determined(i)) text = text//" "//trim(d%coordinates(i)%name)//"_ddot,"
        end do
        text = text(:len(text) - 1)
    end function determined_text

    function sheet_json(homework, system, result) result(json)
        !! One object.
        type(homework_t), intent(in) :: homework
        class(system_t), intent(in) :: system
        type(grade_t), intent(in) :: result
        character(:), allocatable :: json
        type(description_t) :: d
        integer :: i

        call system%describe(d)
        json = ""
        do i = 1, size(result%of)
            associate (statement => homework%statements(i), judgement => result%of(i))
                json = json//json_element(json_object(json_pair("line", statement%line)// &
                    json_pair("statement", statement%text)// &
                    json_pair("verdict", trim(verdicts(judgement%verdict)))// &
                    json_item("follows_from", lines_json(homework, judgement%because))// &
                    json_pair("remark", judgement%remark)//json_pair("example", judgement%example)))
            end associate
        end do
        json = json_object(json_pair("file", homework%source)//json_pair("system", &
            homework%system)// &
            json_pair("right", count(result%of%verdict == is_right))// &
            json_pair("wrong", count(result%of%verdict == is_wrong))// &
            json_pair("unreadable", count(result%of%verdict == is_unreadable))// &
            json_pair("follows", count(result%of%verdict == is_consequence))// &
            json_pair("equations", result%equations)// &
            json_pair("determined", all(result%determined))// &
            json_item("statements", json_array(json)))
    end function sheet_json

    pure function lines_json(homework, because) result(json)
        !! The lines of some statements.
        type(homework_t), intent(in) :: homework
        integer, allocatable, intent(in) :: because(:)
        character(:), allocatable :: json
        integer :: i

        json = ""
        if (allocated(because)) then
            do i = 1, size(because)
                json = json//json_element(to_text(homework%statements(because(i))%line))
            end do
        end if
        json = json_array(json)
    end function lines_json
end module lagrangia_grade
