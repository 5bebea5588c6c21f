module lagrangia_dense_run
    !! The loop of a method with dense output: samples and events lie between its steps.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_crossings, only: watch_t
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_events, only: event_box_t
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: check_observers, observer_box_t
    use lagrangia_run, only: run
    use lagrangia_state_check, only: blame_mass_matrix, check_start
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_time_grid, only: time_grid_t
    implicit none (type, external)
    private
    public :: drive, run_dense

    integer, parameter :: most_at_once = 100  !! impacts at one time

contains

    subroutine drive(system, integrator, grid, events, observers, q, v, ended, error)
        !! `run_dense` where samples or events may lie between the steps, else `run`.
        class(system_t), intent(in) :: system  !! whose motion it is
        class(integrator_t), intent(inout) :: integrator
        !! is prepared here; a dense one, if need be
        type(time_grid_t), intent(in) :: grid  !! the times of steps and samples
        type(event_box_t), intent(inout) :: events(:)  !! may be empty
        type(observer_box_t), intent(in) :: observers(:)  !! are called in this order
        real(dp), intent(inout) :: q(:), v(:)  !! the start; the end on return, (system%ndof)
        real(dp), intent(out) :: ended  !! time of the last sample, s
        type(error_t), allocatable, intent(out) :: error  !! why the run ended early

        ended = grid%t0 + grid%duration
        if (grid%samples > 0 .or. size(events) > 0) then
            select type (integrator)
            class is (dense_integrator_t)
                call run_dense(system, integrator, grid, events, observers, q, v, ended, error)
            class default
                call fail(error, trim(integrator%name)//" has no dense output, which samples "// &
                          "at equal times and events need: new_stepwise gives it one")
            end select
        else
            call run(system, integrator, grid, observers, q, v, error)
        end if
    end subroutine drive

    subroutine run_dense(system, method, grid, events, observers, q, v, ended, error)
        !! Integrate from `grid%t0` over `grid%duration`, showing the samples of the grid and the
        !! end to `observers`, and every event. The number of samples costs no evaluations.
        !!
        !! A run that fails has shown what was good up to `ended`, and `q` and `v` are as they were.
        class(system_t), intent(in) :: system  !! whose motion it is
        class(dense_integrator_t), intent(inout) :: method  !! is prepared here
        type(time_grid_t), intent(in) :: grid  !! only its samples count
        type(event_box_t), intent(inout) :: events(:)  !! may be empty
        type(observer_box_t), intent(in) :: observers(:)  !! are called in this order
        real(dp), intent(inout) :: q(:), v(:)  !! the start; the end on return, (system%ndof)
        real(dp), intent(out) :: ended  !! time of the last sample, s
        type(error_t), allocatable, intent(out) :: error  !! why the run ended early
        type(watch_t) :: watch
        real(dp) :: t_end, q_end(system%ndof), v_end(system%ndof)
        integer(i8) :: shown, last, steps
        integer :: i, impacts
        logical :: stopped, restarted

        ended = grid%t0
        call check_start(system, grid%t0, q, v, error)
        if (.not. allocated(error)) call check_observers(observers, error)
        if (allocated(error)) return
        if (grid%every < 1) call fail(error, "the time grid is not one of new_time_grid")
        do i = 1, size(events)
            if (.not. allocated(events(i)%item)) call fail(error, "event "//to_text(i)//" is "// &
                "an empty box: allocate its item")
        end do
        if (allocated(error)) return
        t_end = grid%t0 + grid%duration
        last = grid%last_sample()
        shown = 0
        impacts = 0
        steps = 0
        stopped = .false.
        call method%prepare(system, error)
        if (allocated(error)) return
        call method%start(system, grid%t0, q, v, t_end)
        call watch%start(events, system, grid%t0, q, v)
        call show(grid%t0, watch%q, watch%v)
        do while (method%t_new < t_end .and. .not. (stopped .or. allocated(error)))
            call method%step(system, error)
            if (allocated(error)) call blame_mass_matrix(system, ended, method%t_new - ended, &
                                                         q_end, v_end, error)
            if (allocated(error)) exit
            restarted = .false.
            do while (size(events) > 0 .and. .not. (stopped .or. restarted .or. allocated(error)))
                call watch%next(events, system, method, error)
                if (allocated(error) .or. watch%which == 0) exit
                call show_samples(watch%t)
                if (allocated(error)) exit
                call meet()
            end do
            if (allocated(error)) exit
            if (.not. (stopped .or. restarted)) then
                call show_samples(method%t_new)
                if (.not. allocated(error)) call follow(method%t_new)
            end if
            steps = steps + 1
            call method%refuse_more(steps, grid%t0, t_end, error)
            if (.not. allocated(error)) call look_around()
        end do
        if (allocated(error)) return
        q = q_end
        v = v_end
    contains
        subroutine meet()
            !! An event: its impact, and whether the run ends or starts again.
            real(dp) :: before(2*system%ndof)
            integer :: i

            associate (event => events(watch%which)%item)
                call follow(watch%t)
                before = [watch%q, watch%v]
                call event%impact(system, watch%t, watch%q, watch%v)
                restarted = event%one_sided .or. any(abs(before - [watch%q, watch%v]) > 0.0_dp)
                do i = 1, size(observers)
                    call observers(i)%item%meet(system, watch%which, watch%t, watch%q, watch%v, &
                                                error)
                    if (allocated(error)) return
                end do
                stopped = event%terminal
            end associate
            if (stopped) then
                if (watch%t > ended) call show(watch%t, watch%q, watch%v)
            else if (restarted) then
                impacts = merge(impacts + 1, 0, watch%t <= method%t_old)
                if (impacts > most_at_once) then
                    call fail(error, "impacts do not end at t = "//to_text(watch%t)//" s", &
                              status_numbers)
                    return
                end if
                call method%start(system, watch%t, watch%q, watch%v, t_end)
                call watch%start(events, system, watch%t, watch%q, watch%v)
            end if
        end subroutine meet

        subroutine follow(t)
            !! Show the motion inside the step, up to `t`, to who wants to see it.
            real(dp), intent(in) :: t
            integer :: i

            do i = 1, size(observers)
                if (observers(i)%item%follows()) call observers(i)%item%follow_inside(method, t)
            end do
        end subroutine follow

        subroutine show_samples(t)
            !! All that are due up to `t`.
            real(dp), intent(in) :: t
            real(dp) :: now, q_now(system%ndof), v_now(system%ndof)
            integer :: i

            do while (shown <= last .and. .not. allocated(error))
                now = grid%sample_time(shown)
                if (now > t) exit
                call method%state_at(now, q_now, v_now)
                do i = 1, size(observers)
                    if (.not. observers(i)%item%follows_samples()) cycle
                    call observers(i)%item%follow_inside(method, now)
                end do
                call show(now, q_now, v_now)
            end do
        end subroutine show_samples

        subroutine show(t, q_now, v_now)
            !! One sample, which is kept if it is finite.
            real(dp), intent(in) :: t, q_now(:), v_now(:)
            integer :: i

            if (.not. (all(ieee_is_finite(q_now)) .and. all(ieee_is_finite(v_now)))) then
                call fail(error, "the state is not finite at t = "//to_text(t)//" s: the "// &
                          "motion diverges, or the step is too long", status_numbers)
                return
            end if
            q_end = q_now
            v_end = v_now
            ended = t
            shown = shown + 1
            do i = 1, size(observers)
                call observers(i)%item%observe(system, t, q_end, v_end, error)
                if (allocated(error)) return
            end do
        end subroutine show

        subroutine look_around()
            !! Signals, and whoever watches the run go on.
            integer :: i

            if (interrupt_status() /= 0) then
                call fail(error, "interrupted", interrupt_status())
                return
            end if
            do i = 1, size(observers)
                call observers(i)%item%tick_share((method%t_new - grid%t0)/grid%duration)
            end do
        end subroutine look_around
    end subroutine run_dense
end module lagrangia_dense_run
