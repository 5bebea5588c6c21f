program main
    !! `extremes [COUNT]`: audits of every system at COUNT random parameter sets over twelve
    !! decades. No claim may fail. Then the mutants of the tests: each whose accelerations are off
    !! by more than a millionth must be found, and its coordinate be named.
    use extremes, only: audit_at_random, coordinate_of, differs, show_parameters
    use lagrangia_blas_threads, only: use_one_blas_thread
    use lagrangia_catalogue, only: new_system, system_names
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: ledger_t
    use lagrangia_random_draws, only: random_t
    use lagrangia_system, only: system_t
    use mutants, only: mutants_known, new_mutant
    implicit none (type, external)

    integer :: count, false_alarms, missed

    count = 1000
    call read_count(count)
    call use_one_blas_thread()
    false_alarms = 0
    missed = 0
    call audit_systems()
    call audit_mutants()
    print "(i0, a, i0, a)", false_alarms, " false alarms, ", missed, " slips missed"
    if (false_alarms + missed > 0) stop 1, quiet=.true.

contains

    subroutine read_count(count)
        !! From the command line.
        integer, intent(inout) :: count
        character(20) :: text
        integer :: status

        call get_command_argument(1, text)
        if (text == "") return
        read (text, *, iostat=status) count
        if (status /= 0) error stop "extremes: a whole number is needed"
    end subroutine read_count

    subroutine audit_systems()
        !! All of the catalogue.
        character(:), allocatable :: names(:)
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(random_t) :: random
        type(ledger_t) :: audit
        real(dp), allocatable :: values(:)
        integer :: i, k, row, before

        names = system_names()
        do i = 1, size(names)
            before = false_alarms
            do k = 1, count
                call new_system(trim(names(i)), system, error)
                audit = ledger_t()
                call audit_at_random(system, random, audit, values)
                do row = 1, size(audit%rows)
                    if (audit%rows(row)%holds) cycle
                    false_alarms = false_alarms + 1
                    if (false_alarms - before > 6) cycle
                    print "(a)", "lagrangia check "//show_parameters(system, values)
                    print "(4x, a, 2es9.1, 2x, a)", audit%rows(row)%name, &
                        audit%rows(row)%value, audit%rows(row)%most, &
                        trim(audit%rows(row)%remark)
                end do
                deallocate (system)
            end do
            print "(a, i0, a, i0, a)", trim(names(i))//": ", count, " parameter sets, ", &
                false_alarms - before, " false alarms"
        end do
    end subroutine audit_systems

    subroutine audit_mutants()
        !! Those of the tests.
        class(system_t), allocatable :: system
        character(:), allocatable :: expected
        type(random_t) :: random
        type(ledger_t) :: audit
        real(dp), allocatable :: values(:)
        real(dp) :: difference
        integer :: i, k, row, seen, found, named, before

        do i = 1, mutants_known
            seen = 0
            found = 0
            named = 0
            before = missed
            do k = 1, max(1, count/10)
                if (allocated(system)) deallocate (system)
                call new_mutant(i, system, expected)
                expected = coordinate_of(expected)
                audit = ledger_t()
                call audit_at_random(system, random, audit, values)
                call differs(system, values, difference)
                if (.not. difference > 1e-6_dp) cycle
                seen = seen + 1
                row = audit%row_of("accelerations as from L")
                if (.not. audit%rows(row)%holds) found = found + 1
                if (coordinate_of(audit%rows(row)%remark) == expected) named = named + 1
                if (coordinate_of(audit%rows(row)%remark) == expected) cycle
                missed = missed + 1
                if (missed - before > 3) cycle
                print "(a)", "missed: "//show_parameters(system, values)
                print "(4x, a, 2es9.1, 2x, a)", "wanted "//expected, audit%rows(row)%value, &
                    difference, trim(audit%rows(row)%remark)
            end do
            print "(a, i0, a, i0, a, i0, a)", expected//": ", seen, " slips, ", found, &
                " found, ", named, " named"
        end do
    end subroutine audit_mutants
end program main
