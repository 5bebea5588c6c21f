module test_output_failures
    !! What cannot be written is refused or reported, and leaves nothing behind.
    use, intrinsic :: iso_c_binding, only: c_int, c_null_char
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_c_library, only: c_access, c_chmod
    use lagrangia_data_files, only: new_table
    use lagrangia_drawing, only: bytes_to_read, ends_well
    use lagrangia_errors, only: error_t, fail, message_length, status_file, status_usage
    use lagrangia_interrupt, only: catch_interrupts
    use lagrangia_kinds, only: i8
    use lagrangia_output_file, only: output_file_t
    use lagrangia_table, only: table_t
    use lagrangia_text, only: shortened
    use test_scratch, only: c_symlink, contents, exit_status, limit_file_size, new_folder, &
        remove_file, write_file
    implicit none (type, external)
    private
    public :: output_failures_suite

contains

    function output_failures_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("output_failures")
        call suite%addTest(TestMethod("what_cannot_be_written_is_refused", &
                                      what_cannot_be_written_is_refused))
        call suite%addTest(TestMethod("a_protected_file_is_refused", a_protected_file_is_refused))
        call suite%addTest(TestMethod("rewrite_stays_inside", rewrite_stays_inside))
        call suite%addTest(TestMethod("a_closed_file_cannot_be_written", &
                                      a_closed_file_cannot_be_written))
        call suite%addTest(TestMethod("a_failed_rename_is_reported", a_failed_rename_is_reported))
        call suite%addTest(TestMethod("a_full_disk_is_reported", a_full_disk_is_reported))
        call suite%addTest(TestMethod("a_picture_ends_as_its_kind_does", &
                                      a_picture_ends_as_its_kind_does))
        call suite%addTest(TestMethod("a_script_says_what_is_read", a_script_says_what_is_read))
        call suite%addTest(TestMethod("a_full_disk_is_seen_early", a_full_disk_is_seen_early))
        call suite%addTest(TestMethod("a_header_is_sent_before_the_run", &
                                      a_header_is_sent_before_the_run))
    end function output_failures_suite

    subroutine what_cannot_be_written_is_refused()
        !! Before anything is computed, in one line that names the file.
        character(:), allocatable :: folder

        folder = new_folder("refused")
        call write_file(folder//"/file", "old")
        call assertTrue(c_symlink("nowhere"//c_null_char, folder//"/link"//c_null_char) == 0, &
                        "c_symlink('nowhere', folder//'/link') == 0")
        call refused("", "not a file name")
        call refused("a"//c_null_char, "not a file name")
        call refused(folder, "it is a folder")
        call refused(folder//"/new/", "it is a folder")
        call refused(new_folder("refused/ends with a blank "), "it is a folder")
        call refused("/dev/null", "it is not a regular file")
        call refused(folder//"/link", "it is a link that leads nowhere")
        call refused(folder//"/file/a.dat", "'"//folder//"/file' is not a folder")
        call refused(folder//"/file/x/a.dat", "'"//folder//"/file' is not a folder")
        call refused(folder//"/"//repeat("n", 300), "File name too long")
        call assertEqual("old", contents(folder//"/file"))
        call assertTrue(remove_file(folder//"/file"), "it was there: "//folder//"/file")
        call assertTrue(remove_file(folder//"/link"), "it was there: "//folder//"/link")
        call assertTrue(remove_file(folder//"/ends with a blank "), &
                        "it was there: "//folder//"/ends with a blank ")
        call assertTrue(remove_file(folder), "it was there: "//folder)
    end subroutine what_cannot_be_written_is_refused

    subroutine refused(path, why)
        !! Assert that `open` refuses `path` in these words.
        character(*), intent(in) :: path, why
        type(output_file_t) :: file
        type(error_t), allocatable :: error

        call file%open(path, error)
        call assertTrue(allocated(error), path//" was opened")
        if (.not. allocated(error)) then
            call file%abandon()
            return
        end if
        call assertEqual(shortened("cannot write '"//path//"': "//why, message_length), &
                         error%message)
        call assertEqual(status_file, error%status)
    end subroutine refused

    subroutine a_protected_file_is_refused()
        !! Though its folder would allow a rename. (For root nothing is protected.)
        character(:), allocatable :: path

        path = new_folder("protected")//"/a.dat"
        call write_file(path, "old")
        call assertTrue(c_chmod(path//c_null_char, int(o"444", c_int)) == 0, &
                        "c_chmod(path, int(o'444', c_int)) == 0")
        if (c_access(path//c_null_char, 2_c_int) /= 0) call refused(path, "Permission denied")
        call assertEqual("old", contents(path))
        call write_file(path, "trailer, startxref 17, %%EOF"//new_line("a"))
        call assertTrue(ends_well(path, "pdf"), "pdf")
        call assertFalse(ends_well(path, "svg"), "pdf is no svg")
        call assertTrue(remove_file(path), "it was there: "//path)
    end subroutine a_protected_file_is_refused

    subroutine rewrite_stays_inside()
        !! Only what has been written can be rewritten.
        type(output_file_t) :: file
        type(error_t), allocatable :: error
        character(:), allocatable :: folder
        integer(i8) :: offset

        folder = new_folder("inside")
        do offset = -1, 2, 3
            call file%open(folder//"/a.dat", error)
            call file%write("abc")
            call file%rewrite(offset, "de")
            call file%commit(error)
            call assertTrue(allocated(error), "an error: rewrite stays inside")
        end do
        call assertTrue(remove_file(folder), "it was there: "//folder)
    end subroutine rewrite_stays_inside

    subroutine a_closed_file_cannot_be_written()
        !! A mistake of ours, not of the user; but no silence either.
        type(output_file_t) :: file, other
        type(error_t), allocatable :: error

        call file%write("text")
        call assertTrue(file%failed(), "file%failed()")
        call file%commit(error)
        call assertTrue(allocated(error), "an error: a closed file cannot be written")
        if (anyExceptions()) return
        call assertEqual("cannot write '': it is not open", error%message)
        call other%rewrite(0_i8, "")
        call other%commit(error)
        call assertTrue(allocated(error), "nor rewritten")
        if (anyExceptions()) return
        call assertEqual("cannot write '': it is not open", error%message)
    end subroutine a_closed_file_cannot_be_written

    subroutine a_failed_rename_is_reported()
        !! Here a folder took the name while the file was being written.
        type(output_file_t) :: file
        type(error_t), allocatable :: error
        character(:), allocatable :: folder, blocker

        folder = new_folder("rename")
        call file%open(folder//"/a.dat", error)
        call file%write("text")
        blocker = new_folder("rename/a.dat")
        call file%commit(error)
        call assertTrue(allocated(error), "an error: a failed rename is reported")
        if (anyExceptions()) return
        call assertEqual("cannot write '"//folder//"/a.dat': Is a directory", error%message)
        call assertTrue(remove_file(blocker), "it was there: "//blocker)
        call assertTrue(remove_file(folder), "a temporary was left")
    end subroutine a_failed_rename_is_reported

    subroutine a_full_disk_is_reported()
        !! By `commit`, even if all of the text was still in C's buffer.
        character(:), allocatable :: folder

        folder = new_folder("full")
        call write_file(folder//"/a.dat", "old")
        call assertEqual(status_file, exit_status(write_little))
        call assertEqual(status_file, exit_status(write_much))
        call assertEqual("old", contents(folder//"/a.dat"))
        call assertTrue(remove_file(folder//"/a.dat"), "it was there: "//folder//"/a.dat")
        call assertTrue(remove_file(folder), "a temporary was left")
    end subroutine a_full_disk_is_reported

    function write_little() result(status)
        !! Less than C's buffer holds.
        integer :: status

        status = write_limited(40)
    end function write_little

    function write_much() result(status)
        !! Many times what C's buffer holds.
        integer :: status

        status = write_limited(100000)
    end function write_much

    function write_limited(length) result(status)
        !! Write so many bytes where 20 can be: the status of the error if it is the right one.
        integer, intent(in) :: length
        integer :: status, i
        type(output_file_t) :: file
        type(error_t), allocatable :: error
        character(:), allocatable :: path

        path = new_folder("full")//"/a.dat"
        call catch_interrupts()
        call limit_file_size(20)
        call file%open(path, error)
        do i = 1, length/10
            call file%write("0123456789")
        end do
        call file%commit(error)
        status = 1
        if (.not. allocated(error)) return
        if (error%message == "cannot write '"//path//"': File too large") status = error%status
    end function write_limited

    subroutine a_picture_ends_as_its_kind_does()
        !! Within its last 20 bytes, and not before; no other kind's end, no file, no bytes.
        character(*), parameter :: texts(7) = [character(48) :: "", "IEND", "IEND|", &
            "the picture goes on: IEND+ 4 of check", "IEND and then 21 bytes more", &
            "IEND+ so many, just 20", "<svg> and all that </svg>"]
        logical, parameter :: png(7) = [.false., .true., .true., .true., .false., .false., .false.]
        character(:), allocatable :: path
        integer :: i

        path = new_folder("pictures")//"/it"
        call assertFalse(ends_well(path, "png"), "no file")
        do i = 1, size(texts)
            call write_file(path, trim(texts(i)))
            call assertEqual(png(i), ends_well(path, "png"), message="png: "//texts(i))
            call assertEqual(i == 7, ends_well(path, "svg"), message="svg: "//texts(i))
        end do
        call write_file(path, "0123IEND012345678901")
        call assertTrue(ends_well(path, "png"), "20 bytes")
        call write_file(path, "0IEND0123456789012345")
        call assertTrue(ends_well(path, "png"), "its first in the last 20")
        call write_file(path, "IEND01234567890123456")
        call assertFalse(ends_well(path, "png"), "its first is the 21st from the end")
        call write_file(path, "trailer, startxref 17, %%EOF"//new_line("a"))
        call assertTrue(ends_well(path, "pdf"), "pdf")
        call assertFalse(ends_well(path, "svg"), "pdf is no svg")
        call assertTrue(remove_file(path), "it was there: "//path)
    end subroutine a_picture_ends_as_its_kind_does

    subroutine a_header_is_sent_before_the_run()
        !! In every format: where there is no room for it, that is said before anything is computed,
        !! and nothing is left; a header that could not begin keeps its own reason.
        character(:), allocatable :: folder

        folder = new_folder("header")
        call assertEqual(status_file, exit_status(text_header), "text")
        call assertEqual(status_file, exit_status(csv_header), "csv")
        call assertEqual(status_file, exit_status(npy_header), "npy")
        call assertEqual(status_usage, exit_status(refused_header), "refused by its format")
        call assertEqual(0, exit_status(good_header), "room enough")
        call assertTrue(remove_file(folder), "a temporary was left")
    end subroutine a_header_is_sent_before_the_run

    function text_header() result(status)
        !! See `header_status`.
        integer :: status

        status = header_status("text", 3, .false.)
    end function text_header

    function csv_header() result(status)
        !! See `header_status`.
        integer :: status

        status = header_status("csv", 3, .false.)
    end function csv_header

    function npy_header() result(status)
        !! See `header_status`.
        integer :: status

        status = header_status("npy", 3, .false.)
    end function npy_header

    function refused_header() result(status)
        !! See `header_status`.
        integer :: status

        status = header_status("text", 100000, .true.)
    end function refused_header

    function good_header() result(status)
        !! See `header_status`.
        integer :: status

        status = header_status("text", 100000, .false.)
    end function good_header

    function header_status(format, room, refused_before) result(status)
        !! The status of the error of a header where so many bytes are; 0 if there is none.
        character(*), intent(in) :: format
        integer, intent(in) :: room
        logical, intent(in) :: refused_before  !! as if `begin` had found a mistake
        integer :: status
        class(table_t), allocatable :: table
        type(error_t), allocatable :: error

        call catch_interrupts()
        call limit_file_size(room)
        call new_table(format, table)
        call table%file%open(new_folder("header")//"/a", error)
        call table%begin(["title"], ["t", "x"], ["s", "m"], error)
        if (refused_before) call fail(error, "refused")
        call table%send_header(error)
        status = 0
        if (allocated(error)) status = error%status
        if (table%file%is_open() .neqv. status == 0) status = 99
        call table%file%abandon()
    end function header_status

    subroutine a_script_says_what_is_read()
        !! Each file as often as its name is used: what gnuplot's progress is measured against.
        character(:), allocatable :: folder

        folder = new_folder("to_be_read")
        call write_file(folder//"/a.dat", repeat("1 2"//new_line("a"), 25))
        call write_file(folder//"/b.dat", "1 2"//new_line("a"))
        call write_file(folder//"/a.gp", "picture = folder.""a"""//new_line("a")// &
            "data = folder.""a.dat"""//new_line("a")//"data2 = folder.""b.dat"""//new_line("a")// &
            "data3 = folder.""none.dat"""//new_line("a")//"stats data using 1"//new_line("a")// &
            "plot data using 1:2, data2 using 1:2, \"//new_line("a")//"     data using 1:3"// &
            new_line("a"))
        call assertEqual(304_i8, bytes_to_read(folder//"/a.gp"), "three of 100, one of 4")
        call assertEqual(0_i8, bytes_to_read(folder//"/none.gp"), "no script")
    end subroutine a_script_says_what_is_read

    subroutine a_full_disk_is_seen_early()
        !! A long run can stop at the first row that is lost.
        call assertEqual(7, exit_status(write_until_failed))
    end subroutine a_full_disk_is_seen_early

    function write_until_failed() result(status)
        !! 7 if `failed` becomes true after the limit and long before the end.
        integer :: status
        type(output_file_t) :: file
        type(error_t), allocatable :: error
        integer :: i

        call catch_interrupts()
        call limit_file_size(20)
        call file%open(new_folder("early")//"/a.dat", error)
        status = 1
        if (file%failed()) return
        do i = 1, 1000000
            call file%write("0123456789")
            if (file%failed()) status = 7
            if (file%failed()) exit
        end do
        call file%abandon()
    end function write_until_failed
end module test_output_failures
