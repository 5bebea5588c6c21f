module lagrangia_motion_samples
    !! What a statement about a system may name, and the values of all these names on its motion: at
    !! states at random, with parameters at random, as the equations of motion have it.
    use lagrangia_damped_rates, only: damping_matrix
    use lagrangia_description, only: default_values, description_t, name_length, value_names
    use lagrangia_equilibrium, only: stiffness_beside
    use lagrangia_errors, only: error_t, fail
    use lagrangia_followed_letters, only: follow_elsewhere, follow_letters
    use lagrangia_gauss_principle, only: masses_of, place_points
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: energy_slopes, euler_lagrange_t, expand_lagrangian
    use lagrangia_mode_samples, only: add_modes, put_places, stable_somewhere
    use lagrangia_named_values, only: motion_state_t, path
    use lagrangia_number_class, only: all_finite, is_nonzero
    use lagrangia_parameter_choice, only: keep, occurs, spread_values
    use lagrangia_parameter_conditions, only: condition_t, satisfy
    use lagrangia_random_draws, only: random_t
    use lagrangia_sample_names, only: axes, draws, name_symbols, role_acceleration, &
                                      role_frequency, role_known, samples_t, states
    use lagrangia_small_oscillations, only: find_modes, likely_equilibrium, modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: new_samples, put_elsewhere, put_state

    integer, parameter :: most_expanded = 8  !! coordinates whose mass matrix is kept
    integer, parameter :: most_tries = 60    !! of parameters with an oscillation
    real(dp), parameter :: small = 1e-12_dp  !! values that may be rounding errors

