module lagrangia_data_files
    !! Data files by their format: their names, the scripts beside them, and the pictures that
    !! gnuplot makes of them.
    use lagrangia_changed_scene, only: ending_start
    use lagrangia_csv_table, only: csv_table_t
    use lagrangia_errors, only: error_t, fail, status_file
    use lagrangia_files, only: plain_path
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_npy, only: npy_table_t
    use lagrangia_output_file, only: output_file_t
    use lagrangia_processes, only: run_program
    use lagrangia_table, only: table_t
    use lagrangia_text, only: join, quoted, to_text, word_t
    use lagrangia_text_table, only: text_table_t
    implicit none (type, external)
    private
    public :: check_format, check_picture, data_path, draw, ends_well, event_path, film_path
    public :: new_table, path_beside, pictures, scene_path, script_path

    character(4), parameter :: formats(3) = ["text", "csv ", "npy "]
    character(3), parameter :: pictures(3) = ["png", "svg", "pdf"]  !! what `draw` makes
    character(4), parameter :: endings(3) = [".dat", ".csv", ".npy"]

contains

    pure subroutine check_format(format, error)
        !! Refuse a format that does not exist.
        character(*), intent(in) :: format  !! a word of the command line
        type(error_t), allocatable, intent(out) :: error  !! names those that exist

        if (any(formats == format)) return
        call fail(error, "unknown format "//quoted(format)//"; there are text, csv, npy")
    end subroutine check_format

    pure subroutine check_picture(kind, error)
        !! Refuse a picture format that does not exist.
        character(*), intent(in) :: kind  !! a word of the command line
        type(error_t), allocatable, intent(out) :: error  !! names those that exist

        if (any(pictures == kind)) return
        call fail(error, "unknown picture format "//quoted(kind)//"; there are "// &
                  join(pictures, ", "))
    end subroutine check_picture

    subroutine new_table(format, table)
        !! A table of that format, not yet opened.
        character(*), intent(in) :: format  !! text, csv or npy
        class(table_t), allocatable, intent(out) :: table  !! of that format

        select case (format)
        case ("text"); allocate (text_table_t :: table)
        case ("csv"); allocate (csv_table_t :: table)
        case default; allocate (npy_table_t :: table)
        end select
    end subroutine new_table

    pure function data_path(folder, output, format) result(path)
        !! `folder/output`, with the format's ending where `output` has none.
        character(*), intent(in) :: folder, output, format  !! none empty; one of the formats
        character(:), allocatable :: path

        path = folder//"/"//output
        if (folder(len(folder):) == "/") path = folder//output
        if (ending_start(output) <= len(output)) return
        path = path//trim(endings(findloc(formats == format, .true., 1)))
    end function data_path

    pure function event_path(path) result(events)
        !! The file of a run's events: its data file, with `_events` before its ending.
        character(*), intent(in) :: path  !! as `data_path` has it
        character(:), allocatable :: events

        events = path_beside(path, "_events")
    end function event_path

    pure function path_beside(path, words) result(beside)
        !! `a_events.dat` of `a.dat` and `_events`.
        character(*), intent(in) :: path, words  !! as `data_path` has it; put before its ending
        character(:), allocatable :: beside
        integer :: dot

        dot = index(path, ".", back=.true.)
        beside = path(:dot - 1)//words//path(dot:)
    end function path_beside

    pure function scene_path(path) result(scene)
        !! The scene beside a data file whose format has no place for it: `a.csv.nml`.
        character(*), intent(in) :: path  !! of the data file
        character(:), allocatable :: scene

        scene = path//".nml"
    end function scene_path

    pure function script_path(path) result(script)
        !! The gnuplot script beside a data file: `a.gp` of `a.dat`, `a.csv.gp` of `a.csv`, so that
        !! no format writes over the script of another.
        character(*), intent(in) :: path  !! with or without an ending
        character(:), allocatable :: script
        integer :: dot

        dot = index(path, ".", back=.true.)
        if (dot <= index(path, "/", back=.true.)) dot = len(path) + 1
        if (any(path(dot:) == endings(2:))) dot = len(path) + 1
        script = path(:dot - 1)//".gp"
    end function script_path

    pure function film_path(path) result(film)
        !! The animation beside a data file.
        character(*), intent(in) :: path  !! with or without an ending
        character(:), allocatable :: film

        film = script_path(path)
        film = film(:len(film) - 2)//"html"
    end function film_path

    subroutine draw(path, kind, error)
        !! Let gnuplot draw the data file at `path`, as one of `pictures`; no shell is involved.
        !! It says nothing of a full disk, so its picture gets its name only if its end is there.
        character(*), intent(in) :: path, kind  !! its script lies beside it; of `pictures`
        type(error_t), allocatable, intent(out) :: error  !! gnuplot is missing or failed
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
        character(*), intent(in) :: path  !! of the picture
        character(*), intent(in) :: kind  !! of `pictures`
        logical :: ends_well
        character(6), parameter :: ends(3) = ["IEND  ", "</svg>", "%%EOF "]
        character(20) :: last
        integer :: unit, length, status

        ends_well = .false.
        open (newunit=unit, file=path, access="stream", form="unformatted", status="old", &
              action="read", iostat=status)
        if (status /= 0) return
        inquire (unit=unit, size=length)
        last = ""
        if (length > 0) read (unit, pos=max(1, length - len(last) + 1), iostat=status) &
            last(:min(len(last), length))
        close (unit)
        if (status /= 0) return
        ends_well = index(last, trim(ends(findloc(pictures == kind, .true., 1)))) > 0
    end function ends_well
end module lagrangia_data_files
