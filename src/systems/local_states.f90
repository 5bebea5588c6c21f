module lagrangia_local_states
    !! States at which a function acts that is as good as constant elsewhere: a kick that lasts a
    !! moment, a wall far away. States taken at random, or near the origin, do not show it.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_expression, only: expression_t, f_abs, f_atan, f_exp, f_sgn, f_tanh, kind_function
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: find_local_states

contains

    pure subroutine find_local_states(formulas, values, moved, states)
        !! Of each exp its peak is looked for, where the argument has one, and of abs, atan, sgn and
        !! tanh the zero of the argument: by Newton's method, a peak at last in one symbol after the
        !! other, and from beside the last one, for functions may be factors of each other. The
        !! states lie to both sides of such a place, by the width of what is found there and by half
        !! of it: where a slope is largest it does not change, so that a constraint with a peak
        !! accelerates nothing there.
        type(expression_t), intent(in) :: formulas(:)      !! which have the functions
        real(dp), intent(in) :: values(:)                  !! of all symbols, where it begins
        integer, intent(in) :: moved                       !! the first so many symbols may change
        real(dp), allocatable, intent(out) :: states(:, :) !! values of all symbols, (:, states)
        integer, parameter :: passes = 8
        real(dp), parameter :: beside(2) = [-1.0_dp, 0.5_dp]  !! of the width
        type(formula_program_t) :: program
        type(expression_t), allocatable :: arguments(:)
        logical, allocatable :: peaked(:)
        real(dp), allocatable :: more(:, :)
        real(dp) :: here(size(values)), shift, width
        integer :: i, j, pass, side

        call collect(formulas, arguments, peaked)
        allocate (states(size(values), 0))
        if (size(arguments) == 0) return
        call new_formula_program(program, arguments, size(values))
        here = values
        do j = 1, size(arguments)
            do pass = 1, passes
                call go_to_zero(program, j, peaked(j), moved, here)
            end do
            do pass = 1, passes
                do i = 1, moved
                    call look_along(program, here, i, j, peaked(j), shift, width)
                    here(i) = here(i) + shift
                end do
            end do
            do i = 1, moved
                call look_along(program, here, i, j, peaked(j), shift, width)
                if (.not. width > 0.0_dp) cycle
                do side = 1, size(beside)
                    allocate (more(size(values), size(states, 2) + 1))
                    more(:, :size(states, 2)) = states
                    more(:, size(more, 2)) = here
                    more(i, size(more, 2)) = here(i) + beside(side)*width
                    call move_alloc(more, states)
                end do
            end do
            if (size(states, 2) > 0) here = states(:, size(states, 2))
        end do
    end subroutine find_local_states

    pure subroutine go_to_zero(program, j, double, moved, here)
        !! A step of Newton's method in the direction of the slopes, to a zero of argument `j`, or
        !! to a double one: a peak is often that of \(-g^2\).
        type(formula_program_t), intent(in) :: program
        integer, intent(in) :: j
        logical, intent(in) :: double
        integer, intent(in) :: moved
        real(dp), intent(inout) :: here(:)
        type(hyperdual_t) :: values(size(here)), results(program%outputs)
        real(dp) :: slope(moved), step(moved)
        integer :: i

        values%re = here
        do i = 1, moved
            values(i)%d1 = 1.0_dp
            call program%evaluate(values, results)
            values(i)%d1 = 0.0_dp
            slope(i) = results(j)%d1
        end do
        step = -merge(2.0_dp, 1.0_dp, double)*results(j)%re*slope/sum(slope**2)
        if (all(ieee_is_finite(step))) here(:moved) = here(:moved) + step
    end subroutine go_to_zero

    pure subroutine look_along(program, here, i, j, peaked, shift, width)
        !! How far it is along symbol `i` to the peak of argument `j`, if that is one, and how wide
        !! the peak, or the step at a zero, is; width 0 where there is none.
        type(formula_program_t), intent(in) :: program
        real(dp), intent(in) :: here(:)
        integer, intent(in) :: i, j
        logical, intent(in) :: peaked
        real(dp), intent(out) :: shift, width
        type(hyperdual_t) :: values(size(here)), results(program%outputs)

        shift = 0.0_dp
        values%re = here
        values(i)%d1 = 1.0_dp
        values(i)%d2 = 1.0_dp
        call program%evaluate(values, results)
        associate (u => results(j))
            if (peaked) then
                shift = -u%d1/u%d12
                width = 1.0_dp/sqrt(-u%d12)
            else
                width = 1.0_dp/abs(u%d1)
            end if
        end associate
        if (ieee_is_finite(shift) .and. ieee_is_finite(width)) return  ! not of a valley, nor flat
        shift = 0.0_dp
        width = 0.0_dp
    end subroutine look_along

    pure subroutine collect(formulas, arguments, peaked)
        !! The arguments of the functions that may be constant nearly everywhere.
        type(expression_t), intent(in) :: formulas(:)
        type(expression_t), allocatable, intent(out) :: arguments(:)
        logical, allocatable, intent(out) :: peaked(:)  !! a peak is looked for, and no zero
        integer :: i, k, n, turn

        n = 0
        do turn = 1, 2  ! how many, and which
            if (turn == 2) allocate (arguments(n), peaked(n))
            n = 0
            do i = 1, size(formulas)
                do k = 1, formulas(i)%count
                    associate (node => formulas(i)%nodes(k))
                        if (node%kind /= kind_function) cycle
                        if (all(node%which /= [f_abs, f_atan, f_exp, f_sgn, f_tanh])) cycle
                        n = n + 1
                        if (turn == 1) cycle
                        arguments(n) = formulas(i)%pruned(node%left)
                        peaked(n) = node%which == f_exp
                    end associate
                end do
            end do
        end do
    end subroutine collect
end module lagrangia_local_states
