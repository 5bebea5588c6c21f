module lagrangia_judged_line
    !! One line of a sheet in one reading: a definition, a motion, an equality or several of them.
    use lagrangia_amplitude_ratios, only: judge_amplitudes
    use lagrangia_characters, only: characters
    use lagrangia_constancy, only: explain_change, read_constancy
    use lagrangia_constants_of_motions, only: holds_on_motion, judge_on_motion
    use lagrangia_declared_constants, only: has_place, with_constants
    use lagrangia_equality_signs, only: read_signs
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, operator(-), whole
    use lagrangia_formula_characters, only: plain_formula, plain_letters
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_free_constants, only: judge_with_constants
    use lagrangia_frequency_squares, only: with_squares
    use lagrangia_homework, only: statement_t
    use lagrangia_initial_conditions, only: with_known_starts, with_short_starts
    use lagrangia_judged_equality, only: judge_forms, put_unreadable
    use lagrangia_motion_statements, only: judge_motion
    use lagrangia_own_names, only: define
    use lagrangia_sample_names, only: samples_t
    use lagrangia_small_energies, only: is_energy
    use lagrangia_small_judgement, only: judge_small
    use lagrangia_solved_constraints, only: solve_constraint
    use lagrangia_statement_forms, only: drop_root_of_name, is_slope, read_as_period, &
                                         read_new_name
    use lagrangia_term_search, only: library_t
    use lagrangia_text, only: to_text
    use lagrangia_verdict, only: is_definition, is_right, is_unreadable, is_wrong, &
                                 judgement_t
    implicit none (type, external)
    private
    public :: judge_line, read_equals

