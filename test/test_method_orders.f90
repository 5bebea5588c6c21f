module test_method_orders
    !! The measured order of every method, from both sides, and who refuses what.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: new_integrator, new_reference, new_system, nth_integrator
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: dense_integrator_t, integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: method_orders_suite

contains

    function method_orders_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("method_orders")
        call suite%addTest(TestMethod("on_the_pendulum", on_the_pendulum))
        call suite%addTest(TestMethod("on_the_cart_pendulum", on_the_cart_pendulum))
        call suite%addTest(TestMethod("on_a_driven_pendulum", on_a_driven_pendulum))
        call suite%addTest(TestMethod("verlet_refuses_velocity_forces", &
                                      verlet_refuses_velocity_forces))
    end function method_orders_suite

    subroutine on_the_pendulum()
        !! Nonlinear, forces of positions only: against Jacobi's functions.
        call check_orders("pendulum", [0.7_dp, 1.3_dp, 9.81_dp], [2.0_dp], [0.5_dp])
    end subroutine on_the_pendulum

    subroutine on_the_cart_pendulum()
        !! Nonlinear, forces of velocities too: against the quadrature.
        call check_orders("cart_pendulum", [2.0_dp, 0.7_dp, 1.3_dp, 9.81_dp], [0.1_dp, 1.5_dp], &
                          [0.0_dp, 0.0_dp])
    end subroutine on_the_cart_pendulum

    subroutine on_a_driven_pendulum()
        !! The time enters: against the same method in steps ten times shorter.
        call check_orders("driven_pendulum", [0.7_dp, 1.3_dp, 9.81_dp, 0.3_dp, 4.0_dp], [1.0_dp], &
                          [0.0_dp])
    end subroutine on_a_driven_pendulum

    subroutine check_orders(name, values, q0, v0)
        !! Halving the step divides the error by \(2^p\): \(p\) within 0.1. Only methods of order
        !! up to 4 are measured so; where a higher order still shows, rounding does too.
        character(*), intent(in) :: name
        real(dp), intent(in) :: values(:), q0(:), v0(:)
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: integrator
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        real(dp) :: errors(2), truth(size(q0)), v_truth(size(q0)), order
        integer :: i, k, steps

        call new_system(name, system, error)
        call system%configure(values, error)
        call new_reference(system, 0.0_dp, q0, v0, reference)
        i = 0
        do
            i = i + 1
            call nth_integrator(i, integrator)
            if (.not. allocated(integrator)) exit
            if (integrator%order > 4) cycle
            select type (integrator)
            class is (dense_integrator_t); cycle
            class default
            end select
            call integrator%prepare(system, error)
            if (allocated(error)) cycle
            steps = merge(400, 4000, integrator%order > 2)
            if (allocated(reference)) then
                call reference%state_at(2.0_dp, truth, v_truth)
            else
                call final(20*steps, truth)
            end if
            do k = 1, 2
                call final(k*steps, v_truth)
                errors(k) = maxval(abs(v_truth - truth))
            end do
            order = log(errors(1)/errors(2))/log(2.0_dp)
            call assertEqual(real(integrator%order, dp), order, 0.1_dp, &
                             trim(integrator%name)//" on "//name)
        end do
        call assertTrue(i > 2, message="there are methods")
    contains
        subroutine final(n, q)
            integer, intent(in) :: n
            real(dp), intent(out) :: q(:)
            real(dp) :: v(size(q))

            q = q0
            v = v0
            call integrator%prepare(system, error)
            call integrator%advance(system, 0.0_dp, 2.0_dp/n, 0_i8, int(n, i8), q, v)
        end subroutine final
    end subroutine check_orders

    subroutine verlet_refuses_velocity_forces()
        !! And names a method that works, which then does.
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: integrator
        type(error_t), allocatable :: error

        call new_system("double_pendulum", system, error)
        call new_integrator("verlet", integrator, error)
        call integrator%prepare(system, error)
        call assertTrue(allocated(error))
        if (.not. allocated(error)) return
        call assertTrue(index(error%message, "depend on velocities") > 0, message=error%message)
        call assertTrue(index(error%message, "rk4") > 0, message=error%message)
        call new_integrator("rk4", integrator, error)
        call integrator%prepare(system, error)
        call assertFalse(allocated(error))
    end subroutine verlet_refuses_velocity_forces
end module test_method_orders
