module lagrangia_unfinished
    !! Which files are still being written: whoever ends the program early can remove them; and
    !! after `kill -9`, when nobody could, the next run that writes the same file does.
    use, intrinsic :: iso_c_binding, only: c_associated, c_int, c_null_char, c_ptr
    use lagrangia_c_library, only: c_fclose, c_fileno, c_flock, c_fopen, c_remove
    use lagrangia_files, only: facts_t, look_at, same_file
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: claim, forget, remember, remove_abandoned, remove_unfinished

    type :: name_t
        !! The name of a temporary file.
        character(:), allocatable :: text
    end type name_t

    type(name_t), allocatable :: unfinished(:)  !! temporaries that still exist

contains

    function claim(stream, name) result(ours)
        !! Lock the file `name`, which was made just now and is open as `stream`, until it is
        !! closed. False if in the meantime another run thought it abandoned, and removed it.
        type(c_ptr), intent(in) :: stream
        character(*), intent(in) :: name
        logical :: ours
        type(facts_t) :: facts
        integer :: status

        status = int(c_flock(c_fileno(stream), 2_c_int))  ! fails where there are no locks
        facts = look_at(descriptor_name(stream))
        ours = same_file(descriptor_name(stream), name) .or. .not. facts%found
    end function claim

    subroutine remove_abandoned(name)
        !! Remove the temporary `name` if there is one and nobody holds its lock: the run that
        !! made it is gone. Where the file system has no locks it stays.
        character(*), intent(in) :: name
        type(c_ptr) :: stream
        integer :: status

        stream = c_fopen(name//c_null_char, "r+e"//c_null_char)
        if (.not. c_associated(stream)) return
        if (c_flock(c_fileno(stream), 6_c_int) == 0) then
            ! it may have been finished, and the name be another's, before we had the lock
            if (same_file(descriptor_name(stream), name)) status = int(c_remove(name//c_null_char))
        end if
        status = int(c_fclose(stream))
    end subroutine remove_abandoned

    function descriptor_name(stream) result(name)
        !! A name for the open file itself, whatever has become of the one it was opened by.
        type(c_ptr), intent(in) :: stream
        character(:), allocatable :: name

        name = "/dev/fd/"//to_text(int(c_fileno(stream)))
    end function descriptor_name

    subroutine remove_unfinished()
        !! Remove every temporary that was neither committed nor abandoned: the last act of a
        !! program that failed or was interrupted.
        integer :: i, status

        if (.not. allocated(unfinished)) return
        do i = 1, size(unfinished)
            if (.not. allocated(unfinished(i)%text)) cycle
            status = int(c_remove(unfinished(i)%text//c_null_char))
            deallocate (unfinished(i)%text)
        end do
    end subroutine remove_unfinished

    subroutine remember(name)
        !! Put `name` in a free place among the unfinished files.
        character(*), intent(in) :: name
        type(name_t), allocatable :: longer(:)
        integer :: i, count

        !$omp critical (lagrangia_unfinished)
        if (.not. allocated(unfinished)) allocate (unfinished(0))
        count = size(unfinished)
        do i = 1, count
            if (.not. allocated(unfinished(i)%text)) exit
        end do
        if (i > count) then
            allocate (longer(2*count + 1))
            do i = 1, count
                call move_alloc(unfinished(i)%text, longer(i)%text)
            end do
            call move_alloc(longer, unfinished)
            i = count + 1
        end if
        unfinished(i)%text = name
        !$omp end critical (lagrangia_unfinished)
    end subroutine remember

    subroutine forget(name)
        !! Take `name` off the unfinished files.
        character(*), intent(in) :: name
        integer :: i

        !$omp critical (lagrangia_unfinished)
        do i = 1, size(unfinished)
            if (.not. allocated(unfinished(i)%text)) cycle
            if (unfinished(i)%text == name) deallocate (unfinished(i)%text)
        end do
        !$omp end critical (lagrangia_unfinished)
    end subroutine forget
end module lagrangia_unfinished
