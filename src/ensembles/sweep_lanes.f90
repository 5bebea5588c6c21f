module lagrangia_sweep_lanes
    !! Trajectories in the lanes of vector registers, where a sweep goes by steps of `rk4` or of a
    !! splitting method, or by `dop853` and a tolerance, and keeps what the steps themselves show:
    !! columns at the end and their extremes, when an angle goes over the top, points of a
    !! stroboscope. A lane whose trajectory has ended takes the next.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_attractor, only: strobed_t
    use lagrangia_columns, only: columns_t
    use lagrangia_composition_lanes, only: composition_lanes_t, new_composition_lanes
    use lagrangia_dop853_lanes, only: dop853_lanes_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_kept, only: keeps_attractor, keeps_flip, keeps_largest, keeps_smallest, &
                              keeps_wrapped, wrapped
    use lagrangia_kinds, only: dp, i8, lanes
    use lagrangia_lane_method, only: lane_method_t
    use lagrangia_lane_queue, only: lane_queue_t, seldom
    use lagrangia_lane_systems, only: lane_systems_t, new_lane_systems
    use lagrangia_methods, only: new_adaptive
    use lagrangia_rk4_lanes, only: rk4_lanes_t
    use lagrangia_scene, only: scene_t
    use lagrangia_sweep, only: sweep_t
    use lagrangia_system, only: reduced_t, system_t
    use lagrangia_time_grid, only: new_sample_times, new_time_grid, time_grid_t
    use lagrangia_tolerance_floor, only: sensible_tolerance
    use lagrangia_workers, only: is_deserted
    implicit none (type, external)
    private
    public :: compute_lanes

    type :: lane_t
        !! The trajectory of one lane.
        integer(i8) :: index = 0                 !! its number
        class(system_t), allocatable :: own      !! its system, where that is not the sweep's
        type(time_grid_t) :: times
        real(dp) :: after = 0.0_dp               !! samples before this time don't count, s
        integer(i8) :: shown = 0                 !! the next sample
        type(columns_t) :: columns
        real(dp), allocatable :: row(:)
        real(dp), allocatable :: low(:), high(:) !! of each column
        real(dp), allocatable :: flips(:)        !! time of each that is kept, s; NaN: not yet
        real(dp), allocatable :: points(:, :)    !! rows of the points of a stroboscope
        integer :: found = 0                     !! points that are there
        type(strobed_t) :: strobed               !! where an attractor is looked for
    end type lane_t

