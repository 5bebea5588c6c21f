module test_constrained_modes
    !! Small oscillations with constraints beside L, against the same system in coordinates that
    !! obey them.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: new_system
    use lagrangia_damped_rates, only: damped_rates
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_small_oscillations, only: find_modes, is_oscillation, is_zero_mode, modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    use stated_text, only: is_said
    implicit none (type, external)
    private
    public :: constrained_modes_suite

    character, parameter :: line_feed = new_line("a")
    real(dp), parameter :: m1 = 2.3_dp, m2 = 0.7_dp, l1 = 0.9_dp, l2 = 1.4_dp, g = 9.81_dp
    character(*), parameter :: rods = "coordinates = 'x1', 'y1', 'x2', 'y2', "// &
        "parameters = 'm1', 'm2', 'l1', 'l2', 'g', 'b', "// &
        "T = 'm1/2 (x1_dot^2 + y1_dot^2) + m2/2 (x2_dot^2 + y2_dot^2)', "// &
        "V = 'm1 g y1 + m2 g y2', Q_x1 = '-b x1_dot', Q_y1 = '-b y1_dot', "// &
        "constraint = 'x1^2 + y1^2 = l1^2', '(x2 - x1)^2 + (y2 - y1)^2 = l2^2'"
    character(*), parameter :: rods_values = "m1 = 2.3, m2 = 0.7, l1 = 0.9, l2 = 1.4, g = 9.81, "
    character(*), parameter :: wheel = "coordinates = 'x', 'phi', parameters = 'm', 'I', 'k', "// &
        "'r', T = 'm/2 x_dot^2 + I/2 phi_dot^2', V = 'k/2 x^2', "

