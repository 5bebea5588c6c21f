module test_quadratic_eigen
    !! Exponents of damped oscillations against closed forms, over many decades of the drag.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertLessThan, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_quadratic_eigen, only: quadratic_eigenvalues
    use lagrangia_regular_pencil, only: nullity
    use lagrangia_unsymmetric_modes, only: unsymmetric_modes
    implicit none (type, external)
    private
    public :: quadratic_eigen_suite

    integer, parameter :: quad = selected_real_kind(30)
    real(dp), parameter :: rounding = 1e-13_dp
    real(dp), parameter :: m2(2, 2) = reshape([1.3_dp, 0.0_dp, 0.0_dp, 0.7_dp], [2, 2])

contains

    function quadratic_eigen_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("quadratic_eigen")
        call suite%addTest(TestMethod("one_coordinate", one_coordinate))
        call suite%addTest(TestMethod("drag_in_proportion", drag_in_proportion))
        call suite%addTest(TestMethod("drag_on_one_of_two", drag_on_one_of_two))
        call suite%addTest(TestMethod("nothing_holds_it", nothing_holds_it))
        call suite%addTest(TestMethod("drag_and_magnetic_field", drag_and_magnetic_field))
        call suite%addTest(TestMethod("weak_drag_in_a_strong_field", weak_drag_in_a_strong_field))
        call suite%addTest(TestMethod("growth_that_is_turned", growth_that_is_turned))
        call suite%addTest(TestMethod("zeros_are_zeros", zeros_are_zeros))
        call suite%addTest(TestMethod("no_inertia", no_inertia))
        call suite%addTest(TestMethod("a_coordinate_of_its_own", a_coordinate_of_its_own))
        call suite%addTest(TestMethod("three_masses_on_stiff_dashpots", &
                                      three_masses_on_stiff_dashpots))
        call suite%addTest(TestMethod("rounding_of_a_turning_force", rounding_of_a_turning_force))
        call suite%addTest(TestMethod("null_spaces_to_rounding", null_spaces_to_rounding))
        call suite%addTest(TestMethod("stiffness_without_symmetry", stiffness_without_symmetry))
        call suite%addTest(TestMethod("a_sign_of_a_coordinate", a_sign_of_a_coordinate))
    end function quadratic_eigen_suite

    subroutine rounding_of_a_turning_force()
        !! \(\ddot x = -kx - sy,\;\ddot y = sx - ky\): \(\lambda^2 = -k \pm is\). Eight units
        !! in the last place of s, over \(2\omega\), may be lost of the real part.
        real(dp), parameter :: one(2, 2) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], [2, 2])
        real(dp), parameter :: k = 3.0_dp, s = 0.4_dp
        real(dp) :: matrix(2, 2), d(2, 2)
        complex(dp), allocatable :: lambda(:)
        real(dp), allocatable :: lost(:)
        type(error_t), allocatable :: error
        integer :: j, sense

        d = 0.0_dp
        do sense = -1, 1, 2
            matrix = reshape([k, -sense*s, sense*s, k], [2, 2])
            call quadratic_eigenvalues(one, d, matrix, lambda, error, lost)
            call assertFalse(allocated(error), "exponents")
            do j = 1, size(lambda)
                call assertEqual(-k, real(lambda(j)**2), rounding, "its square")
                call assertEqual(s, abs(aimag(lambda(j)**2)), rounding, "and how it grows")
                call assertEqual(4.0_dp*epsilon(s)*s/abs(aimag(lambda(j))), lost(j), &
                                 1e-6_dp*epsilon(s), "what rounding does")
            end do
        end do
    end subroutine rounding_of_a_turning_force

    subroutine a_sign_of_a_coordinate()
        !! What rounding does to two masses on springs is the same if one is measured to the left.
        real(dp), parameter :: k(2, 2) = reshape([2.0_dp, -1.0_dp, -1.0_dp, 3.0_dp], [2, 2])
        real(dp), parameter :: other(2, 2) = reshape([2.0_dp, 1.0_dp, 1.0_dp, 3.0_dp], [2, 2])
        complex(dp), allocatable :: lambda(:)
        real(dp), allocatable :: distance(:), as_far(:), moved(:)
        type(error_t), allocatable :: error

        call quadratic_eigenvalues(m2, 0.1_dp*m2, k, lambda, error, moved, distance)
        call assertFalse(allocated(error), "to the right")
        if (allocated(error)) return
        call quadratic_eigenvalues(m2, 0.1_dp*m2, other, lambda, error, moved, as_far)
        call assertFalse(allocated(error), "to the left")
        if (allocated(error)) return
        call assertEqual(distance, as_far, 1e-6_dp*epsilon(k), "how far")
    end subroutine a_sign_of_a_coordinate

    subroutine null_spaces_to_rounding()
        !! Products of a column and a row of either sign, of which one or two are added; springs
        !! that hang on nothing; and a matrix without any null space.
        real(dp), parameter :: u(4) = [0.1_dp, -0.7_dp, 1.3_dp, -1.0_dp/3.0_dp]
        real(dp), parameter :: w(4) = [-1.1_dp, 0.3_dp, 0.9_dp, -0.7_dp]
        real(dp), parameter :: springs(3) = [0.1_dp, 0.7_dp, 1.9_dp]
        real(dp) :: one(4, 4), two(4, 4), chain(4, 4)
        integer :: i, sense

        do sense = -1, 1, 2
            one = sense*spread(u, 2, 4)*spread(w, 1, 4)
            two = one + sense*spread(w**2, 2, 4)*spread(u**3, 1, 4)
            call assertEqual(3, nullity(one), message="of rank 1")
            call assertEqual(2, nullity(two), message="of rank 2")
            call assertEqual(3, nullity(-sense*abs(one)), message="of one sign")
            chain = 0.0_dp
            do i = 1, 3
                chain(i:i + 1, i:i + 1) = chain(i:i + 1, i:i + 1) + sense*springs(i)* &
                                          reshape([1.0_dp, -1.0_dp, -1.0_dp, 1.0_dp], [2, 2])
            end do
            call assertEqual(1, nullity(chain), message="a chain")
            chain(1, 1) = chain(1, 1) + sense*0.1_dp
            call assertEqual(0, nullity(chain), message="a chain that is held")
            do i = 1, 100
                one = sense*spread(sin(i*[1.0_dp, 2.0_dp, 3.0_dp, 4.0_dp]), 2, 4)* &
                      spread(exp(-i*u), 1, 4)
                call assertEqual(3, nullity(one), message="of rank 1, too")
            end do
        end do
    end subroutine null_spaces_to_rounding

    subroutine stiffness_without_symmetry()
        !! \(K a = \omega^2 M a\) with the slow mode first; not where a force turns it around, nor
        !! without inertia.
        real(dp), parameter :: k(2, 2) = reshape([9.1_dp, 0.0_dp, 2.0_dp, 2.1_dp], [2, 2])
        real(dp), parameter :: turning(2, 2) = reshape([0.0_dp, 1.0_dp, -1.0_dp, 0.0_dp], [2, 2])
        real(dp), parameter :: none(2, 2) = 0.0_dp
        real(dp) :: omega2(2), shapes(2, 2)
        logical :: known
        integer :: j

        call unsymmetric_modes(k, m2, omega2, shapes, known)
        call assertTrue(known, message="known")
        call assertEqual(3.0_dp, omega2(1), rounding, message="the slow one")
        call assertEqual(7.0_dp, omega2(2), rounding, message="the fast one")
        do j = 1, 2
            call assertEqual(0.0_dp, maxval(abs(matmul(k - omega2(j)*m2, shapes(:, j)))), &
                             10*rounding, message="K a = omega^2 M a")
            call assertTrue(maxval(abs(shapes(:, j))) > 0.5_dp, message="a shape that is not 0")
        end do
        call unsymmetric_modes(turning, m2, omega2, shapes, known)
        call assertFalse(known, message="no real omega^2")
        call assertEqual(0.0_dp, maxval(abs(omega2)), 0.0_dp, message="is 0 then")
        call unsymmetric_modes(k, none, omega2, shapes, known)
        call assertFalse(known, message="no inertia")
    end subroutine stiffness_without_symmetry

    subroutine solve(m, d, k, lambda)
        real(dp), intent(in) :: m(:, :), d(:, :), k(:, :)
        complex(dp), allocatable, intent(out) :: lambda(:)
        type(error_t), allocatable :: error

        call quadratic_eigenvalues(m, d, k, lambda, error)
        call assertFalse(allocated(error), message="solved")
        call assertEqual(2*size(m, 1), size(lambda), message="all of them")
    end subroutine solve

    subroutine is_there(lambda, expected, message)
        !! One of them is the expected one, each of its parts to a relative error.
        complex(dp), intent(in) :: lambda(:), expected
        character(*), intent(in) :: message
        integer :: j

        j = minloc(abs(lambda - expected), 1)
        call assertEqual(real(expected), real(lambda(j)), rounding*abs(real(expected)), &
                         message=message//": rate")
        call assertEqual(aimag(expected), aimag(lambda(j)), rounding*abs(aimag(expected)), &
                         message=message//": frequency")
    end subroutine is_there

    subroutine two_roots(lambda, m, d, k, message)
        !! Those of \(m\lambda^2 + d\lambda + k = 0\) are there.
        complex(dp), intent(in) :: lambda(:)
        real(dp), intent(in) :: m, d, k
        character(*), intent(in) :: message
        real(dp) :: half, root

        half = 0.5_dp*d/m
        root = sqrt(abs(half - sqrt(k/m)))*sqrt(half + sqrt(k/m))
        if (half < sqrt(k/m)) then
            call is_there(lambda, cmplx(-half, root, dp), message)
            call is_there(lambda, cmplx(-half, -root, dp), message)
        else
            call is_there(lambda, cmplx(-half - root, 0.0_dp, dp), message//", fast")
            call is_there(lambda, cmplx(-k/m/(half + root), 0.0_dp, dp), message//", slow")
        end if
    end subroutine two_roots

    subroutine one_coordinate()
        !! Drags from 1e-18 to 1e18, masses and springs from 1e-6 to 1e6.
        complex(dp), allocatable :: lambda(:)
        real(dp) :: m, d, k
        integer :: i, j

        do i = -18, 18
            do j = -6, 6, 3
                m = 1.7_dp*10.0_dp**j
                k = 0.9_dp*10.0_dp**(-j)
                d = 1.1_dp*10.0_dp**i
                call solve(reshape([m], [1, 1]), reshape([d], [1, 1]), &
                           reshape([k], [1, 1]), lambda)
                call two_roots(lambda, m, d, k, "one coordinate")
            end do
        end do
    end subroutine one_coordinate

    subroutine drag_in_proportion()
        !! \(D = \alpha M + \beta K\) keeps the shapes: each mode by itself.
        real(dp), parameter :: s(3, 3) = reshape([0.8_dp, 0.2_dp, -0.5_dp, &
                                                  -0.3_dp, 0.9_dp, 0.4_dp, &
                                                  0.6_dp, -0.1_dp, 0.7_dp], [3, 3])
        real(dp), parameter :: omega2(3) = [0.7_dp, 2.3_dp, 11.0_dp]
        real(dp) :: m(3, 3), k(3, 3), alpha, beta
        complex(dp), allocatable :: lambda(:)
        integer :: i, j

        m = matmul(transpose(s), s)
        do j = 1, 3
            k(j, :) = omega2(j)*s(j, :)
        end do
        k = matmul(transpose(s), k)
        do i = -8, 6
            alpha = 0.5_dp*10.0_dp**i
            beta = 0.3_dp*alpha
            call solve(m, alpha*m + beta*k, k, lambda)
            do j = 1, 3
                call two_roots_nearly(lambda, alpha + beta*omega2(j), omega2(j))
            end do
        end do
    contains
        subroutine two_roots_nearly(values, d, spring)
            !! To what the condition of s leaves.
            complex(dp), intent(in) :: values(:)
            real(dp), intent(in) :: d, spring
            complex(dp) :: root
            real(dp) :: slow

            root = sqrt(cmplx(0.25_dp*d**2 - spring, 0.0_dp, dp))
            root = -0.5_dp*d - root
            slow = minval(abs(values - spring/root))/abs(spring/root)
            call assertTrue(minval(abs(values - root)) <= 1e-11_dp*abs(root), message="fast")
            call assertTrue(slow <= 1e-11_dp, message="slow")
        end subroutine two_roots_nearly
    end subroutine drag_in_proportion

    subroutine drag_on_one_of_two()
        !! Two masses, three springs, a drag of 1e6 kg/s on the first: it creeps at k/d, and the
        !! second swings with hardly a loss. Expansion in 1/d to second order.
        real(dp), parameter :: d(2, 2) = reshape([1e6_dp, 0.0_dp, 0.0_dp, 0.0_dp], [2, 2])
        real(dp), parameter :: k(2, 2) = reshape([5.0_dp, -2.0_dp, -2.0_dp, 6.0_dp], [2, 2])
        complex(dp), allocatable :: lambda(:)
        real(dp) :: rate, omega2
        integer :: j

        call solve(m2, d, k, lambda)
        j = minloc(abs(lambda), 1)
        rate = -(5.0_dp - 4.0_dp/6.0_dp)/1e6_dp
        call assertEqual(rate, real(lambda(j)), 1e-11_dp*abs(rate), message="creeps")
        omega2 = 6.0_dp/0.7_dp
        rate = -0.5_dp*4.0_dp/(1e6_dp*omega2*0.7_dp)  ! by what the first is moved
        j = minloc(abs(abs(aimag(lambda)) - sqrt(omega2)), 1)
        call assertEqual(rate, real(lambda(j)), 1e-9_dp*abs(rate), message="hardly a loss")
        call assertEqual(sqrt(omega2), abs(aimag(lambda(j))), 1e-11_dp, message="swings")
    end subroutine drag_on_one_of_two

    subroutine nothing_holds_it()
        !! Two masses, one spring between them: with a drag on each a place and a rate, with one
        !! between them no drag at all on the common motion.
        real(dp), parameter :: k(2, 2) = reshape([2.0_dp, -2.0_dp, -2.0_dp, 2.0_dp], [2, 2])
        complex(dp), allocatable :: lambda(:)

        call solve(m2, 0.4_dp*m2, k, lambda)
        call assertEqual(0.0_dp, minval(abs(lambda)), message="rests wherever it is")
        call is_there(lambda, cmplx(-0.4_dp, 0.0_dp, dp), "comes to rest")
        call solve(m2, 1e-3_dp*k, k, lambda)
        call assertEqual(2, count(abs(lambda) <= 0.0_dp), message="moves freely")
        call two_roots(lambda, 1.0_dp, 2e-3_dp*(1.0_dp/1.3_dp + 1.0_dp/0.7_dp), &
                       2.0_dp*(1.0_dp/1.3_dp + 1.0_dp/0.7_dp), "the other")
    end subroutine nothing_holds_it

    subroutine drag_and_magnetic_field()
        !! In the plane, \(z = x + iy\): \(\ddot z + (d + iB)\dot z + kz = 0\), a root of it and its
        !! conjugate; the slow drift decays at \(d\,k/B^2\).
        real(dp), parameter :: unit(2, 2) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], [2, 2])
        real(dp), parameter :: field(2, 2) = reshape([0.0_dp, 1.0_dp, -1.0_dp, 0.0_dp], [2, 2])
        real(dp), parameter :: d = 0.02_dp, k = 3.0_dp, b = 1e3_dp
        complex(dp), allocatable :: lambda(:)
        complex(dp) :: fast, half

        call solve(unit, d*unit + b*field, k*unit, lambda)
        half = 0.5_dp*cmplx(d, b, dp)
        fast = -half - half*sqrt(1.0_dp - k/half**2)
        call is_there(lambda, fast, "the orbit")
        call is_there(lambda, k/fast, "the drift")
        call is_there(lambda, conjg(k/fast), "the drift, conjugate")
    end subroutine drag_and_magnetic_field

    subroutine weak_drag_in_a_strong_field()
        !! \(m\ddot z + (d + iB)\dot z = 0\): it turns at B/m, and stays somewhere, with d/m alone.
        real(dp), parameter :: unit(2, 2) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], [2, 2])
        real(dp), parameter :: field(2, 2) = reshape([0.0_dp, 1.0_dp, -1.0_dp, 0.0_dp], [2, 2])
        real(dp), parameter :: m = 3.7_dp, d = 2.3_dp, b = 8.48e6_dp
        complex(dp), allocatable :: lambda(:)

        call solve(m*unit, d*unit + b*field, 0.0_dp*unit, lambda)
        call is_there(lambda, cmplx(-d/m, b/m, dp), "turns")
        call is_there(lambda, cmplx(-d/m, -b/m, dp), "turns, conjugate")
        call assertEqual(2, count(abs(lambda) <= 0.0_dp), message="stays")
    end subroutine weak_drag_in_a_strong_field

    subroutine zeros_are_zeros()
        !! Springs, masses and drags that are no round numbers, and as many exponents 0 as
        !! det(lambda^2 M + lambda D + K) has without rounding.
        real(dp), parameter :: a(3) = [1.0_dp, -1.0_dp, 2.0_dp], c(3) = [0.0_dp, 2.0_dp, -1.0_dp]
        complex(dp), allocatable :: lambda(:)
        real(dp) :: m(3, 3), k(3, 3), turn(3, 3)
        integer :: i, power

        do power = -6, 6, 3
            m = 0.0_dp
            do i = 1, 3
                m(i, i) = 0.1_dp*10.0_dp**(power*(i - 2))*i
            end do
            k = 0.7_dp*product_of(a, a)
            call solve(m, 0.3_dp*product_of(c, c), k, lambda)
            call assertEqual(3, count(abs(lambda) <= 0.0_dp), message="two that slide, one stops")
            call solve(m, 0.3_dp*product_of(a, a), k, lambda)
            call assertEqual(4, count(abs(lambda) <= 0.0_dp), message="two that slide")
            turn = 0.3_dp*(product_of(a, c) - product_of(c, a))
            call solve(m, turn, k, lambda)
            call assertEqual(4, count(abs(lambda) <= 0.0_dp), message="two in a field")
        end do
    contains
        pure function product_of(x, y) result(dyad)
            real(dp), intent(in) :: x(3), y(3)
            real(dp) :: dyad(3, 3)

            dyad = spread(x, 2, 3)*spread(y, 1, 3)
        end function product_of
    end subroutine zeros_are_zeros

    subroutine growth_that_is_turned()
        !! On a hill a weak field turns what grows or falls: of \(z = x + iy\) is
        !! \(\lambda^2 + (c + ig)\lambda - k = 0\), and \(2\omega + g\) all but vanishes.
        complex(dp), allocatable :: lambda(:)
        complex(dp) :: half, root
        real(dp), parameter :: c = 1e-6_dp, g = -1.0_dp, k = 4000.0_dp
        real(dp), parameter :: one(2, 2) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], [2, 2])

        call solve(one, reshape([c, g, -g, c], [2, 2]), -k*one, lambda)
        half = 0.5_dp*cmplx(c, g, dp)
        root = sqrt(half**2 + k)
        call is_there(lambda, root - half, "it grows")
        call is_there(lambda, -root - half, "it falls")
    end subroutine growth_that_is_turned

    subroutine three_masses_on_stiff_dashpots()
        !! They move as one, \(\omega^2 = (1 + 1/2 + 1/3)/3\), and hardly decay, with \(1/(12b)\);
        !! what rounding leaves of that is told. Where nothing is left, none is stated: a
        !! growth of 800/s was.
        real(dp), parameter :: k(3, 3) = reshape([2.0_dp, -1.0_dp, 0.0_dp, -1.0_dp, 1.5_dp, &
                                                  0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp/3], [3, 3])
        real(dp), parameter :: d(3, 3) = reshape([1.0_dp, -1.0_dp, 0.0_dp, -1.0_dp, 1.5_dp, &
                                                  -0.5_dp, 0.0_dp, -0.5_dp, 0.5_dp], [3, 3])
        real(dp), parameter :: m(3, 3) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp, &
                                                  0.0_dp, 0.0_dp, 1.0_dp], [3, 3])
        complex(dp), allocatable :: lambda(:)
        type(error_t), allocatable :: error
        real(dp), allocatable :: distance(:), rounding(:)
        real(dp) :: b, fastest, omega
        integer :: j, power

        omega = sqrt(11.0_dp/18)
        do power = 4, 30
            b = 10.0_dp**power
            call quadratic_eigenvalues(m, b*d, k, lambda, error, rounding, distance)
            if (power > 13) call assertTrue(allocated(error), message="refused")
            if (allocated(error)) then
                call assertEqual("more digits apart than doubles can tell", &
                                 error%message(index(error%message, "more"):), message="why")
                read (error%message(index(error%message, "fastest") + 7:), *) fastest
                call assertEqual(0.5_dp*(3.0_dp + sqrt(3.0_dp)), fastest/b, 1e-9_dp, "the fastest")
                cycle
            end if
            j = maxloc(aimag(lambda), 1)
            call assertTrue(abs(-real(lambda(j)) - 1/(12*b)) <= rounding(j) + 1e-8_dp/b, &
                            message="its decay rate")
            call assertTrue(abs(aimag(lambda(j)) - omega) <= distance(j) + 0.1_dp/b**2, &
                            message="its frequency")
            call assertLessThan(distance(j), 1e-13_dp + 2.0_dp*rounding(j)**2)
            call assertTrue(rounding(j) > 1e-16_dp*b .and. rounding(j) < 1e-14_dp*b, &
                            message="what rounding does")
            call assertTrue(any(abs(real(lambda) + 0.477767032132906485_dp/b) <= 1e-8_dp/b), &
                            message="a slow one")
        end do
    end subroutine three_masses_on_stiff_dashpots

    subroutine a_coordinate_of_its_own()
        !! Drag on two of three coordinates leaves the third alone: it does not decay, nor grow.
        real(dp), parameter :: k(3, 3) = reshape([60.0_dp, -40.0_dp, 0.0_dp, -40.0_dp, 80.0_dp, &
                                                  0.0_dp, 0.0_dp, 0.0_dp, 0.2_dp], [3, 3])
        real(dp) :: d(3, 3), m(3, 3)
        complex(dp), allocatable :: lambda(:)
        integer :: i, j

        m = 0.0_dp
        d = 0.0_dp
        do i = 1, 3
            m(i, i) = 1.0_dp
        end do
        do i = 1, 2
            d(i, i) = 3.0_dp
            call solve(m, d, k, lambda)
            j = minloc(abs(abs(aimag(lambda)) - sqrt(0.2_dp)), 1)
            call assertEqual(0.0_dp, real(lambda(j)), 0.0_dp, message="no decay")
            call assertEqual(sqrt(0.2_dp), abs(aimag(lambda(j))), 1e-15_dp, message="omega")
        end do
        ! of these Newton's method leaves 1e-33 of the others in the vector
        m = diagonal([0.491584_dp, 2.03551_dp, 15.913_dp])
        d = diagonal([0.399197_dp, 0.0_dp, 0.0_dp])
        call solve(m, d, reshape([1.34174749_dp, -0.00180749_dp, 0.0_dp, -0.00180749_dp, &
                                  0.10273249_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0892353_dp], [3, 3]), &
                   lambda)
        j = minloc(abs(abs(aimag(lambda)) - sqrt(0.0892353_dp/15.913_dp)), 1)
        call assertEqual(0.0_dp, real(lambda(j)), 0.0_dp, message="no decay of 1e-67")
    contains
        pure function diagonal(values) result(matrix)
            real(dp), intent(in) :: values(3)
            real(dp) :: matrix(3, 3)
            integer :: n

            matrix = 0.0_dp
            do n = 1, 3
                matrix(n, n) = values(n)
            end do
        end function diagonal
    end subroutine a_coordinate_of_its_own

    subroutine no_inertia()
        !! A singular M is an error of LAPACK's, with nothing solved.
        complex(dp), allocatable :: lambda(:)
        type(error_t), allocatable :: error
        real(dp), parameter :: none(1, 1) = 0.0_dp

        call quadratic_eigenvalues(none, none + 1.0_dp, none + 1.0_dp, lambda, error)
        call assertTrue(allocated(error), message="refused")
    end subroutine no_inertia
end module test_quadratic_eigen
