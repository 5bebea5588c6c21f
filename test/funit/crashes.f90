module funit_crashes
    !! A program that is killed by its own fault, or stops in the midst, says so first.
    use, intrinsic :: iso_c_binding, only: c_funloc, c_funptr, c_int
    implicit none (type, external)
    private
    public :: watch_for_crashes

    abstract interface
        subroutine tell_i(what)
            !! Print `what` happened.
            implicit none (type, external)
            character(*), intent(in) :: what
        end subroutine tell_i
    end interface

    interface
        function c_signal(number, handler) bind(c, name="signal") result(old)
            import :: c_funptr, c_int
            implicit none (type, external)
            integer(c_int), value :: number
            type(c_funptr), value :: handler
            type(c_funptr) :: old
        end function c_signal

        function c_raise(number) bind(c, name="raise") result(status)
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: number
            integer(c_int) :: status
        end function c_raise

        function c_atexit(handler) bind(c, name="atexit") result(status)
            import :: c_funptr, c_int
            implicit none (type, external)
            type(c_funptr), value :: handler
            integer(c_int) :: status
        end function c_atexit

        function c_getpid() bind(c, name="getpid") result(pid)
            import :: c_int
            implicit none (type, external)
            integer(c_int) :: pid
        end function c_getpid
    end interface

    ! illegal instruction, abort, bus error, floating point, segmentation fault
    integer(c_int), parameter :: signals(5) = [4_c_int, 6_c_int, 7_c_int, 8_c_int, 11_c_int]
    type(c_funptr) :: before(size(signals))
    integer(c_int) :: owner = 0  !! not a child that a test has forked
    procedure(tell_i), pointer :: tell_of => null()

contains

    subroutine watch_for_crashes(tell)
        !! From here on `tell` is called before the program ends, however it does.
        procedure(tell_i) :: tell
        integer :: i

        tell_of => tell
        owner = c_getpid()
        do i = 1, size(signals)
            before(i) = c_signal(signals(i), c_funloc(on_signal))
        end do
        if (c_atexit(c_funloc(at_exit)) /= 0) tell_of => tell
    end subroutine watch_for_crashes

    subroutine on_signal(number) bind(c)
        !! Tell, and let happen what would have happened.
        integer(c_int), value :: number
        type(c_funptr) :: old
        character(12) :: digits
        integer :: i

        do i = 1, size(signals)
            if (signals(i) == number) old = c_signal(number, before(i))
        end do
        write (digits, "(ss, i0)") number
        if (c_getpid() == owner) call tell_of("killed by signal "//trim(digits))
        if (c_raise(number) /= 0) return
    end subroutine on_signal

    subroutine at_exit() bind(c)
        !! Tell; the runner knows whether it was at its end.
        if (c_getpid() == owner) call tell_of("the program was stopped")
    end subroutine at_exit
end module funit_crashes
