module lagrangia_hermite
    !! Hermite interpolation over a step, from values and derivatives at its ends.
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: cubic, quintic

contains

    elemental subroutine cubic(s, h, x0, v0, x1, v1, x, v)
        !! The polynomial of degree 3 at \(s = (t - t_0)/h\), and its derivative by \(t\); right to
        !! \(O(h^4)\) and \(O(h^3)\).
        real(dp), intent(in) :: s       !! from 0 to 1
        real(dp), intent(in) :: h       !! length of the step
        real(dp), intent(in) :: x0, v0  !! value and derivative at its start
        real(dp), intent(in) :: x1, v1  !! and at its end
        real(dp), intent(out) :: x, v   !! value and derivative
        real(dp) :: bend, mean

        mean = (x1 - x0)/h
        bend = (v0 - mean) + (v1 - mean)
        x = x0 + s*h*(v0 - s*(v0 - mean) - s*(1.0_dp - s)*bend)
        v = v0 - 2.0_dp*s*(v0 - mean) - s*(2.0_dp - 3.0_dp*s)*bend
    end subroutine cubic

    pure function quintic(h, x0, x1) result(c)
        !! The polynomial \(\sum_k c_k s^k\), \(s = (t - t_0)/h\), right to \(O(h^6)\).
        real(dp), intent(in) :: h      !! length of the step
        real(dp), intent(in) :: x0(3)  !! value, first and second derivative at its start
        real(dp), intent(in) :: x1(3)  !! and at its end
        real(dp) :: c(0:5)
        real(dp) :: dx, dv, da

        dx = x1(1) - x0(1) - h*(x0(2) + 0.5_dp*h*x0(3))
        dv = h*(x1(2) - x0(2) - h*x0(3))
        da = h**2*(x1(3) - x0(3))
        c(0) = x0(1)
        c(1) = h*x0(2)
        c(2) = 0.5_dp*h**2*x0(3)
        c(3) = 10.0_dp*dx - 4.0_dp*dv + 0.5_dp*da
        c(4) = -15.0_dp*dx + 7.0_dp*dv - da
        c(5) = 6.0_dp*dx - 3.0_dp*dv + 0.5_dp*da
    end function quintic
end module lagrangia_hermite
