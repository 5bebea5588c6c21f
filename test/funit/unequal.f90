module funit_unequal
    !! Assertions that two numbers differ.
    use, intrinsic :: iso_fortran_env, only: int32, int64, real64
    use funit_exceptions, only: throw
    use funit_locations, only: SourceLocation
    use funit_messages, only: headline, keyword_only, line
    implicit none (type, external)
    private
    public :: assertNotEqual

    interface assertNotEqual
        !! Fail if `actual` is `expected`, reals also within the tolerance (zero if absent) and if
        !! one of them is NaN.
        module procedure unequal_i32, unequal_i64, unequal_real
    end interface assertNotEqual

contains

    subroutine unequal_i32(expected, actual, unused, message, location)
        integer(int32), intent(in) :: expected, actual
        class(keyword_only), intent(in), optional :: unused
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location

        call unequal_i64(int(expected, int64), int(actual, int64), message=message, &
                         location=location)
    end subroutine unequal_i32

    subroutine unequal_i64(expected, actual, unused, message, location)
        integer(int64), intent(in) :: expected, actual
        class(keyword_only), intent(in), optional :: unused
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location
        character(20) :: same

        if (actual /= expected) return
        write (same, "(ss, i0)") actual
        call throw(headline("AssertNotEqual", [integer ::], message)// &
                   line("Same value", 14, "<"//trim(same)//">"), location)
    end subroutine unequal_i64

    subroutine unequal_real(expected, actual, tolerance, message, location)
        real(real64), intent(in) :: expected, actual
        real(real64), intent(in), optional :: tolerance
        character(*), intent(in), optional :: message
        type(SourceLocation), intent(in), optional :: location
        real(real64) :: t, difference
        character(45) :: same
        character(135) :: apart

        t = 0.0_real64
        if (present(tolerance)) t = tolerance
        difference = 0.0_real64  ! of two infinities, too
        if (actual < expected .or. actual > expected) then
            if (abs(actual - expected) > t) return
        end if
        if (.not. (actual <= expected .and. actual >= expected)) difference = actual - expected
        write (same, "(ss, g0)") actual
        write (apart, "(ss, '<', g0, '> (less than or equal to tolerance of ', g0, ')')") &
            difference, t
        call throw(headline("AssertNotEqual", [integer ::], message)// &
                   line("Same value", 14, "<"//trim(same)//">")// &
                   line("Difference", 14, trim(apart)), location)
    end subroutine unequal_real
end module funit_unequal
