module lagrangia_usual_names
    !! Names that every course uses without saying so: H, U, p, v, the force S of a string. They
    !! stand for what they mostly mean, if the sheet does not define them; if it does, the
    !! definition is compared with that.
    use lagrangia_constancy, only: read_constancy
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, operator(**), operator(+), operator(-)
    use lagrangia_formula_characters, only: plain_letters
    use lagrangia_homework, only: homework_t
    use lagrangia_rounded_numbers, only: holds_to_digits
    use lagrangia_sample_names, only: role_parameter, samples_t, usual_t
    use lagrangia_slip_search, only: holds
    use lagrangia_small_energies, only: is_constant_of_each_draw
    use lagrangia_solved_accelerations, only: has_accelerations
    use lagrangia_statement_forms, only: define_rates, read_new_name
    use lagrangia_text, only: word_t
    use lagrangia_usual_meanings, only: collect_meanings
    implicit none (type, external)
    private
    public :: add_usual_names, find_usual, mark_used

    character(*), parameter :: digits = "0123456789"
    character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"

contains

    subroutine add_usual_names(d, homework, insisted, samples)
        !! Those that the sheet speaks of; it defines none of those in `insisted`, where
        !! `lambda=pull`, `T_1=tension1` choose one of several meanings.
        type(description_t), intent(in) :: d          !! of the system
        type(homework_t), intent(in) :: homework      !! the sheet
        type(word_t), intent(in) :: insisted(:)       !! names with their usual meaning
        type(samples_t), intent(inout) :: samples     !! get the names
        type(usual_t), allocatable :: all(:)
        character(name_length), allocatable :: said(:), given(:)
        type(error_t), allocatable :: error
        integer :: count, i

        call collect_meanings(d, samples, all)
        call collect_names(homework, samples, said, given)
        count = 0
        do i = 1, size(all)
            if (.not. is_said(all(i), said)) cycle
            count = count + 1
            if (count < i) all(count) = all(i)
        end do
        allocate (samples%usual(count))
        do i = 1, count
            samples%usual(i) = all(i)
            if (.not. is_insisted(all(i)%name)) then
                if (all(i)%only_compared) cycle
                if (.not. all(i)%always .and. any(given == bare_name(all(i)%name))) cycle
                if (is_effective(all(i)) .and. any(given == potential_of(all(i)))) cycle
            end if
            if (is_declared(all(i)%name)) cycle
            if (is_read_otherwise(all(i))) cycle
            call samples%symbols%define(trim(all(i)%name), all(i)%meaning, error)
            if (allocated(error)) cycle
            call define_rates(trim(all(i)%name), all(i)%meaning, samples)
        end do
    contains
        logical function is_insisted(name)
            character(*), intent(in) :: name
            integer :: k

            is_insisted = any([(insisted_name(k) == bare_name(name), k=1, size(insisted))])
        end function is_insisted

        logical function is_declared(name)
            !! Is it a constant of the sheet?
            character(*), intent(in) :: name
            integer :: k

            is_declared = any([(bare_name(samples%declared(k)) == bare_name(name), &
                                k=1, size(samples%declared))])
        end function is_declared

        logical function is_read_otherwise(usual)
            !! Is another meaning of this name chosen?
            type(usual_t), intent(in) :: usual
            integer :: k

            is_read_otherwise = .false.
            do k = 1, size(insisted)
                associate (text => insisted(k)%text)
                    if (index(text, "=") == 0 .or. insisted_name(k) /= bare_name(usual%name)) cycle
                    is_read_otherwise = text(index(text, "=") + 1:) /= usual%label
                end associate
            end do
        end function is_read_otherwise

        pure function insisted_name(k) result(name)
            integer, intent(in) :: k
            character(name_length) :: name

            associate (text => insisted(k)%text)
                name = bare_name(text(:index(text//"=", "=") - 1))
            end associate
        end function insisted_name
    end subroutine add_usual_names

    subroutine mark_used(homework, samples)
        !! The statements that define a name which another one has.
        type(homework_t), intent(inout) :: homework   !! the sheet
        type(samples_t), intent(in) :: samples        !! know the names that are not new
        type(homework_t) :: others
        character(name_length), allocatable :: said(:), given(:)
        character(:), allocatable :: name
        logical :: squared
        integer :: i

        do i = 1, size(homework%statements)
            associate (text => homework%statements(i)%text)
                call read_new_name(plain_letters(text(:max(0, index(text, "=") - 1))), samples, &
                                   name, squared)
            end associate
            if (name == "") cycle
            others = homework
            others%statements(i)%text = ""
            call collect_names(others, samples, said, given)
            homework%statements(i)%used = is_said(usual_t(name=name), said)
        end do
    end subroutine mark_used

    pure function is_said(usual, said) result(yes)
        !! Does the sheet have this name, or of `dH_dx` the H?
        type(usual_t), intent(in) :: usual
        character(name_length), intent(in) :: said(:)
        logical :: yes
        integer :: i

        if (is_effective(usual)) then
            yes = any(said == potential_of(usual))
        else if (any(usual%name(:4) == ["dH_d", "dU_d"])) then
            yes = any(said == usual%name(2:2))
        else if (usual%always) then
            yes = any(said == usual%name)
        else
            yes = any([(bare_name(said(i)) == bare_name(usual%name), i=1, size(said))])
        end if
    end function is_said

    pure logical function is_effective(usual)
        !! Is it the slope of an effective potential, `dV_eff_dr`, or the slope of that?
        type(usual_t), intent(in) :: usual

        is_effective = usual%name(1:1) == "d" .and. any(potential_of(usual) == ["V_eff", "U_eff"])
    end function is_effective

    pure function potential_of(usual) result(name)
        !! `V_eff` of `dV_eff_dr` and of `ddV_eff_dr_dr`.
        type(usual_t), intent(in) :: usual
        character(5) :: name
        integer :: first

        first = merge(3, 2, usual%name(:2) == "dd")
        name = usual%name(first:first + 4)
    end function potential_of

    subroutine find_usual(name, meaning, text, samples, known, agrees, label)
        !! Whether a definition is what its name mostly stands for.
        character(*), intent(in) :: name                    !! that it defines
        type(expression_t), intent(in) :: meaning           !! as the sheet has it
        character(*), intent(in) :: text                    !! both sides, as typed
        type(samples_t), intent(in) :: samples              !! with the usual names
        logical, intent(out) :: known                       !! there is something to compare with
        logical, intent(out) :: agrees                      !! it is that
        character(:), allocatable, intent(out) :: label     !! what that is
        logical :: of_force
        integer :: i

        known = .false.
        agrees = .false.
        label = ""
        of_force = has_accelerations(meaning, samples)
        do i = 1, size(samples%usual)
            associate (usual => samples%usual(i))
                if (bare_name(usual%name) /= bare_name(name)) cycle
                agrees = is_same(usual%meaning - meaning, usual%any_zero, samples)
                if (usual%either_sign .and. .not. agrees) then
                    if (usual%any_zero) then
                        agrees = is_same(usual%meaning + meaning, .true., samples)
                    else
                        agrees = is_same(usual%meaning**2 - meaning**2, .false., samples)
                    end if
                end if
                if (usual%is_force .and. .not. agrees) agrees = holds_to_digits( &
                    usual%meaning, meaning, text, samples)
                if (.not. agrees .and. .not. usual%is_force .and. &
                    (moves(usual%meaning, samples) .neqv. moves(meaning, samples))) cycle
                known = .true.
                if (agrees .or. label == "" .or. of_force .and. usual%is_force) label = &
                    trim(usual%label)
                of_force = of_force .and. .not. usual%is_force
            end associate
            if (agrees) return
        end do
    end subroutine find_usual

    function is_same(residual, but_constant, samples) result(yes)
        !! Is it zero on the motion, or a constant for each draw of parameters?
        type(expression_t), intent(in) :: residual
        logical, intent(in) :: but_constant
        type(samples_t), intent(in) :: samples
        logical :: yes, judged

        call holds(residual, samples%values, yes, judged)
        if (.not. yes .and. but_constant) yes = is_constant_of_each_draw(residual, samples)
    end function is_same

    pure function moves(expression, samples) result(yes)
        !! Is there more in it than parameters?
        type(expression_t), intent(in) :: expression
        type(samples_t), intent(in) :: samples
        logical :: yes
        integer :: k

        yes = .false.
        do k = 1, size(samples%role)
            if (.not. expression%depends_on(k)) cycle
            yes = yes .or. samples%role(k) /= role_parameter .or. samples%rate(k) > 0
        end do
    end function moves

    subroutine collect_names(homework, samples, said, given)
        !! All names of the sheet, also without `d` before and `_dot` behind them; and the bare ones
        !! of those that it defines.
        type(homework_t), intent(in) :: homework
        type(samples_t), intent(in) :: samples
        character(name_length), allocatable, intent(out) :: said(:), given(:)
        character(:), allocatable :: name, plain, rest
        logical :: is_constant, of_roots, squared
        integer :: first, i, last

        allocate (said(0), given(0))
        of_roots = .false.  ! lambda^2 + k/m = 0 is about no force
        do i = 1, size(homework%statements)
            of_roots = of_roots .or. index(plain_letters(homework%statements(i)%text), &
                                           "lambda^") > 0
        end do
        do i = 1, size(homework%statements)
            associate (text => homework%statements(i)%text)
                plain = plain_letters(text)
                first = 1
                do
                    last = scan(plain(first:), letters)
                    if (last == 0) exit
                    first = first + last - 1
                    last = first + verify(plain(first:)//" ", letters//digits//"_") - 2
                    if (.not. (is_newton(plain, first, last) .or. of_roots .and. &
                               plain(first:last) == "lambda")) call add(plain(first:last))
                    first = last + 1
                end do
                call read_new_name(plain(:max(0, index(plain, "=") - 1)), samples, name, squared)
                call read_constancy(plain(index(plain, "=") + 1:), samples, rest, is_constant)
                if (name /= "" .and. .not. is_constant) given = [character(name_length) :: given, &
                                         bare_name(name)]
            end associate
        end do
    contains
        subroutine add(word)
            character(*), intent(in) :: word
            integer :: k

            k = index(word, "_d", back=.true.)
            if (k == 0) k = len(word) + 1
            if (k <= len(word)) then
                if (word(k:) /= "_dot" .and. word(k:) /= "_ddot") k = len(word) + 1
            end if
            call add_one(word)
            call add_one(word(:k - 1))
            if (word(1:1) == "d" .and. k > 2) call add_one(word(2:k - 1))
        end subroutine add

        subroutine add_one(word)
            character(*), intent(in) :: word
            character(name_length) :: one

            one = word
            if (len(word) > name_length .or. any(said == one)) return
            said = [character(name_length) :: said, one]
        end subroutine add_one
    end subroutine collect_names

    pure function is_newton(text, first, last) result(yes)
        !! `23.5 N`: a unit behind a number of several digits, and no normal force.
        character(*), intent(in) :: text      !! a statement in plain letters
        integer, intent(in) :: first, last    !! of a name in it
        logical :: yes
        integer :: before, begun

        yes = text(first:last) == "N"
        if (.not. yes) return
        before = len_trim(text(:first - 1))
        begun = verify(text(:before), digits//".", back=.true.) + 1
        yes = before - begun >= 1 .and. scan(text(max(1, begun - 1):begun - 1), letters//"_^") == 0
    end function is_newton

    pure function bare_name(name) result(bare)
        !! Without the `_` before a number behind: `T1` of `T_1`.
        character(*), intent(in) :: name
        character(name_length) :: bare
        integer :: k

        bare = name
        k = verify(trim(name), digits, back=.true.)
        if (k < 2 .or. k == len_trim(name)) return
        if (name(k:k) == "_") bare = name(:k - 1)//name(k + 1:)
    end function bare_name

end module lagrangia_usual_names
