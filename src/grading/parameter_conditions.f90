module lagrangia_parameter_conditions
    !! Lines that set a parameter of the system by a formula of others, or to 0: `i_roll = m r^2/2`,
    !! `l1 = l2`, `E_x = 0`. The lines behind are about systems for which that is true.
    use lagrangia_description, only: default_values, description_t, value_names
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, kind_difference, kind_symbol, &
                                    operator(-), symbol, whole
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_kinds, only: dp
    use lagrangia_motion_values, only: values_of
    use lagrangia_names, only: name_length
    use lagrangia_sample_names, only: role_parameter, samples_t
    use lagrangia_sampled_formula, only: evaluate_nodes
    use lagrangia_substitution, only: substituted
    use lagrangia_system, only: system_t
    use lagrangia_unknown_names, only: hidden
    implicit none (type, external)
    private
    public :: condition_t
    public :: find_condition, is_own_formula, put_condition, satisfy

    type :: condition_t
        !! A parameter, and what it is.
        integer :: symbol = 0          !! its place
        type(expression_t) :: formula  !! of other parameters
    end type condition_t

contains

    pure subroutine find_condition(residual, samples, condition)
        !! A parameter that varies, less a formula of others; a letter for one of them is that one.
        type(expression_t), intent(in) :: residual         !! left less right side
        type(samples_t), intent(in) :: samples             !! know no values of constants
        type(condition_t), intent(out) :: condition        !! the symbol 0: there is none
        type(condition_t) :: one
        integer :: k

        do k = 1, residual%count
            if (residual%nodes(k)%kind /= kind_symbol) cycle
            if (residual%nodes(k)%which > size(samples%role)) return  ! a constant of one line
        end do
        if (residual%count == 0) return
        if (residual%nodes(1)%kind /= kind_symbol) return
        if (residual%count == 1) then  ! E_x = 0
            one%formula = whole(0)
        else
            associate (last => residual%nodes(residual%count))
                if (last%kind /= kind_difference .or. last%left /= 1) return
                one%formula = without_letters(residual%pruned(last%right), samples)
            end associate
        end if
        one%symbol = residual%nodes(1)%which
        do k = 1, size(samples%compiled)
            associate (letter => samples%compiled(k))
                if (letter%symbol /= one%symbol .or. letter%formula%count /= 1) cycle
                if (letter%formula%nodes(1)%kind /= kind_symbol) return
                one%symbol = letter%formula%nodes(1)%which
            end associate
        end do
        if (.not. is_parameter(one%symbol) .or. one%formula%depends_on(one%symbol)) return
        if (.not. varies(one%symbol)) then  ! m1 = m2 behind `set: m1 = 1`
            k = one%symbol
            if (one%formula%count /= 1 .or. one%formula%nodes(1)%kind /= kind_symbol) return
            one%symbol = one%formula%nodes(1)%which
            one%formula = symbol(k)
            if (.not. is_parameter(one%symbol)) return
            if (.not. varies(one%symbol)) return
        end if
        if (.not. any([(one%formula%depends_on(k), k=1, size(samples%role))]) .and. &
            .not. one%formula%is_zero()) return
        do k = 1, size(samples%role)
            if (one%formula%depends_on(k) .and. .not. is_parameter(k)) return
        end do
        condition = one
    contains
        pure logical function is_parameter(which)
            !! And no letter for a formula, nor a constant of a motion?
            integer, intent(in) :: which

            is_parameter = samples%role(which) == role_parameter .and. &
                           samples%rate(which) == 0 .and. &
                           index(samples%symbols%names(which), hidden) == 0
            if (is_parameter) is_parameter = .not. any(samples%compiled%symbol == which)
        end function is_parameter

        pure logical function varies(which)
            integer, intent(in) :: which

            varies = minval(samples%values(:, which)) < maxval(samples%values(:, which))
        end function varies
    end subroutine find_condition

    function is_own_formula(condition, d, samples) result(yes)
        !! Is it what the system has for this parameter where nobody gives it a value?
        type(condition_t), intent(in) :: condition    !! of a sheet
        type(description_t), intent(in) :: d          !! of the system
        type(samples_t), intent(in) :: samples        !! with any parameters
        logical :: yes
        type(expression_t) :: formula
        type(error_t), allocatable :: error
        integer :: i

        yes = .false.
        do i = 1, size(d%parameters)
            if (d%parameters(i)%name /= samples%symbols%names(condition%symbol)) cycle
            if (d%parameters(i)%computed == "") return
            call parse_formula(trim(d%parameters(i)%computed), samples%symbols, formula, error)
            if (allocated(error)) return
            yes = all(abs(values_of(formula - condition%formula, samples%values)) <= &
                      1e-12_dp*abs(values_of(formula, samples%values)))
        end do
    end function is_own_formula

    pure function without_letters(expression, samples) result(e)
        !! With the parameters for which letters stand.
        type(expression_t), intent(in) :: expression
        type(samples_t), intent(in) :: samples
        type(expression_t) :: e, meaning(1)
        integer :: k

        e = expression
        do k = size(samples%compiled), 1, -1
            associate (letter => samples%compiled(k))
                if (letter%formula%count /= 1 .or. .not. e%depends_on(letter%symbol)) cycle
                meaning(1) = letter%formula
                e = substituted(e, [letter%symbol], meaning)
            end associate
        end do
    end function without_letters

    pure subroutine put_condition(condition, conditions)
        !! One more, or another one of the same parameter.
        type(condition_t), intent(in) :: condition                      !! what a line says
        type(condition_t), allocatable, intent(inout) :: conditions(:)  !! those of lines before
        type(condition_t), allocatable :: longer(:)
        integer :: i, n

        n = size(conditions)
        allocate (longer(n + 1))
        n = 0
        do i = 1, size(conditions)
            if (conditions(i)%symbol == condition%symbol) cycle
            n = n + 1
            longer(n) = conditions(i)
        end do
        longer(n + 1) = condition
        conditions = longer(:n + 1)
    end subroutine put_condition

    subroutine satisfy(conditions, samples, system, values, error)
        !! Give the parameters that have conditions their values.
        type(condition_t), intent(in) :: conditions(:)      !! of the sheet
        type(samples_t), intent(in) :: samples              !! know the names
        class(system_t), intent(inout) :: system            !! configured without them
        real(dp), intent(inout) :: values(:)                !! of its parameters
        type(error_t), allocatable, intent(out) :: error    !! it refuses them
        type(description_t) :: d
        real(dp), allocatable :: nodes(:, :), row(:, :)
        character(name_length), allocatable :: names(:)
        integer, allocatable :: places(:)
        integer :: i, turn

        call system%describe(d)
        allocate (names, source=value_names(d))
        places = [(samples%symbols%find(trim(names(i))), i=1, size(names))]
        allocate (row(1, size(samples%role)), source=0.0_dp)
        row(1, places) = default_values(d)
        do turn = 1, size(conditions)  ! one may use what another one gives
            do i = 1, size(conditions)
                allocate (nodes(1, conditions(i)%formula%count))
                call evaluate_nodes(conditions(i)%formula, row, nodes)
                row(1, conditions(i)%symbol) = nodes(1, size(nodes, 2))
                deallocate (nodes)
            end do
        end do
        do i = 1, size(places)
            if (any(conditions%symbol == places(i))) values(i) = row(1, places(i))
        end do
        call system%configure(values, error)
    end subroutine satisfy
end module lagrangia_parameter_conditions
