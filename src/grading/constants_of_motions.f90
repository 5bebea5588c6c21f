module lagrangia_constants_of_motions
    !! Statements with the constants of a motion that a line before writes out: `E = k A^2/2` behind
    !! `x = A cos(omega t + phi)`. They are judged on that motion.
    use lagrangia_declared_constants, only: place_of_constant
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, operator(-), symbol
    use lagrangia_followed_letters, only: follow_letters, is_rounding
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_judged_equality, only: judge_forms
    use lagrangia_kinds, only: dp
    use lagrangia_mode_choice, only: choose_modes
    use lagrangia_motion_values, only: draw_values, rate_of, values_of
    use lagrangia_names, only: name_length
    use lagrangia_sample_names, only: role_known, role_parameter, samples_t
    use lagrangia_slip_search, only: holds
    use lagrangia_substitution, only: substituted
    use lagrangia_term_search, only: library_t
    use lagrangia_unknown_names, only: unknown_names
    use lagrangia_verdict, only: is_unreadable, judgement_t
    use lagrangia_written_out, only: energy_formulas, energy_places, in_coordinates
    implicit none (type, external)
    private
    public :: holds_on_motion, judge_on_motion, put_on_motion

contains

    subroutine judge_on_motion(left_text, right_text, samples, library, explain, names_one, &
                               is_one, judgement)
        !! A statement whose unknown names are constants of motions that were right; else `is_one`
        !! is false. What only names a constant, `A = 0.1`, says nothing of the motion.
        character(*), intent(in) :: left_text, right_text  !! both sides, in their columns
        type(samples_t), intent(in) :: samples             !! know the motions
        type(library_t), intent(in) :: library(:)          !! right terms
        logical, intent(in) :: explain                     !! say what is wrong
        logical, intent(in) :: names_one                   !! the left side is a name of no meaning
        logical, intent(out) :: is_one                     !! all is said
        type(judgement_t), intent(inout) :: judgement      !! of it
        character(name_length), allocatable :: names(:)
        type(samples_t) :: there
        type(expression_t) :: left, nothing, right, residual
        type(error_t), allocatable :: error
        integer :: i, k, n
        logical :: its_own, nearly

        is_one = .false.
        call unknown_names(left_text//" + "//right_text, samples%symbols, names)
        if (size(names) == 0 .or. .not. any(samples%motion%count > 0)) return
        if (.not. all([(any(samples%constants == names(i)), i=1, size(names))])) return
        n = samples%ndof
        its_own = .false.
        do i = 1, size(samples%constants)
            if (.not. any(names == samples%constants(i))) cycle
            its_own = its_own .or. any([(samples%motion(k)%depends_on(size(samples%role) + i), &
                                         k=1, n)])
        end do
        if (.not. its_own) return
        call put_on_motion(samples, there)
        call parse_formula(left_text, there%symbols, left, error)
        if (.not. allocated(error)) call parse_formula(right_text, there%symbols, right, error)
        if (allocated(error)) return
        left = in_coordinates(left, there)
        right = in_coordinates(right, there)
        residual = left - right
        nearly = .false.
        do k = 1, n
            if (.not. any([(residual%depends_on(1 + k + i*n), i=0, 2)])) cycle
            if (samples%motion(k)%count == 0) return
            is_one = .true.
            nearly = nearly .or. .not. samples%exact_motion(k)
        end do
        ! where the masses are is not known there
        do i = 1, size(samples%role)
            if (samples%role(i) /= role_known .or. any(samples%place == i)) cycle
            if (samples%decay > 0 .and. any(i == samples%decay + [0, 1])) cycle
            if (.not. residual%depends_on(i)) cycle
            is_one = .false.
            return
        end do
        is_one = is_one .or. .not. names_one
        if (.not. is_one) return
        if (nearly) then
            judgement%verdict = is_unreadable
            judgement%remark = "the motion of the line before is that of small oscillations; "// &
                "with its constants only what is exact is graded"
            return
        end if
        call judge_forms(left, right, left_text//"="//right_text, .false., .false., there, &
                         library, explain, judgement)
        judgement%residual = nothing  ! the constants are no symbols of the sheet
        judgement%of_motion = .false.
    end subroutine judge_on_motion

    function holds_on_motion(residual, samples) result(yes)
        !! With the motions put in that lines before have written out, in some mode:
        !! `theta_ddot = -omega^2 theta` behind `theta = A cos(omega t)`.
        type(expression_t), intent(in) :: residual  !! left less right side
        type(samples_t), intent(in) :: samples      !! know the motions
        logical :: yes
        type(samples_t) :: there
        type(expression_t) :: e, rates(3*samples%ndof)
        real(dp), allocatable :: values(:, :)
        integer :: i, k, places(size(rates))
        logical :: known

        places = [(1 + i, i=1, size(places))]
        do i = 1, size(places)
            k = 1 + modulo(i - 1, samples%ndof)
            rates(i) = symbol(places(i))
            if (samples%motion(k)%count > 0) rates(i) = rate_of(samples%motion(k), &
                                                               (i - 1)/samples%ndof)
        end do
        e = substituted(residual, places, rates)
        call put_on_motion(samples, there)
        values = there%values
        if (any([(e%depends_on(samples%frequency + i), i=0, 1)])) then
            call choose_modes(e, there, values, yes, known)
        else
            call holds(e, values, yes, known)
        end if
    end function holds_on_motion

    subroutine put_on_motion(samples, there)
        !! The states of the motions, with their constants as parameters.
        type(samples_t), intent(in) :: samples   !! know the motions
        type(samples_t), intent(out) :: there    !! at other times
        real(dp), allocatable :: values(:, :), elsewhere(:, :)
        type(expression_t) :: rate
        type(expression_t), allocatable :: formulas(:)
        integer :: energies(4), i, k, n, order, place, row

        there = samples
        n = size(samples%role)
        do i = 1, size(samples%constants)
            if (samples%symbols%find(trim(samples%constants(i))) > 0) then  ! a line gave its value
                call there%symbols%add("_"//trim(samples%constants(i)))
            else
                call there%symbols%add(trim(samples%constants(i)))
            end if
        end do
        there%role = [samples%role, [(role_parameter, i=1, size(samples%constants))]]
        there%rate = [samples%rate, [(0, i=1, size(samples%constants))]]
        call draw_values(samples, size(there%role), values)
        allocate (elsewhere(size(values, 1), size(values, 2)))
        elsewhere(:, :n) = samples%elsewhere
        elsewhere(:, n + 1:) = 1.3_dp*values(:, n + 1:)
        do k = 1, samples%ndof
            if (samples%motion(k)%count == 0) cycle
            do order = 0, 2
                place = 1 + k + order*samples%ndof
                rate = rate_of(samples%motion(k), order)
                values(:, place) = values_of(rate, values)
            end do
        end do
        do i = 1, size(samples%constants)  ! definitions have the same ones
            place = place_of_constant(samples, samples%constants(i))
            if (place > 0) values(:, place) = values(:, n + i)
        end do
        call move_alloc(values, there%values)
        call move_alloc(elsewhere, there%elsewhere)
        do row = 1, size(there%values, 1)
            call follow_letters(there, row)
        end do
        ! E and L, which are none of these
        call energy_formulas(there, formulas)
        energies = energy_places(there)
        do k = 1, 2
            if (energies(k) == 0) cycle
            there%values(:, energies(k)) = values_of(formulas(k), there%values)
            do row = 1, size(there%values, 1)  ! an energy of 0
                if (.not. is_rounding(formulas(k), there%values(row, :))) cycle
                there%values(row, energies(k)) = 0.0_dp
            end do
        end do
    end subroutine put_on_motion
end module lagrangia_constants_of_motions
