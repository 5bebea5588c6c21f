module lagrangia_motion_samples
    !! What a statement about a system may name, and the values of all these names on its motion: at
    !! states at random, with parameters at random, as the equations of motion have it.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_description, only: description_t, default_values, name_length, value_names
    use lagrangia_errors, only: error_t, fail
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_gauss_principle, only: masses_of, place_points
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_named_values, only: motion_state_t, path
    use lagrangia_parameter_choice, only: keep, spread_values
    use lagrangia_random_draws, only: random_t
    use lagrangia_small_oscillations, only: find_modes, modes_t
    use lagrangia_symbols, only: symbols_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: samples_t
    public :: new_samples
    public :: draws, states
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
        type(formula_program_t) :: program
    end type compiled_t

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
        !! behind it that of its square, `omega_2`, which is negative where it is unstable
        character(:), allocatable :: kept          !! parameters that are zero: `a_s = 0`
        integer, allocatable :: rate(:)
        !! place of the symbol's time derivative, or 0
        type(compiled_t), allocatable :: compiled(:)
        type(random_t), private :: random
    end type samples_t

contains

    subroutine new_samples(system, said, settings, samples, error)
        !! Of `system`, about which `said` speaks: a parameter that it does not name and whose
        !! default is zero or a formula keeps that.
        class(system_t), intent(in) :: system             !! configured
        character(*), intent(in) :: said                  !! all statements
        type(word_t), intent(in) :: settings(:)           !! `name=value`: these keep their values
        type(samples_t), intent(out) :: samples           !! names and values
        type(error_t), allocatable, intent(out) :: error  !! no states at which L is a number
        class(system_t), allocatable :: drawn
        type(description_t) :: d
        type(error_t), allocatable :: refusal
        real(dp), allocatable :: values(:), given(:)
        logical, allocatable :: drawn_value(:), fixed(:)
        integer :: draw, k

        call system%describe(d)
        call name_symbols(system, d, samples)
        allocate (samples%values(draws*states, size(samples%symbols%names)))
        call keep(d, said, settings, fixed, given, samples%kept)
        allocate (drawn, source=system)
        draw = 0
        do k = 1, 20*draws
            call spread_values(d, drawn_value, fixed, given, samples%random)
            call samples%random%parameters(drawn, .false., values, refusal, &
                                           fixed .or. drawn_value, given)
            if (.not. allocated(refusal)) call add_states(samples, drawn, d, draw, refusal)
            if (allocated(refusal)) cycle
            draw = draw + 1
            call add_modes(samples, drawn, draw)
            if (draw == draws) exit
        end do
        if (draw < draws) then
            call fail(error, trim(d%name)// &
                      ": no parameters and states are found at which all is finite")
            return
        end if
        samples%elsewhere = samples%values
        do k = 1, size(samples%role)
            call move_away(samples, k)
        end do
    end subroutine new_samples

    subroutine name_symbols(system, d, samples)
        !! All names, in the order of `add_states`.
        class(system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        type(samples_t), intent(inout) :: samples
        character(name_length), allocatable :: names(:)
        character(name_length) :: name
        integer :: i, k

        samples%ndof = system%ndof
        allocate (samples%role(0))
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
        end do
        call add_points()
        call add("L", role_known)
        call add("E", role_known)
        call add_each("p_", "", role_known)
        call add_each("dL_d", "_dot", role_known)
        call add_each("dL_d", "", role_known)
        call add_each("d_dt_dL_d", "_dot", role_known)
        if (allocated(d%kinetic_energy)) call add("T", role_known)
        if (allocated(d%potential_energy)) call add("V", role_known)
        if (samples%symbols%find("omega") == 0) then
            call add("omega", role_frequency)
            call add("omega_2", role_frequency)
        else
            call add("Omega", role_frequency)
            call add("Omega_2", role_frequency)
        end if
        samples%frequency = size(samples%role) - 1  ! its square behind it
        allocate (samples%rate(size(samples%role)))
        do i = 1, size(samples%rate)
            name = samples%symbols%names(i)
            samples%rate(i) = samples%symbols%find(trim(name)//"_dot")
            k = len_trim(name)
            if (k > 4) then
                if (name(k - 3:k) == "_dot") samples%rate(i) = samples%symbols%find(name(:k - 3)// &
                    "ddot")
            end if
        end do
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
            logical :: moves
            integer :: j

            call parse_formula(formula, samples%symbols, expression, error)
            moves = .false.
            do j = 1, size(samples%role)
                if (.not. expression%depends_on(j)) cycle
                moves = moves .or. samples%role(j) < role_parameter .or. &
                        samples%symbols%find(trim(samples%symbols%names(j))//"_dot") > 0
            end do
            call add(letter, role_parameter)
            if (.not. moves) return
            call add(letter//"_dot", role_parameter)
            call add(letter//"_ddot", role_parameter)
        end subroutine add_letter

        subroutine add(called, role)
            character(*), intent(in) :: called
            integer, intent(in) :: role

            if (samples%symbols%find(called) > 0) return
            call samples%symbols%add(called)
            samples%role = [samples%role, role]
        end subroutine add
    end subroutine name_symbols

    subroutine compile_letters(d, samples)
        !! The definitions, T and V, in this order.
        type(description_t), intent(in) :: d
        type(samples_t), intent(inout) :: samples
        integer :: i, k, n

        n = 0
        if (allocated(d%letters)) n = size(d%letters)
        allocate (samples%compiled(n + 2))
        k = 0
        do i = 1, n
            call add(trim(d%letters(i)%name), trim(d%letters(i)%formula))
        end do
        if (allocated(d%kinetic_energy)) call add("T", d%kinetic_energy)
        if (allocated(d%potential_energy)) call add("V", d%potential_energy)
        samples%compiled = samples%compiled(:k)
    contains
        subroutine add(name, formula)
            character(*), intent(in) :: name, formula
            type(expression_t) :: expression(1)
            type(error_t), allocatable :: error

            call parse_formula(formula, samples%symbols, expression(1), error)
            if (allocated(error)) return
            k = k + 1
            samples%compiled(k)%symbol = samples%symbols%find(name)
            call new_formula_program(samples%compiled(k)%program, expression, size(samples%role))
        end subroutine add
    end subroutine compile_letters

    subroutine add_states(samples, system, d, draw, error)
        !! Fill the rows behind the first `draw` draws.
        type(samples_t), intent(inout) :: samples
        class(system_t), intent(in) :: system   !! with the parameters of this draw
        type(description_t), intent(in) :: d    !! with any parameters
        integer, intent(in) :: draw
        type(error_t), allocatable, intent(out) :: error  !! some value is not finite
        type(description_t) :: now
        real(dp), allocatable :: q(:), v(:), a(:), parameters(:)
        character(name_length), allocatable :: names(:)
        character(name_length) :: name
        real(dp) :: t
        integer :: i, k, row

        call system%describe(now)
        allocate (parameters, source=default_values(now))
        allocate (names, source=value_names(d))
        allocate (a(system%ndof))
        do k = 1, states
            row = draw*states + k
            call samples%random%state(system, t, q, v, error)
            if (allocated(error)) return
            call system%accelerations(t, q, v, a)
            samples%values(row, :) = 0.0_dp
            call put("t", t)
            do i = 1, system%ndof
                name = d%coordinates(i)%name
                call put(trim(name), q(i))
                call put(trim(name)//"_dot", v(i))
                call put(trim(name)//"_ddot", a(i))
            end do
            do i = 1, size(names)
                call put(trim(names(i)), parameters(i))
            end do
            do i = 1, size(d%quantities)
                call put(trim(d%quantities(i)%name), system%quantity(i, t, q, v))
            end do
            call put("E", system%energy(t, q, v))
            call put_points()
            call put_derivatives()
            do i = 1, size(samples%compiled)
                call put_letter(samples%compiled(i))
            end do
            if (.not. all(ieee_is_finite(samples%values(row, :)))) then
                call fail(error, "not finite")
                return
            end if
        end do
    contains
        subroutine put(called, value)
            character(*), intent(in) :: called
            real(dp), intent(in) :: value

            samples%values(row, samples%symbols%find(called)) = value
        end subroutine put

        subroutine put_points()
            !! Where the masses are, how rotors are turned, and their rates.
            type(hyperdual_t), allocatable :: x(:)
            real(dp), allocatable :: mass(:)
            integer :: j, m, points

            allocate (mass, source=masses_of(now))
            if (size(mass) == 0) return
            allocate (x(size(mass)))
            call place_points(system, now, hyperdual_t(t, 1.0_dp, 1.0_dp, 0.0_dp), &
                              path(motion_state_t(t=t, q=q, v=v, a=a)), x)
            points = 0
            if (allocated(now%points)) points = size(now%points)
            do j = 1, points
                do m = 1, 3
                    call put_rates(axes(m)//"_"//trim(now%points(j)%name), x(3*j - 3 + m))
                end do
            end do
            do j = 1, size(mass) - 3*points
                call put_rates("phi_"//trim(now%rotors(j)%name), x(3*points + j))
            end do
        end subroutine put_points

        subroutine put_rates(called, value)
            character(*), intent(in) :: called
            type(hyperdual_t), intent(in) :: value

            call put(called, value%re)
            call put(called//"_dot", value%d1)
            call put(called//"_ddot", value%d12)
        end subroutine put_rates

        subroutine put_letter(letter)
            !! Its value, and its rates along the motion.
            type(compiled_t), intent(in) :: letter
            type(hyperdual_t) :: inputs(size(samples%role)), result(1)
            integer :: j, rate

            inputs = hyperdual_t()
            inputs%re = samples%values(row, :)
            inputs(1)%d1 = 1.0_dp
            do j = 2, size(inputs)
                rate = samples%rate(j)
                if (rate == 0) cycle
                inputs(j)%d1 = samples%values(row, rate)
                rate = samples%rate(rate)
                if (rate > 0) inputs(j)%d12 = samples%values(row, rate)
            end do
            inputs%d2 = inputs%d1
            call letter%program%evaluate(inputs, result)
            j = letter%symbol
            samples%values(row, j) = result(1)%re
            rate = samples%rate(j)
            if (rate == 0) return
            samples%values(row, rate) = result(1)%d1
            rate = samples%rate(rate)
            if (rate > 0) samples%values(row, rate) = result(1)%d12
        end subroutine put_letter

        subroutine put_derivatives()
            type(hyperdual_t) :: tt, qq(system%ndof), vv(system%ndof), l
            integer :: j

            tt = hyperdual_t(t, d2=1.0_dp)
            do j = 1, system%ndof
                qq(j) = hyperdual_t(q(j), d2=v(j))
                vv(j) = hyperdual_t(v(j), d2=a(j))
            end do
            do j = 1, system%ndof
                name = d%coordinates(j)%name
                vv(j)%d1 = 1.0_dp
                l = system%lagrangian(tt, qq, vv)
                vv(j)%d1 = 0.0_dp
                call put("L", l%re)
                call put("p_"//trim(name), l%d1)
                call put("dL_d"//trim(name)//"_dot", l%d1)
                call put("d_dt_dL_d"//trim(name)//"_dot", l%d12)
                qq(j)%d1 = 1.0_dp
                l = system%lagrangian(tt, qq, vv)
                qq(j)%d1 = 0.0_dp
                call put("dL_d"//trim(name), l%d1)
            end do
        end subroutine put_derivatives
    end subroutine add_states

    subroutine add_modes(samples, system, draw)
        !! \(\omega^2\) of the oscillations about the equilibrium at or near zero, and about
        !! another one that the page knows; 0 where there is none.
        type(samples_t), intent(inout) :: samples
        class(system_t), intent(in) :: system  !! with the parameters of this draw
        integer, intent(in) :: draw
        type(modes_t) :: modes, others
        type(error_t), allocatable :: error
        real(dp) :: start(system%ndof)
        integer :: n

        n = system%ndof
        if (draw == 1) allocate (samples%omega2(draws, 2*n), source=0.0_dp)
        start = 0.0_dp
        call find_modes(system, start, .true., modes, error)
        if (allocated(error)) call find_modes(system, start, .false., modes, error)
        if (allocated(error)) return
        samples%omega2(draw, :n) = modes%omega2
        if (.not. allocated(modes%analytic%elsewhere)) return
        call find_modes(system, modes%analytic%elsewhere, .true., others, error)
        if (.not. allocated(error)) samples%omega2(draw, n + 1:) = others%omega2
    end subroutine add_modes

    subroutine move_away(samples, k)
        !! Other accelerations and other known values than those of the motion.
        type(samples_t), intent(inout) :: samples
        integer, intent(in) :: k
        real(dp) :: shift
        integer :: i

        if (samples%role(k) /= role_acceleration .and. samples%role(k) /= role_known .and. &
            samples%role(k) /= role_frequency) return
        do i = 1, size(samples%elsewhere, 1)
            call samples%random%uniform(0.5_dp, 1.5_dp, shift)
            samples%elsewhere(i, k) = samples%elsewhere(i, k) + &
                                      shift*(1.0_dp + abs(samples%elsewhere(i, k)))
        end do
    end subroutine move_away
end module lagrangia_motion_samples
