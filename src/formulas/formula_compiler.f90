module lagrangia_formula_compiler
    !! From formulas to instructions: what occurs twice is computed once, numbers beforehand; sums
    !! of products and the sine and cosine of one angle are one instruction each.
    use lagrangia_expression, only: expression_t, f_cos, f_sin, kind_function, kind_number, &
                                    kind_symbol
    use lagrangia_formula_code, only: code_t, instruction_t, op_add, op_divide, op_function, &
                                      op_input, op_multiply, op_multiply_add, &
                                      op_multiply_subtract, op_negate, op_number, op_power, &
                                      op_product, op_sin_cos, op_subtract, op_subtract_product, &
                                      op_whole_power
    use lagrangia_formula_values, only: value_t, values_t
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: compile

    type :: plan_t
        !! How values become instructions.
        integer, allocatable :: uses(:)       !! how often a value is an operand or a result
        integer, allocatable :: partner(:)    !! the sine of a cosine, the cosine of a sine
        logical, allocatable :: inside(:)     !! computed within the one instruction that needs it
        integer, allocatable :: register(:)   !! where a value is, 0 as long as it is nowhere
        integer, allocatable :: last(:)       !! the last value that is computed from it
        integer, allocatable :: free(:)       !! registers that can be used again
    end type plan_t

