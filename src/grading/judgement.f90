module lagrangia_judgement
    !! Is this statement right? Both sides are evaluated on the motion, at states and with
    !! parameters at random: any equivalent form is right, whatever it was multiplied by or mixed
    !! with.
    use lagrangia_amplitude_ratios, only: judge_amplitudes
    use lagrangia_characters, only: characters
    use lagrangia_constancy, only: explain_change, read_constancy
    use lagrangia_constants_of_motions, only: judge_on_motion
    use lagrangia_equality_signs, only: read_signs
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, whole
    use lagrangia_formula_characters, only: plain_formula, plain_letters
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_free_constants, only: judge_with_constants
    use lagrangia_frequency_squares, only: with_squares
    use lagrangia_homework, only: statement_t
    use lagrangia_initial_conditions, only: with_short_starts
    use lagrangia_judged_equality, only: judge_forms, put_unreadable
    use lagrangia_motion_statements, only: judge_motion
    use lagrangia_motion_values, only: values_of
    use lagrangia_own_names, only: define
    use lagrangia_sample_names, only: samples_t
    use lagrangia_small_energies, only: is_energy
    use lagrangia_small_judgement, only: judge_small
    use lagrangia_solved_constraints, only: solve_constraint
    use lagrangia_statement_forms, only: drop_root_of_name, is_slope, read_as_period, read_new_name
    use lagrangia_term_search, only: library_t
    use lagrangia_text, only: to_text
    use lagrangia_verdict, only: is_consequence, is_definition, is_right, is_unreadable, is_wrong, &
                                 judgement_t
    implicit none (type, external)
    private
    public :: judgement_t
    public :: judge
    public :: is_right, is_definition, is_wrong, is_unreadable, is_consequence

    character(*), parameter :: curly = char(226)//char(136)//char(130)  !! for "partial"

