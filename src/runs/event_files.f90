module lagrangia_event_files
    !! The file of a scene's events, and the script that draws them as dots.
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_event_record, only: event_record_t
    use lagrangia_events, only: event_box_t
    use lagrangia_gnuplot, only: dots, gnuplot_script, panel_t
    use lagrangia_output_file, only: output_file_t
    use lagrangia_scene, only: scene_line_length, scene_lines, scene_t
    use lagrangia_scene_files, only: data_path, new_table, script_path, send_header
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_version, only: build_text, version
    implicit none (type, external)
    private
    public :: event_path, open_event_file, finish_event_file

contains

    pure function event_path(scene, folder, format) result(path)
        !! The scene's data file, with `_events` before its ending.
        type(scene_t), intent(in) :: scene
        character(*), intent(in) :: folder, format
        character(:), allocatable :: path
        integer :: dot

        path = data_path(folder, trim(scene%output), format)
        dot = index(path, ".", back=.true.)
        path = path(:dot - 1)//"_events"//path(dot:)
    end function event_path

    subroutine open_event_file(scene, system, folder, format, events, record, error)
        !! Under a temporary name until `finish_event_file`.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        character(*), intent(in) :: folder, format
        type(event_box_t), intent(in) :: events(:)
        type(event_record_t), intent(inout) :: record
        type(error_t), allocatable, intent(out) :: error
        character(scene_line_length), allocatable :: header(:)
        type(description_t) :: d
        integer :: i, n

        call new_table(format, record%table)
        call record%table%file%open(event_path(scene, folder, format), error)
        if (allocated(error)) return
        call system%describe(d)
        header = [character(scene_line_length) :: "lagrangia "//version//": "//scene%title, &
                  scene_lines(scene, d), "build: "//build_text()]
        do i = 1, size(events)
            header = [character(scene_line_length) :: header, &
                      "event "//to_text(i)//": "//events(i)%item%label]
        end do
        n = size(record%columns%items)
        call record%table%begin(header, [character(name_length) :: record%columns%names(n), &
                                         "event"], &
                                [character(16) :: record%columns%units(n), "1"], error)
        call send_header(record%table, error)
    end subroutine open_event_file

    subroutine finish_event_file(scene, folder, format, record, panels, script, drawn, error)
        !! Complete the file; with more than one row, a script too. `commit_files` names them.
        type(scene_t), intent(in) :: scene
        character(*), intent(in) :: folder, format
        type(event_record_t), intent(inout) :: record
        type(panel_t), intent(in) :: panels(:)
        type(output_file_t), intent(inout) :: script
        character(:), allocatable, intent(out) :: drawn  !! the data file, if it has a script
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: path
        integer :: n

        drawn = ""
        if (.not. allocated(record%table)) return
        call record%table%finish("events: "//to_text(record%rows), error)
        if (allocated(error)) return
        path = event_path(scene, folder, format)
        if (record%rows < 2 .or. size(panels) == 0) return
        n = size(record%columns%items)
        call script%open(script_path(path), error)
        if (allocated(error)) return
        call script%write(gnuplot_script( &
            path(index(path, "/", back=.true.) + 1:), record%table%reading(), &
            trim(scene%title)//": events", record%columns%names(n), record%columns%units(n), &
            record%low, record%high, panels, dots))
        call script%complete(error)
        if (.not. allocated(error)) drawn = path
    end subroutine finish_event_file
end module lagrangia_event_files
