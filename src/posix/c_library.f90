module lagrangia_c_library
    !! The C library, declared here and nowhere else. Every function has a fixed list of arguments;
    !! variadic ones (printf, open, fcntl) cannot be called portably through `bind(c)`.
    use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int, c_long, c_ptr, &
        c_short, c_size_t
    implicit none (type, external)
    private
    public :: c_access, c_alarm, c_chmod, c_close, c_dlsym, c_dup, c_ending, c_errno, &
              c_execvp, c_exit, c_fclose, c_fdopen, c_fflush, c_fileno, c_first_of_all, &
              c_flock, c_fopen, c_fork, c_fread, c_fread_reals, c_free, c_fseek, c_fwrite, &
              c_fwrite_reals, c_getpid, c_getppid, c_getrlimit, c_isatty, c_kill, c_lstat, &
              c_malloc, c_mkdir, c_pipe, c_poll, c_realpath, c_remove, c_rename, c_setenv, &
              c_setvbuf, c_signal, c_stat, c_statvfs, c_strerror, c_strlen, &
              c_terminal_columns, c_waitpid, c_write, poll_t

    type, bind(c) :: poll_t
        !! C's `struct pollfd`.
        integer(c_int) :: descriptor = -1   !! negative: nothing is waited for
        integer(c_short) :: events = 0      !! what is waited for
        integer(c_short) :: happened = 0    !! what has come
    end type poll_t

    ! allow(assumed-size): C takes the address of the first element
    interface
        subroutine c_first_of_all() bind(c, name="lagrangia_first_of_all")
            implicit none (type, external)
        end subroutine c_first_of_all

        function c_fopen(path, mode) bind(c, name="fopen") result(stream)
            import :: c_char, c_ptr
            implicit none (type, external)
            character(kind=c_char), intent(in) :: path(*), mode(*)
            type(c_ptr) :: stream
        end function c_fopen

        function c_dlsym(library, name) bind(c, name="dlsym") result(address)
            import :: c_char, c_funptr, c_ptr
            implicit none (type, external)
            type(c_ptr), value :: library
            character(kind=c_char), intent(in) :: name(*)
            type(c_funptr) :: address
        end function c_dlsym

        function c_fdopen(descriptor, mode) bind(c, name="fdopen") result(stream)
            import :: c_char, c_int, c_ptr
            implicit none (type, external)
            integer(c_int), value :: descriptor
            character(kind=c_char), intent(in) :: mode(*)
            type(c_ptr) :: stream
        end function c_fdopen

        function c_fread(bytes, size, count, stream) bind(c, name="fread") result(got)
            import :: c_char, c_ptr, c_size_t
            implicit none (type, external)
            ! allow(assumed-size-character-intent): C fills it
            character(kind=c_char), intent(out) :: bytes(*)
            integer(c_size_t), value :: size, count
            type(c_ptr), value :: stream
            integer(c_size_t) :: got
        end function c_fread

        function c_fread_reals(values, size, count, stream) bind(c, name="fread") result(got)
            import :: c_double, c_ptr, c_size_t
            implicit none (type, external)
            real(c_double), intent(out) :: values(*)
            integer(c_size_t), value :: size, count
            type(c_ptr), value :: stream
            integer(c_size_t) :: got
        end function c_fread_reals

        function c_fwrite(bytes, size, count, stream) bind(c, name="fwrite") result(written)
            import :: c_char, c_ptr, c_size_t
            implicit none (type, external)
            character(kind=c_char), intent(in) :: bytes(*)
            integer(c_size_t), value :: size, count
            type(c_ptr), value :: stream
            integer(c_size_t) :: written
        end function c_fwrite

        function c_fwrite_reals(values, size, count, stream) bind(c, name="fwrite") result(written)
            import :: c_double, c_ptr, c_size_t
            implicit none (type, external)
            real(c_double), intent(in) :: values(*)
            integer(c_size_t), value :: size, count
            type(c_ptr), value :: stream
            integer(c_size_t) :: written
        end function c_fwrite_reals

        function c_fflush(stream) bind(c, name="fflush") result(status)
            import :: c_int, c_ptr
            implicit none (type, external)
            type(c_ptr), value :: stream
            integer(c_int) :: status
        end function c_fflush

        function c_setvbuf(stream, buffer, mode, size) bind(c, name="setvbuf") result(status)
            import :: c_int, c_ptr, c_size_t
            implicit none (type, external)
            type(c_ptr), value :: stream, buffer
            integer(c_int), value :: mode
            integer(c_size_t), value :: size
            integer(c_int) :: status
        end function c_setvbuf

        function c_fclose(stream) bind(c, name="fclose") result(status)
            import :: c_int, c_ptr
            implicit none (type, external)
            type(c_ptr), value :: stream
            integer(c_int) :: status
        end function c_fclose

        function c_fseek(stream, offset, whence) bind(c, name="fseek") result(status)
            import :: c_int, c_long, c_ptr
            implicit none (type, external)
            type(c_ptr), value :: stream
            integer(c_long), value :: offset
            integer(c_int), value :: whence  !! 0 from the start, 2 from the end
            integer(c_int) :: status
        end function c_fseek

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

        function c_close(descriptor) bind(c, name="close") result(status)
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: descriptor
            integer(c_int) :: status
        end function c_close

        function c_flock(descriptor, operation) bind(c, name="flock") result(status)
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: descriptor
            integer(c_int), value :: operation  !! 2 wait for the lock, 6 take it or fail
            integer(c_int) :: status
        end function c_flock

        function c_write(descriptor, bytes, count) bind(c, name="write") result(written)
            import :: c_char, c_int, c_size_t
            implicit none (type, external)
            integer(c_int), value :: descriptor
            character(kind=c_char), intent(in) :: bytes(*)
            integer(c_size_t), value :: count
            integer(c_size_t) :: written  !! -1 on failure
        end function c_write

        function c_isatty(descriptor) bind(c, name="isatty") result(yes)
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: descriptor
            integer(c_int) :: yes
        end function c_isatty

        function c_terminal_columns(descriptor) &
            bind(c, name="lagrangia_terminal_columns") result(columns)
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: descriptor
            integer(c_int) :: columns  !! 0: it does not say; -1: there is no terminal
        end function c_terminal_columns

        function c_rename(old, new) bind(c, name="rename") result(status)
            import :: c_char, c_int
            implicit none (type, external)
            character(kind=c_char), intent(in) :: old(*), new(*)
            integer(c_int) :: status
        end function c_rename

        function c_remove(path) bind(c, name="remove") result(status)
            import :: c_char, c_int
            implicit none (type, external)
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int) :: status
        end function c_remove

        function c_mkdir(path, mode) bind(c, name="mkdir") result(status)
            import :: c_char, c_int
            implicit none (type, external)
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int), value :: mode
            integer(c_int) :: status
        end function c_mkdir

        function c_chmod(path, mode) bind(c, name="chmod") result(status)
            import :: c_char, c_int
            implicit none (type, external)
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int), value :: mode
            integer(c_int) :: status
        end function c_chmod

        function c_access(path, mode) bind(c, name="access") result(status)
            import :: c_char, c_int
            implicit none (type, external)
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int), value :: mode  !! 2 may be written
            integer(c_int) :: status
        end function c_access

        function c_realpath(path, buffer) bind(c, name="realpath") result(text)
            import :: c_char, c_ptr
            implicit none (type, external)
            character(kind=c_char), intent(in) :: path(*)
            type(c_ptr), value :: buffer
            type(c_ptr) :: text
        end function c_realpath

        function c_statvfs(path, values) bind(c, name="statvfs") result(status)
            !! Of a file system, on Linux with 64 bits: the second value is the size of its blocks,
            !! the fifth how many of them users may still fill.
            import :: c_char, c_int, c_long
            implicit none (type, external)
            character(kind=c_char), intent(in) :: path(*)
            integer(c_long), intent(out) :: values(*)
            integer(c_int) :: status
        end function c_statvfs

        function c_getpid() bind(c, name="getpid") result(pid)
            import :: c_int
            implicit none (type, external)
            integer(c_int) :: pid
        end function c_getpid

        function c_getrlimit(resource, limits) bind(c, name="getrlimit") result(status)
            import :: c_int, c_long
            implicit none (type, external)
            integer(c_int), value :: resource        !! 3 the stack
            integer(c_long), intent(out) :: limits(2)  !! now, and the most; < 0: none
            integer(c_int) :: status
        end function c_getrlimit

        function c_malloc(bytes) bind(c, name="malloc") result(memory)
            import :: c_ptr, c_size_t
            implicit none (type, external)
            integer(c_size_t), value :: bytes
            type(c_ptr) :: memory
        end function c_malloc

        function c_signal(number, handler) bind(c, name="signal") result(old)
            import :: c_funptr, c_int
            implicit none (type, external)
            integer(c_int), value :: number
            type(c_funptr), value :: handler
            type(c_funptr) :: old
        end function c_signal

        function c_ending(which) bind(c, name="lagrangia_ending") result(number)
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: which
            integer(c_int) :: number
        end function c_ending

        function c_alarm(seconds) bind(c, name="alarm") result(left)
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: seconds
            integer(c_int) :: left
        end function c_alarm

        function c_kill(pid, number) bind(c, name="kill") result(status)
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: pid, number
            integer(c_int) :: status
        end function c_kill

        function c_fork() bind(c, name="fork") result(pid)
            import :: c_int
            implicit none (type, external)
            integer(c_int) :: pid
        end function c_fork

        function c_getppid() bind(c, name="getppid") result(pid)
            import :: c_int
            implicit none (type, external)
            integer(c_int) :: pid
        end function c_getppid

        function c_pipe(descriptors) bind(c, name="pipe") result(status)
            import :: c_int
            implicit none (type, external)
            integer(c_int), intent(out) :: descriptors(2)  !! to read from, to write to
            integer(c_int) :: status
        end function c_pipe

        function c_poll(polled, count, milliseconds) bind(c, name="poll") result(ready)
            import :: c_int, c_long, poll_t
            implicit none (type, external)
            ! allow(assumed-size-character-intent): C fills it
            type(poll_t), intent(inout) :: polled(*)
            integer(c_long), value :: count
            integer(c_int), value :: milliseconds  !! negative: wait for ever
            integer(c_int) :: ready                !! -1 on failure, a signal among others
        end function c_poll

        function c_setenv(name, value, overwrite) bind(c, name="setenv") result(status)
            import :: c_char, c_int
            implicit none (type, external)
            character(kind=c_char), intent(in) :: name(*), value(*)
            integer(c_int), value :: overwrite
            integer(c_int) :: status
        end function c_setenv

        function c_execvp(file, arguments) bind(c, name="execvp") result(status)
            import :: c_char, c_int, c_ptr
            implicit none (type, external)
            character(kind=c_char), intent(in) :: file(*)
            type(c_ptr), intent(in) :: arguments(*)
            integer(c_int) :: status
        end function c_execvp

        function c_waitpid(pid, status, options) bind(c, name="waitpid") result(found)
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: pid, options
            integer(c_int), intent(out) :: status
            integer(c_int) :: found
        end function c_waitpid

        subroutine c_exit(status) bind(c, name="_exit")
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: status
        end subroutine c_exit

        function c_strerror(number) bind(c, name="strerror") result(text)
            import :: c_int, c_ptr
            implicit none (type, external)
            integer(c_int), value :: number
            type(c_ptr) :: text
        end function c_strerror

        function c_strlen(text) bind(c, name="strlen") result(length)
            import :: c_ptr, c_size_t
            implicit none (type, external)
            type(c_ptr), value :: text
            integer(c_size_t) :: length
        end function c_strlen

        subroutine c_free(memory) bind(c, name="free")
            import :: c_ptr
            implicit none (type, external)
            type(c_ptr), value :: memory
        end subroutine c_free

        function c_errno() bind(c, name="_gfortran_ierrno_i4") result(number)
            !! `errno` is a macro in C; libgfortran's own function reads it on every system.
            import :: c_int
            implicit none (type, external)
            integer(c_int) :: number
        end function c_errno

        subroutine c_stat() bind(c, name="_gfortran_stat_i8_sub")
            !! Not called as declared: see `look_at` in lagrangia_files.
            implicit none (type, external)
        end subroutine c_stat

        subroutine c_lstat() bind(c, name="_gfortran_lstat_i8_sub")
            !! As `c_stat`, of a link itself.
            implicit none (type, external)
        end subroutine c_lstat
    end interface
end module lagrangia_c_library
