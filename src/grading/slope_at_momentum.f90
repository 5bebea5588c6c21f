module lagrangia_slope_at_momentum
    !! The slope of an effective potential, in which the momentum of the other coordinate is a
    !! constant whatever letters stand for it.
    use lagrangia_derivative, only: derivative
    use lagrangia_expression, only: expression_t, operator(*), operator(-), operator(/), whole
    use lagrangia_sample_names, only: samples_t
    use lagrangia_substitution, only: substituted
    implicit none (type, external)
    private
    public :: slope_at_momentum

contains

    pure function slope_at_momentum(formula, place, lagrangian, samples) result(slope)
        !! \(\partial_q F + (\partial\dot\varphi/\partial q)_p\,\partial_{\dot\varphi}F\) of two
        !! coordinates q and \(\varphi\), with \((\partial\dot\varphi/\partial q)_p =
        !! -(\partial p/\partial q)/(\partial p/\partial\dot\varphi)\) and
        !! \(p = \partial L/\partial\dot\varphi\) at \(\dot q = 0\); of others \(\partial_q F\).
        type(expression_t), intent(in) :: formula     !! \(F(q, \dot\varphi)\)
        integer, intent(in) :: place                  !! of the symbol \(q\)
        type(expression_t), intent(in) :: lagrangian  !! by coordinates and velocities, or empty
        type(samples_t), intent(in) :: samples        !! know the symbols
        type(expression_t) :: slope
        type(expression_t) :: momentum, still(1)
        integer :: other, velocity

        slope = derivative(formula, place)
        if (samples%ndof /= 2 .or. lagrangian%count == 0) return
        velocity = place + 2
        other = 9 - velocity  ! symbols: t, two coordinates, two velocities
        if (.not. formula%depends_on(other)) return
        still(1) = whole(0)
        momentum = substituted(derivative(lagrangian, other), [velocity], still)
        slope = slope - derivative(formula, other)*derivative(momentum, place)/ &
                derivative(momentum, other)
    end function slope_at_momentum
end module lagrangia_slope_at_momentum
