module lagrangia_console
    !! What the user sees: results on stdout, messages on stderr.
    !!
    !! All goes through C's stdio, so that a full disk, a closed stdout or a broken pipe is seen.
    !! Do not mix with `print` and `write (output_unit, ...)`: their buffer is another one.
    use, intrinsic :: iso_c_binding, only: c_associated, c_int, c_null_char, c_null_ptr, c_ptr, &
        c_size_t
    use lagrangia_c_library, only: c_fdopen, c_fflush, c_fwrite, c_isatty, &
        c_terminal_columns, c_write
    use lagrangia_characters, only: printable
    use lagrangia_errors, only: error_t, fail, message_length, status_file, status_pipe
    use lagrangia_files, only: e_bad_unit, e_broken_pipe, last_error, reason
    use lagrangia_folding, only: folded
    use lagrangia_text, only: shortened, word_t
    implicit none (type, external)
    private
    public :: console_failed, finish_console, flush_console, fold_lines, line_width, note, put, &
              put_line, put_lines, put_row, rewrites_lines, say_at_once, show_progress

    type(c_ptr) :: stream = c_null_ptr  !! C's `FILE *` for stdout
    integer :: failure = 0              !! the system's number of the first failure
    integer :: columns = huge(1)        !! of a line on stdout
    integer, parameter :: least_columns = 20  !! of less nothing could be made

contains

    subroutine put(text)
        !! Write `text` to stdout as it is.
        character(*), intent(in) :: text  !! any bytes; no newline is added
        integer(c_size_t) :: length

        if (failure /= 0) return
        if (.not. c_associated(stream)) then
            stream = c_fdopen(1_c_int, "w"//c_null_char)
            if (.not. c_associated(stream)) then
                failure = e_bad_unit
                return
            end if
        end if
        length = len(text, c_size_t)
        if (c_fwrite(text, 1_c_size_t, length, stream) /= length) failure = last_error()
    end subroutine put

    subroutine put_line(text)
        !! Write `text` as one line to stdout, whatever is in it: see `printable`. Behind
        !! `fold_lines` a terminal gets as many lines as it takes.
        character(*), intent(in) :: text  !! without a newline
        type(word_t), allocatable :: lines(:)
        integer :: i

        if (len(text) <= columns) then
            call put(printable(text)//new_line("a"))
            return
        end if
        call folded(printable(text), columns, lines)
        do i = 1, size(lines)
            call put(lines(i)%text//new_line("a"))
        end do
    end subroutine put_line

    subroutine put_lines(text)
        !! Write each line of `text` as `put_line` does.
        character(*), intent(in) :: text  !! a newline behind each line
        integer :: first, last

        first = 1
        do while (first <= len(text))
            last = first + index(text(first:)//new_line("a"), new_line("a")) - 2
            call put_line(text(first:last))
            first = last + 2
        end do
    end subroutine put_lines

    subroutine put_row(text, name, most)
        !! Write a row of a table. Where the terminal is narrower than the table, what stands
        !! behind the name goes on a line of its own, in all rows alike.
        character(*), intent(in) :: text  !! without a newline
        integer, intent(in) :: name       !! columns of the name
        integer, intent(in) :: most       !! columns of the table

        if (most <= columns .or. len(text) <= name) then
            call put_line(text)
            return
        end if
        if (text(:name) /= "") call put_line(trim(text(:name)))
        call put_line("    "//text(name + 1:))
    end subroutine put_row

    subroutine fold_lines()
        !! From now on no line on a terminal is wider than that: for text that people read. The
        !! variable COLUMNS goes before what the terminal says; 80 where neither says anything.
        character(8) :: value
        integer :: number, status

        number = int(c_terminal_columns(1_c_int))
        if (number < 0) return
        columns = number
        call get_environment_variable("COLUMNS", value, status=status)
        if (status == 0 .and. value /= "" .and. verify(trim(value), "0123456789") == 0) then
            read (value, *, iostat=status) number
            if (status == 0 .and. number > 0) columns = number
        end if
        if (columns == 0) columns = 80
        columns = max(columns, least_columns)
    end subroutine fold_lines

    function line_width()
        !! Columns of a line on stdout; the largest number where lines are not folded.
        integer :: line_width

        line_width = columns
    end function line_width

    subroutine note(text)
        !! Write the one line `lagrangia: text` to stderr, in at most 300 bytes, whatever is in it:
        !! see `printable`.
        character(*), intent(in) :: text  !! without a newline
        character(:), allocatable :: line
        integer(c_size_t) :: written

        call flush_console()
        line = "lagrangia: "//shortened(printable(text), message_length)//new_line("a")
        written = c_write(2_c_int, line, len(line, c_size_t))  ! if stderr is gone, who would know?
    end subroutine note

    subroutine say_at_once(line)
        !! Write `line`, whose end is in it, to stderr as it is. Allocates nothing, and flushes
        !! nothing: fit for signal handlers.
        character(*), intent(in) :: line  !! with its newline
        integer(c_size_t) :: written

        written = c_write(2_c_int, line, len(line, c_size_t))
    end subroutine say_at_once

    subroutine show_progress(text)
        !! Let `text` replace the line of the terminal behind stderr; `""` clears it. What is wider
        !! than the terminal is cut, for a second line would stay there.
        character(*), intent(in) :: text  !! printable or not
        character(:), allocatable :: line
        integer(c_size_t) :: written

        line = char(13)//char(27)//"[K"//char(27)//"[?7l"//printable(text)//char(27)//"[?7h"
        written = c_write(2_c_int, line, len(line, c_size_t))
    end subroutine show_progress

    subroutine finish_console(error)
        !! Send on what is still held back; fails if anything put was lost. The exit status of
        !! a program whose results go to stdout depends on it. A reader who has seen enough
        !! (`| head`) is no reason for a message, and the status is what SIGPIPE would make it.
        type(error_t), allocatable, intent(out) :: error  !! status 5, or that of SIGPIPE

        call flush_console()
        if (failure == 0) return
        if (failure == e_broken_pipe) then
            call fail(error, "", status_pipe)
            return
        end if
        call fail(error, "cannot write standard output: "//reason(failure), status_file)
    end subroutine finish_console

    subroutine flush_console()
        !! Send on what is still held back: before something else writes to the same place.
        if (failure /= 0 .or. .not. c_associated(stream)) return
        if (c_fflush(stream) /= 0) failure = last_error()
    end subroutine flush_console

    function console_failed()
        !! Whether something put was lost already: nobody reads on, a long job may stop.
        logical :: console_failed

        console_failed = failure /= 0
    end function console_failed

    function rewrites_lines()
        !! Whether stderr is a terminal on which a line can take the place of the one before. On a
        !! dumb one, or where the variable TERM does not say what it is, it cannot.
        logical :: rewrites_lines
        character(5) :: kind

        call get_environment_variable("TERM", kind)
        rewrites_lines = c_isatty(2_c_int) == 1 .and. kind /= "" .and. kind /= "dumb"
    end function rewrites_lines
end module lagrangia_console
