module lagrangia_run_plan
    !! Everything that one run of a scene needs. What can be refused before anything is computed or
    !! any file is touched, is refused here, with its place in the scene's file.
    use lagrangia_accuracy, only: plan_finer
    use lagrangia_columns, only: column_names, new_columns, refuse_work
    use lagrangia_command_line, only: word_t
    use lagrangia_cross_check, only: new_other_method
    use lagrangia_description, only: described_by, description_t, name_length
    use lagrangia_errors, only: error_t, fail
    use lagrangia_exact_motion, only: exact_motion_t
    use lagrangia_gnuplot, only: new_panels, other_columns_t, panel_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: exact, new_adaptive, workhorse
    use lagrangia_outcome, only: from_closed_form, from_half_step, from_steps
    use lagrangia_period, only: period_t
    use lagrangia_record, only: event_record_t, sample_record_t
    use lagrangia_reference, only: reference_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene, read_scene
    use lagrangia_second_run, only: second_run_t
    use lagrangia_stepwise, only: stepwise_t
    use lagrangia_system, only: system_t
    use lagrangia_trajectory_plan, only: plan_events, plan_steps, settle_method, trajectory_plan_t
    implicit none (type, external)
    private
    public :: run_plan_t
    public :: new_run_plan, parse_run_plan, read_run_plan

    type :: run_plan_t
        !! One run of a scene, which uses it up.
        type(scene_t) :: scene                          !! as it was read
        type(scene_t) :: settled                        !! with a method in the place of `auto`
        class(system_t), allocatable :: system
        character(:), allocatable :: choice             !! why that method; "" if the scene names it
        class(reference_t), allocatable :: closed_form  !! of the start; absent: none is known
        type(trajectory_plan_t) :: trajectory
        type(trajectory_plan_t) :: finer(2)             !! for `error_estimate`
        type(sample_record_t) :: record                        !! of the samples
        type(panel_t), allocatable :: panels(:)
        type(event_record_t) :: event_record
        type(panel_t), allocatable :: event_panels(:)
        type(period_t) :: period                        !! of the coordinate `period_of`
        integer :: error_from = 0                       !! what the column `error` comes from
        logical :: used = .false.                       !! the run has begun
    end type run_plan_t

