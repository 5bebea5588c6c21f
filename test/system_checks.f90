module system_checks
    !! What must hold for every system: any suite, and the walk over the catalogue, calls it.
    !!
    !! The claims themselves are judged by the library's audit, which `lagrangia check` prints.
    use description_checks, only: check_description, check_refusals
    use funit, only: anyExceptions, assertEqual, assertTrue
    use lagrangia_audit, only: audit_system, draws
    use lagrangia_audit_equations, only: claim_accelerations, claim_energy
    use lagrangia_audit_newton, only: claim_gauss
    use lagrangia_ledger, only: ledger_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: check_system

contains

    subroutine check_system(system, claims)
        !! All that a system claims. On return it has parameters of the last draw.
        class(system_t), intent(inout) :: system
        integer, intent(out), optional :: claims  !! how many were judged
        type(ledger_t) :: audit
        integer :: i

        if (present(claims)) claims = 0
        call check_description(system)
        if (anyExceptions()) return
        call check_refusals(system)
        if (anyExceptions()) return
        call audit_system(system, audit)
        do i = 1, size(audit%rows)
            associate (row => audit%rows(i))
                call assertTrue(row%holds, trim(row%group)//": "//trim(row%name)//" "// &
                                row%remark)
            end associate
        end do
        call check_states(audit, claim_accelerations)
        call check_states(audit, claim_energy)
        call check_states(audit, claim_gauss)
        if (present(claims)) claims = size(audit%rows)
    end subroutine check_system

    subroutine check_states(audit, claim)
        !! The claim was judged at every state.
        type(ledger_t), intent(in) :: audit
        character(*), intent(in) :: claim
        integer :: row

        row = audit%row_of(claim)
        call assertTrue(row > 0, claim)
        if (row > 0) call assertEqual(draws, audit%rows(row)%states, claim)
    end subroutine check_states
end module system_checks
