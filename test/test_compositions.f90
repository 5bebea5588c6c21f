module test_compositions
    !! The table of compositions: order conditions as identities, in quadruple precision.
    !!
    !! A symmetric method of order 2 is \(\exp(hX_1 + h^3X_3 + h^5X_5 + \dots)\) with operators
    !! that do not commute. A composition has order \(p\) where the product of all
    !! \(\exp(\gamma_sX_1 + \gamma_s^3X_3 + \dots)\) is \(\exp X_1\) in every word of degree up to
    !! \(p\). In \(\exp(\gamma X_1 + \gamma^3X_3 + \dots)\) a word of \(m\) letters and degree \(d\)
    !! has the coefficient \(\gamma^d/m!\).
    use funit, only: TestMethod, TestSuite, assertEqual, assertGreaterThan, assertLessThan, &
                     assertTrue
    use lagrangia_composition_table, only: nth_row, row_t
    use lagrangia_kinds, only: dp, qp
    implicit none (type, external)
    private
    public :: compositions_suite

contains

    function compositions_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("compositions")
        call suite%addTest(TestMethod("order_conditions_hold", order_conditions_hold))
        call suite%addTest(TestMethod("conditions_of_the_next_order_fail", &
                                      conditions_of_the_next_order_fail))
        call suite%addTest(TestMethod("rows_are_symmetric_and_sum_to_one", &
                                      rows_are_symmetric_and_sum_to_one))
    end function compositions_suite

    subroutine order_conditions_hold()
        !! To the rounding of quadruple precision: some 200 products of numbers up to 2.
        type(row_t) :: row
        integer :: i

        i = 0
        do
            i = i + 1
            call nth_row(i, row)
            if (row%order == 0) exit
            call assertLessThan(real(worst(row%gamma, 1, row%order), dp), 1e-30_dp, &
                                message=trim(row%name)//": order conditions")
        end do
        call assertGreaterThan(i, 8, message="rows checked")
    end subroutine order_conditions_hold

    subroutine conditions_of_the_next_order_fail()
        !! A row does not have more than its order: the next, odd, degree is the error itself.
        type(row_t) :: row
        integer :: i

        i = 0
        do
            i = i + 1
            call nth_row(i, row)
            if (row%order == 0) exit
            call assertGreaterThan(real(worst(row%gamma, row%order + 1, row%order + 1), dp), &
                                   1e-4_dp, message=trim(row%name)//": no higher order")
        end do
    end subroutine conditions_of_the_next_order_fail

    subroutine rows_are_symmetric_and_sum_to_one()
        !! Symmetric to the last bit.
        type(row_t) :: row
        integer :: i, n

        i = 0
        do
            i = i + 1
            call nth_row(i, row)
            if (row%order == 0) exit
            n = size(row%gamma)
            call assertEqual(1, mod(n, 2), message=trim(row%name)//": an odd number of stages")
            call assertTrue(all(abs(row%gamma - row%gamma(n:1:-1)) <= 0.0_qp), &
                            trim(row%name)//": symmetric")
            call assertLessThan(real(abs(sum(row%gamma) - 1.0_qp), dp), 1e-32_dp, &
                                message=trim(row%name)//": sum")
        end do
    end subroutine rows_are_symmetric_and_sum_to_one

    function worst(gamma, lowest, highest)
        !! The largest defect of all words whose degree is between `lowest` and `highest`.
        real(qp), intent(in) :: gamma(:)
        integer, intent(in) :: lowest, highest
        real(qp) :: worst
        integer :: degree

        worst = 0.0_qp
        do degree = lowest, highest
            call extend_word([integer ::], degree, gamma, worst)
        end do
    end function worst

    recursive subroutine extend_word(word, missing, gamma, worst)
        !! Try all words that begin with `word` and have `missing` degrees more.
        integer, intent(in) :: word(:), missing
        real(qp), intent(in) :: gamma(:)
        real(qp), intent(inout) :: worst
        integer :: letter

        if (missing == 0) worst = max(worst, abs(defect(word, gamma)))
        do letter = 1, missing, 2
            call extend_word([word, letter], missing - letter, gamma, worst)
        end do
    end subroutine extend_word

    function defect(word, gamma)
        !! The coefficient of `word` in the product, less that in \(\exp X_1\).
        integer, intent(in) :: word(:)
        real(qp), intent(in) :: gamma(:)
        real(qp) :: defect, product_so_far(0:size(word)), factorial(0:size(word))
        integer :: s, j, k

        factorial = 1.0_qp
        do j = 2, size(word)
            factorial(j) = factorial(j - 1)*j
        end do
        product_so_far = 0.0_qp
        product_so_far(0) = 1.0_qp
        do s = 1, size(gamma)
            do j = size(word), 1, -1
                do k = 0, j - 1  ! the first k letters from before, the others from this factor
                    product_so_far(j) = product_so_far(j) + product_so_far(k) &
                                        *gamma(s)**sum(word(k + 1:j))/factorial(j - k)
                end do
            end do
        end do
        defect = product_so_far(size(word))
        if (all(word == 1)) defect = defect - 1.0_qp/factorial(size(word))
    end function defect
end module test_compositions