contains

    function constrained_modes_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("constrained_modes")
        call suite%addTest(TestMethod("two_rods_in_x_and_y", two_rods_in_x_and_y))
        call suite%addTest(TestMethod("drag_of_two_rods", drag_of_two_rods))
        call suite%addTest(TestMethod("found_from_near_by", found_from_near_by))
        call suite%addTest(TestMethod("found_from_far", found_from_far))
        call suite%addTest(TestMethod("forces_that_cancel", forces_that_cancel))
        call suite%addTest(TestMethod("constraints_that_integrate", constraints_that_integrate))
        call suite%addTest(TestMethod("refusals", refusals))
    end function constrained_modes_suite

    subroutine read_typed(lines, values, start, system, error)
        !! The system of a group `&lagrangian` with values of the parameters.
        character(*), intent(in) :: lines, values, start
        class(system_t), allocatable, intent(out) :: system
        type(error_t), allocatable, intent(out) :: error
        type(scene_t) :: scene
        type(word_t) :: none(0)

        call parse_scene("&scene dt = 0.01, duration = 1.0, system = 'own', q = "//start//" /"// &
                         line_feed//"&lagrangian "//lines//" /"//line_feed//"&own "//values// &
                         " /"//line_feed, "scene", none, scene, system, error)
    end subroutine read_typed

    subroutine typed_modes(lines, values, start, wanted, system, modes)
        !! Its modes at `start`.
        character(*), intent(in) :: lines, values
        real(dp), intent(in) :: start(:)
        logical, intent(in) :: wanted
        class(system_t), allocatable, intent(out) :: system
        type(modes_t), intent(out) :: modes
        type(error_t), allocatable :: error
        character(25*size(start)) :: text

        write (text, "(*(g0, :, ','))") start
        call read_typed(lines, values, trim(text), system, error)
        if (.not. allocated(error)) call find_modes(system, start, wanted, modes, error)
        call assertFalse(allocated(error), "there are modes")
        if (allocated(error)) call assertEqual("", error%message)
    end subroutine typed_modes

    subroutine two_rods_in_x_and_y()
        !! \(\omega^2\) of the double pendulum; the rods pull with \((m_1 + m_2)g\) and \(m_2g\);
        !! the shapes are \(\ell_1\theta_1\), \(\ell_1\theta_1 + \ell_2\theta_2\) and level.
        class(system_t), allocatable :: system, by_hand
        type(error_t), allocatable :: error
        type(modes_t) :: modes, expected
        real(dp) :: u(4), angles(2)
        integer :: j

        call typed_modes(rods, rods_values//"b = 0.0", [0.0_dp, -l1, 0.0_dp, -l1 - l2], .true., &
                         system, modes)
        if (anyExceptions()) return
        call new_system("double_pendulum", by_hand, error)
        call by_hand%configure([m1, m2, l1, l2, g], error)
        call find_modes(by_hand, [0.0_dp, 0.0_dp], .true., expected, error)
        call assertEqual(expected%omega2, modes%omega2, 1e-13_dp*maxval(expected%omega2))
        call assertEqual([-(m1 + m2)*g/(2.0_dp*l1), -m2*g/(2.0_dp*l2)], modes%multipliers, &
                         1e-13_dp*(m1 + m2)*g/l1)
        call assertEqual(2, size(modes%shapes, 2))
        call assertTrue(all(modes%label == is_oscillation), "both oscillate")
        do j = 1, 2
            u = modes%shapes(:, j)
            angles = [u(1)/l1, (u(3) - u(1))/l2]
            call assertEqual([0.0_dp, 0.0_dp], u([2, 4]), 1e-13_dp)
            angles = angles*sign(1.0_dp, angles(1)*expected%shapes(1, j))
            call assertEqual(expected%shapes(:, j), angles, 1e-12_dp)
        end do
        call find_modes(system, [0.0_dp, l1, 0.0_dp, l1 + l2], .true., modes, error)
        call find_modes(by_hand, acos([-1.0_dp, -1.0_dp]), .false., expected, error)
        call assertEqual(expected%omega2, modes%omega2, 1e-13_dp*maxval(abs(expected%omega2)))
    end subroutine two_rods_in_x_and_y

    subroutine drag_of_two_rods()
        !! Damped exponents are those of the angles, where the drag is \(-b\ell_1^2\dot\theta_1\).
        character(*), parameter :: in_angles = "coordinates = 'q1', 'q2', parameters = 'm1', "// &
            "'m2', 'l1', 'l2', 'g', 'b', T = '(m1 + m2)/2 l1^2 q1_dot^2 + m2/2 l2^2 q2_dot^2 ' "// &
            "'+ m2 l1 l2 q1_dot q2_dot cos(q1 - q2)', "// &
            "V = '-(m1 + m2) g l1 cos(q1) - m2 g l2 cos(q2)', Q_q1 = '-b l1^2 q1_dot'"
        class(system_t), allocatable :: system, other
        type(modes_t) :: modes, expected
        type(error_t), allocatable :: error
        complex(dp), allocatable :: lambda(:), by_angles(:)

        call typed_modes(rods, rods_values//"b = 0.4", [0.0_dp, -l1, 0.0_dp, -l1 - l2], .true., &
                         system, modes)
        call typed_modes(in_angles, rods_values//"b = 0.4", [0.0_dp, 0.0_dp], .true., other, &
                         expected)
        if (anyExceptions()) return
        call damped_rates(system, modes, lambda, error)
        call damped_rates(other, expected, by_angles, error)
        call assertEqual(2, size(lambda))
        if (anyExceptions()) return
        call assertEqual(real(by_angles), real(lambda), 1e-12_dp)
        call assertEqual(aimag(by_angles), aimag(lambda), 1e-12_dp)
    end subroutine drag_of_two_rods

    subroutine found_from_near_by()
        !! Off the equilibrium, and off the constraints, Newton's method goes to it along them.
        class(system_t), allocatable :: system
        type(modes_t) :: modes
        type(error_t), allocatable :: error

        call typed_modes(rods, rods_values//"b = 0.0", [0.0_dp, -l1, 0.0_dp, -l1 - l2], .true., &
                         system, modes)
        if (anyExceptions()) return
        call find_modes(system, [0.2_dp, -0.8_dp, 0.5_dp, -2.1_dp], .false., modes, error)
        call assertFalse(allocated(error), "found")
        call assertEqual([0.0_dp, -l1, 0.0_dp, -l1 - l2], modes%at, 1e-14_dp)
        call find_modes(system, [0.2_dp, -0.8_dp, 0.5_dp, -2.1_dp], .true., modes, error)
        call assert_refused(error, "not a place that the constraints of own allow; the nearest "// &
                            "is 0.0,-0.9,0.0,-2.3")
        ! on the constraints, but not at rest
        call find_modes(system, [0.54_dp, -0.72_dp, 0.54_dp, -2.12_dp], .true., modes, error)
        call assert_refused(error, "not an equilibrium of own: the force on x1 is ... J; the "// &
                                   "nearest is 0.0,-0.9,0.0,-2.3")
    end subroutine found_from_near_by

    subroutine found_from_far()
        !! Without constraints: for \(V = k\sqrt{1 + u^2}\), \(u = (x - a)/\ell\), Newton's method
        !! goes from u to \(-u^3\), away from the minimum, which is found by going down.
        character(*), parameter :: body = "coordinates = 'x', parameters = 'm', 'k', 'l', 'a', "// &
                                          "T = 'm/2 x_dot^2', "
        class(system_t), allocatable :: system
        type(modes_t) :: modes
        type(error_t), allocatable :: error

        call typed_modes(body//"V = 'k sqrt(1 + (x - a)^2/l^2)'", "m = 2.0, k = 3.0, l = 0.5, "// &
                         "a = 3.0", [0.1_dp], .false., system, modes)
        if (anyExceptions()) return
        call assertEqual(3.0_dp, modes%at(1), 1e-14_dp)
        call assertEqual(3.0_dp/(2.0_dp*0.5_dp**2), modes%omega2(1), 1e-13_dp)
        ! down for ever
        call read_typed(body//"V = 'k a atan(x/l)'", "m = 2.0, k = 3.0, l = 0.5, a = 3.0", "0.1", &
                        system, error)
        call assertFalse(allocated(error), "read")
        call find_modes(system, [0.1_dp], .false., modes, error)
        call assert_refused(error, "not an equilibrium of own: the force on x is ... J; none "// &
                                   "is near")
    end subroutine found_from_far

    subroutine forces_that_cancel()
        !! 0.1 + 0.2 - 0.3 of doubles is 5.6e-17: where nothing is stiff, rounding is no force.
        !! Drag that is felt by one of two bodies leaves the other's oscillation as it is.
        character(*), parameter :: bodies = "coordinates = 'x', 'y', parameters = 'm', 'a', "// &
            "'b', 'c', T = 'm/2 (x_dot^2 + y_dot^2)', "
        class(system_t), allocatable :: system
        type(modes_t) :: modes
        type(error_t), allocatable :: error
        complex(dp), allocatable :: lambda(:)

        call typed_modes(bodies//"V = '(a + b - c) x + y^2'", "m = 1.0, a = 0.1, b = 0.2, "// &
                         "c = 0.3", [0.0_dp, 0.0_dp], .true., system, modes)
        if (anyExceptions()) return
        call assertEqual([0.0_dp, 2.0_dp], modes%omega2, 1e-15_dp)
        call read_typed(bodies//"V = '(a + b - c) x + y^2'", "m = 1.0, a = 0.1, b = 0.2, "// &
                        "c = 0.30000001", "0.0, 0.0", system, error)
        call assertFalse(allocated(error), "read")
        call find_modes(system, [0.0_dp, 0.0_dp], .false., modes, error)
        call assert_refused(error, "not an equilibrium of own: the force on x is ... J; none "// &
                                   "is near")
        call typed_modes(bodies//"V = '3 (x - y)^2 + 5 (x + y)^2', Q_y = 'a x_dot - b x_dot'", &
                         "m = 1.0, a = 0.1, b = 0.1, c = 0.0", [0.0_dp, 0.0_dp], .true., system, &
                         modes)
        if (anyExceptions()) return
        call damped_rates(system, modes, lambda, error)
        call assertEqual([0.0_dp, 0.0_dp], real(lambda), 0.0_dp)
    end subroutine forces_that_cancel

    subroutine constraints_that_integrate()
        !! A wheel that rolls along a line is holonomic though its constraint is in velocities, and
        !! so is one with an integrating factor; \(\omega^2 = k/(m + I/r^2)\).
        class(system_t), allocatable :: system
        type(modes_t) :: modes

        call typed_modes(wheel//"constraint = 'x_dot = r phi_dot'", &
                         "m = 2.0, I = 0.3, k = 5.0, r = 0.4", [0.0_dp, 0.0_dp], .true., system, &
                         modes)
        if (anyExceptions()) return
        call assertEqual([5.0_dp/(2.0_dp + 0.3_dp/0.16_dp)], modes%omega2, 1e-14_dp)
        call typed_modes(wheel//"constraint = 'exp(x + phi) (x_dot - r phi_dot) = 0'", &
                         "m = 2.0, I = 0.3, k = 5.0, r = 0.4", [0.0_dp, 0.2_dp], .true., system, &
                         modes)
        if (anyExceptions()) return
        call assertEqual([5.0_dp/(2.0_dp + 0.3_dp/0.16_dp)], modes%omega2, 1e-14_dp)
        call typed_modes(wheel//"constraint = 'x_dot = r phi_dot'", &
                         "m = 2.0, I = 0.3, k = 0.0, r = 0.4", [0.0_dp, 0.0_dp], .true., system, &
                         modes)
        if (anyExceptions()) return
        call assertEqual(is_zero_mode, modes%label(1))
    end subroutine constraints_that_integrate

    subroutine refusals()
        !! No integral, the time, no unique multipliers.
        class(system_t), allocatable :: system
        type(modes_t) :: modes
        type(error_t), allocatable :: error

        call read_typed("coordinates = 'x', 'y', 'phi', parameters = 'm', T = 'm/2 (x_dot^2 "// &
                        "+ y_dot^2 + phi_dot^2)', constraint = 'x_dot sin(phi) = y_dot cos(phi)'", &
                        "m = 1.0", "0.0, 0.0, 0.0", system, error)
        call find_modes(system, [0.0_dp, 0.0_dp, 0.0_dp], .true., modes, error)
        call assert_refused(error, "own: its constraints are nonholonomic: steady motions, "// &
                                   "but no modes about an equilibrium")
        call read_typed("coordinates = 'x', 'y', parameters = 'w', T = '(x_dot^2 + y_dot^2)/2',"// &
                        " constraint = 'x sin(w t) = y cos(w t)'", "w = 1.0", "1.0, 0.0", system, &
                        error)
        call find_modes(system, [1.0_dp, 0.0_dp], .false., modes, error)
        call assert_refused(error, "own: a constraint contains the time: there is no "// &
                                   "equilibrium to oscillate about")
        call read_typed("coordinates = 'x', 'y', parameters = 'l', T = '(x_dot^2 + y_dot^2)/2',"// &
                        " constraint = 'x^2 + y^2 = l^2'", "l = 1.0", "0.0, -1.0", system, error)
        call find_modes(system, [0.0_dp, 0.0_dp], .false., modes, error)
        call assert_refused(error, "not independent at q = 0.0, 0.0; an equilibrium "// &
                                   "elsewhere is needed")
    end subroutine refusals

    subroutine assert_refused(error, text)
        !! With status 2 and this text in the message.
        type(error_t), allocatable, intent(in) :: error
        character(*), intent(in) :: text

        call assertTrue(allocated(error), "refused")
        if (.not. allocated(error)) return
        call assertEqual(2, error%status)
        call assertTrue(is_said(error%message, text), error%message)
    end subroutine assert_refused
end module test_constrained_modes
