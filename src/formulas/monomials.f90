module lagrangia_monomials
    !! Products of powers, `m2 l x_dot theta_dot cos(theta)`, of what is not taken apart further:
    !! symbols, functions, sums, general powers, pi. They stand in one order, that of the page.
    !!
    !! Factors: parameters, time, coordinates, velocities, accelerations, functions. Terms: by
    !! powers of accelerations, then of velocities, of coordinates; fewer functions first. Both
    !! orders are kept when terms are multiplied by the same factor, as division needs.
    use lagrangia_exact_number, only: number_t, operator(*)
    implicit none (type, external)
    private
    public :: atom_t, order_t, sum_t, term_t
    public :: class_acceleration, class_coordinate, class_function, class_parameter, class_time, &
              class_velocity
    public :: atom_number_pi, atom_function, atom_power, atom_sum, atom_symbol
    public :: compare, inverse, is_coefficient, multiply, power_of, same_state_part, without

    integer, parameter :: class_parameter = 1, class_time = 2, class_coordinate = 3, &
                          class_velocity = 4, class_acceleration = 5, class_function = 6
    integer, parameter :: atom_number_pi = 0, atom_symbol = 1, atom_sum = 2, atom_power = 3, &
                          atom_function = 4
    integer, parameter :: most = 20  !! factors in a product

    type :: atom_t
        !! What a product consists of.
        integer :: kind = atom_symbol
        integer :: which = 0       !! place of the symbol, number of the function
        integer :: argument = 0    !! of a function, base of a power, the sum: a place among sums
        integer :: exponent = 0    !! of a general power: a place among the sums
        integer :: class = class_parameter
        integer :: position = 0    !! in the order of factors
    end type atom_t

    type :: term_t
        !! A number and powers of atoms, in the order of factors.
        type(number_t) :: coefficient
        integer :: count = 0
        integer :: atom(most) = 0
        integer :: power(most) = 0  !! not 0
    end type term_t

    type :: sum_t
        !! Terms in their order, no two with the same factors, none zero.
        integer :: count = 0
        type(term_t), allocatable :: terms(:)  !! the first `count` of them count
    end type sum_t

    type :: order_t
        !! The atoms that there are.
        integer :: count = 0
        type(atom_t), allocatable :: atoms(:)  !! the first `count` of them count
    end type order_t

