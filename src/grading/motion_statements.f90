module lagrangia_motion_statements
    !! A motion that is written out, `theta = A cos(omega t + phi)`: right if it solves the equation
    !! of motion, or the linearised one. Names that nobody knows are its constants.
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, is_function_name, operator(*), operator(+), &
                                    operator(-), operator(/), symbol, whole
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_tokens, only: cut, is_name, tokens_t
    use lagrangia_initial_conditions, only: judge_start
    use lagrangia_joint_motions, only: go_together, solve_exactly
    use lagrangia_kept_motions, only: is_same_motion, keep_motion
    use lagrangia_kinds, only: dp
    use lagrangia_mode_samples, only: put_places
    use lagrangia_motion_values, only: draw_values, no_such_mode, put_frequencies, rate_of, &
                                       unknown_rate, values_of
    use lagrangia_number_class, only: all_finite, is_nonzero, is_zero
    use lagrangia_rounded_numbers, only: put_exact_frequencies, to_digits, try_rounded
    use lagrangia_sample_names, only: draws, role_frequency, role_parameter, samples_t, states
    use lagrangia_slip_search, only: holds
    use lagrangia_small_energies, only: is_constant_of_each_draw
    use lagrangia_stated_starts, only: compare_start, is_given, state_start
    use lagrangia_statement_forms, only: period
    use lagrangia_substitution, only: substituted
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: to_text
    use lagrangia_verdict, only: is_right, is_unreadable, is_wrong, judgement_t
    use lagrangia_written_out, only: equation_of_motion
    implicit none (type, external)
    private
    public :: judge_motion

    integer, parameter :: most_coordinates = 3  !! of which all modes are tried
    integer, parameter :: enough = 4            !! states at which all is finite
    real(dp), parameter :: tolerance = 1e-8_dp  !! of terms that cancel

