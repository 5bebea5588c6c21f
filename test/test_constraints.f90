module test_constraints
    !! One-forms against geometry: differences, known brackets, the disk's loop.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_constraints, only: loop_of_disk
    use lagrangia_errors, only: error_t
    use lagrangia_hyperdual, only: hyperdual, hyperdual_t, operator(*), operator(**), operator(-), &
                                   sqrt
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: matrix_rank
    use lagrangia_lecture_constraints, only: classify, example_point, examples, &
                                             lecture_constraint_t, new_constraint, radius, turning
    use lagrangia_pfaffian, only: pfaffian_t
    use lagrangia_rolling_disk, only: rolling_disk_t
    implicit none (type, external)
    private
    public :: constraints_suite

    type, extends(pfaffian_t) :: engel_t
        !! \(dy - z\,dx = 0\), \(dz - w\,dx = 0\): two directions reach all four dimensions, but
        !! only by brackets of brackets. `power` = 3: \(dy - z^3dx\), flat at \(z = 0\).
        integer :: power = 1
    contains
        procedure :: forms => engel_forms
    end type engel_t

    type, extends(pfaffian_t) :: leaf_t
        !! \(dz - y\,dx = 0\) on the leaves \(w - xz^2 - yz = c\): brackets add one direction to
        !! two, and none leaves the leaf.
    contains
        procedure :: forms => leaf_forms
    end type leaf_t

    type, extends(pfaffian_t) :: two_forms_t
        !! Two forms: one depends on the time only, one on the coordinates only.
    contains
        procedure :: forms => two_forms
    end type two_forms_t

    type, extends(pfaffian_t) :: root_form_t
        !! With a root: no slope at \(y = 0\), no number below.
    contains
        procedure :: forms => root_form
    end type root_form_t

