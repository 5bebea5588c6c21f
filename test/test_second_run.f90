module test_second_run
    !! The run at half the step, which estimates the error where no closed form is known, and what
    !! several runs leave open that end near a saddle.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertLessThan, assertTrue
    use lagrangia_accuracy, only: state_accuracy
    use lagrangia_cross_check, only: by_other_method
    use lagrangia_dop853, only: dop853_t, new_dop853
    use lagrangia_errors, only: error_t
    use lagrangia_events, only: event_box_t
    use lagrangia_final_state, only: final_state_t
    use lagrangia_final_values, only: final_value_t
    use lagrangia_gauss_adaptive, only: gauss_adaptive_t, new_gauss16_adaptive
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: new_integrator
    use lagrangia_observer, only: observer_t
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_random_draws, only: random_t
    use lagrangia_reference, only: reference_t
    use lagrangia_rolling_disk, only: rolling_disk_t
    use lagrangia_run_plan, only: parse_run_plan, run_plan_t
    use lagrangia_saddle, only: unresolved_growth
    use lagrangia_scene, only: scene_t
    use lagrangia_second_run, only: distance, second_run_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    use lagrangia_wedge, only: wedge_t
    use run_doubles, only: watcher_t
    use scene_runs, only: read_and_plan
    implicit none (type, external)
    private
    public :: second_run_suite

