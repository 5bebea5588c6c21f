module lagrangia_same_motion
    !! Another Lagrangian of the same motion.
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_sample_names, only: samples_t
    implicit none (type, external)
    private
    public :: lagrange_terms, same_equations

contains

    function same_equations(samples, lagrangian) result(yes)
        !! Whether another L has Lagrange's equations that hold on the motion, and do not elsewhere:
        !! \(L\) with a total time derivative, or a factor.
        type(samples_t), intent(in) :: samples          !! of a system
        type(expression_t), intent(in) :: lagrangian    !! of its symbols
        logical :: yes
        type(formula_program_t) :: program
        real(dp) :: on_motion(samples%ndof), elsewhere(samples%ndof), size_of(samples%ndof)
        real(dp) :: ours, given
        integer :: i, row

        call new_formula_program(program, [lagrangian], size(samples%role))
        yes = .false.
        do row = 1, size(samples%values, 1)
            call residuals(samples%values(row, :), on_motion, size_of)
            do i = 1, samples%ndof
                ours = column("d_dt_dL_d", "_dot") - column("dL_d", "")
                given = on_motion(i)
                if (.not. abs(given - ours) <= 1e-9_dp*(size_of(i) + abs(ours))) then
                    if (.not. abs(given) <= 1e-9_dp*size_of(i)) return
                end if
            end do
            call residuals(samples%elsewhere(row, :), elsewhere, size_of)
            if (.not. all(abs(elsewhere - on_motion) > 1e-9_dp*size_of)) return
        end do
        yes = .true.
    contains
        real(dp) function column(before, after)
            character(*), intent(in) :: before, after

            column = samples%values(row, samples%symbols%find( &
                     before//trim(samples%symbols%names(1 + i))//after))
        end function column

        subroutine residuals(values, residual, magnitude)
            !! \(d/dt\,\partial L/\partial\dot q_j - \partial L/\partial q_j\).
            real(dp), intent(in) :: values(:)
            real(dp), intent(out) :: residual(:), magnitude(:)
            real(dp), dimension(samples%ndof) :: momentum, rate, slope
            real(dp) :: value

            associate (first => samples%first_acceleration)
                call lagrange_terms(samples, program, values, &
                                    values(first:first + samples%ndof - 1), value, momentum, &
                                    rate, slope)
            end associate
            residual = rate - slope
            magnitude = abs(rate) + abs(slope)
        end subroutine residuals
    end function same_equations

    subroutine lagrange_terms(samples, program, values, a, value, momentum, rate, slope)
        !! L of a formula, \(\partial L/\partial\dot q_j\), its time derivative with the
        !! accelerations `a`, and \(\partial L/\partial q_j\).
        type(samples_t), intent(in) :: samples            !! know the names
        type(formula_program_t), intent(in) :: program    !! of L, of all symbols
        real(dp), intent(in) :: values(:)                 !! of the symbols
        real(dp), intent(in) :: a(:)                      !! accelerations, (ndof)
        real(dp), intent(out) :: value                    !! of L
        real(dp), intent(out) :: momentum(:)              !! (ndof)
        real(dp), intent(out) :: rate(:)                  !! of the momenta, (ndof)
        real(dp), intent(out) :: slope(:)                 !! (ndof)
        type(hyperdual_t) :: inputs(size(values)), l(1)
        integer :: j, k, n

        n = samples%ndof
        do j = 1, n
            do k = 1, 2
                inputs = hyperdual_t()
                inputs%re = values
                inputs(1)%d2 = 1.0_dp
                inputs(2:1 + n)%d2 = values(2 + n:1 + 2*n)
                inputs(2 + n:1 + 2*n)%d2 = a
                inputs(merge(1 + n, 1, k == 1) + j)%d1 = 1.0_dp
                call follow_letters(samples, inputs)
                call program%evaluate(inputs, l)
                value = l(1)%re
                if (k == 1) momentum(j) = l(1)%d1
                if (k == 1) rate(j) = l(1)%d12
                if (k == 2) slope(j) = l(1)%d1
            end do
        end do
    end subroutine lagrange_terms

    subroutine follow_letters(samples, inputs)
        !! The letters, from what they stand for; their rates as functions of the time.
        type(samples_t), intent(in) :: samples
        type(hyperdual_t), intent(inout) :: inputs(:)
        type(hyperdual_t) :: result(1)
        integer :: i, rate, second

        do i = 1, size(samples%compiled)
            call samples%compiled(i)%program%evaluate(inputs, result)
            inputs(samples%compiled(i)%symbol) = result(1)
            rate = samples%rate(samples%compiled(i)%symbol)
            if (rate == 0) cycle
            second = samples%rate(rate)
            if (second > 0) inputs(rate)%d2 = inputs(second)%re
        end do
    end subroutine follow_letters
end module lagrangia_same_motion
