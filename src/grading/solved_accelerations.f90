module lagrangia_solved_accelerations
    !! Accelerations in coordinates and velocities, so that what has them can be differentiated once
    !! more: \(\ddot r=r\dot\varphi^2-k/(mr^2)\).
    use lagrangia_derivative, only: derivative
    use lagrangia_expression, only: expression_t, operator(*), operator(-), operator(/), whole
    use lagrangia_sample_names, only: samples_t
    use lagrangia_slip_search, only: holds
    use lagrangia_substitution, only: substituted
    use lagrangia_written_out, only: equation_of_motion
    implicit none (type, external)
    private
    public :: has_accelerations, without_accelerations

contains

    function without_accelerations(expression, samples) result(e)
        !! With those written out whose equation of motion follows from L and has no other
        !! acceleration in it, or both of two coordinates; the others stay.
        type(expression_t), intent(in) :: expression  !! of the samples' symbols, and of others
        type(samples_t), intent(in) :: samples        !! know L, and the forces beside it
        type(expression_t) :: e
        type(expression_t) :: equation, inertia, rest, solved(1), zero(1)
        integer :: coordinate, place
        logical :: judged, yes

        e = expression
        if (samples%lagrangian%count == 0) return
        zero(1) = whole(0)
        do coordinate = 1, samples%ndof
            place = samples%first_acceleration - 1 + coordinate
            if (.not. e%depends_on(place)) cycle
            equation = equation_of_motion(coordinate, samples)
            inertia = derivative(equation, place)
            if (has_accelerations(inertia, samples)) cycle
            rest = substituted(equation, [place], zero)
            if (has_accelerations(rest, samples)) cycle
            call holds(equation, samples%values, yes, judged)  ! no other forces act
            if (.not. yes) cycle
            solved(1) = zero(1) - rest/inertia
            e = substituted(e, [place], solved)
        end do
        if (samples%ndof == 2 .and. has_accelerations(e, samples)) call write_out_two(samples, e)
    end function without_accelerations

    subroutine write_out_two(samples, e)
        !! \(M\ddot q + r = 0\) by Cramer's rule.
        type(samples_t), intent(in) :: samples      !! of two coordinates
        type(expression_t), intent(inout) :: e      !! as it was where M is not that of L alone
        type(expression_t) :: equation, m(2, 2), determinant, rest(2), solved(2), zeros(2)
        logical :: judged, yes
        integer :: i, j, places(2)

        places = samples%first_acceleration + [0, 1]
        zeros = whole(0)
        do i = 1, 2
            equation = equation_of_motion(i, samples)
            call holds(equation, samples%values, yes, judged)  ! no other forces act
            if (.not. yes) return
            rest(i) = substituted(equation, places, zeros)
            do j = 1, 2
                m(i, j) = derivative(equation, places(j))
                if (has_accelerations(m(i, j), samples)) return
            end do
        end do
        determinant = m(1, 1)*m(2, 2) - m(1, 2)*m(2, 1)
        solved(1) = (m(1, 2)*rest(2) - m(2, 2)*rest(1))/determinant
        solved(2) = (m(2, 1)*rest(1) - m(1, 1)*rest(2))/determinant
        e = substituted(e, places, solved)
    end subroutine write_out_two

    pure function has_accelerations(e, samples) result(yes)
        !! Is one of them left?
        type(expression_t), intent(in) :: e        !! of the samples' symbols
        type(samples_t), intent(in) :: samples     !! know which these are
        logical :: yes
        integer :: k

        yes = any([(e%depends_on(samples%first_acceleration - 1 + k), k=1, samples%ndof)])
    end function has_accelerations
end module lagrangia_solved_accelerations
