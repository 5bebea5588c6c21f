module lagrangia_sweep_lanes
    !! Trajectories in the lanes of vector registers, where a sweep changes only the start, takes
    !! steps of `rk4`, and keeps what the steps themselves show: columns at the end, when an angle
    !! goes over the top, points of a stroboscope. A lane whose trajectory has ended takes the next.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
    use lagrangia_attractor, only: strobed_t
    use lagrangia_columns, only: columns_t
    use lagrangia_errors, only: error_t
    use lagrangia_hermite, only: quintic
    use lagrangia_kept, only: keeps_attractor, keeps_end, keeps_flip, keeps_wrapped, wrapped
    use lagrangia_kinds, only: dp, i8, lanes
    use lagrangia_rk4_lanes, only: rk4_lanes_t
    use lagrangia_scene, only: scene_t
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
        real(dp), allocatable :: points(:, :)    !! rows of the points of a stroboscope
        integer :: found = 0                     !! points that are there
        type(strobed_t) :: strobed               !! where an attractor is looked for
    end type lane_t

contains

    pure function fits_lanes(sweep) result(yes)
        !! Can these trajectories be computed in lanes?
        type(sweep_t), intent(in) :: sweep  !! as `new_sweep` made it
        logical :: yes

        yes = sweep%scene%method == "rk4" .and. .not. sweep%scene%compensated .and. &
              sweep%scene%tolerance <= 0.0_dp .and. sweep%system%contacts == 0 .and. &
              sweep%system%constraints == 0 .and. .not. any(sweep%axes%is_parameter()) .and. &
              sweep%energy_by == 0 .and. (sweep%strobe%given .or. .not. sweep%keeps_points) .and. &
              all(sweep%kept%kind == keeps_end .or. sweep%kept%kind == keeps_flip .or. &
                  sweep%kept%kind == keeps_wrapped .or. sweep%kept%kind == keeps_attractor)
    end function fits_lanes

    subroutine compute_lanes(sweep, first, last, values, failures, first_failed)
        !! What is kept of the trajectories `first` to `last`: the numbers of `compute_one`, but for
        !! rounding. A trajectory that fails is NaN.
        type(sweep_t), intent(in) :: sweep       !! one that `fits_lanes`
        integer(i8), intent(in) :: first, last   !! numbers of trajectories
        real(dp), intent(out) :: values(:, :)    !! (`sweep%width()`, last - first + 1)
        integer(i8), intent(out) :: failures     !! trajectories that ended in no finite state
        integer(i8), intent(out) :: first_failed !! number of the first of these, or huge
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        type(rk4_lanes_t) :: method
        type(lane_t) :: lane(lanes)
        real(dp) :: t(lanes), h(lanes), q(lanes, sweep%system%ndof), v(lanes, sweep%system%ndof)
        real(dp) :: q_old(lanes, sweep%system%ndof), v_old(lanes, sweep%system%ndof)
        real(dp) :: after, rest
        integer(i8) :: next, steps
        integer(i8) :: lit(lanes)  ! steps to the next point of the stroboscope
        integer(i8) :: done(lanes), left(lanes)  ! steps; `left` near `never`: the lane is empty
        integer :: angles(count(sweep%kept%kind == keeps_flip))  ! coordinates whose flip is kept
        integer :: i
        logical :: flips_only

        scene = sweep%scene
        call sweep%set_strobe(scene, after, error)  ! `new_sweep` has seen that it can be
        associate (system => sweep%system)
            call whole_steps(scene%duration, scene%dt, steps, rest)
            flips_only = all(sweep%kept%kind == keeps_flip)
            angles = pack([(sweep%kept(i)%coordinate, i=1, size(sweep%kept))], &
                          sweep%kept%kind == keeps_flip)
            call method%prepare(system)
            failures = 0
            first_failed = huge(first_failed)
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
                lit = lit - 1
                done = done + 1
                t = scene%t0 + done*scene%dt
                if (over_the_top()) call see_flips()
                if (any(lit == 0)) call see_points()
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
            real(dp) :: q0(size(scene%q)), v0(size(scene%v))
            real(dp) :: parameters(size(scene%parameters))

            left(i) = huge(left)
            lit(i) = huge(lit)
            if (next > last) return
            lane(i)%index = next
            next = next + 1
            done(i) = 0
            left(i) = steps + merge(1, 0, rest > 0.0_dp)
            q0 = scene%q
            v0 = scene%v
            parameters = scene%parameters
            call sweep%set_start(lane(i)%index, q0, v0, parameters)
            q(i, :) = q0
            v(i, :) = v0
            t(i) = scene%t0
            h(i) = scene%dt
            if (left(i) == 1 .and. rest > 0.0_dp) h(i) = rest
            lane(i)%columns = sweep%columns
            if (.not. allocated(lane(i)%row)) allocate (lane(i)%row(size(sweep%columns%items)), &
                lane(i)%flips(count(sweep%kept%kind == keeps_flip)))
            lane(i)%flips = ieee_value(1.0_dp, ieee_quiet_nan)
            if (size(lane(i)%row) > 0) call lane(i)%columns%evaluate(sweep%system, t(i), q0, v0, &
                                                                     0.0_dp, lane(i)%row)
            if (.not. sweep%strobe%given) return
            lit(i) = scene%every
            lane(i)%found = 0
            if (sweep%keeps_points .and. .not. allocated(lane(i)%points)) then
                allocate (lane(i)%points(size(sweep%kept), sweep%points))
            end if
            if (sweep%attractors) call lane(i)%strobed%begin(sweep%system)
            if (scene%t0 >= after) call see_point(i)
        end subroutine load

        subroutine see_points()
            !! Of the lanes that the stroboscope lights now.
            integer :: i

            do i = 1, lanes
                if (lit(i) /= 0) cycle
                lit(i) = scene%every
                if (t(i) >= after) call see_point(i)
            end do
        end subroutine see_points

        subroutine see_point(i)
            !! A point of the stroboscope.
            integer, intent(in) :: i
            real(dp) :: q1(size(scene%q)), v1(size(scene%v))

            q1 = q(i, :)
            v1 = v(i, :)
            if (sweep%attractors) call lane(i)%strobed%see(q1, v1)
            if (.not. sweep%keeps_points .or. lane(i)%found == sweep%points) return
            call lane(i)%columns%evaluate(sweep%system, t(i), q1, v1, 0.0_dp, lane(i)%row)
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
            real(dp) :: q1(size(scene%q)), v1(size(scene%v))
            integer :: k, n

            n = size(sweep%kept)
            q1 = q(i, :)
            v1 = v(i, :)
            associate (numbers => values(:, lane(i)%index - first + 1))
                numbers = ieee_value(numbers, ieee_quiet_nan)
                if (.not. all(ieee_is_finite([q1, v1]))) then
                    failures = failures + 1
                    first_failed = min(first_failed, lane(i)%index)
                    return
                end if
                if (sweep%keeps_points) then
                    do k = 1, lane(i)%found
                        numbers((k - 1)*n + 1:k*n) = lane(i)%points(:, k)
                    end do
                    return
                end if
                if (size(lane(i)%row) > 0) call lane(i)%columns%evaluate(sweep%system, &
                    scene%t0 + scene%duration, q1, v1, 0.0_dp, lane(i)%row)
                call take(lane(i), numbers(:n))
                if (sweep%attractors) numbers(n + 1:) = lane(i)%strobed%signature()
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
                        if (lane(i)%flips(k) >= scene%t0 .or. abs(q1(c)) < pi) cycle
                        if (q0(c)*sign(1.0_dp, q1(c)) >= pi) cycle
                        lane(i)%flips(k) = time_of_flip(sweep%system, scene%t0 + &
                            (done(i) - 1)*scene%dt, h(i), c, q0, v0, q1, v1)
                    end associate
                end do
                if (flips_only .and. all(lane(i)%flips >= scene%t0)) left(i) = 0
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
