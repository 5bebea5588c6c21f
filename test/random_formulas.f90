module random_formulas
    !! Formulas at random, the same ones in every run, and a plain evaluation of them with a bound
    !! of its rounding.
    use lagrangia_exact_number, only: number_of, ratio
    use lagrangia_expression, only: expression_t, f_abs, f_atan, f_cos, f_cosh, f_exp, f_log, &
                                    f_sgn, f_sin, f_sinh, f_sqrt, f_tan, kind_difference, &
                                    kind_function, kind_negation, kind_number, kind_power, &
                                    kind_product, kind_quotient, kind_sum, kind_symbol
    use lagrangia_hyperdual, only: abs, assignment(=), atan, cos, cosh, exp, hyperdual_t, log, &
                                   operator(*), operator(**), operator(+), operator(-), &
                                   operator(/), sgn, sin, sinh, sqrt, tan, tanh
    use lagrangia_kinds, only: dp, i8
    use random_states, only: uniform
    implicit none (type, external)
    private
    public :: draw_formula, draw_number, plain_value

    real(dp), parameter :: u = epsilon(1.0_dp)

contains

    function draw_number(most) result(n)
        !! From 1 to `most`.
        integer, intent(in) :: most
        integer :: n

        n = min(most, 1 + int(uniform(0.0_dp, real(most, dp))))
    end function draw_number

    subroutine draw_formula(symbols, operations, e)
        !! So many operations on numbers and symbols.
        integer, intent(in) :: symbols, operations
        type(expression_t), intent(out) :: e
        integer :: pool(operations + 1), i, k, left, node, right, size_of_pool

        do i = 1, operations + 1
            if (draw_number(4) == 1) then
                call draw_constant(e, pool(i))
            else
                call e%add_symbol(draw_number(symbols), pool(i))
            end if
        end do
        size_of_pool = operations + 1
        do i = 1, operations
            k = draw_number(size_of_pool)
            left = pool(k)
            select case (draw_number(12))
            case (1)
                call e%add_operation(kind_negation, left, 0, node)
            case (2, 3, 4)
                call e%add_operation(kind_function, left, 0, node, draw_number(11))
            case (5, 6)
                call e%add_number(number_of(real(draw_number(7) - 3, dp)), right)
                call e%add_operation(kind_power, left, right, node)
            case default
                right = pool(draw_number(size_of_pool))
                call e%add_operation(kind_sum + min(3, draw_number(5) - 1), left, right, node)
            end select
            pool(k) = node
        end do
        e = e%pruned(e%count)
    end subroutine draw_formula

    subroutine draw_constant(e, node)
        !! A whole number, a fraction or a decimal.
        type(expression_t), intent(inout) :: e
        integer, intent(out) :: node

        select case (draw_number(4))
        case (1)
            call e%add_number(ratio(int(draw_number(9), i8), int(draw_number(20), i8)), node)
        case (2)
            call e%add_number(number_of(uniform(0.0_dp, 3.0_dp)), node)
        case default
            call e%add_number(ratio(int(draw_number(5), i8), 1_i8), node)
        end select
    end subroutine draw_constant

    pure subroutine plain_value(e, x, value, bound)
        !! One operation after the other; `bound` is how far rounding may carry the value (running
        !! error analysis, four roundings an operation).
        type(expression_t), intent(in) :: e
        type(hyperdual_t), intent(in) :: x(:)
        type(hyperdual_t), intent(out) :: value
        real(dp), intent(out) :: bound
        type(hyperdual_t) :: v(e%count), f
        real(dp) :: b(e%count)
        integer :: i

        do i = 1, e%count
            associate (node => e%nodes(i), l => e%nodes(i)%left, r => e%nodes(i)%right)
                select case (node%kind)
                case (kind_number)
                    v(i) = node%number%value
                    b(i) = 0.0_dp
                case (kind_symbol)
                    v(i) = x(node%which)
                    b(i) = 0.0_dp
                case (kind_sum)
                    v(i) = v(l) + v(r)
                    b(i) = b(l) + b(r)
                case (kind_difference)
                    v(i) = v(l) - v(r)
                    b(i) = b(l) + b(r)
                case (kind_product)
                    v(i) = v(l)*v(r)
                    b(i) = abs(v(l)%re)*b(r) + abs(v(r)%re)*b(l) + b(l)*b(r)
                case (kind_quotient)
                    v(i) = v(l)/v(r)
                    b(i) = (b(l) + abs(v(i)%re)*b(r))/max(0.0_dp, abs(v(r)%re) - b(r))
                case (kind_negation)
                    v(i) = -v(l)
                    b(i) = b(l)
                case (kind_power)
                    v(i) = v(l)**v(r)%re
                    f = hyperdual_t(v(l)%re, 1.0_dp)**v(r)%re
                    b(i) = spread_of(f, v(l)%re, b(l))
                case default
                    v(i) = function_of(node%which, v(l))
                    f = function_of(node%which, hyperdual_t(v(l)%re, 1.0_dp, 1.0_dp))
                    b(i) = spread_of(f, v(l)%re, b(l))
                end select
                if (node%kind > kind_symbol) b(i) = b(i) + 4.0_dp*u*abs(v(i)%re)
            end associate
        end do
        value = v(e%count)
        bound = b(e%count)
    end subroutine plain_value

    pure function spread_of(f, x, b) result(spread)
        !! What an error of `b` in `x` makes of a function with these derivatives; no number where
        !! it is not small.
        type(hyperdual_t), intent(in) :: f
        real(dp), intent(in) :: x, b
        real(dp) :: spread

        spread = 2.0_dp*abs(f%d1)*b + b*1e-6_dp
        if (b > 1e-6_dp*abs(x)) spread = huge(1.0_dp)
    end function spread_of

    pure function function_of(which, x) result(y)
        !! By name.
        integer, intent(in) :: which
        type(hyperdual_t), intent(in) :: x
        type(hyperdual_t) :: y

        select case (which)
        case (f_abs); y = abs(x)
        case (f_atan); y = atan(x)
        case (f_cos); y = cos(x)
        case (f_cosh); y = cosh(x)
        case (f_exp); y = exp(x)
        case (f_log); y = log(x)
        case (f_sgn); y = sgn(x)
        case (f_sin); y = sin(x)
        case (f_sinh); y = sinh(x)
        case (f_sqrt); y = sqrt(x)
        case (f_tan); y = tan(x)
        case default; y = tanh(x)
        end select
    end function function_of
end module random_formulas