contains

    subroutine judge_line(statement, samples, library, explain, judgement)
        !! One reading of a statement.
        type(statement_t), intent(in) :: statement      !! as typed
        type(samples_t), intent(inout) :: samples       !! gets the names that it defines
        type(library_t), intent(in) :: library(:)       !! right terms, for what is missing
        logical, intent(in) :: explain                  !! say what is wrong
        type(judgement_t), intent(out) :: judgement     !! of it
        type(error_t), allocatable :: error
        type(expression_t) :: left, right
        type(judgement_t) :: nearby
        character(:), allocatable :: name, said, side, side_and, text
        integer :: begun, first, next, last
        logical, allocatable :: nearly(:)
        logical :: chained, constancy, is_one, of_motion, of_value, on_motion, small, squared

        chained = .false.
        small = statement%small
        begun = 1
        judgement%remark = ""
        judgement%example = ""
        call read_signs(statement%text, text, nearly)
        if (statement%small) text(:index(text, ":")) = ""
        text = with_known_starts(with_short_starts(without_full_stop(text)), samples)
        next = index(text, "=")
        call find_empty_side(text, judgement)
        if (judgement%verdict == is_unreadable) return
        side = plain_letters(as_in(text, 1, next - 1))
        call read_new_name(side, samples, name, squared)
        is_one = .false.
        if (index(text(next + 1:), "(0)") > 0 .and. index(text(next + 1:), "=") == 0) then
            ! C = x_dot(0)
            call judge_motion(trim(adjustl(plain_letters(as_in(text, next + 1, len(text))))), &
                              as_in(text, 1, next - 1), text, samples, is_one, judgement)
            if (is_one) return
        end if
        if (name /= "" .and. index(text(next + 1:), "=") == 0) call judge_unknown( &
            .not. (any(samples%declared == name) .or. any(samples%constants == name)))
        if (is_one) return
        if (name /= "") then
            if (index(text(next + 1:), "=") == 0) call judge_usual()
            if (is_one) return
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
        chained = is_slope(side) .or. is_usual(side, samples) .or. begun > 1 .or. &
                  samples%symbols%find_definition(trim(adjustl(side))) > 0
        do
            first = next + 1
            last = index(text(first:), "=")
            next = merge(len(text) + 1, first + last - 1, last == 0)
            ! blanks in front keep the columns of what went before
            call parse_formula(repeat(" ", characters(text(:first - 1)))// &
                               as_in(text, first, next - 1), samples%symbols, right, error)
            small = small .or. (nearly(first - 1) .and. &
                                .not. is_value(as_in(text, first, next - 1)))
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
                said = text(begun:next - 1)
                of_value = nearly(first - 1) .and. .not. small
                if (of_value .and. index(text(first:), ".") == 0) said = trim(said)//"."  ! 24.
                call judge_forms(left, right, said, chained, small, samples, library, explain, &
                                 judgement)
                on_motion = .false.
                of_motion = is_of_small_motion(left - right, samples)
                if ((of_value .or. of_motion) .and. judgement%verdict == is_wrong) then
                    ! cos(theta) ~ 1, or theta_ddot = -omega^2 theta behind theta = A cos(omega t)
                    nearby%verdict = is_right
                    nearby%remark = ""
                    nearby%example = ""
                    if (of_motion) on_motion = holds_on_motion(left - right, samples)
                    if (.not. on_motion) call judge_forms(left, right, said, chained, .true., &
                                       samples, library, explain .and. of_motion, nearby)
                    if (of_motion .and. nearby%verdict == is_wrong .and. &
                        judgement%is_unexplained .and. .not. nearby%is_unexplained) then
                        judgement = nearby
                    else if (nearby%verdict == is_right) then
                        judgement = nearby
                        if (of_motion .and. judgement%remark == "") judgement%remark = &
                            "of small oscillations"
                    else if (of_value) then
                        call ask_for_digits(text(first:next - 1), judgement)
                    end if
                end if
                if (constancy .and. explain .and. judgement%verdict == is_wrong) then
                    call explain_change(text(begun:first - 2), samples, judgement%explanation, &
                                        judgement%remark)
                end if
            end if
            judgement%of_constant = constancy
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
            if (is_one .and. statement%small .and. judgement%verdict == is_wrong) then
                judgement%verdict = is_unreadable
                judgement%remark = "constants of integration are graded of the whole motion "// &
                                   "only, without 'small:'"
            end if
        end subroutine judge_unknown

        subroutine judge_usual()
            !! `v^2 = v_0^2 - 2 g y` is right if v is the speed and v_0 a constant.
            type(samples_t) :: there
            type(judgement_t) :: attempt
            type(error_t), allocatable :: refusal
            integer :: i

            attempt%remark = ""
            attempt%example = ""
            do i = 1, size(samples%usual)
                if (samples%usual(i)%name /= name) cycle
                there = samples
                call there%symbols%define(name, samples%usual(i)%meaning, refusal)
                if (allocated(refusal)) cycle
                call judge_with_constants(as_in(text, 1, next - 1), as_in(text, next + 1, &
                                                         len(text)), there, is_one, attempt)
                is_one = is_one .and. attempt%verdict == is_right
                if (.not. is_one) cycle
                samples = there
                judgement = attempt
                judgement%remark = judgement%remark//", "//name//" as "// &
                                   trim(samples%usual(i)%label)
                return
            end do
        end subroutine judge_usual

        subroutine solve_or_refuse()
            !! A constraint defines the place that it brings in. Names behind `constant:` are known.
            type(expression_t) :: side_there
            type(error_t), allocatable :: there
            integer, allocatable :: signs(:)
            integer :: k

            call read_equals(text, signs)
            do k = 2, merge(size(signs), 1, names_constant(error%message))
                call parse_formula(repeat(" ", characters(text(:signs(k - 1))))// &
                                   as_in(text, signs(k - 1) + 1, signs(k) - 1), &
                                   with_constants(samples), side_there, there)
                if (allocated(there)) exit
            end do
            if (allocated(there)) call move_alloc(there, error)
            call put_unreadable(error, samples, judgement)
            call solve_here()
        end subroutine solve_or_refuse

        logical function names_constant(message)
            !! Does it call a constant unknown?
            character(*), intent(in) :: message
            character(*), parameter :: unknown = "unknown name '"
            integer :: from

            from = index(message, unknown) + len(unknown)
            names_constant = from > len(unknown)
            if (names_constant) names_constant = &
                has_place(samples, message(from:from + index(message(from:), "'") - 2))
        end function names_constant

        subroutine solve_here()
            character(:), allocatable :: formula

            if (statement%small) return
            ! the sides before the last two are right
            call solve_constraint(text(merge(begun, 1, next > len(text)):), samples, name, formula)
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

    pure function is_of_small_motion(residual, samples) result(yes)
        !! Has a line before written out all its motions, of small oscillations?
        type(expression_t), intent(in) :: residual  !! left less right side
        type(samples_t), intent(in) :: samples      !! know the motions
        logical :: yes
        integer :: i, k

        yes = .false.
        do k = 1, samples%ndof
            if (.not. any([(residual%depends_on(1 + k + i*samples%ndof), i=0, 2)])) cycle
            yes = samples%motion(k)%count > 0 .and. .not. samples%exact_motion(k)
            if (.not. yes) return
        end do
    end function is_of_small_motion

    pure function is_usual(side, samples) result(yes)
        !! A name alone that stands for what it mostly means.
        character(*), intent(in) :: side          !! the left one, as typed
        type(samples_t), intent(in) :: samples    !! know the names
        logical :: yes

        yes = any(samples%usual%name == adjustl(side))
    end function is_usual

    pure subroutine ask_for_digits(side, judgement)
        !! One digit is not enough for a comparison.
        character(*), intent(in) :: side                !! a number, as typed
        type(judgement_t), intent(inout) :: judgement   !! wrong
        integer :: i

        if (count([(scan(side(i:i), "0123456789") == 1, i=1, scan(side//"e", "eE") - 1)]) > 1) then
            return
        end if
        judgement%verdict = is_unreadable
        judgement%example = ""
        judgement%remark = "a number that holds nearly has two digits or more"
    end subroutine ask_for_digits

    pure function is_value(side) result(yes)
        !! A number but 0: nearly that is to the digits given, and not of small motions.
        character(*), intent(in) :: side  !! as typed
        logical :: yes
        character(*), parameter :: digits = "123456789"

        yes = scan(side, digits) > 0 .and. verify(side, digits//"0 .+-eE*^") == 0
    end function is_value

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

    pure subroutine read_equals(text, signs)
        !! Places of `=` outside of brackets, between 0 and one behind the end.
        character(*), intent(in) :: text                !! a statement
        integer, allocatable, intent(out) :: signs(:)   !! 0 and one behind the end among them
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
end module lagrangia_judged_line
