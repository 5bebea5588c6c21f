module lagrangia_grading
    !! A whole sheet: every statement judged, and whether the right ones determine the motion.
    use lagrangia_canonical_form, only: simplified
    use lagrangia_declared_constants, only: add_constant, declare_speed, has_place
    use lagrangia_derivative, only: derivative, time_derivative
    use lagrangia_description, only: description_t
    use lagrangia_determined_accelerations, only: find_determined
    use lagrangia_errors, only: error_t, fail
    use lagrangia_expression, only: expression_t, kind_number
    use lagrangia_formula_characters, only: plain_letters
    use lagrangia_formula_parser, only: parse_equation, parse_formula
    use lagrangia_homework, only: homework_t
    use lagrangia_judged_sheet, only: judge_sheet
    use lagrangia_judgement, only: is_consequence, is_definition, is_right, is_wrong, &
                                   judgement_t
    use lagrangia_kinds, only: dp
    use lagrangia_motion_samples, only: new_samples
    use lagrangia_motion_values, only: is_frequency_name
    use lagrangia_names, only: name_length
    use lagrangia_parameter_choice, only: leave_out, occurs
    use lagrangia_parameter_conditions, only: condition_t, find_condition, is_own_formula, &
                                               put_condition
    use lagrangia_sample_names, only: samples_t
    use lagrangia_sampled_formula, only: summands
    use lagrangia_stated_motion, only: rests_on_right, take_from_start
    use lagrangia_symbols, only: check_name
    use lagrangia_system, only: system_t
    use lagrangia_term_search, only: library_t
    use lagrangia_text, only: append_word, quoted, short_source, to_text, word_t
    use lagrangia_unknown_names, only: unknown_names
    use lagrangia_usual_meanings, only: force_readings, multiplier_readings
    implicit none (type, external)
    private
    public :: grade_t
    public :: grade

    integer, parameter :: most_sides = 4       !! of a line between parameters
    integer, parameter :: most_derived = 3     !! coordinates of which all momenta are written
    integer, parameter :: most_constants = 20  !! of motions that a sheet writes out

    type :: grade_t
        !! Of one sheet.
        type(judgement_t), allocatable :: of(:)  !! its statements, in their order
        character(:), allocatable :: kept        !! parameters that nobody named, and that are zero
        character(:), allocatable :: meaning     !! of omega and gamma where there is drag
        integer :: equations = 0                 !! right ones that have accelerations in them
        logical, allocatable :: determined(:)
        !! the acceleration of this coordinate follows, (ndof)
    end type grade_t

