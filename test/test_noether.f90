module test_noether
    !! Noether's search: its null space, what it finds, what it must not find.
    use funit, only: TestMethod, TestSuite, anyExceptions, assertEqual, assertFalse, assertTrue
    use lagrangia_errors, only: error_t
    use lagrangia_generators, only: count_generators, find_symmetries, of_product, of_sine, &
        of_time, &
                                    outside, shift
    use lagrangia_kinds, only: dp
    use lagrangia_null_space, only: null_space
    use lagrangia_oscillator, only: oscillator_t
    use lagrangia_report, only: report_t
    use page_rows, only: check_row, new_page
    implicit none (type, external)
    private
    public :: noether_suite

contains

    function noether_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("noether")
        call suite%addTest(TestMethod("null_spaces", null_spaces))
        call suite%addTest(TestMethod("places_are_all_different", places_are_all_different))
        call suite%addTest(TestMethod("an_oscillator_has_its_energy", an_oscillator_has_its_energy))
        call suite%addTest(TestMethod("what_is_found", what_is_found))
        call suite%addTest(TestMethod("the_picture", the_picture))
    end function noether_suite

    subroutine null_spaces()
        !! Of \((1, 2, 3)\), three times: two vectors, across it and each other; of a regular
        !! matrix none, of zeros all; too few rows and NaN are refused.
        real(dp), allocatable :: basis(:, :)
        type(error_t), allocatable :: error
        real(dp) :: matrix(3, 3), nan

        matrix = spread([1.0_dp, 2.0_dp, 3.0_dp], 1, 3)
        call null_space(matrix, basis, error)
        call assertFalse(allocated(error), "rank 1")
        if (anyExceptions()) return
        call assertEqual([3, 2], shape(basis), "two vectors")
        call assertEqual(0.0_dp, maxval(abs(matmul(matrix, basis))), 1e-14_dp, "taken to zero")
        call assertEqual([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], &
                         reshape(matmul(transpose(basis), basis), [4]), 1e-14_dp, "orthonormal")
        matrix(2, 2) = 5.0_dp
        matrix(3, 3) = -1.0_dp
        call null_space(matrix, basis, error)
        call assertEqual([3, 0], shape(basis), "regular")
        call null_space(0.0_dp*matrix, basis, error)
        call assertEqual([3, 3], shape(basis), "nothing but zeros: every vector")
        call null_space(matrix(:2, :), basis, error)
        call assertTrue(allocated(error), "too few rows")
        nan = 0.0_dp
        matrix(1, 1) = nan/nan
        call null_space(matrix, basis, error)
        call assertTrue(allocated(error), "NaN")
    end subroutine null_spaces

    subroutine places_are_all_different()
        !! The products end where the list ends.
        call assertEqual([9, 19, 32], [count_generators(1), count_generators(2), &
                                        count_generators(3)], "numbers")
        call assertEqual([9, 19, 32], [of_product(1, 1, 1), of_product(2, 2, 2), &
                                        of_product(3, 3, 3)], "the last product")
        call assertEqual(of_product(3, 1, 3) + 1, of_product(3, 2, 2), "row by row")
        call assertTrue(of_sine(2, 2) < of_product(2, 1, 1) .and. of_time(2) > shift(2), "order")
    end subroutine places_are_all_different

    subroutine an_oscillator_has_its_energy()
        !! And nothing else of what is tried: its other symmetries turn with the time.
        type(oscillator_t) :: oscillator
        real(dp), allocatable :: symmetries(:, :)
        type(error_t), allocatable :: error
        real(dp) :: time(9)

        call oscillator%configure([0.5_dp, 2.0_dp], error)
        call find_symmetries(oscillator, symmetries, error)
        call assertFalse(allocated(error), "oscillator")
        if (anyExceptions()) return
        time = 0.0_dp
        time(of_time(1)) = 1.0_dp
        call assertEqual([9, 1], shape(symmetries), "one")
        call assertEqual(0.0_dp, outside(symmetries, time), 1e-14_dp, "the energy")
        time(of_time(1)) = 0.0_dp
        time(shift(1)) = 3.0_dp
        call assertEqual(1.0_dp, outside(symmetries, time), 1e-14_dp, "a shift is all outside")
    end subroutine an_oscillator_has_its_energy

    subroutine what_is_found()
        !! Known vectors are inside to rounding, which rows of the page say; here what is outside:
        !! a shift of theta has no part in any of the three, one of L_z with g neither.
        type(report_t) :: page

        call new_page("noether", page)
        call check_row(page, "cart-pendulum: of 9", "how many", 3.0_dp, 3.0_dp, 0.0_dp)
        call check_row(page, "cart-pendulum: of 9", "delta theta = 1?", 1.0_dp, 0.0_dp, &
                       1e-11_dp)
        call check_row(page, "double pendulum with g", "delta th1", 1.0_dp, 0.0_dp, 1e-11_dp)
        call check_row(page, "double pendulum without g", "how many", 2.0_dp, 2.0_dp, 0.0_dp)
        call check_row(page, "charge", "that is m v_x", 1.3_dp*0.6_dp + 0.8_dp*1.5_dp*0.9_dp, &
                       1.3_dp*0.6_dp + 0.8_dp*1.5_dp*0.9_dp, 1e-11_dp)
    end subroutine what_is_found

    subroutine the_picture()
        !! Three level lines, and one that swings.
        type(report_t) :: page
        real(dp) :: span(4)

        call new_page("noether", page)
        if (anyExceptions()) return
        associate (values => page%picture%values)
            call assertEqual(301, size(values, 2), "samples")
            span = maxval(values(2:, :), 2) - minval(values(2:, :), 2)
            call assertTrue(all(span(:3) < 1e-10_dp) .and. span(4) > 1.0_dp, "level, but the last")
        end associate
        call assertTrue(index(page%picture%title, "p_theta swings") > 0, &
                        "title")
    end subroutine the_picture
end module test_noether
