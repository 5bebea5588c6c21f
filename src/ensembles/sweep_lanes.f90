module lagrangia_sweep_lanes
    !! Trajectories in the lanes of vector registers, where a sweep changes only the start, takes
    !! steps of `rk4`, and keeps what the steps themselves show: columns at the end, and when an
    !! angle goes over the top. A lane whose trajectory has ended takes the next one.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_columns, only: columns_t
    use lagrangia_hermite, only: quintic
    use lagrangia_kept, only: keeps_end, keeps_flip
    use lagrangia_kinds, only: dp, i8, lanes
    use lagrangia_rk4_lanes, only: rk4_lanes_t
    use lagrangia_stepwise, only: whole_steps
    use lagrangia_sweep, only: sweep_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: compute_lanes, fits_lanes

    real(dp), parameter :: pi = acos(-1.0_dp)
    integer(i8), parameter :: never = 10_i8**18  !! more steps than a trajectory has

    type :: lane_t
        !! The trajectory of one lane.
        integer(i8) :: index = 0                 !! its number
        type(columns_t) :: columns
        real(dp), allocatable :: row(:)
        real(dp), allocatable :: flips(:)        !! time of each that is kept, s; NaN: not yet
    end type lane_t

contains

    pure function fits_lanes(sweep) result(yes)
        !! Can these trajectories be computed in lanes?
        type(sweep_t), intent(in) :: sweep  !! as `new_sweep` made it
        logical :: yes

        yes = sweep%scene%method == "rk4" .and. .not. sweep%scene%compensated .and. &
              sweep%scene%tolerance <= 0.0_dp .and. sweep%system%contacts == 0 .and. &
              sweep%system%constraints == 0 .and. .not. any(sweep%axes%is_parameter()) .and. &
              all(sweep%kept%kind == keeps_end .or. sweep%kept%kind == keeps_flip)
    end function fits_lanes

    subroutine compute_lanes(sweep, first, last, values, failures)
        !! What is kept of the trajectories `first` to `last`: the numbers of `compute_one`, but for
        !! rounding. A trajectory that fails is NaN.
        type(sweep_t), intent(in) :: sweep       !! one that `fits_lanes`
        integer(i8), intent(in) :: first, last   !! numbers of trajectories
        real(dp), intent(out) :: values(size(sweep%kept), last - first + 1)  !! one column each
        integer(i8), intent(out) :: failures     !! trajectories that ended in no finite state
        type(rk4_lanes_t) :: method
        type(lane_t) :: lane(lanes)
        real(dp) :: t(lanes), h(lanes), q(lanes, sweep%system%ndof), v(lanes, sweep%system%ndof)
        real(dp) :: q_old(lanes, sweep%system%ndof), v_old(lanes, sweep%system%ndof)
        real(dp) :: rest
        integer(i8) :: next, steps
        integer(i8) :: done(lanes), left(lanes)  ! steps; `left` near `never`: the lane is empty
        integer :: angles(count(sweep%kept%kind == keeps_flip))  ! coordinates whose flip is kept
        integer :: i
        logical :: flips_only

        associate (scene => sweep%scene, system => sweep%system)
            call whole_steps(scene%duration, scene%dt, steps, rest)
            flips_only = all(sweep%kept%kind == keeps_flip)
            angles = pack([(sweep%kept(i)%coordinate, i=1, size(sweep%kept))], &
                          sweep%kept%kind == keeps_flip)
            call method%prepare(system)
            failures = 0
            next = first
            q = spread(scene%q, 1, lanes)
            v = spread(scene%v, 1, lanes)
            t = scene%t0
            h = scene%dt
            done = 0
            do i = 1, lanes
                call load(i)
            end do
            do while (any(left < never))
                q_old = q
                v_old = v
                call method%step(system, t, h, q, v)
                left = left - 1
                done = done + 1
                t = scene%t0 + done*scene%dt
                if (over_the_top()) call see_flips()
                if (rest > 0.0_dp) h = merge(rest, scene%dt, left == 1)
                if (all(left > 0)) cycle
                do i = 1, lanes
                    if (left(i) > 0) cycle
                    call finish(i)
                    call load(i)
                end do
            end do
        end associate
    contains
        subroutine load(i)
            !! The next trajectory, if there is one, into lane `i`.
            integer, intent(in) :: i
            real(dp) :: q0(size(sweep%scene%q)), v0(size(sweep%scene%v))
            real(dp) :: parameters(size(sweep%scene%parameters))

            left(i) = huge(left)
            if (next > last) return
            lane(i)%index = next
            next = next + 1
            done(i) = 0
            left(i) = steps + merge(1, 0, rest > 0.0_dp)
            q0 = sweep%scene%q
            v0 = sweep%scene%v
            parameters = sweep%scene%parameters
            call sweep%set_start(lane(i)%index, q0, v0, parameters)
            q(i, :) = q0
            v(i, :) = v0
            t(i) = sweep%scene%t0
            h(i) = sweep%scene%dt
            if (left(i) == 1 .and. rest > 0.0_dp) h(i) = rest
            lane(i)%columns = sweep%columns
            if (.not. allocated(lane(i)%row)) allocate (lane(i)%row(size(sweep%columns%items)), &
                lane(i)%flips(count(sweep%kept%kind == keeps_flip)))
            lane(i)%flips = ieee_value(1.0_dp, ieee_quiet_nan)
            if (size(lane(i)%row) > 0) call lane(i)%columns%evaluate(sweep%system, t(i), q0, v0, &
                                                                     0.0_dp, lane(i)%row)
        end subroutine load

        subroutine finish(i)
            !! Lane `i` has come to its end.
            integer, intent(in) :: i
            real(dp) :: q1(size(sweep%scene%q)), v1(size(sweep%scene%v))
            integer :: k, flips

            q1 = q(i, :)
            v1 = v(i, :)
            associate (kept => values(:, lane(i)%index - first + 1))
                kept = ieee_value(kept, ieee_quiet_nan)
                if (.not. all(ieee_is_finite([q1, v1]))) then
                    failures = failures + 1
                    return
                end if
                if (size(lane(i)%row) > 0) call lane(i)%columns%evaluate(sweep%system, &
                    sweep%scene%t0 + sweep%scene%duration, q1, v1, 0.0_dp, lane(i)%row)
                flips = 0
                do k = 1, size(kept)
                    if (sweep%kept(k)%kind == keeps_flip) then
                        flips = flips + 1
                        kept(k) = lane(i)%flips(flips)
                    else
                        kept(k) = lane(i)%row(sweep%kept(k)%column)
                    end if
                end do
            end associate
        end subroutine finish

        pure function over_the_top() result(yes)
            !! Has an angle of any lane come beyond plus or minus pi?
            logical :: yes
            integer :: i, k

            yes = .false.
            do k = 1, size(angles)
                do i = 1, lanes
                    yes = yes .or. (abs(q(i, angles(k))) >= pi .and. &
                                    q_old(i, angles(k))*sign(1.0_dp, q(i, angles(k))) < pi)
                end do
            end do
        end function over_the_top

        subroutine see_flips()
            !! Note the time of each angle's first flip; a lane that waits only for them has ended.
            real(dp), dimension(size(q, 2)) :: q0, q1, v0, v1
            integer :: i, k

            do i = 1, lanes
                if (left(i) > never) cycle
                q0 = q_old(i, :)
                v0 = v_old(i, :)
                q1 = q(i, :)
                v1 = v(i, :)
                do k = 1, size(angles)
                    associate (c => angles(k))
                        if (lane(i)%flips(k) >= sweep%scene%t0 .or. abs(q1(c)) < pi) cycle
                        if (q0(c)*sign(1.0_dp, q1(c)) >= pi) cycle
                        lane(i)%flips(k) = time_of_flip(sweep%system, sweep%scene%t0 + &
                            (done(i) - 1)*sweep%scene%dt, h(i), c, q0, v0, q1, v1)
                    end associate
                end do
                if (flips_only .and. all(lane(i)%flips >= sweep%scene%t0)) left(i) = 0
            end do
        end subroutine see_flips
    end subroutine compute_lanes

    function time_of_flip(system, t, h, c, q_old, v_old, q, v) result(time)
        !! Where in a step the quintic of both ends of coordinate `c` meets plus or minus pi.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, h                           !! start and length of the step, s
        integer, intent(in) :: c                               !! coordinate
        real(dp), intent(in) :: q_old(system%ndof), v_old(system%ndof)  !! the state at its start
        real(dp), intent(in) :: q(system%ndof), v(system%ndof)          !! and at its end
        real(dp) :: time
        real(dp) :: a(size(q)), a_old(size(q)), c5(0:5), high, low, s, way
        integer :: i

        call system%accelerations(t, q_old, v_old, a_old)
        call system%accelerations(t + h, q, v, a)
        c5 = quintic(h, [q_old(c), v_old(c), a_old(c)], [q(c), v(c), a(c)])
        way = sign(1.0_dp, q(c))
        low = 0.0_dp
        high = 1.0_dp
        do i = 1, 60
            s = 0.5_dp*(low + high)
            if (way*(c5(0) + s*(c5(1) + s*(c5(2) + s*(c5(3) + s*(c5(4) + s*c5(5)))))) < pi) then
                low = s
            else
                high = s
            end if
        end do
        time = t + h*high
    end function time_of_flip
end module lagrangia_sweep_lanes
