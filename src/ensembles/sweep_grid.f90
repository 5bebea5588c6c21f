module lagrangia_sweep_grid
    !! All trajectories of a sweep, on as many images and processes as there are: blocks of them are
    !! dealt to whoever is free, and each trajectory gives the same bytes whoever computes it.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_attractor, only: attractors_t
    use lagrangia_errors, only: error_t, fail, status_file, status_numbers
    use lagrangia_files, only: facts_t, look_at
    use lagrangia_images, only: all_agree, begin_dealing, deal, image_count, image_number
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_kept, only: keeps_attractor
    use lagrangia_kinds, only: dp, i8, lanes
    use lagrangia_lyapunov_lanes, only: compute_exponents
    use lagrangia_observer, only: observer_t
    use lagrangia_sweep, only: fits_lanes, follows_displacements, sweep_t
    use lagrangia_sweep_lanes, only: compute_lanes
    use lagrangia_sweep_remains, only: is_being_written, remove_if_empty
    use lagrangia_sweep_store, only: part_name, sweep_store_t
    use lagrangia_sweep_trajectory, only: compute_one
    use lagrangia_text, only: to_text
    use lagrangia_workers, only: is_deserted, share_work, work_t
!$  use omp_lib, only: omp_get_max_threads
    implicit none (type, external)
    private
    public :: block_size, compute_grid, most_threads, parts_a_trajectory, sweep_result_t, &
              thread_count

    integer, parameter :: most_threads = 10000
    integer, parameter :: parts_a_trajectory = 1000000000
    !! as which an observer hears of it: one of \(10^{12}\) steps tells something at once

    type :: sweep_result_t
        !! What a sweep gave. The numbers come block by block, each of them once and in order, by
        !! `read_block`; how far they range is known after that.
        type(sweep_store_t) :: store
        integer(i8) :: failures = 0              !! trajectories that failed
        character(:), allocatable :: reason      !! of the first of these; absent: none failed
        character(:), allocatable :: damage      !! of the file that was there; absent: none
        real(dp) :: seconds = 0.0_dp             !! on the clock
        integer :: processes = 1                 !! of this image, that computed
        integer(i8) :: resumed = 0               !! trajectories that were there already
        logical :: in_lanes = .false.            !! computed in the lanes of vector registers
        type(attractors_t) :: attractors         !! that were met, where they are kept
        integer(i8), allocatable, private :: found(:)                !! of each number that is kept
        real(dp), allocatable, private :: least(:), largest(:)
    contains
        procedure :: read_block
        procedure :: range_of
    end type sweep_result_t

    type, extends(work_t) :: blocks_t
        !! The blocks of a sweep as work that is shared.
        type(sweep_t), pointer :: sweep => null()
        type(sweep_result_t), pointer :: result => null()
        class(observer_t), pointer :: progress => null()
        integer(i8) :: done = 0  !! trajectories so far; of many images about
        integer(i8), allocatable :: begun(:)  !! blocks that are being computed, by what is heard
        real(dp), allocatable :: parts(:)     !! of each of them that is done
    contains
        procedure :: next => next_block
        procedure :: compute => compute_block
        procedure :: take => take_block
        procedure :: hear => hear_block
        procedure, private :: tell
    end type blocks_t

contains

    function thread_count(wanted) result(threads)
        !! How many processes there are to be: as `wanted`, or for 0 one for each processor; of
        !! many images each has one.
        integer, intent(in) :: wanted  !! not negative
        integer :: threads

        threads = 1
