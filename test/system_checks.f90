module system_checks
    !! What must hold for every system: any suite, and the walk over the catalogue, calls it.
    !!
    !! Parameters and states are drawn at random, the same ones in every run. A draw may put
    !! parameters on the edge of their domain (no gravity, no spring), where further quantities
    !! are conserved. Velocities of a non-holonomic system are completed from the free ones.
    use description_checks, only: check_description, check_refusals
    use funit, only: anyExceptions, assertEqual, assertFalse, assertGreaterThan, assertIsFinite, &
                     assertLessThanOrEqual, assertTrue
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian, energy_from_lagrangian, &
                                  euler_lagrange_t, expand_lagrangian
    use lagrangia_system, only: system_t
    use motion, only: flow_derivative
    use random_states, only: draw_parameters, draw_state, restart_random
    implicit none (type, external)
    private
    public :: check_system
    public :: check_equations, check_flow, check_flags, check_points

    integer, parameter :: draws = 40  !! of parameters and states, for each claim
    real(dp), parameter :: rounding = 500.0_dp*epsilon(1.0_dp)
    !! of expressions with some ten operations, each of which loses half an epsilon, behind
    !! a mass matrix of condition 10 to 100
    real(dp), parameter :: differencing = 1e-10_dp
    !! of `flow_derivative`, relative: rounding, epsilon/step, is 2e-14 times the number of
    !! terms over the step's share; truncation is smaller

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
            allocate (r(3, size(d%points)), mass(system%ndof, system%ndof), qq(system%ndof))
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
            deallocate (r, mass, qq)
            if (anyExceptions()) return
        end do
    end subroutine check_points
end module system_checks
