module test_consequences
    !! Which wrong lines of a sheet another one follows from, and what is said of statements that
    !! something does not change: in whole sheets, each remark as it is printed.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse
    use lagrangia_consequences, only: consequences_t
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: operator(-), symbol, whole
    use lagrangia_grading, only: grade, grade_t
    use lagrangia_homework, only: homework_t, parse_homework
    use lagrangia_sample_names, only: samples_t
    use lagrangia_scene_reader, only: read_named_system
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: consequences_suite

    character(*), parameter :: nl = new_line("a")

contains

    function consequences_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("consequences")
        call suite%addTest(TestMethod("one_line_or_two", one_line_or_two))
        call suite%addTest(TestMethod("energies_that_are_wrong", energies_that_are_wrong))
        call suite%addTest(TestMethod("letters_alone", letters_alone))
        call suite%addTest(TestMethod("what_changes_and_why", what_changes_and_why))
        call suite%addTest(TestMethod("sums_that_end_in_a_constant", sums_that_end_in_a_constant))
        call suite%addTest(TestMethod("no_more_mistakes_than_there_is_room_for", &
                                      no_more_mistakes_than_there_is_room_for))
    end function consequences_suite

    subroutine one_line_or_two()
        !! The fewest, and of these the nearest; what is wrong beside what is wrong has two.
        call sheet("pendulum", [character(50) :: "p_theta = 2 m l^2 theta_dot", &
                                "theta_ddot = -2 g/l sin(theta)", &
                                "p_theta_dot = -2 m g l sin(theta)", &
                                "p_theta_dot = -4 m g l sin(theta)"], &
                   [character(90) :: "'2 m l^2 theta_dot' must be counted 1/2 times", &
                    "'2 g/l sin(theta)' must be counted 1/2 times", &
                    "from line 3, which is wrong", &
                    "from lines 2 and 3, which are wrong"])
        call sheet("pendulum", [character(50) :: "omega = 2 sqrt(g/l)", "omega^2 = 4 g/l", &
                                "omega^2 = 2 g/l"], &
                   [character(90) :: "'2 sqrt(g/l)' must be counted 1/2 times", &
                    "from line 2, which is wrong", "'2 g/l' must be counted 1/2 times"])
    end subroutine one_line_or_two

    subroutine energies_that_are_wrong()
        !! L, T and V: what follows from the L that they make.
        call sheet("pendulum", [character(50) :: "L = m l^2 theta_dot^2/2 + 2 m g l cos(theta)", &
                                "p_theta = 2 m l^2 theta_dot", &
                                "E = m l^2 theta_dot^2/2 - 2 m g l cos(theta)", &
                                "p_theta_dot = -2 m g l sin(theta)", &
                                "theta_ddot = -2 g/l sin(theta)", &
                                "theta_ddot = -g/l sin(theta)"], &
                   [character(90) :: "'2 m g l cos(theta)' must be counted 1/2 times", &
                    "'2 m l^2 theta_dot' must be counted 1/2 times", &
                    "from line 2, which is wrong", "from line 2, which is wrong", &
                    "from line 2, which is wrong", ""])
        call sheet("pendulum", [character(50) :: "T = m l^2 theta_dot^2", &
                                "V = -3 m g l cos(theta)", &
                                "L = m l^2 theta_dot^2 + m g l cos(theta)", &
                                "L = m l^2 theta_dot^2 + 3 m g l cos(theta)", &
                                "2 m l^2 theta_ddot = -m g l sin(theta)", &
                                "2 m l^2 theta_ddot = -3 m g l sin(theta)", &
                                "p_theta = 2 m l^2 theta_dot"], &
                   [character(90) :: "'m l^2 theta_dot^2' must be counted 1/2 times", &
                    "'3 m g l cos(theta)' must be counted 1/3 times", &
                    "from line 2, which is wrong", "from lines 2 and 3, which are wrong", &
                    "from line 2, which is wrong", "from lines 2 and 3, which are wrong", &
                    "from line 2, which is wrong"])
    end subroutine energies_that_are_wrong

    subroutine letters_alone()
        !! No motion is another one then: the same but for a factor, of either sign, follows.
        call sheet("oscillator", [character(50) :: "omega = k/m", "k/m = omega", &
                                  "2 omega = 2 k/m", "m = k"], &
                   [character(90) :: "'omega' must have the exponent 2", &
                    "from line 2, which is wrong", &
                    "from line 2, which is wrong", "a condition between parameters, for "// &
                    "the lines behind it"])
    end subroutine letters_alone

    subroutine what_changes_and_why()
        !! A force beside L, the time in L, both, or a coordinate that is not cyclic.
        call sheet("damped_driven_pendulum", [character(50) :: "E = const"], &
                   [character(90) :: "it changes: Q_theta does work, and L contains t"])
        call sheet("driven_pendulum", [character(50) :: "E = const"], &
                   [character(90) :: "it changes: L contains t"])
        call sheet("oscillator", [character(50) :: "set: b = 0.5", "E = const", "p_x = C_1", &
                                  "E_dot = 0"], &
                   [character(90) :: &
                    "its rate is -1/2 x_dot^2: the force beside L, Q_x, does work", &
                    "its rate is m x_ddot: dL/dx is not 0", "from line 3, which is wrong"])
        call sheet("cart_pendulum", [character(50) :: "p_x = const", "p_theta = const", &
                                     "x_dot = konst.", "L = const"], &
                   [character(90) :: "", "it changes: dL/dtheta is not 0", "it changes", &
                    "it changes"])
    end subroutine what_changes_and_why

    subroutine sums_that_end_in_a_constant()
        !! Whatever is before it; a letter that is defined is none.
        call sheet("cart_pendulum", [character(50) :: "p_x^2 = const", "E = p_x + C", &
                                     "E = p_x - C", "p_x + t = const", "C = 2", "p_x = C"], &
                   [character(90) :: "", "", "", "the left side is 1.0", "", "*"])
        ! its name is shown as it was typed
        call sheet("atwood", [character(50) :: "constant: l", "y = l - pi R - x", &
                              "V = m1 g x - m2 g y"], &
                   [character(110) :: "", &
                    "two changes: 'V' lacks the factor '(-1) m1/(m1 - m2)'; "// &
                    "'m2 g (l - pi R - x)' does not belong there"])
    end subroutine sums_that_end_in_a_constant

    subroutine no_more_mistakes_than_there_is_room_for()
        !! The 201st is not remembered.
        type(consequences_t) :: consequences
        type(samples_t) :: truth  ! without a mass matrix: no other world is tried
        integer :: i

        truth%ndof = 0
        truth%frequency = 5
        truth%symbols%names = ["a", "b"]
        do i = 1, 201
            call consequences%add_mistake(i, symbol(2) - whole(i), truth)
        end do
        call assertEqual(200, consequences%mistakes)
        call assertEqual(0, consequences%count)
    end subroutine no_more_mistakes_than_there_is_room_for

    subroutine sheet(name, lines, remarks)
        !! These lines about a system, and the first line of the remark on each statement; `*`: any.
        character(*), intent(in) :: name, lines(:), remarks(:)
        class(system_t), allocatable :: system
        type(homework_t) :: homework
        type(grade_t) :: result
        type(error_t), allocatable :: error
        type(word_t), allocatable :: settings(:)
        character(:), allocatable :: text
        integer :: i

        text = "system: "//name
        do i = 1, size(lines)
            text = text//nl//trim(lines(i))
        end do
        call parse_homework(text, "sheet", homework, error)
        call assertFalse(allocated(error), text)
        if (allocated(error)) return
        allocate (settings(size(homework%settings)))
        do i = 1, size(settings)
            settings(i)%text = name//"%"//homework%settings(i)%text
        end do
        call read_named_system(name, settings, system, error)
        if (.not. allocated(error)) call grade(homework, system, result, error)
        call assertFalse(allocated(error), text)
        if (allocated(error)) return
        call assertEqual(size(remarks), size(result%of), "statements of "//text)
        do i = 1, min(size(remarks), size(result%of))
            if (remarks(i) == "*") cycle
            call assertEqual(trim(remarks(i)), result%of(i)%remark, &
                             name//": "//homework%statements(i)%text)
        end do
    end subroutine sheet
end module test_consequences
