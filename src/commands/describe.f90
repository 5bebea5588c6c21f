module lagrangia_describe
    !! `lagrangia describe SYSTEM`: what a lecturer would write on the blackboard.
    use lagrangia_catalogue, only: new_system
    use lagrangia_command_line, only: command_line_t
    use lagrangia_console, only: put_line
    use lagrangia_description, only: description_t, line_length, quantity_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_kinds, only: dp
    use lagrangia_methods, only: auto, workhorse
    use lagrangia_printed_table, only: left
    use lagrangia_random_draws, only: random_t
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: describe_command, has_closed_form

contains

    subroutine describe_command(line, error)
        !! Print the description of one system.
        type(command_line_t), intent(in) :: line  !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        class(system_t), allocatable :: system
        type(description_t) :: d
        integer :: i

        if (size(line%arguments) == 0) then
            call fail(error, "describe what? 'lagrangia list systems' shows the names")
            return
        end if
        call new_system(line%arguments(1)%text, system, error)
        if (allocated(error)) return
        call system%describe(d)
        call put_line(trim(d%name)//": "//trim(d%title))
        call put_line("source: "//trim(d%source))
        call put_line("")
        call put_line("coordinates")
        do i = 1, size(d%coordinates)
            call put_quantity(d%coordinates(i))
        end do
        call put_line("parameters of &"//trim(d%name))
        do i = 1, size(d%parameters)
            associate (p => d%parameters(i))
                call put_line("  "//left(p%name, 22)//left("["//trim(p%unit)//"]", 12)// &
                              trim(p%meaning)//"; default "//default_text(i)//"; "//p%domain())
            end associate
        end do
        call put_block("L =", d%lagrangian)
        call put_block("equations of motion", d%equations)
        call put_line("energy (v dL/dv - L)"//trim(merge(", not conserved", "               ", &
                                                         system%time_dependent)))
        call put_line("  "//trim(d%energy))
        if (any(d%quantities%conserved)) call put_line("conserved besides")
        do i = 1, size(d%quantities)
            if (d%quantities(i)%conserved) call put_quantity(d%quantities(i))
        end do
        if (.not. all(d%quantities%conserved)) call put_line("other columns")
        do i = 1, size(d%quantities)
            if (.not. d%quantities(i)%conserved) call put_quantity(d%quantities(i))
        end do
        call put_line("column error")
        call put_line("  the largest of a coordinate, not of a velocity, absolute below 1 and "// &
                      "relative above")
        call put_line("constraints")
        call put_line("  "//trim(d%constraint))
        call put_line("structure")
        call put_line("  "//structure(system))
        call put_line("method = '"//auto//"'")
        if (has_closed_form(system)) then
            call put_line("  a closed form where one is known from the start, otherwise "// &
                          workhorse)
        else
            call put_line("  "//workhorse//"; no closed form is known")
        end if
        if (size(d%notes) > 0) call put_block("notes", d%notes)
    contains
        function default_text(i) result(text)
            integer, intent(in) :: i
            character(:), allocatable :: text
            integer :: k

            associate (p => d%parameters(i))
                text = trim(p%computed)
                if (text /= "") return
                text = to_text(p%value(1))
                if (p%whole) text = to_text(nint(p%value(1)))
                do k = 2, p%count
                    text = text//", "//to_text(p%value(k))
                end do
            end associate
        end function default_text
    end subroutine describe_command

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
        !! `  theta   [rad]   angle ...`.
        type(quantity_t), intent(in) :: item

        call put_line("  "//left(item%name, 22)//left("["//trim(item%unit)//"]", 12)// &
                      trim(item%meaning))
    end subroutine put_quantity

    subroutine put_block(title, lines)
        !! A title and its lines, indented.
        character(*), intent(in) :: title, lines(:)
        integer :: i

        call put_line(title)
        do i = 1, size(lines)
            call put_line("  "//trim(lines(i)))
        end do
    end subroutine put_block

    pure function structure(system) result(text)
        !! What integrators and tests need to know, in words.
        class(system_t), intent(in) :: system
        character(:), allocatable :: text
        type(description_t) :: d

        call system%describe(d)
        text = to_text(system%ndof - system%constraints)//" degree"// &
               merge("s", " ", system%ndof - system%constraints > 1)
        text = trim(text)//" of freedom; accelerations depend on "
        if (system%velocity_forces) then
            text = text//"positions and velocities"
        else
            text = text//"positions only"
        end if
        if (system%time_dependent) text = text//" and on the time"
        if (system%cyclic > 0) then
            text = text//"; "//trim(d%coordinates(system%cyclic)%name)//" is cyclic"
        end if
    end function structure
end module lagrangia_describe
