module lagrangia_gauss_control
    !! How large the error of a step of Gauss-Legendre collocation is, and how long the next one
    !! may be.
    !!
    !! The defect of a step with eight stages is orthogonal to polynomials up to degree 7, so its
    !! error is the product of two Legendre coefficients of degree 8: that of the defect, and that
    !! of what a push at one time does at the end of the step (for a harmonic motion both are
    !! spherical Bessel functions \(j_8(\omega h/2)\), and this is the exact error). Neither is
    !! known, but both fall as the last known coefficients of the accelerations do: with \(z\) the
    !! norm of degrees 6 and 7 (and 3 % of 4 and 5, so that none vanishes by chance) and \(a\)
    !! that of degrees 0 to 3, the error is about \(z^{5/2}/a^{3/2}/2\), which goes with the
    !! 16th power of the step. On single and double pendulums and the cart-pendulum this has
    !! a standard deviation of a factor 4, which is 9 % of the step.
    !!
    !! No node is in the first and the last 2 % of a step, where it may run into a wall unseen: at
    !! the ends the accelerations must be those of the polynomial, to 30 \(z\) or to what changes
    !! the end by 100 tolerances if it acts all along the step.
    use lagrangia_gauss_tables, only: stages
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: longer, seen_whole, weigh

    real(dp), parameter :: constant = 0.5_dp
    real(dp), parameter :: little = 100.0_dp**2   !! squared: in 1 % of the step it is within 1
    real(dp), parameter :: farthest = 30.0_dp**2  !! squared, in units of \(z\)

contains

    pure subroutine weigh(n, h, tolerance, q, v, weight)
        !! What an acceleration changes at the end of the step, in units of the tolerance:
        !! \(h/\mathrm{tol}\cdot\max(1/\max(1, |v|),\ h/\max(1, |q|))\), squared.
        integer, intent(in) :: n             !! degrees of freedom
        real(dp), intent(in) :: h            !! step, s
        real(dp), intent(in) :: tolerance    !! absolute below 1, relative above
        real(dp), intent(in) :: q(n), v(n)   !! coordinates, velocities
        real(dp), intent(out) :: weight(n)   !! of an acceleration, squared
        integer :: d

        do d = 1, n
            weight(d) = (h/tolerance*max(1.0_dp/max(1.0_dp, abs(v(d))), &
                                         h/max(1.0_dp, abs(q(d)))))**2
        end do
    end subroutine weigh

    pure function longer(n, modes, weight) result(ratio)
        !! By how much the step may be longer, or must be shorter, to have the wanted error: one
        !! over the 16th root of the error in units of the tolerance.
        integer, intent(in) :: n                  !! degrees of freedom
        real(dp), intent(in) :: modes(stages, n)  !! Legendre coefficients of the accelerations
        real(dp), intent(in) :: weight(n)         !! of `weigh`
        real(dp) :: ratio, all, mid
        integer :: d

        all = tiny(1.0_dp)
        mid = tiny(1.0_dp)
        do d = 1, n
            all = all + weight(d)*(modes(1, d)**2 + modes(2, d)**2/3.0_dp &
                                   + modes(3, d)**2/5.0_dp + modes(4, d)**2/7.0_dp)
            mid = mid + weight(d)*(modes(5, d)**2/9.0_dp + modes(6, d)**2/11.0_dp)
        end do
        ratio = exp((0.75_dp*log(all) - 1.25_dp*log(highest(n, modes, weight) + 1e-3_dp*mid) &
                     - log(constant))/16.0_dp)
    end function longer

    pure function seen_whole(n, modes, weight, first, last) result(yes)
        !! The nodes have seen what is between the outer ones and the ends of the step: there the
        !! accelerations are as the polynomial has them.
        integer, intent(in) :: n                   !! degrees of freedom
        real(dp), intent(in) :: modes(stages, n)   !! Legendre coefficients of the accelerations
        real(dp), intent(in) :: weight(n)          !! of `weigh`
        real(dp), intent(in) :: first(n), last(n)  !! accelerations at the ends
        logical :: yes
        real(dp) :: off
        integer :: d

        off = 0.0_dp
        do d = 1, n
            off = off + weight(d)*((last(d) - sum(modes(:, d)))**2 &
                                   + (first(d) - sum(modes(1::2, d)) + sum(modes(2::2, d)))**2)
        end do
        yes = off <= little .or. off <= farthest*highest(n, modes, weight)
    end function seen_whole

    pure function highest(n, modes, weight) result(norm)
        !! The norm of degrees 6 and 7, squared.
        integer, intent(in) :: n
        real(dp), intent(in) :: modes(stages, n), weight(n)
        real(dp) :: norm
        integer :: d

        norm = tiny(1.0_dp)
        do d = 1, n
            norm = norm + weight(d)*(modes(7, d)**2/13.0_dp + modes(8, d)**2/15.0_dp)
        end do
    end function highest
end module lagrangia_gauss_control
