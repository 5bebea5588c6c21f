module lagrangia_errors
    !! Errors are values: the last argument of whatever can fail; allocated means failed.
    use lagrangia_text, only: shortened
    implicit none (type, external)
    private
    public :: error_t, fail, is_signal, message_length
    public :: status_ok, status_not_held, status_usage, status_numbers, status_library, &
              status_file, status_interrupted, status_of_signal, status_pipe, status_terminated

    integer, parameter :: status_ok = 0             !! all is well
    integer, parameter :: status_not_held = 1       !! a check or a scene's tolerance did not hold
    integer, parameter :: status_usage = 2          !! usage, scene or parameter error
    integer, parameter :: status_numbers = 3        !! overflow, NaN, no convergence
    integer, parameter :: status_library = 4        !! LAPACK or GSL refused
    integer, parameter :: status_file = 5           !! a file could not be read or written
    integer, parameter :: status_of_signal = 128    !! plus the number of the signal that ended it
    integer, parameter :: status_interrupted = 130  !! SIGINT
    integer, parameter :: status_pipe = 141         !! SIGPIPE: nobody reads what is printed
    integer, parameter :: status_terminated = 143   !! SIGTERM

    integer, parameter :: message_length = 289     !! 300 with `lagrangia: ` before it

    type :: error_t
        !! What went wrong: one short line for the user, and the exit status that belongs to it.
        character(:), allocatable :: message
        character(:), allocatable :: key  !! the key of a scene that is to blame, if it is known
        integer :: element = 1            !! and which of its values
        integer :: status = status_usage
    contains
        procedure :: add_context
    end type error_t

contains

    pure subroutine fail(error, message, status, key, element)
        !! Make `error` say `message`, shortened if need be; the status is that of a usage error
        !! unless given.
        type(error_t), allocatable, intent(out) :: error  !! allocated, with what follows
        character(*), intent(in) :: message  !! for the user; cut to `message_length` bytes
        integer, intent(in), optional :: status  !! exit status, one of the above
        character(*), intent(in), optional :: key  !! of a scene, if it is to blame
        integer, intent(in), optional :: element  !! which of its values, from 1

        allocate (error)
        error%message = shortened(message, message_length)
        if (present(status)) error%status = status
        if (present(key)) error%key = key
        if (present(element)) error%element = element
    end subroutine fail

    pure function is_signal(error) result(yes)
        !! Whether a signal is behind `error`: then everything ends, not only what failed.
        type(error_t), intent(in) :: error  !! of any kind
        logical :: yes

        yes = error%status > status_of_signal
    end function is_signal

    pure subroutine add_context(self, context)
        !! Put `context: ` before the message.
        class(error_t), intent(inout) :: self
        character(*), intent(in) :: context  !! what was being done

        self%message = shortened(context//": "//self%message, message_length)
    end subroutine add_context
end module lagrangia_errors
