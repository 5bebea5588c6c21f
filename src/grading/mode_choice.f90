module lagrangia_mode_choice
    !! Which mode a statement speaks of, or a wrong one may speak of.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_explanation, only: explanation_t
    use lagrangia_expression, only: expression_t
    use lagrangia_kinds, only: dp
    use lagrangia_mode_samples, only: put_places
    use lagrangia_number_class, only: is_nonzero, is_zero
    use lagrangia_sample_names, only: draws, samples_t, states
    use lagrangia_slip_search, only: explain_slip, holds
    use lagrangia_statement_forms, only: is_about_other, speaks_of_place
    use lagrangia_term_search, only: library_t
    implicit none (type, external)
    private
    public :: choose_modes, explain_modes, put_mode

contains

    subroutine choose_modes(residual, samples, values, right_one, found)
        !! Give omega its values: of that equilibrium, and for each draw of parameters that mode,
        !! for which the statement holds; the first ones where it holds for none.
        type(expression_t), intent(in) :: residual   !! left less right side, with omega
        type(samples_t), intent(in) :: samples       !! know the modes
        real(dp), intent(inout) :: values(:, :)      !! of the symbols
        logical, intent(out) :: right_one            !! it holds for modes
        logical, intent(out) :: found                !! there are modes
        real(dp), allocatable :: first_choice(:, :)
        logical :: found_one, only_other
        integer :: n

        n = size(samples%omega2, 2)/2
        only_other = is_about_other(residual, samples)
        if (speaks_of_place(residual, samples)) call put_places(samples, samples%equilibrium, &
                                                                values)
        call choose_about(samples%omega2(:, :n), samples%equilibrium, residual, samples, values, &
                          right_one, found)
        if (right_one .and. .not. only_other) return
        first_choice = values
        if (speaks_of_place(residual, samples)) call put_places(samples, &
                                                                samples%other_equilibrium, values)
        call choose_about(samples%omega2(:, n + 1:), samples%other_equilibrium, residual, samples, &
                          values, right_one, found_one)
        if (found .and. .not. (right_one .or. only_other)) values = first_choice
        found = found .or. found_one
    end subroutine choose_modes

    subroutine explain_modes(expression, first, samples, values, library, explanation, mode)
        !! The narrowest change that makes a statement right, for omega of any mode; of one about
        !! the other equilibrium where there is none about the first, or of a mode that is unstable.
        type(expression_t), intent(in) :: expression         !! left side less right side, wrong
        integer, intent(in) :: first                         !! nodes before it are right
        type(samples_t), intent(in) :: samples               !! know the modes
        real(dp), intent(in) :: values(:, :)                 !! of the symbols, omega of the first
        type(library_t), intent(in) :: library(:)            !! right terms
        type(explanation_t), intent(out) :: explanation      !! empty if there is none
        integer, intent(out) :: mode
        !! of which it is right then, see `put_mode`; 0: at the first equilibrium, without omega
        type(explanation_t) :: other
        real(dp) :: there(size(values, 1), size(values, 2))
        integer :: k

        mode = 1
        call explain_slip(expression, first, samples, values, library, explanation)
        if (.not. (expression%depends_on(samples%frequency) .or. &
                   expression%depends_on(samples%frequency + 1))) then
            if (.not. speaks_of_place(expression, samples)) return
            if (all(is_zero(samples%equilibrium))) return  ! of 0 nobody writes a formula
            call explain_slip(expression, first, samples, samples%values, library, other)
            if (explanation%is_surplus) explanation%width = huge(mode)  ! rather than `is not 0`
            if (.not. other%is_surplus) call take_narrower(0)
            return
        end if
        there = values
        do k = 2, samples%ndof
            ! behind the modes of a constrained system stand zeros, which are none
            if (samples%system%constraints > 0 .and. all(is_zero(samples%omega2(:, k)))) cycle
            call put_mode(samples, k, there)
            call explain_slip(expression, first, samples, there, library, other)
            call take_narrower(k)
        end do
        if (samples%ndof == 2 .and. all(is_nonzero(samples%omega2(:, :2)))) then
            ! which of two is the slower one may depend on the parameters
            do k = 2*samples%ndof + 1, 2*samples%ndof + samples%ndof**draws - 2
                call put_mode(samples, k, there)
                call explain_slip(expression, first, samples, there, library, other)
                call take_narrower(k)
            end do
        end if
        if (mode > 2*samples%ndof) return
        do k = samples%ndof + 1, size(samples%omega2, 2)
            if (.not. (explanation%is_empty() .or. all(samples%omega2(:, mode) <= 0.0_dp))) return
            if (count(is_nonzero(samples%omega2(:, k))) < 2) cycle
            there = values
            call put_mode(samples, k, there)
            call explain_slip(expression, first, samples, there, library, other)
            if (other%is_empty()) cycle
            if (.not. explanation%is_empty() .and. other%width > explanation%width) cycle
            explanation = other
            mode = k
        end do
    contains
        subroutine take_narrower(of_mode)
            !! The other explanation, if it is.
            integer, intent(in) :: of_mode

            if (other%is_empty()) return
            if (.not. explanation%is_empty() .and. other%width >= explanation%width) return
            explanation = other
            mode = of_mode
        end subroutine take_narrower
    end subroutine explain_modes

    pure subroutine put_mode(samples, mode, values)
        !! Give omega the values of one mode; about the other equilibrium, its place as well, and no
        !! number where there is none.
        type(samples_t), intent(in) :: samples     !! know the modes
        integer, intent(in) :: mode
        !! from 1, the slowest about the first equilibrium; above ndof, about the other one; above
        !! 2 ndof, one of the first for each draw, the digits of the rest to the base ndof
        real(dp), intent(inout) :: values(:, :)    !! of the symbols
        integer :: draw, k, n, row

        n = samples%ndof
        if (mode > n .and. mode <= 2*n) call put_places(samples, samples%other_equilibrium, values)
        do row = 1, size(values, 1)
            draw = 1 + (row - 1)/states
            k = mode
            if (mode > 2*n) k = 1 + modulo((mode - 2*n)/n**(draw - 1), n)
            associate (omega2 => samples%omega2(draw, k))
                values(row, samples%frequency) = sqrt(omega2)
                values(row, samples%frequency + 1) = omega2
                if (k > n .and. is_zero(omega2)) then
                    values(row, samples%frequency:samples%frequency + 1) = &
                        ieee_value(omega2, ieee_quiet_nan)
                end if
            end associate
        end do
    end subroutine put_mode

    subroutine choose_about(omega2, place, residual, samples, values, right_one, found)
        !! About one equilibrium; no number for draws without an oscillation. Two draws must match.
        real(dp), intent(in) :: omega2(:, :)  !! (draws, modes), 0 where there is none
        real(dp), intent(in) :: place(:, :)   !! the equilibrium, (coordinates, draws); NaN: none
        type(expression_t), intent(in) :: residual
        type(samples_t), intent(in) :: samples
        real(dp), intent(inout) :: values(:, :)
        logical, intent(out) :: right_one, found
        integer :: draw, first, k, matches
        logical :: yes, judged, needs_root, of_zero

        needs_root = residual%depends_on(samples%frequency)
        ! `omega^2 = 0` is said of a mode that does not oscillate, a product that is zero is not
        of_zero = residual%count <= 3 .and. samples%system%constraints == 0
        found = .false.
        right_one = .true.
        matches = 0
        do draw = 1, draws
            first = (draw - 1)*states
            associate (rows => values(first + 1:first + states, :))
                yes = .false.
                do k = size(omega2, 2), 1, -1
                    if (is_zero(omega2(draw, k)) .and. .not. (of_zero .and. &
                        all(ieee_is_finite(place(:, draw))))) cycle
                    if (omega2(draw, k) < 0.0_dp .and. needs_root) cycle
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
                    right_one = right_one .and. all(is_zero(omega2(draw, :)))
                end if
            end associate
        end do
        right_one = right_one .and. matches >= 2
        found = found .and. any(values(:, samples%frequency) >= 0.0_dp)  ! no NaN everywhere
    end subroutine choose_about
end module lagrangia_mode_choice
