module test_sizes_of_motions
    !! Systems in formulas in SI units of atoms and planets: sizes far from 1.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_grading, only: grade, grade_t
    use lagrangia_homework, only: homework_t, parse_homework
    use lagrangia_judgement, only: is_right, is_wrong
    use lagrangia_kinds, only: dp
    use lagrangia_random_draws, only: random_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_small_oscillations, only: find_modes, modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: sizes_of_motions_suite

    character, parameter :: line_feed = new_line("a")
    character(*), parameter :: atom = "q = 5.29e-11, 0, v = 0, 4.13e16 /"//line_feed// &
        "&lagrangian coordinates = 'r', 'phi', parameters = 'm', 'k', "// &
        "T = 'm/2 (r_dot^2 + r^2 phi_dot^2)', V = '-k/r' /"//line_feed// &
        "&own m = 9.109e-31, k = 2.307e-28 /"
    character(*), parameter :: planet = "q = 1.471e11, 0, v = 0, 2.059e-7 /"//line_feed// &
        "&lagrangian coordinates = 'r', 'phi', parameters = 'm', 'k', "// &
        "T = 'm/2 (r_dot^2 + r^2 phi_dot^2)', V = '-k/r' /"//line_feed// &
        "&own m = 5.972e24, k = 7.93e44 /"
    character(*), parameter :: pair = "q = 4e-10, v = 0 /"//line_feed// &
        "&lagrangian coordinates = 'r', parameters = 'm', 'eps', 's', T = 'm/2 r_dot^2', "// &
        "V = '4 eps ((s/r)^12 - (s/r)^6)', equilibrium = '1.1 s' /"//line_feed// &
        "&own m = 3.3e-26, eps = 1.65e-21, s = 3.4e-10 /"
    character(*), parameter :: yo_yo = "q = 0, 0, v = 0, 0 /"//line_feed// &
        "&lagrangian coordinates = 'y', 'phi', parameters = 'm', 'I', 'a', 'g', "// &
        "T = 'm/2 y_dot^2 + I/2 phi_dot^2', V = '-m g y', constraint = 'y = a phi' /"// &
        line_feed//"&own m = 1, I = 0.02, a = 0.05, g = 9.81 /"
    character(*), parameter :: molecule = "q = 1.2e-10, 0.1, 0.2, v = 3*0 /"//line_feed// &
        "&lagrangian coordinates = 'r', 'theta1', 'theta2', "// &
        "parameters = 'm', 'k', 'l0', 'D', 'I', "// &
        "T = 'm/2 (r_dot^2 + r^2 theta1_dot^2) + I/2 theta2_dot^2', "// &
        "V = 'k/2 (r - l0)^2 + D (1 - cos(theta1)) + D (1 - cos(theta2 - theta1))' /"// &
        line_feed//"&own m = 1.67e-27, k = 500, l0 = 1e-10, D = 4e-19, I = 1e-46 /"

