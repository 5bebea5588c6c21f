module lagrangia_formula_program
    !! Formulas ready to be evaluated, all at once: for doubles, hyper-dual numbers, and in lanes.
    !!
    !! Evaluation is a loop over instructions; it allocates nothing as long as the formulas need no
    !! more registers than there is room for on the stack.
    use lagrangia_expression, only: expression_t, f_abs, f_atan, f_cos, f_cosh, f_exp, f_log, &
                                    f_sgn, f_sin, f_sinh, f_sqrt, f_tan, function_value, &
                                    real_power
    use lagrangia_formula_code, only: code_t, op_add, op_divide, op_function, op_multiply, &
                                      op_multiply_add, op_multiply_subtract, op_negate, op_power, &
                                      op_product, op_sin_cos, op_subtract, op_subtract_product, &
                                      op_whole_power
    use lagrangia_formula_compiler, only: compile
    use lagrangia_hyperdual, only: abs, assignment(=), atan, cos, cosh, exp, hyperdual_t, log, &
                                   operator(*), operator(**), operator(+), operator(-), &
                                   operator(/), sgn, sin, sinh, sqrt, tan, tanh
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_other_rounding, only: round_code_otherwise => round_otherwise
    use lagrangia_sine_cosine, only: sine_cosine
    implicit none (type, external)
    private
    public :: formula_program_t
    public :: new_formula_program

    integer, parameter :: room = 256, room_hyperdual = 64  !! registers on the stack

    type :: formula_program_t
        !! No results until `new_formula_program` has been called.
        private
        type(code_t) :: code
        integer, public :: inputs = 0   !! symbols whose values it takes
        integer, public :: outputs = 0  !! results that it gives
        integer, public :: registers = 0             !! that `run` takes
        integer, allocatable, public :: places(:)    !! register of each result, behind `run`
    contains
        generic :: evaluate => evaluate_real, evaluate_hyperdual, evaluate_lanes
        procedure :: run
        procedure :: round_otherwise
        procedure, private :: evaluate_real
        procedure, private :: evaluate_hyperdual
        procedure, private :: evaluate_lanes
    end type formula_program_t

