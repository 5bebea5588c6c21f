module lagrangia_term_search
    !! Which term of a wrong statement must be counted otherwise, or has a letter, a dot or a
    !! function too many or too few; which one is missing.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_canonical_form, only: simplified
    use lagrangia_expression, only: expression_t, kind_difference, kind_function, kind_symbol, &
                                    operator(*), operator(-), operator(/), symbol
    use lagrangia_formula_text, only: formula_text, typed_name
    use lagrangia_kinds, only: dp
    use lagrangia_letter_products, only: add_letters, collect_letters, find_product, letter_t
    use lagrangia_number_class, only: all_finite, is_nonzero, is_zero
    use lagrangia_sample_names, only: draws, role_known, role_parameter, role_velocity, samples_t, &
                                      states
    use lagrangia_sampled_formula, only: evaluate_nodes, summands
    use lagrangia_simple_numbers, only: is_simple, number_text, times
    implicit none (type, external)
    private
    public :: library_t
    public :: gather_letters
    public :: context, is_name_alone, missing, part_text
    public :: try_factors, try_missing_terms, try_products

    real(dp), parameter :: equal = 1e-7_dp  !! relative difference of factors that are one
    real(dp), parameter :: small_velocity = 1e-4_dp  !! of which only the first order counts
    integer, parameter :: enough = 4        !! samples at which all is finite
    integer, parameter :: most_divisors = 4  !! coordinates by which an equation may be divided

    type :: library_t
        !! A right term, of an equation that the page has.
        type(expression_t) :: term
    end type library_t

