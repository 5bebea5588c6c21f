module lagrangia_output_options
    !! What commands that write files have in common: `--output`, `--plot`, and how it is drawn.
    use lagrangia_command_line, only: command_line_t
    use lagrangia_console, only: put_line
    use lagrangia_data_files, only: check_picture, picture_path
    use lagrangia_drawing, only: draw
    use lagrangia_errors, only: error_t, fail
    use lagrangia_progress, only: progress_t
    implicit none (type, external)
    private
    public :: draw_picture, is_told, show_picture, take_folder, take_picture

contains

    pure subroutine take_folder(line, folder, error)
        !! Where files go.
        type(command_line_t), intent(in) :: line            !! what was typed
        character(:), allocatable, intent(out) :: folder    !! `--output`, or data/output
        type(error_t), allocatable, intent(out) :: error    !! it is empty

        folder = line%value_of("output", "data/output")
        if (folder == "") call fail(error, "option '--output' needs the name of a folder")
    end subroutine take_folder

    pure subroutine take_picture(line, kind, error)
        !! What `--plot` draws, whether it was given or not.
        type(command_line_t), intent(in) :: line            !! what was typed
        character(:), allocatable, intent(out) :: kind      !! of `pictures`; without a value png
        type(error_t), allocatable, intent(out) :: error    !! there is no such format

        kind = line%value_of("plot", "png")
        if (kind == "") kind = "png"
        call check_picture(kind, error)
    end subroutine take_picture

    subroutine draw_picture(path, kind, quiet, error)
        !! Let gnuplot draw, and show on a terminal how far it is.
        character(*), intent(in) :: path, kind  !! as `draw` takes them
        logical, intent(in) :: quiet            !! show nothing
        type(error_t), allocatable, intent(out) :: error  !! as that of `draw`
        type(progress_t) :: progress

        call progress%restart("drawing", quiet)
        call draw(path, kind, error, progress)
        call progress%clear()
    end subroutine draw_picture

    subroutine show_picture(path, kind, line, error)
        !! The same, and say where the picture is.
        character(*), intent(in) :: path, kind  !! as `draw` takes them
        type(command_line_t), intent(in) :: line  !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! as that of `draw`

        call draw_picture(path, kind, line%has("quiet"), error)
        if (is_told(line) .and. .not. allocated(error)) call put_line("picture: "// &
            picture_path(path, kind))
    end subroutine show_picture

    pure function is_told(line) result(yes)
        !! The output is for people.
        type(command_line_t), intent(in) :: line  !! what was typed
        logical :: yes

        yes = .not. (line%has("json") .or. line%has("quiet"))
    end function is_told
end module lagrangia_output_options
