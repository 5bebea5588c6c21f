module lagrangia_set_lines
    !! Lines `set:` of a sheet: values as formulas of numbers, parameters by their letters; a value
    !! in other parameters is a condition. A line holds for those behind it; one that cannot be is a
    !! statement that nobody can read, and no line behind it is called wrong.
    use lagrangia_constant_formula, only: read_constant
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_expression, only: is_function_name
    use lagrangia_formula_characters, only: plain_letters
    use lagrangia_grading, only: grade, grade_t
    use lagrangia_homework, only: homework_t, state_setting
    use lagrangia_judged_sheet, only: reason_text
    use lagrangia_judgement, only: is_consequence, is_unreadable, is_wrong
    use lagrangia_kinds, only: dp
    use lagrangia_names, only: name_length
    use lagrangia_parameter_choice, only: find_parameter, occurs
    use lagrangia_scene_reader, only: read_named_system
    use lagrangia_system, only: system_t
    use lagrangia_text, only: append_word, quoted, short_source, to_text, word_t
    implicit none (type, external)
    private
    public :: grade_with_settings

    character(*), parameter :: in_parameters = "in parameters"  !! a value: the line is a condition
    character(*), parameter :: of_number = "0123456789+-.eEdD ,"
    character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"

contains

    subroutine grade_with_settings(homework, system, result, error)
        !! Judge each statement with what the lines `set:` before it fix.
        type(homework_t), intent(inout) :: homework          !! a line `set:` may become a statement
        class(system_t), allocatable, intent(out) :: system  !! with all that they fix
        type(grade_t), intent(out) :: result                 !! a judgement of each statement
        type(error_t), allocatable, intent(out) :: error     !! no such system, or no states
        type(homework_t) :: part
        type(grade_t) :: attempt
        integer, allocatable :: before(:)
        integer :: i, k, n

        call read_named_system(homework%system, homework%settings(:0), system, error)
        if (allocated(error)) then
            call error%add_context(trim(short_source(homework%source))//":"// &
                                   to_text(homework%system_line))
            return
        end if
        call read_settings(homework, system)
        before = settings_before(homework)
        n = -1
        do i = 1, size(before)
            if (before(i) == n) cycle
            n = before(i)
            part = homework
            call keep_first(homework, n, part%settings)
            call configured(homework%system, part%settings, system, error)
            if (.not. allocated(error)) call grade(part, system, attempt, error)
            if (allocated(error)) return
            if (i > 1) then
                do k = 1, i - 1
                    attempt%of(k) = result%of(k)
                end do
                call keep_consequences(homework, attempt, i)
            end if
            call move_alloc(attempt%of, result%of)
            call move_alloc(attempt%kept, result%kept)
            call move_alloc(attempt%meaning, result%meaning)
            call move_alloc(attempt%determined, result%determined)
            result%equations = attempt%equations
        end do
        call spare_lines(homework, result)
    end subroutine grade_with_settings

    pure subroutine spare_lines(homework, result)
        !! What is wrong without a line `set:` that cannot be read may be right with it.
        type(homework_t), intent(in) :: homework
        type(grade_t), intent(inout) :: result
        integer :: k, refused

        refused = 0
        do k = 1, size(homework%statements)
            if (homework%statements(k)%refusal /= "") refused = homework%statements(k)%line
            if (refused == 0) cycle
            associate (judgement => result%of(k))
                if (judgement%verdict /= is_wrong .and. judgement%verdict /= is_consequence) cycle
                judgement%verdict = is_unreadable
                judgement%remark = "wrong without line "//to_text(refused)// &
                                   ", which cannot be read; with it perhaps not"
                judgement%example = ""
                if (allocated(judgement%because)) deallocate (judgement%because)
            end associate
        end do
    end subroutine spare_lines

    pure function settings_before(homework) result(number)
        !! How many settings stand before each statement.
        type(homework_t), intent(in) :: homework
        integer :: number(size(homework%statements))
        integer :: i

        do i = 1, size(number)
            number(i) = count(homework%setting_lines < homework%statements(i)%line)
        end do
    end function settings_before

    pure subroutine keep_consequences(homework, result, first)
        !! What follows from a mistake in front of a line `set:` is wrong where that holds there.
        type(homework_t), intent(in) :: homework
        type(grade_t), intent(inout) :: result
        integer, intent(in) :: first     !! the first statement behind that line
        integer :: k

        do k = first, size(result%of)
            if (result%of(k)%verdict /= is_consequence) cycle
            if (.not. allocated(result%of(k)%because)) cycle
            result%of(k)%because = pack(result%of(k)%because, &
                                        result%of(result%of(k)%because)%verdict == is_wrong)
            if (size(result%of(k)%because) > 0) then
                result%of(k)%remark = reason_text(homework, result%of(k)%because)
                cycle
            end if
            result%of(k)%verdict = is_wrong
            result%of(k)%remark = "with what the lines 'set:' before it fix"
            deallocate (result%of(k)%because)
        end do
    end subroutine keep_consequences

    pure subroutine keep_first(homework, number, settings)
        !! The first so many; of one parameter the last, where statements stand between two lines.
        type(homework_t), intent(in) :: homework
        integer, intent(in) :: number
        type(word_t), allocatable, intent(out) :: settings(:)
        integer :: i, k
        logical :: replaced

        allocate (settings(0))
        do i = 1, number
            replaced = .false.
            do k = i + 1, number
                if (name_of(homework%settings(i)) /= name_of(homework%settings(k))) cycle
                replaced = replaced .or. any( &
                    homework%statements%line > homework%setting_lines(i) .and. &
                    homework%statements%line < homework%setting_lines(k))
            end do
            if (.not. replaced) call append_word(settings, homework%settings(i)%text)
        end do
    end subroutine keep_first

    pure function name_of(setting) result(name)
        !! In front of `=`.
        type(word_t), intent(in) :: setting
        character(name_length) :: name

        name = setting%text(:index(setting%text, "=") - 1)
    end function name_of

    subroutine read_settings(homework, system)
        !! Names of parameters and numbers, in all settings; those that cannot be become statements.
        type(homework_t), intent(inout) :: homework
        class(system_t), intent(in) :: system
        class(system_t), allocatable :: tried
        type(word_t), allocatable :: kept(:)
        type(description_t) :: d
        type(error_t), allocatable :: error
        character(:), allocatable :: option
        integer :: i, n

        call system%describe(d)
        option = "--set "//trim(d%name)//"%"  ! as messages begin
        i = 1
        do while (i <= size(homework%settings))
            call read_setting(homework%settings(i)%text, d, error)
            if (.not. allocated(error)) then
                call keep_first(homework, i, kept)
                call configured(homework%system, kept, tried, error)
            end if
            if (.not. allocated(error)) then
                i = i + 1
                cycle
            end if
            if (error%message == in_parameters) then
                call state_setting(homework, i, "")
                cycle
            end if
            n = index(error%message, "&"//trim(d%name)//": ")
            if (index(error%message, option) == 1 .and. n > 0) error%message = &
                error%message(n + len_trim(d%name) + 3:)
            n = index(error%message, "another --set")
            if (n > 0) error%message = error%message(:n - 1)//"another line 'set:'"// &
                                       error%message(n + 13:)
            call state_setting(homework, i, error%message//&
                                "; the lines behind are judged without it")
        end do
    end subroutine read_settings

    subroutine configured(name, settings, system, error)
        !! The system with these parameters.
        character(*), intent(in) :: name                     !! of a system or a scene
        type(word_t), intent(in) :: settings(:)              !! `name=value`
        class(system_t), allocatable, intent(out) :: system  !! with them
        type(error_t), allocatable, intent(out) :: error     !! a value that is not allowed
        type(word_t), allocatable :: options(:)
        type(description_t) :: d
        integer :: i

        call read_named_system(name, settings(:0), system, error)
        if (allocated(error) .or. size(settings) == 0) return
        call system%describe(d)
        allocate (options(size(settings)))
        do i = 1, size(settings)
            options(i)%text = option_of(settings(i)%text, d)
        end do
        call read_named_system(name, options, system, error)
    end subroutine configured

    pure function option_of(said, d) result(option)
        !! `magnetic_y=1` is `charged_particle%magnetic(2)=1` to the reader.
        character(*), intent(in) :: said          !! `name=value`
        type(description_t), intent(in) :: d      !! of the system
        character(:), allocatable :: option
        integer :: element, equals, parameter

        equals = index(said, "=")
        option = trim(d%name)//"%"//said
        call find_parameter(d, said(:equals - 1), parameter, element)
        if (parameter == 0 .or. element == 0) return
        associate (p => d%parameters(parameter))
            if (p%count > 1) option = trim(d%name)//"%"//trim(p%name)//"("//to_text(element)// &
                                      ")"//said(equals:)
        end associate
    end function option_of

    subroutine read_setting(said, d, error)
        !! The parameter's own name for a letter, and a number for a formula of numbers.
        character(:), allocatable, intent(inout) :: said   !! `name=value`
        type(description_t), intent(in) :: d               !! of the system
        type(error_t), allocatable, intent(out) :: error   !! neither a parameter nor a number
        character(:), allocatable :: name, value
        integer :: element, equals, i, parameter

        equals = index(said, "=")
        name = trim(plain_letters(said(:equals - 1)))
        value = trim(adjustl(said(equals + 1:)))
        call find_parameter(d, name, parameter, element)
        if (parameter == 0 .and. allocated(d%letters)) then
            do i = 1, size(d%letters)  ! E_x = electric_x
                if (d%letters(i)%name /= name) cycle
                call find_parameter(d, trim(d%letters(i)%formula), parameter, element)
                if (parameter > 0) name = trim(d%letters(i)%formula)
            end do
        end if
        if (parameter > 0) then
            associate (p => d%parameters(parameter))
                if (element > p%count .and. p%count == 1) then
                    call fail(error, trim(p%name)//" is one number, without an index")
                else if (element > p%count) then
                    call fail(error, trim(p%name)//" has "//to_text(p%count)//" values, "// &
                              trim(p%name)//"(1) to "//trim(p%name)//"("//to_text(p%count)//")")
                end if
                if (allocated(error)) return
                if (p%count == 1 .or. element > 0) call read_value(value, d, parameter, &
                                                                       trim(p%unit), error)
            end associate
            if (allocated(error)) return
        end if
        said = name//"="//value
    end subroutine read_setting

    subroutine read_value(value, d, parameter, unit, error)
        !! `pi/2`, `0.20 kg` of a mass; a number stays as it is.
        character(:), allocatable, intent(inout) :: value   !! as typed
        type(description_t), intent(in) :: d                !! of the system
        integer, intent(in) :: parameter                    !! its place
        character(*), intent(in) :: unit                    !! of the parameter
        type(error_t), allocatable, intent(out) :: error    !! it is no number
        character(26) :: digits
        real(dp) :: number
        integer :: behind, i

        if (value == "" .or. is_one_number(value)) return
        behind = verify(value, "0123456789+-.") - 1
        if (behind > 0) then
            if (trim(adjustl(value(behind + 1:))) == unit) then
                value = value(:behind)
                return
            else if (scan(value(behind + 1:), letters) > 0 .and. &
                     verify(value(behind + 1:), " "//letters//"/^*()[].-0123456789") == 0 .and. &
                     scan(value(behind + 1:behind + 1), " "//letters) == 1 .and. &
                     .not. all_names_known() .and. index(value, "pi") == 0) then
                call fail(error, quoted(trim(adjustl(value(behind + 1:))))//" is not read; "// &
                          "write the number alone"//in_unit())
                return
            end if
        end if
        if (any([(occurs(value, trim(d%parameters(i)%name)), i=1, size(d%parameters))])) then
            call fail(error, in_parameters)
            return
        end if
        call read_constant(value, number, error)
        if (allocated(error)) return
        write (digits, "(ss, es26.17e3)") number
        value = trim(adjustl(digits))
    contains
        pure logical function all_names_known()
            !! Those of other parameters: `m/s2`, `m (rod)` and the `m` of m = 2 m are units.
            integer :: at, element, first, last

            all_names_known = .true.
            first = 1
            do
                at = scan(value(first:), letters)
                if (at == 0) return
                first = first + at - 1
                last = first + verify(value(first:)//" ", letters//"_0123456789") - 2
                call find_parameter(d, value(first:last), at, element)
                if (at == 0 .and. allocated(d%letters)) then
                    at = -count(d%letters%name == value(first:last))
                end if
                if (.not. is_function_name(value(first:last))) then
                    all_names_known = all_names_known .and. at /= 0 .and. at /= parameter
                end if
                first = last + 1
            end do
        end function all_names_known

        function in_unit() result(words)
            character(:), allocatable :: words

            words = ""
            if (unit /= "1") words = ", in "//unit
        end function in_unit
    end subroutine read_value

    pure function is_one_number(text) result(yes)
        !! Or several with commas or blanks between them, for the scene's reader; `1 + 1` is none.
        character(*), intent(in) :: text
        logical :: yes
        integer :: i

        yes = verify(text, of_number) == 0
        do i = 2, len(text)
            if (scan(text(i:i), "+-") == 0) cycle
            yes = yes .and. scan(text(i - 1:i - 1), "eEdD ,") == 1 .and. &
                  text(min(i + 1, len(text)):min(i + 1, len(text))) /= " "
        end do
    end function is_one_number
end module lagrangia_set_lines
