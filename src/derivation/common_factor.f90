module lagrangia_common_factor
    !! An equation without what all its terms share.
    use lagrangia_derivation, only: derivation_t
    use lagrangia_exact_number, only: number_t, operator(-), operator(/), ratio
    use lagrangia_kinds, only: dp, i8
    use lagrangia_page_layout, only: role_parameter
    use lagrangia_polynomial, only: most_atoms, polynomial_t
    implicit none (type, external)
    private
    public :: divide_by_common, divide_by_parameters

contains

    pure subroutine divide_by_common(equation, stays, divided, factor)
        !! Over the product of powers, and the positive number, that all terms share.
        type(polynomial_t), intent(in) :: equation      !! not zero
        logical, intent(in) :: stays(:)                 !! the atoms that are not divided by
        type(polynomial_t), intent(out) :: divided      !! `equation` over `factor`
        type(polynomial_t), intent(out) :: factor       !! one term
        type(number_t) :: coefficient
        integer :: powers(most_atoms)

        call equation%common(coefficient, powers)
        if (coefficient%value < 0.0_dp) coefficient = -coefficient
        where (stays) powers = 0
        call factor%add_term(coefficient, powers)
        divided = equation%shifted(ratio(1_i8, 1_i8)/coefficient, -powers)
    end subroutine divide_by_common

    pure subroutine divide_by_parameters(self, equation, divided, factor)
        !! Only where all terms share a parameter, with the number beside it.
        type(derivation_t), intent(in) :: self          !! knows the names
        type(polynomial_t), intent(in) :: equation      !! not zero
        type(polynomial_t), intent(out) :: divided      !! `equation` over `factor`
        type(polynomial_t), intent(out) :: factor       !! without terms where there is none
        logical :: stays(most_atoms)

        stays = .true.
        stays(:size(self%roles)) = self%roles > role_parameter
        call divide_by_common(equation, stays, divided, factor)
        if (any(factor%power(:, 1) /= 0)) return
        divided = equation
        factor = polynomial_t()
    end subroutine divide_by_parameters
end module lagrangia_common_factor
