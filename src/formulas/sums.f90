module lagrangia_sums
    !! Sums of monomials: added, multiplied, divided where that leaves no rest.
    use lagrangia_exact_number, only: common_measure, number_of, number_t, operator(+), &
                                      operator(-), operator(*), operator(/), operator(==)
    use lagrangia_kinds, only: dp
    use lagrangia_monomials, only: compare, inverse, multiply, order_t, power_of, sum_t, term_t
    implicit none (type, external)
    private
    public :: add_term, common_factor, constant_sum, divide_exactly, equal_sums, is_constant, &
              plus, raise, scaled, times

    integer, parameter :: most_terms = 300

contains

    pure subroutine add_term(order, s, new)
        !! Where it belongs; a term with the same factors is added to, or goes if nothing is left.
        type(order_t), intent(in) :: order  !! of the atoms
        type(sum_t), intent(inout) :: s     !! grows or shrinks
        type(term_t), intent(in) :: new     !! any
        type(term_t), allocatable :: larger(:)
        integer :: first, found, last, middle

        if (new%coefficient%is_zero()) return
        if (.not. allocated(s%terms)) allocate (s%terms(4))
        first = 1
        last = s%count
        do while (first <= last)
            middle = (first + last)/2
            found = compare(order, new, s%terms(middle))
            if (found == 0) then
                s%terms(middle)%coefficient = s%terms(middle)%coefficient + new%coefficient
                if (.not. s%terms(middle)%coefficient%is_zero()) return
                s%terms(middle:s%count - 1) = s%terms(middle + 1:s%count)
                s%count = s%count - 1
                return
            else if (found < 0) then
                last = middle - 1
            else
                first = middle + 1
            end if
        end do
        if (s%count == size(s%terms)) then
            allocate (larger(2*s%count))
            larger(:s%count) = s%terms
            call move_alloc(larger, s%terms)
        end if
        s%terms(first + 1:s%count + 1) = s%terms(first:s%count)
        s%terms(first) = new
        s%count = s%count + 1
    end subroutine add_term

    pure function constant_sum(value) result(s)
        !! A number as a sum; zero has no terms.
        type(number_t), intent(in) :: value  !! finite
        type(sum_t) :: s

        allocate (s%terms(1))
        s%terms(1)%coefficient = value
        if (.not. value%is_zero()) s%count = 1
    end function constant_sum

    pure function is_constant(s) result(yes)
        !! Is it a number?
        type(sum_t), intent(in) :: s  !! any
        logical :: yes

        yes = s%count == 0
        if (s%count == 1) yes = s%terms(1)%count == 0
    end function is_constant

    pure function equal_sums(a, b) result(yes)
        !! The same terms with the same coefficients?
        type(sum_t), intent(in) :: a, b  !! of the same atoms
        logical :: yes
        integer :: i, n

        yes = a%count == b%count
        do i = 1, a%count
            if (.not. yes) return
            n = a%terms(i)%count
            yes = n == b%terms(i)%count .and. a%terms(i)%coefficient == b%terms(i)%coefficient
            if (.not. yes) return
            yes = all(a%terms(i)%atom(:n) == b%terms(i)%atom(:n)) .and. &
                  all(a%terms(i)%power(:n) == b%terms(i)%power(:n))
        end do
    end function equal_sums

    pure subroutine plus(order, a, b, c, fits)
        !! \(c = a + b\).
        type(order_t), intent(in) :: order   !! of the atoms
        type(sum_t), intent(in) :: a, b      !! any
        type(sum_t), intent(out) :: c        !! their sum
        logical, intent(inout) :: fits       !! becomes false if there are too many terms
        integer :: i

        c = a
        do i = 1, b%count
            call add_term(order, c, b%terms(i))
        end do
        fits = fits .and. c%count <= most_terms
    end subroutine plus

    pure subroutine times(order, a, b, c, fits)
        !! \(c = ab\).
        type(order_t), intent(in) :: order   !! of the atoms
        type(sum_t), intent(in) :: a, b      !! any
        type(sum_t), intent(out) :: c        !! their product
        logical, intent(inout) :: fits       !! becomes false if there are too many terms or factors
        type(term_t) :: term
        logical :: enough
        integer :: i, j

        fits = fits .and. a%count*b%count <= 4*most_terms
        if (.not. fits) return
        do i = 1, a%count
            do j = 1, b%count
                call multiply(order, a%terms(i), b%terms(j), term, enough)
                fits = fits .and. enough
                if (.not. fits) return
                call add_term(order, c, term)
            end do
        end do
        fits = fits .and. c%count <= most_terms
    end subroutine times

    pure subroutine raise(order, a, n, c, fits)
        !! \(c = a^n\), multiplied out.
        type(order_t), intent(in) :: order  !! of the atoms
        type(sum_t), intent(in) :: a        !! any
        integer, intent(in) :: n            !! not negative
        type(sum_t), intent(out) :: c       !! the power
        logical, intent(inout) :: fits      !! becomes false if there are too many terms or factors
        type(sum_t) :: next
        integer :: k

        c = constant_sum(number_of(1.0_dp))
        do k = 1, n
            call times(order, c, a, next, fits)
            if (.not. fits) return
            c = next
        end do
    end subroutine raise

    pure function scaled(a, factor) result(b)
        !! A sum with all its coefficients multiplied.
        type(sum_t), intent(in) :: a            !! any
        type(number_t), intent(in) :: factor    !! not 0
        type(sum_t) :: b
        integer :: i

        b = a
        do i = 1, a%count
            b%terms(i)%coefficient = a%terms(i)%coefficient*factor
        end do
    end function scaled

    pure function common_factor(order, s, clear) result(factor)
        !! What all terms have in common: powers of one sign of a factor, the lowest of them, and
        !! the largest fraction of which all coefficients are whole multiples, with the sign of the
        !! first.
        type(order_t), intent(in) :: order  !! of the atoms
        type(sum_t), intent(in) :: s        !! of one term at least
        logical, intent(in) :: clear        !! also what some terms are divided by
        type(term_t) :: factor
        type(term_t) :: known, next, single
        type(number_t), allocatable :: coefficients(:)
        integer :: i, k, power
        logical :: fits

        do i = 1, s%count
            do k = 1, s%terms(i)%count
                if (power_of(known, s%terms(i)%atom(k)) > 0) cycle
                single = term_t(number_of(1.0_dp), 1)
                single%atom(1) = s%terms(i)%atom(k)
                single%power(1) = 1
                call multiply(order, known, single, next, fits)
                if (.not. fits) exit
                known = next
                power = shared_power(s, single%atom(1), clear)
                if (power == 0) cycle
                single%power(1) = power
                call multiply(order, factor, single, next, fits)
                if (fits) factor = next
            end do
        end do
        coefficients = s%terms(:s%count)%coefficient
        factor%coefficient = number_of(sign(1.0_dp, coefficients(1)%value)) &
                             *common_measure(coefficients)
    end function common_factor

    pure function shared_power(s, atom, clear) result(power)
        !! The lowest power of an atom, if all are positive, or all negative, or some are, with
        !! `clear`; else 0.
        type(sum_t), intent(in) :: s
        integer, intent(in) :: atom
        logical, intent(in) :: clear
        integer :: power, highest, i, n

        power = huge(1)
        highest = -huge(1)
        do i = 1, s%count
            n = power_of(s%terms(i), atom)
            power = min(power, n)
            highest = max(highest, n)
        end do
        if (power < 0 .and. highest >= 0 .and. .not. clear) power = 0
    end function shared_power

    pure subroutine divide_exactly(order, a, b, quotient, divides)
        !! \(a = qb\), if there is such a sum \(q\).
        type(order_t), intent(in) :: order     !! of the atoms
        type(sum_t), intent(in) :: a, b        !! \(b\) with two terms at least, no common factor
        type(sum_t), intent(out) :: quotient   !! \(q\)
        logical, intent(out) :: divides        !! whether there is one
        type(sum_t) :: rest
        type(term_t) :: lead, step, lowest, product
        logical :: fits
        integer :: i, k, trial

        divides = .false.
        if (a%count < b%count) return
        rest = a
        lowest = common_lowest(a, b)
        lead = inverse(b%terms(1))
        do trial = 1, 4*most_terms
            if (rest%count == 0) exit
            call multiply(order, rest%terms(1), lead, step, fits)
            if (.not. fits) return
            do k = 1, lowest%count
                if (power_of(step, lowest%atom(k)) < lowest%power(k)) return
            end do
            step%coefficient = rest%terms(1)%coefficient/b%terms(1)%coefficient
            call add_term(order, quotient, step)
            step%coefficient = number_of(0.0_dp) - step%coefficient
            call multiply(order, step, b%terms(1), product, fits)
            call remove_first(rest)
            do i = 2, b%count
                call multiply(order, step, b%terms(i), product, fits)
                if (.not. fits) return
                call add_term(order, rest, product)
            end do
            if (rest%count > most_terms) return
        end do
        divides = rest%count == 0
    end subroutine divide_exactly

    pure subroutine remove_first(s)
        !! The first term cancels, whatever the rounding of its coefficient.
        type(sum_t), intent(inout) :: s

        s%terms(:s%count - 1) = s%terms(2:s%count)
        s%count = s%count - 1
    end subroutine remove_first

    pure function common_lowest(a, b) result(lowest)
        !! The lowest power in `a`, or 0, of each atom of `b`: no quotient has a lower one.
        type(sum_t), intent(in) :: a, b
        type(term_t) :: lowest
        integer :: i, j, k

        do i = 1, b%count
            do k = 1, b%terms(i)%count
                associate (atom => b%terms(i)%atom(k))
                    if (any(lowest%atom(:lowest%count) == atom)) cycle
                    if (lowest%count == size(lowest%atom)) return
                    lowest%count = lowest%count + 1
                    lowest%atom(lowest%count) = atom
                    do j = 1, a%count
                        lowest%power(lowest%count) = min(lowest%power(lowest%count), &
                                                         power_of(a%terms(j), atom))
                    end do
                end associate
            end do
        end do
    end function common_lowest
end module lagrangia_sums
