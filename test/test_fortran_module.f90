module test_fortran_module
    !! Systems in formulas as modules in Fortran: statements, names, texts. What compilers say, and
    !! that the modules do what the formulas do, is for `.ci/try_fortran.py`.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_fortran_module, only: write_fortran_module
    use lagrangia_fortran_statements, only: fortran_lines_t, literal
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_system, only: system_t
    use lagrangia_written_system, only: written_system_t
    implicit none (type, external)
    private
    public :: fortran_module_suite

contains

    function fortran_module_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("fortran_module")
        call suite%addTest(TestMethod("equations_as_statements", equations_as_statements))
        call suite%addTest(TestMethod("names_that_are_taken", names_that_are_taken))
        call suite%addTest(TestMethod("numbers_and_powers", numbers_and_powers))
        call suite%addTest(TestMethod("what_is_conserved", what_is_conserved))
        call suite%addTest(TestMethod("constraints_as_procedures", constraints_as_procedures))
        call suite%addTest(TestMethod("long_lines_are_broken", long_lines_are_broken))
    end function fortran_module_suite

    subroutine write_of(formulas, values, lines, start)
        !! The module of a system `own` with these formulas.
        character(*), intent(in) :: formulas, values
        type(fortran_lines_t), intent(out) :: lines
        character(*), intent(in), optional :: start  !! `q`, for two coordinates if absent
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        type(word_t) :: none(0)
        character(:), allocatable :: text

        text = "2*0.3"
        if (present(start)) text = start
        text = "&scene system = 'own', dt = 0.1, duration = 1, q = "//text//" / &lagrangian "// &
               formulas//" /"
        if (values /= "") text = text//" &own "//values//" /"
        call parse_scene(text, "own.nml", none, scene, system, error)
        if (allocated(error)) call assertEqual("", error%message, "the scene")
        if (allocated(error)) return
        select type (system)
        class is (written_system_t)
            call write_fortran_module(system, "own.nml", lines, error)
        class default
            call assertTrue(.false., "a system in formulas")
        end select
        call assertFalse(allocated(error), "written")
    end subroutine write_of

    subroutine has(lines, line)
        !! Exactly this line, but for blanks before it.
        type(fortran_lines_t), intent(in) :: lines
        character(*), intent(in) :: line
        integer :: i

        do i = 1, size(lines%list)
            if (adjustl(lines%list(i)%text) == line) return
        end do
        call assertTrue(.false., "a line: "//line)
    end subroutine has

    subroutine equations_as_statements()
        !! Mass matrix, right side, elimination; sine and cosine of an angle once.
        type(fortran_lines_t) :: lines

        call write_of("coordinates = 'x', 'theta' parameters = 'm', 'l', 'g', 'b' "// &
                      "T = 'm/2 (x_dot^2 + (x_dot + l theta_dot)^2)' V = '-m g l cos(theta)' "// &
                      "Q_x = '-b x_dot'", "m = 1.5, l = 2, g = 9.81, b = 0.1", lines)
        call has(lines, "type, extends(lagrangian_system_t) :: own_t")
        call has(lines, "mass1_1 = 2.0_dp*m")
        call has(lines, "mass1_2 = m*l")
        call has(lines, "mass2_2 = m*l**2")
        call has(lines, "force1 = -b*x_dot")
        call has(lines, "force2 = -m*g*l*sine1")
        call has(lines, "sine1 = sin(theta)")
        call has(lines, "call sine_cosine(angle1, sine1, cosine1)")
        call has(lines, "real(dp) :: a1, force1, mass1_1, mass1_2, a2, force2, mass2_2, sine1, "// &
                 "factor")
        call has(lines, "factor = mass1_2/mass1_1")
        call has(lines, "force2 = force2 - factor*force1")
        call has(lines, "mass2_2 = mass2_2 - factor*mass1_2")
        call has(lines, "a2 = force2/mass2_2")
        call has(lines, "a1 = (force1 - mass1_2*a2)/mass1_1")
        call has(lines, "a(:, 2) = a2")
        call has(lines, "procedure :: generalised_forces")
        call has(lines, "f(1) = -b*x_dot")
        call has(lines, "p(2) = m*l*x_dot + m*l**2*theta_dot")
        call has(lines, 'positive("m", "1", "", 1.5_dp), &')
        call has(lines, 'real_number("b", "1", "", 0.1_dp)]')
    end subroutine equations_as_statements

    subroutine names_that_are_taken()
        !! By Fortran's functions, the module, the statements, a name before in other letters.
        type(fortran_lines_t) :: lines

        call write_of("coordinates = 'q', 'a1' parameters = 'Q1', 'self', 'mass1_2', 'factor' "// &
                      "T = '(q_dot^2 + a1_dot^2)/2 ' V = 'Q1 q^2 + self a1^2 + mass1_2 q'"// &
                      ", '+ factor a1'", &
                      "Q1 = 1, self = 2, mass1_2 = 3, factor = 4", lines)
        call has(lines, "force1 = -2.0_dp*Q1*q_ - mass1_2_")
        call has(lines, "force2 = -2.0_dp*self_*a1_ - factor_")
    end subroutine names_that_are_taken

    subroutine numbers_and_powers()
        !! Fractions that have no end, whole exponents, others, and a sign before a power.
        type(fortran_lines_t) :: lines

        call write_of("coordinates = 'x', 'y' T = '(x_dot^2 + y_dot^2)/2' "// &
                      "V = 'x^4/3 + (1 + y^2)^(1/2) + (1 + y^2)^(-2) + 1e-7 x'", "", lines)
        call has(lines, "value = (x_dot**2 + y_dot**2)/2.0_dp &")
        call has(lines, "- (x**4/3.0_dp + (1.0_dp + y**2)**(1.0_dp/2.0_dp) + (1.0_dp + y**2)"// &
                 "**(-2) &")
        call has(lines, "force1 = -4.0_dp/3.0_dp*x**3 - 1e-7_dp")
    end subroutine numbers_and_powers

    subroutine what_is_conserved()
        !! With all parameters, or with those of the scene only.
        type(fortran_lines_t) :: lines

        call write_of("coordinates = 'x', 'y' parameters = 'k', 'c' "// &
                      "T = '(x_dot^2 + y_dot^2)/2' V = 'k/2 (x^2 + y^2) + c x^2' "// &
                      "quantities = 'L = x y_dot - y x_dot', "// &
                      "'E = (x_dot^2 + y_dot^2)/2 + k/2 (x^2 + y^2) + c x^2', 'W = x y'", &
                      "k = 2, c = 0", lines)
        call has(lines, "if (allocated(self%p)) d%quantities(3)%conserved = all(abs(self%p - "// &
                 "[2.0_dp, 0.0_dp]) <= &")
        call has(lines, "d%quantities(4)%conserved = .true.")
    end subroutine what_is_conserved

    subroutine constraints_as_procedures()
        !! Their multipliers are more unknowns; what is left of them are quantities.
        type(fortran_lines_t) :: lines

        call write_of("coordinates = 'x', 'drift' parameters = 'm', 'w' "// &
                      "T = 'm/2 (x_dot^2 + drift_dot^2)' constraint = 'drift = 10/3 x^2 + w t'", &
                      "m = 1.5, w = 0.2", lines)
        call has(lines, "mass1_3 = 20.0_dp/3.0_dp*x")
        call has(lines, "mass2_3 = -1.0_dp")
        call has(lines, "force3 = -20.0_dp/3.0_dp*x_dot**2")
        call has(lines, "a3 = force3/mass3_3")
        call has(lines, "self%constraints = 1")
        call has(lines, "self%is_projected = .true.")
        call has(lines, "self%holonomic = [.true.]")
        call has(lines, "rows(1, 1) = -20.0_dp/3.0_dp*x")
        call has(lines, "rows(1, 2) = 1.0_dp")
        call has(lines, "drift(1) = -w")
        call has(lines, "values(1) = drift - (10.0_dp/3.0_dp*x**2 + w*t)")
        call has(lines, "case (3)")
        call has(lines, "value = lambda(i - 2)")
        call has(lines, "case (4)")
        call has(lines, 'd%constraint = "holonomic, rheonomic"')
        call has(lines, "d%quantities(4:)%scale = 1.0_dp")
        call write_of("coordinates = 'x', 'y', 'z' parameters = 'm' V = '0' "// &
                      "T = 'm/2 (x_dot^2 + y_dot^2 + z_dot^2)' constraint = 'y = x', 'z = x^2'", &
                      "m = 1.5", lines, start="2*0.3, 0.09")
        call has(lines, "case (4:5)")
        call has(lines, "value = lambda(i - 3)")
    end subroutine constraints_as_procedures

    subroutine long_lines_are_broken()
        !! At terms and commas, not in brackets within brackets, nor in texts; quotes are doubled.
        type(fortran_lines_t) :: lines
        character(*), parameter :: words = "twenty-five characters, a"
        character(:), allocatable :: all_of_them, line
        integer :: first, i

        call lines%add(8, "x = "//repeat("abcdefghij*", 4)//"klm + "//repeat("nop(q, r)*", 5)//"s")
        call assertEqual("        x = "//repeat("abcdefghij*", 4)//"klm &", lines%list(1)%text)
        call assertEqual("            + "//repeat("nop(q, r)*", 5)//"s", lines%list(2)%text)
        call assertEqual(2, lines%longest, "lines of a statement")
        deallocate (lines%list)
        call lines%add(8, "call f("//repeat("a", 40)//", "//repeat("b", 20)//", c + g(d, "// &
                       repeat("e", 40)//"))")
        call assertEqual("        call f("//repeat("a", 40)//", "//repeat("b", 20)//", c &", &
                         lines%list(1)%text)
        call assertEqual("            + g(d, "//repeat("e", 40)//"))", lines%list(2)%text)
        deallocate (lines%list)
        call lines%add(8, "call f("//repeat("a", 40)//", "//repeat("b", 20)//", g(d * h, "// &
                       repeat("e", 40)//"))")
        call assertEqual("        call f("//repeat("a", 40)//", "//repeat("b", 20)//", &", &
                         lines%list(1)%text, "behind a comma, not before a product deeper within")
        deallocate (lines%list)
        call assertEqual('"say ""so"""', literal('say "so"'))
        call assertEqual('"'//words//" "//words//'"', literal(words//" "//words))
        call assertEqual('"'//words//" "//words//'"// " '//words//'"', &
                         literal(words//" "//words//" "//words))
        call lines%add(4, "!! "//repeat(words//" ", 5))
        call assertEqual("    !! "//repeat(words//" ", 3)//"twenty-five", lines%list(1)%text)
        call assertEqual("    !! characters, a "//words, lines%list(2)%text)
        call lines%assign(0, "x", repeat("a(b + c) - ", 900)//"d")
        call assertEqual("x = a(b + c) - a(b + c)", lines%list(3)%text(:23))
        all_of_them = ""
        do i = 3, size(lines%list)
            line = trim(adjustl(lines%list(i)%text))
            if (line(len(line):) == "&") line = line(:len(line) - 1)
            all_of_them = all_of_them//trim(line)//" "
        end do
        first = index(all_of_them, " x = x ")
        call assertTrue(first > 8000, "a second statement")
        call assertEqual("x = "//repeat("a(b + c) - ", 900)//"d", &
                         all_of_them(:first)//trim(all_of_them(first + 7:)))
    end subroutine long_lines_are_broken
end module test_fortran_module
