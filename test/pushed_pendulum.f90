module pushed_pendulum
    !! A double pendulum whose Lagrangian and accelerations are not those of its bobs.
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_hyperdual, only: hyperdual_t, operator(*), operator(+)
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: pushed_pendulum_t

    type, extends(double_pendulum_t) :: pushed_pendulum_t
        integer :: which = 1         !! coordinate that is pushed
        real(dp) :: push = 0.0_dp    !! more force than there is, N m; more acceleration, rad/s^2
        real(dp) :: from = -huge(1.0_dp), to = huge(1.0_dp)  !! when it is pushed, s
    contains
        procedure :: lagrangian
        procedure :: accelerations
    end type pushed_pendulum_t

contains

    pure function lagrangian(self, t, q, v) result(l)
        !! \(L + c\,q_j\).
        class(pushed_pendulum_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = self%double_pendulum_t%lagrangian(t, q, v)
        if (self%from < t%re .and. t%re < self%to) l = l + self%push*q(self%which)
    end function lagrangian

    pure subroutine accelerations(self, t, q, v, a)
        !! \(\ddot q_j + c\).
        class(pushed_pendulum_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        call self%double_pendulum_t%accelerations(t, q, v, a)
        if (self%from < t .and. t < self%to) a(self%which) = a(self%which) + self%push
    end subroutine accelerations
end module pushed_pendulum
