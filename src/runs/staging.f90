module lagrangia_staging
    !! From a scene to its method, the plan of its run, and the events that it looks for.
    use lagrangia_columns, only: new_columns
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_event_record, only: event_record_t
    use lagrangia_events, only: column_event_t, contact_event_t, event_box_t, new_column_event, &
                                new_contact_event
    use lagrangia_exact_motion, only: exact_motion_t, new_exact_motion
    use lagrangia_gnuplot, only: new_panels, panel_t
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp
    use lagrangia_methods, only: exact, new_adaptive, new_integrator, prepare_integrator, &
                                 workhorse
    use lagrangia_reduced_motion, only: leave_cyclic
    use lagrangia_reference, only: reference_t
    use lagrangia_run, only: new_plan, new_sampled_plan, plan_t
    use lagrangia_scene, only: scene_t
    use lagrangia_second_opinion, only: new_other_method
    use lagrangia_shadow, only: shadow_t
    use lagrangia_stepwise, only: new_stepwise, stepwise_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_tolerance_floor, only: sensible_tolerance
    implicit none (type, external)
    private
    public :: stage_method, stage_events, stage_shadow

contains

    subroutine stage_method(scene, system, plan, integrator, error, closed_form)
        !! The scene's method, ready for the system. Where there are events, a method of fixed step
        !! is made dense. `closed_form` takes its place if the method is `exact`.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        type(plan_t), intent(out) :: plan
        class(integrator_t), allocatable, intent(out) :: integrator
        type(error_t), allocatable, intent(out) :: error
        class(reference_t), allocatable, intent(in), optional :: closed_form
        class(dense_integrator_t), allocatable :: adaptive
        class(integrator_t), allocatable :: fixed
        type(stepwise_t) :: stepwise
        type(exact_motion_t) :: motion

        if (scene%tolerance > 0.0_dp) then
            call new_sampled_plan(plan, scene%t0, scene%duration, scene%samples, error)
        else
            call new_plan(plan, scene%t0, scene%dt, scene%duration, scene%every, error)
        end if
        if (allocated(error)) return
        if (scene%method == exact .and. present(closed_form)) then
            call new_exact_motion(motion, closed_form)
            allocate (integrator, source=motion)
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
            allocate (integrator, source=adaptive)
        else
            call new_integrator(trim(scene%method), fixed, error, scene%compensated)
            if (allocated(error)) return
            if (allocated(scene%events)) then
                call new_stepwise(stepwise, fixed, scene%dt)
                allocate (integrator, source=stepwise)
            else
                call move_alloc(fixed, integrator)
            end if
        end if
        call leave_cyclic(integrator, system)
        call prepare_integrator(integrator, system, error)
    end subroutine stage_method

    subroutine stage_events(scene, system, events, record, panels, error)
        !! The scene's events, those of the system behind them, and who writes them down.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        type(event_box_t), allocatable, intent(out) :: events(:)
        type(event_record_t), intent(inout) :: record
        type(panel_t), allocatable, intent(out) :: panels(:)
        type(error_t), allocatable, intent(out) :: error
        type(column_event_t) :: column
        type(contact_event_t) :: contact
        type(description_t) :: d
        integer :: i, n

        n = 0
        if (allocated(scene%events)) n = size(scene%events)
        allocate (events(n + system%contacts), panels(0))
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
                call fail(error, "violates the constraint, "//trim(d%constraint), key="q")
                return
            end if
            call new_contact_event(contact, i)
            allocate (events(n + i)%item, source=contact)
        end do
        if (size(events) == 0) return
        call new_columns(record%columns, scene%event_columns, system, .false., error)
        if (allocated(error)) error%key = "event_columns"
        if (allocated(error)) return
        call new_panels(scene%event_plots, scene%event_columns, &
                        record%columns%units(size(scene%event_columns)), panels, error)
        if (allocated(error)) error%key = "event_plot"
    end subroutine stage_events

    subroutine stage_shadow(scene, system, plan, integrator, shadow, error)
        !! A finer run beside the scene's, and another method's, to estimate its error; beside a
        !! closed form, steps.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        type(plan_t), intent(in) :: plan
        class(integrator_t), intent(in) :: integrator
        type(shadow_t), intent(inout) :: shadow
        type(error_t), allocatable, intent(out) :: error
        class(dense_integrator_t), allocatable :: witness, other

        if (system%contacts > 0) then
            call fail(error, "no error is estimated across impacts", key="expect_error")
            return
        end if
        if (scene%method /= exact) then
            call new_other_method(scene, system, other)
            call shadow%start_other(other, system, plan%t0, plan%t0 + plan%duration, scene%q, &
                                    scene%v)
        end if
        select type (integrator)
        type is (exact_motion_t)
            call new_adaptive(workhorse, witness)
            witness%tolerance = witness%least_tolerance
            call shadow%start_adaptive(witness, system, plan%t0, plan%t0 + plan%duration, scene%q, &
                                       scene%v, error)
            return
        type is (stepwise_t)
            call shadow%start(integrator%method, system, plan%t0, plan%dt, scene%q, scene%v, error)
            return
        class is (dense_integrator_t)
            if (plan%equal > 0) then
                call shadow%start_adaptive(integrator, system, plan%t0, plan%t0 + plan%duration, &
                                           scene%q, scene%v, error)
                return
            end if
        end select
        call shadow%start(integrator, system, plan%t0, plan%dt, scene%q, scene%v, error)
    end subroutine stage_shadow
end module lagrangia_staging
