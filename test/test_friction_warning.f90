module test_friction_warning
    !! Dry friction is known before a run, wherever its formula stands.
    use funit, only: TestMethod, TestSuite, assertEqual
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_friction_warning, only: friction_warning
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: friction_warning_suite

contains

    function friction_warning_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("friction_warning")
        call suite%addTest(TestMethod("jumps_are_found", jumps_are_found))
        call suite%addTest(TestMethod("other_forces_are_not", other_forces_are_not))
    end function friction_warning_suite

    subroutine jumps_are_found()
        !! In the force itself, in a definition, in a definition of a definition, where the velocity
        !! is one, and in a force that is too long for a description.
        call check("", "-F sgn(x_dot)", "sgn(x_dot)")
        call check("", "-F sgn(x) - F sgn(x_dot - 1)", "sgn(x_dot - 1)")
        call check("definitions = 'R = F sgn(x_dot)'", "-R", "sgn(x_dot)")
        call check("definitions = 'R = F sgn(x_dot)', 'S = 2 R + x'", "-S", "sgn(x_dot)")
        call check("definitions = 'w = x_dot - 1'", "-F sgn(w)", "sgn(x_dot - 1)")
        call check("definitions = 'w = x_dot - 1', 'u = 2 w', 'R = F sgn(u)'", "-R", &
                   "sgn(2 (x_dot - 1))")
        call check("", repeat("F exp(-x^2) sin(x) + ", 5)//repeat("F x^2 cos(x) tanh(x) + ", 5)// &
                   repeat("sqrt(1 + x^2 + x^4) exp(-x^2) log(1 + x^2) + ", 1)// &
                   "sin(1 + cos(2 + sin(3 + cos(4 + sin(5 + cos(6 + sin(7 + cos(8 + sin(9 + "// &
                   "cos(10 + sin(11 + cos(12 + sin(13 + x))))))))))))) "// &
                   "- F sgn(x_dot) exp(-x^2) sin(x)/(1 + x^2 + x^4)", "sgn(x_dot)")
    end subroutine jumps_are_found

    subroutine other_forces_are_not()
        !! A definition that no force uses, one whose name is a part of another's, and a jump at a
        !! place.
        call check("", "-F x_dot", "")
        call check("", "-F sgn(x) x_dot", "")
        call check("definitions = 'R = F sgn(x_dot)'", "-F x_dot", "")
        call check("definitions = 'R = F sgn(x_dot)', 'R2 = F x'", "-R2", "")
        call check("definitions = 'w = x - 1'", "-F sgn(w)", "")
    end subroutine other_forces_are_not

    subroutine check(definitions, force, jump)
        !! The line quotes `jump`, or there is none.
        character(*), intent(in) :: definitions, force, jump
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(scene_t) :: scene
        character(:), allocatable :: text
        integer :: last

        call parse_scene("&scene system = 'own' dt = 0.1 duration = 1 q = 1 / &lagrangian "// &
                         "coordinates = 'x' parameters = 'F' "//definitions//" T = 'x_dot^2/2' "// &
                         "V = 'x^2/2' Q_x = '"//force//"' / &own F = 1 /", "own.nml", [word_t ::], &
                         scene, system, error)
        if (allocated(error)) then
            call assertEqual("", error%message, definitions//" "//force)
            return
        end if
        text = friction_warning(system)
        last = index(text, "' jumps where the motion turns")
        call assertEqual(jump, text(2:last - 1), definitions//" "//force)
    end subroutine check
end module test_friction_warning
