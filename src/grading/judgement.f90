module lagrangia_judgement
    !! Is this statement right? Both sides are evaluated on the motion, at states and with
    !! parameters at random: any equivalent form is right, whatever it was multiplied by or mixed
    !! with.
    use lagrangia_characters, only: characters
    use lagrangia_constancy, only: explain_change, read_constancy
    use lagrangia_equality_signs, only: read_signs
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: apply, expression_t, f_sqrt, kind_function, kind_symbol, &
                                    operator(-), whole
    use lagrangia_formula_characters, only: plain_formula, plain_letters
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_frequency_squares, only: with_squares
    use lagrangia_further_slips, only: explain_further
    use lagrangia_homework, only: statement_t
    use lagrangia_kinds, only: dp
    use lagrangia_mode_choice, only: choose_modes
    use lagrangia_motion_samples, only: put_places
    use lagrangia_motion_statements, only: judge_motion, with_short_starts
    use lagrangia_rounded_numbers, only: holds_to_digits, true_number
    use lagrangia_same_motion, only: same_equations
    use lagrangia_sample_names, only: samples_t
    use lagrangia_slip_search, only: explain_slip, holds, is_trivial
    use lagrangia_small_energies, only: is_constant_of_each_draw, is_energy, put_same_constant
    use lagrangia_small_judgement, only: judge_small
    use lagrangia_squared_statements, only: compare_squares, explain_squares
    use lagrangia_statement_forms, only: define_by_period, define_rates, drop_root_of_name, &
                                         find_frequency, &
                                         has_velocities, is_branch, is_motion, is_slope, &
                                         is_value, means_frequency, read_as_period, &
                                         read_as_tension, read_new_name, &
                                         speaks_of_place, tensions
    use lagrangia_term_search, only: library_t
    use lagrangia_text, only: to_text
    use lagrangia_usual_names, only: find_usual
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
        character(:), allocatable :: name, side, side_and, text
        integer :: begun, first, next, last
        logical, allocatable :: nearly(:)
        logical :: chained, constancy, is_one, small, squared

        chained = .false.
        small = statement%small
        begun = 1
        judgement%remark = ""
        judgement%example = ""
        call read_signs(statement%text, text, nearly)
        if (statement%small) text(:index(text, ":")) = ""
        text = with_short_starts(without_full_stop(text))
        next = index(text, "=")
        call find_empty_side(text, judgement)
        if (judgement%verdict == is_unreadable) return
        side = plain_letters(as_in(text, 1, next - 1))
        call read_new_name(side, samples, name, squared)
        if (name /= "" .and. index(text(next + 1:), "=") == 0) then
            call define(name, squared, text, next, statement%used, samples, library, judgement)
            return
        end if
        if (index(text(next + 1:), "=") == 0) then
            call judge_motion(side, repeat(" ", characters(text(:next)))// &
                              as_in(text, next + 1, len(text)), samples, is_one, judgement)
            if (is_one) return
        end if
        call parse_formula(as_in(text, 1, next - 1), samples%symbols, left, error)
        if (allocated(error)) then
            call put_unreadable(error, judgement)
            return
        end if
        chained = is_slope(side)
        do
            first = next + 1
            small = small .or. nearly(next)
            last = index(text(first:), "=")
            next = merge(len(text) + 1, first + last - 1, last == 0)
            ! blanks in front keep the columns of what went before
            call parse_formula(repeat(" ", characters(text(:first - 1)))// &
                               as_in(text, first, next - 1), samples%symbols, right, error)
            if (.not. allocated(error)) call read_as_period(left, right, samples, chained)
            call read_constancy(plain_letters(as_in(text, first, next - 1)), samples, side_and, &
                                constancy)
            if (constancy) then
                call parse_formula("d/dt("//as_in(text, begun, first - 2)//side_and//")", &
                                   samples%symbols, left, error)
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
                call judge_forms(left, right, text(begun:next - 1), chained, small, samples, &
                                 library, explain, judgement)
                if (constancy .and. judgement%verdict == is_wrong) call explain_change( &
                    text(begun:first - 2), samples, judgement%remark)
            end if
            if (judgement%verdict /= is_right .or. next > len(text)) return
            ! of L, V and E = a = b each side may have a constant of its own
            if (.not. is_energy(left, samples)) left = right
            begun = first
            chained = .true.
        end do
    end subroutine judge

    pure function as_in(text, first, last) result(side)
        !! One side of a statement; in LaTeX, `mgl` is a product on both of them.
        character(*), intent(in) :: text
        integer, intent(in) :: first, last
        character(:), allocatable :: side

        side = text(first:last)
        if (index(text, "\") > 0 .and. index(side, "\") == 0) side = side//"\ "
    end function as_in

    pure function without_full_stop(text) result(formula)
        !! What ends a sentence is no part of its formula.
        character(*), intent(in) :: text
        character(:), allocatable :: formula
        integer :: last

        formula = text
        last = len_trim(text)
        if (last < 2) return
        if (scan(text(last:last), ",;.") == 1) formula(last:last) = " "
    end function without_full_stop

    subroutine judge_forms(left, right, text, chained, small, samples, library, explain, judgement)
        !! One equality; also with T for a string's tension, with rounded numbers, with one sign of
        !! a root, or nearly.
        type(expression_t), intent(in) :: left, right
        character(*), intent(in) :: text    !! both sides, as typed
        logical, intent(in) :: chained      !! the left side is known to be right
        logical, intent(in) :: small        !! a sign says "nearly"
        type(samples_t), intent(in) :: samples
        type(library_t), intent(in) :: library(:)
        logical, intent(in) :: explain
        type(judgement_t), intent(inout) :: judgement
        type(judgement_t) :: attempt
        type(expression_t) :: one, other
        integer :: i

        attempt%remark = ""
        attempt%example = ""
        call judge_pair(left, right, chained, samples, library, explain .and. .not. small, &
                        judgement)
        if (judgement%verdict == is_right) return
        do i = 1, tensions(samples)
            call read_as_tension(left, right, samples, i, one, other)
            if (one%count == 0) exit
            attempt%verdict = is_right
            call judge_pair(one, other, chained, samples, library, explain .and. i == 1, attempt)
            if (attempt%verdict == is_right .or. (i == 1 .and. (judgement%verdict == &
                is_unreadable .or. (.not. has_velocities(one - other, samples) .and. &
                                    index(attempt%remark, "no single") /= 1)))) judgement = attempt
            if (attempt%verdict == is_right) exit
        end do
        if (judgement%verdict /= is_wrong) return
        if (holds_to_digits(left, right, text, samples)) then
            judgement%remark = "to the digits given"
        else if (is_branch(left, right, samples)) then
            judgement%remark = "where the sign of the root is that of the other side"
        else if (small) then
            judgement%remark = ""
            judgement%verdict = is_right
            call judge_small(left, right, chained, samples, library, explain, judgement)
            return
        else
            if (explain) then
                call true_number(left, right, samples, judgement%remark)
                call add_small(left, right, samples, judgement%remark)
            end if
            return
        end if
        judgement%verdict = is_right
        judgement%example = ""
    end subroutine judge_forms

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

    subroutine define(name, squared, text, equals, used, samples, library, judgement)
        !! A name of the student's own, or the square of one; right if it is what is mostly called
        !! that. A name that must be a frequency, is none and abbreviates nothing is wrong.
        character(*), intent(in) :: name, text
        logical, intent(in) :: squared  !! `v^2 = ...`
        integer, intent(in) :: equals   !! place of '='
        logical, intent(in) :: used     !! another statement has the name
        type(samples_t), intent(inout) :: samples
        type(library_t), intent(in) :: library(:)
        type(judgement_t), intent(inout) :: judgement
        type(expression_t) :: meaning, truth
        type(judgement_t) :: attempt
        type(error_t), allocatable :: error

        judgement%verdict = is_definition
        call parse_formula(repeat(" ", characters(text(:equals)))// &
                           as_in(text, equals + 1, len(text)), samples%symbols, meaning, error)
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
        call compare_usual(name, meaning, samples, judgement)
        if (judgement%verdict == is_right) return
        call find_frequency(name, meaning, samples, truth)
        if (truth%count == 0) return
        attempt%remark = ""
        attempt%example = ""
        call judge_forms(truth, meaning, text, .true., .false., samples, library, .true., attempt)
        if (attempt%verdict == is_right) judgement = attempt
        if (attempt%verdict /= is_wrong) return
        if (means_frequency(name, samples) .and. (.not. used .or. meaning%count == 1)) then
            judgement = attempt
            if (index(attempt%remark, "no single") == 1) judgement%remark = "no small "// &
                "oscillation has this frequency; see 'lagrangia modes'"
        else if (samples%decay == 0 .and. scan(name, "0") == 0 .and. scan(name, "wt") /= 1) then
            judgement%remark = "taken for a new name: no small oscillation has this "// &
                trim(merge("period   ", "frequency", name(1:1) == "T"))
        end if
    end subroutine define

    subroutine compare_usual(name, meaning, samples, judgement)
        !! A definition of H, v or S is right if it is what is mostly called that.
        character(*), intent(in) :: name
        type(expression_t), intent(in) :: meaning
        type(samples_t), intent(in) :: samples
        type(judgement_t), intent(inout) :: judgement
        character(:), allocatable :: label
        logical :: agrees, known

        call find_usual(name, meaning, samples, known, agrees, label)
        if (.not. known) return
        if (agrees) judgement%verdict = is_right
        judgement%remark = trim(merge("as                          ", &
                                      "taken for a new name: not   ", agrees))//" "//label
    end subroutine compare_usual

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
            if (index(judgement%remark, "no single") == 1 .or. &
                index(judgement%remark, "a term with") == 1) call explain_further( &
                left, right, samples, values, library, judgement%remark)
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

    function is_up_to_constant(left, residual, samples) result(yes)
        !! A potential or an energy alone on the left side, which differs by the same number at all
        !! states with the same parameters.
        type(expression_t), intent(in) :: left, residual
        type(samples_t), intent(in) :: samples
        logical :: yes

        yes = is_energy(left, samples)
        if (yes) yes = is_constant_of_each_draw(residual, samples)
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
