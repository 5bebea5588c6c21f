module lagrangia_common_factor
    !! An equation without what all its terms share.
    use lagrangia_derivation, only: derivation_t
    use lagrangia_exact_number, only: number_t, operator(-), operator(/), ratio
    use lagrangia_kinds, only: dp, i8
    use lagrangia_page_layout, only: role_parameter
    use lagrangia_polynomial, only: most_atoms, polynomial_t
    implicit none (type, external)
    private
    public :: divide_by_common

contains

    pure subroutine divide_by_common(self, equation, divided, factor)
        !! The first term's number of `divided` is positive if `equation` has a factor beside it.
        type(derivation_t), intent(in) :: self          !! knows the names
        type(polynomial_t), intent(in) :: equation      !! not zero
        type(polynomial_t), intent(out) :: divided      !! `equation` over `factor`
        type(polynomial_t), intent(out) :: factor
        !! of parameters and numbers; without terms where they share no parameter
        type(number_t) :: coefficient
        integer :: k, powers(most_atoms)

        divided = equation
        call equation%common(coefficient, powers)
        if (coefficient%value < 0.0_dp) coefficient = -coefficient
        do k = 1, self%algebra%count
            if (k > size(self%roles)) then
                powers(k) = 0
            else if (self%roles(k) > role_parameter) then
                powers(k) = 0
            end if
        end do
        if (all(powers == 0)) return
        call factor%add_term(coefficient, powers)
        divided = equation%shifted(ratio(1_i8, 1_i8)/coefficient, -powers)
    end subroutine divide_by_common
end module lagrangia_common_factor
