module driven_wall
    !! A mass that is pushed by nothing but the time, until it meets a wall that is soft at first.
    !! At one time, and a nanosecond before and after, it has no accelerations.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use bare_system, only: bare_system_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: driven_wall_t

    type, extends(bare_system_t) :: driven_wall_t
        real(dp) :: hole = huge(1.0_dp)  !! s
    contains
        procedure :: configure
        procedure :: accelerations
    end type driven_wall_t

contains

    pure subroutine configure(self, values, error)
        !! No parameters.
        class(driven_wall_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        self%ndof = 1
        self%velocity_forces = .false.
        self%time_dependent = .true.
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ \ddot x = \cos 2t - 10\max(0, x - 1)^7 $$
        class(driven_wall_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a(1) = cos(2.0_dp*t) - 10.0_dp*max(0.0_dp, q(1) - 1.0_dp)**7
        if (abs(t - self%hole) < 1e-9_dp) a(1) = ieee_value(t, ieee_quiet_nan)
    end subroutine accelerations
end module driven_wall
