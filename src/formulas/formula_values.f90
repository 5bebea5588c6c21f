module lagrangia_formula_values
    !! What formulas compute, each value once: the same operation on the same operands is the same
    !! value, and one on numbers is a number.
    !!
    !! No rule here changes a result by more than the rounding of a power: \(x^3\) is \(x^2x\).
    !! Powers of two and signs, which round nothing, are moved to where they meet other numbers.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_expression, only: f_log, f_sqrt, function_value
    use lagrangia_formula_code, only: op_add, op_divide, op_function, op_input, op_multiply, &
                                      op_negate, op_number, op_power, op_subtract, op_whole_power
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: value_t, values_t

    integer, parameter :: buckets = 4096
    integer, parameter :: longest_chain = 64  !! powers up to here are products

    type :: value_t
        !! An operation on values before it.
        integer :: op = op_number
        integer :: a = 0, b = 0         !! operands, exponent of a whole power, place of an input
        real(dp) :: number = 0.0_dp
        integer :: next = 0             !! with the same hash
    end type value_t

    type :: values_t
        !! None at first.
        integer :: count = 0
        type(value_t), allocatable :: list(:)   !! the first `count` count
        integer :: head(0:buckets - 1) = 0      !! the last value of each hash
    contains
        procedure :: input
        procedure :: number
        procedure :: operation
        procedure, private :: fold
        procedure, private :: move_number
        procedure, private :: factor_of
        procedure, private :: look_up
        procedure, private :: multiply_out
    end type values_t

