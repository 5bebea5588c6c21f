module lagrangia_exponential_differences
    !! Divided differences of the exponential function, for any distance between their points.
    !!
    !! A driven linear system answers with \(e^{[z_1, z_2, z_3]}\), \(z_k\) its eigenvalues and the
    !! drive's, times the time: where two of them meet (resonance, critical damping) the quotient of
    !! differences is a derivative.
    !!
    !! Source: A. McCurdy, K. C. Ng, B. N. Parlett, Math. Comp. 43, 501 (1984).
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: first_difference, second_difference

contains

    elemental function first_difference(a, b) result(f)
        !! \((e^a - e^b)/(a - b)\), and \(e^a\) where both are the same. Where they are near by,
        !! \(e^{(a+b)/2}\sinh(h)/h\), \(h = (a-b)/2\), in which nothing cancels.
        complex(dp), intent(in) :: a, b  !! any
        complex(dp) :: f
        complex(dp) :: h

        h = 0.5_dp*(a - b)
        if (abs(real(h)) > 1.0_dp) then
            f = (exp(a) - exp(b))/(a - b)
        else
            f = exp(0.5_dp*(a + b))
            if (abs(h) > 0.0_dp) f = f*(sinh(h)/h)
        end if
    end function first_difference

    elemental function second_difference(a, b, c) result(f)
        !! \((e^{[x, y]} - e^{[y, z]})/(x - z)\) with x and z the two that are farthest apart; where
        !! all are within 1, \(e^\mu\sum_k h_k/(k+2)!\), \(\mu\) their mean and \(h_k\) the complete
        !! homogeneous polynomials of the distances from it, which are below 2/3.
        complex(dp), intent(in) :: a, b, c  !! any
        complex(dp) :: f
        real(dp) :: ab, bc, ca

        ab = abs(a - b)
        bc = abs(b - c)
        ca = abs(c - a)
        if (max(ab, bc, ca) < 1.0_dp) then
            f = by_series(a, b, c)
        else if (ca >= max(ab, bc)) then
            f = (first_difference(a, b) - first_difference(b, c))/(a - c)
        else if (ab >= bc) then
            f = (first_difference(a, c) - first_difference(c, b))/(a - b)
        else
            f = (first_difference(b, a) - first_difference(a, c))/(b - c)
        end if
    end function second_difference

    elemental function by_series(a, b, c) result(f)
        !! \(h_k = e_3 h_{k-3} - e_2 h_{k-2}\) by the elementary symmetric polynomials, of which
        !! the first is zero. The first term left out is below
        !! \(\tfrac{(k+1)(k+2)}{2(k+2)!}(2/3)^k\), \(k = 31\): \(2\cdot10^{-40}\).
        complex(dp), intent(in) :: a, b, c
        complex(dp) :: f
        integer, parameter :: last = 30
        complex(dp) :: mean, x, y, z, e2, e3, h(-2:last)
        real(dp) :: weight
        integer :: k

        mean = (a + b + c)/3.0_dp
        x = a - mean
        y = b - mean
        z = c - mean
        e2 = x*y + y*z + z*x
        e3 = x*y*z
        h(-2:-1) = 0.0_dp
        h(0) = 1.0_dp
        weight = 0.5_dp
        f = 0.5_dp
        do k = 1, last
            h(k) = e3*h(k - 3) - e2*h(k - 2)
            if (k == 1) h(k) = 0.0_dp
            weight = weight/(k + 2)
            f = f + weight*h(k)
        end do
        f = exp(mean)*f
    end function by_series
end module lagrangia_exponential_differences