contains

    function sizes_of_motions_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("sizes_of_motions")
        call suite%addTest(TestMethod("masses_and_moments", masses_and_moments))
        call suite%addTest(TestMethod("sizes_are_found", sizes_are_found))
        call suite%addTest(TestMethod("equilibria_to_their_last_digit", &
                                      equilibria_to_their_last_digit))
        call suite%addTest(TestMethod("no_term_hides_another", no_term_hides_another))
        call suite%addTest(TestMethod("typical_sizes_are_those_of_near_parameters", &
                                      typical_sizes_are_those_of_near_parameters))
    end function sizes_of_motions_suite

    subroutine read_typed(rest, system, error)
        !! The system of a scene whose first keys are given.
        character(*), intent(in) :: rest
        class(system_t), allocatable, intent(out) :: system
        type(error_t), allocatable, intent(out) :: error
        type(scene_t) :: scene
        type(word_t) :: none(0)

        call parse_scene("&scene dt = 1, duration = 1, system = 'own', "//rest//line_feed, &
                         "scene", none, scene, system, error)
    end subroutine read_typed

    subroutine masses_and_moments()
        !! \(m\) beside \(m r^2\) is not singular, and \(m\) beside 0 is.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        call read_typed(atom, system, error)
        call assertFalse(allocated(error), "an electron")
        call read_typed(planet, system, error)
        call assertFalse(allocated(error), "a planet")
        call read_typed("q = 0"//atom(index(atom, ", 0"):), system, error)
        call assertTrue(allocated(error), "at r = 0")
    end subroutine masses_and_moments

    subroutine sizes_are_found()
        !! Within a factor of 2 of \(r\), and of the time that \(r \phi_dot^2\) gives; states are
        !! drawn in them, and those of other parameters are not.
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        type(random_t) :: random
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t

        call read_typed(atom, system, error)
        if (.not. allocated(error)) call system%describe(d)
        call assertTrue(allocated(d%typical_places), "sizes of an atom")
        if (.not. allocated(d%typical_places)) return
        call assertTrue(abs(log(d%typical_places(1)/5.29e-11_dp)) < log(2.0_dp), "of r")
        call assertEqual(1.0_dp, d%typical_places(2), 0.0_dp, "of an angle")
        call assertTrue(abs(log(d%typical_time*4.13e16_dp)) < log(2.0_dp), "of the time")
        call random%state(system, t, q, v, error)
        call assertTrue(maxval(abs(q)) <= 3.0_dp .and. abs(q(1)) < 3e-10_dp, "places")
        call assertTrue(abs(v(2)) > 1e12_dp .and. abs(v(2)) < 3e17_dp, "velocities")
        call assertTrue(abs(t) < 1e-15_dp, "times")
        call system%configure([1.0_dp, 1.0_dp], error)
        call system%describe(d)
        call assertFalse(allocated(d%typical_places), "of other parameters")
        call read_typed(yo_yo, system, error)
        if (.not. allocated(error)) call system%describe(d)
        call assertFalse(allocated(d%typical_places), "at rest at zero nothing tells a size")
        call assertEqual(1.0_dp, d%typical_time, 0.0_dp, "nor a time")
    end subroutine sizes_are_found

    subroutine equilibria_to_their_last_digit()
        !! \(r = 2^{1/6}s\), \(\omega^2 = 72\,2^{-1/3}\epsilon/(m s^2)\) of two atoms.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(modes_t) :: modes
        real(dp) :: r, omega2

        call read_typed(pair, system, error)
        if (.not. allocated(error)) call find_modes(system, [3.7e-10_dp], .false., modes, error)
        call assertFalse(allocated(error), "two atoms")
        if (allocated(error)) return
        r = 2.0_dp**(1/6.0_dp)*3.4e-10_dp
        omega2 = 72*2.0_dp**(-1/3.0_dp)*1.65e-21_dp/3.3e-26_dp/3.4e-10_dp**2
        call assertEqual(1.0_dp, modes%at(1)/r, 1e-14_dp, "r")
        call assertEqual(1.0_dp, modes%omega2(1)/omega2, 1e-12_dp, "omega^2")
    end subroutine equilibria_to_their_last_digit

    subroutine no_term_hides_another()
        !! An energy without one of its terms is wrong, and which one is said.
        call judged("E = m/2 (r_dot^2 + r^2 theta1_dot^2) + I/2 theta2_dot^2 + k/2 (r - l0)^2 "// &
                    "+ D (1 - cos(theta1)) + D (1 - cos(theta2 - theta1))", is_right, "")
        call judged("E = m/2 (r_dot^2 + r^2 theta1_dot^2) + I/2 theta2_dot^2 + k/2 (r - l0)^2 "// &
                    "+ D (1 - cos(theta1))", is_wrong, "missing D (1 - cos(theta2 - theta1))")
        call judged("E = m/2 (r_dot^2 + r^2 theta1_dot^2) + k/2 (r - l0)^2 "// &
                    "+ D (1 - cos(theta1)) + D (1 - cos(theta2 - theta1))", is_wrong, &
                    "missing I/2 theta2_dot^2")
        call judged("m r^2 theta1_ddot + D sin(theta1) - D sin(theta2 - theta1) = 0", is_wrong, &
                    "missing 2 m r r_dot theta1_dot")
        call judged("V = k/2 (r - l0)^2 - D cos(theta1) - D cos(theta2 - theta1)", is_right, "")
    end subroutine no_term_hides_another

    subroutine judged(statement, verdict, words)
        !! Of the molecule.
        character(*), intent(in) :: statement, words
        integer, intent(in) :: verdict
        class(system_t), allocatable :: system
        type(homework_t) :: homework
        type(grade_t) :: result
        type(error_t), allocatable :: error

        call read_typed(molecule, system, error)
        if (.not. allocated(error)) call parse_homework("system: own"//line_feed//statement, &
                                                        "sheet", homework, error)
        if (.not. allocated(error)) call grade(homework, system, result, error)
        call assertFalse(allocated(error), statement)
        if (allocated(error)) return
        call assertEqual(verdict, result%of(1)%verdict, statement)
        call assertTrue(index(result%of(1)%remark, words) > 0, result%of(1)%remark)
    end subroutine judged

    subroutine typical_sizes_are_those_of_near_parameters()
        !! Up to four times, or a quarter, of each parameter of the scene.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(scene_t) :: scene
        type(word_t) :: none(0)

        call parse_scene("&scene system = 'o', dt = 1, duration = 1, q = 1e-6 / &lagrangian "// &
                         "coordinates = 'x', parameters = 'm', 'k', "// &
                         "L = 'm/2 x_dot^2 - k/2 x^2' / &o m = 1, k = 1 /", "text", none, scene, &
                         system, error)
        call assertFalse(allocated(error), "an oscillator")
        if (allocated(error)) return
        call judge([1.0_dp, 1.0_dp], .true.)
        call judge([2.0_dp, 2.0_dp], .true.)
        call judge([1.0_dp, 8.0_dp], .false.)
        call judge([0.1_dp, 1.0_dp], .false.)
        call judge([1.0_dp, 1.0_dp], .true.)
    contains
        subroutine judge(values, known)
            real(dp), intent(in) :: values(:)
            logical, intent(in) :: known
            type(description_t) :: d

            call system%configure(values, error)
            call system%describe(d)
            call assertTrue(allocated(d%typical_places) .eqv. known, "typical places")
            if (known) call assertEqual(0.5_dp**20, d%typical_places(1), tolerance=0.0_dp, &
                                        message="a power of two")
        end subroutine judge
    end subroutine typical_sizes_are_those_of_near_parameters
end module test_sizes_of_motions