contains

    pure subroutine compile(expressions, inputs, code, fixed, values)
        !! The instructions that give all formulas at once.
        type(expression_t), intent(in) :: expressions(:)  !! over `inputs` symbols
        integer, intent(in) :: inputs                     !! number of symbols
        type(code_t), intent(out) :: code                 !! a result for each formula
        logical, intent(in) :: fixed(:)         !! symbols that stay as they are
        real(dp), intent(in) :: values(:)       !! the numbers that these are
        type(values_t) :: found
        type(plan_t) :: plan
        integer :: roots(size(expressions))
        integer :: i, input

        do i = 1, inputs  ! first, so that symbols are the first values
            call found%input(i, input)
        end do
        do i = 1, size(expressions)
            call evaluate_nodes(expressions(i), found, roots(i), fixed, values)
        end do
        code%inputs = inputs
        call count_uses(found, roots, plan)
        call join_operations(found, plan)
        call assign(found, roots, plan, code)
    end subroutine compile

    pure subroutine evaluate_nodes(expression, found, root, fixed, values)
        !! The values of all nodes.
        type(expression_t), intent(in) :: expression
        type(values_t), intent(inout) :: found
        integer, intent(out) :: root
        logical, intent(in) :: fixed(:)
        real(dp), intent(in) :: values(:)
        integer, parameter :: op_of(2:7) = [op_add, op_subtract, op_multiply, op_divide, &
                                            op_power, op_negate]
        integer :: place(0:expression%count), i

        place = 0
        do i = 1, expression%count
            associate (node => expression%nodes(i))
                select case (node%kind)
                case (kind_number)
                    call found%number(node%number%value, place(i))
                case (kind_symbol)
                    place(i) = node%which
                    if (fixed(node%which)) call found%number(values(node%which), place(i))
                case (kind_function)
                    call found%operation(op_function + node%which, place(node%left), 0, place(i))
                case default
                    call found%operation(op_of(node%kind), place(node%left), place(node%right), &
                                         place(i))
                end select
            end associate
        end do
        if (expression%count == 0) call found%number(0.0_dp, place(0))
        root = place(expression%count)
    end subroutine evaluate_nodes

    pure subroutine count_uses(found, roots, plan)
        !! Which values are needed, and how often.
        type(values_t), intent(in) :: found
        integer, intent(in) :: roots(:)
        type(plan_t), intent(out) :: plan
        integer :: i

        allocate (plan%uses(0:found%count), plan%partner(found%count), plan%register(found%count), &
                  source=0)
        allocate (plan%inside(found%count), source=.false.)
        do i = 1, size(roots)
            plan%uses(roots(i)) = plan%uses(roots(i)) + 2  ! a result is never inside another one
        end do
        do i = found%count, 1, -1
            if (plan%uses(i) == 0 .or. found%list(i)%op <= op_input) cycle
            plan%uses(found%list(i)%a) = plan%uses(found%list(i)%a) + 1
            if (has_two(found%list(i))) then
                plan%uses(found%list(i)%b) = plan%uses(found%list(i)%b) + 1
            end if
        end do
    end subroutine count_uses

    pure function has_two(value) result(yes)
        !! Are both operands values?
        type(value_t), intent(in) :: value
        logical :: yes

        yes = any(value%op == [op_add, op_subtract, op_multiply, op_divide, op_power])
    end function has_two

    pure subroutine join_operations(found, plan)
        !! A product that is used once becomes a part of the sum or product that uses it; sine and
        !! cosine of one angle go together.
        type(values_t), intent(in) :: found
        type(plan_t), intent(inout) :: plan
        integer :: i, sine(found%count), cosine(found%count)

        sine = 0
        cosine = 0
        do i = 1, found%count
            if (plan%uses(i) == 0) cycle
            associate (value => found%list(i))
                select case (value%op)
                case (op_function + f_sin)
                    sine(value%a) = i
                case (op_function + f_cos)
                    cosine(value%a) = i
                case (op_add, op_subtract, op_multiply)
                    if (goes_inside(value%a)) then
                        plan%inside(value%a) = .true.
                    else if (goes_inside(value%b)) then
                        plan%inside(value%b) = .true.
                    end if
                case default
                    continue
                end select
            end associate
        end do
        do i = 1, found%count
            if (sine(i) == 0 .or. cosine(i) == 0) cycle
            plan%partner(sine(i)) = cosine(i)
            plan%partner(cosine(i)) = sine(i)
        end do
    contains
        pure function goes_inside(k) result(yes)
            !! Three factors at most are one instruction.
            integer, intent(in) :: k
            logical :: yes

            yes = .false.
            if (found%list(k)%op /= op_multiply .or. plan%uses(k) /= 1) return
            yes = .not. (plan%inside(found%list(k)%a) .or. plan%inside(found%list(k)%b))
        end function goes_inside
    end subroutine join_operations

    pure subroutine assign(found, roots, plan, code)
        !! Give every value a register, which is free again behind the last use of it.
        type(values_t), intent(in) :: found
        integer, intent(in) :: roots(:)
        type(plan_t), intent(inout) :: plan
        type(code_t), intent(inout) :: code
        type(instruction_t) :: step
        integer :: i, steps

        call fill_registers(found, plan, code)
        call find_last_uses(found, roots, plan)
        allocate (plan%free(0), code%steps(found%count))
        steps = 0
        do i = code%inputs + 1, found%count
            if (.not. is_step(found, plan, i)) cycle
            steps = steps + 1
            call write_step(found, plan, i, code, step)
            code%steps(steps) = step
        end do
        code%steps = code%steps(:steps)
        allocate (code%outputs(size(roots)))
        code%outputs = plan%register(roots)
    end subroutine assign

    pure subroutine fill_registers(found, plan, code)
        !! Symbols, then numbers.
        type(values_t), intent(in) :: found
        type(plan_t), intent(inout) :: plan
        type(code_t), intent(inout) :: code
        integer :: i, k

        allocate (code%numbers(found%count))
        plan%register(:code%inputs) = [(i, i=1, code%inputs)]
        k = 0
        do i = 1, found%count
            if (found%list(i)%op /= op_number .or. plan%uses(i) == 0) cycle
            k = k + 1
            code%numbers(k) = found%list(i)%number
            plan%register(i) = code%inputs + k
        end do
        code%numbers = code%numbers(:k)
        code%registers = k + code%inputs
    end subroutine fill_registers

    pure function is_step(found, plan, i) result(yes)
        !! Is value `i` computed by an instruction of its own, and not yet?
        type(values_t), intent(in) :: found
        type(plan_t), intent(in) :: plan
        integer, intent(in) :: i
        logical :: yes

        yes = plan%uses(i) > 0 .and. .not. plan%inside(i) .and. found%list(i)%op > op_input &
              .and. plan%register(i) == 0
    end function is_step

    pure subroutine find_last_uses(found, roots, plan)
        !! The last value that is computed from each value.
        type(values_t), intent(in) :: found
        integer, intent(in) :: roots(:)
        type(plan_t), intent(inout) :: plan
        integer :: i, k, op, operands(3)

        allocate (plan%last(found%count), source=0)
        do i = 1, found%count
            if (.not. is_step(found, plan, i)) cycle
            if (plan%partner(i) > 0 .and. plan%partner(i) < i) cycle  ! computed there
            call operands_of(found, plan, i, op, operands)
            do k = 1, 3
                if (operands(k) > 0) plan%last(operands(k)) = i
            end do
        end do
        plan%last(roots) = huge(1)
    end subroutine find_last_uses

    pure subroutine operands_of(found, plan, i, op, operands)
        !! The instruction for value `i`, and the values that it reads, 0 where there are fewer.
        type(values_t), intent(in) :: found
        type(plan_t), intent(in) :: plan
        integer, intent(in) :: i
        integer, intent(out) :: op, operands(3)
        integer :: other, product

        associate (value => found%list(i))
            op = value%op
            operands = [value%a, value%b, 0]
            if (op == op_whole_power .or. op > op_function) operands(2) = 0
            if (plan%partner(i) > 0) op = op_sin_cos
            if (all(op /= [op_add, op_subtract, op_multiply])) return
            product = 0
            other = value%b
            if (plan%inside(value%a)) product = value%a
            if (plan%inside(value%b)) then
                product = value%b
                other = value%a
            end if
            if (product == 0) return
            operands = [found%list(product)%a, found%list(product)%b, other]
            select case (op)
            case (op_add)
                op = op_multiply_add
            case (op_multiply)
                op = op_product
            case default
                op = merge(op_multiply_subtract, op_subtract_product, product == value%a)
            end select
        end associate
    end subroutine operands_of

    pure subroutine write_step(found, plan, i, code, step)
        !! The instruction for value `i`.
        type(values_t), intent(in) :: found
        type(plan_t), intent(inout) :: plan
        integer, intent(in) :: i
        type(code_t), intent(inout) :: code
        type(instruction_t), intent(out) :: step
        integer :: k, operands(3), registers(3)

        call operands_of(found, plan, i, step%op, operands)
        registers = 0
        do k = 1, 3
            if (operands(k) == 0) cycle
            registers(k) = plan%register(operands(k))
            if (plan%last(operands(k)) /= i .or. found%list(operands(k))%op <= op_input) cycle
            if (all(operands(:k - 1) /= operands(k))) plan%free = [plan%free, registers(k)]
        end do
        step%a = registers(1)
        step%b = registers(2)
        step%c = registers(3)
        if (step%op == op_whole_power) step%b = found%list(i)%b
        call take(plan, code, i)
        step%target = plan%register(i)
        if (step%op /= op_sin_cos) return
        call take(plan, code, plan%partner(i))
        step%b = plan%register(plan%partner(i))
        if (found%list(i)%op == op_function + f_sin) return
        step%b = step%target
        step%target = plan%register(plan%partner(i))
    end subroutine write_step

    pure subroutine take(plan, code, which)
        !! A register for a value.
        type(plan_t), intent(inout) :: plan
        type(code_t), intent(inout) :: code
        integer, intent(in) :: which

        if (size(plan%free) > 0) then
            plan%register(which) = plan%free(size(plan%free))
            plan%free = plan%free(:size(plan%free) - 1)
        else
            code%registers = code%registers + 1
            plan%register(which) = code%registers
        end if
    end subroutine take
end module lagrangia_formula_compiler
