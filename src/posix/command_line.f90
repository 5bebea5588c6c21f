module lagrangia_command_line
    !! The words of a command line: a command, its arguments, its options.
    use lagrangia_characters, only: plainly, unlike
    use lagrangia_errors, only: error_t, fail
    use lagrangia_text, only: append_word, quoted, to_text, word_t
    implicit none (type, external)
    private
    public :: word_t, option_t, command_line_t
    public :: command_words, has_outer_blanks, is_same, parse_words, without_hyphens
    public :: no_value, needs_value, may_have_value

    integer, parameter :: no_value = 0, needs_value = 1, may_have_value = 2
    integer, parameter :: longest_word = 4096

    type :: option_t
        !! An option that exists: `--name`, what its value is, what it does.
        character(16) :: name = ""
        integer :: takes = no_value
        character(24) :: value = ""
        character(80) :: meaning = ""
        logical :: repeatable = .false.  !! several values may be given
        logical :: any_text = .false.    !! a value may begin or end with blanks
    end type option_t

    type :: command_line_t
        !! What was typed.
        character(:), allocatable :: command              !! "" where there is none
        type(word_t), allocatable :: arguments(:)
        type(word_t), allocatable :: names(:), values(:)  !! of the options, in order
        character(:), allocatable :: unknown_option       !! the first one that is none, or ""
    contains
        procedure :: has
        procedure :: value_of
        procedure :: values_of
    end type command_line_t

