module test_ends_of_constraints
    !! Places where the derivatives of the constraints vanish: a run ends there.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_description, only: line_length
    use lagrangia_errors, only: error_t, status_numbers
    use lagrangia_kinds, only: dp
    use lagrangia_observer, only: observer_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_run_plan, only: parse_run_plan, run_plan_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_scene_run, only: run_scene
    use lagrangia_step_ends, only: end_step, is_turned
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: ends_of_constraints_suite

    character(*), parameter :: curve = new_line("a")//"&lagrangian coordinates = 'x', 'y', "// &
        "parameters = 'm', T = 'm/2 (x_dot^2 + y_dot^2)', constraint = '", &
        mass = "' /"//new_line("a")//"&curve m = 1.0 /"//new_line("a")
    character(*), parameter :: cusp = "q = 1.0, 1.0, v = -1.0", &
        cusp_group = curve//"y^2 = x^3"//mass
    character(*), parameter :: crossing = "q = 1.0, 0.0, v = 0.0, 1.0", &
        crossing_group = curve//"(x^2 + y^2)^2 = x^2 - y^2"//mass
    character(60), parameter :: methods(8) = [character(60) :: "method = 'rk4', dt = 1e-3", &
        "method = 'rk4', dt = 7e-3", "method = 'rk4', dt = 0.05", "method = 'gauss16', dt = 0.01", &
        "method = 'gauss16', tolerance = 1e-4, samples = 20", &
        "method = 'gauss16', tolerance = 1e-11, samples = 20", &
        "method = 'dop853', tolerance = 1e-4, samples = 20", &
        "method = 'dop853', tolerance = 1e-11, samples = 20"]

