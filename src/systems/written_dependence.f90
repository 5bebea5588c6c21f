module lagrangia_written_dependence
    !! On what the formulas of an own system depend as formulas. A kick that lasts a moment and a
    !! wall far away are 0 at every state that is tried, so that `find_structure` cannot see them. A
    !! jump of sgn has no slope that would show it.
    use lagrangia_canonical_form, only: simplified
    use lagrangia_derivative, only: derivative
    use lagrangia_expression, only: expression_t, f_sgn, kind_function, operator(*), operator(+), &
                                    symbol, whole
    use lagrangia_kinds, only: dp
    use lagrangia_lagrangian_system, only: lagrangian_system_t
    use lagrangia_number_class, only: is_zero
    use lagrangia_place_functions, only: new_place_functions
    use lagrangia_substitution, only: substituted
    use lagrangia_symbols, only: symbols_t
    use lagrangia_time_functions, only: new_time_functions
    use lagrangia_written_constraints, only: constraint_drift, constraint_row
    use lagrangia_written_expressions, only: written_expressions_t
    use lagrangia_written_motion, only: written_motion_t
    implicit none (type, external)
    private
    public :: find_dependence

contains

    pure subroutine find_dependence(system, expressions, motion)
        !! What no trial state has shown and the formulas say: forces beside L, and that they work;
        !! the time in L and in them; velocities in the equations of motion, which rounding hides
        !! far below a speed of light; constraints that move; coordinates that are not cyclic.
        class(lagrangian_system_t), intent(inout) :: system  !! with its parameters, and with the
        !! structure that `find_structure` gave it; it is corrected
        type(written_expressions_t), intent(in) :: expressions  !! L, Q, constraints, their symbols
        type(written_motion_t), intent(in) :: motion         !! what follows from L and Q
        type(expression_t) :: power, q
        real(dp) :: values(1 + 2*system%ndof + size(system%p))
        ! of all symbols: those of the motion do not count
        integer :: i, j, n

        n = system%ndof
        values = [spread(0.0_dp, 1, 1 + 2*n), system%p]
        system%told_by_formulas = .true.
        call new_time_functions(system%time_functions, expressions%lagrangian, expressions%forces, &
                                expressions%constraints, values, 1 + 2*n)
        call new_place_functions(system%place_functions, expressions%lagrangian, &
                                 expressions%forces, expressions%constraints, values, n)
        power = whole(0)
        do i = 1, n
            q = short(expressions%forces(i), system%p, expressions%symbols)
            if (q%is_zero()) cycle
            power = power + q*symbol(1 + n + i)
            system%nonconservative = .true.
            system%time_dependent = system%time_dependent .or. q%depends_on(1)
            system%cyclic_coordinates(i) = .false.
        end do
        do i = 1, n
            if (system%velocity_forces) exit
            system%velocity_forces = has_velocities(motion%right(i))
            do j = 1, i
                if (.not. system%velocity_forces) system%velocity_forces = &
                    has_velocities(motion%mass(i, j))
            end do
        end do
        if (system%workless) then
            power = short(power, system%p, expressions%symbols)
            system%workless = power%is_zero()
        end if
        if (system%timeless_lagrangian .and. changes_with(1)) then
            system%timeless_lagrangian = .false.
            system%time_dependent = .true.
        end if
        do i = 1, n
            if (.not. system%cyclic_coordinates(i)) cycle
            if (changes_with(1 + i)) system%cyclic_coordinates(i) = .false.
        end do
        do i = 1, size(expressions%constraints)
            call look_at_constraint(system, expressions%constraints(i), expressions%symbols)
        end do
        system%cyclic = findloc(system%cyclic_coordinates, .true., 1)
    contains
        pure function has_velocities(expression) result(yes)
            type(expression_t), intent(in) :: expression
            logical :: yes
            type(expression_t) :: e
            integer :: k

            yes = any([(expression%depends_on(k), k=2 + n, 1 + 2*n)])
            if (.not. yes) return
            e = short(expression, system%p, expressions%symbols)
            yes = any([(e%depends_on(k), k=2 + n, 1 + 2*n)])
        end function has_velocities

        pure function changes_with(which) result(yes)
            integer, intent(in) :: which
            logical :: yes
            type(expression_t) :: slope

            yes = expressions%lagrangian%depends_on(which)
            if (.not. yes) return
            slope = short(derivative(expressions%lagrangian, which), system%p, expressions%symbols)
            yes = .not. slope%is_zero()
            if (yes) return
            yes = jumps_with(short(expressions%lagrangian, system%p, expressions%symbols), which)
        end function changes_with
    end subroutine find_dependence

    pure subroutine look_at_constraint(system, constraint, symbols)
        !! It works where it has a part without velocities, and leaves a momentum alone where it
        !! contains neither the velocity nor the coordinate.
        class(lagrangian_system_t), intent(inout) :: system
        type(expression_t), intent(in) :: constraint  !! of t, q, q_dot, parameters
        type(symbols_t), intent(in) :: symbols        !! their names
        type(expression_t) :: part
        integer :: k, row

        do row = 0, system%ndof
            if (row == 0) then
                part = constraint_drift(constraint, system%ndof, symbols)
            else
                part = constraint_row(constraint, row, system%ndof, symbols)
            end if
            part = short(part, system%p, symbols)
            if (part%is_zero()) cycle
            if (row == 0) system%constraints_work = .true.
            if (row > 0) system%cyclic_coordinates(row) = .false.
            system%time_dependent = system%time_dependent .or. part%depends_on(1)
            do k = 1, system%ndof
                if (part%depends_on(1 + k)) system%cyclic_coordinates(k) = .false.
            end do
        end do
    end subroutine look_at_constraint

    pure function jumps_with(expression, which) result(yes)
        !! Is there a sgn of this symbol?
        type(expression_t), intent(in) :: expression
        integer, intent(in) :: which
        logical :: yes
        type(expression_t) :: argument
        integer :: k

        yes = .false.
        do k = 1, expression%count
            associate (node => expression%nodes(k))
                if (node%kind /= kind_function) cycle
                if (node%which /= f_sgn) cycle
                argument = expression%pruned(node%left)
            end associate
            yes = argument%depends_on(which)
            if (yes) return
        end do
    end function jumps_with

    pure function short(expression, p, symbols) result(e)
        !! The canonical form, with 0 for the parameters that are 0.
        type(expression_t), intent(in) :: expression
        real(dp), intent(in) :: p(:)
        type(symbols_t), intent(in) :: symbols
        type(expression_t) :: e
        type(expression_t), allocatable :: zeros(:)  ! gfortran 12 never frees a list of results
        integer, allocatable :: places(:)
        integer :: first, i

        e = expression
        if (e%is_zero()) return
        first = size(symbols%names) - size(p)
        places = pack([(first + i, i=1, size(p))], is_zero(p))
        allocate (zeros(size(places)))
        do i = 1, size(places)
            zeros(i) = whole(0)
        end do
        if (size(places) > 0) e = substituted(e, places, zeros)
        e = simplified(e, symbols)
    end function short
end module lagrangia_written_dependence
