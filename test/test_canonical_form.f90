module test_canonical_form
    !! Simplified formulas are the same formulas, and read as on the page.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_canonical_form, only: simplified, split_terms
    use lagrangia_derivative, only: derivative, time_derivative
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_text, only: formula_text
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: to_text
    use random_formulas, only: draw_formula, draw_number, plain_value
    use random_states, only: restart_random, uniform
    implicit none (type, external)
    private
    public :: canonical_form_suite

    character(*), parameter :: coordinates(*) = [character(8) :: "x", "theta", "theta1", &
                                                 "theta2", "r"]
    character(*), parameter :: parameters(*) = [character(8) :: "m", "m1", "m2", "l", "l1", "l2", &
                                                "g", "k", "a", "b"]

contains

    function canonical_form_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("canonical_form")
        call suite%addTest(TestMethod("formulas_read_as_on_the_page", formulas_read_as_on_the_page))
        call suite%addTest(TestMethod("equations_of_motion_are_those_of_the_page", &
                                      equations_of_motion_are_those_of_the_page))
        call suite%addTest(TestMethod("what_cancels_is_gone", what_cancels_is_gone))
        call suite%addTest(TestMethod("what_does_not_fit_stays", what_does_not_fit_stays))
        call suite%addTest(TestMethod("simplified_is_equal", simplified_is_equal, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("simplified_twice_is_simplified_once", &
                                      simplified_twice_is_simplified_once, setUp=restart_random))
        call suite%addTest(TestMethod("terms_sum_to_the_formula", terms_sum_to_the_formula, &
                                      setUp=restart_random))
    end function canonical_form_suite

    function lecture_symbols() result(symbols)
        !! Time, coordinates, velocities, accelerations, parameters.
        type(symbols_t) :: symbols
        integer :: i

        call symbols%add("t")
        do i = 1, size(coordinates)
            call symbols%add(trim(coordinates(i)))
        end do
        do i = 1, size(coordinates)
            call symbols%add(trim(coordinates(i))//"_dot")
        end do
        do i = 1, size(coordinates)
            call symbols%add(trim(coordinates(i))//"_ddot")
        end do
        do i = 1, size(parameters)
            call symbols%add(trim(parameters(i)))
        end do
    end function lecture_symbols

    subroutine becomes(text, expected)
        !! `text`, simplified, is printed as expected, and stays so.
        character(*), intent(in) :: text, expected
        type(expression_t) :: e

        call read_formula(text, e)
        call prints(e, expected)
    end subroutine becomes

    subroutine read_formula(text, e)
        !! It must be one.
        character(*), intent(in) :: text
        type(expression_t), intent(out) :: e
        type(error_t), allocatable :: error

        call parse_formula(text, lecture_symbols(), e, error)
        call assertFalse(allocated(error), text)
        if (allocated(error)) call assertEqual("", error%message)
    end subroutine read_formula

    subroutine prints(e, expected)
        !! Simplified, and once more.
        type(expression_t), intent(in) :: e
        character(*), intent(in) :: expected
        type(expression_t) :: once, twice
        type(symbols_t) :: symbols

        symbols = lecture_symbols()
        once = simplified(e, symbols)
        call assertEqual(expected, formula_text(once, symbols))
        twice = simplified(once, symbols)
        call assertEqual(expected, formula_text(twice, symbols), "simplified twice")
    end subroutine prints

    subroutine formulas_read_as_on_the_page()
        !! Order of factors and terms, collected parameters, fractions, denominators.
        call becomes("cos(theta) theta_dot l x_dot m2", "m2 l x_dot theta_dot cos(theta)")
        call becomes("m1 x_dot^2/2 + 0.5 m2 x_dot^2", "(m1 + m2)/2 x_dot^2")
        call becomes("l g m", "m g l")
        call becomes("g l2 cos(theta2) m2 + (m2 + m1) g l1 cos(theta1)", &
                     "(m1 + m2) g l1 cos(theta1) + m2 g l2 cos(theta2)")
        call becomes("3/2 m r^2 - pi x/4 + 2.5 x_dot", "5/2 x_dot - pi/4 x + 3/2 m r^2")
        call becomes("k/2 (r - l)^2", "k/2 r^2 - k l r + k/2 l^2")
        call becomes("-g sin(theta)/l - x_dot/(2 l) + theta/l + 1/(2 m)", &
                     "-x_dot/(2 l) + theta/l + 1/(2 m) - g/l sin(theta)")
        call becomes("x_dot^2/(2 m r^2) + 1/(2 r)", "x_dot^2/(2 m r^2) + 1/(2 r)")
        call becomes("1/2 x^2 + x/3", "1/2 x^2 + 1/3 x")
        call becomes("2 (a + b) x - 4 a x - 4 b x", "-2 (a + b) x")
        call becomes("cos(theta2 - theta1) + sin(theta2 - theta1)", &
                     "-sin(theta1 - theta2) + cos(theta1 - theta2)")
        call becomes("x sgn(x) + x^2 sgn(x) + |x| sgn(x) + sgn(-x)^3 + sgn(x)^2", &
                     "x + x abs(x) + 1 + abs(x) - sgn(x)")
        call becomes("|x - r| sgn(x - r) x + sgn(-3) + sgn(0)", "x^2 - x r - 1")
        call becomes("tanh(-x) + |-x| + atan(-2 x) + cosh(-x) + sinh(-x) + tan(-x)", &
                     "abs(x) - tan(x) - sinh(x) + cosh(x) - tanh(x) - atan(2 x)")
        call becomes("m g (x + r)/(m + m1) - m g x/(m + m1)", "m g/(m + m1) r")
        call becomes("9.81 m x - 0.1 x + 1e-3 x", "(9.81 m - 0.099) x")
        call becomes("1/3 x + 1/6 x", "1/2 x")
        call becomes("m/x^a + l/x^2 - x/x^(m + 1)", "-x/x^(m + 1) + m/x^a + l/x^2")
        call becomes("2^0.5 x + (k/m)^(1/2) t", "sqrt(k/m) t + sqrt(2) x")
        call becomes("(m1 + m2) g/(m1 l)", "(m1 + m2) g/(m1 l)")
        call becomes("(g/l + k/m) theta", "(g/l + k/m) theta")
        call becomes("-(m1 - m2) g/(m1 + m2 + m/l^2)", &
                     "-(m1 - m2) g l^2/(m + m1 l^2 + m2 l^2)")
        call becomes("((m1 + m2) (-m2 g l sin(theta)) - m2 l cos(theta) m2 l theta_dot^2 "// &
                     "sin(theta))/((m1 + m2) m2 l^2 - (m2 l cos(theta))^2)", &
                     "-(m2 l theta_dot^2 sin(theta) cos(theta) + (m1 + m2) g sin(theta))/"// &
                     "(l (m1 + m2 sin(theta)^2))")
        call becomes("2^x + x^a x^a + x^(1/2)", "2^x + sqrt(x) + (x^a)^2")
    end subroutine formulas_read_as_on_the_page

    subroutine equations_of_motion_are_those_of_the_page()
        !! From kinetic and potential energy to both sides of the Euler-Lagrange equations.
        character(*), parameter :: cart = "m1/2 x_dot^2 + m2/2 ((x_dot + l theta_dot "// &
            "cos(theta))^2 + (l theta_dot sin(theta))^2) + m2 g l cos(theta)"
        character(*), parameter :: double = "m1/2 (l1 theta1_dot)^2 + m2/2 ((l1 theta1_dot "// &
            "cos(theta1) + l2 theta2_dot cos(theta2))^2 + (l1 theta1_dot sin(theta1) + "// &
            "l2 theta2_dot sin(theta2))^2) + m1 g l1 cos(theta1) + "// &
            "m2 g (l1 cos(theta1) + l2 cos(theta2))"
        character(*), parameter :: spring = "m/2 (r_dot^2 + r^2 theta_dot^2) - k/2 (r - l)^2 "// &
            "+ m g r cos(theta)"

        call becomes(cart, "(m1 + m2)/2 x_dot^2 + m2 l x_dot theta_dot cos(theta) + "// &
                     "m2/2 l^2 theta_dot^2 + m2 g l cos(theta)")
        call moves(cart, "x", "(m1 + m2) x_ddot + m2 l theta_ddot cos(theta) - "// &
                   "m2 l theta_dot^2 sin(theta)", "0")
        call moves(cart, "theta", "m2 l x_ddot cos(theta) + m2 l^2 theta_ddot - "// &
                   "m2 l x_dot theta_dot sin(theta)", &
                   "-m2 l x_dot theta_dot sin(theta) - m2 g l sin(theta)")
        call becomes(double, "(m1 + m2)/2 l1^2 theta1_dot^2 + m2 l1 l2 theta1_dot theta2_dot "// &
                     "cos(theta1 - theta2) + m2/2 l2^2 theta2_dot^2 + "// &
                     "(m1 + m2) g l1 cos(theta1) + m2 g l2 cos(theta2)")
        call moves(double, "theta2", "m2 l1 l2 theta1_ddot cos(theta1 - theta2) + "// &
                   "m2 l2^2 theta2_ddot - m2 l1 l2 theta1_dot^2 sin(theta1 - theta2) + "// &
                   "m2 l1 l2 theta1_dot theta2_dot sin(theta1 - theta2)", &
                   "m2 l1 l2 theta1_dot theta2_dot sin(theta1 - theta2) - m2 g l2 sin(theta2)")
        call moves(spring, "r", "m r_ddot", "m r theta_dot^2 - k r + k l + m g cos(theta)")
        call moves(spring, "theta", "m r^2 theta_ddot + 2 m r theta_dot r_dot", &
                   "-m g r sin(theta)")
    end subroutine equations_of_motion_are_those_of_the_page

    subroutine moves(lagrangian, coordinate, rate, force)
        !! The time derivative of the momentum, and the derivative by the coordinate.
        character(*), intent(in) :: lagrangian, coordinate, rate, force
        integer, parameter :: n = size(coordinates)
        type(expression_t) :: e
        type(symbols_t) :: symbols
        integer :: i, rates(2*n + 1)

        symbols = lecture_symbols()
        rates = [0, (i + n, i=2, 2*n + 1)]
        call read_formula(lagrangian, e)
        call prints(derivative(e, symbols%find(coordinate)), force)
        e = simplified(derivative(e, symbols%find(coordinate//"_dot")), symbols)
        call prints(time_derivative(e, rates, 1), rate)
    end subroutine moves

    subroutine what_cancels_is_gone()
        !! Squares of sine and cosine, sums over themselves, roots.
        call becomes("m1 + m2 - m2 cos(theta)^2", "m1 + m2 sin(theta)^2")
        call becomes("sin(theta)^2 - 1", "-cos(theta)^2")
        call becomes("x sin(theta)^4 + x sin(theta)^2 cos(theta)^2", "x sin(theta)^2")
        call becomes("sin(x)^2 + 2 cos(x)^2", "sin(x)^2 + 2 cos(x)^2")
        call becomes("cos(x) cos(r) + sin(x) sin(r)", "cos(x - r)")
        call becomes("cos(x) cos(r) - sin(x) sin(r)", "cos(x + r)")
        call becomes("m sin(x) cos(r) + m cos(x) sin(r)", "m sin(x + r)")
        call becomes("sin(r) cos(x) - cos(r) sin(x)", "-sin(x - r)")
        call becomes("sin(x) cos(r) - cos(x) sin(r)", "sin(x - r)")
        call becomes("(a^2 - b^2)/(a + b)", "a - b")
        call becomes("a/(a + b) + b/(a + b)", "1")
        call becomes("(x + r)^9/(x + r)^8", "x + r")
        call becomes("1/(x - r)^2 - 1/(r - x)^2", "0")
        call becomes("2/(2 a + 2 b)", "1/(a + b)")
        call becomes("1/(1/(a + b) + 1/a)", "(a + b) a/(2 a + b)")
        call becomes("sqrt(k/m)^2 x + |x|^2 + sqrt(x)^3/x", "x^2 + k/m x + sqrt(x)")
        call becomes("sqrt(9/4) + sqrt(2) + cos(0) + exp(0) + sin(0) + |-3|", "sqrt(2) + 13/2")
        call becomes("(-2 a)^3 + 8 a^3", "0")
        call becomes("(-2 a)^-3 + 1/(2 a)^3", "0")
        call becomes("x - x", "0")
        call becomes("0 x/r", "0")
        call becomes("x/x", "1")
        call becomes("g/l sin(theta)/(1 + m2/m1 sin(theta)^2)", &
                     "m1 g sin(theta)/(l (m1 + m2 sin(theta)^2))")
    end subroutine what_cancels_is_gone

    subroutine what_does_not_fit_stays()
        !! No value, too many terms, too many factors, numbers too large: as it was.
        character(:), allocatable :: text
        integer :: i

        call becomes("1/x + 1/0", "1/x + 1/0")
        call becomes("x/(r - r)", "x/(r - r)")
        call becomes("(x + r + theta + theta1 + theta2)^12", "(x + theta + theta1 + theta2 + r)^12")
        call becomes("1e300^2 x", "1e300^2 x")
        call becomes("0^-1 + x", "0^-1 + x")
        call becomes("x + log(0)", "x + log(0)")
        text = "x"
        do i = 1, 25
            text = text//" sin("//to_text(i)//" x)"
        end do
        call becomes(text, text)
        text = "x"
        do i = 1, 400
            text = text//" + sin("//to_text(i)//" x)"
        end do
        call becomes(text, text)
        call becomes(repeat("sin(", 200)//"x"//repeat(")", 200), &
                     repeat("sin(", 200)//"x"//repeat(")", 200))
        call becomes("x"//repeat(" + m", 2000), "x + 2000 m")
    end subroutine what_does_not_fit_stays

    subroutine draw(e, x)
        !! A random formula of all symbols, and their values.
        type(expression_t), intent(out) :: e
        type(hyperdual_t), intent(out) :: x(:)
        integer :: k

        call draw_formula(size(x), draw_number(14), e)
        do k = 1, size(x)
            x(k) = hyperdual_t(uniform(-2.0_dp, 2.0_dp))
        end do
    end subroutine draw

    subroutine simplified_is_equal()
        !! 6000 formulas, each with its value before and after: they differ by rounding only.
        !! Half of them have few symbols, so that much cancels.
        integer, parameter :: trials = 6000, few = 4
        type(symbols_t) :: all, symbols
        type(expression_t) :: after, before
        type(hyperdual_t), allocatable :: x(:)
        type(hyperdual_t) :: expected, found
        real(dp) :: bound, other
        integer :: changed, compared, i, n

        all = lecture_symbols()
        n = size(all%names)
        symbols = all
        compared = 0
        changed = 0
        do i = 1, trials
            if (i == trials/2) then
                n = few
                symbols%names = all%names([2, 7, n - 1, n])
            end if
            if (allocated(x)) deallocate (x)
            allocate (x(n))
            call draw(before, x)
            after = simplified(before, symbols)
            call plain_value(before, x, expected, bound)
            if (.not. (ieee_is_finite(expected%re) .and. bound < 1e-6_dp)) cycle
            call plain_value(after, x, found, other)
            if (other > 1e-6_dp) cycle
            compared = compared + 1
            if (formula_text(before, symbols) /= formula_text(after, symbols)) changed = changed + 1
            call assertEqual(expected%re, found%re, bound + other, &
                             formula_text(before, symbols)//" = "//formula_text(after, symbols))
        end do
        call assertTrue(compared > trials/2, to_text(compared)//" compared")
        call assertTrue(changed > compared/2, to_text(changed)//" changed")
    end subroutine simplified_is_equal

    subroutine simplified_twice_is_simplified_once()
        !! Also after it has been printed and read.
        integer, parameter :: trials = 2000
        type(symbols_t) :: symbols
        type(expression_t) :: e
        type(error_t), allocatable :: error
        type(hyperdual_t) :: x(4)
        character(:), allocatable :: text
        integer :: i, n

        symbols = lecture_symbols()
        n = size(symbols%names)
        symbols%names = symbols%names([2, 7, n - 1, n])
        text = ""
        do i = 1, trials
            call draw(e, x)
            e = simplified(e, symbols)
            text = formula_text(e, symbols)
            e = simplified(e, symbols)
            call assertEqual(text, formula_text(e, symbols), "simplified twice")
            call parse_formula(text, symbols, e, error)
            call assertFalse(allocated(error), text)
            e = simplified(e, symbols)
            call assertEqual(text, formula_text(e, symbols), "read and simplified")
        end do
    end subroutine simplified_twice_is_simplified_once

    subroutine terms_sum_to_the_formula()
        !! Their number, their signs, their sum.
        type(symbols_t) :: symbols
        type(expression_t) :: e
        type(expression_t), allocatable :: terms(:)
        character(:), allocatable :: shown
        type(hyperdual_t) :: x(4), expected, found
        real(dp) :: bound, other, total
        integer :: i, k

        symbols = lecture_symbols()
        call read_formula("-(x - m) + r (x + l) - (g - (a - b))", e)
        call split_terms(e, terms)
        shown = ""
        do k = 1, size(terms)
            shown = shown//formula_text(terms(k), symbols)//"; "
        end do
        call assertEqual("-x; m; r (x + l); -(g - (a - b)); ", shown)
        do i = 1, 500
            call draw(e, x)
            call plain_value(e, x, expected, bound)
            if (.not. (ieee_is_finite(expected%re) .and. bound < 1e-6_dp)) cycle
            call split_terms(e, terms)
            total = 0.0_dp
            do k = 1, size(terms)
                call plain_value(terms(k), x, found, other)
                total = total + found%re
                bound = bound + other
            end do
            call assertEqual(expected%re, total, bound)
        end do
    end subroutine terms_sum_to_the_formula
end module test_canonical_form
