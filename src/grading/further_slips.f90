module lagrangia_further_slips
    !! What is wrong where no single change of a term mends a statement: an angle, a root, a term of
    !! letters alone, or what the formula of L, T, V or a momentum lacks.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_canonical_form, only: simplified
    use lagrangia_explanation, only: explanation_t
    use lagrangia_expression, only: expression_t, kind_function, kind_number, kind_symbol, &
                                    operator(-), symbol
    use lagrangia_formula_text, only: formula_text
    use lagrangia_kinds, only: dp
    use lagrangia_letter_products, only: find_product, letter_t
    use lagrangia_number_class, only: all_finite
    use lagrangia_sample_names, only: draws, role_coordinate, samples_t, states
    use lagrangia_sampled_formula, only: change_factor, change_t, evaluate_nodes, summands
    use lagrangia_simple_numbers, only: number_text
    use lagrangia_slip_search, only: holds
    use lagrangia_substitution, only: substituted
    use lagrangia_term_search, only: context, gather_letters, library_t, missing, part_text
    use lagrangia_written_out, only: energy_formulas, energy_places, written_out
    implicit none (type, external)
    private
    public :: explain_further

    real(dp), parameter :: equal = 1e-7_dp      !! relative difference of factors that are one
    integer, parameter :: longest = 200         !! characters of a formula that is said to miss

