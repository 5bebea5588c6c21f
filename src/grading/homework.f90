module lagrangia_homework
    !! A student's lines as text: which system they are about, and one statement a line.
    !!
    !! ```
    !! # group 7, sheet 3
    !! system: double_pendulum
    !! D = theta1 - theta2
    !! L_z = p_theta1 + p_theta2
    !! l1 theta1_ddot + ... = 0
    !! ```
    !! `#` begins a comment. `system:` names a system of the catalogue or a scene file, `set:` fixes
    !! a parameter for the lines behind it (`set: g = 0`), `constant: h, C` makes names of constants
    !! of integration, and behind `small:` is a statement about small oscillations. A line of words
    !! is a remark. A line that ends in `\` goes on in the next one. Lines end in LF, CR or both; a
    !! byte order mark is skipped, and other signs for `=` and `:` are read as these.
    use lagrangia_characters, only: decode, plainly
    use lagrangia_errors, only: error_t, fail, status_file
    use lagrangia_files, only: facts_t, look_at
    use lagrangia_names, only: name_length, nearest_name
    use lagrangia_sheet_lines, only: is_remark, read_statements
    use lagrangia_shipped_files, only: read_file_or_shipped, shipped_files
    use lagrangia_text, only: append_word, lower, quoted, short_source, to_text, word_t
    implicit none (type, external)
    private
    public :: homework_t, statement_t
    public :: parse_homework, read_homework, state_setting

    integer, parameter :: statement_length = 10000  !! bytes of one statement at most
    integer, parameter :: most_statements = 1000    !! of one file
    integer, parameter :: refusal_length = 400      !! of its reason at most

    type :: statement_t
        !! One line of the file, as it was typed.
        character(:), allocatable :: text  !! without comment, continued lines joined
        integer :: line = 0                !! number in the file, from 1
        logical :: small = .false.         !! to first order: behind `small:`
        logical :: used = .false.          !! another one has the name that it defines
        character(refusal_length) :: refusal = ""  !! why a line `set:` cannot be read
    end type statement_t

    type :: homework_t
        !! What a file says.
        character(:), allocatable :: source              !! the file's name, for messages
        character(:), allocatable :: system              !! a name, or the path of a scene
        integer :: system_line = 0                       !! where that stands
        type(word_t), allocatable :: settings(:)         !! `name=value`, behind `set:`
        integer, allocatable :: setting_lines(:)         !! where these stand
        type(word_t), allocatable :: constants(:)        !! names behind `constant:`
        integer, allocatable :: constant_lines(:)        !! where these stand
        type(statement_t), allocatable :: statements(:)  !! in the order of the file
    end type homework_t

contains

    subroutine read_homework(path, homework, error)
        !! The file at `path`; or the sheet of that name which the program carries.
        character(*), intent(in) :: path                  !! of a readable file, or `atwood`
        type(homework_t), intent(out) :: homework         !! its statements
        type(error_t), allocatable, intent(out) :: error  !! names file and line
        character(:), allocatable :: text

        character(:), allocatable :: source

        call find_sheet(path, source, error)
        if (.not. allocated(error)) call read_file_or_shipped(source, text, error)
        if (.not. allocated(error)) call parse_homework(text, source, homework, error)
    end subroutine read_homework

    subroutine find_sheet(name, path, error)
        !! The path of the sheet that the program carries by this name, where no file has it; else
        !! the name itself. Fails where there is neither.
        character(*), intent(in) :: name
        character(:), allocatable, intent(out) :: path
        type(error_t), allocatable, intent(out) :: error
        character(*), parameter :: folder = "data/homework/", ending = ".txt"
        character(name_length), allocatable :: names(:)
        character(:), allocatable :: near
        type(word_t), allocatable :: paths(:)
        type(facts_t) :: facts
        integer :: i, last

        path = name
        facts = look_at(name)
        if (facts%found .or. facts%barred .or. name == "") return  ! the reader says what bars it
        call shipped_files(folder, paths)
        allocate (names(size(paths)))
        do i = 1, size(paths)
            names(i) = paths(i)%text(len(folder) + 1:len(paths(i)%text) - len(ending))
            if (name == paths(i)%text) return
        end do
        path = folder//name//ending
        if (any(names == name)) return
        last = index(name, ".", back=.true.)
        if (last <= index(name, "/", back=.true.)) last = len(name) + 1
        near = nearest_name(name(index(name, "/", back=.true.) + 1:last - 1), names)
        if (near /= "") then
            near = "did you mean the sheet '"//near//"'?"
        else
            near = "a sheet is a text with a line 'system: NAME' and statements, one a line; "// &
                   "'lagrangia show' lists those that come with the program"
        end if
        call fail(error, trim(short_source(name))//": no such file; "//near, status_file)
    end subroutine find_sheet

    subroutine parse_homework(text, source, homework, error)
        !! The lines of `text`.
        character(*), intent(in) :: text                  !! lines between line feeds
        character(*), intent(in) :: source                !! its name, for messages
        type(homework_t), intent(out) :: homework         !! its statements
        type(error_t), allocatable, intent(out) :: error  !! names `source` and the line
        character(:), allocatable :: line, whole
        integer :: first, number, begun

        homework%source = source
        homework%system = ""
        allocate (homework%settings(0), homework%setting_lines(0), homework%statements(0))
        allocate (homework%constants(0), homework%constant_lines(0))
        whole = ""
        begun = 0
        number = 0
        first = 1
        if (index(text, char(239)//char(187)//char(191)) == 1) first = 4  ! a byte order mark
        do while (first <= len(text))
            number = number + 1
            call next_line(text, first, line)
            if (line == "" .and. whole == "") cycle
            if (whole == "") begun = number
            if (is_frame_of_latex(line)) cycle
            if (len(line) > 1) then
                if (line(len(line) - 1:) == "\\") line = trim(line(:len(line) - 2))
            end if
            if (len(line) > 0) then
                if (line(len(line):) == "\") then
                    whole = whole//line(:len(line) - 1)//" "
                    cycle
                end if
            end if
            call take(homework, trim(adjustl(whole//line)), begun, error)
            if (allocated(error)) return
            whole = ""
        end do
        if (whole /= "") call take(homework, trim(adjustl(whole)), begun, error)
        if (allocated(error)) return
        if (homework%system == "") then
            call fail(error, trim(short_source(source))// &
                      ": no line 'system: NAME' says which system this is "// &
                      "about; 'lagrangia list systems' shows the names")
        else if (size(homework%statements) == 0) then
            call fail(error, trim(short_source(source))// &
                      ": nothing to grade; write a line 'left = right', say "// &
                      "an equation of motion")
        end if
    end subroutine parse_homework

    pure function is_frame_of_latex(line) result(yes)
        !! `\begin{align}`, `\[`, `$$`: a line without a formula.
        character(*), intent(in) :: line
        logical :: yes
        character(:), allocatable :: begun

        begun = adjustl(line)
        yes = index(begun, "\begin{") == 1 .or. index(begun, "\end{") == 1
        if (yes) yes = index(begun, "=") == 0
        yes = yes .or. any(begun == [character(2) :: "\[", "\]", "$$"])
    end function is_frame_of_latex

    pure subroutine next_line(text, first, line)
        !! The line that begins at `first`, without its comment and outer blanks; `first` moves on.
        character(*), intent(in) :: text
        integer, intent(inout) :: first
        character(:), allocatable, intent(out) :: line
        integer :: last, i

        last = scan(text(first:), char(13)//new_line("a"))
        last = merge(len(text) + 1, first + last - 1, last == 0)
        line = text(first:last - 1)
        if (index(text(last:), char(13)//new_line("a")) == 1) last = last + 1
        first = last + 1
        i = index(line, "#")
        if (i > 0) line = line(:i - 1)
        do i = 1, len(line)
            if (line(i:i) == char(9)) line(i:i) = " "
        end do
        line = trim(with_plain_equals(line))
        call put_sign(line, "\approx", "~")
        call put_sign(line, "\simeq", "~")
        call put_sign(line, "\equiv", "=")
    end subroutine next_line

    pure subroutine put_sign(line, command, sign)
        !! A sign of as many characters for a command of LaTeX.
        character(:), allocatable, intent(inout) :: line
        character(*), intent(in) :: command
        character, intent(in) :: sign
        integer :: at

        do
            at = index(line, command)
            if (at == 0) return
            line(at:at + len(command) - 1) = sign
        end do
    end subroutine put_sign

    pure function with_plain_equals(line) result(plain)
        !! `=` for signs that mean it, `:` for the wide one.
        character(*), intent(in) :: line
        character(:), allocatable :: plain
        integer :: code, i, length

        plain = ""
        i = 1
        do while (i <= len(line))
            call decode(line, i, code, length)
            select case (code)
            case (int(z"2254"), int(z"225C"), int(z"225D"), int(z"2261"), int(z"FF1D"))
                plain = plain//"="
            case (int(z"FF1A")); plain = plain//":"
            case default; plain = plain//line(i:i + length - 1)
            end select
            i = i + length
        end do
        i = index(plain, ":=")
        if (i > 0) plain(i:i) = " "
    end function with_plain_equals

    subroutine take(homework, text, number, error)
        !! Whatever the line says.
        type(homework_t), intent(inout) :: homework
        character(*), intent(in) :: text
        integer, intent(in) :: number
        type(error_t), allocatable, intent(out) :: error
        character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
        integer :: colon

        colon = index(text, ":")
        if (len(text) > statement_length) then
            call refuse("longer than "//to_text(statement_length)//" bytes")
        else if (colon > 0) then
            select case (lower(trim(adjustl(plainly(text(:colon - 1))))))
            case ("system")
                if (homework%system /= "") then
                    call refuse("'system:' a second time; one file is about one system")
                    return
                end if
                homework%system = trim(adjustl(plainly(text(colon + 1:))))
                homework%system_line = number
                if (homework%system == "") call refuse("'system:' needs a name; "// &
                    "'lagrangia list systems' shows them")
            case ("set")
                if (index(text, "=") == 0) then
                    call refuse_line("'set:' needs a parameter and its value, "// &
                                     "say 'set: g = 9.81'")
                else
                    call add_settings(plainly(text(colon + 1:)))
                end if
            case ("constant", "constants")
                call add_names(plainly(text(colon + 1:)))
            case ("small")
                call add_statement(text)
            case default
                if (is_remark(text)) then
                    return
                else if (is_label(text(:colon - 1))) then
                    call take_statements(trim(adjustl(text(colon + 1:))))
                else if (verify(trim(text(:colon - 1)), letters) == 0) then
                    call refuse("column "//to_text(colon)//": what is "// &
                                quoted(trim(text(:colon - 1)))//":? Before a colon stands "// &
                                "'system', 'set', 'constant' or 'small'")
                else
                    call add_statement(text)  ! which nobody can read
                end if
            end select
        else if (.not. is_remark(text)) then
            call take_statements(text)
        end if
    contains
        logical function is_label(words)
            !! `Equation of motion: ...`: not one that is nearly `system`, `set` or `small`.
            character(*), intent(in) :: words
            character(name_length), parameter :: ours(*) = [character(name_length) :: "system", &
                                                            "set", "small", "constant"]

            is_label = index(text(colon + 1:), "=") > 0 .and. len_trim(words) > 3 .and. &
                       scan(words, "=+*/^<>_\|{}'()") == 0
            if (is_label) is_label = nearest_name(trim(plainly(words)), ours) == ""
        end function is_label

        subroutine take_statements(said)
            !! Those of a line.
            character(*), intent(in) :: said
            type(word_t), allocatable :: parts(:)
            character(:), allocatable :: before
            integer :: i, n

            n = size(homework%statements)
            before = ""
            if (n > 0) before = homework%statements(n)%text
            call read_statements(said, before, parts)
            do i = 1, size(parts)
                call add_statement(parts(i)%text)
                if (allocated(error)) return
            end do
        end subroutine take_statements

        subroutine add_names(list)
            !! Names between commas or blanks.
            character(*), intent(in) :: list
            integer :: first, last

            if (verify(list, " ,") == 0) call refuse("'constant:' needs names, say "// &
                                                     "'constant: C, h'")
            first = 1
            do while (first <= len(list))
                last = verify(list(first:), " ,")
                if (last == 0) return
                first = first + last - 1
                last = first + scan(list(first:)//" ", " ,") - 2
                call append_word(homework%constants, list(first:last))
                homework%constant_lines = [homework%constant_lines, number]
                first = last + 1
            end do
        end subroutine add_names

        subroutine add_settings(list)
            !! `omega = 5, g = 9.81`: a comma before a name and `=` ends one.
            character(*), intent(in) :: list
            integer :: comma, first, next

            first = 1
            do
                next = first
                do
                    comma = index(list(next:), ",")
                    if (comma == 0) exit
                    comma = next + comma - 1
                    next = comma + 1
                    if (index(list(next:), "=") == 0) comma = 0
                    if (comma == 0) exit
                    if (scan(list(next:next + index(list(next:), "=") - 2), ",") == 0 .and. &
                        verify(list(next:next + index(list(next:), "=") - 2), " .0123456789") &
                        > 0) exit
                end do
                if (comma == 0) exit
                call add_setting(list(first:comma - 1))
                first = comma + 1
            end do
            call add_setting(list(first:))
        end subroutine add_settings

        subroutine add_setting(setting)
            !! Blanks stay between several values only, `electric = 0 0 1`; `m1 = m2 = 1` is two.
            character(*), intent(in) :: setting
            character(*), parameter :: of_names = letters//"_0123456789() "
            integer :: equals, first, last

            last = index(setting, "=", back=.true.)
            if (verify(setting(:max(last - 1, 0)), of_names//"=") > 0 .and. &
                index(setting, "=") < last) then
                call refuse_line("a line 'set:' has one '=' for each parameter, "// &
                                 "'set: m1 = 1, m2 = 1'")
                return
            end if
            first = 1
            do
                equals = first + index(setting(first:), "=") - 1
                call append_word(homework%settings, trim(adjustl(setting(first:equals - 1)))// &
                                 "="//trim(adjustl(setting(last + 1:))))
                homework%setting_lines = [homework%setting_lines, number]
                if (equals == last) return
                first = equals + 1
            end do
        end subroutine add_setting

        subroutine add_statement(said)
            character(*), intent(in) :: said

            if (size(homework%statements) == most_statements) then
                call refuse("more than "//to_text(most_statements)//" statements")
                return
            end if
            call insert_statement(homework, said, number)
            homework%statements(size(homework%statements))%small = &
                index(said, "small") == 1 .and. index(said, ":") > 0
        end subroutine add_statement

        subroutine refuse_line(why)
            !! A line `set:` that cannot be read; the others are graded without it.
            character(*), intent(in) :: why

            call add_statement(text)
            if (allocated(error)) return
            homework%statements(size(homework%statements))%refusal = why
        end subroutine refuse_line

        subroutine refuse(what)
            character(*), intent(in) :: what

            call fail(error, trim(short_source(homework%source))//":"//to_text(number)//": "//what)
        end subroutine refuse
    end subroutine take

    subroutine insert_statement(homework, said, number)
        !! One more, in front of those of later lines.
        type(homework_t), intent(inout) :: homework
        character(*), intent(in) :: said
        integer, intent(in) :: number   !! its line
        type(statement_t), allocatable :: longer(:)
        integer :: i, k, n, place

        n = size(homework%statements)
        place = 1 + count(homework%statements%line <= number)
        allocate (longer(n + 1))
        do i = 1, n
            k = merge(i, i + 1, i < place)
            call move_alloc(homework%statements(i)%text, longer(k)%text)
            longer(k)%refusal = homework%statements(i)%refusal
            longer(k)%line = homework%statements(i)%line
            longer(k)%small = homework%statements(i)%small
        end do
        longer(place)%text = said
        longer(place)%line = number
        call move_alloc(longer, homework%statements)
    end subroutine insert_statement

    subroutine state_setting(homework, which, why)
        !! What a line `set:` says becomes a statement: a condition, or one that nobody can read.
        type(homework_t), intent(inout) :: homework  !! loses the setting
        integer, intent(in) :: which                 !! its place among all settings
        character(*), intent(in) :: why              !! it cannot be; or ""
        type(word_t), allocatable :: settings(:)
        integer :: equals, i, line, place

        line = homework%setting_lines(which)
        associate (text => homework%settings(which)%text)
            equals = index(text, "=")
            call insert_statement(homework, trim(text(:equals - 1))//" = "//text(equals + 1:), line)
        end associate
        place = count(homework%statements%line <= line)
        homework%statements(place)%refusal = why
        if (why /= "") homework%statements(place)%text = "set: "//homework%statements(place)%text
        allocate (settings(0))
        do i = 1, size(homework%settings)
            if (i /= which) call append_word(settings, homework%settings(i)%text)
        end do
        call move_alloc(settings, homework%settings)
        homework%setting_lines = [homework%setting_lines(:which - 1), &
                                  homework%setting_lines(which + 1:)]
    end subroutine state_setting
end module lagrangia_homework
