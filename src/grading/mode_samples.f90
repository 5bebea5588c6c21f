module lagrangia_mode_samples
    !! The small oscillations of a system for each draw of its parameters.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_damped_rates, only: damping_matrix
    use lagrangia_equilibrium, only: stiffness_beside
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero, is_zero
    use lagrangia_sample_names, only: draws, samples_t, states
    use lagrangia_small_oscillations, only: find_modes, likely_equilibrium, modes_t
    use lagrangia_system, only: system_t
    use lagrangia_unsymmetric_modes, only: unsymmetric_modes
    implicit none (type, external)
    private
    public :: add_modes, put_other_modes, put_places, stable_somewhere

contains

    subroutine add_modes(samples, system, draw)
        !! \(\omega^2\) of the oscillations about the equilibrium of the scene, or at or near zero,
        !! and about another one that the page knows, or at zero; 0 where there is none.
        type(samples_t), intent(inout) :: samples  !! get them
        class(system_t), intent(in) :: system      !! with the parameters of this draw
        integer, intent(in) :: draw                !! its number
        type(modes_t) :: modes, others
        type(error_t), allocatable :: error
        real(dp) :: start(system%ndof)
        integer :: n

        n = system%ndof
        if (draw == 1) then
            allocate (samples%omega2(draws, 2*n), source=0.0_dp)
            allocate (samples%equilibrium(n, draws), source=ieee_value(1.0_dp, ieee_quiet_nan))
            allocate (samples%stiffness(n, n, draws), samples%inertia(n, n, draws), source=0.0_dp)
            allocate (samples%turning(n, n, draws), source=ieee_value(1.0_dp, ieee_quiet_nan))
            samples%other_equilibrium = samples%equilibrium
            samples%other_stiffness = samples%turning
            samples%other_inertia = samples%turning
            samples%other_turning = samples%turning
        end if
        samples%omega2(draw, :) = 0.0_dp
        samples%equilibrium(:, draw) = ieee_value(1.0_dp, ieee_quiet_nan)
        samples%other_equilibrium(:, draw) = samples%equilibrium(:, draw)
        if (samples%decay > 0) call put_rates(ieee_value(1.0_dp, ieee_quiet_nan), 0.0_dp)
        start = likely_equilibrium(system)
        call find_modes(system, start, .true., modes, error)
        if (allocated(error)) call find_modes(system, start, .false., modes, error)
        if (allocated(error)) return
        samples%omega2(draw, :size(modes%omega2)) = modes%omega2
        if (allocated(modes%stiffness)) then
            samples%equilibrium(:, draw) = modes%at
            samples%stiffness(:, :, draw) = modes%stiffness
            samples%inertia(:, :, draw) = modes%mass
            call add_forces(modes, samples%omega2(draw, :n))
        end if
        if (allocated(modes%analytic%elsewhere)) then
            start = modes%analytic%elsewhere
        else if (any(is_nonzero(start))) then
            start = 0.0_dp
        else
            return
        end if
        call find_modes(system, start, .true., others, error)
        if (.not. allocated(error)) call put_other_modes(samples, system, draw, others)
    contains
        subroutine add_forces(modes, omega2)
            !! What is linear in the velocities; omega of a damped oscillation.
            type(modes_t), intent(in) :: modes
            real(dp), intent(inout) :: omega2(:)
            real(dp), dimension(n, n) :: beside, drag
            real(dp) :: free

            call put_forces(system, modes, samples%stiffness(:, :, draw), &
                            samples%turning(:, :, draw), omega2)
            if (samples%decay == 0) return
            call stiffness_beside(system, modes%at, beside)
            call damping_matrix(system, modes%at, drag)
            call damp(system, modes, omega2)
            free = (modes%stiffness(1, 1) + beside(1, 1))/modes%mass(1, 1)
            call put_rates(drag(1, 1)/(2.0_dp*modes%mass(1, 1)), free)
        end subroutine add_forces

        subroutine put_rates(gamma, free)
            !! \(\gamma\) and \(\omega_0\), if that is a number, for all states of this draw.
            real(dp), intent(in) :: gamma, free

            associate (rows => samples%values((draw - 1)*states + 1:draw*states, :))
                rows(:, samples%decay) = gamma
                rows(:, samples%decay + 1) = sqrt(free)
            end associate
        end subroutine put_rates
    end subroutine add_modes

    subroutine put_other_modes(samples, system, draw, others)
        !! The oscillations about another equilibrium.
        type(samples_t), intent(inout) :: samples  !! get them
        class(system_t), intent(in) :: system      !! with the parameters of this draw
        integer, intent(in) :: draw                !! its number
        type(modes_t), intent(in) :: others        !! about that equilibrium, solved
        integer :: n

        n = system%ndof
        samples%omega2(draw, n + 1:) = 0.0_dp
        samples%omega2(draw, n + 1:n + size(others%omega2)) = others%omega2
        if (allocated(others%stiffness)) then
            samples%other_equilibrium(:, draw) = others%at
            samples%other_stiffness(:, :, draw) = others%stiffness
            samples%other_inertia(:, :, draw) = others%mass
            call put_forces(system, others, samples%other_stiffness(:, :, draw), &
                            samples%other_turning(:, :, draw), &
                            samples%omega2(draw, n + 1:2*n))
        end if
        if (samples%decay > 0) call damp(system, others, samples%omega2(draw, n + 1:))
    end subroutine put_other_modes

    subroutine put_forces(system, modes, stiffness, turning, omega2)
        !! Forces beside L: their slopes by the places belong to K, and change \(\omega^2\); those
        !! by the velocities to G, which stays NaN where constraints bind.
        class(system_t), intent(in) :: system
        type(modes_t), intent(in) :: modes
        real(dp), intent(inout) :: stiffness(:, :), turning(:, :), omega2(:)
        real(dp), dimension(system%ndof, system%ndof) :: beside, drag, shapes
        logical :: known

        call stiffness_beside(system, modes%at, beside)
        call damping_matrix(system, modes%at, drag)
        if (allocated(modes%basis)) return
        turning = modes%gyroscopic + drag
        if (.not. any(is_nonzero(beside))) return
        stiffness = modes%stiffness + beside
        if (any(is_nonzero(turning))) then
            omega2 = 0.0_dp
        else
            call unsymmetric_modes(stiffness, modes%mass, omega2, shapes, known)
        end if
    end subroutine put_forces

    subroutine damp(system, modes, omega2)
        !! \(\omega^2 = K/M - (C/2M)^2\).
        class(system_t), intent(in) :: system
        type(modes_t), intent(in) :: modes
        real(dp), intent(inout) :: omega2(:)
        real(dp), dimension(1, 1) :: beside, drag

        call stiffness_beside(system, modes%at, beside)
        call damping_matrix(system, modes%at, drag)
        omega2 = (modes%stiffness(1, 1) + beside(1, 1))/modes%mass(1, 1) - &
                 (drag(1, 1)/(2.0_dp*modes%mass(1, 1)))**2
    end subroutine damp

    pure function stable_somewhere(samples) result(yes)
        !! Oscillates it for some of the parameters about the equilibrium at or near zero, or for
        !! none? Where a hoop turns so fast that the lowest point is unstable, it does not.
        type(samples_t), intent(in) :: samples  !! know the modes
        logical :: yes
        logical :: tilted
        integer :: draw, n

        n = samples%ndof
        yes = all(is_zero(samples%omega2(:, :n)))
        do draw = 1, draws
            associate (place => samples%other_equilibrium(:, draw))
                tilted = .not. any(abs(place) > 1e-9_dp) .and. &
                         any(samples%omega2(draw, n + 1:) < 0.0_dp)
            end associate
            yes = yes .or. (all(samples%omega2(draw, :n) > 0.0_dp) .and. .not. tilted)
        end do
    end function stable_somewhere

    pure subroutine put_places(samples, equilibrium, values)
        !! `theta_eq`, for each draw of parameters.
        type(samples_t), intent(in) :: samples         !! know where it stands
        real(dp), intent(in) :: equilibrium(:, :)      !! (ndof, draws)
        real(dp), intent(inout) :: values(:, :)        !! (draws*states, symbols)
        integer :: row

        do row = 1, size(values, 1)
            values(row, samples%place) = equilibrium(:, 1 + (row - 1)/states)
        end do
    end subroutine put_places
end module lagrangia_mode_samples
