module test_help
    !! What `--help`, the manual and the shells are told, from one table.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: system_names
    use lagrangia_command_line, only: command_line_t, no_value, parse_words
    use lagrangia_command_pages, only: pages
    use lagrangia_completion, only: completion_script
    use lagrangia_errors, only: error_t
    use lagrangia_help, only: help_command, help_text, value_words
    use lagrangia_manual, only: manual_text
    use lagrangia_registry, only: check_line, commands, options
    use lagrangia_text, only: word_t
    use lagrangia_vocabulary, only: kind_of_value, words_of
    use lagrangia_wrapping, only: wrapped
    implicit none (type, external)
    private
    public :: help_suite

    character(*), parameter :: lf = new_line("a")

contains

    function help_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("help")
        call suite%addTest(TestMethod("lines_fit", lines_fit))
        call suite%addTest(TestMethod("every_command_has_examples", every_command_has_examples))
        call suite%addTest(TestMethod("examples_are_taken", examples_are_taken))
        call suite%addTest(TestMethod("a_wrong_word_is_answered", a_wrong_word_is_answered))
        call suite%addTest(TestMethod("values_are_those_that_exist", values_are_those_that_exist))
        call suite%addTest(TestMethod("the_same_words_everywhere", the_same_words_everywhere))
    end function help_suite

    subroutine lines_fit()
        !! In 80 columns, none empty at its end.
        character(:), allocatable :: line, rest
        integer :: i

        do i = 1, size(commands)
            rest = help_text(i, 80)
            do while (len(rest) > 0)
                line = rest(:index(rest, lf) - 1)
                call assertTrue(len(line) <= 80, line)
                call assertEqual(len_trim(line), len(line), line)
                rest = rest(index(rest, lf) + 1:)
            end do
        end do
    end subroutine lines_fit

    subroutine every_command_has_examples()
        !! And every page is that of a command.
        integer :: i

        do i = 2, size(commands)
            call assertEqual(1, count(pages%name == commands(i)%name), "src/commands/"// &
                             "command_pages.f90: one page of "//commands(i)%name)
        end do
        do i = 1, size(pages)
            call assertTrue(any(commands%name == pages(i)%name), pages(i)%name)
            call assertTrue(pages(i)%examples(1) /= "", pages(i)%name)
            call assertTrue(index(help_text(findloc(commands%name, pages(i)%name, 1), 80), &
                                  "examples:"//lf//"  "//trim(pages(i)%examples(1))//lf) > 0, &
                            pages(i)%name)
        end do
    end subroutine every_command_has_examples

    subroutine examples_are_taken()
        !! By the program: command, options and how many arguments there are. What stands between
        !! apostrophes is one word.
        type(word_t), allocatable :: words(:)
        type(command_line_t) :: line
        type(error_t), allocatable :: error
        character(:), allocatable :: text
        integer :: first, i, k, last, which

        do i = 1, size(pages)
            do k = 1, size(pages(i)%examples)
                text = trim(pages(i)%examples(k))
                if (text == "") cycle
                do first = index(text, "'") + 1, index(text, "'", back=.true.)
                    if (text(first:first) == " ") text(first:first) = "_"
                end do
                first = index(text, "lagrangia ")
                last = scan(text(first:)//" >", ">&)") + first - 2
                call wrapped(text(first + len("lagrangia "):min(last, len(text))), 1, words)
                call parse_words(words, options, line, error)
                call assertFalse(allocated(error), text)
                if (allocated(error)) return
                call check_line(line, which, error)
                call assertFalse(allocated(error), text)
                if (allocated(error)) return
                call assertEqual(pages(i)%name, merge(commands(which)%name, pages(i)%name, &
                                                      pages(i)%name /= "show" .and. &
                                                      pages(i)%name /= "grade" .and. &
                                                      pages(i)%name /= "help"), text)
            end do
        end do
    end subroutine examples_are_taken

    subroutine a_wrong_word_is_answered()
        !! With the nearest command.
        call answered("runn", "no help on 'runn'; did you mean 'run'?")
        call answered("scene", "no help on 'scene'; 'lagrangia describe scene' tells of it")
        call answered("xyzzy", "no help on 'xyzzy'; there are run, ")
        call answered("", "no help on ''; there are run, ")
    end subroutine a_wrong_word_is_answered

    subroutine answered(word, message)
        !! Assert how a word behind `help` is refused.
        character(*), intent(in) :: word, message
        type(command_line_t) :: line
        type(error_t), allocatable :: error

        allocate (line%arguments(1))
        line%arguments(1)%text = word
        call help_command(line, error)
        call assertTrue(allocated(error), word)
        if (allocated(error)) call assertEqual(1, index(error%message, message), error%message)
    end subroutine answered

    subroutine values_are_those_that_exist()
        !! A kind that a command takes has words, or is a file.
        type(word_t), allocatable :: kinds(:), words(:)
        integer :: i, k

        do i = 1, size(commands)
            call wrapped(commands(i)%takes, 1, kinds)
            do k = 1, size(kinds)
                call assertTrue(value_words(kinds(k)%text, " ") /= "", kinds(k)%text)
            end do
            call assertTrue(size(kinds) > 0 .neqv. commands(i)%most == 0, commands(i)%name)
        end do
        call words_of("systems", words)
        call assertEqual(size(system_names()), size(words))
        call words_of("svg|png", words)
        call assertEqual(2, size(words))
        if (size(words) == 2) call assertEqual("png", words(2)%text)
        call words_of("folder", words)
        call assertEqual(0, size(words))
        call assertTrue(index(value_words("settings", " "), " pendulum%l= ") > 0, "pendulum%l")
        call assertTrue(index(value_words("settings", " "), "scene%dt= ") > 0, "scene%dt")
    end subroutine values_are_those_that_exist

    subroutine the_same_words_everywhere()
        !! Commands, options and their values are in the scripts of both shells and in the manual.
        character(:), allocatable :: manual, bash, zsh, name
        integer :: i

        manual = manual_text()
        bash = completion_script("bash")
        zsh = completion_script("zsh")
        do i = 2, size(commands)
            name = trim(commands(i)%name)
            call assertTrue(index(manual, lf//".SS "//name) > 0, name)
            call assertTrue(index(bash, "        "//name//") words='") > 0, name)
            call assertTrue(index(zsh, "        "//name//") list ='") > 0 .or. &
                            index(zsh, "        "//name//") list='") > 0, name)
        end do
        do i = 1, size(options)
            name = trim(options(i)%name)
            call assertTrue(index(bash, " --"//name) > 0 .or. index(bash, "'--"//name) > 0, name)
            call assertTrue(index(zsh, "--"//name) > 0, name)
            if (options(i)%takes == no_value) cycle
            call assertTrue(index(bash, "--"//name//") ") > 0, name)
            name = value_words(kind_of_value(options(i), ""), " ")
            if (name /= "") call assertTrue(index(bash, "words='"//name//"'") > 0, name)
        end do
        call assertEqual(0, index(bash//zsh//manual, char(27)), "no colours")
    end subroutine the_same_words_everywhere
end module test_help
