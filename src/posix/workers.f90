module lagrangia_workers
    !! Pieces of work that are computed side by side, by processes: each is a copy of this one,
    !! hears through a pipe which piece is its next, and answers through another.
    !!
    !! Processes and not threads: gfortran (12, with every option) keeps the length of what a
    !! function of type `character(:), allocatable` returns in a static variable of the caller. Two
    !! threads that make a text in the same place, a message or a label, would write beyond its end.
    use, intrinsic :: iso_c_binding, only: c_associated, c_int, c_long, c_null_char, c_null_ptr, &
        c_ptr, c_short, c_size_t
    use lagrangia_c_library, only: c_close, c_exit, c_fclose, c_fdopen, c_fflush, c_fork, &
        c_fread_reals, c_fwrite_reals, c_getpid, c_getppid, c_kill, c_pipe, c_poll, c_setvbuf, &
        c_waitpid, poll_t
    use lagrangia_console, only: flush_console
    use lagrangia_errors, only: error_t, fail, status_library
    use lagrangia_interrupt, only: end_by_signals, interrupt_status
    use lagrangia_kinds, only: dp, i8
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: is_deserted, report_part, share_work, work_t

    integer(c_int), parameter :: sigkill = 9
    integer(c_int), parameter :: first_descriptor = 3, last_descriptor = 1023
    integer(c_short), parameter :: readable = 1_c_short  !! C's POLLIN
    integer(c_int), parameter :: wait_forever = -1

    integer(c_int), parameter :: unbuffered = 2  !! C's _IONBF
    real(dp), parameter :: interval = 0.5_dp     !! between two reports, s
    real(dp), parameter :: only_report = -1.0_dp !! in the place of an answer's length

    integer(c_int) :: parent = 0  !! of a worker: the process that it works for
    type(c_ptr) :: told = c_null_ptr             !! of a worker: C's `FILE *` for its answers
    integer(i8) :: last_report = 0               !! time on the system's clock

    type, abstract :: work_t
        !! Work in pieces with numbers.
    contains
        procedure(next_piece), deferred :: next
        procedure(compute_piece), deferred :: compute
        procedure(take_answer), deferred :: take
        procedure :: hear
    end type work_t

    class(work_t), pointer :: heard_by => null()  !! the work that this process does alone
    integer(i8) :: alone_at = 0                   !! the piece that it computes

    abstract interface
        subroutine next_piece(self, number)
            !! Which piece is to be computed next.
            import :: i8, work_t
            implicit none (type, external)
            class(work_t), intent(inout) :: self
            integer(i8), intent(out) :: number  !! from 1; 0: no more
        end subroutine next_piece

        subroutine compute_piece(self, number, answer)
            !! Compute a piece, in a process that shares nothing with others: all else is forgotten.
            import :: dp, i8, work_t
            implicit none (type, external)
            class(work_t), intent(inout) :: self
            integer(i8), intent(in) :: number             !! of the piece
            real(dp), allocatable, intent(out) :: answer(:)  !! what it gave
        end subroutine compute_piece

        subroutine take_answer(self, number, answer, error)
            !! Keep what a piece gave; in the process that began.
            import :: dp, error_t, i8, work_t
            implicit none (type, external)
            class(work_t), intent(inout) :: self
            integer(i8), intent(in) :: number   !! of the piece
            real(dp), intent(in) :: answer(:)   !! as `compute` has it
            type(error_t), allocatable, intent(out) :: error  !! then no more is computed
        end subroutine take_answer
    end interface

    type :: worker_t
        !! A process, seen from the one that began.
        integer(c_int) :: pid = 0
        type(c_ptr) :: orders = c_null_ptr   !! C's `FILE *`, to write numbers of pieces
        type(c_ptr) :: answers = c_null_ptr  !! to read the answers
        integer(c_int) :: descriptor = -1    !! of `answers`
        integer(i8) :: number = 0            !! the piece that it computes; 0: none
    end type worker_t

