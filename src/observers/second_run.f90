module lagrangia_second_run
    !! The same run at half the step, or at a hundredth of the tolerance, in step with the run
    !! itself: where no closed form exists, their distance estimates the error (Richardson;
    !! Hairer, Nørsett & Wanner, sec. II.4). Rounding that both share shows in the distance to
    !! another method, whose steps are few.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: second_run_t, distance

    type :: second_run_t
        private
        class(integrator_t), allocatable :: integrator
        class(dense_integrator_t), allocatable :: adaptive
        class(dense_integrator_t), allocatable :: probe  !! takes the run's steps, to count them
        class(dense_integrator_t), allocatable :: other   !! another method; absent where it fails
        real(dp) :: t0 = 0.0_dp
        real(dp) :: h = 0.0_dp        !! half the step of the run
        integer(i8) :: done = 0       !! half steps taken
        integer(i8) :: affordable = 0           !! steps of the run; 0: any number
        logical, public :: too_many = .false.   !! they would be more: no error is known
        real(dp), allocatable :: q(:), v(:)
        class(observer_t), pointer, public :: watcher => null()  !! hears it go on; may be null
    contains
        procedure :: start
        procedure :: start_adaptive
        procedure :: start_other
        procedure, private :: go_finer
        procedure, private :: tell
        procedure :: estimate
    end type second_run_t

