module test_method_refusals
    !! Methods that do not fit, or do not exist.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: new_system
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t, not_prepared
    use lagrangia_kinds, only: dp, i8
    use lagrangia_methods, only: new_integrator, prepare_integrator
    use lagrangia_pendulum, only: pendulum_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: method_refusals_suite

contains

    function method_refusals_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("method_refusals")
        call suite%addTest(TestMethod("refusals_name_what_works", refusals_name_what_works))
        call suite%addTest(TestMethod("nothing_is_prepared_for_no_coordinates", &
                                      nothing_is_prepared_for_no_coordinates))
    end function method_refusals_suite

    subroutine refusals_name_what_works()
        !! Verlet on the double pendulum, Boris on a pendulum, midpoint on a rolling disk; and
        !! sums that cannot be compensated, methods that do not exist.
        call check_refusal("verlet", "double_pendulum", &
                           "verlet is for forces that depend on positions only, "// &
                           "and here they depend on velocities; these methods work: rk4, "// &
                           "stormer_verlet, midpoint, gauss16")
        call check_refusal("kahan_li8", "charged_particle", &
                           "kahan_li8 is for forces that depend on positions "// &
                           "only, and here they depend on velocities; these methods work: rk4, "// &
                           "stormer_verlet, midpoint, boris")
        call check_refusal("boris", "pendulum", &
                           "boris is for charges in magnetic fields; these methods "// &
                           "work: rk4, stormer_verlet, midpoint, gauss16, verlet, ")
        call check_refusal("midpoint", "rolling_disk", &
                           "midpoint is for systems with a Hamiltonian, and "// &
                           "here there are constraints beside L; these methods work: rk4")
        call check_absence("midpoint", .true., "compensated", "midpoint has no compensated sums;")
        call check_absence("boris", .true., "compensated", "boris has no compensated sums; "// &
                           "these have: rk4, verlet, velocity_verlet, ")
        call check_absence("rk5", .false., "method", "unknown method 'rk5'; did you mean 'rk4'?")
        call check_absence("Runge-Kutta", .false., "method", "unknown method 'Runge-Kutta'; "// &
                           "did you mean 'rk4' (classical Runge-Kutta, any system (Kutta 1901))?")
        call check_absence("leapfrog", .false., "method", "unknown method 'leapfrog'; did you "// &
                           "mean 'velocity_verlet' (kick, drift, kick: leapfrog (Verlet 1967))?")
    end subroutine refusals_name_what_works

    subroutine check_refusal(name, of, message)
        !! Method `name` refuses the system `of` that name in words that begin like `message`.
        character(*), intent(in) :: name, of, message
        class(integrator_t), allocatable :: method
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        call new_integrator(name, method, error)
        call new_system(of, system, error)
        call prepare_integrator(method, system, error)
        call assertTrue(allocated(error), name//" refuses")
        if (.not. allocated(error)) return
        call assertEqual(1, index(error%message, message), error%message)
        call assertEqual("method", error%key)
    end subroutine check_refusal

    subroutine check_absence(name, compensated, key, message)
        !! There is no such method, or not with compensated sums.
        character(*), intent(in) :: name, key, message
        logical, intent(in) :: compensated
        class(integrator_t), allocatable :: method
        type(error_t), allocatable :: error

        call new_integrator(name, method, error, compensated)
        call assertFalse(allocated(method), name//" is absent")
        call assertTrue(allocated(error), name//" is refused")
        if (.not. allocated(error)) return
        call assertEqual(1, index(error%message, message), error%message)
        call assertEqual(key, error%key)
    end subroutine check_absence

    subroutine nothing_is_prepared_for_no_coordinates()
        !! A method that was never prepared, and a system that was never configured: both have
        !! none.
        class(integrator_t), allocatable :: method
        type(error_t), allocatable :: error
        type(pendulum_t) :: pendulum
        real(dp) :: q(0), v(0)

        call new_integrator("gauss16", method, error)
        call method%advance(pendulum, 0.0_dp, 0.1_dp, 0_i8, 1_i8, q, v)
        call assertEqual(not_prepared, trim(method%failure_reason))
    end subroutine nothing_is_prepared_for_no_coordinates
end module test_method_refusals
