module lagrangia_friction_warning
    !! A force that jumps where a velocity changes its sign, known before a scene runs.
    use lagrangia_description, only: description_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: quoted
    implicit none (type, external)
    private
    public :: friction_warning

contains

    function friction_warning(system) result(text)
        !! A line for the user where a generalised force has sgn of a velocity: where dry friction
        !! brings a body to rest it would have to hold it, which no formula of the state says.
        class(system_t), intent(in) :: system  !! with the scene's parameters
        character(:), allocatable :: text
        type(description_t) :: d
        character(:), allocatable :: jump
        integer :: i

        text = ""
        call system%describe(d)
        if (.not. allocated(d%generalised_forces)) return
        do i = 1, size(d%generalised_forces)
            jump = jump_in(trim(d%generalised_forces(i)))
            if (jump == "") cycle
            text = quoted(jump)//" jumps where the motion turns: a body that it brings to rest "// &
                   "is not held there, and steps become ever shorter; a smooth form is "// &
                   "'tanh(x_dot/v0)', as in 'lagrangia show dry_friction'"
            return
        end do
    end function friction_warning

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
