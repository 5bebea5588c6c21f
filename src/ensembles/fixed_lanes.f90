module lagrangia_fixed_lanes
    !! Steps of fixed length, one trajectory a lane: the clock, the ends and the flips of all
    !! methods of this kind.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_hermite, only: quintic
    use lagrangia_kinds, only: dp, i8, lanes
    use lagrangia_lane_method, only: lane_method_t
    use lagrangia_scene, only: scene_t
    use lagrangia_stepwise, only: whole_steps
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: fixed_lanes_t

    real(dp), parameter :: pi = acos(-1.0_dp)

    type, abstract, extends(lane_method_t) :: fixed_lanes_t
        !! All steps of a trajectory have one length, but for the last.
        private
        real(dp), dimension(lanes) :: t0 = 0.0_dp, dt = 0.0_dp, duration = 0.0_dp
        real(dp) :: last(lanes) = 0.0_dp     !! length of the last step, s
        logical :: shorter(lanes) = .false.  !! it is not a whole one
        integer(i8) :: steps(lanes) = 0      !! of the trajectory
        integer(i8) :: done(lanes) = 0
    contains
        procedure(advance_i), deferred :: advance
        procedure :: prepare
        procedure, non_overridable :: prepare_states => prepare
        procedure :: begin
        procedure, non_overridable :: begin_steps => begin
        procedure :: step
        procedure :: state_at
        procedure :: may_flip
        procedure :: flip_time
    end type fixed_lanes_t

    abstract interface
        pure subroutine advance_i(self, system, h, t_end)
            !! One step of every lane: `y`, which is at `t`.
            import :: dp, fixed_lanes_t, lanes, system_t
            implicit none (type, external)
            class(fixed_lanes_t), intent(inout) :: self
            class(system_t), intent(in) :: system  !! of all lanes
            real(dp), intent(in) :: h(lanes)       !! its length, s
            real(dp), intent(in) :: t_end(lanes)   !! its end, as the method alone has it, s
        end subroutine advance_i
    end interface

contains

    pure subroutine prepare(self, system)
        !! See `lane_method_t`.
        class(fixed_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system  !! of all lanes
        real(dp) :: both(lanes, 2*system%ndof)

        both = 0.0_dp
        self%y_old = both
        self%y = both
    end subroutine prepare

    pure subroutine begin(self, system, lane, scene)
        !! See `lane_method_t`.
        class(fixed_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system  !! of all lanes
        integer, intent(in) :: lane            !! its number
        type(scene_t), intent(in) :: scene     !! start, step and duration of its trajectory

        self%y(lane, :system%ndof) = scene%q
        self%y(lane, system%ndof + 1:) = scene%v
        self%t0(lane) = scene%t0
        self%t(lane) = scene%t0
        self%dt(lane) = scene%dt
        self%duration(lane) = scene%duration
        call whole_steps(scene%duration, scene%dt, self%steps(lane), self%last(lane))
        self%shorter(lane) = self%last(lane) > 0.0_dp
        if (self%shorter(lane)) then
            self%steps(lane) = self%steps(lane) + 1
        else
            self%last(lane) = scene%dt
        end if
        self%done(lane) = 0
    end subroutine begin

    pure subroutine step(self, system)
        !! See `lane_method_t`.
        class(fixed_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp) :: h(lanes), t_end(lanes)

        self%y_old = self%y
        self%t_old = self%t
        self%done = self%done + 1
        h = merge(self%last, self%dt, self%done == self%steps)
        t_end = merge(self%t + h, self%t0 + self%done*self%dt, &
                      self%shorter .and. self%done == self%steps)
        call self%advance(system, h, t_end)
        self%t = merge(self%t0 + self%duration, t_end, self%done == self%steps)
    end subroutine step

    pure subroutine state_at(self, system, lane, t, q, v)
        !! See `lane_method_t`: the end of the step.
        class(fixed_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        integer, intent(in) :: lane
        real(dp), intent(in) :: t
        real(dp), intent(out) :: q(system%ndof), v(system%ndof)

        q = self%y(lane, :system%ndof)
        v = self%y(lane, system%ndof + 1:)
    end subroutine state_at

    pure function may_flip(self, coordinate) result(yes)
        !! See `lane_method_t`: only the ends of steps are looked at.
        class(fixed_lanes_t), intent(in) :: self
        integer, intent(in) :: coordinate
        logical :: yes(lanes)

        associate (old => self%y_old(:, coordinate), new => self%y(:, coordinate))
            yes = abs(new) >= pi .and. old*sign(1.0_dp, new) < pi
        end associate
    end function may_flip

    subroutine flip_time(self, system, lane, coordinate, time)
        !! See `lane_method_t`: where in the step the quintic of both ends meets plus or minus pi.
        class(fixed_lanes_t), intent(inout) :: self
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
end module lagrangia_fixed_lanes
