module lagrangia_canonical
    !! Implicit symplectic methods of order 2 for any Lagrangian system, in coordinates and momenta.
    !!
    !! A mass matrix that depends on the coordinates couples them: \(H(q, p)\) does not separate,
    !! and a method that is symplectic in \((q, p)\) is not so in \((q, v)\). With
    !! \(\partial H/\partial p = v(q, p)\) and
    !! \(-\partial H/\partial q = \partial L/\partial q = f(q, v)\) a step needs only the system's
    !! `momenta`, `velocities` and `forces`. Each step starts from \((q, v)\) and ends there, so
    !! that nothing is carried from step to step. Generalised forces \(Q(t, q, v)\) add to \(f\):
    !! the step stays symmetric and of order 2; their motion is no canonical map.
    !!
    !! The equations of a step are solved by iteration until rounding stops the progress.
    !! Source: Hairer, Lubich & Wanner, *Geometric Numerical Integration*, 2nd ed., secs. VI.3,
    !! VI.4 (Theorem 3.4; midpoint rule) and VIII.6.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_errors, only: error_t, fail
    use lagrangia_generalised_forces, only: momentum_rates
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: midpoint_t, new_midpoint, stormer_verlet_t, new_stormer_verlet

    integer, parameter :: most_iterations = 100
    real(dp), parameter :: near = 1e-10_dp  !! relative change below which only rounding is left

    type, abstract, extends(integrator_t) :: canonical_t
        private
        real(dp), allocatable :: p(:)       !! momenta at the start of the step, then at its end
        real(dp), allocatable :: p_mid(:)   !! within the step
        real(dp), allocatable :: x(:)       !! coordinates within the step
        real(dp), allocatable :: u(:), f(:) !! velocities and forces there
        real(dp), allocatable :: u1(:)      !! velocities at the start
        real(dp), allocatable :: next(:)    !! iterate
        real(dp), allocatable :: size_of(:) !! what a change of it is compared with
    contains
        procedure :: prepare
        procedure :: advance
        procedure(step_i), deferred, private :: step
    end type canonical_t

    type, extends(canonical_t) :: stormer_verlet_t
        !! \(p_{1/2} = p_0 + \tfrac h2 f(q_0, p_{1/2})\),
        !! \(q_1 = q_0 + \tfrac h2[v(q_0, p_{1/2}) + v(q_1, p_{1/2})]\),
        !! \(p_1 = p_{1/2} + \tfrac h2 f(q_1, p_{1/2})\).
    contains
        procedure, private :: step => stormer_verlet_step
    end type stormer_verlet_t

    type, extends(canonical_t) :: midpoint_t
        !! \(Q = q_0 + \tfrac h2 v(Q, P)\), \(P = p_0 + \tfrac h2 f(Q, P)\), and as much again.
    contains
        procedure, private :: step => midpoint_step
    end type midpoint_t

    type :: progress_t
        !! Of an iteration: the relative size of its latest change.
        real(dp) :: change = huge(1.0_dp)
        integer :: count = 0
    contains
        procedure :: judge
    end type progress_t

    abstract interface
        pure subroutine step_i(self, system, t, h, q, solved)
            !! From `q` and `self%p` at `t` to those at `t + h`; `self%u` is a guess.
            import :: canonical_t, system_t, dp
            implicit none (type, external)
            class(canonical_t), intent(inout) :: self
            class(system_t), intent(in) :: system
            real(dp), intent(in) :: t, h
            real(dp), intent(inout) :: q(system%ndof)
            logical, intent(out) :: solved
        end subroutine step_i
    end interface

