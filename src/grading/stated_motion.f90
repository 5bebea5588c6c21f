module lagrangia_stated_motion
    !! A sheet about the one motion that begins as its lines `q(0) = ...` say: what is right of it,
    !! and which slip the rest has there.
    use lagrangia_description, only: description_t
    use lagrangia_expression, only: expression_t, symbol
    use lagrangia_homework, only: homework_t
    use lagrangia_judged_sheet, only: judge_sheet
    use lagrangia_judgement, only: is_consequence, is_definition, is_right, is_unreadable, &
                                   is_wrong, judgement_t
    use lagrangia_motion_starts, only: begin_there
    use lagrangia_sample_names, only: role_acceleration, samples_t
    use lagrangia_small_energies, only: is_constant_of_each_draw
    use lagrangia_solved_accelerations, only: has_accelerations
    use lagrangia_system, only: system_t
    use lagrangia_term_search, only: library_t
    use lagrangia_text, only: word_t
    use lagrangia_verdict, only: but_for_constant, with_any
    use lagrangia_zero_constants, only: find_zero_constant
    implicit none (type, external)
    private
    public :: rests_on_right, take_from_start

    character(*), parameter :: of_start = "of the motion that begins so"

contains

    subroutine take_from_start(homework, system, d, insisted, samples, library, result)
        !! What is wrong of all motions may be right of the one that begins as lines of the sheet
        !! say. Equations of motion are those of all motions, and so are L and small oscillations;
        !! an acceleration that is always the same may be used: `x_dot^2 = 2 x_ddot x`.
        type(homework_t), intent(in) :: homework       !! as read
        class(system_t), intent(in) :: system          !! configured
        type(description_t), intent(in) :: d           !! of it
        type(word_t), intent(in) :: insisted(:)        !! names with their usual meaning
        type(samples_t), intent(in) :: samples         !! of all motions, without the sheet's names
        type(library_t), intent(in) :: library(:)      !! right terms
        type(judgement_t), intent(inout) :: result(:)  !! of each statement
        type(judgement_t), allocatable :: attempt(:)
        type(expression_t) :: zeros(size(result))
        logical :: all_velocities, at_rest, found
        logical :: is_number(2)  ! of E and V, on each motion
        integer :: energies(2)
        logical, dimension(size(result)) :: is_any, is_zero
        integer :: i, k

        is_any = [(index(result(i)%remark, with_any) == 1, i=1, size(result))] .and. &
                 result%verdict == is_right
        if (.not. any(is_any .or. result%verdict == is_wrong .or. result%verdict == is_consequence &
                      .or. result%verdict == is_unreadable .or. result%contradicts)) return
        call find_zeros()
        found = .false.
        call judge_there(zeros(:0))
        if (found) is_zero = is_zero .and. attempt%verdict /= is_right  ! it follows
        if (any(is_zero)) call judge_there(pack(zeros, is_zero))
        if (.not. found) return
        do i = 1, size(result)
            if (homework%statements(i)%small) cycle
            if (is_any(i)) call fix_constants(i)
            if (result(i)%verdict == is_right) cycle
            if (result(i)%verdict == is_definition .and. .not. result(i)%contradicts) cycle
            if (is_zero(i)) then
                result(i)%verdict = is_definition
                result(i)%remark = "conserved, and zero on the motions that begin so"
                result(i)%example = ""
                cycle
            end if
            if (at_rest .and. speaks_of_place(result(i)%residual, samples)) cycle
            if (attempt(i)%verdict == is_wrong .and. result(i)%verdict == is_unreadable) then
                result(i) = attempt(i)
                cycle
            end if
            if (attempt(i)%verdict /= is_right) then
                if (result(i)%verdict /= is_definition) call take_slip(attempt(i), i, samples, &
                                                                       result)
                cycle
            end if
            ! what is a number on each motion is any number, but for a constant
            if (attempt(i)%remark == but_for_constant .and. any( &
                is_number .and. [(attempt(i)%residual%depends_on(energies(k)), k=1, 2)])) cycle
            if (speaks_of_all(result(i)%residual, samples, at_rest)) cycle
            result(i) = attempt(i)
            result(i)%remark = of_start
            ! no equation of motion
            if (has_accelerations(result(i)%residual, samples)) result(i)%of_motion = .false.
        end do
    contains
        subroutine fix_constants(i)
            !! Those that the start names are not any ones.
            integer, intent(in) :: i

            if (.not. all_velocities) return
            if (speaks_of_all(result(i)%residual, samples, at_rest)) return
            if (index(attempt(i)%remark, with_any) == 1) return
            if (all(attempt(i)%verdict /= [is_right, is_wrong])) return
            result(i) = attempt(i)
            if (result(i)%verdict == is_right) result(i)%remark = of_start
        end subroutine fix_constants

        subroutine judge_there(zeros)
            !! On the motions that begin so; where there are none, as before.
            type(expression_t), intent(in) :: zeros(:)  !! conserved
            type(samples_t) :: there
            logical :: begun, rest
            integer :: k

            call begin_there(homework, system, zeros, samples, there, begun, rest, all_velocities)
            if (size(zeros) > 0 .and. .not. begun) is_zero = .false.
            if (.not. begun) return
            found = .true.
            at_rest = rest
            energies = [samples%symbols%find("E"), samples%symbols%find("V")]
            is_number = .false.
            do k = 1, 2
                if (energies(k) == 0) cycle
                is_number(k) = is_constant_of_each_draw(symbol(energies(k)), there)
            end do
            call judge_sheet(homework, d, insisted, there, library, attempt)
        end subroutine judge_there

        subroutine find_zeros()
            !! Which lines say of something conserved that it is 0?
            integer :: k

            do k = 1, size(result)
                is_zero(k) = .false.
                if (homework%statements(k)%small .or. result(k)%verdict == is_right) cycle
                if (speaks_of_all(result(k)%residual, samples, .false.)) cycle
                call find_zero_constant(homework%statements(k)%text, result(k)%residual, samples, &
                                        zeros(k))
                is_zero(k) = zeros(k)%count > 0
            end do
        end subroutine find_zeros
    end subroutine take_from_start

    pure function rests_on_right(i, result) result(yes)
        !! Does a statement follow from one that is not wrong after all?
        integer, intent(in) :: i                   !! the statement
        type(judgement_t), intent(in) :: result(:) !! of each
        logical :: yes

        yes = result(i)%verdict == is_consequence
        if (yes) yes = any(result(result(i)%because)%verdict /= is_wrong)
    end function rests_on_right

    subroutine take_slip(there, i, samples, result)
        !! What is wrong of a stated motion, too, has its example there, and its slip where none is
        !! known of all motions.
        type(judgement_t), intent(in) :: there          !! of the stated motion
        integer, intent(in) :: i                        !! the statement
        type(samples_t), intent(in) :: samples          !! of all motions
        type(judgement_t), intent(inout) :: result(:)   !! wrong, or one that follows

        if (speaks_of_all(result(i)%residual, samples, .false.)) return
        select case (there%verdict)
        case (is_wrong)
            if (result(i)%verdict == is_consequence) then
                if (rests_on_right(i, result)) result(i) = there
            else if (result(i)%is_unexplained .or. result(i)%explanation%is_vague .or. &
                     (result(i)%explanation%is_empty() .and. &
                      .not. there%explanation%is_empty())) then
                result(i) = there
            else if (there%example /= "") then
                result(i)%example = there%example
            end if
        case (is_consequence)
            if (.not. rests_on_right(i, result)) return
            if (all(result(there%because)%verdict == is_wrong)) result(i) = there
        case default
            return
        end select
    end subroutine take_slip

    pure function speaks_of_place(residual, samples) result(yes)
        !! Of what is at rest nothing is true but E = 0, p = 0: has it the time, coordinates or
        !! velocities, or is it not known?
        type(expression_t), intent(in) :: residual
        type(samples_t), intent(in) :: samples
        logical :: yes
        integer :: k

        yes = residual%count == 0
        do k = 1, 1 + 2*samples%ndof
            if (.not. yes) yes = residual%depends_on(k)
        end do
    end function speaks_of_place

    function speaks_of_all(residual, samples, of_values) result(yes)
        !! Has it accelerations that vary, L or its derivatives? Of what stays at rest L and the
        !! momenta are numbers, as E is.
        type(expression_t), intent(in) :: residual
        type(samples_t), intent(in) :: samples
        logical, intent(in) :: of_values  !! what is said of L and the momenta is their value
        logical :: is_constant, yes
        integer :: k

        yes = .false.
        do k = 1, size(samples%role)
            if (.not. residual%depends_on(k)) cycle
            associate (name => samples%symbols%names(k))
                if (of_values .and. (name == "L" .or. (index(name, "dL_d") == 1 .and. &
                                                       index(name, "_dot") > 0))) cycle
                yes = yes .or. name == "L" .or. index(name, "dL_") > 0
                if (samples%role(k) /= role_acceleration) cycle
                is_constant = is_constant_of_each_draw(symbol(k), samples)
                yes = yes .or. .not. is_constant
            end associate
        end do
    end function speaks_of_all
end module lagrangia_stated_motion
