module lagrangia_flow
    !! How fast quantities of a system change along its motion.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: flow_derivative

    real(dp), parameter :: order8(4) = [4.0_dp/5.0_dp, -1.0_dp/5.0_dp, 4.0_dp/105.0_dp, &
                                        -1.0_dp/280.0_dp]
    real(dp), parameter :: order6(4) = [3.0_dp/4.0_dp, -3.0_dp/20.0_dp, 1.0_dp/60.0_dp, 0.0_dp]

contains

    subroutine flow_derivative(system, i, t, q, v, rate, scale, noise)
        !! Time derivative of quantity `i` (0: the energy) along the equations of motion, by
        !! central differences of order 8 along \((1, \dot q, \ddot q)\), and the size of what
        !! adds up to it: the changes with time, coordinates and velocities taken one by one. The
        !! step is shortened where it would leave the places where the quantity is a number.
        class(system_t), intent(in) :: system
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp), intent(out) :: rate, scale
        real(dp), intent(out), optional :: noise
        !! of the rate, absolute: rounding of the values over the step, and the difference
        !! between orders 6 and 8, which truncation stays below
        real(dp) :: a(size(q)), zero(size(q)), one(size(q)), h, other
        integer :: k

        call system%accelerations(t, q, v, a)
        zero = 0.0_dp
        h = 0.02_dp/(1.0_dp + maxval(abs(v)) + maxval(abs(a)))
        do k = 1, 20
            rate = slope(system, i, t, q, v, 1.0_dp, v, a, h, order8)
            if (ieee_is_finite(rate)) exit
            h = 0.25_dp*h
        end do
        scale = abs(slope(system, i, t, q, v, 1.0_dp, zero, zero, h, order8))
        do k = 1, size(q)
            one = zero
            one(k) = v(k)
            scale = scale + abs(slope(system, i, t, q, v, 0.0_dp, one, zero, h, order8))
            one(k) = a(k)
            scale = scale + abs(slope(system, i, t, q, v, 0.0_dp, zero, one, h, order8))
        end do
        scale = scale + abs(value_of(system, i, t, q, v)) + tiny(1.0_dp)
        if (.not. present(noise)) return
        other = slope(system, i, t, q, v, 1.0_dp, v, a, h, order6)
        noise = abs(rate - other) + epsilon(h)/h*(abs(value_of(system, i, t, q, v)) + h*scale)
    end subroutine flow_derivative

    function slope(system, i, t, q, v, dt, dq, dv, h, weight) result(rate)
        !! Derivative of quantity `i` in the direction `(dt, dq, dv)`.
        class(system_t), intent(in) :: system
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(:), v(:), dt, dq(:), dv(:), h, weight(:)
        real(dp) :: rate
        real(dp), dimension(size(q)) :: q_after, v_after, q_before, v_before
        integer :: k

        rate = 0.0_dp
        do k = 1, size(weight)
            q_after = q + k*h*dq
            v_after = v + k*h*dv
            q_before = q - k*h*dq
            v_before = v - k*h*dv
            rate = rate + weight(k)/h*(value_of(system, i, t + k*h*dt, q_after, v_after) &
                                       - value_of(system, i, t - k*h*dt, q_before, v_before))
        end do
    end function slope

    function value_of(system, i, t, q, v) result(value)
        !! Quantity `i`, or the energy if `i` is 0.
        class(system_t), intent(in) :: system
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp) :: value

        if (i == 0) then
            value = system%energy(t, q, v)
        else
            value = system%quantity(i, t, q, v)
        end if
    end function value_of
end module lagrangia_flow
