module test_small_energies
    !! L, T, V and E behind `small:`: right to second order about an equilibrium, of all systems
    !! that have one.
    use funit, only: TestMethod, TestSuite
    use traced_sheets, only: traced
    implicit none (type, external)
    private
    public :: small_energies_suite

contains

    function small_energies_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("small_energies")
        call suite%addTest(TestMethod("of_a_pendulum", of_a_pendulum))
        call suite%addTest(TestMethod("of_lecture_systems", of_lecture_systems))
        call suite%addTest(TestMethod("of_scenes", of_scenes))
        call suite%addTest(TestMethod("away_from_zero", away_from_zero))
        call suite%addTest(TestMethod("momenta_and_letters_that_move", &
                                      momenta_and_letters_that_move))
        call suite%addTest(TestMethod("energies_with_another_constant", &
                                      energies_with_another_constant))
        call suite%addTest(TestMethod("orders_that_are_written", orders_that_are_written))
        call suite%addTest(TestMethod("accelerations_of_two_coordinates", &
                                      accelerations_of_two_coordinates))
        call suite%addTest(TestMethod("negligible_terms", negligible_terms))
    end function small_energies_suite

    subroutine of_a_pendulum()
        !! In every form; what is of another order, and each kind of slip.
        call traced("pendulum", "rrrrrrrrrw", "small: L = m l^2 theta_dot^2/2 - m g l theta^2/2"// &
            "; small: T = m l^2 theta_dot^2/2; small: V = m g l theta^2/2"// &
            "; small: E = m l^2 theta_dot^2/2 + m g l theta^2/2"// &
            "; small: E = T + V = m l^2 theta_dot^2/2 + m g l theta^2/2"// &
            "; small: V = m g l (1 - cos(theta)); small: V = -m g l (1 - theta^2/2)"// &
            "; small: L = l^2 theta_dot^2/2 - g l theta^2/2"// &
            "; small: L = m l^2 theta_dot^2/2 - m g l theta^2/2 + 3 theta_dot theta - theta^4"// &
            "; small: T = m l^2 theta_dot^2/2 + 1", &
            remarks="1 but for a constant; 8 another L of the same motion")
        call traced("pendulum", "wwwwwwwf", "small: L = m l^2 theta_dot^2/2 + m g l theta^2/2"// &
            "; small: V = m g theta^2/2; small: V = m g l theta^2; small: V = m g l theta"// &
            "; small: V = -m g l (1 - cos(theta)); small: T = m l theta_dot^2/2"// &
            "; small: L = theta_dot theta; small: E = m l^2 theta_dot^2/2 - m g l theta^2/2", &
            remarks="1 the sign of 'm g l theta^2/2'; 2 'm g theta^2/2' lacks the factor 'l'"// &
            "; 3 'm g l theta^2' must be counted 1/2 times; 4 'm g l theta' lacks the factor"// &
            "; 5 the sign of; 6 'l' must have the exponent 2; 8 from line 6")
        ! what follows from a wrong V, and what cannot be judged
        call traced("pendulum", "wfuu", "small: V = -m g l theta^2/2"// &
            "; small: L = m/2 l^2 theta_dot^2 + m g l theta^2/2"// &
            "; small: E = m l^2 theta_ddot theta/2; small: V = log(theta)", &
            remarks="3 'theta_ddot' in a statement about L; 4 no number at rest")
    end subroutine of_a_pendulum

    subroutine of_lecture_systems()
        call traced("oscillator", "rww", "small: L = m x_dot^2/2 - k x^2/2; small: V = k x^2"// &
            "; small: E = m/2 x_dot^2 + k/2 x", &
            remarks="2 'k x^2' must be counted 1/2 times; 3 'x' must have the exponent 2")
        call traced("cart_pendulum", "rrrrwww", "small: T = (m1 + m2)/2 x_dot^2 + "// &
            "m2/2 l^2 theta_dot^2 + m2 l x_dot theta_dot; small: V = m2 g l theta^2/2"// &
            "; small: L = (m1 + m2)/2 x_dot^2 + m2/2 l^2 theta_dot^2 + m2 l x_dot theta_dot"// &
            " - m2 g l theta^2/2"// &
            "; small: E = T + V = (m1 + m2)/2 x_dot^2 + m2/2 l^2 theta_dot^2 + m2 l x_dot "// &
            "theta_dot + m2 g l theta^2/2; small: V = m1 g l theta^2/2"// &
            "; small: T = (m1 + m2)/2 x_dot^2 + m2/2 l^2 theta_dot^2 + m2 l x_dot theta"// &
            "; small: T = (m1 + m2)/2 x_dot^2 + m2/2 l^2 theta_dot^2", &
            remarks="5 'm1' must be 'm2'; 6 'theta' must be 'theta_dot'; 7 on the right is missing")
        call traced("double_pendulum", "rrrwwr", "small: L = T - V"// &
            "; small: V = (m1 + m2) g l1 theta1^2/2 + m2 g l2 theta2^2/2"// &
            "; small: T = (m1 + m2)/2 l1^2 theta1_dot^2 + m2/2 l2^2 theta2_dot^2 + "// &
            "m2 l1 l2 theta1_dot theta2_dot"// &
            "; small: V = (m1 + m2) g l1 theta1^2/2 + m1 g l2 theta2^2/2"// &
            "; small: T = (m1 + m2)/2 l1^2 theta1_dot^2 + m2/2 l2^2 theta2_dot^2 - "// &
            "m2 l1 l2 theta1_dot theta2_dot"// &
            "; small: T = (m1 + m2)/2 l1^2 theta1_dot^2 + m2/2 l2^2 theta2_dot^2 + "// &
            "m2 l1 l2 theta1_dot theta2_dot cos(D)", &
            remarks="4 'm1' must be 'm2'; 5 the sign of 'm2 l1 l2 theta1_dot theta2_dot'")
        call traced("rotating_wire", "rrw", "small: L = m/2 (r_dot^2 + omega^2 r^2)"// &
            "; small: E = m/2 (r_dot^2 - omega^2 r^2); small: L = m/2 (r_dot^2 - omega^2 r^2)", &
            remarks="3 the sign of 'omega^2 r^2'")
        call traced("rotating_hoop", "rrrrw", "small: T = m/2 r^2 (theta_dot^2 + "// &
            "omega^2 theta^2); small: V = m g r theta^2/2"// &
            "; small: L = m/2 r^2 theta_dot^2 - m r (g - r omega^2) theta^2/2"// &
            "; small: E = m/2 r^2 theta_dot^2 + m r (g - r omega^2) theta^2/2"// &
            "; small: T = m/2 r^2 theta_dot^2", remarks="5 on the right is missing")
        call traced("hanging_chain", "rrww", "small: V = m g l/6 (3 theta1^2 + 2 theta2^2 + "// &
            "theta3^2); small: L = T - m g l/6 (3 theta1^2 + 2 theta2^2 + theta3^2)"// &
            "; small: V = m g l/6 (3 theta1^2 + 2 theta2^2 - theta3^2)"// &
            "; small: V = m g l/6 (3 theta1^2 + 3 theta2^2 + theta3^2)", &
            remarks="3 the sign of 'theta3^2'; 4 the number '3' must be 2")
    end subroutine of_lecture_systems

    subroutine of_scenes()
        !! Those that have an equilibrium at zero, and the others' refusals.
        call traced("beads_on_a_cycloid", "rrw", "small: T = 2 m R^2 (u1_dot^2 + u2_dot^2 + "// &
            "u3_dot^2); small: V = m g R/2 (u1^2 + u2^2 + u3^2)"// &
            "; small: V = m g R (u1^2 + u2^2 + u3^2)", &
            remarks="3 'm g R (u1^2 + u2^2 + u3^2)' must be counted 1/2 times")
        call traced("beads_on_a_parabola", "rw", "small: T = m/2 (x1_dot^2 + x2_dot^2)"// &
            "; small: T = m/2 (x1_dot^2 - x2_dot^2)", remarks="2 the sign of 'x2_dot^2'")
        call traced("beads_on_a_string", "rwr", "small: V = F/d (y_1^2 + y_2^2 + y_3^2 + "// &
            "y_4^2 + y_5^2 - y_1 y_2 - y_2 y_3 - y_3 y_4 - y_4 y_5)"// &
            "; small: V = F/d (y_1^2 + y_2^2 + y_3^2 + y_4^2 + y_5^2 - y_1 y_2 - y_2 y_3 - "// &
            "y_3 y_4 + y_4 y_5); small: L = sum(i, 1, 5, m/2 y_i_dot^2) - V", &
            remarks="2 the sign of 'y_4 y_5'")
        call traced("coupled_oscillators", "rrw", "small: V = (k + k_c)/2 (x1^2 + x2^2) - "// &
            "k_c x1 x2; small: E = m/2 (x1_dot^2 + x2_dot^2) + (k + k_c)/2 (x1^2 + x2^2) - "// &
            "k_c x1 x2; small: V = (k + k_c)/2 (x1^2 + x2^2) + k_c x1 x2", &
            remarks="3 the sign of 'k_c x1 x2'")
        call traced("double_pendulum_formulas", "rrww", "small: V = ((m1 + m2) g l1 theta1^2 + "// &
            "m2 g l2 theta2^2)/2; small: T = m1/2 l1^2 theta1_dot^2 + "// &
            "m2/2 (l1 theta1_dot + l2 theta2_dot)^2; small: V = ((m1 + m2) g l1 theta1^2 + "// &
            "m2 g l2 theta2)/2; small: T = m1/2 l1^2 theta1_dot^2 + "// &
            "m2/2 (l1 theta1_dot - l2 theta2_dot)^2", &
            remarks="3 'theta2' must have the exponent 2; 4 the sign of 'l2 theta2_dot'")
        call traced("dry_friction", "rw", "small: L = m/2 x_dot^2 - k/2 x^2"// &
            "; small: L = m/2 x_dot^2 + k/2 x^2", remarks="2 the sign of 'k/2 x^2'")
        call traced("foucault", "rrww", "small: V = m g/(2 l) (x^2 + y^2)"// &
            "; small: L = m/2 (x_dot^2 + y_dot^2) + 2 m W x y_dot - m g/(2 l) (x^2 + y^2)"// &
            "; small: L = m/2 (x_dot^2 + y_dot^2) + m W x y_dot - m g/(2 l) (x^2 + y^2)"// &
            "; small: V = m g/l (x^2 + y^2)", &
            remarks="2 another L of the same motion; 4 'm g/l (x^2 + y^2)' must be counted 1/2")
        call traced("rotating_frame", "rrw", "small: L = m/2 ((x_dot - omega y)^2 + "// &
            "(y_dot + omega x)^2); small: E = m/2 (x_dot^2 + y_dot^2) - m/2 omega^2 (x^2 + y^2)"// &
            "; small: L = m/2 ((x_dot + omega y)^2 + (y_dot + omega x)^2)", &
            remarks="3 the sign of 'omega y'")
        call traced("spherical_pendulum", "rrww", "small: L = m/2 (x_dot^2 + y_dot^2) - "// &
            "m g/(2 l) (x^2 + y^2); small: T = m/2 (x_dot^2 + y_dot^2)"// &
            "; small: L = m/2 (x_dot^2 + y_dot^2) - m g/l (x^2 + y^2)"// &
            "; small: V = m g/(2 l) (x^2 - y^2)", &
            remarks="3 'm g/l (x^2 + y^2)' must be counted 1/2 times; 4 the sign of 'y^2'")
        call traced("atwood", "u", "small: V = (m2 - m1) g x", remarks="1 no equilibrium")
        call traced("pendulum_in_x_and_y", "u", "small: V = m g y", &
                    remarks="1 the linearised motion is not known")
    end subroutine of_scenes

    subroutine away_from_zero()
        !! In the coordinates, with `r_eq`, or counted from there.
        call traced("spring_pendulum", "rrrrrwwww", "small: L = m/2 (r_dot^2 + "// &
            "r_eq^2 theta_dot^2) - k/2 (r - r_eq)^2 - m g r_eq theta^2/2"// &
            "; small: L = m/2 (r_dot^2 + r_eq^2 theta_dot^2) - k/2 r^2 - m g r_eq theta^2/2"// &
            "; small: T = m/2 (r_dot^2 + r_eq^2 theta_dot^2)"// &
            "; small: V = k/2 (r - r_eq)^2 + m g r_eq theta^2/2"// &
            "; small: V = k/2 (r - l0)^2 + m g r_eq theta^2/2 - m g r"// &
            "; small: T = m/2 (r_dot^2 + r_eq theta_dot^2)"// &
            "; small: L = m/2 (r_dot^2 + r_eq^2 theta_dot^2) + k/2 (r - r_eq)^2 - "// &
            "m g r_eq theta^2/2; small: V = k/2 (r - r_eq)^2 + m g l0 theta^2/2"// &
            "; small: V = k/2 r^2 - m g r_eq theta^2/2", &
            remarks="2 if the coordinates are counted; 6 'r_eq' must have the exponent 2"// &
            "; 7 the sign of 'k/2 (r - r_eq)^2'; 8 'l0' must be 'r_eq'"// &
            "; 9 the sign of 'm g r_eq theta^2/2', if the coordinates are counted from")
        call traced("rotating_hoop", "rrwr", "small: L = m/2 r^2 theta_dot^2 + m r^2 omega^2 "// &
            "cos(theta_eq)^2/2 (theta - theta_eq)^2 - m r^2 omega^2 (theta - theta_eq)^2/2"// &
            "; small: L = m/2 r^2 (theta_dot^2 - omega^2 sin(theta_eq)^2 (theta - theta_eq)^2)"// &
            "; small: L = m/2 r^2 (theta_dot^2 + omega^2 sin(theta_eq)^2 (theta - theta_eq)^2)"// &
            "; small: L = m/2 r^2 (theta_dot^2 - omega^2 sin(theta_eq)^2 theta^2)", &
            remarks="3 the sign of 'omega^2 sin(theta_eq)^2; 4 if the coordinates are counted")
    end subroutine away_from_zero

    subroutine momenta_and_letters_that_move()
        !! To first order: what the page calls D, and what is derived from L.
        call traced("double_pendulum", "rrwrwrw", "small: D = theta1 - theta2"// &
            "; small: l2 theta2_ddot + l1 theta1_ddot cos(D) - l1 theta1_dot^2 sin(D) + "// &
            "g theta2 = 0; small: l2 theta2_ddot + l1 theta1_ddot cos(D) - "// &
            "l1 theta1_dot^2 sin(D) - g theta2 = 0; small: D_dot = theta1_dot - theta2_dot"// &
            "; small: D_ddot = theta1_ddot + theta2_ddot"// &
            "; small: p_theta1 = (m1 + m2) l1^2 theta1_dot + m2 l1 l2 theta2_dot"// &
            "; small: p_theta1 = (m1 + m2) l1^2 theta1_dot - m2 l1 l2 theta2_dot", &
            remarks="3 the sign of 'g theta2'; 5 the sign of 'theta2_ddot'"// &
            "; 7 the sign of 'm2 l1 l2 theta2_dot'")
        call traced("pendulum", "rrrw", "small: dL/dtheta = -m g l theta"// &
            "; small: d/dt dL/dtheta_dot = m l^2 theta_ddot; small: theta_ddot = "// &
            "dL/dtheta/(m l^2); small: dL/dtheta = m g l theta", &
            remarks="4 the sign of 'm g l theta'")
        call traced("cart_pendulum", "0rw", "a = x + l theta"// &
            "; small: m1 x_ddot + m2 a_ddot = 0; small: m1 x_ddot = m2 a_ddot", &
            remarks="3 the sign of 'm2 (x_ddot + l theta_ddot)'")
    end subroutine momenta_and_letters_that_move

    subroutine energies_with_another_constant()
        !! Not small ones as well: the slip is found beside a constant that does not count.
        call traced("pendulum", "wwr", "V = -m g l (1 - cos(theta))"// &
            "; E = m/2 l^2 theta_dot^2 + m g (1 - cos(theta))"// &
            "; E = T + V = m/2 l^2 theta_dot^2 + m g l (1 - cos(theta))", &
            remarks="1 the sign of '-m g l (1 - cos(theta))'; 2 'm g (1 - cos(theta))' lacks")
    end subroutine energies_with_another_constant

    subroutine accelerations_of_two_coordinates()
        !! At rest \(\ddot x = m_2g\sin\theta\cos\theta/(m_1 + m_2\sin^2\theta)\) and
        !! \(\ddot\theta = -(m_1 + m_2)g\sin\theta/(l(m_1 + m_2\sin^2\theta))\), to third order.
        call traced("cart_pendulum", "rrwf", &
            "small: x_ddot = m2 g/m1 (theta - (2/3 + m2/m1) theta^3)"// &
            "; small: theta_ddot = -(m1 + m2) g/(m1 l) (theta - (1/6 + m2/m1) theta^3)"// &
            "; small: x_ddot = m2 g/m1 (theta - (1/3 + m2/m1) theta^3)"// &
            "; small: theta_ddot = -(m1 + m2) g/(m1 l) (theta - theta^3/6)", &
            "3 terms of order 3 are written; 4 from line 4")
        call traced("cart_pendulum", "w", &
            "small: theta_ddot = -(m1 + m2) g/(m1 l) (theta - theta^3/6)", &
            "1 terms of order 3 are written")
    end subroutine accelerations_of_two_coordinates

    subroutine orders_that_are_written()
        !! An approximation holds to the order that it writes.
        call traced("pendulum", "rwrrwrfrrw", "cos(theta) ~ 1 - theta^2/2;"// &
                    "cos(theta) ~ 1 - theta^2; cos(theta) ~ 1; sin(theta) ~ theta - theta^3/6;"// &
                    "sin(theta) ~ theta - theta^3/3; small: 1 - cos(theta) = theta^2/2;"// &
                    "small: 1 - cos(theta) = theta^2;"// &
                    "sqrt(1 + theta) ~ 1 + theta/2 - theta^2/8;"// &
                    "-g/l sin(theta) ~ -g/l (theta - theta^3/6); tan(theta) ~ theta + theta^2", &
                    "2 terms of order 2 are written; 5 terms of order 3 are written")
        call traced("double_pendulum", "rwr", &
                    "cos(theta1 - theta2) ~ 1 - (theta1 - theta2)^2/2;"// &
                    "cos(theta1 - theta2) ~ 1 - (theta1 - theta2)^2; cos(theta1 - theta2) ~ 1")
        ! of equations of motion, about either equilibrium, counted from it or not
        call traced("pendulum", "rwfrf", "theta_ddot ~ -g/l (theta - theta^3/6);"// &
                    "theta_ddot ~ -g/l theta + g/(5 l) theta^3; theta_ddot ~ -g/l theta + "// &
                    "theta^2; small: l theta_ddot = -g theta + g theta^3/6; small: l theta_ddot"// &
                    " = -g theta + g theta^5/120", "2 terms of order 3 are written")
        call traced("pendulum", "w", "theta_ddot ~ -g/l theta + theta^2", &
                    "1 terms of order 2 are written")
        call traced("pendulum", "w", "small: m g theta^5 = 120 (m l theta_ddot + m g theta)", &
                    "1 terms of order 5 are written")
        call traced("pendulum", "rrwrfrw", "theta_eq = pi; theta_ddot ~ g/l (theta - pi) - "// &
                    "g/(6 l) (theta - pi)^3; theta_ddot ~ g/l (theta - pi) - g/(3 l) "// &
                    "(theta - pi)^3; theta_ddot ~ g/l theta - g/(6 l) theta^3; theta_ddot ~ "// &
                    "g/l theta + g/(6 l) theta^3; sin(theta) ~ -(theta - pi) + (theta - pi)^3/6"// &
                    "; sin(theta) ~ -(theta - pi) + (theta - pi)^3/5", "3 terms of order 3 are "// &
                    "written; 7 terms of order 3 are written")
        ! theta_ddot of a cart-pendulum is -g/(m1 l) ((m1 + m2) theta - ((m1 + m2)/6 + m2 (m1 +
        ! m2)/m1) theta^3), at a turning point
        call traced("cart_pendulum", "rrwr", "theta_ddot ~ -(m1 + m2) g/(m1 l) theta;"// &
                    "theta_ddot ~ -(m1 + m2) g/(m1 l) (theta - (1/6 + m2/m1) theta^3);"// &
                    "theta_ddot ~ -(m1 + m2) g/(m1 l) (theta - (1/5 + m2/m1) theta^3);"// &
                    "m2 l theta_ddot + m2 x_ddot ~ -m2 g theta", &
                    "3 terms of order 3 are written")
        ! a power that is not whole is in no series
        call traced("pendulum", "w", "sin(theta) ~ theta + (theta^2)^1.75", &
                    "1 terms of order 7/2 are written")
        ! of momenta
        call traced("pendulum", "rw", "p_theta ~ m l^2 theta_dot;"// &
                    "p_theta ~ m l^2 theta_dot (1 + theta^2)", "2 terms of order 3 are written")
        call traced("cart_pendulum", "rrww", "p_x ~ (m1 + m2) x_dot + m2 l theta_dot;"// &
                    "p_x ~ (m1 + m2) x_dot + m2 l theta_dot (1 - theta^2/2);"// &
                    "p_x ~ (m1 + m2) x_dot + m2 l theta_dot (1 - theta^2);"// &
                    "p_theta ~ m2 l^2 theta_dot + m2 l x_dot (1 + theta)", &
                    "3 terms of order 3 are written; 4 terms of order 2 are written")
        ! of energies
        call traced("pendulum", "rwrfww", "V ~ m g l (theta^2/2 - theta^4/24);"// &
                    "V ~ m g l (theta^2/2 - theta^4/20); L ~ m/2 l^2 theta_dot^2 - "// &
                    "m g l (theta^2/2 - theta^4/24); L ~ m/2 l^2 theta_dot^2 - "// &
                    "m g l (theta^2/2 - theta^4/20); T ~ m/2 l^2 theta_dot^2 (1 + theta^2);"// &
                    "E ~ m l^2 theta_dot^2/2 + m g l theta^2/2 + m g l theta^3", &
                    "2 terms of order 4 are written; 5 terms of order 4 are written; "// &
                    "6 terms of order 3 are written")
        call traced("pendulum", "rrw", "theta_eq = pi; V ~ -m g l (theta^2/2 - theta^4/24);"// &
                    "V ~ -m g l (theta^2/2 - theta^4/20)", "3 terms of order 4 are written")
        call traced("cart_pendulum", "rrw", "T ~ (m1 + m2)/2 x_dot^2 + m2/2 l^2 theta_dot^2 + "// &
                    "m2 l x_dot theta_dot; T ~ (m1 + m2)/2 x_dot^2 + m2/2 l^2 theta_dot^2 + "// &
                    "m2 l x_dot theta_dot (1 - theta^2/2); T ~ (m1 + m2)/2 x_dot^2 + "// &
                    "m2/2 l^2 theta_dot^2 + m2 l x_dot theta_dot (1 - theta^2)", &
                    "3 terms of order 4 are written")
        call traced("pendulum", "rwrr", "theta cos(theta) ~ theta - theta^3/2;"// &
                    "theta cos(theta) ~ theta - theta^3; cos(theta)^2 ~ 1 - sin(theta)^2;"// &
                    "theta/cos(theta) ~ theta + theta^3/2")
    end subroutine orders_that_are_written

    subroutine negligible_terms()
        !! A single product of higher than first order is; a sum of them need not be zero.
        call traced("double_pendulum", "rrwrwww", "sin(theta1 - theta2) theta2_dot^2 ~ 0;"// &
                    "small: m2 l2 theta1 theta1_ddot = 0; small: sin(theta1 - theta2) = 0;"// &
                    "small: 0 = theta1 theta2; small: theta1_dot^2 = 3; small: theta1_dot = 0;"// &
                    "small: theta1_dot^2 - g/l1 theta1^2 = 0")
    end subroutine negligible_terms
end module test_small_energies
