module test_dop853_steps
    !! How `dop853` chooses its steps, and what it does where none is small enough.
    use funit, only: anyExceptions, assertEqual, assertFalse, assertGreaterThan, &
                     assertLessThanOrEqual, assertTrue, TestMethod, TestSuite
    use lagrangia_cart_pendulum, only: cart_pendulum_t
    use lagrangia_dop853, only: dop853_t, new_dop853
    use lagrangia_dop853_stages, only: scaled_error, slope, stages
    use lagrangia_errors, only: error_t, status_numbers
    use lagrangia_kinds, only: dp, i8
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_reference, only: reference_t
    use lagrangia_rotating_wire, only: rotating_wire_t
    implicit none (type, external)
    private
    public :: dop853_steps_suite

    real(dp), parameter :: q0(1) = [1.0_dp], v0(1) = [-0.7_dp]

contains

    function dop853_steps_suite() result(suite)
        type(TestSuite) :: suite

        suite = TestSuite("dop853_steps")
        call suite%addTest(TestMethod("the first steps are the book's", first_steps))
        call suite%addTest(TestMethod("steps settle where the control says", steps_settle))
        call suite%addTest(TestMethod("steps meet, and end at the end", steps_meet))
        call suite%addTest(TestMethod("the end is hit to the last bit", end_is_hit))
        call suite%addTest(TestMethod("a first step that is too long is taken back", &
                                      long_first_step))
        call suite%addTest(TestMethod("where no step is small enough, it says so", singular))
        call suite%addTest(TestMethod("it stands still where all is at rest", rest))
    end function dop853_steps_suite

    subroutine set_up(system, reference, method)
        type(pendulum_t), intent(out) :: system
        class(reference_t), allocatable, intent(out) :: reference
        type(dop853_t), intent(out) :: method
        type(error_t), allocatable :: error

        call system%configure([0.7_dp, 1.3_dp, 9.81_dp], error)
        call system%closed_form(0.0_dp, q0, v0, reference)
        call new_dop853(method)
        call method%prepare(system, error)
        call assertFalse(allocated(error), "prepare")
    end subroutine set_up

    subroutine first_steps()
        !! Hairer, Norsett & Wanner, sec. II.4, on the oscillator from rest: \(d_0\), \(d_1\) and
        !! \(d_2\) are all \(0.9/\sqrt2\) in tolerances, so that \(h_0 = 0.01\) and
        !! \(h_1 = (0.01/d_2)^{1/8}\), 100 \(h_0\) at most; then the control, whose first error is
        !! taken to be 1e-4.
        type(oscillator_t) :: system
        type(dop853_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: y0(2), y(2), k(2, 17), h, e, before
        integer :: i

        call system%configure([1.0_dp, 1.0_dp], error)
        call new_dop853(method)
        method%tolerance = 100.0_dp
        call method%prepare(system, error)
        call method%start(system, 0.0_dp, [0.9_dp], [0.0_dp], 10.0_dp)
        call method%step(system, error)
        call assertEqual(1.0_dp, method%t_new, 1e-14_dp, "100 h0")
        method%tolerance = 1e-9_dp
        call method%prepare(system, error)
        y = [0.9_dp, 0.0_dp]
        call method%start(system, 0.0_dp, y(:1), y(2:), 10.0_dp)
        h = (0.01e-9_dp*sqrt(2.0_dp)/0.9_dp)**0.125_dp
        before = 1e-4_dp
        do i = 1, 4
            call method%step(system, error)
            call assertEqual(h, method%t_new - method%t_old, 1e-8_dp*h, "step")
            h = method%t_new - method%t_old
            y0 = y
            call slope(system, 1, 0.0_dp, y0, k(:, 1))
            call stages(system, 1, 0.0_dp, h, y0, k, y)
            e = scaled_error(h, 1e-9_dp, k, y0, y)
            h = h/max(1.0_dp/6.0_dp, e**(0.125_dp - 0.008_dp)/(0.9_dp*before**0.04_dp))
            before = max(e, 1e-4_dp)
        end do
    end subroutine first_steps

    subroutine steps_settle()
        !! On the oscillator \(x^2 + \dot x^2\) and with it the estimate are the same in every step,
        !! so the step settles where \(e^{\alpha}/(0.9\,e^{\beta}) = 1\), with
        !! \(\alpha = 1/8 - \beta/5\), \(\beta = 0.04\): at the estimate
        !! \(e = 0.9^{1/(1/8 - 6\beta/5)}\).
        type(oscillator_t) :: system
        type(dop853_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: y0(2), y(2), k(2, 17), h

        call system%configure([1.0_dp, 1.0_dp], error)
        call new_dop853(method)
        call method%prepare(system, error)
        method%tolerance = 1e-9_dp
        call method%start(system, 0.0_dp, [0.9_dp], [0.0_dp], 100.0_dp)
        do while (method%t_new < 80.0_dp)
            call method%step(system, error)
        end do
        h = method%t_new - method%t_old
        y0 = [0.9_dp, 0.0_dp]
        call slope(system, 1, 0.0_dp, y0, k(:, 1))
        call stages(system, 1, 0.0_dp, h, y0, k, y)
        call assertEqual(0.9_dp**(1.0_dp/(0.125_dp - 0.048_dp)), &
                         scaled_error(h, 1e-9_dp, k, y0, y), 0.003_dp, "estimate")
    end subroutine steps_settle

    subroutine steps_meet()
        type(pendulum_t) :: system
        class(reference_t), allocatable :: reference
        type(dop853_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), q_before(1), v_before(1), t_before

        call set_up(system, reference, method)
        call method%start(system, 1.0_dp, q0, v0, 3.7_dp)
        q_before = q0
        v_before = v0
        do while (method%t_new < 3.7_dp)
            t_before = method%t_new
            call method%step(system, error)
            if (anyExceptions()) return
            call assertEqual(t_before, method%t_old, message="t_old")
            call method%state_at(method%t_old, q, v)
            call assertEqual([q_before, v_before], [q, v], message="at t_old")
            call method%state_at(method%t_new, q_before, v_before)
            call method%state_at(method%t_new*(1 - epsilon(1.0_dp)), q, v)
            call assertEqual([q_before, v_before], [q, v], 1e-13_dp, message="before t_new")
        end do
        call assertEqual(3.7_dp, method%t_new, message="the end")
    end subroutine steps_meet

    subroutine end_is_hit()
        !! At rest each step is six times as long as the one before: the last one starts where its
        !! length, added to that time, may miss the end by rounding.
        type(pendulum_t) :: system
        class(reference_t), allocatable :: reference
        type(dop853_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: t_end
        integer :: i

        call set_up(system, reference, method)
        do i = 1, 200
            t_end = 0.1_dp + 0.0137_dp*i
            call method%start(system, 0.0_dp, [0.0_dp], [0.0_dp], t_end)
            do while (method%t_new < t_end)
                call method%step(system, error)
                if (allocated(error)) exit
            end do
            call assertEqual(t_end, method%t_new, message="the end")
        end do
    end subroutine end_is_hit

    subroutine long_first_step()
        !! From rest at the top but for a hair: nothing moves at first, and then much does.
        type(pendulum_t) :: system
        class(reference_t), allocatable :: reference
        type(dop853_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), start(1), zero(1), q_true(1), v_true(1)

        call set_up(system, reference, method)
        start = acos(-1.0_dp) - 1e-6_dp
        zero = 0.0_dp
        call system%closed_form(0.0_dp, start, zero, reference)
        method%tolerance = 1e-12_dp
        call method%start(system, 0.0_dp, start, zero, 10.0_dp)
        do while (method%t_new < 10.0_dp)
            call method%step(system, error)
        end do
        call assertGreaterThan(method%rejected, 0_i8, message="rejected")
        call method%state_at(10.0_dp, q, v)
        call reference%state_at(10.0_dp, q_true, v_true)
        call assertEqual(q_true, q, 1e-6_dp, "q")
    end subroutine long_first_step

    subroutine singular()
        !! A rotating wire's bead leaves as exp(omega t): it overflows at omega t = 710.
        type(rotating_wire_t) :: system
        type(dop853_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), q_before(1), v_before(1)

        call system%configure([1.0_dp, 10.0_dp], error)
        call new_dop853(method)
        call method%prepare(system, error)
        call method%start(system, 0.0_dp, [1.0_dp], [0.0_dp], 100.0_dp)
        do while (method%t_new < 100.0_dp)
            call method%state_at(method%t_new, q_before, v_before)
            call method%step(system, error)
            if (allocated(error)) exit
        end do
        call assertTrue(allocated(error), "fails")
        if (anyExceptions()) return
        call assertEqual(status_numbers, error%status, message="status")
        call assertEqual(1, index(error%message, "no step is small enough at t = 7"), &
                         message=error%message)
        call assertLessThanOrEqual(method%t_new, 71.1_dp, message="it stands")
        call method%state_at(method%t_new, q, v)
        call assertEqual([q_before, v_before], [q, v], message="the state before")
        call assertEqual(log(q(1)), 10*method%t_new - log(2.0_dp), 1e-6_dp, "where it stood")
    end subroutine singular

    subroutine rest()
        type(cart_pendulum_t) :: system
        type(dop853_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2), before

        call system%configure([1.0_dp, 1.0_dp, 1.0_dp, 9.81_dp], error)
        call new_dop853(method)
        call method%prepare(system, error)
        call method%start(system, 0.0_dp, [0.0_dp, 0.0_dp], [0.0_dp, 0.0_dp], 100.0_dp)
        before = 0.0_dp
        do while (method%t_new < 100.0_dp)
            call method%step(system, error)
            if (method%t_old <= 0.0_dp) call assertEqual(1e-6_dp, method%t_new, 1e-20_dp, "first")
            if (method%t_new < 100.0_dp .and. before > 0.0_dp) then
                call assertEqual(6.0_dp*before, method%t_new - method%t_old, 1e-12_dp, "six times")
            end if
            before = method%t_new - method%t_old
        end do
        call method%state_at(100.0_dp, q, v)
        call assertEqual([0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], [q, v], message="state")
        call assertEqual(12_i8, method%accepted, message="(6**12 - 1)/5 microseconds are 435 s")
    end subroutine rest
end module test_dop853_steps
