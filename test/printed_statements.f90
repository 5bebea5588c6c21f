module printed_statements
    !! What a description prints, judged against the system: L, energy, equations of motion,
    !! constraints, quantities and what each reaction holds, read as text.
    use formula, only: formula_value, names_t
    use lagrangia_description, only: description_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    use printed_names, only: name_component, name_link, name_state
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

    subroutine judge_all(system, d, t, q, v, in_words, tally)
        !! Everything that this description states.
        class(system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        real(dp), intent(in) :: t, q(:), v(:)
        character(*), intent(in) :: in_words
        type(tally_t), intent(inout) :: tally
        type(names_t) :: names
        type(hyperdual_t) :: l
        character(:), allocatable :: text
        integer :: i, component

        call name_state(system, t, q, v, names)
        if (d%name == "charged_particle") call name_component(system, t, q, v, 1, names)
        if (d%name == "hanging_chain") call name_link(system, t, q, v, 2, names)
        l = system%lagrangian(hyperdual(t), hyperdual(q), hyperdual(v))
        text = ""
        do i = 1, size(d%lagrangian)
            if (index(d%lagrangian(i), "x_k = ") == 1) text = text//", "
            text = text//" "//trim(d%lagrangian(i))
        end do
        call value_is(text, l%re)
        call value_is(trim(d%energy), system%energy(t, q, v))
        text = trim(d%equations(1))
        do i = 2, size(d%equations)
            if (d%equations(i) (1:1) /= " ") text = text//",  "
            text = text//" "//trim(adjustl(d%equations(i)))
        end do
        if (d%name == "bouncing_ball") text = after(text(:index(text, ",  ") - 1), "y > 0: ")
        call statements(text, ",  ")
        if (index(d%constraint, "none") /= 1) call statements(after(trim(d%constraint), ": "), ", ")
        do i = 1, size(d%quantities)
            if (index(in_words, " "//trim(d%name)//"."//trim(d%quantities(i)%name)//" ") > 0) cycle
            text = trim(d%quantities(i)%meaning)
            text = text(:index(text//": ", ": ") - 1)
            component = index("xyz", text(len(text):))
            if (index(text, ")_") == len(text) - 2 .and. component > 0) then
                call name_component(system, t, q, v, component, names)
                text = text(:len(text) - 2)
            end if
            text = after(text, " = ")
            call value_is(text, system%quantity(i, t, q, v))
        end do
        do i = 1, size(d%reactions)
            if (d%name == "hanging_chain") exit  ! of vectors r_k
            call statements(after(trim(d%reactions(i)%meaning), ": "), ", ")
        end do
    contains
        subroutine value_is(printed, expected)
            character(*), intent(in) :: printed
            real(dp), intent(in) :: expected
            real(dp) :: value, size_of, part, size_of_part
            integer :: end_of, link
            logical :: ok

            end_of = index(printed//", ", ", ") - 1
            if (end_of < len(printed)) call statements(printed(end_of + 2:), ", ")
            if (index(adjustl(printed), "sum over k of") == 1) then
                value = 0.0_dp
                size_of = 0.0_dp
                do link = 1, size(q)
                    call name_link(system, t, q, v, link, names)
                    call formula_value(printed(index(printed, " of ") + 4:end_of), names, part, &
                                       size_of_part, ok)
                    value = value + part
                    size_of = size_of + size_of_part
                end do
            else
                call formula_value(printed(:end_of), names, value, size_of, ok)
            end if
            call tally%judge(trim(d%name)//": "//printed(:end_of), value, expected, size_of, ok)
        end subroutine value_is

        subroutine statements(printed, separator)
            !! Equations, definitions and inequalities; a condition such as k > 1 states nothing.
            character(*), intent(in) :: printed, separator
            character(:), allocatable :: rest, one
            real(dp) :: left, right, size_of_left, size_of_right
            integer :: part, behind, last
            logical :: ok, fine

            rest = printed
            last = 1
            if (d%name == "charged_particle") last = 3
            if (d%name == "hanging_chain") last = size(q) - 1
            do while (len_trim(rest) > 0)
                behind = index(rest//separator, separator)
                one = trim(adjustl(rest(:behind - 1)))
                rest = rest(min(len(rest) + 1, behind + len(separator)):)
                if (one == "k > 1") cycle
                one = after(one, "without lambda: ")
                behind = index(one, "=")
                ok = .true.
                fine = .true.
                do part = 1, last
                    if (d%name == "charged_particle") then
                        call name_component(system, t, q, v, part, names)
                    else if (d%name == "hanging_chain") then
                        call name_link(system, t, q, v, part + 1, names)
                    end if
                    if (index(one, ">=") > 0) behind = index(one, ">=")
                    call formula_value(one(:behind - 1), names, left, size_of_left, ok)
                    fine = fine .and. ok
                    call formula_value(one(index(one, "=") + 1:), names, right, size_of_right, ok)
                    fine = fine .and. ok
                    if (index(one, ">=") > 0) left = min(left, right)
                    fine = fine .and. abs(left - right) <= rounding*(size_of_left + size_of_right)
                end do
                call tally%judge(trim(d%name)//": "//one, left, right, &
                                 size_of_left + size_of_right, fine)
            end do
        end subroutine statements
    end subroutine judge_all

    pure function after(text, mark) result(rest)
        !! What is behind the first mark, or all.
        character(*), intent(in) :: text, mark
        character(:), allocatable :: rest

        rest = text
        if (index(text, mark) > 0) rest = text(index(text, mark) + len(mark):)
    end function after

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
