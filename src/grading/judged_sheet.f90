module lagrangia_judged_sheet
    !! The statements of a sheet, one after the other: what each defines, and what follows from
    !! what is wrong.
    use lagrangia_consequences, only: consequences_t
    use lagrangia_declared_constants, only: show_constants
    use lagrangia_description, only: description_t
    use lagrangia_formula_characters, only: plain_letters
    use lagrangia_homework, only: homework_t
    use lagrangia_judgement, only: is_definition, is_right, is_unreadable, is_wrong, judge, &
                                   judgement_t
    use lagrangia_parameter_choice, only: occurs
    use lagrangia_sample_names, only: samples_t, start_t
    use lagrangia_statement_forms, only: read_new_name, without_number
    use lagrangia_symbols, only: symbols_t
    use lagrangia_term_search, only: library_t
    use lagrangia_text, only: to_text, word_t
    use lagrangia_usual_names, only: add_usual_names, mark_used
    use lagrangia_verdict, only: as_new_name, one_of_many
    implicit none (type, external)
    private
    public :: judge_sheet, reason_text

contains

    subroutine judge_sheet(homework, d, insisted, truth, library, result)
        !! Each statement, in their order; one with a name that a later one defines waits for it.
        type(homework_t), intent(in) :: homework      !! as read
        type(description_t), intent(in) :: d          !! of the system
        type(word_t), intent(in) :: insisted(:)       !! names with their usual meaning
        type(samples_t), intent(in) :: truth          !! without the sheet's names
        type(library_t), intent(in) :: library(:)     !! right terms
        type(judgement_t), allocatable, intent(out) :: result(:)  !! of each statement
        type(samples_t) :: samples
        type(consequences_t) :: consequences
        type(homework_t) :: sheet
        type(word_t), allocatable :: names(:), plain(:)
        logical, allocatable :: waits(:)
        logical :: again, squared
        integer :: i, k, n

        n = size(homework%statements)
        samples = truth
        call add_usual_names(d, homework, insisted, samples)
        sheet = homework
        call mark_used(sheet, samples)
        allocate (result(n), names(n), plain(n), waits(n))
        waits = .false.
        do i = 1, n
            plain(i)%text = plain_letters(homework%statements(i)%text)
            call read_new_name(plain(i)%text(:max(0, index(plain(i)%text, "=") - 1)), samples, &
                               names(i)%text, squared)
        end do
        samples%symbols%primes = has_primes(plain, samples)
        do i = 1, n
            call judge_one(i)
            again = result(i)%verdict == is_right .or. result(i)%verdict == is_definition
            do while (again)
                again = .false.
                do k = 1, i - 1
                    if (.not. waits(k)) cycle
                    call judge_one(k)
                    if (.not. waits(k)) again = .true.
                end do
            end do
            if (result(i)%verdict /= is_right) cycle
            do k = 1, i - 1  ! how the motion of this line begins
                if (result(k)%verdict /= is_definition) cycle
                if (index(plain(k)%text, "(0)") > 0) call judge_again(k)
            end do
        end do
        call compare_siblings(result)
        do i = 1, n
            call show_constants(result(i)%remark)
            call show_constants(result(i)%example)
            call show_constants(result(i)%own_remark)
            call show_constants(result(i)%own_example)
        end do
    contains
        subroutine judge_one(at)
            integer, intent(in) :: at
            type(symbols_t) :: before

            if (sheet%statements(at)%refusal /= "") then
                result(at)%verdict = is_unreadable
                result(at)%remark = trim(sheet%statements(at)%refusal)
                result(at)%example = ""
                return
            end if
            before = samples%symbols
            call judge_corrected(at)
            if (result(at)%verdict == is_right) return
            call judge(sheet%statements(at), samples, library, .true., result(at))
            waits(at) = result(at)%verdict == is_unreadable .and. speaks_of_later(at)
            if (waits(at)) return
            associate (judgement => result(at))
                call consequences%add_names(samples%symbols)
                if (judgement%verdict /= is_wrong) return
                allocate (judgement%because(0))
                if (judgement%residual%count == 0) return  ! a motion
                ! in other worlds, too, the name that it defines is new
                if (allocated(judgement%defines)) call consequences%add_names(before)
                call consequences%find(sheet%statements(at), judgement%residual, samples, &
                                       judgement%because)
                if (allocated(judgement%defines)) call consequences%add_names(samples%symbols)
                if (size(judgement%because) > 0) then
                    call judgement%put_reason(reason_text(homework, judgement%because))
                    call consequences%add_consequence(judgement%because, judgement%residual, &
                                                      samples)
                else
                    call consequences%add_mistake(at, judgement%residual, samples)
                end if
            end associate
        end subroutine judge_one

        subroutine judge_again(at)
            !! A condition that was given before a motion, which begins so, is not wrong by it.
            integer, intent(in) :: at
            type(start_t), allocatable :: starts(:), none(:)
            type(judgement_t) :: before

            if (result(at)%remark == one_of_many .and. &
                .not. any(samples%starts%line == sheet%statements(at)%line)) return
            before = result(at)
            allocate (none(0))
            starts = samples%starts
            samples%starts = none
            call judge_one(at)
            samples%starts = starts
            if (result(at)%verdict == is_wrong) result(at) = before
        end subroutine judge_again

        subroutine judge_corrected(at)
            !! The definition of a name that a line before defines wrongly, as a new one: `omega_1`
            !! of no oscillation, then of one.
            integer, intent(in) :: at
            type(samples_t) :: without
            integer :: k

            result(at)%verdict = is_wrong
            do k = at - 1, 1, -1
                if (.not. allocated(result(k)%defines)) cycle
                if (.not. occurs(left_side(at), result(k)%defines)) cycle
                if (result(k)%verdict /= is_wrong .and. .not. result(k)%of_none) return
                without = samples
                call without%symbols%forget(result(k)%defines)
                call judge(sheet%statements(at), without, library, .false., result(at))
                if (result(at)%verdict /= is_right) return
                if (.not. allocated(result(at)%defines)) then
                    result(at)%verdict = is_wrong  ! it says something else
                    return
                end if
                samples = without
                call consequences%add_names(samples%symbols)
                return
            end do
        end subroutine judge_corrected

        function left_side(at) result(side)
            integer, intent(in) :: at
            character(:), allocatable :: side

            side = plain(at)%text(:max(0, index(plain(at)%text, "=") - 1))
        end function left_side

        logical function speaks_of_later(at)
            !! Has it a name that a later statement defines, and none before?
            integer, intent(in) :: at
            integer :: j

            speaks_of_later = .false.
            do j = at + 1, n
                if (names(j)%text == "") cycle
                if (samples%symbols%find_definition(names(j)%text) > 0) cycle
                speaks_of_later = occurs(plain(at)%text, names(j)%text) .or. &
                                  occurs(plain(at)%text, names(j)%text//"_dot") .or. &
                                  occurs(plain(at)%text, names(j)%text//"_ddot")
                if (speaks_of_later) return
            end do
        end function speaks_of_later
    end subroutine judge_sheet

    pure subroutine compare_siblings(result)
        !! `T_2` is wrong if it is no period, and `T_1` of the same sheet is one.
        type(judgement_t), intent(inout) :: result(:)
        integer :: i, k

        do i = 1, size(result)
            if (result(i)%verdict /= is_definition) cycle
            if (.not. result(i)%of_none) cycle
            do k = 1, size(result)
                if (.not. result(k)%of_oscillation) cycle
                if (without_number(result(k)%defines) /= &
                    without_number(result(i)%defines)) cycle
                result(i)%verdict = is_wrong
                result(i)%remark = result(i)%remark(len(as_new_name) + 1:)
                exit
            end do
        end do
    end subroutine compare_siblings

    pure function has_primes(statements, samples) result(yes)
        !! Is `theta'` the velocity, and no coordinate of another frame, as in `x' = x + s`?
        type(word_t), intent(in) :: statements(:)  !! in plain letters
        type(samples_t), intent(in) :: samples     !! know the coordinates
        logical :: yes
        character(:), allocatable :: left
        integer :: equals, i, place

        yes = .true.
        do i = 1, size(statements)
            if (has_double_prime(statements(i)%text)) return
        end do
        do i = 1, size(statements)
            associate (text => statements(i)%text)
                equals = index(text, "=")
                left = trim(adjustl(text(:max(0, equals - 1))))
                if (len(left) < 2) cycle
                if (left(len(left):) /= "'") cycle
                place = samples%symbols%find(samples%symbols%spelling(left(:len(left) - 1)))
                if (place < 2 .or. place > 1 + samples%ndof) cycle
                yes = yes .and. .not. is_shifted(text(equals + 1:), left(:len(left) - 1))
            end associate
        end do
    end function has_primes

    pure function is_shifted(side, coordinate) result(yes)
        !! Is the coordinate itself one of its summands, as in `x + s`? A velocity is no place.
        character(*), intent(in) :: side        !! the right one, in plain letters
        character(*), intent(in) :: coordinate  !! as typed
        logical :: yes
        character(:), allocatable :: rest, summand
        integer :: at, depth

        yes = .false.
        rest = "+"//side//"+"
        summand = ""
        depth = 0
        do at = 1, len(rest) - 1
            select case (rest(at:at))
            case ("("); depth = depth + 1
            case (")"); depth = depth - 1
            case ("+", "-", "=")
                if (depth /= 0) cycle
                summand = adjustl(rest(at + 1:))
                if (index(summand, coordinate) /= 1) cycle
                yes = yes .or. scan(adjustl(summand(len(coordinate) + 1:)), "+-=") == 1
            case default
                cycle
            end select
        end do
    end function is_shifted

    pure function has_double_prime(statement) result(yes)
        !! `theta''`, so that `theta'` is the velocity, and no coordinate of another frame?
        character(*), intent(in) :: statement  !! in plain letters
        logical :: yes
        integer :: at

        at = index(statement, "''")
        yes = at > 1
        if (yes) yes = scan(statement(at - 1:at - 1), "LTVU)") == 0
    end function has_double_prime

    pure function reason_text(homework, because) result(text)
        !! In which lines the mistake was made.
        type(homework_t), intent(in) :: homework    !! the sheet
        integer, intent(in) :: because(:)           !! statements that are wrong, one or two
        character(:), allocatable :: text

        associate (lines => homework%statements(because)%line)
            if (size(lines) == 1) then
                text = "from line "//to_text(lines(1))//", which is wrong"
            else
                text = "from lines "//to_text(minval(lines))//" and "//to_text(maxval(lines))// &
                       ", which are wrong"
            end if
        end associate
    end function reason_text
end module lagrangia_judged_sheet
