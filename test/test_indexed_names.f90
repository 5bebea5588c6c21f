module test_indexed_names
    !! Chains in formulas: `sum(i, 1, 4, ...)`, `x_(i + 1)`, `'x_1 .. x_4'`.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: new_system
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_formula_text, only: formula_text
    use lagrangia_kinds, only: dp
    use lagrangia_random_draws, only: random_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_small_oscillations, only: find_modes, modes_t
    use lagrangia_symbols, only: symbols_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text, word_t
    use stated_text, only: is_said
    implicit none (type, external)
    private
    public :: indexed_names_suite

    character, parameter :: line_feed = new_line("a")
    character(*), parameter :: chain = "&lagrangian coordinates = 'x_1 .. x_4 [m] of bead i' "// &
        "parameters = 'm', 'k' T = 'sum(i, 1, 4, m/2 x_i_dot^2)' "// &
        "V = 'k/2 x_1^2 + sum(i, 1, 3, k/2 (x_(i + 1) - x_i)^2) + k/2 x_(2 + 2)^2' "// &
        "positions = 'bead_1 .. bead_4, m: i/5 + x_i, 0' /"//line_feed//"&chain m = 2.0 k = 3.0 /"

contains

    function indexed_names_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("indexed_names")
        call suite%addTest(TestMethod("sums_are_written_out", sums_are_written_out))
        call suite%addTest(TestMethod("slips_have_a_column", slips_have_a_column))
        call suite%addTest(TestMethod("coupled_oscillators", coupled_oscillators))
        call suite%addTest(TestMethod("hanging_chain", hanging_chain))
        call suite%addTest(TestMethod("forces_on_a_chain", forces_on_a_chain))
        call suite%addTest(TestMethod("constraints_of_a_chain", constraints_of_a_chain))
        call suite%addTest(TestMethod("ranges_are_refused", ranges_are_refused))
        call suite%addTest(TestMethod("nonsense_is_refused", nonsense_is_refused))
    end function indexed_names_suite

    subroutine four_names(symbols)
        !! x_1 to x_4 with velocities, k, and a definition with a number.
        type(symbols_t), intent(out) :: symbols
        type(expression_t) :: meaning
        type(error_t), allocatable :: error
        integer :: i

        call symbols%add("t")
        do i = 1, 4
            call symbols%add("x_"//to_text(i))
        end do
        do i = 1, 4
            call symbols%add("x_"//to_text(i)//"_dot")
        end do
        call symbols%add("k")
        call parse_formula("x_1 + k", symbols, meaning, error)
        call symbols%define("D_1", meaning, error)
    end subroutine four_names

    subroutine sums_are_written_out()
        call is("sum(i, 1, 3, x_i)", "x_1 + x_2 + x_3")
        call is("2 sum(i, 1, 2, k x_i_dot^2) + k", "2 (k x_1_dot^2 + k x_2_dot^2) + k")
        call is("sum(i, 1, 3, (x_(i + 1) - x_i)^2)", &
                "(x_2 - x_1)^2 + (x_3 - x_2)^2 + (x_4 - x_3)^2")
        call is("sum(i, 2, 2, x_(i - 1)_dot x_(5 - i))", "x_1_dot x_3")
        call is("sum(i, 1, 2, sum(j, i, 2, i j x_i x_j))", &
                "1*1 x_1 x_1 + 1*2 x_1 x_2 + 2*2 x_2 x_2")
        call is("k + sum(i, 3, 2, x_(i + 9))", "k + 0")
        call is("sum(i, -1, 0, x_(i + 2)) |sum(i, 1, 2, x_i)|", "(x_1 + x_2) |x_1 + x_2|")
        call is("x_(3) + D_(1) + sum(n, 1, 1, D_n)", "x_3 + 2 (x_1 + k)")
    contains
        subroutine is(text, same)
            !! Equal formulas, by their values at a state.
            character(*), intent(in) :: text, same
            type(symbols_t) :: symbols
            type(expression_t) :: one, other
            type(error_t), allocatable :: error

            call four_names(symbols)
            call parse_formula(text, symbols, one, error)
            if (allocated(error)) call assertEqual("", error%message, message=text)
            if (allocated(error)) return
            call parse_formula("("//same//") - ("//formula_text(one, symbols)//")", symbols, &
                               other, error)
            call assertFalse(allocated(error), message="read back: "//text)
            call assertEqual(0.0_dp, value_of(other), 1e-13_dp, message=text)
        end subroutine is
    end subroutine sums_are_written_out

    function value_of(e) result(value)
        !! At t = 0.5, x = 0.7, -0.3, 1.1, 0.2, x_dot = 0.4, 0.9, -0.6, 1.3, k = 1.7.
        type(expression_t), intent(in) :: e
        real(dp) :: value
        type(formula_program_t) :: program
        type(expression_t) :: one(1)
        real(dp) :: results(1)

        one(1) = e
        call new_formula_program(program, one, 10)
        call program%evaluate([0.5_dp, 0.7_dp, -0.3_dp, 1.1_dp, 0.2_dp, 0.4_dp, 0.9_dp, -0.6_dp, &
                               1.3_dp, 1.7_dp], results)
        value = results(1)
    end function value_of

    subroutine slips_have_a_column()
        call refused("sum(i, 1, 5, k x_i^2)", "column 16: 'x_i' is 'x_5' here, and there is "// &
                     "only x_1, x_2, x_3, x_4")
        call refused("sum(i, 1, 4, k x_(i + 1)^2)", "is 'x_5' here, and there is only x_1, "// &
                                                    "x_2, x_3, x_4")
        call refused("k x_5", "column 3: there is no 'x_5'; there are x_1, x_2, x_3, x_4")
        call refused("sum(i, 0, 4, x_i)", "column 14: 'x_i' is 'x_0' here, and there is only "// &
                                          "x_1, x_2, x_3, x_4")
        call refused("sum(i, 1, 2, y_i)", "column 14: 'y_i' is 'y_1' here, and there is none")
        call refused("sum(k, 1, 4, x_k)", "column 5: 'k' has a meaning already; take another index")
        call refused("sum(i, 1, 2, sum(i, 1, 2, x_i))", "column 18: 'i' has a meaning "// &
                                                        "already; take another index")
        call refused("sum(1, 4, x_i)", "column 5: a sum begins with the name of its index; "// &
                                       "write it as sum(i, 1, 4, m/2 x_i_dot^2)")
        call refused("sum()", "column 5: a sum begins with the name of its index; write it "// &
                              "as sum(i, 1, 4, m/2 x_i_dot^2)")
        call refused("sum(i 1, 4, x_i)", "column 7: a sum has an index, where it begins and "// &
                                         "ends, and a formula, with commas between them; "// &
                                         "write it as sum(i, 1, 4, m/2 x_i_dot^2)")
        call refused("sum(i, 1, 4)", "column 12: a sum has an index, where it begins and "// &
                                     "ends, and a formula, with commas between them; write "// &
                                     "it as sum(i, 1, 4, m/2 x_i_dot^2)")
        call refused("sum(i, 1, k, x_i)", "column 11: an index is a whole number or the index "// &
                     "of a sum, as in x_(i + 1), sum(i, 1, 4, ...)")
        call refused("sum(i, 1, 2.5, x_i)", "column 11: an index is a whole number or the "// &
                                            "index of a sum, as in x_(i + 1), sum(i, 1, 4, ...)")
        call refused("sum(i, 1, 4, x_i", "column 17: the bracket of a sum is not closed; "// &
                                         "write sum(i, 1, 4, x_i^2)")
        call refused("sum(i, 2, 1, x_i", "the bracket of a sum is not closed; write sum(i, "// &
                                         "1, 4, x_i^2)")
        call refused("sum(i, 1, 4, x_i, k)", "column 17: the bracket of a sum is not closed; "// &
                                             "write sum(i, 1, 4, x_i^2)")
        call refused("sum(i, 1, 4, sin x_i k)", "column 18: 'sin' needs brackets; write "// &
                                                "'sin(x_i)'")
        call refused("x_(i + 1)", "column 4: an index is a whole number or the index of a "// &
                                  "sum, as in x_(i + 1), sum(i, 1, 4, ...)")
        call refused("sum(i, 1, 1, x_(i*2))", "column 18: the bracket of an index is not "// &
                     "closed; write x_(i + 1)")
        call refused("sum(pi, 1, 4, x_pi)", "column 5: 'pi' has a meaning already; take "// &
                                            "another index")
        call refused("sum(sin, 1, 4, x_sin)", "column 5: 'sin' has a meaning already; take "// &
                                              "another index")
        call refused("(x_1 + x_2)_dot", "column 12: a bracket has no '_dot'; write that of "// &
                                        "each name in it")
        call refused("sum(i, 1, 2000, k)", "more than 1000 terms")
        call refused("sum(a, 1, 900, sum(b, 1, 900, k))", "more than 100000 parts; shorten it")
        call refused("sum(a,1,1,sum(b,1,1,sum(c,1,1,sum(d,1,1,sum(e,1,1,k)))))", "more than "// &
                                                                                 "4 sums "// &
                                                                                 "within "// &
                                                                                 "each other")
        call refused("k x_1, x_2", "',' has no meaning here; decimals have a point: 0.5")
        call refused("x_1 _dot", "a name begins with a letter; write it before the '_'")
    contains
        subroutine refused(text, expected)
            character(*), intent(in) :: text, expected
            type(symbols_t) :: symbols
            type(expression_t) :: e
            type(error_t), allocatable :: error

            call four_names(symbols)
            call parse_formula(text, symbols, e, error)
            call assertTrue(allocated(error), message="refused: "//text)
            if (.not. allocated(error)) return
            call assertTrue(is_said(error%message, expected), message=error%message)
            call assertTrue(index(error%message, "column ") == 1, message=error%message)
        end subroutine refused
    end subroutine slips_have_a_column

    subroutine read_system(text, system, error)
        !! A scene that starts at rest at 0.1, 0.1, ...
        character(*), intent(in) :: text
        class(system_t), allocatable, intent(out) :: system
        type(error_t), allocatable, intent(out) :: error
        type(scene_t) :: scene
        type(word_t) :: none(0)

        call parse_scene(text//line_feed, "chain.nml", none, scene, system, error)
    end subroutine read_system

    subroutine coupled_oscillators()
        !! \(\omega_j^2 = \frac{4k}m\sin^2\frac{j\pi}{2(N + 1)}\) of N beads between fixed ends,
        !! with T of the places; their names and what is said of each.
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(modes_t) :: modes
        type(error_t), allocatable :: error
        real(dp), parameter :: pi = acos(-1.0_dp)
        integer :: j

        call read_system("&scene system = 'chain' dt = 0.1 duration = 1.0 q = 4*0.1 /"// &
                         line_feed//chain, system, error)
        if (allocated(error)) call assertEqual("", error%message)
        if (allocated(error)) return
        call system%describe(d)
        call assertEqual("x_3", trim(d%coordinates(3)%name))
        call assertEqual("of bead 3", trim(d%coordinates(3)%meaning))
        call assertEqual("bead_4", trim(d%points(4)%name))
        call find_modes(system, [real(dp) :: 0, 0, 0, 0], .true., modes, error)
        call assertEqual([(4*1.5_dp*sin(j*pi/10)**2, j=1, 4)], modes%omega2, 1e-14_dp)
    end subroutine coupled_oscillators

    subroutine hanging_chain()
        !! Three bobs by their places alone, beside the lecture's chain, of which l is the length.
        character(*), parameter :: typed = "&scene system = 'hang' dt = 0.1 duration = 1.0 "// &
            "q = 3*0.1 /"//line_feed//"&lagrangian coordinates = 'theta_1 .. theta_3 [rad]' "// &
            "parameters = 'm_1 .. m_3', 'l', 'g' "// &
            "V = '-sum(i, 1, 3, m_i g sum(k, 1, i, l cos(theta_k)))' positions = "// &
            "'bob_1 .. bob_3, m_i: sum(k, 1, i, l sin(theta_k)), "// &
            "-sum(k, 1, i, l cos(theta_k))' /"// &
            line_feed//"&hang m_1 = 0.7, m_2 = 0.7, m_3 = 0.7, l = 0.4, g = 9.81 /"
        class(system_t), allocatable :: system, page
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp), parameter :: q(3) = [0.3_dp, -0.8_dp, 1.9_dp], v(3) = [1.1_dp, 0.4_dp, -2.0_dp]
        real(dp) :: a(3), b(3)

        call read_system(typed, system, error)
        if (allocated(error)) call assertEqual("", error%message)
        if (allocated(error)) return
        call new_system("hanging_chain", page, error)
        call page%describe(d)
        call page%configure([3.0_dp, 0.7_dp, 1.2_dp, 9.81_dp], error)
        if (allocated(error)) call assertEqual("", error%message)
        call system%accelerations(0.0_dp, q, v, a)
        call page%accelerations(0.0_dp, q, v, b)
        call assertEqual(b, a, 1e-11_dp)
    end subroutine hanging_chain

    subroutine forces_on_a_chain()
        !! One formula for all, but for the coordinate that has its own; definitions and quantities
        !! one for each number; a slip has its column.
        character(*), parameter :: start = "&scene system = 'chain' dt = 0.1 duration = 1.0 "// &
            "q = 4*0.1 /"//line_feed//"&lagrangian coordinates = 'x_1 .. x_4', parameters = "// &
            "'m', 'b' T = 'sum(i, 1, 4, m/2 x_i_dot^2)' "
        character(*), parameter :: finish = " /"//line_feed//"&chain m = 1.0, b = 0.5 /"
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp) :: a(4)

        call read_system(start//"Q_x_i = '-i b x_i_dot' Q_x_2 = '-d_3' definitions = "// &
                         "'d_1 .. d_3 = x_(i + 1) - x_i' quantities = 'p_1 .. p_4 "// &
                         "[kg m/s] of one = m x_i_dot'"//finish, system, error)
        if (allocated(error)) call assertEqual("", error%message)
        if (allocated(error)) return
        call system%accelerations(0.0_dp, [0.1_dp, 0.2_dp, 0.3_dp, 0.5_dp], &
                                  [1.0_dp, 1.0_dp, 1.0_dp, 2.0_dp], a)
        call assertEqual([-0.5_dp, -0.2_dp, -1.5_dp, -4.0_dp], a, 1e-15_dp)
        call system%describe(d)
        call assertEqual("p_4", trim(d%quantities(8)%name))
        call assertEqual(2.0_dp, system%quantity(8, 0.0_dp, [0.1_dp, 0.2_dp, 0.3_dp, 0.5_dp], &
                                                 [1.0_dp, 1.0_dp, 1.0_dp, 2.0_dp]), 1e-15_dp)
        call refused("Q_x_i = '-b x_j_dot'", "Q_x_i: column 4: unknown name 'x_j_dot'; did "// &
                                             "you mean 'x_1_dot'?")
        call refused("Q_x_2 = '-b', Q_x_i = '-b + c'", "Q_x_i: column 6: unknown name 'c'; "// &
                                                       "there are t, x_1, x_2, x_3, x_4, "// &
                                                       "x_1_dot, x_2_dot, x_3_dot, x_4_dot, "// &
                                                       "m, b, pi")
        call refused("Q_y_i = '-b'", "unknown key 'q_y_i'; did you mean 'q_x_i'?")
        call refused("definitions = 'd_1 .. d_4 = x_(i + 1)'", "column "// &
                     "15 of 'd_4 = x_(4 + 1)': 'x_' is 'x_5' here, and there is only "// &
                     "x_1, x_2, x_3, x_4")
        call refused("quantities = 'p_1 .. r_4 = m x_i_dot'", "names of a chain are written "// &
                                                              "'x_1 .. x_4', with one name "// &
                                                              "before the numbers")
    contains
        subroutine refused(keys, expected)
            character(*), intent(in) :: keys, expected

            call read_system(start//keys//finish, system, error)
            call assertTrue(allocated(error), keys)
            if (allocated(error)) call assertTrue(is_said(error%message, expected), error%message)
        end subroutine refused
    end subroutine forces_on_a_chain

    subroutine constraints_of_a_chain()
        !! Two rods, each as long as the other: one constraint for each number, as written out; the
        !! text is to blame for a slip, with its column.
        character(*), parameter :: start = "&scene system = 'rods' dt = 0.1 duration = 1.0 "// &
            "q = 0, 1, 2, 0, 0, 1 /"//line_feed//"&lagrangian coordinates = 'x_1 .. x_3', "// &
            "'y_1 .. y_3' parameters = 'm', 'l', 'g' T = 'sum(i, 1, 3, m/2 (x_i_dot^2 + "// &
            "y_i_dot^2))' V = 'sum(i, 1, 3, m g y_i)' "
        character(*), parameter :: finish = " /"//line_feed//"&rods m = 1.0, l = 1.0, g = 9.81 /"
        character(*), parameter :: squares = "definitions = 'd_1 .. d_2 = (x_(i + 1) - x_i)^2 "// &
            "+ (y_(i + 1) - y_i)^2' "
        character(*), parameter :: long = "constraint = '(x_2 - x_1)^2 + (y_2 - y_1)^2 = l^2', "// &
            "'(x_3 - x_2)^2 + (y_3 - y_2)^2 = 2 l^2'"
        class(system_t), allocatable :: system, other
        type(error_t), allocatable :: error
        real(dp), parameter :: q(6) = [0.0_dp, 1.0_dp, 2.0_dp, 0.0_dp, 0.0_dp, 1.0_dp]
        real(dp), parameter :: v(6) = [0.3_dp, 0.5_dp, 0.1_dp, 0.2_dp, 0.2_dp, -0.2_dp]
        real(dp) :: a(6), b(6)

        call read_system(start//squares//"constraint = 'd_1 .. d_2 = i l^2'"//finish, system, error)
        if (.not. allocated(error)) call read_system(start//long//finish, other, error)
        if (allocated(error)) call assertEqual("", error%message)
        if (allocated(error)) return
        call system%accelerations(0.0_dp, q, v, a)
        call other%accelerations(0.0_dp, q, v, b)
        call assertEqual(b, a, 1e-13_dp)
        call assertTrue(abs(a(2) - a(3)) > 0.1_dp, "they pull")
        call read_system(start//squares//"constraint = 'x_1 = 0', 'd_1 .. d_2 = z l^2'"//finish, &
                         system, error)
        call assertTrue(index(error%message, "chain.nml:2:252: &lagrangian: constraint = "// &
                              "'d_1 .. d_2 = z l^2': column 7 of 'd_1 = z l^2': unknown name "// &
                              "'z'") > 0, error%message)
    end subroutine constraints_of_a_chain

    subroutine ranges_are_refused()
        !! At the text, though it was written out.
        call refused("'x_1 .. y_4'", "names of a chain are written 'x_1 .. x_4', with one "// &
                                     "name before the numbers")
        call refused("'x .. z'", "names of a chain are written 'x_1 .. x_4', with one name "// &
                                 "before the numbers")
        call refused("'x_4 .. x_1'", "is 0 names; there are 1 to 60")
        call refused("'x_1 .. x_99'", "is 99 names; there are 1 to 60")
        call refused("'x_1 ..'", "names of a chain are written 'x_1 .. x_4', with one name "// &
                                 "before the numbers")
        call refused("'x_1 .. x_2', 'x_2'", "chain.nml:2:41: &lagrangian: coordinates = 'x_2': "// &
                     "the name 'x_2' is given twice; take another one")
    contains
        subroutine refused(coordinates, expected)
            character(*), intent(in) :: coordinates, expected
            class(system_t), allocatable :: system
            type(error_t), allocatable :: error

            call read_system("&scene system = 'chain' dt = 0.1 duration = 1.0 q = 1.0 /"// &
                             line_feed//"&lagrangian coordinates = "//coordinates// &
                             " T = 'x_1_dot^2' /"//line_feed//"&chain /", system, error)
            call assertTrue(allocated(error), message="refused: "//coordinates)
            if (.not. allocated(error)) return
            call assertTrue(is_said(error%message, expected), message=error%message)
            call assertTrue(index(error%message, line_feed) == 0, message=error%message)
        end subroutine refused
    end subroutine ranges_are_refused

    subroutine nonsense_is_refused()
        !! Five thousand texts of what sums are made of: each is a formula, or has a column.
        character(6), parameter :: pieces(*) = [character(6) :: "sum(", "i", ",", "1", "4", ")", &
            "x_i", "x_(i+1", "x_(", "_dot", "+", "-", "^2", "k", "(", "j", "x_j", "|", "/", "x_1", &
            "=", "*"]
        type(symbols_t) :: symbols
        type(expression_t) :: e
        type(error_t), allocatable :: error
        type(random_t) :: random
        character(200) :: text
        real(dp) :: draw
        integer :: accepted, i, k, length

        call four_names(symbols)
        accepted = 0
        do i = 1, 5000
            text = "sum(i,1,3,"
            if (mod(i, 3) == 0) text = ""
            call random%uniform(1.0_dp, 9.0_dp, draw)
            length = int(draw)
            do k = 1, length
                call random%uniform(0.0_dp, real(size(pieces), dp), draw)
                text = trim(text)//pieces(1 + min(int(draw), size(pieces) - 1))
            end do
            if (mod(i, 3) /= 0) text = trim(text)//")"
            call parse_formula(trim(text), symbols, e, error)
            if (allocated(error)) then
                call assertTrue(index(error%message, "column ") == 1 .and. &
                                index(error%message, line_feed) == 0, message=error%message)
            else
                accepted = accepted + 1
                call assertTrue(e%count > 0, message=text)
            end if
        end do
        call assertTrue(accepted > 50, message="some are good")
    end subroutine nonsense_is_refused
end module test_indexed_names
