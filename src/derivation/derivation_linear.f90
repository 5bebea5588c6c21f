module lagrangia_derivation_linear
    !! The linearised equations of motion, written out: as they stand on the blackboard before
    !! omega^2.
    use lagrangia_common_factor, only: divide_by_parameters
    use lagrangia_derivation, only: derivation_t, line_linear
    use lagrangia_formula_latex, only: latex_name
    use lagrangia_names, only: name_length
    use lagrangia_page_layout, only: lay_out
    use lagrangia_polynomial, only: atom_power, operator(+), operator(-), operator(*), &
                                    polynomial_t, whole_polynomial
    use lagrangia_trigonometry, only: shorten
    implicit none (type, external)
    private
    public :: add_linear

    integer, parameter :: most_written = 6  !! coordinates; with more M and K say it shorter

contains

    subroutine add_linear(self, mass, turning, stiffness)
        !! \(\sum_k M_{ik}\ddot q_k + B_{ik}\dot q_k + K_{ik}q_k = 0\), each without common factor;
        !! of two coordinates, one of which nothing holds, the equation of the other alone.
        type(derivation_t), intent(inout) :: self      !! gets the lines
        type(polynomial_t), intent(in) :: mass(:, :), turning(:, :), stiffness(:, :)  !! (n, n)
        type(polynomial_t) :: rows(self%n), one
        character(name_length) :: name
        integer :: free, i, k

        if (self%n > most_written) return
        do i = 1, self%n
            do k = 1, self%n
                if (names_place(mass(i, k)) .or. names_place(turning(i, k)) .or. &
                    names_place(stiffness(i, k))) return
            end do
        end do
        call self%add_words("written out:")
        do i = 1, self%n
            do k = 1, self%n
                rows(i) = rows(i) + mass(i, k)*atom_power(self%acceleration(k), 1) &
                          + turning(i, k)*atom_power(self%velocity(k), 1) &
                          + stiffness(i, k)*atom_power(self%coordinate(k), 1)
            end do
            call add_row(rows(i), i, 0)
        end do
        if (self%n /= 2) return
        do free = 1, 2
            i = 3 - free
            if (any(stiffness(free, :)%terms > 0) .or. any(turning(free, :)%terms > 0) .or. &
                any(turning(:, free)%terms > 0) .or. stiffness(i, free)%terms > 0 .or. &
                stiffness(i, i)%terms == 0 .or. mass(i, free)%terms == 0) cycle
            one = mass(free, free)*rows(i) - mass(i, free)*rows(free)
            call shorten(self%algebra, one)
            name = self%d%coordinates(free)%name
            call self%add_words("without "//trim(name)//"_ddot:", &
                                "without $\ddot{"//latex_name(trim(name))//"}$:")
            call add_row(one, i, free)
        end do
    contains
        logical function names_place(p)
            !! `cos(x)` of the place stands in it: beside displacements that would be another x.
            type(polynomial_t), intent(in) :: p
            integer :: j, m

            names_place = .false.
            do m = 1, self%algebra%count
                if (p%has(m)) names_place = names_place .or. &
                    self%algebra%uses(m, [(self%coordinate(j), j=1, self%n)])
            end do
        end function names_place

        subroutine add_row(row, i, k)
            type(polynomial_t), intent(in) :: row
            integer, intent(in) :: i, k
            type(polynomial_t) :: divided, factor

            if (row%terms == 0) then
                divided = row
            else
                call divide_by_parameters(self, row, divided, factor)
            end if
            call self%add(line_linear, "", "", divided, i, k)
            if (factor%terms == 0) factor = whole_polynomial(1)
            call lay_out(self%algebra, self%roles, factor, self%lines(self%count)%factor)
        end subroutine add_row
    end subroutine add_linear
end module lagrangia_derivation_linear
