module test_formula_parser
    !! What a formula means, and what is said of one that means nothing.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_parser, only: parse_equation, parse_formula
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_formula_text, only: formula_text
    use lagrangia_kinds, only: dp
    use lagrangia_symbols, only: symbols_t
    implicit none (type, external)
    private
    public :: formula_parser_suite

    real(dp), parameter :: t = 0.3_dp, x = 1.7_dp, theta = 0.8_dp, x_dot = -0.6_dp, &
                           theta_dot = 2.3_dp, m = 1.3_dp, m1 = 2.1_dp, m2 = 0.7_dp, l = 0.9_dp, &
                           g = 9.81_dp
    character(*), parameter :: names(*) = [character(9) :: "t", "x", "theta", "x_dot", &
                                           "theta_dot", "m", "m1", "m2", "l", "g"]
    real(dp), parameter :: values(*) = [t, x, theta, x_dot, theta_dot, m, m1, m2, l, g]
    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    function formula_parser_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("formula_parser")
        call suite%addTest(TestMethod("formulas_mean_what_the_course_means", &
                                      formulas_mean_what_the_course_means))
        call suite%addTest(TestMethod("letters_and_signs_of_books_are_read", &
                                      letters_and_signs_of_books_are_read))
        call suite%addTest(TestMethod("definitions_stand_for_formulas", &
                                      definitions_stand_for_formulas))
        call suite%addTest(TestMethod("equations_have_two_sides", equations_have_two_sides))
        call suite%addTest(TestMethod("names_must_be_names", names_must_be_names))
        call suite%addTest(TestMethod("what_is_missing_is_named", what_is_missing_is_named))
        call suite%addTest(TestMethod("wrong_names_have_a_remedy", wrong_names_have_a_remedy))
        call suite%addTest(TestMethod("two_meanings_are_refused", two_meanings_are_refused))
        call suite%addTest(TestMethod("wrong_characters_are_named", wrong_characters_are_named))
        call suite%addTest(TestMethod("wrong_numbers_are_named", wrong_numbers_are_named))
        call suite%addTest(TestMethod("length_and_depth_are_limited", length_and_depth_are_limited))
        call suite%addTest(TestMethod("definitions_cannot_explode", definitions_cannot_explode))
    end function formula_parser_suite

    function lecture_symbols() result(symbols)
        !! The names above.
        type(symbols_t) :: symbols
        integer :: i

        do i = 1, size(names)
            call symbols%add(trim(names(i)))
        end do
    end function lecture_symbols

    subroutine is(text, expected, symbols)
        !! `text` has this value, and what is printed of it reads back to the same text and value.
        character(*), intent(in) :: text
        real(dp), intent(in) :: expected
        type(symbols_t), intent(in), optional :: symbols
        type(symbols_t) :: used
        type(expression_t) :: e(1)
        type(error_t), allocatable :: error
        type(formula_program_t) :: program
        character(:), allocatable :: printed
        real(dp) :: found(1), again(1)

        used = lecture_symbols()
        if (present(symbols)) used = symbols
        call parse_formula(text, used, e(1), error)
        if (allocated(error)) then
            call assertTrue(.false., text(:min(len(text), 80))//": "//error%message)
            return
        end if
        call new_formula_program(program, e, size(used%names))
        call program%evaluate(values, found)
        call assertEqual(expected, found(1), (64 + len(text)/2)*epsilon(1.0_dp)*abs(expected), &
                         text(:min(len(text), 80)))
        printed = formula_text(e(1), used)
        if (len(printed) > 10000) return
        call parse_formula(printed, used, e(1), error)
        if (allocated(error)) then
            call assertTrue(.false., "printed: "//error%message)
            return
        end if
        call assertEqual(printed, formula_text(e(1), used), "printed twice")
        call new_formula_program(program, e, size(used%names))
        call program%evaluate(values, again)
        call assertEqual(found(1), again(1), 0.0_dp, "printed: "//text(:min(len(text), 80)))
    end subroutine is

    subroutine is_refused(text, message)
        !! In these words.
        character(*), intent(in) :: text, message
        type(expression_t) :: e
        type(error_t), allocatable :: error

        call parse_formula(text, lecture_symbols(), e, error)
        call assertTrue(allocated(error), "'"//text//"' is no formula")
        if (allocated(error)) call assertEqual(message, error%message)
    end subroutine is_refused

    subroutine formulas_mean_what_the_course_means()
        !! Products side by side, from left to right with quotients; powers before products and
        !! signs; functions, bars, numbers.
        call is("m2 l x_dot theta_dot cos(theta)", m2*l*x_dot*theta_dot*cos(theta))
        call is("(m1 + m2)/2 x_dot^2", (m1 + m2)/2.0_dp*x_dot**2)
        call is("1/2 m x_dot^2", 0.5_dp*m*x_dot**2)
        call is("m2/2 l^2", m2/2.0_dp*l**2)
        call is("x t/(m1 + m2)", x*t/(m1 + m2))
        call is("m/(2 m1) - 1/2*4", m/(2.0_dp*m1) - 2.0_dp)
        call is("x/m/l", x/m/l)
        call is("x - m - l", x - m - l)
        call is("x - (m - l)", x - (m - l))
        call is("x/(m/l)", x/(m/l))
        call is("x (m l)", x*(m*l))
        call is("-x^2", -x**2)
        call is("(-x)^2", x**2)
        call is("-x m + l", -x*m + l)
        call is("+x", x)
        call is("x*(-m)", -x*m)
        call is("2^-1 x", 0.5_dp*x)
        call is("x^-2", 1.0_dp/x**2)
        call is("x^(1/2) + x^0.5", 2.0_dp*sqrt(x))
        call is("x^(m + l)", x**(m + l))
        call is("x^m l", x**m*l)
        call is("x^m (l + 1)", x**m*(l + 1.0_dp))
        call is("(x^2)^3", x**6)
        call is("x**3", x**3)
        call is("x^100/1.5^100", (x/1.5_dp)**100)
        call is("sin(theta)^2 + sin^2(theta)", 2.0_dp*sin(theta)**2)
        call is("m (x + l)", m*(x + l))
        call is("(m1 - m2)(g + l)", (m1 - m2)*(g + l))
        call is("2(x^2 - 1)^2", 2.0_dp*(x**2 - 1.0_dp)**2)
        call is("|x_dot|", -x_dot)
        call is("|x_dot| |x - 2| m", -x_dot*(2.0_dp - x)*m)
        call is("||x_dot| - 2|", 2.0_dp + x_dot)
        call is("|(x_dot) m| (|x_dot|)", x_dot**2*m)
        call is("abs(x_dot) + atan(x) + cos(x) + cosh(x)", -x_dot + atan(x) + cos(x) + cosh(x))
        call is("exp(x) + log(x) + sin(x) + sinh(x)", exp(x) + log(x) + sin(x) + sinh(x))
        call is("3 + sgn(x) + sgn(-x)", 3.0_dp)
        call is("sqrt(x) + tan(x) + tanh(x)", sqrt(x) + tan(x) + tanh(x))
        call is("pi/4 + cos(pi)", pi/4.0_dp - 1.0_dp)
        call is("1.5e-3 + .5 + 5. + 2E2", 205.5015_dp)
        call is("9.80665 x + 0.1 x + 1e-30 + 123456789.123456789", &
                9.80665_dp*x + 0.1_dp*x + 123456789.123456789_dp)
        call is("1/3 x + 22/7 - 1e20/3e19", x/3.0_dp + 22.0_dp/7.0_dp - 1e20_dp/3e19_dp)
        call is("x*2", 2.0_dp*x)
        call is(" x  /   2 ", x/2.0_dp)
    end subroutine formulas_mean_what_the_course_means

    subroutine letters_and_signs_of_books_are_read()
        !! In UTF-8, as they are pasted.
        call is("m g l cos("//char(206)//char(184)//")", m*g*l*cos(theta))       ! theta
        call is("m"//char(194)//char(183)//"g", m*g)                             ! a dot
        call is("m "//char(226)//char(136)//char(146)//" g", m - g)              ! minus
        call is("x"//char(194)//char(178)//" m", x**2*m)                         ! squared
        call is("m"//char(226)//char(130)//char(129)//" x", m1*x)                ! index 1
        call is(char(207)//char(128)//char(194)//char(160)//"x", pi*x)           ! pi, blank
        call is("sin"//char(194)//char(178)//"("//char(206)//char(184)//")", sin(theta)**2)
        call is(char(206)//char(184)//"_dot "//char(226)//char(132)//char(147), theta_dot*l)
        call is("x"//achar(9)//"m", x*m)
    end subroutine letters_and_signs_of_books_are_read

    subroutine definitions_stand_for_formulas()
        !! Also within each other.
        type(symbols_t) :: symbols
        type(expression_t) :: e
        type(error_t), allocatable :: error

        symbols = lecture_symbols()
        call parse_formula("x - theta", symbols, e, error)
        call symbols%define("D", e, error)
        call assertFalse(allocated(error), "no error")
        call is("cos(D) D^2", cos(x - theta)*(x - theta)**2, symbols)
        call parse_formula("D^2 m", symbols, e, error)
        call symbols%define("E1", e, error)
        call is("E1/2 - D E1", ((x - theta)**2*m)*(0.5_dp - x + theta), symbols)
        call assertTrue(e%depends_on(2) .and. .not. e%depends_on(1), "x is in it, t is not")
        call symbols%define("D", e, error)
        call assertEqual("the name 'D' is given twice; take another one", error%message)
        call symbols%add("D", error)
        call assertEqual("the name 'D' is given twice; take another one", error%message)
        call symbols%add("x", error)
        call assertEqual("the name 'x' is given twice; take another one", error%message)
    end subroutine definitions_stand_for_formulas

    subroutine equations_have_two_sides()
        !! One `=` between them.
        type(symbols_t) :: symbols
        type(expression_t) :: left, right
        type(error_t), allocatable :: error

        symbols = lecture_symbols()
        call parse_equation("m x_dot = -m g sin(theta)", symbols, left, right, error)
        call assertFalse(allocated(error), "no error")
        call assertEqual("m x_dot", formula_text(left, symbols))
        call assertEqual("-m g sin(theta)", formula_text(right, symbols))
        call refused("m x_dot", "column 8: '=' and the other side are missing; "// &
                     "write an equation, left side = right side")
        call refused("m = x = l", "column 7: a second '='; an equation has one")
        call refused("m x_dot =", "column 10: a side of the equation is empty; "// &
                     "write 0 if it is zero")
        call refused("= m", "column 1: a side of the equation is empty; write 0 if it is zero")
        call refused("m = x)", "column 6: ')' closes no bracket; delete it or open one before")
        call refused("(m = x", "column 4: the bracket of column 1 is not closed; write ')'")
        call is_refused("m = x", "column 3: '=' makes an equation; one formula is needed here")
        call is_refused("m == x", "column 3: '=' makes an equation; one formula is needed here")
    contains
        subroutine refused(text, message)
            character(*), intent(in) :: text, message

            call parse_equation(text, symbols, left, right, error)
            call assertTrue(allocated(error), "'"//text//"' is no equation")
            if (allocated(error)) call assertEqual(message, error%message)
        end subroutine refused
    end subroutine equations_have_two_sides

    subroutine names_must_be_names()
        !! Of symbols, as a user may choose them.
        call refused("", "a name is empty; write one like theta1")
        call refused("2x", "'2x' is no name for a formula; write letters, digits and "// &
                     "underscores, a letter first, as in theta1")
        call refused("a b", "'a b' is no name for a formula; write letters, digits and "// &
                     "underscores, a letter first, as in theta1")
        call refused("a_very_long_name_that_nobody_reads", "the name "// &
                     "'a_very_long_name_that_nobody_reads' is longer than 32 characters; "// &
                     "shorten it")
        call refused("pi", "'pi' is the number 3.14159...; take another name")
        call refused("log", "'log' is a function; take another name")
    contains
        subroutine refused(name, message)
            character(*), intent(in) :: name, message
            type(symbols_t) :: symbols
            type(error_t), allocatable :: error

            call symbols%add(name, error)
            call assertTrue(allocated(error), "'"//name//"' is no name")
            if (allocated(error)) call assertEqual(message, error%message)
        end subroutine refused
    end subroutine names_must_be_names

    subroutine what_is_missing_is_named()
        !! Operands, brackets, arguments.
        call is_refused("", "column 1: the formula is empty; write one like m g l cos(theta)")
        call is_refused("   ", "column 1: the formula is empty; write one like m g l cos(theta)")
        call is_refused("* x", "column 1: '*' lacks what stands before it; write a*b")
        call is_refused("x*", "column 3: behind '*' something is missing; complete it or "// &
                        "delete "// &
                        "the sign")
        call is_refused("x +", "column 4: behind '+' something is missing; complete it or "// &
                        "delete the sign")
        call is_refused("(x -)", "column 5: behind '-' something is missing; complete it or "// &
                        "delete the sign")
        call is_refused("-", "column 2: behind '-' something is missing; complete it or delete "// &
                        "the sign")
        call is_refused("x^", "column 3: '^' lacks its exponent; write x^2, x^-1, x^(a + b)")
        call is_refused("x^ + 2 /", "column 9: behind '/' something is missing; complete it or "// &
                        "delete the sign")
        call is_refused("x^*2", "column 3: '^' lacks its exponent; write x^2, x^-1, x^(a + b)")
        call is_refused("(x + m", "column 7: the bracket of column 1 is not closed; write ')'")
        call is_refused("m (x + (g)", "column 11: the bracket of column 3 is not closed; write ')'")
        call is_refused("x)", "column 2: ')' closes no bracket; delete it or open one before")
        call is_refused("m ()", "column 4: the brackets are empty; write a formula into them")
        call is_refused("sin()", "column 5: the brackets are empty; write a formula into them")
        call is_refused("|x", "column 3: '|' of column 1 is not closed; write |x| or abs(x)")
        call is_refused("(|x)", "column 4: '|' of column 2 is not closed; write |x| or abs(x)")
        call is_refused("sin theta m", "column 5: 'sin' needs brackets; write 'sin(theta)'")
        call is_refused("sin theta/m", "column 5: 'sin' needs brackets; write 'sin(theta)'")
        call is_refused("sin theta^2", "column 5: 'sin' needs brackets; write 'sin(theta)'")
        call is_refused("m sin theta (m)", "column 7: 'sin' needs brackets; write 'sin(theta)'")
        call is_refused("m cos 2 theta", "column 7: 'cos' needs brackets; write 'cos(2)'")
        call is_refused("sin", "column 4: 'sin' lacks its argument; write 'sin(x)'")
        call is_refused("sin + 1", "column 5: 'sin' lacks its argument; write 'sin(x)'")
    end subroutine what_is_missing_is_named

    subroutine wrong_names_have_a_remedy()
        !! The nearest name, the product that was meant, the function as it is called here.
        call is_refused("m thta", "column 3: unknown name 'thta'; did you mean 'theta'?")
        call is_refused("mgl cos(theta)", &
                        "column 1: unknown name 'mgl'; a product needs blanks: 'm g l'")
        call is_refused("x_dott", "column 1: unknown name 'x_dott'; did you mean 'x_dot', or "// &
                        "the product 'x_dot t'?")
        call is_refused("x_ddot", "column 1: unknown name 'x_ddot'; did you mean 'x_dot'?")
        call is_refused("ml", &
                        "column 1: unknown name 'ml'; did you mean 'm', or the product 'm l'?")
        call is_refused("quark", "column 1: unknown name 'quark'; there are t, x, theta, "// &
                        "x_dot, "// &
                        "theta_dot, m, m1, m2, l, g, pi")
        call is_refused("ln(x)", "column 1: unknown function 'ln'; did you mean 'log'?")
        call is_refused("Cos(x)", "column 1: unknown function 'Cos'; did you mean 'cos'?")
        call is_refused("arctan(x)", "column 1: unknown function 'arctan'; did you mean 'atan'?")
        call is_refused("tg(x)", "column 1: unknown function 'tg'; did you mean 'tan'?")
        call is_refused("sen(x)", "column 1: unknown function 'sen'; did you mean 'sin'?")
        call is_refused("root(x)", "column 1: unknown function 'root'; did you mean 'sqrt'?")
        call is_refused("ctg(x)", "column 1: unknown function 'ctg'; did you mean '1/tan'?")
        call is_refused("sec(x)", "column 1: unknown function 'sec'; did you mean '1/cos'?")
        call is_refused("csc(x)", "column 1: unknown function 'csc'; did you mean '1/sin'?")
        call is_refused("bessel(x)", "column 1: unknown function 'bessel'; there are abs, "// &
                        "atan, "// &
                        "cos, cosh, exp, log, sgn, sin, sinh, sqrt, tan, tanh, acos, asin")
        call is_refused("X", "column 1: unknown name 'X'; did you mean 'x'?")
        call is_refused("m x_dot'", "column 8: a prime is no derivative; write x_ddot")
    end subroutine wrong_names_have_a_remedy

    subroutine two_meanings_are_refused()
        !! And what was probably a slip of the finger.
        call is_refused("2theta", "column 1: a blank is missing in '2theta'; write '2 theta'")
        call is_refused("x + 2.5m1", "column 5: a blank is missing in '2.5m1'; write '2.5 m1'")
        call is_refused("2e", "column 1: a blank is missing in '2e'; write '2 e'")
        call is_refused("x^2^3", &
                        "column 4: a second '^' has two meanings; write x^(2^3) or (x^2)^3")
        call is_refused("(x/m)^1/2", "column 8: '^1/' divides the power 1; write x^(1/2), or "// &
                        "sqrt(x)")
        call is_refused("e^-m x", "column 6: is this in the exponent? Write e^(-m ...), or "// &
                        "e^(-m) ...")
        call is_refused("e^m/x", "column 4: is this in the exponent? Write e^(m ...), or e^(m) ...")
        call is_refused("x*-m", "column 3: '-' follows '*'; write brackets, a*(-b)")
        call is_refused("x - -m", "column 5: '-' follows '-'; write brackets, a*(-b)")
        call is_refused("--x", "column 2: '-' follows '-'; write brackets, a*(-b)")
        call is_refused("x + * m", "column 5: '*' follows '+'; delete one of them")
        call is_refused("x */ m", "column 4: '/' follows '*'; delete one of them")
        call is_refused("x 2", "column 3: the number '2' follows a factor; write it before, or "// &
                        "with * or ^")
        call is_refused("2 3", "column 3: the number '3' follows a factor; write it before, or "// &
                        "with * or ^")
        call is_refused("theta(t)", "column 6: 'theta(t)' would be a product; write "// &
                        "'theta', or "// &
                        "'theta t' if one is meant")
        call is_refused("sin^-1(x)", "column 5: 'sin^' takes a whole number, sin^2(x); write "// &
                        "1/sin(x) or sin(x)^n for others")
        call is_refused("sin^x(x)", "column 5: 'sin^' takes a whole number, sin^2(x); write "// &
                        "1/sin(x) or sin(x)^n for others")
        call is_refused("x^sin(m)", "column 3: a function as an exponent needs brackets, "// &
                        "x^(sin(...))")
        call is_refused("(x | m)", "column 7: '|' of column 4 is not closed; write |x| or abs(x)")
        call is_refused("|x) m|", "column 3: '|' of column 1 is not closed; write |x| or abs(x)")
    end subroutine two_meanings_are_refused

    subroutine wrong_characters_are_named()
        !! Each with its column, counted in characters.
        call is_refused("x, m", "column 2: ',' has no meaning here; decimals have a point: 0.5")
        call is_refused("m [x]", "column 3: '[' is no bracket of a formula; write ( and )")
        call is_refused("\vec{x}", "column 1: '\vec' is a vector; write its components, "// &
                        "x_dot and y_dot")
        call is_refused("x % m", "column 3: '%' has no meaning in a formula; write 0.05 for "// &
                        "five percent")
        call is_refused("_x", "column 1: a name begins with a letter; write it before the '_'")
        call is_refused("m . x", "column 3: a point stands alone; write * for a product, "// &
                        "0.5 for a "// &
                        "decimal")
        call is_refused("x"//achar(7)//"m", "column 2: U+0007 is a control character; delete it")
        call is_refused(char(206)//char(184)//" + "//char(226)//char(136)//char(154)//"x m", &
                        "column 6: 'sqrt' needs brackets; write 'sqrt(x)'")
        call is_refused("44"//char(194)//char(176), "column 3: U+00B0 is a degree; angles "// &
                        "are in "// &
                        "radians, write pi/4 for 45 degrees")
        call is_refused("q"//char(204)//char(135)//" = x", "column 1: unknown name 'q_dot'; "// &
                        "did you mean 'x_dot'?")
        call is_refused("x "//char(255), "column 3: byte \xFF has no meaning in a formula; "// &
                        "write "// &
                        "plain letters")
        call is_refused("x"//achar(0), "column 2: U+0000 is a control character; delete it")
    end subroutine wrong_characters_are_named

    subroutine wrong_numbers_are_named()
        !! By the grammar of numbers.
        call is_refused("x + 1.2.3", "column 5: '1.2.3' has two points; write one, and "// &
                        "nothing between thousands")
        call is_refused("1e999", "column 1: '1e999' is too large for a double (at most "// &
                        "1.79769e308)")
        call is_refused("2 x/1e-999", "column 5: '1e-999' is too small for a double (at least "// &
                        "4.94066e-324, or 0)")
        call is_refused("1e+", "column 1: a blank is missing in '1e'; write '1 e'")
    end subroutine wrong_numbers_are_named

    subroutine length_and_depth_are_limited()
        !! 10000 characters, 200 brackets within each other; up to there all is well.
        character(*), parameter :: deep = "more than 200 brackets within each other; give "// &
                        "parts "// &
            "of the formula names, D = theta1 - theta2"

        call is(repeat("(", 200)//"x"//repeat(")", 200), x)
        call is_refused(repeat("(", 201)//"x"//repeat(")", 201), "column 201: "//deep)
        call is_refused(repeat("(", 1000)//"x"//repeat(")", 1000), "column 201: "//deep)
        call is_refused(repeat("sin(", 1000)//"x"//repeat(")", 1000), "column 804: "//deep)
        call is_refused(repeat("|", 1000)//"x"//repeat("|", 1000), "column 201: "//deep)
        call is_refused(repeat("-(", 300)//"x"//repeat(")", 300), "column 402: "//deep)
        call is("0 x"//repeat("+m", 4998), 4998.0_dp*m)
        call is("x"//repeat("/x*x", 2499), x)
        call is("0 x"//repeat("+(m)", 300), 300.0_dp*m)  ! beside each other
        call is("0 x"//repeat("+|-m|", 300), 300.0_dp*m)
        call is_refused("x"//repeat("+x", 5000), "the formula has more than 10000 characters; "// &
                        "give parts of it names, D = theta1 - theta2")
        call is("0 "//repeat("x ", 500)//repeat(" ", 20000), 0.0_dp)
    end subroutine length_and_depth_are_limited

    subroutine definitions_cannot_explode()
        !! Each twice the one before: refused before it is written out.
        type(symbols_t) :: symbols
        type(expression_t) :: e
        type(error_t), allocatable :: error
        character(3) :: name
        integer :: i

        symbols = lecture_symbols()
        call symbols%define("D10", e, error)
        do i = 11, 40
            write (name, "(a, i2.2)") "D", i - 1
            call parse_formula(name//" + "//name, symbols, e, error)
            if (allocated(error)) exit
            write (name, "(a, i2.2)") "D", i
            call symbols%define(name, e, error)
            call assertFalse(allocated(error), "no error")
        end do
        call assertTrue(allocated(error), "too long")
        if (allocated(error)) call assertEqual("the formula, with its definitions written out, "// &
                      "has more than 100000 parts; shorten it", error%message)
        call assertEqual(26, i, "2^17 = 131072 parts")
    end subroutine definitions_cannot_explode
end module test_formula_parser
