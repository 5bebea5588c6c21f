module lagrangia_gauged_system
    !! A system with \(L' = L + dF/dt\) in place of \(L\): another Lagrangian, the same motion.
    !!
    !! Then other Lagrangians of known systems: two that tell the same motion, and two that do not.
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_hyperdual, only: cos, dot_product, exp, hyperdual_t, operator(*), operator(**), &
                                   operator(+), operator(-), sin
    use lagrangia_kinds, only: dp
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_system, only: system_t
    use lagrangia_wrapped_system, only: wrapped_system_t
    implicit none (type, external)
    private
    public :: gauge_t, gauged_system_t, family_t, member_names
    public :: chi_t, landau_charge_t, pendulum_with_q, pendulum_with_q_q_dot

    type, abstract :: gauge_t
        !! \(F\) and, written out by hand, \(dF/dt\).
    contains
        procedure(value_i), deferred :: value
        procedure(rate_i), deferred :: rate
    end type gauge_t

    abstract interface
        pure function value_i(self, t, q) result(f)
            !! \(F(q, t)\), J s.
            import :: gauge_t, hyperdual_t
            implicit none (type, external)
            class(gauge_t), intent(in) :: self
            type(hyperdual_t), intent(in) :: t, q(:)  !! s; coordinates
            type(hyperdual_t) :: f
        end function value_i

        pure function rate_i(self, t, q, v) result(f_dot)
            !! \(\sum_k\dot q_k\,\partial F/\partial q_k + \partial F/\partial t\), J.
            import :: gauge_t, hyperdual_t
            implicit none (type, external)
            class(gauge_t), intent(in) :: self
            type(hyperdual_t), intent(in) :: t, q(:), v(:)  !! s; coordinates and velocities
            type(hyperdual_t) :: f_dot
        end function rate_i
    end interface

    character(14), parameter :: member_names(3) = ["s^2           ", "t sin(s)      ", &
                                                   "exp(-t/2) s^3 "]

    type, extends(gauge_t) :: family_t
        !! \(f(s, t)\) with \(s = q_1 + q_2/2 + q_3/3 + \dots\).
        integer :: member = 1  !! of `member_names`
    contains
        procedure :: value => family_value
        procedure :: rate => family_rate
    end type family_t

    type, extends(wrapped_system_t) :: gauged_system_t
        !! Everything is the plain system's but the Lagrangian.
        class(gauge_t), allocatable :: gauge
    contains
        procedure :: set
        procedure :: adopt
        procedure :: lagrangian
        procedure :: energy
    end type gauged_system_t

    type, extends(charged_particle_t) :: landau_charge_t
        !! The charge with \(A = (0, fB_zx, 0)\), `magnetic` along z: Landau's gauge if \(f = 1\).
        real(dp) :: factor = 1.0_dp
    contains
        procedure :: lagrangian => landau_lagrangian
        procedure :: momenta => landau_momenta
        procedure :: velocities => landau_velocities
        procedure :: forces => landau_forces
    end type landau_charge_t

    type, extends(gauge_t) :: chi_t
        !! \(e\chi = \tfrac12eB_zxy\), from the symmetric gauge to Landau's.
        real(dp) :: strength = 1.0_dp  !! \(eB_z\)
    contains
        procedure :: value => chi_value
        procedure :: rate => chi_rate
    end type chi_t

    type, extends(pendulum_t) :: pendulum_with_q
        !! \(L + cq\): not a derivative of anything.
    contains
        procedure :: lagrangian => plus_q
    end type pendulum_with_q

    type, extends(pendulum_t) :: pendulum_with_q_q_dot
        !! \(L + dF/dt\) with \(F = c\,q\dot q\), \(\ddot q\) taken from the equation of motion.
        !! (On the oscillator this would only triple \(L\).)
    contains
        procedure :: lagrangian => plus_q_q_dot
    end type pendulum_with_q_q_dot

contains

    pure function family_value(self, t, q) result(f)
        !! See `gauge_t`.
        class(family_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(:)
        type(hyperdual_t) :: f, s

        s = weighted(q)
        select case (self%member)
        case (1); f = s**2
        case (2); f = t*sin(s)
        case default; f = exp(-0.5_dp*t)*s**3
        end select
    end function family_value

    pure function family_rate(self, t, q, v) result(f_dot)
        !! See `gauge_t`.
        class(family_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(:), v(:)
        type(hyperdual_t) :: f_dot, s, s_dot

        s = weighted(q)
        s_dot = weighted(v)
        select case (self%member)
        case (1); f_dot = 2.0_dp*s*s_dot
        case (2); f_dot = t*cos(s)*s_dot + sin(s)
        case default; f_dot = exp(-0.5_dp*t)*(3.0_dp*s**2*s_dot - 0.5_dp*s**3)
        end select
    end function family_rate

    pure function weighted(q) result(s)
        !! \(q_1 + q_2/2 + q_3/3 + \dots\).
        type(hyperdual_t), intent(in) :: q(:)
        type(hyperdual_t) :: s
        integer :: i

        s = q(1)
        do i = 2, size(q)
            s = s + q(i)*(1.0_dp/i)
        end do
    end function weighted

    subroutine set(self, plain, gauge)
        !! Put `gauge` on top of `plain`.
        class(gauged_system_t), intent(inout) :: self
        class(system_t), intent(in) :: plain  !! with the Lagrangian \(L\)
        class(gauge_t), intent(in) :: gauge  !! \(F\)

        if (allocated(self%gauge)) deallocate (self%gauge)
        allocate (self%gauge, source=gauge)
        call self%wrap(plain)
    end subroutine set

    pure subroutine adopt(self)
        !! See `wrapped_system_t`: a gauge may contain the time and every coordinate.
        class(gauged_system_t), intent(inout) :: self

        call self%wrapped_system_t%adopt()
        self%time_dependent = .true.
        self%timeless_lagrangian = .false.
        self%cyclic = 0
    end subroutine adopt

    pure function lagrangian(self, t, q, v) result(l)
        !! $$ L' = L + \frac{dF}{dt} $$
        class(gauged_system_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = self%inside%lagrangian(t, q, v) + self%gauge%rate(t, q, v)
    end function lagrangian

    pure function energy(self, t, q, v) result(e)
        !! $$ h' = h - \frac{\partial F}{\partial t} $$
        class(gauged_system_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp) :: e
        type(hyperdual_t) :: f, qq(self%ndof)

        qq%re = q
        f = self%gauge%value(hyperdual_t(t, 1.0_dp, 0.0_dp, 0.0_dp), qq)
        e = self%inside%energy(t, q, v) - f%d1
    end function energy

    pure function landau_lagrangian(self, t, q, v) result(l)
        !! $$ L = \tfrac12 mv^2 + e\,E\cdot r + efB_z\,x\,\dot y - \tfrac12kr^2 $$
        class(landau_charge_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*self%m*dot_product(v, v) + self%charge*dot_product(self%electric, q) &
            + self%charge*self%factor*self%magnetic(3)*q(1)*v(2) &
            - 0.5_dp*self%trap*dot_product(q, q)
    end function landau_lagrangian

    pure subroutine landau_momenta(self, t, q, v, p)
        !! \(mv + eA\).
        class(landau_charge_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: p(self%ndof)

        p = self%m*v
        p(2) = p(2) + self%charge*self%factor*self%magnetic(3)*q(1)
    end subroutine landau_momenta

    pure subroutine landau_velocities(self, t, q, p, v)
        !! \((p - eA)/m\).
        class(landau_charge_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), p(self%ndof)
        real(dp), intent(out) :: v(self%ndof)

        v = p
        v(2) = v(2) - self%charge*self%factor*self%magnetic(3)*q(1)
        v = v/self%m
    end subroutine landau_velocities

    pure subroutine landau_forces(self, t, q, v, f)
        !! \(e\,(E + fB_z\dot y\,\hat x) - kr\).
        class(landau_charge_t), intent(in) :: self
        real(dp), intent(in) :: t, q(self%ndof), v(self%ndof)
        real(dp), intent(out) :: f(self%ndof)

        f = self%charge*self%electric - self%trap*q
        f(1) = f(1) + self%charge*self%factor*self%magnetic(3)*v(2)
    end subroutine landau_forces

    pure function chi_value(self, t, q) result(f)
        !! See `gauge_t`.
        class(chi_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(:)
        type(hyperdual_t) :: f

        f = 0.5_dp*self%strength*q(1)*q(2)
    end function chi_value

    pure function chi_rate(self, t, q, v) result(f_dot)
        !! See `gauge_t`.
        class(chi_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(:), v(:)
        type(hyperdual_t) :: f_dot

        f_dot = 0.5_dp*self%strength*(q(1)*v(2) + q(2)*v(1))
    end function chi_rate

    pure function plus_q(self, t, q, v) result(l)
        !! \(c\) = 1 J/rad.
        class(pendulum_with_q), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = self%pendulum_t%lagrangian(t, q, v) + q(1)
    end function plus_q

    pure function plus_q_q_dot(self, t, q, v) result(l)
        !! \(c = m\ell^2\): \(dF/dt = m\ell^2(\dot q^2 + q\ddot q)\).
        class(pendulum_with_q_q_dot), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = self%pendulum_t%lagrangian(t, q, v) + self%m*self%l**2* &
            (v(1)**2 - q(1)*sin(q(1))*(self%g/self%l))
    end function plus_q_q_dot
end module lagrangia_gauged_system
