module lagrangia_reduced_motion
    !! A method that leaves a cyclic coordinate out of its steps.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t, integrator_t, not_started
    use lagrangia_kinds, only: dp, i8
    use lagrangia_stepwise, only: new_stepwise, stepwise_t
    use lagrangia_system, only: reduced_t, system_t
    implicit none (type, external)
    private
    public :: leave_cyclic, reduced_motion_t

    type, extends(dense_integrator_t) :: reduced_motion_t
        !! Steps of `method` for the reduced system. What is conserved is noted by `start`.
        private
        class(dense_integrator_t), allocatable :: method
        class(reduced_t), allocatable :: reduced
        real(dp), allocatable :: q_left(:), v_left(:)  !! state of the reduced system
        real(dp) :: t_left = 0.0_dp                    !! when it left the whole system, s
    contains
        procedure :: prepare
        procedure :: start
        procedure :: advance
        procedure :: step
        procedure :: state_at
    end type reduced_motion_t

contains

    subroutine leave_cyclic(method, system)
        !! Let `method` leave the cyclic coordinate of `system` out, if that pays (the method says
        !! so), the system knows how, and no generalised force acts on it. `lagrangia bench` has
        !! it gain a fifth with `gauss16`, a third with `dop853`, nothing to speak of with others.
        class(integrator_t), allocatable, intent(inout) :: method  !! perhaps another type then
        class(system_t), intent(in) :: system                      !! the whole one
        class(reduced_t), allocatable :: reduced
        type(reduced_motion_t) :: motion
        type(stepwise_t) :: steps

        if (.not. method%leaves_cyclic) return
        if (system%nonconservative .and. system%cyclic == 0) return
        call system%reduce(reduced)
        if (.not. allocated(reduced)) return
        select type (method)
        class is (dense_integrator_t)
            allocate (motion%method, source=method)
        class default
            call new_stepwise(steps, method, 1.0_dp)  ! any: only `advance` is called
            allocate (motion%method, source=steps)
        end select
        call move_alloc(reduced, motion%reduced)
        motion%name = method%name
        motion%title = trim(method%title)//"; the cyclic coordinate follows from its momentum"
        motion%order = method%order
        motion%energy_order = method%energy_order
        motion%symplectic = method%symplectic
        motion%reversible = method%reversible
        motion%tolerance = motion%method%tolerance
        motion%least_tolerance = motion%method%least_tolerance
        motion%longest = motion%method%longest
        motion%dense = motion%method%dense
        deallocate (method)
        allocate (method, source=motion)
    end subroutine leave_cyclic

    pure subroutine prepare(self, system, error)
        !! Refuses what the method refuses.
        class(reduced_motion_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: left(self%reduced%ndof)

        call command(self)
        call self%method%prepare(self%reduced, error)
        if (allocated(error)) return
        self%coordinates = system%ndof
        left = ieee_value(left, ieee_quiet_nan)
        self%q_left = left
        self%v_left = left
        self%failure_reason = not_started
        call report(self)
    end subroutine prepare

    pure subroutine advance(self, system, t0, dt, first, steps, q, v)
        !! See `integrator_t`. Time counts from where the whole system was left, so that a clock
        !! that has run long costs no digits.
        class(reduced_motion_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, dt
        integer(i8), intent(in) :: first, steps
        real(dp), intent(inout) :: q(system%ndof), v(system%ndof)
        logical :: refused

        call self%refuse_system(system, refused, q, v)
        if (refused) return
        call self%method%advance(self%reduced, t0, dt, first, steps, self%q_left, self%v_left)
        call self%reduced%complete((t0 - self%t_left) + (first + steps)*dt, self%q_left, &
                                   self%v_left, q, v)
        if (self%method%failure_reason /= "") self%failure_reason = self%method%failure_reason
        call report(self)
    end subroutine advance

    pure subroutine start(self, system, t0, q, v, t_end)
        !! See `dense_integrator_t`.
        class(reduced_motion_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0
        real(dp), intent(in) :: q(system%ndof), v(system%ndof)
        real(dp), intent(in), optional :: t_end
        logical :: refused

        call self%refuse_system(system, refused)
        if (refused) return
        call command(self)
        self%failure_reason = ""
        call self%reduced%leave(q, v, self%q_left, self%v_left)
        self%t_left = t0
        call self%method%start(self%reduced, t0, self%q_left, self%v_left, t_end)
        call report(self)
    end subroutine start

    pure subroutine step(self, system, error)
        !! See `dense_integrator_t`.
        class(reduced_motion_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        logical :: refused

        call self%refuse_system(system, refused, error=error)
        if (refused) return
        call self%method%step(self%reduced, error)
        call report(self)
    end subroutine step

    pure subroutine state_at(self, t, q, v)
        !! See `dense_integrator_t`.
        class(reduced_motion_t), intent(in) :: self
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(:), v(:)
        real(dp) :: q_left(self%reduced%ndof), v_left(self%reduced%ndof)

        call self%method%state_at(t, q_left, v_left)
        call self%reduced%complete(t - self%t_left, q_left, v_left, q, v)
    end subroutine state_at

    pure subroutine command(self)
        !! What the caller wants of the method.
        class(reduced_motion_t), intent(inout) :: self

        self%method%tolerance = self%tolerance
        self%method%longest = self%longest
        self%method%dense = self%dense
    end subroutine command

    pure subroutine report(self)
        !! Where the method is, and what it has done.
        class(reduced_motion_t), intent(inout) :: self

        self%evaluations = self%method%evaluations
        self%t_old = self%method%t_old
        self%t_new = self%method%t_new
        self%t_end = self%method%t_end
        self%accepted = self%method%accepted
        self%rejected = self%method%rejected
    end subroutine report
end module lagrangia_reduced_motion
