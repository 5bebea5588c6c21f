module lagrangia_small_motion
    !! Statements about small oscillations, which hold to first order in coordinates, velocities and
    !! accelerations: what these are on the motion of the linearised equations.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use lagrangia_mode_samples, only: put_places
    use lagrangia_number_class, only: all_finite
    use lagrangia_sample_names, only: draws, role_acceleration, role_coordinate, role_frequency, &
                                      role_parameter, role_time, role_velocity, samples_t, states
    use lagrangia_sampled_formula, only: evaluate_nodes
    use lagrangia_written_out, only: energy_places
    implicit none (type, external)
    private
    public :: linear_states, small_motion

    real(dp), parameter :: beside_numbers = 1e-6_dp  !! \(\cos\theta = 1\), and not \(1 + \theta\)
    real(dp), parameter :: alone = 1e-12_dp
    !! where all terms vanish at rest, those of second order are negligible

contains

    subroutine small_motion(residual, samples, about_other, counted_from_it, values, shown, &
                            refusal)
        !! States of \(M\ddot\delta + B\dot\delta + K\delta = 0\), \(q = q_0 + \delta\), of a
        !! small amplitude at which `residual` vanishes to rounding if it does to first order.
        type(expression_t), intent(in) :: residual            !! left less right side
        type(samples_t), intent(in) :: samples                !! know M, B and K
        logical, intent(in) :: about_other                    !! the other equilibrium
        logical, intent(in) :: counted_from_it                !! q is delta
        real(dp), allocatable, intent(out) :: values(:, :)    !! small ones, (draws*states, symbols)
        real(dp), allocatable, intent(out) :: shown(:, :)     !! as many, of a larger amplitude
        character(:), allocatable, intent(out) :: refusal     !! empty, or why there are none
        logical :: moving(size(samples%role))
        real(dp), allocatable :: places(:, :)
        real(dp) :: amplitude
        integer :: k, n

        moving = samples%role > role_time .and. samples%role <= role_acceleration
        call linear_states(residual, samples, about_other, .false., shown, refusal)
        if (refusal /= "") return
        n = samples%ndof
        places = shown(:, samples%place)
        if (counted_from_it) places = 0.0_dp
        amplitude = merge(alone, beside_numbers, &
                          vanishes_at_rest(residual, shown(1, :), places(1, :), moving))
        allocate (values, source=shown)
        do k = 1, size(moving)
            if (moving(k)) values(:, k) = amplitude*values(:, k)
        end do
        values(:, 2:1 + n) = values(:, 2:1 + n) + places
        shown(:, 2:1 + n) = shown(:, 2:1 + n) + places
    end subroutine small_motion

    subroutine linear_states(residual, samples, about_other, of_energies, shown, refusal)
        !! States of the linear motion, with displacements in the places of the coordinates.
        type(expression_t), intent(in) :: residual            !! left less right side
        type(samples_t), intent(in) :: samples                !! know M, B and K
        logical, intent(in) :: about_other                    !! the other equilibrium
        logical, intent(in) :: of_energies                    !! L, T, V and E are there
        real(dp), allocatable, intent(out) :: shown(:, :)     !! (draws*states, symbols)
        character(:), allocatable, intent(out) :: refusal     !! empty, or why there are none

        call find_refusal(residual, samples, of_energies, refusal)
        if (refusal /= "") return
        allocate (shown, source=samples%values)
        if (about_other) then
            call put_places(samples, samples%other_equilibrium, shown)
            call put_linear_motion(samples, samples%other_inertia, samples%other_turning, &
                                   samples%other_stiffness, samples%omega2(:, samples%ndof + 1), &
                                   shown, refusal)
        else
            call put_linear_motion(samples, samples%inertia, samples%turning, samples%stiffness, &
                                   samples%omega2(:, 1), shown, refusal)
        end if
    end subroutine linear_states

    pure subroutine find_refusal(residual, samples, of_energies, refusal)
        !! Why the statement has no first order, or there is no motion to compare it with.
        type(expression_t), intent(in) :: residual
        type(samples_t), intent(in) :: samples
        logical, intent(in) :: of_energies
        character(:), allocatable, intent(out) :: refusal
        logical :: known
        integer :: k

        refusal = ""
        do k = 1, size(samples%role)
            if (.not. residual%depends_on(k)) cycle
            select case (samples%role(k))
            case (role_time)
                known = .false.
            case (role_coordinate, role_velocity)
                known = .true.
            case (role_acceleration)
                known = .not. of_energies
            case default
                known = is_constant(samples, k) .or. &
                        (of_energies .and. any(energy_places(samples) == k))
            end select
            if (known) cycle
            refusal = "'"//trim(samples%symbols%names(k))//"' in a statement behind 'small:'; "// &
                      "write one of coordinates, their rates, energies, momenta and parameters"
            if (samples%role(k) == role_acceleration) refusal = "'"// &
                trim(samples%symbols%names(k))//"' in a statement about L or an energy, which "// &
                "have no accelerations"
            if (samples%role(k) == role_frequency) refusal = "omega behind 'small:', which is "// &
                "known there for one coordinate; write 'omega^2 = ...' without 'small:'"
            return
        end do
        if (.not. any(ieee_is_finite(samples%equilibrium))) then
            refusal = "no equilibrium to oscillate about"
        else if (.not. any(ieee_is_finite(samples%turning))) then
            refusal = "the linearised motion is not known"
        end if
    end subroutine find_refusal

    pure function is_constant(samples, k) result(yes)
        !! A parameter, gamma and what omega is without drag, and omega of one coordinate.
        type(samples_t), intent(in) :: samples
        integer, intent(in) :: k
        logical :: yes

        yes = samples%role(k) == role_parameter .and. samples%rate(k) == 0 .or. &
              any(samples%place == k)
        if (samples%decay > 0) yes = yes .or. k == samples%decay .or. k == samples%decay + 1
        if (samples%ndof == 1) yes = yes .or. samples%role(k) == role_frequency
    end function is_constant

    subroutine put_linear_motion(samples, inertia, turning, stiffness, omega2, shown, refusal)
        !! The accelerations of the linearised equations, with the displacements in the place of the
        !! coordinates, and omega of one coordinate; NaN where there is no equilibrium.
        type(samples_t), intent(in) :: samples
        real(dp), intent(in), dimension(:, :, :) :: inertia, turning, stiffness  !! (n, n, draws)
        real(dp), intent(in) :: omega2(:)                        !! (draws)
        real(dp), intent(inout) :: shown(:, :)                   !! states of any amplitude
        character(:), allocatable, intent(inout) :: refusal      !! if M is singular
        real(dp) :: a(samples%ndof), forces(samples%ndof)
        type(error_t), allocatable :: error
        integer :: draw, n, row

        n = samples%ndof
        do row = 1, draws*states
            draw = 1 + (row - 1)/states
            if (n == 1) then
                shown(row, samples%frequency) = sqrt(omega2(draw))
                shown(row, samples%frequency + 1) = omega2(draw)
            end if
            forces = -matmul(stiffness(:, :, draw), shown(row, 2:1 + n)) &
                     - matmul(turning(:, :, draw), shown(row, 2 + n:1 + 2*n))
            a = ieee_value(1.0_dp, ieee_quiet_nan)
            if (.not. all_finite(forces)) then
                shown(row, samples%first_acceleration:samples%first_acceleration + n - 1) = a
                cycle
            end if
            call solve_linear(inertia(:, :, draw), forces, a, error)
            if (allocated(error)) then
                refusal = error%message
                return
            end if
            shown(row, samples%first_acceleration:samples%first_acceleration + n - 1) = a
        end do
    end subroutine put_linear_motion

    function vanishes_at_rest(residual, state, place, moving) result(yes)
        !! Each term does.
        type(expression_t), intent(in) :: residual
        real(dp), intent(in) :: state(:), place(:)
        logical, intent(in) :: moving(:)
        logical :: yes
        real(dp), dimension(1, residual%count) :: results, sizes
        real(dp) :: rest(1, size(moving))

        rest(1, :) = merge(0.0_dp, state, moving)
        rest(1, 2:1 + size(place)) = place
        call evaluate_nodes(residual, rest, results, sizes=sizes)
        yes = sizes(1, residual%count) <= 0.0_dp
    end function vanishes_at_rest
end module lagrangia_small_motion
