module lagrangia_amplitude_ratios
    !! How the coordinates go together in a normal mode: `A_2/A_1 = sqrt(2)`, or
    !! `(k + k_c - m omega^2) A_1 - k_c A_2 = 0`.
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, operator(-)
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_frequency_squares, only: with_squares
    use lagrangia_kinds, only: dp
    use lagrangia_names, only: name_length
    use lagrangia_number_class, only: all_finite, is_nonzero
    use lagrangia_rounded_numbers, only: holds_at
    use lagrangia_sample_names, only: draws, samples_t, states
    use lagrangia_sampled_formula, only: evaluate_nodes
    use lagrangia_slip_search, only: holds
    use lagrangia_symbols, only: symbols_t
    use lagrangia_unknown_names, only: add_unknown, unknown_names
    use lagrangia_unsymmetric_modes, only: unsymmetric_modes
    use lagrangia_verdict, only: brief, is_right, is_unreadable, is_wrong, judgement_t
    implicit none (type, external)
    private
    public :: judge_amplitudes

    character(*), parameter :: digits = "0123456789"
    real(dp), parameter :: equal = 1e-6_dp  !! relative, of two frequencies that are the same
    real(dp), parameter :: rounding = 1e-12_dp  !! of a frequency that is 0, beside the largest

contains

    subroutine judge_amplitudes(left_text, right_text, text, samples, is_one, judgement)
        !! A statement whose unknown names are amplitudes of two coordinates or more, `A_1` and
        !! `A_2`, or `A_x` and `A_theta`; else `is_one` is false.
        character(*), intent(in) :: left_text, right_text  !! both sides, in their columns
        character(*), intent(in) :: text                   !! both, as typed
        type(samples_t), intent(in) :: samples             !! know the modes
        logical, intent(out) :: is_one                     !! all is said
        type(judgement_t), intent(inout) :: judgement      !! of it
        character(name_length), allocatable :: names(:)
        type(expression_t) :: left, right, residual
        type(symbols_t) :: symbols
        type(error_t), allocatable :: error
        integer, allocatable :: of(:)
        integer :: i
        logical :: known, speaks_of_omega, yes

        is_one = .false.
        call unknown_names(left_text//" + "//right_text, samples%symbols, names)
        if (size(names) < 2 .or. samples%ndof < 2) return
        allocate (of(size(names)))
        do i = 1, size(names)
            of(i) = coordinate_of(trim(names(i)), samples)
            if (of(i) == 0 .or. names(i) (1:1) /= names(1) (1:1)) return
        end do
        if (all(of == of(1))) return
        symbols = samples%symbols
        call add_unknown(names, symbols)
        call parse_formula(left_text, symbols, left, error)
        if (.not. allocated(error)) call parse_formula(right_text, symbols, right, error)
        if (allocated(error)) return
        is_one = .true.
        left = with_squares(left, samples%frequency)
        right = with_squares(right, samples%frequency)
        residual = left - right
        do i = 1, 1 + 3*samples%ndof
            if (residual%depends_on(i)) is_one = .false.
        end do
        if (.not. is_one) return
        if (any(is_nonzero(samples%turning))) then
            judgement%verdict = is_unreadable
            judgement%remark = "amplitudes of modes with drag or gyroscopic forces are not "// &
                               "graded: the coordinates are not in phase"
            return
        end if
        if (any(is_nonzero(samples%stiffness)) .and. .not. all_finite(samples%turning)) then
            judgement%verdict = is_unreadable
            judgement%remark = "amplitudes of modes with constraints are not graded"
            return
        end if
        speaks_of_omega = residual%depends_on(samples%frequency) .or. &
                          residual%depends_on(samples%frequency + 1)
        call compare(samples%stiffness, samples%inertia)
        if (.not. (known .and. yes)) then
            if (all_finite(samples%other_stiffness)) then
                if (.not. known) call compare(samples%other_stiffness, samples%other_inertia)
            end if
        end if
        if (.not. known) then
            judgement%verdict = is_unreadable
            judgement%remark = "no small oscillation whose modes differ in frequency, to "// &
                               "compare with"
            return
        end if
        judgement%verdict = merge(is_right, is_wrong, yes)
        judgement%remark = "of a normal mode"
        if (speaks_of_omega) judgement%remark = "of the normal modes"
        if (yes) return
        judgement%remark = "in no normal mode"
        if (speaks_of_omega) judgement%remark = "not in all normal modes"
        call put_numbers()
    contains
        subroutine compare(stiffness, inertia)
            !! With the modes about one equilibrium: one of them in each draw, or all if omega is
            !! there.
            real(dp), intent(in) :: stiffness(:, :, :), inertia(:, :, :)
            real(dp) :: amplitudes(samples%ndof, samples%ndof), omega2(samples%ndof)
            real(dp), allocatable :: values(:, :)
            logical :: here, judged
            integer :: draw, matching, mode

            known = .true.
            yes = .true.
            do draw = 1, draws
                call solve_modes(stiffness(:, :, draw), inertia(:, :, draw), omega2, amplitudes, &
                                 known)
                if (.not. known) return
                matching = 0
                do mode = 1, samples%ndof
                    if (speaks_of_omega .and. omega2(mode) <= 0.0_dp .and. &
                        residual%depends_on(samples%frequency)) cycle
                    call put_mode(draw, omega2(mode), amplitudes(:, mode), values)
                    call holds(residual, values, here, judged)
                    if (.not. here) here = holds_at(residual, text, values)
                    if (here) matching = matching + 1
                end do
                if (speaks_of_omega) yes = yes .and. matching == samples%ndof
                if (.not. speaks_of_omega) yes = yes .and. matching > 0
            end do
        end subroutine compare

        subroutine put_mode(draw, omega2, amplitudes, values)
            !! Each state with another size of the oscillation.
            integer, intent(in) :: draw
            real(dp), intent(in) :: omega2, amplitudes(:)
            real(dp), allocatable, intent(out) :: values(:, :)
            integer :: j, n, row

            n = size(samples%role)
            allocate (values(states, n + size(names)))
            values(:, :n) = samples%values((draw - 1)*states + 1:draw*states, :)
            values(:, samples%frequency) = sqrt(abs(omega2))
            values(:, samples%frequency + 1) = omega2
            do row = 1, states
                do j = 1, size(names)
                    values(row, n + j) = (0.7_dp + 0.1_dp*row)*amplitudes(of(j))
                end do
            end do
        end subroutine put_mode

        subroutine put_numbers()
            !! Both sides in the modes of the first draw.
            real(dp) :: amplitudes(samples%ndof, samples%ndof), omega2(samples%ndof)
            real(dp), allocatable :: values(:, :), a(:, :), b(:, :)
            logical :: ok
            integer :: mode

            call solve_modes(samples%stiffness(:, :, 1), samples%inertia(:, :, 1), omega2, &
                             amplitudes, ok)
            if (.not. ok) return
            allocate (a(states, left%count), b(states, right%count))
            judgement%example = ""
            do mode = 1, samples%ndof
                call put_mode(1, omega2(mode), amplitudes(:, mode), values)
                call evaluate_nodes(left, values, a)
                call evaluate_nodes(right, values, b)
                if (judgement%example /= "") judgement%example = judgement%example//"; "
                judgement%example = judgement%example//"left "//brief(a(1, left%count))// &
                    ", right "//brief(b(1, right%count))//" at omega^2 = "//brief(omega2(mode))
            end do
        end subroutine put_numbers
    end subroutine judge_amplitudes

    pure function coordinate_of(name, samples) result(which)
        !! 2 of `A_2`, `C2` and `A_theta2`; 0: it is no amplitude.
        character(*), intent(in) :: name
        type(samples_t), intent(in) :: samples
        integer :: which
        character(:), allocatable :: index_text

        which = 0
        if (len(name) < 2 .or. scan(name(1:1), "ABCX") == 0) return
        index_text = name(2:)
        if (index_text(1:1) == "_") index_text = index_text(2:)
        if (index_text == "") return
        if (verify(index_text, digits) == 0 .and. len(index_text) < 4) then
            read (index_text, *) which
            if (which > samples%ndof) which = 0
            return
        end if
        if (name(2:2) /= "_") return
        do which = samples%ndof, 1, -1
            if (samples%symbols%names(1 + which) == samples%symbols%spelling(index_text)) return
        end do
    end function coordinate_of

    subroutine solve_modes(stiffness, inertia, omega2, amplitudes, known)
        !! \(K a = \omega^2 M a\), each mode with a frequency of its own.
        real(dp), intent(in) :: stiffness(:, :), inertia(:, :)
        real(dp), intent(out) :: omega2(:), amplitudes(:, :)
        logical, intent(out) :: known
        integer :: j

        omega2 = 0.0_dp
        amplitudes = 0.0_dp
        known = all_finite(stiffness) .and. all_finite(inertia) .and. &
                any(is_nonzero(stiffness))
        if (.not. known) return
        call unsymmetric_modes(stiffness, inertia, omega2, amplitudes, known)
        where (abs(omega2) <= rounding*maxval(abs(omega2))) omega2 = 0.0_dp
        do j = 2, size(omega2)
            known = known .and. all(abs(omega2(:j - 1) - omega2(j)) > equal*maxval(abs(omega2)))
        end do
    end subroutine solve_modes
end module lagrangia_amplitude_ratios
