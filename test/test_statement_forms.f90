module test_statement_forms
    !! What students write that is no plain equality of letters: derivatives by the time in every
    !! form, constants of the motion, periods, dots and roots as signs; and several letters missing.
    use funit, only: TestMethod, TestSuite, assertEqual, assertTrue
    use lagrangia_judgement, only: is_right, is_unreadable, is_wrong
    use lagrangia_kinds, only: dp
    use lagrangia_random_draws, only: random_t
    use lagrangia_text, only: to_text
    use test_consequences, only: consequences_suite
    use traced_sheets, only: traced
    use traced_sheets, only: traced
    use tried_responses, only: graded
    implicit none (type, external)
    private
    public :: statement_forms_suite

contains

    function statement_forms_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("statement_forms")
        call suite%addTest(TestMethod("derivatives_by_the_time", derivatives_by_the_time))
        call suite%addTest(TestMethod("derivatives_of_energies", derivatives_of_energies))
        call suite%addTest(TestMethod("constants_of_the_motion", constants_of_the_motion))
        call suite%addTest(TestMethod("periods_and_motions", periods_and_motions))
        call suite%addTest(TestMethod("periods_anywhere", periods_anywhere))
        call suite%addTest(TestMethod("names_of_frequencies", names_of_frequencies))
        call suite%addTest(TestMethod("names_by_their_square", names_by_their_square))
        call suite%addTest(TestMethod("true_of_small_motions", true_of_small_motions))
        call suite%addTest(TestMethod("signs_of_word_processors", signs_of_word_processors))
        call suite%addTest(TestMethod("several_letters_are_missing", several_letters_are_missing))
        call suite%addTest(TestMethod("the_same_slip_in_several_places", &
                                      the_same_slip_in_several_places))
        call suite%addTest(TestMethod("about_another_equilibrium", about_another_equilibrium))
        call suite%addTest(TestMethod("remedies", remedies))
        call suite%addTest(TestMethod("typos_have_a_place", typos_have_a_place))
        call suite%addTest(consequences_suite())
    end function statement_forms_suite

    subroutine derivatives_by_the_time()
        !! Of what is in brackets, of a name, the second one.
        call right("pendulum", "d/dt(m l^2 theta_dot) = -m g l sin(theta)")
        call right("pendulum", "d/dt (dL/dtheta_dot) - dL/dtheta = 0")
        call right("pendulum", "d(l theta_dot)/dt = -g sin(theta)")
        call right("pendulum", "d^2 theta/dt^2 = -g/l sin(theta)")
        call right("pendulum", "p_theta_dot = dL/dtheta = dp_theta/dt")
        call right("double_pendulum", "d/dt(sin(theta1)) = cos(theta1) dtheta1/dt")
        call right("cart_pendulum", "d/dt((m1 + m2) x_dot + m2 l theta_dot cos(theta)) = 0")
        call wrong("cart_pendulum", "d/dt((m1 + m2) x_dot + m2 l theta_dot sin(theta)) = 0", "")
        call wrong("pendulum", "d^2 theta/dt^2 = g/l sin(theta)", "the sign of")
        call unreadable("pendulum", "d/dt m l^2 theta_dot = -m g l sin(theta)", "column 1: of what")
        call unreadable("pendulum", "d/dt theta^2 = 0", "column 1: of what is it the derivative?")
        call right("pendulum", "d^2/dt^2 theta = -g/l sin(theta)")
        call unreadable("pendulum", "d(theta) = 0", "column 9: behind d(...) stands '/dt'")
        call wrong("pendulum", "0 = d/dt(tension)", "")
    end subroutine derivatives_by_the_time

    subroutine derivatives_of_energies()
        !! The power of the drag; partial derivatives of T and V.
        call right("oscillator", "dE/dt = -b x_dot^2")
        call wrong("oscillator", "dE/dt = -b x_dot", "'x_dot' must have the exponent 2")
        call wrong("oscillator", "dE/dt = 0 b", "")
        call right("spring_pendulum", "dV/dr = k (r - l0) - m g cos(theta)")
        call right("spring_pendulum", "dT/dtheta_dot = m r^2 theta_dot")
        call wrong("spring_pendulum", "dV/dtheta = m g r cos(theta)", "'cos(theta)' must be")
        call right("pendulum", "dT/dt + dV/dt = 0")
        ! of the double pendulum T has the letter D, which moves
        call right("double_pendulum", "dT/dtheta1 = -m2 l1 l2 theta1_dot theta2_dot sin(D)")
        call wrong("double_pendulum", "dT/dtheta2 = -m2 l1 l2 theta1_dot theta2_dot sin(D)", &
                   "the sign of ")
    end subroutine derivatives_of_energies

    subroutine constants_of_the_motion()
        !! `const`, in two languages, with a point or without.
        call right("cart_pendulum", "p_x = const.")
        call right("cart_pendulum", "E = T + V = konst")
        call right("cart_pendulum", "(m1 + m2) x_dot + m2 l theta_dot cos(theta) = constant")
        call wrong("cart_pendulum", "p_theta = const", "")
        call wrong("oscillator", "E + 0 b = const", "")
        call wrong("pendulum", "tension = const", "")
        call wrong("pendulum", "L_z = const", "")
        call right("pendulum", "dtension/dt = -3 m g sin(theta) theta_dot")
        call right("pendulum", "dL_z/dt = -m g l sin(theta)")
        call right("pendulum", "L_z_dot = -m g l sin(theta)")
        call unreadable("double_pendulum", "tension1 = const", "column 1: d/dt of 'tension1' "// &
                        "is not known")
        ! what is conserved has the rate 0, not a rounding error
        call traced("kepler", "rrwru0", "L_z = const; A_x = const; p_x = const; d/dt(p_x) = "// &
            "-k cos(phi)/r^2; L_z = 3; A_y = const + 0")
        call right("rolling_disk", "dT/dt = m g x_dot sin(incline)")
    end subroutine constants_of_the_motion

    subroutine periods_and_motions()
        !! T as a period, which is no kinetic energy; a motion has no verdict.
        call right("pendulum", "T = 2 pi sqrt(l/g)")
        call right("pendulum", "T = 2 pi/omega")
        call right("pendulum", "T = m/2 l^2 theta_dot^2")
        call wrong("pendulum", "T = 2 pi sqrt(g/l)", "'g/l' must be 'l/g'")
        call right("oscillator", "x = cos(omega t)")
        call wrong("oscillator", "x = x_dot t", "")
        call wrong("pendulum", "theta_ddot = -1.618034 g/l sin(theta)", "must be 1")
    end subroutine periods_and_motions

    subroutine periods_anywhere()
        !! T as a period on either side and in a definition; squares where most equilibria are
        !! unstable, and whose signs tell nothing.
        call right("pendulum", "T^2 = 4 pi^2 l/g")
        call right("pendulum", "g = 4 pi^2 l/T^2")
        call right("pendulum", "T sqrt(g/l) = 2 pi")
        call right("pendulum", "1/T = sqrt(g/l)/(2 pi)")
        call right("pendulum", "omega = 2 pi/T")
        call wrong("pendulum", "T^2 = 4 pi l/g", "'4 pi l/g' must")
        call wrong("pendulum", "T = -2 pi sqrt(l/g)", "the sign")
        call wrong("pendulum", "g = 2 pi^2 l/T^2", "")
        call traced("rotating_hoop", "rrrrrrwwww0rr0r", "T = 2 pi/sqrt(g/r - omega^2)"// &
            "; T = 2 pi sqrt(1/(g/r - omega^2)); T^2 = 4 pi^2/(g/r - omega^2)"// &
            "; (2 pi/T)^2 = g/r - omega^2; T sqrt(g/r - omega^2) = 2 pi"// &
            "; T^2 (g/r - omega^2) = 4 pi^2; T = 2 pi/sqrt(g/r + omega^2)"// &
            "; T = 4 pi/sqrt(g/r - omega^2); T = -2 pi/sqrt(g/r - omega^2)"// &
            "; Omega = -sqrt(g/r - omega^2); f = 1/T; 4 pi^2 f^2 = g/r - omega^2"// &
            "; f = sqrt(g/r - omega^2)/(2 pi); K = T"// &
            "; K = m r^2/2 (theta_dot^2 + omega^2 sin(theta)^2)")
    end subroutine periods_anywhere

    subroutine names_of_frequencies()
        !! `omega_1`, `T_1`, `f` are judged where they are what they are called, and else new names.
        character(*), parameter :: new = " taken for a new name: no small oscillation has this "

        call traced("double_pendulum", "00rrr00w", "omega_3^2 = g/l1; omega_1 = theta1_dot"// &
            "; omega_3^2 = g/l1; omega_1 = theta1_dot; omega_3 = sqrt(g/l1)"// &
            "; T_4 = 2 pi sqrt(2 l1/g); f = sqrt(g/l1); omega_3^2 = 2 g/l1", &
            remarks="1"//new//"frequency; 6"//new//"period; 7"//new//"frequency")
        call traced("coupled_oscillators", "rrrrrwr", "omega_1^2 = k/m"// &
            "; omega_2^2 = (k + 2 k_c)/m; omega_2^2 - omega_1^2 = 2 k_c/m; T_1 = 2 pi sqrt(m/k)"// &
            "; T_2 = 2 pi/sqrt(k/m + 2 k_c/m); omega_1^2 omega_2^2 = k^2/m^2"// &
            "; f_2 = sqrt((k + 2 k_c)/m)/(2 pi)")
        call right("pendulum", "omega_0 = sqrt(g/l)")
        call right("pendulum", "nu = 1/(2 pi) sqrt(g/l)")
        ! which is no square of omega
        call unreadable("pendulum", "omega_2 + 0 = g/l", "column 1: unknown name 'omega_2'")
    end subroutine names_of_frequencies

    subroutine names_by_their_square()
        !! `v^2 = ...` leaves the sign of v open.
        call traced("double_pendulum", "0r0rw", "v_1^2 = l1^2 theta1_dot^2; v_1 = l1 theta1_dot"// &
            "; v_2^2 = x_bob2_dot^2 + y_bob2_dot^2; T = m1/2 v_1^2 + m2/2 v_2^2"// &
            "; T = m1/2 v_1^2 + m2/2 v_1^2")
        call traced("pendulum", "0rrww", "v^2 = l^2 theta_dot^2; v = l theta_dot"// &
            "; v = -l theta_dot; v = 2 l theta_dot; T = m v^2")
        call traced("pendulum", "0w", "a^2 = g/l; a = -sqrt(g/l)")
    end subroutine names_by_their_square

    subroutine true_of_small_motions()
        !! A linear equation without `small:` is wrong, and says why; 0 = 0 is no reason.
        character(*), parameter :: small = "; true of small motions: write 'small:' in front"
        character(:), allocatable :: said
        integer :: verdict

        call wrong("pendulum", "theta_ddot = -omega^2 theta", "in 'omega^2 theta'"//small)
        call wrong("pendulum", "theta_ddot = -g/l theta", small)
        call graded("pendulum", "theta_ddot theta_dot^2 = theta^3", verdict, said)
        call assertEqual(0, index(said, small), said)
        call graded("pendulum", "theta_ddot = -2 g/l theta", verdict, said)
        call assertEqual(0, index(said, small), said)
        call graded("rotating_hoop", "theta_ddot = omega^2 sin(theta) - g/r sin(theta)", verdict, &
                    said)
        call assertEqual(0, index(said, small), said)
    end subroutine true_of_small_motions

    subroutine signs_of_word_processors()
        !! Dots over letters, before and behind their indices, roots, partial derivatives, squares.
        character(*), parameter :: theta = char(206)//char(184), dot = char(204)//char(135)
        character(*), parameter :: two_dots = char(204)//char(136), square = char(194)//char(178)
        character(*), parameter :: partial = char(226)//char(136)//char(130)
        character(*), parameter :: root = char(226)//char(136)//char(154)
        character(*), parameter :: one = char(226)//char(130)//char(129), pi = char(207)//char(128)

        call right("pendulum", theta//two_dots//" = -g/l sin("//theta//")")
        call wrong("pendulum", theta//dot//" = -g/l sin("//theta//")", "")
        call right("pendulum", partial//"L/"//partial//theta//dot//" = m l"//square//theta//dot)
        call right("pendulum", "omega = "//root//"(g/l)")
        call right("pendulum", "T = 2"//pi//root//"(l/g)")
        call right("pendulum", "d"//square//theta//"/dt"//square//" = -g/l sin("//theta//")")
        call right("double_pendulum", "p_theta1 + p_theta2 = dL/d"//theta//dot//one// &
                   " + dL/d"//theta//dot//"2")
        call right("cart_pendulum", "x"//two_dots//" = "//char(225)//char(186)//char(141))
    end subroutine signs_of_word_processors

    subroutine several_letters_are_missing()
        !! A term or a factor with several letters, named with all of them.
        call wrong("rotating_hoop", "theta_ddot = -g/r sin(theta)", &
                   "on the right is missing omega^2 sin(theta) cos(theta)")
        call wrong("double_pendulum", "p_theta1 = (m1 + m2) l1^2 theta1_dot", &
                   "on the right is missing m2 l1 l2 theta2_dot cos(D)")
        call wrong("cart_pendulum", "omega^2 = g/l", "'g/l' lacks the factor '(m1 + m2)/m1'")
        call wrong("cart_pendulum", "omega^2 = g/l m2/(m1 + m2)", &
                   "'g/l m2/(m1 + m2)' lacks the factor '(m1 + m2)^2/(m1 m2)'")
        call wrong("cart_pendulum", "m2 l theta_ddot + m2 l x_ddot cos(theta) - m2 g l "// &
                   "sin(theta) = 0", "two changes: 'm2 l theta_ddot' lacks the factor 'l'; "// &
                   "the sign of 'm2 g l sin(theta)'")
        call wrong("cart_pendulum", "(m1 + m2) x_ddot + m2 theta_ddot cos(theta) = "// &
                   "-m2 l theta_dot^2 sin(theta)", "two changes: ")
        call wrong("cart_pendulum", "T = (m1 + m2) x_dot^2 + m2/2 l^2 theta_dot^2 + m2/2 l "// &
                   "x_dot theta_dot cos(theta)", "two changes: '(m1 + m2) x_dot^2' lacks the "// &
                   "factor '1/2'; 'm2/2 l x_dot theta_dot cos(theta)' lacks the factor '2'")
        call wrong("cart_pendulum", "l theta_ddot cos(theta)^2 + 2 l theta_ddot sin(theta)^2 = "// &
                   "3 l theta_ddot", "no single change")
        call wrong("pendulum", "p_theta = 3 theta_dot", "'3 theta_dot' lacks the factor "// &
                   "'1/3 m l^2'")
    end subroutine several_letters_are_missing

    subroutine the_same_slip_in_several_places()
        !! Letters exchanged throughout, places counted from the wrong point, a dot for a square.
        call wrong("double_pendulum", "x_bob2^2 + y_bob2^2 = l2^2", &
                   "the place of bob2 must be counted from bob1, 'x_bob2 - x_bob1'")
        call wrong("double_pendulum", "V = -(m2 + m1) g l2 cos(theta1) - m2 g l1 cos(theta2)", &
                   "'l1' and 'l2' must be exchanged in all places")
        call wrong("cart_pendulum", "(m1 + m2) x_ddot + m2 l theta_ddot cos(theta) = "// &
                   "m2 l theta_ddot sin(theta)", "'theta_ddot' must be 'theta_dot^2' in 'm2 l ")
        call wrong("pendulum", "l theta_dot^2 + g sin(theta) = 0", &
                   "'theta_dot^2' must be 'theta_ddot' in 'l theta_dot^2'")
    end subroutine the_same_slip_in_several_places

    subroutine about_another_equilibrium()
        !! Where it is, and small oscillations about it; coordinates counted from it, or not; the
        !! rates of a definition.
        character, parameter :: line_feed = new_line("a")

        call right("rotating_hoop", "cos(theta_eq) = g/(omega^2 r)")
        call right("rotating_hoop", "theta_eq = 0")
        call wrong("rotating_hoop", "cos(theta_eq) = g/(omega r)", "'omega' must have the exponent")
        call right("rotating_hoop", "small: theta_ddot + omega^2 sin(theta_eq)^2 (theta - "// &
                   "theta_eq) = 0")
        call wrong("rotating_hoop", "small: theta_ddot + omega^2 cos(theta_eq)^2 (theta - "// &
                   "theta_eq) = 0", "'cos(theta_eq)' must be 'sin(theta_eq)'")
        call right("rotating_hoop", "small: theta_ddot = -Omega^2 (theta - theta_eq)")
        call wrong("rotating_hoop", "small: theta_ddot = -Omega^2 (theta + theta_eq)", &
                   "the sign of 'theta_eq'")
        call wrong("rotating_hoop", "theta_ddot + theta_eq = omega^2 sin(theta) cos(theta) "// &
                   "- g/r sin(theta)", "")
        call wrong("rotating_hoop", "small: V = m g r (1 - cos(theta + 3 theta_eq))", "")
        call right("rotating_hoop", "small: theta_ddot = (omega^2 - g/r) theta")
        call wrong("rotating_hoop", "small: theta_ddot = (omega^2 + g/r) theta", "")
        call right("rotating_hoop", "D = theta - theta_eq"//line_feed// &
                   "small: D_ddot + (omega^2 - g^2/(omega^2 r^2)) D = 0")
        call right("spring_pendulum", "r_eq = l0 + m g/k")
        call right("spring_pendulum", "small: r_eq theta_ddot + g theta = 0")
        call wrong("spring_pendulum", "small: l0 theta_ddot + g theta = 0", "")
        call judged("spring_pendulum", "small: m r_ddot + k r = 0", is_right, &
                    "if the coordinates are counted from the equilibrium")
        call wrong("spring_pendulum", "small: m r_ddot + 2 k r = 0", "")
        call judged("pendulum", "theta_eq = pi"//line_feed//"small: theta_ddot = g/l theta", &
                    is_right, "if the coordinates are counted from the equilibrium")
        call judged("pendulum", "theta_ddot ~ g/l (theta - pi)", is_right, &
                    "another equilibrium than that at or near zero")
        call wrong("pendulum", "theta_ddot ~ -g/l (theta - pi)", "")
        ! a third one, and the second one still
        call traced("rotating_hoop", "rrrrwrr", "theta_eq = pi"// &
            "; small: theta_ddot = (g/r + omega^2) theta; theta_ddot ~ (g/r + omega^2) theta"// &
            "; small: theta_ddot = (g/r + omega^2) (theta - pi)"// &
            "; small: theta_ddot = -(g/r + omega^2) theta"// &
            "; small: theta_ddot = -(omega^2 - g^2/(omega r)^2) theta"// &
            "; small: theta_ddot = (omega^2 - g/r) theta")
        call right("pendulum", "small: theta_ddot = -omega omega theta")
        call right("pendulum", "small: l theta_ddot + g theta + theta_dot^2 = 0")
        call right("double_pendulum", "small: sin(D) = D")
        call wrong("double_pendulum", "small: cos(D) = D", "")
        call unreadable("pendulum_in_x_and_y", "small: x_ddot = -g/l x", "the linearised "// &
                        "motion is not known")
    end subroutine about_another_equilibrium

    subroutine remedies()
        !! What to write instead.
        call unreadable("pendulum", "l theta_ddot = 5 cm", "column 18: 'cm' is a unit")
        call unreadable("pendulum", "phi_ddot = 0", "column 1: unknown name 'phi_ddot'; there "// &
                        "are t, theta, m, l, g, b, L_z, tension, x_bob, y_bob, z_bob, L, E, "// &
                        "p_theta, T, V, omega, theta_eq, pi")
    end subroutine remedies

    subroutine typos_have_a_place()
        !! A character too many, too few or another one, at random: a verdict, or one line that says
        !! where and what to do.
        character(*), parameter :: statement = "m2 l theta_ddot + m2 x_ddot cos(theta) = "// &
            "-m2 g sin(theta)"
        character(*), parameter :: typed = "adelmtx_1290^*/+-()|=.,;'{\&# "//achar(9)
        character(:), allocatable :: remark, text
        type(random_t) :: random
        real(dp) :: x(3)
        integer :: at, i, k, verdict

        do i = 1, 400
            do k = 1, 3
                call random%uniform(0.0_dp, 1.0_dp, x(k))
            end do
            at = 1 + int(x(1)*len(statement))
            k = 1 + int(x(2)*len(typed))
            text = statement(:at - merge(1, 0, x(3) < 0.6_dp))
            if (x(3) > 0.3_dp) text = text//typed(k:k)
            text = text//statement(at + 1:)
            call graded("cart_pendulum", text, verdict, remark)
            call assertTrue(scan(remark, new_line("a")) == 0, text//": "//remark)
            if (verdict == is_right .or. verdict == is_wrong) cycle
            call assertTrue(index(remark, "column ") > 0 .or. index(remark, "sheet:2: ") > 0, &
                            text//": "//remark)
            call assertTrue(index(remark, "; ") + index(remark, "? ") + index(remark, ": ") > 0, &
                            text//": "//remark)
        end do
    end subroutine typos_have_a_place

    subroutine right(system, statement)
        character(*), intent(in) :: system, statement

        call judged(system, statement, is_right, "")
    end subroutine right

    subroutine wrong(system, statement, remark)
        !! And its remark begins so.
        character(*), intent(in) :: system, statement, remark

        call judged(system, statement, is_wrong, remark)
    end subroutine wrong

    subroutine unreadable(system, statement, remark)
        character(*), intent(in) :: system, statement, remark

        call judged(system, statement, is_unreadable, remark)
    end subroutine unreadable

    subroutine judged(system, statement, expected, remark)
        character(*), intent(in) :: system, statement, remark
        integer, intent(in) :: expected
        character(:), allocatable :: said
        integer :: verdict

        call graded(system, statement, verdict, said)
        call assertEqual(expected, verdict, statement//": verdict "//to_text(verdict)//", "//said)
        if (remark /= "") call assertTrue(index(said, remark) > 0, statement//": "//said)
    end subroutine judged
end module test_statement_forms