contains

    subroutine explain_further(left, right, samples, values, library, explanation)
        !! Say it, if it is one of these.
        type(expression_t), intent(in) :: left, right        !! both sides, which differ
        type(samples_t), intent(in) :: samples               !! know the names
        real(dp), intent(in) :: values(:, :)                 !! on the motion, omega in its place
        type(library_t), intent(in) :: library(:)            !! right terms
        type(explanation_t), intent(inout) :: explanation    !! changes if it is
        character(:), allocatable :: text

        call try_arguments(left - right, samples, values, library, text)
        if (text == "") call try_root(left, right, values, text)
        if (text == "") call try_letters(left - right, samples, values, library, text)
        if (text == "") call try_parts(left - right, left%count, samples, values, library, text)
        if (text == "") call try_difference(left, right, samples, text)
        if (text /= "") explanation%text = text
    end subroutine explain_further

    subroutine try_arguments(expression, samples, values, library, text)
        !! `cos(theta1 + theta2)` for `cos(theta2)`, once or in all places.
        type(expression_t), intent(in) :: expression
        type(samples_t), intent(in) :: samples
        real(dp), intent(in) :: values(:, :)
        type(library_t), intent(in) :: library(:)
        character(:), allocatable, intent(out) :: text
        real(dp) :: results(size(values, 1), expression%count)
        logical :: same(expression%count)
        type(expression_t) :: other
        integer :: i, k, m

        text = ""
        call evaluate_nodes(expression, values, results)
        do i = 1, expression%count
            if (expression%nodes(i)%kind /= kind_function) cycle
            same = .false.
            same(i) = .true.
            do k = 2, size(samples%role)
                if (samples%role(k) == role_coordinate) call try(symbol(k))
                if (text /= "") return
            end do
            do k = 1, size(library)
                do m = 1, library(k)%term%count
                    if (library(k)%term%nodes(m)%kind /= kind_function) cycle
                    other = library(k)%term%pruned(library(k)%term%nodes(m)%left)
                    call try(other)
                    if (text /= "") return
                end do
            end do
        end do
    contains
        subroutine try(argument)
            type(expression_t), intent(in) :: argument
            type(expression_t) :: changed
            character(:), allocatable :: wanted
            integer :: j
            logical :: everywhere, judged, yes

            do j = 1, expression%count
                same(j) = expression%nodes(j)%kind == kind_function
                if (same(j)) same(j) = all(abs(results(:, expression%nodes(j)%left) - &
                                   results(:, expression%nodes(i)%left)) <= equal*abs(results(:, &
                                                                    expression%nodes(i)%left)))
            end do
            everywhere = count(same) > 1
            call replace(same, argument, changed)
            call holds(changed, values, yes, judged)
            if (.not. yes .and. everywhere) then
                everywhere = .false.
                same = .false.
                same(i) = .true.
                call replace(same, argument, changed)
                call holds(changed, values, yes, judged)
            end if
            if (.not. yes) return
            call holds(changed, samples%elsewhere, yes, judged)
            if (yes .and. .not. is_plain(changed)) return
            wanted = formula_text(written_out(argument, samples), samples%symbols)
            text = part_text(expression, expression%nodes(i)%left, samples)//" must be '"// &
                wanted//"'"
            if (everywhere) text = text//" in all places"
            if (.not. everywhere) text = text//" in "//part_text(expression, i, samples)
        end subroutine try

        logical function is_plain(changed)
            !! Nothing in it is known from the motion only.
            type(expression_t), intent(in) :: changed
            integer :: j

            is_plain = .true.
            do j = 1, size(samples%role)
                if (changed%depends_on(j)) is_plain = is_plain .and. samples%role(j) < 4
            end do
        end function is_plain

        subroutine replace(which, argument, changed)
            !! The functions at these nodes have another argument.
            logical, intent(in) :: which(:)
            type(expression_t), intent(in) :: argument
            type(expression_t), intent(out) :: changed
            integer :: at, j, place(0:expression%count)

            place(0) = 0
            call changed%append(argument, at)
            do j = 1, expression%count
                associate (node => expression%nodes(j))
                    select case (node%kind)
                    case (kind_number)
                        call changed%add_number(node%number, place(j))
                    case (kind_symbol)
                        call changed%add_symbol(node%which, place(j))
                    case default
                        call changed%add_operation(node%kind, merge(at, place(node%left), &
                                                                    which(j)), &
                                                   place(node%right), place(j), node%which)
                    end select
                end associate
            end do
            changed = changed%pruned(place(expression%count))
        end subroutine replace
    end subroutine try_arguments

    subroutine try_root(left, right, values, text)
        !! `T = 2 pi l/g`: the square of the left side is a number times the right one.
        type(expression_t), intent(in) :: left, right
        real(dp), intent(in) :: values(:, :)
        character(:), allocatable, intent(out) :: text
        real(dp) :: of_left(size(values, 1), left%count), of_right(size(values, 1), right%count)

        text = ""
        call evaluate_nodes(left, values, of_left)
        call evaluate_nodes(right, values, of_right)
        associate (ratio => of_left(:, left%count)**2/of_right(:, right%count))
            if (.not. all_finite(ratio)) return
            if (maxval(ratio) - minval(ratio) > equal*maxval(abs(ratio))) return
            if (.not. maxval(abs(ratio)) > 0.0_dp) return
            if (maxval(of_right(:, right%count)) - minval(of_right(:, right%count)) <= &
                equal*maxval(abs(of_right(:, right%count)))) return
            text = "a square root is missing"
            if (abs(ratio(1) - 1.0_dp) > equal) text = text//" behind '"//number_text(ratio(1))//"'"
        end associate
    end subroutine try_root

    subroutine try_letters(expression, samples, values, library, text)
        !! A term of letters alone is missing.
        type(expression_t), intent(in) :: expression
        type(samples_t), intent(in) :: samples
        real(dp), intent(in) :: values(:, :)
        type(library_t), intent(in) :: library(:)
        character(:), allocatable, intent(out) :: text
        type(letter_t), allocatable :: letters(:)
        type(expression_t) :: product
        real(dp) :: results(size(values, 1), expression%count)
        logical :: found

        text = ""
        call evaluate_nodes(expression, values, results)
        associate (needed => -results(:, expression%count))
            if (.not. is_steady(needed)) return
            if (maxval(needed) - minval(needed) <= equal*maxval(abs(needed))) return
            call gather_letters(samples, library, letters)
            call find_product(needed(1::states), letters, product, found)
        end associate
        if (found) text = missing(expression, formula_text(product, samples%symbols), &
                                  formula_text(simplified(-product, samples%symbols), &
                                               samples%symbols))
    end subroutine try_letters

    subroutine try_parts(expression, before, samples, values, library, text)
        !! A part, say a bracket, that lacks a product of letters.
        type(expression_t), intent(in) :: expression
        integer, intent(in) :: before      !! nodes of the left side
        type(samples_t), intent(in) :: samples
        real(dp), intent(in) :: values(:, :)
        type(library_t), intent(in) :: library(:)
        character(:), allocatable, intent(out) :: text
        real(dp), dimension(size(values, 1)) :: needed, of
        type(letter_t), allocatable :: letters(:)
        type(expression_t) :: product
        logical :: found
        integer :: i

        text = ""
        do i = merge(before + 1, 1, before == 1), expression%count - 1
            if (expression%nodes(i)%kind == kind_number) cycle
            call find_factor(values, needed, found)
            if (.not. found) cycle
            if (.not. is_steady(needed)) cycle
            if (.not. allocated(letters)) call gather_letters(samples, library, letters)
            call find_product(needed(1::states), letters, product, found)
            if (.not. found) cycle
            call find_factor(samples%elsewhere, of, found)
            if (found) found = all(abs(of - needed) <= equal*abs(needed))
            if (found .and. before > 1) cycle  ! it would say nothing of the motion
            text = part_text(expression, i, samples)//" lacks the factor '"// &
                   formula_text(product, samples%symbols)//"'"// &
                   context(expression, samples, i)
            return
        end do
    contains
        subroutine find_factor(at, factor, linear)
            !! So many times this node makes the whole zero, which is linear in it.
            real(dp), intent(in) :: at(:, :)
            real(dp), intent(out) :: factor(:)
            logical, intent(out) :: linear
            real(dp) :: once(size(at, 1), expression%count), twice(size(at, 1), expression%count)
            real(dp) :: three(size(at, 1), expression%count)
            integer :: n

            n = expression%count
            call evaluate_nodes(expression, at, once)
            call evaluate_nodes(expression, at, twice, change_t(change_factor, i, 0, 2.0_dp))
            call evaluate_nodes(expression, at, three, change_t(change_factor, i, 0, 3.0_dp))
            factor = 1.0_dp - once(:, n)/(twice(:, n) - once(:, n))
            linear = all(ieee_is_finite(factor) .and. abs(factor) > equal)
            if (linear) linear = all(abs(three(:, n) - 2.0_dp*twice(:, n) + once(:, n)) <= &
                                     equal*(abs(three(:, n)) + abs(twice(:, n)) + abs(once(:, n))))
        end subroutine find_factor
    end subroutine try_parts

    pure function is_steady(x) result(yes)
        !! The same number for all states with the same parameters.
        real(dp), intent(in) :: x(:)
        logical :: yes
        integer :: draw

        yes = all_finite(x)
        do draw = 1, draws
            associate (one => x((draw - 1)*states + 1:draw*states))
                if (yes) yes = maxval(one) - minval(one) <= equal*maxval(abs(one))
            end associate
        end do
    end function is_steady

    subroutine try_difference(left, right, samples, text)
        !! What the right side lacks, where the left one is an energy, a momentum or a derivative
        !! whose formula is known, and it is less than all of that.
        type(expression_t), intent(in) :: left, right
        type(samples_t), intent(in) :: samples
        character(:), allocatable, intent(out) :: text
        type(expression_t) :: difference, meaning(1), truth
        type(expression_t), allocatable :: energies(:)
        integer, allocatable :: nodes(:)
        real(dp), allocatable :: signs(:)
        integer :: k, places(4), terms

        text = ""
        if (left%count /= 1 .or. left%nodes(1)%kind /= kind_symbol) return
        places = energy_places(samples)
        k = findloc(places, left%nodes(1)%which, 1)
        if (k > 0) then
            call energy_formulas(samples, energies)
            truth = energies(k)
        else
            truth = written_out(left, samples)
        end if
        if (truth%count <= 1) return
        truth = simplified(truth, samples%symbols)
        call summands(truth, nodes, signs)
        terms = size(nodes)
        difference = simplified(truth - written_out(right, samples), samples%symbols)
        call summands(difference, nodes, signs)
        if (size(nodes) >= terms) return
        do k = 1, size(samples%compiled)  ! m for m_block
            associate (letter => samples%compiled(k))
                if (letter%formula%count /= 1 .or. samples%rate(letter%symbol) > 0) cycle
                meaning(1) = symbol(letter%symbol)
                difference = substituted(difference, [letter%formula%nodes(1)%which], meaning)
            end associate
        end do
        text = formula_text(difference, samples%symbols)
        if (len(text) > longest) then
            text = ""
        else
            text = "on the right is missing "//text
        end if
    end subroutine try_difference
end module lagrangia_further_slips
