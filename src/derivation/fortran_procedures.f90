module lagrangia_fortran_procedures
    !! How a procedure of a written module begins.
    use lagrangia_description, only: description_t
    use lagrangia_fortran_statements, only: fortran_lines_t
    use lagrangia_text, only: to_text, word_t
    implicit none (type, external)
    private
    public :: element, open_names, open_procedure

contains

    subroutine open_procedure(d, heading, purpose, arguments, lines)
        !! To the declarations of the arguments.
        type(description_t), intent(in) :: d          !! whose name the module has
        character(*), intent(in) :: heading, purpose  !! its first line; a docstring
        character(*), intent(in) :: arguments(:)  !! declarations
        type(fortran_lines_t), intent(inout) :: lines !! of the module
        integer :: i

        call lines%add(0, "")
        call lines%add(4, heading)
        call lines%add(8, "!! "//purpose)
        call lines%add(8, "class("//trim(d%name)//"_t), intent(in) :: self")
        do i = 1, size(arguments)
            call lines%add(8, trim(arguments(i)))
        end do
    end subroutine open_procedure

    subroutine open_names(d, names, velocities, lanes, lines)
        !! The coordinates, velocities and parameters by their names.
        type(description_t), intent(in) :: d          !! with n coordinates
        type(word_t), intent(in) :: names(:)          !! of t, q, q_dot, parameters in Fortran
        logical, intent(in) :: velocities, lanes      !! are there any; of eight states
        type(fortran_lines_t), intent(inout) :: lines !! of the module
        character(:), allocatable :: text
        integer :: i, n

        n = size(d%coordinates)
        text = ""
        do i = 1, n
            text = text//", "//names(1 + i)%text//" => "//element("q", i, lanes)
        end do
        do i = 1, merge(n, 0, velocities)
            text = text//", "//names(1 + n + i)%text//" => "//element("v", i, lanes)
        end do
        do i = 1, size(names) - 1 - 2*n
            text = text//", "//names(1 + 2*n + i)%text//" => self%p("//to_text(i)//")"
        end do
        call lines%add(0, "")
        call lines%add(8, "associate ("//text(3:)//")")
    end subroutine open_names

    pure function element(array, i, lanes) result(text)
        !! `q(1)`, or `q(:, 1)` of all lanes.
        character(*), intent(in) :: array  !! its name
        integer, intent(in) :: i           !! from 1
        logical, intent(in) :: lanes       !! of eight states
        character(:), allocatable :: text

        text = array//"("//to_text(i)//")"
        if (lanes) text = array//"(:, "//to_text(i)//")"
    end function element
end module lagrangia_fortran_procedures
