module lagrangia_solved_place
    !! An equation that gives a symbol: `r = l0 + m g/k`, `cos(theta) = g/(w^2 r)`.
    use lagrangia_expression, only: apply, expression_t, f_atan, f_cos, f_sin, f_sqrt, &
                                    kind_function, kind_symbol, operator(*), operator(**), &
                                    operator(+), operator(-), operator(/), whole
    implicit none (type, external)
    private
    public :: arc_cosine, arc_sine, solve_place

contains

    pure subroutine solve_place(left, right, which, function, place)
        !! `left` is a symbol, or its cosine or sine; no number where there is no such angle.
        type(expression_t), intent(in) :: left, right   !! sides of the equation
        integer, intent(out) :: which                   !! symbol; 0: `left` is none of these
        integer, intent(out) :: function                !! 0, `f_cos` or `f_sin`
        type(expression_t), intent(out) :: place        !! the symbol's value

        which = 0
        function = 0
        if (left%count > 2) return
        if (left%nodes(1)%kind /= kind_symbol) return
        if (left%count == 2) then
            if (left%nodes(2)%kind /= kind_function) return
            function = left%nodes(2)%which
            if (all(function /= [f_cos, f_sin])) return
        end if
        which = left%nodes(1)%which
        select case (function)
        case (f_cos)
            place = arc_cosine(right)
        case (f_sin)
            place = arc_sine(right)
        case default
            place = right
        end select
    end subroutine solve_place

    pure function arc_cosine(c) result(angle)
        !! \(\arccos c=2\arctan\sqrt{(1 - c)/(1 + c)}\), from 0 to pi.
        type(expression_t), intent(in) :: c  !! not empty
        type(expression_t) :: angle

        angle = whole(2)*apply(f_atan, apply(f_sqrt, (whole(1) - c)/(whole(1) + c)))
    end function arc_cosine

    pure function arc_sine(s) result(angle)
        !! \(\arcsin s=2\arctan\frac{s}{1 + \sqrt{1 - s^2}}\), from -pi/2 to pi/2.
        type(expression_t), intent(in) :: s  !! not empty
        type(expression_t) :: angle

        angle = whole(2)*apply(f_atan, s/(whole(1) + apply(f_sqrt, whole(1) - s**2)))
    end function arc_sine
end module lagrangia_solved_place
