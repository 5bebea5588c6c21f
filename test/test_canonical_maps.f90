module test_canonical_maps
    !! What steps preserve where two coordinates drive each other: \(J^\top\Omega J - \Omega\) is
    !! rounding where a method declares it, though the step errs by more, and as large as that
    !! error where it does not. The same for reversal, and for Boris's volume.
    use coupled_problems, only: new_problem, problems, start
    use funit, only: assertEqual, assertFalse, assertGreaterThan, assertLessThan, TestMethod, &
                     TestSuite
    use lagrangia_dop853, only: dop853_t, new_dop853
    use lagrangia_errors, only: error_t
    use lagrangia_gauss, only: gauss_t, new_gauss16
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_method_orders, only: new_charge => new_problem, charge => problems, refuses
    use lagrangia_method_promises, only: canonical_defect, differentiate_step
    use lagrangia_methods, only: new_integrator, nth_integrator
    use lagrangia_rk4, only: new_rk4, rk4_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: canonical_maps_suite

    real(dp), parameter :: rounding = 1e-11_dp
    !! of derivatives: epsilon over the differences' step makes 2e-14, ten numbers are subtracted,
    !! and implicit equations are solved to their last digits but one

contains

    function canonical_maps_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("canonical_maps")
        call suite%addTest(TestMethod("symplectic_steps_err_but_are_canonical", &
                                      symplectic_steps_err_but_are_canonical))
        call suite%addTest(TestMethod("explicit_runge_kutta_is_not_canonical", &
                                      explicit_runge_kutta_is_not_canonical))
        call suite%addTest(TestMethod("gauss16_is_canonical_for_constant_masses", &
                                      gauss16_is_canonical_for_constant_masses))
        call suite%addTest(TestMethod("reversible_steps_err_but_are_undone", &
                                      reversible_steps_err_but_are_undone))
        call suite%addTest(TestMethod("boris_keeps_volume_but_is_not_canonical", &
                                      boris_keeps_volume_but_is_not_canonical))
    end function canonical_maps_suite

    subroutine judge(method, system, y, dt, defect, miss)
        !! Of one step: its defect, and its error beside ten steps of `gauss16`.
        class(integrator_t), intent(inout) :: method
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: y(4), dt
        real(dp), intent(out) :: defect, miss
        type(gauss_t) :: exact
        type(error_t), allocatable :: error
        real(dp), dimension(2) :: q, v, q_true, v_true

        q = y(:2)
        v = y(3:)
        q_true = q
        v_true = v
        call method%prepare(system, error)
        call assertFalse(allocated(error), "the method takes the system")
        defect = canonical_defect(method, system, 0.0_dp, q, v, dt)
        call method%start(system, 0.0_dp, q, v)
        call method%advance(system, 0.0_dp, dt, 0_i8, 1_i8, q, v)
        call new_gauss16(exact)
        call exact%prepare(system, error)
        call exact%start(system, 0.0_dp, q_true, v_true)
        call exact%advance(system, 0.0_dp, dt/10, 0_i8, 10_i8, q_true, v_true)
        miss = norm2([q - q_true, v - v_true])
    end subroutine judge

    subroutine symplectic_steps_err_but_are_canonical()
        !! Of 0.3 s, an eighth of a period.
        class(integrator_t), allocatable :: method
        class(system_t), allocatable :: system
        real(dp) :: y(4), defect, miss
        integer :: i, k, measured

        measured = 0
        i = 0
        do
            i = i + 1
            call nth_integrator(i, method)
            if (.not. allocated(method)) exit
            if (.not. method%symplectic) cycle
            do k = 1, problems
                call new_problem(k, system)
                if (refuses(method, system)) cycle
                y = start(1, 0.5_dp)
                call judge(method, system, y, 0.3_dp, defect, miss)
                call assertLessThan(defect, rounding, message=trim(method%name)//": defect")
                call assertGreaterThan(miss, 1e4_dp*epsilon(y), message=trim(method%name))
                call assertGreaterThan(miss, 100.0_dp*defect, message=trim(method%name))
                measured = measured + 1
            end do
        end do
        call assertEqual(15, measured, "methods and problems")
    end subroutine symplectic_steps_err_but_are_canonical

    subroutine explicit_runge_kutta_is_not_canonical()
        !! The defect is part of the step's error: within a factor of 20 it is as large, and goes
        !! with the next power of the step, or the one after that.
        type(rk4_t) :: rk4
        type(dop853_t) :: dop853

        call new_rk4(rk4)
        call new_dop853(dop853)
        call check_defect(rk4, 0.03_dp)
        call check_defect(dop853, 0.2_dp)
    end subroutine explicit_runge_kutta_is_not_canonical

    subroutine check_defect(method, dt)
        !! On every problem, for a step of `dt` and for one half as long.
        class(integrator_t), intent(inout) :: method
        real(dp), intent(in) :: dt
        class(system_t), allocatable :: system
        real(dp) :: y(4), defect(2), miss(2)
        integer :: i, k

        do k = 1, problems
            call new_problem(k, system)
            y = start(2, 0.3_dp)
            do i = 1, 2
                call judge(method, system, y, dt/i, defect(i), miss(i))
            end do
            call assertEqual(0.0_dp, log(defect(1)/miss(1)), log(20.0_dp), &
                             trim(method%name)//": as large as the error")
            call assertEqual(method%order + 1.5_dp, log(defect(1)/defect(2))/log(2.0_dp), 1.0_dp, &
                             trim(method%name)//": power of the step")
        end do
    end subroutine check_defect

    subroutine gauss16_is_canonical_for_constant_masses()
        !! There it is the Gauss method of \((q, p)\), which keeps every quadratic invariant. Where
        !! the masses change it is that of \((q, v)\), and not canonical: it does not declare it.
        type(gauss_t) :: method
        class(system_t), allocatable :: system
        real(dp) :: y(4), defect, miss
        integer :: k

        call new_gauss16(method)
        do k = 1, problems
            call new_problem(k, system)
            y = start(2, 0.3_dp)
            if (system%velocity_forces) then
                call judge(method, system, y, 0.8_dp, defect, miss)
                call assertEqual(0.0_dp, log(defect/miss), log(20.0_dp), "as large as the error")
                call assertGreaterThan(miss, 1e-9_dp, message="error")
            else
                call judge(method, system, y, 1.2_dp, defect, miss)
                call assertLessThan(defect, 1e-12_dp, message="defect")
                call assertGreaterThan(miss, 1e-10_dp, message="error")
            end if
        end do
    end subroutine gauss16_is_canonical_for_constant_masses

    subroutine reversible_steps_err_but_are_undone()
        !! Ten steps of 0.2 s and back.
        class(integrator_t), allocatable :: method
        type(dop853_t) :: other
        integer :: i

        call new_dop853(other)
        i = 0
        do
            i = i + 1
            call nth_integrator(i, method)
            if (.not. allocated(method)) exit
            call check_reversal(method)
        end do
        call check_reversal(other)
    end subroutine reversible_steps_err_but_are_undone

    subroutine check_reversal(method)
        !! On every problem that the method takes: to rounding if that is declared, else as wrong
        !! as the steps are.
        class(integrator_t), intent(inout) :: method
        class(system_t), allocatable :: system
        real(dp), dimension(2) :: q, v
        real(dp) :: y(4), distance
        integer :: k

        do k = 1, problems
            call new_problem(k, system)
            if (refuses(method, system)) cycle
            y = start(1, 0.5_dp)
            q = y(:2)
            v = y(3:)
            call method%start(system, 0.0_dp, q, v)
            call method%advance(system, 0.0_dp, 0.2_dp, 0_i8, 10_i8, q, v)
            call assertGreaterThan(norm2([q, v] - y), 0.5_dp, message="it moved")
            call method%start(system, 2.0_dp, q, v)
            call method%advance(system, 2.0_dp, -0.2_dp, 0_i8, 10_i8, q, v)
            distance = norm2([q, v] - y)
            if (method%reversible) then
                call assertLessThan(distance, 1e-13_dp, message=trim(method%name)//": undone")
            else
                call assertGreaterThan(distance, 1e-11_dp, message=trim(method%name)//": not")
            end if
        end do
    end subroutine check_reversal

    subroutine boris_keeps_volume_but_is_not_canonical()
        !! The determinant of the derivative of a step; that of `rk4` is not 1.
        class(integrator_t), allocatable :: method
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: jacobian(6, 6)

        call new_charge(charge, system, q, v)
        call new_integrator("boris", method, error)
        call method%prepare(system, error)
        call differentiate_step(method, system, 0.0_dp, q, v, jacobian, 0.3_dp)
        call assertEqual(1.0_dp, determinant(jacobian), rounding, "volume")
        call assertGreaterThan(canonical_defect(method, system, 0.0_dp, q, v, 0.3_dp), 1e-4_dp, &
                               message="defect")
        call new_integrator("rk4", method, error)
        call method%prepare(system, error)
        call differentiate_step(method, system, 0.0_dp, q, v, jacobian, 0.3_dp)
        call assertGreaterThan(abs(determinant(jacobian) - 1.0_dp), 1e-5_dp, message="rk4")
    end subroutine boris_keeps_volume_but_is_not_canonical

    pure function determinant(matrix) result(value)
        !! By elimination; the derivative of a short step needs no pivots.
        real(dp), intent(in) :: matrix(:, :)
        real(dp) :: value, m(size(matrix, 1), size(matrix, 1))
        integer :: i, j

        m = matrix
        value = 1.0_dp
        do i = 1, size(m, 1)
            value = value*m(i, i)
            do j = i + 1, size(m, 1)
                m(j, :) = m(j, :) - m(j, i)/m(i, i)*m(i, :)
            end do
        end do
    end function determinant
end module test_canonical_maps
