module test_least_time
    !! Stationary optical paths, and rays in graded media.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertGreaterThan, &
                     assertLessThan, assertRelativelyEqual
    use lagrangia_errors, only: error_t
    use lagrangia_gsl, only: brent_root
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian, energy_from_lagrangian
    use lagrangia_optical_paths, only: concave_mirror_t, elliptic_mirror_t, flat_mirror_t, &
                                       graded_medium_t, quartic_t, second_derivative, &
                                       stationary_point, surface_t
    use random_states, only: draw_parameters, draw_state, restart_random, uniform
    implicit none (type, external)
    private
    public :: least_time_suite

contains

    function least_time_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("least_time")
        call suite%addTest(TestMethod("mirrors", mirrors, setUp=restart_random))
        call suite%addTest(TestMethod("refraction", refraction, setUp=restart_random))
        call suite%addTest(TestMethod("graded_medium_follows_its_lagrangian", &
                                      graded_medium_follows_its_lagrangian, setUp=restart_random))
    end function least_time_suite

    subroutine mirrors()
        !! Hero's closed form with numbers at random; the geometry of the curved ones from
        !! distances that are typed in.
        type(flat_mirror_t) :: flat
        type(concave_mirror_t) :: concave
        type(elliptic_mirror_t) :: elliptic
        type(error_t), allocatable :: error
        real(dp) :: x
        integer :: i

        do i = 1, 20
            flat = flat_mirror_t(a=uniform(0.2_dp, 3.0_dp), b=uniform(0.2_dp, 3.0_dp), &
                                 d=uniform(0.2_dp, 3.0_dp))
            call stationary_point(flat, -1.0_dp, flat%d + 1.0_dp, x, error)
            call assertFalse(allocated(error), "no error: mirrors")
            call assertEqual(flat%a*flat%d/(flat%a + flat%b), x, 2e-14_dp)
            call assertRelativelyEqual(hypot(flat%d, flat%a + flat%b), flat%at(x), 1e-15_dp)
            call assertGreaterThan(second_derivative(flat, x), 0.0_dp)
        end do
        concave = concave_mirror_t(r=2.0_dp, s=0.6_dp)
        x = asin(0.6_dp)  ! the point (1.2, -1.6)
        call assertEqual(hypot(1.8_dp, 1.6_dp) + hypot(0.6_dp, 1.6_dp), concave%at(x), 1e-14_dp)
        call assertLessThan(second_derivative(concave, 0.0_dp), 0.0_dp)
        call assertEqual((concave%at(1e-3_dp) - concave%at(-1e-3_dp))/2e-3_dp, &
                         concave%value(0.0_dp), 1e-9_dp)
        call assertEqual((concave%at(x + 1e-4_dp) - concave%at(x - 1e-4_dp))/2e-4_dp, &
                         concave%value(x), 1e-8_dp)
        elliptic = elliptic_mirror_t(a=5.0_dp, b=3.0_dp)
        call assertEqual(10.0_dp, elliptic%at(0.0_dp), 1e-14_dp)
        call assertEqual(hypot(7.0_dp, 2.4_dp) + hypot(1.0_dp, 2.4_dp), &
                         elliptic%at(asin(0.6_dp)), 1e-14_dp)
        call assertEqual(10.0_dp, elliptic%at(asin(0.6_dp)), 1e-14_dp)
    end subroutine mirrors

    subroutine refraction()
        !! The numbers of 22-digit arithmetic; then Snell's law and the quartic at random.
        type(surface_t) :: s
        type(quartic_t) :: quartic
        type(error_t), allocatable :: error
        real(dp) :: x, root
        integer :: i

        s = surface_t(a=1.0_dp, b=1.0_dp, d=2.0_dp, n1=1.0_dp, n2=1.5_dp)
        call stationary_point(s, 0.0_dp, s%d, x, error)
        call assertEqual(1.3626502055346011661_dp, x, 1e-14_dp)
        call assertEqual(3.4689705938737185441_dp, s%at(x), 1e-14_dp)
        call restart_random()
        do i = 1, 20
            s = surface_t(a=uniform(0.2_dp, 2.0_dp), b=uniform(0.2_dp, 2.0_dp), &
                          d=uniform(0.2_dp, 2.0_dp), n1=uniform(1.0_dp, 2.0_dp), &
                          n2=uniform(1.0_dp, 2.0_dp))
            call stationary_point(s, 0.0_dp, s%d, x, error)
            call assertFalse(allocated(error), "no error: refraction")
            call assertEqual(s%n1*x/hypot(s%a, x), s%n2*(s%d - x)/hypot(s%b, s%d - x), 1e-14_dp)
            quartic%surface = s
            call brent_root(quartic, 0.0_dp, s%d, root, error)
            call assertFalse(allocated(error), "no error: refraction")
            call assertEqual(x, root, 1e-13_dp)
        end do
    end subroutine refraction

    subroutine graded_medium_follows_its_lagrangian()
        !! Equations and energy against L, at random.
        type(graded_medium_t) :: medium
        type(error_t), allocatable :: error
        real(dp), allocatable :: q(:), v(:)
        real(dp) :: t, a(2), expected(2), none(0)
        integer :: i

        do i = 1, 20
            call draw_parameters(medium, i > 10)
            call draw_state(medium, t, q, v)
            call medium%accelerations(t, q, v, a)
            call accelerations_from_lagrangian(medium, t, q, v, expected, none, error)
            call assertFalse(allocated(error), "no error: graded medium follows its lagrangian")
            call assertEqual(expected, a, 1e-12_dp)
            call assertEqual(energy_from_lagrangian(medium, t, q, v), medium%energy(t, q, v), &
                             1e-12_dp)
            call assertEqual(0.5_dp*(sum(v**2) - medium%index_squared(q(2))), &
                             medium%energy(t, q, v), 1e-12_dp)
        end do
    end subroutine graded_medium_follows_its_lagrangian
end module test_least_time
