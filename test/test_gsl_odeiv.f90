module test_gsl_odeiv
    !! GSL's integrators behind our door: right against closed forms, refusals in words.
    use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_procpointer, c_funloc, &
                                           c_int, c_loc, c_null_ptr, c_ptr
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_catalogue, only: new_system
    use lagrangia_description, only: description_t
    use lagrangia_direct_rates, only: direct_context_t, direct_rates
    use lagrangia_errors, only: error_t, status_library, status_numbers, status_usage
    use lagrangia_gsl_contestants, only: gsl_context_t, gsl_jacobian, gsl_rates
    use lagrangia_gsl_odeiv, only: gsl_driver_t, gsl_methods
    use lagrangia_kinds, only: dp, i8
    use lagrangia_reference, only: reference_t
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: gsl_odeiv_suite

    real(dp), parameter :: any_error = 1e300_dp

contains

    function gsl_odeiv_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("gsl_odeiv")
        call suite%addTest(TestMethod("adaptive_methods_are_right", adaptive_methods_are_right))
        call suite%addTest(TestMethod("rk4_is_of_order_4", rk4_is_of_order_4))
        call suite%addTest(TestMethod("evaluations_are_counted", evaluations_are_counted))
        call suite%addTest(TestMethod("the_jacobian_is_right", the_jacobian_is_right))
        call suite%addTest(TestMethod("time_enters_the_jacobian", time_enters_the_jacobian))
        call suite%addTest(TestMethod("direct_rates_are_the_systems", direct_rates_are_the_systems))
        call suite%addTest(TestMethod("refusals_have_words", refusals_have_words))
    end function gsl_odeiv_suite

    subroutine solve(name, method, h, tolerance, q, v, t_end, worst, evaluations)
        !! Error at `t_end` against the closed form; fixed steps where `h` is positive.
        character(*), intent(in) :: name, method
        real(dp), intent(in) :: h, tolerance, q(:), v(:), t_end
        real(dp), intent(out) :: worst
        integer(i8), intent(out) :: evaluations
        class(system_t), allocatable, target :: system
        class(reference_t), allocatable :: truth
        type(gsl_context_t), target :: context
        type(gsl_driver_t) :: driver
        type(error_t), allocatable :: error
        real(dp) :: t, y(2*size(q)), q_end(size(q)), v_end(size(v))

        worst = huge(worst)
        evaluations = 0
        call new_system(name, system, error)
        call system%closed_form(0.0_dp, q, v, truth)
        call truth%state_at(t_end, q_end, v_end)
        context%system => system
        call driver%start(method, size(y), c_funloc(gsl_rates), c_funloc(gsl_jacobian), &
                          c_loc(context), 1e-3_dp, tolerance, error)
        call assertFalse(allocated(error), method)
        if (anyExceptions()) return
        y = [q, v]
        t = 0.0_dp
        if (h > 0.0_dp) then
            call driver%fixed_steps(t, h, nint(t_end/h, i8), y, error)
        else
            call driver%integrate(t, t_end, y, error)
        end if
        call assertFalse(allocated(error), method)
        call assertEqual(t_end, t, tolerance=1e-12_dp)
        worst = maxval(abs(y - [q_end, v_end]))
        evaluations = context%evaluations
        call driver%free()
    end subroutine solve

    subroutine adaptive_methods_are_right()
        !! A local tolerance of 1e-11 adds up over the hundreds of steps of a few turns to less
        !! than a thousand times as much, with forces of positions and of velocities; and a
        !! tolerance of 1e-5 gives a larger error.
        real(dp) :: worst, loose
        integer(i8) :: evaluations
        integer :: i

        do i = 2, size(gsl_methods)
            call solve("pendulum", trim(gsl_methods(i)), 0.0_dp, 1e-11_dp, [1.9_dp], [0.3_dp], &
                       5.0_dp, worst, evaluations)
            call assertTrue(worst < 1e-8_dp, trim(gsl_methods(i)))
            call solve("pendulum", trim(gsl_methods(i)), 0.0_dp, 1e-5_dp, [1.9_dp], [0.3_dp], &
                       5.0_dp, loose, evaluations)
            call assertTrue(worst < loose, trim(gsl_methods(i)))
            call solve("charged_particle", trim(gsl_methods(i)), 0.0_dp, 1e-11_dp, &
                       [0.1_dp, -0.2_dp, 0.3_dp], [0.7_dp, 0.4_dp, 0.1_dp], 5.0_dp, worst, &
                       evaluations)
            call assertTrue(worst < 1e-8_dp, trim(gsl_methods(i)))
        end do
    end subroutine adaptive_methods_are_right

    subroutine rk4_is_of_order_4()
        !! At fixed steps, from both sides.
        real(dp) :: coarse, fine
        integer(i8) :: evaluations

        call solve("pendulum", "rk4", 0.008_dp, any_error, [1.9_dp], [0.3_dp], 4.0_dp, coarse, &
                   evaluations)
        call solve("pendulum", "rk4", 0.004_dp, any_error, [1.9_dp], [0.3_dp], 4.0_dp, fine, &
                   evaluations)
        call assertEqual(4.0_dp, log(coarse/fine)/log(2.0_dp), tolerance=0.1_dp)
    end subroutine rk4_is_of_order_4

    subroutine evaluations_are_counted()
        !! GSL's rk4 doubles its steps: two half steps beside each whole one, and the rates at both
        !! ends, the first of which the next step knows already.
        real(dp) :: worst
        integer(i8) :: evaluations

        call solve("pendulum", "rk4", 0.01_dp, any_error, [1.9_dp], [0.3_dp], 4.0_dp, worst, &
                   evaluations)
        call assertTrue(evaluations >= 11*400 .and. evaluations <= 13*400, &
                        "evaluations >= 11*400 .and. evaluations <= 13*400")
    end subroutine evaluations_are_counted

    subroutine the_jacobian_is_right()
        !! The charge's equations are linear: all derivatives are known. The rows are C's.
        class(system_t), allocatable, target :: system
        type(gsl_context_t), target :: context
        type(error_t), allocatable :: error
        real(dp) :: jacobian(6, 6), by_time(6), expected(6, 6), y(6)
        integer(c_int) :: status
        integer :: i

        call new_system("charged_particle", system, error)
        call system%configure([2.0_dp, 3.0_dp, 0.1_dp, 0.2_dp, 0.3_dp, 0.5_dp, 0.7_dp, 1.1_dp, &
                               0.8_dp], error)
        call assertFalse(allocated(error), "no error: the jacobian is right")
        context%system => system
        y = [0.3_dp, -0.4_dp, 0.5_dp, 1.2_dp, -0.6_dp, 0.9_dp]
        status = gsl_jacobian(0.0_dp, y, jacobian, by_time, c_loc(context))
        call assertEqual(0, int(status))
        expected = 0.0_dp  ! (column, row) of the matrix
        do i = 1, 3
            expected(3 + i, i) = 1.0_dp
            expected(i, 3 + i) = -0.8_dp/2.0_dp
        end do
        expected(5, 4) = 1.5_dp*1.1_dp
        expected(6, 4) = -1.5_dp*0.7_dp
        expected(6, 5) = 1.5_dp*0.5_dp
        expected(4, 5) = -1.5_dp*1.1_dp
        expected(4, 6) = 1.5_dp*0.7_dp
        expected(5, 6) = -1.5_dp*0.5_dp
        call assertEqual(expected, jacobian, tolerance=1e-9_dp)
        call assertEqual([(0.0_dp, i=1, 6)], by_time)
        call assertEqual(12, int(context%evaluations))
    end subroutine the_jacobian_is_right

    subroutine time_enters_the_jacobian()
        !! The driven pendulum's acceleration by the time, against differences of order four.
        real(dp), parameter :: h = 1e-4_dp, t = 0.37_dp, y(2) = [0.8_dp, -0.3_dp]
        class(system_t), allocatable, target :: system
        type(gsl_context_t), target :: context
        type(error_t), allocatable :: error
        real(dp) :: jacobian(4), by_time(2), a(1, 4), slope
        integer(c_int) :: status
        integer :: i

        call new_system("driven_pendulum", system, error)
        do i = 1, 4
            call system%accelerations(t + h*real(2*i - 5 + sign(1, 2*i - 5), dp)/2.0_dp, y(1:1), &
                                      y(2:2), a(:, i))
        end do
        context%system => system
        status = gsl_jacobian(t, y, jacobian, by_time, c_loc(context))
        call assertEqual(0, int(status))
        slope = (a(1, 1) - 8.0_dp*a(1, 2) + 8.0_dp*a(1, 3) - a(1, 4))/(12*h)
        call assertTrue(abs(slope) > 1e-2_dp, "abs(slope) > 1e-2")
        call assertEqual([0.0_dp, slope], by_time, tolerance=1e-6_dp*abs(slope))
        call assertEqual([0.0_dp, 1.0_dp], jacobian(1:2))
    end subroutine time_enters_the_jacobian

    subroutine direct_rates_are_the_systems()
        !! The right-hand sides in C are the accelerations, for other parameters than the default
        !! too: some ten operations, each rounded.
        character(16), parameter :: names(*) = [character(16) :: "oscillator", "pendulum", &
            "double_pendulum", "cart_pendulum", "charged_particle"]
        integer, parameter :: undamped(*) = [2, 3, 5, 4, 9]  !! parameters, without those of damping
        procedure(broken), pointer :: rates
        class(system_t), allocatable :: system
        type(direct_context_t), target :: context
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp) :: values(9), y(6), f(6), a(3)
        integer :: given, i, k, n

        do i = 1, size(names)
            values = [(merge(0.3_dp + 0.17_dp*k, 0.0_dp, k <= undamped(i)), k=1, size(values))]
            call new_system(trim(names(i)), system, error)
            call system%describe(d)
            given = sum(d%parameters%count)
            call system%configure(values(:given), error)
            call assertFalse(allocated(error), names(i))
            context%parameters(:given) = values(:given)
            context%evaluations = 0
            n = system%ndof
            call c_f_procpointer(direct_rates(trim(names(i))), rates)
            do k = 1, 20
                y = [0.3_dp, -0.4_dp, 0.7_dp, 1.1_dp, -1.3_dp, 0.2_dp]*k
                call system%accelerations(0.1_dp*k, y(:n), y(n + 1:2*n), a(:n))
                call assertEqual(0, int(rates(0.1_dp*k, y, f, c_loc(context))))
                call assertEqual(y(n + 1:2*n), f(:n))
                call assertEqual(a(:n), f(n + 1:2*n), 20*epsilon(a)*(1.0_dp + sum(y**2)), names(i))
            end do
            call assertEqual(20, int(context%evaluations))
        end do
        call assertFalse(c_associated(direct_rates("atwood")), "none is written")
    end subroutine direct_rates_are_the_systems

    function broken(t, y, rates, context) bind(c) result(status)
        !! A right-hand side that fails half-way: GSL_EBADFUNC.
        real(c_double), value :: t
        real(c_double), intent(in) :: y(*)
        real(c_double), intent(inout) :: rates(*)
        type(c_ptr), value :: context
        integer(c_int) :: status

        rates(1) = y(1)
        rates(2) = 1.0_dp
        status = merge(9, 0, t > 0.5_dp)
    end function broken

    subroutine refusals_have_words()
        !! No such method, no sensible step, a right-hand side that fails.
        type(gsl_driver_t) :: driver
        type(error_t), allocatable :: error
        real(dp) :: t, y(2)

        call start("rk5", 1e-3_dp)
        call refused("odeiv2: GSL has no method 'rk5' that is known here", status_usage)
        call start("rk4", 0.0_dp)
        call refused("odeiv2: the first step must be positive and finite", status_numbers)
        call start("rk8pd", 1e-3_dp)
        call assertFalse(allocated(error), "no error: refusals have words")
        t = 0.0_dp
        y = 1.0_dp
        call driver%integrate(t, 1.0_dp, y, error)
        call refused("odeiv2: GSL says: problem with user-supplied function", status_library)
        call assertEqual([0.0_dp, 1.0_dp, 1.0_dp], [t, y], message="as they were")
        call driver%fixed_steps(t, 0.1_dp, 10_i8, y, error)
        call refused("odeiv2: GSL says: problem with user-supplied function", status_library)
        call assertEqual([0.0_dp, 1.0_dp, 1.0_dp], [t, y], message="as they were")
        call driver%free()
        call driver%free()
    contains
        subroutine start(method, first_step)
            character(*), intent(in) :: method
            real(dp), intent(in) :: first_step

            call driver%start(method, 2, c_funloc(broken), c_funloc(gsl_jacobian), c_null_ptr, &
                              first_step, 1e-6_dp, error)
        end subroutine start

        subroutine refused(message, status)
            character(*), intent(in) :: message
            integer, intent(in) :: status

            call assertTrue(allocated(error), message)
            if (.not. allocated(error)) return
            call assertEqual(message, error%message)
            call assertEqual(status, error%status)
        end subroutine refused
    end subroutine refusals_have_words
end module test_gsl_odeiv
