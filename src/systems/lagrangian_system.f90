module lagrangia_lagrangian_system
    !! A system of which only the Lagrangian is known: bring your own.
    !!
    !! Extend `lagrangian_system_t` by `outline` (its name, coordinates, parameters) and by
    !! `lagrangian`. Accelerations and energy then come from exact derivatives of L, slower than
    !! formulae written by hand: see `docs/your_own_system.md`. What integrators must know of its
    !! structure is found by trying. Formulae by hand may be added later, one by one, as the
    !! bindings of `system_t`: the audit checks them against L.
    !!
    !! L must be of degree two in the velocities, its mass matrix positive definite. Forces that L
    !! lacks are in `generalised_forces`.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_bound_system, only: bound_system_t
    use lagrangia_description, only: description_t
    use lagrangia_elimination, only: solve_positive
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian, energy_from_lagrangian, &
                                  euler_lagrange_t, expand_lagrangian
    use lagrangia_number_class, only: all_finite, is_nonzero, is_zero
    use lagrangia_place_functions, only: place_functions_t
    use lagrangia_system, only: check_parameters
    use lagrangia_time_functions, only: time_functions_t
    implicit none (type, external)
    private
    public :: lagrangian_system_t
    public :: find_structure, is_spare, last_state, near_states, trial_state

    type, abstract, extends(bound_system_t) :: lagrangian_system_t
        real(dp), allocatable :: p(:)  !! the parameters, in the order of `describe`
        logical, allocatable :: cyclic_coordinates(:)  !! all that are cyclic with them, (ndof)
        logical :: told_by_formulas = .false.  !! what acts may act far away, for a moment
        type(time_functions_t) :: time_functions    !! of its formulas, if it has any
        type(place_functions_t) :: place_functions  !! also of these
    contains
        procedure(outline_i), deferred :: outline
        procedure :: value
        procedure :: describe
        procedure :: configure
        procedure :: prepare => nothing_to_prepare
        procedure :: accelerations
        procedure :: energy
        procedure :: find_structure
    end type lagrangian_system_t

    abstract interface
        pure subroutine outline_i(self, d)
            !! What `describe` must say: at least name, title and coordinates; parameters, if
            !! there are any, with their defaults.
            import :: lagrangian_system_t, description_t
            implicit none (type, external)
            class(lagrangian_system_t), intent(in) :: self
            type(description_t), intent(out) :: d  !! as far as you fill it in
        end subroutine outline_i
    end interface

    integer, parameter :: near_states = 60, enough = 4  !! near the origin; so many will do
    integer, parameter :: last_state = near_states + 4  !! the others are far away and late

