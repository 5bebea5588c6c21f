module test_normal_modes
    !! Normal modes of anybody's K and M, as another program asks for them.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia, only: dp, error_t, is_oscillation, is_unstable, is_zero_mode, normal_modes, &
                         normal_modes_t
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
        call suite%addTest(TestMethod("bad_matrices_give_nothing", bad_matrices_give_nothing))
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
        call assertFalse(allocated(error))
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
            call assertFalse(allocated(error))
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
        call assertFalse(allocated(error))
        if (anyExceptions()) return
        call assertEqual([-4.0_dp, 9.0_dp], modes%omega2, 1e-14_dp)
        call assertEqual([is_unstable, is_oscillation], modes%label)
        call assertTrue(ieee_is_nan(modes%omega(1)), "no frequency")
        call assertEqual(3.0_dp, modes%omega(2), 1e-15_dp)
    end subroutine negative_springs_are_unstable

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
end module test_normal_modes
