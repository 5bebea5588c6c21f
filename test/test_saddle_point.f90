module test_saddle_point
    !! Equations with multipliers keep their digits whatever the masses are beside the constraints.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertRelativelyEqual, &
                     assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrange, only: accelerations_from_lagrangian
    use lagrangia_saddle_point, only: scale_saddle_point, solve_saddle_point
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: saddle_point_suite

    real(dp), parameter :: loss = 1e3_dp*epsilon(1.0_dp)
    real(dp), parameter :: masses(7) = [1.0_dp, 1e-12_dp, 9.1e-31_dp, 1e-100_dp, 1e12_dp, 1e30_dp, &
                                        1e100_dp]

contains

    function saddle_point_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("saddle_point")
        call suite%addTest(TestMethod("a_rod_holds_any_mass", a_rod_holds_any_mass))
        call suite%addTest(TestMethod("a_light_pulley", a_light_pulley))
        call suite%addTest(TestMethod("a_large_wheel", a_large_wheel))
        call suite%addTest(TestMethod("units_make_coefficients_of_one", &
                                      units_make_coefficients_of_one))
        call suite%addTest(TestMethod("what_is_singular_is_refused", what_is_singular_is_refused))
        call suite%addTest(TestMethod("an_electron_on_a_ring", an_electron_on_a_ring))
    end function saddle_point_suite

    subroutine a_rod_holds_any_mass()
        !! At rest at 60 degrees, \(\ddot s = -g\sin\theta\) along the circle, the rod pulls with
        !! \(m g\cos\theta\); its constraint \(x^2 + y^2\) has the slope \(2l\).
        real(dp), parameter :: g = 9.81_dp, l = 1.7_dp, s = sqrt(0.75_dp), c = 0.5_dp
        real(dp) :: matrix(3, 3), z(3)
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, size(masses)
            associate (m => masses(i))
                matrix = reshape([m, 0.0_dp, 2*l*s, 0.0_dp, m, -2*l*c, -2*l*s, 2*l*c, 0.0_dp], &
                                 [3, 3])
                call solve_saddle_point(matrix, [0.0_dp, -m*g, 0.0_dp], z, error)
                call assertFalse(allocated(error), "regular")
                call assertRelativelyEqual([-g*s*c, -g*s*s, -m*g*c/(2*l)], z, loss, "falls")
            end associate
        end do
    end subroutine a_rod_holds_any_mass

    subroutine a_light_pulley()
        !! Atwood's machine with two strings on a pulley of the inertia I, \(\ddot x_1 =
        !! (m_1 - m_2) g/(m_1 + m_2 + I/R^2)\): by \(x_1 = R\theta\), \(x_2 = -R\theta\).
        real(dp), parameter :: m1 = 3.0_dp, m2 = 2.0_dp, g = 9.81_dp
        real(dp), parameter :: inertias(4) = [1.0_dp, 1e-12_dp, 1e-30_dp, 1e30_dp]
        real(dp), parameter :: radii(3) = [1.0_dp, 1e-10_dp, 1e10_dp]
        real(dp) :: matrix(5, 5), z(5), a
        type(error_t), allocatable :: error
        integer :: i, k

        do i = 1, size(inertias)
            do k = 1, size(radii)
                associate (r => radii(k), inertia => inertias(i))
                    matrix = 0.0_dp
                    matrix(1, 1) = m1
                    matrix(2, 2) = m2
                    matrix(3, 3) = inertia
                    matrix(4, :3) = [1.0_dp, 0.0_dp, -r]
                    matrix(5, :3) = [0.0_dp, 1.0_dp, r]
                    matrix(:3, 4:) = -transpose(matrix(4:, :3))
                    call solve_saddle_point(matrix, [m1*g, m2*g, 0.0_dp, 0.0_dp, 0.0_dp], z, error)
                    call assertFalse(allocated(error), "regular")
                    a = (m1 - m2)*g/(m1 + m2 + inertia/r**2)
                    call assertRelativelyEqual([a, -a, a/r], z(:3), 1e3_dp*loss, "accelerations")
                end associate
            end do
        end do
    end subroutine a_light_pulley

    subroutine a_large_wheel()
        !! A disk that rolls along (0.6, 0.8), pushed along x by F: \((I + m r^2)\ddot\phi =
        !! 0.6\,r F\).
        real(dp), parameter :: f = 2.5_dp, m = 1.7_dp, inertia = 1.3_dp
        real(dp), parameter :: radii(4) = [1.0_dp, 1e8_dp, 1e12_dp, 1e16_dp]
        real(dp) :: matrix(5, 5), z(5)
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, size(radii)
            associate (r => radii(i))
                matrix = 0.0_dp
                matrix(1, 1) = m
                matrix(2, 2) = m
                matrix(3, 3) = inertia
                matrix(4, :3) = [1.0_dp, 0.0_dp, -0.6_dp*r]
                matrix(5, :3) = [0.0_dp, 1.0_dp, -0.8_dp*r]
                matrix(:3, 4:) = -transpose(matrix(4:, :3))
                call solve_saddle_point(matrix, [f, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], z, error)
                call assertFalse(allocated(error), "regular")
                call assertRelativelyEqual(0.6_dp*f/(inertia/r**2 + m), r*z(3), loss, "r phi_ddot")
            end associate
        end do
    end subroutine a_large_wheel

    subroutine units_make_coefficients_of_one()
        !! \(|K_{ij}|S_iS_j\) is at most 2, and for some permutation at least 1/2: by hand, of a
        !! mass of 1e-30 on a rod with the slope (3, 4), both equations, in which 4 and 3 take
        !! part, and the mass.
        real(dp), parameter :: m = 1e-30_dp
        real(dp), parameter :: matrix(3, 3) = reshape([m, 0.0_dp, 3.0_dp, 0.0_dp, m, 4.0_dp, &
                                                       -3.0_dp, -4.0_dp, 0.0_dp], [3, 3])
        real(dp) :: scaled(3, 3), unit(3)
        integer :: i

        call scale_saddle_point(matrix, scaled, unit)
        do i = 1, 3
            call assertTrue(maxval(abs(matrix(:, i))*unit)*unit(i) <= 2.0_dp, "none is large")
            call assertTrue(maxval(abs(matrix(:, i))*unit)*unit(i) >= 0.25_dp, "nor a column small")
            call assertEqual(0.5_dp, fraction(unit(i)), 0.0_dp, "a power of 2")
        end do
        call assertTrue(m*unit(1)**2 >= 0.5_dp, "the mass counts")
    end subroutine units_make_coefficients_of_one

    subroutine what_is_singular_is_refused()
        !! A constraint stated twice, no mass at all, a coefficient that is no number.
        real(dp) :: matrix(3, 3), z(3)
        type(error_t), allocatable :: error

        matrix = reshape([1.0_dp, 1.0_dp, 2.0_dp, -1.0_dp, 0.0_dp, 0.0_dp, -2.0_dp, 0.0_dp, &
                          0.0_dp], [3, 3])
        call solve_saddle_point(matrix, [1.0_dp, 0.0_dp, 0.0_dp], z, error)
        call assertTrue(allocated(error), "twice")
        call assertEqual(spread(0.0_dp, 1, 3), z, 0.0_dp, "zero after an error")
        call solve_saddle_point(0.0_dp*matrix, [1.0_dp, 0.0_dp, 0.0_dp], z, error)
        call assertTrue(allocated(error), "nothing")
        matrix(1, 1) = sqrt(-matrix(1, 1))
        call solve_saddle_point(matrix, [1.0_dp, 0.0_dp, 0.0_dp], z, error)
        call assertTrue(allocated(error), "no number")
    end subroutine what_is_singular_is_refused

    subroutine an_electron_on_a_ring()
        !! Of any mass: its accelerations are the same, and a place off the ring is put onto it.
        class(system_t), allocatable :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error
        type(word_t) :: none(0)
        real(dp) :: a(2), multipliers(1), q(2), v(2)
        character(24) :: mass
        integer :: i

        do i = 1, size(masses)
            write (mass, "(es24.16e3)") masses(i)
            if (allocated(system)) deallocate (system)
            call parse_scene("&scene system = 'ring', dt = 0.1, duration = 1.0, q = 0.6, -0.8 /"// &
                             new_line("a")//"&lagrangian coordinates = 'x', 'y', parameters = "// &
                             "'m', 'g', T = 'm/2 (x_dot^2 + y_dot^2)', V = 'm g y', "// &
                             "constraint = 'x^2 + y^2 = 1' /"//new_line("a")// &
                             "&ring m = "//mass//", g = 9.81 /", "scene", none, scene, &
                             system, error)
            call assertFalse(allocated(error), "m = "//mass)
            if (allocated(error)) return
            call accelerations_from_lagrangian(system, 0.0_dp, [0.6_dp, -0.8_dp], &
                                               [0.8_dp, 0.6_dp], a, multipliers, error)
            call assertFalse(allocated(error), "accelerations of m = "//mass)
            ! along the ring -0.6 g, inwards the square of the velocity, 1
            call assertEqual([-0.6_dp*0.8_dp*9.81_dp - 0.6_dp, -0.36_dp*9.81_dp + 0.8_dp], a, &
                             loss, "m = "//mass)
            q = [0.6_dp + 1e-6_dp, -0.8_dp]
            v = [0.8_dp, 0.6_dp]
            call system%keep_constraints(0.0_dp, q, v)
            call assertEqual(1.0_dp, norm2(q), loss, "on the ring, m = "//mass)
            call assertEqual(0.0_dp, dot_product(q, v), loss, "along it, m = "//mass)
        end do
    end subroutine an_electron_on_a_ring
end module test_saddle_point
