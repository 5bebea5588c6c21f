module lagrangia_stated_starts
    !! Initial conditions are given: a motion that is written out behind them must begin so.
    use lagrangia_derivative, only: derivative
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, operator(-), symbol, whole
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_kinds, only: dp
    use lagrangia_motion_values, only: rate_of
    use lagrangia_names, only: name_length
    use lagrangia_sample_names, only: samples_t, start_t
    use lagrangia_slip_search, only: holds
    use lagrangia_substitution, only: substituted
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: to_text
    use lagrangia_unknown_names, only: add_unknown, unknown_names
    use lagrangia_verdict, only: is_definition, is_right, is_wrong, judgement_t, one_of_many
    implicit none (type, external)
    private
    public :: compare_start, find_stated, is_given, state_start

contains

    pure function is_stated_anew(coordinate, order, samples) result(yes)
        !! Where it is stated once more behind a motion, another part of the sheet begins.
        integer, intent(in) :: coordinate         !! which begins
        integer, intent(in) :: order              !! of its derivative, 0 or 1
        type(samples_t), intent(in) :: samples    !! know the conditions
        logical :: yes
        integer :: i

        yes = .false.
        do i = 1, size(samples%starts)
            associate (start => samples%starts(i))
                if (start%coordinate == coordinate .and. start%order == order) yes = start%used
            end associate
        end do
    end function is_stated_anew

    subroutine state_start(coordinate, order, value, samples, judgement)
        !! One more condition, or another one in its place; another part of the sheet has conditions
        !! of its own. It is given, but for one that contradicts the motion of a line before.
        integer, intent(in) :: coordinate           !! which begins
        integer, intent(in) :: order                !! of its derivative, 0 or 1
        character(*), intent(in) :: value           !! the right side, as typed
        type(samples_t), intent(inout) :: samples   !! remember it
        type(judgement_t), intent(inout) :: judgement  !! of the line
        type(start_t), allocatable :: longer(:)
        type(expression_t) :: nothing
        logical :: anew
        integer :: i, n

        do i = 1, size(samples%starts)
            ! `x(0) = A cos(phi)` says what the motion is that begins as `x(0) = x_0` said
            if (judgement%verdict /= is_right) exit
            if (samples%starts(i)%coordinate /= coordinate) cycle
            if (samples%starts(i)%order /= order) cycle
            samples%starts(i)%used = .false.
            return
        end do
        anew = is_stated_anew(coordinate, order, samples)
        if (judgement%verdict == is_wrong) then
            if (.not. anew) return
            judgement%verdict = is_definition
            judgement%remark = one_of_many
            samples%motion(coordinate) = nothing
            samples%exact_motion(coordinate) = .false.
        end if
        allocate (longer(size(samples%starts) + 1))
        n = 0
        do i = 1, size(samples%starts)
            associate (start => samples%starts(i))
                if (start%coordinate == coordinate .and. start%order == order) cycle
                if (anew .and. start%used) cycle
                n = n + 1
                longer(n) = start
            end associate
        end do
        longer(n + 1)%coordinate = coordinate
        longer(n + 1)%order = order
        longer(n + 1)%value = value
        deallocate (samples%starts)
        allocate (samples%starts(n + 1))
        do i = 1, n + 1
            samples%starts(i) = longer(i)
        end do
    end subroutine state_start

    pure function is_given(coordinate, f, symbols, samples) result(yes)
        !! Do conditions say which motion it is, whatever a line before has for it? They name all
        !! its constants.
        integer, intent(in) :: coordinate         !! whose motion it is
        type(expression_t), intent(in) :: f       !! of the time
        type(symbols_t), intent(in) :: symbols    !! with the constants
        type(samples_t), intent(in) :: samples    !! know the conditions
        logical :: yes
        type(expression_t) :: stated(size(samples%starts))
        type(error_t), allocatable :: error
        integer :: c, i

        yes = count(samples%starts%coordinate == coordinate) == 2
        if (.not. yes) return
        do i = 1, size(stated)
            call parse_formula(samples%starts(i)%value, symbols, stated(i), error)
            yes = yes .and. .not. allocated(error)
        end do
        do c = 2, size(symbols%names)
            if (.not. yes) return
            if (.not. is_constant(c, samples)) cycle
            if (f%depends_on(c)) yes = any([(stated(i)%depends_on(c), i=1, size(stated))])
        end do
    end function is_given

    pure function is_constant(c, samples) result(yes)
        !! Of motions, whether or not a line has given it a value.
        integer, intent(in) :: c                  !! a symbol
        type(samples_t), intent(in) :: samples
        logical :: yes

        yes = c > size(samples%role) .or. any(samples%kept_constants == c)
    end function is_constant

    subroutine compare_start(coordinate, order, f, symbols, values, samples, judgement)
        !! Does a motion begin as its lines say, and as its names do?
        integer, intent(in) :: coordinate           !! whose motion it is
        integer, intent(in) :: order                !! of the derivative that `f` is, 0 or 1
        type(expression_t), intent(in) :: f         !! of the time
        type(symbols_t), intent(in) :: symbols      !! with the constants
        real(dp), intent(in) :: values(:, :)        !! of all of them, (states, symbols)
        type(samples_t), intent(inout) :: samples   !! know the conditions and other motions
        type(judgement_t), intent(inout) :: judgement  !! of a right one, which becomes wrong
        character(:), allocatable :: remark

        call compare_with_starts(coordinate, order, f, symbols, values, samples, remark)
        if (remark == "") call compare_with_names(coordinate, order, f, symbols, values, samples, &
                                                  remark)
        if (remark == "") then
            samples%starts%used = .true.
        else
            judgement%verdict = is_wrong
            judgement%remark = remark
        end if
    end subroutine compare_start

    subroutine find_stated(place, samples, symbols, value)
        !! What a line states of a coordinate or velocity at t = 0.
        integer, intent(in) :: place                !! of its symbol
        type(samples_t), intent(in) :: samples      !! know the conditions
        type(symbols_t), intent(inout) :: symbols   !! get the constants that it names
        type(expression_t), intent(out) :: value    !! empty: nothing is stated
        type(error_t), allocatable :: error
        character(name_length), allocatable :: names(:)
        integer :: i

        do i = 1, size(samples%starts)
            associate (start => samples%starts(i))
                if (1 + start%coordinate + start%order*samples%ndof /= place) cycle
                call unknown_names(start%value, symbols, names)
                call add_unknown(names, symbols)
                call parse_formula(start%value, symbols, value, error)
            end associate
        end do
    end subroutine find_stated

    subroutine compare_with_starts(coordinate, order, f, symbols, values, samples, remark)
        !! With the conditions of the lines before, where no constant is free to fulfil them.
        integer, intent(in) :: coordinate           !! whose motion it is
        integer, intent(in) :: order                !! of the derivative that `f` is, 0 or 1
        type(expression_t), intent(in) :: f         !! of the time
        type(symbols_t), intent(in) :: symbols      !! with the constants
        real(dp), intent(in) :: values(:, :)        !! of all of them, (states, symbols)
        type(samples_t), intent(in) :: samples      !! know the conditions and other motions
        character(:), allocatable, intent(out) :: remark  !! which it does not fulfil, or empty
        type(expression_t) :: begun
        type(expression_t) :: stated(size(samples%starts))
        type(error_t), allocatable :: error
        logical :: differs
        integer :: i

        remark = ""
        do i = 1, size(samples%starts)
            call parse_formula(samples%starts(i)%value, symbols, stated(i), error)
            if (allocated(error)) return
        end do
        do i = 1, size(samples%starts)
            associate (start => samples%starts(i))
                if (start%coordinate /= coordinate .or. start%order < order) cycle
                begun = at_start(f, start%order - order)
                call compare(begun - stated(i), coordinate, start%order, values, samples, differs)
                if (.not. differs) cycle
                if (is_free(begun)) cycle
                remark = "it does not begin as line "//to_text(start%line)//" says"
                return
            end associate
        end do
    contains
        logical function is_free(value)
            !! Does it have a constant that no condition names? v_0, too, where the motion is not
            !! known from a line before.
            type(expression_t), intent(in) :: value
            type(expression_t) :: slope
            logical :: known, never
            integer :: c, k

            is_free = .false.
            do c = 2, size(symbols%names)
                if (.not. value%depends_on(c)) cycle
                if (.not. is_constant(c, samples)) cycle
                if (any([(stated(k)%depends_on(c), k=1, size(stated))])) cycle
                if (is_known() .and. is_start_name(trim(symbols%names(c)))) cycle
                slope = derivative(value, c)
                call holds(slope, values, never, known)
                is_free = is_free .or. .not. never
            end do
        end function is_free

        pure logical function is_known()
            !! Is there a motion of this coordinate without constants of its own?
            integer :: c, k

            associate (motion => samples%motion(coordinate))
                is_known = motion%count > 0
                do c = 2, size(symbols%names)
                    if (.not. is_known) return
                    if (.not. is_constant(c, samples)) cycle
                    if (motion%depends_on(c)) is_known = any([(stated(k)%depends_on(c), &
                                                               k=1, size(stated))])
                end do
            end associate
        end function is_known

        pure logical function is_start_name(name)
            character(*), intent(in) :: name

            is_start_name = any(name == ["v_0", "v0 "]) .or. &
                name == trim(symbols%names(1 + coordinate))//"_0" .or. &
                name == trim(symbols%names(1 + coordinate + samples%ndof))//"_0"
        end function is_start_name
    end subroutine compare_with_starts

    subroutine compare_with_names(coordinate, order, f, symbols, values, samples, remark)
        !! Of a motion that names both x_0 and x_dot_0 they are x(0) and x_dot(0).
        integer, intent(in) :: coordinate           !! whose motion it is
        integer, intent(in) :: order                !! of the derivative that `f` is, 0 or 1
        type(expression_t), intent(in) :: f         !! of the time
        type(symbols_t), intent(in) :: symbols      !! with the constants
        real(dp), intent(in) :: values(:, :)        !! of all of them, (states, symbols)
        type(samples_t), intent(in) :: samples      !! know what is declared
        character(:), allocatable, intent(out) :: remark  !! that they are not, or empty
        type(expression_t) :: begun
        character(:), allocatable :: name
        logical :: differs
        integer :: k, named(0:1)

        remark = ""
        do k = 0, 1
            name = trim(symbols%names(1 + coordinate + k*samples%ndof))
            named(k) = symbols%find(name//"_0")
            if (named(k) == 0) named(k) = symbols%find(name//"0")
            if (named(k) == 0) return
            if (any(samples%declared == name//"_0")) return
            if (.not. f%depends_on(named(k))) return
        end do
        do k = order, 1
            begun = at_start(f, k - order)
            call compare(begun - symbol(named(k)), coordinate, k, values, samples, differs)
            if (.not. differs) cycle
            remark = "at t = 0 "//trim(symbols%names(1 + coordinate + k*samples%ndof))// &
                     " is not "//trim(symbols%names(named(k)))
            return
        end do
    end subroutine compare_with_names

    subroutine compare(residual, coordinate, order, values, samples, differs)
        !! The coordinate may be counted from the equilibrium.
        type(expression_t), intent(in) :: residual  !! of the motion at t = 0
        integer, intent(in) :: coordinate           !! whose motion it is
        integer, intent(in) :: order                !! of its derivative, 0 or 1
        real(dp), intent(in) :: values(:, :)        !! (states, symbols)
        type(samples_t), intent(in) :: samples      !! know the equilibrium
        logical, intent(out) :: differs             !! it is known not to vanish
        logical :: judged, yes

        call holds(residual, values, yes, judged)
        differs = judged .and. .not. yes
        if (order > 0 .or. .not. differs) return
        call holds(residual - symbol(samples%place(coordinate)), values, yes, judged)
        differs = .not. yes
    end subroutine compare

    function at_start(f, times) result(value)
        !! A derivative at t = 0.
        type(expression_t), intent(in) :: f      !! of the time
        integer, intent(in) :: times             !! that it is differentiated
        type(expression_t) :: value
        type(expression_t) :: beginning(1)

        beginning(1) = whole(0)
        value = rate_of(f, times)
        value = substituted(value, [1], beginning)
    end function at_start
end module lagrangia_stated_starts
