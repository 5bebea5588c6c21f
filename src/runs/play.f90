module lagrangia_play
    !! One scene from its data to its data file, picture and row of the scorecard.
    use lagrangia_accuracy, only: rehearse_finer, state_accuracy
    use lagrangia_choice, only: settle_method
    use lagrangia_columns, only: new_columns
    use lagrangia_dense_run, only: drive
    use lagrangia_description, only: description_t, name_length
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_event_files, only: finish_event_file, open_event_file
    use lagrangia_event_record, only: event_record_t
    use lagrangia_events, only: event_box_t
    use lagrangia_gnuplot, only: new_panels, panel_t
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_measures, only: take_measures, take_modes
    use lagrangia_methods, only: exact
    use lagrangia_observer, only: observer_box_t, observer_t
    use lagrangia_outcome, only: from_closed_form, from_half_step, from_steps, &
                                 measure_t, outcome_t
    use lagrangia_output_file, only: output_file_t
    use lagrangia_partial_runs, only: keep_parts, planned
    use lagrangia_period, only: period_t
    use lagrangia_record, only: record_t
    use lagrangia_reduced_motion, only: reduced_motion_t
    use lagrangia_reference, only: reference_t
    use lagrangia_run, only: plan_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_claims, only: claim_alone
    use lagrangia_scene_files, only: abandon_files, commit_files, finish_files, open_files
    use lagrangia_staging, only: stage_events, stage_method, stage_shadow
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_witness, only: witness_t
    implicit none (type, external)
    private
    public :: play, rehearse, performance_t

    type :: performance_t
        !! All that one scene needs to run.
        type(scene_t) :: scene                        !! its method is not `auto`, but what that is
        type(plan_t) :: plan
        class(integrator_t), allocatable :: integrator
        class(reference_t), allocatable :: reference  !! absent: no closed form
        type(witness_t) :: witness
        type(record_t) :: record
        type(period_t) :: period
        type(panel_t), allocatable :: panels(:)
        type(event_box_t), allocatable :: events(:)
        type(event_record_t) :: event_record
        type(panel_t), allocatable :: event_panels(:)
        type(outcome_t) :: outcome
    end type performance_t

