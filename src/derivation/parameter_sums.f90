module lagrangia_parameter_sums
    !! Sums of parameters in a bracket: what stands first, and whether they are a product.
    use lagrangia_exact_number, only: number_t, operator(-), operator(/), ratio
    use lagrangia_kinds, only: dp, i8
    use lagrangia_polynomial, only: most_atoms, operator(*), operator(==), polynomial_t
    implicit none (type, external)
    private
    public :: leading, one_polynomial, split, turn_leading
    public :: role_gravity, role_mass, role_parameter

    integer, parameter :: role_mass = 1, role_gravity = 2, role_parameter = 3

contains

    pure subroutine split(roles, p, factors, product)
        !! Is it a product of a sum without masses and a sum of masses?
        integer, intent(in) :: roles(:)  !! of each name
        type(polynomial_t), intent(in) :: p  !! of parameters
        type(polynomial_t), intent(out) :: factors(2)  !! without masses, of masses
        logical, intent(out) :: product                !! if not, they are no factors
        logical :: heavy(most_atoms)
        integer :: i

        heavy = .false.
        heavy(:size(roles)) = roles == role_mass
        do i = 1, p%terms
            if (all(merge(p%power(:, i), 0, heavy) == merge(p%power(:, 1), 0, heavy))) then
                call factors(1)%add_term(p%coefficient(i), merge(0, p%power(:, i), heavy))
            end if
            if (all(merge(0, p%power(:, i), heavy) == merge(0, p%power(:, 1), heavy))) then
                call factors(2)%add_term(p%coefficient(i)/p%coefficient(1), &
                                         merge(p%power(:, i), 0, heavy))
            end if
        end do
        product = min(factors(1)%terms, factors(2)%terms) > 1
        if (product) product = factors(1)*factors(2) == p
    end subroutine split

    pure function one_polynomial() result(p)
        !! The number 1.
        type(polynomial_t) :: p
        integer :: i

        call p%add_term(ratio(1_i8, 1_i8), [(0, i=1, most_atoms)])
    end function one_polynomial

    pure function leading(roles, p) result(first)
        !! The term that stands first in a bracket of parameters: with a mass, else with gravity.
        integer, intent(in) :: roles(:)  !! of each name
        type(polynomial_t), intent(in) :: p  !! of parameters
        integer :: first
        integer :: i, least, role

        first = 1
        least = huge(least)
        do i = 1, p%terms
            role = minval(roles, p%power(:size(roles), i) > 0)
            if (role >= least) cycle
            least = role
            first = i
        end do
    end function leading

    pure subroutine turn_leading(roles, coefficient, p)
        !! The sign of both, so that a bracket does not begin with a minus.
        integer, intent(in) :: roles(:)  !! of each name
        type(number_t), intent(inout) :: coefficient  !! in front of the bracket
        type(polynomial_t), intent(inout) :: p        !! in the bracket
        integer :: i

        i = leading(roles, p)
        if (p%coefficient(i)%value > 0.0_dp) return
        coefficient = -coefficient
        do i = 1, p%terms
            p%coefficient(i) = -p%coefficient(i)
        end do
    end subroutine turn_leading
end module lagrangia_parameter_sums
