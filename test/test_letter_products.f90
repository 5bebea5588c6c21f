module test_letter_products
    !! Letters that stand for sums in the formulas of a sheet, and products that explain a factor.
    use funit, only: TestMethod, TestSuite, assertEqual, assertFalse, assertTrue
    use lagrangia_expression, only: apply, expression_t, f_abs, operator(*), operator(+), &
                                    operator(-), symbol, whole
    use lagrangia_kinds, only: dp
    use lagrangia_letter_products, only: add_letters, find_product, letter_t
    use lagrangia_sample_names, only: draws, role_parameter, samples_t, states
    implicit none (type, external)
    private
    public :: letter_products_suite

contains

    function letter_products_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("letter_products")
        call suite%addTest(TestMethod("sums_that_are_alike_in_some_draws", &
                                      sums_that_are_alike_in_some_draws))
        call suite%addTest(TestMethod("tiny_factors_are_no_fractions", &
                                      tiny_factors_are_no_fractions))
    end function letter_products_suite

    subroutine sums_that_are_alike_in_some_draws()
        !! a - b and |a - b| + 0 have the same values where a is larger, and are two letters.
        type(samples_t) :: samples
        type(letter_t), allocatable :: letters(:)
        integer :: row

        samples%ndof = 0
        samples%role = [role_parameter, role_parameter]
        samples%rate = [0, 0]
        allocate (samples%values(draws*states, 2))
        do row = 1, draws*states
            samples%values(row, :) = [2.0_dp, (row - 1)/states + 0.5_dp]
        end do
        allocate (letters(0))
        call add_letters(samples, (symbol(1) - symbol(2))*(apply(f_abs, symbol(1) - symbol(2)) + &
                                                           whole(0)), letters)
        call assertEqual(2, size(letters))
    end subroutine sums_that_are_alike_in_some_draws

    subroutine tiny_factors_are_no_fractions()
        !! What rounds to 0 for every denominator is no simple fraction; 1/2 is one.
        type(letter_t) :: none(0)
        type(expression_t) :: product
        logical :: found
        integer :: i

        call find_product([(1e-9_dp, i=1, draws)], none, product, found)
        call assertFalse(found, message="no product")
        call find_product([(0.5_dp, i=1, draws)], none, product, found)
        call assertTrue(found, message="a product")
        call assertEqual(3, product%count, message="1/2")
    end subroutine tiny_factors_are_no_fractions
end module test_letter_products
