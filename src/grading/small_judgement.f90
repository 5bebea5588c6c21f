module lagrangia_small_judgement
    !! Is a statement about small oscillations right? Equations hold to first order, L and the
    !! energies to second.
    use lagrangia_explanation, only: explanation_t
    use lagrangia_expression, only: expression_t, operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_mode_samples, only: put_places
    use lagrangia_number_class, only: is_nonzero, is_zero
    use lagrangia_order_of_approximation, only: is_linear, is_negligible, order_that_fails
    use lagrangia_sample_names, only: role_acceleration, role_known, role_parameter, &
                                      role_time, samples_t, states
    use lagrangia_simple_numbers, only: number_text
    use lagrangia_slip_search, only: explain_slip, holds
    use lagrangia_small_driven_motion, only: is_driven, judge_driven
    use lagrangia_small_energies, only: agreement_t, compare_energies, is_energy, put_same_constant
    use lagrangia_small_motion, only: linear_states, small_motion
    use lagrangia_solved_accelerations, only: has_accelerations
    use lagrangia_statement_forms, only: is_about_other, speaks_of_place
    use lagrangia_term_search, only: library_t
    use lagrangia_verdict, only: but_for_constant, is_unreadable, is_wrong, judgement_t, &
                                 put_example
    use lagrangia_written_out, only: energy_places, in_coordinates, written_out
    implicit none (type, external)
    private
    public :: judge_small

