module lagrangia_motion_values
    !! Times, frequencies and constants at which a motion that is written out is tried.
    use lagrangia_derivative, only: derivative
    use lagrangia_expression, only: expression_t, kind_function
    use lagrangia_kinds, only: dp
    use lagrangia_sample_names, only: draws, samples_t, states
    use lagrangia_sampled_formula, only: evaluate_nodes
    use lagrangia_statement_forms, only: without_number
    implicit none (type, external)
    private
    public :: draw_values, is_frequency_name, no_such_mode, put_frequencies, rate_of
    public :: unknown_rate, values_of

contains

    subroutine draw_values(samples, n, values)
        !! Times and constants of their own for each state.
        type(samples_t), intent(in) :: samples               !! know the modes
        integer, intent(in) :: n                             !! symbols, with the constants
        real(dp), allocatable, intent(out) :: values(:, :)   !! (draws*states, n)
        real(dp), parameter :: golden = 0.6180339887498949_dp
        integer :: k, row

        allocate (values(draws*states, n))
        values(:, :size(samples%role)) = samples%values
        do row = 1, size(values, 1)
            values(row, 1) = 0.2_dp + 1.7_dp*modulo(golden*row, 1.0_dp)
            do k = size(samples%role) + 1, n
                values(row, k) = 0.3_dp + 1.3_dp*modulo(golden*(7*k + row) + 0.37_dp*k, 1.0_dp)
            end do
        end do
        call put_frequencies(samples, 1, values)
    end subroutine draw_values

    subroutine put_frequencies(samples, first, values)
        !! omega of the slowest mode that oscillates, and omega_1, omega_2 among the constants of
        !! all.
        type(samples_t), intent(in) :: samples               !! know the modes
        integer, intent(in) :: first               !! the first mode about the equilibrium
        real(dp), intent(inout) :: values(:, :)    !! (draws*states, symbols and constants)
        real(dp) :: omega2
        integer :: j, k, n, row

        do row = 1, size(values, 1)
            associate (modes => samples%omega2(1 + (row - 1)/states, first:first + &
                                               samples%ndof - 1))
                k = findloc(modes > 0.0_dp, .true., 1)
                omega2 = modes(max(1, k))
                values(row, samples%frequency) = sqrt(omega2)
                values(row, samples%frequency + 1) = omega2
            end associate
        end do
        n = size(samples%role)
        do j = 1, size(values, 2) - n
            k = mode_number(trim(samples%constants(j)), samples)
            if (k < 1 .or. k > samples%ndof) cycle
            do row = 1, size(values, 1)
                values(row, n + j) = sqrt(samples%omega2(1 + (row - 1)/states, first + k - 1))
            end do
        end do
    end subroutine put_frequencies

    pure function mode_number(name, samples) result(k)
        !! The mode of which `omega_2`, `w2` is the frequency: 2. Of one mode alone, 1 whatever
        !! the number; 0 for another name.
        character(*), intent(in) :: name             !! of a constant
        type(samples_t), intent(in) :: samples       !! know the modes
        integer :: k
        integer :: status

        k = 0
        if (without_number(name) == name .or. .not. is_frequency_name(name, samples)) return
        read (name(verify(name, "0123456789", back=.true.) + 1:), *, iostat=status) k
        if (status /= 0) k = huge(k)
        if (samples%ndof == 1) k = 1
    end function mode_number

    pure function no_such_mode(f, samples) result(name)
        !! A frequency in f whose number is that of no mode; empty: there is none.
        type(expression_t), intent(in) :: f                  !! of the time
        type(samples_t), intent(in) :: samples               !! know the modes
        character(:), allocatable :: name
        integer :: k

        name = ""
        do k = size(samples%constants), 1, -1
            if (.not. f%depends_on(size(samples%role) + k)) cycle
            if (mode_number(trim(samples%constants(k)), samples) > samples%ndof) name = &
                trim(samples%constants(k))
        end do
    end function no_such_mode

    pure function is_frequency_name(name, samples) result(yes)
        !! `omega_1`, `w2`: of a mode.
        character(*), intent(in) :: name             !! of a constant
        type(samples_t), intent(in) :: samples       !! know the modes
        logical :: yes
        character(:), allocatable :: stem

        stem = without_number(trim(name))
        yes = stem == "w" .or. stem == samples%symbols%names(samples%frequency)
    end function is_frequency_name

    pure function unknown_rate(f, samples) result(name)
        !! A constant that nobody has defined, w of cos(w t) or a of a t^2, on which it depends
        !! whether the motion is right; empty: there is none.
        type(expression_t), intent(in) :: f                  !! of the time
        type(samples_t), intent(in) :: samples               !! know the modes
        character(:), allocatable :: name
        type(expression_t) :: rate
        integer :: i, k

        name = ""
        do k = 1, size(samples%constants)
            if (.not. f%depends_on(size(samples%role) + k)) cycle
            if (is_frequency_name(samples%constants(k), samples)) cycle
            if (.not. any(f%nodes(:f%count)%kind == kind_function)) then
                rate = rate_of(f, 2)
                if (rate%depends_on(size(samples%role) + k)) name = trim(samples%constants(k))
            end if
            do i = 1, f%count
                if (f%nodes(i)%kind /= kind_function) cycle
                rate = derivative(f%pruned(f%nodes(i)%left), 1)
                if (rate%depends_on(size(samples%role) + k)) name = trim(samples%constants(k))
            end do
            if (name /= "") return
        end do
    end function unknown_rate

    pure function rate_of(f, times) result(d)
        !! A derivative by the time, of which all else is independent.
        type(expression_t), intent(in) :: f                  !! of the time
        integer, intent(in) :: times                         !! from 0
        type(expression_t) :: d
        integer :: k

        d = f
        do k = 1, times
            d = derivative(d, 1)
        end do
    end function rate_of

    function values_of(formula, values) result(y)
        !! One for each state.
        type(expression_t), intent(in) :: formula  !! not empty
        real(dp), intent(in) :: values(:, :)       !! (states, symbols)
        real(dp) :: y(size(values, 1))
        real(dp), dimension(size(values, 1), formula%count) :: results

        call evaluate_nodes(formula, values, results)
        y = results(:, formula%count)
    end function values_of
end module lagrangia_motion_values
