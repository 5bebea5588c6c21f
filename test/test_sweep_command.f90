module test_sweep_command
    !! What a sweep leaves that does not come to its end: blocks of trajectories with which another
    !! goes on, if any is complete; else nothing.
    use, intrinsic :: iso_c_binding, only: c_int
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_command_line, only: command_line_t, parse_words
    use lagrangia_errors, only: error_t, status_file, status_interrupted
    use lagrangia_interrupt, only: catch_interrupts
    use lagrangia_registry, only: options
    use lagrangia_sweep_command, only: sweep_command
    use lagrangia_text, only: word_t
    use test_scratch, only: c_raise, contents, exit_status, limit_file_size, new_folder, &
                            remove_file
    implicit none (type, external)
    private
    public :: sweep_command_suite

    character(*), parameter :: of_500 = "sweep pendulum --over q=0.1:1:500 --keep theta "// &
        "--threads 1 --quiet --set scene%duration=0.1"

contains

    function sweep_command_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("sweep_command")
        call suite%addTest(TestMethod("where_all_fail_nothing_is_left", &
                                      where_all_fail_nothing_is_left))
        call suite%addTest(TestMethod("before_the_first_block_nothing_is_left", &
                                      before_the_first_block_nothing_is_left))
        call suite%addTest(TestMethod("a_disk_for_no_block_is_left_empty", &
                                      a_disk_for_no_block_is_left_empty))
        call suite%addTest(TestMethod("what_a_full_disk_has_is_kept", what_a_full_disk_has_is_kept))
    end function sweep_command_suite

    subroutine sweep(words, folder, error)
        !! Blanks part the words; the files are in `folder`.
        character(*), intent(in) :: words, folder
        type(error_t), allocatable, intent(out) :: error
        type(word_t), allocatable :: typed(:)
        type(command_line_t) :: line
        character(:), allocatable :: rest
        integer :: i, n

        rest = words//" --output "//folder//" "
        n = count([(rest(i:i) == " ", i=1, len(rest))])
        allocate (typed(n))
        do i = 1, n
            typed(i)%text = rest(:index(rest, " ") - 1)
            rest = rest(index(rest, " ") + 1:)
        end do
        call parse_words(typed, options, line, error)
        if (.not. allocated(error)) call sweep_command(line, error)
    end subroutine sweep

    subroutine where_all_fail_nothing_is_left()
        !! All blocks are there, and none is worth to be kept.
        type(error_t), allocatable :: error
        character(:), allocatable :: folder

        folder = new_folder("all_fail")
        call sweep("sweep hanging_chain --over n=2:5:4 --keep energy --quiet", folder, error)
        call assertTrue(allocated(error), "they fail")
        if (.not. allocated(error)) return
        call assertEqual(1, index(error%message, "all 4 trajectories fail: "), error%message)
        call assertEqual(0, index(error%message, "kept"), error%message)
        call assertTrue(remove_file(folder), "a file was left")
    end subroutine where_all_fail_nothing_is_left

    subroutine before_the_first_block_nothing_is_left()
        !! The folder is empty afterwards.
        character(:), allocatable :: folder

        folder = new_folder("interrupted")
        call assertEqual(status_interrupted, exit_status(interrupted), message="SIGINT")
        call assertTrue(remove_file(folder), "a file was left")
    end subroutine before_the_first_block_nothing_is_left

    function interrupted() result(status)
        !! What SIGINT leads to; 1 where the message is another.
        integer :: status
        type(error_t), allocatable :: error

        call catch_interrupts()
        status = int(c_raise(2_c_int))
        call sweep(of_500, new_folder("interrupted"), error)
        status = 1
        if (.not. allocated(error)) return
        if (index(error%message, " before the first block of trajectories was complete: none "// &
                  "is kept") > 0) status = error%status
    end function interrupted

    subroutine a_disk_for_no_block_is_left_empty()
        !! The disk is to blame, and nobody is told of an interruption.
        character(:), allocatable :: folder

        folder = new_folder("no_block")
        call assertEqual(status_file, exit_status(without_any_room), message="a full disk")
        call assertTrue(remove_file(folder), "a file was left")
    end subroutine a_disk_for_no_block_is_left_empty

    function without_any_room() result(status)
        !! What a disk for the beginning of the file leads to; 1 where the message is another.
        integer :: status
        type(error_t), allocatable :: error

        call catch_interrupts()
        call limit_file_size(700)
        call sweep(of_500, new_folder("no_block"), error)
        status = 1
        if (.not. allocated(error)) return
        if (index(error%message//"|", "_sweep.dat.part': File too large|") > 0) then
            status = error%status
        end if
    end function without_any_room

    subroutine what_a_full_disk_has_is_kept()
        !! And another sweep goes on with it, and leaves its table, a script and nothing else.
        type(error_t), allocatable :: error
        character(:), allocatable :: folder, path

        folder = new_folder("full_disk")
        path = folder//"/pendulum_duration_0.1_sweep.dat"
        call assertEqual(status_file, exit_status(without_room), message="a full disk")
        call sweep(of_500//" --resume", folder, error)
        call assertFalse(allocated(error), "it goes on")
        if (allocated(error)) call assertEqual("", error%message)
        call assertTrue(index(contents(path), "theta") > 0, "the table")
        call assertTrue(remove_file(path), "it was there: "//path)
        path = path(:len(path) - 3)//"gp"
        call assertTrue(remove_file(path), "it was there: "//path)
        call assertTrue(remove_file(folder), "a file was left")
    end subroutine what_a_full_disk_has_is_kept

    function without_room() result(status)
        !! What a disk for about half of the blocks leads to; 1 where the message is another.
        integer :: status
        type(error_t), allocatable :: error

        call catch_interrupts()
        call limit_file_size(3000)
        call sweep(of_500, new_folder("full_disk"), error)
        status = 1
        if (.not. allocated(error)) return
        if (index(error%message, " trajectories are kept in '"//new_folder("full_disk")//"/") > 0 &
            .and. index(error%message, "_sweep.dat.part', '--resume' goes on") > 0) then
            status = error%status
        end if
    end function without_room
end module test_sweep_command
