module lagrangia_initial_conditions
    !! `theta(0) = theta_0`: how a motion begins.
    use lagrangia_canonical_form, only: simplified
    use lagrangia_declared_constants, only: has_place, keep_constant
    use lagrangia_expression, only: expression_t, operator(-), whole
    use lagrangia_formula_text, only: formula_text
    use lagrangia_kinds, only: dp
    use lagrangia_motion_values, only: draw_values, rate_of, values_of
    use lagrangia_parameter_choice, only: occurs
    use lagrangia_sample_names, only: samples_t
    use lagrangia_slip_search, only: holds
    use lagrangia_substitution, only: substituted
    use lagrangia_verdict, only: is_definition, is_right, is_wrong, judgement_t, one_of_many
    implicit none (type, external)
    private
    public :: judge_start, with_known_starts, with_short_starts

contains

    pure function with_short_starts(text) result(short)
        !! `theta(0) = 1` for `theta(t = 0) = 1`, with blanks behind, so that columns stay.
        character(*), intent(in) :: text  !! a statement
        character(len(text)) :: short, inside
        integer :: first, last

        short = text
        first = index(text, "(t")
        if (first == 0) return
        last = first + index(text(first:), ")") - 1
        if (last <= first + 2) return
        inside = adjustl(text(first + 2:last - 1))
        if (inside(:1) == "=" .and. adjustl(inside(2:)) == "0") short(first:last) = "(0)"
    end function with_short_starts

    function with_known_starts(text, samples) result(known)
        !! `A = (r(0) + r_dot(0)/omega)/2` with the values of a motion that a line before has; so is
        !! `tan(phi) = -x_dot_0/(omega x_0)` with a constant of its own.
        character(*), intent(in) :: text         !! a statement
        type(samples_t), intent(in) :: samples   !! know the motions
        character(:), allocatable :: known
        type(expression_t) :: begun, beginning(1)
        character(:), allocatable :: called
        integer :: at, k, order
        logical :: by_name

        known = text
        beginning(1) = whole(0)  ! t
        do k = 1, samples%ndof
            if (samples%motion(k)%count == 0) cycle
            by_name = any([(samples%motion(k)%depends_on(samples%kept_constants(at)) .and. &
                            occurs(text, trim(samples%symbols%names(samples%kept_constants(at)))), &
                            at=1, size(samples%kept_constants))])
            if (.not. by_name .and. index(known, "(0)") <= index(known, "=")) cycle
            do order = 0, 1
                called = trim(samples%symbols%names(1 + k + order*samples%ndof))//"(0)"
                begun = substituted(rate_of(samples%motion(k), order), [1], beginning)
                if (any([(begun%depends_on(at), at=size(samples%role) + 1, &
                          size(samples%role) + size(samples%constants))])) cycle
                call put_begun(called)
                called = called(:len(called) - 3)//"_0"
                if (.not. by_name .or. samples%symbols%find(called) > 0) cycle
                if (any(samples%constants == called) .or. any(samples%declared == called)) cycle
                call put_begun(called)
            end do
        end do
    contains
        subroutine put_begun(name)
            !! Behind the first equality sign.
            character(*), intent(in) :: name
            character(:), allocatable :: value
            integer :: at, first

            if (.not. occurs(known(index(known, "=") + 1:), name)) return
            value = "("//formula_text(simplified(begun, samples%symbols), samples%symbols)//")"
            first = index(known, "=") + 1
            do
                at = index(known(first:), name)
                if (at == 0) return
                at = first + at - 1
                first = at + len(name)
                if (.not. occurs(known(at - 1:min(first, len(known))), name)) cycle
                known = known(:at - 1)//value//known(first:)
                first = at + len(value)
            end do
        end subroutine put_begun
    end function with_known_starts

    subroutine judge_start(coordinate, order, f, samples, names, is_one, judgement)
        !! `theta(0) = theta_0`: how one motion of many begins, or that of a line before.
        integer, intent(in) :: coordinate           !! which begins
        integer, intent(in) :: order                !! of its derivative, 0 or 1
        type(expression_t), intent(in) :: f         !! the right side
        type(samples_t), intent(inout) :: samples   !! know the motion
        integer, intent(in) :: names                !! with the constants
        logical, intent(out) :: is_one              !! the right side is a constant
        type(judgement_t), intent(inout) :: judgement   !! of the line
        type(expression_t) :: begun, beginning(1)
        real(dp), allocatable :: values(:, :)
        integer :: i, k
        logical :: judged, yes

        is_one = .not. any([(f%depends_on(k), k=1, 1 + 3*samples%ndof)])
        if (.not. is_one) return
        judgement%verdict = is_definition
        judgement%remark = one_of_many
        if (samples%motion(coordinate)%count == 0) return
        call draw_values(samples, names, values)
        beginning(1) = whole(0)  ! t
        begun = substituted(rate_of(samples%motion(coordinate), order), [1], beginning)
        call holds(begun - f, values, yes, judged)
        if (.not. judged) return
        k = size(samples%symbols%names)
        ! x_0 is where the motion of the line before begins
        call keep_start(f, begun, k, samples)
        associate (ours => [(begun%depends_on(i) .and. (i > k .or. &
                             any(samples%kept_constants == i)), i=1, names)], &
                   theirs => [(f%depends_on(i) .and. (i > k .or. &
                               any(samples%kept_constants == i)), i=1, names)])
            ! theta_0 or 1.0 says what A is, as nothing else does
            if (.not. yes .and. any(ours) .and. .not. any(ours .and. theirs)) return
        end associate
        judgement%verdict = merge(is_right, is_wrong, yes)
        judgement%remark = ""
        if (.not. yes) judgement%remark = "the motion that a line writes out begins elsewhere"
    end subroutine judge_start

    subroutine keep_start(f, begun, known, samples)
        !! A name of no value alone on the right side has the value of the motion at the start.
        type(expression_t), intent(in) :: f, begun       !! the right side, and that value
        integer, intent(in) :: known                     !! symbols before the constants
        type(samples_t), intent(inout) :: samples        !! know the constants
        integer :: i

        if (f%count /= 1) return
        do i = 1, size(samples%constants)
            if (begun%depends_on(known + i)) return
        end do
        do i = 1, size(samples%constants)
            if (.not. f%depends_on(known + i)) cycle
            if (has_place(samples, samples%constants(i))) call keep_constant( &
                trim(samples%constants(i)), values_of(begun, samples%values), .false., samples)
        end do
    end subroutine keep_start
end module lagrangia_initial_conditions
