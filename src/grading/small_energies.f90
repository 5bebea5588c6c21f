module lagrangia_small_energies
    !! Statements about L, T, V and E near an equilibrium, which hold to second order in the
    !! displacements and the velocities, as these are what equations of first order come from.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_expression, only: expression_t, kind_symbol
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: all_finite
    use lagrangia_sample_names, only: draws, role_acceleration, role_known, samples_t, states
    use lagrangia_sampled_formula, only: change_t, evaluate_nodes, summands
    use lagrangia_written_out, only: energy_formulas, energy_places, written_out
    implicit none (type, external)
    private
    public :: agreement_t
    public :: compare_energies, is_constant_of_each_draw, is_energy, put_same_constant

    real(dp), parameter :: zero = 1e-9_dp  !! of the sizes of what is added up

    type :: agreement_t
        !! Of both sides of a statement, up to second order.
        logical :: judged = .false.         !! there are numbers
        logical :: yes = .false.            !! all terms agree, but perhaps a constant
        logical :: but_constant = .false.   !! the constants are others
        logical :: same_motion = .false.    !! two different L have the same linear equations
    end type agreement_t

    type :: series_t
        !! \(f = f_0 + g\cdot z + z\cdot Hz/2\), z: displacements, then velocities.
        real(dp) :: value = 0.0_dp
        real(dp), allocatable :: slope(:), curvature(:, :)
    end type series_t

