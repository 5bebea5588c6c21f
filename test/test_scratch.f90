module test_scratch
    !! For suites that write files or must see a process end: a folder under build/ (or TMPDIR),
    !! and the few C functions with which a disk is filled and a stdout closed.
    use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_int, c_long, c_null_char, c_ptr
    use lagrangia_c_library, only: c_exit, c_fileno, c_fopen, c_fork, c_getpid, c_remove, c_waitpid
    use lagrangia_files, only: make_folders
    implicit none (type, external)
    private
    public :: clean_up, contents, exit_status, limit_file_size, limit_stack, new_folder, &
              remove_file, send_stdout_to, write_file
    public :: c_dup2, c_link, c_pipe, c_raise, c_symlink

    ! allow(assumed-size): C takes the address of the first element
    interface
        function c_dup2(old, new) bind(c, name="dup2") result(status)
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: old, new
            integer(c_int) :: status
        end function c_dup2

        function c_pipe(descriptors) bind(c, name="pipe") result(status)
            import :: c_int
            implicit none (type, external)
            integer(c_int), intent(out) :: descriptors(2)
            integer(c_int) :: status
        end function c_pipe

        function c_link(old, new) bind(c, name="link") result(status)
            import :: c_char, c_int
            implicit none (type, external)
            character(kind=c_char), intent(in) :: old(*), new(*)
            integer(c_int) :: status
        end function c_link

        function c_symlink(old, new) bind(c, name="symlink") result(status)
            import :: c_char, c_int
            implicit none (type, external)
            character(kind=c_char), intent(in) :: old(*), new(*)
            integer(c_int) :: status
        end function c_symlink

        function c_raise(number) bind(c, name="raise") result(status)
            import :: c_int
            implicit none (type, external)
            integer(c_int), value :: number
            integer(c_int) :: status
        end function c_raise

        function c_setrlimit(resource, limits) bind(c, name="setrlimit") result(status)
            import :: c_int, c_long
            implicit none (type, external)
            integer(c_int), value :: resource
            integer(c_long), intent(in) :: limits(2)
            integer(c_int) :: status
        end function c_setrlimit
    end interface

    abstract interface
        function child_i() result(status)
            !! What a child process does; its exit status.
            implicit none (type, external)
            integer :: status
        end function child_i
    end interface

contains

    function new_folder(name) result(folder)
        !! An existing folder of this name that belongs to this process and its children, until
        !! `clean_up`.
        character(*), intent(in) :: name
        character(:), allocatable :: folder, culprit
        integer :: number

        folder = own_folder()//"/"//name
        call make_folders(folder, number, culprit)
    end function new_folder

    function own_folder() result(folder)
        !! That of this process, or of the one that it was forked from.
        character(:), allocatable :: folder
        character(1000) :: root
        integer, save :: pid = 0
        integer :: length, status

        call get_environment_variable("TMPDIR", root, length, status)
        if (status /= 0 .or. length == 0) root = "build"
        if (pid == 0) pid = int(c_getpid())
        write (root(len_trim(root) + 1:), "(ss, a, i0)") "/lagrangia-tests/", pid
        folder = trim(root)
    end function own_folder

    subroutine clean_up()
        !! Remove all folders that `new_folder` has made; for the end of the run.
        integer :: status

        call execute_command_line("rm -rf -- """//own_folder()//"""", exitstat=status)
    end subroutine clean_up

    subroutine write_file(path, text)
        !! Make a file that holds `text`.
        character(*), intent(in) :: path, text
        integer :: unit

        open (newunit=unit, file=path, access="stream", form="unformatted", status="replace", &
              action="write")
        write (unit) text
        close (unit)
    end subroutine write_file

    function contents(path) result(text)
        !! The bytes of a file; `(no file)` if there is none.
        character(*), intent(in) :: path
        character(:), allocatable :: text
        integer :: unit, length, status

        open (newunit=unit, file=path, access="stream", form="unformatted", status="old", &
              action="read", iostat=status)
        if (status /= 0) then
            text = "(no file)"
            return
        end if
        inquire (unit=unit, size=length)
        allocate (character(length) :: text)
        if (length > 0) read (unit) text
        close (unit)
    end function contents

    function remove_file(path) result(removed)
        !! Remove a file or an empty folder; false if there is none, or the folder is not empty.
        character(*), intent(in) :: path
        logical :: removed

        removed = c_remove(path//c_null_char) == 0
    end function remove_file

    function exit_status(child) result(status)
        !! Run `child` in a process of its own: its status, or 128 + the signal it died of.
        procedure(child_i) :: child
        integer :: status
        integer(c_int) :: pid, code
        character(:), allocatable :: folder

        folder = new_folder("")  ! ours, and not the child's
        status = -1
        pid = c_fork()
        if (pid == 0) call c_exit(int(child(), c_int))
        if (pid < 0) return
        pid = c_waitpid(pid, code, 0_c_int)
        status = ibits(code, 8, 8)
        if (ibits(code, 0, 7) /= 0) status = 128 + ibits(code, 0, 7)
    end function exit_status

    subroutine send_stdout_to(path)
        !! From now on stdout is this file.
        character(*), intent(in) :: path
        type(c_ptr) :: stream
        integer :: status

        stream = c_fopen(path//c_null_char, "w"//c_null_char)
        if (.not. c_associated(stream)) call c_exit(99_c_int)
        status = int(c_dup2(c_fileno(stream), 1_c_int))
    end subroutine send_stdout_to

    subroutine limit_file_size(bytes)
        !! From now on no file of this process can grow beyond `bytes`: a full disk without one.
        integer, intent(in) :: bytes
        integer :: status

        status = int(c_setrlimit(1_c_int, spread(int(bytes, c_long), 1, 2)))  ! RLIMIT_FSIZE
    end subroutine limit_file_size

    subroutine limit_stack(kilobytes)
        !! From now on the stack of this process cannot grow beyond so much.
        integer, intent(in) :: kilobytes
        integer :: status

        status = int(c_setrlimit(3_c_int, spread(1024_c_long*kilobytes, 1, 2)))  ! RLIMIT_STACK
    end subroutine limit_stack
end module test_scratch
