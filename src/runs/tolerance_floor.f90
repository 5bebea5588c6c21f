module lagrangia_tolerance_floor
    !! The smallest tolerance that makes sense from a start.
    !!
    !! A coordinate x is known to \(\epsilon |x|\), which shakes the accelerations by
    !! \(\epsilon |x| D\), \(D = |\partial a/\partial x|\); a time that the equations look at does
    !! so too. Over the time 1/r in which the motion changes, \(r = \sqrt D\), of time
    !! \(r = D^{1/3}\), the velocities are shaken by that over r. A method takes it for an error of
    !! its steps, which shrinks no faster than they do: far below, it would step for ever.
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: sensible_tolerance

contains

    pure function sensible_tolerance(method, system, t, duration, q, v) &
        result(tolerance)
        !! Which the method can keep, at least its `least_tolerance`, at most 0.1: upwards to two
        !! digits.
        class(dense_integrator_t), intent(in) :: method  !! says what it can keep
        class(system_t), intent(in) :: system  !! whose motion it is
        real(dp), intent(in) :: t, duration                        !! s
        real(dp), intent(in) :: q(system%ndof), v(system%ndof)  !! coordinates, velocities at t
        real(dp) :: tolerance
        real(dp) :: a(system%ndof), q_near(system%ndof), slope, noise, rate, step
        character(12) :: digits
        integer :: i

        call system%accelerations(t, q, v, a)
        noise = 0.0_dp
        rate = 0.0_dp
        do i = 1, system%ndof
            q_near = q
            q_near(i) = q(i) + nearby(q(i))
            step = q_near(i) - q(i)
            slope = maxval(abs(change(t, q_near)))/step
            noise = noise + epsilon(noise)*abs(q(i))*slope
            rate = max(rate, sqrt(slope))
        end do
        if (system%time_dependent) then
            step = (t + nearby(t)) - t
            slope = maxval([(abs(change(t + i*duration/16 + step, q) &
                                 - change(t + i*duration/16, q)), i=0, 16)])/step
            noise = noise + epsilon(noise)*abs(t)*slope
            rate = max(rate, slope**(1.0_dp/3.0_dp))
        end if
        tolerance = method%least_tolerance
        if (.not. (rate > 0.0_dp .and. rate < huge(rate))) return
        noise = noise/rate/max(1.0_dp, maxval(abs(v)), maxval(abs(a))/rate)/method%noise_margin
        if (.not. noise > tolerance) return
        write (digits, "(ss, es12.1e3)") min(0.1_dp, 1.1_dp*noise)
        read (digits, *) tolerance
    contains
        pure function change(t, q) result(da)
            !! Of the accelerations.
            real(dp), intent(in) :: t, q(:)
            real(dp) :: da(size(q))

            call system%accelerations(t, q, v, da)
            da = da - a
        end function change
    end function sensible_tolerance

    pure function nearby(x) result(step)
        !! So far that rounding does not hide what changes, and no turn is missed.
        real(dp), intent(in) :: x
        real(dp) :: step

        step = 2.0_dp**10*epsilon(x)*max(1.0_dp, abs(x))
    end function nearby
end module lagrangia_tolerance_floor
