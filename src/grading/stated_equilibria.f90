module lagrangia_stated_equilibria
    !! `theta_eq = pi`: an equilibrium beside those that `modes` shows.
    use lagrangia_derivative, only: derivative
    use lagrangia_expression, only: expression_t, kind_symbol, operator(+)
    use lagrangia_kinds, only: dp
    use lagrangia_motion_values, only: values_of
    use lagrangia_sample_names, only: draws, samples_t, states
    use lagrangia_slip_search, only: holds
    use lagrangia_written_out, only: energy_formulas, in_coordinates
    implicit none (type, external)
    private
    public :: another_equilibrium, is_equilibrium, keep_equilibrium

    character(*), parameter :: another_equilibrium = "another equilibrium than that at or near zero"
    !! what is said of one

contains

    function is_equilibrium(left, right, samples) result(yes)
        !! A place alone on the left side, and on the right one where no force acts at rest: all
        !! \(\partial L/\partial q_j+Q_j=0\), the other coordinates at their equilibrium.
        type(expression_t), intent(in) :: left, right  !! both sides
        type(samples_t), intent(in) :: samples         !! know L and the forces
        logical :: yes
        type(expression_t), allocatable :: formulas(:)
        type(expression_t) :: force
        real(dp), allocatable :: values(:, :)
        integer :: j, n, place, which
        logical :: judged

        n = samples%ndof
        yes = left%count == 1 .and. left%nodes(1)%kind == kind_symbol .and. &
              samples%lagrangian%count > 0
        if (.not. yes) return
        place = findloc(samples%place, left%nodes(1)%which, 1)
        yes = place > 0 .and. .not. any([(right%depends_on(j), j=1, 1 + 3*n)])
        if (.not. yes) return
        values = samples%values
        values(:, 2:n + 1) = values(:, samples%place)
        values(:, place + 1) = values_of(right, values)
        values(:, n + 2:3*n + 1) = 0.0_dp
        call energy_formulas(samples, formulas)
        do j = 1, n
            force = derivative(formulas(1), 1 + j)
            which = samples%symbols%find_definition("Q_"//trim(samples%symbols%names(1 + j)))
            if (which > 0) then
                associate (beside => samples%symbols%definitions(which)%meaning)
                    if (force%count == 0) then
                        force = in_coordinates(beside, samples)
                    else
                        force = force + in_coordinates(beside, samples)
                    end if
                end associate
            end if
            if (force%count == 0) cycle
            call holds(force, values, yes, judged)
            yes = yes .and. judged
            if (.not. yes) return
        end do
    end function is_equilibrium

    subroutine keep_equilibrium(residual, samples)
        !! Where there is one coordinate and no other equilibrium, the oscillations about the one
        !! that a line has stated: \(M=\partial^2L/\partial\dot q^2\),
        !! \(K=-\partial^2L/\partial q^2\).
        type(expression_t), intent(in) :: residual  !! the place less its value
        type(samples_t), intent(inout) :: samples   !! get it as the other one
        type(expression_t), allocatable :: formulas(:)
        type(expression_t) :: inertia, stiffness
        real(dp), allocatable :: values(:, :), m(:), k(:)
        integer :: draw, row

        if (samples%ndof /= 1) return
        if (any(abs(samples%other_equilibrium - samples%equilibrium) > 0.0_dp)) return
        call energy_formulas(samples, formulas)
        inertia = derivative(derivative(formulas(1), 3), 3)
        stiffness = derivative(derivative(formulas(1), 2), 2)
        if (inertia%count == 0 .or. stiffness%count == 0) return
        values = samples%values
        values(:, samples%place(1)) = 0.0_dp
        values(:, 2) = -values_of(residual, values)
        values(:, 3) = 0.0_dp
        m = values_of(inertia, values)
        k = -values_of(stiffness, values)
        do draw = 1, draws
            row = (draw - 1)*states + 1
            samples%other_equilibrium(1, draw) = values(row, 2)
            samples%other_inertia(1, 1, draw) = m(row)
            samples%other_stiffness(1, 1, draw) = k(row)
            samples%other_turning(1, 1, draw) = samples%turning(1, 1, draw)
            samples%omega2(draw, 2) = k(row)/m(row)
            if (samples%decay > 0) samples%omega2(draw, 2) = samples%omega2(draw, 2) - &
                (samples%turning(1, 1, draw)/(2.0_dp*m(row)))**2
        end do
    end subroutine keep_equilibrium
end module lagrangia_stated_equilibria
