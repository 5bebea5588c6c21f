module lagrangia_strobe
    !! The period of a stroboscope: a formula in the parameters of a system, `2 pi/drive_frequency`,
    !! so that it follows where a sweep changes them.
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use lagrangia_description, only: description_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_kinds, only: dp
    use lagrangia_symbols, only: symbols_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: strobe_t, new_strobe

    type :: strobe_t
        !! None at first.
        logical :: given = .false.
        type(formula_program_t), private :: program
        integer, allocatable, private :: places(:)  !! of its symbols among the parameters
    contains
        procedure :: period
    end type strobe_t

contains

    subroutine new_strobe(self, text, system, error)
        !! Read the formula.
        type(strobe_t), intent(out) :: self               !! none where `text` is blank
        character(*), intent(in) :: text                  !! `2 pi/drive_frequency`
        class(system_t), intent(in) :: system             !! whose parameters these are
        type(error_t), allocatable, intent(out) :: error  !! what cannot be read
        type(description_t) :: d
        type(symbols_t) :: symbols
        type(expression_t) :: formula
        integer :: i, place

        if (text == "") return
        call system%describe(d)
        allocate (symbols%names(0), self%places(0))
        place = 1
        do i = 1, size(d%parameters)
            associate (p => d%parameters(i))
                if (p%count == 1) then
                    call symbols%add(p%name)
                    self%places = [self%places, place]
                end if
                place = place + p%count
            end associate
        end do
        call parse_formula(trim(text), symbols, formula, error)
        if (allocated(error)) return
        call new_formula_program(self%program, [formula], size(self%places))
        self%given = .true.
    end subroutine new_strobe

    pure subroutine period(self, parameters, t, error)
        !! Its value.
        class(strobe_t), intent(in) :: self               !! one that is given
        real(dp), intent(in) :: parameters(:)             !! in the order of the description
        real(dp), intent(out) :: t                        !! s, above 0
        type(error_t), allocatable, intent(out) :: error  !! it is not above 0
        real(dp) :: results(1)

        call self%program%evaluate(parameters(self%places), results)
        t = results(1)
        if (ieee_is_finite(t) .and. t > 0.0_dp) return
        call fail(error, "the period of the stroboscope must be above 0, not "//to_text(t), &
                  key="strobe")
    end subroutine period
end module lagrangia_strobe
