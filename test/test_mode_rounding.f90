module test_mode_rounding
    !! No digit of a frequency or a shape is stated that rounding has taken, and none withheld.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertLessThan, assertTrue
    use lagrangia_catalogue, only: new_system
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_mode_rounding, only: find_rounding, mode_rounding_t
    use lagrangia_quadratic_eigen, only: quadratic_eigenvalues
    use lagrangia_scene, only: scene_t
    use lagrangia_scene_reader, only: parse_scene
    use lagrangia_small_oscillations, only: find_modes, modes_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: word_t
    use random_states, only: restart_random, uniform
    implicit none (type, external)
    private
    public :: mode_rounding_suite

    integer, parameter :: quad = selected_real_kind(30)
    real(dp), parameter :: eps = epsilon(1.0_dp)

contains

    function mode_rounding_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("mode_rounding")
        call suite%addTest(TestMethod("a_hoop_near_its_critical_rate", &
                                      a_hoop_near_its_critical_rate, setUp=restart_random))
        call suite%addTest(TestMethod("a_trap_in_a_weak_field", a_trap_in_a_weak_field, &
                                      setUp=restart_random))
        call suite%addTest(TestMethod("oscillators_by_a_stiff_spring", &
                                      oscillators_by_a_stiff_spring, setUp=restart_random))
        call suite%addTest(TestMethod("usual_modes_keep_their_digits", &
                                      usual_modes_keep_their_digits, setUp=restart_random))
        call suite%addTest(TestMethod("near_critical_damping", near_critical_damping))
        call suite%addTest(TestMethod("no_damping_takes_no_digit", no_damping_takes_no_digit))
        call suite%addTest(TestMethod("a_zero_across_a_field", a_zero_across_a_field))
        call suite%addTest(TestMethod("near_modes_have_unsure_shapes", &
                                      near_modes_have_unsure_shapes))
    end function mode_rounding_suite

    subroutine solve(name, values, modes, rounding)
        !! About zero.
        character(*), intent(in) :: name
        real(dp), intent(in) :: values(:)
        type(modes_t), intent(out) :: modes
        type(mode_rounding_t), intent(out) :: rounding
        class(system_t), allocatable :: system
        type(error_t), allocatable :: error
        real(dp), allocatable :: at(:)

        call new_system(name, system, error)
        call system%configure(values, error)
        call assertFalse(allocated(error), message=name)
        allocate (at(system%ndof), source=0.0_dp)
        call find_modes(system, at, .true., modes, error)
        call assertFalse(allocated(error), message=name//" modes")
        call find_rounding(system, modes, rounding)
    end subroutine solve

    subroutine read_own(group, system)
        !! Two coordinates, x and y.
        character(*), intent(in) :: group  !! parameters and L, and the parameters' values
        class(system_t), allocatable, intent(out) :: system
        type(scene_t) :: scene
        type(error_t), allocatable :: error

        call parse_scene("&scene system = 'own' q = 0, 0 dt = 0.01 duration = 1 / &lagrangian "// &
                         "coordinates = 'x', 'y' "//group//" /", "own.nml", [word_t ::], scene, &
                         system, error)
        call assertFalse(allocated(error), message="scene")
    end subroutine read_own

    subroutine a_hoop_near_its_critical_rate()
        !! \(\omega^2 = g/r - \Omega^2\), both known to half an epsilon: from 1e-1 to 1e-14 of
        !! them left, the error is never above what is said, and that is at most 8 epsilon of
        !! \(g/r\).
        type(modes_t) :: modes
        type(mode_rounding_t) :: rounding
        real(dp) :: r, turning, part
        real(quad) :: g, true
        integer :: i

        do i = 1, 400
            r = uniform(0.1_dp, 3.0_dp)
            part = uniform(-14.0_dp, -1.0_dp)
            turning = sqrt(9.81_dp/r*(1.0_dp - 10.0_dp**part))
            call solve("rotating_hoop", [0.7_dp, r, turning, 9.81_dp], modes, rounding)
            g = 9.81_quad  ! which the double is not
            true = g/r - real(turning, quad)**2
            call assertTrue(abs(modes%omega2(1) - true) <= rounding%squares(1), &
                            message="more than is said")
            call assertLessThan(rounding%squares(1), 16.0_dp*eps*9.81_dp/r)
        end do
    end subroutine a_hoop_near_its_critical_rate

    subroutine a_trap_in_a_weak_field()
        !! Across the field \(\omega_\pm = \sqrt{k/m + b^2} \pm b\), \(b = eB/(2m)\), their
        !! shapes \((1, \pm i)/\sqrt{2m}\) whatever b is: of weak fields they cannot be known.
        type(modes_t) :: modes
        type(mode_rounding_t) :: rounding
        real(dp) :: field, charge, m
        real(quad) :: b, omega
        integer :: draw, i, j, said

        said = 0
        do draw = 1, 300
            field = uniform(-15.0_dp, 2.0_dp)
            field = 10.0_dp**field
            charge = uniform(0.3_dp, 3.0_dp)
            m = uniform(0.3_dp, 3.0_dp)
            call solve("charged_particle", [m, charge, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, &
                                            field, 1.7_dp], modes, rounding)
            b = real(charge, quad)*field/(2.0_quad*m)
            do j = 1, 3
                omega = sqrt(1.7_quad/m + merge(0.0_quad, b**2, j == 2)) + (j - 2)*b
                if (j == 1) omega = 1.7_quad/m/(sqrt(1.7_quad/m + b**2) + b)
                call assertTrue(abs(modes%omega2(j) - omega**2) <= rounding%squares(j), &
                                message="omega^2")
                call assertLessThan(rounding%squares(j)/modes%omega2(j), 1e-13_dp)
            end do
            if (any(rounding%alike > 0)) cycle
            said = said + 1
            do j = 1, 3, 2
                do i = 1, 2
                    call assertTrue(abs(hypot(modes%shapes(i, j), modes%quadrature(i, j))* &
                                        sqrt(2.0_dp*m) - 1.0_dp) <= 4.0_dp*eps + &
                                    2.0_dp*sqrt(m)*rounding%shapes(i, j), message="shape")
                end do
            end do
        end do
        call assertTrue(said > 250 .and. said < 300, message="both weak and strong fields")
    end subroutine a_trap_in_a_weak_field

    subroutine oscillators_by_a_stiff_spring()
        !! \(m_1\) on a spring k, a spring \(\kappa \gg k\) from it to \(m_2\): the slow mode loses
        !! the digits of \(\kappa/k\), the fast one none. Judged against the roots of the
        !! characteristic equation in quadruple precision.
        type(modes_t) :: modes
        type(mode_rounding_t) :: rounding
        type(error_t), allocatable :: error
        class(system_t), allocatable :: system
        real(dp) :: stiff, k, values(4)
        real(quad) :: half, root, true(2)
        integer :: i, j

        call read_own("parameters = 'm_1', 'm_2', 'k', 'kappa' "// &
                      "L = '1/2 m_1 x_dot^2 + 1/2 m_2 y_dot^2 - k/2 x^2 - kappa/2 (y - x)^2' / "// &
                      "&own m_1 = 1, m_2 = 1, k = 1, kappa = 1", system)
        do i = 1, 200
            stiff = uniform(0.0_dp, 12.0_dp)
            k = uniform(0.5_dp, 2.0_dp)
            values = [0.3_dp, 0.7_dp, k, 10.0_dp**stiff]
            call system%configure(values, error)
            call find_modes(system, [0.0_dp, 0.0_dp], .true., modes, error)
            call assertFalse(allocated(error), message="modes")
            call find_rounding(system, modes, rounding)
            associate (m1 => real(values(1), quad), m2 => real(values(2), quad), &
                       spring => real(values(3), quad), kappa => real(values(4), quad))
                half = ((spring + kappa)/m1 + kappa/m2)/2
                root = sqrt(half**2 - spring*kappa/(m1*m2))
                true = [spring*kappa/(m1*m2)/(half + root), half + root]
            end associate
            do j = 1, 2
                call assertTrue(abs(modes%omega2(j) - true(j)) <= rounding%squares(j), &
                                message="omega^2")
            end do
            call assertLessThan(rounding%squares(1), 32.0_dp*eps*(k + values(4)))
            call assertLessThan(rounding%squares(2)/modes%omega2(2), 32.0_dp*eps)
        end do
    end subroutine oscillators_by_a_stiff_spring

    subroutine usual_modes_keep_their_digits()
        !! Twelve of them: nothing of usual systems is called rounding.
        type(modes_t) :: modes
        type(mode_rounding_t) :: rounding
        real(dp) :: p(5)
        integer :: i, k

        do i = 1, 100
            do k = 1, 5
                p(k) = uniform(0.2_dp, 5.0_dp)
            end do
            call solve("pendulum", [p(:3), 0.0_dp], modes, rounding)
            call assertLessThan(rounding%squares(1)/modes%omega2(1), 16.0_dp*eps)
            call solve("double_pendulum", p, modes, rounding)
            call assertTrue(all(rounding%squares < 1e-13_dp*modes%omega2), message="double")
            call assertTrue(all(rounding%shapes < 1e-12_dp*maxval(modes%shapes)), &
                            message="its shapes")
            call assertTrue(all(rounding%springs <= 4.0_dp*eps*abs(modes%stiffness)), &
                            message="K, and nothing of its zeros")
        end do
    end subroutine usual_modes_keep_their_digits

    subroutine near_critical_damping()
        !! \(\lambda = (-c \pm \sqrt{c^2 - 4mk})/(2m)\), nearly equal: against quadruple
        !! precision from the same doubles, on both sides; what is said to be unsure is no more
        !! than a half and an ulp of c and k make it.
        complex(dp), allocatable :: lambda(:)
        type(error_t), allocatable :: error
        real(dp), allocatable :: distance(:), rounding(:)
        real(dp) :: one(1, 1), c(1, 1), k(1, 1)
        real(quad) :: discriminant, root
        integer :: i, power, side

        one = 1.3_dp
        k = 0.7_dp
        do power = 1, 12
            do side = -1, 1, 2
                c = 2.0_dp*sqrt(one*k)*(1.0_dp + side*10.0_dp**(-power))
                call quadratic_eigenvalues(one, c, k, lambda, error, rounding, distance)
                call assertFalse(allocated(error), message="near critical")
                discriminant = real(c(1, 1), quad)**2 - 4.0_quad*one(1, 1)*k(1, 1)
                root = sqrt(abs(discriminant))/(2.0_quad*one(1, 1))
                do i = 1, 2
                    if (side < 0) then
                        call assertTrue(abs(abs(aimag(lambda(i))) - root) <= distance(i), &
                                        message="frequency")
                    else
                        call assertTrue(min(abs(real(lambda(i)) + c(1, 1)/2.6_quad - root), &
                                            abs(real(lambda(i)) + c(1, 1)/2.6_quad + root)) <= &
                                        distance(i) + epsilon(1.0_dp), message="rate")
                    end if
                    call assertLessThan(distance(i), 32.0_dp*epsilon(1.0_dp)/real(root, dp))
                end do
            end do
        end do
    end subroutine near_critical_damping

    subroutine a_zero_across_a_field()
        !! \(m\ddot x = B\dot y - kx,\; m\ddot y = -B\dot x\): of the mode \((0, 1)/\sqrt m\) that
        !! stays a square is not seen below \(16n\epsilon\) of k/m, the lesser of k/m and
        !! \(k/m + B^2/m^2\).
        type(modes_t) :: modes
        type(mode_rounding_t) :: rounding
        type(error_t), allocatable :: error
        class(system_t), allocatable :: system

        call read_own("parameters = 'm', 'k', 'B' "// &
                      "L = 'm/2 (x_dot^2 + y_dot^2) + B y_dot x - k/2 x^2' / "// &
                      "&own m = 4, k = 3, B = 5", system)
        call find_modes(system, [0.0_dp, 0.0_dp], .true., modes, error)
        call assertFalse(allocated(error), message="modes")
        call find_rounding(system, modes, rounding)
        call assertEqual([0.0_dp, 2.3125_dp], modes%omega2, 1e-14_dp)
        call assertEqual(32.0_dp*eps*0.75_dp, rounding%squares(1), eps)
        call assertEqual([0, 0], rounding%alike)
        call assertLessThan(maxval(rounding%shapes), 1e-14_dp)
    end subroutine a_zero_across_a_field

    subroutine no_damping_takes_no_digit()
        !! Of \(\omega = \sqrt{k/m}\), with k and m off by \(4\epsilon\) of themselves, as much is
        !! unsure, of whatever unit.
        complex(dp), allocatable :: lambda(:)
        type(error_t), allocatable :: error
        real(dp), allocatable :: distance(:), rounding(:)
        real(dp) :: m(1, 1), k(1, 1), omega
        integer :: power

        do power = -20, 20
            m = 1.3_dp
            k = 0.7_dp*3.0_dp**power
            omega = sqrt(k(1, 1)/m(1, 1))
            call quadratic_eigenvalues(m, 0.0_dp*m, k, lambda, error, rounding, distance)
            call assertFalse(allocated(error), message="no damping")
            call assertEqual([4.0_dp, 4.0_dp]*eps*omega, distance, 1e-3_dp*eps*omega)
            ! without a spring it slides, and that it stays is sure
            call quadratic_eigenvalues(m, omega*m, 0.0_dp*k, lambda, error, rounding, distance)
            call assertFalse(allocated(error), message="no spring")
            call assertEqual([8.0_dp, 0.0_dp]*eps*omega, distance, 1e-3_dp*eps*omega)
        end do
    end subroutine no_damping_takes_no_digit

    subroutine near_modes_have_unsure_shapes()
        !! Of an isotropic trap two modes are one to rounding, and no digit of their shapes is
        !! called wrong; apart by 1e-9 of \(\omega\), seven digits are right.
        type(modes_t) :: modes
        type(mode_rounding_t) :: rounding

        call solve("charged_particle", [1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, &
                                        0.0_dp, 1.0_dp], modes, rounding)
        call assertEqual([0, 1, 2], rounding%alike)
        call assertEqual(0.0_dp, maxval(rounding%shapes), 0.0_dp)
        call solve("charged_particle", [1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, &
                                        1e-9_dp, 1.0_dp], modes, rounding)
        call assertEqual([0, 0, 0], rounding%alike)
        call assertTrue(maxval(rounding%shapes) > 1e-8_dp .and. &
                        maxval(rounding%shapes) < 1e-4_dp, message="some digits")
    end subroutine near_modes_have_unsure_shapes
end module test_mode_rounding
