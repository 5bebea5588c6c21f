module lagrangia_principle
    !! `lagrangia principle NAME`: both sides of a principle's statement, their difference,
    !! and its picture as files: the data, and the gnuplot script beside it.
    use lagrangia_command_line, only: command_line_t
    use lagrangia_console, only: put_line, put_row
    use lagrangia_data_files, only: data_path, script_path
    use lagrangia_errors, only: error_t, fail, status_not_held
    use lagrangia_gnuplot, only: gnuplot_script, new_panels, new_series, panel_t, &
                                 series_t
    use lagrangia_json, only: json_line, json_object, json_pair
    use lagrangia_ledger, only: group_length
    use lagrangia_ledger_text, only: statement_columns, statement_head, statement_json, &
        statement_line, statement_name
    use lagrangia_output_file, only: commit_both, output_file_t, refuse_unwritable
    use lagrangia_output_options, only: show_picture, take_folder, take_picture
    use lagrangia_places, only: places_t
    use lagrangia_principles, only: find_first_line, principle_report, principles
    use lagrangia_report, only: picture_t, report_t
    use lagrangia_scene_claims, only: claim_table
    use lagrangia_text, only: replaced, to_text
    use lagrangia_text_table, only: text_table_t
    use lagrangia_value_range, only: range_of, value_range_t
    use lagrangia_version, only: build_text, version
    implicit none (type, external)
    private
    public :: principle_command, put_json, put_report

