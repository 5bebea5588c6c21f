module lagrangia_identities
    !! Two terms that are one: \(\sin^2 + \cos^2 = 1\), and the sine and cosine of a sum.
    use lagrangia_atoms, only: single_factor, table_t
    use lagrangia_elementary, only: find_function
    use lagrangia_exact_number, only: number_of, operator(-), operator(==)
    use lagrangia_expression, only: f_cos, f_sin
    use lagrangia_kinds, only: dp
    use lagrangia_monomials, only: atom_function, compare, multiply, sum_t, term_t
    use lagrangia_sums, only: add_term, plus, scaled
    implicit none (type, external)
    private
    public :: shorten

contains

    pure subroutine shorten(table, s)
        !! Each identity as often as it makes the sum shorter.
        type(table_t), intent(inout) :: table  !! may have more atoms
        type(sum_t), intent(inout) :: s        !! has fewer terms where that is possible
        integer :: i, k, l
        logical :: again

        again = .true.
        do while (again)
            again = .false.
            search: do i = 1, s%count
                do k = 1, s%terms(i)%count
                    if (.not. is_circular(table, s%terms(i)%atom(k))) cycle
                    if (s%terms(i)%power(k) >= 2) call try_square(table, s, i, k, again)
                    if (again) exit search
                    do l = k + 1, s%terms(i)%count
                        if (.not. is_circular(table, s%terms(i)%atom(l))) cycle
                        if (min(s%terms(i)%power(k), s%terms(i)%power(l)) < 1) cycle
                        call try_product(table, s, i, [k, l], again)
                        if (again) exit search
                    end do
                end do
            end do search
        end do
    end subroutine shorten

    pure function is_circular(table, atom) result(yes)
        !! Is it a sine or a cosine?
        type(table_t), intent(in) :: table
        integer, intent(in) :: atom
        logical :: yes

        associate (a => table%order%atoms(atom))
            yes = a%kind == atom_function .and. (a%which == f_sin .or. a%which == f_cos)
        end associate
    end function is_circular

    pure subroutine try_square(table, s, i, k, done)
        !! \(c M\sin^2 + c M\cos^2 = c M\), \(c M - c M\cos^2 = c M\sin^2\), and the same with the
        !! sine and the cosine exchanged, where factor `k` of term `i` is one of the squares.
        type(table_t), intent(inout) :: table
        type(sum_t), intent(inout) :: s
        integer, intent(in) :: i, k
        logical, intent(out) :: done
        type(term_t) :: bare, turned
        integer :: atom, other, partner
        logical :: fits

        done = .false.
        atom = s%terms(i)%atom(k)
        call exchange(table, s%terms(i), [atom], [0], 2, bare, fits)
        if (.not. fits) return
        partner = conjugate(table, atom)
        if (partner > 0) then
            call exchange(table, s%terms(i), [atom], [partner], 2, turned, fits)
            if (.not. fits) return
            other = place_of(table, s, turned)
            if (other > 0) then
                if (s%terms(other)%coefficient == s%terms(i)%coefficient) then
                    call replace(table, s, i, other, bare)
                    done = .true.
                    return
                end if
            end if
        end if
        other = place_of(table, s, bare)
        if (other == 0) return
        if (.not. s%terms(other)%coefficient == -s%terms(i)%coefficient) return
        call find_conjugate(table, atom, partner)
        call exchange(table, s%terms(i), [atom], [partner], 2, turned, fits)
        if (.not. fits) return
        turned%coefficient = -turned%coefficient
        call replace(table, s, i, other, turned)
        done = .true.
    end subroutine try_square

    pure subroutine try_product(table, s, i, k, done)
        !! \(c M(\cos a\cos b \pm \sin a\sin b) = c M\cos(a \mp b)\),
        !! \(c M(\sin a\cos b \pm \cos a\sin b) = c M\sin(a \pm b)\), where the factors `k` of term
        !! `i` are the first product.
        type(table_t), intent(inout) :: table
        type(sum_t), intent(inout) :: s
        integer, intent(in) :: i, k(2)
        logical, intent(out) :: done
        type(sum_t) :: angle, f, second
        type(term_t) :: bare, new, turned
        integer :: atom(2), other, partner(2), which(2)
        logical :: fits, same

        done = .false.
        atom = s%terms(i)%atom(k)
        which = table%order%atoms(atom)%which
        if (which(1) == f_sin .and. which(2) == f_sin) return  ! the other product is first
        partner = [conjugate(table, atom(1)), conjugate(table, atom(2))]
        if (any(partner == 0 .or. partner == atom([2, 1]))) return
        call exchange(table, s%terms(i), atom, partner, 1, turned, fits)
        if (.not. fits) return
        other = place_of(table, s, turned)
        if (other == 0) return
        same = s%terms(other)%coefficient == s%terms(i)%coefficient
        if (.not. (same .or. s%terms(other)%coefficient == -s%terms(i)%coefficient)) return
        if (which(2) == f_sin) atom = atom([2, 1])
        second = table%sums(table%order%atoms(atom(2))%argument)
        if (same .eqv. which(1) == which(2)) second = scaled(second, number_of(-1.0_dp))
        fits = .true.
        call plus(table%order, table%sums(table%order%atoms(atom(1))%argument), second, angle, fits)
        call exchange(table, s%terms(i), atom, [0, 0], 1, bare, done)
        if (.not. (fits .and. done)) return
        call find_function(table, merge(f_cos, f_sin, which(1) == which(2)), angle, f)
        call multiply(table%order, bare, f%terms(1), new, done)
        if (done) call replace(table, s, i, other, new)
    end subroutine try_product

    pure function conjugate(table, atom) result(partner)
        !! The cosine of the angle of a sine, the sine of that of a cosine; 0 where there is none.
        type(table_t), intent(in) :: table
        integer, intent(in) :: atom
        integer :: partner

        associate (a => table%order%atoms(atom))
            do partner = table%order%count, 1, -1
                associate (b => table%order%atoms(partner))
                    if (b%kind == atom_function .and. b%argument == a%argument .and. &
                        b%which == f_sin + f_cos - a%which) return
                end associate
            end do
        end associate
    end function conjugate

    pure subroutine find_conjugate(table, atom, partner)
        !! The same, made where there is none.
        type(table_t), intent(inout) :: table
        integer, intent(in) :: atom
        integer, intent(out) :: partner
        type(sum_t) :: argument, f

        argument = table%sums(table%order%atoms(atom)%argument)
        call find_function(table, f_sin + f_cos - table%order%atoms(atom)%which, argument, f)
        partner = f%terms(1)%atom(1)
    end subroutine find_conjugate

    pure subroutine exchange(table, term, from, to, power, new, fits)
        !! The term over powers of the atoms `from`, times the same powers of `to`, where not 0.
        type(table_t), intent(in) :: table
        type(term_t), intent(in) :: term
        integer, intent(in) :: from(:), to(:), power
        type(term_t), intent(out) :: new
        logical, intent(out) :: fits
        type(sum_t) :: factor
        type(term_t) :: before
        integer :: k

        new = term
        do k = 1, size(from)
            factor = single_factor(from(k), -power)
            before = new
            call multiply(table%order, before, factor%terms(1), new, fits)
            if (.not. fits) return
            if (to(k) == 0) cycle
            factor = single_factor(to(k), power)
            before = new
            call multiply(table%order, before, factor%terms(1), new, fits)
            if (.not. fits) return
        end do
    end subroutine exchange

    pure function place_of(table, s, term) result(place)
        !! Of the term with these factors; 0 where there is none.
        type(table_t), intent(in) :: table
        type(sum_t), intent(in) :: s
        type(term_t), intent(in) :: term
        integer :: first, found, last, place

        first = 1
        last = s%count
        do while (first <= last)
            place = (first + last)/2
            found = compare(table%order, term, s%terms(place))
            if (found == 0) return
            if (found < 0) last = place - 1
            if (found > 0) first = place + 1
        end do
        place = 0
    end function place_of

    pure subroutine replace(table, s, i, other, new)
        !! One term in the place of two.
        type(table_t), intent(in) :: table
        type(sum_t), intent(inout) :: s
        integer, intent(in) :: i, other
        type(term_t), intent(in) :: new
        type(sum_t) :: rest
        integer :: k

        allocate (rest%terms(s%count))
        do k = 1, s%count
            if (k /= i .and. k /= other) call add_term(table%order, rest, s%terms(k))
        end do
        call add_term(table%order, rest, new)
        s = rest
    end subroutine replace
end module lagrangia_identities
