submodule (lagrangia_sample_names) lagrangia_named_derivatives
    !! Derivatives that have names of their own.
    use lagrangia_derivative, only: derivative
    use lagrangia_expression, only: symbol
    use lagrangia_substitution, only: substituted
    implicit none (type, external)

contains

    module subroutine define_derivatives(d, samples)
        !! `p_x_dot`, and `dV_dx`, `dT_dx_dot` where no rate of a letter hides a velocity.
        type(description_t), intent(in) :: d
        type(samples_t), intent(inout) :: samples
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, size(d%coordinates)
            associate (name => d%coordinates(i)%name)
                call samples%symbols%define("p_"//trim(name)//"_dot", symbol( &
                    samples%symbols%find("d_dt_dL_d"//trim(name)//"_dot")), error)
            end associate
        end do
        if (allocated(d%generalised_forces)) then
            do i = 1, size(d%generalised_forces)
                associate (text => d%generalised_forces(i))
                    call define_force(text(:index(text, "=") - 1), text(index(text, "=") + 1:))
                end associate
            end do
        end if
        if (allocated(d%kinetic_energy)) call define_of("T", d%kinetic_energy)
        if (allocated(d%potential_energy)) call define_of("V", d%potential_energy)
    contains
        subroutine define_force(name, formula)
            character(*), intent(in) :: name, formula
            type(expression_t) :: force

            call parse_formula(trim(formula), samples%symbols, force, error)
            if (.not. allocated(error)) call samples%symbols%define(trim(name), force, error)
        end subroutine define_force

        subroutine define_of(energy, formula)
            character(*), intent(in) :: energy, formula
            type(expression_t) :: expression, letter(1)
            integer :: j, k

            call parse_formula(formula, samples%symbols, expression, error)
            if (allocated(error)) return
            if (allocated(d%letters)) then
                do j = size(d%letters), 1, -1
                    k = samples%symbols%find(trim(d%letters(j)%name))
                    if (.not. expression%depends_on(k)) cycle
                    call parse_formula(trim(d%letters(j)%formula), samples%symbols, letter(1), &
                                       error)
                    if (allocated(error)) return
                    expression = substituted(expression, [k], letter)
                end do
            end if
            do k = 1, size(samples%role)
                if (samples%role(k) == role_parameter .and. samples%rate(k) > 0 .and. &
                    expression%depends_on(k)) return
            end do
            do k = 2, 1 + 2*samples%ndof
                call samples%symbols%define("d"//energy//"_d"//trim(samples%symbols%names(k)), &
                                            derivative(expression, k), error)
            end do
        end subroutine define_of
    end subroutine define_derivatives
end submodule lagrangia_named_derivatives
