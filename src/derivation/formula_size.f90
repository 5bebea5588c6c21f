module lagrangia_formula_size
    !! A formula's value, and what rounding may make of it.
    use lagrangia_expression, only: expression_t, kind_difference, kind_function, kind_negation, &
                                    kind_number, kind_power, kind_product, kind_quotient, &
                                    kind_sum, kind_symbol
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: evaluate

contains

    subroutine evaluate(e, values, value, noise)
        !! A formula, and a bound of what rounding adds: as many units in the last place as it has
        !! operations, of the sum of the sizes of its terms.
        type(expression_t), intent(in) :: e       !! any
        real(dp), intent(in) :: values(:)         !! of the symbols
        real(dp), intent(out) :: value, noise     !! in the formula's unit
        type(formula_program_t) :: program
        type(expression_t) :: one(1)
        real(dp), allocatable :: size_of(:), at(:)
        real(dp) :: results(1)
        integer :: i

        one(1) = e
        call new_formula_program(program, one, size(values))
        call program%evaluate(values, results)
        value = results(1)
        allocate (size_of(e%count), at(e%count))
        do i = 1, e%count
            associate (node => e%nodes(i))
                select case (node%kind)
                case (kind_number)
                    at(i) = node%number%value
                    size_of(i) = abs(at(i))
                case (kind_symbol)
                    at(i) = values(node%which)
                    size_of(i) = abs(at(i))
                case (kind_sum, kind_difference)
                    at(i) = at(node%left) + merge(1, -1, node%kind == kind_sum)*at(node%right)
                    size_of(i) = size_of(node%left) + size_of(node%right)
                case (kind_negation)
                    at(i) = -at(node%left)
                    size_of(i) = size_of(node%left)
                case (kind_product)
                    at(i) = at(node%left)*at(node%right)
                    size_of(i) = size_of(node%left)*size_of(node%right)
                case (kind_quotient)
                    at(i) = at(node%left)/at(node%right)
                    size_of(i) = size_of(node%left)/abs(at(node%right)) &
                                 *(size_of(node%right)/abs(at(node%right)))
                case (kind_power)
                    if (at(node%left) < 0.0_dp) then
                        at(i) = at(node%left)**nint(at(node%right))
                    else
                        at(i) = at(node%left)**at(node%right)
                    end if
                    size_of(i) = size_of(node%left)**abs(at(node%right))
                    if (at(node%right) < 0.0_dp) size_of(i) = abs(at(i)) &
                        *(size_of(node%left)/abs(at(node%left)))**abs(at(node%right))
                case default
                    call take_function(node%which, at(node%left), size_of(node%left), at(i), &
                                       size_of(i))
                end select
            end associate
        end do
        noise = 4.0_dp*e%count*epsilon(1.0_dp)*size_of(e%count)
    end subroutine evaluate

    subroutine take_function(which, x, size_of_x, y, size_of_y)
        !! Its value, and the size that the argument's rounding gives it.
        integer, intent(in) :: which
        real(dp), intent(in) :: x, size_of_x
        real(dp), intent(out) :: y, size_of_y
        type(formula_program_t) :: program
        type(expression_t) :: one(1)
        type(hyperdual_t) :: results(1)
        integer :: node

        call one(1)%add_symbol(1, node)
        call one(1)%add_operation(kind_function, 1, 0, node, which)
        call new_formula_program(program, one, 1)
        call program%evaluate([hyperdual_t(x, 1.0_dp, 1.0_dp, 0.0_dp)], results)
        y = results(1)%re
        size_of_y = abs(y) + abs(results(1)%d1)*size_of_x
    end subroutine take_function
end module lagrangia_formula_size
