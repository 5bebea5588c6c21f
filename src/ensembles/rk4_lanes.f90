module lagrangia_rk4_lanes
    !! Steps of the classical Runge-Kutta method, one trajectory a lane: the sums of
    !! `lagrangia_rk4` in the same order, so that only sine and cosine differ, by their last bit.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_hermite, only: quintic
    use lagrangia_kinds, only: dp, i8, lanes
    use lagrangia_lane_method, only: lane_method_t
    use lagrangia_scene, only: scene_t
    use lagrangia_stepwise, only: whole_steps
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: rk4_lanes_t

    real(dp), parameter :: pi = acos(-1.0_dp)

    type, extends(lane_method_t) :: rk4_lanes_t
        !! All steps of a trajectory have one length, but for the last.
        private
        real(dp), dimension(lanes) :: t0 = 0.0_dp, dt = 0.0_dp, duration = 0.0_dp
        real(dp) :: last(lanes) = 0.0_dp     !! length of the last step, s
        integer(i8) :: steps(lanes) = 0      !! of the trajectory
        integer(i8) :: done(lanes) = 0
        real(dp), allocatable :: q(:, :), v2(:, :), v3(:, :), v4(:, :)            !! (lanes, ndof)
        real(dp), allocatable :: a1(:, :), a2(:, :), a3(:, :), a4(:, :)
    contains
        procedure :: prepare
        procedure :: begin
        procedure :: step
        procedure :: state_at
        procedure :: may_flip
        procedure :: flip_time
    end type rk4_lanes_t

