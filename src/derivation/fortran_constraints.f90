module lagrangia_fortran_constraints
    !! The constraints of a system in formulas as procedures in Fortran, from which the library
    !! keeps them.
    use lagrangia_description, only: description_t, name_length
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_fortran, only: fortran_text
    use lagrangia_fortran_names, only: find_names
    use lagrangia_fortran_procedures, only: open_names, open_procedure
    use lagrangia_fortran_statements, only: fortran_lines_t
    use lagrangia_text, only: to_text, word_t
    use lagrangia_written_constraints, only: constraint_drift, constraint_row
    use lagrangia_written_system, only: written_system_t
    implicit none (type, external)
    private
    public :: add_constraints

contains

    subroutine add_constraints(system, d, lines)
        !! How many there are, \(A\) and \(b\), and what the holonomic ones give.
        class(written_system_t), intent(in) :: system  !! with constraints
        type(description_t), intent(in) :: d           !! complete
        type(fortran_lines_t), intent(inout) :: lines  !! gets the procedures
        type(word_t), allocatable :: names(:)
        type(expression_t) :: formula
        character(:), allocatable :: text
        integer :: i, k

        text = ""
        do k = 1, system%constraints
            text = text//", "//trim(merge(".true. ", ".false.", system%holonomic(k)))
        end do
        call lines%add(0, "")
        call lines%add(4, "pure subroutine prepare(self)")
        call lines%add(8, "!! What binds the coordinates beside L.")
        call lines%add(8, "class("//trim(d%name)//"_t), intent(inout) :: self")
        call lines%add(0, "")
        call lines%add(8, "self%constraints = "//to_text(system%constraints))
        call lines%add(8, "self%is_projected = .true.")
        call lines%add(8, "self%holonomic = ["//text(3:)//"]")
        call lines%add(4, "end subroutine prepare")
        associate (e => system%expressions, n => system%ndof)
            call find_names(e%symbols%names, [character(name_length) :: d%name, "drift", "rows"], &
                            names)
            call open_procedure(d, "pure subroutine constraint_rows(self, t, q, rows, drift)", &
                                "A and b of the constraints A q_dot + b = 0.", [character(70) :: &
                                 "type(hyperdual_t), intent(in) :: t, q(self%ndof)", &
                                 "type(hyperdual_t), intent(out) :: rows(:, :), drift(:)"], lines)
            call open_names(d, names, .false., .false., lines)
            do k = 1, system%constraints
                do i = 1, n
                    formula = constraint_row(e%constraints(k), i, n, e%symbols)
                    call fortran_text(formula, names, text)
                    call lines%assign(12, "rows("//to_text(k)//", "//to_text(i)//")", text)
                end do
                formula = constraint_drift(e%constraints(k), n, e%symbols)
                call fortran_text(formula, names, text)
                call lines%assign(12, "drift("//to_text(k)//")", text)
            end do
            call lines%add(8, "end associate")
            call lines%add(4, "end subroutine constraint_rows")
            if (.not. any(system%holonomic)) return
            call find_names(e%symbols%names, [character(name_length) :: d%name, "values"], names)
            call open_procedure(d, "pure subroutine constraint_values(self, t, q, values)", &
                                "Zero where the coordinates keep the constraints.", &
                                [character(70) :: "real(dp), intent(in) :: t, q(self%ndof)", &
                                 "real(dp), intent(out) :: values(:)"], lines)
            call open_names(d, names, .false., .false., lines)
            do k = 1, system%constraints
                text = "0.0_dp"
                if (system%holonomic(k)) call fortran_text(e%constraints(k), names, text)
                call lines%assign(12, "values("//to_text(k)//")", text)
            end do
            call lines%add(8, "end associate")
            call lines%add(4, "end subroutine constraint_values")
        end associate
    end subroutine add_constraints
end module lagrangia_fortran_constraints
