module lagrangia_judgement
    !! Is this statement right? Both sides are evaluated on the motion, at states and with
    !! parameters at random: any equivalent form is right, whatever it was multiplied by or mixed
    !! with.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_characters, only: characters
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: apply, expression_t, f_sqrt, kind_function, kind_symbol, &
                                    operator(-), whole
    use lagrangia_formula_characters, only: plain_formula
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_frequency_squares, only: square, with_squares
    use lagrangia_homework, only: statement_t
    use lagrangia_kinds, only: dp
    use lagrangia_motion_samples, only: put_places
    use lagrangia_same_motion, only: same_equations
    use lagrangia_sample_names, only: draws, samples_t, states
    use lagrangia_sampled_formula, only: evaluate_nodes
    use lagrangia_slip_search, only: explain_slip, holds, is_trivial
    use lagrangia_small_energies, only: is_energy, put_same_constant
    use lagrangia_small_judgement, only: judge_small
    use lagrangia_statement_forms, only: define_by_period, define_rates, drop_root_of_name, &
                                         find_frequency, is_constancy, is_motion, is_slope, &
                                         is_value, read_as_period, read_new_name, speaks_of_place
    use lagrangia_term_search, only: library_t
    use lagrangia_text, only: to_text
    use lagrangia_verdict, only: is_consequence, is_definition, is_right, is_unreadable, is_wrong, &
                                 judgement_t, put_example
    implicit none (type, external)
    private
    public :: judgement_t
    public :: judge
    public :: is_right, is_definition, is_wrong, is_unreadable, is_consequence

