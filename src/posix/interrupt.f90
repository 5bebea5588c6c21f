module lagrangia_interrupt
    !! Ctrl-C, `kill` and closed pipes: noticed at the next sample, or by force a second later, so
    !! that files can be removed and the exit status be right.
    use, intrinsic :: iso_c_binding, only: c_associated, c_funloc, c_funptr, c_int, c_intptr_t, &
        c_null_funptr
    use lagrangia_c_library, only: c_alarm, c_ending, c_kill, c_signal
    use lagrangia_errors, only: status_of_signal, status_ok
    implicit none (type, external)
    private
    public :: catch_interrupts, end_by_signals, interrupt_status, run_beside

    integer(c_int), parameter :: sighup = 1    !! these numbers are the same on every Unix
    integer(c_int), parameter :: sigint = 2
    integer(c_int), parameter :: sigquit = 3
    integer(c_int), parameter :: sigpipe = 13
    integer(c_int), parameter :: sigalrm = 14
    integer(c_int), parameter :: sigterm = 15
    integer(c_int), parameter :: sigxcpu = 24  !! except these two on MIPS
    integer(c_int), parameter :: sigxfsz = 25

    integer(c_int), parameter :: endings(*) = [sighup, sigint, sigquit, sigterm, sigxcpu]
    !! what asks a program to end: the terminal is gone, Ctrl-C, Ctrl-\, `kill`, `ulimit -t`;
    !! `c_ending` has the others, which nobody sends without having been asked to

    integer(c_intptr_t), parameter :: ignored = 1   !! C's SIG_IGN
    integer(c_intptr_t), parameter :: refused = -1  !! C's SIG_ERR

    integer(c_int), parameter :: patience = 1  !! s

    integer(c_int), volatile :: caught = 0      !! the first signal that came
    integer(c_int), volatile :: beside = 0      !! the process that we wait for
    type(c_funptr) :: unheeded = c_null_funptr  !! what to do where nobody looked

contains

    subroutine catch_interrupts(give_up)
        !! From now on a signal that would end the program (SIGHUP, SIGINT, SIGQUIT, SIGTERM,
        !! SIGXCPU, SIGUSR1, SIGALRM and all others but those of faults) changes what
        !! `interrupt_status` returns; where nobody looks at that for a second, `give_up` is to end
        !! the program. The second of a kind ends it at once: by `give_up` too, without one as if
        !! it was never caught. A signal that our parent had us ignore (`nohup`, a job in the
        !! background of a script) stays ignored, and one that a library answers (MPI, a profiler)
        !! remains the library's. A broken pipe or a file beyond `ulimit -f` no longer ends the
        !! program: the write fails, and is reported.
        type(c_funptr), intent(in), optional :: give_up  !! a handler of signals
        type(c_funptr) :: old

        if (present(give_up)) unheeded = give_up
        call install_endings(c_funloc(remember_signal))
        call install(sigpipe, c_funloc(do_nothing), old)
        call install(sigxfsz, c_funloc(do_nothing), old)
    end subroutine catch_interrupts

    subroutine end_by_signals()
        !! Undo `catch_interrupts` in a copy of this process that has nothing to tidy up: a signal
        !! that asks to end ends it. What was ignored stays so.
        call install_endings(c_null_funptr)
    end subroutine end_by_signals

    function interrupt_status() result(status)
        !! 0, or the exit status due to a signal, 128 + its number. Costs a load.
        integer :: status

        status = status_ok
        if (caught /= 0) status = status_of_signal + int(caught)
    end function interrupt_status

    subroutine run_beside(pid)
        !! A signal to us is to end the process `pid` too; 0 for none.
        integer(c_int), intent(in) :: pid  !! its number

        beside = pid
    end subroutine run_beside

    subroutine install_endings(handler)
        !! Let `handler`, or for null the system, answer whatever would end the program. The five
        !! are taken from the Fortran library, which would write a backtrace.
        type(c_funptr), intent(in) :: handler
        type(c_funptr) :: old
        integer(c_int) :: i, number

        do i = 1, size(endings, kind=c_int)
            call install(endings(i), handler, old)
        end do
        i = 1
        do
            number = c_ending(i)
            if (number == 0) exit
            call install(number, handler, old)
            if (is_anothers(old)) old = c_signal(number, old)
            i = i + 1
        end do
    end subroutine install_endings

    function is_anothers(handler) result(yes)
        !! Whether what answered a signal so far is neither the system nor this module.
        type(c_funptr), intent(in) :: handler
        logical :: yes

        yes = c_associated(handler) .and. .not. &
              (transfer(handler, ignored) == ignored .or. &
               transfer(handler, ignored) == refused .or. &
               c_associated(handler, c_funloc(remember_signal)) .or. &
               c_associated(handler, unheeded))
    end function is_anothers

    subroutine install(number, handler, old)
        !! Let `handler` answer a signal, or for null the system, unless it was ignored so far.
        integer(c_int), intent(in) :: number
        type(c_funptr), intent(in) :: handler
        type(c_funptr), intent(out) :: old     !! what answered it so far
        type(c_funptr) :: new

        old = c_signal(number, handler)
        if (transfer(old, ignored) == ignored) new = c_signal(number, old)
    end subroutine install

    subroutine remember_signal(number) bind(c)
        !! Runs at any moment: does nothing that is not safe there.
        integer(c_int), value :: number
        type(c_funptr) :: old

        if (caught == 0) caught = number
        old = c_signal(number, unheeded)  ! null is C's SIG_DFL: the next one ends the program
        if (beside > 0) number = c_kill(beside, sigterm)
        if (.not. c_associated(unheeded)) return
        old = c_signal(sigalrm, unheeded)
        number = c_alarm(patience)
    end subroutine remember_signal

    subroutine do_nothing(number) bind(c)
        !! A handler, and not SIG_IGN, because programs we start would inherit the latter.
        integer(c_int), value :: number
    end subroutine do_nothing
end module lagrangia_interrupt
