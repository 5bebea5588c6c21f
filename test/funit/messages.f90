module funit_messages
    !! The words in which an assertion fails.
    use, intrinsic :: iso_fortran_env, only: real64
    use funit_exceptions, only: throw
    use funit_locations, only: SourceLocation
    implicit none (type, external)
    private
    public :: comparison, conformable, fail_reals, headline, keyword_only, line, list, place

    type, abstract :: keyword_only
        !! No object can have this type: arguments after one of it are given by keyword.
    end type keyword_only

    character(*), parameter :: nl = new_line("a")

contains

    logical function conformable(expected, actual, message, location)
        !! Whether two arrays of one rank have the same shape; record a failure if not.
        integer, intent(in) :: expected(:), actual(:)  !! shapes
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        conformable = all(expected == actual)
        if (.not. conformable) then
            call throw(headline("Arrays not conformable", [integer ::], message) &
                       //line("Expected shape", 18, list(expected)) &
                       //line("Actual shape", 18, list(actual)), location)
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
        if (size(numbers) > 0) write (buffer, "(ss, i0, *(:, ',', i0))") numbers
        text = "["//trim(buffer)//"]"
    end function list

    subroutine fail_reals(claim, label, expected, actual, difference, tolerance, at, message, &
                          location)
        !! Say how far apart two numbers are.
        character(*), intent(in) :: claim, label
        real(real64), intent(in) :: expected, actual, difference, tolerance
        integer, intent(in) :: at(:)
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location
        character(45) :: wanted, got
        character(135) :: apart

        write (wanted, "(ss, g0)") expected
        write (got, "(ss, g0)") actual
        write (apart, "(ss, '<', g0, '> (greater than tolerance of ', g0, ')')") &
            difference, tolerance
        call throw(headline(claim, at, message)//comparison(wanted, got, label, apart, at), &
                   location)
    end subroutine fail_reals

    function comparison(expected, actual, label, difference, at) result(text)
        !! What was expected, what was found, how they differ and where.
        character(*), intent(in) :: expected, actual, label, difference
        integer, intent(in) :: at(:)
        character(:), allocatable :: text

        text = line("Expected", len(label), "<"//trim(expected)//">") &
               //line("Actual", len(label), "<"//trim(actual)//">") &
               //line(label, len(label), trim(difference))
        if (size(at) > 0) text = text//line("at index", 14, list(at))
    end function comparison

    pure function place(i, extents) result(at)
        !! The index of element `i`, in array element order, of an array of shape `extents`.
        integer, intent(in) :: i, extents(:)
        integer :: at(size(extents))
        integer :: before, k

        before = i - 1
        do k = 1, size(extents)
            at(k) = modulo(before, extents(k)) + 1
            before = before/extents(k)
        end do
    end function place
end module funit_messages
