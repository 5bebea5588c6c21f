module test_gauss_tables
    !! The coefficients of Gauss-Legendre collocation, as identities to rounding.
    use funit, only: TestMethod, TestSuite, assertEqual, assertGreaterThan, assertLessThanOrEqual
    use lagrangia_gauss_tables, only: legendre, mu, nodes, stages, weights
    use lagrangia_kinds, only: dp, qp
    implicit none (type, external)
    private
    public :: gauss_tables_suite

    real(dp), parameter :: rounding = 2.0_dp*epsilon(1.0_dp)  !! of sums of eight terms up to 1

contains

    function gauss_tables_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("gauss_tables")
        call suite%addTest(TestMethod("quadrature_has_order_16", quadrature_has_order_16))
        call suite%addTest(TestMethod("entries_are_rounded_exact_ones", &
                                      entries_are_rounded_exact_ones))
        call suite%addTest(TestMethod("stages_collocate", stages_collocate))
        call suite%addTest(TestMethod("table_is_symplectic_and_symmetric", &
                                      table_is_symplectic_and_symmetric))
        call suite%addTest(TestMethod("legendre_polynomials_are_orthogonal", &
                                      legendre_polynomials_are_orthogonal))
    end function gauss_tables_suite

    subroutine quadrature_has_order_16()
        !! \(\sum_j b_j c_j^{k-1} = 1/k\) up to k = 16, and not for k = 17.
        integer :: k

        do k = 1, 16
            call assertEqual(1.0_dp/k, sum(weights*nodes**(k - 1)), rounding, "B(k)")
        end do
        call assertGreaterThan(abs(sum(weights*nodes**16) - 1.0_dp/17.0_dp), 1e-11_dp, &
                               message="B(17)")
    end subroutine quadrature_has_order_16

    subroutine entries_are_rounded_exact_ones()
        !! To the nearest double, against the zeros of \(P_8\) and the formulae that the table is
        !! from, in quadruple precision. Of symmetric pairs one is rounded: the other follows.
        real(qp) :: c(stages), p(stages, 0:stages), b(stages), exact
        integer :: i, j, k

        c = nodes
        do k = 1, 3  ! Newton's method doubles the digits
            p = shifted_legendre(c)
            c = c + 0.25_qp*c*(1.0_qp - c)*p(:, 8)/((2.0_qp*c - 1.0_qp)*p(:, 8) - p(:, 7))
        end do
        p = shifted_legendre(c)
        b = c*(1.0_qp - c)/(4.0_qp*p(:, 7))**2
        do i = 1, stages
            if (i <= stages/2) call check_rounding(nodes(i), c(i))
            call check_rounding(weights(i), b(i))
            do j = 1, i - 1
                exact = 0.5_qp
                do k = 1, stages - 1  ! orthonormal: times the root of (2k + 1)(2k - 1)
                    exact = exact + 0.5_qp*(p(i, k)*p(j, k - 1) - p(i, k - 1)*p(j, k))
                end do
                call check_rounding(mu(i, j), exact)
            end do
        end do
    end subroutine entries_are_rounded_exact_ones

    function shifted_legendre(c) result(p)
        !! \(P_0, \dots, P_8\) at `c` in \([0, 1]\).
        real(qp), intent(in) :: c(stages)
        real(qp) :: p(stages, 0:stages)
        integer :: k

        p(:, 0) = 1.0_qp
        p(:, 1) = 2.0_qp*c - 1.0_qp
        do k = 1, stages - 1
            p(:, k + 1) = ((2*k + 1)*(2.0_qp*c - 1.0_qp)*p(:, k) - k*p(:, k - 1))/(k + 1)
        end do
    end function shifted_legendre

    subroutine check_rounding(entry, exact)
        !! Half a unit in the last place, and what quadruple precision rounds.
        real(dp), intent(in) :: entry
        real(qp), intent(in) :: exact

        call assertLessThanOrEqual(real(abs(entry - exact), dp), 0.5_dp*spacing(entry) + 1e-30_dp)
    end subroutine check_rounding

    subroutine stages_collocate()
        !! \(\sum_j a_{ij} c_j^{k-1} = c_i^k/k\) and \(\sum_i b_i c_i^{k-1}a_{ij} = b_j(1-c_j^k)/k\)
        !! up to k = 8: with the quadrature this means order 16 (Butcher 1964).
        integer :: i, k

        do k = 1, stages
            do i = 1, stages
                call assertEqual(nodes(i)**k/k, sum(mu(i, :)*weights*nodes**(k - 1)), rounding, &
                                 "C(k)")
                call assertEqual((1.0_dp - nodes(i)**k)/k, sum(weights*nodes**(k - 1)*mu(:, i)), &
                                 rounding, "D(k)")
            end do
        end do
    end subroutine stages_collocate

    subroutine table_is_symplectic_and_symmetric()
        !! To the last bit: a rounded table that is not lets the energy drift.
        real(dp) :: turned(stages, stages)

        turned = mu(stages:1:-1, stages:1:-1)
        call assertEqual(0.0_dp, maxval(abs(mu + transpose(mu) - 1.0_dp)), 0.0_dp, "symplectic")
        call assertEqual(0.0_dp, maxval(abs(turned - transpose(mu))), 0.0_dp, "symmetric")
        call assertEqual(0.0_dp, maxval(abs(weights - weights(stages:1:-1))), 0.0_dp, "weights")
    end subroutine table_is_symplectic_and_symmetric

    subroutine legendre_polynomials_are_orthogonal()
        !! Under the quadrature, exactly, as products have degree 14 at most.
        real(dp) :: p(stages, 0:stages - 1), ones(stages)
        integer :: k, l

        call legendre(nodes, p)
        do k = 0, stages - 1
            do l = 0, stages - 1
                call assertEqual(merge(1.0_dp, 0.0_dp, k == l), &
                                 (2*k + 1)*sum(weights*p(:, k)*p(:, l)), 10.0_dp*rounding, &
                                 "P_k P_l")
            end do
        end do
        ones = 1.0_dp
        call legendre(ones, p)
        call assertEqual(0.0_dp, maxval(abs(p - 1.0_dp)), 10.0_dp*rounding, "P_k(1)")
    end subroutine legendre_polynomials_are_orthogonal
end module test_gauss_tables
