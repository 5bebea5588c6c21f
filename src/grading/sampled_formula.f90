module lagrangia_sampled_formula
    !! A formula's value at many samples at once, and what it would be with one node changed.
    use lagrangia_expression, only: expression_t, f_cos, f_exp, f_sin, function_value, &
                                    kind_difference, kind_negation, &
                                    kind_number, kind_power, kind_product, kind_quotient, &
                                    kind_sum, kind_symbol
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero, is_zero
    implicit none (type, external)
    private
    public :: change_t
    public :: change_applied, change_argument, change_none, change_sign, change_factor, &
        change_symbol, change_function, &
              change_exponent, change_divided, change_multiplied, change_number
    public :: evaluate_nodes, summands

    integer, parameter :: change_none = 0
    integer, parameter :: change_sign = 1        !! the node with the other sign
    integer, parameter :: change_factor = 2      !! the node, `factor` times
    integer, parameter :: change_symbol = 3      !! the symbol `which` to the power of `factor`
    integer, parameter :: change_function = 4    !! another function, `which`, of its operand
    integer, parameter :: change_exponent = 5    !! the node to the power of `factor`
    integer, parameter :: change_divided = 6     !! the node without a factor, the symbol `which`
    integer, parameter :: change_multiplied = 7  !! with that factor
    integer, parameter :: change_number = 8      !! the number plus `factor`
    integer, parameter :: change_applied = 9     !! the function `which` of the node
    integer, parameter :: change_argument = 10   !! the operand of a function in its place

    type :: change_t
        !! Of one node.
        integer :: kind = change_none
        integer :: node = 0               !! its place
        integer :: which = 0              !! the symbol or the function
        real(dp) :: factor = 1.0_dp       !! the factor or the exponent
    end type change_t

