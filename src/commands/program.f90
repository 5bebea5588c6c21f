module lagrangia_program
    !! The whole program: words in, one command, exit status out.
    use lagrangia_blas_threads, only: use_one_blas_thread
    use lagrangia_commands, only: dispatch
    use lagrangia_console, only: note
    use lagrangia_errors, only: error_t, status_ok
    use lagrangia_kinds, only: dp
    use lagrangia_resources, only: check_memory, check_stack
    implicit none (type, external)
    private
    public :: lagrangia_main

    integer, parameter :: least_stack = 256          !! kB, for all that is computed
    real(dp), parameter :: least_memory = 150e6_dp   !! bytes, most of them for OpenBLAS

contains

    subroutine lagrangia_main(failed)
        !! Run the command that was typed, with all systems that were registered, and stop. Where
        !! something `failed` before, say so and stop with the status of that: what
        !! `register_system` returned may be handed on, allocated or not.
        type(error_t), intent(in), optional :: failed
        type(error_t), allocatable :: error
        integer :: status

        call use_one_blas_thread()
        if (present(failed)) then
            allocate (error, source=failed)
        else
            call check_stack(least_stack, error)
            ! OpenBLAS tries for ever to get the 128 MB that its first call takes
            if (.not. allocated(error)) call check_memory(least_memory, "lagrangia", error)
            if (.not. allocated(error)) call dispatch(error)
        end if
        status = status_ok
        if (allocated(error)) then
            status = error%status
            if (len(error%message) > 0) call note(error%message)
        end if
        stop status, quiet=.true.
    end subroutine lagrangia_main
end module lagrangia_program
