module test_slow_sweeps
    !! Sweeps whose trajectories take long: how far they are is told while they are computed, their
    !! steps can be limited, steps that are too long are seen before, and few cells are many blocks.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_files, only: facts_t, look_at
    use lagrangia_kinds, only: dp, i8
    use lagrangia_sweep, only: fits_lanes, sweep_t
    use lagrangia_sweep_grid, only: block_size
    use lagrangia_sweep_remains, only: is_being_written, remove_if_empty
    use lagrangia_sweep_store, only: sweep_store_t
    use lagrangia_sweep_warning, only: corner_warning
    use lagrangia_text, only: to_text
    use lagrangia_workers, only: report_part, share_work, work_t
    use sweep_numbers, only: compute_numbers, make => make_sweep, sweep_numbers_t
    use test_scratch, only: new_folder
    implicit none (type, external)
    private
    public :: slow_sweeps_suite

    character(*), parameter :: pendulum = "&scene system = 'pendulum', q = 1, duration = 20, "
    character(*), parameter :: limited = " / &sweep most_steps = 1000 /"

    type, extends(work_t) :: slow_t
        !! Pieces that take longer than the time between two reports.
        integer(i8) :: handed = 0
        integer :: taken = 0
        logical :: heard(3) = .false.  !! of each piece, and rightly
        logical :: wrong = .false.     !! a part that was not told
    contains
        procedure :: next
        procedure :: compute
        procedure :: take
        procedure :: hear
    end type slow_t

