module test_small_oscillations
    !! Frequencies to the last digit, labels, and what must be refused.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertLessThan, assertTrue
    use lagrangia_catalogue, only: new_system, nth_system
    use lagrangia_charged_particle, only: charged_particle_t
    use lagrangia_description, only: description_t
    use lagrangia_eigen, only: normal_modes, residual_ratio
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_linearised, only: linearised_t
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_small_oscillations, only: find_modes, is_oscillation, is_unstable, is_zero_mode, &
                                            modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    use random_states, only: draw_parameters, restart_random
    use stated_text, only: is_said
    implicit none (type, external)
    private
    public :: small_oscillations_suite

    integer, parameter :: quad = selected_real_kind(30)

    type, extends(charged_particle_t) :: wrong_turn_t
        !! G of the page is twice what it is.
    contains
        procedure :: linearise => linearise_wrongly
    end type wrong_turn_t

contains

    function small_oscillations_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("small_oscillations")
        call suite%addTest(TestMethod("cart_pendulum_has_two", cart_pendulum_has_two))
        call suite%addTest(TestMethod("graded_double_pendulums", graded_double_pendulums))
        call suite%addTest(TestMethod("page_agrees_with_lagrangian", page_agrees_with_lagrangian, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("other_equilibria", other_equilibria))
        call suite%addTest(TestMethod("modes_are_normalised", modes_are_normalised))
        call suite%addTest(TestMethod("hilbert_like_is_well_solved", hilbert_like_is_well_solved))
        call suite%addTest(TestMethod("bad_matrices_are_refused", bad_matrices_are_refused))
        call suite%addTest(TestMethod("bad_points_are_refused", bad_points_are_refused))
        call suite%addTest(TestMethod("a_wrong_turn_is_seen", a_wrong_turn_is_seen))
        call suite%addTest(TestMethod("many_coordinates_are_divided", many_coordinates_are_divided))
    end function small_oscillations_suite

    subroutine solve(name, values, at, modes)
        !! The modes of a system with these parameters.
        character(*), intent(in) :: name
        real(dp), intent(in) :: values(:), at(:)
        type(modes_t), intent(out) :: modes
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error

        call new_system(name, system, error)
        call system%configure(values, error)
        call assertFalse(allocated(error), message=name)
        call find_modes(system, at, .true., modes, error)
        call assertFalse(allocated(error), message=name//" modes")
    end subroutine solve

    subroutine cart_pendulum_has_two()
        !! A zero mode, exactly, and \((m_1+m_2)g/(m_1\ell)\); its shape slides against the swing.
        type(modes_t) :: modes

        call solve("cart_pendulum", [2.0_dp, 0.5_dp, 1.3_dp, 9.81_dp], [0.0_dp, 0.0_dp], modes)
        call assertEqual(is_zero_mode, modes%label(1))
        call assertEqual(0.0_dp, modes%omega2(1), 0.0_dp)
        call assertEqual(is_oscillation, modes%label(2))
        call assertEqual(2.5_dp*9.81_dp/2.6_dp, modes%omega2(2), 1e-14_dp*modes%omega2(2))
        call assertEqual(-0.26_dp, modes%shapes(1, 2)/modes%shapes(2, 2), 1e-15_dp)
    end subroutine cart_pendulum_has_two

    subroutine graded_double_pendulums()
        !! Mass and length ratios from 1e-12 to 1e12: both frequencies within 1e-14 of the closed
        !! form in quadruple precision, where `dsygv` loses the slower one.
        real(dp), parameter :: g = 9.81_dp
        type(modes_t) :: modes
        real(quad) :: mu, l1, l2, a, b, c, large, small
        integer :: i, k

        do i = -12, 12, 3
            do k = -12, 12, 3
                call solve("double_pendulum", [1.3_dp, 1.3_dp*10.0_dp**i, 0.7_dp, &
                                               0.7_dp*10.0_dp**k, g], [0.0_dp, 0.0_dp], modes)
                mu = real(1.3_dp*10.0_dp**i, quad)/1.3_dp
                l1 = 0.7_dp
                l2 = 0.7_dp*10.0_dp**k
                a = (1.0_quad + mu)*g/l1
                b = g/l2
                c = (1.0_quad + mu)*g/l2
                large = 0.5_quad*(a + c + sqrt((a - c)**2 + 4.0_quad*a*mu*b))
                small = a*b/large
                call assertLessThan(real(abs(modes%omega2(1)/small - 1.0_quad), dp), 1e-14_dp, &
                                    message="the slow mode")
                call assertLessThan(real(abs(modes%omega2(2)/large - 1.0_quad), dp), 1e-14_dp, &
                                    message="the fast mode")
                call assertLessThan(maxval(abs(modes%analytic%omega2/modes%omega2 - 1.0_dp)), &
                                    1e-14_dp, message="the page")
            end do
        end do
    end subroutine graded_double_pendulums

    subroutine page_agrees_with_lagrangian()
        !! For every system of the catalogue that has modes, at random parameters: M, K and G by
        !! hand against second derivatives of L, and the closed form against LAPACK.
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        type(modes_t) :: modes
        real(dp), allocatable :: at(:)
        integer :: i, draw, by_hand

        by_hand = 0
        i = 0
        do
            i = i + 1
            call nth_system(i, system)
            if (.not. allocated(system)) exit
            do draw = 1, 10
                call draw_parameters(system, edges=.false.)
                call system%describe(d)
                allocate (at(system%ndof), source=0.0_dp)
                call find_modes(system, at, .false., modes, error)
                deallocate (at)
                if (allocated(error)) cycle
                if (.not. allocated(modes%analytic%mass)) cycle
                by_hand = by_hand + 1
                call assertLessThan(modes%difference, 100*epsilon(1.0_dp), &
                                    message=trim(d%name)//": page and L")
                if (allocated(modes%analytic%omega2)) call assertEqual( &
                    modes%analytic%omega2, modes%omega2, 1e-13_dp*maxval(abs(modes%omega2)), &
                    trim(d%name)//": closed form")
                call assertLessThan(modes%ratio, 30.0_dp, message=trim(d%name)//": residual")
            end do
        end do
        call assertEqual(70, by_hand, "systems with a page")  ! the oscillator is driven
    end subroutine page_agrees_with_lagrangian

    subroutine other_equilibria()
        !! Upside down, tilted, on the axis: growth rates and frequencies.
        real(dp), parameter :: pi = acos(-1.0_dp)
        type(modes_t) :: modes

        call solve("pendulum", [0.7_dp, 1.3_dp, 9.81_dp], [pi], modes)
        call assertEqual(is_unstable, modes%label(1))
        call assertEqual(-9.81_dp/1.3_dp, modes%omega2(1), 1e-14_dp)
        call solve("cart_pendulum", [2.0_dp, 0.5_dp, 1.3_dp, 9.81_dp], [0.3_dp, pi], modes)
        call assertEqual([is_unstable, is_zero_mode], modes%label)
        call solve("charged_particle", [1.3_dp, 0.7_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.3_dp, 0.4_dp, &
                                        2.0_dp, 0.0_dp], [0.1_dp, 0.2_dp, 0.3_dp], modes)
        call assertEqual([is_zero_mode, is_zero_mode, is_oscillation], modes%label)
        call solve("rotating_hoop", [0.4_dp, 1.0_dp, 3.0_dp, 9.81_dp], [0.0_dp], modes)
        call assertFalse(allocated(modes%analytic%elsewhere), "turned slowly: the bottom alone")
        call solve("rotating_hoop", [0.4_dp, 1.0_dp, 5.0_dp, 9.81_dp], [0.0_dp], modes)
        call assertEqual([1.16755690380504296_dp], modes%analytic%elsewhere, &
                         4.0_dp*epsilon(pi), "tilt")
        call solve("rotating_hoop", [0.4_dp, 1.0_dp, 5.0_dp, 9.81_dp], [1.16755690380504296_dp], &
                   modes)
        call assertEqual(21.150556_dp, modes%omega2(1), 1e-12_dp)
        call solve("rotating_wire", [0.4_dp, 1.5_dp], [0.0_dp], modes)
        call assertEqual(-2.25_dp, modes%omega2(1), 1e-15_dp)
        call solve("charged_particle", [1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, &
                                        0.5_dp, 1.0_dp], [0.0_dp, 0.0_dp, 0.0_dp], modes)
        call assertEqual([0.780776406404415137_dp, 1.0_dp, 1.28077640640441514_dp], &
                         sqrt(modes%omega2), 1e-14_dp)
        call assertLessThan(modes%ratio, 30.0_dp, message="gyroscopic residual")
    end subroutine other_equilibria

    subroutine modes_are_normalised()
        !! \(u^\top M u = 1\), \(K\)-orthogonal, ascending, the largest component positive.
        real(dp) :: k(3, 3), m(3, 3), unit(3, 3)
        real(dp), allocatable :: omega2(:), u(:, :)
        type(error_t), allocatable :: error
        integer :: i, j

        k = reshape([3.0_dp, -1.0_dp, 0.2_dp, -1.0_dp, 2.0_dp, -0.7_dp, 0.2_dp, -0.7_dp, 1.5_dp], &
                    [3, 3])
        m = reshape([2.0_dp, 0.3_dp, 0.1_dp, 0.3_dp, 1.0_dp, 0.2_dp, 0.1_dp, 0.2_dp, 0.6_dp], &
                    [3, 3])
        call normal_modes(k, m, omega2, u, error)
        call assertFalse(allocated(error), "no error: modes are normalised")
        if (allocated(error)) return
        unit = 0.0_dp
        do j = 1, 3
            unit(j, j) = 1.0_dp
            call assertTrue(maxval(u(:, j)) >= maxval(-u(:, j)), message="sign")
        end do
        call assertEqual(unit, matmul(transpose(u), matmul(m, u)), 1e-14_dp)
        do j = 1, 3
            unit(j, j) = omega2(j)
        end do
        call assertEqual(unit, matmul(transpose(u), matmul(k, u)), 1e-14_dp)
        call assertTrue(omega2(1) < omega2(2) .and. omega2(2) < omega2(3), &
                        "omega2(1) < omega2(2) .and. omega2(2) < omega2(3)")
        call assertLessThan(residual_ratio(k, m, omega2, u), 30.0_dp)
        do i = 1, 3  ! with each coordinate turned round in its turn
            k(i, :) = -k(i, :)
            k(:, i) = -k(:, i)
            m(i, :) = -m(i, :)
            m(:, i) = -m(:, i)
            call normal_modes(k, m, omega2, u, error)
            call assertTrue(all(maxval(u, 1) >= maxval(-u, 1)), message="sign, turned")
        end do
    end subroutine modes_are_normalised

    subroutine hilbert_like_is_well_solved()
        !! Degenerate, and large enough for divide and conquer: a ring of 40 equal masses, whose
        !! frequencies are \(4\sin^2(\pi j/n)\), in pairs, the lowest zero.
        integer, parameter :: n = 40
        real(dp), parameter :: pi = acos(-1.0_dp)
        real(dp) :: k(n, n), m(n, n)
        real(dp), allocatable :: omega2(:), u(:, :)
        type(error_t), allocatable :: error
        integer :: i

        k = 0.0_dp
        m = 0.0_dp
        do i = 1, n
            m(i, i) = 0.5_dp
            k(i, i) = 1.0_dp
            k(i, modulo(i, n) + 1) = -0.5_dp
            k(modulo(i, n) + 1, i) = -0.5_dp
        end do
        call normal_modes(k, m, omega2, u, error)
        call assertFalse(allocated(error), "no error: hilbert like is well solved")
        if (allocated(error)) return
        do i = 1, n
            call assertEqual(4.0_dp*sin(pi*(i/2)/n)**2, omega2(i), 1e-14_dp)
        end do
        call assertLessThan(residual_ratio(k, m, omega2, u), 30.0_dp)
    end subroutine hilbert_like_is_well_solved

    subroutine bad_matrices_are_refused()
        !! In one line each; LAPACK alone would be silent about most of them.
        real(dp) :: good(2, 2), bad(2, 2)

        good = reshape([2.0_dp, 0.5_dp, 0.5_dp, 1.0_dp], [2, 2])
        call refused(reshape([1.0_dp, 2.0_dp], [1, 2]), good, &
                     "K is 1 by 2: a square matrix is needed")
        call refused(reshape([1.0_dp], [1, 1]), good, "K has 1 rows, M has 2")
        bad = good
        bad(1, 2) = 0.4_dp
        call refused(bad, good, "K is not symmetric: K(1, 2) = 0.4, K(2, 1) = 0.5")
        call refused(good, bad, "M is not symmetric: M(1, 2) = 0.4, M(2, 1) = 0.5")
        bad = good
        bad(2, 2) = ieee_value(1.0_dp, ieee_quiet_nan)
        call refused(good, bad, "M(2, 2) is not finite")
        bad(2, 2) = -1.0_dp
        call refused(good, bad, "M is not positive definite: its leading minor of order 2 is not")
        bad(1, 1) = -1.0_dp
        call refused(good, bad, "M is not positive definite: its leading minor of order 1 is not")
        bad = good
        bad(1, 2) = 0.5_dp + 1e-14_dp
        call refused(bad, good, "K is not symmetric: K(1, 2) = 0.50000000000001, K(2, 1) = 0.5")
        call refused(good*1e200_dp, good*1e-200_dp, "M or K, or omega^2, is beyond the range "// &
                     "of doubles: other units are needed")
        bad = 0.5_dp  ! rounding decides whether Cholesky's method notices
        call refused(good, bad, "M is singular to working precision: its leading minor of "// &
                     "order 2 vanishes")
    end subroutine bad_matrices_are_refused

    subroutine refused(k, m, message)
        !! Assert that these matrices are refused in these words, without results.
        real(dp), intent(in) :: k(:, :), m(:, :)
        character(*), intent(in) :: message
        real(dp), allocatable :: omega2(:), u(:, :)
        type(error_t), allocatable :: error

        call normal_modes(k, m, omega2, u, error)
        call assertTrue(allocated(error), message=message)
        if (.not. allocated(error)) return
        call assertEqual(message, error%message)
        call assertFalse(allocated(omega2), message="results of "//message)
    end subroutine refused

    subroutine bad_points_are_refused()
        !! With the residual force and the nearest equilibrium.
        call no_modes("rotating_hoop", [1.167_dp], "not an equilibrium of rotating_hoop: the "// &
                      "force on theta is 0.0117746253... N m; the nearest is ...")
        call no_modes("pendulum", [1.0_dp], "the nearest is 0.0")
        call no_modes("rotating_hoop", [1.167_dp], "N m; the nearest is 1.1675569038050...")
        call no_modes("wedge", [0.0_dp, 0.0_dp], "N; none is near")
        call no_modes("pendulum", [ieee_value(1.0_dp, ieee_quiet_nan)], "a place for the modes "// &
                      "of pendulum is no finite number: nan")
        ! a zero mode: the stiffness is singular, and where the cart stands is as it was
        call no_modes("cart_pendulum", [0.3_dp, 0.1_dp], "the nearest is 0.3,0.0")
        call no_modes("pendulum", [0.0_dp, 1.0_dp], "an equilibrium of pendulum has 1 value, "// &
                                                    "not 2; a decimal point, no comma, is "// &
                                                    "needed in a number")
        call no_modes("rolling_disk", [0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], &
                      "its constraints are nonholonomic: steady motions, but no modes about "// &
                      "an equilibrium")
        call no_modes("driven_pendulum", [0.0_dp], "contains the time: there are no normal "// &
                                                   "modes about a place at rest")
        ! of whatever size they are: M is 1e-9 kg m^2, and K changes by as little
        call no_modes("driven_pendulum", [0.0_dp], "contains the time: there are no normal "// &
                                                   "modes about a place at rest", &
                      [1e-9_dp, 1.0_dp, 1.0_dp, 0.1_dp, 2.0_dp, 0.0_dp])
        call no_modes("pendulum", [0.0_dp], "M or K, or omega^2, is beyond the range of "// &
                                            "doubles: other units are needed", &
                      [1.0_dp, 1e-200_dp, 9.81_dp, 0.0_dp])
    end subroutine bad_points_are_refused

    subroutine no_modes(name, at, message, parameters)
        !! Assert that there are no modes at `at`, for this reason.
        character(*), intent(in) :: name, message
        real(dp), intent(in) :: at(:)
        real(dp), intent(in), optional :: parameters(:)
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        type(modes_t) :: modes

        call new_system(name, system, error)
        if (present(parameters)) call system%configure(parameters, error)
        call find_modes(system, at, .true., modes, error)
        call assertTrue(allocated(error), message=name)
        if (.not. allocated(error)) return
        call assertTrue(is_said(error%message, message), message=error%message)
        if (.not. present(parameters)) call assertEqual(2, error%status)
    end subroutine no_modes

    subroutine a_wrong_turn_is_seen()
        !! M and K are right, G is not: the difference is as large as G.
        type(wrong_turn_t) :: charge
        type(error_t), allocatable :: error
        type(modes_t) :: modes

        call charge%configure([1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, &
                               1.0_dp], error)
        call find_modes(charge, [0.0_dp, 0.0_dp, 0.0_dp], .false., modes, error)
        call assertFalse(allocated(error), "a charge in a trap")
        if (allocated(error)) return
        call assertEqual(1.0_dp, modes%difference, tolerance=1e-14_dp)
    end subroutine a_wrong_turn_is_seen

    subroutine many_coordinates_are_divided()
        !! Beyond 32 LAPACK divides and conquers.
        call judge("32", "dsygv")
        call judge("33", "dsygvd")
    contains
        subroutine judge(n, method)
            character(*), intent(in) :: n, method
            class(system_t), allocatable :: system
            type(error_t), allocatable :: error
            type(scene_t) :: scene
            type(word_t) :: none(0)
            type(modes_t) :: modes
            integer :: i

            call parse_scene("&scene system = 'o', dt = 1, duration = 1, q = "//n//"*0.1 / "// &
                             "&lagrangian coordinates = 'x_1 .. x_"//n//"', parameters = 'm', "// &
                             "T = 'sum(i, 1, "//n//", m/2 x_i_dot^2)', V = 'sum(i, 1, "//n// &
                             ", m/2 x_i^2)' / &o m = 1 /", "text", none, scene, system, error)
            call assertFalse(allocated(error), n//" masses on springs")
            if (allocated(error)) return
            call find_modes(system, [(0.0_dp, i=1, system%ndof)], .false., modes, error)
            call assertFalse(allocated(error), n//" modes")
            if (.not. allocated(error)) call assertEqual(method, trim(modes%method))
        end subroutine judge
    end subroutine many_coordinates_are_divided

    pure subroutine linearise_wrongly(self, q, analytic)
        !! M and K as they are.
        class(wrong_turn_t), intent(in) :: self
        real(dp), intent(in) :: q(self%ndof)
        type(linearised_t), intent(out) :: analytic

        call self%charged_particle_t%linearise(q, analytic)
        analytic%gyroscopic = 2.0_dp*analytic%gyroscopic
    end subroutine linearise_wrongly
end module test_small_oscillations
