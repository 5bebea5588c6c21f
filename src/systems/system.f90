module lagrangia_system
    !! The contract of a lecture system: what a file in `src/systems` says, and others may ask.
    !!
    !! The state is the pair \((q, v)\), \(v = \dot q\). A system says what it is (`describe`),
    !! takes its parameters (`configure`), and gives its equations of motion twice: as derived by
    !! hand (`accelerations`), and as the Lagrangian from which they were derived, with the
    !! generalised forces beside it.
    use lagrangia_counted, only: counted
    use lagrangia_description, only: check_parameter, default_values, description_t
    use lagrangia_elimination, only: solve_positive
    use lagrangia_errors, only: error_t, fail
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_linearised, only: linearised_t
    use lagrangia_reference, only: reference_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: system_t, system_box_t, reduced_t
    public :: lanes, check_parameter, check_parameters, check_state, default_values
    public :: all_velocities, each_lane

    type, abstract :: system_t
        integer :: ndof = 0                  !! number of coordinates
        logical :: velocity_forces = .true.  !! accelerations depend on the velocities
        logical :: time_dependent = .false.  !! L, a generalised force or a constraint has t in it
        logical :: timeless_lagrangian = .false.  !! L does not, though `time_dependent` is true
        logical :: nonconservative = .false. !! there are `generalised_forces`
        logical :: workless = .false.        !! they do no work, whatever the velocities are
        integer :: constraints = 0           !! rows of non-holonomic constraints
        logical :: is_projected = .false.    !! steps end with `end_step`, on them
        logical :: constraints_work = .false.  !! some \(b\) of \(A\dot q + b = 0\) is not 0
        integer :: cyclic = 0  !! a coordinate that neither L nor a generalised force has; 0 if none
        integer :: contacts = 0              !! unilateral constraints: each has a gap and impacts
    contains
        procedure(describe_i), deferred :: describe
        procedure(configure_i), deferred :: configure
        procedure(accelerations_i), deferred :: accelerations
        procedure :: accelerations_lanes => each_lane
        procedure(lagrangian_i), deferred :: lagrangian
        procedure :: generalised_forces => no_generalised_forces
        procedure(energy_i), deferred :: energy
        procedure :: momenta => momenta_of_lagrangian
        procedure :: velocities => velocities_of_lagrangian
        procedure :: forces => forces_of_lagrangian
        procedure, non_overridable :: conserves_energy
        procedure :: quantity => no_quantity
        procedure :: natural_size => no_natural_size
        procedure :: positions => no_positions
        procedure :: constraint_rows => no_constraint_rows
        procedure :: complete_velocities => all_velocities
        procedure :: free_velocities => all_free
        procedure :: check_places => any_place
        procedure :: keep_constraints => nothing_to_keep
        procedure :: linearise => nothing_by_hand
        procedure :: angles => no_angles
        procedure :: newton => no_newton
        procedure :: gap => no_gap
        procedure :: impact => no_impact
        procedure :: reduce => not_reduced
        procedure :: closed_form => no_closed_form
    end type system_t

    type, abstract, extends(system_t) :: reduced_t
        !! A system without its cyclic coordinate, which its conserved momentum gives back (Routh).
    contains
        procedure(leave_i), deferred :: leave
        procedure(complete_i), deferred :: complete
    end type reduced_t

    type :: system_box_t
        !! A place for one system of any kind.
        class(system_t), allocatable :: item
    end type system_box_t

    abstract interface
        pure subroutine describe_i(self, d)
            !! Say what the system is. Of a fresh object the parameters are the defaults.
            import :: system_t, description_t
            implicit none (type, external)
            class(system_t), intent(in) :: self
            type(description_t), intent(out) :: d  !! complete, in the units that it names
        end subroutine describe_i

        pure subroutine configure_i(self, values, error)
            !! Take all parameters, in the order of `describe`; fails where one is not allowed.
            !! NaN stands for "not given" where the default follows from the other parameters.
            import :: system_t, dp, error_t
            implicit none (type, external)
            class(system_t), intent(inout) :: self
            real(dp), intent(in) :: values(:)  !! in SI units, a vector's components in a row
            type(error_t), allocatable, intent(out) :: error
            !! status 2: names the parameter and its domain
        end subroutine configure_i

        pure subroutine accelerations_i(self, t, q, v, a)
            !! Solve the equations of motion for \(\ddot q\).
            import :: system_t, dp
            implicit none (type, external)
            class(system_t), intent(in) :: self
            real(dp), intent(in) :: t              !! time, s
            real(dp), intent(in) :: q(self%ndof)   !! coordinates
            real(dp), intent(in) :: v(self%ndof)   !! velocities
            real(dp), intent(out) :: a(self%ndof)  !! accelerations
        end subroutine accelerations_i

        pure function lagrangian_i(self, t, q, v) result(l)
            !! \(L(t, q, \dot q)\), J, on hyper-dual numbers: exact first and second derivatives.
            import :: system_t, hyperdual_t
            implicit none (type, external)
            class(system_t), intent(in) :: self
            type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)  !! time, s; state
            type(hyperdual_t) :: l
        end function lagrangian_i

        pure function energy_i(self, t, q, v) result(e)
            !! The energy function \(\dot q\,\partial L/\partial\dot q - L\), J. It is conserved
            !! where `conserves_energy` says so, and is \(T + V\) unless the coordinates move by
            !! themselves.
            import :: system_t, dp
            implicit none (type, external)
            class(system_t), intent(in) :: self
            real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)  !! time, s; state
            real(dp) :: e
        end function energy_i

        pure subroutine leave_i(self, q, v, q_left, v_left)
            !! Note what the state `(q, v)` conserves; the state without the cyclic coordinate.
            import :: reduced_t, dp
            implicit none (type, external)
            class(reduced_t), intent(inout) :: self
            real(dp), intent(in) :: q(:), v(:)                             !! the whole state
            real(dp), intent(out) :: q_left(self%ndof), v_left(self%ndof)  !! what is left of it
        end subroutine leave_i

        pure subroutine complete_i(self, elapsed, q_left, v_left, q, v)
            !! The whole state at `elapsed` s after `leave`, by what that has noted. A time so short
            !! is a better number than that on the clock.
            import :: reduced_t, dp
            implicit none (type, external)
            class(reduced_t), intent(in) :: self
            real(dp), intent(in) :: elapsed                               !! s
            real(dp), intent(in) :: q_left(self%ndof), v_left(self%ndof)  !! the reduced state
            real(dp), intent(out) :: q(:), v(:)                           !! the whole one
        end subroutine complete_i
    end interface

