module lagrangia_free_constants
    !! Statements with constants of integration: `theta_dot^2 = 2 g/l cos(theta) + h`, right if it
    !! goes on to hold on each motion on which it once does, whatever the constant is.
    use lagrangia_constant_values, only: draw_constants, solve_constants
    use lagrangia_declared_constants, only: keep_constant
    use lagrangia_derivative, only: derivative, time_derivative
    use lagrangia_energy_statements, only: contradicted_line, keep_energy
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, operator(-), symbol, whole
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_text, only: typed_name
    use lagrangia_kinds, only: dp
    use lagrangia_names, only: name_length
    use lagrangia_number_class, only: is_zero
    use lagrangia_sample_names, only: samples_t
    use lagrangia_slip_search, only: holds
    use lagrangia_small_energies, only: is_constant_of_each_draw
    use lagrangia_solved_accelerations, only: without_accelerations
    use lagrangia_stated_starts, only: find_stated
    use lagrangia_substitution, only: substituted
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: join, to_text
    use lagrangia_unknown_names, only: add_unknown, hidden, unknown_names
    use lagrangia_verdict, only: is_right, is_unreadable, is_wrong, judgement_t, with_any
    use lagrangia_written_out, only: energy_formulas, in_coordinates
    implicit none (type, external)
    private
    public :: judge_with_constants

    integer, parameter :: most_constants = 3  !! of one statement that are not any number

