module test_processes
    !! Signals and other programs: seen in processes of their own.
    use, intrinsic :: iso_c_binding, only: c_funloc, c_funptr, c_int, c_intptr_t, c_null_funptr
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_c_library, only: c_ending, c_exit, c_signal
    use lagrangia_console, only: finish_console, put_line
    use lagrangia_errors, only: error_t, status_file, status_interrupted, status_terminated
    use lagrangia_interrupt, only: catch_interrupts, interrupt_status
    use lagrangia_kinds, only: i8
    use lagrangia_output_file, only: output_file_t
    use lagrangia_processes, only: await_program, bytes_read_by, start_program
    use lagrangia_program, only: give_up
    use lagrangia_text, only: word_t
    use test_scratch, only: c_dup2, c_raise, contents, exit_status, new_folder, remove_file, &
        send_stdout_to
    implicit none (type, external)
    private
    public :: processes_suite

    integer(c_int), parameter :: sigint = 2, sigalrm = 14, sigterm = 15
    integer(c_int), parameter :: endings(*) = [1_c_int, 2_c_int, 3_c_int, 15_c_int, 24_c_int]

    integer(c_int) :: chosen = 0  !! one of these, for a child process

contains

    function processes_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("processes")
        call suite%addTest(TestMethod("signals_are_remembered", signals_are_remembered))
        call suite%addTest(TestMethod("every_ending_has_its_status", every_ending_has_its_status))
        call suite%addTest(TestMethod("a_library_keeps_its_signal", a_library_keeps_its_signal))
        call suite%addTest(TestMethod("a_second_sigint_kills", a_second_sigint_kills))
        call suite%addTest(TestMethod("who_does_not_look_is_ended", who_does_not_look_is_ended))
        call suite%addTest(TestMethod("ignored_signals_stay_ignored", ignored_signals_stay_ignored))
        call suite%addTest(TestMethod("programs_return_their_status", programs_return_their_status))
        call suite%addTest(TestMethod("a_program_is_watched", a_program_is_watched))
        call suite%addTest(TestMethod("arguments_reach_no_shell", arguments_reach_no_shell))
        call suite%addTest(TestMethod("a_missing_program_is_an_error", &
                                      a_missing_program_is_an_error))
        call suite%addTest(TestMethod("what_was_put_comes_first", what_was_put_comes_first))
    end function processes_suite

    subroutine signals_are_remembered()
        !! And become the exit status; the first one counts.
        call assertEqual(0, interrupt_status())
        call assertEqual(status_interrupted, exit_status(catch_sigint))
        call assertEqual(status_terminated, exit_status(catch_sigterm))
    end subroutine signals_are_remembered

    function catch_sigint() result(status)
        !! What SIGINT, and then SIGTERM, lead to.
        integer :: status

        call prepare(sigint)
        status = int(c_raise(sigint))
        status = int(c_raise(sigterm))
        status = interrupt_status()
    end function catch_sigint

    function catch_sigterm() result(status)
        !! What SIGTERM leads to.
        integer :: status

        call prepare(sigterm)
        status = int(c_raise(sigterm))
        status = interrupt_status()
    end function catch_sigterm

    subroutine every_ending_has_its_status()
        !! SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU, and those of which the system has to say
        !! that there are any: seen by who looks; the second of a kind removes what is unfinished as
        !! the first would a second later.
        character(:), allocatable :: folder
        integer(c_int) :: i

        folder = new_folder("twice")
        call assertTrue(c_ending(5_c_int) > 0, message="SIGPROF, the fifth of all Unix systems")
        i = 0
        do
            i = i + 1
            if (i <= size(endings)) chosen = endings(i)
            if (i > size(endings)) chosen = c_ending(i - size(endings, kind=c_int))
            if (chosen == 0) exit
            call assertEqual(128 + int(chosen), exit_status(catch_chosen), message="seen")
            call assertEqual(128 + int(chosen), exit_status(raise_twice), message="the second")
            call assertEqual("lagrangia: interrupted"//new_line("a"), contents(folder//"/err"))
            call assertTrue(remove_file(folder//"/err"), "it was there: "//folder//"/err")
        end do
        call assertTrue(remove_file(folder), "a temporary was left")
    end subroutine every_ending_has_its_status

    subroutine a_library_keeps_its_signal()
        !! What somebody else answers is not asked of us.
        call assertEqual(7, exit_status(raise_anothers))
    end subroutine a_library_keeps_its_signal

    function raise_anothers() result(status)
        !! 7 if the handler that was there before, as that of MPI, ends this process.
        integer :: status
        type(c_funptr) :: old

        old = c_signal(c_ending(1_c_int), c_funloc(end_with_seven))
        call catch_interrupts()
        status = int(c_raise(c_ending(1_c_int)))
        status = interrupt_status()
    end function raise_anothers

    subroutine end_with_seven(number) bind(c)
        !! A handler.
        integer(c_int), value :: number

        number = 7
        call c_exit(number)
    end subroutine end_with_seven

    function catch_chosen() result(status)
        !! What the chosen signal leads to.
        integer :: status

        call prepare(chosen)
        status = int(c_raise(chosen))
        status = interrupt_status()
    end function catch_chosen

    function raise_twice() result(status)
        !! 0 if the second of the chosen signals does nothing.
        integer :: status
        type(output_file_t) :: file
        type(error_t), allocatable :: error

        call send_stdout_to(new_folder("twice")//"/err")
        status = int(c_dup2(1_c_int, 2_c_int))
        call prepare(chosen)
        call catch_interrupts(c_funloc(give_up))
        call file%open(new_folder("twice")//"/a.dat", error)
        status = int(c_raise(chosen))
        status = int(c_raise(chosen))
        status = 0
    end function raise_twice

    subroutine prepare(number)
        !! Make sure that whoever started the tests did not have this signal ignored; catch it.
        integer(c_int), intent(in) :: number
        type(c_funptr) :: old

        old = c_signal(number, c_null_funptr)
        call catch_interrupts()
        if (interrupt_status() /= 0) call c_exit(99_c_int)
    end subroutine prepare

    subroutine a_second_sigint_kills()
        !! For loops that do not look.
        call assertEqual(128 + int(sigint), exit_status(interrupt_twice))
    end subroutine a_second_sigint_kills

    function interrupt_twice() result(status)
        !! 0 if the second SIGINT does nothing.
        integer :: status

        call prepare(sigint)
        status = int(c_raise(sigint))
        status = int(c_raise(sigint))
        status = 0
    end function interrupt_twice

    subroutine who_does_not_look_is_ended()
        !! A second later, which is not waited for here; nothing is left behind.
        character(:), allocatable :: folder

        folder = new_folder("never")
        call assertEqual(status_terminated, exit_status(never_look))
        call assertEqual("lagrangia: interrupted"//new_line("a"), contents(folder//"/err"))
        call assertTrue(remove_file(folder//"/err"), "it was there: "//folder//"/err")
        call assertTrue(remove_file(folder), "a temporary was left")
    end subroutine who_does_not_look_is_ended

    function never_look() result(status)
        !! 0 if the alarm that SIGTERM sets does nothing.
        integer :: status
        type(output_file_t) :: file
        type(error_t), allocatable :: error

        call send_stdout_to(new_folder("never")//"/err")
        status = int(c_dup2(1_c_int, 2_c_int))
        call prepare(sigterm)
        call catch_interrupts(c_funloc(give_up))
        call file%open(new_folder("never")//"/a.dat", error)
        status = int(c_raise(sigterm))
        status = int(c_raise(sigalrm))
        status = 0
    end function never_look

    subroutine ignored_signals_stay_ignored()
        !! As those of a program started by `nohup`, or in the background by a script.
        call assertEqual(0, exit_status(ignore_sigint))
    end subroutine ignored_signals_stay_ignored

    function ignore_sigint() result(status)
        !! What SIGINT leads to if it was ignored before.
        integer :: status
        type(c_funptr) :: old

        old = c_signal(sigint, transfer(1_c_intptr_t, c_null_funptr))  ! SIG_IGN
        call catch_interrupts()
        status = int(c_raise(sigint))
        status = int(c_raise(sigint))
        status = interrupt_status()
    end function ignore_sigint

    subroutine run_program(arguments, status, error)
        !! Start it and wait for its end.
        type(word_t), intent(in) :: arguments(:)
        integer, intent(out) :: status
        type(error_t), allocatable, intent(out) :: error
        integer :: pid
        logical :: ended

        status = -1
        call start_program(arguments, pid, error)
        do while (.not. allocated(error))
            call await_program(arguments(1)%text, pid, 1000, ended, status, error)
            if (ended) exit
        end do
    end subroutine run_program

    subroutine run_shell(command, status, error)
        !! `sh -c command`, word by word: gfortran 12 leaks what an array constructor of them holds.
        character(*), intent(in) :: command
        integer, intent(out) :: status
        type(error_t), allocatable, intent(out) :: error
        type(word_t) :: words(3)

        words(1)%text = "sh"
        words(2)%text = "-c"
        words(3)%text = command
        call run_program(words, status, error)
    end subroutine run_shell

    subroutine programs_return_their_status()
        !! 128 + the signal if they die of one.
        type(error_t), allocatable :: error
        type(word_t), allocatable :: words(:)
        integer :: status

        call run_shell("exit 7", status, error)
        call assertFalse(allocated(error), "no error: programs return their status")
        call assertEqual(7, status)
        call run_shell("kill -9 $$", status, error)
        call assertFalse(allocated(error), "no error: programs return their status")
        call assertEqual(137, status)
        allocate (words(1))
        words(1)%text = "true"
        call run_program(words, status, error)
        call assertEqual(0, status)
    end subroutine programs_return_their_status

    subroutine a_program_is_watched()
        !! It has not ended when it is looked at first; what it reads itself is counted.
        type(error_t), allocatable :: error
        type(word_t) :: words(3)
        integer :: pid, status
        logical :: ended

        words(1)%text = "sh"
        words(2)%text = "-c"
        words(3)%text = "exec sleep 1"
        call start_program(words, pid, error)
        call assertFalse(allocated(error), "no error: a program is started")
        call await_program("sh", pid, 200, ended, status, error)
        call assertFalse(ended, "still running after 0.2 s")
        call assertTrue(bytes_read_by(pid) > 0_i8, "programs read their libraries")
        call await_program("sh", pid, 10000, ended, status, error)
        call assertTrue(ended, "ended within 10 s")
        call assertEqual(0, status)
        call assertEqual(0_i8, bytes_read_by(pid), "it is gone")
    end subroutine a_program_is_watched

    subroutine arguments_reach_no_shell()
        !! One argument stays one argument, byte for byte, blanks at its end too.
        type(error_t), allocatable :: error
        type(word_t) :: arguments(6)
        integer :: status

        arguments(1)%text = "sh"
        arguments(2)%text = "-c"
        arguments(3)%text = "test $# = 2 && test ""$1"" = 'a  $(b) ""c"" *; ' && "// &
                            "test ${#2} = 5000 && exit 7"
        arguments(4)%text = "name"
        arguments(5)%text = "a  $(b) ""c"" *; "
        arguments(6)%text = repeat("x", 5000)
        call run_program(arguments, status, error)
        call assertEqual(7, status)
    end subroutine arguments_reach_no_shell

    subroutine a_missing_program_is_an_error()
        !! With its name in the message.
        type(error_t), allocatable :: error
        type(word_t), allocatable :: words(:)
        integer :: status

        allocate (words(2))
        words(1)%text = "/no/gnuplot"
        words(2)%text = "-d"
        call run_program(words, status, error)
        call assertTrue(allocated(error), "an error: a missing program is an error")
        if (anyExceptions()) return
        call assertEqual("cannot run '/no/gnuplot': no such program", error%message)
        call assertEqual(status_file, error%status)
    end subroutine a_missing_program_is_an_error

    subroutine what_was_put_comes_first()
        !! Before what the other program says to the same stdout.
        character(:), allocatable :: path

        path = new_folder("order")//"/out"
        call assertEqual(0, exit_status(put_run_put))
        call assertEqual("one"//new_line("a")//"two"//new_line("a")//"three"//new_line("a"), &
                         contents(path))
        call assertTrue(remove_file(path), "it was there: "//path)
    end subroutine what_was_put_comes_first

    function put_run_put() result(status)
        !! We, another program, we.
        integer :: status
        type(error_t), allocatable :: error

        call send_stdout_to(new_folder("order")//"/out")
        call put_line("one")
        call run_shell("echo two", status, error)
        call put_line("three")
        call finish_console(error)
    end function put_run_put
end module test_processes
