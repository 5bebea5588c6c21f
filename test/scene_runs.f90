module scene_runs
    !! For tests of the files that a run writes.
    use funit, only: assertFalse
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_observer, only: observer_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_play, only: play
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: perform

contains

    subroutine perform(text, folder, format, outcome, error, source)
        !! Run the scene `text`, read from `source` or nowhere, with its files in `folder`.
        character(*), intent(in) :: text, folder, format
        type(outcome_t), intent(out) :: outcome
        type(error_t), allocatable, intent(out) :: error
        character(*), intent(in), optional :: source
        class(system_t), allocatable :: system
        class(observer_t), pointer :: nobody
        type(scene_t) :: scene

        nobody => null()
        if (present(source)) then
            call parse_scene(text, source, [word_t ::], scene, system, error)
        else
            call parse_scene(text, "s.nml", [word_t ::], scene, system, error)
        end if
        call assertFalse(allocated(error), text)
        if (allocated(error)) return
        call play(scene, system, folder, format, nobody, outcome, error)
    end subroutine perform
end module scene_runs
