module test_double_pendulum
    !! The double pendulum against numbers, forces and limits that its code does not contain.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertGreaterThan, assertTrue
    use lagrangia_description, only: description_t
    use lagrangia_double_pendulum, only: double_pendulum_t
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_rk4, only: new_rk4, rk4_t
    use lagrangia_system, only: lanes
    use motion, only: flow_derivative, newton_lagrangian, point_accelerations
    use random_states, only: draw_parameters, draw_state, restart_random
    implicit none (type, external)
    private
    public :: double_pendulum_suite

contains

    function double_pendulum_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("double_pendulum")
        call suite%addTest(TestMethod("lagrangian_is_that_of_two_bobs", &
                                      lagrangian_is_that_of_two_bobs, setUp=restart_random))
        call suite%addTest(TestMethod("tensions_move_the_bobs", tensions_move_the_bobs, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("small_oscillations_as_in_closed_form", &
                                      small_oscillations_as_in_closed_form))
        call suite%addTest(TestMethod("released_at_right_angles_as_mpmath", &
                                      released_at_right_angles_as_mpmath))
        call suite%addTest(TestMethod("a_light_bob_falls_by_its_weight", &
                                      a_light_bob_falls_by_its_weight))
        call suite%addTest(TestMethod("angular_momentum_needs_no_gravity", &
                                      angular_momentum_needs_no_gravity))
    end function double_pendulum_suite

    subroutine lagrangian_is_that_of_two_bobs()
        !! L is T - V of the two bobs in Cartesian coordinates.
        type(double_pendulum_t) :: system
        type(hyperdual_t) :: l
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t, expected
        integer :: i

        do i = 1, 20
            call draw_parameters(system, edges=.false.)
            call draw_state(system, t, q, v)
            l = system%lagrangian(hyperdual(t), hyperdual(q), hyperdual(v))
            expected = newton_lagrangian(system, t, q, v, system%g)
            call assertEqual(expected, l%re, 1e-13_dp*(system%g + 100.0_dp), "T - V")
        end do
    end subroutine lagrangian_is_that_of_two_bobs

    subroutine tensions_move_the_bobs()
        !! Newton's law for each bob: weight and the pull of its rods.
        type(double_pendulum_t) :: system
        real(dp), allocatable :: q(:), v(:), r(:, :), a(:, :)
        real(dp) :: t, upper(3), lower(3), weight(3), size_of_force
        integer :: i

        do i = 1, 20
            call draw_parameters(system, edges=.false.)
            call draw_state(system, t, q, v)
            call point_accelerations(system, t, q, v, r, a)
            weight = [0.0_dp, -system%g, 0.0_dp]
            upper = -r(:, 1)/norm2(r(:, 1))*system%quantity(2, t, q, v)
            lower = (r(:, 1) - r(:, 2))/norm2(r(:, 1) - r(:, 2))*system%quantity(3, t, q, v)
            size_of_force = norm2(upper) + norm2(lower) + (system%m1 + system%m2)*system%g
            call assertEqual(system%m2*(a(:, 2) - weight), lower, 1e-13_dp*size_of_force, "bob2")
            call assertEqual(system%m1*(a(:, 1) - weight), upper - lower, &
                             1e-13_dp*size_of_force, "bob1")
        end do
    end subroutine tensions_move_the_bobs

    subroutine small_oscillations_as_in_closed_form()
        !! \(-\partial a/\partial q\) at the bottom has the closed form's \(\omega^2\): their sum
        !! as trace, their product as determinant. Differences of order 4 have an error of
        !! \(h^4/30\) times fifth derivatives of up to 10000, that is 4e-10; times 25 in a product.
        type(double_pendulum_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: k(2, 2)

        call system%configure([1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp, 9.81_dp], error)
        k = stiffness(system)
        call assertEqual(5.74656495311993757_dp + 33.4934350468800624_dp, k(1, 1) + k(2, 2), &
                         4e-10_dp, "sum, all equal")
        call assertEqual(5.74656495311993757_dp*33.4934350468800624_dp, &
                         k(1, 1)*k(2, 2) - k(1, 2)*k(2, 1), 1e-8_dp, "product, all equal")
        call system%configure([1.3_dp, 0.7_dp, 0.9_dp, 1.7_dp, 9.81_dp], error)
        k = stiffness(system)
        call assertEqual(4.59707326208887721_dp + 21.0499855614405346_dp, k(1, 1) + k(2, 2), &
                         4e-10_dp, "sum")
        call assertEqual(4.59707326208887721_dp*21.0499855614405346_dp, &
                         k(1, 1)*k(2, 2) - k(1, 2)*k(2, 1), 1e-8_dp, "product")
    end subroutine small_oscillations_as_in_closed_form

    function stiffness(system) result(k)
        !! \(M^{-1}K\) at the bottom.
        type(double_pendulum_t), intent(in) :: system
        real(dp) :: k(2, 2)
        real(dp), parameter :: h = 1e-3_dp
        real(dp), dimension(2) :: q, still, a, b, c, d
        integer :: j

        still = 0.0_dp
        do j = 1, 2
            q = 0.0_dp
            q(j) = h
            call system%accelerations(0.0_dp, q, still, a)
            call system%accelerations(0.0_dp, -q, still, b)
            call system%accelerations(0.0_dp, 2.0_dp*q, still, c)
            call system%accelerations(0.0_dp, -2.0_dp*q, still, d)
            k(:, j) = -(8.0_dp*(a - b) - (c - d))/(12.0_dp*h)
        end do
    end function stiffness

    subroutine released_at_right_angles_as_mpmath()
        !! Both rods horizontal, at rest: states from Taylor series in 22 digits. RK4 with this
        !! step has an error of 1e-11.
        type(double_pendulum_t) :: system
        type(rk4_t) :: method
        type(error_t), allocatable :: error
        real(dp) :: q(2), v(2)
        real(dp), parameter :: h = 1.0_dp/8192.0_dp
        integer(i8), parameter :: second = 8192_i8

        call system%configure([1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp, 9.81_dp], error)
        call new_rk4(method)
        call method%prepare(system, error)
        call assertFalse(allocated(error), "rk4 takes it")
        q = acos(0.0_dp)
        v = 0.0_dp
        call method%start(system, 0.0_dp, q, v)
        call method%advance(system, 0.0_dp, h, 0_i8, second, q, v)
        call assertEqual([-0.62508769980639063_dp, -1.03458508568001234_dp], q, 1e-11_dp, "q(1)")
        call assertEqual([-3.92227957288797662_dp, -1.30309924869633124_dp], v, 1e-11_dp, "v(1)")
        call method%advance(system, 0.0_dp, h, second, second, q, v)
        call assertEqual([-0.482971534251754377_dp, -1.32404871230236255_dp], q, 1e-11_dp, "q(2)")
        call assertEqual([3.06528819207340132_dp, 2.94927154757161898_dp], v, 1e-11_dp, "v(2)")
        call method%advance(system, 0.0_dp, h, 2*second, 3*second, q, v)
        call assertEqual([-0.62718670506653073_dp, -1.30131555020981168_dp], q, 1e-11_dp, "q(5)")
        call assertEqual([2.12540867384291065_dp, 3.88188872726560744_dp], v, 1e-11_dp, "v(5)")
    end subroutine released_at_right_angles_as_mpmath

    subroutine a_light_bob_falls_by_its_weight()
        !! Both rods in line and at rest: the upper bob feels its own weight only, however light
        !! it is, and the lower rod does not turn yet. Scalar and lanes to a few roundings.
        type(double_pendulum_t) :: system
        type(error_t), allocatable :: error
        real(dp) :: a(2), q(lanes, 2), v(lanes, 2), many(lanes, 2)
        real(dp) :: expected
        integer :: k

        do k = 0, 300, 20
            call system%configure([10.0_dp**(-k), 1.0_dp, 0.7_dp, 1.6_dp, 9.81_dp], error)
            call system%accelerations(0.0_dp, [1.0_dp, 1.0_dp], [0.0_dp, 0.0_dp], a)
            expected = -9.81_dp*sin(1.0_dp)/0.7_dp
            call assertEqual(expected, a(1), 8.0_dp*spacing(expected), "theta1_ddot")
            call assertEqual(0.0_dp, a(2), message="theta2_ddot")
            q = 1.0_dp
            v = 0.0_dp
            call system%accelerations_lanes(v(:, 1), q, v, many)
            call assertEqual(spread(expected, 1, lanes), many(:, 1), 16.0_dp*spacing(expected), &
                             "theta1_ddot in lanes")
            call assertEqual(spread(0.0_dp, 1, lanes), many(:, 2), message="theta2_ddot in lanes")
        end do
    end subroutine a_light_bob_falls_by_its_weight

    subroutine angular_momentum_needs_no_gravity()
        !! L_z is declared conserved without gravity only, and changes with it.
        type(double_pendulum_t) :: system
        type(description_t) :: d
        type(error_t), allocatable :: error
        real(dp) :: rate, scale

        call system%configure([1.3_dp, 0.7_dp, 0.9_dp, 1.7_dp, 9.81_dp], error)
        call system%describe(d)
        call assertFalse(d%quantities(1)%conserved, "not d%quantities(1)%conserved")
        call flow_derivative(system, 1, 0.0_dp, [0.3_dp, 0.4_dp], [0.5_dp, -0.6_dp], rate, scale)
        call assertGreaterThan(abs(rate), 1.0_dp)
        call system%configure([1.3_dp, 0.7_dp, 0.9_dp, 1.7_dp, 0.0_dp], error)
        call system%describe(d)
        call assertTrue(d%quantities(1)%conserved, "d%quantities(1)%conserved")
        call assertEqual("L_z", d%quantities(1)%name)
    end subroutine angular_momentum_needs_no_gravity
end module test_double_pendulum
