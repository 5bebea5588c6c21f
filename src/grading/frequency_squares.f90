module lagrangia_frequency_squares
    !! Where an equilibrium is unstable \(\omega^2\) is negative and omega has no number, so that
    !! formulas are compared by their squares.
    use lagrangia_expression, only: constant, expression_t, f_sqrt, kind_function, kind_number, &
                                    kind_power, kind_product, kind_quotient, kind_symbol, &
                                    operator(*), operator(**), operator(/), symbol
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero
    implicit none (type, external)
    private
    public :: is_of_period, square, with_squares

contains

    pure function square(formula, frequency) result(squared)
        !! Of products and quotients of positive numbers, letters and roots, which are taken for
        !! positive, so that two of them are equal if their squares are.
        type(expression_t), intent(in) :: formula  !! not empty
        integer, intent(in) :: frequency           !! the symbol omega; behind it that of its square
        type(expression_t) :: squared              !! empty: the sign is not known
        type(expression_t) :: squares(formula%count)
        integer :: i

        do i = 1, formula%count
            associate (node => formula%nodes(i))
                select case (node%kind)
                case (kind_number)
                    if (.not. node%number%value > 0.0_dp) cycle
                    squares(i) = constant(node%number%value)**2  ! pi^2
                    if (node%number%is_exact()) squares(i) = constant(node%number%value**2)
                case (kind_symbol)
                    squares(i) = symbol(node%which)**2
                    if (node%which == frequency) squares(i) = symbol(frequency + 1)
                case (kind_product, kind_quotient)
                    if (squares(node%left)%count == 0 .or. squares(node%right)%count == 0) cycle
                    if (node%kind == kind_product) then
                        squares(i) = squares(node%left)*squares(node%right)
                    else
                        squares(i) = squares(node%left)/squares(node%right)
                    end if
                case (kind_function)
                    if (node%which == f_sqrt) squares(i) = formula%pruned(node%left)
                case default
                    continue
                end select
            end associate
        end do
        squared = squares(formula%count)
    end function square

    pure function with_squares(formula, frequency) result(e)
        !! The formula with the square's symbol for `omega^2`, `(2 pi/omega)^2`, and without the
        !! roots of `sqrt(x)^2`.
        type(expression_t), intent(in) :: formula  !! may be anything
        integer, intent(in) :: frequency           !! the symbol omega; behind it that of its square
        type(expression_t) :: e
        type(expression_t) :: base
        integer :: becomes(0:formula%count), half, i

        e = formula
        if (.not. with_root(formula, frequency)) return
        e%count = 0
        becomes = 0
        do i = 1, formula%count
            associate (node => formula%nodes(i))
                half = 0
                if (node%kind == kind_power) then
                    base = formula%pruned(node%left)
                    if (with_root(base, frequency)) half = half_exponent(formula, node%right)
                    if (half /= 0) base = square(base, frequency)
                    if (base%count == 0) half = 0
                end if
                if (half == 0) then
                    call e%add_copy(formula, i, becomes)
                else
                    if (half /= 1) base = base**half
                    call e%append(base, becomes(i))
                end if
            end associate
        end do
        e = e%pruned(e%count)
    end function with_squares

    pure function with_root(formula, frequency) result(yes)
        !! Does it depend on omega, or has it a square root?
        type(expression_t), intent(in) :: formula
        integer, intent(in) :: frequency  !! the symbol omega
        logical :: yes

        associate (nodes => formula%nodes(:formula%count))
            yes = formula%depends_on(frequency) .or. &
                  any(nodes%kind == kind_function .and. nodes%which == f_sqrt)
        end associate
    end function with_root

    pure function half_exponent(formula, place) result(half)
        !! n of the exponent 2 n; 0: it is none.
        type(expression_t), intent(in) :: formula
        integer, intent(in) :: place  !! of the exponent
        integer :: half

        half = 0
        if (formula%nodes(place)%kind /= kind_number) return
        associate (number => formula%nodes(place)%number%value)
            if (abs(number) > 20.0_dp) return
            half = nint(number/2.0_dp)
            if (is_nonzero(number - 2*half)) half = 0
        end associate
    end function half_exponent

    pure function is_of_period(formula, frequency) result(inside)
        !! Which nodes are a part of \(2\pi/\omega\) or its square, which T was read as: the
        !! quotient as a whole is none.
        type(expression_t), intent(in) :: formula  !! not empty
        integer, intent(in) :: frequency           !! the symbol omega; behind it that of its square
        logical :: inside(formula%count)           !! of each
        logical :: numbers(0:formula%count)
        integer :: i

        numbers = .true.
        inside = .false.
        do i = 1, formula%count
            associate (node => formula%nodes(i))
                numbers(i) = node%kind /= kind_symbol .and. numbers(node%left) .and. &
                             numbers(node%right)
                if (node%kind /= kind_quotient .or. .not. numbers(node%left)) cycle
                if (formula%nodes(node%right)%kind /= kind_symbol) cycle
                if (all(formula%nodes(node%right)%which /= frequency + [0, 1])) cycle
                inside(node%left) = .true.
                inside(node%right) = .true.
            end associate
        end do
        do i = formula%count, 1, -1
            if (.not. inside(i)) cycle
            associate (node => formula%nodes(i))
                if (node%left > 0) inside(node%left) = .true.
                if (node%right > 0) inside(node%right) = .true.
            end associate
        end do
    end function is_of_period
end module lagrangia_frequency_squares
