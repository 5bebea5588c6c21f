module lagrangia_value_range
    !! What a picture must know of a column before it is drawn: where its values lie, how near to
    !! zero, how often they turn round; and how often there is none.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_kinds, only: dp, i8
    use lagrangia_number_class, only: is_nonzero
    implicit none (type, external)
    private
    public :: value_range_t, range_of

    type :: value_range_t
        !! Of the values that it has seen.
        real(dp) :: low = huge(1.0_dp), high = -huge(1.0_dp)
        real(dp) :: least = huge(1.0_dp)  !! smallest magnitude above zero
        integer(i8) :: count = 0          !! all values
        integer(i8) :: gaps = 0           !! what was no finite number, and is no value
        integer(i8) :: zeros = 0          !! those that are zero
        integer(i8) :: turns = 0          !! from rising to falling or back
        real(dp), private :: last = 0.0_dp, rise = 0.0_dp
    contains
        procedure :: see
        procedure :: largest
    end type value_range_t

contains

    elemental subroutine see(self, value)
        !! One more value, behind those before.
        class(value_range_t), intent(inout) :: self
        real(dp), intent(in) :: value  !! NaN or infinite: a gap
        real(dp) :: rise

        if (.not. ieee_is_finite(value)) then
            self%gaps = self%gaps + 1
            return
        end if
        self%low = min(self%low, value)
        self%high = max(self%high, value)
        if (is_nonzero(value)) then
            self%least = min(self%least, abs(value))
        else
            self%zeros = self%zeros + 1
        end if
        rise = value - self%last
        if (self%count > 0 .and. is_nonzero(rise)) then
            if ((rise > 0.0_dp .and. self%rise < 0.0_dp) .or. &
                (rise < 0.0_dp .and. self%rise > 0.0_dp)) self%turns = self%turns + 1
            self%rise = rise
        end if
        self%last = value
        self%count = self%count + 1
    end subroutine see

    elemental function largest(self) result(magnitude)
        !! The largest magnitude; 0 where nothing was seen.
        class(value_range_t), intent(in) :: self
        real(dp) :: magnitude

        magnitude = 0.0_dp
        if (self%count > 0) magnitude = max(abs(self%low), abs(self%high))
    end function largest

    pure function range_of(values) result(range)
        !! Of a whole column.
        real(dp), intent(in) :: values(:)  !! in their order
        type(value_range_t) :: range
        integer :: i

        do i = 1, size(values)
            call range%see(values(i))
        end do
    end function range_of
end module lagrangia_value_range
