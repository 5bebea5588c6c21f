module test_normal_modes
    !! Normal modes of anybody's K and M, as another program asks for them.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
    use, intrinsic :: iso_fortran_env, only: real128
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, &
                     assertLessThan, assertTrue
    use lagrangia, only: dp, error_t, is_oscillation, is_unstable, is_zero_mode, normal_modes, &
                         normal_modes_t, residual_ratio
    use lagrangia_gyroscopic, only: gyroscopic_ratio
    use random_states, only: restart_random, uniform
    implicit none (type, external)
    private
    public :: normal_modes_suite

contains

    function normal_modes_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("normal_modes")
        call suite%addTest(TestMethod("three_masses_between_walls", three_masses_between_walls))
        call suite%addTest(TestMethod("free_chain_has_a_zero_mode", free_chain_has_a_zero_mode))
        call suite%addTest(TestMethod("negative_springs_are_unstable", &
                                      negative_springs_are_unstable))
        call suite%addTest(TestMethod("a_free_motion_beside_an_unstable_one", &
                                      a_free_motion_beside_an_unstable_one))
        call suite%addTest(TestMethod("slow_modes_beside_fast_ones_keep_their_digits", &
                                      slow_modes_beside_fast_ones_keep_their_digits))
        call suite%addTest(TestMethod("graded_matrices_keep_their_digits", &
                                      graded_matrices_keep_their_digits))
        call suite%addTest(TestMethod("residuals_of_wrong_modes_are_their_size", &
                                      residuals_of_wrong_modes_are_their_size))
        call suite%addTest(TestMethod("bad_matrices_give_nothing", bad_matrices_give_nothing))
        call suite%addTest(TestMethod("elements_are_looked_at_on_both_sides", &
                                      elements_are_looked_at_on_both_sides))
    end function normal_modes_suite

    pure function chain(n, walls) result(k)
        !! Springs of 1 N/m between neighbours, and to both walls.
        integer, intent(in) :: n
        logical, intent(in) :: walls
        real(dp) :: k(n, n)
        integer :: i

        k = 0.0_dp
        do i = 1, n
            k(i, i) = 2.0_dp
        end do
        do i = 2, n
            k(i, i - 1) = -1.0_dp
            k(i - 1, i) = -1.0_dp
        end do
        if (walls) return
        k(1, 1) = 1.0_dp
        k(n, n) = 1.0_dp
    end function chain

    pure function diagonal(masses) result(m)
        real(dp), intent(in) :: masses(:)
        real(dp) :: m(size(masses), size(masses))
        integer :: i

        m = 0.0_dp
        do i = 1, size(masses)
            m(i, i) = masses(i)
        end do
    end function diagonal

    subroutine three_masses_between_walls()
        !! \(\omega^2 = (2 - \sqrt2,\ 2,\ 2 + \sqrt2)\,k/m\); shapes are sines, \(u^\top M u = 1\).
        type(normal_modes_t) :: modes
        type(error_t), allocatable :: error
        real(dp), parameter :: mass = 0.25_dp, root = sqrt(2.0_dp)

        call normal_modes(chain(3, .true.), diagonal([mass, mass, mass]), modes, error)
        call assertFalse(allocated(error), "no error: three masses between walls")
        if (anyExceptions()) return
        call assertEqual([2.0_dp - root, 2.0_dp, 2.0_dp + root]/mass, modes%omega2, 1e-14_dp/mass)
        call assertEqual(sqrt(modes%omega2), modes%omega, 1e-15_dp)
        call assertEqual([is_oscillation, is_oscillation, is_oscillation], modes%label)
        call assertEqual([0.5_dp, root/2.0_dp, 0.5_dp]/sqrt(mass), modes%shapes(:, 1), 1e-14_dp)
        call assertEqual([0.5_dp, 0.0_dp, -0.5_dp]*root/sqrt(mass), modes%shapes(:, 2), 1e-14_dp)
    end subroutine three_masses_between_walls

    subroutine free_chain_has_a_zero_mode()
        !! Exactly, with a frequency of 0 and all masses together: also where `dsygvd` solves.
        type(normal_modes_t) :: modes
        type(error_t), allocatable :: error
        real(dp), parameter :: pi = acos(-1.0_dp)
        integer :: n, j

        do n = 3, 40, 37
            call normal_modes(chain(n, .false.), diagonal([(2.0_dp, j=1, n)]), modes, error)
            call assertFalse(allocated(error), "no error: free chain has a zero mode")
            if (anyExceptions()) return
            call assertEqual(is_zero_mode, modes%label(1))
            call assertTrue(all(modes%label(2:) == is_oscillation), "the others")
            call assertEqual([0.0_dp, 0.0_dp], [modes%omega2(1), modes%omega(1)])
            call assertEqual([(2.0_dp*sin(0.5_dp*pi*j/n)**2, j=0, n - 1)], modes%omega2, 1e-14_dp)
            call assertEqual([(1.0_dp/sqrt(2.0_dp*n), j=1, n)], modes%shapes(:, 1), 1e-13_dp)
        end do
    end subroutine free_chain_has_a_zero_mode

    subroutine negative_springs_are_unstable()
        !! A growth rate is no frequency.
        type(normal_modes_t) :: modes
        type(error_t), allocatable :: error

        call normal_modes(diagonal([-8.0_dp, 18.0_dp]), diagonal([2.0_dp, 2.0_dp]), modes, error)
        call assertFalse(allocated(error), "no error: negative springs are unstable")
        if (anyExceptions()) return
        call assertEqual([-4.0_dp, 9.0_dp], modes%omega2, 1e-14_dp)
        call assertEqual([is_unstable, is_oscillation], modes%label)
        call assertTrue(ieee_is_nan(modes%omega(1)), "no frequency")
        call assertEqual(3.0_dp, modes%omega(2), 1e-15_dp)
    end subroutine negative_springs_are_unstable

    subroutine a_free_motion_beside_an_unstable_one()
        !! A zero mode, though K is not definite and the masses couple all: with only rounding in
        !! its shape where K has elements, \(u^\top Ku\) is small, and as large as its terms.
        type(normal_modes_t) :: modes
        type(error_t), allocatable :: error
        real(dp), parameter :: k(3, 3) = reshape([0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 43.8_dp, &
                                                  62.63_dp, 0.0_dp, 62.63_dp, 0.0_dp], [3, 3])
        real(dp), parameter :: along(3) = [1.0_dp, 2.0_dp, 3.0_dp]
        real(dp) :: m(3, 3)
        integer :: i

        do i = 1, 40
            m = 26.1_dp*spread(along, 1, 3)*spread(along, 2, 3) + &
                diagonal([0.61_dp, 0.45_dp + 0.1_dp*i, 3.4_dp])
            call normal_modes(k, m, modes, error)
            call assertFalse(allocated(error), "no error: free and unstable")
            if (anyExceptions()) return
            call assertEqual([is_unstable, is_zero_mode, is_oscillation], modes%label)
            call assertEqual(0.0_dp, modes%omega2(2))
        end do
    end subroutine a_free_motion_beside_an_unstable_one

    subroutine slow_modes_beside_fast_ones_keep_their_digits()
        !! A small frequency is no zero mode, however fast another is; what the elements of \(K\)
        !! cancel to their last digit is one, exactly.
        real(dp), parameter :: one(2) = 1.0_dp

        call check([1e16_dp, 0.0_dp, 4.0_dp], [4.0_dp, 1e16_dp], is_oscillation)
        call check([1e300_dp, 0.0_dp, 1e-300_dp], [1e-300_dp, 1e300_dp], is_oscillation)
        call check([1e16_dp, 1e3_dp, 4.0_dp], [4.0_dp - 1e-10_dp, 1e16_dp], is_oscillation)
        call check([1e16_dp, 0.0_dp, -4.0_dp], [-4.0_dp, 1e16_dp], is_unstable)
        call check([1e16_dp, -1e16_dp, 1e16_dp], [0.0_dp, 2e16_dp], is_zero_mode)
        call check([1e16_dp, 1e8_dp, 1.0_dp], [0.0_dp, 1e16_dp + 1.0_dp], is_zero_mode)
        call check([0.0_dp, 0.0_dp, 1e-9_dp], [0.0_dp, 1e-9_dp], is_zero_mode)
    contains
        subroutine check(k, omega2, label)
            !! `k` is \(K_{11}, K_{12}, K_{22}\).
            real(dp), intent(in) :: k(3), omega2(2)
            integer, intent(in) :: label
            type(normal_modes_t) :: modes
            type(error_t), allocatable :: error

            call normal_modes(reshape([k(1), k(2), k(2), k(3)], [2, 2]), diagonal(one), modes, &
                              error)
            call assertFalse(allocated(error), "no error: check")
            if (anyExceptions()) return
            call assertEqual(label, modes%label(1), "label of the slow one")
            call assertEqual(omega2(1), modes%omega2(1), 4.0_dp*spacing(omega2(1)), "slow")
            call assertEqual(omega2(2), modes%omega2(2), 4.0_dp*spacing(omega2(2)), "fast")
        end subroutine check
    end subroutine slow_modes_beside_fast_ones_keep_their_digits

    subroutine graded_matrices_keep_their_digits()
        !! Random \(K = DCD\) and \(M = EBE\), \(C\) and \(B\) well-conditioned, \(D\) and
        !! \(E\) over many decades, \(K\) definite or not, against Jacobi's method in quadruple
        !! precision. What rounding of the elements does is some \(n\epsilon\) times the conditions
        !! of \(C\) and \(B\), below 20 each; `dsygv` alone is off by many times the smallest.
        integer, parameter :: decades(3) = [4, 8, 12]
        type(normal_modes_t) :: modes
        type(error_t), allocatable :: error
        real(dp), allocatable :: k(:, :), m(:, :), omega2(:)
        real(dp) :: worst
        integer :: i, j, n

        call restart_random()
        worst = 0.0_dp
        do j = 1, size(decades)
            do i = 1, 100
                n = 2 + mod(i, 6)
                call draw_graded(n, decades(j), mod(i, 3) == 0, k, m)
                call quad_frequencies(k, m, omega2)
                call normal_modes(k, m, modes, error)
                call assertFalse(allocated(error), "no error: graded matrices keep their digits")
                if (anyExceptions()) return
                worst = max(worst, maxval(abs(modes%omega2/omega2 - 1.0_dp)))
            end do
        end do
        call assertLessThan(worst, 7*400*epsilon(worst), message="relative")
    end subroutine graded_matrices_keep_their_digits

    subroutine draw_graded(n, decades, indefinite, k, m)
        !! See `graded_matrices_keep_their_digits`.
        integer, intent(in) :: n, decades
        logical, intent(in) :: indefinite
        real(dp), allocatable, intent(out) :: k(:, :), m(:, :)
        real(dp) :: scale(n, 2), sign_of
        integer :: i, j

        allocate (k(n, n), m(n, n))
        do j = 1, n
            scale(j, 1) = 10.0_dp**(decades*uniform(-0.25_dp, 0.25_dp))
            scale(j, 2) = 10.0_dp**(decades*uniform(-0.25_dp, 0.25_dp))
        end do
        do j = 1, n
            sign_of = merge(-1.0_dp, 1.0_dp, indefinite .and. j == 1)
            do i = 1, j
                k(i, j) = merge(sign_of, uniform(-0.12_dp, 0.12_dp), i == j)*scale(i, 1)*scale(j, 1)
                m(i, j) = merge(1.0_dp, uniform(-0.12_dp, 0.12_dp), i == j)*scale(i, 2)*scale(j, 2)
                k(j, i) = k(i, j)
                m(j, i) = m(i, j)
            end do
        end do
    end subroutine draw_graded

    subroutine quad_frequencies(k, m, omega2)
        !! Of \(L^{-1}KL^{-\top}\), \(M = LL^\top\), by Jacobi's rotations; ascending.
        real(dp), intent(in) :: k(:, :), m(:, :)
        real(dp), allocatable, intent(out) :: omega2(:)
        real(real128), dimension(size(k, 1), size(k, 1)) :: a, l
        real(real128) :: theta, t, c, s, x(size(k, 1)), y(size(k, 1))
        real(dp) :: values(size(k, 1))
        integer :: n, i, j, p, q, sweep

        n = size(k, 1)
        a = k
        l = 0.0_real128
        do j = 1, n
            do i = j, n
                l(i, j) = m(i, j) - dot_product(l(i, :j - 1), l(j, :j - 1))
                l(i, j) = merge(sqrt(abs(l(i, j))), l(i, j)/max(l(j, j), tiny(t)), i == j)
            end do
        end do
        do i = 1, n
            a(i, :) = (a(i, :) - matmul(l(i, :i - 1), a(:i - 1, :)))/l(i, i)
        end do
        do i = 1, n
            a(:, i) = (a(:, i) - matmul(a(:, :i - 1), l(i, :i - 1)))/l(i, i)
        end do
        do sweep = 1, 40
            do p = 1, n - 1
                do q = p + 1, n
                    if (abs(a(p, q)) <= 0.0_real128) cycle
                    theta = (a(q, q) - a(p, p))/(2.0_real128*a(p, q))
                    t = sign(1.0_real128, theta)/(abs(theta) + sqrt(theta**2 + 1.0_real128))
                    c = 1.0_real128/sqrt(t**2 + 1.0_real128)
                    s = t*c
                    x = a(:, p)
                    y = a(:, q)
                    a(:, p) = c*x - s*y
                    a(:, q) = s*x + c*y
                    x = a(p, :)
                    y = a(q, :)
                    a(p, :) = c*x - s*y
                    a(q, :) = s*x + c*y
                end do
            end do
        end do
        values = [(real(a(i, i), dp), i=1, n)]
        allocate (omega2(n))
        do i = 1, n
            omega2(i) = minval(values)
            values(minloc(values, 1)) = huge(values)
        end do
    end subroutine quad_frequencies

    subroutine residuals_of_wrong_modes_are_their_size()
        !! With small whole numbers, worked out by hand. Without G: the columns of the residual are
        !! (4, 4) and (2, 0), \(\|K\| = \|Z\| = 4\), n = 2. With G: \(\lambda = 2i\), \(u = (1, 0)\)
        !! leave (-5, 1 - 4i), \(\lambda = i\), \(u = (1, i)\) leave (-1 + i, 1 - i), and
        !! \(\rho^2\|M\| + \rho\|G\| + \|K\| = 8 + 4 + 4\).
        real(dp), parameter :: k(2, 2) = reshape([3.0_dp, 1.0_dp, 1.0_dp, 2.0_dp], [2, 2])
        real(dp), parameter :: m(2, 2) = reshape([2.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], [2, 2])
        real(dp), parameter :: g(2, 2) = reshape([0.0_dp, -2.0_dp, 2.0_dp, 0.0_dp], [2, 2])
        real(dp), parameter :: z(2, 2) = reshape([1.0_dp, 3.0_dp, 0.0_dp, 2.0_dp], [2, 2])
        complex(dp), parameter :: zero = (0.0_dp, 0.0_dp), one = (1.0_dp, 0.0_dp)
        complex(dp), parameter :: i = (0.0_dp, 1.0_dp)

        call assertEqual(8.0_dp/(4.0_dp*4.0_dp*2.0_dp*epsilon(1.0_dp)), &
                         residual_ratio(k, m, [1.0_dp, 2.0_dp], z), message="without G")
        call assertEqual((5.0_dp + sqrt(17.0_dp))/(16.0_dp*2.0_dp), epsilon(1.0_dp)* &
                         gyroscopic_ratio(k, g, m, [2.0_dp*i, i], reshape([one, zero, one, i], &
                                                                          [2, 2])), &
                         4.0_dp*epsilon(1.0_dp), "with G")
        call assertEqual(0.0_dp, gyroscopic_ratio(0.0_dp*k, 0.0_dp*g, 0.0_dp*m, [i, i], &
                                                  reshape([one, zero, one, i], [2, 2])), &
                         message="nothing at all")
    end subroutine residuals_of_wrong_modes_are_their_size

    subroutine bad_matrices_give_nothing()
        !! One line, status 2 for what can be seen, 4 for what LAPACK finds.
        real(dp) :: good(2, 2), bad(2, 2)

        good = reshape([2.0_dp, 0.5_dp, 0.5_dp, 1.0_dp], [2, 2])
        call refused(reshape([1.0_dp, 2.0_dp], [1, 2]), good, 2, &
                     "K is 1 by 2: a square matrix is needed")
        call refused(good, reshape([1.0_dp, 2.0_dp], [2, 1]), 2, &
                     "M is 2 by 1: a square matrix is needed")
        call refused(reshape([real(dp) ::], [0, 0]), good, 2, &
                     "K is 0 by 0: a square matrix is needed")
        call refused(reshape([1.0_dp], [1, 1]), good, 2, "K has 1 rows, M has 2")
        bad = good
        bad(1, 2) = 0.4_dp
        call refused(bad, good, 2, "K is not symmetric: K(1, 2) = 0.4, K(2, 1) = 0.5")
        call refused(good, bad, 2, "M is not symmetric: M(1, 2) = 0.4, M(2, 1) = 0.5")
        bad = good
        bad(1, 1) = ieee_value(1.0_dp, ieee_quiet_nan)
        call refused(bad, good, 2, "K(1, 1) is not finite")
        call refused(good, bad, 2, "M(1, 1) is not finite")
        bad = good
        bad(1, 2) = 3.0_dp
        bad(2, 1) = 3.0_dp
        call refused(good, bad, 4, &
                     "M is not positive definite: its leading minor of order 2 is not")
        bad = 0.5_dp
        call refused(good, bad, 4, "M is singular to working precision: its leading minor of "// &
                     "order 2 vanishes")
    end subroutine bad_matrices_give_nothing

    subroutine refused(k, m, status, message)
        !! Assert that these matrices are refused so, stay as they are, and that no mode is left,
        !! neither of them nor of an earlier call.
        real(dp), intent(in) :: k(:, :), m(:, :)
        integer, intent(in) :: status
        character(*), intent(in) :: message
        type(normal_modes_t) :: modes
        type(error_t), allocatable :: error
        real(dp), allocatable :: stiffness(:, :), inertia(:, :)

        call normal_modes(chain(3, .true.), diagonal([1.0_dp, 2.0_dp, 3.0_dp]), modes, error)
        call assertTrue(allocated(modes%omega2), "an earlier call")
        allocate (stiffness, source=k)
        allocate (inertia, source=m)
        call normal_modes(stiffness, inertia, modes, error)
        call assertTrue(allocated(error), message)
        if (.not. allocated(error)) return
        call assertEqual(message, error%message)
        call assertEqual(status, error%status)
        call assertFalse(allocated(modes%omega2) .or. allocated(modes%omega) .or. &
                         allocated(modes%shapes) .or. allocated(modes%label), "modes")
        call assertTrue(all(transfer(stiffness, [0]) == transfer(k, [0])) .and. &
                        all(transfer(inertia, [0]) == transfer(m, [0])), "K and M stay")
    end subroutine refused

    subroutine elements_are_looked_at_on_both_sides()
        !! NaN above or below the diagonal; and what is negative may be unsymmetric by rounding, as
        !! what is positive.
        type(error_t), allocatable :: error
        real(dp), allocatable :: omega2(:), modes(:, :)
        real(dp), parameter :: unit(2, 2) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], &
                                                 [2, 2])
        real(dp) :: nan

        nan = ieee_value(1.0_dp, ieee_quiet_nan)
        call normal_modes(reshape([2.0_dp, 1.0_dp, nan, 2.0_dp], [2, 2]), &
                          unit, omega2, modes, error)
        call assertTrue(allocated(error), "above")
        if (allocated(error)) call assertEqual("K(1, 2) is not finite", error%message)
        call normal_modes(reshape([2.0_dp, nan, 1.0_dp, 2.0_dp], [2, 2]), &
                          unit, omega2, modes, error)
        call assertTrue(allocated(error), "below")
        if (allocated(error)) call assertEqual("K(1, 2) is not finite", error%message)
        call normal_modes(reshape([0.0_dp, -1.0_dp, -1.0_dp - epsilon(nan), 0.0_dp], [2, 2]), &
                          unit, omega2, modes, error)
        call assertFalse(allocated(error), "rounding of a negative element")
        if (allocated(error)) return
        call assertEqual([-1.0_dp, 1.0_dp], omega2, tolerance=1e-14_dp, message="its modes")
    end subroutine elements_are_looked_at_on_both_sides
end module test_normal_modes
