module lagrangia_scene_run
    !! One run of a scene, as planned, to its data files, scripts and row of the scorecard.
    use lagrangia_accuracy, only: share_of_run, state_accuracy
    use lagrangia_dense_run, only: drive
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_final_state, only: final_state_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_measures, only: take_measures, take_modes
    use lagrangia_methods, only: exact
    use lagrangia_observer, only: observer_box_t, observer_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_part, only: part_t
    use lagrangia_reduced_motion, only: reduced_motion_t
    use lagrangia_run_files, only: abandon_files, finish_files, keep_parts, open_files
    use lagrangia_run_plan, only: run_plan_t
    use lagrangia_scene_claims, only: claim_alone
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: run_scene

contains

    subroutine run_scene(plan, folder, format, progress, outcome, error)
        !! Run a scene and write its files.
        !!
        !! A run that fails on its numbers (status 3) keeps the rows that were good, as files called
        !! `NAME.partial`; any other failure leaves none. Existing files stay as they were.
        type(run_plan_t), target, intent(inout) :: plan      !! used up
        character(*), intent(in) :: folder                   !! of the files; "": write none
        character(*), intent(in) :: format                   !! of the data: text, csv, npy
        class(observer_t), pointer, intent(in) :: progress   !! hears the run go on; may be null
        type(outcome_t), intent(out) :: outcome              !! whole even where the run fails
        type(error_t), allocatable, intent(out) :: error     !! why the run failed

        call begin_outcome(plan, outcome)
        if (plan%used) then
            call fail(error, "this plan has been run: make another one")
        else
            plan%used = .true.
            call run_and_write(plan, folder, format, progress, outcome, error)
        end if
        if (.not. allocated(error)) return
        outcome%failure = error%message
        if (error%status /= status_numbers) outcome%file = ""
    end subroutine run_scene

    subroutine run_and_write(plan, folder, format, progress, outcome, error)
        !! See `run_scene`.
        type(run_plan_t), target, intent(inout) :: plan
        character(*), intent(in) :: folder, format
        class(observer_t), pointer, intent(in) :: progress
        type(outcome_t), intent(inout) :: outcome
        type(error_t), allocatable, intent(out) :: error
        type(final_state_t), target :: seen
        type(part_t), target :: part
        type(observer_box_t) :: observers(5)
        type(error_t), allocatable :: file_error
        logical :: complete
        integer :: n

        associate (scene => plan%scene, system => plan%system)
            if (folder /= "") then
                call claim_alone(scene, system, folder, format, error)
                if (allocated(error)) return
                call open_files(plan, folder, format, outcome%file, error)
                if (allocated(error)) return
            end if
            n = 0
            call join(seen)
            part%whole => progress
            if (scene%error_estimate) part%to = share_of_run
            if (allocated(plan%record%second_run)) plan%record%second_run%watcher => part
            if (size(plan%record%columns%items) > 0) call join(plan%record)
            if (scene%period_of /= "") call join(plan%period)
            if (size(plan%trajectory%events) > 0) call join(plan%event_record)
            call join(part)
            call timed_run(plan, seen, observers(:n), outcome, error)
            complete = .not. allocated(error)
            if (scene%error_estimate .and. complete) call state_accuracy(plan%settled, system, &
                plan%closed_form, plan%finer, seen, outcome%steps, progress, outcome%state, error)
            if (allocated(error)) then
                outcome%t = scene%t0
                if (allocated(seen%q)) then
                    outcome%t = seen%t
                    outcome%q = seen%q
                    outcome%v = seen%v
                end if
                if (error%status /= status_numbers) then
                    call abandon_files(plan)
                    return
                end if
            end if
            call take_measures(scene, system, plan%record, plan%period, plan%closed_form, &
                               outcome)
            call take_modes(scene, system, outcome)
            if (.not. complete) then
                call keep_parts(plan, outcome, error)
                return
            end if
            call finish_files(plan, outcome, file_error)
            if (allocated(file_error) .and. .not. allocated(error)) then
                call move_alloc(file_error, error)
            end if
        end associate
    contains
        subroutine join(observer)
            class(observer_t), target, intent(in) :: observer

            n = n + 1
            observers(n)%item => observer
        end subroutine join
    end subroutine run_and_write

    subroutine timed_run(plan, seen, observers, outcome, error)
        !! The run itself, its final state and what it cost.
        type(run_plan_t), target, intent(inout) :: plan  !! the observers point into it
        type(final_state_t), target, intent(inout) :: seen   !! one of them
        type(observer_box_t), intent(in) :: observers(:)
        type(outcome_t), intent(inout) :: outcome
        type(error_t), allocatable, intent(out) :: error
        integer(i8) :: start, finish, rate

        associate (times => plan%trajectory%times, integrator => plan%trajectory%integrator)
            if (times%rest > 0.0_dp .and. plan%settled%method /= exact) outcome%remark = &
                " (the last one shortened to "//to_text(times%rest)//" s)"
            call system_clock(start, rate)
            outcome%steps = times%step_count()
            call drive(plan%system, integrator, times, plan%trajectory%events, observers, &
                       outcome%q, outcome%v, outcome%t, error)
            call system_clock(finish)
            if (allocated(error)) outcome%steps = min(outcome%steps, &
                times%every*max(0_i8, seen%samples - 1))
            if (times%samples > 0 .or. size(plan%trajectory%events) > 0 .or. &
                plan%settled%method == exact) then
                select type (method => integrator)
                class is (dense_integrator_t)
                    outcome%steps = method%accepted
                    outcome%rejected = method%rejected
                end select
            end if
            if (.not. allocated(error) .and. outcome%t < times%t0 + times%duration) then
                outcome%remark = " (stopped by an event at t = "//to_text(outcome%t)//" s)"
            end if
            select type (method => integrator)
            type is (reduced_motion_t)
                outcome%remark = outcome%remark//" (the cyclic coordinate from its momentum)"
            end select
            if (integrator%symplectic .and. plan%system%nonconservative) outcome%remark = &
                outcome%remark//" (with generalised forces beside L they are not symplectic: "// &
                "the order holds, and energy_balance_drift says the rest)"
            if (integrator%energy_order > 0 .and. plan%system%is_projected) outcome%remark = &
                outcome%remark//" (each step ends on the constraints, which is not reversible: "// &
                "the order holds, the energy may drift)"
            outcome%seconds = real(finish - start, dp)/real(rate, dp)
            outcome%evaluations = integrator%evaluations
        end associate
    end subroutine timed_run

    pure subroutine begin_outcome(plan, outcome)
        !! What is known before the run.
        type(run_plan_t), intent(in) :: plan
        type(outcome_t), intent(inout) :: outcome

        associate (scene => plan%settled)
            outcome%scene = trim(scene%name)
            outcome%system = trim(scene%system)
            outcome%method = trim(scene%method)
            outcome%file = ""
            outcome%events = ""
            outcome%remark = ""
            outcome%t = scene%t0
            outcome%q = scene%q
            outcome%v = scene%v
            allocate (outcome%drifts(0), outcome%others(0))
            outcome%choice = plan%choice
            outcome%title = trim(scene%title)
            if (allocated(plan%scene%changes)) outcome%changes = plan%scene%changes
            outcome%error_from = plan%error_from
        end associate
    end subroutine begin_outcome
end module lagrangia_scene_run
