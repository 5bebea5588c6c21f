module lagrangia_fortran_outline
    !! What a system in formulas says of itself, as the procedure `outline` of a module in Fortran.
    use lagrangia_description, only: description_t, name_length, parameter_t, quantity_t
    use lagrangia_errors, only: error_t
    use lagrangia_formula_fortran, only: fortran_text
    use lagrangia_fortran_names, only: find_names
    use lagrangia_fortran_statements, only: fortran_lines_t, literal
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero, is_zero
    use lagrangia_text, only: to_text, word_t
    use lagrangia_written_system, only: written_system_t
    implicit none (type, external)
    private
    public :: add_outline

contains

    subroutine add_outline(system, d, lines)
        !! Names, units, formulas; masses and the equilibrium from the parameters.
        class(written_system_t), intent(in) :: system  !! of the description
        type(description_t), intent(in) :: d           !! complete
        type(fortran_lines_t), intent(inout) :: lines  !! gets the procedure
        type(word_t), allocatable :: items(:)
        integer :: i, n

        n = size(d%coordinates)
        call lines%add(0, "")
        call lines%add(4, "pure subroutine outline(self, d)")
        call lines%add(8, "!! What the system says of itself; the audit compares the formulas "// &
                       "with what is computed here.")
        call lines%add(8, "class("//trim(d%name)//"_t), intent(in) :: self")
        call lines%add(8, "type(description_t), intent(out) :: d")
        call lines%add(0, "")
        call lines%add(8, "d%name = "//literal(d%name))
        call lines%add(8, "d%title = "//literal(d%title))
        allocate (items(n))
        do i = 1, n
            items(i)%text = "coordinate("//words_of(d%coordinates(i))//")"
        end do
        call add_list(8, "coordinates", "", items, lines)
        call add_parameters(system, d%parameters, lines)
        deallocate (items)
        allocate (items(size(d%quantities)))
        do i = 1, size(items)
            items(i)%text = "quantity("//words_of(d%quantities(i))
            if (d%quantities(i)%formula /= "") items(i)%text = items(i)%text//", "// &
                                                               literal(d%quantities(i)%formula)
            items(i)%text = items(i)%text//")"
        end do
        call add_list(8, "quantities", "", items, lines)
        call lines%add(8, "if (allocated(self%cyclic_coordinates)) d%quantities(:"//to_text(n)// &
                       ")%conserved = self%cyclic_coordinates")
        call add_conserved(system, d, lines)
        if (system%constraints > 0) call add_constraint_texts(system, d, lines)
        call add_formulas(d, lines)
        if (size(d%points) + size(d%rotors) + size(system%expressions%equilibrium) > 0) then
            call add_places(system, d, lines)
        end if
        call lines%add(4, "end subroutine outline")
    end subroutine add_outline

    pure function words_of(q) result(text)
        !! Name, unit and meaning.
        type(quantity_t), intent(in) :: q
        character(:), allocatable :: text

        text = literal(q%name)//", "//literal(q%unit)//", "//literal(q%meaning)
    end function words_of

    subroutine add_list(indentation, component, kind, items, lines)
        !! `d%component = [kind :: ...]`, an element a line.
        integer, intent(in) :: indentation  !! columns
        character(*), intent(in) :: component, kind
        type(word_t), intent(in) :: items(:)
        type(fortran_lines_t), intent(inout) :: lines
        integer :: i

        if (size(items) == 0) then
            call lines%add(indentation, "allocate (d%"//component//"(0))")
            return
        end if
        call lines%add(indentation, "d%"//component//" = ["//kind//" &")
        do i = 1, size(items) - 1
            call lines%add(indentation + 4, items(i)%text//", &")
        end do
        call lines%add(indentation + 4, items(size(items))%text//"]")
    end subroutine add_list

    subroutine add_constraint_texts(system, d, lines)
        !! Their class and equations; what is left of each is compared with 1.
        class(written_system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(fortran_lines_t), intent(inout) :: lines
        type(word_t) :: items(system%constraints)
        integer :: first, k

        first = size(d%quantities) - system%constraints + 1
        call lines%add(8, "d%quantities("//to_text(first)//":)%scale = 1.0_dp")
        call lines%add(8, "d%constraint = "//literal(d%constraint))
        do k = 1, size(items)
            items(k)%text = literal(d%constraint_equations(k))
        end do
        call add_list(8, "constraint_equations", "character(constraint_length) ::", items, lines)
        do k = 1, size(items)
            items(k)%text = literal(d%notes(k))
        end do
        call add_list(8, "notes", "character(constraint_length) ::", items, lines)
    end subroutine add_constraint_texts

    subroutine add_conserved(system, d, lines)
        !! Which of the scene's own quantities are conserved: with any parameters, so far as three
        !! other sets of them tell, or with the scene's.
        class(written_system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(fortran_lines_t), intent(inout) :: lines
        class(written_system_t), allocatable :: other
        type(description_t) :: changed
        type(error_t), allocatable :: error
        real(dp) :: values(size(d%parameters))
        logical :: always(size(d%quantities))
        character(:), allocatable :: text
        integer :: i, k

        always = d%quantities%conserved
        allocate (other, source=system)
        do k = 1, 3
            do i = 1, size(values)
                values(i) = d%parameters(i)%value(1)*(1.0_dp + 0.3_dp*sin(real(i*k, dp)))
                if (is_zero(values(i))) values(i) = 0.1_dp*k
            end do
            call other%configure(values, error)
            if (allocated(error)) cycle
            call other%describe(changed)
            always = always .and. changed%quantities%conserved
        end do
        text = ""
        do i = 1, size(values)
            text = text//", "//to_text(d%parameters(i)%value(1))//"_dp"
        end do
        do i = size(d%coordinates) + 1, size(d%quantities)
            if (.not. d%quantities(i)%conserved) cycle
            if (always(i)) then
                call lines%add(8, "d%quantities("//to_text(i)//")%conserved = .true.")
            else
                call lines%add(8, "if (allocated(self%p)) d%quantities("//to_text(i)// &
                               ")%conserved = all(abs(self%p - ["//text(3:)//"]) <= 0.0_dp)")
            end if
        end do
    end subroutine add_conserved

    subroutine add_parameters(system, parameters, lines)
        !! With the scene's values as defaults, and what is allowed: where the scene does not say
        !! so, what the mass matrix depends on is positive if it is in the scene.
        class(written_system_t), intent(in) :: system
        type(parameter_t), intent(in) :: parameters(:)
        type(fortran_lines_t), intent(inout) :: lines
        type(word_t) :: items(size(parameters))
        character(:), allocatable :: maker, name
        integer :: i

        do i = 1, size(parameters)
            associate (p => parameters(i))
                maker = "real_number"
                if (p%lower < -huge(p%lower)/2 .and. p%value(1) > 0.0_dp .and. &
                    in_mass_matrix(system, i)) maker = "positive"
                if (is_zero(p%lower)) maker = trim(merge("positive   ", "nonnegative", &
                                                               p%open_lower))
                items(i)%text = maker//"("//literal(p%name)//", "//literal(p%unit)//", "// &
                                literal(p%meaning)//", "//to_text(p%value(1))//"_dp)"
            end associate
        end do
        call add_list(8, "parameters", "", items, lines)
        do i = 1, size(parameters)
            name = "d%parameters("//to_text(i)//")%"
            associate (p => parameters(i))
                if (p%lower > -huge(p%lower) .and. is_nonzero(p%lower)) then
                    call lines%add(8, name//"lower = "//to_text(p%lower)//"_dp")
                    if (p%open_lower) call lines%add(8, name//"open_lower = .true.")
                end if
                if (p%upper < huge(p%upper)) then
                    call lines%add(8, name//"upper = "//to_text(p%upper)//"_dp")
                    if (p%open_upper) call lines%add(8, name//"open_upper = .true.")
                end if
            end associate
        end do
    end subroutine add_parameters

    pure function in_mass_matrix(system, i) result(yes)
        !! Does it depend on parameter `i`?
        class(written_system_t), intent(in) :: system
        integer, intent(in) :: i
        logical :: yes
        integer :: j, k

        yes = .false.
        do j = 1, system%ndof
            do k = 1, j
                yes = yes .or. system%motion%mass(j, k)%depends_on(1 + 2*system%ndof + i)
            end do
        end do
    end function in_mass_matrix

    subroutine add_formulas(d, lines)
        !! Everything that is printed as a formula.
        type(description_t), intent(in) :: d
        type(fortran_lines_t), intent(inout) :: lines
        type(word_t), allocatable :: items(:)
        integer :: i

        if (allocated(d%letters)) then
            allocate (items(size(d%letters)))
            do i = 1, size(items)
                items(i)%text = "letter_t("//literal(d%letters(i)%name)//", "// &
                                literal(d%letters(i)%formula)//")"
            end do
            if (size(items) > 0) call add_list(8, "letters", "", items, lines)
        end if
        if (allocated(d%kinetic_energy)) call add_text("kinetic_energy", d%kinetic_energy)
        if (allocated(d%potential_energy)) call add_text("potential_energy", d%potential_energy)
        if (allocated(d%lagrangian)) call add_text("lagrangian", d%lagrangian)
        if (allocated(d%energy)) call add_text("energy", d%energy)
        if (allocated(d%generalised_forces)) call add_texts("generalised_forces", &
                                                            d%generalised_forces)
        if (allocated(d%equations)) call add_texts("equations", d%equations)
    contains
        subroutine add_text(component, text)
            !! Of any length.
            character(*), intent(in) :: component, text
            integer, parameter :: longest = 5000  ! characters in one statement
            character(:), allocatable :: before
            integer :: first, last

            before = "d%"//component//" = "
            first = 1
            do
                last = min(first + longest - 1, len_trim(text))
                last = len_trim(text(:last))  ! no blank at the end of a piece
                call lines%add(8, before//literal(text(first:last)))
                if (last == len_trim(text)) exit
                first = last + 1
                before = "d%"//component//" = d%"//component//"//"
            end do
        end subroutine add_text

        subroutine add_texts(component, texts)
            !! `character(formula_length)` each.
            character(*), intent(in) :: component, texts(:)
            type(word_t) :: quoted(size(texts))
            integer :: k

            do k = 1, size(texts)
                quoted(k)%text = literal(texts(k))
            end do
            call add_list(8, component, "character(formula_length) ::", quoted, lines)
        end subroutine add_texts
    end subroutine add_formulas

    subroutine add_places(system, d, lines)
        !! The points with their masses, the rotors, and the equilibrium.
        class(written_system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(fortran_lines_t), intent(inout) :: lines
        type(word_t), allocatable :: names(:)
        type(word_t) :: items(size(d%points)), places(size(system%expressions%equilibrium))
        type(word_t) :: turning(size(d%rotors))
        character(:), allocatable :: text
        integer :: first, i, k

        call find_names(system%expressions%symbols%names, &
                        [character(name_length) :: d%name, "d"], names)
        first = 1 + 2*size(d%coordinates)
        text = ""
        do i = 1, size(d%parameters)
            text = text//", "//names(first + i)%text//" => self%value("//to_text(i)//", "// &
                   to_text(d%parameters(i)%value(1))//"_dp)"
        end do
        if (text /= "") call lines%add(8, "associate ("//text(3:)//")")
        do i = 1, size(d%points)
            associate (p => d%points(i))
                call fortran_text(system%expressions%masses(i), names, text)
                items(i)%text = "mass_point("//literal(p%name)//", "//text
                if (p%mass_formula /= "") then  ! else the formulas of the position are not known
                    items(i)%text = items(i)%text//", "//literal(p%mass_formula)
                    do k = 1, 3
                        items(i)%text = items(i)%text//", "//literal(p%position(k))
                    end do
                end if
                items(i)%text = items(i)%text//")"
            end associate
        end do
        do i = 1, size(d%rotors)
            associate (p => d%rotors(i))
                call fortran_text(system%expressions%inertias(i), names, text)
                turning(i)%text = "mass_point("//literal(p%name)//", "//text
                if (p%mass_formula /= "") turning(i)%text = turning(i)%text//", "// &
                    literal(p%mass_formula)//", "//literal(p%position(1))
                turning(i)%text = turning(i)%text//")"
            end associate
        end do
        if (size(items) > 0) call add_list(12, "points", "", items, lines)
        if (size(turning) > 0) call add_list(12, "rotors", "", turning, lines)
        do i = 1, size(places)
            call fortran_text(system%expressions%equilibrium(i), names, places(i)%text)
        end do
        if (size(places) > 0) call add_list(12, "equilibrium", "", places, lines)
        if (size(d%parameters) > 0) call lines%add(8, "end associate")
        if (allocated(d%equilibrium_formulas)) then
            do i = 1, size(places)
                places(i)%text = literal(d%equilibrium_formulas(i))
            end do
            call add_list(8, "equilibrium_formulas", "character(formula_length) ::", places, lines)
        end if
        if (d%dimensions /= 2) call lines%add(8, "d%dimensions = "//to_text(d%dimensions))
    end subroutine add_places
end module lagrangia_fortran_outline