contains

    function is_constant_of_each_draw(residual, samples, change) result(yes)
        !! The same finite number, but for rounding, at all states with the same parameters.
        type(expression_t), intent(in) :: residual  !! not empty
        type(samples_t), intent(in) :: samples      !! on the motion
        type(change_t), intent(in), optional :: change  !! of one node
        logical :: yes
        real(dp), allocatable, dimension(:, :) :: results, sizes
        integer :: draw, first, last, n

        n = residual%count
        allocate (results(size(samples%values, 1), n), sizes(size(samples%values, 1), n))
        call evaluate_nodes(residual, samples%values, results, change, sizes)
        yes = .true.
        do draw = 1, draws
            first = (draw - 1)*states + 1
            last = draw*states
            yes = yes .and. all_finite(results(first:last, n))
            if (yes) yes = maxval(results(first:last, n)) - minval(results(first:last, n)) <= &
                           1e-8_dp*maxval(abs(results(first:last, n))) + &
                           1e-12_dp*maxval(sizes(first:last, n))
        end do
    end function is_constant_of_each_draw

    pure function is_energy(expression, samples) result(yes)
        !! Is it L, V or E alone, which have a constant that nobody sees?
        type(expression_t), intent(in) :: expression  !! a side of a statement
        type(samples_t), intent(in) :: samples        !! know the names
        logical :: yes

        yes = expression%count == 1 .and. expression%nodes(1)%kind == kind_symbol
        if (yes) yes = any(samples%symbols%names(expression%nodes(1)%which) == ["L", "V", "E"])
    end function is_energy

    subroutine compare_energies(left, residual, samples, at, counted_from_it, states_there, &
                                agreement)
        !! Both sides, near the places `at`; and L, T, V and E in `states_there` become what they
        !! are to second order, with the other side's constant where one does not count.
        type(expression_t), intent(in) :: left              !! its left side
        type(expression_t), intent(in) :: residual          !! left less right side, written out
        type(samples_t), intent(in) :: samples              !! know the formulas
        real(dp), intent(in) :: at(:, :)                    !! (ndof, draws)
        logical, intent(in) :: counted_from_it              !! the statement's q is zero there
        real(dp), intent(inout) :: states_there(:, :)       !! on the linear motion
        type(agreement_t), intent(out) :: agreement         !! of all draws with an equilibrium
        type(formula_program_t) :: energies, terms
        type(expression_t), allocatable :: formulas(:)
        integer, allocatable :: nodes(:)
        real(dp), allocatable :: signs(:)
        type(series_t) :: energy(4), difference
        real(dp) :: scale
        integer :: draw, k, places(4)

        places = energy_places(samples)
        call energy_formulas(samples, formulas)
        call new_formula_program(energies, formulas, size(samples%role))
        call summands(residual, nodes, signs)
        deallocate (formulas)
        allocate (formulas(size(nodes)))
        do k = 1, size(nodes)
            formulas(k) = residual%pruned(nodes(k))
        end do
        call new_formula_program(terms, formulas, size(samples%role))
        agreement%yes = .true.
        agreement%same_motion = is_energy(left, samples) .and. left%nodes(1)%which == places(1)
        do draw = 1, draws
            if (.not. all_finite(at(:, draw))) cycle
            call expand()
            if (.not. ieee_is_finite(scale)) then
                agreement%judged = .false.
                exit
            end if
            agreement%judged = .true.
            if (any(abs(difference%slope) > zero*scale) .or. &
                any(abs(difference%curvature) > zero*scale)) agreement%yes = .false.
            if (abs(difference%value) > zero*scale) agreement%but_constant = .true.
            if (agreement%same_motion) agreement%same_motion = same_linear_motion( &
                draw, energy(1), difference, samples, at, counted_from_it, states_there)
            call put_energies()
        end do
        agreement%yes = agreement%yes .and. agreement%judged .and. &
                        (is_energy(left, samples) .or. .not. agreement%but_constant)
        agreement%same_motion = agreement%same_motion .and. agreement%judged
    contains
        subroutine expand()
            !! The energies and the difference of both sides, with the size of its terms.
            type(hyperdual_t), dimension(size(samples%role)) :: x
            type(hyperdual_t) :: e(4), term(size(nodes))
            integer :: i, j, n

            n = samples%ndof
            scale = 0.0_dp
            do i = 1, 4
                call make_empty(energy(i), 2*n)
            end do
            call make_empty(difference, 2*n)
            do i = 1, 2*n
                do j = 1, i
                    x = hyperdual_t()
                    x%re = samples%values((draw - 1)*states + 1, :)
                    x(2:1 + n)%re = at(:, draw)
                    x(2 + n:1 + 2*n)%re = 0.0_dp
                    x(samples%place)%re = at(:, draw)
                    x(1 + i)%d1 = 1.0_dp
                    x(1 + j)%d2 = 1.0_dp
                    call energies%evaluate(x, e)
                    if (counted_from_it) x(2:1 + n)%re = 0.0_dp
                    do k = 1, 4
                        if (places(k) > 0) x(places(k)) = e(k)
                        call put_series(energy(k), i, j, e(k)%re, e(k)%d1, e(k)%d12)
                    end do
                    call terms%evaluate(x, term)
                    call put_series(difference, i, j, dot_product(signs, term%re), &
                                    dot_product(signs, term%d1), dot_product(signs, term%d12))
                    scale = max(scale, sum(abs(term%re)), sum(abs(term%d1)), sum(abs(term%d12)))
                    if (.not. all(ieee_is_finite(term%d12))) scale = ieee_value(1.0_dp, &
                                                                                ieee_quiet_nan)
                    if (.not. ieee_is_finite(scale)) return
                end do
            end do
        end subroutine expand

        subroutine put_energies()
            !! In the states of this draw.
            real(dp) :: z(2*samples%ndof)
            integer :: row

            do row = (draw - 1)*states + 1, draw*states
                z = displacement(states_there(row, :), at(:, draw), counted_from_it)
                do k = 1, 4
                    if (places(k) == 0) cycle
                    associate (f => energy(k))
                        states_there(row, places(k)) = f%value + dot_product(f%slope, z) + &
                            0.5_dp*dot_product(z, matmul(f%curvature, z))
                    end associate
                end do
                if (is_energy(left, samples)) then
                    k = left%nodes(1)%which
                    states_there(row, k) = states_there(row, k) - difference%value
                end if
            end do
        end subroutine put_energies
    end subroutine compare_energies

    pure function displacement(state, at, counted_from_it) result(z)
        !! From a place, and the velocities.
        real(dp), intent(in) :: state(:)        !! values of all symbols
        real(dp), intent(in) :: at(:)           !! the place, (ndof)
        logical, intent(in) :: counted_from_it  !! the coordinates are displacements
        real(dp) :: z(2*size(at))

        z = state(2:1 + 2*size(at))
        if (.not. counted_from_it) z(:size(at)) = z(:size(at)) - at
    end function displacement

    pure subroutine make_empty(series, n)
        !! Zero, of `n` variables.
        type(series_t), intent(inout) :: series
        integer, intent(in) :: n

        if (.not. allocated(series%slope)) allocate (series%slope(n), series%curvature(n, n))
        series%value = 0.0_dp
        series%slope = 0.0_dp
        series%curvature = 0.0_dp
    end subroutine make_empty

    pure subroutine put_series(series, i, j, value, slope, curvature)
        !! The derivatives by the variables `i` and `j`.
        type(series_t), intent(inout) :: series
        integer, intent(in) :: i, j
        real(dp), intent(in) :: value, slope, curvature

        series%value = value
        series%slope(i) = slope
        series%curvature(i, j) = curvature
        series%curvature(j, i) = curvature
    end subroutine put_series

    function same_linear_motion(draw, ours, difference, samples, at, counted_from_it, &
                                states_there) result(yes)
        !! Do Lagrange's equations of the other L hold on the linear motion, and not elsewhere?
        integer, intent(in) :: draw
        type(series_t), intent(in) :: ours, difference  !! L, and what it has more than the other
        type(samples_t), intent(in) :: samples
        real(dp), intent(in) :: at(:, :)
        logical, intent(in) :: counted_from_it
        real(dp), intent(in) :: states_there(:, :)
        logical :: yes
        type(series_t) :: other
        real(dp), dimension(samples%ndof) :: true_one, given, true_size, given_size
        integer :: n, row

        n = samples%ndof
        other%slope = ours%slope - difference%slope
        other%curvature = ours%curvature - difference%curvature
        yes = .false.
        do row = (draw - 1)*states + 1, draw*states
            associate (z => displacement(states_there(row, :), at(:, draw), counted_from_it), &
                       a => states_there(row, samples%first_acceleration: &
                                         samples%first_acceleration + n - 1))
                call lagrange(ours, z, a, true_one, true_size)
                call lagrange(other, z, a, given, given_size)
            end associate
            if (any(abs(given - true_one) > zero*(true_size + given_size) .and. &
                    abs(given) > zero*given_size)) return
        end do
        yes = all(maxval(abs(other%curvature(n + 1:, n + 1:)), 2) > zero*maxval(given_size))
    contains
        pure subroutine lagrange(l, z, a, residual, scale)
            !! \(d/dt\,\partial L/\partial\dot q_i - \partial L/\partial q_i\).
            type(series_t), intent(in) :: l
            real(dp), intent(in) :: z(:), a(:)
            real(dp), intent(out) :: residual(:), scale(:)

            associate (h => l%curvature, v => z(n + 1:))
                residual = matmul(h(n + 1:, n + 1:), a) + matmul(h(n + 1:, :n), v) - &
                           matmul(h(:n, :), z) - l%slope(:n)
                scale = matmul(abs(h(n + 1:, n + 1:)), abs(a)) + &
                        matmul(abs(h(n + 1:, :n)), abs(v)) + matmul(abs(h(:n, :)), abs(z)) + &
                        abs(l%slope(:n))
            end associate
        end subroutine lagrange
    end function same_linear_motion

    subroutine put_same_constant(left, as_typed, samples, values)
        !! L, V or E, which stands on the left side, with the constant that makes both sides equal
        !! at rest, at the equilibrium or, where there is none, at zero; left as it is where the
        !! sides have no numbers there.
        type(expression_t), intent(in) :: left       !! L, V or E alone
        type(expression_t), intent(in) :: as_typed   !! left less right side
        type(samples_t), intent(in) :: samples       !! know the formulas
        real(dp), intent(inout) :: values(:, :)      !! (draws*states, symbols)
        type(formula_program_t) :: energies, sides
        type(expression_t) :: residual
        type(expression_t), allocatable :: formulas(:)
        real(dp) :: x(size(samples%role)), e(4), difference(1)
        integer :: draw, k, places(4)

        places = energy_places(samples)
        residual = written_out(as_typed, samples)
        do k = 1, size(samples%role)
            if (any(places == k) .or. .not. residual%depends_on(k)) cycle
            if (samples%role(k) == role_acceleration .or. samples%role(k) >= role_known) return
        end do
        call energy_formulas(samples, formulas)
        call new_formula_program(energies, formulas, size(samples%role))
        call new_formula_program(sides, [residual], size(samples%role))
        do draw = 1, draws
            x = samples%values((draw - 1)*states + 1, :)
            x(2:1 + 2*samples%ndof) = 0.0_dp
            if (all_finite(samples%equilibrium(:, draw))) x(2:1 + samples%ndof) = &
                samples%equilibrium(:, draw)
            call energies%evaluate(x, e)
            do k = 1, 4
                if (places(k) > 0) x(places(k)) = e(k)
            end do
            call sides%evaluate(x, difference)
            if (.not. ieee_is_finite(difference(1))) cycle
            associate (column => values((draw - 1)*states + 1:draw*states, left%nodes(1)%which))
                column = column - difference(1)
            end associate
        end do
    end subroutine put_same_constant
end module lagrangia_small_energies
