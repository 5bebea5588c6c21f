module test_wrong_words
    !! Arguments that a command does not take get told what they are, or where they go.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_command_line, only: command_line_t, parse_words, word_t
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_registry, only: check_line, commands, options
    use lagrangia_text, only: to_text
    use lagrangia_vocabulary, only: words_of
    use lagrangia_wrong_words, only: check_arguments
    implicit none (type, external)
    private
    public :: wrong_words_suite

contains

    function wrong_words_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("wrong_words")
        call suite%addTest(TestMethod("two_words_are_a_name", two_words_are_a_name))
        call suite%addTest(TestMethod("lists_are_shown_elsewhere", lists_are_shown_elsewhere))
        call suite%addTest(TestMethod("names_go_elsewhere", names_go_elsewhere))
        call suite%addTest(TestMethod("one_argument_is_enough", one_argument_is_enough))
        call suite%addTest(TestMethod("good_words_pass", good_words_pass))
    end function wrong_words_suite

    subroutine check(text, error)
        !! What is said of the words of `text`.
        character(*), intent(in) :: text
        type(error_t), allocatable, intent(out) :: error
        type(command_line_t) :: line
        type(word_t), allocatable :: words(:)
        integer :: first, i, which

        allocate (words(count([(text(i:i) == " ", i=1, len(text))]) + 1))
        first = 1
        do i = 1, size(words)
            words(i)%text = text(first:first + index(text(first:)//" ", " ") - 2)
            first = first + len(words(i)%text) + 1
        end do
        call parse_words(words, options, line, error)
        if (.not. allocated(error)) call check_line(line, which, error)
        if (.not. allocated(error)) call check_arguments(commands(which), line%arguments, error)
    end subroutine check

    subroutine refused(text, message)
        !! Assert that the words of `text` are refused so.
        character(*), intent(in) :: text, message
        type(error_t), allocatable :: error

        call check(text, error)
        call assertTrue(allocated(error), "refused: "//text)
        if (.not. allocated(error)) return
        call assertEqual(message, error%message)
        call assertEqual(status_usage, error%status)
    end subroutine refused

    subroutine taken(text)
        !! Assert that the words of `text` pass.
        character(*), intent(in) :: text
        type(error_t), allocatable :: error

        call check(text, error)
        call assertFalse(allocated(error), "taken: "//text)
    end subroutine taken

    subroutine two_words_are_a_name()
        !! With a blank where the name has a hyphen or a low line.
        character(*), parameter :: meant = "a name has no blank in it; did you mean '"

        call refused("principle virtual work", meant//"virtual-work'?")
        call refused("principle least action", meant//"action'?")
        call refused("describe double pendulum", meant//"double_pendulum'?")
        call refused("run cart pendulum wide", meant//"cart_pendulum_wide'?")
        call refused("run oscillator double pendulum", meant//"double_pendulum'?")
        call refused("compare cart pendulum small", meant//"cart_pendulum_small'?")
        call refused("check double pendulum", meant//"double_pendulum'?")
        call refused("stress near separatrix", meant//"near_separatrix'?")
    end subroutine two_words_are_a_name

    subroutine lists_are_shown_elsewhere()
        !! And all of them.
        call refused("describe scenes", "'lagrangia describe' takes no 'scenes'; 'lagrangia "// &
                     "list scenes' shows them")
        call refused("derive Systems", "'lagrangia derive' takes no 'Systems'; 'lagrangia "// &
                     "list systems' shows them")
        call refused("list principles", "'lagrangia list' takes no 'principles'; 'lagrangia "// &
                     "principle' shows them")
        call refused("help methods", "'lagrangia help' takes no 'methods'; 'lagrangia "// &
                     "list methods' shows them")
        call refused("check method", "'method' is no name; did you mean 'methods'?")
        call refused("run all", "'all' is no name; 'lagrangia' alone runs every scene")
        call refused("check all", "'all' is no name; 'lagrangia check' without a name takes all")
        call refused("sweep all", "'all' is no name; 'lagrangia list sweeps' shows the names")
        call refused("modes all", "'all' is no name; 'lagrangia list systems' shows the names")
    end subroutine lists_are_shown_elsewhere

    subroutine names_go_elsewhere()
        !! What another command takes.
        call refused("describe rk4", "'rk4' is a method; 'lagrangia list methods' tells of it, "// &
                     "'lagrangia help describe' shows what 'describe' takes")
        call refused("run pendulum rk4", "'rk4' is a method; write '--set scene%method=rk4', "// &
                     "'lagrangia help run' shows what 'run' takes")
        call refused("describe resonance", "'resonance' is a sweep; 'lagrangia sweep "// &
                     "resonance' goes with it, 'lagrangia help describe' shows what "// &
                     "'describe' takes")
        call refused("stress pendulum", "'pendulum' is a system; 'lagrangia describe pendulum' "// &
                     "goes with it, 'lagrangia help stress' shows what "// &
                     "'stress' takes")
        call refused("describe dt", "'dt' is a key of a scene; 'lagrangia describe scene' "// &
                     "tells of it, 'lagrangia help describe' shows what 'describe' takes")
    end subroutine names_go_elsewhere

    subroutine one_argument_is_enough()
        !! Of those commands that take one.
        call refused("compare pendulum oscillator", "'lagrangia compare' takes one argument, "// &
                     "SCENE, and 'oscillator' is a second one; several scenes in one picture: "// &
                     "'lagrangia run pendulum oscillator --plot --overlay'")
        call refused("errata E1 E2", "'lagrangia errata' takes one argument, [ID], and 'E2' is "// &
                     "a second one")
        call refused("manual x", "'lagrangia manual' takes no argument, and 'x' is one")
    end subroutine one_argument_is_enough

    subroutine good_words_pass()
        !! Each word that a command takes, alone and two by two; what nothing here knows, and files.
        character(:), allocatable :: kinds
        type(word_t), allocatable :: words(:)
        integer :: i, k

        do i = 2, size(commands)
            kinds = trim(commands(i)%takes)//" "
            do while (len(kinds) > 1)
                call words_of(kinds(:index(kinds, " ") - 1), words)
                kinds = kinds(index(kinds, " ") + 1:)
                do k = 1, size(words)
                    call taken(trim(commands(i)%name)//" "//words(k)%text)
                    if (commands(i)%most < 0 .and. k > 1) call taken(trim(commands(i)%name)//" "// &
                        words(k - 1)%text//" "//words(k)%text)
                end do
            end do
        end do
        call taken("run nosuch")
        call taken("run ./all")
        call taken("grade data")
        call taken("help pendulum")
        call taken("show pendulum atwood.nml")
        call taken("errata "//to_text(7))
    end subroutine good_words_pass
end module test_wrong_words
