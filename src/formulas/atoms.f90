module lagrangia_atoms
    use lagrangia_exact_number, only: number_of
    !! What products consist of, each once, in the order in which factors stand on the page.
    use lagrangia_expression, only: f_abs, f_atan, f_cos, f_cosh, f_exp, f_log, f_sgn, f_sin, &
                                    f_sinh, f_sqrt, f_tan, f_tanh
    use lagrangia_kinds, only: dp
    use lagrangia_monomials, only: atom_function, atom_number_pi, atom_power, atom_sum, &
                                   atom_symbol, atom_t, class_acceleration, class_coordinate, &
                                   class_function, class_parameter, class_time, class_velocity, &
                                   compare, is_coefficient, order_t, sum_t
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_sums, only: equal_sums
    use lagrangia_symbols, only: symbols_t
    implicit none (type, external)
    private
    public :: table_t
    public :: find_atom, new_table, single_factor

    type :: table_t
        !! Atoms, and the sums that they are made of.
        type(order_t) :: order
        integer :: sum_count = 0
        type(sum_t), allocatable :: sums(:)  !! the first `sum_count` count
        integer, allocatable :: class(:)     !! of each symbol
        integer, allocatable :: rank(:)      !! within its class: masses, g and k, others
    end type table_t

    integer, parameter :: preferred(12) = [f_abs, f_sgn, f_sqrt, f_exp, f_log, f_sin, f_cos, &
        f_tan, f_sinh, f_cosh, f_tanh, f_atan]  !! the order of functions in a product