contains

    pure subroutine new_formula_program(self, expressions, inputs, fixed, values)
        !! Compile formulas; with `fixed` for given values of some symbols, which then no longer
        !! count.
        type(formula_program_t), intent(out) :: self      !! gives a result for each formula
        type(expression_t), intent(in) :: expressions(:)  !! over the same symbols
        integer, intent(in) :: inputs                     !! number of symbols
        logical, intent(in), optional :: fixed(:)         !! (inputs): symbols with a value
        real(dp), intent(in), optional :: values(:)       !! (inputs): these values
        logical :: none(inputs)
        real(dp) :: zeros(inputs)

        if (present(fixed) .and. present(values)) then
            call compile(expressions, inputs, self%code, fixed, values)
        else
            none = .false.
            zeros = 0.0_dp
            call compile(expressions, inputs, self%code, none, zeros)
        end if
        self%inputs = inputs
        self%outputs = size(expressions)
        self%registers = self%code%registers
        self%places = self%code%outputs
    end subroutine new_formula_program

    subroutine round_otherwise(self)
        !! From now on each intermediate result is some last digits off.
        class(formula_program_t), intent(inout) :: self

        if (.not. allocated(self%places)) return  ! nothing has been compiled
        call round_code_otherwise(self%code)
        self%registers = self%code%registers
        self%places = self%code%outputs
    end subroutine round_otherwise

    pure subroutine evaluate_real(self, values, results)
        !! All results at one state.
        class(formula_program_t), intent(in) :: self
        real(dp), intent(in) :: values(self%inputs)      !! of the symbols
        real(dp), intent(out) :: results(self%outputs)   !! of the formulas
        real(dp) :: r(room)

        if (self%registers <= room) then
            r(:self%inputs) = values
            call self%run(r)
            results = r(self%places)
        else
            call evaluate_large(self, values, results)
        end if
    end subroutine evaluate_real

    pure subroutine evaluate_large(self, values, results)
        !! With registers on the heap.
        type(formula_program_t), intent(in) :: self
        real(dp), intent(in) :: values(self%inputs)
        real(dp), intent(out) :: results(self%outputs)
        real(dp), allocatable :: r(:)

        allocate (r(self%registers))
        r(:self%inputs) = values
        call self%run(r)
        results = r(self%places)
    end subroutine evaluate_large

    pure subroutine run(self, r)
        !! The instructions on registers of the caller's, so that nothing is copied: its first ones
        !! are the symbols, and result k is in register `places(k)`.
        class(formula_program_t), intent(in) :: self
        real(dp), intent(inout) :: r(self%registers)  !! overwritten but for the symbols

        call work(self%code, r)
    end subroutine run

    pure subroutine work(code, r)
        !! The instructions, on doubles.
        type(code_t), intent(in) :: code
        real(dp), intent(inout) :: r(code%registers)
        real(dp) :: x
        integer :: i, n

        n = code%inputs
        !GCC$ novector
        do i = 1, size(code%numbers)  ! few: vector instructions would cost more than they save
            r(n + i) = code%numbers(i)
        end do
        do i = 1, size(code%steps)
            associate (step => code%steps(i))
                select case (step%op)
                case (op_add); r(step%target) = r(step%a) + r(step%b)
                case (op_subtract); r(step%target) = r(step%a) - r(step%b)
                case (op_multiply); r(step%target) = r(step%a)*r(step%b)
                case (op_divide); r(step%target) = r(step%a)/r(step%b)
                case (op_negate); r(step%target) = -r(step%a)
                case (op_multiply_add); r(step%target) = r(step%a)*r(step%b) + r(step%c)
                case (op_multiply_subtract); r(step%target) = r(step%a)*r(step%b) - r(step%c)
                case (op_subtract_product); r(step%target) = r(step%c) - r(step%a)*r(step%b)
                case (op_product); r(step%target) = r(step%a)*r(step%b)*r(step%c)
                case (op_power); r(step%target) = r(step%a)**r(step%b)
                case (op_whole_power); r(step%target) = r(step%a)**step%b
                case (op_sin_cos)
                    x = r(step%a)
                    r(step%target) = sin(x)
                    r(step%b) = cos(x)
                case (op_function + f_abs); r(step%target) = abs(r(step%a))
                case (op_function + f_atan); r(step%target) = atan(r(step%a))
                case (op_function + f_cos); r(step%target) = cos(r(step%a))
                case (op_function + f_cosh); r(step%target) = cosh(r(step%a))
                case (op_function + f_exp); r(step%target) = exp(r(step%a))
                case (op_function + f_log); r(step%target) = log(r(step%a))
                case (op_function + f_sgn); r(step%target) = sgn(r(step%a))
                case (op_function + f_sin); r(step%target) = sin(r(step%a))
                case (op_function + f_sinh); r(step%target) = sinh(r(step%a))
                case (op_function + f_sqrt); r(step%target) = sqrt(r(step%a))
                case (op_function + f_tan); r(step%target) = tan(r(step%a))
                case default; r(step%target) = tanh(r(step%a))
                end select
            end associate
        end do
    end subroutine work

    pure subroutine evaluate_hyperdual(self, values, results)
        !! All results with first and second derivatives.
        class(formula_program_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: values(self%inputs)      !! of the symbols
        type(hyperdual_t), intent(out) :: results(self%outputs)   !! of the formulas
        type(hyperdual_t) :: r(room_hyperdual)

        if (self%code%registers <= room_hyperdual) then
            call work_hyperdual(self%code, values, r, results)
        else
            call evaluate_large_hyperdual(self%code, values, results)
        end if
    end subroutine evaluate_hyperdual

    pure subroutine evaluate_large_hyperdual(code, values, results)
        !! With registers on the heap.
        type(code_t), intent(in) :: code
        type(hyperdual_t), intent(in) :: values(code%inputs)
        type(hyperdual_t), intent(out) :: results(:)
        type(hyperdual_t), allocatable :: r(:)

        allocate (r(code%registers))
        call work_hyperdual(code, values, r, results)
    end subroutine evaluate_large_hyperdual

    pure subroutine work_hyperdual(code, values, r, results)
        !! The instructions, on hyper-dual numbers.
        type(code_t), intent(in) :: code
        type(hyperdual_t), intent(in) :: values(code%inputs)
        type(hyperdual_t), intent(inout) :: r(code%registers)
        type(hyperdual_t), intent(out) :: results(size(code%outputs))
        type(hyperdual_t) :: x
        integer :: i, n

        n = code%inputs
        r(:n) = values
        r(n + 1:n + size(code%numbers)) = code%numbers
        do i = 1, size(code%steps)
            associate (step => code%steps(i))
                select case (step%op)
                case (op_add); r(step%target) = r(step%a) + r(step%b)
                case (op_subtract); r(step%target) = r(step%a) - r(step%b)
                case (op_multiply); r(step%target) = r(step%a)*r(step%b)
                case (op_divide); r(step%target) = r(step%a)/r(step%b)
                case (op_negate); r(step%target) = -r(step%a)
                case (op_multiply_add); r(step%target) = r(step%a)*r(step%b) + r(step%c)
                case (op_multiply_subtract); r(step%target) = r(step%a)*r(step%b) - r(step%c)
                case (op_subtract_product); r(step%target) = r(step%c) - r(step%a)*r(step%b)
                case (op_product); r(step%target) = r(step%a)*r(step%b)*r(step%c)
                case (op_power); r(step%target) = r(step%a)**r(step%b)
                case (op_whole_power); r(step%target) = r(step%a)**step%b
                case (op_sin_cos)
                    x = r(step%a)
                    r(step%target) = sin(x)
                    r(step%b) = cos(x)
                case (op_function + f_abs); r(step%target) = abs(r(step%a))
                case (op_function + f_atan); r(step%target) = atan(r(step%a))
                case (op_function + f_cos); r(step%target) = cos(r(step%a))
                case (op_function + f_cosh); r(step%target) = cosh(r(step%a))
                case (op_function + f_exp); r(step%target) = exp(r(step%a))
                case (op_function + f_log); r(step%target) = log(r(step%a))
                case (op_function + f_sgn); r(step%target) = sgn(r(step%a))
                case (op_function + f_sin); r(step%target) = sin(r(step%a))
                case (op_function + f_sinh); r(step%target) = sinh(r(step%a))
                case (op_function + f_sqrt); r(step%target) = sqrt(r(step%a))
                case (op_function + f_tan); r(step%target) = tan(r(step%a))
                case default; r(step%target) = tanh(r(step%a))
                end select
            end associate
        end do
        do i = 1, size(code%outputs)
            results(i) = r(code%outputs(i))
        end do
    end subroutine work_hyperdual

    pure subroutine evaluate_lanes(self, values, results)
        !! All results at several states at once.
        class(formula_program_t), intent(in) :: self
        real(dp), intent(in) :: values(lanes, self%inputs)      !! of the symbols
        real(dp), intent(out) :: results(lanes, self%outputs)   !! of the formulas
        real(dp) :: r(lanes, room)

        if (self%code%registers <= room) then
            call work_lanes(self%code, values, r, results)
        else
            call evaluate_large_lanes(self%code, values, results)
        end if
    end subroutine evaluate_lanes

    pure subroutine evaluate_large_lanes(code, values, results)
        !! With registers on the heap.
        type(code_t), intent(in) :: code
        real(dp), intent(in) :: values(lanes, code%inputs)
        real(dp), intent(out) :: results(:, :)
        real(dp), allocatable :: r(:, :)

        allocate (r(lanes, code%registers))
        call work_lanes(code, values, r, results)
    end subroutine evaluate_large_lanes

    pure subroutine work_lanes(code, values, r, results)
        !! The instructions, on doubles in lanes. Functions and powers are called, a lane at a time:
        !! within a loop gfortran at `-O2` takes libmvec's, which err by up to 4 ulp, so that the
        !! digits would depend on the flags.
        type(code_t), intent(in) :: code
        real(dp), intent(in) :: values(lanes, code%inputs)
        real(dp), intent(inout) :: r(lanes, code%registers)
        real(dp), intent(out) :: results(lanes, size(code%outputs))
        real(dp) :: x(lanes), y(lanes)
        integer :: i, n

        n = code%inputs
        r(:, :n) = values
        do i = 1, size(code%numbers)
            r(:, n + i) = code%numbers(i)
        end do
        do i = 1, size(code%steps)
            associate (step => code%steps(i))
                select case (step%op)
                case (op_add); x = r(:, step%a) + r(:, step%b)
                case (op_subtract); x = r(:, step%a) - r(:, step%b)
                case (op_multiply); x = r(:, step%a)*r(:, step%b)
                case (op_divide); x = r(:, step%a)/r(:, step%b)
                case (op_negate); x = -r(:, step%a)
                case (op_multiply_add); x = r(:, step%a)*r(:, step%b) + r(:, step%c)
                case (op_multiply_subtract); x = r(:, step%a)*r(:, step%b) - r(:, step%c)
                case (op_subtract_product); x = r(:, step%c) - r(:, step%a)*r(:, step%b)
                case (op_product); x = r(:, step%a)*r(:, step%b)*r(:, step%c)
                case (op_power); x = real_power(r(:, step%a), r(:, step%b))
                case (op_whole_power); x = r(:, step%a)**step%b
                case (op_sin_cos)
                    call sine_cosine(r(:, step%a), x, y)
                    r(:, step%b) = y
                case (op_function + f_abs); x = abs(r(:, step%a))
                case (op_function + f_cos); call sine_cosine(r(:, step%a), y, x)
                case (op_function + f_sin); call sine_cosine(r(:, step%a), x, y)
                case (op_function + f_sqrt); x = sqrt(r(:, step%a))
                case default; x = function_value(step%op - op_function, r(:, step%a))
                end select
                r(:, step%target) = x
            end associate
        end do
        do i = 1, size(code%outputs)
            results(:, i) = r(:, code%outputs(i))
        end do
    end subroutine work_lanes
end module lagrangia_formula_program
