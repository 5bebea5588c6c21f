module lagrangia_time_functions
    !! Functions of the time alone, in the formulas of a system, that act for a moment or turn at
    !! once: a kick, a switch, a kink. What they are functions of is smooth and easily looked
    !! through, where they themselves may be nothing but at one moment.
    use lagrangia_expression, only: apply, expression_t, f_abs, f_atan, f_cosh, f_exp, f_log, &
                                    f_sgn, f_tanh, kind_function, kind_negation, kind_number, &
                                    kind_power, kind_quotient, operator(*), operator(**), &
                                    operator(-)
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: falls_slowly, look_at, new_time_functions, time_functions_t
    public :: kink, peak, switch

    integer, parameter :: kink = 1    !! at a zero of the argument: abs, sgn
    integer, parameter :: switch = 2  !! about a zero of it: tanh, atan, 1/cosh
    integer, parameter :: peak = 3    !! about a maximum of it: exp, and of -log|x| for 1/x

    type :: time_functions_t
        !! None until `new_time_functions` has been called.
        integer, allocatable :: kinds(:)  !! of each
        type(formula_program_t), allocatable, private :: arguments(:)  !! one program of all
    contains
        procedure :: arguments_at
    end type time_functions_t

contains

    pure subroutine new_time_functions(self, lagrangian, forces, constraints, values, moved)
        !! Those of all formulas of a system.
        type(time_functions_t), intent(out) :: self       !! is made anew
        type(expression_t), intent(in) :: lagrangian      !! symbol 1 is the time
        type(expression_t), intent(in) :: forces(:)       !! beside it
        type(expression_t), intent(in) :: constraints(:)  !! that are 0
        real(dp), intent(in) :: values(:)   !! of all symbols: of parameters they count
        integer, intent(in) :: moved        !! the first so many symbols are no parameters
        type(expression_t), allocatable :: arguments(:)
        integer, allocatable :: kinds(:)
        logical :: fixed(size(values))
        integer :: i, n

        n = lagrangian%count + sum(forces%count) + sum(constraints%count)  ! no more than these
        allocate (arguments(n), kinds(n))
        n = 0
        call look_through(lagrangian, moved, n, kinds, arguments)
        do i = 1, size(forces)
            call look_through(forces(i), moved, n, kinds, arguments)
        end do
        do i = 1, size(constraints)
            call look_through(constraints(i), moved, n, kinds, arguments)
        end do
        self%kinds = kinds(:n)
        if (n == 0) return
        fixed = .true.
        fixed(1) = .false.
        allocate (self%arguments(1))
        call new_formula_program(self%arguments(1), arguments(:n), 1, fixed, values)
    end subroutine new_time_functions

    pure subroutine look_through(formula, moved, n, kinds, arguments)
        !! Put those of a formula behind the others.
        type(expression_t), intent(in) :: formula
        integer, intent(in) :: moved
        integer, intent(inout) :: n
        integer, intent(inout) :: kinds(:)
        type(expression_t), intent(inout) :: arguments(:)
        type(expression_t) :: argument
        integer :: j, k, kind

        if (.not. formula%depends_on(1)) return
        do k = 1, formula%count
            call look_at(formula, k, argument, kind)
            if (kind == 0 .or. .not. argument%depends_on(1)) cycle
            if (any([(argument%depends_on(j), j=2, moved)])) cycle
            n = n + 1
            arguments(n) = argument
            kinds(n) = kind
        end do
    end subroutine look_through

    pure subroutine look_at(formula, k, argument, kind)
        !! What node `k` turns with; kind 0 where it does not.
        type(expression_t), intent(in) :: formula    !! any
        integer, intent(in) :: k                     !! number of one of its nodes
        type(expression_t), intent(out) :: argument  !! what the node is a function of
        integer, intent(out) :: kind                 !! `kink`, `switch`, `peak` or 0

        kind = 0
        associate (node => formula%nodes(k))
            select case (node%kind)
            case (kind_function)
                select case (node%which)
                case (f_abs, f_sgn); kind = kink
                case (f_atan, f_cosh, f_tanh); kind = switch
                case (f_exp); kind = peak
                case default; return
                end select
                argument = formula%pruned(node%left)
            case (kind_quotient)
                kind = peak
                argument = -apply(f_log, formula%pruned(node%right)**2)
            case (kind_power)
                if (is_number(formula, node%right)) then
                    if (.not. is_negative(formula, node%right)) return
                    argument = -apply(f_log, formula%pruned(node%left)**2)
                else
                    argument = formula%pruned(node%right)*apply(f_log, formula%pruned(node%left))
                end if
                kind = peak
            case default
                return
            end select
        end associate
    end subroutine look_at

    pure function falls_slowly(formula, k) result(yes)
        !! Is node `k`, a peak, a power of what it divides by, which never is as good as nothing?
        type(expression_t), intent(in) :: formula  !! any
        integer, intent(in) :: k                   !! number of one of its nodes
        logical :: yes

        associate (node => formula%nodes(k))
            yes = node%kind == kind_quotient
            if (node%kind == kind_power) yes = is_number(formula, node%right)
        end associate
    end function falls_slowly

    pure function is_number(formula, k) result(yes)
        !! Is node `k` a number, or one with a minus, as the exponent of x^-2 is read?
        type(expression_t), intent(in) :: formula
        integer, intent(in) :: k
        logical :: yes

        associate (node => formula%nodes(k))
            yes = node%kind == kind_number
            if (node%kind == kind_negation) yes = formula%nodes(node%left)%kind == kind_number
        end associate
    end function is_number

    pure function is_negative(formula, k) result(yes)
        !! Of a node that is a number: a written one has no sign of its own.
        type(expression_t), intent(in) :: formula
        integer, intent(in) :: k
        logical :: yes

        yes = formula%nodes(k)%kind == kind_negation
        if (.not. yes) yes = formula%nodes(k)%number%value < 0.0_dp
    end function is_negative

    pure subroutine arguments_at(self, t, values, slopes)
        !! The arguments at a time, and their rates of change.
        class(time_functions_t), intent(in) :: self
        real(dp), intent(in) :: t                      !! s
        real(dp), intent(out) :: values(:), slopes(:)  !! each as long as `kinds`
        type(hyperdual_t) :: results(size(values))

        call self%arguments(1)%evaluate([hyperdual_t(re=t, d1=1.0_dp)], results)
        values = results%re
        slopes = results%d1
    end subroutine arguments_at
end module lagrangia_time_functions
