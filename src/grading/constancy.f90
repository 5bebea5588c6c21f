module lagrangia_constancy
    !! Statements that something does not change: `p_x = const`, `theta_dot^2/2 = a + C`.
    use lagrangia_errors, only: error_t
    use lagrangia_explanation, only: explanation_t
    use lagrangia_expression, only: expression_t, kind_symbol, operator(*), operator(+), &
                                    operator(-), symbol
    use lagrangia_formula_parser, only: parse_formula
    use lagrangia_sample_names, only: samples_t
    use lagrangia_slip_search, only: holds
    implicit none (type, external)
    private
    public :: explain_change, read_constancy

contains

    pure subroutine read_constancy(text, samples, rest, yes)
        !! `const`, or a sum that ends in it; `rest` is the sum without it, to be subtracted.
        character(*), intent(in) :: text                  !! the right side, as typed
        type(samples_t), intent(in) :: samples            !! know the names
        character(:), allocatable, intent(out) :: rest    !! `" - (...)"`, or nothing
        logical, intent(out) :: yes                       !! it is that
        integer :: at

        rest = ""
        yes = is_constant_word(adjustl(text), samples)
        if (yes) return
        at = scan(text, "+-", back=.true.)
        if (at < 2) return
        if (text(:at - 1) == "") return
        yes = is_constant_word(adjustl(text(at + 1:)), samples)
        if (yes) rest = " - ("//text(:at - 1)//")"
    end subroutine read_constancy

    pure function is_constant_word(word, samples) result(yes)
        !! One that nobody has given another meaning.
        character(*), intent(in) :: word
        type(samples_t), intent(in) :: samples
        logical :: yes

        yes = any(word == [character(8) :: "const", "const.", "constant", "konst", "konst.", &
                           "konstant", "C", "C1", "C_1", "C2", "C_2"])
        if (yes) yes = samples%symbols%find_definition(trim(word)) == 0 .and. &
                       samples%symbols%find(trim(word)) == 0 .and. &
                       .not. any(samples%declared == word)
    end function is_constant_word

    subroutine explain_change(text, samples, explanation, remark)
        !! Why E or p_x changes: a force beside L acts, L contains t, or x is not cyclic.
        character(*), intent(in) :: text                     !! what would be constant
        type(samples_t), intent(in) :: samples               !! on the motion
        type(explanation_t), intent(in) :: explanation       !! of `rate = 0`
        character(:), allocatable, intent(inout) :: remark   !! changes
        type(expression_t) :: what, power
        type(error_t), allocatable :: error
        character(:), allocatable :: forces, name, q, rate
        logical :: judged, yes
        integer :: i, k

        rate = "it changes"
        if (allocated(explanation%lacks)) then
            if (explanation%lacks(1:1) == "-") then
                rate = "its rate is "//explanation%lacks(2:)
            else if (index(explanation%lacks, " + ") + index(explanation%lacks, " - ") == 0) then
                rate = "its rate is -"//explanation%lacks
            end if
        end if
        call parse_formula(text, samples%symbols, what, error)
        if (allocated(error)) return
        if (explanation%is_surplus) remark = "it changes: its rate is not 0"
        if (what%count /= 1 .or. what%nodes(1)%kind /= kind_symbol) return
        name = trim(samples%symbols%names(what%nodes(1)%which))
        remark = rate
        if (name == "E") then
            power = symbol(samples%symbols%find("E_dot"))
            forces = ""
            do i = 1, samples%ndof
                k = samples%symbols%find_definition("Q_"//trim(samples%symbols%names(1 + i)))
                if (k == 0) cycle
                power = power - samples%symbols%definitions(k)%meaning*symbol(1 + samples%ndof + i)
                forces = forces//", Q_"//trim(samples%symbols%names(1 + i))
            end do
            call holds(power, samples%values, yes, judged)
            if (yes .and. forces /= "") then
                remark = rate//": the force beside L, "//forces(3:)//", does work"
            else if (forces == "") then
                remark = rate//": L contains t"
            else
                remark = rate//": "//forces(3:)//" does work, and L contains t"
            end if
        else if (index(name, "p_") == 1) then
            q = name(3:)
            i = samples%symbols%find("dL_d"//q)
            if (i == 0) return  ! a quantity of this name
            k = samples%symbols%find_definition("Q_"//q)
            remark = rate//": dL/d"//q//" is not 0"
            call holds(symbol(i), samples%values, yes, judged)
            if (yes .and. k > 0) remark = rate//": Q_"//q//" acts"
        end if
    end subroutine explain_change
end module lagrangia_constancy
