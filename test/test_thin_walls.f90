module test_thin_walls
    !! Walls, wells and steps of a potential that are far thinner than a step of the method: an
    !! adaptive method does not go over them.
    use funit, only: anyExceptions, assertEqual, assertFalse, assertTrue, TestMethod, TestSuite
    use lagrangia_brief_force_search, only: find_place_functions
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_hermite, only: cubic
    use lagrangia_kinds, only: dp
    use lagrangia_outcome, only: outcome_t
    use lagrangia_place_functions, only: place_functions_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_sweep, only: sweep_t
    use lagrangia_system, only: system_t
    use scene_runs, only: perform
    use sweep_numbers, only: compute_numbers, make_sweep, sweep_numbers_t
    implicit none (type, external)
    private
    public :: thin_walls_suite

    character(7), parameter :: methods(2) = [character(7) :: "gauss16", "dop853"]

contains

    function thin_walls_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("thin_walls")
        call suite%addTest(TestMethod("a wall throws back", walls_throw_back))
        call suite%addTest(TestMethod("a step of the potential slows down", steps_slow_down))
        call suite%addTest(TestMethod("a wall near the turning point", walls_that_are_touched))
        call suite%addTest(TestMethod("a round wall in a plane", round_walls))
        call suite%addTest(TestMethod("a wall in the lanes of a sweep", walls_in_sweeps))
        call suite%addTest(TestMethod("what acts everywhere costs nothing", what_acts_everywhere))
        call suite%addTest(TestMethod("which steps go over what", steps_over))
        call suite%addTest(TestMethod("which steps need a second look", second_looks))
        call suite%addTest(TestMethod("in which formulas they are", in_all_formulas))
        call suite%addTest(TestMethod("what a bent path may meet", bent_paths))
        call suite%addTest(TestMethod("what falls slowly", slow_falls))
        call suite%addTest(TestMethod("a turn right behind a start", turns_at_ends))
        call suite%addTest(TestMethod("the cubic between two states", cubic_between))
    end function thin_walls_suite

    subroutine fly(method, potential, x, speed, allowed)
        !! From 0 with 2 m/s, for 3 s, on a mass of 1 kg.
        character(*), intent(in) :: method, potential
        real(dp), intent(in) :: x, speed  !! at the end
        real(dp), intent(in) :: allowed   !! error of x
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        if (anyExceptions()) return
        call perform("&scene system = 'thin' method = '"//trim(method)//"' tolerance = 1e-10 "// &
                     "duration = 3 samples = 10 q = 0.0 v = 2.0 / &lagrangian "// &
                     "coordinates = 'x' T = 'x_dot^2/2' V = '"//potential//"' /", "", "none", &
                     outcome, error)
        call assertFalse(allocated(error), method//", "//potential)
        if (anyExceptions()) return
        call assertEqual(speed, outcome%v(1), 1e-7_dp, method//", speed, "//potential)
        call assertEqual(x, outcome%q(1), allowed, method//", place, "//potential)
        call assertTrue(outcome%evaluations < 12000, method//", cheap: "//potential)
    end subroutine fly

    subroutine walls_throw_back()
        !! At x = 4, where it comes at 2 s, to within some widths; a well hardly changes the motion.
        integer :: i

        do i = 1, size(methods)
            call fly(methods(i), "3 exp(-((x - 4)/0.001)^2)", 2.0_dp, -2.0_dp, 0.01_dp)
            call fly(methods(i), "3 exp(-((x - 4)/0.00001)^2)", 2.0_dp, -2.0_dp, 1e-4_dp)
            call fly(methods(i), "3 exp(-abs(x - 4)/0.0001)", 2.0_dp, -2.0_dp, 1e-3_dp)
            call fly(methods(i), "3/(1 + ((x - 4)/0.0001)^2)", 2.0_dp, -2.0_dp, 1e-2_dp)
            call fly(methods(i), "3 (1 - tanh((x - 4)/0.0001)^2)", 2.0_dp, -2.0_dp, 1e-3_dp)
            call fly(methods(i), "3 (1 + (1000 x - 4000)^4)^(-2)", 2.0_dp, -2.0_dp, 1e-2_dp)
            call fly(methods(i), "3 (-1 - (1000 x - 4000)^4)^(-2)", 2.0_dp, -2.0_dp, 1e-2_dp)
            call fly(methods(i), "-3 exp(-((x - 4)/0.0001)^2)", 6.0_dp, 2.0_dp, 1e-3_dp)
        end do
    end subroutine walls_throw_back

    subroutine steps_slow_down()
        !! \(\dot x^2/2\) is less by the height of the step behind it: 2 m/s become 1 m/s.
        integer :: i

        do i = 1, size(methods)
            call fly(methods(i), "3/4 (1 + tanh((x - 4)/0.0001))", 5.0_dp, 1.0_dp, 1e-3_dp)
            call fly(methods(i), "3/2 (1 + tanh((x - 4)/0.0001))", 2.0_dp, -2.0_dp, 1e-3_dp)
        end do
    end subroutine steps_slow_down

    subroutine walls_that_are_touched()
        !! \(x = 2\sin t\) turns at 2: a step that reaches beyond a wall at 1.9999 comes back. With
        !! the wall the motion turns where that is as high as \(2 - x^2/2\), at \(x_1\), and gains
        !! twice \(\pi/2 - \arcsin(x_1/2)\): some hundredths of a second.
        real(dp), parameter :: x_1 = 1.9999_dp - 0.000002_dp*sqrt(log(5000.0_dp))
        real(dp), parameter :: gained = 2*(acos(-1.0_dp)/2 - asin(x_1/2))
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, size(methods)
            call perform("&scene system = 'thin' method = '"//trim(methods(i))//"' "// &
                         "tolerance = 1e-10 duration = 3 samples = 10 q = 0.0 v = 2.0 / "// &
                         "&lagrangian coordinates = 'x' T = 'x_dot^2/2' "// &
                         "V = 'x^2/2 + exp(-((x - 1.9999)/0.000002)^2)' /", "", "none", outcome, &
                         error)
            call assertFalse(allocated(error), methods(i))
            if (anyExceptions()) return
            call assertEqual(2*sin(3.0_dp + gained), outcome%q(1), 2e-4_dp, methods(i))
        end do
    end subroutine walls_that_are_touched

    subroutine round_walls()
        !! From inside, along a chord of the circle r = 2 at a distance of 1 from the middle: it is
        !! thrown back as light is by a mirror, by 120 degrees, at \((\sqrt3, 1)\).
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        real(dp) :: late
        integer :: i

        late = 3.0_dp - sqrt(3.0_dp)
        do i = 1, size(methods)
            call perform("&scene system = 'thin' method = '"//trim(methods(i))//"' "// &
                         "tolerance = 1e-10 duration = 3 samples = 10 "// &
                         "q = 0.0, 1.0 v = 1.0, 0.0 / &lagrangian coordinates = 'x', 'y' "// &
                         "T = '(x_dot^2 + y_dot^2)/2' "// &
                         "V = '3 exp(-((sqrt(x^2 + y^2) - 2)/0.00001)^2)' /", "", "none", &
                         outcome, error)
            call assertFalse(allocated(error), methods(i))
            if (anyExceptions()) return
            call assertEqual([sqrt(3.0_dp) - 0.5_dp*late, 1 - sqrt(0.75_dp)*late], outcome%q, &
                             1e-3_dp, methods(i))
        end do
    end subroutine round_walls

    subroutine walls_in_sweeps()
        !! Walls of several heights: those below 2 J let it through.
        type(sweep_t) :: sweep
        type(sweep_numbers_t) :: numbers
        type(error_t), allocatable :: error
        integer :: i

        call make_sweep("&scene system = 'thin' method = 'dop853' tolerance = 1e-10 "// &
                        "duration = 3 samples = 10 q = 0.0 v = 2.0 / &lagrangian "// &
                        "coordinates = 'x' parameters = 'h [J]' T = 'x_dot^2/2' "// &
                        "V = 'h exp(-((x - 4)/0.0001)^2)' / &thin h = 3.0 /", ["h=1:3:20"], &
                        ["x_dot"], sweep)
        if (anyExceptions()) return
        call compute_numbers(sweep, 1, numbers, error)
        call assertFalse(allocated(error), "the sweep")
        if (anyExceptions()) return
        do i = 1, 20
            call assertEqual(merge(2.0_dp, -2.0_dp, i <= 10), numbers%values(1, i), 1e-6_dp, &
                             "with walls of many heights")
        end do
    end subroutine walls_in_sweeps

    subroutine what_acts_everywhere()
        !! A pole that the formula has and the motion has not, and a wide function.
        integer :: i

        do i = 1, size(methods)
            call fly(methods(i), "1e-20 sin(x - 3.9)/(x - 3.9)", 6.0_dp, 2.0_dp, 1e-9_dp)
            call fly(methods(i), "1e-20/(1 + x^2)", 6.0_dp, 2.0_dp, 1e-9_dp)
        end do
    end subroutine what_acts_everywhere

    subroutine steps_over()
        class(system_t), allocatable :: system
        type(place_functions_t) :: functions
        type(error_t), allocatable :: error
        type(scene_t) :: scene

        call parse_scene("&scene system = 'own' dt = 0.1 duration = 1 q = 0.0 / &lagrangian "// &
                         "coordinates = 'x' T = 'x_dot^2/2' V = 'exp(-x^2)' "// &
                         "Q_x = '-tanh(x_dot) + exp(-t^2) + abs(x)' /", "own.nml", [word_t ::], &
                         scene, system, error)
        call assertFalse(allocated(error), "an own system")
        if (anyExceptions()) return
        call find_place_functions(system, functions)
        call assertEqual(1, functions%count, "only exp(-x^2)")
        call assertTrue(over(-2.0_dp, 2.0_dp, 1.0_dp), "from either side to the other")
        call assertTrue(over(9.0_dp, -5.0_dp, -1.0_dp), "and back")
        call assertFalse(over(-2.0_dp, -1.8_dp, 1.0_dp), "before it")
        call assertFalse(over(-1.7_dp, 2.0_dp, 1.0_dp), "one end is within")
        call assertFalse(over(-2.0_dp, 1.7_dp, 1.0_dp), "or the other")
        call assertFalse(over(2.0_dp, 5.0_dp, 1.0_dp), "behind it")
        call assertTrue(turns(-3.0_dp, 9.0_dp, -3.0_dp, -9.0_dp), "to -0.75 and back")
        call assertFalse(turns(-3.0_dp, 1.6_dp, -3.0_dp, -1.6_dp), "to -2.6 and back")
        call assertTrue(turns(-3.0_dp, 19.0_dp, 3.5_dp, -14.0_dp), "to 5.4, and on the way back")
        call assertFalse(over(-1.1e14_dp, 1e14_dp, 1e14_dp), "what no time can resolve")
        call assertTrue(over(-2.0_dp, 100.0_dp, 1.0_dp), "right behind the start")
        call assertTrue(over(-100.0_dp, 2.0_dp, 1.0_dp), "right before the end")
        call assertTrue(went_over(functions, 0.0_dp, [-2.0_dp], [35.0_dp], 1.0_dp, [6.33_dp], &
                                  [15.0_dp]), "before two turns, at 1/2 and 7/10")
        call assertTrue(over(-2000.0_dp, 2500.0_dp, 0.0045_dp), "slowly, and from afar")
    contains
        function over(from, to, speed) result(yes)
            !! At this speed all the way.
            real(dp), intent(in) :: from, to, speed
            logical :: yes

            call functions%try_step(1.0_dp, [from], [speed], 1.0_dp + (to - from)/speed, [to], &
                                    [speed], yes)
        end function over

        function turns(from, fast, to, slow) result(yes)
            !! Within a second, with these speeds at both ends.
            real(dp), intent(in) :: from, fast, to, slow
            logical :: yes

            call functions%try_step(0.0_dp, [from], [fast], 1.0_dp, [to], [slow], yes)
        end function turns
    end subroutine steps_over

    subroutine find(potential, functions)
        !! Of a mass in a plane.
        character(*), intent(in) :: potential
        type(place_functions_t), intent(out) :: functions
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(scene_t) :: scene

        call parse_scene("&scene system = 'own' dt = 0.1 duration = 1 q = 0.0, 1.0 / "// &
                         "&lagrangian coordinates = 'x', 'y' T = '(x_dot^2 + y_dot^2)/2' "// &
                         "V = '"//potential//"' parameters = 'c', 'w' / &own c = 90.0 w = 2.0 /", &
                         "own.nml", [word_t ::], scene, system, error)
        call assertFalse(allocated(error), potential)
        if (.not. allocated(error)) call find_place_functions(system, functions)
    end subroutine find

    subroutine second_looks()
        !! \(-x^2\) at 2 m changes by 4 m times what the velocity there would cover in the step:
        !! those by which it changes by more than 2, at either end, are looked at again.
        type(place_functions_t) :: functions
        real(dp), parameter :: slow(2) = [0.225_dp, 0.0_dp], fast(2) = [0.275_dp, 0.0_dp]
        integer :: i

        call find("exp(-x^2) + exp(-((y - c)/w)^2)", functions)
        if (anyExceptions()) return
        call assertEqual(2, functions%count, "in two places")
        do i = -1, 1, 2
            call assertFalse(over(slow, slow), "1.8 at both ends")
            call assertTrue(over(fast, slow), "2.2 at the start")
            call assertTrue(over(slow, fast), "2.2 at the end")
        end do
        call assertTrue(went_over(functions, 0.0_dp, [0.0_dp, 82.0_dp], [0.0_dp, 14.0_dp], &
                                  1.0_dp, [0.0_dp, 96.0_dp], [0.0_dp, 14.0_dp]), &
                        "over 90 m, four widths before it and three behind")
        call assertFalse(went_over(functions, 0.0_dp, [0.0_dp, 82.0_dp], [0.0_dp, 11.0_dp], &
                                   1.0_dp, [0.0_dp, 93.0_dp], [0.0_dp, 11.0_dp]), &
                         "to one and a half behind it")
    contains
        function over(v_old, v) result(yes)
            !! From 2 m before the place to 2 m behind it, or back, in 2 s.
            real(dp), intent(in) :: v_old(2), v(2)
            logical :: yes

            yes = went_over(functions, 1.0_dp, [-2.0_dp*i, 0.0_dp], i*v_old, 3.0_dp, &
                            [2.0_dp*i, 0.0_dp], i*v)
        end function over
    end subroutine second_looks

    subroutine in_all_formulas()
        !! In forces and constraints as in the Lagrangian.
        type(place_functions_t) :: functions

        call find("x' Q_x = 'exp(-y^2)", functions)
        if (anyExceptions()) return
        call assertEqual(1, functions%count, "in a force")
        call find("x' constraint = 'y = exp(-x^2)", functions)
        if (anyExceptions()) return
        call assertEqual(1, functions%count, "in a constraint")
        call find("exp(-x^2)' Q_y = 'exp(-y^2)' constraint = 'y = 1/(1 + x^2)", functions)
        if (anyExceptions()) return
        call assertEqual(3, functions%count, "in all of them")
    end subroutine in_all_formulas

    subroutine bent_paths()
        !! \(e^{-x^2}\) is nothing where \(x^2 > 45\). In 1 s from -20 m and back there with v,
        !! the path turns at -20 m + v/4; one that is bent by a quarter more, at -20 m + 5 v/16:
        !! of 42 m/s at -6.875 m, of 43 m/s at -6.5625 m.
        type(place_functions_t) :: functions
        real(dp), parameter :: far(2) = [-20.0_dp, 0.0_dp]
        integer :: i

        call find("exp(-x^2)", functions)
        if (anyExceptions()) return
        do i = -1, 1, 2
            call assertFalse(went_over(functions, 0.0_dp, i*far, [i*42.0_dp, 0.0_dp], 1.0_dp, &
                                       i*far, [-i*42.0_dp, 0.0_dp]), "42 m/s")
            call assertTrue(went_over(functions, 0.0_dp, i*far, [i*43.0_dp, 0.0_dp], 1.0_dp, &
                                      i*far, [-i*43.0_dp, 0.0_dp]), "43 m/s")
            call assertTrue(went_over(functions, 0.0_dp, i*far, [i*21.5_dp, 0.0_dp], 2.0_dp, &
                                      i*far, [-i*21.5_dp, 0.0_dp]), "in 2 s")
            call assertFalse(went_over(functions, 0.0_dp, i*far, [i*21.0_dp, 0.0_dp], 2.0_dp, &
                                       i*far, [-i*21.0_dp, 0.0_dp]), "nor in 2 s")
        end do
        call find("exp(-x^2 - y^2)", functions)
        if (anyExceptions()) return
        call assertTrue(went_over(functions, 0.0_dp, [-20.0_dp, 3.0_dp], [40.0_dp, 16.0_dp], &
                                  1.0_dp, [20.0_dp, 3.0_dp], [40.0_dp, -16.0_dp]), &
                        "at 7 m, bent to the place, by 1 m more at 6 m")
        call find("exp(-x^2) + exp(-y^2)", functions)
        if (anyExceptions()) return
        call assertTrue(went_over(functions, 0.0_dp, [-2.0_dp, -20.0_dp], [4.0_dp, 42.0_dp], &
                                  1.0_dp, [2.0_dp, -20.0_dp], [4.0_dp, -42.0_dp]), &
                        "over one of two")
        call assertTrue(went_over(functions, 0.0_dp, [-20.0_dp, -2.0_dp], [42.0_dp, 4.0_dp], &
                                  1.0_dp, [-20.0_dp, 2.0_dp], [-42.0_dp, 4.0_dp]), &
                        "over the other")
    end subroutine bent_paths

    subroutine slow_falls()
        !! A power is never nothing: from \(-10^9\) m to \(-2.1\cdot10^8\) m and back it is more
        !! than \(e^3\) times what it is at both ends, though \(10^{-33}\) of what it is at 0.
        character(*), parameter :: powers(2) = [character(14) :: "1/(1 + x^2)", "(1 + x^2)^(-2)"]
        !! A pole is no maximum.
        type(place_functions_t) :: functions
        real(dp), parameter :: far(2) = [-1e9_dp, 0.0_dp], v(2) = [3.16e9_dp, 0.0_dp]
        integer :: i

        do i = 1, size(powers)
            call find(powers(i), functions)
            if (anyExceptions()) return
            call assertTrue(went_over(functions, 0.0_dp, far, v, 1.0_dp, far, -v), powers(i))
        end do
        call find("sin(x - 0.1)/(x - 0.1)", functions)
        if (anyExceptions()) return
        call assertFalse(went_over(functions, 0.0_dp, [-2.9_dp, 0.0_dp], [6.2_dp, 0.0_dp], &
                                   1.0_dp, [3.3_dp, 0.0_dp], [6.2_dp, 0.0_dp]), &
                         "over a pole")
    end subroutine slow_falls

    subroutine turns_at_ends()
        !! Away from a place and back over it before the first look, by \(2 + s - 150 s^2\), which
        !! turns at s = 1/300 and is 0 at 0.119; and that backwards. Along either coordinate, the
        !! other at rest or on a way of its own. The velocity -360 (s - 1/10) (s - 299/300) turns
        !! where nothing is, and once more behind the place, over which it comes back.
        type(place_functions_t) :: functions
        character(1), parameter :: names(2) = ["x", "y"]
        real(dp), dimension(2) :: q, q_old, v, v_old
        integer :: i, k

        do i = 1, 2
            call find("exp(-"//names(i)//"^2)", functions)
            if (anyExceptions()) return
            do k = 0, 3
                q_old = 3.0_dp
                v_old = k
                q = q_old + k
                v = k - 6*k*(k - 1)*(3 - k)
                q_old(i) = 2.0_dp
                v_old(i) = 1.0_dp
                q(i) = -147.0_dp
                v(i) = -299.0_dp
                call assertTrue(went_over(functions, 0.0_dp, q_old, v_old, 1.0_dp, q, v), &
                                "behind the start, "//names(i))
                call assertTrue(went_over(functions, 0.0_dp, q, -v, 1.0_dp, q_old, -v_old), &
                                "before the end, "//names(i))
                call assertTrue(went_over(functions, 1.0_dp, q_old, 0.5_dp*v_old, 3.0_dp, q, &
                                          0.5_dp*v), "in 2 s, "//names(i))
            end do
            q_old(i) = -39.52_dp
            v_old(i) = -35.88_dp
            q(i) = 2.0_dp
            v(i) = -1.08_dp
            call assertTrue(went_over(functions, 0.0_dp, q_old, v_old, 1.0_dp, q, v), &
                            "at its second turn, "//names(i))
            call assertTrue(went_over(functions, 0.0_dp, q, -v, 1.0_dp, q_old, -v_old), &
                            "and backwards, "//names(i))
            q_old(i) = 3.0_dp
            v_old(i) = 9.0_dp
            q(i) = 17.0_dp
            v(i) = 19.0_dp
            call assertFalse(went_over(functions, 0.0_dp, q_old, v_old, 1.0_dp, q, v), &
                             "3 + 9 s + 5 s^2 turned before the start, "//names(i))
            call assertFalse(went_over(functions, 0.0_dp, q, -v, 1.0_dp, q_old, -v_old), &
                             "or will behind the end, "//names(i))
        end do
    end subroutine turns_at_ends

    function went_over(functions, t_old, q_old, v_old, t, q, v) result(yes)
        !! A step from the one state to the other, whatever was tried before.
        type(place_functions_t), intent(in) :: functions
        real(dp), intent(in) :: t_old, q_old(:), v_old(:), t, q(:), v(:)
        logical :: yes
        type(place_functions_t) :: fresh

        fresh = functions
        call fresh%try_step(t_old, q_old, v_old, t, q, v, yes)
    end function went_over

    subroutine cubic_between()
        !! Exact for a cubic: x = 1 + 2 t - 3 t^2 + 5 t^3 from t = 0 to 2.
        real(dp) :: x, v

        call cubic(0.25_dp, 2.0_dp, 1.0_dp, 2.0_dp, 33.0_dp, 50.0_dp, x, v)
        call assertEqual(1.875_dp, x, 1e-14_dp, "at t = 1/2")
        call assertEqual(2.75_dp, v, 1e-14_dp, "and its slope")
    end subroutine cubic_between
end module test_thin_walls
