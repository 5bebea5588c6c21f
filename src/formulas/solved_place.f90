module lagrangia_solved_place
    !! An equation that gives a symbol: `r = l0 + m g/k`, `cos(theta) = g/(w^2 r)`.
    use lagrangia_expression, only: apply, expression_t, f_atan, f_cos, f_sin, f_sqrt, &
                                    kind_function, kind_symbol, operator(*), operator(**), &
                                    operator(+), operator(-), operator(/), whole
    implicit none (type, external)
    private
    public :: solve_place

contains

    pure subroutine solve_place(left, right, which, function, place)
        !! `left` is a symbol, or its cosine or sine: the symbol is
        !! \(2\arctan\sqrt{(1 - c)/(1 + c)}\), from 0 to pi, or \(2\arctan\frac{s}{1 +
        !! \sqrt{1 - s^2}}\), from -pi/2 to pi/2; no number where there is no such angle.
        type(expression_t), intent(in) :: left, right   !! sides of the equation
        integer, intent(out) :: which                   !! symbol; 0: `left` is none of these
        integer, intent(out) :: function                !! 0, `f_cos` or `f_sin`
        type(expression_t), intent(out) :: place        !! the symbol's value

        which = 0
        function = 0
        if (left%count < 1 .or. left%count > 2) return
        if (left%nodes(1)%kind /= kind_symbol) return
        if (left%count == 2) then
            if (left%nodes(2)%kind /= kind_function) return
            function = left%nodes(2)%which
            if (all(function /= [f_cos, f_sin])) return
        end if
        which = left%nodes(1)%which
        select case (function)
        case (f_cos)
            place = whole(2)*apply(f_atan, apply(f_sqrt, (whole(1) - right)/(whole(1) + right)))
        case (f_sin)
            place = whole(2)*apply(f_atan, right/(whole(1) + apply(f_sqrt, whole(1) - right**2)))
        case default
            place = right
        end select
    end subroutine solve_place
end module lagrangia_solved_place