!$      if (image_count() == 1) threads = min(omp_get_max_threads(), most_threads)
        if (wanted > 0) threads = wanted
    end function thread_count

    function block_size(sweep) result(n)
        !! Trajectories that a process takes at a time, and that a killed program loses at most: the
        !! same for any number of processes; few where there are few, or each has many numbers; more
        !! where there would be over a million blocks. Where trajectories in lanes end at different
        !! times, as at a flip, a block of eight leaves lanes empty; so these blocks are larger.
        type(sweep_t), intent(in) :: sweep  !! as `new_sweep` made it
        integer(i8) :: n
        integer(i8), parameter :: usual = 64, most_blocks = 1000000, most_numbers = 2000000
        integer(i8) :: wanted  ! blocks, at least

        wanted = 64
        if (fits_lanes(sweep) .and. .not. follows_displacements(sweep)) wanted = 16
        n = min(usual, max(1_i8, sweep%trajectories()/wanted))
        if (fits_lanes(sweep)) n = lanes*((n + lanes - 1)/lanes)
        n = max(n, usual*(sweep%trajectories()/(usual*most_blocks)))
        n = min(n, max(1_i8, most_numbers/sweep%width()))
    end function block_size

    subroutine compute_grid(sweep, threads, progress, result, error, path, told, resume)
        !! Compute every trajectory. One that fails leaves NaN, and the others go on. To be called
        !! on all images; image 1 has the result.
        type(sweep_t), intent(in), target :: sweep               !! as `new_sweep` made it
        integer, intent(in) :: threads                           !! processes of this image, at most
        class(observer_t), pointer, intent(in) :: progress       !! hears how far it is; may be null
        type(sweep_result_t), intent(out), target :: result      !! the numbers, and what they took
        type(error_t), allocatable, intent(out) :: error
        !! interrupted; no memory; a file; all trajectories fail, then for the first one's reason;
        !! without a message where another image has one
        character(*), intent(in), optional :: path  !! of the data file: blocks wait beside it
        character(*), intent(in), optional :: told  !! what makes one sweep another
        logical, intent(in), optional :: resume     !! go on with the blocks that are there
        type(blocks_t) :: blocks
        integer(i8) :: finish, rate, start, total

        total = sweep%trajectories()
        result%in_lanes = fits_lanes(sweep)
        allocate (result%found(size(sweep%kept)), source=0_i8)
        allocate (result%least(size(sweep%kept)), source=huge(1.0_dp))
        allocate (result%largest(size(sweep%kept)), source=-huge(1.0_dp))
        if (present(path)) then
            call result%store%prepare(path, told, sweep%width(), total, block_size(sweep), error)
            if (.not. allocated(error)) call open_parts(path, resume, result%store, error)
        else
            call result%store%prepare("", "", sweep%width(), total, block_size(sweep), error)
        end if
        call agree(error)
        if (allocated(error)) return
        result%resumed = result%store%trajectories_there()
        associate (store => result%store)
            if (allocated(store%damage)) result%damage = store%damage//": "// &
                to_text(store%there)//" sound blocks are kept, the other "// &
                to_text(store%blocks - store%there)//" computed again"
        end associate
        call system_clock(start, rate)
        blocks%sweep => sweep
        blocks%result => result
        blocks%progress => progress
        allocate (blocks%begun(0), blocks%parts(0))
        call begin_dealing()
        call share_work(blocks, threads, error, result%processes)
        call agree(error)
        if (.not. allocated(error) .and. image_count() > 1) then
            if (image_number() == 1) call result%store%take_parts(error)
            call agree(error)
        end if
        call system_clock(finish)
        result%seconds = real(finish - start, dp)/real(rate, dp)
        result%failures = result%store%failures
        if (allocated(error) .or. image_number() > 1 .or. result%failures == 0) return
        call explain(sweep, result, error)
    end subroutine compute_grid

    subroutine agree(error)
        !! Where an image has failed, all have; who did not has no message.
        type(error_t), allocatable, intent(inout) :: error

        if (all_agree(.not. allocated(error))) return
        if (.not. allocated(error)) call fail(error, "", status_file)
    end subroutine agree

    subroutine open_parts(path, resume, store, error)
        !! The files in which blocks are kept: this image's own, and those that are there.
        character(*), intent(in) :: path
        logical, intent(in) :: resume
        type(sweep_store_t), intent(inout) :: store
        type(error_t), allocatable, intent(out) :: error
        type(facts_t) :: facts
        integer :: image

        image = image_number()
        if (.not. resume) call remove_if_empty(part_name(path, image))
        facts = look_at(part_name(path, image))
        if (is_being_written(part_name(path, image))) then
            call fail(error, "another sweep is writing '"//part_name(path, image)// &
                      "' at this moment", status_file)
        else if (facts%found .and. .not. facts%regular) then
            call fail(error, "'"//part_name(path, image)//"' is not a file that a sweep has "// &
                      "written", status_file)
        else if (facts%found .and. .not. resume) then
            call store%take_parts(error)  ! another sweep's cannot be resumed
            store%there = 0
            if (.not. allocated(error)) call fail(error, "'"//part_name(path, image)//"' is "// &
                "what an interrupted sweep has computed: '--resume' goes on with it; remove it "// &
                "to begin anew", status_file)
        else if (resume .and. image == 1 .and. .not. facts%found) then
            call fail(error, "there is nothing to resume: no file '"//part_name(path, image)//"'", &
                      status_file)
        end if
        call agree(error)
        if (resume .and. .not. allocated(error)) call store%take_parts(error)
        call agree(error)
        if (.not. allocated(error)) call store%own_part(image, error)
        if (allocated(error)) call store%release()
    end subroutine open_parts

    subroutine next_block(self, number)
        !! One that is not there yet, and that no other image takes.
        class(blocks_t), intent(inout) :: self
        integer(i8), intent(out) :: number  !! from 1, or 0 where there are no more

        do
            call deal(number)
            if (number > self%result%store%blocks) number = 0
            if (number == 0) return
            if (image_count() > 1) self%done = self%result%store%last_of(number) - &
                                               self%result%resumed
            if (.not. self%result%store%has(number)) return
        end do
    end subroutine next_block

    subroutine compute_block(self, number, answer)
        !! The trajectories of one block.
        class(blocks_t), intent(inout) :: self
        integer(i8), intent(in) :: number  !! from 1
        real(dp), allocatable, intent(out) :: answer(:)
        !! how many failed, number of the first of these or 0, and all that is kept, in order
        real(dp), allocatable :: values(:, :)
        type(error_t), allocatable :: failure
        integer(i8) :: failures, first, first_failed, i, last

        first = self%result%store%first_of(number)
        last = self%result%store%last_of(number)
        allocate (values(self%sweep%width(), last - first + 1))
        failures = 0
        first_failed = huge(first_failed)
        if (follows_displacements(self%sweep)) then
            call compute_exponents(self%sweep, first, last, values, failures, first_failed)
        else if (self%result%in_lanes) then
            call compute_lanes(self%sweep, first, last, values, failures, first_failed)
        else
            do i = first, last
                if (interrupt_status() /= 0) exit
                if (is_deserted()) exit
                call compute_one(self%sweep, i, values(:, i - first + 1), failure, &
                                 real([i - first, i - first + 1], dp)/real(last - first + 1, dp))
                if (.not. allocated(failure)) cycle
                failures = failures + 1
                first_failed = min(first_failed, i)
            end do
        end if
        if (failures == 0) first_failed = 0
        allocate (answer(2 + size(values)))
        answer(:2) = real([failures, first_failed], dp)
        answer(3:) = reshape(values, [size(values)])
    end subroutine compute_block

    subroutine take_block(self, number, answer, error)
        !! It goes into the store.
        class(blocks_t), intent(inout) :: self
        integer(i8), intent(in) :: number  !! from 1
        real(dp), intent(in) :: answer(:)  !! as `compute_block` has it
        type(error_t), allocatable, intent(out) :: error  !! it cannot be kept
        integer(i8) :: first_failed, n

        n = self%result%store%last_of(number) - self%result%store%first_of(number) + 1
        first_failed = nint(answer(2), i8)
        if (first_failed == 0) first_failed = huge(first_failed)
        call self%result%store%put(number, reshape(answer(3:), [self%sweep%width(), int(n)]), &
                                   nint(answer(1), i8), first_failed, error)
        if (image_count() == 1) self%done = self%done + n
        self%parts = pack(self%parts, self%begun /= number)
        self%begun = pack(self%begun, self%begun /= number)
        call self%tell()
    end subroutine take_block

    subroutine hear_block(self, number, part)
        !! How far a block is.
        class(blocks_t), intent(inout) :: self
        integer(i8), intent(in) :: number  !! from 1
        real(dp), intent(in) :: part       !! from 0 to 1

        self%parts = [pack(self%parts, self%begun /= number), part]
        self%begun = [pack(self%begun, self%begun /= number), number]
        call self%tell()
    end subroutine hear_block

    subroutine tell(self)
        !! How far it all is, in parts of a trajectory.
        class(blocks_t), intent(inout) :: self
        real(dp) :: all, done, finest

        if (.not. associated(self%progress)) return
        all = real(self%sweep%trajectories() - self%result%resumed, dp)
        done = real(self%done, dp) + sum(self%parts)*self%result%store%last_of(1_i8)
        finest = min(real(parts_a_trajectory, dp), 9e18_dp/all)
        call self%progress%tick(int(finest*min(done, all), i8), int(finest*all, i8))
    end subroutine tell

    subroutine explain(sweep, result, error)
        !! Why the first trajectory that failed did: it is computed again. Where all failed that is
        !! an error.
        type(sweep_t), intent(in) :: sweep
        type(sweep_result_t), intent(inout) :: result
        type(error_t), allocatable, intent(out) :: error
        type(error_t), allocatable :: failure
        real(dp) :: values(sweep%width())

        call compute_one(sweep, result%store%first_failed, values, failure)
        if (.not. allocated(failure)) call fail(failure, "the motion diverges, or the step is "// &
                                                "too long", status_numbers)
        result%reason = failure%message
        if (result%failures < sweep%trajectories()) return
        if (result%failures > 1) failure%message = "all "//to_text(result%failures)// &
                                                   " trajectories fail: "//failure%message
        call move_alloc(failure, error)
    end subroutine explain

    subroutine read_block(self, sweep, block, values, error)
        !! The numbers of a block, those of attractors among them. The blocks are to be read in
        !! order, each once: attractors are numbered as they come.
        class(sweep_result_t), intent(inout) :: self
        type(sweep_t), intent(in) :: sweep                !! the one that was computed
        integer(i8), intent(in) :: block                  !! from 1 to `store%blocks`
        real(dp), allocatable, intent(inout) :: values(:, :)
        !! (`sweep%width()`, trajectories of the block)
        type(error_t), allocatable, intent(out) :: error  !! it cannot be read
        integer(i8) :: n
        integer :: i, k, kept

        kept = size(sweep%kept)
        n = self%store%last_of(block) - self%store%first_of(block) + 1
        if (allocated(values)) then
            if (size(values, 2, kind=i8) /= n) deallocate (values)
        end if
        if (.not. allocated(values)) allocate (values(sweep%width(), n))
        call self%store%get(block, values, error)
        if (allocated(error)) return
        do i = 1, int(n)
            if (sweep%attractors) then
                where (sweep%kept%kind == keeps_attractor) values(:kept, i) = &
                    self%attractors%number_of(values(kept + 1:, i))
            end if
            do k = 1, kept*sweep%points
                call look(modulo(k - 1, kept) + 1, values(k, i))
            end do
        end do
    contains
        subroutine look(which, value)
            !! At a number that is kept.
            integer, intent(in) :: which
            real(dp), intent(in) :: value

            if (.not. ieee_is_finite(value)) return
            self%found(which) = self%found(which) + 1
            self%least(which) = min(self%least(which), value)
            self%largest(which) = max(self%largest(which), value)
        end subroutine look
    end subroutine read_block

    pure subroutine range_of(self, which, found, least, largest)
        !! How many trajectories, or points, have a number that is kept, and between what bounds;
        !! of the blocks that have been read.
        class(sweep_result_t), intent(in) :: self
        integer, intent(in) :: which             !! of those that are kept
        integer(i8), intent(out) :: found        !! trajectories or points
        real(dp), intent(out) :: least, largest  !! huge and -huge where there are none

        found = self%found(which)
        least = self%least(which)
        largest = self%largest(which)
    end subroutine range_of
end module lagrangia_sweep_grid