contains

    pure subroutine momenta_of_lagrangian(self, t, q, v, p)
        !! Canonical momenta \(p = \partial L/\partial\dot q\). A system may give its own formulae.
        class(system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)  !! time, s; state
        real(dp), intent(out) :: p(self%ndof)                  !! kg m/s, or kg m^2/s of an angle
        type(hyperdual_t) :: tt, qq(self%ndof), vv(self%ndof), l
        integer :: i

        tt%re = t
        qq%re = q
        vv%re = v
        do i = 1, self%ndof
            vv(i)%d1 = 1.0_dp
            l = self%lagrangian(tt, qq, vv)
            p(i) = l%d1
            vv(i)%d1 = 0.0_dp
        end do
    end subroutine momenta_of_lagrangian

    pure subroutine velocities_of_lagrangian(self, t, q, p, v)
        !! The inverse of `momenta`. \(L\) is of degree two in the velocities, as it is in all
        !! the lectures: \(p = M\dot q + b\), solved by elimination; \(M\) is positive definite.
        class(system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), p(self%ndof)  !! time, s; coordinates; momenta
        real(dp), intent(out) :: v(self%ndof)                  !! velocities with these momenta
        type(hyperdual_t) :: tt, qq(self%ndof), vv(self%ndof), l
        real(dp) :: mass(self%ndof, self%ndof)
        integer :: i, j

        tt%re = t
        qq%re = q
        do i = 1, self%ndof
            vv(i)%d1 = 1.0_dp
            do j = 1, self%ndof
                vv(j)%d2 = 1.0_dp
                l = self%lagrangian(tt, qq, vv)
                mass(i, j) = l%d12
                vv(j)%d2 = 0.0_dp
            end do
            v(i) = p(i) - l%d1
            vv(i)%d1 = 0.0_dp
        end do
        call solve_positive(mass, [(-huge(v), i=1, self%ndof)], v)
    end subroutine velocities_of_lagrangian

    pure subroutine forces_of_lagrangian(self, t, q, v, f)
        !! The forces \(\partial L/\partial q\), which change the momenta, without those beside L.
        class(system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)  !! time, s; state
        real(dp), intent(out) :: f(self%ndof)                  !! N, or N m on an angle
        type(hyperdual_t) :: tt, qq(self%ndof), vv(self%ndof), l
        integer :: i

        tt%re = t
        qq%re = q
        vv%re = v
        do i = 1, self%ndof
            qq(i)%d1 = 1.0_dp
            l = self%lagrangian(tt, qq, vv)
            f(i) = l%d1
            qq(i)%d1 = 0.0_dp
        end do
    end subroutine forces_of_lagrangian

    pure subroutine no_generalised_forces(self, t, q, v, f)
        !! The forces \(Q_j\) in \(d/dt\,\partial L/\partial\dot q_j - \partial L/\partial q_j
        !! = Q_j\) that are not in L: friction, a motor. \(\sum_j Q_j\,\delta q_j\) is their
        !! virtual work. On hyper-dual numbers, so that all derivatives are exact. Here there are
        !! none; who has some sets `nonconservative`, and `velocity_forces` where they depend on
        !! velocities.
        class(system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)  !! time, s; state
        type(hyperdual_t), intent(out) :: f(self%ndof)                  !! N, or N m on an angle

        f = hyperdual_t()
    end subroutine no_generalised_forces

    pure function conserves_energy(self)
        !! No time in L, no force beside it and no constraint that does work.
        class(system_t), intent(in) :: self
        logical :: conserves_energy

        conserves_energy = (self%timeless_lagrangian .or. .not. self%time_dependent) .and. &
            (self%workless .or. .not. self%nonconservative) .and. .not. self%constraints_work
    end function conserves_energy

    pure subroutine each_lane(self, t, q, v, a)
        !! `accelerations` of several states, lane by lane. A system may do better: the same
        !! equations as whole-array statements, with `sine_cosine` of all lanes at once. That is
        !! good to a unit in the last place and libm to half of one, so the last digits differ.
        class(system_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)  !! s; states
        real(dp), intent(out) :: a(lanes, self%ndof)  !! accelerations
        real(dp) :: x(self%ndof), x_dot(self%ndof), x_ddot(self%ndof)
        integer :: i

        do i = 1, lanes
            x = q(i, :)
            x_dot = v(i, :)
            call self%accelerations(t(i), x, x_dot, x_ddot)
            a(i, :) = x_ddot
        end do
    end subroutine each_lane

    pure subroutine nothing_by_hand(self, q, analytic)
        !! The small oscillations about the equilibrium `q`, as derived by hand: here nothing is.
        class(system_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof)         !! an equilibrium
        type(linearised_t), intent(out) :: analytic  !! what is known in closed form
    end subroutine nothing_by_hand

    pure function no_quantity(self, i, t, q, v) result(value)
        !! Entry `i` of the quantities in the description: here there are none.
        class(system_t), intent(in) :: self
        integer, intent(in) :: i                               !! from 1
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)  !! time, s; state
        real(dp) :: value

        value = 0.0_dp
    end function no_quantity

    pure function no_natural_size(self, i, t, q, v) result(value)
        !! How large the terms are that add up to quantity `i`, 0 for the energy: a value of some
        !! epsilon of it is rounding. Zero where nothing is known.
        class(system_t), intent(in) :: self
        integer, intent(in) :: i                               !! from 0
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)  !! time, s; state
        real(dp) :: value

        value = 0.0_dp
    end function no_natural_size

    pure subroutine no_positions(self, t, q, r)
        !! Cartesian positions, m, of the points in the description, `r(3, points)`: here none.
        class(system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)  !! time, s; coordinates
        type(hyperdual_t), intent(out) :: r(:, :)         !! (3, points), m

        r = hyperdual_t()
    end subroutine no_positions

    pure subroutine no_constraint_rows(self, t, q, rows, drift)
        !! The non-holonomic constraints \(A(t,q)\,\dot q + b(t,q) = 0\), `rows(constraints, ndof)`
        !! and `drift(constraints)`: here there are none.
        class(system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)        !! time, s; coordinates
        type(hyperdual_t), intent(out) :: rows(:, :), drift(:)  !! \(A\), \(b\)

        rows = hyperdual_t()
        drift = hyperdual_t()
    end subroutine no_constraint_rows

    pure function all_free(self, t, q) result(free)
        !! Which velocities the constraints leave free; the others follow from them: here none.
        class(system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof)  !! time, s; coordinates
        logical :: free(self%ndof)

        free = .true.
    end function all_free

    pure subroutine all_velocities(self, t, q, given, v, error)
        !! All velocities from those that a scene gives: here every one must be given.
        class(system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), given(:) !! s; coordinates; a scene's velocities
        real(dp), intent(out) :: v(self%ndof)             !! all of them
        type(error_t), allocatable, intent(out) :: error  !! status 2: how many, or not allowed

        if (size(given) == self%ndof) then
            v = given
        else
            v = 0.0_dp
            call fail(error, "v takes "//counted(self%ndof, "value")//", not "// &
                      to_text(size(given)))
        end if
    end subroutine all_velocities

    pure subroutine any_place(self, t, q, error)
        !! Refuse coordinates that are not on the holonomic constraints beside L: here there are
        !! none.
        class(system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(:)                   !! time, s; coordinates, (ndof)
        type(error_t), allocatable, intent(out) :: error  !! status 2: which one, and what keeps it
    end subroutine any_place

    pure subroutine nothing_to_keep(self, t, q, v)
        !! Put a state that a step has made back onto the constraints beside L, the shortest way in
        !! the metric of T: methods do it after each step and keep their order (Hairer, Lubich &
        !! Wanner, sec. IV.4). Whoever has this sets `is_projected`. Here nothing is done.
        class(system_t), intent(in) :: self
        real(dp), intent(in) :: t                              !! s
        real(dp), intent(inout) :: q(self%ndof), v(self%ndof)  !! coordinates, velocities
    end subroutine nothing_to_keep

    pure subroutine no_angles(self, t, q, phi)
        !! The angles, rad, of the rotors in the description: here none.
        class(system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(:)  !! time, s; coordinates, (ndof)
        type(hyperdual_t), intent(out) :: phi(:)  !! (rotors)

        phi = hyperdual_t()
    end subroutine no_angles

    pure subroutine no_newton(self, t, x, u, force, constraint_residual)
        !! Newton's equations, without L and generalised coordinates: here there are none.
        !!
        !! The Cartesian coordinates are three of each point of the description, then one angle of
        !! each rotor, whose "mass" is its moment of inertia. With reactions \(\lambda_k\) and
        !! residuals \(f_k\) of zero, \(m_i\ddot x_i = F_i + \sum_k\lambda_k\,\partial f_k/\partial
        !! x_i\). First come \(f_k(t, x)\), then the `constraints` non-holonomic ones, linear in
        !! \(u\), with \(\partial f_k/\partial u_i\) instead. A residual in m has a reaction in N.
        class(system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, x(:), u(:)  !! s; coordinates, m or rad; their rates
        real(dp), intent(out) :: force(:)  !! applied, as many as `x`: N, or N m on an angle
        type(hyperdual_t), intent(out) :: constraint_residual(:)  !! (reactions), zero

        force = 0.0_dp
        constraint_residual = hyperdual_t()
    end subroutine no_newton

    pure function no_gap(self, i, t, q, v) result(value)
        !! Unilateral constraint `i` is \(gap \ge 0\): where the gap falls through zero there is
        !! an impact. Here there are none.
        class(system_t), intent(in) :: self
        integer, intent(in) :: i                               !! from 1 to `contacts`
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)  !! time, s; state
        real(dp) :: value

        value = 1.0_dp
    end function no_gap

    pure subroutine no_impact(self, i, t, q, v)
        !! What happens where gap `i` falls through zero: velocities jump, and the coordinates are
        !! set onto the constraint, which rounding may have missed. A system that would go on to
        !! meet it ever sooner must stay there, with accelerations that hold it.
        class(system_t), intent(in) :: self
        integer, intent(in) :: i   !! from 1 to `contacts`
        real(dp), intent(in) :: t  !! of the impact, s
        real(dp), intent(inout) :: q(self%ndof), v(self%ndof)  !! before it; becomes that after it
    end subroutine no_impact

    subroutine not_reduced(self, reduced)
        !! The same without its cyclic coordinate; not allocated if none is known. Generalised
        !! forces on the others stay.
        class(system_t), intent(in) :: self
        class(reduced_t), allocatable, intent(out) :: reduced  !! of one coordinate less, configured
    end subroutine not_reduced

    subroutine no_closed_form(self, t0, q0, v0, reference)
        !! The closed form of the motion through a state; not allocated where none is known. With
        !! it come the column `error`, the method `exact`, and `auto` takes it. An extension that
        !! changes the equations of motion must give its own, or leave `reference` unallocated.
        class(system_t), intent(in) :: self
        real(dp), intent(in) :: t0              !! s
        real(dp), intent(in) :: q0(:), v0(:)    !! coordinates and velocities at `t0`, `(ndof)`
        class(reference_t), allocatable, intent(out) :: reference  !! goes through that state
    end subroutine no_closed_form

    pure subroutine check_state(self, q, v, error)
        !! Fails for a system that was never configured, and for arrays of another size.
        class(system_t), intent(in) :: self           !! whose they are to be
        real(dp), intent(in) :: q(:), v(:)                !! to be coordinates and velocities
        type(error_t), allocatable, intent(out) :: error  !! status 2

        if (self%ndof < 1) then
            call fail(error, "the system has no coordinates: configure it first")
        else if (size(q) /= self%ndof) then
            call fail(error, "q has "//counted(size(q), "value")//"; the system has "// &
                      counted(self%ndof, "coordinate"), key="q")
        else if (size(v) /= self%ndof) then
            call fail(error, "v has "//counted(size(v), "value")//"; the system has "// &
                      to_text(self%ndof)//trim(merge(" velocity  ", " velocities", &
                                                     self%ndof == 1)), key="v")
        end if
    end subroutine check_state

    pure subroutine check_parameters(self, values, error)
        !! Refuse `values` that are too many, too few or outside their domains.
        class(system_t), intent(in) :: self  !! says what is allowed
        real(dp), intent(in) :: values(:)    !! in the order of `describe`
        type(error_t), allocatable, intent(out) :: error  !! status 2: of which system, which one
        type(description_t) :: d
        integer :: i, first

        call self%describe(d)
        if (size(values) /= sum(d%parameters%count)) then
            call fail(error, trim(d%name)//": takes "//to_text(sum(d%parameters%count))// &
                      " parameter values, not "//to_text(size(values)))
            return
        end if
        do i = 1, size(d%parameters)
            first = 1 + sum(d%parameters(:i - 1)%count)
            associate (p => d%parameters(i))
                p%value(:p%count) = values(first:first + p%count - 1)
            end associate
            call check_parameter(d%parameters(i), error)
            if (allocated(error)) call error%add_context(trim(d%name))
            if (allocated(error)) return
        end do
    end subroutine check_parameters
end module lagrangia_system
