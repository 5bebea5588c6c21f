module lagrangia_elliptic
    !! Elliptic integrals and functions from the complementary modulus \(k' = \sqrt{1 - k^2}\).
    !!
    !! Near \(k = 1\) the modulus is all nines; \(k'\) keeps every digit, and where \(k\) is small
    !! it loses none that matter. Neither the parameter \(m = k^2\) nor \(k\) itself is needed.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: agm, amplitude, elliptic_k, jacobi

    real(dp), parameter :: pi = acos(-1.0_dp)
    real(dp), parameter :: close_enough = 1e-8_dp  !! the mean then squares the difference
    integer, parameter :: max_depth = 16           !! the smallest \(k'\), 5e-324, needs 14

contains

    elemental function agm(a, b) result(mean)
        !! Arithmetic-geometric mean of two non-negative numbers; NaN for others.
        !!
        !! Source: DLMF 19.8.1.
        real(dp), intent(in) :: a, b  !! not negative
        real(dp) :: mean
        real(dp) :: scale, geometric, next

        if (.not. (min(a, b) >= 0.0_dp .and. ieee_is_finite(a) .and. ieee_is_finite(b))) then
            mean = ieee_value(1.0_dp, ieee_quiet_nan)
            return
        end if
        mean = 0.0_dp
        if (min(a, b) <= 0.0_dp) return
        scale = 0.5_dp*a + 0.5_dp*b
        geometric = sqrt(a)*sqrt(b)/scale
        mean = 1.0_dp
        do while (mean - geometric > close_enough*mean)
            next = 0.5_dp*(mean + geometric)
            geometric = sqrt(mean*geometric)
            mean = next
        end do
        mean = scale*(0.5_dp*(mean + geometric))
    end function agm

    elemental function elliptic_k(kc) result(value)
        !! Complete integral \(K = \pi/(2\,\mathrm{agm}(1, k'))\); infinite at \(k' = 0\).
        !!
        !! Source: DLMF 19.8.5.
        real(dp), intent(in) :: kc  !! complementary modulus \(k'\), 0 to 1; NaN outside
        real(dp) :: value

        value = 0.5_dp*pi/agm(1.0_dp, merge(kc, -1.0_dp, kc <= 1.0_dp))
    end function elliptic_k

    pure subroutine jacobi(u, kc, sn, cn, dn)
        !! Jacobi's \(\mathrm{sn}, \mathrm{cn}, \mathrm{dn}\) of any real argument.
        !!
        !! Landen's transformation takes \(k'\) up to 1, where the functions are those of the
        !! circle, and back; every step is free of cancellation. The circle's angle is \(\pi u/2K\),
        !! so that `sin` reduces long times by the period: only the rounding of `u` is left.
        !!
        !! Source: R. Bulirsch, Numer. Math. 7, 78 (1965), procedure `sncndn`, with sine and cosine
        !! in place of the cotangent, which overflows for small `u`.
        real(dp), intent(in) :: u            !! argument
        real(dp), intent(in) :: kc           !! complementary modulus \(k'\), 0 to 1; NaN outside
        real(dp), intent(out) :: sn, cn, dn  !! NaN where the arguments are not allowed
        real(dp) :: phase

        call jacobi_with_phase(u, kc, sn, cn, dn, phase)
    end subroutine jacobi

    elemental function amplitude(u, kc) result(value)
        !! Jacobi's \(\mathrm{am}\), unwrapped: grows with `u`, by \(\pi\) every \(2K\).
        !!
        !! \(|\mathrm{am}\,u - \pi u/2K| < \pi/2\), so the phase tells the turn.
        real(dp), intent(in) :: u   !! argument
        real(dp), intent(in) :: kc  !! complementary modulus \(k'\), 0 to 1; NaN outside
        real(dp) :: value
        real(dp) :: sn, cn, dn, phase

        call jacobi_with_phase(u, kc, sn, cn, dn, phase)
        value = atan2(sn, cn)
        value = value + 2.0_dp*pi*anint((phase - value)/(2.0_dp*pi))
    end function amplitude

    pure subroutine jacobi_with_phase(u, kc, sn, cn, dn, phase)
        real(dp), intent(in) :: u, kc
        real(dp), intent(out) :: sn, cn, dn
        real(dp), intent(out) :: phase  !! \(\pi u/2K\), the angle on the circle
        real(dp) :: a(max_depth), b(max_depth)
        real(dp) :: s2, c2, norm
        integer :: n, top

        if (.not. (kc >= 0.0_dp .and. kc <= 1.0_dp .and. ieee_is_finite(u))) then
            phase = ieee_value(1.0_dp, ieee_quiet_nan)
            sn = phase
            cn = phase
            dn = phase
            return
        end if
        if (kc <= 0.0_dp) then
            phase = 0.0_dp
            sn = tanh(u)
            cn = 1.0_dp/cosh(u)
            dn = cn
            return
        end if
        a(1) = 1.0_dp
        b(1) = kc
        do top = 2, max_depth
            a(top) = 0.5_dp*(a(top - 1) + b(top - 1))
            b(top) = sqrt(a(top - 1)*b(top - 1))
            if (a(top - 1) - b(top - 1) <= close_enough*a(top - 1)) exit
        end do
        phase = a(top)*u
        sn = sin(phase)
        cn = cos(phase)
        dn = 1.0_dp
        do n = top - 1, 1, -1
            s2 = sn**2
            c2 = a(n + 1)*cn**2
            sn = a(n)*sn
            cn = a(n + 1)*dn*cn
            norm = hypot(sn, cn)
            sn = sn/norm
            cn = cn/norm
            dn = (b(n)*s2 + c2)/(a(n)*s2 + c2)
        end do
    end subroutine jacobi_with_phase
end module lagrangia_elliptic