contains

    function slow_sweeps_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("slow_sweeps")
        call suite%addTest(TestMethod("parts_are_heard", parts_are_heard))
        call suite%addTest(TestMethod("steps_are_limited", steps_are_limited))
        call suite%addTest(TestMethod("steps_that_are_too_long_are_seen", &
                                      steps_that_are_too_long_are_seen))
        call suite%addTest(TestMethod("few_cells_are_many_blocks", few_cells_are_many_blocks))
        call suite%addTest(TestMethod("a_file_without_blocks_is_in_nobodys_way", &
                                      a_file_without_blocks_is_in_nobodys_way))
    end function slow_sweeps_suite

    subroutine next(self, number)
        !! Three pieces.
        class(slow_t), intent(inout) :: self
        integer(i8), intent(out) :: number

        self%handed = self%handed + 1
        number = merge(self%handed, 0_i8, self%handed <= 3)
    end subroutine next

    subroutine compute(self, number, answer)
        !! Reports all the time that it is half done, and long after the first of them was sent.
        class(slow_t), intent(inout) :: self
        integer(i8), intent(in) :: number
        real(dp), allocatable, intent(out) :: answer(:)
        integer(i8) :: now, rate, start

        call system_clock(start, rate)
        now = start
        do while (now - start < rate)
            call report_part(0.5_dp)
            call system_clock(now)
        end do
        allocate (answer(100000), source=real(number, dp))
    end subroutine compute

    subroutine take(self, number, answer, error)
        !! Whole.
        class(slow_t), intent(inout) :: self
        integer(i8), intent(in) :: number
        real(dp), intent(in) :: answer(:)
        type(error_t), allocatable, intent(out) :: error

        if (size(answer) == 100000 .and. all(nint(answer) == number)) self%taken = self%taken + 1
    end subroutine take

    subroutine hear(self, number, part)
        !! How far a piece is.
        class(slow_t), intent(inout) :: self
        integer(i8), intent(in) :: number
        real(dp), intent(in) :: part

        self%heard(number) = .true.
        self%wrong = self%wrong .or. abs(part - 0.5_dp) > 0.0_dp
    end subroutine hear

    subroutine parts_are_heard()
        !! Of a piece that is computed here, and by other processes; the answers stay whole.
        type(slow_t) :: work
        type(error_t), allocatable :: error
        integer :: processes

        do processes = 1, 3, 2
            work = slow_t()
            call share_work(work, processes, error)
            call assertFalse(allocated(error), "nothing fails")
            call assertEqual(3, work%taken, "answers")
            call assertTrue(all(work%heard), "each is heard of, by "//to_text(processes))
            call assertFalse(work%wrong, "what was told")
        end do
        call report_part(0.5_dp)  ! nobody is told
    end subroutine parts_are_heard

    subroutine steps_are_limited()
        !! By `dop853` in lanes and alone, by `gauss16`, with and without displacements: who needs
        !! more steps is NaN, the others are what they were.
        integer :: alone, failed

        call compare("method = 'dop853', tolerance = 1e-9", "theta", .true., failed)
        call compare("method = 'dop853', tolerance = 1e-9", "period", .false., alone)
        call assertEqual(alone, failed, "in lanes as alone")
        call compare("method = 'gauss16', tolerance = 1e-9", "theta", .false., failed)
        call compare("method = 'dop853', tolerance = 1e-9", "lyapunov", .true., failed)
        call assertEqual(alone, failed, "with displacements")
        call compare("method = 'gauss16', tolerance = 1e-9", "lyapunov", .false., failed)
    end subroutine steps_are_limited

    subroutine compare(method, keep, in_lanes, failed)
        !! The short ones of twelve pendulums swing too often.
        character(*), intent(in) :: method, keep
        logical, intent(in) :: in_lanes
        integer, intent(out) :: failed  !! so many
        type(sweep_t) :: sweep
        type(sweep_numbers_t) :: all_of_them, some
        type(error_t), allocatable :: error
        integer :: k

        call make(pendulum//method//" /", ["l=1e-4:1:12:log"], [keep], sweep)
        call compute_numbers(sweep, 1, all_of_them, error)
        call assertFalse(allocated(error), "without a limit")
        call make(pendulum//method//limited, ["l=1e-4:1:12:log"], [keep], sweep)
        call assertTrue(fits_lanes(sweep) .eqv. in_lanes, "lanes: "//keep)
        call compute_numbers(sweep, 1, some, error)
        call assertFalse(allocated(error), "with a limit")
        failed = some%failures
        if (allocated(error)) return
        call assertTrue(some%failures > 2 .and. some%failures < 12, keep//" by "//method)
        call assertEqual(1, index(some%reason, "more than 1000 steps, at t = "), some%reason)
        do k = 1, 12
            if (k <= some%failures) then
                call assertTrue(ieee_is_nan(some%values(1, k)), "too many steps")
            else
                call assertEqual(all_of_them%values(1, k), some%values(1, k), 0.0_dp, "as before")
            end if
        end do
    end subroutine compare

    subroutine steps_that_are_too_long_are_seen()
        !! At the corner of the grid where the pendulum is shortest: omega = sqrt(9.81/0.0001).
        character(*), parameter :: fixed = "method = 'rk4', dt = 0.01 /"
        type(sweep_t) :: sweep

        call make(pendulum//fixed, ["l=1:1e-4:5    ", "theta=-1:1:4  "], ["theta"], sweep)
        call assertEqual("l = 0.0001: dt = 0.01 s exceeds the step limit 0.00903 s of rk4 "// &
                         "(2.828/omega_max, omega_max = 313.2 rad/s): small oscillations would "// &
                         "grow at every step", corner_warning(sweep))
        call make(pendulum//fixed, ["m=1:2:5       ", "l=1e-3:1:9:log"], ["theta"], sweep)
        call assertEqual("", corner_warning(sweep), "short enough")
        call make(pendulum//"method = 'rk4', dt = 1 /", ["theta=-1:1:4"], ["theta"], sweep)
        call assertEqual(1, index(corner_warning(sweep), "dt = 1.0 s exceeds"), "any start")
        call make(pendulum//"method = 'gauss16', tolerance = 1e-9 /", ["l=1e-9:1:5"], ["theta"], &
                  sweep)
        call assertEqual("", corner_warning(sweep), "it chooses its steps")
    end subroutine steps_that_are_too_long_are_seen

    subroutine few_cells_are_many_blocks()
        !! Of whole groups of lanes where there are lanes, so that no register is half empty.
        character(*), parameter :: lanes = "method = 'rk4', dt = 0.1 /"
        character(*), parameter :: alone = "method = 'gauss16', tolerance = 1e-9 /"

        call assertEqual(8, blocks_of(lanes, 8), "a register")
        call assertEqual(8, blocks_of(lanes, 64), "eight blocks")
        call assertEqual(32, blocks_of(lanes, 400), "thirteen")
        call assertEqual(64, blocks_of(lanes, 10000), "many")
        call assertEqual(1, blocks_of(alone, 64), "one trajectory each")
        call assertEqual(64, blocks_of(alone, 10000), "many")
    end subroutine few_cells_are_many_blocks

    function blocks_of(method, cells) result(n)
        !! Trajectories in a block.
        character(*), intent(in) :: method
        integer, intent(in) :: cells
        integer :: n
        type(sweep_t) :: sweep

        call make(pendulum//method, ["theta=-1:1:"//to_text(cells)], ["theta"], sweep)
        n = int(block_size(sweep))
    end function blocks_of

    subroutine a_file_without_blocks_is_in_nobodys_way()
        !! It is removed; one with a block stays, one that another sweep has open stays, and so does
        !! a file that no sweep has written.
        character(:), allocatable :: path
        type(sweep_store_t) :: other, store
        type(error_t), allocatable :: error
        integer :: unit

        path = new_folder("slow_sweeps")//"/a.dat"
        call store%prepare(path, "m = 1", 1, 2_i8, 1_i8, error)
        call store%own_part(1, error)
        call assertFalse(allocated(error), "begun")
        call remove_if_empty(path//".part")
        call assertTrue(exists(path//".part"), "it is being written")
        call assertTrue(is_being_written(path//".part"), "which others see")
        call other%prepare(path, "m = 1", 1, 2_i8, 1_i8, error)
        call other%take_parts(error)
        call other%own_part(1, error)
        call assertTrue(allocated(error), "only one writes")
        call other%remove()
        call assertTrue(exists(path//".part"), "it is not the other's to remove")
        call store%release()
        call assertFalse(is_being_written(path//".part"), "nor is it any more")
        call remove_if_empty(path//".part")
        call assertFalse(exists(path//".part"), "empty")
        store = sweep_store_t()
        call store%prepare(path, "m = 1", 1, 2_i8, 1_i8, error)
        call store%own_part(1, error)
        call store%put(1_i8, reshape([1.0_dp], [1, 1]), 0_i8, 9_i8, error)
        call assertFalse(allocated(error), "a block")
        call store%release()
        call remove_if_empty(path//".part")
        call assertTrue(exists(path//".part"), "a block is in it")
        open (newunit=unit, file=path//".part", status="replace", action="write")
        write (unit, "(ss, a)") "a letter"
        close (unit)
        call remove_if_empty(path//".part")
        call assertTrue(exists(path//".part"), "a letter")
    end subroutine a_file_without_blocks_is_in_nobodys_way

    function exists(path) result(yes)
        !! Something has this name.
        character(*), intent(in) :: path
        logical :: yes
        type(facts_t) :: facts

        facts = look_at(path)
        yes = facts%found
    end function exists
end module test_slow_sweeps
