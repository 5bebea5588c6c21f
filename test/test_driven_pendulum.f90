module test_driven_pendulum
    !! The pendulum on a shaken pivot: sign of the drive, equilibria, Kapitza's upright state.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertGreaterThan, &
                     assertLessThan, assertTrue
    use lagrangia_driven_pendulum, only: driven_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_reference, only: reference_t
    use lagrangia_rk4, only: new_rk4, rk4_t
    use lagrangia_system, only: system_t
    use random_states, only: restart_random
    use reference_checks, only: check_reference, check_state
    implicit none (type, external)
    private
    public :: driven_pendulum_suite

    real(dp), parameter :: pi = acos(-1.0_dp)

contains

    function driven_pendulum_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("driven_pendulum")
        call suite%addTest(TestMethod("driven_pendulum_stands_up_and_down", &
                                      driven_pendulum_stands_up_and_down, setUp=restart_random))
        call suite%addTest(TestMethod("pivot_starts_high_and_moves_down", &
                                      pivot_starts_high_and_moves_down))
        call suite%addTest(TestMethod("resting_pivot_is_a_pendulum", resting_pivot_is_a_pendulum))
        call suite%addTest(TestMethod("fast_drive_keeps_it_upright", fast_drive_keeps_it_upright))
    end function driven_pendulum_suite

    subroutine set(system, values)
        !! Configure.
        class(system_t), intent(inout) :: system
        real(dp), intent(in) :: values(:)
        type(error_t), allocatable :: error

        call system%configure(values, error)
        call assertFalse(allocated(error), "parameters")
    end subroutine set

    subroutine driven_pendulum_stands_up_and_down()
        !! Whatever the drive; nowhere else, and not in motion.
        type(driven_pendulum_t) :: pendulum
        class(reference_t), allocatable :: reference
        real(dp), parameter :: angles(4) = [0.0_dp, pi, -3.0_dp*pi, 0.5_dp*pi]
        integer :: i

        call set(pendulum, [1.3_dp, 0.7_dp, 9.81_dp, 0.2_dp, 3.0_dp])
        do i = 1, 4
            call pendulum%closed_form(1.0_dp, angles(i:i), [0.0_dp], reference)
            call assertTrue(allocated(reference) .eqv. i < 4, "equilibrium?")
            if (.not. allocated(reference)) cycle
            call check_state(reference, -9.0_dp, angles(i:i), [0.0_dp], 0.0_dp, "stands")
            call check_reference(reference, pendulum, 1.0_dp, angles(i:i), [0.0_dp], "stands")
            call pendulum%closed_form(1.0_dp, angles(i:i), [1e-9_dp], reference)
            call assertFalse(allocated(reference), "it moves")
        end do
    end subroutine driven_pendulum_stands_up_and_down

    subroutine pivot_starts_high_and_moves_down()
        !! The sign convention: at t = 0 the pivot is at +a and its acceleration -a W^2 takes
        !! gravity away from the bob; half a period later it adds.
        type(driven_pendulum_t) :: pendulum
        real(dp) :: a(1)

        call set(pendulum, [1.3_dp, 0.7_dp, 9.81_dp, 0.2_dp, 3.0_dp])
        call pendulum%accelerations(0.0_dp, [0.5_dp*pi], [0.0_dp], a)
        call assertEqual(-(9.81_dp - 1.8_dp)/0.7_dp, a(1), 1e-14_dp)
        call pendulum%accelerations(pi/3.0_dp, [0.5_dp*pi], [0.0_dp], a)
        call assertEqual(-(9.81_dp + 1.8_dp)/0.7_dp, a(1), 1e-14_dp)
        call assertEqual(0.2_dp, pendulum%quantity(5, 0.0_dp, [0.1_dp], [0.0_dp]))
        call assertLessThan(pendulum%quantity(5, 0.1_dp, [0.1_dp], [0.0_dp]), 0.2_dp)
    end subroutine pivot_starts_high_and_moves_down

    subroutine resting_pivot_is_a_pendulum()
        !! With no amplitude, or no frequency.
        type(driven_pendulum_t) :: driven
        type(pendulum_t) :: plain
        real(dp) :: a(1), b(1)
        integer :: i

        call set(plain, [1.3_dp, 0.7_dp, 9.81_dp])
        do i = 0, 1
            call set(driven, [1.3_dp, 0.7_dp, 9.81_dp, 0.2_dp*i, 3.0_dp*(1 - i)])
            call driven%accelerations(0.4_dp, [0.9_dp], [0.3_dp], a)
            call plain%accelerations(0.4_dp, [0.9_dp], [0.3_dp], b)
            call assertEqual(b(1), a(1), 4e-15_dp)
            call assertEqual(plain%energy(0.4_dp, [0.9_dp], [0.3_dp]) + 1.3_dp*9.81_dp*0.2_dp*i, &
                             driven%energy(0.4_dp, [0.9_dp], [0.3_dp]), 4e-15_dp)
        end do
    end subroutine resting_pivot_is_a_pendulum

    subroutine fast_drive_keeps_it_upright()
        !! Kapitza: upside down it stays for (a W)^2 > 2 g l, and falls below; his averaged energy
        !! is constant to a tenth of a/l, while T + V is not.
        real(dp) :: largest, slow, mechanical

        call swing(0.05_dp, 120.0_dp, largest, slow, mechanical)
        call assertLessThan(largest, 0.3_dp, message="stays upright")
        call assertLessThan(slow, 0.005_dp, message="averaged energy")
        call assertGreaterThan(mechanical, 1.0_dp, message="T + V")
        call swing(0.005_dp, 1200.0_dp, largest, slow, mechanical)
        call assertLessThan(slow, 0.0005_dp, message="averaged energy")
        call swing(0.05_dp, 70.0_dp, largest, slow, mechanical)
        call assertGreaterThan(largest, 1.5_dp, message="falls")
    end subroutine fast_drive_keeps_it_upright

    subroutine swing(a, w, largest, slow, mechanical)
        !! 4 s from 0.2 rad off the top, l = 1, by 40000 steps: the largest angle from the top,
        !! and the spread of both energies in units of m g l.
        real(dp), intent(in) :: a, w
        real(dp), intent(out) :: largest, slow, mechanical
        type(driven_pendulum_t) :: pendulum
        type(rk4_t) :: rk4
        type(error_t), allocatable :: error
        real(dp), allocatable :: energies(:, :)
        real(dp) :: q(1), v(1), t
        integer :: k

        allocate (energies(2, 0:10000))
        call set(pendulum, [1.3_dp, 1.0_dp, 9.81_dp, a, w])
        call new_rk4(rk4)
        call rk4%prepare(pendulum, error)
        q = pi - 0.2_dp
        v = 0.0_dp
        largest = 0.2_dp
        call rk4%start(pendulum, 0.0_dp, q, v)
        do k = 0, 10000
            t = k*4e-4_dp
            largest = max(largest, abs(q(1) - pi))
            energies(:, k) = [pendulum%quantity(3, t, q, v), pendulum%quantity(1, t, q, v)]
            call rk4%advance(pendulum, 0.0_dp, 1e-4_dp, int(4*k, i8), 4_i8, q, v)
        end do
        slow = (maxval(energies(1, :)) - minval(energies(1, :)))/(1.3_dp*9.81_dp)
        mechanical = (maxval(energies(2, :)) - minval(energies(2, :)))/(1.3_dp*9.81_dp)
    end subroutine swing
end module test_driven_pendulum
