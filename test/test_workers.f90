module test_workers
    !! Work that is shared by processes: every piece once, and nobody is left when it ends.
    use, intrinsic :: iso_c_binding, only: c_int
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_c_library, only: c_exit, c_getpid, c_kill, c_waitpid
    use lagrangia_errors, only: error_t, fail, status_file, status_library
    use lagrangia_kinds, only: dp, i8
    use lagrangia_text, only: to_text
    use lagrangia_workers, only: share_work, work_t
    implicit none (type, external)
    private
    public :: workers_suite

    integer, parameter :: pieces = 200

    type, extends(work_t) :: squares_t
        !! The squares of the numbers from 1 to `pieces`, and who computed them.
        integer(i8) :: handed = 0        !! pieces that were taken
        integer(i8) :: killed = 0        !! the piece at which a worker kills itself
        integer(i8) :: ended = 0         !! the piece at which a worker ends
        integer(i8) :: refused = 0       !! the piece that cannot be kept
        integer :: answers(pieces) = 0   !! how often each came
        integer :: processes(pieces) = 0 !! who computed it
        real(dp) :: squares(pieces) = 0.0_dp
        integer :: lengths(pieces) = 0   !! of a text with the square in it
        integer :: length = 3            !! of the answers
        logical :: good(pieces) = .false. !! all of the answer came
    contains
        procedure :: next
        procedure :: compute
        procedure :: take
    end type squares_t

contains

    function workers_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("workers")
        call suite%addTest(TestMethod("every_piece_once", every_piece_once))
        call suite%addTest(TestMethod("nothing_to_do", nothing_to_do))
        call suite%addTest(TestMethod("long_answers_are_whole", long_answers_are_whole))
        call suite%addTest(TestMethod("a_killed_worker_is_an_error", a_killed_worker_is_an_error))
        call suite%addTest(TestMethod("what_cannot_be_kept_ends_all", what_cannot_be_kept_ends_all))
    end function workers_suite

    subroutine next(self, number)
        !! One after the other.
        class(squares_t), intent(inout) :: self
        integer(i8), intent(out) :: number

        number = 0
        if (self%handed == pieces) return
        self%handed = self%handed + 1
        number = self%handed
    end subroutine next

    subroutine compute(self, number, answer)
        !! The square, who computed it, and the length of a text.
        class(squares_t), intent(inout) :: self
        integer(i8), intent(in) :: number
        real(dp), allocatable, intent(out) :: answer(:)
        integer(c_int) :: status

        if (number == self%killed) status = c_kill(c_getpid(), 9_c_int)
        if (number == self%ended) call c_exit(7_c_int)
        allocate (answer(self%length), source=real(number, dp))
        answer(:3) = [real(number, dp)**2, real(c_getpid(), dp), &
                  real(len("the square is "//to_text(number**2)//"!"), dp)]
    end subroutine compute

    subroutine take(self, number, answer, error)
        !! Into the lists.
        class(squares_t), intent(inout) :: self
        integer(i8), intent(in) :: number
        real(dp), intent(in) :: answer(:)
        type(error_t), allocatable, intent(out) :: error

        if (number == self%refused) then
            call fail(error, "no room", status_file)
            return
        end if
        self%answers(number) = self%answers(number) + 1
        self%squares(number) = answer(1)
        self%processes(number) = nint(answer(2))
        self%lengths(number) = nint(answer(3))
        self%good(number) = size(answer) == self%length .and. &
                            all(nint(answer(4:), i8) == number)
    end subroutine take

    subroutine every_piece_once()
        !! By this process alone, by a few, and by more than there are pieces.
        integer, parameter :: counts(*) = [1, 2, 7, 2*pieces]
        type(squares_t) :: work
        type(error_t), allocatable :: error
        integer :: i, k

        do i = 1, size(counts)
            work = squares_t()
            call share_work(work, counts(i), error)
            call assertFalse(allocated(error), "nothing fails")
            call assertTrue(all(work%answers == 1), "each once, by "//to_text(counts(i)))
            call assertEqual([(real(k, dp)**2, k=1, pieces)], work%squares, 0.0_dp, "squares")
            call assertEqual([(15 + len(to_text(k**2)), k=1, pieces)], work%lengths, "texts")
            call assertTrue(all(work%processes == int(c_getpid())) .eqv. counts(i) == 1, &
                            "by other processes where there may be several")
            call assertTrue(nobody_left(), "nobody is left")
        end do
    end subroutine every_piece_once

    subroutine nothing_to_do()
        !! No pieces at all.
        type(squares_t) :: work
        type(error_t), allocatable :: error

        work%handed = pieces
        call share_work(work, 3, error)
        call assertFalse(allocated(error), "nothing fails")
        call assertEqual(0, sum(work%answers), "nothing came")
    end subroutine nothing_to_do

    subroutine long_answers_are_whole()
        !! A million numbers, more than a pipe holds.
        type(squares_t) :: work
        type(error_t), allocatable :: error

        work%handed = pieces - 5
        work%length = 10**6
        call share_work(work, 2, error)
        call assertFalse(allocated(error), "nothing fails")
        call assertEqual(5, sum(work%answers), "the last five")
        call assertEqual(5, count(work%good), "they are whole")
    end subroutine long_answers_are_whole

    subroutine a_killed_worker_is_an_error()
        !! The others are ended too.
        type(squares_t) :: work
        type(error_t), allocatable :: error

        work%killed = 20
        call share_work(work, 3, error)
        call assertTrue(allocated(error), "killed")
        if (.not. allocated(error)) return
        call assertEqual("a process that computes has ended by signal 9", error%message)
        call assertEqual(status_library, error%status)
        call assertEqual(0, work%answers(20), "it has no answer")
        call assertTrue(nobody_left(), "nobody is left")
        work = squares_t(ended=20)
        call share_work(work, 3, error)
        call assertTrue(allocated(error), "ended")
        if (allocated(error)) call assertEqual("a process that computes has ended with status 7", &
                                               error%message)
        call assertTrue(nobody_left(), "nobody is left")
    end subroutine a_killed_worker_is_an_error

    subroutine what_cannot_be_kept_ends_all()
        !! In this process, and with others.
        type(squares_t) :: work
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, 3
            work = squares_t(refused=30)
            call share_work(work, i, error)
            call assertTrue(allocated(error), "no room")
            if (allocated(error)) call assertEqual("no room", error%message)
            call assertTrue(work%handed < pieces, "no more is computed")
            call assertEqual(0, work%answers(30), "it was not taken")
            call assertTrue(nobody_left(), "nobody is left")
        end do
    end subroutine what_cannot_be_kept_ends_all

    function nobody_left() result(yes)
        !! This process has no child.
        logical :: yes
        integer(c_int) :: status

        yes = c_waitpid(-1_c_int, status, 1_c_int) < 0
    end function nobody_left
end module test_workers
