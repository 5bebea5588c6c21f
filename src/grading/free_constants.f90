module lagrangia_free_constants
    !! Statements with constants of integration: `theta_dot^2 = 2 g/l cos(theta) + h`, right if it
    !! goes on to hold on each motion on which it once does, whatever the constant is.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_derivative, only: derivative, time_derivative
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, operator(-), symbol, whole
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_kinds, only: dp
    use lagrangia_motion_values, only: values_of
    use lagrangia_names, only: name_length
    use lagrangia_sample_names, only: samples_t
    use lagrangia_slip_search, only: holds
    use lagrangia_substitution, only: substituted
    use lagrangia_symbols, only: symbols_t
    use lagrangia_unknown_names, only: add_unknown, unknown_names
    use lagrangia_verdict, only: is_right, is_unreadable, is_wrong, judgement_t
    implicit none (type, external)
    private
    public :: judge_with_constants

    integer, parameter :: steps = 60   !! of Newton, from each start
    integer, parameter :: enough = 4   !! states at which there is such a constant

contains

    subroutine judge_with_constants(left_text, right_text, samples, is_one, judgement)
        !! A statement whose unknown names are constants: those of `constant:`, or values of
        !! coordinates and velocities at the start, `theta_0`; else `is_one` is false.
        character(*), intent(in) :: left_text, right_text  !! both sides, in their columns
        type(samples_t), intent(in) :: samples             !! know the names behind `constant:`
        logical, intent(out) :: is_one                     !! all is said
        type(judgement_t), intent(inout) :: judgement      !! of it
        character(name_length), allocatable :: names(:)
        type(expression_t) :: left, right, residual, rate
        type(symbols_t) :: symbols
        type(error_t), allocatable :: error
        real(dp), allocatable :: values(:, :)
        integer, allocatable :: starts(:)
        integer :: i, n
        logical :: judged, yes

        is_one = .false.
        call unknown_names(left_text//" + "//right_text, samples%symbols, names)
        if (size(names) == 0) return
        allocate (starts(size(names)))
        do i = 1, size(names)
            starts(i) = start_of(trim(names(i)), samples)
            if (any(samples%declared == names(i))) starts(i) = -1
            if (starts(i) == 0) return
        end do
        symbols = samples%symbols
        call add_unknown(names, symbols)
        call parse_formula(left_text, symbols, left, error)
        if (.not. allocated(error)) call parse_formula(right_text, symbols, right, error)
        if (allocated(error)) return
        residual = left - right
        n = size(samples%role)
        if (.not. moves()) return
        is_one = .true.
        judgement%verdict = is_unreadable
        do i = 1, n
            if (residual%depends_on(i) .and. symbols%rates(i) < 0) then
                judgement%remark = "d/dt of '"//trim(symbols%names(i))//"' is not known here; "// &
                                   "write the formula for it"
                return
            end if
        end do
        if (.not. begins_there()) return
        rate = time_derivative(residual, symbols%rates, 1)
        do i = 1, size(names)
            if (.not. residual%depends_on(n + i)) cycle
            call solve_for(n + i)
            call holds(rate, values, yes, judged)
            if (judged) exit
        end do
        if (.not. judged) then
            judgement%remark = "no value of '"//trim(names(1))//"' makes it true at the states "// &
                               "that were tried"
            return
        end if
        judgement%verdict = merge(is_right, is_wrong, yes)
        judgement%remark = "with any "//trim(names(1))
        if (.not. yes) judgement%remark = "no "//trim(names(1))//" stays constant with it: its "// &
                                          "derivative by the time contradicts the motion"
    contains
        logical function moves()
            !! Is there a coordinate or a velocity in it?
            integer :: k

            moves = any([(residual%depends_on(k), k=2, 1 + 2*samples%ndof)]) .or. &
                    any([(residual%depends_on(k) .and. symbols%rates(k) > 0, k=1, n)])
        end function moves

        logical function begins_there()
            !! It must be true at the start itself: at theta_0, and at rest if no velocity is named.
            type(expression_t) :: begun
            type(expression_t), allocatable :: put(:)
            integer, allocatable :: places(:)
            integer :: j, k

            begins_there = .true.
            if (.not. any(starts > 1)) return
            allocate (places(0), put(2*samples%ndof))
            do k = 2, 1 + 2*samples%ndof
                do j = 1, size(starts)
                    if (starts(j) /= k) cycle
                    places = [places, k]
                    put(size(places)) = symbol(n + j)
                end do
                if (any(places == k)) cycle
                if (k <= 1 + samples%ndof) then
                    if (residual%depends_on(k)) begins_there = .false.
                else
                    places = [places, k]
                    put(size(places)) = whole(0)
                end if
            end do
            if (begins_there) then
                begun = substituted(residual, places, put(:size(places)))
                allocate (values(size(samples%values, 1), n + size(names)))
                call draw_constants()
                call holds(begun, values, begins_there, judged)
                deallocate (values)
            end if
            if (.not. begins_there) judgement%remark = "is '"//trim(names(1))//"' where the "// &
                "motion begins? It does not hold there; a line 'constant: "//trim(names(1))// &
                "' makes it any constant"
        end function begins_there

        subroutine draw_constants()
            integer :: j, row
            real(dp), parameter :: golden = 0.6180339887498949_dp

            values(:, :n) = samples%values
            do row = 1, size(values, 1)
                do j = 1, size(names)
                    values(row, n + j) = 0.3_dp + 1.3_dp*modulo(golden*(7*j + row), 1.0_dp)
                end do
            end do
        end subroutine draw_constants

        subroutine solve_for(place)
            !! Newton for one constant at each state; NaN where it has no solution.
            integer, intent(in) :: place
            type(expression_t) :: slope
            real(dp), dimension(size(samples%values, 1)) :: f, slopes, best, step
            real(dp) :: start
            integer :: begun, k

            if (allocated(values)) deallocate (values)
            allocate (values(size(samples%values, 1), n + size(names)))
            slope = derivative(residual, place)
            best = ieee_value(1.0_dp, ieee_quiet_nan)
            do begun = 1, 4
                call draw_constants()
                start = real(begun, dp)*0.7_dp - 1.4_dp
                values(:, place) = values(:, place) + start
                do k = 1, steps
                    f = values_of(residual, values)
                    if (slope%count == 0) return
                    slopes = values_of(slope, values)
                    step = f/slopes
                    values(:, place) = values(:, place) - step
                    if (.not. any(abs(step) > 1e-15_dp*abs(values(:, place)))) exit
                end do
                where (.not. ieee_is_finite(best) .and. ieee_is_finite(values(:, place)) .and. &
                       abs(step) <= 1e-13_dp*(abs(values(:, place)) + 1e-3_dp))
                    best = values(:, place)
                end where
                if (count(ieee_is_finite(best)) >= enough) exit
            end do
            values(:, place) = best
        end subroutine solve_for
    end subroutine judge_with_constants

    pure function start_of(name, samples) result(place)
        !! The coordinate or velocity whose value at the start is called that; 0: none.
        character(*), intent(in) :: name
        type(samples_t), intent(in) :: samples
        integer :: place
        character(:), allocatable :: of

        do place = 2, 1 + 2*samples%ndof
            of = trim(samples%symbols%names(place))
            if (name == of//"_0" .or. name == of//"0") return
        end do
        place = 0
    end function start_of
end module lagrangia_free_constants
