module lagrangia_rounded_numbers
    !! Statements with numbers that somebody has rounded: `omega = 3.13` for 3.1321.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_explanation, only: explanation_t
    use lagrangia_expression, only: constant, expression_t, kind_negation, kind_number, &
                                    kind_symbol, operator(-)
    use lagrangia_kinds, only: dp
    use lagrangia_motion_values, only: values_of
    use lagrangia_number_class, only: all_finite, is_nonzero, is_zero
    use lagrangia_sample_names, only: draws, samples_t, states
    use lagrangia_sampled_formula, only: change_factor, change_t, evaluate_nodes
    use lagrangia_simple_numbers, only: number_text
    use lagrangia_statement_forms, only: speaks_of_place
    use lagrangia_verdict, only: brief, telling_digits
    implicit none (type, external)
    private
    public :: holds_at, holds_to_digits, put_exact_frequencies, put_exact_number, to_digits, &
              true_number, try_rounded

    character(*), parameter :: to_digits = "to the digits given"
    !! what is said of such a statement
    character(*), parameter :: digits = "0123456789"
    integer, parameter :: enough = 4  !! samples at which all is finite

contains

    function holds_to_digits(left, right, text, samples) result(yes)
        !! Do the sides differ by no more than the roundings of the numbers with at least three
        !! digits, or with two where no other number is rounded or the right side is a number?
        type(expression_t), intent(in) :: left, right   !! both sides
        character(*), intent(in) :: text                !! both, as typed
        type(samples_t), intent(in) :: samples          !! on the motion
        logical :: yes
        type(expression_t) :: residual
        real(dp), allocatable :: values(:, :), before(:, :), after(:, :), allowed(:)
        real(dp), allocatable :: half(:)
        logical, allocatable :: judged(:)
        integer :: i, mode

        yes = .false.
        residual = left - right
        allocate (half(residual%count))
        call find_roundings(.true.)
        if (count(half > 0.0_dp) > 1 .and. any(right%nodes(:right%count)%kind /= kind_number .and. &
            right%nodes(:right%count)%kind /= kind_negation)) call find_roundings(.false.)
        if (.not. any(half > 0.0_dp)) return
        allocate (before(size(samples%values, 1), residual%count))
        allocate (after, mold=before)
        do mode = 0, size(samples%omega2, 2)
            call choose(residual, samples, mode, values)
            if (.not. allocated(values)) cycle
            call evaluate_nodes(residual, values, before)
            if (.not. allocated(allowed)) allocate (allowed(size(values, 1)))
            allowed = 0.0_dp
            do i = 1, residual%count
                if (.not. half(i) > 0.0_dp) cycle
                call evaluate_nodes(residual, values, after, change_t(change_factor, i, 0, 1.0_dp &
                                                       + half(i)/residual%nodes(i)%number%value))
                allowed = allowed + abs(after(:, residual%count) - before(:, residual%count))
            end do
            judged = ieee_is_finite(before(:, residual%count)) .and. ieee_is_finite(allowed)
            yes = count(judged) >= enough .and. &
                all(abs(before(:, residual%count)) <= 1.000001_dp*allowed .or. .not. judged)
            if (yes) return
        end do
    contains
        subroutine find_roundings(alone)
            logical, intent(in) :: alone  !! two digits are enough

            do i = 1, residual%count
                half(i) = 0.0_dp
                if (residual%nodes(i)%kind /= kind_number) cycle
                half(i) = rounding(residual%nodes(i)%number%value, text, alone)
            end do
        end subroutine find_roundings
    end function holds_to_digits

    function holds_at(residual, text, values) result(yes)
        !! Do the sides differ by no more than the roundings of their numbers at all these states?
        type(expression_t), intent(in) :: residual      !! left less right side
        character(*), intent(in) :: text                !! both, as typed
        real(dp), intent(in) :: values(:, :)            !! of the symbols, (states, symbols)
        logical :: yes
        real(dp), dimension(size(values, 1), residual%count) :: before, after
        real(dp) :: allowed(size(values, 1)), half
        integer :: i

        call evaluate_nodes(residual, values, before)
        allowed = 0.0_dp
        do i = 1, residual%count
            if (residual%nodes(i)%kind /= kind_number) cycle
            half = rounding(residual%nodes(i)%number%value, text, .true.)
            if (.not. half > 0.0_dp) cycle
            call evaluate_nodes(residual, values, after, change_t(change_factor, i, 0, 1.0_dp &
                                                   + half/residual%nodes(i)%number%value))
            allowed = allowed + abs(after(:, residual%count) - before(:, residual%count))
        end do
        yes = all(allowed > 0.0_dp) .and. &
              all(abs(before(:, residual%count)) <= 1.000001_dp*allowed)
    end function holds_at

    subroutine try_rounded(residual, text, values, yes, remark)
        !! The same of a motion that does not hold: `x = 0.89 t^2`.
        type(expression_t), intent(in) :: residual      !! left less right side
        character(*), intent(in) :: text                !! both, as typed
        real(dp), intent(in) :: values(:, :)            !! of the symbols, (states, symbols)
        logical, intent(out) :: yes                     !! a number that rounds to it makes it hold
        character(:), allocatable, intent(inout) :: remark  !! says so

        yes = holds_at(residual, text, values)
        if (yes) remark = to_digits
    end subroutine try_rounded

    subroutine put_exact_number(truth, text, samples, meaning)
        !! The one rounded number of a formula, with all its digits: those with which it is what it
        !! must be. Nothing changes where there are several, or none.
        type(expression_t), intent(in) :: truth           !! what the formula must be
        character(*), intent(in) :: text                  !! of the statement, as typed
        type(samples_t), intent(in) :: samples            !! know the modes
        type(expression_t), intent(inout) :: meaning      !! the formula
        type(expression_t) :: residual, exact
        real(dp), allocatable :: values(:, :), results(:, :)
        real(dp) :: f(2), half, number, x(2)
        integer :: i, k, mode, rounded

        rounded = 0
        do i = 1, meaning%count
            if (meaning%nodes(i)%kind /= kind_number) cycle
            number = meaning%nodes(i)%number%value
            half = rounding(number, text, meaning%count <= 2)
            if (.not. half > 0.0_dp) cycle
            if (rounded > 0) return
            rounded = i
            x = [number, number + half]
        end do
        if (rounded == 0) return
        residual = truth - meaning
        half = x(2) - x(1)
        number = x(1)
        allocate (results(size(samples%values, 1), residual%count))
        do mode = 0, size(samples%omega2, 2)
            call choose(residual, samples, mode, values)
            if (.not. allocated(values)) cycle
            x = [number, number + half]
            f(1) = at(x(1))
            do k = 1, 20  ! a secant each
                f(2) = at(x(2))
                if (.not. is_nonzero(f(2) - f(1))) exit
                x = [x(2), x(2) - f(2)*(x(2) - x(1))/(f(2) - f(1))]
                f(1) = f(2)
            end do
            if (.not. abs(x(2) - number) <= 1.000001_dp*half) cycle
            f(2) = at(x(2))
            if (.not. all(abs(results(:, residual%count)) <= 1e-10_dp*abs(results(:, &
                                                                        truth%count)))) cycle
            exact = constant(x(2))
            meaning%nodes(rounded)%number = exact%nodes(1)%number
            return
        end do
    contains
        real(dp) function at(changed)
            !! The residual of the first sample with another number.
            real(dp), intent(in) :: changed

            call evaluate_nodes(residual, values, results, change_t(change_factor, &
                                             truth%count + rounded, 0, changed/number))
            at = results(1, residual%count)
        end function at
    end subroutine put_exact_number

    subroutine put_exact_frequencies(text, samples, motion)
        !! `A cos(3.13 t)`: a rounded number that is a frequency gets all its digits, where lines
        !! `set:` fix all parameters.
        character(*), intent(in) :: text                  !! as typed
        type(samples_t), intent(in) :: samples            !! know the modes
        type(expression_t), intent(inout) :: motion       !! a function of the time
        type(expression_t) :: exact
        real(dp) :: half, omega
        integer :: i, mode

        do i = 1, motion%count
            if (motion%nodes(i)%kind /= kind_number) cycle
            half = rounding(motion%nodes(i)%number%value, text, .false.)
            if (.not. half > 0.0_dp) cycle
            do mode = 1, size(samples%omega2, 2)
                associate (omega2 => samples%omega2(:, mode))
                    if (.not. all(omega2 > 0.0_dp)) cycle
                    if (maxval(omega2) - minval(omega2) > 1e-12_dp*maxval(omega2)) cycle
                    omega = sqrt(omega2(1))
                end associate
                if (abs(motion%nodes(i)%number%value - omega) > half) cycle
                exact = constant(omega)
                motion%nodes(i)%number = exact%nodes(1)%number
                exit
            end do
        end do
    end subroutine put_exact_frequencies

    pure function rounding(value, text, alone) result(half)
        !! Half a unit of the last digit of the number of this value in the text; 0: it is exact.
        real(dp), intent(in) :: value
        character(*), intent(in) :: text
        logical, intent(in) :: alone
        real(dp) :: half, number
        integer :: behind, exponent, first, i, last, point, significant, status

        half = 0.0_dp
        first = 1
        do
            last = scan(text(first:), digits//".")
            if (last == 0) return
            first = first + last - 1
            last = first + verify(text(first:)//" ", digits//".") - 2
            point = index(text(first:last), ".")
            call find_exponent(text, last, exponent, behind)
            read (text(first:behind - 1), *, iostat=status) number
            if (status == 0 .and. point > 0 .and. last > first) then
                significant = 0
                do i = first, last
                    if (text(i:i) == "." .or. (text(i:i) == "0" .and. significant == 0)) cycle
                    significant = significant + 1
                end do
                if (abs(number - value) <= 1e-12_dp*number .and. &
                    significant >= merge(2, 3, alone)) then
                    half = 0.5_dp*10.0_dp**(exponent - (last - first + 1 - point))
                    return
                end if
            end if
            first = behind
        end do
    end function rounding

    pure subroutine find_exponent(text, last, exponent, behind)
        !! The power of ten of a number with `e` or `E` behind its digits.
        character(*), intent(in) :: text
        integer, intent(in) :: last       !! of these digits
        integer, intent(out) :: exponent  !! 0 if there is none
        integer, intent(out) :: behind    !! the first character that is no part of the number
        integer :: end, start, status

        exponent = 0
        behind = last + 1
        if (scan(text(behind:), "eE") /= 1) return
        start = behind + 1
        if (scan(text(start:), "+-") == 1) start = start + 1
        end = start + verify(text(start:)//" ", digits) - 2
        if (end < start) return
        read (text(behind + 1:end), *, iostat=status) exponent
        if (status == 0) behind = end + 1
        if (status /= 0) exponent = 0
    end subroutine find_exponent

    pure subroutine choose(residual, samples, mode, values)
        !! The values, with omega of this mode; none where the mode does not matter, or is missing.
        type(expression_t), intent(in) :: residual
        type(samples_t), intent(in) :: samples
        integer, intent(in) :: mode                          !! 0: no omega
        real(dp), allocatable, intent(out) :: values(:, :)   !! (samples, symbols)
        real(dp) :: omega2
        logical :: oscillates
        integer :: draw

        oscillates = residual%depends_on(samples%frequency) .or. &
                     residual%depends_on(samples%frequency + 1)
        if (oscillates .neqv. mode > 0) return
        values = samples%values
        if (mode == 0) return
        do draw = 1, draws
            omega2 = samples%omega2(draw, mode)
            if (.not. omega2 > 0.0_dp) then
                deallocate (values)
                return
            end if
            associate (rows => values((draw - 1)*states + 1:draw*states, :))
                rows(:, samples%frequency) = sqrt(omega2)
                rows(:, samples%frequency + 1) = omega2
            end associate
        end do
    end subroutine choose

    subroutine true_number(left, right, samples, explanation)
        !! `the left side is 1.962`, where the right one is a number and the left one has always the
        !! same value; or one for each mode.
        type(expression_t), intent(in) :: left, right          !! both sides, which differ
        type(samples_t), intent(in) :: samples                 !! on the motion
        type(explanation_t), intent(inout) :: explanation      !! changes where it is so
        real(dp), allocatable :: values(:, :), results(:, :), given(:)
        character(:), allocatable :: text
        logical :: of_pi
        integer :: mode

        if (any(right%nodes(:right%count)%kind == kind_symbol)) return
        of_pi = any(is_zero(right%nodes(:right%count)%number%value - acos(-1.0_dp)))
        if (speaks_of_place(left, samples) .and. any(abs(samples%other_equilibrium - &
                            samples%equilibrium) > 0.0_dp)) return  ! there are several
        text = ""
        allocate (results(size(samples%values, 1), left%count))
        do mode = 0, size(samples%omega2, 2)
            call choose(left, samples, mode, values)
            if (.not. allocated(values)) cycle
            call evaluate_nodes(left, values, results)
            given = values_of(right, values(:1, :))
            associate (r => results(:, left%count))
                if (.not. all_finite(r)) cycle
                if (maxval(r) - minval(r) > 1e-9_dp*maxval(abs(r))) cycle
                if (text /= "") text = text//" or "
                if (of_pi .and. index(number_text(r(1)), "pi") > 0) then
                    text = text//number_text(r(1))
                else
                    text = text//brief(r(1), telling_digits(r(1), given(1)))
                end if
            end associate
        end do
        if (text == "") return
        if (allocated(explanation%lacks)) deallocate (explanation%lacks)
        explanation%text = "the left side is "//text
        explanation%is_surplus = .false.
    end subroutine true_number
end module lagrangia_rounded_numbers
