module test_dop853_coefficients
    !! The tables of `dop853` obey the order conditions to the digits that they are printed with.
    use funit, only: assertEqual, assertGreaterThan, assertLessThanOrEqual, TestMethod, TestSuite
    use lagrangia_dop853_coefficients, only: a, a_qp, all_stages, b, b_qp, c, c_qp, d, d_qp, e3, &
                                             e3_qp, e5, e5_qp
    use lagrangia_dop853_stages, only: extra_stages, scaled_error, slope, stages
    use lagrangia_kinds, only: dp, qp
    use lagrangia_text, only: to_text
    use plain_system, only: plain_system_t
    use rooted_trees, only: grow_trees, trees_t
    implicit none (type, external)
    private
    public :: dop853_coefficients_suite

    real(qp), parameter :: printed = 1e-26_qp
    !! The tables have some 29 digits behind the first, and the largest entries are below 1e3:
    !! a condition holds to about this, times what its terms add up to.
    integer, parameter :: through(8) = [1, 2, 4, 8, 17, 37, 85, 200]
    !! number of rooted trees up to each order (OEIS A000081, summed)

contains

    function dop853_coefficients_suite() result(suite)
        type(TestSuite) :: suite

        suite = TestSuite("dop853_coefficients")
        call suite%addTest(TestMethod("the rows add up to the nodes", rows_add_up))
        call suite%addTest(TestMethod("the solution has order 8", solution_has_order_8))
        call suite%addTest(TestMethod("the embedded solutions have orders 5 and 3", &
                                      embedded_orders))
        call suite%addTest(TestMethod("the dense output has order 7", dense_output_has_order_7))
        call suite%addTest(TestMethod("what is used is rounded from what is tested", &
                                      rounded_tables))
        call suite%addTest(TestMethod("the stages use all of the tables", stages_use_the_tables))
    end function dop853_coefficients_suite

    subroutine rows_add_up()
        integer :: i

        do i = 1, all_stages
            call check(sum(a_qp(:, i)), c_qp(i), sum(abs(a_qp(:, i))) + 1.0_qp, &
                       "stage "//to_text(i))
            call check(sum(abs(a_qp(i:, i))), 0.0_qp, 1.0_qp, "explicit stage "//to_text(i))
        end do
    end subroutine rows_add_up

    subroutine solution_has_order_8()
        type(trees_t) :: trees
        integer :: i

        call grow_trees(trees, a_qp(:12, :12), 8)
        call assertEqual(200, trees%count, message="trees up to order 8")
        do i = 1, 8
            call assertEqual(through(i), count(trees%order(:trees%count) <= i), &
                             message="trees up to order "//to_text(i))
        end do
        do i = 1, trees%count
            call check(sum(b_qp*trees%phi(:, i)), 1.0_qp/trees%density(i), &
                       sum(abs(b_qp*trees%phi(:, i))), "tree "//to_text(i))
        end do
    end subroutine solution_has_order_8

    subroutine embedded_orders()
        type(trees_t) :: trees
        integer :: i

        call grow_trees(trees, a_qp(:12, :12), 6)
        do i = 1, through(5)
            call check(sum(e5_qp*trees%phi(:, i)), 0.0_qp, sum(abs(e5_qp*trees%phi(:, i))), &
                       "order 5, tree "//to_text(i))
        end do
        do i = 1, through(3)
            call check(sum(e3_qp*trees%phi(:, i)), 0.0_qp, sum(abs(e3_qp*trees%phi(:, i))), &
                       "order 3, tree "//to_text(i))
        end do
        call assertGreaterThan(largest(matmul(e5_qp, trees%phi(:, through(5) + 1:through(6)))), &
                               1e-4_dp, message="not order 6")
        call assertGreaterThan(largest(matmul(e3_qp, trees%phi(:, through(3) + 1:through(4)))), &
                               1e-4_dp, message="not order 4")
    end subroutine embedded_orders

    subroutine dense_output_has_order_7()
        !! Polynomials of degree 7 in the place `s`: eight places test all of each.
        type(trees_t) :: trees
        real(qp) :: s, weights(16), f(16, 7), first(16), last(16)
        integer :: i, k

        call grow_trees(trees, a_qp, 7)
        first = 0.0_qp
        last = 0.0_qp
        first(1) = 1.0_qp
        last(13) = 1.0_qp
        f(:, 1) = 0.0_qp
        f(:12, 1) = b_qp
        f(:, 2) = first - f(:, 1)
        f(:, 3) = f(:, 1) - last - f(:, 2)
        f(:, 4:) = d_qp
        do k = 1, 9
            s = k/8.0_qp
            weights = f(:, 7)
            do i = 6, 1, -1
                weights = f(:, i) + merge(s, 1 - s, mod(i, 2) == 0)*weights
            end do
            weights = s*weights
            do i = 1, through(7)
                call check(sum(weights*trees%phi(:, i)), s**trees%order(i)/trees%density(i), &
                           sum(abs(weights*trees%phi(:, i))) + 400.0_qp, &
                           "place "//to_text(k)//", tree "//to_text(i))
            end do
        end do
    end subroutine dense_output_has_order_7

    subroutine rounded_tables()
        real(dp), parameter :: half_ulp = 0.5_dp*epsilon(1.0_dp)
        real(qp), parameter :: least = 1e-9_qp  !! no entry is smaller, but for zeros

        call assertLessThanOrEqual(largest([(a - a_qp)/max(abs(a_qp), least)]), &
                                   half_ulp, message="a")
        call assertLessThanOrEqual(largest([(d - d_qp)/max(abs(d_qp), least)]), &
                                   half_ulp, message="d")
        call assertLessThanOrEqual(largest([(b - b_qp)/max(abs(b_qp), least), &
                                            (c - c_qp)/max(abs(c_qp), least), &
                                            (e3 - e3_qp)/max(abs(e3_qp), least), &
                                            (e5 - e5_qp)/max(abs(e5_qp), least)]), half_ulp, &
                                   message="b, c, e3, e5")
    end subroutine rounded_tables

    subroutine stages_use_the_tables()
        !! The sums without zeros that a step is made of, beside sums over all; time, coordinates
        !! and velocities count, and two numbers are larger than 1. Weights reach 43, those of the
        !! dense output 528.
        real(dp), parameter :: t = 0.2_dp, h = 0.4_dp, tolerance = 1e-3_dp
        real(dp), parameter :: y0(4) = [0.8_dp, 1.9_dp, -1.4_dp, 0.6_dp]
        type(plain_system_t) :: system
        real(dp) :: f(4, 16), y1(4), y(4), k(4, 17), dense(7, 4), work(4), weight(4)
        real(dp) :: fifth, third
        integer :: i

        system%ndof = 2
        call slope(system, 2, t, y0, f(:, 1))
        do i = 2, 16
            y = y0 + h*matmul(f(:, :i - 1), a(:i - 1, i))
            if (i == 13) y1 = y
            call slope(system, 2, t + c(i)*h, y, f(:, i))
        end do
        k = 0.0_dp
        call slope(system, 2, t, y0, k(:, 1))
        call stages(system, 2, t, h, y0, k, y)
        call assertEqual(y1, y, 1e-14_dp, "end of the step")
        call extra_stages(system, 2, t, h, y0, y, k, dense, work)
        do i = 2, 16
            call assertEqual(f(:, i), k(:, i) + k(:, 1), 1e-13_dp, "stage "//to_text(i))
        end do
        call assertEqual(f(:, 13), k(:, 17), 1e-14_dp, "slope at the end")
        call assertEqual(y1 - y0, dense(1, :), 1e-14_dp, "difference")
        call assertEqual(h*f(:, 1) - (y1 - y0), dense(2, :), 1e-14_dp, "first correction")
        call assertEqual(2.0_dp*(y1 - y0) - h*(f(:, 1) + f(:, 13)), dense(3, :), 1e-14_dp, "second")
        do i = 4, 7
            call assertEqual(h*matmul(f, d(:, i)), dense(i, :), 1e-12_dp, "row "//to_text(i))
        end do
        weight = max(1.0_dp, abs(y0), abs(y1))
        fifth = sum((matmul(f(:, :12), e5)/weight)**2)
        third = sum((matmul(f(:, :12), e3)/weight)**2)
        third = h/tolerance*fifth/sqrt(4.0_dp*(fifth + 0.01_dp*third))
        call assertEqual(third, scaled_error(h, tolerance, k, y0, y), 1e-8_dp*third, "estimate")
    end subroutine stages_use_the_tables

    pure function largest(values) result(value)
        real(qp), intent(in) :: values(:)
        real(dp) :: value

        value = real(maxval(abs(values)), dp)
    end function largest

    subroutine check(found, wanted, size, what)
        !! Equal to the digits that the tables are printed with.
        real(qp), intent(in) :: found, wanted, size
        character(*), intent(in) :: what

        call assertLessThanOrEqual(real(abs(found - wanted)/size, dp), real(printed, dp), &
                                   message=what)
    end subroutine check
end module test_dop853_coefficients
