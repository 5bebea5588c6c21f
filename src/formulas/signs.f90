module lagrangia_signs
    !! What the sign of a number becomes beside its like: \(|u|\,\mathrm{sgn}\,u = u\),
    !! \(x\,\mathrm{sgn}\,x = |x|\), \(\mathrm{sgn}^2 u = 1\), which at \(u = 0\) does not hold.
    use lagrangia_atoms, only: find_atom, single_factor, table_t
    use lagrangia_expression, only: f_abs, f_sgn
    use lagrangia_monomials, only: atom_function, power_of, sum_t, without
    use lagrangia_sums, only: equal_sums, plus, times
    implicit none (type, external)
    private
    public :: join_signs

contains

    pure subroutine join_signs(table, s, changed, fits)
        !! The first sign that has its like beside it.
        type(table_t), intent(inout) :: table  !! may have one more atom
        type(sum_t), intent(inout) :: s        !! any
        logical, intent(out) :: changed        !! there was one
        logical, intent(inout) :: fits         !! becomes false if the sum is too long
        integer :: atom, i, k

        changed = .false.
        do i = 1, s%count
            do k = 1, s%terms(i)%count
                atom = s%terms(i)%atom(k)
                associate (found => table%order%atoms(atom))
                    if (found%kind /= atom_function .or. found%which /= f_sgn) cycle
                end associate
                call join_sign(table, s, i, atom, changed, fits)
                if (changed .or. .not. fits) return
            end do
        end do
    end subroutine join_signs

    pure subroutine join_sign(table, s, i, sign, changed, fits)
        !! One of them, a factor of term `i`.
        type(table_t), intent(inout) :: table
        type(sum_t), intent(inout) :: s
        integer, intent(in) :: i, sign
        logical, intent(out) :: changed
        logical, intent(inout) :: fits
        type(sum_t) :: argument, joined, none, rest
        integer :: bars, partner, power

        argument = table%sums(table%order%atoms(sign)%argument)
        call find_atom(table, atom_function, f_abs, argument, none, bars)
        partner = 0
        if (power_of(s%terms(i), bars) > 0) then
            partner = bars
            joined = argument
        else if (argument%count == 1) then
            associate (u => argument%terms(1))
                if (u%count == 1 .and. u%power(1) == 1) partner = u%atom(1)
            end associate
            if (partner > 0) then
                if (.not. (equal_sums(argument, single_factor(partner, 1)) .and. &
                           power_of(s%terms(i), partner) > 0)) partner = 0
            end if
            if (partner > 0) joined = single_factor(bars, 1)
        end if
        changed = partner > 0 .or. power_of(s%terms(i), sign) /= 1
        if (.not. changed) return
        allocate (rest%terms(1))
        rest%count = 1
        rest%terms(1) = without(without(s%terms(i), sign), partner)
        power = modulo(power_of(s%terms(i), sign) - merge(1, 0, partner > 0), 2)
        if (power > 0) call multiply_by(table, rest, single_factor(sign, power), fits)
        if (partner > 0) then
            power = power_of(s%terms(i), partner) - 1
            if (power > 0) call multiply_by(table, rest, single_factor(partner, power), fits)
            call multiply_by(table, rest, joined, fits)
        end if
        s%terms(i:s%count - 1) = s%terms(i + 1:s%count)
        s%count = s%count - 1
        joined = s
        call plus(table%order, joined, rest, s, fits)
        if (.not. allocated(s%terms)) allocate (s%terms(1))
    end subroutine join_sign

    pure subroutine multiply_by(table, s, factor, fits)
        !! A sum by another.
        type(table_t), intent(in) :: table
        type(sum_t), intent(inout) :: s
        type(sum_t), intent(in) :: factor
        logical, intent(inout) :: fits
        type(sum_t) :: product

        call times(table%order, s, factor, product, fits)
        s = product
    end subroutine multiply_by
end module lagrangia_signs
