module lagrangia_summation
    !! Sums that keep what rounding drops.
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: add, add_pair

contains

    elemental subroutine add(x, low, term)
        !! Add `term` to the number `x + low`, whose low part is at most half a unit in the last
        !! place of `x`; exact but for the rounding of `low + term`.
        !!
        !! Source: Knuth, *The Art of Computer Programming*, vol. 2, 3rd ed., sec. 4.2.2, thm. B.
        real(dp), intent(inout) :: x, low  !! the number's two parts
        real(dp), intent(in) :: term       !! any size
        real(dp) :: increment, total, taken

        increment = low + term
        total = x + increment
        taken = total - x
        low = (x - (total - taken)) + (increment - taken)
        x = total
    end subroutine add

    elemental subroutine add_pair(x, low, term, rest)
        !! Add `term + rest`, the product of a number and a sum `x + low` like this one.
        real(dp), intent(inout) :: x, low   !! the number's two parts
        real(dp), intent(in) :: term, rest  !! high and low part

        low = low + rest
        call add(x, low, term)
    end subroutine add_pair
end module lagrangia_summation
