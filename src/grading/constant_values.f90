module lagrangia_constant_values
    !! Values of constants of integration at states of the motion, by Newton's method.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_derivative, only: derivative
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use lagrangia_motion_values, only: values_of
    use lagrangia_number_class, only: all_finite
    use lagrangia_sample_names, only: samples_t
    use lagrangia_sampled_formula, only: evaluate_nodes
    implicit none (type, external)
    private
    public :: draw_constants, solve_constants

    integer, parameter :: steps = 60        !! of Newton, from each start
    integer, parameter :: enough = 4        !! states at which there is such a constant
    integer, parameter :: most_starts = 12  !! of Newton for several constants
    real(dp), parameter :: largest = 1e8_dp !! beyond it Newton ran away

contains

    subroutine draw_constants(samples, constants, values)
        !! The samples' values, and behind them constants of any size.
        type(samples_t), intent(in) :: samples               !! on the motion
        integer, intent(in) :: constants                     !! how many
        real(dp), allocatable, intent(out) :: values(:, :)   !! (states, symbols and constants)
        real(dp), parameter :: golden = 0.6180339887498949_dp
        integer :: j, n, row

        n = size(samples%role)
        allocate (values(size(samples%values, 1), n + constants))
        values(:, :n) = samples%values
        do row = 1, size(values, 1)
            do j = 1, constants
                values(row, n + j) = 0.3_dp + 1.3_dp*modulo(golden*(7*j + row), 1.0_dp)
            end do
        end do
    end subroutine draw_constants

    subroutine solve_constants(equations, places, values, regular)
        !! As many equations as constants, at each state; NaN where it has no solution.
        type(expression_t), intent(in) :: equations(:)  !! left less right sides
        integer, intent(in) :: places(:)                !! of the constants
        real(dp), intent(inout) :: values(:, :)         !! (states, symbols); become solutions
        logical, intent(out) :: regular                 !! a step can be made somewhere
        type(expression_t) :: slopes(size(places), size(places))
        real(dp), dimension(size(values, 1), size(places)) :: best, drawn, f, step
        real(dp) :: jacobian(size(values, 1), size(places), size(places))
        integer :: begun, j, k, turn

        drawn = values(:, places)
        best = ieee_value(1.0_dp, ieee_quiet_nan)
        regular = .false.
        do j = 1, size(places)
            do k = 1, size(places)
                slopes(j, k) = derivative(equations(j), places(k))
            end do
        end do
        do begun = 1, merge(4, most_starts, size(places) == 1)
            values(:, places) = drawn + real(begun, dp)*0.7_dp - 1.4_dp
            do turn = 1, steps
                do j = 1, size(places)
                    f(:, j) = values_of(equations(j), values)
                    do k = 1, size(places)
                        jacobian(:, j, k) = values_of(slopes(j, k), values)
                    end do
                end do
                call find_step(jacobian, f, step)
                regular = regular .or. any(ieee_is_finite(step))
                values(:, places) = values(:, places) - step
                if (.not. any(abs(step) > 1e-15_dp*abs(values(:, places)))) exit
            end do
            do j = 1, size(step, 1)
                if (all_finite(best(j, :))) cycle
                if (.not. all(abs(values(j, places)) < largest)) cycle
                if (.not. all(abs(step(j, :)) <= 1e-13_dp*(abs(values(j, places)) + 1e-3_dp))) cycle
                if (.not. all([(vanishes(equations(k), values(j:j, :)), k=1, size(places))])) cycle
                best(j, :) = values(j, places)
            end do
            if (count(ieee_is_finite(best(:, 1))) >= merge(enough, size(best, 1), &
                                                           size(places) == 1)) exit
        end do
        values(:, places) = best
    end subroutine solve_constants

    function vanishes(equation, values) result(yes)
        !! Beside the terms that add up to it?
        type(expression_t), intent(in) :: equation  !! left less right side
        real(dp), intent(in) :: values(:, :)        !! of one state
        logical :: yes
        real(dp), dimension(1, equation%count) :: results, sizes

        call evaluate_nodes(equation, values, results, sizes=sizes)
        yes = abs(results(1, equation%count)) <= 1e-9_dp*sizes(1, equation%count)
    end function vanishes

    subroutine find_step(jacobian, f, step)
        !! Newton's step at each state; NaN where the constants do not follow from the equations.
        real(dp), intent(in) :: jacobian(:, :, :)   !! (states, equations, constants)
        real(dp), intent(in) :: f(:, :)             !! (states, equations)
        real(dp), intent(out) :: step(:, :)         !! (states, constants)
        real(dp) :: x(size(f, 2))
        type(error_t), allocatable :: error
        integer :: row

        do row = 1, size(f, 1)
            if (size(f, 2) == 1) then
                step(row, 1) = f(row, 1)/jacobian(row, 1, 1)
                cycle
            end if
            step(row, :) = ieee_value(1.0_dp, ieee_quiet_nan)
            if (.not. all_finite(jacobian(row, :, :))) cycle
            if (.not. all_finite(f(row, :))) cycle
            call solve_linear(jacobian(row, :, :), f(row, :), x, error)
            if (.not. allocated(error)) step(row, :) = x
        end do
    end subroutine find_step
end module lagrangia_constant_values