contains

    pure subroutine new_stormer_verlet(self)
        !! For every system with a Hamiltonian.
        type(stormer_verlet_t), intent(out) :: self  !! not yet prepared

        self%name = "stormer_verlet"
        self%title = "generalised Stormer-Verlet in (q, p), implicit (de Vogelaere 1956)"
        self%order = 2
        self%step_limit = 2.0_dp
        self%energy_order = 2
        self%symplectic = .true.
        self%reversible = .true.
    end subroutine new_stormer_verlet

    pure subroutine new_midpoint(self)
        !! For every system with a Hamiltonian.
        type(midpoint_t), intent(out) :: self  !! not yet prepared

        self%name = "midpoint"
        self%title = "implicit midpoint rule in (q, p) (Feng 1985)"
        self%order = 2
        self%keeps_speed = .true.  ! as it keeps every quadratic invariant
        self%energy_order = 2
        self%symplectic = .true.
        self%reversible = .true.
    end subroutine new_midpoint

    pure subroutine prepare(self, system, error)
        !! Refuses constraints beside L: their motion does not follow from a Hamiltonian.
        class(canonical_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: state(system%ndof)

        if (system%constraints > 0) then
            call fail(error, trim(self%name)//" is for systems with a Hamiltonian, and here "// &
                      "there are constraints beside L", key="method")
            return
        end if
        state = 0.0_dp
        self%coordinates = system%ndof
        self%evaluations = 0
        self%failure_reason = ""
        self%p = state
        self%p_mid = state
        self%x = state
        self%u = state
        self%f = state
        self%u1 = state
        self%next = state
        self%size_of = state
    end subroutine prepare

    pure subroutine advance(self, system, t0, dt, first, steps, q, v)
        !! See `integrator_t`. Nothing is carried between steps.
        class(canonical_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        real(dp) :: t
        logical :: solved
        integer(i8) :: k
        logical :: refused

        call self%refuse_system(system, refused, q, v)
        if (refused) return
        do k = first, first + steps - 1
            t = t0 + k*dt
            call system%momenta(t, q, v, self%p)
            self%u = v
            call self%step(system, t, dt, q, solved)
            if (.not. solved) then
                if (self%failure_reason == "") self%failure_reason = &
                    "the equations of the step at t = "//to_text(t)// &
                    " s did not converge; a shorter dt is needed"
                q = ieee_value(q, ieee_quiet_nan)
                v = q
                return
            end if
            call system%velocities(t + dt, q, self%p, v)
        end do
    end subroutine advance

    pure subroutine stormer_verlet_step(self, system, t, h, q, solved)
        !! Two implicit equations, one after the other, and an explicit one.
        class(stormer_verlet_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, h
        real(dp), intent(inout) :: q(system%ndof)
        logical, intent(out) :: solved
        type(progress_t) :: progress
        real(dp) :: half
        logical :: done

        half = 0.5_dp*h
        self%p_mid = self%p
        do
            call momentum_rates(system, t, q, self%u, self%f)
            self%next = self%p + half*self%f
            self%size_of = abs(self%p) + abs(half*self%f)
            call progress%judge(self%next, self%p_mid, self%size_of, done, solved)
            self%p_mid = self%next
            call system%velocities(t, q, self%p_mid, self%u)
            if (done) exit
        end do
        self%evaluations = self%evaluations + progress%count + 1
        if (.not. solved) return

        self%u1 = self%u
        self%x = q
        progress = progress_t()
        do
            self%next = q + half*(self%u1 + self%u)
            self%size_of = abs(q) + abs(half*self%u)
            call progress%judge(self%next, self%x, self%size_of, done, solved)
            self%x = self%next
            call system%velocities(t + h, self%x, self%p_mid, self%u)
            if (done) exit
        end do
        q = self%x
        call momentum_rates(system, t + h, q, self%u, self%f)
        self%p = self%p_mid + half*self%f
    end subroutine stormer_verlet_step

    pure subroutine midpoint_step(self, system, t, h, q, solved)
        !! One implicit equation for the state in the middle.
        class(midpoint_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, h
        real(dp), intent(inout) :: q(system%ndof)
        logical, intent(out) :: solved
        type(progress_t) :: progress, progress_p
        real(dp) :: half
        logical :: done, done_p, solved_p

        half = 0.5_dp*h
        self%x = q
        self%p_mid = self%p
        do
            self%next = q + half*self%u
            self%size_of = abs(q) + abs(half*self%u)
            call progress%judge(self%next, self%x, self%size_of, done, solved)
            self%x = self%next
            call momentum_rates(system, t + half, self%x, self%u, self%f)
            self%next = self%p + half*self%f
            self%size_of = abs(self%p) + abs(half*self%f)
            call progress_p%judge(self%next, self%p_mid, self%size_of, done_p, solved_p)
            self%p_mid = self%next
            call system%velocities(t + half, self%x, self%p_mid, self%u)
            if (done .and. done_p) exit
        end do
        self%evaluations = self%evaluations + progress%count
        solved = solved .and. solved_p
        q = q + h*self%u
        self%p = self%p + h*self%f
    end subroutine midpoint_step

    pure subroutine judge(self, new, old, scale, done, solved)
        !! Done when nothing changes any more, or changes are small and no longer shrink.
        class(progress_t), intent(inout) :: self
        real(dp), intent(in) :: new(:), old(:), scale(:)
        logical, intent(out) :: done, solved
        real(dp) :: change

        change = maxval(abs(new - old)/(scale + tiny(1.0_dp)))
        self%count = self%count + 1
        solved = change <= near
        done = change <= 0.0_dp .or. (solved .and. change >= self%change) &
               .or. self%count >= most_iterations .or. .not. change <= huge(change)
        self%change = change
    end subroutine judge
end module lagrangia_canonical
