module test_canonical
    !! Momenta, velocities and forces of every system; implicit methods that find no solution.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertTrue
    use lagrangia_catalogue, only: new_system, nth_system, system_names
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, status_numbers
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_lagrange, only: euler_lagrange_t, expand_lagrangian
    use lagrangia_methods, only: new_integrator
    use lagrangia_observer, only: observer_box_t
    use lagrangia_run, only: run
    use lagrangia_system, only: system_t
    use lagrangia_time_grid, only: new_time_grid, time_grid_t
    use random_states, only: draw_parameters, draw_state, restart_random
    use restless_oscillator, only: restless_oscillator_t
    implicit none (type, external)
    private
    public :: canonical_suite

contains

    function canonical_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("canonical")
        call suite%addTest(TestMethod("momenta_and_forces_follow_from_the_lagrangian", &
                                      momenta_and_forces_follow_from_the_lagrangian, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("failed_iterations_are_told", failed_iterations_are_told))
        call suite%addTest(TestMethod("slow_iterations_are_no_solutions", &
                                      slow_iterations_are_no_solutions))
        call suite%addTest(TestMethod("half_a_solution_is_none", half_a_solution_is_none))
    end function canonical_suite

    subroutine momenta_and_forces_follow_from_the_lagrangian()
        !! Of every system, hand-derived or not, with random parameters and states.
        real(dp), parameter :: rounding = 200.0_dp*epsilon(1.0_dp)
        !! of some ten operations, behind a mass matrix of condition 10 to 100
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(euler_lagrange_t) :: terms
        real(dp), allocatable :: q(:), v(:), p(:), u(:), f(:)
        character(:), allocatable :: name
        real(dp) :: t, large
        integer :: k, draw

        k = 0
        do
            k = k + 1
            call nth_system(k, system)
            if (.not. allocated(system)) exit
            call system%describe(d)
            name = trim(d%name)
            do draw = 1, 20
                call draw_parameters(system, edges=draw > 10)
                call draw_state(system, t, q, v)
                p = v
                u = v
                f = v
                call system%momenta(t, q, v, p)
                call system%velocities(t, q, p, u)
                call system%forces(t, q, v, f)
                call expand_lagrangian(system, t, q, v, terms)
                large = 1.0_dp + maxval(abs(terms%mass))*maxval(abs(v))*(1.0_dp + maxval(abs(v)))
                call assertEqual(terms%dl_dv, p, rounding*large, name//": momenta")
                call assertEqual(v, u, rounding*(1.0_dp + maxval(abs(v))), name//": velocities")
                call assertEqual(terms%dl_dq, f, rounding*(large + maxval(abs(terms%dl_dq))), &
                                 name//": forces")
            end do
            if (anyExceptions()) return
        end do
        call assertEqual(size(system_names()), k - 1, "systems checked")
    end subroutine momenta_and_forces_follow_from_the_lagrangian

    subroutine failed_iterations_are_told()
        !! A step ten times too long: not a wrong number, but none, with the reason and the time;
        !! also where the masses, and with them the momenta, are small.
        character(15), parameter :: names(2) = [character(15) :: "stormer_verlet", "midpoint"]
        class(integrator_t), allocatable :: method
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(observer_box_t) :: nobody(0)
        type(time_grid_t) :: plan
        real(dp) :: q(2), v(2), light
        integer :: again, i

        call new_system("double_pendulum", system, error)
        do i = 1, 2*size(names)
            light = merge(1.0_dp, 1e-13_dp, i <= size(names))
            call system%configure([light, light, 1.0_dp, 1.0_dp, 9.81_dp], error)
            call new_integrator(trim(names(1 + mod(i, 2))), method, error)
            call method%prepare(system, error)
            q = [2.0_dp, 1.0_dp]
            v = [7.0_dp, -9.0_dp]
            call method%start(system, 0.0_dp, q, v)
            call method%advance(system, 0.0_dp, 1.0_dp, 0_i8, 3_i8, q, v)
            call assertTrue(all(ieee_is_nan([q, v])), trim(method%name)//": NaN")
            do again = 1, 2
                call assertEqual("the equations of the step at t = 0.0 s did not converge; a "// &
                                 "shorter dt is needed", trim(method%failure_reason))
                call method%advance(system, 0.0_dp, 1.0_dp, 3_i8, 1_i8, q, v)  ! the first stays
            end do

            q = [2.0_dp, 1.0_dp]
            v = [7.0_dp, -9.0_dp]
            call new_time_grid(plan, 0.5_dp, 1.0_dp, 3.0_dp, 1_i8, error)
            call run(system, method, plan, nobody, q, v, error)
            call assertTrue(allocated(error), trim(method%name)//": the run fails")
            if (.not. allocated(error)) return
            call assertEqual(status_numbers, error%status, "exit status")
            call assertEqual("the state is not finite at t = 1.5 s: the equations of the "// &
                             "step at t = 0.5 s did not converge; a shorter dt is needed", &
                             error%message)
            call assertEqual([2.0_dp, 1.0_dp], q, message="the last good coordinates")
            call method%start(system, 0.0_dp, q, v)
            call assertEqual("", trim(method%failure_reason), "a new run has not failed")
        end do
    end subroutine failed_iterations_are_told

    subroutine slow_iterations_are_no_solutions()
        !! On the oscillator the midpoint rule's iteration gains \((\omega h/2)^2\) a round: by 0.7
        !! it arrives within a hundred rounds, by 0.9 it does not.
        class(integrator_t), allocatable :: method
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)
        integer :: i

        call new_system("oscillator", system, error)
        call system%configure([1.0_dp, 1.0_dp], error)
        call new_integrator("midpoint", method, error)
        call method%prepare(system, error)
        q = 1.0_dp
        v = 0.0_dp
        do i = 1, 10
            call method%start(system, 0.0_dp, q, v)
            call method%advance(system, 0.0_dp, 2.0_dp*sqrt(0.7_dp), 0_i8, 1_i8, q, v)
        end do
        call assertEqual(1.0_dp, hypot(q(1), v(1)), 1e-14_dp, "energy at 0.7")
        call assertEqual(cos(20.0_dp*atan(sqrt(0.7_dp))), q(1), 1e-14_dp, "angle at 0.7")
        call method%start(system, 0.0_dp, q, v)
        call method%advance(system, 0.0_dp, 2.0_dp*sqrt(0.9_dp), 0_i8, 1_i8, q, v)
        call assertTrue(ieee_is_nan(q(1)), "no solution at 0.9")
    end subroutine slow_iterations_are_no_solutions

    subroutine half_a_solution_is_none()
        !! Momenta that never settle beside coordinates so large that they always do, and the other
        !! way round: the step has no solution.
        class(integrator_t), allocatable :: method
        type(restless_oscillator_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: q(1), v(1)
        integer :: i

        call new_integrator("midpoint", method, error)
        do i = 1, 2
            system%in_p = i == 1
            call system%configure([merge(1.0_dp, 1e18_dp, system%in_p), 1.0_dp], error)
            call method%prepare(system, error)
            q = merge(1e18_dp, 1.0_dp, system%in_p)
            v = 1.0_dp
            call method%start(system, 0.0_dp, q, v)
            call method%advance(system, 0.0_dp, 1.0_dp, 0_i8, 1_i8, q, v)
            call assertTrue(ieee_is_nan(q(1)), trim(merge("p", "q", system%in_p))//" never settles")
        end do
    end subroutine half_a_solution_is_none
end module test_canonical
