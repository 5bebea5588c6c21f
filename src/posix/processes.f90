module lagrangia_processes
    !! Running another program: no shell, so nothing in an argument has a special meaning.
    use, intrinsic :: iso_c_binding, only: c_char, c_int, c_loc, c_null_char, c_null_ptr, c_ptr
    use lagrangia_c_library, only: c_execvp, c_exit, c_fork, c_waitpid
    use lagrangia_console, only: flush_console
    use lagrangia_errors, only: error_t, fail, status_file
    use lagrangia_files, only: last_error, reason
    use lagrangia_interrupt, only: run_beside
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: run_program

    integer(c_int), parameter :: not_found = 127  !! what shells say when there is no such program

contains

    subroutine run_program(arguments, status, error)
        !! Run the program `arguments(1)`, looked for along PATH, and wait for its end. Its output
        !! goes where ours goes.
        type(word_t), intent(in) :: arguments(:)         !! each reaches it byte for byte
        integer, intent(out) :: status                   !! its own, or 128 + the signal it died of
        type(error_t), allocatable, intent(out) :: error !! there is no such program
        character(kind=c_char), allocatable, target :: text(:, :)
        type(c_ptr) :: pointers(size(arguments) + 1)
        integer(c_int) :: pid, code
        integer :: i, j, longest

        longest = maxval([(len(arguments(i)%text), i=1, size(arguments))])
        allocate (text(longest + 1, size(arguments)), source=c_null_char)
        do i = 1, size(arguments)
            do j = 1, len(arguments(i)%text)
                text(j, i) = arguments(i)%text(j:j)
            end do
            pointers(i) = c_loc(text(1, i))
        end do
        pointers(size(pointers)) = c_null_ptr
        status = not_found
        call flush_console()
        pid = c_fork()
        if (pid == 0) then  ! the child: nothing but execvp and _exit is safe here
            code = c_execvp(text(:, 1), pointers)
            call c_exit(not_found)
        end if
        call run_beside(pid)
        if (pid > 0) pid = c_waitpid(pid, code, 0_c_int)
        call run_beside(0_c_int)
        if (pid < 0) then
            call fail(error, "cannot run '"//arguments(1)%text//"': "//reason(last_error()), &
                      status_file)
            return
        end if
        status = ibits(code, 8, 8)
        if (ibits(code, 0, 7) /= 0) status = 128 + ibits(code, 0, 7)
        if (status == not_found) then
            call fail(error, "cannot run '"//arguments(1)%text//"': no such program", status_file)
        end if
    end subroutine run_program
end module lagrangia_processes
