module lagrangia_slope_at_momentum
    !! The slope of an effective potential, in which the momenta of the other coordinates
    !! are constants whatever letters stand for them.
    use lagrangia_derivative, only: derivative
    use lagrangia_expression, only: expression_t, operator(*), operator(+), operator(-), &
                                    operator(/), whole
    use lagrangia_sample_names, only: samples_t
    use lagrangia_substitution, only: substituted
    implicit none (type, external)
    private
    public :: most_cyclic, slope_at_momentum

    integer, parameter :: most_cyclic = 3  !! coordinates beside the one of a potential

contains

    pure function slope_at_momentum(formula, place, lagrangian, samples) result(slope)
        !! \(\partial_q F + \sum_c(\partial\dot q_c/\partial q)_p\,\partial F/\partial\dot q_c\),
        !! c the other coordinates, with
        !! \(\sum_b(\partial p_a/\partial\dot q_b)(\partial\dot q_b/\partial q)_p =
        !! -\partial p_a/\partial q\) and \(p_a = \partial L/\partial\dot q_a\) at \(\dot q = 0\).
        type(expression_t), intent(in) :: formula     !! \(F(q, \dot q_c)\)
        integer, intent(in) :: place                  !! of the symbol \(q\)
        type(expression_t), intent(in) :: lagrangian  !! by coordinates and velocities, or empty
        type(samples_t), intent(in) :: samples        !! know the symbols
        type(expression_t) :: slope
        type(expression_t), dimension(samples%ndof - 1) :: momenta, rates
        type(expression_t) :: mass(samples%ndof - 1, samples%ndof - 1), still(1)
        integer :: i, k, others(samples%ndof - 1)

        slope = derivative(formula, place)
        if (lagrangian%count == 0) return
        others = pack([(1 + i, i=1 + samples%ndof, 2*samples%ndof)], &
                      [(i, i=1, samples%ndof)] /= place - 1)  ! the velocities
        if (.not. any([(formula%depends_on(others(i)), i=1, size(others))])) return
        still(1) = whole(0)
        do i = 1, size(others)
            momenta(i) = substituted(derivative(lagrangian, others(i)), [place + samples%ndof], &
                                     still)
            rates(i) = still(1) - derivative(momenta(i), place)
            do k = 1, size(others)
                mass(i, k) = derivative(momenta(i), others(k))
            end do
        end do
        call solve(mass, rates)
        do i = 1, size(others)
            slope = slope + derivative(formula, others(i))*rates(i)
        end do
    end function slope_at_momentum

    pure subroutine solve(a, x)
        !! \(a\,y = x\) by Gauss' elimination; \(a\) is positive definite, no pivot is sought.
        type(expression_t), intent(inout) :: a(:, :)  !! is used up
        type(expression_t), intent(inout) :: x(:)     !! becomes y
        type(expression_t) :: factor
        integer :: i, j, k

        do i = 1, size(x)
            do j = i + 1, size(x)
                if (a(j, i)%is_zero()) cycle
                factor = a(j, i)/a(i, i)
                x(j) = x(j) - factor*x(i)
                do k = i + 1, size(x)
                    a(j, k) = a(j, k) - factor*a(i, k)
                end do
            end do
        end do
        do i = size(x), 1, -1
            do k = i + 1, size(x)
                x(i) = x(i) - a(i, k)*x(k)
            end do
            x(i) = x(i)/a(i, i)
        end do
    end subroutine solve
end module lagrangia_slope_at_momentum
