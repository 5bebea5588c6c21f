module lagrangia_hyperdual
    !! Hyper-dual numbers: exact first and mixed second derivatives of what is computed with them.
    !!
    !! `f = sin(hyperdual_t(x, d1=1.0_dp, d2=1.0_dp))` holds \(f, f', f', f''\). Where a
    !! function has no derivative (`sqrt` at 0, say) the derivatives are infinite or NaN, also
    !! those of a constant.
    !!
    !! Source: Fike & Alonso, AIAA paper 2011-886, sec. III.
    use lagrangia_hyperdual_algebra, only: assignment(=), hyperdual, hyperdual_t, &
        operator(*), operator(+), operator(-), operator(/), operator(<), operator(>)
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: hyperdual_t, hyperdual, assignment(=)
    public :: operator(+), operator(-), operator(*), operator(/), operator(**)
    public :: operator(<), operator(>)
    public :: abs, atan, cos, cosh, dot_product, exp, log, sgn, sin, sinh, sqrt, sum, tan, &
              tanh

    interface operator(**)
        module procedure power_hi, power_hr, power_hh, power_rh, power_ih
    end interface operator(**)

    interface abs
        module procedure abs_h
    end interface abs

    interface atan
        module procedure atan_h
    end interface atan

    interface cos
        module procedure cos_h
    end interface cos

    interface cosh
        module procedure cosh_h
    end interface cosh

    interface dot_product
        module procedure dot_hh, dot_hr, dot_rh
    end interface dot_product

    interface exp
        module procedure exp_h
    end interface exp

    interface log
        module procedure log_h
    end interface log

    interface sgn
        module procedure sgn_h, sgn_r
    end interface sgn

    interface sin
        module procedure sin_h
    end interface sin

    interface sinh
        module procedure sinh_h
    end interface sinh

    interface sqrt
        module procedure sqrt_h
    end interface sqrt

    interface sum
        module procedure sum_h
    end interface sum

    interface tan
        module procedure tan_h
    end interface tan

    interface tanh
        module procedure tanh_h
    end interface tanh