contains

    pure subroutine prepare(self, system)
        !! See `lane_method_t`.
        class(rk4_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp) :: state(lanes, system%ndof), both(lanes, 2*system%ndof)

        state = 0.0_dp
        both = 0.0_dp
        self%y_old = both
        self%y = both
        self%q = state
        self%v2 = state
        self%v3 = state
        self%v4 = state
        self%a1 = state
        self%a2 = state
        self%a3 = state
        self%a4 = state
    end subroutine prepare

    pure subroutine begin(self, system, lane, scene)
        !! See `lane_method_t`.
        class(rk4_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: lane
        type(scene_t), intent(in) :: scene

        self%y(lane, :system%ndof) = scene%q
        self%y(lane, system%ndof + 1:) = scene%v
        self%t0(lane) = scene%t0
        self%t(lane) = scene%t0
        self%dt(lane) = scene%dt
        self%duration(lane) = scene%duration
        call whole_steps(scene%duration, scene%dt, self%steps(lane), self%last(lane))
        if (self%last(lane) > 0.0_dp) then
            self%steps(lane) = self%steps(lane) + 1
        else
            self%last(lane) = scene%dt
        end if
        self%done(lane) = 0
    end subroutine begin

    pure subroutine step(self, system)
        !! See `lane_method_t`.
        class(rk4_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp) :: h(lanes)

        self%y_old = self%y
        self%t_old = self%t
        self%done = self%done + 1
        h = merge(self%last, self%dt, self%done == self%steps)
        call advance(self, system, system%ndof, h, self%y)
        self%t = merge(self%t0 + self%duration, self%t0 + self%done*self%dt, &
                       self%done == self%steps)
    end subroutine step

    pure subroutine advance(self, system, n, h, y)
        !! The step itself.
        class(rk4_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: n
        real(dp), intent(in) :: h(lanes)
        real(dp), intent(inout) :: y(lanes, n, 2)
        real(dp) :: half(lanes), sixth(lanes)

        half = 0.5_dp*h
        sixth = h/6.0_dp
        associate (t => self%t, q => y(:, :, 1), v => y(:, :, 2))
            call system%accelerations_lanes(t, q, v, self%a1)
            call move(n, q, v, half, v, self%a1, self%q, self%v2)
            call system%accelerations_lanes(t + half, self%q, self%v2, self%a2)
            call move(n, q, v, half, self%v2, self%a2, self%q, self%v3)
            call system%accelerations_lanes(t + half, self%q, self%v3, self%a3)
            call move(n, q, v, h, self%v3, self%a3, self%q, self%v4)
            call system%accelerations_lanes(t + h, self%q, self%v4, self%a4)
            call finish(n, sixth, v, self%v2, self%v3, self%v4, q)
            call finish(n, sixth, self%a1, self%a2, self%a3, self%a4, v)
        end associate
    end subroutine advance

    pure subroutine move(n, q, v, h, q_dot, v_dot, q_new, v_new)
        !! From `(q, v)` along a slope, for times `h`.
        integer, intent(in) :: n
        real(dp), intent(in) :: q(lanes, n), v(lanes, n), h(lanes), q_dot(lanes, n)
        real(dp), intent(in) :: v_dot(lanes, n)
        real(dp), intent(out) :: q_new(lanes, n), v_new(lanes, n)
        integer :: i

        do i = 1, n
            q_new(:, i) = q(:, i) + h*q_dot(:, i)
            v_new(:, i) = v(:, i) + h*v_dot(:, i)
        end do
    end subroutine move

    pure subroutine finish(n, sixth, k1, k2, k3, k4, y)
        !! Add the weighted slopes of the stages.
        integer, intent(in) :: n
        real(dp), intent(in) :: sixth(lanes), k1(lanes, n), k2(lanes, n), k3(lanes, n)
        real(dp), intent(in) :: k4(lanes, n)
        real(dp), intent(inout) :: y(lanes, n)
        integer :: i

        do i = 1, n
            y(:, i) = y(:, i) + sixth*(k1(:, i) + 2.0_dp*(k2(:, i) + k3(:, i)) + k4(:, i))
        end do
    end subroutine finish

    pure subroutine state_at(self, system, lane, t, q, v)
        !! See `lane_method_t`: the end of the step.
        class(rk4_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: lane
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(system%ndof), v(system%ndof)

        q = self%y(lane, :system%ndof)
        v = self%y(lane, system%ndof + 1:)
    end subroutine state_at

    pure function may_flip(self, coordinate) result(yes)
        !! See `lane_method_t`: only the ends of steps are looked at.
        class(rk4_lanes_t), intent(in) :: self
        integer, intent(in) :: coordinate
        logical :: yes(lanes)

        associate (old => self%y_old(:, coordinate), new => self%y(:, coordinate))
            yes = abs(new) >= pi .and. old*sign(1.0_dp, new) < pi
        end associate
    end function may_flip

    subroutine flip_time(self, system, lane, coordinate, time)
        !! See `lane_method_t`: where in the step the quintic of both ends meets plus or minus pi.
        class(rk4_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: lane, coordinate
        real(dp), intent(out) :: time
        real(dp), dimension(system%ndof) :: a, a_old, q, q_old, v, v_old
        real(dp) :: angle, c5(0:5), h, high, low, orientation, s
        logical :: flips(lanes)
        integer :: c, i, n

        time = ieee_value(time, ieee_quiet_nan)
        flips = self%may_flip(coordinate)
        if (.not. flips(lane)) return
        n = system%ndof
        c = coordinate
        q = self%y(lane, :n)
        v = self%y(lane, n + 1:)
        q_old = self%y_old(lane, :n)
        v_old = self%y_old(lane, n + 1:)
        h = merge(self%last(lane), self%dt(lane), self%done(lane) == self%steps(lane))
        call system%accelerations(self%t_old(lane), q_old, v_old, a_old)
        call system%accelerations(self%t_old(lane) + h, q, v, a)
        c5 = quintic(h, [q_old(c), v_old(c), a_old(c)], [q(c), v(c), a(c)])
        orientation = sign(1.0_dp, q(c))
        low = 0.0_dp
        high = 1.0_dp
        do i = 1, 60
            s = 0.5_dp*(low + high)
            angle = c5(0) + s*(c5(1) + s*(c5(2) + s*(c5(3) + s*(c5(4) + s*c5(5)))))
            if (orientation*angle < pi) then
                low = s
            else
                high = s
            end if
        end do
        time = self%t_old(lane) + h*high
    end subroutine flip_time
end module lagrangia_rk4_lanes
