module lagrangia_magnitude
    !! How large the terms of a formula are, which may cancel in it.
    use lagrangia_expression, only: expression_t, f_abs, kind_difference, kind_function, &
                                    kind_negation, kind_product, kind_quotient, kind_sum
    implicit none (type, external)
    private
    public :: magnitude

contains

    pure function magnitude(expression) result(bound)
        !! The formula with \(|\,|\) around each number, symbol, power, function and divisor, and
        !! sums in place of differences: a value of a few epsilon of it is rounding.
        type(expression_t), intent(in) :: expression  !! of any symbols
        type(expression_t) :: bound                   !! of the same symbols
        integer, dimension(0:expression%count) :: plain, size_of
        ! the nodes of `bound` with the value of each node, and with its magnitude
        integer :: i

        plain(0) = 0
        do i = 1, expression%count
            associate (node => expression%nodes(i))
                call bound%add_copy(expression, i, plain)
                select case (node%kind)
                case (kind_negation)
                    size_of(i) = size_of(node%left)
                case (kind_sum, kind_difference)
                    call bound%add_operation(kind_sum, size_of(node%left), size_of(node%right), &
                                             size_of(i))
                case (kind_product)
                    call bound%add_operation(node%kind, size_of(node%left), size_of(node%right), &
                                             size_of(i))
                case (kind_quotient)
                    call in_bars(bound, plain(node%right), size_of(i))
                    call bound%add_operation(node%kind, size_of(node%left), size_of(i), &
                                             size_of(i))
                case default
                    call in_bars(bound, plain(i), size_of(i))
                end select
            end associate
        end do
        bound = bound%pruned(size_of(expression%count))
    contains
        pure subroutine in_bars(e, node, bars)
            type(expression_t), intent(inout) :: e
            integer, intent(in) :: node
            integer, intent(out) :: bars

            call e%add_operation(kind_function, node, 0, bars, f_abs)
        end subroutine in_bars
    end function magnitude
end module lagrangia_magnitude
