module test_plot_label
    !! Names and units as a picture shows them.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_plot_label, only: is_small, label, labels
    use lagrangia_plot_symbol, only: symbol
    use lagrangia_plot_words, only: text_label, unicode_text, with_symbols
    implicit none (type, external)
    private
    public :: plot_label_suite

    character(*), parameter :: theta = char(206)//char(184), phi = char(207)//char(134)
    character(*), parameter :: dot = char(204)//char(135), ddot = char(204)//char(136)

contains

    function plot_label_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("plot_label")
        call suite%addTest(TestMethod("letters_dots_and_indices", letters_dots_and_indices))
        call suite%addTest(TestMethod("words_stay_words", words_stay_words))
        call suite%addTest(TestMethod("units_have_powers", units_have_powers))
        call suite%addTest(TestMethod("odd_texts_are_not_read", odd_texts_are_not_read))
        call suite%addTest(TestMethod("an_axis_of_several", an_axis_of_several))
        call suite%addTest(TestMethod("small_ones", small_ones))
        call suite%addTest(TestMethod("words_of_a_title", words_of_a_title))
        call suite%addTest(TestMethod("titles_without_symbols", titles_without_symbols))
        call suite%addTest(TestMethod("titles_of_pages", titles_of_pages))
    end function plot_label_suite

    subroutine letters_dots_and_indices()
        !! As on the blackboard; every Greek letter, by its number in Unicode.
        character(*), parameter :: last(*) = [character(7) :: "pi", "rho", "sigma", "omega"]
        integer, parameter :: second(*) = [128, 129, 131, 137]
        integer :: i

        call assertEqual("x", symbol("x"))
        call assertEqual(theta, symbol("theta"))
        call assertEqual(theta//dot, symbol("theta_dot"))
        call assertEqual(theta//ddot, symbol("theta_ddot"))
        call assertEqual(theta//"_{1}", symbol("theta1"))
        call assertEqual(theta//dot//"_{10}", symbol("theta10_dot"))
        call assertEqual("q"//dot//"_{1}", symbol("q1_dot"))
        call assertEqual("x_{bob}", symbol("x_bob"))
        call assertEqual("x_{bob10}", symbol("x_bob10"))
        call assertEqual("p_{"//phi//"}", symbol("p_phi"))
        call assertEqual("p_{"//phi//"1}", symbol("p_phi1"))
        call assertEqual("p_{x} drift", symbol("p_x_drift"))
        call assertEqual("r_{a,b}", symbol("r_a_b"))
        call assertEqual(char(206)//char(169), symbol("Omega"))
        call assertEqual(char(206)//char(177), symbol("alpha"))
        do i = 1, size(last)
            call assertEqual(char(207)//char(second(i)), symbol(trim(last(i))), last(i))
        end do
    end subroutine letters_dots_and_indices

    subroutine words_stay_words()
        !! With blanks; a letter or a number behind a word is its index.
        call assertEqual("energy drift", symbol("energy_drift"))
        call assertEqual("contact force", symbol("contact_force"))
        call assertEqual("tension_{1}", symbol("tension1"))
        call assertEqual("friction_{x}", symbol("friction_x"))
        call assertEqual("slip_{x} drift", symbol("slip_x_drift"))
        call assertEqual("energy support drift", symbol("energy_support_drift"))
        call assertEqual("length dot", symbol("length_dot"))
        call assertEqual("pendulum 0.45 periods", symbol("pendulum_0.45_periods"))
        call assertEqual("oscillator wT 2", symbol("oscillator_wT_2"))
        call assertEqual("slip_{x} of 2", symbol("slip_x_of_2"))
        call assertEqual("thetas", symbol("thetas"))
        call assertEqual("rope length ddot", symbol("rope_length_ddot"))
        call assertEqual("", symbol(""))
    end subroutine words_stay_words

    subroutine units_have_powers()
        !! Behind the name, in parentheses; a pure number has none.
        call assertEqual("""x (m)""", label("x", "m"))
        call assertEqual("""x"//ddot//" (m/s^{2})""", label("x_ddot", "m/s^2"))
        call assertEqual("""w (s^{-1} m)""", label("w", "s^-1 m"))
        call assertEqual("""energy drift""", label("energy_drift", "1"))
        call assertEqual("""x""", label("x", ""))
        call assertEqual("""w (m^{})""", label("w", "m^"))
        call assertEqual("""x (m^{1/2} s)""", label("x", "m^(1/2) s"))
        call assertEqual("""w (m^{}()""", label("w", "m^("))
        call assertEqual("""p_{1}""", label("p_1", "?"), "a unit that is not known")
    end subroutine units_have_powers

    subroutine odd_texts_are_not_read()
        !! What is no name, or no unit, is shown as it is.
        call assertEqual("""a{b} (m)"" noenhanced", label("a{b}", "m"))
        call assertEqual("""x (m&)"" noenhanced", label("x", "m&"))
        call assertEqual("""x (\"")"" noenhanced", label("x", """"))
        call assertEqual("""1x"" noenhanced", label("1x", "1"))
        call assertEqual("""a b"" noenhanced", label("a b", "1"))
        call assertEqual("""\140rm\140 (\100)"" noenhanced", label("`rm`", "@"))
    end subroutine odd_texts_are_not_read

    subroutine an_axis_of_several()
        !! Three names at most, that are not too long, and a common unit once.
        call assertEqual("""x, y (m)""", labels(["x", "y"], ["m", "m"]))
        call assertEqual("""x (m), "//theta//" (rad)""", &
                         labels([character(5) :: "x", "theta"], [character(3) :: "m", "rad"]))
        call assertEqual("""a{ (m)"" noenhanced", labels(["a{"], ["m"]))
        call assertEqual("""(m)""", labels(["x", "y", "z", "u"], ["m", "m", "m", "m"]))
        call assertEqual("""(J)""", labels([character(17) :: "energy", "mechanical_energy"], &
                                           ["J", "J"]))
        call assertEqual("""""", labels(["x", "y", "z", "u"], ["m", "m", "m", "s"]))
        call assertEqual("""(m&)"" noenhanced", labels(["x", "y"], ["m&", "m&"]))
        call assertEqual(""""" noenhanced", labels(["x", "y"], ["m&", "m "]))
    end subroutine an_axis_of_several

    subroutine small_ones()
        !! Drifts and errors.
        call assertTrue(is_small("p_x_drift"), "a drift")
        call assertTrue(is_small("error"), "an error")
        call assertFalse(is_small("energy"), "an energy")
        call assertFalse(is_small("drift"), "a name")
    end subroutine small_ones

    subroutine words_of_a_title()
        !! Letters, dots, indices and powers, as on the axes; other words stay.
        character(*), parameter :: omega = char(207)//char(137), pi = char(207)//char(128)

        call assertEqual("at "//theta//"_{1} = 2 "//pi//"/"//omega//"_{0}, v_{0}^{2} = 3 g l", &
                         with_symbols("at theta1 = 2 pi/omega0, v0^2 = 3 g l"))
        call assertEqual(theta//dot//"^{2} "//theta//" falls", &
                         with_symbols("theta_dot^2 theta falls"))
        call assertEqual("dT/d"//theta//", d"//phi//dot, with_symbols("dT/dtheta, dphi_dot"))
        call assertEqual("p_{"//theta//"} swings, p_{x} t - M x_{com}", &
                         with_symbols("p_theta swings, p_x t - M x_com"))
        call assertEqual("1/r^{3}, e^{-t}, (a + b)^{-12} 2^{"//theta//"}", &
                         with_symbols("1/r^3, e^-t, (a + b)^-12 2^theta"))
        call assertEqual("""cart\\_pendulum: "//theta//", 2"//pi//"""", &
                         text_label("cart_pendulum: theta, 2pi"))
        call assertEqual("""m g cos("//theta//")""", label("m g cos(theta)", "1"))
        call assertEqual("""m x"//ddot//" dx/d"//theta//" (N m^{2})""", &
                         label("m x_ddot dx/dtheta", "N m^2"))
        call assertEqual("""m x_dot (m&)"" noenhanced", label("m x_dot", "m&"))
        call assertEqual("x\^ "//theta, with_symbols("x^ theta"))
        call assertEqual("", with_symbols("m = 5.972e24, 1e-10, 2d3, 3e, 4e+ x"))
        call assertEqual("2"//theta//" 1e5 v_{0}", with_symbols("2theta 1e5 v0"))
    end subroutine words_of_a_title

    subroutine titles_without_symbols()
        !! Words, names of methods and files, capitals that look Latin; what might be read as more
        !! than a text.
        character(*), parameter :: texts(*) = [character(32) :: "Alpha, Beta, Tau and rk4", &
            "cart_pendulum by blanes_moan6", "energy_drift, gauss16", "a b c = d", "thetas, dpis", &
            "theta {1}", "theta & x", "theta @x", "~theta", "theta\n", "theta`x`", "x_, x__1, ^", &
            "3 m/s, T = 2"]
        integer :: i

        do i = 1, size(texts)
            call assertEqual("", with_symbols(trim(texts(i))), texts(i))
            call assertEqual(trim(texts(i)), unicode_text(trim(texts(i))), texts(i))
        end do
        call assertEqual("", with_symbols("theta"//char(27)), "a control character")
        call assertEqual("""mean_speed"" noenhanced", text_label("mean_speed"))
    end subroutine titles_without_symbols

    subroutine titles_of_pages()
        !! By characters of Unicode; an index that has none stays as it is.
        character(*), parameter :: two = char(194)//char(178), under = char(226)//char(130)
        character(*), parameter :: minus = char(226)//char(129)//char(187)

        call assertEqual("v"//under//char(128)//two//" = 3.5 g l, "//theta//dot//under//char(129), &
                         unicode_text("v0^2 = 3.5 g l, theta1_dot"))
        call assertEqual("r"//minus//char(226)//char(129)//char(180)//"x"//char(194)//char(185)// &
                         char(194)//char(179), unicode_text("r^-4x^13"))
        call assertEqual("p_"//theta//", x_com; e^x", unicode_text("p_theta, x_com; e^x"))
    end subroutine titles_of_pages
end module test_plot_label
