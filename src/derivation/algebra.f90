module lagrangia_algebra
    !! Formulas as sums of products of atoms, with derivatives. An atom is a name, a function of
    !! such a sum, or a sum that is divided by or raised to a power.
    use lagrangia_exact_number, only: number_t, operator(*), operator(/), operator(==), power, &
                                      ratio
    use lagrangia_expression, only: expression_t, f_abs, f_atan, f_cos, f_cosh, f_exp, f_log, &
                                    f_sgn, f_sin, f_sinh, f_sqrt, f_tan, f_tanh, kind_difference, &
                                    kind_negation, kind_number, kind_power, kind_product, &
                                    kind_quotient, kind_sum, kind_symbol
    use lagrangia_kinds, only: dp, i8
    use lagrangia_number_class, only: is_zero
    use lagrangia_polynomial, only: atom_power, most_atoms, number_polynomial, operator(+), &
                                    operator(-), operator(*), operator(==), polynomial_t, &
                                    term_of, whole_polynomial
    implicit none (type, external)
    private
    public :: algebra_t, atom_t
    public :: atom_function, atom_number_pi, atom_root, atom_sum, atom_symbol

    integer, parameter :: atom_symbol = 0    !! a name
    integer, parameter :: atom_function = 1  !! of `argument`
    integer, parameter :: atom_sum = 2       !! `argument`, a sum, to the power that it has
    integer, parameter :: atom_root = 3      !! `argument` to the power `exponent`, a fraction
    integer, parameter :: atom_number_pi = 4  !! the number
    real(dp), parameter :: pi = acos(-1.0_dp)
    integer, parameter :: largest_power = 12  !! to which a sum is multiplied out

    type :: atom_t
        !! What an atom's number stands for.
        integer :: kind = atom_symbol
        integer :: which = 0              !! of the functions
        type(number_t) :: exponent        !! of a root
        type(polynomial_t) :: argument
    end type atom_t

    type :: algebra_t
        !! All atoms that were met, the names first.
        integer :: count = 0
        integer :: names = 0                    !! the first atoms, in the order of the symbols
        type(atom_t), allocatable :: atoms(:)   !! (most_atoms)
        logical :: full = .false.               !! more atoms were needed: results are wrong
    contains
        procedure :: atom_number
        procedure :: begin
        procedure :: derivative
        procedure :: function_of
        procedure :: from_expression
        procedure :: inverse
        procedure :: raised
        procedure :: substitute
        procedure :: uses
        procedure, private :: atom_derivative
        procedure, private :: replaced
        procedure, private :: root_of
    end type algebra_t

