program main
    !! Words in, one command, exit status out.
    use lagrangia_commands, only: dispatch
    use lagrangia_console, only: note
    use lagrangia_errors, only: error_t, status_ok
    implicit none (type, external)
    type(error_t), allocatable :: error
    integer :: status

    call dispatch(error)
    status = status_ok
    if (allocated(error)) then
        status = error%status
        if (len(error%message) > 0) call note(error%message)
    end if
    stop status, quiet=.true.
end program main
