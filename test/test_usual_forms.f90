module test_usual_forms
    !! What students and answer keys write beside equations of motion: H and Hamilton's equations,
    !! U, p, v, T for a tension, rounded numbers, `~`, constants of the motion.
    use funit, only: TestMethod, TestSuite, assertEqual
    use lagrangia_errors, only: error_t
    use lagrangia_grading, only: grade_t
    use lagrangia_homework, only: homework_t, parse_homework
    use lagrangia_judgement, only: is_consequence, is_definition, is_right, is_unreadable, is_wrong
    use lagrangia_set_lines, only: grade_with_settings
    use lagrangia_system, only: system_t
    use tried_responses, only: graded
    implicit none (type, external)
    private
    public :: usual_forms_suite

    character, parameter :: line_feed = new_line("a")

contains

    function usual_forms_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("usual_forms")
        call suite%addTest(TestMethod("hamilton", hamilton))
        call suite%addTest(TestMethod("usual_names", usual_names))
        call suite%addTest(TestMethod("string_tensions", string_tensions))
        call suite%addTest(TestMethod("frequencies_by_name", frequencies_by_name))
        call suite%addTest(TestMethod("nearly_equal", nearly_equal))
        call suite%addTest(TestMethod("rounded_numbers", rounded_numbers))
        call suite%addTest(TestMethod("which_numbers_are_rounded", which_numbers_are_rounded))
        call suite%addTest(TestMethod("orders_of_powers", orders_of_powers))
        call suite%addTest(TestMethod("amplitudes_are_constants", amplitudes_are_constants))
        call suite%addTest(TestMethod("mistakes_before_a_setting", mistakes_before_a_setting))
        call suite%addTest(TestMethod("where_motions_begin", where_motions_begin))
        call suite%addTest(TestMethod("constants_of_the_motion", constants_of_the_motion))
        call suite%addTest(TestMethod("one_sign_of_a_root", one_sign_of_a_root))
        call suite%addTest(TestMethod("further_slips", further_slips))
        call suite%addTest(TestMethod("slopes_of_energies", slopes_of_energies))
        call suite%addTest(TestMethod("values_at_rest", values_at_rest))
        call suite%addTest(TestMethod("what_a_side_lacks", what_a_side_lacks))
    end function usual_forms_suite

    subroutine hamilton()
        call says("pendulum", "H = p_theta^2/(2 m l^2) - m g l cos(theta)", is_right, "")
        call says("pendulum", "H = p_theta^2/(2 m l^2) + m g l (1 - cos(theta))", is_right, &
                  "but for a constant")
        call says("pendulum", "H = p_theta^2/(2 m l) - m g l cos(theta)", is_wrong, &
                  "'l' must have the exponent 2 in 'p_theta^2/(2 m l)'")
        call says("pendulum", "H = p_theta theta_dot - L", is_right, "")
        call says("pendulum", "theta_dot = dH/dp_theta = p_theta/(m l^2)", is_right, &
                  "true of any motion")
        call says("pendulum", "p_dot = -dH/dtheta", is_right, "")
        call says("pendulum", "p_dot = m g l sin(theta)", is_wrong, &
                  "the sign of 'm g l sin(theta)'")
        call says("pendulum", "dH/dtheta = -m g l sin(theta)", is_wrong, &
                  "the sign of '-m g l sin(theta)'")
        call says("double_pendulum", "H = (m2 l2^2 p_1^2 + (m1 + m2) l1^2 p_2^2 - 2 m2 l1 l2 "// &
                  "p_1 p_2 cos(theta1 - theta2))/(2 m2 l1^2 l2^2 (m1 + m2 sin(theta1 - "// &
                  "theta2)^2)) - (m1 + m2) g l1 cos(theta1) - m2 g l2 cos(theta2)", is_right, "")
        call says("rotating_hoop", "H = T + V", is_wrong, &
                  "on the right is missing -m r^2 omega^2 sin(theta)^2")
        call says("cart_pendulum", "H = T + V", is_right, "")
        call says("cart_pendulum", "H = const", is_right, "")
    end subroutine hamilton

    subroutine usual_names()
        call says("pendulum", "U = -m g l cos(theta)", is_right, "")
        call says("pendulum", "U = m g l cos(theta)", is_wrong, "the sign of 'm g l cos(theta)'")
        call says("pendulum", "L = E_kin - E_pot", is_right, "")
        call says("pendulum", "p = m l^2 theta_dot", is_right, "as p_theta")
        call says("pendulum", "p = m l theta_dot", is_definition, &
                  "taken for a new name: not p_theta")
        call says("pendulum", "T = 1/2 m v^2", is_right, "")
        call says("pendulum", "v = l theta_dot", is_right, "as the speed of bob")
        call says("pendulum", "v = l^2 theta_dot", is_definition, &
                  "taken for a new name: not the speed of bob")
        call says("pendulum", "S = -m g cos(theta) - m l theta_dot^2", is_right, "as tension")
        call says("pendulum", "y = 3 - l cos(theta)", is_right, "as y_bob")
        call says("pendulum", "thetaddot = -g/l sin(theta)", is_right, "")
        call says("pendulum", "thetaddot = g/l sin(theta)", is_wrong, &
                  "the sign of 'g/l sin(theta)'")
        call says("cart_pendulum", "T = (m1 + m2)/2 xdot^2 + m2/2 (l^2 thetadot^2 + 2 l xdot "// &
                  "thetadot cos(theta))", is_right, "")
        call says("cart_pendulum", "T = (m1 + m2)/2 xdot^2 + m2/2 (l^2 thetadot^2 - 2 l xdot "// &
                  "thetadot cos(theta))", is_wrong, "the sign of '2 l x_dot theta_dot "// &
                  "cos(theta)' in "// &
                  "'m2/2 (l^2 theta_dot^2 - 2 l x_dot theta_dot cos(theta))'")
        call says("cart_pendulum", "(m1 + m2) xddot + m2 l theta_dotdot cos(theta) - m2 l "// &
                  "theta_dot^2 sin(theta) = 0", is_right, "")
        call says("pendulum", "Q_theta = -b theta_dot", is_right, "true of any motion")
        call says("pendulum", "Q_theta = b theta_dot", is_wrong, "the sign of 'b theta_dot'")
        call says("double_pendulum", "x_2 = l1 sin(theta1) + l2 sin(theta2)", is_right, "as x_bob2")
        call says("double_pendulum", "y1 = l1 cos(theta1)", is_right, "as y_bob1")
        call says("double_pendulum", "v2^2 = l1^2 theta1_dot^2 + l2^2 theta2_dot^2 + "// &
                  "2 l1 l2 theta1_dot theta2_dot cos(theta1 - theta2)", is_right, &
                  "as the speed of bob2")
        call says("double_pendulum", "v2^2 = l1^2 theta1_dot^2 + l2^2 theta2_dot^2", &
                  is_definition, "taken for a new name: not the speed of bob2")
        call says("double_pendulum", "T_1 = m1/2 l1^2 theta1_dot^2", is_right, &
                  "as the kinetic energy of bob1")
        call says("rotating_hoop", "V_eff = -m g r cos(theta) - m/2 r^2 omega^2 sin(theta)^2", &
                  is_right, "as - L at rest")
        call says("oscillator", "m a = -k x", is_right, "")
        call says("oscillator", "m a = k x", is_wrong, "the sign of 'k x'")
        call says("oscillator", "a = k/m"//line_feed//"x_ddot = -a x", is_right, "")
    end subroutine usual_names

    subroutine string_tensions()
        call says("atwood", "m1 g - T = m1 x_ddot", is_right, "")
        ! beside an energy T is one
        call says("atwood", "T + V = m1 (g - x_ddot) - (m1 - m2) g x", is_wrong, &
                  "two changes: 'T' does not belong there; 'm1 (g - x_ddot)' does not belong there")
        call says("atwood", "m1 g + T = m1 x_ddot", is_wrong, "the sign of 'tension1'")
        call says("atwood", "T = 2 m1 m2 g/(m1 + m2)", is_right, "")
        call says("atwood", "T = m1 m2 g/(m1 + m2)", is_wrong, &
                  "'m1 m2 g/(m1 + m2)' must be counted 2 times")
        call says("atwood", "S = 2 m1 m2 g/(m1 + m2)", is_right, "as tension1")
        call says("pendulum", "T = m g cos(theta) + m l theta_dot^2", is_right, "")
        call says("pendulum", "T = m g cos(theta) - m l theta_dot^2", is_wrong, &
                  "the sign of 'm l theta_dot^2'")
        call says("wedge", "N (M + m sin(alpha)^2) = M m g cos(alpha)"//line_feed// &
                  "N = M m g cos(alpha)/(M + m sin(alpha)^2)", is_right, "as normal_force")
    end subroutine string_tensions

    subroutine frequencies_by_name()
        !! A wrong omega_2 that abbreviates nothing is wrong.
        call says("double_pendulum", "omega_2^2 = (m1 + m2) g/(m1 l1)", is_wrong, &
                  "no small oscillation has this frequency; see 'lagrangia modes'")
        call says("double_pendulum", "omega_2^2 = g/l2"//line_feed//"l2 theta2_ddot + "// &
                  "l1 theta1_ddot cos(D) - l1 theta1_dot^2 sin(D) + l2 omega_2^2 sin(theta2) = 0", &
                  is_right, "")
        call says("pendulum", "omega0^2 = g/l", is_right, "")
        call says("pendulum", "omega_0 = sqrt(l/g)", is_wrong, "'l/g' must be 'g/l' in 'sqrt(l/g)'")
        call says("rotating_hoop", "omega_0^2 = g/r", is_definition, "")
        call says("pendulum", "theta_ddot = -omega_0^2 sin(theta)", is_right, "")
    end subroutine frequencies_by_name

    subroutine nearly_equal()
        call says("pendulum", "sin(theta) ~ theta", is_right, "")
        call says("pendulum", "sin(theta) ~ 2 theta", is_wrong, &
                  "'sin(theta)' must be counted 2 times")
        call says("pendulum", "theta_ddot = -g/l sin(theta) ~ -g/l theta", is_right, "")
        call says("pendulum", "V = -m g l cos(theta) ~= m g l theta^2/2 - m g l", is_right, "")
        call says("pendulum", "V ~ m g l theta^2", is_wrong, &
                  "'m g l theta^2' must be counted 1/2 times")
        call says("pendulum", "T ~ 2 pi sqrt(l/g)", is_right, "")
    end subroutine nearly_equal

    subroutine rounded_numbers()
        character(*), parameter :: given = "set: g = 9.81"//line_feed//"set: l = 1"//line_feed

        call says("pendulum", given//"omega = 3.13", is_right, "to the digits given")
        call says("pendulum", given//"omega = 3.14", is_wrong, "the left side is 3.132")
        call says("pendulum", given//"T = 2.006", is_right, "to the digits given")
        call says("pendulum", given//"T = 2.0", is_right, "to the digits given")
        call says("pendulum", given//"T = 2.1", is_wrong, "the left side is 2.006")
        call says("pendulum", given//"omega = 3", is_wrong, "the left side is 3.132")
        call says("pendulum", given//"theta_ddot = -9.810 sin(theta)", is_right, "")
        call says("pendulum", given//"theta_ddot = -9.80 sin(theta)", is_wrong, &
                  "no single change of a sign, letter, dot, factor, function, exponent or "// &
                  "term makes it right")
        call says("pendulum", "T = 0.51 m l^2 theta_dot^2", is_wrong, &
                  "no single change of a sign, letter, dot, factor, function, exponent or "// &
                  "term makes it right")
    end subroutine rounded_numbers

    subroutine which_numbers_are_rounded()
        !! omega is 31.0032 or 0.3132: a whole number is exact and one digit too few, and a number
        !! may be the first thing typed, or begin with its point. Half a unit of the last digit is
        !! allowed; 0.32 is off by 0.68.
        character(*), parameter :: given = "set: g = 961.2"//line_feed//"set: l = 1"//line_feed
        character(*), parameter :: small = "set: g = 0.0981"//line_feed//"set: l = 1"//line_feed

        call says("pendulum", given//"omega = 31", is_wrong, "the left side is 31.003")
        call says("pendulum", given//"omega = 31.0", is_right, "to the digits given")
        call says("pendulum", given//"31.00 = omega", is_right, "to the digits given")
        call says("pendulum", given//"omega = 31.1", is_wrong, "the left side is 31.0")
        call says("pendulum", given//"omega = 1.00*31.0", is_right, "to the digits given")
        call says("pendulum", given//"omega + 10.0*(1 - 1) = 31.02", is_wrong, &
                  "the left side is 31.0")
        call says("pendulum", small//"omega = .313", is_right, "to the digits given")
        call says("pendulum", small//"omega = 0.31", is_right, "to the digits given")
        call says("pendulum", small//"omega = 0.3", is_wrong, "the left side is 0.3132")
        call says("pendulum", small//"omega = 0.32", is_wrong, "the left side is 0.3132")
    end subroutine which_numbers_are_rounded

    subroutine orders_of_powers()
        !! An exponent 0 leaves a constant, one of a half halves the degree. What has a variable
        !! exponent, or a fraction's, is no polynomial, and right to first order.
        character(*), parameter :: third = "terms of order 3 are written, to which it does not "// &
            "hold; it does to first order"

        call says("pendulum", "sin(theta) ~ theta theta^0 - theta^3/6", is_right, "")
        call says("pendulum", "sin(theta) ~ theta theta^0 - theta^3/3", is_wrong, third)
        call says("pendulum", "sin(theta) ~ theta - (theta^6)^0.5/3", is_wrong, third)
        call says("pendulum", "sin(theta) ~ theta - (theta^2)^1.5/3", is_wrong, third)
        call says("pendulum", "l^2 sin(theta) ~ l^2 theta - l^2 theta^3/3", is_wrong, third)
        call says("pendulum", "sin(theta) ~ theta - 2^theta theta^3/3", is_right, "")
        call says("pendulum", "sin(theta) ~ theta - theta^3 (1 + theta^2)^(1/2)/3", is_right, "")
    end subroutine orders_of_powers

    subroutine amplitudes_are_constants()
        !! What stands beside them may be a parameter; nothing that moves, nor the time.
        character(*), parameter :: moving(6) = [character(11) :: "t", "theta1", "theta2", &
            "theta1_dot", "theta1_ddot", "theta2_ddot"]
        character(:), allocatable :: said
        integer :: i, verdict

        do i = 1, size(moving)
            call graded("double_pendulum", "A_1 "//trim(moving(i))//" = A_2", verdict, said)
            call assertEqual(is_unreadable, verdict, trim(moving(i))//": "//said)
            call assertEqual(1, index(said, "column 1: unknown name 'A_1'"), said)
        end do
        call says("double_pendulum", "A_1 m1 = A_2", is_wrong, "in no normal mode")
        call says("double_pendulum", "set: m1 = 1"//line_feed//"set: m2 = 1"//line_feed// &
                  "set: l1 = 1"//line_feed//"set: l2 = 1"//line_feed//"A_1 m1 sqrt(2) = A_2 l1", &
                  is_right, "of a normal mode")
    end subroutine amplitudes_are_constants

    subroutine mistakes_before_a_setting()
        !! They are mistakes behind it, too, and excuse what follows from them.
        type(homework_t) :: homework
        type(grade_t) :: result
        type(error_t), allocatable :: error
        class(system_t), allocatable :: system

        call parse_homework("system: pendulum"//line_feed//"T = m l^2 theta_dot^2"//line_feed// &
                            "set: g = 9.81"//line_feed// &
                            "L = m l^2 theta_dot^2 + m g l cos(theta)", "sheet", homework, error)
        call grade_with_settings(homework, system, result, error)
        call assertEqual(is_wrong, result%of(1)%verdict, "a mistake")
        call assertEqual(is_consequence, result%of(2)%verdict, "what follows")
        call assertEqual("from line 2, which is wrong", result%of(2)%remark)
    end subroutine mistakes_before_a_setting

    subroutine where_motions_begin()
        !! A constant is the coordinate at the start, on either side of the sign. A place that a
        !! motion does not begin at is wrong, but where a place was stated before.
        character(*), parameter :: small = "small: theta = A cos(omega t)"//line_feed
        character(*), parameter :: moves = "x = 2 cos(omega t)"//line_feed
        character(*), parameter :: elsewhere = "the motion that a line writes out begins elsewhere"

        call says("pendulum", small//"A = theta(0)", is_right, "")
        call says("pendulum", small//"theta(0) = A", is_right, "")
        call says("pendulum", small//"2 A = theta(0)", is_wrong, elsewhere)
        call says("pendulum", "theta_0 = theta(0)", is_definition, &
                  "an initial condition, of one motion of many")
        call says("oscillator", "x_dot(0) = 0"//line_feed//moves//"x(0) = 0.1", is_wrong, elsewhere)
        call says("oscillator", "x(0) = 2"//line_feed//moves//"x_dot(0) = 0.1", is_wrong, elsewhere)
        call says("oscillator", "x(0) = 2"//line_feed//moves//"x(0) = 0.1", is_definition, &
                  "an initial condition, of one motion of many")
    end subroutine where_motions_begin

    subroutine constants_of_the_motion()
        call says("pendulum", "theta_dot^2/2 - g/l cos(theta) = C", is_right, "")
        call says("pendulum", "theta_dot^2/2 = g/l cos(theta) + const", is_right, "")
        call says("pendulum", "theta_dot^2/2 = -g/l cos(theta) + const", is_wrong, &
                  "the sign of '-g/l (-sin(theta) theta_dot)'")
        call says("pendulum", "Q_theta = -b theta_dot"//line_feed//"E = const", is_wrong, &
                  "its rate is -b theta_dot^2: the force beside L, Q_theta, does work")
        call says("driven_pendulum", "E = const", is_wrong, "it changes: L contains t")
        call says("pendulum", "p_theta = const", is_wrong, &
                  "its rate is m l^2 theta_ddot: dL/dtheta is not 0")
    end subroutine constants_of_the_motion

    subroutine one_sign_of_a_root()
        call says("pendulum", "theta_dot = sqrt(2/(m l^2) (E + m g l cos(theta)))", is_right, &
                  "where the sign of the root is that of the other side")
        call says("pendulum", "theta_dot = sqrt(2/(m l^2) (E - m g l cos(theta)))", is_wrong, &
                  "no single change of a sign, letter, dot, factor, function, exponent or "// &
                  "term makes it right")
    end subroutine one_sign_of_a_root

    subroutine further_slips()
        call says("double_pendulum", "V = -(m1 + m2) g l1 cos(theta1) - m2 g l2 cos(theta1 + "// &
                  "theta2)", is_wrong, &
                  "'theta1 + theta2' must be 'theta2' in 'cos(theta1 + theta2)'")
        call says("double_pendulum", "l2 theta2_ddot + l1 theta1_ddot cos(theta1 + theta2) - "// &
                  "l1 theta1_dot^2 sin(theta1 + theta2) + g sin(theta2) = 0", is_wrong, &
                  "'theta1 + theta2' must be 'theta1 - theta2' in all places")
        call says("pendulum", "V = -2 m g l^2 cos(theta)", is_wrong, &
                  "'2 m g l^2 cos(theta)' must be divided by 2 'l'")
        call says("pendulum", "p_theta = 2 m l^2 g theta_dot", is_wrong, &
                  "'2 m l^2 g theta_dot' must be divided by 2 'g'")
        call says("pendulum", "p_theta = m l^2 g theta_dot", is_wrong, &
                  "'m l^2 g theta_dot' has the factor 'g' too many")
        call says("pendulum", "T = 2 pi l/g", is_wrong, "a square root is missing behind '2 pi'")
        call says("rotating_hoop", "Omega = sqrt(g/r)", is_wrong, &
                  "squared: on the right is missing -omega^2")
        call says("cart_pendulum", "T = m1/2 x_dot^2 + m2/2 l^2 theta_dot^2", is_wrong, &
                  "on the right is missing m2/2 x_dot^2 + m2 l x_dot theta_dot cos(theta)")
        call says("cart_pendulum", "T = 1", is_wrong, &
                  "no single change of a sign, letter, dot, factor, function, exponent or "// &
                  "term makes it right")
        call says("rotating_wire", "E = m/2 (r_dot^2 - r^2)", is_wrong, &
                  "'r^2' lacks the factor 'omega^2' in 'm/2 (r_dot^2 - r^2)'")
        call says("driven_pendulum", "E = m/2 (l^2 theta_dot^2 - y_p_dot^2) + (y_p - "// &
                  "l cos(theta))", is_wrong, "'y_p - l cos(theta)' lacks the factor 'm g'")
        call says("wedge", "T = M/2 q2_dot^2 + m/2 q1_dot^2", is_wrong, &
                  "on the right is missing m q1_dot q2_dot cos(alpha) + m/2 q2_dot^2")
    end subroutine further_slips

    subroutine slopes_of_energies()
        !! E in q and its velocity, also where it is not T + V. What is written out on the left is
        !! not to be mended.
        call says("pendulum", "dE/dtheta = m g l sin(theta)", is_right, "")
        call says("pendulum", "dE/dtheta_dot = m l^2 theta_dot", is_right, "")
        call says("pendulum", "dE/dtheta_dot = p_theta", is_right, "")
        call says("pendulum", "dE/dtheta = -m g l sin(theta)", is_wrong, &
                  "the sign of '-m g l sin(theta)'")
        call says("rotating_hoop", "dE/dtheta = m g r sin(theta) - "// &
                  "m r^2 omega^2 sin(theta) cos(theta)", is_right, "")
        call says("double_pendulum", "dE/dtheta1_dot = p_theta1", is_right, "")
        call says("cart_pendulum", "dE/dtheta = m2 g l sin(theta) - "// &
                  "m2 l x_dot theta_dot sin(theta)", is_right, "")
        call says("pendulum", "V'(theta) = m g l cos(theta)", is_wrong, &
                  "'cos(theta)' must be 'sin(theta)' in 'm g l cos(theta)'")
        call says("pendulum", "d^2T/dtheta_dot^2 = m l^3", is_wrong, &
                  "the exponent of 'l^3' must be 2 in 'm l^3'")
        call says("oscillator", "Q_x = -3*b x_dot", is_wrong, &
                  "'3 b x_dot' must be counted 1/3 times")
    end subroutine slopes_of_energies

    subroutine values_at_rest()
        !! What begins at rest at an equilibrium stays there: T is no period, L a number. A rate of
        !! a momentum that is 0 on any motion is not three times itself.
        character(*), parameter :: hangs = "theta(0) = 0"//line_feed//"theta_dot(0) = 0"// &
                                           line_feed
        character(*), parameter :: stands = "x_dot(0) = 0"//line_feed
        character(*), parameter :: free = "set: magnetic = 0, 0, 0"//line_feed// &
            "set: electric = 0, 0, 0"//line_feed//"set: trap = 0"//line_feed

        call says("pendulum", hangs//"L = m g l", is_right, "of the motion that begins so")
        call says("pendulum", hangs//"T = 0", is_right, "of the motion that begins so")
        call says("cart_pendulum", stands//hangs//"dL/dx_dot = 0", is_right, &
                  "of the motion that begins so")
        call says("pendulum", "theta(0) = 0.1"//line_feed//"theta_dot(0) = 0"//line_feed// &
                  "T = 0", is_wrong, "on the right is missing m/2 l^2 theta_dot^2")
        call says("charged_particle", free//"d/dt dL/dx_dot = m x_ddot", is_right, "")
        call says("charged_particle", free//"d/dt dL/dx_dot = 3 m x_ddot", is_wrong, &
                  "'3 m x_ddot' must be counted 1/3 times")
        call says("charged_particle", free//"3 m x_ddot = 0", is_right, "")
    end subroutine values_at_rest

    subroutine what_a_side_lacks()
        !! Of a name alone the other side lacks it; a letter that a term has not is not too many.
        call says("pendulum", "tension = m l theta_dot^2", is_wrong, &
                  "on the right is missing m g cos(theta)")
        call says("cart_pendulum", "(m1 + m2) x_ddot + m2 l theta_ddot cos(theta) = 0", is_wrong, &
                  "on the left is missing -m2 l theta_dot^2 sin(theta)")
        call says("pendulum", "small: theta_ddot = -g/l", is_wrong, &
                  "'g/l' lacks the factor 'theta'")
        call says("pendulum", "g = 4 pi^2 l*T^2", is_wrong, "'4 pi^2/omega^2' must be "// &
                  "'omega^2/(4 pi^2)' in '4 pi^2 l (4 pi^2/omega^2)'")
        call says("pendulum", "g = 4 pi l/T^2", is_wrong, &
                  "'4 pi l/(4 pi^2/omega^2)' must be counted pi times")
        call says("pendulum", "omega T = pi", is_wrong, "the left side is 2 pi")
        call says("pendulum", "omega = 2 pi T", is_wrong, &
                  "'2 pi/omega' must be 'omega/(2 pi)' in '2 pi (2 pi/omega)'")
        call says("pendulum", "omega = 0", is_wrong, "no single change of a sign, letter, dot, "// &
                  "factor, function, exponent or term makes it right")
    end subroutine what_a_side_lacks

    subroutine says(system, statement, verdict, remark)
        !! Of the last line of several.
        character(*), intent(in) :: system, statement
        integer, intent(in) :: verdict
        character(*), intent(in) :: remark
        character(:), allocatable :: said
        integer :: given

        call graded(system, statement, given, said)
        call assertEqual(verdict, given, system//": "//statement//": "//said)
        call assertEqual(remark, said, system//": "//statement)
    end subroutine says
end module test_usual_forms