contains

    pure function value(self, i, default)
        !! Value `i` of the parameters, for what `outline` makes of them (the mass of a point,
        !! the scale of a drift); the default as long as none was given.
        class(lagrangian_system_t), intent(in) :: self
        integer, intent(in) :: i  !! in the order of `outline`; of a vector each component counts
        real(dp), intent(in) :: default  !! that of `outline`
        real(dp) :: value

        value = default
        if (allocated(self%p)) value = self%p(i)
    end function value

    pure subroutine describe(self, d)
        !! The outline with the parameters in it, and something for all that it leaves out.
        class(lagrangian_system_t), intent(in) :: self
        type(description_t), intent(out) :: d
        integer :: i, first

        call self%outline(d)
        if (.not. allocated(d%parameters)) allocate (d%parameters(0))
        if (.not. allocated(d%quantities)) allocate (d%quantities(0))
        if (.not. allocated(d%points)) allocate (d%points(0))
        if (.not. allocated(d%notes)) allocate (d%notes(0))
        if (.not. allocated(d%equations)) allocate (d%equations(0))
        if (d%constraint == "") d%constraint = "in the choice of coordinates, if any"
        if (d%source == "") d%source = "your own"
        if (.not. allocated(self%p)) return
        first = 1
        do i = 1, size(d%parameters)
            associate (p => d%parameters(i))
                p%value(:p%count) = self%p(first:first + p%count - 1)
                first = first + p%count
            end associate
        end do
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! Keep the parameters, if the description allows them, and find out about the structure.
        class(lagrangian_system_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error
        type(description_t) :: d

        call check_parameters(self, values, error)
        if (allocated(error)) return
        self%p = values
        call self%describe(d)
        self%ndof = size(d%coordinates)
        call self%prepare()
        call self%find_structure()
    end subroutine configure

    pure subroutine nothing_to_prepare(self)
        !! What else follows from the parameters, before `find_structure`: here nothing does.
        class(lagrangian_system_t), intent(inout) :: self
    end subroutine nothing_to_prepare

    pure subroutine find_structure(self)
        !! Whether accelerations depend on the velocities, whether L or a generalised force depends
        !! on the time, whether there is such a force and whether it works, and which coordinates
        !! are cyclic, from the states of `trial_state` at which L is finite. Without any, L counts
        !! as dependent on everything.
        class(lagrangian_system_t), intent(inout) :: self
        type(euler_lagrange_t) :: terms
        real(dp), dimension(self%ndof) :: q, v, a, b
        logical :: cyclic(self%ndof), moves, acted
        type(hyperdual_t) :: tt, qq(self%ndof), vv(self%ndof), beside(self%ndof)
        real(dp) :: t
        integer :: k, used

        self%velocity_forces = .false.
        self%time_dependent = .false.
        self%nonconservative = .true.
        self%timeless_lagrangian = .true.
        self%workless = .true.
        acted = .false.
        cyclic = .true.
        moves = .false.
        used = 0
        do k = 1, last_state
            if (is_spare(k, used)) cycle
            call trial_state(k, t, q, v)
            call expand_lagrangian(self, t, q, v, terms)
            if (.not. all_finite([terms%l, terms%dl_dt, terms%dl_dq])) cycle
            cyclic = cyclic .and. is_zero(terms%dl_dq)
            tt = hyperdual_t(re=t, d1=1.0_dp)
            qq%re = q
            vv%re = v
            call self%generalised_forces(tt, qq, vv, beside)
            acted = acted .or. any(is_nonzero(beside%re))
            ! false of NaN, too
            self%workless = self%workless .and. abs(dot_product(beside%re, v)) <= &
                            self%ndof*epsilon(t)*dot_product(abs(beside%re), abs(v))
            cyclic = cyclic .and. is_zero(beside%re)
            self%timeless_lagrangian = self%timeless_lagrangian .and. is_zero(terms%dl_dt)
            self%time_dependent = self%time_dependent .or. is_nonzero(terms%dl_dt) &
                                  .or. any(is_nonzero(beside%d1))
            used = used + 1
            if (self%velocity_forces) cycle
            call self%accelerations(t, q, v, a)
            v = -0.5_dp*v  ! a friction that is always the same turns round, too
            call self%accelerations(t, q, v, b)
            if (.not. all_finite([a, b])) cycle
            moves = .true.
            self%velocity_forces = maxval(abs(a - b)) > 0.0_dp
        end do
        self%nonconservative = acted
        self%workless = self%workless .and. used > 0
        self%timeless_lagrangian = self%timeless_lagrangian .and. used > 0
        if (.not. moves) self%velocity_forces = .true.
        if (used == 0) then
            self%time_dependent = .true.
            cyclic = .false.
        end if
        if (self%constraints > 0) call find_bonds(self, cyclic)
        self%cyclic = findloc(cyclic, .true., 1)
        self%cyclic_coordinates = cyclic
    end subroutine find_structure

    pure subroutine find_bonds(self, cyclic)
        !! What the constraints change, from the states at which they are finite:
        !! accelerations depend on velocities, and a momentum is conserved only where they leave
        !! its coordinate alone. Without any such state they count as dependent on everything.
        class(lagrangian_system_t), intent(inout) :: self
        logical, intent(inout) :: cyclic(:)
        type(hyperdual_t) :: tt, qq(self%ndof), rows(self%constraints, self%ndof)
        type(hyperdual_t) :: drift(self%constraints)
        real(dp) :: q(self%ndof), t, v(self%ndof)
        logical :: moving(self%constraints)
        integer :: i, k, used

        self%velocity_forces = .true.
        self%constraints_work = .false.
        used = 0
        do k = 1, last_state
            if (is_spare(k, used)) cycle
            call trial_state(k, t, q, v)
            tt = hyperdual_t(re=t, d1=1.0_dp)
            qq = hyperdual_t()
            qq%re = q
            call self%constraint_rows(tt, qq, rows, drift)
            if (.not. (all(ieee_is_finite(rows%re)) .and. all(ieee_is_finite(drift%re)))) cycle
            moving = is_nonzero(drift%re)
            self%constraints_work = self%constraints_work .or. any(moving)
            self%time_dependent = self%time_dependent .or. any(is_nonzero(rows%d1)) .or. &
                                  any(is_nonzero(drift%d1))
            if (allocated(self%holonomic)) self%time_dependent = self%time_dependent .or. &
                any(moving .and. self%holonomic)
            do i = 1, self%ndof
                qq(i)%d1 = 1.0_dp
                call self%constraint_rows(hyperdual_t(re=t), qq, rows, drift)
                qq(i)%d1 = 0.0_dp
                if (any(is_nonzero(rows(:, i)%re)) .or. any(is_nonzero(rows%d1)) .or. &
                    any(is_nonzero(drift%d1))) cyclic(i) = .false.
            end do
            used = used + 1
        end do
        if (used > 0) return
        self%time_dependent = .true.
        self%constraints_work = .true.
        cyclic = .false.
    end subroutine find_bonds

    pure function is_spare(k, used) result(yes)
        !! Need state `k` of `trial_state` not be tried, since others near the origin were of use?
        integer, intent(in) :: k, used  !! from 1; how many were
        logical :: yes

        yes = k <= near_states .and. used >= enough
    end function is_spare

    pure subroutine trial_state(k, t, q, v)
        !! One of many states, of which some will do for any Lagrangian: \(|q| \le 0.8^k\). Those
        !! behind `near_states` are for what is 0 near the origin or at first, as a wall or a kick:
        !! \(|q| \le 3\cdot 4^j\), \(t = 14j\) s.
        integer, intent(in) :: k                   !! from 1 to `last_state`
        real(dp), intent(out) :: t, q(:), v(:)     !! time, s; coordinates, velocities
        real(dp) :: size_of_q
        integer :: i

        t = 0.4_dp*k
        size_of_q = 0.8_dp**k
        if (k > near_states) then
            t = 14.0_dp*(k - near_states)
            size_of_q = 3.0_dp*4.0_dp**(k - near_states)
        end if
        q = [(size_of_q*sin(1.3_dp*i + 2.1_dp*k), i=1, size(q))]
        if (mod(k, 2) == 0) q = abs(q)  ! a radius is positive
        v = [(cos(0.7_dp*i + 1.7_dp*k), i=1, size(v))]
    end subroutine trial_state

    pure subroutine accelerations(self, t, q, v, a)
        !! From the Lagrangian; NaN where its mass matrix is singular.
        class(lagrangian_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        type(euler_lagrange_t) :: terms
        type(error_t), allocatable :: error
        real(dp) :: multipliers(self%constraints), least(self%ndof)
        integer :: i

        if (self%constraints > 0) then
            call accelerations_from_lagrangian(self, t, q, v, a, multipliers, error)
            if (allocated(error)) a = ieee_value(a, ieee_quiet_nan)
            return
        end if
        call expand_lagrangian(self, t, q, v, terms)
        a = terms%force
        least = [(2*self%ndof*epsilon(least)*terms%mass(i, i), i=1, self%ndof)]
        call solve_positive(terms%mass, max(0.0_dp, least), a)
    end subroutine accelerations

    pure function energy(self, t, q, v) result(e)
        !! \(\dot q\,\partial L/\partial\dot q - L\).
        class(lagrangian_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = energy_from_lagrangian(self, t, q, v)
    end function energy
end module lagrangia_lagrangian_system
