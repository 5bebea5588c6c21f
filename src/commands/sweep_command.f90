module lagrangia_sweep_command
    !! `lagrangia sweep SCENE`: many trajectories of a scene, and a number or more of each.
    use lagrangia_changed_scene, only: make_own_sweep
    use lagrangia_command_line, only: command_line_t, word_t
    use lagrangia_console, only: note
    use lagrangia_data_files, only: check_format, data_path, path_beside, scene_path, script_path
    use lagrangia_degrees, only: degrees_in
    use lagrangia_description, only: description_t
    use lagrangia_disk_space, only: free_space, short, space_warning
    use lagrangia_errors, only: error_t, fail, status_file, status_library
    use lagrangia_files, only: facts_t, look_at
    use lagrangia_images, only: image_number
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_kinds, only: dp, i8
    use lagrangia_namelist, only: has_key, refuse_value
    use lagrangia_number_reader, only: to_integer
    use lagrangia_number_text, only: field_width
    use lagrangia_observer, only: observer_t
    use lagrangia_output_file, only: output_file_t
    use lagrangia_output_options, only: show_picture, take_folder, take_picture
    use lagrangia_places, only: places_t
    use lagrangia_progress, only: progress_t
    use lagrangia_resources, only: check_memory
    use lagrangia_scene, only: scene_t, sweep_text_length
    use lagrangia_scene_claims, only: claim_scene, claim_table
    use lagrangia_scene_keys, only: refuse_output
    use lagrangia_scene_reader, only: read_scene, read_unchanged
    use lagrangia_shipped, only: find_sweep
    use lagrangia_sweep, only: new_sweep, sweep_t
    use lagrangia_sweep_files, only: sweep_header, write_sweep
    use lagrangia_sweep_grid, only: block_size, compute_grid, most_threads, &
                                    parts_a_trajectory, sweep_result_t, thread_count
    use lagrangia_sweep_group, only: sweep_lines
    use lagrangia_sweep_store, only: part_name
    use lagrangia_sweep_summary, only: put_json, put_summary
    use lagrangia_sweep_warning, only: corner_warning
    use lagrangia_system, only: system_t
    use lagrangia_text, only: quoted, to_text
    implicit none (type, external)
    private
    public :: sweep_command

