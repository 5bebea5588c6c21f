module test_formula_latex
    !! Formulas in LaTeX.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_latex, only: latex, latex_name
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_symbols, only: symbols_t
    implicit none (type, external)
    private
    public :: formula_latex_suite

contains

    function formula_latex_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("formula_latex")
        call suite%addTest(TestMethod("formulas_are_set", formulas_are_set))
        call suite%addTest(TestMethod("names_are_letters_with_indices", &
                                      names_are_letters_with_indices))
    end function formula_latex_suite

    subroutine formulas_are_set()
        !! Fractions, powers, functions, brackets.
        call is("m2 l x_dot theta_dot cos(theta)", "m_{2} \ell \dot{x} \dot{\theta} \cos \theta")
        call is("(m + m2)/2 x_dot^2 - m g l", "\frac{m + m_{2}}{2} \dot{x}^{2} - m g \ell")
        call is("g/l sin(theta)^2 cos(theta)", "\frac{g}{\ell} \sin^{2} \theta \cos \theta")
        call is("sin(theta) x", "\sin \theta \cdot x")
        call is("sin(theta - x)^2", "\sin^{2}\left(\theta - x\right)")
        call is("exp(-x) sqrt(g/l) |x| log(x) atan(x)", "\mathrm{e}^{-x} \sqrt{\frac{g}{\ell}} "// &
                "\left|x\right| \ln x \arctan x")
        call is("(x + l)^2/(2 m)", "\frac{\left(x + \ell\right)^{2}}{2 m}")
        call is("(g/l)^2 x", "\left(\frac{g}{\ell}\right)^{2} x")
        call is("sgn(x)^2 + sgn(x - 1)", "\operatorname{sgn}^{2}\left(x\right) + "// &
                "\operatorname{sgn}\left(x - 1\right)")
        call is("exp(x)^2 |x|^2", "\left(\mathrm{e}^{x}\right)^{2} \left(\left|x\right|\right)^{2}")
        call is("exp(x)^2 m", "\left(\mathrm{e}^{x}\right)^{2} m")
        call is("sqrt(x)^2 m", "\left(\sqrt{x}\right)^{2} m")
        call is("x*2 - (x - (m - g))", "x \cdot 2 - \left(x - \left(m - g\right)\right)")
        call is("-(x + m) + 1e-30 x + pi", "-\left(x + m\right) + 1 \cdot 10^{-30} x + \pi")
        call is("x^(m + 1)", "x^{m + 1}")
        call is("(x^2)^3", "\left(x^{2}\right)^{3}")
        call is("0.1 x", "0.1 x")
    contains
        subroutine is(text, expected)
            character(*), intent(in) :: text, expected
            type(symbols_t) :: symbols
            type(expression_t) :: e
            type(error_t), allocatable :: error

            call symbols%add("x")
            call symbols%add("theta")
            call symbols%add("x_dot")
            call symbols%add("theta_dot")
            call symbols%add("m")
            call symbols%add("m2")
            call symbols%add("l")
            call symbols%add("g")
            call parse_formula(text, symbols, e, error)
            call assertFalse(allocated(error), text)
            call assertEqual(expected, latex(e, symbols))
        end subroutine is
    end subroutine formulas_are_set

    subroutine names_are_letters_with_indices()
        !! Greek letters, dots, indices, words.
        call assertEqual("\dot{\theta}_{1}", latex_name("theta1_dot"))
        call assertEqual("\ddot{x}", latex_name("x_ddot"))
        call assertEqual("\ell_{0}", latex_name("l0"))
        call assertEqual("p_{\theta}", latex_name("p_theta"))
        call assertEqual("a_{s}", latex_name("a_s"))
        call assertEqual("\Omega", latex_name("Omega"))
        call assertEqual("\mathrm{mass}", latex_name("mass"))
        call assertEqual("x_{1,2}", latex_name("x_1_2"))
        call assertEqual("I_{\mathrm{roll}}", latex_name("I_roll"))
        call assertEqual("m_{12}", latex_name("m12"))
        call assertEqual("\omega_{\mathrm{long},\mathrm{name}}", latex_name("omega_long_name"))
        call assertEqual("x_{\phi,1}", latex_name("x_phi_1"))
    end subroutine names_are_letters_with_indices
end module test_formula_latex
