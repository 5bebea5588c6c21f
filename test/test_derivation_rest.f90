module test_derivation_rest
    !! Derivations about places that are not zero, and with forces beside L: what is printed, and
    !! beside the program's numbers for parameters drawn at random.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_damped_rates, only: damped_rates
    use lagrangia_derivation, only: derivation_t
    use lagrangia_derivation_numbers, only: comparison_t, compare_lines
    use lagrangia_derivation_steps, only: derive, slip_in_formula_t
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: constant, expression_t, operator(*), operator(+), operator(-), &
                                    symbol, whole
    use lagrangia_kinds, only: dp, qp
    use lagrangia_random_draws, only: random_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_small_oscillations, only: find_modes, likely_equilibrium, modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    use stated_text, only: is_said
    implicit none (type, external)
    private
    public :: derivation_rest_suite

    character, parameter :: line_feed = new_line("a")
    character(*), parameter :: one = "coordinates = 'x' ", two = "coordinates = 'x', 'y' "
    character(*), parameter :: three = "coordinates = 'x', 'y', 'z' "

contains

    function derivation_rest_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("derivation_rest")
        call suite%addTest(TestMethod("drag_of_one_coordinate", drag_of_one_coordinate))
        call suite%addTest(TestMethod("rates_far_apart", rates_far_apart))
        call suite%addTest(TestMethod("drag_of_two", drag_of_two))
        call suite%addTest(TestMethod("one_of_three_is_unstable", one_of_three_is_unstable))
        call suite%addTest(TestMethod("places_that_are_not_zero", places_that_are_not_zero))
        call suite%addTest(TestMethod("places_are_refused", places_are_refused))
        call suite%addTest(TestMethod("no_such_angle", no_such_angle))
        call suite%addTest(TestMethod("points_without_masses", points_without_masses))
        call suite%addTest(TestMethod("a_slip_is_seen", a_slip_is_seen))
        call suite%addTest(TestMethod("forces_of_places_count", forces_of_places_count))
        call suite%addTest(TestMethod("pi_stays_a_letter", pi_stays_a_letter))
        call suite%addTest(TestMethod("constraints_of_coupled_masses", &
                                      constraints_of_coupled_masses))
        call suite%addTest(TestMethod("a_force_without_stiffness_has_no_place", &
                                      a_force_without_stiffness_has_no_place))
        call suite%addTest(TestMethod("what_turns_as_it_grows", what_turns_as_it_grows))
        call suite%addTest(TestMethod("what_is_far_away_counts", what_is_far_away_counts))
    end function derivation_rest_suite

    subroutine constraints_of_coupled_masses()
        !! The right sides of M q_ddot = f have the forces of constraint in them.
        call holds(two//"T = 'm x_dot^2 + m/2 y_dot^2 + m/2 x_dot y_dot' V = '-k x' "// &
                   "constraint = 'x = 2 y'", "M12 = m/2|f1 = k + lambda1|f2 = -2 lambda1")
    end subroutine constraints_of_coupled_masses

    subroutine a_force_without_stiffness_has_no_place()
        !! On an incline; two masses on a spring that fall; a pulley beside a pendulum. The same
        !! springs without such a force have their zero mode.
        call places(two//"T = 'm/2 (x_dot^2 + y_dot^2)' V = 'k/2 y^2 - m b x'", .false.)
        call places(two//"T = 'm/2 (x_dot^2 + y_dot^2)' V = 'k/2 (x - y)^2 + b (x + y)'", .false.)
        call places(two//"T = 'm/2 (x_dot^2 + x^2 y_dot^2)' V = 'k x - b x cos(y)' "// &
                    "equilibrium = '1', '0'", .false.)
        call places(two//"T = 'm/2 (x_dot^2 + y_dot^2)' V = 'k/2 (x - y)^2 + b (x - y)'", .true.)
        call places(two//"T = 'm/2 (x_dot^2 + y_dot^2)' V = 'k/2 (x - y)^2'", .true.)
    contains
        subroutine places(formulas, expected)
            character(*), intent(in) :: formulas
            logical, intent(in) :: expected
            class(system_t), allocatable :: system
            type(modes_t) :: modes
            type(error_t), allocatable :: error
            integer :: wanted

            call make(formulas, system, error)
            if (allocated(error)) return
            do wanted = 0, 1
                call find_modes(system, likely_equilibrium(system), wanted == 1, modes, error)
                if (expected .and. wanted == 1) cycle  ! zero need not be the place
                call assertTrue(expected .neqv. allocated(error), formulas)
                if (expected .or. .not. allocated(error)) cycle
                call assertTrue(index(error%message, "; none is near") > 0, error%message)
            end do
        end subroutine places
    end subroutine a_force_without_stiffness_has_no_place

    subroutine what_is_far_away_counts()
        !! Rough ground and a wall that begin at 20 m, a kick after 30 s: near the origin and at
        !! first there is no trace of them in a double.
        character(*), parameter :: formulas(3) = [character(90) :: &
            one//"T = 'm/2 x_dot^2' Q_x = '-b x_dot (1 + tanh(5 (x - 20)))/2'", &
            one//"T = 'm/2 x_dot^2' V = 'k/8 (|x - 20| + x - 20)^2'", &
            one//"T = 'm/2 x_dot^2' V = 'k/2 x^2' Q_x = 'b exp(-(t - 30)^2)'"]
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, size(formulas)
            call make(trim(formulas(i))//" ", system, error)
            if (allocated(error)) return
            call assertEqual(0, system%cyclic, message=formulas(i))
            call assertTrue(system%nonconservative .eqv. i /= 2, formulas(i))
            call assertTrue(system%velocity_forces .eqv. i == 1, formulas(i))
            call assertTrue(system%time_dependent .eqv. i == 3, formulas(i))
        end do
    end subroutine what_is_far_away_counts

    subroutine what_turns_as_it_grows()
        !! A hill that rotates with w: \(\lambda = \pm\sqrt{k/m - w^2} \pm iw\), and
        !! \(\omega^2\), which is complex then, is compared with no real number.
        character(*), parameter :: hill = two//"T = 'm/2 (x_dot^2 + y_dot^2) + "// &
            "m w (x y_dot - y x_dot)' V = '-k/2 (x^2 + y^2)'"
        class(system_t), allocatable :: system
        type(modes_t) :: modes
        type(error_t), allocatable :: error
        integer :: j

        call holds(hill, "V = -k/2 (x^2 + y^2)")
        call make(hill, system, error)
        if (allocated(error)) return
        call find_modes(system, [0.0_dp, 0.0_dp], .true., modes, error)
        call assertFalse(allocated(error), "modes")
        if (allocated(error)) return
        do j = 1, 2
            call assertTrue(modes%turning(j) > 0.0_dp, "turns")
            call assertEqual(0.4_dp, modes%turning(j), 1e-14_dp, "w")
            call assertEqual(-(2.0_dp/1.3_dp - 0.16_dp), modes%omega2(j), 1e-13_dp, "growth")
        end do
    end subroutine what_turns_as_it_grows

    subroutine pi_stays_a_letter()
        !! Also where it is squared, and behind a sign.
        call holds(two//"T = 'm/2 (x_dot^2 + y_dot^2) + 2 pi m/w (x y_dot - y x_dot)' "// &
                   "V = '(k + (-pi)^2) (x^2 + y^2)/2'", "dL/dx_dot = m x_dot - 2 pi m/w y|"// &
                   "d/dt dL/dx_dot = m x_ddot - 2 pi m/w y_dot|"// &
                   "L = T - V = m/2 x_dot^2 + m/2 y_dot^2 + 2 pi m/w x y_dot - 2 pi m/w y x_dot"// &
                   " - (k + pi^2)/2 x^2 - (k + pi^2)/2 y^2")
    end subroutine pi_stays_a_letter

    subroutine make(formulas, system, error)
        !! With positive parameters m, k, b, w.
        character(*), intent(in) :: formulas
        class(system_t), allocatable, intent(out) :: system
        type(error_t), allocatable, intent(out) :: error
        type(scene_t) :: scene
        type(word_t) :: none(0)
        character(:), allocatable :: start

        start = "1.0"
        if (index(formulas, two) == 1 .or. index(formulas, "'r', 'theta'") > 0) start = "1.0, 0.5"
        if (index(formulas, three) == 1) start = "1.0, 0.5, 0.3"
        call parse_scene("&scene system = 'own' dt = 0.1 duration = 1.0 q = "//start//" /"// &
                         line_feed//"&lagrangian "//formulas//" parameters = 'm', 'k', 'b', "// &
                         "'w' domain = 'm > 0', 'k > 0', 'b > 0', 'w > 0' /"//line_feed// &
                         "&own m = 1.3, k = 2.0, b = 0.3, w = 0.4 /"//line_feed, "own.nml", none, &
                         scene, system, error)
        if (allocated(error)) call assertEqual("", error%message)
    end subroutine make

    subroutine holds(formulas, expected)
        !! The lines between bars are there, and every line agrees, of 20 draws.
        character(*), intent(in) :: formulas, expected
        class(system_t), allocatable :: system
        type(derivation_t) :: derivation
        type(slip_in_formula_t) :: none
        type(comparison_t), allocatable :: c(:)
        type(random_t) :: random
        type(error_t), allocatable :: error
        real(dp), allocatable :: values(:)
        character(:), allocatable :: all, rest
        integer :: draw, i

        call make(formulas, system, error)
        if (allocated(error)) return
        call derive(system, none, derivation, error)
        call assertFalse(allocated(error), message="derived: "//formulas)
        if (allocated(error)) return
        all = line_feed
        do i = 1, derivation%count
            all = all//derivation%line_text(i)//line_feed
        end do
        rest = expected//"|"
        do while (rest /= "")
            i = index(rest, "|")
            call assertTrue(index(all, line_feed//rest(:i - 1)//line_feed) > 0, &
                            message=rest(:i - 1)//" is not in"//all)
            rest = rest(i + 1:)
        end do
        do draw = 1, 20
            call compare_lines(derivation, system, random, c, error)
            call assertFalse(allocated(error), message="compared: "//formulas)
            if (allocated(error)) return
            do i = 1, derivation%count
                call assertTrue(c(i)%agrees(), message=derivation%line_text(i)//" of "//formulas)
            end do
            call random%parameters(system, .false., values, error)
            call derive(system, none, derivation, error)
        end do
    end subroutine holds

    subroutine drag_of_one_coordinate()
        !! The closed form of the damped oscillator; with too much drag \(\omega^2 < 0\), and q
        !! is the sum of two exponentials, whose rates are LAPACK's; without a spring one of them
        !! is 0. Critical: \(m\omega^2 = m/4 - m/4\).
        call holds(one//"T = 'm/2 x_dot^2' V = 'k/2 x^2' Q_x = '-b x_dot'", &
                   "C = b|q goes as exp(-gamma t) cos(omega t): omega^2 > 0 at these parameters"// &
                   ", underdamped|gamma = b/(2 m)|omega^2 = k/m - (b/(2 m))^2")
        call holds(one//"T = 'm/2 x_dot^2' V = 'k/2 x^2' Q_x = '-19 b x_dot'", &
                   "q goes as A exp(-gamma_1 t) + B exp(-gamma_2 t): omega^2 < 0 at these "// &
                   "parameters, overdamped|gamma = 19 b/(2 m)|omega^2 = k/m - (19 b/(2 m))^2|"// &
                   "gamma_1 = k/m/(19 b/(2 m) + sqrt((19 b/(2 m))^2 - k/m))|"// &
                   "gamma_2 = 19 b/(2 m) + sqrt((19 b/(2 m))^2 - k/m)")
        call holds(one//"T = 'm/2 x_dot^2' V = 'm/8 x^2' Q_x = '-m x_dot'", &
                   "q goes as (A + B t) exp(-gamma t): omega^2 = 0 at these parameters, "// &
                   "critically damped|gamma = 1/2")
        call holds(one//"T = 'm/2 x_dot^2' Q_x = '-b x_dot'", "gamma_1 = 0|gamma_2 = b/m")
        call holds(one//"T = 'm/2 x_dot^2' V = '-k/2 x^2' Q_x = '-b x_dot'", &
                   "q goes as A exp(-gamma_1 t) + B exp(-gamma_2 t): omega^2 < 0 at these "// &
                   "parameters|gamma_1 = (-k/m)/(b/(2 m) + sqrt((b/(2 m))^2 + k/m))")
        call holds(one//"T = 'm/2 x_dot^2' Q_x = 'k x'", &
                   "gamma_1 = -sqrt(k/m)|gamma_2 = sqrt(k/m)")
        call holds(one//"T = 'm/2 x_dot^2' Q_x = '-k x - b x_dot + b x x_dot^2'", &
                   "K = k|C = b|gamma = b/(2 m)|omega^2 = k/m - (b/(2 m))^2")
        call holds(one//"T = 'm/2 x_dot^2' Q_x = '-k x'", &
                   "K = k|q goes as exp(-gamma t) cos(omega t): omega^2 > 0 at these parameters"// &
                   "|gamma = 0|omega^2 = k/m")
    end subroutine drag_of_one_coordinate

    subroutine rates_far_apart()
        !! Of m = k = 1 the formula and LAPACK's root are both the exact rate, in quadruple
        !! precision, to rounding; with the other sign of b they grow.
        type(derivation_t) :: derivation
        type(slip_in_formula_t) :: none
        type(comparison_t), allocatable :: c(:)
        class(system_t), allocatable :: system
        type(random_t) :: random
        type(error_t), allocatable :: error
        real(qp) :: root, rates(2)
        integer :: i, decade, sign_of

        do sign_of = -1, 1, 2
            call make(one//"T = 'm/2 x_dot^2' V = 'k/2 x^2' Q_x = '"// &
                      trim(merge("-b x_dot", "b x_dot ", sign_of == 1))//"'", system, error)
            if (allocated(error)) return
            do decade = 1, 8
                call system%configure([1.0_dp, 1.0_dp, 2.0_dp*10.0_dp**decade, 1.0_dp], error)
                call derive(system, none, derivation, error)
                call compare_lines(derivation, system, random, c, error)
                call assertFalse(allocated(error), message="compared")
                root = sqrt(100.0_qp**decade - 1)
                rates = sign_of*[1/(10.0_qp**decade + root), 10.0_qp**decade + root]
                if (sign_of == -1) rates = rates(2:1:-1)
                do i = 1, 2
                    associate (last => c(derivation%count - 2 + i))
                        call assertTrue(abs(last%formula/rates(i) - 1) < 1e-14_qp .and. &
                                        abs(last%program/rates(i) - 1) < 1e-14_qp .and. &
                                        last%noise < 1e-10_dp*abs(rates(i)), message="a rate")
                    end associate
                end do
            end do
        end do
    end subroutine rates_far_apart

    subroutine drag_of_two()
        !! The polynomial of the rates, with G and forces that are not symmetric; letters that are
        !! called lambda and omega.
        call holds(two//"T = 'm/2 (x_dot^2 + y_dot^2)' V = 'k/2 (x^2 + (x - y)^2 + y^2)' "// &
                   "Q_x = '-b x_dot' Q_y = '-b y_dot'", &
                   "C11 = b|C22 = b|q goes as exp(lambda t): det(lambda^2 M + lambda C + K) = 0")
        call holds(two//"T = 'm/2 (x_dot^2 + 3 y_dot^2) + w m x y_dot' "// &
                   "definitions = 'lambda = k/m', 'omega = k' "// &
                   "V = 'lambda m/2 (x^2 + x y + y^2) + omega x y/3' "// &
                   "Q_x = '-b x_dot' Q_y = '-b (y_dot - x_dot) - k x/3'", "B12 = -m w|B22 = b|"// &
                   "q goes as exp(Lambda t): det(Lambda^2 M + Lambda B + K) = 0")
        call holds(two//"T = 'm/2 ((x_dot - w y)^2 + (y_dot + w x)^2)'", "omega^2 = w^2")
    end subroutine drag_of_two

    subroutine one_of_three_is_unstable()
        !! The polynomial of \(\omega^2\) holds where \(\omega\) is imaginary, too.
        call holds(three//"T = 'm/2 (x_dot^2 + 2 y_dot^2 + 3 z_dot^2 + x_dot y_dot)' "// &
                   "V = 'k/2 (x^2 + 2 y^2 - 3 z^2 + x z)'", "K33 = -3 k|"// &
                   "21 m^3 omega^6 - 27 m^2 k omega^4 - 26 m k^2 omega^2 + 26 k^3 = 0")
    end subroutine one_of_three_is_unstable

    subroutine places_that_are_not_zero()
        !! Those that the scene says; one that is none is called wrong, and one that is not said is
        !! not guessed.
        call holds(one//"T = 'm/2 x_dot^2' V = 'k/2 (x - b)^2' equilibrium = 'b' "// &
                   "Q_x = '-m x_dot'", "x = b|gamma = 1/2|omega^2 = k/m - (1/2)^2")
        call holds("coordinates = 'r', 'theta' T = 'm/2 (r_dot^2 + r^2 theta_dot^2)' "// &
                   "V = 'k/2 (r - b)^2 - m w r cos(theta)' equilibrium = 'b + m w/k', '0'", &
                   "r = b + m w/k|theta = 0|omega^2 = k/m|omega^2 = w/(m w/k + b)")
        call holds("coordinates = 'theta' T = 'm/2 k^2 (theta_dot^2 + w^2 sin(theta)^2)' "// &
                   "V = '-m b k cos(theta)' equilibrium = 'cos(theta) = b/(w^2 k)'", &
                   "cos(theta) = b/(w^2 k)|omega^2 = w^2 - b^2/(k^2 w^2)")
        call holds("coordinates = 'x' T = 'm/2 x_dot^2' V = 'k cos(x) + b x' "// &
                   "equilibrium = 'sin(x) = b/k'", "sin(x) = b/k|K = -k cos(x)")
        call holds(one//"T = 'm/2 x_dot^2' V = 'k/2 (x - b)^2' equilibrium = 'x = b'", &
                   "x = b|omega^2 = k/m")
        call holds(one//"T = 'm/2 x_dot^2' V = 'k/2 x^2 - b x'", &
                   "omega^2 = k/m")
    end subroutine places_that_are_not_zero

    subroutine places_are_refused()
        !! One line each, at the formula.
        call refused("'cos(x) = y'", "'y'; there are t, x, x_dot, w, pi")
        call refused("'tan(x) = 1'", "write a formula of parameters, or 'x = ...', 'cos(x) = "// &
                                     "...' or 'sin(x) = ...'")
        call refused("'x^2 = 4'", "this is the place of x: write a formula of parameters, or "// &
                                  "'x = ...', 'cos(x) = ...' or 'sin(x) = ...'")
        call refused("'cos(2 x) = 1'", "this is the place of x: write a formula of "// &
                                       "parameters, or 'x = ...', 'cos(x) = ...' or 'sin(x) "// &
                                       "= ...'")
        call refused("'cos(x) ='", "column 9: a side of the equation is empty; write 0 if it "// &
                                   "is zero")
        call refused("'cos(x) = x'", "an equilibrium depends on x, which is not allowed: "// &
                                     "parameters and numbers only")
        call refused("'w = 1'", "this is the place of x: write a formula of parameters, or "// &
                                "'x = ...', 'cos(x) = ...' or 'sin(x) = ...'")
        call refused("'1', '2'", "1, not 2")
    contains
        subroutine refused(equilibrium, expected)
            character(*), intent(in) :: equilibrium, expected
            type(scene_t) :: scene
            type(word_t) :: none(0)
            class(system_t), allocatable :: system
            type(error_t), allocatable :: error

            call parse_scene("&scene system = 'own' dt = 0.1 duration = 1.0 q = 0.0 /"// &
                             line_feed//"&lagrangian "//one//"parameters = 'w' "// &
                             "T = 'x_dot^2 + w' equilibrium = "//equilibrium//" /"// &
                             line_feed//"&own w = 1.0 /", "own.nml", none, scene, system, error)
            call assertTrue(allocated(error), message=equilibrium)
            if (.not. allocated(error)) return
            call assertTrue(index(error%message, "equilibrium") > 0 .and. &
                            is_said(error%message, expected), message=error%message)
            call assertTrue(index(error%message, line_feed) == 0, message=error%message)
        end subroutine refused
    end subroutine places_are_refused

    subroutine no_such_angle()
        !! A hoop that is too slow to lift the bead: no number is taken for its place.
        class(system_t), allocatable :: system
        type(modes_t) :: modes
        type(error_t), allocatable :: error

        call make("coordinates = 'x' T = 'm/2 k^2 (x_dot^2 + w^2 sin(x)^2)' "// &
                  "V = '-m k cos(x)' equilibrium = 'cos(x) = 1/(w^2 k)'", system, error)
        if (allocated(error)) return
        call find_modes(system, likely_equilibrium(system), .false., modes, error)
        call assertTrue(allocated(error), message="cos(x) = 3")
        if (allocated(error)) call assertTrue(index(error%message, "is no number: a root of "// &
            "a negative number, a sine or cosine beyond 1") > 0, message=error%message)
    end subroutine no_such_angle

    subroutine points_without_masses()
        !! T is that of the points where it is said to be, or left out; else it is what was typed.
        call holds(two//"T = 'm/2 (x_dot^2 + 3 y_dot^2)' V = 'k/2 (x^2 + x y + y^2)' "// &
                   "positions = 'a: x, y', 'b, m: x, 0'", "T = m/2 x_dot^2 + 3/2 m y_dot^2")
        call holds(two//"V = 'k/2 (x^2 + x y + y^2)' "// &
                   "positions = 'a, m: x, 0', 'b, 3 m: y, 0', 'far: 2 x, 1'", &
                   "T = m/2 x_dot^2 + 3 m/2 y_dot^2")
        call holds(two//"L = 'm/2 (x_dot^2 + 3 y_dot^2) - k/2 (x^2 + x y + y^2)' "// &
                   "positions = 'a, m: x, 0'", &
                   "L = m/2 x_dot^2 + 3/2 m y_dot^2 - k/2 x^2 - k/2 x y - k/2 y^2")
    end subroutine points_without_masses

    subroutine a_slip_is_seen()
        !! Twice each formula about the equilibrium, one after the other, is called wrong; about a
        !! stated place that is no equilibrium nothing is linearised.
        class(system_t), allocatable :: system
        type(derivation_t) :: derivation, wrong
        type(slip_in_formula_t) :: none
        type(comparison_t), allocatable :: c(:)
        type(random_t) :: random
        type(error_t), allocatable :: error
        type(expression_t) :: beside
        real(dp) :: largest
        integer :: i, slips

        slips = 0
        call make(one//"T = 'm/2 x_dot^2' V = 'k/2 (x - b)^2' equilibrium = 'b' Q_x = '-w x_dot'", &
                  system, error)
        if (allocated(error)) return
        call derive(system, none, derivation, error)
        do i = 1, derivation%count
            wrong = derivation
            if (wrong%lines(i)%right%count == 0) cycle
            wrong%lines(i)%right = whole(2)*wrong%lines(i)%right
            call compare_lines(wrong, system, random, c, error)
            if (.not. c(i)%known .or. abs(c(i)%program) <= 0.0_dp) cycle
            call assertFalse(c(i)%agrees(), message=wrong%line_text(i))
            slips = slips + 1
        end do
        call assertEqual(14, slips, message="lines with a slip")
        call make(two//"T = 'm/2 (x_dot^2 + y_dot^2)' V = 'k/2 (x^2 + y^2)' "// &
                  "Q_x = '-b (x_dot - y_dot)' Q_y = '-b (y_dot - x_dot)'", system, error)
        call derive(system, none, derivation, error)
        wrong = derivation
        associate (last => wrong%lines(derivation%count))
            last%right = last%right*last%right
        end associate
        call compare_lines(wrong, system, random, c, error)
        call assertFalse(c(derivation%count)%agrees(), message="the polynomial's square")
        ! wrong between the first and the last place where it is compared: the worst one is shown
        largest = sqrt(2.0_dp/1.3_dp)
        beside = symbol(derivation%rate())
        beside = (beside - constant(1.25_dp*largest))*(beside - constant(3.25_dp*largest))
        derivation%lines(derivation%count)%right = derivation%lines(derivation%count)%right + beside
        call compare_lines(derivation, system, random, c, error)
        call assertFalse(c(derivation%count)%agrees(), message="wrong between two places")
        call assertEqual(product_at(1.75_dp*largest)/product_at(1.25_dp*largest), &
                         c(derivation%count)%program, 1e-13_dp, "the worst one")
        call make(one//"T = 'm/2 x_dot^2' V = 'k/2 (x - b)^2' equilibrium = 'b/2'", system, error)
        call derive(system, none, derivation, error)
        associate (last => derivation%lines(derivation%count))
            call assertEqual("the scene's equilibrium, x = 0.15, is none; from "// &
                             "there Newton's method leads to x = 0.3", last%left, &
                             "b/2 is no equilibrium")
        end associate
    contains
        pure real(dp) function product_at(x)
            real(dp), intent(in) :: x

            product_at = (x**2 + 2.0_dp/1.3_dp)*(x**2 + 0.6_dp/1.3_dp*x + 2.0_dp/1.3_dp)
        end function product_at
    end subroutine a_slip_is_seen

    subroutine forces_of_places_count()
        !! A spring that is a force beside L is one: \(\lambda = \pm i\sqrt{k/m}\) about its end.
        class(system_t), allocatable :: system
        type(modes_t) :: modes
        type(error_t), allocatable :: error
        complex(dp), allocatable :: lambda(:)

        call make(one//"T = 'm/2 x_dot^2' Q_x = '-k (x - b)'", system, error)
        if (allocated(error)) return
        call find_modes(system, [0.0_dp], .false., modes, error)
        call assertFalse(allocated(error), message="an equilibrium")
        if (allocated(error)) return
        call assertEqual([0.3_dp], modes%at, epsilon(1.0_dp), "where the spring is at rest")
        call damped_rates(system, modes, lambda, error)
        call assertEqual(sqrt(2.0_dp/1.3_dp), aimag(lambda(1)), 4*epsilon(1.0_dp), "omega")
    end subroutine forces_of_places_count
end module test_derivation_rest
