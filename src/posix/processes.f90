module lagrangia_processes
    !! Running another program: no shell, so nothing in an argument has a special meaning.
    use, intrinsic :: iso_c_binding, only: c_char, c_int, c_loc, c_long, &
        c_null_char, c_null_ptr, c_ptr
    use lagrangia_c_library, only: c_execvp, c_exit, c_fork, c_poll, c_waitpid, poll_t
    use lagrangia_console, only: flush_console
    use lagrangia_errors, only: error_t, fail, status_file
    use lagrangia_files, only: last_error, reason
    use lagrangia_interrupt, only: run_beside
    use lagrangia_kinds, only: i8
    use lagrangia_text, only: to_text, word_t
    implicit none (type, external)
    private
    public :: await_program, bytes_read_by, start_program

    integer(c_int), parameter :: not_found = 127  !! what shells say when there is no such program

contains

    subroutine start_program(arguments, pid, error)
        !! Run the program `arguments(1)`, looked for along PATH, and do not wait for its end:
        !! `await_program` does. Its output goes where ours goes.
        type(word_t), intent(in) :: arguments(:)         !! each reaches it byte for byte
        integer, intent(out) :: pid                      !! its number
        type(error_t), allocatable, intent(out) :: error !! there can be no other process
        character(kind=c_char), allocatable, target :: text(:, :)
        type(c_ptr) :: pointers(size(arguments) + 1)
        integer(c_int) :: code
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
        call flush_console()
        pid = int(c_fork())
        if (pid == 0) then  ! the child: nothing but execvp and _exit is safe here
            code = c_execvp(text(:, 1), pointers)
            call c_exit(not_found)
        end if
        if (pid < 0) call fail(error, "cannot run '"//arguments(1)%text//"': "// &
                               reason(last_error()), status_file)
        if (pid > 0) call run_beside(int(pid, c_int))
    end subroutine start_program

    subroutine await_program(name, pid, milliseconds, ended, status, error)
        !! Wait for the end of what `start_program` began, but not for long.
        character(*), intent(in) :: name     !! `arguments(1)`, for the message
        integer, intent(in) :: pid           !! its number
        integer, intent(in) :: milliseconds  !! at most, in steps of a few
        logical, intent(out) :: ended        !! whether it has; then it is forgotten
        integer, intent(out) :: status       !! its own, or 128 + the signal it died of
        type(error_t), allocatable, intent(out) :: error !! there is no such program
        integer(c_int), parameter :: at_once = 1, pause = 5  !! C's WNOHANG; ms
        type(poll_t) :: nothing(1)
        integer(c_int) :: answer, code, ready
        integer :: waited

        status = not_found
        waited = 0
        do
            answer = c_waitpid(int(pid, c_int), code, at_once)
            ended = answer /= 0
            if (ended .or. waited >= milliseconds) exit
            ready = c_poll(nothing, 0_c_long, pause)
            waited = waited + pause
        end do
        if (.not. ended) return
        call run_beside(0_c_int)
        if (answer < 0) then
            call fail(error, "cannot run '"//name//"': "//reason(last_error()), status_file)
            return
        end if
        status = ibits(code, 8, 8)
        if (ibits(code, 0, 7) /= 0) status = 128 + ibits(code, 0, 7)
        if (status == not_found) call fail(error, "cannot run '"//name//"': no such program", &
                                           status_file)
    end subroutine await_program

    function bytes_read_by(pid) result(bytes)
        !! How much a process has read so far, of everything; 0 where the system does not tell.
        integer, intent(in) :: pid  !! its number
        integer(i8) :: bytes
        character(40) :: line
        integer :: unit, status

        bytes = 0
        open (newunit=unit, file="/proc/"//to_text(pid)//"/io", status="old", action="read", &
              iostat=status)
        if (status /= 0) return
        read (unit, "(a)", iostat=status) line
        close (unit)
        if (status /= 0 .or. line(:7) /= "rchar: ") return
        read (line(8:), *, iostat=status) bytes
        if (status /= 0) bytes = 0
    end function bytes_read_by
end module lagrangia_processes
