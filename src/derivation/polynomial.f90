module lagrangia_polynomial
    !! Sums of products: exact coefficients times whole powers of numbered atoms, `m2 l sin(theta)`.
    use lagrangia_exact_number, only: common_measure, number_t, operator(+), operator(-), &
                                      operator(*), operator(==), ratio
    use lagrangia_kinds, only: i8
    implicit none (type, external)
    private
    public :: polynomial_t
    public :: atom_power, number_polynomial, term_of, whole_polynomial
    public :: operator(+), operator(-), operator(*), operator(==)
    public :: most_atoms

    integer, parameter :: most_atoms = 96  !! names and functions of one derivation

    type :: polynomial_t
        !! Zero until terms are added. Like terms are one, and none is zero.
        integer :: terms = 0
        type(number_t), allocatable :: coefficient(:)  !! the first `terms` of them count
        integer, allocatable :: power(:, :)            !! (most_atoms, terms and room)
    contains
        procedure :: add_term
        procedure :: common
        procedure :: find
        procedure :: has
        procedure :: is_number
        procedure :: remove
        procedure :: shifted
    end type polynomial_t

    interface operator(+)
        module procedure add
    end interface operator(+)

    interface operator(-)
        module procedure subtract, opposite
    end interface operator(-)

    interface operator(*)
        module procedure multiply
    end interface operator(*)

    interface operator(==)
        module procedure equal
    end interface operator(==)

