module funit_relative
    !! The assertion that numbers are relatively equal. NaN fails.
    use, intrinsic :: iso_fortran_env, only: real64
    use funit_exceptions, only: throw
    use funit_locations, only: SourceLocation
    use funit_messages, only: conformable, fail_reals, headline, place
    implicit none (type, external)
    private
    public :: assertRelativelyEqual

    interface assertRelativelyEqual
        !! Fail unless `abs(actual - expected) <= tolerance*abs(expected)`; a zero `expected` fails.
        module procedure close_real, close_real_reals, close_reals, close_matrices
    end interface assertRelativelyEqual

contains

    subroutine close_real(expected, actual, tolerance, message, location)
        real(real64), intent(in) :: expected, actual, tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call check_relatively([expected], [actual], [integer ::], tolerance, message, location)
    end subroutine close_real

    subroutine close_real_reals(expected, actual, tolerance, message, location)
        real(real64), intent(in) :: expected, actual(:), tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call check_relatively(spread(expected, 1, size(actual)), actual, shape(actual), &
                              tolerance, message, location)
    end subroutine close_real_reals

    subroutine close_reals(expected, actual, tolerance, message, location)
        real(real64), intent(in) :: expected(:), actual(:), tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        if (.not. conformable(shape(expected), shape(actual), message, location)) return
        call check_relatively(expected, actual, shape(actual), tolerance, message, location)
    end subroutine close_reals

    subroutine close_matrices(expected, actual, tolerance, message, location)
        real(real64), intent(in) :: expected(:, :), actual(:, :), tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        if (.not. conformable(shape(expected), shape(actual), message, location)) return
        call check_relatively(reshape(expected, [size(actual)]), reshape(actual, [size(actual)]), &
                              shape(actual), tolerance, message, location)
    end subroutine close_matrices

    subroutine check_relatively(expected, actual, extents, tolerance, message, location)
        !! Arrays come flattened; `extents` is their shape, empty for scalars.
        real(real64), intent(in) :: expected(:), actual(:)
        integer, intent(in) :: extents(:)
        real(real64), intent(in) :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location
        integer :: i

        if (any(abs(expected) <= 0.0_real64)) then
            call throw(headline("Zero denominator detected in AssertRelativelyEqual.", &
                                [integer ::], message), location)
            return
        end if
        i = findloc(abs(actual - expected) <= tolerance*abs(expected), .false., dim=1)
        if (i == 0) return
        call fail_reals("AssertRelativelyEqual", "    Rel. difference", expected(i), actual(i), &
                        (actual(i) - expected(i))/expected(i), tolerance, &
                        place(i, extents), message, location)
    end subroutine check_relatively
end module funit_relative
