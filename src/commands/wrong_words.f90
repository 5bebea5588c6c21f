module lagrangia_wrong_words
    !! Arguments that a command does not take, although they mean something: the name of what
    !! another command takes, two words of one name, `all`, `scenes`; and one argument too many.
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_files, only: facts_t, look_at
    use lagrangia_names, only: nearest_name
    use lagrangia_number_reader, only: starts_number
    use lagrangia_option_words, only: option_advice
    use lagrangia_registry, only: accepts, command_t, commands
    use lagrangia_scene_keys, only: keys
    use lagrangia_setting_words, only: setting_advice
    use lagrangia_shipped, only: named_scenes, named_sweeps, scene_name
    use lagrangia_text, only: lower, quoted
    use lagrangia_vocabulary, only: words_of
    implicit none (type, external)
    private
    public :: check_arguments

    type :: list_t
        character(12) :: name = ""     !! of what there are several of, without the `s` of a plural
        character(32) :: command = ""  !! that shows all of them
    end type list_t

    type(list_t), parameter :: lists(*) = [ &
        list_t("system", "list systems"), list_t("scene", "list scenes"), &
        list_t("method", "list methods"), list_t("integrator", "list methods"), &
        list_t("sweep", "list sweeps"), list_t("principle", "principle"), &
        list_t("slip", "errata"), list_t("erratum", "errata"), list_t("errata", "errata"), &
        list_t("mistake", "errata"), list_t("sheet", "show"), list_t("homework", "show"), &
        list_t("file", "show"), list_t("command", "help"), list_t("option", "help"), &
        list_t("key", "describe scene"), list_t("column", "describe SYSTEM"), &
        list_t("parameter", "describe SYSTEM"), list_t("coordinate", "describe SYSTEM")]

