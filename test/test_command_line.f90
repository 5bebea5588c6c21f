module test_command_line
    !! From words to a command, its arguments and its options.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_command_line, only: command_line_t, may_have_value, needs_value, no_value, &
                                      option_t, parse_words, word_t
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_help, only: help_text
    use lagrangia_registry, only: check_line, commands, options
    use lagrangia_text, only: to_text
    use lagrangia_wrapping, only: wrapped
    implicit none (type, external)
    private
    public :: command_line_suite

    type(option_t), parameter :: some(*) = [ &
        option_t("set", needs_value, "KEY=VALUE", "", repeatable=.true., any_text=.true.), &
        option_t("to", needs_value, "DIR", ""), &
        option_t("plot", may_have_value, "svg|png", ""), option_t("help", no_value, "", "")]

contains

    function command_line_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("command_line")
        call suite%addTest(TestMethod("words_are_sorted", words_are_sorted))
        call suite%addTest(TestMethod("nothing_is_the_main_job", nothing_is_the_main_job))
        call suite%addTest(TestMethod("values_follow_or_are_joined", values_follow_or_are_joined))
        call suite%addTest(TestMethod("two_hyphens_end_the_options", two_hyphens_end_the_options))
        call suite%addTest(TestMethod("wrong_options_are_refused", wrong_options_are_refused))
        call suite%addTest(TestMethod("values_are_given_once", values_are_given_once))
        call suite%addTest(TestMethod("blanks_are_not_overlooked", blanks_are_not_overlooked))
        call suite%addTest(TestMethod("wrong_commands_are_refused", wrong_commands_are_refused))
        call suite%addTest(TestMethod("options_go_with_their_commands", &
                                      options_go_with_their_commands))
        call suite%addTest(TestMethod("help_tells_all", help_tells_all))
    end function command_line_suite

    pure function split(text) result(words)
        !! The words between the bars of `text`.
        character(*), intent(in) :: text
        type(word_t), allocatable :: words(:)
        integer :: i, k, first

        k = 1
        do i = 1, len(text)
            if (text(i:i) == "|") k = k + 1
        end do
        allocate (words(k))
        first = 1
        do k = 1, size(words)
            i = index(text(first:)//"|", "|") + first - 2
            words(k)%text = text(first:i)
            first = i + 2
        end do
    end function split

    subroutine words_are_sorted()
        !! The first word that is no option is the command, wherever it stands.
        type(command_line_t) :: line
        type(error_t), allocatable :: error

        call parse_words(split("--help|run|a b|--set|dt=1|c|-"), some, line, error)
        call assertFalse(allocated(error), "good words")
        call assertEqual("run", line%command)
        call assertEqual(3, size(line%arguments))
        call assertEqual("a b", line%arguments(1)%text)
        call assertEqual("c", line%arguments(2)%text)
        call assertEqual("-", line%arguments(3)%text)
        call assertTrue(line%has("help") .and. line%has("set"), "options that were given")
        call assertFalse(line%has("plot"), "one that was not")
    end subroutine words_are_sorted

    subroutine nothing_is_the_main_job()
        !! No words, no command, nothing refused.
        type(command_line_t) :: line
        type(error_t), allocatable :: error
        integer :: which

        call parse_words([word_t ::], options, line, error)
        call assertEqual("", line%command)
        call check_line(line, which, error)
        call assertFalse(allocated(error), "the main job")
        call assertEqual("", commands(which)%name)
    end subroutine nothing_is_the_main_job

    subroutine values_follow_or_are_joined()
        !! `--set A`, `--set=A`; the last one counts; a value may contain more equal signs, or be
        !! empty; an optional one must be joined, and so must one that is an option by itself.
        type(command_line_t) :: line
        type(error_t), allocatable :: error

        call parse_words(split("--set|a=1|--set=b=2=3|--plot|run|--set=--help"), some, line, error)
        call assertFalse(allocated(error), "good words")
        call assertEqual(4, size(line%names))
        call assertEqual("a=1", line%values(1)%text)
        call assertEqual("b=2=3", line%values(2)%text)
        call assertEqual("--help", line%value_of("set", "none"))
        call assertFalse(line%has("help"), "that was a value")
        call assertEqual("run", line%command, "plot takes no word")
        call assertEqual(0, len(line%value_of("plot", "png")), "an optional value, absent")
        call assertEqual("none", line%value_of("help", "none"))
        call parse_words(split("--plot=svg|--set="), some, line, error)
        call assertEqual("svg", line%value_of("plot", "png"))
        call assertEqual(0, len(line%value_of("set", "none")), "an empty value")
    end subroutine values_follow_or_are_joined

    subroutine two_hyphens_end_the_options()
        !! What follows are arguments, whatever they look like, a second `--` too.
        type(command_line_t) :: line
        type(error_t), allocatable :: error

        call parse_words(split("run|--|--help|--"), some, line, error)
        call assertEqual("run", line%command)
        call assertEqual(2, size(line%arguments))
        call assertEqual("--help", line%arguments(1)%text)
        call assertEqual("--", line%arguments(2)%text)
        call assertFalse(line%has("help"), "an argument")
    end subroutine two_hyphens_end_the_options

    subroutine wrong_options_are_refused()
        !! With the nearest name; as usage errors, and control characters escaped.
        call check_refused("run|--sett|x", "unknown option '--sett'; did you mean '--set'?")
        call check_refused("run|--plo=svg", "unknown option '--plo'; did you mean '--plot'?")
        call check_refused("modes|--methods=x", "option '--methods' does not go with "// &
                           "'lagrangia modes'; it takes --set GROUP%KEY=VALUE, --at Q1,Q2,..., ")
        call check_refused("run|--method", "unknown option '--method'; it is a key of the "// &
                           "scene: --set scene%method=...")
        call check_refused("report|--theta", "unknown option '--theta'; it takes --set ")
        call check_refused("bench|--method", "unknown option '--method'; did you mean '--methods'?")
        call check_refused("run|--dt|1e-3", "unknown option '--dt'; it is a key of the scene: "// &
                           "--set scene%dt=...")
        call check_refused("list|--dt|1e-3", "unknown option '--dt'; it takes none but --help")
        call check_refused("--ouput|x|run", "unknown option '--ouput'; did you mean '--output'?")
        call check_refused("list|-x", "unknown option '-x'; it takes none but --help")
        call check_refused("run|-o|x", "unknown option '-o'; an option is a whole word behind "// &
                           "two hyphens: --output, --overlay")
        call check_refused("-V", "unknown option '-V'; an option is a whole word behind two "// &
                           "hyphens: --version")
        call check_refused("--list", "unknown option '--list'; a command has no hyphens: "// &
                           "'lagrangia list'")
        call check_refused("run|---", "unknown option '---'; it takes --set ")
        call check_refused("run|--a"//achar(27), "unknown option '--a\x1B'")
        call refused("run|--set", "option '--set' needs a value: --set KEY=VALUE")
        call refused("run|--set|--plot", "option '--set' needs a value: --set KEY=VALUE")
        call refused("run|--plot|svg", &
                     "the value of option '--plot' stands behind '=': --plot=svg")
        call refused("run|--help=me", "option '--help' takes no value")
        call refused("run|"//char(226)//char(128)//char(147)//"help", &
                     "U+2013 is no plain '-', as options have; write '--help'")
    end subroutine wrong_options_are_refused

    subroutine refused(text, message)
        !! Assert that the words of `text` are refused in these words.
        character(*), intent(in) :: text, message
        type(command_line_t) :: line
        type(error_t), allocatable :: error

        call parse_words(split(text), some, line, error)
        call assertTrue(allocated(error), "refused: "//text)
        if (.not. allocated(error)) return
        call assertEqual(message, error%message)
        call assertEqual(status_usage, error%status)
    end subroutine refused

    subroutine values_are_given_once()
        !! The same value again is none; what may be repeated is.
        type(command_line_t) :: line
        type(word_t), allocatable :: words(:)
        type(error_t), allocatable :: error

        call refused("--to|a|--to=b", "option '--to' is given twice, as 'a' and 'b'; give one "// &
                     "of them")
        call refused("--plot|--plot=svg", "option '--plot' is given twice, as '' and 'svg'; "// &
                     "give one of them")
        call parse_words(split("--to|a|--to=a|--set|a|--set|b|--help|--help"), some, line, error)
        call assertFalse(allocated(error), "nothing contradicts")
        allocate (words(0))  ! gfortran 12 thinks it unset otherwise
        words = line%values_of("set")
        call assertEqual(2, size(words))
        call parse_words(split("--output|a|--output=a "), options, line, error)
        call assertTrue(allocated(error), "a blank is a difference")
    end subroutine values_are_given_once

    subroutine blanks_are_not_overlooked()
        !! For Fortran `'a ' == 'a'`, not for a file system. A folder may have any name.
        type(command_line_t) :: line
        type(error_t), allocatable :: error
        integer :: which

        call refused("--to|a ", "the value 'a ' of option '--to' begins or ends with a blank; "// &
                     "write 'a'")
        call refused("--to= a", "the value ' a' of option '--to' begins or ends with a blank; "// &
                     "write 'a'")
        call refused("|run", "unknown command ''; 'lagrangia --help' shows them")
        call check_refused("run ", "unknown command 'run '; did you mean 'run'?")
        call check_refused("describe|wedge ", "'wedge ' begins or ends with a blank; write 'wedge'")
        call check_refused("bench| steps", "' steps' begins or ends with a blank; write 'steps'")
        call parse_words(split("run|a |--output|b |--set| c "), options, line, error)
        call assertFalse(allocated(error), "names of files")
        call check_line(line, which, error)
        call assertFalse(allocated(error), "a name of a file")
        call assertEqual(2, len(line%value_of("output", "")), "a folder, byte for byte")
    end subroutine blanks_are_not_overlooked

    subroutine wrong_commands_are_refused()
        !! With the nearest, or all of them.
        call check_refused("rn", "unknown command 'rn'; did you mean 'run'?")
        call check_refused("wibble", "unknown command 'wibble'; a scene's name stands "// &
                           "behind a command, as in 'lagrangia run pendulum'; there are run, ")
        call check_refused("benchmark", "unknown command 'benchmark'; did you mean 'bench'?")
    end subroutine wrong_commands_are_refused

    subroutine check_refused(text, message)
        !! Assert that `check_line` refuses the words of `text`: in a message that begins so.
        character(*), intent(in) :: text, message
        type(command_line_t) :: line
        type(error_t), allocatable :: error
        integer :: which

        call parse_words(split(text), options, line, error)
        call assertFalse(allocated(error), "good words: "//text)
        call check_line(line, which, error)
        call assertTrue(allocated(error), "refused: "//text)
        if (.not. allocated(error)) return
        call assertEqual(1, index(error%message, message), error%message)
        call assertEqual(status_usage, error%status)
    end subroutine check_refused

    subroutine options_go_with_their_commands()
        !! What a command's help does not name it refuses; help and version go with all.
        type(command_line_t) :: line
        type(error_t), allocatable :: error
        character(:), allocatable :: accepts, message, word
        logical :: goes
        integer :: i, k, which

        do i = 1, size(commands)
            accepts = " "//trim(commands(i)%accepts)//" help version "
            do k = 1, size(options)
                word = "--"//trim(options(k)%name)
                if (options(k)%takes == needs_value) word = word//"=x"
                if (i == 1) call parse_words(split(word), options, line, error)
                if (i > 1) call parse_words(split(trim(commands(i)%name)//"|"//word), options, &
                                            line, error)
                call check_line(line, which, error)
                goes = index(accepts, " "//trim(options(k)%name)//" ") > 0
                call assertEqual(i, which, "command "//to_text(i))
                call assertTrue(goes .neqv. allocated(error), trim(commands(i)%name)//" "//word)
                if (.not. allocated(error)) cycle
                message = "option '--"//trim(options(k)%name)//"' does not go with '"// &
                          trim("lagrangia "//commands(i)%name)//"'; it takes "
                call assertEqual(1, index(error%message, message), error%message)
            end do
        end do
    end subroutine options_go_with_their_commands

    subroutine help_tells_all()
        !! Every command and option in the help of all; what goes with a command in its own.
        character(:), allocatable :: text
        integer :: i, k

        text = help_text(1, 80)
        do i = 1, size(commands)
            call assertTrue(index(text, trim("lagrangia "//commands(i)%name)) > 0, &
                            trim(commands(i)%name))
            call assertTrue(index(one_line(text), trim(commands(i)%meaning)) > 0, &
                            trim(commands(i)%meaning))
        end do
        do k = 1, size(options)
            call assertTrue(index(text, "  --"//trim(options(k)%name)) > 0, trim(options(k)%name))
        end do
        do i = 2, size(commands)
            text = help_text(i, 80)
            do k = 1, size(options)
                if (options(k)%name == "help" .or. options(k)%name == "version") cycle
                call assertTrue(index(text, "  --"//trim(options(k)%name)//" ") + &
                                index(text, "  --"//trim(options(k)%name)//"[") > 0 .eqv. &
                                index(" "//commands(i)%accepts, &
                                      " "//trim(options(k)%name)//" ") > 0, &
                                trim(commands(i)%name)//" --"//trim(options(k)%name))
            end do
        end do
    end subroutine help_tells_all

    function one_line(text) result(line)
        !! The words of a text, a blank between two.
        character(*), intent(in) :: text
        character(:), allocatable :: line
        character(len(text)) :: plain
        type(word_t), allocatable :: lines(:)
        integer :: i

        plain = text
        do i = 1, len(text)
            if (text(i:i) == new_line("a")) plain(i:i) = " "
        end do
        call wrapped(plain, len(text), lines)
        line = lines(1)%text
    end function one_line
end module test_command_line
