module test_hyperdual
    !! Hyper-dual arithmetic gives the derivatives of analysis.
    !!
    !! The expected numbers are those of mpmath at 60 digits: \(f(x(s, t), y(s, t))\) with
    !! \(x = x_0 + x_1 s + x_2 t + x_{12} st\), differentiated there by \(s\), by \(t\) and by both.
    !! Each result is a handful of rounded operations on terms of the size of the largest number
    !! expected, or a few times that: 32 epsilon of it.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertRelativelyEqual, &
                     assertTrue
    use lagrangia_hyperdual, only: abs, assignment(=), atan, cos, cosh, dot_product, exp, &
                                   hyperdual, hyperdual_t, log, operator(*), operator(**), &
                                   operator(+), operator(-), operator(/), operator(<), &
                                   operator(>), sin, sinh, sqrt, sum, tan, tanh
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: hyperdual_suite

    type(hyperdual_t), parameter :: x = hyperdual_t(1.37_dp, 0.6_dp, -1.9_dp, 2.3_dp)
    type(hyperdual_t), parameter :: y = hyperdual_t(0.83_dp, -1.1_dp, 0.7_dp, -0.4_dp)
    type(hyperdual_t), parameter :: z = hyperdual_t(-1.37_dp, 0.6_dp, -1.9_dp, 2.3_dp)
    real(dp), parameter :: c = 2.7_dp
    integer, parameter :: n = 3

