module lagrangia_derive
    !! `lagrangia derive SYSTEM`: the lecture's recipe from the positions of the masses to the
    !! equations of motion and the frequencies, each line compared with what the program computes.
    use lagrangia_aligned_latex, only: aligned_latex
    use lagrangia_certain_digits, only: certain_scientific, share_of
    use lagrangia_command_line, only: command_line_t
    use lagrangia_console, only: put_line
    use lagrangia_derivation, only: derivation_t, line_damped_omega2, line_decay, &
                                    line_equilibrium, line_omega2, line_words
    use lagrangia_derivation_numbers, only: comparison_t, compare_lines
    use lagrangia_derivation_slips, only: find_slip
    use lagrangia_derivation_steps, only: derive, slip_in_formula_t
    use lagrangia_describe, only: best_break
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail, status_not_held
    use lagrangia_formula_latex, only: latex, latex_name
    use lagrangia_formula_text, only: formula_text
    use lagrangia_fortran_module, only: write_fortran_module
    use lagrangia_fortran_statements, only: fortran_lines_t
    use lagrangia_json, only: json_array, json_element, json_item, json_object, json_pair
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_number_text, only: scientific
    use lagrangia_random_draws, only: random_t
    use lagrangia_scene_reader, only: read_named_system
    use lagrangia_system, only: system_t
    use lagrangia_system_lines, only: line_of_system
    use lagrangia_text, only: to_text
    use lagrangia_written_system, only: written_system_t
    implicit none (type, external)
    private
    public :: derive_command

