module lagrangia_derivation_slips
    !! The slips of the notes that are one formula of a derivation.
    use lagrangia_derivation, only: line_equation, line_kinetic
    use lagrangia_derivation_steps, only: slip_in_formula_t
    use lagrangia_errata_ledger, only: slip_t, slips_of_the_notes
    use lagrangia_errors, only: error_t, fail
    use lagrangia_text, only: join, lower, quoted
    implicit none (type, external)
    private
    public :: derivable_slips, find_slip

    character(3), parameter :: derivable_slips(*) = ["E1 ", "E2 ", "E3 ", "E21", "E25"]
    !! those that there are

contains

    subroutine find_slip(id, system, slip, error)
        !! The formula of the ledger, and the line that it takes the place of.
        character(*), intent(in) :: id                    !! `E1`, in any case
        character(*), intent(in) :: system                !! whose derivation it is to be
        type(slip_in_formula_t), intent(out) :: slip      !! what takes the place of what
        type(error_t), allocatable, intent(out) :: error  !! no such slip, or of another system
        type(slip_t), allocatable :: all_slips(:)
        type(slip_t) :: found
        character(:), allocatable :: reads
        integer :: i

        allocate (all_slips, source=slips_of_the_notes())
        do i = 1, size(all_slips)
            if (lower(trim(all_slips(i)%id)) == lower(id)) found = all_slips(i)
        end do
        reads = trim(found%reads)
        slip%kind = line_equation
        select case (lower(id))
        case ("e1")
            slip%i = 2
            slip%formula = "m2 l ("//reads(:index(reads, "=") - 2)//") = 0"
        case ("e2")
            slip%kind = line_kinetic
            slip%formula = "m1/2 x_dot^2 + "//reads
        case ("e3")
            slip%i = 2
            slip%formula = reads
        case ("e21")
            slip%i = 1
            slip%formula = reads
        case ("e25")
            slip%i = 1
            slip%formula = trim(found%wrong)
        case default
            if (reads == "") then
                call fail(error, "unknown slip "//quoted(id)//"; 'lagrangia errata' lists "// &
                          "them, and a derivation takes "//join(derivable_slips, ", "))
            else
                call fail(error, "slip "//quoted(id)//" is no formula of a derivation; those "// &
                          "are "//join(derivable_slips, ", "))
            end if
            return
        end select
        if (system == found%system) return
        call fail(error, "slip "//quoted(id)//" is one of the "//trim(found%system)// &
                  ": 'lagrangia derive "//trim(found%system)//" --slip "//trim(id)//"'")
    end subroutine find_slip
end module lagrangia_derivation_slips
