module test_constraints_in_time
    !! Constraints that contain the time, beside others that do not.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_audit_structure, only: audit_flags
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual_t, operator(*)
    use lagrangia_kinds, only: dp
    use lagrangia_ledger, only: ledger_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    use own_systems, only: own_slope_t
    implicit none (type, external)
    private
    public :: constraints_in_time_suite

    type, extends(own_slope_t) :: turning_slope_t
        !! One that becomes steeper, \(\dot y = ct\,\dot x\), or \(ct\,\dot x = 0\).
        logical :: upright = .false.
    contains
        procedure :: constraint_rows => turning_rows
    end type turning_slope_t

contains

    function constraints_in_time_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("constraints_in_time")
        call suite%addTest(TestMethod("one_of_two_constraints_contains_the_time", &
                                      one_of_two_constraints_contains_the_time))
        call suite%addTest(TestMethod("one_of_two_slopes_turns", one_of_two_slopes_turns))
        call suite%addTest(TestMethod("a_row_that_grows_contains_the_time", &
                                      a_row_that_grows_contains_the_time))
        call suite%addTest(TestMethod("a_speed_that_is_a_place", a_speed_that_is_a_place))
    end function constraints_in_time_suite

    subroutine one_of_two_constraints_contains_the_time()
        !! Holonomic, where its drift is constant, and not, where it grows with the time; the other
        !! does not move. Nor does one whose direction turns, which does no work.
        call judge("'x = t', 'y = 2 z'", .true.)
        call judge("'x_dot = t^2', 'y_dot = 2 z_dot'", .true.)
        call judge("'x_dot = t y_dot', 'y_dot = 2 z_dot'", .false.)
    contains
        subroutine judge(constraints, work)
            character(*), intent(in) :: constraints
            logical, intent(in) :: work  !! is done by them
            class(system_t), allocatable :: system
            type(error_t), allocatable :: error
            type(scene_t) :: scene
            type(word_t) :: none(0)

            call parse_scene("&scene system = 'o', dt = 1, duration = 1, q = 0, 0.2, 0.1 / "// &
                             "&lagrangian coordinates = 'x', 'y', 'z', parameters = 'm', T = "// &
                             "'m/2 (x_dot^2 + y_dot^2 + z_dot^2)', constraint = "// &
                             constraints//" / &o m = 1 /", "text", none, scene, system, error)
            call assertFalse(allocated(error), "read: "//constraints)
            if (allocated(error)) return
            call assertTrue(system%time_dependent, "time_dependent: "//constraints)
            call assertEqual(work, system%constraints_work, message="work: "//constraints)
        end subroutine judge
    end subroutine one_of_two_constraints_contains_the_time

    subroutine one_of_two_slopes_turns()
        !! One coefficient of a constraint that is given as code contains the time, or none does.
        type(own_slope_t) :: fixed
        type(turning_slope_t) :: turning
        type(error_t), allocatable :: error

        call fixed%configure([0.75_dp], error)
        call assertFalse(fixed%time_dependent, "a slope")
        call turning%configure([0.75_dp], error)
        call assertTrue(turning%time_dependent, "one that turns")
        call assertFalse(turning%constraints_work, "without work")
    end subroutine one_of_two_slopes_turns

    pure subroutine turning_rows(self, t, q, rows, drift)
        !! See `turning_slope_t`.
        class(turning_slope_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: t, q(self%ndof)
        type(hyperdual_t), intent(out) :: rows(:, :), drift(:)

        call self%own_slope_t%constraint_rows(t, q, rows, drift)
        rows(1, 1) = rows(1, 1)*t
        if (self%upright) rows(1, 2) = hyperdual_t()
    end subroutine turning_rows

    subroutine a_row_that_grows_contains_the_time()
        !! Also where no acceleration does: a mass that falls along a vertical wall.
        character(*), parameter :: claim = "time_dependent says what is true"
        type(turning_slope_t) :: wall
        type(ledger_t) :: audit
        type(error_t), allocatable :: error

        wall%upright = .true.
        call wall%configure([0.75_dp], error)
        call assertTrue(wall%time_dependent, "as it is found")
        call audit%section("wall")
        call audit_flags(audit, wall, 1.0_dp, [0.3_dp, 0.2_dp], [0.0_dp, 0.7_dp], 2.0_dp, &
                         [0.0_dp, -0.4_dp], .true.)
        call assertTrue(audit%row_of(claim) > 0, "it is judged")
        if (audit%row_of(claim) > 0) call assertTrue(audit%rows(audit%row_of(claim))%holds, claim)
    end subroutine a_row_that_grows_contains_the_time

    subroutine a_speed_that_is_a_place()
        !! \(\dot x = y\) has no f(t, q) = c and does not contain the time; with \(y + t\) it does,
        !! and \(\dot x = 2\) has \(x - 2t = c\).
        call judge("x_dot = y", "nonholonomic, scleronomic")
        call judge("x_dot - y - t = 0", "nonholonomic, rheonomic")
        call judge("exp(t) (x_dot - y) = 0", "nonholonomic, scleronomic")
        call judge("x_dot = 2", "holonomic, rheonomic")
    contains
        subroutine judge(constraint, expected)
            character(*), intent(in) :: constraint, expected
            class(system_t), allocatable :: system
            type(description_t) :: d
            type(error_t), allocatable :: error
            type(scene_t) :: scene
            type(word_t) :: none(0)

            call parse_scene("&scene system = 'o', dt = 1, duration = 1, q = 0.5, 1 / "// &
                             "&lagrangian coordinates = 'x', 'y', parameters = 'm', "// &
                             "T = 'm/2 (x_dot^2 + y_dot^2)', constraint = '"//constraint// &
                             "' / &o m = 1 /", "text", none, scene, system, error)
            call assertFalse(allocated(error), "read: "//constraint)
            if (allocated(error)) return
            call system%describe(d)
            call assertEqual(expected, d%constraint, constraint)
        end subroutine judge
    end subroutine a_speed_that_is_a_place
end module test_constraints_in_time
