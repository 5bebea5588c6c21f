module lagrangia_principle
    !! `lagrangia principle NAME`: both sides of a principle's statement, and their difference.
    use lagrangia_action, only: action_principle
    use lagrangia_catalogue, only: built_in, nth_system
    use lagrangia_command_line, only: command_line_t
    use lagrangia_console, only: put_line
    use lagrangia_constraints, only: constraints_principle
    use lagrangia_errors, only: error_t, fail, status_not_held
    use lagrangia_gauge, only: gauge_principle
    use lagrangia_json, only: json_number, json_string
    use lagrangia_kinds, only: dp
    use lagrangia_least_time, only: least_time_principle
    use lagrangia_names, only: refuse_name
    use lagrangia_number_text, only: scientific
    use lagrangia_picture_files, only: check_picture, write_picture
    use lagrangia_report, only: report_t, statement_length, statement_t
    use lagrangia_scene_files, only: draw
    use lagrangia_system, only: system_box_t
    use lagrangia_text, only: quoted, to_text
    use lagrangia_virtual_work, only: virtual_work_principle
    use lagrangia_walker, only: walker_t
    implicit none (type, external)
    private
    public :: principle_command, principle_names, principle_report, put_json, put_report, &
              statement_line

    type :: principle_t
        character(16) :: name = ""
        character(76) :: meaning = ""
        logical :: drawn = .false.  !! there is a picture to it
    end type principle_t

    type(principle_t), parameter :: principles(*) = [ &
        principle_t("action", "Hamilton: the actual path makes the action stationary", .true.), &
        principle_t("constraints", "holonomic or not, fixed or moving; degrees of freedom", &
                    .true.), &
        principle_t("gauge", "uniqueness: L and L + dF/dt tell the same motion"), &
        principle_t("least-time", "Hero, Fermat: light takes a path of stationary time", .true.), &
        principle_t("virtual-work", "d'Alembert: constraint forces do no virtual work; Q_j")]

