module lagrangia_partial_runs
    !! What is kept of a run that failed: under a name that says so, beside files that may be whole.
    use lagrangia_errors, only: error_t, message_length
    use lagrangia_event_record, only: event_record_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_outcome, only: outcome_t
    use lagrangia_output_file, only: remove_partial
    use lagrangia_record, only: record_t
    use lagrangia_run, only: plan_t
    use lagrangia_table, only: table_t
    use lagrangia_text, only: shortened, to_text
    implicit none (type, external)
    private
    public :: keep_parts, planned

contains

    subroutine keep_parts(plan, record, events, outcome, error)
        !! The rows before the numbers failed, in files of their own; `error`, which says why they
        !! did, then names them too.
        type(plan_t), intent(in) :: plan
        type(record_t), intent(inout) :: record
        type(event_record_t), intent(inout) :: events
        type(outcome_t), intent(inout) :: outcome
        type(error_t), intent(inout) :: error
        type(error_t), allocatable :: file_error
        character(:), allocatable :: ending, steps

        steps = to_text(outcome%steps)
        if (plan%steps > 0) steps = steps//" of "//to_text(planned(plan))
        ending = "the run ended at t = "//to_text(outcome%t)//" s after "//steps//" steps: "// &
                 error%message
        outcome%file = ""
        if (allocated(events%table)) call keep_part(events%table, events%rows, ending, file_error)
        if (allocated(file_error)) then
            if (allocated(record%table)) call record%table%file%abandon()
        else if (allocated(record%table)) then
            call keep_part(record%table, record%rows, ending, file_error)
            if (record%rows > 0 .and. .not. allocated(file_error)) then
                outcome%file = record%table%file%name()
                error%message = error%message//"; the rows before are in '"//outcome%file//"'"
            end if
        end if
        if (allocated(file_error)) error%message = error%message//"; "//file_error%message
        error%message = shortened(error%message, message_length)
    end subroutine keep_parts

    subroutine keep_part(table, rows, ending, error)
        !! What a run wrote that failed: the `rows` that were good are called `NAME.partial`, and
        !! say for what `ending`, where the format has a place for it. Without rows there is no
        !! such file, nor one of an earlier run. The file `NAME` stays as it is.
        class(table_t), intent(inout) :: table
        integer(i8), intent(in) :: rows
        character(*), intent(in) :: ending
        type(error_t), allocatable, intent(out) :: error

        if (rows == 0) then
            call remove_partial(table%file%name())
            call table%file%abandon()
            return
        end if
        table%file%partial = .true.
        call table%finish("PARTIAL, rows: "//to_text(rows)//"; "//ending, error)
        if (.not. allocated(error)) call table%file%commit(error)
    end subroutine keep_part

    pure function planned(plan) result(steps)
        !! How many steps a run of fixed ones is to have.
        type(plan_t), intent(in) :: plan
        integer(i8) :: steps

        steps = plan%steps + merge(1, 0, plan%rest > 0.0_dp)
    end function planned
end module lagrangia_partial_runs
