module lagrangia_written_quantities
    !! Quantities of a system in formulas: functions of t, coordinates and velocities that a scene
    !! names, `'L_z [kg m^2/s] angular momentum = m r^2 phi_dot'`. Which of them the motion
    !! conserves is found out.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_description, only: name_length, quantity_t
    use lagrangia_elimination, only: solve_positive
    use lagrangia_errors, only: error_t, fail
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_program, only: formula_program_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrangian_system, only: is_spare, lagrangian_system_t, last_state, &
                                          near_states, trial_state
    use lagrangia_local_states, only: find_local_states
    use lagrangia_number_class, only: all_finite
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: quoted, to_text
    implicit none (type, external)
    private
    public :: find_conserved, read_quantities

    integer, parameter :: longest = name_length - len("_drift")

contains

    subroutine read_quantities(items, formulas, symbols, expressions, error)
        !! Parse them, one after the other; each may use those before it, which become symbols.
        type(quantity_t), intent(in) :: items(:)      !! their names
        character(*), intent(in) :: formulas(:)       !! of each
        type(symbols_t), intent(in) :: symbols        !! t, q, q_dot, parameters, definitions
        type(expression_t), allocatable, intent(out) :: expressions(:)  !! of these symbols
        type(error_t), allocatable, intent(out) :: error
        !! status 2, `element` of the key `quantities` to blame
        type(symbols_t) :: known
        integer :: i

        known = symbols
        allocate (expressions(size(items)))
        do i = 1, size(items)
            associate (name => items(i)%name)
                if (len_trim(name) > longest) then
                    call fail(error, "the name "//quoted(trim(name))//" is longer than "// &
                              to_text(longest)//" characters; shorten it")
                else
                    call parse_formula(trim(formulas(i)), known, expressions(i), error)
                end if
                if (.not. allocated(error)) call known%define(trim(name), expressions(i), error)
            end associate
            if (.not. allocated(error)) cycle
            error%key = "quantities"
            error%element = i
            return
        end do
    end subroutine read_quantities

    pure subroutine find_conserved(system, program, lagrangian, forces, constraints, conserved)
        !! A quantity is conserved if its rate is rounding at those states of `trial_state` at which
        !! it is a number, with velocities that keep the constraints: beside the terms that add up
        !! to it, or, where the terms of a force cancel, beside what rounding of the state makes of
        !! it. Constraints hold near the origin at most, and no state far away is tried with them.
        !! What acts at no such state is looked for in the formulas.
        class(lagrangian_system_t), intent(in) :: system   !! whose motion it is
        type(formula_program_t), intent(in) :: program     !! the quantities, of t, q, q_dot
        type(expression_t), intent(in) :: lagrangian       !! L, of t, q, q_dot, parameters
        type(expression_t), intent(in) :: forces(:)        !! Q of each coordinate
        type(expression_t), intent(in) :: constraints(:)   !! zero along the motion
        logical, allocatable, intent(out) :: conserved(:)  !! each of them
        real(dp), parameter :: rounding = 1e-11_dp  !! of terms that may themselves cancel
        real(dp), dimension(system%ndof) :: q, v, a
        real(dp), parameter :: amplified = 1e4_dp   !! of changes by roundings of a state
        real(dp), dimension(program%outputs) :: rate, terms, noise
        logical :: known(program%outputs)
        type(expression_t) :: formulas(1 + size(forces) + size(constraints))
        real(dp), allocatable :: local(:, :)
        integer :: used(program%outputs)
        real(dp) :: t
        integer :: k, last, n

        allocate (conserved(program%outputs), source=.true.)
        if (size(conserved) == 0) return
        used = 0
        n = system%ndof
        last = merge(near_states, last_state, system%constraints > 0)
        call trial_state(1, t, q, v)
        formulas(1) = lagrangian
        formulas(2:1 + size(forces)) = forces
        formulas(2 + size(forces):) = constraints
        call find_local_states(formulas, [t, q, v, system%p], 1 + n, local)
        do k = 1, last + size(local, 2)
            if (is_spare(k, minval(used))) cycle
            call trial_state(min(k, last), t, q, v)
            if (k > last) then
                t = local(1, k - last)
                q = local(2:1 + n, k - last)
            end if
            call keep_constraints(system, t, q, v)
            call system%accelerations(t, q, v, a)
            call rates(program, t, q, v, a, rate, terms)
            known = ieee_is_finite(rate) .and. ieee_is_finite(terms) .and. all_finite(a)
            where (known) used = used + 1
            noise = 0.0_dp
            if (k > near_states) call find_noise(system, program, t, q, v, rate, noise)
            conserved = conserved .and. (abs(rate) <= max(rounding*terms, amplified*noise) .or. &
                                         .not. known)
        end do
        conserved = conserved .and. used > 0
    end subroutine find_conserved

    pure subroutine find_noise(system, program, t, q, v, rate, noise)
        !! The changes of the rates where the state is another one by a few roundings.
        class(lagrangian_system_t), intent(in) :: system   !! whose motion it is
        type(formula_program_t), intent(in) :: program     !! the quantities, of t, q, q_dot
        real(dp), intent(in) :: t, q(:), v(:)              !! the state
        real(dp), intent(in) :: rate(:)                    !! of each quantity there
        real(dp), intent(out) :: noise(:)                  !! of each of them
        real(dp), parameter :: eps = epsilon(1.0_dp)
        real(dp), dimension(system%ndof) :: q_near, v_near, a_near
        real(dp), dimension(program%outputs) :: near, others
        integer :: i

        noise = 0.0_dp
        do i = 1, 3
            q_near = q*(1.0_dp + (2*i - 3)*eps)
            v_near = v*(1.0_dp - (2*i - 5)*eps)
            call system%accelerations(t, q_near, v_near, a_near)
            call rates(program, t, q_near, v_near, a_near, near, others)
            where (ieee_is_finite(near)) noise = max(noise, abs(near - rate))
        end do
    end subroutine find_noise

    pure subroutine keep_constraints(system, t, q, v)
        !! The velocities nearest to these that the constraints allow:
        !! \(v - A^\top(AA^\top)^{-1}(Av + b)\).
        class(lagrangian_system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:)
        real(dp), intent(inout) :: v(:)
        type(hyperdual_t) :: rows(system%constraints, size(q)), drift(system%constraints)
        type(hyperdual_t) :: place(size(q))
        real(dp) :: a(system%constraints, size(q)), multipliers(system%constraints)
        real(dp) :: products(system%constraints, system%constraints)

        if (system%constraints == 0) return
        place%re = q
        call system%constraint_rows(hyperdual_t(re=t), place, rows, drift)
        a = rows%re
        products = matmul(a, transpose(a))
        multipliers = matmul(a, v) + drift%re
        call solve_positive(products, 0.0_dp*multipliers, multipliers)
        v = v - matmul(multipliers, a)
    end subroutine keep_constraints

    pure subroutine rates(program, t, q, v, a, rate, terms)
        !! \(\dot A = \partial A/\partial t + \sum\partial A/\partial q_i\,\dot q_i
        !! + \partial A/\partial\dot q_i\,\ddot q_i\) of each quantity, and the sum of the absolute
        !! values of these terms.
        type(formula_program_t), intent(in) :: program     !! the quantities, of t, q, q_dot
        real(dp), intent(in) :: t, q(:), v(:), a(:)        !! a state of the motion
        real(dp), intent(out) :: rate(:), terms(:)         !! of each quantity
        type(hyperdual_t) :: values(1 + 2*size(q)), results(size(rate))
        real(dp) :: along(size(values))
        integer :: i

        along = [1.0_dp, v, a]
        values%re = [t, q, v]
        rate = 0.0_dp
        terms = 0.0_dp
        do i = 1, size(values)
            values(i)%d1 = along(i)
            call program%evaluate(values, results)
            values(i)%d1 = 0.0_dp
            rate = rate + results%d1
            terms = terms + abs(results%d1)
        end do
    end subroutine rates
end module lagrangia_written_quantities