contains

    subroutine check_arguments(command, arguments, settings, error)
        !! Refuse what the command can do nothing with, and say what to type. What is not known
        !! here passes: the command itself has the last word.
        type(command_t), intent(in) :: command            !! of `commands`
        type(word_t), intent(in) :: arguments(:)          !! of it, as typed
        type(word_t), intent(in) :: settings(:)           !! what is behind each `--set`
        type(error_t), allocatable, intent(out) :: error  !! allocated where one is refused
        type(word_t), allocatable :: taken(:)
        integer :: i

        call words_taken(command, taken)
        if (size(arguments) > 1) call check_blanks(arguments, taken, command%most == 1, error)
        if (allocated(error)) return
        do i = 1, size(arguments)
            if (is_one_of(arguments(i)%text, taken)) cycle
            if (is_one_of(lower(arguments(i)%text), taken)) cycle  ! the command says it
            call explain(command, arguments(i)%text, arguments, taken, error)
            if (allocated(error)) return
        end do
        if (command%most >= 0 .and. size(arguments) > command%most) then
            call refuse_more(command, arguments, taken, error)
        else if (size(arguments) > 0) then
            call check_settings(command, arguments, settings, error)
        end if
    end subroutine check_arguments

    subroutine check_settings(command, arguments, settings, error)
        !! Refuse `--set theta=1`, which names no group.
        type(command_t), intent(in) :: command
        type(word_t), intent(in) :: arguments(:), settings(:)
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: advice
        integer :: i

        do i = 1, size(settings)
            associate (word => settings(i)%text)
                if (scan(word, "%.:=") == 0 .or. scan(word, "%.:=") < index(word, "=")) cycle
                advice = setting_advice(command, word, arguments)
                if (index(advice, "no setting of") == 1) cycle  ! the groups are said instead
                if (advice /= "") call fail(error, "--set "//word//": this is "//advice)
            end associate
            if (allocated(error)) return
        end do
    end subroutine check_settings

    subroutine words_taken(command, words)
        !! All words that its arguments may be, also the scenes of the working folder; those of
        !! files aside.
        type(command_t), intent(in) :: command
        type(word_t), allocatable, intent(out) :: words(:)
        type(word_t), allocatable :: more(:)
        character(:), allocatable :: rest
        integer :: blank, i

        allocate (words(0))
        rest = trim(command%takes)//" "
        do while (len(rest) > 1)
            blank = index(rest, " ")
            select case (rest(:blank - 1))
            case ("scenes"); call named_scenes(more)
            case ("sweeps"); call named_sweeps(more)
            case default; call words_of(rest(:blank - 1), more)
            end select
            do i = 1, size(more)
                if (scan(more(i)%text, "/") > 0) more(i)%text = scene_name(more(i)%text)
            end do
            call add(words, more)
            rest = rest(blank + 1:)
        end do
    end subroutine words_taken

    subroutine add(words, more)
        !! `more` behind `words`.
        type(word_t), allocatable, intent(inout) :: words(:)
        type(word_t), intent(in) :: more(:)
        type(word_t), allocatable :: all_words(:)
        integer :: i

        allocate (all_words(size(words) + size(more)))
        do i = 1, size(all_words)
            if (i <= size(words)) all_words(i)%text = words(i)%text
            if (i > size(words)) all_words(i)%text = more(i - size(words))%text
        end do
        call move_alloc(all_words, words)
    end subroutine add

    pure function is_one_of(word, words) result(yes)
        !! Letter for letter.
        character(*), intent(in) :: word
        type(word_t), intent(in) :: words(:)
        logical :: yes
        integer :: i

        yes = .false.
        do i = 1, size(words)
            yes = yes .or. (words(i)%text == word .and. len(words(i)%text) == len(word))
        end do
    end function is_one_of

    subroutine check_blanks(arguments, taken, alone, error)
        !! Two words or three that together are a name: `double pendulum`, `virtual work`. Where
        !! the command takes one argument `alone`, they may also be near one.
        type(word_t), intent(in) :: arguments(:), taken(:)
        logical, intent(in) :: alone
        type(error_t), allocatable, intent(out) :: error
        character(1), parameter :: between(*) = ["_", "-"]
        character(:), allocatable :: name
        integer :: first, i, k, last

        do first = 1, size(arguments) - 1
            do last = min(first + 2, size(arguments)), first + 1, -1
                do k = 1, size(between)
                    name = arguments(first)%text
                    do i = first + 1, last
                        name = name//between(k)//arguments(i)%text
                    end do
                    if (.not. is_one_of(name, taken)) then
                        if (.not. alone .or. is_one_of(arguments(first)%text, taken)) cycle
                        if (first > 1 .or. last < size(arguments)) cycle
                        name = near(name, taken)
                        if (name == "") cycle
                    else if (all([(is_one_of(arguments(i)%text, taken), i=first, last)])) then
                        cycle
                    end if
                    call fail(error, "a name has no blank in it; did you mean "//quoted(name)//"?")
                    return
                end do
            end do
        end do
    end subroutine check_blanks

    pure function near(name, words) result(best)
        !! The word that is like `name`, or nothing.
        character(*), intent(in) :: name
        type(word_t), intent(in) :: words(:)
        character(:), allocatable :: best
        character(64) :: candidates(size(words))
        integer :: i

        do i = 1, size(words)
            candidates(i) = words(i)%text
        end do
        best = nearest_name(name, candidates)
    end function near

    subroutine explain(command, word, arguments, taken, error)
        !! Refuse a word that means something elsewhere; paths, and files that there are, pass.
        type(command_t), intent(in) :: command
        character(*), intent(in) :: word
        type(word_t), intent(in) :: arguments(:), taken(:)
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: advice
        type(facts_t) :: facts
        integer :: i

        if (command%name == "grade") return
        if (scan(word, "./") > 0 .and. scan(word, "=") == 0 .and. .not. starts_number(word)) return
        if (command%name == "help" .and. lower(word) == "scene") return
        facts = look_at(word)
        if (facts%found .and. index(command%takes, "files") > 0) return
        if (lower(word) == "all") then
            call fail(error, "'all' is no name; "//all_of_them(command))
            return
        end if
        do i = 1, size(lists)
            if (all(lower(word) /= [character(13) :: lists(i)%name, &
                                    trim(lists(i)%name)//"s"])) cycle
            if (is_one_of(word//"s", taken)) then
                call fail(error, quoted(word)//" is no name; did you mean '"//word//"s'?")
            else
                call fail(error, "'lagrangia "//trim(command%name)//"' takes no "//quoted(word)// &
                          "; 'lagrangia "//trim(lists(i)%command)//"' shows them")
            end if
            return
        end do
        advice = option_advice(command, word)
        if (advice == "") advice = setting_advice(command, word, arguments)
        if (advice /= "") then
            call fail(error, quoted(word)//" is "//advice)
        else if (command%name /= "show") then
            call explain_name(command, word, error)
        end if
    end subroutine explain

    pure function all_of_them(command) result(text)
        !! What to type for all that the command takes.
        type(command_t), intent(in) :: command
        character(:), allocatable :: text

        select case (command%name)
        case ("run"); text = "'lagrangia' alone runs every scene"
        case ("check", "report", "errata", "course", "bench", "stress", "list", "help")
            text = "'lagrangia "//trim(command%name)//"' without a name takes all"
        case ("principle", "show")
            text = "'lagrangia "//trim(command%name)//"' shows the names"
        case ("compare", "sweep")
            text = "'lagrangia list "//merge("scenes", "sweeps", command%name == "compare")// &
                   "' shows the names"
        case default
            text = "'lagrangia list systems' shows the names"
        end select
    end function all_of_them

    subroutine explain_name(command, word, error)
        !! Refuse the name of something that another command takes.
        type(command_t), intent(in) :: command
        character(*), intent(in) :: word
        type(error_t), allocatable, intent(out) :: error
        type(word_t), allocatable :: words(:)
        character(:), allocatable :: meaning
        integer :: i
        character(10), parameter :: kinds(3, 6) = reshape([character(10) :: &
            "systems", "system", "describe", "scenes", "scene", "run", "sweeps", "sweep", "sweep", &
            "principles", "principle", "principle", "parts", "part", "bench", "rows", "row", &
            "stress"], [3, 6])
        character(len(word)) :: small

        meaning = ""
        small = lower(word)
        call words_of("contestants", words)
        if (any(keys == small)) meaning = "a key of a scene; 'lagrangia describe scene' tells of it"
        if (are_all_of(small, words)) meaning = method_advice(command, small)
        do i = size(kinds, 2), 1, -1
            call words_of(trim(kinds(1, i)), words)
            if (.not. is_one_of(small, words) .or. commands_name(i) == command%name) cycle
            meaning = "a "//trim(kinds(2, i))//"; 'lagrangia "//trim(kinds(3, i))//" "//small// &
                      "' goes with it"
            if (accepts(command, "systems") .and. i <= 2) meaning = "a "//trim(kinds(2, i))// &
                "; write '--systems "//small//"'"
        end do
        call words_of("problems", words)
        if (accepts(command, "problems") .and. is_one_of(word, words)) meaning = "a problem; "// &
            "write '--problems "//word//"'"
        call words_of("commands", words)
        if (is_one_of(small, words)) meaning = "a command; 'lagrangia help "//small// &
            "' tells of it"
        if (meaning == "") return
        if (small /= command%name) meaning = meaning//taken_instead(command)
        call fail(error, quoted(word)//" is "//meaning)
    contains
        pure function commands_name(k) result(name)
            !! That takes it.
            integer, intent(in) :: k
            character(len(command%name)) :: name

            name = kinds(3, k)
        end function commands_name
    end subroutine explain_name

    pure function are_all_of(text, words) result(yes)
        !! A word, or several with commas between them, each of which is one of `words`.
        character(*), intent(in) :: text
        type(word_t), intent(in) :: words(:)
        logical :: yes
        character(:), allocatable :: rest

        rest = trim(text)//","
        yes = rest /= ","
        do while (yes .and. rest /= "")
            yes = is_one_of(rest(:index(rest, ",") - 1), words)
            rest = rest(index(rest, ",") + 1:)
        end do
    end function are_all_of

    pure function method_advice(command, word) result(text)
        !! How the command takes a method.
        type(command_t), intent(in) :: command
        character(*), intent(in) :: word
        character(:), allocatable :: text

        text = "a method; 'lagrangia list methods' tells of it"
        if (index(word, ",") > 0) then
            text = "a list of methods; 'lagrangia compare SCENE --methods "//word//"' compares them"
            if (accepts(command, "methods")) text = "a list of methods; write '--methods "// &
                word//"'"
        else if (command%name == "compare") then
            text = "a method; another one is compared with it: '--methods "//word//","// &
                   trim(merge("gauss16", "rk4    ", word == "rk4"))//"'"
        else if (accepts(command, "methods")) then
            text = "a method; write '--methods "//word//"'"
        else if (command%name == "check") then
            text = "a method; 'lagrangia check methods' measures the orders of all"
        else if (any(command%name == ["run  ", "sweep"])) then
            text = "a method; write '--set scene%method="//word//"'"
        end if
    end function method_advice

    pure function taken_instead(command) result(text)
        !! Where its arguments are told.
        type(command_t), intent(in) :: command
        character(:), allocatable :: text

        text = ""
        if (command%name == "help" .or. command%name == "") return
        text = ", 'lagrangia help "//trim(command%name)//"' shows what '"// &
               trim(command%name)//"' takes"
    end function taken_instead

    subroutine refuse_more(command, arguments, taken, error)
        !! There are more arguments than it takes.
        type(command_t), intent(in) :: command
        type(word_t), intent(in) :: arguments(:), taken(:)
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: instead, name
        type(facts_t) :: facts

        name = "'"//trim("lagrangia "//command%name)//"'"
        associate (word => arguments(command%most + 1)%text)
            if (command%most == 0) then
                call fail(error, name//" takes no argument, and "//quoted(word)//" is one")
                return
            end if
            instead = ""
            if (command%name == "help") instead = "; 'lagrangia help "//arguments(1)%text// &
                "' tells of its options"
            facts = look_at(word)
            if (command%name == "compare" .and. (facts%found .or. is_one_of(word, taken))) then
                instead = "; several scenes in one picture: 'lagrangia run "// &
                          arguments(1)%text//" "//word//" --plot --overlay'"
            end if
            call fail(error, name//" takes one argument, "//trim(command%arguments)// &
                      ", and "//quoted(word)//" is a second one"//instead)
        end associate
    end subroutine refuse_more
end module lagrangia_wrong_words
