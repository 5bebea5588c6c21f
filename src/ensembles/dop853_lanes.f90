module lagrangia_dop853_lanes
    !! Steps of the method of Dormand and Prince of order 8(5,3), one trajectory a lane: the sums of
    !! `lagrangia_dop853` in the same order, so that only sine and cosine differ, by their last bit.
    !! Each lane has its own time and step, and accepts or rejects its own attempts.
    !!
    !! What lies inside a step is rarely wanted, and then of one lane: its dense output is that of
    !! a single trajectory.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_brief_force_search, only: find_brief_forces, find_place_functions
    use lagrangia_brief_forces, only: brief_forces_t
    use lagrangia_dop853_control, only: first_step, least_error, next_steps, twice_too_long
    use lagrangia_dop853_lane_stages, only: scaled_errors, slopes, stages
    use lagrangia_dop853_stages, only: extra_stages, inside_step, slope
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8, lanes
    use lagrangia_lane_method, only: lane_method_t
    use lagrangia_place_functions, only: place_functions_t
    use lagrangia_roots, only: find_root, scalar_function_t
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: dop853_lanes_t

    integer, parameter :: places = 8  !! in a step where an angle is looked at, as for any event
    real(dp), parameter :: pi = acos(-1.0_dp)

    type, extends(lane_method_t) :: dop853_lanes_t
        private
        integer(i8), public :: most_steps = huge(1_i8)  !! of a trajectory: after more it is stuck
        real(dp) :: tolerance = 1e-10_dp
        real(dp) :: t_end(lanes) = 0.0_dp            !! of each trajectory, s
        real(dp) :: h(lanes) = 0.0_dp                !! steps to try next, s
        type(brief_forces_t) :: brief(lanes)         !! what no step goes over
        type(place_functions_t), allocatable :: places(:)  !! nor what acts in one of these
        integer(i8) :: steps(lanes) = 0              !! of each trajectory
        real(dp) :: last_error(lanes) = least_error  !! of accepted steps, see `next_steps`
        logical, dimension(lanes) :: busy = .false., moved = .false., retry = .false.
        real(dp), allocatable :: trial(:, :)         !! states at the ends of the attempts
        real(dp), allocatable :: k(:, :, :)          !! slopes, (lanes, 2 ndof, 13): the first, the
        !! others less the first, and the one at the end
        real(dp), allocatable :: inside(:, :, :)     !! dense output, (7, 2 ndof, lanes)
        logical :: inside_known(lanes) = .false.
    contains
        procedure :: prepare
        procedure :: begin
        procedure :: step
        procedure :: state_at
        procedure :: may_flip
        procedure :: flip_time
        procedure :: go_on
        procedure :: scale
        procedure, private :: refuse_steps_over
        procedure, private :: see_inside
    end type dop853_lanes_t

    type, extends(scalar_function_t) :: beyond_t
        !! How far an angle has come beyond plus or minus pi, along a step.
        real(dp) :: t_old = 0.0_dp, t = 0.0_dp
        real(dp) :: from = 0.0_dp, to = 0.0_dp, level = 0.0_dp  !! rad
        real(dp) :: inside(7, 1) = 0.0_dp
    contains
        procedure :: value
    end type beyond_t