contains

    subroutine sweep_command(line, error)
        !! Read the scene and its group `&sweep`, what the command line says instead, compute,
        !! write, and say what came out.
        type(command_line_t), intent(in) :: line          !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(scene_t) :: file, scene
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(sweep_t) :: sweep
        type(sweep_result_t) :: result
        type(progress_t), target :: progress
        class(observer_t), pointer :: observer
        character(:), allocatable :: folder, format, kind, path, warning
        integer :: threads
        logical :: quiet

        quiet = line%has("quiet") .or. image_number() > 1

        if (size(line%arguments) == 0) then
            call fail(error, "sweep what? 'lagrangia list sweeps' shows the names; a path ends "// &
                      "in .nml")
            return
        end if
        format = line%value_of("format", "text")
        call check_format(format, error)
        if (allocated(error)) return
        call take_picture(line, kind, error)
        if (.not. allocated(error)) call take_folder(line, folder, error)
        if (allocated(error)) return
        call find_sweep(line%arguments(1)%text, path, error)
        if (.not. allocated(error)) call read_scene(path, line%values_of("set"), scene, system, &
                                                    error)
        if (.not. allocated(error)) call read_unchanged(scene, file)
        if (.not. allocated(error)) then
            call system%describe(d)
            call take_options(line, axis_example(scene, system, d), scene, error)
        end if
        if (.not. allocated(error)) call make_own_sweep(scene, file, line%values_of("set"), &
                                                        (d%parameters%name))
        if (.not. allocated(error)) call plan(line, scene, system, sweep, error)
        if (.not. allocated(error)) call claim(scene, folder, format, path, error)
        if (allocated(error) .and. image_number() > 1) error%message = ""  ! image 1 has said it
        if (allocated(error)) return
        threads = thread_count(scene%sweep%threads)
        call check_size(sweep, threads, folder, format, line, quiet, error)
        if (allocated(error)) return

        nullify (observer)
        if (image_number() == 1) observer => progress
        if (image_number() == 1 .and. .not. quiet) call warn_of_degrees(sweep)
        if (.not. quiet) then
            warning = corner_warning(sweep)
            if (warning /= "") call note(warning)
        end if
        call progress%restart(trim(scene%name), quiet, "trajectories", parts_a_trajectory)
        call compute_grid(sweep, threads, observer, result, error, path, &
                          all_lines(sweep_header(sweep, sweep_lines(scene%sweep))), &
                          line%has("resume"))
        call progress%clear()
        if (allocated(error)) then
            call leave(result, path, error)
        else if (image_number() == 1) then
            call write_sweep(sweep, result, path, format, sweep_lines(scene%sweep), error, &
                             scene)
            if (allocated(error)) error%message = error%message//"; all trajectories are kept "// &
                "in '"//part_name(path, 1)//"', '--resume' goes on"
        end if
        if (allocated(error) .or. image_number() > 1) return
        call result%store%remove()
        if (allocated(result%damage) .and. .not. quiet) call note(result%damage)
        if (allocated(result%reason) .and. .not. quiet) call note( &
            to_text(result%failures)//" of "//to_text(sweep%trajectories())// &
            " trajectories failed and are NaN; the first: "//result%reason)
        if (line%has("json")) then
            call put_json(sweep, result, path)
        else if (.not. quiet) then
            call put_summary(sweep, result, path)
        end if
        if (line%has("plot")) call show_picture(path, kind, line, error)
    end subroutine sweep_command

    subroutine warn_of_degrees(sweep)
        !! An axis of angles that are typed as degrees is computed as it is typed, and announced.
        type(sweep_t), intent(in) :: sweep
        character(:), allocatable :: advice
        integer :: i

        do i = 1, size(sweep%axes)
            associate (axis => sweep%axes(i))
                advice = degrees_in(axis%ends, trim(axis%unit))
                if (advice /= "") call note("the axis "//trim(axis%name)//" is in rad"//advice)
            end associate
        end do
    end subroutine warn_of_degrees

    subroutine leave(result, path, error)
        !! What is complete stays, if there is any; who interrupts a sweep is told, and whose memory
        !! was not enough.
        type(sweep_result_t), intent(inout) :: result
        character(*), intent(in) :: path
        type(error_t), intent(inout) :: error

        call result%store%release()
        if (result%store%there == 0 .or. result%store%there == result%store%blocks) then
            call result%store%remove()
            if (error%status == interrupt_status() .and. result%store%there == 0) error%message = &
                error%message//" before the first block of trajectories was complete: none is kept"
        else if (any(error%status == [interrupt_status(), status_file, status_library])) then
            error%message = error%message//": "//to_text(result%store%trajectories_there())// &
                " trajectories are kept in '"//part_name(path, image_number())// &
                "', '--resume' goes on"
        end if
    end subroutine leave

    pure function all_lines(lines) result(text)
        !! As one text.
        character(*), intent(in) :: lines(:)
        character(:), allocatable :: text
        integer :: i

        text = ""
        do i = 1, size(lines)
            text = text//trim(lines(i))//new_line("a")
        end do
    end function all_lines

    subroutine check_size(sweep, threads, folder, format, line, quiet, error)
        !! Refuse what the memory or the disk cannot hold, the latter unless told otherwise.
        type(sweep_t), intent(in) :: sweep
        integer, intent(in) :: threads
        character(*), intent(in) :: folder, format
        type(command_line_t), intent(in) :: line
        logical, intent(in) :: quiet
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: warning
        real(dp) :: blocks, disk, free, memory, rows, total

        total = real(sweep%trajectories(), dp)
        rows = total*sweep%points
        disk = 8.0_dp*total*sweep%width() + &
               rows*(size(sweep%axes) + size(sweep%kept))*merge(8, field_width + 1, format == "npy")
        blocks = max(1.0_dp, total/block_size(sweep))
        memory = 12.0_dp*blocks + 16.0_dp*real(block_size(sweep), dp)*sweep%width()* &
                 (min(blocks, real(threads, dp)) + 1.0_dp) + &
                 8.0_dp*sum(sweep%axes%count, sweep%axes%random)
        call check_memory(memory, "a sweep of "//to_text(sweep%trajectories())//" trajectories", &
                          error)
        if (allocated(error) .or. image_number() > 1 .or. line%has("resume")) return
        free = free_space(folder)
        if (free > 0.0_dp .and. disk > free .and. .not. line%has("any-size")) then
            call fail(error, to_text(sweep%trajectories())//" trajectories take up to "// &
                      short(disk)//" on the disk and "//short(memory)//" of memory, and only "// &
                      short(free)//" are free in '"//folder//"'; '--any-size' begins all the same")
            return
        end if
        warning = space_warning(disk, folder)
        if (warning /= "" .and. .not. quiet) call note(warning)
    end subroutine check_size

    pure function axis_example(scene, system, d) result(name)
        !! What `--over NAME=0.1:3:50` may change: a coordinate that no constraint holds there, or
        !! else a parameter.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        type(description_t), intent(in) :: d  !! of the system
        character(:), allocatable :: name
        type(error_t), allocatable :: held
        real(dp) :: q(system%ndof)
        integer :: i

        do i = 1, system%ndof
            name = trim(d%coordinates(i)%name)
            q = scene%q
            q(i) = 0.1_dp
            call system%check_places(scene%t0, q, held)
            q(i) = 3.0_dp
            if (.not. allocated(held)) call system%check_places(scene%t0, q, held)
            if (.not. allocated(held)) return
        end do
        if (size(d%parameters) > 0) name = trim(d%parameters(1)%name)
    end function axis_example

    subroutine take_options(line, example, scene, error)
        !! What the command line says in the place of `&sweep`.
        type(command_line_t), intent(in) :: line
        character(*), intent(in) :: example  !! of an axis, for remedies
        type(scene_t), intent(inout) :: scene
        type(error_t), allocatable, intent(out) :: error

        call take_texts("over", "", scene%sweep%over)
        if (.not. allocated(error)) call take_texts("keep", ",", scene%sweep%keep)
        if (.not. allocated(error)) call take_number("seed", -huge(0), huge(0), &
                                                   scene%sweep%seed)
        if (.not. allocated(error)) call take_number("threads", 1, most_threads, &
                                                   scene%sweep%threads)
        if (allocated(error)) return
        if (size(scene%sweep%over) == 0) then
            call fail(error, "sweep over what? '--over "//example//"=0.1:3:50', or over = '"// &
                      example//" = 0.1:3:50' in the group &sweep of the scene")
        else if (size(scene%sweep%keep) == 0) then
            call fail(error, "keep what of each trajectory? '--keep period', a column, "// &
                      "'--keep ""max COLUMN""'; or keep = 'period' in the group &sweep of "// &
                      "the scene")
        end if
    contains
        subroutine take_texts(name, separator, texts)
            character(*), intent(in) :: name, separator
            character(sweep_text_length), allocatable, intent(inout) :: texts(:)
            type(word_t), allocatable :: words(:)
            character(:), allocatable :: rest
            integer :: i, last

            if (.not. line%has(name)) return
            words = line%values_of(name)
            texts = texts(:0)
            do i = 1, size(words)
                rest = words(i)%text
                do
                    last = scan(rest, separator) - 1
                    if (last < 0) last = len(rest)
                    if (len_trim(rest(:last)) > len(texts)) then
                        call fail(error, "option '--"//name//"': a text of at most "// &
                                  to_text(len(texts))//" characters is needed")
                        return
                    end if
                    texts = [character(sweep_text_length) :: texts, rest(:last)]
                    if (last == len(rest)) exit
                    rest = rest(last + 2:)
                end do
            end do
        end subroutine take_texts

        subroutine take_number(name, least, most, number)
            character(*), intent(in) :: name
            integer, intent(in) :: least, most
            integer, intent(inout) :: number
            character(:), allocatable :: problem
            integer(i8) :: given

            if (.not. line%has(name)) return
            call to_integer(line%value_of(name, ""), given, problem)
            if (problem == "" .and. given >= least .and. given <= most) then
                number = int(given)
                return
            end if
            if (problem == "") then
                problem = "a number from "//to_text(least)//" to "//to_text(most)//" is needed"
            else
                problem = "a whole number is needed, as in --"//name//" 4"
            end if
            if (name == "threads") problem = problem//"; without the option there is a process "// &
                "for each processor"
            call fail(error, "option '--"//name//"' "//quoted(line%value_of(name, ""))//": "// &
                      problem)
        end subroutine take_number
    end subroutine take_options

    subroutine plan(line, scene, system, sweep, error)
        !! The sweep; what is refused is refused where it stands in the file, if it stands there.
        type(command_line_t), intent(in) :: line
        type(scene_t), intent(inout) :: scene
        class(system_t), intent(in) :: system
        type(sweep_t), intent(out) :: sweep
        type(error_t), allocatable, intent(out) :: error
        type(error_t), allocatable :: located

        call new_sweep(sweep, scene, system, scene%sweep%over, scene%sweep%keep, &
                       scene%sweep%seed, scene%sweep%after, error)
        if (.not. allocated(error)) return
        if (.not. (allocated(error%key) .and. allocated(scene%file))) return
        if (line%has(error%key) .or. .not. has_key(scene%file, "sweep", error%key)) return
        call refuse_value(scene%file, "sweep", error%key, error%message, located, error%element)
        call move_alloc(located, error)
    end subroutine plan

    subroutine claim(scene, folder, format, path, error)
        !! Where the data go; not over the scene itself.
        type(scene_t), intent(in) :: scene
        character(*), intent(in) :: folder, format
        character(:), allocatable, intent(out) :: path
        type(error_t), allocatable, intent(out) :: error
        type(places_t) :: places

        path = path_beside(data_path(folder, trim(scene%output), format), "_sweep")
        call refuse_output(scene%output, error)
        if (.not. allocated(error)) call claim_scene(scene, places, error)
        if (.not. allocated(error)) call claim_table(path, "sweep", trim(scene%name), places, error)
        if (.not. allocated(error)) call places%add(part_name(path, 1), "part of the sweep file", &
                                                    trim(scene%name), error)
        if (allocated(error) .or. image_number() > 1) return
        call check_place(path, error)
        if (.not. allocated(error)) call check_place(script_path(path), error)
        if (format == "text" .or. allocated(error)) return
        call check_place(scene_path(path), error)
    end subroutine claim

    subroutine check_place(path, error)
        !! What has the name of a file that is to be written can be replaced: after hours of
        !! computing it would be too late to find out.
        character(*), intent(in) :: path
        type(error_t), allocatable, intent(out) :: error
        type(facts_t) :: facts
        type(output_file_t) :: file

        facts = look_at(path)
        if (.not. facts%found) return
        call file%open(path, error)
        call file%abandon()
    end subroutine check_place
end module lagrangia_sweep_command
