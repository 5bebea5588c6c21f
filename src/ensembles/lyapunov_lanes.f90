module lagrangia_lyapunov_lanes
    !! Largest Lyapunov exponents of a sweep, by `dop853` with eight motions and their displacements
    !! in the lanes of vector registers. What they are is told in `lagrangia_lyapunov`.
    !!
    !! The equations of a displacement are linear in it: where it has length 1 again, so have its
    !! slopes, and the motion goes on without a new start.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_dop853_lanes, only: dop853_lanes_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_kept, only: keeps_lyapunov, keeps_lyapunov_error
    use lagrangia_kinds, only: dp, i8, lanes
    use lagrangia_lane_queue, only: lane_queue_t, seldom
    use lagrangia_lyapunov, only: displace, displaced_t, longest, mean_rate, new_displaced, &
                                  shortest, windows
    use lagrangia_methods, only: new_adaptive
    use lagrangia_scene, only: scene_t
    use lagrangia_sweep, only: sweep_t
    use lagrangia_system, only: check_state
    use lagrangia_tolerance_floor, only: sensible_tolerance
    use lagrangia_workers, only: is_deserted
    implicit none (type, external)
    private
    public :: compute_exponents

    type, extends(displaced_t) :: displaced_lanes_t
        !! Motions of systems with different parameters, one a lane.
        real(dp), allocatable :: parameters(:, :)  !! of each lane
    contains
        procedure :: accelerations_lanes
    end type displaced_lanes_t

    type :: lane_t
        !! The motion of one lane.
        integer(i8) :: index = 0             !! number of the trajectory
        integer :: window = 0                !! number 0 is before `after`
        real(dp) :: growth = 0.0_dp          !! logarithm, since the window began
        real(dp) :: rates(windows) = 0.0_dp  !! 1/s
    end type lane_t

