module test_partial_files
    !! A bad run never replaces a good file: what it wrote is `NAME.partial`, and says why.
    use, intrinsic :: iso_c_binding, only: c_null_char
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t, status_numbers
    use lagrangia_kinds, only: dp
    use lagrangia_outcome, only: outcome_t
    use lagrangia_output_file, only: output_file_t, remove_partial
    use scene_runs, only: perform
    use test_scratch, only: c_symlink, contents, new_folder, remove_file, write_file
    implicit none (type, external)
    private
    public :: partial_files_suite

    character(*), parameter :: newline = new_line("a")
    character(*), parameter :: exploding = "&scene system='oscillator' method='verlet' dt=10 "// &
        "duration=10000 every=2 q=1 output='s' columns='t','x' /"
    character(*), parameter :: bouncing = "&scene system='bouncing_ball' q=1 v=0 duration=9 "// &
        "dt=0.01 output='s' /&bouncing_ball restitution=0.5 /"

contains

    function partial_files_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("partial_files")
        call suite%addTest(TestMethod("a_partial_file_has_its_own_name", &
                                      a_partial_file_has_its_own_name))
        call suite%addTest(TestMethod("a_bad_run_leaves_the_good_file", &
                                      a_bad_run_leaves_the_good_file))
        call suite%addTest(TestMethod("a_partial_file_says_where_and_why", &
                                      a_partial_file_says_where_and_why))
        call suite%addTest(TestMethod("a_good_run_removes_what_is_stale", &
                                      a_good_run_removes_what_is_stale))
        call suite%addTest(TestMethod("no_row_no_file", no_row_no_file))
        call suite%addTest(TestMethod("events_are_kept_too", events_are_kept_too))
        call suite%addTest(TestMethod("no_rows_without_their_events", no_rows_without_their_events))
    end function partial_files_suite

    subroutine a_partial_file_has_its_own_name()
        !! Beside the file that it would have been, also where that is a link into another folder;
        !! only a file of ours is removed later.
        type(output_file_t) :: file
        type(error_t), allocatable :: error
        character(:), allocatable :: folder, inner

        folder = new_folder("own")
        inner = new_folder("own/inner")
        call write_file(inner//"/a.dat", "old")
        call assertTrue(c_symlink("inner/a.dat"//c_null_char, folder//"/a.dat"//c_null_char) == 0, &
                        "linked")
        call file%open(folder//"/a.dat", error)
        call file%write("part")
        file%partial = .true.
        call file%commit(error)
        call assertFalse(allocated(error), "it is written")
        call assertEqual("old", contents(folder//"/a.dat"))
        call assertEqual("part", contents(inner//"/a.dat.partial"))
        call assertEqual("part", contents(file%name()), "the name that is reported")
        call remove_partial(folder//"/a.dat")
        call assertEqual("(no file)", contents(inner//"/a.dat.partial"))
        call file%open(folder//"/a.dat", error)
        call file%write("whole")
        call file%commit(error)
        call assertEqual("whole", contents(inner//"/a.dat"), "the mark does not stay")
        call remove_partial(folder//"/none")
        call assertEqual(inner//"/a.dat.partial", new_folder("own/inner/a.dat.partial"))
        call remove_partial(folder//"/a.dat")
        call assertTrue(remove_file(inner//"/a.dat.partial"), "a folder was removed")
        call assertTrue(remove_file(inner//"/a.dat"), "removed: "//inner//"/a.dat")
        call assertTrue(remove_file(inner), "removed: "//inner)
        call assertTrue(remove_file(folder//"/a.dat"), "removed: "//folder//"/a.dat")
        call assertTrue(remove_file(folder), "something was left")
    end subroutine a_partial_file_has_its_own_name

    subroutine a_bad_run_leaves_the_good_file()
        !! In every format, and the script beside it; the error names the part.
        character(4), parameter :: formats(3) = ["text", "csv ", "npy "]
        character(3), parameter :: endings(3) = ["dat", "csv", "npy"]
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        character(:), allocatable :: folder, path
        integer :: i

        folder = new_folder("bad")
        call write_file(folder//"/s.gp", "old")
        do i = 1, size(formats)
            path = folder//"/s."//endings(i)
            call write_file(path, "old")
            call perform(exploding, folder, trim(formats(i)), outcome, error)
            call assertTrue(allocated(error), "it explodes")
            if (anyExceptions()) return
            call assertEqual(status_numbers, error%status)
            call assertEqual("old", contents(path))
            call assertEqual("old", contents(folder//"/s.gp"))
            call assertEqual(path//".partial", outcome%file)
            call assertTrue(index(error%message, "'"//outcome%file//"'") > 0, error%message)
            call assertTrue(len(contents(outcome%file)) > 100, "what was good is there")
            call assertTrue(remove_file(path), "removed: "//path)
            call assertTrue(remove_file(path//".partial"), "removed: "//path//".partial")
        end do
        call assertTrue(remove_file(folder//"/s.gp"), "removed: "//folder//"/s.gp")
        call assertTrue(remove_file(folder), "something was left")
    end subroutine a_bad_run_leaves_the_good_file

    subroutine a_partial_file_says_where_and_why()
        !! Rows, time, steps of those planned, and reason, in the line that else has the counts.
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        character(:), allocatable :: folder, text
        character(200) :: last
        integer :: first, i, rows, steps
        real(dp) :: t

        folder = new_folder("says")
        call perform(exploding, folder, "text", outcome, error)
        call assertTrue(allocated(error), "it explodes")
        text = contents(folder//"/s.dat.partial")
        first = index(text, newline//"# PARTIAL, rows: ")
        call assertTrue(first > 0, text(:min(len(text), 1000)))
        call assertFalse(index(text, newline//"# steps: ") > 0, "it does not claim all")
        if (anyExceptions()) return
        text = text(first + 1:)
        read (text(len("# PARTIAL, rows: ") + 1:index(text, ";") - 1), *) rows
        i = index(text, " at t = ")
        read (text(i + 8:i + index(text(i:), " s after ") - 2), *) t
        i = index(text, " s after ")
        read (text(i + 9:i + index(text(i:), " of 1000 steps: ") - 1), *) steps
        call assertTrue(index(text, " of 1000 steps: the state is not finite at t = ") > 0, text)
        call assertEqual(10*steps, nint(t), "ten seconds a step")
        call assertEqual(2*(rows - 1), steps, "two steps a row")
        call assertEqual(rows, int(outcome%rows))
        call assertEqual(steps, int(outcome%steps))
        text = text(:len(text) - 1)
        last = text(index(text, newline, back=.true.) + 1:)
        read (last, *) t
        call assertEqual(10*steps, nint(t), "that of the last row")
        rows = rows + 2  ! with the line of the counts and that of the columns
        do i = 1, len(text)
            if (text(i:i) == newline) rows = rows - 1
        end do
        call assertEqual(1, rows, "so many rows are there")
        call assertTrue(remove_file(folder//"/s.dat.partial"), &
                        "removed: "//folder//"/s.dat.partial")
        call assertTrue(remove_file(folder), "something was left")
    end subroutine a_partial_file_says_where_and_why

    subroutine a_good_run_removes_what_is_stale()
        !! The part that an earlier run left; in another format it is another file's.
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        character(:), allocatable :: folder

        folder = new_folder("stale")
        call write_file(folder//"/s.dat.partial", "stale")
        call write_file(folder//"/s_events.dat.partial", "stale")
        call write_file(folder//"/s.csv.partial", "another's")
        call perform(bouncing, folder, "text", outcome, error)
        call assertFalse(allocated(error), "it runs")
        call assertEqual("(no file)", contents(folder//"/s.dat.partial"))
        call assertEqual("(no file)", contents(folder//"/s_events.dat.partial"))
        call assertEqual("another's", contents(folder//"/s.csv.partial"))
        call assertTrue(remove_file(folder//"/s.csv.partial"), &
                        "removed: "//folder//"/s.csv.partial")
        call assertTrue(remove_file(folder//"/s.dat"), "removed: "//folder//"/s.dat")
        call assertTrue(remove_file(folder//"/s.gp"), "removed: "//folder//"/s.gp")
        call assertTrue(remove_file(folder//"/s_events.dat"), "removed: "//folder//"/s_events.dat")
        call assertEqual(folder//"/s_events.dat", outcome%events, "where the impacts are")
        if (outcome%draws_events) call assertTrue(remove_file(folder//"/s_events.gp"), &
                        "removed: "//folder//"/s_events.gp")
        call assertTrue(remove_file(folder), "something was left")
    end subroutine a_good_run_removes_what_is_stale

    subroutine no_row_no_file()
        !! Where the first sample fails there is no part, nor one of an earlier run.
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        character(:), allocatable :: folder

        folder = new_folder("none")
        call write_file(folder//"/s.dat", "old")
        call write_file(folder//"/s.dat.partial", "stale")
        call perform("&scene system='oscillator' dt=1 duration=2 q=1e300 output='s' "// &
                     "columns='t','energy' /", folder, "text", outcome, error)
        call assertTrue(allocated(error), "the energy overflows")
        if (anyExceptions()) return
        call assertEqual(status_numbers, error%status)
        call assertEqual("", outcome%file)
        call assertEqual("old", contents(folder//"/s.dat"))
        call assertTrue(remove_file(folder//"/s.dat"), "removed: "//folder//"/s.dat")
        call assertTrue(remove_file(folder), "something was left")
    end subroutine no_row_no_file

    subroutine events_are_kept_too()
        !! A growing oscillation passes through 0 until it leaves the numbers.
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        character(:), allocatable :: folder, text

        folder = new_folder("events")
        call write_file(folder//"/s_events.dat", "old")
        call perform(exploding(:len(exploding) - 1)//"event='x' /", folder, "text", outcome, error)
        call assertTrue(allocated(error), "it explodes")
        call assertEqual("old", contents(folder//"/s_events.dat"))
        text = contents(folder//"/s_events.dat.partial")
        call assertTrue(index(text, newline//"# PARTIAL, rows: ") > 0, text(:min(len(text), 2000)))
        call assertEqual("", outcome%events, "no file of them is whole")
        call assertFalse(outcome%draws_events, "there is nothing to draw")
        call assertTrue(remove_file(folder//"/s_events.dat"), "removed: "//folder//"/s_events.dat")
        call assertTrue(remove_file(folder//"/s_events.dat.partial"), &
                        "removed: "//folder//"/s_events.dat.partial")
        call assertTrue(remove_file(folder//"/s.dat.partial"), &
                        "removed: "//folder//"/s.dat.partial")
        call assertTrue(remove_file(folder), "something was left")
    end subroutine events_are_kept_too

    subroutine no_rows_without_their_events()
        !! A folder stands where the part of the events should: nothing is left, and both are said.
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        character(:), allocatable :: folder, inner

        folder = new_folder("blocked")
        inner = new_folder("blocked/s_events.dat.partial")
        call perform(exploding(:len(exploding) - 1)//"event='x' /", folder, "text", outcome, error)
        call assertTrue(allocated(error), "it explodes")
        if (anyExceptions()) return
        call assertEqual(status_numbers, error%status, "still of the numbers")
        call assertTrue(index(error%message, "the state is not finite") > 0, error%message)
        call assertTrue(index(error%message, "s_events.dat") > 0, error%message)
        call assertEqual("", outcome%file, "no part of the rows")
        call assertEqual("(no file)", contents(folder//"/s.dat.partial"))
        call assertTrue(remove_file(inner), "removed: "//inner)
        call assertTrue(remove_file(folder), "something was left")
    end subroutine no_rows_without_their_events
end module test_partial_files