contains

    pure subroutine begin(self, names)
        !! Make an atom of each name.
        class(algebra_t), intent(inout) :: self  !! new
        integer, intent(in) :: names             !! how many symbols there are

        allocate (self%atoms(most_atoms))
        self%names = min(names, most_atoms)
        self%full = names > most_atoms
        self%count = self%names
    end subroutine begin

    pure subroutine atom_number(self, kind, which, exponent, argument, atom)
        !! The number of such an atom, a new one where it is met for the first time.
        class(algebra_t), intent(inout) :: self
        integer, intent(in) :: kind, which          !! `atom_sum`, ..., and which function
        type(number_t), intent(in) :: exponent      !! of a root
        type(polynomial_t), intent(in) :: argument  !! what the atom is made of
        integer, intent(out) :: atom                !! its number

        do atom = self%names + 1, self%count
            associate (other => self%atoms(atom))
                if (other%kind /= kind .or. other%which /= which) cycle
                if (.not. other%exponent == exponent) cycle
                if (other%argument == argument) return
            end associate
        end do
        if (self%count == most_atoms) then
            self%full = .true.
            atom = most_atoms
            return
        end if
        self%count = self%count + 1
        atom = self%count
        self%atoms(atom)%kind = kind
        self%atoms(atom)%which = which
        self%atoms(atom)%exponent = exponent
        self%atoms(atom)%argument = argument
    end subroutine atom_number

    pure subroutine from_expression(self, expression, p)
        !! The same, multiplied out.
        class(algebra_t), intent(inout) :: self
        type(expression_t), intent(in) :: expression  !! of the names
        type(polynomial_t), intent(out) :: p          !! equal to it
        type(polynomial_t), allocatable :: at(:)
        type(polynomial_t) :: other
        integer :: atom, i

        if (expression%count == 0) return
        allocate (at(expression%count))
        do i = 1, expression%count
            associate (node => expression%nodes(i))
                select case (node%kind)
                case (kind_number)
                    at(i) = number_polynomial(node%number)
                    if (is_zero(abs(node%number%value) - pi)) then
                        call self%atom_number(atom_number_pi, 0, number_t(), polynomial_t(), atom)
                        at(i) = atom_power(atom, 1)
                        if (node%number%value < 0.0_dp) at(i) = -at(i)
                    end if
                case (kind_symbol)
                    at(i) = atom_power(node%which, 1)
                case (kind_sum)
                    at(i) = at(node%left) + at(node%right)
                case (kind_difference)
                    at(i) = at(node%left) - at(node%right)
                case (kind_negation)
                    at(i) = -at(node%left)
                case (kind_product)
                    at(i) = at(node%left)*at(node%right)
                case (kind_quotient)
                    call self%inverse(at(node%right), other)
                    at(i) = at(node%left)*other
                case (kind_power)
                    call self%root_of(at(node%left), at(node%right), at(i))
                case default
                    call self%function_of(node%which, at(node%left), at(i))
                end select
            end associate
        end do
        p = at(expression%count)
    end subroutine from_expression

    pure subroutine inverse(self, p, q)
        !! \(1/p\).
        class(algebra_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: p   !! not zero
        type(polynomial_t), intent(out) :: q  !! what it becomes

        call self%raised(p, -1, q)
    end subroutine inverse

    pure subroutine raised(self, p, n, q)
        !! \(p^n\): sums multiplied out for \(n > 0\), an atom below.
        class(algebra_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: p   !! not zero for n < 0
        integer, intent(in) :: n              !! the exponent
        type(polynomial_t), intent(out) :: q  !! what it becomes
        type(polynomial_t) :: rest
        type(number_t) :: coefficient
        integer :: atom, k, powers(most_atoms), times(most_atoms)

        if (p%terms == 0 .and. n > 0) return
        if (n == 0) then
            q = whole_polynomial(1)
            return
        end if
        if (p%terms > 1 .and. n > 0 .and. n <= largest_power) then
            q = whole_polynomial(1)
            do k = 1, n
                q = q*p
            end do
            return
        end if
        call p%common(coefficient, powers)
        times = n*powers
        if (p%terms > 1) then
            rest = p%shifted(ratio(1_i8, 1_i8)/coefficient, -powers)
            call self%atom_number(atom_sum, 0, number_t(), rest, atom)
            times(atom) = times(atom) + n
        end if
        if (p%terms == 0) self%full = .true.
        call q%add_term(power(coefficient, n), times)
    end subroutine raised

    pure subroutine root_of(self, base, exponent, p)
        !! Any power: of a whole exponent as above, of a half, or any number of halves below zero,
        !! by a square root, of another fraction an atom, else exp(y log(x)).
        class(algebra_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: base, exponent
        type(polynomial_t), intent(out) :: p
        type(polynomial_t) :: other
        integer :: atom

        if (exponent%terms == 0 .or. base == whole_polynomial(1)) then
            p = whole_polynomial(1)
        else if (.not. exponent%is_number()) then
            call self%function_of(f_log, base, other)
            call self%function_of(f_exp, exponent*other, p)
        else
            associate (e => exponent%coefficient(1))
                if (e%is_whole()) then
                    call self%raised(base, int(e%numerator), p)
                else if (e%is_exact() .and. e%denominator == 2 .and. e%numerator <= 1) then
                    call self%function_of(f_sqrt, base, other)
                    call self%raised(other, int(e%numerator), p)
                else
                    call self%atom_number(atom_root, 0, e, base, atom)
                    p = atom_power(atom, 1)
                end if
            end associate
        end if
    end subroutine root_of

    pure subroutine function_of(self, which, argument, p)
        !! A function; sines and cosines of an argument whose first sign is plus.
        class(algebra_t), intent(inout) :: self
        integer, intent(in) :: which                !! one of `f_abs` to `f_tanh`
        type(polynomial_t), intent(in) :: argument  !! of the function
        type(polynomial_t), intent(out) :: p        !! what it becomes
        type(number_t) :: root
        logical :: odd, even
        integer :: atom

        odd = any(which == [f_sgn, f_sin, f_tan, f_sinh, f_tanh, f_atan])
        even = any(which == [f_cos, f_cosh, f_abs])
        if (argument%terms == 0 .and. (odd .or. any(which == [f_abs, f_sqrt]))) return
        if (argument%terms == 0 .and. any(which == [f_cos, f_cosh, f_exp])) then
            p = whole_polynomial(1)
            return
        end if
        if (argument == whole_polynomial(1) .and. which == f_log) return
        if (argument%terms == 1 .and. which == f_sqrt) then
            associate (c => argument%coefficient(1))
                if (all(argument%power(:, 1) == 0) .and. c%is_exact() .and. c%value > 0.0_dp) then
                    root = ratio(nint(sqrt(real(c%numerator, dp)), i8), &
                                 nint(sqrt(real(c%denominator, dp)), i8))
                    if (root*root == c) then
                        p = number_polynomial(root)
                        return
                    end if
                end if
            end associate
        end if
        if (odd .or. even) then
            if (argument%coefficient(1)%value < 0.0_dp) then
                call self%atom_number(atom_function, which, number_t(), -argument, atom)
                p = atom_power(atom, 1)
                if (odd) p = -p
                return
            end if
        end if
        call self%atom_number(atom_function, which, number_t(), argument, atom)
        p = atom_power(atom, 1)
    end subroutine function_of

    pure recursive subroutine derivative(self, p, name, dp_dname)
        !! \(\partial p/\partial name\).
        class(algebra_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: p          !! any
        integer, intent(in) :: name                  !! number of a symbol
        type(polynomial_t), intent(out) :: dp_dname  !! the derivative
        type(polynomial_t) :: inner, slope, term
        integer :: i, k, last

        last = self%count
        do k = 1, last
            if (.not. p%has(k)) cycle
            call self%atom_derivative(k, name, inner)
            if (inner%terms == 0) cycle
            do i = 1, p%terms
                if (p%power(k, i) == 0) cycle
                term = term_of(p, i)*whole_polynomial(p%power(k, i))*atom_power(k, -1)
                if (is_function(self%atoms(k), f_abs) .and. p%power(k, i) > 1) then
                    ! (|u|^n)' = n |u|^(n - 2) u u'
                    call self%derivative(self%atoms(k)%argument, name, slope)
                    dp_dname = dp_dname + term*atom_power(k, -1)*self%atoms(k)%argument*slope
                else
                    dp_dname = dp_dname + term*inner
                end if
            end do
        end do
    end subroutine derivative

    pure function is_function(atom, which) result(yes)
        !! Is it this function of something?
        type(atom_t), intent(in) :: atom
        integer, intent(in) :: which  !! `f_abs`, ...
        logical :: yes

        yes = atom%kind == atom_function .and. atom%which == which
    end function is_function

    pure recursive subroutine atom_derivative(self, atom, name, d)
        !! Of one atom.
        class(algebra_t), intent(inout) :: self
        integer, intent(in) :: atom, name
        type(polynomial_t), intent(out) :: d
        type(polynomial_t) :: argument, inner, outer, other

        if (self%atoms(atom)%kind == atom_symbol) then
            if (atom == name) d = whole_polynomial(1)
            return
        end if
        if (self%atoms(atom)%kind == atom_number_pi) return
        argument = self%atoms(atom)%argument
        call self%derivative(argument, name, inner)
        if (inner%terms == 0) return
        select case (self%atoms(atom)%kind)
        case (atom_sum)
            d = inner
            return
        case (atom_root)
            outer = number_polynomial(self%atoms(atom)%exponent)
            call self%root_of(argument, outer - whole_polynomial(1), other)
            outer = outer*other
        case default
            select case (self%atoms(atom)%which)
            case (f_abs); call self%function_of(f_sgn, argument, outer)
            case (f_sgn); return  ! 0 but at the jump
            case (f_atan); call self%inverse(whole_polynomial(1) + argument*argument, outer)
            case (f_cos)
                call self%function_of(f_sin, argument, outer)
                outer = -outer
            case (f_cosh); call self%function_of(f_sinh, argument, outer)
            case (f_exp); outer = atom_power(atom, 1)
            case (f_log); call self%inverse(argument, outer)
            case (f_sin); call self%function_of(f_cos, argument, outer)
            case (f_sinh); call self%function_of(f_cosh, argument, outer)
            case (f_sqrt)
                outer = number_polynomial(ratio(1_i8, 2_i8))*atom_power(atom, -1)
            case (f_tan); outer = whole_polynomial(1) + atom_power(atom, 2)
            case default; outer = whole_polynomial(1) - atom_power(atom, 2)  ! of tanh
            end select
        end select
        d = outer*inner
    end subroutine atom_derivative

    pure recursive subroutine substitute(self, p, names, values, q)
        !! `values` in place of names, in functions, too. What divides by zero, or jumps there,
        !! marks the algebra as full.
        class(algebra_t), intent(inout) :: self
        type(polynomial_t), intent(in) :: p          !! any
        integer, intent(in) :: names(:)              !! symbols
        type(polynomial_t), intent(in) :: values(:)  !! as many
        type(polynomial_t), intent(out) :: q         !! without these names
        type(polynomial_t) :: factor, many, term
        integer :: i, k, powers(most_atoms)
        logical :: jumps

        do i = 1, p%terms
            powers = 0
            jumps = .false.
            term = whole_polynomial(1)
            do k = 1, most_atoms
                if (p%power(k, i) == 0) cycle
                if (.not. self%uses(k, names)) then
                    powers(k) = p%power(k, i)
                    cycle
                end if
                call self%replaced(k, names, values, factor)
                if (factor%terms == 0 .and. is_function(self%atoms(k), f_sgn)) then
                    jumps = .true.
                    cycle
                end if
                call self%raised(factor, p%power(k, i), many)
                term = term*many
            end do
            if (jumps .and. term%terms > 0) self%full = .true.
            if (.not. jumps) q = q + term%shifted(p%coefficient(i), powers)
        end do
    end subroutine substitute

    pure recursive subroutine replaced(self, atom, names, values, p)
        !! One atom with the values in it.
        class(algebra_t), intent(inout) :: self
        integer, intent(in) :: atom, names(:)
        type(polynomial_t), intent(in) :: values(:)
        type(polynomial_t), intent(out) :: p
        type(polynomial_t) :: argument
        integer :: k

        if (self%atoms(atom)%kind == atom_symbol) then
            do k = 1, size(names)
                if (names(k) == atom) p = values(k)
            end do
            return
        end if
        if (self%atoms(atom)%kind == atom_number_pi) then
            p = atom_power(atom, 1)
            return
        end if
        call self%substitute(self%atoms(atom)%argument, names, values, argument)
        select case (self%atoms(atom)%kind)
        case (atom_sum)
            p = argument
        case (atom_root)
            call self%root_of(argument, number_polynomial(self%atoms(atom)%exponent), p)
        case default
            call self%function_of(self%atoms(atom)%which, argument, p)
        end select
    end subroutine replaced

    pure recursive function uses(self, atom, names) result(yes)
        !! Does one of these names stand in the atom?
        class(algebra_t), intent(in) :: self
        integer, intent(in) :: atom      !! its number
        integer, intent(in) :: names(:)  !! symbols
        logical :: yes
        integer :: k

        yes = any(names == atom)
        if (self%atoms(atom)%kind == atom_symbol) return
        do k = 1, self%count
            if (yes) return
            if (self%atoms(atom)%argument%has(k)) yes = self%uses(k, names)
        end do
    end function uses
end module lagrangia_algebra