contains

    function hyperdual_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("hyperdual")
        call suite%addTest(TestMethod("operators", operators))
        call suite%addTest(TestMethod("powers", powers))
        call suite%addTest(TestMethod("an_exponent_varies_along_each_direction", &
                                      an_exponent_varies_along_each_direction))
        call suite%addTest(TestMethod("functions", functions))
        call suite%addTest(TestMethod("functions_of_negative_values", functions_of_negative_values))
        call suite%addTest(TestMethod("array_reductions", array_reductions))
        call suite%addTest(TestMethod("powers_of_zero", powers_of_zero))
        call suite%addTest(TestMethod("no_cancellation_in_tails", no_cancellation_in_tails))
        call suite%addTest(TestMethod("assignment_makes_a_constant", assignment_makes_a_constant))
        call suite%addTest(TestMethod("comparisons_see_the_value", comparisons_see_the_value))
        call suite%addTest(TestMethod("second_derivative_of_the_lagrangian", &
                                      second_derivative_of_the_lagrangian))
        call suite%addTest(TestMethod("whole_exponents_beyond_the_integers", &
                                      whole_exponents_beyond_the_integers))
    end function hyperdual_suite

    subroutine operators()
        !! Every operator and every mixture of kinds.
        call check("x + y", x + y, [2.2_dp, -0.5_dp, -1.2_dp, 1.9_dp])
        call check("x + c", x + c, [4.07_dp, 0.6_dp, -1.9_dp, 2.3_dp])
        call check("c + x", c + x, [4.07_dp, 0.6_dp, -1.9_dp, 2.3_dp])
        call check("x + n", x + n, [4.37_dp, 0.6_dp, -1.9_dp, 2.3_dp])
        call check("n + x", n + x, [4.37_dp, 0.6_dp, -1.9_dp, 2.3_dp])
        call check("x - y", x - y, [0.54_dp, 1.7_dp, -2.6_dp, 2.7_dp])
        call check("x - c", x - c, [-1.33_dp, 0.6_dp, -1.9_dp, 2.3_dp])
        call check("c - x", c - x, [1.33_dp, -0.6_dp, 1.9_dp, -2.3_dp])
        call check("x - n", x - n, [-1.63_dp, 0.6_dp, -1.9_dp, 2.3_dp])
        call check("n - x", n - x, [1.63_dp, -0.6_dp, 1.9_dp, -2.3_dp])
        call check("x*y", x*y, [1.1371_dp, -1.009_dp, -0.618_dp, 3.871_dp])
        call check("x*c", x*c, [3.699_dp, 1.62_dp, -5.13_dp, 6.21_dp])
        call check("c*x", c*x, [3.699_dp, 1.62_dp, -5.13_dp, 6.21_dp])
        call check("x*n", x*n, [4.11_dp, 1.8_dp, -5.7_dp, 6.9_dp])
        call check("n*x", n*x, [4.11_dp, 1.8_dp, -5.7_dp, 6.9_dp])
        call check("x/y", x/y, &
                   [1.6506024096385542_dp, 2.9104369284366381_dp, &
                    -3.6812309478879373_dp, -3.766769793646935_dp])
        call check("x/c", x/c, &
                   [0.50740740740740741_dp, 0.22222222222222222_dp, &
                    -0.7037037037037037_dp, 0.85185185185185185_dp])
        call check("c/x", c/x, &
                   [1.9708029197080292_dp, -0.86312536629548724_dp, &
                    2.7332303266023763_dp, -5.7027175965338092_dp])
        call check("x/n", x/n, &
                   [0.45666666666666667_dp, 0.2_dp, &
                    -0.63333333333333333_dp, 0.76666666666666667_dp])
        call check("n/x", n/x, &
                   [2.1897810218978102_dp, -0.9590281847727636_dp, &
                    3.0369225851137514_dp, -6.3363528850375658_dp])
        call check("-x", -x, [-1.37_dp, -0.6_dp, 1.9_dp, -2.3_dp])
        call check("+x", +x, [1.37_dp, 0.6_dp, -1.9_dp, 2.3_dp])
    end subroutine operators

    subroutine powers()
        !! Integer, real and hyper-dual exponents; whole ones allow a negative base.
        call check("x**y", x**y, &
                   [1.2986079902778891_dp, 0.022351427511515184_dp, &
                    -1.2086500028584772_dp, 4.6590584443451629_dp])
        call check("x**c", x**c, &
                   [2.3396211102624212_dp, 2.7665592690694324_dp, &
                    -8.7607710187198693_dp, 4.0825260260112184_dp])
        call check("c**x", c**x, &
                   [3.8991357617366573_dp, 2.3236941051316421_dp, &
                    -7.3583646662501998_dp, 4.5222688189457546_dp])
        call check("x**n", x**n, [2.571353_dp, 3.37842_dp, -10.69833_dp, 3.57981_dp])
        call check("n**x", n**x, &
                   [4.5045988224534314_dp, 2.9692845731203417_dp, &
                    -9.4027344815477488_dp, 5.1842817411876088_dp])
        call check("z**3", z**3, [-2.571353_dp, 3.37842_dp, -10.69833_dp, 22.32141_dp])
        call check("z**(-2)", z**(-2), &
                   [0.53279343598486867_dp, 0.4666803818845565_dp, &
                    -1.4778212093010956_dp, -0.15272143884056654_dp])
        call check("z**(-3.0_dp)", z**(-3.0_dp), &
                   [-0.38890031823713041_dp, -0.51096392177141222_dp, &
                    1.6180524189428054_dp, 0.87584935009235988_dp])
        call check("z**2.0_dp", z**2.0_dp, [1.8769_dp, -1.644_dp, 5.206_dp, -8.582_dp])
        call check("x**(-1.7_dp)", x**(-1.7_dp), &
                   [0.58556489937224722_dp, -0.43596802726984829_dp, &
                    1.3805654196878529_dp, -3.3037041871823419_dp])
        call check("x**0.5_dp", x**0.5_dp, &
                   [1.1704699910719625_dp, 0.25630729731502829_dp, &
                    -0.81163977483092291_dp, 1.1602426439284918_dp])
        call check("z**hyperdual(5.0_dp)", z**hyperdual(5.0_dp), &
                   [-4.8261724457_dp, 10.56826083_dp, -33.466159295_dp, 99.138514915_dp])
    end subroutine powers

    subroutine an_exponent_varies_along_each_direction()
        !! \(2.7^e\): derivatives \(2.7^e \ln 2.7\), wherever the exponent has its only one.
        real(dp), parameter :: value = c**0.83_dp, slope = value*log(c)

        call check("d1", c**hyperdual_t(0.83_dp, d1=1.9_dp), [value, 1.9_dp*slope, 0.0_dp, 0.0_dp])
        call check("d2", c**hyperdual_t(0.83_dp, d2=1.9_dp), [value, 0.0_dp, 1.9_dp*slope, 0.0_dp])
        call check("d12", c**hyperdual_t(0.83_dp, d12=1.9_dp), &
                   [value, 0.0_dp, 0.0_dp, 1.9_dp*slope])
    end subroutine an_exponent_varies_along_each_direction

    subroutine functions()
        !! Every function, where it is none of its special values.
        call check("sin(x)", sin(x), &
                   [0.97990806139861422_dp, 0.11966983259854378_dp, &
                    -0.37895446989538863_dp, 1.575829548288838_dp])
        call check("cos(x)", cos(x), &
                   [0.19944972099757297_dp, -0.58794483683916853_dp, &
                    1.861825316657367_dp, -2.0264158592795795_dp])
        call check("tan(x)", tan(x), &
                   [4.913058070462472_dp, 15.082883762241857_dp, &
                    -47.762465247099214_dp, -223.77399732833918_dp])
        call check("exp(x)", exp(x), &
                   [3.9353506954704729_dp, 2.3612104172822837_dp, &
                    -7.4771663213938985_dp, 4.5650068067457486_dp])
        call check("log(x)", log(x), &
                   [0.31481073984003355_dp, 0.43795620437956204_dp, &
                    -1.3868613138686131_dp, 2.2862166338110714_dp])
        call check("sqrt(x)", sqrt(x), &
                   [1.1704699910719625_dp, 0.25630729731502829_dp, &
                    -0.81163977483092291_dp, 1.1602426439284918_dp])
        call check("sinh(x)", sinh(x), &
                   [1.8406218679588363_dp, 1.256837296506982_dp, &
                    -3.9799847722721095_dp, 2.7195673738036908_dp])
        call check("cosh(x)", cosh(x), &
                   [2.0947288275116366_dp, 1.1043731207753018_dp, &
                    -3.497181549121789_dp, 1.8454394329420578_dp])
        call check("tanh(x)", tanh(x), &
                   [0.87869219336869574_dp, 0.13674001758774637_dp, &
                    -0.43301005569453016_dp, 0.98074913412640777_dp])
        call check("atan(x)", atan(x), &
                   [0.94026618862754487_dp, 0.20855782265633147_dp, &
                    -0.66043310507838298_dp, 1.1768751172264805_dp])
        call check("abs(x)", abs(x), [1.37_dp, 0.6_dp, -1.9_dp, 2.3_dp])
    end subroutine functions

    subroutine functions_of_negative_values()
        !! Odd functions and `abs` left of zero.
        call check("abs(z)", abs(z), [1.37_dp, -0.6_dp, 1.9_dp, -2.3_dp])
        call check("atan(z)", atan(z), &
                   [-0.94026618862754487_dp, 0.20855782265633147_dp, &
                    -0.66043310507838298_dp, 0.42206818980539413_dp])
        call check("sinh(z)", sinh(z), &
                   [-1.8406218679588363_dp, 1.256837296506982_dp, &
                    -3.9799847722721095_dp, 6.9161852327498376_dp])
        call check("tanh(z)", tanh(z), &
                   [-0.87869219336869574_dp, 0.13674001758774637_dp, &
                    -0.43301005569453016_dp, 0.067591000712981034_dp])
        call check("tan(z)", tan(z), &
                   [-4.913058070462472_dp, 15.082883762241857_dp, &
                    -47.762465247099214_dp, 339.40943950552676_dp])
    end subroutine functions_of_negative_values

    subroutine array_reductions()
        !! `sum` and the three mixtures of `dot_product`.
        call check("sum([x, y, z])", sum([x, y, z]), [0.83_dp, 0.1_dp, -3.1_dp, 4.2_dp])
        call check("dot_product([x, y], [y, z])", dot_product([x, y], [y, z]), &
                   [0.0_dp, 0.996_dp, -3.154_dp, 8.838_dp])
        call check("dot_product([x, y], [c, 1.9_dp])", dot_product([x, y], [c, 1.9_dp]), &
                   [5.276_dp, -0.47_dp, -3.8_dp, 5.45_dp])
        call check("dot_product([c, 1.9_dp], [x, y])", dot_product([c, 1.9_dp], [x, y]), &
                   [5.276_dp, -0.47_dp, -3.8_dp, 5.45_dp])
    end subroutine array_reductions

    subroutine powers_of_zero()
        !! At 0: \(x^0\), \(x\), \(x^2\), \(x^3\) and their derivatives exactly, without NaN.
        type(hyperdual_t) :: zero

        zero = hyperdual_t(0.0_dp, 0.6_dp, -1.9_dp, 2.3_dp)
        call check("0**0", zero**0, [1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp])
        call check("0**1", zero**1, [0.0_dp, 0.6_dp, -1.9_dp, 2.3_dp])
        call check("0**2", zero**2, [0.0_dp, 0.0_dp, 0.0_dp, -2.28_dp])
        call check("0**3", zero**3, [0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp])
        call check("0**1.0", zero**1.0_dp, [0.0_dp, 0.6_dp, -1.9_dp, 2.3_dp])
        call check("0**2.0", zero**2.0_dp, [0.0_dp, 0.0_dp, 0.0_dp, -2.28_dp])
        call check("0**2.5", zero**2.5_dp, [0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp])
        call check("0**hyperdual(2)", zero**hyperdual(2.0_dp), [0.0_dp, 0.0_dp, 0.0_dp, -2.28_dp])
    end subroutine powers_of_zero

    subroutine no_cancellation_in_tails()
        !! At 20, \(1 - \tanh^2\) has no digit left; mpmath's derivatives, to 41 epsilon: `cosh`
        !! is right to 1 and its argument is exact. At 400 the square of `cosh` overflows.
        type(hyperdual_t) :: t

        t = tanh(hyperdual_t(20.0_dp, d1=1.0_dp, d2=1.0_dp))
        call assertRelativelyEqual(1.6993417021166356e-17_dp, t%d1, 41.0_dp*epsilon(1.0_dp))
        call assertRelativelyEqual(-3.3986834042332711e-17_dp, t%d12, 41.0_dp*epsilon(1.0_dp))
        t = tanh(hyperdual_t(400.0_dp, d1=1.0_dp, d2=1.0_dp))
        call assertEqual(0.0_dp, t%d1, tolerance=tiny(1.0_dp))
        call assertEqual(0.0_dp, t%d12, tolerance=tiny(1.0_dp))
    end subroutine no_cancellation_in_tails

    subroutine assignment_makes_a_constant()
        !! Real and integer; what the variable held before is gone, elementwise too.
        type(hyperdual_t) :: u, several(2)

        u = x
        u = c
        call check("u = c", u, [2.7_dp, 0.0_dp, 0.0_dp, 0.0_dp])
        u = x
        u = n
        call check("u = n", u, [3.0_dp, 0.0_dp, 0.0_dp, 0.0_dp])
        several = x
        several = [0.4_dp, -0.9_dp]
        call check("several(1)", several(1), [0.4_dp, 0.0_dp, 0.0_dp, 0.0_dp])
        call check("several(2)", several(2), [-0.9_dp, 0.0_dp, 0.0_dp, 0.0_dp])
        call check("hyperdual(c)", hyperdual(c), [2.7_dp, 0.0_dp, 0.0_dp, 0.0_dp])
    end subroutine assignment_makes_a_constant

    subroutine comparisons_see_the_value()
        !! Derivatives play no part.
        call assertTrue(y < x, "y < x")
        call assertFalse(x < y, "not x < y")
        call assertFalse(x < x, "not x < x")
        call assertTrue(x > y, "x > y")
        call assertFalse(y > x, "not y > x")
        call assertFalse(x > x, "not x > x")
        call assertTrue(x < 1.4_dp, "x < 1.4")
        call assertFalse(x < 1.3_dp, "not x < 1.3")
        call assertTrue(x > 1.3_dp, "x > 1.3")
        call assertFalse(x > 1.4_dp, "not x > 1.4")
    end subroutine comparisons_see_the_value

    subroutine second_derivative_of_the_lagrangian()
        !! The mass matrix of the cart-pendulum and \(\partial^2 L/\partial\theta\partial\dot x\).
        real(dp), parameter :: m1 = 1.3_dp, m2 = 0.7_dp, l = 0.9_dp, q = 0.8_dp
        real(dp), parameter :: vx = -0.45_dp, w = 1.6_dp, eps = epsilon(1.0_dp)
        type(hyperdual_t) :: lagrangian

        lagrangian = energy_of_motion(hyperdual(q), hyperdual_t(vx, d1=1.0_dp), &
                                      hyperdual_t(w, d2=1.0_dp))
        call assertEqual(m2*l*cos(q), lagrangian%d12, tolerance=32.0_dp*eps)
        lagrangian = energy_of_motion(hyperdual(q), hyperdual(vx), &
                                      hyperdual_t(w, d1=1.0_dp, d2=1.0_dp))
        call assertEqual(m2*l**2, lagrangian%d12, tolerance=32.0_dp*eps)
        lagrangian = energy_of_motion(hyperdual_t(q, d1=1.0_dp), hyperdual_t(vx, d2=1.0_dp), &
                                      hyperdual(w))
        call assertEqual(-m2*l*w*sin(q), lagrangian%d12, tolerance=32.0_dp*eps)
    contains
        pure function energy_of_motion(theta, v, omega) result(energy)
            type(hyperdual_t), intent(in) :: theta, v, omega
            type(hyperdual_t) :: energy

            energy = (m1 + m2)/2*v**2 + m2*l**2/2*omega**2 + m2*l*v*omega*cos(theta)
        end function energy_of_motion
    end subroutine second_derivative_of_the_lagrangian

    subroutine check(expression, actual, expected)
        !! All four parts, to 32 epsilon of the largest.
        character(*), intent(in) :: expression
        type(hyperdual_t), intent(in) :: actual
        real(dp), intent(in) :: expected(4)

        call assertEqual(expected, [actual%re, actual%d1, actual%d2, actual%d12], &
                         tolerance=32.0_dp*epsilon(1.0_dp)*maxval(abs(expected)), &
                         message=expression)
    end subroutine check

    subroutine whole_exponents_beyond_the_integers()
        !! \((1 + 10^{-10})^{3\cdot 10^9} = e^{0.3}\) but for the rounding of the base, 8e-8 of it
        !! to this power: 3e9 is whole, but no default integer.
        type(hyperdual_t) :: power

        power = hyperdual_t(1.0_dp + 1e-10_dp, 1.0_dp, 0.0_dp, 0.0_dp)**3e9_dp
        call assertEqual(exp(0.3_dp), power%re, tolerance=1e-6_dp, message="value")
        call assertEqual(3e9_dp*exp(0.3_dp), power%d1, tolerance=3e3_dp, message="slope")
    end subroutine whole_exponents_beyond_the_integers
end module test_hyperdual
