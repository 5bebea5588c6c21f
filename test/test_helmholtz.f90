module test_helmholtz
    !! Which generalised forces have a potential U(q, q_dot, t).
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_helmholtz, only: potential_text, test_potential
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: helmholtz_suite

    character, parameter :: line_feed = new_line("a")

contains

    function helmholtz_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("helmholtz")
        call suite%addTest(TestMethod("forces_with_a_potential", forces_with_a_potential))
        call suite%addTest(TestMethod("forces_without", forces_without))
        call suite%addTest(TestMethod("nothing_to_say", nothing_to_say))
    end function helmholtz_suite

    subroutine try(forces, has_one, remark)
        !! Of a free point in x, y, z with forces on it.
        character(*), intent(in) :: forces              !! `Q_x = '...', Q_y = '...'`
        logical, intent(out) :: has_one
        character(:), allocatable, intent(out) :: remark
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        type(word_t) :: none(0)

        call parse_scene("&scene system = 'point', dt = 0.1, duration = 1.0, q = 1.0, 1.0, 1 /"// &
            line_feed//"&lagrangian coordinates = 'x', 'y', 'z', parameters = 'm', 'b', "// &
            "T = 'm/2 (x_dot^2 + y_dot^2 + z_dot^2)', "//forces//" /"//line_feed// &
            "&point m = 2.0, b = 0.5 /", "scene", none, scene, system, error)
        has_one = .false.
        remark = ""
        if (allocated(error)) then
            remark = error%message
            return
        end if
        call test_potential(system, has_one, remark)
    end subroutine try

    subroutine forces_with_a_potential()
        !! A magnetic field, uniform and not, with the electric one that its change induces; -dV/dq,
        !! with time in it; and Q of a U that was chosen: U = x y t x_dot + x^2 y_dot.
        call has("Q_x = 'b y_dot', Q_y = '-b x_dot'")
        call has("Q_x = 'b x^2 y y_dot', Q_y = '-b x^2 y x_dot'")
        call has("Q_x = 't y_dot + y/2', Q_y = '-t x_dot - x/2'")
        call has("Q_x = 'z y_dot + y z_dot/2', Q_y = '-z x_dot - x z_dot/2', "// &
                 "Q_z = 'x y_dot/2 - y x_dot/2'")
        call has("Q_x = '-b x y^2 + z cos(t)', Q_y = '-b x^2 y', Q_z = 'x cos(t)'")
        call has("Q_x = 't x y_dot + x y - 2 x y_dot', Q_y = '2 x x_dot - t x x_dot'")
        call has("Q_y = 'm sin(y)'")
    contains
        subroutine has(forces)
            character(*), intent(in) :: forces
            character(:), allocatable :: remark
            logical :: yes

            call try(forces, yes, remark)
            call assertTrue(yes, forces//": "//remark)
            call assertEqual("", remark)
        end subroutine has
    end subroutine forces_with_a_potential

    subroutine forces_without()
        !! Drag, a curl, a field with sources, a field that changes without induction; drag in one
        !! direction only, which half of the states do not show.
        call has_not("Q_x = '-b x_dot'", "dQ_x/dx_dot = -0.5, not 0")
        call has_not("Q_x = '-b x_dot^3'", "dQ_x/dx_dot = ")
        call has_not("Q_x = 'b y_dot', Q_y = 'b x_dot'", "dQ_y/dx_dot = 0.5 is not "// &
                     "-dQ_x/dy_dot = -0.5")
        call has_not("Q_x = 'b y_dot^2'", "dQ_y/dx_dot = 0.0 is not -dQ_x/dy_dot = ")
        call has_not("Q_x = '-b y', Q_y = 'b x'", "dQ_x/dy - dQ_y/dx = -1.0, not 0")
        call has_not("Q_x = 'z y_dot', Q_y = '-z x_dot'", "dQ_x/dy - dQ_y/dx = 0.0, not (d/dt) "// &
                     "dQ_x/dy_dot = ")
        call has_not("Q_x = 't y_dot', Q_y = '-t x_dot'", "dQ_x/dy - dQ_y/dx = 0.0, not (d/dt) "// &
                     "dQ_x/dy_dot = 1.0")
        call has_not("Q_x = '-b (x_dot + |x_dot|)'", "dQ_x/dx_dot = -1.0, not 0")
        call has_not("Q_x = '-b (x_dot - |x_dot|)'", "dQ_x/dx_dot = -1.0, not 0")
        call has_not("Q_x = '-b tanh(1e5 x_dot)'", " as x_dot turns round")
        call has_not("Q_y = '-b sgn(y_dot)'", " as y_dot turns round")
        call has_not("Q_z = 'x'", "dQ_x/dz - dQ_z/dx = -1.0, not 0")
    contains
        subroutine has_not(forces, expected)
            character(*), intent(in) :: forces, expected
            character(:), allocatable :: remark
            logical :: yes

            call try(forces, yes, remark)
            call assertFalse(yes, forces)
            call assertTrue(index(remark, expected) > 0, forces//": "//remark)
        end subroutine has_not
    end subroutine forces_without

    subroutine nothing_to_say()
        !! Without forces beside L.
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        type(word_t) :: none(0)

        call parse_scene("&scene system = 'oscillator', dt = 0.1, duration = 1.0, q = 1.0 /", &
                         "scene", none, scene, system, error)
        call assertFalse(allocated(error), "no error")
        if (allocated(error)) return
        call assertEqual("", potential_text(system))
    end subroutine nothing_to_say
end module test_helmholtz
