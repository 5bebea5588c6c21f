module lagrangia_program
    !! The whole program: words in, one command, exit status out.
    use lagrangia_blas_threads, only: use_one_blas_thread
    use lagrangia_catalogue, only: system_names
    use lagrangia_commands, only: dispatch
    use lagrangia_console, only: note
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t, fail, status_ok
    implicit none (type, external)
    private
    public :: lagrangia_main

contains

    subroutine lagrangia_main()
        !! Run the command that was typed, with all systems that were registered, and stop.
        type(error_t), allocatable :: error
        integer :: status

        call use_one_blas_thread()
        call check_names(error)
        if (.not. allocated(error)) call dispatch(error)
        status = status_ok
        if (allocated(error)) then
            status = error%status
            if (len(error%message) > 0) call note(error%message)
        end if
        stop status, quiet=.true.
    end subroutine lagrangia_main

    subroutine check_names(error)
        !! No two systems of one name.
        type(error_t), allocatable, intent(out) :: error
        character(name_length), allocatable :: names(:)
        integer :: i

        allocate (names, source=system_names())
        do i = 2, size(names)
            if (all(names(:i - 1) /= names(i))) cycle
            call fail(error, "two systems are called '"//trim(names(i))//"': give yours a new name")
            return
        end do
    end subroutine check_names
end module lagrangia_program
