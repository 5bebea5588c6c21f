module lagrangia_followed_letters
    !! The values of letters, quantities and energies, with their rates, at states whose
    !! coordinates, velocities and accelerations are known.
    use lagrangia_expression, only: expression_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_sample_names, only: role_known, samples_t
    use lagrangia_sampled_formula, only: evaluate_nodes
    implicit none (type, external)
    private
    public :: follow_elsewhere, follow_letters, is_rounding

contains

    subroutine follow_letters(samples, row)
        !! The letters, quantities, T and V, with their rates, at a state whose other values are
        !! known.
        type(samples_t), intent(inout) :: samples  !! names, and values that change
        integer, intent(in) :: row                 !! of the values
        real(dp) :: values(size(samples%role))

        values = samples%values(row, :)
        call follow(samples, .false., values)
        samples%values(row, :) = values
    end subroutine follow_letters

    subroutine follow_elsewhere(samples)
        !! The letters with their rates where accelerations and known values are others.
        type(samples_t), intent(inout) :: samples  !! names, and values elsewhere that change
        real(dp) :: values(size(samples%role))
        integer :: row

        do row = 1, size(samples%elsewhere, 1)
            values = samples%elsewhere(row, :)
            call follow(samples, .true., values)
            samples%elsewhere(row, :) = values
        end do
    end subroutine follow_elsewhere

    subroutine follow(samples, only_letters, values)
        type(samples_t), intent(in) :: samples
        logical, intent(in) :: only_letters   !! quantities, T and V keep their values
        real(dp), intent(inout) :: values(:)  !! of the symbols
        type(hyperdual_t) :: inputs(size(samples%role)), result(1)
        integer :: i, j, rate

        do i = 1, size(samples%compiled)
            if (only_letters .and. samples%role(samples%compiled(i)%symbol) == role_known) cycle
            inputs = hyperdual_t()
            inputs%re = values
            inputs(1)%d1 = 1.0_dp
            do j = 2, size(inputs)
                rate = samples%rate(j)
                if (rate == 0) cycle
                inputs(j)%d1 = values(rate)
                rate = samples%rate(rate)
                if (rate > 0) inputs(j)%d12 = values(rate)
            end do
            inputs%d2 = inputs%d1
            call samples%compiled(i)%program%evaluate(inputs, result)
            j = samples%compiled(i)%symbol
            values(j) = result(1)%re
            rate = samples%rate(j)
            if (rate == 0) cycle
            values(rate) = result(1)%d1
            if (is_rounding(samples%compiled(i)%rate, values)) values(rate) = 0.0_dp
            rate = samples%rate(rate)
            if (rate > 0) values(rate) = result(1)%d12
        end do
    end subroutine follow

    function is_rounding(formula, values) result(yes)
        !! Is its value no larger than the rounding errors of what is added up? What is conserved
        !! has the rate 0.
        type(expression_t), intent(in) :: formula  !! not empty
        real(dp), intent(in) :: values(:)          !! of the symbols
        logical :: yes
        real(dp), dimension(1, formula%count) :: results, sizes

        call evaluate_nodes(formula, reshape(values, [1, size(values)]), results, sizes=sizes)
        yes = abs(results(1, formula%count)) <= 1e-13_dp*sizes(1, formula%count)
    end function is_rounding
end module lagrangia_followed_letters
