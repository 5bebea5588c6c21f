module lagrangia_stress
    !! `lagrangia stress [ROW...]`: numerical stability, a table for each row.
    use lagrangia_command_line, only: command_line_t
    use lagrangia_console, only: console_failed, flush_console, put_line, put_row
    use lagrangia_errors, only: error_t, fail, status_not_held
    use lagrangia_ledger, only: claim_t, ledger_t
    use lagrangia_ledger_text, only: measured_json, measured_line
    use lagrangia_names, only: refuse_name
    use lagrangia_observer, only: observer_t
    use lagrangia_progress, only: part_label, progress_t
    use lagrangia_stress_rows, only: measure_row, row_t, rows
    use lagrangia_text, only: to_text
    use lagrangia_version, only: build_text
    implicit none (type, external)
    private
    public :: stress_command

contains

    subroutine stress_command(line, error)
        !! Measure the rows named, or all; fails (status 1) if a bound does not hold.
        type(command_line_t), intent(in) :: line  !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        type(ledger_t) :: verdicts
        type(progress_t), target :: progress
        class(observer_t), pointer :: watcher
        character(:), allocatable :: now
        logical :: chosen(size(rows)), json, quiet
        integer :: i, last

        call choose(line, chosen, error)
        if (allocated(error)) return
        json = line%has("json")
        quiet = line%has("quiet") .and. .not. json
        watcher => progress
        if (line%has("quiet")) watcher => null()
        if (json) then
            call put_line("[")
        else if (.not. quiet) then
            call put_line("build: "//build_text())
        end if
        last = 0
        now = ""
        do i = 1, size(rows)
            if (.not. chosen(i)) cycle
            call flush_console()
            if (console_failed()) return  ! nobody would see the rest
            now = part_label("stress", rows(i)%name, count(chosen(:i)), count(chosen))
            call progress%restart(now, line%has("quiet"))
            if (.not. line%has("quiet")) call progress%say(now)
            call measure_row(trim(rows(i)%name), line%has("long"), watcher, verdicts, error)
            call progress%clear()
            if (allocated(error)) return
            if (json) then
                call put_objects(verdicts%rows(last + 1:), last == 0)
            else if (.not. quiet) then
                call put_table(rows(i), verdicts%rows(last + 1:))
            end if
            last = size(verdicts%rows)
        end do
        if (json) then
            call put_line("]")
        else if (.not. quiet) then
            call put_line("")
            call put_line(to_text(last)//" lines, "//to_text(verdicts%broken())//" do not hold")
        end if
        if (verdicts%broken() > 0) call fail(error, to_text(verdicts%broken())//" of "// &
            to_text(last)//" bounds do not hold", status_not_held)
    end subroutine stress_command

    pure subroutine choose(line, chosen, error)
        !! The rows named, or all of them.
        type(command_line_t), intent(in) :: line
        logical, intent(out) :: chosen(:)
        type(error_t), allocatable, intent(out) :: error
        integer :: i

        chosen = size(line%arguments) == 0
        do i = 1, size(line%arguments)
            associate (name => line%arguments(i)%text)
                where (rows%name == name) chosen = .true.
                if (any(rows%name == name)) cycle
                call refuse_name("row", name, (rows%name), error)
                return
            end associate
        end do
    end subroutine choose

    subroutine put_table(row, list)
        !! What is measured, what it means, and a line a case.
        type(row_t), intent(in) :: row
        type(claim_t), intent(in) :: list(:)
        integer :: wide(2), i

        wide = [maxval(len_trim(list%name)), maxval(len_trim(list%measured))]
        call put_line("")
        call put_line(trim(row%name)//": "//trim(row%title))
        call put_line("  "//trim(row%meaning))
        do i = 1, size(list)
            call put_row(measured_line(list(i), wide), sum(wide) + 6, sum(wide) + 40)
        end do
    end subroutine put_table

    subroutine put_objects(list, first)
        !! Objects of the one array.
        type(claim_t), intent(in) :: list(:)
        logical, intent(in) :: first
        integer :: i

        do i = 1, size(list)
            call put_line(trim(merge(" ", ",", first .and. i == 1))//measured_json(list(i)))
        end do
    end subroutine put_objects
end module lagrangia_stress
