module lagrangia_parameter_domains
    !! What a scene allows of the parameters of its formulas: `domain = 'm > 0', 'e < 1'`.
    use lagrangia_description, only: name_length, parameter_t
    use lagrangia_errors, only: error_t, fail
    use lagrangia_expression, only: expression_t
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_formula_program, only: formula_program_t, new_formula_program
    use lagrangia_kinds, only: dp
    use lagrangia_names, only: nearest_name
    use lagrangia_symbols, only: symbols_t
    use lagrangia_text, only: quoted
    implicit none (type, external)
    private
    public :: set_domain

contains

    subroutine set_domain(text, parameters, error)
        !! Bound one of the parameters.
        character(*), intent(in) :: text                    !! `m > 0`, with >, >=, < or <=
        type(parameter_t), intent(inout) :: parameters(:)   !! of which one gets a bound
        type(error_t), allocatable, intent(out) :: error    !! what is wrong with the text
        character(name_length) :: names(size(parameters))
        character(:), allocatable :: name, near
        real(dp) :: bound
        logical :: above, open
        integer :: at, i

        at = scan(text, "<>")
        if (at < 2) then
            call fail(error, "a domain is written 'm > 0', with >, >=, < or <=")
            return
        end if
        if (scan(text(at + 1:), "<>") > 0 .or. scan(text(:at - 1), "=") > 0) then
            call fail(error, "a text has one bound; two are written 'm > 0', 'm < 3'")
            return
        end if
        name = trim(adjustl(text(:at - 1)))
        above = text(at:at) == ">"
        open = text(at + 1:min(at + 1, len(text))) /= "="
        if (.not. open) at = at + 1
        call read_bound(repeat(" ", at)//text(at + 1:), bound, error)
        if (allocated(error)) return
        i = findloc(parameters%name == name, .true., 1)
        if (i == 0) then
            names = parameters%name
            near = nearest_name(name, names)
            if (near /= "") near = "; did you mean "//quoted(near)//"?"
            call fail(error, "there is no parameter "//quoted(name)//near)
            return
        end if
        associate (p => parameters(i))
            if (above .and. bound >= p%lower) then
                p%open_lower = open .or. (p%open_lower .and. bound <= p%lower)
                p%lower = bound
            else if (.not. above .and. bound <= p%upper) then
                p%open_upper = open .or. (p%open_upper .and. bound >= p%upper)
                p%upper = bound
            end if
            if (p%lower > p%upper .or. (p%lower >= p%upper .and. (p%open_lower .or. &
                p%open_upper))) then
                call fail(error, "leaves no value for "//name)
            end if
        end associate
    end subroutine set_domain

    subroutine read_bound(text, bound, error)
        !! A formula without names but `pi`.
        character(*), intent(in) :: text
        real(dp), intent(out) :: bound
        type(error_t), allocatable, intent(out) :: error
        type(symbols_t) :: none
        type(expression_t) :: formula(1)
        type(formula_program_t) :: program
        real(dp) :: values(1)

        bound = 0.0_dp
        call parse_formula(text, none, formula(1), error)
        if (allocated(error)) return
        call new_formula_program(program, formula, 0)
        call program%evaluate([real(dp) ::], values)
        bound = values(1)
        if (.not. abs(bound) <= huge(bound)) call fail(error, "the bound is no finite number")
    end subroutine read_bound
end module lagrangia_parameter_domains
