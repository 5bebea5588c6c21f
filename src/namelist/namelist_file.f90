module lagrangia_namelist_file
    !! A whole file at once, and regular files only: libgfortran's READ blocks on a FIFO, takes a
    !! directory for an empty file and /dev/zero for an endless one.
    use, intrinsic :: iso_c_binding, only: c_associated, c_null_char, c_ptr, c_size_t
    use lagrangia_c_library, only: c_fclose, c_fopen, c_fread
    use lagrangia_errors, only: error_t, fail, status_file
    use lagrangia_files, only: facts_t, look_at
    use lagrangia_kinds, only: i8
    use lagrangia_namelist_tree, only: short_source
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: most_bytes, read_whole_file

    integer, parameter :: most_bytes = 1048576  !! of a file that is read

contains

    subroutine read_whole_file(path, text, error)
        !! All bytes of a regular file. Directories, FIFOs, terminals and devices are refused
        !! without waiting.
        character(*), intent(in) :: path                    !! its name, every blank of it counts
        character(:), allocatable, intent(out) :: text      !! its bytes, at most `most_bytes`
        type(error_t), allocatable, intent(out) :: error    !! names the file
        character(:), allocatable :: problem
        type(facts_t) :: facts

        problem = ""
        if (len(path) == 0) then
            problem = "the name of the file is empty"
        else if (index(path, c_null_char) > 0) then
            problem = "the name of the file holds a NUL byte"
        else
            facts = look_at(path)
            if (.not. facts%found) then
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
end module lagrangia_namelist_file