contains

    subroutine judge_with_constants(left_text, right_text, samples, is_one, judgement)
        !! A statement whose unknown names are constants: those of `constant:`, or values of
        !! coordinates and velocities at the start, t = 0, `theta_0`; else `is_one` is false. Of k
        !! constants \(F=\dot F=\dots=F^{(k-1)}=0\) gives the values, and \(F^{(k)}=0\) says that
        !! they stay. A declared one means the same in all lines behind the first.
        character(*), intent(in) :: left_text, right_text  !! both sides, in their columns
        type(samples_t), intent(inout) :: samples          !! know the names behind `constant:`
        logical, intent(out) :: is_one                     !! all is said
        type(judgement_t), intent(inout) :: judgement      !! of it
        character(name_length), allocatable :: names(:)
        type(expression_t) :: left, nothing, right, residual
        type(symbols_t) :: symbols
        type(error_t), allocatable :: error
        real(dp), allocatable :: values(:, :)
        integer, allocatable :: starts(:), chosen(:)
        integer :: i, line, n, turned
        logical :: judged, open_end, yes

        is_one = .false.
        call unknown_names(left_text//" + "//right_text, samples%symbols, names)
        if (size(names) == 0) return
        allocate (starts(size(names)))
        do i = 1, size(names)
            starts(i) = start_of(trim(names(i)), samples)
            if (any(samples%declared == names(i))) starts(i) = -1
            if (starts(i) == 0) return
        end do
        symbols = samples%symbols
        call add_unknown(names, symbols)
        call parse_formula(left_text, symbols, left, error)
        if (.not. allocated(error)) call parse_formula(right_text, symbols, right, error)
        if (allocated(error)) return
        residual = left - right
        n = size(samples%role)
        if (.not. moves()) return
        is_one = .true.
        judgement%verdict = is_unreadable
        call find_rates()
        if (unknown_rate(residual) /= "") residual = without_accelerations( &
            in_coordinates(residual, samples), samples)
        if (unknown_rate(residual) /= "") then
            judgement%remark = "d/dt of '"//typed_name(unknown_rate(residual))// &
                               "' is not known here; write the formula for it"
            return
        end if
        if (.not. begins_there()) return
        call find_constants()
        turned = 0
        if (judged .and. .not. (yes .or. any(starts > 1))) call turn_axes()
        if (yes) then
            judgement%verdict = is_right
            judgement%remark = with_any//trim(names(1))
            if (turned > 0) then
                judgement%remark = judgement%remark//", where "//trim(symbols%names(turned))// &
                                   " is counted from an axis of each motion"
                return
            end if
            line = contradicted_line(residual, names, samples)
            if (line > 0) then
                judgement%verdict = is_wrong
                judgement%remark = "line "//to_text(line)//" has another E with "// &
                                   join(names, ", ")
                judgement%residual = nothing  ! it contradicts a line, not the motion
                judgement%of_motion = .false.
                return
            end if
            call keep_energy(residual, names, samples)
            call keep_constants()
        else if (open_end) then
            judgement%remark = "its derivatives by the time are not known here; solve for one "// &
                               "of its constants, or write its derivative"
        else if (judged .and. residual%depends_on(1) .and. any(starts > 1) .and. &
                 .not. any(starts > 1 + samples%ndof)) then
            judgement%remark = "true of motions that begin at rest at most; name the velocity "// &
                               "at the start, as in x = x_0 + x_dot_0 t"
        else if (judged) then
            judgement%verdict = is_wrong
            judgement%remark = "no "//trim(names(1))//" stays constant with it: its derivative "// &
                               "by the time contradicts the motion"
        else
            judgement%remark = "no value of '"//trim(names(1))//"' makes it true at the states "// &
                               "that were tried"
        end if
    contains
        logical function moves()
            !! Is there a coordinate or a velocity in it, or a constant of a line before?
            integer :: k

            moves = any([(residual%depends_on(k), k=2, 1 + 2*samples%ndof)]) .or. &
                    any([(residual%depends_on(k) .and. symbols%rates(k) > 0, k=1, n)]) .or. &
                    any([(residual%depends_on(samples%kept_constants(k)), &
                          k=1, size(samples%kept_constants))])
        end function moves

        subroutine find_rates()
            !! Constant accelerations have one, and what is conserved has the rate 0.
            type(expression_t) :: acceleration
            logical :: is_constant
            integer :: k

            do k = samples%first_acceleration, samples%first_acceleration + samples%ndof - 1
                acceleration = symbol(k)
                is_constant = is_constant_of_each_draw(acceleration, samples)
                if (is_constant) symbols%rates(k) = 0
            end do
            do k = 2, n
                if (symbols%rates(k) < 1) cycle
                if (all(is_zero(samples%values(:, symbols%rates(k))))) symbols%rates(k) = 0
            end do
        end subroutine find_rates

        function unknown_rate(of) result(name)
            !! Of a symbol on which it depends; empty: all are known.
            type(expression_t), intent(in) :: of
            character(:), allocatable :: name
            integer :: k

            name = ""
            do k = 1, n
                if (.not. of%depends_on(k) .or. symbols%rates(k) >= 0) cycle
                name = trim(symbols%names(k))
                return
            end do
        end function unknown_rate

        logical function begins_there()
            !! It must be true at the start itself: at theta_0, and at rest if no velocity is named,
            !! or as lines of the sheet state it.
            type(expression_t) :: begun, stated
            type(symbols_t) :: there
            type(expression_t), allocatable :: put(:)
            integer, allocatable :: places(:)
            logical :: known
            integer :: j, k

            begins_there = .true.
            if (.not. any(starts > 1)) return
            begun = in_coordinates(residual, samples)
            allocate (put(1 + 2*samples%ndof))
            places = [1]
            put(1) = whole(0)  ! t
            there = symbols
            do k = 2, 1 + 2*samples%ndof
                call find_stated(k, samples, there, stated)
                if (is_given(stated, k)) then
                    places = [places, k]
                    put(size(places)) = stated
                    cycle
                end if
                do j = 1, size(starts)
                    if (starts(j) /= k) cycle
                    places = [places, k]
                    put(size(places)) = symbol(n + j)
                end do
                if (any(places == k)) cycle
                if (k <= 1 + samples%ndof) then
                    if (begun%depends_on(k)) begins_there = .false.
                else
                    places = [places, k]
                    put(size(places)) = whole(0)
                end if
            end do
            if (begins_there) then
                begun = substituted(begun, places, put(:size(places)))
                call draw_constants(samples, size(there%names) - n, values)
                call holds(begun, values, begins_there, known)
            end if
            if (.not. begins_there) judgement%remark = "is '"//trim(names(1))//"' where the "// &
                "motion begins? It does not hold there; a line 'constant: "//trim(names(1))// &
                "' makes it any constant"
        end function begins_there

        logical function is_given(value, of)
            !! `x(0) = 2 x_0` says what the x_0 of the statement is, `x_dot(0) = 0` what x_dot is
            !! where it names none.
            type(expression_t), intent(in) :: value  !! that a line states, or empty
            integer, intent(in) :: of                !! place of the coordinate or velocity
            integer :: j

            is_given = value%count > 0
            do j = 1, size(starts)
                if (starts(j) == of) is_given = is_given .and. value%depends_on(n + j)
            end do
        end function is_given

        subroutine turn_axes()
            !! The ellipse's \(\varphi\) is mostly counted from the perihelion: a coordinate that
            !! L does not have may begin anywhere.
            type(expression_t), allocatable :: formulas(:)
            type(expression_t) :: counted(1), slope, typed
            character(name_length), allocatable :: given(:)
            integer :: k
            logical :: cyclic

            if (samples%lagrangian%count == 0) return
            call energy_formulas(samples, formulas)
            typed = residual
            given = names
            call symbols%add("axis"//hidden)
            do k = 2, 1 + samples%ndof
                if (.not. typed%depends_on(k)) cycle
                slope = derivative(formulas(1), k)
                call holds(slope, samples%values, cyclic, judged)
                if (.not. cyclic) cycle
                names = [character(name_length) :: given, "axis"//hidden]
                starts = [(-1, i=1, size(names))]
                counted(1) = symbol(k) - symbol(n + size(names))
                residual = substituted(typed, [k], counted)
                call find_constants()
                if (yes) then
                    turned = k
                    names = given
                    return
                end if
            end do
            residual = typed
            names = given
            judged = .true.
        end subroutine turn_axes

        subroutine find_constants()
            !! The fewest constants that can have values which stay, whatever the others are.
            integer :: choice, k

            judged = .false.
            open_end = .false.
            yes = .false.
            do k = 1, min(size(names), most_constants)
                do choice = 1, 2**min(size(names), 10) - 1
                    if (popcnt(choice) /= k) cycle
                    chosen = pack([(i, i=1, size(names))], [(btest(choice, i - 1), &
                                                             i=1, size(names))])
                    if (.not. all([(residual%depends_on(n + chosen(i)), i=1, k)])) cycle
                    call try_constants()
                    if (yes) return
                end do
            end do
        end subroutine find_constants

        subroutine try_constants()
            !! Those that are chosen.
            type(expression_t) :: rates(0:size(chosen))
            logical :: known, regular, stay
            integer :: k

            rates(0) = residual
            do k = 1, size(chosen)
                if (unknown_rate(rates(k - 1)) /= "") rates(k - 1) = without_accelerations( &
                    rates(k - 1), samples)
                if (unknown_rate(rates(k - 1)) /= "") then
                    if (k == size(chosen)) open_end = open_end .or. has_chosen(rates(k - 1))
                    return
                end if
                rates(k) = time_derivative(rates(k - 1), symbols%rates, 1)
            end do
            call draw_constants(samples, size(names), values)
            call solve_constants(rates(:size(chosen) - 1), n + chosen, values, regular)
            call holds(rates(size(chosen)), values, stay, known)
            open_end = open_end .or. (regular .and. .not. known .and. size(chosen) > 1)
            judged = judged .or. known
            yes = known .and. stay
            ! what it says of accelerations, without the constants
            if (.not. yes) return
            if (any([(rates(size(chosen))%depends_on(n + k), k=1, size(names))])) return
            judgement%residual = rates(size(chosen))
            judgement%of_motion = .true.
        end subroutine try_constants

        logical function has_chosen(rate)
            !! Is a constant that is chosen in it? Otherwise they have no values by it.
            type(expression_t), intent(in) :: rate
            integer :: k

            has_chosen = any([(rate%depends_on(n + chosen(k)), k=1, size(chosen))])
        end function has_chosen

        logical function has_energy(side)
            type(expression_t), intent(in) :: side
            integer :: k

            has_energy = .false.
            do k = 1, n
                if (side%depends_on(k)) has_energy = has_energy .or. &
                    any(symbols%names(k) == ["L", "V", "E"])
            end do
        end function has_energy

        subroutine keep_constants()
            !! A declared one that this line gives a value has it in the lines behind, and so has
            !! its opposite where that makes the line true as well.
            real(dp), allocatable :: opposite(:, :)
            logical :: known, too
            integer :: k, place

            if (any([(residual%depends_on(n + i) .and. .not. any(chosen == i), &
                      i=1, size(names))])) return
            ! of L, V and E the zero is anybody's choice
            if (has_energy(left) .or. has_energy(right)) return
            do k = 1, size(chosen)
                if (starts(chosen(k)) /= -1) cycle
                place = n + chosen(k)
                opposite = values
                opposite(:, place) = -opposite(:, place)
                call holds(residual, opposite, too, known)
                call keep_constant(trim(names(chosen(k))), values(:, place), known .and. too, &
                                   samples)
            end do
        end subroutine keep_constants
    end subroutine judge_with_constants

    pure function start_of(name, samples) result(place)
        !! The coordinate or velocity whose value at the start is called that; 0: none.
        character(*), intent(in) :: name
        type(samples_t), intent(in) :: samples
        integer :: place
        character(:), allocatable :: of

        do place = 2, 1 + 2*samples%ndof
            of = trim(samples%symbols%names(place))
            if (name == of//"_0" .or. name == of//"0") return
        end do
        place = 0
    end function start_of
end module lagrangia_free_constants