contains

    subroutine principle_command(line, error)
        !! Compute one principle and print it; without a name, list them.
        type(command_line_t), intent(in) :: line
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: folder, kind, file
        type(report_t) :: report

        if (size(line%arguments) == 0) then
            call list_principles()
            return
        end if
        folder = line%value_of("output", "data/output")
        if (folder == "") call fail(error, "option '--output' needs the name of a folder")
        if (allocated(error)) return
        kind = line%value_of("plot", "png")
        if (kind == "") kind = "png"
        if (kind /= "png" .and. kind /= "svg") call fail(error, "unknown picture format "// &
            quoted(kind)//"; there are png, svg")
        if (allocated(error)) return
        if (any(principles%name == line%arguments(1)%text .and. principles%drawn)) then
            call check_picture(picture_name(line%arguments(1)%text), folder, error)
            if (allocated(error)) return
        end if
        call principle_report(line%arguments(1)%text, report, error)
        if (allocated(error)) return
        if (report%picture%file /= "") report%picture%file = picture_name(line%arguments(1)%text)
        call write_picture(report%picture, folder, file, error)
        if (allocated(error)) return
        if (line%has("json")) then
            call put_json(report)
        else
            call put_report(report, file)
        end if
        if (line%has("plot") .and. file /= "") call draw(file, kind, error)
        if (allocated(error)) return
        if (report%misses() > 0) call fail(error, to_text(report%misses())//" of "// &
            to_text(size(report%rows))//" statements are not as they must be", status_not_held)
    end subroutine principle_command

    pure function picture_name(name) result(file)
        !! `principle_least_time`: of the files of `least-time`, without folder and ending.
        character(*), intent(in) :: name
        character(:), allocatable :: file
        integer :: i

        file = "principle_"//name
        do i = 1, len(file)
            if (file(i:i) == "-") file(i:i) = "_"
        end do
    end function picture_name

    subroutine principle_report(name, report, error)
        !! The report of one principle.
        character(*), intent(in) :: name
        type(report_t), intent(out) :: report
        type(error_t), allocatable, intent(out) :: error
        type(walker_t) :: walker
        type(system_box_t), allocatable :: systems(:)

        select case (name)
        case ("action")
            call action_principle(walker, report, error)
        case ("constraints")
            call constraints_principle(walker, report, error)
        case ("gauge")
            call every_system(systems)
            call gauge_principle(systems, report, error)
        case ("least-time")
            call least_time_principle(walker, report, error)
        case ("virtual-work")
            call every_system(systems)
            call virtual_work_principle(systems, walker, report, error)
        case default
            call refuse_name("principle", name, principle_names(), error)
        end select
    end subroutine principle_report

    subroutine every_system(systems)
        !! Those of the lectures, with default parameters.
        type(system_box_t), allocatable, intent(out) :: systems(:)
        integer :: i

        allocate (systems(built_in))
        do i = 1, size(systems)
            call nth_system(i, systems(i)%item)
        end do
    end subroutine every_system

    pure function principle_names() result(names)
        !! All of them.
        character(16) :: names(size(principles))

        names = principles%name
    end function principle_names

    subroutine list_principles()
        !! One a line.
        integer :: i

        do i = 1, size(principles)
            call put_line(principles(i)%name//trim(principles(i)%meaning))
        end do
    end subroutine list_principles

    subroutine put_report(report, file)
        !! The table, group by group.
        type(report_t), intent(in) :: report
        character(*), intent(in) :: file
        character(98) :: heading
        integer :: i, controls

        if (report%title /= "") call put_line(trim(report%title))
        heading = ""
        do i = 1, size(report%rows)
            if (report%rows(i)%heading /= heading .or. i == 1) then
                heading = report%rows(i)%heading
                if (i > 1 .or. report%title /= "") call put_line("")
                call put_line(trim(heading))
                call put_line(repeat(" ", statement_length + 6)// &
                              "left          right  differ   bound")
            end if
            call put_line(statement_line(report%rows(i)))
        end do
        call put_line("")
        do i = 1, size(report%notes)
            call put_line(trim(report%notes(i)))
        end do
        controls = count(report%rows%control)
        call put_line(to_text(size(report%rows) - controls)//" statements, "//to_text(controls)// &
                      " negative controls (fails: as it must); "// &
                      to_text(report%misses())//" not as they must be")
        if (file /= "") call put_line("data and gnuplot script: "//file)
    end subroutine put_report

    pure function statement_line(row) result(line)
        !! One row: at most 100 columns.
        type(statement_t), intent(in) :: row
        character(:), allocatable :: line
        character(7) :: verdict

        if (row%as_it_must()) then
            verdict = merge("fails  ", "holds  ", row%control)
        else
            verdict = merge("HOLDS !", "FAILS !", row%control)
        end if
        line = row%name//shown(row%left)//shown(row%right)//" "//short(row%difference)//" "// &
               short(row%bound)//"  "//trim(verdict)
    end function statement_line

    pure function shown(value) result(text)
        !! A number in 15 columns: whole ones as such, others with nine digits.
        real(dp), intent(in) :: value
        character(15) :: text

        if (abs(value) < 1e6_dp .and. abs(value - anint(value)) <= 0.0_dp) then
            write (text, "(ss, i15)") nint(value)
        else if (abs(value) >= 1e-2_dp .and. abs(value) < 1e4_dp) then
            write (text, "(ss, f15.9)") value
        else
            text = scientific(value, 8)
            text = adjustr(text)
        end if
    end function shown

    pure function short(value) result(text)
        !! Two digits are enough for a difference.
        real(dp), intent(in) :: value
        character(:), allocatable :: text

        text = "      0"
        if (abs(value) > 0.0_dp) text = scientific(value, 2)
    end function short

    subroutine put_json(report)
        !! The rows as an array of objects.
        type(report_t), intent(in) :: report
        integer :: i

        call put_line("[")
        do i = 1, size(report%rows)
            associate (row => report%rows(i))
                call put_line('{"group": '//json_string(row%heading)//', "statement": '// &
                              json_string(row%name)//', "left": '//json_number(row%left)// &
                              ', "right": '//json_number(row%right)//', "difference": '// &
                              json_number(row%difference)//', "bound": '// &
                              json_number(row%bound)//', "control": '// &
                              trim(merge("true ", "false", row%control))//', "holds": '// &
                              trim(merge("true ", "false", row%holds()))//"}"// &
                              trim(merge(",", " ", i < size(report%rows))))
            end associate
        end do
        call put_line("]")
    end subroutine put_json
end module lagrangia_principle
