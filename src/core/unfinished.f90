module lagrangia_unfinished
    !! Which files are still being written: whoever ends the program early can remove them.
    use, intrinsic :: iso_c_binding, only: c_null_char
    use lagrangia_c_library, only: c_remove
    implicit none (type, external)
    private
    public :: forget, remember, remove_unfinished

    type :: name_t
        !! The name of a temporary file.
        character(:), allocatable :: text
    end type name_t

    type(name_t), allocatable :: unfinished(:)  !! temporaries that still exist

contains

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
