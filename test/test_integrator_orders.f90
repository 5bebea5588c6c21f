module test_integrator_orders
    !! Orders where the time enters and where there are constraints, and what the oscillator
    !! tells of two methods. Motions without either: see `test_methods`.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: new_integrator, nth_integrator
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_reference, only: reference_t
    use lagrangia_rolling_disk, only: rolling_disk_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: integrator_orders_suite

    integer, parameter :: highest = 8
    !! order that is measured: beyond, no step is short enough for the leading term to rule and
    !! long enough for rounding not to show
    real(dp), parameter :: start = 0.3_dp, duration = 5.0_dp  !! s

contains

    function integrator_orders_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("integrator_orders")
        call suite%addTest(TestMethod("orders_hold_where_the_time_enters", &
                                      orders_hold_where_the_time_enters))
        call suite%addTest(TestMethod("orders_hold_with_forces_beside_l", &
                                      orders_hold_with_forces_beside_l))
        call suite%addTest(TestMethod("orders_hold_on_a_rolling_disk", &
                                      orders_hold_on_a_rolling_disk))
        call suite%addTest(TestMethod("cuts_change_no_byte_where_the_time_enters", &
                                      cuts_change_no_byte_where_the_time_enters))
        call suite%addTest(TestMethod("a_start_forgets_all", a_start_forgets_all))
        call suite%addTest(TestMethod("rk4_shrinks_by_its_polynomial", &
                                      rk4_shrinks_by_its_polynomial))
        call suite%addTest(TestMethod("verlet_conserves_its_own_energy", &
                                      verlet_conserves_its_own_energy))
    end function integrator_orders_suite

    subroutine orders_hold_where_the_time_enters()
        !! A shaken pendulum has no closed form; the truth is another method's, of order 16, in
        !! steps whose error is rounding. An evaluation at the wrong time costs orders.
        type(driven_pendulum_t) :: system
        class(integrator_t), allocatable :: method
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)

        call system%configure([0.7_dp, 1.3_dp, 9.81_dp, 0.3_dp, 4.0_dp], error)
        call new_integrator("gauss16", method, error)
        call go(method, system, [1.0_dp], [0.4_dp], 100_i8, q, v)
        call check_orders(system, [1.0_dp], [0.4_dp], q, v, 12)
    end subroutine orders_hold_where_the_time_enters

    subroutine orders_hold_with_forces_beside_l()
        !! The oscillator, damped and driven, against its closed form: who takes velocities. Driven
        !! only: all others as well.
        call hold([0.7_dp, 9.0_dp, 0.5_dp, 1.3_dp, 2.0_dp], 3)
        call hold([0.7_dp, 6.0_dp, 0.0_dp, 1.3_dp, 4.0_dp], 12)
    contains
        subroutine hold(p, methods)
            real(dp), intent(in) :: p(:)
            integer, intent(in) :: methods
            type(oscillator_t) :: system
            class(reference_t), allocatable :: reference
            type(error_t), allocatable :: error
            real(dp) :: q(1), v(1)

            call system%configure(p, error)
            call system%closed_form(start, [1.0_dp], [0.4_dp], reference)
            call assertTrue(allocated(reference), "a closed form")
            if (.not. allocated(reference)) return
            call reference%state_at(start + duration, q, v)
            call check_orders(system, [1.0_dp], [0.4_dp], q, v, methods)
        end subroutine hold
    end subroutine orders_hold_with_forces_beside_l

    subroutine orders_hold_on_a_rolling_disk()
        !! On an incline, against the closed form: accelerations that keep the constraints.
        type(rolling_disk_t) :: system
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        real(dp), parameter :: q0(4) = [0.1_dp, -0.2_dp, 0.3_dp, 0.5_dp]
        real(dp) :: q(4), v(4), v0(4)

        call system%configure([0.7_dp, 0.4_dp, 0.05_dp, 0.03_dp, 9.81_dp, 0.3_dp], error)
        call system%complete_velocities(start, q0, [2.0_dp, 1.7_dp], v0, error)
        call system%closed_form(start, q0, v0, reference)
        call assertTrue(allocated(reference), "a closed form")
        if (.not. allocated(reference)) return
        call reference%state_at(start + duration, q, v)
        call check_orders(system, q0, v0, q, v, 1)
    end subroutine orders_hold_on_a_rolling_disk

    subroutine check_orders(system, q0, v0, q_true, v_true, methods)
        !! Every method that takes the system: the error at the end in n steps over that in 2n,
        !! n the smallest power of two whose error is small enough for the leading term to rule.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: q0(:), v0(:), q_true(:), v_true(:)
        integer, intent(in) :: methods  !! so many do
        class(integrator_t), allocatable :: method
        type(error_t), allocatable :: refusal
        real(dp) :: q(size(q0)), v(size(q0)), errors(2)
        integer(i8) :: steps
        integer :: i, k, measured

        measured = 0
        i = 0
        do
            i = i + 1
            call nth_integrator(i, method)
            if (.not. allocated(method)) exit
            if (method%order > highest) cycle
            call method%prepare(system, refusal)
            if (allocated(refusal)) cycle
            measured = measured + 1
            steps = 8
            do
                steps = 2*steps
                do k = 1, 2
                    call go(method, system, q0, v0, k*steps, q, v)
                    errors(k) = max(maxval(abs(q - q_true)), maxval(abs(v - v_true)))
                end do
                if (errors(1) < 10.0_dp**(-min(3.0_dp + method%order, 8.5_dp))) exit
                if (steps > 50000) exit
            end do
            call assertEqual(real(method%order, dp), log(errors(1)/errors(2))/log(2.0_dp), &
                             0.1_dp, trim(method%name))
        end do
        call assertEqual(methods, measured, "methods measured")
    end subroutine check_orders

    subroutine go(method, system, q0, v0, steps, q, v)
        !! From `start` over `duration`.
        class(integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: q0(:), v0(:)
        integer(i8), intent(in) :: steps
        real(dp), intent(out) :: q(:), v(:)
        type(error_t), allocatable :: error

        q = q0
        v = v0
        call method%prepare(system, error)
        call method%start(system, start, q, v)
        call method%advance(system, start, duration/steps, 0_i8, steps, q, v)
    end subroutine go

    subroutine cuts_change_no_byte_where_the_time_enters()
        !! Blocks of 1, 7 and 92 steps, with sums compensated and not.
        integer(i8), parameter :: cuts(4) = [0_i8, 1_i8, 8_i8, 100_i8]
        type(driven_pendulum_t) :: system
        class(integrator_t), allocatable :: method, plain
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), q_cut(1), v_cut(1)
        integer :: i, k, variant

        call system%configure([0.7_dp, 1.3_dp, 9.81_dp, 0.3_dp, 4.0_dp], error)
        i = 0
        do
            i = i + 1
            call nth_integrator(i, plain)
            if (.not. allocated(plain)) exit
            do variant = 1, 2
                if (variant == 1) allocate (method, source=plain)
                if (variant == 2) call plain%compensated(method)
                if (.not. allocated(method)) cycle
                call method%prepare(system, error)
                if (.not. allocated(error)) then
                    q = 2.9_dp
                    v = 0.1_dp
                    q_cut = q
                    v_cut = v
                    call method%start(system, start, q, v)
                    call method%advance(system, start, 3e-3_dp, 0_i8, 100_i8, q, v)
                    call method%prepare(system, error)
                    call method%start(system, start, q_cut, v_cut)
                    do k = 2, size(cuts)
                        call method%advance(system, start, 3e-3_dp, cuts(k - 1), &
                                            cuts(k) - cuts(k - 1), q_cut, v_cut)
                    end do
                    call assertEqual(q, q_cut, message=trim(plain%name)//": q")
                    call assertEqual(v, v_cut, message=trim(plain%name)//": v")
                end if
                deallocate (method)
            end do
            if (anyExceptions()) return
        end do
    end subroutine cuts_change_no_byte_where_the_time_enters

    subroutine a_start_forgets_all()
        !! From a state whose coordinates, velocities or time differ in the 12th digit a method that
        !! starts there goes on as one that has never been elsewhere, to the last bit.
        real(dp), parameter :: nudges(3, 3) = reshape( &
            [1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], [3, 3])
        type(driven_pendulum_t) :: system
        class(integrator_t), allocatable :: method, fresh, plain
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), q_fresh(1), v_fresh(1), t0
        integer :: i, k, variant

        call system%configure([0.7_dp, 1.3_dp, 9.81_dp, 0.3_dp, 4.0_dp], error)
        i = 0
        do
            i = i + 1
            call nth_integrator(i, plain)
            if (.not. allocated(plain)) exit
            do variant = 1, 2
                if (variant == 1) allocate (method, source=plain)
                if (variant == 2) call plain%compensated(method)
                if (.not. allocated(method)) cycle
                do k = 1, size(nudges, 2)
                    call method%prepare(system, error)
                    if (allocated(error)) cycle
                    q = 2.9_dp
                    v = 0.1_dp
                    call method%start(system, start, q, v)
                    call method%advance(system, start, 3e-3_dp, 0_i8, 50_i8, q, v)
                    q = q + 1e-12_dp*nudges(1, k)
                    v = v + 1e-12_dp*nudges(2, k)
                    t0 = start + 1e-12_dp*nudges(3, k)
                    q_fresh = q
                    v_fresh = v
                    call method%start(system, t0 + 50*3e-3_dp, q, v)
                    call method%advance(system, t0, 3e-3_dp, 50_i8, 50_i8, q, v)
                    allocate (fresh, source=method)
                    call fresh%prepare(system, error)
                    call fresh%start(system, t0 + 50*3e-3_dp, q_fresh, v_fresh)
                    call fresh%advance(system, t0, 3e-3_dp, 50_i8, 50_i8, q_fresh, v_fresh)
                    deallocate (fresh)
                    call assertEqual([q_fresh, v_fresh], [q, v], message=trim(plain%name))
                end do
                deallocate (method)
            end do
            if (anyExceptions()) return
        end do
    end subroutine a_start_forgets_all

    subroutine rk4_shrinks_by_its_polynomial()
        !! \(|R(iz)|^2 = 1 - z^6/72 + z^8/576\) a step, \(z = \omega h\), here \(\omega = 1.5\).
        type(oscillator_t) :: system
        class(integrator_t), allocatable :: method
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)
        real(dp), parameter :: z = 1.3_dp, w2 = 2.25_dp

        call system%configure([2.0_dp, 4.5_dp], error)
        call new_integrator("rk4", method, error)
        call method%prepare(system, error)
        q = 0.8_dp
        v = -0.3_dp
        call method%start(system, 0.0_dp, q, v)
        call method%advance(system, 0.0_dp, z/1.5_dp, 0_i8, 1_i8, q, v)
        call assertEqual((w2*0.8_dp**2 + 0.3_dp**2)*(1.0_dp - z**6/72.0_dp + z**8/576.0_dp), &
                         w2*q(1)**2 + v(1)**2, 20*epsilon(q), "one step")
    end subroutine rk4_shrinks_by_its_polynomial

    subroutine verlet_conserves_its_own_energy()
        !! Position form: \((1-\omega^2h^2/4)\,v^2 + \omega^2x^2\); velocity form:
        !! \(v^2 + \omega^2(1-\omega^2h^2/4)\,x^2\). 10^4 steps round, at random.
        character(*), parameter :: names(2) = [character(16) :: "verlet", "velocity_verlet"]
        type(oscillator_t) :: system
        class(integrator_t), allocatable :: method
        type(error_t), allocatable :: error
        real(dp), parameter :: h = 0.7_dp, w2 = 1.5_dp, less = 1.0_dp - 0.25_dp*w2*h**2
        real(dp), parameter :: factors(2, 2) = reshape([less, w2, 1.0_dp, w2*less], [2, 2])
        real(dp) :: q(1), v(1), before
        integer :: i

        call system%configure([2.0_dp, 3.0_dp], error)
        do i = 1, size(names)
            call new_integrator(trim(names(i)), method, error)
            call method%prepare(system, error)
            q = 0.4_dp
            v = 0.9_dp
            before = factors(1, i)*v(1)**2 + factors(2, i)*q(1)**2
            call method%start(system, 0.0_dp, q, v)
            call method%advance(system, 0.0_dp, h, 0_i8, 10000_i8, q, v)
            call assertEqual(before, factors(1, i)*v(1)**2 + factors(2, i)*q(1)**2, 1e-12_dp, &
                             names(i))
        end do
    end subroutine verlet_conserves_its_own_energy
end module test_integrator_orders
