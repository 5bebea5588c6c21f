module lagrangia_sweep
    !! Many trajectories of one scene: a number or two of it are changed over a grid, and of each
    !! trajectory a few numbers are kept.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
    use lagrangia_columns, only: columns_t
    use lagrangia_dense_run, only: drive
    use lagrangia_errors, only: error_t, fail, status_numbers
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kept, only: keeper_t, keeps_end, keeps_event, keeps_exact_period, keeps_flip, &
                              keeps_largest, keeps_lyapunov, keeps_lyapunov_error, keeps_period, &
                              keeps_smallest, kept_t, read_kept
    use lagrangia_kinds, only: dp, i8
    use lagrangia_lyapunov, only: lyapunov_exponent
    use lagrangia_methods, only: auto, exact, new_adaptive, workhorse
    use lagrangia_observer, only: observer_box_t
    use lagrangia_period, only: period_t
    use lagrangia_random_draws, only: random_t
    use lagrangia_reference, only: reference_t
    use lagrangia_scene, only: most_axes, scene_t, sweep_text_length
    use lagrangia_sweep_axis, only: new_sweep_axis, sweep_axis_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use lagrangia_trajectory_plan, only: plan_events, plan_steps, trajectory_plan_t
    implicit none (type, external)
    private
    public :: sweep_t, sweep_box_t
    public :: new_sweep, compute_one


    type :: sweep_t
        !! A grid of trajectories. The first axis is the one that varies slowest.
        type(scene_t) :: scene                   !! what all have in common
        class(system_t), allocatable :: system   !! with the scene's parameters
        type(sweep_axis_t), allocatable :: axes(:)
        type(kept_t), allocatable :: kept(:)
        type(columns_t) :: columns               !! those that `kept` takes
        integer :: events = 0                    !! number of events that `kept` takes
        real(dp) :: after = 0.0_dp               !! samples before this time don't count, s
    contains
        procedure :: trajectories
        procedure :: places
        procedure :: coordinates_of
        procedure :: set_start
    end type sweep_t

    type :: sweep_box_t
        !! gfortran 12 needs it: modules that make the dispatch table of `sweep_t` for themselves
        !! disagree about its order.
        class(sweep_t), allocatable :: item
    end type sweep_box_t

