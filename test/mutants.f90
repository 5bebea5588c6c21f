module mutants
    !! Systems with one slip each, of the kinds that hands make: the audit must find it.
    use lagrangia_atwood, only: atwood_t
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_kinds, only: dp
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_rolling_disk, only: rolling_disk_t
    use lagrangia_rotating_hoop, only: rotating_hoop_t
    use lagrangia_system, only: system_t
    use lagrangia_wedge, only: wedge_t
    implicit none (type, external)
    private
    public :: new_mutant, mutants_known

    integer, parameter :: mutants_known = 17

    type, extends(pendulum_t) :: pendulum_mutant_t
        integer :: slip = 1
    contains
        procedure :: accelerations => pendulum_slip
    end type pendulum_mutant_t

    type, extends(cart_pendulum_t) :: cart_mutant_t
        integer :: slip = 0
    contains
        procedure :: accelerations => cart_slip
    end type cart_mutant_t

    type, extends(double_pendulum_t) :: double_mutant_t
        integer :: slip = 0
    contains
        procedure :: accelerations => double_slip
    end type double_mutant_t

    type, extends(atwood_t) :: atwood_mutant_t
    contains
        procedure :: accelerations => atwood_slip
    end type atwood_mutant_t

    type, extends(wedge_t) :: wedge_mutant_t
    contains
        procedure :: accelerations => wedge_slip
    end type wedge_mutant_t

    type, extends(rolling_disk_t) :: disk_mutant_t
        integer :: slip = 0
    contains
        procedure :: accelerations => disk_slip
    end type disk_mutant_t

    type, extends(charged_particle_t) :: charge_mutant_t
    contains
        procedure :: accelerations => charge_slip
    end type charge_mutant_t

    type, extends(rotating_hoop_t) :: hoop_mutant_t
    contains
        procedure :: accelerations => hoop_slip
    end type hoop_mutant_t

    type, extends(driven_pendulum_t) :: driven_mutant_t
    contains
        procedure :: accelerations => driven_slip
    end type driven_mutant_t

