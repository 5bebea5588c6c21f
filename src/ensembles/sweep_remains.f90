module lagrangia_sweep_remains
    !! What a sweep that was interrupted has left: a file in which no block is yet is nothing to go
    !! on with, and in nobody's way.
    use, intrinsic :: iso_c_binding, only: c_associated, c_int, c_null_char, c_ptr, c_size_t
    use lagrangia_c_library, only: c_fclose, c_fileno, c_flock, c_fopen, c_fread, c_remove
    use lagrangia_files, only: facts_t, last_error, look_at
    use lagrangia_kinds, only: i8
    use lagrangia_number_reader, only: to_integer
    use lagrangia_sweep_store, only: mark, would_block
    implicit none (type, external)
    private
    public :: is_being_written, remove_if_empty

contains

    subroutine remove_if_empty(path)
        !! Remove a file that a sweep began and into which it has put no block, unless one is
        !! writing it at this moment; any other file stays. One without its header stays, too: a
        !! sweep that has just made it has not locked it yet.
        character(*), intent(in) :: path  !! of the file
        character(len(mark) + 20) :: start
        type(facts_t) :: facts
        type(c_ptr) :: stream
        integer :: got, status

        facts = look_at(path)
        if (.not. (facts%found .and. facts%regular)) return
        stream = c_fopen(path//c_null_char, "r"//c_null_char)
        if (.not. c_associated(stream)) return
        start = ""
        got = int(c_fread(start, 1_c_size_t, len(start, c_size_t), stream))
        if (c_flock(c_fileno(stream), 6_c_int) == 0) then
            if (facts%size == length_of_header(start(:got))) status = int(c_remove(path// &
                                                                                 c_null_char))
        end if
        status = int(c_fclose(stream))
    end subroutine remove_if_empty

    function is_being_written(path) result(yes)
        !! Another sweep has it open. Where the file system has no locks nobody knows.
        character(*), intent(in) :: path  !! of the file
        logical :: yes
        type(facts_t) :: facts
        type(c_ptr) :: stream
        integer :: status

        yes = .false.
        facts = look_at(path)
        if (.not. (facts%found .and. facts%regular)) return
        stream = c_fopen(path//c_null_char, "r"//c_null_char)
        if (.not. c_associated(stream)) return
        yes = c_flock(c_fileno(stream), 6_c_int) /= 0
        if (yes) yes = last_error() == would_block
        status = int(c_fclose(stream))
    end function is_being_written

    pure function length_of_header(start) result(length)
        !! The bytes before the first block; -1: no file of a sweep.
        character(*), intent(in) :: start  !! of the file
        integer(i8) :: length
        character(:), allocatable :: problem
        integer(i8) :: told
        integer :: digits, first

        length = -1
        first = len(mark) + 2
        if (index(start, mark) /= 1) return
        digits = index(start(min(first, len(start) + 1):), new_line("a")) - 1
        if (digits < 0) return
        call to_integer(start(first:first + digits - 1), told, problem)
        if (problem == "") length = first + digits + told
    end function length_of_header
end module lagrangia_sweep_remains
