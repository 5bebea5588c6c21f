module lagrangia_concrete_loops
    !! RK4 written for one system each, in plain scalars: what the contracts are measured against.
    !!
    !! The equations and the tableau are those of `lagrangia_pendulum`, `lagrangia_double_pendulum`
    !! and `lagrangia_rk4`; here the compiler sees all at once, and there is nothing to dispatch.
    use lagrangia_kinds, only: dp, i8
    implicit none (type, external)
    private
    public :: rk4_double_pendulum, rk4_pendulum

contains

    pure subroutine rk4_pendulum(p, dt, steps, q, v)
        !! Parameters m, l, g.
        real(dp), intent(in) :: p(3), dt
        integer(i8), intent(in) :: steps
        real(dp), intent(inout) :: q(1), v(1)
        real(dp) :: x, w, w2, w3, w4, a1, a2, a3, a4, half, factor
        integer(i8) :: k

        half = 0.5_dp*dt
        factor = -p(3)/p(2)
        x = q(1)
        w = v(1)
        do k = 1, steps
            a1 = factor*sin(x)
            w2 = w + half*a1
            a2 = factor*sin(x + half*w)
            w3 = w + half*a2
            a3 = factor*sin(x + half*w2)
            w4 = w + dt*a3
            a4 = factor*sin(x + dt*w3)
            x = x + dt/6.0_dp*(w + 2.0_dp*(w2 + w3) + w4)
            w = w + dt/6.0_dp*(a1 + 2.0_dp*(a2 + a3) + a4)
        end do
        q(1) = x
        v(1) = w
    end subroutine rk4_pendulum

    pure subroutine rk4_double_pendulum(p, dt, steps, q, v)
        !! Parameters m1, m2, l1, l2, g.
        real(dp), intent(in) :: p(5), dt
        integer(i8), intent(in) :: steps
        real(dp), intent(inout) :: q(2), v(2)
        real(dp) :: x, y, u, w, u2, w2, u3, w3, u4, w4, a1, b1, a2, b2, a3, b3, a4, b4, half
        integer(i8) :: k

        half = 0.5_dp*dt
        x = q(1)
        y = q(2)
        u = v(1)
        w = v(2)
        do k = 1, steps
            call accelerations(x, y, u, w, a1, b1)
            u2 = u + half*a1
            w2 = w + half*b1
            call accelerations(x + half*u, y + half*w, u2, w2, a2, b2)
            u3 = u + half*a2
            w3 = w + half*b2
            call accelerations(x + half*u2, y + half*w2, u3, w3, a3, b3)
            u4 = u + dt*a3
            w4 = w + dt*b3
            call accelerations(x + dt*u3, y + dt*w3, u4, w4, a4, b4)
            x = x + dt/6.0_dp*(u + 2.0_dp*(u2 + u3) + u4)
            y = y + dt/6.0_dp*(w + 2.0_dp*(w2 + w3) + w4)
            u = u + dt/6.0_dp*(a1 + 2.0_dp*(a2 + a3) + a4)
            w = w + dt/6.0_dp*(b1 + 2.0_dp*(b2 + b3) + b4)
        end do
        q = [x, y]
        v = [u, w]
    contains
        pure subroutine accelerations(x, y, u, w, a, b)
            real(dp), intent(in) :: x, y, u, w
            real(dp), intent(out) :: a, b
            real(dp) :: s, c, s1, s2, d, m

            m = p(1) + p(2)
            s = sin(x - y)
            c = cos(x - y)
            s1 = sin(x)
            s2 = sin(y)
            d = p(1) + p(2)*s**2
            a = (-p(2)*s*(p(3)*u**2*c + p(4)*w**2) - m*p(5)*s1 + p(2)*p(5)*s2*c)/(p(3)*d)
            b = (m*p(3)*u**2*s + p(2)*p(4)*w**2*s*c + m*p(5)*(s1*c - s2))/(p(4)*d)
        end subroutine accelerations
    end subroutine rk4_double_pendulum
end module lagrangia_concrete_loops
