module lagrangia_sinc
    !! Quotients that stay exact where their denominator vanishes.
    !!
    !! A closed form that divides by a frequency has a limit where the frequency goes to zero;
    !! written with these, it loses no digits on the way there.
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: sinc, sinhc, sinc_lag

contains

    elemental function sinc(x) result(f)
        !! \(\sin x/x\), and 1 at 0.
        real(dp), intent(in) :: x  !! any
        real(dp) :: f

        f = 1.0_dp
        if (abs(x) > 0.0_dp) f = sin(x)/x
    end function sinc

    elemental function sinhc(x) result(f)
        !! \(\sinh x/x\), and 1 at 0.
        real(dp), intent(in) :: x  !! any
        real(dp) :: f

        f = 1.0_dp
        if (abs(x) > 0.0_dp) f = sinh(x)/x
    end function sinhc

    elemental function sinc_lag(x) result(f)
        !! \((x - \sin x)/x^2 = x/6 - x^3/120 + \dots\): the power series for \(|x| < 1\), where
        !! the difference cancels; its first term left out is \(x^{19}/21! < 2\cdot10^{-20}\).
        real(dp), intent(in) :: x  !! any
        real(dp) :: f
        integer :: k

        if (abs(x) < 1.0_dp) then
            f = 1.0_dp
            do k = 9, 2, -1
                f = 1.0_dp - f*x**2/((2*k)*(2*k + 1))
            end do
            f = f*x/6.0_dp
        else
            f = (x - sin(x))/x**2
        end if
    end function sinc_lag
end module lagrangia_sinc
