module funit_claims
    !! Assertions about conditions, shapes, finiteness, and about failures themselves.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use, intrinsic :: iso_fortran_env, only: real64
    use funit_exceptions, only: caught, throw
    use funit_messages, only: list
    implicit none (type, external)
    private
    public :: assertExceptionRaised, assertFail, assertFalse, assertIsFinite, assertSameShape, &
              assertTrue

    interface assertTrue
        !! Fail unless the condition, or every condition, is true.
        module procedure assert_true, assert_all_true
    end interface assertTrue

    interface assertFalse
        !! Fail unless the condition, or every condition, is false.
        module procedure assert_false, assert_all_false
    end interface assertFalse

contains

    subroutine assertFail(message)
        !! Fail.
        character(*), intent(in) :: message

        call throw(message)
    end subroutine assertFail

    subroutine assert_true(condition, message)
        logical, intent(in) :: condition
        character(*), intent(in), optional :: message

        if (condition) return
        if (present(message)) then
            call throw(message)
        else
            call throw("")
        end if
    end subroutine assert_true

    subroutine assert_all_true(condition, message)
        logical, intent(in) :: condition(:)
        character(*), intent(in), optional :: message

        call assert_true(all(condition), message)
    end subroutine assert_all_true

    subroutine assert_false(condition, message)
        logical, intent(in) :: condition
        character(*), intent(in), optional :: message

        call assert_true(.not. condition, message)
    end subroutine assert_false

    subroutine assert_all_false(condition, message)
        logical, intent(in) :: condition(:)
        character(*), intent(in), optional :: message

        call assert_true(.not. any(condition), message)
    end subroutine assert_all_false

    subroutine assertIsFinite(x, message)
        !! Fail if `x` is infinite or not a number.
        real(real64), intent(in) :: x
        character(*), intent(in), optional :: message

        call assert_true(ieee_is_finite(x), message)
    end subroutine assertIsFinite

    subroutine assertSameShape(shapeA, shapeB, message)
        !! Fail unless two shapes agree; the shape of a scalar agrees with any.
        integer, intent(in) :: shapeA(:), shapeB(:)
        character(*), intent(in), optional :: message
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
        call throw(text)
    end subroutine assertSameShape

    subroutine assertExceptionRaised(message)
        !! Take back a failure, the one that says `message` if given; fail if there is none.
        character(*), intent(in), optional :: message

        if (caught(message)) return
        if (present(message)) then
            call throw("Failed to throw exception: <"//trim(message)//">")
        else
            call throw("Failed to throw exception.")
        end if
    end subroutine assertExceptionRaised
end module funit_claims
