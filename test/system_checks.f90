module system_checks
    !! What must hold for every system: any suite, and the walk over the catalogue, calls it.
    !!
    !! Parameters and states are drawn at random, the same ones in every run. A draw may put
    !! parameters on the edge of their domain (no gravity, no spring), where further quantities
    !! are conserved. Velocities of a non-holonomic system are completed from the free ones.
    use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_quiet_nan, ieee_value
    use funit, only: anyExceptions, assertEqual, assertFalse, assertGreaterThan, assertIsFinite, &
                     assertLessThan, assertLessThanOrEqual, assertTrue
    use lagrangia_description, only: description_t, line_length, name_length, parameter_t, &
                                     quantity_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_lagrange, only: accelerations_from_lagrangian, energy_from_lagrangian, &
                                  euler_lagrange_t, expand_lagrangian
    use lagrangia_system, only: default_values, system_t
    implicit none (type, external)
    private
    public :: check_system
    public :: check_description, check_refusals, check_equations, check_flow, check_flags
    public :: check_points
    public :: draw_parameters, draw_state, flow_derivative, restart_random, uniform

    integer, parameter :: draws = 40  !! of parameters and states, for each claim
    real(dp), parameter :: rounding = 500.0_dp*epsilon(1.0_dp)
    !! of expressions with some ten operations, each of which loses half an epsilon, behind
    !! a mass matrix of condition 10 to 100
    real(dp), parameter :: differencing = 1e-10_dp
    !! of `flow_derivative`, relative: rounding, epsilon/step, is 2e-14 times the number of
    !! terms over the step's share; truncation is smaller

    integer(i8) :: seed = 20110901_i8