contains

    pure function distance(q, truth) result(error)
        !! The largest difference, absolute below 1 and relative above.
        real(dp), intent(in) :: q(:), truth(:)  !! of one size
        real(dp) :: error

        error = maxval(abs(q - truth)/max(1.0_dp, abs(truth)))
    end function distance

    subroutine start(self, integrator, system, t0, dt, q, v, error)
        !! Get ready with an integrator of the run's kind.
        class(second_run_t), intent(inout) :: self
        class(integrator_t), intent(in) :: integrator  !! is copied
        class(system_t), intent(in) :: system  !! whose motion it is
        real(dp), intent(in) :: t0, dt, q(system%ndof), v(system%ndof)
        !! s; the run's step, s; coordinates, velocities at t0
        type(error_t), allocatable, intent(out) :: error  !! the method does not suit the system

        allocate (self%integrator, source=integrator)
        call self%integrator%prepare(system, error)
        if (allocated(error)) return
        call self%integrator%start(system, t0, q, v)
        self%t0 = t0
        self%h = 0.5_dp*dt
        self%q = q
        self%v = v
    end subroutine start

    subroutine start_adaptive(self, integrator, system, t0, t_end, q, v, error, affordable)
        !! Get ready with an adaptive integrator of the run's kind.
        class(second_run_t), intent(inout) :: self
        class(dense_integrator_t), intent(in) :: integrator  !! is copied, with its tolerance
        class(system_t), intent(in) :: system  !! whose motion it is
        real(dp), intent(in) :: t0, t_end, q(system%ndof), v(system%ndof)
        !! s; coordinates, velocities at t0
        type(error_t), allocatable, intent(out) :: error  !! the method does not suit the system
        integer(i8), intent(in), optional :: affordable
        !! with more steps than these at its tolerance the error is not known; absent: any number

        if (present(affordable)) self%affordable = affordable
        allocate (self%adaptive, source=integrator)
        allocate (self%probe, source=integrator)
        call self%probe%prepare(system, error)
        if (allocated(error)) return
        call self%probe%start(system, t0, q, v, t_end)
        self%adaptive%tolerance = max(integrator%least_tolerance, 0.01_dp*integrator%tolerance)
        call self%adaptive%prepare(system, error)
        if (allocated(error)) return
        call self%adaptive%start(system, t0, q, v, t_end)
        self%t0 = t0
        self%q = q
        self%v = v
    end subroutine start_adaptive

    subroutine start_other(self, method, system, t0, t_end, q, v)
        !! Ask another method too, at its tolerance; one that cannot answer is not asked.
        class(second_run_t), intent(inout) :: self
        class(dense_integrator_t), intent(in) :: method  !! is copied, with its tolerance
        class(system_t), intent(in) :: system  !! whose motion it is
        real(dp), intent(in) :: t0, t_end, q(system%ndof), v(system%ndof)
        !! s; coordinates, velocities at t0
        type(error_t), allocatable :: error

        allocate (self%other, source=method)
        call self%other%prepare(system, error)
        if (allocated(error)) then
            deallocate (self%other)
            return
        end if
        call self%other%start(system, t0, q, v, t_end)
    end subroutine start_other

    subroutine estimate(self, system, t, q, deviation, error)
        !! Go to time `t` and estimate the error of the run's coordinates `q` there: no less than
        !! their distance to the other method's. Fails where the tighter tolerance cannot be had;
        !! NaN where that takes more steps than are affordable.
        class(second_run_t), intent(inout) :: self
        class(system_t), intent(in) :: system  !! that of `start`
        real(dp), intent(in) :: t, q(system%ndof)
        !! s, not before the latest; the run's coordinates
        real(dp), intent(out) :: deviation  !! as `distance` has it
        type(error_t), allocatable, intent(out) :: error  !! why the second run fails
        type(error_t), allocatable :: unknown
        real(dp) :: q_other(system%ndof), v_other(system%ndof)

        call self%go_finer(system, t, q, deviation, error)
        if (allocated(error) .or. .not. allocated(self%other)) return
        do while (self%other%t_new < t .and. .not. allocated(unknown))
            call self%other%step(system, unknown)
            call self%tell(self%other%t_new, self%other%t_end)
        end do
        if (allocated(unknown)) then
            deallocate (self%other)
            return
        end if
        call self%other%state_at(t, q_other, v_other)
        deviation = max(deviation, distance(q, q_other))
    end subroutine estimate

    subroutine go_finer(self, system, t, q, deviation, error)
        !! To time `t`, and the error of `q` there as the finer steps see it.
        class(second_run_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof)
        real(dp), intent(out) :: deviation
        type(error_t), allocatable, intent(out) :: error
        integer(i8) :: steps
        real(dp) :: now, rest

        deviation = 0.0_dp
        if (allocated(self%adaptive)) then
            if (allocated(self%probe) .and. .not. self%too_many) then
                call bound_steps(self, system, error)
            end if
            if (self%too_many) deviation = ieee_value(deviation, ieee_quiet_nan)
            if (self%too_many) return
            do while (self%adaptive%t_new < t .and. .not. allocated(error))
                call self%adaptive%step(system, error)
                call self%tell(self%adaptive%t_new, self%adaptive%t_end)
            end do
            if (allocated(error)) then
                call error%add_context("the run that estimates the error")
                return
            end if
            call self%adaptive%state_at(t, self%q, self%v)
            deviation = distance(q, self%q)
            return
        end if
        steps = 2*int((t - self%t0)/(2.0_dp*self%h)*(1.0_dp + epsilon(t)) + 1e-6_dp, i8) - self%done
        call self%integrator%advance(system, self%t0, self%h, self%done, steps, self%q, self%v)
        self%done = self%done + steps
        now = self%t0 + self%done*self%h
        rest = 0.5_dp*(t - now)
        if (rest > 1e-6_dp*self%h) then
            call self%integrator%advance(system, now, rest, 0_i8, 2_i8, self%q, self%v)
        end if
        deviation = distance(q, self%q)*2.0_dp**self%integrator%order &
                    /(2.0_dp**self%integrator%order - 1.0_dp)
    end subroutine go_finer

    subroutine bound_steps(self, system, error)
        !! No step longer than half the run's mean one: a method may find no reason in the tighter
        !! tolerance to take shorter ones, and would repeat the run. One that fails will say so.
        type(second_run_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error  !! they would not end
        type(error_t), allocatable :: unknown
        integer(i8), parameter :: few = 10000  ! these show how many there will be
        integer(i8) :: steps

        steps = 0
        do while (self%probe%t_new < self%probe%t_end)
            call self%probe%step(system, unknown)
            if (allocated(unknown)) exit
            steps = steps + 1
            self%too_many = self%affordable > 0 .and. steps == few .and. &
                            (self%probe%t_new - self%t0)*self%affordable < &
                            (self%probe%t_end - self%t0)*few
            if (self%too_many) return
            call self%probe%refuse_more(steps, self%t0, self%probe%t_end, error)
            if (allocated(error)) return
            call self%tell(self%probe%t_new, self%probe%t_end)
        end do
        if (self%probe%accepted > 0) then
            self%adaptive%longest = 0.5_dp*(self%probe%t_new - self%t0)/self%probe%accepted
        end if
        deallocate (self%probe)
    end subroutine bound_steps

    subroutine tell(self, t, t_end)
        !! Whoever watches that one of these runs has come to time `t`.
        class(second_run_t), intent(in) :: self
        real(dp), intent(in) :: t, t_end  !! s

        if (associated(self%watcher)) call self%watcher%tick_share((t - self%t0)/(t_end - self%t0))
    end subroutine tell
end module lagrangia_second_run
