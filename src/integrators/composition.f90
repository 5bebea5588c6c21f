module lagrangia_composition
    !! Symmetric splitting methods: symplectic, time-reversible, for forces of positions only.
    !!
    !! A method is a row of drifts and kicks, fractions of the step: most are Verlet steps by
    !! fractions \(\gamma_s\), \(\sum\gamma_s = 1\), each drift, kick, drift in the position form
    !! and kick, drift, kick in the velocity form. Source: Hairer, Lubich & Wanner, *Geometric
    !! Numerical Integration*, 2nd ed., secs. I.1.4, V.3; compensated sums: sec. VIII.5.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_composition_table, only: nth_row, round_row, row_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_integrator, only: integrator_t, not_started
    use lagrangia_kinds, only: dp, i8
    use lagrangia_summation, only: add, add_pair
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: nth_composition

    type, abstract, extends(integrator_t) :: composition_t
        private
        integer :: row = 0                          !! of the table
        real(dp), allocatable :: drift(:), kick(:)  !! fractions of the step
        real(dp), allocatable :: node(:)            !! of the evaluations, fractions of the step
        real(dp), allocatable :: a(:)
        real(dp), allocatable :: q_low(:), v_low(:) !! what did not fit into q and v
    contains
        procedure :: prepare
        procedure :: start
    end type composition_t

    type, extends(composition_t) :: position_form_t
        !! Drift, kick, drift. On the oscillator the single step conserves
        !! \((1-\omega^2h^2/4)\,v^2 + \omega^2x^2\) and is stable for \(\omega h < 2\).
    contains
        procedure :: advance => advance_positions
        procedure :: compensated => compensate_positions
    end type position_form_t

    type, extends(composition_t) :: velocity_form_t
        !! Kick, drift, kick. The last evaluation of a step is the first of the next one.
    contains
        procedure :: start => start_velocities
        procedure :: advance => advance_velocities
        procedure :: compensated => compensate_velocities
    end type velocity_form_t

    type, extends(position_form_t) :: compensated_positions_t
        !! The same with compensated sums.
    contains
        procedure :: advance => advance_positions_compensated
    end type compensated_positions_t

    type, extends(velocity_form_t) :: compensated_velocities_t
        !! The same with compensated sums.
    contains
        procedure :: advance => advance_velocities_compensated
    end type compensated_velocities_t

