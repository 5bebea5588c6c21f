module lagrangia_solve
    !! The motion at given times, as arrays: one call for programs of other people.
    use lagrangia_dense_run, only: drive
    use lagrangia_errors, only: error_t, fail
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: auto, new_adaptive, new_integrator
    use lagrangia_observer, only: observer_box_t
    use lagrangia_recorder, only: recorder_t
    use lagrangia_reference, only: reference_t
    use lagrangia_run, only: run
    use lagrangia_scene, only: scene_t
    use lagrangia_state_check, only: check_start
    use lagrangia_system, only: system_t
    use lagrangia_text, only: quoted, to_text
    use lagrangia_time_grid, only: new_given_times, new_time_grid, time_grid_t
    use lagrangia_trajectory_plan, only: plan_events, plan_steps, settle_method, trajectory_plan_t
    implicit none (type, external)
    private
    public :: solve

    real(dp), parameter :: usual_tolerance = 1e-10_dp  !! where neither step nor tolerance is given

contains

    subroutine solve(system, method, t, q0, v0, q, v, error, dt, tolerance, events, found)
        !! Integrate from `t(1)` and give the states at all `t`.
        !!
        !! With `dt` the method takes equal steps from each time to the next, none longer than `dt`;
        !! with events, steps of `dt` and an interpolation of order 6 between them. With `tolerance`
        !! it chooses its steps, and the times between them come from its dense output.
        class(system_t), intent(in) :: system               !! configured
        character(*), intent(in) :: method                  !! `rk4`, `gauss16`, `auto`, ...
        real(dp), intent(in) :: t(:)                        !! times, s, each later than the last
        real(dp), intent(in) :: q0(:), v0(:)                !! the state at `t(1)`, (ndof); of
        !! velocities those that constraints leave free are enough
        real(dp), allocatable, intent(out) :: q(:, :)       !! coordinates, (ndof, size(t))
        real(dp), allocatable, intent(out) :: v(:, :)       !! velocities, (ndof, size(t))
        type(error_t), allocatable, intent(out) :: error    !! 2: an argument; 3: the numbers
        real(dp), intent(in), optional :: dt                !! longest step, s
        real(dp), intent(in), optional :: tolerance         !! of the error of one step
        character(*), intent(in), optional :: events(:)     !! as in a scene: `theta = 0.5 rising`
        type(recorder_t), intent(out), optional :: found    !! the events that happened, in order;
        !! after one that stops the motion `q` and `v` have the samples up to it only
        type(recorder_t), target :: record
        type(trajectory_plan_t) :: plan
        type(scene_t) :: scene
        type(time_grid_t) :: samples
        type(observer_box_t) :: observers(1)
        real(dp), allocatable :: start_v(:)
        real(dp) :: ended

        call check_arguments()
        if (allocated(error)) return
        call make_scene()
        call make_plan()
        if (allocated(error)) return
        observers(1)%item => record
        if (plan%times%samples > 0) then
            call drive(system, plan%integrator, plan%times, plan%events, observers, plan%q, &
                       plan%v, ended, error)
        else
            call step_from_time_to_time()
        end if
        if (allocated(error)) return
        q = record%q(:, :record%samples)
        v = record%v(:, :record%samples)
        if (present(found)) found = record
    contains
        subroutine check_arguments()
            logical :: adaptive
            class(dense_integrator_t), allocatable :: by_tolerance
            class(integrator_t), allocatable :: by_steps

            call new_given_times(samples, t, error)
            if (allocated(error)) return
            call new_adaptive(method, by_tolerance)
            adaptive = allocated(by_tolerance) .or. method == auto
            if (present(dt) .and. present(tolerance)) then
                call fail(error, "give dt or tolerance, not both", key="dt")
            else if (.not. (adaptive .or. present(dt))) then
                call new_integrator(method, by_steps, error)
                if (.not. allocated(error)) call fail(error, "the method "//quoted(method)// &
                                                      " needs dt", key="dt")
            else if (present(tolerance)) then
                if (.not. tolerance > 0.0_dp) call fail(error, "must be positive, not "// &
                                                        to_text(tolerance), key="tolerance")
            end if
            if (.not. allocated(error)) call complete_start()
            if (.not. allocated(error)) call check_start(system, t(1), q0, start_v, error)
        end subroutine check_arguments

        subroutine complete_start()
            !! A start that does not keep the constraints is refused.
            start_v = v0
            if (system%constraints == 0 .or. size(q0) /= system%ndof) return
            call system%check_places(t(1), q0, error)
            if (allocated(error)) return
            start_v = spread(0.0_dp, 1, system%ndof)
            call system%complete_velocities(t(1), q0, v0, start_v, error)
        end subroutine complete_start

        subroutine make_scene()
            !! What the arguments say.
            scene%method = method
            scene%t0 = samples%t0
            scene%duration = samples%duration
            scene%q = q0
            scene%v = start_v
            scene%samples = samples%samples
            if (present(dt)) then
                scene%dt = dt
            else
                scene%tolerance = usual_tolerance
                if (present(tolerance)) scene%tolerance = tolerance
            end if
            if (present(events)) then
                if (size(events) > 0) scene%events = events
            end if
        end subroutine make_scene

        subroutine make_plan()
            class(reference_t), allocatable :: closed_form
            character(:), allocatable :: choice
            type(scene_t) :: settled

            call system%closed_form(scene%t0, scene%q, scene%v, closed_form)
            call settle_method(scene, system, closed_form, settled, choice)
            call plan_steps(settled, system, plan, error, closed_form)
            if (.not. allocated(error)) call plan_events(settled, system, plan%events, error)
            if (allocated(error)) return
            if (settled%tolerance > 0.0_dp .or. size(plan%events) > 0) plan%times = samples
        end subroutine make_plan

        subroutine step_from_time_to_time()
            real(dp) :: interval
            integer :: k

            call record%observe(system, t(1), plan%q, plan%v, error)
            do k = 2, size(t)
                interval = t(k) - t(k - 1)
                call new_time_grid(plan%times, t(k - 1), interval/ceiling(interval/dt, i8), &
                                   interval, 1_i8, error)
                if (allocated(error)) return
                call run(system, plan%integrator, plan%times, observers(:0), plan%q, plan%v, error)
                if (allocated(error)) return
                call record%observe(system, t(k), plan%q, plan%v, error)
                if (allocated(error)) return
            end do
        end subroutine step_from_time_to_time
    end subroutine solve
end module lagrangia_solve
