module lagrangia_shipped_files
    !! The files that the program carries with it, wherever it is started: those of `data/`, by
    !! their paths there. `.ci/embed.sh` puts them into `shipped_files.c`.
    use, intrinsic :: iso_c_binding, only: c_associated, c_int, c_ptr
    use lagrangia_errors, only: error_t
    use lagrangia_files, only: facts_t, fortran_text, look_at, read_whole_file
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: read_file_or_shipped, shipped_files, shipped_text

    integer(c_int), parameter :: path_part = 0, text_part = 1

    interface
        function c_shipped_file(i, part) bind(c, name="lagrangia_shipped_file") result(text)
            import :: c_int, c_ptr
            implicit none (type, external)
            integer(c_int), value :: i, part
            type(c_ptr) :: text
        end function c_shipped_file
    end interface

contains

    subroutine shipped_files(folder, paths)
        !! The paths of all files in one folder, in alphabetical order.
        character(*), intent(in) :: folder                  !! `data/scenes/`
        type(word_t), allocatable, intent(out) :: paths(:)  !! `data/scenes/atwood.nml`, ...
        type(word_t), allocatable :: found(:)
        character(:), allocatable :: path
        integer :: i, n, turn

        do turn = 1, 2  ! count, then copy
            i = 0
            n = 0
            do
                call get_part(i, path_part, path)
                if (.not. allocated(path)) exit
                i = i + 1
                if (index(path, folder) /= 1) cycle
                n = n + 1
                if (turn == 2) found(n)%text = path
            end do
            if (turn == 1) allocate (found(n))
        end do
        call move_alloc(found, paths)
    end subroutine shipped_files

    subroutine shipped_text(path, text)
        !! All bytes of the file that the program carries by this path.
        character(*), intent(in) :: path                !! as `shipped_files` has it
        character(:), allocatable, intent(out) :: text  !! not allocated: there is no such file
        character(:), allocatable :: other
        integer :: i

        i = 0
        do
            call get_part(i, path_part, other)
            if (.not. allocated(other)) return
            if (len(other) == len(path)) then
                if (other == path) exit
            end if
            i = i + 1
        end do
        call get_part(i, text_part, text)
    end subroutine shipped_text

    subroutine read_file_or_shipped(path, text, error)
        !! All bytes of a file; where the folder has none of this name, of that which the program
        !! carries. So a checkout's own files, changed or not, come before the program's.
        character(*), intent(in) :: path                  !! from the working folder
        character(:), allocatable, intent(out) :: text    !! its bytes
        type(error_t), allocatable, intent(out) :: error  !! as that of `read_whole_file`
        type(facts_t) :: facts

        facts = look_at(path)
        if (.not. facts%found) call shipped_text(path, text)
        if (.not. allocated(text)) call read_whole_file(path, text, error)
    end subroutine read_file_or_shipped

    subroutine get_part(i, part, text)
        !! A copy of the path or of the text of file `i`, counted from 0.
        integer, intent(in) :: i
        integer(c_int), intent(in) :: part
        character(:), allocatable, intent(out) :: text  !! not allocated: there is no such file
        type(c_ptr) :: found

        found = c_shipped_file(int(i, c_int), part)
        if (c_associated(found)) text = fortran_text(found)
    end subroutine get_part
end module lagrangia_shipped_files
