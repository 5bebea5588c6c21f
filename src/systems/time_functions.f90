module lagrangia_time_functions
    !! Functions of the time alone, in the formulas of a system, that act for a moment or turn at
    !! once: a kick, a switch, a kink. What they are functions of is smooth and easily looked
    !! through, where they themselves may be nothing but at one moment.
    use lagrangia_expression, only: apply, expression_t, f_abs, f_atan, f_cosh, f_exp, f_log, &
                                    f_sgn, f_tanh, kind_function, kind_number, kind_power, &
                                    kind_quotient, operator(*), operator(**), operator(-)
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: new_time_functions, time_functions_t
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

    pure subroutine new_time_functions(self, formulas, values, moved)
        !! Those of some formulas.
        type(time_functions_t), intent(out) :: self    !! is made anew
        type(expression_t), intent(in) :: formulas(:)  !! symbol 1 is the time
        real(dp), intent(in) :: values(:)              !! of all symbols: of parameters they count
        integer, intent(in) :: moved  !! the first so many symbols are no parameters
        type(expression_t), allocatable :: arguments(:)
        type(expression_t) :: argument
        logical :: fixed(size(values))
        integer :: i, j, k, kind, n, turn

        do turn = 1, 2  ! how many, and which
            if (turn == 2) allocate (arguments(n), self%kinds(n))
            n = 0
            do i = 1, size(formulas)
                if (.not. formulas(i)%depends_on(1)) cycle
                do k = 1, formulas(i)%count
                    call look_at(formulas(i), k, argument, kind)
                    if (kind == 0 .or. .not. argument%depends_on(1)) cycle
                    if (any([(argument%depends_on(j), j=2, moved)])) cycle
                    n = n + 1
                    if (turn == 1) cycle
                    arguments(n) = argument
                    self%kinds(n) = kind
                end do
            end do
        end do
        fixed = .true.
        fixed(1) = .false.
        allocate (self%arguments(1))
        call new_formula_program(self%arguments(1), arguments, 1, fixed, values)
    end subroutine new_time_functions

    pure subroutine look_at(formula, k, argument, kind)
        !! What node `k` turns with; kind 0 where it does not.
        type(expression_t), intent(in) :: formula
        integer, intent(in) :: k
        type(expression_t), intent(out) :: argument
        integer, intent(out) :: kind

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
                if (formula%nodes(node%right)%kind == kind_number) then
                    if (formula%nodes(node%right)%number%value >= 0.0_dp) return
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