contains

    subroutine derive_command(line, error)
        !! Print the derivation of one system, named or of a scene. Without a slip status 1 where a
        !! line does not hold.
        type(command_line_t), intent(in) :: line          !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(derivation_t) :: derivation
        type(comparison_t), allocatable :: comparisons(:)
        type(slip_in_formula_t) :: slip
        type(random_t) :: random
        real(dp), allocatable :: values(:)

        if (size(line%arguments) == 0) then
            call fail(error, "derive what? 'lagrangia list systems' shows the names")
        else if (line%has("latex") .and. line%has("json")) then
            call fail(error, "the options '--latex' and '--json' do not go together")
        else if (line%has("fortran") .and. any([line%has("latex"), line%has("json"), &
                                                line%has("numbers"), line%has("slip")])) then
            call fail(error, "the option '--fortran' goes with '--set' only")
        end if
        if (allocated(error)) return
        call read_named_system(line%arguments(1)%text, line%values_of("set"), system, error)
        if (allocated(error)) return
        if (line%has("fortran")) then
            call put_fortran(system, line%arguments(1)%text, error)
            return
        end if
        call system%describe(d)
        if (line%has("slip")) call find_slip(line%value_of("slip", ""), trim(d%name), slip, error)
        if (.not. allocated(error)) call derive(system, slip, derivation, error)
        if (.not. allocated(error)) then
            call compare_lines(derivation, system, random, comparisons, error, values)
        end if
        if (allocated(error)) return
        if (line%has("json")) then
            call put_json(derivation, comparisons)
        else if (line%has("latex")) then
            call put_latex(derivation)
        else
            call put_text(derivation, comparisons, values, line%has("numbers"))
        end if
        if (all(comparisons%agrees()) .or. line%has("slip")) return
        call fail(error, trim(d%name)//": a line of the derivation is not what the program "// &
                  "computes", status_not_held)
    end subroutine derive_command

    subroutine put_fortran(system, source, error)
        !! A module; of a system in formulas, since the others are in Fortran.
        class(system_t), intent(in) :: system
        character(*), intent(in) :: source  !! the scene
        type(error_t), allocatable, intent(out) :: error
        type(fortran_lines_t) :: lines
        type(description_t) :: d
        integer :: i

        select type (system)
        class is (written_system_t)
            call write_fortran_module(system, source, lines, error)
        class default
            call system%describe(d)
            call fail(error, trim(d%name)//" is in Fortran already; --fortran is for a scene "// &
                      "with formulas, such as spring_pendulum")
        end select
        if (allocated(error)) return
        do i = 1, size(lines%list)
            call put_line(lines%list(i)%text)
        end do
    end subroutine put_fortran

    subroutine put_text(derivation, comparisons, values, numbers)
        !! For the eye.
        type(derivation_t), intent(in) :: derivation
        type(comparison_t), intent(in) :: comparisons(:)
        real(dp), intent(in) :: values(:)
        logical, intent(in) :: numbers
        logical :: slipped, true_so_far
        character(:), allocatable :: heading
        integer :: at, digits, i, step

        digits = merge(16, 6, numbers)
        heading = trim(derivation%d%name)
        if (derivation%d%title /= "") heading = heading//": "//trim(derivation%d%title)
        call put_line(heading)
        if (line_of_system(trim(derivation%d%name)) /= "") then
            call put_line(line_of_system(trim(derivation%d%name)))
        end if
        if (numbers) call put_state(derivation, values)
        step = 0
        slipped = .false.
        true_so_far = .true.
        do i = 1, derivation%count
            associate (this => derivation%lines(i), c => comparisons(i))
                if (this%heading /= "") then
                    step = step + 1
                    call put_line("")
                    call put_line(to_text(step)//". "//this%heading)
                end if
                if (this%hidden .and. c%agrees()) cycle
                if (this%slipped .and. .not. slipped) call put_line("   as the notes have it:")
                slipped = this%slipped
                at = merge(5, 3, this%left == "" .and. .not. this%is_zero)
                call put_broken(repeat(" ", at), derivation%line_text(i))
                if (.not. c%agrees()) then
                    if (true_so_far) then
                        call put_line("       <- here it leaves the truth: "//both(c, digits))
                    else
                        call put_line("       <- wrong, too: "//both(c, digits))
                    end if
                    true_so_far = .false.
                else if (this%kind == line_words .or. .not. c%known) then
                    cycle
                else if (numbers) then
                    call put_line("       "//both(c, digits))
                else if (this%kind == line_equilibrium .and. is_nonzero(c%program)) then
                    call put_line("       = "//left_of(c%formula, c%noise)//", Newton's method "// &
                                  left_of(c%program, c%noise))
                else if (this%kind == line_decay) then
                    call put_line("       = "//left_of(c%formula, c%noise)//" s^-1, LAPACK "// &
                                  left_of(c%program, c%noise))
                else if (any(this%kind == [line_omega2, line_damped_omega2])) then
                    call put_line("       = "//left_of(c%formula, c%noise)//" s^-2, LAPACK "// &
                                  left_of(c%program, c%noise))
                end if
            end associate
        end do
    end subroutine put_text

    subroutine put_state(derivation, values)
        !! Where the numbers are taken.
        type(derivation_t), intent(in) :: derivation
        real(dp), intent(in) :: values(:)
        character(:), allocatable :: text
        integer :: i

        text = ""
        do i = 1, size(values) - 3
            text = text//", "//trim(derivation%symbols%names(i))//" = "//scientific(values(i), 6)
        end do
        call put_line("each line by the program and by the formula, at a state drawn at random:")
        call put_broken("  ", text(3:))
        call put_line("the last two steps with the accelerations of the motion, and at rest")
    end subroutine put_state

    pure function left_of(value, noise) result(text)
        !! Six digits, or what rounding has left of them.
        real(dp), intent(in) :: value, noise
        character(:), allocatable :: text

        text = certain_scientific(value, share_of(value, noise), 6)
    end function left_of

    function both(c, digits) result(text)
        !! The numbers and their difference.
        type(comparison_t), intent(in) :: c
        integer, intent(in) :: digits
        character(:), allocatable :: text

        text = "program "//scientific(c%program, digits)//", formula "// &
               scientific(c%formula, digits)//", difference "//scientific(c%formula - c%program, 2)
    end function both

    subroutine put_broken(indentation, text)
        !! In lines of at most 98 characters, those after the first further to the right.
        character(*), intent(in) :: indentation, text
        integer, parameter :: widest = 98
        character(:), allocatable :: head, rest
        integer :: at

        head = indentation
        rest = text
        do while (len(head) + len(rest) > widest)
            at = best_break(rest(:widest - len(head)))
            if (at == 0) exit
            call put_line(head//trim(rest(:at)))
            rest = rest(at + 1:)
            head = repeat(" ", len(indentation) + 4)
        end do
        call put_line(head//rest)
    end subroutine put_broken

    subroutine put_latex(derivation)
        !! For slides: a paragraph a step, with `amsmath`.
        type(derivation_t), intent(in) :: derivation
        character(:), allocatable :: right
        logical :: open
        integer :: i

        open = .false.
        call put_line("% needs \usepackage{amsmath}")
        if (line_of_system(trim(derivation%d%name)) /= "") then
            call put_line("% "//line_of_system(trim(derivation%d%name)))
        end if
        do i = 1, derivation%count
            associate (this => derivation%lines(i))
                if (this%heading /= "") then
                    call close_align()
                    call put_line("\paragraph{"//in_latex(this%heading)//"}")
                end if
                if (this%hidden) cycle
                if (this%kind == line_words) then
                    call close_align()
                    call put_line(this%left_latex//"\par")
                    cycle
                end if
                if (open) then
                    call put_line("    \\")
                else
                    call put_line("\begin{align*}")
                end if
                open = .true.
                right = aligned_latex(this%right, derivation%symbols)
                if (this%is_zero) then
                    right = "    & "//right//" = 0"
                else
                    right = "    "//this%left_latex//" & = "//right
                end if
                do while (index(right, new_line("a")) > 0)
                    call put_line(right(:index(right, new_line("a")) - 1))
                    right = right(index(right, new_line("a")) + 1:)
                end do
                call put_line(right)
            end associate
        end do
        call close_align()
    contains
        function in_latex(heading) result(text)
            ! with the coordinate at its end, if there is one, as a formula
            character(*), intent(in) :: heading
            character(:), allocatable :: text
            integer :: last

            text = heading
            last = index(heading, " ", back=.true.)
            if (any(derivation%d%coordinates%name == heading(last + 1:))) text = &
                heading(:last)//"$"//latex_name(heading(last + 1:))//"$"
        end function in_latex

        subroutine close_align()
            if (open) call put_line("\end{align*}")
            open = .false.
        end subroutine close_align
    end subroutine put_latex

    subroutine put_json(derivation, comparisons)
        !! Everything.
        type(derivation_t), intent(in) :: derivation
        type(comparison_t), intent(in) :: comparisons(:)
        character(:), allocatable :: cited, members, rows, step
        integer :: i

        rows = ""
        step = ""
        do i = 1, derivation%count
            associate (this => derivation%lines(i), c => comparisons(i))
                if (this%heading /= "") step = this%heading
                members = json_pair("step", step)//json_pair("line", derivation%line_text(i))
                if (this%kind /= line_words) then
                    members = members//json_pair("formula", formula_text(this%right, &
                                                                         derivation%symbols)) &
                              //json_pair("latex", latex(this%right, derivation%symbols)) &
                              //json_pair("value", c%formula)
                    if (c%known) members = members//json_pair("program", c%program) &
                                           //json_pair("holds", c%agrees())
                    if (this%slipped) members = members//json_pair("slip", .true.)
                end if
                rows = rows//json_element(json_object(members))
            end associate
        end do
        cited = line_of_system(trim(derivation%d%name))
        if (cited /= "") cited = json_pair("notes", cited)
        call put_line(json_object(json_pair("system", trim(derivation%d%name))//cited// &
                                  json_pair("holds", all(comparisons%agrees()))// &
                                  json_item("lines", json_array(rows))))
    end subroutine put_json
end module lagrangia_derive
