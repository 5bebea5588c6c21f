module test_gauss_dense
    !! The state between the ends of the steps of Gauss-Legendre collocation.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertLessThan, assertTrue
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_gauss, only: gauss_t, new_gauss16
    use lagrangia_gauss_adaptive, only: gauss_adaptive_t, new_gauss16_adaptive
    use lagrangia_gauss_dense, only: gauss_dense_t
    use lagrangia_gauss_kernels, only: apply, expand_both, fly, fly_by_guess, weighted_sum
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: adaptive_names, new_adaptive, new_integrator, nth_adaptive
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_system, only: lanes, system_t
    implicit none (type, external)
    private
    public :: gauss_dense_suite

contains

    function gauss_dense_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("gauss_dense")
        call suite%addTest(TestMethod("inside_steps_as_at_their_ends", &
                                      inside_steps_as_at_their_ends))
        call suite%addTest(TestMethod("states_at_the_ends", states_at_the_ends))
        call suite%addTest(TestMethod("ends_alone_cost_less", ends_alone_cost_less))
        call suite%addTest(TestMethod("catalogue_has_both", catalogue_has_both))
        call suite%addTest(TestMethod("noise_of_accelerations", noise_of_accelerations))
        call suite%addTest(TestMethod("kernels_are_matrix_products", kernels_are_matrix_products))
    end function gauss_dense_suite

    subroutine kernels_are_matrix_products()
        !! Each sum that is written out term by term, with numbers of which no two are alike.
        integer, parameter :: n = 3
        real(dp), parameter :: h = 0.3_dp, small = 1e-13_dp
        real(dp) :: a(2*lanes, n), c(lanes + 2, n), f1(lanes, n), f2(lanes, n), m(lanes, 2*lanes)
        real(dp) :: m_v(lanes, 2*lanes), q(n), v(n), x(lanes), y(lanes, n), q_lane(lanes, n)
        real(dp) :: both(lanes, 2, n), table(lanes, 2*lanes, 2), u(lanes, n), weights(2*lanes)
        integer :: i

        a = numbers(2*lanes, n, 1.0_dp)
        c = numbers(lanes + 2, n, 2.0_dp)
        f1 = numbers(lanes, n, 3.0_dp)
        f2 = numbers(lanes, n, 4.0_dp)
        m = numbers(lanes, 2*lanes, 5.0_dp)
        m_v = numbers(lanes, 2*lanes, 6.0_dp)
        q = reshape(numbers(n, 1, 7.0_dp), [n])
        v = reshape(numbers(n, 1, 8.0_dp), [n])
        x = reshape(numbers(lanes, 1, 9.0_dp), [lanes])
        call apply(n, m(:, :lanes), f1, y)
        call assertEqual(0.0_dp, maxval(abs(y - matmul(m(:, :lanes), f1))), small, "apply")
        call fly(n, h, x, q, v, m, m_v, a, q_lane, y)
        call assertEqual(0.0_dp, maxval(abs(y - moved(v, h*matmul(m_v, a)))), small, "fly: v")
        u = moved(q, h**2*matmul(m, a)) + h*spread(x, 2, n)*spread(v, 1, lanes)
        call assertEqual(0.0_dp, maxval(abs(q_lane - u)), small, "fly: q")
        call fly_by_guess(n, h, x, q, v, m(:, :lanes + 2), m_v(:, :lanes + 2), c, q_lane, y)
        call assertEqual(0.0_dp, maxval(abs(y - moved(v, h*matmul(m_v(:, :lanes + 2), c)))), &
                         small, "fly_by_guess: v")
        u = moved(q, h**2*matmul(m(:, :lanes + 2), c)) + &
            h*spread(x, 2, n)*spread(v, 1, lanes)
        call assertEqual(0.0_dp, maxval(abs(q_lane - u)), small, "fly_by_guess: q")
        table(:, :, 1) = m
        table(:, :, 2) = m_v
        call expand_both(n, table, f1, f2, both)
        do i = 1, 2
            call assertEqual(0.0_dp, maxval(abs(both(:, i, :) - matmul(table(:, :lanes, i), f1) &
                             - matmul(table(:, lanes + 1:, i), f2))), small, "expand_both")
        end do
        weights = m(1, :)
        call assertEqual(dot_product(weights, a(:, 1)), weighted_sum(weights, a(:, 1)), small, &
                         "weighted_sum")
    contains
        function moved(start, change) result(there)
            real(dp), intent(in) :: start(n), change(lanes, n)
            real(dp) :: there(lanes, n)

            there = spread(start, 1, lanes) + change
        end function moved
    end subroutine kernels_are_matrix_products

    function numbers(rows, columns, which) result(all)
        integer, intent(in) :: rows, columns
        real(dp), intent(in) :: which
        real(dp) :: all(rows, columns)
        integer :: i, k

        all = reshape([((sin(which + 3.7_dp*i + 1.3_dp*i*k + k**2), i=1, rows), k=1, columns)], &
                      [rows, columns])
    end function numbers

    subroutine ready(system, tolerance, method)
        !! Prepare `method`.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: tolerance
        type(gauss_adaptive_t), intent(out) :: method
        type(error_t), allocatable :: error

        call new_gauss16_adaptive(method)
        method%tolerance = tolerance
        call method%prepare(system, error)
        call assertFalse(allocated(error), "prepare")
    end subroutine ready

    subroutine exact(system, t0, t1, q, v)
        !! Sixteen steps of fixed length.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t0, t1
        real(dp), intent(inout) :: q(:), v(:)
        type(gauss_t) :: method
        type(error_t), allocatable :: error

        call new_gauss16(method)
        call method%prepare(system, error)
        call method%start(system, t0, q, v)
        call method%advance(system, t0, (t1 - t0)/16, 0_i8, 16_i8, q, v)
    end subroutine exact

    subroutine inside_steps_as_at_their_ends()
        !! Between the ends of every step the state is as accurate as at its end, and asking for
        !! it costs no evaluations.
        type(double_pendulum_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2), q_true(2), v_true(2), t, inside, tolerance
        integer(i8) :: evaluations
        integer :: i, k

        call system%configure([1.3_dp, 0.7_dp, 0.9_dp, 1.7_dp, 9.81_dp], error)
        do k = 5, 13, 4
            tolerance = 10.0_dp**(-k)
            call ready(system, tolerance, method)
            call method%start(system, 0.5_dp, [1.5_dp, 0.8_dp], [0.2_dp, -1.0_dp], 8.0_dp)
            inside = 0.0_dp
            do while (method%t_new < 8.0_dp)
                call method%step(system, error)
                call assertFalse(allocated(error), "step")
                if (anyExceptions()) return
                evaluations = method%evaluations
                do i = 1, 7
                    t = method%t_old + i/8.0_dp*(method%t_new - method%t_old)
                    call method%state_at(method%t_old, q_true, v_true)
                    call exact(system, method%t_old, t, q_true, v_true)
                    call method%state_at(t, q, v)
                    inside = max(inside, maxval(abs(q - q_true)), maxval(abs(v - v_true)/4.0_dp))
                end do
                call assertEqual(evaluations, method%evaluations, message="samples cost nothing")
            end do
            call assertLessThan(inside, 10.0_dp*tolerance, message="error inside a step")
        end do
    end subroutine inside_steps_as_at_their_ends

    subroutine states_at_the_ends()
        !! To the last bit those of the steps: one step's end is the next one's start; and the
        !! polynomial runs into them.
        type(double_pendulum_t) :: system
        type(gauss_adaptive_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2), end_q(2), end_v(2), width

        call system%configure([1.3_dp, 0.7_dp, 0.9_dp, 1.7_dp, 9.81_dp], error)
        call ready(system, 1e-9_dp, method)
        end_q = [1.5_dp, 0.8_dp]
        end_v = [0.2_dp, -1.0_dp]
        call method%start(system, 0.5_dp, end_q, end_v, 3.0_dp)
        call method%state_at(0.5_dp, q, v)
        call assertEqual([end_q, end_v], [q, v], 0.0_dp, "before any step")
        do while (method%t_new < 3.0_dp)
            call method%step(system, error)
            call method%state_at(method%t_old, q, v)
            call assertEqual([end_q, end_v], [q, v], 0.0_dp, "start of a step")
            width = 1e-7_dp*(method%t_new - method%t_old)
            call method%state_at(method%t_old + width, q, v)
            call assertEqual([end_q + width*end_v, end_v], [q, v], 1e-5_dp, "after the start")
            call assertEqual(end_q + width*end_v, q, 1e-12_dp, "after the start")
            call method%state_at(method%t_new, end_q, end_v)
            call method%state_at(method%t_new - width, q, v)
            call assertEqual(end_q - width*end_v, q, 1e-12_dp, "before the end")
        end do
        q = [1.5_dp, 0.8_dp]
        v = [0.2_dp, -1.0_dp]
        call ready(system, 1e-9_dp, method)
        call method%start(system, 0.5_dp, q, v)
        call method%advance(system, 0.5_dp, 2.5_dp, 0_i8, 1_i8, q, v)
        call assertEqual([q, v], [end_q, end_v], 0.0_dp, "steps of advance are the same")
    end subroutine states_at_the_ends

    subroutine noise_of_accelerations()
        !! What four ulp of x = 1 make of -x, root mean square: measured where the quadratures
        !! disagree, here for an acceleration at the start that is none of the step's.
        type(gauss_dense_t) :: dense
        type(oscillator_t) :: system
        type(error_t), allocatable :: error
        integer(i8) :: evaluations
        logical :: smooth

        call system%configure([1.0_dp, 1.0_dp], error)
        call dense%prepare(1)
        call dense%keep(0.0_dp, [1.0_dp], [0.0_dp])
        dense%h = 1e-20_dp
        dense%a = 0.0_dp
        dense%ends = 0.0_dp
        dense%apart = 0.0_dp
        evaluations = 7_i8
        call dense%check_smooth(system, 1e-10_dp, [1e40_dp], [0.0_dp], evaluations, smooth)
        call assertFalse(smooth, "the quadratures disagree")
        call assertEqual(7_i8 + 32_i8, evaluations, message="sixteen points, twice")
        call assertEqual(4*epsilon(1.0_dp), dense%noise(1), 1e-3_dp*epsilon(1.0_dp), "noise")
    end subroutine noise_of_accelerations

    subroutine ends_alone_cost_less()
        !! The same steps to the last bit, of every adaptive method, for fewer evaluations.
        type(double_pendulum_t) :: system
        class(dense_integrator_t), allocatable :: method
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2), end_q(2), end_v(2)
        integer(i8) :: evaluations
        integer :: i

        call system%configure([1.3_dp, 0.7_dp, 0.9_dp, 1.7_dp, 9.81_dp], error)
        do i = 1, size(adaptive_names())
            call nth_adaptive(i, method)
            call to_the_end(system, method, end_q, end_v)
            evaluations = method%evaluations
            method%dense = .false.
            call to_the_end(system, method, q, v)
            call assertEqual([end_q, end_v], [q, v], 0.0_dp, method%name)
            call assertLessThan(method%evaluations, evaluations, message=method%name)
        end do
    end subroutine ends_alone_cost_less

    subroutine to_the_end(system, method, q, v)
        !! Step by step, asking at the ends; never where the last step began.
        class(system_t), intent(in) :: system
        class(dense_integrator_t), intent(inout) :: method
        real(dp), intent(out) :: q(2), v(2)
        type(error_t), allocatable :: error
        real(dp) :: before

        call method%prepare(system, error)
        call method%start(system, 0.5_dp, [1.5_dp, 0.8_dp], [0.2_dp, -1.0_dp], 3.0_dp)
        q(1) = 1.5_dp
        do while (method%t_new < 3.0_dp)
            before = q(1)
            call method%step(system, error)
            call assertFalse(allocated(error), "step")
            if (anyExceptions()) return
            call method%state_at(method%t_new, q, v)
            call assertGreaterThan(abs(q(1) - before), 0.0_dp, message="it moved")
        end do
    end subroutine to_the_end

    subroutine catalogue_has_both()
        !! By name, and by whether steps are to be chosen.
        class(integrator_t), allocatable :: method
        class(dense_integrator_t), allocatable :: chooser
        type(error_t), allocatable :: error

        call new_integrator("gauss16", method, error)
        select type (method)
        class is (dense_integrator_t)
            call assertTrue(.false., "the fixed step is the first choice")
        end select
        call assertEqual(16, method%order, "order")
        call new_adaptive("gauss16", chooser)
        call assertTrue(allocated(chooser), "by tolerance")
        if (.not. allocated(chooser)) return
        call assertEqual(method%order, chooser%order, message="the same method")
    end subroutine catalogue_has_both
end module test_gauss_dense
