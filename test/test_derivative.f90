module test_derivative
    !! Symbolic derivatives are those of hyper-dual numbers.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use funit, only: TestMethod, TestSuite, assertEqual, assertTrue
    use lagrangia_canonical_form, only: simplified
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
    public :: derivative_suite

    integer, parameter :: n = 4
    character(*), parameter :: names(n) = ["a", "b", "x", "y"]

contains

    function derivative_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("derivative")
        call suite%addTest(TestMethod("each_function_has_its_derivative", &
                                      each_function_has_its_derivative))
        call suite%addTest(TestMethod("derivatives_are_those_of_hyperdual_numbers", &
                                      derivatives_are_those_of_hyperdual_numbers, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("time_derivatives_follow_the_motion", &
                                      time_derivatives_follow_the_motion, setUp=restart_random))
    end function derivative_suite

    function few_symbols() result(symbols)
        !! The names above.
        type(symbols_t) :: symbols
        integer :: i

        do i = 1, n
            call symbols%add(names(i))
        end do
    end function few_symbols

    subroutine each_function_has_its_derivative()
        !! As in a table of them.
        call is("3 x - b", "3")
        call is("b", "0")
        call is("x^3", "3 x^2")
        call is("x^2", "2 x")
        call is("x^-1", "-x^-2")
        call is("x^a", "a x^(a - 1)")
        call is("a^x", "a^x log(a)")
        call is("x^x", "x x^(x - 1) + x^x log(x)")
        call is("a/x", "(-a)/x^2")
        call is("x/a", "1/a")
        call is("abs(x)", "sgn(x)")
        call is("abs(a x)", "sgn(a x) a")
        call is("abs(x)^2", "2 x")
        call is("abs(x - a)^3", "abs(x - a) (3 (x - a))")
        call is("abs(x)^4", "abs(x)^2 (4 x)")
        call is("sgn(x)", "0")
        call is("atan(x)", "1/(1 + x^2)")
        call is("cos(x)", "-sin(x)")
        call is("cosh(x)", "sinh(x)")
        call is("exp(2 x)", "exp(2 x)*2")
        call is("log(x)", "1/x")
        call is("sin(x y)", "cos(x y) y")
        call is("sinh(x)", "cosh(x)")
        call is("sqrt(x)", "1/(2 sqrt(x))")
        call is("tan(x)", "1 + tan(x)^2")
        call is("tanh(x)", "1/cosh(x)^2")
    contains
        subroutine is(text, expected)
            character(*), intent(in) :: text, expected
            type(expression_t) :: e
            type(error_t), allocatable :: error
            type(symbols_t) :: symbols

            symbols = few_symbols()
            call parse_formula(text, symbols, e, error)
            e = derivative(e, 3)
            if (text == "x^-1") then  ! the parser has the number 1 negated
                e = simplified(e, symbols)
                call assertEqual("-1/x^2", formula_text(e, symbols), text)
            else
                call assertEqual(expected, formula_text(e, symbols), text)
            end if
        end subroutine is
    end subroutine each_function_has_its_derivative

    subroutine derivatives_are_those_of_hyperdual_numbers()
        !! The first and the mixed second one of 3000 random formulas, also simplified. Rounding
        !! carries both ways of computing about as far; ten times the bound of one of them is given.
        integer, parameter :: trials = 3000
        type(expression_t) :: d, e, second
        type(hyperdual_t) :: expected, found, x(n)
        type(symbols_t) :: symbols
        real(dp) :: bound, other
        integer :: compared, i, k, twice

        symbols = few_symbols()
        compared = 0
        twice = 0
        do i = 1, trials
            call draw_formula(n, draw_number(10), e)
            do k = 1, n
                x(k) = hyperdual_t(uniform(-2.0_dp, 2.0_dp))
            end do
            x(3)%d1 = 1.0_dp
            x(4)%d2 = 1.0_dp
            call plain_value(e, x, expected, bound)
            if (.not. (ieee_is_finite(expected%re) .and. ieee_is_finite(expected%d12) .and. &
                       bound < 1e-6_dp)) cycle
            d = derivative(e, 3)
            call plain_value(d, x, found, bound)
            if (.not. bound < 1e-6_dp) cycle
            compared = compared + 1
            call assertEqual(expected%d1, found%re, 10.0_dp*bound, formula_text(e, symbols))
            call plain_value(simplified(d, symbols), x, found, other)
            if (other < 1e-6_dp) call assertEqual(expected%d1, found%re, 10.0_dp*(bound + other), &
                              "simplified: "//formula_text(e, symbols))
            second = derivative(d, 4)
            call plain_value(second, x, found, bound)
            if (.not. bound < 1e-6_dp) cycle
            if (abs(expected%d12) > 0.0_dp) twice = twice + 1
            call assertEqual(expected%d12, found%re, 10.0_dp*bound, &
                             "twice: "//formula_text(e, symbols))
        end do
        call assertTrue(compared > trials/2, to_text(compared)//" compared")
        call assertTrue(twice > 90, to_text(twice)//" mixed")
    end subroutine derivatives_are_those_of_hyperdual_numbers

    subroutine time_derivatives_follow_the_motion()
        !! With \(\dot x = y\), \(\dot y = b\), and the time \(a\).
        integer, parameter :: trials = 1000
        type(expression_t) :: e
        type(hyperdual_t) :: expected, found, x(n)
        real(dp) :: bound
        integer :: compared, i, k

        compared = 0
        do i = 1, trials
            call draw_formula(n, draw_number(10), e)
            do k = 1, n
                x(k) = hyperdual_t(uniform(-2.0_dp, 2.0_dp))
            end do
            x(1)%d1 = 1.0_dp
            x(3)%d1 = x(4)%re
            x(4)%d1 = x(2)%re
            call plain_value(e, x, expected, bound)
            if (.not. (ieee_is_finite(expected%d1) .and. bound < 1e-6_dp)) cycle
            call plain_value(time_derivative(e, [0, 0, 4, 2], 1), x, found, bound)
            if (.not. bound < 1e-6_dp) cycle
            compared = compared + 1
            call assertEqual(expected%d1, found%re, 10.0_dp*bound, formula_text(e, few_symbols()))
        end do
        call assertTrue(compared > trials/2, to_text(compared)//" compared")
    end subroutine time_derivatives_follow_the_motion
end module test_derivative
