module test_grading
    !! Homework: right in any words, wrong with the term that is.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: built_in, new_system, nth_system
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, operator(-)
    use lagrangia_formula_parser, only: parse_equation
    use lagrangia_formula_text, only: formula_text
    use lagrangia_grading, only: grade, grade_t
    use lagrangia_homework, only: homework_t, parse_homework
    use lagrangia_judgement, only: is_right, is_unreadable, is_wrong
    use lagrangia_kinds, only: dp
    use lagrangia_motion_samples, only: new_samples, samples_t
    use lagrangia_random_draws, only: random_t
    use lagrangia_sampled_formula, only: evaluate_nodes
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text, word_t
    use rewritings, only: draw_rewriting, draw_slip
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
        call suite%addTest(TestMethod("right_in_other_words", right_in_other_words))
        call suite%addTest(TestMethod("every_printed_statement_is_right", &
                                      every_printed_statement_is_right))
        call suite%addTest(TestMethod("no_rewriting_is_called_wrong", no_rewriting_is_called_wrong))
        call suite%addTest(TestMethod("no_slip_is_called_right", no_slip_is_called_right))
        call suite%addTest(TestMethod("which_accelerations_follow", which_accelerations_follow))
        call suite%addTest(TestMethod("sheets_that_cannot_be_read", sheets_that_cannot_be_read))
    end function grading_suite

    subroutine graded(system, statement, verdict, remark)
        !! Of the last statement of several lines.
        character(*), intent(in) :: system, statement
        integer, intent(out) :: verdict
        character(:), allocatable, intent(out) :: remark
        class(system_t), allocatable :: about
        type(homework_t) :: homework
        type(grade_t) :: result
        type(error_t), allocatable :: error

        verdict = 0
        call new_system(system, about, error)
        call parse_homework("system: "//system//line_feed//statement, "sheet", homework, error)
        if (.not. allocated(error)) call grade(homework, about, result, error)
        if (allocated(error)) then
            remark = error%message
            return
        end if
        verdict = result%of(size(result%of))%verdict
        remark = result%of(size(result%of))%remark
    end subroutine graded

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
        call named("oscillator", "E = m/2 x_dot^2", "on the left is missing ")
        call named("cart_pendulum", "(m1 + m2) x_ddot + m2 l theta_ddot cos(theta) = 0", &
                   "on the left is missing -m2 l theta_dot^2 sin(theta)")
        call named("pendulum", "L = m/2 l^2 theta_dot^2 - m g l cos(theta)", &
                   "the sign of 'm g l cos(theta)'")
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

    subroutine right_in_other_words()
        call right("pendulum", "theta_ddot = -g/l sin(theta)")
        call right("pendulum", "sin(theta)/theta_ddot = -l/g")
        call right("pendulum", "dL/dtheta = -m g l sin(theta)")
        call right("pendulum", "d/dt dL/dtheta_dot = m l^2 theta_ddot")
        call right("pendulum", "d/dt dL/dtheta_dot - dL/dtheta = 0")
        call right("pendulum", "I = m l^2"//line_feed//"E = I/2 theta_dot^2 - m g l cos(theta)")
        call right("pendulum", "m l^2 theta_ddot = dL/dtheta = -m g l sin(theta)")
        call right("pendulum", "V = m g l (1 - cos(theta))")
        call right("pendulum", "omega = sqrt(g/l)")
        call right("pendulum", "L = m l^2 theta_dot^2 + 2 m g l cos(theta) + theta theta_dot "// &
            "cos(t) - "// &
                   "theta^2/2 sin(t)")
        call right("double_pendulum", "L = (m1 + m2)/2 l1^2 theta1_dot^2 + m2/2 l2^2 "// &
            "theta2_dot^2 + "// &
                   "m2 l1 l2 theta1_dot theta2_dot cos(D) - V + 7 theta1_dot")
        call right("driven_pendulum", "L = m/2 (l^2 theta_dot^2 + 2 l theta_dot y_p_dot "// &
            "sin(theta)) - "// &
                   "m g (y_p - l cos(theta))")
        call right("atwood", "(m1 + m2) x_ddot = (m1 - m2) g")
        call right("rotating_hoop", "Omega^2 = g/r - omega^2")
        call right("rotating_hoop", "Omega^2 = omega^2 - g^2/(omega r)^2")
        call right("double_pendulum", "m1 l1 l2 omega^4 - (m1 + m2) (l1 + l2) g omega^2 + "// &
            "(m1 + m2) g^2 = 0")
        call right("pendulum", "set: g = 9.81"//line_feed//"l theta_ddot + 9.81 sin(theta) = 0")
        call right("wedge", "q1_ddot = g sin(alpha)/(1 - m_block cos(alpha)^2/(m_wedge + m_block))")
    contains
        subroutine right(system, statement)
            character(*), intent(in) :: system, statement
            character(:), allocatable :: remark
            integer :: verdict

            call graded(system, statement, verdict, remark)
            call assertEqual(is_right, verdict, statement//": "//remark)
        end subroutine right
    end subroutine right_in_other_words

    subroutine printed_statements(system, statements)
        !! Equations of motion, energy and quantities as `describe` has them.
        class(system_t), intent(in) :: system
        character(:), allocatable, intent(out) :: statements
        type(description_t) :: d
        integer :: i

        call system%describe(d)
        statements = ""
        if (d%name == "hanging_chain") return
        do i = 1, size(d%equations)
            statements = statements//trim(d%equations(i))//line_feed
        end do
        statements = statements//"E = "//trim(d%energy)//line_feed//"L = "//trim(d%lagrangian)// &
            line_feed
        do i = 1, size(d%quantities)
            if (d%quantities(i)%formula == "") cycle
            ! conserved, and printed, on a level plane, or along the field, only
            if (any([character(8) :: "p_phi", "L_axis"] == d%quantities(i)%name)) cycle
            statements = statements//trim(d%quantities(i)%name)//" = "// &
                trim(d%quantities(i)%formula)//line_feed
        end do
    end subroutine printed_statements

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

    subroutine no_rewriting_is_called_wrong()
        !! 200 of all systems: both sides in other words, exchanged, times a factor, plus another
        !! one.
        character(:), allocatable :: misjudged
        integer :: counts(4), named

        call try_all(.false., 200, counts, named, misjudged)
        call assertEqual(200, counts(is_right), misjudged)
    end subroutine no_rewriting_is_called_wrong

    subroutine no_slip_is_called_right()
        !! 200 of all systems; nine in ten are named.
        character(:), allocatable :: misjudged
        integer :: counts(4), named

        call try_all(.true., 200, counts, named, misjudged)
        call assertEqual(200, counts(is_wrong), misjudged)
        call assertTrue(named >= 180, to_text(named)//" are named")
    end subroutine no_slip_is_called_right

    subroutine try_all(with_slip, number, counts, named, misjudged)
        !! Judge so many, of the systems in turn.
        logical, intent(in) :: with_slip
        integer, intent(in) :: number
        integer, intent(out) :: counts(4)  !! of each verdict
        integer, intent(out) :: named      !! wrong ones with a change that mends them
        character(:), allocatable, intent(out) :: misjudged  !! these statements
        type(random_t) :: random
        class(system_t), allocatable :: system
        type(samples_t) :: samples
        type(error_t), allocatable :: error
        type(description_t) :: d
        character(:), allocatable :: statements, remark, statement
        type(word_t) :: none(0)
        integer :: i, done, verdict

        misjudged = ""
        counts = 0
        named = 0
        done = 0
        do while (done < number)
            do i = 1, built_in
                call nth_system(i, system)
                call system%describe(d)
                call printed_statements(system, statements)
                if (statements == "") cycle
                call new_samples(system, statements, none, samples, error)
                call change_one(statements, samples, random, with_slip, statement)
                if (statement == "") cycle
                if (with_slip) then
                    call new_samples(system, statement, none, samples, error)
                    if (.not. is_false(statement, samples)) cycle  ! with what it does not name zero
                end if
                call graded(trim(d%name), statement, verdict, remark)
                counts(verdict) = counts(verdict) + 1
                if (verdict == is_wrong .and. index(remark, "no single") == 0) named = named + 1
                if (verdict /= merge(is_wrong, is_right, with_slip)) misjudged = misjudged// &
                    trim(d%name)//": "//statement//"; "
                done = done + 1
                if (done == number) return
            end do
        end do
    end subroutine try_all

    subroutine change_one(statements, samples, random, with_slip, statement)
        !! One of the lines, rewritten, perhaps with a slip that matters; "" if none came out.
        character(*), intent(in) :: statements
        type(samples_t), intent(in) :: samples
        type(random_t), intent(inout) :: random
        logical, intent(in) :: with_slip
        character(:), allocatable, intent(out) :: statement
        type(expression_t) :: left, right
        type(error_t), allocatable :: error
        character(:), allocatable :: line, kind
        real(dp) :: x
        integer :: first, last

        statement = ""
        call random%uniform(0.0_dp, 1.0_dp, x)
        first = 1 + int(x*(len(statements) - 2))
        first = index(statements(:first), line_feed, back=.true.) + 1
        last = first + index(statements(first:), line_feed) - 2
        line = statements(first:last)
        call parse_equation(line, samples%symbols, left, right, error)
        if (allocated(error)) return
        if (with_slip) then
            call random%uniform(0.0_dp, 1.0_dp, x)
            if (x < 0.3_dp .and. left%count > 1) then
                call draw_slip(left, samples, random, kind)
            else
                call draw_slip(right, samples, random, kind)
            end if
            if (kind == "") return
            if (index(line, "L =") == 1) return  ! another L may give the same motion
        else
            call draw_rewriting(left, random)
            call draw_rewriting(right, random)
        end if
        call random%uniform(0.0_dp, 1.0_dp, x)
        if (x < 0.4_dp .and. index(line, "E =") /= 1) then
            statement = "7 ("//formula_text(right, samples%symbols)//") = ("// &
                        formula_text(left, samples%symbols)//")*7"
        else
            statement = formula_text(left, samples%symbols)//" = "//formula_text(right, &
                samples%symbols)
        end if
    end subroutine change_one

    logical function is_false(statement, samples)
        !! Whether its sides differ at every sample.
        character(*), intent(in) :: statement
        type(samples_t), intent(in) :: samples
        type(expression_t) :: left, right
        type(error_t), allocatable :: error
        real(dp), allocatable :: results(:, :)

        call parse_equation(statement, samples%symbols, left, right, error)
        left = left - right
        allocate (results(size(samples%values, 1), left%count))
        call evaluate_nodes(left, samples%values, results)
        is_false = all(abs(results(:, left%count)) > 1e-6_dp)
    end function is_false

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
    end subroutine which_accelerations_follow

    subroutine sheets_that_cannot_be_read()
        call refused("", "no line 'system: NAME'")
        call refused("x = 1", "no line 'system: NAME'")
        call refused("system: pendulum", "nothing to grade")
        call refused("system:"//line_feed//"x = 1", "sheet:1: 'system:' needs a name")
        call refused("system: pendulum"//line_feed//"system: wedge", &
                     "sheet:2: 'system:' a second time")
        call refused("system: pendulum"//line_feed//"theta_ddot + 3", "sheet:2: no '='")
        call refused("system: pendulum"//line_feed//"gravity: 3", "sheet:2: what is 'gravity':")
        call refused("system: pendulum"//line_feed//"set: g", "sheet:2: 'set:' needs a parameter")
        call unreadable("sin theta = 1", "write 'sin(theta)'")
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
            call assertTrue(allocated(error), text)
            if (allocated(error)) call assertTrue(index(error%message, expected) > 0, error%message)
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