contains

    subroutine rehearse(scene, system, p, error)
        !! Everything that can be refused before anything is computed or any file is touched.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        type(performance_t), intent(inout) :: p
        type(error_t), allocatable, intent(out) :: error

        call system%closed_form(scene%t0, scene%q, scene%v, p%reference)
        call settle_method(scene, system, p%reference, p%scene, p%outcome%choice)
        call begin_outcome(p%scene, p%outcome)
        call stage_method(p%scene, system, p%plan, p%integrator, error, p%reference)
        if (allocated(error)) return
        if (scene%error_estimate) call rehearse_finer(p%scene, system, error)
        if (allocated(error)) return
        call stage_events(scene, system, p%events, p%event_record, p%event_panels, error)
        if (allocated(error)) return
        call new_record(scene, system, p, error)
        if (allocated(error)) return
        call new_panels(scene%plots, scene%columns, p%record%columns%units(p%record%shown), &
                        p%panels, error)
    end subroutine rehearse

    subroutine play(scene, system, folder, format, watcher, outcome, error)
        !! Run `scene` and write its files below `folder` (`""`: write none).
        !!
        !! A run that fails on its numbers (status 3) keeps the rows that were good, as files called
        !! `NAME.partial`; any other failure leaves none. Existing files stay as they were.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        character(*), intent(in) :: folder, format
        class(observer_t), pointer, intent(in) :: watcher  !! hears the run go on; may be null
        type(outcome_t), intent(out) :: outcome
        type(error_t), allocatable, intent(out) :: error

        call perform(scene, system, folder, format, watcher, outcome, error)
        if (.not. allocated(error)) return
        outcome%failure = error%message
        if (error%status /= status_numbers) outcome%file = ""
    end subroutine play

    subroutine perform(scene, system, folder, format, watcher, outcome, error)
        !! See `play`, which also says of a failure that it is one.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        character(*), intent(in) :: folder, format
        class(observer_t), pointer, intent(in) :: watcher
        type(outcome_t), intent(out) :: outcome
        type(error_t), allocatable, intent(out) :: error
        type(performance_t), target :: p
        type(observer_box_t) :: observers(5)
        type(description_t) :: d
        type(error_t), allocatable :: file_error
        logical :: complete
        integer :: n

        call rehearse(scene, system, p, error)
        outcome = p%outcome
        if (allocated(error)) return
        if (folder /= "") then
            call claim_alone(scene, system, folder, format, error)
            if (allocated(error)) return
            call open_files(scene, system, outcome%choice, folder, format, p%record, &
                            outcome%file, error)
            if (allocated(error)) return
            if (size(p%events) > 0) call open_event_file(scene, system, folder, format, p%events, &
                                                         p%event_record, error)
            if (allocated(error)) then
                call abandon_files(p%record)
                return
            end if
        end if
        n = 0
        call join(p%witness)
        if (size(p%record%columns%items) > 0) call join(p%record)
        if (scene%period_of /= "") then
            call system%describe(d)
            p%period%coordinate = findloc(d%coordinates%name == scene%period_of, .true., 1)
            call join(p%period)
        end if
        if (size(p%events) > 0) call join(p%event_record)
        if (associated(watcher)) call join(watcher)
        call timed_run(system, p, observers(:n), outcome, error)
        complete = .not. allocated(error)
        if (scene%error_estimate .and. complete) call state_accuracy(p%scene, &
            system, p%reference, p%witness, outcome%steps, watcher, outcome%state, error)
        if (allocated(error)) then
            outcome%t = scene%t0
            if (allocated(p%witness%q)) then
                outcome%t = p%witness%t
                outcome%q = p%witness%q
                outcome%v = p%witness%v
            end if
            if (error%status /= status_numbers) then
                call abandon_files(p%record)
                if (allocated(p%event_record%table)) call p%event_record%table%file%abandon()
                return
            end if
        end if
        call take_measures(scene, p%record, p%period, p%reference, outcome)
        call take_modes(scene, system, outcome)
        if (.not. complete) then
            call keep_parts(p%plan, p%record, p%event_record, outcome, error)
            return
        end if
        call write_files(scene, folder, format, p, outcome, file_error)
        if (allocated(file_error) .and. .not. allocated(error)) call move_alloc(file_error, error)
    contains
        subroutine join(observer)
            class(observer_t), target, intent(in) :: observer

            n = n + 1
            observers(n)%item => observer
        end subroutine join
    end subroutine perform

    subroutine write_files(scene, folder, format, p, outcome, error)
        !! Complete all files of the scene; where that succeeds they get their names, else none.
        type(scene_t), intent(in) :: scene
        character(*), intent(in) :: folder, format
        type(performance_t), intent(inout) :: p
        type(outcome_t), intent(inout) :: outcome
        type(error_t), allocatable, intent(out) :: error
        type(output_file_t) :: scripts(2)

        call finish_event_file(scene, folder, format, p%event_record, p%event_panels, &
                               scripts(1), outcome%events, error)
        if (.not. allocated(error)) call finish_files(scene, folder, format, p%record, p%panels, &
                                                      outcome, scripts(2), error)
        if (.not. allocated(error)) call commit_files(p%event_record%table, scripts(1), error)
        if (.not. allocated(error)) call commit_files(p%record%table, scripts(2), error)
        if (.not. allocated(error)) return
        outcome%file = ""
        outcome%events = ""
        call abandon_files(p%record)
        if (allocated(p%event_record%table)) call p%event_record%table%file%abandon()
        call scripts(1)%abandon()
        call scripts(2)%abandon()
    end subroutine write_files

    subroutine timed_run(system, p, observers, outcome, error)
        !! The run itself, its final state and what it cost.
        class(system_t), intent(in) :: system
        type(performance_t), target, intent(inout) :: p  !! the observers point into it
        type(observer_box_t), intent(in) :: observers(:)
        type(outcome_t), intent(inout) :: outcome
        type(error_t), allocatable, intent(out) :: error
        integer(i8) :: start, finish, rate

        if (p%plan%rest > 0.0_dp .and. p%scene%method /= exact) outcome%remark = &
            " (the last one shortened to "// &
            to_text(p%plan%rest)//" s)"
        call system_clock(start, rate)
        outcome%steps = planned(p%plan)
        call drive(system, p%integrator, p%plan, p%events, observers, outcome%q, outcome%v, &
                   outcome%t, error)
        call system_clock(finish)
        if (allocated(error)) outcome%steps = min(outcome%steps, &
            p%plan%every*max(0_i8, p%witness%samples - 1))
        if (p%plan%equal > 0 .or. size(p%events) > 0 .or. p%scene%method == exact) then
            select type (method => p%integrator)
            class is (dense_integrator_t)
                outcome%steps = method%accepted
                outcome%rejected = method%rejected
            end select
        end if
        if (.not. allocated(error) .and. outcome%t < p%plan%t0 + p%plan%duration) then
            outcome%remark = " (stopped by an event at t = "//to_text(outcome%t)//" s)"
        end if
        select type (method => p%integrator)
        type is (reduced_motion_t)
            outcome%remark = outcome%remark//" (the cyclic coordinate from its momentum)"
        end select
        outcome%seconds = real(finish - start, dp)/real(rate, dp)
        outcome%evaluations = p%integrator%evaluations
    end subroutine timed_run

    pure subroutine begin_outcome(scene, outcome)
        !! What is known before the run.
        type(scene_t), intent(in) :: scene
        type(outcome_t), intent(inout) :: outcome

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
    end subroutine begin_outcome

    subroutine new_record(scene, system, p, error)
        !! The columns that are shown, and behind them those that are only judged.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        type(performance_t), intent(inout) :: p
        type(error_t), allocatable, intent(out) :: error
        character(name_length), allocatable :: names(:)
        integer :: i

        allocate (names, source=scene%columns)
        do i = 1, size(scene%expectations)
            associate (name => scene%expectations(i)%name)
                if (is_period(name) .or. any(names == name)) cycle
                names = [character(name_length) :: names, name]
            end associate
        end do
        p%record%shown = size(scene%columns)
        if (any(names == "error")) then
            if (allocated(p%reference)) then
                if (p%reference%has_state) p%outcome%error_from = from_closed_form
            end if
            if (p%scene%method == exact) p%outcome%error_from = from_steps
            if (p%outcome%error_from == from_closed_form) then
                allocate (p%record%reference, source=p%reference)
            else if (any(scene%expectations%name == "error") .or. p%scene%method == exact) then
                if (p%scene%method /= exact) p%outcome%error_from = from_half_step
                allocate (p%record%shadow)
                call stage_shadow(p%scene, system, p%plan, p%integrator, p%record%shadow, error)
                if (allocated(error)) return
            end if
        end if
        call new_columns(p%record%columns, names, system, p%outcome%error_from > 0, error)
        if (allocated(error)) return
        call check_period(scene, p, error)
    end subroutine new_record

    elemental function is_period(name) result(yes)
        !! An expectation about the period rather than about a column.
        character(*), intent(in) :: name
        logical :: yes

        yes = name == "period" .or. name == "small_period"
    end function is_period

    pure subroutine check_period(scene, p, error)
        !! Refuse to expect a period that is not measured or has nothing to compare with.
        type(scene_t), intent(in) :: scene
        type(performance_t), intent(in) :: p
        type(error_t), allocatable, intent(out) :: error
        logical :: known
        integer :: i

        do i = 1, size(scene%expectations)
            associate (name => scene%expectations(i)%name)
                if (.not. is_period(name)) cycle
                known = .false.
                if (allocated(p%reference)) known = merge(p%reference%period, &
                    p%reference%small_period, name == "period") > 0.0_dp
                if (.not. known) then
                    call fail(error, "no such period of this motion is known", &
                              key="expect_"//trim(name))
                else if (scene%period_of == "") then
                    call fail(error, "needs period_of = 'a coordinate'", &
                              key="expect_"//trim(name))
                end if
            end associate
            if (allocated(error)) return
        end do
    end subroutine check_period
end module lagrangia_play
