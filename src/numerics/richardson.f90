module lagrangia_richardson
    !! Extrapolation to a vanishing step.
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: extrapolated

contains

    pure function extrapolated(values) result(limit)
        !! The limit of what was computed with the steps \(h, h/2, h/4, \dots\) and whose error is
        !! a series in \(h^2\).
        !!
        !! Source: Richardson & Gaunt, Phil. Trans. A 226, 299 (1927); Romberg's scheme.
        real(dp), intent(in) :: values(:)  !! in this order, one at least
        real(dp) :: limit
        real(dp) :: row(size(values))
        integer :: i, k

        row = values
        do k = 1, size(values) - 1
            do i = size(values), k + 1, -1
                row(i) = row(i) + (row(i) - row(i - 1))/(4.0_dp**k - 1.0_dp)
            end do
        end do
        limit = row(size(values))
    end function extrapolated
end module lagrangia_richardson
