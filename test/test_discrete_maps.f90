module test_discrete_maps
    !! What a fixed-step method must do to the last digit, whatever its order.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: new_integrator, new_system
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: discrete_maps_suite

contains

    function discrete_maps_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("discrete_maps")
        call suite%addTest(TestMethod("three_rk4_steps_are_these_fractions", &
                                      three_rk4_steps_are_these_fractions))
        call suite%addTest(TestMethod("three_verlet_steps_are_these_fractions", &
                                      three_verlet_steps_are_these_fractions))
        call suite%addTest(TestMethod("rk4_shrinks_by_its_polynomial", &
                                      rk4_shrinks_by_its_polynomial))
        call suite%addTest(TestMethod("verlet_conserves_its_own_energy", &
                                      verlet_conserves_its_own_energy))
        call suite%addTest(TestMethod("verlet_runs_backwards", verlet_runs_backwards))
        call suite%addTest(TestMethod("stability_ends_where_it_must", &
                                      stability_ends_where_it_must))
        call suite%addTest(TestMethod("blocks_do_not_matter", blocks_do_not_matter))
    end function discrete_maps_suite

    subroutine advance(system_name, values, method, t0, dt, steps, q, v)
        !! `steps` steps of a named method on a named system.
        character(*), intent(in) :: system_name, method
        real(dp), intent(in) :: values(:), t0, dt
        integer, intent(in) :: steps
        real(dp), intent(inout) :: q(:), v(:)
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: integrator
        type(error_t), allocatable :: error

        call new_system(system_name, system, error)
        call system%configure(values, error)
        call new_integrator(method, integrator, error)
        call integrator%prepare(system, error)
        call assertFalse(allocated(error), message=method//" on "//system_name)
        call integrator%advance(system, t0, dt, 0_i8, int(steps, i8), q, v)
    end subroutine advance

    subroutine three_rk4_steps_are_these_fractions()
        !! Oscillator m = k = 1, h = 1/2, in rational arithmetic; a few roundings are allowed.
        real(dp) :: q(1), v(1)

        q = 1.0_dp
        v = 0.0_dp
        call advance("oscillator", [1.0_dp, 1.0_dp], "rk4", 0.0_dp, 0.5_dp, 3, q, v)
        call assertEqual(4044337.0_dp/56623104.0_dp, q(1), 8*epsilon(q))
        call assertEqual(-7057573.0_dp/7077888.0_dp, v(1), 8*epsilon(q))
    end subroutine three_rk4_steps_are_these_fractions

    subroutine three_verlet_steps_are_these_fractions()
        !! Binary fractions: exact, to the last bit.
        real(dp) :: q(1), v(1)

        q = 1.0_dp
        v = 0.0_dp
        call advance("oscillator", [1.0_dp, 1.0_dp], "verlet", 0.0_dp, 0.5_dp, 3, q, v)
        call assertEqual(7.0_dp/128.0_dp, q(1), 0.0_dp)
        call assertEqual(-33.0_dp/32.0_dp, v(1), 0.0_dp)
    end subroutine three_verlet_steps_are_these_fractions

    subroutine rk4_shrinks_by_its_polynomial()
        !! \(|R(iz)|^2 = 1 - z^6/72 + z^8/576\) a step, \(z = \omega h\).
        real(dp) :: q(1), v(1), z

        z = 1.3_dp
        q = 0.8_dp
        v = -0.3_dp
        call advance("oscillator", [1.0_dp, 1.0_dp], "rk4", 0.0_dp, z, 1, q, v)
        call assertEqual((0.8_dp**2 + 0.3_dp**2)*(1.0_dp - z**6/72.0_dp + z**8/576.0_dp), &
                         q(1)**2 + v(1)**2, 8*epsilon(q))
    end subroutine rk4_shrinks_by_its_polynomial

    subroutine verlet_conserves_its_own_energy()
        !! \((1-\omega^2h^2/4)\,v^2 + \omega^2x^2\), here with m = 2, k = 3; 10^4 steps round.
        real(dp) :: q(1), v(1), h, w2, start

        h = 0.7_dp
        w2 = 1.5_dp
        q = 0.4_dp
        v = 0.9_dp
        start = (1.0_dp - 0.25_dp*w2*h**2)*v(1)**2 + w2*q(1)**2
        call advance("oscillator", [2.0_dp, 3.0_dp], "verlet", 0.0_dp, h, 10000, q, v)
        call assertEqual(start, (1.0_dp - 0.25_dp*w2*h**2)*v(1)**2 + w2*q(1)**2, 1e-12_dp)
    end subroutine verlet_conserves_its_own_energy

    subroutine verlet_runs_backwards()
        !! With the velocity turned round it comes back: 200 steps there and back round.
        real(dp) :: q(1), v(1)

        q = 1.1_dp
        v = 0.3_dp
        call advance("pendulum", [0.7_dp, 1.3_dp, 9.81_dp], "verlet", 0.0_dp, 0.05_dp, 200, q, v)
        v = -v
        call advance("pendulum", [0.7_dp, 1.3_dp, 9.81_dp], "verlet", 0.0_dp, 0.05_dp, 200, q, v)
        call assertEqual(1.1_dp, q(1), 400*epsilon(q))
        call assertEqual(-0.3_dp, v(1), 400*epsilon(q))
    end subroutine verlet_runs_backwards

    subroutine stability_ends_where_it_must()
        !! Verlet: \(\omega h < 2\); RK4: \(\omega h \le 2\sqrt2 = 2.828\).
        call assertTrue(final_size("verlet", 1.99_dp) < 100.0_dp, message="verlet below")
        call assertTrue(final_size("verlet", 2.01_dp) > 1e6_dp, message="verlet above")
        call assertTrue(final_size("rk4", 2.82_dp) < 2.0_dp, message="rk4 below")
        call assertTrue(final_size("rk4", 2.84_dp) > 1e6_dp, message="rk4 above")
    end subroutine stability_ends_where_it_must

    function final_size(method, z) result(value)
        !! \(|x| + |v|\) of the unit oscillator after 1000 steps with \(\omega h = z\).
        character(*), intent(in) :: method
        real(dp), intent(in) :: z
        real(dp) :: value, q(1), v(1)

        q = 1.0_dp
        v = 0.0_dp
        call advance("oscillator", [1.0_dp, 1.0_dp], method, 0.0_dp, z, 1000, q, v)
        value = abs(q(1)) + abs(v(1))
    end function final_size

    subroutine blocks_do_not_matter()
        !! 100 steps at once, or in blocks of 1, 7 and 92: the same bytes, also where time enters.
        character(6), parameter :: methods(2) = ["rk4   ", "verlet"]
        class(system_t), allocatable :: system
        class(integrator_t), allocatable :: integrator
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), q_cut(1), v_cut(1)
        integer :: i

        call new_system("driven_pendulum", system, error)
        do i = 1, size(methods)
            call new_integrator(trim(methods(i)), integrator, error)
            call integrator%prepare(system, error)
            q = 2.9_dp
            v = 0.1_dp
            q_cut = q
            v_cut = v
            call integrator%advance(system, 0.1_dp, 3e-3_dp, 0_i8, 100_i8, q, v)
            call integrator%prepare(system, error)
            call integrator%advance(system, 0.1_dp, 3e-3_dp, 0_i8, 1_i8, q_cut, v_cut)
            call integrator%advance(system, 0.1_dp, 3e-3_dp, 1_i8, 7_i8, q_cut, v_cut)
            call integrator%advance(system, 0.1_dp, 3e-3_dp, 8_i8, 92_i8, q_cut, v_cut)
            call assertEqual(q(1), q_cut(1), 0.0_dp, methods(i))
            call assertEqual(v(1), v_cut(1), 0.0_dp, methods(i))
        end do
    end subroutine blocks_do_not_matter
end module test_discrete_maps