contains

    pure subroutine prepare(self, system)
        !! See `lane_method_t`.
        class(dop853_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp) :: slopes(lanes, 2*system%ndof, 13), coefficients(7, 2*system%ndof, lanes)

        slopes = 0.0_dp
        coefficients = 0.0_dp
        self%y_old = slopes(:, :, 1)
        self%y = slopes(:, :, 1)
        self%trial = slopes(:, :, 1)
        self%k = slopes
        self%inside = coefficients
        if (.not. allocated(self%places)) allocate (self%places(lanes))
        self%t_end = 0.0_dp
        self%t = 0.0_dp
        self%busy = .false.
    end subroutine prepare

    pure subroutine begin(self, system, lane, scene)
        !! See `lane_method_t`.
        class(dop853_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: lane
        type(scene_t), intent(in) :: scene
        real(dp) :: y(2*system%ndof), f(2*system%ndof)

        y(:system%ndof) = scene%q
        y(system%ndof + 1:) = scene%v
        self%tolerance = scene%tolerance
        self%t_end(lane) = scene%t0 + scene%duration
        call slope(system, system%ndof, scene%t0, y, f)
        call first_step(system, system%ndof, self%tolerance, scene%t0, self%t_end(lane), y, f, &
                        self%h(lane))
        call find_brief_forces(system, scene%t0, self%t_end(lane), self%brief(lane))
        call find_place_functions(system, self%places(lane))
        self%y(lane, :) = y
        self%k(lane, :, 1) = f
        self%t(lane) = scene%t0
        self%last_error(lane) = least_error
        self%busy(lane) = .true.
        self%moved(lane) = .false.
        self%retry(lane) = .false.
        self%steps(lane) = 0
        self%stuck(lane) = .false.
    end subroutine begin

    pure subroutine step(self, system)
        !! See `lane_method_t`. Twelve evaluations for eight attempts.
        class(dop853_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), dimension(lanes) :: h, next, scaled, t_new
        logical :: cut(lanes), last(lanes)
        integer :: i, n

        n = system%ndof
        do i = 1, 2*n
            self%k(:, i, 1) = merge(self%k(:, i, 13), self%k(:, i, 1), self%moved)
        end do
        self%busy = self%busy .and. self%t < self%t_end
        do i = 1, lanes
            h(i) = self%brief(i)%longest_step(self%t(i))
        end do
        cut = h < self%h
        h = min(h, self%h)
        last = self%t + 1.01_dp*h >= self%t_end
        h = merge(self%t_end - self%t, h, last)
        h = (self%t + h) - self%t  ! what the clock will say
        self%stuck = self%busy .and. .not. self%t + 0.1_dp*h > self%t
        self%busy = self%busy .and. .not. self%stuck
        h = merge(h, 0.0_dp, self%busy)
        call stages(system, n, self%t, h, self%y, self%k, self%trial)
        call scaled_errors(n, h, self%tolerance, self%k, self%y, self%trial, scaled)
        call slopes(system, n, self%t + h, self%trial, self%k(:, :, 13))
        call self%refuse_steps_over(h, scaled)
        self%moved = self%busy .and. scaled <= 1.0_dp
        self%steps = self%steps + merge(1, 0, self%moved)
        self%stuck = self%stuck .or. (self%busy .and. self%steps > self%most_steps)
        self%busy = self%busy .and. .not. self%stuck
        do i = 1, 2*n
            self%y_old(:, i) = merge(self%y(:, i), self%y_old(:, i), self%moved)
            self%y(:, i) = merge(self%trial(:, i), self%y(:, i), self%moved)
        end do
        call next_steps(h, scaled, self%last_error, next)
        next = merge(min(next, self%h), next, self%moved .and. self%retry)
        ! what was cut short, for a moment or the end, asks for no shorter one behind it
        next = merge(max(next, self%h), next, self%moved .and. (cut .or. last))
        self%h = merge(next, self%h, self%busy)
        self%retry = self%busy .and. .not. self%moved
        self%inside_known = self%inside_known .and. .not. self%moved
        t_new = merge(self%t_end, self%t + h, last)
        self%t_old = merge(self%t, self%t_old, self%moved)
        self%t = merge(t_new, self%t, self%moved)
    end subroutine step

    pure subroutine refuse_steps_over(self, h, scaled)
        !! Attempts that go over a place where a function acts are to be about half as long.
        class(dop853_lanes_t), intent(inout) :: self
        real(dp), intent(in) :: h(lanes)
        real(dp), intent(inout) :: scaled(lanes)
        real(dp), dimension(size(self%y, 2)) :: y, y_old
        integer :: i, n
        logical :: over

        n = size(self%y, 2)/2
        do i = 1, lanes
            if (self%places(i)%count == 0 .or. .not. (self%busy(i) .and. scaled(i) <= 1.0_dp)) cycle
            y_old = self%y(i, :)
            y = self%trial(i, :)
            call self%places(i)%try_step(self%t(i), y_old(:n), y_old(n + 1:), self%t(i) + h(i), &
                                         y(:n), y(n + 1:), over)
            if (over) scaled(i) = twice_too_long
        end do
    end subroutine refuse_steps_over

    pure subroutine go_on(self, lane, t_end)
        !! A trajectory that has come to its end has a later one.
        class(dop853_lanes_t), intent(inout) :: self
        integer, intent(in) :: lane      !! which
        real(dp), intent(in) :: t_end    !! s

        self%t_end(lane) = t_end
    end subroutine go_on

    pure subroutine scale(self, lane, coordinates, factor)
        !! Multiply coordinates of a state, and their velocities, whose equations of motion are
        !! linear in them: their slopes need not be evaluated again. After a step.
        class(dop853_lanes_t), intent(inout) :: self
        integer, intent(in) :: lane, coordinates(:)  !! which
        real(dp), intent(in) :: factor               !! positive
        integer :: i, k, n

        n = size(self%y, 2)/2
        do k = 1, size(coordinates)
            do i = coordinates(k), coordinates(k) + n, n
                self%y(lane, i) = factor*self%y(lane, i)
                self%k(lane, i, [1, 13]) = factor*self%k(lane, i, [1, 13])
            end do
        end do
        self%inside_known(lane) = .false.
    end subroutine scale

    pure subroutine see_inside(self, system, lane)
        !! The dense output of the lane's latest step, unless it is known.
        class(dop853_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: lane
        real(dp) :: k(2*system%ndof, 17)
        real(dp), dimension(2*system%ndof) :: work, y, y_old
        integer :: s

        if (self%inside_known(lane)) return
        y_old = self%y_old(lane, :)
        y = self%y(lane, :)
        do s = 1, 12
            k(:, s) = self%k(lane, :, s)
        end do
        call extra_stages(system, system%ndof, self%t_old(lane), &
                          self%t(lane) - self%t_old(lane), y_old, y, k, &
                          self%inside(:, :, lane), work)
        self%inside_known(lane) = .true.
    end subroutine see_inside

    pure subroutine state_at(self, system, lane, t, q, v)
        !! See `lane_method_t`.
        class(dop853_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: lane
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(system%ndof), v(system%ndof)
        real(dp) :: y(2*system%ndof), y_old(2*system%ndof)

        y = self%y(lane, :)
        if (t < self%t(lane)) then
            call self%see_inside(system, lane)
            y_old = self%y_old(lane, :)
            call inside_step((t - self%t_old(lane))/(self%t(lane) - self%t_old(lane)), y_old, &
                             self%inside(:, :, lane), y)
        end if
        q = y(:system%ndof)
        v = y(system%ndof + 1:)
    end subroutine state_at

    pure function may_flip(self, coordinate) result(yes)
        !! See `lane_method_t`: as far as the larger of the velocities at both ends reaches.
        class(dop853_lanes_t), intent(in) :: self
        integer, intent(in) :: coordinate
        logical :: yes(lanes)
        integer :: speed

        speed = size(self%y, 2)/2 + coordinate
        yes = self%moved .and. &
              max(abs(self%y(:, coordinate)), abs(self%y_old(:, coordinate))) + &
              (self%t - self%t_old)*max(abs(self%y(:, speed)), abs(self%y_old(:, speed))) >= pi
    end function may_flip

    subroutine flip_time(self, system, lane, coordinate, time)
        !! See `lane_method_t`: between two of eight places, as for any event of a single run.
        class(dop853_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: lane, coordinate
        real(dp), intent(out) :: time
        type(beyond_t) :: f
        type(error_t), allocatable :: error
        real(dp) :: before, now, t, t_before
        integer :: i

        time = ieee_value(time, ieee_quiet_nan)
        call self%see_inside(system, lane)
        f%t_old = self%t_old(lane)
        f%t = self%t(lane)
        f%from = self%y_old(lane, coordinate)
        f%to = self%y(lane, coordinate)
        f%inside(:, 1) = self%inside(:, coordinate, lane)
        t_before = f%t_old
        before = f%from
        do i = 1, places
            t = f%t_old + i*(f%t - f%t_old)/places
            if (i == places) t = f%t
            f%level = 0.0_dp
            now = f%value(t)
            if (abs(now) > pi .and. before*sign(1.0_dp, now) < pi) then
                f%level = sign(pi, now)
                call find_root(f, t_before, t, time, error)
                return
            end if
            t_before = t
            before = now
        end do
    end subroutine flip_time

    function value(self, x) result(y)
        !! See `scalar_function_t`: the angle less its level, at time `x`.
        class(beyond_t), intent(inout) :: self
        real(dp), intent(in) :: x
        real(dp) :: y, angle(1)

        angle = self%to
        if (x < self%t) call inside_step((x - self%t_old)/(self%t - self%t_old), [self%from], &
                                         self%inside, angle)
        y = angle(1) - self%level
    end function value
end module lagrangia_dop853_lanes
