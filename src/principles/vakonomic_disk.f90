module lagrangia_vakonomic_disk
    !! What an upright disk would do if its rolling constraint were put into L: the paths that make
    !! \(\int L\,dt\) stationary among all that roll,
    !! $$ \mathcal L = L + \mu_1(\dot x - R\dot\varphi\sin\theta)
    !!                   + \mu_2(\dot y + R\dot\varphi\cos\theta). $$
    !! No disk does that. The first two equations give \(m\dot x + \mu_1 = P\), \(\dot P = mg'\),
    !! and \(m\dot y + \mu_2 = Q\), constant, with \(g'\) the pull along x; the others
    !! $$ (I_3 + mR^2)\ddot\varphi = R\,(mg'\sin\theta + (P\cos\theta + Q\sin\theta)\dot\theta),
    !!    \qquad I_1\ddot\theta = -R\dot\varphi\,(P\cos\theta + Q\sin\theta). $$
    !!
    !! Source: V. I. Arnold, V. V. Kozlov, A. I. Neishtadt, *Mathematical Aspects of Classical and
    !! Celestial Mechanics*, 3rd ed. (2006), sec. 1.4 ("vakonomic mechanics").
    use lagrangia_hyperdual, only: hyperdual_t, operator(*), operator(**), operator(+)
    use lagrangia_kinds, only: dp
    use lagrangia_other_lagrangians, only: bare_lagrangian_t
    implicit none (type, external)
    private
    public :: new_vakonomic_disk, vakonomic_disk_t

    type, extends(bare_lagrangian_t) :: vakonomic_disk_t
        !! Coordinates x, y, m; \(\varphi\) and \(\theta\), rad. `lagrangian` is that without the
        !! constraint.
        real(dp) :: m = 1.0_dp, r = 1.0_dp             !! kg, m
        real(dp) :: i_roll = 0.5_dp, i_yaw = 0.25_dp   !! kg m^2
        real(dp) :: pull = 0.0_dp                      !! \(g'\), m/s^2, along x
        real(dp) :: p = 0.0_dp, q = 0.0_dp             !! P at t = 0 and Q, kg m/s
    contains
        procedure :: accelerations
        procedure :: lagrangian
    end type vakonomic_disk_t

contains

    pure function new_vakonomic_disk(m, r, i_roll, i_yaw, pull, x_dot, y_dot) result(disk)
        !! The multipliers are zero at t = 0: \(P = m\dot x\), \(Q = m\dot y\).
        real(dp), intent(in) :: m, r, i_roll, i_yaw, pull  !! kg; m; kg m^2 twice; m/s^2
        real(dp), intent(in) :: x_dot, y_dot               !! of its centre at t = 0, m/s
        type(vakonomic_disk_t) :: disk

        disk%ndof = 4
        disk%time_dependent = .true.
        disk%m = m
        disk%r = r
        disk%i_roll = i_roll
        disk%i_yaw = i_yaw
        disk%pull = pull
        disk%p = m*x_dot
        disk%q = m*y_dot
    end function new_vakonomic_disk

    pure subroutine accelerations(self, t, q, v, a)
        !! See above; those of x and y are the rate of \(\dot x = R\dot\varphi\sin\theta\),
        !! \(\dot y = -R\dot\varphi\cos\theta\).
        class(vakonomic_disk_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        real(dp) :: c, s, p, along

        associate (roll => v(3), steer => v(4))
            s = sin(q(4))
            c = cos(q(4))
            p = self%p + self%m*self%pull*t
            along = p*c + self%q*s
            a(3) = self%r*(self%m*self%pull*s + along*steer)/(self%i_roll + self%m*self%r**2)
            a(4) = -self%r*roll*along/self%i_yaw
            a(1) = self%r*(a(3)*s + roll*steer*c)
            a(2) = -self%r*(a(3)*c - roll*steer*s)
        end associate
    end subroutine accelerations

    pure function lagrangian(self, t, q, v) result(l)
        !! \(L = T + mg'x\), without the constraint.
        class(vakonomic_disk_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*self%m*(v(1)**2 + v(2)**2) + 0.5_dp*self%i_roll*v(3)**2 &
            + 0.5_dp*self%i_yaw*v(4)**2 + self%m*self%pull*q(1) + 0.0_dp*t
    end function lagrangian
end module lagrangia_vakonomic_disk