contains

    subroutine compute_lanes(sweep, first, last, values, failures, first_failed)
        !! What is kept of the trajectories `first` to `last`: the numbers of `compute_one`, but for
        !! rounding. A trajectory that fails is NaN, as is what is left after an interruption.
        type(sweep_t), intent(in), target :: sweep  !! one that `fits_lanes`
        integer(i8), intent(in) :: first, last      !! numbers of trajectories
        real(dp), intent(out) :: values(:, :)       !! (`sweep%width()`, last - first + 1)
        integer(i8), intent(out) :: failures        !! trajectories that ended in no finite state
        integer(i8), intent(out) :: first_failed    !! number of the first of these, or huge
        type(scene_t) :: scene  ! of the trajectory that is begun
        class(lane_method_t), allocatable :: method
        type(composition_lanes_t) :: composition
        class(dense_integrator_t), allocatable :: adaptive  ! says what tolerances it can keep
        type(lane_t), target :: lane(lanes)
        type(lane_systems_t), target :: all_own   ! the lanes' own systems together
        class(system_t), pointer :: all_systems   ! what is stepped
        real(dp) :: due(lanes)  ! time at which something is to be done, s; huge: the lane is empty
        type(lane_queue_t) :: queue
        integer :: angles(count(sweep%kept%kind == keeps_flip))  ! coordinates whose flip is kept
        integer :: i, rounds
        logical :: extremes, flips_only, own_systems, samples
        logical :: splits  ! by a method that no velocity may push

        scene = sweep%scene
        splits = .false.
        if (scene%tolerance > 0.0_dp) then
            allocate (dop853_lanes_t :: method)
            call new_adaptive("dop853", adaptive)
            select type (method)
            class is (dop853_lanes_t); method%most_steps = sweep%most_steps
            end select
        else if (scene%method == "rk4") then
            allocate (rk4_lanes_t :: method)
        else
            splits = .true.
            call new_composition_lanes(composition, scene%method)
            allocate (method, source=composition)
        end if
        own_systems = any(sweep%axes%is_parameter())
        all_systems => sweep%system
        if (own_systems) then
            call new_lane_systems(all_own, sweep%system, sweep%variational)
            all_systems => all_own
        end if
        extremes = any(sweep%kept%kind == keeps_largest .or. sweep%kept%kind == keeps_smallest)
        samples = sweep%strobe%given .or. extremes
        flips_only = all(sweep%kept%kind == keeps_flip)
        angles = pack([(sweep%kept(i)%coordinate, i=1, size(sweep%kept))], &
                      sweep%kept%kind == keeps_flip)
        call method%prepare(sweep%system)
        values = ieee_value(1.0_dp, ieee_quiet_nan)
        queue = lane_queue_t(first, first, last)
        do i = 1, lanes
            call load(i)
        end do
        rounds = 0
        do while (any(due < huge(due)))
            if (interrupt_status() /= 0) exit
            rounds = mod(rounds + 1, seldom)
            if (rounds == 0) then
                if (is_deserted()) exit
                call report_lanes()
            end if
            call method%step(all_systems)
            do i = 1, size(angles)
                if (any(method%may_flip(angles(i)))) call see_flips(i)
            end do
            if (.not. (any(method%t >= due) .or. any(method%stuck))) cycle
            do i = 1, lanes
                call look_at_lane(i)
            end do
        end do
        failures = queue%failures
        first_failed = queue%first_failed
    contains
        subroutine report_lanes()
            !! How far they all are.
            real(dp) :: parts(lanes)
            integer :: i

            do i = 1, lanes
                if (due(i) < huge(due)) parts(i) = (method%t(i) - scene%t0)/ &
                                                   (end_of(lane(i)%times) - scene%t0)
            end do
            call queue%report(pack(parts, due < huge(due)))
        end subroutine report_lanes

        subroutine look_at_lane(i)
            !! Its samples, and its end.
            integer, intent(in) :: i

            if (due(i) >= huge(due)) return
            if (method%stuck(i)) then
                call queue%count_failure(lane(i)%index)
                call load(i)
            else if (method%t(i) >= due(i)) then
                if (samples) call see_samples(i)
                if (method%t(i) < end_of(lane(i)%times) .and. due(i) > method%t(i)) return
                call finish(i)
                call load(i)
            end if
        end subroutine look_at_lane

        subroutine load(i)
            !! The next trajectory that can be begun, if there is one, into lane `i`.
            integer, intent(in) :: i
            type(error_t), allocatable :: error
            logical :: fits, there

            due(i) = huge(due)
            do
                call queue%take(lane(i)%index, there)
                if (.not. there) return
                call set_scene(i, fits, error)
                if (fits .and. .not. allocated(error)) exit
                call queue%compute_alone(sweep, lane(i)%index, values, error)
            end do
            call begin(i)
        end subroutine load

        subroutine set_scene(i, fits, error)
            !! System, start and times of the trajectory that lane `i` is to have. It may be one of
            !! the few that do not fit: by its parameters.
            integer, intent(in) :: i
            logical, intent(out) :: fits
            type(error_t), allocatable, intent(out) :: error
            class(system_t), pointer :: system
            class(reduced_t), allocatable :: reduced

            fits = .true.
            scene%q = sweep%scene%q
            scene%v = sweep%scene%v
            scene%parameters = sweep%scene%parameters
            scene%dt = sweep%scene%dt
            scene%duration = sweep%scene%duration
            scene%samples = sweep%scene%samples
            scene%every = sweep%scene%every
            call sweep%set_start(lane(i)%index, scene%q, scene%v, scene%parameters)
            if (own_systems) then
                if (.not. allocated(lane(i)%own)) allocate (lane(i)%own, source=sweep%system)
                call lane(i)%own%configure(scene%parameters, error)
                if (allocated(error)) return
                call all_own%take(i, lane(i)%own, fits)
                if (fits .and. allocated(adaptive)) then
                    call lane(i)%own%reduce(reduced)
                    fits = .not. allocated(reduced)
                end if
                if (splits) fits = fits .and. .not. lane(i)%own%velocity_forces
                if (.not. fits) return
            end if
            system => system_of(i)
            call sweep%match_energy(system, scene%q, scene%v, error)
            if (.not. allocated(error)) call sweep%set_strobe(scene, lane(i)%after, error)
            if (allocated(error)) return
            if (scene%tolerance > 0.0_dp) then
                call new_sample_times(lane(i)%times, scene%t0, scene%duration, scene%samples, error)
            else
                call new_time_grid(lane(i)%times, scene%t0, scene%dt, scene%duration, &
                                   scene%every, error)
            end if
            if (allocated(error) .or. .not. allocated(adaptive)) return
            if (scene%tolerance >= sensible_tolerance(adaptive, system, scene%t0, scene%duration, &
                                                      scene%q, scene%v)) return
            call fail(error, "the tolerance is less than rounding")
        end subroutine set_scene

        function system_of(i) result(system)
            !! That of lane `i`.
            integer, intent(in) :: i
            class(system_t), pointer :: system

            system => sweep%system
            if (own_systems) system => lane(i)%own
        end function system_of

        subroutine begin(i)
            !! The trajectory of `scene` in lane `i`.
            integer, intent(in) :: i
            class(system_t), pointer :: system

            system => system_of(i)
            call method%begin(system, i, scene)
            associate (this => lane(i), q => scene%q, v => scene%v)
                this%columns = sweep%columns
                if (.not. allocated(this%row)) allocate ( &
                    this%row(size(sweep%columns%items)), this%low(size(sweep%columns%items)), &
                    this%high(size(sweep%columns%items)), this%flips(size(angles)))
                this%flips = ieee_value(1.0_dp, ieee_quiet_nan)
                this%low = huge(1.0_dp)
                this%high = -huge(1.0_dp)
                if (size(this%row) > 0) call this%columns%evaluate(system, scene%t0, q, v, &
                                                                   0.0_dp, this%row)
                due(i) = end_of(this%times)
                if (.not. samples) return
                this%shown = 1
                due(i) = this%times%sample_time(1_i8)
                this%found = 0
                if (sweep%keeps_points .and. .not. allocated(this%points)) then
                    allocate (this%points(size(sweep%kept), sweep%points))
                end if
                if (sweep%attractors) call this%strobed%begin(system)
                if (scene%t0 >= this%after) call see_sample(i, scene%t0, q, v)
            end associate
        end subroutine begin

        subroutine see_samples(i)
            !! All that lane `i` has come to.
            integer, intent(in) :: i
            real(dp) :: q(size(scene%q)), t, v(size(scene%v))

            do while (lane(i)%shown <= lane(i)%times%last_sample())
                t = lane(i)%times%sample_time(lane(i)%shown)
                due(i) = t
                if (t > method%t(i)) return
                lane(i)%shown = lane(i)%shown + 1
                if (t < lane(i)%after) cycle
                call method%state_at(system_of(i), i, t, q, v)
                call see_sample(i, t, q, v)
            end do
        end subroutine see_samples

        subroutine see_sample(i, t, q, v)
            !! One that counts.
            integer, intent(in) :: i
            real(dp), intent(in) :: t, q(:), v(:)

            if (sweep%attractors) call lane(i)%strobed%see(q, v)
            if (.not. (sweep%keeps_points .or. extremes)) return
            associate (this => lane(i))
                call this%columns%evaluate(system_of(i), t, q, v, 0.0_dp, this%row)
                this%low = min(this%low, this%row)
                this%high = max(this%high, this%row)
                if (.not. sweep%keeps_points) return
                this%found = this%found + 1
                call take(this, this%points(:, this%found))
            end associate
        end subroutine see_sample

        pure subroutine take(this, numbers)
            !! What is kept, from the latest row, the extremes and the flips.
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
                case (keeps_largest); numbers(k) = this%high(sweep%kept(k)%column)
                case (keeps_smallest); numbers(k) = this%low(sweep%kept(k)%column)
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
            call method%state_at(system_of(i), i, method%t(i), q, v)
            if (.not. all(ieee_is_finite([q, v]))) then
                call queue%count_failure(lane(i)%index)
                return
            end if
            associate (numbers => values(:, lane(i)%index - first + 1))
                if (sweep%keeps_points) then
                    do k = 1, lane(i)%found
                        numbers((k - 1)*n + 1:k*n) = lane(i)%points(:, k)
                    end do
                    return
                end if
                if (size(lane(i)%row) > 0) call lane(i)%columns%evaluate(system_of(i), &
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
                call method%flip_time(system_of(i), i, angles(k), lane(i)%flips(k))
                if (flips_only .and. all(lane(i)%flips >= scene%t0)) due(i) = method%t(i)
            end do
        end subroutine see_flips
    end subroutine compute_lanes

    pure function end_of(times) result(t)
        !! Of a trajectory, s.
        type(time_grid_t), intent(in) :: times
        real(dp) :: t

        t = times%t0 + times%duration
    end function end_of
end module lagrangia_sweep_lanes
