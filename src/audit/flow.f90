module lagrangia_flow
    !! How fast quantities of a system change along its motion.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: flow_derivative, order8, quantity_of

    real(dp), parameter :: order8(4) = [4.0_dp/5.0_dp, -1.0_dp/5.0_dp, 4.0_dp/105.0_dp, &
                                        -1.0_dp/280.0_dp]  !! of central differences
    real(dp), parameter :: order6(4) = [3.0_dp/4.0_dp, -3.0_dp/20.0_dp, 1.0_dp/60.0_dp, 0.0_dp]

contains

    subroutine flow_derivative(system, i, t, q, v, rate, scale, noise, size_of_terms, errors)
        !! Time derivative of quantity `i` (0: the energy) along the equations of motion, by
        !! central differences of order 8 along \((1, \dot q, \ddot q)\), and the size of what
        !! adds up to it: the changes with time, coordinates and velocities taken one by one.
        class(system_t), intent(in) :: system  !! with its parameters
        integer, intent(in) :: i  !! the number of the quantity
        real(dp), intent(in) :: t, q(:), v(:)  !! s; coordinates and velocities, (ndof)
        real(dp), intent(out) :: rate, scale  !! per s; what adds up to it
        real(dp), intent(out), optional :: noise
        !! of the rate, absolute: rounding of the values over the step, the difference between
        !! orders 6 and 8, which truncation stays below, and what errors of the accelerations do
        real(dp), intent(in), optional :: size_of_terms  !! of the quantity, else from the state
        real(dp), intent(in), optional :: errors(:)      !! of the accelerations, else none
        real(dp) :: a(size(q)), zero(size(q)), one(size(q)), h, kept, part, carried, largest
        integer :: k

        call system%accelerations(t, q, v, a)
        zero = 0.0_dp
        if (present(size_of_terms)) then
            largest = size_of_terms
        else
            largest = size_from_state(system, i, t, q, v)
        end if
        call choose_step(system, i, t, q, v, a, largest, h, rate, kept)
        call slope_inside(system, i, t, q, v, 1.0_dp, zero, zero, h, scale)
        scale = abs(scale)
        carried = 0.0_dp
        do k = 1, size(q)
            one = zero
            one(k) = v(k)
            call slope_inside(system, i, t, q, v, 0.0_dp, one, zero, h, part)
            scale = scale + abs(part)
            one(k) = abs(a(k)) + abs(v(k)) + tiny(h)
            call slope_inside(system, i, t, q, v, 0.0_dp, zero, one, h, part)
            scale = scale + abs(a(k))*abs(part)/one(k)
            if (present(errors)) carried = carried + errors(k)*abs(part)/one(k)
        end do
        scale = scale + largest + tiny(1.0_dp)
        if (present(noise)) noise = kept + carried + epsilon(h)*scale
    end subroutine flow_derivative

    subroutine choose_step(system, i, t, q, v, a, size_of_terms, h, rate, noise)
        !! From the shortest step on, each time four times as long, as long as the rates agree
        !! within their noise: a step that is too long shows, whatever its own estimate says. It
        !! ends where the noise is small enough: what is fast and too small to show at a short
        !! step would be averaged away by a long one. Where even the ends of a step are another
        !! place or velocity altogether, the terms of the quantity are as large as there.
        !!
        !! Source: O. V. Lepskii, Theory Probab. Appl. 35, 454 (1991).
        class(system_t), intent(in) :: system
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(:), v(:), a(:), size_of_terms
        real(dp), intent(out) :: h, rate, noise
        integer, parameter :: steps = 20
        real(dp), parameter :: values = 2.0_dp*sum(abs(order8))  !! as many add up, each rounded
        real(dp), parameter :: enough = 1e-12_dp  !! of the quantity, a second
        real(dp), parameter :: elsewhere = 10.0_dp  !! times the size of what changes
        real(dp) :: next, now, other, largest, now_noise, terms, q_far(size(q)), v_far(size(q))
        integer :: k

        h = 0.1_dp/(1.0_dp + maxval(abs(v)) + sqrt(maxval(abs(a))))*0.25_dp**steps
        next = h
        rate = 0.0_dp
        noise = huge(noise)
        do k = 0, steps
            call slope(system, i, t, q, v, 1.0_dp, v, a, next, order6, other)
            call slope(system, i, t, q, v, 1.0_dp, v, a, next, order8, now, largest)
            terms = size_of_terms
            if (4.0_dp*next*maxval(abs(a)) > elsewhere*maxval(abs(v)) .or. &
                4.0_dp*next*maxval(abs(v)) > elsewhere*maxval(abs(q))) then
                q_far = q + 4.0_dp*next*v
                v_far = v + 4.0_dp*next*a
                terms = terms + system%natural_size(i, t + 4.0_dp*next, q_far, v_far) + &
                        size_from_state(system, i, t + 4.0_dp*next, q_far, v_far)
            end if
            now_noise = abs(now - other) + (values*epsilon(h)*(terms + largest) + tiny(h))/next
            if (k > 0) then
                if (.not. abs(now - rate) <= 3.0_dp*noise) return
                if (.not. now_noise < noise) then
                    next = 4.0_dp*next
                    cycle
                end if
            end if
            h = next
            rate = now
            noise = now_noise
            if (noise <= enough*(size_of_terms + largest)) return
            next = 4.0_dp*next
        end do
    end subroutine choose_step

    function size_from_state(system, i, t, q, v) result(size_of_terms)
        !! \(|f| + \sum_k|x_k\,\partial f/\partial x_k|\) over time, coordinates and velocities.
        class(system_t), intent(in) :: system
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp) :: size_of_terms
        real(dp), parameter :: step = 16.0_dp*epsilon(1.0_dp)
        real(dp) :: value, q_near(size(q)), v_near(size(q))
        integer :: k

        value = quantity_of(system, i, t, q, v)
        size_of_terms = abs(value) &
                        + abs(quantity_of(system, i, t*(1.0_dp - step), q, v) - value)/step
        do k = 1, size(q)
            q_near = q
            v_near = v
            q_near(k) = q(k)*(1.0_dp - step)
            size_of_terms = size_of_terms &
                            + abs(quantity_of(system, i, t, q_near, v) - value)/step
            v_near(k) = v(k)*(1.0_dp - step)
            size_of_terms = size_of_terms &
                            + abs(quantity_of(system, i, t, q, v_near) - value)/step
        end do
    end function size_from_state

    subroutine slope_inside(system, i, t, q, v, dt, dq, dv, h, rate)
        !! `slope` of order 8 with the step `h`, or with as much shorter a one as the edge of where
        !! the quantity is a number needs: a step along the motion may stay inside where that of
        !! one coordinate or velocity alone does not.
        class(system_t), intent(in) :: system
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(:), v(:), dt, dq(:), dv(:), h
        real(dp), intent(out) :: rate
        integer, parameter :: most = 30
        integer :: k

        do k = 0, most
            call slope(system, i, t, q, v, dt, dq, dv, h*0.25_dp**k, order8, rate)
            if (ieee_is_finite(rate)) return
        end do
    end subroutine slope_inside

    subroutine slope(system, i, t, q, v, dt, dq, dv, h, weight, rate, largest)
        !! Derivative of quantity `i` in the direction `(dt, dq, dv)`.
        class(system_t), intent(in) :: system
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(:), v(:), dt, dq(:), dv(:), h, weight(:)
        real(dp), intent(out) :: rate
        real(dp), intent(out), optional :: largest  !! of the values that it is made of
        real(dp), dimension(size(q)) :: q_after, v_after, q_before, v_before
        real(dp) :: after, before
        integer :: k

        rate = 0.0_dp
        if (present(largest)) largest = 0.0_dp
        do k = 1, size(weight)
            q_after = q + k*h*dq
            v_after = v + k*h*dv
            q_before = q - k*h*dq
            v_before = v - k*h*dv
            after = quantity_of(system, i, t + k*h*dt, q_after, v_after)
            before = quantity_of(system, i, t - k*h*dt, q_before, v_before)
            rate = rate + weight(k)/h*(after - before)
            if (present(largest)) largest = max(largest, abs(after), abs(before))
        end do
    end subroutine slope

    function quantity_of(system, i, t, q, v) result(value)
        !! Quantity `i`, or the energy if `i` is 0.
        class(system_t), intent(in) :: system  !! with its parameters
        integer, intent(in) :: i  !! the number of the quantity
        real(dp), intent(in) :: t, q(:), v(:)  !! s; coordinates and velocities, (ndof)
        real(dp) :: value

        if (i == 0) then
            value = system%energy(t, q, v)
        else
            value = system%quantity(i, t, q, v)
        end if
    end function quantity_of
end module lagrangia_flow
