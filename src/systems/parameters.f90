module lagrangia_parameters
    !! Parameters as data: their defaults, and what is allowed.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
    use lagrangia_description, only: description_t, parameter_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_kinds, only: dp
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: check_parameter, default_values

contains

    pure subroutine check_parameter(p, error)
        !! Refuse a parameter whose value is outside its domain or not finite.
        type(parameter_t), intent(in) :: p
        type(error_t), allocatable, intent(out) :: error
        logical :: good
        integer :: i

        do i = 1, p%count
            if (len_trim(p%computed) > 0 .and. ieee_is_nan(p%value(i))) cycle
            good = ieee_is_finite(p%value(i)) .and. p%value(i) <= p%upper
            if (p%open_lower) then
                good = good .and. p%value(i) > p%lower
            else
                good = good .and. p%value(i) >= p%lower
            end if
            if (.not. good) then
                call fail(error, trim(p%name)//" = "//to_text(p%value(i))// &
                          " is not allowed: "//p%domain())
                return
            end if
        end do
    end subroutine check_parameter

    pure function default_values(d) result(values)
        !! The parameters of a description as the flat list that `configure` takes.
        type(description_t), intent(in) :: d
        real(dp), allocatable :: values(:)
        integer :: i

        allocate (values(0))
        do i = 1, size(d%parameters)
            values = [values, d%parameters(i)%value(:d%parameters(i)%count)]
        end do
    end function default_values
end module lagrangia_parameters
