module lagrangia_sweep_events
    !! The events that the trajectories of a sweep are watched for: those that are kept, and the
    !! scene's own that end a run.
    use lagrangia_errors, only: error_t, fail
    use lagrangia_events, only: column_event_t, new_column_event
    use lagrangia_kept, only: is_lyapunov, keeps_event, keeps_flip, kept_t
    use lagrangia_scene, only: scene_t, sweep_text_length
    use lagrangia_system, only: system_t
    use lagrangia_text, only: quoted
    implicit none (type, external)
    private
    public :: choose_events

contains

    subroutine choose_events(scene, system, kept, events, stops, error)
        !! A trajectory ends at the one event that is kept, if nothing else is.
        type(scene_t), intent(inout) :: scene             !! has its own events; gets these
        class(system_t), intent(in) :: system             !! with the scene's parameters
        type(kept_t), intent(in) :: kept(:)               !! of each trajectory
        character(*), intent(in) :: events(:)             !! that `kept` or a section takes
        logical, intent(out) :: stops                     !! one of the scene's own ends it
        type(error_t), allocatable, intent(out) :: error  !! it ends what must go on: key `keep`
        character(sweep_text_length), allocatable :: own(:)
        type(column_event_t) :: event
        type(error_t), allocatable :: none
        integer :: i

        allocate (own(0))
        if (allocated(scene%events)) then
            do i = 1, size(scene%events)
                call new_column_event(event, trim(scene%events(i)), system, none)
                if (event%terminal) own = [character(sweep_text_length) :: own, scene%events(i)]
            end do
            deallocate (scene%events)
        end if
        stops = size(own) > 0
        if (stops .and. any(is_lyapunov(kept%kind))) then
            call fail(error, "a Lyapunov exponent takes the whole duration, but the scene ends "// &
                      "at "//quoted(trim(own(1)))//"; leave that event out", key="keep")
        else if (size(kept) == 1 .and. (kept(1)%kind == keeps_flip .or. &
                                        kept(1)%kind == keeps_event)) then
            scene%events = [character(sweep_text_length) :: stopping(events), own]
        else if (size(events) + size(own) > 0) then
            scene%events = [character(sweep_text_length) :: events, own]
        end if
    end subroutine choose_events

    pure function stopping(events) result(texts)
        !! The same, each of which ends the run.
        character(*), intent(in) :: events(:)
        character(len(events) + len(" stop")) :: texts(size(events))
        integer :: i

        do i = 1, size(events)
            texts(i) = trim(events(i))//" stop"
        end do
    end function stopping
end module lagrangia_sweep_events
