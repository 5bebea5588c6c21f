module lagrangia_files
    !! What a name stands for on disk, the folders above it, and the words for what went wrong.
    use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_f_procpointer, &
        c_funloc, c_funptr, c_int, c_null_char, c_null_ptr, c_ptr, c_size_t
    use lagrangia_c_library, only: c_errno, c_fclose, c_fileno, c_fopen, c_fread, c_free, &
        c_lstat, c_mkdir, c_realpath, c_stat, c_strerror, c_strlen
    use lagrangia_errors, only: error_t, fail, status_file
    use lagrangia_kinds, only: i8
    use lagrangia_text, only: short_source, to_text
    implicit none (type, external)
    private
    public :: facts_t, folder_of, fortran_text, hold_standard_units, last_error, look_at, &
              make_folders, plain_path, read_whole_file, reason, resolved, same_file
    public :: most_bytes
    public :: e_bad_unit, e_broken_pipe, e_exists, e_invalid, e_missing

    integer, parameter :: most_bytes = 1048576  !! of a file that `read_whole_file` reads

    integer, parameter :: e_missing = 2       !! ENOENT; these are the same on every Unix
    integer, parameter :: e_input_output = 5  !! EIO
    integer, parameter :: e_bad_unit = 9      !! EBADF
    integer, parameter :: e_exists = 17       !! EEXIST
    integer, parameter :: e_no_folder = 20    !! ENOTDIR
    integer, parameter :: e_invalid = 22      !! EINVAL
    integer, parameter :: e_broken_pipe = 32  !! EPIPE

    integer(i8), parameter :: type_bits = int(o"170000", i8)     !! S_IFMT
    integer(i8), parameter :: folder_bits = int(o"040000", i8)   !! S_IFDIR
    integer(i8), parameter :: regular_bits = int(o"100000", i8)  !! S_IFREG
    integer(i8), parameter :: link_bits = int(o"120000", i8)     !! S_IFLNK

    type :: facts_t
        !! What the system says of a name.
        logical :: found = .false.    !! something has this name
        integer :: status = 0         !! otherwise the system's error number
        logical :: barred = .false.   !! nobody knows: a closed folder, a loop of links
        logical :: folder = .false.   !! it is a folder
        logical :: regular = .false.  !! it is a regular file
        logical :: link = .false.     !! it is a symbolic link (only if links are not followed)
        integer :: permissions = 0    !! its permission bits
        integer(i8) :: size = -1      !! in bytes
        integer(i8) :: device = -1    !! with `inode`, which file it is
        integer(i8) :: inode = -1
    end type facts_t

    abstract interface
        subroutine stat_i(name, values, status)
            !! `stat` as gfortran calls it.
            import :: i8
            implicit none (type, external)
            character(*), intent(in) :: name
            integer(i8), intent(inout) :: values(:)
            integer(i8), intent(out) :: status
        end subroutine stat_i
    end interface

