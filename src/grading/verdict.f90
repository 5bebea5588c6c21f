module lagrangia_verdict
    !! What is said about a statement: its verdict, and of a wrong one a state with both sides.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
    use lagrangia_explanation, only: explanation_t, explanation_text
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_text, only: typed_name
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_zero
    use lagrangia_number_text, only: scientific
    use lagrangia_sample_names, only: role_coordinate, samples_t
    use lagrangia_sampled_formula, only: evaluate_nodes
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: as_new_name, but_for_constant, judgement_t, one_of_many, with_any
    public :: brief, put_example, telling_digits
    public :: is_right, is_definition, is_wrong, is_unreadable, is_consequence

    integer, parameter :: is_right = 1, is_definition = 2, is_wrong = 3, is_unreadable = 4
    character(*), parameter :: but_for_constant = "but for a constant"
    !! which L, V and E have that nobody sees
    character(*), parameter :: as_new_name = "taken for a new name: "  !! and why that is said
    character(*), parameter :: with_any = "with any "  !! constant that fits
    character(*), parameter :: one_of_many = "an initial condition, of one motion of many"
    integer, parameter :: is_consequence = 5  !! false, and follows from lines before that are wrong

    type :: judgement_t
        !! Of one statement.
        integer :: verdict = is_right
        character(:), allocatable :: remark
        !! which change makes it right, or what else is to be said
        type(explanation_t) :: explanation    !! of a wrong one, where it was asked for
        logical :: is_unexplained = .false.   !! and none was found
        character(:), allocatable :: example  !! of a wrong one: a state with both sides as numbers
        type(expression_t) :: residual
        !! left less right of the first pair, or of the wrong one
        logical :: of_motion = .false.        !! it holds on the motion only
        logical :: of_constant = .false.      !! `... = const`, and the residual is its rate
        character(:), allocatable :: defines  !! the new name, where it is a definition
        logical :: contradicts = .false.      !! which mostly means something else
        logical :: of_oscillation = .false.   !! or is a frequency or a period of one
        logical :: of_none = .false.          !! or looks like one, and is of no oscillation
        integer, allocatable :: because(:)    !! wrong statements that it follows from, or none
        character(:), allocatable :: own_remark, own_example  !! of one that follows: its own slip
    contains
        procedure :: put_reason
        procedure :: say_why
        procedure :: stand_alone
    end type judgement_t

contains

    pure subroutine say_why(self)
        !! Its remark is what explains it, or that nothing does.
        class(judgement_t), intent(inout) :: self  !! a wrong one

        self%is_unexplained = self%explanation%is_empty()
        self%remark = explanation_text(self%explanation)
    end subroutine say_why

    pure subroutine put_reason(self, remark)
        !! It follows from what is wrong before it.
        class(judgement_t), intent(inout) :: self  !! a wrong one
        character(*), intent(in) :: remark         !! from which lines

        self%verdict = is_consequence
        self%own_remark = self%remark
        self%own_example = self%example
        self%remark = remark
        self%example = ""
    end subroutine put_reason

    pure subroutine stand_alone(self)
        !! What it would follow from is not wrong.
        class(judgement_t), intent(inout) :: self  !! one that follows

        self%verdict = is_wrong
        deallocate (self%because)
        allocate (self%because(0))
        call move_alloc(self%own_remark, self%remark)
        call move_alloc(self%own_example, self%example)
    end subroutine stand_alone

    subroutine put_example(left, right, samples, values, text)
        !! `left 1.23, right 4.56 at theta = 0.123, g = 2.4`, the first of those where they differ
        !! most but for rounding.
        type(expression_t), intent(in) :: left, right      !! both sides
        type(samples_t), intent(in) :: samples             !! know the names
        real(dp), intent(in) :: values(:, :)               !! (states, symbols)
        character(:), allocatable, intent(out) :: text     !! one line
        real(dp), allocatable :: of_left(:, :), of_right(:, :), difference(:)
        real(dp), allocatable :: left_sizes(:, :), right_sizes(:, :)
        character(:), allocatable :: before
        real(dp), parameter :: rounding = 1e-9_dp
        logical, allocatable :: judged(:)
        real(dp) :: most
        integer :: digits, i, worst

        allocate (of_left(size(values, 1), left%count), of_right(size(values, 1), right%count))
        allocate (left_sizes, mold=of_left)
        allocate (right_sizes, mold=of_right)
        call evaluate_nodes(left, values, of_left, sizes=left_sizes)
        call evaluate_nodes(right, values, of_right, sizes=right_sizes)
        associate (a => of_left(:, left%count), b => of_right(:, right%count))
            ! what is left of terms that cancel is 0
            associate (of_a => left_sizes(:, left%count), of_b => right_sizes(:, right%count))
                where (ieee_is_finite(of_a) .and. abs(a) <= 4*epsilon(a)*of_a) a = 0.0_dp
                where (ieee_is_finite(of_b) .and. abs(b) <= 4*epsilon(b)*of_b) b = 0.0_dp
            end associate
            allocate (difference(size(a)))
            difference = abs(a - b)/(abs(a) + abs(b))
            judged = ieee_is_finite(difference)
            do i = 1, size(samples%role)  ! r < 0 is no place that anybody draws
                if (samples%role(i) /= role_coordinate) cycle
                if (all(samples%symbols%names(i) /= ["r  ", "rho"])) cycle
                if (any(judged .and. values(:, i) > 0.0_dp .and. difference > rounding)) then
                    judged = judged .and. values(:, i) > 0.0_dp
                end if
            end do
            most = maxval(difference, judged)
            worst = max(1, findloc(difference >= (1.0_dp - rounding)*most .and. judged, .true., 1))
            digits = telling_digits(a(worst), b(worst))
            text = "left "//brief(a(worst), digits)//", right "//brief(b(worst), digits)
        end associate
        before = " at "
        do i = 1, size(samples%role)
            if (.not. (left%depends_on(i) .or. right%depends_on(i))) cycle
            text = text//before//typed_name(trim(samples%symbols%names(i)))//" = "// &
                   brief(values(worst, i))
            before = ", "
        end do
    end subroutine put_example

    pure function telling_digits(a, b) result(digits)
        !! Four, or as many as are needed to see that the numbers differ, up to 12.
        real(dp), intent(in) :: a, b  !! two numbers that differ
        integer :: digits

        do digits = 4, 11
            if (brief(a, digits) /= brief(b, digits)) return
        end do
    end function telling_digits

    pure function brief(value, significant) result(text)
        !! Four significant digits, or as many as are said; in words what is no number, such as the
        !! ratio of two amplitudes of which the second is 0.
        real(dp), intent(in) :: value                 !! any
        integer, intent(in), optional :: significant  !! digits
        character(:), allocatable :: text
        integer :: digits, n

        n = 4
        if (present(significant)) n = significant
        text = merge("undefined", "infinite ", ieee_is_nan(value))
        text = trim(text)
        if (.not. ieee_is_finite(value)) return
        text = "0"
        if (is_zero(value)) return
        text = scientific(value, n)
        if (.not. (abs(value) > 1e-4_dp .and. abs(value) < 1e6_dp)) return
        digits = n - 1 - floor(log10(abs(value)))
        if (digits >= 0) then
            text = to_text(anint(value*10.0_dp**digits)/10.0_dp**digits)
        else
            text = to_text(anint(value))
        end if
    end function brief
end module lagrangia_verdict
