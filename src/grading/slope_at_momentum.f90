module lagrangia_slope_at_momentum
    !! The slope of an effective potential, in which the momenta of the other coordinates
    !! are constants whatever letters stand for them.
    use lagrangia_derivative, only: derivative
    use lagrangia_expression, only: expression_t, operator(*), operator(-), operator(/), whole
    use lagrangia_sample_names, only: samples_t
    use lagrangia_substitution, only: substituted
    implicit none (type, external)
    private
    public :: slope_at_momentum

contains

    pure function slope_at_momentum(formula, place, lagrangian, samples) result(slope)
        !! \(\partial_q F + \sum_c(\partial\dot q_c/\partial q)_p\,\partial F/\partial\dot q_c\),
        !! c one or two other coordinates, with
        !! \(\sum_b(\partial p_a/\partial\dot q_b)(\partial\dot q_b/\partial q)_p =
        !! -\partial p_a/\partial q\) and \(p_a = \partial L/\partial\dot q_a\) at \(\dot q = 0\).
        type(expression_t), intent(in) :: formula     !! \(F(q, \dot q_c)\)
        integer, intent(in) :: place                  !! of the symbol \(q\)
        type(expression_t), intent(in) :: lagrangian  !! by coordinates and velocities, or empty
        type(samples_t), intent(in) :: samples        !! know the symbols
        type(expression_t) :: slope
        type(expression_t) :: determinant, momenta(2), still(1)
        integer :: i, n, others(2)

        slope = derivative(formula, place)
        if (samples%ndof > 3 .or. lagrangian%count == 0) return
        n = 0
        do i = 2 + samples%ndof, 1 + 2*samples%ndof  ! the velocities
            if (i == place + samples%ndof) cycle
            n = n + 1
            others(n) = i
        end do
        if (.not. any([(formula%depends_on(others(i)), i=1, n)])) return
        still(1) = whole(0)
        do i = 1, n
            momenta(i) = substituted(derivative(lagrangian, others(i)), [place + samples%ndof], &
                                     still)
        end do
        if (n == 1) then
            slope = slope - derivative(formula, others(1))*derivative(momenta(1), place)/ &
                    derivative(momenta(1), others(1))
            return
        end if
        determinant = derivative(momenta(1), others(1))*derivative(momenta(2), others(2)) - &
                      derivative(momenta(1), others(2))*derivative(momenta(2), others(1))
        do i = 1, 2
            associate (k => 3 - i)
                slope = slope - derivative(formula, others(i))* &
                        (derivative(momenta(k), others(k))*derivative(momenta(i), place) - &
                         derivative(momenta(i), others(k))*derivative(momenta(k), place))/ &
                        determinant
            end associate
        end do
    end function slope_at_momentum
end module lagrangia_slope_at_momentum