contains

    subroutine grade(homework, system, result, error)
        !! Judge every statement of `homework` about `system`.
        class(system_t), intent(in), target :: system     !! configured
        type(homework_t), intent(in) :: homework          !! as read
        type(grade_t), intent(out) :: result              !! a judgement of each statement
        type(error_t), allocatable, intent(out) :: error  !! the system has no states to try
        type(samples_t) :: samples
        type(library_t), allocatable :: library(:)
        type(judgement_t), allocatable :: attempt(:)
        type(description_t) :: d
        type(word_t), allocatable :: insisted(:), readings(:)
        character(*), parameter :: inside = "abcdefghijklmnopqrstuvwxyz"// &
            "ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789"
        character(:), allocatable :: plain, said
        logical :: small(size(homework%statements))  ! they hold to first order only
        integer :: i, k

        said = ""
        do i = 1, size(homework%statements)
            plain = plain_letters(homework%statements(i)%text)
            k = index(plain, "=")
            if (k > 1) then
                if (adjustl(plain(k + 1:)) == "0" .and. verify(trim(adjustl(plain(:k - 1))), &
                    inside) == 0) cycle  ! `b = 0`
            end if
            do k = 1, size(homework%constants)  ! `constant: beta` speaks of no drag
                call leave_out(homework%constants(k)%text, plain)
            end do
            said = said//" "//plain
        end do
        call new_samples(system, said, homework%settings, samples, error, calls_it_omega(homework))
        if (.not. allocated(error)) call declare_constants(homework, samples, error)
        if (allocated(error)) return
        call find_motion_constants(homework, samples)
        call declare_speed(said, samples)
        call system%describe(d)
        call collect_terms(system, samples, library)
        allocate (insisted(0))
        call judge_sheet(homework, d, insisted, samples, library, result%of)
        do i = 1, size(homework%statements)
            if (.not. result%of(i)%contradicts) cycle
            call insist(trim(result%of(i)%defines), i)
            if (result%of(i)%contradicts) call insist_on_force(trim(result%of(i)%defines), i)
        end do
        call multiplier_readings(d, readings)
        do i = 1, size(readings)
            if (.not. is_wrong_with("lambda")) exit
            call insist(readings(i)%text, 0)
        end do
        call take_from_start(homework, system, d, insisted, samples, library, result%of)
        call take_conditions(homework, system, d, said, insisted, library, samples, result%of)
        do i = 1, size(result%of)
            if (rests_on_right(i, result%of)) call result%of(i)%stand_alone()
        end do
        result%kept = samples%kept
        call explain_rates(samples, said, result%meaning)
        small = homework%statements%small
        call find_determined(samples, result%of, small, result%equations, result%determined)
    contains
        subroutine insist(name, line)
            !! The sheet with a name in its usual meaning, if that is better.
            character(*), intent(in) :: name
            integer, intent(in) :: line  !! that defines it otherwise; 0: none
            integer :: j

            call append_word(insisted, name)
            call judge_sheet(homework, d, insisted, samples, library, attempt)
            if (is_better(attempt, result%of, line)) then
                do j = 1, size(result%of)
                    result%of(j) = attempt(j)
                end do
            else
                insisted = insisted(:size(insisted) - 1)
            end if
        end subroutine insist

        subroutine insist_on_force(name, line)
            !! The same, where the name may stand for a force.
            character(*), intent(in) :: name
            integer, intent(in) :: line
            type(word_t), allocatable :: forces(:)
            integer :: j

            call force_readings(name, d, forces)
            do j = 1, size(forces)
                if (result%of(line)%contradicts) call insist(forces(j)%text, line)
            end do
        end subroutine insist_on_force

        logical function is_wrong_with(name)
            !! Is a line wrong that speaks of `name`?
            character(*), intent(in) :: name
            integer :: j

            is_wrong_with = .false.
            do j = 1, size(result%of)
                if (result%of(j)%verdict == is_wrong) is_wrong_with = is_wrong_with .or. &
                    occurs(plain_letters(homework%statements(j)%text), name)
            end do
        end function is_wrong_with
    end subroutine grade

    subroutine take_conditions(homework, system, d, said, insisted, library, samples, result)
        !! Behind `i_roll = m r^2/2` the lines are about systems for which that is true.
        type(homework_t), intent(in) :: homework
        class(system_t), intent(in), target :: system
        type(description_t), intent(in) :: d
        character(*), intent(in) :: said               !! all statements
        type(word_t), intent(in) :: insisted(:)
        type(library_t), intent(in) :: library(:)
        type(samples_t), intent(inout) :: samples      !! become those of the last line
        type(judgement_t), intent(inout) :: result(:)  !! of each statement
        type(condition_t), allocatable :: conditions(:)
        type(condition_t) :: condition
        type(samples_t) :: there
        type(judgement_t), allocatable :: attempt(:)
        type(error_t), allocatable :: error
        integer :: i, k, side

        allocate (conditions(0))
        do i = 1, size(result)
            do side = 1, most_sides  ! `m1 = m2 = m3` says two things
                if (result(i)%verdict == is_right .or. result(i)%verdict == is_definition) exit
                if (homework%statements(i)%small .or. result(i)%of_constant) exit
                call find_condition(result(i)%residual, samples, condition)
                if (condition%symbol == 0) exit
                call put_condition(condition, conditions)
                call new_samples(system, said, homework%settings, there, error, &
                                 calls_it_omega(homework), conditions)
                if (.not. allocated(error)) call declare_constants(homework, there, error)
                if (allocated(error)) return
                call find_motion_constants(homework, there)
                call declare_speed(said, there)
                call judge_sheet(homework, d, insisted, there, library, attempt)
                call take_from_start(homework, system, d, insisted, there, library, attempt)
                if (is_own_formula(condition, d, samples)) call take_before(i)
                do k = i, size(result)
                    result(k) = attempt(k)
                end do
                samples = there
                if (result(i)%verdict /= is_right) cycle
                result(i)%verdict = is_definition
                result(i)%of_motion = .false.
                result(i)%remark = "a condition between parameters, for the lines behind it"
            end do
        end do
    contains
        subroutine take_before(last)
            !! What the system has anyway may be used before it is said.
            integer, intent(in) :: last
            integer :: j

            do j = 1, last - 1
                if (result(j)%verdict == is_right .or. attempt(j)%verdict /= is_right) cycle
                if (result(j)%verdict == is_definition) cycle
                result(j) = attempt(j)
                if (result(j)%remark == "") result(j)%remark = "with line "// &
                    to_text(homework%statements(last)%line)
            end do
        end subroutine take_before
    end subroutine take_conditions

    pure function is_better(attempt, result, i) result(yes)
        !! Are more statements right if line `i` is no definition, and none of them less?
        type(judgement_t), intent(in) :: attempt(:), result(:)
        integer, intent(in) :: i
        logical :: yes
        integer :: k

        yes = .false.
        do k = 1, size(result)
            associate (now => attempt(k)%verdict, before => result(k)%verdict)
                if (k == i) cycle
                yes = yes .or. (now == is_right .and. (before == is_wrong .or. &
                                                       before == is_consequence))
                if (before /= now .and. (before == is_right .or. before == is_definition)) then
                    yes = .false.
                    return
                end if
            end associate
        end do
    end function is_better

    subroutine declare_constants(homework, samples, error)
        !! The names behind `constant:`.
        type(homework_t), intent(in) :: homework
        type(samples_t), intent(inout) :: samples
        type(error_t), allocatable, intent(out) :: error  !! one of them has a meaning here
        integer :: i

        do i = 1, size(homework%constants)
            associate (name => homework%constants(i)%text)
                call check_name(name, error)
                if (.not. allocated(error) .and. samples%symbols%find(name) > 0) call fail( &
                    error, quoted(name)//" has a meaning here; call the constant another name")
                if (allocated(error)) then
                    call error%add_context(trim(short_source(homework%source))//":"// &
                                           to_text(homework%constant_lines(i))//": constant")
                    return
                end if
                call add_constant(name, .true., samples)
            end associate
        end do
    end subroutine declare_constants

    subroutine find_motion_constants(homework, samples)
        !! Names that nobody knows in lines that write out a motion or say how it begins.
        type(homework_t), intent(in) :: homework
        type(samples_t), intent(inout) :: samples
        character(name_length), allocatable :: names(:)
        character(:), allocatable :: side
        integer :: equals, found, i, k, place
        logical :: begins

        found = 0
        do i = 1, size(homework%statements)
            associate (text => homework%statements(i)%text)
                equals = index(text, "=")
                if (equals < 2) cycle
                side = trim(adjustl(plain_letters(text(:equals - 1))))
                if (index(side, "(") > 0) side = side(:index(side, "(") - 1)
                place = samples%symbols%find(samples%symbols%spelling(side))
                if (place < 2 .or. place > 1 + 2*samples%ndof) cycle
                if (.not. occurs(plain_letters(text), "t") .and. index(text, "(0)") == 0) cycle
                begins = index(text(:equals), "(0)") > 0
                call unknown_names(text(equals + 1:), samples%symbols, names)
            end associate
            do k = 1, size(names)
                if (has_place(samples, names(k)) .or. found == most_constants) cycle
                if (is_frequency_name(names(k), samples) .and. .not. begins) cycle
                call add_constant(trim(names(k)), .false., samples)
                found = found + 1
            end do
        end do
    end subroutine find_motion_constants

    pure function calls_it_omega(homework) result(yes)
        !! A line such as `omega = theta_dot` gives the name omega to what moves.
        type(homework_t), intent(in) :: homework
        logical :: yes
        character(:), allocatable :: plain
        integer :: equals, i

        yes = .false.
        do i = 1, size(homework%statements)
            plain = plain_letters(homework%statements(i)%text)
            equals = index(plain, "=")
            if (equals < 2) cycle
            if (adjustl(plain(:equals - 1)) /= "omega") cycle
            yes = yes .or. index(plain(equals:), "_dot") > 0 .or. index(plain(equals:), "'") > 0 &
                  .or. occurs(plain(equals:), "v")
        end do
    end function calls_it_omega

    pure subroutine explain_rates(samples, said, meaning)
        !! What omega and gamma are, if there is drag and the sheet speaks of them.
        type(samples_t), intent(in) :: samples
        character(*), intent(in) :: said                     !! all statements
        character(:), allocatable, intent(out) :: meaning    !! empty, or one line
        character(:), allocatable :: decay, frequency

        meaning = ""
        if (samples%decay == 0) return
        decay = trim(samples%symbols%names(samples%decay))
        frequency = trim(samples%symbols%names(samples%frequency))
        if (index(said, decay) == 0 .and. index(said, frequency) == 0) return
        meaning = "with the drag q goes as exp(-"//decay//" t) cos("//frequency//" t); "// &
                  frequency//"_0 is without it"
    end subroutine explain_rates

    subroutine collect_terms(system, samples, library)
        !! The terms of all formulas that the system prints, without signs.
        class(system_t), intent(in) :: system
        type(samples_t), intent(in) :: samples
        type(library_t), allocatable, intent(out) :: library(:)
        type(description_t) :: d
        type(expression_t) :: left, right
        type(error_t), allocatable :: error
        integer :: i

        allocate (library(0))
        call system%describe(d)
        if (allocated(d%equations)) then
            do i = 1, size(d%equations)
                call parse_equation(trim(d%equations(i)), samples%symbols, left, right, error)
                if (allocated(error)) cycle
                call add_terms(left, library)
                call add_terms(right, library)
            end do
        end if
        if (allocated(d%lagrangian)) call add_formula(d%lagrangian)
        if (allocated(d%lagrangian)) call add_derivatives(d%lagrangian)
        if (allocated(d%kinetic_energy)) call add_formula(d%kinetic_energy)
        if (allocated(d%potential_energy)) call add_formula(d%potential_energy)
        if (allocated(d%energy)) call add_formula(d%energy)
        do i = 1, size(d%quantities)
            call add_formula(trim(d%quantities(i)%formula))
        end do
        if (samples%decay > 0) call add_formula(trim(samples%symbols%names(samples%decay))//"^2")
    contains
        subroutine add_derivatives(text)
            !! The momenta, their rates, and what these are.
            character(*), intent(in) :: text
            type(expression_t) :: momentum
            integer :: j

            call parse_formula(text, samples%symbols, left, error)
            if (allocated(error) .or. samples%ndof > most_derived) return
            do j = 1, samples%ndof
                momentum = simplified(derivative(left, 1 + samples%ndof + j), samples%symbols)
                call add_terms(momentum, library)
                call add_terms(simplified(time_derivative(momentum, samples%rate, 1), &
                                          samples%symbols), library)
                call add_terms(simplified(derivative(left, 1 + j), samples%symbols), library)
            end do
        end subroutine add_derivatives

        subroutine add_formula(text)
            character(*), intent(in) :: text

            if (text == "") return
            call parse_formula(text, samples%symbols, left, error)
            if (.not. allocated(error)) call add_terms(left, library)
        end subroutine add_formula
    end subroutine collect_terms

    subroutine add_terms(expression, library)
        !! Its summands, without their signs.
        type(expression_t), intent(in) :: expression
        type(library_t), allocatable, intent(inout) :: library(:)
        type(library_t), allocatable :: longer(:)
        integer, allocatable :: nodes(:)
        real(dp), allocatable :: signs(:)
        integer :: i, k, n

        call summands(expression, nodes, signs)
        do k = 1, size(nodes)
            if (expression%nodes(nodes(k))%kind == kind_number) cycle
            n = size(library)
            allocate (longer(n + 1))
            do i = 1, n
                call move_alloc(library(i)%term%nodes, longer(i)%term%nodes)
                longer(i)%term%count = library(i)%term%count
            end do
            longer(n + 1)%term = expression%pruned(nodes(k))
            call move_alloc(longer, library)
        end do
    end subroutine add_terms
end module lagrangia_grading