contains

    subroutine evaluate_nodes(expression, values, results, change, sizes)
        !! The values of all nodes; that of the whole formula is the last. Their `sizes` say how
        !! large the rounding errors may be, in units of the relative error of one operation; they
        !! do not underflow where the values of what is not 0 do.
        type(expression_t), intent(in) :: expression      !! not empty
        real(dp), intent(in) :: values(:, :)              !! of the symbols, (samples, symbols)
        real(dp), intent(out) :: results(:, :)
        !! (samples, nodes); NaN where there is none
        type(change_t), intent(in), optional :: change    !! of one node
        real(dp), intent(out), optional :: sizes(:, :)    !! as many
        integer :: i

        do i = 1, expression%count
            associate (node => expression%nodes(i))
                select case (node%kind)
                case (kind_number)
                    results(:, i) = node%number%value
                case (kind_symbol)
                    results(:, i) = values(:, node%which)
                case (kind_sum)
                    results(:, i) = results(:, node%left) + results(:, node%right)
                case (kind_difference)
                    results(:, i) = results(:, node%left) - results(:, node%right)
                case (kind_product)
                    results(:, i) = results(:, node%left)*results(:, node%right)
                case (kind_quotient)
                    results(:, i) = results(:, node%left)/results(:, node%right)
                case (kind_power)
                    results(:, i) = power(results(:, node%left), results(:, node%right))
                case (kind_negation)
                    results(:, i) = -results(:, node%left)
                case default
                    results(:, i) = function_value(node%which, results(:, node%left))
                end select
                if (present(change)) then
                    if (change%node == i) call apply_change()
                end if
                if (present(sizes)) call measure()
            end associate
        end do
    contains
        subroutine apply_change()
            associate (node => expression%nodes(i))
                select case (change%kind)
                case (change_sign)
                    results(:, i) = -results(:, i)
                case (change_factor)
                    results(:, i) = change%factor*results(:, i)
                case (change_symbol)
                    results(:, i) = power(values(:, change%which), change%factor)
                case (change_function)
                    results(:, i) = function_value(change%which, results(:, node%left))
                case (change_exponent)
                    results(:, i) = power(results(:, i), change%factor)
                case (change_divided)
                    results(:, i) = results(:, i)/values(:, change%which)
                case (change_multiplied)
                    results(:, i) = results(:, i)*values(:, change%which)
                case (change_number)
                    results(:, i) = results(:, i) + change%factor
                case (change_applied)
                    results(:, i) = function_value(change%which, results(:, i))
                case (change_argument)
                    results(:, i) = results(:, node%left)
                case default
                    return
                end select
            end associate
        end subroutine apply_change

        subroutine measure()
            associate (node => expression%nodes(i), x => abs(results(:, i)))
                select case (node%kind)
                case (kind_number, kind_symbol)
                    sizes(:, i) = x
                case (kind_sum, kind_difference)
                    sizes(:, i) = sizes(:, node%left) + sizes(:, node%right)
                case (kind_product)
                    sizes(:, i) = sizes(:, node%left)*sizes(:, node%right)
                    call keep_from_zero(sizes(:, node%left) > 0.0_dp .and. &
                                        sizes(:, node%right) > 0.0_dp)
                case (kind_quotient)
                    sizes(:, i) = sizes(:, node%left)*sizes(:, node%right)/results(:, node%right)**2
                    call keep_from_zero(sizes(:, node%left) > 0.0_dp)
                case (kind_negation)
                    sizes(:, i) = sizes(:, node%left)
                case (kind_power)
                    sizes(:, i) = max(1.0_dp, abs(results(:, node%right)))
                    where (is_nonzero(results(:, node%left)))
                        sizes(:, i) = x*(sizes(:, node%left)/abs(results(:, node%left)))** &
                                      sizes(:, i)
                    else where
                        sizes(:, i) = sizes(:, node%left)**sizes(:, i)
                    end where
                    call keep_from_zero(sizes(:, node%left) > 0.0_dp)
                case default
                    if (node%which == f_sin .or. node%which == f_cos) then
                        sizes(:, i) = x + sizes(:, node%left)
                    else if (node%which == f_exp) then
                        sizes(:, i) = x*(1.0_dp + sizes(:, node%left))
                        call keep_from_zero(x >= 0.0_dp)
                    else
                        sizes(:, i) = (1.0_dp + x)*(1.0_dp + sizes(:, node%left))
                    end if
                end select
                where (sizes(:, i) < x) sizes(:, i) = x  ! and NaN stays
            end associate
        end subroutine measure

        subroutine keep_from_zero(those)
            !! The size of what is not 0, where it underflows.
            logical, intent(in) :: those(:)

            where (those .and. sizes(:, i) < tiny(sizes)) sizes(:, i) = tiny(sizes)
        end subroutine keep_from_zero
    end subroutine evaluate_nodes

    elemental function power(x, y) result(value)
        !! \(x^y\), with an integer exponent where it is one.
        real(dp), intent(in) :: x, y
        real(dp) :: value

        if (abs(y) < 1000.0_dp .and. is_zero(y - anint(y))) then
            value = x**nint(y)
        else
            value = x**y
        end if
    end function power

    pure subroutine summands(expression, nodes, signs)
        !! What is added up in a formula, through brackets of sums and signs.
        type(expression_t), intent(in) :: expression      !! not empty
        integer, allocatable, intent(out) :: nodes(:)     !! their places, in their order
        real(dp), allocatable, intent(out) :: signs(:)    !! 1 or -1: the formula is their sum
        real(dp) :: sign_of(expression%count)
        integer :: i

        sign_of = 0.0_dp
        sign_of(expression%count) = 1.0_dp
        do i = expression%count, 1, -1
            if (is_zero(sign_of(i))) cycle
            associate (node => expression%nodes(i))
                select case (node%kind)
                case (kind_sum)
                    sign_of(node%left) = sign_of(i)
                    sign_of(node%right) = sign_of(i)
                    sign_of(i) = 0.0_dp
                case (kind_difference)
                    sign_of(node%left) = sign_of(i)
                    sign_of(node%right) = -sign_of(i)
                    sign_of(i) = 0.0_dp
                case (kind_negation)
                    sign_of(node%left) = -sign_of(i)
                    sign_of(i) = 0.0_dp
                case default
                    cycle
                end select
            end associate
        end do
        nodes = pack([(i, i=1, expression%count)], is_nonzero(sign_of))
        signs = sign_of(nodes)
    end subroutine summands
end module lagrangia_sampled_formula