contains

    subroutine principle_command(line, error)
        !! Compute one principle and print it; without a name, list them.
        type(command_line_t), intent(in) :: line  !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        character(:), allocatable :: folder, kind, file
        type(report_t) :: report

        if (size(line%arguments) == 0) then
            call list_principles(line%has("json"))
            return
        end if
        call take_folder(line, folder, error)
        if (allocated(error)) return
        call take_picture(line, kind, error)
        if (allocated(error)) return
        if (any(principles%name == line%arguments(1)%text)) then
            call check_files(picture_name(line%arguments(1)%text), folder, error)
            if (allocated(error)) return
        end if
        call principle_report(line%arguments(1)%text, report, error)
        if (allocated(error)) return
        report%picture%file = picture_name(line%arguments(1)%text)
        call write_picture(report%picture, folder, file, error)
        if (allocated(error)) return
        if (line%has("json")) then
            call put_json(report)
        else
            call put_report(report, file)
        end if
        if (line%has("plot")) call show_picture(file, kind, line, error)
        if (allocated(error)) return
        if (report%broken() > 0) call fail(error, to_text(report%broken())//" of "// &
            to_text(size(report%rows))//" statements are not as they must be", status_not_held)
    end subroutine principle_command

    pure function picture_name(name) result(file)
        !! `principle_least_time`: of the files of `least-time`, without folder and ending.
        character(*), intent(in) :: name
        character(:), allocatable :: file

        file = "principle_"//replaced(name, "-", "_")
    end function picture_name

    subroutine list_principles(as_json)
        !! One a line: its name, the line of the notes where `course` comes to it, what it shows.
        logical, intent(in) :: as_json
        character(5) :: place
        character(2) :: scan
        integer :: i, line

        if (as_json) call put_line("[")
        do i = 1, size(principles)
            associate (page => principles(i))
                call find_first_line(page%name, scan, line)
                if (as_json) then
                    call put_line(json_line(json_object(json_pair("name", page%name)// &
                                                        json_pair("lecture", scan)// &
                                                        json_pair("line", line)// &
                                                        json_pair("meaning", page%meaning)), &
                                            i < size(principles)))
                else
                    place = trim(scan)//" "//to_text(line)
                    call put_line(page%name//place//"  "//trim(page%meaning))
                end if
            end associate
        end do
        if (as_json) call put_line("]")
    end subroutine list_principles

    subroutine put_report(report, file)
        !! The table, group by group.
        type(report_t), intent(in) :: report  !! what is printed
        character(*), intent(in) :: file  !! where the picture is; "" if there is none
        character(group_length) :: heading
        integer :: i, controls

        if (report%title /= "") call put_line(trim(report%title))
        do i = 1, size(report%citations)
            associate (cited => report%citations(i))
                call put_line("the notes, "//trim(cited%scan)//" "//to_text(cited%line)//": "// &
                              trim(cited%text))
            end associate
        end do
        heading = ""
        do i = 1, size(report%rows)
            if (report%rows(i)%group /= heading .or. i == 1) then
                heading = report%rows(i)%group
                if (i > 1 .or. report%title /= "") call put_line("")
                call put_line(trim(heading))
                call put_row(statement_head(), statement_name, statement_columns)
            end if
            call put_row(statement_line(report%rows(i)), statement_name, statement_columns)
        end do
        call put_line("")
        do i = 1, size(report%notes)
            call put_line(trim(report%notes(i)))
        end do
        controls = count(report%rows%control)
        call put_line(to_text(size(report%rows) - controls)//" statements, "//to_text(controls)// &
                      " negative controls (differs, as it must); "// &
                      to_text(report%broken())//" not as they must be")
        if (file /= "") call put_line("data and gnuplot script: "//file)
    end subroutine put_report

    subroutine put_json(report)
        !! The rows as an array of objects.
        type(report_t), intent(in) :: report  !! what is printed
        integer :: i

        call put_line("[")
        do i = 1, size(report%rows)
            call put_line(json_line(statement_json(report%rows(i)), i < size(report%rows)))
        end do
        call put_line("]")
    end subroutine put_json

    subroutine check_files(name, folder, error)
        !! Fails where `write_picture` could not write now: to be asked before a long computation.
        character(*), intent(in) :: name  !! of the files, without ending
        character(*), intent(in) :: folder
        type(error_t), allocatable, intent(out) :: error
        type(places_t) :: places
        character(:), allocatable :: path

        path = data_path(folder, name, "text")
        call claim_table(path, "data", "", places, error)
        if (.not. allocated(error)) call refuse_unwritable(path, error)
        if (.not. allocated(error)) call refuse_unwritable(script_path(path), error)
    end subroutine check_files

    subroutine write_picture(picture, folder, path, error)
        !! Write `folder/NAME.dat` and `folder/NAME.gp`; `path` is the data file, "" without one.
        type(picture_t), intent(in) :: picture
        character(*), intent(in) :: folder
        character(:), allocatable, intent(out) :: path
        type(error_t), allocatable, intent(out) :: error
        type(text_table_t) :: table
        type(output_file_t) :: script
        type(panel_t), allocatable :: panels(:)
        type(series_t), allocatable :: series(:)
        type(value_range_t), allocatable :: ranges(:)
        character(2*group_length) :: header(2)
        integer :: i

        path = ""
        if (picture%file == "") return
        allocate (series(1), ranges(size(picture%values, 1)))
        call new_panels(picture%panels, picture%names, picture%units, panels, error)
        if (allocated(error)) return
        panels%nested = picture%nested
        path = data_path(folder, trim(picture%file), "text")
        header(1) = "lagrangia "//version//": "//picture%title
        header(2) = "build: "//build_text()
        call table%file%open(path, error)
        if (allocated(error)) return
        call table%begin(header, picture%names, picture%units, error)
        if (allocated(error)) return
        do i = 1, size(picture%values, 2)
            call table%row(picture%values(:, i))
        end do
        call table%finish("rows: "//to_text(size(picture%values, 2)), error)
        if (allocated(error)) return
        call script%open(script_path(path), error)
        if (allocated(error)) call table%file%abandon()
        if (allocated(error)) return
        do i = 1, size(ranges)
            ranges(i) = range_of(picture%values(i, :))
        end do
        call new_series(series(1), trim(picture%file)//".dat", table%reading(), picture%names, &
                        picture%units, ranges)
        call script%write(gnuplot_script(series(1)%file, series, trim(picture%title), "", panels))
        call commit_both(table%file, script, error)
    end subroutine write_picture
end module lagrangia_principle
