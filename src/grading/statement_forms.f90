module lagrangia_statement_forms
    !! What a statement is that is no plain equality: a new name, a constant of the motion, a
    !! period, a motion, a value.
    use lagrangia_derivative, only: time_derivative
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: constant, expression_t, kind_symbol, operator(/), symbol
    use lagrangia_kinds, only: dp
    use lagrangia_sample_names, only: role_coordinate, role_frequency, role_parameter, samples_t
    use lagrangia_symbols, only: check_name
    implicit none (type, external)
    private
    public :: define_rates, speaks_of_place
    public :: is_constancy, is_motion, is_new_name, is_slope, is_value, read_as_period

contains

    pure function is_new_name(text, samples) result(yes)
        !! Is it a name alone, which nobody has given yet? What looks like a velocity or a momentum
        !! of an unknown coordinate is a mistake.
        character(*), intent(in) :: text            !! one side, as typed
        type(samples_t), intent(in) :: samples      !! know the names
        logical :: yes
        type(error_t), allocatable :: error
        character(len(text)) :: name

        name = adjustl(text)
        call check_name(trim(name), error)
        yes = .not. allocated(error)
        if (.not. yes) return
        yes = samples%symbols%find(trim(name)) == 0 .and. &
              samples%symbols%find_definition(trim(name)) == 0 .and. &
              samples%symbols%spelling(trim(name)) == name .and. index(name, "_d") == 0 .and. &
              index(name, "p_") /= 1 .and. index(name, "dL") /= 1
    end function is_new_name

    pure function is_slope(text) result(yes)
        !! `dV/dx` or `dT/dx_dot` alone, which stands for a formula that is right.
        character(*), intent(in) :: text  !! the left side, as typed
        logical :: yes
        character(len(text)) :: name

        name = adjustl(text)
        yes = any(name(:min(4, len(name))) == ["dV/d", "dT/d"]) .and. &
              scan(trim(name), " +-*^()") == 0
    end function is_slope

    pure function is_constancy(text, samples) result(yes)
        !! `p_x = const`, unless somebody has that name.
        character(*), intent(in) :: text            !! one side, as typed
        type(samples_t), intent(in) :: samples      !! know the names
        logical :: yes
        character(len(text)) :: word

        word = adjustl(text)
        yes = any(word == ["const    ", "const.   ", "constant ", "konst    ", "konst.   ", &
                           "konstant "])
        if (yes) yes = samples%symbols%find_definition(trim(word)) == 0 .and. &
                       samples%symbols%find(trim(word)) == 0
    end function is_constancy

    pure subroutine read_as_period(left, right, samples, is_period)
        !! `T = 2 pi sqrt(l/g)`: a kinetic energy moves. T is then \(2\pi/\omega\).
        type(expression_t), intent(inout) :: left   !! becomes that
        type(expression_t), intent(in) :: right     !! the other side
        type(samples_t), intent(in) :: samples      !! know the names
        logical, intent(inout) :: is_period         !! becomes true: the left side is as it must be
        integer :: k

        if (left%count /= 1 .or. left%nodes(1)%kind /= kind_symbol) return
        if (samples%symbols%names(left%nodes(1)%which) /= "T") return
        do k = 1, size(samples%role)
            if (.not. right%depends_on(k)) cycle
            if (samples%role(k) /= role_frequency .and. .not. is_fixed(samples, k)) return
        end do
        is_period = .true.
        left = constant(2.0_dp*acos(-1.0_dp))/symbol(samples%frequency)
    end subroutine read_as_period

    pure function is_motion(left, right, samples) result(yes)
        !! A coordinate alone on the left, and on the right side a function of the time.
        type(expression_t), intent(in) :: left, right   !! both sides
        type(samples_t), intent(in) :: samples          !! know the names
        logical :: yes
        integer :: k

        yes = left%count == 1 .and. left%nodes(1)%kind == kind_symbol .and. right%depends_on(1)
        if (yes) yes = samples%role(left%nodes(1)%which) == role_coordinate
        if (.not. yes) return
        do k = 2, size(samples%role)
            if (samples%role(k) == role_frequency .or. .not. right%depends_on(k)) cycle
            yes = yes .and. is_fixed(samples, k)
        end do
    end function is_motion

    pure function is_value(left, right, samples) result(yes)
        !! A parameter alone on the left, and a number on the right side.
        type(expression_t), intent(in) :: left, right   !! both sides
        type(samples_t), intent(in) :: samples          !! know the names
        logical :: yes

        yes = left%count == 1 .and. left%nodes(1)%kind == kind_symbol
        if (yes) yes = samples%role(left%nodes(1)%which) == role_parameter .and. &
                       .not. any(right%nodes(:right%count)%kind == kind_symbol)
    end function is_value

    pure function is_fixed(samples, k) result(yes)
        !! A parameter, or a rate of decay.
        type(samples_t), intent(in) :: samples
        integer, intent(in) :: k
        logical :: yes

        yes = samples%role(k) == role_parameter .and. samples%rate(k) == 0
        if (samples%decay > 0) yes = yes .or. k == samples%decay .or. k == samples%decay + 1
    end function is_fixed

    pure function speaks_of_place(residual, samples) result(yes)
        !! Of `theta_eq`, the place of an equilibrium.
        type(expression_t), intent(in) :: residual  !! left less right side
        type(samples_t), intent(in) :: samples      !! know where it stands
        logical :: yes
        integer :: i

        yes = any([(residual%depends_on(samples%place(i)), i=1, size(samples%place))])
    end function speaks_of_place

    subroutine define_rates(name, meaning, samples)
        !! `D_dot` and `D_ddot` of a definition, where all in it has rates.
        character(*), intent(in) :: name            !! of the definition
        type(expression_t), intent(in) :: meaning   !! what it stands for
        type(samples_t), intent(inout) :: samples   !! get the names
        type(expression_t) :: rate
        type(error_t), allocatable :: error
        integer :: i, k

        rate = meaning
        do k = 1, 2
            if (any([(rate%depends_on(i) .and. samples%symbols%rates(i) < 0, &
                      i=1, size(samples%role))])) return
            rate = time_derivative(rate, samples%symbols%rates, 1)
            call samples%symbols%define(name//trim(merge("_dot ", "_ddot", k == 1)), rate, error)
            if (allocated(error)) return
        end do
    end subroutine define_rates
end module lagrangia_statement_forms
