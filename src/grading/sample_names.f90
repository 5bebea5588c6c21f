module lagrangia_sample_names
    !! What a statement about a system may name: coordinates, velocities, accelerations, parameters,
    !! letters, L, energies, momenta, derivatives of L, quantities, places of the masses, omega.
    use lagrangia_derivative, only: time_derivative
    use lagrangia_description, only: description_t, name_length, quantity_t, value_names
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_kinds, only: dp
    use lagrangia_random_draws, only: random_t
    use lagrangia_symbols, only: symbols_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: compiled_t, energy_statement_t, samples_t, start_t, usual_t
    public :: name_symbols
    public :: axes, draws, states
    public :: role_time, role_coordinate, role_velocity, role_acceleration, role_parameter, &
              role_known, role_frequency

    integer, parameter :: draws = 4   !! of parameters
    integer, parameter :: states = 8  !! with each

    integer, parameter :: role_time = 1, role_coordinate = 2, role_velocity = 3
    integer, parameter :: role_acceleration = 4
    integer, parameter :: role_parameter = 5  !! or a letter that stands for a formula
    integer, parameter :: role_known = 6      !! L, the energy, momenta, quantities
    integer, parameter :: role_frequency = 7  !! omega of a small oscillation

    character, parameter :: axes(3) = ["x", "y", "z"]

    type :: compiled_t
        !! A name that stands for a formula.
        integer :: symbol = 0              !! its place
        type(expression_t) :: formula
        type(expression_t) :: rate          !! its derivative by the time
        type(formula_program_t) :: program  !! of the formula
    end type compiled_t

    type :: usual_t
        !! What a name mostly stands for, which a sheet may use in its own way.
        character(name_length) :: name = ""
        character(name_length) :: label = ""     !! what it is, in words
        type(expression_t) :: meaning            !! over the symbols
        logical :: always = .false.              !! nobody means anything else by it
        logical :: either_sign = .false.         !! so may be its opposite
        logical :: any_zero = .false.            !! a constant may be added
        logical :: is_force = .false.            !! which may be constant
        logical :: only_compared = .false.       !! unknown where the sheet does not define it
    end type usual_t

    type :: energy_statement_t
        !! `E = k A^2/2` of a line that was right.
        type(expression_t) :: energy             !! the right side, over the symbols and constants
        character(name_length), allocatable :: names(:)  !! of the constants, behind all symbols
        integer :: line = 0                      !! where it stands
    end type energy_statement_t

    type :: start_t
        !! `x_dot(0) = v_0`, as a line states it.
        integer :: coordinate = 0                !! which begins
        integer :: order = 0                     !! of its derivative
        character(:), allocatable :: value       !! the right side, as typed
        integer :: line = 0                      !! where it stands
        logical :: used = .false.                !! a motion behind it is written out
    end type start_t

    type :: samples_t
        !! Rows of `values` are states, those of the first parameters first.
        type(symbols_t) :: symbols
        integer, allocatable :: role(:)            !! of each symbol
        real(dp), allocatable :: values(:, :)      !! on the motion, (draws*states, symbols)
        real(dp), allocatable :: elsewhere(:, :)   !! accelerations and known values are others
        real(dp), allocatable :: omega2(:, :)      !! of small oscillations, (draws, modes); 0: none
        integer :: ndof = 0                        !! coordinates
        integer :: first_acceleration = 0          !! place of the first one
        integer :: first_point = 0, last_point = -1
        !! places of `x_bob`, `x_bob_dot`, ..., what the masses and rotors do
        integer :: frequency = 0                   !! place of omega, or of Omega if omega is taken;
        !! behind it that of its square, `omega^2`, which is negative where it is unstable
        integer :: decay = 0
        !! place of gamma, or of Gamma, where one coordinate is damped; behind it that of `omega_0`,
        !! the frequency without the drag; 0: no drag
        character(:), allocatable :: kept          !! parameters that are zero: `a_s = 0`
        integer, allocatable :: forces(:)  !! places of those that keep constraints, and of others
        integer, allocatable :: rate(:)
        !! place of the symbol's time derivative, or 0
        type(compiled_t), allocatable :: compiled(:)
        type(compiled_t), allocatable :: reduced(:)
        !! quantities that are called momenta and are none of L, as the constraints make them
        type(expression_t) :: lagrangian           !! as the page has it; empty: it has none
        real(dp), allocatable :: mass(:, :, :)
        !! \(\partial^2L/\partial\dot q_j\partial\dot q_k\), (ndof, ndof, draws*states);
        !! no rows where there are many coordinates, or non-holonomic constraints
        real(dp), allocatable :: equilibrium(:, :)      !! at or near zero, (ndof, draws); NaN: none
        real(dp), allocatable :: stiffness(:, :, :)     !! and `inertia`, there, (ndof, ndof, draws)
        real(dp), allocatable :: inertia(:, :, :)
        real(dp), allocatable :: turning(:, :, :)
        !! what stands before the velocities there: gyroscopic forces and drag; NaN: not known
        real(dp), allocatable :: other_equilibrium(:, :)
        !! the same about another one that the page knows, or at zero; NaN: none
        real(dp), allocatable, dimension(:, :, :) :: other_stiffness, other_inertia, other_turning
        real(dp), allocatable :: stated_rest(:, :)
        !! a third one, which a line has stated: values of all symbols there
        integer, allocatable :: place(:)                !! of `theta_eq`, where it is, (ndof)
        type(usual_t), allocatable :: usual(:)          !! names beside `symbols`
        character(name_length), allocatable :: constants(:)
        !! of motions that are written out, `A` of A cos(omega t): symbols behind all others
        character(name_length), allocatable :: declared(:)  !! names behind `constant:`
        integer, allocatable :: kept_constants(:)  !! places of those that a line gave their value
        integer, allocatable :: kept_lines(:)      !! and of these lines
        type(energy_statement_t), allocatable :: energies(:)  !! with constants of no value
        type(start_t), allocatable :: starts(:)    !! initial conditions of the lines before
        logical, allocatable :: two_signs(:)       !! of each of these: its opposite would do, too
        type(expression_t), allocatable :: motion(:)
        !! of each coordinate, as a line has it; empty: none
        logical, allocatable :: exact_motion(:)  !! it is not that of small oscillations only
        type(random_t) :: random
        class(system_t), pointer :: system => null()
        !! of which the statements speak, as long as they are judged
    end type samples_t

    interface
        module subroutine define_derivatives(d, samples)
            !! `p_x_dot`, the forces beside L, and `dV_dx`, `dT_dx_dot`.
            implicit none (type, external)
            type(description_t), intent(in) :: d
            type(samples_t), intent(inout) :: samples
        end subroutine define_derivatives
    end interface

