module lagrangia_sweep_grid
    !! All trajectories of a sweep, on as many threads as are wanted: blocks of them are dealt out
    !! as threads get free, and each trajectory gives the same bytes whoever computes it.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_attractor, only: attractors_t
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_kept, only: keeps_attractor
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_sweep, only: sweep_t
    use lagrangia_sweep_lanes, only: compute_lanes, fits_lanes
    use lagrangia_sweep_trajectory, only: compute_one
    use lagrangia_text, only: to_text
!$  use omp_lib, only: omp_get_max_threads
    implicit none (type, external)
    private
    public :: compute_grid, sweep_result_t, thread_count

    integer(i8), parameter :: largest_block = 64  !! trajectories that a thread takes at a time

    type :: sweep_result_t
        !! What a sweep gave.
        real(dp), allocatable :: values(:, :)
        !! (`sweep%width()`, trajectories); NaN: failed, or not there
        integer :: kept = 0                      !! numbers of a row
        integer :: points = 1                    !! rows of a trajectory at most
        integer(i8) :: failures = 0              !! trajectories that failed
        character(:), allocatable :: reason      !! of the first of these; absent: none failed
        real(dp) :: seconds = 0.0_dp             !! on the clock
        logical :: in_lanes = .false.            !! computed in the lanes of vector registers
    contains
        procedure :: range_of
    end type sweep_result_t

contains

    function thread_count(wanted) result(threads)
        !! How many threads there are to be: as `wanted`, or for 0 one for each processor.
        integer, intent(in) :: wanted  !! not negative
        integer :: threads

        threads = 1
!$      threads = omp_get_max_threads()
        if (wanted > 0) threads = wanted
    end function thread_count

    subroutine compute_grid(sweep, threads, progress, result, error)
        !! Compute every trajectory. One that fails leaves NaN, and the others go on.
        type(sweep_t), intent(in) :: sweep                       !! as `new_sweep` made it
        integer, intent(in) :: threads                           !! at least 1
        class(observer_t), pointer, intent(in) :: progress       !! hears how far it is; may be null
        type(sweep_result_t), intent(out) :: result              !! the numbers, and what they took
        type(error_t), allocatable, intent(out) :: error
        !! interrupted; no memory; or all trajectories fail, then for the first one's reason
        integer(i8) :: blocks, done, first_failed, finish, k, rate, size_of_block, start, total
        type(error_t), allocatable :: first_error
        integer :: status

        total = sweep%trajectories()
        allocate (result%values(sweep%width(), total), stat=status)
        if (status /= 0) then
            call fail(error, to_text(total)//" trajectories are more than fit into the memory")
            return
        end if
        result%kept = size(sweep%kept)
        result%points = sweep%points
        result%in_lanes = fits_lanes(sweep)
        size_of_block = block_size(total, result%in_lanes)
        blocks = (total + size_of_block - 1)/size_of_block
        done = 0
        first_failed = huge(first_failed)
        call system_clock(start, rate)
        !$omp parallel do schedule(dynamic) num_threads(threads) default(none) private(k) &
        !$omp shared(sweep, result, blocks, size_of_block, total, done, first_failed, first_error, &
        !$omp progress)
        do k = 1, blocks
            if (interrupt_status() == 0) call compute_block(sweep, result, k, size_of_block, &
                                                            total, progress, done, &
                                                            first_failed, first_error)
        end do
        !$omp end parallel do
        call system_clock(finish)
        result%seconds = real(finish - start, dp)/real(rate, dp)
        if (sweep%attractors) call number_attractors(sweep, result)
        if (interrupt_status() /= 0) then
            call fail(error, "interrupted", interrupt_status())
        else if (allocated(first_error)) then
            result%reason = first_error%message
            if (result%failures == total) call move_alloc(first_error, error)
        else if (result%failures == total) then
            call fail(error, "every trajectory diverges, or the step is too long", status_numbers)
        end if
    end subroutine compute_grid

    pure function block_size(total, in_lanes) result(n)
        !! Trajectories that a thread takes at a time: the same for any number of threads, and few
        !! where there are few.
        integer(i8), intent(in) :: total   !! trajectories
        logical, intent(in) :: in_lanes    !! where eight of them fill a vector
        integer(i8) :: n

        n = largest_block
        if (.not. in_lanes) n = min(n, max(1_i8, total/largest_block))
    end function block_size

    subroutine number_attractors(sweep, result)
        !! Each trajectory's, in the order of the trajectories, whoever computed them.
        type(sweep_t), intent(in) :: sweep
        type(sweep_result_t), intent(inout) :: result
        type(attractors_t) :: attractors
        real(dp) :: number
        integer(i8) :: i

        do i = 1, size(result%values, 2, kind=i8)
            number = attractors%number_of(result%values(result%kept + 1:, i))
            where (sweep%kept%kind == keeps_attractor) result%values(:result%kept, i) = number
        end do
    end subroutine number_attractors

    pure subroutine range_of(self, which, found, least, largest)
        !! How many trajectories, or points, have a number that is kept, and between what bounds.
        class(sweep_result_t), intent(in) :: self
        integer, intent(in) :: which             !! of those that are kept
        integer(i8), intent(out) :: found        !! trajectories or points
        real(dp), intent(out) :: least, largest  !! huge and -huge where there are none
        integer(i8) :: i
        integer :: k

        found = 0
        least = huge(least)
        largest = -huge(largest)
        do i = 1, size(self%values, 2, kind=i8)
            do k = which, which + (self%points - 1)*self%kept, self%kept
                if (.not. ieee_is_finite(self%values(k, i))) cycle
                found = found + 1
                least = min(least, self%values(k, i))
                largest = max(largest, self%values(k, i))
            end do
        end do
    end subroutine range_of

    subroutine compute_block(sweep, result, block, size_of_block, total, progress, done, &
                             first_failed, first_error)
        !! Compute the trajectories of one block, on one thread.
        type(sweep_t), intent(in) :: sweep
        type(sweep_result_t), intent(inout) :: result  !! gets their numbers
        integer(i8), intent(in) :: block, total        !! number of the block; of trajectories
        integer(i8), intent(in) :: size_of_block       !! of each block but the last
        class(observer_t), pointer, intent(in) :: progress
        integer(i8), intent(inout) :: done             !! trajectories so far
        integer(i8), intent(inout) :: first_failed     !! number of the first that failed
        type(error_t), allocatable, intent(inout) :: first_error  !! why it did
        real(dp), allocatable :: values(:, :)
        type(error_t), allocatable :: error, kept_error
        integer(i8) :: failed, failures, first, i, last

        allocate (values(sweep%width(), size_of_block))
        first = (block - 1)*size_of_block + 1
        last = min(total, first + size_of_block - 1)
        failures = 0
        failed = huge(failed)
        if (result%in_lanes) then
            call compute_lanes(sweep, first, last, values(:, :last - first + 1), failures)
        else
            do i = first, last
                call compute_one(sweep, i, values(:, i - first + 1), error)
                if (.not. allocated(error)) cycle
                failures = failures + 1
                if (allocated(kept_error)) cycle
                failed = i
                call move_alloc(error, kept_error)
            end do
        end if
        !$omp critical (lagrangia_sweep_block)
        result%values(:, first:last) = values(:, :last - first + 1)
        result%failures = result%failures + failures
        if (failed < first_failed) then
            first_failed = failed
            call move_alloc(kept_error, first_error)
        end if
        done = done + last - first + 1
        if (associated(progress)) call progress%tick(done, total)
        !$omp end critical (lagrangia_sweep_block)
    end subroutine compute_block
end module lagrangia_sweep_grid
