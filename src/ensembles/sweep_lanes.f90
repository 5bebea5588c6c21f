module lagrangia_sweep_lanes
    !! Trajectories in the lanes of vector registers, where a sweep changes only the start, goes by
    !! steps of `rk4` or by `dop853` and a tolerance, and keeps what the steps themselves show:
    !! columns at the end, when an angle goes over the top, points of a stroboscope. A lane whose
    !! trajectory has ended takes the next.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_attractor, only: strobed_t
    use lagrangia_columns, only: columns_t
    use lagrangia_dop853_lanes, only: dop853_lanes_t
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_kept, only: keeps_attractor, keeps_end, keeps_flip, keeps_wrapped, wrapped
    use lagrangia_kinds, only: dp, i8, lanes
    use lagrangia_lane_method, only: lane_method_t
    use lagrangia_methods, only: new_adaptive
    use lagrangia_rk4_lanes, only: rk4_lanes_t
    use lagrangia_scene, only: scene_t
    use lagrangia_sweep, only: sweep_t
    use lagrangia_time_grid, only: new_sample_times, new_time_grid, time_grid_t
    use lagrangia_tolerance_floor, only: sensible_tolerance
    use lagrangia_workers, only: is_deserted
    implicit none (type, external)
    private
    public :: compute_lanes

    type :: lane_t
        !! The trajectory of one lane.
        integer(i8) :: index = 0                 !! its number
        integer(i8) :: shown = 0                 !! the next sample
        type(columns_t) :: columns
        real(dp), allocatable :: row(:)
        real(dp), allocatable :: flips(:)        !! time of each that is kept, s; NaN: not yet
        real(dp), allocatable :: points(:, :)    !! rows of the points of a stroboscope
        integer :: found = 0                     !! points that are there
        type(strobed_t) :: strobed               !! where an attractor is looked for
    end type lane_t

