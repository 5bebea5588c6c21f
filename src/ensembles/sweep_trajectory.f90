module lagrangia_sweep_trajectory
    !! What is kept of one trajectory of a sweep.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
    use lagrangia_dense_run, only: drive
    use lagrangia_errors, only: error_t, fail
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kept, only: is_exact_extreme, is_lyapunov, keeper_t, keeps_attractor, &
                              keeps_end, keeps_event, keeps_exact_largest, keeps_exact_period, &
                              keeps_flip, keeps_largest, keeps_lyapunov, keeps_lyapunov_error, &
                              keeps_period, keeps_smallest, keeps_wrapped, kept_t, wrapped
    use lagrangia_kinds, only: dp, i8
    use lagrangia_lyapunov, only: lyapunov_exponent
    use lagrangia_methods, only: new_adaptive
    use lagrangia_observer, only: observer_box_t
    use lagrangia_part_report, only: part_report_t
    use lagrangia_period, only: period_t
    use lagrangia_reference, only: reference_t
    use lagrangia_scene, only: scene_t
    use lagrangia_sweep, only: exponent_method, sweep_t
    use lagrangia_system, only: check_state, system_t
    use lagrangia_text, only: to_text
    use lagrangia_time_grid, only: time_grid_t
    use lagrangia_tolerance_floor, only: sensible_tolerance
    use lagrangia_trajectory_plan, only: plan_events, plan_steps, trajectory_plan_t
    implicit none (type, external)
    private
    public :: compute_one

