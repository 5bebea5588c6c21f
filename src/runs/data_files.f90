module lagrangia_data_files
    !! Data files by their format: their names, and those of the scripts and films beside them.
    use lagrangia_changed_scene, only: ending_start
    use lagrangia_csv_table, only: csv_table_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_names, only: advice, nearest_name
    use lagrangia_npy, only: npy_table_t
    use lagrangia_table, only: table_t
    use lagrangia_text, only: join, lower, quoted
    use lagrangia_text_table, only: text_table_t
    implicit none (type, external)
    private
    public :: check_format, check_picture, data_path, event_path, film_path, new_table
    public :: path_beside, picture_advice, picture_path, scene_path, script_path
    public :: film_kinds, formats, pictures

    character(4), parameter :: formats(3) = ["text", "csv ", "npy "]
    character(3), parameter :: pictures(3) = ["png", "svg", "pdf"]  !! what `draw` makes
    character(4), parameter :: endings(3) = [".dat", ".csv", ".npy"]
    character(4), parameter :: other_pictures(9) = [character(4) :: "gif", "jpg", "jpeg", "eps", &
        "ps", "tif", "tiff", "bmp", "webp"]  !! that `draw` does not make
    character(4), parameter :: film_kinds(5) = [character(4) :: "gif", "mp4", "avi", "mov", "webm"]

contains

    pure subroutine check_format(format, error)
        !! Refuse a format that does not exist.
        character(*), intent(in) :: format  !! a word of the command line
        type(error_t), allocatable, intent(out) :: error  !! names those that exist
        character(:), allocatable :: meant

        if (any(formats == format)) return
        meant = format
        select case (lower(format))
        case ("dat", "txt", "ascii", "gnuplot"); meant = "text"
        case ("excel", "xls", "xlsx"); meant = "csv"
        case ("numpy"); meant = "npy"
        case default
        end select
        call fail(error, "unknown format "//quoted(format)//"; "//advice(meant, formats))
    end subroutine check_format

    pure subroutine check_picture(kind, error)
        !! Refuse a picture format that does not exist.
        character(*), intent(in) :: kind  !! a word of the command line
        type(error_t), allocatable, intent(out) :: error  !! names those that exist

        if (any(pictures == kind)) return
        if (picture_advice(lower(kind)) /= "") then
            call fail(error, "unknown picture format "//quoted(kind)//"; there are "// &
                      picture_advice(lower(kind)))
        else if (nearest_name(kind, pictures) /= "") then
            call fail(error, "unknown picture format "//quoted(kind)//"; "//advice(kind, pictures))
        else
            call fail(error, "unknown picture format "//quoted(kind)//"; there are "// &
                      join(pictures, ", ")//"; the scene's key 'plot' says which columns are drawn")
        end if
    end subroutine check_picture

    pure function picture_advice(kind) result(text)
        !! The formats that there are, of one that other programs draw; else empty.
        character(*), intent(in) :: kind  !! in small letters
        character(:), allocatable :: text

        text = ""
        if (any(other_pictures == kind)) text = join(pictures, ", ")
        if (any(film_kinds == kind)) text = join(pictures, ", ")// &
            "; '--animate' writes a film as an HTML page"
    end function picture_advice

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

        dot = ending_start(path)
        beside = path(:dot - 1)//words//path(dot:)
    end function path_beside

    pure function scene_path(path) result(scene)
        !! The scene beside a data file whose format has no place for it: `a.csv.nml`.
        character(*), intent(in) :: path  !! of the data file
        character(:), allocatable :: scene

        scene = path//".nml"
    end function scene_path

    pure function script_path(path) result(script)
        !! The gnuplot script beside a data file: `a.gp` of `a.dat`, `a.csv.gp` of `a.csv` and
        !! `a.v2.gp` of `a.v2`, so that none writes over the script of another.
        character(*), intent(in) :: path  !! with or without an ending
        character(:), allocatable :: script
        integer :: dot

        dot = max(1, index(path, ".", back=.true.))
        if (path(dot:) /= endings(1)) dot = len(path) + 1
        script = path(:dot - 1)//".gp"
    end function script_path

    pure function picture_path(path, kind) result(picture)
        !! The picture that gnuplot draws of a data file.
        character(*), intent(in) :: path  !! of the data file
        character(*), intent(in) :: kind  !! of `pictures`
        character(:), allocatable :: picture

        picture = script_path(path)
        picture = picture(:len(picture) - len("gp"))//kind
    end function picture_path

    pure function film_path(path) result(film)
        !! The animation beside a data file.
        character(*), intent(in) :: path  !! with or without an ending
        character(:), allocatable :: film

        film = script_path(path)
        film = film(:len(film) - 2)//"html"
    end function film_path
end module lagrangia_data_files
