module printed_statements
    !! What a description prints, judged against the system: T, V, L, energy, equations of motion,
    !! constraints, quantities and what each reaction holds, read as text.
    use formula, only: formula_value, names_t
    use lagrangia_description, only: description_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    use printed_names, only: name_state
    implicit none (type, external)
    private
    public :: judge_all, tally_t

    real(dp), parameter :: rounding = 1e-11_dp
    !! of a few dozen operations and of angles of some ten radians, of the sum of the terms

    type :: tally_t
        integer :: right = 0, wrong = 0
        character(400) :: first = ""  !! that is wrong, or cannot be read
    contains
        procedure :: judge
        procedure :: miss
    end type tally_t

contains

    subroutine judge_all(system, d, t, q, v, tally)
        !! Everything that this description states.
        class(system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        real(dp), intent(in) :: t, q(:), v(:)
        type(tally_t), intent(inout) :: tally
        type(names_t) :: names
        type(hyperdual_t) :: l
        integer :: i

        call name_state(system, t, q, v, names)
        l = system%lagrangian(hyperdual(t), hyperdual(q), hyperdual(v))
        call value_is(d%lagrangian, l%re)
        call value_is(d%kinetic_energy, names%value_of("T"))
        call value_is(d%kinetic_energy//" - ("//d%potential_energy//")", l%re)
        call value_is(d%energy, system%energy(t, q, v))
        do i = 1, size(d%equations)
            call statement(trim(d%equations(i)))
        end do
        if (allocated(d%accelerations)) then
            do i = 1, size(d%accelerations)
                call statement(trim(d%accelerations(i)))
            end do
        end if
        if (allocated(d%constraint_equations)) then
            do i = 1, size(d%constraint_equations)
                call statement(trim(d%constraint_equations(i)))
            end do
        end if
        do i = 1, size(d%quantities)
            call value_is(trim(d%quantities(i)%formula), system%quantity(i, t, q, v))
        end do
        do i = 1, size(d%reactions)
            if (d%reactions(i)%formula /= "") call value_is(trim(d%reactions(i)%formula), 0.0_dp)
        end do
    contains
        subroutine value_is(printed, expected)
            character(*), intent(in) :: printed
            real(dp), intent(in) :: expected
            real(dp) :: value, size_of
            logical :: ok

            call formula_value(printed, names, value, size_of, ok)
            call tally%judge(trim(d%name)//": "//printed, value, expected, size_of, ok)
        end subroutine value_is

        subroutine statement(printed)
            !! An equation, or an inequality.
            character(*), intent(in) :: printed
            real(dp) :: left, right, size_of_left, size_of_right
            integer :: behind
            logical :: ok, fine

            behind = index(printed, "=") - 1
            if (index(printed, ">=") > 0) behind = index(printed, ">=") - 1
            call formula_value(printed(:behind), names, left, size_of_left, ok)
            fine = ok
            call formula_value(printed(index(printed, "=") + 1:), names, right, size_of_right, ok)
            fine = fine .and. ok
            if (index(printed, ">=") > 0) left = min(left, right)
            call tally%judge(trim(d%name)//": "//printed, left, right, &
                             size_of_left + size_of_right, fine)
        end subroutine statement
    end subroutine judge_all

    subroutine judge(self, what, left, right, size_of, ok)
        !! Equal but for rounding, and read to the end.
        class(tally_t), intent(inout) :: self
        character(*), intent(in) :: what
        real(dp), intent(in) :: left, right, size_of
        logical, intent(in) :: ok

        if (ok .and. abs(left - right) <= rounding*size_of) then
            self%right = self%right + 1
        else
            call self%miss(what)
        end if
    end subroutine judge

    subroutine miss(self, what)
        !! One more that is wrong.
        class(tally_t), intent(inout) :: self
        character(*), intent(in) :: what

        self%wrong = self%wrong + 1
        if (self%first == "") self%first = what
    end subroutine miss
end module printed_statements
