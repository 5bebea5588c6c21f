module lagrangia_statement_forms
    !! What a statement is that is no plain equality: a new name, a constant of the motion, a
    !! period, a motion, a value.
    use lagrangia_derivative, only: time_derivative
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: constant, expression_t, f_sqrt, kind_function, &
                                    kind_number, kind_quotient, kind_symbol, operator(**), &
                                    operator(*), operator(-), operator(/), symbol, whole
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero, is_zero
    use lagrangia_sample_names, only: role_coordinate, role_frequency, role_known, role_parameter, &
                                      role_velocity, samples_t
    use lagrangia_slip_search, only: holds
    use lagrangia_substitution, only: substituted
    use lagrangia_symbols, only: check_name
    use lagrangia_tensions, only: tensions
    implicit none (type, external)
    private
    public :: define_by_period, define_rates, period, speaks_of_place, without_number
    public :: drop_root_of_name, find_frequency, read_as_period, read_new_name
    public :: has_velocities, is_about_other, is_branch, is_motion, is_slope, means_frequency, &
              value_remark

contains

    pure subroutine read_new_name(side, samples, name, squared)
        !! `v = ...` and `v^2 = ...`.
        character(*), intent(in) :: side                  !! the left one
        type(samples_t), intent(in) :: samples            !! know the names
        character(:), allocatable, intent(out) :: name    !! empty: it is none
        logical, intent(out) :: squared                   !! it stands in a square
        integer :: power

        name = trim(adjustl(side))
        power = index(name, "^")
        squared = power > 1
        if (squared) squared = adjustl(name(power + 1:)) == "2"
        if (squared) name = trim(name(:power - 1))
        call drop_arguments(name, samples)
        if (.not. is_new_name(name, samples)) name = ""
    end subroutine read_new_name

    pure subroutine drop_arguments(name, samples)
        !! `W` of `W(theta, theta_dot)`.
        character(:), allocatable, intent(inout) :: name
        type(samples_t), intent(in) :: samples
        integer :: first, last, opened, place

        opened = index(name, "(")
        if (opened < 2) return
        if (name(len(name):) /= ")" .or. name(:opened - 1) == "d") return
        first = opened + 1
        do while (first <= len(name))
            last = first + scan(name(first:), ",)") - 1
            place = samples%symbols%find(samples%symbols%spelling(trim(adjustl( &
                                                                  name(first:last - 1)))))
            if (place == 0 .or. place > 1 + 3*samples%ndof) return
            first = last + 1
        end do
        name = name(:opened - 1)
    end subroutine drop_arguments

    pure subroutine drop_root_of_name(side, left, right, samples)
        !! After `v^2 = l^2 theta_dot^2` says `v = l theta_dot` no more than the square of it.
        character(*), intent(in) :: side                  !! the left one, as typed
        type(expression_t), intent(inout) :: left, right  !! both sides; become their squares
        type(samples_t), intent(in) :: samples            !! know the names
        integer :: k

        if (samples%symbols%find_definition(trim(adjustl(side))) == 0) return
        if (left%nodes(left%count)%kind /= kind_function) return
        if (left%nodes(left%count)%which /= f_sqrt) return
        do k = 1, size(samples%role)
            if (is_fixed(samples, k) .or. .not. right%depends_on(k)) cycle
            left = left%pruned(left%nodes(left%count)%left)
            right = right**2
            return
        end do
    end subroutine drop_root_of_name

    pure subroutine find_frequency(name, meaning, samples, truth)
        !! What `omega_1`, `T_1`, `period`, `f` and `nu` must be if they are what they are
        !! called: only where they stand for a formula of constants.
        character(*), intent(in) :: name              !! a new one
        type(expression_t), intent(in) :: meaning     !! of it
        type(samples_t), intent(in) :: samples        !! know the names
        type(expression_t), intent(out) :: truth      !! with omega; empty: it may be anything
        character(:), allocatable :: stem
        integer :: k
        logical :: constants

        constants = .false.
        do k = 1, size(samples%role)
            if (.not. meaning%depends_on(k)) cycle
            if (.not. is_fixed(samples, k)) return
            constants = .true.
        end do
        if (.not. constants .and. .not. is_fixed_frequency(samples)) return
        stem = without_number(name)
        if (stem == trim(samples%symbols%names(samples%frequency)) .or. stem == "w") then
            truth = symbol(samples%frequency)
        else if (stem == "T" .or. stem == "tau" .or. name == "period") then
            truth = period(samples)
        else if (stem == "f" .or. stem == "nu") then
            truth = whole(1)/period(samples)
        end if
    end subroutine find_frequency

    pure function is_fixed_frequency(samples) result(yes)
        !! Do lines `set:` fix all on which the modes depend?
        type(samples_t), intent(in) :: samples
        logical :: yes

        yes = any(is_nonzero(samples%omega2)) .and. all(maxval(samples%omega2, 1) - &
            minval(samples%omega2, 1) <= 1e-12_dp*maxval(abs(samples%omega2)))
    end function is_fixed_frequency

    pure function means_frequency(name, samples) result(yes)
        !! `omega_1`: the frequency of a mode. `omega_0` may be one without a drive or the other
        !! rod, but for one coordinate that nothing turns or brakes.
        character(*), intent(in) :: name            !! of a definition
        type(samples_t), intent(in) :: samples      !! know how omega is called
        logical :: yes

        yes = without_number(name) == trim(samples%symbols%names(samples%frequency)) .and. &
              samples%decay == 0
        if (yes .and. scan(name, "0") > 0) yes = samples%ndof == 1 .and. &
            samples%symbols%names(samples%frequency) == "omega"
    end function means_frequency

    pure function without_number(name) result(stem)
        !! `omega` of `omega_1` and `omega1`.
        character(*), intent(in) :: name  !! of anything
        character(:), allocatable :: stem
        integer :: k

        k = verify(name, "0123456789", back=.true.)
        if (k > 1 .and. k < len(name)) then
            if (name(k:k) == "_") k = k - 1
        end if
        stem = name(:k)
    end function without_number

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
        !! `dV/dx`, `d^2T/dx_dot^2` or `V'(x)` alone, which stands for a formula that is right.
        character(*), intent(in) :: text  !! the left side, as typed
        logical :: yes
        character(*), parameter :: energies = "LTVUEHK"
        character(len(text)) :: name
        integer :: at

        name = adjustl(text)
        at = 1
        if (name(:1) == "d") at = 1 + verify(name(2:), "^2 ")
        yes = scan(name(at:at), energies) == 1 .and. scan(trim(name), "+-*=") == 0
        if (yes .and. name(at + 1:min(at + 4, len(name))) == "_eff") name(at + 1:at + 4) = " "
        if (yes .and. at > 1) yes = index(adjustl(name(at + 1:)), "/d") == 1
        if (yes .and. at == 1) yes = name(2:2) == "'"
    end function is_slope

    subroutine read_as_period(left, right, samples, is_period)
        !! `T = 2 pi sqrt(l/g)`, `T^2 = 4 pi^2 l/g`, `omega = 2 pi/T`: a kinetic energy moves, and
        !! never alone. T is then \(2\pi/\omega\).
        type(expression_t), intent(inout) :: left, right  !! both sides; T is written out there
        type(samples_t), intent(in) :: samples            !! know the names
        logical, intent(inout) :: is_period  !! becomes true: the left side, T, is as it must be
        type(expression_t) :: meaning(1)  ! gfortran 12 does not free what a constructor makes
        integer :: letter
        logical :: of_kinetic, judged

        letter = period_letter(left - right, samples)
        if (letter == 0) return
        call holds(left - right, samples%values, of_kinetic, judged)
        if (of_kinetic) return  ! of a motion with one velocity, `T = m/2 v_0^2`
        if (right%count == 1 .and. is_zero(right%nodes(1)%number%value) .and. &
            right%nodes(1)%kind == kind_number) return  ! `T = 0` is of what rests
        is_period = is_period .or. .not. right%depends_on(letter)
        meaning(1) = period(samples)
        left = substituted(left, [letter], meaning)
        right = substituted(right, [letter], meaning)
    end subroutine read_as_period

    pure subroutine define_by_period(meaning, samples)
        !! `f = 1/T` divides by a period; `K = T` may be a kinetic energy.
        type(expression_t), intent(inout) :: meaning  !! of a new name
        type(samples_t), intent(in) :: samples        !! know the names
        type(expression_t) :: divisor, of_letter(1)
        integer :: i, letter

        letter = period_letter(meaning, samples)
        if (letter == 0) return
        do i = 1, meaning%count
            if (meaning%nodes(i)%kind /= kind_quotient) cycle
            divisor = meaning%pruned(meaning%nodes(i)%right)
            if (.not. divisor%depends_on(letter)) cycle
            of_letter(1) = period(samples)
            meaning = substituted(meaning, [letter], of_letter)
            return
        end do
    end subroutine define_by_period

    pure function period_letter(formula, samples) result(letter)
        !! The place of T in a formula in which nothing else moves; 0: it is no period.
        type(expression_t), intent(in) :: formula
        type(samples_t), intent(in) :: samples
        integer :: letter, k

        letter = samples%symbols%find("T")
        if (letter == 0) return
        if (tensions(samples) > 0 .and. .not. any(is_nonzero(samples%omega2))) letter = 0
        if (letter == 0) return  ! nothing oscillates
        if (samples%role(letter) /= role_known .or. .not. formula%depends_on(letter)) letter = 0
        do k = 1, size(samples%role)
            if (letter == 0) return
            if (k == letter .or. any(samples%place == k) .or. .not. formula%depends_on(k)) cycle
            if (samples%role(k) /= role_frequency .and. .not. is_fixed(samples, k)) letter = 0
        end do
    end function period_letter

    pure function period(samples) result(formula)
        !! \(2\pi/\omega\).
        type(samples_t), intent(in) :: samples  !! know where omega stands
        type(expression_t) :: formula

        formula = whole(2)*constant(acos(-1.0_dp))/symbol(samples%frequency)
    end function period

    pure function has_velocities(expression, samples) result(yes)
        !! Is there a velocity in it?
        type(expression_t), intent(in) :: expression    !! of the samples' symbols
        type(samples_t), intent(in) :: samples          !! know the names
        logical :: yes
        integer :: k

        yes = any([(expression%depends_on(k) .and. samples%role(k) == role_velocity, &
                    k=1, size(samples%role))])
    end function has_velocities

    function is_branch(left, right, samples) result(yes)
        !! `theta_dot = sqrt(...)`, `sqrt(lambda_x^2 + lambda_y^2) = m v theta_dot`: true of the
        !! squares, and of the sides where they have one sign.
        type(expression_t), intent(in) :: left, right   !! both sides
        type(samples_t), intent(in) :: samples          !! on the motion
        logical :: yes, judged
        type(expression_t) :: residual
        integer :: i

        yes = left%count == 1 .and. left%nodes(1)%kind == kind_symbol
        if (yes) yes = any(samples%role(left%nodes(1)%which) == [role_coordinate, role_velocity])
        if (yes) yes = any([(is_root(right, i), i=1, right%count)])
        if (.not. (yes .or. is_root(left, left%count) .or. is_root(right, right%count))) return
        residual = left**2 - right**2
        call holds(residual, samples%values, yes, judged)
        yes = yes .and. .not. any([(residual%depends_on(samples%frequency + i), i=0, 1)])
        if (.not. yes) return
        residual = left - right
        yes = .false.
        do i = 1, size(samples%values, 1)
            call holds(residual, samples%values(i:i, :), yes, judged)
            if (yes) return
        end do
    contains
        pure logical function is_root(side, node)
            type(expression_t), intent(in) :: side
            integer, intent(in) :: node  !! of it

            is_root = side%nodes(node)%kind == kind_function .and. &
                      side%nodes(node)%which == f_sqrt
        end function is_root
    end function is_branch

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

    pure function value_remark(left, right, samples) result(remark)
        !! What is said of a parameter or letter alone on the left and a number on the right side,
        !! where no line 'set:' has fixed it, or of parameters on both sides; otherwise empty.
        type(expression_t), intent(in) :: left, right   !! both sides
        type(samples_t), intent(in) :: samples          !! know the names
        character(:), allocatable :: remark
        integer :: i, k

        remark = ""
        if (is_condition()) remark = "a condition between parameters, which are tried at "// &
                                     "random; lines 'set:' fix them"
        if (.not. is_name(left) .or. any(right%nodes(:right%count)%kind == kind_symbol)) return
        k = left%nodes(1)%which
        if (samples%role(k) /= role_parameter .or. any(samples%kept_constants == k)) return
        if (index(samples%symbols%names(k), "_dot") > 0) return
        if (minval(samples%values(:, k)) >= maxval(samples%values(:, k))) return
        remark = "graded for any value; a line 'set: "//trim(samples%symbols%names(k))// &
                 " = ...' fixes one"
        do i = 1, size(samples%compiled)
            associate (letter => samples%compiled(i))
                if (letter%symbol /= k) cycle
                remark = "graded for any value; lines 'set:' fix parameters that it follows from"
                if (is_name(letter%formula)) remark = "graded for any value; a line 'set: "// &
                    trim(samples%symbols%names(letter%formula%nodes(1)%which))//" = ...' fixes one"
            end associate
        end do
    contains
        pure logical function is_condition()
            !! A parameter alone, and on the other side others, and nothing else.
            integer :: j, varying

            varying = 0
            is_condition = is_name(left)
            do j = 1, size(samples%role)
                if (.not. (left%depends_on(j) .or. right%depends_on(j))) cycle
                is_condition = is_condition .and. is_parameter(j)
                if (minval(samples%values(:, j)) >= maxval(samples%values(:, j))) cycle
                varying = varying + 1
            end do
            is_condition = is_condition .and. varying > 1
        end function is_condition

        pure logical function is_parameter(which)
            !! And no letter for a formula, nor a constant of a motion?
            integer, intent(in) :: which

            is_parameter = samples%role(which) == role_parameter .and. &
                           samples%rate(which) == 0 .and. &
                           .not. any(samples%kept_constants == which)
            if (is_parameter) is_parameter = .not. any(samples%compiled%symbol == which)
        end function is_parameter

        pure logical function is_name(side)
            type(expression_t), intent(in) :: side

            is_name = side%count == 1
            if (is_name) is_name = side%nodes(1)%kind == kind_symbol
        end function is_name
    end function value_remark

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

    pure function is_about_other(residual, samples) result(yes)
        !! Of `theta_eq` and of what moves, where `theta_eq` is 0 at the first equilibrium and not
        !! at the other: a slip at it is seen there alone.
        type(expression_t), intent(in) :: residual  !! left less right side
        type(samples_t), intent(in) :: samples      !! know both
        logical :: yes
        integer :: k

        yes = .false.
        if (.not. (speaks_of_place(residual, samples) .and. &
                   all(is_zero(samples%equilibrium)))) return
        yes = any(is_nonzero(samples%other_equilibrium)) .and. &
              any([(residual%depends_on(k), k=2, 1 + 3*samples%ndof)])
    end function is_about_other

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