contains

    subroutine share_work(work, most, error, used)
        !! Compute all pieces, each as soon as a process is free. Where the system allows no other
        !! process, this one computes them.
        class(work_t), intent(inout), target :: work  !! hands out pieces, takes what they give
        integer, intent(in) :: most  !! processes that compute at a time, at least 1
        type(error_t), allocatable, intent(out) :: error
        !! interrupted; what `take` says; a process ended before its answer was whole
        integer, intent(out), optional :: used  !! processes that computed: no more than pieces
        type(worker_t), allocatable :: workers(:)
        integer(i8) :: number
        integer :: count

        allocate (workers(most))
        count = 0
        call work%next(number)
        if (most > 1) then
            do while (number > 0 .and. count < most)
                call start(work, workers(:count + 1))
                if (workers(count + 1)%pid <= 0) exit
                count = count + 1
                call order(workers(count), number)
                call work%next(number)
            end do
        end if
        if (present(used)) used = max(1, count)
        if (count == 0) call work_alone(work, number, error)
        do while (any(workers(:count)%number > 0))
            call take_answers(work, workers(:count), number, error)
            if (interrupt_status() /= 0) call fail(error, "interrupted", interrupt_status())
            if (allocated(error)) exit
        end do
        call finish(workers(:count), allocated(error))
    end subroutine share_work

    subroutine work_alone(work, first, error)
        !! In this process.
        class(work_t), intent(inout), target :: work
        integer(i8), intent(in) :: first
        type(error_t), allocatable, intent(out) :: error
        real(dp), allocatable :: answer(:)
        integer(i8) :: number

        number = first
        heard_by => work
        do while (number > 0 .and. .not. allocated(error))
            alone_at = number
            call work%compute(number, answer)
            if (interrupt_status() /= 0) exit  ! the answer is not whole
            call work%take(number, answer, error)
            call work%next(number)
        end do
        nullify (heard_by)
        if (interrupt_status() /= 0) call fail(error, "interrupted", interrupt_status())
    end subroutine work_alone

    subroutine hear(self, number, part)
        !! How far the work on a piece is; most don't care.
        class(work_t), intent(inout) :: self
        integer(i8), intent(in) :: number  !! of the piece
        real(dp), intent(in) :: part       !! of it that is done, from 0 to 1
    end subroutine hear

    subroutine report_part(part)
        !! From inside `compute`: `hear` is told, twice a second at most, how far it is. Elsewhere
        !! nobody is.
        real(dp), intent(in) :: part  !! of the piece that is done, from 0 to 1
        integer(i8) :: now, rate

        if (.not. (associated(heard_by) .or. c_associated(told))) return
        call system_clock(now, rate)
        if (real(now - last_report, dp) < interval*rate) return
        last_report = now
        if (c_associated(told)) then
            if (.not. sent(told, [only_report, part])) return
        else
            call heard_by%hear(alone_at, part)
        end if
    end subroutine report_part

    subroutine take_answers(work, workers, next, error)
        !! Wait until a worker has an answer, take those that there are, and give new orders.
        class(work_t), intent(inout) :: work
        type(worker_t), intent(inout) :: workers(:)
        integer(i8), intent(inout) :: next  !! the piece that is next
        type(error_t), allocatable, intent(out) :: error
        type(poll_t) :: polled(size(workers))
        real(dp), allocatable :: answer(:)
        real(dp) :: part
        integer(i8) :: number
        integer :: i

        do i = 1, size(workers)
            polled(i)%descriptor = merge(workers(i)%descriptor, -1_c_int, workers(i)%number > 0)
            polled(i)%events = readable
        end do
        if (c_poll(polled, size(polled, kind=c_long), wait_forever) < 0) return  ! by a signal
        do i = 1, size(workers)
            if (polled(i)%happened == 0) cycle
            number = workers(i)%number
            call read_answer(workers(i), answer, part, error)
            if (allocated(error)) return
            if (.not. allocated(answer)) then
                call work%hear(number, part)
                cycle
            end if
            if (next > 0) call order(workers(i), next)
            call work%take(number, answer, error)
            if (allocated(error)) return
            if (next > 0) call work%next(next)
        end do
    end subroutine take_answers

    subroutine order(worker, number)
        !! A worker is to compute a piece. That it has ended is seen where its answer is read.
        type(worker_t), intent(inout) :: worker
        integer(i8), intent(in) :: number

        worker%number = number
        if (.not. sent(worker%orders, [real(number, dp)])) return
    end subroutine order

    subroutine read_answer(worker, answer, part, error)
        !! All of it, or how far the worker is: then there is no answer yet.
        type(worker_t), intent(inout) :: worker
        real(dp), allocatable, intent(out) :: answer(:)
        real(dp), intent(out) :: part  !! of the piece that is done
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: length(1), parts(1)
        logical :: whole

        part = 0.0_dp
        whole = received(worker%answers, length)
        if (whole .and. length(1) < 0.0_dp) then
            whole = received(worker%answers, parts)
            part = parts(1)
        else if (whole) then
            worker%number = 0
            allocate (answer(nint(length(1), i8)))
            whole = received(worker%answers, answer)
        end if
        if (.not. whole) call fail(error, "a process that computes has ended"//how(worker), &
                                   status_library)
    end subroutine read_answer

    function how(worker) result(text)
        !! How it ended.
        type(worker_t), intent(inout) :: worker
        character(:), allocatable :: text
        integer(c_int) :: code, pid

        text = ""
        pid = c_waitpid(worker%pid, code, 0_c_int)
        if (pid /= worker%pid) return
        worker%pid = 0
        if (ibits(code, 0, 7) /= 0) then
            text = " by signal "//to_text(int(ibits(code, 0, 7)))
        else
            text = " with status "//to_text(int(ibits(code, 8, 8)))
        end if
    end function how

    subroutine start(work, workers)
        !! The last of `workers`; where it cannot be, its number stays 0.
        class(work_t), intent(inout) :: work
        type(worker_t), intent(inout) :: workers(:)
        integer(c_int) :: answers(2), myself, orders(2), status

        if (c_pipe(orders) /= 0) return
        if (c_pipe(answers) /= 0) then
            status = c_close(orders(1)) + c_close(orders(2))
            return
        end if
        call flush_console()
        myself = c_getpid()
        associate (worker => workers(size(workers)))
            worker%pid = c_fork()
            if (worker%pid == 0) then
                parent = myself
                call serve(work, orders(1), answers(2))
            end if
            status = c_close(orders(1)) + c_close(answers(2))
            worker%orders = c_fdopen(orders(2), "w"//c_null_char)
            worker%answers = c_fdopen(answers(1), "r"//c_null_char)
            worker%descriptor = answers(1)
            ! What came with a report must stay where `poll` sees it.
            if (c_associated(worker%answers)) status = c_setvbuf(worker%answers, c_null_ptr, &
                                                                 unbuffered, 0_c_size_t)
            if (worker%pid < 0) call release(worker)
        end associate
    end subroutine start

    subroutine serve(work, orders, answers)
        !! The life of a worker. It does not come back. Files of the other process, which may be
        !! locked, are closed: they are not to outlive it here.
        class(work_t), intent(inout) :: work
        integer(c_int), intent(in) :: orders, answers  !! descriptors
        type(c_ptr) :: from, to
        real(dp), allocatable :: answer(:)
        real(dp) :: number(1)
        integer(c_int) :: i, status

        call end_by_signals()
        do i = first_descriptor, max(last_descriptor, orders, answers)
            if (i /= orders .and. i /= answers) status = c_close(i)
        end do
        from = c_fdopen(orders, "r"//c_null_char)
        to = c_fdopen(answers, "w"//c_null_char)
        told = to
        call system_clock(last_report)
        do while (received(from, number))
            call work%compute(nint(number(1), i8), answer)
            if (is_deserted()) exit
            if (.not. sent(to, [real(size(answer, kind=i8), dp), answer])) exit
        end do
        call c_exit(0_c_int)
    end subroutine serve

    function is_deserted() result(yes)
        !! This is a worker, and who began is no more: nobody waits for what it computes.
        logical :: yes

        yes = .false.
        if (parent > 0) yes = c_getppid() /= parent
    end function is_deserted

    subroutine finish(workers, at_once)
        !! No worker is left: who hears no more orders ends.
        type(worker_t), intent(inout) :: workers(:)
        logical, intent(in) :: at_once  !! they are not to complete what they compute
        integer(c_int) :: code, pid
        integer :: i

        do i = 1, size(workers)
            if (at_once .and. workers(i)%pid > 0) code = c_kill(workers(i)%pid, sigkill)
            call release(workers(i))
        end do
        do i = 1, size(workers)
            if (workers(i)%pid > 0) pid = c_waitpid(workers(i)%pid, code, 0_c_int)
        end do
    end subroutine finish

    subroutine release(worker)
        !! Close its pipes.
        type(worker_t), intent(inout) :: worker
        integer(c_int) :: status

        if (c_associated(worker%orders)) status = c_fclose(worker%orders)
        if (c_associated(worker%answers)) status = c_fclose(worker%answers)
        worker%orders = c_null_ptr
        worker%answers = c_null_ptr
    end subroutine release

    function sent(stream, values) result(good)
        !! Write numbers, and wait until they are on their way.
        type(c_ptr), intent(in) :: stream
        real(dp), intent(in) :: values(:)
        logical :: good

        good = c_associated(stream)
        if (good) good = c_fwrite_reals(values, 8_c_size_t, size(values, kind=c_size_t), stream) &
            == size(values)
        if (good) good = c_fflush(stream) == 0
    end function sent

    function received(stream, values) result(good)
        !! Read as many numbers as there are in `values`.
        type(c_ptr), intent(in) :: stream
        real(dp), intent(out) :: values(:)
        logical :: good

        good = c_associated(stream)
        if (good) good = c_fread_reals(values, 8_c_size_t, size(values, kind=c_size_t), stream) &
            == size(values)
    end function received
end module lagrangia_workers
