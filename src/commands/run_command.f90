module lagrangia_run_command
    !! `lagrangia` and `lagrangia run SCENE...`: scenes, their files, the scorecard.
    use lagrangia_animation, only: animate_scene
    use lagrangia_changed_scene, only: make_own_scene
    use lagrangia_command_line, only: command_line_t, word_t
    use lagrangia_console, only: note, put_line, put_lines
    use lagrangia_counted, only: counted
    use lagrangia_data_files, only: check_format, data_path, film_path, &
                                    picture_path, script_path
    use lagrangia_degrees, only: degrees_warning
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail, is_signal, status_not_held
    use lagrangia_final_values, only: final_values_legend, final_values_line
    use lagrangia_friction_warning, only: friction_warning
    use lagrangia_gnuplot, only: panel_t, series_t
    use lagrangia_json, only: json_line
    use lagrangia_kinds, only: i8
    use lagrangia_observer, only: observer_t
    use lagrangia_outcome, only: outcome_json, outcome_t
    use lagrangia_output_file, only: refuse_unwritable
    use lagrangia_output_options, only: draw_picture, take_folder, take_picture
    use lagrangia_overlay, only: add_to_overlay, common_panels, overlay_path, write_overlay
    use lagrangia_places, only: places_t
    use lagrangia_progress, only: progress_t
    use lagrangia_run_plan, only: new_run_plan, run_plan_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_claims, only: claim_files, claim_picture, claim_scene, size_warning
    use lagrangia_scene_reader, only: read_scene
    use lagrangia_scene_run, only: run_scene
    use lagrangia_scorecard, only: missed_text, scorecard_head, scorecard_legend, scorecard_lines, &
                                   scorecard_row
    use lagrangia_shipped, only: find_scene, shipped_scenes
    use lagrangia_step_warning, only: step_warning
    use lagrangia_system, only: system_t
    use lagrangia_version, only: is_optimised
    implicit none (type, external)
    private
    public :: choose_scenes, chosen_t, run_command

    type :: chosen_t
        !! One scene of the run, read, planned and found good.
        type(word_t) :: path
        type(run_plan_t) :: plan
    end type chosen_t

    character(*), parameter :: overlay = "overlay"  !! the picture of `--overlay`

