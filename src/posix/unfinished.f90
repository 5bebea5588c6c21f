module lagrangia_unfinished
    !! Which files are still being written: whoever ends the program early can remove them; and
    !! after `kill -9`, when nobody could, the next run that writes the same file does.
    use, intrinsic :: iso_c_binding, only: c_associated, c_int, c_null_char, c_null_ptr, c_ptr
    use lagrangia_c_library, only: c_chmod, c_fclose, c_fileno, c_flock, c_fopen, c_remove
    use lagrangia_files, only: e_exists, facts_t, last_error, look_at, same_file
    use lagrangia_text, only: to_text, word_t
    implicit none (type, external)
    private
    public :: create, forget, is_creating, remove_abandoned, remove_unfinished

    integer, parameter :: mark = int(o"1000")  !! S_ISVTX, which nobody gives to a regular file

    type(word_t), allocatable :: unfinished(:)  !! temporaries that still exist, NUL behind
    logical, volatile :: creating = .false.     !! one exists, perhaps, that is not in the list

contains

    function is_creating() result(yes)
        !! Whether a signal came at a moment at which `remove_unfinished` might miss one.
        logical :: yes

        yes = creating
    end function is_creating

    subroutine create(name, stream, facts, number)
        !! Make the file `name`, which there is not yet, and lock it until it is closed. It counts
        !! as unfinished until it is forgotten, and is marked as ours.
        character(*), intent(in) :: name     !! of the temporary
        type(c_ptr), intent(out) :: stream   !! open for writing; null if `number` is not 0
        type(facts_t), intent(out) :: facts  !! about it, but for the mark
        integer, intent(out) :: number       !! 0, or why not; e_exists: another name may do
        integer :: status

        creating = .true.
        ! x: never somebody else's file; e: not inherited by the programs we run
        stream = c_fopen(name//c_null_char, "wxe"//c_null_char)
        number = 0
        if (.not. c_associated(stream)) then
            number = last_error()
        else if (claimed(stream, name)) then
            call remember(name)
            facts = look_at(name)
            if (facts%found) status = int(c_chmod(name//c_null_char, &
                                                  int(ior(facts%permissions, mark), c_int)))
        else
            number = e_exists
            status = int(c_fclose(stream))
            stream = c_null_ptr
        end if
        creating = .false.
    end subroutine create

    function claimed(stream, name)
        !! Lock the file that was made just now. False if in the meantime another run thought it
        !! abandoned, and removed it.
        type(c_ptr), intent(in) :: stream
        character(*), intent(in) :: name
        logical :: claimed
        type(facts_t) :: facts
        integer :: status

        status = int(c_flock(c_fileno(stream), 2_c_int))  ! fails where there are no locks
        facts = look_at(descriptor_name(stream))
        claimed = same_file(descriptor_name(stream), name) .or. .not. facts%found
    end function claimed

    subroutine remove_abandoned(name)
        !! Remove the temporary `name` if there is one with our mark and nobody holds its lock: the
        !! run that made it is gone. Where the file system has no locks, or no marks, it stays.
        character(*), intent(in) :: name  !! of a temporary, which need not exist
        type(facts_t) :: facts
        type(c_ptr) :: stream
        integer :: status

        facts = look_at(name, follow=.false.)
        if (.not. facts%regular .or. iand(facts%permissions, mark) == 0) return
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
        !! program that failed or was interrupted, also from a signal handler. Allocates nothing.
        integer :: i, status

        if (.not. allocated(unfinished)) return
        do i = 1, size(unfinished)
            if (.not. allocated(unfinished(i)%text)) cycle
            status = int(c_remove(unfinished(i)%text))
        end do
    end subroutine remove_unfinished

    subroutine remember(name)
        !! Put `name` in a free place among the unfinished files.
        character(*), intent(in) :: name
        type(word_t), allocatable :: longer(:)
        integer :: i, count

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
        unfinished(i)%text = name//c_null_char
    end subroutine remember

    subroutine forget(name)
        !! Take `name` off the unfinished files.
        character(*), intent(in) :: name  !! as `create` had it
        integer :: i

        do i = 1, size(unfinished)
            if (.not. allocated(unfinished(i)%text)) cycle
            if (unfinished(i)%text == name//c_null_char) deallocate (unfinished(i)%text)
        end do
    end subroutine forget
end module lagrangia_unfinished
