module lagrangia_term_fit
    !! Which known term explains an unknown difference.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_lapack, only: least_squares
    implicit none (type, external)
    private
    public :: best_term, all_terms

contains

    pure subroutine best_term(difference, terms, which, factor, misfit)
        !! The one term whose multiple is nearest to the difference.
        real(dp), intent(in) :: difference(:)  !! (samples)
        real(dp), intent(in) :: terms(:, :)    !! (samples, terms)
        integer, intent(out) :: which          !! 0 if all terms vanish
        real(dp), intent(out) :: factor        !! difference = factor*term
        real(dp), intent(out) :: misfit        !! what is left of the difference, 0 to 1
        real(dp) :: share, rest, size_of_all
        integer :: k

        which = 0
        factor = 0.0_dp
        misfit = 1.0_dp
        size_of_all = norm2(difference)
        do k = 1, size(terms, 2)
            if (.not. (norm2(terms(:, k)) > 0.0_dp .and. size_of_all > 0.0_dp)) cycle
            share = dot_product(difference, terms(:, k))/dot_product(terms(:, k), terms(:, k))
            rest = norm2(difference - share*terms(:, k))/size_of_all
            ! equal but for rounding: the one that was named first
            if (which > 0 .and. .not. rest < 0.5_dp*misfit - 1e-13_dp) cycle
            which = k
            factor = share
            misfit = rest
        end do
    end subroutine best_term

    pure subroutine all_terms(difference, terms, factors, misfit, error)
        !! The difference as a sum of multiples of all terms, by least squares; each term scaled
        !! to its largest sample, so that factors of small ones mean something.
        real(dp), intent(in) :: difference(:), terms(:, :)  !! (samples); (samples, terms)
        real(dp), intent(out) :: factors(:)               !! (terms)
        real(dp), intent(out) :: misfit                   !! what is left, 0 to 1
        type(error_t), allocatable, intent(out) :: error  !! the terms depend on each other
        real(dp) :: scaled(size(terms, 1), size(terms, 2)), largest(size(terms, 2))
        integer :: k

        largest = maxval(abs(terms), 1)
        do k = 1, size(terms, 2)
            scaled(:, k) = terms(:, k)/largest(k)
        end do
        misfit = 1.0_dp
        call least_squares(scaled, difference, factors, error)
        if (allocated(error)) return
        misfit = norm2(difference - matmul(scaled, factors))/(norm2(difference) + tiny(misfit))
        factors = factors/largest
    end subroutine all_terms
end module lagrangia_term_fit
