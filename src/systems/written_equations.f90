module lagrangia_written_equations
    !! The equations of motion and the energy of a Lagrangian as texts, as one writes them on paper.
    use lagrangia_canonical_form, only: simplified
    use lagrangia_description, only: description_t, formula_length
    use lagrangia_expression, only: expression_t, operator(*), operator(+), operator(-), symbol
    use lagrangia_formula_text, only: formula_text
    use lagrangia_symbols, only: symbols_t
    use lagrangia_written_motion, only: written_motion_t
    implicit none (type, external)
    private
    public :: write_equations

contains

    subroutine write_equations(motion, forces, symbols, d)
        !! \(M\ddot q - (\ldots) = Q\) for each coordinate, simplified; none at all where one is
        !! longer than a description can hold.
        type(written_motion_t), intent(in) :: motion  !! derived from L
        type(expression_t), intent(in) :: forces(:)   !! Q of each coordinate, (n)
        type(symbols_t), intent(in) :: symbols        !! t, q, q_dot, parameters
        type(description_t), intent(inout) :: d       !! has the coordinates; gets the texts
        type(symbols_t) :: names
        type(expression_t) :: left
        character(:), allocatable :: text
        integer :: first, i, j, n

        n = size(forces)
        names = symbols
        first = size(symbols%names)
        do i = 1, n
            call names%add(trim(d%coordinates(i)%name)//"_ddot")
        end do
        d%energy = formula_text(simplified(motion%energy, names), names)
        allocate (d%equations(n))
        text = ""
        do i = 1, n
            left = forces(i) - motion%right(i)
            do j = 1, n
                left = left + motion%mass(i, j)*symbol(first + j)
            end do
            text = formula_text(simplified(left, names), names)//" = "// &
                   formula_text(simplified(forces(i), names), names)
            if (len(text) > formula_length) then
                deallocate (d%equations)
                return
            end if
            d%equations(i) = text
        end do
    end subroutine write_equations
end module lagrangia_written_equations
