module lagrangia_namelist_file
    !! A whole file at once, through POSIX calls: libgfortran's READ blocks on a FIFO, takes a
    !! directory for an empty file and /dev/zero for an endless one.
    use, intrinsic :: iso_c_binding, only: c_char, c_int, c_long, c_null_char, c_ptr, c_size_t, &
                                           c_loc
    use lagrangia_errors, only: error_t, fail, status_file
    use lagrangia_files, only: facts_t, look_at
    use lagrangia_namelist_tree, only: short_source
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: most_bytes, read_whole_file

    integer, parameter :: most_bytes = 1048576             !! of a file that is read
    integer(c_int), parameter :: read_only = 0_c_int       !! O_RDONLY
    integer(c_int), parameter :: do_not_block = 2048_c_int !! O_NONBLOCK of Linux, for FIFOs
    integer(c_int), parameter :: from_start = 0_c_int, from_end = 2_c_int  !! SEEK_SET, SEEK_END

    interface
        function posix_open(path, flags) bind(c, name="open") result(descriptor)
            !! Open a file; below zero on failure.
            import :: c_char, c_int
            implicit none (type, external)
            ! allow(assumed-size): a C string
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int), value :: flags
            integer(c_int) :: descriptor
        end function posix_open

        function posix_lseek(descriptor, offset, whence) bind(c, name="lseek") result(position)
            !! Move in a file; below zero where there is nothing to move in.
            import :: c_int, c_long
            implicit none (type, external)
            integer(c_int), value :: descriptor
            integer(c_long), value :: offset
            integer(c_int), value :: whence
            integer(c_long) :: position
        end function posix_lseek

        function posix_read(descriptor, buffer, count) bind(c, name="read") result(got)
            !! Read up to `count` bytes; 0 at the end, below zero on failure.
            import :: c_int, c_long, c_ptr, c_size_t
            implicit none (type, external)
            integer(c_int), value :: descriptor
            type(c_ptr), value :: buffer
            integer(c_size_t), value :: count
            integer(c_long) :: got
        end function posix_read

        function posix_close(descriptor) bind(c, name="close") result(status)
            !! Close a file.
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: descriptor
            integer(c_int) :: status
        end function posix_close
    end interface

contains

    subroutine read_whole_file(path, text, error)
        !! The bytes of the regular file `path`, at most `most_bytes`. Directories, FIFOs, terminals
        !! and devices are refused without waiting.
        character(*), intent(in) :: path
        character(:), allocatable, intent(out) :: text
        type(error_t), allocatable, intent(out) :: error
        integer(c_int) :: descriptor, status
        character(:), allocatable :: problem
        type(facts_t) :: facts

        problem = ""
        if (len(path) == 0) then
            problem = "the name of the file is empty"
        else if (index(path, c_null_char) > 0) then
            problem = "the name of the file holds a NUL byte"
        else
            descriptor = posix_open(path//c_null_char, ior(read_only, do_not_block))
            if (descriptor >= 0_c_int) then
                call read_open_file(descriptor, text, problem)
                status = posix_close(descriptor)
                facts = look_at(path)
                if (facts%folder) problem = "is a folder; a file is needed"
            else
                facts = look_at(path)
                problem = "no such file"
                if (facts%found) problem = "the file cannot be opened; may it be read?"
            end if
        end if
        if (len(problem) == 0) return
        if (len(path) > 0) problem = trim(short_source(path))//": "//problem
        call fail(error, problem, status_file)
    end subroutine read_whole_file

    subroutine read_open_file(descriptor, text, problem)
        !! The bytes of an open file. Its end must be where seeking finds it: so only a regular
        !! file passes, for a device has no end, and a pipe or terminal no position.
        integer(c_int), intent(in) :: descriptor
        character(:), allocatable, intent(out) :: text
        character(:), allocatable, intent(out) :: problem
        character(:), allocatable, target :: bytes
        integer(c_long) :: got, length
        integer :: filled

        problem = "not a regular file"
        length = posix_lseek(descriptor, 0_c_long, from_end)
        if (length < 0_c_long) return
        if (posix_lseek(descriptor, 0_c_long, from_start) < 0_c_long) return
        allocate (character(int(min(length, int(most_bytes, c_long))) + 1) :: bytes)
        filled = 0
        do while (filled < len(bytes))
            got = posix_read(descriptor, c_loc(bytes(filled + 1:filled + 1)), &
                             int(len(bytes) - filled, c_size_t))
            if (got < 0_c_long) return
            if (got == 0_c_long) exit
            filled = filled + int(got)
        end do
        if (length > int(most_bytes, c_long)) then
            problem = "the file is longer than "//to_text(most_bytes)//" bytes"
        else if (int(filled, c_long) == length) then
            problem = ""
            text = bytes(:filled)
        end if
    end subroutine read_open_file
end module lagrangia_namelist_file
