module funit_exceptions
    !! What the assertions of the running test have recorded, oldest first.
    use funit_locations, only: SourceLocation, call_site, location_text
    implicit none (type, external)
    private
    public :: anyExceptions, caught, clear_exceptions, exception_count, exception_place, &
              exception_text, throw

    type :: text_t
        !! One message; lists of messages grow without copying their characters.
        character(:), allocatable :: text, place
    end type text_t

    type(text_t), allocatable :: thrown(:)
    integer :: exception_count = 0

contains

    subroutine throw(message, location)
        !! Record a failure; the test goes on.
        character(*), intent(in) :: message
        type(SourceLocation), intent(in), optional :: location  !! from the call stack if absent
        type(text_t), allocatable :: longer(:)
        integer :: i

        if (.not. allocated(thrown)) allocate (thrown(4))
        if (exception_count == size(thrown)) then
            allocate (longer(2*exception_count))
            do i = 1, exception_count
                call move_alloc(thrown(i)%text, longer(i)%text)
                call move_alloc(thrown(i)%place, longer(i)%place)
            end do
            call move_alloc(longer, thrown)
        end if
        exception_count = exception_count + 1
        thrown(exception_count)%text = trim(message)
        if (present(location)) then
            thrown(exception_count)%place = location_text(location)
        else
            thrown(exception_count)%place = call_site()
        end if
    end subroutine throw

    function exception_text(i) result(text)
        !! The message recorded as number `i`.
        integer, intent(in) :: i
        character(:), allocatable :: text

        text = thrown(i)%text
    end function exception_text

    function exception_place(i) result(text)
        !! Where number `i` was recorded, as `[file:line]`.
        integer, intent(in) :: i
        character(:), allocatable :: text

        text = thrown(i)%place
    end function exception_place

    logical function anyExceptions()
        !! Whether an assertion of this test has failed.
        anyExceptions = exception_count > 0
    end function anyExceptions

    logical function caught(message)
        !! Take back the first failure that says `message`, or the last failure of all.
        character(*), intent(in), optional :: message
        integer :: i, found

        found = exception_count
        if (present(message)) then
            do found = 1, exception_count
                if (thrown(found)%text == message) exit
            end do
        end if
        caught = found >= 1 .and. found <= exception_count
        if (.not. caught) return
        do i = found, exception_count - 1
            call move_alloc(thrown(i + 1)%text, thrown(i)%text)
            call move_alloc(thrown(i + 1)%place, thrown(i)%place)
        end do
        exception_count = exception_count - 1
    end function caught

    subroutine clear_exceptions()
        !! Forget all failures.
        if (allocated(thrown)) deallocate (thrown)
        exception_count = 0
    end subroutine clear_exceptions
end module funit_exceptions