contains

    subroutine run_command(line, error)
        !! Read and plan all scenes before any of them runs; then run them, a row each. A scene
        !! that fails does not keep the others from running; the exit status is that of the first
        !! failure.
        type(command_line_t), intent(in) :: line  !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(error_t), allocatable :: scene_error
        type(chosen_t), allocatable :: chosen(:)
        type(progress_t), target :: progress  !! of one scene
        type(progress_t) :: whole             !! of all, between two of them
        class(observer_t), pointer :: observer
        type(outcome_t) :: outcome
        character(:), allocatable :: folder, format, kind
        type(word_t), allocatable :: lines(:), remarks(:), warnings(:)
        logical :: json, quiet, stated, written
        integer :: i, k, missed

        json = line%has("json")
        quiet = line%has("quiet")
        format = line%value_of("format", "text")
        call check_format(format, error)
        if (allocated(error)) return
        call take_folder(line, folder, error)
        if (allocated(error)) return
        call take_picture(line, kind, error)
        if (allocated(error)) return
        allocate (chosen(0))  ! gfortran 12 would warn of its bounds
        call choose_scenes(line, folder, format, chosen, error)
        if (allocated(error)) return
        if (.not. (is_optimised() .or. quiet)) call note("this build is not optimised; "// &
            "'fpm run --profile release' is several times faster")

        observer => progress
        call whole%restart("the run of "//counted(size(chosen), "scene"), quiet)
        missed = 0
        allocate (remarks(2*size(chosen)))
        stated = .false.
        written = .false.
        allocate (warnings(size(chosen)))
        do i = 1, size(chosen)
            call warn(chosen(i), folder, format, quiet, warnings(i)%text)
        end do
        if (json) then
            call put_line("[")
        else if (.not. quiet) then
            call put_line(scorecard_head())
        end if
        do i = 1, size(chosen)
            if (i > 1) call whole%tick(int(i - 1, i8), size(chosen, kind=i8))
            call run_one(chosen(i)%plan, warnings(i)%text, scene_error)
            call progress%clear()
            call whole%clear()
            if (allocated(scene_error)) then
                if (is_signal(scene_error)) then
                    call move_alloc(scene_error, error)
                    return
                end if
                call scene_error%add_context(chosen(i)%path%text)
            end if
            if (json) then
                call put_line(json_line(outcome_json(outcome), i < size(chosen)))
            else if (.not. quiet) then
                call put_lines(scorecard_row(outcome)//new_line("a"))
                call scorecard_lines(outcome, line%command /= "", lines)
                do k = 1, size(lines)
                    call put_line(lines(k)%text)
                end do
                if (allocated(outcome%state)) call put_line("    at the end: "// &
                                                            final_values_line(outcome%state))
                stated = stated .or. allocated(outcome%state)
            end if
            if (outcome%choice /= "") remarks(2*i - 1)%text = outcome%choice
            if (outcome%remark /= "") remarks(2*i)%text = counted(outcome%steps, "step")// &
                                                          outcome%remark
            if (allocated(scene_error)) then
                call note(scene_error%message)
                if (.not. allocated(error)) call fail(error, "", scene_error%status)
            else if (.not. outcome%holds()) then
                missed = missed + 1
            end if
        end do
        do i = 1, size(remarks)  ! they would tear the table apart
            if (.not. allocated(remarks(i)%text) .or. quiet) cycle
            call note(chosen((i + 1)/2)%path%text//": "//remarks(i)%text)
        end do
        if (line%has("overlay") .and. .not. allocated(error)) call overlay_runs(chosen, folder, &
            kind, line%has("plot"), quiet, error)
        if (json) then
            call put_line("]")
        else if (.not. quiet) then
            call put_line("")
            call put_lines(scorecard_legend)
            if (line%command == "") call put_line("'lagrangia run NAME' says more: steps, "// &
                                                  "period, omega")
            if (stated) call put_lines(final_values_legend)
            if (written) call put_line(files_line(line)//": "//folder)
            if (line%has("overlay") .and. .not. allocated(error)) call put_line( &
                "all in one picture: "//overlay_file(folder, kind, line%has("plot")))
        end if
        if (missed > 0 .and. .not. allocated(error)) call fail(error, missed_text(missed, &
            size(chosen)), status_not_held)
    contains
        subroutine run_one(plan, warning, error)
            type(run_plan_t), intent(inout) :: plan
            character(*), intent(in) :: warning
            type(error_t), allocatable, intent(out) :: error

            call progress%restart(trim(plan%scene%name), quiet)
            call run_scene(plan, folder, format, observer, outcome, error)
            outcome%warning = warning
            written = written .or. outcome%file /= "" .or. outcome%events /= ""
            if (.not. allocated(error) .and. line%has("animate")) call animate_scene(plan, &
                outcome%file, error)
            if (allocated(error) .or. .not. line%has("plot")) return
            call draw_picture(outcome%file, kind, line%has("quiet"), error)
            if (allocated(error) .or. .not. outcome%draws_events) return
            call draw_picture(outcome%events, kind, line%has("quiet"), error)
        end subroutine run_one
    end subroutine run_command

    pure function files_line(line) result(text)
        !! What lies in the folder.
        type(command_line_t), intent(in) :: line
        character(:), allocatable :: text

        text = "data files and gnuplot scripts"
        if (line%has("plot")) text = "data files, gnuplot scripts and pictures"
        if (line%has("animate")) text = "data files, gnuplot scripts and films"
        if (line%has("plot") .and. line%has("animate")) then
            text = "data files, gnuplot scripts, pictures and films"
        end if
    end function files_line

    pure function overlay_file(folder, kind, drawn) result(path)
        !! The picture of all runs, or the script that draws it.
        character(*), intent(in) :: folder, kind
        logical, intent(in) :: drawn
        character(:), allocatable :: path

        path = script_path(overlay_path(folder, overlay))
        if (drawn) path = picture_path(overlay_path(folder, overlay), kind)
    end function overlay_file

    subroutine warn(one, folder, format, quiet, text)
        !! What is to be known of a scene before it runs.
        type(chosen_t), intent(in) :: one
        character(*), intent(in) :: folder, format
        logical, intent(in) :: quiet
        character(:), allocatable, intent(out) :: text  !! `; ` between two; "": nothing
        type(word_t) :: parts(5)
        integer :: i

        parts(1)%text = ""
        if (allocated(one%plan%scene%warning)) parts(1)%text = one%plan%scene%warning
        parts(2)%text = step_warning(one%plan%scene, one%plan%system)
        parts(3)%text = size_warning(one%plan%scene, folder, format)
        parts(4)%text = degrees_warning(one%plan%scene, one%plan%system)
        parts(5)%text = friction_warning(one%plan%system)
        text = ""
        do i = 1, size(parts)
            if (parts(i)%text == "") cycle
            if (.not. quiet) call note(one%path%text//": "//parts(i)%text)
            if (text /= "") text = text//"; "
            text = text//parts(i)%text
        end do
    end subroutine warn

    subroutine check_overlay(scenes, folder, places, error)
        !! Fails where `--overlay` has too little to draw, or nowhere to write.
        integer, intent(in) :: scenes
        character(*), intent(in) :: folder
        type(places_t), intent(inout) :: places  !! all files of the scenes
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: path

        if (scenes < 2) call fail(error, "--overlay: two scenes at least are needed, to be "// &
                                  "drawn in one picture")
        if (allocated(error)) return
        path = overlay_path(folder, overlay)
        call claim_picture(path, "overlay", "", places, error)
        if (.not. allocated(error)) call refuse_unwritable(script_path(path), error)
    end subroutine check_overlay

    subroutine overlay_runs(chosen, folder, kind, drawn, quiet, error)
        !! The picture of all runs, `overlay.gp` in the folder.
        type(chosen_t), intent(in) :: chosen(:)
        character(*), intent(in) :: folder, kind
        logical, intent(in) :: drawn, quiet
        type(error_t), allocatable, intent(out) :: error
        type(series_t), allocatable :: series(:)
        type(panel_t), allocatable :: panels(:)
        character(:), allocatable :: left_out, title
        integer :: i

        allocate (series(size(chosen)))
        title = ""
        do i = 1, size(chosen)
            associate (plan => chosen(i)%plan)
                call add_to_overlay(series(i), plan%record%table%file%name(), &
                                    overlay_path(folder, overlay), plan%record, &
                                    trim(plan%scene%name)//" ("//trim(plan%settled%method)//")")
                if (i > 1) title = title//", "
                title = title//trim(plan%scene%name)
            end associate
        end do
        call common_panels(series, panels, "time", left_out, error)
        if (allocated(error)) return
        if (left_out /= "" .and. .not. quiet) then
            call note("the picture of all runs has no room for "//left_out)
        end if
        call write_overlay(folder, overlay, series, panels, title, "", error)
        if (allocated(error) .or. .not. drawn) return
        call draw_picture(overlay_path(folder, overlay), kind, quiet, error)
    end subroutine overlay_runs

    subroutine choose_scenes(line, folder, format, chosen, error, page)
        !! The named scenes or all; every one is read and planned, once, and all files of the run
        !! are compared, so that nothing runs if one is wrong or a file would be lost.
        type(command_line_t), intent(in) :: line  !! what was typed
        character(*), intent(in) :: folder, format  !! of the data files
        type(chosen_t), allocatable, intent(out) :: chosen(:)  !! ready to run
        type(error_t), allocatable, intent(out) :: error  !! names the scene
        character(*), intent(in), optional :: page  !! a file beside theirs
        type(places_t) :: places
        type(word_t), allocatable :: paths(:)
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(description_t) :: d
        integer :: i, turn

        if (line%command == "" .or. (present(page) .and. size(line%arguments) == 0)) then
            call shipped_scenes(paths)
        else if (size(line%arguments) == 0) then
            call fail(error, "run what? 'lagrangia list scenes' shows the names; a path ends "// &
                      "in .nml")
        else
            allocate (paths(size(line%arguments)))
            do i = 1, size(paths)
                call find_scene(line%arguments(i)%text, paths(i)%text, error)
                if (allocated(error)) return
            end do
        end if
        if (allocated(error)) return
        allocate (chosen(size(paths)))
        do turn = 1, 2  ! what is read comes before what is written
            if (turn == 2 .and. present(page)) call places%add(page, "report", "", error)
            if (allocated(error)) return
            do i = 1, size(paths)
                if (turn == 1) then
                    chosen(i)%path = paths(i)
                    call read_scene(paths(i)%text, line%values_of("set"), scene, system, error)
                    if (allocated(error)) return
                    call system%describe(d)
                    call make_own_scene(scene, line%values_of("set"), (d%parameters%name))
                    scene%error_estimate = scene%error_estimate .or. line%has("error-estimate")
                    call new_run_plan(chosen(i)%plan, scene, system, error)
                    if (allocated(error)) return
                    call claim_scene(scene, places, error)
                    if (allocated(error)) call fail(error, "this scene is given twice")
                else
                    call claim_files(chosen(i)%plan%scene, chosen(i)%plan%system, folder, format, &
                                     places, error)
                    if (line%has("animate") .and. .not. allocated(error)) call refuse_unwritable( &
                        film_path(data_path(folder, trim(chosen(i)%plan%scene%output), format)), &
                        error)
                end if
                if (allocated(error)) then
                    call error%add_context(paths(i)%text)
                    return
                end if
            end do
        end do
        if (line%has("overlay")) call check_overlay(size(chosen), folder, places, error)
    end subroutine choose_scenes
end module lagrangia_run_command
