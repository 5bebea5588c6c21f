module lagrangia_time_in_motion
    !! Whether the equations of motion contain the time, which may be in L and drop out of them: of
    !! \(V + \sin t\), of \(L + dF(t, q)/dt\), of \(e^{ct}(T - V)\).
    use lagrangia_kinds, only: dp
    use lagrangia_lagrangian_system, only: last_state, trial_state
    use lagrangia_number_class, only: all_finite
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: motion_contains_time

contains

    pure function motion_contains_time(system) result(yes)
        !! Are the accelerations others at other times, by more than rounding? From the states of
        !! `trial_state`; rounding is beside the accelerations of states near by, since terms that
        !! are large may cancel in one of them.
        class(system_t), intent(in) :: system  !! with its parameters
        logical :: yes
        real(dp), parameter :: rounding = 1e-11_dp
        real(dp), parameter :: parts(3) = [0.0_dp, 0.618_dp, 0.2367_dp]  !! of the time, no period's
        real(dp), dimension(system%ndof) :: q, v, a, b
        real(dp) :: t, scale
        integer :: i, k

        yes = .false.
        if (.not. system%time_dependent) return
        do k = 1, last_state
            call trial_state(k, t, q, v)
            call system%accelerations(t, q, v, a)
            scale = maxval(abs(a))
            call system%accelerations(t, 0.7_dp*q, v, b)
            if (all_finite(b)) scale = max(scale, maxval(abs(b)))
            call system%accelerations(t, q, -0.5_dp*v, b)
            if (all_finite(b)) scale = max(scale, maxval(abs(b)))
            if (.not. all_finite(a)) cycle
            do i = 1, size(parts)
                call system%accelerations(parts(i)*t, q, v, b)
                if (.not. all_finite(b)) cycle
                yes = any(abs(a - b) > rounding*scale)
                if (yes) return
            end do
        end do
    end function motion_contains_time
end module lagrangia_time_in_motion
