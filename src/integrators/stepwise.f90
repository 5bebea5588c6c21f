module lagrangia_stepwise
    !! A method of fixed step, made dense: between the ends of a step each coordinate is the
    !! quintic that has their coordinates, velocities and accelerations, right to \(O(h^6)\).
    !! One evaluation a step besides the method's own.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_errors, only: error_t, fail
    use lagrangia_hermite, only: quintic
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: stepwise_t, new_stepwise, whole_steps

    type, extends(dense_integrator_t) :: stepwise_t
        class(integrator_t), allocatable :: method
        real(dp), private :: dt = 0.0_dp
        real(dp), private :: t_start = 0.0_dp    !! steps are counted from here, s
        integer(i8), private :: done = 0         !! since `t_start`
        integer(i8), private :: steps = 0        !! whole ones to `t_end`
        real(dp), private :: rest = 0.0_dp       !! and a shorter one, s; 0 if there is none
        integer(i8), private :: own = 0          !! evaluations for the interpolation
        real(dp), allocatable, private :: q0(:), v0(:), a0(:), q1(:), v1(:), a1(:)
    contains
        procedure :: prepare
        procedure :: start
        procedure :: advance
        procedure :: step
        procedure :: state_at
    end type stepwise_t

contains

    subroutine new_stepwise(self, method, dt)
        !! Steps of `method`, each `dt` long but perhaps for the last.
        type(stepwise_t), intent(out) :: self      !! not yet prepared
        class(integrator_t), intent(in) :: method  !! of fixed step; copied
        real(dp), intent(in) :: dt                 !! s; `prepare` refuses one that is not positive

        allocate (self%method, source=method)
        self%name = method%name
        self%title = method%title
        self%order = method%order
        self%leaves_cyclic = method%leaves_cyclic
        self%dt = dt
    end subroutine new_stepwise

    pure subroutine whole_steps(duration, dt, steps, rest)
        !! A duration in whole steps and a rest. With \(n\) the nearest whole number there is none
        !! where \(|duration/dt - n| \le 8\epsilon\max(1, duration/dt)\): that is rounding.
        real(dp), intent(in) :: duration   !! s
        real(dp), intent(in) :: dt         !! s
        integer(i8), intent(out) :: steps  !! whole ones
        real(dp), intent(out) :: rest      !! s; 0 if there is none
        real(dp) :: count

        count = duration/dt
        steps = nint(count, i8)
        rest = 0.0_dp
        if (abs(count - steps) <= 8.0_dp*epsilon(count)*max(1.0_dp, count)) return
        steps = int(count, i8)
        rest = duration - steps*dt
    end subroutine whole_steps

    pure subroutine prepare(self, system, error)
        !! Refuses a step that leads nowhere, and what the method refuses.
        class(stepwise_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: state(system%ndof)

        if (.not. (self%dt > 0.0_dp .and. self%dt <= huge(self%dt))) then
            call fail(error, "must be positive and finite, not "//to_text(self%dt), key="dt")
        else
            call self%method%prepare(system, error)
        end if
        if (allocated(error)) return
        state = ieee_value(state, ieee_quiet_nan)
        self%q0 = state
        self%v0 = state
        self%a0 = state
        self%q1 = state
        self%v1 = state
        self%a1 = state
        self%coordinates = system%ndof
        self%evaluations = 0
        self%own = 0
        self%accepted = 0
        self%rejected = 0
    end subroutine prepare

    pure subroutine advance(self, system, t0, dt, first, steps, q, v)
        !! The method's own steps.
        class(stepwise_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)

        call self%method%advance(system, t0, dt, first, steps, q, v)
        self%failure_reason = self%method%failure_reason
        self%evaluations = self%method%evaluations + self%own
    end subroutine advance

    pure subroutine start(self, system, t0, q, v, t_end)
        !! See `dense_integrator_t`. Steps are counted anew from here.
        class(stepwise_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0
        real(dp), intent(in) :: q(system%ndof), v(system%ndof)
        real(dp), intent(in), optional :: t_end

        call self%stand(t0, t_end)
        call self%method%start(system, t0, q, v)
        self%t_start = t0
        self%done = 0
        self%steps = huge(self%steps)
        self%rest = 0.0_dp
        if (present(t_end)) call whole_steps(t_end - t0, self%dt, self%steps, self%rest)
        self%q1 = q
        self%v1 = v
        self%q0 = self%q1
        self%v0 = self%v1
        self%evaluations = self%method%evaluations + self%own
    end subroutine start

    pure subroutine step(self, system, error)
        !! See `dense_integrator_t`. Fails where the method's step gives no finite state.
        class(stepwise_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        logical :: refused

        call self%refuse_system(system, refused, error=error)
        if (refused) return
        if (self%t_new <= self%t_start) then
            call system%accelerations(self%t_new, self%q1, self%v1, self%a1)
            self%own = self%own + 1
        end if
        self%t_old = self%t_new
        self%q0 = self%q1
        self%v0 = self%v1
        self%a0 = self%a1
        if (self%done < self%steps) then
            call self%method%try_advance(system, self%t_start, self%dt, self%done, 1_i8, self%q1, &
                                         self%v1, error)
            if (allocated(error)) return
            self%done = self%done + 1
            self%t_new = self%t_start + self%done*self%dt
            if (self%done == self%steps .and. self%rest <= 0.0_dp) self%t_new = self%t_end
        else
            call self%method%try_advance(system, self%t_old, self%rest, 0_i8, 1_i8, self%q1, &
                                         self%v1, error)
            if (allocated(error)) return
            self%t_new = self%t_end
        end if
        call system%accelerations(self%t_new, self%q1, self%v1, self%a1)
        self%own = self%own + 1
        self%accepted = self%accepted + 1
        self%evaluations = self%method%evaluations + self%own
    end subroutine step

    pure subroutine state_at(self, t, q, v)
        !! See `dense_integrator_t`; the velocity is the interpolant's own.
        class(stepwise_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(:), v(:)
        real(dp) :: h, s, c(0:5)
        integer :: i

        if (self%coordinates /= size(q)) then
            q = ieee_value(q, ieee_quiet_nan)
            v = q
            return
        end if
        q = self%q1
        v = self%v1
        if (t >= self%t_new) return
        q = self%q0
        v = self%v0
        if (t <= self%t_old) return
        h = self%t_new - self%t_old
        s = (t - self%t_old)/h
        do i = 1, size(q)
            c = quintic(h, [self%q0(i), self%v0(i), self%a0(i)], &
                        [self%q1(i), self%v1(i), self%a1(i)])
            q(i) = c(0) + s*(c(1) + s*(c(2) + s*(c(3) + s*(c(4) + s*c(5)))))
            v(i) = self%v0(i) + s*(h*self%a0(i) + s*(3.0_dp*c(3) + s*(4.0_dp*c(4) &
                                                                    + s*5.0_dp*c(5)))/h)
        end do
    end subroutine state_at
end module lagrangia_stepwise