contains

    subroutine nth_composition(i, method)
        !! Row `i` of the table as a method; not allocated beyond its end.
        integer, intent(in) :: i  !! from 1
        class(integrator_t), allocatable, intent(out) :: method  !! not yet prepared
        type(position_form_t) :: positions
        type(velocity_form_t) :: velocities
        type(row_t) :: row

        call nth_row(i, row)
        if (row%order == 0) return
        if (row%kick_first) then
            call set_row(velocities, i)
            allocate (method, source=velocities)
        else
            call set_row(positions, i)
            allocate (method, source=positions)
        end if
    end subroutine nth_composition

    subroutine compensate_positions(self, variant)
        !! See `integrator_t`.
        class(position_form_t), intent(in) :: self
        class(integrator_t), allocatable, intent(out) :: variant
        type(compensated_positions_t) :: method

        call set_row(method, self%row)
        allocate (variant, source=method)
    end subroutine compensate_positions

    subroutine compensate_velocities(self, variant)
        !! See `integrator_t`.
        class(velocity_form_t), intent(in) :: self
        class(integrator_t), allocatable, intent(out) :: variant
        type(compensated_velocities_t) :: method

        call set_row(method, self%row)
        allocate (variant, source=method)
    end subroutine compensate_velocities

    pure subroutine set_row(self, i)
        !! The row, rounded.
        class(composition_t), intent(inout) :: self
        integer, intent(in) :: i
        type(row_t) :: row

        call nth_row(i, row)
        self%row = i
        self%name = row%name
        self%title = row%title
        self%order = row%order
        self%energy_order = row%order
        self%step_limit = row%step_limit
        self%symplectic = .true.
        self%reversible = .true.
        call round_row(row, self%drift, self%kick, self%node)
    end subroutine set_row

    pure subroutine prepare(self, system, error)
        !! Refuses forces that depend on the velocities: there the order would drop to one.
        class(composition_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: state(system%ndof)

        if (system%velocity_forces) then
            call fail(error, trim(self%name)//" is for forces that depend on positions only, "// &
                      "and here they depend on velocities", key="method")
            return
        end if
        state = 0.0_dp
        self%coordinates = system%ndof
        self%evaluations = 0
        self%q_low = state
        self%v_low = state
        state = ieee_value(state, ieee_quiet_nan)
        self%a = state
        self%failure_reason = not_started
    end subroutine prepare

    pure subroutine start(self, system, t0, q, v, t_end)
        !! See `integrator_t`. Nothing is known yet of what rounding took from the state.
        class(composition_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0
        real(dp), intent(in) :: q(system%ndof), v(system%ndof)
        real(dp), intent(in), optional :: t_end
        logical :: refused

        call self%refuse_system(system, refused)
        if (refused) return
        self%failure_reason = ""
        self%q_low(:) = 0.0_dp
        self%v_low(:) = 0.0_dp
    end subroutine start

    pure subroutine start_velocities(self, system, t0, q, v, t_end)
        !! See `integrator_t`. The first kick needs the accelerations.
        class(velocity_form_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0
        real(dp), intent(in) :: q(system%ndof), v(system%ndof)
        real(dp), intent(in), optional :: t_end

        call start(self, system, t0, q, v)
        if (self%failure_reason /= "") return
        call system%accelerations(t0, q, v, self%a)
        self%evaluations = self%evaluations + 1
    end subroutine start_velocities

    pure subroutine advance_positions(self, system, t0, dt, first, steps, q, v)
        !! See `integrator_t`. Nothing is kept from step to step.
        class(position_form_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        real(dp) :: t
        integer(i8) :: k
        integer :: s, stages
        logical :: refused

        call self%refuse_system(system, refused, q, v)
        if (refused) return
        stages = size(self%kick)
        do k = first, first + steps - 1
            t = t0 + k*dt
            do s = 1, stages
                q = q + self%drift(s)*dt*v
                call system%accelerations(t + self%node(s)*dt, q, v, self%a)
                v = v + self%kick(s)*dt*self%a
            end do
            q = q + self%drift(stages + 1)*dt*v
        end do
        self%evaluations = self%evaluations + steps*stages
    end subroutine advance_positions

    pure subroutine advance_velocities(self, system, t0, dt, first, steps, q, v)
        !! See `integrator_t`. Kept from step to step: the accelerations at its end.
        class(velocity_form_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        real(dp) :: t
        integer(i8) :: k
        integer :: s, stages
        logical :: refused

        call self%refuse_system(system, refused, q, v)
        if (refused) return
        stages = size(self%drift)
        do k = first, first + steps - 1
            t = t0 + k*dt
            do s = 1, stages - 1
                v = v + self%kick(s)*dt*self%a
                q = q + self%drift(s)*dt*v
                call system%accelerations(t + self%node(s)*dt, q, v, self%a)
            end do
            v = v + self%kick(stages)*dt*self%a
            q = q + self%drift(stages)*dt*v
            call system%accelerations(t0 + (k + 1)*dt, q, v, self%a)
            v = v + self%kick(stages + 1)*dt*self%a
        end do
        self%evaluations = self%evaluations + steps*stages
    end subroutine advance_velocities

    pure subroutine advance_positions_compensated(self, system, t0, dt, first, steps, q, v)
        !! See `integrator_t`. Kept from step to step: the low parts of the state.
        class(compensated_positions_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        real(dp) :: t
        integer(i8) :: k
        integer :: s, stages
        logical :: refused

        call self%refuse_system(system, refused, q, v)
        if (refused) return
        stages = size(self%kick)
        do k = first, first + steps - 1
            t = t0 + k*dt
            do s = 1, stages
                call add_pair(q, self%q_low, self%drift(s)*dt*v, self%drift(s)*dt*self%v_low)
                call system%accelerations(t + self%node(s)*dt, q, v, self%a)
                call add(v, self%v_low, self%kick(s)*dt*self%a)
            end do
            call add_pair(q, self%q_low, self%drift(stages + 1)*dt*v, &
                          self%drift(stages + 1)*dt*self%v_low)
        end do
        self%evaluations = self%evaluations + steps*stages
    end subroutine advance_positions_compensated

    pure subroutine advance_velocities_compensated(self, system, t0, dt, first, steps, q, v)
        !! See `integrator_t`. Kept from step to step: accelerations and low parts.
        class(compensated_velocities_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        real(dp) :: t
        integer(i8) :: k
        integer :: s, stages
        logical :: refused

        call self%refuse_system(system, refused, q, v)
        if (refused) return
        stages = size(self%drift)
        do k = first, first + steps - 1
            t = t0 + k*dt
            do s = 1, stages - 1
                call add(v, self%v_low, self%kick(s)*dt*self%a)
                call add_pair(q, self%q_low, self%drift(s)*dt*v, self%drift(s)*dt*self%v_low)
                call system%accelerations(t + self%node(s)*dt, q, v, self%a)
            end do
            call add(v, self%v_low, self%kick(stages)*dt*self%a)
            call add_pair(q, self%q_low, self%drift(stages)*dt*v, &
                          self%drift(stages)*dt*self%v_low)
            call system%accelerations(t0 + (k + 1)*dt, q, v, self%a)
            call add(v, self%v_low, self%kick(stages + 1)*dt*self%a)
        end do
        self%evaluations = self%evaluations + steps*stages
    end subroutine advance_velocities_compensated
end module lagrangia_composition
