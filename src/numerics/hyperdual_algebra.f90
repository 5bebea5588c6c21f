module lagrangia_hyperdual_algebra
    !! Hyper-dual numbers: the type and the four operations.
    !! Use `lagrangia_hyperdual`, which adds the functions.
    !!
    !! \(x = x_0 + x_1\epsilon_1 + x_2\epsilon_2 + x_{12}\epsilon_1\epsilon_2\) with
    !! \(\epsilon_1^2 = \epsilon_2^2 = 0 \ne \epsilon_1\epsilon_2\): first and mixed second
    !! derivatives come out exact, without a step to choose.
    !!
    !! Source: Fike & Alonso, AIAA paper 2011-886, sec. III.
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: hyperdual_t, hyperdual, assignment(=)
    public :: operator(+), operator(-), operator(*), operator(/), operator(<), operator(>)

    type :: hyperdual_t
        !! A value and its derivatives along two directions; seed by `hyperdual_t(x, d1=1.0_dp)`.
        real(dp) :: re = 0.0_dp   !! value
        real(dp) :: d1 = 0.0_dp   !! derivative along the first direction
        real(dp) :: d2 = 0.0_dp   !! derivative along the second direction
        real(dp) :: d12 = 0.0_dp  !! mixed second derivative
    end type hyperdual_t

    interface operator(+)
        module procedure plus_h, add_hh, add_hr, add_rh, add_hi, add_ih
    end interface operator(+)

    interface operator(-)
        module procedure minus_h, subtract_hh, subtract_hr, subtract_rh, subtract_hi, &
                         subtract_ih
    end interface operator(-)

    interface operator(*)
        module procedure multiply_hh, multiply_hr, multiply_rh, multiply_hi, multiply_ih
    end interface operator(*)

    interface operator(/)
        module procedure divide_hh, divide_hr, divide_rh, divide_hi, divide_ih
    end interface operator(/)

    interface operator(<)
        module procedure less_hh, less_hr
    end interface operator(<)

    interface operator(>)
        module procedure greater_hh, greater_hr
    end interface operator(>)

    interface assignment(=)
        module procedure assign_r, assign_i
    end interface assignment(=)

