module funit_messages
    !! The words in which an assertion fails.
    use funit_exceptions, only: throw
    implicit none (type, external)
    private
    public :: conformable, headline, keyword_only, line, list

    type, abstract :: keyword_only
        !! No object can have this type: arguments after one of it are given by keyword.
    end type keyword_only

    character(*), parameter :: nl = new_line("a")

contains

    logical function conformable(expected, actual, message)
        !! Whether two arrays of one rank have the same shape; record a failure if not.
        integer, intent(in) :: expected(:), actual(:)  !! shapes
        character(*), intent(in), optional :: message

        conformable = all(expected == actual)
        if (.not. conformable) then
            call throw(headline("Arrays not conformable", [integer ::], message) &
                       //line("Expected shape", 18, list(expected)) &
                       //line("Actual shape", 18, list(actual)))
        end if
    end function conformable

    function headline(claim, at, message) result(text)
        !! The caller's message on a line of its own, then which claim failed.
        character(*), intent(in) :: claim
        integer, intent(in) :: at(:)  !! index of the element that failed; empty for a scalar
        character(*), intent(in), optional :: message
        character(:), allocatable :: text

        text = claim//" failure:"
        if (size(at) > 0) text = "Array"//text
        if (present(message)) text = message//nl//text
    end function headline

    function line(label, width, value) result(text)
        !! A new line `label: value`, the label set right in `width` columns.
        character(*), intent(in) :: label, value
        integer, intent(in) :: width
        character(:), allocatable :: text

        text = nl//repeat(" ", max(0, width - len(label)))//label//": "//value
    end function line

    function list(numbers) result(text)
        !! A shape or an index, as in `[2,3]`.
        integer, intent(in) :: numbers(:)
        character(:), allocatable :: text
        character(80) :: buffer

        buffer = "0"
        if (size(numbers) > 0) write (buffer, "(i0, *(:, ',', i0))") numbers
        text = "["//trim(buffer)//"]"
    end function list
end module funit_messages