contains

    function second_run_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("second_run")
        call suite%addTest(TestMethod("distance_is_absolute_below_1_and_relative_above", &
                                      distance_is_absolute_below_1_and_relative_above))
        call suite%addTest(TestMethod("rk4_is_estimated_well", rk4_is_estimated_well))
        call suite%addTest(TestMethod("verlet_is_estimated_well", verlet_is_estimated_well))
        call suite%addTest(TestMethod("midpoint_is_estimated_well", midpoint_is_estimated_well))
        call suite%addTest(TestMethod("steps_that_no_tolerance_shortens_are_estimated", &
                                      steps_that_no_tolerance_shortens_are_estimated))
        call suite%addTest(TestMethod("rounding_that_both_runs_share_is_in_it", &
                                      rounding_that_both_runs_share_is_in_it))
        call suite%addTest(TestMethod("a_watcher_hears_all_its_runs", a_watcher_hears_all_its_runs))
        call suite%addTest(TestMethod("a_saddle_that_runs_do_not_resolve", &
                                      a_saddle_that_runs_do_not_resolve))
        call suite%addTest(TestMethod("what_has_grown_at_a_saddle", what_has_grown_at_a_saddle))
        call suite%addTest(TestMethod("an_end_that_is_elsewhere", an_end_that_is_elsewhere))
    end function second_run_suite

    subroutine distance_is_absolute_below_1_and_relative_above()
        !! The worst of the coordinates; by the size of the truth.
        call assertEqual(0.25_dp, distance([0.5_dp], [0.25_dp]))
        call assertEqual(0.25_dp, distance([5.0_dp], [4.0_dp]))
        call assertEqual(0.5_dp, distance([-6.0_dp, 0.25_dp], [-4.0_dp, 0.0_dp]))
        call assertEqual(0.25_dp, distance([-5.0_dp, 0.25_dp], [-4.0_dp, 0.125_dp]))
        call assertEqual(3.0_dp, distance([4.0_dp], [1.0_dp]))
    end subroutine distance_is_absolute_below_1_and_relative_above

    subroutine rk4_is_estimated_well()
        !! Half the step has a sixteenth of the error: 16/15 of the distance.
        call check_estimate("rk4", 0.02_dp)
    end subroutine rk4_is_estimated_well

    subroutine verlet_is_estimated_well()
        !! Half the step has a quarter of the error: 4/3 of the distance.
        call check_estimate("verlet", 0.005_dp)
    end subroutine verlet_is_estimated_well

    subroutine midpoint_is_estimated_well()
        !! A method with state of its own between the steps.
        call check_estimate("midpoint", 0.01_dp)
    end subroutine midpoint_is_estimated_well

    subroutine check_estimate(name, dt)
        !! Beside the true error of a pendulum's run, at samples 7 steps apart and at an end that
        !! is reached by a shortened step; within a tenth. Where the error itself passes through
        !! zero the next order shows: those samples do not count, but they are few.
        character(*), intent(in) :: name
        real(dp), intent(in) :: dt
        integer, parameter :: samples = 60, stride = 7
        type(pendulum_t) :: system
        class(integrator_t), allocatable :: method
        class(reference_t), allocatable :: reference
        type(second_run_t) :: second
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), truth(1), ignored(1), estimate, actual, t, largest
        integer :: k, counted

        call system%configure([0.7_dp, 1.3_dp, 9.81_dp], error)
        q = 0.9_dp
        v = 0.5_dp
        call system%closed_form(0.3_dp, q, v, reference)
        call new_integrator(name, method, error)
        call second%start(method, system, 0.3_dp, dt, q, v, error)
        call method%prepare(system, error)
        call method%start(system, 0.3_dp, q, v)
        call second%estimate(system, 0.3_dp, q, estimate, error)
        call assertEqual(0.0_dp, estimate, message="no error at the start")
        largest = 0.0_dp
        counted = 0
        do k = 1, samples
            call method%advance(system, 0.3_dp, dt, int((k - 1)*stride, i8), int(stride, i8), q, v)
            t = 0.3_dp + k*stride*dt
            call second%estimate(system, t, q, estimate, error)
            call reference%state_at(t, truth, ignored)
            actual = distance(q, truth)
            largest = max(largest, actual)
            if (actual < 0.3_dp*largest) cycle
            counted = counted + 1
            call assertEqual(1.0_dp, estimate/actual, 0.1_dp, name//": estimate over error")
        end do
        call assertGreaterThan(counted, samples/3, message="samples that count")
        call assertLessThan(largest, 1e-2_dp, message="small errors")
        call method%advance(system, t, 0.4_dp*dt, 0_i8, 1_i8, q, v)
        t = t + 0.4_dp*dt
        call second%estimate(system, t, q, estimate, error)
        call reference%state_at(t, truth, ignored)
        actual = distance(q, truth)
        call assertEqual(1.0_dp, estimate/actual, 0.1_dp, name//": after a shortened step")
    end subroutine check_estimate

    subroutine steps_that_no_tolerance_shortens_are_estimated()
        !! Short motions of a rolling disk: of the steps that gauss16 takes some are as long by a
        !! hundredth of the tolerance, and their error is not that of the tolerance.
        type(rolling_disk_t) :: system
        type(gauss_adaptive_t) :: method
        class(reference_t), allocatable :: reference
        type(random_t) :: random
        type(second_run_t), allocatable :: second
        type(error_t), allocatable :: error
        real(dp), allocatable :: parameters(:), q(:), v(:)
        real(dp) :: truth(4), ignored(4), t, duration, estimate, actual
        integer :: k

        call new_gauss16_adaptive(method)
        do k = 1, 60
            call random%parameters(system, .false., parameters, error)
            call random%state(system, t, q, v, error)
            call random%uniform(0.5_dp, 4.0_dp, duration)
            call random%uniform(-10.0_dp, -3.0_dp, method%tolerance)
            method%tolerance = 10.0_dp**method%tolerance
            call system%closed_form(t, q, v, reference)
            if (allocated(second)) deallocate (second)
            allocate (second)
            call second%start_adaptive(method, system, t, t + duration, q, v, error)
            call method%prepare(system, error)
            call method%start(system, t, q, v, t + duration)
            do while (method%t_new < t + duration)
                call method%step(system, error)
            end do
            call method%state_at(t + duration, q, v)
            call second%estimate(system, t + duration, q, estimate, error)
            call reference%state_at(t + duration, truth, ignored)
            actual = distance(q, truth)
            call assertGreaterThan(estimate, 0.5_dp*actual - 1e-12_dp, message="estimate")
        end do
    end subroutine steps_that_no_tolerance_shortens_are_estimated

    subroutine a_watcher_hears_all_its_runs()
        !! The steps that are only counted, before anything else, the finer ones and the other
        !! method's, to the time that is asked for; what would not end is refused.
        type(oscillator_t) :: system
        type(dop853_t) :: method
        type(second_run_t), allocatable :: second
        type(watcher_t), target :: watcher
        type(error_t), allocatable :: error
        integer(i8), parameter :: all = 10_i8**15
        real(dp), parameter :: times(3) = [0.0_dp, 3.0_dp, 10.0_dp]
        real(dp) :: estimate
        integer :: i, k

        call new_dop853(method)
        do k = 1, 2
            call system%configure([1.0_dp, merge(1.0_dp, 1e36_dp, k == 1)], error)
            if (allocated(second)) deallocate (second)
            allocate (second)
            second%watcher => watcher
            call second%start_adaptive(method, system, 0.0_dp, 10.0_dp, [1.0_dp], [0.0_dp], error)
            call second%start_other(method, system, 0.0_dp, 10.0_dp, [1.0_dp], [0.0_dp])
            do i = 1, merge(3, 1, k == 1)
                watcher%done = -1
                call second%estimate(system, times(i), [cos(times(i))], estimate, error)
                if (k == 2) exit
                call assertTrue(.not. allocated(error), "no error")
                if (i == 1) call assertEqual(all, watcher%done, message="the steps are counted")
                if (i == 2) call assertGreaterThan(watcher%done, 3*all/10 - 1, message="to 3 s")
                if (i == 2) call assertLessThan(watcher%done, 9*all/10, message="not to the end")
                if (i == 3) call assertEqual(all, watcher%done, message="to the end")
                if (anyExceptions()) return
            end do
        end do
        call assertTrue(allocated(error), "endless")
        if (anyExceptions()) return
        call assertEqual(1, index(error%message, "the run that estimates the error: 10000 steps"), &
                         message=error%message)
    end subroutine a_watcher_hears_all_its_runs

    subroutine rounding_that_both_runs_share_is_in_it()
        !! Under constant forces no method errs but by rounding, and each step may round the same
        !! way, at half the step too. Another method, in few steps, does not; a last digit of the
        !! time and of the coordinates is its own, and the closed form's.
        type(wedge_t) :: system
        class(integrator_t), allocatable :: method
        type(dop853_t) :: other
        class(reference_t), allocatable :: reference
        type(random_t) :: random
        type(second_run_t), allocatable :: second
        type(error_t), allocatable :: error
        real(dp), allocatable :: parameters(:), q(:), v(:)
        real(dp) :: truth(2), ignored(2), t, dt, estimate, actual, worst, own
        integer, parameter :: steps = 2000
        integer :: k

        call new_dop853(other)
        other%tolerance = other%least_tolerance
        worst = 0.0_dp
        do k = 1, 100
            call random%parameters(system, .false., parameters, error)
            call random%state(system, t, q, v, error)
            call random%uniform(5e-4_dp, 1.5e-3_dp, dt)
            call system%closed_form(t, q, v, reference)
            call new_integrator("velocity_verlet", method, error)
            if (allocated(second)) deallocate (second)
            allocate (second)
            call second%start(method, system, t, dt, q, v, error)
            call second%start_other(other, system, t, t + steps*dt, q, v)
            call method%prepare(system, error)
            call method%start(system, t, q, v)
            call method%advance(system, t, dt, 0_i8, int(steps, i8), q, v)
            call second%estimate(system, t + steps*dt, q, estimate, error)
            call reference%state_at(t + steps*dt, truth, ignored)
            actual = distance(q, truth)
            own = 16.0_dp*epsilon(own)*(1.0_dp + maxval(abs(v)))
            worst = max(worst, actual/own)
            call assertGreaterThan(estimate, 0.5_dp*actual - own, message="estimate")
        end do
        call assertGreaterThan(worst, 8.0_dp, message="more than a few last digits")
    end subroutine rounding_that_both_runs_share_is_in_it

    subroutine a_saddle_that_runs_do_not_resolve()
        !! Of \(\ddot x = a^2x,\;\ddot y = \pm b^2y\) what leaves is \(ax + \dot x\), and \(by +
        !! \dot y\) on a hill: open where the ends differ by more than a tenth of it. The fastest of
        !! them counts, but a rate below a thousandth of the largest is none.
        real(dp), parameter :: zero(4) = 0.0_dp
        real(dp) :: sense
        integer :: i

        do i = 1, 2
            sense = merge(1.0_dp, -1.0_dp, i == 1)
            ! 2 x + x_dot = 1.25
            call grows("2", "-9", sense*[0.5_dp, 0.4_dp, 0.25_dp, 0.3_dp], &
                       [0.0624_dp, 9.0_dp, 0.0_dp, 9.0_dp], zero, 0.0_dp)
            call grows("2", "-9", sense*[0.5_dp, 0.4_dp, 0.25_dp, 0.3_dp], &
                       [0.0626_dp, 0.0_dp, 0.0_dp, 0.0_dp], zero, 2.0_dp)
            call grows("2", "-9", sense*[0.5_dp, 0.4_dp, 0.25_dp, 0.3_dp], &
                       zero, [0.0_dp, 0.0_dp, -0.1249_dp, 0.0_dp], 0.0_dp)
            call grows("2", "-9", sense*[0.5_dp, 0.4_dp, 0.25_dp, 0.3_dp], &
                       zero, [0.0_dp, 0.0_dp, -0.1251_dp, 0.0_dp], 2.0_dp)
            ! on a hill, x + x_dot = 1 and 3 y + y_dot = 2
            call grows("1", "9", sense*[0.5_dp, 0.5_dp, 0.5_dp, 0.5_dp], &
                       [0.11_dp, 0.06_dp, 0.0_dp, 0.0_dp], zero, 1.0_dp)
            call grows("1", "9", sense*[0.5_dp, 0.5_dp, 0.5_dp, 0.5_dp], &
                       [0.09_dp, 0.07_dp, 0.0_dp, 0.0_dp], zero, 3.0_dp)
            call grows("1", "9", sense*[0.5_dp, 0.5_dp, 0.5_dp, 0.5_dp], &
                       [0.11_dp, 0.0_dp, 0.0_dp, 0.0_dp], [0.0_dp, 0.0_dp, 0.0_dp, 0.21_dp], &
                       3.0_dp)
        end do
        ! with drag, 3 x + x_dot = 1.75
        call grows("sqrt(3)", "-9", [0.5_dp, 0.4_dp, 0.25_dp, 0.3_dp], &
                   [0.0582_dp, 0.0_dp, 0.0_dp, 0.0_dp], zero, 0.0_dp, "-2 x_dot")
        call grows("sqrt(3)", "-9", [0.5_dp, 0.4_dp, 0.25_dp, 0.3_dp], &
                   [0.0584_dp, 0.0_dp, 0.0_dp, 0.0_dp], zero, 1.0_dp, "-2 x_dot")
        call grows("sqrt(3)", "-9", [0.5_dp, 0.4_dp, 0.25_dp, 0.3_dp], &
                   [0.0_dp, 0.0_dp, 0.176_dp, 0.0_dp], zero, 1.0_dp, "-2 x_dot")
        ! a hill of a micrometre
        call grows("0", "-9", [1e-9_dp, 0.0_dp, 0.0_dp, 0.0_dp], &
                   [1e-9_dp, 0.0_dp, 0.0_dp, 0.0_dp], zero, sqrt(cos(1e-3_dp)), &
                   "1e-6 sin(1e6 x)")
        call grows("0.0031", "-9", zero, [1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], zero, 0.0031_dp)
        call grows("0.0029", "-9", zero, [1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], zero, 0.0_dp)
    contains
        subroutine grows(a, b2, y, second, third, expected, force)
            character(*), intent(in) :: a, b2            !! the latter with its sign
            real(dp), intent(in) :: y(4)                 !! the end of the first run
            real(dp), intent(in) :: second(4), third(4)  !! how far the others end from it
            real(dp), intent(in) :: expected
            character(*), intent(in), optional :: force  !! beside, on x
            character(:), allocatable :: beside
            type(scene_t) :: scene
            class(system_t), allocatable :: system
            type(error_t), allocatable :: error
            type(final_state_t) :: seen

            beside = ""
            if (present(force)) beside = ", Q_x = '"//force//"'"
            call read_and_plan("&scene system = 'hill', q = 0, 0, duration = 1.0, dt = 0.1 / "// &
                               "&lagrangian coordinates = 'x', 'y' L = 'x_dot^2/2 + y_dot^2/2 "// &
                               "+ ("//a//")^2/2 x^2 + ("//b2//")/2 y^2'"//beside//" / &hill /", &
                               "a.nml", [word_t ::], scene, system, error)
            call assertFalse(allocated(error), "a good scene")
            if (allocated(error)) return
            seen%q = y(:2)
            seen%v = y(3:)
            seen%q_most = abs(seen%q)
            seen%v_most = 4.0_dp*abs(seen%v)
            call assertEqual(expected, unresolved_growth(system, seen, reshape( &
                             [y, y + second, y + third], [4, 3])), 1e-8_dp, a//", "//b2)
        end subroutine grows
    end subroutine a_saddle_that_runs_do_not_resolve

    subroutine what_has_grown_at_a_saddle()
        !! From the top of \(-200\,x^2\), which an error leaves by \(e^{20t}\), with drag by
        !! \(e^{10t}\), in 1 s from 0.5 s on; beside it y goes from -3 m to -4 m with -1 m/s. Its
        !! error is that of the energy, at the time when x was first away; two last digits of the
        !! start until then; and two at least, from the start on where no energy tells.
        real(dp), parameter :: last = 2.0_dp*epsilon(last), slow(2) = [1.25_dp, 1.0_dp]
        real(dp), parameter :: terms = 1.5_dp  ! of the energy, v p - L: as much as both
        real(dp), parameter :: start = (3.0_dp + 1.0_dp/20.0_dp)/4.0_dp  ! beside the largest y

        call check("0.0, -3.0 v = 0.0, -1.0", "", -4.0_dp, -1.0_dp, &
                   last*(exp(20.0_dp)*start + exp(10.0_dp)), "by the start")
        call check("0.0, -3.0 v = 0.0, -1.0", "", -4.0_dp, -1.0_dp - 1e-5_dp, &
                   1e-5_dp/terms*exp(10.0_dp), "by the energy")
        call check("0.0, -3.0 v = 0.0, -1.0", "", -4.0_dp, -1.0_dp + 1e-5_dp, &
                   1e-5_dp/terms*exp(10.0_dp), "by the energy, to the other side")
        call check("0.0, -3.0 v = 0.0, -1.0", " Q_x = '-30 x_dot'", -4.0_dp, -1.0_dp, &
                   last*exp(10.0_dp), "no energy")
        call check("0.0, 0.0 v = 0.0, 0.0", "", 0.0_dp, 0.0_dp, last*exp(20.0_dp), "at rest")
    contains
        subroutine check(begin, drag, y, y_dot, share, about)
            !! The error of y, beside 4 m, if the run is seen to end there.
            character(*), intent(in) :: begin, drag, about
            real(dp), intent(in) :: y, y_dot, share
            class(observer_t), pointer :: nobody
            class(reference_t), allocatable :: none
            type(final_state_t) :: seen
            type(final_value_t), allocatable :: state(:)
            type(run_plan_t) :: plan
            type(error_t), allocatable :: error

            if (anyExceptions()) return
            nobody => null()
            call parse_run_plan(plan, "&scene system = 'top' method = 'gauss16' dt = 0.1 "// &
                                "t0 = 0.5 duration = 1 columns = 't' error_estimate = .true. "// &
                                "q = "//begin//" / &lagrangian coordinates = 'x', 'y' "// &
                                "T = '(x_dot^2 + y_dot^2)/2' V = '-200 x^2'"//drag//" /", &
                                "top.nml", [word_t ::], error)
            call assertFalse(allocated(error), about)
            if (anyExceptions()) return
            seen%t = 1.5_dp
            seen%t_slow = slow
            seen%q = [1e-17_dp, y]
            seen%v = [0.0_dp, y_dot]
            seen%q_most = [1.0_dp, 4.0_dp]
            seen%v_most = [1.0_dp, 10.0_dp]
            call state_accuracy(plan%settled, plan%system, none, plan%finer, seen, 10_i8, nobody, &
                                state, error)
            call assertFalse(allocated(error), about)
            if (anyExceptions()) return
            call assertEqual(4.0_dp*share, state(2)%error, 1e-4_dp*share, about)
        end subroutine check
    end subroutine what_has_grown_at_a_saddle

    subroutine an_end_that_is_elsewhere()
        !! For 1000 s of an oscillation the least tolerance takes more than 100000 evaluations, and
        !! 1e-12 fewer: that one knows the end only if the run is off by more than 1e-7 of its
        !! largest values.
        real(dp), parameter :: off = 3e-7_dp, small = 1e-7_dp

        call assertFalse(known(0.0_dp, 0.0_dp), "where it is")
        call assertFalse(known(small, small), "near it")
        call assertFalse(known(-small, -small), "near it, to the other side")
        call assertTrue(known(off, 0.0_dp), "another place")
        call assertTrue(known(-off, 0.0_dp), "to the other side")
        call assertTrue(known(0.0_dp, off), "another velocity")
        call assertTrue(known(0.0_dp, -off), "a smaller one")
    contains
        function known(q, v) result(yes)
            !! Of a run that ends so far off, of 2 m and 2 m/s.
            real(dp), intent(in) :: q, v
            logical :: yes
            type(oscillator_t) :: oscillator
            type(event_box_t) :: none(0)
            type(final_state_t) :: seen
            type(scene_t) :: scene
            type(error_t), allocatable :: error
            real(dp) :: state(3)

            call oscillator%configure([1.0_dp, 1.0_dp, 0.0_dp], error)
            call assertFalse(allocated(error), "an oscillator")
            scene%method = "rk4"
            scene%duration = 1000.0_dp
            scene%q = [2.0_dp]
            scene%v = [0.0_dp]
            seen%t = 1000.0_dp
            seen%q = [2.0_dp*cos(1000.0_dp) + q]
            seen%v = [v - 2.0_dp*sin(1000.0_dp)]
            seen%q_most = [2.0_dp]
            seen%v_most = [2.0_dp]
            call by_other_method(scene, oscillator, seen, none, 100000_i8, state, yes)
        end function known
    end subroutine an_end_that_is_elsewhere
end module test_second_run