contains

    pure function compare(order, a, b) result(first)
        !! -1 where `a` stands before `b` in a sum, 1 where it stands behind, 0 where the factors
        !! are the same.
        type(order_t), intent(in) :: order  !! of the atoms
        type(term_t), intent(in) :: a, b    !! whatever their coefficients
        integer :: first
        integer, parameter :: classes(6) = [class_acceleration, class_velocity, class_time, &
            class_coordinate, class_function, class_parameter]
        integer :: k

        first = 0
        if (a%count == b%count) then
            if (all(a%atom(:a%count) == b%atom(:b%count)) .and. &
                all(a%power(:a%count) == b%power(:b%count))) return
        end if
        first = sign_of(degree(order, b, class_acceleration) - degree(order, a, class_acceleration))
        if (first /= 0) return
        first = sign_of(degree(order, b, class_velocity) - degree(order, a, class_velocity))
        if (first /= 0) return
        do k = 1, size(classes)
            if (classes(k) == class_function) then
                first = sign_of(degree(order, a, class_function) - degree(order, b, class_function))
                if (first /= 0) return
            end if
            first = compare_class(order, a, b, classes(k))
            if (first /= 0) return
        end do
    end function compare

    pure function sign_of(n) result(s)
        !! -1, 0, 1
        integer, intent(in) :: n
        integer :: s

        s = 0
        if (n /= 0) s = sign(1, n)
    end function sign_of

    pure function degree(order, term, class) result(n)
        !! Of the factors of one class.
        type(order_t), intent(in) :: order
        type(term_t), intent(in) :: term
        integer, intent(in) :: class
        integer :: n, k

        n = 0
        do k = 1, term%count
            if (order%atoms(term%atom(k))%class == class) n = n + term%power(k)
        end do
    end function degree

    pure function compare_class(order, a, b, class) result(first)
        !! By the first factor of the class whose power differs: the higher power is first.
        type(order_t), intent(in) :: order
        type(term_t), intent(in) :: a, b
        integer, intent(in) :: class
        integer :: first, i, j

        first = 0
        i = 0
        j = 0
        do
            i = next(a, i)
            j = next(b, j)
            if (i > a%count .and. j > b%count) return
            if (i > a%count) then
                first = sign_of(b%power(j))
            else if (j > b%count) then
                first = -sign_of(a%power(i))
            else if (a%atom(i) == b%atom(j)) then
                first = sign_of(b%power(j) - a%power(i))
            else if (order%atoms(a%atom(i))%position < order%atoms(b%atom(j))%position) then
                first = -sign_of(a%power(i))
            else
                first = sign_of(b%power(j))
            end if
            if (first /= 0) return
        end do
    contains
        pure function next(term, k) result(behind)
            !! The next factor of the class.
            type(term_t), intent(in) :: term
            integer, intent(in) :: k
            integer :: behind

            do behind = k + 1, term%count
                if (order%atoms(term%atom(behind))%class == class) return
            end do
        end function next
    end function compare_class

    pure subroutine multiply(order, a, b, product, fits)
        !! Of two terms.
        type(order_t), intent(in) :: order    !! of the atoms
        type(term_t), intent(in) :: a, b      !! any
        type(term_t), intent(out) :: product  !! without factors to the power 0
        logical, intent(out) :: fits          !! not more factors than there is room for
        integer :: i, j, k, next, power

        product%coefficient = a%coefficient*b%coefficient
        fits = .true.
        i = 1
        j = 1
        k = 0
        do while (i <= a%count .or. j <= b%count)
            next = 0
            power = 0
            if (i <= a%count) next = a%atom(i)
            if (j <= b%count) then
                if (next == 0) then
                    next = b%atom(j)
                else if (order%atoms(b%atom(j))%position < order%atoms(next)%position) then
                    next = b%atom(j)
                end if
            end if
            if (i <= a%count) then
                if (a%atom(i) == next) then
                    power = a%power(i)
                    i = i + 1
                end if
            end if
            if (j <= b%count) then
                if (b%atom(j) == next) then
                    power = power + b%power(j)
                    j = j + 1
                end if
            end if
            if (power == 0) cycle
            fits = fits .and. k < most .and. abs(power) < 1000000
            if (.not. fits) return
            k = k + 1
            product%atom(k) = next
            product%power(k) = power
            product%count = k
        end do
    end subroutine multiply

    pure function inverse(a) result(b)
        !! The factors to their opposite powers; the coefficient is left as it is.
        type(term_t), intent(in) :: a  !! any
        type(term_t) :: b

        b = a
        b%power = -a%power
    end function inverse

    pure function power_of(term, atom) result(n)
        !! The power of an atom in a term, 0 where it is no factor.
        type(term_t), intent(in) :: term  !! any
        integer, intent(in) :: atom       !! its place
        integer :: n, k

        n = 0
        do k = 1, term%count
            if (term%atom(k) == atom) n = term%power(k)
        end do
    end function power_of

    pure function without(term, atom) result(rest)
        !! The term without one of its factors.
        type(term_t), intent(in) :: term  !! any
        integer, intent(in) :: atom       !! its place
        type(term_t) :: rest
        integer :: k

        rest%coefficient = term%coefficient
        do k = 1, term%count
            if (term%atom(k) == atom) cycle
            rest%count = rest%count + 1
            rest%atom(rest%count) = term%atom(k)
            rest%power(rest%count) = term%power(k)
        end do
    end function without

    pure function is_coefficient(order, atom) result(yes)
        !! Is it made of parameters?
        type(order_t), intent(in) :: order  !! of the atoms
        integer, intent(in) :: atom         !! its place
        logical :: yes

        yes = order%atoms(atom)%class == class_parameter
    end function is_coefficient

    pure function same_state_part(order, a, b) result(yes)
        !! Do two terms differ in parameters only?
        type(order_t), intent(in) :: order  !! of the atoms
        type(term_t), intent(in) :: a, b    !! any
        logical :: yes
        integer :: k

        yes = .true.
        do k = 1, a%count
            if (is_coefficient(order, a%atom(k))) cycle
            yes = yes .and. power_of(b, a%atom(k)) == a%power(k)
        end do
        do k = 1, b%count
            if (is_coefficient(order, b%atom(k))) cycle
            yes = yes .and. power_of(a, b%atom(k)) == b%power(k)
        end do
    end function same_state_part
end module lagrangia_monomials
