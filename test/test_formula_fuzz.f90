module test_formula_fuzz
    !! Whatever is typed is a formula or is refused in one line; what is accepted is printed, read
    !! back and simplified without a change of its value.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use funit, only: TestMethod, TestSuite, assertEqual, assertTrue
    use lagrangia_canonical_form, only: simplified
    use lagrangia_derivative, only: derivative
    use lagrangia_errors, only: error_t
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_latex, only: latex
    use lagrangia_formula_parser, only: parse_equation, parse_formula
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_formula_text, only: formula_text
    use lagrangia_hyperdual, only: hyperdual_t
    use lagrangia_kinds, only: dp
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: to_text
    use random_formulas, only: draw_formula, draw_number, plain_value
    use random_states, only: restart_random, uniform
    implicit none (type, external)
    private
    public :: formula_fuzz_suite

    character(*), parameter :: names(*) = [character(9) :: "t", "x", "theta", "x_dot", &
                                           "theta_dot", "m", "m2", "l", "g"]
    integer, parameter :: n = size(names)

contains

    function formula_fuzz_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("formula_fuzz")
        call suite%addTest(TestMethod("bytes_are_refused_in_one_line", &
                                      bytes_are_refused_in_one_line, setUp=restart_random))
        call suite%addTest(TestMethod("slips_of_the_finger_mislead_nobody", &
                                      slips_of_the_finger_mislead_nobody, setUp=restart_random))
    end function formula_fuzz_suite

    function some_symbols() result(symbols)
        !! The names above, and a definition.
        type(symbols_t) :: symbols
        type(expression_t) :: e
        type(error_t), allocatable :: error
        integer :: i

        do i = 1, n
            call symbols%add(trim(names(i)))
        end do
        call parse_formula("theta - x", symbols, e, error)
        call symbols%define("D", e, error)
    end function some_symbols

    subroutine bytes_are_refused_in_one_line()
        !! 20000 texts of random bytes, and of the characters that formulas are made of.
        character(*), parameter :: usual = "xtmlg2D.|()+-*/^= ,_e0 sincosexpq"
        type(symbols_t) :: symbols
        character(60) :: text
        integer :: accepted, i, k, length

        symbols = some_symbols()
        accepted = 0
        do i = 1, 20000
            length = draw_number(len(text))
            if (mod(i, 2) == 0) length = draw_number(12)
            do k = 1, length
                if (mod(i, 4) == 1) then
                    text(k:k) = char(draw_number(256) - 1)
                else
                    text(k:k) = usual(draw_number(len(usual)):)
                end if
            end do
            call try(text(:length), symbols, accepted)
        end do
        call assertTrue(accepted > 200, to_text(accepted)//" accepted")
    end subroutine bytes_are_refused_in_one_line

    subroutine slips_of_the_finger_mislead_nobody()
        !! 6000 good formulas with up to three characters deleted, doubled, exchanged or replaced.
        character(*), parameter :: usual = "xtmlg2D.|()+-*/^= ,_e0"
        type(symbols_t) :: symbols
        type(expression_t) :: e
        character(:), allocatable :: text
        integer :: accepted, i, k, place

        symbols = some_symbols()
        accepted = 0
        do i = 1, 6000
            call draw_formula(n, draw_number(10), e)
            text = formula_text(e, symbols)
            if (mod(i, 5) == 0) text = text//" = "//text
            do k = 1, draw_number(3)
                if (text == "") cycle
                place = draw_number(len(text))
                select case (draw_number(5))
                case (1)
                    text = text(:place - 1)//text(place + 1:)
                case (2)
                    text = text(:place)//text(place:)
                case (3)
                    text = text(:place - 1)//text(min(place + 1, len(text)):)//text(place:place)
                case (4)
                    text = text(place:)//text(:place)
                case default
                    text(place:place) = usual(draw_number(len(usual)):)
                end select
            end do
            call try(text, symbols, accepted)
        end do
        call assertTrue(accepted > 500, to_text(accepted)//" accepted")
    end subroutine slips_of_the_finger_mislead_nobody

    subroutine try(text, symbols, accepted)
        !! As a formula, and if it has a sign for it, as an equation.
        character(*), intent(in) :: text
        type(symbols_t), intent(in) :: symbols
        integer, intent(inout) :: accepted
        type(expression_t) :: e, other
        type(error_t), allocatable :: error

        call parse_formula(text, symbols, e, error)
        if (allocated(error)) then
            call check_message(text, error%message)
            if (index(text, "=") == 0) return
            call parse_equation(text, symbols, e, other, error)
            if (allocated(error)) then
                call check_message(text, error%message)
                return
            end if
            call check_formula(other, symbols)
        end if
        accepted = accepted + 1
        call check_formula(e, symbols)
    end subroutine try

    subroutine check_message(text, message)
        !! One line of plain characters with a column and no more than the user needs.
        character(*), intent(in) :: text, message
        integer :: column, i, status

        call assertEqual("column ", message(:min(7, len(message))), message)
        read (message(8:index(message, ":") - 1), *, iostat=status) column
        call assertEqual(0, status, message)
        call assertTrue(column >= 1 .and. column <= len(text) + 1, message)
        call assertTrue(len(message) < 250, message)
        do i = 1, len(message)
            if (message(i:i) < " " .or. message(i:i) > "~") then
                call assertTrue(.false., "a character that no terminal should receive")
                return
            end if
        end do
    end subroutine check_message

    subroutine check_formula(e, symbols)
        !! Printed and read back, the same text and value; simplified, the same value, and not
        !! simpler when that is done twice; a derivative and LaTeX can be made of it.
        type(expression_t), intent(in) :: e
        type(symbols_t), intent(in) :: symbols
        type(expression_t) :: both(2), d
        type(error_t), allocatable :: error
        type(formula_program_t) :: program
        type(hyperdual_t) :: x(n), value, found
        character(:), allocatable :: text
        real(dp) :: bound, other, results(2), values(n)
        integer :: k

        text = formula_text(e, symbols)
        both(1) = e
        call parse_formula(text, symbols, both(2), error)
        call assertTrue(.not. allocated(error), text)
        if (allocated(error)) return
        call assertEqual(text, formula_text(both(2), symbols), "printed, read and printed")
        do k = 1, n
            values(k) = uniform(0.1_dp, 2.0_dp)
            x(k) = hyperdual_t(values(k))
        end do
        call new_formula_program(program, both, n)
        call program%evaluate(values, results)
        if (ieee_is_finite(results(1))) call assertEqual(results(1), results(2), 0.0_dp, text)
        both(1) = simplified(e, symbols)
        both(2) = simplified(both(1), symbols)
        call assertEqual(formula_text(both(1), symbols), formula_text(both(2), symbols), &
                         "simplified twice: "//text)
        call plain_value(e, x, value, bound)
        call plain_value(both(1), x, found, other)
        if (ieee_is_finite(value%re) .and. bound < 1e-6_dp .and. other < 1e-6_dp) then
            call assertEqual(value%re, found%re, bound + other, text)
        end if
        d = simplified(derivative(e, 2), symbols)
        call assertTrue(len(latex(d, symbols)) > 0, "set")
    end subroutine check_formula
end module test_formula_fuzz
