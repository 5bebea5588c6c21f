module lagrangia_roots
    !! The root of a function between two points where its signs differ, to round-off.
    !!
    !! Chandrupatla's method: inverse quadratic interpolation where three points say that it is
    !! safe, bisection elsewhere. `brent_root` of `lagrangia_gsl` is GSL's; this one says on which
    !! side of the root it ends, and no rounding of `f` makes it fail.
    !!
    !! Source: T. R. Chandrupatla, Adv. Eng. Softw. 28 (1997) 145.
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_zero
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: scalar_function_t, find_root

    integer, parameter :: most = 2200  !! halvings from the largest to the smallest number

    type, abstract :: scalar_function_t
        !! A function of one variable.
    contains
        procedure(value_i), deferred :: value
    end type scalar_function_t

    abstract interface
        function value_i(self, x) result(y)
            import :: scalar_function_t, dp
            implicit none (type, external)
            class(scalar_function_t), intent(inout) :: self
            real(dp), intent(in) :: x  !! where it is wanted
            real(dp) :: y
        end function value_i
    end interface

contains

    subroutine find_root(f, from, to, root, error)
        !! The root of `f` in \([from, to]\), in either order, to two neighbours in the grid of
        !! numbers: `root` is the one on the side of `from`, where `f` has the sign of `f(from)`
        !! or is zero. Fails where the signs at the ends do not differ.
        class(scalar_function_t), intent(inout) :: f      !! its `value` is called
        real(dp), intent(in) :: from, to                  !! the ends
        real(dp), intent(out) :: root                     !! `from` after an error
        type(error_t), allocatable, intent(out) :: error  !! status 3: no change of sign
        real(dp) :: a, b, c, fa, fb, fc, least, share, side, x, y
        integer :: i

        a = from
        b = to
        fa = f%value(a)
        fb = f%value(b)
        root = a
        if (is_zero(fa)) return
        side = sign(1.0_dp, fa)
        if (is_zero(fb)) root = b
        if (is_zero(fb)) return
        if (.not. side*fb < 0.0_dp) then
            call fail(error, "no change of sign between "//to_text(from)//" and "//to_text(to), &
                      status_numbers)
            return
        end if
        share = 0.5_dp
        do i = 1, most
            x = a + share*(b - a)
            y = f%value(x)
            if (is_zero(y)) then
                root = x
                return
            end if
            if (y > 0.0_dp .eqv. fa > 0.0_dp) then
                c = a
                fc = fa
            else
                c = b
                b = a
                fc = fb
                fb = fa
            end if
            a = x
            fa = y
            if (fa*side > 0.0_dp) then
                root = a
            else
                root = b
            end if
            if (is_zero(nearest(a, b - a) - b)) return
            least = min(0.5_dp, spacing(max(abs(a), abs(b)))/abs(b - a))
            share = 0.5_dp
            if (quadratic_is_safe()) share = fa/(fb - fa)*fc/(fb - fc) &
                                             + (c - a)/(b - a)*fa/(fc - fa)*fb/(fc - fb)
            share = min(1.0_dp - least, max(least, share))
        end do
    contains
        pure function quadratic_is_safe() result(yes)
            !! Whether the inverse function is monotonic through the three points.
            logical :: yes
            real(dp) :: xi, phi

            xi = (a - b)/(c - b)
            phi = (fa - fb)/(fc - fb)
            yes = phi**2 < xi .and. (1.0_dp - phi)**2 < 1.0_dp - xi
        end function quadratic_is_safe
    end subroutine find_root
end module lagrangia_roots
