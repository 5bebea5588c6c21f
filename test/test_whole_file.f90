module test_whole_file
    !! Reading a whole file: regular files only, every byte, nothing that blocks.
    use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t, status_file
    use lagrangia_files, only: most_bytes, read_whole_file
    use test_scratch, only: new_folder, remove_file
    implicit none (type, external)
    private
    public :: whole_file_suite

    interface
        function mkfifo(path, mode) bind(c, name="mkfifo") result(status)
            !! Make a FIFO.
            import :: c_char, c_int
            implicit none (type, external)
            ! allow(assumed-size): a C string
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int), value :: mode
            integer(c_int) :: status
        end function mkfifo
    end interface

contains

    function whole_file_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("whole_file")
        call suite%addTest(TestMethod("only_whole_regular_files", only_whole_regular_files))
    end function whole_file_suite

    subroutine unreadable(path, expected)
        !! Reading `path` fails with just this message.
        character(*), intent(in) :: path, expected
        character(:), allocatable :: text
        type(error_t), allocatable :: error

        call read_whole_file(path, text, error)
        call assertTrue(allocated(error), message="not refused: "//expected)
        if (.not. allocated(error)) return
        call assertEqual(expected, error%message)
        call assertEqual(status_file, error%status)
        call assertFalse(allocated(text), "no text of "//path)
    end subroutine unreadable

    subroutine only_whole_regular_files()
        !! Nothing that could block or never end.
        character(:), allocatable :: fifo, file, text
        type(error_t), allocatable :: error
        integer :: i, unit
        character(256) :: bytes

        file = new_folder("whole_file")//"/scene.nml"
        fifo = new_folder("whole_file")//"/fifo"
        do i = 0, 255
            bytes(i + 1:i + 1) = char(i)
        end do
        open (newunit=unit, file=file, access="stream", form="unformatted", status="replace", &
              action="write")
        write (unit) bytes, "no final newline"
        close (unit)
        call unreadable(file//"  ", file//" \x20: no such file")
        call unreadable(" "//file, "\x20"//file//": no such file")
        call read_whole_file(file, text, error)
        call assertFalse(allocated(error), "a file of all bytes is read")
        if (anyExceptions()) return
        call assertEqual(272, len(text))
        call assertTrue(text == bytes//"no final newline", message="every byte comes through")
        open (newunit=unit, file=file, access="stream", form="unformatted", status="replace", &
              action="write")
        write (unit) repeat("x", most_bytes)
        close (unit)
        call read_whole_file(file, text, error)
        call assertFalse(allocated(error), message="the largest file")
        if (allocated(text)) call assertEqual(most_bytes, len(text))
        open (newunit=unit, file=file, access="stream", form="unformatted", position="append", &
              action="write")
        write (unit) "x"
        close (unit)
        call unreadable(file, file//": the file is longer than 1048576 bytes")
        call assertTrue(remove_file(file), file)
        call unreadable(file, file//": no such file")
        call unreadable("/dev/zero", "/dev/zero: not a regular file")
        call unreadable("/", "/: is a folder; a file is needed")
        call unreadable("", "the name of the file is empty")
        call unreadable(" ", "\x20: no such file")
        call unreadable("a"//c_null_char//"b", "a\x00b: the name of the file holds a NUL byte")
        call assertEqual(0, int(mkfifo(fifo//c_null_char, int(o"600", c_int))))
        if (anyExceptions()) return
        call unreadable(fifo, fifo//": not a regular file")
        call assertTrue(remove_file(fifo), fifo)
    end subroutine only_whole_regular_files
end module test_whole_file
