module reference_checks
    !! What must hold for every closed form.
    use funit, only: assertEqual, assertTrue
    use lagrangia_kinds, only: dp
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: system_t
    use random_states, only: uniform
    implicit none (type, external)
    private
    public :: check_reference, check_state

    real(dp), parameter :: share = 0.003_dp
    !! of the differences' step, of the time in which the state changes
    real(dp), parameter :: truncation = 1e-11_dp
    !! of differences of order 8 with that step, where the state is singular in the complex
    !! plane at a fifth of that time (a light cart): 576*(5*share)**8
    real(dp), parameter :: rounding = 100.0_dp*epsilon(1.0_dp)
    !! of the state; its differences have it divided by the step

contains

    subroutine check_reference(reference, system, t0, q0, v0, name)
        !! It starts at the initial state and solves the equations of motion, before and after.
        class(reference_t), intent(in) :: reference
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, q0(:), v0(:)
        character(*), intent(in) :: name
        real(dp) :: q(size(q0)), v(size(q0)), a(size(q0)), rate_q(size(q0)), rate_v(size(q0))
        real(dp) :: t, h, size_v, size_a
        integer :: i

        call assertEqual(system%ndof, reference%ndof, message=name//": ndof")
        call assertTrue(len_trim(reference%title) > 0, name//": title")
        call reference%state_at(t0, q, v)
        call assertEqual(q0, q, 4e-15_dp*max(1.0_dp, maxval(abs(q0))), name//": starts at q0")
        call assertEqual(v0, v, 4e-15_dp*max(1.0_dp, maxval(abs(v0))), name//": starts at v0")
        do i = 1, 25
            t = t0 + uniform(-4.0_dp, 6.0_dp)
            call reference%state_at(t, q, v)
            call system%accelerations(t, q, v, a)
            size_v = maxval(abs(v)) + sqrt(maxval(abs(a))) + 0.1_dp
            size_a = maxval(abs(a)) + size_v**2
            h = share/size_v
            call differentiate(reference, t, h, rate_q, rate_v)
            call assertEqual(v, rate_q, truncation*size_v + rounding*maxval(abs(q))/h, &
                             name//": v is the rate of q")
            call assertEqual(a, rate_v, truncation*size_a + rounding*maxval(abs(v))/h &
                             + rounding*maxval(abs(q))*size_a, &
                             name//": obeys the equations of motion")
        end do
    end subroutine check_reference

    subroutine differentiate(reference, t, h, rate_q, rate_v)
        !! Central differences of order 8.
        class(reference_t), intent(in) :: reference
        real(dp), intent(in) :: t, h
        real(dp), intent(out) :: rate_q(:), rate_v(:)
        real(dp), parameter :: weight(4) = [4.0_dp/5.0_dp, -1.0_dp/5.0_dp, 4.0_dp/105.0_dp, &
                                            -1.0_dp/280.0_dp]
        real(dp), dimension(size(rate_q)) :: q, v, q_before, v_before
        integer :: k

        rate_q = 0.0_dp
        rate_v = 0.0_dp
        do k = 1, 4
            call reference%state_at(t + k*h, q, v)
            call reference%state_at(t - k*h, q_before, v_before)
            rate_q = rate_q + weight(k)/h*(q - q_before)
            rate_v = rate_v + weight(k)/h*(v - v_before)
        end do
    end subroutine differentiate

    subroutine check_state(reference, t, q, v, tolerance, name)
        !! The state at `t`, known from elsewhere.
        class(reference_t), intent(in) :: reference
        real(dp), intent(in) :: t, q(:), v(:), tolerance
        character(*), intent(in) :: name
        real(dp) :: found_q(size(q)), found_v(size(q))

        call reference%state_at(t, found_q, found_v)
        call assertEqual(q, found_q, tolerance, name//": q")
        call assertEqual(v, found_v, tolerance, name//": v")
    end subroutine check_state
end module reference_checks
