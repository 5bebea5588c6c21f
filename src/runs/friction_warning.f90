module lagrangia_friction_warning
    !! A force that jumps where a velocity changes its sign, known before a scene runs.
    use lagrangia_description, only: description_t
    use lagrangia_formula_text, only: formula_text
    use lagrangia_system, only: system_t
    use lagrangia_text, only: quoted
    use lagrangia_written_system, only: written_system_t
    implicit none (type, external)
    private
    public :: friction_warning

contains

    function friction_warning(system) result(text)
        !! A line for the user where a generalised force has sgn of a velocity: where dry friction
        !! brings a body to rest it would have to hold it, which no formula of the state says. Of an
        !! own system the forces are read with all definitions written out, whatever their length.
        class(system_t), intent(in) :: system  !! with the scene's parameters
        character(:), allocatable :: text
        type(description_t) :: d
        integer :: i

        text = ""
        select type (system)
        class is (written_system_t)
            do i = 1, size(system%expressions%forces)
                if (text == "") text = warning_of(formula_text(system%expressions%forces(i), &
                                                               system%expressions%symbols))
            end do
        class default
            call system%describe(d)
            if (.not. allocated(d%generalised_forces)) return
            do i = 1, size(d%generalised_forces)
                if (text == "") text = warning_of(trim(d%generalised_forces(i)))
            end do
        end select
    end function friction_warning

    pure function warning_of(force) result(text)
        !! The line, or nothing.
        character(*), intent(in) :: force  !! its formula
        character(:), allocatable :: text

        text = jump_in(force)
        if (text /= "") text = quoted(text)//" jumps where the motion turns: a body that it "// &
            "brings to rest is not held there, and steps become ever shorter; a smooth form is "// &
            "'tanh(x_dot/v0)', as in 'lagrangia show dry_friction'"
    end function warning_of

    pure function jump_in(formula) result(jump)
        !! `sgn(x_dot)`, or nothing.
        character(*), intent(in) :: formula
        character(:), allocatable :: jump
        integer :: first, k, last, open

        jump = ""
        last = 0
        do
            first = index(formula(last + 1:), "sgn(")
            if (first == 0) return
            first = first + last
            open = 0
            do k = first, len(formula)
                if (formula(k:k) == "(") open = open + 1
                if (formula(k:k) == ")") open = open - 1
                last = k
                if (formula(k:k) == ")" .and. open == 0) exit
            end do
            if (index(formula(first:last), "_dot") == 0) cycle
            jump = formula(first:last)
            return
        end do
    end function jump_in
end module lagrangia_friction_warning
