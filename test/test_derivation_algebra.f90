module test_derivation_algebra
    !! What derivations are made with: sums of products, their derivatives, their layout, LaTeX.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_algebra, only: algebra_t
    use lagrangia_aligned_latex, only: aligned_latex
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t, function_names
    use lagrangia_formula_latex, only: latex
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_formula_size, only: evaluate
    use lagrangia_formula_text, only: formula_text
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_page_layout, only: lay_out, role_coordinate, role_mass, role_parameter
    use lagrangia_parameter_sums, only: split
    use lagrangia_polynomial, only: operator(==), polynomial_t
    use lagrangia_symbols, only: symbols_t
    use lagrangia_trigonometry, only: shorten, tidy
    implicit none (type, external)
    private
    public :: derivation_algebra_suite

contains

    function derivation_algebra_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("derivation_algebra")
        call suite%addTest(TestMethod("derivatives_are_those_of_hyperdual_numbers", &
                                      derivatives_are_exact))
        call suite%addTest(TestMethod("what_is_laid_out_keeps_its_value", layout_keeps_values))
        call suite%addTest(TestMethod("sines_and_cosines_are_joined", sines_are_joined))
        call suite%addTest(TestMethod("roots_are_squared", roots_are_squared))
        call suite%addTest(TestMethod("long_formulas_are_broken", long_formulas_are_broken))
        call suite%addTest(TestMethod("products_of_sums_are_recognised", &
                                      products_of_sums_are_recognised))
    end function derivation_algebra_suite

    subroutine three_names(symbols, algebra, roles)
        !! m, l and x.
        type(symbols_t), intent(out) :: symbols
        type(algebra_t), intent(out) :: algebra
        integer, intent(out) :: roles(3)

        call symbols%add("m")
        call symbols%add("l")
        call symbols%add("x")
        call algebra%begin(3)
        roles = [role_mass, role_parameter, role_coordinate]
    end subroutine three_names

    subroutine derivatives_are_exact()
        !! Of every function, and of sums and powers.
        character(40) :: texts(size(function_names) + 8)
        type(symbols_t) :: symbols
        type(algebra_t) :: algebra
        type(expression_t) :: e(1)
        type(polynomial_t) :: p, derivative
        type(formula_program_t) :: program
        type(error_t), allocatable :: error
        type(hyperdual_t) :: exact(1)
        real(dp), parameter :: at(3) = [0.7_dp, 1.9_dp, 0.37_dp]
        real(dp) :: found(1)
        integer :: i, roles(3)

        do i = 1, size(function_names)
            texts(i) = trim(function_names(i))//"(m x + l x^2)"
        end do
        texts(i:) = [character(40) :: "(m + l x)^3/(l + x)", "x^(1/2) (l - x)^(3/2)", "l^x", &
                     "(x - l)^2/x^3", "sin(x)/(m cos(x) + l)", "1/(1 + x^2)^2", &
                     "sin(l - x) cos(x - l)", "exp(x)^2 log(x) + 3 m"]
        do i = 1, size(texts)
            call three_names(symbols, algebra, roles)
            call parse_formula(trim(texts(i)), symbols, e(1), error)
            call assertFalse(allocated(error), message=texts(i))
            if (allocated(error)) cycle
            call new_formula_program(program, e, 3)
            call program%evaluate([hyperdual_t(re=at(1)), hyperdual_t(re=at(2)), &
                                   hyperdual_t(at(3), 1.0_dp, 0.0_dp, 0.0_dp)], exact)
            call algebra%from_expression(e(1), p)
            call algebra%derivative(p, 3, derivative)
            call lay_out(algebra, roles, derivative, e(1))
            call new_formula_program(program, e, 3)
            call program%evaluate(at, found)
            call assertEqual(exact(1)%d1, found(1), tolerance=1e-13_dp*max(1.0_dp, abs(found(1))), &
                             message="d/dx "//texts(i))
        end do
    end subroutine derivatives_are_exact

    subroutine layout_keeps_values()
        !! Also with fractions, signs and brackets in all places.
        character(60), parameter :: texts(*) = [character(60) :: &
            "m/2 x^2 - 3/4 l x", "-(m - l)/3 x", "x/(2 l) - m/(3 x l^2)", "0.1 x + 0.2 m", &
            "(m + 1)/(2 l) sin(x)^2/x", "-1/2", "x - x", "2/3/m", "-l^2 (m - 2)^2 x^3/5", &
            "(m + l)^(-2) x + sqrt(m + l)^3", "cos(2 x - l) sin(l - 2 x)", "1/m + 1/l"]
        type(symbols_t) :: symbols
        type(algebra_t) :: algebra
        type(expression_t) :: pair(2)
        type(polynomial_t) :: p
        type(formula_program_t) :: program
        type(error_t), allocatable :: error
        real(dp) :: results(2)
        integer :: i, roles(3)

        do i = 1, size(texts)
            call three_names(symbols, algebra, roles)
            call parse_formula(trim(texts(i)), symbols, pair(1), error)
            call assertFalse(allocated(error), message=texts(i))
            call algebra%from_expression(pair(1), p)
            call shorten(algebra, p)
            call lay_out(algebra, roles, p, pair(2))
            call new_formula_program(program, pair, 3)
            call program%evaluate([0.7_dp, 1.9_dp, 0.37_dp], results)
            call assertEqual(results(1), results(2), &
                             tolerance=1e-14_dp*max(1.0_dp, abs(results(1))), &
                             message=trim(texts(i))//" as "//formula_text(pair(2), symbols))
        end do
    end subroutine layout_keeps_values

    subroutine sines_are_joined()
        call joined("m sin(x)^2 + m cos(x)^2", "m")
        call joined("m sin(x)^2 + l^2 + l sin(x) + l cos(x) + m cos(x)^2", &
                    "l sin(x) + l cos(x) + m + l^2")
        call joined("cos(l) cos(x) + sin(l) sin(x)", "cos(l - x)")
        call joined("cos(l) cos(x) - sin(l) sin(x)", "cos(l + x)")
        call joined("sin(l) cos(x) - cos(l) sin(x)", "sin(l - x)")
        call joined("sin(l) cos(x) + cos(l) sin(x)", "sin(l + x)")
        call joined("2 sin(x)^2 + cos(x)^2", "2 sin(x)^2 + cos(x)^2")
        call shortened("m + l - m cos(x)^2", "m sin(x)^2 + l")
    contains
        subroutine joined(text, expected)
            character(*), intent(in) :: text, expected

            call compare(text, expected, .false.)
        end subroutine joined

        subroutine shortened(text, expected)
            character(*), intent(in) :: text, expected

            call compare(text, expected, .true.)
        end subroutine shortened

        subroutine compare(text, expected, both_ways)
            character(*), intent(in) :: text, expected
            logical, intent(in) :: both_ways
            type(symbols_t) :: symbols
            type(algebra_t) :: algebra
            type(expression_t) :: e
            type(polynomial_t) :: p, q
            type(error_t), allocatable :: error
            integer :: roles(3)

            call three_names(symbols, algebra, roles)
            call parse_formula(text, symbols, e, error)
            call algebra%from_expression(e, p)
            if (both_ways) call shorten(algebra, p)
            if (.not. both_ways) call tidy(algebra, p)
            call parse_formula(expected, symbols, e, error)
            call algebra%from_expression(e, q)
            call lay_out(algebra, roles, p, e)
            call assertTrue(p == q, message=text//" is "//expected//", not "// &
                            formula_text(e, symbols))
        end subroutine compare

    end subroutine sines_are_joined

    subroutine roots_are_squared()
        !! What is printed, and that it is the same number where the root is one.
        call squared("sqrt(l^2 - x^2)^2", "l^2 - x^2")
        call squared("sqrt(l^2 - x^2)^3", "l^2 sqrt(l^2 - x^2) - x^2 sqrt(l^2 - x^2)")
        call squared("m x/sqrt(l^2 - x^2)^2", "m x/(l^2 - x^2)")
        call squared("m/sqrt(l^2 - x^2)^3", "m/((l^2 - x^2) sqrt(l^2 - x^2))")
        call squared("m/sqrt(l - x) + x sqrt(l - x)", "m/sqrt(l - x) + x sqrt(l - x)")
        call squared("sqrt(l x)^2/sqrt(m)^4", "l x/m^2")
        call squared("sqrt(l + sqrt(m)^2)^4", "(l + m)^2")
        call squared("sqrt(x^2)", "sqrt(x^2)")
        call squared("(l^2 - x^2)^(1/2)", "sqrt(l^2 - x^2)")
        call squared("(l^2 - x^2)^(1/3)", "(l^2 - x^2)^(1/3)")
        call squared("m*1^(3/2)", "m")
        call squared("x (l + x)^(-1/2)", "x/sqrt(l + x)")
        call squared("x (l + x)^(-3/2)", "x/((l + x) sqrt(l + x))")
        call squared("x (l + x)^(-1/3)", "x (l + x)^(-1/3)")
    contains
        subroutine squared(text, expected)
            character(*), intent(in) :: text, expected
            type(symbols_t) :: symbols
            type(algebra_t) :: algebra
            type(expression_t) :: e
            type(polynomial_t) :: p, q
            type(error_t), allocatable :: error
            real(dp), parameter :: at(3) = [0.7_dp, 1.9_dp, 0.37_dp]
            real(dp) :: noise, was, is
            integer :: roles(3)

            call three_names(symbols, algebra, roles)
            call parse_formula(text, symbols, e, error)
            call evaluate(e, at, was, noise)
            call algebra%from_expression(e, p)
            call tidy(algebra, p)
            call lay_out(algebra, roles, p, e)
            call evaluate(e, at, is, noise)
            call assertEqual(was, is, 1e-14_dp*abs(was), message=text)
            call assertTrue(index(formula_text(e, symbols), "sqrt") > 0 .eqv. &
                            index(expected, "sqrt") > 0, message=formula_text(e, symbols))
            call assertTrue(index(formula_text(e, symbols), ")^") == 0 .or. &
                            index(expected, ")^") > 0, message=formula_text(e, symbols))
            call parse_formula(expected, symbols, e, error)
            call algebra%from_expression(e, q)
            call evaluate(e, at, is, noise)
            call assertEqual(was, is, 1e-14_dp*abs(was), message=expected)
        end subroutine squared
    end subroutine roots_are_squared

    subroutine long_formulas_are_broken()
        type(symbols_t) :: symbols
        type(algebra_t) :: algebra
        type(expression_t) :: e
        type(error_t), allocatable :: error
        character(:), allocatable :: text
        integer :: roles(3)

        call three_names(symbols, algebra, roles)
        call parse_formula("x^2 - m (l + x)", symbols, e, error)
        call assertEqual(latex(e, symbols), aligned_latex(e, symbols), message="short")
        call parse_formula("m sin(l + 2 x)^2 cos(l - 2 x)/(l + x) "// &
                           "- m cos(l + 2 x)^2 sin(l - 2 x)/(l + x) - (m^2 l + x)", symbols, e, &
                           error)
        text = aligned_latex(e, symbols)
        call assertTrue(index(text, " \\"//new_line("a")//"    & \quad{} - \frac{m") > 0, &
                        message=text)
        call assertTrue(index(text, " - \left(m^{2} \ell + x\right)") > 0, message=text)
    end subroutine long_formulas_are_broken

    subroutine products_of_sums_are_recognised()
        !! A sum without masses times a sum of masses, and what only looks like one.
        call try("a m + b m + a M + b M", "a + b", "m + M")
        call try("a m + 2 b m + a M + 2 b M", "a + 2 b", "m + M")
        call try("2 a m - 2 b m + 6 a M - 6 b M", "2 a - 2 b", "m + 3 M")
        call try("a m + b m + a M", "", "")
        call try("a m + b m + a M + 2 b M", "", "")
        call try("a m + b m + a M + b M + a b", "", "")
        call try("a m + a M", "", "")
        call try("a m + b m", "", "")
    contains
        subroutine try(text, without, masses)
            !! The factors of `text`, whichever names come first; empty ones where it is no product.
            character(*), intent(in) :: text, without, masses

            call try_order(text, without, masses, "abmM", &
                           [role_parameter, role_parameter, role_mass, role_mass])
            call try_order(text, without, masses, "mMab", &
                           [role_mass, role_mass, role_parameter, role_parameter])
        end subroutine try

        subroutine try_order(text, without, masses, names, roles)
            character(*), intent(in) :: text, without, masses, names
            integer, intent(in) :: roles(:)
            type(symbols_t) :: symbols
            type(algebra_t) :: algebra
            type(expression_t) :: e
            type(polynomial_t) :: p, factors(2), expected
            type(error_t), allocatable :: error
            logical :: product
            integer :: i

            do i = 1, len(names)
                call symbols%add(names(i:i))
            end do
            call algebra%begin(len(names))
            call parse_formula(text, symbols, e, error)
            call algebra%from_expression(e, p)
            call split(roles, p, factors, product)
            call assertTrue(product .eqv. without /= "", text//" of "//names)
            if (.not. product .or. without == "") return
            call parse_formula(without, symbols, e, error)
            call algebra%from_expression(e, expected)
            call assertTrue(factors(1) == expected, text//": without masses")
            call parse_formula(masses, symbols, e, error)
            call algebra%from_expression(e, expected)
            call assertTrue(factors(2) == expected, text//": masses")
        end subroutine try_order
    end subroutine products_of_sums_are_recognised
end module test_derivation_algebra
