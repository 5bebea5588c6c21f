module lagrangia_completion
    !! `lagrangia completion bash|zsh`: a script by which the shell completes our words, made of
    !! the tables that `--help` prints.
    use lagrangia_command_line, only: command_line_t, may_have_value, needs_value
    use lagrangia_console, only: put
    use lagrangia_errors, only: error_t, fail
    use lagrangia_help, only: value_words
    use lagrangia_registry, only: accepts, commands, options
    use lagrangia_text, only: quoted, word_t
    use lagrangia_vocabulary, only: kind_of_value
    use lagrangia_wrapping, only: wrapped
    implicit none (type, external)
    private
    public :: completion_command, completion_script

    character(*), parameter :: lf = new_line("a")

contains

    subroutine completion_command(line, error)
        !! Print the script of one shell.
        type(command_line_t), intent(in) :: line          !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! no such shell
        character(:), allocatable :: shell

        shell = ""
        if (size(line%arguments) > 0) shell = line%arguments(1)%text
        if (shell /= "bash" .and. shell /= "zsh") then
            call fail(error, "completion for which shell? Not "//quoted(shell)//"; there are "// &
                      "bash, zsh")
            return
        end if
        call put(completion_script(shell))
    end subroutine completion_command

    function completion_script(shell) result(text)
        !! Both find the command among the words before the cursor; the word before the cursor may
        !! be an option that wants a value. `$words`, in zsh `$list`, are then those that may stand
        !! here.
        character(*), intent(in) :: shell  !! bash or zsh
        character(:), allocatable :: text
        character(5) :: list  !! zsh has its own $words
        integer :: i, k

        text = ""
        list = "list "
        if (shell == "bash") list = "words"
        if (shell == "bash") then
            call add("# bash completion for lagrangia: source <(lagrangia completion bash)")
            call add("_lagrangia() {")
            call add("    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]}")
            call add("    local command= words= files= equals= i")
            call add("    if [[ $cur == = ]]; then")
            call add("        cur= equals=yes")
            call add("    elif [[ $prev == = ]]; then")
            call add("        prev=${COMP_WORDS[COMP_CWORD - 2]} equals=yes")
            call add("    fi")
            call add("    for ((i = 1; i < COMP_CWORD; i++)); do")
            call add("        [[ ${COMP_WORDS[i]} == -* ]] && continue")
            call add("        command=${COMP_WORDS[i]}")
            call add("        break")
            call add("    done")
        else
            call add("#compdef lagrangia")
            call add("# zsh completion for lagrangia: "// &
                     "lagrangia completion zsh >~/.zfunc/_lagrangia")
            call add("_lagrangia() {")
            call add("    local cur=$words[CURRENT] prev=$words[CURRENT-1] command= files= i list=")
            call add("    for ((i = 2; i < CURRENT; i++)); do")
            call add("        [[ $words[i] == -* ]] && continue")
            call add("        command=$words[i]")
            call add("        break")
            call add("    done")
        end if
        call add("    case $command$prev in")
        do i = 1, size(commands)
            do k = 1, size(options)
                if (options(k)%takes == needs_value .and. accepts(commands(i), options(k)%name) &
                    .and. kind_of_value(options(k), trim(commands(i)%name)) /= &
                    kind_of_value(options(k), "")) call add_option(trim(commands(i)%name), k)
            end do
        end do
        do i = 1, size(options)
            if (options(i)%takes == needs_value) call add_option("", i)
        end do
        do i = 1, size(options)
            if (options(i)%takes /= may_have_value .or. shell /= "bash") cycle
            call add("        *--"//trim(options(i)%name)//") [[ -z $equals ]] || { words='"// &
                     value_words(kind_of_value(options(i), ""), " ")//"' command=-; } ;;")
        end do
        call add("    esac")
        call add("    case $command in")
        do i = 1, size(commands)
            if (commands(i)%name == "") then
                call add("        '') "//trim(list)//"='"//names_of_commands()// &
                         option_words(i, shell)//"' ;;")
            else
                call add("        "//trim(commands(i)%name)//") "//trim(list)//"='"// &
                         argument_words(i)//option_words(i, shell)//"'"//file_kind(i)//" ;;")
            end if
        end do
        call add("    esac")
        if (shell == "bash") then
            call add("    COMPREPLY=($(compgen -W ""$words"" -- ""$cur""))")
            call add("    case $files in")
            call add("        folders) COMPREPLY+=($(compgen -d -- ""$cur"")) ;;")
            call add("        scenes) COMPREPLY+=($(compgen -f -X '!*.nml' -- ""$cur"") "// &
                     "$(compgen -d -S / -- ""$cur"")) ;;")
            call add("        all) COMPREPLY+=($(compgen -f -- ""$cur"")) ;;")
            call add("    esac")
            call add("    if [[ ${#COMPREPLY[@]} -eq 1 && ( ${COMPREPLY[0]} == *= || "// &
                     "${COMPREPLY[0]} == */ ) ]]; then compopt -o nospace 2>/dev/null; fi")
            call add("    return 0")
            call add("}")
            call add("complete -F _lagrangia lagrangia")
        else
            call add("    compadd -S ' ' -- ${${=list}:#*=}")
            call add("    compadd -S '' -- ${(M)${=list}:#*=}")
            call add("    case $files in")
            call add("        folders) _files -/ ;;")
            call add("        scenes) _files -g '*.nml' ;;")
            call add("        all) _files ;;")
            call add("    esac")
            call add("}")
            call add("if [[ $funcstack[1] == _lagrangia ]]; then _lagrangia ""$@""; "// &
                     "else compdef _lagrangia lagrangia; fi")
        end if
    contains
        subroutine add(line)
            character(*), intent(in) :: line

            text = text//line//lf
        end subroutine add

        subroutine add_option(command, which)
            !! What its value may be, with this command or, without a name, with any.
            character(*), intent(in) :: command
            integer, intent(in) :: which
            character(:), allocatable :: kind, pattern

            kind = kind_of_value(options(which), command)
            pattern = command
            if (command == "") pattern = "*"
            call add("        "//pattern//"--"//trim(options(which)%name)//") "//trim(list)// &
                     "='"//value_words(kind, " ")//"' files="// &
                     trim(merge("folders", "       ", kind == "folder"))//" command=- ;;")
        end subroutine add_option

        function names_of_commands() result(list)
            character(:), allocatable :: list

            list = ""
            do k = 2, size(commands)
                list = list//trim(commands(k)%name)//" "
            end do
        end function names_of_commands
    end function completion_script

    function argument_words(i) result(list)
        !! What may stand in the place of a command's arguments, a blank behind each.
        integer, intent(in) :: i
        character(:), allocatable :: list
        type(word_t), allocatable :: kinds(:)
        integer :: k

        list = ""
        call wrapped(commands(i)%takes, 1, kinds)
        do k = 1, size(kinds)
            associate (kind => kinds(k)%text)
                if (kind == "scene_files" .or. kind == "files") cycle
                list = list//value_words(kind, " ")//" "
            end associate
        end do
    end function argument_words

    function option_words(i, shell) result(list)
        !! The options that go with a command; in zsh, where `--plot=svg` is one word, with the
        !! values of those that may have one.
        integer, intent(in) :: i
        character(*), intent(in) :: shell
        character(:), allocatable :: list
        integer :: k

        list = ""
        do k = 1, size(options)
            if (.not. (accepts(commands(i), options(k)%name) .or. options(k)%name == "help" .or. &
                       options(k)%name == "version")) cycle
            list = list//"--"//trim(options(k)%name)//" "
            if (options(k)%takes == may_have_value .and. shell == "zsh") list = list//"--"// &
                trim(options(k)%name)//"="//value_words(kind_of_value(options(k), ""), &
                                                        " --"//trim(options(k)%name)//"=")//" "
        end do
        list = trim(list)
    end function option_words

    pure function file_kind(i) result(text)
        !! Which files may stand there.
        integer, intent(in) :: i
        character(:), allocatable :: text

        text = ""
        if (index(commands(i)%takes, "scenes") > 0) text = " files=scenes"
        if (index(" "//commands(i)%takes, " files") > 0) text = " files=all"
    end function file_kind
end module lagrangia_completion