contains

    subroutine judge(statement, samples, library, explain, judgement)
        !! One line, `a = b` or `a = b = c`; a new name on the left is defined by it.
        type(statement_t), intent(in) :: statement      !! as typed
        type(samples_t), intent(inout) :: samples       !! gets the names that it defines
        type(library_t), intent(in) :: library(:)       !! right terms, for what is missing
        logical, intent(in) :: explain                  !! say what is wrong
        type(judgement_t), intent(out) :: judgement     !! of it
        type(statement_t) :: partial
        type(judgement_t) :: attempt
        logical :: total

        partial = statement
        call put_partial(curly//"L/"//curly//"t", partial%text)
        call put_partial("\frac{\partial L}{\partial t}", partial%text)
        call put_partial("\partial L/\partial t", partial%text)
        call judge_line(partial, samples, library, explain, judgement)
        if (judgement%verdict == is_unreadable) call try_pairs(partial, samples, library, &
                                                               explain, judgement)
        do while (size(samples%kept_lines) < size(samples%kept_constants))
            samples%kept_lines = [samples%kept_lines, statement%line]
        end do
        if (judgement%verdict == is_wrong) call try_reduced(partial, samples, library, judgement)
        if (judgement%verdict == is_wrong) call try_opposites(partial, samples, library, judgement)
        if (index(partial%text, "/d") + index(partial%text, "\frac") > 0) call try_along_motion( &
            partial, samples, library, explain, judgement)
        if (judgement%verdict /= is_wrong .or. .not. explain) return
        call say_constants(samples, judgement)
        ! dL/dt may be meant at rest, too
        total = index(partial%text//" ", "dL/dt ") > 0
        if (.not. total) return
        partial%text = partial%text//" "
        call put_partial("dL/dt ", partial%text)
        call judge_line(partial, samples, library, .false., attempt)
        if (attempt%verdict == is_right) judgement = attempt
    end subroutine judge

    subroutine try_pairs(statement, samples, library, explain, judgement)
        !! `E = k A^2/2 = m omega^2 A^2/2` with constants: each side is compared with the next one.
        type(statement_t), intent(in) :: statement      !! unreadable as a whole
        type(samples_t), intent(inout) :: samples       !! know the constants
        type(library_t), intent(in) :: library(:)       !! right terms
        logical, intent(in) :: explain                  !! say what is wrong
        type(judgement_t), intent(inout) :: judgement   !! of it
        type(judgement_t) :: attempt
        type(samples_t) :: after
        type(statement_t) :: pair
        integer, allocatable :: signs(:)
        integer :: i

        call read_equals(statement%text, signs)
        if (size(signs) < 3 .or. statement%small) return
        if (size(samples%declared) + size(samples%constants) == 0) return
        after = samples
        pair = statement
        do i = 2, size(signs) - 1
            pair%text = statement%text(signs(i - 1) + 1:signs(i + 1) - 1)
            call judge_line(pair, after, library, explain, attempt)
            if (attempt%verdict == is_unreadable) return
            if (attempt%verdict == is_wrong) exit
        end do
        samples = after
        judgement = attempt
    end subroutine try_pairs

    pure subroutine read_equals(text, signs)
        !! Places of `=` outside of brackets, between 0 and one behind the end.
        character(*), intent(in) :: text
        integer, allocatable, intent(out) :: signs(:)
        integer :: depth, i

        signs = [0]
        depth = 0
        do i = 1, len(text)
            if (scan(text(i:i), "({") == 1) depth = depth + 1
            if (scan(text(i:i), ")}") == 1) depth = depth - 1
            if (text(i:i) == "=" .and. depth == 0) signs = [signs, i]
        end do
        signs = [signs, len(text) + 1]
    end subroutine read_equals

    subroutine say_constants(samples, judgement)
        !! Which line says what a constant is.
        type(samples_t), intent(in) :: samples          !! know the constants
        type(judgement_t), intent(inout) :: judgement   !! wrong
        integer :: i

        if (judgement%residual%count == 0) return
        do i = 1, size(samples%kept_lines)
            associate (place => samples%kept_constants(i))
                if (.not. judgement%residual%depends_on(place)) cycle
                judgement%remark = judgement%remark//"; "//trim(samples%symbols%names(place))// &
                                   " is that of line "//to_text(samples%kept_lines(i))
            end associate
        end do
    end subroutine say_constants

    subroutine try_along_motion(statement, samples, library, explain, judgement)
        !! `v dv/dx = a` differentiates along the motion; `dL/dx` keeps its meaning.
        type(statement_t), intent(in) :: statement      !! as typed
        type(samples_t), intent(inout) :: samples       !! get the names that it defines
        type(library_t), intent(in) :: library(:)       !! right terms
        logical, intent(in) :: explain                  !! say what is wrong
        type(judgement_t), intent(inout) :: judgement   !! of it, as partial derivatives
        type(judgement_t) :: attempt
        type(samples_t) :: other

        if (judgement%verdict /= is_wrong .and. judgement%verdict /= is_unreadable) return
        other = samples
        other%symbols%along_motion = .true.
        call judge_line(statement, other, library, explain, attempt)
        if (attempt%verdict == is_unreadable) return
        if (attempt%verdict == is_wrong) then
            if (judgement%verdict == is_wrong .and. attempt%is_unexplained) return
            judgement = attempt
            return
        end if
        other%symbols%along_motion = .false.
        samples = other
        judgement = attempt
        if (judgement%remark == "") judgement%remark = "as a derivative along the motion"
    end subroutine try_along_motion

    subroutine try_reduced(statement, samples, library, judgement)
        !! The momentum of a rolling disk may be that of L, or what the constraints make of it.
        type(statement_t), intent(in) :: statement      !! wrong
        type(samples_t), intent(in) :: samples          !! know both
        type(library_t), intent(in) :: library(:)       !! right terms
        type(judgement_t), intent(inout) :: judgement   !! of it
        type(judgement_t) :: attempt
        type(samples_t) :: other
        integer :: i

        if (judgement%residual%count == 0) return
        do i = 1, size(samples%reduced)
            associate (place => samples%reduced(i)%symbol)
                if (.not. judgement%residual%depends_on(place)) cycle
                other = samples
                other%values(:, place) = values_of(samples%reduced(i)%formula, samples%values)
                call judge_line(statement, other, library, .false., attempt)
                if (attempt%verdict /= is_right) cycle
                attempt%remark = trim(samples%symbols%names(place))//" as 'lagrangia describe' "// &
                                 "has it, with the constraints"
            end associate
            judgement = attempt
            return
        end do
    end subroutine try_reduced

    subroutine try_opposites(statement, samples, library, judgement)
        !! A constant whose opposite makes the line true that speaks of it first may be that one.
        type(statement_t), intent(in) :: statement      !! wrong
        type(samples_t), intent(in) :: samples          !! know the constants
        type(library_t), intent(in) :: library(:)       !! right terms
        type(judgement_t), intent(inout) :: judgement   !! of it
        type(judgement_t) :: attempt
        type(samples_t) :: other
        integer :: i

        if (.not. any(samples%two_signs) .or. judgement%residual%count == 0) return
        do i = 1, size(samples%two_signs)
            if (.not. samples%two_signs(i)) cycle
            associate (place => samples%kept_constants(i))
                if (.not. judgement%residual%depends_on(place)) cycle
                other = samples
                other%values(:, place) = -other%values(:, place)
            end associate
            call judge_line(statement, other, library, .false., attempt)
            if (attempt%verdict /= is_right) cycle
            judgement = attempt
            return
        end do
    end subroutine try_opposites

    pure subroutine put_partial(written, text)
        !! The name of the derivative of L by the time alone.
        character(*), intent(in) :: written                !! for it
        character(:), allocatable, intent(inout) :: text   !! a statement
        integer :: at

        at = index(text, written)
        if (at > 0) text = text(:at - 1)//"dL_dt "//text(at + len(written):)
    end subroutine put_partial

    subroutine judge_line(statement, samples, library, explain, judgement)
        !! One reading of a statement.
        type(statement_t), intent(in) :: statement
        type(samples_t), intent(inout) :: samples
        type(library_t), intent(in) :: library(:)
        logical, intent(in) :: explain
        type(judgement_t), intent(out) :: judgement
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
        is_one = .false.
        if (name /= "" .and. index(text(next + 1:), "=") == 0) call judge_unknown( &
            .not. (any(samples%declared == name) .or. any(samples%constants == name)))
        if (is_one) return
        if (name /= "") then
            call define_here()
            if (next == 0) return
        else if (index(text(next + 1:), "=") == 0) then
            call judge_motion(side, repeat(" ", characters(text(:next)))// &
                              as_in(text, next + 1, len(text)), text, samples, is_one, judgement)
            if (is_one) return
            call judge_unknown(.false.)
            if (is_one) return
        end if
        call parse_formula(repeat(" ", characters(text(:begun - 1)))// &
                           as_in(text, begun, next - 1), samples%symbols, left, error)
        if (allocated(error)) then
            call solve_or_refuse()
            return
        end if
        chained = is_slope(side) .or. begun > 1
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
                call solve_or_refuse()
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
                if (constancy .and. explain .and. judgement%verdict == is_wrong) then
                    call explain_change(text(begun:first - 2), samples, judgement%explanation, &
                                        judgement%remark)
                end if
            end if
            if (judgement%verdict /= is_right) return
            if (next > len(text)) then
                if (judgement%contradicts) judgement%verdict = is_definition
                return
            end if
            ! of L, V and E = a = b each side may have a constant of its own
            if (.not. is_energy(left, samples)) left = right
            begun = first
            chained = .true.
        end do
    contains
        subroutine judge_unknown(only_amplitudes)
            !! Names that nobody knows may be amplitudes of a mode, or constants of integration.
            logical, intent(in) :: only_amplitudes
            character(:), allocatable :: one, other

            one = as_in(text, 1, next - 1)
            other = repeat(" ", characters(text(:next)))//as_in(text, next + 1, len(text))
            call judge_amplitudes(one, other, text, samples, is_one, judgement)
            if (is_one .or. only_amplitudes) return
            call judge_on_motion(one, other, samples, library, explain, name /= "", is_one, &
                                 judgement)
            if (is_one) return
            call judge_with_constants(one, other, samples, is_one, judgement)
        end subroutine judge_unknown

        subroutine solve_or_refuse()
            !! A constraint defines the place that it brings in.
            call put_unreadable(error, judgement)
            call solve_here()
        end subroutine solve_or_refuse

        subroutine solve_here()
            character(:), allocatable :: formula

            if (statement%small) return
            call solve_constraint(text, samples, name, formula)
            if (name == "") return
            judgement%remark = ""
            call define(name, .false., formula, text, statement%used, samples, library, judgement)
        end subroutine solve_here

        subroutine define_here()
            !! By the second of all sides; `next` is 0 if that is all, or else the sign behind it.
            integer :: sign

            sign = next
            next = index(text(sign + 1:), "=")
            if (next > 0) next = sign + next
            last = merge(len(text), next - 1, next == 0)
            call define(name, squared, repeat(" ", characters(text(:sign)))// &
                        as_in(text, sign + 1, last), text(:last), statement%used, samples, &
                        library, judgement)
            if (judgement%verdict == is_unreadable) call solve_here()
            if (judgement%verdict == is_unreadable .or. judgement%verdict == is_wrong) next = 0
            begun = sign + 1
            if (next > 0) judgement%verdict = is_right
        end subroutine define_here
    end subroutine judge_line

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

end module lagrangia_judgement