contains

    subroutine new_sweep(sweep, scene, system, over, keep, seed, after, error)
        !! Everything that is refused is refused here, or by `compute_one` of the first trajectory.
        type(sweep_t), intent(out) :: sweep               !! ready to compute
        type(scene_t), intent(in) :: scene                !! each trajectory's, but for the axes
        class(system_t), intent(in) :: system             !! with the scene's parameters
        character(*), intent(in) :: over(:)               !! the axes, one or two
        character(*), intent(in) :: keep(:)               !! what is kept of each trajectory
        integer, intent(in) :: seed                       !! of the values that are drawn
        real(dp), intent(in) :: after                     !! samples before don't count, s
        type(error_t), allocatable, intent(out) :: error  !! names the key: over, keep, after
        character(sweep_text_length), allocatable :: events(:)
        type(random_t) :: random
        integer :: i

        if (size(over) < 1 .or. size(over) > most_axes) then
            call fail(error, "one or two axes make a sweep, not "//to_text(size(over)), key="over")
            return
        else if (size(keep) < 1) then
            call fail(error, "nothing is kept of a trajectory", key="keep")
            return
        end if
        sweep%scene = scene
        if (allocated(sweep%scene%file)) deallocate (sweep%scene%file)
        allocate (sweep%system, source=system)
        call random%start(seed)
        allocate (sweep%axes(size(over)))
        do i = 1, size(over)
            call new_sweep_axis(sweep%axes(i), over(i), system, random, error)
            if (allocated(error)) then
                error%key = "over"
                error%element = i
                return
            end if
        end do
        if (size(over) == 2) then
            if (sweep%axes(1)%name == sweep%axes(size(over))%name) then
                call fail(error, "both axes change "//trim(sweep%axes(1)%name), key="over")
                return
            end if
        end if
        call read_kept(keep, system, sweep%kept, sweep%columns, events, error)
        if (allocated(error)) then
            error%key = "keep"
            return
        end if
        sweep%after = max(after, scene%t0)
        if (after > scene%t0 + scene%duration) then
            call fail(error, "lies behind the end, t = "//to_text(scene%t0 + scene%duration)// &
                      " s", key="after")
            return
        end if
        call adapt_scene(sweep, events)
    end subroutine new_sweep

    subroutine adapt_scene(sweep, events)
        !! The scene computes what is kept, and no more: no samples where none is looked at, its
        !! own events replaced, and an end at the event where that is all that is kept.
        type(sweep_t), intent(inout) :: sweep
        character(*), intent(in) :: events(:)
        logical :: stops
        integer(i8) :: steps

        sweep%events = size(events)
        associate (scene => sweep%scene, kept => sweep%kept)
            if (scene%method == auto) scene%method = workhorse
            scene%error_estimate = .false.
            if (allocated(scene%events)) deallocate (scene%events)
            if (size(events) > 0) then
                stops = all(kept%kind == keeps_flip .or. kept%kind == keeps_event) .and. &
                        size(kept) == 1
                scene%events = events
                if (stops) scene%events = [character(len(scene%events)) :: &
                                           stopping(events)]
            end if
            if (any(kept%kind == keeps_largest .or. kept%kind == keeps_smallest)) return
            scene%samples = min(scene%samples, 1_i8)
            if (scene%tolerance > 0.0_dp) return
            steps = nint(scene%duration/scene%dt, i8)
            scene%every = max(1_i8, steps)
        end associate
    end subroutine adapt_scene

    pure function stopping(events) result(texts)
        !! The same, each of which ends the run.
        character(*), intent(in) :: events(:)
        character(len(events) + len(" stop")) :: texts(size(events))
        integer :: i

        do i = 1, size(events)
            texts(i) = trim(events(i))//" stop"
        end do
    end function stopping

    pure function trajectories(self) result(n)
        !! How many.
        class(sweep_t), intent(in) :: self
        integer(i8) :: n
        integer :: i

        n = 1
        do i = 1, size(self%axes)
            n = n*size(self%axes(i)%values)
        end do
    end function trajectories

    pure function places(self, index) result(which)
        !! Which value of each axis trajectory number `index` has.
        class(sweep_t), intent(in) :: self
        integer(i8), intent(in) :: index          !! from 1 to `trajectories`
        integer :: which(size(self%axes))
        integer(i8) :: rest
        integer :: i

        rest = index - 1
        do i = size(self%axes), 1, -1
            associate (n => size(self%axes(i)%values))
                which(i) = int(mod(rest, int(n, i8))) + 1
                rest = rest/n
            end associate
        end do
    end function places

    pure function coordinates_of(self, index) result(values)
        !! The values of the axes of trajectory number `index`.
        class(sweep_t), intent(in) :: self
        integer(i8), intent(in) :: index          !! from 1 to `trajectories`
        real(dp) :: values(size(self%axes))
        integer :: i, which(size(self%axes))

        which = self%places(index)
        do i = 1, size(values)
            values(i) = self%axes(i)%values(which(i))
        end do
    end function coordinates_of

    pure subroutine set_start(self, index, q, v, parameters)
        !! Put the values of trajectory number `index` in their places.
        class(sweep_t), intent(in) :: self
        integer(i8), intent(in) :: index                      !! from 1 to `trajectories`
        real(dp), intent(inout) :: q(:), v(:), parameters(:)  !! those of `scene`
        integer :: i, which(size(self%axes))

        which = self%places(index)
        do i = 1, size(which)
            call self%axes(i)%set(which(i), q, v, parameters)
        end do
    end subroutine set_start

    subroutine compute_one(sweep, index, values, error)
        !! What is kept of trajectory number `index`; NaN where it fails, with the reason.
        type(sweep_t), intent(in) :: sweep                !! as `new_sweep` made it
        integer(i8), intent(in) :: index                  !! from 1 to `trajectories`
        real(dp), intent(out) :: values(size(sweep%kept)) !! in the units of `kept`
        type(error_t), allocatable, intent(out) :: error  !! of the start, or of the numbers
        class(system_t), allocatable :: system
        class(reference_t), allocatable :: closed_form
        type(scene_t) :: scene
        real(dp) :: given(size(sweep%scene%v))

        values = ieee_value(values, ieee_quiet_nan)
        scene = sweep%scene
        call sweep%set_start(index, scene%q, scene%v, scene%parameters)
        allocate (system, source=sweep%system)
        if (any(sweep%axes%is_parameter())) call system%configure(scene%parameters, error)
        if (allocated(error)) return
        if (system%constraints > 0) then
            given = scene%v
            call system%complete_velocities(scene%t0, scene%q, given, scene%v, error)
            if (allocated(error)) return
        end if
        if (scene%method == exact .or. any(sweep%kept%kind == keeps_exact_period)) then
            call system%closed_form(scene%t0, scene%q, scene%v, closed_form)
        end if
        if (scene%method == exact) then
            if (.not. allocated(closed_form)) call fail(error, "no closed form is known from "// &
                                                        "this start", status_numbers)
            if (allocated(error)) return
        end if
        call follow(sweep, scene, system, closed_form, values, error)
    end subroutine compute_one

    subroutine follow(sweep, scene, system, closed_form, values, error)
        !! One trajectory of a scene whose numbers are set.
        type(sweep_t), intent(in) :: sweep
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        class(reference_t), allocatable, intent(in) :: closed_form
        real(dp), intent(inout) :: values(:)
        type(error_t), allocatable, intent(out) :: error
        type(trajectory_plan_t) :: plan
        type(keeper_t), target :: keeper
        type(period_t), allocatable, target :: periods(:)
        type(observer_box_t) :: observers(1 + count(sweep%kept%kind == keeps_period))
        real(dp) :: t_end
        integer :: i, n

        if (any(is_lyapunov(sweep%kept%kind))) then
            call keep_lyapunov(sweep, scene, system, values, error)
            if (allocated(error) .or. all(is_lyapunov(sweep%kept%kind))) return
        end if
        call plan_steps(scene, system, plan, error, closed_form)
        if (.not. allocated(error)) call plan_events(scene, system, plan%events, error)
        if (allocated(error)) return
        call keeper%begin(sweep%columns, sweep%events, sweep%after)
        observers(1)%item => keeper
        allocate (periods(size(observers) - 1))
        n = 0
        do i = 1, size(sweep%kept)
            if (sweep%kept(i)%kind /= keeps_period) cycle
            n = n + 1
            periods(n)%coordinate = sweep%kept(i)%coordinate
            observers(1 + n)%item => periods(n)
        end do
        call drive(system, plan%integrator, plan%times, plan%events, observers, plan%q, plan%v, &
                   t_end, error)
        if (allocated(error)) return
        n = 0
        do i = 1, size(values)
            associate (kept => sweep%kept(i))
                select case (kept%kind)
                case (keeps_lyapunov, keeps_lyapunov_error); cycle
                case (keeps_end); values(i) = keeper%row(kept%column)
                case (keeps_largest); values(i) = keeper%high(kept%column)
                case (keeps_smallest); values(i) = keeper%low(kept%column)
                case (keeps_event); values(i) = keeper%met(kept%events(1))
                case (keeps_flip); values(i) = earlier(keeper%met(kept%events(1)), &
                                                       keeper%met(kept%events(2)))
                case (keeps_period)
                    n = n + 1
                    if (periods(n)%period() > 0.0_dp) values(i) = periods(n)%period()
                case default
                    if (.not. allocated(closed_form)) cycle
                    if (closed_form%period > 0.0_dp) values(i) = closed_form%period
                end select
            end associate
        end do
    end subroutine follow

    elemental function is_lyapunov(kind) result(yes)
        !! It is measured by a run of its own.
        integer, intent(in) :: kind
        logical :: yes

        yes = kind == keeps_lyapunov .or. kind == keeps_lyapunov_error
    end function is_lyapunov

    subroutine keep_lyapunov(sweep, scene, system, values, error)
        !! The Lyapunov exponent and its error, by the scene's method and tolerance; where it takes
        !! steps of `dt`, by the workhorse and its own.
        type(sweep_t), intent(in) :: sweep
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        real(dp), intent(inout) :: values(:)
        type(error_t), allocatable, intent(out) :: error
        class(dense_integrator_t), allocatable :: method
        real(dp) :: exponent, uncertainty

        if (scene%tolerance > 0.0_dp .and. scene%method /= exact) then
            call new_adaptive(trim(scene%method), method)
            method%tolerance = scene%tolerance
        else
            call new_adaptive(workhorse, method)
        end if
        call lyapunov_exponent(system, method, scene%t0, sweep%after, scene%t0 + scene%duration, &
                               scene%q, scene%v, exponent, uncertainty, error)
        if (allocated(error)) return
        where (sweep%kept%kind == keeps_lyapunov) values = exponent
        where (sweep%kept%kind == keeps_lyapunov_error) values = uncertainty
    end subroutine keep_lyapunov

    elemental function earlier(a, b) result(t)
        !! The earlier of two times, of which either may be NaN.
        real(dp), intent(in) :: a, b
        real(dp) :: t

        t = min(a, b)
        if (ieee_is_nan(a)) t = b
        if (ieee_is_nan(b)) t = a
    end function earlier
end module lagrangia_sweep