contains

    function constraints_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("constraints")
        call suite%addTest(TestMethod("ranks", ranks))
        call suite%addTest(TestMethod("every_class_is_found", every_class_is_found))
        call suite%addTest(TestMethod("forms_belong_to_their_functions", &
                                      forms_belong_to_their_functions))
        call suite%addTest(TestMethod("disk_is_the_systems", disk_is_the_systems))
        call suite%addTest(TestMethod("brackets_of_brackets", brackets_of_brackets))
        call suite%addTest(TestMethod("loops", loops))
        call suite%addTest(TestMethod("the_largest_of_two_forms_counts", &
                                      the_largest_of_two_forms_counts))
    end function constraints_suite

    subroutine ranks()
        !! Wide, tall, empty, zero, nearly dependent, not finite.
        type(error_t), allocatable :: error
        real(dp) :: matrix(3, 4), nan
        integer :: rank

        matrix = reshape([1.0_dp, 2.0_dp, 3.0_dp, 2.0_dp, 4.0_dp, 6.0_dp, 0.0_dp, 1.0_dp, 1.0_dp, &
                          1.0_dp, 3.0_dp, 4.0_dp], [3, 4])
        call matrix_rank(matrix, rank, error)
        call assertEqual(2, rank)
        call matrix_rank(transpose(matrix), rank, error)
        call assertEqual(2, rank)
        matrix(3, 4) = matrix(3, 4) + 1e-6_dp
        call matrix_rank(matrix, rank, error)
        call assertEqual(3, rank)
        matrix(3, 4) = 4.0_dp + 1e-13_dp
        call matrix_rank(matrix, rank, error)
        call assertEqual(2, rank)
        call matrix_rank(1e-200_dp*matrix, rank, error)
        call assertEqual(2, rank)
        call matrix_rank(0.0_dp*matrix, rank, error)
        call assertEqual(0, rank)
        call matrix_rank(matrix(:0, :), rank, error)
        call assertEqual(0, rank)
        call assertFalse(allocated(error), "no error: ranks")
        nan = 0.0_dp
        matrix(1, 2) = nan/nan
        call matrix_rank(matrix, rank, error)
        call assertTrue(allocated(error), "an error: ranks")
        if (anyExceptions()) return
        call assertEqual("rank: not every element is finite", error%message)
    end subroutine ranks

    subroutine every_class_is_found()
        !! By name, the lecture's verdicts; no two examples share a name.
        type(lecture_constraint_t) :: constraint
        type(error_t), allocatable :: error
        character(26) :: verdict
        integer :: growth(3), i

        call assertEqual(11, size(examples))
        do i = 1, size(examples)
            call assertEqual(1, count(examples%name == examples(i)%name))
            call new_constraint(constraint, examples(i))
            call classify(constraint, verdict, growth, error)
            call assertFalse(allocated(error), "no error: every class is found")
            call assertEqual(examples(i)%growth, growth, trim(examples(i)%name))
            select case (examples(i)%name)
            case ("disk", "disk, notes' dx")
                call assertEqual("nonholonomic, scleronomic", trim(verdict), trim(examples(i)%name))
            case ("rotating wire")
                call assertEqual("holonomic, rheonomic", trim(verdict), trim(examples(i)%name))
            case ("dx - t dy = 0")
                call assertEqual("nonholonomic, rheonomic", trim(verdict), trim(examples(i)%name))
            case ("y > 0")
                call assertEqual("unilateral, scleronomic", trim(verdict), trim(examples(i)%name))
            case default
                call assertEqual("holonomic, scleronomic", trim(verdict), trim(examples(i)%name))
            end select
        end do
    end subroutine every_class_is_found

    subroutine forms_belong_to_their_functions()
        !! The coefficients typed in are the derivatives of f, by central differences.
        type(lecture_constraint_t) :: constraint
        type(hyperdual_t) :: a(1, 5)
        real(dp) :: x(5), up, down
        real(dp), parameter :: step = 1e-5_dp
        integer :: i, k, n

        do i = 1, size(examples)
            if (examples(i)%rows > 1 .or. abs(f(examples(i)%name, x)) > 1e9_dp) cycle
            call new_constraint(constraint, examples(i))
            n = examples(i)%coordinates + 1
            x(:n) = example_point(n - 1, 3)
            call constraint%forms(hyperdual(x(:n)), a(:, :n))
            do k = 1, n
                x(:n) = example_point(n - 1, 3)
                x(k) = x(k) + step
                up = f(examples(i)%name, x)
                x(k) = x(k) - 2.0_dp*step
                down = f(examples(i)%name, x)
                call assertEqual((up - down)/(2.0_dp*step), a(1, k)%re, 1e-8_dp, &
                                 trim(examples(i)%name))
            end do
        end do
    contains
        pure function f(name, x) result(value)
            character(*), intent(in) :: name
            real(dp), intent(in) :: x(5)
            real(dp) :: value

            select case (name)
            case ("double pendulum f1"); value = x(1)**2 + x(2)**2
            case ("double pendulum f2"); value = (x(3) - x(1))**2 + (x(4) - x(2))**2
            case ("notes' f2"); value = x(3)**2 + x(4)**2
            case ("Atwood's rope"); value = x(1) + x(2)
            case ("rotating wire"); value = x(2)*cos(turning*x(3)) - x(1)*sin(turning*x(3))
            case default; value = huge(value)
            end select
        end function f
    end subroutine forms_belong_to_their_functions

    subroutine disk_is_the_systems()
        !! The same rows as the rolling disk's own, with its radius.
        type(lecture_constraint_t) :: constraint
        type(rolling_disk_t) :: disk
        type(error_t), allocatable :: error
        type(hyperdual_t) :: a(2, 5), rows(2, 4), drift(2)
        real(dp) :: x(5)
        integer :: k

        call disk%configure([1.3_dp, radius, 0.06_dp, 0.03_dp, 9.81_dp, 0.0_dp], error)
        call assertFalse(allocated(error), "no error: disk is the systems")
        call new_constraint(constraint, examples(findloc(examples%name == "disk", .true., 1)))
        do k = 1, 5
            x = example_point(4, k)
            call constraint%forms(hyperdual(x), a)
            call disk%constraint_rows(hyperdual(0.0_dp), hyperdual(x(:4)), rows, drift)
            call assertEqual(0.0_dp, maxval(abs(rows%re - a(:, :4)%re)), 1e-15_dp)
            call assertEqual(0.0_dp, maxval(abs(a(:, 5)%re)), 0.0_dp)
        end do
    end subroutine disk_is_the_systems

    subroutine brackets_of_brackets()
        !! Engel's form grows 2, 3, 4. With \(dy - z^3dx\), \(dz - w\,dx\) the third dimension of
        !! \(z = 0\) comes from w alone, and y needs more brackets than are taken.
        type(engel_t) :: engel
        type(leaf_t) :: leaf
        type(error_t), allocatable :: error
        integer :: dimensions(3)

        engel%coordinates = 4
        engel%rows = 2
        engel%timed = .false.
        call engel%growth([0.3_dp, -0.4_dp, 0.7_dp, 0.2_dp, 0.0_dp], dimensions, error)
        call assertFalse(allocated(error), "no error: brackets of brackets")
        call assertEqual([2, 3, 4], dimensions)
        engel%power = 3
        call engel%growth([0.3_dp, -0.4_dp, 0.7_dp, 0.2_dp, 0.0_dp], dimensions, error)
        call assertEqual([2, 3, 4], dimensions)
        call engel%growth([0.3_dp, -0.4_dp, 0.0_dp, 0.2_dp, 0.0_dp], dimensions, error)
        call assertEqual([2, 3, 3], dimensions)
        leaf%coordinates = 4
        leaf%rows = 2
        leaf%timed = .false.
        call leaf%growth([0.3_dp, -0.4_dp, 0.7_dp, 0.2_dp, 0.0_dp], dimensions, error)
        call assertEqual([2, 3, 3], dimensions)
    end subroutine brackets_of_brackets

    subroutine loops()
        !! The closed form for other angles; rolled by nothing, nothing moves.
        type(error_t), allocatable :: error
        real(dp), allocatable :: path(:, :)

        call loop_of_disk([-0.7_dp, 2.1_dp], -3.0_dp, path, error)
        call assertFalse(allocated(error), "no error: loops")
        call assertEqual([0.3_dp*3.0_dp*(sin(2.1_dp) + sin(0.7_dp)), &
                          -0.3_dp*3.0_dp*(cos(2.1_dp) - cos(0.7_dp)), 0.0_dp, -0.7_dp], &
                         path(2:, size(path, 2)), 1e-13_dp)
        call assertEqual(0.0_dp, path(1, 1), 0.0_dp)
        call assertEqual(4.0_dp, path(1, size(path, 2)), 1e-15_dp)
        call loop_of_disk([0.3_dp, 1.1_dp], 0.0_dp, path, error)
        call assertEqual(0.0_dp, maxval(abs(path(2:3, :))), 1e-15_dp)
    end subroutine loops

    subroutine the_largest_of_two_forms_counts()
        !! One of which is closed, and one of which does not move; and NaN is no integrable form.
        type(two_forms_t) :: two
        type(root_form_t) :: root

        two%coordinates = 2
        two%rows = 2
        call assertEqual(1.0_dp, two%curl([0.5_dp, 0.7_dp, 2.0_dp]), tolerance=0.0_dp, &
                         message="curl")
        call assertEqual(2.0_dp, two%motion([0.5_dp, 0.7_dp, 2.0_dp]), tolerance=0.0_dp, &
                         message="motion")
        call assertTrue(two%moves([0.5_dp, 0.7_dp, 2.0_dp]), "one of them moves")
        root%coordinates = 3
        root%rows = 1
        call assertEqual(1.0_dp, root%frobenius([0.5_dp, 1.0_dp, 2.0_dp, 1.0_dp]), &
                         tolerance=1e-15_dp, message="y = 1")
        call assertTrue(ieee_is_nan(root%frobenius([0.5_dp, 0.0_dp, 2.0_dp, 1.0_dp])), &
                        "no slope at y = 0")
        call assertTrue(ieee_is_nan(root%frobenius([0.5_dp, -1.0_dp, 2.0_dp, 1.0_dp])), &
                        "no root below")
    end subroutine the_largest_of_two_forms_counts

    pure subroutine engel_forms(self, x, a)
        !! Coordinates x, y, z, w.
        class(engel_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: x(self%coordinates + 1)
        type(hyperdual_t), intent(out) :: a(self%rows, self%coordinates + 1)

        a = hyperdual_t()
        a(1, 1) = (-1.0_dp)*x(3)**self%power
        a(1, 2) = hyperdual(1.0_dp)
        a(2, 1) = (-1.0_dp)*x(4)
        a(2, 3) = hyperdual(1.0_dp)
    end subroutine engel_forms

    pure subroutine leaf_forms(self, x, a)
        !! Coordinates x, y, z, w.
        class(leaf_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: x(self%coordinates + 1)
        type(hyperdual_t), intent(out) :: a(self%rows, self%coordinates + 1)

        a = hyperdual_t()
        a(1, 1) = (-1.0_dp)*x(2)
        a(1, 3) = hyperdual(1.0_dp)
        a(2, 1) = (-1.0_dp)*x(3)**2
        a(2, 2) = (-1.0_dp)*x(3)
        a(2, 3) = (-2.0_dp)*x(1)*x(3) - x(2)
        a(2, 4) = hyperdual(1.0_dp)
    end subroutine leaf_forms

    pure subroutine two_forms(self, x, a)
        !! \(dx + t\,dt\) and \(y\,dx + dy\).
        class(two_forms_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: x(self%coordinates + 1)
        type(hyperdual_t), intent(out) :: a(self%rows, self%coordinates + 1)

        a = hyperdual_t()
        a(1, 1) = hyperdual(1.0_dp)
        a(1, 3) = x(3)
        a(2, 1) = x(2)
        a(2, 2) = hyperdual(1.0_dp)
    end subroutine two_forms

    pure subroutine root_form(self, x, a)
        !! \(dx + \sqrt y\,dy + y\,dz\).
        class(root_form_t), intent(in) :: self
        type(hyperdual_t), intent(in) :: x(self%coordinates + 1)
        type(hyperdual_t), intent(out) :: a(self%rows, self%coordinates + 1)

        a = hyperdual_t()
        a(1, 1) = hyperdual(1.0_dp)
        a(1, 2) = sqrt(x(2))
        a(1, 3) = x(2)
    end subroutine root_form
end module test_constraints
