module lagrangia_written_equilibrium
    !! The key `equilibrium` of a scene's group `&lagrangian`: for each coordinate a formula of the
    !! parameters, or an equation that gives it, `cos(theta) = g/(w^2 r)`.
    use lagrangia_errors, only: error_t, fail
    use lagrangia_expression, only: expression_t, f_cos
    use lagrangia_formula_parser, only: parse_equation, parse_formula
    use lagrangia_formula_text, only: formula_text
    use lagrangia_solved_place, only: solve_place
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: quoted, to_text
    use lagrangia_written_formulas, only: longest_formula
    implicit none (type, external)
    private
    public :: equilibrium_text, read_equilibrium

contains

    subroutine read_equilibrium(texts, n, symbols, places, functions, values, error)
        !! One text for each coordinate, or none at all.
        character(longest_formula), intent(in) :: texts(:)         !! as typed
        integer, intent(in) :: n                                   !! coordinates
        type(symbols_t), intent(in) :: symbols                     !! t, q, q_dot, parameters
        type(expression_t), allocatable, intent(out) :: places(:)  !! of each coordinate
        integer, allocatable, intent(out) :: functions(:)          !! 0, `f_cos` or `f_sin` of it
        type(expression_t), allocatable, intent(out) :: values(:)  !! of that function
        type(error_t), allocatable, intent(out) :: error
        !! blames `equilibrium` and the element
        integer :: i

        allocate (places(size(texts)), values(size(texts)))
        allocate (functions(size(texts)), source=0)
        if (all(size(texts) /= [0, n])) then
            call fail(error, "an equilibrium has one formula for each coordinate: "// &
                      to_text(n)//", not "//to_text(size(texts)), key="equilibrium")
            return
        end if
        do i = 1, size(texts)
            call read_one(trim(texts(i)), i, n, symbols, places(i), functions(i), values(i), error)
            if (.not. allocated(error)) cycle
            error%key = "equilibrium"
            error%element = i
            return
        end do
    end subroutine read_equilibrium

    subroutine read_one(text, i, n, symbols, place, function, value, error)
        !! Of coordinate `i`.
        character(*), intent(in) :: text
        integer, intent(in) :: i, n
        type(symbols_t), intent(in) :: symbols
        type(expression_t), intent(out) :: place, value
        integer, intent(out) :: function
        type(error_t), allocatable, intent(out) :: error
        character(:), allocatable :: name
        type(expression_t) :: left
        integer :: k, which

        name = trim(symbols%names(1 + i))
        function = 0
        if (index(text, "=") > 0) then
            call parse_equation(text, symbols, left, value, error)
            if (allocated(error)) return
            call solve_place(left, value, which, function, place)
            if (which /= 1 + i) then
                call fail(error, "this is the place of "//name//": write a formula of "// &
                          "parameters, or "//quoted(name//" = ...")//", "// &
                          quoted("cos("//name//") = ...")//" or "// &
                          quoted("sin("//name//") = ..."))
                return
            end if
        else
            call parse_formula(text, symbols, value, error)
            if (allocated(error)) return
            place = value
        end if
        do k = 1, 1 + 2*n
            if (.not. value%depends_on(k)) cycle
            call fail(error, "an equilibrium depends on "//trim(symbols%names(k))//", which is "// &
                      "not allowed: parameters and numbers only")
            return
        end do
    end subroutine read_one

    function equilibrium_text(i, function, value, symbols) result(text)
        !! `l0 + m g/k`, or `cos(theta) = g/(w^2 r)`.
        integer, intent(in) :: i                      !! which coordinate
        integer, intent(in) :: function               !! 0, `f_cos` or `f_sin`
        type(expression_t), intent(in) :: value       !! of the parameters
        type(symbols_t), intent(in) :: symbols        !! their names
        character(:), allocatable :: text

        text = formula_text(value, symbols)
        if (function == 0) return
        text = trim(merge("cos", "sin", function == f_cos))//"("//trim(symbols%names(1 + i))// &
               ") = "//text
    end function equilibrium_text
end module lagrangia_written_equilibrium
