module test_written_quantities
    !! Quantities that a scene names: read, evaluated, found to be conserved or not, refused.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_audit, only: audit_system
    use lagrangia_columns, only: column_names, columns_t, new_columns
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: description_t, formula_length, name_length
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: ledger_t
    use lagrangia_magnitude, only: magnitude
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_symbols, only: symbols_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: written_quantities_suite

    character(*), parameter :: nl = new_line("a")
    character(*), parameter :: plane = "coordinates = 'x', 'y' parameters = 'm [kg]', 'k', 'c' "// &
        "T = 'm/2 (x_dot^2 + y_dot^2)' V = 'k/2 (x^2 + y^2) + c x' "
    character(*), parameter :: spin = "'L_z [J s] angular momentum = m (x y_dot - y x_dot)'"
    character(*), parameter :: round_values = "m = 2 k = 3 c = 0", &
        pushed_values = "m = 2 k = 3 c = 1e-7"

contains

    function written_quantities_suite() result(suite)
        type(TestSuite) :: suite

        suite = TestSuite("written_quantities")
        call suite%addTest(TestMethod("values, units and words", values_and_words))
        call suite%addTest(TestMethod("what is conserved is found", conserved_is_found))
        call suite%addTest(TestMethod("what acts in one place is found", places_are_found))
        call suite%addTest(TestMethod("constraints are kept", constraints_are_kept))
        call suite%addTest(TestMethod("the longest equations", longest_equations))
        call suite%addTest(TestMethod("a drift has a size", drift_has_a_size))
        call suite%addTest(TestMethod("magnitudes of terms", magnitudes))
        call suite%addTest(TestMethod("the audit knows them", audited))
        call suite%addTest(TestMethod("the echo has them", echoed))
        call suite%addTest(TestMethod("what is none is refused", refusals))
    end function written_quantities_suite

    subroutine read_own(group, values, start, scene, system, error)
        !! A scene with this group on its second line.
        character(*), intent(in) :: group, values, start
        type(scene_t), intent(out) :: scene
        class(system_t), allocatable, intent(out) :: system
        type(error_t), allocatable, intent(out) :: error

        call parse_scene("&scene system = 'own' dt = 1e-2 duration = 1 "//start//" /"//nl// &
                         "&lagrangian "//group//" /"//nl//"&own "//values//" /", "a.nml", &
                         [word_t ::], scene, system, error)
    end subroutine read_own

    subroutine own(group, values, system, d)
        !! Its system, where nothing is wrong.
        character(*), intent(in) :: group, values
        class(system_t), allocatable, intent(out) :: system
        type(description_t), intent(out) :: d
        type(scene_t) :: scene
        type(error_t), allocatable :: error

        call read_own(group, values, "q = 1, 0 v = 0, 1", scene, system, error)
        if (allocated(error)) call assertEqual("", error%message)
        if (.not. allocated(error)) call system%describe(d)
    end subroutine own

    subroutine values_and_words()
        !! Behind the momenta, each may use those before it, definitions, the time.
        class(system_t), allocatable :: system
        type(description_t) :: d

        call own(plane//"definitions = 'w = x y_dot' quantities = "//spin// &
                 ", 'A [J^2 s^2] = L_z^2 + t', "// &
                 "'s=w'", round_values, system, d)
        if (anyExceptions()) return
        call assertEqual(5, size(d%quantities))
        call assertEqual("L_z", trim(d%quantities(3)%name))
        call assertEqual("J s", trim(d%quantities(3)%unit))
        call assertEqual("angular momentum", trim(d%quantities(3)%meaning))
        call assertEqual("m (x y_dot - y x_dot)", trim(d%quantities(3)%formula))
        call assertEqual("L_z^2 + t", trim(d%quantities(4)%formula))
        call assertEqual("1", trim(d%quantities(5)%unit))
        call assertEqual(-4.0_dp, system%quantity(3, 9.0_dp, [1.0_dp, 2.0_dp], [3.0_dp, 4.0_dp]), &
                         0.0_dp)
        call assertEqual(25.0_dp, system%quantity(4, 9.0_dp, [1.0_dp, 2.0_dp], [3.0_dp, 4.0_dp]), &
                         0.0_dp)
        call assertEqual(4.0_dp, system%quantity(5, 9.0_dp, [1.0_dp, 2.0_dp], [3.0_dp, 4.0_dp]), &
                         0.0_dp)
    end subroutine values_and_words

    subroutine conserved_is_found()
        !! By the parameters' values; an explicit time counts: \(x - \dot x t\) of a free mass; also
        !! with a force beside L.
        class(system_t), allocatable :: system
        type(description_t) :: d
        character(name_length), allocatable :: names(:)
        type(error_t), allocatable :: error

        call own(plane//"quantities = "//spin, round_values, system, d)
        if (anyExceptions()) return
        call assertTrue(d%quantities(3)%conserved, "a central force keeps L_z")
        allocate (names, source=column_names(system, .false.))
        call assertTrue(any(names == "L_z_drift"), "and it has a drift")
        call system%configure([2.0_dp, 3.0_dp, 1e-7_dp], error)
        call system%describe(d)
        call assertFalse(d%quantities(3)%conserved, "with other parameters another verdict")
        call own(plane//"quantities = "//spin, pushed_values, system, d)
        call assertFalse(d%quantities(3)%conserved, "a force that is not central, however small")
        call own(plane//"quantities = 'x_0 = x - x_dot t', 'y_0 = x + x_dot t'", &
                 "m = 2 k = 0 c = 0", system, d)
        call assertTrue(d%quantities(3)%conserved, "a free mass, seen from where it starts")
        call assertFalse(d%quantities(4)%conserved, "the other sign")
        call own(plane//"Q_x = '-0.1 x_dot' quantities = "//spin, round_values, system, d)
        call assertFalse(d%quantities(3)%conserved, "friction along x")
        call own(plane//"Q_x = '-0.1 y' Q_y = '0.1 x' quantities = 'R = x^2 + y^2', 'n = m'", &
                 round_values, system, d)
        call assertFalse(d%quantities(3)%conserved, "a curl")
        call assertTrue(d%quantities(4)%conserved, "a number")
        call own(plane//"Q_x = '-0.1 (|x - 5| + x - 5)' quantities = "// &
                 "'P = m x_dot', 'S = m y_dot'", "m = 2 k = 0 c = 0", system, d)
        call assertFalse(d%quantities(3)%conserved, "a wall far away")
        call assertTrue(d%quantities(4)%conserved, "beside the wall")
        call own(plane//"Q_x = '-x (x^2 + y^2)^2' Q_y = '-y (x^2 + y^2)^2' quantities = "//spin, &
                 round_values, system, d)
        call assertTrue(d%quantities(3)%conserved, "a steep central force, far away too")
        call own(plane//"quantities = 'u = sqrt(-1 - x^2)', "//spin//", 'w = sqrt(x)'", &
                 round_values, system, d)
        call assertFalse(d%quantities(3)%conserved, "what is a number nowhere")
        call assertTrue(d%quantities(4)%conserved, "beside others that are none")
        call assertFalse(d%quantities(5)%conserved, "what is a number here and there")
    end subroutine conserved_is_found

    subroutine places_are_found()
        !! A narrow hill, a kick of a moment, a step on a circle, none of which acts anywhere else;
        !! what they conserve they conserve.
        class(system_t), allocatable :: system
        type(description_t) :: d

        call own("coordinates = 'x', 'y' parameters = 'm', 'k', 'c' definitions = "// &
                 "'U = k exp(-((x - 30)^2 + (y - 40 - c t)^2)/1e-4)' "// &
                 "T = 'm/2 (x_dot^2 + y_dot^2)' V = 'U' quantities = "//spin// &
                 ", 'h = m/2 (x_dot^2 + y_dot^2) + U', 's = h - c m y_dot'", &
                 "m = 2 k = 3 c = 5", system, d)
        if (anyExceptions()) return
        call assertFalse(d%quantities(3)%conserved, "not about the origin")
        call assertFalse(d%quantities(4)%conserved, "the hill moves")
        call assertTrue(d%quantities(5)%conserved, "seen from the hill it does not")
        call own(plane//"Q_x = '0.1 exp(-((t - 5)/0.05)^2)' quantities = 'P = m x_dot', "// &
                 "'S = m y_dot'", "m = 2 k = 0 c = 0", system, d)
        call assertFalse(d%quantities(3)%conserved, "a kick")
        call assertTrue(d%quantities(4)%conserved, "across the kick")
        call own("coordinates = 'x', 'y' parameters = 'm', 'k', 'c' "// &
                 "T = 'm/2 (x_dot^2 + y_dot^2)' V = 'k tanh((sqrt(x^2 + y^2) - c)/0.01)' "// &
                 "quantities = "//spin//", 'P = m x_dot'", "m = 2 k = 3 c = 50", system, d)
        call assertTrue(d%quantities(3)%conserved, "round about the origin")
        call assertFalse(d%quantities(4)%conserved, "a step on a circle")
    end subroutine places_are_found

    subroutine constraints_are_kept()
        !! On a circle \(x\dot x + y\dot y = 0\) holds, and the energy is conserved where the
        !! velocities keep it; the angular momentum only without weight. That \(x^2 + y^2\) stays is
        !! due to the constraint alone.
        character(*), parameter :: circle = plane//"constraint = 'x^2 + y^2 = 1' quantities = "// &
            spin// &
            ", 'E = m/2 (x_dot^2 + y_dot^2) + c x + k/2 (x^2 + y^2)', 'R = x^2 + y^2'"
        class(system_t), allocatable :: system
        type(description_t) :: d

        call own(circle, round_values, system, d)
        if (anyExceptions()) return
        call assertEqual("L_z", trim(d%quantities(3)%name))
        call assertEqual("lambda1", trim(d%quantities(6)%name))
        call assertTrue(all(d%quantities(3:5)%conserved), "all three, without weight")
        call assertEqual(2.0_dp, system%quantity(3, 0.0_dp, [1.0_dp, 0.0_dp], [0.0_dp, 1.0_dp]), &
                         0.0_dp)
        call assertEqual(0.0_dp, system%quantity(7, 0.0_dp, [1.0_dp, 0.0_dp], [0.0_dp, 1.0_dp]), &
                         0.0_dp)
        call own(circle, "m = 2 k = 3 c = 9.81", system, d)
        call assertFalse(d%quantities(3)%conserved, "the weight turns it")
        call assertTrue(d%quantities(4)%conserved, "the energy stays")
        call assertTrue(d%quantities(5)%conserved, "the radius stays")
    end subroutine constraints_are_kept

    subroutine drift_has_a_size()
        !! Of a quantity that starts as the rounding of its terms, a drift is relative to these.
        character(*), parameter :: names(3) = [character(9) :: "L_z_drift", "D_drift", "p_x_drift"]
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(columns_t) :: columns
        type(error_t), allocatable :: error
        real(dp) :: row(3)

        call own(plane//"quantities = "//spin//", 'D = 0.3 - 0.2 - 0.1 + x y_dot - y x_dot'", &
                 "m = 2 k = 0 c = 0", system, d)
        if (anyExceptions()) return
        call new_columns(columns, names, system, .false., error)
        call assertFalse(allocated(error), "columns")
        if (anyExceptions()) return
        call columns%evaluate(system, 0.0_dp, [1.0_dp, 1.0_dp], [1.0_dp, 1.0_dp], 0.0_dp, row)
        call assertEqual([0.0_dp, 0.0_dp, 0.0_dp], row, 0.0_dp, "at the start")
        call columns%evaluate(system, 0.0_dp, [1.0_dp, 1.0_dp], [1.0_dp, 1.5_dp], 0.0_dp, row)
        call assertEqual([0.25_dp, 0.5_dp/2.6_dp, 0.0_dp], row, 4*epsilon(row), &
                         "relative to 4, 2.6, 2")
    end subroutine drift_has_a_size

    subroutine magnitudes()
        !! Each term in bars, sums in place of differences; at x = -2, y = 3.
        character(16), parameter :: texts(8) = [character(16) :: &
            "x + y", "y - 2 x", "x y - 5", "-(x + 1)/y", "(x + 1)^3 - 1", "sin(x) - y", &
                "1/(x + 1)", "x^2 - x"]
        real(dp), parameter :: expected(8) = [5.0_dp, 7.0_dp, 11.0_dp, 1.0_dp, 2.0_dp, &
                                              3.0_dp + sin(2.0_dp), 1.0_dp, 6.0_dp]
        type(symbols_t) :: symbols
        type(expression_t) :: formulas(8)
        type(formula_program_t) :: program
        type(error_t), allocatable :: error
        real(dp) :: values(8)
        integer :: i

        call symbols%add("x")
        call symbols%add("y")
        do i = 1, 8
            call parse_formula(trim(texts(i)), symbols, formulas(i), error)
            call assertFalse(allocated(error), texts(i))
            formulas(i) = magnitude(formulas(i))
        end do
        call new_formula_program(program, formulas, 2)
        call program%evaluate([-2.0_dp, 3.0_dp], values)
        call assertEqual(expected, values, 8*epsilon(values))
    end subroutine magnitudes

    subroutine audited()
        !! `check` reads the printed formula back, and looks whether it is conserved.
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(ledger_t) :: ledger
        integer :: i

        call own(plane//"quantities = "//spin//", 'A = L_z^2 - 1'", round_values, system, d)
        if (anyExceptions()) return
        call audit_system(system, ledger, [(.true., i=1, 3)], [2.0_dp, 3.0_dp, 0.0_dp])
        call assertEqual(0, ledger%broken())
        call assertTrue(ledger%row_of("L_z is conserved") > 0, "a row")
        call assertTrue(ledger%row_of("L_z as printed") > 0, "a row of the formula")
        call assertTrue(ledger%row_of("A as printed") > 0, "a row of one made of another")
        call turning(1e41_dp)
        call turning(1e31_dp)
        call turning(3e25_dp)
        call turning(-1e20_dp)
    contains
        subroutine turning(w)
            !! A plane that turns so fast (Foucault's, with a day of 1e-30 s) that the energy is a
            !! difference of terms which are larger still where its rate is taken.
            real(dp), intent(in) :: w
            type(ledger_t) :: rows
            integer :: k

            call own("coordinates = 'x', 'y' parameters = 'm', 'l', 'w' domain = 'm > 0', "// &
                     "'l > 0' T = 'm/2 (x_dot^2 + y_dot^2) + m w (x y_dot - y x_dot)' "// &
                     "V = 'm/(2 l) (x^2 + y^2)'", "m = 1 l = 2 w = 1", system, d)
            call audit_system(system, rows, [.false., .false., .true.], [1.0_dp, 2.0_dp, w])
            do k = 1, size(rows%rows)
                call assertTrue(rows%rows(k)%holds, trim(rows%rows(k)%name)//": "// &
                                trim(rows%rows(k)%remark))
            end do
        end subroutine turning
    end subroutine audited

    subroutine echoed()
        !! The texts as they were typed.
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        integer :: i

        call read_own(plane//"quantities = "//spin//", 's = x'", round_values, "q = 1, 0", scene, &
                      system, error)
        call assertFalse(allocated(error), "it is read")
        if (anyExceptions()) return
        i = findloc(index(scene%formulas, "quantities = "//spin) > 0, .true., 1)
        call assertTrue(i > 0, "the first")
        call assertTrue(any(index(scene%formulas, "'s = x'") > 0), "the second")
    end subroutine echoed

    subroutine refused(group, message)
        !! With this message, and the status of a wrong scene.
        character(*), intent(in) :: group, message
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error

        call read_own(plane//group, round_values, "q = 1, 0", scene, system, error)
        call assertTrue(allocated(error), group)
        if (.not. allocated(error)) return
        call assertEqual(message, error%message(index(error%message, "&"):), group)
        call assertEqual("a.nml:", error%message(:6), "the file is named")
        call assertEqual(status_usage, error%status, group)
    end subroutine refused

    subroutine refusals()
        character(*), parameter :: q = "&lagrangian: quantities"
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(columns_t) :: columns
        type(scene_t) :: scene
        type(error_t), allocatable :: error

        call refused("quantities = 'x y_dot'", q//" = 'x y_dot': a quantity is written "// &
                     "'L_z [kg m^2/s] angular momentum = m r^2 phi_dot'")
        call refused("quantities = '= x'", q// &
                     " = '= x': a name, its unit and a few words are written "// &
                     "'r [m] length of the spring'")
        call refused("quantities = 'L = '", q//": column 1: the formula is empty; write "// &
                     "one like m g l cos(theta)")
        call refused("quantities = 'L = x + z'", q// &
                     ": column 9: unknown name 'z'; there are t, x, y, "// &
                     "x_dot, y_dot, m, k, c, pi")
        call refused("quantities = 'L = x', 'L = y'", q// &
                     " = 'L = y': the name 'L' is given twice; "// &
                     "take another one")
        call refused("quantities = 'm = x'", q// &
                     " = 'm = x': the name 'm' is given twice; take another one")
        call refused("quantities = 'energy = x'", q// &
                     " = 'energy = x': two columns would be called 'energy', capital "// &
                     "letters aside; take other names")
        call refused("quantities = 'a = x', 'A = y'", q// &
                     " = 'A = y': two columns would be called 'a', capital "// &
                     "letters aside; take other names")
        call refused("quantities = 'x_dot = y'", q// &
                     " = 'x_dot = y': the name 'x_dot' is given twice; "// &
                     "take another one")
        call refused("quantities = 'a_name_that_is_much_too_long = x'", q//" = "// &
                     "'a_name_that_is_much_too_long = x': the name "// &
                     "'a_name_that_is_much_too_long' is longer than 26 characters; shorten it")
        call own(plane//"quantities = 'R = x^2'", round_values, system, d)
        call new_columns(columns, ["R_drift"], system, .false., error)
        call assertTrue(allocated(error), "a drift of what changes")
        if (allocated(error)) call assertEqual("column 'R_drift': R of "// &
            "this own is not conserved; "// &
                                               "there is 'R'", error%message)
        call read_own(plane//"quantities = 'R = x^2'", round_values, &
                      "q = 1, 0 expect_r_drift = 1", scene, &
                      system, error)
        call assertTrue(allocated(error), "a bound of what changes")
        if (allocated(error)) call assertEqual("a.nml:1:72: &scene: "// &
            "expect_r_drift = 1: R of this own is not "// &
                                               "conserved", error%message)
    end subroutine refusals

    subroutine longest_equations()
        !! With a multiplier they are printed up to `formula_length`, whole, or not at all.
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(description_t) :: d
        type(error_t), allocatable :: error
        type(word_t) :: none(0)
        character(:), allocatable :: equation, last
        integer :: extra

        do extra = -2, 2
            last = repeat("f", 11 + extra)
            equation = "x_ddot + "//joined(" + ")//" = lambda1"
            call assertEqual(formula_length + extra, len(equation), "as long as it should be")
            call parse_scene("&scene system='own' dt=0.1 duration=1 q=0,0 /"//nl//"&lagrangian "// &
                             "coordinates = 'x', 'y' parameters = '"//joined("', '")//"' L = "// &
                             "'x_dot^2/2 + y_dot^2/2 - ("//joined(" + ")//") x' constraint = "// &
                             "'x = y' /"//nl//"&own "//joined(" = 1, ")//" = 1 /", "a.nml", none, &
                             scene, system, error)
            call assertFalse(allocated(error), "a good scene")
            if (allocated(error)) return
            call system%describe(d)
            call assertEqual(merge(2, 0, extra <= 0), size(d%equations), "printed or not")
            if (size(d%equations) > 0) call assertEqual(equation, trim(d%equations(1)), "whole")
        end do
    contains
        function joined(mark) result(text)
            character(*), intent(in) :: mark
            character(:), allocatable :: text
            integer :: i

            text = ""
            do i = iachar("a"), iachar("e")
                text = text//repeat(achar(i), 31)//mark
            end do
            text = text//last
        end function joined
    end subroutine longest_equations
end module test_written_quantities
