module funit_locations
    !! Where in the sources an assertion stands: as the test says, or else as the call stack does.
    !!
    !! libgfortran prints the stack, with files and lines where the code was compiled with `-g`, to
    !! stderr only; so that goes to a temporary file for the time.
    use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_int, c_ptr, c_size_t
    use, intrinsic :: iso_fortran_env, only: error_unit
    implicit none (type, external)
    private
    public :: SourceLocation, call_site, location_text

    type :: SourceLocation
        !! A line of a source file.
        character(255) :: fileName = "<unknown file>"
        integer :: lineNumber = -1
    end type SourceLocation

    integer(c_int), parameter :: standard_error = 2
    integer, parameter :: most_bytes = 10000  !! of a printed stack
    integer, parameter :: most_callers = 3    !! that are shown

    interface
        subroutine print_stack() bind(c, name="_gfortran_backtrace")
            implicit none (type, external)
        end subroutine print_stack

        function c_tmpfile() bind(c, name="tmpfile") result(stream)
            import :: c_ptr
            implicit none (type, external)
            type(c_ptr) :: stream
        end function c_tmpfile

        function c_fileno(stream) bind(c, name="fileno") result(descriptor)
            import :: c_int, c_ptr
            implicit none (type, external)
            type(c_ptr), value :: stream
            integer(c_int) :: descriptor
        end function c_fileno

        function c_dup(descriptor) bind(c, name="dup") result(copy)
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: descriptor
            integer(c_int) :: copy
        end function c_dup

        function c_dup2(old, new) bind(c, name="dup2") result(status)
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: old, new
            integer(c_int) :: status
        end function c_dup2

        function c_close(descriptor) bind(c, name="close") result(status)
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: descriptor
            integer(c_int) :: status
        end function c_close

        subroutine c_rewind(stream) bind(c, name="rewind")
            import :: c_ptr
            implicit none (type, external)
            type(c_ptr), value :: stream
        end subroutine c_rewind

        function c_fread(bytes, size, count, stream) bind(c, name="fread") result(number)
            import :: c_char, c_ptr, c_size_t, most_bytes
            implicit none (type, external)
            character(kind=c_char), intent(inout) :: bytes(most_bytes)
            integer(c_size_t), value :: size, count
            type(c_ptr), value :: stream
            integer(c_size_t) :: number
        end function c_fread

        function c_fclose(stream) bind(c, name="fclose") result(status)
            import :: c_int, c_ptr
            implicit none (type, external)
            type(c_ptr), value :: stream
            integer(c_int) :: status
        end function c_fclose
    end interface

contains

    function location_text(location) result(text)
        !! `[file:line]`.
        type(SourceLocation), intent(in) :: location
        character(:), allocatable :: text
        character(12) :: line

        text = trim(location%fileName)
        if (location%lineNumber > 0) then
            write (line, "(ss, i0)") location%lineNumber
            text = text//":"//trim(line)
        end if
        text = "["//text//"]"
    end function location_text

    function call_site() result(text)
        !! `[test/test_x.f90:12]`: the line outside these modules that called one of them; after it
        !! the lines of its callers in a test's helpers, the nearest first.
        character(:), allocatable :: text
        character(:), allocatable :: stack, line
        character(*), parameter :: nl = new_line("a"), before = "at "
        integer :: first, last, found

        text = ""
        found = 0
        stack = printed_stack()
        first = 1
        do while (first <= len(stack))
            last = first + index(stack(first:)//nl, nl) - 2
            line = adjustl(stack(first + verify(stack(first:last), achar(9)//" ") - 1:last))
            first = last + 2
            ! below main, where the C library was compiled with line numbers, stand lines of its own
            if (index(line, before) /= 1 .or. index(line, ".f90:") == 0) cycle
            line = shown(line(len(before) + 1:))
            if (index(line, "funit/runner.f90") > 0) exit
            if (index(line, "funit/") > 0 .or. found > most_callers) cycle
            if (found == 1) text = text//", called from "
            if (found > 1) text = text//", "
            text = text//line
            found = found + 1
        end do
        if (found == 0) text = "<unknown location>"
        text = "["//text//"]"
    end function call_site

    pure function shown(path) result(name)
        !! From the folder `test` on, where it is in the path.
        character(*), intent(in) :: path
        character(:), allocatable :: name
        integer :: at

        at = index(path, "/test/", back=.true.)
        name = path(at + 1:)
    end function shown

    function printed_stack() result(text)
        !! What libgfortran prints of the stack; nothing where there is no temporary file.
        character(:), allocatable :: text
        character(kind=c_char) :: bytes(most_bytes)
        type(c_ptr) :: stream
        integer(c_int) :: kept, status
        integer :: number, i

        stream = c_tmpfile()
        if (.not. c_associated(stream)) then
            text = ""
            return
        end if
        flush (error_unit)
        kept = c_dup(standard_error)
        status = c_dup2(c_fileno(stream), standard_error)
        call print_stack()
        status = c_dup2(kept, standard_error)
        status = c_close(kept)
        call c_rewind(stream)
        number = int(c_fread(bytes, 1_c_size_t, int(most_bytes, c_size_t), stream))
        status = c_fclose(stream)
        allocate (character(number) :: text)
        do i = 1, number
            text(i:i) = bytes(i)
        end do
    end function printed_stack
end module funit_locations
