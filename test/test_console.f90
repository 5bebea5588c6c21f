module test_console
    !! What is put arrives, or the loss is reported: seen in processes of their own.
    use, intrinsic :: iso_c_binding, only: c_int
    use funit, only: TestMethod, TestSuite, assertEqual, assertTrue
    use lagrangia_c_library, only: c_close
    use lagrangia_console, only: console_failed, finish_console, note, put, put_line
    use lagrangia_errors, only: error_t, status_file, status_pipe
    use lagrangia_files, only: facts_t, look_at
    use lagrangia_interrupt, only: catch_interrupts
    use lagrangia_output_file, only: output_file_t
    use test_scratch, only: c_dup2, c_pipe, contents, exit_status, new_folder, &
        remove_file, send_stdout_to
    implicit none (type, external)
    private
    public :: console_suite

contains

    function console_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("console")
        call suite%addTest(TestMethod("stdout_arrives", stdout_arrives))
        call suite%addTest(TestMethod("a_full_stdout_is_reported", a_full_stdout_is_reported))
        call suite%addTest(TestMethod("a_broken_pipe_is_reported", a_broken_pipe_is_reported))
        call suite%addTest(TestMethod("a_closed_stdout_is_reported", a_closed_stdout_is_reported))
        call suite%addTest(TestMethod("a_closed_stdout_matters_only_if_used", &
                                      a_closed_stdout_matters_only_if_used))
        call suite%addTest(TestMethod("a_file_never_becomes_stdout", a_file_never_becomes_stdout))
        call suite%addTest(TestMethod("a_note_is_one_line", a_note_is_one_line))
    end function console_suite

    subroutine stdout_arrives()
        !! All of it, in order, at the latest with `finish_console`.
        character(:), allocatable :: path

        path = new_folder("console")//"/out"
        call assertEqual(0, exit_status(put_some))
        call assertEqual("a b\x1B\xFF"//new_line("a")//repeat("0123456789", 10000), contents(path))
        call assertTrue(remove_file(path), "it was there: "//path)
    end subroutine stdout_arrives

    function put_some() result(status)
        !! Two lines, one of them long: 0 if all seems well.
        integer :: status, i
        type(error_t), allocatable :: error

        call send_stdout_to(new_folder("console")//"/out")
        call put("a ")
        call put_line("b"//achar(27)//char(255))
        do i = 1, 10000
            call put("0123456789")
        end do
        call finish_console(error)
        status = 0
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

    subroutine a_broken_pipe_is_reported()
        !! By the status alone; it does not kill, lest files stay unfinished.
        call assertEqual(status_pipe, exit_status(put_to_nobody))
    end subroutine a_broken_pipe_is_reported

    function put_to_nobody() result(status)
        !! The status of the error if it is the right one.
        integer :: status
        integer(c_int) :: descriptors(2)
        type(error_t), allocatable :: error

        call catch_interrupts()
        status = int(c_pipe(descriptors))
        status = int(c_close(descriptors(1)))
        status = int(c_dup2(descriptors(2), 1_c_int))
        call put("a")
        call finish_console(error)
        status = 1
        if (.not. allocated(error)) return
        if (error%message /= "") return
        status = error%status
    end function put_to_nobody

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
        call assertTrue(remove_file(path), "it was there: "//path)
    end subroutine a_file_never_becomes_stdout

    function write_and_put() result(status)
        !! Write a file and put a line, without a stdout: the status of the latter's error.
        integer :: status
        type(output_file_t) :: file
        type(error_t), allocatable :: error

        status = int(c_close(1_c_int))
        call file%open(new_folder("closed")//"/a.dat", error)
        call file%write("data")
        call put_line("not data")
        call finish_console(error)
        if (allocated(error)) status = error%status
        call file%commit(error)
        if (allocated(error)) status = 1
    end function write_and_put

    subroutine a_note_is_one_line()
        !! Whatever is in it, and of at most 300 bytes; what was put before comes before.
        character(:), allocatable :: path, rest

        path = new_folder("note")//"/out"
        call assertEqual(0, exit_status(note_something))
        rest = contents(path)
        call assertEqual("first"//new_line("a")//"lagrangia: a\x0Ab\x00\x1B[1m\x7Fc"// &
                         new_line("a"), rest(:len(rest) - 301))
        call assertEqual(" end"//new_line("a"), rest(len(rest) - 4:))
        call assertTrue(remove_file(path), "it was there: "//path)
    end subroutine a_note_is_one_line

    function note_something() result(status)
        !! stdout and stderr into one file.
        integer :: status

        call send_stdout_to(new_folder("note")//"/out")
        status = int(c_dup2(1_c_int, 2_c_int))
        call put_line("first")
        call note("a"//new_line("a")//"b"//achar(0)//achar(27)//"[1m"//achar(127)//"c")
        call note(repeat("long", 500)//" end")
        status = 0
    end function note_something
end module test_console
