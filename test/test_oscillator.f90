module test_oscillator
    !! The oscillator and its closed form.
    use formula, only: formula_value, names_t
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertRelativelyEqual, &
                     assertTrue
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_reference, only: reference_t
    use lagrangia_text, only: to_text
    use printed_names, only: name_state
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
        call suite%addTest(TestMethod("printed_motion_is_the_reference", &
                                      printed_motion_is_the_reference))
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

    subroutine printed_motion_is_the_reference()
        !! The motion that is printed, of any damping: below, at and beyond the critical one, b = 2,
        !! far beyond it, where cosh and sinh would cancel, and without a spring.
        real(dp), parameter :: dampings(12) = [0.3_dp, 1.9999_dp, 2.0_dp, 2.0001_dp, 3.9_dp, &
                                               4.0_dp, 4.00000001_dp, 6.0_dp, 50.0_dp, 1e3_dp, &
                                               1.0_dp, 1e-20_dp]
        real(dp), parameter :: times(3) = [0.5_dp, 3.0_dp, 20.0_dp], start = 0.7_dp, push = -0.3_dp
        type(oscillator_t) :: system
        class(reference_t), allocatable :: reference
        type(description_t) :: d
        type(names_t) :: letters
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1), size_of, value
        logical :: ok
        integer :: i, k

        do i = 1, size(dampings)
            call system%configure([1.0_dp, merge(0.0_dp, 1.0_dp, i > size(dampings) - 2), &
                                   dampings(i)], error)
            call system%describe(d)
            call assertTrue(allocated(d%motion), "a motion with b = "//to_text(dampings(i)))
            if (.not. allocated(d%motion)) return
            call system%closed_form(0.0_dp, [start], [push], reference)
            do k = 1, size(times)
                if (dampings(i)*times(k) > 1e3_dp) cycle  ! sinh overflows
                call name_state(system, times(k), [start], [push], letters)
                call letters%set("x_0", start)
                call letters%set("x_dot_0", push)
                call letters%set("t", times(k))
                call formula_value(trim(d%motion(1)(5:)), letters, value, size_of, ok)
                call assertTrue(ok, trim(d%motion(1)))
                call reference%state_at(times(k), q, v)
                call assertEqual(q(1), value, 1e-12_dp, "b = "//to_text(dampings(i))//", t = "// &
                                 to_text(times(k)))
            end do
        end do
    end subroutine printed_motion_is_the_reference

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
