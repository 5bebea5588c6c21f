module lagrangia_grade
    !! `lagrangia grade FILE...`: a student's statements, each right, or which term is wrong.
    use lagrangia_command_line, only: command_line_t
    use lagrangia_console, only: put, put_line
    use lagrangia_counted, only: counted
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail, status_not_held, status_usage
    use lagrangia_grading, only: grade, grade_t
    use lagrangia_homework, only: homework_t, read_homework
    use lagrangia_json, only: json_array, json_element, json_item, json_object, json_pair, &
                              json_string
    use lagrangia_judgement, only: is_consequence, is_definition, is_right, is_unreadable, &
                                   is_wrong
    use lagrangia_parameter_choice, only: find_parameter
    use lagrangia_printed_table, only: left
    use lagrangia_scene_reader, only: read_named_system
    use lagrangia_system, only: system_t
    use lagrangia_text, only: short_source, shortened, to_text, word_t
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
        integer :: i, wrong, unreadable

        if (size(line%arguments) == 0) then
            call fail(error, "grade what? Give a file with a line 'system: NAME' and "// &
                "statements, one a line")
            return
        end if
        wrong = 0
        unreadable = 0
        if (line%has("json")) call put("[")
        do i = 1, size(line%arguments)
            call read_homework(line%arguments(i)%text, homework, error)
            if (allocated(error)) return
            call find_system(homework, system, error)
            if (allocated(error)) return
            call grade(homework, system, result, error)
            if (allocated(error)) return
            wrong = wrong + count(result%of%verdict == is_wrong)
            unreadable = unreadable + count(result%of%verdict == is_unreadable)
            if (line%has("json")) then
                if (i > 1) call put(", ")
                call put(sheet_json(homework, system, result))
            else if (.not. line%has("quiet")) then
                if (i > 1) call put_line("")
                call print_sheet(homework, system, result)
            end if
        end do
        if (line%has("json")) call put_line("]")
        if (unreadable > 0) then
            call fail(error, "not readable: "//counted(unreadable, "statement"), &
                      status_usage)
        else if (wrong > 0) then
            call fail(error, "wrong: "//counted(wrong, "statement"), status_not_held)
        end if
    end subroutine grade_command

    subroutine find_system(homework, system, error)
        !! The system of a sheet, with what its lines `set:` fix.
        type(homework_t), intent(in) :: homework
        class(system_t), allocatable, intent(out) :: system
        type(error_t), allocatable, intent(out) :: error
        type(word_t), allocatable :: settings(:)
        type(description_t) :: d
        type(error_t), allocatable :: without
        character(:), allocatable :: option
        integer :: i, line, n

        line = homework%system_line
        n = size(homework%settings)
        allocate (settings(n))
        call read_named_system(homework%system, settings(:0), system, error)
        if (.not. allocated(error) .and. n > 0) then
            call system%describe(d)
            do i = 1, n
                line = homework%setting_lines(i)
                call put_setting(homework%settings(i)%text, d, settings(i)%text, error)
                if (allocated(error)) exit
            end do
            if (.not. allocated(error)) then
                call read_named_system(homework%system, settings, system, error)
            else
                n = 0
            end if
            do i = n, 1, -1  ! the first line with which it fails
                if (.not. allocated(error)) exit
                line = homework%setting_lines(i)
                call read_named_system(homework%system, settings(:i - 1), system, without)
                if (.not. allocated(without)) exit
                call move_alloc(without, error)
            end do
        end if
        if (.not. allocated(error)) return
        option = "--set "//trim(d%name)//"%"
        if (index(error%message, option) == 1) error%message = "set: "// &
                                                              error%message(len(option) + 1:)
        n = index(error%message, "another --set")
        if (n > 0) error%message = error%message(:n - 1)//"another line 'set:'"// &
                                   error%message(n + 13:)
        call error%add_context(trim(short_source(homework%source))//":"//to_text(line))
    end subroutine find_system

    subroutine put_setting(said, d, setting, error)
        !! `magnetic_y=1` is `charged_particle%magnetic(2)=1` to the reader.
        character(*), intent(in) :: said                        !! `name=value`
        type(description_t), intent(in) :: d                    !! of the system
        character(:), allocatable, intent(out) :: setting       !! as behind `--set`
        type(error_t), allocatable, intent(out) :: error        !! an element that is none
        character(:), allocatable :: name
        integer :: element, equals, parameter

        equals = index(said, "=")
        setting = trim(d%name)//"%"//said
        call find_parameter(d, said(:equals - 1), parameter, element)
        if (parameter == 0 .or. element == 0) return
        associate (p => d%parameters(parameter))
            if (p%count == 1) return
            name = trim(p%name)
            setting = trim(d%name)//"%"//name//"("//to_text(element)//")"//said(equals:)
            if (element > p%count) call fail(error, "set: "//name//" has "// &
                to_text(p%count)//" values, "//name//"(1) to "//name//"("//to_text(p%count)//")")
        end associate
    end subroutine put_setting

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
