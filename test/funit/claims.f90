module funit_claims
    !! Assertions about conditions, shapes, finiteness, and about failures themselves.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
    use, intrinsic :: iso_fortran_env, only: real64
    use funit_exceptions, only: caught, throw
    use funit_locations, only: SourceLocation
    use funit_messages, only: list
    implicit none (type, external)
    private
    public :: assertExceptionRaised, assertFail, assertFalse, assertIsFinite, assertIsNaN, &
              assertSameShape, assertTrue

    interface assertTrue
        !! Fail unless the condition, or every condition, is true.
        module procedure assert_true, assert_all_true
    end interface assertTrue

    interface assertFalse
        !! Fail unless the condition, or every condition, is false.
        module procedure assert_false, assert_all_false
    end interface assertFalse

contains

    subroutine assertFail(message, location)
        !! Fail.
        character(*), intent(in) :: message
        type(SourceLocation), intent(in), optional :: location

        call throw(message, location)
    end subroutine assertFail

    subroutine assert_true(condition, message, location)
        logical, intent(in) :: condition
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        if (condition) return
        if (present(message)) then
            call throw(message, location)
        else
            call throw("", location)
        end if
    end subroutine assert_true

    subroutine assert_all_true(condition, message, location)
        logical, intent(in) :: condition(:)
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call assert_true(all(condition), message, location)
    end subroutine assert_all_true

    subroutine assert_false(condition, message, location)
        logical, intent(in) :: condition
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call assert_true(.not. condition, message, location)
    end subroutine assert_false

    subroutine assert_all_false(condition, message, location)
        logical, intent(in) :: condition(:)
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call assert_true(.not. any(condition), message, location)
    end subroutine assert_all_false

    subroutine assertIsFinite(x, message, location)
        !! Fail if `x` is infinite or not a number.
        real(real64), intent(in) :: x
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call assert_true(ieee_is_finite(x), message, location)
    end subroutine assertIsFinite

    subroutine assertIsNaN(x, message, location)
        !! Fail if `x` is a number.
        real(real64), intent(in) :: x
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call assert_true(ieee_is_nan(x), message, location)
    end subroutine assertIsNaN

    subroutine assertSameShape(shapeA, shapeB, message, location)
        !! Fail unless two shapes agree; the shape of a scalar agrees with any.
        integer, intent(in) :: shapeA(:), shapeB(:)
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location
        character(:), allocatable :: text

        if (size(shapeA) == 0 .or. size(shapeB) == 0) return
        if (size(shapeA) == size(shapeB)) then
            if (all(shapeA == shapeB)) return
        end if
        text = "nonconforming arrays - expected shape: "//list(shapeA) &
               //" but found shape: "//list(shapeB)
        if (present(message)) then
            if (len_trim(message) > 0) text = trim(message)//" "//text
        end if
        call throw(text, location)
    end subroutine assertSameShape

    subroutine assertExceptionRaised(message, location)
        !! Take back a failure, the one that says `message` if given; fail if there is none.
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        if (caught(message)) return
        if (present(message)) then
            call throw("Failed to throw exception: <"//trim(message)//">", location)
        else
            call throw("Failed to throw exception.", location)
        end if
    end subroutine assertExceptionRaised
end module funit_claims
