module test_motion_statements
    !! Motions that are written out, frequencies as numbers, systems without an equilibrium.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_constant_values, only: solve_constants
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_judgement, only: is_definition, is_right, is_unreadable, is_wrong
    use lagrangia_kinds, only: dp
    use lagrangia_mode_samples, only: stable_somewhere
    use lagrangia_sample_names, only: draws, samples_t
    use lagrangia_scene_reader, only: read_named_system
    use lagrangia_small_oscillations, only: find_modes, modes_t
    use lagrangia_symbols, only: symbols_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text, word_t
    use tried_responses, only: judged
    implicit none (type, external)
    private
    public :: motion_statements_suite

    character, parameter :: line_feed = new_line("a")

contains

    function motion_statements_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("motion_statements")
        call suite%addTest(TestMethod("motions", motions))
        call suite%addTest(TestMethod("starts", starts))
        call suite%addTest(TestMethod("frequencies_as_numbers", frequencies_as_numbers))
        call suite%addTest(TestMethod("no_equilibrium", no_equilibrium))
        call suite%addTest(TestMethod("small_is_not_zero", small_is_not_zero))
        call suite%addTest(TestMethod("constants_have_converged", constants_have_converged))
        call suite%addTest(TestMethod("constants_at_some_states", constants_at_some_states))
        call suite%addTest(TestMethod("where_it_can_swing", where_it_can_swing))
    end function motion_statements_suite

    subroutine motions()
        !! Right if they solve the equation of motion or the linearised one.
        integer :: i

        call judged("pendulum", &
                    "theta(t) = A cos(omega t + phi)", is_right)
        call judged("pendulum", &
                    "theta = theta_0 cos(sqrt(g/l) t)", is_right)
        call judged("pendulum", &
                    "small: theta = A cos(omega t) + B sin(omega t)", is_right)
        call judged("pendulum", &
                    "theta = A cos(omega t)^2", is_wrong)
        call judged("pendulum", &
                    "theta = A cos(sqrt(l/g) t)", is_wrong)
        call judged("pendulum", &
                    "theta = A exp(-omega t)", is_wrong)
        call judged("pendulum", &
                    "theta = A e^(-gamma t) cos(omega t + delta)", is_right)
        call judged("pendulum", &
                    "theta = A cos(omega t + phi)"//line_feed//"theta_dot = -A"// &
                    " omega sin(omega t + phi)", is_right)
        call judged("pendulum", &
                    "theta = A cos(omega t + phi)"//line_feed//"theta_dot = A"// &
                    " omega sin(omega t + phi)", is_wrong)
        call judged("pendulum", &
                    "theta = A cos(omega t + phi)"//line_feed//"theta_ddot ="// &
                    " -omega^2 A cos(omega t + phi)", is_right)
        call judged("pendulum", &
                    "theta = theta_0 cos(omega t) + theta_dot0/omega sin(omega t)", is_right)
        call judged("pendulum", &
                    "\theta(t) = A\cos(\omega t+\varphi)", is_right)
        call judged("pendulum", &
                    "\theta = A\cos\omega t + B\sin\omega t", is_right)
        call judged("pendulum", &
                    "omega_0 = sqrt(g/l)"//line_feed//"theta = A cos(omega_0 t)", is_right)
        call judged("pendulum", &
                    "omega_0 = sqrt(l/g)"//line_feed//"theta = A cos(omega_0 t)", is_wrong)
        call judged("pendulum", &
                    "theta = A cos(2 pi t/T)", is_right)
        call judged("pendulum", &
                    "theta = omega t", is_wrong)
        call judged("oscillator", &
                    "x(t) = x0 cos(omega t) + v0/omega sin(omega t)", is_right)
        call judged("oscillator", &
                    "omega_2 = sqrt(omega_0^2 - gamma^2)", is_right)
        call judged("oscillator", "constant: A, B"//line_feed// &
                    "A = x cos(omega t) - x_dot/omega sin(omega t)", is_right)
        call judged("charged_particle", &
                    "z = 0.1 + 2 t"//line_feed//"z_dot = 2", is_right)
        call judged("oscillator", &
                    "x = x_0 cos(sqrt(k/m) t)", is_right)
        call judged("oscillator", &
                    "x = x_0 cos(k/m t)", is_wrong)
        call judged("oscillator", &
                    "x = x_0 cos(omega t) + v0 sin(omega t) + 1", is_wrong)
        call judged("double_pendulum", &
                    "theta1 = A cos(omega t + phi)", is_right)
        call judged("double_pendulum", &
                    "theta1 = A_1 cos(omega_1 t + phi_1) + A_2 cos(omega_2 t + phi_2)", is_right)
        call judged("double_pendulum", &
                    "theta1 = A cos(sqrt(g/l1) t)", is_wrong)
        do i = 3, 4  ! of other modes than there are, of the other equilibrium and of none
            call judged("double_pendulum", "theta1 = A cos(w"//to_text(i)//" t)", is_wrong, &
                        "'w"//to_text(i)//"' is the frequency of no mode; there are 2")
        end do
        call judged("cart_pendulum", &
                    "theta = A cos(omega t)", is_right)
        call judged("cart_pendulum", &
                    "x = x0 + v0 t + B cos(omega t)", is_right)
        call judged("cart_pendulum", &
                    "x = x0 + v0 t + a t^2/2", is_unreadable)
        call judged("cart_pendulum", &
                    "theta = A cos(sqrt((m1 + m2) g/(m1 l)) t)", is_right)
        call judged("cart_pendulum", &
                    "theta = A cos(sqrt((m1 + m2) g/(m2 l)) t)", is_wrong)
        call judged("atwood", &
                    "x = x0 + v0 t + (m1 - m2)/(m1 + m2) g t^2/2", is_right)
        call judged("atwood", &
                    "x = x0 + v0 t + (m1 - m2)/(m1 + m2) g t^2", is_wrong)
        call judged("atwood", &
                    "x = (m1 - m2)/(m1 + m2) g t^2/2"//line_feed//"x_dot = (m1 -"// &
                    " m2)/(m1 + m2) g t", is_right)
        call judged("atwood", &
                    "x = x0 + v0 t", is_wrong)
        call judged("rotating_hoop", &
                    "theta = A cos(sqrt(g/r - omega^2) t)", is_right)
        call judged("rotating_hoop", &
                    "theta = theta_eq + A cos(Omega t)", is_right)
        call judged("rotating_hoop", &
                    "theta = theta_eq + A cos(omega t)", is_wrong)
        call judged("rolling_disk", &
                    "x = A t", is_unreadable)
        call judged("charged_particle", &
                    "x = R cos(Omega t)", is_unreadable)
        call judged("pendulum", "theta = A cos(q t)", is_unreadable, &
                    "what is 'q'? Write a line before, q = ..., or omega and gamma for what "// &
                    "the program knows")
    end subroutine motions

    subroutine starts()
        !! Of any motion, or of that of a line before. A start that is read as a product with 0
        !! would be wrong.
        call judged("pendulum", "theta(0) = 1.0", is_definition)
        call judged("pendulum", "theta(t = 0) = theta_0", is_definition)
        call judged("pendulum", "\dot\theta(0) = 0", is_definition)
        call judged("cart_pendulum", "x_dot(t=0) = v_0", is_definition)
        call judged("pendulum", "theta = A cos(omega t + phi)"//line_feed// &
                    "theta(0) = A cos(phi)", is_right)
        call judged("pendulum", "theta = A cos(omega t + phi)"//line_feed// &
                    "theta_dot(0) = -A omega sin(phi)", is_right)
        call judged("pendulum", "theta = A cos(omega t + phi)"//line_feed// &
                    "theta_dot(0) = A omega sin(phi)", is_wrong)
        call judged("pendulum", "theta = A cos(omega t + phi)"//line_feed// &
                    "theta(0) = theta_0", is_definition)
        call judged("pendulum", "theta = A cos(omega t)"//line_feed//"theta(0) = 1.0", &
                    is_definition)
        call judged("pendulum", "theta(0) = theta", is_unreadable)
    end subroutine starts

    subroutine frequencies_as_numbers()
        !! To the digits given, where lines `set:` fix all parameters; else they are new names.
        character(*), parameter :: sheet = "set: g = 9.81"//line_feed//"set: l1 = 1"//line_feed// &
            "set: l2 = 1"//line_feed//"set: m1 = 1"//line_feed//"set: m2 = 1"//line_feed

        call judged("double_pendulum", sheet//"omega_1 = 2.40", is_right, "to the digits given")
        call judged("double_pendulum", sheet//"omega_2 = 5.79", is_right, "to the digits given")
        call judged("double_pendulum", sheet//"omega_1 = 2.50", is_wrong, "the left side is "// &
                                                                          "2.397 or 5.787")
        call judged("double_pendulum", "omega_1 = 2.50", is_definition)
        ! gamma is that of the drag b, which nobody names
        call judged("pendulum", "theta_ddot + 2 gamma theta_dot + g/l sin(theta) = 0", is_right)
        call judged("pendulum", "theta_ddot - 2 gamma theta_dot + g/l sin(theta) = 0", is_wrong)
        call judged("double_pendulum", "L_z = const", is_wrong, "it changes")
        call judged("double_pendulum", "set: g = 0"//line_feed//"L_z = const", is_right)
    end subroutine frequencies_as_numbers

    subroutine no_equilibrium()
        !! In words, with what to type.
        class(system_t), allocatable :: system
        type(modes_t) :: modes
        type(error_t), allocatable :: error
        type(word_t) :: none(0)

        call read_named_system("kepler", none, system, error)
        call assertFalse(allocated(error), "kepler")
        if (allocated(error)) return
        call find_modes(system, [0.0_dp, 0.0_dp], .false., modes, error)
        call assertTrue(allocated(error), "none")
        call assertEqual("kepler has no equilibrium that is found: at r,phi = 0.0, 0.0 L is no "// &
                         "finite number, and at rest elsewhere a force on r remains; if you "// &
                         "know one, give its r,phi", error%message)
        call assertEqual(2, error%status)
        call find_modes(system, [0.0_dp, 0.0_dp], .true., modes, error)
        call assertEqual("L of kepler is no finite number at r,phi = 0.0, 0.0; other "// &
                         "values are needed", error%message)
    end subroutine no_equilibrium

    subroutine small_is_not_zero()
        !! The accelerations of weak gravity are far below those that rounding leaves beside a
        !! vertical wedge.
        character(*), parameter :: weak = "set: g = 1e-16"//line_feed
        character(*), parameter :: vertical = "set: alpha = 1.5707963267948966"//line_feed

        call judged("pendulum", weak//"theta_ddot = -g/l sin(theta)", is_right)
        call judged("pendulum", weak//"theta_ddot = 0", is_wrong)
        call judged("pendulum", weak//"theta_ddot = -2 g/l sin(theta)", is_wrong)
        call judged("wedge", vertical//"q2_ddot = 0", is_right)
        call judged("wedge", vertical//"q1_ddot = g", is_right)
        call judged("wedge", vertical//"q1_ddot = 0", is_wrong)
    end subroutine small_is_not_zero

    subroutine constants_have_converged()
        !! All of them: a root of eightfold multiplicity gains a factor of 7/8 a step, so that 60
        !! of them end 1e-4 beside it, where its equation holds to 1e-30.
        character, parameter :: names(4) = ["x", "y", "A", "B"]
        type(symbols_t) :: symbols
        type(expression_t) :: equations(2)
        type(error_t), allocatable :: error
        real(dp) :: values(6, 4)
        logical :: regular
        integer :: i

        do i = 1, size(names)
            call symbols%add(names(i))
        end do
        do i = 1, size(values, 1)
            values(i, :) = [0.1_dp*i, 1.05_dp/i, 0.3_dp, 0.4_dp]
        end do
        call parse_formula("A - x", symbols, equations(1), error)
        call parse_formula("B^2 - y - A", symbols, equations(2), error)
        call solve_constants(equations, [3, 4], values, regular)
        call assertTrue(regular .and. all(ieee_is_finite(values)), "simple roots")
        call assertEqual(values(:, 1), values(:, 3), 1e-14_dp, "A")
        call assertEqual(sqrt(values(:, 2) + values(:, 1)), abs(values(:, 4)), 1e-14_dp, "B")
        values(:, 3:) = 0.3_dp
        call parse_formula("(B - y)^8", symbols, equations(2), error)
        call solve_constants(equations, [3, 4], values, regular)
        call assertTrue(regular .and. all(ieee_is_nan(values(:, 4))), "B has not converged")
    end subroutine constants_have_converged

    subroutine constants_at_some_states()
        !! A = 1/x follows where x is not 0. Newton's steps for \(\arctan(A - c) = 0\) lead to c
        !! from no farther than 1.39: to either side of 0.3 there are other beginnings, from 0.7
        !! less to 1.4 more.
        character, parameter :: names(2) = ["x", "A"]
        type(symbols_t) :: symbols
        type(expression_t) :: equation(1)
        type(error_t), allocatable :: error
        real(dp) :: values(5, 2)
        logical :: regular
        integer :: i

        do i = 1, size(names)
            call symbols%add(names(i))
        end do
        call parse_formula("A x - 1", symbols, equation(1), error)
        values(:, 1) = [0.0_dp, 0.5_dp, -2.0_dp, 0.0_dp, 4.0_dp]
        values(:, 2) = 0.3_dp
        call solve_constants(equation, [2], values, regular)
        call assertTrue(regular, "somewhere")
        call assertEqual([2.0_dp, -0.5_dp, 0.25_dp], values([2, 3, 5], 2), 1e-15_dp, "there")
        call assertTrue(all(ieee_is_nan(values([1, 4], 2))), "elsewhere")
        values(:, 1) = 0.0_dp
        values(:, 2) = 0.3_dp
        call solve_constants(equation, [2], values, regular)
        call assertFalse(regular, "nowhere")
        call parse_formula("atan(A - x)", symbols, equation(1), error)
        values(:, 1) = [-3.0_dp, -1.6_dp, 0.3_dp, 3.0_dp, 4.0_dp]
        values(:, 2) = 0.3_dp
        call solve_constants(equation, [2], values, regular)
        call assertEqual(values(2:4, 1), values(2:4, 2), 1e-14_dp, "near")
        call assertTrue(all(ieee_is_nan(values([1, 5], 2))), "far")
    end subroutine constants_at_some_states

    subroutine where_it_can_swing()
        !! For some parameters about the place at or near zero, which of a hoop that turns too fast
        !! is not the lowest point: that is the other place, and unstable.
        call assertTrue(swings(0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp), "free for all")
        call assertTrue(swings(4.0_dp, 0.0_dp, 0.0_dp, 0.0_dp), "about zero")
        call assertFalse(swings(-4.0_dp, 0.0_dp, 0.0_dp, 0.0_dp), "nowhere")
        call assertTrue(swings(4.0_dp, -3.0_dp, 0.5_dp, 0.0_dp), "unstable elsewhere")
        call assertFalse(swings(4.0_dp, -3.0_dp, 0.0_dp, 0.0_dp), "tilted")
        call assertTrue(swings(4.0_dp, 3.0_dp, 0.0_dp, 0.0_dp), "stable at zero, too")
        call assertTrue(swings(-4.0_dp, 0.0_dp, 0.0_dp, 1.0_dp), "for one draw")
        call assertFalse(swings(4.0_dp, -3.0_dp, 0.0_dp, -1.0_dp), "for no draw")
    contains
        function swings(square, elsewhere, place, last) result(yes)
            real(dp), intent(in) :: square, elsewhere  !! omega^2 of both places
            real(dp), intent(in) :: place              !! the other one
            real(dp), intent(in) :: last               !! if not 0, omega^2 of the last draw
            logical :: yes
            type(samples_t) :: samples

            samples%ndof = 1
            allocate (samples%omega2(draws, 2), samples%other_equilibrium(1, draws))
            samples%omega2(:, 1) = square
            samples%omega2(:, 2) = elsewhere
            samples%other_equilibrium = place
            if (abs(last) > 0.0_dp) samples%omega2(draws, 1) = last
            yes = stable_somewhere(samples)
        end function swings
    end subroutine where_it_can_swing
end module test_motion_statements
