module lagrangia_joint_motions
    !! Whether the motions of several coordinates, each of which solves the linearised equations,
    !! solve them together: in a mode the amplitudes have a ratio.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_expression, only: expression_t
    use lagrangia_kinds, only: dp
    use lagrangia_motion_values, only: put_frequencies, rate_of, values_of
    use lagrangia_number_class, only: all_finite, is_nonzero, is_zero
    use lagrangia_sample_names, only: samples_t, states
    use lagrangia_slip_search, only: holds
    use lagrangia_substitution, only: substituted
    use lagrangia_written_out, only: equation_of_motion
    implicit none (type, external)
    private
    public :: go_together, solve_exactly

    real(dp), parameter :: tolerance = 1e-8_dp  !! of terms that cancel

contains

    function go_together(coordinate, f, samples, values) result(yes)
        !! With `f` of one coordinate and the motions of others from lines before,
        !! \(M\dddot f+C\ddot f+K\dot f=0\) in each row in which all coordinates have one.
        integer, intent(in) :: coordinate         !! whose motion it is
        type(expression_t), intent(in) :: f       !! of the time
        type(samples_t), intent(in) :: samples    !! know the other motions
        real(dp), intent(in) :: values(:, :)      !! of all symbols and constants
        logical :: yes
        type(expression_t) :: motions(samples%ndof)
        logical :: counted
        integer :: compared, k, n

        n = samples%ndof
        motions = samples%motion
        motions(coordinate) = f
        yes = .true.
        counted = .false.
        do k = 1, 2*n  ! omega may be that of any mode, about either equilibrium
            if (.not. any(samples%omega2(:, k) > 0.0_dp)) cycle
            if (k <= n) yes = solve(samples%inertia, samples%turning, samples%stiffness)
            if (k > n) yes = solve(samples%other_inertia, samples%other_turning, &
                                   samples%other_stiffness)
            counted = counted .or. compared > 0
            if (yes .and. compared > 0) return
        end do
        yes = .not. counted
    contains
        logical function solve(inertia, turning, stiffness)
            !! Each row of them.
            real(dp), intent(in), dimension(:, :, :) :: inertia, turning, stiffness
            real(dp) :: at(size(values, 1), size(values, 2))
            real(dp) :: rates(size(values, 1), n, 3), turns(n, n), terms(n)
            type(expression_t) :: rate
            integer :: draw, i, j, order, row

            solve = .true.
            compared = 0
            at = values
            call put_frequencies(samples, merge(1, n + 1, k <= n), at)
            do row = 1, size(at, 1)
                associate (omega2 => samples%omega2(1 + (row - 1)/states, k))
                    at(row, samples%frequency) = sqrt(omega2)
                    at(row, samples%frequency + 1) = omega2
                end associate
            end do
            rates = 0.0_dp
            do j = 1, n
                do order = 1, 3
                    if (motions(j)%count == 0) cycle
                    rate = rate_of(motions(j), order)
                    rates(:, j, order) = values_of(rate, at)
                end do
            end do
            do row = 1, size(at, 1)
                draw = 1 + (row - 1)/states
                turns = turning(:, :, draw)
                where (.not. ieee_is_finite(turns)) turns = 0.0_dp
                do i = 1, n
                    if (any(motions%count == 0 .and. (is_nonzero(inertia(i, :, draw)) .or. &
                            is_nonzero(stiffness(i, :, draw)) .or. abs(turns(i, :)) > &
                                                      0.0_dp))) cycle
                    terms = inertia(i, :, draw)*rates(row, :, 3) + turns(i, :)*rates(row, :, 2) + &
                            stiffness(i, :, draw)*rates(row, :, 1)
                    if (.not. all_finite(terms) .or. all(is_zero(terms))) cycle
                    compared = compared + 1
                    if (abs(sum(terms)) > tolerance*sum(abs(inertia(i, :, draw)*rates(row, :, 3)) &
                        + abs(stiffness(i, :, draw)*rates(row, :, 1)))) solve = .false.
                end do
            end do
        end function solve
    end function go_together

    function solve_exactly(samples, values) result(yes)
        !! All coordinates have motions, and these solve \(d/dt\,\partial L/\partial\dot q_i -
        !! \partial L/\partial q_i = Q_i\).
        type(samples_t), intent(in) :: samples    !! know the motions, L and the forces
        real(dp), intent(in) :: values(:, :)      !! of all symbols and constants
        logical :: yes
        type(expression_t), allocatable :: put(:)
        type(expression_t) :: equation
        integer, allocatable :: places(:)
        integer :: i, n, order
        logical :: judged

        n = samples%ndof
        yes = all(samples%motion%count > 0) .and. samples%lagrangian%count > 0 .and. &
              allocated(samples%mass)
        if (.not. yes) return
        allocate (put(3*n))
        places = [(1 + i, i=1, 3*n)]
        do i = 1, n
            do order = 0, 2
                put(order*n + i) = rate_of(samples%motion(i), order)
            end do
        end do
        do i = 1, n
            equation = equation_of_motion(i, samples)
            call holds(equation, samples%values, yes, judged)
            if (.not. yes) return  ! other forces act
            call holds(substituted(equation, places, put), values, yes, judged)
            if (.not. yes) return
        end do
    end function solve_exactly
end module lagrangia_joint_motions
