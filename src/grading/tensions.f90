module lagrangia_tensions
    !! T for the force that a string or a rod pulls with.
    use lagrangia_expression, only: expression_t, symbol
    use lagrangia_sample_names, only: role_known, samples_t
    use lagrangia_substitution, only: substituted
    implicit none (type, external)
    private
    public :: read_as_tension, tensions

contains

    pure function tensions(samples) result(number)
        !! How many quantities are forces of strings and rods.
        type(samples_t), intent(in) :: samples  !! know the names
        integer :: number

        number = count(is_tension(samples%symbols%names))
    end function tensions

    elemental function is_tension(name) result(yes)
        !! `tension1`, no rate of it.
        character(*), intent(in) :: name  !! a symbol's
        logical :: yes

        yes = index(name, "tension") == 1 .and. index(name, "dot") == 0
    end function is_tension

    pure subroutine read_as_tension(left, right, samples, which, one, other)
        !! `m1 g - T = m1 x_ddot`: where nothing has a velocity, T is no kinetic energy.
        type(expression_t), intent(in) :: left, right    !! both sides
        type(samples_t), intent(in) :: samples           !! know the names
        integer, intent(in) :: which                     !! of `tensions`
        type(expression_t), intent(out) :: one, other    !! with that force; empty: T is no force
        type(expression_t) :: force(1)
        integer :: k, letter, number

        letter = samples%symbols%find("T")
        if (letter == 0) return
        if (samples%role(letter) /= role_known) return
        if (.not. (left%depends_on(letter) .or. right%depends_on(letter))) return
        number = 0
        do k = 1, size(samples%role)
            if (is_tension(samples%symbols%names(k))) number = number + 1
            if (number == which .and. force(1)%count == 0) force(1) = symbol(k)
            if (k == letter .or. .not. (left%depends_on(k) .or. right%depends_on(k))) cycle
            if (any(samples%symbols%names(k) == ["L", "V", "E"])) return
        end do
        one = substituted(left, [letter], force)
        other = substituted(right, [letter], force)
    end subroutine read_as_tension
end module lagrangia_tensions
