module lagrangia_trigonometry
    !! What shortens sums of products with sines and cosines.
    use lagrangia_algebra, only: algebra_t, atom_function
    use lagrangia_exact_number, only: number_t, operator(-), operator(==)
    use lagrangia_expression, only: f_cos, f_sin
    use lagrangia_polynomial, only: atom_power, most_atoms, operator(+), operator(-), &
                                    operator(*), polynomial_t, term_of, whole_polynomial
    use lagrangia_square_roots, only: square_roots
    implicit none (type, external)
    private
    public :: tidy, shorten

contains

    pure subroutine tidy(algebra, p)
        !! Squares of roots, and terms that \(\sin^2 + \cos^2 = 1\) or the sine or cosine of a sum
        !! make into one.
        type(algebra_t), intent(inout) :: algebra  !! of the atoms
        type(polynomial_t), intent(inout) :: p     !! keeps its value
        logical :: changed

        call square_roots(algebra, p)
        do
            call join_squares(algebra, p, changed)
            if (.not. changed) call join_angles(algebra, p, changed)
            if (.not. changed) return
        end do
    end subroutine tidy

    pure subroutine shorten(algebra, p)
        !! `tidy`, and \(\cos^2\) as \(1 - \sin^2\), or the other way round, where that leaves fewer
        !! terms.
        type(algebra_t), intent(inout) :: algebra  !! of the atoms
        type(polynomial_t), intent(inout) :: p     !! keeps its value
        type(polynomial_t) :: other
        integer :: atom, last, partner

        call tidy(algebra, p)
        last = algebra%count
        do atom = 1, last
            if (.not. is_trigonometric(algebra, atom)) cycle
            call find_partner(algebra, atom, partner)
            call without_square(p, atom, partner, other)
            call tidy(algebra, other)
            if (other%terms < p%terms) p = other
        end do
    end subroutine shorten

    pure function is_trigonometric(algebra, atom) result(yes)
        !! Is it a sine or a cosine?
        type(algebra_t), intent(in) :: algebra
        integer, intent(in) :: atom
        logical :: yes

        yes = algebra%atoms(atom)%kind == atom_function .and. &
              (algebra%atoms(atom)%which == f_sin .or. algebra%atoms(atom)%which == f_cos)
    end function is_trigonometric

    pure subroutine find_partner(algebra, atom, partner)
        !! The cosine of a sine's argument, and the other way round.
        type(algebra_t), intent(inout) :: algebra
        integer, intent(in) :: atom
        integer, intent(out) :: partner
        type(polynomial_t) :: argument, p

        argument = algebra%atoms(atom)%argument
        call algebra%function_of(f_sin + f_cos - algebra%atoms(atom)%which, argument, p)
        partner = findloc(p%power(:, 1), 1, 1)
    end subroutine find_partner

    pure subroutine without_square(p, atom, partner, q)
        !! Every even part of a power of `atom` by that of its partner.
        type(polynomial_t), intent(in) :: p
        integer, intent(in) :: atom, partner
        type(polynomial_t), intent(out) :: q
        type(polynomial_t) :: square, term
        integer :: i, k

        square = whole_polynomial(1) - atom_power(partner, 2)
        do i = 1, p%terms
            term = term_of(p, i)
            do k = 1, p%power(atom, i)/2
                term = term*atom_power(atom, -2)*square
            end do
            q = q + term
        end do
    end subroutine without_square

    pure subroutine join_squares(algebra, p, changed)
        !! The first pair \(R\sin^2 a + R\cos^2 a = R\).
        type(algebra_t), intent(inout) :: algebra
        type(polynomial_t), intent(inout) :: p
        logical, intent(out) :: changed
        type(number_t) :: c
        integer :: atom, i, j, last, other, powers(most_atoms)

        changed = .false.
        last = algebra%count
        do atom = 1, last
            if (.not. is_trigonometric(algebra, atom)) cycle
            if (algebra%atoms(atom)%which /= f_sin .or. .not. p%has(atom)) cycle
            call find_partner(algebra, atom, other)
            do i = 1, p%terms
                if (p%power(atom, i) < 2) cycle
                powers = p%power(:, i)
                powers(atom) = powers(atom) - 2
                powers(other) = powers(other) + 2
                j = p%find(powers)
                if (j == 0) cycle
                if (.not. p%coefficient(i) == p%coefficient(j)) cycle
                c = p%coefficient(i)
                powers(other) = powers(other) - 2
                call p%remove(max(i, j))
                call p%remove(min(i, j))
                call p%add_term(c, powers)
                changed = .true.
                return
            end do
        end do
    end subroutine join_squares

    pure subroutine join_angles(algebra, p, changed)
        !! The first pair \(R\cos a\cos b \pm R\sin a\sin b\) or
        !! \(R\sin a\cos b \pm R\cos a\sin b\).
        type(algebra_t), intent(inout) :: algebra
        type(polynomial_t), intent(inout) :: p
        logical, intent(out) :: changed
        type(polynomial_t) :: one
        type(number_t) :: c
        integer :: a, b, i, j, last, other_a, other_b, powers(most_atoms)
        logical :: opposite, product_of_sines

        changed = .false.
        last = algebra%count
        do a = 1, last
            if (.not. p%has(a) .or. .not. is_trigonometric(algebra, a)) cycle
            if (algebra%atoms(a)%which /= f_sin) cycle
            call find_partner(algebra, a, other_a)
            do b = 1, last
                if (a == b .or. b == other_a .or. .not. p%has(b)) cycle
                if (.not. is_trigonometric(algebra, b)) cycle
                product_of_sines = algebra%atoms(b)%which == f_sin
                call find_partner(algebra, b, other_b)
                do i = 1, p%terms
                    if (p%power(a, i) < 1 .or. p%power(b, i) < 1) cycle
                    powers = p%power(:, i)
                    powers([a, b]) = powers([a, b]) - 1
                    powers([other_a, other_b]) = powers([other_a, other_b]) + 1
                    j = p%find(powers)
                    if (j == 0) cycle
                    opposite = p%coefficient(i) == -p%coefficient(j)
                    if (.not. (opposite .or. p%coefficient(i) == p%coefficient(j))) cycle
                    c = p%coefficient(merge(j, i, product_of_sines))
                    powers([other_a, other_b]) = powers([other_a, other_b]) - 1
                    call p%remove(max(i, j))
                    call p%remove(min(i, j))
                    call join_arguments(algebra, a, b, product_of_sines .neqv. opposite, one)
                    p = p + one%shifted(c, powers)
                    changed = .true.
                    return
                end do
            end do
        end do
    contains
        pure subroutine join_arguments(algebra, a, b, difference, one)
            !! The sine or cosine of both angles' sum or difference.
            type(algebra_t), intent(inout) :: algebra
            integer, intent(in) :: a, b
            logical, intent(in) :: difference
            type(polynomial_t), intent(out) :: one
            type(polynomial_t) :: angle

            angle = algebra%atoms(b)%argument
            if (difference) angle = -angle
            angle = algebra%atoms(a)%argument + angle
            call algebra%function_of(merge(f_cos, f_sin, product_of_sines), angle, one)
        end subroutine join_arguments
    end subroutine join_angles
end module lagrangia_trigonometry