contains

    pure function number_polynomial(number) result(p)
        !! A constant.
        type(number_t), intent(in) :: number  !! finite
        type(polynomial_t) :: p
        integer :: powers(most_atoms)

        powers = 0
        call p%add_term(number, powers)
    end function number_polynomial

    pure function whole_polynomial(n) result(p)
        !! A whole number.
        integer, intent(in) :: n  !! any
        type(polynomial_t) :: p

        p = number_polynomial(ratio(int(n, i8), 1_i8))
    end function whole_polynomial

    pure function atom_power(atom, n) result(p)
        !! A power of an atom.
        integer, intent(in) :: atom  !! its number, up to `most_atoms`
        integer, intent(in) :: n     !! the exponent
        type(polynomial_t) :: p
        integer :: powers(most_atoms)

        powers = 0
        powers(atom) = n
        call p%add_term(ratio(1_i8, 1_i8), powers)
    end function atom_power

    pure function term_of(p, i) result(one)
        !! Term `i` alone.
        type(polynomial_t), intent(in) :: p  !! any
        integer, intent(in) :: i             !! up to its number of terms
        type(polynomial_t) :: one

        call one%add_term(p%coefficient(i), p%power(:, i))
    end function term_of

    pure subroutine add_term(self, coefficient, powers)
        !! Add to a like term, or put it where the order wants it: high powers of the first atoms
        !! come first.
        class(polynomial_t), intent(inout) :: self
        type(number_t), intent(in) :: coefficient  !! also zero
        integer, intent(in) :: powers(:)           !! (most_atoms)
        type(number_t), allocatable :: more(:)
        integer, allocatable :: wider(:, :)
        integer :: at, i, n

        if (coefficient%is_zero()) return
        call locate(self, powers, at, i)
        if (i > 0) then
            self%coefficient(i) = self%coefficient(i) + coefficient
            if (self%coefficient(i)%is_zero()) call self%remove(i)
            return
        end if
        n = self%terms
        if (.not. allocated(self%coefficient)) then
            allocate (self%coefficient(4), self%power(most_atoms, 4))
        else if (n == size(self%coefficient)) then
            allocate (more(2*n), wider(most_atoms, 2*n))
            more(:n) = self%coefficient
            wider(:, :n) = self%power
            call move_alloc(more, self%coefficient)
            call move_alloc(wider, self%power)
        end if
        do i = n, at, -1
            self%coefficient(i + 1) = self%coefficient(i)
            self%power(:, i + 1) = self%power(:, i)
        end do
        self%coefficient(at) = coefficient
        self%power(:, at) = powers
        self%terms = n + 1
    end subroutine add_term

    pure subroutine locate(p, powers, at, found)
        !! By bisection: where such a term belongs, and where it is, 0 if there is none.
        class(polynomial_t), intent(in) :: p
        integer, intent(in) :: powers(:)
        integer, intent(out) :: at, found
        integer :: first, last, middle, order

        first = 1
        last = p%terms
        found = 0
        do while (first <= last)
            middle = (first + last)/2
            order = compared(powers, p%power(:, middle))
            if (order == 0) then
                found = middle
                at = middle
                return
            else if (order > 0) then
                last = middle - 1
            else
                first = middle + 1
            end if
        end do
        at = first
    end subroutine locate

    pure function compared(a, b) result(order)
        !! The sign of the first difference; 0: there is none.
        integer, intent(in) :: a(:), b(:)
        integer :: order
        integer :: i

        order = 0
        do i = 1, most_atoms
            if (a(i) == b(i)) cycle
            order = sign(1, a(i) - b(i))
            return
        end do
    end function compared

    pure function find(self, powers) result(i)
        !! The term with these powers; 0: there is none.
        class(polynomial_t), intent(in) :: self
        integer, intent(in) :: powers(:)  !! (most_atoms)
        integer :: i
        integer :: at

        call locate(self, powers, at, i)
    end function find

    pure subroutine remove(self, i)
        !! Take a term out.
        class(polynomial_t), intent(inout) :: self
        integer, intent(in) :: i  !! which one
        integer :: k

        do k = i, self%terms - 1
            self%coefficient(k) = self%coefficient(k + 1)
            self%power(:, k) = self%power(:, k + 1)
        end do
        self%terms = self%terms - 1
    end subroutine remove

    pure function is_number(self) result(yes)
        !! Has it no atoms?
        class(polynomial_t), intent(in) :: self
        logical :: yes

        yes = self%terms == 0
        if (self%terms == 1) yes = all(self%power(:, 1) == 0)
    end function is_number

    pure function has(self, atom) result(yes)
        !! Does the atom stand in it, outside of functions?
        class(polynomial_t), intent(in) :: self
        integer, intent(in) :: atom  !! its number
        logical :: yes

        yes = .false.
        if (self%terms > 0) yes = any(self%power(atom, :self%terms) /= 0)
    end function has

    pure subroutine common(self, coefficient, powers)
        !! What all terms have in common: the powers that are nearest to zero where all have one
        !! sign; the number that leaves whole coefficients without a common factor, the first of
        !! them positive.
        class(polynomial_t), intent(in) :: self
        type(number_t), intent(out) :: coefficient  !! one of a sum that is zero
        integer, intent(out) :: powers(:)           !! (most_atoms)
        integer :: i

        coefficient = ratio(1_i8, 1_i8)
        powers = 0
        if (self%terms == 0) return
        associate (c => self%coefficient(:self%terms), e => self%power(:, :self%terms))
            do i = 1, most_atoms
                if (all(e(i, :) > 0)) powers(i) = minval(e(i, :))
                if (all(e(i, :) < 0)) powers(i) = maxval(e(i, :))
            end do
            coefficient = c(1)
            if (.not. all(c%is_exact())) return
            coefficient = common_measure(c)
            if (c(1)%numerator < 0_i8) coefficient = -coefficient
        end associate
    end subroutine common

    pure function shifted(self, coefficient, powers) result(p)
        !! Times `coefficient` and a product of powers.
        class(polynomial_t), intent(in) :: self
        type(number_t), intent(in) :: coefficient  !! any
        integer, intent(in) :: powers(:)           !! (most_atoms)
        type(polynomial_t) :: p
        integer :: i

        do i = 1, self%terms
            call p%add_term(self%coefficient(i)*coefficient, self%power(:, i) + powers)
        end do
    end function shifted

    pure function add(a, b) result(c)
        type(polynomial_t), intent(in) :: a, b
        type(polynomial_t) :: c
        integer :: i

        c = a
        do i = 1, b%terms
            call c%add_term(b%coefficient(i), b%power(:, i))
        end do
    end function add

    pure function opposite(a) result(c)
        type(polynomial_t), intent(in) :: a
        type(polynomial_t) :: c
        integer :: i

        c = a
        do i = 1, c%terms
            c%coefficient(i) = -c%coefficient(i)
        end do
    end function opposite

    pure function subtract(a, b) result(c)
        type(polynomial_t), intent(in) :: a, b
        type(polynomial_t) :: c

        c = a + (-b)
    end function subtract

    pure function multiply(a, b) result(c)
        type(polynomial_t), intent(in) :: a, b
        type(polynomial_t) :: c
        integer :: i, k

        do i = 1, a%terms
            do k = 1, b%terms
                call c%add_term(a%coefficient(i)*b%coefficient(k), a%power(:, i) + b%power(:, k))
            end do
        end do
    end function multiply

    pure function equal(a, b) result(yes)
        type(polynomial_t), intent(in) :: a, b
        logical :: yes
        integer :: i

        yes = a%terms == b%terms
        do i = 1, a%terms
            if (.not. yes) return
            yes = a%coefficient(i) == b%coefficient(i) .and. all(a%power(:, i) == b%power(:, i))
        end do
    end function equal
end module lagrangia_polynomial
