module lagrangia_constant_formula
    !! A formula without names as a number: `pi/2` at the end of an axis, or an event's level.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_errors, only: error_t, fail
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_kinds, only: dp
    use lagrangia_number_reader, only: digits, misread
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: quoted
    implicit none (type, external)
    private
    public :: read_constant

contains

    subroutine read_constant(text, value, error)
        !! A number, or a formula of numbers: `-pi/2`. As in a namelist, `1d-3` is a number too.
        character(*), intent(in) :: text                  !! not empty
        real(dp), intent(out) :: value                    !! finite
        type(error_t), allocatable, intent(out) :: error  !! status 2: quotes the text
        character(:), allocatable :: phrase, problem
        type(symbols_t) :: none
        logical :: in_degrees
        type(expression_t) :: formula(1)
        type(formula_program_t) :: program
        real(dp) :: results(1)

        value = 0.0_dp
        call misread(trim(adjustl(text)), phrase, problem, in_degrees)
        if (in_degrees) then
            call fail(error, quoted(phrase)//": "//problem)
            return
        end if
        allocate (none%names(0))
        call parse_formula(with_e(text), none, formula(1), error)
        if (allocated(error)) then
            error%message = quoted(trim(adjustl(text)))//": "//error%message
            return
        end if
        call new_formula_program(program, formula, 0)
        call program%evaluate([real(dp) ::], results)
        value = results(1)
        if (.not. ieee_is_finite(value)) call fail(error, quoted(trim(text))//" is no number")
    end subroutine read_constant

    pure function with_e(text) result(plain)
        !! The exponents of Fortran's doubles as a formula has them: a `d` between digits can be
        !! nothing else where no name is known.
        character(*), intent(in) :: text
        character(len(text)) :: plain
        integer :: behind, i

        plain = text
        do i = 2, len(text) - 1
            if (scan(text(i:i), "dD") == 0 .or. scan(text(i - 1:i - 1), digits//".") == 0) cycle
            behind = i + 1
            if (scan(text(behind:behind), "+-") == 1) behind = behind + 1
            if (scan(text(min(behind, len(text)):), digits) == 1) plain(i:i) = "e"
        end do
    end function with_e
end module lagrangia_constant_formula
