module lagrangia_expression
    !! A formula as data: a flat list of nodes, operands before what is made of them, the root last.
    !!
    !! Nodes may be shared, so that a derivative grows no faster than its formula. Symbols are
    !! numbers, the places of their names in a `symbols_t`.
    use lagrangia_exact_number, only: number_of, number_t, ratio
    use lagrangia_hyperdual, only: sgn
    use lagrangia_kinds, only: dp, i8
    implicit none (type, external)
    private
    public :: expression_t, node_t
    public :: apply, constant, symbol, whole
    public :: operator(+), operator(-), operator(*), operator(/), operator(**)
    public :: kind_number, kind_symbol, kind_sum, kind_difference, kind_product, kind_quotient, &
              kind_power, kind_negation, kind_function
    public :: f_abs, f_atan, f_cos, f_cosh, f_exp, f_log, f_sgn, f_sin, f_sinh, f_sqrt, f_tan, &
        f_tanh
    public :: function_names, function_value, is_function_name, real_power

    integer, parameter :: kind_number = 0, kind_symbol = 1
    integer, parameter :: kind_sum = 2, kind_difference = 3, kind_product = 4, kind_quotient = 5
    integer, parameter :: kind_power = 6      !! to an integer, real or any other exponent
    integer, parameter :: kind_negation = 7   !! of `left`
    integer, parameter :: kind_function = 8   !! of `left`

    integer, parameter :: f_abs = 1, f_atan = 2, f_cos = 3, f_cosh = 4, f_exp = 5, f_log = 6, &
                          f_sgn = 7, f_sin = 8, f_sinh = 9, f_sqrt = 10, f_tan = 11, f_tanh = 12
    character(4), parameter :: function_names(12) = [character(4) :: "abs", "atan", "cos", "cosh", &
        "exp", "log", "sgn", "sin", "sinh", "sqrt", "tan", "tanh"]
    !! in the order of their numbers

    type :: node_t
        !! A number, a symbol, or an operation on nodes before it.
        integer :: kind = kind_number
        integer :: left = 0       !! operand, the only one of a function or a negation
        integer :: right = 0      !! the second operand, or the exponent
        integer :: which = 0      !! place of the symbol, or number of the function
        type(number_t) :: number  !! of a number
    end type node_t

    type :: expression_t
        !! Zero until nodes are added.
        integer :: count = 0                        !! of nodes
        type(node_t), allocatable :: nodes(:)       !! the first `count` of them count
    contains
        procedure :: add_copy
        procedure :: add_number
        procedure :: add_operation
        procedure :: add_symbol
        procedure :: append
        procedure :: depends_on
        procedure :: is_zero
        procedure :: pruned
        procedure, private :: add_node
    end type expression_t

    interface operator(+)
        module procedure add
    end interface operator(+)

    interface operator(-)
        module procedure subtract, opposite
    end interface operator(-)

    interface operator(*)
        module procedure multiply
    end interface operator(*)

    interface operator(/)
        module procedure divide
    end interface operator(/)

    interface operator(**)
        module procedure power, whole_power
    end interface operator(**)

