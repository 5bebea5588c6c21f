module lagrangia_elementary
    !! Functions of sums: odd and even ones of what begins with a plus, plain values as numbers.
    use lagrangia_atoms, only: find_atom, single_factor, table_t
    use lagrangia_exact_number, only: number_of, number_t, operator(*), ratio
    use lagrangia_expression, only: f_abs, f_atan, f_cos, f_cosh, f_exp, f_sgn, f_sin, f_sinh, &
                                    f_sqrt, f_tan, f_tanh
    use lagrangia_kinds, only: dp, i8
    use lagrangia_monomials, only: atom_function, sum_t
    use lagrangia_sums, only: constant_sum, is_constant, scaled
    implicit none (type, external)
    private
    public :: find_function

contains

    pure subroutine find_function(table, which, argument, f)
        !! A function; of a negative angle by its symmetry, and the few values that are plain.
        type(table_t), intent(inout) :: table   !! may have one more atom
        integer, intent(in) :: which            !! `f_abs` to `f_tanh`
        type(sum_t), intent(in) :: argument     !! of the function
        type(sum_t), intent(out) :: f           !! the function as a sum
        type(sum_t) :: none, positive
        type(number_t) :: root
        real(dp) :: sign_of
        integer :: atom

        sign_of = 1.0_dp
        positive = argument
        if (argument%count == 0) then
            select case (which)
            case (f_abs, f_sgn, f_sin, f_sinh, f_tan, f_tanh, f_atan, f_sqrt)
                f = constant_sum(number_t())
                return
            case (f_cos, f_cosh, f_exp)
                f = constant_sum(number_of(1.0_dp))
                return
            case default
                continue  ! the logarithm stays what it is
            end select
        else if (argument%terms(1)%coefficient%value < 0.0_dp) then
            select case (which)
            case (f_sgn, f_sin, f_sinh, f_tan, f_tanh, f_atan)
                sign_of = -1.0_dp
                positive = scaled(argument, number_of(-1.0_dp))
            case (f_abs, f_cos, f_cosh)
                positive = scaled(argument, number_of(-1.0_dp))
            case default
                continue
            end select
        end if
        if (is_constant(positive) .and. positive%count == 1) then
            associate (c => positive%terms(1)%coefficient)
                if (which == f_abs) then
                    f = positive
                    return
                else if (which == f_sgn) then
                    f = constant_sum(number_of(sign_of))
                    return
                else if (which == f_sqrt .and. c%is_exact() .and. c%value > 0.0_dp) then
                    root = ratio(nint(sqrt(real(c%numerator, dp)), i8), &
                                 nint(sqrt(real(c%denominator, dp)), i8))
                    if (root%is_exact() .and. is_square(root, c)) then
                        f = constant_sum(root)
                        return
                    end if
                end if
            end associate
        end if
        call find_atom(table, atom_function, which, positive, none, atom)
        f = scaled(single_factor(atom, 1), number_of(sign_of))
    end subroutine find_function

    pure function is_square(root, c) result(yes)
        !! \(r^2 = c\), exactly?
        type(number_t), intent(in) :: root, c
        type(number_t) :: square
        logical :: yes

        square = root*root
        yes = square%is_exact() .and. square%numerator == c%numerator .and. &
              square%denominator == c%denominator
    end function is_square
end module lagrangia_elementary
