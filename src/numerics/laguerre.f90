module lagrangia_laguerre
    !! Zeros of Laguerre's polynomials: the frequencies of a chain that hangs.
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_zero
    implicit none (type, external)
    private
    public :: laguerre_zeros

contains

    pure function laguerre_zeros(n) result(x)
        !! The zeros of \(L_n\), ascending, each to a few ulp.
        !!
        !! They are the eigenvalues of \(J = BB^\top\), \(B\) with \(\sqrt1\dots\sqrt n\) on the
        !! diagonal and below it. The pivots of \(J - x\), computed without forming \(J\), count
        !! the zeros below \(x\), and the last one is \(nL_n/L_{n-1}\), which gives Newton's step.
        !!
        !! Source: Golub & Welsch, Math. Comp. 23 (1969) 221; Parlett & Dhillon, Linear Algebra
        !! Appl. 309 (2000) 121, `dstqds`; DLMF 18.9.23 for the derivative.
        integer, intent(in) :: n  !! degree, from 1
        real(dp) :: x(n), low, high, middle, last
        logical :: alone  !! no other zero from `low` to `high`
        integer :: k, step, below

        low = 0.0_dp
        do k = 1, n
            high = 4.0_dp*n
            alone = k == n
            middle = 0.5_dp*(low + high)
            do step = 1, 200
                call pivots(n, middle, below, last)
                if (below < k) then
                    low = middle
                else
                    high = middle
                    alone = below == k
                end if
                ! L/L' = x d/(n (d - n)) with d the last pivot
                if (alone) then
                    x(k) = middle*(1.0_dp - last/(n*(last - n)))
                    if (x(k) > low .and. x(k) < high) then
                        if (abs(x(k) - middle) <= 2.0_dp*epsilon(low)*middle) exit
                        middle = x(k)
                        cycle
                    end if
                end if
                x(k) = middle
                middle = 0.5_dp*(low + high)
                if (high - low <= 2.0_dp*epsilon(low)*high) exit
            end do
            low = x(k)
        end do
    end function laguerre_zeros

    pure subroutine pivots(n, x, below, last)
        !! Of \(J - x\): how many are negative, and the last one.
        integer, intent(in) :: n
        real(dp), intent(in) :: x
        integer, intent(out) :: below
        real(dp), intent(out) :: last
        real(dp) :: s
        integer :: i

        below = 0
        s = -x
        do i = 1, n
            last = i + s
            if (is_zero(last)) last = -tiny(last)
            if (last < 0.0_dp) below = below + 1
            s = s*i/last - x
        end do
    end subroutine pivots
end module lagrangia_laguerre
