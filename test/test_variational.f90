module test_variational
    !! The linear equations of a displacement are the derivatives of the equations of motion.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: new_system, nth_system
    use lagrangia_command_line, only: word_t
    use lagrangia_description, only: description_t
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t
    use lagrangia_kinds, only: dp, lanes
    use lagrangia_lyapunov, only: lyapunov_exponent
    use lagrangia_methods, only: new_adaptive
    use lagrangia_richardson, only: extrapolated
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_system, only: system_t
    use lagrangia_variational, only: new_variational, variational_t
    use random_states, only: draw_parameters, draw_state, restart_random
    implicit none (type, external)
    private
    public :: variational_suite

    type, extends(double_pendulum_t) :: unwritten_t
        !! A double pendulum whose description has no formula of L.
    contains
        procedure :: describe => describe_without_formula
    end type unwritten_t

contains

    function variational_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("variational")
        call suite%addTest(TestMethod("lecture_systems_are_differentiated", &
                                      lecture_systems_are_differentiated))
        call suite%addTest(TestMethod("a_pendulum_is_exact", a_pendulum_is_exact))
        call suite%addTest(TestMethod("typed_systems_are_differentiated", &
                                      typed_systems_are_differentiated))
        call suite%addTest(TestMethod("another_motion_does_not_fit", another_motion_does_not_fit))
        call suite%addTest(TestMethod("differences_where_no_formula_is_known", &
                                      differences_where_no_formula_is_known))
        call suite%addTest(TestMethod("states_of_another_size_are_refused", &
                                      states_of_another_size_are_refused))
    end function variational_suite

    subroutine lecture_systems_are_differentiated()
        !! All but those with constraints or contacts, against central differences of the code's
        !! accelerations at five steps from 1/16 down, extrapolated: each is right to epsilon/h of
        !! the accelerations, 1e-13, which the extrapolation makes no more than tenfold, and what
        !! is left of the series is of order \(h^{10}\), product of all steps squared, 1e-18.
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(variational_t) :: variational
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t
        integer :: i, known, trial

        i = 0
        known = 0
        do
            i = i + 1
            call nth_system(i, system)
            if (.not. allocated(system)) exit
            call system%describe(d)
            call restart_random()
            do trial = 1, 5
                call draw_parameters(system, edges=.false.)
                call new_variational(variational, system)
                call assertTrue(variational%known .eqv. &
                                (system%constraints + system%contacts == 0), &
                                trim(d%name)//": is it known?")
                if (.not. variational%known .or. anyExceptions()) exit
                if (trial == 1) known = known + 1
                call draw_state(system, t, q, v)
                call compare(system, variational, trim(d%name), t, q, v)
                deallocate (q, v)
                if (anyExceptions()) return
            end do
        end do
        call assertEqual(11, known, "systems")
    end subroutine lecture_systems_are_differentiated

    subroutine compare(system, variational, name, t, q, v)
        !! With differences, and in lanes.
        class(system_t), intent(in) :: system
        type(variational_t), intent(in) :: variational
        character(*), intent(in) :: name
        real(dp), intent(in) :: t, q(:), v(:)
        integer, parameter :: steps = 5
        real(dp), dimension(size(q)) :: a, b, da, dq, dv
        real(dp), dimension(lanes, size(q)) :: da_lanes, dq_lanes, dv_lanes, q_lanes, v_lanes
        real(dp) :: differences(steps, size(q)), h, largest
        integer :: i, k

        dq = [(0.5_dp*cos(2.0_dp*i), i=1, size(q))]
        dv = [(0.5_dp*sin(3.0_dp*i), i=1, size(q))]
        largest = 1.0_dp
        do k = 1, steps
            h = 2.0_dp**(-3 - k)
            call system%accelerations(t, q + h*dq, v + h*dv, a)
            call system%accelerations(t, q - h*dq, v - h*dv, b)
            differences(k, :) = (a - b)/(2.0_dp*h)
            largest = max(largest, maxval(abs(a)))
        end do
        call variational%change(t, q, v, dq, dv, da)
        do i = 1, size(q)
            call assertEqual(extrapolated(differences(:, i)), da(i), 1e-9_dp*largest, name)
        end do
        do i = 1, lanes
            q_lanes(i, :) = q
            v_lanes(i, :) = v
            dq_lanes(i, :) = i*dq
            dv_lanes(i, :) = i*dv
        end do
        call variational%change_lanes(spread(t, 1, lanes), q_lanes, v_lanes, dq_lanes, dv_lanes, &
                                      da_lanes)
        do i = 1, lanes
            call assertEqual(i*da, da_lanes(i, :), 1000*epsilon(t)*i*largest, name//" in lanes")
        end do
    end subroutine compare

    subroutine a_pendulum_is_exact()
        !! \(\delta\ddot\theta = -(g/l)\cos\theta\,\delta\theta - (b/m l^2)\,
        !! \delta\dot\theta\), to a few last digits, however short the displacement is.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(variational_t) :: variational
        real(dp) :: da(1), length, theta, wanted
        integer :: i

        call new_system("pendulum", system, error)
        call system%configure([2.0_dp, 0.5_dp, 9.81_dp, 0.3_dp], error)
        call assertFalse(allocated(error), "a damped pendulum")
        call new_variational(variational, system)
        call assertTrue(variational%known, "its equations are known")
        if (anyExceptions()) return
        do i = 1, 20
            theta = 0.31_dp*i
            length = 10.0_dp**(-15*i)
            wanted = -(9.81_dp/0.5_dp)*cos(theta)*length + 0.3_dp/(2.0_dp*0.25_dp)*length
            call variational%change(0.0_dp, [theta], [1.0_dp], [length], [-length], da)
            call assertEqual(wanted, da(1), 8*epsilon(theta)*20*length, "a displacement")
        end do
    end subroutine a_pendulum_is_exact

    subroutine typed_systems_are_differentiated()
        !! Two coordinates that are coupled by their velocities, a drive, friction; and the same
        !! program with other parameters.
        character(*), parameter :: text = "&scene system = 'pair', dt = 1, duration = 1, "// &
            "q = 0.1, 0.2 / &lagrangian coordinates = 'x', 'y', parameters = 'c', 'k', "// &
            "L = '(1 + c cos(y)^2) x_dot^2/2 + y_dot^2/2 + c x_dot y_dot sin(x)/3 - k x^4/4 "// &
            "- y^2 x^2 + x cos(3 t)', Q_y = '-k y_dot |y_dot|' / &pair c = "
        class(system_t), allocatable :: first, other
        type(error_t), allocatable :: error
        type(scene_t) :: scene
        type(variational_t) :: variational
        type(word_t) :: none(0)
        logical :: yes

        call parse_scene(text//"0.5, k = 2 /", "text", none, scene, first, error)
        call assertFalse(allocated(error), "one system")
        call parse_scene(text//"0.7, k = 1 /", "text", none, scene, other, error)
        call assertFalse(allocated(error), "another")
        if (anyExceptions()) return
        call new_variational(variational, first)
        call assertTrue(variational%known, "known")
        call compare(first, variational, "the first", 0.3_dp, [0.4_dp, 0.9_dp], [1.1_dp, 0.7_dp])
        call variational%fits(other, yes)
        call assertTrue(yes, "the same formulas")
        call compare(other, variational, "the other", 0.3_dp, [0.4_dp, 0.9_dp], [1.1_dp, 0.7_dp])
    end subroutine typed_systems_are_differentiated

    subroutine another_motion_does_not_fit()
        !! A pendulum's equations for an oscillator, which has as many coordinates.
        class(system_t), allocatable :: oscillator, pendulum
        type(error_t), allocatable :: error
        type(variational_t) :: variational
        logical :: yes

        call new_system("pendulum", pendulum, error)
        call new_system("oscillator", oscillator, error)
        call new_variational(variational, pendulum)
        call variational%fits(pendulum, yes)
        call assertTrue(yes, "its own")
        call variational%fits(oscillator, yes)
        call assertFalse(yes, "an oscillator")
    end subroutine another_motion_does_not_fit

    pure subroutine describe_without_formula(self, d)
        !! See `system_t`.
        class(unwritten_t), intent(in) :: self
        type(description_t), intent(out) :: d

        call self%double_pendulum_t%describe(d)
        deallocate (d%lagrangian)
    end subroutine describe_without_formula

    subroutine differences_where_no_formula_is_known()
        !! The exponents of a regular motion over 20 s, by both: those of the differences are right
        !! to 4e-11 of the derivative, which 20 s at rates of 10 /s make no more than 1e-7.
        character(*), parameter :: methods(2) = [character(7) :: "dop853", "gauss16"]
        real(dp), parameter :: q(2) = [0.9_dp, -0.4_dp], v(2) = [0.0_dp, 1.5_dp]
        class(dense_integrator_t), allocatable :: method
        type(double_pendulum_t) :: written
        type(unwritten_t) :: unwritten
        type(variational_t) :: variational
        type(error_t), allocatable :: error
        real(dp) :: exponents(2), errors(2)
        integer :: i

        call written%configure([1.0_dp, 0.7_dp, 0.8_dp, 1.2_dp, 9.81_dp], error)
        call unwritten%configure([1.0_dp, 0.7_dp, 0.8_dp, 1.2_dp, 9.81_dp], error)
        call new_variational(variational, unwritten)
        call assertFalse(variational%known, "there is no formula")
        do i = 1, size(methods)
            call new_adaptive(methods(i), method)
            method%tolerance = 1e-11_dp
            call lyapunov_exponent(written, method, 0.0_dp, 1.0_dp, 20.0_dp, q, v, exponents(1), &
                                   errors(1), error)
            call assertFalse(allocated(error), methods(i)//" by the formula")
            call lyapunov_exponent(unwritten, method, 0.0_dp, 1.0_dp, 20.0_dp, q, v, &
                                   exponents(2), errors(2), error)
            call assertFalse(allocated(error), methods(i)//" by differences")
            call assertTrue(exponents(1) > 0.05_dp, methods(i)//": neighbours part for a while")
            call assertEqual(exponents(1), exponents(2), 1e-7_dp, methods(i))
            call assertEqual(errors(1), errors(2), 1e-7_dp, methods(i)//": the uncertainty")
        end do
    end subroutine differences_where_no_formula_is_known

    subroutine states_of_another_size_are_refused()
        class(dense_integrator_t), allocatable :: method
        type(double_pendulum_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: exponent, uncertainty

        call system%configure([1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp, 9.81_dp], error)
        call new_adaptive("dop853", method)
        call lyapunov_exponent(system, method, 0.0_dp, 1.0_dp, 2.0_dp, [1.0_dp], [1.0_dp], &
                               exponent, uncertainty, error)
        call assertTrue(allocated(error), "one coordinate of two")
        if (.not. allocated(error)) return
        call assertEqual("q has 1 value; the system has 2 coordinates", error%message)
    end subroutine states_of_another_size_are_refused
end module test_variational
