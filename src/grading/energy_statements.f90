module lagrangia_energy_statements
    !! What a sheet has said of E with constants of integration: `E = k (A^2 + B^2)/2` does not say
    !! what A is, and yet a line `E = k (A^2 - B^2)/2` behind it is another energy.
    use lagrangia_constant_values, only: draw_constants
    use lagrangia_derivative, only: derivative
    use lagrangia_expression, only: expression_t, operator(-), operator(/), symbol
    use lagrangia_sample_names, only: energy_statement_t, samples_t
    use lagrangia_small_energies, only: is_constant_of_each_draw
    use lagrangia_substitution, only: substituted
    implicit none (type, external)
    private
    public :: contradicted_line, keep_energy

contains

    subroutine keep_energy(residual, names, samples)
        !! A statement that is right, if it is one of E; `judge` says on which line it stands.
        type(expression_t), intent(in) :: residual   !! left less right side
        character(*), intent(in) :: names(:)         !! constants, symbols behind the samples'
        type(samples_t), intent(inout) :: samples    !! remember it
        type(energy_statement_t), allocatable :: longer(:)
        type(expression_t) :: energy
        integer :: i, n

        energy = solved(residual, samples)
        if (energy%count == 0) return
        n = size(samples%energies)
        allocate (longer(n + 1))
        do i = 1, n
            longer(i) = samples%energies(i)
        end do
        longer(n + 1)%energy = energy
        longer(n + 1)%names = names
        call move_alloc(longer, samples%energies)
    end subroutine keep_energy

    function contradicted_line(residual, names, samples) result(line)
        !! The first one whose E, of no fewer constants, differs by more than a constant of the
        !! system; 0: none.
        type(expression_t), intent(in) :: residual   !! left less right side
        character(*), intent(in) :: names(:)         !! constants, symbols behind the samples'
        type(samples_t), intent(in) :: samples       !! know the statements
        integer :: line
        type(expression_t) :: energy, difference, places(size(names))
        type(samples_t) :: there
        integer :: i, j, n

        line = 0
        if (size(samples%energies) == 0) return
        energy = solved(residual, samples)
        if (energy%count == 0) return
        n = size(samples%role)
        do i = 1, size(samples%energies)
            associate (before => samples%energies(i))
                if (.not. all([(any(before%names == names(j)), j=1, size(names))])) cycle
                do j = 1, size(names)
                    places(j) = symbol(n + findloc(before%names, names(j), 1))
                end do
                difference = before%energy - substituted(energy, [(n + j, j=1, size(names))], &
                                                         places)
                there = samples
                call draw_constants(samples, size(before%names), there%values)
                if (is_constant_of_each_draw(difference, there)) cycle
                line = before%line
                return
            end associate
        end do
    end function contradicted_line

    function solved(residual, samples) result(energy)
        !! \(f\) of \(E=f\), or its negative where the residual is linear in E; else empty.
        type(expression_t), intent(in) :: residual
        type(samples_t), intent(in) :: samples
        type(expression_t) :: energy
        type(expression_t) :: slope
        integer :: place

        place = samples%symbols%find("E")
        if (.not. residual%depends_on(place)) return
        slope = derivative(residual, place)
        if (slope%depends_on(place)) return
        energy = symbol(place) - residual/slope
    end function solved
end module lagrangia_energy_statements