contains

    subroutine compute_one(sweep, index, values, error, share)
        !! What is kept of trajectory number `index`; NaN where it fails, with the reason.
        type(sweep_t), intent(in) :: sweep                !! as `new_sweep` made it
        integer(i8), intent(in) :: index                  !! from 1 to `trajectories`
        real(dp), intent(out) :: values(:)                !! `sweep%width()` of them
        type(error_t), allocatable, intent(out) :: error  !! of the start, or of the numbers
        real(dp), intent(in), optional :: share(2)
        !! of the block, where this trajectory begins and ends: it is told how far it is
        type(part_report_t), target :: report
        class(system_t), allocatable :: system
        class(reference_t), allocatable :: closed_form
        type(scene_t) :: scene
        real(dp), allocatable :: given(:)
        real(dp) :: after

        values = ieee_value(values, ieee_quiet_nan)
        scene = sweep%scene
        call sweep%set_start(index, scene%q, scene%v, scene%parameters)
        allocate (system, source=sweep%system)
        if (any(sweep%axes%is_parameter())) call system%configure(scene%parameters, error)
        if (.not. allocated(error)) call check_state(system, scene%q, scene%v, error)
        if (allocated(error)) return
        if (system%constraints > 0) then
            call system%check_places(scene%t0, scene%q, error)
            if (allocated(error)) return
            given = scene%v
            if (allocated(scene%given)) given = pack(scene%v, system%free_velocities(scene%t0, &
                                                                                     scene%q))
            call system%complete_velocities(scene%t0, scene%q, given, scene%v, error)
            if (allocated(error)) return
        end if
        call sweep%match_energy(system, scene%q, scene%v, error)
        if (.not. allocated(error)) call sweep%set_strobe(scene, after, error)
        if (allocated(error)) return
        if (any(sweep%kept%kind == keeps_exact_period .or. is_exact_extreme(sweep%kept%kind))) then
            call system%closed_form(scene%t0, scene%q, scene%v, closed_form)
        end if
        if (present(share)) report = part_report_t(from=share(1), to=share(2))
        call follow(sweep, scene, system, closed_form, after, report, values, error)
    end subroutine compute_one

    subroutine follow(sweep, scene, system, closed_form, after, report, values, error)
        !! One trajectory of a scene whose numbers are set; samples before `after` don't count.
        type(sweep_t), intent(in) :: sweep
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        class(reference_t), allocatable, intent(in) :: closed_form
        real(dp), intent(in) :: after
        type(part_report_t), intent(inout), target :: report
        real(dp), intent(inout) :: values(:)
        type(error_t), allocatable, intent(out) :: error
        type(trajectory_plan_t) :: plan
        type(keeper_t), target :: keeper
        type(period_t), allocatable, target :: periods(:)
        type(observer_box_t) :: observers(2 + count(sweep%kept%kind == keeps_period))
        real(dp) :: t_end
        integer :: i, n

        if (any(is_lyapunov(sweep%kept%kind))) then
            call keep_lyapunov(sweep, scene, system, report, values, error)
            if (allocated(error) .or. all(is_lyapunov(sweep%kept%kind))) return
        end if
        call plan_steps(scene, system, plan, error, closed_form)
        if (.not. allocated(error)) call plan_events(scene, system, plan%events, error)
        if (allocated(error)) return
        if (scene%tolerance > 0.0_dp) then
            select type (method => plan%integrator)
            class is (dense_integrator_t); method%most_steps = sweep%most_steps
            end select
        end if
        call keeper%begin(sweep%columns, sweep%events, after)
        keeper%points_kept = sweep%keeps_points
        keeper%strobed = sweep%strobe%given
        keeper%looks_for_attractor = sweep%attractors
        if (sweep%keeps_points) call keeper%make_room(sweep%points)
        observers(1)%item => keeper
        observers(2)%item => report
        allocate (periods(size(observers) - 2))
        n = 0
        do i = 1, size(sweep%kept)
            if (sweep%kept(i)%kind /= keeps_period) cycle
            n = n + 1
            periods(n)%coordinate = sweep%kept(i)%coordinate
            observers(2 + n)%item => periods(n)
        end do
        call drive(system, plan%integrator, plan%times, plan%events, observers, plan%q, plan%v, &
                   t_end, error)
        if (keeper%full .and. allocated(error)) deallocate (error)
        if (allocated(error)) return
        if (sweep%keeps_points) then
            call take_points(sweep, keeper, values)
            return
        end if
        if (sweep%attractors) values(size(sweep%kept) + 1:) = keeper%strobed_points%signature()
        n = 0
        do i = 1, size(sweep%kept)
            associate (kept => sweep%kept(i))
                select case (kept%kind)
                case (keeps_lyapunov, keeps_lyapunov_error); cycle
                case (keeps_attractor); values(i) = 0.0_dp  ! its number is known at the end
                case (keeps_end); values(i) = keeper%row(kept%column)
                case (keeps_wrapped); values(i) = wrapped(keeper%row(kept%column))
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
                    if (is_exact_extreme(kept%kind)) then
                        values(i) = exact_extreme(closed_form, plan%times, after, t_end, &
                                                  system%ndof, kept)
                    else if (closed_form%period > 0.0_dp) then
                        values(i) = closed_form%period
                    end if
                end select
            end associate
        end do
    end subroutine follow

    pure function exact_extreme(closed_form, times, after, t_end, n, kept) result(extreme)
        !! The largest or smallest value of a coordinate by the closed form, at the samples from
        !! `after` to the end.
        class(reference_t), intent(in) :: closed_form
        type(time_grid_t), intent(in) :: times
        real(dp), intent(in) :: after, t_end
        integer, intent(in) :: n          !! degrees of freedom
        type(kept_t), intent(in) :: kept  !! which coordinate, and which extreme
        real(dp) :: extreme
        real(dp) :: q(n), v(n), t
        integer(i8) :: k

        extreme = ieee_value(extreme, ieee_quiet_nan)
        if (.not. closed_form%has_state) return
        do k = 0, times%last_sample()
            t = times%sample_time(k)
            if (t < after) cycle
            if (t > t_end) exit
            call closed_form%state_at(t, q, v)
            associate (x => q(kept%coordinate))
                if (ieee_is_nan(extreme)) extreme = x
                extreme = merge(max(extreme, x), min(extreme, x), kept%kind == keeps_exact_largest)
            end associate
        end do
    end function exact_extreme

    pure subroutine take_points(sweep, keeper, values)
        !! All numbers of the first point, then of the second; NaN where there are fewer points.
        type(sweep_t), intent(in) :: sweep
        type(keeper_t), intent(in) :: keeper
        real(dp), intent(inout) :: values(:)
        integer :: i, k, n

        n = size(sweep%kept)
        do k = 1, keeper%found
            do i = 1, n
                associate (value => values((k - 1)*n + i))
                    value = keeper%points(sweep%kept(i)%column, k)
                    if (sweep%kept(i)%kind == keeps_wrapped) value = wrapped(value)
                end associate
            end do
        end do
    end subroutine take_points

    subroutine keep_lyapunov(sweep, scene, system, report, values, error)
        !! The Lyapunov exponent and its error, by the scene's method and tolerance; where it takes
        !! steps of `dt`, by the workhorse and its own.
        type(sweep_t), intent(in) :: sweep
        type(scene_t), intent(in) :: scene
        class(system_t), intent(in) :: system
        type(part_report_t), intent(inout) :: report
        real(dp), intent(inout) :: values(:)
        type(error_t), allocatable, intent(out) :: error
        class(dense_integrator_t), allocatable :: method
        real(dp) :: exponent, least, uncertainty

        call new_adaptive(exponent_method(scene), method)
        if (scene%tolerance > 0.0_dp) then
            method%tolerance = scene%tolerance
            least = sensible_tolerance(method, system, scene%t0, scene%duration, scene%q, scene%v)
            if (scene%tolerance < least) call fail(error, to_text(scene%tolerance)//" is less "// &
                "than rounding of so large coordinates or times leaves: the smallest sensible "// &
                "tolerance is "//to_text(least), key="tolerance")
            if (allocated(error)) return
        end if
        method%most_steps = sweep%most_steps
        call lyapunov_exponent(system, method, scene%t0, sweep%after, scene%t0 + scene%duration, &
                               scene%q, scene%v, exponent, uncertainty, error, sweep%variational, &
                               report)
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
end module lagrangia_sweep_trajectory
