module lagrangia_reduction
    !! Powers of sums, and what they become when they meet their like: \((a + b)/(a + b) = 1\),
    !! \(\sqrt{a}^2 = a\).
    use lagrangia_atoms, only: find_atom, single_factor, table_t
    use lagrangia_exact_number, only: number_of, operator(/), power
    use lagrangia_expression, only: f_abs, f_sqrt
    use lagrangia_identities, only: shorten
    use lagrangia_kinds, only: dp
    use lagrangia_monomials, only: atom_function, atom_sum, inverse, multiply, power_of, sum_t, &
                                   term_t, without
    use lagrangia_signs, only: join_signs
    use lagrangia_sums, only: add_term, common_factor, constant_sum, divide_exactly, equal_sums, &
                              plus, raise, times
    implicit none (type, external)
    private
    public :: reduce, whole_power

    integer, parameter :: highest = 6      !! powers of sums that are multiplied out
    integer, parameter :: most_terms = 60  !! that a power may have then, roughly

contains

    pure recursive subroutine whole_power(table, s, n, result, fits)
        !! \(s^n\).
        type(table_t), intent(inout) :: table  !! may have one more atom
        type(sum_t), intent(in) :: s           !! any
        integer, intent(in) :: n               !! less than 1000 in size
        type(sum_t), intent(out) :: result     !! \(s^n\)
        logical, intent(inout) :: fits         !! becomes false if it is too long, or \(1/0\)
        type(sum_t) :: none, primitive, reduced, scale
        type(term_t) :: factor
        integer :: atom

        if (n == 0) then
            result = constant_sum(number_of(1.0_dp))
        else if (s%count == 0) then
            fits = fits .and. n > 0
        else if (s%count == 1) then
            call term_power(s%terms(1), n, result, fits)
            if (fits) call reduce(table, result, fits)
        else if (is_short(s, n)) then
            call raise(table%order, s, n, result, fits)
        else
            factor = common_factor(table%order, s, .true.)
            call divided(table, s, factor, primitive, fits)
            if (.not. fits) return
            reduced = primitive
            call reduce(table, reduced, fits)
            if (.not. fits) return
            if (equal_sums(primitive, reduced)) then
                call find_atom(table, atom_sum, 0, primitive, none, atom)
                reduced = single_factor(atom, n)
            else
                call whole_power(table, reduced, n, primitive, fits)
                if (.not. fits) return
                reduced = primitive
            end if
            call term_power(factor, n, scale, fits)
            if (fits) call times(table%order, scale, reduced, result, fits)
        end if
    end subroutine whole_power

    pure function is_short(s, n) result(yes)
        !! Is the power multiplied out?
        type(sum_t), intent(in) :: s
        integer, intent(in) :: n
        logical :: yes

        yes = n > 0 .and. n <= highest
        if (yes) yes = real(s%count, dp)**n <= 8.0_dp*most_terms .or. n == 1
    end function is_short

    pure subroutine term_power(term, n, result, fits)
        !! \((c\,a^p b^q)^n = c^n a^{pn} b^{qn}\)
        type(term_t), intent(in) :: term
        integer, intent(in) :: n
        type(sum_t), intent(out) :: result
        logical, intent(inout) :: fits

        allocate (result%terms(1))
        result%count = 1
        result%terms(1) = term
        result%terms(1)%power = term%power*n
        result%terms(1)%coefficient = power(term%coefficient, n)
        fits = fits .and. abs(result%terms(1)%coefficient%value) <= 1e100_dp .and. &
               abs(result%terms(1)%coefficient%value) >= 1e-100_dp .and. &
               all(abs(term%power(:term%count)) < 1000)
    end subroutine term_power

    pure subroutine divided(table, s, factor, result, fits)
        !! The sum over a monomial.
        type(table_t), intent(in) :: table
        type(sum_t), intent(in) :: s
        type(term_t), intent(in) :: factor
        type(sum_t), intent(out) :: result
        logical, intent(inout) :: fits
        type(term_t) :: opposite, term
        logical :: enough
        integer :: i

        opposite = inverse(factor)
        opposite%coefficient = number_of(1.0_dp)/factor%coefficient
        do i = 1, s%count
            call multiply(table%order, s%terms(i), opposite, term, enough)
            fits = fits .and. enough
            if (.not. fits) return
            call add_term(table%order, result, term)
        end do
    end subroutine divided

    pure recursive subroutine reduce(table, s, fits)
        !! Until there is nothing left to do.
        type(table_t), intent(inout) :: table  !! may have more atoms
        type(sum_t), intent(inout) :: s        !! becomes shorter or simpler
        logical, intent(inout) :: fits         !! becomes false if it is too long
        integer, parameter :: most = 1000
        integer :: trial
        logical :: changed

        if (.not. allocated(s%terms)) allocate (s%terms(1))
        do trial = 1, most
            call join_signs(table, s, changed, fits)
            if (.not. fits) return
            if (changed) cycle
            call multiply_out(table, s, changed, fits)
            if (.not. fits) return
            if (changed) cycle
            call shorten(table, s)
            call cancel(table, s, changed, fits)
            if (.not. (fits .and. changed)) return
        end do
        fits = .false.
    end subroutine reduce

    pure recursive subroutine multiply_out(table, s, changed, fits)
        !! The first factor that is no longer one: a sum to a positive power, the square of a root
        !! or of a modulus.
        type(table_t), intent(inout) :: table
        type(sum_t), intent(inout) :: s
        logical, intent(out) :: changed
        logical, intent(inout) :: fits
        type(sum_t) :: base, factor, product, rest, single
        integer :: i, k, n, left_over

        changed = .false.
        do i = 1, s%count
            do k = 1, s%terms(i)%count
                n = s%terms(i)%power(k)
                left_over = 0
                associate (atom => table%order%atoms(s%terms(i)%atom(k)))
                    if (atom%kind == atom_function .and. atom%which == f_sqrt) then
                        left_over = mod(n, 2)
                        n = n/2
                        if (n == 0) cycle
                    else if (atom%kind == atom_function .and. atom%which == f_abs) then
                        if (mod(n, 2) /= 0) cycle
                    else if (atom%kind /= atom_sum) then
                        cycle
                    end if
                    base = table%sums(atom%argument)
                    if (atom%kind == atom_sum .and. .not. is_short(base, n)) cycle
                end associate
                changed = .true.
                call whole_power(table, base, n, factor, fits)
                if (.not. fits) return
                allocate (single%terms(1))
                single%count = 1
                single%terms(1) = without(s%terms(i), s%terms(i)%atom(k))
                if (left_over /= 0) then
                    call times(table%order, single, single_factor(s%terms(i)%atom(k), left_over), &
                               product, fits)
                    single = product
                end if
                call times(table%order, single, factor, product, fits)
                if (.not. fits) return
                rest = s
                rest%terms(i:rest%count - 1) = rest%terms(i + 1:rest%count)
                rest%count = rest%count - 1
                call plus(table%order, rest, product, s, fits)
                if (.not. allocated(s%terms)) allocate (s%terms(1))
                return
            end do
        end do
    end subroutine multiply_out

    pure subroutine cancel(table, s, changed, fits)
        !! \((a^2 - b^2)/(a + b) = a - b\): the terms with the lowest power of a sum, if it divides
        !! what they have beside it.
        type(table_t), intent(in) :: table
        type(sum_t), intent(inout) :: s
        logical, intent(out) :: changed
        logical, intent(inout) :: fits
        type(sum_t) :: above, kept, product, quotient
        integer :: atom, i, lowest
        logical :: divides

        changed = .false.
        do atom = 1, table%order%count
            if (table%order%atoms(atom)%kind /= atom_sum) cycle
            lowest = 0
            do i = 1, s%count
                lowest = min(lowest, power_of(s%terms(i), atom))
            end do
            if (lowest == 0) cycle
            above = sum_t()
            kept = sum_t()
            do i = 1, s%count
                if (power_of(s%terms(i), atom) == lowest) then
                    call add_term(table%order, above, without(s%terms(i), atom))
                else
                    call add_term(table%order, kept, s%terms(i))
                end if
            end do
            call divide_exactly(table%order, above, &
                                table%sums(table%order%atoms(atom)%argument), quotient, divides)
            if (.not. divides) cycle
            if (lowest < -1) then
                call times(table%order, quotient, single_factor(atom, lowest + 1), product, fits)
                quotient = product
            end if
            call plus(table%order, kept, quotient, s, fits)
            if (.not. allocated(s%terms)) allocate (s%terms(1))
            changed = .true.
            return
        end do
    end subroutine cancel
end module lagrangia_reduction
