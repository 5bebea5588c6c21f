module test_accuracy
    !! What a run says of its error, beside the truth.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertGreaterThan, &
                     assertFalse, assertLessThan, assertLessThanOrEqual, assertTrue
    use lagrangia_accuracy, only: agreement, estimate, plan_finer, state_accuracy
    use lagrangia_catalogue, only: new_system
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t
    use lagrangia_final_state, only: final_state_t
    use lagrangia_final_values, only: final_value_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: adaptive_names, method_names
    use lagrangia_observer, only: observer_t
    use lagrangia_outcome, only: outcome_t
    use lagrangia_random_draws, only: random_t
    use lagrangia_reference, only: reference_t
    use lagrangia_run_plan, only: parse_run_plan, run_plan_t
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    use lagrangia_trajectory_plan, only: trajectory_plan_t
    use scene_runs, only: plan_and_run, read_and_plan
    use stated_text, only: read_concise
    implicit none (type, external)
    private
    public :: accuracy_suite

    character(16), parameter :: solved(*) = [character(16) :: "pendulum", "cart_pendulum", &
                                             "charged_particle", "oscillator", "rotating_wire", &
                                             "wedge", "rolling_disk"]

contains

    function accuracy_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("accuracy")
        call suite%addTest(TestMethod("fixed_steps_know_their_error", fixed_steps_know_their_error))
        call suite%addTest(TestMethod("adaptive_steps_know_their_error", &
                                      adaptive_steps_know_their_error))
        call suite%addTest(TestMethod("long_steps_claim_no_wrong_digit", &
                                      long_steps_claim_no_wrong_digit))
        call suite%addTest(TestMethod("repeated_rounding_is_seen", repeated_rounding_is_seen))
        call suite%addTest(TestMethod("what_does_not_shrink_is_not_trusted", &
                                      what_does_not_shrink_is_not_trusted))
        call suite%addTest(TestMethod("the_latest_change_counts", the_latest_change_counts))
        call suite%addTest(TestMethod("who_lingers_is_not_trusted", who_lingers_is_not_trusted))
        call suite%addTest(TestMethod("who_returns_to_a_saddle", who_returns_to_a_saddle))
        call suite%addTest(TestMethod("small_distances_are_trusted", small_distances_are_trusted))
        call suite%addTest(TestMethod("finer_steps_are_not_halves", finer_steps_are_not_halves))
        call suite%addTest(TestMethod("an_estimate_is_doubled", an_estimate_is_doubled))
    end function accuracy_suite

    subroutine fixed_steps_know_their_error()
        !! Every method, beside the closed forms of seven systems.
        character(name_length), allocatable :: names(:)
        integer :: i

        allocate (names, source=method_names())
        do i = 1, size(names)
            call check_method(trim(names(i)), .false., 0.005_dp, 0.1_dp)
            if (anyExceptions()) return
        end do
    end subroutine fixed_steps_know_their_error

    subroutine adaptive_steps_know_their_error()
        !! By tolerances, down to where rounding rules.
        character(name_length), allocatable :: names(:)
        integer :: i

        allocate (names, source=adaptive_names())
        do i = 1, size(names)
            call check_method(trim(names(i)), .true., 1e-13_dp, 1e-4_dp)
        end do
    end subroutine adaptive_steps_know_their_error

    subroutine long_steps_claim_no_wrong_digit()
        !! Too long for any order to show, or unstable: then few digits or none are claimed.
        call check_method("rk4", .false., 0.2_dp, 2.0_dp, only_digits=.true.)
        call check_method("verlet", .false., 0.2_dp, 2.0_dp, only_digits=.true.)
        call check_method("midpoint", .false., 0.2_dp, 2.0_dp, only_digits=.true.)
    end subroutine long_steps_claim_no_wrong_digit

    subroutine repeated_rounding_is_seen()
        !! Where accelerations are constant every step may round the same way, and would at half
        !! the step too.
        call check_method("velocity_verlet", .false., 1.5e-3_dp, 3e-3_dp, only_digits=.true., &
                          systems=["wedge"], draws=100)
    end subroutine repeated_rounding_is_seen

    subroutine what_does_not_shrink_is_not_trusted()
        !! Changes to a quarter, as they should: each number by itself, the one that does not change
        !! to two units in its largest values' last place. Other changes: together.
        real(dp), parameter :: most(3) = [1.0_dp, 10.0_dp, 4.0_dp]
        real(dp), parameter :: zero(3) = 0.0_dp
        real(dp) :: error(3), sense
        integer :: i

        do i = 1, 2  ! to either side
            sense = merge(1.0_dp, -1.0_dp, i == 1)/1024
            ! errors 16, 4, 1 in units of 2**-10
            error = estimate([16.0_dp, 0.0_dp, 0.0_dp]*sense, [4.0_dp, 0.0_dp, 0.0_dp]*sense, &
                             [1.0_dp, 0.0_dp, 0.0_dp]*sense, most, 4.0_dp)
            call assertEqual([16.0_dp/1024, 20.0_dp*epsilon(most), 8.0_dp*epsilon(most)], error, &
                             4.0_dp*epsilon(most), "as they should")
            ! as large a change again: the error is no less, and three times what is expected too
            ! much
            error = estimate([1.0_dp, 0.0_dp, 0.0_dp]*sense, zero, [1.0_dp, 0.0_dp, 0.0_dp]*sense, &
                             most, 4.0_dp)
            call assertEqual([3.0_dp, 30.0_dp, 12.0_dp]/1024, error, 4.0_dp*epsilon(most), &
                             "together")
            ! a larger change: no more than five times
            error = estimate(zero, zero, [3.0_dp, 0.0_dp, 0.0_dp]*sense, most, 4.0_dp)
            call assertEqual(5.0_dp*[4.0_dp, 40.0_dp, 16.0_dp]/1024, error, &
                             4.0_dp*epsilon(most), "warily")
        end do
    end subroutine what_does_not_shrink_is_not_trusted

    subroutine the_latest_change_counts()
        !! The other end may be the third run's by chance. With a tolerance the error is the
        !! distance to it and the change before, with steps that halve the distance alone.
        real(dp), parameter :: first(2) = [64.0_dp, 8.0_dp], second(2) = [2.0_dp, -1.0_dp]
        real(dp), parameter :: other(2) = [0.0_dp, 0.0_dp], most(2) = 100.0_dp

        call assertEqual([64.0_dp, 8.0_dp], agreement(first, second, other, other, most, &
                         16.0_dp, .false.), 1e-12_dp, "steps that halve")
        call assertEqual([66.0_dp, 9.0_dp], agreement(first, second, other, other, most, &
                         16.0_dp, .true.), 1e-12_dp, "a tolerance")
        call assertEqual([72.0_dp, 16.0_dp], agreement(first, second, [0.0_dp, -2.0_dp], other, &
                         most, 16.0_dp, .true.), 1e-12_dp, "four times the other end's distance")
        call assertEqual([64.0_dp, 8.0_dp], agreement(-first, -second, -other, -other, most, &
                         16.0_dp, .false.), 1e-12_dp, "the same of the other sign")
        call assertEqual([72.0_dp, 16.0_dp], agreement(-first, -second, [0.0_dp, 2.0_dp], -other, &
                         most, 16.0_dp, .true.), 1e-12_dp, "and of the other end")
    end subroutine the_latest_change_counts

    subroutine who_lingers_is_not_trusted()
        !! Where each velocity is within a hundredth of its largest, and each acceleration within
        !! \(v^2/100q\) of the largest, the error is ten times: at either bound, from either side, a
        !! coordinate that never moved beside. The end is off by half a metre.
        real(dp), parameter :: still(3) = 0.0_dp, near(2) = [1.0_dp - 1e-9_dp, 1.0_dp + 1e-9_dp]
        real(dp) :: errors(6, 2)
        integer :: i, k

        do i = -1, 1, 2
            do k = 1, 2
                call state_errors("0, 0, 0", [1.5_dp, 0.0_dp, 0.0_dp], &
                                  i*[0.02_dp*near(k), 0.0_dp, 0.0_dp], [2.0_dp, 1.0_dp, 0.0_dp], &
                                  [2.0_dp, 1.0_dp, 0.0_dp], errors(:, k))
            end do
            call assertEqual(10.0_dp*errors(:, 2), errors(:, 1), 1e-6_dp, "the first velocity")
            do k = 1, 2
                call state_errors("0, 0, 0", [1.5_dp, 0.0_dp, 0.0_dp], &
                                  i*[0.0_dp, 0.01_dp*near(k), 0.0_dp], [2.0_dp, 1.0_dp, 0.0_dp], &
                                  [2.0_dp, 1.0_dp, 0.0_dp], errors(:, k))
            end do
            call assertEqual(10.0_dp*errors(:, 2), errors(:, 1), 1e-6_dp, "the second velocity")
            do k = 1, 2
                call state_errors(merge("-0.02, 0, 0", " 0.02, 0, 0", i < 0), &
                                  [1.5_dp, 0.0_dp, 0.0_dp], still, &
                                  [4.5_dp*near(k), 1.0_dp, 0.0_dp], [3.0_dp, 1.0_dp, 0.0_dp], &
                                  errors(:, k))
            end do
            call assertEqual(10.0_dp*errors(:, 2), errors(:, 1), 1e-6_dp, "the first acceleration")
            do k = 1, 2
                call state_errors(merge("0, -0.02, 0", "0,  0.02, 0", i < 0), &
                                  [1.5_dp, 0.0_dp, 0.0_dp], still, &
                                  [2.0_dp, 4.5_dp*near(k), 0.0_dp], [1.0_dp, 3.0_dp, 0.0_dp], &
                                  errors(:, k))
            end do
            call assertEqual(10.0_dp*errors(:, 2), errors(:, 1), 1e-6_dp, "the second acceleration")
            call assertGreaterThan(errors(1, 2), 0.4_dp, message="half a metre")
        end do
    end subroutine who_lingers_is_not_trusted

    subroutine who_returns_to_a_saddle()
        !! A bead leaves the top of a hoop with 1e-9 rad/s and comes back to it after 11 s, with an
        !! energy that rounding decides: which runs say that it is still there, agree by chance. In
        !! truth (45 digits) it has left. On its first way out every method states its digits.
        character(*), parameter :: methods(5) = [character(50) :: &
            "method = 'rk4' dt = 1e-3", "method = 'midpoint' dt = 1e-3", &
            "method = 'verlet' dt = 1e-3", "method = 'gauss16' tolerance = 1e-12 samples = 20", &
            "method = 'dop853' tolerance = 1e-12 samples = 20"]
        real(dp), parameter :: durations(3) = [19.0_dp, 19.5_dp, 20.0_dp]
        real(dp), parameter :: truth(3) = [-1.42555_dp, -0.28360_dp, -0.04080_dp]
        type(outcome_t) :: outcome
        type(scene_t) :: scene
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        character(8) :: seconds
        integer :: i, k

        do k = 1, size(methods)
            do i = 1, size(durations)
                write (seconds, "(f0.1)") durations(i)
                call run_hoop(trim(methods(k)), seconds)
                call assertTrue(.not. outcome%state(1)%resolved() .or. &
                                abs(outcome%state(1)%value - truth(i)) <= &
                                outcome%state(1)%error + 1e-5_dp, message=methods(k)//seconds)
            end do
            call run_hoop(trim(methods(k)), "5.0")
            call assertLessThan(outcome%state(1)%error, 1e-2_dp*outcome%state(1)%value)
        end do
    contains
        subroutine run_hoop(method, duration)
            character(*), intent(in) :: method, duration

            call read_and_plan("&scene system = 'rotating_hoop' q = 0 v = 1e-9 "// &
                               "error_estimate = .true. duration = "//duration//" "//method// &
                               " / &rotating_hoop m = 1, r = 1, omega = 5, g = 9.81 /", "hoop", &
                               [word_t ::], scene, system, error)
            call assertFalse(allocated(error), message=method)
            call plan_and_run(scene, system, outcome, error)
            call assertFalse(allocated(error), message=method)
        end subroutine run_hoop
    end subroutine who_returns_to_a_saddle

    subroutine small_distances_are_trusted()
        !! Of what never moves, too, up to 1e-10 of the largest value.
        real(dp), parameter :: still(3) = 0.0_dp, off(2) = [0.99e-10_dp, 1.01e-10_dp]
        real(dp) :: errors(6, 2)
        integer :: i, k

        do i = -1, 1, 2
            do k = 1, 2
                call state_errors("0, 0, 0", [1.0_dp + i*off(k), 0.0_dp, 0.0_dp], still, &
                                  [1.0_dp, 0.0_dp, 0.0_dp], still, errors(:, k))
            end do
            call assertEqual([0.99e-10_dp, 1.01e-9_dp], errors(1, :), 1e-13_dp, "below and above")
        end do
    end subroutine small_distances_are_trusted

    subroutine finer_steps_are_not_halves()
        !! Of n = 10 steps, or of 10 and a part, 2 n + 1, and twice that and one again; each is seen
        !! as often as the steps that it refines.
        call check("0.1", 10)
        call check("0.098", 10)
        call check("0.0953", 10)
        call check("0.25", 4)
    contains
        subroutine check(dt, n)
            character(*), intent(in) :: dt
            integer, intent(in) :: n
            type(run_plan_t) :: plan
            type(trajectory_plan_t) :: finer(2)
            type(error_t), allocatable :: error
            integer :: k

            call parse_run_plan(plan, "&scene system = 'pendulum', method = 'rk4', q = 1, dt = "// &
                                dt//", duration = 1, every = 2, columns = 't' /", "s.nml", &
                                [word_t ::], error)
            call assertFalse(allocated(error), "a good scene")
            if (allocated(error)) return
            call plan_finer(plan%settled, plan%system, finer, error)
            call assertFalse(allocated(error), "finer")
            if (allocated(error)) return
            do k = 1, 2
                call assertEqual(int(2**k*(n + 1) - 1, i8), finer(k)%times%step_count(), dt)
                call assertEqual(2_i8*2_i8**k, finer(k)%times%every, dt)
            end do
        end subroutine check
    end subroutine finer_steps_are_not_halves

    subroutine an_estimate_is_doubled()
        !! Where no other method is asked, as across impacts, the distance to the finer runs counts
        !! twice: half a metre of a ball that falls.
        type(final_state_t) :: seen
        real(dp) :: errors(2)

        seen%q = [10.0_dp - 0.5_dp*9.81_dp + 0.5_dp]
        seen%v = [-9.81_dp]
        seen%q_most = [10.0_dp]
        seen%v_most = [9.81_dp]
        call errors_after_a_second("system = 'bouncing_ball', q = 10", "&bouncing_ball", seen, &
                                   errors)
        call assertEqual(1.0_dp, errors(1), 1e-12_dp, "twice half a metre")
    end subroutine an_estimate_is_doubled

    subroutine state_errors(force, q, v, q_most, v_most, errors)
        !! Of a particle of 1 kg that was at rest at (1 m, 0, 0), if it is seen so after a second.
        character(*), intent(in) :: force                        !! per charge of 1 C
        real(dp), intent(in) :: q(3), v(3), q_most(3), v_most(3)
        real(dp), intent(out) :: errors(6)
        type(final_state_t) :: seen

        seen%q = q
        seen%v = v
        seen%q_most = q_most
        seen%v_most = v_most
        call errors_after_a_second("system = 'charged_particle', q = 1, 0, 0", &
                                   "&charged_particle magnetic = 0, 0, 0, electric = "//force, &
                                   seen, errors)
    end subroutine state_errors

    subroutine errors_after_a_second(start, parameters, seen, errors)
        !! What is stated of a final state, beside finer runs that are exact.
        character(*), intent(in) :: start, parameters  !! of the scene and of the system
        type(final_state_t), intent(inout) :: seen     !! gets its time
        real(dp), intent(out) :: errors(:)
        class(observer_t), pointer :: nobody
        class(reference_t), allocatable :: none
        type(run_plan_t) :: plan
        type(final_value_t), allocatable :: state(:)
        type(error_t), allocatable :: error

        errors = -1.0_dp
        nobody => null()
        call parse_run_plan(plan, "&scene "//start//", method = 'rk4', dt = 0.1, duration = 1, "// &
                            "columns = 't', error_estimate = .true. / "//parameters//" /", &
                            "s.nml", [word_t ::], error)
        call assertFalse(allocated(error), "a good scene")
        if (allocated(error)) return
        seen%t = 1.0_dp
        call state_accuracy(plan%settled, plan%system, none, plan%finer, seen, 10_i8, nobody, &
                            state, error)
        call assertFalse(allocated(error), "the finer runs")
        if (.not. allocated(error)) errors = state%error
    end subroutine errors_after_a_second

    subroutine check_method(name, adaptive, shortest, longest, only_digits, systems, draws)
        !! Random scenes of every solved system that the method takes. The error of a state
        !! relative to its largest values is stated to be no less than it is, and not twice as
        !! much, wherever it is neither rounding nor large; and no digit that is claimed is wrong,
        !! wherever.
        character(*), intent(in) :: name
        logical, intent(in) :: adaptive
        real(dp), intent(in) :: shortest, longest  !! step or tolerance
        logical, intent(in), optional :: only_digits
        character(*), intent(in), optional :: systems(:)
        integer, intent(in), optional :: draws
        type(random_t) :: random
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error
        real(dp), allocatable :: truth(:)
        real(dp) :: actual, estimate, centre, bracket
        real(dp) :: rounding  !! of the closed forms, relative
        logical :: known
        character(16), allocatable :: names(:)
        integer :: i, k, n, counted, most

        allocate (names, source=solved)
        if (present(systems)) names = [character(16) :: systems]
        rounding = 3e-14_dp
        if (present(systems)) rounding = 8.0_dp*epsilon(rounding)
        most = 5
        if (present(draws)) most = draws
        counted = 0
        do i = 1, size(names)
            do k = 1, most
                call draw(random, trim(names(i)), name, adaptive, shortest, longest, outcome, &
                          truth, known, error)
                if (allocated(error) .or. .not. known) cycle
                counted = counted + 1
                actual = 0.0_dp
                estimate = 0.0_dp
                do n = 1, size(outcome%state)
                    associate (s => outcome%state(n))
                        if (s%resolved()) then
                            call read_concise(s%text(), centre, bracket)
                            call assertLessThanOrEqual(abs(centre - truth(n)), bracket + &
                                rounding*s%most, message=name//" "//trim(names(i))//": "// &
                                trim(s%name)//" = "//s%text())
                        end if
                        if (s%most <= 0.0_dp) cycle
                        actual = max(actual, abs(s%value - truth(n))/s%most)
                        estimate = max(estimate, s%error/s%most)
                    end associate
                end do
                if (present(only_digits) .or. actual < 1e-10_dp .or. actual > 1e-3_dp) cycle
                call assertGreaterThan(estimate, 0.999_dp*actual, message=name//" "//names(i))
                call assertLessThan(estimate, 2.0_dp*actual, message=name//" "//names(i))
            end do
        end do
        call assertGreaterThan(counted, most/2, message=name//": scenes that count")
    end subroutine check_method

    subroutine draw(random, name, method, adaptive, shortest, longest, outcome, truth, known, error)
        !! A run of a random scene, and its true end, if that is known.
        type(random_t), intent(inout) :: random
        character(*), intent(in) :: name, method
        logical, intent(in) :: adaptive
        real(dp), intent(in) :: shortest, longest
        type(outcome_t), intent(out) :: outcome
        real(dp), allocatable, intent(out) :: truth(:)
        logical, intent(out) :: known
        type(error_t), allocatable, intent(out) :: error
        class(system_t), allocatable :: system
        class(reference_t), allocatable :: reference
        type(scene_t) :: scene
        real(dp) :: x, q(7), v(7)

        known = .false.
        call new_system(name, system, error)
        call random%parameters(system, .false., scene%parameters, error)
        call random%state(system, scene%t0, scene%q, scene%v, error)
        if (allocated(error)) return
        scene%source = "random"
        scene%system = name
        scene%method = method
        scene%error_estimate = .true.
        allocate (scene%columns(0), scene%plots(0), scene%expectations(0))
        call random%uniform(0.5_dp, 3.0_dp, scene%duration)
        call random%uniform(log(shortest), log(longest), x)
        if (adaptive) then
            scene%tolerance = exp(x)
            scene%samples = 20
        else
            scene%dt = min(exp(x), 0.4_dp*scene%duration)
            scene%every = 3
        end if
        call plan_and_run(scene, system, outcome, error)
        if (allocated(error)) return
        call system%closed_form(scene%t0, scene%q, scene%v, reference)
        if (.not. allocated(reference)) return
        known = reference%has_state
        if (.not. known) return
        associate (n => system%ndof)
            call reference%state_at(scene%t0 + scene%duration, q(:n), v(:n))
            truth = [q(:n), v(:n)]
        end associate
    end subroutine draw
end module test_accuracy