contains

    elemental function hyperdual(x) result(r)
        !! A constant: all its derivatives vanish.
        real(dp), intent(in) :: x  !! its value
        type(hyperdual_t) :: r

        r = hyperdual_t(re=x)
    end function hyperdual

    elemental subroutine assign_r(r, x)
        type(hyperdual_t), intent(out) :: r
        real(dp), intent(in) :: x

        r%re = x
    end subroutine assign_r

    elemental subroutine assign_i(r, x)
        type(hyperdual_t), intent(out) :: r
        integer, intent(in) :: x

        r%re = real(x, dp)
    end subroutine assign_i

    elemental function plus_h(a) result(r)
        type(hyperdual_t), intent(in) :: a
        type(hyperdual_t) :: r

        r = a
    end function plus_h

    elemental function add_hh(a, b) result(r)
        type(hyperdual_t), intent(in) :: a, b
        type(hyperdual_t) :: r

        r = hyperdual_t(a%re + b%re, a%d1 + b%d1, a%d2 + b%d2, a%d12 + b%d12)
    end function add_hh

    elemental function add_hr(a, b) result(r)
        type(hyperdual_t), intent(in) :: a
        real(dp), intent(in) :: b
        type(hyperdual_t) :: r

        r = hyperdual_t(a%re + b, a%d1, a%d2, a%d12)
    end function add_hr

    elemental function add_rh(a, b) result(r)
        real(dp), intent(in) :: a
        type(hyperdual_t), intent(in) :: b
        type(hyperdual_t) :: r

        r = b + a
    end function add_rh

    elemental function add_hi(a, b) result(r)
        type(hyperdual_t), intent(in) :: a
        integer, intent(in) :: b
        type(hyperdual_t) :: r

        r = a + real(b, dp)
    end function add_hi

    elemental function add_ih(a, b) result(r)
        integer, intent(in) :: a
        type(hyperdual_t), intent(in) :: b
        type(hyperdual_t) :: r

        r = b + real(a, dp)
    end function add_ih

    elemental function minus_h(a) result(r)
        type(hyperdual_t), intent(in) :: a
        type(hyperdual_t) :: r

        r = hyperdual_t(-a%re, -a%d1, -a%d2, -a%d12)
    end function minus_h

    elemental function subtract_hh(a, b) result(r)
        type(hyperdual_t), intent(in) :: a, b
        type(hyperdual_t) :: r

        r = hyperdual_t(a%re - b%re, a%d1 - b%d1, a%d2 - b%d2, a%d12 - b%d12)
    end function subtract_hh

    elemental function subtract_hr(a, b) result(r)
        type(hyperdual_t), intent(in) :: a
        real(dp), intent(in) :: b
        type(hyperdual_t) :: r

        r = hyperdual_t(a%re - b, a%d1, a%d2, a%d12)
    end function subtract_hr

    elemental function subtract_rh(a, b) result(r)
        real(dp), intent(in) :: a
        type(hyperdual_t), intent(in) :: b
        type(hyperdual_t) :: r

        r = hyperdual_t(a - b%re, -b%d1, -b%d2, -b%d12)
    end function subtract_rh

    elemental function subtract_hi(a, b) result(r)
        type(hyperdual_t), intent(in) :: a
        integer, intent(in) :: b
        type(hyperdual_t) :: r

        r = a - real(b, dp)
    end function subtract_hi

    elemental function subtract_ih(a, b) result(r)
        integer, intent(in) :: a
        type(hyperdual_t), intent(in) :: b
        type(hyperdual_t) :: r

        r = real(a, dp) - b
    end function subtract_ih

    elemental function multiply_hh(a, b) result(r)
        type(hyperdual_t), intent(in) :: a, b
        type(hyperdual_t) :: r

        r = hyperdual_t(a%re*b%re, a%re*b%d1 + a%d1*b%re, a%re*b%d2 + a%d2*b%re, &
                        (a%re*b%d12 + a%d12*b%re) + (a%d1*b%d2 + a%d2*b%d1))
    end function multiply_hh

    elemental function multiply_hr(a, b) result(r)
        type(hyperdual_t), intent(in) :: a
        real(dp), intent(in) :: b
        type(hyperdual_t) :: r

        r = hyperdual_t(a%re*b, a%d1*b, a%d2*b, a%d12*b)
    end function multiply_hr

    elemental function multiply_rh(a, b) result(r)
        real(dp), intent(in) :: a
        type(hyperdual_t), intent(in) :: b
        type(hyperdual_t) :: r

        r = b*a
    end function multiply_rh

    elemental function multiply_hi(a, b) result(r)
        type(hyperdual_t), intent(in) :: a
        integer, intent(in) :: b
        type(hyperdual_t) :: r

        r = a*real(b, dp)
    end function multiply_hi

    elemental function multiply_ih(a, b) result(r)
        integer, intent(in) :: a
        type(hyperdual_t), intent(in) :: b
        type(hyperdual_t) :: r

        r = b*real(a, dp)
    end function multiply_ih

    elemental function divide_hh(a, b) result(r)
        !! The derivatives of \(r b = a\), solved for those of \(r\).
        type(hyperdual_t), intent(in) :: a, b
        type(hyperdual_t) :: r

        r%re = a%re/b%re
        r%d1 = (a%d1 - r%re*b%d1)/b%re
        r%d2 = (a%d2 - r%re*b%d2)/b%re
        r%d12 = ((a%d12 - r%re*b%d12) - (r%d1*b%d2 + r%d2*b%d1))/b%re
    end function divide_hh

    elemental function divide_hr(a, b) result(r)
        type(hyperdual_t), intent(in) :: a
        real(dp), intent(in) :: b
        type(hyperdual_t) :: r

        r = hyperdual_t(a%re/b, a%d1/b, a%d2/b, a%d12/b)
    end function divide_hr

    elemental function divide_rh(a, b) result(r)
        real(dp), intent(in) :: a
        type(hyperdual_t), intent(in) :: b
        type(hyperdual_t) :: r

        r = hyperdual(a)/b
    end function divide_rh

    elemental function divide_hi(a, b) result(r)
        type(hyperdual_t), intent(in) :: a
        integer, intent(in) :: b
        type(hyperdual_t) :: r

        r = a/real(b, dp)
    end function divide_hi

    elemental function divide_ih(a, b) result(r)
        integer, intent(in) :: a
        type(hyperdual_t), intent(in) :: b
        type(hyperdual_t) :: r

        r = hyperdual(real(a, dp))/b
    end function divide_ih

    elemental function less_hh(a, b) result(r)
        type(hyperdual_t), intent(in) :: a, b
        logical :: r

        r = a%re < b%re
    end function less_hh

    elemental function less_hr(a, b) result(r)
        type(hyperdual_t), intent(in) :: a
        real(dp), intent(in) :: b
        logical :: r

        r = a%re < b
    end function less_hr

    elemental function greater_hh(a, b) result(r)
        type(hyperdual_t), intent(in) :: a, b
        logical :: r

        r = a%re > b%re
    end function greater_hh

    elemental function greater_hr(a, b) result(r)
        type(hyperdual_t), intent(in) :: a
        real(dp), intent(in) :: b
        logical :: r

        r = a%re > b
    end function greater_hr
end module lagrangia_hyperdual_algebra
