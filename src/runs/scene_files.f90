module lagrangia_scene_files
    !! The files of one scene: the data file while it runs, the gnuplot script when it is done.
    use lagrangia_csv_table, only: csv_table_t
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail, status_file
    use lagrangia_files, only: plain_path
    use lagrangia_gnuplot, only: gnuplot_script, panel_t
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_npy, only: npy_table_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_output_file, only: output_file_t, remove_partial
    use lagrangia_processes, only: run_program
    use lagrangia_record, only: record_t
    use lagrangia_scene, only: scene_line_length, scene_lines, scene_t
    use lagrangia_system, only: system_t
    use lagrangia_table, only: table_t
    use lagrangia_text, only: quoted, to_text, word_t
    use lagrangia_text_table, only: text_table_t
    use lagrangia_version, only: build_text, version
    implicit none (type, external)
    private
    public :: check_format, open_files, finish_files, commit_files, abandon_files, draw, &
              send_header, script_path, data_path, new_table

    character(4), parameter :: formats(3) = ["text", "csv ", "npy "]
    character(4), parameter :: endings(3) = [".dat", ".csv", ".npy"]

contains

    pure subroutine check_format(format, error)
        !! Refuse a format that does not exist.
        character(*), intent(in) :: format
        type(error_t), allocatable, intent(out) :: error

        if (any(formats == format)) return
        call fail(error, "unknown format "//quoted(format)//"; there are text, csv, npy")
    end subroutine check_format

    subroutine new_table(format, table)
        !! A table of that format, not yet opened.
        character(*), intent(in) :: format
        class(table_t), allocatable, intent(out) :: table

        select case (format)
        case ("text"); allocate (text_table_t :: table)
        case ("csv"); allocate (csv_table_t :: table)
        case default; allocate (npy_table_t :: table)
        end select
    end subroutine new_table

    pure function data_path(folder, output, format) result(path)
        !! `folder/output`, with the format's ending where `output` has none.
        character(*), intent(in) :: folder, output, format
        character(:), allocatable :: path

        path = folder//"/"//output
        if (folder(len(folder):) == "/") path = folder//output
        if (index(output(index(output, "/", back=.true.) + 1:), ".") > 0) return
        path = path//trim(endings(findloc(formats == format, .true., 1)))
    end function data_path

    pure function script_path(path) result(script)
        !! The gnuplot script beside a data file.
        character(*), intent(in) :: path
        character(:), allocatable :: script
        integer :: dot

        dot = index(path, ".", back=.true.)
        if (dot <= index(path, "/", back=.true.)) dot = len(path) + 1
        script = path(:dot - 1)//".gp"
    end function script_path

    subroutine draw(path, kind, error)
        !! Let gnuplot draw the data file at `path`, as `kind` (png or svg); no shell is involved.
        !! It says nothing of a full disk, so its picture gets its name only if its end is there.
        character(*), intent(in) :: path, kind
        type(error_t), allocatable, intent(out) :: error
        type(output_file_t) :: picture
        character(:), allocatable :: script
        type(word_t) :: words(6)
        integer :: status

        script = script_path(path)
        call picture%open(script(:len(script) - 2)//kind, error)
        if (allocated(error)) return
        words(1)%text = "gnuplot"
        words(2)%text = "-d"  ! not the user's start-up file
        words(3)%text = "-c"
        words(4)%text = plain_path(script)  ! a shell runs what stands behind a first < or |
        words(5)%text = kind
        words(6)%text = picture%temporary_name()
        call run_program(words, status, error)
        if (interrupt_status() /= 0) call fail(error, "interrupted", interrupt_status())
        if (.not. allocated(error) .and. status /= 0) call fail(error, "gnuplot ended with "// &
            "status "//to_text(status)//" on '"//script//"'", status_file)
        if (.not. allocated(error)) then
            if (.not. ends_well(picture%temporary_name(), kind)) call fail(error, "gnuplot did "// &
                "not finish '"//script(:len(script) - 2)//kind//"': no space left, or it knows "// &
                "no "//kind, status_file)
        end if
        if (allocated(error)) then
            call picture%abandon()
        else
            call picture%commit(error)
        end if
    end subroutine draw

    function ends_well(path, kind)
        !! Whether a picture is there to its last byte, as far as its last bytes tell.
        character(*), intent(in) :: path, kind
        logical :: ends_well
        character(20) :: last
        integer :: unit, length, status

        ends_well = .false.
        open (newunit=unit, file=path, access="stream", form="unformatted", status="old", &
              action="read", iostat=status)
        if (status /= 0) return
        inquire (unit=unit, size=length)
        if (length > len(last)) read (unit, pos=length - len(last) + 1, iostat=status) last
        close (unit)
        if (length > len(last) .and. status == 0) ends_well = &
            index(last, trim(merge("IEND  ", "</svg>", kind == "png"))) > 0
    end function ends_well

    subroutine open_files(scene, system, choice, folder, format, record, path, error)
        !! Open the data file, under a temporary name until `finish_files`, and write its header.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        character(*), intent(in) :: choice  !! which method, and why; "" if the scene names it
        character(*), intent(in) :: folder, format
        type(record_t), intent(inout) :: record
        character(:), allocatable, intent(out) :: path
        type(error_t), allocatable, intent(out) :: error
        character(scene_line_length) :: first, last(2)
        type(description_t) :: d

        call new_table(format, record%table)
        path = data_path(folder, trim(scene%output), format)
        call record%table%file%open(path, error)
        if (allocated(error)) return
        call system%describe(d)
        first = "lagrangia "//version//": "//scene%title
        last(1) = choice
        last(2) = "build: "//build_text()
        call record%table%begin([first, scene_lines(scene, d), pack(last, last /= "")], &
                                record%columns%names(record%shown), &
                                record%columns%units(record%shown), error)
        call send_header(record%table, error)
    end subroutine open_files

    subroutine send_header(table, error)
        !! To the disk, before anything is computed: it may be full. `error` may be `begin`'s.
        class(table_t), intent(inout) :: table
        type(error_t), allocatable, intent(inout) :: error

        if (.not. allocated(error)) then
            call table%file%flush()
            call table%file%report(error)
        end if
        if (allocated(error)) call table%file%abandon()
    end subroutine send_header

    subroutine finish_files(scene, folder, format, record, panels, outcome, script, error)
        !! Complete the data file, and the script beside it. `commit_files` names them.
        type(scene_t), intent(in) :: scene
        character(*), intent(in) :: folder, format
        type(record_t), intent(inout) :: record
        type(panel_t), intent(in) :: panels(:)
        type(outcome_t), intent(in) :: outcome
        type(output_file_t), intent(inout) :: script
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: path, rejected

        if (.not. allocated(record%table)) return
        rejected = ""
        if (scene%tolerance > 0) rejected = " accepted, "//to_text(outcome%rejected)// &
                                                 " rejected"
        call record%table%finish("steps: "//to_text(outcome%steps)//rejected//outcome%remark// &
                                 ", force evaluations: "//to_text(outcome%evaluations)// &
                                 ", energy evaluations: "//to_text(outcome%energy_evaluations)// &
                                 ", rows: "//to_text(outcome%rows), error)
        if (allocated(error)) return
        path = data_path(folder, trim(scene%output), format)
        call script%open(script_path(path), error)
        if (allocated(error)) return
        call script%write(gnuplot_script( &
            path(index(path, "/", back=.true.) + 1:), record%table%reading(), trim(scene%title), &
            record%columns%names(record%shown), record%columns%units(record%shown), record%low, &
            record%high, panels))
        call script%complete(error)
    end subroutine finish_files

    subroutine commit_files(table, script, error)
        !! Give the data file, if there is one, and its script their names; what an earlier run
        !! that failed has left of the data goes.
        class(table_t), allocatable, intent(inout) :: table
        type(output_file_t), intent(inout) :: script
        type(error_t), allocatable, intent(out) :: error

        if (.not. allocated(table)) return
        call table%file%commit(error)
        if (allocated(error)) return
        call remove_partial(table%file%name())
        if (script%is_open()) call script%commit(error)
    end subroutine commit_files

    subroutine abandon_files(record)
        !! Leave nothing behind.
        type(record_t), intent(inout) :: record

        if (allocated(record%table)) call record%table%file%abandon()
    end subroutine abandon_files
end module lagrangia_scene_files
