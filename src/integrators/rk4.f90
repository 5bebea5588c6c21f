module lagrangia_rk4
    !! The classical fourth-order Runge-Kutta method.
    !!
    !! Source: Kutta (1901); Hairer, Nørsett & Wanner, *Solving Ordinary Differential
    !! Equations I*, 2nd ed., table II.1.2. On the oscillator it is stable for
    !! \(\omega h \le 2\sqrt2\) and loses energy as \((\omega h)^6/72\) a step.
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_step_ends, only: end_step
    use lagrangia_summation, only: add, add_pair
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: rk4_t, new_rk4

    type, extends(integrator_t) :: rk4_t
        private
        real(dp), allocatable :: q(:)                     !! coordinates of a stage
        real(dp), allocatable :: v2(:), v3(:), v4(:)      !! velocities of the stages
        real(dp), allocatable :: a1(:), a2(:), a3(:), a4(:)
        real(dp), allocatable :: q_old(:), v_old(:)       !! state before a step with constraints
    contains
        procedure :: prepare
        procedure :: advance
        procedure :: compensated
    end type rk4_t

    type, extends(rk4_t) :: compensated_rk4_t
        !! The same with compensated sums (Hairer, Lubich & Wanner, sec. VIII.5): the state is
        !! `q + q_low`, `v + v_low`.
        private
        real(dp), allocatable :: q_low(:), v_low(:)
    contains
        procedure :: prepare => prepare_compensated
        procedure :: start => start_compensated
        procedure :: advance => advance_compensated
    end type compensated_rk4_t

contains

    pure subroutine new_rk4(self)
        !! Any system will do.
        type(rk4_t), intent(out) :: self  !! not yet prepared

        call set_up(self)
    end subroutine new_rk4

    pure subroutine set_up(self)
        !! Its name and order, for both variants.
        class(rk4_t), intent(inout) :: self

        self%name = "rk4"
        self%title = "classical Runge-Kutta, any system (Kutta 1901)"
        self%order = 4
        self%step_limit = sqrt(8.0_dp)
    end subroutine set_up

    subroutine compensated(self, variant)
        !! See `integrator_t`.
        class(rk4_t), intent(in) :: self
        class(integrator_t), allocatable, intent(out) :: variant
        type(compensated_rk4_t) :: method

        call set_up(method)
        allocate (variant, source=method)
    end subroutine compensated

    pure subroutine prepare(self, system, error)
        !! Never fails.
        class(rk4_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: state(system%ndof)

        state = 0.0_dp
        self%coordinates = system%ndof
        self%evaluations = 0
        self%q = state
        self%v2 = state
        self%v3 = state
        self%v4 = state
        self%a1 = state
        self%a2 = state
        self%a3 = state
        self%a4 = state
        self%q_old = state
        self%v_old = state
    end subroutine prepare

    pure subroutine prepare_compensated(self, system, error)
        !! Never fails.
        class(compensated_rk4_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error

        call self%rk4_t%prepare(system, error)
        self%q_low = self%q
        self%v_low = self%q
    end subroutine prepare_compensated

    pure subroutine start_compensated(self, system, t0, q, v, t_end)
        !! See `integrator_t`. Nothing is known yet of what rounding took from the state.
        class(compensated_rk4_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0
        real(dp), intent(in) :: q(system%ndof), v(system%ndof)
        real(dp), intent(in), optional :: t_end
        logical :: refused

        call self%refuse_system(system, refused)
        if (refused) return
        call self%rk4_t%start(system, t0, q, v, t_end)
        self%q_low(:) = 0.0_dp
        self%v_low(:) = 0.0_dp
    end subroutine start_compensated

    pure subroutine stages(self, system, t, dt, q, v)
        !! The accelerations and velocities of the four stages; those of the first are `v`.
        class(rk4_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, dt, q(system%ndof), v(system%ndof)
        real(dp) :: half

        half = 0.5_dp*dt
        call system%accelerations(t, q, v, self%a1)
        call move(system%ndof, q, v, half, v, self%a1, self%q, self%v2)
        call system%accelerations(t + half, self%q, self%v2, self%a2)
        call move(system%ndof, q, v, half, self%v2, self%a2, self%q, self%v3)
        call system%accelerations(t + half, self%q, self%v3, self%a3)
        call move(system%ndof, q, v, dt, self%v3, self%a3, self%q, self%v4)
        call system%accelerations(t + dt, self%q, self%v4, self%a4)
    end subroutine stages

    pure subroutine move(n, q, v, h, q_dot, v_dot, q_new, v_new)
        !! From `(q, v)` along a slope, for a time `h`. A few numbers: not worth a vector.
        integer, intent(in) :: n
        real(dp), intent(in) :: q(n), v(n), h, q_dot(n), v_dot(n)
        real(dp), intent(out) :: q_new(n), v_new(n)
        integer :: i

        !GCC$ novector
        do i = 1, n
            q_new(i) = q(i) + h*q_dot(i)
            v_new(i) = v(i) + h*v_dot(i)
        end do
    end subroutine move

    pure subroutine finish(n, sixth, k1, k2, k3, k4, y)
        !! Add the weighted slopes of the stages.
        integer, intent(in) :: n
        real(dp), intent(in) :: sixth, k1(n), k2(n), k3(n), k4(n)
        real(dp), intent(inout) :: y(n)
        integer :: i

        !GCC$ novector
        do i = 1, n
            y(i) = y(i) + sixth*(k1(i) + 2.0_dp*(k2(i) + k3(i)) + k4(i))
        end do
    end subroutine finish

    pure subroutine advance(self, system, t0, dt, first, steps, q, v)
        !! See `integrator_t`. Nothing is kept from step to step.
        class(rk4_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        integer(i8) :: k
        logical :: refused

        call self%refuse_system(system, refused, q, v)
        if (refused) return
        do k = first, first + steps - 1
            if (system%is_projected) then
                self%q_old(:) = q
                self%v_old(:) = v
            end if
            call stages(self, system, t0 + k*dt, dt, q, v)
            call finish(system%ndof, dt/6.0_dp, v, self%v2, self%v3, self%v4, q)
            call finish(system%ndof, dt/6.0_dp, self%a1, self%a2, self%a3, self%a4, v)
            if (system%is_projected) call end_step(system, t0 + k*dt, self%q_old, self%v_old, &
                                                   t0 + (k + 1)*dt, q, v, self%failure_reason)
        end do
        self%evaluations = self%evaluations + 4*steps
    end subroutine advance

    pure subroutine advance_compensated(self, system, t0, dt, first, steps, q, v)
        !! See `integrator_t`. Kept from step to step: the low parts of the state.
        class(compensated_rk4_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        integer(i8) :: k
        logical :: refused

        call self%refuse_system(system, refused, q, v)
        if (refused) return
        do k = first, first + steps - 1
            if (system%is_projected) then
                self%q_old(:) = q
                self%v_old(:) = v
            end if
            call stages(self, system, t0 + k*dt, dt, q, v)
            call add_pair(q, self%q_low, dt/6.0_dp*(v + 2.0_dp*(self%v2 + self%v3) + self%v4), &
                          dt*self%v_low)
            call add(v, self%v_low, dt/6.0_dp*(self%a1 + 2.0_dp*(self%a2 + self%a3) + self%a4))
            if (system%is_projected) call end_step(system, t0 + k*dt, self%q_old, self%v_old, &
                                                   t0 + (k + 1)*dt, q, v, self%failure_reason)
        end do
        self%evaluations = self%evaluations + 4*steps
    end subroutine advance_compensated
end module lagrangia_rk4
