module test_differentials
    !! Derivatives as they are written by hand, and what depends on what.
    use funit, only: TestMethod, TestSuite
    use lagrangia_judgement, only: is_right, is_unreadable, is_wrong
    use tried_responses, only: judged
    implicit none (type, external)
    private
    public :: differentials_suite

contains

    function differentials_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("differentials")
        call suite%addTest(TestMethod("derivatives_by_hand", &
                                      derivatives_by_hand))
        call suite%addTest(TestMethod("on_what_it_depends", &
                                      on_what_it_depends))
    end function differentials_suite

    subroutine derivatives_by_hand()
        !! With d, partial and primes.
        call judged("double_pendulum", &
                    "d^2V/(dtheta1 dtheta2) = 0", is_right)
        call judged("double_pendulum", &
                    "d^2V/dtheta1^2 = (m1+m2) g l1 cos(theta1)", is_right)
        call judged("double_pendulum", &
                    "partial^2 V/(partial theta1 partial theta2) = 0", is_right)
        call judged("double_pendulum", &
                    "d^2V/dtheta2^2 = m2 g l2 sin(theta2)", is_wrong)
        call judged("double_pendulum", &
                    "theta1'' = theta1_ddot", is_right)
        call judged("double_pendulum", &
                    "V' = 0", is_unreadable)
        call judged("cart_pendulum", &
                    "d/dt((m1+m2) x_dot + m2 l theta_dot cos(theta)) = 0", is_right)
        call judged("cart_pendulum", &
                    "dx/dt = x_dot", is_right)
        call judged("cart_pendulum", &
                    "d x/dt = x_dot", is_right)
        call judged("cart_pendulum", &
                    "d/dt x = x_dot", is_right)
        call judged("cart_pendulum", &
                    "d/dx_dot L = p_x", is_right)
        call judged("cart_pendulum", &
                    "d/dtheta (m2 g l cos(theta)) = -m2 g l sin(theta)", is_right)
        call judged("cart_pendulum", &
                    "d/dtheta(T - V) = dL/dtheta", is_right)
        call judged("cart_pendulum", &
                    "d^2/dt^2 x = x_ddot", is_right)
        call judged("cart_pendulum", &
                    "d^2x/dt^2 = x_ddot", is_right)
        call judged("cart_pendulum", &
                    "d2x/dt2 = x_ddot", is_right)
        call judged("cart_pendulum", &
                    "d(l cos(theta))/dt = -l theta_dot sin(theta)", is_right)
        call judged("cart_pendulum", &
                    "d(l cos(theta))/dtheta = -l sin(theta)", is_right)
        call judged("cart_pendulum", &
                    "(d/dt) x = x_dot", is_unreadable)
        call judged("cart_pendulum", &
                    "d theta/d t = theta_dot", is_right)
        call judged("cart_pendulum", &
                    "partial L/partial theta_dot = p_theta", is_right)
        call judged("cart_pendulum", &
                    "d/dt (dL/dx_dot) = 0", is_right)
        call judged("cart_pendulum", &
                    "d/dt dL/dx_dot - dL/dx = 0", is_right)
        call judged("cart_pendulum", &
                    "x(t) = x", is_right)
        call judged("cart_pendulum", &
                    "d x(t)/dt = x_dot", is_right)
    end subroutine derivatives_by_hand

    subroutine on_what_it_depends()
        !! V(theta), V'(theta), and what is refused.
        call judged("cart_pendulum", &
                    "dV(theta)/dtheta = m2 g l sin(theta)", is_right)
        call judged("cart_pendulum", &
                    "V(theta) = -m2 g l cos(theta)", is_right)
        call judged("cart_pendulum", &
                    "T(x_dot, theta, theta_dot) = (m1 + m2)/2 x_dot^2 + m2/2 l^2"// &
                    " theta_dot^2 + m2 l x_dot theta_dot cos(theta)", is_right)
        call judged("pendulum", &
                    "V(theta) = -m g l cos(theta)", is_right)
        call judged("pendulum", &
                    "T(theta_dot) = m/2 l^2 theta_dot^2", is_right)
        call judged("pendulum", &
                    "L(theta, theta_dot) = m/2 l^2 theta_dot^2 + m g l cos(theta)", is_right)
        call judged("pendulum", &
                    "E = T + V(theta)", is_right)
        call judged("pendulum", &
                    "d/dtheta V = m g l sin(theta)", is_right)
        call judged("pendulum", &
                    "d^2V/dtheta^2 = m g l cos(theta)", is_right)
        call judged("pendulum", &
                    "d^2theta/dt^2 = -g/l sin(theta)", is_right)
        call judged("pendulum", &
                    "d2theta/dt2 = -g/l sin(theta)", is_right)
        call judged("pendulum", &
                    "partial V/partial theta = m g l sin(theta)", is_right)
        call judged("pendulum", &
                    "V'(theta) = m g l sin(theta)", is_right)
        call judged("pendulum", &
                    "V'' = m g l cos(theta)", is_right)
        call judged("pendulum", &
                    "V''(0) = m g l", is_right)
        call judged("pendulum", &
                    "omega^2 = V''(0)/(m l^2)", is_right)
        call judged("pendulum", &
                    "theta'' = -g/l sin(theta)", is_right)
        call judged("pendulum", &
                    "H(theta, p_theta) = p_theta^2/(2 m l^2) - m g l cos(theta)", is_right)
        call judged("pendulum", &
                    "theta_dot = dH/dp_theta", is_right)
        call judged("pendulum", &
                    "d^2T/dtheta_dot^2 = m l^2", is_right)
        call judged("pendulum", &
                    "V(theta) = m g l cos(theta)", is_wrong)
        call judged("pendulum", &
                    "V'(theta) = m g l cos(theta)", is_wrong)
        call judged("pendulum", &
                    "V''(0) = -m g l", is_wrong)
        call judged("pendulum", &
                    "theta'' = g/l sin(theta)", is_wrong)
        call judged("pendulum", &
                    "d^2V/dtheta^2 = m g l sin(theta)", is_wrong)
        call judged("pendulum", &
                    "d theta/dt = p_theta/(m l)", is_wrong)
        call judged("double_pendulum", "V' = 0", is_unreadable, &
                    "column 2: a prime does not say by what; write dV/dtheta1")
        call judged("double_pendulum", "m1 = -V'", is_unreadable, &
                    "column 8: a prime does not say by what; write dV/dtheta1")
        call judged("pendulum", "theta' = theta_dot", is_right)
        call judged("oscillator", "x' = x + 1", is_unreadable, &
                    "column 2: a prime is no derivative; write x_dot")
        call judged("pendulum", "d/dt m l = 0", is_unreadable, &
                    "column 1: of what is it the derivative? Write d/dt(m x_dot)")
        call judged("pendulum", "d + 1 = 0", is_unreadable, &
                    "column 1: a derivative is written d/dt(m x_dot), dV/dx, d^2 x/dt^2 or x_ddot")
        call judged("double_pendulum", "d/dtheta1 p_theta2 = 0", is_unreadable, &
                    "column 1: the derivative of 'p_theta2' by 'theta1' is not known here; "// &
                    "write the formula for it")
        call judged("pendulum", "d q/dt = 0", is_unreadable, &
                    "column 1: unknown name 'q'; there are t, theta, m, l, g, b, L_z, "// &
                    "tension, x_bob, y_bob, z_bob, L, E, p_theta, T, V, omega, theta_eq, pi; "// &
                    "if it is a constant, write a line 'constant: q'")
        call judged("pendulum", "cos(0,5) = 1", is_unreadable, &
                    "column 6: ',' has no meaning here; decimals have a point: 0.5")
    end subroutine on_what_it_depends
end module test_differentials