contains

    pure subroutine new_table(table, symbols)
        !! Nothing but the classes of the symbols, which their names tell.
        type(table_t), intent(out) :: table     !! without atoms
        type(symbols_t), intent(in) :: symbols  !! of the formulas to come
        integer :: i, length, n

        n = 0
        if (allocated(symbols%names)) n = size(symbols%names)
        allocate (table%class(n), source=class_parameter)
        allocate (table%rank(n), source=0)
        allocate (table%order%atoms(8), table%sums(8))
        do i = 1, n
            associate (name => symbols%names(i))
                length = len_trim(name)
                if (name == "t") then
                    table%class(i) = class_time
                else if (name(max(1, length - 4):length) == "_ddot") then
                    table%class(i) = class_acceleration
                else if (name(max(1, length - 3):length) == "_dot") then
                    table%class(i) = class_velocity
                else if (symbols%find(trim(name)//"_dot") > 0) then
                    table%class(i) = class_coordinate
                else  ! m g l, k l^2, whatever the order of the parameters
                    table%rank(i) = 2
                    if (name == "g" .or. name(1:1) == "k") table%rank(i) = 1
                    if (scan(name, "mM") == 1) table%rank(i) = 0
                end if
            end associate
        end do
    end subroutine new_table

    pure subroutine find_atom(table, kind, which, argument, exponent, atom)
        !! The place of an atom, which is made if it is new.
        type(table_t), intent(inout) :: table   !! may have one more
        integer, intent(in) :: kind             !! `atom_symbol` and so on
        integer, intent(in) :: which            !! the symbol, or the function
        type(sum_t), intent(in) :: argument     !! of a function, base of a power, the sum itself
        type(sum_t), intent(in) :: exponent     !! of a power
        integer, intent(out) :: atom            !! its place
        type(atom_t), allocatable :: larger(:)
        type(atom_t) :: new
        integer :: i

        new = atom_t(kind, which)
        if (kind >= atom_sum) call find_sum(table, argument, new%argument)
        if (kind == atom_power) call find_sum(table, exponent, new%exponent)
        do atom = 1, table%order%count
            associate (old => table%order%atoms(atom))
                if (old%kind == kind .and. old%which == which .and. &
                    old%argument == new%argument .and. old%exponent == new%exponent) return
            end associate
        end do
        call classify(table, new)
        new%position = 1
        do i = 1, table%order%count
            if (precedes(table, table%order%atoms(i), new)) then
                new%position = max(new%position, table%order%atoms(i)%position + 1)
            end if
        end do
        do i = 1, table%order%count
            associate (old => table%order%atoms(i))
                if (old%position >= new%position) old%position = old%position + 1
            end associate
        end do
        if (table%order%count == size(table%order%atoms)) then
            allocate (larger(2*table%order%count))
            larger(:table%order%count) = table%order%atoms
            call move_alloc(larger, table%order%atoms)
        end if
        table%order%count = table%order%count + 1
        atom = table%order%count
        table%order%atoms(atom) = new
    end subroutine find_atom

    pure function single_factor(atom, power) result(s)
        !! A power of an atom as a sum.
        integer, intent(in) :: atom   !! its place
        integer, intent(in) :: power  !! not 0
        type(sum_t) :: s

        allocate (s%terms(1))
        s%count = 1
        s%terms(1)%coefficient = number_of(1.0_dp)
        s%terms(1)%count = 1
        s%terms(1)%atom(1) = atom
        s%terms(1)%power(1) = power
    end function single_factor

    pure subroutine find_sum(table, s, place)
        !! The place of a sum, which is kept if it is new.
        type(table_t), intent(inout) :: table
        type(sum_t), intent(in) :: s
        integer, intent(out) :: place
        type(sum_t), allocatable :: larger(:)
        integer :: i

        do place = 1, table%sum_count
            if (equal_sums(table%sums(place), s)) return
        end do
        if (table%sum_count == size(table%sums)) then
            allocate (larger(2*table%sum_count))
            do i = 1, table%sum_count
                larger(i) = table%sums(i)
            end do
            call move_alloc(larger, table%sums)
        end if
        table%sum_count = table%sum_count + 1
        place = table%sum_count
        table%sums(place) = s
    end subroutine find_sum

    pure subroutine classify(table, atom)
        !! Symbols by their names, sums and powers by what they are made of.
        type(table_t), intent(in) :: table
        type(atom_t), intent(inout) :: atom

        select case (atom%kind)
        case (atom_number_pi)
            atom%class = class_parameter
        case (atom_symbol)
            atom%class = table%class(atom%which)
        case (atom_function)
            atom%class = class_function  ! m g x sin(alpha), but sqrt(2) x
            if (atom%which == f_sqrt .and. of_parameters(table, atom%argument)) then
                atom%class = class_parameter
            end if
        case default
            atom%class = class_parameter
            if (.not. of_parameters(table, atom%argument)) atom%class = class_function
            if (atom%kind /= atom_power) return
            if (.not. of_parameters(table, atom%exponent)) atom%class = class_function
        end select
    end subroutine classify

    pure function of_parameters(table, place) result(yes)
        !! Does a sum consist of parameters?
        type(table_t), intent(in) :: table
        integer, intent(in) :: place
        logical :: yes
        integer :: i, k

        yes = .true.
        do i = 1, table%sums(place)%count
            associate (term => table%sums(place)%terms(i))
                do k = 1, term%count
                    yes = yes .and. is_coefficient(table%order, term%atom(k))
                end do
            end associate
        end do
    end function of_parameters

    pure function precedes(table, a, b) result(yes)
        !! Does `a` stand before `b` in a product?
        type(table_t), intent(in) :: table
        type(atom_t), intent(in) :: a, b
        logical :: yes
        integer :: first

        first = a%class - b%class
        if (first == 0) first = a%kind - b%kind
        if (first == 0 .and. a%kind == atom_function) then
            first = findloc(preferred, a%which, 1) - findloc(preferred, b%which, 1)
        else if (first == 0 .and. a%kind == atom_symbol) then
            first = table%rank(a%which) - table%rank(b%which)
            if (first == 0) first = a%which - b%which
        end if
        if (first == 0 .and. a%argument > 0) then
            first = compare_sums(table, table%sums(a%argument), table%sums(b%argument))
            if (first == 0 .and. a%exponent > 0) then
                first = compare_sums(table, table%sums(a%exponent), table%sums(b%exponent))
            end if
        end if
        yes = first < 0
    end function precedes

    pure function compare_sums(table, a, b) result(first)
        !! Term by term, then by coefficients.
        type(table_t), intent(in) :: table
        type(sum_t), intent(in) :: a, b
        integer :: first, i
        real(dp) :: difference

        do i = 1, min(a%count, b%count)
            first = compare(table%order, a%terms(i), b%terms(i))
            if (first /= 0) return
        end do
        first = a%count - b%count
        if (first /= 0) return
        do i = 1, a%count
            difference = a%terms(i)%coefficient%value - b%terms(i)%coefficient%value
            if (is_nonzero(difference)) first = merge(-1, 1, difference < 0.0_dp)
            if (first /= 0) return
        end do
    end function compare_sums
end module lagrangia_atoms