contains

    subroutine judge_small(as_typed, other_side, chained, samples, library, explain, judgement)
        !! One equality, to first order; of an approximation to the order that it writes.
        type(expression_t), intent(in) :: as_typed, other_side  !! both sides
        logical, intent(in) :: chained                   !! the left side is known to be right
        type(samples_t), intent(in) :: samples           !! with the linearised motion
        type(library_t), intent(in) :: library(:)        !! right terms, for what is missing
        logical, intent(in) :: explain                   !! say what is wrong
        type(judgement_t), intent(inout) :: judgement    !! of it
        type(expression_t) :: left, right
        type(explanation_t) :: of_first
        real(dp), allocatable :: values(:, :), shown(:, :)
        logical :: about_first, about_other, given, judged, only_other, right_one
        integer :: first, k

        left = written_out(as_typed, samples)
        right = written_out(other_side, samples)
        judgement%residual = left - right
        if (is_of_quantity(judgement%residual, samples)) then
            left = in_coordinates(left, samples)
            right = in_coordinates(right, samples)
            judgement%residual = left - right
        end if
        given = as_typed%count == 1 .and. left%count > 1  ! p_theta, say
        first = merge(left%count + 1, 1, chained .or. given)
        if (any([(judgement%residual%depends_on(k), k=1, size(samples%role))] .and. &
                [(any(energy_places(samples) == k), k=1, size(samples%role))])) then
            call judge_energies(left, right, first, samples, library, explain, judgement)
            return
        end if
        if (is_driven(judgement%residual, samples)) then
            call judge_driven(left, right, first, samples, library, explain, judgement)
            return
        end if
        call compare(.true., .false.)
        call find_rest(.true., about_other)
        call find_rest(.false., about_first)
        about_other = judged .and. (speaks_of_place(judgement%residual, samples) .or. &
                                    (about_other .and. .not. about_first))
        only_other = is_about_other(judgement%residual, samples)
        if (.not. (right_one .or. only_other)) call compare(.false., .false.)
        if (right_one) then
            call judge_order(left, right, samples, given, .false., .false., shown, explain, &
                             judgement)
            return
        end if
        if (judgement%remark == "") then
            if (is_negligible(judgement%residual, samples, shown)) return
        end if
        call compare(.true., .true.)
        if (.not. (right_one .or. only_other)) call compare(.false., .true.)
        if (right_one) then
            judgement%remark = "if the coordinates are counted from the equilibrium"
            call judge_order(left, right, samples, given, .false., .true., shown, explain, &
                             judgement)
            return
        end if
        call compare(about_other, .false.)
        if (judgement%remark == "" .and. .not. judged) judgement%remark = "no number at rest: "// &
            "a root, a logarithm or a division fails"
        if (.not. judged) then
            judgement%verdict = is_unreadable
        else if (.not. right_one) then
            judgement%verdict = is_wrong
            if (.not. explain) return
            call explain_it(judgement%explanation)
            call put_example(left, right, samples, shown, judgement%example)
            if (about_other .and. any(is_nonzero(samples%equilibrium))) then
                call compare(.false., .false.)
                if (judged) call explain_it(of_first)
                if (judged .and. .not. of_first%is_empty() .and. &
                    of_first%width < judgement%explanation%width) then
                    judgement%explanation = of_first
                    call put_example(left, right, samples, shown, judgement%example)
                end if
                judgement%remark = ""
            end if
            call judgement%say_why()
        end if
    contains
        subroutine explain_it(explanation)
            !! A change that makes it linear is better than one that makes a term negligible.
            type(explanation_t), intent(out) :: explanation

            if (.not. given) call explain_slip(judgement%residual, first, samples, shown, &
                                               library, explanation)
            if (explanation%is_empty()) call explain_slip(judgement%residual, first, samples, &
                                                          values, library, explanation)
        end subroutine explain_it

        subroutine compare(other, counted_from_it)
            !! With the motion about one equilibrium.
            logical, intent(in) :: other, counted_from_it

            right_one = .false.
            judged = .false.
            call small_motion(judgement%residual, samples, other, counted_from_it, values, shown, &
                              judgement%remark)
            if (judgement%remark == "") call holds(judgement%residual, values, right_one, judged)
            if (right_one) right_one = .not. is_linear(judgement%residual, samples, &
                                                       counted_from_it, shown)
        end subroutine compare

        subroutine find_rest(other, yes)
            !! Does it hold at rest, at one equilibrium?
            logical, intent(in) :: other
            logical, intent(out) :: yes
            real(dp) :: rest(size(samples%values, 1), size(samples%role))
            logical :: any_number

            rest = samples%values
            where (spread(samples%role > role_time .and. samples%role <= role_acceleration, 1, &
                          size(rest, 1))) rest = 0.0_dp
            if (other) call put_places(samples, samples%other_equilibrium, rest)
            rest(:, 2:1 + samples%ndof) = rest(:, samples%place)
            call holds(judgement%residual, rest, yes, any_number)
        end subroutine find_rest
    end subroutine judge_small

    subroutine judge_order(left, right, samples, given, of_energies, counted_from_it, shown, &
                           explain, judgement)
        !! It is right to first order, L and energies to second; does it hold to the order that it
        !! writes?
        type(expression_t), intent(in) :: left, right   !! written out
        type(samples_t), intent(in) :: samples
        logical, intent(in) :: given                    !! a momentum is on the left side
        logical, intent(in) :: of_energies
        logical, intent(in) :: counted_from_it          !! coordinates, from the equilibrium
        real(dp), intent(in) :: shown(:, :)             !! states of any amplitude
        logical, intent(in) :: explain
        type(judgement_t), intent(inout) :: judgement
        real(dp) :: order

        order = order_that_fails(left, right, samples, given, of_energies, counted_from_it, shown)
        if (is_zero(order)) return
        judgement%verdict = is_wrong
        if (.not. explain) return
        judgement%remark = "terms of order "//number_text(order)//" are written, to which it "// &
            "does not hold; it does to "//trim(merge("second", "first ", of_energies))//" order"
        if (.not. of_energies) call put_example(left, right, samples, shown, judgement%example)
    end subroutine judge_order

    pure function is_of_quantity(residual, samples) result(yes)
        !! `tension = m g`: of a quantity that has a formula, and else of constants only.
        type(expression_t), intent(in) :: residual   !! left less right side
        type(samples_t), intent(in) :: samples       !! know the formulas
        logical :: yes
        integer :: k

        yes = .false.
        do k = 1, size(samples%role)
            if (.not. residual%depends_on(k) .or. samples%role(k) == role_parameter) cycle
            yes = samples%role(k) == role_known .and. any(samples%compiled%symbol == k) .and. &
                  .not. any(energy_places(samples) == k)
            if (.not. yes) return
        end do
    end function is_of_quantity

    subroutine judge_energies(left, right, first, samples, library, explain, judgement)
        !! L, T, V or E, to second order.
        type(expression_t), intent(in) :: left, right   !! written out
        integer, intent(in) :: first                    !! nodes before it are right
        type(samples_t), intent(in) :: samples
        type(library_t), intent(in) :: library(:)
        logical, intent(in) :: explain
        type(judgement_t), intent(inout) :: judgement
        type(agreement_t) :: agreement
        real(dp), allocatable :: shown(:, :)
        logical :: about_other
        integer :: k

        do k = merge(1, 0, is_about_other(judgement%residual, samples)), 1
            call compare(k == 1, .false.)
            if (agreement%yes .or. agreement%same_motion) exit
        end do
        if (agreement%yes .or. agreement%same_motion) then
            if (agreement%but_constant) judgement%remark = but_for_constant
            if (.not. agreement%yes) judgement%remark = "another L of the same motion"
            if (agreement%yes) call judge_order(left, right, samples, .false., .true., .false., &
                                                shown, explain, judgement)
            return
        end if
        do k = merge(1, 0, is_about_other(judgement%residual, samples)), 1
            call compare(k == 1, .true.)
            if (.not. agreement%yes .and. .not. agreement%same_motion) cycle
            judgement%remark = "if the coordinates are counted from the equilibrium"
            if (.not. agreement%yes) judgement%remark = "another L of the same motion, "// &
                judgement%remark
            if (agreement%yes) call judge_order(left, right, samples, .false., .true., .true., &
                                                shown, explain, judgement)
            return
        end do
        about_other = speaks_of_place(judgement%residual, samples)
        if (about_other) call compare(.true., .false.)
        about_other = about_other .and. agreement%judged
        if (.not. about_other) call compare(.false., .false.)
        if (.not. agreement%judged) then
            judgement%verdict = is_unreadable
            if (judgement%remark == "") judgement%remark = "no number at rest: "// &
                "a root, a logarithm or a division fails"
            return
        end if
        judgement%verdict = is_wrong
        if (.not. explain) return
        call put_example(left, right, samples, shown, judgement%example)
        associate (explanation => judgement%explanation)
            call explain_slip(judgement%residual, first, samples, shown, &
                              without_accelerations(library, samples), explanation)
            if (explanation%is_empty()) then
                call compare(about_other, .true.)
                if (agreement%judged) call explain_slip(judgement%residual, first, samples, &
                    shown, without_accelerations(library, samples), explanation)
                if (.not. explanation%is_empty()) explanation%text = explanation%text// &
                    ", if the coordinates are counted from the equilibrium"
            end if
            if (explanation%is_empty() .and. .not. about_other) then
                call compare(.true., .false.)
                if (agreement%judged) call explain_slip(judgement%residual, first, samples, &
                    shown, without_accelerations(library, samples), explanation)
            end if
            if (explanation%is_empty()) then
                shown = samples%values
                if (is_energy(left, samples)) call put_same_constant(left, judgement%residual, &
                                                                     samples, shown)
                call explain_slip(judgement%residual, first, samples, shown, library, explanation)
            end if
        end associate
        call judgement%say_why()
    contains
        subroutine compare(other, counted_from_it)
            !! Near one equilibrium.
            logical, intent(in) :: other, counted_from_it
            type(agreement_t) :: none

            agreement = none
            call linear_states(judgement%residual, samples, other, .true., shown, &
                               judgement%remark)
            if (judgement%remark /= "") return
            associate (at => shown(::states, samples%place))
                if (.not. counted_from_it) shown(:, 2:1 + samples%ndof) = &
                    shown(:, 2:1 + samples%ndof) + shown(:, samples%place)
                call compare_energies(left, judgement%residual, samples, transpose(at), &
                                      counted_from_it, shown, agreement)
            end associate
        end subroutine compare
    end subroutine judge_energies

    function without_accelerations(library, samples) result(terms)
        !! Those that L or an energy may have.
        type(library_t), intent(in) :: library(:)
        type(samples_t), intent(in) :: samples
        type(library_t), allocatable :: terms(:)
        integer :: i, n

        n = 0
        allocate (terms(size(library)))
        do i = 1, size(library)
            if (has_accelerations(library(i)%term, samples)) cycle
            n = n + 1
            terms(n)%term = library(i)%term
        end do
        terms = terms(:n)
    end function without_accelerations
end module lagrangia_small_judgement
