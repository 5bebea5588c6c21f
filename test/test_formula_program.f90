module test_formula_program
    !! Compiled formulas give what their operations give, one after the other.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: apply, constant, expression_t, f_cos, f_sin, function_names, &
                                    operator(*), operator(**), operator(+), operator(-), &
                                    operator(/), symbol
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_formula_text, only: formula_text
    use lagrangia_hyperdual, only: assignment(=), hyperdual_t
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: to_text
    use random_formulas, only: draw_formula, draw_number, plain_value
    use random_states, only: restart_random, uniform
    implicit none (type, external)
    private
    public :: formula_program_suite

    integer, parameter :: n = 4
    character(*), parameter :: names(n) = ["a", "b", "x", "y"]

contains

    function formula_program_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("formula_program")
        call suite%addTest(TestMethod("programs_compute_their_formulas", &
                                      programs_compute_their_formulas, setUp=restart_random))
        call suite%addTest(TestMethod("printed_formulas_are_the_same_formulas", &
                                      printed_formulas_are_the_same_formulas, setUp=restart_random))
        call suite%addTest(TestMethod("lanes_have_the_digits_of_one_state", &
                                      lanes_have_the_digits_of_one_state, setUp=restart_random))
        call suite%addTest(TestMethod("many_registers_are_as_good", many_registers_are_as_good))
        call suite%addTest(TestMethod("powers_of_two_and_signs_meet", &
                                      powers_of_two_and_signs_meet, setUp=restart_random))
        call suite%addTest(TestMethod("nothing_given_is_zero", nothing_given_is_zero))
        call suite%addTest(TestMethod("operators_build_formulas", operators_build_formulas))
    end function formula_program_suite

    function few_symbols() result(symbols)
        !! The names above.
        type(symbols_t) :: symbols
        integer :: i

        do i = 1, n
            call symbols%add(names(i))
        end do
    end function few_symbols

    subroutine programs_compute_their_formulas()
        !! Three random formulas at once, 3000 times, in doubles, on hyper-dual numbers, in lanes,
        !! and with two symbols fixed.
        !!
        !! Derivatives are bounded like values of formulas of their size: by the rounding of terms
        !! that are not larger than the largest of them, relative to the value's own bound.
        integer, parameter :: trials = 3000, most = 12
        type(expression_t) :: e(3)
        type(formula_program_t) :: bound_program, program
        type(hyperdual_t) :: expected, x(n), found(3)
        real(dp) :: bound, values(n), results(3), fixed(3), many(lanes, n), all(lanes, 3)
        integer :: compared, i, k, lane

        compared = 0
        do i = 1, trials
            do k = 1, 3
                call draw_formula(n, draw_number(most), e(k))
            end do
            do k = 1, n
                values(k) = uniform(-2.0_dp, 2.0_dp)
                x(k) = hyperdual_t(values(k), uniform(-1.0_dp, 1.0_dp), uniform(-1.0_dp, 1.0_dp), &
                                   uniform(-1.0_dp, 1.0_dp))
                many(:, k) = values(k) + 0.1_dp
            end do
            lane = draw_number(lanes)
            many(lane, :) = values
            call new_formula_program(program, e, n)
            call assertTrue(minval(program%places) >= 1 .and. maxval(program%places) <= &
                            program%registers, "each result has a register")
            call new_formula_program(bound_program, e, n, [.true., .false., .true., .false.], &
                                     values)
            call program%evaluate(values, results)
            call program%evaluate(x, found)
            call program%evaluate(many, all)
            values([1, 3]) = huge(1.0_dp)
            call bound_program%evaluate(values, fixed)
            do k = 1, 3
                call plain_value(e(k), x, expected, bound)
                if (.not. (ieee_is_finite(expected%re) .and. bound <= 1e-6_dp)) cycle
                compared = compared + 1
                call assertEqual(expected%re, results(k), bound, shown(e(k)))
                call assertEqual(expected%re, all(lane, k), bound, "lanes: "//shown(e(k)))
                call assertEqual(expected%re, fixed(k), bound, "fixed: "//shown(e(k)))
                call assertEqual(expected%re, found(k)%re, bound, "hyper-dual: "//shown(e(k)))
                if (.not. (ieee_is_finite(expected%d1) .and. ieee_is_finite(expected%d2) .and. &
                           ieee_is_finite(expected%d12))) cycle
                call assert_near(expected%d1, found(k)%d1, "d1: "//shown(e(k)))
                call assert_near(expected%d2, found(k)%d2, "d2: "//shown(e(k)))
                call assert_near(expected%d12, found(k)%d12, "d12: "//shown(e(k)))
            end do
        end do
        call assertTrue(compared > 2*trials, "values of "//to_text(compared)//" formulas")
    end subroutine programs_compute_their_formulas

    subroutine assert_near(expected, found, message)
        !! Derivatives.
        real(dp), intent(in) :: expected, found
        character(*), intent(in) :: message

        call assertEqual(expected, found, 1e-9_dp*(1.0_dp + abs(expected)), message)
    end subroutine assert_near

    function shown(e) result(text)
        !! A formula.
        type(expression_t), intent(in) :: e
        character(:), allocatable :: text

        text = formula_text(e, few_symbols())
    end function shown

    subroutine printed_formulas_are_the_same_formulas()
        !! Printed, read and printed again: the same text, and the same value but for rounding.
        integer, parameter :: trials = 3000, most = 20
        type(expression_t) :: e(2)
        type(formula_program_t) :: program
        type(error_t), allocatable :: error
        type(symbols_t) :: symbols
        character(:), allocatable :: text
        real(dp) :: results(2), values(n)
        integer :: i, k

        symbols = few_symbols()
        do i = 1, trials
            call draw_formula(n, draw_number(most), e(1))
            text = formula_text(e(1), symbols)
            call parse_formula(text, symbols, e(2), error)
            if (allocated(error)) then
                call assertTrue(.false., text//": "//error%message)
                return
            end if
            call assertEqual(text, formula_text(e(2), symbols), "printed twice")
            call new_formula_program(program, e, n)
            values = [(uniform(-2.0_dp, 2.0_dp), k=1, n)]
            call program%evaluate(values, results)
            if (ieee_is_finite(results(1))) call assertEqual(results(1), results(2), 0.0_dp, text)
        end do
    end subroutine printed_formulas_are_the_same_formulas

    subroutine many_registers_are_as_good()
        !! Sines that are all needed at the end: 400, more than the stack has room for, and about as
        !! many as it has, where formulas of doubles or of hyper-dual numbers begin to need more.
        integer :: terms

        do terms = 15, 45
            call sum_and_product(terms)
        end do
        do terms = 75, 145
            call sum_and_product(terms)
        end do
        call sum_and_product(400)
    end subroutine many_registers_are_as_good

    subroutine lanes_have_the_digits_of_one_state()
        !! Of each function but sine and cosine, which differ in the last bit by what
        !! `lagrangia_sine_cosine` says; and of a power.
        type(expression_t) :: e(size(function_names) + 1), x
        type(formula_program_t) :: program
        real(dp) :: many(lanes, 1), last(1), one(size(e)), all(lanes, size(e))
        integer :: i, k, lane

        x = symbol(1)
        do k = 1, size(function_names)
            e(k) = apply(k, x)
        end do
        e(size(e)) = x**constant(1.7_dp)
        call new_formula_program(program, e, 1)
        do i = 1, 2000
            do lane = 1, lanes
                many(lane, 1) = uniform(0.0_dp, 3.0_dp)
            end do
            call program%evaluate(many, all)
            last = many(lanes, :)
            call program%evaluate(last, one)
            do k = 1, size(e)
                if (k == f_sin .or. k == f_cos) cycle
                call assertEqual(one(k), all(lanes, k), 0.0_dp, shown(e(k)))
            end do
        end do
    end subroutine lanes_have_the_digits_of_one_state

    subroutine sum_and_product(terms)
        !! Of so many sines.
        integer, intent(in) :: terms
        type(expression_t) :: e(1), x
        type(formula_program_t) :: program
        type(hyperdual_t) :: found(1)
        real(dp) :: many(lanes, 1), results(1), all(lanes, 1), expected
        integer :: i

        x = symbol(1)
        e(1) = constant(0.0_dp)
        do i = 1, terms
            e(1) = e(1) + apply(f_sin, constant(real(i, dp))*x)
        end do
        do i = 1, terms
            e(1) = apply(f_sin, constant(real(i, dp))*x)*e(1)
        end do
        call new_formula_program(program, e, 1)
        call program%evaluate([0.5_dp], results)
        expected = sum(sin([(0.5_dp*i, i=1, terms)]))
        do i = 1, terms
            expected = expected*sin(0.5_dp*i)
        end do
        call assertEqual(expected, results(1), 1e-12_dp*abs(expected), "double")
        call program%evaluate([hyperdual_t(0.5_dp, 1.0_dp)], found)
        call assertEqual(expected, found(1)%re, 1e-12_dp*abs(expected), "hyper-dual")
        many = 0.5_dp
        call program%evaluate(many, all)
        call assertEqual(expected, all(lanes, 1), 1e-12_dp*abs(expected), "lanes")
    end subroutine sum_and_product

    subroutine powers_of_two_and_signs_meet()
        !! Fewer registers, and the same bits.
        call compare("a/2 (2 x)", "a x", 0)
        call compare("(2 a x) (y/4)", "0.5 ((a x) y)", 1)
        call compare("2 (3 a) x", "(6 a) x", 1)
        call compare("(4 a)/x", "4 (a/x)", 1)
        call compare("a/(4 x)", "(a/x)/4", 1)
        call compare("-(3 a) x", "((-3) a) x", 1)
        call compare("x - (-(5 a))", "x + 5 a", 1)
        call compare("a (3 x)", "a (3 x)", 1)
    contains
        subroutine compare(longer, shorter, numbers)
            !! A formula of one register beside the symbols and so many numbers.
            character(*), intent(in) :: longer, shorter
            integer, intent(in) :: numbers
            type(expression_t) :: e(1), f(1)
            type(formula_program_t) :: of_longer, of_shorter
            type(error_t), allocatable :: error
            real(dp) :: values(n), results(2)
            integer :: i, k

            call parse_formula(longer, few_symbols(), e(1), error)
            call parse_formula(shorter, few_symbols(), f(1), error)
            call new_formula_program(of_longer, e, n)
            call new_formula_program(of_shorter, f, n)
            call assertEqual(n + numbers + 1, of_longer%registers, "registers of "//longer)
            do i = 1, 20
                values = [(uniform(-2.0_dp, 2.0_dp), k=1, n)]
                call of_longer%evaluate(values, results(1:1))
                call of_shorter%evaluate(values, results(2:2))
                call assertEqual(results(2), results(1), 0.0_dp, longer)
            end do
        end subroutine compare
    end subroutine powers_of_two_and_signs_meet

    subroutine nothing_given_is_zero()
        !! An empty formula; no formulas.
        type(expression_t) :: e(1)
        type(formula_program_t) :: program
        real(dp) :: results(1), none(0)

        call new_formula_program(program, e, 0)
        call program%evaluate(none, results)
        call assertEqual(0.0_dp, results(1), 0.0_dp)
        call new_formula_program(program, e(:0), 2)
        call program%evaluate([1.0_dp, 2.0_dp], none)
        call assertEqual("0", shown(e(1)))
    end subroutine nothing_given_is_zero

    subroutine operators_build_formulas()
        !! In Fortran, as in text.
        type(expression_t) :: x, y

        x = symbol(3)
        y = symbol(4)
        call assertEqual("x^2/(x + y) - x sin(y)", &
                         shown(x**2/(x + y) - x*apply(f_sin, y)))
        call assertEqual("-(2.5 x)^y", shown(-(constant(2.5_dp)*x)**y))
        x = x*y
        call assertTrue(x%depends_on(3) .and. x%depends_on(4), "both are in it")
        call assertFalse(x%depends_on(1), "this is not")
    end subroutine operators_build_formulas
end module test_formula_program