contains

    subroutine compute_exponents(sweep, first, last, values, failures, first_failed)
        !! What is kept of the trajectories `first` to `last`: the exponents of `compute_one`, but
        !! for the tolerance. A trajectory that fails is NaN, as is what is left after an
        !! interruption.
        type(sweep_t), intent(in) :: sweep       !! one that `follows_displacements`
        integer(i8), intent(in) :: first, last   !! numbers of trajectories
        real(dp), intent(out) :: values(:, :)    !! (`sweep%width()`, last - first + 1)
        integer(i8), intent(out) :: failures     !! trajectories that failed
        integer(i8), intent(out) :: first_failed !! number of the first of these, or huge
        type(dop853_lanes_t) :: method
        class(dense_integrator_t), allocatable :: adaptive  ! says what tolerances it can keep
        type(displaced_lanes_t) :: all_lanes     ! what is stepped
        type(displaced_t) :: single              ! the motion that begins
        type(lane_t) :: lane(lanes)
        type(scene_t) :: scene, start            ! of the motion that begins, without displacement
        real(dp) :: due(lanes)  ! time at which the window ends, s; huge: the lane is empty
        real(dp) :: length(lanes)
        type(lane_queue_t) :: queue
        integer :: i, rounds

        scene = sweep%scene
        start = sweep%scene
        call new_displaced(single, sweep%system, scene%q)
        single%exact = sweep%variational
        call new_displaced(all_lanes, sweep%system, scene%q)
        all_lanes%exact = sweep%variational
        all_lanes%parameters = spread(sweep%variational%parameters, 1, lanes)
        call method%prepare(all_lanes)
        method%most_steps = sweep%most_steps
        call new_adaptive("dop853", adaptive)
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
                call queue%report(pack((method%t - scene%t0)/scene%duration, due < huge(due)))
            end if
            call method%step(all_lanes)
            call find_lengths(method%y, length)
            if (.not. (any(method%t >= due) .or. any(method%stuck) .or. &
                       any(due < huge(due) .and. .not. &
                           (length > shortest .and. length < longest)))) cycle
            do i = 1, lanes
                if (due(i) < huge(due)) call look_at_lane(i)
            end do
        end do
        failures = queue%failures
        first_failed = queue%first_failed
    contains
        subroutine look_at_lane(i)
            !! Its displacement, and the end of its window.
            integer, intent(in) :: i
            integer :: k, n

            if (method%stuck(i) .or. &
                .not. (ieee_is_finite(length(i)) .and. length(i) > 0.0_dp)) then
                call queue%count_failure(lane(i)%index)
                call load(i)
                return
            end if
            if (method%t(i) < due(i) .and. length(i) > shortest .and. length(i) < longest) return
            n = sweep%system%ndof
            associate (this => lane(i))
                this%growth = this%growth + log(length(i))
                call method%scale(i, [(k, k=n + 1, 2*n)], 1.0_dp/length(i))
                if (method%t(i) < due(i)) return
                if (this%window > 0) this%rates(this%window) = this%growth*windows/ &
                                                               (end_of(windows) - end_of(0))
                this%growth = 0.0_dp
                this%window = this%window + 1
                if (this%window <= windows) then
                    due(i) = end_of(this%window)
                    call method%go_on(i, due(i))
                else
                    call finish(this)
                    call load(i)
                end if
            end associate
        end subroutine look_at_lane

        subroutine finish(this)
            !! The exponent is known.
            type(lane_t), intent(in) :: this
            real(dp) :: exponent, uncertainty

            call mean_rate(this%rates, exponent, uncertainty)
            associate (numbers => values(:, this%index - first + 1))
                where (sweep%kept%kind == keeps_lyapunov) numbers = exponent
                where (sweep%kept%kind == keeps_lyapunov_error) numbers = uncertainty
            end associate
        end subroutine finish

        subroutine load(i)
            !! The next trajectory that can be begun, if there is one, into lane `i`.
            integer, intent(in) :: i
            type(error_t), allocatable :: error
            logical :: fits, there

            due(i) = huge(due)
            do
                call queue%take(lane(i)%index, there)
                if (.not. there) return
                call set_start(lane(i)%index, fits, error)
                if (fits .and. .not. allocated(error)) exit
                call queue%compute_alone(sweep, lane(i)%index, values, error)
            end do
            call begin(i)
        end subroutine load

        subroutine set_start(index, fits, error)
            !! Parameters and start of a trajectory. It may be one of the few that do not fit, by
            !! its parameters.
            integer(i8), intent(in) :: index
            logical, intent(out) :: fits
            type(error_t), allocatable, intent(out) :: error

            fits = .true.
            scene%q = sweep%scene%q
            scene%v = sweep%scene%v
            scene%parameters = sweep%scene%parameters
            call sweep%set_start(index, scene%q, scene%v, scene%parameters)
            if (any(sweep%axes%is_parameter())) then
                call single%configure(scene%parameters, error)
                if (allocated(error)) return
                call single%exact%fits(single%of, fits)
                if (.not. fits) return
            end if
            call check_state(single%of, scene%q, scene%v, error)
            if (allocated(error)) return
            call sweep%match_energy(single%of, scene%q, scene%v, error)
            if (allocated(error)) return
            if (scene%tolerance >= sensible_tolerance(adaptive, single%of, scene%t0, &
                                                      scene%duration, scene%q, scene%v)) return
            call fail(error, "the tolerance is less than rounding")
        end subroutine set_start

        subroutine begin(i)
            !! The motion of `scene`, and a displacement of it, in lane `i`.
            integer, intent(in) :: i
            real(dp), dimension(2*sweep%system%ndof) :: q, v

            call displace(scene%q, scene%v, sweep%after > scene%t0, q, v)
            start%q = q
            start%v = v
            lane(i)%window = merge(0, 1, sweep%after > scene%t0)
            lane(i)%growth = 0.0_dp
            due(i) = end_of(lane(i)%window)
            start%duration = due(i) - start%t0
            all_lanes%parameters(i, :) = single%exact%parameters
            call method%begin(single, i, start)
            call method%go_on(i, due(i))
        end subroutine begin

        pure function end_of(window) result(t)
            !! Of a window, s.
            integer, intent(in) :: window
            real(dp) :: t

            t = sweep%after + (sweep%scene%t0 + sweep%scene%duration - sweep%after)*window/windows
        end function end_of
    end subroutine compute_exponents

    pure subroutine find_lengths(y, length)
        !! Of the displacements.
        real(dp), intent(in) :: y(:, :)           !! states, (lanes, 4 ndof)
        real(dp), intent(out) :: length(lanes)
        integer :: i, n

        n = size(y, 2)/4
        length = 0.0_dp
        do i = 1, n
            length = length + y(:, n + i)**2 + y(:, 3*n + i)**2
        end do
        length = sqrt(length)
    end subroutine find_lengths

    pure subroutine accelerations_lanes(self, t, q, v, a)
        !! Each lane's own, and their derivatives along the displacement.
        class(displaced_lanes_t), intent(in) :: self
        real(dp), intent(in) :: t(lanes), q(lanes, self%ndof), v(lanes, self%ndof)
        real(dp), intent(out) :: a(lanes, self%ndof)

        call self%exact%displaced_lanes(t, q, v, self%parameters, a)
    end subroutine accelerations_lanes
end module lagrangia_lyapunov_lanes
