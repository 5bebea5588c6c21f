module test_processes
    !! Stdout, signals, other programs: most of it is seen in a process of its own.
    use, intrinsic :: iso_c_binding, only: c_associated, c_funptr, c_int, c_intptr_t, &
        c_null_char, c_null_funptr, c_ptr
    use, intrinsic :: iso_fortran_env, only: output_unit
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_c_library, only: c_exit, c_fileno, c_fopen, c_signal
    use lagrangia_console, only: console_failed, finish_console, is_terminal, note, put, put_line
    use lagrangia_errors, only: error_t, status_file, status_interrupted, status_terminated
    use lagrangia_files, only: facts_t, look_at
    use lagrangia_interrupt, only: catch_interrupts, interrupt_status
    use lagrangia_output_file, only: output_file_t
    use lagrangia_processes, only: run_program
    use test_scratch, only: c_close, c_dup2, c_raise, contents, exit_status, new_folder, &
        remove_file
    implicit none (type, external)
    private
    public :: processes_suite

    integer(c_int), parameter :: sigint = 2, sigterm = 15

contains

    function processes_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("processes")
        call suite%addTest(TestMethod("stdout_arrives", stdout_arrives))
        call suite%addTest(TestMethod("a_full_stdout_is_reported", a_full_stdout_is_reported))
        call suite%addTest(TestMethod("a_closed_stdout_is_reported", a_closed_stdout_is_reported))
        call suite%addTest(TestMethod("a_closed_stdout_matters_only_if_used", &
                                      a_closed_stdout_matters_only_if_used))
        call suite%addTest(TestMethod("a_file_never_becomes_stdout", a_file_never_becomes_stdout))
        call suite%addTest(TestMethod("a_note_is_one_line", a_note_is_one_line))
        call suite%addTest(TestMethod("signals_are_remembered", signals_are_remembered))
        call suite%addTest(TestMethod("a_second_sigint_kills", a_second_sigint_kills))
        call suite%addTest(TestMethod("ignored_signals_stay_ignored", &
                                      ignored_signals_stay_ignored))
        call suite%addTest(TestMethod("programs_return_their_status", &
                                      programs_return_their_status))
        call suite%addTest(TestMethod("arguments_reach_no_shell", arguments_reach_no_shell))
        call suite%addTest(TestMethod("a_missing_program_is_an_error", &
                                      a_missing_program_is_an_error))
    end function processes_suite

    subroutine send_stdout_to(path)
        !! From now on stdout is this file.
        character(*), intent(in) :: path
        type(c_ptr) :: stream
        integer :: status

        stream = c_fopen(path//c_null_char, "w"//c_null_char)
        if (.not. c_associated(stream)) call c_exit(99_c_int)
        status = int(c_dup2(c_fileno(stream), 1_c_int))
    end subroutine send_stdout_to

    subroutine stdout_arrives()
        !! All of it, in order, at the latest with `finish_console`.
        character(:), allocatable :: path

        path = new_folder("console")//"/out"
        call assertEqual(0, exit_status(put_some))
        call assertEqual("a b"//new_line("a")//repeat("0123456789", 10000), contents(path))
        call assertTrue(remove_file(path))
    end subroutine stdout_arrives

    function put_some() result(status)
        !! Two lines, one of them long: 0 if all seems well.
        integer :: status, i
        type(error_t), allocatable :: error

        call send_stdout_to(new_folder("console")//"/out")
        call put("a ")
        call put_line("b")
        do i = 1, 10000
            call put("0123456789")
        end do
        call finish_console(error)
        status = merge(1, 0, is_terminal(output_unit))
        if (allocated(error)) status = 2
    end function put_some

    subroutine a_full_stdout_is_reported()
        !! If one character was put (where the system has a device to try it on).
        type(facts_t) :: facts

        facts = look_at("/dev/full")
        if (facts%found) call assertEqual(status_file, exit_status(put_to_full))
    end subroutine a_full_stdout_is_reported

    function put_to_full() result(status)
        !! The status of the error if it is the right one.
        integer :: status
        type(error_t), allocatable :: error

        call send_stdout_to("/dev/full")
        call put("a")
        status = 1
        if (console_failed()) return
        call finish_console(error)
        if (.not. allocated(error) .or. .not. console_failed()) return
        if (error%message /= "cannot write standard output: No space left on device") return
        status = error%status
    end function put_to_full

    subroutine a_closed_stdout_is_reported()
        !! As `>&-` gives it.
        call assertEqual(status_file, exit_status(put_to_closed))
    end subroutine a_closed_stdout_is_reported

    function put_to_closed() result(status)
        !! The status of the error if it is the right one.
        integer :: status
        type(error_t), allocatable :: error

        status = int(c_close(1_c_int))
        call put("a")
        call finish_console(error)
        status = 1
        if (.not. allocated(error)) return
        if (error%message /= "cannot write standard output: Bad file descriptor") return
        status = error%status
    end function put_to_closed

    subroutine a_closed_stdout_matters_only_if_used()
        !! As with GNU tools.
        call assertEqual(0, exit_status(put_nothing))
    end subroutine a_closed_stdout_matters_only_if_used

    function put_nothing() result(status)
        !! 0 if there is no error.
        integer :: status
        type(error_t), allocatable :: error

        status = int(c_close(1_c_int))
        call finish_console(error)
        status = merge(1, 0, allocated(error))
    end function put_nothing

    subroutine a_file_never_becomes_stdout()
        !! Though the system hands out the lowest number that is free, which is that of stdout.
        character(:), allocatable :: path

        path = new_folder("closed")//"/a.dat"
        call assertEqual(status_file, exit_status(write_and_put))
        call assertEqual("data", contents(path))
        call assertTrue(remove_file(path))
    end subroutine a_file_never_becomes_stdout

    function write_and_put() result(status)
        !! Write a file and put a line, without a stdout: the status of the latter's error.
        integer :: status
        type(output_file_t) :: file
        type(error_t), allocatable :: error

        status = int(c_close(1_c_int))
        status = int(c_close(0_c_int))
        call file%open(new_folder("closed")//"/a.dat", error)
        call file%write("data")
        call put_line("not data")
        call file%commit(error)
        status = 1
        if (allocated(error)) return
        call finish_console(error)
        if (allocated(error)) status = error%status
    end function write_and_put

    subroutine a_note_is_one_line()
        !! Whatever is in it; what was put before comes before.
        character(:), allocatable :: path

        path = new_folder("note")//"/out"
        call assertEqual(0, exit_status(note_something))
        call assertEqual("first"//new_line("a")//"lagrangia: a?b??[1m c"//new_line("a"), &
                         contents(path))
        call assertTrue(remove_file(path))
    end subroutine a_note_is_one_line

    function note_something() result(status)
        !! stdout and stderr into one file.
        integer :: status

        call send_stdout_to(new_folder("note")//"/out")
        status = int(c_dup2(1_c_int, 2_c_int))
        call put_line("first")
        call note("a"//new_line("a")//"b"//achar(0)//achar(27)//"[1m c")
        status = 0
    end function note_something

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

    subroutine programs_return_their_status()
        !! 128 + the signal if they die of one.
        type(error_t), allocatable :: error
        integer :: status

        call run_program([character(12) :: "sh", "-c", "exit 7"], status, error)
        call assertFalse(allocated(error))
        call assertEqual(7, status)
        call run_program([character(12) :: "sh", "-c", "kill -9 $$"], status, error)
        call assertFalse(allocated(error))
        call assertEqual(137, status)
        call run_program(["true"], status, error)
        call assertEqual(0, status)
    end subroutine programs_return_their_status

    subroutine arguments_reach_no_shell()
        !! One argument stays one argument, character for character.
        type(error_t), allocatable :: error
        character(60) :: arguments(5)
        integer :: status

        arguments(1) = "sh"
        arguments(2) = "-c"
        arguments(3) = "test $# = 1 && test ""$1"" = 'a  $(b) ""c"" *;' && exit 7"
        arguments(4) = "name"
        arguments(5) = "a  $(b) ""c"" *;"
        call run_program(arguments, status, error)
        call assertEqual(7, status)
    end subroutine arguments_reach_no_shell

    subroutine a_missing_program_is_an_error()
        !! With its name in the message.
        type(error_t), allocatable :: error
        integer :: status

        call run_program([character(12) :: "/no/gnuplot", "-d"], status, error)
        call assertTrue(allocated(error))
        if (anyExceptions()) return
        call assertEqual("cannot run '/no/gnuplot': no such program", error%message)
        call assertEqual(status_file, error%status)
    end subroutine a_missing_program_is_an_error
end module test_processes