contains

    function part_text(expression, i, samples) result(text)
        !! `'m2 g l sin(theta)'`: what node `i` stands for.
        type(expression_t), intent(in) :: expression  !! of the samples' symbols
        integer, intent(in) :: i                      !! place of the node
        type(samples_t), intent(in) :: samples        !! know the names
        character(:), allocatable :: text
        type(expression_t) :: part

        part = expression%pruned(i)
        text = formula_text(part, samples%symbols)
        if (part%count == 1) text = typed_name(text)
        text = "'"//text//"'"
    end function part_text

    function context(expression, samples, i) result(text)
        !! ` in 'the summand'`, where node `i` is only a part of one.
        type(expression_t), intent(in) :: expression  !! left side less right side
        type(samples_t), intent(in) :: samples        !! know the names
        integer, intent(in) :: i                      !! a node
        character(:), allocatable :: text
        integer, allocatable :: nodes(:)
        real(dp), allocatable :: signs(:)
        integer :: k, n

        text = ""
        call summands(expression, nodes, signs)
        do k = 1, size(nodes)
            if (nodes(k) <= i) cycle
            n = nodes(k)
            if (.not. contains_node(expression, n, i)) cycle
            text = " in "//part_text(expression, n, samples)
            return
        end do
    end function context

    pure function contains_node(expression, root, i) result(yes)
        !! Is node `i` a part of what is at `root`?
        type(expression_t), intent(in) :: expression
        integer, intent(in) :: root, i
        logical :: yes
        logical :: needed(0:expression%count)
        integer :: k

        needed = .false.
        needed(root) = .true.
        do k = root, i + 1, -1
            if (.not. needed(k)) cycle
            needed(expression%nodes(k)%left) = .true.
            needed(expression%nodes(k)%right) = .true.
        end do
        yes = needed(i)
    end function contains_node

    subroutine try_factors(expression, first, samples, values, library, remark, is_surplus, &
                           is_vague)
        !! A summand that must be counted another number of times, or has a letter, a dot or a
        !! function too few or too many, or does not belong there.
        type(expression_t), intent(in) :: expression      !! left side less right side, wrong
        integer, intent(in) :: first                      !! nodes before it are right
        type(samples_t), intent(in) :: samples            !! know the names
        real(dp), intent(in) :: values(:, :)              !! on the motion, (samples, symbols)
        type(library_t), intent(in) :: library(:)         !! right terms
        character(:), allocatable, intent(out) :: remark  !! "" if it is not that
        logical, intent(out) :: is_surplus                !! it does not belong there
        logical, intent(out) :: is_vague                  !! a factor that stands for a formula
        real(dp), allocatable :: results(:, :), signs(:), needed(:), term(:, :)
        integer, allocatable :: nodes(:)
        character(:), allocatable :: text
        integer :: k, turn
        logical :: small

        remark = ""
        is_surplus = .false.
        is_vague = .false.
        allocate (results(size(values, 1), expression%count), needed(size(values, 1)))
        call evaluate_nodes(expression, values, results)
        call summands(expression, nodes, signs)
        if (size(nodes) < 2) return
        small = is_of_small_motion(samples, values)
        do turn = 1, 2  ! a name for the other side, or what a term has not, only if that is all
            do k = 1, size(nodes)
                if (nodes(k) < first .or. is_subject(expression, nodes(k), samples)) cycle
                if (turn == 1 .and. is_name_alone(expression, nodes(k))) cycle
                call find_needed(results, nodes, signs, k, small, needed, is_surplus)
                text = part_text(expression, nodes(k), samples)
                if (count(ieee_is_finite(needed)) < enough) cycle
                call try_summand()
                if (remark /= "") return
            end do
        end do
    contains
        subroutine try_summand()
            !! The one at hand, `nodes(k)`.
            type(expression_t) :: part
            integer :: i, m, pass

            if (is_surplus) then
                remark = text//" does not belong there"
                if (is_alone(k)) remark = text//" is not 0"
            else if (is_constant(needed)) then
                if (is_simple(needed(1))) remark = text//" must be counted "// &
                                                   number_text(needed(1))//" times"
            end if
            if (remark /= "") return
            part = expression%pruned(nodes(k))
            do pass = 1, 2  ! the statement's own letters first
                do i = 1, size(samples%role)
                    if (samples%role(i) > role_parameter) cycle
                    if (expression%depends_on(i) .neqv. pass == 1) cycle
                    if (makes_same_sides(i)) cycle
                    call try_letter(values(:, i), "'"//trim(samples%symbols%names(i))//"'", &
                                    part%depends_on(i))
                    if (remark == "") cycle
                    do m = 1, size(samples%compiled)
                        is_vague = is_vague .or. (samples%compiled(m)%symbol == i .and. &
                                                  samples%compiled(m)%formula%count > 1)
                    end do
                    return
                end do
            end do
            do i = 1, size(library)
                do m = 1, library(i)%term%count
                    if (library(i)%term%nodes(m)%kind /= kind_function) cycle
                    if (allocated(term)) deallocate (term)
                    allocate (term(size(values, 1), library(i)%term%count))
                    call evaluate_nodes(library(i)%term, values, term)
                    call try_letter(term(:, m), part_text(library(i)%term, m, samples), .false.)
                    if (remark /= "") return
                end do
            end do
        end subroutine try_summand

        logical function makes_same_sides(letter)
            !! Of two terms, is one this letter alone? With it in the other, theta = theta.
            integer, intent(in) :: letter

            makes_same_sides = size(nodes) == 2 .and. &
                any(expression%nodes(nodes)%kind == kind_symbol .and. &
                    expression%nodes(nodes)%which == letter)
        end function makes_same_sides

        logical function is_alone(at)
            !! Are all other summands 0?
            integer, intent(in) :: at
            integer :: j

            is_alone = all([(j == at .or. all(.not. is_nonzero(results(:, nodes(j)))), &
                             j=1, size(nodes))])
        end function is_alone

        subroutine try_letter(letter, name, is_there)
            real(dp), intent(in) :: letter(:)
            character(*), intent(in) :: name
            logical, intent(in) :: is_there  !! the summand has it
            real(dp) :: one(size(letter))
            logical :: is_number

            is_number = is_constant(letter)  ! and any number is one of several times this one
            one = needed/letter
            if (is_constant(one) .and. is_likely(one(1), is_number)) then
                remark = text//" lacks the factor "//times(one(1))//name
                return
            end if
            if (turn == 1 .and. .not. is_there) return
            one = needed*letter
            if (is_constant(one) .and. is_likely(one(1), is_number)) then
                remark = text//" has the factor "//name//" too many"
                if (abs(one(1) - 1.0_dp) > equal .or. .not. is_there) then
                    remark = text//" must be divided by "//times(1.0_dp/one(1))//name
                end if
            end if
        end subroutine try_letter

        logical function is_likely(factor, is_number)
            real(dp), intent(in) :: factor
            logical, intent(in) :: is_number  !! the letter has one value

            is_likely = is_simple(factor)
            if (is_number) is_likely = abs(abs(factor) - 1.0_dp) < equal
        end function is_likely
    end subroutine try_factors

    subroutine try_products(expression, first, samples, values, library, remark)
        !! A summand that has several letters too few or too many.
        type(expression_t), intent(in) :: expression      !! left side less right side, wrong
        integer, intent(in) :: first                      !! nodes before it are right
        type(samples_t), intent(in) :: samples            !! know the names
        real(dp), intent(in) :: values(:, :)              !! on the motion, (samples, symbols)
        type(library_t), intent(in) :: library(:)         !! right terms
        character(:), allocatable, intent(out) :: remark  !! "" if it is not that
        real(dp), allocatable :: results(:, :), signs(:), needed(:)
        integer, allocatable :: nodes(:)
        type(letter_t), allocatable :: letters(:)
        type(expression_t) :: product
        logical :: found, is_surplus, small
        integer :: k

        remark = ""
        call summands(expression, nodes, signs)
        if (size(nodes) < 2) return
        call prepare(expression, samples, values, library, results, letters)
        small = is_of_small_motion(samples, values)
        do k = 1, size(nodes)
            if (nodes(k) < first .or. is_subject(expression, nodes(k), samples)) cycle
            call find_needed(results, nodes, signs, k, small, needed, is_surplus)
            if (is_surplus .or. .not. is_steady(needed) .or. any(is_zero(needed))) cycle
            call find_product(needed(1::states), letters, product, found)
            if (.not. found) cycle
            remark = part_text(expression, nodes(k), samples)//" lacks the factor '"// &
                     formula_text(product, samples%symbols)//"'"
            return
        end do
    end subroutine try_products

    pure subroutine find_needed(results, nodes, signs, k, small, needed, is_surplus)
        !! So many times one summand makes the sum zero. It is not needed at all where the others
        !! cancel, however large it is beside them, or are of higher order in a small motion.
        real(dp), intent(in) :: results(:, :)              !! (samples, nodes)
        integer, intent(in) :: nodes(:)                    !! the summands
        real(dp), intent(in) :: signs(:)                   !! theirs
        integer, intent(in) :: k                           !! which one
        logical, intent(in) :: small                       !! the samples are of a small motion
        real(dp), allocatable, intent(out) :: needed(:)    !! at each sample
        logical, intent(out) :: is_surplus                 !! the sum is zero without it
        real(dp), dimension(size(results, 1)) :: others, sizes
        integer :: j

        others = 0.0_dp
        sizes = 0.0_dp
        do j = 1, size(nodes)
            if (j == k) cycle
            others = others + signs(j)*results(:, nodes(j))
            sizes = sizes + abs(results(:, nodes(j)))
        end do
        needed = -signs(k)*others/results(:, nodes(k))
        is_surplus = all(abs(needed) < equal) .and. (small .or. all(abs(others) <= equal*sizes))
    end subroutine find_needed

    pure function is_of_small_motion(samples, values) result(yes)
        !! Does nothing but a small motion go on there?
        type(samples_t), intent(in) :: samples        !! know the velocities
        real(dp), intent(in) :: values(:, :)          !! (samples, symbols)
        logical :: yes
        integer :: k

        yes = all(abs(values(:, pack([(k, k=1, size(samples%role))], &
                                     samples%role == role_velocity))) < small_velocity)
    end function is_of_small_motion

    pure function is_subject(expression, i, samples) result(yes)
        !! Is node `i` a name that the statement is about: an energy, a momentum, omega?
        type(expression_t), intent(in) :: expression
        integer, intent(in) :: i
        type(samples_t), intent(in) :: samples
        logical :: yes

        yes = expression%nodes(i)%kind == kind_symbol
        if (yes) yes = samples%role(expression%nodes(i)%which) >= role_known
    end function is_subject

    subroutine try_missing_terms(expression, samples, values, library, remark, lacks, is_vague)
        !! A right term which, some times, perhaps with letters, makes the sum zero. Without the
        !! letters it is named only if it varies with the state, for of constants alone any would
        !! do, and is not there in some number.
        type(expression_t), intent(in) :: expression      !! left side less right side, wrong
        type(samples_t), intent(in) :: samples            !! know the names
        real(dp), intent(in) :: values(:, :)              !! on the motion, (samples, symbols)
        type(library_t), intent(in) :: library(:)         !! right terms
        character(:), allocatable, intent(out) :: remark  !! "" if it is not that
        character(:), allocatable, intent(out) :: lacks   !! what the left side lacks, if known
        logical, intent(out) :: is_vague                  !! it lacks something with a right term
        character(:), allocatable :: on_right
        real(dp), allocatable :: results(:, :), term(:, :), needed(:)
        type(letter_t), allocatable :: letters(:)
        type(expression_t) :: product, right
        logical :: found
        integer :: j, k

        remark = ""
        is_vague = .false.
        on_right = ""
        call prepare(expression, samples, values, library, results, letters)
        search: do j = 0, min(samples%ndof, most_divisors)
            do k = 1, size(library)
                right = library(k)%term
                if (j > 0) then  ! an equation may have been divided by r
                    if (.not. right%depends_on(1 + j)) cycle
                    right = simplified(right/symbol(1 + j), samples%symbols)
                end if
                if (allocated(term)) deallocate (term)
                allocate (term(size(values, 1), right%count))
                call evaluate_nodes(right, values, term)
                needed = -results(:, expression%count)/term(:, right%count)
                if (.not. is_steady(needed) .or. any(abs(needed) < equal)) cycle
                if (is_constant(needed) .and. is_simple(needed(1))) then
                    lacks = times(needed(1))//formula_text(right, samples%symbols)
                    on_right = times(-needed(1))//formula_text(right, samples%symbols)
                    exit search
                end if
                if (remark == "" .and. j == 0 .and. .not. is_constant(needed) .and. &
                    .not. is_steady(term(:, right%count))) then
                    is_vague = .true.
                    if (.not. is_there()) remark = "a term with "// &
                        formula_text(right, samples%symbols)//" is missing"
                end if
                call find_product(needed(1::states), letters, product, found)
                if (.not. found) cycle
                product = simplified(product*right, samples%symbols)
                lacks = formula_text(product, samples%symbols)
                on_right = formula_text(simplified(-product, samples%symbols), samples%symbols)
                exit search
            end do
        end do search
        is_vague = is_vague .and. .not. allocated(lacks)
        if (allocated(lacks)) remark = missing(expression, lacks, on_right)
    contains
        logical function is_there()
            !! Some summand is this term but for a factor.
            integer, allocatable :: nodes(:)
            real(dp), allocatable :: signs(:)
            integer :: i

            call summands(expression, nodes, signs)
            is_there = any([(is_steady(results(:, nodes(i))/term(:, right%count)), &
                             i=1, size(nodes))])
        end function is_there
    end subroutine try_missing_terms

    pure function missing(expression, on_left, on_right) result(text)
        !! What is missing, said of the right side where the left one is a name alone.
        type(expression_t), intent(in) :: expression        !! left side less right side
        character(*), intent(in) :: on_left, on_right       !! on either side
        character(:), allocatable :: text

        text = "on the left is missing "//on_left
        associate (root => expression%nodes(expression%count))
            if (is_name_alone(expression, root%left)) text = "on the right is missing "//on_right
        end associate
    end function missing

    pure function is_name_alone(expression, i) result(yes)
        !! Is node `i` all of the left side, a name?
        type(expression_t), intent(in) :: expression  !! left side less right side
        integer, intent(in) :: i                      !! place of the node, or 0
        logical :: yes

        associate (root => expression%nodes(expression%count))
            yes = root%kind == kind_difference .and. i == root%left
            if (yes) yes = expression%nodes(i)%kind == kind_symbol
        end associate
    end function is_name_alone

    subroutine prepare(expression, samples, values, library, results, letters)
        !! The values of all nodes, and the letters of which a factor may consist.
        type(expression_t), intent(in) :: expression
        type(samples_t), intent(in) :: samples
        real(dp), intent(in) :: values(:, :)
        type(library_t), intent(in) :: library(:)
        real(dp), allocatable, intent(out) :: results(:, :)
        type(letter_t), allocatable, intent(out) :: letters(:)

        allocate (results(size(values, 1), expression%count))
        call evaluate_nodes(expression, values, results)
        call gather_letters(samples, library, letters)
    end subroutine prepare

    subroutine gather_letters(samples, library, letters)
        !! Parameters, and their sums that occur in right terms.
        type(samples_t), intent(in) :: samples                      !! know the parameters
        type(library_t), intent(in) :: library(:)                   !! right terms
        type(letter_t), allocatable, intent(out) :: letters(:)      !! of which factors consist
        integer :: i

        call collect_letters(samples, letters)
        do i = 1, size(library)
            call add_letters(samples, library(i)%term, letters)
        end do
    end subroutine gather_letters

    pure function is_steady(x) result(yes)
        !! The same finite number for all states with the same parameters.
        real(dp), intent(in) :: x(:)
        logical :: yes
        integer :: draw

        yes = .true.
        do draw = 1, draws
            yes = yes .and. is_constant(x((draw - 1)*states + 1:draw*states))
        end do
    end function is_steady

    pure function is_constant(x) result(yes)
        !! The same finite number, but for rounding, at all samples that count.
        real(dp), intent(in) :: x(:)
        logical :: yes

        yes = .false.
        if (.not. all_finite(x)) return
        yes = maxval(x) - minval(x) <= equal*max(maxval(abs(x)), 1e-3_dp)
    end function is_constant
end module lagrangia_term_search
