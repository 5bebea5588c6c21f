module lagrangia_number_class
    !! Of what class numbers are: zero, finite.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: all_finite, is_nonzero, is_zero

    interface all_finite
        !! Is every number of an array neither infinite nor NaN? Of none this is true.
        module procedure finite_list, finite_matrix, finite_matrices
    end interface all_finite

contains

    elemental function is_zero(x) result(yes)
        !! \(x=0\), of either sign; false of NaN.
        real(dp), intent(in) :: x  !! of any unit
        logical :: yes

        yes = abs(x) <= 0.0_dp
    end function is_zero

    elemental function is_nonzero(x) result(yes)
        !! \(x<0\) or \(x>0\); false of NaN.
        real(dp), intent(in) :: x  !! of any unit
        logical :: yes

        yes = abs(x) > 0.0_dp
    end function is_nonzero

    pure function finite_list(x) result(yes)
        real(dp), intent(in) :: x(:)  !! of any unit
        logical :: yes

        yes = all(ieee_is_finite(x))
    end function finite_list

    pure function finite_matrix(x) result(yes)
        real(dp), intent(in) :: x(:, :)  !! of any unit
        logical :: yes

        yes = all(ieee_is_finite(x))
    end function finite_matrix

    pure function finite_matrices(x) result(yes)
        real(dp), intent(in) :: x(:, :, :)  !! of any unit
        logical :: yes

        yes = all(ieee_is_finite(x))
    end function finite_matrices
end module lagrangia_number_class
