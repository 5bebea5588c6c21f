module lagrangia_solved_accelerations
    !! Accelerations in coordinates and velocities, so that what has them can be differentiated once
    !! more: \(\ddot r=r\dot\varphi^2-k/(mr^2)\).
    use lagrangia_derivative, only: derivative
    use lagrangia_expression, only: expression_t, operator(-), operator(/), whole
    use lagrangia_sample_names, only: samples_t
    use lagrangia_slip_search, only: holds
    use lagrangia_substitution, only: substituted
    use lagrangia_written_out, only: equation_of_motion
    implicit none (type, external)
    private
    public :: without_accelerations

contains

    function without_accelerations(expression, samples) result(e)
        !! With those written out whose equation of motion follows from L and has no other
        !! acceleration in it; the others stay.
        type(expression_t), intent(in) :: expression  !! of the samples' symbols, and of others
        type(samples_t), intent(in) :: samples        !! know L, and the forces beside it
        type(expression_t) :: e
        type(expression_t) :: equation, inertia, rest, solved(1), zero(1)
        integer :: coordinate, k, place
        logical :: judged, yes

        e = expression
        if (samples%lagrangian%count == 0) return
        zero(1) = whole(0)
        do coordinate = 1, samples%ndof
            place = samples%first_acceleration - 1 + coordinate
            if (.not. e%depends_on(place)) cycle
            equation = equation_of_motion(coordinate, samples)
            inertia = derivative(equation, place)
            if (inertia%count == 0) cycle
            if (any([(inertia%depends_on(k), k=samples%first_acceleration, &
                      samples%first_acceleration + samples%ndof - 1)])) cycle
            rest = substituted(equation, [place], zero)
            if (any([(rest%depends_on(k), k=samples%first_acceleration, &
                      samples%first_acceleration + samples%ndof - 1)])) cycle
            call holds(equation, samples%values, yes, judged)  ! no other forces act
            if (.not. yes) cycle
            solved(1) = zero(1) - rest/inertia
            e = substituted(e, [place], solved)
        end do
    end function without_accelerations
end module lagrangia_solved_accelerations