contains

    subroutine command_words(words, error)
        !! The program's arguments.
        type(word_t), allocatable, intent(out) :: words(:)  !! each of its own length
        type(error_t), allocatable, intent(out) :: error    !! a word is too long
        integer :: i, length

        allocate (words(command_argument_count()))
        do i = 1, size(words)
            call get_command_argument(i, length=length)
            if (length > longest_word) then
                call fail(error, "argument "//to_text(i)//" is longer than "// &
                          to_text(longest_word)//" characters")
                return
            end if
            allocate (character(length) :: words(i)%text)
            if (length > 0) call get_command_argument(i, words(i)%text)
        end do
    end subroutine command_words

    pure subroutine parse_words(words, options, line, error)
        !! Sort words into command, arguments and options; `--` ends the options. An option that
        !! does not exist is only remembered: the command knows those that may have been meant.
        type(word_t), intent(in) :: words(:)       !! as they were typed
        type(option_t), intent(in) :: options(:)   !! every option there is
        type(command_line_t), intent(out) :: line  !! the same, sorted
        type(error_t), allocatable, intent(out) :: error
        !! an option lacks its value, or has one too many
        logical :: literal, named
        integer :: i

        named = .false.
        line%command = ""
        line%unknown_option = ""
        allocate (line%arguments(0), line%names(0), line%values(0))
        literal = .false.
        i = 0
        do while (i < size(words))
            i = i + 1
            associate (text => words(i)%text)
                if (.not. literal .and. index(plainly(text), "-") == 1 .and. &
                    index(text, "-") /= 1) then
                    call fail(error, unlike(text)//", as options have; write "// &
                              quoted("--"//without_hyphens(plainly(text))))
                    return
                else if (literal .or. index(text, "-") /= 1 .or. text == "-") then
                    if (.not. (named .or. literal)) then
                        named = .true.
                        line%command = text
                        if (text == "") call fail(error, "unknown command "//quoted(text)// &
                                                  "; 'lagrangia --help' shows them")
                        if (allocated(error)) return
                    else
                        call append_word(line%arguments, text)
                    end if
                else if (text == "--") then
                    literal = .true.
                else
                    call take_option(words, options, i, line, error)
                    if (allocated(error)) return
                end if
            end associate
        end do
    end subroutine parse_words

    pure function without_hyphens(text) result(name)
        !! What comes behind those at the start.
        character(*), intent(in) :: text  !! `--name`
        character(:), allocatable :: name

        name = text(verify(text//".", "-"):)
    end function without_hyphens

    pure subroutine take_option(words, options, i, line, error)
        !! Word `i` is an option: find it and its value.
        type(word_t), intent(in) :: words(:)
        type(option_t), intent(in) :: options(:)
        integer, intent(inout) :: i
        type(command_line_t), intent(inout) :: line
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: name, value
        integer :: equals, k

        name = words(i)%text
        if (name == "-h") name = "--help"
        equals = index(name, "=")
        if (equals > 0) name = name(:equals - 1)
        do k = 1, size(options)
            if (name == "--"//trim(options(k)%name)) exit
        end do
        if (k > size(options)) then
            if (line%unknown_option == "") line%unknown_option = name
            return
        end if
        value = ""
        if (equals > 0) then
            if (options(k)%takes == no_value) then
                call fail(error, "option '"//name//"' takes no value")
                return
            end if
            value = words(i)%text(equals + 1:)
        else if (options(k)%takes == needs_value) then
            i = i + 1
            if (.not. has_word(i)) then
                call fail(error, "option '"//name//"' needs a value: "//name//" "// &
                          trim(options(k)%value))
                return
            end if
            value = words(i)%text
        else if (options(k)%takes == may_have_value .and. i < size(words)) then
            if (index("|"//trim(options(k)%value)//"|", "|"//words(i + 1)%text//"|") > 0) then
                call fail(error, "the value of option '"//name//"' stands behind '=': "//name// &
                          "="//words(i + 1)%text)
                return
            end if
        end if
        call check_value(options(k), name, value, line, error)
        if (allocated(error)) return
        call append_word(line%names, trim(options(k)%name))
        call append_word(line%values, value)
    contains
        pure function has_word(position) result(yes)
            !! Is there a word that can be a value, and is no option by itself?
            integer, intent(in) :: position
            logical :: yes
            integer :: j

            yes = position <= size(words)
            if (.not. yes) return
            do j = 1, size(options)
                yes = yes .and. words(position)%text /= "--"//trim(options(j)%name)
            end do
        end function has_word
    end subroutine take_option

    pure subroutine check_value(option, name, value, line, error)
        !! Refuse a second value that is another one, and blanks that would go unseen.
        type(option_t), intent(in) :: option
        character(*), intent(in) :: name, value   !! as they were typed
        type(command_line_t), intent(in) :: line  !! what was typed before
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: before

        before = line%value_of(trim(option%name), value)
        if (.not. (option%repeatable .or. is_same(before, value))) then
            call fail(error, "option '"//name//"' is given twice, as "//quoted(before)//" and "// &
                      quoted(value)//"; give one of them")
        else if (has_outer_blanks(value) .and. .not. option%any_text) then
            call fail(error, "the value "//quoted(value)//" of option '"//name//"' begins or "// &
                      "ends with a blank; write "//quoted(trim(adjustl(value))))
        end if
    end subroutine check_value

    pure function is_same(text1, text2) result(same)
        !! Byte for byte: blanks at the end count, as they do not for `==`.
        character(*), intent(in) :: text1, text2  !! any bytes
        logical :: same

        same = text1 == text2 .and. len(text1) == len(text2)
    end function is_same

    pure function has_outer_blanks(text) result(yes)
        !! Does it begin or end with a blank?
        character(*), intent(in) :: text  !! any bytes
        logical :: yes

        yes = len_trim(adjustl(text)) < len(text)
    end function has_outer_blanks

    pure function has(self, name) result(found)
        !! Whether option `--name` was given.
        class(command_line_t), intent(in) :: self
        character(*), intent(in) :: name  !! without hyphens
        logical :: found
        integer :: i

        found = .false.
        do i = 1, size(self%names)
            found = found .or. self%names(i)%text == name
        end do
    end function has

    pure function values_of(self, name) result(words)
        !! All values of a repeatable option.
        class(command_line_t), intent(in) :: self
        character(*), intent(in) :: name  !! without hyphens
        type(word_t), allocatable :: words(:)
        integer :: i

        allocate (words(0))
        do i = 1, size(self%names)
            if (self%names(i)%text == name) call append_word(words, self%values(i)%text)
        end do
    end function values_of

    pure function value_of(self, name, default) result(value)
        !! The value of option `--name` (the last one given), or `default`.
        class(command_line_t), intent(in) :: self
        character(*), intent(in) :: name, default  !! without hyphens, and what stands for no value
        character(:), allocatable :: value
        integer :: i

        value = default
        do i = 1, size(self%names)
            if (self%names(i)%text == name) value = self%values(i)%text
        end do
    end function value_of
end module lagrangia_command_line
