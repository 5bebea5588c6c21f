module test_amplitude
    !! From linear to nonlinear: what the small-angle equations drop, and what it does.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertRelativelyEqual, assertTrue
    use lagrangia_catalogue, only: new_system
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: new_integrator
    use lagrangia_observer, only: observer_box_t
    use lagrangia_period, only: period_t
    use lagrangia_reference, only: reference_t
    use lagrangia_run, only: run
    use lagrangia_small_oscillations, only: find_modes, modes_t
    use lagrangia_system, only: system_t
    use lagrangia_time_grid, only: new_time_grid, time_grid_t
    implicit none (type, external)
    private
    public :: amplitude_suite

    real(dp), parameter :: pi = acos(-1.0_dp)
    real(dp), parameter :: m1 = 2.0_dp, m2 = 0.5_dp, l = 1.3_dp, g = 9.81_dp

contains

    function amplitude_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("amplitude")
        call suite%addTest(TestMethod("real_motion_has_the_exact_period", &
                                      real_motion_has_the_exact_period))
        call suite%addTest(TestMethod("period_grows_with_the_square", &
                                      period_grows_with_the_square))
        call suite%addTest(TestMethod("dropped_term_is_of_third_order", &
                                      dropped_term_is_of_third_order))
        call suite%addTest(TestMethod("small_period_is_that_of_the_mode", &
                                      small_period_is_that_of_the_mode))
    end function amplitude_suite

    subroutine swing(name, values, amplitude, period, exact, slow)
        !! Let it swing from rest, six periods of 10000 steps, and measure.
        character(*), intent(in) :: name
        real(dp), intent(in) :: values(:), amplitude
        real(dp), intent(out) :: period, exact  !! measured; the period integral
        real(dp), intent(out) :: slow           !! of the mode that LAPACK finds
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: integrator
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        type(period_t), target :: watch
        type(observer_box_t) :: observers(1)
        type(time_grid_t) :: plan
        type(modes_t) :: modes
        real(dp), allocatable :: q(:), v(:)

        period = 0.0_dp
        call new_system(name, system, error)
        call system%configure(values, error)
        allocate (q(system%ndof), v(system%ndof), source=0.0_dp)
        call find_modes(system, q, .true., modes, error)
        call assertFalse(allocated(error), name)
        slow = 2.0_dp*pi/sqrt(modes%omega2(system%ndof))
        q(system%ndof) = amplitude
        call system%closed_form(0.0_dp, q, v, reference)
        exact = reference%period
        call new_integrator("rk4", integrator, error)
        call new_time_grid(plan, 0.0_dp, exact/10000, 6*exact, 50_i8, error)
        watch%coordinate = system%ndof
        observers(1)%item => watch
        call run(system, integrator, plan, observers, q, v, error)
        call assertFalse(allocated(error), name//" runs")
        period = watch%period()
    end subroutine swing

    subroutine real_motion_has_the_exact_period()
        !! From 0.01 to 3 rad. rk4's error is (omega h)^4/120 of the period, 1e-15 at 10000 steps,
        !! with the fastest rate of the swing for omega: seven times that of small oscillations
        !! at 3 rad. The turning time is that of a quintic: (2 pi/200)^5/720 in the phase, of 5
        !! periods, and nearly the same at each turn.
        real(dp), parameter :: amplitudes(*) = [0.01_dp, 0.03_dp, 0.1_dp, 0.3_dp, 1.0_dp, 2.0_dp, &
                                                3.0_dp]
        real(dp) :: period, exact, slow
        integer :: i

        do i = 1, size(amplitudes)
            call swing("cart_pendulum", [m1, m2, l, g], amplitudes(i), period, exact, slow)
            call assertRelativelyEqual(exact, period, 1e-11_dp, "cart-pendulum")
            call swing("pendulum", [m2, l, g], amplitudes(i), period, exact, slow)
            call assertRelativelyEqual(exact, period, 1e-11_dp, "pendulum")
        end do
        ! another source: 22-digit arithmetic
        call swing("cart_pendulum", [1.0_dp, 0.5_dp, 1.0_dp, g], 3.0_dp, period, exact, slow)
        call assertRelativelyEqual(4.540468197839614604_dp, period, 1e-11_dp, "T(3 rad)")
        call swing("cart_pendulum", [1.0_dp, 0.5_dp, 1.0_dp, g], 0.01_dp, period, exact, slow)
        call assertRelativelyEqual(1.6379772969159153746_dp, period, 1e-11_dp, "T(0.01 rad)")
    end subroutine real_motion_has_the_exact_period

    subroutine period_grows_with_the_square()
        !! \(T/T_0 = 1 + c_2A^2 + c_4A^4 + O(A^6)\), \(T_0\) from LAPACK and T of the real motion:
        !! \(c_2 = (m_1+4m_2)/(16m_1)\), \(c_4 = (11-158\mu+3\mu^2)/(3072(1-\mu)^2)\) with
        !! \(\mu = m_2/(m_1+m_2)\); the pendulum is \(\mu = 0\).
        real(dp), parameter :: mu = m2/(m1 + m2)
        real(dp), parameter :: c2 = (m1 + 4*m2)/(16*m1)
        real(dp), parameter :: c4 = (11 - 158*mu + 3*mu**2)/(3072*(1 - mu)**2)
        real(dp), parameter :: amplitudes(*) = [0.02_dp, 0.1_dp, 0.2_dp]
        real(dp) :: period, exact, slow, a
        integer :: i

        do i = 1, size(amplitudes)
            a = amplitudes(i)
            call swing("cart_pendulum", [m1, m2, l, g], a, period, exact, slow)
            call assertEqual(c2, (period/slow - 1)/a**2, 0.05_dp*a**2 + 1e-11_dp/a**2, "c2")
            if (i > 1) call assertEqual(c4, (period/slow - 1 - c2*a**2)/a**4, &
                                        0.05_dp*a**2 + 1e-11_dp/a**4, "c4")
            call swing("pendulum", [m2, l, g], a, period, exact, slow)
            call assertEqual(1.0_dp/16, (period/slow - 1)/a**2, &
                             0.05_dp*a**2 + 1e-11_dp/a**2, "c2 of the pendulum")
        end do
    end subroutine period_grows_with_the_square

    subroutine dropped_term_is_of_third_order()
        !! Accelerations less those of \(M\ddot\delta + K\delta = 0\), along a swing of amplitude A
        !! with velocities of size \(\omega A\): halving A divides them by 8.
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp) :: a(2), linear(2), dropped(2), q(2), v(2), size_of(3), w2, amplitude
        integer :: i

        call new_system("cart_pendulum", system, error)
        call system%configure([m1, m2, l, g], error)
        w2 = (m1 + m2)*g/(m1*l)
        do i = 1, 3
            amplitude = 0.1_dp*0.5_dp**i
            q = [0.4_dp, 0.8_dp*amplitude]
            v = [0.0_dp, 0.6_dp*amplitude*sqrt(w2)]
            call system%accelerations(0.0_dp, q, v, a)
            linear = [m2*g/m1, -w2]*q(2)
            dropped = a - linear
            size_of(i) = maxval(abs(dropped))
        end do
        call assertTrue(size_of(3) > 0.0_dp, "size_of(3) > 0.0")
        if (anyExceptions()) return
        call assertEqual(3.0_dp, log(size_of(1:2)/size_of(2:3))/log(2.0_dp), 0.01_dp, "order")
    end subroutine dropped_term_is_of_third_order

    subroutine small_period_is_that_of_the_mode()
        !! A scene's `expect_small_period` and the modes speak of the same number.
        character(13), parameter :: names(3) = [character(13) :: "oscillator", "pendulum", &
                                                "cart_pendulum"]
        class(system_t), allocatable :: system
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        type(modes_t) :: modes
        real(dp), allocatable :: q(:), v(:)
        integer :: i

        do i = 1, size(names)
            call new_system(trim(names(i)), system, error)
            allocate (q(system%ndof), v(system%ndof), source=0.0_dp)
            call find_modes(system, q, .true., modes, error)
            q(system%ndof) = 0.3_dp
            call system%closed_form(0.0_dp, q, v, reference)
            call assertRelativelyEqual(2.0_dp*pi/sqrt(modes%omega2(system%ndof)), &
                                       reference%small_period, 1e-15_dp*4, names(i))
            deallocate (q, v)
        end do
    end subroutine small_period_is_that_of_the_mode
end module test_amplitude
