module lagrangia_frames
    !! The motion of a scene at equal times, close enough to be shown as a film: by the scene's own
    !! method, made dense, and beside it the closed form or a finer run.
    use lagrangia_dense_run, only: drive
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: exact, workhorse
    use lagrangia_named_values, only: motion_state_t, path
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_observer, only: observer_box_t
    use lagrangia_recorder, only: recorder_t
    use lagrangia_reference, only: reference_t
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_time_grid, only: new_sample_times
    use lagrangia_trajectory_plan, only: plan_events, plan_steps, trajectory_plan_t
    implicit none (type, external)
    private
    public :: frames_t
    public :: add_reference, film_speed, find_pace, record_frames, window_of
    public :: finer_run, finer_words

    real(dp), parameter :: pi = acos(-1.0_dp)
    character(*), parameter :: finer_run = "finer run"  !! what stands beside, if no closed form
    real(dp), parameter :: fine_tolerance = 1e-13_dp  !! of the finer run
    integer, parameter :: probes = 256                !! states from which the pace is found
    integer, parameter :: enough_periods = 20         !! to know the pace of a motion

    type :: frames_t
        !! States at equal times; only the last interval may be shorter.
        integer :: count = 0
        real(dp) :: interval = 0.0_dp                !! s
        real(dp), allocatable :: t(:)                !! s, (count)
        real(dp), allocatable :: q(:, :), v(:, :)    !! (ndof, count)
    end type frames_t

