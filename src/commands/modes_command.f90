module lagrangia_modes_command
    !! `lagrangia modes SYSTEM`: small oscillations, LAPACK's answer beside the page's. A scene's
    !! name or path stands for its system.
    use lagrangia_changed_scene, only: make_own_name
    use lagrangia_command_line, only: command_line_t
    use lagrangia_console, only: note, put, put_line
    use lagrangia_data_files, only: data_path
    use lagrangia_degrees, only: degrees_in
    use lagrangia_description, only: description_t, figure_length
    use lagrangia_equilibrium, only: missed_text
    use lagrangia_errors, only: error_t, fail
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_kinds, only: dp, i8
    use lagrangia_mode_picture, only: has_positions, mode_picture_path, write_mode_picture
    use lagrangia_mode_script, only: part_of_modes
    use lagrangia_modes_files, only: claim_modes, prepare_modes, write_mode
    use lagrangia_modes_film, only: animate_modes
    use lagrangia_modes_page, only: print_modes, put_json
    use lagrangia_number_list, only: read_numbers
    use lagrangia_output_file, only: refuse_unwritable
    use lagrangia_output_options, only: is_told, show_picture, take_folder, take_picture
    use lagrangia_progress, only: progress_t
    use lagrangia_scene_keys, only: refuse_output
    use lagrangia_scene_reader, only: read_named_system
    use lagrangia_small_oscillations, only: find_modes, likely_equilibrium, modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: modes_command

    integer, parameter :: many = 300  !! more modes take a second and longer

contains

    subroutine modes_command(line, error)
        !! Find, print, and with `--output` write one data file a mode and their picture as the
        !! mechanism, which `--plot` lets gnuplot draw. Without `--at` another
        !! equilibrium that the page knows is shown as well.
        type(command_line_t), intent(in) :: line  !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(modes_t) :: modes, others
        type(progress_t) :: progress
        real(dp), allocatable :: at(:)
        character(:), allocatable :: advice, folder, kind, label, name, page, stem
        character(:), allocatable :: source, title, warning
        character(figure_length), allocatable :: figure(:)
        logical :: elsewhere
        integer :: j

        if (size(line%arguments) == 0) then
            call fail(error, "modes of what? 'lagrangia list systems' shows the names")
            return
        end if
        call take_folder(line, folder, error)
        if (allocated(error)) return
        call take_picture(line, kind, error)
        if (allocated(error)) return
        call read_named_system(line%arguments(1)%text, line%values_of("set"), system, error, &
                               figure, label, source)
        if (allocated(error)) return
        call system%describe(d)
        allocate (at, source=likely_equilibrium(system))
        if (line%has("at")) call read_numbers("--at", line%value_of("at", ""), at, error)
        if (allocated(error)) return
        if (line%has("plot") .and. .not. has_positions(system)) call fail(error, "no picture "// &
            "of the modes of "//trim(d%name)//": it does not say where its masses are (positions)")
        if (allocated(error)) return
        name = label
        call make_own_name(name, line%values_of("set"), (d%parameters%name), &
                           line%value_of("at", ""), title)
        stem = data_path(folder, name//"_modes.html", "text")
        page = stem
        stem = stem(:len(stem) - len("_modes.html"))
        if (line%has("output") .or. line%has("plot") .or. line%has("animate")) then
            call refuse_output(label, error)
            if (.not. allocated(error)) call claim_modes(system, stem, source, error)
            if (allocated(error)) return
        end if
        if (line%has("output") .or. line%has("plot")) then
            call prepare_modes(system, stem, warning, error)
            if (allocated(error)) return
            if (warning /= "" .and. .not. line%has("quiet")) call note(warning)
        end if
        if (line%has("animate")) call refuse_unwritable(page, error)
        if (allocated(error)) return
        if (system%ndof > many .and. .not. line%has("quiet")) call progress%say(trim(d%name)// &
            ": "//to_text(system%ndof)//" modes, some seconds")
        call find_modes(system, at, line%has("at"), modes, error)
        call progress%clear()
        if (allocated(error)) then
            if (allocated(error%key) .and. .not. line%has("at")) error%message = error%message// &
                "; '--at' says where, or equilibrium in &lagrangian"
            do j = 1, min(size(at), size(d%coordinates))
                advice = degrees_in(at(j:j), trim(d%coordinates(j)%unit))
                if (advice == "") cycle
                error%message = error%message//advice
                exit
            end do
            return
        end if
        if (d%named_in_scene .and. allocated(d%equilibrium) .and. .not. line%has("at") .and. &
            .not. line%has("quiet")) then
            if (missed_text(d, at, modes%at) /= "") call note(missed_text(d, at, modes%at))
        end if
        elsewhere = allocated(modes%analytic%elsewhere) .and. .not. line%has("at")
        if (elsewhere) call find_modes(system, modes%analytic%elsewhere, .true., others, error)
        if (allocated(error)) return
        if (line%has("json")) then
            call put_json(trim(d%name), system, modes)
            if (elsewhere) call put(', "elsewhere": ')
            if (elsewhere) call put_json(trim(d%name), system, others)
            call put_line(repeat("}", merge(2, 1, elsewhere)))
        else if (.not. line%has("quiet")) then
            call print_modes(system, modes)
            if (elsewhere) call put_line("")
            if (elsewhere) call print_modes(system, others)
        end if
        if (line%has("animate")) call animate_modes(system, figure, modes, page, title, error)
        if (line%has("animate") .and. is_told(line) .and. .not. allocated(error)) then
            call put_line("film: "//page)
        end if
        if (allocated(error)) return
        if (elsewhere .and. is_told(line) .and. (line%has("output") .or. line%has("plot") .or. &
                                                 line%has("animate"))) then
            call put_line("files are of the first equilibrium; those of the other: --at "// &
                          numbers_of(modes%analytic%elsewhere))
        end if
        if (.not. (line%has("output") .or. line%has("plot"))) return
        call progress%restart(line%arguments(1)%text, line%has("quiet"))
        do j = 1, size(modes%omega2)
            call write_mode(system, modes, j, stem, title, error)
            if (allocated(error) .or. interrupt_status() /= 0) exit
            call progress%tick(int(j, i8), size(modes%omega2, kind=i8))
        end do
        call progress%clear()
        if (allocated(error) .or. interrupt_status() /= 0) return
        if (is_told(line)) call put_line("data files and gnuplot scripts: "//folder)
        if (.not. has_positions(system)) return
        call write_mode_picture(system, figure, modes, stem, title, error)
        if (part_of_modes(modes) /= "" .and. is_told(line) .and. .not. allocated(error)) then
            call put_line("the picture has "//part_of_modes(modes))
        end if
        if (allocated(error) .or. .not. line%has("plot")) return
        call show_picture(mode_picture_path(stem), kind, line, error)
    end subroutine modes_command

    pure function numbers_of(at) result(text)
        !! As `--at` takes them.
        real(dp), intent(in) :: at(:)
        character(:), allocatable :: text
        integer :: i

        text = to_text(at(1))
        do i = 2, size(at)
            text = text//","//to_text(at(i))
        end do
    end function numbers_of
end module lagrangia_modes_command
