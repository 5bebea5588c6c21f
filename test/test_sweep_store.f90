module test_sweep_store
    !! The blocks of a sweep in files: they come back bit by bit, what is cut is computed again,
    !! what is damaged is computed again, what is of another sweep is refused.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_files, only: read_whole_file
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_sweep, only: new_sweep, sweep_t
    use lagrangia_sweep_grid, only: block_size, compute_grid, sweep_result_t
    use lagrangia_sweep_store, only: sweep_store_t
    use lagrangia_system, only: system_t
    use sweep_numbers, only: compute_numbers, sweep_numbers_t
    use test_scratch, only: new_folder
    implicit none (type, external)
    private
    public :: sweep_store_suite

    character(*), parameter :: told = "m = 1"//new_line("a")
    integer(i8), parameter :: total = 23, size_of_block = 5  ! five blocks, the last of three

    type, extends(observer_t) :: listener_t
        !! How far the sweep was when it said so last.
        integer(i8) :: done = 0, all = 0
    contains
        procedure :: observe
        procedure :: tick
    end type listener_t

    class(observer_t), pointer :: listener => null()

contains

    subroutine observe(self, system, t, q, v, error)
        !! Sees nothing.
        class(listener_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error
    end subroutine observe

    subroutine tick(self, done, steps)
        !! Hears how far it is.
        class(listener_t), intent(inout) :: self
        integer(i8), intent(in) :: done, steps

        self%done = done
        self%all = steps
    end subroutine tick

    function sweep_store_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("sweep_store")
        call suite%addTest(TestMethod("blocks_come_back", blocks_come_back))
        call suite%addTest(TestMethod("a_block_that_is_cut_is_lost", a_block_that_is_cut_is_lost))
        call suite%addTest(TestMethod("a_beginning_that_is_cut_is_written_again", &
                                      a_beginning_that_is_cut_is_written_again))
        call suite%addTest(TestMethod("what_is_sound_is_kept", what_is_sound_is_kept))
        call suite%addTest(TestMethod("another_sweep_is_refused", another_sweep_is_refused))
        call suite%addTest(TestMethod("one_writes_at_a_time", one_writes_at_a_time))
        call suite%addTest(TestMethod("files_of_other_images_are_read", &
                                      files_of_other_images_are_read))
        call suite%addTest(TestMethod("a_resumed_sweep_is_the_same", a_resumed_sweep_is_the_same))
        call suite%addTest(TestMethod("blocks_are_not_too_many", blocks_are_not_too_many))
    end function sweep_store_suite

    function numbers_of(store, block) result(values)
        !! Two for each trajectory of a block; one of all is NaN.
        type(sweep_store_t), intent(in) :: store
        integer(i8), intent(in) :: block
        real(dp), allocatable :: values(:, :)
        integer(i8) :: i

        allocate (values(2, store%last_of(block) - store%first_of(block) + 1))
        do i = store%first_of(block), store%last_of(block)
            values(:, i - store%first_of(block) + 1) = [real(i, dp)/7, -1/real(i, dp)]
            if (i == 7) values(2, i - store%first_of(block) + 1) = ieee_value(1.0_dp, &
                                                                              ieee_quiet_nan)
        end do
    end function numbers_of

    subroutine write_blocks(path, blocks, image)
        !! A file of some blocks, in this order.
        character(*), intent(in) :: path
        integer, intent(in) :: blocks(:), image
        type(sweep_store_t) :: store
        type(error_t), allocatable :: error
        integer :: i

        call store%prepare(path, told, 2, total, size_of_block, error)
        call store%own_part(image, error)
        call assertFalse(allocated(error), "a file is begun")
        do i = 1, size(blocks)
            call store%put(int(blocks(i), i8), numbers_of(store, int(blocks(i), i8)), &
                           merge(1_i8, 0_i8, blocks(i) == 2), merge(7_i8, 99_i8, blocks(i) == 2), &
                           error)
            call assertFalse(allocated(error), "a block is written")
        end do
        call store%release()
    end subroutine write_blocks

    subroutine change(path, last, place, byte)
        !! Rewrite a file up to byte `last`, with another byte at `place`; 0: none.
        character(*), intent(in) :: path
        integer, intent(in) :: last, place
        character(1), intent(in) :: byte
        character(:), allocatable :: text
        type(error_t), allocatable :: error
        integer :: unit

        call read_whole_file(path, text, error)
        if (place > 0) text(place:place) = byte
        open (newunit=unit, file=path, access="stream", form="unformatted", status="replace", &
              action="write")
        write (unit) text(:merge(last, len(text), last > 0))
        close (unit)
    end subroutine change

    subroutine take(path, told_now, store, error)
        !! What is there.
        character(*), intent(in) :: path, told_now
        type(sweep_store_t), intent(out) :: store
        type(error_t), allocatable, intent(out) :: error

        call store%prepare(path, told_now, 2, total, size_of_block, error)
        if (.not. allocated(error)) call store%take_parts(error)
    end subroutine take

    subroutine compare(store, blocks)
        !! These blocks are there with their numbers, and no others.
        type(sweep_store_t), intent(inout) :: store
        integer, intent(in) :: blocks(:)
        real(dp), allocatable :: values(:, :), expected(:, :)
        type(error_t), allocatable :: error
        integer :: k

        call assertEqual(size(blocks), int(store%there), "how many are there")
        call store%own_part(1, error)
        call assertFalse(allocated(error), "goes on")
        do k = 1, 5
            call assertTrue(store%has(int(k, i8)) .eqv. any(blocks == k), "which are there")
            if (.not. store%has(int(k, i8))) cycle
            expected = numbers_of(store, int(k, i8))
            allocate (values, mold=expected)
            call store%get(int(k, i8), values, error)
            call assertFalse(allocated(error), "it can be read")
            call assertTrue(all(transfer(values, [1_i8]) == transfer(expected, [1_i8])), &
                            "bit by bit")
            deallocate (values)
        end do
    end subroutine compare

    subroutine blocks_come_back()
        !! In whatever order they were written; with failures and how many trajectories.
        type(sweep_store_t) :: store
        type(error_t), allocatable :: error
        character(:), allocatable :: path

        path = new_folder("store")//"/a.dat"
        call write_blocks(path, [4, 2, 5], 1)
        call take(path, told, store, error)
        call assertFalse(allocated(error), "they are taken")
        call compare(store, [2, 4, 5])
        call assertEqual(13, int(store%trajectories_there()), "two of five and one of three")
        call assertEqual(1, int(store%failures), "the failures")
        call assertEqual(7, int(store%first_failed), "the first of them")
        call store%remove()
        call take(path, told, store, error)
        call assertEqual(0, int(store%there), "removed")
    end subroutine blocks_come_back

    subroutine a_block_that_is_cut_is_lost()
        !! And only that one; its place is used again.
        type(sweep_store_t) :: store
        type(error_t), allocatable :: error
        character(:), allocatable :: path, text
        integer :: cut

        do cut = 1, 14*8 - 1, 22
            path = new_folder("store")//"/a.dat"
            call write_blocks(path, [4, 2, 3], 1)
            call read_whole_file(path//".part", text, error)
            call change(path//".part", len(text) - cut, 0, " ")
            call take(path, told, store, error)
            call assertFalse(allocated(error), "they are taken")
            call compare(store, [2, 4])
            call store%put(1_i8, numbers_of(store, 1_i8), 0_i8, 99_i8, error)
            call store%release()
            call take(path, told, store, error)
            call assertFalse(allocated(error), "they are taken again")
            call compare(store, [1, 2, 4])
            call store%remove()
        end do
    end subroutine a_block_that_is_cut_is_lost

    subroutine a_beginning_that_is_cut_is_written_again()
        !! Who is killed so early has computed nothing, and can resume all the same.
        type(sweep_store_t) :: store
        type(error_t), allocatable :: error
        character(:), allocatable :: path
        integer :: length

        do length = 1, 7, 3
            path = new_folder("store")//"/a.dat"
            call write_blocks(path, [4, 2], 1)
            call change(path//".part", length, 0, " ")
            call take(path, told, store, error)
            call assertFalse(allocated(error), "it is taken")
            call compare(store, [integer ::])
            call store%put(1_i8, numbers_of(store, 1_i8), 0_i8, 99_i8, error)
            call store%release()
            call take(path, told, store, error)
            call assertFalse(allocated(error), "it is taken again")
            call compare(store, [1])
            call store%remove()
        end do
    end subroutine a_beginning_that_is_cut_is_written_again

    subroutine what_is_sound_is_kept()
        !! A byte of any record may be wrong, or any number of them from any place on: the other
        !! record is there. In the text nothing may be.
        type(sweep_store_t) :: store
        type(error_t), allocatable :: error
        character(:), allocatable :: path, text
        integer :: first, place, second, third, unit

        path = new_folder("store")//"/a.dat"
        call write_blocks(path, [4, 2, 5], 1)
        call read_whole_file(path//".part", text, error)
        third = len(text) - 8*(4 + 2*3)  ! bytes before the third record, which is shorter
        second = third - 8*(4 + 2*int(size_of_block))
        first = second - 8*(4 + 2*int(size_of_block))
        do place = 1, len(text)
            call change(path//".part", 0, place, achar(ieor(iachar(text(place:place)), 4)))
            call take(path, told, store, error)
            call assertTrue(allocated(error) .eqv. place <= first, "the text tells the sweep")
            if (allocated(error)) then
                call assertTrue(index(error%message, "another sweep") > 0, error%message)
            else
                call assertTrue(allocated(store%damage) .or. place > third, "it is said")
                if (place <= second) then
                    call compare(store, [2, 5])
                else if (place <= third) then
                    call compare(store, [4, 5])
                else
                    call compare(store, [2, 4])
                end if
            end if
            call store%release()
            call change(path//".part", 0, place, text(place:place))
        end do
        do place = first + 1, len(text)
            call change(path//".part", place, 0, " ")
            call take(path, told, store, error)
            call assertFalse(allocated(error), "cut")
            call assertFalse(allocated(store%damage), "an end that is missing is no damage")
            call store%release()
            open (newunit=unit, file=path//".part", access="stream", form="unformatted", &
                  status="replace", action="write")
            write (unit) text
            close (unit)
        end do
        call take(path, told, store, error)
        call assertFalse(allocated(error) .or. allocated(store%damage), "as it was")
        call compare(store, [2, 4, 5])
        call store%remove()
    end subroutine what_is_sound_is_kept

    subroutine another_sweep_is_refused()
        !! By what tells it.
        type(sweep_store_t) :: store
        type(error_t), allocatable :: error
        character(:), allocatable :: path

        path = new_folder("store")//"/a.dat"
        call write_blocks(path, [4, 2], 1)
        call take(path, "m = 2"//new_line("a"), store, error)
        call assertTrue(allocated(error), "another sweep")
        if (allocated(error)) call assertTrue(index(error%message, "another sweep") > 0, &
                                              error%message)
        call take(path, told, store, error)
        call compare(store, [2, 4])
        call store%remove()
    end subroutine another_sweep_is_refused

    subroutine one_writes_at_a_time()
        !! Who comes second is told.
        type(sweep_store_t) :: first, second
        type(error_t), allocatable :: error
        character(:), allocatable :: path

        path = new_folder("store")//"/a.dat"
        call first%prepare(path, told, 2, total, size_of_block, error)
        call first%own_part(1, error)
        call assertFalse(allocated(error), "the first")
        call second%prepare(path, told, 2, total, size_of_block, error)
        call second%own_part(1, error)
        call assertTrue(allocated(error), "the second")
        if (allocated(error)) call assertTrue(index(error%message, "at this moment") > 0, &
                                              error%message)
        call second%release()
        call first%remove()
    end subroutine one_writes_at_a_time

    subroutine files_of_other_images_are_read()
        !! A sweep of three images goes on with one; all files go in the end.
        type(sweep_store_t) :: store
        type(error_t), allocatable :: error
        character(:), allocatable :: path

        path = new_folder("store")//"/a.dat"
        call write_blocks(path, [4], 1)
        call write_blocks(path, [2, 1], 2)
        call write_blocks(path, [3], 3)
        call take(path, told, store, error)
        call assertFalse(allocated(error), "all files")
        call compare(store, [1, 2, 3, 4])
        call store%remove()
        call take(path, told, store, error)
        call assertEqual(0, int(store%there), "all are removed")
    end subroutine files_of_other_images_are_read

    subroutine a_resumed_sweep_is_the_same()
        !! Cut in the middle of its third block or so, a sweep goes on to the same numbers.
        character(*), parameter :: scene = "&scene system='pendulum', method='gauss16', "// &
            "tolerance=1e-10, duration=3, samples=10, q=1 /"
        type(sweep_t) :: sweep
        type(sweep_numbers_t) :: expected
        type(sweep_result_t) :: result
        type(error_t), allocatable :: error
        class(observer_t), pointer :: nobody
        class(system_t), allocatable :: system
        type(scene_t) :: read_scene
        type(word_t) :: none(0)
        character(:), allocatable :: path, text
        real(dp), allocatable :: values(:, :)
        integer(i8) :: block

        nullify (nobody)
        call parse_scene(scene, "text", none, read_scene, system, error)
        call new_sweep(sweep, read_scene, system, ["l=-0.2:2:23"], ["theta"], 1, 0.0_dp, error)
        call assertFalse(allocated(error), "a sweep")
        call compute_numbers(sweep, 2, expected, error)
        path = new_folder("store")//"/a.dat"
        call compute_grid(sweep, 2, nobody, result, error, path, told, .true.)
        call assertTrue(allocated(error), "nothing to resume")
        call compute_grid(sweep, 2, nobody, result, error, path, told, .false.)
        call assertFalse(allocated(error), "in a file")
        call result%store%release()
        call compute_grid(sweep, 2, nobody, result, error, path, told, .false.)
        call assertTrue(allocated(error), "not over what is there")
        if (allocated(error)) call assertTrue(index(error%message, "--resume") > 0, error%message)
        call read_whole_file(path//".part", text, error)
        call change(path//".part", len(text)/2, 0, " ")
        allocate (listener_t :: listener)
        call compute_grid(sweep, 3, listener, result, error, path, told, .true.)
        call assertFalse(allocated(error), "resumed")
        select type (listener)
        type is (listener_t)
            call assertTrue(listener%done > 0, "it says how far it is")
            call assertEqual(listener%all, listener%done, "at the end all of what was left is done")
        end select
        deallocate (listener)
        call assertTrue(result%resumed > 5 .and. result%resumed < 18, "about a half was there")
        call assertEqual(expected%failures, int(result%failures), "as many fail")
        call assertTrue(allocated(result%reason), "and it is said why")
        do block = 1, result%store%blocks
            call result%read_block(sweep, block, values, error)
            call assertFalse(allocated(error), "read")
            associate (wanted => expected%values(:, result%store%first_of(block): &
                                                 result%store%last_of(block)))
                call assertTrue(all(transfer(values, [1_i8]) == transfer(wanted, [1_i8])), &
                                "bit by bit")
            end associate
        end do
        call assertTrue(any(ieee_is_nan(expected%values)), "rods of no length fail")
        call result%store%remove()
    end subroutine a_resumed_sweep_is_the_same

    subroutine blocks_are_not_too_many()
        !! The memory for them stays flat, a million of them at most, or about; and a block stays
        !! small where a trajectory has many numbers.
        type(sweep_t) :: sweep
        type(error_t), allocatable :: error
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(word_t) :: none(0)

        call parse_scene("&scene system='pendulum', method='rk4', dt=0.1, duration=3, q=1 / "// &
                         "&sweep points=1000000 /", "text", none, scene, system, error)
        call new_sweep(sweep, scene, system, ["q=0:1:1000000", "v=0:1:1000000"], ["theta"], 1, &
                       0.0_dp, error)
        call assertFalse(allocated(error), "a large one")
        call assertTrue(sweep%trajectories()/block_size(sweep) <= 1000000, "a million blocks")
        scene%sweep%strobe = "1"
        call new_sweep(sweep, scene, system, ["q=0:1:100", "v=0:1:100"], ["theta"], 1, 0.0_dp, &
                       error)
        call assertEqual(2, int(block_size(sweep)), "two million numbers")
    end subroutine blocks_are_not_too_many
end module test_sweep_store