contains

    subroutine read_run_plan(plan, path, overrides, error)
        !! Read a scene's file and plan its run: refuses whatever is wrong with it.
        type(run_plan_t), intent(out) :: plan  !! ready to run
        character(*), intent(in) :: path  !! of the scene
        type(word_t), intent(in) :: overrides(:)          !! the words behind `--set`
        type(error_t), allocatable, intent(out) :: error  !! names file, line and key
        class(system_t), allocatable :: system
        type(scene_t) :: scene

        call read_scene(path, overrides, scene, system, error)
        if (.not. allocated(error)) call new_run_plan(plan, scene, system, error)
    end subroutine read_run_plan

    subroutine parse_run_plan(plan, text, source, overrides, error)
        !! The same for a scene in `text`.
        type(run_plan_t), intent(out) :: plan  !! ready to run
        character(*), intent(in) :: text  !! lines between line feeds
        character(*), intent(in) :: source                !! the file that it came from
        type(word_t), intent(in) :: overrides(:)          !! the words behind `--set`
        type(error_t), allocatable, intent(out) :: error  !! names file, line and key
        class(system_t), allocatable :: system
        type(scene_t) :: scene

        call parse_scene(text, source, overrides, scene, system, error)
        if (.not. allocated(error)) call new_run_plan(plan, scene, system, error)
    end subroutine parse_run_plan

    subroutine new_run_plan(plan, scene, system, error)
        !! Plan the run of a scene. Reads and writes no file.
        type(run_plan_t), intent(out) :: plan  !! ready to run
        type(scene_t), intent(in) :: scene  !! as it was read, or made
        class(system_t), intent(in) :: system             !! with the scene's parameters
        type(error_t), allocatable, intent(out) :: error
        !! names file, line and key where the scene was read from a file

        plan%scene = scene
        allocate (plan%system, source=system)
        call system%closed_form(scene%t0, scene%q, scene%v, plan%closed_form)
        call settle_method(scene, system, plan%closed_form, plan%settled, plan%choice)
        call make_parts(plan, system, error)
        call scene%locate(error)
    end subroutine new_run_plan

    subroutine make_parts(plan, system, error)
        !! Of a plan that has its scene and its method.
        type(run_plan_t), intent(inout) :: plan
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        type(description_t) :: d
        type(other_columns_t) :: others
        integer :: k

        associate (scene => plan%scene, record => plan%record)
            call plan_steps(plan%settled, system, plan%trajectory, error, plan%closed_form)
            if (allocated(error)) return
            if (scene%error_estimate) call plan_finer(plan%settled, system, plan%finer, error)
            if (allocated(error)) return
            call plan_events(scene, system, plan%trajectory%events, error)
            if (allocated(error)) return
            do k = 1, merge(2, 0, scene%error_estimate)
                call plan_events(scene, system, plan%finer(k)%events, error)
                if (allocated(error)) return
            end do
            call new_event_record(plan, system, error)
            if (allocated(error)) return
            call new_record(plan, system, error)
            if (allocated(error)) return
            call check_period(scene, plan%closed_form, error)
            if (allocated(error)) return
            call system%describe(d)
            if (scene%period_of /= "") plan%period%coordinate = &
                findloc(d%coordinates%name == scene%period_of, .true., 1)
            call find_others(system, d, plan%error_from > 0, "columns", others)
            call new_panels(scene%plots, scene%columns, record%columns%units(record%shown), &
                            plan%panels, error, others)
        end associate
    end subroutine make_parts

    pure subroutine find_others(system, d, has_error, key, others)
        !! What a message about a picture offers.
        class(system_t), intent(in) :: system
        type(description_t), intent(in) :: d
        logical, intent(in) :: has_error    !! `error` is one of them
        character(*), intent(in) :: key     !! of the scene
        type(other_columns_t), intent(out) :: others

        others%names = column_names(system, has_error)
        others%key = key
        others%shown_by = described_by(d)
    end subroutine find_others

    subroutine new_event_record(plan, system, error)
        !! Who writes the events down, if there are any, and how they are drawn.
        type(run_plan_t), intent(inout) :: plan
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        type(description_t) :: d
        type(other_columns_t) :: others

        allocate (plan%event_panels(0))
        if (size(plan%trajectory%events) == 0) return
        associate (columns => plan%event_record%columns, names => plan%scene%event_columns)
            call new_columns(columns, names, system, .false., error)
            call refuse_work(columns, error)
            if (allocated(error)) error%key = "event_columns"
            if (allocated(error)) return
            call system%describe(d)
            call find_others(system, d, .false., "event_columns", others)
            call new_panels(plan%scene%event_plots, names, columns%units(size(names)), &
                            plan%event_panels, error, others)
            if (allocated(error)) error%key = "event_plot"
        end associate
    end subroutine new_event_record

    subroutine new_record(plan, system, error)
        !! The columns that are shown, and behind them those that are only judged.
        type(run_plan_t), intent(inout) :: plan
        class(system_t), intent(in) :: system
        type(error_t), allocatable, intent(out) :: error
        character(name_length), allocatable :: names(:)
        integer :: i

        associate (scene => plan%settled)
            allocate (names, source=scene%columns)
            do i = 1, size(scene%expectations)
                associate (name => scene%expectations(i)%name)
                    if (is_period(name) .or. any(names == name)) cycle
                    if (name == "error" .and. system%contacts > 0 .and. &
                        .not. scene%expectations(i)%judged) cycle  ! none is estimated
                    names = [character(name_length) :: names, name]
                end associate
            end do
            plan%record%shown = size(scene%columns)
            if (any(names == "error")) then
                if (allocated(plan%closed_form)) then
                    if (plan%closed_form%has_state) plan%error_from = from_closed_form
                end if
                if (scene%method == exact) plan%error_from = from_steps
                if (plan%error_from == from_closed_form) then
                    allocate (plan%record%reference, source=plan%closed_form)
                else if (any(scene%expectations%name == "error") .or. scene%method == exact) then
                    if (scene%method /= exact) plan%error_from = from_half_step
                    allocate (plan%record%second_run)
                    call start_second_run(scene, system, plan%trajectory, &
                                          plan%record%second_run, error)
                    if (allocated(error)) return
                end if
            end if
        end associate
        call new_columns(plan%record%columns, names, system, plan%error_from > 0, error)
    end subroutine new_record

    subroutine start_second_run(scene, system, trajectory, second_run, error)
        !! A finer run beside the scene's, and another method's, to estimate its error; beside a
        !! closed form, steps.
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        type(trajectory_plan_t), intent(in) :: trajectory
        type(second_run_t), intent(inout) :: second_run
        type(error_t), allocatable, intent(out) :: error
        class(dense_integrator_t), allocatable :: steps, other
        integer(i8), parameter :: affordable = 10000000  ! steps: some 20 s
        real(dp) :: t_end

        if (system%contacts > 0) then
            call fail(error, "no error is estimated across impacts", key="expect_error")
            return
        end if
        associate (times => trajectory%times, q => scene%q, v => scene%v)
            t_end = times%t0 + times%duration
            if (scene%method /= exact) then
                call new_other_method(scene, system, other)
                call second_run%start_other(other, system, times%t0, t_end, q, v)
            end if
            select type (method => trajectory%integrator)
            type is (exact_motion_t)
                call new_adaptive(workhorse, steps)
                steps%tolerance = steps%least_tolerance
                call second_run%start_adaptive(steps, system, times%t0, t_end, q, v, error, &
                                               affordable)
            type is (stepwise_t)
                call second_run%start(method%method, system, times%t0, times%dt, q, v, error)
            class is (dense_integrator_t)
                if (times%samples > 0) then
                    call second_run%start_adaptive(method, system, times%t0, t_end, q, v, error)
                else
                    call second_run%start(method, system, times%t0, times%dt, q, v, error)
                end if
            class default
                call second_run%start(method, system, times%t0, times%dt, q, v, error)
            end select
        end associate
    end subroutine start_second_run

    elemental function is_period(name) result(yes)
        !! An expectation about the period rather than about a column.
        character(*), intent(in) :: name
        logical :: yes

        yes = name == "period" .or. name == "small_period"
    end function is_period

    pure subroutine check_period(scene, closed_form, error)
        !! Refuse to expect a period that is not measured or has nothing to compare with.
        type(scene_t), intent(in) :: scene
        class(reference_t), allocatable, intent(in) :: closed_form
        type(error_t), allocatable, intent(out) :: error
        logical :: known
        integer :: i

        do i = 1, size(scene%expectations)
            associate (name => scene%expectations(i)%name)
                if (.not. is_period(name) .or. .not. scene%expectations(i)%judged) cycle
                known = .false.
                if (allocated(closed_form)) known = merge(closed_form%period, &
                    closed_form%small_period, name == "period") > 0.0_dp
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
end module lagrangia_run_plan