contains

    subroutine judge_motion(side, text, typed, samples, is_one, judgement)
        !! A coordinate alone on the left side, or its rate, and a function of the time on the right
        !! one, or either at the time 0 and a constant; else `is_one` is false.
        character(*), intent(in) :: side                !! the left one, in plain letters
        character(*), intent(in) :: text                !! the right one, behind blanks
        character(*), intent(in) :: typed               !! both, as typed
        type(samples_t), intent(inout) :: samples       !! remember the motion
        logical, intent(out) :: is_one                  !! all is said
        type(judgement_t), intent(inout) :: judgement   !! of it
        type(expression_t) :: f, at_period(1)
        type(symbols_t) :: symbols
        type(error_t), allocatable :: error
        real(dp), allocatable :: values(:, :)
        character(:), allocatable :: unknown
        integer :: coordinate, letter, order, which
        logical :: exact, judged, known, solved, starts

        which = index(side, "(0)")
        starts = which > 1
        if (starts) starts = side(which:) == "(0)"
        if (starts) then
            call find_side(side(:which - 1), samples, coordinate, order)
        else
            call find_side(side, samples, coordinate, order)
        end if
        is_one = .false.
        if (coordinate == 0) return
        symbols = samples%symbols
        call add_constants(text, symbols, samples, error)
        if (allocated(error)) return
        call parse_formula(text, symbols, f, error)
        if (allocated(error)) return
        at_period(1) = period(samples)
        letter = samples%symbols%find("T")
        if (letter > 0) then
            if (f%depends_on(letter)) f = substituted(f, [letter], at_period)
        end if
        if (starts) then
            call judge_start(coordinate, order, f, samples, size(symbols%names), is_one, judgement)
            if (is_one) call state_start(coordinate, order, text, samples, judgement)
            return
        end if
        if (.not. is_of_time(f, samples)) return
        call draw_values(samples, size(symbols%names), values)
        is_one = .true.
        if (is_same_motion(f, samples%motion(coordinate), samples)) then
            call compare_rate(coordinate, order, f, typed, samples, values, judgement)
            if (judgement%verdict /= is_wrong .or. order > 0) return
            if (.not. is_given(coordinate, f, symbols, samples)) return
            if (is_given(coordinate, samples%motion(coordinate), symbols, samples)) return
            judgement%remark = ""
        end if
        call put_exact_frequencies(typed, samples, f)
        call compare_exact(coordinate, order, f, typed, samples, values, known, judgement)
        solved = known .and. judgement%verdict == is_right
        exact = solved
        do which = 1, merge(2, 1, samples%ndof == 1)
            if (solved) exit
            call compare_linear(coordinate, order, f, samples, which == 2, values, judged, &
                                judgement)
            known = known .or. judged
            solved = judged .and. judgement%verdict == is_right
        end do
        if (solved .and. .not. exact .and. order == 0 .and. samples%ndof > 1) then
            if (.not. go_together(coordinate, f, samples, values)) then
                judgement%verdict = is_wrong
                judgement%remark = "it does not go with the motion of another coordinate"
                return
            end if
        end if
        if (solved .and. order < 2) then
            call compare_start(coordinate, order, f, symbols, values, samples, judgement)
            if (judgement%verdict == is_wrong) return
        end if
        if (exact .and. order < 2) call keep_motion(coordinate, order, f, samples)
        if (solved .and. order == 0) then
            samples%motion(coordinate) = f
            samples%exact_motion(coordinate) = exact
            if (.not. exact .and. samples%ndof > 1) exact = solve_exactly(samples, values)
            if (exact .and. .not. samples%exact_motion(coordinate)) samples%exact_motion = .true.
        end if
        if (solved) judgement%example = ""
        unknown = ""
        if (.not. solved) unknown = unknown_rate(f, samples)
        if (known .and. unknown == "") return
        judgement%verdict = is_unreadable
        if (unknown /= "") then
            judgement%remark = "what is '"//unknown//"'? Write a line before, "//unknown// &
                " = ..., or omega and gamma for what the program knows"
            return
        else if (samples%ndof == 1) then
            judgement%remark = "no number at the times that were tried; fix "// &
                "parameters at which it oscillates by lines like 'set: g = 9.81'"
            return
        end if
        judgement%remark = "a motion of coupled coordinates is not graded, only what holds at "// &
            "all times; write its equation, or its frequency"
    end subroutine judge_motion

    subroutine find_side(side, samples, coordinate, order)
        !! Which coordinate, and how often it is differentiated; 0: it is none.
        character(*), intent(in) :: side
        type(samples_t), intent(in) :: samples
        integer, intent(out) :: coordinate, order
        type(expression_t) :: left
        type(error_t), allocatable :: error

        coordinate = 0
        order = 0
        call parse_formula(side, samples%symbols, left, error)
        if (left%count /= 1) return  ! it cannot be read, or is more than a name
        associate (place => left%nodes(1)%which)
            if (place < 2 .or. place > 1 + 3*samples%ndof) return
            coordinate = 1 + mod(place - 2, samples%ndof)
            order = (place - 2)/samples%ndof
        end associate
    end subroutine find_side

    subroutine add_constants(text, symbols, samples, error)
        !! Names behind all others, the same ones for each line.
        character(*), intent(in) :: text
        type(symbols_t), intent(inout) :: symbols
        type(samples_t), intent(inout) :: samples
        type(error_t), allocatable, intent(out) :: error  !! the text cannot be read
        character(:), allocatable :: word
        type(tokens_t) :: tokens
        integer :: i

        call cut(text, tokens, error)
        if (allocated(error)) return
        do i = 1, size(tokens%token)
            if (tokens%token(i)%kind /= is_name) cycle
            word = symbols%spelling(tokens%word(i))
            if (symbols%find(word) > 0 .or. symbols%find_definition(word) > 0) cycle
            if (is_function_name(word) .or. word == "pi" .or. word == "e") cycle
            if (any(samples%constants == word)) cycle
            if (index(word//" ", "_dot ") + index(word//" ", "_ddot ") > 0 .or. &
                index(word, "p_") == 1) cycle
            if (tokens%word(min(i + 1, size(tokens%token))) == "(" .and. len(word) > 1) cycle
            samples%constants = [character(len(samples%constants)) :: samples%constants, word]
        end do
        do i = 1, size(samples%constants)
            ! a definition of this name came between two lines, or its value
            if (symbols%find_definition(trim(samples%constants(i))) > 0 .or. &
                symbols%find(trim(samples%constants(i))) > 0) then
                call symbols%add("_"//trim(samples%constants(i)))
            else
                call symbols%add(trim(samples%constants(i)))
            end if
        end do
    end subroutine add_constants

    pure function is_of_time(f, samples) result(yes)
        !! With t in it, and beside it constants only.
        type(expression_t), intent(in) :: f
        type(samples_t), intent(in) :: samples
        logical :: yes
        integer :: k

        yes = f%depends_on(1)
        do k = 2, size(samples%role)
            if (.not. yes) return
            if (.not. f%depends_on(k)) cycle
            yes = samples%role(k) == role_frequency .or. any(samples%place == k) .or. &
                  (samples%role(k) == role_parameter .and. samples%rate(k) == 0)
            if (samples%decay > 0) yes = yes .or. k == samples%decay .or. k == samples%decay + 1
        end do
    end function is_of_time

    subroutine compare_rate(coordinate, order, f, typed, samples, values, judgement)
        !! A second line about the same coordinate.
        integer, intent(in) :: coordinate, order
        type(expression_t), intent(in) :: f
        character(*), intent(in) :: typed             !! both sides
        type(samples_t), intent(in) :: samples
        real(dp), intent(in) :: values(:, :)
        type(judgement_t), intent(inout) :: judgement
        real(dp), allocatable :: there(:, :)
        type(expression_t) :: residual
        logical :: judged, known, yes
        integer :: about, k

        judged = .false.
        allocate (there, source=values)
        do about = 1, 2
            if (about == 2 .and. any(is_zero(samples%omega2(:, samples%ndof + 1)))) exit
            call put_frequencies(samples, merge(1, samples%ndof + 1, about == 1), there)
            if (about == 1) call put_places(samples, samples%equilibrium, there)
            if (about == 2) call put_places(samples, samples%other_equilibrium, there)
            residual = rate_of(samples%motion(coordinate), order) - f
            do k = 0, merge(2, 0, order == 0)
                ! perhaps one of both lines counts from the equilibrium
                if (k == 1) residual = residual - symbol(samples%place(coordinate))
                if (k == 2) residual = residual + whole(2)*symbol(samples%place(coordinate))
                call holds(residual, there, yes, known)
                judged = judged .or. known
                if (known .and. .not. yes) call try_rounded(residual, typed, there, yes, &
                                                               judgement%remark)
                if (yes) exit
            end do
            if (yes) exit
        end do
        judgement%verdict = is_right
        if (.not. judged) then
            judgement%verdict = is_unreadable
            judgement%remark = "no number at the times that were tried"
        else if (.not. yes) then
            judgement%verdict = is_wrong
            judgement%remark = "not the derivative of the motion of the line before"
            if (order == 0) judgement%remark = "not the motion of the line before; its "// &
                                               "constants keep their meanings"
        end if
    end subroutine compare_rate

    subroutine compare_exact(coordinate, order, f, typed, samples, values, is_one, judgement)
        !! With the equation of motion that follows from L, where it has no other coordinates.
        integer, intent(in) :: coordinate, order
        type(expression_t), intent(inout) :: f
        character(*), intent(in) :: typed             !! both sides
        type(samples_t), intent(in) :: samples
        real(dp), intent(in) :: values(:, :)
        logical, intent(out) :: is_one
        type(judgement_t), intent(inout) :: judgement
        type(expression_t) :: equation, put(3)
        integer :: j, k, n, places(3)
        logical :: judged, yes

        is_one = .false.
        n = samples%ndof
        equation = symbol(samples%first_acceleration - 1 + coordinate)
        yes = order < 2
        if (yes) yes = is_constant_of_each_draw(equation, samples)
        if (yes) then
            ! free fall, and what rolls or slides down a plane
            put(1) = rate_of(f, 2 - order)
            judgement%remark = ""
            call holds(put(1) - equation, values, yes, is_one)
            if (is_one .and. .not. yes) call try_rounded(put(1) - equation, typed, values, yes, &
                                                         judgement%remark)
            judgement%verdict = merge(is_right, is_wrong, yes)
            if (.not. yes) judgement%remark = "it does not solve the equation of motion"
            if (judgement%remark /= to_digits) return
            put(1) = symbol(1)*(equation - put(1))  ! its lines go on with all digits
            if (order == 0) put(1) = symbol(1)*put(1)/whole(2)
            f = f + put(1)
            return
        end if
        if (order > 0 .or. samples%lagrangian%count == 0 .or. .not. allocated(samples%mass)) return
        equation = equation_of_motion(coordinate, samples)
        call holds(equation, samples%values, yes, judged)
        if (.not. yes) return  ! other forces act
        places = 1 + coordinate + [0, n, 2*n]
        do j = 2, 1 + 3*n
            if (.not. any(places == j) .and. equation%depends_on(j)) return
        end do
        do k = 1, 3
            put(k) = rate_of(f, k - 1)
        end do
        call holds(substituted(equation, places, put), values, yes, judged)
        is_one = judged
        if (.not. yes .and. equation%depends_on(1)) is_one = .false.  ! without the drive, perhaps
        judgement%verdict = merge(is_right, is_wrong, yes)
        judgement%remark = ""
        if (.not. yes) judgement%remark = "it does not solve the equation of motion"
        if (.not. yes .and. any(is_nonzero(samples%omega2))) judgement%remark = "it solves "// &
            "neither the equation of motion nor the linearised one"
    end subroutine compare_exact

    subroutine compare_linear(coordinate, order, f, samples, about_other, values, is_one, &
                              judgement)
        !! With the oscillations about an equilibrium.
        integer, intent(in) :: coordinate, order
        type(expression_t), intent(in) :: f
        type(samples_t), intent(in) :: samples
        logical, intent(in) :: about_other           !! the other one that the page knows
        real(dp), intent(inout) :: values(:, :)      !! get its frequency
        logical, intent(out) :: is_one
        type(judgement_t), intent(inout) :: judgement
        real(dp), allocatable :: equilibrium(:, :)
        real(dp), allocatable, dimension(:, :, :) :: stiffness, turning, inertia
        logical :: alone, known, yes
        integer :: counted, first

        is_one = .false.
        if (about_other) then
            allocate (equilibrium, source=samples%other_equilibrium)
            allocate (stiffness, source=samples%other_stiffness)
            allocate (turning, source=samples%other_turning)
            allocate (inertia, source=samples%other_inertia)
        else
            allocate (equilibrium, source=samples%equilibrium)
            allocate (stiffness, source=samples%stiffness)
            allocate (turning, source=samples%turning)
            allocate (inertia, source=samples%inertia)
        end if
        first = merge(samples%ndof + 1, 1, about_other)
        call put_frequencies(samples, first, values)
        call put_places(samples, equilibrium, values)
        alone = is_alone(coordinate, samples)
        if (.not. alone .and. (samples%ndof > most_coordinates .or. .not. is_free(samples))) return
        do counted = 0, merge(1, 0, order == 0)
            call solves(counted == 1, yes, known)
            if (.not. known) return
            if (yes) exit
        end do
        is_one = .true.
        judgement%verdict = merge(is_right, is_wrong, yes)
        if (.not. yes) then
            if (judgement%remark == "" .and. no_such_mode(f, samples) /= "") then
                judgement%remark = "'"//no_such_mode(f, samples)//"' is the frequency of no "// &
                    "mode; there are "//to_text(samples%ndof)
            else if (judgement%remark == "") then
                judgement%remark = "it does not solve the linearised equations of motion"
            end if
        else if (counted == 1) then
            judgement%remark = "of small oscillations, if the coordinates are counted from the "// &
                               "equilibrium"
        else
            judgement%remark = "of small oscillations"
        end if
    contains
        subroutine solves(from_equilibrium, holds_true, is_known)
            !! The product of all \(D^2+\omega_k^2\), or \(M D^2 + C D + K\), takes f to 0.
            logical, intent(in) :: from_equilibrium
            logical, intent(out) :: holds_true, is_known
            real(dp), allocatable :: rates(:, :), factors(:)
            real(dp) :: place, terms
            type(expression_t) :: rate
            integer :: draw, finite, k, row, times

            times = merge(2, 2*samples%ndof, alone)
            allocate (rates(size(values, 1), 0:times), source=0.0_dp)
            do k = 0, times
                rate = rate_of(f, k)
                rates(:, k) = values_of(rate, values)
            end do
            finite = 0
            holds_true = .true.
            do row = 1, size(values, 1)
                draw = 1 + (row - 1)/states
                place = equilibrium(coordinate, draw)
                if (from_equilibrium .or. order > 0) place = 0.0_dp
                factors = coefficients(draw)
                rates(row, 0) = rates(row, 0) - place
                if (.not. all_finite([factors, rates(row, :)])) cycle
                finite = finite + 1
                terms = sum(abs(factors*rates(row, :))) + abs(factors(1)*place)
                if (abs(sum(factors*rates(row, :))) > tolerance*terms) holds_true = .false.
            end do
            is_known = finite >= enough
        end subroutine solves

        function coefficients(draw) result(factors)
            !! Of f, its rate, and so on.
            integer, intent(in) :: draw
            real(dp), allocatable :: factors(:)
            integer :: k, last

            associate (i => coordinate)
                if (alone) then
                    factors = [stiffness(i, i, draw), turning(i, i, draw), &
                               inertia(i, i, draw)]
                    return
                end if
            end associate
            allocate (factors(2*samples%ndof + 1), source=0.0_dp)
            factors(1) = 1.0_dp
            last = 1
            do k = 1, samples%ndof
                factors(3:last + 2) = samples%omega2(draw, k)*factors(3:last + 2) + factors(1:last)
                factors(1:2) = samples%omega2(draw, k)*factors(1:2)
                last = last + 2
            end do
        end function coefficients
    end subroutine compare_linear

    pure function is_alone(coordinate, samples) result(yes)
        !! Is its linearised equation free of other coordinates?
        integer, intent(in) :: coordinate
        type(samples_t), intent(in) :: samples
        logical :: yes
        integer :: j

        yes = .true.
        do j = 1, samples%ndof
            if (j == coordinate) cycle
            yes = yes .and. all(is_zero(samples%inertia(coordinate, j, :))) .and. &
                  all(is_zero(samples%stiffness(coordinate, j, :))) .and. &
                  all(.not. is_nonzero(samples%turning(coordinate, j, :)))
        end do
    end function is_alone

    pure function is_free(samples) result(yes)
        !! No drag, which the frequencies of several coordinates leave out.
        type(samples_t), intent(in) :: samples
        logical :: yes
        integer :: draw

        yes = .true.
        do draw = 1, draws
            associate (b => samples%turning(:, :, draw))
                yes = yes .and. all(.not. abs(b + transpose(b)) > 1e-12_dp*sum(abs(b)))
            end associate
        end do
    end function is_free
end module lagrangia_motion_statements
