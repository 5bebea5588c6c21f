module lagrangia_other_rounding
    !! The same formulas with other rounding: each intermediate result is up to nine last digits
    !! off, each by a number of its own. Where terms cancel, what they leave is another one.
    !!
    !! Random rounding of single operations is the method CESTAC; here a result stays a smooth
    !! function of the state, which methods of a high order need.
    !! Source: J. Vignes, *A stochastic arithmetic for reliable scientific computation*, Mathematics
    !! and Computers in Simulation 35 (1993) 233.
    use lagrangia_formula_code, only: code_t, instruction_t, op_add, op_multiply, &
                                      op_multiply_add, op_multiply_subtract, op_negate, &
                                      op_product, op_sin_cos, op_subtract, op_subtract_product, &
                                      op_whole_power
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: round_otherwise

    real(dp), parameter :: last_digits(*) = [3.0_dp, -8.0_dp, 9.0_dp, -0.5_dp, -6.0_dp, 8.0_dp, &
                                             -3.5_dp, -7.5_dp]  ! no two pairs have one sum
    integer, parameter :: kinds = size(last_digits)

contains

    subroutine round_otherwise(code)
        !! Every result of an operation is multiplied by one of eight numbers beside 1, in turn.
        type(code_t), intent(inout) :: code  !! takes these numbers as registers, and one more
        type(instruction_t) :: steps(5*size(code%steps)), step
        integer :: behind, count, i, spare, turn

        behind = code%inputs + size(code%numbers)
        spare = code%registers + kinds + 1
        count = 0
        turn = 0
        do i = 1, size(code%steps)
            step = code%steps(i)
            step%a = moved(step%a)
            if (step%op /= op_whole_power) step%b = moved(step%b)
            step%c = moved(step%c)
            step%target = moved(step%target)
            select case (step%op)
            case (op_negate)
                call add(step)
            case (op_sin_cos)
                call add(step)
                call shift(step%target)
                call shift(step%b)
            case (op_multiply_add, op_multiply_subtract, op_subtract_product, op_product)
                call add(instruction_t(op_multiply, step%a, step%b, 0, spare))
                call shift(spare)
                call add_second(step)
                call shift(step%target)
            case default
                call add(step)
                call shift(step%target)
            end select
        end do
        code%steps = steps(:count)
        code%numbers = [code%numbers, 1.0_dp + epsilon(1.0_dp)*last_digits]
        code%outputs = moved(code%outputs)
        code%registers = spare
    contains
        elemental function moved(register) result(to)
            !! To make room for the numbers.
            integer, intent(in) :: register
            integer :: to

            to = register
            if (register > behind) to = register + kinds
        end function moved

        subroutine add(this)
            type(instruction_t), intent(in) :: this

            count = count + 1
            steps(count) = this
        end subroutine add

        subroutine add_second(this)
            !! What is left of an instruction when its product is in the spare register.
            type(instruction_t), intent(in) :: this

            select case (this%op)
            case (op_multiply_add)
                call add(instruction_t(op_add, spare, this%c, 0, this%target))
            case (op_multiply_subtract)
                call add(instruction_t(op_subtract, spare, this%c, 0, this%target))
            case (op_subtract_product)
                call add(instruction_t(op_subtract, this%c, spare, 0, this%target))
            case default
                call add(instruction_t(op_multiply, spare, this%c, 0, this%target))
            end select
        end subroutine add_second

        subroutine shift(register)
            integer, intent(in) :: register

            turn = mod(turn, kinds) + 1
            call add(instruction_t(op_multiply, register, behind + turn, 0, register))
        end subroutine shift
    end subroutine round_otherwise
end module lagrangia_other_rounding
