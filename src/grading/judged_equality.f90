module lagrangia_judged_equality
    !! Is this equality right? Both sides are evaluated on the motion, at states and with parameters
    !! at random: any equivalent form is right, whatever it was multiplied by or mixed with.
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, f_exp, kind_function, kind_number, kind_power, &
                                    kind_product, kind_symbol, operator(-)
    use lagrangia_further_slips, only: explain_further
    use lagrangia_kinds, only: dp
    use lagrangia_mode_choice, only: choose_modes, explain_modes, put_mode
    use lagrangia_mode_samples, only: put_places
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_rounded_numbers, only: holds_to_digits, to_digits, true_number
    use lagrangia_same_motion, only: same_equations
    use lagrangia_sample_names, only: samples_t
    use lagrangia_sampled_formula, only: change_sign, change_t, evaluate_nodes
    use lagrangia_slip_search, only: explain_slip, holds, is_trivial
    use lagrangia_small_energies, only: is_constant_of_each_draw, is_energy, put_same_constant
    use lagrangia_small_judgement, only: judge_small
    use lagrangia_squared_statements, only: compare_squares, explain_squares
    use lagrangia_stated_equilibria, only: another_equilibrium, is_equilibrium
    use lagrangia_statement_forms, only: has_velocities, is_about_other, is_branch, is_motion, &
                                         speaks_of_place, value_remark
    use lagrangia_tensions, only: read_as_tension, tensions
    use lagrangia_term_search, only: context, library_t, part_text
    use lagrangia_text, only: quoted, to_text
    use lagrangia_unknown_names, only: hidden
    use lagrangia_verdict, only: but_for_constant, is_right, is_unreadable, is_wrong, &
                                 judgement_t, put_example
    implicit none (type, external)
    private
    public :: judge_forms, put_unreadable

