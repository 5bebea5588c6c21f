module lagrangia_rk4_lanes
    !! Steps of the classical Runge-Kutta method, one trajectory a lane: the sums of
    !! `lagrangia_rk4` in the same order, so that only sine and cosine differ, by their last bit.
    use lagrangia_fixed_lanes, only: fixed_lanes_t
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: rk4_lanes_t

    type, extends(fixed_lanes_t) :: rk4_lanes_t
        private
        real(dp), allocatable :: q(:, :), v2(:, :), v3(:, :), v4(:, :)            !! (lanes, ndof)
        real(dp), allocatable :: a1(:, :), a2(:, :), a3(:, :), a4(:, :)
    contains
        procedure :: prepare
        procedure :: advance
    end type rk4_lanes_t

contains

    pure subroutine prepare(self, system)
        !! See `lane_method_t`.
        class(rk4_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp) :: state(lanes, system%ndof)

        call self%prepare_states(system)
        state = 0.0_dp
        self%q = state
        self%v2 = state
        self%v3 = state
        self%v4 = state
        self%a1 = state
        self%a2 = state
        self%a3 = state
        self%a4 = state
    end subroutine prepare

    pure subroutine advance(self, system, h, t_end)
        !! See `fixed_lanes_t`.
        class(rk4_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: h(lanes), t_end(lanes)

        call take_step(self, system, system%ndof, h, self%y)
    end subroutine advance

    pure subroutine take_step(self, system, n, h, y)
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
    end subroutine take_step

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
end module lagrangia_rk4_lanes