contains

    elemental function chain(x, f, f1, f2) result(r)
        !! \(f(x)\) from the value `f` and the derivatives `f1`, `f2` of the function at `x%re`.
        type(hyperdual_t), intent(in) :: x
        real(dp), intent(in) :: f, f1, f2
        type(hyperdual_t) :: r

        r = hyperdual_t(f, f1*x%d1, f1*x%d2, f1*x%d12 + f2*x%d1*x%d2)
    end function chain

    elemental function power_hi(x, n) result(r)
        !! Exact where \(x = 0\): a vanishing factor \(n\) or \(n - 1\) wins over \(0^{-1}\).
        type(hyperdual_t), intent(in) :: x
        integer, intent(in) :: n
        type(hyperdual_t) :: r

        select case (n)
        case (0)
            r = 1.0_dp
        case (1)
            r = x
        case (2)
            r = chain(x, x%re*x%re, 2.0_dp*x%re, 2.0_dp)  ! a call of the library less
        case default
            r = chain(x, x%re**n, n*x%re**(n - 1), real(n, dp)*(n - 1)*x%re**(n - 2))
        end select
    end function power_hi

    elemental function power_hr(x, p) result(r)
        !! A whole exponent is an integer power, so that the base may be negative.
        type(hyperdual_t), intent(in) :: x
        real(dp), intent(in) :: p
        type(hyperdual_t) :: r

        if (abs(p) < 1e9_dp .and. abs(p - anint(p)) <= 0.0_dp) then
            r = x**nint(p)
        else
            r = chain(x, x%re**p, p*x%re**(p - 1.0_dp), p*(p - 1.0_dp)*x%re**(p - 2.0_dp))
        end if
    end function power_hr

    elemental function power_hh(x, y) result(r)
        !! \(x^y\) for \(x > 0\); any \(x\) that a constant \(y\) allows.
        type(hyperdual_t), intent(in) :: x, y
        type(hyperdual_t) :: r
        real(dp) :: ln, power

        r = x**y%re
        if (max(abs(y%d1), abs(y%d2), abs(y%d12)) <= 0.0_dp) return
        ln = log(x%re)
        power = x%re**(y%re - 1.0_dp)
        r%d1 = r%d1 + r%re*ln*y%d1
        r%d2 = r%d2 + r%re*ln*y%d2
        r%d12 = r%d12 + power*(1.0_dp + y%re*ln)*(x%d1*y%d2 + x%d2*y%d1) &
            + r%re*ln*(y%d12 + ln*y%d1*y%d2)
    end function power_hh

    elemental function power_rh(x, y) result(r)
        real(dp), intent(in) :: x
        type(hyperdual_t), intent(in) :: y
        type(hyperdual_t) :: r

        r = hyperdual(x)**y
    end function power_rh

    elemental function power_ih(x, y) result(r)
        integer, intent(in) :: x
        type(hyperdual_t), intent(in) :: y
        type(hyperdual_t) :: r

        r = hyperdual(real(x, dp))**y
    end function power_ih

    elemental function abs_h(x) result(r)
        !! At 0 the derivative of the side that the sign of the zero names.
        type(hyperdual_t), intent(in) :: x  !! any
        type(hyperdual_t) :: r

        r = x*sign(1.0_dp, x%re)
    end function abs_h

    elemental function atan_h(x) result(r)
        type(hyperdual_t), intent(in) :: x  !! any
        type(hyperdual_t) :: r
        real(dp) :: slope

        slope = 1.0_dp/(1.0_dp + x%re**2)
        r = chain(x, atan(x%re), slope, -2.0_dp*x%re*slope**2)
    end function atan_h

    elemental function cos_h(x) result(r)
        type(hyperdual_t), intent(in) :: x  !! rad
        type(hyperdual_t) :: r

        r = chain(x, cos(x%re), -sin(x%re), -cos(x%re))
    end function cos_h

    elemental function cosh_h(x) result(r)
        type(hyperdual_t), intent(in) :: x  !! any
        type(hyperdual_t) :: r

        r = chain(x, cosh(x%re), sinh(x%re), cosh(x%re))
    end function cosh_h

    elemental function exp_h(x) result(r)
        type(hyperdual_t), intent(in) :: x  !! any
        type(hyperdual_t) :: r

        r = chain(x, exp(x%re), exp(x%re), exp(x%re))
    end function exp_h

    elemental function log_h(x) result(r)
        type(hyperdual_t), intent(in) :: x  !! positive
        type(hyperdual_t) :: r

        r = chain(x, log(x%re), 1.0_dp/x%re, -1.0_dp/x%re**2)
    end function log_h

    elemental function sgn_h(x) result(r)
        !! Without a derivative, also at 0, where it jumps.
        type(hyperdual_t), intent(in) :: x  !! any
        type(hyperdual_t) :: r

        r = sgn_r(x%re)
    end function sgn_h

    elemental function sgn_r(x) result(r)
        !! \(x/|x|\), and 0 at 0.
        real(dp), intent(in) :: x  !! any
        real(dp) :: r

        r = x
        if (abs(x) > 0.0_dp) r = sign(1.0_dp, x)
    end function sgn_r

    elemental function sin_h(x) result(r)
        type(hyperdual_t), intent(in) :: x  !! rad
        type(hyperdual_t) :: r

        r = chain(x, sin(x%re), cos(x%re), -sin(x%re))
    end function sin_h

    elemental function sinh_h(x) result(r)
        type(hyperdual_t), intent(in) :: x  !! any
        type(hyperdual_t) :: r

        r = chain(x, sinh(x%re), cosh(x%re), sinh(x%re))
    end function sinh_h

    elemental function sqrt_h(x) result(r)
        type(hyperdual_t), intent(in) :: x  !! positive
        type(hyperdual_t) :: r
        real(dp) :: root

        root = sqrt(x%re)
        r = chain(x, root, 0.5_dp/root, -0.25_dp/(root*x%re))
    end function sqrt_h

    elemental function tan_h(x) result(r)
        type(hyperdual_t), intent(in) :: x  !! rad
        type(hyperdual_t) :: r
        real(dp) :: slope

        slope = 1.0_dp + tan(x%re)**2
        r = chain(x, tan(x%re), slope, 2.0_dp*tan(x%re)*slope)
    end function tan_h

    elemental function tanh_h(x) result(r)
        !! The slope is \(\cosh^{-2}\), because \(1 - \tanh^2\) cancels.
        type(hyperdual_t), intent(in) :: x  !! any
        type(hyperdual_t) :: r
        real(dp) :: slope

        slope = (1.0_dp/cosh(x%re))**2
        r = chain(x, tanh(x%re), slope, -2.0_dp*tanh(x%re)*slope)
    end function tanh_h

    pure function sum_h(x) result(r)
        type(hyperdual_t), intent(in) :: x(:)  !! any number of terms
        type(hyperdual_t) :: r

        r = hyperdual_t(sum(x%re), sum(x%d1), sum(x%d2), sum(x%d12))
    end function sum_h

    pure function dot_hh(a, b) result(r)
        type(hyperdual_t), intent(in) :: a(:), b(:)  !! of one size
        type(hyperdual_t) :: r

        r = sum(a*b)
    end function dot_hh

    pure function dot_rh(a, b) result(r)
        real(dp), intent(in) :: a(:)           !! (n)
        type(hyperdual_t), intent(in) :: b(:)  !! (n)
        type(hyperdual_t) :: r

        r = sum(a*b)
    end function dot_rh

    pure function dot_hr(a, b) result(r)
        type(hyperdual_t), intent(in) :: a(:)  !! (n)
        real(dp), intent(in) :: b(:)           !! (n)
        type(hyperdual_t) :: r

        r = sum(a*b)
    end function dot_hr
end module lagrangia_hyperdual