contains

    pure subroutine refuse_letters(d, error)
        !! A system whose own names are those of L, T, V or the energy: nobody could say which of
        !! both an answer means.
        type(description_t), intent(in) :: d              !! of the system
        type(error_t), allocatable, intent(out) :: error  !! one of its names is
        character, parameter :: letters(4) = ["L", "T", "V", "E"]
        character(20), parameter :: meanings(4) = [character(20) :: "the Lagrangian", &
                                                   "the kinetic energy", &
                                                   "the potential energy", "the energy"]
        logical :: is_name
        integer :: i

        do i = 1, size(letters)
            is_name = any(d%coordinates%name == letters(i)) .or. &
                      any(d%quantities%name == letters(i)) .or. any(value_names(d) == letters(i))
            if (allocated(d%letters)) is_name = is_name .or. any(d%letters%name == letters(i))
            if (.not. is_name) cycle
            call fail(error, trim(d%name)//" uses the letter "//letters(i)//", which in "// &
                      "an answer is "//trim(meanings(i))//"; give it another name, such as "// &
                      letters(i)//"0")
            return
        end do
    end subroutine refuse_letters

    subroutine new_samples(system, said, settings, samples, error, own_omega, conditions)
        !! Of `system`, about which `said` speaks: a parameter that it does not name and whose
        !! default is zero or a formula keeps that.
        class(system_t), intent(in), target :: system
        !! configured; the samples point to it
        character(*), intent(in) :: said                  !! all statements
        type(word_t), intent(in) :: settings(:)           !! `name=value`: these keep their values
        type(samples_t), intent(out) :: samples           !! names and values
        type(error_t), allocatable, intent(out) :: error  !! no states at which L is a number
        logical, intent(in), optional :: own_omega        !! the sheet calls something else omega
        type(condition_t), intent(in), optional :: conditions(:)  !! that parameters satisfy
        class(system_t), allocatable :: drawn
        type(description_t) :: d
        type(error_t), allocatable :: refusal
        real(dp), allocatable :: values(:), given(:)
        logical, allocatable :: drawn_value(:), fixed(:)
        logical :: damped, own
        integer :: draw, k, tries

        samples%system => system
        call system%describe(d)
        call refuse_letters(d, error)
        if (allocated(error)) return
        call keep(d, said, settings, fixed, given, samples%kept)
        call take_energies(system, fixed, given, d)
        damped = is_damped(system, d, fixed, given, said)
        if (damped .and. allocated(d%letters)) then  ! they may be those of no drag, or of another
            d%letters = pack(d%letters, d%letters%name /= "omega" .and. d%letters%name /= "gamma")
        end if
        own = .false.
        if (present(own_omega)) own = own_omega
        call name_symbols(system, d, damped, own, samples)
        allocate (samples%values(draws*states, size(samples%symbols%names)))
        allocate (drawn, source=system)
        draw = 0
        tries = 0
        do k = 1, 40*draws
            call spread_values(d, drawn_value, fixed, given, samples%random, &
                               merge(0.1_dp, 1.0_dp, tries > 0))
            call samples%random%parameters(drawn, .false., values, refusal, &
                                           fixed .or. drawn_value, given)
            if (present(conditions) .and. .not. allocated(refusal)) call satisfy( &
                conditions, samples, drawn, values, refusal)
            if (.not. allocated(refusal)) call add_states(samples, drawn, d, draw, refusal)
            if (allocated(refusal)) cycle
            draw = draw + 1
            call add_modes(samples, drawn, draw)
            if (draw < draws) cycle
            if (tries == most_tries .or. stable_somewhere(samples) .or. index(said, "t)") == 0) exit
            tries = tries + 1  ! a sheet may write out a motion that needs an oscillation
            draw = draw - 1
        end do
        if (draw < draws) then
            call fail(error, trim(d%name)// &
                      ": no parameters and states are found at which all is finite")
            return
        end if
        call put_places(samples, samples%equilibrium, samples%values)
        call put_elsewhere(samples, d)
    end subroutine new_samples

    subroutine take_energies(system, fixed, given, d)
        !! L, T, V and quantities as the page has them with parameters at random: those that a sheet
        !! names are not zero, as the pulley's inertia of Atwood's machine is by default.
        class(system_t), intent(in) :: system
        logical, intent(in) :: fixed(:)
        real(dp), intent(in) :: given(:)
        type(description_t), intent(inout) :: d
        class(system_t), allocatable :: drawn
        type(description_t) :: now
        type(error_t), allocatable :: error
        type(random_t) :: random
        real(dp), allocatable :: values(:), kept(:)
        logical, allocatable :: drawn_value(:)

        allocate (drawn, source=system)
        kept = given
        call spread_values(d, drawn_value, fixed, kept, random)
        call random%parameters(drawn, .false., values, error, fixed .or. drawn_value, kept)
        if (allocated(error)) return
        call drawn%describe(now)
        if (allocated(now%lagrangian)) d%lagrangian = now%lagrangian
        if (allocated(now%kinetic_energy)) d%kinetic_energy = now%kinetic_energy
        if (allocated(now%potential_energy)) d%potential_energy = now%potential_energy
        if (allocated(now%generalised_forces)) d%generalised_forces = now%generalised_forces
        d%quantities%formula = now%quantities%formula
    end subroutine take_energies

    function is_damped(system, d, fixed, given, said) result(yes)
        !! Has the system one coordinate, and at rest a drag that is as the velocity, with
        !! parameters at random? Of \(-b\dot x-c\dot x^3\) the first term is the drag of small
        !! oscillations, if there are any: of \(-\mu mg\tanh(\dot x/v_0)\) it would stop
        !! them, but \(\omega\) is that of dry friction; unless the statements are about gamma.
        class(system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        logical, intent(in) :: fixed(:)
        real(dp), intent(in) :: given(:)
        character(*), intent(in) :: said  !! all statements
        logical :: yes
        class(system_t), allocatable :: drawn
        type(random_t) :: random
        real(dp) :: kept(size(given)), slope, rates(2)
        type(error_t), allocatable :: error
        real(dp), allocatable :: values(:)
        logical, allocatable :: drawn_value(:)
        logical :: linear

        yes = .false.
        if (system%ndof /= 1 .or. system%constraints > 0) return
        allocate (drawn, source=system)
        kept = given
        call spread_values(d, drawn_value, fixed, kept, random)
        call random%parameters(drawn, .false., values, error, fixed .or. drawn_value, kept)
        if (allocated(error)) return
        call look_at_rest(drawn, slope, rates, linear)
        yes = is_nonzero(slope)
        if (.not. yes .or. linear) return
        call look_at_rest(system, slope, rates, linear)
        yes = rates(1) < rates(2) .or. occurs(said, "gamma") .or. occurs(said, "Gamma")
    end function is_damped

    subroutine look_at_rest(system, slope, rates, linear)
        !! How a force beside L begins with the velocity at an equilibrium.
        class(system_t), intent(in) :: system  !! of one coordinate
        real(dp), intent(out) :: slope         !! \(C = -\partial Q/\partial\dot q\), or 0
        real(dp), intent(out) :: rates(2)      !! \((C/2M)^2\) and \(K/M\)
        logical, intent(out) :: linear         !! Q is as the velocity
        type(error_t), allocatable :: error
        type(modes_t) :: modes
        type(hyperdual_t) :: still(1), moving(1)
        real(dp), dimension(1, 1) :: beside, drag

        slope = 0.0_dp
        rates = 0.0_dp
        linear = .true.
        if (.not. system%nonconservative) return
        call find_modes(system, likely_equilibrium(system), .false., modes, error)
        if (allocated(error)) return
        call damping_matrix(system, modes%at, drag)
        call stiffness_beside(system, modes%at, beside)
        slope = drag(1, 1)
        rates = [(slope/(2.0_dp*modes%mass(1, 1)))**2, &
                 (modes%stiffness(1, 1) + beside(1, 1))/modes%mass(1, 1)]
        call system%generalised_forces(hyperdual_t(), hyperdual(modes%at), [hyperdual_t()], still)
        call system%generalised_forces(hyperdual_t(), hyperdual(modes%at), [hyperdual_t(1.0_dp)], &
                                       moving)
        linear = abs(moving(1)%re - still(1)%re + slope) <= 1e-9_dp*abs(slope)
    end subroutine look_at_rest

    subroutine add_states(samples, system, d, draw, error)
        !! Fill the rows behind the first `draw` draws.
        type(samples_t), intent(inout) :: samples
        class(system_t), intent(in) :: system   !! with the parameters of this draw
        type(description_t), intent(in) :: d    !! with any parameters
        integer, intent(in) :: draw
        type(error_t), allocatable, intent(out) :: error  !! some value is not finite
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t
        integer :: k, row

        do k = 1, states
            row = draw*states + k
            call samples%random%state(system, t, q, v, error)
            if (allocated(error)) return
            samples%values(row, :) = 0.0_dp
            call put_state(samples, system, d, row, t, q, v, error)
            if (allocated(error)) return
        end do
    end subroutine add_states

    subroutine put_state(samples, system, d, row, t, q, v, error)
        !! All values at one state; those of the modes and of constants stay. One that changes as
        !! much as it is large when parameters change in their last digits is 0, as the
        !! acceleration along a vertical wedge.
        type(samples_t), intent(inout) :: samples  !! names, and values that change
        class(system_t), intent(in) :: system    !! with the parameters of this row
        type(description_t), intent(in) :: d     !! with any parameters
        integer, intent(in) :: row               !! which of the states
        real(dp), intent(in) :: t, q(:), v(:)    !! time, s; state
        type(error_t), allocatable, intent(out) :: error  !! some value is not finite
        class(system_t), allocatable :: beside
        type(description_t) :: now
        type(error_t), allocatable :: refusal
        real(dp), dimension(size(samples%role)) :: values, noise
        real(dp), allocatable :: parameters(:)
        real(dp) :: mass(system%ndof, system%ndof)
        integer :: i, k

        call put_values(samples, system, d, row, t, q, v, error)
        if (allocated(error)) return
        values = samples%values(row, :)
        if (.not. any(is_nonzero(values) .and. abs(values) < small)) return
        if (allocated(samples%mass)) mass = samples%mass(:, :, row)
        noise = 0.0_dp
        call system%describe(now)
        allocate (parameters, source=default_values(now))
        allocate (beside, source=system)
        do k = 1, 8
            if (all(noise > 0.0_dp .or. .not. is_nonzero(values) .or. abs(values) >= small)) exit
            call beside%configure(parameters*[(1.0_dp + (-1)**(i/k)*2*epsilon(1.0_dp), &
                                               i=1, size(parameters))], refusal)
            if (.not. allocated(refusal)) call put_values(samples, beside, d, row, t, q, v, refusal)
            if (.not. allocated(refusal)) noise = max(noise, abs(samples%values(row, :) - values))
        end do
        where (abs(values) < small .and. abs(values) <= 64*noise) values = 0.0_dp
        samples%values(row, :) = values
        if (allocated(samples%mass)) samples%mass(:, :, row) = mass
    end subroutine put_state

    subroutine put_values(samples, system, d, row, t, q, v, error)
        !! As they come out.
        type(samples_t), intent(inout) :: samples  !! names, and values that change
        class(system_t), intent(in) :: system    !! with the parameters of this row
        type(description_t), intent(in) :: d     !! with any parameters
        integer, intent(in) :: row               !! which of the states
        real(dp), intent(in) :: t, q(:), v(:)    !! time, s; state
        type(error_t), allocatable, intent(out) :: error  !! some value is not finite
        type(description_t) :: now
        real(dp), allocatable :: parameters(:)
        real(dp) :: a(system%ndof)
        character(name_length), allocatable :: names(:)
        character(name_length) :: name
        integer :: i

        call system%describe(now)
        allocate (parameters, source=default_values(now))
        allocate (names, source=value_names(d))
        call system%accelerations(t, q, v, a)
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
        call put_mass()
        call put_derivatives()
        call follow_letters(samples, row)
        if (.not. all_finite(samples%values(row, :))) call fail(error, "not finite")
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

        subroutine put_mass()
            type(euler_lagrange_t) :: terms

            if (system%ndof > most_expanded .or. system%constraints > 0) return
            if (.not. allocated(samples%mass)) allocate (samples%mass(system%ndof, system%ndof, &
                                                                      draws*states))
            call expand_lagrangian(system, t, q, v, terms)
            samples%mass(:, :, row) = terms%mass
        end subroutine put_mass

        subroutine put_derivatives()
            type(hyperdual_t) :: tt, qq(system%ndof), vv(system%ndof), l
            real(dp) :: by_q(system%ndof), by_v(system%ndof), gain, scale
            integer :: j

            gain = 0.0_dp
            scale = 0.0_dp
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
                if (allocated(samples%mass)) call drop_rounding(dot_product( &
                    abs(samples%mass(j, :, row)), abs(a)), l%d12)
                call put("d_dt_dL_d"//trim(name)//"_dot", l%d12)
                gain = gain + l%d12*v(j) + l%d1*a(j)
                scale = scale + abs(l%d12*v(j)) + abs(l%d1*a(j))
                qq(j)%d1 = 1.0_dp
                l = system%lagrangian(tt, qq, vv)
                qq(j)%d1 = 0.0_dp
                call put("dL_d"//trim(name), l%d1)
            end do
            call put("L_dot", l%d2)
            gain = gain - l%d2  ! of p v - L
            call drop_rounding(scale + abs(l%d2), gain)
            call put("E_dot", gain)
            tt = hyperdual_t(t, d1=1.0_dp)
            l = system%lagrangian(tt, hyperdual(q), hyperdual(v))
            call put("dL_dt", l%d1)
            call energy_slopes(system, t, q, v, by_q, by_v)
            do j = 1, system%ndof
                call put("dE_d"//trim(d%coordinates(j)%name), by_q(j))
                call put("dE_d"//trim(d%coordinates(j)%name)//"_dot", by_v(j))
            end do
        end subroutine put_derivatives

        pure subroutine drop_rounding(scale, x)
            !! What is conserved has the rate 0.
            real(dp), intent(in) :: scale      !! of what was added up
            real(dp), intent(inout) :: x

            if (abs(x) <= 1e-12_dp*scale) x = 0.0_dp
        end subroutine drop_rounding
    end subroutine put_values

    subroutine put_elsewhere(samples, d)
        !! The same states with other accelerations and other known values than those of the motion.
        type(samples_t), intent(inout) :: samples  !! with all values
        type(description_t), intent(in) :: d       !! of the system
        integer :: k

        samples%elsewhere = samples%values
        do k = 1, size(samples%role)
            call move_away(samples, k, allocated(d%typical_places))
        end do
        call follow_elsewhere(samples)
    end subroutine put_elsewhere

    subroutine move_away(samples, k, by_size)
        !! Other accelerations and other known values than those of the motion: by 1 and more, or
        !! by the size of what is far from 1.
        type(samples_t), intent(inout) :: samples
        integer, intent(in) :: k
        logical, intent(in) :: by_size
        real(dp) :: shift, usual
        integer :: i

        if (samples%role(k) /= role_acceleration .and. samples%role(k) /= role_known .and. &
            samples%role(k) /= role_frequency) return
        usual = 1.0_dp
        if (by_size) usual = maxval(abs(samples%values(:, k)))
        if (usual <= 0.0_dp) usual = 1.0_dp
        do i = 1, size(samples%elsewhere, 1)
            call samples%random%uniform(0.5_dp, 1.5_dp, shift)
            samples%elsewhere(i, k) = samples%elsewhere(i, k) + &
                                      shift*(usual + abs(samples%elsewhere(i, k)))
        end do
    end subroutine move_away
end module lagrangia_motion_samples
