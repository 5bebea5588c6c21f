module test_typed_homeworks
    !! Sheets as students type them, for systems of the lecture: what is right in each form is
    !! right, and what is wrong has its term named.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_homework, only: homework_t, parse_homework
    use lagrangia_judgement, only: is_unreadable
    use lagrangia_sheet_lines, only: is_remark
    use traced_sheets, only: traced
    use tried_responses, only: judged
    implicit none (type, external)
    private
    public :: typed_homeworks_suite

    character, parameter :: line_feed = new_line("a")

contains

    function typed_homeworks_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("typed_homeworks")
        call suite%addTest(TestMethod("one_coordinate", one_coordinate))
        call suite%addTest(TestMethod("several_coordinates", several_coordinates))
        call suite%addTest(TestMethod("shipped_scenes", shipped_scenes))
        call suite%addTest(TestMethod("remarks", remarks))
        call suite%addTest(TestMethod("statements_of_a_line", statements_of_a_line))
        call suite%addTest(TestMethod("lines_that_are_refused", lines_that_are_refused))
        call suite%addTest(TestMethod("names_before_their_definition", &
                                      names_before_their_definition))
        call suite%addTest(TestMethod("usual_names", usual_names))
        call suite%addTest(TestMethod("definitions_follow_nothing", definitions_follow_nothing))
        call suite%addTest(TestMethod("constants", constants))
        call suite%addTest(TestMethod("rounded_frequencies", rounded_frequencies))
        call suite%addTest(TestMethod("signs_but_for_a_constant", signs_but_for_a_constant))
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
            "; 11 on the right is missing; 12 on the right is missing I/R^2 x_ddot"// &
            "; 13 its rate is (m1 - m2) g: dL/dx is not 0")
        call traced("rotating_hoop", "rrrrrwwww", "V = m g r (1 - cos(theta)); V = m g z_bead"// &
            "; r theta_ddot - r omega^2 sin(2 theta)/2 + g sin(theta) = 0"// &
            "; Omega = sqrt(omega^2 - g^2/(r^2 omega^2)); Omega = sqrt(g/r - omega^2)"// &
            "; Omega = sqrt(g/r + omega^2); Omega = sqrt(omega^2 - g/r)"// &
            "; E = T + V; cos(theta_eq) = g/(r omega)", &
            remarks="6 squared: the sign of 'omega^2'; 8 on the right is missing -m r^2 omega^2"// &
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

    subroutine remarks()
        !! A formula without its other side is none.
        call assertTrue(is_remark("Bewegungsgleichungen des Doppelpendels"), "heading")
        call assertTrue(is_remark("Damit gilt:"), "colon")
        call assertTrue(is_remark("The energy is conserved, therefore"), "sentence")
        call assertFalse(is_remark("m l theta_ddot"), "formula")
        call assertFalse(is_remark("m g l sin theta"), "formula without brackets")
        call assertFalse(is_remark("sqrt(theta) omega"), "Greek letters and functions")
        call assertFalse(is_remark("energy = const"), "an equality")
        call assertFalse(is_remark("alpha beta + gamma delta"), "a sum")
        call assertFalse(is_remark(""), "nothing")
    end subroutine remarks

    subroutine statements_of_a_line()
        call says("x = l sin(theta), y = -l cos(theta)", "x = l sin(theta)|y = -l cos(theta)")
        call says("x' = v und y' = 0", "x' = v|y' = 0")
        call says("V(theta, t) = 3", "V(theta, t) = 3")
        call says("\begin{align}"//line_feed//"T &= \frac{m}{2} v^2, & V &= m g y \\"// &
                  line_feed//"L &= T - V \\"//line_feed//"&= 5"//line_feed//"\end{align}", &
                  "T  = \frac{m}{2} v^2|V  = m g y|L  = T - V|L = 5")
        call says("\Rightarrow \ddot\theta = 0", "\ddot\theta = 0")
        call says("=> x_ddot = g", "x_ddot = g")
        call says("also gilt: x = 1", "x = 1")
        call says("Newton: m a = F", "m a = F")
        call says("mit D = 3 und E = 4", "D = 3|E = 4")
        call says("da = 3", "da = 3")
        call says("T = 1"//line_feed//"= 2", "T = 1|T = 2")
        call says("T = 1 "//line_feed//"== 2", "T = 1|== 2")
        call says("a = b, c", "a = b, c")
    end subroutine statements_of_a_line

    subroutine says(text, expected)
        !! The statements, with bars between them.
        character(*), intent(in) :: text, expected
        type(homework_t) :: homework
        type(error_t), allocatable :: error
        character(:), allocatable :: found
        integer :: i

        call parse_homework("system: pendulum"//line_feed//text, "sheet", homework, error)
        call assertFalse(allocated(error), text)
        if (allocated(error)) return
        found = ""
        do i = 1, size(homework%statements)
            if (i > 1) found = found//"|"
            found = found//homework%statements(i)%text
        end do
        call assertEqual(expected, found, text)
    end subroutine says

    subroutine lines_that_are_refused()
        !! A mistyped `system:` is no label of a formula.
        type(homework_t) :: homework
        type(error_t), allocatable :: error

        call parse_homework("sytem: pendulum"//line_feed//"x = 1", "sheet", homework, error)
        call assertTrue(allocated(error), "sytem")
        call parse_homework("system: pendulum"//line_feed//"smal: x = 1", "sheet", homework, error)
        call assertTrue(allocated(error), "smal")
        call parse_homework("system: pendulum"//line_feed//"constant: ,"//line_feed//"x = 1", &
                            "sheet", homework, error)
        call assertTrue(allocated(error), "constant")
    end subroutine lines_that_are_refused

    subroutine names_before_their_definition()
        !! Also of definitions that wait for another one.
        call traced("kepler", "0r0w", "p = l^2/(m k); p = l^2/(m k); l = m r^2 phi_dot"// &
                    "; p = l/(m k)")
        call traced("double_pendulum", "rw0", "l2 theta2_ddot + l1 theta1_ddot cos(W) - l1 "// &
                    "theta1_dot^2 sin(W) + g sin(theta2) = 0; l2 theta2_ddot + l1 theta1_ddot "// &
                    "cos(W) + l1 theta1_dot^2 sin(W) + g sin(theta2) = 0; W = theta1 - theta2", &
                    remarks="2 the sign of 'l1 theta1_dot^2 sin(theta1 - theta2)'")
    end subroutine names_before_their_definition

    subroutine usual_names()
        !! A definition is wrong if lines are right with the usual meaning of its name only.
        call traced("atwood", "rw", "m1 x_ddot = m1 g - S; S = m1 g", &
                    remarks="2 'm1 g' lacks the factor '2 m2/(m1 + m2)'")
        call traced("atwood", "wr", "S = m1 g; m1 x_ddot = m1 g - S")
        call traced("atwood", "0w", "S = m1 g; m1 x_ddot = m1 g - 2 S")
        call traced("wedge", "wr", "N = m g cos(alpha); M q2_ddot = -N sin(alpha)", &
                    remarks="1 'm g cos(alpha)' lacks the factor 'M/(M + m sin(alpha)^2)'")
        call traced("wedge", "0", "N = m g cos(alpha)", remarks="1 taken for a new name: not")
        call traced("rotating_wire", "rw", "F_Zwang = 2 m omega r_dot; F_Zwang = m omega r_dot")
        call traced("oscillator", "wr", "omega_0^2 = 2 k/m; x_ddot = -omega_0^2 x")
        call traced("pendulum", "0rw", "omega = theta_dot; E = m/2 l^2 omega^2 - m g l "// &
                    "cos(theta); omega_dot = g/l sin(theta)")
        call traced("charged_particle", "w", "v^2 = const", &
                    remarks="1 it changes: its rate is not 0")
        call traced("pendulum", "rrr", "v = l theta_dot; m l v_dot = -m g l sin(theta)"// &
                    "; v^2 = l^2 theta_dot^2")
        call traced("oscillator", "wr", "T = 2 pi m/k; T = 2 pi sqrt(m/k)", &
                    remarks="1 a square root is missing behind '2 pi'")
        call traced("pendulum", "0", "F = -m g sin(theta) = m l theta_ddot")
        call traced("pendulum", "w", "F = -m g sin(theta) = -m l theta_ddot")
    end subroutine usual_names

    subroutine definitions_follow_nothing()
        !! A wrong frequency does not follow from any wrong line before, as its name is new.
        call traced("coupled_oscillators", "ww", "m x1_ddot + (k + k_c) x1 + k_c x2 = 0"// &
                    "; omega_2^2 = (k + k_c)/(2 m)")
    end subroutine definitions_follow_nothing

    subroutine constants()
        call traced("pendulum", "rwwu", "theta_dot^2 = 2 g/l (cos(theta) - cos(theta_0))"// &
                    "; theta_dot^2 = 2 g/l (cos(theta_0) - cos(theta))"// &
                    "; theta_dot^2 = g/l (cos(theta) - cos(theta_0))"// &
                    "; theta_dot^2 = 2 g/l (cos(theta) - sin(theta_0))")
        call traced("pendulum", "rw", "constant: h, C; theta_dot = sqrt(2/(m l^2) "// &
                    "(h + m g l cos(theta))); theta_dot^2/2 = -g/l cos(theta) + h")
        call traced("kepler", "r", "constant: H0; m/2 r_dot^2 + p_phi^2/(2 m r^2) - k/r = H0")
        call judged("pendulum", "constant: C"//line_feed//"theta_dot^2 = 2 g/l (cos(theta) - "// &
                    "cos(theta_0)) + C", is_unreadable, "is 'theta_0' where the motion begins? "// &
                    "It does not hold there; a line 'constant: theta_0' makes it any constant")
        call judged("pendulum", "constant: C, theta"//line_feed//"theta_ddot = C", 0, &
                    "sheet:2: constant: 'theta' has a meaning here; call the constant another name")
        call judged("pendulum", "set: g = 9.81"//line_feed//"constant: 2x"//line_feed// &
                    "theta_ddot = 0", 0, "sheet:3: constant: '2x' is no name for a formula; "// &
                                         "write letters, digits and underscores, a letter "// &
                                         "first, as in theta1")
        call traced("atwood", "0rrwr", "constant: l; y = l - pi R - x; y_dot = -x_dot"// &
                    "; V = -m1 g x - m2 g y; V = -m1 g x + m2 g y; V = -m1 g x - m2 g (l - x)", &
                    remarks="3 but for a constant")
        call traced("atwood", "u", "V = -m1 g x - m2 g (l - x)", &
                    remarks="1 column 21: unknown name 'l'")
    end subroutine constants

    subroutine rounded_frequencies()
        !! The name of a rounded frequency goes on with all digits.
        call traced("pendulum", "rrr", "set: g = 9.81; set: l = 1; omega_1 = 3.13"// &
                    "; theta = A cos(omega_1 t); T_1 = 2 pi/omega_1")
        call traced("pendulum", "rw", "set: g = 9.81; set: l = 1; theta = A cos(3.13 t)"// &
                    "; theta = B cos(3.12 t)")
        call traced("coupled_oscillators", "rw", "set: k = 10; set: m = 1; set: k_c = 1"// &
                    "; f_1 = 0.503; f_2 = 0.553", &
                    remarks="2 no small oscillation has this frequency")
    end subroutine rounded_frequencies

    subroutine signs_but_for_a_constant()
        call traced("pendulum", "w", "V(theta) = m g l (1 + cos(theta))", &
                    remarks="1 the sign of 'cos(theta)'")
        call traced("pendulum", "r", "V(theta) = m g l (1 - cos(theta))")
    end subroutine signs_but_for_a_constant
end module test_typed_homeworks
