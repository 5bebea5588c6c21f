module lagrangia_derivation_numbers
    !! Every line of a derivation as two numbers at one state: what the program computes, by
    !! automatic derivatives of L and the accelerations as derived by hand, and what the formula
    !! gives.
    use lagrangia_derivation, only: derivation_t, line_acceleration, line_beside, line_constraint, &
                                    line_divided, line_equation, line_force, line_kinetic, &
                                    line_lagrangian, line_mass, line_momentum, line_multiplier, &
                                    line_position, line_potential, line_rate, line_linear, &
                                    line_rest_mass, line_right_side, line_rotor, line_rotor_rate, &
                                    line_stated, line_t, line_velocity, line_words
    use lagrangia_derivation_rest, only: compare_modes, comparison_t
    use lagrangia_description, only: default_values, description_t
    use lagrangia_errors, only: error_t
    use lagrangia_formula_size, only: evaluate
    use lagrangia_generalised_forces, only: add_generalised_forces
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: solve_linear
    use lagrangia_random_draws, only: random_t
    use lagrangia_small_oscillations, only: find_modes, likely_equilibrium, modes_t
    use lagrangia_system, only: system_t
    use lagrangia_term_sizes, only: size_of_solution
    implicit none (type, external)
    private
    public :: comparison_t
    public :: compare_lines

    type :: motion_t
        !! A state with any accelerations and multipliers, and one of the motion.
        real(dp) :: t = 0.0_dp
        real(dp), allocatable :: q(:), v(:), a(:), lambda(:)
    end type motion_t

