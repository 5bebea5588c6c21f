module steep_wall
    !! An oscillator that runs into a wall: no force, or hardly any, tells of it before.
    use bare_system, only: bare_system_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: steep_wall_t

    type, extends(bare_system_t) :: steep_wall_t
        integer :: power = 3  !! of the depth in the wall
    contains
        procedure :: configure
        procedure :: accelerations
        procedure :: energy
    end type steep_wall_t

contains

    pure subroutine configure(self, values, error)
        !! One parameter: the power.
        class(steep_wall_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable, intent(out) :: error

        self%ndof = 1
        self%velocity_forces = .false.
        self%power = nint(values(1))
    end subroutine configure

    pure subroutine accelerations(self, t, q, v, a)
        !! $$ \ddot x = -x - 3\max(0, x - 1/2)^n $$
        class(steep_wall_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a(1) = -q(1) - 3.0_dp*max(0.0_dp, q(1) - 0.5_dp)**self%power
    end subroutine accelerations

    pure function energy(self, t, q, v) result(e)
        !! $$ E = \tfrac12\dot x^2 + \tfrac12 x^2 + \frac{3}{n+1}\max(0, x - 1/2)^{n+1} $$
        class(steep_wall_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e

        e = 0.5_dp*(v(1)**2 + q(1)**2) &
            + 3.0_dp/(self%power + 1)*max(0.0_dp, q(1) - 0.5_dp)**(self%power + 1)
    end function energy
end module steep_wall
