module test_oscillator
    !! The oscillator and its closed form.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertRelativelyEqual, &
                     assertTrue
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_reference, only: reference_t
    use random_states, only: draw_parameters, draw_state, restart_random
    use reference_checks, only: check_reference, check_state
    implicit none (type, external)
    private
    public :: oscillator_suite

contains

    function oscillator_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("oscillator")
        call suite%addTest(TestMethod("hooke_and_newton", hooke_and_newton, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("no_spring_no_force", no_spring_no_force, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("reference_solves_it", reference_solves_it, &
                                      setUp=restart_random))
    end function oscillator_suite

    subroutine hooke_and_newton()
        !! m = 2, k = 8: omega = 2; a quarter period from rest at 3 it passes 0 with -6.
        type(oscillator_t) :: system
        class(reference_t), allocatable :: reference
        type(error_t), allocatable :: error
        real(dp) :: a(1)

        call system%configure([2.0_dp, 8.0_dp], error)
        call system%accelerations(0.0_dp, [3.0_dp], [0.5_dp], a)
        call assertEqual(-12.0_dp, a(1), message="x_ddot")
        call assertEqual(-24.0_dp, system%quantity(1, 0.0_dp, [3.0_dp], [0.5_dp]), message="force")
        call assertEqual(1.0_dp, system%quantity(2, 0.0_dp, [3.0_dp], [0.5_dp]), message="p_x")
        call assertEqual(36.25_dp, system%energy(0.0_dp, [3.0_dp], [0.5_dp]), message="energy")
        call system%closed_form(0.5_dp, [3.0_dp], [0.0_dp], reference)
        call assertTrue(allocated(reference), "found")
        call assertRelativelyEqual(acos(-1.0_dp), reference%period, 1e-15_dp, "period")
        call check_state(reference, 0.5_dp + 0.25_dp*reference%period, [0.0_dp], [-6.0_dp], &
                         2e-15_dp, "quarter")
    end subroutine hooke_and_newton

    subroutine no_spring_no_force()
        !! k = 0: uniform motion, x cyclic, its momentum conserved.
        type(oscillator_t) :: system
        class(reference_t), allocatable :: reference
        type(description_t) :: d
        type(error_t), allocatable :: error

        call system%configure([2.0_dp, 0.0_dp], error)
        call assertEqual(1, system%cyclic)
        call system%describe(d)
        call assertTrue(d%quantities(2)%conserved, "d%quantities(2)%conserved")
        call system%closed_form(0.0_dp, [3.0_dp], [0.5_dp], reference)
        call check_state(reference, 4.0_dp, [5.0_dp], [0.5_dp], 0.0_dp, "uniform")
        call assertEqual(0.0_dp, reference%period)
    end subroutine no_spring_no_force

    subroutine reference_solves_it()
        !! From random states.
        type(oscillator_t) :: system
        class(reference_t), allocatable :: reference
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t
        integer :: i

        do i = 1, 10
            call draw_parameters(system, edges=mod(i, 3) == 0)
            call draw_state(system, t, q, v)
            call system%closed_form(t, q, v, reference)
            call check_reference(reference, system, t, q, v, "oscillator")
            if (anyExceptions()) return
        end do
    end subroutine reference_solves_it
end module test_oscillator
