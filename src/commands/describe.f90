module lagrangia_describe
    !! `lagrangia describe SYSTEM`: what a lecturer would write on the blackboard, with these
    !! parameters.
    use lagrangia_catalogue, only: new_system
    use lagrangia_columns, only: column_names
    use lagrangia_command_line, only: command_line_t
    use lagrangia_console, only: put_line
    use lagrangia_description, only: constraint_text, description_t, parameter_t, quantity_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_helmholtz, only: potential_text
    use lagrangia_kinds, only: dp
    use lagrangia_lagrangian_system, only: lagrangian_system_t
    use lagrangia_methods, only: auto, workhorse
    use lagrangia_printed_table, only: left
    use lagrangia_random_draws, only: random_t
    use lagrangia_reference, only: reference_t
    use lagrangia_scene_reader, only: read_named_system
    use lagrangia_scene_reference, only: reference_lines
    use lagrangia_system, only: system_t
    use lagrangia_system_lines, only: line_of_system
    use lagrangia_text, only: join, to_text, word_t
    use lagrangia_time_in_motion, only: motion_contains_time
    implicit none (type, external)
    private
    public :: best_break, describe_command

contains

    subroutine describe_command(line, error)
        !! Print the description of one system, named or of a scene.
        type(command_line_t), intent(in) :: line  !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        class(system_t), allocatable :: system
        type(description_t) :: d, fresh
        integer :: i

        if (size(line%arguments) == 0) then
            call fail(error, "describe what? 'lagrangia list systems' shows the names")
            return
        end if
        if (line%arguments(1)%text == "scene") then
            call put_scene_reference()
            return
        end if
        call read_named_system(line%arguments(1)%text, line%values_of("set"), system, error)
        if (allocated(error)) return
        call system%describe(d)
        call describe_fresh(trim(d%name), fresh)
        if (d%title == "") call put_line(trim(d%name))
        if (d%title /= "") call put_line(trim(d%name)//": "//trim(d%title))
        call put_line("source: "//trim(d%source))
        if (line_of_system(trim(d%name)) /= "") call put_line(line_of_system(trim(d%name)))
        call put_line("")
        call put_line("coordinates")
        do i = 1, size(d%coordinates)
            call put_quantity(d%coordinates(i))
        end do
        call put_line("parameters of &"//trim(d%name))
        do i = 1, size(d%parameters)
            if (allocated(fresh%parameters)) then
                call put_parameter(d%parameters(i), fresh%parameters(i))
            else
                call put_given(d%parameters(i))
            end if
        end do
        call put_formulas(d, system%conserves_energy())
        if (any(d%quantities%conserved)) call put_line("conserved besides")
        do i = 1, size(d%quantities)
            if (d%quantities(i)%conserved) call put_quantity(d%quantities(i))
        end do
        if (.not. all(d%quantities%conserved)) call put_line("other columns")
        do i = 1, size(d%quantities)
            if (.not. d%quantities(i)%conserved) call put_quantity(d%quantities(i))
        end do
        call put_line("all columns of a scene")
        call put_wrapped(join(column_names(system, .true.), ", "))
        call put_line("column error")
        call put_line("  the largest of a coordinate, not of a velocity, absolute below 1 and "// &
                      "relative above")
        call put_line("constraints")
        call put_wrapped(constraint_text(d))
        call put_line("structure")
        call put_line("  "//structure(system))
        if (system%nonconservative) call put_line("  "//potential_text(system))
        call put_line("method = '"//auto//"'")
        if (system%contacts > 0) then
            call put_line("  "//workhorse//", for impacts are looked for between its steps")
        else if (has_closed_form(system)) then
            call put_line("  a closed form where one is known from the start, otherwise "// &
                          workhorse)
        else
            call put_line("  "//workhorse//"; the program has no closed form of it")
        end if
        if (size(d%notes) > 0) call put_line("notes")
        do i = 1, size(d%notes)
            call put_line("  "//trim(d%notes(i)))
        end do
    end subroutine describe_command

    subroutine describe_fresh(name, d)
        !! What the system says with its defaults; nothing of one that only a scene has.
        character(*), intent(in) :: name
        type(description_t), intent(out) :: d
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        call new_system(name, system, error)
        if (.not. allocated(error)) call system%describe(d)
    end subroutine describe_fresh

    subroutine put_parameter(p, default)
        !! `  m   [kg]   mass; default 1.0; greater than 0.0`; another value than the default first.
        type(parameter_t), intent(in) :: p, default
        character(:), allocatable :: value

        value = ""
        if (value_text(p) /= value_text(default)) value = "= "//value_text(p)//", "
        value = value//"default "
        if (p%computed == "") then
            value = value//value_text(default)
        else
            value = value//trim(p%computed)
        end if
        call put_line("  "//left(p%name, 22)//left("["//trim(p%unit)//"]", 12)//trim(p%meaning)// &
                      "; "//value//"; "//p%domain())
    end subroutine put_parameter

    subroutine put_given(p)
        !! `  m   [kg]   mass; = 1.0`, of a system that has no defaults.
        type(parameter_t), intent(in) :: p
        character(:), allocatable :: meaning

        meaning = ""
        if (p%meaning /= "") meaning = trim(p%meaning)//"; "
        call put_line("  "//left(p%name, 22)//left("["//trim(p%unit)//"]", 12)//meaning// &
                      "= "//value_text(p))
    end subroutine put_given

    pure function value_text(p) result(text)
        !! The value, or the components.
        type(parameter_t), intent(in) :: p
        character(:), allocatable :: text
        integer :: k

        text = to_text(p%value(1))
        if (p%whole) text = to_text(nint(p%value(1)))
        do k = 2, p%count
            text = text//", "//to_text(p%value(k))
        end do
    end function value_text

    subroutine put_formulas(d, conserves_energy)
        !! From T and V to the frequencies, as far as the system says them.
        type(description_t), intent(in) :: d
        logical, intent(in) :: conserves_energy
        character(:), allocatable :: letters, start
        integer :: i

        letters = ""
        if (allocated(d%letters)) then
            do i = 1, size(d%letters)
                letters = letters//", "//trim(d%letters(i)%name)//" = "// &
                          trim(d%letters(i)%formula)
            end do
        end if
        if (letters /= "") call put_line("letters")
        if (letters /= "") call put_wrapped(letters(3:))
        if (allocated(d%kinetic_energy)) call put_formula("T =", d%kinetic_energy)
        if (allocated(d%potential_energy)) call put_formula("V =", d%potential_energy)
        if (allocated(d%lagrangian)) then
            call put_formula("L =", d%lagrangian)
        else
            call put_formula("L =", "as the program has it")
        end if
        if (allocated(d%generalised_forces)) then
            call put_line("generalised forces beside L")
            do i = 1, size(d%generalised_forces)
                call put_wrapped(trim(d%generalised_forces(i)))
            end do
        end if
        if (allocated(d%dissipation)) call put_formula("drag: Q = - dR/dq_dot, R =", d%dissipation)
        call put_line("equations of motion")
        do i = 1, size(d%equations)
            call put_wrapped(trim(d%equations(i)))
        end do
        if (size(d%equations) == 0) then
            call put_line("  d/dt dL/dq_dot - dL/dq = "// &
                          merge("Q", "0", allocated(d%generalised_forces))// &
                          ", by exact derivatives of L")
        end if
        if (allocated(d%accelerations)) then
            call put_line("solved")
            do i = 1, size(d%accelerations)
                call put_wrapped(trim(d%accelerations(i)))
            end do
        end if
        if (allocated(d%motion)) then
            start = ""
            do i = 1, size(d%motion)
                start = start//", "//trim(d%coordinates(i)%name)//"_0, "// &
                        trim(d%coordinates(i)%name)//"_dot_0"
            end do
            call put_line("closed form, from"//start(2:)//" at t = 0")
            do i = 1, size(d%motion)
                call put_wrapped(trim(d%motion(i)))
            end do
        end if
        if (allocated(d%frequencies)) then
            call put_line("small oscillations")
            do i = 1, size(d%frequencies)
                call put_wrapped(trim(d%frequencies(i)%equation)//"  about "// &
                                 trim(d%frequencies(i)%equilibrium))
            end do
        end if
        call put_line("energy (v dL/dv - L)"//trim(merge("               ", ", not conserved", &
                                                         conserves_energy)))
        if (allocated(d%energy)) then
            call put_wrapped(d%energy)
        else
            call put_line("  q_dot dL/dq_dot - L, by exact derivatives of L")
        end if
    end subroutine put_formulas

    subroutine put_formula(head, formula)
        !! A line for what it is of, and the formula.
        character(*), intent(in) :: head, formula

        call put_line(head)
        call put_wrapped(formula)
    end subroutine put_formula

    subroutine put_wrapped(text)
        !! Indented by two blanks, by four from the second line on.
        character(*), intent(in) :: text
        integer, parameter :: widest = 96
        character(:), allocatable :: rest, indentation
        integer :: at

        rest = text
        indentation = "  "
        do while (len(rest) > widest)
            at = best_break(rest(:widest))
            if (at == 0) exit
            call put_line(indentation//trim(rest(:at)))
            rest = rest(at + 1:)
            indentation = "    "
        end do
        call put_line(indentation//rest)
    end subroutine put_wrapped

    pure function best_break(text) result(best)
        !! The blank at which a formula is broken best: behind a comma, else in front of a sign
        !! inside as few brackets as can be, and as late as can be; 0 if there is none.
        character(*), intent(in) :: text  !! a formula, cut where the line ends
        integer :: best
        integer :: at, depth, rank, least

        best = 0
        least = huge(least)
        depth = 0
        do at = 2, len(text) - 2
            if (text(at:at) == "(") depth = depth + 1
            if (text(at:at) == ")") depth = depth - 1
            if (text(at:at) /= " ") cycle
            rank = 100
            if (scan(text(at + 1:at + 1), "+-=") == 1) rank = 1 + depth
            if (text(at - 1:at - 1) == ",") rank = depth
            if (rank > least .or. at < len(text)/3) cycle
            least = rank
            best = at
        end do
    end function best_break

    subroutine put_scene_reference()
        !! Every key of a scene file.
        type(word_t), allocatable :: lines(:)
        integer :: i

        call reference_lines(lines)
        do i = 1, size(lines)
            call put_line(lines(i)%text)
        end do
    end subroutine put_scene_reference

    function has_closed_form(system) result(yes)
        !! One is known of the motion from some state, with some parameters: from one of 40 drawn,
        !! in motion or at rest.
        class(system_t), intent(in) :: system  !! with its parameters
        logical :: yes
        class(system_t), allocatable :: drawn
        class(reference_t), allocatable :: reference
        type(random_t) :: random
        type(error_t), allocatable :: error
        real(dp), allocatable :: values(:), q(:), v(:)
        real(dp) :: t
        integer :: i

        yes = .true.
        allocate (drawn, source=system)
        do i = 1, 40
            call random%parameters(drawn, mod(i, 2) == 0, values, error)
            if (.not. allocated(error)) call random%state(drawn, t, q, v, error)
            if (allocated(error)) cycle
            call drawn%closed_form(t, q, v, reference)
            if (allocated(reference)) return
            call drawn%closed_form(t, q, 0.0_dp*v, reference)
            if (allocated(reference)) return
        end do
        yes = .false.
    end function has_closed_form

    subroutine put_quantity(item)
        !! `  tension   [N]   m g cos(theta): force along the rod`; a long formula is on its own.
        type(quantity_t), intent(in) :: item
        character(:), allocatable :: text

        text = "  "//left(item%name, 22)//left("["//trim(item%unit)//"]", 12)
        if (item%formula == "") then
            call put_line(trim(text//item%meaning))
        else if (item%meaning == "" .and. len(text) + len_trim(item%formula) <= 98) then
            call put_line(text//trim(item%formula))
        else if (item%meaning == "") then
            call put_line(trim(text))
            call put_wrapped("  = "//trim(item%formula))
        else if (len(text) + len_trim(item%formula) + len_trim(item%meaning) <= 98) then
            call put_line(text//trim(item%formula)//": "//trim(item%meaning))
        else
            call put_line(text//trim(item%meaning)//",")
            call put_wrapped("  = "//trim(item%formula))
        end if
    end subroutine put_quantity

    pure function structure(system) result(text)
        !! What integrators and tests need to know, in words.
        class(system_t), intent(in) :: system
        character(:), allocatable :: text
        type(description_t) :: d
        logical :: cyclic(system%ndof)
        integer :: i

        call system%describe(d)
        text = to_text(system%ndof - system%constraints)//" degree"// &
               merge("s", " ", system%ndof - system%constraints > 1)
        text = trim(text)//" of freedom; accelerations depend on "
        if (system%velocity_forces) then
            text = text//"positions and velocities"
        else
            text = text//"positions only"
        end if
        if (motion_contains_time(system)) then
            text = text//" and on the time"
        else if (system%time_dependent .and. system%constraints == 0) then
            text = text//", though the time is in L"
        end if
        cyclic = [(i == system%cyclic, i=1, system%ndof)]
        select type (system)
        class is (lagrangian_system_t)
            if (allocated(system%cyclic_coordinates)) cyclic = system%cyclic_coordinates
        end select
        if (.not. any(cyclic)) return
        text = text//"; "//join(pack((d%coordinates%name), cyclic), ", ")// &
               trim(merge(" is cyclic ", " are cyclic", count(cyclic) == 1))
    end function structure
end module lagrangia_describe
