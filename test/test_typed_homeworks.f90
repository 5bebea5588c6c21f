module test_typed_homeworks
    !! Sheets as students type them, for systems of the lecture: what is right in each form is
    !! right, and what is wrong has its term named.
    use funit, only: TestMethod, TestSuite
    use traced_sheets, only: traced
    implicit none (type, external)
    private
    public :: typed_homeworks_suite

contains

    function typed_homeworks_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("typed_homeworks")
        call suite%addTest(TestMethod("one_coordinate", one_coordinate))
        call suite%addTest(TestMethod("several_coordinates", several_coordinates))
        call suite%addTest(TestMethod("shipped_scenes", shipped_scenes))
    end function typed_homeworks_suite

    subroutine one_coordinate()
        !! A heavy pulley is in T, although it has no inertia by default; omega as a root, also
        !! where most parameters have an unstable equilibrium.
        call traced("atwood", "rrrrrrrrwwwww", "T = (m_1 + m_2)/2 x_dot^2 + I x_dot^2/(2 R^2)"// &
            "; V = -m_1 g x + m_2 g x; L = (m1 + m2 + I/R^2)/2 x_dot^2 + (m1 - m2)*g*x"// &
            "; x_ddot = (m1-m2)/(m1+m2+I/R**2)*g; tension1 - tension2 = I/R^2 x_ddot"// &
            "; d/dt(p_x) = (m1 - m2) g; p_x = (m1 + m2) x_dot + I x_dot/R^2; E = T + V = const"// &
            "; (m_1 + m_2 + I/R) x_ddot = (m_1 - m_2) g"// &
            "; T = (m1 + m2)/2 x_dot^2 + I x_dot^2/R^2; x_ddot = (m1-m2)/(m1+m2)*g"// &
            "; tension1 = tension2; p_x = const", &
            remarks="9 'R' must have the exponent 2; 10 'I x_dot^2/R^2' must be counted 1/2"// &
            "; 11 on the left is missing; 12 on the left is missing -I/R^2 x_ddot"// &
            "; 13 its rate is (m1 - m2) g: dL/dx is not 0")
        call traced("rotating_hoop", "rrrrrwwww", "V = m g r (1 - cos(theta)); V = m g z_bead"// &
            "; r theta_ddot - r omega^2 sin(2 theta)/2 + g sin(theta) = 0"// &
            "; Omega = sqrt(omega^2 - g^2/(r^2 omega^2)); Omega = sqrt(g/r - omega^2)"// &
            "; Omega = sqrt(g/r + omega^2); Omega = sqrt(omega^2 - g/r)"// &
            "; E = T + V; cos(theta_eq) = g/(r omega)", &
            remarks="6 squared: the sign of 'omega^2'; 8 on the left is missing m r^2 omega^2"// &
            "; 9 'omega' must have the exponent 2")
        call traced("driven_pendulum", "rrrrwwww", "y_bob_dot = -a W sin(W t) + "// &
            "l theta_dot sin(theta); T = m/2 (l^2 theta_dot^2 - 2 a W l theta_dot sin(W t) "// &
            "sin(theta) + a^2 W^2 sin(W t)^2); theta_ddot + (g/l - a W^2/l cos(W t)) sin(theta)"// &
            " = 0; tension = m l theta_dot^2 + m (g - a W^2 cos(W t)) cos(theta)"// &
            "; theta_ddot + (g/l + a W^2/l cos(W t)) sin(theta) = 0"// &
            "; V = m g (a sin(W t) - l cos(theta)); y_bob_dot = -a sin(W t) + l theta_dot "// &
            "sin(theta); T = m/2 (l^2 theta_dot^2 + y_p_dot^2)", &
            remarks="5 the sign of 'a W^2/l cos(W t)'; 6 'sin(W t)' must be 'cos(W t)'"// &
            "; 7 'a sin(W t)' lacks the factor")
    end subroutine one_coordinate

    subroutine several_coordinates()
        call traced("wedge", "rrrrrwwww", "(M+m) q_2_dot + m q_1_dot cos(alpha) = const"// &
            "; q_1_ddot = (M+m) g sin(alpha)/(M + m sin^2(alpha))"// &
            "; q_2_ddot = -m g sin(2 alpha)/(2 M + 2 m sin^2(alpha))"// &
            "; normal_force = m (g cos(alpha) + q2_ddot sin(alpha))"// &
            "; x_block_ddot = q2_ddot + q1_ddot cos(alpha)"// &
            "; q_1_ddot = (M+m) g sin(alpha)/(M + m cos^2(alpha))"// &
            "; normal_force = m g cos(alpha)"// &
            "; q_1_ddot - q_2_ddot cos(alpha) = g sin(alpha)"// &
            "; (M+m) q_2_dot + m q_1_dot sin(alpha) = const", &
            remarks="6 'cos(alpha)' must be 'sin(alpha)'; 7 'm g cos(alpha)' lacks the factor"// &
            "; 8 the sign of 'q2_ddot cos(alpha)'; 9 'sin(alpha)' must be 'cos(alpha)'")
        call traced("charged_particle", "rrrwwww", "dL/dx_dot = m x_dot + e A_x"// &
            "; m x_ddot = e E_x + e (y_dot B_z - z_dot B_y) - trap x"// &
            "; d/dt(m/2 (x_dot^2 + y_dot^2 + z_dot^2)) = e (E_x x_dot + E_y y_dot + E_z z_dot)"// &
            " - trap (x x_dot + y y_dot + z z_dot)"// &
            "; m x_ddot = e E_x + e (y_dot B_z + z_dot B_y) - trap x"// &
            "; m z_ddot = e (E_z + x_dot B_x - y_dot B_y) - trap z; p_x = m x_dot - e A_x"// &
            "; dL/dx = e E_x + e (B_z y_dot - B_y z_dot) - trap x", &
            remarks="4 the sign of 'z_dot B_y'; 5 'B_x' and 'B_y' must be exchanged"// &
            "; 6 the sign of 'e A_x'; 7 'e (B_z y_dot - B_y z_dot)' must be counted 1/2 times")
        call traced("rolling_disk", "rrrrwww", "x_dot = r phi_dot sin(theta)"// &
            "; i_roll phi_ddot = -r lambda_x sin(theta) + r lambda_y cos(theta)"// &
            "; E = (m r^2 + i_roll)/2 phi_dot^2 + i_yaw/2 theta_dot^2 - m g x sin(incline)"// &
            "; x_dot^2 + y_dot^2 = r^2 phi_dot^2; x_dot = r phi_dot cos(theta)"// &
            "; E = m r^2/2 phi_dot^2 + i_yaw/2 theta_dot^2 - m g x sin(incline)"// &
            "; m y_ddot = -lambda_y", &
            remarks="5 'cos(theta)' must be 'sin(theta)'; 6 'm r^2/2 phi_dot^2' lacks"// &
            "; 7 the sign of")
        call traced("hanging_chain", "rrrrww", "x_bob2 = l/3 (sin(theta_1) + sin(theta_2))"// &
            "; V = -m g l/3 (3 cos(theta1) + 2 cos(theta2) + cos(theta3))"// &
            "; small: theta1_ddot + theta2_ddot + theta3_ddot + 3 g/l theta3 = 0"// &
            "; (omega^2 l/(3 g))^3 - 9 (omega^2 l/(3 g))^2 + 18 omega^2 l/(3 g) - 6 = 0"// &
            "; V = -m g l/3 (3 cos(theta1) + 2 cos(theta2) - cos(theta3))"// &
            "; small: theta1_ddot + theta2_ddot + theta3_ddot - 3 g/l theta3 = 0", &
            remarks="5 the sign of 'cos(theta3)'; 6 the sign of '3 g/l theta3'")
    end subroutine several_coordinates

    subroutine shipped_scenes()
        !! Systems in formulas: conserved quantities, generalised forces, a letter d; slips named
        !! by the letter that it is, and no factor that is chance.
        call traced("two_bodies", "rrrrrwww", "L_z = const; d/dt(p_x1 + p_x2) = 0"// &
            "; dL_z/dt = 0; x2_ddot - x1_ddot = -gamma M x/d^3; T = (p_x1^2 + p_y1^2)/(2 m1) "// &
            "+ (p_x2^2 + p_y2^2)/(2 m2); x2_ddot - x1_ddot = -gamma m2 x/d^3"// &
            "; m1 x1_ddot = gamma m1 m2 (x2 - x1)/d^2; T = M/2 (P_x^2 + P_y^2)/M^2 + M/2 "// &
            "(u^2 + w^2)", remarks="6 'm2' must be 'M'; 7 the exponent of 'd^2' must be 3"// &
            "; 8 'M' must be 'mu'")
        call traced("duffing", "rrrww", "m x_ddot = -dV/dx + Q_x; d/dt(p_x) + a x + c x^3 = Q_x"// &
            "; dE/dt = x_dot Q_x; m x_ddot + b x_dot + a x + c x^3 = f cos(t)"// &
            "; m x_ddot = dV/dx + Q_x", remarks="4 't' lacks the factor 'w'; 5 the sign of")
        call traced("spring_pendulum", "rrww", "small: theta_ddot + g/r_eq theta = 0"// &
            "; r_eq = l0 + m g/k; small: theta_ddot + g/l0 theta = 0"// &
            "; small: m r_ddot + k (r - l0) = 0", &
            remarks="3 'l0' must be 'r_eq'; 4 'l0' must be 'r_eq'")
        call traced("symmetric_top", "rrrww", "omega_3 = const; p_psi = I3 omega_3"// &
            "; phi_dot = (p_phi - p_psi cos(theta))/(I1 sin(theta)^2)"// &
            "; phi_dot = (p_phi + p_psi cos(theta))/(I1 sin(theta)^2); p_theta = const", &
            remarks="4 the sign of 'p_psi cos(theta)'"// &
            "; 5 its rate is I1 theta_ddot: dL/dtheta is not 0")
        call traced("foucault", "rrww", "x_ddot - 2 W y_dot + g/l x = 0; p_x = m x_dot - m W y"// &
            "; x_ddot - W y_dot + g/l x = 0; x_ddot - 4 pi/day cos(latitude) y_dot + g/l x = 0", &
            remarks="3 'W y_dot' must be counted 2 times"// &
            "; 4 'cos(latitude)' must be 'sin(latitude)'")
        call traced("rotating_wire", "rrww", "d/dt(m r_dot) = m omega^2 r"// &
            "; dL_z/dt = r wire_force; L_z = const; E = m/2 (r_dot^2 + omega^2 r^2)", &
            remarks="4 the sign of 'omega^2 r^2'")
        call traced("oscillator", "rwww", "T = 2 pi sqrt(m/k); x_ddot = -40.74 k/m x"// &
            "; T = sqrt(m/k); T = pi sqrt(m/k)", &
            remarks="2 the number '40.74' must be 1; 3 'sqrt(m/k)' must be counted 2 pi times"// &
            "; 4 'pi sqrt(m/k)' must be counted 2 times")
    end subroutine shipped_scenes
end module test_typed_homeworks