contains

    subroutine judge_forms(left, right, text, chained, small, samples, library, explain, judgement)
        !! One equality; also with T for a string's tension, with rounded numbers, with one sign of
        !! a root, or nearly.
        type(expression_t), intent(in) :: left, right  !! both sides
        character(*), intent(in) :: text    !! both sides, as typed
        logical, intent(in) :: chained      !! the left side is known to be right
        logical, intent(in) :: small        !! a sign says "nearly"
        type(samples_t), intent(in) :: samples             !! on the motion
        type(library_t), intent(in) :: library(:)          !! right terms
        logical, intent(in) :: explain                     !! say what is wrong
        type(judgement_t), intent(inout) :: judgement      !! of it
        type(judgement_t) :: attempt
        type(expression_t) :: one, other
        logical :: either
        integer :: i

        attempt%remark = ""
        attempt%example = ""
        call judge_pair(left, right, chained .or. is_rate(left, right, text), samples, library, &
                        explain .and. .not. small, judgement)
        if (judgement%is_unexplained .and. is_rate(left, right, text)) call judge_pair( &
            left, right, chained, samples, library, explain .and. .not. small, judgement)
        if (judgement%verdict == is_right) return
        do i = 1, tensions(samples)
            call read_as_tension(left, right, samples, i, one, other)
            if (one%count == 0) exit
            attempt%verdict = is_right
            call judge_pair(one, other, chained, samples, library, explain .and. i == 1, attempt)
            either = has_velocities(one - other, samples) .or. other%nodes(1)%kind == kind_number
            if (attempt%verdict == is_right .or. (i == 1 .and. is_nearer( &
                attempt, judgement, either))) judgement = attempt
            if (attempt%verdict == is_right) exit
        end do
        if (judgement%verdict /= is_wrong) return
        if (holds_to_digits(left, right, text, samples)) then
            judgement%remark = to_digits
        else if (holds_elsewhere()) then
            judgement%remark = to_digits
        else if (is_branch(left, right, samples)) then
            judgement%remark = "where the sign of the root is that of the other side"
        else if (small) then
            judgement%remark = ""
            judgement%verdict = is_right
            call judge_small(left, right, chained, samples, library, explain, judgement)
            return
        else
            if (explain) then
                call true_number(left, right, samples, judgement%explanation)
                call judgement%say_why()
                call add_small(left, right, samples, judgement%remark)
            end if
            return
        end if
        judgement%verdict = is_right
        judgement%example = ""
    contains
        logical function holds_elsewhere()
            !! At the other equilibrium?
            type(samples_t) :: there

            holds_elsewhere = speaks_of_place(left - right, samples)
            if (.not. holds_elsewhere) return
            there = samples
            call put_places(samples, samples%other_equilibrium, there%values)
            holds_elsewhere = holds_to_digits(left, right, text, there)
        end function holds_elsewhere
    end subroutine judge_forms

    pure function is_nearer(attempt, judgement, either) result(yes)
        !! Is T rather the force that a string pulls with? Where it may be either, if a narrower
        !! change makes the line right.
        type(judgement_t), intent(in) :: attempt    !! with the force
        type(judgement_t), intent(in) :: judgement  !! with the kinetic energy, not right
        logical, intent(in) :: either               !! velocities, or a number, are in the line
        logical :: yes

        yes = judgement%verdict == is_unreadable
        if (yes .or. attempt%is_unexplained) return
        yes = .not. either
        if (either .and. .not. attempt%explanation%is_empty()) yes = &
            attempt%explanation%width < judgement%explanation%width
    end function is_nearer

    pure function is_rate(left, right, text) result(yes)
        !! A derivative with respect to the time that somebody has written out on the right side,
        !! `d/dt (theta_dot sin(theta)) = ...`: that side is to be mended.
        type(expression_t), intent(in) :: left, right  !! both sides
        character(*), intent(in) :: text               !! as typed
        logical :: yes

        yes = left%count > 1 .and. index(adjustl(text), "d/dt") == 1 .and. &
              any(right%nodes(:right%count)%kind == kind_symbol)
    end function is_rate

    pure subroutine put_unreadable(error, samples, judgement)
        !! What the reader says; a short name that nobody knows may be a constant.
        type(error_t), intent(in) :: error              !! column and remedy
        type(samples_t), intent(in) :: samples          !! know the names
        type(judgement_t), intent(inout) :: judgement   !! gets it
        character(*), parameter :: unknown = "unknown name '", near = "; did you mean '"
        character(:), allocatable :: name
        integer :: first, i, length

        judgement%verdict = is_unreadable
        judgement%remark = error%message
        call drop_same_name(judgement%remark)
        first = index(error%message, unknown) + len(unknown)
        length = index(error%message(first:), "'") - 1
        if (first == len(unknown)) return
        name = error%message(first:first + length - 1)
        if (len(name) > 2 .and. index(name, "_0", back=.true.) == len(name) - 1) then
            name = name(:len(name) - 2)//"_eq"  ! of theta_0
            if (samples%symbols%find(name) > 0) then
                first = index(judgement%remark//near, near)
                judgement%remark = judgement%remark(:first - 1)// &
                                   "; the place of an equilibrium is "//quoted(name)
                return
            end if
        end if
        if (any(samples%declared == name)) then
            judgement%remark = error%message(:first - len(unknown) - 1)//quoted(name)// &
                " is a constant, and no line before says what it has to do with the motion"
            do i = 1, size(samples%energies)
                if (any(samples%energies(i)%names == name)) judgement%remark = &
                    error%message(:first - len(unknown) - 1)//quoted(name)//" is that of line "// &
                    to_text(samples%energies(i)%line)//", which gives it no value: where "// &
                    "E is zero is anybody's choice"
            end do
            return
        end if
        if (length > 3) return
        judgement%remark = judgement%remark//"; if it is a constant, write a line 'constant: "// &
            error%message(first:first + length - 1)//"'"
    end subroutine put_unreadable

    pure subroutine drop_same_name(remark)
        !! A constant that no line has given a value is near itself.
        character(:), allocatable, intent(inout) :: remark
        character(*), parameter :: unknown = "unknown name '", near = "; did you mean '"
        integer :: at, first, length

        first = index(remark, unknown) + len(unknown)
        at = index(remark, near)
        if (first == len(unknown) .or. at == 0) return
        length = index(remark(first:), "'") - 1
        if (index(remark(at + len(near):), remark(first:first + length - 1)//hidden) /= 1) return
        remark = remark(:at - 1)
    end subroutine drop_same_name

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
            if (right_one .and. .not. is_about_other(judgement%residual, samples)) judged = .false.
            if (.not. judged) values = samples%values
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
            if (right_one) then
                if (is_rate_of_nothing(left, right, samples)) then
                    values = off_motion(samples)
                    call holds(judgement%residual, values, right_one, judged)
                end if
            end if
        end if
        if (is_motion(left, right, samples)) then
            judgement%verdict = is_unreadable
            judgement%remark = "a motion is not graded, only what holds at all times; write "// &
                "its equation, or its frequency"
        else if (value_remark(left, right, samples) /= "" .and. .not. right_one) then
            judgement%verdict = is_unreadable
            judgement%remark = value_remark(left, right, samples)
        else if (.not. judged) then
            judgement%verdict = is_unreadable
            judgement%remark = "no number at the states that were tried: "// &
                               why_no_number(judgement%residual, values)
        else if (right_one) then
            judgement%of_motion = .not. is_trivial(judgement%residual, samples)
            if (.not. judgement%of_motion) judgement%remark = "true of any motion"
        else if (is_up_to_constant(left, judgement%residual, samples)) then
            judgement%remark = but_for_constant
        else if (is_equilibrium(left, right, samples)) then
            judgement%remark = another_equilibrium
        else if (is_other_lagrangian(left, right, samples)) then
            judgement%remark = "another L of the same motion"
        else
            judgement%verdict = is_wrong
            if (.not. explain) return
            call explain_it()
        end if
    contains
        subroutine explain_it()
            !! From the narrowest change to the widest.
            integer :: first, mode

            first = merge(left%count + 1, 1, chained)
            associate (residual => judgement%residual, explanation => judgement%explanation)
                call explain_modes(residual, first, samples, values, library, explanation, mode)
                if (explanation%is_empty()) call explain_squares(left, right, samples, library, &
                                                                 explanation, mode)
                if (mode == 0) values = samples%values
                if (mode > 1) call put_mode(samples, mode, values)
                call put_example(left, right, samples, values, judgement%example)
                if (explanation%is_empty() .and. is_energy(left, samples)) then
                    call put_same_constant(left, residual, samples, values)
                    call explain_slip(residual, first, samples, values, library, explanation)
                    if (explanation%is_empty()) call explain_but_constant( &
                        residual, left%count + 1, samples, explanation%text)
                end if
                if (explanation%is_empty() .or. explanation%is_vague) call explain_further( &
                    left, right, samples, values, library, explanation)
            end associate
            call judgement%say_why()
        end subroutine explain_it
    end subroutine judge_pair

    function is_rate_of_nothing(left, right, samples) result(yes)
        !! `d/dt dL/dy_dot = 3 m y_ddot` where nothing pulls along y: the rate of a momentum alone
        !! on the left, which is 0 on the motion, and accelerations on the right. Said is what that
        !! rate is, whatever the acceleration.
        type(expression_t), intent(in) :: left, right  !! both sides, equal on the motion
        type(samples_t), intent(in) :: samples         !! on the motion
        logical :: yes, judged
        integer :: k

        yes = left%count == 1 .and. left%nodes(1)%kind == kind_symbol .and. allocated(samples%mass)
        if (yes) yes = index(samples%symbols%names(left%nodes(1)%which), "d_dt_dL_d") == 1
        if (yes) yes = any([(right%depends_on(samples%first_acceleration + k), &
                             k=0, samples%ndof - 1)])
        if (yes) call holds(left, samples%values, yes, judged)
    end function is_rate_of_nothing

    pure function off_motion(samples) result(values)
        !! The same states with larger accelerations, and the rates of the momenta that go with
        !! them.
        type(samples_t), intent(in) :: samples         !! with the mass matrix
        real(dp), allocatable :: values(:, :)          !! (states, symbols)
        real(dp) :: more(samples%ndof)
        integer :: j, k, row

        values = samples%values
        more = [(1.0_dp + 0.25_dp*k, k=1, samples%ndof)]
        do row = 1, size(values, 1)
            do j = 1, samples%ndof
                k = samples%first_acceleration + j - 1
                values(row, k) = values(row, k) + more(j)
                k = samples%symbols%find("d_dt_dL_d"//trim(samples%symbols%names(1 + j))//"_dot")
                values(row, k) = values(row, k) + dot_product(samples%mass(j, :, row), more)
            end do
        end do
    end function off_motion

    function why_no_number(residual, values) result(reason)
        !! What keeps a statement from having a value.
        type(expression_t), intent(in) :: residual  !! left less right side
        real(dp), intent(in) :: values(:, :)        !! (samples, symbols)
        character(:), allocatable :: reason
        real(dp), dimension(size(values, 1), residual%count) :: results, sizes
        logical :: extreme
        integer :: i

        call evaluate_nodes(residual, values, results, sizes=sizes)
        associate (size_of => sizes(:, residual%count))
            extreme = any(size_of > 0.0_dp .and. size_of*epsilon(size_of) < tiny(size_of))
        end associate
        do i = 1, residual%count
            associate (node => residual%nodes(i))
                if (node%kind == kind_power) extreme = extreme .or. &
                    any(abs(results(:, i)) > huge(results) .and. &
                        is_nonzero(results(:, node%left)))
                if (node%kind == kind_product) extreme = extreme .or. &
                    any(abs(results(:, i)) > huge(results) .and. &
                        abs(results(:, node%left)) <= huge(results) .and. &
                        abs(results(:, node%right)) <= huge(results))
                if (node%kind == kind_function .and. node%which == f_exp) extreme = &
                    extreme .or. any(abs(results(:, i)) > huge(results))
            end associate
        end do
        reason = "a root, a logarithm or a division fails"
        if (extreme) reason = "terms are too large or too small to be compared"
    end function why_no_number

    subroutine explain_but_constant(residual, first, samples, remark)
        !! The sign that makes an energy right but for a constant: of cos(theta) in
        !! m g l (1 + cos(theta)).
        type(expression_t), intent(in) :: residual  !! left less right side
        integer, intent(in) :: first                !! nodes before it are right
        type(samples_t), intent(in) :: samples      !! on the motion
        character(:), allocatable, intent(inout) :: remark
        logical :: is_constant, is_function
        integer :: i, turn

        do turn = 1, 2  ! of a function, or else of the longest part
            do i = residual%count - 1, first, -1
                if (residual%nodes(i)%kind == kind_number) cycle
                is_function = residual%nodes(i)%kind == kind_function
                if (turn == 1 .neqv. is_function) cycle
                is_constant = is_constant_of_each_draw(residual, samples, change_t(change_sign, i))
                if (.not. is_constant) cycle
                remark = "the sign of "//part_text(residual, i, samples)// &
                         context(residual, samples, i)//", but for a constant"
                return
            end do
        end do
    end subroutine explain_but_constant

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
end module lagrangia_judged_equality