contains

    subroutine judge(statement, samples, library, explain, judgement)
        !! One line, `a = b` or `a = b = c`; a new name on the left is defined by it.
        type(statement_t), intent(in) :: statement      !! as typed
        type(samples_t), intent(inout) :: samples       !! gets the names that it defines
        type(library_t), intent(in) :: library(:)       !! right terms, for what is missing
        logical, intent(in) :: explain                  !! say what is wrong
        type(judgement_t), intent(out) :: judgement     !! of it
        type(error_t), allocatable :: error
        type(expression_t) :: left, right
        character(:), allocatable :: name, side, text
        integer, allocatable :: columns(:)
        integer :: begun, first, next, last
        logical :: chained, squared

        chained = .false.
        begun = 1
        judgement%remark = ""
        judgement%example = ""
        text = statement%text
        if (statement%small) text(:index(text, ":")) = ""
        next = index(text, "=")
        call find_empty_side(text, judgement)
        if (judgement%verdict == is_unreadable) return
        call plain_formula(text(:next - 1), side, columns, error)
        if (allocated(error)) side = text(:next - 1)
        call read_new_name(side, samples, name, squared)
        if (name /= "" .and. index(text(next + 1:), "=") == 0) then
            call define(name, squared, text, next, samples, library, judgement)
            return
        end if
        call parse_formula(text(:next - 1), samples%symbols, left, error)
        if (allocated(error)) then
            call put_unreadable(error, judgement)
            return
        end if
        chained = is_slope(side)
        do
            first = next + 1
            last = index(text(first:), "=")
            next = merge(len(text) + 1, first + last - 1, last == 0)
            ! blanks in front keep the columns of what went before
            call parse_formula(repeat(" ", characters(text(:first - 1)))//text(first:next - 1), &
                               samples%symbols, right, error)
            if (.not. allocated(error)) call read_as_period(left, right, samples, chained)
            if (is_constancy(text(first:next - 1), samples)) then
                call parse_formula("d/dt("//text(begun:first - 2)//")", samples%symbols, left, &
                                   error)
                right = whole(0)
            end if
            if (allocated(error)) then
                call put_unreadable(error, judgement)
                return
            end if
            call drop_root_of_name(side, left, right, samples)
            left = with_squares(left, samples%frequency)
            right = with_squares(right, samples%frequency)
            if (statement%small) then
                call judge_small(left, right, chained, samples, library, explain, judgement)
            else
                call judge_pair(left, right, chained, samples, library, explain, judgement)
                if (judgement%verdict == is_wrong .and. explain) then
                    call add_small(left, right, samples, judgement%remark)
                end if
            end if
            if (judgement%verdict /= is_right .or. next > len(text)) return
            ! of L, V and E = a = b each side may have a constant of its own
            if (.not. is_energy(left, samples)) left = right
            begun = first
            chained = .true.
        end do
    end subroutine judge

    pure subroutine find_empty_side(text, judgement)
        !! `a =`, `= b`, `a == b`, and a line without `=`, perhaps with another sign in its place.
        character(*), intent(in) :: text
        type(judgement_t), intent(inout) :: judgement
        type(error_t), allocatable :: error
        character(:), allocatable :: plain
        integer, allocatable :: columns(:)
        integer :: first, last

        if (index(text, "=") == 0) then
            call plain_formula(text, plain, columns, error)
            judgement%verdict = is_unreadable
            if (allocated(error)) then
                judgement%remark = error%message
            else
                judgement%remark = "column "//to_text(characters(text) + 1)//": no '='; write "// &
                    "'left = right', or '#' in front of a remark"
            end if
            return
        end if

        first = 1
        do
            last = index(text(first:), "=")
            last = merge(len(text) + 1, first + last - 1, last == 0)
            if (text(first:last - 1) == "") exit
            if (last > len(text)) return
            first = last + 1
        end do
        judgement%verdict = is_unreadable
        judgement%remark = "column "//to_text(characters(text(:first - 1)) + 1)// &
            ": one side of '=' is empty; write 'left = right'"
    end subroutine find_empty_side

    subroutine define(name, squared, text, equals, samples, library, judgement)
        !! A name of the student's own, or the square of one; right if it is called like a frequency
        !! or a period and is one.
        character(*), intent(in) :: name, text
        logical, intent(in) :: squared  !! `v^2 = ...`
        integer, intent(in) :: equals   !! place of '='
        type(samples_t), intent(inout) :: samples
        type(library_t), intent(in) :: library(:)
        type(judgement_t), intent(inout) :: judgement
        type(expression_t) :: meaning, truth
        type(judgement_t) :: attempt
        type(error_t), allocatable :: error

        judgement%verdict = is_definition
        call parse_formula(repeat(" ", characters(text(:equals)))//text(equals + 1:), &
                           samples%symbols, meaning, error)
        if (.not. allocated(error)) then
            call define_by_period(meaning, samples)
            if (squared) meaning = apply(f_sqrt, meaning)
            call samples%symbols%define(name, meaning, error)
        end if
        if (allocated(error)) then
            call put_unreadable(error, judgement)
            return
        end if
        call define_rates(name, meaning, samples)
        call find_frequency(name, meaning, samples, truth)
        if (truth%count == 0) return
        attempt%remark = ""
        attempt%example = ""
        call judge_pair(truth, meaning, .true., samples, library, .false., attempt)
        if (attempt%verdict == is_right) judgement = attempt
        if (attempt%verdict /= is_wrong .or. samples%decay > 0 .or. index(name, "_0") > 0) return
        judgement%remark = "taken for a new name: no small oscillation has this "// &
            trim(merge("period   ", "frequency", name(1:1) == "T"))
    end subroutine define

    pure subroutine put_unreadable(error, judgement)
        !! What the reader says.
        type(error_t), intent(in) :: error
        type(judgement_t), intent(inout) :: judgement

        judgement%verdict = is_unreadable
        judgement%remark = error%message
    end subroutine put_unreadable

    subroutine judge_pair(left, right, chained, samples, library, explain, judgement)
        !! One equality.
        type(expression_t), intent(in) :: left, right
        logical, intent(in) :: chained  !! the left side is known to be right
        type(samples_t), intent(in) :: samples
        type(library_t), intent(in) :: library(:)
        logical, intent(in) :: explain
        type(judgement_t), intent(inout) :: judgement
        real(dp), allocatable :: values(:, :)
        logical :: judged, right_one, found

        judgement%residual = left - right
        values = samples%values
        if (speaks_of_place(judgement%residual, samples)) then
            call holds(judgement%residual, samples%values, right_one, judged)
            call put_places(samples, samples%other_equilibrium, values)
            call holds(judgement%residual, values, found, judged)
            if (right_one .or. .not. judged) values = samples%values
        end if
        if (judgement%residual%depends_on(samples%frequency) .or. &
            judgement%residual%depends_on(samples%frequency + 1)) then
            call choose_modes(judgement%residual, samples, values, right_one, found)
            if (.not. right_one) call compare_squares(left, right, samples, right_one, found)
            if (.not. found) then
                judgement%verdict = is_unreadable
                judgement%remark = "no small oscillation about the equilibrium at or near "// &
                    "zero to compare with"
                return
            end if
            judged = .true.
        else
            call holds(judgement%residual, values, right_one, judged)
        end if
        if (is_motion(left, right, samples)) then
            judgement%verdict = is_unreadable
            judgement%remark = "a motion is not graded, only what holds at all times; write "// &
                "its equation, or its frequency"
        else if (is_value(left, right, samples)) then
            judgement%verdict = is_unreadable
            judgement%remark = "graded for any value; a line 'set: "// &
                trim(samples%symbols%names(left%nodes(1)%which))//" = ...' fixes one"
        else if (.not. judged) then
            judgement%verdict = is_unreadable
            judgement%remark = "no number at the states that were tried: a root, a logarithm "// &
                "or a "// &
                               "division fails"
        else if (right_one) then
            judgement%of_motion = .not. is_trivial(judgement%residual, samples)
            if (.not. judgement%of_motion) judgement%remark = "true of any motion"
        else if (is_up_to_constant(left, judgement%residual, samples)) then
            judgement%remark = "but for a constant"
        else if (is_other_lagrangian(left, right, samples)) then
            judgement%remark = "another L of the same motion"
        else
            judgement%verdict = is_wrong
            if (.not. explain) return
            call explain_slip(judgement%residual, merge(left%count + 1, 1, chained), samples, &
                              values, library, judgement%remark)
            call put_example(left, right, samples, values, judgement%example)
            if (index(judgement%remark, "no single") == 1) call explain_squares( &
                left, right, samples, library, judgement%remark)
            if (index(judgement%remark, "no single") == 1 .and. is_energy(left, samples)) then
                call put_same_constant(left, judgement%residual, samples, values)
                call explain_slip(judgement%residual, merge(left%count + 1, 1, chained), samples, &
                                  values, library, judgement%remark)
            end if
        end if
    end subroutine judge_pair

    subroutine add_small(left, right, samples, remark)
        !! Say so if a wrong statement without functions holds for small motions, and not only as
        !! 0 = 0.
        type(expression_t), intent(in) :: left, right
        type(samples_t), intent(in) :: samples
        character(:), allocatable, intent(inout) :: remark
        type(judgement_t) :: small, opposite
        type(library_t) :: none(0)

        if (any(left%nodes(:left%count)%kind == kind_function) .or. &
            any(right%nodes(:right%count)%kind == kind_function)) return
        small%remark = ""
        opposite%remark = ""
        call judge_small(left, right, .false., samples, none, .false., small)
        if (small%verdict /= is_right .or. small%remark /= "") return
        call judge_small(left, -right, .false., samples, none, .false., opposite)
        if (opposite%verdict == is_wrong) remark = remark// &
            "; true of small motions: write 'small:' in front"
    end subroutine add_small

    subroutine compare_squares(left, right, samples, right_one, found)
        !! Of `omega = sqrt(...)` or `T = 2 pi/sqrt(...)`, which has no number for those of the
        !! parameters at which the equilibrium is unstable: \(\omega^2\) is negative there.
        type(expression_t), intent(in) :: left, right
        type(samples_t), intent(in) :: samples
        logical, intent(inout) :: right_one, found  !! become true where the squares agree
        type(expression_t) :: squares
        real(dp), allocatable :: values(:, :)
        logical :: known, yes
        integer :: first

        call subtract_squares(left, right, samples, squares, first)
        if (first == 0) return
        values = samples%values
        call choose_modes(squares, samples, values, yes, known)
        right_one = yes
        found = found .or. yes
    end subroutine compare_squares

    subroutine explain_squares(left, right, samples, library, remark)
        !! Of a wrong `omega = sqrt(...)`: which change makes its square right.
        type(expression_t), intent(in) :: left, right
        type(samples_t), intent(in) :: samples
        type(library_t), intent(in) :: library(:)
        character(:), allocatable, intent(inout) :: remark  !! changes if there is one
        type(expression_t) :: squares
        real(dp), allocatable :: values(:, :)
        character(:), allocatable :: text
        logical :: known, yes
        integer :: first

        if (right%nodes(right%count)%kind /= kind_function) return  ! no root
        call subtract_squares(left, right, samples, squares, first)
        if (first == 0) return
        values = samples%values
        call choose_modes(squares, samples, values, yes, known)
        if (.not. known) return
        call explain_slip(squares, first, samples, values, library, text)
        if (index(text, "no single") /= 1) remark = "squared: "//text
    end subroutine explain_squares

    pure subroutine subtract_squares(left, right, samples, squares, first)
        !! \(\text{left}^2 - \text{right}^2\), where the signs of both are known and it speaks of
        !! \(\omega^2\).
        type(expression_t), intent(in) :: left, right
        type(samples_t), intent(in) :: samples
        type(expression_t), intent(out) :: squares
        integer, intent(out) :: first  !! node of the right square; 0: they are not known
        type(expression_t) :: one, other

        first = 0
        one = square(left, samples%frequency)
        other = square(right, samples%frequency)
        if (one%count == 0 .or. other%count == 0) return
        squares = one - other
        if (squares%depends_on(samples%frequency + 1)) first = one%count + 1
    end subroutine subtract_squares

    subroutine choose_modes(residual, samples, values, right_one, found)
        !! Give omega its values: of that equilibrium, and for each draw of parameters that mode,
        !! for which the statement holds; the first ones where it holds for none.
        type(expression_t), intent(in) :: residual
        type(samples_t), intent(in) :: samples
        real(dp), intent(inout) :: values(:, :)
        logical, intent(out) :: right_one, found
        real(dp), allocatable :: first_choice(:, :)
        logical :: found_one
        integer :: n

        n = size(samples%omega2, 2)/2
        call choose_about(samples%omega2(:, :n), residual, samples, values, right_one, found)
        if (right_one) return
        first_choice = values
        call choose_about(samples%omega2(:, n + 1:), residual, samples, values, right_one, &
                          found_one)
        if (found .and. .not. right_one) values = first_choice
        found = found .or. found_one
    end subroutine choose_modes

    subroutine choose_about(omega2, residual, samples, values, right_one, found)
        !! About one equilibrium; no number for draws without an oscillation. Two draws must match.
        real(dp), intent(in) :: omega2(:, :)  !! (draws, modes)
        type(expression_t), intent(in) :: residual
        type(samples_t), intent(in) :: samples
        real(dp), intent(inout) :: values(:, :)
        logical, intent(out) :: right_one, found
        integer :: draw, first, k, matches
        logical :: yes, judged, needs_root

        needs_root = residual%depends_on(samples%frequency)
        found = .false.
        right_one = .true.
        matches = 0
        do draw = 1, draws
            first = (draw - 1)*states
            associate (rows => values(first + 1:first + states, :))
                rows(:, samples%frequency:samples%frequency + 1) = ieee_value(1.0_dp, &
                                                                              ieee_quiet_nan)
                yes = .false.
                do k = size(omega2, 2), 1, -1
                    if (omega2(draw, k) <= 0.0_dp .and. needs_root) cycle
                    if (abs(omega2(draw, k)) <= 0.0_dp) cycle
                    found = .true.
                    rows(:, samples%frequency) = sqrt(abs(omega2(draw, k)))
                    rows(:, samples%frequency + 1) = omega2(draw, k)
                    call holds(residual, rows, yes, judged)
                    if (yes) exit
                end do
                if (yes) then
                    matches = matches + 1
                else if (needs_root .and. any(omega2(draw, :) < 0.0_dp)) then
                    rows(:, samples%frequency) = ieee_value(1.0_dp, ieee_quiet_nan)
                    ! that mode, perhaps
                else
                    right_one = right_one .and. all(abs(omega2(draw, :)) <= 0.0_dp)
                end if
            end associate
        end do
        right_one = right_one .and. matches >= 2
        found = found .and. any(values(:, samples%frequency) > 0.0_dp)  ! no NaN everywhere
    end subroutine choose_about

    function is_up_to_constant(left, residual, samples) result(yes)
        !! A potential or an energy alone on the left side, which differs by the same number at all
        !! states with the same parameters.
        type(expression_t), intent(in) :: left, residual
        type(samples_t), intent(in) :: samples
        logical :: yes
        real(dp), allocatable :: results(:, :)
        integer :: draw, first, n

        yes = .false.
        n = residual%count
        if (.not. is_energy(left, samples)) return
        allocate (results(size(samples%values, 1), n))
        call evaluate_nodes(residual, samples%values, results)
        do draw = 1, draws
            first = (draw - 1)*states
            associate (r => results(first + 1:first + states, n))
                if (.not. all(ieee_is_finite(r))) return
                if (maxval(r) - minval(r) > 1e-8_dp*(1.0_dp + maxval(abs(r)))) return
            end associate
        end do
        yes = .true.
    end function is_up_to_constant

    function is_other_lagrangian(left, right, samples) result(yes)
        !! L alone on the left side, and on the right one with the same equations of motion.
        type(expression_t), intent(in) :: left, right
        type(samples_t), intent(in) :: samples
        logical :: yes

        yes = left%count == 1 .and. left%nodes(1)%kind == kind_symbol
        if (yes) yes = samples%symbols%names(left%nodes(1)%which) == "L"
        if (yes) yes = same_equations(samples, right)
    end function is_other_lagrangian

end module lagrangia_judgement
