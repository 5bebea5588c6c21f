module lagrangia_run
    !! The one loop: a system, an integrator, and whoever wants to see the states.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_errors, only: error_t, fail
    use lagrangia_integrator, only: integrator_t
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: check_observers, observer_box_t
    use lagrangia_start, only: blame_mass_matrix, check_start
    use lagrangia_stepwise, only: whole_steps
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: plan_t, new_plan, new_sampled_plan, run

    integer(i8), parameter :: longest_block = 1024  !! steps between two looks at signals

    type :: plan_t
        !! A grid of times: whole steps, and perhaps a shorter one that lands on the end; or, where
        !! a method chooses its steps, only samples.
        real(dp) :: t0 = 0.0_dp
        real(dp) :: dt = 0.0_dp
        real(dp) :: duration = 0.0_dp
        integer(i8) :: steps = 0      !! whole steps
        real(dp) :: rest = 0.0_dp     !! length of the last, shortened step; 0 if there is none
        integer(i8) :: every = 1      !! steps between samples
        integer(i8) :: equal = 0      !! so many samples at equal times; 0: as the steps have it
        real(dp), allocatable :: at(:)  !! or at these times, s, (equal + 1)
    contains
        procedure :: samples
        procedure :: sample_time
    end type plan_t

contains

    pure subroutine new_plan(plan, t0, dt, duration, every, error)
        !! Count the steps; fails where they cannot be counted or do not move the time, and on a
        !! number that makes no sense.
        type(plan_t), intent(out) :: plan
        real(dp), intent(in) :: t0, dt, duration  !! finite, s; the step positive, no time negative
        integer(i8), intent(in) :: every  !! steps between samples
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: count

        call check_times(t0, duration, error)
        if (allocated(error)) return
        if (.not. (ieee_is_finite(dt) .and. dt > 0.0_dp)) then
            call fail(error, "must be positive and finite, not "//to_text(dt), key="dt")
        else if (every < 1) then
            call fail(error, "must be at least 1, not "//to_text(every), key="every")
        end if
        if (allocated(error)) return
        count = duration/dt
        if (count > 1e15_dp) then
            call fail(error, "duration/dt = "//to_text(count)//" steps are too many to count", &
                      key="dt")
            return
        end if
        if (abs(t0) + duration + dt <= abs(t0) + duration) then
            call fail(error, "is too small to move the time near t = "//to_text(t0 + duration), &
                      key="dt")
            return
        end if
        plan%t0 = t0
        plan%dt = dt
        plan%duration = duration
        plan%every = every
        call whole_steps(duration, dt, plan%steps, plan%rest)
    end subroutine new_plan

    pure subroutine new_sampled_plan(plan, t0, duration, samples, error)
        !! So many samples after that of the start; fails where they cannot be told apart.
        type(plan_t), intent(out) :: plan
        real(dp), intent(in) :: t0, duration  !! finite, s; the duration not negative
        integer(i8), intent(in) :: samples    !! at least 1
        type(error_t), allocatable, intent(out) :: error

        call check_times(t0, duration, error)
        if (allocated(error)) return
        if (samples < 1) then
            call fail(error, "must be at least 1, not "//to_text(samples), key="samples")
            return
        end if
        if (duration/samples < 4.0_dp*spacing(abs(t0) + duration)) then
            call fail(error, "so many samples cannot be told apart near t = "// &
                      to_text(t0 + duration)//" s", key="samples")
            return
        end if
        plan%t0 = t0
        plan%duration = duration
        plan%equal = samples
    end subroutine new_sampled_plan

    pure subroutine check_times(t0, duration, error)
        !! Both finite, as is the end; time does not run backwards.
        real(dp), intent(in) :: t0, duration
        type(error_t), allocatable, intent(out) :: error

        if (.not. ieee_is_finite(t0)) then
            call fail(error, "must be finite, not "//to_text(t0), key="t0")
        else if (.not. (ieee_is_finite(duration) .and. duration >= 0.0_dp)) then
            call fail(error, "must be finite and not negative, not "//to_text(duration), &
                      key="duration")
        end if
    end subroutine check_times

    pure function samples(self) result(count)
        !! Number of the last sample; that of the start is 0.
        class(plan_t), intent(in) :: self
        integer(i8) :: count

        count = self%equal
        if (count > 0) return
        count = self%steps/self%every
        if (mod(self%steps, self%every) /= 0 .or. self%rest > 0.0_dp) count = count + 1
    end function samples

    pure function sample_time(self, k) result(t)
        !! Time of sample `k`, s; the last is exactly the end.
        class(plan_t), intent(in) :: self
        integer(i8), intent(in) :: k
        real(dp) :: t

        if (k == self%samples()) then
            t = self%t0 + self%duration
        else if (allocated(self%at)) then
            t = self%at(k + 1)
        else if (self%equal > 0) then
            t = self%t0 + self%duration*(real(k, dp)/real(self%equal, dp))
        else
            t = self%t0 + k*self%every*self%dt
        end if
    end function sample_time

    subroutine run(system, integrator, plan, observers, q, v, error)
        !! Integrate from `t0` over `duration`, showing every sample and the end to `observers`.
        !!
        !! A state that is not finite ends the run, as does an observer's error or a signal. A run
        !! that fails has shown what was good, and `q` and `v` are as they were.
        class(system_t), intent(in) :: system
        class(integrator_t), intent(inout) :: integrator
        type(plan_t), intent(in) :: plan
        type(observer_box_t), intent(in) :: observers(:)
        real(dp), intent(inout) :: q(:), v(:)  !! the start; the end on return, (system%ndof)
        type(error_t), allocatable, intent(out) :: error
        real(dp) :: q_start(system%ndof), v_start(system%ndof)
        real(dp) :: q_known(system%ndof), v_known(system%ndof)  ! at step `known`, finite
        integer(i8) :: done, block_end, known
        integer :: i
        logical :: followed

        if (system%contacts > 0) then
            call fail(error, "unilateral constraints need a run that looks for impacts: run_dense")
            return
        end if
        if (plan%every < 1 .or. plan%equal > 0) then
            call fail(error, "the plan is not one of new_plan")
            return
        end if
        call check_start(system, plan%t0, q, v, error)
        if (.not. allocated(error)) call check_observers(observers, error)
        if (allocated(error)) return
        call integrator%prepare(system, error)
        if (allocated(error)) return
        call integrator%start(system, plan%t0, q, v)
        done = 0
        known = 0
        q_start = q
        v_start = v
        q_known = q
        v_known = v
        followed = any([(observers(i)%item%follows(), i=1, size(observers))])
        call show(plan%t0)
        do while (done < plan%steps .and. .not. allocated(error))
            block_end = min(plan%steps, done + merge(1_i8, longest_block, followed), &
                            (done/plan%every + 1)*plan%every)
            call integrator%advance(system, plan%t0, plan%dt, done, block_end - done, q, v)
            done = block_end
            if (followed) call follow(time_of(done))
            if (mod(done, plan%every) == 0 .or. (done == plan%steps .and. plan%rest <= 0.0_dp)) then
                call show(time_of(done))
            else
                call look_around()
            end if
        end do
        if (plan%rest > 0.0_dp .and. .not. allocated(error)) then
            call integrator%advance(system, time_of(done), plan%rest, 0_i8, 1_i8, q, v)
            if (followed) call follow(plan%t0 + plan%duration)
            call show(plan%t0 + plan%duration)
        end if
        if (.not. allocated(error)) return
        q = q_start
        v = v_start
    contains
        pure function time_of(k) result(t)
            integer(i8), intent(in) :: k
            real(dp) :: t

            t = plan%t0 + k*plan%dt
            if (k == plan%steps .and. plan%rest <= 0.0_dp) t = plan%t0 + plan%duration
        end function time_of

        subroutine follow(t)
            real(dp), intent(in) :: t
            integer :: j

            do j = 1, size(observers)
                if (observers(j)%item%follows()) call observers(j)%item%follow(system, t, q, v)
            end do
        end subroutine follow

        subroutine show(t)
            real(dp), intent(in) :: t
            integer :: i

            call integrator%refuse_state(t, plan%dt, q, v, error)
            if (allocated(error)) call find_cause()
            if (allocated(error)) return
            known = done
            q_known = q
            v_known = v
            do i = 1, size(observers)
                call observers(i)%item%observe(system, t, q, v, error)
                if (allocated(error)) return
            end do
            call look_around()
        end subroutine show

        subroutine find_cause()
            !! Once more, step by step, from the last state that is known to be finite.
            type(error_t), allocatable :: refused
            integer(i8) :: evaluations

            evaluations = integrator%evaluations
            call integrator%prepare(system, refused)
            q = q_known
            v = v_known
            call integrator%start(system, plan%t0 + known*plan%dt, q, v)
            do while (known < done)
                call integrator%advance(system, plan%t0, plan%dt, known, 1_i8, q, v)
                if (.not. all(ieee_is_finite([q, v]))) exit
                known = known + 1
                q_known = q
                v_known = v
            end do
            integrator%evaluations = evaluations
            call blame_mass_matrix(system, plan%t0 + known*plan%dt, plan%dt, q_known, v_known, &
                                   error)
        end subroutine find_cause

        subroutine look_around()
            integer :: i

            if (interrupt_status() /= 0) then
                call fail(error, "interrupted", interrupt_status())
                return
            end if
            do i = 1, size(observers)
                call observers(i)%item%tick(done, plan%steps)
            end do
        end subroutine look_around
    end subroutine run
end module lagrangia_run
