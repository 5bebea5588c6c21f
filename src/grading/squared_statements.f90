module lagrangia_squared_statements
    !! Statements about omega with roots in them, by their squares.
    use lagrangia_explanation, only: explanation_t
    use lagrangia_expression, only: expression_t, kind_function, kind_symbol, operator(**), &
                                    operator(-), symbol
    use lagrangia_frequency_squares, only: square
    use lagrangia_further_slips, only: explain_further
    use lagrangia_kinds, only: dp
    use lagrangia_mode_choice, only: choose_modes, explain_modes
    use lagrangia_sample_names, only: samples_t
    use lagrangia_sampled_formula, only: evaluate_nodes
    use lagrangia_term_search, only: library_t
    implicit none (type, external)
    private
    public :: compare_squares, explain_squares

contains

    subroutine compare_squares(left, right, samples, right_one, found)
        !! Of `omega = sqrt(...)` or `T = 2 pi/sqrt(...)`, which has no number for those of the
        !! parameters at which the equilibrium is unstable: \(\omega^2\) is negative there.
        type(expression_t), intent(in) :: left, right   !! both sides
        type(samples_t), intent(in) :: samples          !! know the modes
        logical, intent(inout) :: right_one, found  !! become true where the squares agree
        type(expression_t) :: squares
        real(dp), allocatable :: values(:, :)
        logical :: known, yes
        integer :: first

        call subtract_squares(left, right, samples, squares, first)
        if (first == 0) then
            call compare_sizes(left, right, samples, right_one, found)
            return
        end if
        values = samples%values
        call choose_modes(squares, samples, values, yes, known)
        right_one = yes
        found = found .or. yes
    end subroutine compare_squares

    subroutine compare_sizes(left, right, samples, right_one, found)
        !! `omega = W sin(theta_eq)`, whose right side is negative for some of the parameters, or
        !! where the equilibrium is on the other side.
        type(expression_t), intent(in) :: left, right   !! both sides
        type(samples_t), intent(in) :: samples          !! know the modes
        logical, intent(inout) :: right_one, found  !! become true where the sizes agree
        real(dp), allocatable :: values(:, :), results(:, :)
        logical :: known, yes

        if (left%count /= 1 .or. left%nodes(1)%kind /= kind_symbol) return
        if (left%nodes(1)%which /= samples%frequency) return
        values = samples%values
        call choose_modes(symbol(samples%frequency + 1) - right**2, samples, values, yes, known)
        if (.not. yes) return
        allocate (results(size(values, 1), right%count))
        call evaluate_nodes(right, values, results)
        if (.not. any(results(:, right%count) > 0.0_dp)) then
            values(:, samples%place) = -values(:, samples%place)
            call evaluate_nodes(right, values, results)
            if (.not. any(results(:, right%count) > 0.0_dp)) return
        end if
        right_one = .true.
        found = .true.
    end subroutine compare_sizes

    subroutine explain_squares(left, right, samples, library, explanation, mode)
        !! Of a wrong `omega = sqrt(...)`: which change makes its square right.
        type(expression_t), intent(in) :: left, right           !! both sides
        type(samples_t), intent(in) :: samples                  !! know the modes
        type(library_t), intent(in) :: library(:)               !! right terms
        type(explanation_t), intent(inout) :: explanation  !! changes if there is one
        integer, intent(inout) :: mode                     !! of which it is right then
        type(expression_t) :: squares
        real(dp), allocatable :: values(:, :)
        type(explanation_t) :: of_squares
        logical :: known, yes
        integer :: first, of_mode

        if (right%nodes(right%count)%kind /= kind_function) return  ! no root
        call subtract_squares(left, right, samples, squares, first)
        if (first == 0) return
        values = samples%values
        call choose_modes(squares, samples, values, yes, known)
        if (.not. known) return
        call explain_modes(squares, first, samples, values, library, of_squares, of_mode)
        if (of_squares%is_empty()) call explain_further( &
            squares%pruned(squares%nodes(squares%count)%left), &
            squares%pruned(squares%nodes(squares%count)%right), samples, values, library, &
            of_squares)
        if (of_squares%is_empty()) return
        explanation%text = "squared: "//of_squares%text
        mode = of_mode
    end subroutine explain_squares

    pure subroutine subtract_squares(left, right, samples, squares, first)
        !! \(\text{left}^2 - \text{right}^2\), where the signs of both are known and it speaks of
        !! \(\omega^2\).
        type(expression_t), intent(in) :: left, right
        type(samples_t), intent(in) :: samples
        type(expression_t), intent(out) :: squares
        integer, intent(out) :: first  !! node of the right square; 0: they are not known
        type(expression_t) :: one, other

        first = 0
        one = square(left, samples%frequency)
        other = square(right, samples%frequency)
        if (one%count == 0 .or. other%count == 0) return
        squares = one - other
        if (squares%depends_on(samples%frequency + 1)) first = one%count + 1
    end subroutine subtract_squares
end module lagrangia_squared_statements
