module lagrangia_written_description
    !! What a system in formulas says of itself: places, forces, energies, quantities.
    use lagrangia_description, only: description_t, formula_length
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_text, only: formula_text
    use lagrangia_written_equilibrium, only: equilibrium_text
    use lagrangia_written_expressions, only: written_expressions_t
    use lagrangia_written_formulas, only: written_formulas_t
    implicit none (type, external)
    private
    public :: collect_constants, state_formulas, state_places

contains

    subroutine state_places(e, d)
        !! The equilibrium, masses and places of the points, and forces, as far as there is room for
        !! the formulas. Points whose T is not that of the system have no masses to derive it from.
        type(written_expressions_t), intent(in) :: e     !! what the formulas mean
        type(description_t), intent(inout) :: d          !! gets the points and rotors
        character(:), allocatable :: text
        integer :: i, k, longest

        longest = 0
        do i = 1, size(e%equilibrium)
            text = equilibrium_text(i, e%resting(i), e%rests(i), e%symbols)
            longest = max(longest, len(text))
        end do
        if (longest > 0 .and. longest <= formula_length) then
            allocate (d%equilibrium_formulas(size(e%equilibrium)))
            do i = 1, size(e%equilibrium)
                d%equilibrium_formulas(i) = equilibrium_text(i, e%resting(i), e%rests(i), e%symbols)
            end do
        end if
        longest = 0
        d%dimensions = e%dimensions
        allocate (d%points(size(e%points)), d%rotors(size(e%rotors)))
        d%points%name = e%points
        d%rotors%name = e%rotors
        do i = 1, size(d%points)
            text = formula_text(e%masses(i), e%symbols)
            longest = max(longest, len(text))
            d%points(i)%mass_formula = text
            do k = 1, 3
                text = formula_text(e%places(3*i - 3 + k), e%symbols)
                longest = max(longest, len(text))
                if (text /= "0") d%points(i)%position(k) = text
            end do
        end do
        do i = 1, size(d%rotors)
            d%rotors(i)%mass_formula = formula_text(e%inertias(i), e%symbols)
            d%rotors(i)%position(1) = formula_text(e%angles(i), e%symbols)
            text = formula_text(e%angles(i), e%symbols)
            longest = max(longest, len(text), len_trim(d%rotors(i)%mass_formula))
        end do
        if (longest > formula_length .or. .not. e%of_points) then
            d%points%mass_formula = ""
            d%rotors%mass_formula = ""
        end if
        longest = 0
        do i = 1, size(e%forces)
            text = formula_text(e%forces(i), e%symbols)
            if (text /= "0") longest = max(longest, len(text) + 40)
        end do
        if (longest == 0 .or. longest > formula_length) return
        allocate (d%generalised_forces(size(e%forces)))
        do i = 1, size(e%forces)
            d%generalised_forces(i) = "Q_"//trim(d%coordinates(i)%name)//" = "// &
                                      formula_text(e%forces(i), e%symbols)
        end do
    end subroutine state_places

    subroutine state_formulas(formulas, expressions, d)
        !! T, V, L, quantities and the definitions as they were typed; definitions that are too long
        !! for a letter are written out, and so is L where T or V is something else.
        type(written_formulas_t), intent(in) :: formulas        !! texts
        type(written_expressions_t), intent(in) :: expressions  !! what they mean
        type(description_t), intent(inout) :: d                 !! gets these texts
        character(:), allocatable :: text
        character, parameter :: energies(2) = ["T", "V"]
        logical :: as_typed, taken
        integer :: equals, i

        as_typed = all(len_trim(formulas%definitions) <= formula_length)
        if (as_typed) then
            allocate (d%letters(size(formulas%definitions)))
            do i = 1, size(d%letters)
                equals = index(formulas%definitions(i), "=")
                d%letters(i)%name = trim(adjustl(formulas%definitions(i)(:equals - 1)))
                d%letters(i)%formula = trim(adjustl(formulas%definitions(i)(equals + 1:)))
            end do
        end if
        taken = any([(any(expressions%symbols%names == energies(i)), i=1, size(energies))])
        if (allocated(formulas%quantities)) taken = taken .or. any(formulas%quantities%name == "V")
        if (formulas%lagrangian /= "" .or. taken) then
            d%lagrangian = stated(formulas%lagrangian, expressions%lagrangian)
        else
            d%lagrangian = "T - V"
            d%kinetic_energy = stated(formulas%kinetic, expressions%kinetic)
            d%potential_energy = stated(formulas%potential, expressions%potential)
            if (formulas%potential == "") d%potential_energy = "0"
        end if
        d%quantities = formulas%quantities
        do i = 1, size(d%quantities)
            text = stated(formulas%quantity_formulas(i), expressions%quantities(i))
            if (len(text) <= formula_length) d%quantities(i)%formula = text
        end do
    contains
        function stated(typed, expression) result(text)
            character(*), intent(in) :: typed
            type(expression_t), intent(in) :: expression
            character(:), allocatable :: text

            if (as_typed .and. typed /= "") then
                text = trim(adjustl(typed))
            else
                text = formula_text(expression, expressions%symbols)
            end if
        end function stated
    end subroutine state_formulas

    subroutine collect_constants(e, constants)
        !! What depends on the parameters alone: masses, moments of inertia, the equilibrium.
        type(written_expressions_t), intent(in) :: e                    !! what the formulas mean
        type(expression_t), allocatable, intent(out) :: constants(:)    !! in this order
        integer :: i, n

        n = size(e%masses) + size(e%inertias)
        allocate (constants(n + size(e%equilibrium)))
        do i = 1, size(e%masses)
            constants(i) = e%masses(i)
        end do
        do i = 1, size(e%inertias)
            constants(size(e%masses) + i) = e%inertias(i)
        end do
        do i = 1, size(e%equilibrium)
            constants(n + i) = e%equilibrium(i)
        end do
    end subroutine collect_constants
end module lagrangia_written_description
