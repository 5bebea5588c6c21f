module lagrangia_course_command
    !! `lagrangia course [I|II]`: the notes line by line, and the command that shows each of them.
    use lagrangia_command_line, only: command_line_t
    use lagrangia_console, only: put_line
    use lagrangia_course_table, only: course_of_the_notes, statement_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_json, only: json_array, json_element, json_item, json_line, json_object, &
                              json_pair, json_string
    use lagrangia_text, only: quoted, to_text
    implicit none (type, external)
    private
    public :: course_command, next_command

contains

    subroutine course_command(line, error)
        !! Print the statements of one lecture, or of both.
        type(command_line_t), intent(in) :: line  !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(statement_t), allocatable :: course(:)
        character(:), allocatable :: scan
        integer :: i

        scan = ""
        if (size(line%arguments) > 0) scan = line%arguments(1)%text
        if (size(line%arguments) > 0 .and. scan /= "I" .and. scan /= "II") then
            call fail(error, "no lecture "//quoted(scan)//"; there are I, of 1 September 2011, "// &
                      "and II, Hamilton's Principle")
            return
        end if
        call select_lecture(scan, course)
        if (line%has("json")) then
            call put_line("[")
            do i = 1, size(course)
                call put_line(json_line(object(course(i)), i < size(course)))
            end do
            call put_line("]")
            return
        end if
        do i = 1, size(course)
            if (i == 1) then
                call put_line(heading(course(i)%scan))
            else if (course(i)%scan /= course(i - 1)%scan) then
                call put_line("")
                call put_line(heading(course(i)%scan))
            end if
            call put_statement(course(i))
        end do
        call put_line("")
        call put_line(to_text(size(course))//" statements, "// &
                      to_text(count(course%nothing /= ""))//" that nothing shows; the lines "// &
                                                      "are "// &
                      "those of the scan's text, quoted as it is")
    end subroutine course_command

    subroutine select_lecture(scan, course)
        !! All statements, or those of one lecture.
        character(*), intent(in) :: scan  !! I, II, or empty for both
        type(statement_t), allocatable, intent(out) :: course(:)
        type(statement_t), allocatable :: all_of_them(:)

        allocate (all_of_them, source=course_of_the_notes())
        allocate (course, source=pack(all_of_them, scan == "" .or. all_of_them%scan == scan))
    end subroutine select_lecture

    pure function heading(scan) result(text)
        !! Which lecture it is.
        character(*), intent(in) :: scan
        character(:), allocatable :: text

        text = "I: Classical Mechanics (Phys 601), 1 September 2011"
        if (scan == "II") text = "II: Hamilton's Principle"
    end function heading

    subroutine put_statement(statement)
        !! The line, what it says, and the commands, one a line.
        type(statement_t), intent(in) :: statement
        character(*), parameter :: indent = "        "
        character(:), allocatable :: place, rest, command

        place = trim(statement%scan)//" "//to_text(statement%line)
        if (statement%last > statement%line) place = place//"-"//to_text(statement%last)
        call put_line("")
        call put_line(place//repeat(" ", max(1, len(indent) - len(place)))//trim(statement%says))
        call put_line(indent//"notes: "//trim(statement%quote))
        if (statement%nothing /= "") call put_line(indent//"nothing shows this: "// &
                                                   trim(statement%nothing))
        rest = trim(statement%shows)
        do while (rest /= "")
            call next_command(rest, command)
            call put_line(indent//"lagrangia "//command)
        end do
    end subroutine put_statement

    pure subroutine next_command(rest, command)
        !! Take the first command from those that are left.
        character(:), allocatable, intent(inout) :: rest   !! `check; run wedge`, then `run wedge`
        character(:), allocatable, intent(out) :: command  !! `check`
        integer :: at

        at = index(rest//"; ", "; ")
        command = rest(:at - 1)
        rest = rest(min(len(rest) + 1, at + 2):)
    end subroutine next_command

    pure function object(statement) result(json)
        !! One statement.
        type(statement_t), intent(in) :: statement
        character(:), allocatable :: json, commands, rest, command

        commands = ""
        rest = trim(statement%shows)
        do while (rest /= "")
            call next_command(rest, command)
            commands = commands//json_element(json_string("lagrangia "//command))
        end do
        json = json_object(json_pair("lecture", statement%scan)//json_pair("line", &
                                                                           statement%line)// &
                           json_pair("last", statement%last)//json_pair("quote", &
                                                                        statement%quote)// &
                           json_pair("says", statement%says)// &
                           json_item("shows", json_array(commands))// &
                           json_pair("nothing", statement%nothing))
    end function object
end module lagrangia_course_command