contains

    subroutine compute_lanes(sweep, first, last, values, failures, first_failed)
        !! What is kept of the trajectories `first` to `last`: the numbers of `compute_one`, but for
        !! rounding. A trajectory that fails is NaN, as is what is left after an interruption.
        type(sweep_t), intent(in) :: sweep       !! one that `fits_lanes`
        integer(i8), intent(in) :: first, last   !! numbers of trajectories
        real(dp), intent(out) :: values(:, :)    !! (`sweep%width()`, last - first + 1)
        integer(i8), intent(out) :: failures     !! trajectories that ended in no finite state
        integer(i8), intent(out) :: first_failed !! number of the first of these, or huge
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        class(lane_method_t), allocatable :: method
        class(dense_integrator_t), allocatable :: adaptive  ! says what tolerances it can keep
        type(time_grid_t) :: times
        type(lane_t) :: lane(lanes)
        real(dp) :: due(lanes)  ! time at which something is to be done, s; huge: the lane is empty
        real(dp) :: after
        integer(i8) :: next
        integer :: angles(count(sweep%kept%kind == keeps_flip))  ! coordinates whose flip is kept
        integer :: i
        logical :: flips_only

        scene = sweep%scene
        call sweep%set_strobe(scene, after, error)  ! `new_sweep` has seen that it can be
        if (scene%tolerance > 0.0_dp) then
            allocate (dop853_lanes_t :: method)
            call new_adaptive("dop853", adaptive)
            call new_sample_times(times, scene%t0, scene%duration, scene%samples, error)
        else
            allocate (rk4_lanes_t :: method)
            call new_time_grid(times, scene%t0, scene%dt, scene%duration, scene%every, error)
        end if
        flips_only = all(sweep%kept%kind == keeps_flip)
        angles = pack([(sweep%kept(i)%coordinate, i=1, size(sweep%kept))], &
                      sweep%kept%kind == keeps_flip)
        call method%prepare(sweep%system, scene)
        failures = 0
        first_failed = huge(first_failed)
        values = ieee_value(1.0_dp, ieee_quiet_nan)
        next = first
        do i = 1, lanes
            call load(i)
        end do
        do while (any(due < huge(due)))
            if (interrupt_status() /= 0) exit
            call method%step(sweep%system)
            do i = 1, size(angles)
                if (any(method%may_flip(angles(i)))) call see_flips(i)
            end do
            if (.not. (any(method%t >= due) .or. any(method%stuck))) cycle
            do i = 1, lanes
                call look_at_lane(i)
            end do
            if (is_deserted()) exit
        end do
    contains
        subroutine look_at_lane(i)
            !! Its points of the stroboscope, and its end.
            integer, intent(in) :: i

            if (due(i) >= huge(due)) return
            if (method%stuck(i)) then
                call count_failure(lane(i)%index)
                call load(i)
            else if (method%t(i) >= due(i)) then
                if (sweep%strobe%given) call see_points(i)
                if (method%t(i) < times%t0 + times%duration .and. due(i) > method%t(i)) return
                call finish(i)
                call load(i)
            end if
        end subroutine look_at_lane

        subroutine count_failure(index)
            !! Of trajectory number `index`, whose numbers are NaN.
            integer(i8), intent(in) :: index

            failures = failures + 1
            first_failed = min(first_failed, index)
        end subroutine count_failure

        subroutine load(i)
            !! The next trajectory that can be begun, if there is one, into lane `i`.
            integer, intent(in) :: i
            real(dp) :: q(size(scene%q)), v(size(scene%v))
            real(dp) :: parameters(size(scene%parameters))

            due(i) = huge(due)
            do
                if (next > last) return
                lane(i)%index = next
                next = next + 1
                q = scene%q
                v = scene%v
                parameters = scene%parameters
                call sweep%set_start(lane(i)%index, q, v, parameters)
                if (.not. allocated(adaptive)) exit
                if (scene%tolerance >= sensible_tolerance(adaptive, sweep%system, scene%t0, &
                                                          scene%duration, q, v)) exit
                call count_failure(lane(i)%index)
            end do
            call method%begin(sweep%system, i, q, v)
            lane(i)%columns = sweep%columns
            if (.not. allocated(lane(i)%row)) allocate (lane(i)%row(size(sweep%columns%items)), &
                lane(i)%flips(count(sweep%kept%kind == keeps_flip)))
            lane(i)%flips = ieee_value(1.0_dp, ieee_quiet_nan)
            if (size(lane(i)%row) > 0) call lane(i)%columns%evaluate(sweep%system, scene%t0, q, v, &
                                                                     0.0_dp, lane(i)%row)
            due(i) = times%t0 + times%duration
            if (.not. sweep%strobe%given) return
            lane(i)%shown = 1
            due(i) = times%sample_time(1_i8)
            lane(i)%found = 0
            if (sweep%keeps_points .and. .not. allocated(lane(i)%points)) then
                allocate (lane(i)%points(size(sweep%kept), sweep%points))
            end if
            if (sweep%attractors) call lane(i)%strobed%begin(sweep%system)
            if (scene%t0 >= after) call see_point(i, scene%t0, q, v)
        end subroutine load

        subroutine see_points(i)
            !! All points of the stroboscope that lane `i` has come to.
            integer, intent(in) :: i
            real(dp) :: q(size(scene%q)), t, v(size(scene%v))

            do while (lane(i)%shown <= times%last_sample())
                t = times%sample_time(lane(i)%shown)
                due(i) = t
                if (t > method%t(i)) return
                lane(i)%shown = lane(i)%shown + 1
                if (t < after) cycle
                call method%state_at(sweep%system, i, t, q, v)
                call see_point(i, t, q, v)
            end do
        end subroutine see_points

        subroutine see_point(i, t, q, v)
            !! A point of the stroboscope.
            integer, intent(in) :: i
            real(dp), intent(in) :: t, q(:), v(:)

            if (sweep%attractors) call lane(i)%strobed%see(q, v)
            if (.not. sweep%keeps_points .or. lane(i)%found == sweep%points) return
            call lane(i)%columns%evaluate(sweep%system, t, q, v, 0.0_dp, lane(i)%row)
            lane(i)%found = lane(i)%found + 1
            call take(lane(i), lane(i)%points(:, lane(i)%found))
        end subroutine see_point

        pure subroutine take(this, numbers)
            !! What is kept, from the latest row and the flips.
            type(lane_t), intent(in) :: this
            real(dp), intent(out) :: numbers(:)
            integer :: flips, k

            flips = 0
            do k = 1, size(sweep%kept)
                select case (sweep%kept(k)%kind)
                case (keeps_flip)
                    flips = flips + 1
                    numbers(k) = this%flips(flips)
                case (keeps_attractor); numbers(k) = 0.0_dp  ! its number is known at the end
                case (keeps_wrapped); numbers(k) = wrapped(this%row(sweep%kept(k)%column))
                case default; numbers(k) = this%row(sweep%kept(k)%column)
                end select
            end do
        end subroutine take

        subroutine finish(i)
            !! Lane `i` has come to its end.
            integer, intent(in) :: i
            real(dp) :: q(size(scene%q)), v(size(scene%v))
            integer :: k, n

            n = size(sweep%kept)
            call method%state_at(sweep%system, i, method%t(i), q, v)
            if (.not. all(ieee_is_finite([q, v]))) then
                call count_failure(lane(i)%index)
                return
            end if
            associate (numbers => values(:, lane(i)%index - first + 1))
                if (sweep%keeps_points) then
                    do k = 1, lane(i)%found
                        numbers((k - 1)*n + 1:k*n) = lane(i)%points(:, k)
                    end do
                    return
                end if
                if (size(lane(i)%row) > 0) call lane(i)%columns%evaluate(sweep%system, &
                    method%t(i), q, v, 0.0_dp, lane(i)%row)
                call take(lane(i), numbers(:n))
                if (sweep%attractors) numbers(n + 1:) = lane(i)%strobed%signature()
            end associate
        end subroutine finish

        subroutine see_flips(k)
            !! Note the times at which the angle of flip `k` first goes over the top; a lane that
            !! waits only for flips has ended with the last of them.
            integer, intent(in) :: k
            logical :: near(lanes)
            integer :: i

            near = method%may_flip(angles(k))
            do i = 1, lanes
                if (.not. near(i) .or. due(i) >= huge(due)) cycle
                if (lane(i)%flips(k) >= scene%t0) cycle
                call method%flip_time(sweep%system, i, angles(k), lane(i)%flips(k))
                if (flips_only .and. all(lane(i)%flips >= scene%t0)) due(i) = method%t(i)
            end do
        end subroutine see_flips
    end subroutine compute_lanes
end module lagrangia_sweep_lanes
