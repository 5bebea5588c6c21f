module lagrangia_help
    !! The help of all commands and of each, in 80 columns; `lagrangia help COMMAND`.
    use lagrangia_command_line, only: command_line_t, option_t
    use lagrangia_command_pages, only: pages
    use lagrangia_console, only: line_width, put
    use lagrangia_errors, only: error_t, fail
    use lagrangia_names, only: name_length, nearest_name
    use lagrangia_registry, only: accepts, commands, options, usage
    use lagrangia_text, only: join, quoted, word_t
    use lagrangia_vocabulary, only: kind_of_value, words_of
    use lagrangia_wrapping, only: wrapped
    implicit none (type, external)
    private
    public :: exit_status_text, help_command, help_text, value_words

    integer, parameter :: indentation = 27
    character(*), parameter :: exit_status_text = "0 all is well, 1 a check or tolerance did "// &
        "not hold, 2 usage or scene error, 3 the numbers failed, 4 LAPACK or GSL refused, 5 "// &
        "file error, 128 + n signal n (130 interrupted, 141 the reader of a pipe has gone, 143 "// &
        "terminated)"

contains

    subroutine help_command(line, error)
        !! The help of the command that is named; a wrong word is answered with the nearest.
        type(command_line_t), intent(in) :: line          !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! there is no such command
        character(:), allocatable :: near
        integer :: which

        which = 1
        if (size(line%arguments) > 0) then
            associate (word => line%arguments(1)%text)
                which = findloc(commands%name == word .and. commands%name /= "", .true., 1)
                if (which == 0) then
                    near = nearest_name(word, [character(name_length) :: commands(2:)%name])
                    if (near /= "") then
                        near = "did you mean '"//near//"'?"
                    else if (word == "scene") then
                        near = "'lagrangia describe "//word//"' tells of it"
                    else
                        near = "there are "//join(commands(2:)%name, ", ")
                    end if
                    call fail(error, "no help on "//quoted(word)//"; "//near)
                    return
                end if
            end associate
        end if
        call put(help_text(which, line_width()))
    end subroutine help_command

    function help_text(which, most) result(text)
        !! Help for one command (`which` > 1) or for all.
        integer, intent(in) :: which  !! of `commands`
        integer, intent(in) :: most   !! columns of a line; of more than 80 the rest stays empty
        character(:), allocatable :: text
        integer :: i, page, width

        width = max(60, min(80, most))
        text = ""
        page = findloc(pages%name == commands(which)%name, .true., 1)
        if (which > 1) then
            call add("usage: lagrangia "//trim(commands(which)%name)//" "// &
                     trim(commands(which)%arguments)//" [options]")
            call add("")
            call add_item("", trim(commands(which)%meaning), 2)
            call add("")
            call add_item("", trim(pages(page)%purpose), 2)
            call add_values(which)
        else
            call add_item("", "lagrangia: the systems of a classical-mechanics course, run and "// &
                          "checked", 0)
            call add("")
            call add("usage: lagrangia [command] [options]")
            call add("")
            do i = 1, size(commands)
                call add_item(trim("lagrangia "//trim(commands(i)%name)//" "// &
                                   commands(i)%arguments), trim(commands(i)%meaning), 38)
            end do
        end if
        call add("")
        call add("options:")
        do i = 1, size(options)
            if (which > 1 .and. options(i)%name /= "help" .and. options(i)%name /= "version") then
                if (.not. accepts(commands(which), options(i)%name)) cycle
            end if
            call add_item(usage(options(i)), &
                          meaning_with_values(options(i), trim(commands(which)%name)), indentation)
        end do
        if (which > 1) then
            call add("")
            call add("examples:")
            do i = 1, size(pages(page)%examples)
                if (pages(page)%examples(i) /= "") call add("  "//pages(page)%examples(i))
            end do
        else
            call add("")
            call add_item("", "exit status: "//exit_status_text, 0)
            call add("")
            call add_item("", "'lagrangia help COMMAND' says more; 'lagrangia describe scene' "// &
                          "shows every key of a scene", 0)
        end if
    contains
        subroutine add(line)
            character(*), intent(in) :: line

            text = text//trim(line)//new_line("a")
        end subroutine add

        subroutine add_item(name, meaning, column)
            !! A name and, from this column on, what it means.
            character(*), intent(in) :: name, meaning
            integer, intent(in) :: column
            type(word_t), allocatable :: lines(:)
            character(:), allocatable :: start
            integer :: k

            call wrapped(meaning, width - column, lines)
            start = ""
            if (name /= "") start = "  "//name
            if (len(start) > column - 2 .and. name /= "") then
                call add(start)
                start = ""
            end if
            do k = 1, size(lines)
                call add(start//repeat(" ", column - len(start))//lines(k)%text)
                start = ""
            end do
        end subroutine add_item

        subroutine add_values(which)
            !! What may stand in the place of the arguments.
            integer, intent(in) :: which
            type(word_t), allocatable :: kinds(:)
            integer :: k

            if (commands(which)%takes == "") return
            call add("")
            call add("arguments:")
            call wrapped(commands(which)%takes, 1, kinds)
            do k = 1, size(kinds)
                call add_item(kind_name(kinds(k)%text), value_words(kinds(k)%text, ", "), &
                              indentation)
            end do
        end subroutine add_values
    end function help_text

    function meaning_with_values(option, command) result(text)
        !! What an option does; in a command's own help its values too, where they are words.
        type(option_t), intent(in) :: option
        character(*), intent(in) :: command  !! empty: of all
        character(:), allocatable :: text, values

        text = trim(option%meaning)
        if (command == "") return
        select case (kind_of_value(option, command))
        case ("derivable", "contestants", "compared", "problems")
            values = value_words(kind_of_value(option, command), ", ")
            text = text//": "//values
        case ("settings")
            text = text//"; 'lagrangia describe scene' and 'lagrangia describe SYSTEM' show "// &
                   "the keys"
        case default
        end select
    end function meaning_with_values

    pure function kind_name(kind) result(name)
        !! How the help calls one of the words of this kind.
        character(*), intent(in) :: kind
        character(:), allocatable :: name

        select case (kind)
        case ("systems"); name = "a system"
        case ("scenes"); name = "a scene"
        case ("sweeps"); name = "a sweep"
        case ("scene_files"); name = "a scene of your own"
        case ("sheets"); name = "a sheet"
        case ("files"); name = "a sheet of your own"
        case ("carried"); name = "a file"
        case default; name = "a word"
        end select
    end function kind_name

    function value_words(kind, separator) result(text)
        !! All words of a kind; of a kind that has none, what it is.
        character(*), intent(in) :: kind       !! as `words_of` has it
        character(*), intent(in) :: separator  !! between two
        character(:), allocatable :: text
        type(word_t), allocatable :: words(:)
        integer :: i

        call words_of(kind, words)
        text = ""
        do i = 1, size(words)
            if (i > 1) text = text//separator
            text = text//words(i)%text
        end do
        if (kind == "scene_files") text = "the path of a .nml file"
        if (kind == "files") text = "the path of a file"
    end function value_words
end module lagrangia_help