contains

    pure function is_function_name(name) result(yes)
        !! Of a function, or of one that is written out by others.
        character(*), intent(in) :: name  !! as in a formula
        logical :: yes

        yes = any(function_names == name) .or. &
              any(["acos  ", "arccos", "asin  ", "arcsin"] == name)
    end function is_function_name

    pure function constant(value) result(e)
        !! A number as a formula.
        real(dp), intent(in) :: value  !! finite
        type(expression_t) :: e

        allocate (e%nodes(1))
        e%nodes(1)%number = number_of(value)
        e%count = 1
    end function constant

    pure function whole(value) result(e)
        !! A whole number as a formula.
        integer, intent(in) :: value  !! any
        type(expression_t) :: e

        allocate (e%nodes(1))
        e%nodes(1)%number = ratio(int(value, i8), 1_i8)
        e%count = 1
    end function whole

    pure function symbol(which) result(e)
        !! A symbol as a formula.
        integer, intent(in) :: which  !! its place among the symbols, from 1
        type(expression_t) :: e

        allocate (e%nodes(1))
        e%nodes(1)%kind = kind_symbol
        e%nodes(1)%which = which
        e%count = 1
    end function symbol

    pure function apply(which, argument) result(e)
        !! A function of a formula.
        integer, intent(in) :: which                !! one of `f_abs` to `f_tanh`
        type(expression_t), intent(in) :: argument  !! of the function
        type(expression_t) :: e
        integer :: node

        e = argument
        call e%add_operation(kind_function, argument%count, 0, node, which)
    end function apply

    elemental function function_value(which, x) result(y)
        !! A function of a number, as it is computed when a formula is evaluated.
        integer, intent(in) :: which  !! one of `f_abs` to `f_tanh`
        real(dp), intent(in) :: x     !! its argument
        real(dp) :: y

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
    end function function_value

    elemental real(dp) function real_power(x, exponent)
        !! A power, as it is computed when a formula is evaluated.
        real(dp), intent(in) :: x         !! any; negative, NaN unless the exponent is whole
        real(dp), intent(in) :: exponent  !! any

        real_power = x**exponent
    end function real_power

    pure function add(a, b) result(e)
        type(expression_t), intent(in) :: a, b
        type(expression_t) :: e

        call combine(kind_sum, a, b, e)
    end function add

    pure function subtract(a, b) result(e)
        type(expression_t), intent(in) :: a, b
        type(expression_t) :: e

        call combine(kind_difference, a, b, e)
    end function subtract

    pure function multiply(a, b) result(e)
        type(expression_t), intent(in) :: a, b
        type(expression_t) :: e

        call combine(kind_product, a, b, e)
    end function multiply

    pure function divide(a, b) result(e)
        type(expression_t), intent(in) :: a, b
        type(expression_t) :: e

        call combine(kind_quotient, a, b, e)
    end function divide

    pure function power(a, b) result(e)
        type(expression_t), intent(in) :: a, b
        type(expression_t) :: e

        call combine(kind_power, a, b, e)
    end function power

    pure function whole_power(a, n) result(e)
        type(expression_t), intent(in) :: a
        integer, intent(in) :: n
        type(expression_t) :: e

        e = a**whole(n)
    end function whole_power

    pure function opposite(a) result(e)
        type(expression_t), intent(in) :: a
        type(expression_t) :: e
        integer :: node

        e = a
        call e%add_operation(kind_negation, a%count, 0, node)
    end function opposite

    pure subroutine combine(kind, a, b, e)
        !! An operation on two formulas.
        integer, intent(in) :: kind
        type(expression_t), intent(in) :: a, b
        type(expression_t), intent(out) :: e
        integer :: left, node, right

        call e%append(a, left)
        call e%append(b, right)
        call e%add_operation(kind, left, right, node)
    end subroutine combine

    pure subroutine add_copy(self, other, i, places)
        !! A node of another formula at the end, with operands that are there.
        class(expression_t), intent(inout) :: self
        type(expression_t), intent(in) :: other  !! whose node it is
        integer, intent(in) :: i                 !! its place there
        integer, intent(inout) :: places(0:)
        !! of the other's nodes here, of which that of node `i` is set; of 0 it is 0
        type(node_t) :: new

        new = other%nodes(i)
        new%left = places(new%left)
        new%right = places(new%right)
        call self%add_node(new, places(i))
    end subroutine add_copy

    pure subroutine add_number(self, number, node)
        !! A number at the end.
        class(expression_t), intent(inout) :: self
        type(number_t), intent(in) :: number  !! finite
        integer, intent(out) :: node          !! its place

        call self%add_node(node_t(kind_number, 0, 0, 0, number), node)
    end subroutine add_number

    pure subroutine add_symbol(self, which, node)
        !! A symbol at the end.
        class(expression_t), intent(inout) :: self
        integer, intent(in) :: which  !! its place among the symbols, from 1
        integer, intent(out) :: node  !! its place in the list

        call self%add_node(node_t(kind_symbol, 0, 0, which, number_t()), node)
    end subroutine add_symbol

    pure subroutine add_operation(self, kind, left, right, node, which)
        !! An operation on nodes that are there, at the end.
        class(expression_t), intent(inout) :: self
        integer, intent(in) :: kind             !! `kind_sum` to `kind_function`
        integer, intent(in) :: left             !! place of the first operand
        integer, intent(in) :: right            !! of the second, 0 where there is none
        integer, intent(out) :: node            !! its place
        integer, intent(in), optional :: which  !! the function, if it is one
        type(node_t) :: new

        new%kind = kind
        new%left = left
        new%right = right
        if (present(which)) new%which = which
        call self%add_node(new, node)
    end subroutine add_operation

    pure subroutine add_node(self, new, node)
        !! At the end, with room for twice as many where there is none left.
        class(expression_t), intent(inout) :: self
        type(node_t), intent(in) :: new
        integer, intent(out) :: node
        type(node_t), allocatable :: larger(:)

        if (.not. allocated(self%nodes)) allocate (self%nodes(16))
        if (self%count == size(self%nodes)) then
            allocate (larger(2*self%count))
            larger(:self%count) = self%nodes
            call move_alloc(larger, self%nodes)
        end if
        self%count = self%count + 1
        self%nodes(self%count) = new
        node = self%count
    end subroutine add_node

    pure subroutine append(self, other, node)
        !! All nodes of another formula at the end; an empty one is 0.
        class(expression_t), intent(inout) :: self
        type(expression_t), intent(in) :: other  !! left as it is
        integer, intent(out) :: node             !! the place of its root here
        type(node_t) :: new
        integer :: before, i

        before = self%count
        do i = 1, other%count
            new = other%nodes(i)
            if (new%left > 0) new%left = new%left + before
            if (new%right > 0) new%right = new%right + before
            call self%add_node(new, node)
        end do
        if (other%count == 0) call self%add_number(number_t(), node)
    end subroutine append

    pure function depends_on(self, which) result(yes)
        !! Does the symbol occur in it?
        class(expression_t), intent(in) :: self
        integer, intent(in) :: which  !! place of the symbol
        logical :: yes
        integer :: i

        yes = .false.
        do i = 1, self%count
            yes = yes .or. (self%nodes(i)%kind == kind_symbol .and. self%nodes(i)%which == which)
        end do
    end function depends_on

    pure function is_zero(self) result(yes)
        !! By its form: it is the number 0.
        class(expression_t), intent(in) :: self
        logical :: yes

        yes = self%count == 0
        if (self%count /= 1) return
        yes = self%nodes(1)%kind == kind_number .and. self%nodes(1)%number%is_zero()
    end function is_zero

    pure function pruned(self, root) result(e)
        !! The formula whose root is at `root`, without the nodes that it does not need.
        class(expression_t), intent(in) :: self
        integer, intent(in) :: root  !! a place in the list
        type(expression_t) :: e
        integer :: place(0:self%count), i, kept
        logical :: needed(0:self%count)

        needed = .false.
        needed(root) = .true.
        do i = root, 1, -1
            if (.not. needed(i)) cycle
            needed(self%nodes(i)%left) = .true.
            needed(self%nodes(i)%right) = .true.
        end do
        place = 0
        kept = count(needed(1:))
        allocate (e%nodes(kept))
        do i = 1, root
            if (.not. needed(i)) cycle
            e%count = e%count + 1
            place(i) = e%count
            e%nodes(e%count) = self%nodes(i)
            e%nodes(e%count)%left = place(self%nodes(i)%left)
            e%nodes(e%count)%right = place(self%nodes(i)%right)
        end do
    end function pruned
end module lagrangia_expression