contains

    subroutine name_symbols(system, d, damped, own_omega, samples)
        !! All names, in one order.
        class(system_t), intent(in) :: system         !! of which the statements speak
        type(description_t), intent(in) :: d          !! its own
        logical, intent(in) :: damped                 !! it has a decay rate
        logical, intent(in) :: own_omega              !! the sheet calls something else omega
        type(samples_t), intent(inout) :: samples     !! gets names, roles, rates and letters
        character(name_length), allocatable :: names(:)
        logical :: has_rate, has_second_rate
        integer :: i

        samples%ndof = system%ndof
        allocate (samples%role(0), samples%forces(0))
        call add("t", role_time)
        call add_each("", "", role_coordinate)
        call add_each("", "_dot", role_velocity)
        samples%first_acceleration = size(samples%role) + 1
        call add_each("", "_ddot", role_acceleration)
        allocate (names, source=value_names(d))
        do i = 1, size(names)
            call add(trim(names(i)), role_parameter)
        end do
        if (allocated(d%letters)) then
            do i = 1, size(d%letters)
                call add_letter(trim(d%letters(i)%name), trim(d%letters(i)%formula))
            end do
        end if
        do i = 1, size(d%quantities)
            call add(trim(d%quantities(i)%name), role_known)
            call find_rates(d%quantities(i), has_rate, has_second_rate)
            if (d%quantities(i)%unit == "N") samples%forces = [samples%forces, size(samples%role)]
            if (has_rate) call add(trim(d%quantities(i)%name)//"_dot", role_known)
            if (has_second_rate) call add(trim(d%quantities(i)%name)//"_ddot", role_known)
        end do
        call add("E_dot", role_known)
        call add_points()
        call add("L", role_known)
        call add("L_dot", role_known)
        call add("dL_dt", role_known)  ! by the time alone
        call add("E", role_known)
        call add_each("p_", "", role_known)
        call add_each("dL_d", "_dot", role_known)
        call add_each("dL_d", "", role_known)
        call add_each("d_dt_dL_d", "_dot", role_known)
        if (allocated(d%kinetic_energy)) call add_energy("T")
        if (allocated(d%potential_energy)) call add_energy("V")
        if (samples%symbols%find("omega") == 0 .and. .not. own_omega) then
            call add("omega", role_frequency)
            call add("omega^2", role_frequency)
        else
            call add("Omega", role_frequency)
            call add("Omega^2", role_frequency)
        end if
        samples%frequency = size(samples%role) - 1  ! its square behind it
        if (damped) then
            if (samples%symbols%find("gamma") == 0) then
                call add("gamma", role_known)
            else
                call add("Gamma", role_known)
            end if
            samples%decay = size(samples%role)
            call add(trim(samples%symbols%names(samples%frequency))//"_0", role_known)
        end if
        allocate (samples%constants(0), samples%declared(0), samples%motion(samples%ndof))
        allocate (samples%kept_constants(0), samples%two_signs(0), samples%kept_lines(0), &
                  samples%energies(0), samples%starts(0))
        allocate (samples%exact_motion(samples%ndof), source=.false.)
        allocate (samples%place(samples%ndof))
        do i = 1, samples%ndof
            call add(trim(samples%symbols%names(1 + i))//"_eq", role_known)
            samples%place(i) = samples%symbols%find(trim(samples%symbols%names(1 + i))//"_eq")
        end do
        call add_each("dE_d", "", role_known)
        call add_each("dE_d", "_dot", role_known)
        call name_rates(samples)
        call define_derivatives(d, samples)
        call compile_letters(d, samples)
    contains
        subroutine add_each(before, after, role)
            character(*), intent(in) :: before, after
            integer, intent(in) :: role
            integer :: j

            do j = 1, size(d%coordinates)
                call add(before//trim(d%coordinates(j)%name)//after, role)
            end do
        end subroutine add_each

        subroutine add_energy(called)
            character(*), intent(in) :: called

            call add(called, role_known)
            call add(called//"_dot", role_known)
        end subroutine add_energy

        subroutine add_points()
            !! `x_bob`, `phi_pulley`, with their rates.
            integer :: j, m

            samples%first_point = size(samples%role) + 1
            if (allocated(d%points)) then
                do j = 1, size(d%points)
                    do m = 1, 3
                        call add_rates(axes(m)//"_"//trim(d%points(j)%name))
                    end do
                end do
            end if
            if (allocated(d%rotors)) then
                do j = 1, size(d%rotors)
                    call add_rates("phi_"//trim(d%rotors(j)%name))
                end do
            end if
            samples%last_point = size(samples%role)
        end subroutine add_points

        subroutine add_rates(called)
            character(*), intent(in) :: called

            call add(called, role_known)
            call add(called//"_dot", role_known)
            call add(called//"_ddot", role_known)
        end subroutine add_rates

        subroutine add_letter(letter, formula)
            !! One that moves has rates as well.
            character(*), intent(in) :: letter, formula
            type(expression_t) :: expression
            type(error_t), allocatable :: error
            logical :: has_second, moves
            integer :: j

            call parse_formula(formula, samples%symbols, expression, error)
            moves = .false.
            has_second = .true.
            do j = 1, size(samples%role)
                if (.not. expression%depends_on(j)) cycle
                if (samples%role(j) == role_velocity) has_second = .false.
                if (samples%role(j) < role_parameter) moves = .true.
                if (samples%symbols%find(trim(samples%symbols%names(j))//"_dot") == 0) cycle
                moves = .true.
                has_second = has_second .and. &
                             samples%symbols%find(trim(samples%symbols%names(j))//"_ddot") > 0
            end do
            call add(letter, role_parameter)
            if (.not. moves) return
            call add(letter//"_dot", role_parameter)
            if (has_second) call add(letter//"_ddot", role_parameter)
        end subroutine add_letter

        subroutine find_rates(quantity, yes, second)
            !! Has it a formula without accelerations and other quantities, and is no momentum? Has
            !! the formula only places and parameters?
            type(quantity_t), intent(in) :: quantity
            logical, intent(out) :: yes, second
            type(expression_t) :: formula
            type(symbols_t) :: symbols
            type(error_t), allocatable :: error
            integer :: j

            yes = .false.
            second = .false.
            if (quantity%formula == "") return
            symbols = samples%symbols  ! and momenta, which get their names later
            do j = 1, size(d%coordinates)  ! whose rate is that of dL/dx_dot
                if (quantity%name == "p_"//trim(d%coordinates(j)%name)) return
                call symbols%add("p_"//trim(d%coordinates(j)%name))
            end do
            call parse_formula(trim(quantity%formula), symbols, formula, error)
            if (allocated(error)) return
            yes = .not. any([(formula%depends_on(j), j=1, size(samples%role))] .and. &
                            (samples%role == role_acceleration .or. samples%role == role_known))
            second = yes
            do j = 2, size(samples%role)
                if (samples%role(j) == role_coordinate .or. .not. formula%depends_on(j)) cycle
                second = second .and. samples%role(j) == role_parameter .and. &
                         samples%symbols%find(trim(samples%symbols%names(j))//"_dot") == 0
            end do
        end subroutine find_rates

        subroutine add(called, role)
            character(*), intent(in) :: called
            integer, intent(in) :: role

            if (samples%symbols%find(called) > 0) return
            call samples%symbols%add(called)
            samples%role = [samples%role, role]
        end subroutine add
    end subroutine name_symbols

    subroutine name_rates(samples)
        !! The place of each name's time derivative: `theta_dot` of `theta`; d/dt of others is 0, or
        !! not known.
        type(samples_t), intent(inout) :: samples
        character(name_length) :: name
        integer :: i, k

        allocate (samples%rate(size(samples%role)))
        do i = 1, size(samples%rate)
            name = samples%symbols%names(i)
            samples%rate(i) = samples%symbols%find(trim(name)//"_dot")
            k = len_trim(name)
            if (k > 4) then
                if (name(k - 3:k) == "_dot") samples%rate(i) = &
                    samples%symbols%find(name(:k - 3)//"ddot")
            end if
            if (name(:2) == "p_" .and. samples%role(i) == role_known) samples%rate(i) = &
                samples%symbols%find("d_dt_dL_d"//trim(name(3:))//"_dot")
            if (name(:4) == "dL_d" .and. samples%rate(i) == 0) samples%rate(i) = &
                samples%symbols%find("d_dt_"//trim(name))
        end do
        samples%symbols%rates = samples%rate
        do i = 1, size(samples%rate)
            if (samples%rate(i) > 0 .or. i == samples%decay) cycle
            if (i == samples%decay + 1 .and. samples%decay > 0) cycle
            if (any(samples%place == i)) cycle
            name = samples%symbols%names(i)
            if (samples%role(i) == role_acceleration .or. samples%role(i) == role_known .or. &
                index(name, "_ddot") + index(name, "_dot") > 0) samples%symbols%rates(i) = -1
        end do
    end subroutine name_rates

    subroutine compile_letters(d, samples)
        !! The definitions, the quantities that have rates, T and V, in this order.
        type(description_t), intent(in) :: d
        type(samples_t), intent(inout) :: samples
        type(error_t), allocatable :: refusal
        integer :: i, k, n

        if (allocated(d%lagrangian)) call parse_formula(d%lagrangian, samples%symbols, &
                                                        samples%lagrangian, refusal)
        n = 0
        if (allocated(d%letters)) n = size(d%letters)
        allocate (samples%compiled(n + size(d%quantities) + 2))
        k = 0
        do i = 1, n
            call add(trim(d%letters(i)%name), trim(d%letters(i)%formula))
        end do
        do i = 1, size(d%quantities)
            associate (quantity => d%quantities(i))
                if (samples%symbols%find(trim(quantity%name)//"_dot") == 0) cycle
                call add(trim(quantity%name), trim(quantity%formula))
            end associate
        end do
        if (allocated(d%kinetic_energy)) call add("T", d%kinetic_energy)
        if (allocated(d%potential_energy)) call add("V", d%potential_energy)
        samples%compiled = samples%compiled(:k)
        allocate (samples%reduced(0))
        do i = 1, size(d%quantities)
            associate (quantity => d%quantities(i))
                if (quantity%formula == "") cycle
                if (.not. any([("p_"//d%coordinates(n)%name == quantity%name, &
                                n=1, size(d%coordinates))])) cycle
                call add_reduced(samples%symbols%find(trim(quantity%name)), trim(quantity%formula))
            end associate
        end do
        do i = 1, k  ! letters for forces are forces
            associate (letter => samples%compiled(i))
                if (samples%role(letter%symbol) == role_known) cycle
                if (.not. any([(letter%formula%depends_on(samples%forces(n)), &
                                n=1, size(samples%forces))])) cycle
                samples%forces = [samples%forces, letter%symbol]
            end associate
        end do
    contains
        subroutine add(name, formula)
            character(*), intent(in) :: name, formula
            type(expression_t) :: expression(1)
            type(error_t), allocatable :: error

            call parse_formula(formula, samples%symbols, expression(1), error)
            if (allocated(error)) return
            k = k + 1
            samples%compiled(k)%symbol = samples%symbols%find(name)
            samples%compiled(k)%formula = expression(1)
            samples%compiled(k)%rate = time_derivative(expression(1), samples%rate, 1)
            call new_formula_program(samples%compiled(k)%program, expression, size(samples%role))
        end subroutine add

        subroutine add_reduced(symbol, formula)
            integer, intent(in) :: symbol
            character(*), intent(in) :: formula
            type(compiled_t), allocatable :: longer(:)
            type(expression_t) :: expression
            type(error_t), allocatable :: error
            integer :: j, m

            call parse_formula(formula, samples%symbols, expression, error)
            if (allocated(error)) return
            m = size(samples%reduced)
            allocate (longer(m + 1))
            do j = 1, m
                longer(j) = samples%reduced(j)
            end do
            longer(m + 1)%symbol = symbol
            longer(m + 1)%formula = expression
            call move_alloc(longer, samples%reduced)
        end subroutine add_reduced
    end subroutine compile_letters
end module lagrangia_sample_names
