module lagrangia_trajectory_plan
    !! From a scene to the trajectory that is to be computed: its method, its times, its events.
    use lagrangia_description, only: constraint_text, description_t, name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_events, only: column_event_t, contact_event_t, event_box_t, new_column_event, &
                                new_contact_event
    use lagrangia_exact_motion, only: exact_motion_t, new_exact_motion
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp
    use lagrangia_methods, only: auto, exact, new_adaptive, new_integrator, prepare_integrator, &
                                 workhorse
    use lagrangia_number_class, only: all_finite
    use lagrangia_reduced_motion, only: leave_cyclic
    use lagrangia_reference, only: reference_t
    use lagrangia_scene, only: scene_t
    use lagrangia_stepwise, only: new_stepwise, stepwise_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_time_grid, only: new_sample_times, new_time_grid, time_grid_t
    use lagrangia_tolerance_floor, only: sensible_tolerance
    implicit none (type, external)
    private
    public :: trajectory_plan_t, plan_events, plan_steps, settle_method

    type :: trajectory_plan_t
        !! A trajectory to be computed.
        type(time_grid_t) :: times
        class(integrator_t), allocatable :: integrator
        type(event_box_t), allocatable :: events(:)
        real(dp), allocatable :: q(:), v(:)             !! the start, (ndof)
    end type trajectory_plan_t

contains

    subroutine settle_method(scene, system, reference, settled, choice)
        !! The scene with a method in the place of `auto`, and a line that says so.
        type(scene_t), intent(in) :: scene  !! names a method, or `auto`
        class(system_t), intent(in) :: system  !! with the scene's parameters
        class(reference_t), allocatable, intent(in) :: reference  !! of the scene's start
        type(scene_t), intent(out) :: settled  !! names a method
        character(:), allocatable, intent(out) :: choice          !! "" if the method was named
        character(:), allocatable :: why

        settled = scene
        choice = ""
        if (scene%method /= auto) return
        call choose_method(scene, system, reference, settled%method, why)
        choice = auto//" took "//trim(settled%method)//": "//why
    end subroutine settle_method

    subroutine choose_method(scene, system, reference, method, why)
        !! What takes the place of `auto` in a scene: `exact` where `reference` gives the states,
        !! or the name of a method.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        class(reference_t), allocatable, intent(in) :: reference
        character(name_length), intent(out) :: method
        character(:), allocatable, intent(out) :: why

        if (system%contacts > 0) then
            why = "impacts are looked for between steps"
        else if (allocated(scene%events)) then
            why = "events are looked for between steps"
        else if (scene%error_estimate) then
            why = "an error is estimated by finer steps"
        else if (.not. allocated(reference)) then
            why = "no closed form is known from this start"
        else if (.not. gives_states()) then
            why = "the closed form does not give every state"
        else
            method = exact
            why = "closed form: "//trim(reference%title)
            return
        end if
        method = workhorse
        why = why//"; of the methods this one is mostly the fastest to a given error"
    contains
        function gives_states() result(yes)
            logical :: yes
            real(dp) :: q(system%ndof), v(system%ndof)

            yes = reference%has_state
            if (.not. yes) return
            call reference%state_at(scene%t0 + scene%duration, q, v)
            yes = all_finite(q) .and. all_finite(v)
        end function gives_states
    end subroutine choose_method
    subroutine plan_steps(scene, system, plan, error, closed_form)
        !! The start, the times, and the scene's method, ready for the system. Where there are
        !! events or contacts, a method of fixed step is made dense.
        type(scene_t), intent(in) :: scene              !! its method is not `auto`
        class(system_t), intent(in) :: system  !! with the scene's parameters
        type(trajectory_plan_t), intent(out) :: plan    !! still without its events
        type(error_t), allocatable, intent(out) :: error  !! blames a key of the scene
        class(reference_t), allocatable, intent(in), optional :: closed_form
        !! of the scene's start: takes the place of the method if that is `exact`
        class(dense_integrator_t), allocatable :: adaptive
        class(integrator_t), allocatable :: fixed
        type(stepwise_t) :: stepwise
        type(exact_motion_t) :: motion

        plan%q = scene%q
        plan%v = scene%v
        if (scene%tolerance > 0.0_dp) then
            call new_sample_times(plan%times, scene%t0, scene%duration, scene%samples, error)
        else
            call new_time_grid(plan%times, scene%t0, scene%dt, scene%duration, scene%every, error)
        end if
        if (allocated(error)) return
        if (scene%method == exact .and. present(closed_form)) then
            call new_exact_motion(motion, closed_form)
            allocate (plan%integrator, source=motion)
        else if (scene%tolerance > 0.0_dp) then
            call new_adaptive(trim(scene%method), adaptive)
            adaptive%tolerance = scene%tolerance
            adaptive%least_tolerance = sensible_tolerance(adaptive, system, scene%t0, &
                                                          scene%duration, scene%q, scene%v)
            if (scene%tolerance < adaptive%least_tolerance) then
                call fail(error, to_text(scene%tolerance)//" is less than rounding of so large "// &
                          "coordinates or times leaves: "//trim(adaptive%name)//" would step "// &
                          "for ever; the smallest sensible one is "// &
                          to_text(adaptive%least_tolerance), key="tolerance")
                return
            end if
            allocate (plan%integrator, source=adaptive)
        else
            call new_integrator(trim(scene%method), fixed, error, scene%compensated)
            if (allocated(error)) return
            if (allocated(scene%events) .or. system%contacts > 0) then
                call new_stepwise(stepwise, fixed, scene%dt)
                allocate (plan%integrator, source=stepwise)
            else
                call move_alloc(fixed, plan%integrator)
            end if
        end if
        call leave_cyclic(plan%integrator, system)
        call prepare_integrator(plan%integrator, system, error)
    end subroutine plan_steps

    subroutine plan_events(scene, system, events, error)
        !! The scene's events, and behind them the contacts of the system.
        type(scene_t), intent(in) :: scene  !! names its own events
        class(system_t), intent(in) :: system  !! with the scene's parameters
        type(event_box_t), allocatable, intent(out) :: events(:)  !! none: empty
        type(error_t), allocatable, intent(out) :: error  !! blames a key of the scene
        type(column_event_t) :: column
        type(contact_event_t) :: contact
        type(description_t) :: d
        integer :: i, n

        n = 0
        if (allocated(scene%events)) n = size(scene%events)
        allocate (events(n + system%contacts))
        do i = 1, n
            call new_column_event(column, trim(scene%events(i)), system, error)
            if (allocated(error)) then
                error%key = "event"
                error%element = i
                return
            end if
            allocate (events(i)%item, source=column)
        end do
        do i = 1, system%contacts
            if (system%gap(i, scene%t0, scene%q, scene%v) < 0.0_dp) then
                call system%describe(d)
                call fail(error, "violates the constraint, "//constraint_text(d), key="q")
                return
            end if
            call new_contact_event(contact, i)
            allocate (events(n + i)%item, source=contact)
        end do
    end subroutine plan_events
end module lagrangia_trajectory_plan
