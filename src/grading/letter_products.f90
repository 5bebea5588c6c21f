module lagrangia_letter_products
    !! A factor that a student forgot or added, as a number or a product of parameters and of sums
    !! of them: `(m1 + m2)/m1`, `2 m r^2`.
    use lagrangia_expression, only: constant, expression_t, kind_difference, kind_sum, &
                                    operator(*), operator(**), operator(/), symbol, whole
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: all_finite, is_nonzero
    use lagrangia_sample_names, only: draws, role_parameter, samples_t, states
    use lagrangia_sampled_formula, only: evaluate_nodes
    implicit none (type, external)
    private
    public :: letter_t
    public :: add_letters, collect_letters, find_product

    integer, parameter :: most_letters = 3            !! of one product
    integer, parameter :: exponents(*) = [1, -1, 2, -2]
    integer, parameter :: largest_denominator = 12    !! of the number before it
    real(dp), parameter :: equal = 1e-7_dp            !! relative difference of factors that are one

    type :: letter_t
        !! A parameter, or a sum of them in brackets.
        type(expression_t) :: formula
        real(dp) :: value(draws) = 1.0_dp  !! for each draw of parameters
    end type letter_t

contains

    subroutine collect_letters(samples, letters)
        !! The parameters that are not zero.
        type(samples_t), intent(in) :: samples                       !! know them
        type(letter_t), allocatable, intent(out) :: letters(:)       !! in their order
        integer :: k

        allocate (letters(0))
        do k = 1, size(samples%role)
            if (is_constant(samples, k)) call add(letters, symbol(k), samples)
        end do
    end subroutine collect_letters

    subroutine add_letters(samples, expression, letters)
        !! The sums of parameters within a formula.
        type(samples_t), intent(in) :: samples                       !! know the names
        type(expression_t), intent(in) :: expression                 !! of them
        type(letter_t), allocatable, intent(inout) :: letters(:)     !! gets those that are new
        type(expression_t) :: part
        integer :: i, k
        logical :: constant_one

        do i = 1, expression%count
            if (expression%nodes(i)%kind /= kind_sum .and. &
                expression%nodes(i)%kind /= kind_difference) cycle
            part = expression%pruned(i)
            constant_one = .true.
            do k = 1, size(samples%role)
                if (part%depends_on(k)) constant_one = constant_one .and. is_constant(samples, k)
            end do
            if (constant_one) call add(letters, part, samples)
        end do
    end subroutine add_letters

    pure function is_constant(samples, k) result(yes)
        !! A parameter, or a letter that does not move.
        type(samples_t), intent(in) :: samples
        integer, intent(in) :: k
        logical :: yes

        yes = samples%role(k) == role_parameter .and. samples%rate(k) == 0
    end function is_constant

    subroutine add(letters, formula, samples)
        !! One more, unless it has no value, is the same number in all draws, of which any number
        !! is a product, or there is one with the same values.
        type(letter_t), allocatable, intent(inout) :: letters(:)
        type(expression_t), intent(in) :: formula
        type(samples_t), intent(in) :: samples
        type(letter_t), allocatable :: longer(:)
        real(dp) :: results(draws, formula%count), value(draws)
        integer :: i

        call evaluate_nodes(formula, samples%values(1::states, :), results)
        value = results(:, formula%count)
        if (.not. all_finite(value)) return
        if (all(abs(value - value(1)) <= equal*abs(value))) return
        do i = 1, size(letters)
            if (any(abs(value - letters(i)%value) > equal*abs(value))) cycle
            if (formula%count == 1) letters(i)%formula = formula  ! a letter rather than its name
            return
        end do
        allocate (longer(size(letters) + 1))
        do i = 1, size(letters)
            longer(i) = letters(i)
        end do
        longer(size(longer))%formula = formula
        longer(size(longer))%value = value
        call move_alloc(longer, letters)
    end subroutine add

    pure subroutine find_product(needed, letters, product, found)
        !! The product of few letters, and a simple fraction, that has these values.
        real(dp), intent(in) :: needed(:)                !! for each draw, finite and not zero
        type(letter_t), intent(in) :: letters(:)         !! of which it may consist
        type(expression_t), intent(out) :: product       !! if there is one
        logical, intent(out) :: found                    !! there is
        integer :: powers(size(letters)), n

        do n = 0, most_letters
            call search(needed, letters, 1, n, powers, found)
            if (found) exit
        end do
        if (found) call write_product(needed, letters, powers, product)
    end subroutine find_product

    pure recursive subroutine search(needed, letters, first, number, powers, found)
        !! `number` letters from the `first` one on.
        real(dp), intent(in) :: needed(:)
        type(letter_t), intent(in) :: letters(:)
        integer, intent(in) :: first, number
        integer, intent(inout) :: powers(:)
        logical, intent(out) :: found
        integer :: i, k

        if (number == 0) then
            found = all(abs(needed - needed(1)) <= equal*abs(needed(1)))
            if (found) found = denominator_of(needed(1)) > 0
            powers(first:) = 0
            return
        end if
        found = .false.
        do i = first, size(letters)
            powers(first:i) = 0
            do k = 1, size(exponents)
                powers(i) = exponents(k)
                call search(needed/letters(i)%value**exponents(k), letters, i + 1, number - 1, &
                            powers, found)
                if (found) return
            end do
        end do
    end subroutine search

    pure function denominator_of(value) result(denominator)
        !! Of a simple fraction; 0 if it is none.
        real(dp), intent(in) :: value
        integer :: denominator

        do denominator = 1, largest_denominator
            if (abs(value)*denominator > 100.0_dp) exit
            if (abs(value*denominator - anint(value*denominator)) <= equal*denominator .and. &
                nint(value*denominator) /= 0) return
        end do
        denominator = 0
    end function denominator_of

    pure subroutine write_product(needed, letters, powers, product)
        !! `2 (m1 + m2)/m1`, for the canonical form to put in order.
        real(dp), intent(in) :: needed(:)
        type(letter_t), intent(in) :: letters(:)
        integer, intent(in) :: powers(:)
        type(expression_t), intent(out) :: product
        type(expression_t) :: below, factor
        real(dp) :: number
        integer :: denominator, i
        logical :: begun

        number = needed(1)
        do i = 1, size(letters)
            number = number/letters(i)%value(1)**powers(i)
        end do
        denominator = denominator_of(number)
        number = anint(number*denominator)
        begun = is_nonzero(number - 1.0_dp) .or. denominator > 1 .or. .not. any(powers > 0)
        if (begun) product = constant(number)
        if (denominator > 1) product = product/whole(denominator)
        do i = 1, size(letters)
            if (powers(i) < 1) cycle
            factor = letters(i)%formula
            if (powers(i) > 1) factor = factor**powers(i)
            if (begun) factor = product*factor
            product = factor
            begun = .true.
        end do
        begun = .false.
        do i = 1, size(letters)
            if (powers(i) > -1) cycle
            factor = letters(i)%formula
            if (powers(i) < -1) factor = factor**(-powers(i))
            if (begun) factor = below*factor
            below = factor
            begun = .true.
        end do
        if (begun) product = product/below
    end subroutine write_product
end module lagrangia_letter_products
