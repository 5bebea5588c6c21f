module lagrangia_dips
    !! Where a function that has one sign at both ends of an interval has the other between them.
    use lagrangia_kinds, only: dp
    use lagrangia_roots, only: scalar_function_t
    implicit none (type, external)
    private
    public :: find_dip, may_dip

contains

    pure function may_dip(u, k) result(yes)
        !! Can a function dip below zero between places `k - 1` and `k`? The parabola through three
        !! neighbours has its lowest point there, and less than its second difference above zero.
        real(dp), intent(in) :: u(0:)  !! its values at places of one distance
        integer, intent(in) :: k       !! from 1
        logical :: yes
        real(dp), parameter :: half = 0.5_dp
        real(dp) :: lowest, second
        integer :: j

        yes = .false.
        if (.not. min(u(k - 1), u(k)) > 0.0_dp) return
        do j = max(k - 1, 1), min(k, ubound(u, 1) - 1)
            second = u(j - 1) - 2.0_dp*u(j) + u(j + 1)
            if (.not. second > 0.0_dp) cycle
            lowest = half*(u(j - 1) - u(j + 1))/second  ! of the places, from j
            yes = abs(j + lowest - (k - half)) < 1.0_dp .and. &
                  u(j) - half*second*lowest**2 < second
            if (yes) return
        end do
    end function may_dip

    subroutine find_dip(f, from, to, side, depth, place, found)
        !! A place between two where a function with one minimum is lower than `-depth`, by golden
        !! section.
        class(scalar_function_t), intent(inout) :: f  !! its `value` is called
        real(dp), intent(in) :: from, to              !! the ends
        integer, intent(in) :: side                   !! 1, or -1 for the function's negative
        real(dp), intent(in) :: depth                 !! not negative
        real(dp), intent(out) :: place                !! `from` where there is none
        logical, intent(out) :: found                 !! there is one
        real(dp), parameter :: golden = 0.5_dp*(sqrt(5.0_dp) - 1.0_dp)
        real(dp) :: a, b, x(2), y(2)
        integer :: i

        a = from
        b = to
        x = [b - golden*(b - a), a + golden*(b - a)]
        y = side*[f%value(x(1)), f%value(x(2))]
        place = from
        do i = 1, 40  ! to 4e-9 of the interval
            found = minval(y) < -depth
            if (found) place = x(minloc(y, 1))
            if (found) return
            if (y(1) < y(2)) then
                b = x(2)
                x = [b - golden*(b - a), x(1)]
                y = [side*f%value(x(1)), y(1)]
            else
                a = x(1)
                x = [x(2), a + golden*(b - a)]
                y = [y(2), side*f%value(x(2))]
            end if
        end do
    end subroutine find_dip
end module lagrangia_dips