contains

    subroutine record_frames(scene, system, closed_form, window, count, frames, error)
        !! The first `window` s of the scene, by its own method, in `count` intervals.
        type(scene_t), intent(in) :: scene     !! its method is not `auto`
        class(system_t), intent(in) :: system  !! with the scene's parameters
        class(reference_t), allocatable, intent(in) :: closed_form  !! of its start
        real(dp), intent(in) :: window         !! s, at most the scene's duration
        integer, intent(in) :: count           !! at least 1
        type(frames_t), intent(out) :: frames  !! fewer where an event stops the run
        type(error_t), allocatable, intent(out) :: error  !! of the numbers, as the run's own
        type(trajectory_plan_t) :: plan
        type(scene_t) :: shown
        type(recorder_t), target :: record
        type(observer_box_t) :: observers(1)
        real(dp) :: ended

        shown = scene
        shown%duration = window
        if (.not. allocated(shown%events)) allocate (shown%events(0))  ! a dense method is needed
        call plan_steps(shown, system, plan, error, closed_form)
        if (.not. allocated(error)) call plan_events(shown, system, plan%events, error)
        if (.not. allocated(error)) call new_sample_times(plan%times, scene%t0, window, &
                                                          int(count, i8), error)
        if (allocated(error)) return
        observers(1)%item => record
        call drive(system, plan%integrator, plan%times, plan%events, observers, plan%q, plan%v, &
                   ended, error)
        if (allocated(error)) return
        frames%count = record%samples
        frames%interval = window/count
        frames%t = record%t(:record%samples)
        frames%q = record%q(:, :record%samples)
        frames%v = record%v(:, :record%samples)
    end subroutine record_frames

    subroutine add_reference(scene, system, closed_form, frames, reference, title)
        !! The same times by the closed form, or where there is none, or the scene has it already,
        !! by a finer run; as far as that goes.
        type(scene_t), intent(in) :: scene     !! its method is not `auto`
        class(system_t), intent(in) :: system  !! with the scene's parameters
        class(reference_t), allocatable, intent(in) :: closed_form  !! of its start
        type(frames_t), intent(in) :: frames                        !! of the scene
        type(frames_t), intent(out) :: reference                    !! empty where that fails
        character(:), allocatable, intent(out) :: title             !! what it is
        type(error_t), allocatable :: error
        type(scene_t) :: finer
        integer :: i

        if (allocated(closed_form) .and. scene%method /= exact) then
            if (closed_form%has_state) then
                reference = frames
                title = "closed form"
                do i = 1, frames%count
                    call closed_form%state_at(frames%t(i), reference%q(:, i), reference%v(:, i))
                end do
                return
            end if
        end if
        finer = scene
        finer%method = workhorse
        finer%compensated = .false.
        finer%tolerance = fine_tolerance
        finer%samples = int(frames%count - 1, i8)  ! a scene with steps has none
        title = finer_run
        call record_frames(finer, system, closed_form, frames%interval*(frames%count - 1), &
                           frames%count - 1, reference, error)
        if (allocated(error)) reference%count = 0
        reference%count = min(reference%count, frames%count)
        if (reference%count == 0) title = ""
    end subroutine add_reference

    function finer_words() result(text)
        !! The method of the finer run.
        character(:), allocatable :: text

        text = workhorse//", tolerance "//to_text(fine_tolerance)
    end function finer_words

    subroutine find_pace(scene, system, closed_form, probe, omega, error)
        !! How fast the motion is: \(\omega^2 = \overline{|a|^2}/\overline{|v|^2}\) over all points,
        !! which of a harmonic motion is its frequency. As much of the run as it takes is looked at.
        type(scene_t), intent(in) :: scene     !! its method is not `auto`
        class(system_t), intent(in) :: system  !! with the scene's parameters
        class(reference_t), allocatable, intent(in) :: closed_form  !! of its start
        type(frames_t), intent(out) :: probe   !! what was looked at
        real(dp), intent(out) :: omega         !! rad/s; 0: nothing moves
        type(error_t), allocatable, intent(out) :: error  !! of the numbers, as the run's own
        real(dp) :: window

        window = scene%duration/4.0_dp**8
        do
            window = min(4.0_dp*window, scene%duration)
            call record_frames(scene, system, closed_form, window, probes, probe, error)
            if (allocated(error)) return
            omega = pace(system, probe)
            if (omega*window > 2.0_dp*pi*enough_periods .or. window >= scene%duration) return
        end do
    end subroutine find_pace

    function pace(system, frames) result(omega)
        !! See `find_pace`.
        class(system_t), intent(in) :: system
        type(frames_t), intent(in) :: frames
        real(dp) :: omega
        type(description_t) :: d
        type(hyperdual_t), allocatable :: r(:, :)
        type(hyperdual_t) :: q(system%ndof), t
        type(motion_state_t) :: state
        real(dp) :: speed, bend
        integer :: i

        call system%describe(d)
        allocate (r(3, 0))
        if (allocated(d%points)) then
            deallocate (r)
            allocate (r(3, size(d%points)))
        end if
        allocate (state%a(system%ndof))
        speed = 0.0_dp
        bend = 0.0_dp
        do i = 1, frames%count
            state%t = frames%t(i)
            state%q = frames%q(:, i)
            state%v = frames%v(:, i)
            call system%accelerations(state%t, state%q, state%v, state%a)
            q = path(state)
            t = hyperdual_t(state%t, 1.0_dp, 1.0_dp, 0.0_dp)
            if (size(r) > 0) then
                call system%positions(t, q, r)
                speed = speed + sum(r%d1**2)
                bend = bend + sum(r%d12**2)
            else
                speed = speed + sum(state%v**2)
                bend = bend + sum(state%a**2)
            end if
        end do
        omega = 0.0_dp
        if (speed > 0.0_dp) omega = sqrt(bend/speed)
        if (.not. omega < huge(omega)) omega = 0.0_dp
    end function pace

    pure function window_of(duration, omega, most) result(window)
        !! How much of a run is shown: so much that 24 of at most `most` frames fall on a
        !! period, and then 1, 2 or 5 times a power of ten.
        real(dp), intent(in) :: duration, omega  !! s, rad/s
        integer, intent(in) :: most              !! frames
        real(dp) :: window

        window = duration
        if (omega*duration <= 2.0_dp*pi*most/24.0_dp) return
        window = 2.0_dp*pi*most/(24.0_dp*omega)
        if (round_factor(window) > window) window = 0.5_dp*window
        window = round_factor(window)
    end function window_of

    pure function film_speed(window, omega) result(factor)
        !! Seconds of the motion in one second of the film: 1 where the motion can be followed and
        !! lasts a while, else 1, 2 or 5 times a power of ten.
        real(dp), intent(in) :: window, omega  !! s, rad/s
        real(dp) :: factor
        real(dp), parameter :: fast = 12.0_dp, good = 5.0_dp      !! rad/s, on the screen
        real(dp), parameter :: patience = 60.0_dp, glance = 4.0_dp  !! s

        factor = 1.0_dp
        if (omega > fast) factor = good/omega
        if (window > patience*factor) factor = max(factor, min(window/patience, &
                                                               2.0_dp*fast/max(omega, 1e-30_dp)))
        if (window < glance*factor) factor = window/(1.25_dp*glance)
        if (is_nonzero(factor - 1.0_dp)) factor = round_factor(factor)
    end function film_speed

    pure function round_factor(x) result(nice)
        !! 1, 2 or 5 times a power of ten, the nearest by its ratio.
        real(dp), intent(in) :: x  !! above 0
        real(dp) :: nice
        real(dp) :: power, mantissa

        power = 10.0_dp**floor(log10(x))
        mantissa = x/power
        if (mantissa < sqrt(2.0_dp)) then
            nice = power
        else if (mantissa < sqrt(10.0_dp)) then
            nice = 2.0_dp*power
        else if (mantissa < sqrt(50.0_dp)) then
            nice = 5.0_dp*power
        else
            nice = 10.0_dp*power
        end if
    end function round_factor
end module lagrangia_frames
