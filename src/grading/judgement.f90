module lagrangia_judgement
    !! Is this statement right? Both sides are evaluated on the motion, at states and with
    !! parameters at random: any equivalent form is right, whatever it was multiplied by or mixed
    !! with.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_constants_of_motions, only: put_on_motion
    use lagrangia_derivative, only: time_derivative
    use lagrangia_equality_signs, only: read_signs
    use lagrangia_expression, only: expression_t, kind_symbol
    use lagrangia_homework, only: statement_t
    use lagrangia_judged_line, only: judge_line, read_equals
    use lagrangia_kinds, only: dp
    use lagrangia_motion_values, only: values_of
    use lagrangia_parameter_choice, only: occurs
    use lagrangia_sample_names, only: role_parameter, samples_t
    use lagrangia_stated_equilibria, only: another_equilibrium, keep_equilibrium, keep_origin, &
                                           put_inverted, put_root, put_stated
    use lagrangia_substitution, only: substituted
    use lagrangia_term_search, only: library_t
    use lagrangia_text, only: to_text
    use lagrangia_verdict, only: but_for_constant, is_consequence, is_definition, is_right, &
                                 is_unreadable, is_wrong, judgement_t
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
        type(samples_t) :: before
        character(:), allocatable :: plain
        integer :: which
        logical, allocatable :: nearly(:)
        logical :: found, total

        partial = statement
        call put_partial(curly//"L/"//curly//"t", partial%text)
        call put_partial("\frac{\partial L}{\partial t}", partial%text)
        call put_partial("\partial L/\partial t", partial%text)
        if (index(partial%text, "/d") + index(partial%text, "\frac") > 0) before = samples
        call judge_line(partial, samples, library, explain, judgement)
        if (judgement%verdict == is_right) then
            if (judgement%remark == another_equilibrium) call keep_equilibrium( &
                judgement%residual, samples)
        end if
        found = judgement%verdict == is_definition .and. .not. statement%small
        if (found .and. allocated(judgement%defines)) then
            which = samples%symbols%find_definition(judgement%defines)
            if (which > 0) call keep_origin(samples%symbols%definitions(which)%meaning, &
                                            .false., samples, found)
        end if
        if (judgement%verdict == is_unreadable) call try_pairs(partial, samples, library, &
                                                               explain, judgement)
        do while (size(samples%kept_lines) < size(samples%kept_constants))
            samples%kept_lines = [samples%kept_lines, statement%line]
        end do
        if (size(samples%energies) > 0) then
            where (samples%energies%line == 0) samples%energies%line = statement%line
        end if
        if (size(samples%starts) > 0) then
            where (samples%starts%line == 0) samples%starts%line = statement%line
        end if
        if (index(partial%text, "/d") + index(partial%text, "\frac") > 0) call try_along_motion( &
            partial, before, samples, library, explain, judgement)
        if (judgement%verdict == is_wrong) call try_fixed_motion(partial, samples, library, &
                                                                 judgement)
        if (judgement%verdict == is_wrong) call try_choice(samples, judgement)
        if (judgement%verdict == is_wrong) call try_positive_constants(partial, samples, library, &
                                                                       judgement)
        if (judgement%verdict == is_wrong) call try_positive(partial, samples, library, judgement)
        if (judgement%verdict == is_wrong) call try_reduced(partial, samples, library, judgement)
        if (judgement%verdict == is_wrong) call try_opposites(partial, samples, library, judgement)
        if (judgement%verdict == is_wrong) call try_stated(partial, samples, library, judgement)
        if (judgement%verdict == is_wrong) then
            call read_signs(partial%text, plain, nearly)
            if (statement%small .or. any(nearly)) call try_elsewhere(partial, samples, library, &
                                                                     judgement)
        end if
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

    subroutine try_stated(statement, samples, library, judgement)
        !! A line before may have said about which equilibrium small oscillations are, or omega.
        type(statement_t), intent(in) :: statement      !! wrong
        type(samples_t), intent(in) :: samples          !! know other equilibria
        type(library_t), intent(in) :: library(:)       !! right terms
        type(judgement_t), intent(inout) :: judgement   !! of it
        type(judgement_t) :: attempt
        type(samples_t) :: there
        character(:), allocatable :: plain
        logical, allocatable :: nearly(:)
        logical :: found

        if (judgement%residual%count == 0) return
        call read_signs(statement%text, plain, nearly)
        if (.not. (statement%small .or. any(nearly) .or. &
                   judgement%residual%depends_on(samples%frequency) .or. &
                   judgement%residual%depends_on(samples%frequency + 1))) return
        there = samples
        call put_stated(there, found)
        if (.not. found) return
        call judge_line(statement, there, library, .false., attempt)
        if (attempt%verdict == is_right) judgement = attempt
    end subroutine try_stated

    subroutine try_elsewhere(statement, samples, library, judgement)
        !! `small: theta_ddot = g/l (theta - pi)` says where; of one without a place that would be
        !! right of the upper equilibrium it is said how to say so.
        type(statement_t), intent(in) :: statement      !! wrong
        type(samples_t), intent(in) :: samples          !! know other equilibria
        type(library_t), intent(in) :: library(:)       !! right terms
        type(judgement_t), intent(inout) :: judgement   !! of it
        type(judgement_t) :: attempt
        type(samples_t) :: there
        logical :: found

        if (judgement%residual%count == 0) return
        there = samples
        call put_root(judgement%residual, there, found)
        if (found) then
            call judge_line(statement, there, library, .true., judgement)
            if (judgement%verdict == is_right) judgement%remark = another_equilibrium
            return
        end if
        there = samples
        call put_inverted(there, found)
        if (.not. found) return
        call judge_line(statement, there, library, .false., attempt)
        if (attempt%verdict == is_right) judgement%remark = judgement%remark//"; near pi it is "// &
            "right: a line '"//trim(samples%symbols%names(2))//"_eq = pi' before says so"
    end subroutine try_elsewhere

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

    subroutine try_along_motion(statement, before, samples, library, explain, judgement)
        !! `v dv/dx = a` differentiates along the motion; `dL/dx` keeps its meaning.
        type(statement_t), intent(in) :: statement      !! as typed
        type(samples_t), intent(in) :: before           !! without the names that it defines
        type(samples_t), intent(inout) :: samples       !! get the names that it defines
        type(library_t), intent(in) :: library(:)       !! right terms
        logical, intent(in) :: explain                  !! say what is wrong
        type(judgement_t), intent(inout) :: judgement   !! of it, as partial derivatives
        type(judgement_t) :: attempt
        type(samples_t) :: other

        if (judgement%verdict /= is_wrong .and. judgement%verdict /= is_unreadable .and. &
            .not. judgement%contradicts) return
        other = before
        other%symbols%along_motion = .true.
        call judge_line(statement, other, library, explain, attempt)
        if (attempt%verdict == is_unreadable) return
        if (judgement%contradicts .and. attempt%verdict /= is_right) return
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

    subroutine try_fixed_motion(statement, samples, library, judgement)
        !! Behind `x = 0.1 cos(20 t)` is `E = 1` about this motion, behind `x = A cos(omega t)` is
        !! `x_dot = -omega x tan(omega t)`; of several coordinates about those that move so.
        type(statement_t), intent(in) :: statement      !! wrong of any motion
        type(samples_t), intent(in) :: samples          !! know the motion
        type(library_t), intent(in) :: library(:)       !! right terms
        type(judgement_t), intent(inout) :: judgement   !! of it
        type(judgement_t) :: attempt
        type(samples_t) :: there
        type(expression_t) :: nothing
        logical :: known(samples%ndof)
        integer :: k

        known = samples%motion%count > 0 .and. samples%exact_motion
        if (.not. (all(known) .or. (any(known) .and. judgement%residual%count > 0))) return
        do k = 2, size(samples%role)
            if (all(known)) exit
            if (.not. judgement%residual%depends_on(k)) cycle
            if (k <= 1 + 3*samples%ndof) then
                if (.not. known(1 + mod(k - 2, samples%ndof))) return
            else if (samples%role(k) /= role_parameter .or. samples%rate(k) > 0) then
                return
            end if
        end do
        call put_on_motion(samples, there)
        call judge_line(statement, there, library, .false., attempt)
        if (attempt%verdict /= is_right .or. attempt%remark == but_for_constant) return
        judgement = attempt
        judgement%residual = nothing  ! the constants are no symbols of the sheet
        judgement%of_motion = .false.
        judgement%remark = "of the motion of the line before"
    end subroutine try_fixed_motion

    subroutine try_choice(samples, judgement)
        !! `C2 = 0` chooses one motion of many.
        type(samples_t), intent(inout) :: samples       !! know the constants and the motions
        type(judgement_t), intent(inout) :: judgement   !! of it
        type(expression_t) :: chosen(1)
        integer :: i, k, place

        associate (residual => judgement%residual)
            if (residual%count == 0) return
            if (any([(residual%depends_on(i) .and. samples%role(i) /= role_parameter, &
                      i=1, size(samples%role))])) return
            do k = 1, size(samples%kept_constants)
                place = samples%kept_constants(k)
                if (residual%nodes(1)%kind /= kind_symbol) return
                if (residual%nodes(1)%which /= place) cycle
                if (residual%nodes(residual%count)%left /= 1) return
                chosen(1) = residual%pruned(residual%nodes(residual%count)%right)
                if (any([(chosen(1)%depends_on(i) .and. (samples%rate(i) > 0 .or. &
                          any(samples%kept_constants == i)), i=1, size(samples%role))])) return
                if (.not. any([(samples%motion(i)%depends_on(place), i=1, samples%ndof)])) return
                do i = 1, samples%ndof
                    samples%motion(i) = substituted(samples%motion(i), [place], chosen)
                end do
                judgement%verdict = is_definition
                judgement%remark = "a choice of one motion of many"
                judgement%example = ""
                return
            end do
        end associate
    end subroutine try_choice

    subroutine try_positive_constants(statement, samples, library, judgement)
        !! `delta = atan(B/A)` is the phase where A is positive.
        type(statement_t), intent(in) :: statement      !! wrong
        type(samples_t), intent(in) :: samples          !! know the constants
        type(library_t), intent(in) :: library(:)       !! right terms
        type(judgement_t), intent(inout) :: judgement   !! of it
        type(samples_t) :: other

        if (size(samples%kept_constants) == 0) return
        other = samples
        call leave_out(any(samples%values(:, samples%kept_constants) < 0.0_dp, 2), other)
        call take_if_right(statement, other, library, "where the constants are positive", judgement)
    end subroutine try_positive_constants

    subroutine leave_out(rows, samples)
        !! States at which nothing is a number.
        logical, intent(in) :: rows(:)              !! (states)
        type(samples_t), intent(inout) :: samples   !! lose these
        integer :: row

        do row = 1, size(rows)
            if (rows(row)) samples%values(row, :) = ieee_value(1.0_dp, ieee_quiet_nan)
        end do
    end subroutine leave_out

    subroutine take_if_right(statement, there, library, remark, judgement)
        !! Another reading, if the line is right in it.
        type(statement_t), intent(in) :: statement      !! wrong
        type(samples_t), intent(inout) :: there         !! what it reads
        type(library_t), intent(in) :: library(:)       !! right terms
        character(*), intent(in) :: remark              !! which reading that is
        type(judgement_t), intent(inout) :: judgement   !! of it
        type(judgement_t) :: attempt

        call judge_line(statement, there, library, .false., attempt)
        if (attempt%verdict /= is_right) return
        judgement = attempt
        if (judgement%remark == "") judgement%remark = remark
    end subroutine take_if_right

    subroutine try_positive(statement, samples, library, judgement)
        !! v may be the velocity where that is positive, `m dv/dt = -k x`, and not the speed.
        type(statement_t), intent(in) :: statement      !! wrong
        type(samples_t), intent(in) :: samples          !! know the speed
        type(library_t), intent(in) :: library(:)       !! right terms
        type(judgement_t), intent(inout) :: judgement   !! of it
        character(*), parameter :: remark = "where v is positive"
        type(samples_t) :: other

        if (samples%ndof /= 1) return
        if (.not. (occurs(statement%text, "v") .or. occurs(statement%text, "dv"))) return
        if (.not. any(samples%usual%name == "v")) return
        other = samples
        call leave_out(samples%values(:, 3) < 0.0_dp, other)
        call take_if_right(statement, other, library, remark, judgement)
        if (judgement%verdict == is_right .or. index(statement%text, "/d") == 0) return
        other%symbols%along_motion = .true.
        call take_if_right(statement, other, library, remark, judgement)
    end subroutine try_positive

    subroutine try_reduced(statement, samples, library, judgement)
        !! The momentum of a rolling disk may be that of L, or what the constraints make of it.
        type(statement_t), intent(in) :: statement      !! wrong
        type(samples_t), intent(in) :: samples          !! know both
        type(library_t), intent(in) :: library(:)       !! right terms
        type(judgement_t), intent(inout) :: judgement   !! of it
        type(judgement_t) :: attempt
        type(samples_t) :: other
        type(expression_t) :: rate
        integer :: i

        if (judgement%residual%count == 0) return
        do i = 1, size(samples%reduced)
            associate (place => samples%reduced(i)%symbol)
                if (.not. (judgement%residual%depends_on(place) .or. &
                           judgement%residual%depends_on(samples%rate(place)))) cycle
                other = samples
                other%values(:, place) = values_of(samples%reduced(i)%formula, samples%values)
                rate = time_derivative(samples%reduced(i)%formula, samples%rate, 1)
                other%values(:, samples%rate(place)) = values_of(rate, samples%values)
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
end module lagrangia_judgement