contains

    subroutine check_system(system)
        !! All that a system claims. On return it has parameters of the last draw.
        class(system_t), intent(inout) :: system

        call restart_random()
        call check_description(system)
        if (anyExceptions()) return
        call check_refusals(system)
        if (anyExceptions()) return
        call check_equations(system)
        call check_flow(system)
        call check_flags(system)
    end subroutine check_system

    subroutine check_description(system)
        !! Complete, no line cut off, no name used twice, `ndof` as many as coordinates.
        class(system_t), intent(inout) :: system
        type(description_t) :: d
        character(:), allocatable :: name
        character(name_length), allocatable :: names(:)
        type(error_t), allocatable :: error
        integer :: i

        call system%describe(d)
        name = trim(d%name)
        call assertGreaterThan(len(name), 0, message="a system without a name")
        call assertTrue(allocated(d%coordinates), name//": coordinates")
        call assertTrue(allocated(d%parameters), name//": parameters")
        call assertTrue(allocated(d%lagrangian), name//": lagrangian")
        call assertTrue(allocated(d%equations), name//": equations")
        if (anyExceptions()) return
        call system%configure(default_values(d), error)
        call assertFalse(allocated(error), name//": the defaults are allowed")
        if (anyExceptions()) return
        call assertEqual(system%ndof, size(d%coordinates), name//": ndof")
        call check_line(d%title, name//": title")
        call check_line(d%energy, name//": energy")
        call check_line(d%constraint, name//": constraint")
        call check_line(d%source, name//": source")
        do i = 1, size(d%lagrangian)
            call check_line(d%lagrangian(i), name//": lagrangian")
        end do
        do i = 1, size(d%equations)
            call check_line(d%equations(i), name//": equations")
        end do
        if (allocated(d%notes)) then
            do i = 1, size(d%notes)
                call check_line(d%notes(i), name//": notes")
            end do
        end if
        do i = 1, size(d%parameters)
            call check_line(d%parameters(i)%meaning, name//": "//trim(d%parameters(i)%name))
        end do
        call check_quantities(d%coordinates, name)
        names = [character(name_length) :: "t", "energy", d%coordinates%name, d%parameters%name]
        if (allocated(d%quantities)) then
            call check_quantities(d%quantities, name)
            names = [names, d%quantities%name]
        end if
        do i = 1, size(names)
            call assertEqual(1, count(names == names(i)), name//": "//trim(names(i))//" is unique")
        end do
    end subroutine check_description

    subroutine check_quantities(items, name)
        !! Each has a name, a unit and a meaning.
        type(quantity_t), intent(in) :: items(:)
        character(*), intent(in) :: name
        integer :: i

        do i = 1, size(items)
            associate (length => len_trim(items(i)%name), unit => len_trim(items(i)%unit))
                call assertGreaterThan(length, 0, message=name//": quantity without name")
                call assertLessThan(length, name_length, message=name//": name cut off")
                call assertGreaterThan(unit, 0, message=name//": quantity without unit")
            end associate
            call check_line(items(i)%meaning, name//": "//trim(items(i)%name))
        end do
    end subroutine check_quantities

    subroutine check_line(text, message)
        !! Neither empty nor as long as its variable: then it was probably cut off.
        character(*), intent(in) :: text, message

        call assertGreaterThan(len_trim(text), 0, message=message//": empty")
        call assertLessThan(len_trim(text), line_length, message=message//": cut off")
    end subroutine check_line

    subroutine check_refusals(system)
        !! What is outside its domain is refused, by name, and leaves the system as it was.
        class(system_t), intent(inout) :: system
        type(description_t) :: d, after
        real(dp), allocatable :: values(:), wrong(:)
        real(dp) :: infinity
        integer :: i, k

        call system%describe(d)
        values = default_values(d)
        k = 0
        do i = 1, size(d%parameters)
            associate (p => d%parameters(i))
                infinity = ieee_value(1.0_dp, ieee_positive_inf)
                wrong = [infinity, -infinity]
                if (len_trim(p%computed) == 0) wrong = [wrong, ieee_value(1.0_dp, ieee_quiet_nan)]
                if (p%lower > -huge(1.0_dp)) wrong = [wrong, p%lower - 0.1_dp]
                if (p%upper < huge(1.0_dp)) wrong = [wrong, p%upper + 0.1_dp]
                if (p%open_lower) wrong = [wrong, p%lower]
                call check_refused(system, values, k + p%count, wrong, p)
                k = k + p%count
            end associate
        end do
        call check_count(system, [values, 1.0_dp], trim(d%name))
        call check_count(system, values(:size(values) - 1), trim(d%name))
        call system%describe(after)
        call assertEqual(values, default_values(after), message=trim(d%name)//": unchanged")
    end subroutine check_refusals

    subroutine check_refused(system, values, k, wrong, p)
        !! Each of `wrong` in place `k` is refused by the name of `p`.
        class(system_t), intent(inout) :: system
        real(dp), intent(in) :: values(:), wrong(:)
        integer, intent(in) :: k
        type(parameter_t), intent(in) :: p
        type(error_t), allocatable :: error
        real(dp) :: changed(size(values))
        integer :: i

        do i = 1, size(wrong)
            changed = values
            changed(k) = wrong(i)
            call system%configure(changed, error)
            call assertTrue(allocated(error), trim(p%name)//" outside its domain is refused")
            if (.not. allocated(error)) return
            call assertGreaterThan(index(error%message, trim(p%name)//" = "), 0, &
                                   message="a refusal names "//trim(p%name)//": "//error%message)
        end do
    end subroutine check_refused

    subroutine check_count(system, values, name)
        !! A wrong number of values is refused.
        class(system_t), intent(inout) :: system
        real(dp), intent(in) :: values(:)
        character(*), intent(in) :: name
        type(error_t), allocatable :: error

        call system%configure(values, error)
        call assertTrue(allocated(error), name//": wrong count of parameters is refused")
        if (.not. allocated(error)) return
        call assertGreaterThan(index(error%message, "parameter values, not"), 0, &
                               message=error%message)
    end subroutine check_count

    subroutine check_equations(system)
        !! Accelerations and energy are those of the Lagrangian, and the accelerations keep the
        !! non-holonomic constraints. Errors are relative to the terms that are added.
        class(system_t), intent(inout) :: system
        type(description_t) :: d
        type(euler_lagrange_t) :: terms
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:), a(:), oracle(:), lambda(:)
        real(dp) :: t, e, scale
        integer :: i

        call system%describe(d)
        do i = 1, draws
            call draw_parameters(system, edges=mod(i, 2) == 0)
            call draw_state(system, t, q, v)
            allocate (a(system%ndof), oracle(system%ndof), lambda(system%constraints))
            call system%accelerations(t, q, v, a)
            call accelerations_from_lagrangian(system, t, q, v, oracle, lambda, error)
            call assertFalse(allocated(error), trim(d%name)//": accelerations from L")
            if (anyExceptions()) return
            call expand_lagrangian(system, t, q, v, terms)
            scale = maxval(abs(oracle)) + maxval(abs(v))**2 &
                    + maxval(abs(terms%dl_dq))/maxval(abs(terms%mass))
            call assertLessThanOrEqual(maxval(abs(a - oracle))/scale, rounding, &
                                       message=trim(d%name)//": accelerations as from L")
            call assertLessThanOrEqual(constraint_error(system, t, q, v, a), rounding, &
                                       message=trim(d%name)//": accelerations keep the constraints")
            e = energy_from_lagrangian(system, t, q, v)
            scale = sum(abs(v*terms%dl_dv)) + abs(terms%l) + tiny(1.0_dp)
            call assertLessThanOrEqual(abs(system%energy(t, q, v) - e)/scale, rounding, &
                                       message=trim(d%name)//": energy is v dL/dv - L")
            deallocate (a, oracle, lambda)
            if (anyExceptions()) return
        end do
    end subroutine check_equations

    function constraint_error(system, t, q, v, a) result(worst)
        !! The largest of \(A\dot q + b\) and of its time derivative, relative to their terms.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:), a(:)
        real(dp) :: worst
        type(hyperdual_t) :: rows(system%constraints, system%ndof), drift(system%constraints)
        type(hyperdual_t) :: path(system%ndof)
        integer :: i

        worst = 0.0_dp
        if (system%constraints == 0) return
        path = hyperdual(q)
        path%d1 = v
        call system%constraint_rows(hyperdual_t(re=t, d1=1.0_dp), path, rows, drift)
        do i = 1, system%constraints
            associate (row => rows(i, :)%re, row_dot => rows(i, :)%d1)
                worst = max(worst, abs(dot_product(row, v) + drift(i)%re) &
                                   /(sum(abs(row*v)) + abs(drift(i)%re) + tiny(1.0_dp)))
                worst = max(worst, abs(dot_product(row, a) + dot_product(row_dot, v) &
                                       + drift(i)%d1) &
                                   /(sum(abs(row*a)) + sum(abs(row_dot*v)) + abs(drift(i)%d1) &
                                     + tiny(1.0_dp)))
            end associate
        end do
    end function constraint_error

    subroutine check_flow(system)
        !! Along the motion, conserved quantities do not change, and the energy \(h\) changes as
        !! it must, \(\dot h = -\partial L/\partial t - b\cdot\lambda\).
        class(system_t), intent(inout) :: system
        type(description_t) :: d
        type(euler_lagrange_t) :: terms
        type(error_t), allocatable :: error
        type(hyperdual_t), allocatable :: rows(:, :), drift(:)
        real(dp), allocatable :: q(:), v(:), oracle(:), lambda(:)
        real(dp) :: t, rate, scale, expected
        integer :: i, k

        do i = 1, draws
            call draw_parameters(system, edges=mod(i, 2) == 0)
            call draw_state(system, t, q, v)
            call system%describe(d)
            allocate (oracle(system%ndof), lambda(system%constraints))
            allocate (rows(system%constraints, system%ndof), drift(system%constraints))
            call accelerations_from_lagrangian(system, t, q, v, oracle, lambda, error)
            call system%constraint_rows(hyperdual(t), hyperdual(q), rows, drift)
            call expand_lagrangian(system, t, q, v, terms)
            expected = -terms%dl_dt - dot_product(drift%re, lambda)
            call flow_derivative(system, 0, t, q, v, rate, scale)
            call assertLessThanOrEqual(abs(rate - expected), differencing*scale, &
                                       message=trim(d%name)//": rate of the energy")
            if (allocated(d%quantities)) then
                do k = 1, size(d%quantities)
                    call assertIsFinite(system%quantity(k, t, q, v), trim(d%quantities(k)%name))
                    if (.not. d%quantities(k)%conserved) cycle
                    call flow_derivative(system, k, t, q, v, rate, scale)
                    call assertLessThanOrEqual( &
                        abs(rate), differencing*scale, message=trim(d%name)//": "// &
                        trim(d%quantities(k)%name)//" is conserved")
                end do
            end if
            deallocate (oracle, lambda, rows, drift)
            if (anyExceptions()) return
        end do
    end subroutine check_flow

    subroutine flow_derivative(system, i, t, q, v, rate, scale)
        !! Time derivative of quantity `i` (0: the energy) along the equations of motion, by
        !! central differences of order 8 along \((1, \dot q, \ddot q)\), and the size of what
        !! adds up to it: the changes with time, coordinates and velocities taken one by one.
        class(system_t), intent(in) :: system
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp), intent(out) :: rate, scale
        real(dp) :: a(size(q)), zero(size(q)), one(size(q)), h
        integer :: k

        call system%accelerations(t, q, v, a)
        zero = 0.0_dp
        h = 0.02_dp/(1.0_dp + maxval(abs(v)) + maxval(abs(a)))
        rate = slope(system, i, t, q, v, 1.0_dp, v, a, h)
        scale = abs(slope(system, i, t, q, v, 1.0_dp, zero, zero, h))
        do k = 1, size(q)
            one = zero
            one(k) = v(k)
            scale = scale + abs(slope(system, i, t, q, v, 0.0_dp, one, zero, h))
            one(k) = a(k)
            scale = scale + abs(slope(system, i, t, q, v, 0.0_dp, zero, one, h))
        end do
        scale = scale + abs(value_of(system, i, t, q, v)) + tiny(1.0_dp)
    end subroutine flow_derivative

    function slope(system, i, t, q, v, dt, dq, dv, h) result(rate)
        !! Derivative of quantity `i` in the direction `(dt, dq, dv)`, order 8 in the step `h`.
        class(system_t), intent(in) :: system
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(:), v(:), dt, dq(:), dv(:), h
        real(dp) :: rate
        real(dp), parameter :: weight(4) = [4.0_dp/5.0_dp, -1.0_dp/5.0_dp, 4.0_dp/105.0_dp, &
                                            -1.0_dp/280.0_dp]
        integer :: k

        rate = 0.0_dp
        do k = 1, 4
            rate = rate + weight(k)/h &
                   *(value_of(system, i, t + k*h*dt, q + k*h*dq, v + k*h*dv) &
                     - value_of(system, i, t - k*h*dt, q - k*h*dq, v - k*h*dv))
        end do
    end function slope

    function value_of(system, i, t, q, v) result(value)
        !! Quantity `i`, or the energy if `i` is 0.
        class(system_t), intent(in) :: system
        integer, intent(in) :: i
        real(dp), intent(in) :: t, q(:), v(:)
        real(dp) :: value

        if (i == 0) then
            value = system%energy(t, q, v)
        else
            value = system%quantity(i, t, q, v)
        end if
    end function value_of

    subroutine check_flags(system)
        !! `velocity_forces`, `time_dependent` and `cyclic` say what is true: a flag that is not
        !! set always, one that is set for parameters off the edges of their domains.
        class(system_t), intent(inout) :: system
        type(description_t) :: d
        real(dp), allocatable :: q(:), v(:), other_q(:), other_v(:)
        real(dp) :: t, other_t, by_velocity, by_time
        integer :: i

        call system%describe(d)
        do i = 1, draws
            call draw_parameters(system, edges=mod(i, 2) == 0)
            call draw_state(system, t, q, v)
            call draw_state(system, other_t, other_q, other_v)
            by_velocity = change(system, t, q, v, t, other_v)
            by_time = change(system, t, q, v, other_t, v)
            if (.not. system%velocity_forces) then
                call assertLessThanOrEqual(by_velocity, 0.0_dp, &
                                           message=trim(d%name)//": velocity_forces is .false.")
            else if (mod(i, 2) == 1 .and. system%constraints == 0) then
                call assertGreaterThan(by_velocity, 0.0_dp, &
                                       message=trim(d%name)//": velocity_forces is .true.")
            end if
            if (.not. system%time_dependent) then
                call assertLessThanOrEqual(by_time, 0.0_dp, &
                                           message=trim(d%name)//": time_dependent is .false.")
            end if
            call check_time_and_cyclic(system, t, q, v, other_t, mod(i, 2) == 1, trim(d%name))
            if (anyExceptions()) return
        end do
    end subroutine check_flags

    function change(system, t, q, v, other_t, other_v) result(difference)
        !! Of the accelerations between two times and velocities.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:), other_t, other_v(:)
        real(dp) :: difference
        real(dp) :: a(size(q)), b(size(q))

        call system%accelerations(t, q, v, a)
        call system%accelerations(other_t, q, other_v, b)
        difference = maxval(abs(a - b))
    end function change

    subroutine check_time_and_cyclic(system, t, q, v, other_t, generic, name)
        !! The same of the Lagrangian: its value at two times, its slope along `cyclic`.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:), other_t
        logical, intent(in) :: generic
        character(*), intent(in) :: name
        type(euler_lagrange_t) :: terms, later

        call expand_lagrangian(system, t, q, v, terms)
        call expand_lagrangian(system, other_t, q, v, later)
        if (.not. system%time_dependent) then
            call assertEqual(terms%l, later%l, message=name//": L without the time")
        else if (generic) then
            call assertGreaterThan(abs(later%l - terms%l), 0.0_dp, &
                                   message=name//": L with the time")
        end if
        call assertTrue(system%cyclic <= system%ndof, name//": cyclic is a coordinate")
        if (system%cyclic > 0) then
            call assertEqual(0.0_dp, terms%dl_dq(system%cyclic), message=name//": cyclic")
        end if
    end subroutine check_time_and_cyclic

    subroutine check_points(system)
        !! \(\sum_k m_k\,\partial r_k/\partial q_i\cdot\partial r_k/\partial q_j\) is the mass
        !! matrix of the Lagrangian: for systems whose inertia is all in their points.
        class(system_t), intent(inout) :: system
        type(description_t) :: d
        type(euler_lagrange_t) :: terms
        type(hyperdual_t), allocatable :: r(:, :), qq(:)
        real(dp), allocatable :: q(:), v(:), mass(:, :)
        real(dp) :: t
        integer :: i, j, k, draw

        do draw = 1, draws
            call draw_parameters(system, edges=.false.)
            call draw_state(system, t, q, v)
            call system%describe(d)
            call expand_lagrangian(system, t, q, v, terms)
            allocate (r(3, size(d%points)), mass(system%ndof, system%ndof))
            mass = 0.0_dp
            do i = 1, system%ndof
                do j = 1, system%ndof
                    qq = hyperdual(q)
                    qq(i)%d1 = 1.0_dp
                    qq(j)%d2 = 1.0_dp
                    call system%positions(hyperdual(t), qq, r)
                    do k = 1, size(d%points)
                        mass(i, j) = mass(i, j) + d%points(k)%mass*sum(r(:, k)%d1*r(:, k)%d2)
                    end do
                end do
            end do
            call assertEqual(terms%mass, mass, rounding*maxval(abs(terms%mass)), &
                             trim(d%name)//": mass matrix from positions")
            deallocate (r, mass)
            if (anyExceptions()) return
        end do
    end subroutine check_points

    subroutine draw_parameters(system, edges)
        !! Parameters unlike 1 and unlike each other; with `edges` some lie on the edge of their
        !! domain, or are zero, and some that have a formula are left to it.
        class(system_t), intent(inout) :: system
        logical, intent(in) :: edges
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp), allocatable :: values(:)
        real(dp) :: lowest, chance
        integer :: i, j, k

        call system%describe(d)
        values = default_values(d)
        k = 0
        do i = 1, size(d%parameters)
            associate (p => d%parameters(i))
                lowest = max(p%lower, -2.0_dp)
                if (p%open_lower) lowest = p%lower + 0.2_dp
                do j = 1, p%count
                    k = k + 1
                    values(k) = uniform(lowest, min(p%upper, lowest + 4.0_dp))
                    chance = uniform(0.0_dp, 1.0_dp)
                    if (.not. edges .or. chance > 0.4_dp) cycle
                    if (len_trim(p%computed) > 0) then
                        values(k) = ieee_value(1.0_dp, ieee_quiet_nan)
                    else if (.not. p%open_lower) then
                        values(k) = merge(p%lower, 0.0_dp, p%lower > -huge(1.0_dp))
                    end if
                end do
            end associate
        end do
        call system%configure(values, error)
        call assertFalse(allocated(error), trim(d%name)//": parameters inside their domains")
    end subroutine draw_parameters

    subroutine draw_state(system, t, q, v)
        !! A time, coordinates, and velocities that the constraints allow.
        class(system_t), intent(in) :: system
        real(dp), intent(out) :: t
        real(dp), allocatable, intent(out) :: q(:), v(:)
        real(dp) :: given(system%ndof - system%constraints)
        type(error_t), allocatable :: error
        integer :: i

        allocate (q(system%ndof), v(system%ndof))
        t = uniform(-2.0_dp, 3.0_dp)
        do i = 1, system%ndof
            q(i) = uniform(-3.0_dp, 3.0_dp)
        end do
        do i = 1, size(given)
            given(i) = uniform(-3.0_dp, 3.0_dp)
        end do
        call system%complete_velocities(t, q, given, v, error)
        call assertFalse(allocated(error), "velocities that the constraints allow")
    end subroutine draw_state

    subroutine restart_random()
        !! Begin the sequence of `uniform` again.
        seed = 20110901_i8
    end subroutine restart_random

    function uniform(lower, upper) result(x)
        !! The next number between `lower` and `upper` (Park & Miller's minimal standard).
        real(dp), intent(in) :: lower, upper
        real(dp) :: x
        integer(i8), parameter :: modulus = 2147483647_i8

        seed = mod(48271_i8*seed, modulus)
        x = lower + (upper - lower)*real(seed, dp)/modulus
    end function uniform
end module system_checks
