module event_runs
    !! A run of `dop853` that looks for events.
    use funit, only: anyExceptions, assertEqual, assertFalse
    use lagrangia_dense_run, only: run_dense
    use lagrangia_dop853, only: dop853_t, new_dop853
    use lagrangia_errors, only: error_t
    use lagrangia_events, only: column_event_t, event_box_t, new_column_event
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_box_t
    use lagrangia_recorder, only: recorder_t
    use lagrangia_system, only: system_t
    use lagrangia_time_grid, only: new_sample_times, time_grid_t
    implicit none (type, external)
    private
    public :: find

contains

    subroutine find(system, texts, q, v, duration, tolerance, record, ended, samples)
        !! Run `dop853`, looking for the events that `texts` say.
        class(system_t), intent(in) :: system
        character(*), intent(in) :: texts(:)
        real(dp), intent(inout) :: q(1), v(1)
        real(dp), intent(in) :: duration, tolerance
        type(recorder_t), target, intent(inout) :: record
        real(dp), intent(out) :: ended
        integer(i8), intent(in), optional :: samples
        type(event_box_t) :: events(size(texts))
        type(observer_box_t) :: observers(1)
        type(column_event_t) :: event
        type(dop853_t) :: method
        type(time_grid_t) :: plan
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, size(texts)
            call new_column_event(event, trim(texts(i)), system, error)
            if (allocated(error)) call assertEqual("", error%message, message="event")
            if (anyExceptions()) return
            allocate (events(i)%item, source=event)
        end do
        observers(1)%item => record
        call new_dop853(method)
        method%tolerance = tolerance
        if (present(samples)) then
            call new_sample_times(plan, 0.0_dp, duration, samples, error)
        else
            call new_sample_times(plan, 0.0_dp, duration, 10_i8, error)
        end if
        call run_dense(system, method, plan, events, observers, q, v, ended, error)
        call assertFalse(allocated(error), "no error")
    end subroutine find
end module event_runs
