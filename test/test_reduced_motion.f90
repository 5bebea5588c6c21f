module test_reduced_motion
    !! The cart-pendulum without its cyclic coordinate, and methods that leave that out.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertGreaterThan, assertTrue
    use lagrangia_audit, only: audit_system, draws
    use lagrangia_audit_equations, only: claim_accelerations, claim_energy
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_cart_swing, only: cart_swing_t
    use lagrangia_command_line, only: word_t
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t, integrator_t, not_started
    use lagrangia_kinds, only: dp, i8
    use lagrangia_ledger, only: ledger_t
    use lagrangia_methods, only: new_adaptive, new_integrator
    use lagrangia_outcome, only: outcome_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_reduced_motion, only: leave_cyclic, reduced_motion_t
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: system_t
    use random_states, only: draw_parameters, draw_state, restart_random
    use scene_runs, only: plan_and_run, read_and_plan
    implicit none (type, external)
    private
    public :: reduced_motion_suite

contains

    function reduced_motion_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("reduced_motion")
        call suite%addTest(TestMethod("rouths_function_gives_its_equations", &
                                      rouths_function_gives_its_equations))
        call suite%addTest(TestMethod("states_leave_and_come_back", states_leave_and_come_back, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("the_whole_motion_is_the_same", &
                                      the_whole_motion_is_the_same))
        call suite%addTest(TestMethod("between_steps_and_after_a_push", &
                                      between_steps_and_after_a_push))
        call suite%addTest(TestMethod("cuts_leave_no_trace", cuts_leave_no_trace))
        call suite%addTest(TestMethod("late_is_as_good_as_early", late_is_as_good_as_early))
        call suite%addTest(TestMethod("only_where_it_pays", only_where_it_pays))
        call suite%addTest(TestMethod("scenes_use_it_and_say_so", scenes_use_it_and_say_so))
    end function reduced_motion_suite

    subroutine rouths_function_gives_its_equations()
        !! Accelerations, lanes and energy against \(R\), by exact derivatives.
        type(cart_swing_t) :: system
        type(ledger_t) :: audit
        integer :: i

        call audit_system(system, audit)
        do i = 1, size(audit%rows)
            associate (row => audit%rows(i))
                call assertTrue(row%holds, trim(row%name)//" "//row%remark)
            end associate
        end do
        call assertEqual(draws, audit%rows(audit%row_of(claim_accelerations))%states)
        call assertEqual(draws, audit%rows(audit%row_of(claim_energy))%states)
    end subroutine rouths_function_gives_its_equations

    subroutine states_leave_and_come_back()
        !! At another time \(p_x\) is what it was, and the angle has the same acceleration.
        type(cart_pendulum_t) :: system
        type(cart_swing_t) :: swing
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t, q_new(2), v_new(2), q_left(1), v_left(1), a(2), a_left(1), p(2), p_new(2)
        integer :: k

        do k = 1, 50
            call draw_parameters(system, edges=.false.)
            call draw_state(system, t, q, v)
            call swing%configure([system%m1, system%m2, system%l, system%g], error)
            call swing%leave(q, v, q_left, v_left)
            call swing%complete(0.0_dp, q_left, v_left, q_new, v_new)
            call assertEqual(q, q_new, 1e-14_dp*(1.0_dp + sum(abs(q))), "q")
            call assertEqual(v, v_new, 1e-14_dp*(1.0_dp + sum(abs(v))), "v")
            call system%accelerations(t, q, v, a)
            call swing%accelerations(t, q_left, v_left, a_left)
            call assertEqual(a(2), a_left(1), 1e-14_dp*(1.0_dp + abs(a(2))), "theta_ddot")
            call system%momenta(t, q, v, p)
            call swing%complete(1.0_dp, q_left + 0.7_dp, v_left - 2.0_dp, q_new, v_new)
            call system%momenta(t, q_new, v_new, p_new)
            call assertEqual(p(1), p_new(1), 1e-13_dp*(1.0_dp + sum(abs(p))), "p_x")
            call assertEqual(system%quantity(2, t, q, v), &
                             system%quantity(2, t + 1.0_dp, q_new, v_new), &
                             1e-13_dp*(1.0_dp + abs(t))*(1.0_dp + sum(abs(q)) + sum(abs(v))), &
                             "centre of mass")
        end do
    end subroutine states_leave_and_come_back

    subroutine the_whole_motion_is_the_same()
        !! To rounding, and by `dop853` to the error of its steps.
        type(cart_pendulum_t) :: system
        class(integrator_t), allocatable :: whole, reduced
        class(dense_integrator_t), allocatable :: adaptive
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2), q_whole(2), v_whole(2)

        call system%configure([2.0_dp, 1.3_dp, 0.8_dp, 9.81_dp], error)
        call new_integrator("gauss16", whole, error)
        allocate (reduced, source=whole)
        call leave_cyclic(reduced, system)
        q = [0.4_dp, 1.2_dp]
        v = [-0.6_dp, 1.5_dp]
        q_whole = q
        v_whole = v
        call whole%prepare(system, error)
        call whole%start(system, 0.3_dp, q_whole, v_whole)
        call whole%advance(system, 0.3_dp, 0.05_dp, 0_i8, 200_i8, q_whole, v_whole)
        call reduced%prepare(system, error)
        call reduced%start(system, 0.3_dp, q, v)
        call reduced%advance(system, 0.3_dp, 0.05_dp, 0_i8, 200_i8, q, v)
        call assertEqual(q_whole, q, 1e-13_dp, "q")
        call assertEqual(v_whole, v, 1e-13_dp, "v")
        call assertGreaterThan(abs(q(1)), 1.0_dp, message="the cart moves")
        call assertGreaterThan(reduced%evaluations, 0_i8, message="evaluations")
        call new_adaptive("dop853", adaptive)
        deallocate (reduced)
        allocate (reduced, source=adaptive)
        call leave_cyclic(reduced, system)
        call reduced%prepare(system, error)
        q = [0.4_dp, 1.2_dp]
        v = [-0.6_dp, 1.5_dp]
        call reduced%start(system, 0.3_dp, q, v)
        call reduced%advance(system, 0.3_dp, 0.02_dp, 0_i8, 500_i8, q, v)
        call assertEqual(q_whole, q, 1e-9_dp, "q by dop853")
        call assertEqual(v_whole, v, 1e-9_dp, "v by dop853")
        call new_integrator("rk4", reduced, error)
        reduced%leaves_cyclic = .true.
        call leave_cyclic(reduced, system)
        call assertTrue(is_reduced(reduced), "any method")
        call reduced%prepare(system, error)
        q = [0.4_dp, 1.2_dp]
        v = [-0.6_dp, 1.5_dp]
        call reduced%start(system, 0.3_dp, q, v)
        call reduced%advance(system, 0.3_dp, 1e-3_dp, 0_i8, 10000_i8, q, v)
        call assertEqual(q_whole, q, 1e-8_dp, "q by rk4")
        call assertEqual(v_whole, v, 1e-8_dp, "v by rk4")
        call assertEqual(40000_i8, reduced%evaluations, message="evaluations of rk4")
    end subroutine the_whole_motion_is_the_same

    subroutine between_steps_and_after_a_push()
        !! Dense output has both coordinates; a new start has a new momentum.
        type(cart_pendulum_t) :: system
        class(dense_integrator_t), allocatable :: adaptive
        class(integrator_t), allocatable :: method, whole
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2), q_true(2), v_true(2), p(2), p_true(2), t
        integer :: k

        call system%configure([2.0_dp, 1.3_dp, 0.8_dp, 9.81_dp], error)
        call new_integrator("gauss16", whole, error)
        call new_adaptive("gauss16", adaptive)
        adaptive%tolerance = 1e-13_dp
        allocate (method, source=adaptive)
        call leave_cyclic(method, system)
        call method%prepare(system, error)
        select type (method)
        type is (reduced_motion_t)
            do k = 0, 1
                q_true = [0.4_dp, 2.0_dp]
                v_true = [-0.6_dp + 3.0_dp*k, 1.5_dp]
                call system%momenta(0.0_dp, q_true, v_true, p_true)
                call method%start(system, 1.0_dp*k, q_true, v_true, 5.0_dp)
                call method%step(system, error)
                call method%step(system, error)
                t = 0.3_dp*method%t_old + 0.7_dp*method%t_new
                call assertGreaterThan(method%t_old, 1.0_dp*k, message="the second step")
                call assertEqual(2*k + 2, int(method%accepted), "steps")
                call method%state_at(t, q, v)
                call whole%prepare(system, error)
                call whole%start(system, 1.0_dp*k, q_true, v_true)
                call whole%advance(system, 1.0_dp*k, (t - k)/20, 0_i8, 20_i8, q_true, v_true)
                call assertEqual(q_true, q, 1e-12_dp, "q")
                call assertEqual(v_true, v, 1e-11_dp, "v")
                call system%momenta(t, q, v, p)
                call assertEqual(p_true(1), p(1), 1e-14_dp*abs(p_true(1)), "p_x")
            end do
        class default
            call assertTrue(.false., "reduced")
        end select
    end subroutine between_steps_and_after_a_push

    subroutine cuts_leave_no_trace()
        !! The same bytes in one block and step by step; from elsewhere the momentum is another.
        type(cart_pendulum_t) :: system
        class(integrator_t), allocatable :: method
        type(error_t), allocatable :: error
        real(dp) :: q(2, 2), v(2, 2), p(2), p_new(2)
        integer(i8) :: k

        call system%configure([2.0_dp, 1.3_dp, 0.8_dp, 9.81_dp], error)
        call new_integrator("gauss16", method, error)
        call leave_cyclic(method, system)
        q = spread([0.4_dp, 2.0_dp], 2, 2)
        v = spread([-0.6_dp, 1.5_dp], 2, 2)
        call method%prepare(system, error)
        call method%start(system, 0.3_dp, q(:, 1), v(:, 1))
        call method%advance(system, 0.3_dp, 0.05_dp, 0_i8, 30_i8, q(:, 1), v(:, 1))
        call method%prepare(system, error)
        call method%try_advance(system, 0.3_dp, 0.05_dp, 0_i8, 30_i8, q(:, 2), v(:, 2), error)
        call assertEqual("the state is not finite at t = 1.8 s: "//not_started, error%message)
        call method%start(system, 0.3_dp, q(:, 2), v(:, 2))
        do k = 0, 29
            call method%advance(system, 0.3_dp, 0.05_dp, k, 1_i8, q(:, 2), v(:, 2))
        end do
        call assertEqual(q(:, 1), q(:, 2), message="q")
        call assertEqual(v(:, 1), v(:, 2), message="v")
        v(1, 2) = 5.0_dp
        call system%momenta(0.0_dp, q(:, 2), v(:, 2), p)
        call method%start(system, 0.3_dp + 30*0.05_dp, q(:, 2), v(:, 2))
        call method%advance(system, 0.3_dp, 0.05_dp, 30_i8, 10_i8, q(:, 2), v(:, 2))
        call system%momenta(0.0_dp, q(:, 2), v(:, 2), p_new)
        call assertEqual(p(1), p_new(1), 1e-14_dp*abs(p(1)), "p_x")
    end subroutine cuts_leave_no_trace

    subroutine late_is_as_good_as_early()
        !! Without the time in the equations the clock does not matter: not a bit by steps of `dt`,
        !! and between the ends of adaptive steps, whose lengths are rounded to the clock's last
        !! digit 2**-35 s (at 2**18 s), no more than that times the speed, 5.
        type(cart_pendulum_t) :: system
        class(dense_integrator_t), allocatable :: adaptive
        class(integrator_t), allocatable :: method, whole
        type(error_t), allocatable :: error
        real(dp), parameter :: late = 2.0_dp**18, start(2) = [0.4_dp, 2.0_dp]
        real(dp) :: q(2, 2), v(2, 2), inside(2, 2), t
        integer :: k

        call system%configure([2.0_dp, 1.3_dp, 0.8_dp, 9.81_dp], error)
        call new_integrator("gauss16", method, error)
        call leave_cyclic(method, system)
        q = spread(start, 2, 2)
        v = spread([-0.6_dp, 1.5_dp], 2, 2)
        call new_adaptive("gauss16", adaptive)
        allocate (whole, source=adaptive)
        call leave_cyclic(whole, system)
        do k = 1, 2
            t = (k - 1)*late
            call whole%prepare(system, error)
            select type (whole)
            type is (reduced_motion_t)
                call whole%start(system, t, q(:, k), v(:, k), t + 1.0_dp)
                call whole%step(system, error)
                call whole%state_at(t + 0.03125_dp, inside(:, k), v(:, k))
            end select
            v(:, k) = [-0.6_dp, 1.5_dp]
            call method%prepare(system, error)
            call method%start(system, t, q(:, k), v(:, k))
            call method%advance(system, t, 0.0371_dp, 0_i8, 30_i8, q(:, k), v(:, k))
        end do
        call assertEqual(q(:, 1), q(:, 2), message="q")
        call assertEqual(v(:, 1), v(:, 2), message="v")
        call assertEqual(inside(:, 1), inside(:, 2), 2.0_dp**(-35)*5.0_dp, "q by tolerance")
    end subroutine late_is_as_good_as_early

    subroutine only_where_it_pays()
        !! Not by other methods, not for systems that know no way.
        type(cart_pendulum_t) :: system
        type(pendulum_t) :: pendulum
        class(integrator_t), allocatable :: method
        type(error_t), allocatable :: error

        call system%configure([2.0_dp, 1.3_dp, 0.8_dp, 9.81_dp], error)
        call pendulum%configure([1.0_dp, 1.0_dp, 0.0_dp], error)
        call new_integrator("rk4", method, error)
        call leave_cyclic(method, system)
        call assertFalse(is_reduced(method), "rk4")
        call new_integrator("gauss16", method, error)
        call leave_cyclic(method, pendulum)
        call assertFalse(is_reduced(method), "pendulum")
        call leave_cyclic(method, system)
        call assertTrue(is_reduced(method), "gauss16")
        call assertEqual("gauss16", method%name)
        call assertEqual(16, method%order)
    end subroutine only_where_it_pays

    subroutine scenes_use_it_and_say_so()
        !! By `dt`, by tolerance and with events; `rk4` integrates all coordinates.
        call check_scene("method = 'gauss16', dt = 0.05", .true.)
        call check_scene("method = 'dop853', tolerance = 1e-10", .true.)
        call check_scene("method = 'gauss16', tolerance = 1e-10, event = 'x = 0'", .true.)
        call check_scene("method = 'rk4', dt = 1e-3", .false.)
    end subroutine scenes_use_it_and_say_so

    subroutine check_scene(method, left_out)
        !! Right in both coordinates, and the remark is there or not.
        character(*), intent(in) :: method
        logical, intent(in) :: left_out
        character(*), parameter :: remark = " (the cyclic coordinate from its momentum)"
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(outcome_t) :: outcome
        type(error_t), allocatable :: error

        call read_and_plan("&scene system = 'cart_pendulum', duration = 3, q = 0.4, 1.2, "// &
                         "v = -0.6, 1.5, columns = 't', 'x', 'error', expect_error = 1e-8, "// &
                         method//" /", "a.nml", [word_t ::], scene, system, error)
        call assertFalse(allocated(error), method)
        call plan_and_run(scene, system, outcome, error)
        call assertEqual("holds", outcome%verdict(), method)
        call assertEqual(merge(1, 0, left_out), index(outcome%remark, remark), method)
    end subroutine check_scene

    function is_reduced(method)
        class(integrator_t), intent(in) :: method
        logical :: is_reduced

        select type (method)
        type is (reduced_motion_t)
            is_reduced = .true.
        class default
            is_reduced = .false.
        end select
    end function is_reduced
end module test_reduced_motion
