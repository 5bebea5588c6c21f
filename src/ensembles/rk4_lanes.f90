module lagrangia_rk4_lanes
    !! Steps of the classical Runge-Kutta method, one trajectory a lane: the sums of
    !! `lagrangia_rk4` in the same order, so that only sine and cosine differ, by their last bit.
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: rk4_lanes_t

    type :: rk4_lanes_t
        !! Room for the stages.
        private
        real(dp), allocatable :: q(:, :), v2(:, :), v3(:, :), v4(:, :)            !! (lanes, ndof)
        real(dp), allocatable :: a1(:, :), a2(:, :), a3(:, :), a4(:, :)
    contains
        procedure :: prepare
        procedure :: step
    end type rk4_lanes_t

contains

    pure subroutine prepare(self, system)
        !! Before the first step.
        class(rk4_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system  !! whose motions these are
        real(dp) :: state(lanes, system%ndof)

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

    pure subroutine step(self, system, t, h, q, v)
        !! One step of every lane, each from its own time and of its own length.
        class(rk4_lanes_t), intent(inout) :: self
        class(system_t), intent(in) :: system        !! the one of `prepare`
        real(dp), intent(in) :: t(lanes), h(lanes)   !! times and lengths of the steps, s
        real(dp), intent(inout) :: q(lanes, system%ndof), v(lanes, system%ndof)
        !! states, before and after
        real(dp) :: half(lanes), sixth(lanes)
        integer :: n

        n = system%ndof
        half = 0.5_dp*h
        sixth = h/6.0_dp
        call system%accelerations_lanes(t, q, v, self%a1)
        call move(n, q, v, half, v, self%a1, self%q, self%v2)
        call system%accelerations_lanes(t + half, self%q, self%v2, self%a2)
        call move(n, q, v, half, self%v2, self%a2, self%q, self%v3)
        call system%accelerations_lanes(t + half, self%q, self%v3, self%a3)
        call move(n, q, v, h, self%v3, self%a3, self%q, self%v4)
        call system%accelerations_lanes(t + h, self%q, self%v4, self%a4)
        call finish(n, sixth, v, self%v2, self%v3, self%v4, q)
        call finish(n, sixth, self%a1, self%a2, self%a3, self%a4, v)
    end subroutine step

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
