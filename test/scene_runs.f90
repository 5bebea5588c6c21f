module scene_runs
    !! For tests of scenes: read and plan one, run one.
    use funit, only: assertFalse
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_observer, only: observer_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_run_plan, only: new_run_plan, parse_run_plan, run_plan_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_run, only: run_scene
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: perform, plan_and_run, read_and_plan

contains

    subroutine perform(text, folder, format, outcome, error, source)
        !! Run the scene `text`, read from `source` or nowhere, with its files in `folder`.
        character(*), intent(in) :: text, folder, format
        type(outcome_t), intent(out) :: outcome
        type(error_t), allocatable, intent(out) :: error
        character(*), intent(in), optional :: source
        class(observer_t), pointer :: nobody
        type(run_plan_t) :: plan

        nobody => null()
        if (present(source)) then
            call parse_run_plan(plan, text, source, [word_t ::], error)
        else
            call parse_run_plan(plan, text, "s.nml", [word_t ::], error)
        end if
        call assertFalse(allocated(error), text)
        if (allocated(error)) return
        call run_scene(plan, folder, format, nobody, outcome, error)
    end subroutine perform

    subroutine read_and_plan(text, source, overrides, scene, system, error)
        !! The scene in `text` and its system, where nothing is wrong with them.
        character(*), intent(in) :: text, source
        type(word_t), intent(in) :: overrides(:)
        type(scene_t), intent(out) :: scene
        class(system_t), allocatable, intent(out) :: system
        type(error_t), allocatable, intent(out) :: error
        type(run_plan_t) :: plan

        call parse_run_plan(plan, text, source, overrides, error)
        if (allocated(error)) return
        scene = plan%scene
        call move_alloc(plan%system, system)
    end subroutine read_and_plan

    subroutine plan_and_run(scene, system, outcome, error)
        !! Without files.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        type(outcome_t), intent(out) :: outcome
        type(error_t), allocatable, intent(out) :: error
        class(observer_t), pointer :: nobody
        type(run_plan_t) :: plan

        nobody => null()
        call new_run_plan(plan, scene, system, error)
        if (.not. allocated(error)) call run_scene(plan, "", "text", nobody, outcome, error)
    end subroutine plan_and_run
end module scene_runs