contains

    function ends_of_constraints_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("ends_of_constraints")
        call suite%addTest(TestMethod("a_cusp_and_a_crossing", a_cusp_and_a_crossing))
        call suite%addTest(TestMethod("before_them_and_on_circles_runs_go_on", &
                                      before_them_and_on_circles_runs_go_on))
        call suite%addTest(TestMethod("turns_of_several_constraints", &
                                      turns_of_several_constraints))
        call suite%addTest(TestMethod("turns_need_an_exchange_of_rows", &
                                      turns_need_an_exchange_of_rows))
        call suite%addTest(TestMethod("steps_backwards_end_on_the_circle", &
                                      steps_backwards_end_on_the_circle))
    end function ends_of_constraints_suite

    subroutine run(keys, group, status, message, t)
        !! A run of a scene: its status and what it says, and the time where it ended.
        character(*), intent(in) :: keys, group
        integer, intent(out) :: status
        character(:), allocatable, intent(out) :: message
        real(dp), intent(out) :: t
        type(run_plan_t), allocatable :: plan
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        class(observer_t), pointer :: nobody
        type(word_t) :: none(0)

        nobody => null()
        status = 0
        message = ""
        allocate (plan)
        call parse_run_plan(plan, "&scene system = 'curve', "//keys//" /"//group, "scene", none, &
                            error)
        call assertFalse(allocated(error), "read: "//keys)
        if (.not. allocated(error)) call run_scene(plan, "", "text", nobody, outcome, error)
        t = outcome%t
        if (.not. allocated(error)) return
        status = error%status
        message = error%message
    end subroutine run

    subroutine a_cusp_and_a_crossing()
        !! By every method status 3, with a time and the reason.
        character(:), allocatable :: message
        real(dp) :: t
        integer :: i, status

        do i = 1, size(methods)
            call run(cusp//", duration = 2.0, "//methods(i), cusp_group, status, message, t)
            call assertEqual(status_numbers, status, "cusp: "//trim(methods(i)))
            call assertTrue(index(message, "at t = ") + index(message, "from t = ") > 0, message)
            call run(crossing//", duration = 5.0, "//methods(i), crossing_group, status, message, t)
            call assertEqual(status_numbers, status, "crossing: "//trim(methods(i)))
            call assertTrue(index(message, "the constraints' derivatives vanish") > 0, message)
        end do
    end subroutine a_cusp_and_a_crossing

    subroutine before_them_and_on_circles_runs_go_on()
        !! Also in steps that are long: a circle with three steps a turn.
        character(*), parameter :: circle = curve//"x^2 + y^2 = 4"//mass
        character(:), allocatable :: message
        real(dp) :: t
        integer :: i, status

        do i = 1, size(methods)
            call run(cusp//", duration = 0.75, "//methods(i), cusp_group, status, message, t)
            call assertEqual(0, status, "cusp: "//trim(methods(i))//message)
            call run(crossing//", duration = 1.25, "//methods(i), crossing_group, status, &
                     message, t)
            call assertEqual(0, status, "crossing: "//trim(methods(i))//message)
            call run("q = 2.0, 0.0, v = 0.0, 3.0, duration = 20.0, "//methods(i), circle, status, &
                     message, t)
            call assertEqual(0, status, "circle: "//trim(methods(i))//message)
        end do
        call run("q = 2.0, 0.0, v = 0.0, 3.0, duration = 28.0, method = 'gauss16', dt = 1.4", &
                 circle, status, message, t)
        call assertEqual(0, status, "three steps a turn: "//message)
    end subroutine before_them_and_on_circles_runs_go_on

    subroutine turns_of_several_constraints()
        !! By the sign of a determinant, in any order of the rows.
        real(dp), parameter :: a(2, 3) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 2.0_dp, 0.1_dp, 0.0_dp], &
                                                 [2, 3]), weights(3) = [1.0_dp, 2.0_dp, 3.0_dp]
        real(dp) :: b(2, 3)

        call assertFalse(is_turned(a, a, weights), "no turn")
        b = a([2, 1], :)
        call assertFalse(is_turned(b, b, weights), "no turn, exchanged")
        b = a
        b(1, :) = -b(1, :)
        call assertTrue(is_turned(a, b, weights), "one")
        b = -a
        call assertTrue(is_turned(a, b, weights), "both")
        b = a
        b(2, :) = 0.0_dp
        call assertTrue(is_turned(a, b, weights), "one that ends")
    end subroutine turns_of_several_constraints

    subroutine turns_need_an_exchange_of_rows()
        !! Matrices C of three constraints, with b = 1: after the first elimination the pivot is 0,
        !! and what takes its place is negative; their determinants are 1 and 0.
        real(dp), parameter :: ones(3) = 1.0_dp
        real(dp) :: c(3, 3), unit(3, 3)
        integer :: i

        unit = 0.0_dp
        do i = 1, 3
            unit(i, i) = 1.0_dp
        end do
        c(1, :) = [1.0_dp, 1.0_dp, 0.0_dp]
        c(2, :) = [1.0_dp, 1.0_dp, 1.0_dp]
        c(3, :) = [0.0_dp, -1.0_dp, 1.0_dp]
        call assertFalse(is_turned(c, unit, ones), "its determinant is 1")
        c(2, :) = [1.0_dp, 1.0_dp, 0.0_dp]
        c(3, :) = [0.0_dp, 0.0_dp, 1.0_dp]
        call assertTrue(is_turned(c, unit, ones), "its determinant is 0")
    end subroutine turns_need_an_exchange_of_rows

    subroutine steps_backwards_end_on_the_circle()
        !! A step of -0.1 s: its end is led back to the circle, its velocity along it; one that is
        !! far from it is none.
        class(system_t), allocatable :: circle
        type(error_t), allocatable :: error
        type(scene_t) :: scene
        type(word_t) :: none(0)
        character(line_length) :: reason
        real(dp), parameter :: q_old(2) = [0.6_dp, -0.8_dp], v_old(2) = [0.8_dp, 0.6_dp]
        real(dp) :: q(2), v(2)

        call parse_scene("&scene system = 'o', dt = 1, duration = 1, q = 0.6, -0.8 /"//curve// &
                         "x^2 + y^2 = 1' / &o m = 1 /", "text", none, scene, circle, error)
        call assertFalse(allocated(error), "a circle")
        if (allocated(error)) return
        reason = ""
        q = q_old - 0.1_dp*v_old
        v = v_old
        call end_step(circle, 0.0_dp, q_old, v_old, -0.1_dp, q, v, reason)
        call assertEqual("", trim(reason), "beside the circle")
        call assertEqual(1.0_dp, norm2(q), tolerance=1e-14_dp, message="on the circle")
        call assertEqual(0.0_dp, dot_product(q, v), tolerance=1e-14_dp, message="along the circle")
        q = q_old
        v = [1.6_dp, 0.8_dp]
        call end_step(circle, 0.0_dp, q_old, v_old, -0.1_dp, q, v, reason)
        call assertEqual("", trim(reason), "a velocity across the circle")
        call assertEqual([1.408_dp, 1.056_dp], v, tolerance=1e-14_dp, message="what is left of it")
        q = q_old - 0.1_dp*v_old
        v = [10.0_dp, -10.0_dp]
        call end_step(circle, 0.0_dp, q_old, v_old, -0.1_dp, q, v, reason)
        call assertEqual("its end is far from the constraints: the step is too long, or they "// &
                         "end there", trim(reason))
        call assertTrue(all(ieee_is_nan(q)), "no place")
    end subroutine steps_backwards_end_on_the_circle
end module test_ends_of_constraints
