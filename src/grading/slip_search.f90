module lagrangia_slip_search
    !! The one change of a wrong statement that makes it right: a sign, a factor, a letter, a dot, a
    !! function, an exponent, a term too many or one that is missing.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_explanation, only: explanation_t
    use lagrangia_expression, only: apply, expression_t, f_cos, f_cosh, f_sin, f_sinh, &
                                    kind_function, kind_number, kind_power, kind_quotient, &
                                    kind_symbol, operator(/)
    use lagrangia_formula_text, only: formula_text
    use lagrangia_frequency_squares, only: is_of_period
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero, is_zero
    use lagrangia_sample_names, only: role_acceleration, role_frequency, role_known, &
                                      role_parameter, role_velocity, samples_t, states
    use lagrangia_sampled_formula, only: change_applied, change_argument, change_divided, &
                                         change_exponent, change_factor, change_function, &
                                         change_multiplied, change_number, change_sign, &
                                         change_symbol, change_t, evaluate_nodes, summands
    use lagrangia_simple_numbers, only: number_text
    use lagrangia_term_search, only: context, is_name_alone, library_t, part_text, try_factors, &
                                     try_missing_terms, try_products
    use lagrangia_wide_changes, only: exchangeable, is_of_mass, place_from, throughout, &
                                      two_factors
    implicit none (type, external)
    private
    public :: explain_slip
    public :: holds, is_trivial

    real(dp), parameter :: zero = 1e-9_dp   !! of the sizes of what is added up
    integer, parameter :: enough = 4        !! samples at which all is finite
    integer, parameter :: widest = 13       !! kinds of changes, from a sign to two terms

