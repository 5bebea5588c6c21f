module test_written_refusals
    !! What students write that is no system: each is refused in one line that says where, and what
    !! to write.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t, status_usage
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    use test_rare_refusals, only: rare_refusals_suite
    implicit none (type, external)
    private
    public :: written_refusals_suite

    character(*), parameter :: nl = new_line("a")
    character(*), parameter :: names = "coordinates = 'r', 'theta' parameters = 'm', 'k', 'g' "
    character(*), parameter :: energies = "T = 'm/2 (r_dot^2 + r^2 theta_dot^2)' "// &
                                          "V = 'k/2 r^2 - m g r cos(theta)' "
    character(*), parameter :: values = "m = 1 k = 4 g = 9.81"

contains

    function written_refusals_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("written_refusals")
        call suite%addTest(TestMethod("formulas_that_cannot_be_read", formulas_that_cannot_be_read))
        call suite%addTest(TestMethod("names_that_cannot_be", names_that_cannot_be))
        call suite%addTest(TestMethod("energies_that_are_no_system", energies_that_are_no_system))
        call suite%addTest(TestMethod("starts_without_motion", starts_without_motion))
        call suite%addTest(TestMethod("places_and_equilibria", places_and_equilibria))
        call suite%addTest(TestMethod("values_of_parameters", values_of_parameters))
        call suite%addTest(TestMethod("long_formulas", long_formulas))
        call suite%addTest(TestMethod("unused_parameters_are_said", unused_parameters_are_said))
        call suite%addTest(rare_refusals_suite())
    end function written_refusals_suite

    subroutine read_own(group, scene, error, parameters, start)
        !! The scene with this group `&lagrangian` on its second line.
        character(*), intent(in) :: group
        type(scene_t), intent(out) :: scene
        type(error_t), allocatable, intent(out) :: error
        character(*), intent(in), optional :: parameters, start
        class(system_t), allocatable :: system
        character(:), allocatable :: given, keys

        given = values
        if (present(parameters)) given = parameters
        keys = "q = 1.5, 0.5"
        if (present(start)) keys = start
        call parse_scene("&scene system = 'own' dt = 1e-2 duration = 1 "//keys//" /"//nl// &
                         "&lagrangian "//group//" /"//nl//"&own "//given//" /", "a.nml", &
                         [word_t ::], scene, system, error)
    end subroutine read_own

    subroutine blamed(group, token, message, parameters, start)
        !! With the place of the first `token` of the group before this message.
        character(*), intent(in) :: group, token, message
        character(*), intent(in), optional :: parameters, start

        call refused(group, "a.nml:2:"//to_text(len("&lagrangian ") + index(group, token))// &
                     ": &lagrangian: "//message, parameters, start)
    end subroutine blamed

    subroutine refused(group, message, parameters, start)
        !! With this message, and the status of a wrong scene.
        character(*), intent(in) :: group, message
        character(*), intent(in), optional :: parameters, start
        type(scene_t) :: scene
        type(error_t), allocatable :: error

        call read_own(group, scene, error, parameters, start)
        call assertTrue(allocated(error), group)
        if (.not. allocated(error)) return
        call assertEqual(message, error%message, group)
        call assertEqual(status_usage, error%status, group)
    end subroutine refused

    subroutine formulas_that_cannot_be_read()
        !! The place in the file is that of the column in the formula, also behind a letter of two
        !! bytes, a doubled quote, or in the second text of a formula.
        character(*), parameter :: t = names//"T = "
        character(*), parameter :: there = "; there are t, r, theta, r_dot, theta_dot, m, k, g, pi"

        call blamed(t//"'m r_dot^2 + sin m r'", "m r'", "T: column 17: 'sin' needs brackets; "// &
                    "write 'sin(m)'")
        call blamed(t//"'m (r_dot^2 + 2theta_dot^2)'", "2theta", "T: column 14: a blank is "// &
                    "missing in '2theta_dot'; write '2 theta_dot'")
        call blamed(t//"'m (r_dot^2' '+ thetadot^2)'", "thetadot", "T: column 14: unknown name "// &
                    "'thetadot'; did you mean 'theta_dot'?")
        call blamed(t//"'m (r_dot^2 +' 'thetadot^2)'", "thetadot", "T: column 14: unknown name "// &
                    "'thetadot'; did you mean 'theta_dot'?")
        call blamed(t//"'m r_dot^2 cos("//char(206)//char(184)//") + x'", "x'", "T: column 20: "// &
                    "unknown name 'x'"//there)
        call blamed(t//"'m r''''^2 '", "''''", "T: column 4: a prime is no derivative; "// &
                    "write r_ddot")
        call blamed(t//"'m ''''^2 r''s '", "''''", "T: column 3: a prime is no derivative; "// &
                    "write x_dot, x_ddot")
        call blamed(names//energies//"Q_theta = '-b theta_dot'", "b theta", "Q_theta: column "// &
                    "2: unknown name 'b'"//there)
        call blamed(names//energies//"Q_phi = '1'", "Q_phi", "unknown key 'q_phi'; allowed: "// &
                    "l, definitions, positions, equilibrium, constraint, quantities, domain, "// &
                    "rotors, q_r, q_theta")
    end subroutine formulas_that_cannot_be_read

    subroutine names_that_cannot_be()
        character(*), parameter :: behind = " T = 'r_dot^2'"
        character(*), parameter :: a_name = "a name, its unit and a few words are written "// &
                                            "'r [m] length of the spring'"

        call refused("coordinates = 'r', 'r'"//behind, "a.nml:2:32: &lagrangian: coordinates = "// &
                     "'r': the name 'r' is given twice; take another one")
        call refused("coordinates = 't'"//behind, "a.nml:2:27: &lagrangian: coordinates = 't': "// &
                     "'t' is the time; take another name")
        call refused("coordinates = 'pi'"//behind, "a.nml:2:27: &lagrangian: coordinates = "// &
                     "'pi': 'pi' is the number 3.14159...; take another name")
        call refused("coordinates = 'x_dot'"//behind, "a.nml:2:27: &lagrangian: coordinates = "// &
                     "'x_dot': 'x_dot' is the velocity of 'x'; take a name that does not end "// &
                     "in _dot")
        call refused("coordinates = 'x_ddot'"//behind, "a.nml:2:27: &lagrangian: coordinates = "// &
                     "'x_ddot': 'x_ddot' is the acceleration of 'x'; take a name that does "// &
                     "not end in _ddot")
        call refused("coordinates = 'r' parameters = 'r'"//behind, "a.nml:2:44: &lagrangian: "// &
                     "parameters = 'r': the name 'r' is given twice; take another one")
        call refused("coordinates = 'r' parameters = 'sin'"//behind, "a.nml:2:44: &lagrangian: "// &
                     "parameters = 'sin': 'sin' is a function; take another name")
        call refused("coordinates = 'r' parameters = 'm', 'M'"//behind, "a.nml:2:49: "// &
                     "&lagrangian: parameters = 'M': as a key it is the same as m, for "// &
                     "capital letters do not count; take another name")
        call refused("coordinates = 'r' definitions = 'r = 2'"//behind, "a.nml:2:45: "// &
                     "&lagrangian: definitions = 'r = 2': the name 'r' is given twice; take "// &
                     "another one")
        call refused("coordinates = 'energy' T = 'energy_dot^2'", "a.nml:2:27: &lagrangian: "// &
                     "coordinates = 'energy': two columns would be called 'energy', capital "// &
                     "letters aside; take other names", "")
        call refused("parameters = 'm' T = 'm'", "a.nml:2:1: &lagrangian: coordinates is "// &
                     "missing; write coordinates = value")
        call refused("coordinates = 'r, theta'"//behind, "a.nml:2:27: &lagrangian: coordinates "// &
                     "= 'r, theta': 'r,' is no name for a formula; write letters, digits and "// &
                     "underscores, a letter first, as in theta1")
        call refused("coordinates = '[m] place'"//behind, "a.nml:2:27: &lagrangian: "// &
                     "coordinates = '[m] place': "//a_name)
        call refused("coordinates = '"//repeat("r", 33)//"'"//behind, "a.nml:2:27: "// &
                     "&lagrangian: coordinates = '"//repeat("r", 33)//"': "//a_name)
    end subroutine names_that_cannot_be

    subroutine energies_that_are_no_system()
        call blamed(names//energies//"L = 'm r_dot^2'", "'m r_dot", "L = "// &
                    "'m r_dot^2': give either L, or T and V: L is T - V")
        call refused(names//"V = 'r'", "a.nml:2:1: &lagrangian: t: is missing; write T = "// &
                     "'m/2 x_dot^2', or L, which is T - V, or positions with their masses")
        call refused(names//"T = 'm/2 r_dot^2'", "a.nml:2:32: &lagrangian: coordinates = "// &
                     "'theta': L has no theta_dot in it, so that the mass matrix is singular "// &
                     "and nothing says how theta moves; give T a term with theta_dot^2, or "// &
                     "leave theta out")
        call refused(names//"T = 'm/2 (r_dot + theta_dot)^2'", "a.nml:2:71: &lagrangian: T = "// &
                     "'m/2 (r_dot + theta_dot)^2': the mass matrix d2L/dv dv is singular: it "// &
                     "has the eigenvalue 0.0 beside 2.0, at t = 0.0, q = 1.5, 0.5, v = 0.0, "// &
                     "0.0 and elsewhere: a combination of velocities has no inertia, or a "// &
                     "negative one")
    end subroutine energies_that_are_no_system

    subroutine starts_without_motion()
        call refused(names//energies//"", "a.nml:1:50: &scene: q = 0: the mass matrix d2L/dv "// &
                     "dv is singular: it has the eigenvalue 0.0 beside 1.0, at t = 0.0, "// &
                     "q = 0.0, 0.5, v = 0.0, 0.0; start elsewhere, or take other coordinates", &
                     start="q = 0, 0.5")
        call refused(names//"T = 'm/2 (r_dot^2 + theta_dot^2)' V = 'k/(r - 1.5)'", &
                     "a.nml:2:105: &lagrangian: V = 'k/(r - 1.5)': is no finite number at "// &
                     "t = 0.0, q = 1.5, 0.5, v = 0.0, 0.0: a division by zero, an overflow, or "// &
                     "a root or logarithm of such a number; start elsewhere")
        call refused(names//"T = 'm/2 (r_dot^2 + theta_dot^2)' V = 'sqrt(r - 1.5)'", &
                     "a.nml:2:105: &lagrangian: V = 'sqrt(r - 1.5)': has no finite derivatives "// &
                     "by r at t = 0.0, q = 1.5, 0.5, v = 0.0, 0.0; start elsewhere")
    end subroutine starts_without_motion

    subroutine places_and_equilibria()
        character(*), parameter :: group = names//energies
        character(*), parameter :: syntax = "': a place is written 'bob: x, y' or 'bob: x, y, "// &
                                            "z', with its mass 'bob, m: x, y'"
        character(20), parameter :: wrong(8) = [character(20) :: "bob", "bob: r", ": r, r", &
            "bob: r, r, r, r", "bob m: r, r", ", m: r, r", "bob: r, r,", "my-bob: r, r"]
        integer :: i

        do i = 1, size(wrong)
            call refused(group//"positions = '"//trim(wrong(i))//"'", "a.nml:2:150: "// &
                         "&lagrangian: positions = '"//trim(wrong(i))//syntax)
            if (anyExceptions()) return
        end do
        call refused(group//"positions = 'bob, theta: r, r'", "a.nml:2:150: &lagrangian: "// &
                     "positions = 'bob, theta: r, r': the mass depends on theta, which is not "// &
                     "allowed: parameters and numbers only")
        call refused(group//"positions = 'bob: r, r_dot'", "a.nml:2:150: &lagrangian: "// &
                     "positions = 'bob: r, r_dot': a place depends on r_dot, which is not "// &
                     "allowed: the time, coordinates and parameters")
        call refused(group//"positions = 'bob: r, y'", "a.nml:2:159: &lagrangian: positions: "// &
                     "column 9: unknown name 'y'; there are t, r, theta, r_dot, theta_dot, m, "// &
                     "k, g, pi")
        call refused(group//"positions = 'a: r, r', 'a: r, r'", "a.nml:2:150: &lagrangian: "// &
                     "positions = 'a: r, r': two columns would be called 'x_a', capital "// &
                     "letters aside; take other names")
        call refused(group//"equilibrium = '0'", "a.nml:2:152: &lagrangian: equilibrium = '0': "// &
                     "an equilibrium has one formula for each coordinate: 2, not 1")
        call refused(group//"equilibrium = 'r', '0'", "a.nml:2:152: &lagrangian: equilibrium = "// &
                     "'r': an equilibrium depends on r, which is not allowed: parameters and "// &
                     "numbers only")
    end subroutine places_and_equilibria

    subroutine values_of_parameters()
        call refused(names//energies, "a.nml:3:1: &own: g is missing; write g = value", &
                     "m = 1 k = 4")
        call refused(names//energies, "a.nml:3:27: &own: unknown key 'b'; there are m, k, g; "// &
                     "parameters are named in &lagrangian: parameters", values//" b = 2")
        call refused(names//energies, "a.nml:3:10: &own: m = '1': a number is needed, without "// &
                     "quotes", "m = '1' k = 4 g = 9.81")
    end subroutine values_of_parameters

    subroutine long_formulas()
        !! 10,000 characters are read, also without blanks, and make the same scene again; more
        !! are not.
        type(scene_t) :: scene, again
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        character(:), allocatable :: text
        integer :: i

        call read_own(names//"T = 'm/2 (r_dot^2 + theta_dot^2)' V = 'r"// &
                      repeat("+1e-3*r", 1428)//"'", scene, error)
        if (allocated(error)) call assertEqual("", error%message)
        if (anyExceptions()) return
        text = "&scene system = 'own' dt = 1e-2 duration = 1 q = 1.5, 0.5 /"//nl
        do i = 1, size(scene%formulas)
            text = text//trim(scene%formulas(i))//nl
            call assertTrue(len_trim(scene%formulas(i)) <= 110, "lines are short")
        end do
        call parse_scene(text//"&own "//values//" /", "b.nml", [word_t ::], again, system, error)
        if (allocated(error)) call assertEqual("", error%message)
        if (anyExceptions()) return
        call assertEqual(scene%formulas, again%formulas)
        call refused(names//"T = 'm/2 (r_dot^2 + theta_dot^2)' V = 'r"//repeat(" + r", 2500)// &
                     "'", "a.nml:2:105: &lagrangian: V = 'r + r + r + r + r + r + r + r + r "// &
                     "+ r +...: a text of at most 10000 characters is needed")
        call refused(names//"T = 'm/2 (r_dot^2 + theta_dot^2)' V = 'r"//repeat(" + r", 2000)// &
                     "' 'r"//repeat(" + r", 1000)//"'", "a.nml:2:105: &lagrangian: V = 'r + "// &
                     "r + r + r + r + r + r + r + r + r +...: a formula has at most 10000 "// &
                     "characters")
    end subroutine long_formulas

    subroutine unused_parameters_are_said()
        !! A parameter in no formula is no error, but not passed over either.
        type(scene_t) :: scene
        type(error_t), allocatable :: error

        call read_own("coordinates = 'r' parameters = 'm', 'b', 'k', 'c' definitions = "// &
                      "'D = c r' T = 'm r_dot^2' Q_r = '-k'", scene, error, &
                      "m = 1 b = 2 k = 3 c = 4", "q = 1")
        if (allocated(error)) call assertEqual("", error%message)
        if (anyExceptions()) return
        call assertEqual("no formula contains b, c", scene%warning)
        call read_own(names//energies, scene, error)
        call assertFalse(allocated(scene%warning), "all are used")
    end subroutine unused_parameters_are_said
end module test_written_refusals
