module test_method_structure
    !! What methods preserve, as they declare it: canonical maps, reversibility, speed. What does
    !! not declare a property is seen not to have it.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertGreaterThan, assertLessThan
    use lagrangia_catalogue, only: nth_system
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t
    use lagrangia_integrator, only: integrator_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_method_orders, only: new_problem, problems, refuses
    use lagrangia_method_promises, only: canonical_defect
    use lagrangia_methods, only: method_names, nth_integrator
    use lagrangia_system, only: system_t
    use random_states, only: draw_parameters, draw_state, restart_random
    implicit none (type, external)
    private
    public :: method_structure_suite

contains

    function method_structure_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("method_structure")
        call suite%addTest(TestMethod("symplectic_as_declared", symplectic_as_declared, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("reversible_as_declared", reversible_as_declared, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("speed_is_kept_as_declared", speed_is_kept_as_declared))
    end function method_structure_suite

    subroutine symplectic_as_declared()
        !! \(J^\top\Omega J = \Omega\) for the derivative of a step in canonical coordinates, by
        !! differences of order 8, on every system and with random parameters and states; and with
        !! friction of none.
        real(dp), parameter :: rounding = 1e-10_dp  !! epsilon over the differences' step, 300 times
        class(integrator_t), allocatable :: method
        class(system_t), allocatable :: system
        type(description_t) :: d
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t, worst
        integer :: i, k, draw

        do i = 1, size(method_names())
            call restart_random()
            worst = 0.0_dp
            k = 0
            do
                k = k + 1
                call nth_integrator(i, method)
                call nth_system(k, system)
                if (.not. allocated(system)) exit
                if (system%constraints > 0) cycle
                call system%describe(d)
                do draw = 1, 5
                    call draw_parameters(system, edges=.false.)
                    call draw_state(system, t, q, v)
                    if (refuses(method, system)) cycle
                    if (too_light(system, t, q, v)) cycle
                    if (system%nonconservative) then  ! phase space shrinks: nobody may keep it
                        ! NaN where the friction is too stiff for the step
                        call assertFalse(canonical_defect(method, system, t, q, v) <= 1e-6_dp, &
                            trim(method%name)//", "//trim(d%name)//": damped")
                        cycle
                    end if
                    worst = max(worst, canonical_defect(method, system, t, q, v))
                    if (method%symplectic) call assertLessThan(worst, rounding, &
                        message=trim(method%name)//", "//trim(d%name)//": symplectic")
                end do
                if (anyExceptions()) return
            end do
            if (method%symplectic .or. method%order > 8) cycle  ! too accurate to show it
            call assertGreaterThan(worst, 1e-6_dp, &
                                   message=trim(method%name)//": not symplectic")
        end do
    end subroutine symplectic_as_declared

    function too_light(system, t, q, v) result(yes)
        !! The differences in momenta, up to \(0.02(1 + \max|p|)\), change a velocity by more than
        !! 1 rad/s or m/s: their truncation is more than rounding then.
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(:), v(:)
        logical :: yes
        real(dp) :: p(size(q)), changed(size(q)), faster(size(q))
        integer :: i

        call system%momenta(t, q, v, p)
        yes = .false.
        do i = 1, size(q)
            changed = p
            changed(i) = p(i) + 0.02_dp*(1.0_dp + maxval(abs(p)))
            call system%velocities(t, q, changed, faster)
            yes = yes .or. maxval(abs(faster - v)) > 1.0_dp
        end do
    end function too_light

    subroutine reversible_as_declared()
        !! As many steps back as forth lead to the start, on every system with random states.
        real(dp), parameter :: rounding = 1e-12_dp  !! 40 steps of 10 epsilon, with room to grow
        class(integrator_t), allocatable :: method
        class(system_t), allocatable :: system
        type(description_t) :: d
        real(dp), allocatable :: q(:), v(:), q0(:), v0(:)
        real(dp) :: t, worst
        integer :: i, k, draw

        do i = 1, size(method_names())
            call restart_random()
            worst = 0.0_dp
            k = 0
            do
                k = k + 1
                call nth_integrator(i, method)
                call nth_system(k, system)
                if (.not. allocated(system)) exit
                call system%describe(d)
                do draw = 1, 3
                    call draw_parameters(system, edges=.false.)
                    call draw_state(system, t, q0, v0)
                    if (refuses(method, system)) cycle
                    q = q0
                    v = v0
                    call method%start(system, t, q, v)
                    call method%advance(system, t, 0.02_dp, 0_i8, 20_i8, q, v)
                    call method%start(system, t + 20*0.02_dp, q, v)
                    call method%advance(system, t + 20*0.02_dp, -0.02_dp, 0_i8, 20_i8, q, v)
                    worst = max(worst, maxval(abs(q - q0)), maxval(abs(v - v0)))
                    if (method%reversible) call assertLessThan(worst, rounding, &
                        message=trim(method%name)//", "//trim(d%name)//": reversible")
                end do
                if (anyExceptions()) return
            end do
            if (.not. method%reversible) call assertGreaterThan(worst, 1e-9_dp, &
                message=trim(method%name)//": not reversible")
        end do
    end subroutine reversible_as_declared

    subroutine speed_is_kept_as_declared()
        !! In a magnetic field alone, over 10000 steps of a tenth of a radian. What declares
        !! nothing may keep it too, in fields as simple as this, but not all of it does.
        class(integrator_t), allocatable :: method
        class(system_t), allocatable :: system
        real(dp), allocatable :: q(:), v(:)
        type(error_t), allocatable :: error
        real(dp) :: change, speed, worst
        integer :: i, declared

        worst = 0.0_dp
        declared = 0

        do i = 1, size(method_names())
            call nth_integrator(i, method)
            call new_problem(problems, system, q, v)
            call system%configure([2.0_dp, 0.5_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.1_dp, -0.2_dp, &
                                   0.3_dp, 0.0_dp], error)
            if (refuses(method, system)) cycle
            speed = norm2(v)
            call method%start(system, 0.0_dp, q, v)
            call method%advance(system, 0.0_dp, 1.0_dp, 0_i8, 10000_i8, q, v)
            change = abs(norm2(v)/speed - 1.0_dp)
            if (method%keeps_speed) then
                declared = declared + 1
                call assertLessThan(change, 1e-13_dp, &
                                    message=trim(method%name)//": keeps the speed")
            else
                worst = max(worst, change)
            end if
        end do
        call assertGreaterThan(worst, 1e-6_dp, message="a method that does not keep the speed")
        call assertEqual(2, declared, "boris and midpoint declare it")
    end subroutine speed_is_kept_as_declared
end module test_method_structure
