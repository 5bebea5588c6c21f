module lagrangia_run_files
    !! The files of one run: data and events while it goes on, gnuplot scripts when it is done. All
    !! get their names together; what remains of a run that fails is called `NAME.partial`.
    use lagrangia_characters, only: printable
    use lagrangia_column_names, only: told_apart
    use lagrangia_counted, only: counted
    use lagrangia_data_files, only: data_path, event_path, new_table, scene_path, &
                                    script_path
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t, message_length
    use lagrangia_gnuplot, only: dots, gnuplot_script, new_series, panel_t, series_t
    use lagrangia_kinds, only: dp
    use lagrangia_methods, only: exact
    use lagrangia_number_text, only: rounded
    use lagrangia_outcome, only: outcome_t
    use lagrangia_output_file, only: output_file_t, remove_partial
    use lagrangia_plot_label, only: is_small
    use lagrangia_record, only: record_t
    use lagrangia_run_plan, only: run_plan_t
    use lagrangia_scene, only: heading, scene_line_length, scene_lines, scene_t
    use lagrangia_text, only: shortened, to_text
    use lagrangia_text_table, only: text_table_t
    use lagrangia_version, only: build_text, version
    implicit none (type, external)
    private
    public :: abandon_files, finish_files, keep_parts, method_text, open_files

    character(*), parameter :: lf = new_line("a")
    integer, parameter :: shown_digits = 6     !! of a step or a tolerance
    integer, parameter :: longest_remark = 90  !! characters below a title