contains

    function look_at(path, follow) result(facts)
        !! What `path` is; links are followed unless `follow` is false.
        !!
        !! The layout of C's `struct stat` differs from system to system. libgfortran's `stat`
        !! knows it, but as a Fortran intrinsic it is hidden by `-std=f2018`: so it is reached by
        !! its symbol, and called through a pointer whose interface is gfortran's own.
        character(*), intent(in) :: path         !! every blank counts
        logical, intent(in), optional :: follow  !! links; true unless given
        type(facts_t) :: facts
        procedure(stat_i), pointer :: ask
        integer(i8) :: values(13), status
        type(c_funptr) :: address

        address = c_funloc(c_stat)
        if (present(follow)) then
            if (.not. follow) address = c_funloc(c_lstat)
        end if
        call c_f_procpointer(address, ask)
        call ask(path//c_null_char, values, status)
        facts%found = status == 0
        facts%status = int(status)
        facts%barred = all(facts%status /= [0, e_missing, e_no_folder])
        if (.not. facts%found) return
        facts%device = values(1)
        facts%inode = values(2)
        facts%size = values(8)
        facts%permissions = int(iand(values(3), int(o"7777", i8)))
        facts%folder = iand(values(3), type_bits) == folder_bits
        facts%regular = iand(values(3), type_bits) == regular_bits
        facts%link = iand(values(3), type_bits) == link_bits
    end function look_at

    function same_file(path1, path2) result(same)
        !! Whether both names lead to one existing file, through links of either kind too.
        character(*), intent(in) :: path1, path2  !! every blank counts
        logical :: same
        type(facts_t) :: facts1, facts2

        facts1 = look_at(path1)
        facts2 = look_at(path2)
        same = facts1%found .and. facts2%found .and. facts1%device == facts2%device &
               .and. facts1%inode == facts2%inode
    end function same_file

    pure function folder_of(path) result(folder)
        !! All of `path` before its last slash; `.` if there is none.
        character(*), intent(in) :: path  !! of a file, which need not exist
        character(:), allocatable :: folder
        integer :: slash

        slash = index(path, "/", back=.true.)
        select case (slash)
        case (0)
            folder = "."
        case (1)
            folder = "/"
        case default
            folder = path(:slash - 1)
        end select
    end function folder_of

    pure function plain_path(path) result(plain)
        !! The same file by a name whose first character means nothing to any program: `./` before
        !! a relative one, lest `-x`, `<x` and `|x` be taken for an option or a command.
        character(*), intent(in) :: path  !! of a file, which need not exist
        character(:), allocatable :: plain

        plain = path
        if (index(path, "/") /= 1) plain = "./"//path
    end function plain_path

    subroutine make_folders(folder, number, culprit)
        !! Make `folder` and those above it where they are missing, as `mkdir -p` does.
        character(*), intent(in) :: folder                 !! every blank counts
        integer, intent(out) :: number                     !! 0, or the system's error number
        character(:), allocatable, intent(out) :: culprit  !! what could not be made
        type(facts_t) :: facts
        integer :: last

        number = 0
        do last = 1, len(folder)
            if (last < len(folder)) then
                if (folder(last + 1:last + 1) /= "/") cycle
            end if
            facts = look_at(folder(:last))
            if (facts%folder) cycle
            if (c_mkdir(folder(:last)//c_null_char, int(o"777", c_int)) == 0) cycle
            number = last_error()
            facts = look_at(folder(:last))  ! another process may have been quicker
            if (facts%folder) then
                number = 0
                cycle
            end if
            culprit = folder(:last)
            return
        end do
    end subroutine make_folders

    function resolved(path) result(target_path)
        !! Where `path` leads when all links are followed; empty if nowhere.
        character(*), intent(in) :: path  !! every blank counts
        character(:), allocatable :: target_path
        type(c_ptr) :: text

        text = c_realpath(path//c_null_char, c_null_ptr)
        if (.not. c_associated(text)) then
            target_path = ""
            return
        end if
        target_path = fortran_text(text)
        call c_free(text)
    end function resolved

    function reason(number) result(text)
        !! The system's words for an error number.
        integer, intent(in) :: number  !! C's `errno`
        character(:), allocatable :: text

        text = fortran_text(c_strerror(int(number, c_int)))
    end function reason

    function last_error() result(number)
        !! The number of the C call that failed just now; never 0.
        integer :: number

        number = int(c_errno())
        if (number == 0) number = e_input_output
    end function last_error

    function fortran_text(text) result(copy)
        !! A copy of C's null-terminated text.
        type(c_ptr), intent(in) :: text  !! not null
        character(:), allocatable :: copy
        character(kind=c_char), pointer :: letters(:)
        integer :: i, length

        length = int(c_strlen(text))
        call c_f_pointer(text, letters, [length])
        allocate (character(length) :: copy)
        do i = 1, length
            copy(i:i) = letters(i)
        end do
    end function fortran_text

    subroutine read_whole_file(path, text, error)
        !! All bytes of a regular file. Directories, FIFOs, terminals and devices are refused
        !! without waiting.
        character(*), intent(in) :: path                  !! its name, every blank of it counts
        character(:), allocatable, intent(out) :: text    !! its bytes, at most `most_bytes`
        type(error_t), allocatable, intent(out) :: error  !! names the file
        character(:), allocatable :: problem
        type(facts_t) :: facts

        problem = ""
        if (len(path) == 0) then
            problem = "the name of the file is empty"
        else if (index(path, c_null_char) > 0) then
            problem = "the name of the file holds a NUL byte"
        else
            facts = look_at(path)
            if (facts%barred) then
                problem = reason(facts%status)
            else if (.not. facts%found) then
                problem = "no such file"
            else if (facts%folder) then
                problem = "is a folder; a file is needed"
            else if (.not. facts%regular) then
                problem = "not a regular file"
            else
                call read_regular_file(path, facts%size, text, problem)
            end if
        end if
        if (len(problem) == 0) return
        if (len(path) > 0) problem = trim(short_source(path))//": "//problem
        call fail(error, problem, status_file)
    end subroutine read_whole_file

    subroutine read_regular_file(path, size, text, problem)
        !! The bytes of a file of this size; a file that holds more or fewer, as those that the
        !! system makes up do, is not taken.
        character(*), intent(in) :: path
        integer(i8), intent(in) :: size
        character(:), allocatable, intent(out) :: text, problem
        character(:), allocatable :: bytes
        integer :: status
        integer(c_size_t) :: got
        type(c_ptr) :: stream

        problem = ""
        stream = c_fopen(path//c_null_char, "r"//c_null_char)
        if (.not. c_associated(stream)) then
            problem = "the file cannot be opened; may it be read?"
            return
        end if
        allocate (character(int(min(size, int(most_bytes, i8))) + 1) :: bytes)
        got = c_fread(bytes, 1_c_size_t, int(len(bytes), c_size_t), stream)
        status = int(c_fclose(stream))
        if (size > most_bytes) then
            problem = "the file is longer than "//to_text(most_bytes)//" bytes"
        else if (got /= size) then
            problem = "not a regular file"
        else
            text = bytes(:int(got))
        end if
    end subroutine read_regular_file

    subroutine hold_standard_units()
        !! Fill the places of a closed stdin, stdout or stderr (`>&-`) with an unwritable file, lest
        !! the next file opened take one of them and receive what is meant for the screen.
        type(c_ptr) :: stream
        integer :: status

        do
            stream = c_fopen("/dev/null"//c_null_char, "r"//c_null_char)
            if (.not. c_associated(stream)) return
            if (c_fileno(stream) > 2) exit
        end do
        status = int(c_fclose(stream))
    end subroutine hold_standard_units
end module lagrangia_files
