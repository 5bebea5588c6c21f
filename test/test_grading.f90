module test_grading
    !! Homework: right in any words, wrong with the term that is.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: built_in, new_system, nth_system
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_grading, only: grade, grade_t
    use lagrangia_homework, only: homework_t, parse_homework, read_homework
    use lagrangia_judgement, only: is_right, is_unreadable, is_wrong
    use lagrangia_scene_reader, only: read_named_system
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    use stated_text, only: is_said
    use traced_sheets, only: traced
    use tried_responses, only: graded, printed_statements
    implicit none (type, external)
    private
    public :: grading_suite

    character, parameter :: line_feed = new_line("a")

contains

    function grading_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("grading")
        call suite%addTest(TestMethod("slips_are_named", slips_are_named))
        call suite%addTest(TestMethod("every_printed_statement_is_right", &
                                      every_printed_statement_is_right))
        call suite%addTest(TestMethod("statements_about_scenes", statements_about_scenes))
        call suite%addTest(TestMethod("which_accelerations_follow", which_accelerations_follow))
        call suite%addTest(TestMethod("examples_have_four_digits", examples_have_four_digits))
        call suite%addTest(TestMethod("lines_that_follow", lines_that_follow))
        call suite%addTest(TestMethod("a_second_slip_does_not_follow", &
                                      a_second_slip_does_not_follow))
        call suite%addTest(TestMethod("drag_has_a_decay_rate", drag_has_a_decay_rate))
        call suite%addTest(TestMethod("small_oscillations", small_oscillations))
        call suite%addTest(TestMethod("the_lines_of_the_notes", the_lines_of_the_notes))
        call suite%addTest(TestMethod("sheets_that_cannot_be_read", sheets_that_cannot_be_read))
    end function grading_suite

    subroutine slips_are_named()
        call named("cart_pendulum", "l theta_ddot + x_ddot cos(theta) - g sin(theta) = 0", &
                   "the sign of 'g sin(theta)'")
        call named("cart_pendulum", "l theta_ddot + x_ddot sin(theta) + g sin(theta) = 0", &
                   "'sin(theta)' must be 'cos(theta)' in 'x_ddot sin(theta)'")
        call named("cart_pendulum", "l^2 theta_ddot + x_ddot cos(theta) + g sin(theta) = 0", &
                   "the exponent of 'l^2' must be 1 in 'l^2 theta_ddot'")
        call named("cart_pendulum", "omega^2 = (m1 + m2) g/(m2 l)", &
                   "'m2' must be 'm1' in '(m1 + m2) g/(m2 l)'")
        call named("pendulum", "theta_ddot + g sin(theta) = 0", "'theta_ddot' lacks the factor 'l'")
        call named("pendulum", "2 l theta_ddot + g sin(theta) = 0", &
                   "'2 l theta_ddot' must be counted 1/2 times")
        call named("pendulum", "L_z = m l theta_dot", &
                   "'l' must have the exponent 2 in 'm l theta_dot'")
        call named("wedge", "M (q1_ddot + q2_ddot cos(alpha)) = m g sin(alpha)", &
                   "'M' must be 'm' in ")
        call named("atwood", "tension2 = m2 (g + x_ddot)/2", &
                   "'m2 (g + x_ddot)/2' must be counted 2 times")
        call named("pendulum", "l theta_ddot + g theta = 0", &
                   "'theta' must be 'sin(theta)' in 'g theta'")
        call named("oscillator", "m x_ddot + k sin(x) = 0", "'sin(x)' must be 'x' in 'k sin(x)'")
        call named("pendulum", "p_theta = m l^2 theta_dot = m l^2 theta", &
                   "'theta' must be 'theta_dot' in ")
        call named("oscillator", "m x_dot + k x = 0", "'x_dot' must be 'x_ddot' in 'm x_dot'")
        call named("oscillator", "m x_ddot + k x + m x = 0", "'m x' does not belong there")
        call named("oscillator", "E = m/2 x_dot^2", "on the right is missing k/2 x^2")
        call named("cart_pendulum", "(m1 + m2) x_ddot + m2 l theta_ddot cos(theta) = 0", &
                   "on the left is missing -m2 l theta_dot^2 sin(theta)")
        call named("pendulum", "L = m/2 l^2 theta_dot^2 - m g l cos(theta)", &
                   "the sign of 'm g l cos(theta)'")
        call named("oscillator", "E = 1", "no single change of a sign")
    contains
        subroutine named(system, statement, expected)
            character(*), intent(in) :: system, statement, expected
            character(:), allocatable :: remark
            integer :: verdict

            call graded(system, statement, verdict, remark)
            call assertEqual(is_wrong, verdict, statement//" "//remark)
            call assertTrue(index(remark, expected) > 0, statement//": "//remark)
        end subroutine named
    end subroutine slips_are_named

    subroutine every_printed_statement_is_right()
        class(system_t), allocatable :: system
        type(homework_t) :: homework
        type(grade_t) :: result
        type(error_t), allocatable :: error
        type(description_t) :: d
        character(:), allocatable :: statements
        integer :: i, k

        do i = 1, built_in
            call nth_system(i, system)
            call system%describe(d)
            call printed_statements(system, statements)
            if (statements == "") cycle
            call parse_homework("system: "//trim(d%name)//line_feed//statements, "page", &
                                homework, error)
            call assertFalse(allocated(error), "no error")
            call grade(homework, system, result, error)
            call assertFalse(allocated(error), "no error")
            do k = 1, size(result%of)
                call assertEqual(is_right, result%of(k)%verdict, trim(d%name)//": "// &
                                 homework%statements(k)%text//": "//result%of(k)%remark)
            end do
        end do
    end subroutine every_printed_statement_is_right

    subroutine statements_about_scenes()
        !! Where a constraint with the time holds, and about the scene's own equilibrium.
        call judged("turning_wire", "x sin(w t) = y cos(w t)", is_right)
        call judged("turning_wire", "x sin(w t) = -y cos(w t)", is_wrong)
        call judged("turning_wire", "m x_ddot = -lambda1 sin(w t)", is_right)
        call judged("turning_wire", "m x_ddot = lambda1 sin(w t)", is_wrong)
        call judged("pendulum_in_x_and_y", "x^2 + y^2 = l^2", is_right)
        call judged("pendulum_in_x_and_y", "x^2 - y^2 = l^2", is_wrong)
        call judged("spring_pendulum", "omega^2 = g/(l0 + m g/k)", is_right)
        call judged("spring_pendulum", "omega^2 = g/l0", is_wrong)
    contains
        subroutine judged(scene, statement, expected)
            character(*), intent(in) :: scene, statement
            integer, intent(in) :: expected
            class(system_t), allocatable :: system
            type(homework_t) :: homework
            type(grade_t) :: result
            type(error_t), allocatable :: error
            type(word_t) :: none(0)

            call read_named_system(scene, none, system, error)
            call assertFalse(allocated(error), scene)
            if (allocated(error)) return
            call parse_homework("system: "//scene//line_feed//statement, "sheet", homework, error)
            call grade(homework, system, result, error)
            call assertFalse(allocated(error), statement)
            if (allocated(error)) return
            call assertEqual(expected, result%of(1)%verdict, statement//": "//result%of(1)%remark)
        end subroutine judged
    end subroutine statements_about_scenes

    subroutine which_accelerations_follow()
        class(system_t), allocatable :: system
        type(homework_t) :: homework
        type(grade_t) :: result
        type(error_t), allocatable :: error

        call new_system("cart_pendulum", system, error)
        call parse_homework("system: cart_pendulum"//line_feed// &
                            "l theta_ddot + x_ddot cos(theta) + g sin(theta) = 0", "sheet", &
                                homework, error)
        call grade(homework, system, result, error)
        call assertEqual(1, result%equations)
        call assertFalse(any(result%determined), "one equation is not enough")
        call parse_homework("system: cart_pendulum"//line_feed//"L = L"//line_feed// &
                            "x_ddot = m2 sin(theta) (l theta_dot^2 + g cos(theta))/(m1 + m2 "// &
                                "sin(theta)^2)", &
                            "sheet", homework, error)
        call grade(homework, system, result, error)
        call assertTrue(result%determined(1), "x_ddot is given")
        call assertFalse(result%determined(2), "theta_ddot is not")
        call parse_homework("system: cart_pendulum"//line_feed// &
                            "x_bob_ddot = x_ddot + l theta_ddot cos(theta) "// &
                            "- l theta_dot^2 sin(theta)", "sheet", homework, error)
        call grade(homework, system, result, error)
        call assertEqual(is_right, result%of(1)%verdict, result%of(1)%remark)
        call assertEqual(0, result%equations, "where the bob is says nothing of its motion")
        ! numbers in half of the states only, and an acceleration that is 0 in all
        call determines("pendulum", "sqrt(theta_ddot) = sqrt(-g/l sin(theta))", 1)
        call determines("pendulum", "sqrt(-theta_ddot) = sqrt(g/l sin(theta))", 1)
        call determines("rolling_disk", "phi_ddot = 0", 1)
        call determines("pendulum", "small: F = m g", 0)
    contains
        subroutine determines(name, statement, accelerations)
            character(*), intent(in) :: name, statement
            integer, intent(in) :: accelerations

            call new_system(name, system, error)
            call parse_homework("system: "//name//line_feed//statement, "sheet", homework, error)
            call grade(homework, system, result, error)
            call assertEqual(is_right, result%of(1)%verdict, statement)
            call assertEqual(accelerations, result%equations, statement)
            call assertEqual(accelerations, count(result%determined), message=statement)
        end subroutine determines
    end subroutine which_accelerations_follow

    subroutine examples_have_four_digits()
        !! Those of a number times a power of ten are the same; with an exponent beyond 10^-4
        !! and 10^6.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: none

        call new_system("pendulum", system, none)
        call has("1e-7", .true.)
        call has("1e-3", .false.)
        call has("1", .false.)
        call has("1e4", .false.)
        call has("1e8", .true.)
    contains
        subroutine has(factor, exponent)
            character(*), intent(in) :: factor
            logical, intent(in) :: exponent
            type(homework_t) :: homework
            type(grade_t) :: result
            type(error_t), allocatable :: error
            character(:), allocatable :: left, second

            call parse_homework("system: pendulum"//line_feed//factor//" theta_ddot = cos(theta)", &
                                "sheet", homework, error)
            call grade(homework, system, result, error)
            associate (text => result%of(1)%example)
                call assertEqual(1, index(text, "left "), text)
                left = text(6:index(text, ",") - 1)
                second = text(index(text, "theta_ddot = ") + 13:)
            end associate
            if (index(second, ",") > 0) second = second(:index(second, ",") - 1)
            call assertTrue((index(left, "E") > 0) .eqv. exponent, left)
            call assertEqual(digits_of(second), digits_of(left), result%of(1)%example)
        end subroutine has
    end subroutine examples_have_four_digits

    function digits_of(number) result(digits)
        !! Without the sign, the point, the exponent, and zeros at the ends.
        character(*), intent(in) :: number
        character(:), allocatable :: digits
        integer :: i, last

        digits = ""
        last = len(number)
        if (index(number, "E") > 0) last = index(number, "E") - 1
        do i = 1, last
            if (scan(number(i:i), "0123456789") == 0) cycle
            if (digits == "" .and. number(i:i) == "0") cycle
            digits = digits//number(i:i)
        end do
        digits = digits(:verify(digits, "0", back=.true.))
    end function digits_of

    subroutine lines_that_follow()
        !! From a wrong T, an equation of motion, a momentum, a frequency, or two of them; and a new
        !! mistake does not.
        call traced("cart_pendulum", "w0fffffffr", &
            "T = (m1 + m2)/2 x_dot^2 + m2/2 l^2 theta_dot^2 - m2 l x_dot theta_dot cos(theta)"// &
            "; V = -m2 g l cos(theta)"// &
            "; L = (m1 + m2)/2 x_dot^2 + m2/2 l^2 theta_dot^2 + m2 g l cos(theta)"// &
            " - m2 l x_dot theta_dot cos(theta)"// &
            "; p_x = (m1 + m2) x_dot - m2 l theta_dot cos(theta)"// &
            "; d/dt dL/dtheta_dot = m2 l^2 theta_ddot - m2 l x_ddot cos(theta)"// &
            " + m2 l x_dot theta_dot sin(theta)"// &
            "; dL/dtheta = m2 l x_dot theta_dot sin(theta) - m2 g l sin(theta)"// &
            "; (m1 + m2) x_ddot - m2 l theta_ddot cos(theta) + m2 l theta_dot^2 sin(theta) = 0"// &
            "; l theta_ddot = x_ddot cos(theta) - g sin(theta)"// &
            "; (m1 + m2 sin(theta)^2) x_ddot = -m2 sin(theta) (l theta_dot^2 + g cos(theta))"// &
            "; omega^2 = (m1 + m2) g/(m1 l)")
        call traced("cart_pendulum", "rwfffw", &
            "(m1 + m2) x_ddot + m2 l theta_ddot cos(theta) - m2 l theta_dot^2 sin(theta) = 0"// &
            "; m2 l^2 theta_ddot + m2 l x_ddot cos(theta) - m2 g l sin(theta) = 0"// &
            "; theta_ddot = (g sin(theta) - x_ddot cos(theta))/l"// &
            "; theta_ddot = ((m1 + m2) g sin(theta) - m2 l theta_dot^2 sin(theta) cos(theta))"// &
            "/(l (m1 + m2 sin(theta)^2))"// &
            "; omega^2 = -(m1 + m2) g/(m1 l); omega^2 = -(m1 + m2) g/(m2 l)")
        call traced("pendulum", "wffffr", "p_theta = m l theta_dot"// &
            "; d/dt dL/dtheta_dot = m l theta_ddot; m l theta_ddot = -m g l sin(theta)"// &
            "; theta_ddot = -g sin(theta); omega = sqrt(g); omega = sqrt(g/l)")
        call traced("pendulum", "wfw", "omega^2 = 2 g/l; omega = sqrt(2 g/l); omega = g/l")
        call traced("double_pendulum", "wwfw", "(m1 + m2) l1 theta1_ddot + m2 l2 theta2_ddot "// &
            "cos(D) - m2 l2 theta2_dot^2 sin(D) + (m1 + m2) g sin(theta1) = 0"// &
            "; l2 theta2_ddot + l1 theta1_ddot sin(D) - l1 theta1_dot^2 sin(D) + "// &
            "g sin(theta2) = 0"// &
            "; (m1 + m2) l1 theta1_ddot + m2 cos(D) (l1 theta1_dot^2 sin(D) - g sin(theta2) - "// &
            "l1 theta1_ddot sin(D)) - m2 l2 theta2_dot^2 sin(D) + (m1 + m2) g sin(theta1) = 0"// &
            "; l2 theta2_ddot + l1 theta1_ddot sin(D) + l1 theta1_dot^2 sin(D) + "// &
            "g sin(theta2) = 0")
        call traced("pendulum", "wffw", "V = m g l cos(theta); dL/dtheta = m g l sin(theta)"// &
            "; E = m/2 l^2 theta_dot^2 + m g l cos(theta); omega = sqrt(2 g/l)")
        call traced("oscillator", "wffw", "T = m x_dot^2; 2 m x_ddot + b x_dot + k x = 0"// &
            "; x_ddot = -(b x_dot + k x)/(2 m); 2 m x_ddot - b x_dot + k x = 0")
        call traced("pendulum", "wfwf", "T = m l^2 theta_dot^2; L = m l^2 theta_dot^2 - V"// &
            "; V = m g l sin(theta); l theta_ddot = -g cos(theta)/2")
    end subroutine lines_that_follow

    subroutine a_second_slip_does_not_follow()
        !! Neither where what is supposed is in the line but by rounding, nor in a term that was
        !! wrong before, beside the true equation of the same coordinate.
        call traced("driven_pendulum", "wwf", "7 (p_theta^2/(2 m l^2) - g l cos(theta) + "// &
            "m/4 (a W sin(theta))^2) = (slow_energy)*7"// &
            "; slow_energy = p_theta^2/(2 m l^2) - 2 m g l cos(theta) + m/4 (a W sin(theta))^2"// &
            "; slow_energy - p_theta^2/(2 m l^2) + g l cos(theta) = m/4 (a W sin(theta))^2")
        call traced("cart_pendulum", "wffwff", &
            "L = (m1 + m2)/2 x_dot^2 + m2/4 l^2 theta_dot^2 + m2 l x_dot theta_dot cos(theta)"// &
            " + m2 g l cos(theta); p_theta = m2 l^2 theta_dot/2 + m2 l x_dot cos(theta)"// &
            "; g sin(theta) + x_ddot cos(theta) = -l theta_ddot/2"// &
            "; g sin(theta) + x_ddot cos(theta) = 0; g tan(theta) = -x_ddot"// &
            "; l theta_ddot = -2 g sin(theta) - 2 x_ddot cos(theta)")
        call traced("cart_pendulum", "wfwf", "(m1 + m2) x_ddot + 2 m2 l theta_ddot cos(theta)"// &
            " - m2 l theta_dot^2 sin(theta) = 0"// &
            "; x_ddot = m2 l (theta_dot^2 sin(theta) - 2 theta_ddot cos(theta))/(m1 + m2)"// &
            "; (m1 + m2) x_ddot + 3 m2 l theta_ddot cos(theta) = m2 l theta_dot^2 sin(theta)"// &
            "; x_ddot (m1 + m2 - 3 m2 cos(theta)^2) = m2 sin(theta) (l theta_dot^2 + "// &
            "3 g cos(theta))")
        call traced("wedge", "wfw", "(M + m) q2_ddot + 2 m q1_ddot cos(alpha) = 0"// &
            "; q2_ddot = -2 m q1_ddot cos(alpha)/(M + m)"// &
            "; (M + m) q2_ddot - m q1_ddot cos(alpha) = 0")
    end subroutine a_second_slip_does_not_follow

    subroutine drag_has_a_decay_rate()
        !! q goes as exp(-gamma t) cos(omega t), and omega_0 is without the drag.
        call traced("pendulum", "rrwrwrrw", "omega^2 = g/l - (b/(2 m l^2))^2"// &
            "; gamma = b/(2 m l^2); gamma = b/(m l^2); omega_0^2 = g/l; omega^2 = g/l"// &
            "; omega^2 = omega_0^2 - gamma^2; omega = sqrt(omega_0^2 - gamma^2)"// &
            "; omega^2 = omega_0^2 + gamma^2", remarks="8 the sign of 'gamma^2'"// &
            "; 5 on the right is missing -gamma^2; 3 'b/(m l^2)' must be counted 1/2 times")
        call traced("oscillator", "rrw", "m x_ddot + b x_dot + k x = 0"// &
            "; omega^2 = k/m - (b/(2 m))^2; omega^2 = k/m - b/(2 m)", &
            remarks="3 'b/(2 m)' must be squared")
        ! omega, omega_0 and gamma follow from a wrong equation, a wrong T and each other
        call traced("oscillator", "wfffr", "m x_ddot + b x_dot + 2 k x = 0"// &
            "; omega_0^2 = 2 k/m; omega^2 = 2 k/m - (b/(2 m))^2"// &
            "; omega = sqrt(2 k/m - gamma^2); gamma = b/(2 m)")
        call traced("oscillator", "wf", "m x_ddot - b x_dot + k x = 0; gamma = -b/(2 m)")
        call traced("pendulum", "wfffw", "T = m l^2 theta_dot^2; gamma = b/(4 m l^2)"// &
            "; omega_0^2 = g/(2 l); omega^2 = g/(2 l) - (b/(4 m l^2))^2; gamma = b/(3 m l^2)")
        call traced("oscillator", "wf", "gamma = b/m; omega^2 = k/m - b^2/m^2")
        ! without drag gamma is any letter, and omega that of the free oscillation
        call traced("oscillator", "0rw", "gamma = 3 k; omega^2 = k/m; omega^2 = gamma/m", &
                    remarks="3 ")
        ! of dry friction the first term is no decay rate
        call traced("dry_friction", "r", "omega^2 = k/m")
    end subroutine drag_has_a_decay_rate

    subroutine small_oscillations()
        !! Right to first order, and no more.
        call traced("cart_pendulum", "rrrrwwwrwur", "small: l theta_ddot + x_ddot + g theta = 0"// &
            "; small: l theta_ddot + x_ddot cos(theta) + g sin(theta) = 0"// &
            "; small: cos(theta) = 1; small: cos(theta) = 1 - theta^2/2"// &
            "; small: cos(theta) = 1 + theta; small: sin(theta) = 2 theta"// &
            "; small: l theta_ddot + x_ddot - g theta = 0"// &
            "; small: theta_ddot = -(m1 + m2) g/(m1 l) sin(theta)"// &
            "; small: theta_ddot = -(m1 + m2) g/(m2 l) theta; small: tension = m2 g "// &
            "(1 + theta); small: theta_dot^2 theta = l theta_ddot + x_ddot + g theta", &
            remarks="7 the sign of 'g theta'; 9 'm2' must be 'm1'; 10 'tension' in a statement")
        call traced("pendulum", "rrwww", "small: theta_ddot + 2 gamma theta_dot + "// &
            "omega_0^2 theta = 0; small: theta_ddot + b/(m l^2) theta_dot + (omega^2 + gamma^2)"// &
            " theta = 0; small: l theta_ddot - b/(m l) theta_dot + g theta = 0"// &
            "; l theta_ddot + b/(m l) theta_dot + g theta = 0"// &
            "; small: theta_ddot + 2 gamma theta_dot + omega^2 theta = 0", &
            remarks="3 the sign of 'b/(m l) theta_dot'; 4 'theta' must be 'sin(theta)'")
        call traced("double_pendulum", "ru", "small: l1 theta1_ddot + l2 theta2_ddot + "// &
            "g theta2 = 0; small: theta1_ddot + omega^2 theta1 = 0", remarks="2 omega behind")
        call traced("spring_pendulum", "r", "small: m r_ddot + k r = 0", &
                    remarks="1 if the coordinates are counted from the equilibrium")
    end subroutine small_oscillations

    subroutine the_lines_of_the_notes()
        !! Line by line, with the letters that the scan lost: each stands in the derivation but the
        !! lecture's slips, and what follows from these.
        call traced("cart_pendulum", "wrrwrfrfrrrfrfrr", sheet("notes_cart_pendulum"))
        call traced("double_pendulum", "rwrr", sheet("notes_double_pendulum"))
        call traced("oscillator", "rrrrr", "L = m/2 x_dot^2 - k/2 x^2; dL/dx = -k x"// &
            "; dL/dx_dot = m x_dot; d/dt dL/dx_dot = m x_ddot; m x_ddot + k x = 0")
        call traced("atwood", "rrrrr", "T = (m1 + m2)/2 x_dot^2; V = -m1 g x + m2 g x"// &
            "; L = (m1 + m2)/2 x_dot^2 + (m1 - m2) g x"// &
            "; (m1 - m2) g = (m1 + m2) x_ddot; x_ddot = (m1 - m2)/(m1 + m2) g")
        call traced("wedge", "rrrrrrwf", "T = M/2 q2_dot^2 + m/2 (q1_dot^2 + q2_dot^2 + "// &
            "2 q1_dot q2_dot cos(alpha))"// &
            "; T = (M + m)/2 q2_dot^2 + m/2 (q1_dot^2 + 2 q1_dot q2_dot cos(alpha))"// &
            "; V = -m g q1 sin(alpha); dL/dq2_dot = M q2_dot + m (q2_dot + q1_dot cos(alpha))"// &
            "; q2_ddot = -m/(M + m) q1_ddot cos(alpha)"// &
            "; q1_ddot = g sin(alpha)/(1 - m cos(alpha)^2/(M + m))"// &
            "; d/dt dL/dq1_dot = M (q1_ddot + q2_ddot cos(alpha))"// &
            "; m g sin(alpha) = M (q1_ddot + q2_ddot cos(alpha))")
    contains
        function sheet(name) result(statements)
            !! Those of a sheet that the program carries, with semicolons between.
            character(*), intent(in) :: name
            character(:), allocatable :: statements
            type(homework_t) :: homework
            type(error_t), allocatable :: error
            integer :: i

            statements = ""
            call read_homework(name, homework, error)
            call assertFalse(allocated(error), name)
            if (allocated(error)) return
            do i = 1, size(homework%statements)
                if (i > 1) statements = statements//";"
                statements = statements//homework%statements(i)%text
            end do
        end function sheet
    end subroutine the_lines_of_the_notes

    subroutine sheets_that_cannot_be_read()
        type(homework_t) :: homework
        type(error_t), allocatable :: error

        call refused("", "no line 'system: NAME' says which system this is about; 'lagrangia "// &
                         "list systems' shows the names")
        call refused("x = 1", "no line 'system: NAME' says which system this is about; "// &
                              "'lagrangia list systems' shows the names")
        call refused("system: pendulum", "nothing to grade; write a line 'left = right', say "// &
                                         "an equation of motion")
        call refused("system:"//line_feed//"x = 1", "sheet:1: 'system:' needs a name; "// &
                                                    "'lagrangia list systems' shows them")
        call refused("system: pendulum"//line_feed//"system: wedge", &
                     "sheet:2: 'system:' a second time; one file is about one system")
        call refused("system: pendulum"//line_feed//"gravity: 3", "sheet:2: column 8: what "// &
                                                                  "is 'gravity':? Before a "// &
                                                                  "colon stands 'system', "// &
                                                                  "'set', 'constant' or 'small'")
        call refused("system: pendulum"//repeat(line_feed//"theta = theta", 1001), &
                     "sheet:1002: more than 1000 statements")
        call parse_homework("System: pendulum"//repeat(line_feed//"theta = theta", 1000), "sheet", &
                            homework, error)
        call assertFalse(allocated(error), "1000 statements are not too many")
        call unreadable("set: g", "'set:' needs a parameter")
        call unreadable("set: g*l = l = 2", "a line 'set:' has one '='")
        call unreadable("sin 2 theta = 1", "write 'sin(2)'")
        call unreadable("theta_ddot + 3", "column 15: no '='; write 'left = right', or '#' in")
        call unreadable("theta_ddot == 3", "column 13: one side of '=' is empty")
        call unreadable("= 3", "column 1: one side of '=' is empty")
        call unreadable("theta_ddot =", "column 13: one side of '=' is empty")
        call unreadable("g = 9.81", "a line 'set: g = ...' fixes one")
        call unreadable("theta_dt = 1", "unknown name 'theta_dt'")
        call unreadable("p_x = 1", "unknown name 'p_x'")
        call unreadable("theta_ddot = log(-1)", "no number")
        call unreadable("theta_ddot = (1", "column ")
    contains
        subroutine refused(text, expected)
            character(*), intent(in) :: text, expected
            type(homework_t) :: homework
            type(error_t), allocatable :: error

            call parse_homework(text, "sheet", homework, error)
            call assertTrue(allocated(error), text(:min(len(text), 80)))
            if (allocated(error)) call assertTrue(is_said(error%message, expected), error%message)
        end subroutine refused

        subroutine unreadable(statement, expected)
            character(*), intent(in) :: statement, expected
            character(:), allocatable :: remark
            integer :: verdict

            call graded("pendulum", statement, verdict, remark)
            call assertEqual(is_unreadable, verdict, statement)
            call assertTrue(index(remark, expected) > 0, remark)
        end subroutine unreadable
    end subroutine sheets_that_cannot_be_read
end module test_grading