contains

    subroutine open_files(plan, folder, format, path, error)
        !! Open the data file and, where there are events, theirs, under temporary names until
        !! `finish_files`, and write their headers.
        type(run_plan_t), intent(inout) :: plan  !! its records get their tables
        character(*), intent(in) :: folder                    !! is made if need be
        character(*), intent(in) :: format                    !! text, csv or npy
        character(:), allocatable, intent(out) :: path        !! of the data file
        type(error_t), allocatable, intent(out) :: error      !! then none is open
        character(scene_line_length), allocatable :: header(:)
        character(scene_line_length) :: last(2)
        type(description_t) :: d
        integer :: i, n

        call plan%system%describe(d)
        associate (record => plan%record, events => plan%event_record, scene => plan%scene)
            path = data_path(folder, trim(scene%output), format)
            header = [character(scene_line_length) :: "lagrangia "//version//": "//scene%title, &
                      scene_lines(scene, d)]
            last(1) = plan%choice
            last(2) = "build: "//build_text()
            n = record%shown
            call open_table(record, format, path, [header, pack(last, last /= "")], &
                            record%columns%names(n), record%columns%units(n), error)
            if (allocated(error) .or. size(plan%trajectory%events) == 0) return
            header = [header, last(2:)]
            do i = 1, size(plan%trajectory%events)
                header = [character(scene_line_length) :: header, &
                          "event "//to_text(i)//": "//plan%trajectory%events(i)%item%label]
            end do
            n = size(events%columns%items)
            call open_table(events, format, event_path(path), header, &
                            told_apart([character(name_length) :: events%columns%names(n), &
                                                                  "event"]), &
                            [character(16) :: events%columns%units(n), "1"], error)
            if (allocated(error)) call record%abandon()
        end associate
    end subroutine open_files

    subroutine open_table(record, format, path, header, names, units, error)
        !! Under a temporary name, with its header on the disk.
        class(record_t), intent(inout) :: record
        character(*), intent(in) :: format, path, header(:), names(:), units(:)
        type(error_t), allocatable, intent(out) :: error

        call new_table(format, record%table)
        call record%table%file%open(path, error)
        if (allocated(error)) return
        call record%table%begin(header, names, units, error)
        call record%table%send_header(error)
    end subroutine open_table

    subroutine finish_files(plan, outcome, error)
        !! Complete all files of the run; where that succeeds they get their names, else none.
        type(run_plan_t), intent(inout) :: plan  !! its run has succeeded
        type(outcome_t), intent(inout) :: outcome         !! gets the name of the file of events
        type(error_t), allocatable, intent(out) :: error  !! of a file
        type(output_file_t) :: scripts(2), scene

        call complete_files(plan, outcome, scripts, error)
        if (.not. allocated(error)) call write_scene(plan, scene, error)
        if (.not. allocated(error)) call commit_files(plan%event_record, scripts(1), error)
        if (.not. allocated(error)) call commit_files(plan%record, scripts(2), error)
        if (.not. allocated(error) .and. scene%is_open()) call scene%commit(error)
        if (.not. allocated(error)) return
        outcome%file = ""
        outcome%events = ""
        outcome%draws_events = .false.
        call abandon_files(plan)
        call scripts(1)%abandon()
        call scripts(2)%abandon()
        call scene%abandon()
    end subroutine finish_files

    subroutine write_scene(plan, file, error)
        !! Beside a table whose format has no place for it: the scene as it was run, which can be
        !! run again, what built it, and the columns with their units.
        type(run_plan_t), intent(in) :: plan
        type(output_file_t), intent(inout) :: file  !! complete but for its name; or not open
        type(error_t), allocatable, intent(out) :: error
        character(scene_line_length), allocatable :: lines(:)
        type(description_t) :: d
        character(:), allocatable :: text
        integer :: i

        if (.not. allocated(plan%record%table)) return
        select type (table => plan%record%table)
        type is (text_table_t)
            return
        end select
        call plan%system%describe(d)
        associate (scene => plan%scene, columns => plan%record%columns%items)
            text = "! lagrangia "//version//": "//printable(trim(scene%title))//lf// &
                   "! build: "//build_text()//lf
            if (plan%choice /= "") text = text//"! "//plan%choice//lf
            text = text//"! columns:"
            do i = 1, plan%record%shown
                text = text//" "//trim(columns(i)%name)//"["//trim(columns(i)%unit)//"]"
            end do
            text = text//lf
            allocate (lines, source=scene_lines(scene, d))
            do i = 1, size(lines)
                text = text//trim(lines(i))//lf
            end do
        end associate
        call file%open(scene_path(plan%record%table%file%name()), error)
        if (allocated(error)) return
        call file%write(text)
        call file%complete(error)
    end subroutine write_scene

    subroutine complete_files(plan, outcome, scripts, error)
        !! All but their names: the tables' last lines, and the scripts beside them; that of the
        !! events only where there is more than one.
        type(run_plan_t), intent(inout) :: plan
        type(outcome_t), intent(inout) :: outcome
        type(output_file_t), intent(inout) :: scripts(2)  !! of the events, of the samples
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: rejected
        integer :: n

        associate (record => plan%record, events => plan%event_record)
            if (allocated(events%table)) then
                call events%table%finish("events: "//to_text(events%rows), error)
                if (allocated(error)) return
                outcome%events = events%table%file%name()
                n = size(events%columns%items)
                outcome%draws_events = events%rows > 1 .and. size(plan%event_panels) > 0
                if (outcome%draws_events) then
                    call write_script(events, n, heading(plan%scene), event_remark(plan), &
                                      plan%event_panels, scripts(1), error, dots)
                    if (allocated(error)) return
                end if
            end if
            if (.not. allocated(record%table)) return
            rejected = ""
            if (plan%scene%tolerance > 0) rejected = " accepted, "//to_text(outcome%rejected)// &
                " rejected"
            call record%table%finish( &
                "steps: "//to_text(outcome%steps)//rejected//outcome%remark// &
                ", force evaluations: "//to_text(outcome%evaluations)// &
                ", energy evaluations: "//to_text(outcome%energy_evaluations)// &
                ", rows: "//to_text(outcome%rows), error)
            if (allocated(error)) return
            call write_script(record, record%shown, heading(plan%scene), &
                              method_remark(plan), &
                              plan%panels, scripts(2), error)
        end associate
    end subroutine complete_files

    pure function event_remark(plan) result(text)
        !! What the dots of a picture are: `where theta1 = 0, rising`, `at each impact`.
        type(run_plan_t), intent(in) :: plan
        character(:), allocatable :: text
        integer :: i

        text = ""
        do i = 1, size(plan%trajectory%events)
            if (i > 1) text = text//"; "
            text = text//trim(plan%trajectory%events(i)%item%place)
        end do
        text = shortened(text, longest_remark)
    end function event_remark

    pure function method_remark(plan) result(text)
        !! The method and its step or tolerance, where a picture shows a drift or an error: they
        !! are the method's, not the system's.
        type(run_plan_t), intent(in) :: plan
        character(:), allocatable :: text
        integer :: i

        text = ""
        associate (scene => plan%settled, panels => plan%panels)
            do i = 1, size(panels)
                if (any(is_small(scene%columns(panels(i)%y(:panels(i)%curves))))) then
                    text = method_text(scene)
                end if
            end do
        end associate
    end function method_remark

    pure function method_text(scene) result(text)
        !! `rk4, dt = 0.001 s`, `dop853, tolerance 1e-12`.
        type(scene_t), intent(in) :: scene  !! with its method, not `auto`
        character(:), allocatable :: text

        text = trim(scene%method)
        if (scene%compensated) text = text//", compensated"
        if (scene%method == exact) return
        if (scene%tolerance > 0.0_dp) then
            text = text//", tolerance "//rounded(scene%tolerance, shown_digits)
        else
            text = text//", dt = "//rounded(scene%dt, shown_digits)//" s"
        end if
    end function method_text

    subroutine write_script(record, shown, title, remark, panels, script, error, style)
        !! The gnuplot script beside a table, complete but for its name.
        class(record_t), intent(in) :: record
        integer, intent(in) :: shown  !! columns
        character(*), intent(in) :: title, remark
        type(panel_t), intent(in) :: panels(:)
        type(output_file_t), intent(inout) :: script
        type(error_t), allocatable, intent(out) :: error
        character(*), intent(in), optional :: style
        type(series_t), allocatable :: series(:)
        character(:), allocatable :: path

        path = record%table%file%name()
        call script%open(script_path(path), error)
        if (allocated(error)) return
        allocate (series(1))
        call new_series(series(1), path(index(path, "/", back=.true.) + 1:), &
                        record%table%reading(), record%columns%names(shown), &
                        record%columns%units(shown), record%ranges)
        call script%write(gnuplot_script(series(1)%file, series, title, remark, panels, style))
        call script%complete(error)
    end subroutine write_script

    subroutine commit_files(record, script, error)
        !! Give the table, if there is one, and its script their names; what an earlier run that
        !! failed has left of the table goes.
        class(record_t), intent(inout) :: record
        type(output_file_t), intent(inout) :: script
        type(error_t), allocatable, intent(out) :: error

        if (.not. allocated(record%table)) return
        call record%table%file%commit(error)
        if (allocated(error)) return
        call remove_partial(record%table%file%name())
        if (script%is_open()) call script%commit(error)
    end subroutine commit_files

    subroutine abandon_files(plan)
        !! Leave nothing behind.
        type(run_plan_t), intent(inout) :: plan  !! its run has failed

        call plan%record%abandon()
        call plan%event_record%abandon()
    end subroutine abandon_files

    subroutine keep_parts(plan, outcome, error)
        !! The rows before the numbers failed, in files of their own; `error`, which says why they
        !! did, then names them too.
        type(run_plan_t), intent(inout) :: plan  !! its run has failed on its numbers
        type(outcome_t), intent(inout) :: outcome  !! gets the name of the data file
        type(error_t), intent(inout) :: error      !! why the run failed
        type(error_t), allocatable :: file_error
        character(:), allocatable :: ending, steps

        associate (times => plan%trajectory%times, record => plan%record, &
                   events => plan%event_record)
            steps = counted(outcome%steps, "step")
            if (times%steps > 0) steps = to_text(outcome%steps)//" of "// &
                                         counted(times%step_count(), "step")
            ending = "the run ended at t = "//to_text(outcome%t)//" s after "//steps//": "// &
                     error%message
            outcome%file = ""
            call keep_part(events, ending, file_error)
            if (allocated(file_error)) then
                call record%abandon()
            else
                call keep_part(record, ending, file_error)
                if (allocated(record%table) .and. record%rows > 0 .and. &
                    .not. allocated(file_error)) then
                    outcome%file = record%table%file%name()
                    error%message = error%message//"; the rows before are in '"// &
                                    outcome%file//"'"
                end if
            end if
        end associate
        if (allocated(file_error)) error%message = error%message//"; "//file_error%message
        error%message = shortened(error%message, message_length)
    end subroutine keep_parts

    subroutine keep_part(record, ending, error)
        !! What a run wrote that failed: the rows that were good are called `NAME.partial`, and
        !! say for what `ending`, where the format has a place for it. Without rows there is no
        !! such file, nor one of an earlier run. The file `NAME` stays as it is.
        class(record_t), intent(inout) :: record
        character(*), intent(in) :: ending
        type(error_t), allocatable, intent(out) :: error

        if (.not. allocated(record%table)) return
        if (record%rows == 0) then
            call remove_partial(record%table%file%name())
            call record%abandon()
            return
        end if
        record%table%file%partial = .true.
        call record%table%finish("PARTIAL, rows: "//to_text(record%rows)//"; "//ending, error)
        if (.not. allocated(error)) call record%table%file%commit(error)
    end subroutine keep_part
end module lagrangia_run_files
