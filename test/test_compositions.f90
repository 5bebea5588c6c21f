module test_compositions
    !! The table of drifts and kicks: order conditions as identities, in quadruple precision.
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

    integer, parameter :: most_kicks = 18

    type :: tree_t
        !! One of Nystrom's trees; see `nystrom_defect`.
        integer :: order = 0
        real(qp) :: g = 0.0_qp
        real(qp) :: phi(most_kicks) = 0.0_qp
    end type tree_t

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
        call suite%addTest(TestMethod("nystrom_conditions_hold", nystrom_conditions_hold))
    end function compositions_suite

    subroutine order_conditions_hold()
        !! To the rounding of quadruple precision: some 200 products of numbers up to 2.
        type(row_t) :: row
        integer :: i, checked

        checked = 0
        i = 0
        do
            i = i + 1
            call nth_row(i, row)
            if (row%order == 0) exit
            if (.not. allocated(row%gamma)) cycle
            checked = checked + 1
            call assertLessThan(real(worst(row%gamma, 1, row%order), dp), 1e-30_dp, &
                                message=trim(row%name)//": order conditions")
        end do
        call assertEqual(8, checked, "rows checked")
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
            if (.not. allocated(row%gamma)) cycle
            call assertGreaterThan(real(worst(row%gamma, row%order + 1, row%order + 1), dp), &
                                   1e-4_dp, message=trim(row%name)//": no higher order")
        end do
    end subroutine conditions_of_the_next_order_fail

    subroutine rows_are_symmetric_and_sum_to_one()
        !! Symmetric to the last bit; a drift between two kicks, or a kick between two drifts.
        type(row_t) :: row
        integer :: i

        i = 0
        do
            i = i + 1
            call nth_row(i, row)
            if (row%order == 0) exit
            call assertEqual(merge(-1, 1, row%kick_first), size(row%drift) - size(row%kick), &
                             message=trim(row%name)//": drifts and kicks")
            call check_list(row%drift, trim(row%name)//": drifts")
            call check_list(row%kick, trim(row%name)//": kicks")
        end do
    end subroutine rows_are_symmetric_and_sum_to_one

    subroutine check_list(list, name)
        !! Symmetric, and 1 in all, to the rounding of numbers of about 1.
        real(qp), intent(in) :: list(:)
        character(*), intent(in) :: name

        call assertTrue(all(abs(list - list(size(list):1:-1)) <= 0.0_qp), name//": symmetric")
        call assertLessThan(real(abs(sum(list) - 1.0_qp), dp), 1e-32_dp, message=name//": sum")
    end subroutine check_list

    subroutine nystrom_conditions_hold()
        !! Of all rows, to rounding; and those of the next odd order do not.
        type(row_t) :: row
        integer :: i

        i = 0
        do
            i = i + 1
            call nth_row(i, row)
            if (row%order == 0) exit
            call assertLessThan(nystrom_defect(row, 1, row%order), 1e-30_dp, &
                                message=trim(row%name)//": Nystrom's order conditions")
            if (row%order > 6) cycle  ! the list of trees would get long
            call assertGreaterThan(nystrom_defect(row, row%order + 1, row%order + 1), 1e-9_dp, &
                                   message=trim(row%name)//": no higher order")
        end do
    end subroutine nystrom_conditions_hold

    function nystrom_defect(row, lowest, highest) result(worst)
        !! The largest defect \(\sum_ib_i\Phi_i(\tau) - g(\tau)\) of the trees of these orders.
        !!
        !! A tree is a force whose arguments are the start velocity, with the weight \(c_i\), or
        !! other forces: \(\Phi_i(\tau) = c_i^m\prod_k\sum_ja_{ij}\Phi_j(\tau_k)\) with
        !! \(a_{ij} = b_j(c_i - c_j)\). Its order is \(\rho = 1 + m + \sum_k(\rho_k + 1)\), and the
        !! exact velocity has \(g = \rho^{-1}\prod_kg_k/(\rho_k + 1)\). What holds for the velocity
        !! holds for the position. Hairer, Norsett & Wanner, *Solving ODEs I*, sec. II.14.
        type(row_t), intent(in) :: row
        integer, intent(in) :: lowest, highest
        real(dp) :: worst
        real(qp) :: c(size(row%kick)), a(size(row%kick), size(row%kick)), ones(size(row%kick))
        type(tree_t), allocatable :: trees(:)
        integer :: i, j, order

        do i = 1, size(c)
            c(i) = sum(row%drift(:merge(i - 1, i, row%kick_first)))
        end do
        a = 0.0_qp
        do i = 1, size(c)
            do j = 1, i - 1
                a(i, j) = row%kick(j)*(c(i) - c(j))
            end do
        end do
        ones = 1.0_qp
        allocate (trees(0))
        do order = 1, highest
            call extend_tree(ones, 0, 1.0_qp, 0, order, c, a, trees)
        end do
        worst = 0.0_dp
        do i = 1, size(trees)
            if (trees(i)%order < lowest) cycle
            worst = max(worst, real(abs(sum(row%kick*trees(i)%phi(:size(row%kick))) &
                                        - trees(i)%g), dp))
        end do
    end function nystrom_defect

    recursive subroutine extend_tree(phi, degree, g, first, order, c, a, trees)
        !! All trees of `order` that go on from this product: more velocities while `first` is 0,
        !! then forces from number `first` of the list on.
        real(qp), intent(in) :: phi(:), g, c(:), a(:, :)
        integer, intent(in) :: degree, first, order
        type(tree_t), allocatable, intent(inout) :: trees(:)
        type(tree_t) :: tree
        integer :: k, known

        known = size(trees)
        if (degree + 1 == order) then
            tree%order = order
            tree%g = g/order
            tree%phi(:size(phi)) = phi
            trees = [trees, tree]
            return
        end if
        if (first == 0) call extend_tree(phi*c, degree + 1, g, 0, order, c, a, trees)
        do k = max(first, 1), known
            if (degree + trees(k)%order + 2 > order) cycle
            call extend_tree(phi*matmul(a, trees(k)%phi(:size(phi))), degree + trees(k)%order + 1, &
                             g*trees(k)%g/(trees(k)%order + 1), k, order, c, a, trees)
        end do
    end subroutine extend_tree

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
