module lagrangia_mode_choice
    !! Which mode a statement speaks of.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_expression, only: expression_t
    use lagrangia_kinds, only: dp
    use lagrangia_mode_samples, only: put_places
    use lagrangia_number_class, only: is_zero
    use lagrangia_sample_names, only: draws, samples_t, states
    use lagrangia_slip_search, only: holds
    implicit none (type, external)
    private
    public :: choose_modes

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
        logical :: found_one, speaks_of_place
        integer :: i, n

        n = size(samples%omega2, 2)/2
        speaks_of_place = any([(residual%depends_on(samples%place(i)), i=1, size(samples%place))])
        if (speaks_of_place) call put_places(samples, samples%equilibrium, values)
        call choose_about(samples%omega2(:, :n), residual, samples, values, right_one, found)
        if (right_one) return
        first_choice = values
        if (speaks_of_place) call put_places(samples, samples%other_equilibrium, values)
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
                yes = .false.
                do k = size(omega2, 2), 1, -1
                    if (omega2(draw, k) <= 0.0_dp .and. needs_root) cycle
                    if (is_zero(omega2(draw, k))) cycle
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
        found = found .and. any(values(:, samples%frequency) > 0.0_dp)  ! no NaN everywhere
    end subroutine choose_about
end module lagrangia_mode_choice
