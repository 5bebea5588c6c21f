module test_brief_force
    !! A force that acts for a moment, or far from where a motion begins, is neither overlooked by
    !! the structure of an own system nor gone over by long steps.
    use funit, only: anyExceptions, assertEqual, assertFalse, assertTrue, TestMethod, TestSuite
    use lagrangia_brief_force, only: find_briefest_force, looks
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_outcome, only: outcome_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_sweep, only: sweep_t
    use lagrangia_system, only: system_t
    use scene_runs, only: perform
    use sweep_numbers, only: compute_numbers, make_sweep, sweep_numbers_t
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
        call suite%addTest(TestMethod("how long the briefest force acts", briefest_force))
        call suite%addTest(TestMethod("forces that always change cost nothing", always_changing))
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
        !! \(\dot x = \int F\,dt/m\), and x five seconds of it.
        character(7), parameter :: methods(2) = [character(7) :: "gauss16", "dop853"]
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, size(methods)
            call perform("&scene system = 'kicked' method = '"//trim(methods(i))// &
                         "' tolerance = 1e-10 duration = 10 samples = 10 q = 0.0 / "// &
                         "&lagrangian coordinates = 'x' "//kick//" / &kicked F = 3.0 /", "", &
                         "none", outcome, error)
            if (anyExceptions()) return
            call assertFalse(allocated(error), methods(i))
            call assertEqual(impulse, outcome%v(1), 1e-8_dp, methods(i))
            call assertEqual(5*impulse, outcome%q(1), 5e-8_dp, methods(i))
        end do
    end subroutine runs_meet_a_kick

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

    subroutine briefest_force()
        !! \(\sqrt\pi\,w\) of \(e^{-((t - t_1)/w)^2}\), but for what is below 1e-6 of the peak; of
        !! two, the shorter.
        class(system_t), allocatable :: system
        real(dp), parameter :: q(2) = [0.3_dp, 0.0_dp], v(2) = [0.0_dp, 0.1_dp]
        character(*), parameter :: t = "parameters = 'F' T = '(x_dot^2 + y_dot^2)/2' V = '0' "
        real(dp) :: time
        type(error_t), allocatable :: error
        integer(i8) :: evaluations

        evaluations = 7
        call own(t//"Q_y = 'F exp(-((t - 31)/0.5)^2)'", system, [-2.0_dp])
        if (anyExceptions()) return
        call find_briefest_force(system, 1.0_dp, 101.0_dp, q, v, time, evaluations)
        call assertEqual(0.5_dp*sqrt(acos(-1.0_dp)), time, 1e-6_dp, "one")
        call assertEqual(7 + 4 + looks, int(evaluations), "evaluations are counted")
        call own(t//"Q_y = 'F exp(-((t - 31)/0.5)^2)' Q_x = 'F exp(-((t - 60)/0.25)^2)'", system, &
                 [-2.0_dp])
        call find_briefest_force(system, 1.0_dp, 101.0_dp, q, v, time, evaluations)
        call assertEqual(0.25_dp*sqrt(acos(-1.0_dp)), time, 1e-6_dp, "the later one is shorter")
        call own(t//"Q_x = 'F exp(-((t - 31)/0.25)^2)' Q_y = 'F exp(-((t - 101)/0.5)^2)'", system, &
                 [-2.0_dp])
        call find_briefest_force(system, 1.0_dp, 101.0_dp, q, v, time, evaluations)
        call assertEqual(0.25_dp*sqrt(acos(-1.0_dp)), time, 1e-3_dp, "one that the end cuts")
        call find_briefest_force(system, 41.0_dp, 101.0_dp, q, v, time, evaluations)
        call assertEqual(0.25_dp*sqrt(acos(-1.0_dp)), time, 3e-3_dp, "half of it is there")
        call find_briefest_force(system, 1.0_dp, huge(1.0_dp), q, v, time, evaluations)
        call assertEqual(huge(1.0_dp), time, 0.0_dp, "without an end nothing can be looked at")
        call own(t//"definitions = 'B = F exp(-((t - 31)/0.5)^2)' Q_x = '-B y_dot' "// &
                 "Q_y = 'B x_dot'", system, [-2.0_dp])
        call find_briefest_force(system, 1.0_dp, 101.0_dp, q, 0.0_dp*v, time, evaluations)
        call assertEqual(0.5_dp*sqrt(acos(-1.0_dp)), time, 1e-6_dp, "a magnetic field, from rest")
        call system%configure([0.0_dp], error)
        call find_briefest_force(system, 1.0_dp, 101.0_dp, q, v, time, evaluations)
        call assertEqual(huge(1.0_dp), time, 0.0_dp, "none")
    end subroutine briefest_force

    subroutine always_changing()
        !! They are known after one look; forces that do not contain the time, after none.
        class(system_t), allocatable :: system
        real(dp) :: time
        integer(i8) :: evaluations
        character(*), parameter :: t = "parameters = 'F' T = '(x_dot^2 + y_dot^2)/2' V = '0' "

        evaluations = 0
        call own(t//"Q_y = 'F cos(t)'", system, [2.0_dp])
        if (anyExceptions()) return
        call find_briefest_force(system, 1.0_dp, 101.0_dp, [0.3_dp, 0.0_dp], [0.0_dp, 0.0_dp], &
                                 time, evaluations)
        call assertEqual(4, int(evaluations), "three other times show it")
        call assertEqual(huge(1.0_dp), time, 0.0_dp, "it always acts")
        call own(t//"Q_y = '-F y'", system, [2.0_dp])
        call find_briefest_force(system, 1.0_dp, 101.0_dp, [0.3_dp, 0.0_dp], [0.0_dp, 0.0_dp], &
                                 time, evaluations)
        call assertEqual(4, int(evaluations), "no time in it")
    end subroutine always_changing
end module test_brief_force