contains

    pure subroutine number(self, x, which)
        !! A number as a value.
        class(values_t), intent(inout) :: self
        real(dp), intent(in) :: x      !! any double
        integer, intent(out) :: which  !! its place in the list

        call self%look_up(value_t(op_number, 0, 0, x), which)
    end subroutine number

    pure subroutine input(self, i, which)
        !! A symbol as a value.
        class(values_t), intent(inout) :: self
        integer, intent(in) :: i       !! its place among the symbols
        integer, intent(out) :: which  !! its place in the list

        call self%look_up(value_t(op_input, i), which)
    end subroutine input

    pure recursive subroutine operation(self, op, first, second, which)
        !! An operation on values, as simply as it can be done.
        class(values_t), intent(inout) :: self
        integer, intent(in) :: op             !! of a `code_t`, with two operands at most
        integer, intent(in) :: first, second  !! places of the operands
        integer, intent(out) :: which         !! place of the value
        integer :: a, b, n

        a = first
        b = second
        if (op == op_add .or. op == op_multiply) then
            a = min(first, second)
            b = max(first, second)
        end if
        call self%fold(op, a, b, which)
        if (which == 0) call self%move_number(op, a, b, which)
        if (which > 0) return
        select case (op)
        case (op_add)
            if (self%list(b)%op == op_negate) then
                call self%operation(op_subtract, a, self%list(b)%a, which)
                return
            else if (self%list(a)%op == op_negate) then
                call self%operation(op_subtract, b, self%list(a)%a, which)
                return
            end if
        case (op_subtract)
            if (self%list(b)%op == op_negate) then
                call self%operation(op_add, a, self%list(b)%a, which)
                return
            end if
        case (op_divide)
            if (is_power_of_two(self%list(b))) then
                call self%number(1.0_dp/self%list(b)%number, b)
                call self%operation(op_multiply, a, b, which)
                return
            end if
        case (op_negate)
            if (self%list(a)%op == op_negate) then
                which = self%list(a)%a
                return
            end if
        case (op_power)
            if (is_whole(self%list(b))) then
                n = nint(self%list(b)%number)
                if (n == 0) then
                    call self%number(1.0_dp, which)
                else if (abs(n) <= longest_chain) then
                    call self%multiply_out(a, abs(n), which)
                    if (n > 0) return
                    call self%number(1.0_dp, a)
                    call self%operation(op_divide, a, which, b)
                    which = b
                else
                    call self%look_up(value_t(op_whole_power, a, n), which)
                end if
                return
            else if (self%list(b)%op == op_number .and. is(self%list(b)%number, 0.5_dp)) then
                call self%operation(op_function + f_sqrt, a, 0, which)
                return
            end if
        case default
            continue
        end select
        call self%look_up(value_t(op, a, b), which)
    end subroutine operation

    pure recursive subroutine move_number(self, op, a, b, which)
        !! \(x(2y)\) as \(2(xy)\), \(3(2x)\) as \(6x\), \(2x/y\) as \(2(x/y)\), \(-(3x)y\) as
        !! \((-3x)y\); 0 where nothing is to be moved.
        class(values_t), intent(inout) :: self
        integer, intent(in) :: op, a, b
        integer, intent(out) :: which
        integer :: i, k, inner, number, operands(2), other, rest

        which = 0
        if (all(op /= [op_multiply, op_divide, op_negate])) return
        operands = [a, b]
        if (op == op_negate) then
            call self%factor_of(a, number, rest)
            if (number > 0) then
                call self%operation(op_negate, number, 0, k)
                call self%operation(op_multiply, k, rest, which)
                return
            else if (self%list(a)%op /= op_multiply) then
                return
            end if
            operands = [self%list(a)%a, self%list(a)%b]
        end if
        do i = 1, 2
            call self%factor_of(operands(i), number, rest)
            if (number == 0) cycle
            other = operands(3 - i)
            if (op == op_negate) then
                call self%operation(op_negate, operands(i), 0, k)
                call self%operation(op_multiply, k, other, which)
            else if (op == op_multiply .and. self%list(other)%op == op_number) then
                if (.not. (is_power_of_two(self%list(number)) .or. &
                           is_power_of_two(self%list(other)))) cycle
                call self%fold(op_multiply, number, other, k)
                if (k > 0) call self%operation(op_multiply, k, rest, which)
            else if (is_power_of_two(self%list(number))) then
                k = number
                if (op == op_multiply .or. i == 1) then
                    call self%operation(op, rest, other, inner)
                else
                    call self%number(1.0_dp/self%list(number)%number, k)
                    call self%operation(op, other, rest, inner)
                end if
                call self%operation(op_multiply, k, inner, which)
            end if
            if (which > 0) return
        end do
    end subroutine move_number

    pure subroutine factor_of(self, which, number, rest)
        !! The number that is a factor of a product, and the other one; 0 where there is none.
        class(values_t), intent(in) :: self
        integer, intent(in) :: which
        integer, intent(out) :: number, rest

        number = 0
        rest = 0
        associate (value => self%list(which))
            if (value%op /= op_multiply) return
            if (self%list(value%a)%op == op_number) then
                number = value%a
                rest = value%b
            else if (self%list(value%b)%op == op_number) then
                number = value%b
                rest = value%a
            end if
        end associate
    end subroutine factor_of

    pure recursive subroutine multiply_out(self, a, n, which)
        !! \(a^n\) by squares and products.
        class(values_t), intent(inout) :: self
        integer, intent(in) :: a, n
        integer, intent(out) :: which
        integer :: half

        if (n == 1) then
            which = a
        else if (mod(n, 2) == 0) then
            call self%multiply_out(a, n/2, half)
            call self%operation(op_multiply, half, half, which)
        else
            call self%multiply_out(a, n - 1, half)
            call self%operation(op_multiply, half, a, which)
        end if
    end subroutine multiply_out

    pure subroutine fold(self, op, a, b, which)
        !! The number that an operation on numbers gives, or the operand that it leaves as it is; 0
        !! where it is neither. What might overflow or has no value stays an operation.
        class(values_t), intent(inout) :: self
        integer, intent(in) :: op, a, b
        integer, intent(out) :: which
        real(dp) :: result, x, y
        logical :: known(2)

        which = 0
        x = self%list(a)%number
        y = 0.0_dp
        known = self%list(a)%op == op_number
        if (b > 0) then
            y = self%list(b)%number
            known(2) = self%list(b)%op == op_number
        end if
        if (b > 0) then
            if (known(1) .and. is(x, 1.0_dp) .and. op == op_multiply) which = b
            if (known(1) .and. is(x, 0.0_dp) .and. op == op_add) which = b
            if (known(2) .and. is(y, 0.0_dp) .and. any(op == [op_add, op_subtract])) which = a
            if (known(2) .and. is(y, 1.0_dp) .and. &
                any(op == [op_multiply, op_divide, op_power])) which = a
            if (which > 0) return
        end if
        if (.not. all(known) .or. .not. (is_modest(x) .and. is_modest(y))) return
        select case (op)
        case (op_add)
            result = x + y
        case (op_subtract)
            result = x - y
        case (op_multiply)
            result = x*y
        case (op_divide)
            if (is(y, 0.0_dp)) return
            result = x/y
        case (op_negate)
            result = -x
        case default
            if (op <= op_function .or. abs(x) > 100.0_dp) return
            if (any(op - op_function == [f_log, f_sqrt]) .and. x <= 0.0_dp) return
            result = function_value(op - op_function, x)
        end select
        if (.not. ieee_is_finite(result)) return
        call self%number(result, which)
    end subroutine fold

    pure subroutine look_up(self, new, which)
        !! The place of a value, at the end if it is new.
        class(values_t), intent(inout) :: self
        type(value_t), intent(in) :: new
        integer, intent(out) :: which
        type(value_t), allocatable :: larger(:)
        integer :: hash

        hash = 31*(31*(31*new%op + new%a) + new%b)
        if (new%op == op_number) hash = hash + exponent(new%number) + &
            int(1e6_dp*fraction(new%number))
        hash = modulo(hash, buckets)
        which = self%head(hash)
        do while (which > 0)
            associate (old => self%list(which))
                if (old%op == new%op .and. old%a == new%a .and. old%b == new%b &
                    .and. is_same(old%number, new%number)) return
                which = old%next
            end associate
        end do
        if (.not. allocated(self%list)) allocate (self%list(64))
        if (self%count == size(self%list)) then
            allocate (larger(2*self%count))
            larger(:self%count) = self%list
            call move_alloc(larger, self%list)
        end if
        self%count = self%count + 1
        which = self%count
        self%list(which) = new
        self%list(which)%next = self%head(hash)
        self%head(hash) = which
    end subroutine look_up

    elemental function is(x, y) result(yes)
        real(dp), intent(in) :: x, y
        logical :: yes

        yes = abs(x - y) <= 0.0_dp
    end function is

    elemental function is_same(x, y) result(yes)
        !! Equal, and of one sign where both are zero.
        real(dp), intent(in) :: x, y
        logical :: yes

        yes = abs(x - y) <= 0.0_dp .and. (sign(1.0_dp, x)*sign(1.0_dp, y) > 0.0_dp)
    end function is_same

    elemental function is_modest(x) result(yes)
        !! Far from overflow, also as a factor.
        real(dp), intent(in) :: x
        logical :: yes

        yes = is(x, 0.0_dp) .or. (abs(x) > 1e-100_dp .and. abs(x) < 1e100_dp)
    end function is_modest

    elemental function is_power_of_two(value) result(yes)
        !! Is multiplying by the inverse the same as dividing by it?
        type(value_t), intent(in) :: value
        logical :: yes

        yes = value%op == op_number .and. is_modest(value%number) .and. &
              is(abs(fraction(value%number)), 0.5_dp)
    end function is_power_of_two

    elemental function is_whole(value) result(yes)
        !! A whole number that an integer power takes?
        type(value_t), intent(in) :: value
        logical :: yes

        yes = .false.
        if (value%op == op_number .and. abs(value%number) < 1e9_dp) then
            yes = is(value%number, anint(value%number))
        end if
    end function is_whole
end module lagrangia_formula_values
