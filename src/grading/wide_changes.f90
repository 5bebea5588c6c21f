module lagrangia_wide_changes
    !! Slips in several places of a statement: two letters exchanged throughout, places that must be
    !! counted from another mass, two terms with wrong factors; which names may be taken for which.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, kind_number
    use lagrangia_formula_text, only: formula_text
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use lagrangia_letter_products, only: find_product, letter_t
    use lagrangia_sample_names, only: draws, role_acceleration, role_coordinate, role_parameter, &
                                      role_time, role_velocity, samples_t, states
    use lagrangia_sampled_formula, only: evaluate_nodes, summands
    use lagrangia_term_search, only: gather_letters, library_t, part_text
    implicit none (type, external)
    private
    public :: exchangeable, is_of_mass, place_from, throughout, two_factors

    integer, parameter :: most_changes = 2   !! of one statement
    real(dp), parameter :: equal = 1e-7_dp   !! relative difference of factors that are one

contains

    pure subroutine throughout(values, a, b)
        !! Exchange two letters in all places.
        real(dp), intent(inout) :: values(:, :)  !! (samples, symbols)
        integer, intent(in) :: a, b              !! places of two symbols
        real(dp) :: before(size(values, 1))

        before = values(:, a)
        values(:, a) = values(:, b)
        values(:, b) = before
    end subroutine throughout

    pure subroutine place_from(values, point, origin)
        !! Count the place of one mass from that of another, with its rates.
        real(dp), intent(inout) :: values(:, :)     !! (samples, symbols)
        integer, intent(in) :: point, origin        !! symbols of their x
        integer :: k

        do k = 0, 8  ! x, y, z with two rates each
            values(:, point + k) = values(:, point + k) - values(:, origin + k)
        end do
    end subroutine place_from

    subroutine two_factors(expression, samples, values, library, could_be_trivial, remark)
        !! Summands that must be counted otherwise: their sum with factors that depend on parameters
        !! only is zero on the motion.
        type(expression_t), intent(in) :: expression      !! left side less right side, wrong
        type(samples_t), intent(in) :: samples            !! know the names
        real(dp), intent(in) :: values(:, :)              !! on the motion, (samples, symbols)
        type(library_t), intent(in) :: library(:)         !! right terms
        logical, intent(in) :: could_be_trivial           !! it need not say anything of the motion
        character(:), allocatable, intent(out) :: remark  !! "" if it is not that
        real(dp), allocatable :: terms(:, :), factors(:, :), elsewhere(:, :), signs(:)
        integer, allocatable :: nodes(:)
        type(letter_t), allocatable :: letters(:)
        character(:), allocatable :: said
        integer :: changes, reference
        logical :: found

        remark = ""
        call summands(expression, nodes, signs)
        signs = pack(signs, .not. is_zero(nodes))
        nodes = pack(nodes, .not. is_zero(nodes))
        if (size(nodes) < 3 .or. size(nodes) > states - 2) return
        call evaluate_terms(values, terms)
        if (.not. all(ieee_is_finite(terms))) return
        call evaluate_terms(samples%elsewhere, elsewhere)
        do reference = 1, size(nodes)
            call fit_factors(terms, reference, factors, found)
            if (.not. found) cycle
            if (count(any(abs(factors - 1.0_dp) > equal, 1)) > most_changes) cycle
            if (.not. could_be_trivial .and. vanishes(elsewhere, factors)) cycle
            if (.not. allocated(letters)) call gather_letters(samples, library, letters)
            call put_remarks(said, changes)
            if (changes /= most_changes) cycle
            if (remark /= "" .and. len(said) + len("two changes: ") >= len(remark)) cycle
            remark = "two changes: "//said  ! the simplest
        end do
    contains
        elemental logical function is_zero(node)
            !! A number 0 on one side.
            integer, intent(in) :: node

            is_zero = expression%nodes(node)%kind == kind_number .and. &
                      expression%nodes(node)%number%is_zero()
        end function is_zero

        subroutine evaluate_terms(at, of)
            real(dp), intent(in) :: at(:, :)
            real(dp), allocatable, intent(out) :: of(:, :)
            real(dp) :: results(size(at, 1), expression%count)
            integer :: k

            call evaluate_nodes(expression, at, results)
            allocate (of(size(at, 1), size(nodes)))
            do k = 1, size(nodes)
                of(:, k) = signs(k)*results(:, nodes(k))
            end do
        end subroutine evaluate_terms

        subroutine put_remarks(text, number)
            !! Empty if a factor is no product of letters.
            character(:), allocatable, intent(out) :: text
            integer, intent(out) :: number
            type(expression_t) :: product
            character(:), allocatable :: term
            integer :: k

            text = ""
            number = 0
            do k = 1, size(nodes)
                if (all(abs(factors(:, k) - 1.0_dp) <= equal)) cycle
                number = number + 1
                if (number > 1) text = text//"; "
                term = part_text(expression, nodes(k), samples)
                if (all(abs(factors(:, k)) <= equal)) then
                    text = text//term//" does not belong there"
                else if (all(abs(factors(:, k) + 1.0_dp) <= equal)) then
                    text = text//"the sign of "//term
                else
                    call find_product(factors(:, k), letters, product, found)
                    if (.not. found) number = most_changes + 1
                    if (.not. found) return
                    text = text//term//" lacks the factor '"// &
                           formula_text(product, samples%symbols)//"'"
                end if
            end do
        end subroutine put_remarks
    end subroutine two_factors

    subroutine fit_factors(terms, reference, factors, found)
        !! For each draw of parameters the factors that make the sum zero, 1 for the reference.
        real(dp), intent(in) :: terms(:, :)                    !! (draws*states, terms)
        integer, intent(in) :: reference
        real(dp), allocatable, intent(out) :: factors(:, :)    !! (draws, terms)
        logical, intent(out) :: found
        integer, allocatable :: others(:)
        real(dp), allocatable :: solution(:)
        type(error_t), allocatable :: error
        integer :: draw, first, k, n

        n = size(terms, 2) - 1
        others = pack([(k, k=1, n + 1)], [(k /= reference, k=1, n + 1)])
        allocate (factors(draws, n + 1), source=1.0_dp)
        allocate (solution(n))
        do draw = 1, draws
            first = (draw - 1)*states
            call solve_linear(terms(first + 1:first + n, others), &
                              -terms(first + 1:first + n, reference), solution, error)
            found = .not. allocated(error)
            if (found) found = all(ieee_is_finite(solution))
            if (.not. found) return
            factors(draw, others) = solution
        end do
        where (abs(factors) <= equal) factors = 0.0_dp
        found = vanishes(terms, factors)
    end subroutine fit_factors

    pure function vanishes(terms, factors) result(yes)
        !! Is the sum of all terms with these factors zero at all states?
        real(dp), intent(in) :: terms(:, :), factors(:, :)
        logical :: yes
        integer :: draw, row

        yes = .true.
        do row = 1, size(terms, 1)
            draw = 1 + (row - 1)/states
            associate (products => terms(row, :)*factors(draw, :))
                yes = yes .and. abs(sum(products)) <= equal*sum(abs(products))
            end associate
        end do
    end function vanishes

    pure function exchangeable(a, b, samples) result(yes)
        !! May a student have written the one for the other? Letters for letters or for the place
        !! of an equilibrium, a coordinate for another, a place of a mass for another, or with a
        !! dot too many or too few.
        integer, intent(in) :: a, b             !! symbols
        type(samples_t), intent(in) :: samples  !! know their roles
        logical :: yes
        integer, parameter :: moving(*) = [role_time, role_coordinate, role_velocity, &
                                           role_acceleration]

        associate (one => samples%role(a), other => samples%role(b))
            yes = (one == role_parameter .and. (other == role_parameter .or. &
                                                any(samples%place == b))) .or. &
                  (any(moving == one) .and. any(moving == other)) .or. &
                  (is_of_mass(a, samples) .and. is_of_mass(b, samples))
        end associate
    end function exchangeable

    pure function is_of_mass(k, samples) result(yes)
        !! Is it the place of a mass, or a rate of one?
        integer, intent(in) :: k                !! a symbol
        type(samples_t), intent(in) :: samples  !! know which these are
        logical :: yes

        yes = k >= samples%first_point .and. k <= samples%last_point
    end function is_of_mass
end module lagrangia_wide_changes
