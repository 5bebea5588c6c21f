module lagrangia_determined_accelerations
    !! Whether the right statements of a sheet determine the motion: which accelerations follow.
    use lagrangia_derivative, only: time_derivative
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: matrix_rank
    use lagrangia_number_class, only: all_finite, is_nonzero, is_zero
    use lagrangia_sample_names, only: role_acceleration, role_known, samples_t
    use lagrangia_sampled_formula, only: evaluate_nodes
    use lagrangia_slip_search, only: holds
    use lagrangia_verdict, only: is_right, judgement_t
    use lagrangia_written_out, only: written_out
    implicit none (type, external)
    private
    public :: find_determined

contains

    subroutine find_determined(samples, judgements, small, equations, determined)
        !! The accelerations that follow from the right statements: \(\partial R/\partial\ddot q\)
        !! of their residuals, and of the rates of those between velocities, has a unit vector among
        !! its combinations of rows in which no force of a constraint is left.
        type(samples_t), intent(in) :: samples              !! on the motion
        type(judgement_t), intent(in) :: judgements(:)      !! of all statements
        logical, intent(in) :: small(:)                     !! of each: true to first order only
        integer, intent(out) :: equations                   !! that have accelerations in them
        logical, allocatable, intent(out) :: determined(:)  !! of each acceleration, (ndof)
        type(expression_t) :: equation
        real(dp), allocatable :: rows(:, :)
        type(error_t), allocatable :: error
        integer, allocatable :: columns(:)
        integer :: i, j, rank, with_unit
        logical :: has_accelerations

        allocate (determined(samples%ndof), source=.false.)
        columns = [[(samples%first_acceleration + j - 1, j=1, samples%ndof)], samples%forces]
        allocate (rows(size(judgements) + 1, size(columns)), source=0.0_dp)
        equations = 0
        do i = 1, size(judgements)
            if (judgements(i)%verdict /= is_right .or. small(i)) cycle
            call find_equation(judgements(i), samples, equation)
            if (equation%count == 0) cycle
            call differentiate(equation, samples, columns, rows(i, :))
            if (all(is_zero(rows(i, :)))) cycle
            has_accelerations = any(is_nonzero(rows(i, :samples%ndof)))
            rows(i, :) = rows(i, :)/maxval(abs(rows(i, :)))
            if (has_accelerations) equations = equations + 1
        end do
        if (equations == 0) return
        call matrix_rank(rows, rank, error)
        if (allocated(error)) return
        do j = 1, samples%ndof
            rows(size(rows, 1), :) = 0.0_dp
            rows(size(rows, 1), j) = 1.0_dp
            call matrix_rank(rows, with_unit, error)
            if (allocated(error)) return
            determined(j) = with_unit == rank
        end do
    end subroutine find_determined

    subroutine find_equation(judgement, samples, equation)
        !! What a right statement says of accelerations: its residual, or the rate of one that says
        !! which velocities can be. Empty: nothing.
        type(judgement_t), intent(in) :: judgement
        type(samples_t), intent(in) :: samples
        type(expression_t), intent(out) :: equation
        type(expression_t) :: e
        real(dp), allocatable :: values(:, :)
        logical :: judged, yes
        integer :: k

        if (judgement%residual%count == 0) return
        if (judgement%of_motion) then
            ! where the masses are is not how they move
            if (any([(judgement%residual%depends_on(k), k=samples%first_point, &
                      samples%last_point)])) return
            equation = judgement%residual
            return
        end if
        e = written_out(judgement%residual, samples)
        do k = 1, size(samples%role)
            if (samples%role(k) /= role_known .and. samples%role(k) /= role_acceleration) cycle
            if (e%depends_on(k)) return
        end do
        values = samples%values
        do k = samples%ndof + 2, 2*samples%ndof + 1
            values(:, k) = (1.0_dp + 0.1_dp*k)*values(:, k) + 0.3_dp
        end do
        call holds(e, values, yes, judged)
        if (yes .or. .not. judged) return  ! it is true of any velocities
        equation = time_derivative(e, samples%rate, 1)
    end subroutine find_equation

    subroutine differentiate(residual, samples, columns, row)
        !! \(\partial R/\partial\ddot q\) and by the forces, from half of each, or one that is not
        !! 0, at the first sample where R has values: a root has none where its argument is
        !! negative. Zero where there is none.
        type(expression_t), intent(in) :: residual
        type(samples_t), intent(in) :: samples
        integer, intent(in) :: columns(:)  !! places by which it is differentiated
        real(dp), intent(out) :: row(:)    !! (columns)
        real(dp), allocatable :: values(:, :), before(:, :), after(:, :)
        real(dp) :: step
        integer :: j, k

        allocate (before(1, residual%count), after(1, residual%count))
        do k = 1, size(samples%values, 1)
            values = samples%values(k:k, :)
            call evaluate_nodes(residual, values, before)
            do j = 1, size(columns)
                values = samples%values(k:k, :)
                step = 0.5_dp*values(1, columns(j))
                if (.not. is_nonzero(step)) step = 1.0_dp
                values(1, columns(j)) = values(1, columns(j)) - step
                call evaluate_nodes(residual, values, after)
                row(j) = (before(1, residual%count) - after(1, residual%count))/step
            end do
            if (all_finite(row)) return
        end do
        row = 0.0_dp
    end subroutine differentiate
end module lagrangia_determined_accelerations
