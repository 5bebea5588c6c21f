module plain_system
    !! A system of no lecture that has no lane kernel of its own: two coordinates, all of t, q
    !! and v in its forces, and none after `last`.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use bare_system, only: bare_system_t
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: plain_system_t

    type, extends(bare_system_t) :: plain_system_t
        real(dp) :: last = huge(1.0_dp)  !! accelerations are NaN later, s
    contains
        procedure :: describe
        procedure :: configure
        procedure :: accelerations
        procedure :: energy
    end type plain_system_t

contains

    pure subroutine describe(self, d)
        !! Nothing to say.
        class(plain_system_t), intent(in) :: self
        type(description_t), intent(out) :: d

        d%name = "plain"
    end subroutine describe

    pure subroutine configure(self, values, error)
        !! No parameters.
        class(plain_system_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        self%ndof = 2
        self%time_dependent = .true.
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ \ddot x = -x + \dot y\cos t,\qquad \ddot y = -2\sin y - \dot x\cos t $$
        class(plain_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a(1) = -q(1) + v(2)*cos(t)
        a(2) = -2.0_dp*sin(q(2)) - v(1)*cos(t)
        if (t > self%last) a = ieee_value(t, ieee_quiet_nan)
    end subroutine accelerations

    pure function energy(self, t, q, v) result(e)
        !! Conserved, as the forces across the motion do no work.
        class(plain_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = 0.5_dp*(v(1)**2 + v(2)**2 + q(1)**2) - 2.0_dp*cos(q(2))
    end function energy
end module plain_system