contains

    subroutine new_mutant(k, system, expected)
        !! Mutant `k`, and what the audit must say of it.
        integer, intent(in) :: k
        class(system_t), allocatable, intent(out) :: system
        character(:), allocatable, intent(out) :: expected

        select case (k)
        case (1)
            allocate (pendulum_mutant_t :: system)
            expected = "theta_ddot is not that of L: its term without velocities counts l^2 times"
        case (2)
            allocate (system, source=cart_mutant_t(slip=1))
            expected = "the equation of theta is not that of L: its term without velocities "// &
                       "counts -1 times"
        case (3)
            allocate (system, source=cart_mutant_t(slip=2))
            expected = "the equation of theta is not that of L: its term in theta_ddot "// &
                       "counts 1/l times"
        case (4)
            allocate (system, source=cart_mutant_t(slip=3))
            expected = "x_ddot is not that of L: the term in theta_dot^2 of the equation of x "// &
                       "counts 1/l times"
        case (5)
            allocate (system, source=cart_mutant_t(slip=4))
            expected = "theta_ddot is not that of L: the term without velocities of the "// &
                       "equation of theta counts -1 times"
        case (6)
            allocate (system, source=cart_mutant_t(slip=5))
            expected = "x_ddot is not that of L"
        case (7)
            allocate (system, source=double_mutant_t(slip=1))
            expected = "theta1_ddot is not that of L: the term in theta2_dot^2 of the equation "// &
                       "of theta1 counts 0 times"
        case (8)
            allocate (system, source=double_mutant_t(slip=2))
            expected = "theta2_ddot is not that of L: the term without velocities of the "// &
                       "equation of theta1 counts 0.5 times"
        case (9)
            allocate (atwood_mutant_t :: system)
            expected = "x_ddot is not that of L: its term without velocities counts "
        case (10)
            allocate (wedge_mutant_t :: system)
            expected = "the equation of q1 is not that of L: its term without velocities "// &
                       "counts m_block/m_wedge times"
        case (11)
            allocate (system, source=disk_mutant_t(slip=1))
            expected = "x_ddot is not that of L: the velocity term of its constraints "// &
                       "counts -1 times"
        case (12)
            allocate (system, source=disk_mutant_t(slip=2))
            expected = "phi_ddot is not that of L"
        case (13)
            allocate (charge_mutant_t :: system)
            expected = "z_ddot is not that of L: the term in y_dot of the equation of z counts -1 "
        case (14)
            allocate (hoop_mutant_t :: system)
            expected = "theta_ddot is not that of L"
        case (15)
            allocate (driven_mutant_t :: system)
            expected = "theta_ddot is not that of L"
        case (16)
            allocate (system, source=double_mutant_t(slip=3))
            expected = "theta2_ddot is not that of L; others are wrong too"
        case default
            allocate (system, source=pendulum_mutant_t(slip=2))
            expected = "theta_ddot is not that of L: its generalised force counts l times in it"
        end select
    end subroutine new_mutant

    pure subroutine pendulum_slip(self, t, q, v, a)
        !! \(g\ell\) for \(g/\ell\). 2: a lost \(\ell\) of the friction.
        class(pendulum_mutant_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a(1) = -self%g*self%l*sin(q(1)) - self%b/(self%m*self%l**2)*v(1)
        if (self%slip == 2) a(1) = -self%g/self%l*sin(q(1)) - self%b/(self%m*self%l)*v(1)
    end subroutine pendulum_slip

    pure subroutine cart_slip(self, t, q, v, a)
        !! 1: the sign slip of the notes, both equations then solved. 2: \(\ell\) for \(\ell^2\) in
        !! one of them. 3, 4, 5: in a solved formula, a lost \(\ell\), a sign, \(m_1\) for \(m_2\)
        !! below the line.
        class(cart_mutant_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        real(dp) :: s, c, d, gravity, inertia, centrifugal

        associate (m1 => self%m1, m2 => self%m2, l => self%l, g => self%g)
            s = sin(q(2))
            c = cos(q(2))
            gravity = merge(m2*g*l*s, -m2*g*l*s, self%slip == 1)
            inertia = merge(m2*l, m2*l**2, self%slip == 2)
            centrifugal = m2*l*v(2)**2*s
            if (self%slip <= 2) then
                d = (m1 + m2)*inertia - (m2*l*c)**2
                a(1) = (inertia*centrifugal - m2*l*c*gravity)/d
                a(2) = ((m1 + m2)*gravity - m2*l*c*centrifugal)/d
                return
            end if
            d = m1 + m2*s**2
            a(1) = m2*s*(l*v(2)**2 + g*c)/d
            a(2) = -s*((m1 + m2)*g + m2*l*v(2)**2*c)/(l*d)
            if (self%slip == 3) a(1) = m2*s*(v(2)**2 + g*c)/d
            if (self%slip == 4) a(2) = -s*(-(m1 + m2)*g + m2*l*v(2)**2*c)/(l*d)
            if (self%slip == 5) a(1) = m2*s*(l*v(2)**2 + g*c)/(m2 + m1*s**2)
        end associate
    end subroutine cart_slip

    pure subroutine double_slip(self, t, q, v, a)
        !! 1: a lost centrifugal term. 2: half of a weight. 3: one that is much too small always,
        !! the other 1 % too large.
        class(double_mutant_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        real(dp) :: s, c, d, part

        associate (m1 => self%m1, m2 => self%m2, m => self%m1 + self%m2, &
                   l1 => self%l1, l2 => self%l2, g => self%g)
            s = sin(q(1) - q(2))
            c = cos(q(1) - q(2))
            d = m1 + m2*s**2
            part = merge(0.0_dp, 1.0_dp, self%slip == 1)
            a(1) = (-m2*s*(l1*v(1)**2*c + part*l2*v(2)**2) - m*g*sin(q(1)) &
                    + m2*g*sin(q(2))*c)/(l1*d)
            part = merge(0.5_dp, 1.0_dp, self%slip == 2)
            a(2) = (m*l1*v(1)**2*s + m2*l2*v(2)**2*s*c + m*g*(part*sin(q(1))*c - sin(q(2)))) &
                   /(l2*d)
            if (self%slip /= 3) return
            a(1) = 1.01_dp*a(1)
            a(2) = -1e3_dp*(m*l1*v(1)**2 + m2*l2*v(2)**2 + 2.0_dp*m*g)/(l2*d)
        end associate
    end subroutine double_slip

    pure subroutine atwood_slip(self, t, q, v, a)
        !! \(I/R\) for \(I/R^2\).
        class(atwood_mutant_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a(1) = (self%m1 - self%m2)*(self%g + self%support_acceleration) &
               /(self%m1 + self%m2 + self%pulley_inertia/self%radius)
    end subroutine atwood_slip

    pure subroutine wedge_slip(self, t, q, v, a)
        !! The slip of the notes: \(mg\sin\alpha = M(\ddot q_1 + \ddot q_2\cos\alpha)\).
        class(wedge_mutant_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        real(dp) :: s, c

        associate (m => self%m_block, big => self%m_wedge)
            s = sin(self%alpha)
            c = cos(self%alpha)
            a(1) = m/big*self%g*s/(1.0_dp - m*c**2/(big + m))
            a(2) = -m*c*a(1)/(big + m)
        end associate
    end subroutine wedge_slip

    pure subroutine disk_slip(self, t, q, v, a)
        !! 1: a sign in one of the rolling conditions. 2: the roll forgets the heading.
        class(disk_mutant_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)
        real(dp) :: s, c

        s = sin(q(4))
        c = cos(q(4))
        a(3) = self%roll_acceleration()*s
        a(4) = 0.0_dp
        a(1) = self%r*(a(3)*s + v(3)*v(4)*c)
        a(2) = self%r*(-a(3)*c + v(3)*v(4)*s)
        if (self%slip == 1) a(1) = self%r*(a(3)*s - v(3)*v(4)*c)
        if (self%slip == 2) a(3) = self%roll_acceleration()
    end subroutine disk_slip

    pure subroutine charge_slip(self, t, q, v, a)
        !! A sign in the cross product.
        class(charge_mutant_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        associate (m => self%m, e => self%charge, b => self%magnetic, k => self%trap)
            a(1) = (e*(self%electric(1) + v(2)*b(3) - v(3)*b(2)) - k*q(1))/m
            a(2) = (e*(self%electric(2) + v(3)*b(1) - v(1)*b(3)) - k*q(2))/m
            a(3) = (e*(self%electric(3) + v(1)*b(2) + v(2)*b(1)) - k*q(3))/m
        end associate
    end subroutine charge_slip

    pure subroutine hoop_slip(self, t, q, v, a)
        !! A centrifugal force of the wrong sign.
        class(hoop_mutant_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        a(1) = sin(q(1))*(-self%omega**2*cos(q(1)) - self%g/self%r)
    end subroutine hoop_slip

    pure subroutine driven_slip(self, t, q, v, a)
        !! The pivot's acceleration with the wrong sign.
        class(driven_mutant_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: a(self%ndof)

        associate (w => self%drive_frequency)
            a(1) = -(self%g + self%amplitude*w**2*cos(w*t))/self%l*sin(q(1)) &
                   - self%b/(self%m*self%l**2)*v(1)
        end associate
    end subroutine driven_slip
end module mutants
