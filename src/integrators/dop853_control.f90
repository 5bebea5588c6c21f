module lagrangia_dop853_control
    !! How long the steps of `dop853` are.
    !!
    !! Source: Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, 2nd ed.,
    !! sec. II.4: starting step, and PI control of the others.
    use, intrinsic :: iso_fortran_env, only: int64
    use lagrangia_dop853_stages, only: slope
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: first_step, least_error, next_step, next_steps, twice_too_long

    real(dp), parameter :: ln2 = log(2.0_dp)
    real(dp), parameter :: least_error = log(1e-4_dp)/ln2
    !! logarithm to base 2 of an error in tolerances: less counts as much
    real(dp), parameter :: twice_too_long = 100.0_dp  !! an error, in tolerances, which says so
    real(dp), parameter :: safety = 0.9_dp
    real(dp), parameter :: shrink = 0.333_dp, grow = 6.0_dp  !! limits of one change of step
    real(dp), parameter :: beta = 0.04_dp                    !! share of the previous error
    real(dp), parameter :: alpha = 1.0_dp/8.0_dp - 0.2_dp*beta
    real(dp), parameter :: nothing = 1e-100_dp               !! a scaled error below changes nothing
    integer(int64), parameter :: bias = 1023             !! of a double's exponent
    integer(int64), parameter :: one = ishft(bias, 52)   !! bits of 1