contains

    subroutine compare_lines(derivation, system, random, comparisons, error, values)
        !! At a state drawn at random.
        type(derivation_t), intent(in) :: derivation     !! of the system
        class(system_t), intent(in) :: system            !! configured
        class(random_t), intent(inout) :: random         !! moves on
        type(comparison_t), allocatable, intent(out) :: comparisons(:)  !! one of each line
        type(error_t), allocatable, intent(out) :: error  !! no state can be drawn
        real(dp), allocatable, intent(out), optional :: values(:)  !! of the names, at that state
        type(motion_t) :: anywhere, moving, rest
        type(modes_t) :: modes, others
        real(dp), allocatable :: at_rest(:)
        type(error_t), allocatable :: no_modes, no_others
        integer :: i

        call draw(derivation, system, random, anywhere, moving, error)
        if (allocated(error)) return
        if (present(values)) call name_values(derivation, anywhere, values)
        call find_modes(system, likely_equilibrium(system), .false., modes, no_modes)
        rest = moving
        rest%t = 0.0_dp
        rest%v = 0.0_dp
        rest%a = 0.0_dp
        rest%lambda = 0.0_dp
        if (.not. allocated(no_modes)) then
            if (allocated(modes%analytic%elsewhere)) then
                call find_modes(system, modes%analytic%elsewhere, .true., others, no_others)
            end if
        end if
        allocate (comparisons(derivation%count))
        do i = 1, derivation%count
            associate (line => derivation%lines(i))
                select case (line%kind)
                case (line_words)
                    cycle
                case (line_acceleration, line_multiplier)
                    call compare(derivation, system, line, moving, comparisons(i))
                case (line_rest_mass:line_linear)
                    if (allocated(no_modes)) cycle
                    if (line%elsewhere) then
                        call compare_at(others)
                    else
                        call compare_at(modes)
                    end if
                case default
                    call compare(derivation, system, line, anywhere, comparisons(i))
                end select
            end associate
        end do
    contains
        subroutine compare_at(place)
            type(modes_t), intent(in) :: place

            rest%q = place%at
            call name_values(derivation, rest, at_rest)
            if (derivation%lines(i)%kind == line_linear) then
                call name_values(derivation, anywhere, at_rest)
            end if
            call compare_modes(derivation, system, place, at_rest, derivation%lines(i), &
                               comparisons(i))
        end subroutine compare_at
    end subroutine compare_lines

    subroutine draw(derivation, system, random, anywhere, moving, error)
        !! A state that the constraints allow with its accelerations, and one with any velocities.
        type(derivation_t), intent(in) :: derivation
        class(system_t), intent(in) :: system
        class(random_t), intent(inout) :: random
        type(motion_t), intent(out) :: anywhere, moving
        type(error_t), allocatable, intent(out) :: error
        type(description_t) :: d
        integer :: i, n

        n = system%ndof
        call random%state(system, moving%t, moving%q, moving%v, error)
        if (allocated(error)) return
        allocate (moving%a(n))
        call system%accelerations(moving%t, moving%q, moving%v, moving%a)
        allocate (moving%lambda(derivation%constraints), source=0.0_dp)
        anywhere = moving
        do i = 1, n
            if (derivation%constraints > 0) call random%uniform(-3.0_dp, 3.0_dp, anywhere%v(i))
            call random%uniform(-3.0_dp, 3.0_dp, anywhere%a(i))
        end do
        do i = 1, derivation%constraints
            call random%uniform(-3.0_dp, 3.0_dp, anywhere%lambda(i))
        end do
        if (derivation%constraints > 0) call find_multipliers(system, moving)
        call system%describe(d)
        if (.not. allocated(d%typical_places)) return
        anywhere%a = d%typical_places/d%typical_time**2*anywhere%a
        if (derivation%constraints > 0) then
            anywhere%v = d%typical_places/d%typical_time*anywhere%v
            anywhere%lambda = maxval(abs(moving%lambda))*anywhere%lambda
        end if
    end subroutine draw

    subroutine find_multipliers(system, s)
        !! From the accelerations: \(AA^\top\lambda = A\,(M\ddot q - f)\).
        class(system_t), intent(in) :: system
        type(motion_t), intent(inout) :: s
        type(error_t), allocatable :: error
        real(dp) :: rows(size(s%lambda), size(s%q)), residual(size(s%q))
        integer :: i

        call constraint_values(system, s, rows)
        s%lambda = 0.0_dp
        do i = 1, size(s%q)
            residual(i) = equation_value(system, s, i)
        end do
        call solve_linear(matmul(rows, transpose(rows)), matmul(rows, residual), s%lambda, error)
    end subroutine find_multipliers

    subroutine compare(derivation, system, line, s, c)
        !! One line at the state `s`.
        type(derivation_t), intent(in) :: derivation
        class(system_t), intent(in) :: system
        type(line_t), intent(in) :: line
        type(motion_t), intent(in) :: s
        type(comparison_t), intent(out) :: c
        real(dp), allocatable :: values(:)
        real(dp) :: factor, large, noise

        call name_values(derivation, s, values)
        call evaluate(line%right, values, c%formula, c%noise)
        call program_value(derivation, system, line, s, c%program, large, c%known)
        if (line%kind == line_divided) then
            call evaluate(line%factor, values, factor, noise)
            c%program = c%program/factor
            large = large/abs(factor)
        end if
        c%noise = c%noise + 64.0_dp*epsilon(1.0_dp)*large
    end subroutine compare

    subroutine name_values(derivation, s, values)
        !! In the order of the names.
        type(derivation_t), intent(in) :: derivation
        type(motion_t), intent(in) :: s
        real(dp), allocatable, intent(out) :: values(:)

        allocate (values, source=[s%t, s%q, s%v, s%a, default_values(derivation%d), s%lambda, &
                                  0.0_dp, 0.0_dp, 0.0_dp])
    end subroutine name_values

    subroutine program_value(derivation, system, line, s, value, large, known)
        !! Without the formula; and the size of what was added up, which rounding is relative to.
        type(derivation_t), intent(in) :: derivation
        class(system_t), intent(in) :: system
        type(line_t), intent(in) :: line
        type(motion_t), intent(in) :: s
        real(dp), intent(out) :: value, large
        logical, intent(out) :: known
        type(hyperdual_t), allocatable :: r(:, :), phi(:)
        type(hyperdual_t) :: l, q(size(s%q)), v(size(s%q))
        real(dp) :: vector(size(s%q)), rows(derivation%constraints, size(s%q)), &
                    residuals(derivation%constraints), kinetic
        type(motion_t) :: at_rest

        known = .true.
        value = 0.0_dp
        large = 0.0_dp
        q%re = s%q
        v%re = s%v
        select case (line%kind)
        case (line_position, line_velocity, line_rotor, line_rotor_rate, line_kinetic, &
              line_stated, line_potential)
            call place(derivation, system, s, r, phi, kinetic, known)
            if (.not. known) return
            l = system%lagrangian(hyperdual_t(re=s%t), q, v)
            select case (line%kind)
            case (line_position); value = r(line%k, line%i)%re
            case (line_velocity); value = r(line%k, line%i)%d1
            case (line_rotor); value = phi(line%i)%re
            case (line_rotor_rate); value = phi(line%i)%d1
            case (line_potential)
                value = kinetic - l%re
                large = kinetic + abs(l%re)
            case default; value = kinetic
            end select
        case (line_lagrangian)
            l = system%lagrangian(hyperdual_t(re=s%t), q, v)
            value = l%re
        case (line_momentum)
            call system%momenta(s%t, s%q, s%v, vector)
            value = vector(line%i)
        case (line_rate)
            value = momentum_rate(system, s, line%i)
        case (line_force)
            call system%forces(s%t, s%q, s%v, vector)
            value = vector(line%i)
        case (line_beside)
            vector = 0.0_dp
            call add_generalised_forces(system, s%t, s%q, s%v, vector)
            value = vector(line%i)
        case (line_equation, line_divided)
            value = equation_value(system, s, line%i)
            call system%forces(s%t, s%q, s%v, vector)
            large = abs(momentum_rate(system, s, line%i)) + abs(vector(line%i)) &
                    + sum(abs(s%lambda))
        case (line_constraint)
            call constraint_values(system, s, rows, residuals)
            value = residuals(line%i)
        case (line_mass)
            value = mass_value(system, s, line%i, line%k)
        case (line_right_side)
            at_rest = s
            at_rest%a = 0.0_dp
            value = -equation_value(system, at_rest, line%i)
        case (line_multiplier)
            value = s%lambda(line%i)
            large = multiplier_size(system, s, line%i)
        case (line_acceleration)
            value = s%a(line%i)
            large = acceleration_size(system, s, line%i)
        case default
            known = .false.
        end select
        large = max(large, abs(value))
    end subroutine program_value

    subroutine place(derivation, system, s, r, phi, kinetic, known)
        !! Where the points are, with their velocities, and T.
        type(derivation_t), intent(in) :: derivation
        class(system_t), intent(in) :: system
        type(motion_t), intent(in) :: s
        type(hyperdual_t), allocatable, intent(out) :: r(:, :), phi(:)
        real(dp), intent(out) :: kinetic
        logical, intent(out) :: known
        type(hyperdual_t) :: t, q(size(s%q))
        integer :: i, rotors

        kinetic = 0.0_dp
        known = .false.
        if (allocated(derivation%d%points)) known = size(derivation%d%points) > 0
        if (known) known = all(derivation%d%points%mass_formula /= "")
        if (.not. known) return
        rotors = 0
        if (allocated(derivation%d%rotors)) rotors = size(derivation%d%rotors)
        allocate (r(3, size(derivation%d%points)), phi(rotors))
        t = hyperdual_t(s%t, 1.0_dp, 0.0_dp, 0.0_dp)
        q%re = s%q
        q%d1 = s%v
        call system%positions(t, q, r)
        do i = 1, size(r, 2)
            kinetic = kinetic + 0.5_dp*derivation%d%points(i)%mass*sum(r(:, i)%d1**2)
        end do
        if (rotors == 0) return
        call system%angles(t, q, phi)
        do i = 1, rotors
            kinetic = kinetic + 0.5_dp*derivation%d%rotors(i)%mass*phi(i)%d1**2
        end do
    end subroutine place

    function momentum_rate(system, s, i) result(rate)
        !! \(d/dt\,\partial L/\partial\dot q_i\) along any accelerations.
        class(system_t), intent(in) :: system
        type(motion_t), intent(in) :: s
        integer, intent(in) :: i
        real(dp) :: rate
        type(hyperdual_t) :: q(size(s%q)), v(size(s%q)), l

        q%re = s%q
        q%d2 = s%v
        v%re = s%v
        v%d2 = s%a
        v(i)%d1 = 1.0_dp
        l = system%lagrangian(hyperdual_t(s%t, 0.0_dp, 1.0_dp, 0.0_dp), q, v)
        rate = l%d12
    end function momentum_rate

    function equation_value(system, s, i) result(value)
        !! \(d/dt\,\partial L/\partial\dot q_i - \partial L/\partial q_i - Q_i
        !! - \sum_k\lambda_k A_{ki}\).
        class(system_t), intent(in) :: system
        type(motion_t), intent(in) :: s
        integer, intent(in) :: i
        real(dp) :: value
        type(hyperdual_t) :: q(size(s%q)), v(size(s%q)), l
        real(dp) :: beside(size(s%q)), rows(size(s%lambda), size(s%q))

        q%re = s%q
        v%re = s%v
        q(i)%d1 = 1.0_dp
        l = system%lagrangian(hyperdual_t(re=s%t), q, v)
        beside = 0.0_dp
        call add_generalised_forces(system, s%t, s%q, s%v, beside)
        value = momentum_rate(system, s, i) - l%d1 - beside(i)
        if (size(s%lambda) == 0) return
        call constraint_values(system, s, rows)
        value = value - dot_product(s%lambda, rows(:, i))
    end function equation_value

    function mass_value(system, s, i, k) result(value)
        !! \(\partial^2 L/\partial\dot q_i\,\partial\dot q_k\).
        class(system_t), intent(in) :: system
        type(motion_t), intent(in) :: s
        integer, intent(in) :: i, k
        real(dp) :: value
        type(hyperdual_t) :: q(size(s%q)), v(size(s%q)), l

        q%re = s%q
        v%re = s%v
        v(i)%d1 = 1.0_dp
        v(k)%d2 = 1.0_dp
        l = system%lagrangian(hyperdual_t(re=s%t), q, v)
        value = l%d12
    end function mass_value

    function acceleration_size(system, s, i) result(large)
        !! The sizes of what is added up for an acceleration: of an M whose inertias nearly cancel
        !! they are more than \(|\ddot q|\). 0 of a singular M.
        class(system_t), intent(in) :: system
        type(motion_t), intent(in) :: s
        integer, intent(in) :: i
        real(dp) :: large
        real(dp) :: mass(size(s%q), size(s%q)), sizes(size(s%q))
        type(error_t), allocatable :: singular
        integer :: j, k

        do j = 1, size(s%q)
            do k = 1, size(s%q)
                mass(j, k) = mass_value(system, s, j, k)
            end do
        end do
        call size_of_solution(mass, term_sizes(system, s), sizes, singular)
        large = sizes(i)
    end function acceleration_size

    function multiplier_size(system, s, i) result(large)
        !! The same for a multiplier, beside large forces that nearly cancel along a constraint.
        class(system_t), intent(in) :: system
        type(motion_t), intent(in) :: s
        integer, intent(in) :: i
        real(dp) :: large
        real(dp) :: rows(size(s%lambda), size(s%q)), square(size(s%lambda), size(s%lambda))
        real(dp) :: sizes(size(s%q)), right(size(s%lambda)), of_multipliers(size(s%lambda))
        type(error_t), allocatable :: singular
        integer :: j

        call constraint_values(system, s, rows)
        sizes = term_sizes(system, s)
        do j = 1, size(right)
            square(:, j) = matmul(rows, rows(j, :))
            right(j) = sum(abs(rows(j, :))*sizes)
        end do
        call size_of_solution(square, right, of_multipliers, singular)
        large = of_multipliers(i)
    end function multiplier_size

    function term_sizes(system, s) result(sizes)
        !! Of the equations of motion, \(|M||\ddot q| + |\partial L/\partial q| + |Q| +
        !! |A^\top\lambda|\) and the rates of the momenta without \(\ddot q\).
        class(system_t), intent(in) :: system
        type(motion_t), intent(in) :: s
        real(dp), dimension(size(s%q)) :: sizes, forces, beside
        real(dp) :: rows(size(s%lambda), size(s%q))
        type(motion_t) :: still
        integer :: j, k

        still = s
        still%a = 0.0_dp
        call system%forces(s%t, s%q, s%v, forces)
        beside = 0.0_dp
        call add_generalised_forces(system, s%t, s%q, s%v, beside)
        sizes = abs(forces) + abs(beside)
        if (size(s%lambda) > 0) then
            call constraint_values(system, s, rows)
            do j = 1, size(s%q)
                sizes(j) = sizes(j) + sum(abs(s%lambda*rows(:, j)))
            end do
        end if
        do j = 1, size(s%q)
            sizes(j) = sizes(j) + abs(momentum_rate(system, still, j))
            do k = 1, size(s%q)
                sizes(j) = sizes(j) + abs(mass_value(system, s, j, k)*s%a(k))
            end do
        end do
    end function term_sizes

    subroutine constraint_values(system, s, rows, residuals)
        !! \(A\), and \(A\dot q + b\).
        class(system_t), intent(in) :: system
        type(motion_t), intent(in) :: s
        real(dp), intent(out) :: rows(:, :)
        real(dp), intent(out), optional :: residuals(:)
        type(hyperdual_t) :: q(size(s%q)), a(size(rows, 1), size(s%q)), b(size(rows, 1))

        q%re = s%q
        call system%constraint_rows(hyperdual_t(re=s%t), q, a, b)
        rows = a%re
        if (present(residuals)) residuals = matmul(rows, s%v) + b%re
    end subroutine constraint_values
end module lagrangia_derivation_numbers
