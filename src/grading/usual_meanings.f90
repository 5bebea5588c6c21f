module lagrangia_usual_meanings
    !! What H, U, p, v and the force S of a string mostly stand for.
    use lagrangia_canonical_form, only: simplified
    use lagrangia_derivative, only: derivative, time_derivative
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: apply, expression_t, f_sqrt, operator(**), operator(*), &
                                    operator(+), operator(-), operator(/), symbol, whole
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_sample_names, only: axes, samples_t, states, usual_t
    use lagrangia_sampled_formula, only: summands
    use lagrangia_slip_search, only: holds
    use lagrangia_slope_at_momentum, only: most_cyclic, slope_at_momentum
    use lagrangia_substitution, only: substituted
    use lagrangia_text, only: append_word, to_text, word_t
    use lagrangia_written_out, only: energy_formulas
    implicit none (type, external)
    private
    public :: collect_meanings, force_readings, multiplier_readings
    public :: energy_name

    character(*), parameter :: digits = "0123456789"
    character, parameter :: energy_name = "h"  !! of v dL/dv - L, where that is not T + V
    integer, parameter :: most_names = 400, most_coordinates = 12

contains

    subroutine collect_meanings(d, samples, all)
        !! Every name that may be said of this system.
        type(description_t), intent(in) :: d                   !! of the system
        type(samples_t), intent(in) :: samples                 !! know its symbols
        type(usual_t), allocatable, intent(out) :: all(:)      !! the likelier meaning first
        integer :: n

        allocate (all(most_names))
        n = 0
        call collect_energies(samples, all, n)
        if (allocated(d%notes)) then
            if (any(index(d%notes, energy_name//" = ") > 0)) call put( &
                all, n, samples, energy_name, "v dL/dv - L", symbol(samples%symbols%find("E")))
        end if
        if (samples%ndof <= most_coordinates) then
            call collect_momenta(samples, all, n)
            call collect_points(d, samples, all, n)
        end if
        call collect_effective(samples, all, n)
        call collect_forces(d, samples, all, n)
        call collect_frequencies(samples, all, n)
        all = all(:n)
    end subroutine collect_meanings

    pure subroutine collect_energies(samples, all, n)
        !! H, U, and words for T and V; \(\partial H/\partial q\) and \(\partial H/\partial p\).
        type(samples_t), intent(in) :: samples
        type(usual_t), intent(inout) :: all(:)
        integer, intent(inout) :: n
        character(*), parameter :: of_t(*) = [character(5) :: "KE", "E_kin", "T_kin", "Ekin"]
        character(*), parameter :: of_v(*) = [character(5) :: "U", "PE", "E_pot", "V_pot", "Epot"]
        character(name_length) :: q
        integer :: e, i, t, v

        t = samples%symbols%find("T")
        v = samples%symbols%find("V")
        e = samples%symbols%find("E")
        call put(all, n, samples, "H", "the energy E in q and p", symbol(e), always=.true.)
        do i = 1, samples%ndof
            q = samples%symbols%names(1 + i)
            call put(all, n, samples, "dH_d"//q, "", -symbol(samples%symbols%find("dL_d"//q)), &
                     always=.true.)
            call put(all, n, samples, "dH_dp_"//q, "", symbol(1 + samples%ndof + i), always=.true.)
            if (samples%ndof == 1) call put(all, n, samples, "dH_dp", "", symbol(3), always=.true.)
        end do
        if (t > 0) call put(all, n, samples, "K", "T", symbol(t))
        do i = 1, size(of_t)
            if (t > 0) call put(all, n, samples, of_t(i), "T", symbol(t), always=.true.)
        end do
        do i = 1, size(of_v)
            if (v > 0) call put(all, n, samples, of_v(i), "V", symbol(v), always=.true.)
        end do
        do i = 1, samples%ndof
            q = samples%symbols%names(1 + i)
            v = samples%symbols%find_definition("dV_d"//q)
            if (v > 0) call put(all, n, samples, "dU_d"//q, "", &
                                samples%symbols%definitions(v)%meaning, always=.true.)
        end do
    end subroutine collect_energies

    pure subroutine collect_momenta(samples, all, n)
        !! p of one coordinate, `p1` of `theta1`; v of one coordinate, and a.
        type(samples_t), intent(in) :: samples
        type(usual_t), intent(inout) :: all(:)
        integer, intent(inout) :: n
        character(name_length) :: q
        integer :: i, k

        do i = 1, samples%ndof
            q = samples%symbols%names(1 + i)
            k = samples%symbols%find("p_"//q)
            if (samples%ndof == 1) call put(all, n, samples, "p", "p_"//q, symbol(k))
            call put(all, n, samples, "Q_"//q, "the generalised force", whole(0))
            call put(all, n, samples, trim(q)//"dot", "", symbol(1 + samples%ndof + i), &
                     always=.true.)
            call put(all, n, samples, trim(q)//"ddot", "", symbol(1 + 2*samples%ndof + i), &
                     always=.true.)
            call put(all, n, samples, trim(q)//"_dotdot", "", symbol(1 + 2*samples%ndof + i), &
                     always=.true.)
            if (number_of(q) == "") cycle
            call put(all, n, samples, "p_"//number_of(q), "p_"//q, symbol(k), always=.true.)
            call put(all, n, samples, "p"//number_of(q), "p_"//q, symbol(k))
        end do
        if (samples%ndof /= 1) return
        if (all_letters(samples, ["x", "y", "z", "s", "r", "q"])) then
            call put(all, n, samples, "a", trim(samples%symbols%names(2))//"_ddot", symbol(4))
        end if
    contains
        pure logical function all_letters(of, lengths)
            !! Is the one coordinate called like a length?
            type(samples_t), intent(in) :: of
            character, intent(in) :: lengths(:)

            all_letters = any(of%symbols%names(2) == lengths)
        end function all_letters
    end subroutine collect_momenta

    subroutine collect_points(d, samples, all, n)
        !! `x1`, `y1`, `v1` and `T_1` of the first mass; without a number if there is only one. v of
        !! several masses is that of the one called m, or of all if they go with one speed.
        type(description_t), intent(in) :: d
        type(samples_t), intent(in) :: samples
        type(usual_t), intent(inout) :: all(:)
        integer, intent(inout) :: n
        character(name_length) :: point
        type(expression_t) :: mass, speed2
        type(error_t), allocatable :: error
        logical :: together
        integer :: i

        if (.not. allocated(d%points)) return
        together = samples%ndof == 1
        do i = 1, size(d%points)
            point = d%points(i)%name
            speed2 = rate("x")**2 + rate("y")**2 + rate("z")**2
            if (samples%ndof == 1) then
                if (is_speed_of(point, samples%values(:, 3)**2)) speed2 = symbol(3)**2
            end if
            together = together .and. speed2%depends_on(3)
            call add_for(to_text(i))
            if (number_of(point) /= "" .and. number_of(point) /= to_text(i)) then
                call add_for(number_of(point))
            end if
            if (size(d%points) == 1) call add_for("")
            if (size(d%points) == 1) cycle
            if (d%points(i)%mass_formula == "m") then
                call put(all, n, samples, "v", "the speed of "//point, apply(f_sqrt, speed2), &
                         either_sign=.true.)
            else if (together .and. i == size(d%points)) then
                call put(all, n, samples, "v", "the speed of the masses", apply(f_sqrt, speed2), &
                         either_sign=.true.)
            end if
        end do
    contains
        logical function is_speed_of(point, square)
            !! Does it go as fast as that, at all states?
            character(*), intent(in) :: point
            real(dp), intent(in) :: square(:)
            real(dp) :: speeds(size(square))
            integer :: m

            speeds = 0.0_dp
            do m = 1, size(axes)
                speeds = speeds + samples%values(:, samples%symbols%find( &
                                                 axes(m)//"_"//trim(point)//"_dot"))**2
            end do
            is_speed_of = maxval(abs(speeds - square) - 1e-12_dp*square) <= 0.0_dp
        end function is_speed_of

        function rate(axis) result(e)
            character, intent(in) :: axis
            type(expression_t) :: e

            e = symbol(samples%symbols%find(axis//"_"//trim(point)//"_dot"))
        end function rate

        subroutine add_for(number)
            character(*), intent(in) :: number

            call add_place("x", number)
            call add_place("y", number)
            call add_place("z", number)
            call put(all, n, samples, "v"//number, "the speed of "//point, apply(f_sqrt, speed2), &
                     either_sign=.true.)
            if (d%points(i)%mass_formula == "" .or. number == "") return
            call parse_formula(trim(d%points(i)%mass_formula), samples%symbols, mass, error)
            if (allocated(error)) return
            call put(all, n, samples, "T"//number, "the kinetic energy of "//point, &
                     mass/whole(2)*speed2, only_compared=.true.)
            if (number /= to_text(i)) return
            call put(all, n, samples, "T_"//trim(point), "the kinetic energy of "//point, &
                     mass/whole(2)*speed2, only_compared=.true.)
        end subroutine add_for

        subroutine add_place(axis, number)
            character, intent(in) :: axis
            character(*), intent(in) :: number
            integer :: k

            k = samples%symbols%find(axis//"_"//trim(point))
            call put(all, n, samples, axis//number, samples%symbols%names(k), symbol(k), &
                     either_sign=.true., any_zero=.true., only_compared=.true.)
        end subroutine add_place
    end subroutine collect_points

    subroutine collect_effective(samples, all, n)
        !! The effective potential of one coordinate, or of the one that is not cyclic, with the
        !! momenta of the others.
        type(samples_t), intent(in) :: samples
        type(usual_t), intent(inout) :: all(:)
        integer, intent(inout) :: n
        character(*), parameter :: label = "the effective potential"
        character(*), parameter :: potentials(*) = ["V_eff", "U_eff"]
        type(expression_t) :: curvature, effective, slope, still(1)
        type(expression_t), allocatable :: formulas(:)
        integer :: k, place, velocity
        logical :: conserves

        if (samples%lagrangian%count == 0 .or. samples%ndof > most_cyclic + 1) return
        if (samples%lagrangian%depends_on(1)) return
        still(1) = whole(0)
        call energy_formulas(samples, formulas)  ! L may be printed as T - V
        if (samples%ndof == 1) then
            effective = -substituted(formulas(1), [3], still)
            call put(all, n, samples, "V_eff", "- L at rest", effective, any_zero=.true.)
            call put(all, n, samples, "U_eff", "- L at rest", effective, any_zero=.true.)
            return
        end if
        place = only_place(formulas(1), samples)
        if (place == 0) return
        velocity = place + samples%ndof
        slope = simplified(-substituted(derivative(formulas(1), place), [velocity], still), &
                           samples%symbols)
        do k = 1, 2  ! p_psi^2/(2 I3), which is constant, is mostly no part of it
            effective = formulas(2)
            conserves = k == 1 .and. formulas(3)%count > 1 .and. formulas(4)%count > 0
            if (conserves) effective = without_conserved(formulas(3), samples) + formulas(4)
            effective = simplified(substituted(effective, [velocity], still), samples%symbols)
            call put(all, n, samples, "V_eff", label, effective, any_zero=.true.)
            call put(all, n, samples, "U_eff", label, effective, any_zero=.true.)
        end do
        curvature = simplified(slope_at_momentum(slope, place, formulas(1), samples), &
                               samples%symbols)
        do k = 1, size(potentials)
            associate (name => potentials(k), by => "_d"//trim(samples%symbols%names(place)))
                call put(all, n, samples, "d"//name//by, "", slope, always=.true.)
                call put(all, n, samples, "dd"//name//by//by, "", curvature, always=.true.)
            end associate
        end do
    end subroutine collect_effective

    pure function only_place(lagrangian, samples) result(place)
        !! Of the one coordinate that is not cyclic, whose velocity no other one's momentum has; 0:
        !! there is none.
        type(expression_t), intent(in) :: lagrangian  !! in coordinates and velocities
        type(samples_t), intent(in) :: samples
        integer :: place
        integer :: i, k

        place = 0
        if (.not. allocated(samples%mass)) return
        if (count([(lagrangian%depends_on(1 + i), i=1, samples%ndof)]) /= 1) return
        k = findloc([(lagrangian%depends_on(1 + i), i=1, samples%ndof)], .true., 1)
        do i = 1, samples%ndof
            if (i == k) cycle
            if (any(is_nonzero(samples%mass(i, k, :)))) return
            ! a force beside L
            if (any(abs(samples%values(:, samples%rate(samples%symbols%find("p_"// &
                trim(samples%symbols%names(1 + i)))))) > 1e-9_dp)) return
        end do
        place = 1 + k
    end function only_place

    function without_conserved(kinetic, samples) result(rest)
        !! The summands of T that change.
        type(expression_t), intent(in) :: kinetic
        type(samples_t), intent(in) :: samples
        type(expression_t) :: rest, part
        integer, allocatable :: nodes(:)
        real(dp), allocatable :: signs(:)
        logical :: judged, stays
        integer :: i

        rest = whole(0)
        call summands(kinetic, nodes, signs)
        do i = 1, size(nodes)
            part = kinetic%pruned(nodes(i))
            call holds(time_derivative(part, samples%rate, 1), samples%values, stays, judged)
            if (stays) cycle
            if (signs(i) < 0.0_dp) part = -part
            rest = rest + part
        end do
    end function without_conserved

    subroutine collect_forces(d, samples, all, n)
        !! S, N, F, T_1, lambda: the quantities that are forces.
        type(description_t), intent(in) :: d
        type(samples_t), intent(in) :: samples
        type(usual_t), intent(inout) :: all(:)
        integer, intent(inout) :: n
        character(*), parameter :: of_string(*) = [character(7) :: "S", "F_T", "F_S", "F_Zwang", &
                                                   "F_Z", "Z", "lambda", "F"]
        character(*), parameter :: others(*) = [character(7) :: "N", "F_N", "F_Zwang", "F_Z", "Z", &
                                             "lambda", "F"]
        integer :: i

        if (has_one_multiplier(d)) call put(all, n, samples, "lambda", "lambda1", &
            symbol(samples%symbols%find("lambda1")), either_sign=.true., is_force=.true.)
        do i = 1, size(d%quantities)
            if (d%quantities(i)%unit /= "N") cycle
            if (index(d%quantities(i)%name, "tension") == 1) then
                call put_each(of_string)
                if (number_of(d%quantities(i)%name) /= "") call put_force( &
                    "T"//number_of(d%quantities(i)%name))
            else
                call put_each(others)
            end if
        end do
    contains
        subroutine put_each(called)
            character(*), intent(in) :: called(:)
            integer :: k

            do k = 1, size(called)
                call put_force(trim(called(k)))
                if (number_of(d%quantities(i)%name) == "") cycle
                call put_force(trim(called(k))//number_of(d%quantities(i)%name))
            end do
        end subroutine put_each

        subroutine put_force(letter)
            character(*), intent(in) :: letter

            call put(all, n, samples, letter, d%quantities(i)%name, &
                     symbol(samples%symbols%find(trim(d%quantities(i)%name))), either_sign=.true., &
                     is_force=.true.)
        end subroutine put_force
    end subroutine collect_forces

    pure logical function has_one_multiplier(d)
        !! Has it one constraint beside L, with the multiplier lambda1?
        type(description_t), intent(in) :: d  !! of the system

        has_one_multiplier = any(d%quantities%name == "lambda1") .and. &
                             .not. any(d%quantities%name == "lambda2")
    end function has_one_multiplier

    subroutine multiplier_readings(d, readings)
        !! What `lambda` may be where lambda1 does not fit.
        type(description_t), intent(in) :: d                    !! of the system
        type(word_t), allocatable, intent(out) :: readings(:)   !! names with a label each

        allocate (readings(0))
        if (has_one_multiplier(d)) call force_readings("lambda", d, readings)
    end subroutine multiplier_readings

    subroutine force_readings(name, d, readings)
        !! Each force that a name may stand for: `lambda=pull`, `T_1=tension1`.
        character(*), intent(in) :: name                        !! of a sheet
        type(description_t), intent(in) :: d                    !! of the system
        type(word_t), allocatable, intent(out) :: readings(:)   !! names with a label each
        integer :: i

        allocate (readings(0))
        do i = 1, size(d%quantities)
            if (d%quantities(i)%unit == "N") call append_word(readings, name//"="// &
                                                              trim(d%quantities(i)%name))
        end do
    end subroutine force_readings

    pure subroutine collect_frequencies(samples, all, n)
        !! `omega_0` of one coordinate, where omega is no parameter; beta of a decay.
        type(samples_t), intent(in) :: samples
        type(usual_t), intent(inout) :: all(:)
        integer, intent(inout) :: n
        character(*), parameter :: called(*) = [character(7) :: "omega_0", "w", "w_0", "Omega"]
        integer :: i

        if (samples%ndof /= 1) return
        i = samples%symbols%find("omega")
        if (i /= samples%frequency) then
            ! a letter may stand for it, as sqrt(k/m) does
            if (samples%decay > 0 .or. i == 0) return
            if (any(abs(samples%values(::states, i)**2 - samples%omega2(:, 1)) > &
                    1e-9_dp*samples%omega2(:, 1))) return
            call put(all, n, samples, "omega_0", "omega", symbol(i))
            return
        end if
        do i = 1, size(called)
            if (samples%decay > 0 .and. index(called(i), "_0") > 0) then
                call put(all, n, samples, called(i), "omega_0", symbol(samples%decay + 1))
            else
                call put(all, n, samples, called(i), "omega", symbol(samples%frequency))
            end if
        end do
        if (samples%decay == 0) return
        call put(all, n, samples, "omega_d", "omega", symbol(samples%frequency))
        call put(all, n, samples, "beta", "gamma", symbol(samples%decay))
    end subroutine collect_frequencies

    pure subroutine put(all, n, samples, name, label, meaning, always, either_sign, any_zero, &
                        only_compared, is_force)
        !! One more, if no name of the system is called that.
        type(usual_t), intent(inout) :: all(:)
        integer, intent(inout) :: n
        type(samples_t), intent(in) :: samples
        character(*), intent(in) :: name, label
        type(expression_t), intent(in) :: meaning
        logical, intent(in), optional :: always, either_sign, any_zero, only_compared, is_force

        if (n == size(all)) return
        if (samples%symbols%find(name) > 0 .or. samples%symbols%find_definition(name) > 0) return
        n = n + 1
        all(n)%name = name
        all(n)%label = label
        all(n)%meaning = meaning
        if (present(always)) all(n)%always = always
        if (present(either_sign)) all(n)%either_sign = either_sign
        if (present(any_zero)) all(n)%any_zero = any_zero
        if (present(only_compared)) all(n)%only_compared = only_compared
        if (present(is_force)) all(n)%is_force = is_force
    end subroutine put

    pure function number_of(name) result(number)
        !! The digits behind a name: `1` of `theta1`.
        character(*), intent(in) :: name
        character(:), allocatable :: number

        number = name(verify(trim(name), digits, back=.true.) + 1:)
        number = trim(number)
    end function number_of
end module lagrangia_usual_meanings
