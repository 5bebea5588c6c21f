module lagrangia_square_roots
    !! \(\sqrt A^2 = A\), which holds wherever the root is a number.
    use lagrangia_algebra, only: algebra_t, atom_function, atom_sum
    use lagrangia_exact_number, only: number_t
    use lagrangia_expression, only: f_sqrt
    use lagrangia_polynomial, only: atom_power, operator(+), operator(*), polynomial_t, term_of
    implicit none (type, external)
    private
    public :: square_roots

contains

    pure subroutine square_roots(algebra, p)
        !! Of every root at most the first power is left, or the first below; of what is in it, if
        !! that is a sum, the powers below.
        type(algebra_t), intent(inout) :: algebra  !! of the atoms
        type(polynomial_t), intent(inout) :: p     !! keeps its value
        type(polynomial_t) :: argument, factor, power, q
        integer :: atom, half, i, whole

        atom = 0
        do while (atom < algebra%count)  ! an argument may bring more of them
            atom = atom + 1
            if (algebra%atoms(atom)%kind /= atom_function) cycle
            if (algebra%atoms(atom)%which /= f_sqrt) cycle
            argument = algebra%atoms(atom)%argument
            whole = 0
            if (argument%terms > 1) call algebra%atom_number(atom_sum, 0, number_t(), argument, &
                                                             whole)
            if (.not. is_long(whole)) cycle
            q = polynomial_t()
            do i = 1, p%terms
                half = roots_in(i)/2
                factor = atom_power(atom, left_over(roots_in(i)) - p%power(atom, i))
                if (whole > 0) factor = factor*atom_power(whole, -p%power(whole, i))
                if (half < 0 .and. whole > 0) then
                    power = atom_power(whole, half)
                else
                    call algebra%raised(argument, half, power)
                end if
                q = q + term_of(p, i)*factor*power
            end do
            p = q
            if (algebra%full) return
            atom = 0
        end do
    contains
        pure integer function roots_in(i)
            !! How many roots are the factors of term `i`?
            integer, intent(in) :: i

            roots_in = p%power(atom, i)
            if (whole > 0) roots_in = roots_in + 2*p%power(whole, i)
        end function roots_in

        pure integer function left_over(n)
            !! -1, 0 or 1 of `n` roots, the others are pairs.
            integer, intent(in) :: n

            left_over = n - 2*(n/2)
        end function left_over

        pure logical function is_long(whole)
            integer, intent(in) :: whole
            integer :: i

            is_long = .false.
            do i = 1, p%terms
                is_long = is_long .or. p%power(atom, i) /= left_over(roots_in(i))
                if (whole > 0) is_long = is_long .or. p%power(whole, i) > 0
            end do
        end function is_long
    end subroutine square_roots
end module lagrangia_square_roots
