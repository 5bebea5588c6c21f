module lagrangia_small_driven_motion
    !! Statements about small oscillations in which the time stands: those of one coordinate about 0
    !! or pi, where it may stay at all times although something else moves.
    use lagrangia_expression, only: expression_t
    use lagrangia_kinds, only: dp
    use lagrangia_motion_values, only: values_of
    use lagrangia_sample_names, only: role_parameter, samples_t
    use lagrangia_slip_search, only: explain_slip, holds
    use lagrangia_term_search, only: library_t
    use lagrangia_verdict, only: is_unreadable, is_wrong, judgement_t, put_example
    use lagrangia_written_out, only: equation_of_motion
    implicit none (type, external)
    private
    public :: is_driven, judge_driven

    real(dp), parameter :: amplitude = 1e-6_dp
    real(dp), parameter :: rounding = 1e-12_dp  !! of accelerations at rest

contains

    pure function is_driven(residual, samples) result(yes)
        !! Is the time in it, beside one coordinate, its rates and constants?
        type(expression_t), intent(in) :: residual  !! left less right side, written out
        type(samples_t), intent(in) :: samples      !! know the names
        logical :: yes
        integer :: k

        yes = samples%ndof == 1 .and. samples%lagrangian%count > 0 .and. residual%depends_on(1)
        do k = 5, size(samples%role)
            if (yes .and. residual%depends_on(k)) yes = samples%role(k) == role_parameter .and. &
                                                        samples%rate(k) == 0
        end do
    end function is_driven

    subroutine judge_driven(left, right, first, samples, library, explain, judgement)
        !! To first order, of the equation of motion at all times.
        type(expression_t), intent(in) :: left, right   !! written out
        integer, intent(in) :: first                    !! nodes before it are right
        type(samples_t), intent(in) :: samples          !! know L
        type(library_t), intent(in) :: library(:)       !! right terms
        logical, intent(in) :: explain                  !! say what is wrong
        type(judgement_t), intent(inout) :: judgement   !! of it, with the residual
        real(dp), parameter :: places(2) = [0.0_dp, acos(-1.0_dp)]
        real(dp), allocatable :: shown(:, :), values(:, :), wrong_shown(:, :)
        logical :: judged, right_one, stays, wrong_at(size(places))
        integer :: k

        wrong_at = .false.
        do k = 1, size(places)
            call move_a_little(samples, places(k), values, shown, stays)
            if (.not. stays) cycle
            call holds(judgement%residual, values, right_one, judged)
            if (judged .and. right_one) return
            wrong_at(k) = judged
        end do
        if (.not. any(wrong_at)) then
            judgement%verdict = is_unreadable
            judgement%remark = "the time in a statement behind 'small:', and no place at which "// &
                               "nothing moves at all times"
            return
        end if
        judgement%verdict = is_wrong
        if (.not. explain) return
        do k = 1, size(places)
            if (.not. wrong_at(k) .or. .not. judgement%explanation%is_empty()) cycle
            call move_a_little(samples, places(k), values, shown, stays)
            ! where all is linear, and no power hides a term
            call explain_slip(judgement%residual, first, samples, shown, library, &
                              judgement%explanation)
            if (judgement%explanation%is_empty()) call explain_slip( &
                judgement%residual, first, samples, values, library, judgement%explanation)
            if (.not. judgement%explanation%is_empty() .or. k == findloc(wrong_at, .true., 1)) then
                wrong_shown = shown
            end if
        end do
        call judgement%say_why()
        call put_example(left, right, samples, wrong_shown, judgement%example)
    end subroutine judge_driven

    subroutine move_a_little(samples, place, values, shown, stays)
        !! States near a place, with the accelerations of the equation of motion.
        type(samples_t), intent(in) :: samples
        real(dp), intent(in) :: place
        real(dp), allocatable, intent(out) :: values(:, :)  !! of a small amplitude
        real(dp), allocatable, intent(out) :: shown(:, :)   !! linear ones, of a larger amplitude
        logical, intent(out) :: stays                       !! it does at rest there
        type(expression_t) :: equation
        real(dp), allocatable :: rest(:, :)

        equation = equation_of_motion(1, samples)
        rest = samples%values
        rest(:, 2) = place
        rest(:, 3) = 0.0_dp
        call accelerate(rest)
        stays = all(abs(rest(:, 4)) <= rounding*(1.0_dp + abs(samples%values(:, 4))))
        if (.not. stays) return
        shown = samples%values
        values = samples%values
        values(:, 2) = place + amplitude*shown(:, 2)
        values(:, 3) = amplitude*shown(:, 3)
        call accelerate(values)
        shown(:, 2) = place + shown(:, 2)
        shown(:, 4) = values(:, 4)/amplitude
    contains
        subroutine accelerate(at)
            !! The equation is linear in the acceleration.
            real(dp), intent(inout) :: at(:, :)
            real(dp), dimension(size(at, 1)) :: force, with_one

            at(:, 4) = 0.0_dp
            force = values_of(equation, at)
            at(:, 4) = 1.0_dp
            with_one = values_of(equation, at)
            at(:, 4) = -force/(with_one - force)
        end subroutine accelerate
    end subroutine move_a_little
end module lagrangia_small_driven_motion
