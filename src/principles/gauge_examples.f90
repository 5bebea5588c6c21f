module lagrangia_gauge_examples
    !! Other Lagrangians of known systems: two that tell the same motion, and some that do not.
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_gauged_system, only: gauge_t
    use lagrangia_hyperdual, only: dot_product, hyperdual_t, operator(*), operator(**), &
                                   operator(+), operator(-), sin
    use lagrangia_kinds, only: dp
    use lagrangia_pendulum, only: pendulum_t
    implicit none (type, external)
    private
    public :: chi_t, landau_charge_t, pendulum_with_q, pendulum_with_q_q_dot

    type, extends(charged_particle_t) :: landau_charge_t
        !! The charge with \(A = (0, fB_zx, 0)\), `magnetic` along z: Landau's gauge if \(f = 1\).
        real(dp) :: factor = 1.0_dp
    contains
        procedure :: lagrangian => landau_lagrangian
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

    pure function landau_lagrangian(self, t, q, v) result(l)
        !! $$ L = \tfrac12 mv^2 + e\,E\cdot r + efB_z\,x\,\dot y - \tfrac12kr^2 $$
        class(landau_charge_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof), v(self%ndof)
        type(hyperdual_t) :: l

        l = 0.5_dp*self%m*dot_product(v, v) + self%charge*dot_product(self%electric, q) &
            + self%charge*self%factor*self%magnetic(3)*q(1)*v(2) &
            - 0.5_dp*self%trap*dot_product(q, q)
    end function landau_lagrangian

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
end module lagrangia_gauge_examples
