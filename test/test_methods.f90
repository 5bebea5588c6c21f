module test_methods
    !! Walks over the methods: each is what it declares to be. A new one is tested the day it is
    !! listed, on every problem below that it takes.
    use funit, only: TestMethod, TestSuite, assertEqual, assertGreaterThan, assertLessThan, &
                     assertTrue
    use lagrangia_catalogue, only: new_system
    use lagrangia_description, only: name_length
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_ledger, only: ledger_t
    use lagrangia_method_orders, only: audit_methods, method_run, new_problem, problems, refuses
    use lagrangia_methods, only: method_names, new_integrator, nth_integrator
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: methods_suite

contains

    function methods_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("methods")
        call suite%addTest(TestMethod("orders_are_as_declared", orders_are_as_declared))
        call suite%addTest(TestMethod("energy_stays_where_declared", energy_stays_where_declared))
        call suite%addTest(TestMethod("cuts_change_no_byte", cuts_change_no_byte))
        call suite%addTest(TestMethod("carried_forces_belong_to_their_time", &
                                      carried_forces_belong_to_their_time))
        call suite%addTest(TestMethod("stability_ends_where_it_must", stability_ends_where_it_must))
    end function methods_suite

    subroutine orders_are_as_declared()
        !! On every problem that a method takes; and every method takes one.
        character(name_length), allocatable :: names(:)
        type(ledger_t) :: audit
        integer :: i

        call audit_methods(audit)
        do i = 1, size(audit%rows)
            associate (row => audit%rows(i))
                call assertTrue(row%holds, trim(row%name)//": "//row%remark)
            end associate
        end do
        allocate (names, source=method_names())
        do i = 1, size(names)
            call assertTrue(any(index(audit%rows%name, trim(names(i))//": order") == 1), &
                            trim(names(i))//": problems taken")
        end do
    end subroutine orders_are_as_declared

    subroutine energy_stays_where_declared()
        !! In a run ten times as long the energy swings no farther; elsewhere it drifts.
        class(integrator_t), allocatable :: method
        class(system_t), allocatable :: system
        real(dp), allocatable :: q(:), v(:)
        character(:), allocatable :: name
        real(dp), parameter :: rounding = 1e-13_dp  !! a random walk of 2000 steps, with room
        real(dp) :: error, swing(2)
        integer :: i, k

        do i = 1, size(method_names())
            do k = 1, problems
                call nth_integrator(i, method)
                call new_problem(k, system, q, v)
                if (refuses(method, system)) cycle
                name = trim(method%name)//describe(k)
                call method_run(method, system, q, v, 200_i8, error, swing(1), 20.0_dp)
                call method_run(method, system, q, v, 2000_i8, error, swing(2), 200.0_dp)
                if (method%energy_order > 0) then
                    call assertLessThan(swing(2), 1.2_dp*swing(1) + rounding, &
                                        message=name//": energy stays")
                else
                    call assertGreaterThan(swing(2), 2.0_dp*swing(1), &
                                           message=name//": energy drifts")
                end if
            end do
        end do
    end subroutine energy_stays_where_declared

    function describe(k) result(text)
        !! Which problem.
        integer, intent(in) :: k
        character(:), allocatable :: text
        character, parameter :: digits(9) = ["1", "2", "3", "4", "5", "6", "7", "8", "9"]

        text = ", problem "//digits(k)
    end function describe

    subroutine cuts_change_no_byte()
        !! Nor does it count more evaluations, with compensated sums or without.
        class(integrator_t), allocatable :: method, variant
        class(system_t), allocatable :: system
        real(dp), allocatable :: q(:), v(:)
        integer :: i, k

        do i = 1, size(method_names())
            do k = 1, problems
                call nth_integrator(i, method)
                call new_problem(k, system, q, v)
                if (refuses(method, system)) cycle
                call cut(method, system, q, v)
                call method%compensated(variant)
                if (.not. allocated(variant)) cycle
                call assertEqual(method%name, variant%name, message="name of the variant")
                call cut(variant, system, q, v)
            end do
        end do
    end subroutine cuts_change_no_byte

    subroutine cut(method, system, q0, v0)
        !! 300 steps at once, and in pieces; a second run like the first.
        class(integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: q0(:), v0(:)
        integer(i8), parameter :: pieces(5) = [0_i8, 1_i8, 2_i8, 100_i8, 300_i8]
        real(dp), dimension(size(q0)) :: q, v, q_cut, v_cut
        integer(i8) :: evaluations
        integer :: i, repetition

        if (refuses(method, system)) return
        q = q0
        v = v0
        call method%start(system, 0.3_dp, q, v)
        call method%advance(system, 0.3_dp, 0.01_dp, 0_i8, 300_i8, q, v)
        evaluations = method%evaluations
        call assertGreaterThan(evaluations, 0_i8, message=trim(method%name)//": evaluations")
        do repetition = 1, 2
            if (refuses(method, system)) return
            q_cut = q0
            v_cut = v0
            call method%start(system, 0.3_dp, q_cut, v_cut)
            do i = 2, size(pieces)
                call method%advance(system, 0.3_dp, 0.01_dp, pieces(i - 1), &
                                    pieces(i) - pieces(i - 1), q_cut, v_cut)
            end do
            call assertEqual(q, q_cut, message=trim(method%name)//": q of a run that was cut")
            call assertEqual(v, v_cut, message=trim(method%name)//": v of a run that was cut")
            call assertTrue(evaluations == method%evaluations, trim(method%name)//": evaluations")
        end do
    end subroutine cut

    subroutine carried_forces_belong_to_their_time()
        !! The same place at another time is another force.
        class(integrator_t), allocatable :: method, fresh
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp), dimension(1) :: q, v, q_fresh, v_fresh

        call new_system("driven_pendulum", system, error)
        call new_integrator("velocity_verlet", method, error)
        call new_integrator("velocity_verlet", fresh, error)
        call method%prepare(system, error)
        call fresh%prepare(system, error)
        q = 1.0_dp
        v = 0.5_dp
        call method%start(system, 0.0_dp, q, v)
        call method%advance(system, 0.0_dp, 0.01_dp, 0_i8, 10_i8, q, v)
        q_fresh = q
        v_fresh = v
        call method%start(system, 0.7_dp, q, v)
        call method%advance(system, 0.7_dp, 0.01_dp, 0_i8, 10_i8, q, v)
        call fresh%start(system, 0.7_dp, q_fresh, v_fresh)
        call fresh%advance(system, 0.7_dp, 0.01_dp, 0_i8, 10_i8, q_fresh, v_fresh)
        call assertEqual(q_fresh, q, message="q")
        call assertEqual(v_fresh, v, message="v")
    end subroutine carried_forces_belong_to_their_time

    subroutine stability_ends_where_it_must()
        !! On the oscillator, in 2000 steps: Verlet at 2, Runge-Kutta at the square root of 8.
        call check_limit("verlet", 2.0_dp)
        call check_limit("velocity_verlet", 2.0_dp)
        call check_limit("stormer_verlet", 2.0_dp)
        call check_limit("rk4", sqrt(8.0_dp))
    end subroutine stability_ends_where_it_must

    subroutine check_limit(name, limit)
        !! The method `name` stays bounded up to \(\omega h =\) `limit`, and not beyond.
        character(*), intent(in) :: name
        real(dp), intent(in) :: limit
        class(integrator_t), allocatable :: method
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)
        integer :: k

        call new_integrator(name, method, error)
        call new_system("oscillator", system, error)
        call system%configure([2.0_dp, 4.5_dp], error)  ! omega = 1.5
        do k = -1, 1, 2
            q = 1.0_dp
            v = 0.0_dp
            call method%prepare(system, error)
            call method%start(system, 0.0_dp, q, v)
            call method%advance(system, 0.0_dp, (1.0_dp + 0.01_dp*k)*limit/1.5_dp, 0_i8, 2000_i8, &
                                q, v)
            if (k < 0) then
                call assertLessThan(abs(q(1)), 100.0_dp, message=name//": stable")
            else
                call assertGreaterThan(abs(q(1)), 1e10_dp, message=name//": unstable")
            end if
        end do
    end subroutine check_limit
end module test_methods
