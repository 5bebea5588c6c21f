module lagrangia_report_command
    !! `lagrangia report [SCENE...]`: one HTML page with the scorecard, and of each scene pictures,
    !! film, derivation, and what the lecture and the errata say.
    use lagrangia_animation, only: scene_film
    use lagrangia_command_line, only: command_line_t
    use lagrangia_console, only: note, put_line
    use lagrangia_data_files, only: data_path, script_path
    use lagrangia_errors, only: error_t, fail, is_signal, status_not_held
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_output_file, only: refuse_unwritable
    use lagrangia_output_options, only: draw_picture, take_folder
    use lagrangia_part, only: part_t
    use lagrangia_progress, only: part_label, progress_t
    use lagrangia_report_page, only: report_page_t
    use lagrangia_run_command, only: choose_scenes, chosen_t
    use lagrangia_run_plan, only: run_plan_t
    use lagrangia_scene, only: heading
    use lagrangia_scene_run, only: run_scene
    use lagrangia_scorecard, only: missed_text
    implicit none (type, external)
    private
    public :: report_command

contains

    subroutine report_command(line, error)
        !! Run the scenes, all of them where none is named, and write `report.html` beside their
        !! data. A scene that fails has its section, which says why; the status is that of the
        !! first failure.
        type(command_line_t), intent(in) :: line          !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(chosen_t), allocatable :: chosen(:)
        type(progress_t), target :: progress
        type(part_t), target :: part
        class(observer_t), pointer :: observer
        type(outcome_t) :: outcome
        type(report_page_t) :: page
        type(error_t), allocatable :: scene_error, page_error
        character(:), allocatable :: folder, path
        integer :: i, missed

        call take_folder(line, folder, error)
        if (allocated(error)) return
        path = data_path(folder, "report.html", "text")
        allocate (chosen(0))  ! gfortran 12 would warn of its bounds
        call choose_scenes(line, folder, "text", chosen, error, path)
        if (.not. allocated(error)) call refuse_unwritable(path, error)
        if (allocated(error)) return
        part%whole => progress
        observer => part
        missed = 0
        call progress%restart("report", line%has("quiet"))
        do i = 1, size(chosen)
            progress%label = part_label("report", chosen(i)%plan%scene%name, i, size(chosen))
            part%from = (i - 1.0_dp)/size(chosen)
            part%to = real(i, dp)/size(chosen)
            call part%tick(0_i8, 1_i8)
            call run_scene(chosen(i)%plan, folder, "text", observer, outcome, scene_error)
            if (.not. allocated(scene_error) .and. .not. outcome%holds()) missed = missed + 1
            call add_scene(page, chosen(i)%plan, outcome, line%has("quiet"), scene_error)
            if (.not. allocated(scene_error)) cycle
            call progress%clear()
            call scene_error%add_context(chosen(i)%path%text)
            if (is_signal(scene_error)) then
                call move_alloc(scene_error, error)
                return
            end if
            call note(scene_error%message)
            if (.not. allocated(error)) call fail(error, "", scene_error%status)
        end do
        call progress%clear()
        call page%write(path, page_error)
        if (allocated(page_error)) then  ! what keeps the page away has perhaps been said of a scene
            if (.not. allocated(error)) call move_alloc(page_error, error)
            return
        end if
        if (.not. line%has("quiet")) call put_line("report: "//path)
        if (missed > 0 .and. .not. allocated(error)) call fail(error, missed_text(missed, &
            size(chosen)), status_not_held)
    end subroutine report_command

    subroutine add_scene(page, plan, outcome, quiet, error)
        !! The section of a scene. Without gnuplot it has no pictures, and says so.
        type(report_page_t), intent(inout) :: page
        type(run_plan_t), intent(in) :: plan
        type(outcome_t), intent(in) :: outcome
        logical, intent(in) :: quiet
        type(error_t), allocatable, intent(inout) :: error  !! why its run, or its film, failed
        character(:), allocatable :: film

        call page%begin_scene(heading(plan%scene), outcome)
        if (.not. allocated(error)) then
            call scene_film(plan, film, error)
            if (.not. allocated(error)) call page%add_film(plan, film)
        end if
        if (allocated(error)) then
            call page%add_remark(error%message)
            if (is_signal(error)) return
        end if
        call add_picture(outcome%file)
        if (outcome%draws_events) call add_picture(outcome%events)
        call page%add_lecture(plan)
    contains
        subroutine add_picture(path)
            character(*), intent(in) :: path  !! of a data file, or ""
            character(:), allocatable :: script
            type(error_t), allocatable :: why

            if (path == "" .or. allocated(error)) return
            script = script_path(path)
            call draw_picture(path, "svg", quiet, why)
            if (.not. allocated(why)) call page%add_picture(script(:len(script) - 2)//"svg", &
                                                            heading(plan%scene), why)
            if (.not. allocated(why)) return
            call page%add_remark("no picture: "//why%message)
            if (is_signal(why)) call move_alloc(why, error)
        end subroutine add_picture
    end subroutine add_scene
end module lagrangia_report_command