contains

    subroutine holds(expression, values, yes, judged, change)
        !! Does the formula vanish at every sample? `judged` if it has a value at enough of them.
        !! Where its terms underflow it has none, and where an exponent of -1 makes one term so
        !! large that rounding leaves nothing of another: 1/sin(theta) - theta at 1e-9.
        type(expression_t), intent(in) :: expression    !! left side less right side
        real(dp), intent(in) :: values(:, :)            !! of the symbols, (samples, symbols)
        logical, intent(out) :: yes                     !! it does
        logical, intent(out) :: judged                  !! it is known
        type(change_t), intent(in), optional :: change  !! of one node
        real(dp), dimension(size(values, 1), expression%count) :: results, sizes
        real(dp), allocatable :: signs(:)
        integer, allocatable :: nodes(:)
        logical :: finite(size(values, 1))
        integer :: n

        call evaluate_nodes(expression, values, results, change, sizes)
        n = expression%count
        finite = ieee_is_finite(results(:, n)) .and. ieee_is_finite(sizes(:, n))
        finite = finite .and. .not. (sizes(:, n) > 0.0_dp .and. zero*sizes(:, n) < tiny(zero))
        if (present(change)) then
            if (change%kind == change_exponent .and. change%factor < 0.0_dp) then
                call summands(expression, nodes, signs)
                finite = finite .and. any(is_nonzero(results(:, nodes)), 2) .and. &
                         zero*sizes(:, n) <= minval(abs(results(:, nodes)), 2, &
                                                    is_nonzero(results(:, nodes)))
            end if
        end if
        judged = count(finite) >= min(enough, size(values, 1))
        yes = judged .and. all(abs(results(:, n)) <= zero*sizes(:, n) .or. .not. finite)
    end subroutine holds

    function is_trivial(expression, samples, change) result(yes)
        !! Whether it vanishes away from the motion as well, and so says nothing about it.
        type(expression_t), intent(in) :: expression    !! left side less right side
        type(samples_t), intent(in) :: samples          !! on the motion and elsewhere
        type(change_t), intent(in), optional :: change  !! of one node
        logical :: yes, judged

        call holds(expression, samples%elsewhere, yes, judged, change)
    end function is_trivial

    subroutine explain_slip(expression, first, samples, values, library, explanation)
        !! Find the change that makes it right.
        type(expression_t), intent(in) :: expression        !! left side less right side, wrong
        integer, intent(in) :: first                        !! nodes before it are right
        type(samples_t), intent(in) :: samples              !! on the motion and elsewhere
        real(dp), intent(in) :: values(:, :)                !! on the motion, omega in its place
        type(library_t), intent(in) :: library(:)           !! right terms
        type(explanation_t), intent(out) :: explanation     !! empty if there is none
        character(:), allocatable :: remark
        real(dp) :: results(size(values, 1), expression%count)
        logical :: could_be_trivial, known(size(values, 1)), of_period(expression%count)
        integer :: i

        call evaluate_nodes(expression, values, results)
        known = ieee_is_finite(results(:, expression%count))
        of_period = is_of_period(expression, samples%frequency)
        could_be_trivial = .true.  ! sides that need no motion to be compared, or omega = 2 pi/T
        do i = 1, size(samples%role)
            if (samples%role(i) /= role_acceleration .and. samples%role(i) < role_known) cycle
            if (expression%depends_on(i)) could_be_trivial = samples%role(i) == role_frequency &
                                                             .and. could_be_trivial
        end do
        could_be_trivial = could_be_trivial .or. first > 1  ! nor does what stands for a formula
        do i = 1, widest
            explanation%width = i
            select case (i)
            case (1); call try_signs(remark)
            case (2); call try_functions(remark)
            case (3); call try_symbols(remark)
            case (4); call try_dots(remark)
            case (5); call try_exponents(remark)
            case (6); call try_factors(expression, first, samples, values, library, remark, &
                                       explanation%is_surplus, explanation%is_vague)
            case (7); call try_numbers(remark)
            case (8); call try_squares(remark)
            case (9); call try_products(expression, first, samples, values, library, remark)
            case (10); call try_missing_terms(expression, samples, values, library, remark, &
                                              explanation%lacks, explanation%is_vague)
            case (11); call try_inner_factors(remark)
            case (12); call try_throughout(remark)
            case default; call two_factors(expression, samples, values, library, &
                                           could_be_trivial, remark)
            end select
            if (remark /= "" .or. explanation%is_vague) exit
        end do
        explanation%text = remark
    contains
        logical function mends(change)
            type(change_t), intent(in) :: change
            logical :: judged

            mends = .false.
            if (change%node < first .or. of_period(change%node)) return
            call holds(expression, values(:1, :), mends, judged, change)
            if (.not. mends .and. judged) return
            call holds(expression, values, mends, judged, change)
            if (mends) mends = .not. loses_values(change)
            if (.not. mends .or. could_be_trivial) return
            mends = .not. is_trivial(expression, samples, change)
        end function mends

        logical function loses_values(change)
            !! Is it no number any more at some samples, or one with the same parameters only?
            type(change_t), intent(in) :: change
            real(dp) :: results(size(values, 1), expression%count)

            call evaluate_nodes(expression, values, results, change)
            associate (finite => ieee_is_finite(results(:, expression%count)))
                loses_values = any(known .and. .not. finite) .or. count(finite) <= states
            end associate
        end function loses_values

        subroutine try_signs(text)
            character(:), allocatable, intent(out) :: text
            integer :: i

            text = ""
            do i = expression%count - 1, 1, -1
                if (expression%nodes(i)%kind == kind_number) cycle
                if (.not. mends(change_t(change_sign, i))) cycle
                text = "the sign of "//node_text(i)//context(expression, samples, i)
                return
            end do
        end subroutine try_signs

        subroutine try_functions(text)
            character(:), allocatable, intent(out) :: text
            integer, parameter :: swaps(2, 4) = reshape([f_sin, f_cos, f_cos, f_sin, f_sinh, &
                                                         f_cosh, f_cosh, f_sinh], [2, 4])
            integer, parameter :: applied(*) = [f_sin, f_cos]
            type(expression_t) :: other
            integer :: i, k

            text = ""
            do i = 1, expression%count
                if (expression%nodes(i)%kind /= kind_function) cycle
                other = expression%pruned(expression%nodes(i)%left)
                if (mends(change_t(change_argument, i))) text = must_be(i, other)
                if (text /= "") return
                do k = 1, size(swaps, 2)
                    if (expression%nodes(i)%which /= swaps(1, k)) cycle
                    if (.not. mends(change_t(change_function, i, swaps(2, k)))) cycle
                    text = must_be(i, apply(swaps(2, k), other))
                    return
                end do
            end do
            do i = 1, expression%count
                if (expression%nodes(i)%kind /= kind_symbol) cycle
                if (samples%role(expression%nodes(i)%which) > role_parameter) cycle
                other = expression%pruned(i)
                do k = 1, size(applied)
                    if (.not. mends(change_t(change_applied, i, applied(k)))) cycle
                    text = must_be(i, apply(applied(k), other))
                    return
                end do
            end do
        end subroutine try_functions

        subroutine try_symbols(text)
            character(:), allocatable, intent(out) :: text
            integer :: i, k, pass

            text = ""
            do pass = 1, 2  ! the statement's own letters first
                do i = 1, expression%count
                    associate (node => expression%nodes(i))
                        if (node%kind /= kind_symbol) cycle
                        do k = 1, size(samples%role)
                            if (k == node%which .or. &
                                expression%depends_on(k) .neqv. pass == 1) cycle
                            if (.not. exchangeable(node%which, k, samples)) cycle
                            if (is_always_zero(k)) cycle
                            if (is_left_side(k)) cycle
                            if (.not. mends(change_t(change_symbol, i, k))) cycle
                            text = node_text(i)//" must be '"//trim(samples%symbols%names(k))// &
                                   "'"//context(expression, samples, i)
                            return
                        end do
                    end associate
                end do
            end do
        end subroutine try_symbols

        subroutine try_dots(text)
            !! An acceleration for the square of a velocity, or the other way.
            character(:), allocatable, intent(out) :: text
            integer :: i, k, symbol_at

            text = ""
            do i = 1, expression%count
                symbol_at = i
                if (expression%nodes(i)%kind == kind_power) symbol_at = expression%nodes(i)%left
                if (expression%nodes(symbol_at)%kind /= kind_symbol) cycle
                k = expression%nodes(symbol_at)%which
                if (samples%role(k) == role_velocity .and. symbol_at /= i) then
                    k = samples%rate(k)
                    if (mends(change_t(change_symbol, i, k))) text = node_text(i)//" must be '"// &
                        trim(samples%symbols%names(k))//"'"
                else if (samples%role(k) == role_acceleration .and. symbol_at == i) then
                    k = k - samples%ndof
                    if (mends(change_t(change_symbol, i, k, 2.0_dp))) text = node_text(i)// &
                        " must be '"//trim(samples%symbols%names(k))//"^2'"
                end if
                if (text /= "") text = text//context(expression, samples, i)
                if (text /= "") return
            end do
        end subroutine try_dots

        subroutine try_throughout(text)
            !! Letters exchanged in all places, or places that must be counted from another mass.
            character(:), allocatable, intent(out) :: text
            real(dp), allocatable :: changed(:, :), elsewhere(:, :)
            integer :: a, b

            text = ""
            do a = 2, size(samples%role)
                if (.not. expression%depends_on(a)) cycle
                do b = 2, size(samples%role)
                    if (a == b .or. samples%role(a) /= samples%role(b)) cycle
                    if (samples%role(a) >= role_known .and. .not. &
                        (is_of_mass(a, samples) .and. is_of_mass(b, samples))) cycle
                    if (is_always_zero(a) .or. is_always_zero(b)) cycle
                    changed = values
                    elsewhere = samples%elsewhere
                    call throughout(changed, a, b)
                    call throughout(elsewhere, a, b)
                    if (is_mended(changed, elsewhere)) then
                        text = "'"//trim(samples%symbols%names(a))//"' and '"// &
                               trim(samples%symbols%names(b))//"' must be exchanged in all places"
                        return
                    end if
                end do
            end do
            do a = samples%first_point, samples%last_point, 9
                do b = samples%first_point, samples%last_point, 9
                    if (a == b .or. max(a, b) + 8 > samples%last_point) cycle
                    changed = values
                    elsewhere = samples%elsewhere
                    call place_from(changed, a, b)
                    call place_from(elsewhere, a, b)
                    if (.not. is_mended(changed, elsewhere)) cycle
                    text = "the place of "//samples%symbols%names(a) (3:)
                    text = trim(text)//" must be counted from "//samples%symbols%names(b) (3:)
                    text = trim(text)//", '"//trim(samples%symbols%names(a))//" - "// &
                           trim(samples%symbols%names(b))//"'"
                    return
                end do
            end do
        end subroutine try_throughout

        logical function is_mended(changed, elsewhere)
            !! With these values in the place of those on the motion and away from it.
            real(dp), intent(in) :: changed(:, :), elsewhere(:, :)
            logical :: judged, trivial

            call holds(expression, changed, is_mended, judged)
            if (.not. is_mended .or. could_be_trivial) return
            call holds(expression, elsewhere, trivial, judged)
            is_mended = .not. trivial
        end function is_mended

        subroutine try_exponents(text)
            !! A power that is another, a square that is none, a quotient that is upside down, or
            !! a missing square.
            character(:), allocatable, intent(out) :: text
            integer :: i, k, n
            real(dp) :: exponent
            real(dp), parameter :: others(3) = [2.0_dp, 3.0_dp, -1.0_dp]
            real(dp), parameter :: steps(4) = [-1.0_dp, 1.0_dp, -2.0_dp, 2.0_dp]

            text = ""
            do i = 1, expression%count
                if (expression%nodes(i)%kind /= kind_power) cycle
                k = expression%nodes(i)%right
                if (expression%nodes(k)%kind /= kind_number) cycle
                exponent = expression%nodes(k)%number%value
                do n = 1, size(steps)
                    if (.not. mends(change_t(change_number, k, 0, steps(n)))) cycle
                    text = "the exponent of "//node_text(i)//" must be "// &
                           number_text(exponent + steps(n))//context(expression, samples, i)
                    return
                end do
            end do
            do i = expression%count, 1, -1
                if (expression%nodes(i)%kind /= kind_quotient) cycle
                if (.not. mends(change_t(change_exponent, i, 0, -1.0_dp))) cycle
                text = must_be(i, expression%pruned(expression%nodes(i)%right)/ &
                               expression%pruned(expression%nodes(i)%left))
                return
            end do
            do i = 1, expression%count
                k = expression%nodes(i)%kind
                if (k /= kind_symbol .and. k /= kind_function) cycle
                do n = 1, size(others)
                    if (.not. mends(change_t(change_exponent, i, 0, others(n)))) cycle
                    text = node_text(i)//" must have the exponent "//number_text(others(n))// &
                           context(expression, samples, i)
                    return
                end do
            end do
        end subroutine try_exponents

        subroutine try_numbers(text)
            character(:), allocatable, intent(out) :: text
            real(dp), parameter :: factors(11) = [2.0_dp, 0.5_dp, 3.0_dp, 1.0_dp/3.0_dp, 4.0_dp, &
                                                  0.25_dp, -1.0_dp, -2.0_dp, -0.5_dp, 1.5_dp, &
                                                  2.0_dp/3.0_dp]
            real(dp) :: number
            integer :: i, k, n

            text = ""
            do n = 1, 2*expression%count  ! numbers first, then the largest part
                i = merge(n, 2*expression%count + 1 - n, n <= expression%count)
                if (expression%nodes(i)%kind == kind_number .neqv. n <= expression%count) cycle
                if (expression%nodes(i)%kind == kind_number) then
                    number = expression%nodes(i)%number%value
                    if (is_zero(number)) cycle
                    if (mends(change_t(change_factor, i, 0, 1.0_dp/number))) then
                        text = "the number "//node_text(i)//" must be 1"// &
                               context(expression, samples, i)
                        return
                    end if
                end if
                do k = 1, size(factors)
                    if (.not. mends(change_t(change_factor, i, 0, factors(k)))) cycle
                    text = node_text(i)//" must be counted "//number_text(factors(k))//" times"// &
                           context(expression, samples, i)
                    if (expression%nodes(i)%kind == kind_number) then
                        number = expression%nodes(i)%number%value
                        text = "the number "//node_text(i)//" must be "// &
                               number_text(number*factors(k))//context(expression, samples, i)
                    end if
                    return
                end do
            end do
        end subroutine try_numbers

        subroutine try_inner_factors(text)
            !! A letter too few or too many, within brackets.
            character(:), allocatable, intent(out) :: text
            integer :: i, k, n

            text = ""
            do n = 1, 2*expression%count  ! the statement's own letters first
                i = 1 + mod(n - 1, expression%count)
                if (i == expression%count) cycle  ! a small factor of all makes any line small
                associate (nodes => expression%nodes(:expression%count))
                    if (any(nodes%kind == kind_power .and. nodes%right == i)) cycle  ! exponents
                end associate
                do k = 1, size(samples%role)
                    if (samples%role(k) > role_parameter .or. is_always_zero(k)) cycle
                    if (expression%depends_on(k) .neqv. n <= expression%count) cycle
                    if (mends(change_t(change_multiplied, i, k))) then
                        text = " lacks the factor '"//trim(samples%symbols%names(k))//"'"
                    else
                        if (.not. expression%depends_on(k)) cycle
                        if (.not. mends(change_t(change_divided, i, k))) cycle
                        text = " has the factor '"//trim(samples%symbols%names(k))//"' too many"
                    end if
                    text = node_text(i)//text//context(expression, samples, i)
                    return
                end do
            end do
        end subroutine try_inner_factors

        subroutine try_squares(text)
            !! A quotient whose square it must be.
            character(:), allocatable, intent(out) :: text
            integer :: i

            text = ""
            do i = 1, expression%count
                if (expression%nodes(i)%kind /= kind_quotient) cycle
                if (.not. mends(change_t(change_exponent, i, 0, 2.0_dp))) cycle
                text = node_text(i)//" must be squared"//context(expression, samples, i)
                return
            end do
        end subroutine try_squares

        function is_always_zero(k) result(yes)
            !! A parameter that nobody named and that is zero: with it any term goes away.
            integer, intent(in) :: k
            logical :: yes

            yes = all(is_zero(samples%values(:, k)))
        end function is_always_zero

        logical function is_left_side(k)
            !! All of it? On the right it would say that something is itself.
            integer, intent(in) :: k  !! a symbol

            associate (left => expression%nodes(expression%count)%left)
                is_left_side = is_name_alone(expression, left)
                if (is_left_side) is_left_side = expression%nodes(left)%which == k
            end associate
        end function is_left_side

        function must_be(i, other) result(text)
            integer, intent(in) :: i
            type(expression_t), intent(in) :: other
            character(:), allocatable :: text

            text = node_text(i)//" must be '"//formula_text(other, samples%symbols)//"'"// &
                   context(expression, samples, i)
        end function must_be

        function node_text(i) result(text)
            integer, intent(in) :: i
            character(:), allocatable :: text

            text = part_text(expression, i, samples)
        end function node_text
    end subroutine explain_slip
end module lagrangia_slip_search
