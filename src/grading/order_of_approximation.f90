module lagrangia_order_of_approximation
    !! Approximations near an equilibrium: \(\cos\theta \approx 1 - \theta^2/2\) holds to
    !! the order that is written, \(\cos\theta \approx 1 - \theta^2\) to the first only.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_expression, only: expression_t, kind_difference, kind_negation, kind_number, &
                                    kind_power, kind_product, kind_quotient, kind_sum, &
                                    kind_symbol, operator(+), operator(-), symbol, whole
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero, is_zero
    use lagrangia_sample_names, only: role_acceleration, role_coordinate, role_parameter, &
                                      role_time, role_velocity, samples_t
    use lagrangia_sampled_formula, only: evaluate_nodes, summands
    use lagrangia_solved_accelerations, only: has_accelerations, without_accelerations
    use lagrangia_substitution, only: substituted
    use lagrangia_written_out, only: energy_formulas, energy_places
    implicit none (type, external)
    private
    public :: is_linear, is_negligible, order_that_fails

    real(dp), parameter :: no_polynomial = -1.0_dp

contains

    function order_that_fails(left, right, samples, given, of_energies, counted_from_it, shown) &
        result(order)
        !! Of a polynomial in the coordinates on one side, its degree, if what the other side leaves
        !! of it is of this order or of a lower one; else 0. Accelerations are those of the
        !! equations of motion, of one coordinate or two, without the squares of velocities. L, T, V
        !! and E are compared in coordinates and velocities, but for a constant. Where the statement
        !! is no such approximation, 0 too.
        type(expression_t), intent(in) :: left, right  !! both sides, written out
        type(samples_t), intent(in) :: samples         !! roles of the symbols
        logical, intent(in) :: given                   !! a momentum is on the left side
        logical, intent(in) :: of_energies             !! known to second order, else to the first
        logical, intent(in) :: counted_from_it         !! coordinates, from the equilibrium
        real(dp), intent(in) :: shown(:, :)            !! values of all symbols, of any amplitude
        real(dp) :: order
        type(expression_t) :: residual
        real(dp) :: degrees(2), highest
        integer :: k, n
        logical :: at_rest                             !! no velocities are compared

        order = 0.0_dp
        n = samples%ndof
        at_rest = has_accelerations(left, samples) .or. has_accelerations(right, samples)
        degrees = [degree(left, samples, .not. at_rest), degree(right, samples, .not. at_rest)]
        highest = maxval(degrees)
        if (highest <= merge(2.0_dp, 1.0_dp, of_energies)) return
        if (.not. (given .or. of_energies .or. at_rest .or. any(degrees < 0.0_dp))) return
        residual = exact(left) - exact(right)
        do k = 1, size(samples%role)
            if (any(samples%role(k) == [role_coordinate, role_parameter])) cycle
            if (.not. at_rest .and. samples%role(k) == role_velocity) cycle
            if (residual%depends_on(k) .and. all(samples%place /= k)) return
        end do
        ! between this order and the next whole one
        if (2.0_dp*leading_order(residual, samples, of_energies, counted_from_it, shown) < &
            highest + aint(highest) + 1.0_dp) order = highest
    contains
        function exact(side)
            !! Energies written out, and accelerations of a motion at a turning point.
            type(expression_t), intent(in) :: side
            type(expression_t) :: exact, accelerations(n), still(n)
            type(expression_t), allocatable :: energies(:)
            integer, allocatable :: places(:)
            integer :: i

            exact = side
            if (of_energies) then
                call energy_formulas(samples, energies)
                places = energy_places(samples)
                do i = 1, size(places)
                    if (places(i) == 0) cycle
                    energies(i) = about_place(energies(i))
                    exact = substituted(exact, places(i:i), energies(i:i))
                end do
            else if (has_accelerations(side, samples)) then
                still = whole(0)
                do i = 1, n
                    accelerations(i) = without_accelerations( &
                                       symbol(samples%first_acceleration - 1 + i), samples)
                    accelerations(i) = about_place(substituted(accelerations(i), &
                                                               [(1 + n + i, i=1, n)], still))
                end do
                exact = substituted(side, [(samples%first_acceleration - 1 + i, i=1, n)], &
                                    accelerations)
            end if
        end function exact

        function about_place(formula) result(f)
            !! Of coordinates that are counted as those of the statement are.
            type(expression_t), intent(in) :: formula
            type(expression_t) :: f, counted(n)
            integer :: i

            f = formula
            if (.not. counted_from_it) return
            do i = 1, n
                counted(i) = symbol(1 + i) + symbol(samples%place(i))
            end do
            f = substituted(f, [(1 + i, i=1, n)], counted)
        end function about_place
    end function order_that_fails

    function is_negligible(residual, samples, shown) result(yes)
        !! A single product of higher than first order near an equilibrium at zero.
        type(expression_t), intent(in) :: residual     !! left less right side
        type(samples_t), intent(in) :: samples         !! roles of the symbols
        real(dp), intent(in) :: shown(:, :)            !! values of all symbols, of any amplitude
        logical :: yes
        integer, allocatable :: nodes(:)
        real(dp), allocatable :: signs(:)

        yes = .false.
        if (any(is_nonzero(shown(:, samples%place)))) return
        call summands(residual, nodes, signs)
        if (count(residual%nodes(nodes)%kind /= kind_number) /= 1) return
        yes = leading_order(residual, samples, .false., .false., shown) > 1.5_dp
    end function is_negligible

    function is_linear(residual, samples, counted_from_it, shown) result(yes)
        !! What is left of it is of first order, also where that is less than the bound of rounding
        !! at a small amplitude: of \(\cos\arccos\) and the like that bound is far too large.
        type(expression_t), intent(in) :: residual     !! left less right side
        type(samples_t), intent(in) :: samples         !! roles of the symbols
        logical, intent(in) :: counted_from_it         !! coordinates, from the equilibrium
        real(dp), intent(in) :: shown(:, :)            !! values of all symbols, of any amplitude
        logical :: yes
        real(dp), parameter :: off = 0.1_dp            !! of a whole order

        yes = abs(leading_order(residual, samples, .false., counted_from_it, shown) - 1.0_dp) <= off
    end function is_linear

    function leading_order(residual, samples, but_constant, counted_from_it, shown) result(order)
        !! \(n\) where `residual` becomes \(\propto s^n\) as all that moves becomes \(\propto s\),
        !! from the equilibrium; infinite where it vanishes to rounding, NaN where it has no value.
        type(expression_t), intent(in) :: residual
        type(samples_t), intent(in) :: samples
        logical, intent(in) :: but_constant            !! less what it is at rest
        logical, intent(in) :: counted_from_it
        real(dp), intent(in) :: shown(:, :)
        real(dp) :: order
        real(dp), parameter :: amplitude = 0.02_dp, rounding = 1e3_dp*epsilon(1.0_dp)
        !! the largest amplitude tried; the smallest at which more than rounding is left decides
        real(dp), allocatable :: values(:, :), results(:, :), sizes(:, :)
        real(dp), dimension(size(shown, 1)) :: at_rest, far, near
        logical :: sound(size(shown, 1))
        integer :: k

        order = huge(order)
        at_rest = 0.0_dp
        allocate (values, source=shown)
        allocate (results(size(shown, 1), residual%count), sizes(size(shown, 1), residual%count))
        if (but_constant) then
            call scale(0.0_dp)
            call evaluate_nodes(residual, values, results)
            at_rest = results(:, residual%count)
        end if
        do k = 0, 5
            values = shown
            call scale(amplitude/4.0_dp**k)
            far = beside_rest()
            call scale(0.5_dp)
            near = beside_rest()
            sound = ieee_is_finite(far) .and. near > rounding*sizes(:, residual%count)
            if (.not. any(ieee_is_finite(near))) order = ieee_value(order, ieee_quiet_nan)
            if (.not. any(sound)) return
            order = log(sum(far, mask=sound)/sum(near, mask=sound))/log(2.0_dp)
        end do
    contains
        function beside_rest() result(size_of)
            !! That of the residual; `sizes` are those of its terms.
            real(dp) :: size_of(size(shown, 1))

            call evaluate_nodes(residual, values, results, sizes=sizes)
            size_of = abs(results(:, residual%count) - at_rest)
        end function beside_rest

        subroutine scale(factor)
            real(dp), intent(in) :: factor
            real(dp) :: places(size(values, 1), samples%ndof)
            integer :: j

            places = values(:, samples%place)
            if (counted_from_it) places = 0.0_dp
            values(:, 2:1 + samples%ndof) = values(:, 2:1 + samples%ndof) - places
            do j = 1, size(samples%role)
                if (samples%role(j) <= role_time .or. samples%role(j) > role_acceleration) cycle
                values(:, j) = factor*values(:, j)
            end do
            values(:, 2:1 + samples%ndof) = values(:, 2:1 + samples%ndof) + places
        end subroutine scale
    end function leading_order

    pure function degree(expression, samples, of_velocities) result(highest)
        !! In all coordinates, before anything cancels.
        type(expression_t), intent(in) :: expression
        type(samples_t), intent(in) :: samples
        logical, intent(in) :: of_velocities  !! and in all velocities
        real(dp) :: highest
        real(dp) :: of(expression%count)
        integer :: i

        do i = 1, expression%count
            associate (node => expression%nodes(i))
                select case (node%kind)
                case (kind_number)
                    of(i) = 0.0_dp
                case (kind_symbol)
                    of(i) = merge(1.0_dp, 0.0_dp, samples%role(node%which) == role_coordinate .or. &
                                  (of_velocities .and. samples%role(node%which) == role_velocity))
                case (kind_sum, kind_difference)
                    of(i) = max(of(node%left), of(node%right))
                    if (min(of(node%left), of(node%right)) < 0.0_dp) of(i) = no_polynomial
                case (kind_product)
                    of(i) = of(node%left) + of(node%right)
                    if (min(of(node%left), of(node%right)) < 0.0_dp) of(i) = no_polynomial
                case (kind_quotient)
                    of(i) = merge(of(node%left), no_polynomial, is_zero(of(node%right)))
                case (kind_power)
                    of(i) = of_power(node%left, node%right)
                case (kind_negation)
                    of(i) = of(node%left)
                case default  ! a function
                    of(i) = merge(0.0_dp, no_polynomial, is_zero(of(node%left)))
                end select
            end associate
        end do
        highest = of(expression%count)
    contains
        pure function of_power(base, exponent) result(product_of)
            !! An exponent multiplies the degree, be it whole or not.
            integer, intent(in) :: base, exponent  !! nodes
            real(dp) :: product_of

            product_of = merge(0.0_dp, no_polynomial, is_zero(of(base)) .and. is_zero(of(exponent)))
            if (of(base) <= 0.0_dp .or. expression%nodes(exponent)%kind /= kind_number) return
            associate (times => expression%nodes(exponent)%number%value)
                if (times >= 0.0_dp) product_of = of(base)*times
            end associate
        end function of_power
    end function degree
end module lagrangia_order_of_approximation
