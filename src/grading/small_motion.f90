module lagrangia_small_motion
    !! Statements about small oscillations, which hold to first order in coordinates, velocities and
    !! accelerations: what these are on the motion of the linearised equations.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use lagrangia_sample_names, only: draws, role_acceleration, role_frequency, role_parameter, &
                                      role_time, samples_t, states
    use lagrangia_sampled_formula, only: evaluate_nodes
    implicit none (type, external)
    private
    public :: small_motion

    real(dp), parameter :: beside_numbers = 1e-6_dp  !! \(\cos\theta = 1\), and not \(1 + \theta\)
    real(dp), parameter :: alone = 1e-12_dp
    !! where all terms vanish at rest, those of second order are negligible

contains

    subroutine small_motion(residual, samples, values, shown, refusal)
        !! States of \(M\ddot q + B\dot q + Kq = 0\) about zero, of a small amplitude at which
        !! `residual` vanishes to rounding if it does to first order.
        type(expression_t), intent(in) :: residual            !! left less right side
        type(samples_t), intent(in) :: samples                !! know M, B and K
        real(dp), allocatable, intent(out) :: values(:, :)    !! small ones, (draws*states, symbols)
        real(dp), allocatable, intent(out) :: shown(:, :)     !! as many, of a larger amplitude
        character(:), allocatable, intent(out) :: refusal     !! empty, or why there are none
        logical, allocatable :: moving(:)
        real(dp) :: a(samples%ndof), forces(samples%ndof), amplitude
        type(error_t), allocatable :: error
        integer :: draw, k, n, row

        n = samples%ndof
        allocate (moving(size(samples%role)))
        refusal = ""
        do k = 1, size(moving)
            moving(k) = samples%role(k) > role_time .and. samples%role(k) <= role_acceleration
            if (.not. residual%depends_on(k)) cycle
            if (moving(k) .or. is_constant(k)) cycle
            refusal = "'"//trim(samples%symbols%names(k))//"' in a statement behind 'small:'; "// &
                      "write one of coordinates, their rates and parameters"
            if (samples%role(k) == role_frequency) refusal = "omega behind 'small:', which is "// &
                "known there for one coordinate; write 'omega^2 = ...' without 'small:'"
            return
        end do
        if (.not. all(abs(samples%equilibrium) <= 0.0_dp)) then
            refusal = "no equilibrium at zero to oscillate about"
        else if (.not. all(ieee_is_finite(samples%turning))) then
            refusal = "the linearised motion is not known"
        end if
        if (refusal /= "") return
        allocate (shown, source=samples%values)
        do draw = 1, draws
            if (n == 1) then
                shown((draw - 1)*states + 1:draw*states, samples%frequency) = &
                    sqrt(samples%omega2(draw, 1))
                shown((draw - 1)*states + 1:draw*states, samples%frequency + 1) = &
                    samples%omega2(draw, 1)
            end if
            do row = (draw - 1)*states + 1, draw*states
                forces = -matmul(samples%stiffness(:, :, draw), shown(row, 2:1 + n)) &
                         - matmul(samples%turning(:, :, draw), shown(row, 2 + n:1 + 2*n))
                call solve_linear(samples%inertia(:, :, draw), forces, a, error)
                if (allocated(error)) then
                    refusal = error%message
                    return
                end if
                shown(row, samples%first_acceleration:samples%first_acceleration + n - 1) = a
            end do
        end do
        amplitude = merge(alone, beside_numbers, vanishes_at_rest())
        allocate (values, source=shown)
        do k = 1, size(moving)
            if (moving(k)) values(:, k) = amplitude*values(:, k)
        end do
    contains
        logical function is_constant(k)
            !! A parameter, gamma and what omega is without drag, and omega of one coordinate.
            integer, intent(in) :: k

            is_constant = samples%role(k) == role_parameter .and. samples%rate(k) == 0
            if (samples%decay > 0) is_constant = is_constant .or. k == samples%decay .or. &
                                                 k == samples%decay + 1
            if (n == 1) is_constant = is_constant .or. samples%role(k) == role_frequency
        end function is_constant

        logical function vanishes_at_rest()
            !! Each term does.
            real(dp), dimension(1, residual%count) :: results, sizes
            real(dp) :: rest(1, size(moving))

            rest(1, :) = merge(0.0_dp, shown(1, :), moving)
            call evaluate_nodes(residual, rest, results, sizes=sizes)
            vanishes_at_rest = sizes(1, residual%count) <= 0.0_dp
        end function vanishes_at_rest
    end subroutine small_motion
end module lagrangia_small_motion
