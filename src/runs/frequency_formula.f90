module lagrangia_frequency_formula
    !! The formula of a description that gives the frequency of a small oscillation.
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_named_values, only: motion_state_t
    use lagrangia_statements, only: statements_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: find_formula

contains

    subroutine find_formula(system, at, omega2, formula)
        !! The equation whose right-hand side, at this equilibrium, is \(\omega^2\), or \(\omega\)
        !! where that is on its left, to within the square root of the rounding of a number.
        class(system_t), intent(in) :: system                 !! with its parameters
        real(dp), intent(in) :: at(:)                         !! the equilibrium
        real(dp), intent(in) :: omega2                        !! s^-2, above 0
        character(:), allocatable, intent(out) :: formula     !! `omega^2 = g/l`; absent: none
        real(dp), parameter :: close_by = sqrt(epsilon(1.0_dp))
        type(description_t) :: d
        type(error_t), allocatable :: error
        type(motion_state_t) :: state
        type(statements_t) :: statements
        character(:), allocatable :: text
        real(dp) :: value(1), zero(1)
        integer :: equals, i

        call system%describe(d)
        if (.not. allocated(d%frequencies)) return
        allocate (state%q, source=at)
        allocate (state%q0, source=at)
        allocate (state%v, source=0.0_dp*at)
        allocate (state%v0, source=0.0_dp*at)
        allocate (state%a, source=0.0_dp*at)
        do i = 1, size(d%frequencies)
            text = trim(d%frequencies(i)%equation)
            equals = index(text, " = ")
            call statements%begin(system, d, state, error)
            if (.not. allocated(error)) call statements%add_formula(text(equals + 3:), error)
            if (allocated(error)) return
            call statements%finish()
            call statements%evaluate(system, d, state, value, zero)
            if (index(text(:equals), "^2") == 0) value = value*abs(value)
            if (.not. abs(value(1) - omega2) <= close_by*omega2) cycle
            formula = text
            return
        end do
    end subroutine find_formula
end module lagrangia_frequency_formula
