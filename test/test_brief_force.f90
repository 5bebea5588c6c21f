module test_brief_force
    !! A force that acts for a moment, or far from where a motion begins, is neither overlooked by
    !! the structure of an own system nor gone over by long steps.
    use funit, only: anyExceptions, assertEqual, assertFalse, assertTrue, TestMethod, TestSuite
    use lagrangia_brief_force_search, only: find_brief_forces
    use lagrangia_brief_forces, only: brief_forces_t
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrangian_system, only: lagrangian_system_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_sweep, only: sweep_t
    use lagrangia_system, only: system_t
    use scene_runs, only: perform
    use sweep_numbers, only: compute_numbers, make_sweep, sweep_numbers_t
    use test_thin_walls, only: thin_walls_suite
    implicit none (type, external)
    private
    public :: brief_force_suite

    character(*), parameter :: kick = "parameters = 'F [N]' T = 'x_dot^2/2' V = '0' "// &
                               "Q_x = 'F exp(-((t - 5)/0.02)^2)'"
    real(dp), parameter :: impulse = 3.0_dp*0.02_dp*sqrt(acos(-1.0_dp))  !! of F = 3 N, kg m/s

contains

    function brief_force_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("brief_force")
        call suite%addTest(TestMethod("forces that no trial state meets are seen", &
                                      structure_of_forces))
        call suite%addTest(TestMethod("and so is what is in L", structure_of_lagrangians))
        call suite%addTest(TestMethod("and in constraints", structure_of_constraints))
        call suite%addTest(TestMethod("adaptive methods do not step over a kick", runs_meet_a_kick))
        call suite%addTest(TestMethod("nor do sweeps", sweeps_meet_a_kick))
        call suite%addTest(TestMethod("steps beside kinks are long", kinks_cost_little))
        call suite%addTest(TestMethod("where moments are", where_moments_are))
        call suite%addTest(TestMethod("of any shape, at any time", moments_of_any_shape))
        call suite%addTest(TestMethod("functions of the time", functions_are_counted))
        call suite%addTest(TestMethod("steady forces have none", steady_forces))
        call suite%addTest(thin_walls_suite())
    end function brief_force_suite

    subroutine own(lines, system, values)
        !! An own system with coordinates x and y, and with these values of its parameters.
        character(*), intent(in) :: lines
        class(system_t), allocatable, intent(out) :: system
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable :: error
        type(scene_t) :: scene
        character(:), allocatable :: given

        given = " / &own F = 1"
        if (index(lines, "'b'") > 0) given = given//" b = 1"
        call parse_scene("&scene system = 'own' dt = 0.1 duration = 1 q = 0, 0 / &lagrangian "// &
                         "coordinates = 'x', 'y' "//lines//given//" /", "own.nml", [word_t ::], &
                         scene, system, error)
        if (.not. allocated(error)) call system%configure(values, error)
        if (allocated(error)) call assertEqual("", error%message, lines)
    end subroutine own

    subroutine structure_of_forces()
        class(system_t), allocatable :: system
        character(*), parameter :: t = "parameters = 'F', 'b' T = '(x_dot^2 + y_dot^2)/2' V = '0' "

        call own(t//"Q_x = 'F exp(-((t - 5.01)/0.01)^2)'", system, [1.0_dp, 0.0_dp])
        if (anyExceptions()) return
        call assertTrue(system%nonconservative, "a kick is a force")
        call assertTrue(system%time_dependent, "in time")
        call assertFalse(system%velocity_forces, "at rest, too")
        call assertFalse(system%conserves_energy(), "that works")
        call assertEqual(2, system%cyclic, "p_x is not conserved")
        call own(t//"Q_x = 'F exp(-((t - 5.01)/0.01)^2)'", system, [0.0_dp, 0.0_dp])
        call assertFalse(system%nonconservative, "a kick of 0 N is none")
        call assertFalse(system%time_dependent, "nor in time")
        call assertEqual(1, system%cyclic, "p_x is conserved")
        call own(t//"Q_y = '-b exp(-((x - 77)/0.1)^2) y_dot'", system, [0.0_dp, 1.0_dp])
        call assertTrue(system%velocity_forces, "a friction far away is one")
        call assertFalse(system%time_dependent, "at all times")
        call assertFalse(system%conserves_energy(), "that works")
        call assertEqual(1, system%cyclic, "p_y is not conserved")
        call own(t//"Q_x = 'F y_dot - b x_dot exp(-(x - 77)^2/0.01)' Q_y = '-F x_dot'", system, &
                 [1.0_dp, 1.0_dp])
        call assertFalse(system%conserves_energy(), "beside a force that does not work")
        call own(t//"Q_x = 'F y_dot - b x_dot exp(-(x - 77)^2/0.01)' Q_y = '-F x_dot'", system, &
                 [1.0_dp, 0.0_dp])
        call assertTrue(system%conserves_energy(), "that does not work")
    end subroutine structure_of_forces

    subroutine structure_of_lagrangians()
        class(system_t), allocatable :: system
        character(*), parameter :: t = "parameters = 'F' T = '(x_dot^2 + y_dot^2)/2' "

        call own(t//"V = 'F exp(-((x - 77)/0.1)^2)'", system, [1.0_dp])
        if (anyExceptions()) return
        call assertEqual(2, system%cyclic, "x is not cyclic")
        call assertTrue(system%conserves_energy(), "nothing moves the wall")
        call own(t//"V = 'F exp(-((x - 77)/0.1)^2)'", system, [0.0_dp])
        call assertEqual(1, system%cyclic, "without a wall it is")
        call own(t//"V = 'F x exp(-((t - 5.01)/0.01)^2)'", system, [1.0_dp])
        call assertTrue(system%time_dependent, "a kick in V")
        call assertFalse(system%conserves_energy(), "changes the energy")
        call own(t//"V = 'F x (t - t)'", system, [1.0_dp])
        call assertFalse(system%time_dependent, "what cancels is not there")
        call assertEqual(1, system%cyclic, "nor the coordinate with it")
        call own(t//"V = 'F x sgn(t - 77)'", system, [1.0_dp])
        call assertFalse(system%conserves_energy(), "a jump changes the energy, too")
        call own(t//"V = 'F x sgn(t - 77)'", system, [0.0_dp])
        call assertTrue(system%conserves_energy(), "a jump of 0 J is none")
    end subroutine structure_of_lagrangians

    subroutine structure_of_constraints()
        class(system_t), allocatable :: system
        character(*), parameter :: t = "parameters = 'F' T = '(x_dot^2 + y_dot^2)/2' "

        call own(t//"constraint = 'y = F exp(-((t - 5.01)/0.01)^2)'", system, [1.0_dp])
        if (anyExceptions()) return
        call assertTrue(system%time_dependent, "what is lifted for a moment")
        call assertFalse(system%conserves_energy(), "is worked on")
        call assertEqual(1, system%cyclic, "and p_x is conserved")
        call own(t//"constraint = 'y = F exp(-((x - 77)/0.1)^2)'", system, [1.0_dp])
        call assertTrue(system%conserves_energy(), "a hill far away does no work")
        call assertEqual(0, system%cyclic, "but p_x is not conserved")
        call own(t//"constraint = 'y = F exp(-((x - 77)/0.1)^2)'", system, [0.0_dp])
        call assertEqual(1, system%cyclic, "without a hill it is")
    end subroutine structure_of_constraints

    subroutine runs_meet_a_kick()
        !! \(\dot x = \int F\,dt/m\), and \(x = \int(10 - t)F\,dt/m\): of kicks about 5 s that
        !! last a hundredth of a second or less, beside forces that always change.
        character(7), parameter :: methods(2) = [character(7) :: "gauss16", "dop853"]
        real(dp), parameter :: pi = acos(-1.0_dp)
        integer :: i

        do i = 1, size(methods)
            call meet(methods(i), "3 exp(-((t - 5)/0.02)^2)", impulse, 5*impulse)
            call meet(methods(i), "t/1000 + 2 exp(-((t - 5)/0.0002)^2)", 0.05_dp + &
                      0.0004_dp*sqrt(pi), 1/6.0_dp + 0.002_dp*sqrt(pi))
            call meet(methods(i), "exp(-abs(t - 5)/0.001)", 0.002_dp, 0.01_dp)
            call meet(methods(i), "exp(-((t - 5)/0.001)^4)", 0.002_dp*gamma(1.25_dp), &
                      0.01_dp*gamma(1.25_dp))
            call meet(methods(i), "2^(-((t - 5)/0.01)^2)", 0.01_dp*sqrt(pi/log(2.0_dp)), &
                      0.05_dp*sqrt(pi/log(2.0_dp)))
            call meet(methods(i), "2/cosh((t - 5)/0.001)^2", 0.004_dp, 0.02_dp)
            call meet(methods(i), "1/(t^2 - 10 t + 25.000001)", 2000*atan(5000.0_dp), &
                      10000*atan(5000.0_dp))
            call meet(methods(i), "(1 + (1000 t - 5000)^4)^(-2)", 0.000375_dp*pi*sqrt(2.0_dp), &
                      0.001875_dp*pi*sqrt(2.0_dp))
            call meet(methods(i), "tanh((t - 5)/0.0001) - tanh((t - 5.001)/0.0001)", 0.002_dp, &
                      0.009999_dp)
            call meet(methods(i), "atan((t - 5)/0.0001) - atan((t - 5.001)/0.0001)", &
                      5.001_dp*atan(5.001e4_dp) - 4.999_dp*atan(4.999e4_dp) + &
                      5e-5_dp*log((1 + 4.999e4_dp**2)/(1 + 5.001e4_dp**2)), -1.0_dp)
            call meet(methods(i), "sgn(t - 5) - sgn(t - 5.001)", 0.002_dp, 0.009999_dp)
            call meet(methods(i), "cos(t) + abs(t - 5)", 25 + sin(10.0_dp), &
                      126 - cos(10.0_dp))
        end do
    end subroutine runs_meet_a_kick

    subroutine meet(method, force, speed, place)
        !! Ten seconds from rest, by a force on a mass of 1 kg.
        character(*), intent(in) :: method, force
        real(dp), intent(in) :: speed, place  !! at the end; not positive: not known
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        if (anyExceptions()) return
        call perform("&scene system = 'kicked' method = '"//trim(method)//"' tolerance = 1e-10 "// &
                     "duration = 10 samples = 10 q = 0.0 / &lagrangian coordinates = 'x' "// &
                     "T = 'x_dot^2/2' V = '0' Q_x = '"//force//"' /", "", "none", outcome, error)
        call assertFalse(allocated(error), method//", "//force)
        if (anyExceptions()) return
        call assertEqual(speed, outcome%v(1), 2e-8_dp*max(1.0_dp, speed), method//", "//force)
        if (place > 0.0_dp) call assertEqual(place, outcome%q(1), 1e-7_dp*max(1.0_dp, place), &
                                             method//", x of "//force)
        call assertTrue(outcome%evaluations < 3000, method//", cheap: "//force)
    end subroutine meet

    subroutine kinks_cost_little()
        !! The short step over a kink does not shorten those behind it.
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call perform("&scene system = 'kicked' method = 'dop853' tolerance = 1e-10 "// &
                     "duration = 10 samples = 10 q = 0.0 / &lagrangian coordinates = 'x' "// &
                     "T = 'x_dot^2/2' V = '0' "// &
                     "Q_x = '(sgn(t - 2) - sgn(t - 3))/2' /", "", "none", outcome, error)
        call assertFalse(allocated(error), "a pulse")
        if (anyExceptions()) return
        call assertEqual(1.0_dp, outcome%v(1), 1e-13_dp, "its end is its own")
        call assertEqual(7.5_dp, outcome%q(1), 1e-12_dp, "and 7.5 s behind its middle")
        call assertTrue(outcome%steps < 20, "steps")
    end subroutine kinks_cost_little

    subroutine sweeps_meet_a_kick()
        type(sweep_t) :: sweep
        type(sweep_numbers_t) :: numbers
        type(error_t), allocatable :: error

        call make_sweep("&scene system = 'kicked' method = 'dop853' tolerance = 1e-10 "// &
                        "duration = 10 samples = 10 q = 0.0 / &lagrangian coordinates = 'x' "// &
                        kick//" / &kicked F = 3.0 /", ["F=0:3:31"], ["x_dot"], sweep)
        if (anyExceptions()) return
        call compute_numbers(sweep, 1, numbers, error)
        call assertFalse(allocated(error), "the sweep")
        if (anyExceptions()) return
        call assertEqual(0.0_dp, numbers%values(1, 1), 0.0_dp, "without a kick")
        call assertEqual(impulse, numbers%values(1, 31), 1e-8_dp, "with the whole")
    end subroutine sweeps_meet_a_kick

    subroutine where_moments_are()
        !! No step goes over a moment, and within one none is longer than \(4\sigma\).
        class(system_t), allocatable :: system
        character(*), parameter :: t = "parameters = 'F' T = '(x_dot^2 + y_dot^2)/2' V = '0' "
        type(brief_forces_t) :: brief
        real(dp), parameter :: never = huge(1.0_dp), sigma = 0.1_dp/sqrt(2.0_dp)
        real(dp) :: h
        integer :: i

        call assertEqual(never, brief%longest_step(1.0_dp), 0.0_dp, "none at first")
        call own(t//"Q_y = 'F exp(-((t - 31)/0.1)^2)' Q_x = 'F exp(-((t - 60)/0.05)^2)'", system, &
                 [-2.0_dp])
        if (anyExceptions()) return
        call find_brief_forces(system, 1.0_dp, 101.0_dp, brief)
        h = brief%longest_step(1.0_dp)
        call assertTrue(31 - 32*sigma <= 1 + h .and. 1 + h <= 31 - 16*sigma, "ends before it")
        h = brief%longest_step(1.0_dp + h)
        call assertTrue(2*sigma <= h .and. h <= 4*sigma, "then is short")
        call assertEqual(h, brief%longest_step(31.0_dp), 0.0_dp, "as in the middle")
        h = brief%longest_step(31 + 32*sigma)
        call assertTrue(60 - 16*sigma <= 31 + 32*sigma + h, "ends before the next")
        h = brief%longest_step(60.0_dp)
        call assertTrue(sigma <= h .and. h <= 2*sigma, "which is half as long")
        call assertEqual(never, brief%longest_step(60 + 16*sigma), 0.0_dp, "nothing is behind it")
        call find_brief_forces(system, 31.1_dp, 59.99_dp, brief)
        call assertTrue(brief%longest_step(31.2_dp) > 20, "its end is no moment")
        call assertTrue(brief%longest_step(59.9_dp) <= 2*sigma, "one just behind the end is")
        call find_brief_forces(system, 1.0_dp, never, brief)
        call assertEqual(never, brief%longest_step(1.0_dp), 0.0_dp, "without an end none")
        call own(t//"definitions = 'B = F exp(-((t - 31)/0.1)^2)' Q_x = '-B y_dot' "// &
                 "Q_y = 'B x_dot'", system, [-2.0_dp])
        call find_brief_forces(system, 1.0_dp, 101.0_dp, brief)
        h = brief%longest_step(31.0_dp)
        call assertTrue(2*sigma <= h .and. h <= 4*sigma, "a magnetic field, which has no start")
        call own(t//"Q_y = 'F sgn(t - 31)'", system, [-2.0_dp])
        call find_brief_forces(system, 1.0_dp, 101.0_dp, brief)
        h = brief%longest_step(1.0_dp)
        call assertEqual(30.0_dp, h, 1e-12_dp, "to a jump")
        call assertTrue(1 + h < 31.0_dp, "not to its middle")
        i = nint(brief%longest_step(1 + h)/spacing(101.0_dp))
        call assertEqual(32, i, "and over it")
        call assertEqual(never, brief%longest_step(31 + 16*spacing(101.0_dp)), 0.0_dp, "behind it")
        call own(t//"Q_y = 'F abs(sin(10 t)) + exp(-x)/(1 + y^2) + cos(t)'", system, [-2.0_dp])
        call find_brief_forces(system, 0.1_dp, 10.0_dp, brief)
        call assertEqual(acos(-1.0_dp)/10 - 0.1_dp, brief%longest_step(0.1_dp), 1e-13_dp, "turns")
        call find_brief_forces(system, 0.1_dp, 100.0_dp, brief)
        call assertEqual(never, brief%longest_step(0.1_dp), 0.0_dp, "kinks without number")
        call own(t//"Q_y = 'F abs(sin(10 t)) exp(-(sin(10 t)/0.1)^2)'", system, [-2.0_dp])
        call find_brief_forces(system, 0.1_dp, 100.0_dp, brief)
        h = brief%longest_step(0.1_dp)
        call assertTrue(2*sigma/10 <= h .and. h <= 4*sigma/10, "kicks without number")
    end subroutine where_moments_are

    subroutine moments_of_any_shape()
        !! Of a peak that is steep on one side, of a denominator, of a kink at a negative time and
        !! of one in a motion as short as rounding; of as many as are told apart.
        class(system_t), allocatable :: system
        character(*), parameter :: t = "parameters = 'F' T = '(x_dot^2 + y_dot^2)/2' V = '0' "
        type(brief_forces_t) :: brief
        real(dp), parameter :: never = huge(1.0_dp), ulp = spacing(31.0_dp)
        integer :: i

        call own(t//"Q_y = 'F exp(-exp(-(t - 31)/0.1) - (t - 31)/10)'", system, [-2.0_dp])
        if (anyExceptions()) return
        call find_brief_forces(system, 1.0_dp, 101.0_dp, brief)
        call assertTrue(brief%longest_step(31.46_dp) < 2, "its steep side counts")
        call own(t//"Q_y = 'F/(1 + ((t - 31)/0.1)^2)'", system, [-2.0_dp])
        call find_brief_forces(system, 1.0_dp, 101.0_dp, brief)
        call assertTrue(brief%longest_step(31.0_dp) < 0.4_dp, "a denominator")
        call own(t//"Q_y = 'F sgn(t + 31)'", system, [-2.0_dp])
        call find_brief_forces(system, -101.0_dp, -1.0_dp, brief)
        call assertEqual(70.0_dp, brief%longest_step(-101.0_dp), 1e-12_dp, "before 0")
        i = nint(brief%longest_step(-31.0_dp)/spacing(101.0_dp))
        call assertEqual(32, i, "roundings of the times")
        call find_brief_forces(system, -31 - 500*ulp, -31 + 500*ulp, brief)
        call assertEqual(never, brief%longest_step(-31 - 500*ulp), 0.0_dp, "all is rounding")
        brief = brief_forces_t()
        do i = 1, 200
            call brief%add(100.0_dp*i, 0.1_dp, kink=.false.)
        end do
        call assertEqual(never, brief%longest_step(20050.0_dp), 0.0_dp, "behind two hundred")
        call assertTrue(brief%longest_step(20000.0_dp) < 1, "the last of them")
        call brief%add(30000.0_dp, 0.1_dp, kink=.false.)
        call assertTrue(brief%longest_step(20050.0_dp) < 1, "more are everywhere")
    end subroutine moments_of_any_shape

    subroutine functions_are_counted()
        !! Those of the time alone, wherever they stand.
        class(system_t), allocatable :: system
        character(*), parameter :: t = "parameters = 'F' T = '(x_dot^2 + y_dot^2)/2' V = "

        call own(t//"'0' Q_y = 'F abs(sin(10 t)) + exp(-x)/(1 + y^2) + cos(t) + exp(-x t)'", &
                 system, [2.0_dp])
        if (anyExceptions()) return
        call assertEqual(1, functions_of(system), "one beside those of places")
        call own(t//"'x exp(-t^2)' Q_x = 'tanh(t)' Q_y = 'F sgn(t) + abs(F)'", system, [2.0_dp])
        call assertEqual(3, functions_of(system), "in V and two forces")
        call own(t//"'x y' constraint = 'y = exp(-(t - 31)^2)'", system, [2.0_dp])
        call assertEqual(1, functions_of(system), "in a constraint")
        call own(t//"'x y exp(-x)' Q_y = 'F cos(t)'", system, [2.0_dp])
        call assertEqual(0, functions_of(system), "none")
    end subroutine functions_are_counted

    integer function functions_of(system) result(number)
        !! How many of the time alone an own system has; -1: nobody has looked.
        class(system_t), intent(in) :: system

        number = -1
        select type (system)
        class is (lagrangian_system_t)
            if (allocated(system%time_functions%kinds)) number = size(system%time_functions%kinds)
        end select
    end function functions_of

    subroutine steady_forces()
        !! Neither what always changes nor what the time is not in has moments.
        class(system_t), allocatable :: system
        character(*), parameter :: t = "parameters = 'F' T = '(x_dot^2 + y_dot^2)/2' V = '0' "
        type(brief_forces_t) :: brief
        character(40), parameter :: forces(7) = [character(40) :: "F cos(t)", "-F y", &
            "F exp(-(x - 5)^2 t)", "t^2/(1 + y_dot^2)", "F t^3 + x^(-2)", "F exp(-t/10)", &
            "F (1 + t^2)^0.5"]
        integer :: i

        do i = 1, size(forces)
            call own(t//"Q_y = '"//trim(forces(i))//"'", system, [2.0_dp])
            if (anyExceptions()) return
            call find_brief_forces(system, -1.0_dp, 101.0_dp, brief)
            call assertEqual(huge(1.0_dp), brief%longest_step(1.0_dp), 0.0_dp, forces(i))
        end do
    end subroutine steady_forces
end module test_brief_force