contains

    pure subroutine first_step(system, n, tolerance, t0, t_end, y, slope_y, h)
        !! As long as a step of Euler's that would err little, and as the change of the slope over
        !! it allows. One evaluation.
        class(system_t), intent(in) :: system   !! gives the accelerations
        integer, intent(in) :: n                !! degrees of freedom
        real(dp), intent(in) :: tolerance       !! absolute below 1, relative above
        real(dp), intent(in) :: t0, t_end       !! start and end of the motion, s
        real(dp), intent(in) :: y(2*n)          !! state at the start
        real(dp), intent(in) :: slope_y(2*n)    !! its slope
        real(dp), intent(out) :: h              !! s
        real(dp) :: ahead(2*n), change, size_slope, size_y

        size_y = norm(tolerance, y, y)
        size_slope = norm(tolerance, slope_y, y)
        h = 1e-6_dp
        if (min(size_y, size_slope) > 1e-5_dp) h = 0.01_dp*size_y/size_slope
        h = min(h, t_end - t0)
        call slope(system, n, t0 + h, y + h*slope_y, ahead)
        change = max(norm(tolerance, ahead - slope_y, y)/h, size_slope)
        if (change > 1e-15_dp) then
            h = min(100.0_dp*h, (0.01_dp/change)**(1.0_dp/8.0_dp))
        else
            h = max(1e-6_dp, 1e-3_dp*h)
        end if
        h = max(h, 1024.0_dp*spacing(t0))  ! a step that is too long will be rejected
    end subroutine first_step

    pure subroutine next_step(h, scaled, last_error, next)
        !! After a rejected step, `scaled > 1`, its own error alone counts, and the next is shorter;
        !! where that is no number, a tenth as long.
        real(dp), intent(in) :: h              !! length of the attempt, s
        real(dp), intent(in) :: scaled         !! its error, in tolerances; huge: no number came out
        real(dp), intent(inout) :: last_error
        !! logarithm to base 2 of the error of the latest accepted step, or `least_error`
        real(dp), intent(out) :: next          !! length to try next, s
        real(dp) :: error, past, ratio

        error = logarithm(merge(scaled, nothing, scaled > nothing))
        past = merge(beta*last_error, 0.0_dp, scaled <= 1.0_dp)
        ratio = power_of_two(alpha*error - past)/safety
        ratio = max(1.0_dp/grow, min(1.0_dp/shrink, ratio))
        next = h/merge(ratio, 10.0_dp, scaled < huge(scaled))
        if (scaled <= 1.0_dp) last_error = max(error, least_error)
    end subroutine next_step

    pure subroutine next_steps(h, scaled, last_error, next)
        !! `next_step` in lanes, the same in each to the last bit. A mask with a product in it, or
        !! one loop instead of all these, would not go in vector registers.
        real(dp), intent(in) :: h(lanes), scaled(lanes)  !! lengths and errors of the attempts
        real(dp), intent(inout) :: last_error(lanes)     !! of the latest accepted steps
        real(dp), intent(out) :: next(lanes)             !! lengths to try next, s
        real(dp), dimension(lanes) :: error, past, ratio

        error = merge(scaled, nothing, scaled > nothing)
        error = logarithm(error)
        past = beta*last_error
        past = merge(past, 0.0_dp, scaled <= 1.0_dp)
        ratio = power_of_two(alpha*error - past)/safety
        ratio = max(1.0_dp/grow, min(1.0_dp/shrink, ratio))
        next = h/merge(ratio, 10.0_dp, scaled < huge(scaled))
        error = max(error, least_error)
        past = last_error
        last_error = merge(error, past, scaled <= 1.0_dp)
    end subroutine next_steps

    elemental function logarithm(x) result(y)
        !! To base 2, to 3e-11, which is less than libm gives, and enough: a step whose length
        !! differs by 1e-10 of itself has an error that differs by 1e-9 of itself.
        !!
        !! With \(x = 2^e m\), \(1 \le m < 2\), and \(f = (m - \sqrt2)/(m + \sqrt2)\),
        !! \(|f| < 0.1716\), it is
        !! \(e + \tfrac12 + \tfrac{2}{\ln 2}(f + f^3/3 + f^5/5 + \dots)\).
        real(dp), intent(in) :: x  !! a normal number above 0
        real(dp) :: y              !! its logarithm
        real(dp), parameter :: root_two = sqrt(2.0_dp)
        real(dp), parameter :: whole = 2.0_dp**52  ! its last bits can be an integer
        integer :: j
        real(dp), parameter :: l(0:5) = [(2.0_dp/ln2/(2*j + 1), j=0, 5)]  ! of f, f^3, ...
        real(dp) :: e, f, m, z
        integer(int64) :: bits

        if (digits(x) > 53) then  ! -DREAL128
            y = log(x)/ln2
            return
        end if
        bits = transfer(x, bits)
        e = transfer(ior(ishft(bits, -52), transfer(whole, bits)), e) - (whole + bias)
        m = transfer(ior(iand(bits, 2_int64**52 - 1), one), m)
        f = (m - root_two)/(m + root_two)
        z = f*f
        y = e + 0.5_dp + f*((l(0) + z*l(1)) + (z*z)*((l(2) + z*l(3)) + (z*z)*(l(4) + z*l(5))))
    end function logarithm

    elemental function power_of_two(x) result(y)
        !! Two to the power of `x`, to 1e-11 of it: with \(n\) the integer nearest to \(x\) and
        !! \(r = (x - n)\ln 2\), it is \(2^n(1 + r + r^2/2! + \dots)\).
        real(dp), intent(in) :: x  !! from -1000 to 1000
        real(dp) :: y              !! the power
        real(dp), parameter :: shift = 1.5_dp*2.0_dp**52  ! a sum with it is an integer
        integer :: j
        real(dp), parameter :: p(0:9) = [(1.0_dp/gamma(real(j + 1, dp)), j=0, 9)]  ! of 1, r, ...
        real(dp) :: power, r, shifted, z

        if (digits(x) > 53) then  ! -DREAL128
            y = 2.0_dp**x
            return
        end if
        shifted = x + shift
        r = (x - (shifted - shift))*ln2
        power = transfer(ishft(transfer(shifted, one), 52) + one, power)
        z = r*r
        y = power*(((p(0) + r*p(1)) + z*(p(2) + r*p(3))) + (z*z)*(((p(4) + r*p(5)) &
                   + z*(p(6) + r*p(7))) + (z*z)*(p(8) + r*p(9))))
    end function power_of_two

    pure function norm(tolerance, x, y) result(size_x)
        !! Root mean square of `x`, in units of the tolerance at the state `y`.
        real(dp), intent(in) :: tolerance, x(:), y(:)
        real(dp) :: size_x
        integer :: i

        size_x = 0.0_dp
        do i = 1, size(x)
            size_x = size_x + (x(i)/max(1.0_dp, abs(y(i))))**2
        end do
        size_x = sqrt(size_x/size(x))/tolerance
    end function norm
end module lagrangia_dop853_control
